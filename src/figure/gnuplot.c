/* Running gnuplot: no shell, no settings of the user's, in a private folder, its exit status checked. */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "figure/sheet.h"

enum { CPU_SECONDS = 120, NOT_FOUND = 127, NO_FOLDER = 126 };

/* The child: gnuplot on "script", its talk into "log". The same figure in every locale. */
static _Noreturn void become_gnuplot(const char *folder, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* it does not outlive us */
    if (getppid() != parent || chdir(folder) != 0) _exit(NO_FOLDER);
    const int log = open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int nothing = open("/dev/null", O_RDONLY);
    if (log < 0 || nothing < 0) _exit(NO_FOLDER);
    dup2(nothing, STDIN_FILENO);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    setrlimit(RLIMIT_CPU, &(struct rlimit){CPU_SECONDS, CPU_SECONDS});
    setenv("LC_ALL", "C.UTF-8", 1);
    unsetenv("GNUTERM");
    unsetenv("GNUPLOT_LIB");
    execlp("gnuplot", "gnuplot", "--default-settings", "script", (char *)NULL);
    _exit(NOT_FOUND);
}

/* The last line of gnuplot's talk that says something, for the message. */
static void read_complaint(const char *folder, char complaint[200]) {
    char path[256], line[400];
    snprintf(path, sizeof path, "%s/log", folder);
    complaint[0] = '\0';
    FILE *log = fopen(path, "r");
    if (log == NULL) return;
    while (fgets(line, sizeof line, log) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        if (strspn(line, " \t^") < strlen(line)) snprintf(complaint, 200, "%.199s", line);
    }
    fclose(log);
}

gough_status sheet_run_gnuplot(const char *folder, gough_error *error) {
    const pid_t parent = getpid(), child = fork();
    if (child < 0)
        return gough_fail(error, GOUGH_ERROR_FILE, "cannot start gnuplot: %s", strerror(errno));
    if (child == 0) become_gnuplot(folder, parent);

    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR)
            return gough_fail(error, GOUGH_ERROR_FILE, "lost track of gnuplot: %s",
                              strerror(errno));
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return GOUGH_OK;
    if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND)
        return gough_fail(error, GOUGH_ERROR_FILE,
                          "gnuplot, which draws the figures, is not installed; on Debian: apt "
                          "install gnuplot-nox");
    char complaint[200];
    read_complaint(folder, complaint);
    return gough_fail(error, GOUGH_ERROR_FILE, "gnuplot could not draw the figure: %s", complaint);
}
