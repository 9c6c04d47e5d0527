/* The search for the feedback: what its parts share. Theory: docs/theory/tuning.md. */
#ifndef GOUGH_TUNE_TUNE_H
#define GOUGH_TUNE_TUNE_H

#include "gough/tune.h"

enum {
    TUNE_DECADE = 20,   /* points of the curve in a decade of G */
    TUNE_ROUND = 20,    /* of them run at once */
    TUNE_INTERVALS = 64 /* in which a mode grows, handled at a time */
};

/* an interval of G in which a mode grows */
typedef struct {
    double from, to;
    gough_tuning_binding kind; /* threshold or tongue */
    gough_mode mode;
} tune_growth;

typedef struct tune {
    const gough_model *model;
    const gough_tuning_options *options;
    gough_simulation simulation; /* adaptive */
    gough_model *
        steady; /* a copy whose stability is looked at: its program at rest at home where it has no period */
    gough_model *loop; /* a copy with the feed-forward asked for, its gains set as they are tried */
    gough_period period;
    bool ratio;       /* D follows from G */
    double frequency; /* of the fastest mode at home where G is 1 and outweighs the rest */
    double unit;      /* of stiffness: the largest force, or the weight, over R_b */
    double
        settled; /* a stiffness over this outweighs all that is known of the run's inertia and damping */
    double
        furthest; /* if not told where to end, the search does not go further than this or `greatest` */
    double least, greatest;
    double slow;     /* that of the slowest */
    double map_top;  /* up to here intervals of growth are mapped */
    int quiet;       /* rounds in which nothing grew, since something did */
    bool most_steps; /* `greatest` is where runs get too long */
    bool bounded;    /* the options say where the search ends */
    bool fine;       /* all runs take small fixed steps: adaptive ones have missed something */
    /* The controller is sampled; or it is continuous, and drives lag or integrals add up. In both cases points are looked at at
     * rest at home, and what is to be named along the program too, if that has a period … */
    bool sampled, states, naming;
    bool cheap; /* … as points of the curve are that hold at home, if a look takes little time */
    bool edged; /* `greatest` is where the loop no longer holds the platform */
    double quick; /* the greatest rate at which a drive follows its command; 0: at once */
    gough_sampled_margins margins; /* where it never does */
    gough_rest rest;

    gough_batch_run run[TUNE_ROUND + 1];
    gough_control control[TUNE_ROUND + 1];
    gough_outcome outcome[TUNE_ROUND + 1];
    gough_map_point map_point[TUNE_ROUND + 2];
    gough_map_row map_row;
    gough_interval map_interval[TUNE_INTERVALS];
    gough_batch_options batch;
    void *batch_memory, *map_memory;
    size_t map_bytes;

    gough_tuning_point *point;
    gough_tuning *tuning;
    size_t whole; /* points of the curve from least to greatest … */
    size_t last;  /* … and on to `furthest` */
} tune;

/* ---- tune_options.c ---- */

/* whether the options, and the model's damping, can be searched with */
gough_status tune_check_options(const gough_model *model, const gough_tuning_options *options,
                                gough_error *error);

/* ---- tune.c ---- */

/* a continuous controller without integral and ideal drives, whose loop has the modes of the platform only; and back */
void tune_make_plain(gough_model *model);
void tune_make_as_asked(const tune *t, gough_model *model);

/* the feed-forward asked for, and what it ignores */
void tune_feed_as_asked(const tune *t, gough_model *model);

/* ---- tune_scale.c ---- */

/* unit, settled, furthest; from model and simulation */
void tune_find_scales(tune *t);

/* ---- tune_damping.c ---- */

/* smallest −Re λ/|λ| of a loop's eigenvalues; NaN if they cannot be computed */
double tune_least_ratio(double matrix[GOUGH_LINEAR][GOUGH_LINEAR]);

/* ---- tune_ratio.c ---- */

/* A loop at home whose gains have an upper edge. */
typedef struct {
    double (*ratio)(
        void *loop); /* smallest −Re s/|s| of its poles with these gains; NaN: not found */
    void *loop;
    gough_control *control; /* the gains, which are set; D the same in all legs */
    double mass;
    double most_damping,
        most_stiffness; /* none with more has to be tried; infinite: no such limit is known */
} tune_poles;

/* The least D that gives the ratio with the stiffness of `control`. NaN: none */
double tune_damping_at(const tune_poles *poles, double ratio);

/* the greatest G with which some D gives the ratio, and that D; 0: none */
double tune_top_by_ratio(const tune_poles *poles, double threshold, double ratio, double *damping);

/* ---- tune_states.c ---- */

