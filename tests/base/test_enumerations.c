/* Every public function that is given an enumeration, by itself or in a struct, refuses values outside it: GOUGH_ERROR_INPUT, a
 * sentence, and the key of the study file if there is one. Functions without a status answer with what no value has. The table of
 * this program is complete: tests/house/test_enumerations.sh compares it with the headers. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

static const int outside[] = {-1, 997, INT_MAX, INT_MIN};
enum { OUTSIDE = sizeof outside / sizeof *outside };

static gough_model model;
static gough_simulation simulation;
static gough_map_options axes;
static gough_map map;
static gough_error error;

static void begin(void) {
    static gough_map_point point[4];
    static gough_map_row row[2];
    static gough_interval interval[2];
    memset(&model, 0, sizeof model);
    paper_machine(&model.machine);
    model.control.feedforward = true;
    set_gains(&model, 10, 1);
    set_formula(&model.motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    simulation = gough_simulation_default();
    simulation.duration = 0.1;
    axes = gough_map_options_default();
    axes.stiffness = (gough_map_range){10, 20, 2, false};
    axes.intervals = 1;
    axes.threads = 1;
    memset(row, 0, sizeof row);
    memset(interval, 0, sizeof interval);
    row[0].intervals = row[1].intervals = 1;
    map = (gough_map){point, row, interval};
    error = (gough_error){.message = ""};
}

/* ---- the functions -------------------------------------------------------------------------------------------------- */

static void *room(size_t bytes) {
    void *memory = aligned_alloc(64, (bytes + 64) / 64 * 64);
    ck_assert_ptr_nonnull(memory);
    return memory;
}

static gough_status call_move(void) {
    gough_move_fit fit;
    return gough_move_find(&model.machine, &model.motion, 0, &fit, sizeof fit, &error);
}

static gough_status call_check(void) { return gough_simulation_check(&model, &simulation, &error); }

static gough_status call_simulate(void) {
    gough_end end;
    return gough_simulate(&model, &simulation, NULL, NULL, &end, &error);
}

static gough_status call_forces(void) {
    gough_end end;
    return gough_forces(&model, &simulation, NULL, NULL, NULL, NULL, &end, &error);
}

static gough_status call_batch(void) {
    gough_batch_options o = gough_batch_options_default();
    o.lanes = o.threads = 1;
    const gough_batch_run run = {
        &model.machine, &model.control, &model.disturbance, &model.initial, 1, 0};
    gough_outcome outcome;
    void *memory = room(gough_batch_size(&o));
    const gough_status status =
        gough_batch(&model.motion, &simulation, &run, 1, &o, &outcome, memory, &error);
    free(memory);
    return status;
}

static gough_status call_range(void) {
    double least[GOUGH_COMPONENTS], greatest[GOUGH_COMPONENTS];
    return gough_motion_range(&model.motion, 1, 0.1, least, greatest, &error);
}

static gough_status call_period(void) {
    gough_period period;
    return gough_motion_period(&model.motion, &period, &error);
}

static gough_status call_linearise(void) {
    double matrix[GOUGH_LINEAR * GOUGH_LINEAR];
    return gough_linearise(&model, 0, NULL, GOUGH_LINEAR, matrix, &error);
}

static gough_status call_rest(void) {
    static gough_rest rest;
    return gough_stability_at_rest(&model, NULL, &rest, &error);
}

static gough_status call_sampled(void) {
    static gough_sampled_rest rest;
    return gough_sampled_at_rest(&model, NULL, &rest, &error);
}

static gough_status call_matrix(void) {
    const size_t size = gough_deviation_size(&model);
    double *matrix = calloc(size * size, sizeof *matrix);
    char name[GOUGH_DEVIATION_NAME];
    gough_unit unit;

    ck_assert(matrix != NULL && !gough_deviation_name(&model, size, name, &unit));
    const gough_status status = gough_matrix_at_rest(&model, NULL, size, matrix, &error);
    free(matrix);
    return status;
}

static gough_status call_margins(void) {
    static gough_sampled_margins margins;
    return gough_sampled_margins_at_rest(&model, NULL, &margins, &error);
}

