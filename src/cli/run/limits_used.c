/* How much of each limit of the legs a run uses: the nearest that each leg comes to it, how often and when it is exceeded. */
#include "cli/run/limits_used.h"
#include "cli/common/scale.h"

#include <math.h>

#define LIMIT(member) offsetof(gough_platform, member)

static const struct {
    gough_cause cause;
    const char *name;
    gough_unit unit;
    size_t at; /* in the platform */
} kinds[LIMIT_KINDS] = {
    {GOUGH_END_LEG_SHORT, "least length", GOUGH_UNIT_LENGTH, LIMIT(length_min)},
    {GOUGH_END_LEG_LONG, "greatest length", GOUGH_UNIT_LENGTH, LIMIT(length_max)},
    {GOUGH_END_LEG_SPEED, "greatest speed", GOUGH_UNIT_SPEED, LIMIT(speed_max)},
    {GOUGH_END_LEG_FORCE, "greatest force", GOUGH_UNIT_FORCE, LIMIT(force_max)}};

static const char *kind_name(gough_cause cause) {
    for (int k = 0; k < LIMIT_KINDS; k++)
        if (kinds[k].cause == cause) return kinds[k].name;
    return gough_cause_name(cause);
}

gough_unit limit_unit(gough_cause cause) {
    for (int k = 0; k < LIMIT_KINDS; k++)
        if (kinds[k].cause == cause) return kinds[k].unit;
    return GOUGH_UNIT_LENGTH;
}

static const char *kind_unit(gough_cause cause, const gough_units *unit) {
    return unit_word(unit, limit_unit(cause));
}

/* of one of the kinds, in the units of the output; 0 or INFINITY: none */
static double limit_of(const run_report *report, int kind) {
    const char *platform = (const char *)&report->study->model->machine.platform;
    const double limit = *(const double *)(const void *)(platform + kinds[kind].at);
    return gough_unit_factor(&report->units, kinds[kind].unit) * limit;
}

/* the value of a leg that is nearest to its limit, or furthest beyond */
static double extreme_of(const gough_leg_summary *leg, gough_cause cause) {
    if (cause == GOUGH_END_LEG_SHORT) return leg->length_min;
    if (cause == GOUGH_END_LEG_LONG) return leg->length_max;
    if (cause == GOUGH_END_LEG_SPEED) return leg->speed;
    return fabs(leg->force_min) > fabs(leg->force_max) ? leg->force_min : leg->force_max;
}

static double share_of(gough_cause cause, double limit, double worst) {
    return cause == GOUGH_END_LEG_SHORT ? limit / worst : fabs(worst) / limit;
}

/* Takes an excess in. *largest: the largest share of those so far. The peaks of the motion, which use->worst begins with, lie
 * between looks, beyond what any excess has seen. */
static void add_crossing(limit_use *use, const gough_crossing *c, double *largest) {
    const double share = share_of(use->kind, use->limit, c->worst);

    if (use->count == 0 || c->enter < use->enter) use->enter = c->enter;
    if (use->count == 0)
        use->leave = c->leave;
    else
        use->leave = fmax(use->leave, c->leave);
    if (share > *largest) {
        *largest = share;
        use->worst_time = c->worst_time;
    }
    if (share > share_of(use->kind, use->limit, use->worst))
        use->worst = use->kind == GOUGH_END_LEG_SPEED ? fabs(c->worst) : c->worst;
    use->count++;
}

/* how a run of simulate ended: its legs exceed the limit from then on */
static void add_end(limit_use *use, const gough_end *end) {
    if (end->cause != use->kind || !(end->legs >> (use->leg - 1) & 1)) return;
    if (!(share_of(use->kind, use->limit, use->worst) >= 1)) use->worst = end->limit;
    use->count = 1;
    use->enter = use->worst_time = end->time;
}

