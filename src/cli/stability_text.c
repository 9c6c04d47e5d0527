/* Stability for reading: eigenvalues at rest with what moves, thresholds of G, multipliers about the program, verdicts. */
#include <math.h>
#include <string.h>

#include "cli/command.h"
#include "cli/stability.h"
#include "cli/summary.h"

static const double DEGREES = 57.295779513082320877;
static const double TENFOLD = 2.302585092994045684; /* log 10 */
static const double TWO_PI = 6.283185307179586477;

/* growth by no more than this counts as none, as in gough_rest and gough_floquet */
static const double tolerance = 1e-7;

/* ---- numbers of one value together ------------------------------------------------------------------------------- */

/* What a table of eigenvalues or multipliers is made of. */
typedef struct mode_value {
    double value[2];
    const gough_mode *mode;
} mode_value;

typedef struct value_group {
    double value[2];                      /* not below the real axis */
    const gough_mode *mode[GOUGH_LINEAR]; /* of the values alike */
    int count;
} value_group;

static bool alike(const value_group *group, const mode_value *one, double scale) {
    const double near = 1e-6 * scale;
    return fabs(group->value[0] - one->value[0]) <= near &&
           fabs(group->value[1] - one->value[1]) <= near &&
           strcmp(group->mode[0]->name, one->mode->name) == 0;
}

/* Groups of equal values; of conjugates the upper one stands for both. */
static int group_values(const mode_value value[GOUGH_LINEAR], bool relative,
                        value_group group[GOUGH_LINEAR]) {
    double scale = 0;
    int groups = 0;
    for (int i = 0; i < GOUGH_LINEAR; i++)
        scale = fmax(scale, hypot(value[i].value[0], value[i].value[1]));
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        const double own = relative ? hypot(value[i].value[0], value[i].value[1]) : scale;
        int g = 0;
        if (value[i].value[1] < -1e-9 * own) continue;
        while (g < groups && !alike(&group[g], &value[i], own)) g++;
        if (g == groups) {
            group[groups++] = (value_group){.value = {value[i].value[0], value[i].value[1]}};
            /* round-off beside numbers of size 1 is no growth and no frequency */
            for (int k = 0; k < 2; k++)
                if (fabs(value[i].value[k]) < 1e-9 * own) group[g].value[k] = 0;
        }
        group[g].mode[group[g].count++] = value[i].mode;
    }
    return groups;
}

/* "yaw", "sway–tilt ×2" */
static void name_group(const value_group *group, char name[GOUGH_MODE_NAME + 16]) {
    if (group->count > 1)
        snprintf(name, GOUGH_MODE_NAME + 16, "%s ×%d", group->mode[0]->name, group->count);
    else
        snprintf(name, GOUGH_MODE_NAME + 16, "%s", group->mode[0]->name);
}

/* Width of the column of names. */
static int name_width(const value_group *group, int groups) {
    int widest = 4;
    for (int g = 0; g < groups; g++) {
        char name[GOUGH_MODE_NAME + 16];
        int width = 0;
        name_group(&group[g], name);
        for (const char *at = name; *at; at++) width += ((unsigned char)*at & 0xC0) != 0x80;
        if (width > widest) widest = width;
    }
    return widest + 2;
}

static void print_name(FILE *stream, const value_group *group, int width) {
    char name[GOUGH_MODE_NAME + 16];
    name_group(group, name);
    fprintf(stream, "    ");
    stability_pad(stream, name, width);
}

static void print_moves(FILE *stream, const stability_report *report, const value_group *group) {
    char words[MODE_WORDS];
    stability_mode_words(group->mode, group->count, report->arm,
                         unit_words_of(&report->units)->length, words);
    fprintf(stream, "   %s\n", words);
}

/* A number, or a dash where it says nothing. */
static void print_cell(FILE *stream, double value) {
    if (isfinite(value))
        fprintf(stream, "%18.6g", value);
    else
        fprintf(stream, "%18s", "-");
}

