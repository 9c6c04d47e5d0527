/* The table of fields: it covers the structs, flags of keys are fields, and defaults are those that it tells. */
#include <stdio.h>
#include <string.h>

#include "gough/text.h"
#include "support/fields.h"
#include "support/suite.h"

static size_t size_of(const gough_place *place) { return place->count * field_value_size(place); }

/* From `start` to before `end` of a struct there is no input: pointers of the caller, numbers derived from the input. */
typedef struct {
    size_t start, end;
} range;

#define RANGE(type, first, last)                                                                   \
    { offsetof(type, first), offsetof(type, last) + sizeof(((type *)NULL)->last) }

/* Each byte is of one field, or of no input, or padding, which is shorter than a number. */
static void expect_covered(gough_owner owner, size_t size, const range none[3]) {
    size_t count, gap = 0;
    const gough_field *field = gough_fields(&count);
    bool *seen = calloc(size, sizeof *seen);

    for (size_t i = 0; i < count; i++) {
        const gough_place *p = &field[i].place;
        if (p->owner != owner) continue;
        ck_assert_msg(p->offset + size_of(p) <= size, "%s goes beyond its struct", field[i].path);
        for (size_t k = p->offset; k < p->offset + size_of(p); k++) {
            ck_assert_msg(!seen[k], "%s has a byte of another field", field[i].path);
            seen[k] = true;
        }
    }
    for (int r = 0; r < 3; r++)
        for (size_t k = none[r].start; k < none[r].end; k++) {
            ck_assert_msg(!seen[k], "byte %zu is of a field and no input", k);
            seen[k] = true;
        }
    for (size_t k = 0; k < size; k++) {
        gap = seen[k] ? 0 : gap + 1;
        ck_assert_msg(gap < sizeof(double), "bytes up to %zu of owner %d have no field", k, owner);
    }
    free(seen);
}

/* Smaller members, which could hide in padding, are tested by tests/house/test_fields.sh. */
START_TEST(fields_cover_their_structs_once) {
    static const range of_model[3] = {RANGE(gough_model, machine.base_radius, machine.externals),
                                      RANGE(gough_model, motion.move, motion.samples.curvature)};
    static const range of_simulation[3] = {RANGE(gough_simulation, size, size),
                                           RANGE(gough_simulation, law, statistics)};
    static const range of_move[3] = {{0, 0}};

    expect_covered(GOUGH_OWNER_MODEL, sizeof(gough_model), of_model);
    expect_covered(GOUGH_OWNER_SIMULATION, sizeof(gough_simulation), of_simulation);
    expect_covered(GOUGH_OWNER_MOVE, sizeof(gough_move), of_move);
    expect_covered(GOUGH_OWNER_EXTERNAL, sizeof(gough_external), of_move);
}
END_TEST

START_TEST(keys_come_first_and_paths_are_unique) {
    size_t count;
    const gough_field *field = gough_fields(&count);

    ck_assert_uint_gt(count, 100);
    for (size_t i = 0; i < count; i++) {
        ck_assert(field[i].path[0] && field[i].type && field[i].unit && field[i].range);
        ck_assert(field[i].fallback && field[i].sentence);
        ck_assert_msg(i == 0 || field[i - 1].is_key >= field[i].is_key, "%s", field[i].path);
        ck_assert_msg(field[i].is_key == (field[i].sentence[0] != '\0'), "%s", field[i].path);
        ck_assert_msg(field[i].is_key || field[i].place.owner != GOUGH_OWNER_NONE, "%s",
                      field[i].path);
        for (size_t k = 0; k < i; k++) ck_assert_str_ne(field[i].path, field[k].path);
    }
}
END_TEST

START_TEST(flags_of_keys_are_fields_too) {
    size_t count, flags = 0;
    const gough_field *field = gough_fields(&count);

    for (size_t i = 0; i < count; i++) {
        const gough_place *p = &field[i].place;
        bool found = p->given == 0;
        for (size_t k = 0; k < count && !found; k++) {
            const gough_place *flag = &field[k].place;
            found = flag->owner == p->owner && flag->kind == GOUGH_KIND_FLAG &&
                    p->given >= flag->offset && p->given < flag->offset + flag->count;
        }
        ck_assert_msg(found, "%s", field[i].path);
        flags += p->given != 0;
    }
    ck_assert_uint_ge(flags, 16);
}
END_TEST

/* The place of a word in "a, b, c", from 0; -1: not there. */
static int place_of_word(const char *words, const char *word) {
    for (int i = 0; *words; i++) {
        const size_t length = strcspn(words, ",");
        if (length == strlen(word) && strncmp(words, word, length) == 0) return i;
        words += length;
        words += strspn(words, ", ");
    }
    return -1;
}

