/* Numbers on axes: the text at each tick is the value at its place. Places are told by lines whose data are known here, values by
 * the text in the SVG, as a reader takes them.
 * Label: standard.
 * Not sanitized: most of its time is gnuplot's, and figure/sweep draws under sanitizers. */
#define _XOPEN_SOURCE 700
#include "figure/svg.h"
#include "figure/ticks.h"
#include "gough/report.h"
#include "support/suite.h"
#include "table/by_hand.h"

enum { POINTS = 11 };
static const char first_colour[] = "  0, 114, 178";

/* A pixel: gnuplot's SVG has hundredths, and the ends of a line are known to one of them. */
static const double pixel = 0.05;

/* Low ends of axes, and how far they reach: within a decade, over one, over many. */
static const double low_end[] = {2,      3.5,  20,  35.7, 47.4, 71.4, 357,
                                 0.0123, 0.97, 999, 5e5,  7e-7, 1.3e8};
static const double reach[] = {1.15, 2.3, 9, 47, 3e3, 2e7};
enum { LOW_ENDS = sizeof low_end / sizeof low_end[0], REACHES = sizeof reach / sizeof reach[0] };

static char *svg_of(const gough_figure *figure, const gough_table *table) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.svg", path);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_figure_draw(figure, &table, NULL, 1, path, &error) == GOUGH_OK, "%s",
                  error.message);
    size_t length;
    char *text = read_bytes(path, &length);
    remove_folder(folder);
    return text;
}

/* From a value to a pixel, by two values whose pixels are known. */
typedef struct ruler {
    bool logarithmic;
    double value[2], place[2];
} ruler;

static double place_of(const ruler *r, double value) {
    const double part = r->logarithmic ? log(value / r->value[0]) / log(r->value[1] / r->value[0])
                                       : (value - r->value[0]) / (r->value[1] - r->value[0]);
    return r->place[0] + part * (r->place[1] - r->place[0]);
}

static void expect_places(const svg_ticks *side, const ruler *r, const char *what) {
    ck_assert_msg(side->count >= 3, "%s: only %d numbers", what, side->count);
    for (int i = 0; i < side->count; i++) {
        const svg_tick *t = &side->tick[i];
        /* the ruler is as long as the line, the axis hardly longer: its error does not grow much */
        ck_assert_msg(fabs(place_of(r, t->value) - t->place) <= 2 * pixel,
                      "%s: %s stands at %g, its place is %g", what, t->text, t->place,
                      place_of(r, t->value));
        ck_assert_msg(t->text_left >= 0, "%s: %s is cut by the edge", what, t->text);
    }
}

static gough_table *named_table(size_t rows, int columns, const char *const *names) {
    gough_table *table = gough_table_new("A title", "", (size_t)columns, rows);
    for (int c = 0; c < columns; c++) gough_table_name(table, (size_t)c, names[c], "");
    return table;
}

/* A sweep over one key whose deviation runs over decades as well. */
static gough_table *sweep_over(double x_from, double x_ratio, double y_from, double y_ratio) {
    static const char *const names[] = {"run", "control.stiffness", "x", "position_deviation",
                                        "end_cause"};
    gough_table *table = named_table(POINTS, 5, names);
    for (size_t r = 0; r < POINTS; r++) {
        const double part = (double)r / (POINTS - 1);
        table->value[0][r] = (double)(r + 1);
        table->value[1][r] = x_from * pow(x_ratio, part);
        table->value[3][r] = y_from * pow(y_ratio, 1 - part);
    }
    return table;
}

