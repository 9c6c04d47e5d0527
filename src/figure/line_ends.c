/* Where lines end in a panel, and their names there. Places are in nominal pixels from the panel's lower edge. */
#include "figure/line_ends.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STEP = 12,       /* least distance between names */
    GAP = 5,         /* between a panel and the names */
    LONGEST = 18,    /* characters of a name at a line's end; longer names are in the key only */
    LETTER = 7,      /* width of a character */
    FIRST_LABEL = 20 /* number of gnuplot's label for the first name */
};

typedef struct end {
    const char *name;
    double place; /* of the line's end */
} end;

/* Names that neighbour each other: around the middle of their lines' ends. */
typedef struct group {
    int count;
    double sum, middle;
} group;

static bool is_named(const series *line) {
    const size_t length = strlen(line->label);
    return length > 0 && length <= LONGEST && line->colour >= 0 && !line->limit && !line->mark &&
           !line->loop;
}

int line_ends_room(const sheet *s) {
    size_t longest = 0;
    for (int i = 0; i < s->count; i++) {
        for (int k = 0; k < s->panel[i].count; k++) {
            const series *line = &s->panel[i].series[k];
            const size_t length = is_named(line) ? strlen(line->label) : 0;
            if (length > longest) longest = length;
        }
    }
    return longest > 0 ? GAP + LETTER * (int)longest + 2 : 0;
}

/* Place of the last point of a line within the range of x; false without one. */
static bool find_end(const panel *p, const series *line, range x, scaled_range y, double height,
                     double *place) {
    const double unit = pow(1000.0, y.power);
    for (size_t k = line->count; k-- > 0;) {
        const double value = panel_drawn(p, line->y[k]) / unit;
        if (!isfinite(value) || !(line->x[k] <= x.high) || (p->logarithmic && !(value > 0.0)))
            continue;
        const double share = p->logarithmic
                                 ? log(value / y.range.low) / log(y.range.high / y.range.low)
                                 : (value - y.range.low) / (y.range.high - y.range.low);
        *place = height * fmin(fmax(share, 0.0), 1.0);
        return true;
    }
    return false;
}

static int by_place(const void *a, const void *b) {
    const end *first = a, *second = b;
    if (first->place != second->place) return first->place < second->place ? -1 : 1;
    return first->name < second->name ? -1 : first->name > second->name;
}

static double half(const group *g) { return 0.5 * STEP * g->count; }

/* Groups of names that would touch, from the lowest; each stays within the panel. */
static int find_groups(const end *ends, int count, double height, group *groups) {
    int found = 0;
    for (int i = 0; i < count; i++) {
        group g = {1, ends[i].place, ends[i].place};
        while (found > 0 &&
               groups[found - 1].middle + half(&groups[found - 1]) > g.middle - half(&g)) {
            found--;
            g = (group){g.count + groups[found].count, g.sum + groups[found].sum, 0.0};
            g.middle = g.sum / g.count;
        }
        g.middle = fmax(fmin(g.middle, height - half(&g)), half(&g));
        groups[found++] = g;
    }
    return found;
}

void line_ends_write(FILE *file, const panel *p, range x, scaled_range y, int width, int height,
                     double font) {
    end ends[SHEET_SERIES];
    group groups[SHEET_SERIES];
    int count = 0;
    for (int i = 0; i < p->count; i++) {
        const series *line = &p->series[i];
        if (is_named(line) && find_end(p, line, x, y, height, &ends[count].place))
            ends[count++].name = line->label;
    }
    qsort(ends, (size_t)count, sizeof *ends, by_place);
    const int found = find_groups(ends, count, height, groups);
    for (int g = 0, i = 0; g < found; g++) {
        for (int k = 0; k < groups[g].count; k++, i++) {
            char quoted[2 * SHEET_TEXT];
            const double place = groups[g].middle + STEP * (k - 0.5 * (groups[g].count - 1));
            sheet_quote(quoted, sizeof quoted, ends[i].name, LONGEST);
            fprintf(file,
                    "set label %d '%s' at graph %.6f,graph %.6f left noenhanced font ',%.4g'\n",
                    FIRST_LABEL + i, quoted, 1.0 + (double)GAP / width, place / height, font);
        }
    }
}