static void print_heading(FILE *stream, const char *what, const char *unit) {
    const table_heading heading = heading_of(what, unit);
    fprintf(stream, "%18s", heading.text);
}

/* ---- at rest ----------------------------------------------------------------------------------------------------- */

static void print_eigenvalues(FILE *stream, const stability_report *report,
                              const gough_rest *rest) {
    const unit_words *unit = unit_words_of(&report->units);
    mode_value value[GOUGH_LINEAR];
    value_group group[GOUGH_LINEAR];
    for (int i = 0; i < GOUGH_LINEAR; i++)
        value[i] = (mode_value){{rest->eigenvalue[i].value[0], rest->eigenvalue[i].value[1]},
                                &rest->eigenvalue[i].mode};
    const int groups = group_values(value, false, group), width = name_width(group, groups);
    fprintf(stream, "  Deviations go as exp(lambda t): the twelve lambda, conjugates as one\n    ");
    stability_pad(stream, "mode", width);
    print_heading(stream, "growth rate", *unit->time ? " 1/s" : "");
    print_heading(stream, "frequency", *unit->time ? " rad/s" : "");
    print_heading(stream, "tenfold in", unit->time);
    print_heading(stream, "period", unit->time);
    fprintf(stream, "   moves\n");
    for (int g = 0; g < groups; g++) {
        const double rate = group[g].value[0], frequency = group[g].value[1];
        print_name(stream, &group[g], width);
        print_cell(stream, rate);
        print_cell(stream, frequency);
        print_cell(stream, TENFOLD / fabs(rate));
        print_cell(stream, TWO_PI / frequency);
        print_moves(stream, report, &group[g]);
    }
}

static double least_gain(const double gain[GOUGH_LEGS]) {
    double least = INFINITY;
    for (int i = 0; i < GOUGH_LEGS; i++) least = fmin(least, gain[i]);
    return least;
}

static void print_thresholds(FILE *stream, const stability_report *report, const gough_rest *rest) {
    const unit_words *unit = unit_words_of(&report->units);
    const double stiffness_unit = report->units.mass / (report->units.time * report->units.time);
    const double *gain = report->study->model->control.stiffness;
    fprintf(stream, "  Least stiffness G, the same in all legs, from which each mode holds\n");
    for (int i = 0, next; i < 6; i = next) {
        const gough_threshold *t = &rest->threshold[i];
        next = i + 1;
        while (next < 6 &&
               fabs(rest->threshold[next].stiffness - t->stiffness) <= 1e-9 * fabs(t->stiffness) &&
               strcmp(rest->threshold[next].mode.name, t->mode.name) == 0)
            next++;
        fprintf(stream, "    ");
        stability_pad(stream, t->mode.name, 20);
        fprintf(stream, "%12.6g%s", t->stiffness, unit->stiffness);
        if (next - i > 1) fprintf(stream, "   (%d modes)", next - i);
        if (!(t->stiffness > 0)) fprintf(stream, "   needs no feedback");
        fprintf(stream, "\n");
    }
    fprintf(stream, "    %-20s%12.6g%s\n", "this study", least_gain(gain) / stiffness_unit,
            unit->stiffness);
}

/* (stab-5), where it holds. */
static void print_trace(FILE *stream, const stability_report *report, const gough_rest *rest) {
    const unit_words *unit = unit_words_of(&report->units);
    if (!(rest->trace < 0))
        fprintf(stream,
                "  The translational stiffness of constant leg forces has the trace %.6g%s, which "
                "proves no growth.\n",
                rest->trace, unit->stiffness);
    else if (isfinite(rest->trace_theorem))
        fprintf(
            stream,
            "  Without feedback some mode always grows: the translational stiffness of constant "
            "leg forces has the\n  trace -2Mg/h = %.6g%s < 0, wherever the joints in their two "
            "level planes.\n",
            rest->trace_theorem, unit->stiffness);
    else
        fprintf(
            stream,
            "  Without feedback some mode always grows: the translational stiffness of constant "
            "leg forces has the\n  trace %.6g%s < 0.\n",
            rest->trace, unit->stiffness);
}

