/* The checks of the limits of legs and platform. */
#ifndef GOUGH_PLANT_LIMITS_CHECK_H
#define GOUGH_PLANT_LIMITS_CHECK_H

#include "gough/model.h"

/* GOUGH_OK, or GOUGH_ERROR_INPUT with a sentence. home_length: of the legs */
gough_status limits_check(const gough_platform *platform, const double home_length[GOUGH_LEGS],
                          gough_error *error);

#endif
