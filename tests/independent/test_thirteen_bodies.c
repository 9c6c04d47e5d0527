/* Legs with mass and friction against a second formulation, thirteen rigid bodies with the
 * reactions of their joints: random machines without symmetry, laws that hold whatever the
 * formulation, special legs that have a simpler equivalent, a published machine.
 * */
#include <check.h>
#include <math.h>
#include <string.h>

#include "independent/thirteen_bodies.h"
#include "support/random.h"

enum { MACHINES = 1000 };
static const uint64_t SEED = 20;

/* Of the largest force, acceleration or reaction. Both formulations solve equations whose condition
 * is about that of the pose, which is below GREATEST here; found is 4e-13. Identities are found to
 * 3e-13. */
static const double AGREEMENT = 1e-11, IDENTITY = 1e-12, GREATEST = 100;

/* What a random case consists of. */
typedef struct random_case {
    thirteen_bodies second;
    gough_machine machine;
    gough_state state;
    gough_acceleration acceleration;
    gough_wrench external;
    double drive[6];
    double condition;
} random_case;

static double worse(double worst, double difference) {
    const double size = fabs(difference);
    return size <= worst ? worst : size; /* not a number replaces anything */
}

static double largest(int count, const double *value) {
    double most = 0;
    for (int i = 0; i < count; i++) most = worse(most, value[i]);
    return most;
}

/* the greatest difference of two lists, of the greatest number in either */
static double relative(int count, const double *a, const double *b) {
    double most = 0;
    for (int i = 0; i < count; i++) most = worse(most, a[i] - b[i]);
    return most / fmax(largest(count, a), largest(count, b));
}

static void fill(dice *d, int count, double low, double high, double *value) {
    for (int i = 0; i < count; i++) value[i] = dice_between(d, low, high);
}

/* ---- random machines ---- */

/* near a symmetric hexapod of size R, each joint off its place */
static gough_platform random_platform(dice *d, double R) {
    const double a = dice_between(d, 0.05, 0.4), b = dice_between(d, 0.05, 0.4);
    gough_platform p = gough_platform_symmetric(R, a, R * dice_between(d, 0.4, 0.9), b,
                                                R * dice_between(d, 0.8, 1.6));
    for (int k = 0; k < 6; k++) {
        for (int i = 0; i < 3; i++) {
            p.base[k][i] += R * dice_between(d, -0.08, 0.08);
            p.top[k][i] += R * dice_between(d, -0.06, 0.06);
        }
    }
    return p;
}

/* six different parts; one in five has no mass, one in five no inertia */
static void random_part(dice *d, double M, double R, gough_leg_part *part) {
    for (int k = 0; k < 6; k++) {
        const bool mass = dice_between(d, 0, 1) < 0.8, inertia = dice_between(d, 0, 1) < 0.8;
        part->mass[k] = mass ? M * dice_between(d, 0.01, 0.3) : 0;
        part->center[k] = R * dice_between(d, -0.3, 0.8);
        part->inertia[k] = mass && inertia ? M * R * R * dice_between(d, 0, 0.04) : 0;
    }
}

static void random_friction(dice *d, double force, double speed, gough_friction *f) {
    for (int k = 0; k < 6; k++) {
        const bool stribeck = dice_between(d, 0, 1) < 0.5;
        f->viscous[k] = force / speed * dice_between(d, 0, 0.3);
        f->coulomb[k] = force * dice_between(d, 0, 0.2);
        f->breakaway[k] = stribeck ? f->coulomb[k] * dice_between(d, 1, 2) : 0;
        f->stribeck_speed[k] = stribeck ? speed * dice_between(d, 0.01, 0.5) : 0;
        /* 0: v_S/20 where there is v_S, else 1e-3 √(g R_b) */
        f->smoothing_speed[k] =
            dice_between(d, 0, 1) < 0.6 ? speed * dice_between(d, 1e-3, 0.5) : 0;
        f->efficiency[k] = dice_between(d, 0.6, 1);
    }
}

