/* The checks of the drives of the legs. */
#ifndef GOUGH_DRIVE_ACTUATORS_CHECK_H
#define GOUGH_DRIVE_ACTUATORS_CHECK_H

#include "gough/model.h"

/* GOUGH_OK, or GOUGH_ERROR_INPUT with a sentence */
gough_status actuators_check(const gough_actuators *actuators, gough_error *error);

#endif
