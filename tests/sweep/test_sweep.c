/* Files of sweeps: a damaged shard is refused wherever the damage is, and a part goes on from any length. */
#define _XOPEN_SOURCE 700
#include "gough/sweep.h"

#include "support/suite.h"
#include "sweep/sweep_identity.h"
#include "table/by_hand.h"

static const char study[] = "units: dimensionless\n"
                            "platform:\n"
                            "  base: {radius: 1.0, half_angle: 15}\n"
                            "  top: {radius: 0.6, half_angle: 15}\n"
                            "  height: 1.2\n"
                            "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
                            "simulation: {duration: 1, method: rk4, step: 0.05}\n"
                            "control: {stiffness: 5}\n"
                            "sweep: {keys: {load.mass: {from: 1, to: 2, steps: 9}}}\n";

static gough_sweep *new_sweep(void) {
    gough_sweep *sweep = NULL;
    char *messages = NULL;
    ck_assert_msg(gough_sweep_parse("study.yaml", study, strlen(study), NULL, 0, &sweep,
                                    &messages) == GOUGH_OK,
                  "%s", messages);
    return sweep;
}

static gough_status run_into(const char *path, size_t shard, size_t shards,
                             gough_sweep_summary *summary, gough_error *error) {
    gough_sweep *sweep = new_sweep();
    gough_sweep_options options = gough_sweep_options_default();
    const gough_sweep_output output = {.path = path, .shard = shard, .shards = shards};
    options.threads = 1;
    *error = (gough_error){.message = ""};
    const gough_status status = gough_sweep_write(sweep, &options, &output, summary, error);
    gough_sweep_free(sweep);
    return status;
}

static void expect_same(const char *path, const char *bytes, size_t length) {
    size_t other;
    char *there = read_bytes(path, &other);
    ck_assert_uint_eq(other, length);
    ck_assert(memcmp(there, bytes, length) == 0);
    free(there);
}

START_TEST(damaged_shards_are_refused) {
    char folder[PATH_SIZE], one[PATH_SIZE], two[PATH_SIZE], table[PATH_SIZE];
    const char *shards[] = {one, two};
    gough_sweep_summary summary;
    gough_error error;
    make_folder(folder);
    path_in(folder, "1.shard", one);
    path_in(folder, "2.shard", two);
    path_in(folder, "a.csv", table);
    ck_assert_int_eq(run_into(one, 1, 2, &summary, &error), GOUGH_OK);
    ck_assert_int_eq(run_into(two, 2, 2, &summary, &error), GOUGH_OK);
    ck_assert_int_eq(gough_sweep_merge(shards, 2, table, &summary, &error), GOUGH_OK);
    ck_assert_uint_eq(summary.runs, 9);
    size_t length;
    char *bytes = read_bytes(two, &length);
    for (size_t at = 0; at < length; at++) {
        bytes[at] ^= (char)(1 << at % 8);
        write_bytes(two, bytes, length);
        bytes[at] ^= (char)(1 << at % 8);
        ck_assert_msg(gough_sweep_merge(shards, 2, table, &summary, &error) == GOUGH_ERROR_INPUT,
                      "byte %zu of %zu", at, length);
        ck_assert_ptr_nonnull(strstr(error.message, ".shard"));
    }
    for (size_t cut = 0; cut < length; cut++) {
        write_bytes(two, bytes, cut);
        ck_assert_int_eq(gough_sweep_merge(shards, 2, table, &summary, &error), GOUGH_ERROR_INPUT);
    }
    free(bytes);
    remove_folder(folder);
}
END_TEST