/* A = B Bᵀ as ∫ x xᵀ dm is a second moment of a body, whose tensor is trace(A) − A. */
static void random_load(dice *d, double M, double R, gough_load *load) {
    double B[3][3], A[3][3], trace = 0;
    load->mass = M;
    fill(d, 3, -0.2 * R, 0.2 * R, load->center_of_mass);
    fill(d, 9, -0.3 * R, 0.3 * R, B[0]);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            A[i][j] = i == j ? 0.02 * M * R * R : 0;
            for (int k = 0; k < 3; k++) A[i][j] += M * B[i][k] * B[j][k];
        }
        trace += A[i][i];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) load->inertia[i][j] = (i == j ? trace : 0) - A[i][j];
}

/* the machine as both formulations have it */
static void make_machine(random_case *c) {
    gough_error error = {.message = ""};
    const gough_status status = gough_machine_init(&c->machine, &c->second.platform,
                                                   &c->second.load, c->second.gravity, &error);
    ck_assert_msg(status == GOUGH_OK, "%s", error.message);
}

static void random_motion(dice *d, double M, double R, double g, random_case *c) {
    const double speed = sqrt(g * R);
    double angle[3];
    c->state = gough_state_home(&c->machine);
    fill(d, 3, -0.4, 0.4, angle);
    gough_rotation_from_angles(angle, c->state.rotation);
    for (int i = 0; i < 3; i++) c->state.position[i] += R * dice_between(d, -0.2, 0.2);
    fill(d, 3, -speed, speed, c->state.velocity);
    fill(d, 3, -speed / R, speed / R, c->state.angular_velocity);
    fill(d, 3, -g, g, c->acceleration.linear);
    fill(d, 3, -g / R, g / R, c->acceleration.angular);
    fill(d, 3, -M * g, M * g, c->external.force);
    fill(d, 3, -M * g * R, M * g * R, c->external.moment);
    fill(d, 6, -M * g, M * g, c->drive);
}

/* What the legs of a random machine have; NO_MASS: equations of legs with mass, which is 0. */
enum { MASS = 1, FRICTION = 2, NO_MASS = 4 };

/* Machines, and poses that are not nearly singular. A tenth have no gravity. */
static void random_machine(dice *d, int legs, random_case *c) {
    double condition = INFINITY;
    while (!(condition < GREATEST)) {
        const double M = pow(10, dice_between(d, -1, 3)), R = pow(10, dice_between(d, -1, 1));
        const double g = dice_between(d, 1, 12), weight = dice_between(d, 0, 1) < 0.9 ? g : 0;
        memset(c, 0, sizeof *c);
        c->second.platform = random_platform(d, R);
        random_load(d, M, R, &c->second.load);
        fill(d, 3, -weight, weight, c->second.gravity);
        gough_platform *p = &c->second.platform;
        if (legs & MASS) {
            random_part(d, M, R, &p->cylinder);
            random_part(d, M, R, &p->piston);
            fill(d, 6, 0, M, p->reflected_mass);
        }
        p->legs_have_mass = (legs & NO_MASS) != 0;
        if (legs & FRICTION) random_friction(d, M * g, sqrt(g * R), &p->friction);
        for (int k = 0; k < 6 && !(weight > 0); k++)
            if (p->friction.smoothing_speed[k] <= 0) p->friction.smoothing_speed[k] = 0.01;
        make_machine(c);
        random_motion(d, M, R, g, c);
        ck_assert_int_eq(gough_conditioning(&c->machine, &c->state, &condition, NULL), GOUGH_OK);
    }
    c->condition = condition;
}

/* one list of six accelerations; those about axes times R_b */
static void accelerations(const random_case *c, const gough_acceleration *a, double list[6]) {
    for (int i = 0; i < 3; i++) {
        list[i] = a->linear[i];
        list[3 + i] = a->angular[i] * c->second.platform.base_radius;
    }
}

/* ---- both directions agree ---- */

static double forward_differs(const random_case *c) {
    bodies_instant now;
    gough_acceleration acceleration;
    double first[6], second[6];
    bodies_forward(&c->second, &c->state, c->drive, &c->external, &now);
    ck_assert_int_eq(
        gough_forward_dynamics(&c->machine, &c->state, c->drive, &c->external, &acceleration),
        GOUGH_OK);
    accelerations(c, &acceleration, first);
    accelerations(c, &now.top, second);
    return relative(6, first, second);
}

