/* Maps for tests: the memory of an answer, and studies whose maps are asked for. */
#ifndef TESTS_ANALYSE_MAPS_H
#define TESTS_ANALYSE_MAPS_H

#include "gough/map.h"

/* a map that was asked for, with its memory */
typedef struct {
    gough_map_options options;
    gough_map map;
    size_t rows, points;
    gough_status status;
    gough_error error;
} atlas;

/* options for one row of stiffnesses */
gough_map_options map_over(double from, double to, size_t count);

/* asks; map_find_all() insists that all rows have values */
void map_find(atlas *a, const gough_model *model, const gough_map_options *options);
void map_find_all(atlas *a, const gough_model *model, const gough_map_options *options);
void map_drop(atlas *a);

const gough_interval *map_interval(const atlas *a, size_t row, size_t i);

/* the paper's machine, heaving; a machine without symmetry, turning about all axes. Fed forward, without feedback; to be freed */
gough_model *map_heaving(const char *heave);
gough_model *map_tumbling(void);

#endif
