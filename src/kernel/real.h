/* Elementary functions of a real (number.h), for formulas, angles and drivers: libm for double, libquadmath for quad.
 * They stand outside the kernels: a formula is evaluated once a stage and broadcast to all lanes. */
#ifndef GOUGH_KERNEL_REAL_H
#define GOUGH_KERNEL_REAL_H

#include "kernel/number.h"

#if defined(NUMBER_QUAD) && defined(__SIZEOF_FLOAT128__)
extern real sinq(real), cosq(real), tanq(real), asinq(real), acosq(real), atanq(real),
    atan2q(real, real);
extern real expq(real), logq(real), tanhq(real), powq(real, real), hypotq(real, real);
#define REAL_FUNCTION(name) name##q
#elif defined(NUMBER_QUAD)
#define REAL_FUNCTION(name) name##l
#else
#define REAL_FUNCTION(name) name
#endif

static inline real real_root(real x) { return REAL_FUNCTION(sqrt)(x); }
static inline real real_sin(real x) { return REAL_FUNCTION(sin)(x); }
static inline real real_cos(real x) { return REAL_FUNCTION(cos)(x); }
static inline real real_tan(real x) { return REAL_FUNCTION(tan)(x); }
static inline real real_asin(real x) { return REAL_FUNCTION(asin)(x); }
static inline real real_acos(real x) { return REAL_FUNCTION(acos)(x); }
static inline real real_atan(real x) { return REAL_FUNCTION(atan)(x); }
static inline real real_atan2(real y, real x) { return REAL_FUNCTION(atan2)(y, x); }
static inline real real_exp(real x) { return REAL_FUNCTION(exp)(x); }
static inline real real_log(real x) { return REAL_FUNCTION(log)(x); }
static inline real real_tanh(real x) { return REAL_FUNCTION(tanh)(x); }
static inline real real_pow(real x, real y) { return REAL_FUNCTION(pow)(x, y); }
static inline real real_floor(real x) { return REAL_FUNCTION(floor)(x); }
static inline real real_hypot(real x, real y) { return REAL_FUNCTION(hypot)(x, y); }
static inline real real_magnitude(real x) { return x < 0 ? -x : x; }
static inline int real_finite(real x) { return x - x == 0; }

#endif
