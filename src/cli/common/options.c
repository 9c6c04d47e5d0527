/* The options of the command line. Each verb has its own table of options; one function reads them all. */
#define _GNU_SOURCE
#include "cli/common/command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_COUNTED = 100000000 };

typedef struct reader {
    const verb_usage *usage;
    command_line *line;
} reader;

/* KEY=VALUE; the copy lives as long as the options */
static void read_setting(struct argp_state *state, command_line *line, const char *text) {
    const char *equal = strchr(text, '=');
    if (!equal || equal == text)
        usage_error(state, "--set takes KEY=VALUE, as in --set control.stiffness=50; got '%s'",
                    text);
    else {
        char *key = strndup(text, (size_t)(equal - text));
        if (!key) {
            complain(line->verb, "out of memory");
            exit(GOUGH_ERROR_FILE);
        }
        line->settings[line->setting_count++] = (gough_setting){.key = key, .value = equal + 1};
    }
}

static double read_time(struct argp_state *state, const char *option, const char *text) {
    double value = NAN;
    if (!read_decimal(text, text + strlen(text), &value))
        usage_error(state, "%s takes a number, a time as in column t; got '%s'", option, text);
    return value;
}

/* A whole number of 1 or more. */
static size_t read_count(struct argp_state *state, const char *option, const char *text) {
    size_t value = 0;
    const size_t digits = strspn(text, "0123456789");
    for (size_t i = 0; i < digits && value < MOST_COUNTED; i++)
        value = 10 * value + (size_t)(text[i] - '0');
    if (digits == 0 || text[digits] || value < 1 || value > MOST_COUNTED)
        usage_error(state, "%s takes a whole number of 1 or more; got '%s'", option, text);
    return value;
}

/* "3/8" */
static void read_shard(struct argp_state *state, command_line *line, const char *text) {
    char part[16] = "";
    const char *slash = strchr(text, '/');
    if (!slash || slash == text || (size_t)(slash - text) >= sizeof part)
        usage_error(state, "--shard takes i/n, as in --shard 3/8; got '%s'", text);
    else {
        memcpy(part, text, (size_t)(slash - text));
        line->shard = read_count(state, "--shard", part);
        line->shards = read_count(state, "--shard", slash + 1);
        if (line->shard > line->shards)
            usage_error(state, "--shard i/n takes an i from 1 to n; got '%s'", text);
    }
}

/* An axis of a stability map; the second is one of three. */
static void read_map_axis(struct argp_state *state, command_line *line, int key, const char *text) {
    static const char *const name[] = {"sweep-stiffness", "sweep-amplitude", "sweep-frequency",
                                       "sweep-damping"};
    axis_values *axis = key == OPTION_SWEEP_STIFFNESS ? &line->stiffness : &line->second;
    gough_error error = {0};
    if (axis->key && axis->key != key)
        usage_error(state, "a map has at most two axes: --sweep-stiffness and one of "
                           "--sweep-amplitude, --sweep-frequency and --sweep-damping");
    if (!read_axis(name[key - OPTION_SWEEP_STIFFNESS], text, axis, &error))
        usage_error(state, "%s", error.message);
    axis->key = key;
}

static void read_pose_option(struct argp_state *state, command_line *line, const char *text) {
    gough_error error = {0};
    line->posed = true;
    if (!read_pose(text, line->pose, &error)) usage_error(state, "%s", error.message);
}

/* A number of an option of gough tune, in the range that is described by `range`. */
static double read_asked(struct argp_state *state, const char *option, const char *text,
                         double least, double below, const char *range) {
    double value = NAN;
    if (!read_decimal(text, text + strlen(text), &value) || value < least || value >= below)
        usage_error(state, "%s takes a number %s; got '%s'", option, range, text);
    return value;
}

static void read_feedforward(struct argp_state *state, command_line *line, const char *text) {
    static const char *const choice[] = {"none", "program", "both"};
    line->tuning.feedforward = -1;
    for (int c = 0; c < 3; c++)
        if (strcmp(text, choice[c]) == 0) line->tuning.feedforward = c;
    if (line->tuning.feedforward < 0)
        usage_error(state, "--feedforward takes program, none or both; got '%s'", text);
}

static void read_stiffness(struct argp_state *state, command_line *line, const char *text) {
    gough_error error = {0};
    line->tuning.bounded = true;
    if (!read_span(text, &line->tuning.from, &line->tuning.to, &error))
        usage_error(state, "%s", error.message);
}

/* Reads an option of gough tune; false if it is not one of them. */
static bool read_tuning(int key, const char *text, struct argp_state *state, command_line *line) {
    tuning_request *t = &line->tuning;
    switch (key) {
    case OPTION_DEVIATION:
        t->deviation = read_asked(state, "--deviation", text, 1e-300, INFINITY, "greater than 0");
        return true;
    case OPTION_ANGLE_DEVIATION:
        t->angle = read_asked(state, "--angle-deviation", text, 1e-300, INFINITY,
                              "greater than 0, in degrees");
        return true;
    case OPTION_DAMPING_RATIO:
        t->ratio = read_asked(state, "--damping-ratio", text, 0, 1, "from 0 to less than 1");
        return true;
    case OPTION_MARGIN:
        t->margin = read_asked(state, "--margin", text, 0, 0.5000001, "from 0 to 0.5");
        return true;
    case OPTION_FEEDFORWARD:
        read_feedforward(state, line, text);
        return true;
    case OPTION_STIFFNESS:
        read_stiffness(state, line, text);
        return true;
    default:
        return false;
    }
}

