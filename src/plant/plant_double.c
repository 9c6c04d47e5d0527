/* The public functions on one pose: gough/dynamics.h over double. */
#define NUMBER_DOUBLE
#include "gough/dynamics.h"

#include <string.h>

#include "base/limits.h"
#include "gough/sizes.h"
#include "kernel/known_load.h"
#include "plant/can_move.h"
#include "plant/forward.h"
#include "plant/hexapod.h"
#include "plant/inverse.h"
#include "plant/joints.h"
#include "plant/program_motion.h"
#include "plant/roll_pitch_yaw.h"
#include "plant/rotation_valid.h"

/* the machine, the coordinates and the legs of a public state */
typedef struct {
    hexapod h;
    coordinates x, rate;
    legs g;
    vector omega;
    bool heavy, rough; /* the legs have mass; friction */
} pose;

static triad triad_of_rotation(const double r[3][3]) {
    return (triad){
        {r[0][0], r[1][0], r[2][0]}, {r[0][1], r[1][1], r[2][1]}, {r[0][2], r[1][2], r[2][2]}};
}

static void rotation_of_triad(const triad *R, double r[3][3]) {
    const vector column[3] = {R->i, R->j, R->k};
    for (int c = 0; c < 3; c++) {
        r[0][c] = column[c].x, r[1][c] = column[c].y, r[2][c] = column[c].z;
    }
}

static void vector_out(vector v, double out[3]) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

/* false for a state whose matrix is not a rotation */
static bool pose_of_state(pose *p, const gough_machine *machine, const gough_state *state) {
    const triad R = triad_of_rotation(state->rotation);
    const vector origin = {0, 0, 0};

    if (!is_rotation(state->rotation)) return false;
    hexapod_of_machine(&p->h, machine);
    p->omega = vector_of(state->angular_velocity);
    p->x = coordinates_of_top(&p->h, origin, vector_of(state->position), &R);
    p->rate = rates_of_top(&p->h, &p->x, vector_of(state->velocity), p->omega);
    legs_at(&p->h, &p->x, &p->g);
    legs_rates(&p->h, &p->rate, &p->g);
    p->heavy = machine->platform.legs_have_mass;
    p->rough = machine_has_friction(machine);
    return true;
}

static coordinates acceleration_of(const pose *p, const gough_acceleration *a) {
    return accelerations_of_top(&p->h, &p->x, vector_of(a->linear), p->omega,
                                vector_of(a->angular));
}

static vector external_force(const gough_wrench *external) {
    return external ? vector_of(external->force) : (vector){0, 0, 0};
}
static vector external_moment(const gough_wrench *external) {
    return external ? vector_of(external->moment) : (vector){0, 0, 0};
}

gough_status gough_state_init(gough_state *state, size_t size, const gough_machine *machine) {
    if (size != sizeof *state) return gough_size_refuse(state, size);
    *state = (gough_state){.position = {0, 0, machine->platform.height},
                           .rotation = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    return GOUGH_OK;
}

void gough_rotation_from_angles(const double angles[3], double rotation[3][3]) {
    const jet roll = {angles[0], 0, 0}, pitch = {angles[1], 0, 0}, yaw = {angles[2], 0, 0};
    jet R[3][3];

    rotation_jets(roll, pitch, yaw, R);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) rotation[r][c] = R[r][c].v;
    }
}

gough_status gough_angles_from_rotation(double rotation[3][3], double angles[3]) {
    if (!is_rotation((const double(*)[3])rotation)) return GOUGH_ERROR_INPUT;
    const triad R = {{rotation[0][0], rotation[1][0], rotation[2][0]},
                     {rotation[0][1], rotation[1][1], rotation[2][1]},
                     {rotation[0][2], rotation[1][2], rotation[2][2]}};
    rotation_angles(GOUGH_ZYX, &R, angles);
    return GOUGH_OK;
}

