/* Thinning of long lines: no peak is lost, order is kept, the number of points is bounded. */
#include <math.h>

#include "figure/sheet.h"
#include "support/random.h"
#include "support/suite.h"

enum { ROWS = 60001, BUCKETS = 300 };

typedef struct line {
    double x[ROWS], y[ROWS];
    size_t index[2 * BUCKETS + 2];
    size_t kept;
} line;

static line *noisy_line(void) {
    line *l = malloc(sizeof *l);
    dice d = {3};
    for (size_t i = 0; i < ROWS; i++) {
        l->x[i] = (double)i * 0.002;
        l->y[i] = sin(l->x[i]) + dice_between(&d, -0.1, 0.1);
    }
    return l;
}

static bool keeps(const line *l, size_t row) {
    for (size_t k = 0; k < l->kept; k++) {
        if (l->index[k] == row) return true;
    }
    return false;
}

START_TEST(short_lines_are_kept_whole) {
    line *l = noisy_line();
    l->kept = sheet_thin(l->x, l->y, 2 * BUCKETS + 2, BUCKETS, l->index);
    ck_assert_uint_eq(l->kept, 2 * BUCKETS + 2);
    for (size_t k = 0; k < l->kept; k++) ck_assert_uint_eq(l->index[k], k);
    ck_assert_uint_eq(sheet_thin(l->x, l->y, 0, BUCKETS, l->index), 0);
    free(l);
}
END_TEST

START_TEST(peaks_ends_and_order_are_kept) {
    line *l = noisy_line();
    l->y[12345] = 7.0;
    l->y[12346] = -8.0;
    l->y[54321] = 9.0;
    l->kept = sheet_thin(l->x, l->y, ROWS, BUCKETS, l->index);
    ck_assert_uint_le(l->kept, 2 * BUCKETS + 2);
    ck_assert_uint_ge(l->kept, 2 * BUCKETS - 2);
    ck_assert(keeps(l, 0) && keeps(l, ROWS - 1));
    ck_assert(keeps(l, 12345) && keeps(l, 12346) && keeps(l, 54321));
    for (size_t k = 1; k < l->kept; k++) ck_assert_uint_lt(l->index[k - 1], l->index[k]);
    free(l);
}
END_TEST

/* The thinned line never leaves the band of the whole one within a stretch. */
START_TEST(each_stretch_keeps_its_least_and_greatest) {
    line *l = noisy_line();
    l->kept = sheet_thin(l->x, l->y, ROWS, BUCKETS, l->index);
    const size_t stretch = (ROWS - 1) / BUCKETS;
    for (size_t b = 1; b + 1 < BUCKETS; b++) {
        size_t greatest = b * stretch + 1;
        for (size_t i = greatest; i <= (b + 1) * stretch; i++) {
            if (l->y[i] > l->y[greatest]) greatest = i;
        }
        /* a row at the border of two stretches may count to either, so one of the neighbours may stand for it */
        const bool border = greatest <= b * stretch + 1 || greatest >= (b + 1) * stretch - 1;
        ck_assert_msg(keeps(l, greatest) || border, "stretch %zu lost row %zu", b, greatest);
    }
    free(l);
}
END_TEST

START_TEST(gaps_stay_gaps) {
    line *l = noisy_line();
    for (size_t i = 30000; i < 40000; i++) l->y[i] = NAN;
    l->kept = sheet_thin(l->x, l->y, ROWS, BUCKETS, l->index);
    size_t gaps = 0;
    for (size_t k = 0; k < l->kept; k++) gaps += isnan(l->y[l->index[k]]) ? 1 : 0;
    ck_assert_uint_ge(gaps, 40);
    ck_assert_uint_le(gaps, 60);
    free(l);
}
END_TEST

START_TEST(an_abscissa_that_stands_still_or_falls_is_no_harm) {
    line *l = noisy_line();
    for (size_t i = 0; i < ROWS; i++) l->x[i] = 1.0;
    l->kept = sheet_thin(l->x, l->y, ROWS, BUCKETS, l->index);
    ck_assert_uint_ge(l->kept, 2);
    ck_assert_uint_le(l->kept, 2 * BUCKETS + 2);
    for (size_t i = 0; i < ROWS; i++) l->x[i] = -(double)i;
    l->kept = sheet_thin(l->x, l->y, ROWS, BUCKETS, l->index);
    ck_assert_uint_le(l->kept, 2 * BUCKETS + 2);
    for (size_t i = 0; i < ROWS; i++) l->x[i] = NAN;
    l->kept = sheet_thin(l->x, l->y, ROWS, BUCKETS, l->index);
    ck_assert_uint_le(l->kept, 2 * BUCKETS + 2);
    free(l);
}
END_TEST

/* a loop once round: no point is far from one that is kept, and few are */
START_TEST(a_loop_keeps_its_shape) {
    line *l = noisy_line();
    for (size_t i = 0; i < ROWS; i++) {
        l->x[i] = cos(6.28 * (double)i / ROWS);
        l->y[i] = 1000 * sin(6.28 * (double)i / ROWS);
    }
    size_t *index = calloc(ROWS, sizeof *index);
    const size_t kept = sheet_thin_loop(l->x, l->y, ROWS, 0.01, index);
    ck_assert_uint_ge(kept, 100);
    ck_assert_uint_le(kept, 400);
    ck_assert_uint_eq(index[0], 0);
    ck_assert_uint_eq(index[kept - 1], ROWS - 1);
    for (size_t k = 1; k < kept; k++) {
        ck_assert_uint_gt(index[k], index[k - 1]);
        for (size_t i = index[k - 1]; i < index[k]; i++)
            ck_assert(fabs(l->x[i] - l->x[index[k - 1]]) <= 0.02 &&
                      fabs(l->y[i] - l->y[index[k - 1]]) <= 20);
    }
    free(index);
    free(l);
}
END_TEST

int main(void) {
    return SUITE_RUN("figure/thin", 10, short_lines_are_kept_whole, peaks_ends_and_order_are_kept,
                     each_stretch_keeps_its_least_and_greatest, gaps_stay_gaps,
                     an_abscissa_that_stands_still_or_falls_is_no_harm, a_loop_keeps_its_shape);
}
