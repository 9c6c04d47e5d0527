/* A machine from its platform and load: the checks that it can exist and move, and what follows
 * from it, (body-2), (legs-2), (legs-8). */
#define NUMBER_DOUBLE
#include <string.h>

#include "base/quantity.h"
#include "drive/actuators_check.h"
#include "gough/model.h"
#include "kernel/legs.h"
#include "kernel/principal.h"
#include "kernel/real.h"
#include "plant/limits_check.h"

/* Relative sizes below which a length or a moment counts as none. Geometry is given with a few
 * digits, so a distance of 1e-9 of the machine is one meant to be zero; triangle inequalities of
 * an inertia computed in double hold to 1e-12. */
static const double NO_DISTANCE = 1e-9, NO_MOMENT = 1e-12;

/* Determinant of the six equations over the product of their columns' lengths: about 1e-16 where
 * round-off is all that is left, above 1e-6 in any machine whose sensitivities leave something
 * to control. */
static const double NO_DETERMINANT = 1e-10;

/* Home poses at which the Jacobian is worse conditioned than double precision can tell from
 * singular. */
static const double CONDITION_SINGULAR = 1e15;

#define FAIL(error, key, ...) gough_fail_key(error, GOUGH_ERROR_INPUT, key, __VA_ARGS__)

static double distance(const double a[3], const double b[3]) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

