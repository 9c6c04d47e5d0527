/** @file fleet.h
 *  Many plants side by side under commands: machines with their drives, moved step by step by controllers of the caller's, such as
 *  for learning. They are computed in the lanes of vector registers and distributed over threads. gough_step() moves one plant,
 *  with the program and the disturbances of a model; a fleet has neither, so that each plant has a time of its own.
 *
 *  Numbers are in the units of the machines, angles in radians; frames are those of gough_state. An error argument may be NULL.
 *
 *  Accuracy: that of the method with its step; the same bits for any number of lanes and threads.
 *  Overlap: outputs must not overlap inputs or each other.
 *  Threads: functions may be called from several threads at once, on distinct fleets. gough_fleet_move() starts threads of its own
 *  and waits for them.
 */
#ifndef GOUGH_FLEET_H
#define GOUGH_FLEET_H

#include "gough/dynamics.h"
#include "gough/simulate.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Whether a plant moves, or why it does not. */
typedef enum gough_fleet_state {
    GOUGH_FLEET_MOVES,      /**< it moves */
    GOUGH_FLEET_LIMIT,      /**< at the end of a step a leg or the platform exceeded a limit */
    GOUGH_FLEET_SINGULAR,   /**< the determinant of its pose changed its sign, or nearly vanished */
    GOUGH_FLEET_NOT_FINITE, /**< its motion was no longer finite */
    GOUGH_FLEET_STATES
} gough_fleet_state;

/** Bytes of memory of a fleet of so many plants, aligned to 64. */
GOUGH_API size_t gough_fleet_size(size_t count);

/** Makes a fleet; all plants rest at home.
 *  @param[out] fleet  gough_fleet_size() bytes, aligned to 64. Nothing is allocated, and nothing needs to be freed
 *  @param machine     a machine for each plant, which may be the same one; they must outlive the fleet
 *  @param count       number of plants
 *  @param simulation  method (GOUGH_RK4 or GOUGH_DOP853) and fixed step; other members are not used
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence for a step that is not above 0 and finite, for another method or adaptive
 *  steps, for a machine with external loads, and for machines that differ in height at home, in whether legs have mass, or in
 *  the kind or order of drives. */
GOUGH_API gough_status gough_fleet_begin(void *fleet, const gough_machine *const *machine,
                                         size_t count, const gough_simulation *simulation,
                                         gough_error *error);

/** Puts one plant into a state, in which it moves again. A drive that lags begins with the next command.
 *  @param plant    its number, from 0
 *  @param machine  its machine from now on, of the same kind as those of gough_fleet_begin(); NULL: as before
 *  @param state    pose and velocities
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if there is no such plant, the matrix of the state is not a rotation, or the
 *  machine is of another kind: nothing is then changed */
GOUGH_API gough_status gough_fleet_put(void *fleet, size_t plant, const gough_machine *machine,
                                       const gough_state *state, gough_error *error);

/** Moves all plants by fixed steps under commands that are held. A plant whose motion has ended stays where it ended: limits are
 *  compared at the ends of steps, determinants at the end of the call, so that what is exceeded between them is not found.
 *  @param steps          >= 1
 *  @param command        six forces for each plant, which each drive is to have; its limits and lag come after it
 *  @param wrench         force at the centre of mass and moment on the load, six numbers for each plant, base axes; NULL: none
 *  @param threads        0: one for each processor that the process may use
 *  @param[out] state     of each plant at the end; may be NULL
 *  @param[out] length    six leg lengths of each plant; may be NULL
 *  @param[out] rate      their rates; may be NULL
 *  @param[out] ended     a gough_fleet_state for each plant; may be NULL
 *  @return GOUGH_OK, also where motions have ended; GOUGH_ERROR_INPUT with a sentence if @p steps is below 1. Allocates nothing.
 *  Positions are accurate to a few roundings more than the method. */
GOUGH_API gough_status gough_fleet_move(void *fleet, long long steps, const double *command,
                                        const double *wrench, int threads, gough_state *state,
                                        double *length, double *rate, unsigned char *ended,
                                        gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
