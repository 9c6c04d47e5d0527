/* Columns that follow from pose and rates, for pages that do not carry them. Units are those of the run: SI, or none. */
#ifndef GOUGH_WEB_CORE_DERIVED_H
#define GOUGH_WEB_CORE_DERIVED_H

#include <stddef.h>

#include "live.h"

/* Numbers of a row in: x, y, z of the top frame's origin, roll, pitch, yaw, its velocity, its angular velocity (base axes). */
#define DERIVED_IN 12
/* Numbers of a row out: six leg lengths, their rates, the condition number. */
#define DERIVED_OUT 13

/* Room for DERIVED_IN doubles of each of so many rows, to be filled before derived_find(); NULL: no memory, or too many rows. */
double *LIVE_EXPORT(derived_input)(size_t rows);

/* DERIVED_OUT doubles of each row of the study that live_begin() took; NULL: there is no study, no input or no memory. */
const double *LIVE_EXPORT(derived_find)(void);

#endif
