/* Nonlinear runs of the search: many values of G at once, and the one named in full. Theory: docs/theory/tuning.md. */
#include <complex.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "control/program_lack.h"
#include "tune/tune.h"

enum { N = GOUGH_LINEAR };

/* The fastest mode turns by this angle at most in a fixed step, so that a cubic through the ends of steps finds its peaks. */
static const double turn_between_rows = 0.4;

/* more rows than this are not taken, whatever the fastest mode */
static const double most_rows = 1e6;

/* of the verdict on a G, or of a search that cannot do without */
static const double most_small_steps = 2e6;

/* small steps in an output step */
static const double small_steps = 100;

/* steps of the method of order 8 times the rate of a decay, well within its stability; and of any method */
static const double stable_step = 3, any_stable_step = 2.5;

/* the run with small steps may exceed what is asked by its own errors and those of the others */
static const double allowance = 1e-3;

/* a damping ratio below this is round-off */
static const double rounding_ratio = 1e-12;

/* ---- many -------------------------------------------------------------------------------------------------------- */

/* The study's own step, if it has one: the step was chosen for one stiffness, so for a greater one it is halved until it follows
 * the fastest mode. */
static gough_simulation with_own_step(const tune *t, gough_simulation s, double stiffness,
                                      double parts) {
    if (!(s.step > 0)) return s;
    s.step /= parts;
    while ((t->frequency * sqrt(stiffness) * s.step > turn_between_rows ||
            t->quick * s.step > any_stable_step) &&
           s.duration / s.step < most_small_steps)
        s.step /= 2;
    return s;
}

/* The longest step that the fastest decay leaves stable: that of a drive, or D times the square of the fastest mode at G = 1,
 * unless D follows G; INFINITY: nothing decays fast. */
static double damped_step(const tune *t) {
    double damping = 0;

    for (int v = 0; v < GOUGH_LEGS && !t->ratio; v++)
        damping = fmax(damping, tune_damping_of(t, v));
    return stable_step / fmax(t->quick, damping * t->frequency * t->frequency);
}

bool tune_is_stiff(const tune *t) {
    return !t->sampled && !(t->simulation.step > 0) &&
           damped_step(t) < t->simulation.output_step / small_steps;
}

/* Adaptive steps that are as short as the small fixed ones: the samples of a controller end steps wherever they are due. */
static gough_simulation with_short_steps(const tune *t, gough_simulation s) {
    const double step = t->simulation.output_step / small_steps;

    s.method = GOUGH_DOP853;
    s.step = 0;
    s.max_step = s.max_step > 0 ? fmin(s.max_step, step) : step;
    return s;
}

/* Fixed steps of the method of order 8: a hundredth of the study's output step, less where the fastest mode or the damping asks for
 * it. */
static gough_simulation with_small_steps(const tune *t, gough_simulation s, double stiffness) {
    const double rate = t->frequency * sqrt(stiffness);
    double step, parts;

    step = fmin(t->simulation.output_step / small_steps, turn_between_rows / rate);
    step = fmin(step, damped_step(t));
    step = fmax(step, s.duration / most_small_steps);
    parts = ceil(s.output_step / step * (1 - 1e-12));
    s.method = GOUGH_DOP853;
    s.step = s.output_step / fmax(parts, 1);
    return s;
}

/* The study's output times, and others between them where the time of a peak is wanted, since that is looked for in rows; fixed
 * steps divide them. */
static gough_simulation simulation_for(const tune *t, double stiffness, bool timed) {
    gough_simulation s = t->simulation;
    const double turn = t->frequency * sqrt(stiffness) * s.output_step;
    double parts = 1;

    if (!t->fine && !(s.step > 0) && !timed) return s;
    while (turn / parts > turn_between_rows && s.duration / s.output_step * parts < most_rows)
        parts *= 2;
    s.output_step /= parts;
    if (t->fine && t->sampled) return with_short_steps(t, s);
    return t->fine ? with_small_steps(t, s, stiffness) : with_own_step(t, s, stiffness, parts);
}

