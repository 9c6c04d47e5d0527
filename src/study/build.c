/* From a checked tree to the model: machine, control, disturbances, where a run starts, and how it is run.
 * Angles are in degrees in the file and in radians in the model. */
#include "study/build.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/motion.h"
#include "study/value.h"

static const double RADIANS = 3.14159265358979323846 / 180;

static bool is_right(const study_node *node) { return !node || !node->wrong; }

void study_numbers(const study_node *list, double *value) {
    for (const study_node *item = list ? list->first : NULL; item; item = item->next)
        *value++ = study_number(item);
}

/* One number for all, or a list of them. */
static void spread(const study_node *node, double *value, size_t count) {
    if (!node) return;
    if (node->kind == STUDY_LIST)
        study_numbers(node, value);
    else
        for (size_t i = 0; i < count; i++) value[i] = study_number(node);
}

/* ---- machine --------------------------------------------------------------------------------------------------- */

/* One ring of joints is given by radius and half angle, or by points, and not by both. */
static bool check_ring(study_build *build, study_node *ring) {
    study_messages *messages = build->messages;
    study_node *radius = study_node_child(ring, "radius");
    study_node *angle = study_node_child(ring, "half_angle");
    study_node *joints = study_node_child(ring, "joints");
    const char *path = study_node_path(messages->arena, ring);
    const study_node *other = radius ? radius : angle;
    if (joints && other)
        study_node_say(
            messages, joints, study_node_place(joints, true),
            "`%s` has both `joints` and `%s`; give either joints, or radius and half_angle", path,
            other->key->text);
    else if (study_node_meant(ring, "radius") || study_node_meant(ring, "half_angle") ||
             study_node_meant(ring, "joints"))
        return false;
    else if (!joints && !other)
        study_node_say(messages, ring, study_node_place(ring, true),
                       "`%s` needs radius and half_angle, or joints", path);
    else if (!joints && !(radius && angle))
        study_node_say(messages, ring, study_node_place(ring, true), "`%s.%s` is missing: %s", path,
                       radius ? "half_angle" : "radius",
                       radius ? "the angle between a joint and the middle of its pair"
                              : "the radius of the circle of joints");
    else
        return is_right(ring);
    return false;
}

static void read_points(const study_node *joints, double point[GOUGH_LEGS][3]) {
    for (const study_node *row = joints->first; row; row = row->next) study_numbers(row, *point++);
}

static gough_platform read_platform(const study_node *platform) {
    const study_node *base = study_node_child(platform, "base");
    const study_node *top = study_node_child(platform, "top");
    const study_node *base_joints = study_node_child(base, "joints");
    const study_node *top_joints = study_node_child(top, "joints");
    const double height = study_number(study_node_child(platform, "height"));
    const double base_radius = study_number(study_node_child(base, "radius"));
    const double base_angle = study_number(study_node_child(base, "half_angle")) * RADIANS;
    const double top_radius = study_number(study_node_child(top, "radius"));
    const double top_angle = study_number(study_node_child(top, "half_angle")) * RADIANS;
    /* a ring given by points is made of unit size first and then replaced */
    gough_platform made =
        gough_platform_symmetric(base_joints ? 1 : base_radius, base_joints ? 0 : base_angle,
                                 top_joints ? 1 : top_radius, top_joints ? 0 : top_angle, height);
    if (base_joints) {
        read_points(base_joints, made.base);
        made.base_radius = 0;
    }
    if (top_joints) read_points(top_joints, made.top);
    return made;
}

static void read_limits(study_build *build, study_node *legs, gough_platform *platform) {
    study_node *length = study_node_child(legs, "length");
    const study_node *speed = study_node_child(legs, "max_speed");
    const study_node *force = study_node_child(legs, "max_force");
    if (length) {
        double limit[2];
        study_numbers(length, limit);
        platform->length_min = limit[0];
        platform->length_max = limit[1];
        if (!(limit[0] < limit[1]))
            study_node_say(build->messages, length, study_node_place(length, false),
                           "`platform.legs.length` must be [shortest, longest], in this order");
    }
    if (speed) platform->speed_max = study_number(speed);
    if (force) platform->force_max = study_number(force);
}

static bool read_inertia(study_build *build, study_node *node, double inertia[3][3]) {
    if (node->first->kind == STUDY_SCALAR) {
        double moments[3];
        study_numbers(node, moments);
        for (int i = 0; i < 3; i++) inertia[i][i] = moments[i];
        return true;
    }
    double largest = 0;
    for (size_t i = 0; i < 3; i++) study_numbers(study_node_item(node, i), inertia[i]);
    for (int i = 0; i < 9; i++) largest = fmax(largest, fabs(inertia[i / 3][i % 3]));
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < i; j++) {
            /* what rounding of printed digits leaves is evened out */
            if (!(fabs(inertia[i][j] - inertia[j][i]) <= 1e-9 * largest)) {
                study_node *item = study_node_item(study_node_item(node, i), j);
                study_node_say(build->messages, item, study_node_place(item, false),
                               "`load.inertia` must be symmetric: the opposite element is `%s`",
                               study_node_item(study_node_item(node, j), i)->text);
                return false;
            }
            inertia[i][j] = inertia[j][i] = 0.5 * inertia[i][j] + 0.5 * inertia[j][i];
        }
    }
    return true;
}

