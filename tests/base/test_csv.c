/* Lines and cells of CSV: what was written cell by cell is read cell by cell, however it is ended, padded and quoted. */
#include <stdio.h>
#include <string.h>

#include "gough/text.h"
#include "support/suite.h"
#include "support/xorshift.h"

enum { MOST_CELLS = 6, MOST_LINES = 5, CELL = 24 };

/* A cell of letters, perhaps in quotes with commas and quotes within; `whole` is what a reader must return. */
static void make_cell(random_source *random, char whole[CELL]) {
    static const char plain[] = "ab 1.-;", inside[] = "a, b,,";
    const int length = (int)(random_between(random, 0, 7.99));
    const bool quoted = random_between(random, 0, 1) < 0.3;
    int at = 0;
    if (quoted) whole[at++] = '"';
    for (int i = 0; i < length; i++) {
        const char *letters = quoted ? inside : plain;
        const size_t count = strlen(letters);
        const char c = letters[(size_t)random_between(random, 0, (double)count - 0.01)];
        const bool edge = !quoted && (i == 0 || i == length - 1);
        whole[at++] = edge && c == ' ' ? 'x' : c;
        if (quoted && random_between(random, 0, 1) < 0.2) whole[at++] = '"', whole[at++] = '"';
    }
    if (quoted) whole[at++] = '"';
    whole[at] = '\0';
}

static void add_blanks(random_source *random, char *text) {
    static const char *const blanks[] = {"", "", " ", "\t", " \t "};
    strcat(text, blanks[(size_t)random_between(random, 0, 4.99)]);
}

START_TEST(what_was_written_is_read) {
    static char cell[MOST_LINES][MOST_CELLS][CELL];
    random_source random = random_seeded(2026);
    for (int round = 0; round < 2000; round++) {
        char text[2000] = "";
        const int lines = 1 + (int)random_between(&random, 0, MOST_LINES - 0.01);
        int cells[MOST_LINES];
        for (int l = 0; l < lines; l++) {
            cells[l] = 1 + (int)random_between(&random, 0, MOST_CELLS - 0.01);
            for (int c = 0; c < cells[l]; c++) {
                make_cell(&random, cell[l][c]);
                add_blanks(&random, text);
                strcat(text, cell[l][c]);
                add_blanks(&random, text);
                if (c + 1 < cells[l]) strcat(text, ",");
            }
            strcat(text, random_between(&random, 0, 1) < 0.5 ? "\n" : "\r\n");
        }
        gough_piece rest = {text, text + strlen(text)}, line, found;
        for (int l = 0; l < lines; l++) {
            ck_assert_msg(gough_csv_line(&rest, &line), "round %d: line %d is missing", round, l);
            ck_assert_uint_eq(gough_csv_count(line), (size_t)cells[l]);
            for (int c = 0; c < cells[l]; c++) {
                ck_assert(gough_csv_cell(&line, &found));
                const size_t length = (size_t)(found.end - found.begin);
                ck_assert_msg(
                    length == strlen(cell[l][c]) && memcmp(found.begin, cell[l][c], length) == 0,
                    "round %d: '%.*s' for '%s'", round, (int)length, found.begin, cell[l][c]);
            }
            ck_assert(!gough_csv_cell(&line, &found));
        }
        ck_assert(!gough_csv_line(&rest, &line));
    }
}
END_TEST

START_TEST(ends_are_those_of_the_text) {
    static const char text[] = "a,\r\n\n\r\n";
    gough_piece rest = {text, text + strlen(text)}, line, cell;
    ck_assert(!gough_csv_ended(rest));
    ck_assert(gough_csv_line(&rest, &line));
    ck_assert_uint_eq(gough_csv_count(line), 2); /* the last is empty */
    ck_assert(gough_csv_cell(&line, &cell) && cell.end - cell.begin == 1);
    ck_assert(gough_csv_cell(&line, &cell) && cell.end == cell.begin);
    ck_assert(gough_csv_ended(rest));
    ck_assert(gough_csv_line(&rest, &line) && line.begin == line.end);
    ck_assert_uint_eq(gough_csv_count(line), 1);
    const gough_piece empty = {text, text};
    rest = empty;
    ck_assert(gough_csv_ended(rest) && !gough_csv_line(&rest, &line));
}
END_TEST

START_TEST(the_last_line_needs_no_end) {
    static const char text[] = "a\nb,c";
    gough_piece rest = {text, text + 5}, line;
    ck_assert(gough_csv_line(&rest, &line) && line.end == text + 1);
    ck_assert(gough_csv_line(&rest, &line));
    ck_assert(line.begin == text + 2 && line.end == text + 5);
    ck_assert(gough_csv_ended(rest) && !gough_csv_line(&rest, &line));
}
END_TEST

/* A quote that is never closed is a letter like any other: the cell ends at the next comma. */
START_TEST(an_open_quote_swallows_nothing) {
    static const char text[] = "\"a,b";
    gough_piece line = {text, text + 4}, cell;
    ck_assert(gough_csv_cell(&line, &cell));
    ck_assert_int_eq(cell.end - cell.begin, 2);
    ck_assert(gough_csv_cell(&line, &cell) && *cell.begin == 'b');
}
END_TEST

/* the same cells behind other separators; blanks stand for one, wherever they are */
START_TEST(cells_are_apart_by_what_is_asked_for) {
    static const struct {
        char separator;
        const char *line;
        int cells;
        const char *cell[4];
    } lines[] = {
        {';', "a; b c ;\"d;e\"", 3, {"a", "b c", "\"d;e\""}},
        {';', "1,5;2", 2, {"1,5", "2"}},
        {';', "a;", 2, {"a", ""}},
        {'\t', "a\t b\t\tc", 4, {"a", "b", "", "c"}},
        {'\t', "\t", 2, {"", ""}},
        {' ', "  a  b\t c ", 3, {"a", "b", "c"}},
        {' ', "\"a b\" c", 2, {"\"a b\"", "c"}},
        {' ', "a", 1, {"a"}},
        {' ', "  ", 1, {""}},
        {' ', "", 1, {""}},
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        gough_piece line = {lines[i].line, lines[i].line + strlen(lines[i].line)}, cell;
        for (int c = 0; c < lines[i].cells; c++) {
            const char *expected = lines[i].cell[c];
            ck_assert_msg(gough_csv_cell_by(&line, lines[i].separator, &cell), "%zu", i);
            ck_assert_msg((size_t)(cell.end - cell.begin) == strlen(expected) &&
                              memcmp(cell.begin, expected, strlen(expected)) == 0,
                          "%zu: '%.*s' instead of '%s'", i, (int)(cell.end - cell.begin),
                          cell.begin, expected);
        }
        ck_assert_msg(!gough_csv_cell_by(&line, lines[i].separator, &cell), "%zu has more", i);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("base/csv", 60, cells_are_apart_by_what_is_asked_for, what_was_written_is_read,
                     ends_are_those_of_the_text, the_last_line_needs_no_end,
                     an_open_quote_swallows_nothing);
}
