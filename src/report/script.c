/* A sheet as a gnuplot script and data files: positions, colours, ranges and labels; nothing is left to gnuplot's
 * defaults. Study text stands between single quotes and is never enhanced. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sheet.h"

/* Okabe and Ito's colours, told apart by colour-blind readers too; their yellow is too pale for a line. */
static const char *const palette[] = {"#0072b2", "#d55e00", "#009e73",
                                      "#cc79a7", "#e69f00", "#56b4e9"};
enum { PALETTE = sizeof palette / sizeof palette[0] };
static const char ink[] = "#333333", grey[] = "#555555", grid[] = "#e3e3e3";

/* Pixels of a sheet at its nominal size; PNG has twice as many. */
enum {
    BUCKETS = 700, /* of a thinned line: finer than a pixel of a panel */
    MARGIN_LEFT = 64,
    MARGIN_RIGHT = 26,
    TITLE_HEIGHT = 40,
    KEY_LINE = 20,
    HEADING = 30, /* above each panel */
    TICS = 22,    /* numbers below an abscissa */
    ABSCISSA = 24 /* its name */
};

typedef struct layout {
    int width, height, panel_width, panel_height, top, rows;
} layout;

typedef struct range {
    double low, high;
} range;

static layout lay_out(const sheet *s) {
    layout l = {0};
    l.rows = (s->count + s->columns - 1) / s->columns;
    const int room = s->columns > 1 ? 520 : 780;
    l.panel_width = room - MARGIN_LEFT - MARGIN_RIGHT;
    l.panel_height = s->count == 1 ? 340 : l.rows == 2 ? 210 : 150;
    l.width = s->columns * room;
    l.top = s->title[0] != '\0' ? TITLE_HEIGHT : 8;
    if (s->common_key) {
        const int entries = s->panel[0].count;
        l.top += KEY_LINE * (entries > 3 ? (entries + 2) / 3 : 1);
    }
    l.height = l.top + l.rows * (HEADING + TICS + l.panel_height) + ABSCISSA + 10;
    return l;
}

static void widen(range *r, double value) {
    if (!isfinite(value)) return;
    if (!(value >= r->low)) r->low = value;
    if (!(value <= r->high)) r->high = value;
}

static range empty_range(void) { return (range){NAN, NAN}; }

static range abscissa_range(const sheet *s) {
    range r = empty_range();
    for (int p = 0; p < s->count; p++) {
        for (int i = 0; i < s->panel[p].count; i++) {
            const series *line = &s->panel[p].series[i];
            for (size_t k = 0; k < line->count; k++) {
                if (!s->logarithmic_abscissa || line->x[k] > 0.0) widen(&r, line->x[k]);
            }
        }
    }
    if (isfinite(s->from)) r.low = s->from;
    if (isfinite(s->to)) r.high = s->to;
    if (!(r.high > r.low)) {
        const double centre = isfinite(r.low) ? r.low : 0.0;
        const double half = 0.5 * fmax(fabs(centre), 1.0);
        r = (range){centre - half, centre + half};
    } else if (s->logarithmic_abscissa) {
        r = (range){r.low / 1.4, r.high * 1.4};
    }
    return r;
}

static range ordinate_range(const panel *p) {
    range r = empty_range();
    for (int i = 0; i < p->count; i++) {
        const series *line = &p->series[i];
        for (size_t k = 0; k < line->count; k++) {
            if (!p->logarithmic || line->y[k] > 0.0) widen(&r, line->y[k]);
        }
    }
    return r;
}

/* Exponent of 1000 that brings the numbers of a panel between 0.01 and 10 000; 0 where they are, or nearly all are 0. */
static int power_of_panel(const panel *p, range r) {
    const double greatest = fmax(fabs(r.low), fabs(r.high));
    if (p->logarithmic || !isfinite(greatest) || greatest < 1e-18) return 0;
    return greatest >= 1e4 || greatest < 1e-2 ? (int)floor(log10(greatest) / 3.0) : 0;
}

/* Room above and below the numbers; a constant line stands in the middle, at a range that hides round-off. */
static range padded(const panel *p, range r) {
    if (!isfinite(r.low)) return p->logarithmic ? (range){1e-16, 1.0} : (range){-1.0, 1.0};
    if (p->logarithmic) {
        /* whole decades, at least two, at most twenty */
        double low = floor(log10(r.low)), high = ceil(log10(r.high));
        if (high - low < 2.0) high = low + 2.0;
        if (high - low > 20.0) low = high - 20.0;
        return (range){pow(10.0, low), pow(10.0, high)};
    }
    const double greatest = fmax(fabs(r.low), fabs(r.high));
    double margin = 0.06 * (r.high - r.low);
    if (!(r.high - r.low > 1e-9 * greatest)) margin = greatest > 0.0 ? 0.05 * greatest : 1.0;
    return (range){r.low - margin, r.high + margin};
}

/* ---- data ------------------------------------------------------------------------------------------------------ */

