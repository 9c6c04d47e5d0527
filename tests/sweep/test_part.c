/* Heads and records of sweeps from bytes that may be anything: what no sweep of gough writes is refused, whatever its checksum. */
#define _GNU_SOURCE
#include "gough/sweep.h"

#include "support/suite.h"
#include "sweep/sweep_bytes.h"
#include "sweep/sweep_part.h"
#include "table/by_hand.h"

#define MACHINE_AND_SWEEP                                                                          \
    "platform:\n"                                                                                  \
    "  base: {radius: 1.0, half_angle: 15}\n"                                                      \
    "  top: {radius: 0.6, half_angle: 15}\n"                                                       \
    "  height: 1.2\n"                                                                              \
    "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"                                               \
    "sweep:\n"                                                                                     \
    "  runs: 1000\n"                                                                               \
    "  keys: {load.mass: {uniform: [1, 2]}, gravity: {uniform: [1, 2]}}\n"

static const char bare_study[] = "units: dimensionless\n" MACHINE_AND_SWEEP;
static const char si_study[] = "units: si\n" MACHINE_AND_SWEEP;

/* The head of the second of three shards. */
static sweep_head *head_of(const char *study, const gough_units *units) {
    gough_sweep *sweep = NULL;
    char *messages = NULL;
    ck_assert_msg(gough_sweep_parse("study.yaml", study, strlen(study), NULL, 0, &sweep,
                                    &messages) == GOUGH_OK,
                  "%s", messages);
    const gough_sweep_options options = {.sizing = true};
    sweep_head *head = sweep_head_of(sweep, &options, units, 2, 3);
    ck_assert_ptr_nonnull(head);
    gough_sweep_free(sweep);
    return head;
}

static sweep_head *new_head(void) {
    static const gough_units bare = {.dimensionless = true, .length = 1, .mass = 1, .time = 1};
    return head_of(bare_study, &bare);
}

/* Whether the head comes back from its bytes. */
static bool comes_back(const sweep_head *head) {
    size_t length;
    unsigned char *bytes = sweep_head_bytes(head, &length);
    ck_assert_ptr_nonnull(bytes);
    ck_assert_uint_eq(sweep_head_length(bytes, length), length);
    sweep_head *back = sweep_head_read(bytes, length);
    const bool same = back && back->runs == head->runs && back->keys == head->keys &&
                      back->plan == head->plan && back->shard == head->shard &&
                      back->sizing == head->sizing && back->forces == head->forces &&
                      strcmp(back->study, head->study) == 0 &&
                      strcmp(back->path[1], head->path[1]) == 0;
    ck_assert(same == (back != NULL));
    sweep_head_free(back);
    free(bytes);
    return same;
}