static gough_status call_floquet_sampled(void) {
    static gough_sampled_floquet floquet;
    return gough_floquet_sampled(&model, NULL, &floquet, &error);
}

static gough_status call_stiffness(void) {
    static gough_stiffness stiffness;
    return gough_stiffness_at_rest(&model, NULL, &stiffness, &error);
}

static gough_status call_floquet(void) {
    static gough_floquet floquet;
    return gough_floquet_multipliers(&model, NULL, 0, &floquet, &error);
}

static gough_status call_map_size(void) {
    size_t bytes;
    return gough_map_size(&model, &axes, &bytes, &error);
}

static gough_status call_map_find(void) {
    gough_map_options good = axes;
    size_t bytes;
    good.axis = GOUGH_MAP_NONE;
    ck_assert_int_eq(gough_map_size(&model, &good, &bytes, NULL), GOUGH_OK);
    void *memory = room(bytes);
    const gough_status status = gough_map_find(&model, &axes, &map, memory, &error);
    free(memory);
    return status;
}

static gough_status call_map_draw(void) {
    const gough_map_figure figure = {.title = ""};
    return gough_map_draw(&axes, &map, &figure, "no-such-folder/map.svg", &error);
}

static gough_tuning_options request(void) {
    gough_tuning_options o = gough_tuning_options_default();
    o.deviation = 0.01;
    o.threads = 1;
    return o;
}

static gough_status call_tune(void) {
    static gough_tuning tuning;
    static gough_tuning_point point[GOUGH_TUNING_POINTS];
    const gough_tuning_options o = request();
    gough_model *good = malloc(sizeof *good);
    size_t bytes;
    ck_assert_ptr_nonnull(good);
    *good = model;
    good->motion.kind = GOUGH_MOTION_FORMULAS;
    good->motion.order = GOUGH_ZYX;
    ck_assert_int_eq(gough_tune_size(good, &o, &bytes, NULL), GOUGH_OK);
    free(good);
    void *memory = room(bytes);
    const gough_status status =
        gough_tune(&model, &simulation, true, &o, point, &tuning, memory, &error);
    free(memory);
    return status;
}

static gough_status call_damping(void) {
    double damping;
    return gough_damping_for_ratio(&model, 0.1, &damping, &error);
}

static gough_status call_poles(void) {
    gough_gains gains;
    return gough_gains_by_poles(&model, NULL, 1, 0.5, &gains, &error);
}

static gough_status call_lqr(void) {
    gough_gains gains;
    return gough_gains_by_lqr(&model, NULL, 1, 1, &gains, &error);
}

static int component;

static gough_status call_low_pass(void) {
    double time[5] = {0, 1, 2, 3, 4}, value[5 * GOUGH_COMPONENTS] = {0}, scratch[100];
    ck_assert_uint_le(gough_samples_smooth_scratch(5), 100);
    return gough_samples_low_pass(5, time, value, component, 0.1, scratch, &error);
}

static gough_status call_smooth(void) {
    double time[5] = {0, 1, 2, 3, 4}, value[5 * GOUGH_COMPONENTS] = {0}, scratch[100], cutoff;
    return gough_samples_smooth(5, time, value, component, 0.1, 1, &cutoff, scratch, &error);
}

static gough_status call_flat(void) {
    gough_model *copy = malloc(sizeof *copy);
    gough_simulation options;
    const size_t count = gough_model_flat_size(&model);
    double *flat = malloc(count * sizeof *flat);
    ck_assert(copy && flat);
    gough_model_flatten(&model, &simulation, flat);
    const gough_status status = gough_model_unflatten(copy, &options, NULL, flat, count, &error);
    free(flat);
    free(copy);
    return status;
}

static gough_status call_control(void) { return gough_control_check(&model.control, &error); }

static gough_status call_plant(void) {
    void *memory = room(gough_plant_size());
    simulation.step = 0.05;
    const gough_status status = gough_plant_begin(memory, &model, &simulation, NULL, NULL, &error);
    free(memory);
    return status;
}

static gough_status call_fleet(void) {
    const gough_machine *machine = &model.machine;
    void *memory = room(gough_fleet_size(1));
    simulation.step = 0.05;
    const gough_status status = gough_fleet_begin(memory, &machine, 1, &simulation, &error);
    free(memory);
    return status;
}

