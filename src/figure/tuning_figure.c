/* Figure of gough tune: deviation against the stiffness G, with and without feed-forward, the accuracy asked for, the G chosen, and
 * the leg force that goes with it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure/builder.h"
#include "figure/palette.h"

/* the rows of one setting of the feed-forward */
typedef struct curve {
    size_t count, named;
    double *G, *deviation, *force, *marked; /* of the curve */
    double *named_G, *named_deviation, *named_force;
} curve;

bool sheet_is_tuning(const gough_table *table) {
    static const char *const name[] = {"feedforward", "G", "position_deviation", "asked", "named"};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
        if (gough_table_column(table, name[i]) == NULL) return false;
    return true;
}

static bool take_curve(builder *b, size_t t, bool fed, curve *c) {
    const double *feedforward = builder_column(b, t, "feedforward"), *G = builder_column(b, t, "G"),
                 *deviation = builder_column(b, t, "position_deviation"),
                 *force = builder_column(b, t, "force"), *ended = builder_column(b, t, "ended"),
                 *stable = builder_column(b, t, "stable"), *named = builder_column(b, t, "named");
    double **array[] = {&c->G,       &c->deviation,       &c->force,      &c->marked,
                        &c->named_G, &c->named_deviation, &c->named_force};
    c->count = c->named = 0;
    for (size_t i = 0; i < sizeof array / sizeof array[0]; i++) *array[i] = builder_array(b, t);
    if (b->status != GOUGH_OK) return false;
    for (size_t r = 0; r < b->tables[t]->rows; r++) {
        if ((feedforward[r] > 0.5) != fed) continue;
        if (named[r] > 0.5) {
            c->named_G[c->named] = G[r];
            c->named_deviation[c->named] = deviation[r];
            c->named_force[c->named++] = force[r];
            continue;
        }
        c->G[c->count] = G[r];
        c->deviation[c->count] = deviation[r];
        c->force[c->count] = ended[r] > 0.5 ? NAN : force[r];
        c->marked[c->count++] = ended[r] > 0.5 || !(stable[r] > 0.5);
    }
    return c->count > 0;
}

static series *add_series(builder *b, panel *p, const char *label, int colour) {
    if (p == NULL || b->status != GOUGH_OK) return NULL;
    if (p->count == SHEET_SERIES) {
        builder_fail(b, GOUGH_ERROR_INPUT, "too many lines for one panel; draw fewer tables");
        return NULL;
    }
    series *line = &p->series[p->count++];
    *line = (series){.colour = colour < 0 ? colour : colour_of_table((size_t)colour)};
    snprintf(line->label, sizeof line->label, "%s", label);
    return line;
}

static void set_points(series *line, size_t count, const double *x, const double *y) {
    if (line == NULL) return;
    line->count = count;
    line->x = x;
    line->y = y;
}

static bool any(const double *flag, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (flag[i] > 0.5) return true;
    return false;
}

/* The deviation asked for, all over the curve, pale under the lines. */
static void add_asked(builder *b, panel *p, size_t t) {
    const double *G = builder_column(b, t, "G"), *asked = builder_column(b, t, "asked");
    double *x = builder_array(b, t), *y = builder_array(b, t);
    const size_t rows = b->tables[t]->rows;
    if (b->status != GOUGH_OK || rows < 2) return;
    x[0] = x[1] = G[0];
    for (size_t r = 0; r < rows; r++) {
        x[0] = fmin(x[0], G[r]);
        x[1] = fmax(x[1], G[r]);
    }
    y[0] = y[1] = asked[0];
    set_points(add_series(b, p, "accuracy asked for", -1), 2, x, y);
}

/* The axis of deviations ends four decades below the accuracy asked for: a curve of errors of the run would take up most of the
 * panel. The note says what that leaves out. */
static void limit_axis(builder *b, panel *p) {
    static const double decades_below = 4;
    const double *asked = builder_column(b, 0, "asked");
    if (b->status != GOUGH_OK || b->tables[0]->rows == 0 || !(asked[0] > 0)) return;
    const double floor_of_axis = pow(10.0, floor(log10(asked[0])) - decades_below);
    double least = INFINITY;
    for (int i = 0; i < p->count; i++)
        for (size_t k = 0; k < p->series[i].count; k++)
            if (p->series[i].y[k] > 0) least = fmin(least, p->series[i].y[k]);
    if (!(least < floor_of_axis)) return;
    p->least = floor_of_axis;
    const char *unit = builder_unit_words(b, "position_deviation");
    const bool bare = unit[0] == '\0' || strcmp(unit, "1") == 0;
    if (b->sheet->note[0] == '\0')
        snprintf(b->sheet->note, sizeof b->sheet->note,
                 "deviations below %.0e%s%s are not drawn; the least is %.1e%s%s", floor_of_axis,
                 bare ? "" : " ", bare ? "" : unit, least, bare ? "" : " ", bare ? "" : unit);
}

