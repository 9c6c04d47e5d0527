/* Each number of a model by the table of fields: what is not a number of its range is refused or does no harm, and runs of a batch
 * that differ in one number have the bits of runs alone. */
#include <stdlib.h>

#include "gough/fields.h"
#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

enum { SAMPLED = 1, LAGGING = 2, SECOND_ORDER = 4, LEGS = 8, BARE = 16, MATRICES = 32, KINDS = 6 };

static const unsigned kind[KINDS] = {BARE, SAMPLED,           LAGGING, SECOND_ORDER | SAMPLED,
                                     LEGS, MATRICES | LAGGING};

static void init_again(gough_model *model, gough_status *status, gough_error *error) {
    const gough_machine given = model->machine;
    const double gravity[3] = {given.gravity[0], given.gravity[1], given.gravity[2]};
    *status = gough_machine_init(&model->machine, &given.platform, &given.load, gravity, error);
}

static gough_model *new_model(unsigned how) {
    gough_model *m = calloc(1, sizeof *m);
    dice d = {5};
    gough_status status;
    gough_error error = {.message = ""};
    ck_assert_ptr_nonnull(m);
    skew_machine(&m->machine);
    m->control.feedforward = true;
    set_gains(m, 40, 4);
    set_formula(&m->motion.formula[GOUGH_HEAVE], "0.05*sin(t)^2");
    set_formula(&m->motion.formula[GOUGH_YAW], "0.1*sin(t)^2");
    if (how & LEGS) give_legs(&m->machine, LEGS_HEAVY | LEGS_VISCOUS | LEGS_DRY, &d);
    gough_actuators *a = &m->machine.platform.actuators;
    if (how & (LAGGING | SECOND_ORDER)) a->kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        set_formula(&m->disturbance.leg_force[v], "0.01*sin(3*t)");
        if (how & LAGGING) a->time_constant[v] = 0.02, m->control.integral[v] = 3;
        if (how & SECOND_ORDER) a->frequency[v] = 20, a->damping_ratio[v] = 0.8;
        if (how & (LAGGING | SECOND_ORDER)) a->max_force[v][0] = -3, a->max_force[v][1] = 3;
        if (how & LAGGING) a->max_rate[v] = 40;
        for (int w = 0; how & MATRICES && w < GOUGH_LEGS; w++)
            if (v != w) m->control.cross_stiffness[v][w] = 1, m->control.cross_damping[v][w] = 0.1;
    }
    m->control.coupled = how & MATRICES;
    if (how & SAMPLED)
        m->control.sampling = (gough_sampling){.period = 0.02,
                                               .delay = 0.01,
                                               .velocity = GOUGH_VELOCITY_DIFFERENCE,
                                               .cutoff = 15,
                                               .resolution = 1e-4,
                                               .noise = 1e-5,
                                               .seed = 4};
    init_again(m, &status, &error);
    ck_assert_msg(status == GOUGH_OK, "%s", error.message);
    return m;
}

static gough_simulation short_run(void) {
    gough_simulation s = gough_simulation_default();
    s.duration = 0.12;
    s.output_step = 0.04;
    return s;
}

/* ---- NaN, infinity and numbers out of range ---------------------------------------------------------------------- */

static int look(void *context, const gough_row *row) {
    bool *finite = context;
    for (int c = GOUGH_X; c < GOUGH_X + 6; c++) *finite &= isfinite(row->value[c]) != 0;
    return 0;
}

