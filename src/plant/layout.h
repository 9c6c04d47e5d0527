/* Where the parts of a machine in motion have their numbers in the state that a stepper sees. Plain C. */
#ifndef GOUGH_PLANT_LAYOUT_H
#define GOUGH_PLANT_LAYOUT_H

/* a pose: ρ, i, j, k; a pose and its rate */
enum { COORDINATES = 12, MOTION = 2 * COORDINATES };

/* drives that lag: force and rate of force of each leg; a continuous controller: the integral of each leg */
enum { DRIVE_STATES = 12, INTEGRAL_STATES = 6 };

/* Most numbers of a state. A part with states of its own (a drive, a controller) adds its slice here. */
enum { STATE_SIZE = MOTION + DRIVE_STATES + INTEGRAL_STATES };

/* some of the numbers, one after the other */
typedef struct {
    int at, count;
} slice;

#endif