static void print_rest_verdict(FILE *stream, const stability_report *report,
                               const gough_rest *rest) {
    const unit_words *unit = unit_words_of(&report->units);
    if (!rest->stable)
        fprintf(stream, "  Unstable: %s grows tenfold in %.4g%s.\n", rest->eigenvalue[0].mode.name,
                TENFOLD / rest->growth, unit->time);
    else if (report->damped)
        fprintf(stream, "  Stable: every deviation dies out, the slowest to a tenth in %.4g%s.\n",
                TENFOLD / fmax(-rest->growth, 0), unit->time);
    else
        fprintf(
            stream,
            "  Stable in that nothing grows; without damping (D = 0) nothing dies out either.\n");
}

/* "heave 0.1, yaw 10 deg" */
static void print_pose(FILE *stream, const double pose[GOUGH_COMPONENTS], const unit_words *unit) {
    const char *joint = "";
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (!(fabs(pose[c]) > 0)) continue;
        fprintf(stream, "%s%s %.6g%s", joint, gough_component_name(c), pose[c],
                c < GOUGH_ROLL ? unit->length : " deg");
        joint = ", ";
    }
    if (!*joint) fprintf(stream, "home");
}

/* Where the springs carry the load. */
static void print_sag(FILE *stream, const stability_report *report, const double position[3]) {
    double shown[3];
    for (int k = 0; k < 3; k++)
        shown[k] = fabs(position[k]) < 1e-12 * report->arm ? 0.0 : position[k];
    fprintf(
        stream,
        "  Without feed-forward the springs carry the load: it rests with the top at %.6g, %.6g, "
        "%.6g%s\n",
        shown[0], shown[1], shown[2], unit_words_of(&report->units)->length);
}

static void print_rest(FILE *stream, const stability_report *report, const gough_rest *rest,
                       const double pose[GOUGH_COMPONENTS], const char *where) {
    const unit_words *unit = unit_words_of(&report->units);
    fprintf(stream, "\nAt rest%s: ", where);
    print_pose(stream, pose, unit);
    fprintf(stream, "\n");
    if (!report->study->model->control.feedforward) print_sag(stream, report, rest->state.position);
    print_eigenvalues(stream, report, rest);
    print_thresholds(stream, report, rest);
    print_trace(stream, report, rest);
    fprintf(stream,
            "  Checked: the stiffness found is symmetric within %.1g of its largest element",
            rest->asymmetry);
    if (fabs(rest->trace_theorem) > 0)
        fprintf(stream, ",\n  its trace differs from the theorem's by %.1g of it",
                fabs(rest->trace - rest->trace_theorem) / fabs(rest->trace_theorem));
    fprintf(stream, ".\n");
    print_rest_verdict(stream, report, rest);
}

/* ---- about the program ------------------------------------------------------------------------------------------- */

static void print_multipliers(FILE *stream, const stability_report *report) {
    const gough_floquet *f = &report->floquet;
    mode_value value[GOUGH_LINEAR];
    value_group group[GOUGH_LINEAR];
    for (int i = 0; i < GOUGH_LINEAR; i++)
        value[i] = (mode_value){{f->multiplier[i].value[0], f->multiplier[i].value[1]},
                                &f->multiplier[i].mode};
    const int groups = group_values(value, true, group), width = name_width(group, groups);
    fprintf(
        stream,
        "  Deviations are multiplied by mu in each period: the twelve mu, conjugates as one\n    ");
    stability_pad(stream, "mode", width);
    fprintf(stream, "%18s%18s%18s   moves at the period's beginning\n", "|mu|", "angle [deg]",
            "growth rate");
    for (int g = 0; g < groups; g++) {
        const double size = hypot(group[g].value[0], group[g].value[1]);
        const double rate = log(size) / f->period;
        print_name(stream, &group[g], width);
        print_cell(stream, size);
        print_cell(stream, atan2(group[g].value[1], group[g].value[0]) * DEGREES);
        print_cell(stream, fabs(rate) * f->period < 1e-9 ? 0 : rate);
        print_moves(stream, report, &group[g]);
    }
}

