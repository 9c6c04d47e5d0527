/* The sentences about a record, in the study's units: what was changed, and what may falsify the forces. */
#include "study/record_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "study/turned.h"

static const double MUCH = 0.1;        /* of the motion's acceleration: more is warned of */
static const double QUARTER_TURN = 90; /* between two rows: no rotation is drawn by such rows */

static const double POLE_JUMP = 20; /* degrees of yaw between two rows, most of which roll undoes */

static const char *word(const study_recording *recording, gough_unit unit) {
    return gough_unit_word(&recording->units, unit);
}

/* An angle in degrees as the study's. */
static double angle(const study_recording *recording, double degrees) {
    return degrees / study_record_degrees(recording);
}

/* Without dimensions angles alone have units, and their accelerations need one of time. */
static const char *acceleration_unit(const study_recording *recording, int c) {
    if (c < GOUGH_ROLL) return word(recording, GOUGH_UNIT_ACCELERATION);
    return recording->units.dimensionless ? " deg per unit of time squared"
                                          : word(recording, GOUGH_UNIT_ANGULAR_ACCELERATION);
}

static const char *frequency_unit(const study_recording *recording, char text[40]) {
    const char *time = word(recording, GOUGH_UNIT_TIME);
    snprintf(text, 40, "cycles per%s", *time ? time : " unit of time");
    return text;
}

void study_record_say(const study_recording *recording, bool warning, const char *format, ...) {
    gough_record *record = recording->record;
    if (record->remarks == GOUGH_REMARKS) return; /* unreachable: there is room for all */
    gough_remark *remark = &record->remark[record->remarks++];
    va_list list;
    va_start(list, format);
    remark->warning = warning;
    vsnprintf(remark->sentence, sizeof remark->sentence, format, list);
    va_end(list);
}

static const char *times(size_t count) { return count == 1 ? "once" : "several times"; }

/* "t = 1 s and t = 1.5 s": the rows before and after a jump. */
static const char *between(const study_record_table *table, size_t row,
                           const study_recording *recording, char text[80]) {
    const char *unit = word(recording, GOUGH_UNIT_TIME);
    snprintf(text, 80, "t = %.6g%s and t = %.6g%s", table->time[row - 1], unit, table->time[row],
             unit);
    return text;
}

static void say_unwrapped(const study_record_table *table, const study_recording *recording) {
    const gough_unwrapping *done = &recording->record->unwrapped;
    char where[80], names[40] = "";
    size_t jumps = done->flips, columns = 0;
    if (!done->first) return;
    between(table, done->first, recording, where);
    for (int a = 0; a < 3; a++) {
        if (!done->turns[a]) continue;
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s",
                 columns ? " and " : "", gough_component_name(GOUGH_ROLL + a));
        jumps = done->turns[a] > jumps ? done->turns[a] : jumps;
        columns++;
    }
    if (columns)
        study_record_say(
            recording, false,
            "motion.samples: %s jump%s by a whole turn (%s, first between %s); the angles are read "
            "as continuous, which is the same rotation",
            names, columns == 1 ? "s" : "", times(jumps), where);
    if (done->flips)
        study_record_say(
            recording, false,
            "motion.samples: roll, pitch and yaw jump together to other angles of the same "
            "rotation, roll + 180, 180 - pitch, yaw + 180 deg (%s, first between %s); the "
            "continuous ones are used",
            times(done->flips), where);
}

static void say_turned(const study_record_table *table, const study_recording *recording) {
    char where[80];
    between(table, table->turned, recording, where);
    study_record_say(
        recording, false,
        "motion.samples: between %s pitch is within %.2g%s of 90 deg, where roll and yaw cannot "
        "follow a motion; the record is interpolated as the same rotations about turned axes, "
        "which it never brings closer than %.2g%s to such a pose",
        where, angle(recording, table->pole), word(recording, GOUGH_UNIT_ANGLE),
        angle(recording, recording->record->pole_distance), word(recording, GOUGH_UNIT_ANGLE));
}

/* Near pitch 90° roll and yaw turn fast about nearly the same axis while the platform hardly turns. */
static void say_pole(const study_record_table *table, const study_recording *recording) {
    char where[80];
    size_t worst = 0;
    double most = POLE_JUMP;
    for (size_t i = 1; i < table->count; i++) {
        const double *yaw = table->value + i * GOUGH_COMPONENTS + GOUGH_YAW;
        const double jump = fabs(*yaw - *(yaw - GOUGH_COMPONENTS));
        if (jump > most && study_turn_between(table, i) < jump / 3) most = jump, worst = i;
    }
    if (!worst) return;
    study_record_say(
        recording, true,
        "motion.samples: yaw changes by %.3g%s between %s while the platform turns by only %.3g%s: "
        "close to a pitch of 90 deg, roll and yaw cannot follow a motion, and the spline "
        "through them makes false accelerations; there are no axes that stay away from such a pose "
        "during the whole record",
        angle(recording, most), word(recording, GOUGH_UNIT_ANGLE),
        between(table, worst, recording, where), angle(recording, study_turn_between(table, worst)),
        word(recording, GOUGH_UNIT_ANGLE));
}

