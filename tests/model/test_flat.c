/* A model and its options as one array: nothing is lost on the way there and back, runs keep their bits, and an array that is
 * damaged anywhere is refused with a sentence. */
#include <stdio.h>
#include <stdlib.h>

#include "support/fields.h"
#include "support/machines.h"
#include "support/suite.h"

enum { ROWS = 40 };

/* An array and what came out of it. */
typedef struct {
    double *flat;
    size_t count;
    gough_model *model;
    gough_simulation simulation;
    void *memory;
} unpacked;

static unpacked pack(const gough_model *model, const gough_simulation *simulation) {
    unpacked u = {.count = gough_model_flat_size(model)};

    u.flat = malloc((u.count + 1) * sizeof(double));
    u.flat[u.count] = 17;
    gough_model_flatten(model, simulation, u.flat);
    ck_assert(u.flat[u.count] == 17);
    return u;
}

static gough_status unpack(unpacked *u, gough_error *error) {
    const size_t bytes = gough_model_flat_memory(u->flat, u->count);

    ck_assert(bytes <= 2 * u->count * sizeof(double) + GOUGH_EXTERNALS * sizeof(gough_external));
    u->model = malloc(sizeof *u->model);
    u->memory = bytes ? malloc(bytes) : NULL;
    return gough_model_unflatten(u->model, &u->simulation, u->memory, u->flat, u->count, error);
}

static void drop(unpacked *u) {
    free(u->memory);
    free(u->model);
    u->memory = u->model = NULL;
}

static void release(unpacked *u) {
    drop(u);
    free(u->flat);
}

/* ---- models ---- */

static gough_simulation options(void) {
    gough_simulation s = gough_simulation_default();

    s.duration = 2;
    s.output_step = 0.25;
    s.method = GOUGH_RK4;
    s.step = 0.125;
    s.constraints = GOUGH_BAUMGARTE;
    s.baumgarte[0] = 3;
    s.baumgarte[1] = 4;
    s.reactions = true;
    s.joints = true;
    s.commands = s.actuators = true;
    return s;
}

/* something in every field */
static gough_model *full_model(void) {
    gough_model *m = calloc(1, sizeof *m);

    skew_machine(&m->machine);
    m->machine.platform.length_min = 0.5;
    m->machine.platform.force_max = 100;
    set_all_axes(m);
    for (int a = 0; a < 3; a++) {
        m->motion.about[a] = 0.1 * a - 0.05;
        m->initial.velocity[a] = 0.01 * a;
        m->initial.angular_velocity[a] = 0.02 - 0.01 * a;
    }
    m->motion.angle_unit = pi / 180;
    m->motion.period = 11;
    m->motion.scaled = true;
    m->motion.amplitude = 0.9;
    m->motion.frequency = 1.1;
    m->control.feedforward = m->control.coupled = true;
    m->control.tracking_time = 0.5;
    m->control.sampling = (gough_sampling){.period = 0.25,
                                           .delay = 0.125,
                                           .velocity = GOUGH_VELOCITY_DIFFERENCE,
                                           .cutoff = 1.5,
                                           .resolution = 1e-6,
                                           .noise = 1e-7,
                                           .seed = UINT64_MAX - 7,
                                           .run = 12,
                                           .preview = 0.3};
    m->machine.platform.actuators.kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        m->control.stiffness[v] = 20 + v;
        m->control.damping[v] = 1 + 0.1 * v;
        m->control.integral[v] = 3 + 0.1 * v;
        m->control.cross_stiffness[v][(v + 1) % 6] = 0.2 - v;
        m->control.cross_damping[v][(v + 2) % 6] = 0.01 * v;
        m->machine.platform.actuators.max_force[v][0] = -50 - v;
        m->machine.platform.actuators.max_force[v][1] = 60 + v;
        m->machine.platform.actuators.time_constant[v] = 0.1 + 0.01 * v;
        m->machine.platform.actuators.max_rate[v] = 500 + v;
        set_formula(&m->disturbance.leg_force[v], "0.01*sin(pi*t)^2 - 2^-t*0.003");
    }
    set_formula(&m->disturbance.vertical_force, "0.02*ramp(t, 3 - 2)");
    set_formula(&m->disturbance.force[1], "atan2(t, 2)/100");
    set_formula(&m->disturbance.moment[2], "-(0.01*tanh(t))");
    m->disturbance.noise = (gough_noise){0.01, 0.02, 0.001, 0.3, UINT64_MAX - 5, 1u << 31};
    m->initial.component[GOUGH_PITCH] = 0.03;
    m->initial.given[GOUGH_PITCH] = true;
    m->initial.velocity_given = true;
    m->initial.angular_velocity_given = true;
    return m;
}