/* D for a G: the model's, or that of the damping ratio, of nine digits as it will be typed; NaN where no D gives that ratio */
static gough_status damping_for(tune *t, double stiffness, double damping[GOUGH_LEGS],
                                gough_error *error) {
    gough_error unstable = {0};
    double D = NAN;
    gough_status status;

    for (int v = 0; v < GOUGH_LEGS; v++) damping[v] = t->model->control.damping[v];
    if (!t->ratio) return GOUGH_OK;
    for (int v = 0; v < GOUGH_LEGS; v++) t->loop->control.stiffness[v] = stiffness;
    status = gough_damping_for_ratio(t->loop, t->options->damping_ratio, &D, &unstable);
    if (status == GOUGH_ERROR_INPUT) return gough_fail(error, status, "%s", unstable.message);
    if (status != GOUGH_OK) D = NAN;
    if (D > 0) {
        const double unit = pow(10, 8 - floor(log10(D)));
        D = round(D * unit) / unit;
    }
    for (int v = 0; v < GOUGH_LEGS; v++) damping[v] = D;
    return GOUGH_OK;
}

static int look(void *context, size_t done) {
    const tune *t = context;

    (void)done;
    return t->options->progress &&
           t->options->progress(
               t->options->context,
               fmin(1, (double)t->tuning->points / (double)(t->whole ? t->whole : 1)));
}

static gough_status run_them(tune *t, double stiffness, size_t count, gough_error *error) {
    const gough_simulation simulation = simulation_for(t, stiffness, false);
    gough_status status;

    if (count == 0) return GOUGH_OK;
    t->batch.progress = look;
    t->batch.context = t;
    status = gough_batch(&t->model->motion, &simulation, t->run, count, &t->batch, t->outcome,
                         t->batch_memory, error);
    t->tuning->runs += count;
    return status;
}

gough_status tune_evaluate(tune *t, const double *stiffness, size_t count,
                           gough_tuning_point *point, gough_error *error) {
    size_t place[TUNE_ROUND + 1], runs = 0;
    gough_status status = GOUGH_OK;

    for (size_t i = 0; i < count && status == GOUGH_OK; i++) {
        gough_control *control = &t->control[runs];
        *control = t->loop->control;
        status = damping_for(t, stiffness[i], control->damping, error);
        point[i] = (gough_tuning_point){.stiffness = stiffness[i],
                                        .damping = control->damping[0],
                                        .small_steps = t->fine,
                                        .cause = GOUGH_END_INVALID,
                                        .end_time = NAN,
                                        .position_deviation = NAN,
                                        .angle_deviation = NAN,
                                        .force = NAN,
                                        .speed = NAN,
                                        .growth = NAN};
        if (!isfinite(control->damping[0])) continue;
        for (int v = 0; v < GOUGH_LEGS; v++) control->stiffness[v] = stiffness[i];
        t->run[runs] = (gough_batch_run){&t->model->machine,
                                         control,
                                         &t->model->disturbance,
                                         &t->model->initial,
                                         t->model->disturbance.noise.run,
                                         control->sampling.run};
        place[runs++] = i;
    }
    if (status == GOUGH_OK) status = run_them(t, stiffness[count - 1], runs, error);
    for (size_t r = 0; r < runs && status == GOUGH_OK; r++) {
        const gough_outcome *out = &t->outcome[r];
        gough_tuning_point *p = &point[place[r]];
        p->cause = out->cause;
        p->leg = out->leg;
        p->end_time = out->time;
        if (!(out->rows > 0)) continue;
        p->position_deviation = out->position_deviation;
        p->angle_deviation = out->angle_deviation;
        p->force = out->force;
        p->speed = out->speed;
    }
    return status;
}

bool tune_meets(const tune *t, const gough_tuning_point *point) {
    return point->cause == GOUGH_END_DONE && point->position_deviation <= t->options->deviation &&
           point->angle_deviation <= t->options->angle_deviation;
}

gough_status tune_verify(tune *t, const gough_tuning_point *point, bool *good, gough_error *error) {
    const bool before = t->fine;
    gough_tuning_point again;
    gough_status status;

    t->fine = true;
    status = tune_evaluate(t, &point->stiffness, 1, &again, error);
    t->fine = before;
    *good = status == GOUGH_OK && again.cause == GOUGH_END_DONE &&
            again.position_deviation <= t->options->deviation * (1 + allowance) &&
            again.angle_deviation <= t->options->angle_deviation * (1 + allowance);
    return status;
}

/* ---- one in full ------------------------------------------------------------------------------------------------- */

typedef struct {
    const gough_model *model;
    gough_summary summary;
    double position, position_time, angle, angle_time;
    bool by_angle;               /* which of the two is at its worst in `worst` */
    double worst[GOUGH_COLUMNS]; /* row at which the deviation that binds is largest */
} listener;

