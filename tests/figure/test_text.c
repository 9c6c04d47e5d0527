/* Text on figures: what can stand between gnuplot's single quotes, and units with prefixes. */
#include <string.h>

#include "figure/sheet.h"
#include "support/suite.h"

static void expect_quoted(const char *text, const char *quoted) {
    char found[400];
    sheet_quote(found, sizeof found, text, 100);
    ck_assert_str_eq(found, quoted);
}

START_TEST(no_quote_is_left) {
    expect_quoted("it's", "it’s");
    expect_quoted("'", "’");
    expect_quoted("''\"`$(x)`\"", "’’\"`$(x)`\"");
}
END_TEST

START_TEST(line_ends_and_control_characters_are_replaced) {
    expect_quoted("a\nb\r\tc", "a b  c");
    expect_quoted("a\x1b[31m\x7f", "a?[31m?");
    expect_quoted("a\xc2\x85z", "a?z"); /* a line end of the C1 set */
}
END_TEST

START_TEST(broken_utf8_is_replaced_and_sound_utf8_kept) {
    expect_quoted("größe 😀", "größe 😀");
    expect_quoted("\xff", "?");
    expect_quoted("\xc3", "?");
    expect_quoted("\xc0\xa7", "??");           /* an apostrophe in an overlong form */
    expect_quoted("\xed\xa0\x80", "???");      /* a surrogate */
    expect_quoted("\xf4\x90\x80\x80", "????"); /* beyond Unicode */
    expect_quoted("\xe0\x80\xa7", "???");
}
END_TEST

START_TEST(long_text_is_cut_at_a_character) {
    char text[3000], quoted[400];
    memset(text, '\'', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    sheet_quote(quoted, sizeof quoted, text, 20);
    ck_assert_uint_eq(strlen(quoted), 20 * strlen("’") + strlen("…"));
    /* and where the room ends first, still at a whole character */
    for (size_t size = 20; size < 60; size++) {
        sheet_quote(quoted, size, text, 1000);
        ck_assert_uint_lt(strlen(quoted), size);
        ck_assert_uint_eq(strlen(quoted) % strlen("’"), 0);
    }
}
END_TEST

START_TEST(lines_break_at_spaces) {
    ck_assert_uint_eq(sheet_line("a few words", 11), 11);
    ck_assert_uint_eq(sheet_line("a few words", 10), 6);
    ck_assert_uint_eq(sheet_line("a few words", 5), 6); /* the space belongs to the line */
    ck_assert_uint_eq(sheet_line("a few words", 4), 2);
    ck_assert_uint_eq(sheet_line("indivisible word", 4), 12);
    ck_assert_uint_eq(sheet_line("Höhe über Null", 9),
                      strlen("Höhe über ")); /* characters, not bytes */
    ck_assert_uint_eq(sheet_line("", 4), 0);
}
END_TEST

static void expect_unit(const char *unit, int power, const char *label) {
    char found[48];
    sheet_unit_label(found, sizeof found, unit, power);
    ck_assert_str_eq(found, label);
}

START_TEST(units_take_prefixes_and_superscripts) {
    expect_unit("", 0, "");
    expect_unit("1", 0, "");
    expect_unit("m", 0, " (m)");
    expect_unit("m/s2", 0, " (m/s²)");
    expect_unit("degree", 0, " (°)");
    expect_unit("degree/s2", 0, " (°/s²)");
    expect_unit("m", -1, " (mm)");
    expect_unit("m", -2, " (µm)");
    expect_unit("N", 1, " (kN)");
    expect_unit("N m", 1, " (kN m)");
    expect_unit("W", 2, " (MW)");
    expect_unit("degree", -1, " (10⁻³ °)");
    expect_unit("1", -2, " (10⁻⁶)");
    expect_unit("", 1, " (10³)");
    expect_unit("m", -4, " (10⁻¹² m)");
}
END_TEST

int main(void) {
    return SUITE_RUN("figure/text", 10, no_quote_is_left,
                     line_ends_and_control_characters_are_replaced,
                     broken_utf8_is_replaced_and_sound_utf8_kept, long_text_is_cut_at_a_character,
                     lines_break_at_spaces, units_take_prefixes_and_superscripts);
}
