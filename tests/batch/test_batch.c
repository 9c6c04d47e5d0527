/* Batches: the bits of one run alone, whatever stands beside it; each run's own end.
 * Label: standard. */
#include "runs.h"

static void check_everything_alike(int differing, gough_method method, double step,
                                   double damping) {
    fixture *f = new_fixture(differing, damping);
    const gough_simulation s = fixed(method, step, 1);

    run_batch(f, &s, 1, 1, f->outcome);
    check_alone(f, &s);
    for (int lanes = 2; lanes <= gough_batch_lanes(); lanes *= 2) {
        for (int threads = 1; threads <= 3; threads += 2) {
            run_batch(f, &s, lanes, threads, f->other);
            for (int i = 0; i < RUNS; i++) {
                const double *a = (const double *)&f->outcome[i], *b = (const double *)&f->other[i];
                for (size_t k = 1; k < sizeof(gough_outcome) / sizeof(double); k++)
                    ck_assert_msg(
                        memcmp(a + k, b + k, sizeof *a) == 0,
                        "%s: %d lanes, %d threads: number %zu of run %d is %.17g, not %.17g",
                        gough_method_name((int)method), lanes, threads, k, i, b[k], a[k]);
            }
        }
    }
    free(f);
}

START_TEST(lanes_and_threads_change_no_bit) {
    check_everything_alike(0, GOUGH_RK4, 0.01, 2);
    check_everything_alike(0, GOUGH_DOP853, 0.05, 2);
    check_everything_alike(0, GOUGH_RATTLE2, 0.01, 2);
    check_everything_alike(0, GOUGH_RATTLE4, 0.02, 0);
    check_everything_alike(0, GOUGH_RATTLE8, 0.02, 2);
}
END_TEST

START_TEST(runs_may_differ_in_everything_but_the_program) {
    check_everything_alike(LOADS, GOUGH_RK4, 0.01, 2);
    check_everything_alike(DISTURBANCES, GOUGH_RK4, 0.01, 2);
    check_everything_alike(LOADS | DISTURBANCES | VERTICAL, GOUGH_DOP853, 0.05, 2);
    check_everything_alike(VERTICAL, GOUGH_RATTLE4, 0.02, 2);
    check_everything_alike(NOISE, GOUGH_RK4, 0.01, 2);
    check_everything_alike(NOISE | LOADS | DISTURBANCES, GOUGH_RATTLE4, 0.02, 0);
}
END_TEST

START_TEST(legs_with_mass_and_friction_keep_the_bits) {
    check_everything_alike(HEAVY, GOUGH_RK4, 0.01, 2);
    check_everything_alike(HEAVY, GOUGH_RATTLE4, 0.02, 1);
    check_everything_alike(FRICTION, GOUGH_RK4, 0.01, 0);
    check_everything_alike(HEAVY | FRICTION | LOADS | VERTICAL, GOUGH_DOP853, 0.05, 2);
}
END_TEST

START_TEST(sampled_and_lagging_loops_keep_the_bits) {
    check_everything_alike(SAMPLED, GOUGH_RK4, 0.01, 1);
    check_everything_alike(SAMPLED | LOADS | DISTURBANCES | VERTICAL, GOUGH_DOP853, 0.01, 1);
    check_everything_alike(SAMPLED | LIMITED | NOISE, GOUGH_RATTLE4, 0.01, 1);
    check_everything_alike(LAGGING | LOADS, GOUGH_RK4, 0.01, 1);
    check_everything_alike(LAGGING | LIMITED | LOADS | VERTICAL | MATRICES, GOUGH_RK4, 0.01, 1);
    check_everything_alike(SAMPLED | LAGGING | LIMITED | LOADS | MATRICES, GOUGH_DOP853, 0.01, 1);
}
END_TEST

/* a control that knows nothing of the legs is the same in all runs */
START_TEST(what_chooses_equations_is_the_same_in_all_runs) {
    fixture *f = new_fixture(HEAVY, 2);
    const gough_simulation s = fixed(GOUGH_RK4, 0.01, 3);
    gough_batch_options options = gough_batch_options_default();
    gough_error error = {0};
    char memory[64];

    for (int i = 0; i < RUNS; i++)
        f->control[i].ignores_legs = f->control[i].ignores_friction = true;
    run_batch(f, &s, 0, 1, f->outcome);
    check_alone(f, &s);
    f->control[7].ignores_legs = false;
    ck_assert_int_eq(
        gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
        GOUGH_ERROR_INPUT);
    ck_assert_msg(strncmp(error.message, "run 7 takes the mass or friction", 32) == 0, "%s",
                  error.message);
    free(f);
}
END_TEST

