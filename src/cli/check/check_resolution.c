/* The resolution of a pose for reading and as JSON, (pose-12): displacements of the point `motion.about` and rotations, along and
 * about the axes of the base, in the study's units. */
#include "cli/check/check_resolution.h"

#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/scale.h"

enum { PER_LENGTH, COUNT, LENGTH_ERROR, JOINTS, SOURCES };

/* What makes lengths wrong. */
typedef struct error_source {
    const char *json, *key; /* key of the study, or NULL */
    double leg[GOUGH_LEGS]; /* the greatest error of each leg's length */
} error_source;

static void fill_sources(const gough_model *model, const gough_units *unit,
                         error_source source[SOURCES]) {
    const gough_tolerances *t = &model->machine.platform.tolerances;
    const gough_sampling *s = &model->control.sampling;
    source[PER_LENGTH] = (error_source){.json = "per_length"};
    source[COUNT] = (error_source){.json = "count", .key = "control.sampling.resolution"};
    source[LENGTH_ERROR] = (error_source){.json = "length_error", .key = "pose.length_error"};
    source[JOINTS] = (error_source){.json = "joints", .key = "platform.joints.tolerance"};
    for (int v = 0; v < GOUGH_LEGS; v++) {
        source[PER_LENGTH].leg[v] = gough_unit_read(unit, GOUGH_UNIT_LENGTH, 1);
        source[COUNT].leg[v] = s->period > 0 ? s->resolution : 0;
        source[LENGTH_ERROR].leg[v] = t->length[v];
        source[JOINTS].leg[v] = 2 * t->joint[v];
    }
}

static double largest_of(const double *value, int count) {
    double most = 0;
    for (int i = 0; i < count; i++) most = fmax(most, fabs(value[i]));
    return most;
}

static double length_of(const gough_units *unit, double x) {
    return in_units(unit, GOUGH_UNIT_LENGTH, x);
}

static double angle_of(const gough_units *unit, double x) {
    return in_units(unit, GOUGH_UNIT_ANGLE, x);
}

/* "1, 2, 3", one number where all six are the same */
static void print_legs(FILE *stream, const gough_units *unit, const double leg[GOUGH_LEGS]) {
    bool same = true;
    for (int v = 1; v < GOUGH_LEGS; v++) same &= nearly_same(leg[v], leg[0]);
    for (int v = 0; v < (same ? 1 : GOUGH_LEGS); v++)
        fprintf(stream, "%s%.6g", v ? ", " : "", length_of(unit, leg[v]));
    fprintf(stream, "%s", unit_word(unit, GOUGH_UNIT_LENGTH));
}

/* ", along (0.6, 0, 0.8)" */
static void print_direction(FILE *stream, const char *word, const double unit[3]) {
    fprintf(stream, ", %s (", word);
    for (int i = 0; i < 3; i++)
        fprintf(stream, "%s%.3g", i ? ", " : "", fabs(unit[i]) > 5e-4 ? unit[i] : 0.0);
    fprintf(stream, ")\n");
}

static void print_source(FILE *stream, const gough_units *unit, const error_source *source,
                         const gough_resolution *r) {
    const char *length = unit_word(unit, GOUGH_UNIT_LENGTH),
               *angle = unit_word(unit, GOUGH_UNIT_ANGLE);
    if (!source->key) {
        fprintf(stream, "  for each unit of length by which legs are off, at worst\n");
    } else {
        fprintf(stream, "  %s up to ",
                strcmp(source->json, "joints") == 0 ? "legs off, by both their joints,"
                                                    : "legs off by");
        print_legs(stream, unit, source->leg);
        fprintf(stream, " (%s)\n", source->key);
    }
    if (source->key)
        fprintf(stream, "    point moves        %.4g%s at most", length_of(unit, r->position),
                length);
    else
        fprintf(stream, "    point moves        %.4g times as far", length_of(unit, r->position));
    print_direction(stream, "along", r->direction);
    fprintf(stream, "    top turns          %.4g%s%s%s", angle_of(unit, r->angle), angle,
            source->key || !*length ? "" : "/", source->key || !*length ? "" : length + 1);
    fprintf(stream, "%s", source->key ? " at most" : "");
    print_direction(stream, "about", r->axis);
    if (!source->key) return;
    fprintf(stream, "    surge, sway, heave %.4g, %.4g, %.4g%s at most\n",
            length_of(unit, r->component[0]), length_of(unit, r->component[1]),
            length_of(unit, r->component[2]), length);
    fprintf(stream, "    roll, pitch, yaw   %.4g, %.4g, %.4g%s at most\n",
            angle_of(unit, r->component[3]), angle_of(unit, r->component[4]),
            angle_of(unit, r->component[5]), angle);
}

