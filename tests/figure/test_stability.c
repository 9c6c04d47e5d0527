/* Pictures of stability maps: tongues and thresholds are named, rows without values are said by their colour, maps of any kind are
 * drawn or refused; between grid points the growth is what the intervals say.
 * Label: standard. */
#define _XOPEN_SOURCE 700
#include "figure/tongues.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/suite.h"
#include "table/by_hand.h"

enum { COLUMNS = 21, MOST_ROWS = 5, ROOM = 4 };

/* A map made by hand: heave grows below 0.25, a tongue of yaw at 0.6 is as wide as the amplitude, 0.02 at amplitude 1, and so
 * between the points of the grid. */
typedef struct hand_made {
    gough_map_options options;
    gough_map map;
    gough_map_point point[MOST_ROWS * COLUMNS];
    gough_map_row row[MOST_ROWS];
    gough_interval interval[MOST_ROWS * ROOM];
    gough_rest rest;
} hand_made;

static void fill_row(hand_made *h, size_t r, double amplitude) {
    gough_interval *interval = &h->interval[r * ROOM];
    h->row[r] = (gough_map_row){.value = amplitude, .period = {.period = 2}, .intervals = 1};
    interval[0] = (gough_interval){.from = 0, .to = 0.25, .growth = 100, .rate = log(100) / 2};
    strcpy(interval[0].mode.name, "heave");
    if (amplitude > 0) {
        h->row[r].intervals = 2;
        interval[1] = (gough_interval){.from = 0.62 - 0.01 * amplitude,
                                       .to = 0.62 + 0.01 * amplitude,
                                       .stiffness = 0.62,
                                       .growth = 1 + amplitude,
                                       .rate = log(1 + amplitude) / 2,
                                       .kind = GOUGH_INTERVAL_MINUS};
        strcpy(interval[1].mode.name, "yaw");
    }
    for (size_t c = 0; c < COLUMNS; c++) {
        const double G = gough_map_value(&h->options.stiffness, c);
        gough_map_point *p = &h->point[r * COLUMNS + c];
        p->stable = G >= 0.25;
        p->growth = p->stable ? 1 : pow(100, 1 - 4 * G);
        p->rate = log(p->growth) / 2;
        strcpy(p->mode, "heave");
    }
}

static hand_made *make(size_t rows) {
    hand_made *h = calloc(1, sizeof *h);
    h->options = gough_map_options_default();
    h->options.stiffness = (gough_map_range){0, 1, COLUMNS, false};
    h->options.axis = rows > 1 ? GOUGH_MAP_AMPLITUDE : GOUGH_MAP_NONE;
    h->options.second = (gough_map_range){0, 1, rows, false};
    h->options.intervals = ROOM;
    h->map = (gough_map){h->point, h->row, h->interval};
    for (size_t r = 0; r < rows; r++)
        fill_row(h, r, rows > 1 ? gough_map_value(&h->options.second, r) : 1);
    h->rest.threshold[0].stiffness = 0.4;
    strcpy(h->rest.threshold[0].mode.name, "tilt");
    return h;
}

static char *draw(const hand_made *h, const char *title) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.svg", path);
    const gough_map_figure figure = {
        .title = title,
        .units = {.dimensionless = true, .length = 1, .mass = 1, .time = 1},
        .rest = &h->rest};
    gough_error error = {.message = ""};
    ck_assert_msg(gough_map_draw(&h->options, &h->map, &figure, path, &error) == GOUGH_OK, "%s",
                  error.message);
    size_t length;
    char *text = read_bytes(path, &length);
    ck_assert_ptr_nonnull(strstr(text, "</svg>"));
    remove_folder(folder);
    return text;
}

static void expect_shown(const hand_made *h, const char *const *word) {
    char *text = draw(h, "A map");
    for (; *word; word++) ck_assert_msg(strstr(text, *word) != NULL, "no '%s'", *word);
    free(text);
}

START_TEST(one_axis_has_a_lane_for_each_mode) {
    hand_made *h = make(1);
    expect_shown(h,
                 (const char *const[]){"A map", "heave", "yaw", "tilt 0.4", "growth in each period",
                                       "stiffness of the feedback G, dimensionless", NULL});
    free(h);
}
END_TEST

START_TEST(two_axes_name_tongues_and_thresholds) {
    hand_made *h = make(MOST_ROWS);
    expect_shown(h, (const char *const[]){"A map", "yaw", "tilt 0.4", "growth per period",
                                          "amplitude of the motion", "<image", NULL});
    free(h);
}
END_TEST

START_TEST(a_title_is_text_and_nothing_else) {
    hand_made *h = make(MOST_ROWS);
    char *text = draw(h, "it's `touch ran` $(touch ran) a_b^{c}");
    ck_assert_ptr_nonnull(strstr(text, "`touch ran` $(touch ran) a_b^{c}"));
    free(text);
    free(h);
}
END_TEST

START_TEST(maps_of_rest_have_growth_rates) {
    for (size_t rows = 1; rows <= 3; rows += 2) {
        hand_made *h = make(rows);
        for (size_t r = 0; r < rows; r++) {
            h->row[r].period = (gough_period){.resting = true};
            h->row[r].intervals = 1;
            h->interval[r * ROOM].growth = NAN;
        }
        for (size_t p = 0; p < rows * COLUMNS; p++) h->point[p].growth = NAN;
        expect_shown(h, (const char *const[]){"growth rate", NULL});
        free(h);
    }
}
END_TEST

