/* From a checked tree to the model: by the table of fields (fill.h), and by the rules between fields: rings of joints, inertia,
 * gravity, method and constraints. */
#include "study/build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/dynamics.h"
#include "study/chosen_units.h"
#include "study/fill.h"
#include "study/motion.h"
#include "study/value.h"

static bool is_right(const study_node *node) { return !node || !node->wrong; }

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

/* Both rings by radius and half angle; one given by joints is made of unit size, to be replaced. */
static gough_platform read_rings(const study_node *platform, const gough_units *units) {
    const study_node *base = study_node_child(platform, "base");
    const study_node *top = study_node_child(platform, "top");
    const bool base_joints = study_node_child(base, "joints") != NULL;
    const bool top_joints = study_node_child(top, "joints") != NULL;
    double radius[2], angle[2];
    for (int ring = 0; ring < 2; ring++) {
        const study_node *node = ring ? top : base;
        radius[ring] = gough_unit_read(units, GOUGH_UNIT_LENGTH,
                                       study_number(study_node_child(node, "radius")));
        angle[ring] = gough_unit_read(units, GOUGH_UNIT_ANGLE,
                                      study_number(study_node_child(node, "half_angle")));
    }
    gough_platform made =
        gough_platform_symmetric(base_joints ? 1 : radius[0], base_joints ? 0 : angle[0],
                                 top_joints ? 1 : radius[1], top_joints ? 0 : angle[1], 0);
    if (base_joints) made.base_radius = 0;
    return made;
}

/* Two keys that say the same in different ways. */
static void check_either(study_build *build, const study_node *legs, const char *one,
                         const char *other) {
    study_node *node = study_node_child(legs, one);
    if (!node || !study_node_child(legs, other)) return;
    study_node_say(build->messages, node, study_node_place(node, true),
                   "`platform.legs` has both `%s` and `%s`; give one of them", other, one);
}

/* A part of the legs with a mass needs to say where its centre of mass is, and its inertia: a silent 0 would be a wrong answer. */
static void check_part(study_build *build, const study_node *legs, const char *name) {
    static const char *const needed[] = {"center", "inertia"};
    study_node *part = study_node_child(legs, name);
    study_node *mass = study_node_child(part, "mass");
    if (!mass) return;
    double number[GOUGH_LEGS] = {0};
    bool heavy = false;
    study_numbers(mass, &build->study->units, GOUGH_UNIT_MASS, number);
    for (int v = 0; v < GOUGH_LEGS; v++) heavy = heavy || number[v] > 0;
    for (size_t i = 0; heavy && i < sizeof needed / sizeof needed[0]; i++) {
        if (study_node_child(part, needed[i])) continue;
        study_node_say(build->messages, mass, study_node_place(mass, true),
                       "`platform.legs.%s` has a mass but no `%s`: %s", name, needed[i],
                       i == 0 ? "the distance of its centre of mass from its joint"
                              : "its moment of inertia about its centre of mass, across the leg; a "
                                "rod of length L has mass·L²/12");
    }
}

/* Breakaway that is given as 0 would mean coulomb to the library. */
static void check_breakaway(study_build *build, const study_node *legs) {
    study_node *friction = study_node_child(legs, "friction");
    study_node *breakaway = study_node_child(friction, "breakaway");
    const study_node *coulomb = study_node_child(friction, "coulomb");
    double most = 0, least = INFINITY, number[GOUGH_LEGS] = {0};
    if (!breakaway || !coulomb) return;
    study_numbers(coulomb, &build->study->units, GOUGH_UNIT_FORCE, number);
    for (int v = 0; v < GOUGH_LEGS; v++) most = fmax(most, number[v]);
    const size_t count = breakaway->kind == STUDY_LIST ? GOUGH_LEGS : 1;
    study_numbers(breakaway, &build->study->units, GOUGH_UNIT_FORCE, number);
    for (size_t v = 0; v < count; v++) least = fmin(least, number[v]);
    if (least > 0 || !(most > 0)) return;
    study_node_say(build->messages, breakaway, study_node_place(breakaway, false),
                   "`platform.legs.friction.breakaway` must not be below `coulomb`");
}

static void check_legs(study_build *build, study_node *legs) {
    check_either(build, legs, "stroke", "length");
    check_either(build, legs, "max_force", "force");
    check_part(build, legs, "cylinder");
    check_part(build, legs, "piston");
    check_breakaway(build, legs);
}

