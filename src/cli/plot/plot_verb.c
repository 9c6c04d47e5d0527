/* gough plot: figures of results. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/memory.h"
#include "cli/common/option_values.h"
#include "cli/common/talk.h"

/* What gough plot is asked for. */
typedef struct plot_line {
    command_line line;
    struct plot_options {
        gough_figure figure;
        word_list label;
    } plot;
} plot_line;

static void begin_plot(void *group) {
    struct plot_options *plot = group;
    plot->figure = gough_figure_default();
}

static void end_plot(void *group) {
    struct plot_options *plot = group;
    free(plot->label.word);
}

static void add_label(const struct argp_state *state, const option *o, const char *text,
                      void *group) {
    struct plot_options *plot = group;
    (void)state, (void)o;
    word_list_add(&plot->label, text);
}

/* A double, a limit above 0. */
static void read_limit(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    double *limit = (double *)(void *)((char *)group + o->at);
    if (!read_decimal(text, text + strlen(text), limit) || !(*limit > 0))
        usage_error(state, "--%s takes a number above 0; got '%s'", o->name, text);
}

/* A double, a length on paper: in mm, or with mm, cm or in behind it. */
static void read_width(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    static const struct {
        const char *name;
        double size;
    } unit[] = {{"mm", 1.0}, {"cm", 10.0}, {"in", 25.4}};
    double *width = (double *)(void *)((char *)group + o->at), size = 1.0;
    size_t length = strlen(text);
    for (size_t i = 0; i < sizeof unit / sizeof *unit; i++) {
        if (length <= 2 || strcmp(text + length - 2, unit[i].name) != 0) continue;
        size = unit[i].size;
        length -= 2;
        break;
    }
    if (!read_decimal(text, text + length, width) || !(*width > 0))
        usage_error(state, "--%s takes a length above 0, such as 85mm, 8.5cm or 3.3in; got '%s'",
                    o->name, text);
    *width *= size;
}

#define FIGURE(member) offsetof(struct plot_options, figure.member)

static const option plot_option[] = {
    {.name = "figure",
     .value = "KIND",
     .choices = CHOICES_FIGURES,
     .read = read_word,
     .at = FIGURE(kind),
     .text = "kind of figure, one of those at the end of --help (default: the one that suits the "
             "results)"},
    {.name = "columns",
     .value = "A,B",
     .read = read_word,
     .at = FIGURE(columns),
     .text = "draw these columns, separated by commas"},
    {.name = "from",
     .value = "T",
     .read = read_time,
     .at = FIGURE(from),
     .text = "start at this time"},
    {.name = "to", .value = "T", .read = read_time, .at = FIGURE(to), .text = "end at this time"},
    {.name = "max-speed",
     .value = "V",
     .read = read_limit,
     .at = FIGURE(max_speed),
     .text = "limit of the leg rate that the figure duty draws (default: the study's, from HDF5)"},
    {.name = "max-force",
     .value = "F",
     .read = read_limit,
     .at = FIGURE(max_force),
     .text =
         "limit of the drive force that the figure duty draws (default: the study's, from HDF5)"},
    {.name = "log",
     .read = read_flag,
     .at = FIGURE(logarithmic),
     .text = "draw magnitudes on a logarithmic axis"},
    {.name = "style",
     .value = "STYLE",
     .read = read_word,
     .at = FIGURE(style),
     .text = "screen (default), or print: lines differ by dashes too and have their names at their "
             "ends"},
    {.name = "width",
     .value = "LENGTH",
     .read = read_width,
     .at = FIGURE(width),
     .text = "width of the figure, such as 85mm (default: 198mm; 264mm for two panels beside each "
             "other)"},
    {.name = "font",
     .value = "PT",
     .read = read_limit,
     .at = FIGURE(font),
     .text =
         "size of the text in points (default: 8.64; with --width 8); numbers on axes have 11/12 "
         "of it"},
    {.name = "dpi",
     .value = "N",
     .read = read_limit,
     .at = FIGURE(dpi),
     .text = "dots per inch of a PNG (default: 200)"},
    {.name = "split",
     .read = read_flag,
     .at = FIGURE(split),
     .text =
         "draw a panel for each leg, all with one scale (figures forces, lengths, rates, power)"},
    {.name = "difference",
     .read = read_flag,
     .at = FIGURE(difference),
     .text = "draw how the second and each further result differ from the first, row by row"},
    {.name = "label",
     .value = "TEXT",
     .many = true,
     .read = add_label,
     .text = "name of a result in the key; give one for each result, in order"},
    {0}};