static gough_model *moving_model(void) {
    static const gough_move moves[2] = {
        {.start = 0.25, .duration = 1, .target = {0.05, 0, 0.1}, .given = {true, false, true}},
        {.start = 1.25, .duration = 0.5, .target = {0, 0, 0, 0.1}, .given = {[3] = true}}};
    static gough_external load[2];
    gough_model *m = calloc(1, sizeof *m);

    paper_machine(&m->machine);
    for (int n = 0; n < 2; n++) {
        load[n] = (gough_external){.at = {0.1, 0.2, n}, .at_given = n == 1, .turns = n == 1};
        set_formula(&load[n].force[n], "0.01*sin(t)");
    }
    ck_assert(gough_machine_set_external(&m->machine, load, 2, NULL) == GOUGH_OK);
    m->motion.order = GOUGH_XYZ;
    m->motion.kind = GOUGH_MOTION_MOVES;
    m->motion.move = moves;
    m->motion.moves = 2;
    set_gains(m, 30, 2);
    return m;
}

static gough_model *recorded_model(gough_simulation *s, double store[14 * ROWS]) {
    gough_model *m = calloc(1, sizeof *m);
    double scratch[2 * ROWS], *time = store, *value = store + ROWS;
    dice d = {7};

    for (int i = 0; i < ROWS; i++) {
        time[i] = i > 0 ? time[i - 1] + dice_between(&d, 0.05, 0.1) : -0.01;
        for (int c = 0; c < 6; c++) value[6 * i + c] = 0.05 * sin(time[i] + c);
    }
    paper_machine(&m->machine);
    m->motion.kind = GOUGH_MOTION_SAMPLES;
    m->motion.samples =
        (gough_samples){.count = ROWS, .time = time, .value = value, .curvature = store + 7 * ROWS};
    ck_assert(gough_samples_prepare(&m->motion.samples, scratch, NULL) == GOUGH_OK);
    set_gains(m, 30, 2);
    s->duration = 1;
    return m;
}

/* ---- the same back ---- */

static void same_fields(const gough_model *a, const gough_model *b) {
    const gough_motion *m = &a->motion, *n = &b->motion;
    const char *differs = field_differs(GOUGH_OWNER_MODEL, a, b);

    ck_assert_msg(differs == NULL, "%s", differs);
    ck_assert(memcmp(&a->machine, &b->machine, offsetof(gough_machine, external)) == 0);
    ck_assert(a->machine.externals == b->machine.externals);
    for (size_t i = 0; i < a->machine.externals; i++) {
        differs =
            field_differs(GOUGH_OWNER_EXTERNAL, &a->machine.external[i], &b->machine.external[i]);
        ck_assert_msg(differs == NULL, "%s", differs);
    }
    ck_assert(m->moves == n->moves && m->samples.count == n->samples.count);
    for (size_t i = 0; i < m->moves; i++) {
        differs = field_differs(GOUGH_OWNER_MOVE, &m->move[i], &n->move[i]);
        ck_assert_msg(differs == NULL, "%s", differs);
    }
    for (size_t i = 0; i < m->samples.count * 6; i++)
        ck_assert(m->samples.curvature[i] == n->samples.curvature[i]);
}

static void same_options(const gough_simulation *a, const gough_simulation *b) {
    const char *differs = field_differs(GOUGH_OWNER_SIMULATION, a, b);

    ck_assert_msg(differs == NULL, "%s", differs);
}

