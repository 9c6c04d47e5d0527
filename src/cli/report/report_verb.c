/* gough report: studies as one HTML page that needs nothing but a browser. */
#define _GNU_SOURCE
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/json.h"
#include "cli/common/memory.h"
#include "cli/common/talk.h"
#include "cli/report/page_study.h"

typedef struct report_line {
    command_line common;
    struct report_options {
        page_options page;
        word_list label;
    } report;
} report_line;

static void end_report(void *group) {
    struct report_options *report = group;
    free(report->label.word);
}

static void add_label(const struct argp_state *state, const option *o, const char *text,
                      void *group) {
    struct report_options *report = group;
    (void)state, (void)o;
    word_list_add(&report->label, text);
}

static const option report_option[] = {
    {.name = "thin",
     .read = read_flag,
     .at = offsetof(struct report_options, page.thin),
     .text = "write pose, rates and forces only; the page computes the other columns and has no "
             "accelerations"},
    {.name = "label",
     .value = "TEXT",
     .many = true,
     .read = add_label,
     .text = "name of a study on the page, in place of its title; give one for each study, in "
             "order"},
    {0}};
static const option_group report_group = {.option = report_option, .end = end_report};

/* What can be known before the studies are run. */
static gough_status check_path(const char *verb, const char *path) {
    const char *ending = strrchr(path, '.');
    if (strcmp(path, "-") == 0) return GOUGH_OK;
    if (!ending || strcasecmp(ending, ".html") != 0) {
        complain(verb,
                 "-o needs a name that ends in .html, or - for standard output; '%s' does not",
                 path);
        return GOUGH_ERROR_INPUT;
    }
    return check_folder(verb, path);
}

/* Every study into the list; the worst status, GOUGH_ERROR_NUMERICAL where runs ended early. */
static gough_status add_studies(const command_line *line, const struct report_options *options,
                                json_t *studies) {
    gough_status worst = GOUGH_OK;
    for (size_t i = 0; i < line->file.count && worst <= GOUGH_ERROR_NUMERICAL; i++) {
        gough_study *study = NULL;
        json_t *object = NULL;
        gough_status status = read_study(line, line->file.word[i], &study);
        if (!status) status = page_study(line, &options->page, study, &object);
        if (object && i < options->label.count)
            json_object_set_new(object, "label", json_words(options->label.word[i]));
        if (object) json_array_append_new(studies, object);
        gough_study_free(study);
        if (status > worst) worst = status;
    }
    return worst;
}

static gough_status write_pages(const command_line *line, json_t *data) {
    const gough_page_template page = page_template();
    gough_error error = {0};
    char *text = json_dumps(data, JSON_COMPACT | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(17));
    gough_status status = GOUGH_OK;
    if (!text) status = gough_fail(&error, GOUGH_ERROR_FILE, "out of memory");
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        const char *path = line->outputs.word[i];
        interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, i);
        status = gough_page_write(&page, text, strlen(text), path, &error);
        if (!status && !line->quiet && strcmp(path, "-") != 0) remark(line->verb, "wrote %s", path);
    }
    if (status) complain(line->verb, "%s", error.message);
    free(text);
    return status;
}

static gough_status check_paths(const command_line *line, size_t labels) {
    const size_t files = line->file.count;
    gough_status status = GOUGH_OK;
    if (labels > files) {
        complain(line->verb, "%zu labels are given for %zu stud%s", labels, files,
                 files == 1 ? "y" : "ies");
        return GOUGH_ERROR_INPUT;
    }
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        status = check_path(line->verb, line->outputs.word[i]);
        if (!status)
            status = check_overwriting(line->verb, line->outputs.word[i], line->file.word,
                                       line->file.count);
    }
    if (!status) status = check_distinct(line);
    if (!status && page_template().length == 0) {
        complain(line->verb,
                 "this gough was built without the page; configure with -DGOUGH_PAGE=ON");
        status = GOUGH_ERROR_INPUT;
    }
    return status;
}

static gough_status run_and_write(const command_line *line, const struct report_options *options) {
    json_t *data = json_object(), *studies = json_array();
    json_object_set_new(data, "format", json_integer(1));
    json_object_set_new(data, "version", json_string(GOUGH_VERSION));
    json_object_set(data, "studies", studies);
    gough_status status = add_studies(line, options, studies);
    if (status <= GOUGH_ERROR_NUMERICAL) {
        const gough_status written = write_pages(line, data);
        if (written) status = written;
    }
    json_decref(studies);
    json_decref(data);
    return status;
}

static gough_status run(const void *given) {
    const report_line *whole = given;
    command_line line = whole->common;
    const char *beside[1];
    char *path = NULL;
    if (line.outputs.count == 0) {
        path = output_beside(line.file.word[0], ".html", "report.html");
        if (!path) out_of_memory();
        beside[0] = path;
        line.outputs = (word_list){beside, 1};
    }
    gough_status status = check_paths(&line, whole->report.label.count);
    interrupt_outputs(line.verb, line.outputs.word, line.outputs.count, 0);
    if (!status) status = run_and_write(&line, &whole->report);
    free(path);
    return status;
}

static const group_use groups[] = {
    USES_OUTPUT("write to FILE, whose name ends in .html (default: the first study with .html); "
                "may be given several times"),
    USES(report_group, report_line, report, NULL),
    USES_SETTINGS,
    {0}};

extern const command_verb report_verb;
const command_verb report_verb = {
    .name = "report",
    .arguments = "STUDY...",
    .sentence = "everything about a study on one HTML page",
    .text =
        "Write studies as one HTML page: the machine moving in 3D, curves, numbers, and a live "
        "simulation.\vSTUDY is a study file, or - for standard input; several are compared. The "
        "page is one file that needs no network, so it can be sent by e-mail and opened in any "
        "browser. If a run ends early, the page shows when and why, and the exit status is 1.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 64,
    .groups = groups,
    .size = sizeof(report_line),
    .run = run};
