/* A sheet as a gnuplot script and data files: positions, colours, ranges and labels; nothing is left to gnuplot's
 * defaults. Study text stands between single quotes, has none itself, and is never enhanced. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure/axis_ranges.h"
#include "figure/bands.h"
#include "figure/line_ends.h"
#include "figure/palette.h"
#include "figure/sheet.h"
#include "figure/ticks.h"

static const char ink[] = "#333333", pale[] = "#c9c9c9", grid[] = "#e6e6e6", alarm[] = "#b03a00";

/* Pixels of a sheet at its nominal size; PNG has twice as many. */
enum {
    BUCKETS = 700, /* of a thinned line: finer than a pixel of a panel */
    MARGIN_LEFT = 64,
    MARGIN_RIGHT = 26,
    NOTE_HEIGHT = 18, /* of a line of a note below the title */
    NOTE_LINES = 3,
    TITLE_HEIGHT = 34,
    KEY_LINE = 18,
    KEY_ROW = 14,    /* of a key between a heading and a narrow panel */
    KEY_SAMPLE = 34, /* the sample of a line in it, and the gap to the next */
    KEY_TEXT = 60,   /* characters of a table's name */
    HEADING = 30,    /* above each panel */
    TICS = 22,       /* numbers below an abscissa */
    ABSCISSA = 24,   /* its name */
    MAP_LEFT = 22,   /* more at the left of a map, for the name of its ordinate */
    MAP_RIGHT = 66,  /* and at its right, for the scale of its colours */
    COLOUR_GAP = 14, /* between the map and that scale */
    COLOUR_WIDTH = 14,
    COLOURS = 12,      /* steps of that scale */
    LOOP_STEPS = 2000, /* of a thinned loop along each axis */
    NARROW = 420,      /* a panel that has no room for its key beside its heading */
    LEAST_ROOM = 330,  /* of panels beside each other */
    LABEL_GAP = 14,    /* of numbers from their axis, its ticks between */
    TEXT = 12,         /* sizes of text */
    SMALL_TEXT = 11,
    TITLE_TEXT = 14
};

typedef struct layout {
    int width, height, left, right, panel_width, panel_height, top, rows, key_columns;
    int columns; /* of panels */
    int heading; /* room above each panel */
} layout;

static bool has_map(const sheet *s) { return s->count > 0 && s->panel[0].mapped; }

/* Ranges of all axes, chosen before the layout: their labels decide on the margins. */
typedef struct ranges {
    range x;
    scaled_range y[SHEET_PANELS], z[SHEET_PANELS];
} ranges;

static axis ordinate_axis(const panel *p, range r, double length) {
    return (axis){.name = "y",
                  .logarithmic = p->mapped ? p->map.logarithmic_y : p->logarithmic,
                  .low = r.low,
                  .high = r.high,
                  .length = length};
}

static axis colour_axis(const panel *p, range r, double length) {
    return (axis){.name = "cb",
                  .logarithmic = p->logarithmic,
                  .low = r.low,
                  .high = r.high,
                  .length = length};
}

static int label_room(const axis *a) {
    tick_list list;
    tick_choose(a, &list);
    return LABEL_GAP + (int)ceil(tick_label_width(&list));
}

static int greater(int a, int b) { return a > b ? a : b; }

/* Margins at the left and the right of each panel: for the numbers of all of them. */
static void lay_out_margins(const sheet *s, const ranges *r, layout *l) {
    l->left = MARGIN_LEFT;
    l->right = greater(MARGIN_RIGHT, s->print ? line_ends_room(s) : 0);
    for (int i = 0; i < s->count; i++) {
        const panel *p = &s->panel[i];
        const axis y = ordinate_axis(p, r->y[i].range, l->panel_height);
        const int title = p->mapped ? MAP_LEFT : 0;
        l->left = greater(l->left, title + greater(MARGIN_LEFT, label_room(&y)));
        if (!p->mapped) continue;
        const axis z = colour_axis(p, r->z[i].range, l->panel_height);
        const int scale = COLOUR_GAP + COLOUR_WIDTH + label_room(&z);
        l->right = greater(l->right, MARGIN_RIGHT + greater(MAP_RIGHT, scale));
    }
}

