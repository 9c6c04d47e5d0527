/* The summary of forces and simulate for reading: two tables over the legs, then what holds for the run. */
#include "cli/run/run_report.h"
#include "cli/common/talk.h"

#include "cli/common/leg_table.h"
#include "cli/common/scale.h"
#include "cli/run/limits_used.h"

#include <math.h>
#include <string.h>

/* a step of the stepper may be this long for a decay of rate 1, (step-8) */
static const double stiff_reach = 6.1;

static const scaled_member leg_members[] = {
    SCALED(gough_leg_summary, length_min, LENGTH), SCALED(gough_leg_summary, length_max, LENGTH),
    SCALED(gough_leg_summary, speed, SPEED),       SCALED(gough_leg_summary, force_min, FORCE),
    SCALED(gough_leg_summary, force_max, FORCE),   SCALED(gough_leg_summary, rms_force, FORCE),
    SCALED(gough_leg_summary, power_min, POWER),   SCALED(gough_leg_summary, power_max, POWER),
    SCALED(gough_leg_summary, energy, ENERGY),     SCALED(gough_leg_summary, swing_base, ANGLE),
    SCALED(gough_leg_summary, swing_top, ANGLE)};

static const scaled_member summary_members[] = {
    SCALED(gough_summary, first_time, TIME),      SCALED(gough_summary, last_time, TIME),
    SCALED(gough_summary, condition_time, TIME),  SCALED(gough_summary, between_rows, LENGTH),
    SCALED(gough_summary, drawing_step, TIME),    SCALED(gough_summary, position_deviation, LENGTH),
    SCALED(gough_summary, angle_deviation, ANGLE)};

static const scaled_member crossing_members[] = {SCALED(gough_crossing, enter, TIME),
                                                 SCALED(gough_crossing, leave, TIME),
                                                 SCALED(gough_crossing, worst_time, TIME)};

static const scaled_member report_members[] = {SCALED(run_report, statistics.stiff_time, TIME),
                                               SCALED(run_report, statistics.stiff_rate, RATE),
                                               SCALED(run_report, stroke, LENGTH)};

double limit_factor(gough_cause cause, const gough_units *u) {
    return gough_unit_factor(u, cause == GOUGH_END_LEG_SPEED   ? GOUGH_UNIT_SPEED
                                : cause == GOUGH_END_LEG_FORCE ? GOUGH_UNIT_FORCE
                                                               : GOUGH_UNIT_LENGTH);
}

static void scale_crossing(gough_crossing *crossing, const gough_units *u) {
    SCALE(crossing, crossing_members, u);
    crossing->worst *= limit_factor(crossing->cause, u);
}

/* time and limit in the output's units, and the sentence with them */
static void scale_end(gough_end *end, const gough_units *u) {
    const gough_units *unit = u;
    end->time *= gough_unit_factor(u, GOUGH_UNIT_TIME);
    end->limit *= limit_factor(end->cause, u);
    gough_end_say(end, unit_word(unit, GOUGH_UNIT_LENGTH), unit_word(unit, GOUGH_UNIT_SPEED),
                  unit_word(unit, GOUGH_UNIT_FORCE), unit_word(unit, GOUGH_UNIT_TIME));
}

/* "… from t = 3 to 4 s" in place of "… at t = 3 s": of forces, which go on beyond a limit */
static void say_span(gough_end *end, const run_report *report) {
    const gough_units *u = &report->units;
    const char *unit = unit_word(u, GOUGH_UNIT_TIME);
    const crossing_list *crossings = &report->crossings;
    char *at = strstr(end->message, " at t = ");
    double leave = 0;
    gough_error said;
    if (!at || !end->legs || crossings->count == 0) return;
    for (size_t i = 0; i < crossings->count; i++) {
        const gough_crossing *c = &crossings->list[i];
        if (c->cause == end->cause && (end->legs >> (c->leg - 1) & 1) &&
            c->enter <= report->end.time * (1 + 1e-6))
            leave = fmax(leave, c->leave);
    }
    char until[64] = "the end", more[64] = "";
    if (isfinite(leave))
        snprintf(until, sizeof until, "%.6g%s", leave * gough_unit_factor(u, GOUGH_UNIT_TIME),
                 unit);
    if (crossings->count > 1)
        snprintf(more, sizeof more, "; limits are exceeded %zu times", crossings->count);
    gough_fail(&said, GOUGH_ERROR_NUMERICAL, "%.*s from t = %.6g%s to %s%s",
               (int)(at - end->message), end->message, end->time, isfinite(leave) ? "" : unit,
               until, more);
    snprintf(end->message, sizeof end->message, "%.*s", (int)sizeof end->message - 1, said.message);
}

