/* gough sweep: many runs of a study with other numbers. */
#define _GNU_SOURCE
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/common/from_lengths.h"
#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/common/talk.h"
#include "cli/sweep/sweep_crew.h"
#include "cli/sweep/sweep_report.h"

/* What gough sweep is asked for. */
typedef struct sweep_line {
    command_line line;
    int threads, lanes;
    struct sweep_part {
        size_t shard, shards, one_run; /* 0: not asked for */
    } part;
    lengths_asked start;
    struct sweep_kind {
        bool forces, sizing;
    } kind;
} sweep_line;

/* ---- options ------------------------------------------------------------------------------------------------------ */

/* "3/8" */
static void read_shard(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    struct sweep_part *p = group;
    char first[16] = "";
    const char *slash = strchr(text, '/');
    if (!slash || slash == text || (size_t)(slash - text) >= sizeof first) {
        usage_error(state, "--shard takes i/n, as in --shard 3/8; got '%s'", text);
        return;
    }
    memcpy(first, text, (size_t)(slash - text));
    p->shard = read_count(state, o->name, first);
    p->shards = read_count(state, o->name, slash + 1);
    if (p->shard > p->shards)
        usage_error(state, "--shard i/n takes an i from 1 to n; got '%s'", text);
}

static void read_run(const struct argp_state *state, const option *o, const char *text,
                     void *group) {
    struct sweep_part *p = group;
    p->one_run = read_count(state, o->name, text);
}

static const option part_option[] = {
    {.name = "shard",
     .value = "I/N",
     .read = read_shard,
     .text = "run the I-th of N parts into a FILE whose name ends in .shard, for gough merge"},
    {.name = "run",
     .value = "N",
     .read = read_run,
     .text = "print the values of run N as options for gough simulate and gough forces, without "
             "running anything"},
    {0}};

static const option kind_option[] = {
    {.name = "forces",
     .read = read_flag,
     .at = offsetof(struct sweep_kind, forces),
     .text = "compute the forces along the program, as gough forces does, in place of a "
             "simulation"},
    {.name = "sizing",
     .read = read_flag,
     .at = offsetof(struct sweep_kind, sizing),
     .text =
         "add what sizes the legs to the table: lengths, swings, RMS force, loads of joints and "
         "guides, losses, what holds at rest"},
    {0}};

static const option_group kind_group = {kind_option, NULL, NULL};
static const option_group part_group = {part_option, NULL, NULL};

static const group_use groups[] = {
    USES_OUTPUT(TABLE_OUTPUT),
    USES_JSON,
    USES_SETTINGS,
    USES(threads_group, sweep_line, threads, NULL),
    USES(lanes_group, sweep_line, lanes,
         "runs computed side by side by one thread: 1, 2, 4 or 8 (default: as many as the "
         "processor supports)"),
    USES(part_group, sweep_line, part, NULL),
    USES(lengths_group, sweep_line, start,
         "start each run in the pose of these six leg lengths, joint to joint, in the unit of the "
         "study, that is joined to home, as initial has it"),
    USES(kind_group, sweep_line, kind, NULL),
    USES_DIMENSIONLESS(
        "print table and summary in units of R_b, M and sqrt(R_b/g) of the study as written"),
    {0}};

/* ---- stopping ----------------------------------------------------------------------------------------------------- */

static volatile sig_atomic_t stopped_by;

static void note_signal(int number) { stopped_by = number; }

/* The first signal stops the sweep in order, the second ends the process. */
static void watch_signals(void) {
    struct sigaction action = {.sa_handler = note_signal, .sa_flags = (int)SA_RESETHAND};
    struct sigaction before;
    sigemptyset(&action.sa_mask);
    const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(numbers[i], &action, NULL);
}

static int look(void *context, size_t done) {
    progress *p = context;
    if (p->first < 0) p->first = (double)done; /* what the file had; now the clock runs */
    progress_update(p, (double)done);
    return stopped_by != 0;
}

