/* A sampled loop at rest for reading: multipliers from sample to sample, the window of the stiffness, the verdict. */
#include <math.h>

#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/stability/stability_report.h"
#include "cli/stability/value_groups.h"

static const double TENFOLD = 2.302585092994045684; /* log 10 */

/* a smaller multiplier prints as 0: where several are 0 together, their last digits are their rounding */
static const double least_sampled = 1e-4;

/* Multipliers over a time, in units of the run: of one sample or of a period of the program. */
typedef struct multiplier_list {
    const gough_multiplier *multiplier;
    size_t listed, size;
    double time;
    const char *when; /* "from sample to sample" */
} multiplier_list;

static void print_sampled_multipliers(FILE *stream, const stability_report *report,
                                      const multiplier_list *list) {
    enum { CELL = 18 };
    const gough_units *unit = &report->units;
    const char *time = unit_word(unit, GOUGH_UNIT_TIME), *rate = unit_word(unit, GOUGH_UNIT_RATE);
    char frequency_unit[16] = "";
    mode_value value[GOUGH_LINEAR_MOST];
    value_group group[GOUGH_LINEAR_MOST];
    if (*time) snprintf(frequency_unit, sizeof frequency_unit, " rad/%s", time + 1);
    for (size_t i = 0; i < list->listed; i++)
        value[i] = (mode_value){{list->multiplier[i].value[0], list->multiplier[i].value[1]},
                                &list->multiplier[i].mode};
    const int groups = group_values(value, list->listed, true, group),
              width = name_width(group, groups);
    fprintf(stream,
            "  A small deviation is multiplied by mu %s; the largest %zu of %zu mu, of\n"
            "  conjugate pairs one\n"
            "    ",
            list->when, list->listed, list->size);
    stability_pad(stream, "mode", width);
    fprintf(stream, "%*s", CELL, "|mu|");
    const int cell[2] = {print_heading(stream, "frequency", frequency_unit, CELL),
                         print_heading(stream, "growth", rate, CELL)};
    fprintf(stream, "   moves\n");
    for (int g = 0; g < groups; g++) {
        const double size = hypot(group[g].value[0], group[g].value[1]);
        const double turn = atan2(group[g].value[1], group[g].value[0]) / list->time;
        const bool none = size < least_sampled;
        int used = print_name(stream, &group[g], width);
        used += print_cell(stream, none ? 0 : size, CELL);
        used +=
            print_cell(stream, none ? (double)NAN : in_units(unit, GOUGH_UNIT_RATE, turn), cell[0]);
        used += print_cell(
            stream, none ? (double)NAN : in_units(unit, GOUGH_UNIT_RATE, log(size) / list->time),
            cell[1]);
        if (none)
            fprintf(stream, "   gone at once\n");
        else
            print_moves(stream, report, &group[g], used);
    }
    if (list->listed < list->size && list->listed < GOUGH_SAMPLED)
        print_paragraph(stream, "  ", 2,
                        "The other %zu mu are less than 1e-9 of the largest. Rounding leaves no "
                        "digit of them, so they are not listed.",
                        list->size - list->listed);
}

/* The verdict on a largest multiplier of growth rate `growth`, in the units of the output. */
static void print_verdict(FILE *stream, const stability_report *report, bool stable, bool decaying,
                          const gough_mode *mode, double growth) {
    const char *time = unit_word(&report->units, GOUGH_UNIT_TIME);
    if (!stable)
        fprintf(stream, "  Unstable: a deviation in %s grows tenfold every %.4g%s.\n", mode->name,
                TENFOLD / growth, time);
    else if (decaying)
        fprintf(stream,
                "  Stable: every deviation dies out; the slowest falls to a tenth in %.4g%s.\n",
                TENFOLD / -growth, time);
    else
        fprintf(stream, "  Bounded: nothing grows, but not every deviation dies out.\n");
}

void stability_print_sampled(FILE *stream, const stability_report *report,
                             const sampled_view *view) {
    const gough_sampled_rest *r = &view->rest;
    const gough_units *unit = &report->units;
    const char *time = unit_word(unit, GOUGH_UNIT_TIME);
    fprintf(stream, "  Sampled every %.6g%s, commands acting ",
            in_units(unit, GOUGH_UNIT_TIME, r->period), time);
    if (r->delay > 0)
        fprintf(stream, "%.6g%s later", in_units(unit, GOUGH_UNIT_TIME, r->delay), time);
    else
        fprintf(stream, "at once");
    fprintf(stream, ": as if %.6g%s late\n", in_units(unit, GOUGH_UNIT_TIME, r->effective_delay),
            time);
    print_sampled_multipliers(
        stream, report,
        &(multiplier_list){r->multiplier, r->listed, r->size, r->period, "from sample to sample"});
    sampled_view_print(stream, report->study, unit, view);
    print_verdict(stream, report, r->stable, r->decaying, &r->multiplier[0].mode,
                  in_units(unit, GOUGH_UNIT_RATE, r->growth));
}

/* The samples that repeat themselves, and with which period of the controller. */
static void print_samples(FILE *stream, const stability_report *report) {
    const gough_sampled_floquet *a = &report->along;
    const gough_sampling *own = &report->study->model->control.sampling;
    const char *time = unit_word(&report->units, GOUGH_UNIT_TIME);
    fprintf(stream, "\nAlong the program, of period %.9g%s", a->period, time);
    if (a->periods == 1)
        fprintf(stream, " or %zu sample%s", a->samples, a->samples == 1 ? "" : "s");
    else
        fprintf(stream, ", %zu of which have %zu samples", a->periods, a->samples);
    if (a->start > 0) fprintf(stream, ", from t = %.4g%s on", a->start, time);
    fprintf(stream, "\n");
    if (!a->adjusted) return;
    print_paragraph(
        stream, "  ", 2,
        "No whole number of samples of %.9g%s fills up to 16 periods of the program, so "
        "the sampled loop has no periodic motion. What follows is for the nearest "
        "period of the controller that fits, %.9g%s%s.",
        in_units(&report->units, GOUGH_UNIT_TIME, own->period), time, a->sampling, time,
        own->delay > 0 ? ", with a delay in proportion" : "");
}

/* Its times are in the units of the output. */
void stability_print_sampled_along(FILE *stream, const stability_report *report) {
    const gough_sampled_floquet *a = &report->along;
    const gough_units *unit = &report->units;
    const double span = (double)a->periods * a->period;
    char when[40];
    print_samples(stream, report);
    print_paragraph(stream, "  ", 2,
                    "The sampled loop has a periodic motion of its own, %.4g%s from the program "
                    "when the period begins. The multipliers are those of this motion.",
                    report->sag, unit_word(unit, GOUGH_UNIT_LENGTH));
    if (a->periods == 1)
        snprintf(when, sizeof when, "in each period");
    else
        snprintf(when, sizeof when, "in every %zu periods", a->periods);
    print_sampled_multipliers(stream, report,
                              &(multiplier_list){a->multiplier, a->listed, a->size,
                                                 gough_unit_read(unit, GOUGH_UNIT_TIME, span),
                                                 when});
    print_verdict(stream, report, a->stable, a->growth < 1 - GOUGH_GROWTH_LIMIT,
                  &a->multiplier[0].mode, log(a->growth) / span);
}
