/* What forces and simulate share: read the study, run it, keep the table, say what came out. */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/common/talk.h"
#include "cli/run/growth.h"
#include "cli/run/loop_warnings.h"
#include "cli/run/run_report.h"
#include "cli/run/run_study.h"

/* ---- options ------------------------------------------------------------------------------------------------------ */

static void read_precision(const struct argp_state *state, const option *o, const char *text,
                           void *group) {
    run_options *run = group;
    (void)o;
    if (strcmp(text, "double") == 0)
        run->precision = GOUGH_DOUBLE;
    else if (strcmp(text, "quad") == 0)
        run->precision = GOUGH_QUADRUPLE;
    else
        usage_error(state, "--precision takes double or quad; got '%s'", text);
}

static const option run_option[] = {{.name = "precision",
                                     .value = "double|quad",
                                     .choices = "double quad",
                                     .read = read_precision,
                                     .text = "compute with 16 or 33 digits (default: double)"},
                                    {.name = "reactions",
                                     .read = read_flag,
                                     .at = offsetof(run_options, reactions),
                                     .text = "add the constraint reactions to the table"},
                                    {.name = "joints",
                                     .read = read_flag,
                                     .at = offsetof(run_options, joints),
                                     .text = "add leg forces, forces at the joints and side loads "
                                             "to the table"},
                                    {0}};

const option_group run_group = {run_option, NULL, NULL};

/* ---- the run ------------------------------------------------------------------------------------------------------ */

/* Rows on their way into table and summary. */
typedef struct running {
    gough_result *result; /* NULL: no table wanted */
    run_report *report;
    progress progress;
    bool memory_out;
} running;

static int take_row(void *context, const gough_row *row) {
    running *run = context;
    progress_update(&run->progress, row->value[GOUGH_T]);
    if (run->result && gough_result_add(run->result, row) != 0) run->memory_out = true;
    return run->memory_out;
}

static void take_crossing(void *context, const gough_crossing *crossing) {
    crossing_list *c = &((running *)context)->report->crossings;
    if (c->count == c->room) {
        const size_t room = c->room ? 2 * c->room : 16;
        gough_crossing *list = realloc(c->list, room * sizeof *list);
        if (!list) {
            c->incomplete = true;
            return;
        }
        c->list = list;
        c->room = room;
    }
    c->list[c->count++] = *crossing;
}

static int by_beginning(const void *left, const void *right) {
    const gough_crossing *a = left, *b = right;
    if (a->enter < b->enter || a->enter > b->enter) return a->enter < b->enter ? -1 : 1;
    return a->leg != b->leg ? a->leg - b->leg : a->component - b->component;
}

/* Says why a run ended; the table and the summary are the answer, this is the reason for the exit code. */
static void explain_end(const command_line *line, const run_report *report) {
    if (report->end.cause == GOUGH_END_DONE) return;
    complain_at(line->verb, report->study->name, report->end.message);
}

static gough_status write_tables(const command_line *line, const gough_result *result) {
    gough_error error = {0};
    gough_status status = GOUGH_OK;
    fflush(stdout);
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, i);
        status = gough_result_write(result, line->outputs.word[i], &error);
    }
    if (status) complain(line->verb, "%s", error.message);
    return status;
}

static gough_status print_summary(const command_line *line, const run_report *report) {
    const bool standard = writes_standard(line);
    if (line->json) return run_report_print_json(report) ? GOUGH_ERROR_FILE : GOUGH_OK;
    if (!line->quiet) run_report_print(standard ? stderr : stdout, report);
    return GOUGH_OK;
}

gough_status run_report_fill(run_report *report, const command_line *line, gough_result *result,
                             gough_error *error) {
    const gough_study *study = report->study;
    gough_simulation simulation = study->simulation;

    running run = {.report = report, .result = result};
    gough_summary_begin(&report->summary); /* where the run is refused */
    simulation.summary = &report->summary;
    simulation.statistics = &report->statistics;
    run.progress = progress_begin(line->verb, simulation.duration, line->quiet);
    const gough_status status =
        report->simulated
            ? gough_simulate(study->model, &simulation, take_row, &run, &report->end, error)
            : gough_forces(study->model, &simulation, take_row, &run, take_crossing, &run,
                           &report->end, error);
    progress_end(&run.progress);
    /* they come when they are over */
    if (report->crossings.count)
        qsort(report->crossings.list, report->crossings.count, sizeof *report->crossings.list,
              by_beginning);
    if (result) {
        const gough_end end = run_report_end(report);
        gough_result_set_end(result, &end);
    }
    if (run.memory_out)
        return gough_fail(error, GOUGH_ERROR_FILE,
                          "not enough memory for the table; a longer simulation.output_step "
                          "needs less");
    if (report->crossings.incomplete)
        return gough_fail(error, GOUGH_ERROR_FILE,
                          "not enough memory for the list of exceeded limits");
    return status;
}

static gough_status run_and_report(const command_line *line, run_report *report) {
    const gough_study *study = report->study;
    gough_error error = {0};
    gough_status status = gough_units_of_study(study, line->dimensionless, &report->units, &error);
    if (status) {
        complain_of(line->verb, study, &error);
        return status;
    }
    gough_result *result = NULL;
    if (line->outputs.count && !(result = gough_result_new(study, line->verb, &report->units))) {
        complain(line->verb, "out of memory");
        return GOUGH_ERROR_FILE;
    }
    if (report->simulated) loop_warnings(line->verb, study);
    if (report->simulated && !line->quiet) remark_growth(line->verb, study, &report->units);

    interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, 0);
    status = run_report_fill(report, line, result, &error);
    if (status == GOUGH_ERROR_FILE) {
        complain(line->verb, "%s", error.message);
    } else if (status == GOUGH_OK || status == GOUGH_ERROR_NUMERICAL) {
        run_report_scale(report);
        const gough_status written = result ? write_tables(line, result) : GOUGH_OK;
        report->output = line->outputs.word;
        report->outputs = written ? 0 : line->outputs.count;
        const gough_status printed = print_summary(line, report);
        if (!line->quiet) remark_stiffness(line->verb, report);
        explain_end(line, report);
        if (written || printed) status = written ? written : printed;
    } else {
        complain_of(line->verb, study, &error);
    }
    gough_result_free(result);
    return status;
}

gough_status run_study(const run_line *run, bool simulated) {
    command_line own = run->line;
    const command_line *line = &own;
    lengths_settings start = {.value = {""}};
    run_report report = {.verb = line->verb, .simulated = simulated, .all = run->all};
    gough_study *study = NULL;
    gough_status status = check_output(line, NULL);
    if (!status) status = read_study_at(&own, line->file.word[0], &run->start, &start, &study);
    if (!status) {
        study->simulation.reactions |= run->run.reactions; /* tables have columns by these too */
        study->simulation.joints |= run->run.joints;
        study->simulation.actuators |= run->run.actuators;
        if (run->run.precision == GOUGH_QUADRUPLE) study->simulation.precision = GOUGH_QUADRUPLE;
        report.study = study;
        status = run_and_report(line, &report);
    }
    free(report.crossings.list);
    gough_study_free(study);
    lengths_settings_free(&start);
    return status;
}
