/* Timing: things to be timed are registered, then run in rounds, each round through all of them, so that what the machine does
 * meanwhile hits all alike. The time is that of the thread's processor: what others run beside it does not count. */
#ifndef BENCH_MEASURE_H
#define BENCH_MEASURE_H

#include <stdbool.h>
#include <stddef.h>

enum { MEASURE_ROUNDS = 11, MEASURE_ITEMS = 192 };

typedef struct {
    void (*go)(void *context);
    void *context;
    double units; /* of work that one call does: the times below are a unit's */
    bool wall;    /* time of the clock on the wall, for what is not one thread's */
    int rounds, most;
    double seconds[MEASURE_ROUNDS];
} measure_item;

typedef struct {
    measure_item item[MEASURE_ITEMS];
    int count;
    int rounds;
    double least;  /* seconds of an item in a round, if it is so short that it can be repeated */
    double enough; /* seconds of an item in all rounds, after which three rounds will do */
} measure;

typedef struct {
    double median, quietest; /* seconds a unit; NaN: not measured */
} timing;

measure measure_begin(bool quick);

/* registers; returns the item's place, for measure_of() */
int measure_add(measure *m, void (*go)(void *), void *context, double units);

/* times all items */
void measure_run(measure *m);

timing measure_of(const measure *m, int item);

double clock_thread(void); /* seconds of processor time of this thread */
double clock_wall(void);
double clock_process(void); /* seconds of processor time of all threads */

/* pins the thread to the processor it is on; false where that cannot be done */
bool measure_pin(void);
/* gives it back all that the process had at its beginning */
void measure_unpin(void);
int measure_processors(void);

#endif
