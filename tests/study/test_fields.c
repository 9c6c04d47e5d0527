/* Every key of the table that has a member goes from the study file into that member and no other, and through the flat form and
 * back. The cases are made from the table, so that a new key is tested without a line here unless rules tie it to others. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/helpers.h"
#include "support/fields.h"
#include "support/suite.h"

static const char *const machine =
    "platform:\n"
    "  base: {joints: [[1, 0.3, 0], [-0.2, 1.1, 0], [-0.8, 0.7, 0], [-0.8, -0.7, 0], "
    "[-0.3, -1, 0.1], [1, -0.3, 0]]}\n"
    "  top: {joints: [[0.5, 0.5, 0], [0.4, 0.6, 0], [-0.6, 0.1, 0], [-0.6, -0.1, 0], "
    "[0.3, -0.6, 0], [0.5, -0.45, 0]]}\n"
    "  height: 1.2\n"
    "  legs:\n"
    "    cylinder: {center: 0.4, inertia: 0.02}\n"
    "    piston: {center: 0.3, inertia: 0.01}\n"
    "    friction: {stribeck_speed: 0.5}\n"
    "load: {mass: 1, inertia: [0.08, 0.09, 0.15]}\n"
    "external: [{force: [1, 0, 0]}]\n"
    "disturbance: {noise: {interval: 1}}\n"
    "simulation: {output_step: 0.1, step: 0.05}\n";

static const char *const moves = "motion: {moves: [{start: 1, duration: 20, heave: 0.1}]}\n";
static const char *const formulas = "motion: {sway: 0}\n";

/* A value of the key that is right and not its default, with each number of it; NULL for `which` beyond the last. */
static const char *value_for(const gough_key *key, int which) {
    static const char *const values[][3] = {
        /* keys with rules that tie them to others */
        {"platform.base.joints", "[[1, 0.31, 0], [-0.2, 1.12, 0], [-0.8, 0.73, 0.01], "
                                 "[-0.8, -0.74, 0], [-0.3, -1, 0.15], [1, -0.36, 0]]"},
        {"platform.top.joints", "[[0.5, 0.51, 0], [0.4, 0.62, 0], [-0.6, 0.13, 0.01], "
                                "[-0.6, -0.14, 0], [0.3, -0.6, 0.15], [0.5, -0.46, 0]]"},
        {"platform.height", "1.3"},
        {"platform.legs.length", "[[0.1, 9], [0.2, 8], [0.3, 7], [0.4, 6], [0.5, 5], [0.6, 4]]",
         "[0.1, 9]"},
        {"load.inertia", "[[0.1, 0.01, 0.02], [0.01, 0.11, 0], [0.02, 0, 0.16]]"},
        {"platform.legs.friction.efficiency", "[0.9, 0.8, 0.7, 0.95, 0.85, 0.75]", "0.7"},
        {"control.model.legs", "false"},
        {"control.model.friction", "false"},
        {"control.model.external", "false"},
        {"external.N.axes", "top"},
        {"actuators.kind", "lag"},
        {"control.sampling.period", "0.1"},
        {"control.sampling.delay", "0.05"},
        {"simulation.output_step", "0.2"},
        {"simulation.step", "0.025"},
        {"simulation.method", "rk4"},
        /* others by their type */
        {"number", "0.07"},
        {"number or least", "0.07"},
        {"whole number", "7"},
        {"two numbers", "[0.03, 0.09]"},
        {"three numbers", "[0.01, 0.02, 0.03]"},
        {"number or three numbers", "[0.1, 0.2, -9]"},
        {"number or six numbers", "[1, 2, 3, 4, 5, 6]", "7"},
        {"two numbers or six pairs",
         "[[-0.1, 9], [-0.2, 8], [-0.3, 7], [-0.4, 6], [-0.5, 5], [-0.6, 4]]", "[-0.1, 9]"},
        {"number or two numbers", "[-0.03, 0.09]", "0.07"},
        {"number, two numbers or six of these",
         "[[-1, 2], [-3, 4], [-5, 6], [-7, 8], [-9, 10], [-11, 12]]", "[-0.03, 0.09]"},
        {"number, six numbers or 6×6 matrix", "[1, 2, 3, 4, 5, 6]", "7"},
        {"formula", "0.07*t"},
        {"formula or six formulas", "[1*t, 2*t, 3*t, 4*t, 5*t, 6*t]", "7*t"},
        {"three formulas", "[1*t, 2*t, 3*t]"}};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        if (strcmp(values[i][0], key->path) == 0 || strcmp(values[i][0], key->type) == 0)
            return which < 2 ? values[i][1 + which] : NULL;
    /* the second of two words */
    ck_assert_msg(strncmp(key->type, "choice", 6) == 0, "%s: no value of %s", key->path, key->type);
    return which == 0 ? strstr(key->range, ", ") + 2 : NULL;
}