static void print_floquet_checks(FILE *stream, const gough_floquet *f) {
    fprintf(stream, "  Checked: ");
    if (isfinite(f->pair_defect))
        fprintf(stream,
                "without damping the product of all mu is 1, here within %.1g, and they come in "
                "pairs mu, 1/mu,\n  here within %.1g; %zu steps.\n",
                f->determinant_defect, f->pair_defect, f->steps);
    else
        fprintf(stream,
                "the product of all mu is exp of the trace's integral, here within %.1g; %zu "
                "steps.\n",
                f->determinant_defect, f->steps);
}

static void print_floquet_verdict(FILE *stream, const stability_report *report) {
    const unit_words *unit = unit_words_of(&report->units);
    const gough_floquet *f = &report->floquet;
    const double tenfold = f->period * TENFOLD / fabs(log(f->growth));
    if (!f->stable)
        fprintf(stream, "  Unstable: %s grows %.6g-fold in each period, tenfold in %.4g%s.\n",
                f->multiplier[0].mode.name, f->growth, tenfold, unit->time);
    else if (f->growth < 1 - tolerance)
        fprintf(stream, "  Stable: every deviation dies out, the slowest to a tenth in %.4g%s.\n",
                tenfold, unit->time);
    else
        fprintf(stream, "  Bounded: nothing grows%s.\n",
                report->damped ? "" : "; without damping (D = 0) nothing dies out either");
}

static void print_program(FILE *stream, const stability_report *report) {
    const unit_words *unit = unit_words_of(&report->units);
    const gough_motion *motion = &report->study->model->motion;
    fprintf(stream, "\nAbout the program, of period %.9g%s, %s", report->floquet.period, unit->time,
            motion->period > 0 ? "as the study gives it" : "found from its formulas");
    if (report->floquet.start > 0)
        fprintf(stream, ", from t = %.4g%s on", report->floquet.start, unit->time);
    fprintf(stream, "\n");
    if (!report->study->model->control.feedforward)
        fprintf(stream,
                "  Without feed-forward the loop has a periodic motion of its own, %.4g%s from the "
                "program when the period begins:\n  it is judged here, and a run that starts far "
                "from it may not get there\n",
                report->sag, unit->length);
    print_multipliers(stream, report);
    print_floquet_checks(stream, &report->floquet);
    print_floquet_verdict(stream, report);
}

/* "50 N/m" or "4 to 6 N/m" */
static void print_gain(FILE *stream, const double gain[GOUGH_LEGS], double unit, const char *word) {
    double greatest = 0;
    const double least = least_gain(gain);
    for (int i = 0; i < GOUGH_LEGS; i++) greatest = fmax(greatest, gain[i]);
    if (greatest > least)
        fprintf(stream, "%.6g to %.6g%s", least / unit, greatest / unit, word);
    else
        fprintf(stream, "%.6g%s", least / unit, word);
}

void stability_print(FILE *stream, const stability_report *report) {
    const gough_control *control = &report->study->model->control;
    const gough_units *u = &report->units;
    const unit_words *unit = unit_words_of(u);
    print_title(stream, report->study->title);
    fprintf(stream, "Stability of the closed loop: %s, stiffness G = ",
            control->feedforward ? "the program's forces fed forward" : "no feed-forward");
    print_gain(stream, control->stiffness, u->mass / (u->time * u->time), unit->stiffness);
    fprintf(stream, ", damping D = ");
    print_gain(stream, control->damping, u->mass / u->time, unit->damping);
    fprintf(stream, "\n%s\n", units_sentence(report->study, u));
    print_rest(stream, report, &report->rest, report->pose, "");
    if (report->ends)
        print_rest(stream, report, &report->last, report->last_pose, " where the program ends");
    if (report->periodic)
        print_program(stream, report);
    else if (!report->posed)
        fprintf(stream, "\nThe program %s: no period, no multipliers.\n",
                report->period.start > 0 ? "comes to rest" : "rests");
}
