/* A stability map made drawable. Levels are known at the grid points, at the edges of intervals and where each grows most; between
 * them they are taken as linear. Intervals of neighbouring rows that are one tongue are paired; where one has no partner its tongue
 * comes to a point before the next row. */
#include "figure/tongues.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ELLIPSE = 8, INTERVAL_NODES = 3 + 2 * (ELLIPSE - 1) };
enum { BACKGROUND_RED = 0xf2, BACKGROUND_GREEN = 0xf5, BACKGROUND_BLUE = 0xf4 };

/* ---- levels of a row --------------------------------------------------------------------------------------------- */

static const gough_map_row *row_of(const field *f, size_t row) { return &f->map->row[row]; }

const gough_interval *field_interval(const field *f, size_t row, int number) {
    return &f->map->interval[row * f->options->intervals + (size_t)number];
}

/* A period to compare rows that rest with those that move. */
static double reference_period(const field *f) {
    for (size_t r = f->rows; r-- > 0;)
        if (!row_of(f, r)->error.status && row_of(f, r)->period.period > 0)
            return row_of(f, r)->period.period;
    return 0;
}

/* From growth per period and growth rate, of which a row at rest has the rate only. */
static double level_of(const field *f, double growth, double rate, double period) {
    double level = rate;
    if (!f->resting) level = isfinite(growth) ? log(growth) : rate * period;
    return isfinite(level) && level > 0 ? level : 0;
}

bool field_covered(const field *f, size_t row, int number, double x) {
    for (int i = 0; i < (int)row_of(f, row)->intervals; i++) {
        const gough_interval *other = field_interval(f, row, i);
        if (i != number && other->from < x && x < other->to) return true;
    }
    return false;
}

static int by_place(const void *left, const void *right) {
    const field_node *a = left, *b = right;
    return (a->x > b->x) - (a->x < b->x);
}

bool field_gap(const field *f, size_t row, size_t column) {
    return isnan(f->map->point[row * f->options->stiffness.count + column].rate);
}

bool field_has_gaps(const field *f) {
    for (size_t r = 0; r < f->rows; r++)
        for (size_t i = 0; i < f->options->stiffness.count && !row_of(f, r)->error.status; i++)
            if (field_gap(f, r, i)) return true;
    return false;
}

/* A narrow tongue is half an ellipse in first order: nodes along it where the grid has hardly any. */
static size_t add_ellipse(const gough_interval *one, double level, field_node *node) {
    for (int i = 1; i < ELLIPSE; i++) {
        const double part = (double)i / ELLIPSE, edge = 1 - part * part;
        /* closer to the edges, where it is steep */
        const double height = level * sqrt(1 - edge * edge);
        node[2 * i - 2] =
            (field_node){one->stiffness + edge * (one->from - one->stiffness), height};
        node[2 * i - 1] = (field_node){one->stiffness + edge * (one->to - one->stiffness), height};
    }
    return 2 * (ELLIPSE - 1);
}

/* The edges of an interval and where it grows most, as far as no other overlaps it. */
static size_t add_interval(const field *f, size_t row, int number, double period,
                           field_node *node) {
    const gough_map_range *range = &f->options->stiffness;
    const gough_interval *one = field_interval(f, row, number);
    const bool starts = one->from > range->from && !field_covered(f, row, number, one->from);
    const bool ends = !one->cut && one->to < range->to && !field_covered(f, row, number, one->to);
    const bool peaks = one->stiffness > one->from && one->stiffness < one->to &&
                       !field_covered(f, row, number, one->stiffness);
    const double level = level_of(f, one->growth, one->rate, period);
    size_t count = 0, inside = 0;
    for (size_t i = 0; i < range->count; i++) {
        const double x = gough_map_value(range, i);
        inside += x > one->from && x < one->to;
    }
    if (starts) node[count++] = (field_node){one->from, 0};
    if (ends) node[count++] = (field_node){one->to, 0};
    if (peaks) node[count++] = (field_node){one->stiffness, level};
    if (starts && ends && peaks && inside <= 3) count += add_ellipse(one, level, node + count);
    return count;
}

/* Grid points and what intervals know besides. */
static void fill_row(field *f, size_t row, double period) {
    const gough_map_range *range = &f->options->stiffness;
    field_node *node = &f->node[row * f->nodes];
    size_t count = 0;
    for (size_t i = 0; i < range->count; i++) {
        const gough_map_point *p = &f->map->point[row * range->count + i];
        if (field_gap(f, row, i)) continue;
        const double level = p->stable ? 0 : level_of(f, p->growth, p->rate, period);
        node[count++] = (field_node){gough_map_value(range, i), level};
    }
    for (int i = 0; i < (int)row_of(f, row)->intervals; i++)
        count += add_interval(f, row, i, period, node + count);
    qsort(node, count, sizeof *node, by_place);
    f->count[row] = count;
    for (size_t i = 0; i < count; i++) f->greatest = fmax(f->greatest, node[i].level);
}

