/* The vocabulary of every kernel text: one number type, chosen by the file that includes the texts.
 *
 * Before including, define one of NUMBER_DOUBLE, NUMBER_FLOAT, NUMBER_QUAD, NUMBER_COMPLEX, NUMBER_LANES (2, 4 or 8).
 *
 *   number    what the equations are written in: + - * / apply
 *   real      the scalar beside it: time, and all that is the same in every lane; broadcast by number_of_real
 *   number_floor  the largest whole number that is not above
 *   mask      outcome of a comparison; number_any tells whether any lane has it, to leave a loop that all lanes are done with
 *
 * A text never branches on a number: it selects. "greater" compares real parts, so that an imaginary step follows the
 * same path as the value it rides on.
 */
#ifndef GOUGH_KERNEL_NUMBER_H
#define GOUGH_KERNEL_NUMBER_H

#include <math.h>
#include <stddef.h>

/* where a call through memory would cost more than the function */
#define KERNEL_INLINE __attribute__((always_inline)) static inline
/* Where speed counts more than size, which is not in the page's core and not for numbers that are slow themselves: a few
 * instructions are laid out at each call, however large the caller is, and what most machines need has a text without the rest. */
#if (defined(NUMBER_DOUBLE) || defined(NUMBER_FLOAT) || defined(NUMBER_LANES)) && !defined(__wasm__)
#define KERNEL_SMALL KERNEL_INLINE
enum { KERNEL_QUICK = 1 };
#else
#define KERNEL_SMALL static inline
enum { KERNEL_QUICK = 0 };
#endif
/* one copy for all callers where the number is a scalar: calls cost little there, and code that is laid out whole much */
#if defined(NUMBER_LANES)
#define KERNEL_APART static inline
#else
#define KERNEL_APART __attribute__((noinline, unused)) static
#endif
/* the loop that follows is laid out whole, so that what it works on can stay in registers; not in the page's core, where size
 * counts more */
#if defined(__wasm__)
#define KERNEL_UNROLL
#elif defined(__clang__)
#define KERNEL_UNROLL _Pragma("clang loop unroll(full)")
#else
#define KERNEL_UNROLL _Pragma("GCC unroll 24")
#endif

#if defined(NUMBER_DOUBLE) || defined(NUMBER_FLOAT)

#if defined(NUMBER_DOUBLE)
typedef double number;
#define REAL_LITERAL(x) x
#define REAL_FUNCTION(name) name
#define REAL_EPSILON 2.220446049250313e-16
/* sweeps of an iteration that squares its error: at most, and at least */
enum { NUMBER_SWEEPS = 4, NUMBER_SURE_SWEEPS = 1, NUMBER_NEWTON = 8 };
#else
typedef float number;
#define REAL_LITERAL(x) x##F
#define REAL_FUNCTION(name) name##f
#define REAL_EPSILON 1.1920929e-07F
enum { NUMBER_SWEEPS = 3, NUMBER_SURE_SWEEPS = 1, NUMBER_NEWTON = 7 };
#endif
typedef number real;
typedef int mask;
#define REAL_PI REAL_LITERAL(3.14159265358979323846)

static inline number number_of_real(real x) { return x; }
static inline real number_first(number x) { return x; }
static inline number number_root(number x) { return REAL_FUNCTION(sqrt)(x); }
static inline number number_floor(number x) { return REAL_FUNCTION(floor)(x); }
static inline mask number_greater(number a, number b) { return a > b; }
static inline number number_select(mask m, number a, number b) { return m ? a : b; }
static inline number number_magnitude(number x) { return REAL_FUNCTION(fabs)(x); }
static inline int number_any(mask m) { return m; }

