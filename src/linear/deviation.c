/* The numbers of a deviation of a loop, by their names, and the loop at rest as a matrix of them: of rates if the controller is
 * continuous, from sample to sample if it is sampled. Theory: docs/theory/stability.md, docs/theory/loop.md. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/quantity.h"
#include "linear/linear.h"
#include "linear/sampled.h"

static bool is_sampled(const gough_model *model) { return model->control.sampling.period > 0; }

/* commands of each leg that wait, 0 if there may not be so many */
static size_t waiting_of(const gough_model *model) {
    const gough_sampling *s = &model->control.sampling;

    return sampled_delay_fits(s->period, s->delay) ? (size_t)sampled_waiting(s->period, s->delay)
                                                   : 0;
}

/* the places of the memory that is used, in the order of a deviation; returns how many */
static size_t memory_of(const gough_model *model, int place[SAMPLED_MEMORY]) {
    sampled_law law;
    size_t count = 0;

    sampled_law_of(&model->control, &law);
    for (int m = 0; m < SAMPLED_MEMORY; m++)
        if (law.used[m]) place[count++] = m;
    return count;
}

/* of a loop in continuous time those of drives and integrals, of a sampled one those of drives */
static size_t states_of(const gough_model *model, int kept[LINEAR_BEYOND]) {
    gough_control control = model->control;

    if (is_sampled(model)) memset(control.integral, 0, sizeof control.integral);
    return GOUGH_LINEAR + (size_t)linear_beyond(&model->machine, &control, kept);
}

size_t gough_deviation_size(const gough_model *model) {
    int kept[LINEAR_BEYOND], place[SAMPLED_MEMORY];
    size_t size = states_of(model, kept);

    if (is_sampled(model)) size += memory_of(model, place) + GOUGH_LEGS * waiting_of(model);
    return size;
}

/* "drive1" and the like, of a place among the states beyond those of the platform */
static void name_state(const gough_model *model, int place, char name[GOUGH_DEVIATION_NAME],
                       gough_unit *unit) {
    const gough_actuators *a = &model->machine.platform.actuators;
    const int orders = a->kind != GOUGH_ACTUATOR_LAG ? 0 : a->time_constant[0] > 0 ? 1 : 2;
    const int kind = place / GOUGH_LEGS;
    const char *word = kind == orders ? "i" : kind == 0 ? "f" : "fdot";

    *unit = kind == 1 && orders == 2 ? GOUGH_UNIT_FORCE_RATE : GOUGH_UNIT_FORCE;
    snprintf(name, GOUGH_DEVIATION_NAME, "%s%d", word, place % GOUGH_LEGS + 1);
}

static void name_memory(int place, char name[GOUGH_DEVIATION_NAME], gough_unit *unit) {
    static const char *const word[3] = {"e", "edot", "i"};
    static const gough_unit units[3] = {GOUGH_UNIT_LENGTH, GOUGH_UNIT_SPEED, GOUGH_UNIT_FORCE};

    *unit = units[place / GOUGH_LEGS];
    snprintf(name, GOUGH_DEVIATION_NAME, "%s%d", word[place / GOUGH_LEGS], place % GOUGH_LEGS + 1);
}

bool gough_deviation_name(const gough_model *model, size_t index, char name[GOUGH_DEVIATION_NAME],
                          gough_unit *unit) {
    static const char *const platform[GOUGH_LINEAR] = {"x",  "y",  "z",  "rx", "ry", "rz",
                                                       "vx", "vy", "vz", "wx", "wy", "wz"};
    static const gough_unit units[4] = {GOUGH_UNIT_LENGTH, GOUGH_UNIT_NONE, GOUGH_UNIT_SPEED,
                                        GOUGH_UNIT_RATE};
    int kept[LINEAR_BEYOND], place[SAMPLED_MEMORY];
    const size_t states = states_of(model, kept), size = gough_deviation_size(model);
    const size_t memory = is_sampled(model) ? memory_of(model, place) : 0;

    if (index >= size) return false;
    if (index < GOUGH_LINEAR) {
        snprintf(name, GOUGH_DEVIATION_NAME, "%s", platform[index]);
        *unit = units[index / 3];
    } else if (index < states) {
        name_state(model, kept[index - GOUGH_LINEAR], name, unit);
    } else if (index < states + memory) {
        name_memory(place[index - states], name, unit);
    } else {
        const size_t command = index - states - memory;
        snprintf(name, GOUGH_DEVIATION_NAME, "u%d_%d", (int)(command % GOUGH_LEGS) + 1,
                 (int)(command / GOUGH_LEGS) % (SAMPLED_WAITING + 1) + 1);
        *unit = GOUGH_UNIT_FORCE;
    }
    return true;
}

/* ---- the matrix ---- */

static gough_status check_size(const gough_model *model, size_t size, gough_error *error) {
    if (size == gough_deviation_size(model)) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT, "the matrix of the loop has %zu rows, not %zu",
                      gough_deviation_size(model), size);
}

static gough_status of_rates(const gough_model *model, const double component[GOUGH_COMPONENTS],
                             double *matrix, gough_error *error) {
    int kept[LINEAR_BEYOND];
    gough_control control;
    gough_motion motion;
    gough_state state;
    linear_matrix found;
    gough_status status = linear_at_rest(model, component, &motion, &control, &state, error);
    const linear_loop loop = {.machine = &model->machine, .motion = &motion, .control = &control};

    if (status != GOUGH_OK) return status;
    const char *wrong = linear_complex.matrix(&loop, 0, NULL, found);
    status = linear_check(&loop, 0, NULL, found, wrong, error);
    const int size = GOUGH_LINEAR + linear_beyond(&model->machine, &control, kept);
    if (size == GOUGH_LINEAR)
        memcpy(matrix, found, sizeof found);
    else if (status == GOUGH_OK)
        linear_complex.whole(&loop, 0, NULL, kept, size, matrix);
    return status;
}

static gough_status of_samples(const gough_model *model, const double component[GOUGH_COMPONENTS],
                               double *matrix, gough_error *error) {
    gough_control control;
    gough_state state;
    sampled_plant plant;
    sampled_step step;
    sampled_law law;
    sampled_map map;
    const gough_status status = sampled_rest_of(model, component, &plant, &control, &state, error);

    if (status != GOUGH_OK) return status;
    sampled_law_of(&control, &law);
    if (!sampled_step_of(&plant, control.sampling.period, control.sampling.delay, &step))
        return gough_fail_key(error, GOUGH_ERROR_NUMERICAL, "control.sampling.period",
                              "a deviation grows beyond all numbers within a period of %.9g" IN_TIME
                              "; use a shorter one",
                              control.sampling.period);
    sampled_map_of(&plant, &step, &law, &map);
    memcpy(matrix, map.matrix, (size_t)(map.n * map.n) * sizeof *matrix);
    return GOUGH_OK;
}

gough_status gough_matrix_at_rest(const gough_model *model,
                                  const double component[GOUGH_COMPONENTS], size_t size,
                                  double *matrix, gough_error *error) {
    gough_status status = gough_control_check(&model->control, error);

    if (status == GOUGH_OK && is_sampled(model))
        status = sampled_check(&model->control.sampling, error);
    if (status == GOUGH_OK) status = check_size(model, size, error);
    if (status != GOUGH_OK) return status;
    return is_sampled(model) ? of_samples(model, component, matrix, error)
                             : of_rates(model, component, matrix, error);
}
