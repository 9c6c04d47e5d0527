/* Memory that runs out anywhere in reading a study: the reading ends as it would have, or says so; nothing is left allocated.
 * Faults: malloc calloc realloc open_memstream fclose study_arena_take study_arena_copy fy_diag_create fy_parser_create
 * Faults: fy_parser_set_string fy_token_iter_create newlocale read fstat lseek */
#define _GNU_SOURCE
#include <dirent.h>
#include <libfyaml.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "gough/sweep.h"

#include "study/arena.h"
#include "study/helpers.h"
#include "study/source.h"
#include "support/faults.h"
#include "support/suite.h"

FAULTY_MALLOC;
FAULTY_CALLOC;
FAULTY_REALLOC;
FAULTY_OPEN_MEMSTREAM;
FAULTY_READ;
FAULTY_FSTAT;
FAULTY(struct fy_diag *, fy_diag_create, (const struct fy_diag_cfg *how), NULL, how);
FAULTY(struct fy_parser *, fy_parser_create, (const struct fy_parse_cfg *how), NULL, how);
FAULTY(int, fy_parser_set_string, (struct fy_parser * parser, const char *text, size_t length), -1,
       parser, text, length);
FAULTY(struct fy_token_iter *, fy_token_iter_create, (struct fy_token * token), NULL, token);
FAULTY(locale_t, newlocale, (int categories, const char *name, locale_t base), (locale_t)0,
       categories, name, base);
FAULTY(void *, study_arena_take, (study_arena * arena, size_t size),
       (arena->exhausted = true, NULL), arena, size);
FAULTY(char *, study_arena_copy, (study_arena * arena, const char *text, size_t length),
       (arena->exhausted = true, NULL), arena, text, length);

/* a stream into memory that could not grow: it is closed, but not complete */
int __real_fclose(FILE *stream);
int __wrap_fclose(FILE *stream);
int __wrap_fclose(FILE *stream) {
    const bool fails = fault_comes("fclose");
    return __real_fclose(stream) != 0 || fails ? EOF : 0;
}

/* a file that grows when it is read once more: the text `growth` is added to the file `growing` */
static const char *growing, *growth;
off_t __real_lseek(int file, off_t offset, int from);
off_t __wrap_lseek(int file, off_t offset, int from);
off_t __wrap_lseek(int file, off_t offset, int from) {
    if (fault_comes("lseek")) {
        FILE *more = fopen(growing, "a");
        fputs(growth, more);
        __real_fclose(more);
    }
    return __real_lseek(file, offset, from);
}

static const char *const each[] = {"malloc",
                                   "calloc",
                                   "realloc",
                                   "open_memstream",
                                   "fclose",
                                   "study_arena_take",
                                   "study_arena_copy",
                                   "fy_diag_create",
                                   "fy_parser_create",
                                   "fy_parser_set_string",
                                   "fy_token_iter_create"};
enum { EACH = sizeof each / sizeof each[0] };

/* One way to read a text: what came of it, as text; NULL: out of memory. */
typedef char *way(const char *text, size_t length, const gough_setting *setting, size_t settings);

/* Takes the messages; NULL if they are of memory, or if there was not even memory for them. */
static char *outcome(gough_status status, char *messages, const char *more) {
    const bool full = messages && (strstr(messages, "error: out of memory") ||
                                   strstr(messages, strerror(ENOMEM)));
    fault_disarm(); /* Check allocates too */
    const size_t size = strlen(more) + (messages ? strlen(messages) : 0) + 20;
    char *made = malloc(size);
    ck_assert_ptr_nonnull(made);
    snprintf(made, size, "%d %s %s", (int)status, messages ? messages : "", more);
    const bool none = status == GOUGH_ERROR_FILE && (!messages || full);
    ck_assert(none || status == GOUGH_OK || messages);
    gough_study_free_messages(messages);
    if (!none) return made;
    free(made);
    return NULL;
}

