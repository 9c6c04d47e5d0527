/* Units of a table: what one unit of the output is in units of the run, and how a column's unit is called. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "table/table.h"

/* (R_b, M, √(R_b/g)) are the units of length, mass and time of the dimensionless form. */
gough_status gough_units_of_study(const gough_study *study, bool dimensionless, gough_units *units,
                                  gough_error *error) {
    *units = (gough_units){study->dimensionless || dimensionless, 1.0, 1.0, 1.0};
    if (!dimensionless) return GOUGH_OK;

    const gough_machine *machine = &study->model->machine;
    if (!(machine->gravity_magnitude > 0.0))
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "without gravity there is no dimensionless form, because its unit of time is "
            "sqrt(base radius/gravity); set gravity or keep the study's units");
    units->length = machine->base_radius;
    units->mass = machine->load.mass;
    units->time = sqrt(machine->base_radius / machine->gravity_magnitude);
    return GOUGH_OK;
}

/* Dimensions that have a name of their own. */
static const struct {
    int length, mass, time;
    const char *name;
} named_units[] = {{1, 1, -2, "N"}, {2, 1, -2, "N m"}, {2, 1, -3, "W"}};

/* Appends "kg", "m2", … with a space before it if it is not the first. */
static void append_power(char label[RESULT_UNIT_SIZE], const char *unit, int power) {
    if (power == 0) return;
    const size_t used = strlen(label);
    char number[12] = "";
    if (power != 1) snprintf(number, sizeof number, "%d", power);
    snprintf(label + used, RESULT_UNIT_SIZE - used, "%s%s%s", used > 0 ? " " : "", unit, number);
}

void result_unit_label(int column, bool dimensionless, char label[RESULT_UNIT_SIZE]) {
    const gough_column_info *info = gough_column(column);
    label[0] = '\0';
    if (dimensionless) {
        snprintf(label, RESULT_UNIT_SIZE, "%s", info->angle != 0 ? "degree" : "1");
        return;
    }
    for (size_t i = 0; i < sizeof named_units / sizeof named_units[0]; i++) {
        if (info->angle == 0 && info->length == named_units[i].length &&
            info->mass == named_units[i].mass && info->time == named_units[i].time) {
            snprintf(label, RESULT_UNIT_SIZE, "%s", named_units[i].name);
            return;
        }
    }

    append_power(label, "degree", info->angle);
    append_power(label, "kg", info->mass);
    append_power(label, "m", info->length);
    if (label[0] == '\0') {
        append_power(label, "s", info->time);
    } else if (info->time < 0) {
        char below[RESULT_UNIT_SIZE] = "";
        append_power(below, "s", -info->time);
        strncat(label, "/", RESULT_UNIT_SIZE - strlen(label) - 1);
        strncat(label, below, RESULT_UNIT_SIZE - strlen(label) - 1);
    }
    if (label[0] == '\0') snprintf(label, RESULT_UNIT_SIZE, "1");
}
