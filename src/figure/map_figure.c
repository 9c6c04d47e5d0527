/* Pictures of stability maps: frame, abscissa, thresholds; the panels are in stability_plane.c (two axes) and stability_line.c. */
#define _POSIX_C_SOURCE 200809L
#include "figure/map_figure.h"
#include "figure/ticks.h"
#include "gough/sizes.h"
#include "gough/text.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char stability_ink[] = "#333333";
static const char threshold_colour[] = "#2f86bd";

double stability_screen_x(double x) { return x / STABILITY_WIDTH; }
double stability_screen_y(const stability_pen *pen, double y) { return 1.0 - y / pen->height; }
double stability_size(const stability_pen *pen, double pixels) {
    return sheet_font_size(pen->format, pixels);
}

static double part_of(double value, double low, double high, bool logarithmic) {
    return logarithmic ? log(value / low) / log(high / low) : (value - low) / (high - low);
}

double stability_place_x(const stability_pen *pen, double value) {
    const bool logarithmic = pen->field->options->stiffness.logarithmic;
    return pen->left +
           pen->panel_width * part_of(value, pen->view.low_x, pen->view.high_x, logarithmic);
}

double stability_place_y(const stability_pen *pen, double value) {
    const bool logarithmic = pen->field->options->second.logarithmic;
    return pen->top +
           pen->panel_height * (1 - part_of(value, pen->view.low_y, pen->view.high_y, logarithmic));
}

FILE *stability_open(const stability_pen *pen, const char *name) {
    char path[300];
    snprintf(path, sizeof path, "%s/%s", pen->folder, name);
    return fopen(path, "w");
}

void stability_write_frame(const stability_pen *pen, const char *explanation) {
    FILE *file = pen->file;
    char quoted[2 * SHEET_TEXT];
    sheet_write_terminal(file, pen->format,
                         &(sheet_facts){.width = STABILITY_WIDTH, .height = pen->height});
    fprintf(file, "set encoding utf8\nset minussign\nset output 'figure'\nset multiplot\n");
    fprintf(file, "set tics nomirror out scale 0.5 textcolor rgb '%s' font ',%.4g'\n",
            stability_ink, stability_size(pen, STABILITY_SMALL));
    sheet_quote(quoted, sizeof quoted, pen->figure->title ? pen->figure->title : "", 80);
    fprintf(file,
            "set label 1 '%s' at screen %.6f,screen %.6f left noenhanced font 'DejaVu "
            "Sans:Bold,%.4g' textcolor rgb 'black'\n",
            quoted, stability_screen_x(pen->left), stability_screen_y(pen, 22),
            stability_size(pen, STABILITY_TITLE));
    fprintf(file,
            "set label 2 '%s%s' at screen %.6f,screen %.6f left noenhanced font ',%.4g' textcolor "
            "rgb '%s'\n",
            explanation, pen->top > STABILITY_TOP ? " · dashed: thresholds at rest" : "",
            stability_screen_x(pen->left), stability_screen_y(pen, 42),
            stability_size(pen, STABILITY_SMALL), stability_ink);
}

/* A step of 1, 2 or 5 times a power of ten, so that at most eight go into the greatest. */
static double rate_step(double greatest) {
    const double decade = greatest > 0 ? pow(10, floor(log10(greatest / 8))) : 1;
    double step = decade;
    for (int i = 0; greatest > 8 * step; i++) step = decade * (i == 0 ? 2 : i == 1 ? 5 : 10);
    return step;
}

static bool stands_apart(const stability_tic *tic, int count, double shade, double apart) {
    for (int i = 0; i < count; i++)
        if (fabs(tic[i].shade - shade) < apart) return false;
    return true;
}

static void write_growth_number(char *text, size_t size, double growth) {
    if (growth >= 1e3)
        snprintf(text, size, "10^{%.0f}", log10(growth));
    else
        snprintf(text, size, "%.6g", growth);
}

