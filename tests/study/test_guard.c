/* Bytes that are no study: each ends in a message with its place, and soon. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "study/helpers.h"
#include "support/slowness.h"
#include "support/suite.h"

/* Expects an error in input whose text begins with this. */
static void expect_refused(const char *text, size_t length, const char *begin) {
    reading made = read_bytes(text, length, NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_msg(strncmp(made.messages, begin, strlen(begin)) == 0, "expected %s\nfound %s", begin,
                  made.messages);
    reading_free(&made);
}

#define EXPECT_REFUSED(text, begin) expect_refused(text, sizeof(text) - 1, begin)

START_TEST(refuses_nothing_at_all) {
    EXPECT_REFUSED("", "study.yaml:1:1: error: the study is empty");
    EXPECT_REFUSED("# only a comment\n", "study.yaml:2:1: error: the study is empty");
    EXPECT_REFUSED("---\n", "study.yaml:2:1: error: the study is empty");
    EXPECT_REFUSED("- 1\n", "study.yaml:1:1: error: a study is a mapping");
    EXPECT_REFUSED("words\n", "study.yaml:1:1: error: a study is a mapping");
    EXPECT_REFUSED("\xEF\xBB\xBF", "study.yaml:1:1: error: the study is empty");
}
END_TEST

START_TEST(refuses_broken_utf8) {
    EXPECT_REFUSED("title: \xff\n", "study.yaml:1:8: error: byte 0xFF is not UTF-8 here");
    EXPECT_REFUSED("title: %\xc3\n", "study.yaml:1:9: error: byte 0xC3 is not UTF-8 here");
    EXPECT_REFUSED("%\xff", "study.yaml:1:1: error: lines must not begin with %");
    EXPECT_REFUSED("title: x\n\xc3", "study.yaml:2:1: error: byte 0xC3 is not UTF-8 here");
    EXPECT_REFUSED("\xc0\x80", "study.yaml:1:1: error: byte 0xC0 is not UTF-8 here");
    EXPECT_REFUSED("# \xed\xa0\x80", "study.yaml:1:3: error: byte 0xED is not UTF-8 here");
    EXPECT_REFUSED("# \xf4\x90\x80\x80", "study.yaml:1:3: error: byte 0xF4 is not UTF-8 here");
    EXPECT_REFUSED("\xff\xfet\0i\0", "study.yaml:1:1: error: this looks like UTF-16");
}
END_TEST

START_TEST(refuses_text_after_nul_and_control_characters) {
    char text[1000];
    const int length = snprintf(text, sizeof text, "%s", good_study);
    memcpy(text + length, "\0title: x\n", 10);
    expect_refused(text, (size_t)length + 10, "study.yaml:8:1: error: NUL byte");
    EXPECT_REFUSED("title: a\x07 b\n", "study.yaml:1:9: error: control character U+0007");
    EXPECT_REFUSED("title: a\x7f b\n", "study.yaml:1:9: error: control character U+007F");
    EXPECT_REFUSED("title: a\xc2\x9b b\n", "study.yaml:1:9: error: control character U+009B");
    EXPECT_REFUSED("title: a\xEF\xBB\xBF b\n", "study.yaml:1:9: error: control character U+FEFF");
    EXPECT_REFUSED("title: \"a\\0b\"\n", "study.yaml:1:9: error: a NUL character");
    expect_said("title: \"a\\eb\"\n",
                "study.yaml:1:10: error: control character U+001B in `title`");
    expect_said("title: \"a\\x9Bb\"\n",
                "study.yaml:1:10: error: control character U+009B in `title`");
    EXPECT_REFUSED("units: \"s\\0i\"\n", "study.yaml:1:9: error: a NUL character");
}
END_TEST

START_TEST(refuses_anchors_aliases_tags_directives_documents) {
    EXPECT_REFUSED("title: &a x\n", "study.yaml:1:8: error: anchors (&)");
    EXPECT_REFUSED("platform: &p {height: 1}\n", "study.yaml:1:11: error: anchors (&)");
    EXPECT_REFUSED("&key title: x\n", "study.yaml:1:1: error: anchors (&)");
    EXPECT_REFUSED("title: *a\n", "study.yaml:1:8: error: aliases (*)");
    EXPECT_REFUSED("*a : x\n", "study.yaml:1:1: error: aliases (*)");
    EXPECT_REFUSED("title: !!str x\n", "study.yaml:1:8: error: tags (!)");
    EXPECT_REFUSED("title: !local x\n", "study.yaml:1:8: error: tags (!)");
    EXPECT_REFUSED("title: x\n---\ntitle: y\n", "study.yaml:2:1: error: a second document");
    EXPECT_REFUSED("title: x\n...\n---\ntitle: y\n", "study.yaml:3:1: error: a second document");
    EXPECT_REFUSED("title: x\n...\n\ntitle: y\n", "study.yaml:4:1: error: a second document");
    EXPECT_REFUSED("%YAML 1.2\n---\ntitle: x\n",
                   "study.yaml:1:1: error: lines must not begin with %");
    EXPECT_REFUSED("? [a]\n: 1\n", "study.yaml:1:3: error: a key must be a word");
    EXPECT_REFUSED("{a: 1}: 1\n", "study.yaml:1:1: error: a key must be a word");
}
END_TEST

START_TEST(refuses_alias_bomb) {
    char text[4000] = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 20; i++) {
        sprintf(text + strlen(text), "a%d: &a%d [", i, i);
        for (int j = 0; j < 9; j++) sprintf(text + strlen(text), "%s*a%d", j ? ", " : "", i - 1);
        strcat(text, "]\n");
    }
    expect_refused(text, strlen(text), "study.yaml:1:5: error: anchors (&)");
}
END_TEST

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Reads count times the piece (with its number) between two ends; an error is expected, within two seconds of work on a quiet
 * machine. Reading takes tens of milliseconds where time grows with the size; sanitizers make it a few times longer. */