static double inverse_differs(const random_case *c) {
    bodies_instant now;
    double drive[6], length[6], rate[6], second_rate[6], worst;
    bodies_inverse(&c->second, &c->state, &c->acceleration, &c->external, &now);
    ck_assert_int_eq(
        gough_inverse_dynamics(&c->machine, &c->state, &c->acceleration, &c->external, drive, NULL),
        GOUGH_OK);
    ck_assert_int_eq(
        gough_leg_kinematics(&c->machine, &c->state, &c->acceleration, length, rate, second_rate),
        GOUGH_OK);
    worst = relative(6, drive, now.drive);
    worst = worse(worst, relative(6, length, now.length));
    worst = worse(worst, relative(6, rate, now.rate));
    return worse(worst, relative(6, second_rate, now.second_rate));
}

/* (body-6) with the forces on the top as the thirteen bodies have them */
static double reactions_differ(const random_case *c) {
    static const int PAIR[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    const gough_machine *m = &c->machine;
    bodies_instant now;
    double e[3][3], rate[3][3], Q[3][3], expected[6], reaction[6];
    bodies_forward(&c->second, &c->state, c->drive, &c->external, &now);
    for (int a = 0; a < 3; a++) {
        const double *w = c->state.angular_velocity, *f = c->external.moment;
        for (int i = 0; i < 3; i++) {
            e[a][i] = 0;
            for (int j = 0; j < 3; j++)
                e[a][i] += c->state.rotation[i][j] * m->principal_axes[j][a];
        }
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            rate[a][i] = w[j] * e[a][k] - w[k] * e[a][j];
            Q[a][i] = (f[j] * e[a][k] - f[k] * e[a][j]) / 2;
        }
        for (int n = 0; n < 6; n++) {
            double along = 0;
            for (int j = 0; j < 3; j++)
                along += (c->second.platform.top[n][j] - c->second.load.center_of_mass[j]) *
                         m->principal_axes[j][a];
            for (int i = 0; i < 3; i++) Q[a][i] += along * now.on_top[n][i];
        }
    }
    for (int n = 0; n < 6; n++) {
        const int a = PAIR[n][0], b = PAIR[n][1];
        const double Ia = m->second_moments[a], Ib = m->second_moments[b];
        double sum = 0;
        for (int i = 0; i < 3; i++)
            sum -= Q[a][i] * e[b][i] * Ib + Q[b][i] * e[a][i] * Ia +
                   2 * rate[a][i] * rate[b][i] * Ia * Ib;
        expected[n] = sum / (Ia + Ib);
    }
    ck_assert_int_eq(gough_reactions(m, &c->state, c->drive, &c->external, reaction), GOUGH_OK);
    return relative(6, expected, reaction);
}

/* the piston's equation across the leg: what its guides give it is m₂(a − g) less what the top does to it */
static double guided(const random_case *c, const bodies_instant *now, int n) {
    const rigid_body *piston = &now->body[PISTON + n];
    double axis[3], force[3], along = 0, across = 0;
    for (int i = 0; i < 3; i++) {
        axis[i] = c->state.position[i] - c->second.platform.base[n][i];
        for (int j = 0; j < 3; j++)
            axis[i] += c->state.rotation[i][j] * c->second.platform.top[n][j];
        axis[i] /= now->length[n];
        force[i] = piston->mass * (piston->a[i] - c->second.gravity[i]) + now->on_top[n][i];
        along += axis[i] * force[i];
    }
    for (int i = 0; i < 3; i++)
        across += (force[i] - along * axis[i]) * (force[i] - along * axis[i]);
    return sqrt(across);
}

static double joints_differ(const random_case *c) {
    bodies_instant now;
    double leg[6], top[6][3], base[6][3], side[6], second_side[6], worst;
    bodies_inverse(&c->second, &c->state, &c->acceleration, &c->external, &now);
    ck_assert_int_eq(gough_joint_forces(&c->machine, &c->state, &c->acceleration, &c->external, leg,
                                        top, base, side),
                     GOUGH_OK);
    for (int n = 0; n < 6; n++) second_side[n] = guided(c, &now, n);
    worst = relative(6, leg, now.force);
    worst = worse(worst, relative(18, top[0], now.on_top[0]));
    worst = worse(worst, relative(18, base[0], now.on_leg[0]));
    for (int n = 0; n < 6; n++) side[n] -= second_side[n];
    return worse(worst, largest(6, side) / largest(18, now.on_top[0]));
}

