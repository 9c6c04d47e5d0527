/* gough tune: which stiffness of the feedback, and which damping, keep the platform within an accuracy; or why none does. */
#define _GNU_SOURCE
#include "cli/tune/tune_report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/common/scale.h"
#include "cli/run/run_report.h"

static const double DEGREES = 57.295779513082320877;

static const struct argp_option option[] = {
    {"deviation", OPTION_DEVIATION, "X", 0,
     "greatest distance from the program allowed, in the study's unit of length (required)", 0},
    {"angle-deviation", OPTION_ANGLE_DEVIATION, "DEG", 0,
     "greatest angle from the program allowed, in degrees (default: any)", 0},
    {"damping-ratio", OPTION_DAMPING_RATIO, "Z", 0,
     "choose the damping too, so that the least damped mode at home has this ratio, 0 <= Z < 1 "
     "(default: the study's damping)",
     0},
    {"feedforward", OPTION_FEEDFORWARD, "program|none|both", 0,
     "tune with the program's forces fed forward, without them, or both ways (default: both); the "
     "study's own choice is ignored",
     0},
    {"margin", OPTION_MARGIN, "M", 0,
     "margin to instability below and above G, as a fraction of G (default: 0.02)", 0},
    {"stiffness", OPTION_STIFFNESS, "A:B", 0,
     "range of G to search; A = 0 stands for a quarter of the threshold at rest (default: from "
     "there to 1e6 F/R_b, where F is the largest force that weight, motion and disturbances cause, "
     "and further if that can help)",
     0},
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write the curve of deviation against stiffness to FILE, as data (.csv, .h5; - is CSV on "
     "standard output) or as a picture (.png, .svg, .pdf); may be given several times",
     0},
    {"json", OPTION_JSON, NULL, 0, "print the results as JSON", 0},
    {"set", OPTION_SET, "KEY=VALUE", 0,
     "override a key of the study, as in --set load.mass=2; may be repeated", 0},
    {"threads", OPTION_THREADS, "N", 0, "threads (default: one for each processor)", 0},
    {"title", OPTION_TITLE, "TEXT", 0, "heading of the picture (default: the study's title)", 0},
    {"dimensionless", OPTION_DIMENSIONLESS, NULL, 0,
     "print results in units of R_b, M and sqrt(R_b/g)", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "print errors only", 0},
    {0}};

static const verb_usage usage = {
    .verb = "tune",
    .option = option,
    .arguments = "STUDY",
    .text =
        "Find the least stiffness G of the feedback, the same in all legs, with which the platform "
        "stays within --deviation of its program under the study's own disturbances, initial state "
        "and duration, and is stable.\vEach G is tested by a simulation of the nonlinear motion. "
        "The G chosen is stable, keeps the margin to resonance tongues, and is confirmed by a run "
        "with small steps; a G smaller by a ten-thousandth is not enough. The summary also gives "
        "the mode that limits G, the force and rate that the legs need, and how the deviation "
        "falls with G, with the exceptions. If no G is found, the reason is printed and the exit "
        "status is 1. Ctrl-C prints the best G found so far.",
    .least_files = 1,
    .most_files = 1};

/* ---- outputs ------------------------------------------------------------------------------------------------------ */

static bool ends_in(const char *path, const char *const *ending) {
    const char *dot = strrchr(path, '.');
    for (; dot && *ending; ending++)
        if (strcasecmp(dot, *ending) == 0) return true;
    return false;
}

static bool is_data(const char *path) {
    static const char *const ending[] = {".csv", ".h5", NULL};
    return strcmp(path, "-") == 0 || ends_in(path, ending);
}

static bool is_picture(const char *path) {
    static const char *const ending[] = {".png", ".svg", ".pdf", NULL};
    return ends_in(path, ending);
}

/* What can be known before the work. */
static gough_status check_outputs(const command_line *line) {
    for (size_t i = 0; i < line->output_count; i++) {
        const char *path = line->outputs[i];
        const bool standard = strcmp(path, "-") == 0;
        if (!is_data(path) && !is_picture(path)) {
            complain(line->verb,
                     "-o takes a name that ends in .csv or .h5 (data) or in .png, .svg or .pdf "
                     "(picture), or - for CSV on standard output; '%s' does not",
                     path);
            return GOUGH_ERROR_INPUT;
        }
        if (standard && line->json) {
            complain(line->verb, "'-o -' and --json both write to standard output; give -o a file");
            return GOUGH_ERROR_INPUT;
        }
        const gough_status status = standard ? GOUGH_OK : check_folder(line->verb, path);
        if (status) return status;
    }
    return GOUGH_OK;
}

