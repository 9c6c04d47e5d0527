/* A program compiled with the headers of the earlier edition: it calls one function, by its number, and tells whether the bytes
 * after its structs are still what they were. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "earlier.h"

static unsigned char model[1 << 20];

int main(int count, char **argument) {
    struct {
        gough_simulation simulation;
        gough_formula formula;
        unsigned char after[64];
    } mine;
    memset(&mine, 7, sizeof mine);
    switch (count > 1 ? atoi(argument[1]) : 0) {
    case 0:
        mine.simulation = gough_simulation_default();
        break;
    case 1:
        gough_simulation_check(model, &mine.simulation, NULL);
        break;
    default:
        mine.formula = gough_formula_constant(1);
    }
    for (int i = 0; i < 64; i++)
        if (mine.after[i] != 7) puts("overwritten");
    puts("ran");
    return 0;
}
