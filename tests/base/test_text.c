/* Text of users comes out with everything escaped that could drive a terminal, and all else as it was. */
#include "gough/text.h"

#include <stdbool.h>
#include <string.h>

#include "support/suite.h"

static void expect(const char *text, size_t length, const char *shown) {
    char room[400];
    const size_t bytes = gough_text_show(text, length, room, sizeof room);
    ck_assert_str_eq(room, shown);
    ck_assert_uint_eq(bytes, strlen(shown));
}
#define EXPECT(text, shown) expect(text, sizeof(text) - 1, shown)

START_TEST(printable_text_stays) {
    EXPECT("", "");
    EXPECT("own machine.yaml \\ ~ %s", "own machine.yaml \\ ~ %s");
    EXPECT("größe · 平台 · 🙂 · ﷽", "größe · 平台 · 🙂 · ﷽");
}
END_TEST

START_TEST(controls_become_escapes) {
    EXPECT("a\x1b[31mb", "a\\x1b[31mb");
    EXPECT("\x00\x07\t\n\r\x7f", "\\x00\\x07\\x09\\x0a\\x0d\\x7f");
    EXPECT("\xc2\x80\xc2\x9b\xc2\x9f\xc2\xa1", "\\u0080\\u009b\\u009f¡");
}
END_TEST

START_TEST(marks_of_direction_and_invisible_characters_become_escapes) {
    EXPECT("\xe2\x80\xae"
           "cod.exe",
           "\\u202ecod.exe");
    EXPECT("\xe2\x81\xa6\xe2\x81\xa9\xe2\x80\x8f\xd8\x9c", "\\u2066\\u2069\\u200f\\u061c");
    EXPECT("\xef\xbb\xbf\xe2\x80\x8b\xe2\x80\xa8\xc2\xad", "\\ufeff\\u200b\\u2028\\u00ad");
    EXPECT("\xf3\xa0\x81\x81", "\\U000e0041");
}
END_TEST

START_TEST(bytes_that_are_not_utf8_become_escapes) {
    EXPECT("\x9b"
           "31m\xff\xc3",
           "\\x9b31m\\xff\\xc3");
    EXPECT("\xc0\x9b\xe0\x80\x9b\xed\xa0\x80", "\\xc0\\x9b\\xe0\\x80\\x9b\\xed\\xa0\\x80");
    EXPECT("\xf4\x90\x80\x80\xf0\x9f\x99", "\\xf4\\x90\\x80\\x80\\xf0\\x9f\\x99");
}
END_TEST

/* every code point and every byte: what is shown has no control and no format character, and shown again it stays */
START_TEST(what_is_shown_is_printable_and_stays) {
    for (unsigned code = 0; code < 0x110000; code++) {
        char text[5] = "", shown[GOUGH_SHOWN_CHARACTER], again[GOUGH_SHOWN_CHARACTER + 1];
        size_t size = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        for (size_t i = size; i-- > 1;)
            text[i] = (char)(0x80 | (code >> 6 * (size - 1 - i) & 0x3f));
        text[0] = (char)(size == 1 ? code : (0xf00 >> size & 0xf0) | code >> 6 * (size - 1));
        const size_t taken = gough_character_show(text, size, shown);
        gough_text_show(shown, strlen(shown), again, sizeof again);
        /* a million calls of ck_assert() would take longer than all the rest */
        if (strlen(shown) > GOUGH_SHOWN_CHARACTER - 1 || strcmp(again, shown) != 0 ||
            (taken != size && (code < 0xd800 || code > 0xdfff || taken != 1)) ||
            (size == 1 && (shown[0] < ' ' || shown[0] > '~')))
            ck_abort_msg("U+%04X: %zu bytes shown as '%s', again as '%s'", code, taken, shown,
                         again);
    }
}
END_TEST

START_TEST(a_text_that_does_not_fit_ends_before_a_whole_character) {
    char room[8] = "";
    ck_assert_uint_eq(gough_text_show("ab\x1b!", 4, room, sizeof room), 7);
    ck_assert_str_eq(room, "ab\\x1b!");
    ck_assert_uint_eq(gough_text_show("abcd\x1b!", 6, room, sizeof room), 9);
    ck_assert_str_eq(room, "abcd");
    ck_assert_uint_eq(gough_text_show("abcdef平!", 10, room, sizeof room), 10);
    ck_assert_str_eq(room, "abcdef");
    ck_assert_uint_eq(gough_text_show("abc", 3, NULL, 0), 3);
}
END_TEST

int main(void) {
    return SUITE_RUN("base/text", 60, printable_text_stays, controls_become_escapes,
                     marks_of_direction_and_invisible_characters_become_escapes,
                     bytes_that_are_not_utf8_become_escapes, what_is_shown_is_printable_and_stays,
                     a_text_that_does_not_fit_ends_before_a_whole_character);
}