/* Both axes of a figure with one line against the line's own data. */
static void expect_axes(const gough_figure *figure, const gough_table *table, const double *x,
                        const double *y, bool logarithmic_x, bool logarithmic_y) {
    char *svg = svg_of(figure, table), what[80];
    svg_ticks all, side;
    static svg_line line;
    ck_assert(svg_read_line(svg, first_colour, 0, &line));
    ck_assert_uint_eq(line.count, POINTS);
    svg_read_ticks(svg, &all);
    const ruler across = {logarithmic_x, {x[0], x[POINTS - 1]}, {line.x[0], line.x[POINTS - 1]}};
    const ruler upwards = {logarithmic_y, {y[0], y[POINTS - 1]}, {line.y[0], line.y[POINTS - 1]}};
    for (size_t r = 0; r < POINTS; r++)
        ck_assert(fabs(place_of(&across, x[r]) - line.x[r]) <= pixel &&
                  fabs(place_of(&upwards, y[r]) - line.y[r]) <= pixel);
    snprintf(what, sizeof what, "abscissa from %g to %g", x[0], x[POINTS - 1]);
    svg_side(&all, true, 0, &side);
    expect_places(&side, &across, what);
    snprintf(what, sizeof what, "ordinate from %g to %g", y[0], y[POINTS - 1]);
    svg_side(&all, false, 0, &side);
    expect_places(&side, &upwards, what);
    free(svg);
}

START_TEST(numbers_of_logarithmic_axes_are_their_places) {
    gough_figure figure = gough_figure_default();
    figure.columns = "position_deviation";
    for (int i = 0; i < LOW_ENDS; i++)
        for (int k = i % 2; k < REACHES; k += 2) {
            /* the ordinate is logarithmic from two decades on, and then shows whole ones */
            const double up = fmax(reach[k], 150);
            gough_table *table = sweep_over(low_end[i], reach[k], low_end[i], up);
            expect_axes(&figure, table, table->value[1], table->value[3], true, true);
            gough_table_free(table);
        }
}
END_TEST

START_TEST(numbers_of_the_deviation_over_the_stiffness_are_their_places) {
    static const char *const names[] = {"G", "position_deviation"};
    const gough_figure figure = gough_figure_default();
    for (int i = 0; i < LOW_ENDS; i++) {
        gough_table *table = named_table(POINTS, 2, names);
        for (size_t r = 0; r < POINTS; r++) {
            table->value[0][r] = low_end[i] * pow(60, (double)r / (POINTS - 1));
            table->value[1][r] = 1e-3 * pow(1e4, -(double)r / (POINTS - 1));
        }
        expect_axes(&figure, table, table->value[0], table->value[1], true, true);
        gough_table_free(table);
    }
}
END_TEST

/* The curve of tuning: its line, without the point that is named. */
START_TEST(numbers_of_tuning_are_their_places) {
    static const char *const names[] = {
        "feedforward", "G", "position_deviation", "asked", "named", "force", "ended", "stable"};
    const gough_figure figure = gough_figure_default();
    for (int i = 0; i < LOW_ENDS; i++) {
        gough_table *table = named_table(POINTS, 8, names);
        for (size_t r = 0; r < POINTS; r++) {
            const double part = (double)r / (POINTS - 1);
            const double value[] = {
                1, low_end[i] * pow(60, part), 1e-3 * pow(1e4, -part), 1e-5, 0, 1, 0, 1};
            for (size_t c = 0; c < sizeof value / sizeof value[0]; c++)
                table->value[c][r] = value[c];
        }
        expect_axes(&figure, table, table->value[1], table->value[2], true, true);
        gough_table_free(table);
    }
}
END_TEST

