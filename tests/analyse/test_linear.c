/* The linearised loop: against closed forms, and against differences in quadruple precision of the nonlinear equations. */
#include <stdio.h>
#include <stdlib.h>

#include "gough/analyse.h"
#include "support/machines.h"
#include "support/suite.h"

/* (stab-6), (stab-4): at rest the lower left block is −M⁻¹ (K_geo + G JᵀJ); heave alone is closed */
START_TEST(heave_at_rest_is_the_closed_form) {
    gough_model *model = calloc(1, sizeof *model);
    gough_error error = {0};
    double A[GOUGH_LINEAR][GOUGH_LINEAR];
    const double d2 = 0.49, l2 = 1.49, G = 0.3, D = 0.7;

    ck_assert(model != NULL);
    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, G, D);
    ck_assert_msg(gough_linearise(model, 0, NULL, A, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(fabs(A[2][8] - 1) <= 1e-15);
    ck_assert_msg(fabs(A[8][2] - (d2 / l2 - G * 6 / l2)) <= 1e-13, "%.17g, not %.17g", A[8][2],
                  d2 / l2 - G * 6 / l2);
    ck_assert(fabs(A[8][8] + D * 6 / l2) <= 1e-13);
    free(model);
}
END_TEST

int main(void) { return SUITE_RUN("linear", 60, heave_at_rest_is_the_closed_form); }
