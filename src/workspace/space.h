/* A box of poses as this room sees it: the machine at the centre, how its points move over the box, bounds of what third order
 * adds, (space-1), (space-2). Base axes, radians. Theory: docs/theory/workspace.md. */
#ifndef GOUGH_WORKSPACE_SPACE_H
#define GOUGH_WORKSPACE_SPACE_H

#include "gough/workspace.h"
#include "kernel/top.h"
#include "workspace/taylor.h"

/* forces and accelerations of legs that motions and loads ask for */
typedef struct asked_parts {
    bool force, acceleration;
} asked_parts;

/* A question's machine, made once for many boxes. */
typedef struct space {
    asked_parts parts; /* of what is asked for, those that limits concern */
    bool speed;        /* and rates of legs */
    bool
        only_lengths; /* lengths, the platform's pose and singular poses are all that limits poses */
    bool regular;     /* singular poses are known to be excluded */
    bool parts_wanted; /* which part of a box of positions is decided is wanted, too */
    const gough_reach *reach;
    hexapod h;
    vector about;       /* the point that the components move, top frame */
    vector home;        /* where it is at home, base frame */
    vector along[LEGS]; /* directions of the legs at home */
    const double
        *way;    /* the direction of a straight line in the components; NULL: boxes along them */
    double size; /* sum of all distances that a leg's vector is computed from, at home */
} space;

/* The box, and the legs at its centre. */
typedef struct box_view {
    const double *way; /* of the space */
    double centre[GOUGH_COMPONENTS], half[GOUGH_COMPONENTS];
    coordinates x;
    triad R;
    legs g;
    vector axis[3];        /* about which roll, pitch and yaw turn the top at the centre */
    vector arm[LEGS];      /* top joints from the point, base axes */
    bool varies;           /* false: a box of one pose */
    double shift, turn;    /* how far the point moves; how far the top turns at most, in radians */
    double bend;           /* |R″u| ≤ bend |u| along any line of the box, (space-2) */
    double twist;          /* |R‴u| ≤ twist |u| likewise */
    bool yaw_outside;      /* the yaw turns the axes of the other two angles, not the roll */
    double moved[LEGS];    /* how far a top joint moves */
    double shortest[LEGS]; /* length that the leg keeps at least */
    double less[LEGS],
        more[LEGS];  /* by how much its length is below or above that at the centre at most */
    double rounding; /* of the computed vector of a leg */
} box_view;

/* Made for `reach`; poses are boxes, or parts of a line if `way` is set afterwards: then a box is that of a part of the line, and
 * of it only the poses on the line are meant. */
void space_begin(space *s, const gough_reach *reach);
void box_view_of(const space *s, const gough_box *box, box_view *view);

/* (space-2): R a over the box for a vector of the top frame, R a given at the centre */
taylor_vector box_turned(const box_view *view, vector Ra);
/* the point's displacement from home */
taylor_vector box_shifted(const box_view *view);
/* (space-5): direction of leg v */
taylor_vector box_direction(const box_view *view, int v);

/* the direction of leg v at home, and the same turned with the top */
void box_home_directions(const space *s, const box_view *view, int v, taylor_vector *still,
                         taylor_vector *turned);

/* how top joint v moves with the k-th half width */
vector box_joint_slope(const box_view *view, int v, int k);

/* the length of leg v as a number of the box */
taylor box_length(const box_view *view, int v);

/* the least and the greatest length of leg v over the box, (space-4) */
void box_lengths(const box_view *view, int v, double bound[2]);

#endif
