/** @file linear.h
 *  The closed loop linearised, exactly (complex steps through the equations, no differences), and its stability at rest.
 *  Theory: docs/theory/stability.md. This part of the library needs LAPACK; it is libgough-analyse.
 *
 *  Linear state ξ = (δr, δθ, δv, δω), twelve numbers: displacement of the centre of mass, small rotation, and the changes of its
 *  velocity and of the angular velocity, all in base axes and in the units of the model, angles in radians. Disturbances are not
 *  part of the loop; here they are 0. An error argument may be NULL. `name`s are UTF-8.
 *
 *  Accuracy: as each function says.
 *  Overlap: outputs must not overlap inputs.
 *  Threads: every function may be called from several threads at once, on distinct outputs, if LAPACK allows that, as usual
 *  builds do.
 */
#ifndef GOUGH_LINEAR_H
#define GOUGH_LINEAR_H

#include "gough/dynamics.h"
#include "gough/units.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { GOUGH_LINEAR = 12 };

/** The most numbers of a deviation: ξ, then for each leg the force of its drive, if drives lag, and the rate of that force, if they
 *  do so by a second order, then the integral of each leg that has a gain for it, if the controller is continuous. */
enum { GOUGH_LINEAR_MOST = 30 };

/** Growth, per √(R_b/g) at rest or per period, up to which a deviation does not count as growing: the error that round-off causes
 *  in a multiplier on the unit circle. */
#define GOUGH_GROWTH_LIMIT 1e-7

/** How many numbers the deviation of a model's loop has: 12, and more where drives lag or the controller integrates. */
GOUGH_API size_t gough_linear_size(const gough_model *model);

/** ξ̇ = matrix · ξ, the closed loop linearised about a state at time t, (stab-13), with the states of drives and of integrals after
 *  the twelve of the platform. Drives that lag give there the force that is asked of them, and limits of drives are not reached.
 *  @param state  about which it is linearised; NULL: the program's at t
 *  @param size   gough_linear_size() of the model
 *  @param[out] matrix  size × size numbers, row by row; rows: derivatives of ξ. The constant part, present about a state that is
 *  not an equilibrium, is omitted
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT if a formula is not finite at t, the size is another or the controller is sampled,
 *  GOUGH_ERROR_NUMERICAL for a
 *  singular pose of a program whose forces are fed forward, or a leg of zero length. Exact up to rounding. Allocates nothing. */
GOUGH_API gough_status gough_linearise(const gough_model *model, double t, const gough_state *state,
                                       size_t size, double *matrix, gough_error *error);

/** How many numbers a deviation of a model's loop has: of a continuous controller gough_linear_size(); of a sampled one those of
 *  the platform and of the drives, then what the controller remembers, then for each sample back to the one whose command acts six
 *  commands that wait, the latest first. */
GOUGH_API size_t gough_deviation_size(const gough_model *model);

enum { GOUGH_DEVIATION_NAME = 16 };

/** What a number of a deviation is.
 *  @param index      0 … gough_deviation_size() − 1
 *  @param[out] name  "x", "y", "z", "rx", "ry", "rz" of ξ and "vx" … "wz" of their rates; "f1" … "f6" forces of drives that lag,
 *                    "fdot1" … "fdot6" their rates if the lag is of second order, "i1" … "i6" integrals of the legs that have them.
 *                    Of a sampled controller "e1" … and "edot1" … the errors of the last sample and their rates, if it finds
 *                    rates by differences, and "u3_2" the command that leg 3 got two samples ago
 *  @param[out] unit  of it; of a rotation, in radians, GOUGH_UNIT_NONE, and of its rate GOUGH_UNIT_RATE
 *  @return false if the index is too large. Exact. */
GOUGH_API bool gough_deviation_name(const gough_model *model, size_t index,
                                    char name[GOUGH_DEVIATION_NAME], gough_unit *unit);

/** The loop at rest as a matrix: of a continuous controller A of ξ̇ = A ξ, (stab-13); of a sampled one what becomes of a deviation
 *  from just before a sample to just before the next, (loop-8). With the states of drives, integrals and the controller's memory.
 *  @param component  as in gough_stability_at_rest()
 *  @param size       gough_deviation_size() of the model
 *  @param[out] matrix  size × size numbers, row by row
 *  @return as gough_stability_at_rest() or gough_sampled_at_rest(); GOUGH_ERROR_INPUT too if the size is another. A is exact up to
 *  rounding, the matrix of a sample accurate to 1e-14 of its largest element. Allocates nothing; needs 500 kB of stack. */
GOUGH_API gough_status gough_matrix_at_rest(const gough_model *model,
                                            const double component[GOUGH_COMPONENTS], size_t size,
                                            double *matrix, gough_error *error);

enum { GOUGH_MODE_NAME = 32 };

