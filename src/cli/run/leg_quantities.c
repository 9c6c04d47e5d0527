/* What is known of a leg over a run, each quantity once: its unit, its column in the tables for reading, its key in the JSON. */
#include "cli/run/leg_quantities.h"

#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/leg_table.h"
#include "cli/common/scale.h"

typedef double derived(const run_report *report, const gough_leg_summary *leg);

double leg_stroke_share(const run_report *report, const gough_leg_summary *leg) {
    const double *range = report->stroke[leg - report->summary.leg];
    const double stroke = range[1] - range[0];
    if (!(range[0] > 0) || !isfinite(stroke) || !(stroke > 0)) return NAN;
    return (leg->length_max - leg->length_min) / stroke;
}

static double length_used(const run_report *report, const gough_leg_summary *leg) {
    (void)report;
    return leg->length_max - leg->length_min;
}

static double force_peak(const run_report *report, const gough_leg_summary *leg) {
    (void)report;
    return fmax(fabs(leg->force_min), fabs(leg->force_max));
}

static double braking_power(const run_report *report, const gough_leg_summary *leg) {
    (void)report;
    return leg->power_min < 0 ? -leg->power_min : 0 * leg->power_min;
}

static double holds_from(const run_report *report, const gough_leg_summary *leg) {
    return report->holds_from[leg - report->summary.leg];
}

static double holds_to(const run_report *report, const gough_leg_summary *leg) {
    return report->holds_to[leg - report->summary.leg];
}

/* Of all legs together. */
typedef enum leg_total { LEAST, GREATEST, SUM } leg_total;

typedef struct leg_quantity {
    const char
        *key; /* two in sequence are a pair; "swing.base" is base of swing; NULL: not in JSON */
    gough_unit unit;
    size_t at;      /* of the member, */
    derived *value; /* or what it follows from */
    int table, place;
    const char *group, *head; /* of the column; without a head one of its own, over its unit */
    int digits;
    leg_total total;
} leg_quantity;

#define AT(member) offsetof(gough_leg_summary, member)

