/* The equations of motion linearised: what the complex compilation of the run's texts offers to this room. */
#ifndef GOUGH_LINEAR_LINEAR_H
#define GOUGH_LINEAR_LINEAR_H

#include "gough/linear.h"
#include "plant/layout.h"

/* A closed loop without disturbances. */
typedef struct {
    const gough_machine *machine;
    const gough_motion *motion;
    const gough_control *control;
    bool
        undamped; /* without the viscous friction of the legs; the control's damping is as it says */
    double unloaded; /* the part of the external loads that is left out, 0 … 1 */
} linear_loop;

/* whether the control or the legs damp */
bool linear_is_damped(const linear_loop *loop);

typedef double linear_matrix[GOUGH_LINEAR][GOUGH_LINEAR];

struct linear_complex {
    /* (stab-13) at a time; state NULL: about the program. Returns what is not finite, such as "motion.heave", or NULL */
    const char *(*matrix)(const linear_loop *loop, double t, const gough_state *state,
                          linear_matrix matrix);

    /* the same about the program at many times */
    const char *(*along)(const linear_loop *loop, const double *t, size_t count,
                         linear_matrix *matrix);

    /* accelerations of the centre of mass and of the angle, base axes, and leg forces, in a state at time t */
    const char *(*accelerations)(const linear_loop *loop, double t, const gough_state *state,
                                 double acceleration[6], double force[GOUGH_LEGS]);

    /* How the momenta of load and legs, of force and about the centre of mass, base axes, change with (δr, δθ, δv, δω); and the
     * second of them */
    void (*momenta)(const gough_machine *machine, const gough_state *state,
                    double change[6][GOUGH_LINEAR], double moment[3]);

    /* M̂ on (ρ̇, ω) in base axes of a machine whose legs have mass */
    void (*mass)(const gough_machine *machine, const gough_state *state, double mass[6][6]);

    /* rates of (ρ, i, j, k) and their rates, and (stab-13) there */
    const char *(*flow)(const linear_loop *loop, double t, const double y[MOTION],
                        double rate[MOTION], linear_matrix matrix);
};

extern const struct linear_complex linear_complex;

/* J = Σ_a (I_b + I_c) e_a e_aᵀ in base axes, with e = R P and the second moments that the equations of motion use */
void linear_inertia(const gough_machine *machine, const gough_state *state, double inertia[3][3]);

/* the mass matrix on (δv, δω), of the centre of mass, base axes: M and J, and what the legs add to them */
void linear_mass(const gough_machine *machine, const gough_state *state, double mass[6][6]);

/* The sentence for a matrix that could not be found: `wrong` as returned above, a singular pose, a number not finite. */
gough_status linear_check(const linear_loop *loop, double t, const gough_state *state,
                          linear_matrix matrix, const char *wrong, gough_error *error);

#endif
