/* gough tune: which stiffness of the feedback, and which damping, keep the platform within an accuracy; or why none does. */
#define _GNU_SOURCE
#include "cli/tune/tune_report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/option_values.h"
#include "cli/common/progress.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/run/run_report.h"
#include "cli/tune/tune_gains.h"

enum { WITHOUT, WITH, BOTH };

/* What gough tune is asked for; NaN: not said. */
typedef struct tune_line {
    command_line line;
    struct tune_options {
        double deviation, angle, ratio, margin; /* the angle in degrees */
        double from, to;                        /* of the stiffness */
        bool bounded;                           /* whether those two were said */
        int feedforward;                        /* of those below */
    } tune;
    gains_options gains; /* instead of a search */
    int threads;
    const char *title;
} tune_line;

/* ---- options ------------------------------------------------------------------------------------------------------ */

/* A number in the range that is described by `range`. */
static double read_asked(const struct argp_state *state, const option *o, const char *text,
                         double least, double below, const char *range) {
    double value = NAN;
    if (!read_decimal(text, text + strlen(text), &value) || value < least || value >= below)
        usage_error(state, "--%s takes a number %s; got '%s'", o->name, range, text);
    return value;
}

static void read_deviation(const struct argp_state *state, const option *o, const char *text,
                           void *group) {
    struct tune_options *tune = group;
    tune->deviation = read_asked(state, o, text, 1e-300, INFINITY, "greater than 0");
}

static void read_angle(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    struct tune_options *tune = group;
    tune->angle = read_asked(state, o, text, 1e-300, INFINITY, "greater than 0");
}

static void read_ratio(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    struct tune_options *tune = group;
    tune->ratio = read_asked(state, o, text, 0, 1, "from 0 to less than 1");
}

static void read_margin(const struct argp_state *state, const option *o, const char *text,
                        void *group) {
    struct tune_options *tune = group;
    tune->margin = read_asked(state, o, text, 0, 0.5000001, "from 0 to 0.5");
}

static void read_feedforward(const struct argp_state *state, const option *o, const char *text,
                             void *group) {
    static const char *const choice[] = {"none", "program", "both"};
    struct tune_options *tune = group;
    int c = 0;
    while (c < 3 && strcmp(text, choice[c]) != 0) c++;
    if (c == 3)
        usage_error(state, "--%s takes program, none or both; got '%s'", o->name, text);
    else
        tune->feedforward = c;
}

static void read_stiffness(const struct argp_state *state, const option *o, const char *text,
                           void *group) {
    struct tune_options *tune = group;
    gough_error error = {0};
    (void)o;
    tune->bounded = true;
    if (!read_span(text, &tune->from, &tune->to, &error)) usage_error(state, "%s", error.message);
}

static void begin_tune(void *group) {
    struct tune_options *tune = group;
    *tune = (struct tune_options){NAN, NAN, NAN, NAN, 0, 0, false, BOTH};
}

static const option tune_option[] = {
    {.name = "deviation",
     .value = "X",
     .read = read_deviation,
     .text = "greatest distance from the program allowed, in the study's unit of length "
             "(required, but for --poles and --lqr)"},
    {.name = "angle-deviation",
     .value = "X",
     .read = read_angle,
     .text =
         "greatest angle from the program allowed, in the study's unit of angle (default: any)"},
    {.name = "damping-ratio",
     .value = "Z",
     .read = read_ratio,
     .text = "choose the damping too, so that the least damped mode at home has this ratio, "
             "0 <= Z < 1 (default: the study's damping)"},
    {.name = "feedforward",
     .value = "program|none|both",
     .choices = "program none both",
     .read = read_feedforward,
     .text = "tune with the program's forces fed forward, without them, or both ways (default: "
             "both); the study's own choice is ignored"},
    {.name = "margin",
     .value = "M",
     .read = read_margin,
     .text = "margin to instability below and above G, as a fraction of G (default: 0.02)"},
    {.name = "stiffness",
     .value = "A:B",
     .read = read_stiffness,
     .text = "range of G to search; A = 0 stands for a quarter of the threshold at rest (default: "
             "from there to 1e6 F/R_b, where F is the largest force that weight, motion and "
             "disturbances cause, and further if that can help)"},
    {0}};