static int listen(void *context, const gough_row *row) {
    listener *l = context;
    const double *value = row->value;
    bool worse = false;

    /* the summary, which the run fills, has seen this row and what lies between it and the one before */
    if (!(l->summary.position_deviation <= l->position)) {
        l->position = l->summary.position_deviation;
        l->position_time = value[GOUGH_T];
        worse = !l->by_angle;
    }
    if (!(l->summary.angle_deviation <= l->angle)) {
        l->angle = l->summary.angle_deviation;
        l->angle_time = value[GOUGH_T];
        worse |= l->by_angle;
    }
    if (worse) memcpy(l->worst, value, sizeof l->worst);
    return 0;
}

static void cross_to(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* rotation vector of A Bᵀ where they differ little: half of its skew part */
static void turn_between(double A[3][3], double B[3][3], double out[3]) {
    double C[3][3];

    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            C[r][c] = A[r][0] * B[c][0] + A[r][1] * B[c][1] + A[r][2] * B[c][2];
        }
    }
    out[0] = 0.5 * (C[2][1] - C[1][2]);
    out[1] = 0.5 * (C[0][2] - C[2][0]);
    out[2] = 0.5 * (C[1][0] - C[0][1]);
}

/* centre of mass from the top-frame origin, base axes */
static void arm_of(const gough_machine *machine, double R[3][3], double arm[3]) {
    const double *c = machine->load.center_of_mass;

    for (int r = 0; r < 3; r++) arm[r] = R[r][0] * c[0] + R[r][1] * c[1] + R[r][2] * c[2];
}

/* ξ of a row: from the program's state to the actual one, to first order */
static void deviation_of(const gough_model *model, const double *value, double xi[N]) {
    double actual[3][3], arm[3], program_arm[3], spin[3], program_spin[3];
    gough_acceleration none;
    gough_state program;

    gough_program(&model->machine, &model->motion, value[GOUGH_T], &program, &none);
    gough_rotation_in_order(model->motion.order, value + GOUGH_ROLL_ANGLE, actual);
    turn_between(actual, program.rotation, xi + 3);
    arm_of(&model->machine, actual, arm);
    arm_of(&model->machine, program.rotation, program_arm);
    cross_to(value + GOUGH_WX, arm, spin);
    cross_to(program.angular_velocity, program_arm, program_spin);
    for (int i = 0; i < 3; i++) {
        xi[i] = value[GOUGH_EX + i] + arm[i] - program_arm[i];
        xi[6 + i] = value[GOUGH_VX + i] - program.velocity[i] + spin[i] - program_spin[i];
        xi[9 + i] = value[GOUGH_WX + i] - program.angular_velocity[i];
    }
}

/* (tune-4): ξ = Σ c_k (s_k, λ_k s_k) */
static bool amplitudes(const gough_rest *rest, const double xi[N], double complex c[N]) {
    double complex a[N * N];
    lapack_int pivot[N];

    for (int k = 0; k < N; k++) {
        const gough_eigenvalue *e = &rest->eigenvalue[k];
        const double complex lambda = e->value[0] + I * e->value[1];
        for (int i = 0; i < 6; i++) {
            const double complex s = e->mode.shape[i][0] + I * e->mode.shape[i][1];
            a[i + N * k] = s;
            a[6 + i + N * k] = lambda * s;
        }
        c[k] = xi[k];
    }
    return LAPACKE_zgesv_work(LAPACK_COL_MAJOR, N, 1, a, N, pivot, c, N) == 0;
}

/* What modes called alike contribute to the deviation of position, or of angle. */
static double contribution(const tune *t, const char *name, const double complex c[N], bool angle) {
    double sum[3] = {0, 0, 0}, arm[3];
    gough_rest rest = t->rest;

    arm_of(&t->model->machine, rest.state.rotation, arm);
    for (int k = 0; k < N; k++) {
        const gough_mode *mode = &rest.eigenvalue[k].mode;
        double part[6], lever[3];
        if (strcmp(mode->name, name) != 0) continue;
        for (int i = 0; i < 6; i++)
            part[i] = creal(c[k] * (mode->shape[i][0] + I * mode->shape[i][1]));
        cross_to(part + 3, arm, lever);
        for (int i = 0; i < 3; i++) sum[i] += angle ? part[3 + i] : part[i] - lever[i];
    }
    return hypot(hypot(sum[0], sum[1]), sum[2]);
}

