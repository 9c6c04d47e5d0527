/* Fleets: the bits of a plant that gough_step() moves, whatever stands beside it; ends, loads of their own, refusals. */
#include <stdio.h>

#include "gough/fleet.h"
#include "support/machines.h"
#include "support/suite.h"

enum { PLANTS = 37, STEPS = 40 }; /* fills no width evenly */

typedef struct {
    gough_machine machine;
    double command[PLANTS][6], wrench[PLANTS][6];
    gough_state state[PLANTS];
    double length[PLANTS][6], rate[PLANTS][6];
    unsigned char ended[PLANTS];
    gough_simulation options;
} fixture;

static fixture *begin(void) {
    fixture *f = calloc(1, sizeof *f);
    skew_machine(&f->machine);
    f->options = gough_simulation_default();
    f->options.method = GOUGH_RK4;
    f->options.step = 0.01;
    f->options.output_step = 0.01;
    return f;
}

static void *fleet_of(fixture *f, const gough_machine *const *machine, size_t count) {
    void *fleet = aligned_alloc(64, gough_fleet_size(count));
    gough_error error = {0};
    ck_assert_msg(gough_fleet_begin(fleet, machine, count, &f->options, &error) == GOUGH_OK, "%s",
                  error.message);
    return fleet;
}

static void *fleet_alike(fixture *f, size_t count) {
    const gough_machine *machine[PLANTS];
    for (size_t i = 0; i < count; i++) machine[i] = &f->machine;
    return fleet_of(f, machine, count);
}

/* commands about those that hold the machine at home */
static void draw_commands(fixture *f, dice *d) {
    const gough_state home = gough_state_home(&f->machine);
    const gough_acceleration none = {.linear = {0, 0, 0}};
    double force[6];
    ck_assert(gough_inverse_dynamics(&f->machine, &home, &none, NULL, force, NULL) == GOUGH_OK);
    for (int i = 0; i < PLANTS; i++) {
        for (int v = 0; v < 6; v++) {
            f->command[i][v] = force[v] * dice_between(d, 0.7, 1.3);
            f->wrench[i][v] = dice_between(d, -0.05, 0.05);
        }
    }
}

static void move(fixture *f, void *fleet, long long steps, const double *wrench, int threads) {
    ck_assert(gough_fleet_move(fleet, steps, f->command[0], wrench, threads, f->state, f->length[0],
                               f->rate[0], f->ended, NULL) == GOUGH_OK);
}

/* one plant by gough_step(), with constant formulas in place of the wrench */
static void *plant_alone(fixture *f, gough_model *model, const double *wrench) {
    void *plant = aligned_alloc(64, gough_plant_size());
    gough_error error = {0};
    model->machine = f->machine;
    for (int c = 0; c < 3 && wrench; c++) {
        model->disturbance.force[c] = gough_formula_constant(wrench[c]);
        model->disturbance.moment[c] = gough_formula_constant(wrench[3 + c]);
    }
    ck_assert_msg(gough_plant_begin(plant, model, &f->options, NULL, NULL, &error) == GOUGH_OK,
                  "%s", error.message);
    return plant;
}

static void compare_with_plants(fixture *f, int loaded, int heavy) {
    dice d = {7};
    if (heavy) give_legs(&f->machine, LEGS_HEAVY | LEGS_VISCOUS, &d);
    void *fleet = fleet_alike(f, PLANTS);
    gough_model *model = calloc(PLANTS, sizeof *model);
    void *plant[PLANTS];
    draw_commands(f, &d);
    for (int i = 0; i < PLANTS; i++)
        plant[i] = plant_alone(f, &model[i], loaded ? f->wrench[i] : NULL);
    for (int k = 0; k < STEPS; k++) {
        move(f, fleet, 1, loaded ? f->wrench[0] : NULL, 2);
        for (int i = 0; i < PLANTS; i++) {
            gough_row row;
            ck_assert(gough_step(plant[i], f->command[i], &row, NULL, NULL) == GOUGH_OK);
            ck_assert_uint_eq(f->ended[i], GOUGH_FLEET_MOVES);
            ck_assert_mem_eq(f->length[i], row.value + GOUGH_L, sizeof f->length[i]);
            ck_assert_mem_eq(f->rate[i], row.value + GOUGH_DL, sizeof f->rate[i]);
            ck_assert_mem_eq(f->state[i].position, row.value + GOUGH_X, 3 * sizeof(double));
            ck_assert_mem_eq(f->state[i].velocity, row.value + GOUGH_VX, 3 * sizeof(double));
            ck_assert_mem_eq(f->state[i].angular_velocity, row.value + GOUGH_WX,
                             3 * sizeof(double));
        }
        draw_commands(f, &d); /* wrenches of plants alone stay as they began */
        for (int i = 0; i < PLANTS && loaded; i++) {
            for (int c = 0; c < 3; c++) {
                double jet[3];
                gough_formula_evaluate(&model[i].disturbance.force[c], 0, jet);
                f->wrench[i][c] = jet[0];
                gough_formula_evaluate(&model[i].disturbance.moment[c], 0, jet);
                f->wrench[i][3 + c] = jet[0];
            }
        }
    }
    for (int i = 0; i < PLANTS; i++) free(plant[i]);
    free(model);
    free(fleet);
}

