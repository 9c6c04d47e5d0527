/* What the tests of this room share. */
#define _POSIX_C_SOURCE 200809L
#include "study/helpers.h"

#include <check.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const good_study = "title: Test\n"
                               "units: dimensionless\n"
                               "platform:\n"
                               "  base: {radius: 1.0, half_angle: 15}\n"
                               "  top: {radius: 0.6, half_angle: 15}\n"
                               "  height: 1.2\n"
                               "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n";

reading read_bytes(const char *text, size_t length, const char *const settings[]) {
    reading made = {GOUGH_OK, NULL, NULL};
    gough_setting setting[16];
    char copy[16][200];
    size_t count = 0;
    for (; settings && settings[count]; count++) {
        ck_assert(count < 16 && strlen(settings[count]) < 200);
        strcpy(copy[count], settings[count]);
        char *equals = strchr(copy[count], '=');
        ck_assert_ptr_nonnull(equals);
        *equals = '\0';
        setting[count] = (gough_setting){copy[count], equals + 1};
    }
    made.status =
        gough_study_parse("study.yaml", text, length, setting, count, &made.study, &made.messages);
    ck_assert((made.status == GOUGH_OK) == (made.study != NULL));
    ck_assert((made.status == GOUGH_OK) == (made.messages == NULL));
    return made;
}

reading read_more(const char *more, const char *const settings[]) {
    char text[8192];
    const int length = snprintf(text, sizeof text, "%s%s", good_study, more);
    ck_assert(length > 0 && (size_t)length < sizeof text);
    return read_bytes(text, (size_t)length, settings);
}

void reading_free(reading *made) {
    gough_study_free(made->study);
    gough_study_free_messages(made->messages);
    *made = (reading){GOUGH_OK, NULL, NULL};
}

void expect_messages(const char *text, const char *const settings[], const char *messages) {
    reading made = read_bytes(text, strlen(text), settings);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_str_eq(made.messages, messages);
    reading_free(&made);
}

void expect_said(const char *text, const char *part) {
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_msg(made.status == GOUGH_ERROR_INPUT, "accepted:\n%s", text);
    ck_assert_msg(strstr(made.messages, part), "expected `%s` about\n%s\nfound\n%s", part, text,
                  made.messages);
    reading_free(&made);
}

reading expect_good(const char *more, const char *const settings[]) {
    reading made = read_more(more, settings);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    return made;
}

int occurrences(const char *text, const char *part) {
    int count = 0;
    for (const char *at = strstr(text, part); at; at = strstr(at + 1, part)) count++;
    return count;
}

static void new_folder(char folder[400]) {
    const char *parent = getenv("TMPDIR");
    snprintf(folder, 400, "%.300s/gough-study-XXXXXX", parent ? parent : "/tmp");
    if (!mkdtemp(folder)) {
        perror(folder);
        exit(EXIT_FAILURE);
    }
}

void make_comma_locale(void) {
    char folder[400], command[1000];
    new_folder(folder);
    snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 '%s/de_DE.UTF-8'", folder);
    if (system(command) != 0) {
        fprintf(stderr, "localedef failed; the package `locales` is needed\n");
        exit(EXIT_FAILURE);
    }
    setenv("LOCPATH", folder, 1);
}

void forget_comma_locale(void) {
    char command[1000];
    snprintf(command, sizeof command, "rm -r '%s'", getenv("LOCPATH"));
    if (system(command) != 0) exit(EXIT_FAILURE);
    unsetenv("LOCPATH");
}

void use_comma_locale(void) {
    ck_assert_ptr_nonnull(setlocale(LC_ALL, "de_DE.UTF-8"));
    ck_assert_str_eq(localeconv()->decimal_point, ",");
}

void use_plain_locale(void) { setlocale(LC_ALL, "C"); }

char *write_file(const char *name, const char *text, size_t length) {
    char folder[400], *path = malloc(500);
    ck_assert_ptr_nonnull(path);
    new_folder(folder);
    snprintf(path, 500, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(text, 1, length, file), length);
    ck_assert_int_eq(fclose(file), 0);
    return path;
}

void forget_file(char *path) {
    ck_assert_int_eq(unlink(path), 0);
    *strrchr(path, '/') = '\0';
    ck_assert_int_eq(rmdir(path), 0);
    free(path);
}
