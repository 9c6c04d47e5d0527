/* The public face of a run: options with defaults and checks, the choice of precision. */
#include "gough/simulate.h"

#include <math.h>

#include "base/quantity.h"
#include "gough/sizes.h"
#include "model/places.h"
#include "plant/can_move.h"
#include "program/program_valid.h"
#include "run/prefetch.h"
#include "run/run.h"
#include "run/summary_limits.h"

/* more rows than this are a mistake, not a study */
static const double most_rows = 1e8;

/* more fixed steps than this take days, and near 2^53 the times of two steps are one number */
static const double most_steps = 1e12;

/* knots of the noise, which are whole numbers of 64 bits */
static const double most_knots = 1e12;

static const char *const method_names[GOUGH_METHODS] = {"dop853",  "rk4",     "rattle2",
                                                        "rattle4", "rattle6", "rattle8"};

const char *gough_method_name(int method) {
    return method >= 0 && method < GOUGH_METHODS ? method_names[method] : NULL;
}

gough_status gough_simulation_init(gough_simulation *simulation, size_t size) {
    size_t count;
    const gough_place *place = gough_places(&count);

    if (size != sizeof *simulation) return gough_size_refuse(simulation, size);
    *simulation = (gough_simulation){.size = size};
    for (size_t i = 0; i < count; i++)
        if (place[i].owner == GOUGH_OWNER_SIMULATION) gough_place_reset(&place[i], simulation);
    return GOUGH_OK;
}

static bool positive(double x) { return x > 0 && isfinite(x); }

static gough_status check_times(const gough_simulation *s, gough_error *error) {
    if (!positive(s->duration)) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.duration",
                              "simulation.duration must be a finite number > 0, not %.9g" IN_TIME,
                              s->duration);
    }
    if (!positive(s->output_step)) {
        return gough_fail_key(
            error, GOUGH_ERROR_INPUT, "simulation.output_step",
            "simulation.output_step must be a finite number > 0, not %.9g" IN_TIME, s->output_step);
    }
    if (!(s->max_step >= 0) || !isfinite(s->max_step)) {
        return gough_fail_key(
            error, GOUGH_ERROR_INPUT, "simulation.max_step",
            "simulation.max_step must be a finite number > 0, or 0 for no limit, not "
            "%.9g",
            s->max_step);
    }
    if (s->duration / s->output_step > most_rows) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.output_step",
                              "simulation.output_step %.9g" IN_TIME
                              " gives more than 1e8 rows in a duration "
                              "of %.9g" IN_TIME "; choose a longer one",
                              s->output_step, s->duration);
    }
    return GOUGH_OK;
}

static gough_status check_step(const gough_simulation *s, gough_error *error) {
    const double ratio = s->output_step / s->step;

    if (s->max_step > 0 && s->step > s->max_step * (1 + division_slack)) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.step",
                              "simulation.step %.9g" IN_TIME
                              " is longer than simulation.max_step %.9g" IN_TIME,
                              s->step, s->max_step);
    }

    if (!positive(s->step)) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.step",
                              "simulation.step must be a finite number > 0 for the method %s",
                              gough_method_name((int)s->method));
    }
    if (ratio < 1 - division_slack || fabs(ratio - round(ratio)) > division_slack * ratio) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.step",
                              "simulation.step %.9g" IN_TIME
                              " does not divide simulation.output_step %.9g" IN_TIME "; the "
                              "nearest that does is %.17g" IN_TIME,
                              s->step, s->output_step, s->output_step / fmax(1, round(ratio)));
    }
    if (!(s->duration / s->step <= most_steps)) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.step",
                              "simulation.step %.9g" IN_TIME
                              " gives more than 1e12 steps in a duration of "
                              "%.9g" IN_TIME "; choose a longer one",
                              s->step, s->duration);
    }
    return GOUGH_OK;
}

static gough_status check_tolerance(const gough_simulation *s, gough_error *error) {
    const double least = s->precision == GOUGH_QUADRUPLE ? 1e-30 : 1e-15;

    if (!(s->tolerance >= least && s->tolerance <= 0.1)) {
        return gough_fail_key(
            error, GOUGH_ERROR_INPUT, "simulation.tolerance",
            "simulation.tolerance must be between %g and 0.1 in %s precision, not %.9g", least,
            s->precision == GOUGH_QUADRUPLE ? "quadruple" : "double", s->tolerance);
    }
    return GOUGH_OK;
}