/* ---- sweep -------------------------------------------------------------------------------------------------------- */

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* "--set load.mass=2 --set …", or the same as JSON. */
static gough_status print_run(const sweep_line *given, const gough_sweep *sweep) {
    const command_line *line = &given->line;
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    if (given->part.one_run > gough_sweep_runs(sweep)) {
        complain(line->verb, "there is no run %zu: the sweep has %zu runs", given->part.one_run,
                 gough_sweep_runs(sweep));
        return GOUGH_ERROR_INPUT;
    }
    double *value = calloc(keys, sizeof *value);
    if (!value) {
        complain(line->verb, "out of memory");
        return GOUGH_ERROR_FILE;
    }
    gough_sweep_values(sweep, given->part.one_run, value);
    int failed = 0;
    if (line->json)
        failed = sweep_print_run_json(sweep, given->part.one_run, value);
    else
        for (size_t k = 0; k < keys; k++) {
            char text[GOUGH_SWEEP_TEXT];
            gough_sweep_print(value[k], text);
            printf("%s--set %s=%s", k ? " " : "", key[k].path, text);
        }
    if (!line->json && sweep_numbers_noise(sweep))
        printf(" --set disturbance.noise.run=%zu", given->part.one_run);
    if (!line->json && sweep_numbers_samples(sweep))
        printf(" --set control.sampling.run=%zu", given->part.one_run);
    if (!line->json) putchar('\n');
    free(value);
    return failed ? GOUGH_ERROR_FILE : GOUGH_OK;
}

/* Which values were impossible, and why. */
static void explain_invalid(const command_line *line, const gough_sweep *sweep,
                            const gough_sweep_summary *summary) {
    const size_t invalid = summary->ended[GOUGH_END_INVALID];
    if (invalid == 0) return;
    gough_sweep_maker *maker = gough_sweep_maker_new(sweep);
    const gough_study *study;
    gough_error error = {.message = "out of memory"};
    if (maker) (void)gough_sweep_make(maker, summary->first_invalid, &study, &error);
    gough_sweep_maker_free(maker);
    char values[400];
    sweep_name_values(sweep, summary->first_invalid, values, sizeof values);
    complain(line->verb, "%zu of %zu runs %s invalid; the first is run %zu (%s): %s", invalid,
             summary->runs, invalid == 1 ? "is" : "are", summary->first_invalid, values,
             error.message);
}

/* Which runs met a formula that is not finite, and which one: the first of them is run again for its sentence. */
static void explain_not_finite(const command_line *line, const gough_sweep *sweep,
                               const gough_sweep_summary *summary) {
    const size_t ended = summary->ended[GOUGH_END_NOT_FINITE], run = summary->first_not_finite;
    const gough_study *study;
    gough_error error = {0};
    gough_end end;
    gough_sweep_maker *maker = ended ? gough_sweep_maker_new(sweep) : NULL;
    if (!maker) return;
    gough_status status = gough_sweep_make(maker, run, &study, &error);
    if (status == GOUGH_OK)
        status = summary->forces
                     ? gough_forces(study->model, &study->simulation, NULL, NULL, NULL, NULL, &end,
                                    &error)
                     : gough_simulate(study->model, &study->simulation, NULL, NULL, &end, &error);
    else
        status = GOUGH_OK;
    if (status == GOUGH_ERROR_INPUT) {
        char values[400], *place = place_of(gough_sweep_study(sweep), error.message);
        sweep_name_values(sweep, run, values, sizeof values);
        remark(line->verb, "%zu of %zu runs end%s early; the first is run %zu (%s): %s%s%s", ended,
               summary->runs, ended == 1 ? "s" : "", run, values, place ? place : "",
               place ? ": " : "", error.message);
        free(place);
    }
    gough_sweep_maker_free(maker);
}

/* The first output that is a file, in which name the runs done are kept; NULL: none. */
static const char *kept_file(const command_line *line) {
    for (size_t i = 0; i < line->outputs.count; i++)
        if (strcmp(line->outputs.word[i], "-") != 0) return line->outputs.word[i];
    return NULL;
}

static void explain_stop(const command_line *line, const gough_sweep_summary *summary,
                         size_t runs) {
    const char *kept = kept_file(line);
    if (summary->runs == 0)
        complain(line->verb, "stopped before the first of %zu runs was finished", runs);
    else if (kept)
        complain(line->verb,
                 "stopped: %zu of %zu runs are finished and kept in %s.part; the same command "
                 "resumes the sweep",
                 summary->runs, runs, kept);
    else
        complain(line->verb, "stopped after %zu of %zu runs; nothing is kept without -o FILE",
                 summary->runs, runs);
}

static size_t runs_of_shard(const struct sweep_part *p, size_t runs) {
    if (!p->shards) return runs;
    return p->shard * runs / p->shards - (p->shard - 1) * runs / p->shards;
}