START_TEST(moves_as_plants_alone) {
    fixture *f = begin();
    compare_with_plants(f, 0, 0);
    free(f);
}
END_TEST

START_TEST(moves_as_plants_alone_under_wrenches) {
    fixture *f = begin();
    compare_with_plants(f, 1, 0);
    free(f);
}
END_TEST

START_TEST(moves_as_plants_alone_with_heavy_legs) {
    fixture *f = begin();
    compare_with_plants(f, 1, 1);
    free(f);
}
END_TEST

/* many steps of one call are calls of one step; a plant does not depend on those beside it, nor on threads */
START_TEST(does_not_depend_on_company) {
    fixture *f = begin(), *g = begin();
    dice d = {11};
    void *many = fleet_alike(f, PLANTS), *one = fleet_alike(g, 1);
    draw_commands(f, &d);
    move(f, many, STEPS, NULL, 3);
    for (int i = 0; i < PLANTS; i += 5) {
        const gough_state home = gough_state_home(&g->machine);
        ck_assert(gough_fleet_put(one, 0, NULL, &home, NULL) == GOUGH_OK);
        memcpy(g->command[0], f->command[i], sizeof g->command[0]);
        for (int k = 0; k < STEPS; k++) move(g, one, 1, NULL, 1);
        ck_assert_mem_eq(&g->state[0], &f->state[i], sizeof g->state[0]);
    }
    free(many);
    free(one);
    free(f);
    free(g);
}
END_TEST

/* without forces of the legs the centre of mass falls by g t²/2, and the angular momentum stays */
START_TEST(falls_freely_with_a_load_of_its_own) {
    fixture *f = begin();
    gough_machine *other = calloc(1, sizeof *other);
    const gough_load load = {.mass = 2.5,
                             .center_of_mass = {0.2, 0.1, 0.3},
                             .inertia = {{0.4, 0, 0}, {0, 0.3, 0}, {0, 0, 0.5}}};
    void *fleet = fleet_alike(f, PLANTS);
    gough_state start = gough_state_home(&f->machine);
    ck_assert(gough_machine_init(other, &f->machine.platform, &load, f->machine.gravity, NULL) ==
              GOUGH_OK);
    start.velocity[0] = 0.3;
    ck_assert(gough_fleet_put(fleet, 20, other, &start, NULL) == GOUGH_OK);
    move(f, fleet, 20, NULL, 1);
    const double t = 20 * f->options.step;
    for (int c = 0; c < 3; c++) {
        const double moved = start.velocity[c] * t + other->gravity[c] * t * t / 2;
        ck_assert(fabs(f->state[20].position[c] - start.position[c] - moved) < 1e-14);
        ck_assert(fabs(f->state[20].velocity[c] - start.velocity[c] - other->gravity[c] * t) <
                  1e-14);
    }
    /* under the same commands a heavier load moves less than the others */
    for (int i = 0; i < PLANTS; i++)
        for (int v = 0; v < 6; v++) f->command[i][v] = 1;
    ck_assert(gough_fleet_put(fleet, 20, NULL, &start, NULL) == GOUGH_OK);
    start.velocity[0] = 0;
    for (size_t i = 0; i < PLANTS; i++)
        if (i != 20) ck_assert(gough_fleet_put(fleet, i, NULL, &start, NULL) == GOUGH_OK);
    move(f, fleet, 1, NULL, 1);
    ck_assert(f->state[20].velocity[2] < f->state[19].velocity[2]);
    ck_assert_mem_eq(&f->state[19], &f->state[21], sizeof f->state[19]);
    free(other);
    free(fleet);
    free(f);
}
END_TEST

START_TEST(ends_and_begins_again) {
    fixture *f = begin();
    gough_platform p = f->machine.platform;
    const gough_load load = f->machine.load;
    const double gravity[3] = {f->machine.gravity[0], f->machine.gravity[1], f->machine.gravity[2]};
    p.length_min = 0.99 * f->machine.home_length[0];
    ck_assert(gough_machine_init(&f->machine, &p, &load, gravity, NULL) == GOUGH_OK);
    void *fleet = fleet_alike(f, PLANTS);
    const gough_state home = gough_state_home(&f->machine);
    gough_state at[PLANTS];
    dice d = {3};
    draw_commands(f, &d);
    for (int v = 0; v < 6; v++) f->command[5][v] = 0;
    for (int v = 0; v < 6; v++) f->command[6][v] = NAN;
    move(f, fleet, 60, NULL, 1);
    ck_assert_uint_eq(f->ended[5], GOUGH_FLEET_LIMIT);
    ck_assert_uint_eq(f->ended[6], GOUGH_FLEET_NOT_FINITE);
    double least = INFINITY;
    for (int v = 0; v < 6; v++) least = fmin(least, f->length[5][v]);
    ck_assert(least < p.length_min && least > 0.97 * f->machine.home_length[0]);
    memcpy(at, f->state, sizeof at);
    move(f, fleet, 5, NULL, 1);
    ck_assert_mem_eq(&at[5], &f->state[5], sizeof at[5]);
    ck_assert(gough_fleet_put(fleet, 5, NULL, &home, NULL) == GOUGH_OK);
    move(f, fleet, 1, NULL, 1);
    ck_assert_uint_eq(f->ended[5], GOUGH_FLEET_MOVES);
    ck_assert(f->state[5].velocity[2] < 0);
    free(fleet);
    free(f);
}
END_TEST