static void expect_soon(const char *before, const char *piece, int count, const char *after) {
    const size_t capacity = 20U * (size_t)count + 200;
    char *text = malloc(capacity);
    ck_assert_ptr_nonnull(text);
    size_t length = (size_t)snprintf(text, capacity, "%s", before);
    for (int i = 0; i < count; i++)
        length += (size_t)snprintf(text + length, capacity - length, piece, i);
    length += (size_t)snprintf(text + length, capacity - length, "%s", after);
    const double start = seconds();
    reading made = read_bytes(text, length, NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_uint_lt(strlen(made.messages), 100000);
    reading_free(&made);
    ck_assert_double_lt(seconds() - start, 2 * slowness());
    free(text);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-security"
START_TEST(many_keys_and_deep_nesting_end_soon) {
    expect_soon("", "k%05d: 1\n", 20000, ""); /* beyond 64 KiB */
    expect_soon("", "%x:\n", 10000, "");      /* within, each different */
    expect_soon("{", "%x,", 11000, "}");      /* in one flow mapping */
    expect_soon("{", "a,", 20000, "}");       /* all the same */
    expect_soon("control: {", "a,", 20000, "}");
    expect_soon("control: {", "damping,", 7000, "}");
    expect_soon("motion: {moves: [", "{},", 20000, "]}");
    expect_soon("motion: {moves: [", "{a},", 16000, "]}");
    expect_soon("disturbance: {force: [", "f(,", 20000, "]}");
    expect_soon("control: {damping: [", "x,", 30000, "]}");
    expect_soon("", "[", 60000, "");
    expect_soon("", "{a: ", 16000, "");
    expect_soon("", "- ", 30000, "");
    expect_soon("", "? ", 30000, "");
    expect_soon("a: \"", "\\n", 30000, "\"");
    expect_soon("a:", "\n", 60000, "  b");
    expect_soon("a: ", "'", 60000, "");
    expect_soon("a: |\n", "\t ", 30000, "");
    expect_soon("motion: {heave: \"", "(", 60000, "\"}");
    expect_soon("motion: {heave: ", "1+", 30000, "1}");
    expect_soon("motion: {heave: ", "9", 60000, "}x");
}
END_TEST
#pragma GCC diagnostic pop

START_TEST(refuses_more_than_64_kib) {
    const size_t length = 64 * 1024 + 1;
    char *text = malloc(length);
    ck_assert_ptr_nonnull(text);
    memset(text, '\n', length);
    memcpy(text, good_study, strlen(good_study));
    expect_refused(text, length,
                   "study.yaml:1:1: error: the text has 65537 bytes; the limit is 65536");
    reading made = read_bytes(text, length - 1, NULL);
    ck_assert_int_eq(made.status, GOUGH_OK);
    reading_free(&made);
    free(text);
}
END_TEST

START_TEST(accepts_byte_order_mark_and_line_ends_of_every_kind) {
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    for (size_t e = 0; e < 3; e++) {
        char text[1000] = "\xEF\xBB\xBF";
        size_t length = 3;
        for (const char *c = good_study; *c; c++)
            length += (size_t)sprintf(text + length, "%.*s", *c == '\n' ? 2 : 1,
                                      *c == '\n' ? ends[e] : c);
        reading made = read_bytes(text, length, NULL);
        ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
        ck_assert_str_eq(made.study->title, "Test");
        ck_assert_str_eq(made.study->text, text);
        reading_free(&made);
        memcpy(strstr(text, "height"), "hight:", 6);
        made = read_bytes(text, length, NULL);
        ck_assert_msg(strncmp(made.messages, "study.yaml:6:3: error: ", 23) == 0, "%s",
                      made.messages);
        reading_free(&made);
    }
}
END_TEST

START_TEST(text_in_memory_need_not_be_terminated) {
    const size_t length = strlen(good_study);
    char *text = malloc(length);
    ck_assert_ptr_nonnull(text);
    memcpy(text, good_study, length);
    for (size_t n = 0; n <= length; n++) {
        char *part = malloc(n ? n : 1);
        ck_assert_ptr_nonnull(part);
        memcpy(part, text, n);
        reading made = read_bytes(part, n, NULL);
        ck_assert_int_eq(made.status, n + 1 >= length ? GOUGH_OK : GOUGH_ERROR_INPUT);
        reading_free(&made);
        free(part);
    }
    free(text);
}
END_TEST

START_TEST(a_title_may_hold_anything_printable) {
    const char *text = "title: \"`id` $(id) 'quotes' \\\"double\\\" \\\\ and\\nlines\"\n";
    char whole[1000];
    snprintf(whole, sizeof whole, "%s%s", text, strchr(good_study, '\n') + 1);
    reading made = read_bytes(whole, strlen(whole), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    ck_assert_str_eq(made.study->title, "`id` $(id) 'quotes' \"double\" \\ and\nlines");
    reading_free(&made);
}
END_TEST

START_TEST(a_study_that_cannot_be_read_is_a_file_error) {
    static const char *const paths[] = {"no/such/study.yaml", "/", "/dev/zero"};
    for (size_t i = 0; i < 3; i++) {
        gough_study *study = NULL;
        char *messages = NULL;
        const gough_status status = gough_study_read(paths[i], NULL, 0, &study, &messages);
        ck_assert_int_eq(status, GOUGH_ERROR_FILE);
        ck_assert_ptr_null(study);
        ck_assert_msg(strncmp(messages, paths[i], strlen(paths[i])) == 0, "%s", messages);
        ck_assert_ptr_nonnull(strstr(messages, ": error: "));
        gough_study_free_messages(messages);
    }
    gough_study_free(NULL);
    gough_study_free_messages(NULL);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/guard", 120, refuses_nothing_at_all, refuses_broken_utf8,
                     refuses_text_after_nul_and_control_characters,
                     refuses_anchors_aliases_tags_directives_documents, refuses_alias_bomb,
                     many_keys_and_deep_nesting_end_soon, refuses_more_than_64_kib,
                     accepts_byte_order_mark_and_line_ends_of_every_kind,
                     text_in_memory_need_not_be_terminated, a_title_may_hold_anything_printable,
                     a_study_that_cannot_be_read_is_a_file_error);
}