static double length_of(const double a[3]) { return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

static bool all_finite(const double *x, int count) {
    for (int i = 0; i < count; i++)
        if (!real_finite(x[i])) return false;
    return true;
}

/* ---- numbers ---- */

static gough_status check_numbers(const gough_platform *p, const gough_load *load,
                                  const double gravity[3], gough_error *error) {
    static const char AXIS[] = "xyz";
    for (int n = 0; n < GOUGH_LEGS; n++) {
        for (int a = 0; a < 3; a++) {
            if (!real_finite(p->base[n][a]))
                return FAIL(error, "platform.base", "%c of base joint %d is not finite", AXIS[a],
                            n + 1);
            if (!real_finite(p->top[n][a]))
                return FAIL(error, "platform.top", "%c of top joint %d is not finite", AXIS[a],
                            n + 1);
        }
    }
    if (!real_finite(p->height))
        return FAIL(error, "platform.height", "the platform's height is not finite");
    if (!(real_finite(p->base_radius) && p->base_radius >= 0))
        return FAIL(error, "platform.base",
                    "the base radius must be positive and finite, not %g" IN_LENGTH,
                    p->base_radius);
    if (!(p->length_min >= 0 && real_finite(p->length_min)))
        return FAIL(error, "platform.legs.length",
                    "the least leg length must be 0 or positive, not %g" IN_LENGTH, p->length_min);
    if (!(p->length_max > p->length_min))
        return FAIL(error, "platform.legs.length",
                    "the greatest leg length, %g" IN_LENGTH ", must exceed the least, %g" IN_LENGTH,
                    p->length_max, p->length_min);
    if (!(p->speed_max > 0))
        return FAIL(error, "platform.legs.max_speed",
                    "the greatest leg speed must be positive, not %g" IN_SPEED, p->speed_max);
    if (!(p->force_max > 0))
        return FAIL(error, "platform.legs.max_force",
                    "the greatest leg force must be positive, not %g" IN_FORCE, p->force_max);
    if (!(load->mass > 0 && real_finite(load->mass)))
        return FAIL(error, "load.mass",
                    "the mass of the load must be positive and finite, not %g" IN_MASS, load->mass);
    if (!all_finite(load->center_of_mass, 3))
        return FAIL(error, "load.center_of_mass", "the load's centre of mass is not finite");
    if (!all_finite(load->inertia[0], 3) || !all_finite(load->inertia[1], 3) ||
        !all_finite(load->inertia[2], 3))
        return FAIL(error, "load.inertia", "the load's inertia is not finite");
    if (!all_finite(gravity, 3)) return FAIL(error, "gravity", "gravity is not finite");
    return GOUGH_OK;
}

/* ---- legs ---- */

/* the first leg of which the number is below `least` or not finite; 0: none */
static int first_below(const double x[GOUGH_LEGS], double least) {
    for (int v = 0; v < GOUGH_LEGS; v++)
        if (!(x[v] >= least && real_finite(x[v]))) return v + 1;
    return 0;
}

/* What must be 0 or positive in each leg: the place of the six numbers in the platform, their key, what they are. */
static const struct {
    size_t place;
    const char *key, *what;
} not_negative[] = {
    {offsetof(gough_platform, cylinder.mass), "platform.legs.cylinder.mass",
     "mass of the cylinder"},
    {offsetof(gough_platform, cylinder.inertia), "platform.legs.cylinder.inertia",
     "moment of inertia of the cylinder"},
    {offsetof(gough_platform, piston.mass), "platform.legs.piston.mass", "mass of the piston"},
    {offsetof(gough_platform, piston.inertia), "platform.legs.piston.inertia",
     "moment of inertia of the piston"},
    {offsetof(gough_platform, reflected_mass), "platform.legs.reflected_mass", "reflected mass"},
    {offsetof(gough_platform, friction.viscous), "platform.legs.friction.viscous",
     "viscous friction"},
    {offsetof(gough_platform, friction.coulomb), "platform.legs.friction.coulomb",
     "Coulomb friction"},
    {offsetof(gough_platform, friction.breakaway), "platform.legs.friction.breakaway",
     "breakaway friction"},
    {offsetof(gough_platform, friction.stribeck_speed), "platform.legs.friction.stribeck_speed",
     "Stribeck speed"},
    {offsetof(gough_platform, friction.smoothing_speed), "platform.legs.friction.smoothing_speed",
     "smoothing speed of friction"},
};

static gough_status check_legs(const gough_platform *p, gough_error *error) {
    for (size_t i = 0; i < sizeof not_negative / sizeof not_negative[0]; i++) {
        const double *six = (const double *)(const void *)((const char *)p + not_negative[i].place);
        const int leg = first_below(six, 0);
        if (leg)
            return FAIL(error, not_negative[i].key,
                        "the %s must be 0 or positive, not %g, in leg %d", not_negative[i].what,
                        six[leg - 1], leg);
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!real_finite(p->cylinder.center[v]))
            return FAIL(error, "platform.legs.cylinder.center",
                        "the centre of mass of the cylinder is not finite in leg %d", v + 1);
        if (!real_finite(p->piston.center[v]))
            return FAIL(error, "platform.legs.piston.center",
                        "the centre of mass of the piston is not finite in leg %d", v + 1);
        if (!(p->friction.efficiency[v] > 0 && p->friction.efficiency[v] <= 1))
            return FAIL(error, "platform.legs.friction.efficiency",
                        "the efficiency must be above 0 and at most 1, not %g, in leg %d",
                        p->friction.efficiency[v], v + 1);
    }
    return GOUGH_OK;
}

/* (mass-12) of leg v: breakaway, and the speed within which friction changes its sign; 1, of no effect, without dry friction */
static gough_status set_friction(gough_machine *m, int v, gough_error *error) {
    const gough_friction *f = &m->platform.friction;
    const double coulomb = f->coulomb[v], stribeck = f->stribeck_speed[v];
    const double given = f->smoothing_speed[v];
    const double usual =
        stribeck > 0 ? stribeck / 20 : 1e-3 * sqrt(m->gravity_magnitude * m->base_radius);

    m->breakaway[v] = f->breakaway[v] > 0 ? f->breakaway[v] : coulomb;
    if (m->breakaway[v] < coulomb)
        return FAIL(error, "platform.legs.friction.breakaway",
                    "the breakaway friction, %g" IN_FORCE
                    ", must not be below the Coulomb friction, %g" IN_FORCE ", in leg "
                    "%d",
                    m->breakaway[v], coulomb, v + 1);
    if (m->breakaway[v] > coulomb && !(stribeck > 0))
        return FAIL(error, "platform.legs.friction.breakaway",
                    "breakaway friction above Coulomb friction needs a stribeck_speed, in leg %d",
                    v + 1);
    const bool dry = m->breakaway[v] > 0 || f->efficiency[v] < 1;
    m->smoothing_speed[v] = given > 0 ? given : dry ? usual : 1;
    if (!(m->smoothing_speed[v] > 0))
        return FAIL(error, "platform.legs.friction",
                    "dry friction needs a smoothing_speed where there is neither a stribeck_speed "
                    "nor gravity, in leg %d",
                    v + 1);
    return GOUGH_OK;
}

