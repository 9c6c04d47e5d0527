/* A box decided by splitting, depth first: every part inside, or a pose that is not. */
#define NUMBER_DOUBLE
#include "workspace/certify.h"

#include <string.h>

/* Boxes that wait: each split leaves one behind, and a side is halved 60 times at most before rounding hides it. */
enum { WAITING = 60 * GOUGH_COMPONENTS + 1 };

/* sides below this part of the machine's size, or of a radian, are not split */
static const double NO_SIDE = 1e-13;

/* An angle moves the joints and turns their arms besides: what is left of second order and more falls fastest if a side of angles
 * counts so many times as long as the way of the joints. */
static const double TURNS = 2;

judge pose_judge(const space *s, const double pose[GOUGH_COMPONENTS]) {
    gough_box one;
    box_view view;
    memcpy(one.least, pose, sizeof one.least);
    memcpy(one.greatest, pose, sizeof one.greatest);
    box_view_of(s, &one, &view);
    return box_judge(s, &view);
}

int box_widest_side(const space *s, const box_view *view, double no_side) {
    double most = no_side * s->size;
    int widest = -1;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double way = view->half[c] * (c < 3 ? 1 : TURNS * s->h.reach);
        if (way > most) most = way, widest = c;
    }
    return widest;
}

static bool is_outside(const space *s, const double pose[GOUGH_COMPONENTS],
                       gough_certificate *found) {
    const judge j = pose_judge(s, pose);
    found->tests++;
    if (j.verdict != GOUGH_OUTSIDE) return false;
    found->verdict = GOUGH_OUTSIDE;
    found->binding = j.binding;
    memcpy(found->pose, pose, sizeof found->pose);
    return true;
}

/* a pose of the box that is not allowed: its centre, or the corner that is farthest from home */
static bool has_pose_outside(const space *s, const gough_box *box, const box_view *view,
                             gough_certificate *found) {
    double corner[GOUGH_COMPONENTS];
    if (is_outside(s, view->centre, found)) return true;
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        corner[c] = view->centre[c] < 0 ? box->least[c] : box->greatest[c];
    return is_outside(s, corner, found);
}

gough_certificate box_certify(const space *s, const gough_box *box, size_t most_tests) {
    gough_certificate found = {.verdict = GOUGH_INSIDE};
    gough_box waiting[WAITING];
    int count = 1;

    waiting[0] = *box;
    while (count > 0) {
        const gough_box one = waiting[--count];
        box_view view;
        box_view_of(s, &one, &view);
        const judge j = box_judge(s, &view);
        found.tests++;
        if (j.verdict == GOUGH_INSIDE) continue;
        if (has_pose_outside(s, &one, &view, &found)) return found;
        const int side = box_widest_side(s, &view, NO_SIDE);
        if (side < 0 || found.tests >= most_tests || count + 2 > WAITING) {
            found.verdict = GOUGH_UNDECIDED;
            found.binding = j.binding;
            memcpy(found.pose, view.centre, sizeof found.pose);
            return found;
        }
        /* the half that is farther from home comes first: what is not allowed is found there sooner */
        const int far = view.centre[side] >= 0;
        waiting[count] = waiting[count + 1] = one;
        waiting[count + far].least[side] = view.centre[side];
        waiting[count + 1 - far].greatest[side] = view.centre[side];
        count += 2;
    }
    return found;
}

gough_status box_refuse(gough_error *error) {
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "the ends of a box must be finite, and each least at most the greatest");
}

gough_status gough_box_certify(const gough_reach *reach, const gough_box *box,
                               gough_certificate *certificate, gough_error *error) {
    space s;
    if (!box_is_box(box)) return box_refuse(error);
    if (!reach_is_valid(reach)) return reach_refuse(error);
    space_begin(&s, reach);
    *certificate = box_certify(&s, box, reach->most_tests);
    return GOUGH_OK;
}