/** A mode: a pattern of small deviations. */
typedef struct gough_mode {
    char name
        [GOUGH_MODE_NAME]; /**< "heave", "yaw", "sway–tilt" …: named after the motions with a share of its energy */
    double shape
        [6]
        [2]; /**< δr, δθ as complex numbers, scaled so that the largest component is real and positive */
    double share
        [4]; /**< shares of sway (surge and sway), heave, tilt (roll and pitch) and yaw; sum 1 */
} gough_mode;

/** One eigenvalue: deviations vary as e^{λt}. */
typedef struct gough_eigenvalue {
    double value[2]; /**< λ: growth rate, angular frequency */
    gough_mode mode; /**< its mode */
} gough_eigenvalue;

/** One multiplier: the factor by which deviations grow in each period, of a program (gough/floquet.h) or of a controller. */
typedef struct gough_multiplier {
    double value[2]; /**< μ */
    gough_mode mode; /**< the mode at the beginning of the period */
} gough_multiplier;

/** The stiffness above which a mode at rest does not grow. */
typedef struct gough_threshold {
    double
        stiffness; /**< G, the same in all legs; 0: with constant leg forces alone the mode does not grow */
    bool neutral;    /**< constant leg forces do not hold the mode either, but any G > 0 does */
    gough_mode mode; /**< the mode at the threshold, (stab-10) */
} gough_threshold;

/** The loop at rest. */
typedef struct gough_rest {
    gough_state
        state; /**< of equilibrium: where the loop rests; this is the requested pose only if gough_keeps_program() */
    double force[GOUGH_LEGS]; /**< leg forces there */
    double matrix
        [GOUGH_LINEAR]
        [GOUGH_LINEAR]; /**< of gough_linearise(), for drives that follow at once and without integrals */
    double geometric[6][6]; /**< K_geo: stiffness of constant leg forces, on (δr, δθ), symmetric */
    double legs[6][6];      /**< JᵀJ: stiffness of legs with G = 1 */
    double
        asymmetry; /**< largest element of |K − Kᵀ| over that of K, the stiffness computed: 0 up to rounding */
    double
        trace; /**< of the translational part of K_geo: if < 0, some mode grows without feedback */
    double
        trace_theorem; /**< −2Mg/h of (stab-5); NaN if the joints are not in two level planes h ≠ 0 apart */
    size_t size; /**< how many eigenvalues there are: gough_linear_size() */
    gough_eigenvalue eigenvalue
        [GOUGH_LINEAR_MOST]; /**< by falling growth rate, then by rising frequency; the positive one of a pair ±ω first */
    gough_threshold threshold[6]; /**< by falling stiffness */
    int growing; /**< how many eigenvalues grow, (stab-17); they are the first ones */
    int neutral; /**< number of independent displacements on which no stiffness acts */
    int drifting; /**< number of these on which no damping acts either: a velocity there never dies out. 0 if
                         something grows */
    gough_mode neutral_mode[6]; /**< the modes that drift; if none drifts, the neutral ones */
    bool decaying;              /**< every small deviation dies out */
    bool stable;   /**< nothing grows and nothing drifts: small deviations stay small */
    double growth; /**< largest growth rate */
} gough_rest;

/** The loop at rest in a pose. A sampled controller counts as a continuous one; gough_sampled_at_rest() samples it.
 *
 *  Without feed-forward the equilibrium is found by applying the load gradually, starting from the requested pose, (stab-14).
 *  Without damping eigenvalues are exactly real or imaginary, (stab-15). Eigenvalues, stiffnesses and thresholds are accurate to
 *  1e-10 of the largest of them, an equilibrium to 1e-11.
 *  @param component  surge … yaw from home of the point `about` of the motion, radians; NULL: home
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT: a component that is not finite; GOUGH_ERROR_NUMERICAL: singular pose, or no equilibrium
 *  found without feed-forward (the sentence names the pose where the search began); do not use @p rest then. Allocates nothing. */
GOUGH_API gough_status gough_stability_at_rest(const gough_model *model,
                                               const double component[GOUGH_COMPONENTS],
                                               gough_rest *rest, gough_error *error);

/** How many multipliers of a sampled loop are listed at most. */
enum { GOUGH_SAMPLED = 24 };

/** A loop with a sampled controller at rest, from sample to sample, (loop-8). */
typedef struct gough_sampled_rest {
    gough_state state; /**< of equilibrium, as in gough_rest */
    double period;     /**< T of the controller */
    double delay;      /**< τ, from a sample until its command acts */
    /** τ + T/2 and the lag of the slowest drive: to first order, the stiffness times this is taken from the damping */
    double effective_delay;
    double mass;   /**< 1/κ_max: what a leg force moves in the mode that it moves most easily */
    size_t size;   /**< how many multipliers there are */
    size_t listed; /**< how many of them are in the list */
    gough_multiplier multiplier
        [GOUGH_SAMPLED]; /**< of a deviation from sample to sample, by falling magnitude */
    double radius;       /**< largest |μ| */
    double growth;       /**< its growth rate, ln |μ|/T */
    bool stable;         /**< nothing grows, but for rounding */
    bool decaying;       /**< every small deviation dies out */
    double noise
        [GOUGH_LEGS]; /**< root mean square of a command's noise from that of the lengths, and from counts, (loop-2) */
    double count[GOUGH_LEGS]; /**< by how much one count of a leg's length changes its command */
} gough_sampled_rest;