/* an error of the library, at the key that it is about if the study has it, else at the nearest one around it */
static void say_library(study_build *build, study_node *otherwise, const gough_error *error) {
    const study_node *parent = build->root;
    study_node *node = otherwise;
    for (const char *at = error->key; at && *at;) {
        char name[40];
        const size_t length = strcspn(at, ".");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        study_node *child = study_node_child(parent, name);
        if (!child) break;
        parent = node = child;
        at += length + (at[length] == '.');
    }
    study_node_say(build->messages, node, study_node_place(node, true), "%s",
                   study_printable(build->messages->arena, error->message));
}

static bool build_machine(study_build *build) {
    study_node *platform = study_node_child(build->root, "platform");
    study_node *load = study_node_child(build->root, "load");
    const study_node *gravity = study_node_child(build->root, "gravity");
    study_node *base = study_node_child(platform, "base"), *top = study_node_child(platform, "top");
    const bool base_right = base && base->kind == STUDY_MAPPING && check_ring(build, base);
    const bool top_right = top && top->kind == STUDY_MAPPING && check_ring(build, top);
    gough_load body = {.mass = study_number(study_node_child(load, "mass"))};
    study_node *inertia = study_node_child(load, "inertia");
    if (inertia && !inertia->wrong) read_inertia(build, inertia, body.inertia);
    study_node *legs = study_node_child(platform, "legs");
    gough_platform limits = gough_platform_default();
    if (legs && !legs->wrong) read_limits(build, legs, &limits);
    const bool rings = base_right && top_right && !platform->wrong;
    if (!rings || !load || load->wrong || !is_right(gravity)) return false;
    gough_platform made = read_platform(platform);
    made.length_min = limits.length_min;
    made.length_max = limits.length_max;
    made.speed_max = limits.speed_max;
    made.force_max = limits.force_max;
    study_numbers(study_node_child(load, "center_of_mass"), body.center_of_mass);
    double fall[3] = {0, 0, build->study->dimensionless ? -1 : -9.80665};
    if (gravity && gravity->kind == STUDY_LIST)
        study_numbers(gravity, fall);
    else if (gravity)
        fall[2] = -study_number(gravity);
    gough_error error = {.message = ""};
    if (gough_machine_init(&build->study->model->machine, &made, &body, fall, &error) == GOUGH_OK)
        return true;
    say_library(build, platform, &error);
    return false;
}

/* ---- what acts on it ------------------------------------------------------------------------------------------- */

gough_formula study_formula(const study_node *node) {
    gough_formula formula = gough_formula_constant(0);
    if (node && !node->wrong) gough_formula_compile(&formula, node->text, node->length, NULL, NULL);
    return formula;
}

static void read_formulas(const study_node *node, gough_formula *formula, size_t count) {
    for (size_t i = 0; i < count; i++)
        formula[i] =
            study_formula(node && node->kind == STUDY_LIST ? study_node_item(node, i) : node);
}

static double number_or_zero(const study_node *node) { return node ? study_number(node) : 0; }

static gough_noise read_noise(const study_node *node) {
    if (!is_right(node)) return (gough_noise){.interval = 0};
    return (gough_noise){
        .leg_force = number_or_zero(study_node_child(node, "leg_force")),
        .force = number_or_zero(study_node_child(node, "force")),
        .moment = number_or_zero(study_node_child(node, "moment")),
        .interval = number_or_zero(study_node_child(node, "interval")),
        .seed = (uint64_t)number_or_zero(study_node_child(node, "seed")),
        .run = (uint64_t)number_or_zero(study_node_child(node, "run")),
    };
}

static void build_disturbance(study_build *build) {
    const study_node *node = study_node_child(build->root, "disturbance");
    gough_disturbance *disturbance = &build->study->model->disturbance;
    if (!is_right(node)) return;
    read_formulas(study_node_child(node, "leg_force"), disturbance->leg_force, GOUGH_LEGS);
    disturbance->vertical_force = study_formula(study_node_child(node, "vertical_force"));
    read_formulas(study_node_child(node, "force"), disturbance->force, 3);
    read_formulas(study_node_child(node, "moment"), disturbance->moment, 3);
    const study_node *noise = study_node_child(node, "noise");
    disturbance->noise = read_noise(noise);
    build->study->noise_run_given = study_node_child(noise, "run") != NULL;
}

static void build_control(study_build *build) {
    const study_node *node = study_node_child(build->root, "control");
    const study_node *forward = study_node_child(node, "feedforward");
    gough_control *control = &build->study->model->control;
    control->feedforward = !forward || strcmp(forward->text, "none") != 0;
    if (!is_right(node)) return;
    spread(study_node_child(node, "stiffness"), control->stiffness, GOUGH_LEGS);
    spread(study_node_child(node, "damping"), control->damping, GOUGH_LEGS);
}

