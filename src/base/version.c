/* The version of the library. */
#include "gough/version.h"

#include "gough/status.h"

const char *gough_version(void) { return GOUGH_VERSION; }

int gough_edition(void) { return GOUGH_EDITION; }
