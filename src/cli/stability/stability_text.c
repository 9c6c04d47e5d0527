/* Stability for reading: eigenvalues at rest with what moves, thresholds of G, multipliers about the program, verdicts. */
#include <math.h>
#include <string.h>

#include "cli/common/left_out.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/run/run_report.h"
#include "cli/stability/stability_report.h"
#include "cli/stability/value_groups.h"

static const double DEGREES = 57.295779513082320877;
static const double TENFOLD = 2.302585092994045684; /* log 10 */
static const double TWO_PI = 6.283185307179586477;

/* real parts of eigenvalues below this part of the largest are rounding */
static const double rounding = 1e-12;

/* a motion this near to its program, in base radii, is the program */
static const double same_motion = 1e-10;

/* a smaller multiplier prints as 0: one period leaves nothing of the deviation in double precision */
static const double least_multiplier = 1e-16;

/* ---- at rest ----------------------------------------------------------------------------------------------------- */

static void print_eigenvalues(FILE *stream, const stability_report *report,
                              const gough_rest *rest) {
    enum { RATE = 13, FREQUENCY = 18, TIME = 15 };
    const gough_units *unit = &report->units;
    const char *time = unit_word(unit, GOUGH_UNIT_TIME);
    char frequency_unit[16] = "";
    if (*time) snprintf(frequency_unit, sizeof frequency_unit, " rad/%s", time + 1);
    mode_value value[GOUGH_LINEAR_MOST];
    value_group group[GOUGH_LINEAR_MOST];
    for (size_t i = 0; i < rest->size; i++)
        value[i] = (mode_value){{rest->eigenvalue[i].value[0], rest->eigenvalue[i].value[1]},
                                &rest->eigenvalue[i].mode};
    const int groups = group_values(value, rest->size, false, group),
              width = name_width(group, groups);
    if (rest->size > GOUGH_LINEAR)
        fprintf(stream,
                "  Small deviations vary as exp(lambda t); conjugate pairs of the %zu lambda are "
                "listed once\n"
                "    ",
                rest->size);
    else
        fprintf(stream, "  Small deviations vary as exp(lambda t); conjugate pairs of the twelve "
                        "lambda are listed once\n"
                        "    ");
    stability_pad(stream, "mode", width);
    const char *per_time = unit_word(unit, GOUGH_UNIT_RATE);
    int cell[4];
    cell[0] = print_heading(stream, "growth", per_time, RATE);
    cell[1] = print_heading(stream, "frequency", frequency_unit, FREQUENCY);
    cell[2] = print_heading(stream, "tenfold in", time, TIME);
    cell[3] = print_heading(stream, "period", time, TIME);
    fprintf(stream, "   moves\n");
    for (int g = 0; g < groups; g++) {
        const double rate = group[g].value[0], frequency = group[g].value[1];
        int used = print_name(stream, &group[g], width);
        used += print_cell(stream, rate, cell[0]);
        used += print_cell(stream, frequency, cell[1]);
        used += print_cell(stream, TENFOLD / fabs(rate), cell[2]);
        used += print_cell(stream, TWO_PI / frequency, cell[3]);
        print_moves(stream, report, &group[g], used);
    }
}

static double least_gain(const double gain[GOUGH_LEGS]) {
    double least = INFINITY;
    for (int i = 0; i < GOUGH_LEGS; i++) least = fmin(least, gain[i]);
    return least;
}

/* "50 N/m" or "4 to 6 N/m" */
typedef struct gain_words {
    char text[112];
} gain_words;

/* Of matrices the diagonals. */
static gain_words words_of_gain(const gough_control *control, const double gain[GOUGH_LEGS],
                                double factor, const char *word) {
    const double least = least_gain(gain);
    const char *matrix = control->coupled ? "a matrix with " : "",
               *where = control->coupled ? " on its diagonal" : "";
    double greatest = 0;
    gain_words words;
    for (int i = 0; i < GOUGH_LEGS; i++) greatest = fmax(greatest, gain[i]);
    if (greatest > least)
        snprintf(words.text, sizeof words.text, "%s%.6g to %.6g%s%s", matrix, least * factor,
                 greatest * factor, word, where);
    else
        snprintf(words.text, sizeof words.text, "%s%.6g%s%s", matrix, least * factor, word, where);
    return words;
}

static bool same_threshold(const gough_threshold *a, const gough_threshold *b) {
    return fabs(a->stiffness - b->stiffness) <= 1e-9 * fabs(b->stiffness) &&
           a->neutral == b->neutral && strcmp(a->mode.name, b->mode.name) == 0;
}

