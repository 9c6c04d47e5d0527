/* The machine at rest as its legs feel it, and gains for it. Theory: docs/theory/tuning.md. */
#ifndef GOUGH_TUNE_GAINS_H
#define GOUGH_TUNE_GAINS_H

#include "gough/tune.h"

typedef double leg_matrix[GOUGH_LEGS][GOUGH_LEGS];

/* What leg forces u beyond those of rest do to the errors e = l^p − l of the lengths, (tune-7): ë = −S (Γ e + Δ ė + u). */
typedef struct {
    const gough_machine *machine;
    gough_state state;
    leg_matrix back;      /* W = J⁻¹: lengths to (δr, δθ) of the centre of mass, base axes */
    leg_matrix inertia;   /* S⁻¹ = Wᵀ M̄ W */
    leg_matrix mobility;  /* S = J M̄⁻¹ Jᵀ */
    leg_matrix geometric; /* Γ = Wᵀ K_geo W */
    double viscous[GOUGH_LEGS]; /* Δ, diagonal: friction of the legs */
} gains_plant;

/* Fills the plant at rest in a pose; fails in a singular one, with a sentence. */
gough_status gains_plant_find(const gough_model *model, const double *component, gains_plant *plant,
                              gough_error *error);

/* Fills `pole` and `state` of gains whose matrices are there: eigenvalues of e and ė with u = G e + D ė. False if LAPACK finds
 * none or a number is not finite. */
bool gains_poles_find(gains_plant *plant, gough_gains *gains);

/* The sentence where numbers overflow or LAPACK gives up. */
gough_status gains_fail(gough_error *error);

/* largest |element|; A B */
double gains_size(leg_matrix a);
void gains_product(leg_matrix a, leg_matrix b, leg_matrix out);

#endif