START_TEST(defaults_are_what_their_text_says) {
    size_t count, numbers = 0, words = 0;
    const gough_field *field = gough_fields(&count);

    for (size_t i = 0; i < count; i++) {
        const gough_field *f = &field[i];
        double value;
        if (!f->is_key || f->place.owner == GOUGH_OWNER_NONE) continue;
        const int word = place_of_word(f->range, f->fallback);
        const size_t length = strlen(f->fallback);
        if (length && gough_decimal_read(f->fallback, length, &value) == length) {
            ck_assert_msg(f->place.usual[0] == value && f->place.usual[1] == value, "%s", f->path);
            numbers++;
        } else if (word >= 0 && f->place.kind == GOUGH_KIND_FLAG) {
            ck_assert_msg((f->place.usual[0] > 0) == (word == 0), "%s", f->path);
            words++;
        } else if (word >= 0) {
            ck_assert_msg(f->place.usual[0] == word, "%s", f->path);
            words++;
        }
    }
    ck_assert_uint_ge(numbers, 15);
    ck_assert_uint_eq(words, 10);
}
END_TEST

static const gough_field *find(const char *path) {
    size_t count;
    const gough_field *field = gough_fields(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(field[i].path, path) == 0) return &field[i];
    ck_abort_msg("no field %s", path);
    return NULL;
}

START_TEST(defaults_are_those_of_the_structs) {
    const gough_platform none = gough_platform_default();
    const gough_simulation run = gough_simulation_default();

    ck_assert(find("platform.length_min")->place.usual[0] == none.length_min);
    ck_assert(find("platform.length_max")->place.usual[0] == none.length_max);
    ck_assert(find("platform.speed_max")->place.usual[0] == none.speed_max);
    ck_assert(find("platform.force_max")->place.usual[0] == none.force_max);
    ck_assert(find("platform.legs.length")->place.usual[0] == none.legs.length[0][0]);
    ck_assert(find("platform.legs.length")->place.usual[1] == none.legs.length[0][1]);
    ck_assert(find("platform.limits.yaw")->place.usual[0] == none.limits.pose[GOUGH_YAW][0]);
    ck_assert(run.duration == 20 && run.output_step == 0.05 && run.tolerance == 1e-10);
    ck_assert(run.method == GOUGH_DOP853 && run.constraints == GOUGH_PROJECTION);
    ck_assert(run.step == 0 && run.max_step == 0 && run.precision == GOUGH_DOUBLE);
    ck_assert(!run.commands && !run.actuators);
    ck_assert(!run.reactions && !run.joints && run.summary == NULL && run.statistics == NULL);
}
END_TEST

START_TEST(words_of_choices_are_those_of_the_enumerations) {
    const char *methods = find("simulation.method")->range;

    for (int m = 0; m < GOUGH_METHODS; m++)
        ck_assert_int_eq(place_of_word(methods, gough_method_name(m)), m);
    ck_assert_int_eq(place_of_word(find("simulation.constraints")->range, "none"), GOUGH_NONE);
}
END_TEST

START_TEST(a_reset_touches_nothing_else) {
    size_t count;
    const gough_field *field = gough_fields(&count);
    gough_model *model = malloc(sizeof *model);

    for (size_t i = 0; i < count; i++) {
        const gough_place *p = &field[i].place;
        const unsigned char *byte = (const unsigned char *)model;
        if (p->owner != GOUGH_OWNER_MODEL) continue;
        memset(model, 0x55, sizeof *model);
        gough_place_reset(p, model);
        size_t others = 0;
        for (size_t k = 0; k < sizeof *model; k++)
            others += byte[k] != 0x55 && !(k >= p->offset && k < p->offset + size_of(p)) &&
                      !(p->given && k == p->given);
        ck_assert_msg(others == 0, "%s", field[i].path);
        ck_assert_msg(p->given == 0 || byte[p->given] == 0, "%s", field[i].path);
        if (p->kind == GOUGH_KIND_NUMBER)
            ck_assert_msg(memcmp(byte + p->offset, p->usual, sizeof(double)) == 0, "%s",
                          field[i].path);
    }
    memset(model, 0x55, sizeof *model);
    gough_place_reset(&find("title")->place, model);
    ck_assert(((unsigned char *)model)[0] == 0x55);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("model/fields", 30, fields_cover_their_structs_once,
                     keys_come_first_and_paths_are_unique, flags_of_keys_are_fields_too,
                     defaults_are_what_their_text_says, defaults_are_those_of_the_structs,
                     words_of_choices_are_those_of_the_enumerations, a_reset_touches_nothing_else);
}