#elif defined(NUMBER_QUAD)

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 real;
/* libquadmath's header is GCC's own; its functions are declared here so that Clang finds them too */
extern real sqrtq(real), floorq(real);
/* the suffix is no part of the standard, which a table of such constants should not warn about */
#define REAL_LITERAL(x) (__extension__ x##Q)
static inline real real_root_quad(real x) { return sqrtq(x); }
static inline real real_floor_quad(real x) { return floorq(x); }
#else
typedef long double real;
#define REAL_LITERAL(x) x##L
static inline real real_root_quad(real x) { return sqrtl(x); }
static inline real real_floor_quad(real x) { return floorl(x); }
#endif
typedef real number;
typedef int mask;
#define REAL_EPSILON REAL_LITERAL(1.925929944387235853055977942584927319e-34)
#define REAL_PI REAL_LITERAL(3.141592653589793238462643383279502884197)
enum { NUMBER_SWEEPS = 5, NUMBER_SURE_SWEEPS = 1, NUMBER_NEWTON = 10 };

static inline number number_of_real(real x) { return x; }
static inline real number_first(number x) { return x; }
static inline number number_root(number x) { return real_root_quad(x); }
static inline number number_floor(number x) { return real_floor_quad(x); }
static inline mask number_greater(number a, number b) { return a > b; }
static inline number number_select(mask m, number a, number b) { return m ? a : b; }
static inline number number_magnitude(number x) { return x < 0 ? -x : x; }
static inline int number_any(mask m) { return m; }

#elif defined(NUMBER_COMPLEX)

#include <complex.h>

typedef double _Complex number;
typedef double real;
typedef int mask;
#define REAL_LITERAL(x) x
#define REAL_EPSILON 2.220446049250313e-16
#define REAL_PI 3.14159265358979323846
/* one sweep more than double, lest the derivative in the imaginary part be cut off */
enum { NUMBER_SWEEPS = 5, NUMBER_SURE_SWEEPS = 2, NUMBER_NEWTON = 9 };

static inline number number_of_real(real x) { return x; }
static inline real number_first(number x) { return creal(x); }
static inline number number_root(number x) { return csqrt(x); }
/* a staircase: its derivative is 0 */
static inline number number_floor(number x) { return floor(creal(x)); }
static inline mask number_greater(number a, number b) { return creal(a) > creal(b); }
static inline number number_select(mask m, number a, number b) { return m ? a : b; }
static inline number number_magnitude(number x) { return creal(x) < 0 ? -x : x; }
static inline int number_any(mask m) { return m; }

#elif defined(NUMBER_LANES)

#if defined(__SSE2__)
#include <immintrin.h> /* the root of a vector has no operator: the one instruction asked for by name */
#endif
typedef double number __attribute__((vector_size(8 * NUMBER_LANES)));
typedef double real;
typedef long long number_bits __attribute__((vector_size(8 * NUMBER_LANES)));
#if NUMBER_LANES == 8 && defined(__AVX512F__)
typedef __mmask8 mask;
#else
typedef number_bits mask;
#endif
#define REAL_LITERAL(x) x
#define REAL_EPSILON 2.220446049250313e-16
#define REAL_PI 3.14159265358979323846
enum { NUMBER_SWEEPS = 4, NUMBER_SURE_SWEEPS = 1, NUMBER_NEWTON = 8 };