static bool headed(const sheet *s) { return s->title[0] != '\0' || s->note[0] != '\0'; }

/* Whether the note is too long to stand beside the title, and has lines of its own. */
static bool note_below(const sheet *s) { return strlen(s->note) > 30 && s->title[0] != '\0'; }

/* Characters of a line of the note: small text takes 0.54 of its size for each at most, on average. */
static size_t note_room(const layout *l) {
    return (size_t)((l->width - l->left - MARGIN_RIGHT) / (0.54 * SMALL_TEXT));
}

static int note_lines(const sheet *s, const layout *l) {
    const char *rest = s->note;
    int lines = 0;
    for (; *rest != '\0' && lines < NOTE_LINES; lines++) rest += sheet_line(rest, note_room(l));
    return lines;
}

/* Lines of the note below the line of the title. */
static int lines_below(const sheet *s, const layout *l) {
    const int lines = note_lines(s, l);
    return note_below(s) || lines == 0 ? lines : lines - 1;
}

/* Entries of a panel's key, and the room that each takes. */
static int key_entries(const panel *p, int *entry_width) {
    int entries = 0;
    size_t longest = 1;
    for (int i = 0; i < p->count; i++) {
        const size_t length = strlen(p->series[i].label);
        if (length > longest) longest = length;
        entries += length > 0;
    }
    *entry_width = 60 + 7 * (int)(longest < KEY_TEXT ? longest : KEY_TEXT);
    return entries;
}

/* Whether keys stand between headings and panels, which are too narrow for both in one line. */
static bool has_key_rows(const sheet *s, const layout *l) {
    return !s->common_key && s->width > 0 && l->panel_width <= NARROW;
}

/* Columns and rows of the key of a panel; a line alone needs none. */
static int key_columns(const layout *l, const panel *p) {
    int width;
    (void)key_entries(p, &width);
    width -= 60 - KEY_SAMPLE;
    return l->panel_width > width ? l->panel_width / width : 1;
}

static int key_rows(const sheet *s, const layout *l, const panel *p) {
    int width;
    const int entries = key_entries(p, &width), columns = key_columns(l, p);
    return entries > 0 && has_key_rows(s, l) ? (entries + columns - 1) / columns : 0;
}

static void lay_out_keys(const sheet *s, layout *l) {
    int most = 0;
    for (int i = 0; i < s->count; i++) most = greater(most, key_rows(s, l, &s->panel[i]));
    l->heading = HEADING + KEY_ROW * most;
}

static layout lay_out(const sheet *s, const ranges *r) {
    layout l = {.columns = s->columns};
    if (s->width > 0 && s->width / l.columns < LEAST_ROOM) l.columns = 1;
    l.rows = (s->count + l.columns - 1) / l.columns;
    const int room = s->width > 0 ? s->width / l.columns : l.columns > 1 ? 520 : 780;
    l.panel_height = s->count == 1 || has_map(s) ? 340 : l.rows == 2 ? 210 : 150;
    /* a narrow panel is no higher than it is wide */
    if (l.panel_height > 2 * room / 3) l.panel_height = 2 * room / 3;
    lay_out_margins(s, r, &l);
    l.panel_width = room - l.left - l.right;
    l.width = s->width > 0 ? s->width : l.columns * room;
    lay_out_keys(s, &l);
    l.top = headed(s) ? TITLE_HEIGHT : 8;
    l.top += NOTE_HEIGHT * lines_below(s, &l);
    if (s->common_key) {
        int entry_width;
        const int entries = key_entries(&s->panel[0], &entry_width);
        l.key_columns = l.panel_width > entry_width ? l.panel_width / entry_width : 1;
        l.top += KEY_LINE * ((entries + l.key_columns - 1) / l.key_columns);
    }
    l.height = l.top + l.rows * (l.heading + TICS + l.panel_height) + ABSCISSA + 10;
    return l;
}

