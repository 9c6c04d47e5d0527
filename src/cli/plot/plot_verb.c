/* gough plot: figures of results. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/common/command.h"

static const struct argp_option option[] = {
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write to FILE: .png, .svg or .pdf (default: the first result with .png); may be given "
     "several "
     "times",
     0},
    {"figure", OPTION_FIGURE, "KIND", 0,
     "kind of figure, one of those below (default: the one that suits the results)", 0},
    {"columns", OPTION_COLUMNS, "A,B", 0, "draw these columns, separated by commas", 0},
    {"from", OPTION_FROM, "T", 0, "start at this time", 0},
    {"to", OPTION_TO, "T", 0, "end at this time", 0},
    {"log", OPTION_LOG, NULL, 0, "draw magnitudes on a logarithmic axis", 0},
    {"label", OPTION_LABEL, "TEXT", 0,
     "name of a result in the key; give one for each result, in order", 0},
    {"title", OPTION_TITLE, "TEXT", 0,
     "heading of the figure (default: the title that the results share, if they do)", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "print errors only", 0},
    {0}};

/* --help ends with the kinds of figure there are. */
static char *list_kinds(int key, const char *text, void *input) {
    (void)input;
    if (key != ARGP_KEY_HELP_POST_DOC) return (char *)text;
    char *list = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&list, &length);
    if (!stream) return (char *)text;
    fputs("RESULT is a table written by forces, simulate, sweep or tune, .h5 or .csv, or any CSV "
          "with a header row and a column t. Several results are compared in the same "
          "panels.\n\nKinds of figure:\n",
          stream);
    for (const char *const *kind = gough_figure_kinds(); *kind; kind++)
        fprintf(stream, "  %s\n", *kind);
    fclose(stream);
    return list;
}

static const verb_usage usage = {.verb = "plot",
                                 .option = option,
                                 .arguments = "RESULT...",
                                 .text = "Draw results as PNG, SVG or PDF.\v-",
                                 .least_files = 1,
                                 .most_files = (size_t)-1,
                                 .help_filter = list_kinds};

static gough_status read_tables(const command_line *line, gough_table **table) {
    gough_error error = {0};
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < line->files && !status; i++)
        status = gough_table_read(line->file[i], &table[i], &error);
    if (status) complain(line->verb, "%s", error.message);
    return status;
}

/* What can be known before the results are read. */
static gough_status check_paths(const command_line *line) {
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < line->output_count && !status; i++) {
        const char *path = line->outputs[i], *ending = strrchr(path, '.');
        if (!ending || (strcasecmp(ending, ".png") != 0 && strcasecmp(ending, ".svg") != 0 &&
                        strcasecmp(ending, ".pdf") != 0)) {
            complain(line->verb, "-o needs a name that ends in .png, .svg or .pdf; '%s' does not",
                     path);
            return GOUGH_ERROR_INPUT;
        }
        status = check_folder(line->verb, path);
        if (!status) status = check_overwriting(line->verb, path, line->file, line->files);
    }
    return status ? status : check_distinct(line);
}

static gough_status draw(const command_line *line, gough_table **table) {
    gough_error error = {0};
    gough_status status = read_tables(line, table);
    const char **label = calloc(line->files, sizeof *label);
    if (!status && !label) {
        complain(line->verb, "out of memory");
        status = GOUGH_ERROR_FILE;
    }
    for (size_t i = 0; label && i < line->labels; i++) label[i] = line->label[i];
    for (size_t i = 0; i < line->output_count && !status; i++) {
        interrupt_outputs(line->verb, line->outputs, line->output_count, i);
        status = gough_figure_draw(&line->figure, (const gough_table *const *)table, label,
                                   line->files, line->outputs[i], &error);
        if (status)
            complain(line->verb, "%s", error.message);
        else if (!line->quiet)
            remark(line->verb, "wrote %s", line->outputs[i]);
    }
    free(label);
    return status;
}

gough_status plot_verb(int count, char **argument) {
    command_line line = command_line_read(&usage, count, argument);
    gough_status status = GOUGH_ERROR_FILE;
    char *path = line.output_count ? NULL : output_beside(line.file[0], ".png", "figure.png");
    gough_table **table = calloc(line.files, sizeof *table);
    if (path) line.outputs[line.output_count++] = path;
    if (!table || line.output_count == 0) {
        complain(line.verb, "out of memory");
    } else if (line.labels > line.files) {
        complain(line.verb, "%zu labels are given for %zu result%s", line.labels, line.files,
                 line.files == 1 ? "" : "s");
        status = GOUGH_ERROR_INPUT;
    } else {
        status = check_paths(&line);
        if (!status) status = draw(&line, table);
        for (size_t i = 0; i < line.files; i++) gough_table_free(table[i]);
    }
    free(table);
    free(path);
    command_line_free(&line);
    return status;
}