/* a drive of first order reaches 1 − 1/e of a new command after its time constant */
START_TEST(drives_lag) {
    fixture *f = begin();
    gough_platform p = f->machine.platform;
    const gough_load load = {.mass = 1e6, .inertia = {{1e6, 0, 0}, {0, 1e6, 0}, {0, 0, 1e6}}};
    const double none[3] = {0, 0, 0};
    p.actuators.kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < 6; v++) p.actuators.time_constant[v] = 0.2;
    ck_assert(gough_machine_init(&f->machine, &p, &load, none, NULL) == GOUGH_OK);
    void *fleet = fleet_alike(f, PLANTS);
    move(f, fleet, 1, NULL, 1); /* commands of 0 */
    for (int v = 0; v < 6; v++) f->command[9][v] = 100;
    move(f, fleet, 20, NULL, 1);
    const double lagging = f->state[9].velocity[2];
    const gough_state home = gough_state_home(&f->machine);
    ck_assert(gough_fleet_put(fleet, 9, NULL, &home, NULL) == GOUGH_OK);
    move(f, fleet, 20, NULL, 1); /* begins with the command */
    const double ideal = f->state[9].velocity[2];
    /* over T: ∫(1 − e^{−t/T}) dt = T/e */
    ck_assert(fabs(lagging / ideal - exp(-1)) < 1e-6);
    free(fleet);
    free(f);
}
END_TEST

START_TEST(refuses_what_it_cannot_move) {
    fixture *f = begin();
    gough_machine other = f->machine;
    const gough_machine *machine[2] = {&f->machine, &other};
    gough_error error;
    void *fleet = aligned_alloc(64, gough_fleet_size(2));
    f->options.step = 0;
    ck_assert(gough_fleet_begin(fleet, machine, 2, &f->options, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "simulation.step"));
    f->options.step = NAN;
    ck_assert(gough_fleet_begin(fleet, machine, 2, &f->options, NULL) == GOUGH_ERROR_INPUT);
    f->options.step = INFINITY;
    ck_assert(gough_fleet_begin(fleet, machine, 2, &f->options, NULL) == GOUGH_ERROR_INPUT);
    f->options.step = 0.01;
    f->options.method = GOUGH_RATTLE4;
    ck_assert(gough_fleet_begin(fleet, machine, 2, &f->options, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "rk4 or dop853"));
    f->options.method = GOUGH_DOP853;
    other.platform.height *= 2;
    ck_assert(gough_fleet_begin(fleet, machine, 2, &f->options, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "plant 1"));
    other = f->machine;
    other.externals = 1;
    ck_assert(gough_fleet_begin(fleet, machine, 2, &f->options, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "external loads"));
    other = f->machine;
    ck_assert(gough_fleet_begin(fleet, machine, 2, &f->options, &error) == GOUGH_OK);
    gough_state state = gough_state_home(&f->machine);
    ck_assert(gough_fleet_put(fleet, 2, NULL, &state, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "has 2"));
    state.rotation[0][0] = 2;
    ck_assert(gough_fleet_put(fleet, 1, NULL, &state, &error) == GOUGH_ERROR_INPUT);
    ck_assert(gough_fleet_move(fleet, 0, f->command[0], NULL, 1, NULL, NULL, NULL, NULL, &error) ==
              GOUGH_ERROR_INPUT);
    ck_assert(gough_fleet_move(fleet, 3, f->command[0], NULL, 1, NULL, NULL, NULL, NULL, &error) ==
              GOUGH_OK);
    free(fleet);
    free(f);
}
END_TEST

START_TEST(a_fleet_may_have_no_plants) {
    fixture *f = begin();
    gough_error error = {.message = ""};
    gough_state state = gough_state_home(&f->machine);
    void *fleet = aligned_alloc(64, gough_fleet_size(0));
    ck_assert_msg(gough_fleet_begin(fleet, NULL, 0, &f->options, &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert(gough_fleet_move(fleet, 3, NULL, NULL, 2, NULL, NULL, NULL, NULL, &error) ==
              GOUGH_OK);
    ck_assert(gough_fleet_put(fleet, 0, NULL, &state, &error) == GOUGH_ERROR_INPUT);
    free(fleet);
    free(f);
}
END_TEST

int main(void) {
    return SUITE_RUN("fleet", 60, moves_as_plants_alone, moves_as_plants_alone_under_wrenches,
                     moves_as_plants_alone_with_heavy_legs, does_not_depend_on_company,
                     falls_freely_with_a_load_of_its_own, ends_and_begins_again, drives_lag,
                     refuses_what_it_cannot_move, a_fleet_may_have_no_plants);
}