void gough_rotation_in_order(gough_order order, const double angles[3], double rotation[3][3]) {
    const double opposite[3] = {0 - angles[0], 0 - angles[1], 0 - angles[2]};
    double back[3][3];

    gough_rotation_from_angles(order == GOUGH_XYZ ? opposite : angles, back);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            rotation[r][c] = order == GOUGH_ZYX   ? back[r][c]
                             : order == GOUGH_XYZ ? back[c][r]
                                                  : (double)NAN;
        }
    }
}

gough_status gough_rotation_of_quaternion(const double quaternion[4], double rotation[3][3]) {
    double most = 0, unit[4];
    for (int i = 0; i < 4; i++) {
        if (!isfinite(quaternion[i])) return GOUGH_ERROR_INPUT;
        most = fmax(most, fabs(quaternion[i]));
    }
    if (!(most > 0)) return GOUGH_ERROR_INPUT;
    for (int i = 0; i < 4; i++) unit[i] = quaternion[i] / most;
    rotation_of_axes(unit, rotation);
    return GOUGH_OK;
}

gough_status gough_angles_in_order(gough_order order, double rotation[3][3], double angles[3]) {
    if (order != GOUGH_ZYX && order != GOUGH_XYZ) return GOUGH_ERROR_INPUT;
    if (!is_rotation((const double(*)[3])rotation)) return GOUGH_ERROR_INPUT;
    const triad R = triad_of_rotation((const double(*)[3])rotation);
    rotation_angles((int)order, &R, angles);
    return GOUGH_OK;
}

gough_status gough_leg_kinematics(const gough_machine *machine, const gough_state *state,
                                  const gough_acceleration *acceleration, double length[GOUGH_LEGS],
                                  double rate[GOUGH_LEGS], double second_rate[GOUGH_LEGS]) {
    pose p;

    if (!pose_of_state(&p, machine, state)) return GOUGH_ERROR_INPUT;
    for (int v = 0; v < LEGS; v++) {
        if (length) length[v] = p.g.length[v];
        if (rate) rate[v] = p.g.rate[v];
    }
    if (acceleration && second_rate) {
        const coordinates a = acceleration_of(&p, acceleration);
        legs_second_rates(&p.h, &p.rate, &a, &p.g, second_rate);
    }
    return GOUGH_OK;
}

gough_status gough_jacobian(const gough_machine *machine, const gough_state *state,
                            double jacobian[GOUGH_LEGS][6]) {
    pose p;

    /* (legs-5): row (n, (R t) × n), t the top joint in the top frame */
    if (!pose_of_state(&p, machine, state)) return GOUGH_ERROR_INPUT;
    for (int v = 0; v < LEGS; v++) {
        vector_out(p.g.n[v], jacobian[v]);
        vector_out(cross(out_of(&p.x.q, p.h.top[v]), p.g.n[v]), jacobian[v] + 3);
    }
    return GOUGH_OK;
}

gough_status gough_conditioning(const gough_machine *machine, const gough_state *state,
                                double *condition, double *determinant) {
    pose p;

    if (!pose_of_state(&p, machine, state)) return GOUGH_ERROR_INPUT;
    if (condition) *condition = legs_condition(&p.h, &p.x, &p.g);
    if (determinant) *determinant = legs_determinant(&p.h, &p.x, &p.g).determinant;
    return GOUGH_OK;
}

/* leg forces that an acceleration needs, (mass-4); false: singular, or not finite */
static bool needed(const pose *p, const coordinates *a, const gough_wrench *external,
                   double F[GOUGH_LEGS], double *condition) {
    double wrench[1][6];
    bool sound;

    required_wrench(&p->h, &p->x, &p->rate, a, external_force(external), external_moment(external),
                    wrench[0]);
    if (p->heavy) required_by_legs(&p->h, &p->x, &p->rate, a, &p->g, wrench[0]);
    (void)leg_forces_of(&p->h, &p->x, &p->g, wrench, 1);
    *condition = legs_condition(&p->h, &p->x, &p->g);
    sound = *condition <= greatest_condition;
    for (int v = 0; v < LEGS; v++) {
        F[v] = wrench[0][v];
        sound &= fabs(F[v]) < INFINITY;
    }
    return sound;
}