int limits_used(const run_report *report, limit_use use[MOST_LIMITS]) {
    int count = 0;
    if (report->summary.rows == 0) return 0;
    for (int k = 0; k < LIMIT_KINDS; k++) {
        const gough_cause cause = kinds[k].cause;
        const double limit = limit_of(report, k);
        if (!(limit > 0) || !isfinite(limit)) continue;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            limit_use *u = &use[count++];
            *u = (limit_use){.leg = v + 1, .kind = cause, .limit = limit};
            u->worst = extreme_of(&report->summary.leg[v], cause);
            u->enter = u->leave = u->worst_time = NAN;
            double largest = 0;
            for (size_t i = 0; i < report->crossings.count; i++) {
                const gough_crossing *c = &report->crossings.list[i];
                if (c->cause == cause && c->leg == v + 1) add_crossing(u, c, &largest);
            }
            if (report->simulated) add_end(u, &report->end);
            if (!isfinite(u->leave)) u->leave = NAN;
            u->share = share_of(cause, limit, u->worst);
        }
    }
    return count;
}

/* "t = 3 to 8 s", "t = 3 s to the end" */
static void print_when(FILE *stream, const limit_use *u, bool ends, const char *time) {
    if (isfinite(u->leave))
        fprintf(stream, "t = %.6g to %.6g%s", u->enter, u->leave, time);
    else
        fprintf(stream, "t = %.6g%s%s", u->enter, time,
                ends ? ", where the run ends" : " to the end");
}

static void print_exceeded(FILE *stream, const limit_use *u, bool ends, const gough_units *unit) {
    const char *of = kind_unit(u->kind, unit);
    fprintf(stream, "    leg %d %-16s %.5g%s of %.5g%s, %.4g %%, ", u->leg, kind_name(u->kind),
            u->worst, of, u->limit, of, 100 * u->share);
    if (u->count > 1) fprintf(stream, "%zu times, ", u->count);
    print_when(stream, u, ends, unit_word(unit, GOUGH_UNIT_TIME));
    fprintf(stream, "\n");
}

/* a limit that no leg exceeds, and the leg that comes nearest */
static void print_met(FILE *stream, const limit_use use[GOUGH_LEGS], const gough_units *unit) {
    const char *of = kind_unit(use->kind, unit);
    const limit_use *nearest = use;
    for (int v = 1; v < GOUGH_LEGS; v++)
        if (use[v].share > nearest->share) nearest = &use[v];
    fprintf(stream, "    %-22s %.5g%s of %.5g%s, %.4g %%, leg %d\n", kind_name(use->kind),
            nearest->worst, of, use->limit, of, 100 * nearest->share, nearest->leg);
}

static void print_list(FILE *stream, const run_report *report, const gough_units *unit) {
    for (size_t i = 0; i < report->crossings.count; i++) {
        const gough_crossing *c = &report->crossings.list[i];
        fprintf(stream, "    leg %d %-16s t = %.6g", c->leg, kind_name(c->cause), c->enter);
        if (isfinite(c->leave))
            fprintf(stream, " to %.6g%s", c->leave, unit_word(unit, GOUGH_UNIT_TIME));
        else
            fprintf(stream, "%s to the end", unit_word(unit, GOUGH_UNIT_TIME));
        fprintf(stream, ", at worst %.6g%s at t = %.6g%s\n", c->worst, kind_unit(c->cause, unit),
                c->worst_time, unit_word(unit, GOUGH_UNIT_TIME));
    }
}

void limits_print(FILE *stream, const run_report *report, bool all) {
    const gough_units *unit = &report->units;
    limit_use use[MOST_LIMITS];
    const int count = limits_used(report, use);
    if (count == 0) return;
    fprintf(stream, "  limits      nearest value, limit, share of the limit used%s\n",
            report->crossings.count ? "; over 100 % means exceeded" : "");
    for (int first = 0; first < count; first += GOUGH_LEGS) {
        int exceeded = 0;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            if (use[first + v].count == 0) continue;
            print_exceeded(stream, &use[first + v], report->simulated, unit);
            exceeded++;
        }
        if (!exceeded) print_met(stream, &use[first], unit);
    }
    if (!all || report->crossings.count == 0) return;
    fprintf(stream, "  every interval in which a limit is exceeded:\n");
    print_list(stream, report, unit);
}
