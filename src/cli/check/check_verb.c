/* gough check: validates a study and prints the machine that it describes, in the study's units. */
#include <math.h>

#include "cli/check/check_file.h"
#include "cli/check/check_json.h"
#include "cli/check/check_limits.h"
#include "cli/check/check_loop.h"
#include "cli/check/check_moves.h"
#include "cli/check/check_pose.h"
#include "cli/check/check_record.h"
#include "cli/check/check_sampling.h"
#include "cli/check/check_warnings.h"
#include "cli/check/machine_view.h"
#include "cli/common/from_lengths.h"
#include "cli/common/in_and_out.h"
#include "cli/common/json.h"
#include "cli/common/left_out.h"
#include "cli/common/leg_table.h"
#include "cli/common/option_values.h"
#include "cli/common/sampled_view.h"
#include "cli/common/scale.h"
#include "cli/common/study_fields.h"
#include "cli/common/talk.h"
#include "cli/sweep/sweep_report.h"

typedef struct check_line {
    command_line line;
    pose_view pose; /* `asked` and `pose` from the options */
    lengths_asked lengths;
} check_line;

static void read_pose_option(const struct argp_state *state, const option *o, const char *text,
                             void *group) {
    pose_view *view = group;
    gough_error error = {.message = ""};
    (void)o;
    view->asked = true;
    if (!read_pose("pose", text, view->pose, &error)) usage_error(state, "%s", error.message);
}

static const option pose_option[] = {
    {.name = "pose",
     .value = "C=X,...",
     .many = true,
     .read = read_pose_option,
     .text = "lengths, static forces, condition, stiffness and compliance in this pose, given by "
             "its components from home (in the units of the study), as in surge=0.1,yaw=5"},
    {0}};

static const option_group pose_group = {pose_option, NULL, NULL};

/* Words and the value of a key of the study. */
static void print_part(const check *c, const char *words, const char *path) {
    printf("%s", words);
    print_field(stdout, c->study, path);
}

/* The same on a line of its own. */
static void print_value(const check *c, const char *label, const char *path) {
    printf("  %-20s ", label);
    print_field(stdout, c->study, path);
    printf("\n");
}

static void print_legs(const check *c) {
    const gough_platform *platform = &c->machine->platform;
    const table_heading length =
        heading_of("length at home", unit_word(c->unit, GOUGH_UNIT_LENGTH));
    const table_heading joint = heading_of("base joint", unit_word(c->unit, GOUGH_UNIT_LENGTH)),
                        top = heading_of("top joint, top frame",
                                         unit_word(c->unit, GOUGH_UNIT_LENGTH));
    table_column column[] = {{"", length.text, {0}, 6}, {joint.text, "x", {0}, 5},
                             {joint.text, "y", {0}, 5}, {joint.text, "z", {0}, 5},
                             {top.text, "x", {0}, 5},   {top.text, "y", {0}, 5},
                             {top.text, "z", {0}, 5},   {0}};
    for (int i = 0; i < GOUGH_LEGS; i++) {
        column[0].value[i] = check_own(c, GOUGH_UNIT_LENGTH, c->machine->home_length[i]);
        for (int k = 0; k < 3; k++) {
            column[1 + k].value[i] = check_own(c, GOUGH_UNIT_LENGTH, platform->base[i][k]);
            column[4 + k].value[i] = check_own(c, GOUGH_UNIT_LENGTH, platform->top[i][k]);
        }
    }
    table_print(stdout, column, false);
    print_limits(c->study, c->unit);
}

static void print_singularity(const check *c) {
    const machine_view *view = &c->view;
    printf("\nAt home\n");
    if (view->condition < 1e8)
        printf("  condition            %.6g (singular from 1e8)\n", view->condition);
    else
        printf("  condition            over 1e8: home is singular, and leg forces cannot carry "
               "every load there\n");
    printf("  |det J|              %.6g%s%s\n", fabs(check_determinant_of(c)),
           unit_word(c->unit, GOUGH_UNIT_LENGTH),
           *unit_word(c->unit, GOUGH_UNIT_LENGTH) ? "^3" : "");
    printf("  least singular value %.6g of J (moments divided by %.6g%s; 0 is singular);\n"
           "                       the weakest direction is %s\n",
           view->least_singular, check_own(c, GOUGH_UNIT_LENGTH, view->arm),
           unit_word(c->unit, GOUGH_UNIT_LENGTH), check_weakest_name(view));
}

