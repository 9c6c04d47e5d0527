/* gough sweep: many runs of a study with other numbers. gough merge: the table of their shards. */
#define _GNU_SOURCE
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "cli/common/command.h"
#include "cli/sweep/sweep_report.h"

static const struct argp_option sweep_option[] = {
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write the table to FILE: .h5 or .csv by its ending; - is CSV on standard output; may be "
     "given several times",
     0},
    {"json", OPTION_JSON, NULL, 0, "print the summary as JSON", 0},
    {"set", OPTION_SET, "KEY=VALUE", 0,
     "override a key of the study, as in --set sweep.runs=100; may be repeated", 0},
    {"threads", OPTION_THREADS, "N", 0, "threads (default: one for each processor)", 0},
    {"lanes", OPTION_LANES, "N", 0,
     "runs computed side by side by one thread: 1, 2, 4 or 8 (default: as many as the processor "
     "supports)",
     0},
    {"shard", OPTION_SHARD, "I/N", 0,
     "run the I-th of N parts into a FILE whose name ends in .shard, for gough merge", 0},
    {"run", OPTION_RUN, "N", 0,
     "print the values of run N as options for gough simulate, without running anything", 0},
    {"dimensionless", OPTION_DIMENSIONLESS, NULL, 0,
     "print table and summary in units of R_b, M and sqrt(R_b/g) of the study as written", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "print errors only", 0},
    {0}};

static const verb_usage sweep_usage = {
    .verb = "sweep",
    .option = sweep_option,
    .arguments = "STUDY",
    .text = "Run a study many times with different numbers: the section 'sweep' of STUDY lists the "
            "numbers that vary, over grids, lists or distributions.\vThe table has one row for "
            "each run: the swept values, the final state, the largest deviations, forces, speeds "
            "and powers, and how the run ended. Its bytes are the same for any number of threads, "
            "lanes and shards. Finished runs are kept in FILE.part until the sweep is complete; if "
            "it is stopped or killed, the same command resumes it. A run that ends early does not "
            "stop the others. Runs whose values do not make a valid study are marked invalid, and "
            "the exit status is then 1.",
    .least_files = 1,
    .most_files = 1};

static const struct argp_option merge_option[] = {
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write the table to FILE: .h5 or .csv by its ending; - is CSV on standard output; may be "
     "given several times",
     0},
    {"json", OPTION_JSON, NULL, 0, "print the summary as JSON", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "print errors only", 0},
    {0}};