static void build_initial(study_build *build) {
    const study_node *node = study_node_child(build->root, "initial");
    gough_initial *initial = &build->study->model->initial;
    if (!node || node->wrong) return;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const study_node *value = study_node_child(node, gough_component_name(c));
        if (!value) continue;
        initial->given[c] = true;
        initial->component[c] = study_number(value) * (c >= GOUGH_ROLL ? RADIANS : 1);
    }
    const study_node *velocity = study_node_child(node, "velocity");
    const study_node *angular = study_node_child(node, "angular_velocity");
    initial->velocity_given = velocity != NULL;
    initial->angular_velocity_given = angular != NULL;
    study_numbers(velocity, initial->velocity);
    study_numbers(angular, initial->angular_velocity);
    for (int i = 0; i < 3; i++) initial->angular_velocity[i] *= RADIANS;
}

/* ---- how it is run --------------------------------------------------------------------------------------------- */

static void read_constraints(const study_node *node, gough_simulation *run) {
    const study_node *baumgarte = study_node_child(node, "baumgarte");
    if (baumgarte) {
        run->constraints = GOUGH_BAUMGARTE;
        study_numbers(baumgarte, run->baumgarte);
    } else if (node && strcmp(node->text, "none") == 0) {
        run->constraints = GOUGH_NONE;
    }
}

/* Keys of the simulation that do not go together, or one that another needs. */
static void check_method(study_build *build, study_node *node) {
    study_node *method = study_node_child(node, "method");
    const study_node *step = study_node_child(node, "step");
    study_node *constraints = study_node_child(node, "constraints");
    const bool adaptive = !method || strcmp(method->text, "dop853") == 0;
    if (!adaptive && !step)
        study_node_say(build->messages, method, study_node_place(method, false),
                       "`%s` needs a fixed step: set `simulation.step` to a divisor of output_step",
                       method->text);
    if (constraints && constraints->kind == STUDY_MAPPING &&
        !study_node_child(constraints, "baumgarte"))
        study_say_shape(build->messages, constraints, "projection, none or {baumgarte: [α, β]}");
}

static void read_simulation(study_build *build, study_node *node) {
    gough_simulation *run = &build->study->simulation;
    const study_node *method = study_node_child(node, "method");
    struct {
        const char *name;
        double *value;
    } number[] = {{"duration", &run->duration},
                  {"output_step", &run->output_step},
                  {"step", &run->step},
                  {"max_step", &run->max_step},
                  {"tolerance", &run->tolerance}};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        const study_node *value = study_node_child(node, number[i].name);
        if (value) *number[i].value = study_number(value);
    }
    for (int m = 0; method && m < GOUGH_METHODS; m++)
        if (strcmp(method->text, gough_method_name(m)) == 0) run->method = (gough_method)m;
    read_constraints(study_node_child(node, "constraints"), run);
}

static void check_simulation(study_build *build, study_node *node) {
    gough_simulation run = build->study->simulation;
    gough_error error = {.message = ""};
    /* finer than double can give: for a run with --precision quad, and refused by any other */
    if (run.tolerance < 1e-15) run.precision = GOUGH_QUADRUPLE;
    if (gough_simulation_check(build->study->model, &run, &error) == GOUGH_OK) return;
    study_node *about = node ? node : study_node_child(build->root, "motion");
    say_library(build, about ? about : study_node_child(build->root, "platform"), &error);
}

void study_model_rebuild(study_build *build, unsigned parts) {
    study_node *simulation = study_node_child(build->root, "simulation");
    const bool machine = !(parts & GOUGH_PART_MACHINE) || build_machine(build);
    const bool motion = !(parts & GOUGH_PART_MOTION) || study_motion_build(build);
    if (parts & GOUGH_PART_DISTURBANCE) build_disturbance(build);
    if (parts & GOUGH_PART_CONTROL) build_control(build);
    if (parts & GOUGH_PART_INITIAL) build_initial(build);
    if (parts & GOUGH_PART_SIMULATION) {
        build->study->simulation = gough_simulation_default();
        if (simulation && simulation->kind == STUDY_MAPPING && !simulation->wrong) {
            check_method(build, simulation);
            if (!simulation->wrong) read_simulation(build, simulation);
        }
    }
    if (machine && motion && is_right(simulation) &&
        parts & (GOUGH_PART_MOTION | GOUGH_PART_SIMULATION))
        check_simulation(build, simulation);
}

void study_model_build(study_build *build) {
    const study_node *units = study_node_child(build->root, "units");
    build->study->dimensionless = units && strcmp(units->text, "dimensionless") == 0;
    study_model_rebuild(build, GOUGH_PART_MACHINE | GOUGH_PART_MOTION | GOUGH_PART_DISTURBANCE |
                                   GOUGH_PART_CONTROL | GOUGH_PART_INITIAL | GOUGH_PART_SIMULATION);
}