static void print_load(const check *c) {
    printf("\n"
           "Load%s\n",
           c->machine->platform.legs_have_mass ? "" : " (the model has massless legs)");
    print_part(c, "  mass                 ", "load.mass");
    print_part(c, ", centre of mass ", "load.center_of_mass");
    printf("\n");
    printf("  principal moments    %.6g, %.6g, %.6g%s\n",
           check_own(c, GOUGH_UNIT_INERTIA, c->view.moments[0]),
           check_own(c, GOUGH_UNIT_INERTIA, c->view.moments[1]),
           check_own(c, GOUGH_UNIT_INERTIA, c->view.moments[2]),
           unit_word(c->unit, GOUGH_UNIT_INERTIA));
    static const char *const axis_names[] = {"axis of the first", "axis of the second",
                                             "axis of the third"};
    for (int a = 0; a < 3; a++) {
        printf("  %-20s ", axis_names[a]);
        for (int k = 0; k < 3; k++) {
            const double cosine = c->machine->principal_axes[k][a];
            printf("%s%.4g", k ? ", " : "(", fabs(cosine) < 5e-17 ? 0.0 : cosine);
        }
        printf(")\n");
    }
    print_value(c, "gravity", "gravity");
}

/* The machine's legs, and what forces of legs without mass would leave out. */
static void print_leg_mass(const check *c) {
    const machine_view *view = &c->view;
    const char *mass = unit_word(c->unit, GOUGH_UNIT_MASS);
    if (!c->machine->platform.legs_have_mass) return;
    printf("  mass of the legs     %.6g%s, of which the top bears %.6g%s at home (%.4g %% of the "
           "load)\n",
           check_own(c, GOUGH_UNIT_MASS, view->leg_mass), mass,
           check_own(c, GOUGH_UNIT_MASS, view->hanging), mass,
           100 * view->hanging / c->machine->load.mass);
}

static void gain_range(const double gain[GOUGH_LEGS], double range[2]) {
    range[0] = INFINITY, range[1] = -INFINITY;
    for (int i = 0; i < GOUGH_LEGS; i++) {
        range[0] = fmin(range[0], gain[i]);
        range[1] = fmax(range[1], gain[i]);
    }
}

/* "5" or "4 to 6" */
static void print_range(const double range[2], double factor, const char *unit) {
    if (range[1] - range[0] > 0)
        printf("%.6g to %.6g%s", factor * range[0], factor * range[1], unit);
    else
        printf("%.6g%s", factor * range[0], unit);
}

/* What the smooth law of friction makes of breakaway, (mass-12): how much of it is reached, and how fast a leg under a load that is
 * half of it creeps. */
static void print_friction(const check *c) {
    const gough_machine *m = c->machine;
    const gough_friction *f = &m->platform.friction;
    double breakaway[2], creep[2], reached = 1;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double excess = m->breakaway[v] > 0 ? 1 - f->coulomb[v] / m->breakaway[v] : 0;
        if (excess > 0)
            reached =
                fmin(reached, 1 - m->smoothing_speed[v] / f->stribeck_speed[v] * sqrt(2 * excess));
    }
    gain_range(m->breakaway, breakaway);
    gain_range(m->smoothing_speed, creep);
    if (!(breakaway[1] > 0)) return;
    printf("  dry friction         breakaway ");
    print_range(breakaway, check_own(c, GOUGH_UNIT_FORCE, 1), unit_word(c->unit, GOUGH_UNIT_FORCE));
    printf(", of which the smooth law reaches about %.3g %%;\n"
           "                       a leg that should rest under half of it creeps at about ",
           100 * reached);
    print_range(creep, check_own(c, GOUGH_UNIT_SPEED, 1 / sqrt(3)),
                unit_word(c->unit, GOUGH_UNIT_SPEED));
    printf("\n");
}

/* Whether a formula has other values later on. */
static bool varies(const gough_formula *formula, double duration) {
    double now[3], later[3];
    gough_formula_evaluate(formula, 0, now);
    for (int k = 1; k <= 16; k++) {
        gough_formula_evaluate(formula, duration * k / 16.7, later);
        if (!(fabs(later[0] - now[0]) <= 0)) return true;
    }
    return false;
}

