/* What a valid study says that is probably not meant: home or start beyond the legs' limits, a program that starts away from home
 * or moving, that exceeds limits or becomes singular on the way, rows too far apart for it. */
#include "cli/check/check_warnings.h"
#include "cli/common/scale.h"

#include <math.h>
#include <string.h>

#include "cli/common/talk.h"
#include "cli/run/limits_used.h"
#include "cli/run/loop_warnings.h"

/* displacements smaller than this, in base radii and radians, and rates that would not make more than SLOW over the run, are those
 * of decimals that were rounded */
static const double NOTHING = 1e-9, SLOW = 1e-4;

typedef struct warning {
    const char *verb;
    const gough_study *study;
    const gough_units *unit;
} warning;

#define WARN(w, ...) remark((w)->verb, "warning: " __VA_ARGS__)

/* "leg 2", "legs 1, 3 and 5", "all six legs" */
static const char *names_of(const bool leg[GOUGH_LEGS], char text[64]) {
    int count = 0, named = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) count += leg[v];
    if (count == GOUGH_LEGS) return "all six legs";
    strcpy(text, count > 1 ? "legs" : "leg");
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!leg[v]) continue;
        const size_t used = strlen(text);
        named++;
        snprintf(text + used, 64 - used, "%s%d",
                 named == 1       ? " "
                 : named == count ? " and "
                                  : ", ",
                 v + 1);
    }
    return text;
}

/* legs that are too short or too long at home, each kind with the one that is furthest beyond */
static void warn_home(const warning *w) {
    const gough_model *model = w->study->model;
    const gough_limits l = gough_limits_of(&model->machine, &model->motion);
    for (int kind = 0; kind < 2; kind++) {
        bool beyond[GOUGH_LEGS];
        int worst = -1;
        char text[64];
        for (int v = 0; v < GOUGH_LEGS; v++) {
            const double sign = kind ? 1 : -1, *home = model->machine.home_length;
            const double excess = sign * (home[v] - l.length[v][kind]);
            beyond[v] = excess > 0;
            if (beyond[v] && (worst < 0 || excess > sign * (home[worst] - l.length[worst][kind])))
                worst = v;
        }
        if (worst < 0) continue;
        WARN(w, "home is outside the limits: %s, length %.6g%s, %s length %.6g%s",
             names_of(beyond, text),
             in_units(w->unit, GOUGH_UNIT_LENGTH, model->machine.home_length[worst]),
             unit_word(w->unit, GOUGH_UNIT_LENGTH), kind ? "greatest" : "least",
             in_units(w->unit, GOUGH_UNIT_LENGTH, l.length[worst][kind]),
             unit_word(w->unit, GOUGH_UNIT_LENGTH));
    }
}

/* the components of the program that are not 0 at t = 0, or do not begin at rest */
static void warn_start(const warning *w) {
    static const char *const where[2] = {"starts away from home", "does not start from rest"};
    const gough_model *model = w->study->model;
    const double radius = model->machine.base_radius;
    double component[GOUGH_COMPONENTS][3];
    gough_motion_evaluate(&model->motion, 0, component);
    for (int order = 0; order < 2; order++) {
        char text[300] = "";
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const bool turns = c >= GOUGH_ROLL;
            const double value = component[c][order];
            const double scale = order ? SLOW / NOTHING / w->study->simulation.duration : 1;
            if (!(fabs(value) > NOTHING * scale * (turns ? 1 : radius))) continue;
            const size_t used = strlen(text);
            const gough_unit unit = turns   ? order ? GOUGH_UNIT_ANGULAR_SPEED : GOUGH_UNIT_ANGLE
                                    : order ? GOUGH_UNIT_SPEED
                                            : GOUGH_UNIT_LENGTH;
            snprintf(text + used, sizeof text - used, "%s%s %.6g%s%s", used ? ", " : "",
                     gough_component_name(c), in_units(w->unit, unit, value),
                     unit_word(w->unit, unit),
                     turns && order && w->unit->dimensionless ? " per unit of time" : "");
        }
        if (*text) WARN(w, "the program %s: %s at t = 0", where[order], text);
    }
}

