/* Poses from lengths, and plants moved step by step. */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "python_api.h"

PyMethodDef plant_methods[] = {{NULL, NULL, 0, NULL}};