static gough_status call_machine(void) {
    gough_machine machine;
    return gough_machine_init(&machine, &model.machine.platform, &model.machine.load,
                              model.machine.gravity, &error);
}

/* a reach of the model with its order of angles, whatever that is */
static const gough_reach *reach_of_order(void) {
    static gough_model right;
    static gough_reach reach;
    right = model;
    right.motion.order = GOUGH_ZYX;
    ck_assert_int_eq(gough_reach_init(&reach, sizeof reach, &right, NULL), GOUGH_OK);
    reach.order = model.motion.order;
    return &reach;
}
static const gough_box small_box = {{-0.01, 0, 0, 0, 0, 0}, {0.01, 0, 0, 0, 0, 0}};

static gough_status call_reach(void) {
    gough_reach reach;
    return gough_reach_init(&reach, sizeof reach, &model, &error);
}

static gough_status call_certify(void) {
    gough_certificate found;
    return gough_box_certify(reach_of_order(), &small_box, &found, &error);
}

static gough_status call_travel(void) {
    gough_travel travel;
    return gough_workspace_travel(reach_of_order(), component, &travel, &error);
}

static gough_status call_ray(void) {
    const double home[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
    gough_ray ray;
    return gough_workspace_ray(reach_of_order(), home, small_box.greatest, &ray, &error);
}

static gough_status call_largest(void) {
    gough_largest_box largest;
    return gough_workspace_box(reach_of_order(), &small_box, &largest, &error);
}

static gough_status call_envelope(void) {
    gough_envelope envelope;
    return gough_workspace_envelope(reach_of_order(), &small_box, &envelope, &error);
}

static gough_status call_volume(void) {
    const double level[3] = {0, 0, 0};
    gough_volume volume;
    return gough_workspace_volume(reach_of_order(), level, &volume, &error);
}

/* ---- the values ------------------------------------------------------------------------------------------------------ */

static void set_method(int value) { simulation.method = (gough_method)value; }
static void set_precision(int value) { simulation.precision = (gough_precision)value; }
static void set_constraints(int value) { simulation.constraints = (gough_constraints)value; }
static void set_motion(int value) { model.motion.kind = (gough_motion_kind)value; }
static void set_order(int value) { model.motion.order = (gough_order)value; }
static void set_axis(int value) { axes.axis = (gough_map_axis)value; }
static void set_interval(int value) { map.interval[0].kind = (gough_interval_kind)value; }
static void set_drive(int value) {
    model.machine.platform.actuators.kind = (gough_actuator_kind)value;
}
static void set_velocity(int value) {
    model.control.sampling.period = 0.05;
    model.control.sampling.velocity = (gough_velocity)value;
}
static void set_component(int value) { component = value; }

enum { ANY = 16 };
static const struct {
    const char *what, *key;
    void (*set)(int value);
    gough_status (*call[ANY])(void);
} cases[] = {
    {"method",
     "simulation.method",
     set_method,
     {call_check, call_simulate, call_forces, call_batch, call_plant, call_fleet, call_tune,
      call_flat}},
    {"precision",
     "simulation.precision",
     set_precision,
     {call_check, call_simulate, call_forces, call_batch, call_plant, call_tune, call_flat}},
    {"constraints",
     "simulation.constraints",
     set_constraints,
     {call_check, call_simulate, call_forces, call_batch, call_plant, call_tune, call_flat}},
    {"motion",
     "motion",
     set_motion,
     {call_check, call_simulate, call_forces, call_batch, call_range, call_period, call_linearise,
      call_rest, call_stiffness, call_floquet, call_tune, call_damping, call_poles, call_lqr,
      call_move, call_flat}},
    {"order",
     "motion.order",
     set_order,
     {call_check, call_simulate, call_forces, call_batch, call_range, call_period, call_linearise,
      call_rest, call_stiffness, call_floquet, call_tune, call_damping, call_poles, call_lqr,
      call_move, call_flat}},
    {"order of a workspace",
     "motion.order",
     set_order,
     {call_reach, call_certify, call_travel, call_ray, call_largest, call_envelope, call_volume}},
    {"drive", "actuators.kind", set_drive, {call_machine, call_flat}},
    {"velocity",
     "control.sampling.velocity",
     set_velocity,
     {call_control, call_check, call_simulate, call_forces, call_batch, call_plant, call_sampled,
      call_margins, call_matrix, call_floquet_sampled, call_flat}},
    {"axis", NULL, set_axis, {call_map_size, call_map_find, call_map_draw}},
    {"interval", NULL, set_interval, {call_map_draw}},
    {"component", NULL, set_component, {call_low_pass, call_smooth, call_travel}},
};

START_TEST(every_function_refuses_what_is_outside_an_enumeration) {
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (int f = 0; f < ANY && cases[k].call[f]; f++) {
            for (int i = 0; i < OUTSIDE; i++) {
                begin();
                cases[k].set(outside[i]);
                ck_assert_msg(cases[k].call[f]() == GOUGH_ERROR_INPUT, "%s %d, function %d",
                              cases[k].what, outside[i], f);
                ck_assert_msg(error.message[0] != '\0' && error.status == GOUGH_ERROR_INPUT,
                              "%s %d, function %d", cases[k].what, outside[i], f);
                if (cases[k].call[f] == call_flat) continue; /* which sees numbers only */
                if (cases[k].key)
                    ck_assert_msg(error.key && strcmp(error.key, cases[k].key) == 0,
                                  "%s, function %d: the key is %s", cases[k].what, f,
                                  error.key ? error.key : "missing");
                else
                    ck_assert_ptr_null(error.key);
            }
        }
    }
}
END_TEST