static bool has_negative(const panel *p) {
    for (int i = 0; i < p->count; i++) {
        for (size_t k = 0; k < p->series[i].count; k++) {
            if (p->series[i].y[k] < 0.0) return true;
        }
    }
    return false;
}

/* What a part of the script needs to know. */
typedef struct drawing {
    FILE *file;
    const sheet *sheet;
    const ranges *ranges;
    layout layout;
    sheet_format format;
} drawing;

/* ---- data ------------------------------------------------------------------------------------------------------ */

static bool drawable(const sheet *s, const panel *p, double x, double y) {
    return isfinite(x) && isfinite(y) && (!s->logarithmic_abscissa || x > 0.0) &&
           panel_drawn(p, y) > (p->logarithmic ? 0.0 : -INFINITY);
}

/* One line's points, thinned; a blank line where it is interrupted. Points that ended early have a 1 behind them. */
static bool write_data(const drawing *pen, const panel *p, const series *line, double scale,
                       const char *path) {
    const sheet *s = pen->sheet;
    const range x = pen->ranges->x;
    const int pixels = pen->layout.panel_width;
    const bool band = band_needed(p, line, x, pixels);
    const size_t room = line->loop ? line->count + 1 : 2 * BUCKETS + 2;
    size_t *index = malloc(room * sizeof *index);
    FILE *file = fopen(path, "w");
    bool good = index != NULL && file != NULL;
    size_t points = 0, kept = 0;
    if (good && band)
        points = band_write(file, p, line, x, pixels, scale);
    else if (good && line->loop)
        kept = sheet_thin_loop(line->x, line->y, line->count, 1.0 / LOOP_STEPS, index);
    else if (good)
        kept = sheet_thin(line->x, line->y, line->count, BUCKETS, index);
    /* a staircase rises from zero at its first point */
    if (kept > 0 && line->steps && !p->logarithmic && drawable(s, p, line->x[0], 0.0))
        fprintf(file, "%.15g 0 0\n", line->x[0]);
    for (size_t k = 0; k < kept; k++) {
        const size_t i = index[k];
        if (drawable(s, p, line->x[i], line->y[i])) {
            fprintf(file, "%.15g %.15g %d\n", line->x[i], panel_drawn(p, line->y[i]) / scale,
                    line->ended != NULL && line->ended[i] > 0.5);
            points++;
        } else {
            fprintf(file, "\n");
        }
    }
    /* gnuplot takes a file without a point for an error */
    if (good && points == 0) fprintf(file, "NaN NaN 0\n");
    if (file != NULL) {
        good = ferror(file) == 0 && good;
        good = fclose(file) == 0 && good;
    }
    free(index);
    return good;
}

/* ---- script ---------------------------------------------------------------------------------------------------- */

/* PNG in points of 96 to the inch, SVG in pixels, PDF in points of a page with 100 nominal pixels to the inch. */
double sheet_font_size(sheet_format format, double pixels) {
    static const double factor[] = {[SHEET_PNG] = 0.75, [SHEET_SVG] = 1.0, [SHEET_PDF] = 0.72};
    return pixels * factor[format];
}

static double font_size(const drawing *pen, double pixels) {
    return sheet_font_size(pen->format, pixels);
}

/* Nominal pixels from the left and from the top as gnuplot's fractions of the sheet. */
static double screen_x(const drawing *pen, double x) { return x / pen->layout.width; }
static double screen_y(const drawing *pen, double y) { return 1.0 - y / pen->layout.height; }

