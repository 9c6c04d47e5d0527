/* A sampled controller at rest, for reading and as JSON: between which gains, and up to which period and delay, it holds. */
#include "cli/common/sampled_view.h"

#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"

void sampled_view_find(const gough_study *study, const double *component, sampled_view *view) {
    memset(view, 0, sizeof *view);
    if (!(study->model->control.sampling.period > 0)) return;
    gough_status status = gough_sampled_at_rest(study->model, component, &view->rest, &view->why);
    if (!status)
        status = gough_sampled_margins_at_rest(study->model, component, &view->margins, &view->why);
    view->found = status == GOUGH_OK;
    gough_error_say(&view->why, &study->units);
}

/* ---- for reading ---- */

/* A value with its unit. */
typedef struct value_words {
    char text[48];
} value_words;

static value_words words_of(const gough_units *unit, gough_unit of, double value) {
    value_words words;
    snprintf(words.text, sizeof words.text, "%.6g%s", in_units(unit, of, value),
             unit_word(unit, of));
    return words;
}

/* " at 6.05 rad/s", or nothing for what does not oscillate */
static value_words words_of_frequency(const gough_units *unit, double frequency) {
    const char *time = unit_word(unit, GOUGH_UNIT_TIME);
    value_words words = {""};
    if (frequency > 0)
        snprintf(words.text, sizeof words.text, " at %.4g%s%s",
                 in_units(unit, GOUGH_UNIT_RATE, frequency), *time ? " rad/" : "",
                 *time ? time + 1 : "");
    return words;
}

static bool gains_are_alike(const gough_control *control) {
    bool alike = !control->coupled;
    for (int v = 1; v < GOUGH_LEGS; v++)
        alike = alike && fabs(control->stiffness[v] - control->stiffness[0]) <= 0 &&
                fabs(control->damping[v] - control->damping[0]) <= 0;
    return alike;
}

/* What the edges are of: one number if all legs are alike. */
static const char *whose(const gough_control *control) {
    return gains_are_alike(control) ? "" : " of the stiffest leg, the others in proportion";
}

static void print_window(FILE *stream, const gough_study *study, const gough_units *unit,
                         const gough_sampled_margins *m) {
    const value_words damping = words_of(unit, GOUGH_UNIT_DAMPING, m->damping);
    const char *leg = whose(&study->model->control);
    if (!m->open) {
        if (isfinite(m->best_stiffness))
            print_paragraph(stream, "  window of G          ", 23,
                            "closed: no stiffness holds the platform with the damping D = %s; "
                            "with D = %s stiffnesses up to %s do",
                            damping.text, words_of(unit, GOUGH_UNIT_DAMPING, m->best_damping).text,
                            words_of(unit, GOUGH_UNIT_STIFFNESS, m->best_stiffness).text);
        else if (isfinite(m->period_limit))
            print_paragraph(stream, "  window of G          ", 23,
                            "closed: no stiffness and damping hold the platform with this period "
                            "and delay; they can with periods up to %s and a delay in proportion",
                            words_of(unit, GOUGH_UNIT_TIME, m->period_limit).text);
        else
            print_paragraph(stream, "  window of G          ", 23,
                            "closed: no stiffness holds the platform with the damping D = %s",
                            damping.text);
        return;
    }
    const value_words low = words_of(unit, GOUGH_UNIT_STIFFNESS, m->lower.stiffness),
                      slow = words_of_frequency(unit, m->lower.frequency),
                      fast = words_of_frequency(unit, m->upper.frequency);
    char lower[112] = "";
    if (m->lower.stiffness > 0)
        snprintf(lower, sizeof lower, " (below it %s%s grows)", m->lower.mode.name, slow.text);
    if (isfinite(m->upper.stiffness))
        print_paragraph(stream, "  window of G          ", 23,
                        "%s%s to %s (above it %s%s grows)%s, with the damping D = %s", low.text,
                        lower, words_of(unit, GOUGH_UNIT_STIFFNESS, m->upper.stiffness).text,
                        m->upper.mode.name, fast.text, leg, damping.text);
    else
        print_paragraph(stream, "  window of G          ", 23,
                        "from %s%s%s, with the damping D = %s; no upper edge was found", low.text,
                        lower, leg, damping.text);
}