/* What a motion of no kind does to functions that have no status; and a row of a map, each of which has an error. */
START_TEST(functions_without_a_status_give_what_is_not_finite) {
    for (int i = 0; i < OUTSIDE; i++) {
        double jets[GOUGH_COMPONENTS][3];
        double turned[3][3], angles[3] = {0.1, 0.2, 0.3};
        gough_acceleration a;
        gough_state s;
        size_t bytes;
        begin();
        gough_rotation_in_order((gough_order)outside[i], angles, turned);
        ck_assert(isnan(turned[0][0]) && isnan(turned[2][1]));
        gough_rotation_from_angles(angles, turned);
        ck_assert_int_eq(gough_angles_in_order((gough_order)outside[i], turned, angles),
                         GOUGH_ERROR_INPUT);
        set_motion(outside[i]);
        gough_motion_evaluate(&model.motion, 1, jets);
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            for (int order = 0; order < 3; order++) ck_assert(isnan(jets[c][order]));
        gough_program(&model.machine, &model.motion, 1, &s, &a);
        for (int c = 0; c < 3; c++)
            ck_assert(isnan(s.position[c]) && isnan(s.velocity[c]) && isnan(a.linear[c]) &&
                      isnan(s.rotation[c][0]) && isnan(s.angular_velocity[c]) &&
                      isnan(a.angular[c]));

        begin();
        set_order(outside[i]);
        ck_assert_int_eq(gough_box_test(reach_of_order(), &small_box, NULL), GOUGH_UNDECIDED);
        begin();
        set_motion(outside[i]);
        ck_assert_uint_eq(gough_linear_size(&model), GOUGH_LINEAR);
        ck_assert_int_eq(gough_map_size(&model, &axes, &bytes, NULL), GOUGH_OK);
        void *memory = room(bytes);
        ck_assert_int_eq(gough_map_find(&model, &axes, &map, memory, NULL), GOUGH_OK);
        ck_assert_int_eq(map.row[0].error.status, GOUGH_ERROR_INPUT);
        ck_assert_str_eq(map.row[0].error.key, "motion");
        free(memory);
    }
}
END_TEST

