/* A stability map over two axes: an image for growth, lines for the edges of intervals, names at the tongues that have room. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "figure/map_figure.h"
#include "figure/ticks.h"
#include "gough/text.h"

enum {
    LEFT = 88,
    PANEL_WIDTH = 596,
    PANEL_HEIGHT = 400,
    SCALE_GAP = 16, /* between panel and scale of colours */
    SCALE_WIDTH = 14,
    FINE = 2,        /* pixels of the image for a nominal one */
    MOST_NAMES = 16, /* at tongues */
    NAME_HEIGHT = 15
};

/* ---- the image --------------------------------------------------------------------------------------------------- */

static bool write_bytes(const stability_pen *pen, const char *name, const unsigned char *bytes,
                        size_t length) {
    FILE *file = stability_open(pen, name);
    if (file == NULL) return false;
    const bool good = fwrite(bytes, 1, length, file) == length;
    return fclose(file) == 0 && good;
}

/* A raster of @p width × @p height from its upper row, into the plot whose margins are set. */
static void plot_raster(const stability_pen *pen, const char *name, int width, int height) {
    fprintf(pen->file,
            "unset border\nunset tics\nunset xlabel\nunset ylabel\nunset logscale\nset xrange "
            "[0:%d]\nset yrange [0:%d]\nplot '%s' binary array=(%d,%d) flip=y origin=(0.5,0.5) "
            "format='%%uchar' using 1:2:3 with rgbimage notitle\n",
            width, height, name, width, height);
}

static void plot_scale(const stability_pen *pen, int height) {
    const int left = pen->left + pen->panel_width + SCALE_GAP;
    fprintf(pen->file,
            "set lmargin at screen %.6f\nset rmargin at screen %.6f\nset tmargin at screen "
            "%.6f\nset bmargin at screen %.6f\n",
            stability_screen_x(left), stability_screen_x(left + SCALE_WIDTH),
            stability_screen_y(pen, pen->top),
            stability_screen_y(pen, pen->top + pen->panel_height));
    plot_raster(pen, "scale", 2, height);
}

/* Two pixels wide: of one, gnuplot does not know the width. */
static bool write_scale_raster(const stability_pen *pen, int height) {
    unsigned char *pixel = calloc((size_t)height, 6);
    bool good = pixel != NULL;
    for (int y = 0; good && y < height; y++) {
        field_colour(1 - (y + 0.5) / height, pixel + 6 * (size_t)y);
        memcpy(pixel + 6 * (size_t)y + 3, pixel + 6 * (size_t)y, 3);
    }
    good = good && write_bytes(pen, "scale", pixel, 6 * (size_t)height);
    free(pixel);
    return good;
}

static void write_scale_number(const stability_pen *pen, double shade, const char *text) {
    const double x = pen->left + pen->panel_width + SCALE_GAP + SCALE_WIDTH;
    const double y = pen->top + pen->panel_height * (1 - shade);
    fprintf(
        pen->file,
        "set arrow from screen %.6f,screen %.6f to screen %.6f,screen %.6f nohead lw 0.8 lc rgb "
        "'%s'\nset label '%s' at screen %.6f,screen %.6f left font ',%.4g' textcolor rgb '%s'\n",
        stability_screen_x(x), stability_screen_y(pen, y), stability_screen_x(x + 4),
        stability_screen_y(pen, y), stability_ink, text, stability_screen_x(x + 7),
        stability_screen_y(pen, y), stability_size(pen, STABILITY_SMALL), stability_ink);
}

static void write_scale_numbers(const stability_pen *pen) {
    stability_tic tic[STABILITY_TICS];
    const int tics = stability_list_tics(pen->field, 20.0 / pen->panel_height, tic);
    fprintf(
        pen->file,
        "set label '%s%s' at screen %.6f,screen %.6f right noenhanced font ',%.4g' textcolor rgb "
        "'%s'\n",
        pen->field->resting ? "growth rate" : "growth per period",
        pen->field->resting ? stability_unit(pen, GOUGH_UNIT_RATE, " (√(g/R_b))").text : "",
        stability_screen_x(STABILITY_WIDTH - 12), stability_screen_y(pen, pen->top - 12),
        stability_size(pen, STABILITY_SMALL), stability_ink);
    for (int i = 0; i < tics; i++) write_scale_number(pen, tic[i].shade, tic[i].text);
}

/* ---- edges ------------------------------------------------------------------------------------------------------- */

