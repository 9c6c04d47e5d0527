/* Lines that others cover in a picture: a note names them, so that no line is missing without a word. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure/axis_ranges.h"

/* Lines are one to the eye where they are nowhere further apart than this share of a panel's height: about a pixel. */
static const double one_line = 0.006;
enum { PAIRS = 3 }; /* that the note names */

static bool is_line(const series *line) {
    return line->count > 1 && line->colour >= 0 && !line->limit && !line->mark && !line->loop;
}

/* How high a number is drawn, as a share of the panel's height; NaN where it is not drawn. */
static double place(const panel *p, scaled_range y, double value) {
    const double drawn = panel_drawn(p, value) / pow(1000.0, y.power);
    if (!p->logarithmic) return (drawn - y.range.low) / (y.range.high - y.range.low);
    if (!(drawn > 0.0)) return NAN;
    return log(drawn / y.range.low) / log(y.range.high / y.range.low);
}

static bool covers(const panel *p, const series *upper, const series *lower, scaled_range y) {
    if (upper->count != lower->count) return false;
    size_t seen = 0;
    for (size_t r = 0; r < upper->count; r++) {
        const double a = place(p, y, upper->y[r]), b = place(p, y, lower->y[r]);
        if (fabs(upper->x[r] - lower->x[r]) > 1e-9 * fabs(upper->x[r])) return false;
        if (!isfinite(a) && !isfinite(b)) continue;
        if (!(fabs(a - b) <= one_line)) return false;
        seen++;
    }
    return seen > 0;
}

/* A line is called as in the key; lines of one table have one colour there, of which the first is named. */
static const char *name_of(const panel *p, const series *line) {
    if (line->label[0] != '\0') return line->label;
    for (int i = 0; i < p->count; i++)
        if (p->series[i].colour == line->colour && p->series[i].label[0] != '\0')
            return p->series[i].label;
    return "";
}

static void add_words(sheet *s, const char *words) {
    const size_t used = strlen(s->note);
    snprintf(s->note + used, sizeof s->note - used, "%s%s", used > 0 ? "; " : "", words);
}

/* The first pair of a panel names it where there are several. */
static void note_panel(sheet *s, const panel *p, int *pairs) {
    bool named = s->count == 1;
    const scaled_range y = panel_ordinate(p);
    for (int upper = 1; upper < p->count; upper++) {
        const series *line = &p->series[upper];
        for (int lower = 0; lower < upper && is_line(line); lower++) {
            const series *other = &p->series[lower];
            const char *a = name_of(p, line), *b = name_of(p, other);
            if (!is_line(other) || strcmp(a, b) == 0 || !covers(p, line, other, y)) continue;
            char words[SHEET_NOTE];
            snprintf(words, sizeof words, "%s%.60s%sline “%.60s” covers line “%.60s”",
                     named ? "" : "in “", named ? "" : p->heading, named ? "" : "”, ", a, b);
            if (++*pairs <= PAIRS) add_words(s, words);
            named = true;
            break;
        }
    }
}

void sheet_note_covered(sheet *s) {
    int pairs = 0;
    for (int i = 0; i < s->count; i++)
        if (!s->panel[i].mapped) note_panel(s, &s->panel[i], &pairs);
    char words[80];
    snprintf(words, sizeof words, "%d more lines are covered", pairs - PAIRS);
    if (pairs == PAIRS + 1)
        add_words(s, "one more line is covered");
    else if (pairs > PAIRS)
        add_words(s, words);
}
