/* The page: the template that was built from web/, with the data of studies put in. What is data stays data: no character that
 * could end the element which holds it is left in. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "gough/report.h"

/* the place of the data in the template */
static const char element[] = "<script type=\"application/json\" id=\"gough-data\">";
static const char nothing[] = "null";

/* Characters of JSON texts that HTML or JavaScript would take for something else; in JSON they stand in strings only, where an
 * escape means the same. U+2028 and U+2029 are three bytes each. */
static const struct {
    const char *bytes, *escape;
} escapes[] = {{"<", "\\u003c"},
               {">", "\\u003e"},
               {"&", "\\u0026"},
               {"\xE2\x80\xA8", "\\u2028"},
               {"\xE2\x80\xA9", "\\u2029"}};
enum { ESCAPES = sizeof escapes / sizeof escapes[0], LONGEST_ESCAPE = 6 };

static const char *find(const char *text, size_t length, const char *word, size_t word_length) {
    for (const char *at = text; length >= word_length;) {
        const char *next = memchr(at, word[0], length - word_length + 1);
        if (!next) return NULL;
        if (memcmp(next, word, word_length) == 0) return next;
        length -= (size_t)(next - at) + 1;
        at = next + 1;
    }
    return NULL;
}

/* Copies one character or its escape; returns how many bytes were taken. */
static size_t put_escaped(char **out, const char *text, size_t length) {
    const unsigned char first = (unsigned char)*text;
    const bool suspect = first == '<' || first == '>' || first == '&' || first == 0xE2;
    for (size_t i = 0; suspect && i < ESCAPES; i++) {
        const size_t size = strlen(escapes[i].bytes);
        if (length < size || memcmp(text, escapes[i].bytes, size) != 0) continue;
        memcpy(*out, escapes[i].escape, LONGEST_ESCAPE);
        *out += LONGEST_ESCAPE;
        return size;
    }
    *(*out)++ = *text;
    return 1;
}

gough_status gough_page_write(const gough_page_template *page, const char *data, size_t length,
                              const char *path, gough_error *error) {
    const size_t head = sizeof element - 1, null = sizeof nothing - 1;
    const char *end = page->text + page->length;
    const char *place = find(page->text, page->length, element, head);
    const bool whole = place && (size_t)(end - place) >= head + null;
    const char *rest = whole ? place + head + null : end;
    if (!whole || memcmp(place + head, nothing, null) != 0 ||
        find(rest, (size_t)(end - rest), element, head))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the template of the page must have exactly one place for the data");

    char *text = malloc(page->length + length * LONGEST_ESCAPE);
    if (!text) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory for the page");
    const size_t before = (size_t)(place - page->text) + head;
    char *out = text + before;
    memcpy(text, page->text, before);
    for (size_t i = 0; i < length;) i += put_escaped(&out, data + i, length - i);
    memcpy(out, rest, (size_t)(end - rest));
    out += end - rest;
    const gough_status status = gough_write_file(path, text, (size_t)(out - text), error);
    free(text);
    return status;
}