void sheet_write_terminal(FILE *file, sheet_format format, const sheet_facts *picture) {
    const double size = sheet_font_size(format, TEXT);
    const int width = picture->width, height = picture->height;
    const double inch = picture->inch > 0.0 ? picture->inch : 1.0;
    const double dots = 0.01 * inch * (picture->dpi > 0.0 ? picture->dpi : 200.0);
    if (format == SHEET_PNG)
        fprintf(file,
                "set terminal pngcairo size %.0f,%.0f enhanced font 'DejaVu Sans,%.4g' fontscale "
                "%.5g linewidth %.5g pointscale %.5g background rgb 'white'\n",
                dots * width, dots * height, size, dots, dots, dots);
    else if (format == SHEET_SVG)
        fprintf(file,
                "set terminal svg size %d,%d enhanced font 'DejaVu Sans,%.4g' background rgb "
                "'white' butt\n",
                width, height, size);
    else
        fprintf(file,
                "set terminal pdfcairo size %.2fin,%.2fin enhanced font 'DejaVu Sans,%.4g' "
                "fontscale %.5g linewidth %.5g pointscale %.5g background rgb 'white' butt\n",
                inch * width / 100.0, inch * height / 100.0, size, 0.75 * inch, 1.5 * inch,
                0.75 * inch);
}

/* The note, beside the title if it is short, else in lines below; the last one is cut if they are too many. */
static void write_note(const drawing *pen) {
    const bool below = note_below(pen->sheet);
    const size_t room = note_room(&pen->layout);
    const int lines = note_lines(pen->sheet, &pen->layout);
    const char *rest = pen->sheet->note;
    for (int i = 0; i < lines; i++) {
        char line[SHEET_NOTE], quoted[2 * SHEET_NOTE];
        const size_t taken = i + 1 < lines ? sheet_line(rest, room) : strlen(rest);
        snprintf(line, sizeof line, "%.*s", (int)taken, rest);
        /* the blank at the end of a line is no character of it */
        sheet_quote(quoted, sizeof quoted, line, room + (i + 1 < lines));
        fprintf(pen->file,
                "set label %d '%s' at screen %.6f,screen %.6f %s noenhanced font ',%.4g' textcolor "
                "rgb '%s'\n",
                3 + i, quoted,
                screen_x(pen, below ? pen->layout.left : pen->layout.width - MARGIN_RIGHT),
                screen_y(pen, 22 + NOTE_HEIGHT * (i + below)), below ? "left" : "right",
                font_size(pen, SMALL_TEXT), pen->sheet->alarming ? alarm : ink);
        rest += taken;
    }
}

/* What all panels share, and the title. */
static void write_frame(const drawing *pen) {
    FILE *file = pen->file;
    char quoted[2 * SHEET_TEXT];
    fprintf(file, "set encoding utf8\nset minussign\nset output 'figure'\nset multiplot\n");
    fprintf(file, "set border 3 lw 0.8 lc rgb '%s'\n", ink);
    fprintf(file, "set grid back lt 1 dt 1 lw 0.7 lc rgb '%s'\n", grid);
    fprintf(file, "set tics nomirror out scale 0.5 textcolor rgb '%s' font ',%.4g'\n", ink,
            font_size(pen, SMALL_TEXT));
    sheet_quote(quoted, sizeof quoted, pen->sheet->title, pen->sheet->columns > 1 ? 90 : 65);
    fprintf(file,
            "set label 1 '%s' at screen %.6f,screen %.6f left noenhanced font 'DejaVu "
            "Sans:Bold,%.4g' textcolor rgb 'black'\n",
            quoted, screen_x(pen, pen->layout.left), screen_y(pen, 22), font_size(pen, TITLE_TEXT));
    write_note(pen);
}

static void write_line_style(FILE *file, const series *line, int print) {
    if (line->limit) {
        fprintf(file, "with lines lw 1.4 dt (6,4) lc rgb '%s'", alarm);
        return;
    }
    if (line->colour < 0) {
        fprintf(file, "with lines lw 5 lc rgb '%s'", pale);
        return;
    }
    const char *colour = colour_text(line->colour);
    if (line->mark) {
        fprintf(file, "with points pt 7 ps 1.1 lc rgb '%s'", colour);
        return;
    }
    /* beyond the palette, dashes tell lines apart */
    static const char *const dashes[] = {"1", "(9,5)", "(2,3)", "(9,4,2,4)"};
    static const char *const printed[] = {"1",          "(12,4)",    "(5,3.5)",
                                          "(10,3,2,3)", "(1.5,2.5)", "(10,3,1.5,2,1.5,2,1.5,3)"};
    fprintf(file, "with %s lw 1.6 dt %s lc rgb '%s'%s",
            line->points  ? "linespoints"
            : line->steps ? "steps"
                          : "lines",
            print >= 0 ? printed[print % 6] : dashes[colour_round(line->colour) % 4], colour,
            line->points ? " pt 7 ps 0.55" : "");
}

