/* The choice of gough tune for reading. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/left_out.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/run/run_report.h"
#include "cli/tune/tune_report.h"

/* ---- words -------------------------------------------------------------------------------------------------------- */

/* Why a smaller G is not enough. */
static void print_binding(FILE *stream, const gough_tuning *tuning, const gough_units *unit) {
    const char *mode = *tuning->mode.name ? tuning->mode.name : "a mode";
    char text[300] = "", fails[80] = "";
    switch (tuning->binding) {
    case GOUGH_TUNING_POSITION:
    case GOUGH_TUNING_ANGLE:
        snprintf(text, sizeof text, "the deviation of %s",
                 tuning->binding == GOUGH_TUNING_ANGLE ? "angle" : "position");
        if (isfinite(tuning->mode_share))
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     ", at its largest %.0f %% in %s", 100 * tuning->mode_share, tuning->mode.name);
        break;
    case GOUGH_TUNING_END:
        snprintf(text, sizeof text, "early ends: with a smaller G %s",
                 gough_cause_words(tuning->cause));
        break;
    case GOUGH_TUNING_THRESHOLD:
        snprintf(text, sizeof text, "stability: with a smaller G %s grows at rest", mode);
        break;
    case GOUGH_TUNING_TONGUE:
        snprintf(text, sizeof text, "stability: just below, the motion pumps %s", mode);
        break;
    case GOUGH_TUNING_SEARCH:
        snprintf(text, sizeof text, "nothing: this is the smallest G of the search");
        break;
    }
    if (isfinite(tuning->fails))
        snprintf(fails, sizeof fails, "; G = %.6g%s is not enough", tuning->fails,
                 unit_word(unit, GOUGH_UNIT_STIFFNESS));
    print_paragraph(stream, "  limited by", 14, "%s%s", text, fails);
}

static void print_legs(FILE *stream, const gough_tuning *tuning, const gough_units *unit) {
    char force[60] = "", speed[60] = "";
    if (isfinite(tuning->force_share))
        snprintf(force, sizeof force, " (%.3g %% of the limit)", 100 * tuning->force_share);
    if (isfinite(tuning->speed_share))
        snprintf(speed, sizeof speed, " (%.3g %% of the limit)", 100 * tuning->speed_share);
    print_paragraph(stream, "  legs", 14, "force up to %.5g%s in leg %d%s; rate up to %.5g%s%s",
                    tuning->force, unit_word(unit, GOUGH_UNIT_FORCE), tuning->leg, force,
                    tuning->speed, unit_word(unit, GOUGH_UNIT_SPEED), speed);
}

/* so far off the trend a reader doubts the run */
static const double far_off = 100;

static void print_exception(FILE *stream, const gough_tuning_exception *e,
                            const gough_units *unit) {
    if (e->to > e->from)
        fprintf(stream, "    G = %.6g to %.6g%s: ", e->from, e->to,
                unit_word(unit, GOUGH_UNIT_STIFFNESS));
    else
        fprintf(stream, "    G = %.6g%s: ", e->from, unit_word(unit, GOUGH_UNIT_STIFFNESS));
    if (e->kind == GOUGH_TUNING_UNSTABLE && *e->mode)
        fprintf(stream, "unstable (%s)", e->mode);
    else if (e->kind == GOUGH_TUNING_UNSTABLE)
        fprintf(stream, "no pose of rest, or no periodic motion, is found");
    else if (e->kind == GOUGH_TUNING_ENDED)
        fprintf(stream, "the run ends early: %s", gough_cause_words(e->cause));
    else
        fprintf(stream, "%.3g times the trend", e->worst);
    if (e->kind == GOUGH_TUNING_OFF_TREND && e->small_steps && fabs(log(e->worst)) > log(far_off))
        fprintf(stream, ";\n      runs with small steps, which end at each corner of program and "
                        "disturbance, confirm it");
    fputc('\n', stream);
}

/* Resonances so narrow that hardly anybody meets one are counted only; JSON has them all. */
static void print_exceptions(FILE *stream, const gough_tuning *tuning, const gough_units *unit) {
    static const double narrow = 2e-3;
    size_t left_out = 0;
    if (tuning->exceptions)
        fprintf(stream, "  exceptions  where the curve does not follow its trend\n");
    for (size_t i = 0; i < tuning->exceptions; i++) {
        const gough_tuning_exception *e = &tuning->exception[i];
        if (e->kind == GOUGH_TUNING_UNSTABLE && e->to > e->from && e->to < e->from * (1 + narrow))
            left_out++;
        else
            print_exception(stream, e, unit);
    }
    if (left_out)
        fprintf(stream, "    and %zu resonance%s narrower than %g %% of G\n", left_out,
                left_out == 1 ? "" : "s", 100 * narrow);
}

