/* What the page calls in its WebAssembly module: one study at a time, live or as a whole run. Numbers and addresses only; units,
 * frames and columns are those of gough/simulate.h, angles in radians. Units are those of the run: SI, or none. */
#ifndef GOUGH_WEB_CORE_LIVE_H
#define GOUGH_WEB_CORE_LIVE_H

#include <stddef.h>

#if defined(__wasm__)
#define LIVE_EXPORT(name) __attribute__((export_name(#name))) name
#else
#define LIVE_EXPORT(name) name
#endif

/* ---- a study in ---- */

/* Room for `count` doubles of gough_model_flatten(), to be filled before live_begin(); NULL: no memory for so many. */
double *LIVE_EXPORT(live_input)(size_t count);

/* Makes the model and its state at t = 0; all settings are the study's. 0, or a gough_status with a sentence in live_message(). */
int LIVE_EXPORT(live_begin)(void);

/* The last sentence: why live_begin() failed, or why the motion ended. "" if neither. */
const char *LIVE_EXPORT(live_message)(void);

/* ---- settings, at any time; numbers that are not finite change nothing ---- */

/* Gains of the control law, the same in all legs; negative ones count as 0. */
void LIVE_EXPORT(live_set_stiffness)(double stiffness);
void LIVE_EXPORT(live_set_damping)(double damping);

/* Period of a sampled controller, 0 for a continuous one, and the delay of its commands; negative ones count as 0, and a delay
 * is at most 99 periods. At the moment of a change it samples, and what it commands acts at once. */
void LIVE_EXPORT(live_set_period)(double period);
void LIVE_EXPORT(live_set_delay)(double delay);

/* Whether the program's forces are fed forward. */
void LIVE_EXPORT(live_set_feedforward)(int feedforward);

/* The units of numbers in sentences, by their places in gough_unit_choice(); told before live_begin(). With a place
 * that there is not, numbers have no units, but angles are in degrees. */
void LIVE_EXPORT(live_set_units)(int length, int force, int mass, int angle, int time);

/* Factors of what the study has, 1 as it is. Those of the program pass smoothly from old to new within one unit of time,
 * √(R_b/g), so that the program keeps two continuous derivatives and its phase; before the first step they hold at once.
 * A frequency below 0 counts as 0, which stops the program where it is. */
void LIVE_EXPORT(live_set_disturbance)(double factor);
void LIVE_EXPORT(live_set_amplitude)(double factor);
void LIVE_EXPORT(live_set_frequency)(double factor);

/* A force on the load at its centre of mass, base axes, until the next call. */
void LIVE_EXPORT(live_push)(double x, double y, double z);

/* ---- the motion ---- */

/* State at t = 0 again, with the settings as they are; a push ends. */
void LIVE_EXPORT(live_restart)(void);

/* Goes on by `duration` in fixed steps of `step`; what is left of a step is kept for the next call. Rk4 where the study has it,
 * else dop853; constraints as the study keeps them. Stops where a run would: a gough_cause, 0 while it goes on. After an end
 * nothing moves until live_restart(). GOUGH_END_INVALID, and nothing done: a step not positive, more than 1e5 of them, or a time
 * beyond a million durations of the study. */
int LIVE_EXPORT(live_advance)(double duration, double step);

/* The row of a table at the present time, live_columns() doubles; its drift is the largest since the live_row() before the
 * steps. */
const double *LIVE_EXPORT(live_row)(void);

/* The program's pose at the present time: x, y, z of the top frame's origin, roll, pitch, yaw. */
const double *LIVE_EXPORT(live_program)(void);

/* Columns of a row, and their names; NULL outside. */
int LIVE_EXPORT(live_columns)(void);
const char *LIVE_EXPORT(live_column_name)(int column);

/* The word for a cause. */
const char *LIVE_EXPORT(live_cause_name)(int cause);

/* The legs that ended the motion: the lowest, 1 … 6, else 0, and bit n − 1 for each leg n at that limit then. */
int LIVE_EXPORT(live_end_leg)(void);
int LIVE_EXPORT(live_end_legs)(void);

/* ---- a whole run ---- */

/* gough_simulate() of the study as it came, in double precision; the cause of its end, GOUGH_END_INVALID where it cannot be run
 * or its rows do not fit into memory. */
int LIVE_EXPORT(live_run)(void);

/* Its rows, one after the other. */
size_t LIVE_EXPORT(live_run_rows)(void);
const double *LIVE_EXPORT(live_run_data)(void);

#endif
