/* Bands in the place of lines that go up and down more than twice in each pixel: a line would fill the same area with ink that has
 * no shape, and dashes in it could not be seen. */
#include "figure/bands.h"

#include <math.h>

static const int turns_of_period = 2, periods = 2;

bool band_needed(const panel *p, const series *line, range x, int pixels) {
    if (line->loop || line->limit || line->mark || line->points || line->steps ||
        line->colour < 0 || p->logarithmic)
        return false;
    long turns = 0;
    int way = 0;
    for (size_t r = 1; r < line->count; r++) {
        if (line->x[r] < x.low || line->x[r] > x.high) continue;
        const double step = line->y[r] - line->y[r - 1];
        const int now = (step > 0.0) - (step < 0.0);
        turns += now != 0 && way != 0 && now != way;
        if (now != 0) way = now;
    }
    return turns > (long)turns_of_period * periods * pixels;
}

bool band_in_panel(const panel *p, range x, int pixels) {
    for (int i = 0; i < p->count; i++)
        if (band_needed(p, &p->series[i], x, pixels)) return true;
    return false;
}

size_t band_write(FILE *file, const panel *p, const series *line, range x, int pixels,
                  double scale) {
    const double width = (x.high - x.low) / pixels;
    size_t r = 0, written = 0;
    while (r < line->count && line->x[r] < x.low) r++;
    for (int pixel = 0; pixel < pixels; pixel++) {
        double least = NAN, greatest = NAN;
        const double end = x.low + width * (pixel + 1);
        for (; r < line->count && (line->x[r] < end || pixel + 1 == pixels); r++) {
            const double y = panel_drawn(p, line->y[r]) / scale;
            if (!isfinite(y)) continue;
            if (!(y >= least)) least = y;
            if (!(y <= greatest)) greatest = y;
        }
        if (isfinite(least)) {
            fprintf(file, "%.15g %.15g %.15g\n", x.low + width * (pixel + 0.5), least, greatest);
            written++;
        } else {
            fprintf(file, "\n");
        }
    }
    return written;
}
