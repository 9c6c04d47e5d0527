/* Studies in and results out, as all verbs that have them read and check them. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/common/in_and_out.h"
#include "cli/common/study_messages.h"
#include "cli/common/talk.h"

/* The folder that a file is to go to. */
gough_status check_folder(const char *verb, const char *path) {
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
    struct stat status;
    if (!folder) {
        complain(verb, "out of memory");
        return GOUGH_ERROR_FILE;
    }
    const bool there = stat(folder, &status) == 0 && S_ISDIR(status.st_mode);
    if (!there) complain(verb, "%s: there is no folder '%s'; create it first", path, folder);
    free(folder);
    return there ? GOUGH_OK : GOUGH_ERROR_FILE;
}

/* ---- which file a name leads to ---------------------------------------------------------------------------------- */

/* A file by device and inode, links followed; one that is not there yet by those of its folder and its name. */
typedef struct identity {
    bool known, there;
    dev_t device;
    ino_t inode;
    const char *name;
} identity;

static identity identity_of(const char *path, int standard) {
    struct stat about;
    if (strcmp(path, "-") == 0) {
        const bool file = fstat(standard, &about) == 0 && S_ISREG(about.st_mode);
        return (identity){file, true, about.st_dev, about.st_ino, NULL};
    }
    if (stat(path, &about) == 0)
        return (identity){S_ISREG(about.st_mode), true, about.st_dev, about.st_ino, NULL};
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    const bool found = folder && stat(folder, &about) == 0;
    free(folder);
    return (identity){found, false, about.st_dev, about.st_ino, slash ? slash + 1 : path};
}

static bool same_file(const identity *a, const identity *b) {
    return a->known && b->known && a->there == b->there && a->device == b->device &&
           a->inode == b->inode && (a->there || strcmp(a->name, b->name) == 0);
}

gough_status check_overwriting(const char *verb, const char *output, const char *const *input,
                               size_t inputs) {
    const identity out = identity_of(output, STDOUT_FILENO);
    for (size_t i = 0; i < inputs; i++) {
        const identity in = identity_of(input[i], STDIN_FILENO);
        if (!same_file(&out, &in)) continue;
        complain(verb, "the output '%s' would overwrite the input '%s'; choose another name",
                 output, input[i]);
        return GOUGH_ERROR_INPUT;
    }
    return GOUGH_OK;
}

gough_status check_distinct(const command_line *line) {
    for (size_t i = 1; i < line->outputs.count; i++) {
        const identity one = identity_of(line->outputs.word[i], STDOUT_FILENO);
        for (size_t k = 0; k < i; k++) {
            const identity other = identity_of(line->outputs.word[k], STDOUT_FILENO);
            if (!same_file(&one, &other) &&
                strcmp(line->outputs.word[i], line->outputs.word[k]) != 0)
                continue;
            complain(line->verb, "the outputs '%s' and '%s' are the same file",
                     line->outputs.word[k], line->outputs.word[i]);
            return GOUGH_ERROR_INPUT;
        }
    }
    return GOUGH_OK;
}

/* ---- outputs ------------------------------------------------------------------------------------------------------ */

bool writes_standard(const command_line *line) {
    for (size_t i = 0; i < line->outputs.count; i++)
        if (strcmp(line->outputs.word[i], "-") == 0) return true;
    return false;
}

static bool ends_in(const char *path, const char *ending) {
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ending) == 0;
}

bool is_data(const char *path) {
    return strcmp(path, "-") == 0 || ends_in(path, ".csv") || ends_in(path, ".h5");
}

static bool is_picture(const char *path) {
    return ends_in(path, ".png") || ends_in(path, ".svg") || ends_in(path, ".pdf");
}

/* Standard output cannot take a table and JSON; a file needs its folder. */
static gough_status check_place(const command_line *line, const char *path) {
    if (strcmp(path, "-") != 0) return check_folder(line->verb, path);
    if (!line->json) return GOUGH_OK;
    complain(line->verb, "'-o -' and --json both write to standard output; give -o a file");
    return GOUGH_ERROR_INPUT;
}

gough_status check_data_and_pictures(const command_line *line) {
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        const char *path = line->outputs.word[i];
        if (is_data(path) || is_picture(path)) {
            status = check_place(line, path);
        } else {
            complain(line->verb,
                     "-o takes a name that ends in .csv or .h5 (data) or in .png, .svg or .pdf "
                     "(picture), or - for CSV on standard output; '%s' does not",
                     path);
            status = GOUGH_ERROR_INPUT;
        }
    }
    return status ? status : check_distinct(line);
}