gough_status gough_inverse_dynamics(const gough_machine *machine, const gough_state *state,
                                    const gough_acceleration *acceleration,
                                    const gough_wrench *external, double force[GOUGH_LEGS],
                                    double *condition) {
    double F[GOUGH_LEGS], worst;
    bool sound;
    coordinates a;
    pose p;

    if (!pose_of_state(&p, machine, state)) return GOUGH_ERROR_INPUT;
    a = acceleration_of(&p, acceleration);
    sound = needed(&p, &a, external, F, &worst);
    if (condition) *condition = worst;
    for (int v = 0; v < LEGS; v++) {
        force[v] = p.rough ? friction_drive(&p.h.dry[v], F[v], p.g.rate[v]) : F[v];
        sound &= fabs(force[v]) < INFINITY;
    }
    return sound ? GOUGH_OK : GOUGH_ERROR_NUMERICAL;
}

gough_status gough_joint_forces(const gough_machine *machine, const gough_state *state,
                                const gough_acceleration *acceleration,
                                const gough_wrench *external, double leg[GOUGH_LEGS],
                                double top[GOUGH_LEGS][3], double base[GOUGH_LEGS][3],
                                double side[GOUGH_LEGS]) {
    double F[GOUGH_LEGS], condition;
    coordinates a;
    pose p;

    if (!pose_of_state(&p, machine, state)) return GOUGH_ERROR_INPUT;
    a = acceleration_of(&p, acceleration);
    if (!needed(&p, &a, external, F, &condition)) return GOUGH_ERROR_NUMERICAL;
    for (int v = 0; v < LEGS; v++) {
        const leg_joints j = joints_of_leg(&p.h, &p.g, v, &p.rate, &a, p.heavy, F[v]);
        if (leg) leg[v] = F[v];
        if (top) vector_out(j.top, top[v]);
        if (base) vector_out(j.base, base[v]);
        if (side) side[v] = j.side;
    }
    return GOUGH_OK;
}

gough_status gough_holding_forces(const gough_machine *machine, const gough_state *state,
                                  const gough_wrench *external, double force[GOUGH_LEGS],
                                  double low[GOUGH_LEGS], double high[GOUGH_LEGS]) {
    const gough_acceleration none = {{0, 0, 0}, {0, 0, 0}};
    gough_state still = *state;
    gough_status status;
    hexapod h;

    for (int c = 0; c < 3; c++) still.velocity[c] = still.angular_velocity[c] = 0;
    status = gough_inverse_dynamics(machine, &still, &none, external, force, NULL);
    if (status == GOUGH_ERROR_INPUT) return status;
    hexapod_of_machine(&h, machine);
    for (int v = 0; v < LEGS; v++) {
        const double most = friction_most(&h.dry[v], force[v]);
        if (low) low[v] = force[v] - most;
        if (high) high[v] = force[v] + most;
    }
    return status;
}

/* (mass-13): leg forces from drive forces */
static void leg_forces(const pose *p, const double drive[GOUGH_LEGS], double F[GOUGH_LEGS]) {
    for (int v = 0; v < LEGS; v++)
        F[v] = p->rough ? friction_leg(&p->h.dry[v], drive[v], p->g.rate[v]) : drive[v];
}

static coordinates accelerations(const pose *p, const double F[GOUGH_LEGS],
                                 const gough_wrench *external) {
    const vector pull = external_force(external), turn = external_moment(external);

    return forward_dynamics(&p->h, &p->x, &p->rate, &p->g, p->heavy, F, &pull, &turn);
}

