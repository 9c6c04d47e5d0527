/* The units that a study chooses, and what depends on them while it is checked. */
#ifndef STUDY_CHOSEN_UNITS_H
#define STUDY_CHOSEN_UNITS_H

#include "gough/study.h"
#include "study/tree.h"

/* The units of a study by the root of its tree; words that are no units count as left out. */
gough_units study_units_of(const study_node *root);

/* The same by any node of the tree. */
gough_units study_units_of_node(const study_node *node);

/* Says at a word of the mapping `units` that it is the unit of something else, or one composed of others.
 * @return true if it is, and that was said */
bool study_units_check(study_messages *messages, study_node *node, const char *path);

enum { STUDY_RULE = 80 };

/* The bound of a key in the units of the study that a node belongs to. rule: memory for its words. */
gough_bound study_units_bound(const study_node *node, const gough_key *key, char rule[STUDY_RULE]);

#endif