static void print_thresholds(FILE *stream, const stability_report *report, const gough_rest *rest) {
    const gough_units *unit = &report->units;
    const double factor = gough_unit_factor(&report->units, GOUGH_UNIT_STIFFNESS);
    const gain_words gain =
        words_of_gain(&report->study->model->control, report->study->model->control.stiffness,
                      factor, unit_word(unit, GOUGH_UNIT_STIFFNESS));
    bool told[6] = {false};
    fprintf(stream, "  Least stiffness G, the same in all legs, above which each mode is stable\n");
    for (int i = 0; i < 6; i++) {
        const gough_threshold *t = &rest->threshold[i];
        int modes = 0;
        if (told[i]) continue;
        for (int k = i; k < 6; k++) {
            if (told[k] || !same_threshold(&rest->threshold[k], t)) continue;
            told[k] = true;
            modes++;
        }
        fprintf(stream, "    ");
        stability_pad(stream, t->mode.name, 20);
        fprintf(stream, "%12.6g%s", t->stiffness, unit_word(unit, GOUGH_UNIT_STIFFNESS));
        if (modes > 1) fprintf(stream, "   (%d modes)", modes);
        if (t->neutral)
            fprintf(stream, "   neutral without feedback; any G > 0 holds it");
        else if (!(t->stiffness > 0))
            fprintf(stream, "   needs no feedback");
        fprintf(stream, "\n");
    }
    fprintf(stream, "    %-20s%s\n", "this study has", gain.text);
}

static bool legs_have_mass(const stability_report *report) {
    return report->study->model->machine.platform.legs_have_mass;
}

/* (stab-5), (mass-16) */
static const char *trace_words(const stability_report *report) {
    return legs_have_mass(report) ? "-2(M+S)g/h" : "-2Mg/h";
}

static const char *trace_mass(const stability_report *report) {
    return legs_have_mass(report)
               ? ", with the load M and what of the legs' mass hangs on the top, S"
               : "";
}

/* What constant leg forces do in this pose: as computed, and by (stab-5) where that holds. */
static void print_trace(FILE *stream, const stability_report *report, const gough_rest *rest) {
    const char *unit = unit_word(&report->units, GOUGH_UNIT_STIFFNESS);
    const bool theorem = fabs(rest->trace_theorem) > 0;
    const gough_threshold *largest = &rest->threshold[0];
    if (!(largest->stiffness > 0)) {
        bool neutral = false;
        for (int i = 0; i < 6; i++) neutral = neutral || rest->threshold[i].neutral;
        print_paragraph(stream, "  ", 2,
                        neutral ? "Without feedback nothing grows in this pose, but not every "
                                  "mode is held (trace of the translational stiffness %.6g%s)."
                                : "Without feedback nothing grows in this pose: constant leg "
                                  "forces hold it (trace of the translational stiffness %.6g%s).",
                        rest->trace + 0, unit);
    } else if (theorem && rest->trace < 0) {
        print_paragraph(
            stream, "  ", 2,
            "Without feedback some mode always grows: the translational stiffness of constant leg "
            "forces has the trace %s = %.6g%s < 0, wherever the joints lie in two level "
            "planes, the top ones at the height h above the base ones%s.",
            trace_words(report), rest->trace_theorem, unit, trace_mass(report));
    } else if (rest->trace < 0) {
        print_paragraph(stream, "  ", 2,
                        "Without feedback some mode grows in this pose: the translational "
                        "stiffness of constant leg forces has the trace %.6g%s < 0.",
                        rest->trace, unit);
    } else {
        print_paragraph(stream, "  ", 2,
                        "Without feedback %s grows in this pose, although the translational "
                        "stiffness of constant leg forces has the trace %.6g%s.",
                        largest->mode.name, rest->trace + 0, unit);
    }
}

/* "sway, tilt or yaw": each name once */
static void name_neutral(const gough_rest *rest, char words[6 * GOUGH_MODE_NAME]) {
    const int count = rest->drifting > 0 ? rest->drifting : rest->neutral;
    const char *name[6];
    int names = 0;
    for (int i = 0; i < count; i++) {
        bool known = false;
        for (int k = 0; k < names; k++)
            known = known || strcmp(name[k], rest->neutral_mode[i].name) == 0;
        if (!known) name[names++] = rest->neutral_mode[i].name;
    }
    words[0] = '\0';
    for (int k = 0; k < names; k++) {
        if (k) strcat(words, k + 1 < names ? ", " : " or ");
        strcat(words, name[k]);
    }
}

