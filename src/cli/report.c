/* gough report: studies as one HTML page that needs nothing but a browser. */
#define _GNU_SOURCE
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/command.h"
#include "cli/page.h"

static const struct argp_option option[] = {
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write to FILE, whose name ends in .html (default: the first study with .html)", 0},
    {"set", OPTION_SET, "KEY=VALUE", 0,
     "override a key of every study, as in --set control.stiffness=50; may be repeated", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "say nothing but what is wrong", 0},
    {0}};

static const verb_usage usage = {
    .verb = "report",
    .option = option,
    .arguments = "STUDY...",
    .text = "Studies as one HTML page: the machine moving in 3D, curves, numbers, and a live "
            "simulation in the page.\v"
            "STUDY is a study file, or - for standard input; several are compared. The page is one "
            "file that needs no network: it can be mailed and opened anywhere. Where a run ends "
            "early the page says so, and the exit status is 1.",
    .least_files = 1,
    .most_files = 64};

/* "studies/heave.yaml" gives "studies/heave.html", standard input "report.html". Allocated. */
static char *default_output(const char *study) {
    if (strcmp(study, "-") == 0) return strdup("report.html");
    const char *slash = strrchr(study, '/'), *dot = strrchr(study, '.');
    const size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - study) : strlen(study);
    char *path = NULL;
    return asprintf(&path, "%.*s.html", (int)stem, study) < 0 ? NULL : path;
}

/* What can be known before the studies are run. */
static gough_status check_path(const char *verb, const char *path) {
    const char *ending = strrchr(path, '.');
    if (strcmp(path, "-") == 0) return GOUGH_OK;
    if (!ending || strcasecmp(ending, ".html") != 0) {
        complain(verb,
                 "-o takes a name that ends in .html, or - for standard output; '%s' does not",
                 path);
        return GOUGH_ERROR_INPUT;
    }
    return check_folder(verb, path);
}

/* Every study into the list; the worst status, GOUGH_ERROR_NUMERICAL where runs ended early. */
static gough_status add_studies(const command_line *line, json_t *studies) {
    gough_status worst = GOUGH_OK;
    for (size_t i = 0; i < line->files && worst <= GOUGH_ERROR_NUMERICAL; i++) {
        command_line one = *line;
        one.file = &line->file[i];
        gough_study *study = NULL;
        json_t *object = NULL;
        gough_status status = read_study(&one, &study);
        if (!status) status = page_study(&one, study, &object);
        if (object) json_array_append_new(studies, object);
        gough_study_free(study);
        if (status > worst) worst = status;
    }
    return worst;
}

static gough_status write_page(const command_line *line, json_t *data, const char *path) {
    const gough_page_template page = page_template();
    gough_error error = {0};
    char *text = json_dumps(data, JSON_COMPACT | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(17));
    const gough_status status =
        text ? gough_page_write(&page, text, strlen(text), path, &error)
             : gough_fail(&error, GOUGH_ERROR_FILE, "memory is out for the page");
    free(text);
    if (status)
        complain(line->verb, "%s", error.message);
    else if (!line->quiet && strcmp(path, "-") != 0)
        remark(line->verb, "wrote %s", path);
    return status;
}

gough_status report_verb(int count, char **argument) {
    command_line line = command_line_read(&usage, count, argument);
    char *path = line.output ? strdup(line.output) : default_output(line.file[0]);
    gough_status status = path ? check_path(line.verb, path) : GOUGH_ERROR_FILE;
    if (!status && page_template().length == 0) {
        complain(line.verb,
                 "this gough was built without the page; configure with -DGOUGH_PAGE=ON");
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) {
        json_t *data = json_object(), *studies = json_array();
        json_object_set_new(data, "format", json_integer(1));
        json_object_set_new(data, "version", json_string(GOUGH_VERSION));
        json_object_set(data, "studies", studies);
        status = add_studies(&line, studies);
        if (status <= GOUGH_ERROR_NUMERICAL) {
            const gough_status written = write_page(&line, data, path);
            if (written) status = written;
        }
        json_decref(studies);
        json_decref(data);
    }
    free(path);
    command_line_free(&line);
    return status;
}
