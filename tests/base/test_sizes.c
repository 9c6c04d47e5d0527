/* Sizes of structs: a struct that the caller's program lays out in another size is filled within its own bytes only and refused by
 * every function; zero-filled structs have the size of the library. */
#include "gough/sizes.h"

#include <stdlib.h>

#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

enum { ROOM = 1 << 16 };

static gough_machine machine;
static double rows[2][GOUGH_COMPONENTS];

static gough_status fill(int which, void *room, size_t size) {
    switch (which) {
    case 0:
        return gough_simulation_init(room, size);
    case 1:
        return gough_batch_options_init(room, size);
    case 2:
        return gough_sweep_options_init(room, size);
    case 3:
        return gough_map_options_init(room, size);
    case 4:
        return gough_tuning_options_init(room, size);
    case 5:
        return gough_figure_init(room, size);
    case 6:
        return gough_platform_init(room, size);
    case 7:
        return gough_platform_init_symmetric(room, size, 1, 0.1, 0.6, 0.1, 1);
    case 8:
        return gough_state_init(room, size, &machine);
    case 9:
        return gough_formula_init(room, size, 1);
    default:
        return gough_samples_make_continuous(2, rows[0], pi, room, size);
    }
}

static const char *const filled[] = {
    "gough_simulation",     "gough_batch_options", "gough_sweep_options", "gough_map_options",
    "gough_tuning_options", "gough_figure",        "gough_platform",      "gough_platform",
    "gough_state",          "gough_formula",       "gough_unwrapping"};
enum { FILLED = sizeof filled / sizeof *filled };

START_TEST(structs_are_filled_within_their_bytes_whatever_size_the_caller_has) {
    unsigned char *room = malloc(ROOM);
    paper_machine(&machine);
    for (int which = 0; which < FILLED; which++) {
        const size_t own = gough_struct_size(filled[which]);
        ck_assert_msg(own >= 16 && own < ROOM - 64, "%s has %zu bytes", filled[which], own);
        for (int change = -2; change <= 2; change++) {
            const size_t size = own + (size_t)(8 * change);
            memset(room, 7, ROOM);
            const gough_status status = fill(which, room, size);
            ck_assert_msg(status == (change ? GOUGH_ERROR_INPUT : GOUGH_OK), "%s of %zu bytes",
                          filled[which], size);
            size_t marked = 0, kept = size;
            while (marked < size && room[marked] == 0xff) marked++;
            while (kept < ROOM && room[kept] == 7) kept++;
            if (change) ck_assert_uint_eq(marked, size);
            ck_assert_msg(kept == ROOM, "%s of %zu bytes: byte %zu", filled[which], size, kept);
        }
    }
    free(room);
}
END_TEST

