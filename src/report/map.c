/* The cells of a map. Each reaches under its neighbours to the right and above, which are drawn later and cover it: so no seams
 * show between cells where edges are smoothed. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>

#include "sheet.h"

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
            const double under_x = c + 1 < m->columns ? m->x[c + 1] : east;
            const double under_y = r + 1 < m->rows ? m->y[r + 1] : north;
            fprintf(file, "%.9g %.9g %.9g %.9g %.9g %.9g %.7g %d\n", x, y, west, under_x, south,
                    under_y, isnan(cell) ? 0.0 : cell / scale, isnan(cell));
        }
    }
    const bool good = ferror(file) == 0;
    return fclose(file) == 0 && good;
}