/* The key stands beside the heading of each panel, or once under the title. */
static void write_key(const drawing *pen, int number) {
    const double size = font_size(pen, SMALL_TEXT);
    const int below = NOTE_HEIGHT * lines_below(pen->sheet, &pen->layout);
    if (has_key_rows(pen->sheet, &pen->layout))
        fprintf(pen->file,
                "set key at graph 0,graph 1 left bottom horizontal Left reverse samplen 1.8 width "
                "0 height 0.3 maxcols %d font ',%.4g'\n",
                key_columns(&pen->layout, &pen->sheet->panel[number]), size);
    else if (!pen->sheet->common_key)
        fprintf(pen->file,
                "set key at graph 1,graph 1 right bottom horizontal Left reverse samplen 1.3 "
                "width -0.5 height 0.3 maxrows 1 font ',%.4g'\n",
                size);
    else if (number == 0)
        fprintf(pen->file,
                "set key at screen %.6f,screen %.6f left top horizontal Left reverse samplen 1.8 "
                "width 1 maxcols %d font ',%.4g'\n",
                screen_x(pen, pen->layout.left),
                screen_y(pen, below + (headed(pen->sheet) ? TITLE_HEIGHT + 4 : 8)),
                pen->layout.key_columns, size);
    else
        fprintf(pen->file, "unset key\n");
}

/* Place, scales and texts of one panel. */
static void write_axes(const drawing *pen, int number, int power) {
    const sheet *s = pen->sheet;
    const layout *l = &pen->layout;
    const panel *p = &s->panel[number];
    const int row = number / l->columns, column = number % l->columns;
    const int left = column * (l->width / l->columns) + l->left;
    const range x = pen->ranges->x;
    const int top = l->top + l->heading + row * (l->heading + TICS + l->panel_height);
    FILE *file = pen->file;
    char heading[SHEET_TEXT + 64], unit[48], quoted[2 * SHEET_TEXT];

    fprintf(file, "set lmargin at screen %.6f\nset rmargin at screen %.6f\n", screen_x(pen, left),
            screen_x(pen, left + l->panel_width));
    fprintf(file, "set tmargin at screen %.6f\nset bmargin at screen %.6f\n", screen_y(pen, top),
            screen_y(pen, top + l->panel_height));
    axis_write(file, &(axis){.name = "x",
                             .logarithmic = s->logarithmic_abscissa,
                             .low = x.low,
                             .high = x.high,
                             .length = l->panel_width,
                             .beside = true});
    const axis ordinate = ordinate_axis(p, pen->ranges->y[number].range, l->panel_height);
    axis_write(file, &ordinate);

    for (int zero = 0; zero < 2; zero++) {
        fprintf(file,
                p->crossed ? "set %czeroaxis lt 1 dt 1 lw 0.8 lc rgb '%s'\n" : "unset %czeroaxis\n",
                "xy"[zero], ink);
    }
    sheet_unit_label(unit, sizeof unit, p->unit, power);
    snprintf(heading, sizeof heading, "%s%s%s%s", p->heading,
             p->logarithmic && !p->mapped && has_negative(p) ? ", magnitude" : "", unit,
             band_in_panel(p, x, l->panel_width) ? ", bands: least to greatest" : "");
    sheet_quote(quoted, sizeof quoted, heading, 80);
    fprintf(file,
            "set label 2 '%s' at graph 0,graph %.6g left offset character 0,character 0.75 "
            "noenhanced textcolor rgb 'black'\n",
            quoted, 1.0 + (double)(KEY_ROW * key_rows(s, l, p)) / l->panel_height);
    sheet_quote(quoted, sizeof quoted, s->abscissa, 80);
    if (number + l->columns >= s->count)
        fprintf(file, "set xlabel '%s' noenhanced offset character 0,character 0.5\n", quoted);
    else
        fprintf(file, "unset xlabel\n");
    write_key(pen, number);
}