static void add_curve(builder *b, panel *deviation, panel *force, const curve *c, const char *label,
                      int colour, bool first) {
    series *line = add_series(b, deviation, label, colour);
    set_points(line, c->count, c->G, c->deviation);
    if (line != NULL && any(c->marked, c->count)) {
        line->points = true;
        line->ended = c->marked;
        line->ended_label = first ? "ended early or unstable" : "";
    }
    set_points(add_series(b, force, "", colour), c->count, c->G, c->force);
    if (c->named == 0) return;
    char chosen[SHEET_TEXT];
    const char *unit = builder_unit_words(b, "G");
    const bool bare = unit[0] == '\0' || strcmp(unit, "1") == 0;
    snprintf(chosen, sizeof chosen, "chosen G = %.6g%s%.20s", c->named_G[0], bare ? "" : " ",
             bare ? "" : unit);
    line = add_series(b, deviation, chosen, colour);
    if (line != NULL) line->mark = true;
    set_points(line, c->named, c->named_G, c->named_deviation);
    line = add_series(b, force, "", colour);
    if (line != NULL) line->mark = true;
    set_points(line, c->named, c->named_G, c->named_force);
}

/* The note tells in which way the stability of the points was checked, which depends on the loop. Older tables lack the column. */
static void note_judged(builder *b) {
    static const char *const how[] = {"by whether its run reached its end", "at rest",
                                      "along the program"};
    static const char *const whose[] = {"by whether their runs reached their end", "at rest",
                                        "along the program"};
    enum { WAYS = sizeof how / sizeof how[0] };
    sheet *s = b->sheet;
    size_t count[WAYS] = {0}, parts = 0;
    for (size_t t = 0; t < b->table_count; t++) {
        if (gough_table_column(b->tables[t], "judged") == NULL) return;
        const double *judged = builder_column(b, t, "judged"),
                     *named = builder_column(b, t, "named");
        if (b->status != GOUGH_OK) return;
        for (size_t r = 0; r < b->tables[t]->rows; r++)
            for (int way = 0; way < WAYS && !(named[r] > 0.5); way++)
                count[way] += fabs(judged[r] - way) < 0.5;
    }
    for (int way = WAYS - 1; way >= 0; way--) {
        const size_t used = strlen(s->note);
        if (count[way] == 0) continue;
        snprintf(s->note + used, sizeof s->note - used, "%s%zu point%s %s",
                 parts++ > 0 ? ", "
                 : used > 0  ? "; stability checked: "
                             : "stability checked: ",
                 count[way], count[way] == 1 ? "" : "s", (count[way] == 1 ? how : whose)[way]);
    }
}

/* Forces of runs that follow the program alike differ by the errors of the runs: they are drawn as one. */
static void note_errors(panel *p) {
    static const double share = 1e-6;
    double greatest = 0;
    for (int i = 0; i < p->count; i++)
        for (size_t k = 0; k < p->series[i].count; k++)
            if (isfinite(p->series[i].y[k])) greatest = fmax(greatest, fabs(p->series[i].y[k]));
    p->noise = fmax(p->noise, share * greatest);
}

void builder_fill_tuning(builder *b) {
    sheet *s = b->sheet;
    int colour = 0;
    s->logarithmic_abscissa = true;
    s->common_key = true;
    builder_abscissa(b, "stiffness of the feedback G", "G");
    panel *deviation =
        builder_panel_of(b, "Largest deviation of position", "position_deviation", true);
    panel *force = builder_panel_of(b, "Largest leg force", "force", false);
    for (size_t t = 0; t < b->table_count; t++) {
        if (!sheet_is_tuning(b->tables[t])) {
            builder_fail(b, GOUGH_ERROR_INPUT, "some of these results are not from gough tune");
            return;
        }
        if (t == 0) add_asked(b, deviation, t);
        for (int fed = 1; fed >= 0; fed--) {
            char label[SHEET_TEXT];
            curve c;
            if (!take_curve(b, t, fed, &c)) continue;
            snprintf(label, sizeof label, "%.90s%s%s feed-forward",
                     builder_compares(b) ? builder_label(b, t) : "",
                     builder_compares(b) ? ", " : "", fed ? "with" : "without");
            add_curve(b, deviation, force, &c, label, colour, colour == 0);
            colour++;
        }
    }
    if (deviation != NULL && colour > 0) limit_axis(b, deviation);
    if (b->status == GOUGH_OK && colour > 0) note_judged(b);
    if (force != NULL) note_errors(force);
    if (force != NULL && colour == 0) s->count = 0;
}
