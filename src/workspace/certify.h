/* Deciding about a box by splitting it, for the searches of this room. */
#ifndef GOUGH_WORKSPACE_CERTIFY_H
#define GOUGH_WORKSPACE_CERTIFY_H

#include "workspace/box_test.h"

/* gives up after so many boxes */
gough_certificate box_certify(const space *s, const gough_box *box, size_t most_tests);

/* what holds of one pose */
judge pose_judge(const space *s, const double pose[GOUGH_COMPONENTS]);

/* the side over which joints move most; −1 if none moves them by this part of the machine's size */
int box_widest_side(const space *s, const box_view *view, double no_side);

/* the sentence for a box whose numbers are not finite or in the wrong order */
gough_status box_refuse(gough_error *error);

/* whether a reach has an order of angles; what is said of one that has none, and of a home pose that exceeds a limit */
bool reach_is_valid(const gough_reach *reach);
gough_status reach_refuse(gough_error *error);
gough_status reach_home_outside(const gough_binding *binding, gough_error *error);

#endif