/* Dashes go with colours, so that all lines of a table have the same: the number of other colours before. */
static int dashes_of(const panel *p, int number) {
    int colours = 0;
    for (int i = 0; i < number && p->series[i].colour != p->series[number].colour; i++) {
        bool known = p->series[i].colour < 0 || p->series[i].mark || p->series[i].limit;
        for (int k = 0; k < i; k++) known = known || p->series[k].colour == p->series[i].colour;
        colours += !known;
    }
    return colours;
}

/* Points that ended early are rings. */
static void write_plot(const drawing *pen, int number, int first_data) {
    const panel *p = &pen->sheet->panel[number];
    FILE *file = pen->file;
    char quoted[2 * SHEET_TEXT];
    fprintf(file, "plot ");
    for (int i = 0; i < p->count; i++) {
        const series *line = &p->series[i];
        const int data = first_data + i;
        const bool dashed = pen->sheet->print && line->colour >= 0 && !line->mark && !line->limit;
        const bool band = band_needed(p, line, pen->ranges->x, pen->layout.panel_width);
        sheet_quote(quoted, sizeof quoted, line->label, pen->sheet->common_key ? KEY_TEXT : 28);
        fprintf(file, "%s'data-%d' using 1:2%s ", i > 0 ? ", \\\n     " : "", data,
                band ? ":3" : "");
        if (band)
            fprintf(file, "with filledcurves fs transparent solid 0.5 noborder fc rgb '%s'",
                    colour_text(line->colour));
        else
            write_line_style(file, line, dashed ? dashes_of(p, i) : -1);
        if (line->label[0] != '\0')
            fprintf(file, " title '%s' noenhanced", quoted);
        else
            fprintf(file, " notitle");
        if (line->ended == NULL) continue;
        const char *called = line->ended_label ? line->ended_label : "ended early";
        fprintf(file,
                ", \\\n     'data-%d' using 1:($3 > 0 ? $2 : NaN) with points pt 7 ps 0.75 lc rgb "
                "'white' notitle, \\\n     'data-%d' using 1:($3 > 0 ? $2 : NaN) with points pt 6 "
                "ps 0.75 lw 1.4 lc rgb '%s' ",
                data, data, colour_text(line->colour));
        if (*called)
            fprintf(file, "title '%s' noenhanced", called);
        else
            fprintf(file, "notitle");
    }
    fprintf(file, "\nunset label\n");
}

/* Steps of colour that all readers tell apart, dark to light, after viridis of Smith and van der Walt; cells without a number
 * are grey. */
static void write_map(const drawing *pen, int number, int data) {
    const panel *p = &pen->sheet->panel[number];
    const layout *l = &pen->layout;
    const int top = l->top + l->heading + number * (l->heading + TICS + l->panel_height);
    FILE *file = pen->file;
    char quoted[2 * SHEET_TEXT];
    fprintf(file,
            "set palette defined (0 '#440154', 1 '#482878', 2 '#3e4a89', 3 '#31688e', 4 '#26828e', "
            "5 '#1f9e89', 6 '#35b779', 7 '#6ece58', 8 '#b5de2b', 9 '#fde725') maxcolors %d\n",
            COLOURS);
    fprintf(file, "set colorbox user origin screen %.6f,screen %.6f size screen %.6f,screen %.6f\n",
            screen_x(pen, l->width - l->right + COLOUR_GAP), screen_y(pen, top + l->panel_height),
            (double)COLOUR_WIDTH / l->width, (double)l->panel_height / l->height);
    fprintf(file, "set colorbox border\nset border 15 lw 0.8 lc rgb '%s'\n", ink);
    const axis colours = colour_axis(p, pen->ranges->z[number].range, l->panel_height);
    axis_write(file, &colours);
    sheet_quote(quoted, sizeof quoted, p->map.ordinate, 60);
    fprintf(file, "set ylabel '%s' noenhanced offset character 0.6,character 0\n", quoted);
    fprintf(file,
            "plot 'data-%d' using 1:($8 > 0 ? $2 : NaN):3:4:5:6 with boxxyerror fillstyle solid "
            "noborder fillcolor rgb '%s' notitle, \\\n     'data-%d' using "
            "1:($8 > 0 ? NaN : $2):3:4:5:6:7 with boxxyerror fillstyle solid noborder fillcolor "
            "palette notitle\nunset label\n",
            data, pale, data);
}