static void print_times(FILE *stream, const gough_units *unit, const sampled_view *view) {
    const gough_sampled_margins *m = &view->margins;
    const bool delayed = view->rest.delay > 0;
    if (isfinite(m->longest_period))
        fprintf(stream, "  longest period       %s with these gains%s\n",
                words_of(unit, GOUGH_UNIT_TIME, m->longest_period).text,
                delayed ? " and a delay in proportion" : "");
    if (isfinite(m->longest_delay))
        fprintf(stream, "  longest delay        %s with these gains and this period\n",
                words_of(unit, GOUGH_UNIT_TIME, m->longest_delay).text);
    else if (isinf(m->longest_delay))
        fprintf(stream, "  longest delay        more than 12 periods with these gains\n");
    if (isfinite(m->best_stiffness) && m->open)
        fprintf(stream, "  stiffest loop        G up to %s, with the damping D = %s\n",
                words_of(unit, GOUGH_UNIT_STIFFNESS, m->best_stiffness).text,
                words_of(unit, GOUGH_UNIT_DAMPING, m->best_damping).text);
    if (isfinite(m->period_limit) && (m->open || isfinite(m->best_stiffness)))
        fprintf(stream, "  no gains hold        from a period of %s on%s\n",
                words_of(unit, GOUGH_UNIT_TIME, m->period_limit).text,
                delayed ? ", with a delay in proportion" : "");
}

void sampled_view_print(FILE *stream, const gough_study *study, const gough_units *unit,
                        const sampled_view *view) {
    if (!view->found) {
        if (*view->why.message)
            print_paragraph(stream, "  window of G          ", 23, "not determined: %s",
                            view->why.message);
        return;
    }
    print_window(stream, study, unit, &view->margins);
    print_times(stream, unit, view);
}

/* ---- JSON ---- */

static json_t *number_in(const gough_units *unit, gough_unit of, double value) {
    return json_number(in_units(unit, of, value));
}

static json_t *six_in(const gough_units *unit, gough_unit of, const double value[GOUGH_LEGS]) {
    json_t *array = json_array();
    for (int v = 0; v < GOUGH_LEGS; v++)
        json_array_append_new(array, number_in(unit, of, value[v]));
    return array;
}

static json_t *edge_object(const gough_units *unit, const gough_sampled_margins *m,
                           const gough_sampled_edge *edge) {
    if (!m->open) return json_null();
    json_t *object = json_object();
    json_object_set_new(object, "mode", json_words(edge->mode.name));
    json_object_set_new(object, "frequency", number_in(unit, GOUGH_UNIT_RATE, edge->frequency));
    json_object_set_new(object, "damping", number_in(unit, GOUGH_UNIT_DAMPING, m->damping));
    return object;
}

json_t *sampled_view_object(const gough_units *unit, const sampled_view *view) {
    const gough_sampled_rest *r = &view->rest;
    const gough_sampled_margins *m = &view->margins;
    if (!view->found) return json_null();
    json_t *object = json_object(), *window = json_null(), *best = json_object();
    if (m->open) {
        window = json_array();
        json_array_append_new(window, number_in(unit, GOUGH_UNIT_STIFFNESS, m->lower.stiffness));
        json_array_append_new(window, number_in(unit, GOUGH_UNIT_STIFFNESS, m->upper.stiffness));
    }
    json_object_set_new(best, "stiffness",
                        number_in(unit, GOUGH_UNIT_STIFFNESS, m->best_stiffness));
    json_object_set_new(best, "damping", number_in(unit, GOUGH_UNIT_DAMPING, m->best_damping));
    json_object_set_new(object, "period", number_in(unit, GOUGH_UNIT_TIME, r->period));
    json_object_set_new(object, "delay", number_in(unit, GOUGH_UNIT_TIME, r->delay));
    json_object_set_new(object, "effective_delay",
                        number_in(unit, GOUGH_UNIT_TIME, r->effective_delay));
    json_object_set_new(object, "radius", json_number(r->radius));
    json_object_set_new(object, "growth_rate", number_in(unit, GOUGH_UNIT_RATE, r->growth));
    json_object_set_new(object, "decays", json_boolean(r->decaying));
    json_object_set_new(object, "window", window);
    json_object_set_new(object, "lower", edge_object(unit, m, &m->lower));
    json_object_set_new(object, "upper", edge_object(unit, m, &m->upper));
    json_object_set_new(object, "longest_period",
                        number_in(unit, GOUGH_UNIT_TIME, m->longest_period));
    json_object_set_new(object, "longest_delay",
                        number_in(unit, GOUGH_UNIT_TIME, m->longest_delay));
    json_object_set_new(object, "best", best);
    json_object_set_new(object, "period_limit", number_in(unit, GOUGH_UNIT_TIME, m->period_limit));
    json_object_set_new(object, "least_mass", number_in(unit, GOUGH_UNIT_MASS, r->mass));
    json_object_set_new(object, "command_noise", six_in(unit, GOUGH_UNIT_FORCE, r->noise));
    json_object_set_new(object, "command_count", six_in(unit, GOUGH_UNIT_FORCE, r->count));
    return object;
}
