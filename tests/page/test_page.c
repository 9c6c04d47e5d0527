/* The page takes data in at one place, and no text of the data can end the element that holds it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/report.h"
#include "support/suite.h"

#define ELEMENT "<script type=\"application/json\" id=\"gough-data\">"

static const char page_text[] = "<html>" ELEMENT "null</script></html>";
static const gough_page_template page = {page_text, sizeof page_text - 1};

/* What is written for data; freed by the caller. */
static char *written(const char *data) {
    char *text = calloc(1, 4096);
    gough_error error = {0};
    FILE *file;

    ck_assert_msg(gough_page_write(&page, data, strlen(data), "page-test.html", &error) == GOUGH_OK,
                  "%s", error.message);
    file = fopen("page-test.html", "rb");
    ck_assert(file != NULL && text != NULL);
    ck_assert(fread(text, 1, 4095, file) > 0);
    fclose(file);
    remove("page-test.html");
    return text;
}

START_TEST(data_stands_in_its_element) {
    char *text = written("{\"a\":[1,2.5e-3,null]}");

    ck_assert_str_eq(text, "<html>" ELEMENT "{\"a\":[1,2.5e-3,null]}</script></html>");
    free(text);
}
END_TEST

START_TEST(no_text_ends_the_element) {
    char *text = written("\"</script><!--<script>&amp;\xE2\x80\xA8\xE2\x80\xA9\xE2\x80\xA6 é\"");

    ck_assert_str_eq(text, "<html>" ELEMENT
                           "\"\\u003c/script\\u003e\\u003c!--\\u003cscript\\u003e\\u0026amp;"
                           "\\u2028\\u2029\xE2\x80\xA6 é\"</script></html>");
    free(text);
}
END_TEST

/* cut characters at the end are copied as they are, and read no further */
START_TEST(a_cut_character_is_no_harm) {
    char *text = written("\"\xE2\x80");

    ck_assert_str_eq(text, "<html>" ELEMENT "\"\xE2\x80</script></html>");
    free(text);
}
END_TEST

START_TEST(a_template_has_one_place) {
    static const char none[] = "<html></html>", twice[] = ELEMENT "null" ELEMENT "null",
                      filled[] = ELEMENT "{}</script>", cut[] = ELEMENT "nul";
    const gough_page_template bad[] = {{none, sizeof none - 1},
                                       {twice, sizeof twice - 1},
                                       {filled, sizeof filled - 1},
                                       {cut, sizeof cut - 1},
                                       {"", 0}};

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        gough_error error = {0};
        ck_assert_int_eq(gough_page_write(&bad[i], "1", 1, "page-none.html", &error),
                         GOUGH_ERROR_INPUT);
        ck_assert(strstr(error.message, "place") != NULL);
        ck_assert(fopen("page-none.html", "rb") == NULL);
    }
}
END_TEST

START_TEST(a_folder_that_is_not_there_is_named) {
    gough_error error = {0};

    ck_assert_int_eq(gough_page_write(&page, "1", 1, "no-such-folder/page.html", &error),
                     GOUGH_ERROR_FILE);
    ck_assert(strstr(error.message, "no-such-folder") != NULL);
}
END_TEST

int main(void) {
    return SUITE_RUN("page", 60, data_stands_in_its_element, no_text_ends_the_element,
                     a_cut_character_is_no_harm, a_template_has_one_place,
                     a_folder_that_is_not_there_is_named);
}
