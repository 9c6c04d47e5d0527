/* The section `sweep` of a study: checked beyond the table of keys, counted, and evaluated for a run.
 *
 * Of a product the last key changes fastest. Draws are counted by run and key, so that each run is had without the others. */
#include "study/sweep_plan.h"

#include "gough/random.h"

#include <math.h>
#include <string.h>

#include "study/swept_number.h"
#include "study/value.h"

static const double MOST_RUNS = 1e8;
enum { MOST_KEYS = 1000 };

/* ---- what one key varies over ----------------------------------------------------------------------------------- */

/* The one of several ways to vary a key that is given; NULL with an error if none or several are given. */
static study_node *find_way(study_messages *messages, study_node *node) {
    study_node *found = NULL;
    for (study_node *child = node->first; child; child = child->next) {
        const char *name = child->key->text;
        const bool grid = strcmp(name, "uniform") != 0 && strcmp(name, "normal") != 0;
        if (!found)
            found = child;
        else if (!grid || strcmp(found->key->text, "uniform") == 0 ||
                 strcmp(found->key->text, "normal") == 0) {
            study_node_say(messages, child, study_node_place(child, true),
                           "`%s` has both `%s` and `%s`; give a grid, uniform or normal",
                           study_node_path(messages->arena, node), name, found->key->text);
            return NULL;
        }
    }
    if (!found)
        study_say_shape(messages, node,
                        "a grid {from: 1, to: 10, steps: 10}, {uniform: [low, "
                        "high]} or {normal: [mean, deviation]}");
    return found;
}

static bool read_grid(study_messages *messages, study_node *node, gough_sweep_key *key) {
    static const char *const names[] = {"from", "to", "steps"};
    double value[3];
    const study_node *scale = study_node_child(node, "scale");
    for (size_t i = 0; i < 3; i++) {
        const study_node *child = study_node_child(node, names[i]);
        if (!child) {
            study_node_say(messages, node, study_node_place(node, true),
                           "`%s.%s` is missing: a grid needs from, to and steps",
                           study_node_path(messages->arena, node), names[i]);
            return false;
        }
        value[i] = study_number(child);
    }
    key->kind = GOUGH_SWEEP_GRID;
    key->least = value[0];
    key->greatest = value[1];
    key->count = (size_t)value[2];
    key->logarithmic = scale && strcmp(scale->text, "log") == 0;
    if (!key->logarithmic || (value[0] > 0 && value[1] > 0)) return true;
    study_node_say(messages, node, study_node_place(node, true),
                   "`%s` has a logarithmic scale: its ends must be greater than 0",
                   study_node_path(messages->arena, node));
    return false;
}

static bool read_distribution(study_messages *messages, study_node *way, gough_sweep_key *key) {
    const bool uniform = strcmp(way->key->text, "uniform") == 0;
    key->kind = uniform ? GOUGH_SWEEP_UNIFORM : GOUGH_SWEEP_NORMAL;
    key->least = study_number(way->first);
    key->greatest = study_number(way->last);
    if (uniform ? key->least < key->greatest : key->greatest >= 0) return true;
    study_node_say(messages, way, study_node_place(way, false), "`%s` must be %s",
                   study_node_path(messages->arena, way),
                   uniform ? "[low, high], the lower first"
                           : "[mean, deviation], the deviation 0 or greater");
    return false;
}

static bool read_list(study_arena *arena, const study_node *node, study_axis *axis) {
    double *list = study_arena_take(arena, node->count * sizeof *list);
    if (!list) return false;
    axis->list = list;
    axis->key.kind = GOUGH_SWEEP_LIST;
    axis->key.count = node->count;
    axis->key.least = INFINITY;
    axis->key.greatest = -INFINITY;
    for (const study_node *item = node->first; item; item = item->next) {
        *list = study_number(item);
        axis->key.least = fmin(axis->key.least, *list);
        axis->key.greatest = fmax(axis->key.greatest, *list++);
    }
    return true;
}

static bool read_axis(study_messages *messages, study_node *root, study_node *node,
                      study_axis *axis) {
    *axis = (study_axis){.node = node};
    axis->key.path = node->key->text;
    if (!study_target_find(messages, root, axis)) return false;
    if (node->kind == STUDY_LIST) return read_list(messages->arena, node, axis);
    study_node *way = find_way(messages, node);
    if (!way) return false;
    const char *name = way->key->text;
    if (strcmp(name, "uniform") != 0 && strcmp(name, "normal") != 0)
        return read_grid(messages, node, &axis->key);
    return read_distribution(messages, way, &axis->key);
}

/* ---- all of them together --------------------------------------------------------------------------------------- */

/* No key may vary within another: control.stiffness and control.stiffness.2. */
static bool check_overlap(study_messages *messages, const study_plan *plan, size_t n) {
    const char *path = plan->axis[n].key.path;
    for (size_t i = 0; i < n; i++) {
        const char *other = plan->axis[i].key.path;
        const size_t length = strlen(path), other_length = strlen(other);
        const size_t least = length < other_length ? length : other_length;
        const char next = length < other_length ? other[least] : path[least];
        if (strncmp(path, other, least) != 0) continue;
        if (next != '.') continue; /* unreachable: no key's name begins with another's */
        study_node_say(messages, plan->axis[n].node, study_node_place(plan->axis[n].node, true),
                       "`%s` and `%s` set the same number", path, other);
        return false;
    }
    return true;
}

