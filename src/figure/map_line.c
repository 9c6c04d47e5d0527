/* A stability map over the stiffness alone: growth above, and below a lane for each mode with the intervals in which it grows. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "figure/map_figure.h"
#include "figure/palette.h"

enum {
    LEFT = 118,
    RIGHT = 26,
    PANEL_HEIGHT = 250,
    LANE = 22, /* height of a lane, and its bar */
    BAR = 12,
    LANES_GAP = 12,
    MOST_LANES = 8
};

/* As in other figures; modes beyond these are grey. */
enum { COLOURED = 6 };
static const char *colour_of(int lane) {
    return lane < COLOURED ? colour_text(colour_of_table((size_t)lane)) : "#777777";
}

/* ---- modes ------------------------------------------------------------------------------------------------------- */

/* Names of the modes that grow somewhere, in the order in which they come. */
static int list_modes(const field *f, const char *name[MOST_LANES]) {
    int count = 0;
    for (int i = 0; i < (int)f->map->row[0].intervals; i++) {
        const char *own = field_interval(f, 0, i)->mode.name;
        int n = 0;
        while (n < count && strcmp(name[n], own) != 0) n++;
        if (n == count && count < MOST_LANES) name[count++] = own;
    }
    return count;
}

int stability_lanes(const field *f) {
    const char *name[MOST_LANES];
    return list_modes(f, name);
}

/* ---- the panel --------------------------------------------------------------------------------------------------- */

/* Whether a point of the grid between two stiffnesses has no values. */
static bool is_gap(const field *f, double from, double to) {
    const gough_map_range *range = &f->options->stiffness;
    for (size_t i = 0; i < range->count; i++) {
        const double x = gough_map_value(range, i);
        if (x > from && x < to && field_gap(f, 0, i)) return true;
    }
    return false;
}

/* Points of the line, on the scale of colours of maps over two axes, where weak growth has room. */
static bool write_growth(const stability_pen *pen) {
    const field *f = pen->field;
    FILE *file = stability_open(pen, "growth");
    if (file == NULL) return false;
    for (size_t i = 0; i < f->count[0]; i++) {
        if (i > 0 && is_gap(f, f->node[i - 1].x, f->node[i].x)) fprintf(file, "\n");
        fprintf(file, "%.9g %.9g\n", f->node[i].x, field_shade(f, f->node[i].level));
    }
    if (f->count[0] == 0) fprintf(file, "NaN NaN\n");
    const bool good = ferror(file) == 0;
    return fclose(file) == 0 && good;
}

static void write_ordinate(const stability_pen *pen) {
    const field *f = pen->field;
    stability_tic tic[STABILITY_TICS];
    const int tics = stability_list_tics(f, 20.0 / pen->panel_height, tic);
    fprintf(pen->file, "unset logscale y\nset yrange [0:1.03]\nset ytics (");
    for (int i = 0; i < tics; i++)
        fprintf(pen->file, "%s'%s' %.6f", i ? ", " : "", tic[i].text, tic[i].shade);
    fprintf(pen->file, ")\nset ylabel '%s%s' noenhanced offset character 0.2,character 0\n",
            f->resting ? "growth rate" : "growth in each period",
            f->resting ? stability_unit(pen, GOUGH_UNIT_RATE, " (√(g/R_b))").text : "");
}

/* Behind the line a band for every interval. */
static void write_bands(const stability_pen *pen) {
    const field *f = pen->field;
    for (int i = 0; i < (int)f->map->row[0].intervals; i++) {
        const gough_interval *one = field_interval(f, 0, i);
        fprintf(pen->file,
                "set object rectangle from %.9g,graph 0 to %.9g,graph 1 behind fillstyle solid "
                "noborder fillcolor rgb '#fdebdc'\n",
                fmax(one->from, pen->view.low_x), fmin(one->to, pen->view.high_x));
    }
}

