/* Studies in and results out, as all verbs that have them read and check them. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "cli/command.h"

static void say_messages(char *messages) {
    if (messages) {
        fputs(messages, stderr);
        const size_t length = strlen(messages);
        if (length && messages[length - 1] != '\n') fputc('\n', stderr);
    }
    gough_study_free_messages(messages);
}

gough_status read_study(const command_line *line, gough_study **study) {
    char *messages = NULL;
    const gough_status status =
        gough_study_read(line->file[0], line->settings, line->setting_count, study, &messages);
    say_messages(messages);
    return status;
}

/* The folder that a file is to go to. */
gough_status check_folder(const char *verb, const char *path) {
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
    struct stat status;
    const bool there = folder && stat(folder, &status) == 0 && S_ISDIR(status.st_mode);
    if (!there) complain(verb, "%s: there is no folder '%s'", path, folder ? folder : "?");
    free(folder);
    return there ? GOUGH_OK : GOUGH_ERROR_FILE;
}

gough_status check_output(const command_line *line, const char *other) {
    const char *path = line->output;
    if (!path) return GOUGH_OK;
    const bool standard = strcmp(path, "-") == 0;
    if (standard && line->json) {
        complain(line->verb, "'-o -' and --json both want standard output; give -o a file");
        return GOUGH_ERROR_INPUT;
    }
    if (standard) return GOUGH_OK;
    const char *ending = strrchr(path, '.');
    if (other && (!ending || strcasecmp(ending, other) != 0)) {
        complain(line->verb, "a shard goes to a file whose name ends in %s; '%s' does not", other,
                 path);
        return GOUGH_ERROR_INPUT;
    }
    if (!other &&
        (!ending || (strcasecmp(ending, ".h5") != 0 && strcasecmp(ending, ".csv") != 0))) {
        complain(line->verb,
                 "-o takes a name that ends in .h5 or .csv, or - for CSV on standard output; '%s' "
                 "does not",
                 path);
        return GOUGH_ERROR_INPUT;
    }
    return check_folder(line->verb, path);
}

gough_status read_sweep(const command_line *line, const gough_study *study, gough_sweep **sweep) {
    char *messages = NULL;
    const gough_status status =
        gough_sweep_parse(study->name, study->text, strlen(study->text), line->settings,
                          line->setting_count, sweep, &messages);
    say_messages(messages);
    return status;
}
