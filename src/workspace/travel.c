/* Straight lines from home and elsewhere, by boxes along them, (space-7): gough_workspace_travel(), gough_workspace_ray(). */
#define NUMBER_DOUBLE
#include <string.h>

#include "workspace/certify.h"

/* a search ends so far from where it began, in sizes of the machine; steps in parts of that size, or of a radian */
static const double FARTHEST = 10, LEAST_STEP = 1e-9, FIRST_STEP = 1.0 / 16;

/* A line of components, and how far along it a search may go. */
typedef struct line {
    const double *start, *direction;
    double unit;     /* along it, joints move by the machine's size or the top by a radian */
    double farthest; /* ten of those, or where an angle is half a turn */
} line;

static line line_of(const space *s, const double start[GOUGH_COMPONENTS],
                    const double direction[GOUGH_COMPONENTS]) {
    line way = {start, direction, 0, INFINITY};
    double most = 0;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double speed = fabs(direction[c]);
        most = fmax(most, c < GOUGH_ROLL ? speed / s->size : speed);
        if (c >= GOUGH_ROLL && speed > 0)
            way.farthest =
                fmin(way.farthest, (REAL_PI - (direction[c] > 0 ? start[c] : -start[c])) / speed);
    }
    way.unit = 1 / most;
    way.farthest = fmax(0, fmin(way.farthest, FARTHEST * way.unit));
    return way;
}

static judge judge_part(const space *s, const line *way, double from, double to) {
    gough_box box;
    box_view view;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double one = way->start[c] + from * way->direction[c],
                     two = way->start[c] + to * way->direction[c];
        box.least[c] = fmin(one, two), box.greatest[c] = fmax(one, two);
    }
    box_view_of(s, &box, &view);
    return box_judge(s, &view);
}

static gough_ray follow_line(space *s, const line *way) {
    gough_ray ray = {.reach = 0};
    double step = FIRST_STEP * way->unit;

    s->way = way->direction;
    while (ray.reach < way->farthest && ray.tests < s->reach->most_tests) {
        const double next = fmin(ray.reach + step, way->farthest);
        const judge j = judge_part(s, way, ray.reach, next);
        ray.tests++;
        ray.binding = j.binding;
        if (j.verdict == GOUGH_INSIDE) {
            ray.reach = next, step *= 2;
            continue;
        }
        step /= 2;
        if (step < LEAST_STEP * way->unit) return ray;
    }
    if (ray.reach >= way->farthest) ray.binding = (gough_binding){GOUGH_BIND_NONE, 0, 0};
    return ray;
}

gough_status gough_workspace_ray(const gough_reach *reach, const double start[GOUGH_COMPONENTS],
                                 const double direction[GOUGH_COMPONENTS], gough_ray *ray,
                                 gough_error *error) {
    bool finite = true, moves = false;
    space s;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        finite &= isfinite(start[c]) && isfinite(direction[c]);
        moves |= fabs(direction[c]) > 0;
    }
    if (!finite || !moves)
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "a line of poses needs a finite start, and a finite direction other than 0");
    if (!reach_is_valid(reach)) return reach_refuse(error);
    space_begin(&s, reach);
    const line way = line_of(&s, start, direction);
    *ray = follow_line(&s, &way);
    return GOUGH_OK;
}

gough_status gough_workspace_travel(const gough_reach *reach, int component, gough_travel *travel,
                                    gough_error *error) {
    const double home[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
    space s;

    if (component < 0 || component >= GOUGH_COMPONENTS)
        return gough_fail(error, GOUGH_ERROR_INPUT, "there is no component %d", component);
    if (!reach_is_valid(reach)) return reach_refuse(error);
    *travel = (gough_travel){.tests = 1};
    space_begin(&s, reach);
    const judge at_home = pose_judge(&s, home);
    if (at_home.verdict == GOUGH_OUTSIDE) {
        travel->binding[0] = travel->binding[1] = at_home.binding;
        return reach_home_outside(&at_home.binding, error);
    }
    for (int end = 0; end < 2; end++) {
        double direction[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
        direction[component] = end ? 1 : -1;
        const line way = line_of(&s, home, direction);
        const gough_ray ray = follow_line(&s, &way);
        travel->end[end] = ray.reach > 0 ? direction[component] * ray.reach : 0;
        travel->binding[end] = ray.binding;
        travel->tests += ray.tests;
    }
    return GOUGH_OK;
}
