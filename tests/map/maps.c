/* Maps for tests: the memory of an answer, and studies whose maps are asked for. */
#include "maps.h"

#include <stdlib.h>

#include "support/machines.h"

gough_map_options map_over(double from, double to, size_t count) {
    gough_map_options o = gough_map_options_default();

    o.stiffness = (gough_map_range){from, to, count, false};
    return o;
}

void map_find(atlas *a, const gough_model *model, const gough_map_options *options) {
    size_t bytes;
    void *memory;

    memset(a, 0, sizeof *a);
    a->options = *options;
    a->status = gough_map_size(model, options, &bytes, &a->error);
    if (a->status != GOUGH_OK) return;
    a->rows = gough_map_rows(options);
    a->points = a->rows * options->stiffness.count;
    a->map.point = calloc(a->points, sizeof *a->map.point);
    a->map.row = calloc(a->rows, sizeof *a->map.row);
    a->map.interval = calloc(a->rows * options->intervals, sizeof *a->map.interval);
    memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    ck_assert(a->map.point && a->map.row && a->map.interval && memory);
    a->status = gough_map_find(model, options, &a->map, memory, &a->error);
    free(memory);
}

void map_find_all(atlas *a, const gough_model *model, const gough_map_options *options) {
    map_find(a, model, options);
    ck_assert_msg(a->status == GOUGH_OK, "%s", a->error.message);
    for (size_t r = 0; r < a->rows; r++)
        ck_assert_msg(a->map.row[r].error.status == GOUGH_OK, "row %zu: %s", r,
                      a->map.row[r].error.message);
}

void map_drop(atlas *a) {
    free(a->map.point);
    free(a->map.row);
    free(a->map.interval);
}

const gough_interval *map_interval(const atlas *a, size_t row, size_t i) {
    return &a->map.interval[row * a->options.intervals + i];
}

/* ---- studies ---- */

static gough_model *new_model(void) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    model->control.feedforward = true;
    return model;
}

/* the paper's machine, heaving */
gough_model *map_heaving(const char *heave) {
    gough_model *model = new_model();

    paper_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_HEAVE], heave);
    return model;
}

/* a machine without symmetry, turning about all axes */
gough_model *map_tumbling(void) {
    gough_model *model = new_model();

    skew_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_SURGE], "0.1*cos(2*t)");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    set_formula(&model->motion.formula[GOUGH_ROLL], "0.15*cos(t)");
    set_formula(&model->motion.formula[GOUGH_YAW], "0.2*sin(t + 1)");
    return model;
}
