/* Kernels of one width for timing. Text over the number type. */
#include "bench/kernels.h"
#include "system/problem.h"

/* states that the kernels are called on in turn */
enum { STATES = 4 };

static const double kernel_step_length = 0.001;

typedef struct {
    struct system r;
    gough_simulation options;
    number y[STATES][STATE_SIZE], rate[STATES][STATE_SIZE];
    coordinates x[STATES], velocity[STATES], acceleration[STATES];
    number u[STATES][LEGS], back[STATES][LEGS];
    dop853 work;
    number bits[8], out[8];
} kernel;

/* a stage is as good as any other: the program is timed by itself */
static void hold(struct system *r, real t) {
    (void)r;
    (void)t;
}

static void begin(void *memory, const reference *ref) {
    kernel *k = memory;
    system_lane lane[NUMBER_WIDTH];
    signals m;

    k->options = gough_simulation_default();
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        lane[i] = (system_lane){.machine = &ref->model.machine,
                                .control = &ref->model.control,
                                .disturbance = &ref->model.disturbance};
    }
    system_begin(&k->r, &ref->model.motion, &k->options, lane);
    (void)system_wanted(&k->r, 5);
    k->r.provide = hold;

    for (int s = 0; s < STATES; s++) {
        coordinates x = k->r.now.x[0], v = k->r.now.x[1];
        number small;
        for (int i = 0; i < NUMBER_WIDTH; i++) number_put(&small, i, 1e-3 * (i + s + 1));
        x.rho.x = x.rho.x + small;
        x.q.i.y = x.q.i.y + small;
        x.q.k.x = x.q.k.x - small;
        coordinates_project(&x, &v);
        coordinates_store(&x, k->y[s]);
        coordinates_store(&v, k->y[s] + COORDINATES);
        system_signals(&k->r, 5, k->y[s], &m);
        k->x[s] = m.x;
        k->velocity[s] = m.rate;
        k->acceleration[s] = m.acceleration;
        for (int v2 = 0; v2 < LEGS; v2++) k->u[s][v2] = m.force[v2];
    }
    for (int i = 0; i < 8; i++) k->bits[i] = k->out[i] = number_of(1.5 + i);
}

static void right_hand_side(void *memory) {
    kernel *k = memory;

    for (int c = 0; c < KERNEL_CALLS; c++) {
        system_rates(&k->r, 5, k->y[c % STATES], k->rate[c % STATES]);
    }
}

static void inverse_dynamics(void *memory) {
    kernel *k = memory;
    const vector none = {number_of(0), number_of(0), number_of(0)};

    for (int c = 0; c < KERNEL_CALLS; c++) {
        const int s = c % STATES;
        number wrench[1][6];
        legs g;
        legs_at(&k->r.h, &k->x[s], &g);
        required_wrench(&k->r.h, &k->x[s], &k->velocity[s], &k->acceleration[s], none, none,
                        wrench[0]);
        (void)leg_forces_of(&k->r.h, &k->x[s], &g, wrench, 1);
        for (int v = 0; v < LEGS; v++) k->back[s][v] = wrench[0][v];
    }
}

static double round_trip(void *memory) {
    kernel *k = memory;
    double worst = 0;

    inverse_dynamics(memory);
    for (int s = 0; s < STATES; s++) {
        for (int v = 0; v < LEGS; v++) {
            for (int i = 0; i < NUMBER_WIDTH; i++) {
                const double d = fabs(number_lane(k->back[s][v] - k->u[s][v], i));
                if (!(d <= worst)) worst = d;
            }
        }
    }
    return worst;
}

/* what follows a step: the constraints kept */
static inline void keep(const number *raw, number *y) {
    coordinates x = coordinates_load(raw), v = coordinates_load(raw + COORDINATES);

    coordinates_project(&x, &v);
    coordinates_store(&x, y);
    coordinates_store(&v, y + COORDINATES);
}

static void kernel_rk4_step(void *memory) {
    kernel *k = memory;
    const real h = kernel_step_length;
    number raw[STATE_SIZE];

    for (int c = 0; c < KERNEL_CALLS; c++) {
        system_rates(&k->r, 5, k->y[0], k->rate[0]);
        rk4_step(system_rates, &k->r, MOTION, 5 + c * h, h, k->y[0], k->rate[0], raw);
        keep(raw, k->y[0]);
    }
}

static void kernel_dop853_step(void *memory) {
    kernel *k = memory;
    const real h = kernel_step_length;
    number raw[STATE_SIZE];

    for (int c = 0; c < KERNEL_CALLS; c++) {
        system_rates(&k->r, 5, k->y[0], k->work.slope[0]);
        dop853_step(&k->work, system_rates, &k->r, MOTION, 5 + c * h, h, k->y[0], raw);
        keep(raw, k->y[0]);
    }
}

static void kernel_rattle2_step(void *memory) {
    kernel *k = memory;
    const rattle rule = system_problem(&k->r).rule;
    const coordinates rate = coordinates_load(k->y[1] + COORDINATES);
    rattle_state s;

    s.x = coordinates_load(k->y[1]);
    s.velocity = rate.rho;
    s.omega = onto(&s.x.q, triad_angular_velocity(&s.x.q, &rate.q));
    rattle_begin(&rule, 5, &s);
    for (int c = 0; c < KERNEL_CALLS; c++) {
        k->out[0] = rattle_compose(&rule, 0, 5 + c * kernel_step_length, kernel_step_length, &s);
    }
    coordinates_store(&s.x, k->rate[1]);
}

static void program(void *memory) {
    kernel *k = memory;

    for (int c = 0; c < KERNEL_CALLS; c++) wanted_evaluate(&k->r, 5 + c * 0.01, &k->r.now);
}

static void divide(void *memory) {
    kernel *k = memory;

    for (int c = 0; c < KERNEL_CALLS; c++) {
        for (int i = 0; i < 8; i++) k->out[i] = k->bits[(c + i) % 8] / k->bits[i];
        __asm__ volatile("" ::: "memory");
    }
}

static void root(void *memory) {
    kernel *k = memory;

    for (int c = 0; c < KERNEL_CALLS; c++) {
        for (int i = 0; i < 8; i++) k->out[i] = number_root(k->bits[i]);
        __asm__ volatile("" ::: "memory");
    }
}

#define KERNEL_WIDTH                                                                               \
    {                                                                                              \
        NUMBER_WIDTH, sizeof(kernel), begin, right_hand_side, inverse_dynamics, kernel_rk4_step,   \
            kernel_dop853_step, kernel_rattle2_step, program, divide, root, round_trip             \
    }
