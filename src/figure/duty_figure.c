/* Drive force over leg rate, one curve a leg: what a drive has to give in its four quadrants. Where both have the same sign the
 * drive works, else it brakes. Limits are dashed; a large point is the RMS of both over the rows drawn, by the trapezium. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure/builder.h"
#include "figure/palette.h"

/* rows of a table within the figure's range of time */
typedef struct span {
    const double *time;
    size_t begin, end;
} span;

static span rows_drawn(builder *b, size_t t) {
    span s = {builder_column(b, t, "t"), 0, 0};
    if (s.time == NULL) return s;
    s.end = b->tables[t]->rows;
    while (s.begin < s.end && s.time[s.begin] < b->figure->from) s.begin++;
    while (s.end > s.begin && s.time[s.end - 1] > b->figure->to) s.end--;
    if (s.begin == s.end)
        b->status = gough_fail(b->error, GOUGH_ERROR_INPUT, "'%.80s' has no rows to draw%s",
                               builder_label(b, t), b->tables[t]->rows > 0 ? " in this range" : "");
    return s;
}

static double root_mean_square(const span *s, const double *value) {
    double sum = 0, time = 0;
    for (size_t r = s->begin + 1; r < s->end; r++) {
        const double h = s->time[r] - s->time[r - 1];
        sum += h * (value[r] * value[r] + value[r - 1] * value[r - 1]) / 2;
        time += h;
    }
    return time > 0 ? sqrt(sum / time) : fabs(value[s->begin]);
}

static series *add_series(builder *b, panel *p, const double *x, const double *y, size_t count) {
    if (b->status != GOUGH_OK || p == NULL) return NULL;
    if (p->count == SHEET_SERIES) {
        builder_fail(b, GOUGH_ERROR_INPUT, "too many lines for one panel; draw fewer tables");
        return NULL;
    }
    p->series[p->count] = (series){.count = count, .x = x, .y = y};
    return &p->series[p->count++];
}

/* numbers that belong to the sheet */
static double *numbers(builder *b, size_t count) {
    double *array = b->status == GOUGH_OK ? sheet_array(b->sheet, count) : NULL;
    if (array == NULL) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    return array;
}

static void add_curve(builder *b, panel *p, const span *s, const double *rate, const double *force,
                      const char *label, int colour) {
    series *curve = add_series(b, p, rate + s->begin, force + s->begin, s->end - s->begin);
    if (curve == NULL) return;
    curve->loop = true;
    curve->colour = colour;
    snprintf(curve->label, sizeof curve->label, "%s", label);
}

static void add_point(builder *b, panel *p, double rate, double force, const char *label,
                      int colour) {
    double *point = numbers(b, 2);
    if (point == NULL) return;
    point[0] = rate, point[1] = force;
    series *mark = add_series(b, p, point, point + 1, 1);
    if (mark == NULL) return;
    mark->mark = true;
    mark->colour = colour;
    snprintf(mark->label, sizeof mark->label, "%s", label);
}

static void add_legs(builder *b, panel *p, size_t t) {
    const double *rate[GOUGH_LEGS], *force[GOUGH_LEGS];
    int by_rate[GOUGH_LEGS], by_force[GOUGH_LEGS], group[GOUGH_LEGS];
    const gough_table *table = b->tables[t];
    const span s = rows_drawn(b, t);
    char name[8], label[SHEET_TEXT];
    for (int v = 0; v < GOUGH_LEGS; v++) {
        snprintf(name, sizeof name, "dl%d", v + 1);
        rate[v] = builder_column(b, t, name);
        snprintf(name, sizeof name, "f%d", v + 1);
        force[v] = builder_column(b, t, name);
    }
    if (b->status != GOUGH_OK) return;

    builder_group_legs(table, rate, builder_noise(b, "dl1"), by_rate);
    builder_group_legs(table, force, builder_noise(b, "f1"), by_force);
    for (int v = 0; v < GOUGH_LEGS; v++) group[v] = by_rate[v] == by_force[v] ? by_force[v] : v;
    for (int v = 0, drawn = 0; v < GOUGH_LEGS; v++) {
        if (group[v] != v) continue;
        const int colour = builder_compares(b) ? colour_of_table(t) : colour_of_leg(v);
        builder_name_group(group, v, label, sizeof label);
        if (builder_compares(b))
            snprintf(label, sizeof label, "%s", drawn++ ? "" : builder_label(b, t));
        add_curve(b, p, &s, rate[v], force[v], label, colour);
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (group[v] != v) continue;
        add_point(b, p, root_mean_square(&s, rate[v]), root_mean_square(&s, force[v]),
                  t == 0 && v == 0 ? "RMS of a leg" : "",
                  builder_compares(b) ? colour_of_table(t) : colour_of_leg(v));
    }
}

/* the greatest size of any number of the curves */
static double reach(const panel *p, bool abscissa) {
    double most = 0;
    for (int i = 0; i < p->count; i++)
        for (size_t k = 0; k < p->series[i].count; k++)
            most = fmax(most, fabs(abscissa ? p->series[i].x[k] : p->series[i].y[k]));
    return most;
}

/* The limits as a frame; with one of them alone, two lines as long as the curves. */
static void add_limits(builder *b, panel *p, double speed, double force) {
    const bool fast = speed > 0, strong = force > 0;
    const double x = fast ? speed : reach(p, true), y = strong ? force : reach(p, false);
    double *frame = numbers(b, 10);
    if (frame == NULL || (!fast && !strong)) return;
    const double corner[5][2] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}, {-x, -y}};
    for (int k = 0; k < 5; k++) frame[k] = corner[k][0], frame[5 + k] = corner[k][1];
    for (int side = 0; side < (fast && strong ? 1 : 2); side++) {
        /* both: one line round; the force alone: its lower and its upper side; the speed alone: right and left */
        const int from = (fast && !strong) + 2 * side;
        series *line = add_series(b, p, frame + from, frame + 5 + from, fast && strong ? 5 : 2);
        if (line == NULL) return;
        line->loop = line->limit = true;
        if (side == 0) snprintf(line->label, sizeof line->label, "limits");
    }
}

/* The limit asked for, or that of the first table that has one. */
static double limit_of(const builder *b, double asked, size_t member) {
    double found = asked;
    for (size_t t = 0; t < b->table_count && isnan(found); t++)
        found = *(const double *)(const void *)((const char *)b->tables[t] + member);
    return found;
}

void builder_fill_duty(builder *b) {
    panel *p = builder_panel_of(b, "Drive force of each leg", "f1", false);
    builder_abscissa(b, "leg rate", "dl1");
    b->sheet->from = b->sheet->to = NAN; /* of time, not of the abscissa */
    for (size_t t = 0; t < b->table_count; t++) add_legs(b, p, t);
    if (b->status != GOUGH_OK || p == NULL) return;
    p->crossed = true;
    add_limits(b, p, limit_of(b, b->figure->max_speed, offsetof(gough_table, max_speed)),
               limit_of(b, b->figure->max_force, offsetof(gough_table, max_force)));
    /* room beside a limit, both ways alike */
    const double most = 1.06 * reach(p, true);
    if (most > 0) b->sheet->from = -most, b->sheet->to = most;
}
