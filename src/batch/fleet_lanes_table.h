/* What each width of lanes offers to a fleet: groups of plants side by side. */
#ifndef GOUGH_BATCH_FLEET_LANES_TABLE_H
#define GOUGH_BATCH_FLEET_LANES_TABLE_H

#include "gough/fleet.h"

/* what all plants of a fleet share: a program at rest, no disturbance, commands that are held */
typedef struct {
    gough_motion motion;
    gough_control control;
    gough_disturbance disturbance;
    gough_simulation options;
} fleet_parts;

/* what a call gives and takes, of all plants */
typedef struct {
    long long steps;
    const double *command, *wrench; /* wrench may be NULL */
    gough_state *state;             /* this and the following may be NULL */
    double *length, *rate;
    unsigned char *ended;
} fleet_call;

/* The memory of a fleet's groups. What a machine is made of is large, so that groups whose plants all have the machine of the
 * first plant share it: a call then goes through little memory. */
typedef struct {
    char *group;       /* one after the other: states */
    char *system;      /* one for each group, of groups with machines of their own */
    const char *alike; /* the one of all others */
} fleet_memory;

struct fleet_width {
    int lanes;
    size_t group_size, system_size; /* bytes, multiples of 64 */

    /* makes the system that groups share */
    void (*share)(void *alike, const fleet_parts *parts, const gough_machine *machine);

    /* puts `count` plants into a group, at home; further lanes repeat the last, and are not read. own: their machines are not the
     * shared one */
    void (*begin)(const fleet_memory *memory, size_t group, const fleet_parts *parts,
                  const gough_machine *const *machine, int count, int own);

    /* puts one of them into a state; its machine may be NULL */
    void (*put)(const fleet_memory *memory, size_t group, const fleet_parts *parts, int lane,
                const gough_machine *machine, const gough_state *state);

    /* moves the groups from number `first` to before `last` */
    void (*move)(const fleet_memory *memory, const fleet_parts *parts, const fleet_call *call,
                 size_t first, size_t last);
};

extern const struct fleet_width fleet_width_1, fleet_width_2, fleet_width_4, fleet_width_8;

#endif
