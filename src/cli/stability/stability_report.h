/* What gough stability has found: the loop at rest and about the program, for reading and as JSON. */
#ifndef GOUGH_CLI_STABILITY_REPORT_H
#define GOUGH_CLI_STABILITY_REPORT_H

#include <jansson.h>
#include <stdio.h>

#include "cli/common/from_lengths.h"
#include "cli/common/option_values.h"
#include "cli/common/sampled_view.h"
#include "cli/common/verb.h"
#include "gough/gough.h"

/* What is asked for of one loop. */
struct loop_options {
    bool posed, matrix;
    double pose[GOUGH_COMPONENTS]; /* from home, in the study's units */
    double at;                     /* NaN: not asked for */
};

/* Numbers are in the units of the output when they are printed; shapes have angles in radians. */
typedef struct stability_report {
    const char *verb;
    const gough_study *study;
    gough_units units;
    double arm; /* R_b: by it rotations compare with displacements */
    bool damped;
    bool posed;                    /* a pose was asked for, and no program */
    double pose[GOUGH_COMPONENTS]; /* of `rest`, from home: in the study's units */
    gough_rest rest;
    bool ends; /* the program ends at rest elsewhere than at home: `last` holds there */
    double last_pose[GOUGH_COMPONENTS]; /* likewise */
    gough_rest last;
    bool sampled; /* and then these hold, in units of the run */
    sampled_view sampled_rest, sampled_last;
    bool sampled_along; /* the program is periodic, and then this holds */
    gough_sampled_floquet along;
    bool periodic; /* and then the two below hold */
    gough_period period;
    gough_floquet floquet;
    double sag; /* distance of the top from the program when the period begins */
} stability_report;

/* Finds all of it, at rest and about the program, for the study and the pose in the report, in units of the run. */
gough_status stability_find(stability_report *report, gough_error *error);

/* Brings it to the units of the report. */
void stability_scale(stability_report *report);

/* Whether nothing grows: about the program, or where it rests. */
bool stability_holds(const stability_report *report);

void stability_print(FILE *stream, const stability_report *report);

/* stability_sampled.c: a view of the report, and the loop about the program */
void stability_print_sampled(FILE *stream, const stability_report *report,
                             const sampled_view *view);
void stability_print_sampled_along(FILE *stream, const stability_report *report);

/* The loop as a matrix of the numbers of a deviation: ξ̇ = A ξ, or from sample to sample. Row by row. */
typedef struct stability_matrix {
    size_t size;
    double *number;                     /* size × size, allocated */
    char (*name)[GOUGH_DEVIATION_NAME]; /* of rows and columns, allocated */
} stability_matrix;

/* stability_matrix.c: at rest, or about the program at the time asked for; in the units given. Freed by the caller. */
gough_status stability_matrix_find(const struct loop_options *loop, const gough_study *study,
                                   const gough_units *units, stability_matrix *matrix,
                                   gough_error *error);
void stability_matrix_print(FILE *stream, const stability_matrix *matrix);
void stability_matrix_set(json_t *object, const stability_matrix *matrix);
void stability_matrix_free(stability_matrix *matrix);

/* A pose in the study's units as components of the run. */
void stability_read_pose(const gough_study *study, const double pose[GOUGH_COMPONENTS],
                         double component[GOUGH_COMPONENTS]);

/* The answer as one JSON object; matrix may be NULL. */
json_t *stability_json(const stability_report *report, const stability_matrix *matrix);

/* What gough stability is asked for. */
typedef struct stability_line {
    command_line line;
    struct loop_options loop;
    struct map_options {
        axis_values stiffness, second;
        unsigned modes; /* as in gough_map_options */
    } map;
    lengths_asked lengths; /* of the pose */
    int threads, lanes;
    const char *title;
} stability_line;

/* The stability map of --sweep-stiffness (stability_map.c). */
extern const option_group map_group; /* struct map_options */
gough_status stability_map(const stability_line *asked, const gough_study *study);

/* ---- mode_words.c: modes in words ---- */

enum { MODE_WORDS = 200 };

/* What moves, of `count` modes of one value: "surge 0.1 m with pitch -3.1 deg; sway 0.1 m with roll 3.1 deg". */
void stability_mode_words(const gough_mode *const *mode, int count, double arm,
                          const gough_units *units, char words[MODE_WORDS]);

/* Pads to a width in columns of the terminal, where bytes of UTF-8 do not count alike. */
void stability_pad(FILE *stream, const char *text, int width);

#endif
