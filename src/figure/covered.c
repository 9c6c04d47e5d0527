/* Lines that others cover in a picture: a note names them, so that no line is missing without a word. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure/axis_ranges.h"

/* Lines are one to the eye where they are nowhere further apart than this share of a panel's height: about a pixel. */
static const double one_line = 0.006;
enum { PAIRS = 3, MOST_PAIRS = 8 }; /* that the note names; that are searched for */

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

/* A pair of lines, and the panels in which one covers the other. */
typedef struct pair {
    char upper[64], lower[64], heading[64];
    int panels;
} pair;

static void count_pair(pair *pairs, int *count, const char *upper, const char *lower,
                       const char *heading) {
    pair found = {.panels = 1};
    snprintf(found.upper, sizeof found.upper, "%.60s", upper);
    snprintf(found.lower, sizeof found.lower, "%.60s", lower);
    snprintf(found.heading, sizeof found.heading, "%.60s", heading);
    for (int i = 0; i < *count; i++) {
        if (strcmp(pairs[i].upper, found.upper) != 0 || strcmp(pairs[i].lower, found.lower) != 0)
            continue;
        pairs[i].panels++;
        return;
    }
    if (*count < MOST_PAIRS) pairs[(*count)++] = found;
}

static void search_panel(const panel *p, pair *pairs, int *count) {
    const scaled_range y = panel_ordinate(p);
    for (int upper = 1; upper < p->count; upper++) {
        const series *line = &p->series[upper];
        for (int lower = 0; lower < upper && is_line(line); lower++) {
            const series *other = &p->series[lower];
            const char *a = name_of(p, line), *b = name_of(p, other);
            if (!is_line(other) || strcmp(a, b) == 0 || !covers(p, line, other, y)) continue;
            count_pair(pairs, count, a, b, p->heading);
            break;
        }
    }
}

static void note_pair(sheet *s, const pair *one) {
    char words[SHEET_NOTE], where[100] = "";
    if (s->count > 1 && one->panels == 1)
        snprintf(where, sizeof where, " in “%.60s”", one->heading);
    else if (s->count > 1 && one->panels == s->count)
        snprintf(where, sizeof where, " in all panels");
    else if (s->count > 1)
        snprintf(where, sizeof where, " in %d of %d panels", one->panels, s->count);
    snprintf(words, sizeof words, "line “%.60s” covers line “%.60s”%.90s", one->upper, one->lower,
             where);
    add_words(s, words);
}

void sheet_note_covered(sheet *s) {
    pair pairs[MOST_PAIRS];
    int count = 0;
    for (int i = 0; i < s->count; i++)
        if (!s->panel[i].mapped) search_panel(&s->panel[i], pairs, &count);
    for (int i = 0; i < count && i < PAIRS; i++) note_pair(s, &pairs[i]);
    if (count > PAIRS) add_words(s, "more lines are covered");
}