/* the greatest rate, 1/T_a and the like, at which a drive follows its command; 0: drives that do not lag */
double tune_quickest_drive(const gough_machine *machine);

/* smallest −Re s/|s| of all poles, those of drives and integrals too */
double tune_states_ratio(const gough_model *model);
gough_status tune_states_damping(const gough_model *model, double ratio, double *damping,
                                 gough_error *error);

/* as tune_find_window(), but `upper` is infinite if no G of the search is too great */
gough_status tune_states_window(tune *t, gough_error *error);

/* rest at home in place of a program whose period is long beside the lag of the drives */
void tune_follow_states(tune *t);

/* ---- tune_sampled.c ---- */

/* the same of a loop with a sampled controller at rest at home, of its poles s, with multipliers e^{sT} */
double tune_sampled_ratio(const gough_model *model);

/* (tune-1) of those poles; fails where no damping gives the ratio */
gough_status tune_sampled_damping(const gough_model *model, double ratio, double *damping,
                                  gough_error *error);

/* `upper` and its mode where the controller is sampled or the loop has states: the G from which the loop at home is unstable, or
 * above which no D gives the ratio; NaN: none holds, and the margins of a sampled loop tell what would. Changes the gains of
 * `steady`. */
gough_status tune_find_window(tune *t, gough_error *error);

/* The period of the program, or rest at home in its place, with a sentence in `unchecked`: where it has no period or takes too many
 * samples. */
gough_status tune_follow_samples(tune *t, gough_error *error);

/* ---- tune_run.c ---- */

/* Runs of at most TUNE_ROUND + 1 values of G, rising; fills all but growth, stable, regular. */
gough_status tune_evaluate(tune *t, const double *stiffness, size_t count,
                           gough_tuning_point *point, gough_error *error);

/* Whether the stability of a fast decay would keep adaptive steps as short as the small fixed ones: those
 * are then taken from the beginning, since they run in lanes. */
bool tune_is_stiff(const tune *t);

/* what damps leg v of the model: D, and viscous friction */
static inline double tune_damping_of(const tune *t, int v) {
    return t->model->control.damping[v] + t->model->machine.platform.friction.viscous[v];
}

/* whether a run reached its end within what is asked */
bool tune_meets(const tune *t, const gough_tuning_point *point);

/* Whether a run with small fixed steps, which pass over nothing that the study's rows would show, meets what is asked too. */
gough_status tune_verify(tune *t, const gough_tuning_point *point, bool *good, gough_error *error);

/* The numbers of the run with the G and D named, mode and leg that bind. */
gough_status tune_detail(tune *t, gough_error *error);

/* distance from the program at the beginning */
double tune_initial_offset(const tune *t);

/* ---- tune_bracket.c ---- */

/* Brings two points together, one that does not meet what is asked and one of greater G that does, to 1e-4 of G. */
gough_status tune_refine(tune *t, gough_tuning_point *fails, gough_tuning_point *does,
                         gough_error *error);

/* ---- tune_stable.c ---- */

/* Growth of at most TUNE_ROUND + 1 points that have been run, and, from `before` on (the point before them; 0: none), the intervals
 * in which a mode grows. Returns how many in `count`. */
gough_status tune_growth_of(tune *t, double before, gough_tuning_point *point, size_t points,
                            tune_growth *growth, size_t room, size_t *count, gough_error *error);

/* The least G from that of a point on that has no growth within the margin around it; `blocked` tells, where it is greater, what
 * is below it. INFINITY: none up to the greatest. */
gough_status tune_clear(tune *t, const gough_tuning_point *point, double *clear,
                        tune_growth *blocked, gough_error *error);

/* whether the platform can be followed through a period of the program, with its swings in it */
bool tune_follows(const tune *t, double stiffness);

/* Looks anew at points off the trend, where growth was not looked at: whether some turn out to be unstable. */
bool tune_look_again(tune *t);

/* the map over a range of G, with D as it is */
gough_map_options tune_map_options(const gough_tuning_options *options, double from, double to,
                                   size_t count);

/* ---- tune_curve.c ---- */

/* slope and exceptions of the curve */
void tune_curve(tune *t);
void tune_note_growth(tune *t, const tune_growth *growth, size_t count);

/* whether no stiffness can do better: the run starts off its program, and over the last decade the deviation has stopped falling */
bool tune_is_flat(const tune *t);

/* Runs points that are off the trend by decades again, with small steps. */
gough_status tune_check_outliers(tune *t, gough_error *error);

/* why no G does it */
void tune_reason(tune *t);

/* the same where the loop holds the platform with none */
void tune_reason_closed(tune *t);

#endif
