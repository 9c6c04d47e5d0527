/* The columns of every table, from gough/columns.def. */
#include "gough/simulate.h"

enum { ALWAYS, SIMULATED, REACTIONS, JOINTS, COMMANDS, ACTUATORS };

typedef struct column_line {
    gough_column_info info;
    int when; /* it is filled */
} column_line;

#define GOUGH_COLUMN(id, name, what, length, mass, time, angle, when)                              \
    [GOUGH_##id] = {{name, what, length, mass, time, angle}, when},
#define LEG(id, leg, name, what, after, ...)                                                       \
    [GOUGH_##id + (leg)-1] = LEG_LINE(name #leg, what #leg after, __VA_ARGS__)
#define LEG_LINE(name, what, length, mass, time, angle, when)                                      \
    { {name, what, length, mass, time, angle}, when }
#define GOUGH_LEG_COLUMNS(id, ...)                                                                 \
    LEG(id, 1, __VA_ARGS__), LEG(id, 2, __VA_ARGS__), LEG(id, 3, __VA_ARGS__),                     \
        LEG(id, 4, __VA_ARGS__), LEG(id, 5, __VA_ARGS__), LEG(id, 6, __VA_ARGS__),
#define AXIS(id, place, axis, leg, name, what, after, ...)                                         \
    [GOUGH_##id + 3 * ((leg)-1) + (place)] =                                                       \
        LEG_LINE(name #axis #leg, what #leg after " along base " #axis, __VA_ARGS__)
#define VECTOR(id, leg, ...)                                                                       \
    AXIS(id, 0, x, leg, __VA_ARGS__), AXIS(id, 1, y, leg, __VA_ARGS__),                            \
        AXIS(id, 2, z, leg, __VA_ARGS__)
#define GOUGH_LEG_VECTORS(id, ...)                                                                 \
    VECTOR(id, 1, __VA_ARGS__), VECTOR(id, 2, __VA_ARGS__), VECTOR(id, 3, __VA_ARGS__),            \
        VECTOR(id, 4, __VA_ARGS__), VECTOR(id, 5, __VA_ARGS__), VECTOR(id, 6, __VA_ARGS__),

static const column_line columns[GOUGH_COLUMNS] = {
#include "gough/columns.def"
};

const gough_column_info *gough_column(int column) {
    return column >= 0 && column < GOUGH_COLUMNS ? &columns[column].info : NULL;
}

bool gough_column_filled(int column, bool simulated, const gough_simulation *simulation) {
    if (column < 0 || column >= GOUGH_COLUMNS) return false;
    if (columns[column].when == REACTIONS) return simulation->reactions;
    if (columns[column].when == JOINTS) return simulation->joints;
    if (columns[column].when == COMMANDS)
        return simulated && (simulation->commands || simulation->actuators);
    if (columns[column].when == ACTUATORS) return simulated && simulation->actuators;
    return simulated || columns[column].when == ALWAYS;
}
