/* Runs a command once for each allocation to fail, in the working folder:
 *   fail_each PRELOAD sites|all OUTPUT… -- COMMAND ARGUMENT…
 * Each run must do as the undisturbed one does (exit status, standard output, outputs), or exit with 3, a sentence on
 * standard error, no half output and nothing on standard output. Temporary names left behind are faults too. */
#define _GNU_SOURCE
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_OUTPUTS = 8, PATIENCE = 120 };

typedef struct bytes {
    char *data;
    size_t length;
    bool there;
} bytes;

static bytes read_bytes(const char *path) {
    bytes b = {NULL, 0, false};
    FILE *file = fopen(path, "rb");
    if (!file) return b;
    b.there = true;
    b.data = malloc(1);
    char piece[65536];
    for (size_t got; (got = fread(piece, 1, sizeof piece, file)) > 0; b.length += got) {
        b.data = realloc(b.data, b.length + got);
        memcpy(b.data + b.length, piece, got);
    }
    fclose(file);
    return b;
}

static bool same(const bytes *a, const bytes *b) {
    return a->there == b->there && a->length == b->length &&
           (a->length == 0 || memcmp(a->data, b->data, a->length) == 0);
}

/* The exit status; 1000 + the signal where one ended it. */
static int run(char **command, const char *preload, const char *name, const char *value) {
    const pid_t child = fork();
    if (child == 0) {
        const int out = open("fault.out", O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int err = open("fault.err", O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int nothing = open("/dev/null", O_RDONLY);
        dup2(nothing, 0);
        dup2(out, 1);
        dup2(err, 2);
        close(out);
        close(err);
        close(nothing);
        setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
        setenv("LD_PRELOAD", preload, 1);
        setenv(name, value, 1);
        alarm(PATIENCE); /* survives exec: a hang is a fault */
        execv(command[0], command);
        _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

static bool temporaries_left(const char **name) {
    static char found[300];
    DIR *folder = opendir(".");
    bool any = false;
    for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;)
        if (strncmp(entry->d_name, ".gough", 6) == 0 || strstr(entry->d_name, "gough-figure")) {
            snprintf(found, sizeof found, "%s", entry->d_name);
            unlink(found);
            any = true;
        }
    if (folder) closedir(folder);
    *name = found;
    return any;
}

typedef struct reference {
    int status;
    bytes out, output[MOST_OUTPUTS];
    char **path;
    int outputs;
} reference;

static void remove_outputs(const reference *r) {
    char part[400];
    for (int i = 0; i < r->outputs; i++) {
        snprintf(part, sizeof part, "%s.part", r->path[i]);
        unlink(part);
        unlink(r->path[i]);
    }
}

/* What is wrong with a disturbed run; NULL: nothing. */
static const char *judge(const reference *r, int status) {
    static char complaint[400];
    const char *left;
    bytes out = read_bytes("fault.out"), err = read_bytes("fault.err");
    complaint[0] = '\0';
    if (status >= 1000)
        snprintf(complaint, sizeof complaint, "dies by signal %d", status - 1000);
    else if (status != r->status && status != 3)
        snprintf(complaint, sizeof complaint, "exit status %d", status);
    else if (status == 3 && r->status != 3 && err.length < 10)
        snprintf(complaint, sizeof complaint, "exit status 3 without a sentence");
    else if (status == 3 && out.length > 0 && !same(&out, &r->out))
        snprintf(complaint, sizeof complaint, "exit status 3 with a part of standard output");
    else if (status == r->status && status != 3 && !same(&out, &r->out))
        snprintf(complaint, sizeof complaint, "exit status %d with another standard output",
                 status);
    for (int i = 0; i < r->outputs && !complaint[0]; i++) {
        bytes now = read_bytes(r->path[i]);
        const bool missing = !now.there && status == 3;
        if (!missing && !same(&now, &r->output[i]))
            snprintf(complaint, sizeof complaint, "exit status %d with another %.100s", status,
                     r->path[i]);
        free(now.data);
    }
    if (!complaint[0] && temporaries_left(&left))
        snprintf(complaint, sizeof complaint, "leaves %.200s", left);
    free(out.data);
    free(err.data);
    return complaint[0] ? complaint : NULL;
}

static size_t list_numbers(bool every, unsigned long **number) {
    FILE *file = fopen("fault.sites", "r");
    size_t count = 0, room = 1 << 16;
    unsigned long n, last = 0;
    *number = malloc(room * sizeof **number);
    while (file && fscanf(file, "%lu", &n) == 1) {
        if (count == room) *number = realloc(*number, (room *= 2) * sizeof **number);
        (*number)[count++] = n;
        last = n > last ? n : last;
    }
    if (file) fclose(file);
    if (!every) return count;
    /* the last site is near the end: some more than that */
    *number = realloc(*number, (last + 200) * sizeof **number);
    for (n = 1; n <= last + 200; n++) (*number)[n - 1] = n;
    return last + 200;
}

int main(int count, char **argument) {
    int dash = 3, faults = 0;
    while (dash < count && strcmp(argument[dash], "--") != 0) dash++;
    if (count < 5 || dash >= count - 1 || dash - 3 > MOST_OUTPUTS) return 2;
    reference r = {.path = argument + 3, .outputs = dash - 3};
    char **command = argument + dash + 1;
    remove_outputs(&r);
    unlink("fault.sites");
    r.status = run(command, argument[1], "FAIL_SITES", "fault.sites");
    r.out = read_bytes("fault.out");
    for (int i = 0; i < r.outputs; i++) r.output[i] = read_bytes(r.path[i]);
    unsigned long *number;
    const size_t numbers = list_numbers(strcmp(argument[2], "all") == 0, &number);
    for (size_t i = 0; i < numbers; i++) {
        char text[32];
        remove_outputs(&r);
        snprintf(text, sizeof text, "%lu", number[i]);
        const char *wrong = judge(&r, run(command, argument[1], "FAIL_AT", text));
        if (!wrong) continue;
        faults++;
        printf("allocation %s of `", text);
        for (char **c = command + 1; *c; c++) printf("%s%s", c > command + 1 ? " " : "", *c);
        printf("`: %s\n", wrong);
    }
    printf("%zu allocations of `%s` let fail (status %d), %d faults\n", numbers, command[1],
           r.status, faults);
    return numbers == 0 || faults > 0 || r.status > 3;
}
