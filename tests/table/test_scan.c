/* Tables read in parts have the numbers of tables read whole; errors have their place, also beyond the first part. */
#define _XOPEN_SOURCE 700
#include <stdint.h>
#include <sys/stat.h>

#include "support/suite.h"
#include "table/by_hand.h"
#include "table/table.h"

/* What parts bring, put together again. */
typedef struct whole {
    size_t calls, rows, columns, stop_at;
    char name[8][24];
    double *value[8];
    bool begun;
} whole;

enum { ROOM = 40000 };

static int take(void *context, const gough_table *part) {
    whole *w = context;
    if (!w->begun) {
        ck_assert_uint_eq(part->rows, 0);
        ck_assert_uint_le(part->columns, 8);
        w->columns = part->columns;
        for (size_t c = 0; c < part->columns; c++) {
            snprintf(w->name[c], sizeof w->name[c], "%s", part->name[c]);
            w->value[c] = calloc(ROOM, sizeof(double));
        }
    } else {
        ck_assert_uint_gt(part->rows, 0);
        ck_assert_uint_le(part->rows, RESULT_PART);
    }
    w->begun = true;
    w->calls++;
    ck_assert_uint_eq(part->columns, w->columns);
    ck_assert_uint_le(w->rows + part->rows, ROOM);
    for (size_t c = 0; c < part->columns && part->rows > 0; c++) {
        ck_assert_str_eq(part->name[c], w->name[c]);
        memcpy(w->value[c] + w->rows, part->value[c], part->rows * sizeof(double));
    }
    w->rows += part->rows;
    return w->stop_at > 0 && w->rows >= w->stop_at;
}

static void forget(whole *w) {
    for (size_t c = 0; c < w->columns; c++) free(w->value[c]);
    *w = (whole){.calls = 0};
}

static void expect_scan(const char *path, const char *const *wanted, whole *w) {
    gough_error error = {.message = ""};
    ck_assert_msg(gough_table_scan(path, wanted, take, w, &error) == GOUGH_OK, "%s", error.message);
}

static void write_table(const char *path, size_t rows) {
    gough_table *table = gough_table_new("parts", "test", 4, rows);
    static const char *const name[] = {"run", "a", "b", "end_cause"};
    gough_error error = {.message = ""};
    for (size_t c = 0; c < 4; c++) {
        double *value = gough_table_name(table, c, name[c], "m");
        for (size_t r = 0; r < rows; r++)
            value[r] = c == 0 ? (double)r : c == 3 ? (double)(r % 3) : awkward(r, (int)c);
    }
    ck_assert_msg(gough_table_write(table, NULL, path, &error) == GOUGH_OK, "%s", error.message);
    gough_table_free(table);
}

static const size_t counts[] = {0, 1, RESULT_PART, RESULT_PART + 1, 2 * RESULT_PART + 77};

START_TEST(parts_have_the_numbers_of_the_whole) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, _i % 2 ? "a.h5" : "a.csv", path);
    const size_t rows = counts[_i / 2];
    write_table(path, rows);
    gough_table *table;
    gough_error error = {.message = ""};
    ck_assert(gough_table_read(path, &table, &error) == GOUGH_OK);
    whole w = {.calls = 0};
    expect_scan(path, NULL, &w);
    ck_assert_uint_eq(w.rows, rows);
    ck_assert_uint_eq(w.columns, 4);
    ck_assert_uint_eq(w.calls, 1 + (rows + RESULT_PART - 1) / RESULT_PART);
    for (size_t c = 0; c < 4; c++) {
        ck_assert_str_eq(w.name[c], table->name[c]);
        ck_assert_mem_eq(w.value[c], table->value[c], rows * sizeof(double));
    }
    forget(&w);

    /* in the order of the file, without those that it does not have */
    static const char *const some[] = {"b", "missing", "run", NULL};
    expect_scan(path, some, &w);
    ck_assert_uint_eq(w.columns, 2);
    ck_assert_str_eq(w.name[0], "run");
    ck_assert_str_eq(w.name[1], "b");
    ck_assert_mem_eq(w.value[1], table->value[2], rows * sizeof(double));
    forget(&w);

    w.stop_at = 1;
    expect_scan(path, NULL, &w);
    ck_assert_uint_eq(w.rows, rows < RESULT_PART ? rows : RESULT_PART);
    forget(&w);
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    fputs(text, file);
    fclose(file);
}

