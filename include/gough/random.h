/** @file random.h
 *  Counter-based random numbers: each is a function of seed, run and number of the draw; no state is kept.
 *  Safe to call concurrently; the same on every machine.
 */
#ifndef GOUGH_RANDOM_H
#define GOUGH_RANDOM_H

#include <stdint.h>

#include "gough/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Number of the draw @p draw of run @p run under a seed, uniform in [0, 1):
 *  counter-based (Philox 4×32, ten rounds), so any draw can be computed without the previous ones. */
GOUGH_API double gough_random_uniform(uint64_t seed, uint64_t run, uint64_t draw);

/** The same, standard normal (by the inverse of its distribution function, one draw each). */
GOUGH_API double gough_random_normal(uint64_t seed, uint64_t run, uint64_t draw);

#ifdef __cplusplus
}
#endif
#endif