START_TEST(parts_of_any_length_go_on) {
    char folder[PATH_SIZE], whole[PATH_SIZE], path[PATH_SIZE], part[PATH_SIZE], shard[PATH_SIZE];
    gough_sweep_summary summary;
    gough_error error;
    make_folder(folder);
    path_in(folder, "whole.csv", whole);
    path_in(folder, "a.csv", path);
    path_in(folder, "a.csv.part", part);
    path_in(folder, "all.shard", shard);
    ck_assert_int_eq(run_into(whole, 0, 0, &summary, &error), GOUGH_OK);
    ck_assert_int_eq(run_into(shard, 1, 1, &summary, &error), GOUGH_OK);
    size_t length, whole_length;
    char *bytes = read_bytes(shard, &length); /* all of it as one shard is a whole part */
    char *wanted = read_bytes(whole, &whole_length);
    size_t resumed = 0;
    for (size_t cut = 0; cut <= length; cut += cut + 37 < length ? 37 : 1) {
        write_bytes(part, bytes, cut);
        ck_assert_msg(run_into(path, 0, 0, &summary, &error) == GOUGH_OK, "%s", error.message);
        ck_assert_uint_ge(summary.resumed, resumed);
        resumed = summary.resumed;
        expect_same(path, wanted, whole_length);
        ck_assert_int_ne(access(part, F_OK), 0);
    }
    ck_assert_uint_eq(resumed, 9);
    /* of another sweep, by any byte of its head */
    bytes[100] ^= 1;
    write_bytes(part, bytes, length);
    ck_assert_int_eq(run_into(path, 0, 0, &summary, &error), GOUGH_ERROR_INPUT);
    expect_same(part, bytes, length);
    free(bytes);
    free(wanted);
    remove_folder(folder);
}
END_TEST

/* The checksum of a file of records, as sweep_bytes.h has it. */
static uint64_t checksum(uint64_t seed, const char *bytes, size_t length) {
    uint64_t sum = 0xcbf29ce484222325u ^ seed, word;
    for (; length >= 8; bytes += 8, length -= 8) {
        memcpy(&word, bytes, 8);
        sum = (sum ^ word) * 0x100000001b3u;
        sum ^= sum >> 32;
    }
    for (; length > 0; bytes++, length--) sum = (sum ^ (unsigned char)*bytes) * 0x100000001b3u;
    return sum;
}

/* Puts right checksums into a shard of records of `size` bytes. */
static void seal(char *bytes, size_t length, size_t size) {
    uint64_t rest, sum;
    memcpy(&rest, bytes + 40, 8);
    const size_t head = 48 + (size_t)rest;
    sum = checksum(0, bytes, head);
    memcpy(bytes + head, &sum, 8);
    const uint64_t seed = checksum(0, bytes, head + 8);
    for (size_t at = head + 8; at + size <= length; at += size) {
        sum = checksum(seed, bytes + at, size - 8);
        memcpy(bytes + at + size - 8, &sum, 8);
    }
}

static char *find_bytes(char *bytes, size_t length, const char *wanted) {
    for (size_t at = length - strlen(wanted); at > 0; at--)
        if (memcmp(bytes + at, wanted, strlen(wanted)) == 0) return bytes + at;
    ck_abort_msg("no %s", wanted);
    return NULL;
}

/* Shards with right checksums whose columns, units or ends are none that gough writes. */
START_TEST(forged_shards_are_refused) {
    static const char *const forged[][2] = {
        {"load.mass", "load.\033ass"},      {"load.mass", "load,mass"}, {"load.mass", "load.mas\n"},
        {"load.mass", "gravity\0x"},        {"load.mass", "load.mesh"}, {"load.mass", "position_"},
        {"load.mass", "\xe2\x80\xae.mass"}, {"load.mass", "load.=1+1"}};
    char folder[PATH_SIZE], one[PATH_SIZE], table[PATH_SIZE];
    const char *shards[] = {one};
    gough_sweep_summary summary;
    gough_error error;
    make_folder(folder);
    path_in(folder, "1.shard", one);
    path_in(folder, "a.csv", table);
    ck_assert_int_eq(run_into(one, 1, 1, &summary, &error), GOUGH_OK);
    size_t length;
    char *bytes = read_bytes(one, &length);
    uint64_t rest;
    memcpy(&rest, bytes + 40, 8);
    const size_t records = 48 + (size_t)rest + 8, size = (length - records) / 9;
    char *copy = malloc(length);
    memcpy(copy, bytes, length);
    seal(copy, length, size);
    ck_assert(memcmp(copy, bytes, length) == 0);
    for (size_t i = 0; i < sizeof forged / sizeof forged[0]; i++) {
        memcpy(copy, bytes, length);
        memcpy(find_bytes(copy, records, forged[i][0]), forged[i][1], 9);
        seal(copy, length, size);
        write_bytes(one, copy, length);
        ck_assert_msg(gough_sweep_merge(shards, 1, table, &summary, &error) == GOUGH_ERROR_INPUT,
                      "'%s' merges", forged[i][1]);
        ck_assert_ptr_null(strpbrk(error.message, "\033\n\xe2"));
        ck_assert_int_ne(access(table, F_OK), 0);
    }
    /* a cause that there is not, a leg that there is not, another run */
    for (int field = 0; field < 3; field++) {
        const uint64_t value = field == 0 ? (uint64_t)200 << 8 : field == 1 ? 7 : 5;
        memcpy(copy, bytes, length);
        memcpy(copy + records + (field == 2 ? 0 : 8), &value, 8);
        seal(copy, length, size);
        write_bytes(one, copy, length);
        ck_assert_msg(gough_sweep_merge(shards, 1, table, &summary, &error) == GOUGH_ERROR_INPUT,
                      "field %d", field);
    }
    free(copy);
    free(bytes);
    remove_folder(folder);
}
END_TEST

