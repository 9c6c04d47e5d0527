/* gough stability: whether the closed loop holds the platform at rest and along a periodic program, what grows where it does not,
 * and from which stiffness each mode holds. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/json.h"
#include "cli/common/memory.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/stability/stability_report.h"

/* ---- options ----------------------------------------------------------------------------------------------------- */

static void read_pose_option(const struct argp_state *state, const option *o, const char *text,
                             void *group) {
    struct loop_options *loop = group;
    gough_error error = {0};
    (void)o;
    loop->posed = true;
    if (!read_pose("pose", text, loop->pose, &error)) usage_error(state, "%s", error.message);
}

static void begin_loop(void *group) {
    struct loop_options *loop = group;
    loop->at = NAN;
}

static const option loop_option[] = {
    {.name = "pose",
     .value = "C=X,...",
     .many = true,
     .read = read_pose_option,
     .text = "stability at rest in this pose, given by its components from home, as in "
             "heave=0.1,yaw=10; the program is ignored"},
    {.name = "matrix",
     .read = read_flag,
     .at = offsetof(struct loop_options, matrix),
     .text = "print only the matrix of the linearised loop at rest, as CSV: of rates, or from "
             "sample to sample if the controller is sampled; with --json, add it to the object"},
    {.name = "at",
     .value = "T",
     .read = read_time,
     .at = offsetof(struct loop_options, at),
     .text = "with --matrix: about the program at time T"},
    {0}};

static const option_group loop_group = {loop_option, begin_loop, NULL};

static const group_use groups[] = {
    USES_OUTPUT("write a map to FILE, as data (.csv, .h5; - is CSV on standard output) or as a "
                "picture (.png, .svg, .pdf); may be given several times"),
    USES_JSON,
    USES_SETTINGS,
    USES(loop_group, stability_line, loop, NULL),
    USES(lengths_group, stability_line, lengths,
         "stability at rest in the pose of these six leg lengths, joint to joint, in the unit of "
         "the "
         "study, that is joined to home; the program is ignored"),
    USES(map_group, stability_line, map, NULL),
    USES(threads_group, stability_line, threads, NULL),
    USES(lanes_group, stability_line, lanes,
         "points of a map computed side by side: 1, 2, 4 or 8 (default: as many as the processor "
         "supports)"),
    USES(title_group, stability_line, title, "heading of the picture (default: the study's title)"),
    USES_DIMENSIONLESS("print results in units of R_b, M and sqrt(R_b/g)"),
    {0}};

/* ---- units ------------------------------------------------------------------------------------------------------- */

/* A shift in lengths beside a rotation in radians; which of them is 1 stays so. */
static void scale_mode(gough_mode *mode, const gough_units *u) {
    double lead = 0;
    for (int a = 0; a < 6; a++)
        if (fabs(mode->shape[a][0] - 1.0) <= 0.0 && fabs(mode->shape[a][1]) <= 0.0 && !(lead > 0))
            lead = a < 3 ? gough_unit_size(u, GOUGH_UNIT_LENGTH) : 1.0;
    for (int a = 0; a < 6; a++)
        for (int part = 0; part < 2 && lead > 0; part++)
            mode->shape[a][part] *= lead / (a < 3 ? gough_unit_size(u, GOUGH_UNIT_LENGTH) : 1.0);
}

static const scaled_member rest_members[] = {
    SCALED(gough_rest, trace, STIFFNESS), SCALED(gough_rest, trace_theorem, STIFFNESS),
    SCALED(gough_rest, growth, RATE), SCALED(gough_rest, state.position, LENGTH)};

static const scaled_member eigenvalue_members[] = {SCALED(gough_eigenvalue, value, RATE)};

static const scaled_member threshold_members[] = {SCALED(gough_threshold, stiffness, STIFFNESS)};

static void scale_rest(gough_rest *rest, const gough_units *u) {
    SCALE(rest, rest_members, u);
    for (size_t i = 0; i < rest->size; i++) {
        SCALE(&rest->eigenvalue[i], eigenvalue_members, u);
        scale_mode(&rest->eigenvalue[i].mode, u);
    }
    for (int i = 0; i < 6; i++) {
        SCALE(&rest->threshold[i], threshold_members, u);
        scale_mode(&rest->threshold[i].mode, u);
    }
}

static void scale_sampled(gough_sampled_rest *rest, const gough_units *u) {
    for (size_t i = 0; i < rest->listed; i++) scale_mode(&rest->multiplier[i].mode, u);
}

static const scaled_member report_members[] = {SCALED(stability_report, arm, LENGTH),
                                               SCALED(stability_report, period.start, TIME),
                                               SCALED(stability_report, period.period, TIME)};

static const scaled_member floquet_members[] = {SCALED(stability_report, floquet.start, TIME),
                                                SCALED(stability_report, floquet.period, TIME)};

static const scaled_member along_members[] = {
    SCALED(stability_report, along.start, TIME), SCALED(stability_report, along.period, TIME),
    SCALED(stability_report, along.sampling, TIME), SCALED(stability_report, sag, LENGTH)};