static char *as_study(const char *text, size_t length, const gough_setting *setting,
                      size_t settings) {
    gough_study *study = NULL;
    char *messages = NULL, place[200] = "", more[600] = "";
    const gough_status status =
        gough_study_parse("./study.yaml", text, length, setting, settings, &study, &messages);
    if (study) {
        const gough_motion *motion = &study->model->motion;
        gough_study_place(study, "platform.height", place, sizeof place);
        snprintf(more, sizeof more, "%s %s %zu %zu %zu", place, study->title, motion->moves,
                 motion->samples.count, study->record ? study->record->remarks : 0);
    }
    gough_study_free(study);
    char *made = outcome(status, messages, more);
    ck_assert((status == GOUGH_OK) == (study != NULL));
    return made;
}

/* and its first and last run */
static char *as_sweep(const char *text, size_t length, const gough_setting *setting,
                      size_t settings) {
    gough_sweep *sweep = NULL;
    char *messages = NULL, more[1200] = "";
    gough_error error = {.message = ""};
    gough_status status =
        gough_sweep_parse("./study.yaml", text, length, setting, settings, &sweep, &messages);
    gough_sweep_maker *maker = sweep ? gough_sweep_maker_new(sweep) : NULL;
    if (sweep && !maker) status = GOUGH_ERROR_FILE;
    for (int last = 0; maker && last < 2; last++) {
        const size_t run = last ? gough_sweep_runs(sweep) : 1;
        const gough_study *study;
        const gough_status made = gough_sweep_make(maker, run, &study, &error);
        if (made == GOUGH_ERROR_FILE) status = made;
        snprintf(more + strlen(more), 600, "%d %.17g %s\n", (int)made,
                 study->model->machine.load.mass, made == GOUGH_OK ? "" : error.message);
    }
    gough_sweep_maker_free(maker);
    gough_sweep_free(sweep);
    return outcome(status, messages, more);
}

/* a file of recorded motion, whose path is the text */
static char *as_record(const char *text, size_t length, const gough_setting *setting,
                       size_t settings) {
    gough_motion_file *file = NULL;
    char *messages = NULL, more[3000] = "";
    (void)length, (void)setting, (void)settings;
    const gough_status status = gough_motion_file_read(text, &file, &messages);
    if (file)
        snprintf(more, sizeof more, "%zu %d %s %s", file->rows, file->certain, file->mapping,
                 file->column[0].name);
    gough_motion_file_free(file);
    return outcome(status, messages, more);
}

/* and its text with the first number at its least */
static char *as_design(const char *text, size_t length, const gough_setting *setting,
                       size_t settings) {
    gough_design_study *design = NULL;
    char *messages = NULL, more[3000] = "";
    gough_error error = {.message = ""};
    gough_design_request request = gough_design_request_default();
    gough_status status = gough_design_study_parse("./study.yaml", text, length, setting, settings,
                                                   &design, &messages);
    if (design) {
        const char *written = NULL;
        gough_design_study_request(design, &request, sizeof request);
        request.start[0] = request.least[0];
        const gough_status made = gough_design_study_text(design, request.start, &written, &error);
        if (made == GOUGH_ERROR_FILE) status = made;
        snprintf(more, sizeof more, "%d %s %s", (int)made, written ? written : "", error.message);
    }
    gough_design_study_free(design);
    return outcome(status, messages, more);
}

/* Lets each call of each function fail once. */
static void let_fail(const char *what, way *read, const char *text, size_t length,
                     const gough_setting *setting, size_t settings) {
    char *undisturbed = read(text, length, setting, settings);
    ck_assert_msg(undisturbed != NULL, "%s", what);
    for (size_t i = 0; i < EACH; i++)
        for (long n = 1; n > 0; n++) {
            fault_arm(each[i], n, ENOMEM);
            char *found = read(text, length, setting, settings);
            const bool came = fault_disarm();
            ck_assert_msg(!found || strcmp(found, undisturbed) == 0,
                          "%s, call %ld of %s: expected\n%s\nfound\n%s", what, n, each[i],
                          undisturbed, found);
            free(found);
            if (!came) break;
        }
    free(undisturbed);
}

static void both_ways(const char *what, const char *text, const gough_setting *setting,
                      size_t settings) {
    let_fail(what, as_study, text, strlen(text), setting, settings);
    let_fail(what, as_sweep, text, strlen(text), setting, settings);
}