static bool write_map_panel(const drawing *pen, int number, const char *folder) {
    const panel *p = &pen->sheet->panel[number];
    const int power = pen->ranges->z[number].power;
    char path[256];
    write_axes(pen, number, power);
    write_map(pen, number, number);
    snprintf(path, sizeof path, "%s/data-%d", folder, number);
    return sheet_write_map(&p->map, pen->sheet->logarithmic_abscissa, pow(1000.0, power), path);
}

static bool write_panels(const drawing *pen, const char *folder) {
    const sheet *s = pen->sheet;
    char path[256];
    bool good = true;
    int data = 0;
    for (int number = 0; number < s->count && good; number++) {
        const panel *p = &s->panel[number];
        if (p->mapped) {
            good = write_map_panel(pen, number, folder);
            continue;
        }
        const int power = pen->ranges->y[number].power;
        write_axes(pen, number, power);
        if (s->print)
            line_ends_write(pen->file, p, pen->ranges->x, pen->ranges->y[number],
                            pen->layout.panel_width, pen->layout.panel_height,
                            font_size(pen, SMALL_TEXT));
        write_plot(pen, number, data);
        for (int i = 0; i < p->count && good; i++, data++) {
            snprintf(path, sizeof path, "%s/data-%d", folder, data);
            good = write_data(pen, p, &p->series[i], pow(1000.0, power), path);
        }
    }
    return good;
}

/* One range and one power for all panels. */
static void join_scales(const sheet *s, ranges *r) {
    int power = r->y[0].power;
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < s->count; i++)
        if (r->y[i].power > power) power = r->y[i].power;
    for (int i = 0; i < s->count; i++) {
        const double unit = pow(1000.0, r->y[i].power - power);
        low = fmin(low, r->y[i].range.low * unit);
        high = fmax(high, r->y[i].range.high * unit);
    }
    for (int i = 0; i < s->count; i++) r->y[i] = (scaled_range){{low, high}, power};
}

static bool write_script(const sheet *s, sheet_format format, const char *folder,
                         sheet_facts *facts) {
    char path[256];
    snprintf(path, sizeof path, "%s/script", folder);
    ranges r = {.x = sheet_abscissa(s)};
    for (int i = 0; i < s->count; i++) {
        r.y[i] = panel_ordinate(&s->panel[i]);
        if (s->panel[i].mapped) r.z[i] = panel_colours(&s->panel[i]);
    }
    if (s->common_scale) join_scales(s, &r);
    const drawing pen = {fopen(path, "w"), s, &r, lay_out(s, &r), format};
    if (pen.file == NULL) return false;
    facts->width = pen.layout.width, facts->height = pen.layout.height;
    facts->inch = s->inch, facts->dpi = s->dpi;
    sheet_describe(s, facts);
    sheet_write_terminal(pen.file, format, facts);
    write_frame(&pen);
    bool good = write_panels(&pen, folder);
    fprintf(pen.file, "unset multiplot\nunset output\n");
    good = ferror(pen.file) == 0 && good;
    return fclose(pen.file) == 0 && good;
}

gough_status sheet_write_script(const sheet *s, sheet_format format, const char *folder,
                                sheet_facts *facts, gough_error *error) {
    bool good = false;
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain != (locale_t)0) {
        const locale_t before = uselocale(plain);
        good = write_script(s, format, folder, facts);
        uselocale(before);
        freelocale(plain);
    }
    if (good) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: the figure's data cannot be written: %s",
                      folder, strerror(errno));
}
