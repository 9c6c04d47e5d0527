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
    bool whole; /* along a motion drives lag and have limits, and integrals add up, as in a run */
} linear_loop;

/* whether the control or the legs damp, or may take energy out as matrices of gains do */
bool linear_is_damped(const linear_loop *loop);

typedef double linear_matrix[GOUGH_LINEAR][GOUGH_LINEAR];

struct linear_complex {
    /* (stab-13) at a time, with drives that follow at once and no integrals; state NULL: about the program. Returns what is not
     * finite, such as "motion.heave", or NULL */
    const char *(*matrix)(const linear_loop *loop, double t, const gough_state *state,
                          linear_matrix matrix);

    /* The same with the states of drives and integrals: of these `kept` are taken, in this order. Row by row. */
    const char *(*whole)(const linear_loop *loop, double t, const gough_state *state,
                         const int *kept, int size, double *matrix);

    /* the same as the first about the program at many times */
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

    /* rates of (ρ, i, j, k), of their rates and, if the loop is whole, of drives and integrals; (stab-13) there, of the platform
     * and of those of the others that are `kept`, row by row */
    const char *(*flow)(const linear_loop *loop, double t, const double *y, double *rate,
                        const int *kept, int size, double *matrix);

    /* how many numbers its state has: MOTION, and more if the loop is whole */
    int (*states)(const linear_loop *loop);

    /* that state with the platform where y has it, drives that give what is asked of them and integrals of 0 */
    void (*settle)(const linear_loop *loop, double t, double y[STATE_SIZE]);
};

extern const struct linear_complex linear_complex;

/* J = Σ_a (I_b + I_c) e_a e_aᵀ in base axes, with e = R P and the second moments that the equations of motion use */
void linear_inertia(const gough_machine *machine, const gough_state *state, double inertia[3][3]);

/* the mass matrix on (δv, δω), of the centre of mass, base axes: M and J, and what the legs add to them */
void linear_mass(const gough_machine *machine, const gough_state *state, double mass[6][6]);

/* The states of drives and integrals that a loop has, for `whole`; returns their number. */
enum { LINEAR_BEYOND = GOUGH_LINEAR_MOST - GOUGH_LINEAR };
int linear_beyond(const gough_machine *machine, const gough_control *control,
                  int kept[LINEAR_BEYOND]);

/* Fails for a sampled controller, for which `what` cannot be computed ("the stability about a program"). */
gough_status linear_refuse_sampled(const gough_model *model, const char *what, gough_error *error);

/* Where a loop rests: a program that stands at its equilibrium, the control that feeds forward what holds it there, its state. */
gough_status linear_at_rest(const gough_model *model, const double component[GOUGH_COMPONENTS],
                            gough_motion *motion, gough_control *control, gough_state *state,
                            gough_error *error);

/* The sentence for a matrix that could not be found: `wrong` as returned above, a singular pose, a number not finite. */
gough_status linear_check(const linear_loop *loop, double t, const gough_state *state,
                          linear_matrix matrix, const char *wrong, gough_error *error);

#endif