gough_end run_report_end(const run_report *report) {
    gough_end end = report->end;
    scale_end(&end, &report->units);
    say_span(&end, report);
    end.time = report->end.time;
    end.limit = report->end.limit;
    return end;
}

/* Without a row there is no number, not a 0. */
static void leave_blank(gough_summary *s) {
    const gough_leg_summary blank = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    for (int i = 0; i < GOUGH_LEGS; i++) s->leg[i] = blank;
    s->condition = s->condition_time = s->drift = NAN;
    s->position_deviation = s->angle_deviation = NAN;
}

void run_report_scale(run_report *report) {
    const gough_units *u = &report->units;
    gough_summary *s = &report->summary;
    if (s->rows == 0) leave_blank(s);
    for (int i = 0; i < GOUGH_LEGS; i++) SCALE(&s->leg[i], leg_members, u);
    SCALE(s, summary_members, u);
    scale_end(&report->end, u);
    for (size_t i = 0; i < report->crossings.count; i++)
        scale_crossing(&report->crossings.list[i], u);
    report->stroke[0] = report->study->model->machine.platform.length_min;
    report->stroke[1] = report->study->model->machine.platform.length_max;
    SCALE(report, report_members, u);
}

static double peak(double least, double greatest) { return fmax(fabs(least), fabs(greatest)); }

/* Share of the stroke that a leg uses, in percent; NaN where the legs' lengths are not limited on both sides. */
static double stroke_share(const run_report *report, double used) {
    const double *stroke = report->stroke;
    if (!(stroke[0] > 0) || !isfinite(stroke[1]) || !(stroke[1] > stroke[0])) return NAN;
    return 100 * used / (stroke[1] - stroke[0]);
}

/* A column of its own: its name over its unit, or its name alone. */
static table_column lone_column(const char *name, const table_heading *unit) {
    return *unit->text ? (table_column){name, unit->text, {0}, 5}
                       : (table_column){"", name, {0}, 5};
}

static void print_strokes(FILE *stream, const run_report *report, const gough_units *unit) {
    const table_heading length = heading_of("length", unit_word(unit, GOUGH_UNIT_LENGTH));
    const table_heading speed = heading_of("", unit_word(unit, GOUGH_UNIT_SPEED));
    table_column column[] = {{length.text, "least", {0}, 6},    {length.text, "greatest", {0}, 6},
                             {length.text, "used", {0}, 6},     {"stroke", "used %", {0}, 3},
                             lone_column("peak speed", &speed), {"swing [deg] at", "base", {0}, 4},
                             {"swing [deg] at", "top", {0}, 4}, {0}};
    enum { LEAST, GREATEST, USED, SHARE, SPEED, BASE, TOP, COLUMNS };
    for (int c = 0; c < COLUMNS; c++) column[c].value[GOUGH_LEGS] = c == LEAST ? INFINITY : 0;
    for (int i = 0; i < GOUGH_LEGS; i++) {
        const gough_leg_summary *leg = &report->summary.leg[i];
        const double used = leg->length_max - leg->length_min;
        const double row[COLUMNS] = {
            leg->length_min, leg->length_max, used,          stroke_share(report, used),
            leg->speed,      leg->swing_base, leg->swing_top};
        for (int c = 0; c < COLUMNS; c++) {
            double *all = &column[c].value[GOUGH_LEGS];
            column[c].value[i] = row[c];
            *all = c == LEAST ? fmin(*all, row[c]) : fmax(*all, row[c]);
        }
    }
    const bool limited = isfinite(stroke_share(report, 0));
    if (!limited)
        for (int c = SHARE; c < COLUMNS; c++) column[c] = column[c + 1];
    table_print(stream, column, true);
    if (limited)
        fprintf(stream, "  stroke      %.6g%s available, from %.6g to %.6g%s\n",
                report->stroke[1] - report->stroke[0], unit_word(unit, GOUGH_UNIT_LENGTH),
                report->stroke[0], report->stroke[1], unit_word(unit, GOUGH_UNIT_LENGTH));
}

