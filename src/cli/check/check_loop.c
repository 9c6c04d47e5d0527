/* The parts of a study's loop besides stiffness and damping of single legs: matrices of gains, integral, samples, drives. */
#include "cli/check/check_loop.h"

#include <math.h>

#include "cli/common/json.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/study_fields.h"
#include "cli/common/talk.h"

static bool any(const double *value, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (fabs(value[i]) > 0) return true;
    return false;
}

/* ---- for reading ------------------------------------------------------------------------------------------------- */

const char *loop_matrix_words(const gough_control *control,
                              const double cross[GOUGH_LEGS][GOUGH_LEGS]) {
    const bool matrix = control->coupled && any(cross[0], (size_t)GOUGH_LEGS * GOUGH_LEGS);
    return matrix ? " on the diagonal of a 6x6 matrix" : "";
}

/* A key's value, six numbers as one if they are equal. */
static void print_key(const gough_study *study, const gough_units *unit, const char *path,
                      gough_unit of, const double value[GOUGH_LEGS]) {
    bool same = true;
    for (int v = 1; v < GOUGH_LEGS; v++) same = same && !(fabs(value[v] - value[0]) > 0);
    if (same)
        printf("%.6g%s", in_units(unit, of, value[0]), unit_word(unit, of));
    else
        print_field(stdout, study, path);
}

static void print_integral(const gough_study *study, const gough_units *unit) {
    const gough_control *c = &study->model->control;
    if (!any(c->integral, GOUGH_LEGS)) return;
    printf("  integral K_I         ");
    print_key(study, unit, "control.integral", GOUGH_UNIT_INTEGRAL_GAIN, c->integral);
    if (c->tracking_time > 0)
        printf(", tracking time %.6g%s", in_units(unit, GOUGH_UNIT_TIME, c->tracking_time),
               unit_word(unit, GOUGH_UNIT_TIME));
    printf("\n");
}

/* What a sampled controller measures, and when. */
static void print_measured(const gough_sampling *s, const gough_units *unit) {
    const char *length = unit_word(unit, GOUGH_UNIT_LENGTH),
               *time = unit_word(unit, GOUGH_UNIT_TIME);
    const bool differences = s->velocity == GOUGH_VELOCITY_DIFFERENCE;
    char cutoff[64] = "", counts[64] = "", noise[64] = "", jitter[64] = "", preview[80] = "";
    if (s->cutoff > 0)
        snprintf(cutoff, sizeof cutoff, " (cutoff %.6g%s)",
                 in_units(unit, GOUGH_UNIT_RATE, s->cutoff), unit_word(unit, GOUGH_UNIT_RATE));
    if (s->resolution > 0)
        snprintf(counts, sizeof counts, " in counts of %.6g%s",
                 in_units(unit, GOUGH_UNIT_LENGTH, s->resolution), length);
    if (s->noise > 0)
        snprintf(noise, sizeof noise, " with noise of %.6g%s RMS",
                 in_units(unit, GOUGH_UNIT_LENGTH, s->noise), length);
    if (s->jitter > 0)
        snprintf(jitter, sizeof jitter, "; up to %.6g%s of jitter",
                 in_units(unit, GOUGH_UNIT_TIME, s->jitter), time);
    if (s->preview > 0)
        snprintf(preview, sizeof preview, "; program forces of %.6g%s ahead",
                 in_units(unit, GOUGH_UNIT_TIME, s->preview), time);
    print_paragraph(stdout, "  measured             ", 23, "lengths%s%s, rates %s%s%s%s", counts,
                    noise, differences ? "from differences" : "exactly", cutoff, jitter, preview);
}

void print_loop(const gough_study *study, const gough_units *unit) {
    const gough_sampling *s = &study->model->control.sampling;
    print_integral(study, unit);
    if (s->period > 0) print_measured(s, unit);
}

/* "-80 to 80 N" of all drives, or of each */
static void print_forces(const double force[GOUGH_LEGS][2], const gough_units *unit) {
    const char *word = unit_word(unit, GOUGH_UNIT_FORCE);
    bool same = true;
    for (int v = 1; v < GOUGH_LEGS; v++)
        for (int i = 0; i < 2; i++) same = same && !(fabs(force[v][i] - force[0][i]) > 0);
    printf("  limits of commands   ");
    for (int v = 0; v < (same ? 1 : GOUGH_LEGS); v++) {
        if (v) printf(v == 3 ? ",\n                       " : ", ");
        if (!any(force[v], 2))
            printf("none");
        else
            printf("%.6g to %.6g%s", in_units(unit, GOUGH_UNIT_FORCE, force[v][0]),
                   in_units(unit, GOUGH_UNIT_FORCE, force[v][1]), word);
    }
    printf("\n");
}

