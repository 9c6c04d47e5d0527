/* Lines of the six legs: those with the same numbers as one line; all in one panel, or with a panel for each leg; with the limits
 * of the study where they lie near. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure/builder.h"
#include "figure/palette.h"

/* Greatest and least finite number of a column, NaN without one. */
void builder_extremes(const gough_table *table, const double *value, double *least,
                      double *greatest) {
    *least = *greatest = NAN;
    for (size_t r = 0; r < table->rows; r++) {
        if (!isfinite(value[r])) continue;
        if (!(value[r] >= *least)) *least = value[r];
        if (!(value[r] <= *greatest)) *greatest = value[r];
    }
}

static bool same_column(const double *a, const double *b, size_t rows, double tolerance) {
    for (size_t r = 0; r < rows; r++) {
        const bool both_absent = isnan(a[r]) && isnan(b[r]);
        if (!both_absent && !(fabs(a[r] - b[r]) <= tolerance)) return false;
    }
    return true;
}

/* Group of each leg: its own number, or that of the first leg with the same numbers (within noise, or 1e-9 of the greatest). */
void builder_group_legs(const gough_table *table, const double *const column[GOUGH_LEGS],
                        double noise, int group[GOUGH_LEGS]) {
    double most = 0.0;
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        double least, greatest;
        builder_extremes(table, column[leg], &least, &greatest);
        most = fmax(most, fmax(fabs(least), fabs(greatest)));
    }
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        group[leg] = leg;
        for (int other = 0; other < leg && group[leg] == leg; other++) {
            if (group[other] == other &&
                same_column(column[leg], column[other], table->rows, fmax(1e-9 * most, noise)))
                group[leg] = other;
        }
    }
}

/* "2", "1, 6", "legs 1–6 (equal)": the panel's heading says that these are legs. */
void builder_name_group(const int group[GOUGH_LEGS], int number, char *label, size_t size) {
    int members = 0;
    for (int leg = 0; leg < GOUGH_LEGS; leg++) members += group[leg] == number;
    if (members == GOUGH_LEGS) {
        snprintf(label, size, "legs 1–6 (equal)");
        return;
    }
    label[0] = '\0';
    const char *separator = "";
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        if (group[leg] != number) continue;
        const size_t used = strlen(label);
        snprintf(label + used, size - used, "%s%d", separator, leg + 1);
        separator = ", ";
    }
}

static bool find_columns(builder *b, size_t t, const char *prefix,
                         const double *column[GOUGH_LEGS]) {
    char name[16];
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        snprintf(name, sizeof name, "%s%d", prefix, leg + 1);
        column[leg] = builder_column(b, t, name);
    }
    return b->status == GOUGH_OK;
}

static void add_legs_of_table(builder *b, panel *p, size_t t, const char *prefix) {
    const double *column[GOUGH_LEGS];
    int group[GOUGH_LEGS];
    char name[16], label[SHEET_TEXT];
    if (!find_columns(b, t, prefix, column)) return;

    snprintf(name, sizeof name, "%s1", prefix);
    builder_group_legs(b->tables[t], column, builder_noise(b, name), group);
    int drawn = 0;
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        if (group[leg] != leg) continue;
        builder_name_group(group, leg, label, sizeof label);
        if (builder_compares(b))
            snprintf(label, sizeof label, "%s", drawn == 0 ? builder_label(b, t) : "");
        builder_line(b, p, t, "t", column[leg], label,
                     builder_compares(b) ? colour_of_table(t) : colour_of_leg(leg));
        drawn++;
    }
}

/* ---- limits ---------------------------------------------------------------------------------------------------- */

/* A limit is drawn where a line comes nearer to it than this share of it. One further away would press the lines together. */
static const double near_limit = 0.5;

/* What all tables allow forces or rates of all legs, both ways; NaN without a limit, and where they differ. */
static double limit_of(const builder *b, const char *prefix) {
    const bool rate = strcmp(prefix, "dl") == 0;
    double limit = NAN;
    if (b->figure->difference || (!rate && strcmp(prefix, "f") != 0)) return NAN;
    for (size_t t = 0; t < b->table_count; t++) {
        const double own = rate ? b->tables[t]->max_speed : b->tables[t]->max_force;
        if (isnan(own) || (t > 0 && fabs(own - limit) > 1e-12 * limit)) return NAN;
        limit = own;
    }
    return limit;
}

static double greatest_of_panel(const panel *p) {
    double greatest = 0.0;
    for (int i = 0; i < p->count; i++)
        for (size_t r = 0; r < p->series[i].count; r++)
            if (isfinite(p->series[i].y[r])) greatest = fmax(greatest, fabs(p->series[i].y[r]));
    return greatest;
}

static void add_limit(builder *b, panel *p, double limit, bool named) {
    double *level = builder_array(b, 0);
    if (level == NULL || b->tables[0]->rows == 0) return;
    for (size_t r = 0; r < b->tables[0]->rows; r++) level[r] = limit;
    series *line = builder_line(b, p, 0, "t", level, named ? "limit" : "", 0);
    if (line != NULL) line->limit = true;
}

/* Dashed lines, or a note with the limit's size where the lines stay far from it. */
static void add_limits(builder *b, panel *p, const char *prefix, bool noted) {
    const double limit = limit_of(b, prefix);
    if (p == NULL || b->status != GOUGH_OK || !(limit > 0.0)) return;
    if (greatest_of_panel(p) >= near_limit * limit) {
        add_limit(b, p, limit, true);
        if (!p->logarithmic) add_limit(b, p, -limit, false);
        return;
    }
    if (!noted || b->sheet->note[0] != '\0') return;
    char unit[48], name[8];
    snprintf(name, sizeof name, "%s1", prefix);
    sheet_unit_label(unit, sizeof unit, builder_unit_words(b, name), 0);
    /* " (m/s)" without the brackets */
    const size_t length = strlen(unit);
    snprintf(b->sheet->note, sizeof b->sheet->note,
             "the limit, ±%.6g%s%.*s, lies outside the picture", limit, length > 3 ? " " : "",
             length > 3 ? (int)length - 3 : 0, unit + (length > 3 ? 2 : 0));
}

/* ---- panels ---------------------------------------------------------------------------------------------------- */

/* A panel for each leg, all with one scale. */
static void add_small_panels(builder *b, const char *heading, const char *prefix) {
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        char name[8], words[SHEET_TEXT];
        snprintf(name, sizeof name, "%s%d", prefix, leg + 1);
        snprintf(words, sizeof words, "%s, leg %d", heading, leg + 1);
        panel *p = builder_panel_of(b, words, name, b->figure->logarithmic);
        for (size_t t = 0; t < b->table_count; t++)
            builder_line(b, p, t, "t", builder_column(b, t, name),
                         builder_compares(b) ? builder_label(b, t) : "",
                         builder_compares(b) ? colour_of_table(t) : colour_of_leg(leg));
        add_limits(b, p, prefix, leg == 0);
    }
    b->sheet->columns = 2;
    b->sheet->common_scale = true;
}

void builder_add_legs(builder *b, const char *heading, const char *prefix) {
    char name[8];
    if (b->figure->split) {
        add_small_panels(b, heading, prefix);
        return;
    }
    snprintf(name, sizeof name, "%s1", prefix);
    panel *p = builder_panel_of(b, heading, name, b->figure->logarithmic);
    for (size_t t = 0; t < b->table_count; t++) add_legs_of_table(b, p, t, prefix);
    add_limits(b, p, prefix, b->sheet->count == 1);
}