/* which mode holds most of the deviation at its worst */
static void binding_mode(tune *t, const listener *l) {
    const gough_rest *rest = &t->rest;
    gough_tuning *tuning = t->tuning;
    double complex c[N];
    double xi[N], most = 0, sum = 0;

    tuning->mode_share = NAN;
    strcpy(tuning->mode.name, "none");
    deviation_of(t->model, l->worst, xi);
    if (!amplitudes(rest, xi, c)) return;
    for (int k = 0; k < N; k++) {
        const gough_mode *mode = &rest->eigenvalue[k].mode;
        bool counted = false;
        for (int j = 0; j < k; j++)
            counted |= strcmp(rest->eigenvalue[j].mode.name, mode->name) == 0;
        const double part = contribution(t, mode->name, c, l->by_angle);
        if (counted || !isfinite(part)) continue;
        sum += part;
        if (part > most) {
            most = part;
            tuning->mode = *mode;
        }
    }
    if (sum > 0) tuning->mode_share = most / sum;
}

/* share of the limits of its force that a leg uses; a limit of 0 leaves nothing to use */
static double used_force(const gough_leg_summary *leg, const double limit[2]) {
    const double push = limit[1] > 0 ? leg->force_max / limit[1] : 0;
    const double pull = limit[0] < 0 ? leg->force_min / limit[0] : 0;
    return fmax(push, pull);
}

static void binding_leg(tune *t, const gough_summary *summary) {
    const gough_limits limit = gough_limits_of(&t->model->machine, &t->model->motion);
    gough_tuning *tuning = t->tuning;
    double force_share = 0, speed_share = 0;

    tuning->force = tuning->speed = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const gough_leg_summary *leg = &summary->leg[v];
        const double force = fmax(fabs(leg->force_min), fabs(leg->force_max));
        /* legs that are alike but for rounding: the first */
        if (force > tuning->force * (1 + 1e-9)) {
            tuning->force = force;
            tuning->leg = v + 1;
        }
        tuning->speed = fmax(tuning->speed, leg->speed);
        force_share = fmax(force_share, used_force(leg, limit.force[v]));
        speed_share = fmax(speed_share, leg->speed / limit.speed[v]);
    }
    tuning->force_share = force_share > 0 ? force_share : NAN;
    tuning->speed_share = speed_share > 0 ? speed_share : NAN;
}

gough_status tune_detail(tune *t, gough_error *error) {
    gough_tuning *tuning = t->tuning;
    gough_simulation simulation = simulation_for(t, tuning->stiffness, true);
    listener l = {.model = t->model, .position = -1, .angle = -1};
    gough_end end;
    gough_status status;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        t->loop->control.stiffness[v] = tuning->stiffness;
        t->loop->control.damping[v] = t->ratio ? tuning->damping : t->model->control.damping[v];
    }
    l.by_angle = tuning->binding == GOUGH_TUNING_ANGLE;
    simulation.summary = &l.summary;
    status = gough_simulate(t->loop, &simulation, listen, &l, &end, error);
    if (status != GOUGH_OK) return status;
    tuning->deviation = l.summary.position_deviation;
    tuning->deviation_time = l.position_time;
    tuning->angle_deviation = l.summary.angle_deviation;
    tuning->angle_time = l.angle_time;
    binding_leg(t, &l.summary);

    if (t->sampled) tuning->damping_ratio = tune_sampled_ratio(t->loop);
    if (t->states) tuning->damping_ratio = tune_states_ratio(t->loop);
    if (gough_keeps_program(&t->loop->machine, &t->loop->control, false))
        control_knows_all(&t->loop->control); /* home, with integrals too, which go now */
    tune_make_plain(t->loop);
    status = gough_stability_at_rest(t->loop, NULL, &t->rest, error);
    if (status != GOUGH_OK) return status;
    if (!t->sampled && !t->states) tuning->damping_ratio = tune_least_ratio(t->rest.matrix);
    if (fabs(tuning->damping_ratio) < rounding_ratio) tuning->damping_ratio = 0;
    if (tuning->binding != GOUGH_TUNING_THRESHOLD && tuning->binding != GOUGH_TUNING_TONGUE)
        binding_mode(t, &l);
    return GOUGH_OK;
}

/* ---- the beginning ----------------------------------------------------------------------------------------------- */

static int first_row(void *context, const gough_row *row) {
    const double *e = row->value + GOUGH_EX;

    *(double *)context = hypot(hypot(e[0], e[1]), e[2]);
    return 1;
}

double tune_initial_offset(const tune *t) {
    double offset = NAN;
    gough_end end;

    (void)gough_simulate(t->loop, &t->simulation, first_row, &offset, &end, NULL);
    return offset;
}
