/* Where the parts of a machine in motion have their numbers in the state that a stepper sees. Plain C. */
#ifndef GOUGH_PLANT_LAYOUT_H
#define GOUGH_PLANT_LAYOUT_H

/* a pose: ρ, i, j, k; a pose and its rate */
enum { COORDINATES = 12, MOTION = 2 * COORDINATES };

/* Most numbers of a state. A part with states of its own (a drive, a controller) adds its slice here. */
enum { STATE_SIZE = MOTION };

/* some of the numbers, one after the other */
typedef struct {
    int at, count;
} slice;

#endif