static const option_group tune_group = {tune_option, begin_tune, NULL};

static const group_use groups[] = {
    USES(tune_group, tune_line, tune, NULL),
    USES(gains_group, tune_line, gains, NULL),
    USES_OUTPUT("write the curve of deviation against stiffness to FILE, as data (.csv, .h5; - is "
                "CSV on standard output) or as a picture (.png, .svg, .pdf); may be given several "
                "times"),
    USES_JSON,
    USES_SETTINGS,
    USES(threads_group, tune_line, threads, NULL),
    USES(title_group, tune_line, title, "heading of the picture (default: the study's title)"),
    USES_DIMENSIONLESS("print results in units of R_b, M and sqrt(R_b/g)"),
    {0}};

/* ---- outputs ------------------------------------------------------------------------------------------------------ */

static gough_status write_outputs(const tune_line *asked, const tune_report *report, FILE *stream) {
    const command_line *line = &asked->line;
    gough_error error = {0};
    gough_status status = GOUGH_OK;
    gough_table *table = line->outputs.count ? tune_table(report) : NULL;
    if (line->outputs.count && !table)
        status = gough_fail(&error, GOUGH_ERROR_FILE, "out of memory");
    const gough_table *const tables[] = {table};
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        const char *path = line->outputs.word[i];
        gough_figure figure = gough_figure_default();
        figure.kind = "tuning";
        figure.title = asked->title;
        fflush(stdout);
        interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, i);
        status = is_data(path) ? gough_table_write(table, report->study->text, path, &error)
                               : gough_figure_draw(&figure, tables, NULL, 1, path, &error);
        if (!status && stream && strcmp(path, "-") != 0) print_line(stream, "wrote %s", path);
    }
    if (status) complain(line->verb, "%s", error.message);
    gough_table_free(table);
    return status;
}

/* ---- the search --------------------------------------------------------------------------------------------------- */

typedef struct watch {
    progress bar;
    const command_line *line;
    const tune_report *report;
    int done, all;       /* searches */
    double meets, fails; /* as told last */
} watch;

/* What is known so far of one setting of the feed-forward: "G = 5 N/m meets the deviation, G = 4 N/m does not". */
static void bracket_words(const tune_report *report, const tune_choice *choice, char *text,
                          size_t size) {
    const gough_units *u = &report->units;
    const double unit = gough_unit_factor(u, GOUGH_UNIT_STIFFNESS);
    const char *word = unit_word(u, GOUGH_UNIT_STIFFNESS);
    const gough_tuning *tuning = &choice->tuning;
    char fails[80] = "";
    if (tuning->fails > 0) snprintf(fails, sizeof fails, "G = %.6g%s", tuning->fails * unit, word);
    if (tuning->stiffness > 0)
        snprintf(text, size, "G = %.6g%s meets the deviation%s%s%s", tuning->stiffness * unit, word,
                 *fails ? ", " : "", fails, *fails ? " does not" : "");
    else if (*fails)
        snprintf(text, size, "no G up to %s meets the deviation", fails + strlen("G = "));
    else
        snprintf(text, size, "nothing is known yet");
}

/* What Ctrl-C will say: the best so far. */
static void keep_sentence(watch *w) {
    char before[200] = "", now[200];
    const tune_choice *choice = &w->report->choice[w->done];
    if (w->done > 0) {
        char first[160];
        bracket_words(w->report, &w->report->choice[0], first, sizeof first);
        snprintf(before, sizeof before, "with feed-forward %s; ", first);
    }
    bracket_words(w->report, choice, now, sizeof now);
    interrupt_says(w->line->verb,
                   "stopped before the end; nothing was written. Best so far: %s%s feed-forward %s "
                   "(stability not checked)",
                   before, choice->feedforward ? "with" : "without", now);
}

static int look(void *context, double part) {
    watch *w = context;
    const gough_tuning *tuning = &w->report->choice[w->done].tuning;
    const bool same =
        tuning->stiffness <= w->meets && tuning->stiffness >= w->meets &&
        (isnan(tuning->fails) ? isnan(w->fails)
                              : tuning->fails <= w->fails && tuning->fails >= w->fails);
    progress_update(&w->bar, w->done + part);
    if (same) return 0;
    w->meets = tuning->stiffness;
    w->fails = tuning->fails;
    keep_sentence(w);
    return 0;
}

