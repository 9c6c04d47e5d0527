/* Designs whose best is known in closed form, what binds them, and what is refused; the same bits for the same seed.
 * Label: standard. */
#include <math.h>
#include <pthread.h>
#include <string.h>

#include "design/jack.h"
#include "support/suite.h"

static jack one;

static gough_design_result found(const gough_design_request *r) {
    gough_design_result result;
    gough_error error = {.message = ""};
    ck_assert_msg(gough_design(r, &result, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(result.found && result.certificate.verdict == GOUGH_INSIDE);
    return result;
}

static double length_at(double height) { return hypot(height, jack_across()); }
/* a leg carries a sixth of the weight: f h / l = m g / 6, most when the table is lowest */
static double force_at(double height) {
    const double low = height - JACK_HEAVE;
    return jack_weight() / 6 * length_at(low) / low;
}
static double stroke_at(double height) {
    return length_at(height + JACK_HEAVE) - length_at(height - JACK_HEAVE);
}

/* the root of a function that falls */
static double root_of(double (*f)(double), double low, double high) {
    for (int i = 0; i < 200; i++) {
        const double middle = 0.5 * (low + high);
        if (f(middle) > 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

START_TEST(least_force_is_at_the_greatest_height_and_says_so) {
    const gough_design_request r = jack_request(&one);
    const gough_design_result d = found(&r);
    ck_assert(d.value[0] >= 2.5 && d.value[0] <= 2.5);
    ck_assert_double_eq_tol(d.aim[GOUGH_AIM_FORCE][1], force_at(2.5), 1e-9 * force_at(2.5));
    ck_assert_double_eq_tol(d.aim[GOUGH_AIM_FORCE][0], force_at(1), 1e-9 * force_at(1));
    ck_assert_uint_eq(d.actives, 1);
    ck_assert_int_eq(d.active[0].kind, GOUGH_ACTIVE_GREATEST);
    ck_assert(isnan(d.aim[GOUGH_AIM_STROKE][1]) && d.start_meets && d.bounded);
    ck_assert(d.envelope.of[GOUGH_WORST_PUSH].bound >= force_at(2.5));
}
END_TEST

START_TEST(a_limit_of_length_stops_at_its_root) {
    gough_design_request r = jack_request(&one);
    one.longest = 1.7;
    const gough_design_result d = found(&r);
    const double root = sqrt(1.7 * 1.7 - jack_across() * jack_across()) - JACK_HEAVE;
    ck_assert_msg(d.value[0] <= root && d.value[0] >= root - 3e-3, "%.9g, root %.9g", d.value[0],
                  root);
    ck_assert_uint_eq(d.actives, 1);
    ck_assert_int_eq(d.active[0].kind, GOUGH_ACTIVE_LIMIT);
    ck_assert_int_eq(d.active[0].binding.bind, GOUGH_BIND_LONGEST);
    ck_assert(d.active[0].pose[GOUGH_HEAVE] >= JACK_HEAVE);
}
END_TEST

static double telescope_spare(double height) {
    return 0.6 + length_at(height + JACK_HEAVE) - 2 * length_at(height - JACK_HEAVE);
}

START_TEST(a_telescope_stops_at_its_root) {
    gough_design_request r = jack_request(&one);
    memset(r.weight, 0, sizeof r.weight);
    r.weight[GOUGH_AIM_STROKE] = 1;
    r.telescope = 0.6;
    const gough_design_result d = found(&r);
    const double root = root_of(telescope_spare, 0.5, 2.5);
    ck_assert_msg(d.value[0] >= root && d.value[0] <= root + 3e-3, "%.9g, root %.9g", d.value[0],
                  root);
    ck_assert_double_eq_tol(d.aim[GOUGH_AIM_STROKE][1], stroke_at(d.value[0]), 1e-12);
    ck_assert_int_eq(d.active[0].kind, GOUGH_ACTIVE_TELESCOPE);
    ck_assert_uint_eq(d.actives, 1);
}
END_TEST

static double sum_at(double height) {
    return force_at(height) / force_at(1) + 2 * stroke_at(height) / stroke_at(1);
}
static double falls(double height) { return sum_at(height - 1e-5) - sum_at(height + 1e-5); }

START_TEST(weights_meet_where_their_slopes_do) {
    gough_design_request r = jack_request(&one);
    r.weight[GOUGH_AIM_STROKE] = 2;
    const gough_design_result d = found(&r);
    const double best = root_of(falls, 0.5, 2.5);
    ck_assert_double_eq_tol(d.objective[0], 3, 1e-12);
    ck_assert_msg(d.objective[1] <= sum_at(best) * (1 + 1.1e-3), "%.9g at %g, best %.9g at %g",
                  d.objective[1], d.value[0], sum_at(best), best);
    ck_assert_double_eq_tol(d.objective[1], sum_at(d.value[0]), 1e-9);
    ck_assert_uint_eq(d.actives, 0);
    ck_assert(best > 0.6 && best < 2.4);
}
END_TEST

START_TEST(numbers_are_rounded_to_few_digits) {
    gough_design_request r = jack_request(&one);
    r.weight[GOUGH_AIM_STROKE] = 2;
    const gough_design_result d = found(&r);
    ck_assert_double_eq_tol(1e2 * d.value[0], round(1e2 * d.value[0]), 1e-9);
}
END_TEST

START_TEST(what_cannot_be_met_says_what_is_exceeded) {
    gough_design_request r = jack_request(&one);
    gough_design_result d;
    gough_error error;
    one.longest = length_at(0.5 + JACK_HEAVE) * 0.99;
    ck_assert_int_eq(gough_design(&r, &d, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(!d.found && d.excess > 1e-3 && d.excess < 0.03 && d.scale > 0.1 && d.scale < 1,
                  "excess %g, scale %g, height %.9g", d.excess, d.scale, d.value[0]);
    ck_assert_int_eq(d.certificate.binding.bind, GOUGH_BIND_LONGEST);
    ck_assert(d.value[0] >= 0.5 && d.value[0] <= 0.5 + 1e-5 && !d.telescope_fails);
    ck_assert_int_eq(d.active[0].kind, GOUGH_ACTIVE_LEAST);
    ck_assert_ptr_nonnull(strstr(error.message, "workspace.box"));
    one.refuse_above = 0;
    r.start[0] = -1;
    ck_assert_int_eq(gough_design(&r, &d, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_ptr_nonnull(strstr(error.message, "is refused"));
}
END_TEST

START_TEST(numbers_that_make_no_machine_are_avoided) {
    gough_design_request r = jack_request(&one);
    one.refuse_above = 2;
    const gough_design_result d = found(&r);
    ck_assert(d.value[0] <= 2 && d.value[0] > 1.99);
}
END_TEST

/* ---- the same bits ---- */

typedef struct in_thread {
    base base;
    gough_design_request request;
    gough_design_result result;
    gough_status status;
    gough_error error;
} in_thread;

static void *run(void *given) {
    in_thread *t = given;
    t->request = base_request(&t->base);
    t->base.part = 0.2;
    t->request.evaluations = 120;
    t->request.seed = 7;
    t->status = gough_design(&t->request, &t->result, &t->error);
    return NULL;
}

START_TEST(same_seed_gives_the_same_bits_beside_another_search) {
    static in_thread first, both[2];
    pthread_t thread[2];
    run(&first);
    ck_assert_msg(first.status == GOUGH_OK, "%s", first.error.message);
    for (int i = 0; i < 2; i++)
        ck_assert_int_eq(pthread_create(&thread[i], NULL, run, &both[i]), 0);
    for (int i = 0; i < 2; i++) {
        pthread_join(thread[i], NULL);
        ck_assert_int_eq(both[i].status, GOUGH_OK);
        ck_assert_mem_eq(both[i].result.value, first.result.value, sizeof first.result.value);
        ck_assert_mem_eq(&both[i].result.objective[1], &first.result.objective[1], sizeof(double));
        ck_assert_uint_eq(both[i].result.evaluations, first.result.evaluations);
    }
}
END_TEST

/* ---- a motion base by other means: inverse dynamics of single poses and accelerations ---- */

/* the greatest and the least force for an acceleration, the shortest and the longest leg, at a pose about the top's origin */
static void at_pose(const gough_model *model, const double pose[GOUGH_COMPONENTS],
                    const double linear[3], double force[2], double length[2]) {
    gough_state state = gough_state_home(&model->machine);
    const gough_acceleration a = {.linear = {linear[0], linear[1], linear[2]}};
    double f[GOUGH_LEGS], l[GOUGH_LEGS];
    gough_rotation_in_order(GOUGH_ZYX, pose + GOUGH_ROLL, state.rotation);
    for (int k = 0; k < 3; k++) state.position[k] += pose[k];
    ck_assert_int_eq(gough_inverse_dynamics(&model->machine, &state, &a, NULL, f, NULL), GOUGH_OK);
    gough_leg_kinematics(&model->machine, &state, NULL, l, NULL, NULL);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        ck_assert(isfinite(f[v]) && isfinite(l[v]));
        force[0] = fmin(force[0], f[v]), force[1] = fmax(force[1], f[v]);
        length[0] = fmin(length[0], l[v]), length[1] = fmax(length[1], l[v]);
    }
}

START_TEST(a_certified_design_survives_samples_of_poses_and_accelerations) {
    static base b;
    gough_design_request r = base_request(&b);
    const gough_model *model = NULL;
    dice d = {2026};
    r.evaluations = 200;
    b.part = 0.5;
    const gough_design_result found_ = found(&r);
    const gough_extreme *of = found_.envelope.of;
    double corners[2] = {INFINITY, -INFINITY}, length[2] = {INFINITY, 0};
    ck_assert_int_eq(r.make(&b, found_.value, &model, NULL), GOUGH_OK);
    for (int i = 0; i < 64 * 8; i++) {
        double pose[GOUGH_COMPONENTS], linear[3];
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            pose[c] = i >> c & 1 ? found_.box.greatest[c] : found_.box.least[c];
        for (int k = 0; k < 3; k++)
            linear[k] = (i >> (6 + k) & 1 ? 1 : -1) * model->workspace.acceleration[k];
        at_pose(model, pose, linear, corners, length);
    }
    /* the aim is the worst of these corners, to rounding */
    ck_assert_double_eq_tol(found_.aim[GOUGH_AIM_FORCE][1], fmax(corners[1], -corners[0]), 1e-6);
    double force[2] = {INFINITY, -INFINITY};
    for (int i = 0; i < 20000; i++) {
        double pose[GOUGH_COMPONENTS], linear[3];
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            pose[c] = dice_between(&d, found_.box.least[c], found_.box.greatest[c]);
        for (int k = 0; k < 3; k++)
            linear[k] = dice_between(&d, -1, 1) * model->workspace.acceleration[k];
        at_pose(model, pose, linear, force, length);
    }
    ck_assert(length[0] >= of[GOUGH_WORST_SHORTEST].bound);
    ck_assert(length[1] <= of[GOUGH_WORST_LONGEST].bound);
    ck_assert(length[1] <= 2 * length[0] - r.telescope);
    ck_assert(force[1] <= of[GOUGH_WORST_PUSH].bound && force[0] >= of[GOUGH_WORST_PULL].bound);
}
END_TEST

/* ---- what is refused ---- */

static gough_status no_box(void *context, const double *value, const gough_model **model,
                           gough_error *error) {
    gough_design_request r = jack_request(context);
    const gough_status status = r.make(context, value, model, error);
    memset(one.model.workspace.box, 0, sizeof one.model.workspace.box);
    return status;
}

START_TEST(requests_out_of_range_are_refused) {
    gough_design_request r;
    r = jack_request(&one), r.keys = 0;
    jack_refuse(r, "1 to 32 numbers");
    r = jack_request(&one), r.keys = 33;
    jack_refuse(r, "1 to 32 numbers");
    r = jack_request(&one), r.make = NULL;
    jack_refuse(r, "a function that makes models");
    r = jack_request(&one), r.greatest[0] = 0.5;
    jack_refuse(r, "two finite bounds");
    r = jack_request(&one), r.start[0] = NAN;
    jack_refuse(r, "a finite start");
    r = jack_request(&one), r.weight[0] = 0;
    jack_refuse(r, "design.minimize must have weights");
    r = jack_request(&one), r.weight[1] = -1;
    jack_refuse(r, "design.minimize must have weights");
    r = jack_request(&one), r.telescope = -1;
    jack_refuse(r, "design.telescope must be 0 or greater");
    r = jack_request(&one), r.least_singular_value = NAN;
    jack_refuse(r, "design.least_singular_value");
    r = jack_request(&one), r.evaluations = 9;
    jack_refuse(r, "design.evaluations must be from 10");
    r = jack_request(&one), r.weight[GOUGH_AIM_SPEED] = 1;
    jack_refuse(r, "no workspace.velocity");
    r = jack_request(&one), r.make = no_box;
    jack_refuse(r, "workspace.box is missing");
    r = jack_request(&one), r.size = 8;
    jack_refuse(r, "gough_design_request");
}
END_TEST

static int stop(void *context, double part) { return *(double *)context = part, part > 0.3; }

START_TEST(a_search_can_be_stopped) {
    gough_design_request r = jack_request(&one);
    gough_design_result d;
    gough_error error;
    double part = 0;
    r.progress = stop;
    r.progress_context = &part;
    ck_assert_int_eq(gough_design(&r, &d, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_str_eq(error.message, "the search was stopped");
    ck_assert(part > 0.3 && part < 0.5 && d.evaluations < 150);
}
END_TEST

int main(void) {
    return SUITE_RUN("design", 60, least_force_is_at_the_greatest_height_and_says_so,
                     a_limit_of_length_stops_at_its_root, a_telescope_stops_at_its_root,
                     weights_meet_where_their_slopes_do, numbers_are_rounded_to_few_digits,
                     what_cannot_be_met_says_what_is_exceeded,
                     numbers_that_make_no_machine_are_avoided,
                     same_seed_gives_the_same_bits_beside_another_search,
                     a_certified_design_survives_samples_of_poses_and_accelerations,
                     requests_out_of_range_are_refused, a_search_can_be_stopped);
}
