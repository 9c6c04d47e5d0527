/* What a record is like and what is done to it: angles are made continuous, about turned axes if necessary, the accelerations
 * that the rounding of its digits makes are compared with those of the motion, and what is asked to be smoothed is smoothed.
 * (motion-7) to (motion-10). Lengths and times in the study's units, angles in degrees while they are worked on. */
#include "study/record.h"

#include <math.h>
#include <string.h>

#include "study/record_text.h"
#include "study/turned.h"

static const double TURN = 6.28318530717958647693;

/* What rounding does to one column. */
typedef struct doubt {
    double deviation; /* root mean square of the error of a value */
    double greatest;  /* and its bound */
    double rounding;  /* the acceleration that it can make, as recorded */
} doubt;

/* Of a row: the eight numbers of smoothing, or six of curvature and two of the spline's solution; and a column as it was. */
enum { SMOOTHED_APART = 8, WORK = SMOOTHED_APART + 1 };

size_t study_record_work(size_t count) { return WORK * count; }

static double *column_of(const study_record_table *table) {
    return table->work + SMOOTHED_APART * table->count;
}

double study_record_degrees(const study_recording *recording) {
    const gough_units degrees = gough_units_si();
    return gough_unit_read(&recording->units, GOUGH_UNIT_ANGLE, 1) /
           gough_unit_read(&degrees, GOUGH_UNIT_ANGLE, 1);
}

/* Values, steps and deviations of the angles from the study's unit to degrees. */
static void begin_degrees(const study_record_table *table, study_recording *recording,
                          study_quantum step[GOUGH_COMPONENTS]) {
    const double degrees = study_record_degrees(recording);
    for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) {
        for (size_t i = 0; i < table->count; i++)
            table->value[i * GOUGH_COMPONENTS + (size_t)c] *= degrees;
        step[c].greatest *= degrees;
        step[c].mean *= degrees;
        recording->smoothing.deviation[c] *= degrees;
    }
}

/* What was found out about angles back to the study's unit. */
static void end_degrees(study_recording *recording) {
    const double degrees = study_record_degrees(recording);
    gough_record *record = recording->record;
    record->pole_distance /= degrees;
    for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) {
        gough_record_column *column = &record->column[c];
        column->step /= degrees;
        column->rounding /= degrees;
        column->motion /= degrees;
        column->change /= degrees;
        column->worst_change /= degrees;
    }
}

static const double *at(const study_record_table *table, size_t row, int c) {
    return table->value + row * GOUGH_COMPONENTS + (size_t)c;
}

static bool changes(const study_record_table *table, int c) {
    for (size_t i = 1; i < table->count; i++)
        if (fabs(*at(table, i, c) - *at(table, 0, c)) > 0) return true;
    return false;
}

/* Rate of the component at a row. */
static double rate(const study_record_table *table, size_t i, int c) {
    const size_t low = i > 0 ? i - 1 : 0, high = i + 1 < table->count ? i + 1 : i;
    return (*at(table, high, c) - *at(table, low, c)) / (table->time[high] - table->time[low]);
}

/* (motion-9): errors of at most e in rows h and h' apart make accelerations of at most 12 e/(h h') in the spline, and of
 * 4 e/(h h') in a parabola through three rows. A value is wrong by half its step, and by half the step of the times at its
 * rate. */
static doubt doubt_of(const study_record_table *table, const study_quantum *step, double time_step,
                      int c) {
    const double factor = table->count > 3 ? 12 : 4;
    double squares = 0, fastest = 0;
    doubt found = {.rounding = 0};
    for (size_t i = 0; i < table->count; i++) {
        const double v = fabs(rate(table, i, c));
        squares += v * v;
        fastest = fmax(fastest, v);
        if (i == 0 || i + 1 == table->count) continue;
        const double before = table->time[i] - table->time[i - 1],
                     after = table->time[i + 1] - table->time[i];
        const double error = (step->greatest + v * time_step) / 2;
        found.rounding = fmax(found.rounding, factor * error / before / after);
    }
    const double of_times = time_step * sqrt(squares / (double)table->count);
    found.deviation = sqrt((step->mean * step->mean + of_times * of_times) / 12);
    found.greatest = (step->greatest + fastest * time_step) / 2;
    return found;
}

/* What is left of it below a cutoff: white noise of deviation σ in rows h apart has the spectrum σ²h, and the filter
 * leaves √(σ² h ω_c⁵/18) of it in the second derivative; peaks are √12 times as high, as they are without a filter. */
static double left_by(const doubt *d, double interval, double cutoff) {
    const double omega = TURN * cutoff;
    const double left = sqrt(12.0 / 18) * d->deviation * sqrt(interval * pow(omega, 5));
    return fmin(left, d->rounding);
}

/* Greatest acceleration of a component in the prepared spline. */
static double acceleration(const study_record_table *table, int c) {
    double most = 0;
    for (size_t i = 0; i < table->count; i++)
        most = fmax(most, fabs(table->work[i * GOUGH_COMPONENTS + (size_t)c]));
    return most;
}

/* The strongest smoothing that moves values no further than rounding may have done; a half more is left for errors of the
 * smooth curve itself. */
static gough_status smooth_rounding(const study_record_table *table, int c, const doubt *d,
                                    double *cutoff, gough_error *error) {
    return gough_samples_smooth(table->count, table->time, table->value, c, d->deviation,
                                1.5 * d->greatest, cutoff, table->work, error);
}