static bool read_inertia(study_build *build, study_node *node, double inertia[3][3]) {
    double number[9], largest = 0;
    study_numbers(node, &build->study->units, GOUGH_UNIT_INERTIA, number);
    if (node->first->kind == STUDY_SCALAR) {
        for (int i = 0; i < 3; i++) inertia[i][i] = number[i];
        return true;
    }
    for (int i = 0; i < 9; i++) inertia[i / 3][i % 3] = number[i];
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

/* ---- drives ---------------------------------------------------------------------------------------------------- */

/* Six drives are of one kind, of which the model has one. */
static bool check_kinds(study_build *build, const study_node *list) {
    const study_node *first = NULL;
    const char *kind = "";
    for (study_node *drive = list->first; drive; drive = drive->next) {
        study_node *node = study_node_child(drive, "kind");
        const char *own = node ? node->text : "ideal";
        if (drive == list->first) first = node, kind = own;
        if (strcmp(own, kind) == 0) continue;
        study_node *about = node ? node : drive;
        study_node_say(build->messages, about, study_node_place(about, false),
                       "all six drives must be of one kind, but that of leg 1 is `%s`%s and that "
                       "of leg %zu is `%s`%s",
                       kind, first ? "" : " by default", drive->number, own,
                       node ? "" : " by default");
        return false;
    }
    return true;
}

static void read_drives(study_build *build) {
    study_node *drives = study_node_child(build->root, "actuators");
    if (!drives || drives->wrong || drives->kind != STUDY_LIST) return;
    if (check_kinds(build, drives)) study_drives_read(build->study, drives);
}

/* an error of the library, at the key that it is about if the study has it, else at the nearest one around it */
static void say_library(study_build *build, study_node *otherwise, gough_error *error) {
    const char *rest;
    gough_error_say(error, &build->study->units);
    const char *key = error->key ? error->key : ""; /* unreachable: each of them has a key */
    study_node *node = study_node_follow(build->root, key, &rest);
    if (!node) node = otherwise;
    study_node_say(build->messages, node, study_node_place(node, true), "%s",
                   study_printable(build->messages->arena, error->message));
}

/* A number pulls downwards, in the units of the study; three are a vector. */
static void read_gravity(const gough_study *study, const study_node *node, double gravity[3]) {
    gravity[2] = study->dimensionless ? -1 : -9.80665;
    if (node && node->kind == STUDY_LIST)
        study_numbers(node, &study->units, GOUGH_UNIT_ACCELERATION, gravity);
    else if (node)
        gravity[2] = -gough_unit_read(&study->units, GOUGH_UNIT_ACCELERATION, study_number(node));
}

static bool build_machine(study_build *build) {
    study_node *platform = study_node_child(build->root, "platform");
    study_node *load = study_node_child(build->root, "load");
    const study_node *gravity = study_node_child(build->root, "gravity");
    study_node *base = study_node_child(platform, "base"), *top = study_node_child(platform, "top");
    const bool base_right = base && base->kind == STUDY_MAPPING && check_ring(build, base);
    const bool top_right = top && top->kind == STUDY_MAPPING && check_ring(build, top);
    study_node *inertia = study_node_child(load, "inertia");
    study_node *legs = study_node_child(platform, "legs");
    gough_machine *machine = &build->study->model->machine;
    study_part_reset(build->study, GOUGH_PART_MACHINE);
    if (inertia && !inertia->wrong) read_inertia(build, inertia, machine->load.inertia);
    if (legs && legs->kind == STUDY_MAPPING && !legs->wrong) check_legs(build, legs);
    const bool rings = base_right && top_right && !platform->wrong;
    if (!rings || !load || load->wrong || !is_right(gravity)) return false;
    machine->platform = read_rings(platform, &build->study->units);
    study_part_read(build->study, build->root, GOUGH_PART_MACHINE);
    read_drives(build);
    read_gravity(build->study, gravity, machine->gravity);
    const gough_machine read = *machine;
    gough_error error = {.message = ""};
    if (gough_machine_init(machine, &read.platform, &read.load, read.gravity, &error) == GOUGH_OK)
        return true;
    say_library(build, platform, &error);
    return false;
}

/* ---- external loads -------------------------------------------------------------------------------------------- */

/* The loads, in memory that lasts: in a sweep their number stays. */
static void read_external(study_build *build, const study_node *list) {
    if (!list || list->kind != STUDY_LIST || list->wrong) return;
    if (!build->external) build->external = calloc(list->count, sizeof *build->external);
    if (!build->external) {
        build->messages->arena->exhausted = true;
        return;
    }
    size_t count = 0;
    for (const study_node *item = list->first; item; item = item->next) {
        build->external[count] = (gough_external){.at_given = false};
        study_element_read(&build->external[count++], GOUGH_OWNER_EXTERNAL, &build->study->units,
                           item);
    }
}

/* The machine's loads, which gough_machine_init() has taken away. */
static void set_external(study_build *build) {
    const study_node *list = study_node_child(build->root, "external");
    const size_t count = build->external ? list->count : 0;
    gough_error error = {.message = ""};
    gough_machine *machine = &build->study->model->machine;
    const gough_status status = gough_machine_set_external(machine, build->external, count, &error);
    if (status != GOUGH_OK) /* unreachable: few loads, whose numbers are finite */
        say_library(build, study_node_child(build->root, "external"), &error);
}

/* ---- control --------------------------------------------------------------------------------------------------- */

/* A matrix of gains: its diagonal, and the rest. */
static bool read_gains(study_build *build, const char *name, double diagonal[GOUGH_LEGS],
                       double cross[GOUGH_LEGS][GOUGH_LEGS]) {
    const study_node *node = study_node_child(study_node_child(build->root, "control"), name);
    double number[GOUGH_LEGS][GOUGH_LEGS];
    if (!node || !node->first || node->first->kind != STUDY_LIST) return false;
    const gough_unit unit =
        strcmp(name, "stiffness") == 0 ? GOUGH_UNIT_STIFFNESS : GOUGH_UNIT_DAMPING;
    study_numbers(node, &build->study->units, unit, number[0]);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        diagonal[v] = number[v][v];
        for (int w = 0; w < GOUGH_LEGS; w++) cross[v][w] = v == w ? 0 : number[v][w];
    }
    return true;
}