START_TEST(adaptive_runs_go_one_by_one) {
    fixture *f = new_fixture(LOADS, 2);
    gough_simulation s = fixed(GOUGH_DOP853, 0, 3);

    run_batch(f, &s, 0, 2, f->outcome);
    check_alone(f, &s);
    run_batch(f, &s, 0, 1, f->other);
    ck_assert(memcmp(f->outcome, f->other, sizeof f->outcome) == 0);
    free(f);
}
END_TEST

/* some runs fall without force, some leave a limit at once, some later, the rest reach the end */
/* lanes are of doubles */
START_TEST(runs_in_quadruple_precision_go_one_by_one) {
    fixture *f = new_fixture(LOADS, 2);
    gough_simulation s = fixed(GOUGH_RK4, 0.1, 0.2);

    s.precision = GOUGH_QUADRUPLE;
    run_batch(f, &s, 0, 2, f->outcome);
    check_alone(f, &s);
    free(f);
}
END_TEST

START_TEST(each_run_has_its_own_end) {
    fixture *f = new_fixture(LOADS, 2);
    const gough_simulation s = fixed(GOUGH_RK4, 0.01, 3);
    int causes[GOUGH_END_STOPPED + 1] = {0};

    f->model.control.feedforward = false;
    for (int i = 0; i < RUNS; i++) {
        f->control[i].feedforward = false;
        for (int v = 0; v < 6; v++) {
            if (i % 5 == 1) f->control[i].stiffness[v] = f->control[i].damping[v] = 0;
        }
        if (i % 5 == 2) f->machine[i].platform.length_max = f->machine[i].home_length[0] * 1.04;
        if (i % 5 == 3) f->machine[i].platform.length_min = f->machine[i].home_length[0] * 1.2;
        if (i % 5 == 4) f->machine[i].platform.force_max = 0.4;
    }
    run_batch(f, &s, 1, 1, f->outcome);
    check_alone(f, &s);
    for (int lanes = 2; lanes <= gough_batch_lanes(); lanes *= 2) {
        run_batch(f, &s, lanes, 2, f->other);
        ck_assert(memcmp(f->outcome, f->other, sizeof f->outcome) == 0);
    }
    for (int i = 0; i < RUNS; i++) causes[f->outcome[i].cause]++;
    ck_assert_int_gt(causes[GOUGH_END_DONE], 0);
    ck_assert_int_gt(causes[GOUGH_END_SINGULAR], 0);
    ck_assert_int_gt(causes[GOUGH_END_LEG_SHORT], 0);
    ck_assert_int_gt(causes[GOUGH_END_LEG_FORCE], 0);
    free(f);
}
END_TEST

/* The program forces of a sample are those of a later time, at which the program may have no number: there each lane's run ends as
 * it does alone. */
START_TEST(a_preview_beyond_the_program_ends_every_lane) {
    fixture *f = new_fixture(LOADS | SAMPLED, 2);
    const gough_simulation s = fixed(GOUGH_RK4, 0.01, 2);

    set_formula(&f->model.motion.formula[GOUGH_HEAVE], "0.02*(1 - t)^2.5");
    for (int i = 0; i < RUNS; i++) f->control[i].sampling.preview = 0.2;
    run_batch(f, &s, 1, 1, f->outcome);
    check_alone(f, &s);
    for (int i = 0; i < RUNS; i++) {
        ck_assert_int_eq(f->outcome[i].cause, GOUGH_END_NOT_FINITE);
        ck_assert_double_eq_tol(f->outcome[i].time, 0.8, 0.021); /* a period before 1 at most */
    }
    for (int lanes = 2; lanes <= gough_batch_lanes(); lanes *= 2) {
        run_batch(f, &s, lanes, 2, f->other);
        ck_assert(memcmp(f->outcome, f->other, sizeof f->outcome) == 0);
    }
    free(f);
}
END_TEST