static bool any_above_zero(const double x[GOUGH_LEGS]) {
    for (int v = 0; v < GOUGH_LEGS; v++)
        if (x[v] > 0) return true;
    return false;
}

static gough_status set_legs(gough_machine *m, gough_error *error) {
    gough_platform *p = &m->platform;
    gough_status status = GOUGH_OK;

    p->legs_have_mass = p->legs_have_mass || any_above_zero(p->cylinder.mass) ||
                        any_above_zero(p->cylinder.inertia) || any_above_zero(p->piston.mass) ||
                        any_above_zero(p->piston.inertia) || any_above_zero(p->reflected_mass);
    for (int v = 0; v < GOUGH_LEGS && status == GOUGH_OK; v++) status = set_friction(m, v, error);
    return status;
}

/* ---- joints ---- */

/* Whether all six points lie on one line, or at one point. */
static bool on_a_line(const double point[GOUGH_LEGS][3]) {
    int far = 1;
    for (int n = 2; n < GOUGH_LEGS; n++)
        if (distance(point[n], point[0]) > distance(point[far], point[0])) far = n;
    const double span = distance(point[far], point[0]);
    if (!(span > 0)) return true;

    const vector origin = vector_of(point[0]);
    const vector line = scale(1 / span, subtract(vector_of(point[far]), origin));
    for (int n = 1; n < GOUGH_LEGS; n++) {
        const vector off = cross(line, subtract(vector_of(point[n]), origin));
        if (norm(off) > NO_DISTANCE * span) return false;
    }
    return true;
}

/* Mean distance of the base joints from their centroid. */
static double mean_radius(const double point[GOUGH_LEGS][3]) {
    double centroid[3] = {0, 0, 0}, mean = 0;
    for (int n = 0; n < GOUGH_LEGS; n++)
        for (int a = 0; a < 3; a++) centroid[a] += point[n][a] / GOUGH_LEGS;
    for (int n = 0; n < GOUGH_LEGS; n++) mean += distance(point[n], centroid) / GOUGH_LEGS;
    return mean;
}

/* A length or magnitude that was computed from numbers given in decimals, to 15 significant digits: joints listed on a circle of
 * radius 1 have a mean distance of 0.9999999999999999 before this, and would make that the unit of length. */
static double decimal_again(double x) {
    const double decade = floor(log10(x));
    if (!(decade >= -8 && decade <= 14)) return x; /* beyond, powers of ten are not exact */
    double scale = 1;
    for (int i = 0; i < 14 - (int)decade; i++) scale *= 10;
    return round(x * scale) / scale;
}

/* |g|: exact where gravity has one component */
static double magnitude_of(const double a[3]) {
    int components = 0;
    for (int i = 0; i < 3; i++) components += fabs(a[i]) > 0;
    return components > 1 ? decimal_again(length_of(a)) : length_of(a);
}

static gough_status check_joints(const gough_platform *p, gough_error *error) {
    const double span = mean_radius(p->base) + mean_radius(p->top);
    if (!real_finite(span))
        return FAIL(error, "platform", "the joints are too far apart: their distances overflow");
    if (on_a_line(p->base)) return FAIL(error, "platform.base", "all base joints lie on one line");
    if (on_a_line(p->top)) return FAIL(error, "platform.top", "all top joints lie on one line");
    for (int m = 0; m < GOUGH_LEGS; m++) {
        for (int n = m + 1; n < GOUGH_LEGS; n++) {
            if (distance(p->base[m], p->base[n]) <= NO_DISTANCE * span &&
                distance(p->top[m], p->top[n]) <= NO_DISTANCE * span)
                return FAIL(error, "platform",
                            "legs %d and %d share both joints: they may share one, not both", m + 1,
                            n + 1);
        }
    }
    for (int n = 0; n < GOUGH_LEGS; n++) {
        const double top[3] = {p->top[n][0], p->top[n][1], p->top[n][2] + p->height};
        if (distance(top, p->base[n]) <= NO_DISTANCE * span)
            return FAIL(error, "platform.height",
                        "leg %d has zero length at home: its joints coincide", n + 1);
    }
    return GOUGH_OK;
}