static void build_control(study_build *build) {
    gough_study *study = build->study;
    study_node *node = study_node_child(build->root, "control");
    gough_control *control = &study->model->control;
    gough_error error = {.message = ""};
    study_part_reset(study, GOUGH_PART_CONTROL);
    study->sampling_run_given = study_node_at(build->root, "control.sampling.run") != NULL;
    if (!node || node->wrong) return;
    study_node *sampling = study_node_child(node, "sampling");
    /* a sweep may have made the mapping, for another of its keys */
    if (sampling && !study_node_child(sampling, "period")) {
        study_node_say(build->messages, sampling, study_node_place(sampling, true),
                       "`control.sampling.period` is missing: time between two samples");
        return;
    }
    study_part_read(study, build->root, GOUGH_PART_CONTROL);
    const bool stiff = read_gains(build, "stiffness", control->stiffness, control->cross_stiffness);
    const bool damped = read_gains(build, "damping", control->damping, control->cross_damping);
    control->coupled = stiff || damped;
    if (gough_control_check(control, &error) == GOUGH_OK) return;
    say_library(build, node, &error);
    study_part_reset(study, GOUGH_PART_CONTROL);
}

/* ---- how it is run --------------------------------------------------------------------------------------------- */

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

static void build_simulation(study_build *build, study_node *node) {
    gough_study *study = build->study;
    study_part_reset(study, GOUGH_PART_SIMULATION);
    study->simulation.commands = study_node_child(build->root, "actuators") != NULL ||
                                 study_node_at(build->root, "control.sampling") != NULL;
    if (!node || node->kind != STUDY_MAPPING || node->wrong) return;
    check_method(build, node);
    study_part_read(study, build->root, GOUGH_PART_SIMULATION);
    if (study_node_at(node, "constraints.baumgarte"))
        study->simulation.constraints = GOUGH_BAUMGARTE;
}

static void check_simulation(study_build *build, study_node *node) {
    gough_simulation run = build->study->simulation;
    gough_error error = {.message = ""};
    /* finer than double can give: for a run with --precision quad, and refused by any other */
    if (run.tolerance < 1e-15) run.precision = GOUGH_QUADRUPLE;
    if (gough_simulation_check(build->study->model, &run, &error) == GOUGH_OK) return;
    study_node *about = node ? node : study_node_child(build->root, "motion");
    if (!about) about = study_node_child(build->root, "platform"); /* unreachable: defaults run */
    say_library(build, about, &error);
}

void study_model_rebuild(study_build *build, unsigned parts) {
    study_node *simulation = study_node_child(build->root, "simulation");
    const bool machine = !(parts & GOUGH_PART_MACHINE) || build_machine(build);
    const bool motion = !(parts & GOUGH_PART_MOTION) || study_motion_build(build);
    if (parts & GOUGH_PART_EXTERNAL)
        read_external(build, study_node_child(build->root, "external"));
    if (parts & (GOUGH_PART_EXTERNAL | GOUGH_PART_MACHINE)) set_external(build);
    if (parts & GOUGH_PART_MOTION) study_moves_place(build, machine && motion);
    const unsigned simple[] = {GOUGH_PART_DISTURBANCE, GOUGH_PART_INITIAL, GOUGH_PART_WORKSPACE};
    for (size_t i = 0; i < sizeof simple / sizeof simple[0]; i++) {
        if (!(parts & simple[i])) continue;
        study_part_reset(build->study, simple[i]);
        study_part_read(build->study, build->root, simple[i]);
    }
    if (parts & GOUGH_PART_CONTROL) build_control(build);
    if (parts & GOUGH_PART_DISTURBANCE)
        build->study->noise_run_given = study_node_at(build->root, "disturbance.noise.run") != NULL;
    if (parts & GOUGH_PART_SIMULATION) build_simulation(build, simulation);
    if (machine && motion && is_right(simulation) &&
        parts & (GOUGH_PART_MOTION | GOUGH_PART_CONTROL | GOUGH_PART_SIMULATION))
        check_simulation(build, simulation);
}

void study_model_build(study_build *build) {
    build->study->units = study_units_of(build->root);
    build->study->dimensionless = build->study->units.dimensionless;
    study_model_rebuild(build, GOUGH_PART_MACHINE | GOUGH_PART_MOTION | GOUGH_PART_DISTURBANCE |
                                   GOUGH_PART_CONTROL | GOUGH_PART_INITIAL | GOUGH_PART_SIMULATION |
                                   GOUGH_PART_EXTERNAL | GOUGH_PART_WORKSPACE);
}