#define EXPECT_REFUSED(change)                                                                     \
    do {                                                                                           \
        sweep_head changed = *head;                                                                \
        changed.change;                                                                            \
        ck_assert_msg(!comes_back(&changed), "accepted: " #change);                                \
    } while (0)

START_TEST(each_number_of_a_head_is_checked) {
    sweep_head *head = new_head();
    ck_assert(comes_back(head));
    EXPECT_REFUSED(runs = 0);
    EXPECT_REFUSED(runs = 100000001);
    EXPECT_REFUSED(shards = 0);
    EXPECT_REFUSED(shards = 100000001);
    EXPECT_REFUSED(shard = 0);
    EXPECT_REFUSED(shard = 4);
    EXPECT_REFUSED(first = 333);
    EXPECT_REFUSED(last = 667);
    const double wrong[] = {0, -1, INFINITY, NAN};
    for (size_t i = 0; i < 4; i++) {
        EXPECT_REFUSED(units.length = wrong[i]);
        EXPECT_REFUSED(units.mass = wrong[i]);
        EXPECT_REFUSED(units.time = wrong[i]);
        EXPECT_REFUSED(base_radius = wrong[i]);
        if (i > 0) EXPECT_REFUSED(gravity = wrong[i]);
    }
    EXPECT_REFUSED(units.dimensionless = false);
    EXPECT_REFUSED(own.name[GOUGH_BASE_LENGTH] = 200);
    EXPECT_REFUSED(keys = 0);
    const char *const misspelt[] = {"load.mess", head->path[1]};
    EXPECT_REFUSED(path = (const char **)misspelt);
    sweep_head_free(head);
}
END_TEST

/* A sweep in the study's own units has the sizes of these units. */
START_TEST(sizes_of_units_are_those_of_their_words) {
    const gough_units si = gough_units_si();
    sweep_head *head = head_of(si_study, &si);
    ck_assert(comes_back(head));
    EXPECT_REFUSED(units.length = 2);
    EXPECT_REFUSED(units.mass = 2);
    EXPECT_REFUSED(units.time = 2);
    sweep_head_free(head);
}
END_TEST

START_TEST(no_key_comes_twice_and_none_after_the_thousandth) {
    enum { MANY = 1001 };
    sweep_head *head = new_head();
    const char *path[MANY], *label[MANY];
    for (size_t k = 0; k < MANY; k++) path[k] = head->path[0], label[k] = head->label[0];
    sweep_head changed = *head;
    changed.path = path;
    changed.label = label;
    ck_assert(!comes_back(&changed));
    changed.keys = MANY;
    ck_assert(!comes_back(&changed));
    sweep_head_free(head);
}
END_TEST

/* The bytes of a head whose rest is cut or made longer, with a right length and checksum. */
static bool reads_with_rest(const unsigned char *bytes, size_t rest) {
    unsigned char *copy = calloc(SWEEP_START + rest + 8, 1);
    const uint64_t length = rest;
    uint64_t whole;
    memcpy(&whole, bytes + SWEEP_IDENTITY, 8);
    memcpy(copy, bytes, SWEEP_START + (size_t)(rest < whole ? rest : whole));
    memcpy(copy + SWEEP_IDENTITY, &length, 8);
    const uint64_t sum = sweep_digest(0, copy, SWEEP_START + rest);
    memcpy(copy + SWEEP_START + rest, &sum, 8);
    sweep_head *head = sweep_head_read(copy, SWEEP_START + rest + 8);
    sweep_head_free(head);
    free(copy);
    return head != NULL;
}

START_TEST(a_head_is_as_long_as_it_says) {
    sweep_head *head = new_head();
    size_t length;
    unsigned char *bytes = sweep_head_bytes(head, &length);
    const size_t whole = length - SWEEP_START - 8;
    for (size_t rest = 0; rest <= whole + 16; rest++)
        ck_assert_msg(reads_with_rest(bytes, rest) == (rest == whole), "%zu of %zu", rest, whole);
    for (size_t cut = 0; cut < SWEEP_START; cut++)
        ck_assert_uint_eq(sweep_head_length(bytes, cut), 0);
    memset(bytes + SWEEP_IDENTITY, 0x7f, 8);
    ck_assert_uint_eq(sweep_head_length(bytes, length), 0);
    free(bytes);
    sweep_head_free(head);
}
END_TEST

START_TEST(a_text_has_no_nul) {
    sweep_head *head = new_head();
    size_t length;
    unsigned char *bytes = sweep_head_bytes(head, &length);
    unsigned char *at = memmem(bytes, length, "height", 6);
    ck_assert_ptr_nonnull(at);
    *at = 0;
    const uint64_t sum = sweep_digest(0, bytes, length - 8);
    memcpy(bytes + length - 8, &sum, 8);
    ck_assert_ptr_null(sweep_head_read(bytes, length));
    free(bytes);
    sweep_head_free(head);
}
END_TEST

/* What the numbers of a sweep are is one number of its head, which has a greatest value. */
START_TEST(a_kind_of_sweep_that_does_not_exist_is_refused) {
    sweep_head *head = new_head();
    for (int kind = 0; kind < 4; kind++) {
        head->sizing = kind & 1;
        head->forces = kind & 2;
        ck_assert(comes_back(head));
    }
    size_t length, place = SWEEP_START + 3 * 8; /* behind four texts and three numbers */
    unsigned char *bytes = sweep_head_bytes(head, &length);
    const char *const texts[] = {head->version, head->title, head->study, head->settings};
    for (size_t i = 0; i < 4; i++) place += 8 + strlen(texts[i]);
    ck_assert_int_eq(bytes[place], 1 | 2 | 4);
    bytes[place] = 8;
    const uint64_t sum = sweep_digest(0, bytes, length - 8);
    memcpy(bytes + length - 8, &sum, 8);
    ck_assert_ptr_null(sweep_head_read(bytes, length));
    free(bytes);
    sweep_head_free(head);
}
END_TEST

/* More than a buffer holds, and what was torn off is noticed. */
START_TEST(records_come_back_until_the_first_that_is_torn) {
    static sweep_part part;
    char folder[PATH_SIZE], path[PATH_SIZE];
    gough_error error = {.message = ""};
    make_folder(folder);
    path_in(folder, "a.csv", path);
    ck_assert_msg(sweep_part_open(&part, path, new_head(), &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert_uint_eq(part.head->first, 334);
    const size_t runs = part.head->last + 1 - part.head->first;
    ck_assert_uint_gt(runs * sweep_record_size(part.head), sizeof part.buffer);
    for (size_t run = part.head->first; run <= part.head->last; run++) {
        const double value[2] = {(double)run, 2};
        const gough_sweep_row row = {
            .run = run,
            .value = value,
            .outcome = {.cause = GOUGH_END_LEG_LONG,
                        .leg = 3,
                        .sizing = {[GOUGH_SIZING_HOLDS_TO] = (double)run + 0.5}}};
        ck_assert_int_eq(sweep_part_add(&part, &row, &error), GOUGH_OK);
    }
    ck_assert_int_eq(sweep_part_flush(&part, &error), GOUGH_OK);
    ck_assert_int_eq(sweep_part_flush(&part, &error), GOUGH_OK);
    char *records = malloc(runs * sweep_record_size(part.head));
    ck_assert_uint_eq(sweep_part_get(&part, 0, runs, records), runs);
    sweep_part_close(&part); /* opened again, it goes on behind all of them */
    ck_assert_int_eq(sweep_part_open(&part, path, new_head(), &error), GOUGH_OK);
    ck_assert_uint_eq(part.done, runs);
    double value[2];
    gough_sweep_row row;
    sweep_record_take(&part, records + sweep_record_size(part.head), value, &row);
    ck_assert_uint_eq(row.run, 335);
    ck_assert(fabs(value[0] - 335) <= 0);
    ck_assert_int_eq(row.outcome.leg, 3);
    ck_assert(fabs(row.outcome.sizing[GOUGH_SIZING_HOLDS_TO] - 335.5) <= 0);
    part.head->sizing = false; /* a sweep without them has no number there */
    sweep_record_take(&part, records, value, &row);
    ck_assert(isnan(row.outcome.sizing[GOUGH_SIZING_HOLDS_TO]));
    part.head->sizing = true;
    const off_t torn = (off_t)(part.length + 5 * sweep_record_size(part.head) + 40);
    ck_assert_int_eq(pwrite(part.file, "torn", 4, torn), 4);
    ck_assert_uint_eq(sweep_part_get(&part, 0, runs, records), 5);
    ck_assert_int_eq(ftruncate(part.file, torn - 40), 0);
    ck_assert_uint_eq(sweep_part_get(&part, 2, runs, records), 3);
    sweep_part_forget(&part);
    ck_assert_int_eq(access(part.path, F_OK), 0); /* it has records */
    sweep_part_close(&part);
    free(records);
    remove_folder(folder);
}
END_TEST

static gough_status write_shard(const char *text, const char *path, size_t shard, size_t shards) {
    gough_sweep *sweep = NULL;
    char *messages = NULL;
    gough_error error = {.message = ""};
    gough_sweep_options options = gough_sweep_options_default();
    gough_sweep_summary summary;
    const gough_sweep_output output = {.path = path, .shard = shard, .shards = shards};
    ck_assert_msg(gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &messages) ==
                      GOUGH_OK,
                  "%s", messages);
    options.threads = 1;
    const gough_status status = gough_sweep_write(sweep, &options, &output, &summary, &error);
    gough_sweep_free(sweep);
    return status;
}

START_TEST(shards_of_other_sweeps_do_not_merge) {
    static const char base[] = "units: dimensionless\n"
                               "platform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, "
                               "half_angle: 15}, height: 1.2}\n"
                               "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
                               "simulation: {duration: 0.1}\n"
                               "sweep: {keys: {load.mass: [1, 2, 3, 4]}}\n";
    char folder[PATH_SIZE], one[PATH_SIZE], two[PATH_SIZE], table[PATH_SIZE], other[600];
    const char *shards[] = {one, two};
    gough_sweep_summary summary;
    gough_error error;
    make_folder(folder);
    path_in(folder, "1.shard", one);
    path_in(folder, "2.shard", two);
    path_in(folder, "a.csv", table);
    ck_assert_int_eq(write_shard(base, one, 1, 2), GOUGH_OK);
    for (int change = 0; change < 3; change++) {
        strcpy(other, base);
        if (change == 0) strstr(other, "1.2")[2] = '3'; /* as long, but different */
        if (change == 1) strcat(other, "title: longer\n");
        ck_assert_int_eq(write_shard(other, two, 2, change == 2 ? 3 : 2), GOUGH_OK);
        ck_assert_int_eq(gough_sweep_merge(shards, 2, table, &summary, &error), GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "are not from the same sweep"));
        ck_assert_int_ne(access(table, F_OK), 0);
    }
    ck_assert_int_eq(write_shard(base, two, 2, 2), GOUGH_OK);
    ck_assert_int_eq(gough_sweep_merge(shards, 2, table, &summary, &error), GOUGH_OK);
    ck_assert_uint_eq(summary.runs, 4);
    /* what stands behind the last record does not matter; a shard may have no run */
    size_t length;
    char *bytes = read_bytes(two, &length), *more = calloc(length + 1000, 1);
    memcpy(more, bytes, length);
    write_bytes(two, more, length + 1000);
    ck_assert_int_eq(gough_sweep_merge(shards, 2, table, &summary, &error), GOUGH_OK);
    ck_assert_uint_eq(summary.runs, 4);
    free(more);
    free(bytes);
    static sweep_part part;
    ck_assert_int_eq(write_shard(base, one, 1, 9), GOUGH_OK);
    ck_assert_int_eq(sweep_part_read(&part, one, &error), GOUGH_OK);
    ck_assert_uint_eq(part.done, 0);
    sweep_part_close(&part);
    remove_folder(folder);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "sweep/part", 60, each_number_of_a_head_is_checked, sizes_of_units_are_those_of_their_words,
        no_key_comes_twice_and_none_after_the_thousandth, a_head_is_as_long_as_it_says,
        a_text_has_no_nul, a_kind_of_sweep_that_does_not_exist_is_refused,
        records_come_back_until_the_first_that_is_torn, shards_of_other_sweeps_do_not_merge);
}