/* Numbers beside each other that differ in their last digits only. */
START_TEST(numbers_of_linear_axes_are_their_places) {
    static const char *const names[] = {"t", "a"};
    static const double start[] = {0, 11.400042, -3.7, 1e-9, 2.5e7, -1e6, 999999};
    static const double span[] = {1, 1e-3, 2e-6, 3e4, 7e9};
    gough_figure figure = gough_figure_default();
    figure.columns = "a";
    for (size_t i = 0; i < sizeof start / sizeof start[0]; i++)
        for (size_t k = 0; k < sizeof span / sizeof span[0]; k++) {
            if (!(span[k] > 1e-8 * fabs(start[i]))) continue; /* rounding is no signal */
            gough_table *table = named_table(POINTS, 2, names);
            for (size_t r = 0; r < POINTS; r++) {
                table->value[0][r] = 35.7 + 0.1 * (double)r;
                table->value[1][r] = start[i] + span[k] * (double)r / (POINTS - 1);
            }
            /* the heading has the power of 1000 that the numbers are in */
            char *svg = svg_of(&figure, table);
            svg_ticks all, side;
            static svg_line line;
            ck_assert(svg_read_line(svg, first_colour, 0, &line));
            svg_read_ticks(svg, &all);
            svg_side(&all, false, 0, &side);
            const double *y = table->value[1];
            const double unit = pow(10, svg_power(svg, "a"));
            const ruler upwards = {
                false, {y[0] / unit, y[POINTS - 1] / unit}, {line.y[0], line.y[POINTS - 1]}};
            expect_places(&side, &upwards, "linear ordinate");
            for (int n = 1; n < side.count; n++)
                ck_assert_str_ne(side.tick[n].text, side.tick[n - 1].text);
            svg_side(&all, true, 0, &side);
            const ruler across = {false, {35.7, 36.7}, {line.x[0], line.x[POINTS - 1]}};
            expect_places(&side, &across, "linear abscissa");
            free(svg);
            gough_table_free(table);
        }
}
END_TEST

/* A machine that rests: all columns of a simulation, with the errors that a solver leaves. */
static gough_table *resting_table(size_t rows) {
    gough_table *table = gough_table_new("At rest", "simulate", GOUGH_RXX, rows);
    for (int c = 0; c < GOUGH_RXX; c++) {
        const bool length = c >= GOUGH_L && c < GOUGH_L + GOUGH_LEGS,
                   force = c >= GOUGH_F && c < GOUGH_F + GOUGH_LEGS;
        const double value = c == GOUGH_Z || length ? 0.2800017 : force ? 11.400042 : 0.0;
        double *column =
            gough_table_name(table, (size_t)c, gough_column(c)->name, c == GOUGH_T ? "s" : "");
        for (size_t r = 0; r < rows; r++)
            column[r] = c == GOUGH_T
                            ? 0.02 * (double)r
                            : value + 3e-10 * (value > 1 ? value : 1) * sin(7.0 * (double)r + c);
    }
    return table;
}

START_TEST(a_machine_at_rest_has_lines_and_its_noise_is_none) {
    static const char *const kinds[] = {"forces", "lengths", "rates",
                                        "power",  "motion",  "deviation"};
    gough_table *table = resting_table(POINTS * 20);
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
        for (int logarithmic = 0; logarithmic < 2; logarithmic++) {
            gough_figure figure = gough_figure_default();
            figure.kind = kinds[k];
            /* a force that is no noise may well be on a logarithmic axis */
            figure.logarithmic = logarithmic && k > 1;
            char *svg = svg_of(&figure, table);
            static const char *const colours[] = {"  0, 114, 178", "213,  94,   0",
                                                  "  0, 158, 115"};
            static svg_line line;
            svg_ticks all, side;
            int lines = 0;
            for (int c = 0; c < 3; c++) {
                if (!svg_read_line(svg, colours[c], 0, &line)) continue;
                lines++;
                ck_assert_uint_gt(line.count, 100);
                for (size_t i = 1; i < line.count; i++)
                    ck_assert_msg(fabs(line.y[i] - line.y[0]) <= 3, "%s: noise of %g pixels",
                                  kinds[k], line.y[i] - line.y[0]);
            }
            ck_assert_msg(lines > 0, "%s: no line", kinds[k]);
            svg_read_ticks(svg, &all);
            svg_side(&all, false, 0, &side);
            ck_assert_int_ge(side.count, 2);
            for (int i = 0; i < side.count; i++) {
                ck_assert_msg(side.tick[i].text_left >= 0, "%s is cut", side.tick[i].text);
                ck_assert(i == 0 || side.tick[i].value > side.tick[i - 1].value);
            }
            /* the line is at its value: between the ticks around it, or near the only ones */
            if (k < 2) {
                const double value = k == 0 ? 11.400042 : 0.2800017;
                const svg_tick *low = &side.tick[0], *high = &side.tick[side.count - 1];
                const ruler r = {false, {low->value, high->value}, {low->place, high->place}};
                svg_read_line(svg, colours[0], 0, &line);
                ck_assert(fabs(place_of(&r, value) - line.y[0]) <= 1);
            }
            free(svg);
        }
    gough_table_free(table);
}
END_TEST

