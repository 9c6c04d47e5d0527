/* The volume of the positions at the orientation of home, where lengths are all that limits them, by other lines: parallel to x,
 * above the plane in which the machine is flat. There the determinant has the sign of home, and each line meets the spheres of the
 * legs in closed form.
 * Label: standard. */
#include <stdio.h>
#include <stdlib.h>

#include "support/suite.h"
#include "workspace/flight.h"

static const double PI = 3.14159265358979323846;

/* Gauss's rule with GAUSS points in each of at least two parts between neighbouring edges, about PARTS across the whole */
enum { GAUSS = 2, PARTS = 1000, EDGES = 4 * GOUGH_LEGS + 2 };

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

/* nodes and weights on [−1, 1], by Newton's method for the roots of Legendre's polynomial */
static void gauss(double node[GAUSS], double weight[GAUSS]) {
    for (int i = 0; i < GAUSS; i++) {
        double x = cos(PI * (i + 0.75) / (GAUSS + 0.5)), slope = 1;
        for (int n = 0; n < 20; n++) {
            double before = 1, now = x;
            for (int k = 2; k <= GAUSS; k++) {
                const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
                before = now, now = next;
            }
            slope = GAUSS * (x * now - before) / (x * x - 1);
            x -= now / slope;
        }
        node[i] = x, weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
}

/* where lines parallel to x are sums, or sums of these are: between edges, with x = sin θ, so that roots at edges are smooth */
typedef struct plane {
    double centre[GOUGH_LEGS][3], (*limit)[2], node[GAUSS], weight[GAUSS];
} plane;

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double sum_between(plane *p, double (*value)(plane *, double, double), double y,
                          double edge[EDGES], int count) {
    double sum = 0;
    qsort(edge, (size_t)count, sizeof *edge, by_size);
    for (int i = 0; i + 1 < count; i++) {
        const double middle = (edge[i] + edge[i + 1]) / 2, half = (edge[i + 1] - edge[i]) / 2;
        const int parts = 2 + (int)(PARTS * 2 * half / (edge[count - 1] - edge[0]));
        const double step = PI / parts;
        for (int k = 0; k < parts && half > 0; k++) {
            for (int n = 0; n < GAUSS; n++) {
                const double angle = step * (k + (1 + p->node[n]) / 2) - PI / 2;
                sum += step / 2 * p->weight[n] * half * cos(angle) *
                       value(p, y, middle + half * sin(angle));
            }
        }
    }
    return sum;
}

static double line_at(plane *p, double y, double z) {
    return allowed_on(p->centre, p->limit, y, z);
}

/* above the flat machine: all heights up to the highest, with edges where lines touch a sphere */
static double section_at(plane *p, double unused, double y) {
    double edge[EDGES], top = INFINITY;
    int count = 2;
    (void)unused;
    for (int v = 0; v < GOUGH_LEGS; v++) top = fmin(top, p->limit[v][1]);
    edge[0] = 0, edge[1] = top;
    for (int v = 0; v < 2 * GOUGH_LEGS; v++) {
        const double l = p->limit[v / 2][v % 2], dy = y - p->centre[v / 2][1];
        if (l * l > dy * dy && l * l - dy * dy < top * top) edge[count++] = sqrt(l * l - dy * dy);
    }
    return sum_between(p, line_at, y, edge, count);
}

static double by_lines(const gough_model *model, double limit[GOUGH_LEGS][2]) {
    const gough_platform *platform = &model->machine.platform;
    plane p = {.limit = limit};
    double edge[EDGES] = {-INFINITY, INFINITY};
    int count = 2;
    gauss(p.node, p.weight);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        /* of the displacement from where the machine is flat */
        for (int k = 0; k < 3; k++) p.centre[v][k] = platform->base[v][k] - platform->top[v][k];
        ck_assert(fabs(p.centre[v][2]) <= 0);
        edge[0] = fmax(edge[0], p.centre[v][1] - limit[v][1]);
        edge[1] = fmin(edge[1], p.centre[v][1] + limit[v][1]);
    }
    for (int v = 0; v < 4 * GOUGH_LEGS; v++) {
        const double l = limit[v / 4][v % 2], at = p.centre[v / 4][1] + (v / 2 % 2 ? l : -l);
        if (at > edge[0] && at < edge[1]) edge[count++] = at;
    }
    return sum_between(&p, section_at, 0, edge, count);
}

START_TEST(volumes_are_those_of_other_lines) {
    gough_model *model = malloc(sizeof *model);
    const double home[3] = {0, 0, 0};
    dice d = {91};
    double worst = 0;
    for (int n = 1; n < 4; n++) {
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
    /* what six digits allow; finer sums of both kinds come nearer to each other */
    ck_assert(worst < 1e-6);
    free(model);
}
END_TEST

int main(void) { return SUITE_RUN("volume", 60, volumes_are_those_of_other_lines); }