int stability_list_tics(const field *f, double apart, stability_tic tic[STABILITY_TICS]) {
    /* those wanted most first; what comes later fills gaps */
    static const double growth[] = {1,    1.1, 1.5, 2,     3,    5,    10,    30,    100,   1e3,
                                    1e4,  1e5, 1e6, 1e8,   1e10, 1e15, 1e20,  1e30,  1e50,  1e100,
                                    1.01, 1.2, 1.3, 1.001, 1.02, 1.05, 1.002, 1.005, 1.0001};
    enum { GROWTHS = sizeof growth / sizeof growth[0] };
    const double step = rate_step(f->greatest);
    int count = 0;
    for (int i = 0; i < GROWTHS && count < STABILITY_TICS; i++) {
        const double level = f->resting ? i * step : log(growth[i]);
        const double shade = field_shade(f, level);
        if (level > f->greatest * (1 + 1e-9) || !stands_apart(tic, count, shade, apart)) continue;
        tic[count].shade = shade;
        if (f->resting)
            snprintf(tic[count].text, sizeof tic->text, "%.3g", level);
        else
            write_growth_number(tic[count].text, sizeof tic->text, growth[i]);
        count++;
    }
    return count;
}

void stability_write_margins(const stability_pen *pen, int top, int height) {
    fprintf(pen->file,
            "set lmargin at screen %.6f\nset rmargin at screen %.6f\nset tmargin at screen "
            "%.6f\nset bmargin at screen %.6f\n",
            stability_screen_x(pen->left), stability_screen_x(pen->left + pen->panel_width),
            stability_screen_y(pen, top), stability_screen_y(pen, top + height));
}

stability_words stability_unit(const stability_pen *pen, gough_unit unit, const char *own_units) {
    const gough_units *units = &pen->figure->units;
    stability_words words;
    const bool own =
        fabs(units->length - 1) > 0 || fabs(units->mass - 1) > 0 || fabs(units->time - 1) > 0;
    if (!units->dimensionless)
        snprintf(words.text, sizeof words.text, " (%s)", gough_unit_label(units, unit));
    else
        snprintf(words.text, sizeof words.text, "%s", own ? own_units : ", dimensionless");
    return words;
}

void stability_write_abscissa(const stability_pen *pen, bool titled) {
    const gough_map_range *range = &pen->field->options->stiffness;
    axis_write(pen->file, &(axis){.name = "x",
                                  .logarithmic = range->logarithmic,
                                  .low = pen->view.low_x,
                                  .high = pen->view.high_x,
                                  .length = pen->panel_width,
                                  .beside = true,
                                  .bare = !titled});
    if (titled)
        fprintf(pen->file,
                "set xlabel 'stiffness of the feedback G%s' noenhanced offset character "
                "0,character 0.4\n",
                stability_unit(pen, GOUGH_UNIT_STIFFNESS, " (M g/R_b)").text);
    else
        fprintf(pen->file, "unset xlabel\n");
}

/* "yaw 0.466"; the next of the list that is not the same again. */
static int name_threshold(const gough_rest *rest, int i, char text[GOUGH_MODE_NAME + 32]) {
    const gough_threshold *t = &rest->threshold[i];
    const bool large = t->stiffness >= 1000 && t->stiffness < 1e6;
    int next = i + 1;
    while (next < 6 && strcmp(rest->threshold[next].mode.name, t->mode.name) == 0 &&
           fabs(rest->threshold[next].stiffness - t->stiffness) <= 1e-9 * fabs(t->stiffness))
        next++;
    snprintf(text, GOUGH_MODE_NAME + 32, large ? "%s %.0f" : "%s %.3g", t->mode.name, t->stiffness);
    return next;
}

static bool is_in_view(const stability_pen *pen, double stiffness) {
    return stiffness > pen->view.low_x && stiffness < pen->view.high_x;
}

/* Below title and explanation, and the names of thresholds, which rise by 35 degrees. */
static int top_of_panel(const stability_pen *pen) {
    const gough_rest *rest = pen->figure->rest;
    int longest = 0;
    for (int i = 0, next; rest && i < 6; i = next) {
        char text[GOUGH_MODE_NAME + 32];
        int characters;
        next = name_threshold(rest, i, text);
        characters = (int)gough_character_count(text);
        if (is_in_view(pen, rest->threshold[i].stiffness) && characters > longest)
            longest = characters;
    }
    return STABILITY_TOP + 4 * longest;
}

