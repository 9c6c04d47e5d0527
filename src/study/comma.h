/* Formulas in braces or brackets that YAML has cut at a comma. */
#ifndef STUDY_COMMA_H
#define STUDY_COMMA_H

#include "study/tree.h"

/* Joins what YAML has cut in a list or mapping in braces or brackets, {yaw: 1*ramp(t, 8)}: a plain text with an open parenthesis
 * and the plain texts without a value that follow it, up to the one that closes it. Such texts have no other meaning in a study,
 * as every key needs a value. Whatever does not close, or has more than blanks around the comma, stays as it is. */
void study_join_at_commas(study_arena *arena, study_node *parent);

#endif