static gough_status run_sweep(const sweep_line *given, const gough_sweep *sweep) {
    const command_line *line = &given->line;
    const gough_study *study = gough_sweep_study(sweep);
    const size_t runs = runs_of_shard(&given->part, gough_sweep_runs(sweep));
    progress bar = progress_begin(line->verb, (double)runs, line->quiet);
    bar.counted = "runs";
    bar.first = -1;
    gough_sweep_options options = gough_sweep_options_default();
    options.threads = given->threads;
    options.lanes = given->lanes;
    options.forces = given->kind.forces;
    options.sizing = given->kind.sizing;
    options.progress = look;
    options.context = &bar;
    const char **also = calloc(line->outputs.count + 1, sizeof *also);
    gough_sweep_output output = {.path = kept_file(line),
                                 .dimensionless = line->dimensionless,
                                 .shard = given->part.shard,
                                 .shards = given->part.shards,
                                 .also = also,
                                 .runner = the_crew.run};
    for (size_t i = 0; also && i < line->outputs.count; i++)
        if (line->outputs.word[i] != output.path) also[output.also_count++] = line->outputs.word[i];
    sweep_report report = {.verb = line->verb, .title = study->title, .sweep = sweep};
    gough_error error = {0};
    (void)gough_units_of_study(study, line->dimensionless, &report.units, NULL);
    watch_signals();
    const double started = seconds();
    fflush(stdout);
    gough_status status = also
                              ? gough_sweep_write(sweep, &options, &output, &report.summary, &error)
                              : gough_fail(&error, GOUGH_ERROR_FILE, "out of memory");
    free(also);
    report.time = seconds() - started;
    report.output = line->outputs.word;
    report.outputs = line->outputs.count;
    progress_end(&bar);
    if (status == GOUGH_ERROR_NUMERICAL && stopped_by) {
        explain_stop(line, &report.summary, runs);
        return status;
    }
    if (status != GOUGH_OK) {
        complain(line->verb, "%s", error.message);
        return status;
    }
    stopped_by = 0; /* too late: it is done */
    status = sweep_tell(line, &report);
    explain_invalid(line, sweep, &report.summary);
    if (!line->quiet) explain_not_finite(line, sweep, &report.summary);
    if (status == GOUGH_OK && report.summary.ended[GOUGH_END_INVALID])
        status = GOUGH_ERROR_NUMERICAL;
    return status;
}

/* A pose that follows from the machine of the study as written is that of no other machine. */
static gough_status check_start(const sweep_line *asked, const gough_sweep *sweep) {
    static const char *const joints[] = {"platform.base", "platform.top", "platform.height"};
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    for (size_t i = 0; asked->start.given && i < keys; i++) {
        for (size_t k = 0; k < sizeof joints / sizeof *joints; k++) {
            if (strncmp(key[i].path, joints[k], strlen(joints[k])) != 0) continue;
            complain(asked->line.verb,
                     "--lengths gives one pose, but the sweep varies %s, and with it the pose of "
                     "these lengths: give the start as initial, or leave out the key",
                     key[i].path);
            return GOUGH_ERROR_INPUT;
        }
    }
    return GOUGH_OK;
}

static gough_status run(const void *given) {
    sweep_line own = *(const sweep_line *)given, *const asked = &own;
    const command_line *line = &asked->line;
    lengths_settings start = {.value = {""}};
    gough_study *study = NULL;
    gough_sweep *sweep = NULL;
    gough_status status = GOUGH_OK;
    if (asked->part.shards && !line->outputs.count) {
        complain(line->verb, "--shard needs -o FILE.shard");
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = check_output(line, asked->part.shards ? ".shard" : NULL);
    if (!status) status = read_study_at(&own.line, line->file.word[0], &own.start, &start, &study);
    if (!status) status = read_sweep(line, study, &sweep);
    if (!status) status = check_start(asked, sweep);
    if (!status) status = asked->part.one_run ? print_run(asked, sweep) : run_sweep(asked, sweep);
    gough_sweep_free(sweep);
    gough_study_free(study);
    lengths_settings_free(&start);
    if (stopped_by) { /* who waits for this process, a shell's loop say, sees what ended it */
        fflush(NULL);
        signal(stopped_by, SIG_DFL);
        raise(stopped_by);
    }
    return status;
}

extern const command_verb sweep_verb;
const command_verb sweep_verb = {
    .name = "sweep",
    .arguments = "STUDY",
    .sentence = "run a study many times with different numbers",
    .text = "Run a study many times with different numbers: the section 'sweep' of STUDY lists the "
            "numbers that vary, over grids, lists or distributions.\vThe table has one row for "
            "each run: the swept values, the final state, the largest deviations, forces, speeds "
            "and powers, and how the run ended. Its bytes are the same for any number of threads, "
            "lanes and shards. Finished runs are kept in FILE.part until the sweep is complete; if "
            "it is stopped or killed, the same command resumes it. A run that ends early does not "
            "stop the others. Runs whose values do not make a valid study are marked invalid, and "
            "the exit status is then 1.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(sweep_line),
    .run = run};