/* How much a line of noise varies on its panel, in pixels, for a run of that tolerance. */
static double wiggle_of(double tolerance) {
    gough_table *table = resting_table(POINTS * 20);
    table->tolerance = tolerance;
    gough_figure figure = gough_figure_default();
    figure.kind = "lengths";
    char *svg = svg_of(&figure, table);
    static svg_line line;
    ck_assert(svg_read_line(svg, first_colour, 0, &line));
    double most = 0;
    for (size_t i = 1; i < line.count; i++) most = fmax(most, fabs(line.y[i] - line.y[0]));
    free(svg);
    gough_table_free(table);
    return most;
}

START_TEST(what_is_noise_follows_from_the_tolerance) {
    /* the errors of resting_table() are 3e-10: a hundred times 3e-12 */
    ck_assert(wiggle_of(1e-10) <= 3 && wiggle_of(NAN) <= 3 && wiggle_of(1e-4) <= 3);
    ck_assert(wiggle_of(1e-13) > 30);
    ck_assert(fabs(wiggle_of(1e-10) - wiggle_of(NAN)) <= pixel);
}
END_TEST

/* ---- maps --------------------------------------------------------------------------------------------------------- */

/* A map over two keys: the edges of its cells lie halfway between the values, by ratio where the axis is logarithmic. */
static gough_table *map_over(double low, double ratio, double cell_low, double cell_ratio) {
    static const char *const names[] = {"run", "control.stiffness",  "load.mass",
                                        "x",   "position_deviation", "end_cause"};
    enum { SIDE = 5 };
    gough_table *table = named_table(SIDE * SIDE, 6, names);
    for (size_t r = 0; r < SIDE * SIDE; r++) {
        table->value[0][r] = (double)(r + 1);
        table->value[1][r] = low * pow(ratio, (double)(r % SIDE) / (SIDE - 1));
        table->value[2][r] = low * pow(2 * ratio, (double)(r / SIDE) / (SIDE - 1));
        table->value[4][r] = cell_low * pow(cell_ratio, (double)r / (SIDE * SIDE - 1));
    }
    return table;
}

/* Rightmost and leftmost pixel of the first panel's border, and its top and bottom. */
static void read_border(const char *svg, double x[2], double y[2]) {
    const char *at = strstr(svg, "class=\"gridline\"");
    ck_assert_ptr_nonnull(at);
    x[0] = y[0] = INFINITY;
    x[1] = y[1] = -INFINITY;
    for (at = svg; (at = strstr(at, "class=\"gridline\"")) != NULL; at++) {
        double end[4];
        if (sscanf(strstr(at, "d='") + 3, "M%lf,%lf L%lf,%lf", &end[0], &end[1], &end[2],
                   &end[3]) != 4)
            continue;
        for (int k = 0; k < 2; k++) {
            x[0] = fmin(x[0], end[2 * k]);
            x[1] = fmax(x[1], end[2 * k]);
            y[0] = fmin(y[0], end[2 * k + 1]);
            y[1] = fmax(y[1], end[2 * k + 1]);
        }
    }
}