/* From the study's units; a pose keeps the digits that it was given with. */
static void scale_pose(double pose[GOUGH_COMPONENTS], const gough_units *own,
                       const gough_units *u) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const gough_unit unit = component_unit(c);
        if (fabs(gough_unit_factor(own, unit) - gough_unit_factor(u, unit)) > 0)
            pose[c] = in_units(u, unit, gough_unit_read(own, unit, pose[c]));
    }
}

void stability_scale(stability_report *report) {
    const gough_units *u = &report->units;
    SCALE(report, report_members, u);
    scale_pose(report->pose, &report->study->units, u);
    scale_pose(report->last_pose, &report->study->units, u);
    scale_rest(&report->rest, u);
    if (report->ends) scale_rest(&report->last, u);
    scale_sampled(&report->sampled_rest.rest, u);
    scale_sampled(&report->sampled_last.rest, u);
    SCALE(report, along_members, u);
    for (size_t i = 0; i < report->along.listed; i++)
        scale_mode(&report->along.multiplier[i].mode, u);
    if (!report->periodic) return;
    SCALE(report, floquet_members, u);
    for (size_t i = 0; i < report->floquet.size; i++)
        scale_mode(&report->floquet.multiplier[i].mode, u);
}

bool stability_holds(const stability_report *report) {
    if (report->periodic) return report->floquet.stable;
    if (report->sampled_along) return report->along.stable;
    if (report->sampled)
        return report->ends ? report->sampled_last.rest.stable : report->sampled_rest.rest.stable;
    return report->ends ? report->last.stable : report->rest.stable;
}

/* ---- finding ----------------------------------------------------------------------------------------------------- */

static bool is_damped(const gough_model *model) {
    bool damped = model->control.coupled || gough_linear_size(model) > GOUGH_LINEAR;
    for (int i = 0; i < GOUGH_LEGS; i++)
        damped = damped || model->control.damping[i] > 0 ||
                 model->machine.platform.friction.viscous[i] > 0;
    return damped;
}

void stability_read_pose(const gough_study *study, const double pose[GOUGH_COMPONENTS],
                         double component[GOUGH_COMPONENTS]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        component[c] = gough_unit_read(&study->units, component_unit(c), pose[c]);
}

/* Where a program that comes to rest ends: its pose there, and whether that is not home. */
static bool find_last_pose(const gough_study *study, double start, double pose[GOUGH_COMPONENTS]) {
    double component[GOUGH_COMPONENTS][3];
    bool elsewhere = false;
    gough_motion_evaluate(&study->model->motion, start, component);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        pose[c] = in_units(&study->units, component_unit(c), component[c][0]);
        elsewhere = elsewhere || fabs(component[c][0]) > 1e-9;
    }
    return elsewhere;
}

/* How far a periodic motion is from the program at a time. */
static double find_sag(const gough_model *model, double start, const gough_state *state) {
    gough_state program;
    gough_acceleration acceleration;
    double sum = 0;
    gough_program(&model->machine, &model->motion, start, &program, &acceleration);
    for (int k = 0; k < 3; k++) {
        const double apart = state->position[k] - program.position[k];
        sum += apart * apart;
    }
    return sqrt(sum);
}

/* From sample to sample, if the controller is sampled; modes in the units of the output. */
static gough_status find_sampled(const stability_report *report, const double *component,
                                 sampled_view *view, gough_error *error) {
    if (!report->sampled) return GOUGH_OK;
    sampled_view_find(report->study, component, view);
    if (view->found) return GOUGH_OK;
    *error = view->why;
    return GOUGH_ERROR_NUMERICAL;
}

static gough_status find_about_program(stability_report *report, gough_error *error) {
    const gough_model *model = report->study->model;
    double component[GOUGH_COMPONENTS];
    gough_status status = gough_motion_period(&model->motion, &report->period, error);
    if (status) return status;
    if (!report->period.resting && report->sampled) {
        report->sampled_along = true;
        status = gough_floquet_sampled(model, &report->period, &report->along, error);
        if (!status) report->sag = find_sag(model, report->along.start, &report->along.state);
        return status;
    }
    if (!report->period.resting) {
        report->periodic = true;
        status = gough_floquet_multipliers(model, &report->period, 0, &report->floquet, error);
        if (!status) report->sag = find_sag(model, report->floquet.start, &report->floquet.state);
        return status;
    }
    report->ends = find_last_pose(report->study, report->period.start, report->last_pose);
    if (!report->ends) return GOUGH_OK;
    stability_read_pose(report->study, report->last_pose, component);
    status = find_sampled(report, component, &report->sampled_last, error);
    if (status) return status;
    return gough_stability_at_rest(model, component, &report->last, error);
}