static gough_status check_constraints(const gough_simulation *s, gough_error *error) {
    if (s->constraints != GOUGH_BAUMGARTE) return GOUGH_OK;
    for (int i = 0; i < 2; i++) {
        if (!(s->baumgarte[i] >= 0) || !isfinite(s->baumgarte[i])) {
            return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.constraints",
                                  "simulation.constraints.baumgarte takes two finite numbers >= 0, "
                                  "alpha and beta");
        }
    }
    if (s->method >= GOUGH_RATTLE2) {
        return gough_fail_key(
            error, GOUGH_ERROR_INPUT, "simulation.constraints",
            "simulation.constraints: the method %s keeps the constraints by "
            "construction and takes no Baumgarte terms; use dop853 or rk4 with them",
            gough_method_name((int)s->method));
    }
    return GOUGH_OK;
}

static gough_status check_samples(const gough_motion *motion, const gough_simulation *s,
                                  gough_error *error) {
    const gough_samples *samples = &motion->samples;
    double first, last;

    if (motion->kind != GOUGH_MOTION_SAMPLES) return GOUGH_OK;
    first = samples->time[0];
    last = samples->time[samples->count - 1];
    if (motion->scaled) first /= motion->frequency, last /= motion->frequency;
    if (first > 0 || last < s->duration * (1 - division_slack)) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.duration",
                              "simulation.duration: the run from 0 to %.9g" IN_TIME
                              " extends beyond the "
                              "recorded motion, which covers %.9g" IN_TIME " to %.9g" IN_TIME,
                              s->duration, first, last);
    }
    return GOUGH_OK;
}

/* what RATTLE's steps need, which are those of a body alone under forces linear in its rates; NULL: all is there */
static const char *rattle_needs(const gough_machine *machine, const gough_control *control) {
    const gough_actuators *drives = &machine->platform.actuators;
    const bool sampled = control->sampling.period > 0;
    bool damped = false, summed = false, limited = false;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        damped |= control->damping[v] > 0;
        summed |= control->integral[v] > 0;
        limited |= drives->max_force[v][0] < drives->max_force[v][1];
    }
    if (machine_has_dry_friction(machine)) return "legs without dry friction";
    if (drives->kind == GOUGH_ACTUATOR_LAG) return "drives without lag";
    if (sampled) return NULL;
    if (summed) return "a controller without integral, or a sampled one";
    if (control->coupled) return "gains that are no matrices, or a sampled controller";
    return limited && damped ? "drives without max_force, no damping, or a sampled controller"
                             : NULL;
}

static gough_status check_rattle(const gough_machine *machine, const gough_control *control,
                                 const gough_simulation *s, gough_error *error) {
    const char *needs = s->method < GOUGH_RATTLE2 ? NULL : rattle_needs(machine, control);

    if (needs == NULL) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.method",
                          "simulation.method: the method %s needs %s; use dop853 or rk4 here",
                          gough_method_name((int)s->method), needs);
}

gough_status simulate_check_legs(const gough_machine *machine, const gough_control *control,
                                 const gough_simulation *simulation, gough_error *error) {
    const gough_status status = machine_can_move(machine, error);

    return status == GOUGH_OK ? check_rattle(machine, control, simulation, error) : status;
}

gough_status gough_simulation_check(const gough_model *model, const gough_simulation *simulation,
                                    gough_error *error) {
    const gough_noise *noise = &model->disturbance.noise;
    const bool noisy = noise->leg_force > 0 || noise->force > 0 || noise->moment > 0;
    gough_status status = simulate_check(&model->motion, simulation, error);

    if (status == GOUGH_OK)
        status = check_rattle(&model->machine, &model->control, simulation, error);
    if (status == GOUGH_OK) status = simulate_check_control(&model->control, simulation, error);
    if (status != GOUGH_OK) return status;
    if (noisy && !(simulation->duration / noise->interval <= most_knots)) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "disturbance.noise.interval",
                              "disturbance.noise.interval %.9g" IN_TIME
                              " gives more than 1e12 knots in a run "
                              "of %.9g" IN_TIME "; choose a longer one",
                              noise->interval, simulation->duration);
    }
    return GOUGH_OK;
}