typedef struct {
    double value[64][GOUGH_COLUMNS];
    int rows;
} table;

static int keep(void *context, const gough_row *row) {
    table *t = context;

    if (t->rows == 64) return 1;
    memcpy(t->value[t->rows++], row->value, sizeof row->value);
    return 0;
}

static void same_there_and_back(gough_model *model, const gough_simulation *simulation) {
    gough_error error = {.message = ""};
    unpacked u = pack(model, simulation), again;
    table *before = calloc(2, sizeof *before), *after = before + 1;
    gough_end end[2];

    ck_assert_msg(unpack(&u, &error) == GOUGH_OK, "%s", error.message);
    same_fields(model, u.model);
    same_options(simulation, &u.simulation);
    again = pack(u.model, &u.simulation);
    ck_assert_uint_eq(again.count, u.count);
    ck_assert(memcmp(again.flat, u.flat, u.count * sizeof(double)) == 0);

    gough_simulate(model, simulation, keep, before, &end[0], NULL);
    gough_simulate(u.model, &u.simulation, keep, after, &end[1], NULL);
    ck_assert_int_ge(before->rows, 4);
    ck_assert_int_eq(before->rows, after->rows);
    ck_assert_int_eq(end[0].cause, end[1].cause);
    ck_assert(memcmp(before->value, after->value, sizeof before->value) == 0);

    free(before);
    release(&u);
    release(&again);
    free(model);
}

START_TEST(a_study_with_everything_comes_back) {
    const gough_simulation s = options();
    same_there_and_back(full_model(), &s);
}
END_TEST

START_TEST(moves_come_back) {
    gough_simulation s = options();

    s.method = GOUGH_DOP853;
    s.step = 0;
    s.constraints = GOUGH_PROJECTION;
    same_there_and_back(moving_model(), &s);
}
END_TEST

START_TEST(recorded_motion_comes_back) {
    double store[14 * ROWS];
    gough_simulation s = options();
    gough_model *m = recorded_model(&s, store);

    same_there_and_back(m, &s);
}
END_TEST

START_TEST(motion_recorded_about_turned_axes_comes_back) {
    static const double axes[4] = {2, -1, 0, 1};
    double store[14 * ROWS];
    gough_simulation s = options();
    gough_model *m = recorded_model(&s, store);

    memcpy(m->motion.samples.axes, axes, sizeof axes);
    same_there_and_back(m, &s);
}
END_TEST

START_TEST(axes_that_are_no_rotation_are_refused) {
    double store[14 * ROWS];
    gough_simulation s = options();
    gough_model *m = recorded_model(&s, store);
    gough_error error = {.message = ""};

    m->motion.samples.axes[2] = 1e150;
    unpacked u = pack(m, &s);
    ck_assert_int_eq(unpack(&u, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "quaternion"), "%s", error.message);
    drop(&u);
    m->motion.samples.axes[2] = NAN;
    ck_assert_int_eq(gough_simulation_check(m, &s, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "quaternion"), "%s", error.message);
    release(&u);
    free(m);
}
END_TEST

START_TEST(an_empty_study_comes_back) {
    gough_simulation s = options();
    gough_model *m = calloc(1, sizeof *m);

    paper_machine(&m->machine);
    m->control.feedforward = true;
    s.constraints = GOUGH_NONE;
    same_there_and_back(m, &s);
}
END_TEST

/* ---- damage ---- */

/* whether an array is refused, and then with a sentence */
static bool refused(unpacked *u) {
    gough_error error = {.message = ""};
    const gough_status status = unpack(u, &error);

    drop(u);
    if (status == GOUGH_OK) return false;
    ck_assert_int_eq(status, GOUGH_ERROR_INPUT);
    ck_assert_msg(strlen(error.message) > 10, "'%s'", error.message);
    return true;
}

static unpacked pack_any(int which) {
    double store[14 * ROWS];
    gough_simulation s = options();
    gough_model *m = which == 0   ? full_model()
                     : which == 1 ? moving_model()
                                  : recorded_model(&s, store);
    const unpacked u = pack(m, &s);

    free(m);
    return u;
}

