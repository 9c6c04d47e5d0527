/* What each width of lanes offers for all poses: paths of a homotopy followed side by side. Plain C. */
#ifndef GOUGH_POSE_TRACK_TABLE_H
#define GOUGH_POSE_TRACK_TABLE_H

/* paths; equations with their products; unknowns */
enum { PATHS = 40, PATH_ROWS = 6, PATH_PRODUCTS = 17, PATH_UNKNOWNS = 8 };

/* coefficients of six equations, complex */
typedef struct {
    double c[PATH_ROWS][PATH_PRODUCTS][2];
} path_system;

/* a point of projective space, complex */
typedef struct {
    double x[PATH_UNKNOWNS][2];
} path_point;

/* where a path was left, and how far from its end: 0 if it got there */
typedef struct {
    path_point at;
    double left;
    int steps;
} path_end;

/* follows the roots `start` of a system to those of another, (pose-8) */
typedef void path_tracker(const path_system *from, const path_system *to, const path_point *start,
                          int count, path_end *end);

path_tracker path_track_1, path_track_2, path_track_4, path_track_8;

#endif