/* time integrals are right to this share of the largest power times the time */
static const double INTEGRAL_ERROR = 1e-8;

static void print_loads(FILE *stream, const run_report *report, const gough_units *unit) {
    const table_heading force = heading_of("force", unit_word(unit, GOUGH_UNIT_FORCE)),
                        power = heading_of("power", unit_word(unit, GOUGH_UNIT_POWER));
    const table_heading energy = heading_of("", unit_word(unit, GOUGH_UNIT_ENERGY));
    table_column column[] = {{force.text, "least", {0}, 5},  {force.text, "greatest", {0}, 5},
                             {force.text, "peak", {0}, 5},   {force.text, "RMS", {0}, 5},
                             {power.text, "least", {0}, 5},  {power.text, "greatest", {0}, 5},
                             lone_column("energy", &energy), {0}};
    enum { LEAST, GREATEST, PEAK, RMS, POWER_LEAST, POWER_GREATEST, ENERGY, COLUMNS };
    for (int c = 0; c < COLUMNS; c++)
        column[c].value[GOUGH_LEGS] = c == LEAST || c == POWER_LEAST ? INFINITY : -INFINITY;
    column[ENERGY].value[GOUGH_LEGS] = 0;
    for (int i = 0; i < GOUGH_LEGS; i++) {
        const gough_leg_summary *leg = &report->summary.leg[i];
        const double row[COLUMNS] = {
            leg->force_min, leg->force_max, peak(leg->force_min, leg->force_max),
            leg->rms_force, leg->power_min, leg->power_max,
            leg->energy};
        for (int c = 0; c < COLUMNS; c++) {
            double *all = &column[c].value[GOUGH_LEGS];
            column[c].value[i] = row[c];
            if (c == ENERGY)
                *all += row[c];
            else if (c == LEAST || c == POWER_LEAST)
                *all = fmin(*all, row[c]);
            else
                *all = fmax(*all, row[c]);
        }
    }
    /* where works cancel, what is left is the error of the integrals */
    const double span = report->summary.last_time - report->summary.first_time;
    double most = 0;
    for (int i = 0; i < GOUGH_LEGS; i++)
        most = fmax(most, peak(report->summary.leg[i].power_min, report->summary.leg[i].power_max));
    for (int i = 0; i <= GOUGH_LEGS; i++) {
        double *net = &column[ENERGY].value[i];
        if (fabs(*net) < INTEGRAL_ERROR * most * span) *net = 0;
    }
    table_print(stream, column, true);
}

static bool any_formula(const gough_formula *formula, int count) {
    bool any = false;
    for (int i = 0; i < count; i++) any = any || !gough_formula_is_zero(&formula[i]);
    return any;
}

/* Forces along a program are those of the program alone: which disturbances of the study they leave out. */
static void print_left_out(FILE *stream, const gough_disturbance *d) {
    const gough_noise *noise = &d->noise;
    const struct {
        const char *name;
        bool present;
    } part[] = {{"leg_force", any_formula(d->leg_force, GOUGH_LEGS)},
                {"vertical_force", any_formula(&d->vertical_force, 1)},
                {"force", any_formula(d->force, 3)},
                {"moment", any_formula(d->moment, 3)},
                {"noise", noise->leg_force > 0 || noise->force > 0 || noise->moment > 0}};
    int named = 0;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++)
        if (part[i].present)
            fprintf(stream, "%s%s", named++ ? ", " : "  left out    disturbance: ", part[i].name);
    if (named)
        fprintf(stream, "\n              (these are the program's forces alone; gough simulate "
                        "includes disturbances)\n");
}

/* legs that move less than this share of their length are at rest: errors of the steps */
static const double AT_REST = 1e-9;

/* Rows that miss more than a twentieth of the longest stroke do not draw the motion. */
static void print_between(FILE *stream, const gough_summary *s, const gough_units *unit) {
    double stroke = 0, length = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        stroke = fmax(stroke, s->leg[v].length_max - s->leg[v].length_min);
        length = fmax(length, s->leg[v].length_max);
    }
    if (!(stroke > AT_REST * length)) return;
    if (s->rows < 2 || !(s->between_rows > 0.05 * stroke) || !(s->drawing_step > 0)) return;
    /* rounded down to one digit */
    const double decade = pow(10, floor(log10(s->drawing_step)));
    const double step = floor(s->drawing_step / decade) * decade;
    fprintf(stream,
            "  rows        too far apart to draw the motion: between two rows leg %d moves up to\n"
            "              %.4g%s beyond both; to draw it, set simulation.output_step to %.3g%s or "
            "less\n",
            s->between_leg, s->between_rows, unit_word(unit, GOUGH_UNIT_LENGTH), step,
            unit_word(unit, GOUGH_UNIT_TIME));
}

