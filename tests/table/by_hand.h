/* A small run made by hand for the tests of result and report: no equations, numbers that are easy to check. */
#ifndef TESTS_RESULT_BY_HAND_H
#define TESTS_RESULT_BY_HAND_H

#include <check.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gough/result.h"

/* A study with nothing in it but what a table asks for: title, text, R_b = 4, M = 10, g = 9, so that √(R_b/g) = 2/3. */
static inline gough_study *study_by_hand(const char *title, bool everything) {
    gough_study *study = calloc(1, sizeof *study);
    study->model = calloc(1, sizeof *study->model);
    study->title = strdup(title);
    study->text = strdup("title: by hand\nunits: si\n");
    study->name = strdup("by hand");
    study->model->machine.base_radius = 4.0;
    study->model->machine.load.mass = 10.0;
    study->model->machine.gravity_magnitude = 9.0;
    study->simulation.reactions = study->simulation.joints = study->simulation.actuators =
        everything;
    return study;
}

static inline void free_study_by_hand(gough_study *study) {
    free(study->model);
    free(study->title);
    free(study->text);
    free(study->name);
    free(study);
}

/* Numbers with all their bits in use, of many sizes. */
static inline double awkward(size_t row, int column) {
    return ldexp(sin(1.0 + 0.37 * (double)row + 1.9 * column), (column * 7) % 80 - 40);
}

/* A table of `rows` rows of awkward numbers (t = row/8) that ended at its last row. */
static inline gough_result *result_by_hand(const gough_study *study, const char *verb, size_t rows,
                                           const gough_units *units) {
    gough_result *result = gough_result_new(study, verb, units);
    ck_assert(result != NULL);
    for (size_t r = 0; r < rows; r++) {
        gough_row row = {.quad = NULL};
        for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = awkward(r, c);
        row.value[GOUGH_T] = (double)r / 8.0;
        ck_assert_int_eq(gough_result_add(result, &row), 0);
    }
    const gough_end end = {.cause = GOUGH_END_LEG_LONG,
                           .time = (double)rows / 8.0,
                           .leg = 3,
                           .legs = 4,
                           .message = "leg 3 is too long"};
    gough_result_set_end(result, &end);
    return result;
}

static const gough_units own_units = {.length = 1, .mass = 1, .time = 1};

/* Writes a table by hand of a study of SI to a path. */
static inline void write_by_hand(const char *path, size_t rows) {
    gough_study *study = study_by_hand("by hand", true);
    gough_result *result = result_by_hand(study, "simulate", rows, &own_units);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_result_write(result, path, &error) == GOUGH_OK, "%s", error.message);
    gough_result_free(result);
    free_study_by_hand(study);
}

/* ---- files ----------------------------------------------------------------------------------------------------- */

enum { PATH_SIZE = 128 };

/* A folder of its own for a test, in the working folder of the tests; remove_folder() removes it with what is in it. */
static inline void make_folder(char folder[PATH_SIZE]) {
    strcpy(folder, "gough-test-XXXXXX");
    ck_assert(mkdtemp(folder) != NULL);
}

static inline void run_shell(const char *command) {
    ck_assert_msg(system(command) == 0, "%s", command);
}

static inline void remove_folder(const char *folder) {
    char command[PATH_SIZE + 16];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    run_shell(command);
}

static inline const char *path_in(const char *folder, const char *name, char path[PATH_SIZE]) {
    snprintf(path, PATH_SIZE, "%s/%s", folder, name);
    return path;
}

/* The whole of a file, terminated, for the caller to free. */
static inline char *read_bytes(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    ck_assert_msg(file != NULL, "%s is not there", path);
    ck_assert_int_eq(fseek(file, 0, SEEK_END), 0);
    *length = (size_t)ftell(file);
    rewind(file);
    char *bytes = calloc(*length + 1, 1);
    ck_assert_uint_eq(fread(bytes, 1, *length, file), *length);
    fclose(file);
    return bytes;
}

static inline void write_bytes(const char *path, const void *bytes, size_t length) {
    FILE *file = fopen(path, "wb");
    ck_assert(file != NULL);
    ck_assert_uint_eq(fwrite(bytes, 1, length, file), length);
    ck_assert_int_eq(fclose(file), 0);
}

/* How many entries a folder has, the hidden ones too. */
static inline int count_entries(const char *folder) {
    char command[PATH_SIZE + 32];
    snprintf(command, sizeof command, "ls -A '%s' | wc -l", folder);
    FILE *pipe = popen(command, "r");
    int count = -1;
    ck_assert(pipe != NULL && fscanf(pipe, "%d", &count) == 1);
    pclose(pipe);
    return count;
}

/* ---- a locale with a decimal comma ----------------------------------------------------------------------------- */

/* Compiles one into the folder and enters it; it needs the Debian package locales, not one of its locales. */
static inline void enter_comma_locale(const char *folder) {
    char command[4 * PATH_SIZE], full[1024];
    ck_assert(realpath(folder, full) != NULL);
    snprintf(
        command, sizeof command,
        "cd '%s' && printf 'comment_char %%%%\\nescape_char /\\nLC_NUMERIC\\ndecimal_point "
        "\"<U002C>\"\\nthousands_sep \"<U002E>\"\\ngrouping 3;3\\nEND LC_NUMERIC\\n' > comma && "
        "{ localedef -c -i ./comma \"$PWD/comma_LAND\" 2>/dev/null; test -e comma_LAND/LC_NUMERIC; "
        "}",
        folder);
    run_shell(command);
    setenv("LOCPATH", full, 1);
    ck_assert(setlocale(LC_ALL, "comma_LAND") != NULL);
    char half[8];
    snprintf(half, sizeof half, "%.1f", 0.5);
    ck_assert_str_eq(half, "0,5");
}

static inline void leave_comma_locale(void) {
    setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
}

#endif