/* rows 0 to 2: a length by a length; 3 to 5: an angle by a length */
static double map_factor(const gough_units *unit, int row) {
    return row < 3 ? 1
                   : gough_unit_factor(unit, GOUGH_UNIT_ANGLE) /
                         gough_unit_factor(unit, GOUGH_UNIT_LENGTH);
}

static void print_map(FILE *stream, const gough_units *unit, const gough_resolution *r) {
    const char *length = unit_word(unit, GOUGH_UNIT_LENGTH),
               *angle = unit_word(unit, GOUGH_UNIT_ANGLE);
    fprintf(stream,
            "\n  pose by leg lengths [1; %s%s%s], rotations about x, y, z of the base\n          ",
            *angle ? angle + 1 : "1", *length ? "/" : "", *length ? length + 1 : "");
    for (int v = 0; v < GOUGH_LEGS; v++) fprintf(stream, "       leg %d", v + 1);
    fprintf(stream, "\n");
    for (int i = 0; i < 6; i++) {
        const double most = largest_of(r->map[i], GOUGH_LEGS);
        fprintf(stream, "  %-6s  ", gough_component_name(i));
        for (int v = 0; v < GOUGH_LEGS; v++)
            fprintf(stream, "%12.5g",
                    fabs(r->map[i][v]) > 1e-12 * most ? map_factor(unit, i) * r->map[i][v] : 0.0);
        fprintf(stream, "\n");
    }
}

static gough_status find(const gough_model *model, const gough_state *state,
                         const error_source *source, gough_resolution *r) {
    gough_error error = {.message = ""};
    return gough_pose_resolution(&model->machine, state, model->motion.about, source->leg, r,
                                 &error);
}

void resolution_print(FILE *stream, const gough_model *model, const gough_units *unit,
                      const gough_state *state) {
    error_source source[SOURCES];
    gough_resolution r;
    fill_sources(model, unit, source);
    for (int k = 0; k < SOURCES; k++) {
        if (!(largest_of(source[k].leg, GOUGH_LEGS) > 0)) continue;
        if (find(model, state, &source[k], &r)) return;
        if (k == PER_LENGTH) print_map(stream, unit, &r);
        print_source(stream, unit, &source[k], &r);
    }
}

/* ---- JSON ---- */

static json_t *lengths_array(const gough_units *unit, const double leg[GOUGH_LEGS]) {
    double own[GOUGH_LEGS];
    for (int v = 0; v < GOUGH_LEGS; v++) own[v] = length_of(unit, leg[v]);
    return json_numbers(own, GOUGH_LEGS);
}

static json_t *source_object(const gough_units *unit, const error_source *source,
                             const gough_resolution *r) {
    json_t *object = json_object();
    double component[6];
    for (int i = 0; i < 6; i++)
        component[i] = i < 3 ? length_of(unit, r->component[i]) : angle_of(unit, r->component[i]);
    json_object_set_new(object, "legs", lengths_array(unit, source->leg));
    json_object_set_new(object, "component", json_numbers(component, 6));
    json_object_set_new(object, "position", json_number(length_of(unit, r->position)));
    json_object_set_new(object, "direction", json_numbers(r->direction, 3));
    json_object_set_new(object, "position_legs", lengths_array(unit, r->position_lengths));
    json_object_set_new(object, "angle", json_number(angle_of(unit, r->angle)));
    json_object_set_new(object, "axis", json_numbers(r->axis, 3));
    json_object_set_new(object, "angle_legs", lengths_array(unit, r->angle_lengths));
    return object;
}

static json_t *map_array(const gough_units *unit, const gough_resolution *r) {
    json_t *rows = json_array();
    for (int i = 0; i < 6; i++) {
        double row[GOUGH_LEGS];
        for (int v = 0; v < GOUGH_LEGS; v++) row[v] = map_factor(unit, i) * r->map[i][v];
        json_array_append_new(rows, json_numbers(row, GOUGH_LEGS));
    }
    return rows;
}

json_t *resolution_object(const gough_model *model, const gough_units *unit,
                          const gough_state *state) {
    json_t *object = json_object();
    error_source source[SOURCES];
    gough_resolution r;
    fill_sources(model, unit, source);
    for (int k = 0; k < SOURCES; k++) {
        const bool given = largest_of(source[k].leg, GOUGH_LEGS) > 0;
        const bool found = given && find(model, state, &source[k], &r) == GOUGH_OK;
        if (k == PER_LENGTH)
            json_object_set_new(object, "map", found ? map_array(unit, &r) : json_null());
        json_object_set_new(object, source[k].json,
                            found ? source_object(unit, &source[k], &r) : json_null());
    }
    return object;
}
