/* What a loop with one stiffness says: the modes that grow, and, where nothing is damped, how far each mode's multiplier of the
 * first kind has turned. Theory: docs/theory/floquet.md. */
#ifndef GOUGH_MAP_SAMPLE_H
#define GOUGH_MAP_SAMPLE_H

#include <complex.h>

#include "linear/mode.h"

enum { MODES = GOUGH_LINEAR / 2 };

/* a multiplier over the limit, or at rest an eigenvalue: the one with Im ≥ 0 of a conjugate pair */
typedef struct {
    double value[2];
    double size; /* ln|μ|, Re λ */
    gough_mode mode;
} grower;

typedef struct {
    double stiffness;
    double size;     /* largest ln|μ|, largest Re λ; NaN where there are no values */
    gough_mode mode; /* of the largest */
    bool stable;
    unsigned modes; /* those that count, as in gough_map_options */
    int growers;    /* by falling size */
    grower grows[GOUGH_LINEAR];

    bool phased; /* the rest is there: undamped, and multipliers not too far apart in size */
    double phase[MODES]; /* [0, 2π), rising: multipliers of the first kind, (floquet-22) */
    bool off[MODES];     /* off the circle */
} sample;

/* The invariant form of the undamped loop about a state, (floquet-22). */
typedef struct {
    double mass, inertia[3][3], velocity[3], momentum[3]; /* ω and L = J ω, base axes */
    bool heavy;                     /* legs have mass: L is that of load and legs, and … */
    double change[6][GOUGH_LINEAR]; /* … δp, δL follow from ξ so */
} symplectic;

void symplectic_at(const gough_machine *machine, const gough_state *state, symplectic *form);

/* −i ξ* Ω η */
double complex symplectic_product(const symplectic *form, const double complex xi[GOUGH_LINEAR],
                                  const double complex eta[GOUGH_LINEAR]);

/* From Φ over a period, by columns, overwritten; form NULL: damped. Returns false, and fills nothing, where Φ is so large that
 * the small multipliers have lost their digits in it: then its factors are needed. */
bool sample_monodromy(const gough_machine *machine, const symplectic *form, double stiffness,
                      unsigned modes, double *phi, sample *s);

/* From `count` factors of Φ, whatever its size; no values where they are not all finite. */
void sample_factors(const gough_machine *machine, const symplectic *form, double stiffness,
                    unsigned modes, const double (*factor)[GOUGH_LINEAR * GOUGH_LINEAR],
                    size_t count, sample *s);

/* From values with their modes: ln|μ|, or Re λ, over `limit` grows. */
void sample_begin(sample *s, double stiffness, unsigned modes);
void sample_add(sample *s, const double value[2], double size, double limit,
                const gough_mode *mode);

void sample_no_values(sample *s, double stiffness);

/* whether a mode is one of those that count */
bool sample_counts(const gough_mode *mode, unsigned modes);

/* 0, 1, 2: real and positive, real and negative, complex */
int grower_kind(const grower *g);

#endif