/* Where it was examined whether the points of the curve are stable, with loops for which that is not the same for all of them. */
static void print_judged(FILE *stream, const tune_choice *choice) {
    const gough_tuning *tuning = &choice->tuning;
    size_t judged[TUNE_JUDGED];
    char more[80] = "";
    if (!tuning->sampled && !tuning->states) return;
    tune_count_judged(choice, judged);
    if (judged[GOUGH_TUNING_ALONG] > 0)
        snprintf(more, sizeof more, ", and of %zu that hold there along the program",
                 judged[GOUGH_TUNING_ALONG]);
    print_paragraph(stream, "  points", 14, "their stability was checked at rest at home%s%s%s",
                    tuning->sampled ? ", from sample to sample" : "", more,
                    tuning->found && tuning->periodic
                        ? "; that of the G named, with its margin, along the program"
                        : "");
}

static void print_curve(FILE *stream, const gough_tuning *tuning, const gough_units *unit) {
    if (isfinite(tuning->slope))
        fprintf(stream,
                "  curve       the deviation varies as G^%.3f (%.4g%s at G = 1%s); %zu points\n",
                tuning->slope, tuning->scale, unit_word(unit, GOUGH_UNIT_LENGTH),
                unit_word(unit, GOUGH_UNIT_STIFFNESS), tuning->points);
    else
        fprintf(stream, "  curve       no trend: the deviation is round-off, or too few runs reach "
                        "their end\n");
    print_exceptions(stream, tuning, unit);
}

/* "Without feed-forward", "With feed-forward that ignores the legs' mass" */
static void print_heading(FILE *stream, const gough_model *model, bool fed) {
    const ignored_words ignored = words_of_ignored(model, true);
    const bool some = fed && *ignored.text;
    fprintf(stream, "\n%s feed-forward%s%s\n", fed ? "With" : "Without",
            some ? " that ignores " : "", some ? ignored.text : "");
}

static void print_choice(FILE *stream, const tune_choice *choice, const gough_units *unit) {
    const gough_tuning *tuning = &choice->tuning;
    if (tuning->found) {
        fprintf(stream, "  stiffness   G = %.10g%s in each leg\n", tuning->stiffness,
                unit_word(unit, GOUGH_UNIT_STIFFNESS));
        fprintf(stream,
                "  damping     D = %.9g%s; damping ratio of the least damped mode at home %.4g\n",
                tuning->damping, unit_word(unit, GOUGH_UNIT_DAMPING), tuning->damping_ratio);
        fprintf(stream, "  deviation   %.5g%s at t = %.6g%s, and %.4g%s at t = %.6g%s\n",
                tuning->deviation, unit_word(unit, GOUGH_UNIT_LENGTH), tuning->deviation_time,
                unit_word(unit, GOUGH_UNIT_TIME), tuning->angle_deviation,
                unit_word(unit, GOUGH_UNIT_ANGLE), tuning->angle_time,
                unit_word(unit, GOUGH_UNIT_TIME));
        print_binding(stream, tuning, unit);
        print_legs(stream, tuning, unit);
    } else {
        fprintf(stream, "  no G in the range of the search meets it; the reason is given below\n");
    }
    if (*tuning->unchecked)
        print_paragraph(stream, "  stability", 14, "checked at rest only: %s", tuning->unchecked);
    print_curve(stream, tuning, unit);
    print_judged(stream, choice);
}

/* Where a sampled controller, or one whose drives lag, no longer holds the platform. */
static void print_upper(FILE *stream, const tune_report *report) {
    const gough_tuning *first = &report->choice[0].tuning;
    const char *time = unit_word(&report->units, GOUGH_UNIT_TIME);
    const bool by_ratio = isfinite(report->asked.damping_ratio);
    print_paragraph(stream, "", 0,
                    "%s: %s at home for G %s %.6g%s, where %s shakes with "
                    "%.4g %s%s",
                    first->sampled ? "Its controller is sampled" : "Its drives lag",
                    by_ratio ? "some D gives that damping ratio" : "the loop holds the platform",
                    by_ratio ? "up to" : "below", first->upper,
                    unit_word(&report->units, GOUGH_UNIT_STIFFNESS), first->upper_mode.name,
                    first->upper_frequency, *time ? "rad/" : "radians per unit of time",
                    *time ? time + 1 : "");
}

void tune_print(FILE *stream, const tune_report *report) {
    const gough_units *unit = &report->units;
    const gough_tuning_options *asked = &report->asked;
    const gough_tuning *first = &report->choice[0].tuning;
    print_title(stream, report->study->title);
    fprintf(stream, "Feedback for a deviation of at most %.6g%s", asked->deviation,
            unit_word(unit, GOUGH_UNIT_LENGTH));
    if (isfinite(asked->angle_deviation))
        fprintf(stream, " and %.6g%s", asked->angle_deviation, unit_word(unit, GOUGH_UNIT_ANGLE));
    fprintf(stream, ", with a margin of %.3g %% in G to instability\n%s\n", 100 * asked->margin,
            units_sentence(report->study, &report->units).text);
    if (first->threshold > 0)
        fprintf(stream,
                "At rest at home, with feed-forward, the machine needs G above %.6g%s (%s)\n",
                first->threshold, unit_word(unit, GOUGH_UNIT_STIFFNESS), first->least_mode.name);
    if (first->upper > 0 && isfinite(first->upper)) print_upper(stream, report);
    for (int c = 0; c < report->choices; c++) {
        print_heading(stream, report->study->model, report->choice[c].feedforward);
        print_choice(stream, &report->choice[c], unit);
    }
    print_linear_friction(stream, report->study->model);
}