/* In the order of the JSON. */
static const leg_quantity quantities[] = {
    {"length", GOUGH_UNIT_LENGTH, AT(length_min), NULL, LEG_MOTION, 0, "length", "least", 6, LEAST},
    {"length", GOUGH_UNIT_LENGTH, AT(length_max), NULL, LEG_MOTION, 1, "length", "greatest", 6,
     GREATEST},
    {NULL, GOUGH_UNIT_LENGTH, 0, length_used, LEG_MOTION, 2, "length", "used", 6, GREATEST},
    {"speed", GOUGH_UNIT_SPEED, AT(speed), NULL, LEG_MOTION, 4, "peak speed", NULL, 5, GREATEST},
    {"force", GOUGH_UNIT_FORCE, AT(force_min), NULL, LEG_LOADS, 0, "force", "least", 5, LEAST},
    {"force", GOUGH_UNIT_FORCE, AT(force_max), NULL, LEG_LOADS, 1, "force", "greatest", 5,
     GREATEST},
    {NULL, GOUGH_UNIT_FORCE, 0, force_peak, LEG_LOADS, 2, "force", "peak", 5, GREATEST},
    {"rms_force", GOUGH_UNIT_FORCE, AT(rms_force), NULL, LEG_LOADS, 3, "force", "RMS", 5, GREATEST},
    {"power", GOUGH_UNIT_POWER, AT(power_min), NULL, LEG_LOADS, 4, "power", "least", 5, LEAST},
    {"power", GOUGH_UNIT_POWER, AT(power_max), NULL, LEG_LOADS, 5, "power", "greatest", 5,
     GREATEST},
    {"energy", GOUGH_UNIT_ENERGY, AT(energy), NULL, LEG_LOADS, 6, "energy", "net", 5, SUM},
    {"swing.base", GOUGH_UNIT_ANGLE, AT(swing_base), NULL, LEG_MOTION, 5, "swing [] at", "base", 4,
     GREATEST},
    {"swing.top", GOUGH_UNIT_ANGLE, AT(swing_top), NULL, LEG_MOTION, 6, "swing [] at", "top", 4,
     GREATEST},
    {"stroke_used", GOUGH_UNIT_NONE, 0, leg_stroke_share, LEG_MOTION, 3, "stroke", "used %", 3,
     GREATEST},
    {"joint_load.top", GOUGH_UNIT_FORCE, AT(top_load), NULL, LEG_JOINTS, 0, "peak load of joint",
     "top", 5, GREATEST},
    {"joint_load.base", GOUGH_UNIT_FORCE, AT(base_load), NULL, LEG_JOINTS, 1, "peak load of joint",
     "base", 5, GREATEST},
    {"side_load", GOUGH_UNIT_FORCE, AT(side_load), NULL, LEG_JOINTS, 2, "side load", NULL, 4,
     GREATEST},
    {"friction_loss", GOUGH_UNIT_ENERGY, AT(friction_loss), NULL, LEG_JOINTS, 3, "lost by friction",
     NULL, 5, SUM},
    {"returned_energy", GOUGH_UNIT_ENERGY, AT(returned_energy), NULL, LEG_LOADS, 7, "energy",
     "returned", 5, SUM},
    {"braking_power", GOUGH_UNIT_POWER, 0, braking_power, LEG_NONE, 0, "", NULL, 5, GREATEST},
    {"saturated", GOUGH_UNIT_NONE, AT(saturated), NULL, LEG_NONE, 0, "", NULL, 3, GREATEST},
    {"saturated_at", GOUGH_UNIT_TIME, AT(saturated_at), NULL, LEG_NONE, 0, "", NULL, 6, LEAST},
    {"sample_error", GOUGH_UNIT_LENGTH, AT(sample_error), NULL, LEG_NONE, 0, "", NULL, 5, GREATEST},
    {"sample_error_at", GOUGH_UNIT_TIME, AT(sample_error_at), NULL, LEG_NONE, 0, "", NULL, 6,
     LEAST},
    {"holding", GOUGH_UNIT_FORCE, 0, holds_from, LEG_JOINTS, 4, "holds at home", "from", 5, LEAST},
    {"holding", GOUGH_UNIT_FORCE, 0, holds_to, LEG_JOINTS, 5, "holds at home", "to", 5, GREATEST}};
enum { QUANTITIES = sizeof quantities / sizeof quantities[0] };

static double *member(gough_leg_summary *leg, const leg_quantity *q) {
    return (double *)(void *)((char *)leg + q->at);
}

static double value_of(const run_report *report, const gough_leg_summary *leg,
                       const leg_quantity *q) {
    gough_leg_summary copy = *leg;
    return q->value ? q->value(report, leg) : *member(&copy, q);
}

void leg_scale(gough_leg_summary *leg, const gough_units *units) {
    for (int i = 0; i < QUANTITIES; i++) {
        const leg_quantity *q = &quantities[i];
        const scaled_member one = {q->at, 1, q->unit, NULL};
        if (!q->value) scale_members(leg, &one, 1, units);
    }
    leg->acceleration *= gough_unit_factor(units, GOUGH_UNIT_ACCELERATION);
}

/* ---- tables for reading ------------------------------------------------------------------------------------------- */

/* time integrals are right to this share of the largest power times the time */
static const double INTEGRAL_ERROR = 1e-8;