/* peaks and work of the motion, between rows too, are those that gough_simulate() sums up */
static void check_sums(fixture *f, const gough_simulation *simulation, bool some_end) {
    int ended = 0;

    run_batch(f, simulation, 0, 2, f->outcome);
    for (int i = 0; i < RUNS; i++) {
        gough_simulation s = *simulation;
        gough_model *model = malloc(sizeof *model);
        double force = 0, speed = 0, power = -1, braking = 1, energy = 0;
        gough_summary sum;
        gough_end end;
        *model = f->model;
        model->machine = *f->run[i].machine;
        model->control = f->control[i];
        model->disturbance = *f->run[i].disturbance;
        model->initial = f->initial[i];
        model->disturbance.noise.run = f->run[i].number;
        model->control.sampling.run = f->run[i].number;
        s.summary = &sum;
        const gough_status status = gough_simulate(model, &s, NULL, NULL, &end, NULL);
        ended += status != GOUGH_OK;
        for (int v = 0; v < 6; v++) {
            const gough_leg_summary *leg = &sum.leg[v];
            force = fmax(force, fmax(fabs(leg->force_min), fabs(leg->force_max)));
            speed = fmax(speed, leg->speed);
            power = fmax(power, leg->power_max);
            braking = fmin(braking, leg->power_min);
            energy += leg->energy;
        }
        const gough_outcome *out = &f->outcome[i];
        ck_assert_double_eq_tol(out->position_deviation, sum.position_deviation, 1e-14);
        ck_assert_double_eq_tol(out->angle_deviation, sum.angle_deviation, 1e-12);
        ck_assert_double_eq_tol(out->force, force, 1e-13 * (1 + force));
        ck_assert_double_eq_tol(out->speed, speed, 1e-13 * (1 + speed));
        ck_assert(some_end || (power > 0.01 && braking < -0.01));
        ck_assert_double_eq_tol(out->power_greatest, power, 1e-13 * (1 + fabs(power)));
        ck_assert_double_eq_tol(out->power_least, braking, 1e-13 * (1 + fabs(braking)));
        ck_assert_double_eq_tol(out->energy, energy, 1e-12 * (1 + fabs(energy)));
        ck_assert(!(fabs(out->drift - sum.drift) > 0));
        ck_assert(!(fabs(out->rows - (double)sum.rows) > 0));
        ck_assert(!(fabs(out->time - end.time) > 0));
        free(model);
    }
    ck_assert(some_end == (ended > 0));
}

START_TEST(outcomes_are_summaries) {
    static const gough_method method[] = {GOUGH_RK4, GOUGH_DOP853, GOUGH_RATTLE4};

    for (int m = 0; m < 3; m++) {
        fixture *f = new_fixture(LOADS | NOISE, 2);
        gough_simulation s = fixed(method[m], 0.01, 1.5);
        check_sums(f, &s, false);
        s.output_step = 0.5; /* few rows */
        check_sums(f, &s, false);
        s.duration = 1.4973; /* and a last step shorter than others */
        check_sums(f, &s, false);
        free(f);
    }
}
END_TEST

/* what is seen at the moment that ends a run counts; steps are cut at ramps, and nothing is interpolated across their ends */
START_TEST(outcomes_of_sampled_loops_are_summaries) {
    fixture *f = new_fixture(LOADS | NOISE | SAMPLED | LAGGING, 1);
    gough_simulation s = fixed(GOUGH_RK4, 0.01, 3);

    for (int i = 0; i < RUNS; i++) { /* gains that hold such loops */
        for (int v = 0; v < 6; v++) {
            f->control[i].stiffness[v] = 4 + 0.1 * i;
            f->control[i].damping[v] = 0.9;
            f->control[i].integral[v] = 0.5;
        }
    }
    check_sums(f, &s, false);
    s.output_step = 1;
    s.duration = 2.9973;
    check_sums(f, &s, false);
    for (int i = 0; i < RUNS; i++) {
        if (i % 5 == 4) f->machine[i].platform.force_max = 0.4;
    }
    check_sums(f, &s, true);
    free(f);
}
END_TEST

START_TEST(outcomes_of_ended_and_disturbed_runs_are_summaries) {
    fixture *f = new_fixture(LOADS, 2);
    gough_simulation s = fixed(GOUGH_RK4, 0.01, 3);

    s.output_step = 0.5;
    set_formula(&f->model.disturbance.force[0],
                "0.3*(ramp(t - 1.2345, 0.003) - ramp(t - 1.3, 0.2))");
    check_sums(f, &s, false);
    for (int i = 0; i < RUNS; i++) {
        if (i % 5 == 3) f->machine[i].platform.length_min = f->machine[i].home_length[0] * 0.995;
        if (i % 5 == 4) f->machine[i].platform.force_max = 0.4;
    }
    check_sums(f, &s, true);
    free(f);
}
END_TEST

/* runs whose disturbances divide the steps differently give the same numbers in any company */
START_TEST(runs_that_divide_time_differently_keep_their_numbers) {
    fixture *f = new_fixture(DISTURBANCES, 2);
    gough_simulation s = fixed(GOUGH_RK4, 0.01, 3);

    for (int i = 0; i < RUNS; i++) {
        char text[64];
        snprintf(text, sizeof text, "0.3*ramp(t - %.9g, 0.004)", 0.5 + 0.05 * i);
        set_formula(&f->disturbance[i].force[1], text);
    }
    s.output_step = 0.5;
    check_sums(f, &s, false);
    memcpy(f->other, f->outcome, sizeof f->outcome);
    for (int i = 0; i < RUNS; i++) { /* each in a batch of its own */
        gough_batch_options options = gough_batch_options_default();
        options.sizing = true;
        void *memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
        ck_assert_int_eq(gough_batch(&f->model.motion, &s, &f->run[i], 1, &options, &f->outcome[i],
                                     memory, NULL),
                         GOUGH_OK);
        free(memory);
    }
    ck_assert(memcmp(f->other, f->outcome, sizeof f->outcome) == 0);
    free(f);
}
END_TEST