static bool check_zip(study_messages *messages, const study_plan *plan) {
    const study_axis *first = NULL;
    for (size_t i = 0; i < plan->axes; i++) {
        const study_axis *axis = &plan->axis[i];
        if (axis->key.count == 0) continue;
        if (first && axis->key.count != first->key.count) {
            study_node_say(messages, axis->node, study_node_place(axis->node, true),
                           "`%s` has %zu values, but `%s` has %zu; `combine: zip` needs the same "
                           "number of each",
                           axis->key.path, axis->key.count, first->key.path, first->key.count);
            return false;
        }
        if (!first) first = axis;
    }
    return true;
}

static bool count_runs(study_messages *messages, study_node *sweep, study_plan *plan) {
    study_node *runs = study_node_child(sweep, "runs");
    double count = 0;
    for (size_t i = 0; i < plan->axes; i++) {
        const double values = (double)plan->axis[i].key.count;
        if (values > 0) count = count > 0 && !plan->zipped ? count * values : values;
    }
    if (count > 0 && runs) {
        study_node_say(messages, runs, study_node_place(runs, true),
                       "`sweep.runs` is only for sweeps of distributions; remove it, because the "
                       "grids and lists here make %.0f runs",
                       count);
        return false;
    }
    if (!(count > 0) && !runs) {
        study_node_say(messages, sweep, study_node_place(sweep, true),
                       "`sweep.runs` is missing: it sets the number of runs if all keys have "
                       "distributions");
        return false;
    }
    if (count > MOST_RUNS) {
        study_node_say(messages, sweep, study_node_place(sweep, true),
                       "the sweep has %.3g runs; at most 1e8 are possible", count);
        return false;
    }
    plan->runs = (size_t)(count > 0 ? count : study_number(runs));
    return true;
}

bool study_plan_make(study_messages *messages, study_node *root, study_plan *plan) {
    study_node *sweep = study_node_child(root, "sweep");
    *plan = (study_plan){.axis = NULL};
    if (!sweep || sweep->wrong) return false;
    study_node *keys = study_node_child(sweep, "keys");
    const study_node *seed = study_node_child(sweep, "seed");
    const study_node *combine = study_node_child(sweep, "combine");
    if (keys->count > MOST_KEYS) {
        study_node_say(messages, keys, study_node_place(keys, true),
                       "`sweep.keys` has %zu keys; at most 1000 can vary", keys->count);
        return false;
    }
    plan->axis = study_arena_take(messages->arena, keys->count * sizeof *plan->axis);
    if (!plan->axis) return false;
    plan->seed = seed ? (size_t)study_number(seed) : 0;
    plan->zipped = combine && strcmp(combine->text, "zip") == 0;
    size_t draws = 0;
    bool good = true;
    for (study_node *node = keys->first; node; node = node->next) {
        study_axis *axis = &plan->axis[plan->axes];
        if (!read_axis(messages, root, node, axis) || !check_overlap(messages, plan, plan->axes)) {
            good = false;
            continue;
        }
        if (axis->key.count == 0) axis->draw = draws++;
        plan->axes++;
    }
    if (!good) return false;
    return (!plan->zipped || check_zip(messages, plan)) && count_runs(messages, sweep, plan);
}

/* ---- values ------------------------------------------------------------------------------------------------------ */

/* a·10^e, which is within a double's range where 10^e alone may not be: 1e-200·10^300. */
static double scaled(double a, double e) {
    enum { PIECE = 300 };
    for (; e > PIECE; e -= PIECE) a *= 1e300;
    for (; e < -PIECE; e += PIECE) a *= 1e-300;
    return a * pow(10, e);
}

/* from + (to − from) x, whose difference may be beyond the range of a double. */
static double between(double from, double to, double x) {
    const double difference = to - from;
    return isfinite(difference) ? from + difference * x : from * (1 - x) + to * x;
}

/* Both ends exactly; equal ratios through powers of ten, so that decades come out as they are written. */
static double grid_value(const gough_sweep_key *key, size_t n) {
    if (n == 0) return key->least;
    if (n == key->count - 1) return key->greatest;
    const double part = (double)n, whole = (double)(key->count - 1);
    if (!key->logarithmic) {
        const double difference = key->greatest - key->least;
        if (isfinite(difference)) return key->least + difference * part / whole;
        return between(key->least, key->greatest, part / whole);
    }
    const double ratio = key->greatest / key->least;
    if (isnormal(ratio)) return key->least * pow(10, log10(ratio) * part / whole);
    return scaled(key->least, (log10(key->greatest) - log10(key->least)) * part / whole);
}

static double axis_value(const study_plan *plan, const study_axis *axis, size_t run, size_t n) {
    const gough_sweep_key *key = &axis->key;
    switch (key->kind) { /* unreachable: there is a case for each kind */
    case GOUGH_SWEEP_GRID:
        return grid_value(key, n);
    case GOUGH_SWEEP_LIST:
        return axis->list[n];
    case GOUGH_SWEEP_UNIFORM:
        return between(key->least, key->greatest,
                       gough_random_uniform(plan->seed, run, axis->draw));
    case GOUGH_SWEEP_NORMAL:
        return key->least + key->greatest * gough_random_normal(plan->seed, run, axis->draw);
    }
    return NAN;
}

void study_plan_values(const study_plan *plan, size_t run, double *value) {
    size_t rest = run - 1;
    for (size_t i = plan->axes; i-- > 0;) {
        const study_axis *axis = &plan->axis[i];
        const size_t count = axis->key.count;
        size_t n = 0;
        if (count > 0) {
            n = plan->zipped ? run - 1 : rest % count;
            if (!plan->zipped) rest /= count;
        }
        value[i] = axis_value(plan, axis, run, n);
    }
}