/* Lines along the edges from row to row: dark where they bound what is stable, pale within what grows anyway. */
static bool write_edges(const stability_pen *pen) {
    const field *f = pen->field;
    FILE *file = stability_open(pen, "edges");
    if (file == NULL) return false;
    for (size_t p = 0; p < f->pairs; p++) {
        const field_pair *pair = &f->pair[p];
        if (pair->low < 0 || pair->high < 0) continue;
        const gough_interval *low = field_interval(f, pair->row, pair->low);
        const gough_interval *high = field_interval(f, pair->row + 1, pair->high);
        const double y[2] = {gough_map_value(&f->options->second, pair->row),
                             gough_map_value(&f->options->second, pair->row + 1)};
        const double edge[2][2] = {{low->from, high->from}, {low->to, high->to}};
        for (int side = 0; side < 2; side++) {
            const double *x = edge[side];
            const bool outside =
                fmax(x[0], x[1]) <= pen->view.low_x || fmin(x[0], x[1]) >= pen->view.high_x;
            if (outside || (side == 1 && low->cut && high->cut)) continue;
            const bool inner = field_covered(f, pair->row, pair->low, x[0]) &&
                               field_covered(f, pair->row + 1, pair->high, x[1]);
            fprintf(file, "%.9g %.9g %d\n%.9g %.9g %d\n\n\n", x[0], y[0], inner, x[1], y[1], inner);
        }
    }
    fprintf(file, "NaN NaN 0\nNaN NaN 1\n"); /* gnuplot takes a file without a point for an error */
    const bool good = ferror(file) == 0;
    return fclose(file) == 0 && good;
}

/* ---- names at tongues --------------------------------------------------------------------------------------------- */

typedef struct box {
    double left, top, width, height;
} box;

/* What a tongue looks like: where it is widest, and whose it is. */
typedef struct tongue {
    size_t row;
    double width; /* nominal pixels */
    const gough_interval *widest;
    bool below; /* below another's threshold: all around it grows too */
} tongue;

/* Pixels of the image that an edge runs through become the colour of no other. */
static const unsigned char edge_colour[3] = {0, 0, 0};

static void mark_edges(const stability_pen *pen, unsigned char *pixel) {
    const field *f = pen->field;
    const int width = pen->view.width, height = pen->view.height;
    for (size_t p = 0; p < f->pairs; p++) {
        const field_pair *pair = &f->pair[p];
        if (pair->low < 0 || pair->high < 0) continue;
        const gough_interval *end[2] = {field_interval(f, pair->row, pair->low),
                                        field_interval(f, pair->row + 1, pair->high)};
        double x[2][2], y[2];
        for (int e = 0; e < 2; e++) {
            const double from = fmax(end[e]->from, pen->view.low_x);
            x[e][0] = FINE * (stability_place_x(pen, from) - pen->left);
            x[e][1] = FINE * (stability_place_x(pen, end[e]->to) - pen->left);
            y[e] = FINE * (stability_place_y(
                               pen, gough_map_value(&f->options->second, pair->row + (size_t)e)) -
                           pen->top);
        }
        for (int row = (int)y[1]; row <= y[0] && row < height; row++)
            for (int side = 0; side < 2; side++) {
                const double part = y[0] > y[1] ? (row - y[1]) / (y[0] - y[1]) : 0;
                const int column = (int)(x[1][side] + part * (x[0][side] - x[1][side]));
                if (row < 0 || column < 0 || column >= width) continue;
                memcpy(pixel + 3 * ((size_t)row * (size_t)width + (size_t)column), edge_colour, 3);
            }
    }
}

/* 1 where all pixels under a box are of the plain, stable colour, -1 where none is, 0 for a mixture or an edge. */
static int ground_of(const unsigned char *pixel, const stability_pen *pen, const box *b) {
    const int width = pen->view.width, height = pen->view.height;
    size_t plain = 0, all = 0;
    for (int y = (int)(FINE * (b->top - pen->top)); y < FINE * (b->top + b->height - pen->top); y++)
        for (int x = (int)(FINE * (b->left - pen->left));
             x < FINE * (b->left + b->width - pen->left); x++) {
            if (x < 0 || y < 0 || x >= width || y >= height) return 0;
            const unsigned char *at = pixel + 3 * ((size_t)y * (size_t)width + (size_t)x);
            if (memcmp(at, edge_colour, 3) == 0) return 0;
            plain += at[0] >= 0xf0 && at[1] >= 0xf0 && at[2] >= 0xf0;
            all++;
        }
    return plain == all ? 1 : plain == 0 ? -1 : 0;
}

static bool overlaps(const box *a, const box *b) {
    return a->left < b->left + b->width && b->left < a->left + a->width &&
           a->top < b->top + b->height && b->top < a->top + a->height;
}

static bool is_free(const box *b, const box *placed, int count) {
    for (int i = 0; i < count; i++)
        if (overlaps(b, &placed[i])) return false;
    return true;
}

static int text_width(const char *text) { return 7 * (int)gough_character_count(text) + 4; }

