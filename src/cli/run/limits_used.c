/* How much of each limit of legs and platform a run uses: the nearest that it comes to it, how often and when it is exceeded. */
#include "cli/run/limits_used.h"
#include "cli/common/scale.h"

#include <math.h>
#include <stdio.h>

/* ---- what limits there are ---- */

/* Limits of legs. Those of forces are one, of the magnitude, unless some leg may push and pull differently. */
static const struct {
    gough_cause cause;
    bool least;
    const char *name;
    gough_unit unit;
} kinds[] = {{GOUGH_END_LEG_SHORT, false, "least length", GOUGH_UNIT_LENGTH},
             {GOUGH_END_LEG_LONG, false, "greatest length", GOUGH_UNIT_LENGTH},
             {GOUGH_END_LEG_SPEED, false, "greatest speed", GOUGH_UNIT_SPEED},
             {GOUGH_END_LEG_FORCE, false, "greatest force", GOUGH_UNIT_FORCE},
             {GOUGH_END_LEG_FORCE, true, "least force", GOUGH_UNIT_FORCE},
             {GOUGH_END_LEG_ACCELERATION, false, "greatest accel.", GOUGH_UNIT_ACCELERATION},
             {GOUGH_END_BASE_SWING, false, "swing at base", GOUGH_UNIT_ANGLE},
             {GOUGH_END_TOP_SWING, false, "swing at top", GOUGH_UNIT_ANGLE}};
enum { LEG_KINDS = sizeof kinds / sizeof kinds[0] };

/* Limits of the platform, by order of derivative. */
static const struct {
    gough_cause cause;
    gough_unit unit, turning;
} orders[] = {
    {GOUGH_END_PLATFORM_POSE, GOUGH_UNIT_LENGTH, GOUGH_UNIT_ANGLE},
    {GOUGH_END_PLATFORM_SPEED, GOUGH_UNIT_SPEED, GOUGH_UNIT_ANGULAR_SPEED},
    {GOUGH_END_PLATFORM_ACCELERATION, GOUGH_UNIT_ACCELERATION, GOUGH_UNIT_ANGULAR_ACCELERATION}};
enum { ORDERS = sizeof orders / sizeof orders[0] };

gough_unit limit_unit(gough_cause cause, int component) {
    for (int k = 0; k < LEG_KINDS; k++)
        if (kinds[k].cause == cause) return kinds[k].unit;
    for (int k = 0; k < ORDERS; k++)
        if (orders[k].cause == cause)
            return component > GOUGH_ROLL ? orders[k].turning : orders[k].unit;
    return GOUGH_UNIT_LENGTH;
}

gough_end_words limit_words(const gough_units *units) {
    return (gough_end_words){.length = unit_word(units, GOUGH_UNIT_LENGTH),
                             .speed = unit_word(units, GOUGH_UNIT_SPEED),
                             .acceleration = unit_word(units, GOUGH_UNIT_ACCELERATION),
                             .force = unit_word(units, GOUGH_UNIT_FORCE),
                             .time = unit_word(units, GOUGH_UNIT_TIME),
                             .angle = unit_word(units, GOUGH_UNIT_ANGLE),
                             .angular_speed = unit_word(units, GOUGH_UNIT_ANGULAR_SPEED),
                             .angular_acceleration =
                                 unit_word(units, GOUGH_UNIT_ANGULAR_ACCELERATION)};
}

void end_scale(gough_end *end, const gough_units *units) {
    end->time *= gough_unit_factor(units, GOUGH_UNIT_TIME);
    end->limit *= gough_unit_factor(units, limit_unit(end->cause, end->component));
}

