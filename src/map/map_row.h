/* One row of the stability map: what threads work on. Theory: docs/theory/floquet.md. */
#ifndef GOUGH_MAP_MAP_ROW_H
#define GOUGH_MAP_MAP_ROW_H

#include "floquet/sampled_orbit.h"
#include "gough/map.h"
#include "linear/gain_pattern.h"
#include "map/scan.h"
#include "map/transition.h"

/* what is common to all rows */
typedef struct map_job {
    const gough_model *model;
    const gough_map_options *options; /* with its defaults filled in */
    gough_map *map;
    const struct analyse_width *width;
    bool sampled; /* rows have a sampled controller … */
    size_t table; /* … and tables of this many bytes */
    size_t parts; /* most of any row */
    double finer; /* steps of each part are this many times those of transition_divide() */
    /* a part of the row's work is done; nonzero stops */
    int (*report)(const struct map_job *job, double part);
    void *context;
} map_job;

/* What a thread has of its own, and of the row it is at. */
typedef struct {
    const map_job *job;
    size_t index;
    gough_model model; /* the study as it is in this row */
    gough_period period;
    double component[GOUGH_COMPONENTS]; /* where it rests, if it does */
    bool damped;
    bool sampled; /* the controller is */
    /* it is not, but drives lag or reach limits, the controller integrates, or gains are matrices: as the stiffness rises
     * multipliers turn in no one direction */
    bool unordered;
    gain_pattern stiffness; /* of matrices of gains: the axis is its size */
    sampled_orbit
        *orbit;  /* about the program then; NULL in a worker that only asks what rows are like */
    void *table; /* memory of its table */
    symplectic form;
    division d;
    transitions bare, complete; /* D = 0; D as it is, where it is not 0 */
    double (*factor)[MATRIX];   /* Φ over each part, for one stiffness */
    void *scratch;
    double *node; /* stiffnesses to look at */
    size_t nodes, places, room;
    size_t meetings;
    double reported;
    bool
        alone; /* multipliers of each stiffness by themselves, about the loop's own motion or under loads that vary */
} map_worker;

/* Bytes of one worker and all that belongs to it. */
size_t map_worker_size(const map_job *job);
map_worker *map_worker_begin(const map_job *job, void *memory);

/* the loop of the row */
linear_loop map_row_loop(const map_worker *w);

/* whether the row's loop keeps its program */
bool map_row_kept(const map_worker *w);

/* whether the row needs tables: it moves, and its stiffnesses are not looked at one by one */
bool map_row_has_tables(const map_worker *w);

/* The study as it is in a row, its period, and how the period is divided. */
gough_status map_row_begin(map_worker *w, size_t index, gough_error *error);

/* map_sampled.c: the second axis and the controller of a row whose controller is sampled, about its program unless that rests */
gough_status map_sampled_begin(map_worker *w, gough_error *error);

/* Bytes that the largest table of any row takes; rows whose tables take more than a limit have none. */
size_t map_sampled_table(const map_job *job);

/* Its points and intervals. Returns nonzero if stopped. */
int map_sampled_find(map_worker *w);

/* the loop at a stiffness; the context is a map_worker. Returns nonzero where the work is to stop */
typedef int map_look(void *context, double stiffness, sample *s);

/* map_alone.c: points and intervals of a row by a look at each stiffness. Returns nonzero if stopped. */
int map_alone_find(map_worker *w, map_look *look);

/* The stiffness of the axis: alike in all legs, or of a matrix that keeps its pattern. */
void map_set_stiffness(const map_worker *w, double stiffness, gough_control *control);

/* Of map_row.c for map_sampled.c: one point of the grid, an interval found, progress; the last two return nonzero to stop. */
int map_put_point(map_worker *w, void *context, size_t i, const sample *s);
void map_put_interval(void *context, const gough_interval *found);
int map_report(map_worker *w, double part);

/* How far Φ of the row changes when its steps are halved, relative to its largest element. */
gough_status map_row_accuracy(map_worker *w, double finer, double *change, gough_error *error);

/* steps in a period */
size_t map_row_steps(const map_worker *w, double finer);

/* No values yet. */
void map_row_clear(const map_job *job, size_t index);

/* All of a row: points, intervals, and what it says of itself. Returns nonzero if stopped. */
int map_row_find(map_worker *w, size_t index);

/* edges, relative to the greatest stiffness, where each look takes long */
extern const double map_edge_width_slow;

/* most stiffnesses a row looks at besides the grid */
enum { MAP_MOST_NODES = 1 << 16, MAP_MOST_PLACES = 1 << 13 };

#endif