void print_drives(const gough_study *study, const gough_units *unit) {
    const gough_actuators *a = &study->model->machine.platform.actuators;
    const bool limited = any(a->max_force[0], (size_t)2 * GOUGH_LEGS),
               lag = a->kind == GOUGH_ACTUATOR_LAG;
    if (!limited && !lag) return;
    printf("\nDrives\n");
    if (!lag) {
        printf("  force                the command at once\n");
    } else if (a->frequency[0] > 0) {
        printf("  lag, second order    natural frequency ");
        print_key(study, unit, "actuators.frequency", GOUGH_UNIT_RATE, a->frequency);
        printf(", damping ratio ");
        print_key(study, unit, "actuators.damping_ratio", GOUGH_UNIT_NONE, a->damping_ratio);
        printf("\n");
    } else {
        printf("  lag, first order     time constant ");
        print_key(study, unit, "actuators.time_constant", GOUGH_UNIT_TIME, a->time_constant);
        printf("\n");
    }
    if (limited) print_forces(a->max_force, unit);
    if (!any(a->max_rate, GOUGH_LEGS)) return;
    printf("  greatest force rate  ");
    print_key(study, unit, "actuators.max_rate", GOUGH_UNIT_FORCE_RATE, a->max_rate);
    printf("\n");
}

/* ---- JSON ----------------------------------------------------------------------------------------------------------- */

/* six numbers; null for those that are 0 if `none` */
static json_t *six(const gough_units *unit, gough_unit of, const double value[GOUGH_LEGS],
                   bool none) {
    json_t *array = json_array();
    for (int v = 0; v < GOUGH_LEGS; v++)
        json_array_append_new(array, none && !(value[v] > 0)
                                         ? json_null()
                                         : json_number(in_units(unit, of, value[v])));
    return array;
}

static json_t *gains(const gough_control *control, const gough_units *unit, gough_unit of,
                     const double diagonal[GOUGH_LEGS],
                     const double cross[GOUGH_LEGS][GOUGH_LEGS]) {
    if (!control->coupled) return six(unit, of, diagonal, false);
    json_t *rows = json_array();
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double row[GOUGH_LEGS];
        for (int w = 0; w < GOUGH_LEGS; w++) row[w] = v == w ? diagonal[v] : cross[v][w];
        json_array_append_new(rows, six(unit, of, row, false));
    }
    return rows;
}

json_t *control_object(const gough_study *study, const gough_units *unit) {
    const gough_control *c = &study->model->control;
    json_t *object = json_object();
    json_object_set_new(object, "law", json_string("leg"));
    json_object_set_new(object, "feedforward", json_boolean(c->feedforward));
    json_t *model = json_object();
    json_object_set_new(model, "legs", json_boolean(!c->ignores_legs));
    json_object_set_new(model, "friction", json_boolean(!c->ignores_friction));
    json_object_set_new(model, "external", json_boolean(!c->ignores_external));
    json_object_set_new(object, "model", model);
    json_object_set_new(object, "stiffness",
                        gains(c, unit, GOUGH_UNIT_STIFFNESS, c->stiffness, c->cross_stiffness));
    json_object_set_new(object, "damping",
                        gains(c, unit, GOUGH_UNIT_DAMPING, c->damping, c->cross_damping));
    json_object_set_new(object, "integral",
                        six(unit, GOUGH_UNIT_INTEGRAL_GAIN, c->integral, false));
    json_object_set_new(object, "tracking_time",
                        c->tracking_time > 0
                            ? json_number(in_units(unit, GOUGH_UNIT_TIME, c->tracking_time))
                            : json_null());
    json_object_set_new(object, "sampled", json_boolean(c->sampling.period > 0));
    return object;
}

json_t *drives_object(const gough_study *study, const gough_units *unit) {
    const gough_actuators *a = &study->model->machine.platform.actuators;
    json_t *object = json_object(), *forces = json_array();
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const two_numbers pair =
            two_in_units(unit, GOUGH_UNIT_FORCE, a->max_force[v][0], a->max_force[v][1]);
        json_array_append_new(forces,
                              any(a->max_force[v], 2) ? json_numbers(pair.value, 2) : json_null());
    }
    json_object_set_new(object, "kind", json_field(study, "actuators.kind"));
    json_object_set_new(object, "max_force", forces);
    json_object_set_new(object, "time_constant",
                        six(unit, GOUGH_UNIT_TIME, a->time_constant, true));
    json_object_set_new(object, "frequency", six(unit, GOUGH_UNIT_RATE, a->frequency, true));
    json_object_set_new(object, "damping_ratio",
                        six(unit, GOUGH_UNIT_NONE, a->damping_ratio, true));
    json_object_set_new(object, "max_rate", six(unit, GOUGH_UNIT_FORCE_RATE, a->max_rate, true));
    return object;
}