START_TEST(a_refused_struct_cannot_be_used) {
    const gough_load load = {.mass = 1, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
    const double gravity[3] = {0, 0, -1};
    gough_platform platform;
    gough_state state;
    gough_formula formula;
    double length[GOUGH_LEGS], jet[3];
    paper_machine(&machine);

    ck_assert_int_eq(gough_size_refuse(&platform, sizeof platform), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_machine_init(&machine, &platform, &load, gravity, NULL),
                     GOUGH_ERROR_INPUT);
    paper_machine(&machine);
    gough_size_refuse(&state, sizeof state);
    ck_assert_int_eq(gough_leg_kinematics(&machine, &state, NULL, length, NULL, NULL),
                     GOUGH_ERROR_INPUT);
    gough_size_refuse(&formula, sizeof formula);
    gough_formula_evaluate(&formula, 1, jet);
    for (int i = 0; i < 3; i++) ck_assert(isnan(jet[i]));
}
END_TEST

/* What each function returns for a study at rest whose options have a size. */
static gough_model model;

static gough_status with_simulation(size_t size, int which, gough_error *error) {
    gough_statistics statistics = {.steps = -1};
    gough_simulation s = gough_simulation_default();
    gough_batch_options alone = gough_batch_options_default();
    gough_end end;
    ck_assert_uint_eq(s.size, sizeof s);
    s.size = size;
    s.duration = 0.1;
    s.statistics = &statistics;
    alone.threads = 1;
    const gough_batch_run run = {
        &model.machine, &model.control, &model.disturbance, &model.initial, 1, 0};
    gough_outcome outcome;
    void *memory = aligned_alloc(64, (gough_batch_size(&alone) + 63) / 64 * 64);
    gough_status status = GOUGH_OK;
    if (which == 0) status = gough_simulation_check(&model, &s, error);
    if (which == 1) status = gough_simulate(&model, &s, NULL, NULL, &end, error);
    if (which == 2) status = gough_forces(&model, &s, NULL, NULL, NULL, NULL, &end, error);
    if (which == 3)
        status = gough_batch(&model.motion, &s, &run, 1, &alone, &outcome, memory, error);
    if (status != GOUGH_OK) ck_assert_int_eq(statistics.steps, -1);
    free(memory);
    return status;
}

static gough_status with_batch_options(size_t size, int which, gough_error *error) {
    gough_simulation s = gough_simulation_default();
    gough_batch_options o = gough_batch_options_default();
    const gough_batch_run run = {
        &model.machine, &model.control, &model.disturbance, &model.initial, 1, 0};
    gough_outcome outcome;
    (void)which;
    ck_assert_uint_eq(o.size, sizeof o);
    s.duration = 0.1;
    o.threads = 1;
    void *memory = aligned_alloc(64, (gough_batch_size(&o) + 63) / 64 * 64);
    o.size = size;
    const gough_status status =
        gough_batch(&model.motion, &s, &run, 1, &o, &outcome, memory, error);
    free(memory);
    return status;
}

static gough_status with_map_options(size_t size, int which, gough_error *error) {
    gough_map_options o = gough_map_options_default();
    gough_map map = {NULL, NULL, NULL};
    size_t bytes;
    ck_assert_uint_eq(o.size, sizeof o);
    o.stiffness = (gough_map_range){1, 2, 2, false};
    o.size = size;
    if (which == 0) return gough_map_size(&model, &o, &bytes, error);
    if (size == 0) return GOUGH_OK; /* needs a map */
    if (which == 1) return gough_map_find(&model, &o, &map, NULL, error);
    return gough_map_draw(&o, &map, NULL, "map.svg", error);
}

static gough_status with_tuning_options(size_t size, int which, gough_error *error) {
    const gough_simulation s = gough_simulation_default();
    gough_tuning_options o = gough_tuning_options_default();
    size_t bytes;
    ck_assert_uint_eq(o.size, sizeof o);
    o.deviation = 0.01;
    o.size = size;
    if (which == 0) return gough_tune_size(&model, &o, &bytes, error);
    if (size == 0) return GOUGH_OK; /* takes its time */
    static gough_tuning tuning;
    return gough_tune(&model, &s, true, &o, NULL, &tuning, NULL, error);
}

static gough_status with_sweep_options(size_t size, int which, gough_error *error) {
    static const char text[] = "units: dimensionless\n"
                               "platform:\n"
                               "  base: {radius: 1, half_angle: 15}\n"
                               "  top: {radius: 0.6, half_angle: 15}\n"
                               "  height: 1.2\n"
                               "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
                               "simulation: {duration: 0.1}\n"
                               "sweep: {keys: {load.mass: [1, 2]}}\n";
    const gough_sweep_output output = {.path = NULL};
    gough_sweep_options o = gough_sweep_options_default();
    gough_sweep_summary summary;
    gough_sweep *sweep = NULL;
    char *messages = NULL;
    ck_assert_uint_eq(o.size, sizeof o);
    o.threads = 1;
    o.size = size;
    ck_assert_msg(gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &messages) ==
                      GOUGH_OK,
                  "%s", messages);
    const gough_status status =
        which == 0 ? gough_sweep_write(sweep, &o, &output, &summary, error)
                   : gough_sweep_run(sweep, &o, (gough_sweep_sink)NULL, NULL, error);
    gough_sweep_free(sweep);
    return status;
}