static void say_end(const warning *w, gough_end *end, const char *what) {
    const gough_end_words words = limit_words(w->unit);
    end_scale(end, w->unit);
    gough_end_say(end, &words);
    WARN(w, "%s: %s", what, end->message);
}

/* limits and singular poses on the way; and at once, where the run of simulate starts */
static void warn_way(const warning *w) {
    const gough_model *model = w->study->model;
    gough_simulation s = w->study->simulation;
    gough_end end;
    s.precision = GOUGH_DOUBLE;
    if (gough_forces(model, &s, NULL, NULL, NULL, NULL, &end, NULL) == GOUGH_ERROR_NUMERICAL)
        say_end(w, &end, "along the program");

    /* the instant at which a run begins: a millionth of a millionth of a row */
    s = gough_simulation_default();
    s.output_step = w->study->simulation.output_step;
    s.duration = 1e-12 * s.output_step;
    s.constraints = w->study->simulation.constraints;
    memcpy(s.baumgarte, w->study->simulation.baumgarte, sizeof s.baumgarte);
    if (gough_simulate(model, &s, NULL, NULL, &end, NULL) == GOUGH_ERROR_NUMERICAL &&
        !(end.time > 0) && (end.legs || end.component || end.cause == GOUGH_END_SINGULAR))
        say_end(w, &end, "a run of gough simulate ends at once");
}

static void warn_rows(const warning *w) {
    const gough_simulation *s = &w->study->simulation;
    const gough_motion *motion = &w->study->model->motion;
    size_t missed = 0;
    double shortest = INFINITY;
    if (s->output_step > s->duration * (1 + NOTHING))
        WARN(w,
             "simulation.output_step %.6g%s is longer than the duration %.6g%s: a table has one "
             "row, at t = 0",
             in_units(w->unit, GOUGH_UNIT_TIME, s->output_step),
             unit_word(w->unit, GOUGH_UNIT_TIME), in_units(w->unit, GOUGH_UNIT_TIME, s->duration),
             unit_word(w->unit, GOUGH_UNIT_TIME));
    if (motion->kind != GOUGH_MOTION_MOVES) return;
    const double pace = motion->scaled ? motion->frequency : 1;
    for (size_t i = 0; i < motion->moves; i++) {
        const double duration = motion->move[i].duration / pace;
        shortest = fmin(shortest, duration);
        missed += duration < s->output_step;
    }
    if (missed)
        WARN(w,
             "simulation.output_step %.6g%s is longer than %zu of the moves, the shortest of "
             "%.6g%s: "
             "rows do not show them",
             in_units(w->unit, GOUGH_UNIT_TIME, s->output_step),
             unit_word(w->unit, GOUGH_UNIT_TIME), missed,
             in_units(w->unit, GOUGH_UNIT_TIME, shortest), unit_word(w->unit, GOUGH_UNIT_TIME));
}

/* Lengths in mm with gravity in mm/s^2 give wrong forces of 1000 times the size wherever the masses are in kg. */
static void warn_units(const warning *w) {
    const double gravity =
        in_units(w->unit, GOUGH_UNIT_ACCELERATION, w->study->model->machine.gravity_magnitude);
    if (w->unit->dimensionless || w->unit->name[GOUGH_BASE_LENGTH] != 0 || !(gravity > 100)) return;
    WARN(w,
         "gravity is %.6g%s, which is ten times that of the earth or more: if the study's lengths "
         "are in mm, say so with `units: {length: mm}`",
         gravity, unit_word(w->unit, GOUGH_UNIT_ACCELERATION));
}

void check_warnings(const char *verb, const gough_study *study, const gough_units *unit) {
    const warning w = {verb, study, unit};
    warn_units(&w);
    warn_home(&w);
    warn_start(&w);
    warn_way(&w);
    warn_rows(&w);
    loop_warnings(verb, study);
}