START_TEST(maps_without_anything_are_drawn) {
    hand_made *h = make(3);
    for (size_t r = 0; r < 3; r++) { /* no row has values */
        h->row[r].error.status = GOUGH_ERROR_NUMERICAL;
        h->row[r].intervals = 0;
    }
    free(draw(h, ""));
    for (size_t r = 0; r < 3; r++) h->row[r].error.status = GOUGH_OK;
    for (size_t p = 0; p < 3 * COLUMNS; p++) h->point[p].stable = true; /* nothing grows */
    free(draw(h, ""));
    free(h);
    h = make(1);
    h->row[0].intervals = 0;
    for (size_t p = 0; p < COLUMNS; p++) h->point[p].stable = true;
    free(draw(h, ""));
    h->options.stiffness = (gough_map_range){0.001, 1, COLUMNS, true};
    free(draw(h, ""));
    free(h);
}
END_TEST

START_TEST(one_stiffness_and_other_endings_are_refused) {
    hand_made *h = make(1);
    const gough_map_figure figure = {.title = ""};
    gough_error error;
    ck_assert_int_eq(gough_map_draw(&h->options, &h->map, &figure, "a.gif", &error),
                     GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, ".png, .svg or .pdf"));
    h->options.stiffness.count = 1;
    ck_assert_int_eq(gough_map_draw(&h->options, &h->map, &figure, "a.png", &error),
                     GOUGH_ERROR_INPUT);
    free(h);
}
END_TEST

/* The tongue lies between two points of the grid, which know nothing of it. */
START_TEST(a_tongue_between_grid_points_is_not_lost) {
    hand_made *h = make(1);
    field f;
    ck_assert(field_make(&f, &h->options, &h->map));
    ck_assert(fabs(field_level(&f, 0, 0.62) - log(2)) <= 1e-12);
    ck_assert(field_level(&f, 0, 0.615) > 0.7 * log(2)); /* half an ellipse: 0.866 of it */
    ck_assert(field_level(&f, 0, 0.6101) > 0);
    ck_assert(fabs(field_level(&f, 0, 0.6099)) <= 0);
    ck_assert(fabs(field_level(&f, 0, 0.6301)) <= 0);
    ck_assert(fabs(field_level(&f, 0, 0) - log(100)) <= 1e-12);
    field_free(&f);
    free(h);
}
END_TEST

/* Pixels of the image at G = 0.62: the tongue at the top, and none where it is narrower than a pixel by far. */
START_TEST(pixels_are_coloured_inside_intervals_only) {
    enum { WIDTH = 1000, HEIGHT = 100 };
    hand_made *h = make(MOST_ROWS);
    field f;
    unsigned char *pixel = calloc(3 * WIDTH * HEIGHT, 1);
    const field_view view = {WIDTH, HEIGHT, 0, 1, 0, 1};
    ck_assert(field_make(&f, &h->options, &h->map));
    field_paint(&f, &view, pixel);
    const unsigned char *top = pixel, *bottom = pixel + 3 * (size_t)WIDTH * (HEIGHT - 1);
    const unsigned char *plain = top + 3 * (size_t)500;
    ck_assert(memcmp(top + (size_t)3 * 619, plain, 3) != 0);
    ck_assert(memcmp(top + (size_t)3 * 612, plain, 3) != 0);
    ck_assert(memcmp(top + (size_t)3 * 605, plain, 3) == 0);
    ck_assert(memcmp(top + (size_t)3 * 635, plain, 3) == 0);
    ck_assert(memcmp(bottom + (size_t)3 * 612, plain, 3) == 0);
    ck_assert(memcmp(bottom + (size_t)3 * 249, plain, 3) != 0);
    ck_assert(memcmp(bottom + (size_t)3 * 251, plain, 3) == 0);
    field_free(&f);
    free(pixel);
    free(h);
}
END_TEST

/* Two tongues that move apart are not taken for each other, and one that ends has no partner. */
START_TEST(tongues_are_followed_from_row_to_row) {
    hand_made *h = make(MOST_ROWS);
    h->row[MOST_ROWS - 1].intervals = 1;
    field f;
    ck_assert(field_make(&f, &h->options, &h->map));
    int heave = 0, yaw = 0, lone = 0;
    for (size_t p = 0; p < f.pairs; p++) {
        const field_pair *pair = &f.pair[p];
        if (pair->low < 0 || pair->high < 0) {
            lone++;
            continue;
        }
        ck_assert_int_eq(pair->low, pair->high);
        heave += pair->low == 0;
        yaw += pair->low == 1;
    }
    ck_assert_int_eq(heave, MOST_ROWS - 1);
    ck_assert_int_eq(yaw, MOST_ROWS - 3);
    ck_assert_int_eq(lone, 2); /* it begins after the first row, and ends before the last */
    field_free(&f);
    free(h);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "figure/stability", 60, one_axis_has_a_lane_for_each_mode,
        two_axes_name_tongues_and_thresholds, a_title_is_text_and_nothing_else,
        maps_of_rest_have_growth_rates, maps_without_anything_are_drawn,
        one_stiffness_and_other_endings_are_refused, a_tongue_between_grid_points_is_not_lost,
        pixels_are_coloured_inside_intervals_only, tongues_are_followed_from_row_to_row);
}
