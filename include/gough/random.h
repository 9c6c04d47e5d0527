/** @file random.h
 *  Counter-based random numbers: each is a function of seed, run and number of the draw; no state is kept.
 *  They are the same on every machine.
 *
 *  Accuracy: as each function says.
 *  Overlap: no memory is written.
 *  Threads: every function may be called from several threads at once; no state is kept.
 */
#ifndef GOUGH_RANDOM_H
#define GOUGH_RANDOM_H

#include <stdint.h>

#include "gough/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Number of the draw @p draw of run @p run under a seed, uniform in [0, 1):
 *  counter-based (Philox 4×32, ten rounds), so any draw can be computed without the previous ones. An exact multiple of 2⁻⁵³. */
GOUGH_API double gough_random_uniform(uint64_t seed, uint64_t run, uint64_t draw);

/** The same, standard normal (by the inverse of its distribution function, one draw each). Accurate to
 *  1e-15 (1 + |z|) as the quantile of the uniform number half a step of 2⁻⁵³ above that of gough_random_uniform(). */
GOUGH_API double gough_random_normal(uint64_t seed, uint64_t run, uint64_t draw);

#ifdef __cplusplus
}
#endif
#endif