/* Whether an interval lies in another tongue, where a name would be taken for that one's. */
static bool lies_within(const field *f, size_t row, int number) {
    const gough_interval *one = field_interval(f, row, number);
    const double centre = 0.5 * (one->from + one->to);
    for (int i = 0; i < (int)f->map->row[row].intervals; i++) {
        const gough_interval *other = field_interval(f, row, i);
        if (i != number && other->kind != GOUGH_INTERVAL_STATIC && other->from < centre &&
            centre < other->to && other->to - other->from > one->to - one->from)
            return true;
    }
    return false;
}

/* Where tongues may have names; resonances only, as thresholds have names above the panel. */
static size_t list_tongues(const stability_pen *pen, tongue *list, size_t room) {
    const field *f = pen->field;
    size_t count = 0;
    for (size_t r = 0; r < f->rows; r++)
        for (int i = 0; i < (int)f->map->row[r].intervals && count < room; i++) {
            const gough_interval *one = field_interval(f, r, i);
            const double from = fmax(one->from, pen->view.low_x),
                         to = fmin(one->to, pen->view.high_x);
            if (one->kind == GOUGH_INTERVAL_STATIC && pen->figure->rest) continue;
            if (!(to > from) || lies_within(f, r, i)) continue;
            list[count++] = (tongue){r, stability_place_x(pen, to) - stability_place_x(pen, from),
                                     one, field_covered(f, r, i, 0.5 * (from + to))};
        }
    return count;
}

static int by_width(const void *left, const void *right) {
    const tongue *a = left, *b = right;
    if (a->width < b->width || a->width > b->width) return a->width < b->width ? 1 : -1;
    return (a->row > b->row) - (a->row < b->row);
}

/* Writes a name inside an interval, beside it, or beside it above or below, where a slanting tongue leaves room. */
static bool place_name(const stability_pen *pen, const unsigned char *pixel, const tongue *t,
                       box *placed, int count) {
    const double value = gough_map_value(&pen->field->options->second, t->row);
    const double y = stability_place_y(pen, value), width = text_width(t->widest->mode.name);
    const double from = stability_place_x(pen, fmax(t->widest->from, pen->view.low_x));
    const double to = stability_place_x(pen, fmin(t->widest->to, pen->view.high_x));
    const double level = y - 0.5 * NAME_HEIGHT, above = y - 2 - NAME_HEIGHT, below = y + 2;
    const double right = to + 4, left = from - 4 - width;
    const double corner[][2] = {{0.5 * (from + to - width), level},
                                {right, level},
                                {left, level},
                                {right, below},
                                {left, above},
                                {right, above},
                                {left, below}};
    for (size_t i = 0; i < sizeof corner / sizeof corner[0]; i++) {
        const box b = {corner[i][0], corner[i][1], width, NAME_HEIGHT};
        const int ground = ground_of(pixel, pen, &b);
        /* beside it, but in another tongue: it would be taken for that one's */
        if (i > 0 && (ground < 0) != t->below) continue;
        if (ground == 0 || !is_free(&b, placed, count)) continue;
        placed[count] = b;
        fprintf(pen->file,
                "set label '%s' at screen %.6f,screen %.6f center front noenhanced font ',%.4g' "
                "textcolor rgb '%s'\n",
                t->widest->mode.name, stability_screen_x(b.left + 0.5 * width),
                stability_screen_y(pen, b.top + 0.5 * NAME_HEIGHT),
                stability_size(pen, STABILITY_SMALL), ground < 0 ? "white" : "black");
        return true;
    }
    return false;
}

/* Whether a name already placed is of the same tongue: so near that it would be read so, or followed from row to row. */
static bool is_named(const stability_pen *pen, const tongue *t, const tongue *named, int count) {
    for (int i = 0; i < count; i++) {
        const gough_interval *a = t->widest, *b = named[i].widest;
        if (a->kind != b->kind || strcmp(a->mode.name, b->mode.name) != 0) continue;
        if (fabs(stability_place_x(pen, fmin(a->to, pen->view.high_x)) -
                 stability_place_x(pen, fmin(b->to, pen->view.high_x))) < 30)
            return true;
        /* follow from row to row, from the named one to this */
        size_t row = named[i].row;
        int number = (int)(b - field_interval(pen->field, row, 0));
        const int way = t->row > row ? 1 : -1;
        while (number >= 0 && row != t->row) {
            const size_t gap = way > 0 ? row : row - 1;
            int next = -1;
            for (size_t p = pen->field->first[gap]; p < pen->field->first[gap + 1]; p++) {
                const field_pair *pair = &pen->field->pair[p];
                if ((way > 0 ? pair->low : pair->high) == number)
                    next = way > 0 ? pair->high : pair->low;
            }
            number = next;
            row = way > 0 ? row + 1 : row - 1;
        }
        if (number >= 0 && field_interval(pen->field, row, number) == a) return true;
    }
    return false;
}

