/* A bar on the terminal, shown once a run has taken a second and wiped away at its end. */
#define _GNU_SOURCE
#include "cli/common/progress.h"
#include "cli/common/talk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { BAR_WIDTH = 40 };

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

progress progress_begin(const char *verb, double whole, bool quiet) {
    const char *terminal = getenv("TERM");
    const bool able = isatty(STDERR_FILENO) && terminal && strcmp(terminal, "dumb") != 0;
    const double now = seconds();
    return (progress){.wanted = able && !quiet && whole > 0,
                      .verb = verb,
                      .whole = whole,
                      .started = now,
                      .last = now};
}

static void print_time(double seconds_left) {
    const double left = seconds_left;
    if (left < 120)
        fprintf(stderr, ", %.0f s left", left);
    else if (left < 7200)
        fprintf(stderr, ", %.0f min left", left / 60);
    else
        fprintf(stderr, ", %.1f h left", left / 3600);
}

void progress_update(progress *p, double done) {
    if (!p->wanted) return;
    const double now = seconds(), spent = now - p->started;
    if (spent < 1.0 || now - p->last < 0.1) return;

    const double part = fmin(fmax(done / p->whole, 0.0), 1.0);
    char bar[BAR_WIDTH + 1];
    const size_t full = (size_t)(part * BAR_WIDTH);
    memset(bar, '-', BAR_WIDTH);
    memset(bar, '#', full);
    bar[BAR_WIDTH] = 0;

    const bool colour = colourful(stderr);
    fprintf(stderr, "\rgough %s %s[%s]%s %3.0f %%", p->verb, colour ? "\033[36m" : "", bar,
            colour ? "\033[0m" : "", 100.0 * part);
    const double rate = (done - p->first) / spent;
    if (p->counted) fprintf(stderr, ", %.3g %s/s", rate, p->counted);
    if (part > 0.01 && rate > 0) print_time((p->whole - done) / rate);
    fputs("\033[K", stderr);
    fflush(stderr);
    p->last = now;
    p->shown = true;
}

void progress_end(progress *p) {
    if (p->shown) fputs("\r\033[K", stderr);
    p->shown = p->wanted = false;
}