START_TEST(numbers_of_maps_are_their_places) {
    static const char heading[] = "Largest deviation of position from the program";
    const gough_figure figure = gough_figure_default();
    for (int i = 0; i < LOW_ENDS; i++) {
        const double ratio = 81, cell_ratio = i % 2 ? 6e3 : 3;
        gough_table *table = map_over(low_end[i], ratio, low_end[i] * 1e-3, cell_ratio);
        char *svg = svg_of(&figure, table);
        svg_ticks all, side;
        double x[2], y[2];
        svg_read_ticks(svg, &all);
        read_border(svg, x, y);
        const double half = pow(ratio, 0.125), half_y = pow(2 * ratio, 0.125);
        svg_side(&all, true, 0, &side);
        const ruler across = {true, {low_end[i] / half, low_end[i] * ratio * half}, {x[0], x[1]}};
        expect_places(&side, &across, "map's abscissa");
        svg_side(&all, false, 0, &side);
        const ruler upwards = {
            true, {low_end[i] / half_y, 2 * low_end[i] * ratio * half_y}, {y[1], y[0]}};
        expect_places(&side, &upwards, "map's ordinate");
        svg_side(&all, false, 1, &side); /* the scale of colours, as tall as the panel */
        double low = low_end[i] * 1e-3, high = low * cell_ratio;
        if (i % 2) {
            low = pow(10, floor(log10(low)));
            high = pow(10, ceil(log10(high)));
        } else {
            const double unit = pow(10, svg_power(svg, heading));
            low /= unit;
            high /= unit;
        }
        const ruler colours = {i % 2 != 0, {low, high}, {y[1], y[0]}};
        expect_places(&side, &colours, "scale of colours");
        free(svg);
        gough_table_free(table);
    }
}
END_TEST

/* ---- the choice itself ---------------------------------------------------------------------------------------------- */

static double value_of(const char *text) {
    char markup[200];
    const char *raised = strstr(text, "^{");
    if (raised == NULL) return svg_number(text);
    snprintf(markup, sizeof markup, "%.*s<tspan dy=\"-5px\">%.*s</tspan>", (int)(raised - text),
             text, (int)strcspn(raised + 2, "}"), raised + 2);
    return svg_number(markup);
}

static double uniform(unsigned long *state) {
    *state = *state * 48271 % 2147483647;
    return (double)*state / 2147483647.0;
}

START_TEST(any_range_has_numbers_and_they_are_true) {
    unsigned long state = 20261;
    static tick_list list;
    for (int n = 0; n < 20000; n++) {
        const double low = pow(10, 40 * uniform(&state) - 20);
        const double ratio = 1 + pow(10, 16 * uniform(&state) - 4);
        axis a = {.name = "x",
                  .logarithmic = n % 2,
                  .low = low,
                  .high = low * ratio,
                  .length = 100 + 600 * uniform(&state),
                  .beside = n % 3 == 0};
        if (!a.logarithmic && n % 4 == 0) a.low = -low;
        tick_choose(&a, &list);
        int named = 0;
        for (int i = 0; i < list.count; i++) {
            const tick *t = &list.tick[i];
            ck_assert(t->value >= a.low - 1e-6 * (a.high - a.low) &&
                      t->value <= a.high + 1e-6 * (a.high - a.low));
            ck_assert(i == 0 || t->value > list.tick[i - 1].value);
            if (t->text[0] == '\0') continue;
            named++;
            const double said = value_of(t->text);
            ck_assert_msg(fabs(said - t->value) <=
                              1e-12 * fabs(t->value) + 1e-7 * (a.high - a.low) * !a.logarithmic,
                          "%s at %.17g in %.17g to %.17g", t->text, t->value, a.low, a.high);
        }
        ck_assert_msg(named >= (a.beside ? 1 : 2), "%d numbers in %.17g to %.17g", named, a.low,
                      a.high);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("figure/ticks", 300, numbers_of_logarithmic_axes_are_their_places,
                     numbers_of_the_deviation_over_the_stiffness_are_their_places,
                     numbers_of_tuning_are_their_places, numbers_of_linear_axes_are_their_places,
                     a_machine_at_rest_has_lines_and_its_noise_is_none,
                     what_is_noise_follows_from_the_tolerance, numbers_of_maps_are_their_places,
                     any_range_has_numbers_and_they_are_true);
}
