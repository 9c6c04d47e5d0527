/* The run's own equations over complex numbers: an imaginary step of 1e-30 along each of the twelve directions that the
 * constraints (1.2) leave free comes out as a column of the linearised system, exact to rounding.
 * Theory: docs/theory/stability.md. */
#define NUMBER_COMPLEX
#include "linear/linear.h"

#include "linear/displace.h"
#include "system/system.h"

static const gough_disturbance undisturbed;

/* drives that follow all that is asked of them, at once or late */
static void take_limits_off(struct system *r) {
    r->traits &= ~SATURATING;
    for (int v = 0; v < LEGS; v++) {
        r->drives[v].least = -INFINITY;
        r->drives[v].most = r->drives[v].rate = INFINITY;
    }
}

/* `control` is that of the loop, continuous; drives have their limits */
static void begin_limited(struct system *r, const linear_loop *loop, gough_control *control,
                          const gough_simulation *options) {
    const system_lane lane = {loop->machine, control, &undisturbed, 0, 0};

    *control = *loop->control;
    control->sampling.period = 0;
    system_begin(r, loop->motion, options, &lane);
    system_take_dry_friction_off(r);
    r->external_share = number_of(1) - number_of(loop->unloaded);
    for (int v = 0; v < LEGS && loop->undamped; v++) r->h.dry[v].viscous = 0;
}

static void begin_whole(struct system *r, const linear_loop *loop, gough_control *control,
                        const gough_simulation *options) {
    begin_limited(r, loop, control, options);
    take_limits_off(r);
}

/* the same without states but pose and velocities: drives give at once what is asked, and nothing is integrated */
static void begin(struct system *r, const linear_loop *loop, gough_control *control,
                  const gough_simulation *options) {
    begin_whole(r, loop, control, options);
    r->traits &= ~(LAGGING | SECOND_ORDER | INTEGRATING);
    system_lay_out(r);
}

static gough_simulation unstabilised(void) {
    gough_simulation options = gough_simulation_default();

    options.constraints = GOUGH_NONE;
    return options;
}

/* ρ, i, j, k and rates of a top's state */
static void state_of_top(const hexapod *h, const gough_state *state, coordinates *x,
                         coordinates *rate) {
    const vector none = {0, 0, 0};
    const triad R = {
        {state->rotation[0][0], state->rotation[1][0], state->rotation[2][0]},
        {state->rotation[0][1], state->rotation[1][1], state->rotation[2][1]},
        {state->rotation[0][2], state->rotation[1][2], state->rotation[2][2]},
    };

    *x = coordinates_of_top(h, none, vector_of(state->position), &R);
    *rate = rates_of_top(h, x, vector_of(state->velocity), vector_of(state->angular_velocity));
}

/* (stab-13): δṙ = δv, δθ̇ = δω + ω × δθ, and δv̇, δω̇ from the equations of motion */
static void column(struct system *r, double t, coordinates x, coordinates rate, int direction,
                   linear_matrix matrix) {
    const vector omega = triad_angular_velocity(&x.q, &rate.q);
    const vector unit = unit_vector(direction % 3), none = {0, 0, 0};
    const int kind = direction / 3;
    const vector turning = kind == 1 ? cross(omega, unit) : kind == 3 ? unit : none;
    number y[STATE_SIZE], change[STATE_SIZE], out[GOUGH_LINEAR];
    coordinates a;

    displace(direction, &x, &rate);
    coordinates_store(&x, y);
    coordinates_store(&rate, y + COORDINATES);
    system_rates(r, t, y, change);
    a = coordinates_load(change + COORDINATES);

    vector_store(kind == 2 ? unit : none, out);
    vector_store(turning, out + 3);
    vector_store(imaginary(a.rho), out + 6);
    vector_store(imaginary(angular_velocity_of(&x, &a)), out + 9);
    for (int i = 0; i < GOUGH_LINEAR; i++) matrix[i][direction] = creal(out[i]);
}

static void columns(struct system *r, double t, const coordinates *x, const coordinates *rate,
                    linear_matrix matrix) {
    for (int direction = 0; direction < GOUGH_LINEAR; direction++)
        column(r, t, *x, *rate, direction, matrix);
}

static const char *complex_matrix(const linear_loop *loop, double t, const gough_state *state,
                                  linear_matrix matrix) {
    const gough_simulation options = unstabilised();
    gough_control control;
    struct system r;
    coordinates x, rate;

    begin(&r, loop, &control, &options);
    if (state == NULL) {
        const wanted *s = system_wanted(&r, t);
        x = s->x[0], rate = s->x[1];
    } else {
        state_of_top(&r.h, state, &x, &rate);
    }
    columns(&r, t, &x, &rate, matrix);
    return r.fault.what;
}

/* the states beyond pose and velocities where drives give what is asked of them and integrals are 0 */
static void settle_beyond(struct system *r, double t, const coordinates *x, const coordinates *rate,
                          number y[STATE_SIZE]) {
    number asked[LEGS];
    legs g;

    for (int i = MOTION; i < r->states; i++) y[i] = 0;
    legs_at(&r->h, x, &g);
    legs_rates(&r->h, rate, &g);
    signals_asked(r, system_wanted(r, t), &g, y, asked);
    for (int v = 0; v < LEGS && r->traits & LAGGING; v++) y[r->drive.at + v] = asked[v];
}