/* The slowest decay, where double precision can tell it from none beside the fastest. */
static void print_decay(FILE *stream, const gough_rest *rest, const char *time) {
    double fastest = 0;
    for (size_t i = 0; i < rest->size; i++)
        fastest = fmax(fastest, hypot(rest->eigenvalue[i].value[0], rest->eigenvalue[i].value[1]));
    if (-rest->growth > rounding * fastest)
        fprintf(stream,
                "  Stable: every deviation dies out; the slowest falls to a tenth in %.4g%s.\n",
                TENFOLD / -rest->growth, time);
    else
        print_paragraph(stream, "  ", 2,
                        "Stable: every deviation dies out, but the slowest takes longer than "
                        "%.1g%s to fall to a tenth.",
                        TENFOLD / (rounding * fastest), time);
}

static void print_rest_verdict(FILE *stream, const stability_report *report,
                               const gough_rest *rest) {
    const gough_units *unit = &report->units;
    char neutral[6 * GOUGH_MODE_NAME];
    name_neutral(rest, neutral);
    if (rest->growing > 0)
        fprintf(stream, "  Unstable: a deviation in %s grows tenfold every %.4g%s.\n",
                rest->eigenvalue[0].mode.name, TENFOLD / rest->growth,
                unit_word(unit, GOUGH_UNIT_TIME));
    else if (rest->drifting > 0)
        print_paragraph(stream, "  ", 2,
                        "Unstable: nothing resists motion in %s. Once moving, the platform keeps "
                        "its velocity and drifts away.",
                        neutral);
    else if (rest->decaying)
        print_decay(stream, rest, unit_word(unit, GOUGH_UNIT_TIME));
    else if (rest->neutral > 0)
        print_paragraph(stream, "  ", 2,
                        "Bounded, but not asymptotically stable: nothing grows, but a displacement "
                        "in %s remains, because no stiffness acts on it.",
                        neutral);
    else if (report->damped)
        fprintf(stream,
                "  Bounded: nothing grows, but some modes are undamped and never die out.\n");
    else
        fprintf(stream,
                "  Bounded: nothing grows, but without damping (D = 0) nothing dies out.\n");
}

/* "heave 0.1, yaw 10 deg" */
static void print_pose(FILE *stream, const double pose[GOUGH_COMPONENTS], const gough_units *unit) {
    const char *joint = "";
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (!(fabs(pose[c]) > 0)) continue;
        fprintf(stream, "%s%s %.6g%s", joint, gough_component_name(c), pose[c],
                unit_word(unit, component_unit(c)));
        joint = ", ";
    }
    if (!*joint) fprintf(stream, "home");
}

/* Where the springs carry the load. */
static void print_sag(FILE *stream, const stability_report *report, const double position[3]) {
    double shown[3];
    for (int k = 0; k < 3; k++)
        shown[k] = fabs(position[k]) < 1e-12 * report->arm ? 0.0 : position[k];
    print_paragraph(stream, "  ", 2,
                    "%s the loop rests where springs and load balance, with the top at "
                    "%.6g, %.6g, %.6g%s",
                    words_of_feed(report->study->model, false).text, shown[0], shown[1], shown[2],
                    unit_word(&report->units, GOUGH_UNIT_LENGTH));
}

/* What is known of the stiffness beforehand; with matrices of gains it need not be symmetric. */
static void print_rest_checks(FILE *stream, const stability_report *report,
                              const gough_rest *rest) {
    const bool coupled = report->study->model->control.coupled,
               theorem = fabs(rest->trace_theorem) > 0;
    if (coupled && !theorem) return;
    fprintf(stream, "  Checked: ");
    if (!coupled)
        fprintf(stream, "the stiffness matrix is symmetric to %.1g of its largest element",
                rest->asymmetry);
    if (theorem)
        fprintf(stream, "%s equals %s to a relative %.1g",
                coupled ? "the trace of the stiffness of constant leg forces" : ";\n  its trace",
                trace_words(report),
                fabs(rest->trace - rest->trace_theorem) / fabs(rest->trace_theorem));
    fprintf(stream, ".\n");
}

