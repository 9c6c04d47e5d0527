/* The cells of a map. Cells without a number are drawn first, then the others from the lower left on. Each reaches under those
 * neighbours to the right and above that are drawn after it and cover it, so that no seams show where edges are smoothed. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>

#include "figure/sheet.h"

static double between(double a, double b, bool logarithmic) {
    return logarithmic ? sqrt(a) * sqrt(b) : 0.5 * (a + b);
}

void sheet_cell(const double *centre, size_t count, size_t n, bool logarithmic, double *low,
                double *high) {
    const double own = centre[n];
    if (count == 1) {
        const double half = own < 0.0 || own > 0.0 ? 0.5 * fabs(own) : 0.5;
        *low = logarithmic ? own / 2.0 : own - half;
        *high = logarithmic ? own * 2.0 : own + half;
        return;
    }
    if (n > 0) *low = between(centre[n - 1], own, logarithmic);
    if (n + 1 < count) *high = between(own, centre[n + 1], logarithmic);
    /* at the ends as far out as in */
    if (n == 0) *low = logarithmic ? own * (own / *high) : own - (*high - own);
    if (n + 1 == count) *high = logarithmic ? own * (own / *low) : own + (own - *low);
}

static bool is_empty(const map *m, size_t column, size_t row) {
    return isnan(m->cells[row * m->columns + column]);
}

/* Whether a later cell is drawn over what an earlier one has under it. */
static bool is_covered(const map *m, size_t column, size_t row, size_t over_column,
                       size_t over_row) {
    return is_empty(m, column, row) || !is_empty(m, over_column, over_row);
}

bool sheet_write_map(const map *m, bool logarithmic_x, double scale, const char *path) {
    FILE *file = fopen(path, "w");
    if (file == NULL) return false;
    for (size_t r = 0; r < m->rows; r++) {
        for (size_t c = 0; c < m->columns; c++) {
            const double cell = m->cells[r * m->columns + c];
            const double x = m->x[c], y = m->y[r];
            double west = x, east = x, south = y, north = y;
            sheet_cell(m->x, m->columns, c, logarithmic_x, &west, &east);
            sheet_cell(m->y, m->rows, r, m->logarithmic_y, &south, &north);
            const bool right = c + 1 < m->columns, above = r + 1 < m->rows;
            const bool under_right = right && is_covered(m, c, r, c + 1, r);
            const bool under_above = above && is_covered(m, c, r, c, r + 1) &&
                                     !(under_right && !is_covered(m, c, r, c + 1, r + 1));
            const double under_x = under_right ? m->x[c + 1] : east;
            const double under_y = under_above ? m->y[r + 1] : north;
            fprintf(file, "%.15g %.15g %.15g %.15g %.15g %.15g %.15g %d\n", x, y, west, under_x,
                    south, under_y, isnan(cell) ? 0.0 : cell / scale, isnan(cell));
        }
    }
    const bool good = ferror(file) == 0;
    return fclose(file) == 0 && good;
}
