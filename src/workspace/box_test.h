/* One box against all limits, for the searches of this room. */
#ifndef GOUGH_WORKSPACE_BOX_TEST_H
#define GOUGH_WORKSPACE_BOX_TEST_H

#include "workspace/judge.h"
#include "workspace/space.h"

judge box_judge(const space *s, const box_view *view);

/* finite, and each least at most the greatest */
bool box_is_box(const gough_box *box);

#endif