static const struct {
    const char *name;
    int legs;
} LEGS[] = {{"without mass and friction", 0},
            {"friction", FRICTION},
            {"mass", MASS},
            {"mass and friction", MASS | FRICTION},
            {"mass of 0 and friction", NO_MASS | FRICTION}};
enum { KINDS = sizeof LEGS / sizeof LEGS[0] };

START_TEST(random_machines_agree) {
    dice d = {SEED};
    random_case c;
    double forward = 0, inverse = 0, reactions = 0, joints = 0;
    for (int n = 0; n < MACHINES; n++) {
        random_machine(&d, LEGS[_i].legs, &c);
        forward = worse(forward, forward_differs(&c));
        inverse = worse(inverse, inverse_differs(&c));
        reactions = worse(reactions, reactions_differ(&c));
        joints = worse(joints, joints_differ(&c));
    }
    ck_assert_msg(forward <= AGREEMENT && inverse <= AGREEMENT && reactions <= AGREEMENT &&
                      joints <= AGREEMENT,
                  "%s, seed %d: accelerations differ by %g, drive forces by %g, reactions by %g, "
                  "forces of the joints by %g",
                  LEGS[_i].name, (int)SEED, forward, inverse, reactions, joints);
}
END_TEST

/* Drives that lock themselves still have drive forces for a given motion. */
START_TEST(drive_forces_of_locking_drives_agree) {
    dice d = {SEED};
    random_case c;
    double worst = 0;
    for (int n = 0; n < MACHINES; n++) {
        random_machine(&d, MASS | FRICTION, &c);
        fill(&d, 6, 0.1, 0.5, c.second.platform.friction.efficiency);
        make_machine(&c);
        worst = worse(worst, inverse_differs(&c));
    }
    ck_assert_msg(worst <= AGREEMENT, "seed %d: differ by %g", (int)SEED, worst);
}
END_TEST

/* ---- laws ---- */

/* The power of the drives, whose forces are the library's, and of the external force becomes kinetic
 * and potential energy or is lost to friction: Σ u l̇ + … = d(T + V)/dt + Σ (u − F) l̇. Relative to
 * the size of these terms. */
static double power_differs(const random_case *c, const bodies_instant *now,
                            const double drive[6]) {
    const rigid_body *load = &now->body[LOAD];
    double sum = bodies_energy_rate(&c->second, now), scale = fabs(sum);
    for (int k = 0; k < 6; k++) {
        sum += (now->drive[k] - now->force[k]) * now->rate[k] - drive[k] * now->rate[k];
        scale += fabs(drive[k] * now->rate[k]);
    }
    for (int i = 0; i < 3; i++)
        sum -= c->external.force[i] * load->v[i] + c->external.moment[i] * load->omega[i];
    return sum / scale;
}

START_TEST(momentum_and_energy_balance) {
    dice d = {SEED};
    random_case c;
    bodies_instant now;
    double worst[3] = {0, 0, 0};
    for (int n = 0; n < MACHINES; n++) {
        double drive[6], momentum[3], angular[3];
        random_machine(&d, LEGS[_i].legs, &c);
        bodies_inverse(&c.second, &c.state, &c.acceleration, &c.external, &now);
        ck_assert_int_eq(
            gough_inverse_dynamics(&c.machine, &c.state, &c.acceleration, &c.external, drive, NULL),
            GOUGH_OK);
        bodies_momentum(&c.second, &c.external, &now, momentum, angular);
        worst[0] = worse(worst[0], largest(3, momentum));
        worst[1] = worse(worst[1], largest(3, angular));
        worst[2] = worse(worst[2], power_differs(&c, &now, drive));
    }
    for (int i = 0; i < 3; i++)
        ck_assert_msg(worst[i] <= IDENTITY,
                      "%s, seed %d: momentum is off by %g, angular momentum by %g, power by %g",
                      LEGS[_i].name, (int)SEED, worst[0], worst[1], worst[2]);
}
END_TEST