static void print_rest(FILE *stream, const stability_report *report, const gough_rest *rest,
                       const double pose[GOUGH_COMPONENTS], const char *where) {
    const gough_units *unit = &report->units;
    fprintf(stream, "\nAt rest%s: ", where);
    print_pose(stream, pose, unit);
    fprintf(stream, "\n");
    if (!gough_keeps_program(&report->study->model->machine, &report->study->model->control, false))
        print_sag(stream, report, rest->state.position);
    if (report->sampled) {
        const bool last = rest == &report->last;
        stability_print_sampled(stream, report,
                                last ? &report->sampled_last : &report->sampled_rest);
        fprintf(stream, "\n  With the same gains in continuous time\n");
    }
    print_eigenvalues(stream, report, rest);
    print_thresholds(stream, report, rest);
    print_trace(stream, report, rest);
    print_rest_checks(stream, report, rest);
    if (!report->sampled) print_rest_verdict(stream, report, rest);
}

/* ---- about the program ------------------------------------------------------------------------------------------- */

static void print_multipliers(FILE *stream, const stability_report *report) {
    enum { CELL = 16 };
    const gough_floquet *f = &report->floquet;
    mode_value value[GOUGH_LINEAR_MOST];
    value_group group[GOUGH_LINEAR_MOST];
    char count[24] = "twelve";
    for (size_t i = 0; i < f->size; i++)
        value[i] = (mode_value){{f->multiplier[i].value[0], f->multiplier[i].value[1]},
                                &f->multiplier[i].mode};
    const int groups = group_values(value, f->size, true, group), width = name_width(group, groups);
    const table_heading rate_heading =
        heading_of("growth", unit_word(&report->units, GOUGH_UNIT_RATE));
    if (f->size > GOUGH_LINEAR) snprintf(count, sizeof count, "%zu", f->size);
    fprintf(stream,
            "  A small deviation is multiplied by mu in each period; conjugate pairs of the %s mu "
            "are\n  listed once, modes are those at the period's beginning\n    ",
            count);
    stability_pad(stream, "mode", width);
    fprintf(stream, "%*s%*s%*s   moves\n", CELL, "|mu|", CELL, "angle [deg]", CELL,
            rate_heading.text);
    for (int g = 0; g < groups; g++) {
        const double size = hypot(group[g].value[0], group[g].value[1]);
        const double rate = log(size) / f->period;
        const bool none = size < least_multiplier;
        int used = print_name(stream, &group[g], width);
        used += print_cell(stream, none ? 0 : size, CELL);
        used += print_cell(
            stream, none ? NAN : atan2(group[g].value[1], group[g].value[0]) * DEGREES, CELL);
        used += print_cell(stream, fabs(rate) * f->period < 1e-9 ? 0 : rate, CELL);
        print_moves(stream, report, &group[g], used);
    }
}

static void print_floquet_checks(FILE *stream, const gough_floquet *f) {
    if (isfinite(f->pair_defect))
        print_paragraph(stream, "  ", 2,
                        "Checked: without damping the product of all mu is 1 (here to %.1g) and "
                        "they come in pairs mu, 1/mu (here to %.1g); %zu steps.",
                        f->determinant_defect, f->pair_defect, f->steps);
    else if (isfinite(f->determinant_defect))
        print_paragraph(stream, "  ", 2,
                        "Checked: the product of all mu is the exponential of the integral of the "
                        "trace (here to %.1g); %zu steps.",
                        f->determinant_defect, f->steps);
    else
        print_paragraph(stream, "  ", 2,
                        "The product of all mu is too small to be checked: the drives follow their "
                        "commands too quickly; %zu steps.",
                        f->steps);
}

/* a drift and rounding together look like growth this slow */
static const double near_one = 1e-4;

static const gough_mode *nearest_one(const gough_floquet *f) {
    size_t nearest = 0;
    for (size_t i = 1; i < f->size; i++) {
        const double *best = f->multiplier[nearest].value, *value = f->multiplier[i].value;
        if (hypot(value[0] - 1, value[1]) < hypot(best[0] - 1, best[1])) nearest = i;
    }
    return &f->multiplier[nearest].mode;
}