START_TEST(texts_and_line_ends_are_those_of_whole_tables) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.csv", path);
    write_text(path, "\xef\xbb\xbft,end_cause\r\n1,done\r\n2,leg_long\r\n\r\n\n");
    whole w = {.calls = 0};
    expect_scan(path, NULL, &w);
    ck_assert_uint_eq(w.rows, 2);
    ck_assert_str_eq(w.name[0], "t");
    ck_assert(w.value[1][0] <= GOUGH_END_DONE && w.value[1][1] >= GOUGH_END_LEG_LONG);
    forget(&w);
    write_text(path, "t,a\n1,2\n3,4"); /* without an end of the last line */
    expect_scan(path, NULL, &w);
    ck_assert_uint_eq(w.rows, 2);
    forget(&w);
    remove_folder(folder);
}
END_TEST

/* a table whose columns have names only */
START_TEST(names_alone_have_no_numbers) {
    char *name = strdup("a");
    const gough_table table = {.columns = 1, .name = &name};
    ck_assert_ptr_null(gough_table_column(&table, "a"));
    free(name);
}
END_TEST

static void expect_refused(const char *path, const char *sentence) {
    whole w = {.calls = 0};
    gough_error error = {.message = ""};
    ck_assert_int_ne(gough_table_scan(path, NULL, take, &w, &error), GOUGH_OK);
    ck_assert_msg(strstr(error.message, sentence) != NULL, "%s", error.message);
    forget(&w);
}

START_TEST(errors_have_their_place_in_every_part) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.csv", path);
    write_text(path, "");
    expect_refused(path, "a.csv:1:1: the file is empty");
    write_text(path, "t,t\n");
    expect_refused(path, "a.csv:1:3: an earlier column has the same name");
    write_text(path, "t,a\n1,2\n\n3,4\n");
    expect_refused(path, "a.csv:3:1: an empty row");
    FILE *file = fopen(path, "w");
    fputs("t,a\n", file);
    for (int r = 0; r < RESULT_PART + 10; r++) fprintf(file, "%d,%d.%0100d\n", r, r, 1);
    fputs("5,x\n", file);
    fclose(file);
    expect_refused(path, "a.csv:16396:3: 'x' is not a number");
    static const char *const only[] = {"t", NULL}; /* numbers of other columns are not read */
    whole w = {.calls = 0};
    expect_scan(path, only, &w);
    ck_assert_uint_eq(w.rows, RESULT_PART + 11);
    forget(&w);
    expect_refused("/does/not/exist.csv", "/does/not/exist.csv");
    remove_folder(folder);
}
END_TEST

START_TEST(damaged_files_are_refused) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.h5", path);
    write_table(path, 3 * RESULT_PART / 2);
    struct stat about;
    ck_assert_int_eq(stat(path, &about), 0);
    ck_assert_int_eq(truncate(path, about.st_size / 2), 0);
    expect_refused(path, "a.h5");
    path_in(folder, "a.yaml", path);
    write_text(path, "title: a study\nunits: si\nplatform:\n  height: 1\n");
    expect_refused(path, "a.yaml");
    remove_folder(folder);
}
END_TEST

START_TEST(a_pipe_is_read_whole) {
    int ends[2];
    char path[40];
    static const char text[] = "t,a\n1,2\n";
    ck_assert_int_eq(pipe(ends), 0);
    ck_assert_int_eq(write(ends[1], text, sizeof text - 1), sizeof text - 1);
    ck_assert_int_eq(close(ends[1]), 0);
    snprintf(path, sizeof path, "/dev/fd/%d", ends[0]);
    whole w = {.calls = 0};
    expect_scan(path, NULL, &w);
    ck_assert_uint_eq(w.rows, 1);
    ck_assert_uint_eq(w.calls, 2);
    forget(&w);
    close(ends[0]);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("table/scan");
    TCase *cases = tcase_create("scan");
    tcase_set_timeout(cases, 60);
    tcase_add_loop_test(cases, parts_have_the_numbers_of_the_whole, 0,
                        2 * (int)(sizeof counts / sizeof counts[0]));
    tcase_add_test(cases, texts_and_line_ends_are_those_of_whole_tables);
    tcase_add_test(cases, errors_have_their_place_in_every_part);
    tcase_add_test(cases, damaged_files_are_refused);
    tcase_add_test(cases, a_pipe_is_read_whole);
    tcase_add_test(cases, names_alone_have_no_numbers);
    suite_add_tcase(suite, cases);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