static bool name_tongues(const stability_pen *pen, const unsigned char *pixel) {
    size_t room = 1;
    for (size_t r = 0; r < pen->field->rows; r++) room += pen->field->map->row[r].intervals;
    tongue *list = calloc(room, sizeof *list), named[MOST_NAMES];
    if (list == NULL) return false;
    const size_t count = list_tongues(pen, list, room);
    box placed[MOST_NAMES];
    int names = 0;
    qsort(list, count, sizeof *list, by_width);
    for (size_t i = 0; i < count && names < MOST_NAMES; i++) {
        if (is_named(pen, &list[i], named, names)) continue;
        if (!place_name(pen, pixel, &list[i], placed, names)) continue;
        named[names++] = list[i];
    }
    free(list);
    return true;
}

/* ---- the picture ------------------------------------------------------------------------------------------------- */

static void write_ordinate(const stability_pen *pen) {
    const gough_map_options *o = pen->field->options;
    const char *title = "";
    if (o->axis == GOUGH_MAP_AMPLITUDE) title = "amplitude of the motion, factor on the study’s";
    if (o->axis == GOUGH_MAP_FREQUENCY) title = "frequency of the motion, factor on the study’s";
    if (o->axis == GOUGH_MAP_DAMPING) title = "damping of the feedback D";
    if (o->axis == GOUGH_MAP_PERIOD) title = "period of the controller";
    if (o->axis == GOUGH_MAP_DELAY) title = "delay of the controller";
    const bool timed = o->axis == GOUGH_MAP_PERIOD || o->axis == GOUGH_MAP_DELAY;
    const stability_words words = timed ? stability_unit(pen, GOUGH_UNIT_TIME, " (√(R_b/g))")
                                        : stability_unit(pen, GOUGH_UNIT_DAMPING, " (M √(g/R_b))");
    const char *unit = timed || o->axis == GOUGH_MAP_DAMPING ? words.text : "";
    axis_write(pen->file, &(axis){.name = "y",
                                  .logarithmic = o->second.logarithmic,
                                  .low = pen->view.low_y,
                                  .high = pen->view.high_y,
                                  .length = pen->panel_height});
    fprintf(pen->file, "set ylabel '%s%s' noenhanced offset character 0.6,character 0\n", title,
            unit);
}

static void write_plot(const stability_pen *pen) {
    fprintf(pen->file,
            "set border 15 front lw 0.8 lc rgb '%s'\nset xtics nomirror out scale 0.5\nset ytics "
            "nomirror out scale 0.5\n",
            stability_ink);
    stability_write_margins(pen, pen->top, pen->panel_height);
    stability_write_abscissa(pen, true);
    write_ordinate(pen);
    stability_write_thresholds(pen, pen->panel_height);
    fprintf(pen->file,
            "plot 'edges' using 1:($3 > 0 ? $2 : NaN) with lines lw 0.7 lc rgb '#ffffff' notitle, "
            "'edges' using 1:($3 > 0 ? NaN : $2) with lines lw 0.9 lc rgb '#2b0a52' notitle\n");
}

bool stability_write_plane(stability_pen *pen) {
    const field *f = pen->field;
    pen->left = LEFT;
    pen->panel_width = PANEL_WIDTH;
    pen->panel_height = PANEL_HEIGHT;
    pen->height = pen->top + pen->panel_height + STABILITY_BELOW;
    pen->view.width = FINE * PANEL_WIDTH;
    pen->view.height = FINE * PANEL_HEIGHT;
    const size_t length = 3 * (size_t)pen->view.width * (size_t)pen->view.height;
    unsigned char *pixel = calloc(length, 1);
    if (pixel == NULL) return false;
    field_paint(f, &pen->view, pixel);
    bool good = write_bytes(pen, "image", pixel, length) &&
                write_scale_raster(pen, pen->view.height) && write_edges(pen);

    char explanation[120];
    snprintf(explanation, sizeof explanation, "pale: nothing grows · colours: growth %s%s",
             f->resting ? "rate" : "in each period", field_has_gaps(f) ? " · grey: no value" : "");
    stability_write_frame(pen, explanation);
    stability_write_margins(pen, pen->top, pen->panel_height);
    plot_raster(pen, "image", pen->view.width, pen->view.height);
    fprintf(pen->file, "unset label 1\nunset label 2\n");
    if (f->greatest > 0) {
        write_scale_numbers(pen);
        plot_scale(pen, pen->view.height);
        fprintf(pen->file, "unset label\nunset arrow\n");
    }
    mark_edges(pen, pixel); /* the image is written: now it tells where names have room */
    good = name_tongues(pen, pixel) && good;
    write_plot(pen);
    free(pixel);
    return good;
}
