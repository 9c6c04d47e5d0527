/* The summary of forces and simulate for reading: two tables over the legs, then what holds for the run. */
#include "cli/run/run_report.h"
#include "cli/common/talk.h"

#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/run/leg_quantities.h"
#include "cli/run/limits_used.h"

#include <math.h>
#include <string.h>

/* a step of the stepper may be this long for a decay of rate 1, (step-8) */
static const double stiff_reach = 6.1;

static const scaled_member summary_members[] = {SCALED(gough_summary, first_time, TIME),
                                                SCALED(gough_summary, last_time, TIME),
                                                SCALED(gough_summary, condition_time, TIME),
                                                SCALED(gough_summary, between_rows, LENGTH),
                                                SCALED(gough_summary, drawing_step, TIME),
                                                SCALED(gough_summary, position_deviation, LENGTH),
                                                SCALED(gough_summary, angle_deviation, ANGLE),
                                                SCALED(gough_summary, external_work, ENERGY)};

static const scaled_member crossing_members[] = {SCALED(gough_crossing, enter, TIME),
                                                 SCALED(gough_crossing, leave, TIME),
                                                 SCALED(gough_crossing, worst_time, TIME)};

static const scaled_member report_members[] = {
    SCALED(run_report, statistics.stiff_time, TIME),
    SCALED(run_report, statistics.stiff_rate, RATE), SCALED(run_report, stroke, LENGTH),
    SCALED(run_report, holds_from, FORCE), SCALED(run_report, holds_to, FORCE)};

static void scale_crossing(gough_crossing *crossing, const gough_units *u) {
    SCALE(crossing, crossing_members, u);
    crossing->limit *= gough_unit_factor(u, limit_unit(crossing->cause, crossing->component));
    crossing->worst *= gough_unit_factor(u, limit_unit(crossing->cause, crossing->component));
}

/* time and limit in the output's units, and the sentence with them */
static void scale_end(gough_end *end, const gough_units *u) {
    const gough_end_words words = limit_words(u);
    end_scale(end, u);
    gough_end_say(end, &words);
}

