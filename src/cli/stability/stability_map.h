/* A stability map as found: for reading, as JSON, as tables. */
#ifndef GOUGH_CLI_STABILITY_MAP_H
#define GOUGH_CLI_STABILITY_MAP_H

#include "cli/stability/stability_report.h"

/* Numbers are in the units of the output. */
typedef struct map_report {
    const char *verb;
    const gough_study *study;
    gough_units units;
    gough_map_options options;
    gough_map map;
    size_t rows, own_row; /* how many, and the one nearest to the study as it stands */
    gough_rest *rest;     /* at home; NULL: the loop has no rest there */
} map_report;

/* Name of the second axis: "amplitude", "frequency", "damping", "period", "delay"; NULL without one. */
const char *map_axis_name(const map_report *report);

/* Its unit, and whether its values are factors on what the study has. */
gough_unit map_axis_unit(gough_map_axis axis);
bool map_axis_is_factor(gough_map_axis axis);

/* "heave", "sway+tilt": the modes that count; empty if all do. */
typedef struct map_modes {
    char text[32];
} map_modes;
map_modes map_modes_of(const map_report *report);

/* Whether the loops of the map are sampled. */
bool map_is_sampled(const map_report *report);

/* Whether all intervals are told, or those of the row nearest to the study only. */
void map_print(FILE *stream, const map_report *report, bool all);
int map_print_json(const map_report *report);

/* The grid to a file (.csv, .h5, or - for CSV on standard output), and for a file the intervals beside it, "map.csv" to
 * "map-tongues.csv". */
gough_status map_write(const map_report *report, const char *path, gough_error *error);

/* "map-tongues.csv" of "map.csv"; allocated. */
char *map_tongues_path(const char *path);

#endif