/* The program first: that it is not periodic is said whatever home is like. */
gough_status stability_find(stability_report *report, gough_error *error) {
    double component[GOUGH_COMPONENTS];
    report->arm = report->study->model->machine.base_radius;
    report->damped = is_damped(report->study->model);
    report->sampled = report->study->model->control.sampling.period > 0;
    gough_status status = report->posed ? GOUGH_OK : find_about_program(report, error);
    const gough_model *model = report->study->model;
    const bool kept = gough_keeps_program(&model->machine, &model->control, true);
    if (status == GOUGH_ERROR_INPUT || (status == GOUGH_ERROR_NUMERICAL && kept)) {
        gough_error cause = *error;
        gough_error_say(&cause, &report->study->units);
        gough_fail(error, status, "%s. For the stability at rest alone, use --pose surge=0",
                   cause.message);
    }
    if (status) return status;
    stability_read_pose(report->study, report->pose, component);
    status = find_sampled(report, component, &report->sampled_rest, error);
    if (status) return status;
    return gough_stability_at_rest(report->study->model, component, &report->rest, error);
}

/* ---- the verb ---------------------------------------------------------------------------------------------------- */

static gough_status answer(const stability_line *asked, stability_report *report) {
    const command_line *line = &asked->line;
    const bool wanted = asked->loop.matrix;
    gough_error error = {0};
    stability_matrix matrix = {0};
    gough_status status =
        gough_units_of_study(report->study, line->dimensionless, &report->units, &error);
    if (!status && wanted)
        status =
            stability_matrix_find(&asked->loop, report->study, &report->units, &matrix, &error);
    if (!status && wanted && !line->json) {
        stability_matrix_print(stdout, &matrix);
        stability_matrix_free(&matrix);
        return GOUGH_OK;
    }
    if (!status) status = stability_find(report, &error);
    if (status) {
        complain_of(line->verb, report->study, &error);
    } else {
        stability_scale(report);
        if (line->json && json_print(stability_json(report, wanted ? &matrix : NULL)))
            status = GOUGH_ERROR_FILE;
        if (!line->json && !line->quiet) stability_print(stdout, report);
    }
    stability_matrix_free(&matrix);
    return status;
}

static gough_status answer_alone(const stability_line *asked, const gough_study *study) {
    stability_report *report = allocate(sizeof *report);
    *report =
        (stability_report){.verb = asked->line.verb, .study = study, .posed = asked->loop.posed};
    memcpy(report->pose, asked->loop.pose, sizeof report->pose);
    const gough_status status = answer(asked, report);
    free(report);
    return status;
}

/* Options that say nothing together. */
static const char *contradiction(const stability_line *asked) {
    const struct loop_options *loop = &asked->loop;
    const bool map = asked->map.stiffness.option != NULL;
    const bool posed = loop->posed || asked->lengths.given;
    if (loop->posed && asked->lengths.given)
        return "--pose and --lengths both give the pose; give only one of them";
    if (isfinite(loop->at) && !loop->matrix) return "--at is the time of --matrix; give both";
    if (isfinite(loop->at) && posed)
        return "--at refers to the program, --pose and --lengths to rest; give only one of them";
    if (asked->map.second.option && !map)
        return "a map needs the stiffness as its first axis; give --sweep-stiffness too, as in "
               "--sweep-stiffness 0:2:201";
    if (map && (loop->matrix || posed))
        return "a map is computed along the program; --pose, --lengths and --matrix cannot be "
               "combined with it";
    if (asked->line.outputs.count && !map)
        return "-o is for maps; give --sweep-stiffness, as in --sweep-stiffness 0:2:201";
    return NULL;
}

static gough_status run(const void *given) {
    stability_line own = *(const stability_line *)given, *const asked = &own;
    const command_line *line = &asked->line;
    gough_study *study = NULL;
    gough_status status = GOUGH_OK;
    const char *wrong = contradiction(asked);
    if (wrong) {
        complain(line->verb, "%s", wrong);
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = read_study(line, line->file.word[0], &study);
    if (!status && asked->lengths.given) {
        own.loop.posed = true;
        status = lengths_pose(line->verb, study, &asked->lengths, own.loop.pose);
    }
    if (!status)
        status =
            asked->map.stiffness.option ? stability_map(asked, study) : answer_alone(asked, study);
    gough_study_free(study);
    return status;
}

extern const command_verb stability_verb;
const command_verb stability_verb = {
    .name = "stability",
    .arguments = "STUDY",
    .sentence = "modes, stiffness thresholds, growth of deviations",
    .text = "Determine whether the control law holds the platform: eigenvalues and modes at rest, "
            "the least stiffness G that each mode needs, Floquet multipliers along a periodic "
            "program.\vThe loop is linearised exactly: about rest at home or in --pose, and about "
            "the program over one period, which is found from its formulas or given as "
            "motion.period. The loop of a sampled controller is computed from sample to sample, "
            "with the "
            "stiffnesses between which it is stable. With --sweep-stiffness it computes a map of "
            "stability and lists the "
            "resonance tongues, in which a stiffer loop is unstable again. An unstable loop is a "
            "valid result: the exit status is 0.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(stability_line),
    .run = run};