static const verb_usage merge_usage = {
    .verb = "merge",
    .option = merge_option,
    .arguments = "SHARD...",
    .text = "Join the shards of a sweep into one table, with the same bytes as that of the whole "
            "sweep.\vThe shards may be given in any order. All must be present and belong to the "
            "same sweep.",
    .least_files = 1,
    .most_files = (size_t)-1};

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
static gough_status print_run(const command_line *line, const gough_sweep *sweep) {
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    if (line->one_run > gough_sweep_runs(sweep)) {
        complain(line->verb, "there is no run %zu: the sweep has %zu runs", line->one_run,
                 gough_sweep_runs(sweep));
        return GOUGH_ERROR_INPUT;
    }
    double *value = calloc(keys, sizeof *value);
    if (!value) {
        complain(line->verb, "out of memory");
        return GOUGH_ERROR_FILE;
    }
    gough_sweep_values(sweep, line->one_run, value);
    int failed = 0;
    if (line->json)
        failed = sweep_print_run_json(sweep, line->one_run, value);
    else
        for (size_t k = 0; k < keys; k++) {
            char text[GOUGH_SWEEP_TEXT];
            gough_sweep_print(value[k], text);
            printf("%s--set %s=%s", k ? " " : "", key[k].path, text);
        }
    if (!line->json && sweep_numbers_noise(sweep))
        printf(" --set disturbance.noise.run=%zu", line->one_run);
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
    if (gough_sweep_make(maker, run, &study, &error) == GOUGH_OK &&
        gough_simulate(study->model, &study->simulation, NULL, NULL, &end, &error) ==
            GOUGH_ERROR_INPUT) {
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
    for (size_t i = 0; i < line->output_count; i++)
        if (strcmp(line->outputs[i], "-") != 0) return line->outputs[i];
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

static gough_status print_summary(const command_line *line, const sweep_report *report) {
    if (line->json) return sweep_print_json(report) ? GOUGH_ERROR_FILE : GOUGH_OK;
    if (!line->quiet) sweep_print(writes_standard(line) ? stderr : stdout, report);
    return GOUGH_OK;
}

static size_t runs_of_shard(const command_line *line, size_t runs) {
    if (!line->shards) return runs;
    return line->shard * runs / line->shards - (line->shard - 1) * runs / line->shards;
}

static gough_status run_sweep(const command_line *line, const gough_sweep *sweep) {
    const gough_study *study = gough_sweep_study(sweep);
    const size_t runs = runs_of_shard(line, gough_sweep_runs(sweep));
    progress bar = progress_begin(line->verb, (double)runs, line->quiet);
    bar.counted = "runs";
    bar.first = -1;
    gough_sweep_options options = gough_sweep_options_default();
    options.threads = line->threads;
    options.lanes = line->lanes;
    options.progress = look;
    options.context = &bar;
    const char **also = calloc(line->output_count + 1, sizeof *also);
    gough_sweep_output output = {.path = kept_file(line),
                                 .dimensionless = line->dimensionless,
                                 .shard = line->shard,
                                 .shards = line->shards,
                                 .also = also};
    for (size_t i = 0; also && i < line->output_count; i++)
        if (line->outputs[i] != output.path) also[output.also_count++] = line->outputs[i];
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
    report.output = line->outputs;
    report.outputs = line->output_count;
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
    status = print_summary(line, &report);
    explain_invalid(line, sweep, &report.summary);
    if (!line->quiet) explain_not_finite(line, sweep, &report.summary);
    if (status == GOUGH_OK && report.summary.ended[GOUGH_END_INVALID])
        status = GOUGH_ERROR_NUMERICAL;
    return status;
}

gough_status sweep_verb(int count, char **argument) {
    command_line line = command_line_read(&sweep_usage, count, argument);
    gough_study *study = NULL;
    gough_sweep *sweep = NULL;
    gough_status status = GOUGH_OK;
    if (line.shards && !line.output) {
        complain(line.verb, "--shard needs -o FILE.shard");
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = check_output(&line, line.shards ? ".shard" : NULL);
    if (!status) status = read_study(&line, &study);
    if (!status) status = read_sweep(&line, study, &sweep);
    if (!status) status = line.one_run ? print_run(&line, sweep) : run_sweep(&line, sweep);
    gough_sweep_free(sweep);
    gough_study_free(study);
    command_line_free(&line);
    if (stopped_by) { /* who waits for this process, a shell's loop say, sees what ended it */
        fflush(NULL);
        signal(stopped_by, SIG_DFL);
        raise(stopped_by);
    }
    return status;
}

/* ---- merge -------------------------------------------------------------------------------------------------------- */

gough_status merge_verb(int count, char **argument) {
    command_line line = command_line_read(&merge_usage, count, argument);
    sweep_report report = {.verb = line.verb};
    gough_error error = {0};
    struct rlimit files;
    gough_status status = GOUGH_OK;
    if (!line.output) {
        complain(line.verb, "-o FILE is missing; it names the table to write");
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = check_output(&line, NULL);
    for (size_t i = 0; i < line.output_count && !status; i++)
        status = check_overwriting(line.verb, line.outputs[i], line.file, line.files);
    if (getrlimit(RLIMIT_NOFILE, &files) == 0) { /* all shards are open at once */
        files.rlim_cur = files.rlim_max;
        (void)setrlimit(RLIMIT_NOFILE, &files);
    }
    if (!status) {
        for (size_t i = 0; i < line.output_count && !status; i++) {
            interrupt_outputs(line.verb, line.outputs, line.output_count, i);
            status =
                gough_sweep_merge(line.file, line.files, line.outputs[i], &report.summary, &error);
        }
        if (status) complain(line.verb, "%s", error.message);
    }
    if (!status) {
        report.output = line.outputs;
        report.outputs = line.output_count;
        report.units = report.summary.units;
        status = print_summary(&line, &report);
        if (!status && report.summary.ended[GOUGH_END_INVALID]) {
            complain(line.verb, "%zu of %zu runs are invalid; the first is run %zu",
                     report.summary.ended[GOUGH_END_INVALID], report.summary.runs,
                     report.summary.first_invalid);
            status = GOUGH_ERROR_NUMERICAL;
        }
    }
    command_line_free(&line);
    return status;
}