static void plot_growth(const stability_pen *pen) {
    const field *f = pen->field;
    FILE *file = pen->file;
    fprintf(file,
            "set border 3 lw 0.8 lc rgb '%s'\nset grid y back lt 1 dt 1 lw 0.7 lc rgb '#e6e6e6'\n",
            stability_ink);
    stability_write_margins(pen, pen->top, pen->panel_height);
    stability_write_abscissa(pen, false);
    write_ordinate(pen);
    write_bands(pen);
    stability_write_thresholds(pen, pen->panel_height + LANES_GAP + LANE * stability_lanes(f));
    fprintf(
        file,
        "plot 'growth' using 1:2 with filledcurves y1=0 fillstyle transparent solid 0.35 "
        "noborder fillcolor rgb '#b73779' notitle, 'growth' using 1:2 with lines lw 1.5 lc rgb "
        "'#8c2981' notitle\nunset label\nunset arrow\nunset object\nunset ylabel\nunset grid\n");
}

/* ---- lanes ------------------------------------------------------------------------------------------------------- */

static void write_bars(const stability_pen *pen, const char *const *mode, int modes, int top) {
    const field *f = pen->field;
    for (int i = 0; i < (int)f->map->row[0].intervals; i++) {
        const gough_interval *one = field_interval(f, 0, i);
        int lane = 0;
        while (lane + 1 < modes && strcmp(mode[lane], one->mode.name) != 0) lane++;
        const double y = top + LANE * lane + 0.5 * (LANE - BAR);
        const double from = stability_place_x(pen, fmax(one->from, pen->view.low_x));
        const double to = stability_place_x(pen, fmin(one->to, pen->view.high_x));
        const bool still = one->kind == GOUGH_INTERVAL_STATIC ||
                           (f->resting && one->kind != GOUGH_INTERVAL_OSCILLATION);
        /* a bar as thin as a line is drawn by its border */
        fprintf(
            pen->file,
            "set object rectangle from screen %.6f,screen %.6f to screen %.6f,screen %.6f front "
            "fillstyle %s border lc rgb '%s' lw 1 fillcolor rgb '%s'\n",
            stability_screen_x(from), stability_screen_y(pen, y), stability_screen_x(to),
            stability_screen_y(pen, y + BAR), still ? "solid 0.35" : "solid 1", colour_of(lane),
            colour_of(lane));
    }
}

static void plot_lanes(const stability_pen *pen) {
    const char *mode[MOST_LANES];
    const int modes = list_modes(pen->field, mode);
    const int top = pen->top + pen->panel_height + LANES_GAP;
    FILE *file = pen->file;
    for (int lane = 0; lane < modes; lane++)
        fprintf(file,
                "set label '%s' at screen %.6f,screen %.6f right noenhanced font ',%.4g' textcolor "
                "rgb '%s'\n",
                mode[lane], stability_screen_x(pen->left - 10),
                stability_screen_y(pen, top + LANE * (lane + 0.5)),
                stability_size(pen, STABILITY_SMALL), colour_of(lane));
    write_bars(pen, mode, modes, top);
    fprintf(file, "set border 1 lw 0.8 lc rgb '%s'\nunset ytics\n", stability_ink);
    stability_write_margins(pen, top, LANE * modes > 0 ? LANE * modes : 1);
    stability_write_abscissa(pen, true);
    fprintf(file, "set yrange [0:1]\nplot NaN notitle\n");
}

bool stability_write_line(stability_pen *pen) {
    pen->left = LEFT;
    pen->panel_width = STABILITY_WIDTH - LEFT - RIGHT;
    pen->panel_height = PANEL_HEIGHT;
    pen->height =
        pen->top + PANEL_HEIGHT + LANES_GAP + LANE * stability_lanes(pen->field) + STABILITY_BELOW;
    const bool sampled = pen->field->map->row[0].sampling > 0;
    stability_write_frame(
        pen, pen->field->resting ? "at rest · bars: a mode grows"
             : sampled
                 ? "bars: a mode grows, below its threshold (pale) or by resonance or delay (full)"
                 : "bars: a mode grows, below its threshold (pale) or by resonance (full)");
    const bool good = write_growth(pen);
    plot_growth(pen);
    plot_lanes(pen);
    return good;
}
