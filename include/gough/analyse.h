/** @file analyse.h
 *  Stability of the closed loop, at rest and about a periodic program: gough/linear.h and gough/floquet.h together.
 */
#ifndef GOUGH_ANALYSE_H
#define GOUGH_ANALYSE_H

#include "gough/floquet.h"
#include "gough/linear.h"

#endif