/* ---- table -------------------------------------------------------------------------------------------------------- */

/* The columns, in the order of set_row(). */
static const struct {
    const char *name;
    gough_unit unit;
} columns[] = {{"feedforward", GOUGH_UNIT_NONE},
               {"G", GOUGH_UNIT_STIFFNESS},
               {"D", GOUGH_UNIT_DAMPING},
               {"position_deviation", GOUGH_UNIT_LENGTH},
               {"angle_deviation", GOUGH_UNIT_ANGLE},
               {"force", GOUGH_UNIT_FORCE},
               {"speed", GOUGH_UNIT_SPEED},
               {"growth", GOUGH_UNIT_NONE},
               {"stable", GOUGH_UNIT_NONE},
               {"regular", GOUGH_UNIT_NONE},
               {"ended", GOUGH_UNIT_NONE},
               {"end_cause", GOUGH_UNIT_NONE},
               {"end_leg", GOUGH_UNIT_NONE},
               {"end_time", GOUGH_UNIT_TIME},
               {"named", GOUGH_UNIT_NONE},
               {"asked", GOUGH_UNIT_LENGTH},
               {"judged", GOUGH_UNIT_NONE}};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static void name_columns(gough_table *table, const gough_units *units, double *column[COLUMNS]) {
    for (int c = 0; c < COLUMNS; c++)
        column[c] = gough_table_name(table, (size_t)c, columns[c].name,
                                     gough_unit_label(units, columns[c].unit));
}

static void set_row(double *const column[COLUMNS], size_t row, const tune_report *report,
                    bool feedforward, const gough_tuning_point *point, bool named) {
    const bool ended = point->cause != GOUGH_END_DONE;
    const double value[COLUMNS] = {feedforward,
                                   point->stiffness,
                                   point->damping,
                                   point->position_deviation,
                                   point->angle_deviation,
                                   point->force,
                                   point->speed,
                                   point->growth,
                                   point->stable,
                                   point->regular,
                                   ended,
                                   point->cause,
                                   point->leg,
                                   point->end_time,
                                   named,
                                   report->asked.deviation,
                                   point->judged};
    for (int c = 0; c < COLUMNS; c++) column[c][row] = value[c];
}

/* It has no growth of its own: values all over its margin were examined. */
static gough_tuning_point named_point(const tune_report *report, const gough_tuning *tuning) {
    return (gough_tuning_point){.stiffness = tuning->stiffness,
                                .damping = tuning->damping,
                                .end_time = report->study->simulation.duration *
                                            gough_unit_factor(&report->units, GOUGH_UNIT_TIME),
                                .position_deviation = tuning->deviation,
                                .angle_deviation = tuning->angle_deviation,
                                .force = tuning->force,
                                .speed = tuning->speed,
                                .growth = NAN,
                                .judged =
                                    tuning->periodic ? GOUGH_TUNING_ALONG : GOUGH_TUNING_AT_REST,
                                .stable = true,
                                .regular = false};
}

gough_table *tune_table(const tune_report *report) {
    size_t rows = 0, row = 0;
    double *column[COLUMNS];
    for (int c = 0; c < report->choices; c++)
        rows += report->choice[c].tuning.points + report->choice[c].tuning.found;
    gough_table *table = gough_table_new(report->study->title, report->verb, COLUMNS, rows);
    if (!table) return NULL;
    name_columns(table, &report->units, column);
    const gough_simulation *simulation = &report->study->simulation;
    if (simulation->step > 0)
        table->step = simulation->step * gough_unit_factor(&report->units, GOUGH_UNIT_TIME);
    else
        table->tolerance = simulation->tolerance;
    for (int c = 0; c < COLUMNS; c++) {
        if (column[c]) continue;
        gough_table_free(table);
        return NULL;
    }
    for (int c = 0; c < report->choices; c++) {
        const tune_choice *choice = &report->choice[c];
        bool named = !choice->tuning.found; /* or its row is yet to come */
        for (size_t i = 0; i < choice->tuning.points; i++) {
            if (!named && choice->point[i].stiffness >= choice->tuning.stiffness) {
                const gough_tuning_point point = named_point(report, &choice->tuning);
                set_row(column, row++, report, choice->feedforward, &point, true);
                named = true;
            }
            set_row(column, row++, report, choice->feedforward, &choice->point[i], false);
        }
        if (!named) {
            const gough_tuning_point point = named_point(report, &choice->tuning);
            set_row(column, row++, report, choice->feedforward, &point, true);
        }
    }
    return table;
}