static inline number number_of_real(real x) { return x - (number){0}; }
static inline real number_first(number x) { return x[0]; }
#if NUMBER_LANES == 8 && defined(__AVX512F__)
static inline number number_root(number x) { return (number)_mm512_sqrt_pd((__m512d)x); }
#elif NUMBER_LANES == 4 && defined(__AVX__)
static inline number number_root(number x) { return (number)_mm256_sqrt_pd((__m256d)x); }
#elif NUMBER_LANES == 2 && defined(__SSE2__)
static inline number number_root(number x) { return (number)_mm_sqrt_pd((__m128d)x); }
#else
static inline number number_root(number x) {
    number r;
    for (int i = 0; i < NUMBER_LANES; i++) r[i] = sqrt(x[i]);
    return r;
}
#endif
static inline number number_floor(number x) {
    number r;
    for (int i = 0; i < NUMBER_LANES; i++) r[i] = floor(x[i]);
    return r;
}
#if NUMBER_LANES == 8 && defined(__AVX512F__)
/* these registers choose by a mask of bits */
static inline mask number_greater(number a, number b) {
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_GT_OS);
}
static inline number number_select(mask m, number a, number b) {
    return (number)_mm512_mask_blend_pd(m, (__m512d)b, (__m512d)a);
}
static inline int number_any(mask m) { return m != 0; }
#else
static inline mask number_greater(number a, number b) { return a > b; }
#if NUMBER_LANES == 4 && defined(__AVX__)
static inline number number_select(mask m, number a, number b) {
    return (number)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)m);
}
static inline int number_any(mask m) { return _mm256_movemask_pd((__m256d)m) != 0; }
#else
static inline number number_select(mask m, number a, number b) {
    return (number)((m & (mask)a) | (~m & (mask)b));
}
#if NUMBER_LANES == 2 && defined(__SSE2__)
static inline int number_any(mask m) { return _mm_movemask_pd((__m128d)m) != 0; }
#else
static inline int number_any(mask m) {
    long long any = 0;
    for (int i = 0; i < NUMBER_LANES; i++) any |= m[i];
    return any != 0;
}
#endif
#endif
#endif
/* number_larger() and number_smaller() as one instruction each, which returns its second operand where neither compares, zeros and
 * NaN included */
#if NUMBER_LANES == 8 && defined(__AVX512F__)
static inline number number_larger(number a, number b) {
    return (number)_mm512_max_pd((__m512d)b, (__m512d)a);
}
static inline number number_smaller(number a, number b) {
    return (number)_mm512_min_pd((__m512d)b, (__m512d)a);
}
#define NUMBER_LARGER
#elif NUMBER_LANES == 4 && defined(__AVX__)
static inline number number_larger(number a, number b) {
    return (number)_mm256_max_pd((__m256d)b, (__m256d)a);
}
static inline number number_smaller(number a, number b) {
    return (number)_mm256_min_pd((__m256d)b, (__m256d)a);
}
#define NUMBER_LARGER
#elif NUMBER_LANES == 2 && defined(__SSE2__)
static inline number number_larger(number a, number b) {
    return (number)_mm_max_pd((__m128d)b, (__m128d)a);
}
static inline number number_smaller(number a, number b) {
    return (number)_mm_min_pd((__m128d)b, (__m128d)a);
}
#define NUMBER_LARGER
#endif
static inline number number_magnitude(number x) {
    return (number)((number_bits)x & 0x7fffffffffffffffLL); /* without the sign's bit */
}

#else
#error "define NUMBER_DOUBLE, NUMBER_FLOAT, NUMBER_QUAD, NUMBER_COMPLEX or NUMBER_LANES first"
#endif

/* ---- lanes one by one, for what stands around the kernels ---- */

#if defined(NUMBER_LANES)
enum { NUMBER_WIDTH = NUMBER_LANES };
static inline void number_put(number *x, int lane, real value) { (*x)[lane] = value; }
static inline real number_lane(number x, int lane) { return x[lane]; }
#else
enum { NUMBER_WIDTH = 1 };
static inline void number_put(number *x, int lane, real value) {
    (void)lane;
    *x = value;
}
static inline real number_lane(number x, int lane) {
    (void)lane;
    return number_first(x);
}
#endif

/* ---- what follows from the vocabulary, for every type alike ---- */

static inline number number_of(double x) { return number_of_real((real)x); }
static inline number number_between(number x, number least, number most) {
    const number low = number_select(number_greater(least, x), least, x);
    return number_select(number_greater(low, most), most, low);
}
#ifndef NUMBER_LARGER
static inline number number_larger(number a, number b) {
    return number_select(number_greater(b, a), b, a);
}
static inline number number_smaller(number a, number b) {
    return number_select(number_greater(a, b), b, a);
}
#endif

#endif