/* one column of (stab-13) with states beyond pose and velocities, of which `kept` are taken: about x, rate and `beyond` */
static void whole_column(struct system *r, double t, const coordinates *x, const coordinates *rate,
                         const number *beyond, const int *kept, int size, int column,
                         double *matrix) {
    const int direction = column < GOUGH_LINEAR ? column : -1;
    const vector omega = triad_angular_velocity(&x->q, &rate->q);
    const vector unit = unit_vector(column % 3), none = {0, 0, 0};
    const int kind = direction < 0 ? -1 : direction / 3;
    coordinates there = *x, moving = *rate, a;
    number y[STATE_SIZE], change[STATE_SIZE], out[GOUGH_LINEAR];

    for (int i = MOTION; i < r->states; i++) y[i] = beyond[i - MOTION];
    if (direction < 0)
        y[MOTION + kept[column - GOUGH_LINEAR]] += I * imaginary_step;
    else
        displace(direction, &there, &moving);
    coordinates_store(&there, y);
    coordinates_store(&moving, y + COORDINATES);
    system_rates(r, t, y, change);
    a = coordinates_load(change + COORDINATES);
    vector_store(kind == 2 ? unit : none, out);
    vector_store(kind == 1 ? cross(omega, unit) : kind == 3 ? unit : none, out + 3);
    vector_store(imaginary(a.rho), out + 6);
    vector_store(imaginary(angular_velocity_of(&there, &a)), out + 9);
    for (int i = 0; i < size; i++)
        matrix[size * i + column] =
            i < GOUGH_LINEAR ? creal(out[i])
                             : cimag(change[MOTION + kept[i - GOUGH_LINEAR]]) / imaginary_step;
}

static const char *complex_whole(const linear_loop *loop, double t, const gough_state *state,
                                 const int *kept, int size, double *matrix) {
    const gough_simulation options = unstabilised();
    number y[STATE_SIZE];
    gough_control control;
    coordinates x, rate;
    struct system r;

    begin_whole(&r, loop, &control, &options);
    if (state == NULL) {
        const wanted *s = system_wanted(&r, t);
        x = s->x[0], rate = s->x[1];
    } else {
        state_of_top(&r.h, state, &x, &rate);
    }
    settle_beyond(&r, t, &x, &rate, y);
    for (int column = 0; column < size; column++)
        whole_column(&r, t, &x, &rate, y + MOTION, kept, size, column, matrix);
    return r.fault.what;
}

static const char *complex_along(const linear_loop *loop, const double *t, size_t count,
                                 linear_matrix *matrix) {
    const gough_simulation options = unstabilised();
    gough_control control;
    struct system r;

    begin(&r, loop, &control, &options);
    for (size_t k = 0; k < count && r.fault.what == NULL; k++) {
        const wanted *s = system_wanted(&r, t[k]);
        const coordinates x = s->x[0], rate = s->x[1];
        columns(&r, t[k], &x, &rate, matrix[k]);
    }
    return r.fault.what;
}

static const char *complex_accelerations(const linear_loop *loop, double t,
                                         const gough_state *state, double acceleration[6],
                                         double force[GOUGH_LEGS]) {
    const gough_simulation options = unstabilised();
    number y[STATE_SIZE], out[6];
    gough_control control;
    coordinates x, rate;
    signals m;
    struct system r;

    begin(&r, loop, &control, &options);
    state_of_top(&r.h, state, &x, &rate);
    coordinates_store(&x, y);
    coordinates_store(&rate, y + COORDINATES);
    system_signals(&r, t, y, &m);
    vector_store(m.acceleration.rho, out);
    vector_store(angular_velocity_of(&x, &m.acceleration), out + 3);
    for (int i = 0; i < 6; i++) acceleration[i] = creal(out[i]);
    for (int v = 0; v < LEGS; v++) force[v] = creal(m.force[v]);
    return r.fault.what;
}

/* the block of M̂ in rows from `r` and columns from `c`, from central axes to those of the base */
static void turn_block(const triad *q, number A[6][6], int r, int c, double mass[6][6]) {
    const number axis[3][3] = {
        {q->i.x, q->i.y, q->i.z}, {q->j.x, q->j.y, q->j.z}, {q->k.x, q->k.y, q->k.z}};

    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            number sum = 0;
            for (int a = 0; a < 3; a++) {
                for (int b = 0; b < 3; b++) sum += axis[a][i] * A[r + a][c + b] * axis[b][j];
            }
            mass[r + i][c + j] = creal(sum);
        }
    }
}