/* A part goes on only where plan and numbers are the same, whatever its text says. */
START_TEST(parts_are_tied_to_plan_and_numbers) {
    char folder[PATH_SIZE], path[PATH_SIZE], part[PATH_SIZE], shard[PATH_SIZE];
    gough_sweep_summary summary;
    gough_error error;
    make_folder(folder);
    path_in(folder, "a.csv", path);
    path_in(folder, "a.csv.part", part);
    path_in(folder, "all.shard", shard);
    ck_assert_int_eq(run_into(shard, 1, 1, &summary, &error), GOUGH_OK);
    size_t length;
    char *bytes = read_bytes(shard, &length);
    uint64_t rest;
    memcpy(&rest, bytes + 40, 8);
    const size_t records = 48 + (size_t)rest + 8, size = (length - records) / 9;
    /* digests stand behind the texts of settings (none here) and that of recorded motion (0) */
    const char zeros[16] = {0};
    size_t at = (size_t)(find_bytes(bytes, records, "sweep: {keys") - bytes);
    while (memcmp(bytes + at, zeros, sizeof zeros) != 0) at++;
    for (size_t digest = at + 16; digest < at + 32; digest += 8) {
        uint64_t number;
        memcpy(&number, bytes + digest, 8);
        ck_assert(number != 0);
        bytes[digest + 3] ^= 1;
        seal(bytes, length, size);
        write_bytes(part, bytes, length);
        ck_assert_int_eq(run_into(path, 0, 0, &summary, &error), GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "belongs to a different sweep"));
        expect_same(part, bytes, length);
        bytes[digest + 3] ^= 1;
    }
    seal(bytes, length, size);
    write_bytes(part, bytes, length);
    ck_assert_int_eq(run_into(path, 0, 0, &summary, &error), GOUGH_OK);
    ck_assert_uint_eq(summary.resumed, 9);
    free(bytes);
    remove_folder(folder);
}
END_TEST