static bool drawable(const sheet *s, const panel *p, double x, double y) {
    return isfinite(x) && isfinite(y) && (!s->logarithmic_abscissa || x > 0.0) &&
           (!p->logarithmic || y > 0.0);
}

/* One line's points, thinned; a blank line where it is interrupted. Points that ended early have a 1 behind them. */
static bool write_data(const sheet *s, const panel *p, const series *line, double scale,
                       const char *path) {
    size_t *index = malloc((2 * BUCKETS + 2) * sizeof *index);
    FILE *file = fopen(path, "w");
    bool good = index != NULL && file != NULL;
    const size_t kept = good ? sheet_thin(line->x, line->y, line->count, BUCKETS, index) : 0;
    size_t drawn = 0;
    for (size_t k = 0; k < kept; k++) {
        const size_t i = index[k];
        if (drawable(s, p, line->x[i], line->y[i])) {
            fprintf(file, "%.9g %.7g %d\n", line->x[i], line->y[i] / scale,
                    line->ended != NULL && line->ended[i] > 0.5);
            drawn++;
        } else {
            fprintf(file, "\n");
        }
    }
    /* gnuplot takes a file without a point for an error */
    if (good && drawn == 0) fprintf(file, "NaN NaN 0\n");
    if (file != NULL) {
        good = ferror(file) == 0 && good;
        good = fclose(file) == 0 && good;
    }
    free(index);
    return good;
}

/* ---- script ---------------------------------------------------------------------------------------------------- */

static void write_terminal(FILE *file, const layout *l, sheet_format format) {
    const double inch = 100.0; /* pixels of the nominal size in an inch of paper */
    if (format == SHEET_PNG)
        fprintf(file,
                "set terminal pngcairo size %d,%d enhanced font 'DejaVu Sans,9' fontscale 2 "
                "linewidth 2 pointscale 2 background rgb 'white'\n",
                2 * l->width, 2 * l->height);
    else if (format == SHEET_SVG)
        fprintf(file,
                "set terminal svg size %d,%d enhanced font 'DejaVu Sans,12' background rgb "
                "'white' rounded\n",
                l->width, l->height);
    else
        fprintf(file,
                "set terminal pdfcairo size %.3fin,%.3fin enhanced font 'DejaVu Sans,8.6' "
                "linewidth 1 background rgb 'white' rounded\n",
                l->width / inch, l->height / inch);
}

static void write_frame(FILE *file, const sheet *s, const layout *l) {
    char quoted[2 * SHEET_TEXT];
    fprintf(file, "set encoding utf8\nset output 'figure'\nset multiplot\n");
    fprintf(file, "set border 3 lw 0.8 lc rgb '%s'\n", ink);
    fprintf(file, "set grid back lt 1 dt 1 lw 0.7 lc rgb '%s'\n", grid);
    fprintf(file, "set tics nomirror out scale 0.5 textcolor rgb '%s'\n", ink);
    if (s->title[0] == '\0') return;
    sheet_quote(quoted, sizeof quoted, s->title, s->columns > 1 ? 110 : 80);
    fprintf(file,
            "set label 1 '%s' at screen %.6f,screen %.6f left noenhanced font ':Bold,%s' "
            "textcolor rgb 'black'\n",
            quoted, (double)MARGIN_LEFT / l->width, 1.0 - 22.0 / l->height, "*1.25");
}

static void write_line_style(FILE *file, const series *line) {
    static const char *const dashes[] = {"1", "(8,4)", "(2,3)", "(10,4,2,4)"};
    if (line->colour < 0)
        fprintf(file, "with lines lw 1.1 dt (5,4) lc rgb '%s'", grey);
    else
        fprintf(file, "with %s lw %s dt %s lc rgb '%s'%s", line->points ? "linespoints" : "lines",
                "1.7", dashes[line->dash % 4], palette[line->colour % PALETTE],
                line->points ? " pt 7 ps 0.55" : "");
}

static void write_key(FILE *file, const sheet *s, const layout *l, int number) {
    if (!s->common_key) {
        fprintf(file, "set key at graph 1.0,graph 1.0 right bottom horizontal Left reverse "
                      "samplen 1.6 width -1 height 0.4 maxrows 1\n");
    } else if (number == 0) {
        fprintf(file,
                "set key at screen %.6f,screen %.6f left top horizontal Left reverse samplen 2 "
                "width 1 maxcols 3\n",
                (double)MARGIN_LEFT / l->width,
                1.0 - (double)(s->title[0] != '\0' ? TITLE_HEIGHT - 6 : 4) / l->height);
    } else {
        fprintf(file, "unset key\n");
    }
}