static bool is_standard_input(const char *path) {
    return strcmp(path, "-") == 0 || strcmp(path, "/dev/stdin") == 0 ||
           strcmp(path, "/dev/fd/0") == 0 || strcmp(path, "/proc/self/fd/0") == 0;
}

/* The second reader of standard input would find it empty. */
static void refuse_twice(struct argp_state *state, const command_line *line, const char *path) {
    for (size_t i = 0; is_standard_input(path) && i < line->files; i++)
        if (is_standard_input(line->file[i]))
            usage_error(state, "standard input can be read only once; it is given as '%s' and '%s'",
                        line->file[i], path);
}

static error_t read_option(int key, char *text, struct argp_state *state) {
    reader *reading = state->input;
    command_line *o = reading->line;
    switch (key) {
    case OPTION_OUTPUT:
        o->output = o->outputs[o->output_count++] = text;
        break;
    case OPTION_QUIET:
        o->quiet = true;
        break;
    case OPTION_JSON:
        o->json = true;
        break;
    case OPTION_SET:
        read_setting(state, o, text);
        break;
    case OPTION_REACTIONS:
        o->reactions = true;
        break;
    case OPTION_ALL:
        o->all = true;
        break;
    case OPTION_DIMENSIONLESS:
        o->dimensionless = true;
        break;
    case OPTION_PRECISION:
        if (strcmp(text, "double") == 0)
            o->precision = GOUGH_DOUBLE;
        else if (strcmp(text, "quad") == 0)
            o->precision = GOUGH_QUADRUPLE;
        else
            usage_error(state, "--precision takes double or quad; got '%s'", text);
        break;
    case OPTION_FIGURE:
        o->figure.kind = text;
        break;
    case OPTION_COLUMNS:
        o->figure.columns = text;
        break;
    case OPTION_FROM:
        o->figure.from = read_time(state, "--from", text);
        break;
    case OPTION_TO:
        o->figure.to = read_time(state, "--to", text);
        break;
    case OPTION_LOG:
        o->figure.logarithmic = true;
        break;
    case OPTION_TITLE:
        o->figure.title = text;
        break;
    case OPTION_LABEL:
        o->label[o->labels++] = text;
        break;
    case OPTION_THREADS:
        o->threads = (int)read_count(state, "--threads", text);
        break;
    case OPTION_LANES:
        o->lanes = (int)read_count(state, "--lanes", text);
        break;
    case OPTION_SHARD:
        read_shard(state, o, text);
        break;
    case OPTION_RUN:
        o->one_run = read_count(state, "--run", text);
        break;
    case OPTION_POSE:
        read_pose_option(state, o, text);
        break;
    case OPTION_MATRIX:
        o->matrix = true;
        break;
    case OPTION_AT:
        o->at = read_time(state, "--at", text);
        break;
    case OPTION_SWEEP_STIFFNESS:
    case OPTION_SWEEP_AMPLITUDE:
    case OPTION_SWEEP_FREQUENCY:
    case OPTION_SWEEP_DAMPING:
        read_map_axis(state, o, key, text);
        break;
    case ARGP_KEY_ARG:
        refuse_twice(state, o, text);
        if (o->files == reading->usage->most_files)
            usage_error(state, "too many arguments, starting with '%s'", text);
        o->file[o->files++] = text;
        break;
    case ARGP_KEY_END:
        if (o->files < reading->usage->least_files)
            usage_error(state, "%s is missing", reading->usage->arguments);
        break;
    default:
        return read_tuning(key, text, state, o) ? 0 : ARGP_ERR_UNKNOWN;
    }
    return 0;
}

command_line command_line_read(const verb_usage *usage, int count, char **argument) {
    const size_t room = (size_t)count + 1;
    command_line o = {.verb = usage->verb,
                      .precision = GOUGH_DOUBLE,
                      .settings = calloc(room, sizeof *o.settings),
                      .file = calloc(room, sizeof *o.file),
                      .label = calloc(room, sizeof *o.label),
                      .outputs = calloc(room, sizeof *o.outputs),
                      .at = NAN,
                      .tuning = {NAN, NAN, NAN, NAN, 0, 0, false, 2},
                      .figure = gough_figure_default()};
    if (!o.settings || !o.file || !o.label || !o.outputs) {
        complain(usage->verb, "out of memory");
        exit(GOUGH_ERROR_FILE);
    }
    reader reading = {.usage = usage, .line = &o};
    const struct argp argp = {.options = usage->option,
                              .parser = read_option,
                              .args_doc = usage->arguments,
                              .doc = usage->text,
                              .help_filter = usage->help_filter};
    refuse_strange_option(&argp, count, argument);
    argp_parse(&argp, count, argument, 0, NULL, &reading);
    return o;
}

void command_line_free(command_line *o) {
    for (size_t i = 0; i < o->setting_count; i++) free((void *)o->settings[i].key);
    free(o->settings);
    free(o->file);
    free(o->label);
    free(o->outputs);
}