/* ---- inertia ---- */

/* Principal axes and second moments, I_x = (J_y + J_z − J_x)/2: a body exists where none is
 * negative. */
static gough_status set_inertia(gough_machine *m, gough_error *error) {
    double(*J)[3] = m->load.inertia;
    double largest = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) largest = fmax(largest, fabs(J[i][j]));
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < i; j++) {
            if (fabs(J[i][j] - J[j][i]) > NO_DISTANCE * largest)
                return FAIL(error, "load.inertia",
                            "the inertia is not symmetric: row %d, column %d is %g, but row %d, "
                            "column %d is %g",
                            i + 1, j + 1, J[i][j], j + 1, i + 1, J[j][i]);
            if (J[i][j] > J[j][i] || J[i][j] < J[j][i])
                J[i][j] = J[j][i] = J[i][j] / 2 + J[j][i] / 2;
        }
    }

    double moment[3];
    principal_axes(J, m->principal_axes, moment);
    const double greatest = fmax(moment[0], fmax(moment[1], moment[2]));
    for (int a = 0; a < 3; a++) {
        if (!(moment[a] > NO_MOMENT * greatest)) /* nor where they are not finite */
            return FAIL(error, "load.inertia",
                        "no body has this inertia: its principal moments are %.6g" IN_INERTIA
                        ", %.6g" IN_INERTIA ", %.6g" IN_INERTIA ", and "
                        "each must be positive",
                        moment[0], moment[1], moment[2]);
    }
    for (int a = 0; a < 3; a++) {
        const double b = moment[(a + 1) % 3], c = moment[(a + 2) % 3];
        m->second_moments[a] = (b - moment[a] + c) / 2;
        if (fabs(m->second_moments[a]) <= NO_MOMENT * greatest) m->second_moments[a] = 0;
        if (m->second_moments[a] < 0)
            return FAIL(error, "load.inertia",
                        "no body has this inertia: of its principal moments %.6g" IN_INERTIA
                        ", %.6g" IN_INERTIA ", %.6g" IN_INERTIA " the "
                        "greatest exceeds the sum of the other two",
                        moment[0], moment[1], moment[2]);
    }
    return GOUGH_OK;
}

/* ---- the six equations ---- */

/* Top frame at `position`, turned by the unit quaternion of (1, turn). */
static coordinates pose(const hexapod *h, vector position, vector turn) {
    const double w2 = 1 / (1 + dot(turn, turn)); /* square of the quaternion's scalar part */
    triad R = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    vector *axis[3] = {&R.i, &R.j, &R.k};
    for (int a = 0; a < 3; a++) {
        const vector once = cross(turn, *axis[a]);
        *axis[a] = along(*axis[a], 2 * w2, add(once, cross(turn, once)));
    }
    return (coordinates){add(position, out_of(&R, h->center)), compose(&R, &h->axes)};
}

/* |det| of the six equations over the product of the lengths of its columns, 0 … 1; 0 also where
 * a leg has no length. */
static double relative_determinant(const hexapod *h, const coordinates *x) {
    legs g;
    double a[6][6], product = 1;
    legs_at(h, x, &g);
    legs_equations(h, x, &g, h->top, a);
    for (int v = 0; v < LEGS; v++) {
        double square = 0;
        for (int r = 0; r < 6; r++) square += a[r][v] * a[r][v];
        product *= sqrt(square);
    }
    const double ratio = fabs(solve_six(a, NULL, 0).determinant) / product;
    return ratio > 0 ? ratio : 0; /* a pivot of exactly 0 leaves no number behind */
}