double field_level(const field *f, size_t row, double x) {
    const field_node *node = &f->node[row * f->nodes];
    size_t low = 0, high = f->count[row];
    if (high == 0) return 0;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (node[middle].x <= x)
            low = middle;
        else
            high = middle;
    }
    if (x <= node[low].x || low + 1 == f->count[row]) return node[low].level;
    const field_node *a = &node[low], *b = &node[low + 1];
    return a->level + (b->level - a->level) * (x - a->x) / (b->x - a->x);
}

/* ---- tongues from row to row ------------------------------------------------------------------------------------- */

static double centre_of(const gough_interval *one) { return 0.5 * (one->from + one->to); }

/* Where the interval is to be expected in the next row: as far on as it came from the row before; without one, where the
 * resonances of a motion of another frequency lie, whose squares go with the stiffness. */
static double expected(const field *f, size_t row, int number) {
    const gough_map_row *here = row_of(f, row), *next = row_of(f, row + 1);
    const double centre = centre_of(field_interval(f, row, number));
    for (size_t p = row > 0 ? f->first[row - 1] : 0; row > 0 && p < f->first[row]; p++)
        if (f->pair[p].high == number && f->pair[p].low >= 0) {
            const double before = row_of(f, row - 1)->value;
            const double came = centre - centre_of(field_interval(f, row - 1, f->pair[p].low));
            return centre + came * (next->value - here->value) / (here->value - before);
        }
    if (f->options->axis != GOUGH_MAP_FREQUENCY) return centre;
    return centre * (next->value / here->value) * (next->value / here->value);
}

/* How far the edges of an interval are from where those of another are expected, one of another mode or kind counting as farther
 * off; infinite beyond reach: a twentieth of the range, and half the width. */
static double distance_of(const field *f, const gough_interval *one, double centre,
                          const gough_interval *other) {
    const double range = f->options->stiffness.to - f->options->stiffness.from;
    const double reach = 0.05 * range + 0.5 * (one->to - one->from);
    const double shift = centre - centre_of(one);
    double distance =
        fmax(fabs(other->from - one->from - shift), fabs(other->to - one->to - shift));
    if (other->kind != one->kind) distance += 0.02 * range;
    if (strcmp(other->mode.name, one->mode.name) != 0) distance += 0.01 * range;
    return distance < reach ? distance : INFINITY;
}

/* The number in the next row that is nearest to where this one is expected; -1: none within reach. */
static int nearest_above(const field *f, size_t row, int number, double centre) {
    double least = INFINITY;
    int best = -1;
    for (int j = 0; j < (int)row_of(f, row + 1)->intervals; j++) {
        const double distance =
            distance_of(f, field_interval(f, row, number), centre, field_interval(f, row + 1, j));
        if (distance < least) least = distance, best = j;
    }
    return best;
}

static int nearest_below(const field *f, size_t row, int number, const double *centre) {
    double least = INFINITY;
    int best = -1;
    for (int i = 0; i < (int)row_of(f, row)->intervals; i++) {
        const double distance = distance_of(f, field_interval(f, row, i), centre[i],
                                            field_interval(f, row + 1, number));
        if (distance < least) least = distance, best = i;
    }
    return best;
}

/* Those that are nearest to each other are one tongue. @p centre: room for the intervals of a row. */
static void pair_rows(field *f, size_t row, double *centre) {
    const bool next =
        row + 1 < f->rows && !row_of(f, row)->error.status && !row_of(f, row + 1)->error.status;
    if (!next) return;
    for (int i = 0; i < (int)row_of(f, row)->intervals; i++) centre[i] = expected(f, row, i);
    for (int i = 0; i < (int)row_of(f, row)->intervals; i++) {
        const int j = nearest_above(f, row, i, centre[i]);
        const bool mutual = j >= 0 && nearest_below(f, row, j, centre) == i;
        f->pair[f->pairs++] = (field_pair){row, i, mutual ? j : -1};
    }
    for (int j = 0; j < (int)row_of(f, row + 1)->intervals; j++) {
        const int i = nearest_below(f, row, j, centre);
        if (i < 0 || nearest_above(f, row, i, centre[i]) != j)
            f->pair[f->pairs++] = (field_pair){row, -1, j};
    }
}

