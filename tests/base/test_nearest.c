/* Misspelt words and the names they mean; characters of UTF-8, read and counted. */
#include <stdbool.h>
#include <string.h>

#include "gough/text.h"
#include "support/suite.h"

static const char *const names[] = {"forces — leg forces", "lengths", "f1", "f2",
                                    "stiffness",           "damping"};
enum { NAMES = sizeof names / sizeof names[0] };

static int nearest(const char *word) {
    return gough_word_nearest(word, strlen(word), names, NAMES);
}

START_TEST(the_nearest_name_is_found_and_no_far_one) {
    ck_assert_int_eq(nearest("force"), 0);
    ck_assert_int_eq(nearest("FORCES"), 0);
    ck_assert_int_eq(nearest("lenghts"), 1); /* two letters swapped */
    ck_assert_int_eq(nearest("f11"), 2);
    ck_assert_int_eq(nearest("f1"), 2);
    ck_assert_int_eq(nearest("stifness"), 4); /* left out */
    ck_assert_int_eq(nearest("dampingg"), 5); /* inserted */
    ck_assert_int_eq(nearest("dempimg"), 5);  /* replaced, twice */
    ck_assert_int_eq(nearest("stif"), 4);     /* begun */
    ck_assert_int_eq(nearest("Dam"), 5);
    ck_assert_int_eq(nearest("st"), -1);
    ck_assert_int_eq(nearest("stiffnesses-of-all"), -1);
    ck_assert_int_eq(nearest("nothing"), -1);
    ck_assert_int_eq(nearest("x"), -1);
    ck_assert_int_eq(nearest(""), -1);
    ck_assert_int_eq(nearest("a text that is far longer than any name in any table of all of them"),
                     -1);
    ck_assert_int_eq(gough_word_nearest("dampingXXXX", 7, names, NAMES), 5);
}
END_TEST

/* every code point, written by hand, against what is read; and what is not UTF-8 */
START_TEST(characters_are_read) {
    static const char *const broken[] = {"\x80",
                                         "\xc0\x80",
                                         "\xc1\xbf",
                                         "\xe0\x9f\xbf",
                                         "\xed\xa0\x80",
                                         "\xf0\x8f\xbf\xbf",
                                         "\xf5\x80\x80\x80",
                                         "\xf4\x90\x80\x80",
                                         "\xc3",
                                         "\xc3z",
                                         "\xff"};

    for (unsigned code = 0; code <= 0x10ffff; code++) {
        char text[4];
        unsigned read = ~0u;
        size_t size = 1;
        if (code < 0x80) {
            text[0] = (char)code;
        } else if (code < 0x800) {
            size = 2;
            text[0] = (char)(0xc0 | code / 64);
        } else if (code < 0x10000) {
            size = 3;
            text[0] = (char)(0xe0 | code / 4096);
        } else {
            size = 4;
            text[0] = (char)(0xf0 | code / 262144);
        }
        unsigned rest = code;
        for (size_t i = size - 1; i > 0; i--, rest /= 64) text[i] = (char)(0x80 | rest % 64);
        const bool surrogate = code >= 0xd800 && code <= 0xdfff;
        const size_t bytes = gough_character_read(text, size, &read);
        /* a million calls of ck_assert() would take longer than all the rest */
        if (bytes != (surrogate ? 0 : size) || (!surrogate && read != code) ||
            (size > 1 && gough_character_read(text, size - 1, &read) != 0))
            ck_abort_msg("U+%04X: %zu bytes read, %u", code, bytes, read);
    }
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++)
        ck_assert_uint_eq(gough_character_read(broken[i], strlen(broken[i]), NULL), 0);
    ck_assert_uint_eq(gough_character_read("", 0, NULL), 0);
}
END_TEST

/* the table of distances has room for 60 letters */
START_TEST(words_and_names_that_are_too_long_have_no_nearest) {
    static const char letters[] =
        "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";
    const char *const both[] = {letters, letters + 8};
    ck_assert_uint_eq(strlen(letters), 68);
    ck_assert_int_eq(gough_word_nearest(letters, 60, both, 2), 1);
    ck_assert_int_eq(gough_word_nearest(letters, 60, both, 1), -1);
    ck_assert_int_eq(gough_word_nearest(letters, 61, both, 2), -1);
}
END_TEST

START_TEST(characters_are_counted) {
    ck_assert_uint_eq(gough_character_count(""), 0);
    ck_assert_uint_eq(gough_character_count("3×3 — µm"), 8);
}
END_TEST

int main(void) {
    return SUITE_RUN("base/nearest", 60, the_nearest_name_is_found_and_no_far_one,
                     words_and_names_that_are_too_long_have_no_nearest, characters_are_read,
                     characters_are_counted);
}
