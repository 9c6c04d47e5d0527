/* What is known of a leg over a run: one table, from which scaling, the tables for reading and the JSON follow. */
#ifndef GOUGH_CLI_LEG_QUANTITIES_H
#define GOUGH_CLI_LEG_QUANTITIES_H

#include <jansson.h>

#include "cli/run/run_report.h"

/* Turns the numbers of a leg into the output's units. */
void leg_scale(gough_leg_summary *leg, const gough_units *units);

/* Lengths, speed and swing; forces, powers and energies of the drives; loads of the joints, friction, what holds at rest; not in a
 * table. The report is scaled. */
enum { LEG_MOTION, LEG_LOADS, LEG_JOINTS, LEG_NONE };
void leg_table_print(FILE *stream, const run_report *report, int table);

/* Share of the stroke that a leg uses; NaN where the legs' lengths are not limited on both sides. */
double leg_stroke_share(const run_report *report, const gough_leg_summary *leg);

json_t *leg_json(const run_report *report, const gough_leg_summary *leg);

#endif