START_TEST(names_of_what_is_outside_are_harmless) {
    const gough_simulation everything = {.reactions = true, .joints = true};
    for (int i = 0; i < OUTSIDE; i++) {
        const int value = outside[i];
        const gough_end_words words = {"", "", "", "", "", "", "", ""};
        gough_end end = {.cause = (gough_cause)value, .message = "as it was"};
        gough_place place = {.owner = GOUGH_OWNER_MODEL, .kind = (gough_kind)value, .count = 1};
        double number = 7;
        ck_assert_str_eq(gough_cause_name((gough_cause)value), "unknown");
        ck_assert_str_eq(gough_cause_words((gough_cause)value), "the run ends");
        ck_assert_str_eq(gough_bind_name((gough_bind)value), "unknown");
        ck_assert_str_eq(gough_worst_name((gough_worst)value), "unknown");
        ck_assert_str_eq(gough_aim_name((gough_aim)value), "unknown");
        ck_assert_str_eq(gough_active_name((gough_active_kind)value), "unknown");
        ck_assert_str_eq(gough_completeness_name((gough_completeness)value), "unknown");
        ck_assert_str_eq(gough_interval_kind_name((gough_interval_kind)value), "unknown");
        ck_assert_str_eq(gough_tuning_binding_name((gough_tuning_binding)value), "unknown");
        ck_assert_str_eq(gough_tuning_exception_name((gough_tuning_exception_kind)value),
                         "unknown");
        ck_assert_str_eq(gough_component_name(value), "");
        ck_assert_ptr_null(gough_method_name(value));
        ck_assert_ptr_null(gough_column(value));
        gough_motion motion = model.motion;
        gough_limits limits;
        motion.kind = (gough_motion_kind)value;
        ck_assert_int_eq(gough_limits_collect(&model.machine, &motion, &limits, sizeof limits),
                         GOUGH_OK);
        ck_assert(!gough_column_filled(value, true, &everything));
        gough_end_say(&end, &words);
        ck_assert_str_eq(end.message, "as it was");
        gough_place_reset(&place, &number);
        ck_assert(number >= 7 && number <= 7);
        begin();
        set_axis(value);
        axes.second.count = 3;
        ck_assert_uint_eq(gough_map_rows(&axes), 3);
    }
}
END_TEST

/* a unit outside is that of pure numbers */
START_TEST(units_outside_are_none) {
    const gough_units units = {.length = 2, .mass = 3, .time = 5};
    for (int i = 0; i < OUTSIDE; i++) {
        const gough_unit unit = (gough_unit)outside[i];
        ck_assert_str_eq(gough_unit_label(&units, unit), "1");
        ck_assert_str_eq(gough_unit_word(&units, unit), "");
        ck_assert(fabs(gough_unit_size(&units, unit) - 1) <= 0);
        ck_assert(fabs(gough_unit_factor(&units, unit) - 1) <= 0);
        ck_assert_int_eq(gough_unit_of_column(outside[i]), GOUGH_UNIT_NONE);
        ck_assert(fabs(gough_unit_read(&units, unit, 7) - 7) <= 0);
        int power[GOUGH_BASE_UNITS];
        gough_unit_powers(&units, unit, power);
        for (int b = 0; b < GOUGH_BASE_UNITS; b++) ck_assert_int_eq(power[b], 0);
        gough_units chosen = gough_units_si();
        ck_assert_ptr_null(gough_unit_choice((gough_base_unit)outside[i], 0));
        ck_assert(!gough_units_choose(&chosen, (gough_base_unit)outside[i], "m"));
    }
}
END_TEST

/* the file of a result names a cause outside its enumeration as unknown */
START_TEST(a_result_names_no_cause_outside) {
    gough_study study = {.title = "", .text = "", .name = "", .model = &model};
    const gough_units units = {.length = 1, .mass = 1, .time = 1};
    begin();
    gough_result *result = gough_result_new(&study, "simulate", &units);
    const gough_end end = {.cause = (gough_cause)97, .time = 1, .message = "ended"};
    gough_table *table = NULL;
    static const char path[] = "test-enumerations.h5";
    ck_assert_ptr_nonnull(result);
    gough_result_set_end(result, &end);
    ck_assert_int_eq(gough_result_write(result, path, &error), GOUGH_OK);
    ck_assert_int_eq(gough_table_read(path, &table, &error), GOUGH_OK);
    ck_assert_str_eq(table->end_cause, "unknown");
    remove(path);
    gough_table_free(table);
    gough_result_free(result);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "base/enumerations", 120, every_function_refuses_what_is_outside_an_enumeration,
        functions_without_a_status_give_what_is_not_finite, names_of_what_is_outside_are_harmless,
        units_outside_are_none, a_result_names_no_cause_outside);
}