START_TEST(inverse_then_forward_gives_the_acceleration_back) {
    dice d = {SEED};
    random_case c;
    double worst = 0;
    for (int n = 0; n < MACHINES; n++) {
        gough_acceleration back;
        double drive[6], before[6], after[6];
        random_machine(&d, LEGS[_i].legs, &c);
        ck_assert_int_eq(
            gough_inverse_dynamics(&c.machine, &c.state, &c.acceleration, &c.external, drive, NULL),
            GOUGH_OK);
        ck_assert_int_eq(gough_forward_dynamics(&c.machine, &c.state, drive, &c.external, &back),
                         GOUGH_OK);
        accelerations(&c, &c.acceleration, before);
        accelerations(&c, &back, after);
        worst = worse(worst, relative(6, before, after));
    }
    ck_assert_msg(worst <= AGREEMENT, "%s, seed %d: differs by %g", LEGS[_i].name, (int)SEED,
                  worst);
}
END_TEST

/* ---- legs with a simpler equivalent ---- */

/* the load with point masses at the top joints, for legs without mass */
static void carry_pistons(thirteen_bodies *m) {
    gough_load *load = &m->load;
    const gough_load was = *load;
    double moment[3];
    for (int i = 0; i < 3; i++) moment[i] = was.mass * was.center_of_mass[i];
    for (int k = 0; k < 6; k++) {
        load->mass += m->platform.piston.mass[k];
        for (int i = 0; i < 3; i++) moment[i] += m->platform.piston.mass[k] * m->platform.top[k][i];
    }
    for (int i = 0; i < 3; i++) load->center_of_mass[i] = moment[i] / load->mass;
    /* Steiner's theorem for the load and each piston */
    for (int k = -1; k < 6; k++) {
        const double mass = k < 0 ? was.mass : m->platform.piston.mass[k];
        const double *x = k < 0 ? was.center_of_mass : m->platform.top[k];
        double r[3], square = 0;
        for (int i = 0; i < 3; i++) {
            r[i] = x[i] - load->center_of_mass[i];
            square += r[i] * r[i];
        }
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                load->inertia[i][j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
    }
    memset(&m->platform.piston, 0, sizeof m->platform.piston);
}

/* External moments only: an external force would act at another centre of mass. */
START_TEST(pistons_that_are_points_at_their_joints_belong_to_the_load) {
    dice d = {SEED};
    random_case c, equal;
    double forces = 0, motion = 0;
    for (int n = 0; n < MACHINES; n++) {
        gough_acceleration a[2];
        double first[6], second[6];
        random_machine(&d, FRICTION, &c);
        memset(c.external.force, 0, sizeof c.external.force);
        for (int k = 0; k < 6; k++) {
            /* where the centre is does not matter without mass */
            c.second.platform.piston.mass[k] = c.second.load.mass * dice_between(&d, 0.01, 0.3);
            c.second.platform.cylinder.center[k] = dice_between(&d, -1, 1);
        }
        equal = c;
        carry_pistons(&equal.second);
        make_machine(&c);
        make_machine(&equal);
        ck_assert(c.machine.platform.legs_have_mass && !equal.machine.platform.legs_have_mass);
        ck_assert_int_eq(
            gough_inverse_dynamics(&c.machine, &c.state, &c.acceleration, &c.external, first, NULL),
            GOUGH_OK);
        ck_assert_int_eq(gough_inverse_dynamics(&equal.machine, &c.state, &c.acceleration,
                                                &c.external, second, NULL),
                         GOUGH_OK);
        forces = worse(forces, relative(6, first, second));
        ck_assert_int_eq(gough_forward_dynamics(&c.machine, &c.state, c.drive, &c.external, &a[0]),
                         GOUGH_OK);
        ck_assert_int_eq(
            gough_forward_dynamics(&equal.machine, &c.state, c.drive, &c.external, &a[1]),
            GOUGH_OK);
        accelerations(&c, &a[0], first);
        accelerations(&c, &a[1], second);
        motion = worse(motion, relative(6, first, second));
    }
    ck_assert_msg(forces <= IDENTITY && motion <= IDENTITY,
                  "seed %d: forces differ by %g, accelerations by %g", (int)SEED, forces, motion);
}
END_TEST

START_TEST(reflected_mass_alone_adds_its_inertia_along_the_leg) {
    dice d = {SEED};
    random_case c;
    double worst = 0;
    for (int n = 0; n < MACHINES; n++) {
        double without[6], with[6], second_rate[6];
        random_machine(&d, 0, &c);
        ck_assert_int_eq(
            gough_inverse_dynamics(&c.machine, &c.state, &c.acceleration, NULL, without, NULL),
            GOUGH_OK);
        ck_assert_int_eq(
            gough_leg_kinematics(&c.machine, &c.state, &c.acceleration, NULL, NULL, second_rate),
            GOUGH_OK);
        fill(&d, 6, 0, c.second.load.mass, c.second.platform.reflected_mass);
        make_machine(&c);
        ck_assert_int_eq(
            gough_inverse_dynamics(&c.machine, &c.state, &c.acceleration, NULL, with, NULL),
            GOUGH_OK);
        for (int k = 0; k < 6; k++)
            without[k] += c.second.platform.reflected_mass[k] * second_rate[k];
        worst = worse(worst, relative(6, with, without));
    }
    ck_assert_msg(worst <= IDENTITY, "seed %d: differs by %g", (int)SEED, worst);
}
END_TEST

/* ---- a published machine ---- */

/* MathWorks' Stewart platform at rest at home, SI units. Digits of the force: those published. */
START_TEST(published_machine_needs_the_published_forces) {
    const double degree = 3.14159265358979323846 / 180, length = 3.153800683985;
    const double expected[2] = {3137.519736, 4078.783657};
    random_case c;
    bodies_instant now;
    double drive[6];
    memset(&c, 0, sizeof c);
    c.second.platform = gough_platform_symmetric(3, 2.5 * degree, 1, 10 * degree, 2);
    c.second.load = (gough_load){
        .mass = 1216.926817904,
        .inertia = {{304.485230896, 0, 0}, {0, 304.485230896, 0}, {0, 0, 608.463408952}}};
    c.second.gravity[2] = -9.81;
    for (int heavy = 0; heavy < 2; heavy++) {
        gough_platform *p = &c.second.platform;
        for (int k = 0; k < 6 && heavy; k++) {
            p->cylinder.mass[k] = 92.110671136;
            p->cylinder.inertia[k] = 43.023996787;
            p->piston.mass[k] = 51.812252514;
            p->piston.inertia[k] = 24.168615535;
            p->cylinder.center[k] = p->piston.center[k] = 3. / 8 * length;
        }
        make_machine(&c);
        c.state = gough_state_home(&c.machine);
        ck_assert_int_eq(
            gough_inverse_dynamics(&c.machine, &c.state, &c.acceleration, NULL, drive, NULL),
            GOUGH_OK);
        bodies_inverse(&c.second, &c.state, &c.acceleration, NULL, &now);
        for (int k = 0; k < 6; k++) {
            ck_assert_msg(fabs(drive[k] - expected[heavy]) <= 1e-6, "%.7f", drive[k]);
            ck_assert_msg(fabs(now.drive[k] - expected[heavy]) <= 1e-6, "%.7f", now.drive[k]);
            ck_assert_msg(fabs(now.length[k] - length) <= 1e-12, "%.13f", now.length[k]);
        }
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("thirteen_bodies");
    TCase *tests = tcase_create("thirteen_bodies");
    tcase_set_timeout(tests, 120);
    tcase_add_loop_test(tests, random_machines_agree, 0, KINDS);
    tcase_add_test(tests, drive_forces_of_locking_drives_agree);
    tcase_add_loop_test(tests, momentum_and_energy_balance, 0, KINDS);
    tcase_add_loop_test(tests, inverse_then_forward_gives_the_acceleration_back, 0, KINDS);
    tcase_add_test(tests, pistons_that_are_points_at_their_joints_belong_to_the_load);
    tcase_add_test(tests, reflected_mass_alone_adds_its_inertia_along_the_leg);
    tcase_add_test(tests, published_machine_needs_the_published_forces);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