void stability_write_thresholds(const stability_pen *pen, int height) {
    const gough_rest *rest = pen->figure->rest;
    FILE *file = pen->file;
    double last = INFINITY;                          /* place of the name to the right */
    for (int i = 0, next; rest && i < 6; i = next) { /* by falling stiffness */
        char text[GOUGH_MODE_NAME + 32];
        next = name_threshold(rest, i, text);
        if (!is_in_view(pen, rest->threshold[i].stiffness)) continue;
        const double x = stability_place_x(pen, rest->threshold[i].stiffness);
        const double named = fmin(x, last - 21);
        last = named;
        fprintf(file,
                "set arrow from screen %.6f,screen %.6f to screen %.6f,screen %.6f nohead front dt "
                "(6,4) lw 1 lc rgb '%s'\n",
                stability_screen_x(x), stability_screen_y(pen, pen->top - 3), stability_screen_x(x),
                stability_screen_y(pen, pen->top + height), threshold_colour);
        fprintf(file,
                "set label '%s' at screen %.6f,screen %.6f left rotate by 35 noenhanced font "
                "',%.4g' textcolor rgb '%s'\n",
                text, stability_screen_x(named), stability_screen_y(pen, pen->top - 9),
                stability_size(pen, 10), threshold_colour);
    }
}

/* ---- a picture --------------------------------------------------------------------------------------------------- */

typedef struct picture {
    const gough_map_figure *figure;
    const field *field;
} picture;

static bool write_script(stability_pen *pen) {
    pen->file = stability_open(pen, "script");
    if (pen->file == NULL) return false;
    bool good = pen->field->rows > 1 ? stability_write_plane(pen) : stability_write_line(pen);
    fprintf(pen->file, "unset multiplot\nunset output\n");
    good = ferror(pen->file) == 0 && good;
    return fclose(pen->file) == 0 && good;
}

static gough_status write_picture(const void *content, sheet_format format, const char *folder,
                                  sheet_facts *facts, gough_error *error) {
    const picture *p = content;
    snprintf(facts->title, sizeof facts->title, "%s",
             p->figure->title[0] != '\0' ? p->figure->title : "Stability map");
    snprintf(facts->text, sizeof facts->text, "%s",
             p->field->rows > 1
                 ? "Colours for the growth of the loop over a plane, with the edges of the "
                   "intervals in which it grows."
                 : "Growth of the loop over the stiffness, and the intervals in which each "
                   "mode grows.");
    const gough_map_options *options = p->field->options;
    stability_pen pen = {
        .folder = folder, .format = format, .figure = p->figure, .field = p->field};
    pen.view = (field_view){.low_x = options->stiffness.from,
                            .high_x = options->stiffness.to,
                            .low_y = options->second.from,
                            .high_y = options->second.to};
    pen.top = top_of_panel(&pen);
    bool good = false;
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain != (locale_t)0) {
        const locale_t before = uselocale(plain);
        good = write_script(&pen);
        uselocale(before);
        freelocale(plain);
    }
    if (good) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: the picture's data cannot be written: %s",
                      folder, strerror(errno));
}

/* values of enumerations that the drawing relies on */
static gough_status check_map(const gough_map_options *options, const gough_map *found,
                              gough_error *error) {
    if ((int)options->axis < GOUGH_MAP_NONE || options->axis > GOUGH_MAP_DELAY)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the second axis of the map: %d is neither amplitude nor frequency nor "
                          "damping nor period nor delay",
                          (int)options->axis);
    for (size_t row = 0; row < gough_map_rows(options); row++)
        for (size_t i = 0; i < found->row[row].intervals; i++) {
            const gough_interval *one = &found->interval[row * options->intervals + i];
            if ((int)one->kind >= GOUGH_INTERVAL_STATIC && one->kind <= GOUGH_INTERVAL_OSCILLATION)
                continue;
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "row %zu of the map: %d is not a kind of interval", row + 1,
                              (int)one->kind);
        }
    return GOUGH_OK;
}

gough_status gough_map_draw(const gough_map_options *options, const gough_map *found,
                            const gough_map_figure *figure, const char *path, gough_error *error) {
    field f;
    gough_status status = GOUGH_ERROR_FILE;
    if (gough_size_check(options->size, sizeof(gough_map_options), "gough_map_options", error) !=
        GOUGH_OK)
        return GOUGH_ERROR_INPUT;
    if (options->stiffness.count < 2)
        return gough_fail(error, GOUGH_ERROR_INPUT, "a map of one stiffness cannot be drawn");
    if (check_map(options, found, error) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    if (field_make(&f, options, found))
        status = sheet_draw(write_picture, &(picture){figure, &f}, path, error);
    else
        gough_fail(error, status, "%s: out of memory", path);
    field_free(&f);
    return status;
}