static gough_status write_outputs(const command_line *line, const tune_report *report,
                                  FILE *stream) {
    gough_error error = {0};
    gough_status status = GOUGH_OK;
    gough_table *table = line->output_count ? tune_table(report) : NULL;
    if (line->output_count && !table)
        status = gough_fail(&error, GOUGH_ERROR_FILE, "out of memory");
    const gough_table *const tables[] = {table};
    for (size_t i = 0; i < line->output_count && !status; i++) {
        const char *path = line->outputs[i];
        gough_figure figure = gough_figure_default();
        figure.kind = "tuning";
        figure.title = line->figure.title;
        fflush(stdout);
        interrupt_outputs(line->verb, line->outputs, line->output_count, i);
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
    const double unit = scale_factor(u, DIMENSION_STIFFNESS);
    const char *word = unit_words_of(u)->stiffness;
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

/* The library's sentences have numbers in the study's own units. */
static const unit_words *words_of_study(const gough_study *study) {
    gough_units own = {.dimensionless = true};
    (void)gough_units_of_study(study, false, &own, NULL);
    return unit_words_of(&own);
}

static gough_status search(const command_line *line, tune_report *report, gough_error *error) {
    const gough_study *study = report->study;
    watch w = {.bar = progress_begin(line->verb, report->choices, line->quiet),
               .line = line,
               .report = report,
               .all = report->choices,
               .fails = NAN};
    gough_tuning_options options = report->asked;
    const unit_words *own = words_of_study(study);
    size_t bytes = 0;
    options.length_unit = own->length;
    options.time_unit = own->time;
    options.stiffness_unit = own->stiffness;
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

static gough_tuning_options asked_of(const command_line *line) {
    gough_tuning_options asked = gough_tuning_options_default();
    asked.deviation = line->tuning.deviation;
    if (isfinite(line->tuning.angle)) asked.angle_deviation = line->tuning.angle / DEGREES;
    asked.damping_ratio = line->tuning.ratio;
    if (isfinite(line->tuning.margin)) asked.margin = line->tuning.margin;
    if (line->tuning.bounded) {
        asked.least = line->tuning.from;
        asked.greatest = line->tuning.to;
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

static gough_status tell(const command_line *line, tune_report *report) {
    bool standard = false;
    for (size_t i = 0; i < line->output_count; i++)
        standard = standard || strcmp(line->outputs[i], "-") == 0;
    FILE *stream = line->quiet || line->json ? NULL : standard ? stderr : stdout;
    tune_scale(report);
    if (stream) tune_print(stream, report);
    const int failed = line->json ? tune_print_json(report) : 0;
    const gough_status written = write_outputs(line, report, stream);
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

static gough_status tune_study(const command_line *line, const gough_study *study) {
    tune_report *report = calloc(1, sizeof *report);
    gough_error error = {.message = "out of memory"};
    gough_status status = report ? GOUGH_OK : GOUGH_ERROR_FILE;
    if (!status) {
        report->verb = line->verb;
        report->study = study;
        report->asked = asked_of(line);
        for (int with = 1; with >= 0; with--)
            if (line->tuning.feedforward == 2 || line->tuning.feedforward == with)
                report->choice[report->choices++].feedforward = with != 0;
        status = gough_units_of_study(study, line->dimensionless, &report->units, &error);
    }
    if (!status) status = search(line, report, &error);
    if (!status) status = refuse_formulas(report, &error);
    if (status)
        complain_of(line->verb, study, error.message);
    else
        status = tell(line, report);
    for (int c = 0; report && c < 2; c++) free(report->choice[c].point);
    free(report);
    return status;
}

gough_status tune_verb(int count, char **argument) {
    command_line line = command_line_read(&usage, count, argument);
    gough_study *study = NULL;
    gough_status status = GOUGH_OK;
    if (isnan(line.tuning.deviation)) {
        complain(line.verb, "--deviation is missing: how far from its program the platform may "
                            "be, as in --deviation 1e-3");
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = check_outputs(&line);
    if (!status) status = read_study(&line, &study);
    if (!status) status = tune_study(&line, study);
    gough_study_free(study);
    command_line_free(&line);
    return status;
}