gough_status simulate_check(const gough_motion *motion, const gough_simulation *simulation,
                            gough_error *error) {
    const gough_simulation *s = simulation;
    gough_status status =
        gough_size_check(s->size, sizeof(gough_simulation), "gough_simulation", error);

    if (status == GOUGH_OK) status = check_times(s, error);
    if (status != GOUGH_OK) return status;
    if (gough_method_name((int)s->method) == NULL) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.method",
                              "simulation.method: %d is not a method", (int)s->method);
    }
    if (s->precision != GOUGH_DOUBLE && s->precision != GOUGH_QUADRUPLE) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.precision",
                              "simulation.precision: %d is neither double nor quadruple precision",
                              (int)s->precision);
    }
    if (s->constraints != GOUGH_PROJECTION && s->constraints != GOUGH_NONE &&
        s->constraints != GOUGH_BAUMGARTE) {
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.constraints",
                              "simulation.constraints: %d is neither projection nor none nor "
                              "Baumgarte's stabilisation",
                              (int)s->constraints);
    }
    status = motion_check(motion, error);
    if (status != GOUGH_OK) return status;
    if (s->method == GOUGH_DOP853 && fabs(s->step) <= 0) {
        status = check_tolerance(s, error);
    } else {
        status = check_step(s, error);
    }
    if (status == GOUGH_OK) status = check_constraints(s, error);
    if (status == GOUGH_OK) status = check_samples(motion, s, error);
    return status;
}

const struct simulate_table *simulate_table_of(gough_precision precision) {
#if defined(__x86_64__)
    static const struct simulate_table *const by_lanes[] = {
        [2] = &simulate_double, [4] = &simulate_double_4, [8] = &simulate_double_8};
    const struct simulate_table *in_double = by_lanes[prefetch_lanes()];
#else
    const struct simulate_table *in_double = &simulate_double;
#endif
    return precision == GOUGH_QUADRUPLE ? &simulate_quad : in_double;
}

static simulate_parts parts_of(const gough_model *model) {
    return (simulate_parts){&model->motion,
                            &model->machine,
                            &model->control,
                            &model->disturbance,
                            &model->initial,
                            model->disturbance.noise.run,
                            model->control.sampling.run};
}

static void begin_summary(const gough_model *model, gough_summary *summary) {
    gough_summary_begin(summary);
    summary->order = model->motion.order;
    summary_limits_begin(summary, &model->machine, &model->motion);
}

/* an end that is the input's fault is its error's sentence too */
static gough_status finish(gough_status status, const gough_end *end, gough_error *error) {
    if (status == GOUGH_OK) return status;
    return gough_fail(error, status, "%s", end->message);
}

gough_status gough_forces(const gough_model *model, const gough_simulation *simulation,
                          gough_sink sink, void *context, gough_crossing_sink crossings,
                          void *crossings_context, gough_end *end, gough_error *error) {
    const gough_status checked = gough_simulation_check(model, simulation, error);

    *end = (gough_end){.cause = GOUGH_END_DONE};
    if (checked != GOUGH_OK) return checked;
    if (simulation->statistics) *simulation->statistics = (gough_statistics){.steps = 0};
    const simulate_parts parts = parts_of(model);
    if (simulation->summary) begin_summary(model, simulation->summary);
    const gough_status status =
        simulate_table_of(simulation->precision)
            ->forces(&parts, simulation, sink, context, crossings, crossings_context, end);
    if (simulation->summary) gough_summary_end(simulation->summary);
    return finish(status, end, error);
}

gough_status gough_simulate(const gough_model *model, const gough_simulation *simulation,
                            gough_sink sink, void *context, gough_end *end, gough_error *error) {
    gough_status checked = gough_simulation_check(model, simulation, error);

    if (checked == GOUGH_OK) checked = machine_can_move(&model->machine, error);
    *end = (gough_end){.cause = GOUGH_END_DONE};
    if (checked != GOUGH_OK) return checked;
    if (simulation->statistics) *simulation->statistics = (gough_statistics){.steps = 0};
    const simulate_parts parts = parts_of(model);
    if (simulation->summary) begin_summary(model, simulation->summary);
    const gough_status status =
        simulate_table_of(simulation->precision)->simulate(&parts, simulation, sink, context, end);
    if (simulation->summary) gough_summary_end(simulation->summary);
    return finish(status, end, error);
}
