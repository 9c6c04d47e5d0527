/* What an earlier edition of the headers declared: functions under their plain names, some of which return a struct, and a shorter
 * gough_simulation. Struct members that the test does not use are bytes. */
#ifndef EARLIER_H
#define EARLIER_H

typedef struct {
    double duration, output_step;
    unsigned char others[64];
} gough_simulation;

typedef struct {
    unsigned char all[100];
} gough_formula;

gough_simulation gough_simulation_default(void);
int gough_simulation_check(const void *model, const gough_simulation *simulation, void *error);
gough_formula gough_formula_constant(double value);

#endif
