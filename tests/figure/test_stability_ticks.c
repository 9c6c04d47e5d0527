/* Numbers on the axes of stability maps: the text at each tick is the value at its place. Places are told by lines whose data are
 * known here: the curve of growth in maps of one row, the edges of an interval in maps of several.
 * Label: thorough.
 * Not sanitized: most of its time is gnuplot's, and figure/sweep draws under sanitizers. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure/svg.h"
#include "gough/report.h"
#include "support/suite.h"
#include "table/by_hand.h"

enum { COLUMNS = 21, MOST_ROWS = 4, ROOM = 2 };
static const char growth_colour[] = "140,  41, 129";
static const char *const edge_path[] = {"<path stroke='rgb( 43,  10,  82)'  d='",
                                        "<path stroke='rgb(255, 255, 255)'  d='"};

/* Hundredths in the SVG, and a ruler as long as half the axis. */
static const double pixel = 0.1;

static const double low_end[] = {2,      3.5,  20,  35.7, 47.4, 71.4, 357,
                                 0.0123, 0.97, 999, 5e5,  7e-7, 1.3e8};
static const double reach[] = {2.3, 9, 47, 3e3};
enum { LOW_ENDS = sizeof low_end / sizeof low_end[0], REACHES = sizeof reach / sizeof reach[0] };

typedef struct hand_made {
    gough_map_options options;
    gough_map map;
    gough_map_point point[MOST_ROWS * COLUMNS];
    gough_map_row row[MOST_ROWS];
    gough_interval interval[MOST_ROWS * ROOM];
    double edge[2]; /* of the interval, in each row */
} hand_made;

/* What lies at a part of a range. */
static double at(const gough_map_range *range, double part) {
    return range->logarithmic ? range->from * pow(range->to / range->from, part)
                              : range->from + part * (range->to - range->from);
}

/* A map over ranges in which a mode grows between a quarter and three quarters of the range, threefold a period in its middle. */
static void fill(hand_made *h, size_t rows, gough_map_range across, gough_map_range upwards) {
    memset(h, 0, sizeof *h);
    h->options = gough_map_options_default();
    across.count = COLUMNS;
    upwards.count = rows;
    h->options.stiffness = across;
    h->options.second = upwards;
    h->options.axis = rows > 1 ? GOUGH_MAP_DAMPING : GOUGH_MAP_NONE;
    h->options.intervals = ROOM;
    h->map = (gough_map){h->point, h->row, h->interval};
    h->edge[0] = at(&across, 0.25);
    h->edge[1] = at(&across, 0.75);
    for (size_t r = 0; r < rows; r++) {
        const double value = rows > 1 ? gough_map_value(&h->options.second, r) : 1;
        h->row[r] = (gough_map_row){.value = value, .period = {.period = 2}, .intervals = 1};
        gough_interval *one = &h->interval[r * ROOM];
        *one = (gough_interval){.from = h->edge[0],
                                .to = h->edge[1],
                                .stiffness = at(&across, 0.5),
                                .growth = 3,
                                .rate = log(3) / 2,
                                .kind = GOUGH_INTERVAL_MINUS};
        strcpy(one->mode.name, "yaw");
        for (size_t c = 0; c < COLUMNS; c++) {
            const double G = gough_map_value(&h->options.stiffness, c);
            gough_map_point *p = &h->point[r * COLUMNS + c];
            p->stable = !(G > h->edge[0] && G < h->edge[1]);
            p->growth = p->stable ? 1 : 2;
            p->rate = log(p->growth) / 2;
            strcpy(p->mode, "yaw");
        }
    }
}

static char *draw(const hand_made *h) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.svg", path);
    const gough_map_figure figure = {
        .title = "A map", .units = {.dimensionless = true, .length = 1, .mass = 1, .time = 1}};
    gough_error error = {.message = ""};
    ck_assert_msg(gough_map_draw(&h->options, &h->map, &figure, path, &error) == GOUGH_OK, "%s",
                  error.message);
    size_t length;
    char *text = read_bytes(path, &length);
    remove_folder(folder);
    return text;
}

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
    ck_assert_msg(side->count >= 2, "%s from %g: only %d numbers", what, r->value[0], side->count);
    for (int i = 0; i < side->count; i++) {
        const svg_tick *t = &side->tick[i];
        ck_assert_msg(fabs(place_of(r, t->value) - t->place) <= pixel,
                      "%s from %g: %s is at %g, its place is %g", what, r->value[0], t->text,
                      t->place, place_of(r, t->value));
        ck_assert_msg(t->text_left >= 0, "%s: %s is cut by the edge", what, t->text);
    }
}

