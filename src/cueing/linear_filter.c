/* Linear filters in exact steps. Theory: docs/theory/cueing.md. */
#include "cueing/linear_filter.h"

#include <math.h>
#include <string.h>

/* States, input and its change; terms of the series, whose remainder is below 1e-20 for a matrix of norm 1/2; squarings at most. */
enum { ROWS = 5, TERMS = 16, MOST_SQUARINGS = 60 };

typedef double square[ROWS][ROWS];

static void multiply(int n, square x, square y, square out) {
    square product = {{0}};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            for (int j = 0; j < n; j++) product[i][j] += x[i][k] * y[k][j];
    memcpy(out, product, sizeof product);
}

/* e^A by its series for A/2^s, squared s times. The core needs no LAPACK, with which the analysis of loops has its
 * exponential; five rows of a stable filter lose nothing by this. Returns false if a number is not finite or A is too large. */
static bool small_exponential(int n, square A, square out) {
    double norm = 0;
    int squarings = 0;
    square part, term = {{0}};
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) norm += fabs(A[i][j]);
    if (!isfinite(norm)) return false;
    while (ldexp(norm, -squarings) > 0.5) squarings++;
    if (squarings > MOST_SQUARINGS) return false;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) part[i][j] = ldexp(A[i][j], -squarings), out[i][j] = i == j;
        term[i][i] = 1;
    }
    for (int k = 1; k <= TERMS; k++) {
        multiply(n, term, part, term);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) term[i][j] /= k, out[i][j] += term[i][j];
    }
    for (int s = 0; s < squarings; s++) multiply(n, out, out, out);
    return true;
}

/* (cue-5): with input u + s v, v its change in a step, ẋ = A x + B (u + s v) is linear in (x, u, v); one exponential has all
 * of it */
bool linear_filter_begin(gough_linear_filter *filter, int states, const double *row,
                         double period) {
    square A = {{0}}, step;
    const int last = states - 1, input = states, change = states + 1;
    bool good = true;
    *filter = (gough_linear_filter){.states = states};
    for (int i = 0; i < last; i++) A[i][i + 1] = period;
    for (int i = 0; i < states; i++) A[last][i] = period * row[i];
    A[last][input] = period;
    A[input][change] = 1;
    if (!small_exponential(states + 2, A, step)) return false;
    for (int i = 0; i < states; i++) {
        for (int j = 0; j < states; j++) {
            filter->next[i][j] = step[i][j];
            good &= isfinite(step[i][j]);
        }
        filter->now[i] = step[i][change];
        filter->before[i] = step[i][input] - step[i][change];
        good &= isfinite(filter->now[i]) && isfinite(filter->before[i]);
    }
    return good;
}

void linear_filter_take(gough_linear_filter *filter, double input) {
    double next[3] = {0};
    const bool first = !filter->begun;
    for (int i = 0; i < filter->states && !first; i++) {
        next[i] = filter->before[i] * filter->input + filter->now[i] * input;
        for (int j = 0; j < filter->states; j++) next[i] += filter->next[i][j] * filter->state[j];
    }
    memcpy(filter->state, next, sizeof next);
    filter->input = input;
    filter->begun = true;
}
