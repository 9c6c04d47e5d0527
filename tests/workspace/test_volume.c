/* The volume of the positions at the orientation of home, where lengths are all that limits them, by other lines: parallel to x,
 * above the plane in which the machine is flat. There the determinant has the sign of home, and each line meets the spheres of the
 * legs in closed form.
 * Label: standard. */
#include <stdio.h>

#include "support/suite.h"
#include "workspace/flight.h"

/* lines across each side */
enum { ACROSS = 1500 };

/* How much of a line all legs allow: their greatest lengths one interval, from which each least length takes one away. */
static double allowed_on(double centre[GOUGH_LEGS][3], double limit[GOUGH_LEGS][2], double y,
                         double z) {
    double low = -INFINITY, high = INFINITY, gap[GOUGH_LEGS][2], sum = 0;
    int gaps = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double dy = y - centre[v][1], dz = z - centre[v][2], square = dy * dy + dz * dz;
        const double outer = sqrt(limit[v][1] * limit[v][1] - square),
                     inner = limit[v][0] * limit[v][0] - square;
        if (!(outer > 0)) return 0;
        low = fmax(low, centre[v][0] - outer), high = fmin(high, centre[v][0] + outer);
        if (!(inner > 0)) continue;
        gap[gaps][0] = centre[v][0] - sqrt(inner), gap[gaps][1] = centre[v][0] + sqrt(inner);
        gaps++;
    }
    /* from one gap to the next that begins first */
    for (double at = low; at < high;) {
        double next = high, beyond = at;
        for (int i = 0; i < gaps; i++) {
            if (gap[i][0] > at) next = fmin(next, gap[i][0]);
            if (gap[i][0] <= at) beyond = fmax(beyond, gap[i][1]);
        }
        if (beyond > at) {
            at = beyond;
            continue;
        }
        sum += next - at, at = next;
    }
    return sum;
}

static double by_lines(const gough_model *model, double limit[GOUGH_LEGS][2]) {
    const gough_platform *p = &model->machine.platform;
    double centre[GOUGH_LEGS][3], least = -INFINITY, greatest = INFINITY, top = INFINITY, sum = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        /* of the displacement from where the machine is flat */
        for (int k = 0; k < 3; k++) centre[v][k] = p->base[v][k] - p->top[v][k];
        ck_assert(fabs(centre[v][2]) <= 0);
        least = fmax(least, centre[v][1] - limit[v][1]);
        greatest = fmin(greatest, centre[v][1] + limit[v][1]);
        top = fmin(top, limit[v][1]);
    }
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j < ACROSS; j++)
            sum += allowed_on(centre, limit, least + (greatest - least) * (i + 0.5) / ACROSS,
                              top * (j + 0.5) / ACROSS);
    return sum * (greatest - least) * top / ACROSS / ACROSS;
}

START_TEST(volumes_are_those_of_other_lines) {
    gough_model *model = malloc(sizeof *model);
    const double home[3] = {0, 0, 0};
    dice d = {91};
    double worst = 0;
    for (int n = 1; n < 3; n++) {
        flight_machine(model);
        gough_reach reach = flight_reach(model);
        gough_volume volume;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            reach.limits.base_swing[v] = reach.limits.top_swing[v] = INFINITY;
            reach.limits.length[v][0] = n < 2 ? 0.3 : dice_between(&d, 1.5, 2.6);
            reach.limits.length[v][1] = dice_between(&d, 3, 4);
        }
        ck_assert(gough_workspace_volume(&reach, home, &volume, NULL) == GOUGH_OK);
        const double other = by_lines(model, reach.limits.length);
        printf("%.9g by upright lines, %.9g by level ones, %.6g to %.6g proved\n", volume.value,
               other, volume.least, volume.greatest);
        worst = fmax(worst, fabs(volume.value / other - 1));
        ck_assert(volume.exact && volume.least <= other && other <= volume.greatest);
    }
    printf("they differ by %.1e\n", worst);
    /* nine million level lines differ from the upright ones by 3e-6 at most, in five machines */
    ck_assert(worst < 5e-6);
    free(model);
}
END_TEST

int main(void) { return SUITE_RUN("volume", 60, volumes_are_those_of_other_lines); }
