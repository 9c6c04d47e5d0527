/* Any bytes as a formula compile and evaluate, or end in a sentence about a place within them. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "gough/model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(int condition) {
    if (!condition) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const double TIMES[] = {0, 0.5, 1, -3, 1e300};
    gough_formula formula;
    gough_error error = {.message = ""};
    size_t offset = 0;
    const gough_status status =
        gough_formula_compile(&formula, (const char *)data, size, &offset, &error);
    require(offset <= size);
    if (status == GOUGH_OK) {
        require(formula.count > 0 && formula.count <= GOUGH_FORMULA_OPERATIONS);
        for (size_t i = 0; i < sizeof TIMES / sizeof TIMES[0]; i++) {
            double jet[3];
            gough_formula_evaluate(&formula, TIMES[i], jet);
        }
    } else {
        require(status == GOUGH_ERROR_INPUT && formula.count == 0);
        require(error.message[0] != '\0' && memchr(error.message, 0, sizeof error.message) != NULL);
    }
    return 0;
}