static bool is_moves(const gough_field *field) { return field->place.owner == GOUGH_OWNER_MOVE; }

/* What a key needs besides itself: settings for the study without it and with it. */
static const char *const *needs(const gough_field *field) {
    static const char
        *const first[] = {"actuators={kind: lag, time_constant: 0.5}", NULL},
               *const second[] = {"actuators={kind: lag, frequency: 3, damping_ratio: 0.5}", NULL},
               *const free_steps[] = {"control.sampling.period=0.1", "simulation.step=", NULL},
               *const difference[] = {"control.sampling={period: 0.1, velocity: difference}", NULL},
               *const other[] = {"control.sampling.period=0.05", NULL},
               *const samples[] = {"control.sampling.period=0.1", NULL}, *const nothing[] = {NULL};
    static const struct {
        const char *path;
        const char *const *settings;
    } all[] = {{"actuators.time_constant", first},
               {"actuators.max_rate", first},
               {"actuators.frequency", second},
               {"actuators.damping_ratio", second},
               {"control.sampling.jitter", free_steps},
               {"control.sampling.cutoff", difference},
               {"control.sampling.period", other},
               {"control.sampling.", samples},
               {"", nothing}};
    size_t i = 0;
    while (strncmp(all[i].path, field->path, strlen(all[i].path)) != 0) i++;
    return all[i].settings;
}

/* The study of a key with settings; a lag needs a time constant too. */
static reading read_for(const gough_field *field, const char *const settings[]) {
    char text[2000];
    const char *all[5] = {NULL};
    size_t count = 0;
    for (const char *const *one = needs(field); *one; one++) all[count++] = *one;
    for (; settings && *settings; settings++) all[count++] = *settings;
    if (count && strcmp(all[count - 1], "actuators.kind=lag") == 0)
        all[count++] = "actuators.time_constant=0.5";
    const int length =
        snprintf(text, sizeof text, "%s%s", machine, is_moves(field) ? moves : formulas);
    reading made = read_bytes(text, (size_t)length, all);
    ck_assert_msg(made.status == GOUGH_OK, "%s: %s", field->path, made.messages);
    return made;
}

/* The struct of a study that contains this field, or NULL for a key without a member. */
static const void *owner_in(const gough_field *field, const gough_model *model,
                            const gough_simulation *simulation) {
    switch (field->place.owner) {
    case GOUGH_OWNER_MODEL:
        return model;
    case GOUGH_OWNER_SIMULATION:
        return simulation;
    case GOUGH_OWNER_MOVE:
        return model->motion.moves ? model->motion.move : NULL;
    case GOUGH_OWNER_EXTERNAL:
        return model->machine.external;
    case GOUGH_OWNER_NONE:
        break;
    }
    return NULL;
}

/* The numbers in a text, in order. */
static size_t numbers_in(const char *text, double number[20]) {
    size_t count = 0;
    while (*text) {
        char *end;
        number[count] = strtod(text, &end);
        count += end > text;
        text = end > text ? end : text + 1;
    }
    return count;
}

