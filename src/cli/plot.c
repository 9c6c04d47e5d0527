/* gough plot: figures of results. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"

static const struct argp_option option[] = {
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write to FILE: .png, .svg or .pdf (default: the first result with .png)", 0},
    {"figure", OPTION_FIGURE, "KIND", 0, "which figure (default: what suits the results)", 0},
    {"columns", OPTION_COLUMNS, "A,B", 0, "draw these columns", 0},
    {"from", OPTION_FROM, "T", 0, "from this time", 0},
    {"to", OPTION_TO, "T", 0, "up to this time", 0},
    {"log", OPTION_LOG, NULL, 0, "magnitudes on a logarithmic axis", 0},
    {"label", OPTION_LABEL, "TEXT", 0,
     "what a result is called in the key; once for each, in order", 0},
    {"title", OPTION_TITLE, "TEXT", 0,
     "heading of the figure (default: the results' title, if they have one in common)", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "say nothing but what is wrong", 0},
    {0}};

/* --help ends with the kinds of figure there are. */
static char *list_kinds(int key, const char *text, void *input) {
    (void)input;
    if (key != ARGP_KEY_HELP_POST_DOC) return (char *)text;
    char *list = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&list, &length);
    if (!stream) return (char *)text;
    fputs("RESULT is a table that forces, simulate or sweep wrote, .h5 or .csv, or any CSV with a "
          "header "
          "row and a column t. "
          "Several results are compared in the same panels.\n\nKinds of figure:\n",
          stream);
    for (const char *const *kind = gough_figure_kinds(); *kind; kind++)
        fprintf(stream, "  %s\n", *kind);
    fclose(stream);
    return list;
}

static const verb_usage usage = {.verb = "plot",
                                 .option = option,
                                 .arguments = "RESULT...",
                                 .text = "Figures of results as PNG, SVG or PDF.\v-",
                                 .least_files = 1,
                                 .most_files = (size_t)-1,
                                 .help_filter = list_kinds};

/* "heave.h5" gives "heave.png". Allocated. */
static char *default_output(const char *result) {
    const char *slash = strrchr(result, '/'), *dot = strrchr(result, '.');
    const size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - result) : strlen(result);
    char *path = NULL;
    return asprintf(&path, "%.*s.png", (int)stem, result) < 0 ? NULL : path;
}

static gough_status draw(const command_line *line, gough_table **table) {
    gough_error error = {0};
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < line->files && !status; i++)
        status = gough_table_read(line->file[i], &table[i], &error);

    char *path = line->output ? strdup(line->output) : default_output(line->file[0]);
    const char **label = calloc(line->files, sizeof *label);
    if (!status && (!path || !label))
        status = gough_fail(&error, GOUGH_ERROR_FILE, "memory is out");
    if (!status) {
        for (size_t i = 0; i < line->labels; i++) label[i] = line->label[i];
        status = gough_figure_draw(&line->figure, (const gough_table *const *)table, label,
                                   line->files, path, &error);
    }
    if (status)
        complain(line->verb, "%s", error.message);
    else if (!line->quiet)
        remark(line->verb, "wrote %s", path);
    free(label);
    free(path);
    return status;
}

gough_status plot_verb(int count, char **argument) {
    command_line line = command_line_read(&usage, count, argument);
    gough_status status = GOUGH_ERROR_INPUT;
    gough_table **table = calloc(line.files, sizeof *table);
    if (!table) {
        complain(line.verb, "memory is out");
        status = GOUGH_ERROR_FILE;
    } else if (line.labels > line.files) {
        complain(line.verb, "%zu labels for %zu result%s", line.labels, line.files,
                 line.files == 1 ? "" : "s");
    } else {
        status = draw(&line, table);
        for (size_t i = 0; i < line.files; i++) gough_table_free(table[i]);
    }
    free(table);
    command_line_free(&line);
    return status;
}