bool field_make(field *f, const gough_map_options *options, const gough_map *map) {
    *f = (field){.options = options, .map = map, .rows = gough_map_rows(options)};
    size_t intervals = 0, most = 0;
    for (size_t r = 0; r < f->rows; r++) {
        intervals += map->row[r].intervals;
        if (map->row[r].intervals > most) most = map->row[r].intervals;
    }
    f->nodes = options->stiffness.count + INTERVAL_NODES * most;
    f->node = calloc(f->rows * f->nodes + 1, sizeof *f->node);
    f->count = calloc(f->rows + 1, sizeof *f->count);
    f->pair = calloc(2 * intervals + 1, sizeof *f->pair);
    double *centre = calloc(most + 1, sizeof *centre);
    f->first = calloc(f->rows + 1, sizeof *f->first);
    if (!f->node || !f->count || !f->pair || !f->first || !centre) {
        free(centre);
        return false;
    }
    const double period = reference_period(f);
    f->resting = !(period > 0);
    for (size_t r = 0; r < f->rows; r++)
        if (!map->row[r].error.status) fill_row(f, r, period);
    for (size_t r = 0; r < f->rows; r++) {
        f->first[r] = f->pairs;
        pair_rows(f, r, centre);
    }
    f->first[f->rows] = f->pairs;
    free(centre);
    return true;
}

void field_free(field *f) {
    free(f->node);
    free(f->count);
    free(f->pair);
    free(f->first);
}

/* ---- colours ----------------------------------------------------------------------------------------------------- */

/* Weak growth per period is what a map is looked at for: its half of the scale is wide. */
double field_shade(const field *f, double level) {
    const double part = f->greatest > 0 ? fmin(level / f->greatest, 1) : 0;
    return f->resting ? part : sqrt(part);
}

/* Light to dark, told apart by all readers, after magma of Smith and van der Walt. */
void field_colour(double shade, unsigned char rgb[3]) {
    static const unsigned char scale[][3] = {
        {0xfe, 0xcf, 0x92}, {0xfe, 0x9f, 0x6d}, {0xf7, 0x70, 0x5c}, {0xde, 0x49, 0x68},
        {0xb7, 0x37, 0x79}, {0x8c, 0x29, 0x81}, {0x64, 0x1a, 0x80}, {0x3b, 0x0f, 0x70}};
    enum { LAST = sizeof scale / sizeof scale[0] - 1 };
    const double at = fmin(fmax(shade, 0), 1) * LAST;
    const int n = at < LAST ? (int)at : LAST - 1;
    for (int k = 0; k < 3; k++)
        rgb[k] = (unsigned char)lround(scale[n][k] + (at - n) * (scale[n + 1][k] - scale[n][k]));
}

/* One line of pixels: how much of each is unstable, and how fast it grows there. */
typedef struct line_of_pixels {
    double *cover, *level;
} line_of_pixels;

static double place_of(const field_view *view, bool logarithmic, double x) {
    const double part = logarithmic ? log(x / view->low_x) / log(view->high_x / view->low_x)
                                    : (x - view->low_x) / (view->high_x - view->low_x);
    return part * view->width;
}

static double value_at(const field_view *view, bool logarithmic, double place) {
    const double part = place / view->width;
    return logarithmic ? view->low_x * pow(view->high_x / view->low_x, part)
                       : view->low_x + part * (view->high_x - view->low_x);
}

static double mix(double a, double b, double part) { return a + part * (b - a); }

/* The edges of a pair at a part of the way from its row to the next. */
static void edges_of(const field *f, const field_pair *pair, double part, double edge[2],
                     double end[2][2]) {
    const gough_interval *low = pair->low >= 0 ? field_interval(f, pair->row, pair->low) : NULL;
    const gough_interval *high =
        pair->high >= 0 ? field_interval(f, pair->row + 1, pair->high) : NULL;
    const double lone = low ? centre_of(low) : centre_of(high);
    end[0][0] = low ? low->from : lone;
    end[0][1] = low ? low->to : lone;
    end[1][0] = high ? high->from : lone;
    end[1][1] = high ? high->to : lone;
    for (int k = 0; k < 2; k++) edge[k] = mix(end[0][k], end[1][k], part);
}

/* The level at a part of the width of a pair, between its two rows. */
static double level_between(const field *f, const field_pair *pair, double part, double across,
                            double end[2][2]) {
    const double low = field_level(f, pair->row, mix(end[0][0], end[0][1], across));
    const double high = field_level(f, pair->row + 1, mix(end[1][0], end[1][1], across));
    if (pair->low < 0) return high * part;
    if (pair->high < 0) return low * (1 - part);
    return mix(low, high, part);
}