static gough_status check_one(const command_line *line, const char *path, const char *other) {
    if (other && !ends_in(path, other)) {
        complain(line->verb, "a shard needs an output whose name ends in %s; '%s' does not", other,
                 path);
        return GOUGH_ERROR_INPUT;
    }
    if (!other && !is_data(path)) {
        complain(line->verb,
                 "-o needs a name that ends in .h5 or .csv, or - for CSV on standard output; '%s' "
                 "does not",
                 path);
        return GOUGH_ERROR_INPUT;
    }
    return check_place(line, path);
}

gough_status check_output(const command_line *line, const char *other) {
    if (other && line->outputs.count > 1) {
        complain(line->verb, "a shard is written to one file; give -o once");
        return GOUGH_ERROR_INPUT;
    }
    for (size_t i = 0; i < line->outputs.count; i++) {
        const gough_status status = check_one(line, line->outputs.word[i], other);
        if (status) return status;
    }
    return check_distinct(line);
}

gough_status check_study_output(const command_line *line) {
    const char *path = line->outputs.count ? line->outputs.word[0] : "-";
    if (line->outputs.count > 1) {
        complain(line->verb, "a study is written to one file; give -o once");
        return GOUGH_ERROR_INPUT;
    }
    if (strcmp(path, "-") != 0 && !ends_in(path, ".yaml") && !ends_in(path, ".yml")) {
        complain(line->verb,
                 "-o needs a name that ends in .yaml or .yml, or - for standard output; '%s' does "
                 "not",
                 path);
        return GOUGH_ERROR_INPUT;
    }
    return line->outputs.count ? check_place(line, path) : GOUGH_OK;
}

/* ---- studies ------------------------------------------------------------------------------------------------------ */

/* No output is the study or its recorded motion. */
static gough_status check_inputs(const command_line *line, const char *path,
                                 const gough_study *study) {
    const char *const input[] = {path, study->samples};
    const size_t inputs = study->samples ? 2 : 1;
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < line->outputs.count && !status; i++)
        status = check_overwriting(line->verb, line->outputs.word[i], input, inputs);
    return status;
}

/* What was done to recorded motion, and warnings: these are printed with -q as well. */
static void say_record(const command_line *line, const gough_record *record) {
    for (size_t i = 0; record && i < record->remarks; i++) {
        const gough_remark *one = &record->remark[i];
        if (one->warning || !line->quiet)
            remark(line->verb, "%s%s", one->warning ? "warning: " : "", one->sentence);
    }
}

gough_status read_study(const command_line *line, const char *path, gough_study **study) {
    char *messages = NULL;
    const gough_status status =
        gough_study_read(path, line->settings.list, line->settings.count, study, &messages);
    if (status == GOUGH_ERROR_FILE && !messages) complain(line->verb, "out of memory");
    say_study_messages(line->verb, messages);
    if (status) return status;
    say_record(line, (*study)->record);
    return check_inputs(line, path, *study);
}

gough_status read_sweep(const command_line *line, const gough_study *study, gough_sweep **sweep) {
    char *messages = NULL;
    const gough_status status =
        gough_sweep_parse(study->name, study->text, strlen(study->text), line->settings.list,
                          line->settings.count, sweep, &messages);
    if (status == GOUGH_ERROR_FILE && !messages) complain(line->verb, "out of memory");
    say_study_messages(line->verb, messages);
    return status;
}

gough_status read_design(const command_line *line, const gough_study *study,
                         gough_design_study **design) {
    char *messages = NULL;
    const gough_status status =
        gough_design_study_parse(study->name, study->text, strlen(study->text), line->settings.list,
                                 line->settings.count, design, &messages);
    if (status == GOUGH_ERROR_FILE && !messages) complain(line->verb, "out of memory");
    say_study_messages(line->verb, messages);
    return status;
}

char *output_beside(const char *input, const char *ending, const char *otherwise) {
    const bool descriptor = strcmp(input, "-") == 0 || strcmp(input, "/dev/stdin") == 0 ||
                            strncmp(input, "/dev/fd/", 8) == 0 ||
                            strncmp(input, "/proc/self/fd/", 14) == 0;
    if (descriptor) return strdup(otherwise);
    const char *slash = strrchr(input, '/'), *dot = strrchr(input, '.');
    const size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - input) : strlen(input);
    char *path = NULL;
    return asprintf(&path, "%.*s%s", (int)stem, input, ending) < 0 ? NULL : path;
}
