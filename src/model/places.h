/* Places of fields: which member of which struct a line of fields.def fills. Type and number of its values are those of the
 * member's declaration, so that they cannot differ from it. */
#ifndef MODEL_PLACES_H
#define MODEL_PLACES_H

#include <math.h>

#include "gough/fields.h"
#include "gough/simulate.h"

/* The places of gough_fields(), in its order. A table of its own, because the page's core has no use for sentences. */
const gough_place *gough_places(size_t *count);

/* ---- defaults: the text, and what it means ---- */

#define SAYS(text) text, .usual = {0, 0}
#define IS(x) #x, .usual = {x, x }
#define MEANS(text, x) text, .usual = {x, x}
#define MEANS_PAIR(text, x, y) text, .usual = {x, y}
#define FIRST_OF(first, ...) first
#define REST_OF(first, ...) __VA_ARGS__

/* ---- places ---- */

#define MEMBER_OF(type, member) (((type *)NULL)->member) /* of its declaration; never evaluated */
#define KIND_OF(x)                                                                                 \
    _Generic((x), double                                                                           \
             : GOUGH_KIND_NUMBER, double *                                                         \
             : GOUGH_KIND_NUMBER, double(*)[2]                                                     \
             : GOUGH_KIND_NUMBER, double(*)[3]                                                     \
             : GOUGH_KIND_NUMBER, double(*)[6]                                                     \
             : GOUGH_KIND_NUMBER, gough_formula                                                    \
             : GOUGH_KIND_FORMULA, gough_formula *                                                 \
             : GOUGH_KIND_FORMULA, bool                                                            \
             : GOUGH_KIND_FLAG, bool *                                                             \
             : GOUGH_KIND_FLAG, unsigned                                                           \
             : GOUGH_KIND_CHOICE, int                                                              \
             : GOUGH_KIND_CHOICE, uint64_t                                                         \
             : GOUGH_KIND_WHOLE)
#define SIZE_OF(x)                                                                                 \
    _Generic((x), double                                                                           \
             : sizeof(double), double *                                                            \
             : sizeof(double), double(*)[2]                                                        \
             : sizeof(double), double(*)[3]                                                        \
             : sizeof(double), double(*)[6]                                                        \
             : sizeof(double), gough_formula *                                                     \
             : sizeof(gough_formula), bool *                                                       \
             : sizeof(bool), default                                                               \
             : sizeof(x))

#define PLACE(part_, owner_, type, member)                                                         \
    .part = part_, .owner = owner_, .offset = offsetof(type, member),                              \
    .kind = KIND_OF(MEMBER_OF(type, member)),                                                      \
    .count = sizeof MEMBER_OF(type, member) / (SIZE_OF(MEMBER_OF(type, member)))

#define MACHINE(m) PLACE(GOUGH_PART_MACHINE, GOUGH_OWNER_MODEL, gough_model, machine.m)
#define MOTION(m) PLACE(GOUGH_PART_MOTION, GOUGH_OWNER_MODEL, gough_model, motion.m)
#define DISTURBANCE(m) PLACE(GOUGH_PART_DISTURBANCE, GOUGH_OWNER_MODEL, gough_model, disturbance.m)
#define CONTROL(m) PLACE(GOUGH_PART_CONTROL, GOUGH_OWNER_MODEL, gough_model, control.m)
#define INITIAL(m) PLACE(GOUGH_PART_INITIAL, GOUGH_OWNER_MODEL, gough_model, initial.m)
#define SIMULATION(m) PLACE(GOUGH_PART_SIMULATION, GOUGH_OWNER_SIMULATION, gough_simulation, m)
#define MOVE(m) PLACE(GOUGH_PART_MOTION, GOUGH_OWNER_MOVE, gough_move, m)
#define EXTERNAL(m) PLACE(GOUGH_PART_EXTERNAL, GOUGH_OWNER_EXTERNAL, gough_external, m)
#define WORKSPACE(m) PLACE(GOUGH_PART_WORKSPACE, GOUGH_OWNER_MODEL, gough_model, workspace.m)
#define FILE_ONLY(p) .part = GOUGH_PART_##p
#define GIVEN(m) .given = offsetof(gough_model, m)
#define MOVE_GIVEN(m) .given = offsetof(gough_move, m)
#define EXTERNAL_GIVEN(m) .given = offsetof(gough_external, m)
#define CHOICES(n) .choices = n
#define ALSO(p) .also = GOUGH_PART_##p

#endif