/* One wrong number: refused with a sentence, or the rows are numbers. */
static void try_number(const gough_field *field, size_t i, double bad, unsigned how) {
    gough_model *model = new_model(how);
    gough_simulation simulation = short_run();
    char *owner = field->place.owner == GOUGH_OWNER_MODEL ? (char *)model : (char *)&simulation;
    bool finite = true;
    gough_status status;
    gough_error error = {.message = ""};
    gough_end end;
    ((double *)(void *)(owner + field->place.offset))[i] = bad;
    if (field->place.given) *(bool *)(owner + field->place.given) = true;
    init_again(model, &status, &error);
    if (status == GOUGH_OK) status = gough_simulation_check(model, &simulation, &error);
    if (status == GOUGH_OK && simulation.duration <= 0.12 && simulation.output_step >= 0.001 &&
        !(fabs(bad) > 1e9 && isfinite(bad))) { /* which would take its millions of steps */
        end.cause = GOUGH_END_DONE;
        status = gough_simulate(model, &simulation, look, &finite, &end, &error);
        if (status != GOUGH_OK) finite = true; /* it says that it ended */
    }
    ck_assert_msg(status == GOUGH_OK || error.message[0] != '\0', "%s %zu = %g: no sentence",
                  field->path, i, bad);
    ck_assert_msg(finite, "%s %zu = %g: rows that are not numbers", field->path, i, bad);
    free(model);
}

START_TEST(a_wrong_number_is_refused_or_does_no_harm) {
    static const double bad[] = {NAN, INFINITY, -INFINITY, -1, 0, 1e300};
    size_t count;
    const gough_field *field = gough_fields(&count);
    for (size_t k = 0; k < count; k++) {
        const gough_place *p = &field[k].place;
        if (p->kind != GOUGH_KIND_NUMBER) continue;
        if (p->owner != GOUGH_OWNER_MODEL && p->owner != GOUGH_OWNER_SIMULATION) continue;
        for (size_t i = 0; i<p->count; i += p->count> 6 ? 5 : 1)
            for (size_t b = 0; b < sizeof bad / sizeof bad[0]; b++)
                for (int how = 0; how < KINDS; how++) try_number(&field[k], i, bad[b], kind[how]);
    }
}
END_TEST

/* ---- batches ------------------------------------------------------------------------------------------------------ */

enum { RUNS = 4 };

static gough_status run_batch(const gough_model *one, const gough_model *other, int lanes,
                              gough_outcome out[RUNS], gough_error *error) {
    gough_simulation s = short_run();
    s.method = GOUGH_RK4; /* fixed steps: runs stand in lanes where their loops are alike */
    s.step = 0.01;
    gough_batch_run run[RUNS];
    gough_batch_options o = gough_batch_options_default();
    o.lanes = lanes;
    o.threads = 1;
    for (int i = 0; i < RUNS; i++) {
        const gough_model *m = i % 2 ? other : one;
        run[i] = (gough_batch_run){&m->machine, &m->control,     &m->disturbance,
                                   &m->initial, (uint64_t)i + 1, (uint64_t)i + 1};
    }
    void *memory = aligned_alloc(64, (gough_batch_size(&o) + 63) / 64 * 64);
    ck_assert_ptr_nonnull(memory);
    memset(out, 0, RUNS * sizeof *out);
    const gough_status status = gough_batch(&one->motion, &s, run, RUNS, &o, out, memory, error);
    free(memory);
    return status;
}

/* Changes one value to another that is right, as far as its kind goes. */
static void change(const gough_field *field, size_t i, gough_model *model) {
    char *at = (char *)model + field->place.offset;
    switch (field->place.kind) {
    case GOUGH_KIND_NUMBER: {
        double *x = (double *)(void *)at + i;
        *x = *x > 0 || *x < 0 ? 1.25 * *x : 0.01;
        break;
    }
    case GOUGH_KIND_FLAG:
        ((bool *)(void *)at)[i] ^= true;
        break;
    case GOUGH_KIND_CHOICE: {
        int *x = (int *)(void *)at + i;
        *x = (*x + 1) % field->place.choices;
        break;
    }
    case GOUGH_KIND_WHOLE:
        ((uint64_t *)(void *)at)[i] += 1;
        break;
    case GOUGH_KIND_FORMULA:
        set_formula((gough_formula *)(void *)at + i, "0.001*t");
        break;
    }
    if (field->place.given) *(bool *)((char *)model + field->place.given) = true;
}