START_TEST(memory_may_end_in_any_study_of_the_corpus) {
    char folder[600], path[900], text[20000];
    snprintf(folder, sizeof folder, "%s/tests/fuzz/corpus/study", getenv("SOURCE"));
    DIR *all = opendir(folder);
    ck_assert_ptr_nonnull(all);
    int files = 0;
    for (struct dirent *entry; (entry = readdir(all));) {
        if (entry->d_name[0] == '.') continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        FILE *file = fopen(path, "rb");
        ck_assert_ptr_nonnull(file);
        text[fread(text, 1, sizeof text - 1, file)] = '\0';
        fclose(file);
        both_ways(entry->d_name, text, NULL, 0);
        files++;
    }
    closedir(all);
    ck_assert_int_gt(files, 10);
}
END_TEST

START_TEST(memory_may_end_in_settings) {
    const gough_setting settings[] = {{"control.stiffness", "[1, 2, 3, 4, 5, 6]"},
                                      {"control.stiffness.2", "7"},
                                      {"motion.moves", "[{start: 1, duration: 2, heave: 0.1}]"},
                                      {"motion.moves.1.heave", "0.2"},
                                      {"sweep.keys.load.mass.from", "1"},
                                      {"sweep.keys.load.mass.to", "2"},
                                      {"sweep.keys.load.mass.steps", "3"},
                                      {"sweep.keys.control.damping", "[1, 2]"},
                                      {"sweep.keys.motion.moves.1.roll", "{normal: [0, 1]}"},
                                      {"load.inertia.9", "1"},
                                      {"load.mass.3", "1"},
                                      {"no.such.key", "1"},
                                      {"title", "\"a\\u00e9b\""}};
    enum { COUNT = sizeof settings / sizeof settings[0] };
    both_ways("right settings", good_study, settings, 9);
    both_ways("a missing element", good_study, settings + 9, 1);
    both_ways("a word instead of a list", good_study, settings + 10, 1);
    const gough_setting swept = {"sweep.keys.load.mess", "[1, 2]"};
    both_ways("an unknown key that varies", good_study, &swept, 1);
    both_ways("unknown", good_study, settings + 11, COUNT - 11);
    const gough_setting loads[] = {{"external", "[{force: [1, 2, 3]}]"},
                                   {"sweep.keys.external.1.moment.2", "[1, 2]"},
                                   {"sweep.keys.load.inertia", "[1]"}};
    both_ways("known loads", good_study, loads, 1);
    both_ways("an element of a list that is missing", good_study, loads, 2);
    both_ways("a list that varies", good_study, loads + 2, 1);
}
END_TEST

START_TEST(memory_may_end_in_designs) {
    static const char section[] = "workspace: {box: {heave: 0.1}}\n"
                                  "design:\n"
                                  "  vary: {platform.height: [0.2, 1], load.mass: [5, 8]}\n"
                                  "  minimize: {force: 1}\n";
    const gough_setting settings[] = {{"load.mass", "7"},
                                      {"design.vary.platform.height", "[0.2, 2]"},
                                      {"design.vary.platform.hight", "[1, 2]"}};
    char text[2000];
    snprintf(text, sizeof text, "%s%s", good_study, section);
    for (size_t count = 0; count <= 3; count++)
        let_fail("a design", as_design, text, strlen(text), settings, count);
    let_fail("no design", as_design, good_study, strlen(good_study), NULL, 0);
}
END_TEST

START_TEST(memory_may_end_in_recorded_motion) {
    static const char csv[] = "t,heave,pitch\n0,0,0\n0.5,0.1,60\n1,0.2,100\n1.5,0.1,60\n2,0,0\n"
                              "2.5,0,0\n";
    static const char *const smooth[] = {"", "smooth: rounding", "smooth: {heave: 0.01}",
                                         "cutoff: 0.5", "smooth: none"};
    char text[2000], *path = write_file("motion.csv", csv, sizeof csv - 1);
    for (size_t i = 0; i < sizeof smooth / sizeof smooth[0]; i++) {
        snprintf(text, sizeof text, "%smotion: {samples: '%s', %s}\nsimulation: {duration: 1}\n",
                 good_study, path, smooth[i]);
        let_fail(smooth[i], as_study, text, strlen(text), NULL, 0);
    }
    forget_file(path);
}
END_TEST