static int stop_at_once(void *context, size_t done) {
    *(size_t *)context = done;
    return 1;
}

START_TEST(progress_may_stop_a_batch) {
    fixture *f = new_fixture(0, 2);
    const gough_simulation s = fixed(GOUGH_DOP853, 0, 1);
    gough_batch_options options = gough_batch_options_default();
    gough_error error = {0};
    size_t done = 0;
    int finished = 0;
    void *memory;

    options.threads = 1;
    options.progress = stop_at_once;
    options.context = &done;
    memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
    ck_assert_int_eq(
        gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
        GOUGH_ERROR_NUMERICAL);
    for (int i = 0; i < RUNS; i++) finished += f->outcome[i].rows > 0;
    ck_assert_int_eq(finished, (int)done);
    ck_assert_int_lt(finished, RUNS);
    free(memory);
    free(f);
}
END_TEST

/* groups of runs that other threads were about to finish have no outcomes */
START_TEST(progress_may_stop_several_threads) {
    fixture *f = new_fixture(0, 2);
    const gough_simulation s = fixed(GOUGH_RK4, 0.002, 20);
    gough_batch_options options = gough_batch_options_default();
    gough_error error = {0};
    size_t done = 0;
    int finished = 0;
    void *memory;

    options.threads = 3;
    options.progress = stop_at_once;
    options.context = &done;
    memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
    ck_assert_int_eq(
        gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
        GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(error.message, "was stopped after") != NULL, "%s", error.message);
    for (int i = 0; i < RUNS; i++) finished += f->outcome[i].rows > 0;
    ck_assert_int_ge(finished, 1);
    ck_assert_int_lt(finished, RUNS);
    free(memory);
    free(f);
}
END_TEST

START_TEST(misfits_are_refused) {
    fixture *f = new_fixture(LOADS, 2);
    const gough_simulation s = fixed(GOUGH_RK4, 0.01, 1);
    gough_batch_options options = gough_batch_options_default();
    gough_error error = {0};
    void *memory;

    options.threads = 1;
    memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
    options.lanes = 3;
    ck_assert_int_eq(
        gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
        GOUGH_ERROR_INPUT);
    options.lanes = 0;
    f->control[5].feedforward = false;
    ck_assert_int_eq(
        gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
        GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "run 5") != NULL);
    f->control[5].feedforward = true;
    f->machine[7].platform.height = 9;
    ck_assert_int_eq(
        gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
        GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "run 7") != NULL);
    f->machine[7].platform.height = 0.1;
    ck_assert_int_eq(
        gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
        GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "run 7") != NULL);
    for (double interval = 0.1; interval < 0.4; interval += 0.2) {
        f->disturbance[3] = f->disturbance[0] = f->model.disturbance;
        f->disturbance[0].noise.interval = 0.2;
        f->disturbance[3].noise.interval = interval;
        for (int i = 0; i < RUNS; i++) f->run[i].disturbance = &f->disturbance[i == 3 ? 3 : 0];
        ck_assert_int_eq(
            gough_batch(&f->model.motion, &s, f->run, RUNS, &options, f->outcome, memory, &error),
            GOUGH_ERROR_INPUT);
        ck_assert(strstr(error.message, "the noise of run 3 has a different interval") != NULL);
    }
    /* no runs, nothing to refuse */
    ck_assert_int_eq(gough_batch(&f->model.motion, &s, NULL, 0, &options, NULL, memory, &error),
                     GOUGH_OK);
    free(memory);
    free(f);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "batch", 120, lanes_and_threads_change_no_bit,
        runs_may_differ_in_everything_but_the_program, legs_with_mass_and_friction_keep_the_bits,
        sampled_and_lagging_loops_keep_the_bits, what_chooses_equations_is_the_same_in_all_runs,
        adaptive_runs_go_one_by_one, runs_in_quadruple_precision_go_one_by_one,
        each_run_has_its_own_end, a_preview_beyond_the_program_ends_every_lane,
        outcomes_are_summaries, outcomes_of_sampled_loops_are_summaries,
        outcomes_of_ended_and_disturbed_runs_are_summaries,
        runs_that_divide_time_differently_keep_their_numbers, progress_may_stop_a_batch,
        progress_may_stop_several_threads, misfits_are_refused);
}