static void complex_mass(const gough_machine *machine, const gough_state *state,
                         double mass[6][6]) {
    const number none[LEGS] = {0};
    heavy_equations e;
    coordinates x, rate;
    hexapod h;
    legs g;

    hexapod_of_machine(&h, machine);
    state_of_top(&h, state, &x, &rate);
    legs_at(&h, &x, &g);
    legs_rates(&h, &rate, &g);
    const heavy_central c = heavy_central_of(&h, &x, &rate);
    e = heavy_equations_of(&h, &x, &c, &g, none);
    for (int i = 0; i < 6; i++) {
        for (int j = i + 1; j < 6; j++) e.A[i][j] = e.A[j][i];
    }
    for (int r = 0; r < 6; r += 3) {
        for (int k = 0; k < 6; k += 3) turn_block(&x.q, e.A, r, k, mass);
    }
}

/* (mass-2): the momentum of the legs' and the load's velocities, of force and about the centre of mass, base axes */
static void momenta_of(const hexapod *h, const coordinates *x, const coordinates *rate, vector *P,
                       vector *L) {
    const vector omega = onto(&x->q, triad_angular_velocity(&x->q, &rate->q)), none = {0, 0, 0};
    const body *b = &h->load;
    legs g;

    *P = scale(b->mass, rate->rho);
    *L = out_of(&x->q, (vector){(b->Iy + b->Iz) * omega.x, (b->Iz + b->Ix) * omega.y,
                                (b->Ix + b->Iy) * omega.z});
    legs_at(h, x, &g);
    legs_rates(h, rate, &g);
    for (int v = 0; v < LEGS; v++) {
        const vector velocity = joint_of(h, rate, v);
        const leg_motion m =
            leg_motion_of(&h->mass[v], none, g.length[v], g.n[v], velocity, g.rate[v]);
        const vector p = along(scale(m.across, velocity), m.more * g.rate[v], g.n[v]);
        *P = add(*P, p);
        *L = add(*L, cross(out_of(&x->q, h->arm[v]), p));
    }
}

static void complex_momenta(const gough_machine *machine, const gough_state *state,
                            double change[6][GOUGH_LINEAR], double moment[3]) {
    coordinates x, rate;
    vector P, L;
    hexapod h;

    hexapod_of_machine(&h, machine);
    state_of_top(&h, state, &x, &rate);
    for (int direction = 0; direction < GOUGH_LINEAR; direction++) {
        coordinates there = x, moving = rate;
        number p[6];
        displace(direction, &there, &moving);
        momenta_of(&h, &there, &moving, &P, &L);
        vector_store(imaginary(P), p);
        vector_store(imaginary(L), p + 3);
        for (int i = 0; i < 6; i++) change[i][direction] = creal(p[i]);
    }
    moment[0] = creal(L.x), moment[1] = creal(L.y), moment[2] = creal(L.z);
}

static const char *complex_flow(const linear_loop *loop, double t, const double *y, double *rate,
                                const int *kept, int size, double *matrix) {
    const gough_simulation options = unstabilised();
    number z[STATE_SIZE], change[STATE_SIZE];
    gough_control control;
    coordinates x, v;
    struct system r;

    if (loop->whole)
        begin_limited(&r, loop, &control, &options);
    else
        begin(&r, loop, &control, &options);
    for (int i = 0; i < r.states; i++) z[i] = y[i];
    system_rates(&r, t, z, change);
    for (int i = 0; i < r.states; i++) rate[i] = creal(change[i]);
    x = coordinates_load(z);
    v = coordinates_load(z + COORDINATES);
    for (int column = 0; column < size && matrix != NULL; column++)
        whole_column(&r, t, &x, &v, z + MOTION, kept, size, column, matrix);
    return r.fault.what;
}

static int complex_states(const linear_loop *loop) {
    const gough_simulation options = unstabilised();
    gough_control control;
    struct system r;

    if (!loop->whole) return MOTION;
    begin_whole(&r, loop, &control, &options);
    return r.states;
}

/* rates of the program's forces, to a few digits */
static void force_rates(struct system *r, double t, double rate[LEGS]) {
    const double step = 1e-3 / sqrt(creal(r->drives[0].square));

    for (int side = 1; side >= -1; side -= 2) {
        const wanted *s = system_wanted(r, t + side * step);
        for (int v = 0; v < LEGS; v++)
            rate[v] = (side > 0 ? 0 : rate[v]) + side * creal(s->force[v]) / (2 * step);
    }
}

static void complex_settle(const linear_loop *loop, double t, double y[STATE_SIZE]) {
    const gough_simulation options = unstabilised();
    number z[STATE_SIZE];
    gough_control control;
    coordinates x, rate;
    struct system r;

    if (!loop->whole) return;
    begin_whole(&r, loop, &control, &options);
    for (int i = 0; i < MOTION; i++) z[i] = y[i];
    x = coordinates_load(z);
    rate = coordinates_load(z + COORDINATES);
    settle_beyond(&r, t, &x, &rate, z);
    for (int i = MOTION; i < r.states; i++) y[i] = creal(z[i]);
    if (r.traits & SECOND_ORDER) force_rates(&r, t, y + r.drive.at + LEGS);
}

const struct linear_complex linear_complex = {
    complex_matrix, complex_whole, complex_along,  complex_accelerations, complex_momenta,
    complex_mass,   complex_flow,  complex_states, complex_settle};