/* "… from t = 3 to 4 s" in place of "… at t = 3 s": of forces, which go on beyond a limit */
static void say_span(gough_end *end, const run_report *report) {
    const gough_units *u = &report->units;
    const char *unit = unit_word(u, GOUGH_UNIT_TIME);
    const crossing_list *crossings = &report->crossings;
    char *at = strstr(end->message, " at t = ");
    double leave = 0;
    gough_error said;
    if (!at || !(end->legs || end->component) || crossings->count == 0) return;
    for (size_t i = 0; i < crossings->count; i++) {
        const gough_crossing *c = &crossings->list[i];
        const bool same = c->leg ? end->legs >> (c->leg - 1) & 1 : c->component == end->component;
        if (c->cause == end->cause && c->least == end->least && same &&
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
    double *value = (double *)(void *)s->leg;
    const size_t count = GOUGH_LEGS * (sizeof s->leg[0] / sizeof(double));
    for (size_t i = 0; i < count; i++) value[i] = NAN;
    s->condition = s->condition_time = s->drift = NAN;
    s->position_deviation = s->angle_deviation = s->external_work = NAN;
}

/* What holds the legs at rest at home, under the external loads as they are at t = 0. */
static void find_holding(run_report *report) {
    const gough_machine *machine = &report->study->model->machine;
    const gough_state home = gough_state_home(machine);
    gough_wrench known;
    double force[GOUGH_LEGS];
    if (gough_external_wrench(machine, &home, 0, &known) == GOUGH_OK &&
        gough_holding_forces(machine, &home, &known, force, report->holds_from, report->holds_to) ==
            GOUGH_OK)
        return;
    for (int i = 0; i < GOUGH_LEGS; i++) report->holds_from[i] = report->holds_to[i] = NAN;
}

/* least and greatest values of the platform's components, by order of derivative */
static void scale_components(gough_summary *s, const gough_units *u) {
    static const gough_cause cause[3] = {GOUGH_END_PLATFORM_POSE, GOUGH_END_PLATFORM_SPEED,
                                         GOUGH_END_PLATFORM_ACCELERATION};
    for (int order = 0; order < 3; order++)
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            for (int side = 0; side < 2; side++)
                s->component[order][c][side] *=
                    gough_unit_factor(u, limit_unit(cause[order], c + 1));
}

void run_report_scale(run_report *report) {
    const gough_units *u = &report->units;
    const gough_model *model = report->study->model;
    const gough_limits limits = gough_limits_of(&model->machine, &model->motion);
    gough_summary *s = &report->summary;
    if (s->rows == 0) leave_blank(s);
    for (int i = 0; i < GOUGH_LEGS; i++) leg_scale(&s->leg[i], u);
    SCALE(s, summary_members, u);
    scale_components(s, u);
    scale_end(&report->end, u);
    for (size_t i = 0; i < report->crossings.count; i++)
        scale_crossing(&report->crossings.list[i], u);
    memcpy(report->stroke, limits.length, sizeof report->stroke);
    find_holding(report);
    SCALE(report, report_members, u);
}

/* The stroke that the legs have, if it is limited on both sides. */
static void print_stroke(FILE *stream, const run_report *report) {
    const char *unit = unit_word(&report->units, GOUGH_UNIT_LENGTH);
    bool alike = true, limited = false;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *stroke = report->stroke[v];
        limited = limited || isfinite(leg_stroke_share(report, &report->summary.leg[v]));
        for (int side = 0; side < 2; side++)
            alike = alike && nearly_same(stroke[side], report->stroke[0][side]);
    }
    if (!limited) return;
    for (int v = 0; v < (alike ? 1 : GOUGH_LEGS); v++) {
        const double *stroke = report->stroke[v];
        fprintf(stream, "%s", v ? "              " : "  stroke      ");
        if (!alike) fprintf(stream, "leg %d: ", v + 1);
        fprintf(stream, "%.6g%s available, from %.6g to %.6g%s\n", stroke[1] - stroke[0], unit,
                stroke[0], stroke[1], unit);
    }
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

/* Whether the loads of the legs' joints are others than the drive forces. */
static bool legs_are_heavy_or_rough(const run_report *report) {
    const gough_platform *p = &report->study->model->machine.platform;
    bool rough = false;
    for (int i = 0; i < GOUGH_LEGS; i++)
        rough = rough || p->friction.viscous[i] > 0 || p->friction.coulomb[i] > 0 ||
                report->study->model->machine.breakaway[i] > 0 || p->friction.efficiency[i] < 1;
    return rough || p->legs_have_mass;
}

/* The legs whose drives a limit of `actuators` held back, for how long and since when. */
static void print_saturated(FILE *stream, const run_report *report) {
    const char *time = unit_word(&report->units, GOUGH_UNIT_TIME), *before = "";
    char text[GOUGH_LEGS * 80] = "";
    for (int i = 0; i < GOUGH_LEGS; i++) {
        const gough_leg_summary *leg = &report->summary.leg[i];
        if (isnan(leg->saturated_at)) continue;
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "%sleg %d for %.3g %% of the time, first at t = %.6g%s", before, i + 1,
                 100 * leg->saturated, leg->saturated_at, time);
        before = "; ";
    }
    if (*text) print_paragraph(stream, "  saturated   ", 14, "%s", text);
}

/* Below what share of their scale (the longest leg at home, a radian) deviations are only errors of the run. The page has the same
 * in web/src/data.js: errors reach a hundred times the tolerance of adaptive steps; of fixed steps only rounding is known. */
static double noise_of(const run_report *report) {
    const gough_simulation *o = &report->study->simulation;
    const bool adaptive = o->method == GOUGH_DOP853 && !(o->step > 0);
    return fmin(fmax(adaptive ? 100 * o->tolerance : 0, 1e-12), 1e-6);
}

/* "at most 0.0123 m", or "below 3e-09 m" where a number would be an error of the run */
static const char *say_deviation(const run_report *report, double value, double scale,
                                 gough_unit unit, char text[60]) {
    const char *word = unit_word(&report->units, unit);
    const double noise = noise_of(report) * scale, power = pow(10, floor(log10(noise)));
    if (value > noise)
        snprintf(text, 60, "at most %.4g%s", value, word);
    else
        snprintf(text, 60, "below %.1g%s", ceil(noise / power * (1 - 1e-12)) * power, word);
    return text;
}

static void print_deviation(FILE *stream, const run_report *report) {
    const gough_machine *machine = &report->study->model->machine;
    double length = 0;
    char position[60], angle[60];
    for (int i = 0; i < GOUGH_LEGS; i++) length = fmax(length, machine->home_length[i]);
    say_deviation(report, report->summary.position_deviation,
                  length * gough_unit_factor(&report->units, GOUGH_UNIT_LENGTH), GOUGH_UNIT_LENGTH,
                  position);
    say_deviation(report, report->summary.angle_deviation,
                  gough_unit_factor(&report->units, GOUGH_UNIT_ANGLE), GOUGH_UNIT_ANGLE, angle);
    /* "at most 1 m and 2 deg" */
    const char *second = strncmp(position, "at", 2) == 0 && strncmp(angle, "at", 2) == 0
                             ? angle + strlen("at most ")
                             : angle;
    fprintf(stream, "  deviation   %s and %s from the program\n", position, second);
}

/* The largest error that a sampled controller found, and the leg and time of it. */
static void print_samples(FILE *stream, const run_report *report) {
    const gough_leg_summary *leg = report->summary.leg;
    int worst = 0;
    for (int i = 1; i < GOUGH_LEGS; i++)
        if (leg[i].sample_error > leg[worst].sample_error) worst = i;
    if (isnan(leg[worst].sample_error)) return;
    fprintf(stream,
            "  samples     the controller found errors of length up to %.4g%s (leg %d at t = "
            "%.6g%s)\n",
            leg[worst].sample_error, unit_word(&report->units, GOUGH_UNIT_LENGTH), worst + 1,
            leg[worst].sample_error_at, unit_word(&report->units, GOUGH_UNIT_TIME));
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
    fprintf(stream, "%s\n\n", units_sentence(report->study, &report->units).text);
    if (s->rows > 0) {
        leg_table_print(stream, report, LEG_MOTION);
        print_stroke(stream, report);
        fputc('\n', stream);
        leg_table_print(stream, report, LEG_LOADS);
        fputc('\n', stream);
        if (legs_are_heavy_or_rough(report)) {
            leg_table_print(stream, report, LEG_JOINTS);
            fputc('\n', stream);
        }
        fprintf(stream,
                "  condition   at most %.4g, at t = %.6g%s (1 is best, 1e8 counts as singular)\n",
                s->condition, s->condition_time, unit_word(unit, GOUGH_UNIT_TIME));
    }
    if (report->simulated && s->rows > 0) {
        print_deviation(stream, report);
        fprintf(stream,
                "  drift       at most %.2g (violation of the constraints before projection)\n",
                s->drift);
    }
    if (report->simulated && s->rows > 0) print_samples(stream, report);
    if (report->simulated && s->rows > 0) print_saturated(stream, report);
    if (!report->study->model->machine.platform.legs_have_mass)
        fprintf(stream, "  legs        massless in this model: add %s\n",
                report->study->model->machine.gravity_magnitude > 0
                    ? "the forces of their own weight and inertia"
                    : "the forces of their own inertia");
    if (report->study->model->machine.externals > 0 && s->rows > 0)
        fprintf(stream, "  external    the external loads did %.5g%s of work\n", s->external_work,
                unit_word(unit, GOUGH_UNIT_ENERGY));
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