static void differ_in(const gough_field *field, size_t i, unsigned how) {
    gough_model *one = new_model(how), *other = new_model(how);
    gough_outcome alone[RUNS], beside[RUNS];
    gough_status status;
    gough_error error = {.message = ""};
    change(field, i, other);
    init_again(other, &status, &error);
    if (status == GOUGH_OK) status = run_batch(one, other, 1, alone, &error);
    if (status == GOUGH_OK && gough_batch_lanes() >= 4) {
        ck_assert_msg(run_batch(one, other, 4, beside, &error) == GOUGH_OK, "%s: %s", field->path,
                      error.message);
        ck_assert_msg(memcmp(alone, beside, sizeof alone) == 0, "%s %zu: other bits in lanes",
                      field->path, i);
    }
    ck_assert_msg(status == GOUGH_OK || error.message[0] != '\0', "%s: no sentence", field->path);
    free(one);
    free(other);
}

START_TEST(runs_that_differ_in_one_number_have_the_bits_of_runs_alone) {
    size_t count;
    const gough_field *field = gough_fields(&count);
    for (size_t k = 0; k < count; k++) {
        const gough_place *p = &field[k].place;
        if (p->owner != GOUGH_OWNER_MODEL || p->part & GOUGH_PART_MOTION) continue;
        for (size_t i = 0; i < p->count; i += 5)
            for (size_t how = 0; how < (p->part & GOUGH_PART_CONTROL ? KINDS : 2); how++)
                differ_in(&field[k], i, kind[(k + i + how) % KINDS]);
    }
}
END_TEST

/* Runs of a batch have the same kinds of legs and the same number of loads. */
START_TEST(runs_of_other_kinds_are_refused) {
    gough_model *bare = new_model(BARE), *legs = new_model(LEGS), *loaded = new_model(BARE);
    gough_outcome out[RUNS];
    gough_error error = {.message = ""};
    gough_external load = {.at_given = false};
    set_formula(&load.force[0], "0.1");
    ck_assert_int_eq(gough_machine_set_external(&loaded->machine, &load, 1, &error), GOUGH_OK);
    ck_assert_int_eq(run_batch(bare, legs, 1, out, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "run 1 takes the mass or friction of its legs"));
    ck_assert_int_eq(run_batch(bare, loaded, 1, out, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "run 1 has another number of external loads"));
    ck_assert_int_eq(run_batch(loaded, loaded, 1, out, &error), GOUGH_OK);
    free(bare);
    free(legs);
    free(loaded);
}
END_TEST