static gough_status search(const command_line *line, tune_report *report, gough_error *error) {
    const gough_study *study = report->study;
    watch w = {.bar = progress_begin(line->verb, report->choices, line->quiet),
               .line = line,
               .report = report,
               .all = report->choices,
               .fails = NAN};
    gough_tuning_options options = report->asked;
    size_t bytes = 0;
    options.units = &study->units; /* of the library's sentences */
    options.progress = look;
    options.context = &w;
    gough_status status = gough_tune_size(study->model, &options, &bytes, error);
    void *memory = status ? NULL : aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!status && !memory) status = gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    for (; w.done < report->choices && !status; w.done++) {
        tune_choice *choice = &report->choice[w.done];
        choice->point = calloc(GOUGH_TUNING_POINTS, sizeof *choice->point);
        if (!choice->point) status = gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
        choice->tuning.fails = NAN;
        w.meets = 0;
        w.fails = NAN;
        keep_sentence(&w);
        if (!status)
            status = gough_tune(study->model, &study->simulation, choice->feedforward, &options,
                                choice->point, &choice->tuning, memory, error);
    }
    progress_end(&w.bar);
    free(memory);
    return status;
}

/* ---- the verb ----------------------------------------------------------------------------------------------------- */

static gough_tuning_options asked_of(const tune_line *line, const gough_units *units) {
    gough_tuning_options asked = gough_tuning_options_default();
    asked.deviation = gough_unit_read(units, GOUGH_UNIT_LENGTH, line->tune.deviation);
    if (isfinite(line->tune.angle))
        asked.angle_deviation = gough_unit_read(units, GOUGH_UNIT_ANGLE, line->tune.angle);
    asked.damping_ratio = line->tune.ratio;
    if (isfinite(line->tune.margin)) asked.margin = line->tune.margin;
    if (line->tune.bounded) {
        asked.least = gough_unit_read(units, GOUGH_UNIT_STIFFNESS, line->tune.from);
        asked.greatest = gough_unit_read(units, GOUGH_UNIT_STIFFNESS, line->tune.to);
    }
    asked.threads = line->threads;
    return asked;
}

/* Where none is found the reasons are on standard error, whatever else is printed. */
static gough_status explain(const command_line *line, const tune_report *report) {
    gough_status status = GOUGH_OK;
    for (int c = 0; c < report->choices; c++) {
        const tune_choice *choice = &report->choice[c];
        if (choice->tuning.found) continue;
        complain(line->verb, "%s: %s feed-forward: %s", report->study->name,
                 choice->feedforward ? "with" : "without", choice->tuning.reason);
        status = GOUGH_ERROR_NUMERICAL;
    }
    return status;
}

static gough_status tell(const tune_line *asked, tune_report *report) {
    const command_line *line = &asked->line;
    FILE *stream = line->quiet || line->json ? NULL : writes_standard(line) ? stderr : stdout;
    tune_scale(report);
    if (stream) tune_print(stream, report);
    const int failed = line->json ? tune_print_json(report) : 0;
    const gough_status written = write_outputs(asked, report, stream);
    const gough_status found = explain(line, report);
    if (failed) return GOUGH_ERROR_FILE;
    return written ? written : found;
}

/* A formula that is not finite depends on no G: the study is refused as simulate refuses it, with the formula's place. GOUGH_OK
 * where some run does not meet one. */
static gough_status refuse_formulas(const tune_report *report, gough_error *error) {
    gough_status status = GOUGH_OK;
    gough_model *model = malloc(sizeof *model);
    gough_simulation simulation = report->study->simulation;
    simulation.method = GOUGH_DOP853; /* a fixed step may be too long for such a G */
    simulation.step = 0;
    simulation.tolerance = 1e-6;
    simulation.precision = GOUGH_DOUBLE;
    if (!model) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    for (int c = 0; c < report->choices; c++) {
        const tune_choice *choice = &report->choice[c];
        const gough_tuning *tuning = &choice->tuning;
        gough_end end;
        status = GOUGH_OK;
        if (tuning->found || tuning->points == 0) break;
        const gough_tuning_point *last = &choice->point[tuning->points - 1];
        if (last->cause != GOUGH_END_NOT_FINITE) break;
        *model = *report->study->model;
        model->control.feedforward = choice->feedforward;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            model->control.stiffness[v] = last->stiffness;
            model->control.damping[v] = last->damping;
        }
        status = gough_simulate(model, &simulation, NULL, NULL, &end, error);
        if (status != GOUGH_ERROR_INPUT) status = GOUGH_OK;
        if (!status) break;
    }
    free(model);
    return status;
}