static gough_status smooth(const study_record_table *table, const study_smoothing *how, int c,
                           const doubt *d, double *cutoff, gough_error *error) {
    *cutoff = INFINITY;
    switch (how->kind) {
    case STUDY_SMOOTH_ROUNDING:
        return smooth_rounding(table, c, d, cutoff, error);
    case STUDY_SMOOTH_DEVIATIONS:
        return gough_samples_smooth(table->count, table->time, table->value, c, how->deviation[c],
                                    INFINITY, cutoff, table->work, error);
    case STUDY_SMOOTH_CUTOFF:
        if (table->count > 3) *cutoff = how->cutoff;
        return gough_samples_low_pass(table->count, table->time, table->value, c, how->cutoff,
                                      table->work, error);
    default:
        return GOUGH_OK;
    }
}

/* Root mean square and greatest of what smoothing changed. */
static void measure_change(const study_record_table *table, const double *before, int c,
                           gough_record_column *column) {
    double squares = 0;
    for (size_t i = 0; i < table->count; i++) {
        const double moved = fabs(*at(table, i, c) - before[i]);
        squares += moved * moved;
        column->worst_change = fmax(column->worst_change, moved);
    }
    column->change = sqrt(squares / (double)table->count);
}

static gough_status prepare(const study_record_table *table, gough_error *error) {
    const gough_samples spline = {.count = table->count,
                                  .time = table->time,
                                  .value = table->value,
                                  .curvature = table->work};
    return gough_samples_prepare(&spline, table->work + GOUGH_COMPONENTS * table->count, error);
}

static void copy_column(const study_record_table *table, int c, double *column) {
    for (size_t i = 0; i < table->count; i++) column[i] = *at(table, i, c);
}

/* Where rounding may hide the motion, the motion is what is left when rounding is smoothed away. */
static void uncover_motion(const study_record_table *table, const doubt *d, gough_record *record) {
    double *column = column_of(table);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        gough_record_column *found = &record->column[c];
        double cutoff = INFINITY;
        if (isfinite(found->cutoff) || found->rounding <= 0.05 * found->motion) continue;
        copy_column(table, c, column);
        smooth_rounding(table, c, &d[c], &cutoff, NULL);
        if (!isfinite(cutoff)) continue;
        if (prepare(table, NULL) == GOUGH_OK) /* unreachable: times as before */
            found->motion = acceleration(table, c);
        for (size_t i = 0; i < table->count; i++)
            table->value[i * GOUGH_COMPONENTS + (size_t)c] = column[i];
    }
}

static void find_clock(study_record_table *table, study_recording *recording) {
    gough_record *record = recording->record;
    const study_clock clock = table->clock;
    record->interval = clock.interval;
    record->time_step = clock.step;
    record->even = clock.even;
    record->retimed =
        clock.even && clock.step > 0 && recording->smoothing.kind == STUDY_SMOOTH_ROUNDING;
    if (record->retimed) study_clock_set(&clock, table->time, table->count);
}

static gough_status smooth_columns(const study_record_table *table,
                                   const study_recording *recording, const doubt *d,
                                   gough_error *error) {
    double *column_before = column_of(table);
    gough_record *record = recording->record;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        gough_record_column *column = &record->column[c];
        if (!changes(table, c)) continue;
        copy_column(table, c, column_before);
        const gough_status status =
            smooth(table, &recording->smoothing, c, &d[c], &column->cutoff, error);
        if (status != GOUGH_OK) return status;
        if (!isfinite(column->cutoff)) continue;
        measure_change(table, column_before, c, column);
        column->rounding = left_by(&d[c], record->interval, column->cutoff);
    }
    return GOUGH_OK;
}

/* Rx Ry Rz of three angles is the transpose of Rz Ry Rx of the opposite ones, (motion-1): a record in that order is treated as one
 * in the usual order with opposite angles. */
static void mirror(study_record_table *table, const study_recording *recording) {
    if (recording->order != GOUGH_XYZ) return;
    for (size_t i = 0; i < table->count; i++) {
        for (size_t c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) {
            double *angle = &table->value[i * GOUGH_COMPONENTS + c];
            *angle = 0 - *angle;
        }
    }
}

gough_status study_record_make(study_record_table *table, study_recording *recording,
                               gough_error *error) {
    gough_record *record = recording->record;
    study_quantum step[GOUGH_COMPONENTS];
    doubt d[GOUGH_COMPONENTS] = {{0, 0, 0}};
    memcpy(step, table->step, sizeof step);
    begin_degrees(table, recording, step);
    mirror(table, recording);
    record->unwrapped = gough_samples_unwrap(table->count, table->value, 180);
    study_record_turn(table, recording, step, table->work);
    find_clock(table, recording);
    const double time_step = record->retimed ? 0 : record->time_step;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        gough_record_column *column = &record->column[c];
        column->cutoff = INFINITY;
        column->given = table->given[c] | (record->turned & (c >= GOUGH_ROLL));
        if (!changes(table, c)) continue;
        d[c] = doubt_of(table, &step[c], time_step, c);
        column->step = step[c].greatest;
        column->rounding = table->count > 2 ? d[c].rounding : 0;
    }
    gough_status status = smooth_columns(table, recording, d, error);
    if (status == GOUGH_OK) status = prepare(table, error);
    if (status != GOUGH_OK) return status;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) record->column[c].motion = acceleration(table, c);
    study_record_say_jumps(table, recording);
    uncover_motion(table, d, record);
    study_record_say_rest(table, recording);
    mirror(table, recording);
    end_degrees(recording);
    return GOUGH_OK;
}