/* The curve of growth of a map of one row: from end to end of the abscissa. */
static void check_line(const gough_map_range *across) {
    static hand_made h;
    static svg_line line;
    svg_ticks all, side;
    fill(&h, 1, *across, (gough_map_range){0, 1, 1, false});
    char *svg = draw(&h);
    ck_assert(svg_read_line(svg, growth_colour, 0, &line));
    svg_read_ticks(svg, &all);
    const size_t last = line.count - 1;
    svg_side(&all, true, 0, &side);
    expect_places(
        &side, &(ruler){across->logarithmic, {across->from, across->to}, {line.x[0], line.x[last]}},
        "stiffness under a line");
    /* the scale of growth: the root of its logarithm, of which the largest is in the middle of the interval */
    double top = INFINITY;
    for (size_t i = 0; i <= last; i++) top = fmin(top, line.y[i]);
    svg_side(&all, false, 0, &side);
    ck_assert_int_ge(side.count, 3);
    for (int i = 0; i < side.count; i++) {
        const double part = sqrt(log(side.tick[i].value) / log(3));
        ck_assert_msg(fabs(line.y[0] + part * (top - line.y[0]) - side.tick[i].place) <= pixel,
                      "growth %s is at %g", side.tick[i].text, side.tick[i].place);
    }
    free(svg);
}

/* Both edges of the interval, each a line from the lowest row to the highest. */
static void check_plane(const gough_map_range *across, const gough_map_range *upwards) {
    static hand_made h;
    svg_ticks all, side;
    double x[2] = {INFINITY, -INFINITY}, y[2] = {-INFINITY, INFINITY};
    fill(&h, MOST_ROWS, *across, *upwards);
    char *svg = draw(&h);
    for (size_t c = 0; c < sizeof edge_path / sizeof edge_path[0]; c++)
        for (const char *path = svg; (path = strstr(path, edge_path[c])) != NULL;) {
            path += strlen(edge_path[c]);
            double px, py;
            for (int used; sscanf(path, " %*1[ML]%lf,%lf%n", &px, &py, &used) == 2; path += used) {
                x[0] = fmin(x[0], px);
                x[1] = fmax(x[1], px);
                y[0] = fmax(y[0], py);
                y[1] = fmin(y[1], py);
            }
        }
    ck_assert(x[1] > x[0] && y[1] < y[0]);
    svg_read_ticks(svg, &all);
    svg_side(&all, true, 0, &side);
    expect_places(&side, &(ruler){across->logarithmic, {h.edge[0], h.edge[1]}, {x[0], x[1]}},
                  "stiffness under a map");
    svg_side(&all, false, 0, &side);
    const ruler up = {upwards->logarithmic, {upwards->from, upwards->to}, {y[0], y[1]}};
    svg_ticks damping = {0};
    for (int n = 0; side.count > 0; svg_side(&all, false, ++n, &side))
        if (side.tick[0].side < x[0]) damping = side; /* the scale of colours is at the right */
    expect_places(&damping, &up, "damping beside a map");
    free(svg);
}

START_TEST(numbers_under_lines_of_growth_are_their_places) {
    for (int i = 0; i < LOW_ENDS; i++)
        for (int k = i % 2; k < REACHES; k += 2) {
            const double low = low_end[i], high = low * reach[k];
            check_line(&(gough_map_range){low, high, 0, true});
            if (k == i % 4) check_line(&(gough_map_range){low, high, 0, false});
        }
}
END_TEST

START_TEST(numbers_beside_maps_are_their_places) {
    for (int i = 0; i < LOW_ENDS; i++) {
        const double low = low_end[i], high = low * reach[i % REACHES];
        const double other = low_end[(i + 5) % LOW_ENDS];
        const gough_map_range range = {low, high, 0, true},
                              second = {other, other * reach[(i + 1) % REACHES], 0, true},
                              even = {0, other, 0, false};
        check_plane(&range, &second);
        if (i % 3 == 0) check_plane(&range, &even);
        if (i % 3 == 1) check_plane(&(gough_map_range){low, high, 0, false}, &second);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("figure/stability_ticks", 300, numbers_under_lines_of_growth_are_their_places,
                     numbers_beside_maps_are_their_places);
}
