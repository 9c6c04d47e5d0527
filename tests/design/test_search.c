/* The search of five numbers with its usual 3000 designs is within 1 % of searches with 20000 designs from other seeds.
 * Label: campaign */
#include <math.h>
#include <stdio.h>

#include "design/jack.h"
#include "support/suite.h"

static base one;

static double best_of(uint32_t seed, size_t evaluations, gough_aim aim) {
    gough_design_request r = base_request(&one);
    gough_design_result d;
    gough_error error = {.message = ""};
    one.part = 0.8;
    r.seed = seed;
    r.evaluations = evaluations;
    for (int k = 0; k < GOUGH_AIMS; k++) r.weight[k] = k == (int)aim;
    ck_assert_msg(gough_design(&r, &d, &error) == GOUGH_OK, "%s", error.message);
    printf("seed %u, %zu designs: %s %.9g\n", (unsigned)seed, d.evaluations, gough_aim_name(aim),
           d.objective[1]);
    return d.objective[1];
}

START_TEST(usual_searches_come_within_1_percent_of_long_ones) {
    static const gough_aim aims[] = {GOUGH_AIM_FORCE, GOUGH_AIM_FOOTPRINT, GOUGH_AIM_SPEED};
    for (size_t i = 0; i < sizeof aims / sizeof aims[0]; i++) {
        const double best = fmin(best_of(11, 20000, aims[i]), best_of(12, 20000, aims[i]));
        for (uint32_t seed = 0; seed < 3; seed++)
            ck_assert_double_le(best_of(seed, 0, aims[i]), 1.01 * best);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("design/search", 1200, usual_searches_come_within_1_percent_of_long_ones);
}
