/* The flight simulator of the tests of workspaces, one pose at a time: vectors in long form, without the texts of the kernel. */
#include "workspace/flight.h"

void flight_machine(gough_model *model) {
    gough_platform p = gough_platform_symmetric(2.5, 8 * pi / 180, 1.9, 10 * pi / 180, 2.6);
    const gough_load load = {.mass = 6000,
                             .center_of_mass = {0.1, -0.05, 0.6},
                             .inertia = {{9000, 200, 0}, {200, 12000, 0}, {0, 0, 11000}}};
    const double gravity[3] = {0, 0, -9.80665};
    gough_error error = {0};
    memset(model, 0, sizeof *model);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.legs.length[v][0] = 2.4, p.legs.length[v][1] = 3.9;
        p.legs.base_swing[v] = 35 * pi / 180, p.legs.top_swing[v] = 50 * pi / 180;
    }
    ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

void flight_demands(gough_model *model) {
    gough_error error = {0};
    flight_machine(model);
    gough_platform p = model->machine.platform;
    const gough_load load = model->machine.load;
    const double gravity[3] = {0, 0, -9.80665};
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.cylinder.mass[v] = 60 + v, p.cylinder.center[v] = 0.8, p.cylinder.inertia[v] = 15;
        p.piston.mass[v] = 30, p.piston.center[v] = 0.7, p.piston.inertia[v] = 6;
        p.reflected_mass[v] = 80;
        p.legs.force[v][0] = -20000, p.legs.force[v][1] = 45000;
        p.legs.speed[v] = 1.6, p.legs.acceleration[v] = 14;
        p.legs.diameter[v] = 0.2;
    }
    ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
    model->workspace = (gough_workspace){.acceleration = {3, 3, 4},
                                         .angular_acceleration = {1.2, 1.2, 1},
                                         .velocity = {0.4, 0, 0.5},
                                         .angular_velocity = {0, 0.3, 0},
                                         .force = {0, 500, 0},
                                         .moment = {300, 0, 200}};
}

gough_reach flight_reach(const gough_model *model) {
    gough_reach reach;
    gough_error error = {0};
    ck_assert_msg(gough_reach_init(&reach, sizeof reach, model, &error) == GOUGH_OK, "%s",
                  error.message);
    return reach;
}

void flight_state(const gough_model *model, const double c[GOUGH_COMPONENTS], gough_state *state) {
    *state = gough_state_home(&model->machine);
    gough_rotation_in_order(model->motion.order, c + GOUGH_ROLL, state->rotation);
    for (int k = 0; k < 3; k++) {
        state->position[k] += c[k] + model->motion.about[k];
        for (int j = 0; j < 3; j++)
            state->position[k] -= state->rotation[k][j] * model->motion.about[j];
    }
}

/* from base to top joint */
static double leg_of(const gough_machine *machine, const gough_state *s, int v, double n[3]) {
    double l = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = s->position[k] - machine->platform.base[v][k];
        for (int j = 0; j < 3; j++) n[k] += s->rotation[k][j] * machine->platform.top[v][j];
        l += n[k] * n[k];
    }
    return sqrt(l);
}

static double angle_of(const double a[3], const double b[3]) {
    double difference = 0, sum = 0;
    for (int k = 0; k < 3; k++)
        difference += (a[k] - b[k]) * (a[k] - b[k]), sum += (a[k] + b[k]) * (a[k] + b[k]);
    return 2 * atan2(sqrt(difference), sqrt(sum));
}

double flight_excess(const gough_model *model, const gough_reach *reach,
                     const double c[GOUGH_COMPONENTS]) {
    const gough_machine *machine = &model->machine;
    const gough_state home = gough_state_home(machine);
    const gough_limits *limit = &reach->limits;
    gough_state s;
    double condition, determinant, worst = -INFINITY;
    flight_state(model, c, &s);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double n[3], n0[3], turned[3] = {0, 0, 0};
        const double l = leg_of(machine, &s, v, n), l0 = leg_of(machine, &home, v, n0);
        for (int k = 0; k < 3; k++) n[k] /= l, n0[k] /= l0;
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 3; j++) turned[k] += s.rotation[k][j] * n0[j];
        worst = fmax(worst, limit->length[v][0] - l);
        worst = fmax(worst, l - limit->length[v][1]);
        worst = fmax(worst, angle_of(n, n0) - limit->base_swing[v]);
        worst = fmax(worst, angle_of(n, turned) - limit->top_swing[v]);
    }
    gough_conditioning(machine, &s, &condition, &determinant);
    return determinant * reach->side > 0 ? worst : INFINITY;
}

static void draw(const double half[3], bool ends, dice *d, double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] =
            ends ? (dice_bits(d) & 1 ? half[k] : -half[k]) : dice_between(d, -half[k], half[k]);
}

void flight_draw(const gough_model *model, const double c[GOUGH_COMPONENTS], bool ends, dice *d,
                 flight_load *load) {
    const gough_workspace *w = &model->workspace;
    gough_acceleration a;
    gough_wrench wrench;
    gough_state s;
    flight_state(model, c, &s);
    draw(w->velocity, ends, d, s.velocity);
    draw(w->angular_velocity, ends, d, s.angular_velocity);
    draw(w->acceleration, ends, d, a.linear);
    draw(w->angular_acceleration, ends, d, a.angular);
    draw(w->force, ends, d, wrench.force);
    draw(w->moment, ends, d, wrench.moment);
    ck_assert(gough_inverse_dynamics(&model->machine, &s, &a, &wrench, load->force, NULL) ==
              GOUGH_OK);
    ck_assert(gough_leg_kinematics(&model->machine, &s, &a, NULL, load->rate, load->second_rate) ==
              GOUGH_OK);
}

void flight_pick(const gough_box *box, bool corner, dice *d, double pose[GOUGH_COMPONENTS]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        pose[c] = corner ? (dice_bits(d) & 1 ? box->least[c] : box->greatest[c])
                         : dice_between(d, box->least[c], box->greatest[c]);
}

double flight_distance(const gough_model *model, const double c[GOUGH_COMPONENTS], int v, int w) {
    enum { POINTS = 200 };
    const double *a = model->machine.platform.base[v], *b = model->machine.platform.base[w];
    double m[3], n[3], least = INFINITY;
    gough_state s;
    flight_state(model, c, &s);
    leg_of(&model->machine, &s, v, m), leg_of(&model->machine, &s, w, n);
    for (int i = 0; i <= POINTS; i++) {
        for (int j = 0; j <= POINTS; j++) {
            double square = 0;
            for (int k = 0; k < 3; k++) {
                const double x = a[k] + m[k] * i / POINTS - b[k] - n[k] * j / POINTS;
                square += x * x;
            }
            least = fmin(least, square);
        }
    }
    return sqrt(least);
}

double flight_over(const gough_reach *reach, const flight_load *load) {
    const gough_limits *l = &reach->limits;
    double worst = -INFINITY;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double part[] = {load->force[v] / l->force[v][1] - 1,
                               load->force[v] / l->force[v][0] - 1,
                               fabs(load->rate[v]) / l->speed[v] - 1,
                               fabs(load->second_rate[v]) / l->acceleration[v] - 1};
        for (size_t i = 0; i < sizeof part / sizeof *part; i++) {
            if (!isfinite(part[i])) return INFINITY;
            worst = fmax(worst, part[i]);
        }
    }
    return worst;
}