/* Runs whose loops have other parts do not stand in the same lanes. */
static void have_the_bits_of_runs_alone(const gough_model *one, const gough_model *other) {
    gough_outcome alone[RUNS], beside[RUNS];
    gough_error error = {.message = ""};
    ck_assert_msg(run_batch(one, other, 1, alone, &error) == GOUGH_OK, "%s", error.message);
    if (gough_batch_lanes() < 4) return;
    ck_assert_msg(run_batch(one, other, 4, beside, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_int_eq(memcmp(alone, beside, sizeof alone), 0);
}

START_TEST(loops_of_other_parts_have_the_bits_of_runs_alone) {
    for (int what = -1; what < 6; what++) {
        gough_model *one = new_model(what < 3 ? BARE : SAMPLED);
        gough_model *other = new_model(what < 0    ? SECOND_ORDER
                                       : what == 0 ? LAGGING
                                       : what < 3  ? BARE
                                                   : SAMPLED);
        gough_status status;
        gough_error error = {.message = ""};
        for (int v = 0; v < GOUGH_LEGS; v++) {
            if (what == 0) other->control.integral[v] = 0;
            if (what < 1) {
                gough_actuators *a = &other->machine.platform.actuators;
                a->max_force[v][0] = a->max_force[v][1] = a->max_rate[v] = 0;
            }
            if (what != 1) continue;
            other->machine.platform.actuators.max_force[v][0] = -2;
            other->machine.platform.actuators.max_force[v][1] = 2;
        }
        if (what == 2) set_formula(&other->disturbance.leg_force[1], "0.01*ramp(t, 0.035)");
        if (what == 3) {
            other->control.sampling.velocity = GOUGH_VELOCITY_EXACT;
            one->control.sampling.cutoff = other->control.sampling.cutoff = 0;
        }
        if (what == 4) other->control.sampling.preview = 0.01;
        if (what == 5) other->control.sampling.delay = 0;
        init_again(other, &status, &error);
        ck_assert_msg(status == GOUGH_OK, "%s", error.message);
        gough_external load[2] = {{.at_given = false}, {.at_given = false}};
        if (what == 2) { /* corners of known loads end steps too */
            one->disturbance = other->disturbance;
            set_formula(&load[1].force[0], "0.1*ramp(t, 0.035)");
            ck_assert_int_eq(gough_machine_set_external(&one->machine, &load[0], 1, &error), 0);
            ck_assert_int_eq(gough_machine_set_external(&other->machine, &load[1], 1, &error), 0);
        }
        have_the_bits_of_runs_alone(one, other);
        have_the_bits_of_runs_alone(other, one);
        free(one);
        free(other);
    }
}
END_TEST

/* Gains and times so large that no number holds what they make. */
START_TEST(gains_beyond_all_numbers_are_refused) {
    for (int what = 0; what < 3; what++) {
        gough_model *model = new_model(what < 2 ? BARE : SAMPLED);
        gough_stiffness stiffness;
        gough_rest rest;
        gough_sampled_rest sampled;
        gough_error error = {.message = ""};
        double matrix[GOUGH_LINEAR][GOUGH_LINEAR];
        const gough_state state = gough_state_home(&model->machine);
        set_gains(model, what == 1 ? 1 : 1.7e308, what == 1 ? 1.7e308 : 1);
        const bool firm = gough_stiffness_at_rest(model, NULL, &stiffness, &error) == GOUGH_OK;
        ck_assert(firm == (what == 1));
        if (what < 2) {
            error.message[0] = '\0';
            ck_assert_int_eq(gough_stability_at_rest(model, NULL, &rest, &error),
                             GOUGH_ERROR_NUMERICAL);
            ck_assert(error.message[0] != '\0');
            error.message[0] = '\0';
            ck_assert_int_eq(gough_linearise(model, 0, &state, GOUGH_LINEAR, matrix[0], &error),
                             GOUGH_ERROR_NUMERICAL);
            ck_assert(error.message[0] != '\0');
        } else {
            ck_assert(gough_sampled_at_rest(model, NULL, &sampled, &error) != GOUGH_OK ||
                      isfinite(sampled.radius));
        }
        free(model);
    }
}
END_TEST

/* Lags of all legs have one order. */
START_TEST(lags_of_two_orders_are_refused) {
    for (int second = 0; second < 2; second++) {
        gough_model *model = new_model(second ? LAGGING : SECOND_ORDER);
        gough_actuators *a = &model->machine.platform.actuators;
        gough_status status;
        gough_error error = {.message = ""};
        a->max_rate[2] = 0;
        a->time_constant[2] = second ? 0 : 0.02;
        a->frequency[2] = second ? 20 : 0;
        a->damping_ratio[2] = second ? 0.8 : 0;
        init_again(model, &status, &error);
        ck_assert_int_eq(status, GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, second ? "the lag of leg 3 is of second order"
                                                           : "the lag of leg 3 is of first order"));
        free(model);
    }
}
END_TEST

/* A matrix of gains whose diagonal is 0 has a pattern too. */
START_TEST(a_pattern_of_gains_may_lie_beside_the_diagonal) {
    gough_model *model = new_model(SAMPLED);
    gough_sampled_margins margins;
    gough_error error = {.message = ""};
    memset(model->control.stiffness, 0, sizeof model->control.stiffness);
    model->control.coupled = true;
    for (int v = 0; v < GOUGH_LEGS; v++) model->control.cross_stiffness[v][(v + 1) % 6] = 30;
    ck_assert_msg(gough_sampled_margins_at_rest(model, NULL, &margins, &error) == GOUGH_OK, "%s",
                  error.message);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("batch/each_field", 120, a_wrong_number_is_refused_or_does_no_harm,
                     runs_of_other_kinds_are_refused,
                     loops_of_other_parts_have_the_bits_of_runs_alone,
                     gains_beyond_all_numbers_are_refused, lags_of_two_orders_are_refused,
                     a_pattern_of_gains_may_lie_beside_the_diagonal,
                     runs_that_differ_in_one_number_have_the_bits_of_runs_alone);
}