/* "leg 3 greatest force", "heave velocity, greatest"; `limit` alone without its leg */
static void name_limit(const limit_use *u, bool with_leg, char *text, size_t size) {
    static const char *const quantity[ORDERS] = {"", " velocity", " acceleration"};
    for (int k = 0; k < LEG_KINDS; k++) {
        if (kinds[k].cause != u->kind || kinds[k].least != u->least) continue;
        if (with_leg)
            snprintf(text, size, "leg %d %s", u->leg, kinds[k].name);
        else
            snprintf(text, size, "%s", kinds[k].name);
        return;
    }
    for (int k = 0; k < ORDERS; k++)
        if (orders[k].cause == u->kind)
            snprintf(text, size, "%s %s%s", u->least ? "least" : "greatest",
                     gough_component_name(u->component - 1), quantity[k]);
}

/* ---- how much of them is used ---- */

static bool is_least(const limit_use *u) { return u->least || u->kind == GOUGH_END_LEG_SHORT; }

/* The share of a limit that a value uses. A limit of the other sign than the values counts the other way round, as a least
 * length does. */
static double share_of(const limit_use *u, double value) {
    const double sign = is_least(u) ? -1 : 1, limit = sign * u->limit, x = sign * value;
    if (limit > 0) return fmax(0, x / limit);
    return limit < 0 && x < 0 ? limit / x : x <= limit && limit < 0 ? 0 : NAN;
}

/* whether a value is nearer to the limit than another, or further beyond */
static bool is_worse(const limit_use *u, double value, double than) {
    return is_least(u) ? value < than : value > than;
}

/* Takes an excess in. *largest: the worst of those so far. The peaks of the motion, which use->worst begins with, lie
 * between looks, beyond what any excess has seen. */
static void add_crossing(limit_use *use, const gough_crossing *c, bool magnitude, double *worst) {
    const double value = magnitude ? fabs(c->worst) : c->worst;
    const double before = magnitude ? fabs(use->worst) : use->worst;

    if (use->count == 0 || c->enter < use->enter) use->enter = c->enter;
    if (use->count == 0)
        use->leave = c->leave;
    else
        use->leave = fmax(use->leave, c->leave);
    if (use->count == 0 || is_worse(use, value, *worst)) {
        *worst = value;
        use->worst_time = c->worst_time;
    }
    if (is_worse(use, value, before))
        use->worst = use->kind == GOUGH_END_LEG_FORCE ? c->worst : value;
    use->count++;
}

/* how a run of simulate ended: it exceeds the limit from then on */
static void add_end(limit_use *use, const gough_end *end) {
    if (end->cause != use->kind || end->least != use->least) return;
    if (use->leg ? !(end->legs >> (use->leg - 1) & 1) : end->component != use->component) return;
    if (!is_worse(use, use->worst, end->limit)) use->worst = end->limit;
    use->count = 1;
    use->enter = use->worst_time = end->time;
}

/* completes a limit with the excesses of the run. magnitude: a force in either direction */
static void fill_use(const run_report *report, limit_use *u, bool magnitude) {
    double worst = 0;
    u->enter = u->leave = u->worst_time = NAN;
    for (size_t i = 0; i < report->crossings.count; i++) {
        const gough_crossing *c = &report->crossings.list[i];
        if (c->cause == u->kind && c->leg == u->leg && c->component == u->component &&
            c->least == u->least)
            add_crossing(u, c,
                         magnitude || u->kind == GOUGH_END_LEG_SPEED ||
                             u->kind == GOUGH_END_LEG_ACCELERATION,
                         &worst);
    }
    if (report->simulated) add_end(u, &report->end);
    if (!isfinite(u->leave)) u->leave = NAN;
    u->share = share_of(u, magnitude ? fabs(u->worst) : u->worst);
}