/* Sets to 0 each work that is smaller than the error of its integral, as where positive and negative work cancel. */
static void settle_works(const run_report *report, double value[GOUGH_LEGS + 1]) {
    const gough_units *u = &report->units;
    const double span = (report->summary.last_time - report->summary.first_time) *
                        gough_unit_factor(u, GOUGH_UNIT_ENERGY) /
                        gough_unit_factor(u, GOUGH_UNIT_POWER) /
                        gough_unit_factor(u, GOUGH_UNIT_TIME);
    double most = 0;
    for (int i = 0; i < GOUGH_LEGS; i++) {
        const gough_leg_summary *leg = &report->summary.leg[i];
        most = fmax(most, fmax(fabs(leg->power_min), fabs(leg->power_max)));
    }
    for (int i = 0; i <= GOUGH_LEGS; i++)
        if (fabs(value[i]) < INTEGRAL_ERROR * most * span) value[i] = 0;
}

static void fill(const run_report *report, const leg_quantity *q, double value[GOUGH_LEGS + 1]) {
    const double factor = q->unit == GOUGH_UNIT_NONE ? 100 : 1; /* shares in percent */
    double *all = &value[GOUGH_LEGS];
    *all = q->total == LEAST ? INFINITY : q->total == SUM ? 0 : -INFINITY;
    for (int i = 0; i < GOUGH_LEGS; i++) {
        value[i] = factor * value_of(report, &report->summary.leg[i], q);
        if (q->total == SUM)
            *all += value[i];
        else
            *all = q->total == LEAST ? fmin(*all, value[i]) : fmax(*all, value[i]);
    }
    if (q->total == SUM) settle_works(report, value);
}

/* A column of its own has its name over its unit, or its name alone; those of a group have the unit in its heading. */
static void head(table_column *column, const leg_quantity *q, const gough_units *units,
                 table_heading *heading) {
    const char *unit = unit_word(units, q->unit), *hole = strstr(q->group, "[]");
    *heading = heading_of(q->head ? q->group : "", unit);
    if (hole) /* the unit has its place within the words */
        snprintf(heading->text, sizeof heading->text, "%.*s[%s%s", (int)(hole - q->group), q->group,
                 unit + 1, hole + 1);
    column->group = q->head ? heading->text : *heading->text ? q->group : "";
    column->head = q->head ? q->head : *heading->text ? heading->text : q->group;
    column->digits = q->digits;
}

void leg_table_print(FILE *stream, const run_report *report, int table) {
    table_column column[QUANTITIES + 1] = {{NULL, NULL, {0}, 0}};
    table_heading heading[QUANTITIES];
    int columns = 0;
    for (int place = 0; place < QUANTITIES; place++)
        for (int i = 0; i < QUANTITIES; i++) {
            const leg_quantity *q = &quantities[i];
            if (q->table != table || q->place != place) continue;
            fill(report, q, column[columns].value);
            if (q->value == leg_stroke_share && isnan(column[columns].value[0])) continue;
            head(&column[columns], q, &report->units, &heading[columns]);
            columns++;
        }
    column[columns].head = NULL;
    table_print(stream, column, true);
}

/* ---- JSON --------------------------------------------------------------------------------------------------------- */

static void set(json_t *object, const char *key, json_t *value) {
    json_t *before = json_object_get(object, key);
    if (!before) {
        json_object_set_new(object, key, value);
    } else { /* the second of a pair */
        json_t *pair = json_array();
        json_array_append(pair, before);
        json_array_append_new(pair, value);
        json_object_set_new(object, key, pair);
    }
}

json_t *leg_json(const run_report *report, const gough_leg_summary *leg) {
    json_t *object = json_object();
    for (int i = 0; i < QUANTITIES; i++) {
        const leg_quantity *q = &quantities[i];
        if (!q->key) continue;
        json_t *value = json_number(value_of(report, leg, q));
        const char *dot = strchr(q->key, '.');
        if (!dot) {
            set(object, q->key, value);
            continue;
        }
        char owner[32] = "";
        memcpy(owner, q->key, (size_t)(dot - q->key));
        if (!json_object_get(object, owner)) json_object_set_new(object, owner, json_object());
        set(json_object_get(object, owner), dot + 1, value);
    }
    return object;
}