START_TEST(without_a_path_there_is_a_summary) {
    gough_sweep_summary summary;
    gough_error error;
    ck_assert_int_eq(run_into(NULL, 0, 0, &summary, &error), GOUGH_OK);
    ck_assert_uint_eq(summary.runs, 9);
    ck_assert_uint_eq(summary.ended[GOUGH_END_DONE], 9);
    ck_assert(summary.position.greatest >= summary.position.least);
    ck_assert_int_eq(run_into("a.txt", 0, 0, &summary, &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(run_into("a.csv", 1, 2, &summary, &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(run_into("a.shard", 3, 2, &summary, &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(run_into("/nowhere/at/all/a.csv", 0, 0, &summary, &error), GOUGH_ERROR_FILE);
}
END_TEST

/* Runs a sweep in two pieces, as a runner that shares it out does. */
static gough_status run_in_two(void *context, const gough_sweep *sweep,
                               const gough_sweep_options *options, gough_sweep_sink sink,
                               void *sink_context, gough_error *error) {
    gough_sweep_options own = *options;
    own.last = options->first + (options->last - options->first) / 2;
    gough_status status = gough_sweep_run(sweep, &own, sink, sink_context, error);
    own.first = own.last + 1;
    own.last = options->last;
    if (status == GOUGH_OK) status = gough_sweep_run(sweep, &own, sink, sink_context, error);
    ++*(int *)context;
    return status;
}

START_TEST(another_runner_writes_the_same_bytes) {
    char folder[PATH_SIZE], own[PATH_SIZE], other[PATH_SIZE];
    gough_sweep_summary summary;
    gough_error error;
    int called = 0;
    make_folder(folder);
    path_in(folder, "own.csv", own);
    path_in(folder, "other.csv", other);
    ck_assert_int_eq(run_into(own, 0, 0, &summary, &error), GOUGH_OK);
    gough_sweep *sweep = new_sweep();
    const gough_sweep_options options = gough_sweep_options_default();
    const gough_sweep_output output = {
        .path = other, .runner = run_in_two, .runner_context = &called};
    ck_assert_int_eq(gough_sweep_write(sweep, &options, &output, &summary, &error), GOUGH_OK);
    ck_assert_int_eq(called, 1);
    size_t length;
    char *bytes = read_bytes(own, &length);
    expect_same(other, bytes, length);
    free(bytes);
    gough_sweep_free(sweep);
    remove_folder(folder);
}
END_TEST

/* What changes numbers changes the identity; threads, lanes and where it is computed do not. */
START_TEST(the_identity_of_a_sweep_is_that_of_its_numbers) {
    gough_sweep *sweep = new_sweep(), *other = NULL;
    char *messages = NULL;
    gough_sweep_options options = gough_sweep_options_default();
    const uint64_t identity = gough_sweep_identity(sweep, &options);
    ck_assert(identity != 0);
    options.threads = 3;
    options.lanes = 2;
    ck_assert(gough_sweep_identity(sweep, &options) == identity);
    options.sizing = true;
    ck_assert(gough_sweep_identity(sweep, &options) != identity);
    options.sizing = false;
    options.forces = true;
    ck_assert(gough_sweep_identity(sweep, &options) != identity);
    options.forces = false;
    /* settings of all lengths modulo 8 */
    const char *const value[] = {"1.5", "1.25", "1.125", "1.0625", "1.03125", "2", "2.5", "1.2500"};
    uint64_t met[8];
    for (size_t i = 0; i < 8; i++) {
        const gough_setting setting = {"load.mass", value[i]};
        ck_assert_int_eq(
            gough_sweep_parse("study.yaml", study, strlen(study), &setting, 1, &other, &messages),
            GOUGH_OK);
        met[i] = gough_sweep_identity(other, &options);
        ck_assert(met[i] != 0 && met[i] != identity);
        for (size_t k = 0; k < i; k++) ck_assert(met[i] != met[k]);
        gough_sweep_free(other);
    }
    options.size++;
    ck_assert(gough_sweep_identity(sweep, &options) == 0);
    gough_sweep_free(sweep);
}
END_TEST

/* Else the column of a swept key would claim to have no dimension. */
START_TEST(the_unit_of_every_key_has_a_label) {
    size_t keys, units = 0;
    const gough_units si = gough_units_si(), none = {.dimensionless = true};
    const gough_key *key = gough_study_keys(&keys);
    for (size_t i = 0; i < keys; i++) {
        const bool degrees = strstr(key[i].unit, "[degrees]") != NULL;
        if (key[i].unit[0] == '\0' || strcmp(key[i].unit, "as KEY") == 0) continue;
        ck_assert_msg(strcmp(gough_unit_label(&si, gough_unit_of_field(key[i].unit)), "1") != 0,
                      "%s: %s", key[i].path, key[i].unit);
        ck_assert_msg(degrees == (strncmp(gough_unit_label(&none, gough_unit_of_field(key[i].unit)),
                                          "deg", 3) == 0),
                      "%s: %s", key[i].path, key[i].unit);
        units++;
    }
    ck_assert_uint_gt(units, 50);
}
END_TEST

int main(void) {
    return SUITE_RUN("sweep/sweep", 120, damaged_shards_are_refused, parts_of_any_length_go_on,
                     forged_shards_are_refused, parts_are_tied_to_plan_and_numbers,
                     without_a_path_there_is_a_summary, another_runner_writes_the_same_bytes,
                     the_identity_of_a_sweep_is_that_of_its_numbers,
                     the_unit_of_every_key_has_a_label);
}