/* Scales, ranges and texts around one panel. */
static void write_axes(FILE *file, const sheet *s, const layout *l, int number, range x, range y,
                       int power) {
    const panel *p = &s->panel[number];
    const int row = number / s->columns, column = number % s->columns;
    const int left = column * (l->width / s->columns) + MARGIN_LEFT;
    const int top = l->top + HEADING + row * (HEADING + TICS + l->panel_height);
    const bool last = number + s->columns >= s->count;
    char heading[SHEET_TEXT + 64], unit[48], quoted[2 * SHEET_TEXT];

    fprintf(file, "set lmargin at screen %.6f\nset rmargin at screen %.6f\n",
            (double)left / l->width, (double)(left + l->panel_width) / l->width);
    fprintf(file, "set tmargin at screen %.6f\nset bmargin at screen %.6f\n",
            1.0 - (double)top / l->height, 1.0 - (double)(top + l->panel_height) / l->height);
    fprintf(file, "%s logscale x\n%s logscale y\n", s->logarithmic_abscissa ? "set" : "unset",
            p->logarithmic ? "set" : "unset");
    fprintf(file, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", x.low, x.high, y.low, y.high);
    fprintf(file, "set format x '%s'\n", s->logarithmic_abscissa ? "%g" : "%g");
    if (p->logarithmic) {
        const int step = (int)ceil(log10(y.high / y.low) / 6.5);
        fprintf(file, "set format y '10^{%%T}'\nset ytics autofreq 1e%d\nset mytics default\n",
                step);
    } else {
        fprintf(file, "set format y '%%g'\nset ytics autofreq\n");
    }

    sheet_unit_label(unit, sizeof unit, p->unit, power);
    snprintf(heading, sizeof heading, "%s%s", p->heading, unit);
    sheet_quote(quoted, sizeof quoted, heading, 80);
    fprintf(file,
            "set label 2 '%s' at graph 0,graph 1 left offset character 0,character 0.75 "
            "noenhanced textcolor rgb 'black'\n",
            quoted);
    if (last) {
        sheet_quote(quoted, sizeof quoted, s->abscissa, 80);
        fprintf(file, "set xlabel '%s' noenhanced offset character 0,character 0.4\n", quoted);
    } else {
        fprintf(file, "unset xlabel\n");
    }
    write_key(file, s, l, number);
}

/* Points that ended early are ringed in the same colour on white. */
static void write_plot(FILE *file, const sheet *s, int number, int first_data) {
    const panel *p = &s->panel[number];
    char quoted[2 * SHEET_TEXT];
    fprintf(file, "plot ");
    for (int i = 0; i < p->count; i++) {
        const series *line = &p->series[i];
        fprintf(file, "%s'data-%d' using 1:2 ", i > 0 ? ", \\\n     " : "", first_data + i);
        write_line_style(file, line);
        sheet_quote(quoted, sizeof quoted, line->label, s->common_key ? 40 : 28);
        if (line->label[0] != '\0')
            fprintf(file, " title '%s' noenhanced", quoted);
        else
            fprintf(file, " notitle");
        if (line->ended == NULL) continue;
        fprintf(file,
                ", \\\n     'data-%d' using 1:($3 > 0 ? $2 : NaN) with points pt 7 ps 0.6 lc rgb "
                "'white' notitle, \\\n     'data-%d' using 1:($3 > 0 ? $2 : NaN) with points pt 6 "
                "ps 0.75 lw 1.5 lc rgb '%s' title 'ended early' noenhanced",
                first_data + i, first_data + i, palette[line->colour % PALETTE]);
    }
    fprintf(file, "\nunset label\n");
}

static bool write_panels(FILE *file, const sheet *s, const layout *l, const char *folder) {
    const range x = abscissa_range(s);
    char path[256];
    bool good = true;
    int data = 0;
    for (int number = 0; number < s->count && good; number++) {
        const panel *p = &s->panel[number];
        const range found = ordinate_range(p);
        const int power = power_of_panel(p, found);
        const double scale = pow(1000.0, power);
        range y = padded(p, found);
        y = (range){y.low / scale, y.high / scale};
        write_axes(file, s, l, number, x, y, power);
        write_plot(file, s, number, data);
        for (int i = 0; i < p->count && good; i++, data++) {
            snprintf(path, sizeof path, "%s/data-%d", folder, data);
            good = write_data(s, p, &p->series[i], scale, path);
        }
    }
    return good;
}

gough_status sheet_write_script(const sheet *s, sheet_format format, const char *folder,
                                gough_error *error) {
    char path[256];
    snprintf(path, sizeof path, "%s/script", folder);
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t before = plain != (locale_t)0 ? uselocale(plain) : (locale_t)0;
    FILE *file = plain != (locale_t)0 ? fopen(path, "w") : NULL;
    bool good = file != NULL;
    if (good) {
        const layout l = lay_out(s);
        write_terminal(file, &l, format);
        write_frame(file, s, &l);
        good = write_panels(file, s, &l, folder);
        fprintf(file, "unset multiplot\nunset output\n");
        good = ferror(file) == 0 && good;
        good = fclose(file) == 0 && good;
    }
    if (plain != (locale_t)0) {
        uselocale(before);
        freelocale(plain);
    }
    if (good) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: the figure's data cannot be written: %s",
                      folder, strerror(errno));
}