static void print_floquet_verdict(FILE *stream, const stability_report *report) {
    const gough_units *unit = &report->units;
    const gough_floquet *f = &report->floquet;
    const double tenfold = f->period * TENFOLD / fabs(log(f->growth));
    if (f->drifting > 0 && f->growth < 1 + near_one)
        print_paragraph(stream, "  ", 2,
                        "Unstable: a deviation in %s drifts, growing in proportion to time (a "
                        "multiplier 1 without an eigenvector of its own).",
                        nearest_one(f)->name);
    else if (!f->stable)
        print_paragraph(stream, "  ", 2,
                        "Unstable: a deviation in %s grows %.6g-fold in each period, tenfold in "
                        "%.4g%s.",
                        f->multiplier[0].mode.name, f->growth, tenfold,
                        unit_word(unit, GOUGH_UNIT_TIME));
    else if (f->growth < 1 - GOUGH_GROWTH_LIMIT)
        fprintf(stream,
                "  Stable: every deviation dies out; the slowest falls to a tenth in %.4g%s.\n",
                tenfold, unit_word(unit, GOUGH_UNIT_TIME));
    else if (report->damped)
        fprintf(stream, "  Bounded: nothing grows, but not every deviation dies out.\n");
    else
        fprintf(stream,
                "  Bounded: nothing grows, but without damping (D = 0) nothing dies out.\n");
}

/* Of a loop that does not move as its program does, as drives that lag cannot. */
static void print_own_motion(FILE *stream, const stability_report *report) {
    const gough_model *model = report->study->model;
    const bool kept = gough_keeps_program(&model->machine, &model->control, true),
               lags = model->machine.platform.actuators.kind == GOUGH_ACTUATOR_LAG;
    const char *how = kept ? "With drives that lag" : words_of_feed(model, true).text;
    const bool limited = kept && !lags && report->sag > same_motion * report->arm;
    if (kept && !lags && !limited) return;
    print_paragraph(stream, "  ", 2,
                    "%s the loop has a periodic motion of its own%s, %.4g%s from the program "
                    "when the period begins. The multipliers are those of this motion; a run "
                    "that starts far from it may not reach it.",
                    limited ? "With the limits of its drives" : how,
                    leaves_out_friction(model) ? " (computed without dry friction)" : "",
                    report->sag, unit_word(&report->units, GOUGH_UNIT_LENGTH));
}

static void print_program(FILE *stream, const stability_report *report) {
    const gough_units *unit = &report->units;
    const gough_motion *motion = &report->study->model->motion;
    fprintf(stream,
            "\n"
            "Along the program, of period %.9g%s, %s",
            report->floquet.period, unit_word(unit, GOUGH_UNIT_TIME),
            motion->period > 0 ? "given in the study" : "found from its formulas");
    if (report->floquet.start > 0)
        fprintf(stream, ", from t = %.4g%s on", report->floquet.start,
                unit_word(unit, GOUGH_UNIT_TIME));
    fprintf(stream, "\n");
    print_own_motion(stream, report);
    print_multipliers(stream, report);
    print_floquet_checks(stream, &report->floquet);
    print_floquet_verdict(stream, report);
}

void stability_print(FILE *stream, const stability_report *report) {
    const gough_control *control = &report->study->model->control;
    const gough_units *u = &report->units;
    const gough_units *unit = u;
    print_title(stream, report->study->title);
    const gain_words stiffness =
        words_of_gain(control, control->stiffness, gough_unit_factor(u, GOUGH_UNIT_STIFFNESS),
                      unit_word(unit, GOUGH_UNIT_STIFFNESS));
    const gain_words damping =
        words_of_gain(control, control->damping, gough_unit_factor(u, GOUGH_UNIT_DAMPING),
                      unit_word(unit, GOUGH_UNIT_DAMPING));
    const ignored_words ignored =
        control->feedforward ? words_of_ignored(report->study->model, true) : (ignored_words){""};
    print_paragraph(
        stream, "", 0, "Stability of the closed loop: %s%s%s, stiffness G = %s, damping D = %s",
        control->feedforward ? "the program's forces fed forward" : "no feed-forward",
        *ignored.text ? " except for " : "", ignored.text, stiffness.text, damping.text);
    fprintf(stream, "%s\n", units_sentence(report->study, u).text);
    print_left_out_friction(stream, report->study->model);
    print_rest(stream, report, &report->rest, report->pose, "");
    if (report->ends)
        print_rest(stream, report, &report->last, report->last_pose, " where the program ends");
    if (report->periodic)
        print_program(stream, report);
    else if (report->sampled_along)
        stability_print_sampled_along(stream, report);
    else if (!report->posed)
        fprintf(stream, "\nThe program %s, so there is no period%s.\n",
                report->period.start > 0 ? "comes to rest" : "rests",
                report->sampled ? "" : " and there are no multipliers");
}
