/* The periodic motion of a loop with a sampled controller, and the derivative of its samples taken together: for one loop, and for
 * the rows of a map, where one stiffness follows another. Theory: docs/theory/loop.md. */
#ifndef GOUGH_FLOQUET_SAMPLED_ORBIT_H
#define GOUGH_FLOQUET_SAMPLED_ORBIT_H

#include "floquet/sampled_flow.h"
#include "gough/floquet.h"

typedef double sampled_matrix[SAMPLED_ROWS * SAMPLED_ROWS];

/* Of samples about the program, for many stiffnesses alike in all legs. */
typedef struct sampled_table sampled_table;

typedef struct {
    linear_loop loop;
    gough_control control; /* with the period that is used */
    sampled_layout layout;
    size_t samples, periods, steps;
    bool adjusted; /* the period is not the model's */
    double start;
    double unit[SAMPLED_ROWS]; /* of a deviation's numbers */

    sampled_table *table;    /* NULL: the motion is found without a table */
    sampled_state state;     /* the motion found, just before its first sample */
    sampled_map map;         /* of all samples about it */
    sampled_matrix factors;  /* 1 − Φ in those units, as LAPACK factors it … */
    int pivot[SAMPLED_ROWS]; /* … with its row exchanges */
} sampled_orbit;

/* Lays out the loop of a model about its program; the model must stay where it is. GOUGH_ERROR_INPUT: as from
 * gough_floquet_sampled(). */
gough_status sampled_orbit_begin(sampled_orbit *o, const gough_model *model,
                                 const gough_period *period, gough_error *error);

/* The controller with a period that fits a program, (loop-11): delay and preview in proportion. Returns whether it is another. */
bool sampled_fit(gough_sampling *sampling, double period, size_t *samples, size_t *periods);

/* Finds the motion for the gains that are in o->control, from the program: that of one stiffness does not depend on others. */
gough_status sampled_orbit_find(sampled_orbit *o, gough_error *error);

/* The multipliers of the motion found, by falling magnitude, and how many they are: up to GOUGH_SAMPLED, and none below 1e-9 of the
 * largest, where they are rounding; 0 where they are no numbers. */
int sampled_orbit_multipliers(const sampled_orbit *o, gough_multiplier list[GOUGH_SAMPLED]);

/* ---- between sampled_orbit.c, sampled_nodes.c and sampled_shooting.c ---- */

/* of the steps */
extern const double sampled_tolerance;

/* numbers of a deviation from one state to another, or a state changed by them */
void sampled_compare(const sampled_layout *l, const sampled_state *from, const sampled_state *to,
                     double *deviation);
void sampled_change(const sampled_layout *l, const double *deviation, sampled_state *state);

/* the determinant of the pose of a state; its condition is infinite if the state has numbers that are not finite */
double sampled_determinant(const sampled_orbit *o, const sampled_state *state, double *condition);

/* Whether the platform is still on the side of the singular poses where it had the determinant `side`. No real machine moves
 * through a singular pose, so a motion computed beyond one means nothing. */
bool sampled_keeps_its_side(const sampled_orbit *o, const sampled_state *state, double side);

/* product ← A product, with A of n rows */
void sampled_multiply(int n, int columns, const double *a, double *product);

/* 1 − Φ of o->map in the units of a deviation, factored; false if it has no inverse */
bool sampled_factor(sampled_orbit *o);

/* (floquet-7): solves (1 − Φ) step = missing with the matrix factored last. Returns the size of the step in the units of a
 * deviation, INFINITY if it is not finite. */
double sampled_newton_step(const sampled_orbit *o, double *step);

/* sampled_nodes.c: the motion from the program, without runs of a whole period; whether it was found, its state before the first
 * sample, and the derivative about it in o->map */
bool sampled_join(sampled_orbit *o, sampled_state *state);

/* sampled_shooting.c: memory of a table in bytes, aligned to 64; an empty one; the motion by its means for the stiffness in
 * o->control, alike in all legs: whether it was found, to about 1e-11, and its state before the first sample */
size_t sampled_table_size(size_t samples, int n);
sampled_table *sampled_table_begin(size_t samples, int n, void *memory);
bool sampled_shoot(sampled_orbit *o, sampled_state *state);

#endif