/* Whether the machine is singular wherever it goes: tried in poses spread around home by an
 * additive recurrence, whose six steps are the powers of 1/φ, φ⁷ = φ + 1, as these fill the six
 * dimensions evenly. */
static bool singular_everywhere(const hexapod *h, double height, double radius) {
    enum { POSES = 20 };
    const double step = 1 / 1.1127756842787055;
    for (int k = 1; k <= POSES; k++) {
        double offset[6], power = 1;
        for (int i = 0; i < 6; i++) {
            power *= step;
            offset[i] = k * power - floor(k * power) - 0.5;
        }
        const vector position = {0.6 * radius * offset[0], 0.6 * radius * offset[1],
                                 height + 0.6 * radius * offset[2]};
        const vector turn = {0.5 * offset[3], 0.5 * offset[4], 0.5 * offset[5]};
        const coordinates x = pose(h, position, turn);
        if (relative_determinant(h, &x) > NO_DETERMINANT) return false;
    }
    return true;
}

static gough_status set_home(gough_machine *m, gough_error *error) {
    const gough_platform *p = &m->platform;
    const gough_load *load = &m->load;
    hexapod h;
    hexapod_setup(&h, p->base, p->top, load->mass, load->center_of_mass, m->principal_axes,
                  m->second_moments, m->gravity);

    legs g;
    const coordinates x = pose(&h, (vector){0, 0, p->height}, (vector){0, 0, 0});
    legs_at(&h, &x, &g);
    memcpy(m->home_length, g.length, sizeof m->home_length);
    const double condition = legs_condition(&h, &x, &g);
    m->home_condition = condition < CONDITION_SINGULAR ? condition : INFINITY;

    if (singular_everywhere(&h, p->height, m->base_radius))
        return FAIL(error, "platform",
                    "the machine is singular in every pose, so its legs cannot hold the top. This "
                    "happens if base and top are similar hexagons; change the spacing of the "
                    "joints on one of them");
    return GOUGH_OK;
}

gough_status gough_machine_init(gough_machine *machine, const gough_platform *platform,
                                const gough_load *load, const double gravity[3],
                                gough_error *error) {
    gough_machine m = {.platform = *platform, .load = *load};
    memcpy(m.gravity, gravity, sizeof m.gravity);

    gough_status status = check_numbers(platform, load, gravity, error);
    if (status == GOUGH_OK) status = check_legs(platform, error);
    if (status == GOUGH_OK) status = actuators_check(&platform->actuators, error);
    if (status == GOUGH_OK) status = check_joints(platform, error);
    if (status != GOUGH_OK) return status;
    m.gravity_magnitude = magnitude_of(gravity);
    m.base_radius = platform->base_radius > 0 ? platform->base_radius
                                              : decimal_again(mean_radius(platform->base));

    status = set_legs(&m, error);
    if (status == GOUGH_OK) status = set_inertia(&m, error);
    if (status == GOUGH_OK) status = set_home(&m, error);
    if (status == GOUGH_OK) status = limits_check(platform, m.home_length, error);
    if (status == GOUGH_OK) *machine = m;
    return status;
}

gough_status gough_machine_set_external(gough_machine *machine, const gough_external *external,
                                        size_t count, gough_error *error) {
    static const char *const key[GOUGH_EXTERNALS] = {
        "external.1.at", "external.2.at", "external.3.at", "external.4.at",
        "external.5.at", "external.6.at", "external.7.at", "external.8.at"};

    if (count > GOUGH_EXTERNALS)
        return FAIL(error, "external", "there are %zu external loads; a machine has at most %d",
                    count, GOUGH_EXTERNALS);
    for (size_t n = 0; n < count; n++) {
        const double *at = external[n].at;
        if (!external[n].at_given || all_finite(at, 3)) continue;
        return FAIL(error, key[n], "the point of external load %zu is not finite", n + 1);
    }
    machine->external = count > 0 ? external : NULL;
    machine->externals = count;
    return GOUGH_OK;
}