static const option_group plot_group = {plot_option, begin_plot, end_plot};

/* --help ends with the kinds of figure there are. */
static char *list_kinds(int key, const char *text, void *input) {
    (void)input;
    if (key != ARGP_KEY_HELP_POST_DOC) return (char *)text;
    char *list = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&list, &length);
    if (!stream) return (char *)text;
    fprintf(stream, "%s\n\nKinds of figure:\n", text);
    for (const char *const *kind = gough_figure_kinds(); *kind; kind++)
        fprintf(stream, "  %s\n", *kind);
    fclose(stream);
    return list;
}

static gough_status read_tables(const command_line *line, const gough_figure *figure,
                                gough_table **table) {
    gough_error error = {0};
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < line->file.count && !status; i++)
        status = gough_figure_read(figure, line->file.word[i], &table[i], &error);
    if (status) complain(line->verb, "%s", error.message);
    return status;
}

/* What can be known before the results are read. */
static gough_status check_paths(const command_line *line) {
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        const char *path = line->outputs.word[i], *ending = strrchr(path, '.');
        if (!ending || (strcasecmp(ending, ".png") != 0 && strcasecmp(ending, ".svg") != 0 &&
                        strcasecmp(ending, ".pdf") != 0)) {
            complain(line->verb, "-o needs a name that ends in .png, .svg or .pdf; '%s' does not",
                     path);
            return GOUGH_ERROR_INPUT;
        }
        status = check_folder(line->verb, path);
        if (!status)
            status = check_overwriting(line->verb, path, line->file.word, line->file.count);
    }
    return status ? status : check_distinct(line);
}

static gough_status draw(const command_line *line, const struct plot_options *plot,
                         gough_table **table) {
    gough_error error = {0};
    gough_status status = read_tables(line, &plot->figure, table);
    const char **label = allocate(line->file.count * sizeof *label);
    for (size_t i = 0; i < line->file.count; i++)
        label[i] = i < plot->label.count ? plot->label.word[i] : NULL;
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        const char *path = line->outputs.word[i];
        interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, i);
        status = gough_figure_draw(&plot->figure, (const gough_table *const *)table, label,
                                   line->file.count, path, &error);
        if (status)
            complain(line->verb, "%s", error.message);
        else if (!line->quiet)
            remark(line->verb, "wrote %s", path);
    }
    free(label);
    return status;
}

static gough_status check_labels(const command_line *line, size_t labels) {
    const size_t files = line->file.count;
    if (labels <= files) return GOUGH_OK;
    complain(line->verb, "%zu labels are given for %zu result%s", labels, files,
             files == 1 ? "" : "s");
    return GOUGH_ERROR_INPUT;
}

static gough_status run(const void *given) {
    const plot_line *asked = given;
    command_line line = asked->line;
    const char *beside[1];
    char *path = NULL;
    gough_status status = check_labels(&line, asked->plot.label.count);
    if (status) return status;
    if (line.outputs.count == 0) {
        path = output_beside(line.file.word[0], ".png", "figure.png");
        if (!path) out_of_memory();
        beside[0] = path;
        line.outputs = (word_list){beside, 1};
    }
    status = check_paths(&line);
    if (!status) {
        gough_table **table = calloc(line.file.count, sizeof *table);
        if (!table) out_of_memory();
        status = draw(&line, &asked->plot, table);
        for (size_t i = 0; i < line.file.count; i++) gough_table_free(table[i]);
        free(table);
    }
    free(path);
    return status;
}

static const group_use groups[] = {
    USES_OUTPUT("write to FILE: .png, .svg or .pdf (default: the first result with .png); may be "
                "given several times"),
    USES(plot_group, plot_line, plot, NULL),
    USES(title_group, plot_line, plot.figure.title,
         "heading of the figure (default: the title that the results share, if they do)"),
    {0}};

extern const command_verb plot_verb;
const command_verb plot_verb = {
    .name = "plot",
    .arguments = "RESULT...",
    .sentence = "figures as PNG, SVG or PDF",
    .text =
        "Draw results as PNG, SVG or PDF.\vRESULT is a table written by forces, simulate, sweep or "
        "tune, .h5 or .csv, or any CSV with a header row and a column t. Several results are "
        "compared in the same panels.",
    .endings = "h5 csv",
    .least_files = 1,
    .most_files = (size_t)-1,
    .groups = groups,
    .size = sizeof(plot_line),
    .run = run,
    .help_filter = list_kinds};