/* Rows so far apart that the way from one to the next is a guess; angles about turned axes do not tell it. */
static void say_turn(const study_record_table *table, const study_recording *recording) {
    char where[80];
    size_t worst = 0;
    double most = QUARTER_TURN;
    for (size_t i = 1; i < table->count; i++) {
        const double turn = study_turn_between(table, i);
        if (turn > most) most = turn, worst = i;
    }
    if (!worst) return;
    study_record_say(
        recording, true,
        "motion.samples: the platform turns by %.3g%s between %s; rows so far apart do not "
        "determine its way from one to the next",
        angle(recording, most), word(recording, GOUGH_UNIT_ANGLE),
        between(table, worst, recording, where));
}

/* Angles that still jump by more than a quarter turn between two rows. */
static void say_jump(const study_record_table *table, const study_recording *recording, int c) {
    const size_t stride = GOUGH_COMPONENTS;
    size_t worst = 0;
    double most = QUARTER_TURN;
    for (size_t i = 1; i < table->count; i++) {
        const double *now = table->value + i * stride + (size_t)c;
        const double jump = fabs(now[0] - *(now - stride));
        if (jump > most) most = jump, worst = i;
    }
    if (!worst) return;
    char where[80];
    const double *m = table->work + worst * stride + (size_t)c;
    study_record_say(
        recording, true,
        "motion.samples: %s jumps by %.3g%s between %s, which is no whole turn; the spline "
        "through these rows makes %.3g%s",
        gough_component_name(c), angle(recording, most), word(recording, GOUGH_UNIT_ANGLE),
        between(table, worst, recording, where),
        angle(recording, fmax(fabs(m[0]), fabs(*(m - stride)))), acceleration_unit(recording, c));
}

void study_record_say_jumps(const study_record_table *table, const study_recording *recording) {
    if (recording->record->turned) {
        say_turned(table, recording);
        say_turn(table, recording);
        return;
    }
    say_unwrapped(table, recording);
    for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) say_jump(table, recording, c);
    if (table->crowded) say_pole(table, recording);
}

/* What to do about it, by what was tried. */
static const char *cure(const study_recording *recording, char text[160]) {
    char frequency[40];
    frequency_unit(recording, frequency);
    switch (recording->smoothing.kind) {
    case STUDY_EXACT:
        snprintf(text, 160, "`motion.smooth: none` takes the values as exact");
        break;
    case STUDY_SMOOTH_CUTOFF:
        snprintf(text, 160, "lower `motion.cutoff`, or record more digits");
        break;
    case STUDY_SMOOTH_ROUNDING:
    case STUDY_SMOOTH_DEVIATIONS:
        snprintf(text, 160, "use `motion.cutoff` (%s), or record more digits", frequency);
        break;
    default:
        snprintf(text, 160,
                 "use `motion.smooth: rounding` or `motion.cutoff` (%s), or record more digits",
                 frequency);
    }
    return text;
}

/* Accelerations that rounding can make, where they matter beside those of the motion. */
static void say_rounding(const study_recording *recording, int c) {
    const gough_record *record = recording->record;
    const gough_record_column *column = &record->column[c];
    const double size = c < GOUGH_ROLL ? 1 : study_record_degrees(recording);
    const char *unit = acceleration_unit(recording, c);
    char name[40], advice[160], step[80] = "", clock[80] = "";
    if (!(column->rounding > MUCH * column->motion)) return;
    snprintf(name, sizeof name, "%s%s", gough_component_name(c),
             record->turned && c >= GOUGH_ROLL ? " about turned axes" : "");
    if (column->step > 0)
        snprintf(step, sizeof step, "values of %s in steps of %.3g%s", name, column->step / size,
                 word(recording, c < GOUGH_ROLL ? GOUGH_UNIT_LENGTH : GOUGH_UNIT_ANGLE));
    if (record->time_step > 0 && !record->retimed)
        snprintf(clock, sizeof clock, "%stimes in steps of %.3g%s%s", *step ? " and " : "",
                 record->time_step, word(recording, GOUGH_UNIT_TIME),
                 *step ? "" : " for a moving ");
    study_record_say(
        recording, recording->smoothing.kind != STUDY_EXACT,
        "motion.samples has %s%s%s: rounding to them %s accelerations of up to %.3g%s, "
        "beside %.3g%s of the motion itself; %s",
        step, clock, *step ? "" : name, isfinite(column->cutoff) ? "can still make" : "can make",
        column->rounding / size, unit, column->motion / size, unit, cure(recording, advice));
}

void study_record_say_rest(const study_record_table *table, const study_recording *recording) {
    const gough_record *record = recording->record;
    const char *time = word(recording, GOUGH_UNIT_TIME);
    char frequency[40];
    (void)table;
    if (record->retimed)
        study_record_say(
            recording, false,
            "motion.samples: the times, rounded to %.3g%s, are read as equal steps of %.6g%s",
            record->time_step, time, record->interval, time);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) say_rounding(recording, c);
    if (recording->smoothing.kind == STUDY_SMOOTH_CUTOFF &&
        recording->smoothing.cutoff > 0.5 / record->interval)
        study_record_say(
            recording, false,
            "motion.cutoff: %.6g %s is above half of the rows' frequency, %.6g; it smooths almost "
            "nothing",
            recording->smoothing.cutoff, frequency_unit(recording, frequency),
            0.5 / record->interval);
}