static gough_status tune_study(const tune_line *asked, const gough_study *study) {
    const command_line *line = &asked->line;
    tune_report *report = calloc(1, sizeof *report);
    gough_error error = {.message = "out of memory"};
    gough_status status = report ? GOUGH_OK : GOUGH_ERROR_FILE;
    if (!status) {
        report->verb = line->verb;
        report->study = study;
        report->asked = asked_of(asked, &study->units);
        for (int with = 1; with >= 0; with--)
            if (asked->tune.feedforward == BOTH || (asked->tune.feedforward == WITH) == with)
                report->choice[report->choices++].feedforward = with != 0;
        status = gough_units_of_study(study, line->dimensionless, &report->units, &error);
    }
    if (!status) status = search(line, report, &error);
    if (!status) status = refuse_formulas(report, &error);
    if (status)
        complain_of(line->verb, study, &error);
    else
        status = tell(asked, report);
    for (int c = 0; report && c < 2; c++) free(report->choice[c].point);
    free(report);
    return status;
}

/* Options that say nothing together, or one that is missing. */
static const char *contradiction(const tune_line *asked) {
    const struct tune_options *tune = &asked->tune;
    if (!gains_asked(&asked->gains))
        return isnan(tune->deviation)
                   ? "--deviation is missing: how far from its program the platform may be, as in "
                     "--deviation 1e-3; or give --poles or --lqr for matrices of gains"
                   : NULL;
    if (isfinite(tune->deviation) || isfinite(tune->angle) || isfinite(tune->ratio) ||
        isfinite(tune->margin) || tune->bounded || tune->feedforward != BOTH)
        return "--poles and --lqr determine all gains without a search; --deviation, "
               "--angle-deviation, --damping-ratio, --feedforward, --margin and --stiffness are "
               "for searches and cannot be combined with them";
    if (asked->line.outputs.count)
        return "-o is for the curve of a search with --deviation; --poles and --lqr print their "
               "matrices on standard output, with --json as JSON";
    return gains_contradiction(&asked->gains);
}

static gough_status run(const void *given) {
    const tune_line *asked = given;
    const command_line *line = &asked->line;
    gough_study *study = NULL;
    gough_status status = GOUGH_OK;
    const char *wrong = contradiction(asked);
    if (wrong) {
        complain(line->verb, "%s", wrong);
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = check_data_and_pictures(line);
    if (!status) status = read_study(line, line->file.word[0], &study);
    if (!status)
        status = gains_asked(&asked->gains) ? gains_answer(line, &asked->gains, study)
                                            : tune_study(asked, study);
    gough_study_free(study);
    return status;
}

extern const command_verb tune_verb;
const command_verb tune_verb = {
    .name = "tune",
    .arguments = "STUDY",
    .sentence = "the least feedback stiffness for a given accuracy",
    .text =
        "Find the least stiffness G of the feedback, the same in all legs, with which the platform "
        "stays within --deviation of its program under the study's own disturbances, initial state "
        "and duration, and is stable.\vEach G is tested by a simulation of the nonlinear motion. "
        "The G chosen is stable, keeps the margin to resonance tongues, and is confirmed by a run "
        "with small steps; a G smaller by a ten-thousandth is not enough. The summary also gives "
        "the mode that limits G, the force and rate that the legs need, and how the deviation "
        "falls with G, with the exceptions. If no G is found, the reason is printed and the exit "
        "status is 1. Ctrl-C prints the best G found so far.\n\nWith --poles or --lqr nothing is "
        "searched: matrices G and D that couple the legs follow from the loop linearised at rest, "
        "and are printed as keys of the study.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(tune_line),
    .run = run};