gough_status gough_forward_dynamics(const gough_machine *machine, const gough_state *state,
                                    const double force[GOUGH_LEGS], const gough_wrench *external,
                                    gough_acceleration *acceleration) {
    double F[GOUGH_LEGS];
    coordinates a;
    vector linear;
    triad R;
    pose p;

    if (!pose_of_state(&p, machine, state) || machine_locks(machine)) return GOUGH_ERROR_INPUT;
    leg_forces(&p, force, F);
    a = accelerations(&p, F, external);
    top_of_coordinates(&p.h, &a, &linear, &R);
    vector_out(linear, acceleration->linear);
    vector_out(triad_angular_velocity(&p.x.q, &a.q), acceleration->angular);
    for (int r = 0; r < 3; r++) {
        if (!isfinite(acceleration->linear[r])) return GOUGH_ERROR_NUMERICAL;
        if (!isfinite(acceleration->angular[r])) return GOUGH_ERROR_NUMERICAL;
    }
    return GOUGH_OK;
}

gough_status gough_reactions(const gough_machine *machine, const gough_state *state,
                             const double force[GOUGH_LEGS], const gough_wrench *external,
                             double reactions[6]) {
    double F[GOUGH_LEGS];
    push given;
    triad Q;
    pose p;

    if (!pose_of_state(&p, machine, state) || machine_locks(machine)) return GOUGH_ERROR_INPUT;
    leg_forces(&p, force, F);
    if (p.heavy) {
        const coordinates a = accelerations(&p, F, external);
        given = heavy_push(&p.h, &p.g, &p.rate, &a, F);
    } else {
        given = legs_push(&p.h, &p.g, F);
    }
    Q = push_generalised(&given, &p.x.q, external_moment(external));
    body_reactions(&p.h.load, &p.x.q, &p.rate.q, &Q, reactions);
    return GOUGH_OK;
}

gough_status gough_external_wrench(const gough_machine *machine, const gough_state *state, double t,
                                   gough_wrench *wrench) {
    vector force = {0, 0, 0}, moment = {0, 0, 0};
    known_load all = known_load_none();
    pose p;

    if (!pose_of_state(&p, machine, state)) return GOUGH_ERROR_INPUT;
    for (size_t n = 0; n < machine->externals; n++) {
        const gough_external *e = &machine->external[n];
        vector arm = {0, 0, 0}, f[2];
        if (e->at_given) arm = onto(&p.h.axes, subtract(vector_of(e->at), p.h.center));
        for (int k = 0; k < 2; k++) {
            const gough_formula *formula = k == 0 ? e->force : e->moment;
            f[k] = (vector){formula_jet(&formula[0], t).v, formula_jet(&formula[1], t).v,
                            formula_jet(&formula[2], t).v};
        }
        known_load_add(&all, &p.h, e->turns, arm, f[0], f[1]);
    }
    known_load_wrench(&all, &p.x.q, &force, &moment);
    const double sum = force.x + force.y + force.z + moment.x + moment.y + moment.z;
    if (!isfinite(sum)) return GOUGH_ERROR_INPUT;
    vector_out(force, wrench->force);
    vector_out(moment, wrench->moment);
    return GOUGH_OK;
}

void gough_program(const gough_machine *machine, const gough_motion *motion, double t,
                   gough_state *state, gough_acceleration *acceleration) {
    coordinates x[3];
    hexapod h;
    vector point;
    triad R, ignored;

    hexapod_of_machine(&h, machine);
    program_at(&h, machine->platform.height, motion, t, x);
    top_of_coordinates(&h, &x[0], &point, &R);
    vector_out(point, state->position);
    rotation_of_triad(&R, state->rotation);
    top_of_coordinates(&h, &x[1], &point, &ignored);
    vector_out(point, state->velocity);
    vector_out(triad_angular_velocity(&x[0].q, &x[1].q), state->angular_velocity);
    top_of_coordinates(&h, &x[2], &point, &ignored);
    vector_out(point, acceleration->linear);
    vector_out(triad_angular_velocity(&x[0].q, &x[2].q), acceleration->angular);
}
