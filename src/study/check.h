/* Checks of a study's tree against the table of keys. */
#ifndef STUDY_CHECK_H
#define STUDY_CHECK_H

#include "study/tree.h"

/* Checks every key and value; says all that is wrong and marks the nodes. */
void study_check(study_messages *messages, study_node *root);

#endif