START_TEST(an_array_cut_short_is_refused) {
    for (int which = 0; which < 3; which++) {
        unpacked u = pack_any(which);
        const size_t count = u.count;
        double *whole = u.flat;

        for (size_t n = 0; n < count; n++) {
            /* in memory of its own length, so that a sanitizer sees a look beyond */
            u.flat = malloc(n > 0 ? n * sizeof(double) : 1);
            memcpy(u.flat, whole, n * sizeof(double));
            u.count = n;
            ck_assert(refused(&u));
            if (n > 1) u.flat[1] = (double)n;
            ck_assert(refused(&u));
            free(u.flat);
        }
        free(whole);
    }
}
END_TEST

START_TEST(an_array_that_goes_on_is_refused) {
    unpacked u = pack_any(0);

    u.count++;
    ck_assert(refused(&u));
    u.flat[1] = (double)u.count;
    ck_assert(refused(&u));
    release(&u);
}
END_TEST

START_TEST(a_number_that_is_none_is_refused_anywhere) {
    for (int which = 0; which < 3; which++) {
        unpacked u = pack_any(which);
        int passed = 0;

        for (size_t i = 0; i < u.count; i++) {
            const double good = u.flat[i];
            u.flat[i] = NAN;
            ck_assert_msg(refused(&u), "model %d, number %zu", which, i);
            u.flat[i] = INFINITY;
            passed += !refused(&u);
            u.flat[i] = good;
        }
        ck_assert_int_eq(passed, 3); /* greatest length, speed and force: no limit */
        ck_assert(!refused(&u));
        release(&u);
    }
}
END_TEST

START_TEST(another_format_is_named) {
    gough_error error = {.message = ""};
    unpacked u = pack_any(0);

    u.flat[0] = 1;
    ck_assert_int_eq(unpack(&u, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "format 1"));
    release(&u);
}
END_TEST

/* few steps of whatever came through, whose own options may ask for days */
static void try_it(unpacked *u) {
    gough_simulation s = options();
    table *t = calloc(1, sizeof *t);
    gough_end end;

    s.duration = 0.5;
    gough_simulate(u->model, &s, keep, t, &end, NULL);
    free(t);
}

START_TEST(mutated_arrays_are_refused_or_run) {
    static const double values[] = {0,      1,      2,     -1,   0.5, 1e-300, -1e300,
                                    1e300,  6,      7,     20,   21,  192,    193,
                                    0x1p53, 0x1p32, 1e-17, 1e-9, 3.7, -0.0,   5e-324};
    dice d = {20261122};
    int accepted = 0;

    for (int which = 0; which < 3; which++) {
        unpacked u = pack_any(which);
        double *good = malloc(u.count * sizeof(double));
        memcpy(good, u.flat, u.count * sizeof(double));
        for (int i = 0; i < 3000; i++) {
            const int places = 1 + (int)(dice_bits(&d) % 4);
            for (int k = 0; k < places; k++) {
                const size_t at = dice_bits(&d) % u.count;
                const size_t value = dice_bits(&d) % (sizeof values / sizeof values[0]);
                u.flat[at] = dice_bits(&d) % 8 ? values[value] : dice_between(&d, -10, 10);
            }
            if (unpack(&u, NULL) == GOUGH_OK) {
                accepted++;
                try_it(&u);
            }
            drop(&u);
            memcpy(u.flat, good, u.count * sizeof(double));
        }
        free(good);
        release(&u);
    }
    ck_assert_int_gt(accepted, 100); /* else nothing was tried */
}
END_TEST

int main(void) {
    return SUITE_RUN("flat", 60, a_study_with_everything_comes_back, moves_come_back,
                     recorded_motion_comes_back, motion_recorded_about_turned_axes_comes_back,
                     axes_that_are_no_rotation_are_refused, an_empty_study_comes_back,
                     an_array_cut_short_is_refused, an_array_that_goes_on_is_refused,
                     a_number_that_is_none_is_refused_anywhere, another_format_is_named,
                     mutated_arrays_are_refused_or_run);
}
