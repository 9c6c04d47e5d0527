/* Moves in the study's units: when they begin and end, and what limits those whose durations were found. */
#include "cli/check/check_moves.h"

#include <math.h>
#include <stdio.h>

#include "gough/dynamics.h"

#include "cli/common/scale.h"

static const char *const words[GOUGH_MOVE_LIMITS] = {
    [GOUGH_MOVE_SPEED] = "its own speed",
    [GOUGH_MOVE_ACCELERATION] = "its own acceleration",
    [GOUGH_MOVE_ANGULAR_SPEED] = "its own angular speed",
    [GOUGH_MOVE_ANGULAR_ACCELERATION] = "its own angular acceleration",
    [GOUGH_MOVE_LEG_SPEED] = "the speed",
    [GOUGH_MOVE_LEG_ACCELERATION] = "the acceleration",
    [GOUGH_MOVE_LEG_FORCE] = "the force",
    [GOUGH_MOVE_PLATFORM_SPEED] = "the platform's velocity",
    [GOUGH_MOVE_PLATFORM_ACCELERATION] = "the platform's acceleration"};

static const char *const keys[GOUGH_MOVE_LIMITS] = {
    [GOUGH_MOVE_SPEED] = "speed",
    [GOUGH_MOVE_ACCELERATION] = "acceleration",
    [GOUGH_MOVE_ANGULAR_SPEED] = "angular_speed",
    [GOUGH_MOVE_ANGULAR_ACCELERATION] = "angular_acceleration",
    [GOUGH_MOVE_LEG_SPEED] = "leg_speed",
    [GOUGH_MOVE_LEG_ACCELERATION] = "leg_acceleration",
    [GOUGH_MOVE_LEG_FORCE] = "leg_force",
    [GOUGH_MOVE_PLATFORM_SPEED] = "platform_speed",
    [GOUGH_MOVE_PLATFORM_ACCELERATION] = "platform_acceleration"};

static bool is_of_leg(const gough_move_fit *fit) {
    return fit->limit >= GOUGH_MOVE_LEG_SPEED && fit->limit <= GOUGH_MOVE_LEG_FORCE;
}

/* whether the duration of a move was found from limits, with what binds */
static bool find(const gough_study *study, size_t i, gough_move_fit *fit) {
    const gough_motion *motion = &study->model->motion;
    const gough_move *move = &motion->move[i];
    const bool found = move->least || move->speed > 0 || move->acceleration > 0 ||
                       move->angular_speed > 0 || move->angular_acceleration > 0;
    return found &&
           gough_move_find(&study->model->machine, motion, i, fit, sizeof *fit, NULL) == GOUGH_OK;
}

static size_t moves_of(const gough_study *study) {
    const gough_motion *motion = &study->model->motion;
    return motion->kind == GOUGH_MOTION_MOVES ? motion->moves : 0;
}

/* of the motion as it runs */
static double own_time(const gough_study *study, double time) {
    const gough_motion *motion = &study->model->motion;
    return gough_unit_factor(&study->units, GOUGH_UNIT_TIME) * time /
           (motion->scaled ? motion->frequency : 1);
}

void moves_print(FILE *stream, const gough_study *study, const gough_units *units) {
    const char *unit = unit_word(units, GOUGH_UNIT_TIME);
    for (size_t i = 0; i < moves_of(study); i++) {
        const gough_move *move = &study->model->motion.move[i];
        gough_move_fit fit;
        char label[32];
        if (!find(study, i, &fit)) continue;
        snprintf(label, sizeof label, "move %zu", i + 1);
        fprintf(stream, "  %-20s from %.6g to %.6g%s, limited by %s", label,
                own_time(study, move->start), own_time(study, move->start + move->duration), unit,
                words[fit.limit]);
        if (is_of_leg(&fit))
            fprintf(stream, " of leg %d", fit.which + 1);
        else if (fit.which >= 0)
            fprintf(stream, " in %s", gough_component_name(fit.which));
        fprintf(stream, ", at t = %.6g%s\n",
                gough_unit_factor(&study->units, GOUGH_UNIT_TIME) * fit.time, unit);
    }
}

json_t *moves_array(const gough_study *study) {
    if (moves_of(study) == 0) return NULL;
    json_t *array = json_array();
    for (size_t i = 0; i < moves_of(study); i++) {
        const gough_move *move = &study->model->motion.move[i];
        gough_move_fit fit = {.time = NAN};
        const bool found = find(study, i, &fit), leg = found && is_of_leg(&fit);
        json_t *one = json_object();
        json_object_set_new(one, "start", json_number(own_time(study, move->start)));
        json_object_set_new(one, "end", json_number(own_time(study, move->start + move->duration)));
        json_object_set_new(one, "limit", found ? json_string(keys[fit.limit]) : json_null());
        json_object_set_new(one, "leg", leg ? json_integer(fit.which + 1) : json_null());
        json_object_set_new(one, "component",
                            found && !leg && fit.which >= 0
                                ? json_string(gough_component_name(fit.which))
                                : json_null());
        json_object_set_new(
            one, "time", json_number(gough_unit_factor(&study->units, GOUGH_UNIT_TIME) * fit.time));
        json_array_append_new(array, one);
    }
    return array;
}
