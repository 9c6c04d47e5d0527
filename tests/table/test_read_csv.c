/* CSV in: what is accepted, and the place and sentence of everything that is not. */
#define _XOPEN_SOURCE 700
#include <sys/stat.h>

#include "support/random.h"
#include "support/suite.h"
#include "table/by_hand.h"

static gough_status read_text(const char *text, size_t length, gough_table **table,
                              gough_error *error) {
    write_bytes("read.csv", text, length);
    *error = (gough_error){.message = ""};
    const gough_status status = gough_table_read("read.csv", table, error);
    unlink("read.csv");
    return status;
}

static void expect_refused(const char *text, size_t length, const char *message) {
    gough_table *table = NULL;
    gough_error error;
    ck_assert_msg(read_text(text, length, &table, &error) == GOUGH_ERROR_INPUT, "accepted: %s",
                  text);
    ck_assert(table == NULL);
    ck_assert_msg(strstr(error.message, message) == error.message, "found %s\nnot %s",
                  error.message, message);
}

/* Texts with NUL in them keep their length. */
#define REFUSES(text, message) expect_refused(text, sizeof(text) - 1, message)

static void expect_read(const char *text, size_t rows, size_t columns, double last) {
    gough_table *table = NULL;
    gough_error error;
    ck_assert_msg(read_text(text, strlen(text), &table, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_uint_eq(table->rows, rows);
    ck_assert_uint_eq(table->columns, columns);
    if (rows > 0) ck_assert(memcmp(&table->value[columns - 1][rows - 1], &last, sizeof last) == 0);
    gough_table_free(table);
}

START_TEST(accepts_what_other_programs_write) {
    expect_read("t,x\n0,1\n1,2\n", 2, 2, 2.0);
    expect_read("t,x\n0,1\n1,2", 2, 2, 2.0);
    expect_read("t,x\r\n0,1\r\n1,2\r\n", 2, 2, 2.0);
    expect_read("\xef\xbb\xbft,x\n0,1\n", 1, 2, 1.0);
    expect_read("\"t\",\"x of it\"\n0,1\n", 1, 2, 1.0);
    expect_read(" t , x \n 0 ,\t-1.5e+1 \n", 1, 2, -15.0);
    expect_read("t,x\n0,.5\n", 1, 2, 0.5);
    expect_read("t,x\n0,+5.\n\n\n", 1, 2, 5.0);
    expect_read("Größe\n7\n", 1, 1, 7.0);
    expect_read("t,x\n", 0, 2, 0.0);
    expect_read("t,x\n0,inf\n", 1, 2, INFINITY);
    expect_read("t,x\n0,+inf\n", 1, 2, INFINITY);
    expect_read("t\n4.9406564584124654e-324\n", 1, 1, 4.9406564584124654e-324);
}
END_TEST

START_TEST(the_first_line_is_named_as_such_behind_a_byte_order_mark) {
    gough_table *table = NULL;
    gough_error error;
    const char text[] = "\xef\xbb\xbft,x\n0,1\n";
    ck_assert_int_eq(read_text(text, sizeof text - 1, &table, &error), GOUGH_OK);
    ck_assert(gough_table_column(table, "t") != NULL);
    gough_table_free(table);
}
END_TEST

START_TEST(ragged_rows_have_their_place) {
    REFUSES("t,x\n0,1\n1\n", "read.csv:3:1: this row has 1 number, but there are 2 columns");
    REFUSES("t,x\n0,1,2\n", "read.csv:2:1: this row has 3 numbers, but there are 2 columns");
    REFUSES("t,x\n0,1\n\n1,2\n", "read.csv:3:1: an empty row");
    REFUSES("t,x\r\n0,1\r\n\r\n1,2\r\n", "read.csv:3:1: an empty row");
}
END_TEST

START_TEST(text_in_a_number_has_its_place) {
    REFUSES("t,x\n0,1\n1,two\n", "read.csv:3:3: 'two' is not a number");
    REFUSES("t,x\n0,1\n1, 2x\n", "read.csv:3:4: '2x' is not a number");
    REFUSES("t,x\n0,0x10\n", "read.csv:2:3: '0x10' is not a number");
    REFUSES("t,x\n0,1e\n", "read.csv:2:3: '1e' is not a number");
    REFUSES("t,x\n0,-\n", "read.csv:2:3: '-' is not a number");
    REFUSES("t,x\n0,.\n", "read.csv:2:3: '.' is not a number");
    REFUSES("t,x\n0,1 2\n", "read.csv:2:3: '1 2' is not a number");
    REFUSES("t,x\n0,\"1\"\n", "read.csv:2:3: '\"1\"' is not a number");
    REFUSES("t,x\n0,nan(7)\n", "read.csv:2:3: 'nan(7)' is not a number");
    REFUSES("t,x\n0,1\0\n", "read.csv:2:3: '1\\x00' is not a number");
    REFUSES("t,x\n0,\x1b[31m\n", "read.csv:2:3: '\\x1b[31m' is not a number");
    REFUSES("t,x\n0,1\r2\n", "read.csv:2:3: '1\\x0d2' is not a number");
    REFUSES("t,x\n0,abcdefghijklmnopqrstuvwxyzabcdefghij\n",
            "read.csv:2:3: 'abcdefghijklmnopqrstuvwxyzabcde...' is not a number");
    REFUSES("t,x\n0,\n", "read.csv:2:3: a number is missing");
    REFUSES("t,end_cause\n0,\n", "read.csv:2:3: a number is missing");
    REFUSES("t,x\n,1\n", "read.csv:2:1: a number is missing");
    REFUSES("t,x\n0,1e999\n", "read.csv:2:3: this number is too large for double precision");
}
END_TEST

START_TEST(a_wrong_header_has_its_place) {
    REFUSES("", "read.csv:1:1: the file is empty");
    REFUSES("\xef\xbb\xbf", "read.csv:1:1: the file is empty");
    REFUSES("\n", "read.csv:1:1: a column has no name");
    REFUSES("t,,x\n0,1,2\n", "read.csv:1:3: a column has no name");
    REFUSES("t,x,t\n0,1,2\n", "read.csv:1:5: an earlier column has the same name");
    REFUSES("0,1\n2,3\n", "read.csv:1:1: the first row must name the columns");
    REFUSES("t;x\n0;1\n", "read.csv:1:1: columns must be separated by commas");
    REFUSES("t,\xff\n0,1\n", "read.csv:1:3: this column's name is not printable");
    REFUSES("t,a\x01z\n0,1\n", "read.csv:1:3: this column's name is not printable");
    REFUSES("t,a\0z\n0,1\n", "read.csv:1:3: this column's name is not printable");
}
END_TEST

START_TEST(too_many_columns_are_refused) {
    char *text = malloc(40000);
    size_t used = 0;
    for (int i = 0; i < 4097; i++) used += (size_t)sprintf(text + used, "c%d,", i);
    text[used - 1] = '\n';
    expect_refused(text, used, "read.csv:1:1: more than 4096 columns");
    free(text);
}
END_TEST

/* 4096 columns over a million empty lines ask for no table of 32 GB. */
START_TEST(memory_is_bounded_by_the_length_of_the_text) {
    const size_t size = 1100000;
    char *text = malloc(size);
    memset(text, '\n', size);
    size_t used = 0;
    for (int i = 0; i < 4096; i++) used += (size_t)sprintf(text + used, "c%d,", i);
    text[used - 1] = text[used] = '\n';
    gough_table *table = NULL;
    gough_error error;
    ck_assert_int_eq(read_text(text, size, &table, &error), GOUGH_OK);
    ck_assert_uint_eq(table->rows, 0);
    gough_table_free(table);
    free(text);
}
END_TEST

START_TEST(what_cannot_be_opened_is_an_error_of_files) {
    gough_table *table = NULL;
    gough_error error;
    ck_assert_int_eq(gough_table_read("no-such-folder/a.csv", &table, &error), GOUGH_ERROR_FILE);
    ck_assert(strstr(error.message, "no-such-folder/a.csv") != NULL);
    ck_assert_int_eq(gough_table_read(".", &table, &error), GOUGH_ERROR_FILE);
    ck_assert(strstr(error.message, "folder") != NULL);
}
END_TEST

/* as a shell's <(command) has it; a pipe by its own name is refused, even where nobody would ever write to it */
START_TEST(a_stream_is_read_too) {
    static const char text[] = "t,x\n0,1\n";
    int ends[2];
    char path[40];
    ck_assert_int_eq(pipe(ends), 0);
    ck_assert_int_eq(write(ends[1], text, sizeof text - 1), sizeof text - 1);
    close(ends[1]);
    snprintf(path, sizeof path, "/dev/fd/%d", ends[0]);
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    ck_assert_msg(gough_table_read(path, &table, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_uint_eq(table->rows, 1);
    gough_table_free(table);
    close(ends[0]);
    ck_assert_int_eq(mkfifo("read.fifo", 0600), 0);
    ck_assert_int_eq(gough_table_read("read.fifo", &table, &error), GOUGH_ERROR_FILE);
    ck_assert_str_eq(error.message, "read.fifo: is a named pipe; a regular file is needed");
    unlink("read.fifo");
}
END_TEST

/* Bytes of the kinds that a table is made of, in any order. */
START_TEST(any_bytes_end_in_a_table_or_a_message) {
    static const char alphabet[] = "t,x\n\r 0123456789.eE+-naif\"\0;\xef\xbb\xbf\x80";
    dice d = {42};
    for (int round = 0; round < 3000; round++) {
        char text[64];
        const size_t length = dice_bits(&d) % sizeof text;
        for (size_t i = 0; i < length; i++)
            text[i] = alphabet[dice_bits(&d) % (sizeof alphabet - 1)];
        gough_table *table = NULL;
        gough_error error;
        const gough_status status = read_text(text, length, &table, &error);
        ck_assert(status == GOUGH_OK ? table != NULL : status == GOUGH_ERROR_INPUT);
        if (status != GOUGH_OK) ck_assert(strstr(error.message, "read.csv:") == error.message);
        gough_table_free(table);
    }
}
END_TEST

int main(void) {
    char folder[] = "gough-test-XXXXXX", here[1024];
    if (getcwd(here, sizeof here) == NULL || mkdtemp(folder) == NULL || chdir(folder) != 0)
        return EXIT_FAILURE;
    const int status = SUITE_RUN(
        "table/read_csv", 60, accepts_what_other_programs_write,
        the_first_line_is_named_as_such_behind_a_byte_order_mark, ragged_rows_have_their_place,
        text_in_a_number_has_its_place, a_wrong_header_has_its_place, too_many_columns_are_refused,
        memory_is_bounded_by_the_length_of_the_text, what_cannot_be_opened_is_an_error_of_files,
        a_stream_is_read_too, any_bytes_end_in_a_table_or_a_message);
    if (chdir(here) == 0) rmdir(folder);
    return status;
}
