/* Scalars of a study as numbers, words and formulas, with what is wrong said at their place. */
#ifndef STUDY_VALUE_H
#define STUDY_VALUE_H

#include "gough/model.h"
#include "study/keys.h"
#include "study/tree.h"

typedef enum study_decimal {
    STUDY_DECIMAL,
    STUDY_NO_DECIMAL,
    STUDY_DECIMAL_AND_MORE, /* a number, then something else */
    STUDY_NOT_FINITE
} study_decimal;

/* Reads a decimal number by gough_decimal_read(); value: NaN unless there is one.
 * rest: offset of what is left after the number (of STUDY_DECIMAL_AND_MORE). */
study_decimal study_decimal_read(const char *text, size_t length, double *value, size_t *rest);

/* The number of a scalar that was checked before; NaN if it is not a number. */
double study_number(const study_node *node);

/* Whether a node is there and is the word that stands for the least number that is possible. */
bool study_is_least(const study_node *node);

/* "platform.height", "motion.moves.2.start": the path of a node in the study, as --set takes it. */
const char *study_node_path(study_arena *arena, const study_node *node);

/* The shape of a value: that of its key, but of a drive in a list of six only what one leg has. */
gough_shape study_shape_of(const study_node *node, const gough_key *key);

/* The place of a word in the words of a choice, "rounding, none", from 0; -1 if it is not among them. */
int study_choice_index(const char *choices, const char *word);

/* Checks say what is wrong and mark the node. */
bool study_check_number(study_messages *messages, study_node *node, const gough_bound *bound);
bool study_check_formula(study_messages *messages, study_node *node);
bool study_check_choice(study_messages *messages, study_node *node, const char *choices);
bool study_check_text(study_messages *messages, study_node *node, gough_shape shape);

/* Says that a node is not of the shape that its key asks for. */
void study_say_shape(study_messages *messages, study_node *node, const char *phrase);

#endif
