/* A million poses, motions and loads drawn from certified boxes of the flight simulator keep all limits, for several shapes.
 * Label: campaign: it takes minutes.
 * Not sanitized: test_demands.c runs the same. */
#include <stdio.h>

#include "support/suite.h"
#include "workspace/flight.h"

enum { SHAPES = 4, DRAWS = 250000 };

START_TEST(certified_boxes_survive_a_million_motions) {
    gough_model *model = malloc(sizeof *model);
    dice d = {51};
    flight_demands(model);
    for (int v = 0; v < GOUGH_LEGS; v++) model->machine.platform.legs.force[v][1] = 50000;
    const gough_reach reach = flight_reach(model);
    for (int shape = 0; shape < SHAPES; shape++) {
        gough_largest_box largest;
        gough_error error = {0};
        gough_box about;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            about.least[c] = -dice_between(&d, 0.05, 1);
            about.greatest[c] = dice_between(&d, 0.05, 1);
        }
        ck_assert_msg(gough_workspace_box(&reach, &about, &largest, &error) == GOUGH_OK, "%s",
                      error.message);
        printf("shape %d: scale %.6g of %.6g\n", shape, largest.scale, largest.upper);
        ck_assert(largest.scale > 0);
        for (int n = 0; n < DRAWS; n++) {
            double pose[GOUGH_COMPONENTS];
            flight_load load;
            flight_pick(&largest.box, n % 2, &d, pose);
            flight_draw(model, pose, n % 4 < 2, &d, &load);
            ck_assert_msg(flight_over(&reach, &load) <= 1e-10 &&
                              flight_excess(model, &reach, pose) <= 1e-10,
                          "shape %d, pose %d of seed 51", shape, n);
        }
    }
    free(model);
}
END_TEST

int main(void) { return SUITE_RUN("million", 1200, certified_boxes_survive_a_million_motions); }