/* Values of three formulas at t = 0, with a unit; whether they vary. */
static bool print_formulas(const check *c, const gough_formula formula[3], gough_unit unit) {
    bool any = false;
    for (int i = 0; i < 3; i++) {
        double now[3];
        gough_formula_evaluate(&formula[i], 0, now);
        any |= varies(&formula[i], c->study->simulation.duration);
        printf("%s%.6g", i ? ", " : "", check_own(c, unit, now[0]) + 0.0);
    }
    printf("%s", unit_word(c->unit, unit));
    return any;
}

static void print_external(const check *c) {
    const gough_machine *m = c->machine;
    if (m->externals == 0) return;
    printf("\nExternal loads (%s the program forces)\n",
           c->model->control.ignores_external ? "left out of" : "part of");
    for (size_t n = 0; n < m->externals; n++) {
        const gough_external *e = &m->external[n];
        const double *at = e->at_given ? e->at : m->load.center_of_mass;
        printf("  %zu                    force ", n + 1);
        bool changes = print_formulas(c, e->force, GOUGH_UNIT_FORCE);
        printf(", moment ");
        changes |= print_formulas(c, e->moment, GOUGH_UNIT_MOMENT);
        printf(
            "%s\n                       at %.6g, %.6g, %.6g%s in the top frame, axes of the %s\n",
            changes ? " at t = 0" : "", check_own(c, GOUGH_UNIT_LENGTH, at[0]),
            check_own(c, GOUGH_UNIT_LENGTH, at[1]), check_own(c, GOUGH_UNIT_LENGTH, at[2]),
            unit_word(c->unit, GOUGH_UNIT_LENGTH), e->turns ? "top" : "base");
    }
}

static void print_groups(const check *c) {
    const gough_machine *m = c->machine;
    const double R = m->base_radius, M = m->load.mass, g = m->gravity_magnitude;
    printf("\nDimensionless groups\n");
    printf("  R_b                  %.6g%s\n", check_own(c, GOUGH_UNIT_LENGTH, R),
           unit_word(c->unit, GOUGH_UNIT_LENGTH));
    printf("  h/R_b                %.6g\n", m->platform.height / R);
    printf("  r/R_b                %.6g\n", c->view.top_radius / R);
    printf("  J/(M R_b^2)          %.6g, %.6g, %.6g\n", c->view.moments[0] / (M * R * R),
           c->view.moments[1] / (M * R * R), c->view.moments[2] / (M * R * R));
    if (!(g > 0)) {
        printf("  without gravity there is no unit of time and there are no groups of G and D\n");
        return;
    }
    double stiffness[2], damping[2];
    gain_range(c->model->control.stiffness, stiffness);
    gain_range(c->model->control.damping, damping);
    printf("  G R_b/(M g)          ");
    print_range(stiffness, R / (M * g), "\n");
    printf("  D sqrt(R_b/g)/M      ");
    print_range(damping, c->view.time_unit / M, "\n");
    printf("  sqrt(R_b/g)          %.6g%s, the unit of time\n",
           check_own(c, GOUGH_UNIT_TIME, c->view.time_unit), unit_word(c->unit, GOUGH_UNIT_TIME));
}

static void print_program(const check *c) {
    const gough_motion *motion = &c->model->motion;
    printf("\nProgram\n");
    if (motion->kind == GOUGH_MOTION_MOVES)
        printf("  %zu minimum-jerk move%s\n", motion->moves, motion->moves == 1 ? "" : "s");
    else if (motion->kind == GOUGH_MOTION_SAMPLES)
        printf("  %zu samples, t = %.6g to %.6g%s, interpolated by a cubic spline (C2, not-a-knot "
               "ends)\n",
               motion->samples.count, check_own(c, GOUGH_UNIT_TIME, motion->samples.time[0]),
               check_own(c, GOUGH_UNIT_TIME, motion->samples.time[motion->samples.count - 1]),
               unit_word(c->unit, GOUGH_UNIT_TIME));
    else
        printf("  formulas in t\n");
    if (motion->order != GOUGH_ZYX)
        printf("  angles               R = Rx(roll) Ry(pitch) Rz(yaw)\n");
    int moving = 0;
    for (int k = 0; k < GOUGH_COMPONENTS; k++) {
        if (!(fabs(c->least[k]) > 0) && !(fabs(c->greatest[k]) > 0)) continue;
        printf("  %-20s %.6g to %.6g%s\n", gough_component_name(k), c->least[k], c->greatest[k],
               unit_word(c->unit, component_unit(k)));
        moving++;
    }
    if (!moving) printf("  rest at home\n");
    moves_print(stdout, c->study, c->unit);
    if (c->study->record) record_print(stdout, c->study->record, c->unit);
    const double *about = motion->about;
    if (fabs(about[0]) + fabs(about[1]) + fabs(about[2]) > 0) {
        print_part(c, "  of the point         ", "motion.about");
        printf(" in the top frame\n");
    }
}

