/* What a sweep's records depend on besides the text of its study, as digests: the plan of its runs, and what this build computes.
 * And whether the columns that a head names can be those of a sweep. */
#define _POSIX_C_SOURCE 200809L
#include "sweep/sweep_identity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gough/result.h"
#include "sweep/sweep_bytes.h"

enum { PLAN_RUNS = 64, STEPS = 16, ROWS = 20 };

/* ---- the plan ----------------------------------------------------------------------------------------------------- */

/* Keys, how each varies, and the values of runs spread over all of them. */
uint64_t sweep_plan_digest(const gough_sweep *sweep, double *value) {
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    const uint64_t start[] = {gough_sweep_runs(sweep), gough_sweep_seed(sweep),
                              gough_sweep_zipped(sweep), keys};
    uint64_t sum = sweep_digest(0, start, sizeof start);
    for (size_t k = 0; k < keys; k++) {
        const uint64_t whole[] = {key[k].kind, key[k].logarithmic, key[k].count};
        const double real[] = {key[k].least, key[k].greatest};
        sum = sweep_digest(sum, key[k].path, strlen(key[k].path));
        sum = sweep_digest(sum, whole, sizeof whole);
        sum = sweep_digest(sum, real, sizeof real);
    }
    const size_t runs = gough_sweep_runs(sweep), most = runs < PLAN_RUNS ? runs : PLAN_RUNS;
    for (size_t i = 0; i < most; i++) {
        gough_sweep_values(sweep, most > 1 ? 1 + i * (runs - 1) / (most - 1) : 1, value);
        sum = sweep_digest(sum, value, keys * sizeof *value);
    }
    return sum;
}

/* ---- what this build computes ------------------------------------------------------------------------------------- */

typedef struct rows {
    uint64_t sum;
    int count;
} rows;

static int add_row(void *context, const gough_row *row) {
    rows *r = context;
    for (int c = 0; c < GOUGH_COLUMNS; c++)
        if (!isnan(row->value[c])) r->sum = sweep_digest(r->sum, &row->value[c], sizeof(double));
    return ++r->count >= ROWS;
}

/* The first steps of the study as it stands, to the bit: another stepper, constant, compiler's slip or library of functions
 * gives another number. */
uint64_t sweep_numerics_digest(const gough_study *study, bool forces) {
    gough_simulation s = study->simulation;
    rows r = {.sum = 1};
    gough_end end;
    s.output_step = s.step > 0 ? s.step : fmin(s.output_step, s.duration / STEPS);
    if (forces)
        (void)gough_forces(study->model, &s, add_row, &r, NULL, NULL, &end, NULL);
    else
        (void)gough_simulate(study->model, &s, add_row, &r, &end, NULL);
    return r.sum;
}

/* ---- columns ------------------------------------------------------------------------------------------------------ */

/* The number of a list's element in a path; NULL where there is none. */
static const char *skip_number(const char *path) {
    const size_t digits = strspn(path, "0123456789");
    return digits > 0 && digits <= 6 && path[0] != '0' ? path + digits : NULL;
}

/* Whether a path is this key of the table, or an element of its list or of a list in that. */
static bool matches(const char *path, const char *key) {
    for (; *key; key++) {
        const bool element = key[0] == 'N' && (key[1] == '.' || key[1] == '\0');
        if (element && !(path = skip_number(path))) return false;
        if (!element && *path++ != *key) return false;
    }
    for (int depth = 0; depth < 2 && *path == '.'; depth++)
        if (!(path = skip_number(path + 1))) return false;
    return *path == '\0';
}

bool sweep_column_known(const char *path, const char *label, const gough_units *units) {
    size_t keys;
    const gough_key *key = gough_study_keys(&keys);
    for (size_t i = 0; i < keys; i++)
        if (matches(path, key[i].path) && strncmp(path, "sweep", 5) != 0)
            return strcmp(label, gough_unit_label(units, gough_unit_of_field(key[i].unit))) == 0;
    return false;
}
