/* What `gough check` tells about recorded motion: the steps of its columns, the accelerations that rounding to them can
 * make beside those of the motion, and what smoothing changed. */
#include "cli/check/check_record.h"

#include <math.h>

#include "cli/common/scale.h"

typedef struct words {
    const char *value, *acceleration, *time;
    char frequency[40];
} words;

/* Without dimensions angles alone have units, and their accelerations need one of time. */
static words words_of(const gough_units *units, int c) {
    const bool angle = c >= GOUGH_ROLL;
    words w = {unit_word(units, component_unit(c)),
               unit_word(units, angle ? GOUGH_UNIT_ANGULAR_ACCELERATION : GOUGH_UNIT_ACCELERATION),
               unit_word(units, GOUGH_UNIT_TIME), ""};
    if (units->dimensionless && angle) w.acceleration = " deg per unit of time squared";
    snprintf(w.frequency, sizeof w.frequency, " cycles per%s", *w.time ? w.time : " unit of time");
    return w;
}

static void print_column(FILE *stream, const gough_record *record, int c,
                         const gough_units *units) {
    const gough_record_column *column = &record->column[c];
    const words unit = words_of(units, c);
    fprintf(stream, "  record of %-10s ", gough_component_name(c));
    if (column->step > 0)
        fprintf(stream, "in steps of %.3g%s, ", column->step, unit.value);
    else
        fprintf(stream, "without visible rounding, ");
    fprintf(stream, "accelerations up to %.3g%s;\n", column->motion, unit.acceleration);
    fprintf(stream, "                       rounding can%s cause up to %.3g%s\n",
            isfinite(column->cutoff) ? " still" : "", column->rounding, unit.acceleration);
    if (isfinite(column->cutoff))
        fprintf(stream,
                "                       smoothed above %.3g%s: values changed by %.2g%s (root\n"
                "                       mean square), by at most %.2g%s\n",
                column->cutoff, unit.frequency, column->change, unit.value, column->worst_change,
                unit.value);
}

void record_print(FILE *stream, const gough_record *record, const gough_units *units) {
    const words unit = words_of(units, 0);
    fprintf(stream, "  rows                 %s %.6g%s", record->even ? "each" : "on average every",
            record->interval, unit.time);
    if (record->time_step > 0)
        fprintf(stream, ", times in steps of %.3g%s%s", record->time_step, unit.time,
                record->retimed ? " (read as equal intervals)" : "");
    fputc('\n', stream);
    if (record->turned)
        fprintf(stream,
                "  rotations            interpolated about turned axes, %.2g%s or more from their\n"
                "                       pole; roll, pitch and yaw below are angles about these\n",
                record->pole_distance, unit_word(units, GOUGH_UNIT_ANGLE));
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        if (record->column[c].given) print_column(stream, record, c, units);
}

json_t *record_object(const gough_record *record) {
    json_t *object = json_object(), *columns = json_array(), *remarks = json_array();
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const gough_record_column *column = &record->column[c];
        if (!column->given) continue;
        json_t *one = json_object();
        json_object_set_new(one, "name", json_string(gough_component_name(c)));
        json_object_set_new(one, "step", json_number(column->step));
        json_object_set_new(one, "rounding", json_number(column->rounding));
        json_object_set_new(one, "motion", json_number(column->motion));
        json_object_set_new(one, "cutoff", json_number(column->cutoff));
        json_object_set_new(one, "change", json_number(column->change));
        json_object_set_new(one, "worst_change", json_number(column->worst_change));
        json_array_append_new(columns, one);
    }
    for (size_t i = 0; i < record->remarks; i++) {
        json_t *one = json_object();
        json_object_set_new(one, "warning", json_boolean(record->remark[i].warning));
        json_object_set_new(one, "message", json_words(record->remark[i].sentence));
        json_array_append_new(remarks, one);
    }
    json_object_set_new(object, "interval", json_number(record->interval));
    json_object_set_new(object, "even", json_boolean(record->even));
    json_object_set_new(object, "time_step", json_number(record->time_step));
    json_object_set_new(object, "retimed", json_boolean(record->retimed));
    json_object_set_new(object, "turned", json_boolean(record->turned));
    json_object_set_new(object, "pole_distance",
                        json_number(record->turned ? record->pole_distance : NAN));
    json_object_set_new(object, "columns", columns);
    json_object_set_new(object, "remarks", remarks);
    return object;
}