static void expect_value(const gough_field *field, const void *value, const char *text) {
    const bool turned = strstr(field->unit, "[degrees]") && field->place.kind == GOUGH_KIND_NUMBER;
    const double factor = turned ? 3.14159265358979323846 / 180 : 1;
    double number[20];
    const size_t count = numbers_in(text, number);
    for (size_t i = 0; i < field->place.count; i++) {
        const bool both = count == 1 && field->shape == GOUGH_SHAPE_RANGE; /* x means −x and x */
        const double wanted = factor * number[count ? i % count : 0] * (both && i == 0 ? -1 : 1);
        double found = NAN, jet[3];
        switch (field->place.kind) {
        case GOUGH_KIND_NUMBER:
            found = ((const double *)value)[i];
            break;
        case GOUGH_KIND_FORMULA:
            gough_formula_evaluate((const gough_formula *)value + i, 1, jet);
            found = jet[0];
            break;
        case GOUGH_KIND_WHOLE:
            found = (double)((const uint64_t *)value)[i];
            break;
        case GOUGH_KIND_CHOICE: /* its second word */
            ck_assert_msg(((const int *)value)[i] == 1, "%s", field->path);
            return;
        case GOUGH_KIND_FLAG: /* true for its first word */
            ck_assert_msg(((const bool *)value)[i] ==
                              (strncmp(field->range, text, strlen(text)) == 0),
                          "%s", field->path);
            return;
        }
        ck_assert_msg(count == 1 || count == field->place.count ||
                          (count == 2 && (field->shape == GOUGH_SHAPE_PAIR_OR_SIX ||
                                          field->shape == GOUGH_SHAPE_RANGE_OR_SIX)),
                      "%s: %s", field->path, text);
        ck_assert_msg(found == wanted, "%s: %s is %.17g at %zu", field->path, text, found, i);
    }
}

/* Members that a key may set besides its own: flags of given keys, and Baumgarte as the way constraints are kept. */
static bool may_follow(const gough_field *other, const gough_field *field) {
    return (!other->is_key && other->place.kind == GOUGH_KIND_FLAG) ||
           (strcmp(other->path, "actuators.time_constant") == 0 &&
            strcmp(field->path, "actuators.kind") == 0) ||
           (strcmp(other->path, "simulation.constraints") == 0 &&
            strcmp(field->path, "simulation.constraints.baumgarte") == 0);
}

static void expect_others_same(const gough_field *field, const gough_study *base,
                               const gough_study *study) {
    size_t count;
    const gough_field *other = gough_fields(&count);
    for (size_t i = 0; i < count; i++) {
        const void *before = owner_in(&other[i], base->model, &base->simulation);
        const void *after = owner_in(&other[i], study->model, &study->simulation);
        if (!before || strcmp(other[i].path, field->path) == 0) continue;
        ck_assert_msg(field_same(&other[i].place, before, after) || may_follow(&other[i], field),
                      "%s sets %s", field->path, other[i].path);
    }
}

static void expect_flat(const gough_field *field, const gough_model *model,
                        const gough_simulation *simulation) {
    const size_t doubles = gough_model_flat_size(model);
    double *flat = malloc(doubles * sizeof *flat);
    gough_model_flatten(model, simulation, flat);
    const size_t bytes = gough_model_flat_memory(flat, doubles);
    void *memory = malloc(bytes + 1);
    gough_model *back = malloc(sizeof *back);
    gough_simulation options;
    gough_error error = {.message = ""};
    ck_assert_msg(gough_model_unflatten(back, &options, memory, flat, doubles, &error) == GOUGH_OK,
                  "%s: %s", field->path, error.message);
    const char *differs = field_differs(GOUGH_OWNER_MODEL, model, back);
    if (!differs) differs = field_differs(GOUGH_OWNER_SIMULATION, simulation, &options);
    for (size_t i = 0; !differs && i < model->motion.moves; i++)
        differs = field_differs(GOUGH_OWNER_MOVE, &model->motion.move[i], &back->motion.move[i]);
    for (size_t i = 0; !differs && i < model->machine.externals; i++)
        differs = field_differs(GOUGH_OWNER_EXTERNAL, &model->machine.external[i],
                                &back->machine.external[i]);
    ck_assert_msg(!differs, "%s is lost in the flat model", differs);
    free(back);
    free(memory);
    free(flat);
}