/* records by mappings, wrong ones, and files by themselves */
START_TEST(memory_may_end_in_any_record) {
    static const char *const records[][2] = {
        {"t,heave\n0,a\n1,b\n", ""},
        {"t,heave\ns,x\n0,0\n1,1\n", ""},
        {"a,b\nx,y\n", ""},
        {"a b\n0 0\n1 2\n", ", time: 1, columns: {heave: 2}"},
        {"t,a,a\n0,0,0\n", ", columns: {heave: a}"},
        {"", ""},
        {"t;w (x);x;y;z;heave\n0;1;0;0;0;a\n1;1;0;0;0;0,5\n2;1;0;0;0,1;0\n",
         ", columns: {qw: 2, qx: x, qy: y, qz: z}, from_first: true, order: xyz"},
        {"t,heave\n0,0\n1,1\n", ", columns: {heave: heav, sway: {unit: m}}"},
        {"0 0 0\n1 2 3\n2 3 4\n", ", time: 1, columns: {heave: 2, yaw: {column: 3, unit: ell}}"}};
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        char text[2000], *path = write_file("r.csv", records[i][0], strlen(records[i][0]));
        snprintf(text, sizeof text,
                 "%smotion: {samples: {file: '%s'%s}}\nsimulation: {duration: 1}\n", good_study,
                 path, records[i][1]);
        let_fail(records[i][0], as_study, text, strlen(text), NULL, 0);
        let_fail(records[i][0], as_record, path, 0, NULL, 0);
        forget_file(path);
    }
}
END_TEST

/* Reads a study with a record that takes several reads, while one call fails. Returns the messages, "" without any. */
static char *read_with(const char *path, const char *name, long n, int number) {
    gough_study *study = NULL;
    char *messages = NULL;
    fault_arm(name, n, number);
    const gough_status status = gough_study_read(path, NULL, 0, &study, &messages);
    ck_assert(fault_disarm());
    ck_assert_int_eq(status, messages ? GOUGH_ERROR_FILE : GOUGH_OK);
    gough_study_free(study);
    return messages ? messages : calloc(1, 1);
}

static void expect_with(const char *path, const char *name, long n, int number, const char *said) {
    char *messages = read_with(path, name, n, number);
    ck_assert_msg(*said ? strstr(messages, said) != NULL : !*messages, "call %ld of %s: %s", n,
                  name, messages);
    free(messages);
}

START_TEST(files_that_cannot_be_read_are_named_with_the_cause) {
    enum { ROWS = 10000 };
    char text[2000], *csv = malloc(20 * ROWS);
    size_t length = (size_t)sprintf(csv, "t,heave\n");
    for (int i = 0; i < ROWS; i++) length += (size_t)sprintf(csv + length, "%d,%d\n", i, i % 7);
    char *record = write_file("motion.csv", csv, length);
    snprintf(text, sizeof text, "%smotion: {samples: '%s'}\nsimulation: {duration: 1}\n",
             good_study, record);
    char *path = write_file("study.yaml", text, strlen(text));
    for (long n = 1; n <= 4; n++) expect_with(path, "read", n, EINTR, "");
    expect_with(path, "read", 1, EIO, "study.yaml`: Input/output error");
    for (long n = 3; n <= 10; n++)
        expect_with(path, "read", n, EIO, "motion.csv`: Input/output error");
    expect_with(path, "fstat", 1, EIO, "study.yaml`: Input/output error");
    expect_with(path, "fstat", 2, EIO, "motion.csv`: Input/output error");
    expect_with(path, "fstat", 3, EIO, ""); /* whether it is regular has been found before */
    forget_file(record);
    /* a line for which the buffer grows */
    memset(csv, '#', 100000);
    memcpy(csv + 100000, "\nt,heave\n0,0\n9,0\n", 18);
    record = write_file("motion.csv", csv, 100018);
    forget_file(path);
    snprintf(text, sizeof text, "%smotion: {samples: '%s'}\nsimulation: {duration: 1}\n",
             good_study, record);
    path = write_file("study.yaml", text, strlen(text));
    expect_with(path, "realloc", 1, ENOMEM, "out of memory");
    forget_file(path);
    forget_file(record);
    free(csv);
}
END_TEST