/** The one-sample map at rest of a model whose controller is sampled: mechanics, drives, memory of the controller, commands that
 *  wait until they act.
 *  @param component  as in gough_stability_at_rest()
 *  @return as gough_stability_at_rest(); GOUGH_ERROR_INPUT too if the controller is continuous, or its delay exceeds 12 periods
 *
 *  Counts are taken for lengths, limits of drives are not reached, dry friction is left out, jitter is 0. The integrals of legs
 *  without a gain for them are left out. Multipliers are accurate to 1e-12 of the largest, or of 1; several that are equal to the
 *  root of that according to their number. Allocates nothing; needs 500 kB of stack. */
GOUGH_API gough_status gough_sampled_at_rest(const gough_model *model,
                                             const double component[GOUGH_COMPONENTS],
                                             gough_sampled_rest *rest, gough_error *error);

/** Where a sampled loop at rest becomes unstable as its stiffness varies. */
typedef struct gough_sampled_edge {
    double stiffness; /**< G of the stiffest leg, that of the others in proportion */
    double frequency; /**< angular frequency of the mode that neither grows nor decays there */
    gough_mode mode;  /**< that mode */
} gough_sampled_edge;

/** Between which gains, and up to which delay and period, a sampled loop at rest is stable. */
typedef struct gough_sampled_margins {
    bool
        open; /**< some G holds the platform with the damping of the model; else both edges are NaN */
    gough_sampled_edge lower; /**< of G, with the damping of the model */
    gough_sampled_edge upper; /**< likewise */
    double damping;           /**< D of the most damped leg, that of the others in proportion */
    double
        longest_period; /**< T up to which the gains of the model hold, with a delay in proportion; NaN: none */
    double longest_delay; /**< τ up to which they hold; NaN: none; infinite: beyond 12 periods */
    double
        best_stiffness; /**< the greatest upper edge that any damping gives, without integrals; NaN: none */
    double best_damping; /**< the damping that gives it */
    double
        period_limit; /**< T from which no gains hold at all, with a delay in proportion and without integrals; NaN: no such
                                T, since the platform holds without control */
} gough_sampled_margins;

/** The window of stiffness of a sampled loop at rest, and its margins. The pattern of the gains is that of the model, all legs
 *  alike where it has none; one factor scales all stiffnesses, another all dampings.
 *  @param component  as in gough_stability_at_rest()
 *  @return as gough_sampled_at_rest()
 *
 *  Edges are accurate to 1e-11, longest period and delay to 1e-9, the best gains to 1e-6 and the limit of the period to 1e-5 of
 *  themselves. Takes some tenths of a second. Allocates nothing; needs 500 kB of stack. */
GOUGH_API gough_status gough_sampled_margins_at_rest(const gough_model *model,
                                                     const double component[GOUGH_COMPONENTS],
                                                     gough_sampled_margins *margins,
                                                     gough_error *error);

/** What resists a small displacement at rest, about the point `about` of the motion: 6×6 matrices on (δr, δθ), δr the shift of
 *  that point and δθ the rotation in radians, base axes, (stab-18). Of the force and moment by which the loop pushes back. */
typedef struct gough_stiffness {
    gough_state state;         /**< of the pose */
    double length[GOUGH_LEGS]; /**< of the legs there */
    double force[GOUGH_LEGS];  /**< drive forces that hold load, legs and external loads there */
    double condition;          /**< as from gough_conditioning() */
    double control[6][6];      /**< Σ G y yᵀ: of the control's stiffness */
    double geometric
        [6][6]; /**< of the static forces, which turn with the legs or do not follow the load */
    double total[6][6];      /**< their sum */
    double compliance[6][6]; /**< its inverse; NaN where `firm` is false */
    bool
        firm; /**< every displacement is resisted: the symmetric part of total is positive definite */
} gough_stiffness;

/** The stiffness of the loop at rest in a pose, with legs whose forces hold it there, whatever the controller knows of them.
 *  @param component  surge … yaw from home of the point `about` of the motion, radians; NULL: home
 *  @return as gough_stability_at_rest(); @p stiffness has no numbers after an error
 *
 *  External loads are those at t = 0; if one turns with the top or is a moment, the geometric part is not symmetric. Matrices are
 *  accurate to 1e-12 of their largest element, with angles counted as lengths on the base radius, the compliance to
 *  that times their condition number. */
GOUGH_API gough_status gough_stiffness_at_rest(const gough_model *model,
                                               const double component[GOUGH_COMPONENTS],
                                               gough_stiffness *stiffness, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