/* What the feed-forward leaves out of what the machine has. */
static void print_ignored(const check *c) {
    const gough_control *control = &c->model->control;
    const bool rubs = leaves_out_friction(c->model);
    const ignored_words ignored = words_of_ignored(c->model, true);
    if (!control->feedforward) return;
    if (*ignored.text) printf("    without            %s\n", ignored.text);
    if (control->ignores_friction && rubs)
        printf("    without            the dry friction of the legs and losses of their screws\n");
}

static void print_control(const check *c) {
    const gough_control *control = &c->model->control;
    double stiffness[2], damping[2];
    gain_range(control->stiffness, stiffness);
    gain_range(control->damping, damping);
    printf("\nControl\n  feedforward          %s\n",
           control->feedforward ? "the program's forces" : "none");
    print_ignored(c);
    printf("  stiffness G          ");
    print_range(stiffness, check_own(c, GOUGH_UNIT_STIFFNESS, 1),
                unit_word(c->unit, GOUGH_UNIT_STIFFNESS));
    printf("%s%s\n  damping D            ", loop_matrix_words(control, control->cross_stiffness),
           stiffness[1] > 0 || control->coupled ? "" : ": open loop");
    print_range(damping, check_own(c, GOUGH_UNIT_DAMPING, 1),
                unit_word(c->unit, GOUGH_UNIT_DAMPING));
    printf("%s\n", loop_matrix_words(control, control->cross_damping));
    print_loop(c->study, c->unit);
    print_sampling(c->study, c->unit, &c->sampled);
}

static void print_settings(const check *c) {
    const gough_simulation *s = &c->study->simulation;
    printf("\nSimulation\n");
    print_part(c, "  duration             ", "simulation.duration");
    print_part(c, ", a row every ", "simulation.output_step");
    print_part(c, "\n  method               ", "simulation.method");
    printf(", ");
    if (s->step > 0) {
        print_part(c, "step ", "simulation.step");
        printf("\n");
    } else {
        printf("tolerance %.3g\n", s->tolerance);
    }
    printf("  constraints          ");
    if (s->method >= GOUGH_RATTLE2)
        printf("kept by the method\n");
    else if (s->constraints == GOUGH_BAUMGARTE)
        printf("Baumgarte, alpha %.6g, beta %.6g\n", check_own(c, GOUGH_UNIT_RATE, s->baumgarte[0]),
               check_own(c, GOUGH_UNIT_RATE, s->baumgarte[1]));
    else
        printf("%s\n", s->constraints == GOUGH_PROJECTION ? "projection" : "none");
}

static void print_check(const check *c) {
    print_title(stdout, c->study->title);
    print_line(stdout, "%s is a valid study; %s", c->study->name,
               units_sentence(c->study, c->unit).text);
    printf("\nLegs\n");
    print_legs(c);
    print_singularity(c);
    print_load(c);
    print_leg_mass(c);
    print_friction(c);
    print_external(c);
    if (c->pose.asked) pose_view_print(stdout, c->model, c->unit, &c->pose);
    print_groups(c);
    print_program(c);
    print_control(c);
    print_drives(c->study, c->unit);
    print_settings(c);
    if (c->sweep) sweep_describe(c->sweep);
}

static gough_status check_study(const command_line *line, const pose_view *pose,
                                const gough_study *study, const gough_sweep *sweep, json_t *list) {
    check c = {.study = study,
               .sweep = sweep,
               .model = study->model,
               .machine = &study->model->machine,
               .view = machine_view_of(&study->model->machine),
               .unit = &study->units,
               .pose = *pose};
    gough_error error = {0};
    gough_status status = gough_simulation_check(study->model, &study->simulation, &error);
    if (!status)
        status = gough_motion_range(&study->model->motion, study->simulation.duration,
                                    study->simulation.output_step, c.least, c.greatest, &error);
    if (status) {
        complain_of(line->verb, study, &error);
        return status;
    }
    for (int k = 0; k < GOUGH_COMPONENTS; k++) {
        c.least[k] = in_units(c.unit, component_unit(k), c.least[k]);
        c.greatest[k] = in_units(c.unit, component_unit(k), c.greatest[k]);
    }
    pose_view_find(c.model, c.unit, &c.pose);
    sampled_view_find(study, NULL, &c.sampled);
    check_warnings(line->verb, study, c.unit);
    if (list)
        json_array_append_new(list, check_object(&c));
    else if (line->json)
        return json_print(check_object(&c)) ? GOUGH_ERROR_FILE : GOUGH_OK;
    else if (!line->quiet)
        print_check(&c);
    return GOUGH_OK;
}