/* reads the file `growing` from its start for the n-th time when it has grown by `growth`, by whole rows */
static void expect_grown(long n, bool study, const char *said) {
    static const char csv[] = "t,heave\n0,0\n1,1\n";
    char text[2000], *path = write_file("motion.csv", csv, sizeof csv - 1), *messages = NULL;
    gough_study *made = NULL;
    gough_motion_file *file = NULL;
    snprintf(text, sizeof text, "%smotion: {samples: '%s'}\nsimulation: {duration: 1}\n",
             good_study, path);
    growing = path;
    growth = "2,2\n3,3\n4,4\n5,5\n6,6\n";
    fault_arm("lseek", n, 0);
    const gough_status status =
        study ? gough_study_parse("./study.yaml", text, strlen(text), NULL, 0, &made, &messages)
              : gough_motion_file_read(path, &file, &messages);
    ck_assert(fault_disarm());
    ck_assert_msg((status == GOUGH_OK) == !*said && strstr(messages ? messages : "", said),
                  "read %ld times: %s", n, messages ? messages : "");
    if (made) ck_assert_uint_eq(made->model->motion.samples.count, 7);
    if (file) ck_assert_uint_eq(file->rows, n < 3 ? 7 : 3);
    gough_motion_file_free(file);
    gough_study_free(made);
    gough_study_free_messages(messages);
    forget_file(path);
}

/* between counting its rows, for which memory is taken, and reading them a log may grow */
START_TEST(a_file_that_grows_is_read_to_its_room) {
    for (long n = 1; n <= 3; n++) expect_grown(n, true, "");
    expect_grown(4, true, "motion.csv:5:1: error: the file has grown while it was read");
    for (long n = 1; n <= 3; n++) expect_grown(n, false, "");
}
END_TEST

/* studies may have 64 KiB, and a mark of the byte order before them; longer files are not read to their end */
START_TEST(long_files_are_refused_by_their_length) {
    static char text[2 * STUDY_MOST_BYTES];
    gough_study *study = NULL;
    char *messages = NULL;
    memset(text, '#', sizeof text);
    for (int i = 0; i < 3; i++) {
        char *path =
            write_file("long.yaml", text, i == 2 ? sizeof text : (size_t)STUDY_MOST_BYTES + 1);
        if (i == 1) fault_arm("realloc", 1, ENOMEM);
        const gough_status status = gough_study_read(path, NULL, 0, &study, &messages);
        if (i == 1) ck_assert(fault_disarm());
        ck_assert_int_eq(status, i == 1 ? GOUGH_ERROR_FILE : GOUGH_ERROR_INPUT);
        ck_assert_msg(strstr(messages, i == 0   ? "the text has 65537 bytes; the limit is 65536"
                                       : i == 1 ? "Cannot allocate memory"
                                                : "is larger than the 64 KiB"),
                      "%d: %s", i, messages);
        gough_study_free_messages(messages);
        forget_file(path);
    }
}
END_TEST

/* without a locale to print in, a number is printed in the one of the program */
START_TEST(a_number_is_printed_without_a_locale) {
    char text[GOUGH_SWEEP_TEXT];
    fault_arm("newlocale", 1, ENOMEM);
    gough_sweep_print(0.1, text);
    ck_assert(fault_disarm());
    ck_assert_str_eq(text, "0.1");
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/memory", 60, memory_may_end_in_any_study_of_the_corpus, memory_may_end_in_settings,
        memory_may_end_in_designs, memory_may_end_in_recorded_motion, memory_may_end_in_any_record,
        files_that_cannot_be_read_are_named_with_the_cause, a_file_that_grows_is_read_to_its_room,
        long_files_are_refused_by_their_length, a_number_is_printed_without_a_locale);
}