static void expect_round_trip(const gough_field *field, const char *value) {
    char path[60], setting[200];
    const char *const number = strstr(field->path, ".N.");
    if (number)
        snprintf(path, sizeof path, "%.*s.1.%s", (int)(number - field->path), field->path,
                 number + 3);
    else
        snprintf(path, sizeof path, "%s", field->path);
    snprintf(setting, sizeof setting, "%s=%s", path, value);
    reading base = read_for(field, NULL), made = read_for(field, SETTINGS(setting));
    const gough_study *study = made.study;
    const char *before = owner_in(field, base.study->model, &base.study->simulation);
    const char *after = owner_in(field, study->model, &study->simulation);
    const size_t given = field->place.given;
    ck_assert_msg(!field_same(&field->place, before, after), "%s is not set by %s", field->path,
                  setting);
    expect_value(field, after + field->place.offset, value);
    ck_assert_msg(given == 0 || *(const bool *)(after + given), "%s is not given", field->path);
    /* the base has a move of heave, and inertia of legs */
    ck_assert_msg(given == 0 || !*(const bool *)(before + given) ||
                      strcmp(field->path, "motion.moves.N.heave") == 0 ||
                      strncmp(field->path, "platform.legs.", 14) == 0,
                  "%s is given", field->path);
    expect_others_same(field, base.study, study);
    expect_flat(field, study->model, &study->simulation);
    reading_free(&base);
    reading_free(&made);
}

START_TEST(every_key_makes_a_round_trip) {
    size_t count, tried = 0;
    const gough_field *field = gough_fields(&count);
    for (size_t i = 0; i < count; i++) {
        const char *value;
        if (!field[i].is_key || field[i].place.owner == GOUGH_OWNER_NONE) continue;
        for (int which = 0; (value = value_for(&field[i], which)) != NULL; which++)
            expect_round_trip(&field[i], value);
        tried++;
    }
    ck_assert_uint_ge(tried, 57);
}
END_TEST

START_TEST(members_without_a_key_make_a_round_trip) {
    size_t count;
    const gough_field *field = gough_fields(&count);
    reading made = read_for(field, NULL);
    for (size_t i = 0; i < count; i++) {
        gough_simulation run = made.study->simulation;
        if (field[i].is_key || field[i].place.owner != GOUGH_OWNER_SIMULATION) continue;
        char *value = (char *)&run + field[i].place.offset;
        if (field[i].place.kind == GOUGH_KIND_FLAG)
            *(bool *)value = !*(bool *)value;
        else if (field[i].place.kind == GOUGH_KIND_CHOICE)
            *(int *)value = field[i].place.choices - 1;
        expect_flat(&field[i], made.study->model, &run);
    }
    reading_free(&made);
}
END_TEST

/* Parts decide what a sweep fills again for each run. */
START_TEST(every_member_is_of_the_part_that_its_key_names) {
    static const struct {
        const char *section;
        unsigned part;
    } sections[] = {{"platform", GOUGH_PART_MACHINE},    {"actuators", GOUGH_PART_MACHINE},
                    {"pose", GOUGH_PART_MACHINE},        {"load", GOUGH_PART_MACHINE},
                    {"gravity", GOUGH_PART_MACHINE},     {"external", GOUGH_PART_EXTERNAL},
                    {"motion", GOUGH_PART_MOTION},       {"disturbance", GOUGH_PART_DISTURBANCE},
                    {"control", GOUGH_PART_CONTROL},     {"initial", GOUGH_PART_INITIAL},
                    {"workspace", GOUGH_PART_WORKSPACE}, {"simulation", GOUGH_PART_SIMULATION},
                    {"title", GOUGH_PART_NONE},          {"units", GOUGH_PART_NONE},
                    {"sweep", GOUGH_PART_NONE},          {"design", GOUGH_PART_NONE}};
    size_t count;
    const gough_field *field = gough_fields(&count);
    for (size_t i = 0; i < count; i++) {
        const size_t length = strcspn(field[i].path, ".");
        bool found = false;
        for (size_t s = 0; s < sizeof sections / sizeof sections[0]; s++)
            if (strlen(sections[s].section) == length &&
                strncmp(field[i].path, sections[s].section, length) == 0)
                found = sections[s].part == field[i].place.part;
        ck_assert_msg(found, "%s", field[i].path);
        /* the runs of a batch have one height; the interval of noise is checked against the duration */
        const unsigned also = strcmp(field[i].path, "disturbance.noise.interval") == 0
                                  ? GOUGH_PART_SIMULATION
                              : strcmp(field[i].path, "platform.height") == 0 ? GOUGH_PART_HEIGHT
                                                                              : GOUGH_PART_NONE;
        ck_assert_msg(field[i].place.also == also, "%s", field[i].path);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("study/fields", 60, every_key_makes_a_round_trip,
                     members_without_a_key_make_a_round_trip,
                     every_member_is_of_the_part_that_its_key_names);
}
