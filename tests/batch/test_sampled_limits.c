/* Limits of acceleration in lanes whose controller is sampled at the end of each step: they hold for the accelerations under the
 * command that ends there too, which nothing else needs.
 * Label: quick. */
#include "runs.h"

enum { LEG, PLATFORM }; /* whose acceleration is limited */

/* Loops without delay that are sampled every `period`, of machines with ideal drives, legs without mass and friction, and no forces
 * but those of the legs: only for these are accelerations at a sample left out. What moves them between samples are disturbances
 * of the legs. */
static fixture *limited(int kind, double period) {
    fixture *f = new_fixture(LOADS | DISTURBANCES | SAMPLED, 1);

    for (int i = 0; i < RUNS; i++) {
        char text[40];
        gough_platform p = f->machine[i].platform;
        const gough_load load = f->machine[i].load;
        f->control[i].sampling = (gough_sampling){.period = period};
        for (int v = 0; v < 6; v++) f->control[i].integral[v] = 0;
        f->initial[i] = f->model.initial;
        snprintf(text, sizeof text, "%d*t*sin(20*t)", 2 + i % 7);
        memset(&f->disturbance[i], 0, sizeof f->disturbance[i]);
        for (int v = 0; v < 6; v += 2) set_formula(&f->disturbance[i].leg_force[v], text);
        for (int v = 0; v < 6 && kind == LEG; v++) p.legs.acceleration[v] = 1 + 0.05 * i;
        for (int c = 0; c < 6 && kind == PLATFORM; c++) {
            p.limits.acceleration[c][1] = 1 + 0.05 * i;
            p.limits.acceleration[c][0] = -p.limits.acceleration[c][1];
        }
        ck_assert_int_eq(
            gough_machine_init(&f->machine[i], &p, &load, f->model.machine.gravity, NULL),
            GOUGH_OK);
    }
    return f;
}

/* Each run ends where gough_simulate() ends it, which computes accelerations before and after each sample. Most ends lie within a
 * step: there the accelerations under the old command exceed the limit. */
static void ends_as_alone(int kind, gough_method method, gough_cause cause) {
    fixture *f = limited(kind, 0.02);
    const gough_simulation s = fixed(method, 0.02, 1);
    int ended = 0, within = 0;

    run_batch(f, &s, 1, 1, f->outcome);
    check_alone(f, &s);
    for (int lanes = 2; lanes <= gough_batch_lanes(); lanes *= 2) {
        run_batch(f, &s, lanes, 2, f->other);
        ck_assert(memcmp(f->outcome, f->other, sizeof f->outcome) == 0);
    }
    for (int i = 0; i < RUNS; i++) {
        const double samples = f->outcome[i].time / 0.02;
        ended += f->outcome[i].cause == cause;
        within += f->outcome[i].cause == cause && fabs(samples - round(samples)) > 1e-3;
    }
    ck_assert_msg(ended >= 30 && within >= 20, "%d ended, %d of them within a step", ended, within);
    free(f);
}

START_TEST(leg_accelerations_end_sampled_runs_as_alone) {
    ends_as_alone(LEG, GOUGH_RK4, GOUGH_END_LEG_ACCELERATION);
    ends_as_alone(LEG, GOUGH_DOP853, GOUGH_END_LEG_ACCELERATION);
    ends_as_alone(LEG, GOUGH_RATTLE4, GOUGH_END_LEG_ACCELERATION);
}
END_TEST

START_TEST(platform_accelerations_end_sampled_runs_as_alone) {
    ends_as_alone(PLATFORM, GOUGH_RK4, GOUGH_END_PLATFORM_ACCELERATION);
    ends_as_alone(PLATFORM, GOUGH_DOP853, GOUGH_END_PLATFORM_ACCELERATION);
    ends_as_alone(PLATFORM, GOUGH_RATTLE4, GOUGH_END_PLATFORM_ACCELERATION);
}
END_TEST

int main(void) {
    return SUITE_RUN("batch/sampled_limits", 60, leg_accelerations_end_sampled_runs_as_alone,
                     platform_accelerations_end_sampled_runs_as_alone);
}
