/* Opening an input: regular files and what the process was given; nothing whose reading may block. */
#define _XOPEN_SOURCE 700
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "study/helpers.h"
#include "support/suite.h"

START_TEST(a_file_is_opened_for_reading) {
    char *path = write_file("input.txt", "six legs", 8), read_back[16] = "";
    gough_error error = {.message = ""};
    const int file = gough_open_input(path, &error);
    ck_assert_int_gt(file, 2);
    ck_assert_str_eq(error.message, "");
    ck_assert_int_eq((int)read(file, read_back, sizeof read_back), 8);
    ck_assert_int_eq(memcmp(read_back, "six legs", 8), 0);
    ck_assert_int_eq(fcntl(file, F_GETFL) & O_ACCMODE, O_RDONLY);

    char name[64];
    snprintf(name, sizeof name, "/dev/fd/%d", file);
    const int again = gough_open_input(name, NULL);
    ck_assert_int_gt(again, 2);
    close(again);
    close(file);
    forget_file(path);
}
END_TEST

START_TEST(a_dash_is_standard_input) {
    ck_assert_int_eq(gough_open_input("-", NULL), STDIN_FILENO);
}
END_TEST

/* the words for a file with these bytes, which are part of it, or "" */
static void expect_kind(const char *bytes, size_t length, unsigned wanted, const char *part) {
    char *path = write_file("input.txt", bytes, length), first = 0;
    const int file = gough_open_input(path, NULL);
    const char *words = gough_input_kind(file, wanted);
    if (*part)
        ck_assert_msg(words && strstr(words, part), "%s", words ? words : "no words");
    else
        ck_assert_msg(!words, "%s", words);
    if (length > 0) ck_assert_int_eq((int)read(file, &first, 1), 1);
    ck_assert(length == 0 || first == bytes[0]); /* its place has not moved */
    close(file);
    forget_file(path);
}

START_TEST(a_file_is_known_by_its_first_bytes) {
    expect_kind("\x89HDF\r\n\x1a\n....", 12, 0, "HDF5");
    expect_kind("\x89HDF\r\n\x1a\n....", 12, GOUGH_INPUT_HDF5, "");
    expect_kind("\x89HDF", 4, 0, "");
    expect_kind("t,x,y\n", 6, GOUGH_INPUT_STUDY, "table in CSV");
    expect_kind("t,x,y\n", 6, GOUGH_INPUT_STUDY | GOUGH_INPUT_CSV, "");
    expect_kind("\n\2peewsg", 8, GOUGH_INPUT_CSV, "shard");
    expect_kind("\n\2peewsg", 8, GOUGH_INPUT_SHARD, "");
    expect_kind("# a remark\n\nplatform: {}\n", 25, GOUGH_INPUT_CSV, "study");
    expect_kind("# a remark\n\nplatform: {}\n", 25, GOUGH_INPUT_STUDY, "");
    expect_kind("# platform: {}", 14, 0, "");
    expect_kind("<!DOCTYPE html>", 15, GOUGH_INPUT_STUDY, "web browser");
    expect_kind("", 0, 0, "");
    expect_kind("\n", 1, 0, "");
    ck_assert_ptr_null(gough_input_kind(-1, 0));
}
END_TEST

static void refuse(const char *path, const char *part) {
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_open_input(path, &error), -1);
    ck_assert_int_eq(error.status, GOUGH_ERROR_FILE);
    ck_assert_msg(strncmp(error.message, path, strlen(path)) == 0, "%s", error.message);
    ck_assert_msg(strstr(error.message, part) != NULL, "'%s' is not in: %s", part, error.message);
    ck_assert_int_eq(gough_open_input(path, NULL), -1);
}

START_TEST(what_may_block_or_is_missing_is_refused) {
    char *path = write_file("input.txt", "", 0), pipe[4096];
    snprintf(pipe, sizeof pipe, "%s.pipe", path);
    ck_assert_int_eq(mkfifo(pipe, 0600), 0);
    refuse(pipe, "a named pipe");
    unlink(pipe);
    refuse(pipe, "cannot open");
    refuse("/dev", "a folder");
    refuse("/dev/zero", "a device");
    refuse("/dev/fd/987", "cannot open");
    forget_file(path);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/open", 60, a_file_is_opened_for_reading, a_dash_is_standard_input,
                     a_file_is_known_by_its_first_bytes, what_may_block_or_is_missing_is_refused);
}