/* One study; with `list` its object joins those of the others. */
static gough_status check_file(const check_line *asked, const char *path, json_t *list) {
    const command_line *line = &asked->line;
    gough_study *study = NULL;
    gough_sweep *sweep = NULL;
    if (is_motion_file(path)) return check_motion_file(line, path, list);
    pose_view pose = asked->pose;
    gough_status status = read_study(line, path, &study);
    if (!status && study->swept) status = read_sweep(line, study, &sweep);
    if (!status && asked->lengths.given) {
        pose.asked = true;
        status = lengths_pose(line->verb, study, &asked->lengths, pose.pose);
    }
    if (!status) status = check_study(line, &pose, study, sweep, list);
    gough_sweep_free(sweep);
    gough_study_free(study);
    return status;
}

/* Several studies, one after the other, also after one that is wrong. The greatest status counts. */
static gough_status check_files(const check_line *asked) {
    const command_line *line = &asked->line;
    json_t *list = line->json ? json_array() : NULL;
    gough_status worst = GOUGH_OK;
    for (size_t i = 0; i < line->file.count; i++) {
        const char *path = line->file.word[i];
        const size_t before = json_array_size(list);
        if (!line->json && !line->quiet) {
            if (i) printf("\n");
            print_line(stdout, "%s", path);
        }
        const gough_status status = check_file(asked, path, list);
        if (status > worst) worst = status;
        if (list && json_array_size(list) == before) json_array_append_new(list, json_object());
        json_t *object = json_array_get(list, i);
        json_object_set_new(object, "file", json_words(path));
        json_object_set_new(object, "valid", json_boolean(status == GOUGH_OK));
    }
    if (!list) return worst;
    json_t *whole = json_object();
    json_object_set_new(whole, "studies", list);
    if (json_print(whole)) return GOUGH_ERROR_FILE;
    return worst;
}

static gough_status run(const void *given) {
    const check_line *asked = given;
    const command_line *line = &asked->line;
    if (asked->pose.asked && asked->lengths.given) {
        complain(line->verb, "--pose and --lengths both give the pose; give only one of them");
        return GOUGH_ERROR_INPUT;
    }
    return line->file.count > 1 ? check_files(asked) : check_file(asked, line->file.word[0], NULL);
}

enum { MOST_STUDIES = 100000 };

static const group_use groups[] = {
    USES_JSON,
    USES_SETTINGS,
    USES(pose_group, check_line, pose, NULL),
    USES(lengths_group, check_line, lengths,
         "the same in the pose of these six leg lengths, joint to joint, in the unit of the study, "
         "that is joined to home"),
    {0}};

extern const command_verb check_verb;
const command_verb check_verb = {
    .name = "check",
    .arguments = "STUDY...",
    .sentence = "validate studies and describe their machines, or records of motion",
    .text =
        "Validate a study and describe its machine: leg lengths, condition and least singular "
        "value at home, principal moments of inertia, external loads, stiffness and compliance at "
        "home or in --pose, dimensionless groups, range of the program, control (if it is sampled, "
        "the stiffnesses "
        "between which it holds the platform) and simulation "
        "settings. Suspicious values are reported as "
        "warnings.\vSTUDY is a study file, or - for standard input. Several are checked one after "
        "the other, also after one that is "
        "wrong; the exit status is the greatest of theirs, and the JSON a list. A file whose name "
        "ends "
        "in .csv, .tsv, .txt, .dat or .asc is a record of motion: its columns, times, rounding and "
        "ranges are printed, and a mapping for motion.samples that reads it.",
    .endings = "yaml yml csv tsv txt dat asc",
    .least_files = 1,
    .most_files = MOST_STUDIES,
    .groups = groups,
    .size = sizeof(check_line),
    .run = run};