static void paint_pair(const field *f, const field_view *view, const field_pair *pair, double part,
                       line_of_pixels *line) {
    const bool logarithmic = f->options->stiffness.logarithmic;
    double edge[2], end[2][2];
    edges_of(f, pair, part, edge, end);
    const double from = edge[0] > view->low_x ? place_of(view, logarithmic, edge[0]) : 0;
    const double to = edge[1] < view->high_x ? place_of(view, logarithmic, edge[1]) : view->width;
    for (int x = (int)fmax(from, 0); x < view->width && x < to; x++) {
        const double cover = fmin(to, x + 1) - fmax(from, x);
        if (!(cover > 0)) continue;
        const double middle = value_at(view, logarithmic, 0.5 * (fmin(to, x + 1) + fmax(from, x)));
        const double across = edge[1] > edge[0] ? (middle - edge[0]) / (edge[1] - edge[0]) : 0.5;
        line->cover[x] = fmax(line->cover[x], cover);
        line->level[x] =
            fmax(line->level[x], level_between(f, pair, part, fmin(fmax(across, 0), 1), end));
    }
}

static bool holds(const field *f, size_t row, double x) { return field_covered(f, row, -1, x); }

/* Of sampled loops: where something grows in both rows, though intervals that join or part have no partner in the other row. */
static void paint_both(const field *f, const field_view *view, size_t row, double part,
                       line_of_pixels *line) {
    const bool logarithmic = f->options->stiffness.logarithmic;
    if (!(row_of(f, row)->sampling > 0)) return;
    for (int x = 0; x < view->width; x++) {
        const double at = value_at(view, logarithmic, x + 0.5);
        if (!holds(f, row, at) || !holds(f, row + 1, at)) continue;
        line->cover[x] = 1;
        line->level[x] =
            fmax(line->level[x], mix(field_level(f, row, at), field_level(f, row + 1, at), part));
    }
}

/* A line at a part of the way from a row to the next. It is grey near points without values, and all of it is if either row has
 * none. */
static void paint_line(const field *f, const field_view *view, const line_of_pixels *line,
                       size_t row, double part, unsigned char *pixel) {
    const gough_map_range *range = &f->options->stiffness;
    const bool empty = row_of(f, row)->error.status || row_of(f, row + 1)->error.status;
    const size_t nearest = part < 0.5 ? row : row + 1;
    size_t column = 0; /* the point nearest to the pixel */
    for (int x = 0; x < view->width; x++, pixel += 3) {
        const double at = x + 0.5;
        while (column + 1 < range->count &&
               fabs(place_of(view, range->logarithmic, gough_map_value(range, column + 1)) - at) <
                   fabs(place_of(view, range->logarithmic, gough_map_value(range, column)) - at))
            column++;
        const bool grey = empty || field_gap(f, nearest, column);
        unsigned char rgb[3];
        const double plain[3] = {grey ? 0xc9 : BACKGROUND_RED, grey ? 0xc9 : BACKGROUND_GREEN,
                                 grey ? 0xc9 : BACKGROUND_BLUE};
        field_colour(field_shade(f, line->level[x]), rgb);
        for (int k = 0; k < 3; k++)
            pixel[k] = (unsigned char)lround(mix(plain[k], rgb[k], line->cover[x]));
    }
}

void field_paint(const field *f, const field_view *view, unsigned char *pixel) {
    const gough_map_range *range = &f->options->second;
    const size_t width = (size_t)view->width;
    line_of_pixels line = {calloc(width, sizeof(double)), calloc(width, sizeof(double))};
    size_t row = f->rows - 2;
    for (int y = 0; line.cover && line.level && y < view->height; y++) {
        const double part_y = 1 - (y + 0.5) / view->height;
        const double value = range->logarithmic
                                 ? view->low_y * pow(view->high_y / view->low_y, part_y)
                                 : view->low_y + part_y * (view->high_y - view->low_y);
        while (row > 0 && value < gough_map_value(range, row)) row--;
        const double low = gough_map_value(range, row), high = gough_map_value(range, row + 1);
        const double part =
            range->logarithmic ? log(value / low) / log(high / low) : (value - low) / (high - low);
        memset(line.cover, 0, width * sizeof *line.cover);
        memset(line.level, 0, width * sizeof *line.level);
        for (size_t p = f->first[row]; p < f->first[row + 1]; p++)
            paint_pair(f, view, &f->pair[p], part, &line);
        paint_both(f, view, row, part, &line);
        paint_line(f, view, &line, row, part, pixel + 3 * (size_t)y * width);
    }
    free(line.cover);
    free(line.level);
}
