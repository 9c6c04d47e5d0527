/* Machines whose numbers are chosen by the tests: a table that goes up and down, and a small motion base. */
#ifndef TESTS_DESIGN_JACK_H
#define TESTS_DESIGN_JACK_H

#include "gough/design.h"
#include "support/machines.h"

/* A table on legs of equal length, box of heave ±JACK_HEAVE. Numbers: the height. Its legs have lengths √(h² + ρ²). */
#define JACK_HEAVE 0.2
typedef struct jack {
    gough_model model;
    double longest;      /* limit of the legs; INFINITY: none */
    double refuse_above; /* heights that make no machine */
    size_t made;
} jack;

/* ρ, the horizontal distance of the joints of a leg, and the weight */
double jack_across(void);
double jack_weight(void);

/* a request for it: heights of 0.5 to 2.5, started at 1 */
gough_design_request jack_request(jack *j);

/* A motion base with a part of a box that asks for much. Numbers: base radius and half angle, top radius and half angle, height;
 * angles in degrees. */
typedef struct base {
    gough_model model;
    double part; /* of its box */
} base;
gough_design_request base_request(base *b);

/* Expects a request to be refused with this in the sentence. */
void jack_refuse(gough_design_request r, const char *part);

#endif
