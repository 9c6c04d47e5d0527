/* From a checked tree to the structs by the table of fields: defaults, and the values that the tree gives. */
#ifndef STUDY_FILL_H
#define STUDY_FILL_H

#include "gough/study.h"
#include "study/tree.h"

/* Sets all fields of a part, one of gough_part, to their defaults. */
void study_part_reset(gough_study *study, unsigned part);

/* Reads the fields of a part that the tree gives, except those in a section with an error and those that have rules of their own:
 * gravity, inertia, and constraints given by a mapping. */
void study_part_read(gough_study *study, const study_node *root, unsigned part);

/* Reads one element of motion.moves or of external, in the study's units, into a gough_move or gough_external that is zero; `owner`
 * tells which. */
void study_element_read(void *element, gough_owner owner, const gough_units *units,
                        const study_node *node);

/* Reads a list of six drives, each into the numbers of its leg. */
void study_drives_read(gough_study *study, const study_node *list);

/* The numbers of a checked list in units of the run, in order, and of the lists in it; nothing if it is NULL. */
void study_numbers(const study_node *list, const gough_units *units, gough_unit unit,
                   double *value);

/* Compiles a formula in t, both in the study's units, to one in units of the run. */
gough_status study_formula(const study_node *node, const gough_units *units, gough_unit unit,
                           gough_formula *formula, size_t *offset, gough_error *error);

#endif