/* limit and extreme value of a leg, of one of the kinds */
static void leg_limit(const gough_limits *l, const gough_leg_summary *leg, bool split, int kind,
                      limit_use *u) {
    const int v = u->leg - 1;
    const double push = leg->force_max, pull = leg->force_min;
    switch (kinds[kind].cause) {
    case GOUGH_END_LEG_SHORT:
        u->limit = l->length[v][0] > 0 ? l->length[v][0] : INFINITY;
        u->worst = leg->length_min;
        break;
    case GOUGH_END_LEG_LONG:
        u->limit = l->length[v][1];
        u->worst = leg->length_max;
        break;
    case GOUGH_END_LEG_SPEED:
        u->limit = l->speed[v];
        u->worst = leg->speed;
        break;
    case GOUGH_END_LEG_FORCE:
        u->limit = u->least && !split ? INFINITY : l->force[v][u->least ? 0 : 1];
        u->worst = u->least ? pull : split || fabs(pull) <= fabs(push) ? push : pull;
        break;
    case GOUGH_END_LEG_ACCELERATION:
        u->limit = l->acceleration[v];
        u->worst = leg->acceleration;
        break;
    case GOUGH_END_BASE_SWING:
        u->limit = l->base_swing[v];
        u->worst = leg->swing_base;
        break;
    default:
        u->limit = l->top_swing[v];
        u->worst = leg->swing_top;
        break;
    }
}

/* whether some leg may push and pull differently */
static bool is_split(const gough_limits *l) {
    bool split = false;
    for (int v = 0; v < GOUGH_LEGS; v++)
        split = split || l->force[v][0] + l->force[v][1] > 0 || l->force[v][0] + l->force[v][1] < 0;
    return split;
}

static int legs_used(const run_report *report, const gough_limits *l, limit_use *use) {
    const bool split = is_split(l);
    int count = 0;
    for (int k = 0; k < LEG_KINDS; k++) {
        const double factor = gough_unit_factor(&report->units, kinds[k].unit);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            limit_use *u = &use[count];
            *u = (limit_use){.leg = v + 1, .kind = kinds[k].cause, .least = kinds[k].least};
            leg_limit(l, &report->summary.leg[v], split, k, u);
            if (!isfinite(u->limit)) continue;
            u->limit = factor * u->limit;
            fill_use(report, u, !split && u->kind == GOUGH_END_LEG_FORCE);
            count++;
        }
    }
    return count;
}

static int platform_used(const run_report *report, const gough_limits *l, limit_use *use) {
    const double(*bounds[ORDERS])[2] = {l->pose, l->rate, l->second_rate};
    int count = 0;
    for (int order = 0; order < ORDERS; order++) {
        for (int i = 0; i < 2 * GOUGH_COMPONENTS; i++) {
            const int c = i / 2, side = i % 2;
            const gough_unit unit = c >= GOUGH_ROLL ? orders[order].turning : orders[order].unit;
            if (!isfinite(bounds[order][c][side])) continue;
            limit_use *u = &use[count++];
            *u = (limit_use){.component = c + 1, .kind = orders[order].cause, .least = side == 0};
            u->limit = gough_unit_factor(&report->units, unit) * bounds[order][c][side];
            u->worst = report->summary.component[order][c][side];
            fill_use(report, u, false);
        }
    }
    return count;
}

int limits_used(const run_report *report, limit_use use[MOST_LIMITS]) {
    const gough_model *model = report->study->model;
    const gough_limits l = gough_limits_of(&model->machine, &model->motion);
    if (report->summary.rows == 0) return 0;
    const int legs = legs_used(report, &l, use);
    return legs + platform_used(report, &l, use + legs);
}

/* ---- for reading ---- */

/* "t = 3 to 8 s", "t = 3 s to the end" */
static void print_when(FILE *stream, const limit_use *u, bool ends, const char *time) {
    if (isfinite(u->leave))
        fprintf(stream, "t = %.6g to %.6g%s", u->enter, u->leave, time);
    else
        fprintf(stream, "t = %.6g%s%s", u->enter, time,
                ends ? ", where the run ends" : " to the end");
}

/* "0.5 m of 0.6 m, 83 %" */
static void print_share(FILE *stream, const limit_use *u, const char *of) {
    fprintf(stream, "%.5g%s of %.5g%s", u->worst + 0.0, of, u->limit, of);
    if (isfinite(u->share)) fprintf(stream, ", %.4g %%", 100 * u->share);
}