static gough_status with_figure(size_t size, int which, gough_error *error) {
    gough_figure f = gough_figure_default();
    (void)which;
    ck_assert_uint_eq(f.size, sizeof f);
    f.size = size;
    if (size == 0) return GOUGH_OK; /* needs a table */
    return gough_figure_draw(&f, NULL, NULL, 0, "figure.svg", error);
}

START_TEST(every_function_refuses_options_of_another_size) {
    static const struct {
        const char *name;
        gough_status (*call)(size_t size, int which, gough_error *error);
        int functions;
    } taker[] = {{"gough_simulation", with_simulation, 4},
                 {"gough_batch_options", with_batch_options, 1},
                 {"gough_map_options", with_map_options, 3},
                 {"gough_tuning_options", with_tuning_options, 2},
                 {"gough_sweep_options", with_sweep_options, 1},
                 {"gough_figure", with_figure, 1}};
    paper_machine(&model.machine);
    model.control.feedforward = true;
    set_gains(&model, 10, 1);
    for (size_t i = 0; i < sizeof taker / sizeof *taker; i++) {
        const size_t own = gough_struct_size(taker[i].name);
        const size_t others[] = {own - 8, own + 8, 1, SIZE_MAX};
        for (int which = 0; which < taker[i].functions; which++) {
            gough_error error = {.message = ""};
            ck_assert_msg(taker[i].call(0, which, &error) == GOUGH_OK, "%s %d: %s", taker[i].name,
                          which, error.message);
            for (int k = 0; k < 4; k++) {
                error = (gough_error){.message = ""};
                ck_assert_msg(taker[i].call(others[k], which, &error) == GOUGH_ERROR_INPUT,
                              "%s %d accepts a size of %zu", taker[i].name, which, others[k]);
                ck_assert_msg(strstr(error.message, taker[i].name) == error.message, "%s",
                              error.message);
                ck_assert_msg(strstr(error.message, "_default()") != NULL, "%s", error.message);
            }
        }
    }
    gough_error error = {.message = ""};
    ck_assert_int_eq(with_sweep_options(1, 1, &error), GOUGH_ERROR_INPUT);
}
END_TEST

START_TEST(a_size_is_that_of_the_struct_or_0) {
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_size_check(0, 40, "gough_x", &error), GOUGH_OK);
    ck_assert_int_eq(gough_size_check(40, 40, "gough_x", &error), GOUGH_OK);
    ck_assert_str_eq(error.message, "");
    ck_assert_int_eq(gough_size_check(32, 40, "gough_x", &error), GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.message,
                     "gough_x.size is 32, but this struct has 40 bytes in this library: "
                     "start from gough_x_default()");
    ck_assert_int_eq(gough_size_check(41, 40, "gough_x", NULL), GOUGH_ERROR_INPUT);
}
END_TEST

START_TEST(sizes_are_known_by_name) {
    ck_assert_uint_eq(gough_struct_size("gough_model"), sizeof(gough_model));
    ck_assert_uint_eq(gough_struct_size("gough_error"), sizeof(gough_error));
    ck_assert_uint_eq(gough_struct_size("gough_wrench"), sizeof(gough_wrench));
    ck_assert_uint_eq(gough_struct_size("gough_mode"), sizeof(gough_mode));
    ck_assert_uint_eq(gough_struct_size("gough_model "), 0);
    ck_assert_uint_eq(gough_struct_size(""), 0);
    ck_assert_int_eq(gough_edition(), GOUGH_EDITION);
    ck_assert_str_eq(gough_version(), GOUGH_VERSION);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "base/sizes", 60, structs_are_filled_within_their_bytes_whatever_size_the_caller_has,
        a_refused_struct_cannot_be_used, every_function_refuses_options_of_another_size,
        a_size_is_that_of_the_struct_or_0, sizes_are_known_by_name);
}