static void print_steps(FILE *stream, const gough_statistics *s, bool adaptive) {
    fprintf(stream, "  steps       %lld", s->steps);
    if (adaptive) fprintf(stream, ", and %lld rejected", s->rejected);
    fprintf(stream, "; %lld evaluations of the equations of motion\n", s->evaluations);
}

void remark_stiffness(const char *verb, const run_report *report) {
    const gough_statistics *s = &report->statistics;
    const char *unit = unit_word(&report->units, GOUGH_UNIT_TIME);
    if (!(s->stiff_rate > 0)) return;
    remark(verb,
           "the loop is stiff from t = %.4g%s on: its fastest mode, with |lambda| about %.3g%s%s, "
           "limits "
           "steps to %.2g%s however large the tolerance (%lld steps in all); less control.damping "
           "or control.stiffness allows longer ones",
           s->stiff_time, unit, s->stiff_rate, *unit ? " 1/" : "", *unit ? unit + 1 : "",
           stiff_reach / s->stiff_rate, unit, s->steps);
}

static void print_end(FILE *stream, const run_report *report, const gough_units *unit) {
    const gough_end *end = &report->end;
    fprintf(stream, "  end         ");
    if (end->cause == GOUGH_END_DONE)
        fprintf(stream, "the whole duration, t = %.6g%s\n", end->time,
                unit_word(unit, GOUGH_UNIT_TIME));
    else if (!report->simulated && report->crossings.count)
        fprintf(stream, "t = %.6g%s; limits are exceeded, first at t = %.6g%s\n",
                report->summary.last_time, unit_word(unit, GOUGH_UNIT_TIME), end->time,
                unit_word(unit, GOUGH_UNIT_TIME));
    else
        fprintf(stream, "%s\n", end->message);
}

void run_report_print(FILE *stream, const run_report *report) {
    const gough_summary *s = &report->summary;
    const gough_units *unit = &report->units;
    print_title(stream, report->study->title);
    fprintf(stream, "%s: ",
            report->simulated ? "Motion under control and disturbance"
                              : "Forces along the program");
    if (s->rows > 0)
        fprintf(stream, "%zu rows, t = %.6g to %.6g%s\n", s->rows, s->first_time, s->last_time,
                unit_word(unit, GOUGH_UNIT_TIME));
    else
        fprintf(stream, "no rows\n");
    fprintf(stream, "%s\n\n", units_sentence(report->study, &report->units));
    if (s->rows > 0) {
        print_strokes(stream, report, unit);
        fputc('\n', stream);
        print_loads(stream, report, unit);
        fputc('\n', stream);
        fprintf(stream,
                "  condition   at most %.4g, at t = %.6g%s (1 is best, 1e8 counts as singular)\n",
                s->condition, s->condition_time, unit_word(unit, GOUGH_UNIT_TIME));
    }
    if (report->simulated && s->rows > 0) {
        fprintf(stream, "  deviation   at most %.4g%s and %.4g deg from the program\n",
                s->position_deviation, unit_word(unit, GOUGH_UNIT_LENGTH), s->angle_deviation);
        fprintf(stream,
                "  drift       at most %.2g (violation of the constraints before projection)\n",
                s->drift);
    }
    fprintf(stream, "  legs        massless in this model: add %s\n",
            report->study->model->machine.gravity_magnitude > 0
                ? "the forces of their own weight and inertia"
                : "the forces of their own inertia");
    print_between(stream, s, unit);
    if (!report->simulated) print_left_out(stream, &report->study->model->disturbance);
    if (report->simulated)
        print_steps(stream, &report->statistics, !(report->study->simulation.step > 0));
    print_end(stream, report, unit);
    limits_print(stream, report, report->all);
    for (size_t i = 0; i < report->outputs; i++)
        if (strcmp(report->output[i], "-") != 0)
            print_line(stream, "  table       %s", report->output[i]);
}