static void print_exceeded(FILE *stream, const limit_use *u, bool ends, const gough_units *unit) {
    char name[64] = "";
    name_limit(u, true, name, sizeof name);
    fprintf(stream, "    %-22s ", name);
    print_share(stream, u, unit_word(unit, limit_unit(u->kind, u->component)));
    fprintf(stream, ", ");
    if (u->count > 1) fprintf(stream, "%zu times, ", u->count);
    print_when(stream, u, ends, unit_word(unit, GOUGH_UNIT_TIME));
    fprintf(stream, "\n");
}

/* whether a limit is nearer than another of its group: by its share, or where that is no number by the way left */
static bool is_nearer(const limit_use *u, const limit_use *than) {
    if (isfinite(u->share) && isfinite(than->share)) return u->share > than->share;
    return fabs(u->limit - u->worst) < fabs(than->limit - than->worst);
}

/* limits of one group, none of which is exceeded: that which the run comes nearest to */
static void print_met(FILE *stream, const limit_use *use, int count, const gough_units *unit) {
    const limit_use *nearest = use;
    char name[64] = "";
    for (int i = 1; i < count; i++)
        if (is_nearer(&use[i], nearest)) nearest = &use[i];
    name_limit(nearest, false, name, sizeof name);
    fprintf(stream, "    %-22s ", name);
    print_share(stream, nearest, unit_word(unit, limit_unit(nearest->kind, nearest->component)));
    if (nearest->leg) fprintf(stream, ", leg %d", nearest->leg);
    fprintf(stream, "\n");
}

/* Limits that share a line while they are met: one kind of the legs, both sides of a component of the platform. */
static int group_size(const limit_use *use, int count) {
    int size = 1;
    while (size < count && use[size].kind == use->kind && use[size].component == use->component &&
           (use->component || use[size].least == use->least))
        size++;
    return size;
}

static void print_list(FILE *stream, const run_report *report, const gough_units *unit) {
    for (size_t i = 0; i < report->crossings.count; i++) {
        const gough_crossing *c = &report->crossings.list[i];
        const limit_use u = {
            .leg = c->leg, .component = c->component, .kind = c->cause, .least = c->least};
        char name[64] = "";
        name_limit(&u, true, name, sizeof name);
        fprintf(stream, "    %-22s t = %.6g", name, c->enter);
        if (isfinite(c->leave))
            fprintf(stream, " to %.6g%s", c->leave, unit_word(unit, GOUGH_UNIT_TIME));
        else
            fprintf(stream, "%s to the end", unit_word(unit, GOUGH_UNIT_TIME));
        fprintf(stream, ", at worst %.6g%s at t = %.6g%s\n", c->worst,
                unit_word(unit, limit_unit(c->cause, c->component)), c->worst_time,
                unit_word(unit, GOUGH_UNIT_TIME));
    }
}

void limits_print(FILE *stream, const run_report *report, bool all) {
    const gough_units *unit = &report->units;
    limit_use use[MOST_LIMITS];
    const int count = limits_used(report, use);
    if (count == 0) return;
    fprintf(stream, "  limits      nearest value, limit, share of the limit used%s\n",
            report->crossings.count ? "; over 100 % means exceeded" : "");
    for (int first = 0, size; first < count; first += size) {
        int exceeded = 0;
        size = group_size(&use[first], count - first);
        for (int i = first; i < first + size; i++) {
            if (use[i].count == 0) continue;
            print_exceeded(stream, &use[i], report->simulated, unit);
            exceeded++;
        }
        if (!exceeded) print_met(stream, &use[first], size, unit);
    }
    if (!all || report->crossings.count == 0) return;
    fprintf(stream, "  every interval in which a limit is exceeded:\n");
    print_list(stream, report, unit);
}
