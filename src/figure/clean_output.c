/* Last touches to what gnuplot drew: the date of a PDF, the fonts and the size of an SVG. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure/sheet.h"

/* The date is optional in a PDF, and blanks in its place keep every offset. */
void sheet_blank_date(char *bytes, size_t length) {
    static const char key[] = "/CreationDate (";
    enum { LONGEST = 60 };
    const size_t key_length = sizeof key - 1;
    for (size_t i = 0; i + LONGEST < length; i++) {
        if (bytes[i] != '/' || memcmp(bytes + i, key, key_length) != 0) continue;
        const char *end = memchr(bytes + i, ')', LONGEST);
        if (end != NULL) memset(bytes + i, ' ', (size_t)(end + 1 - (bytes + i)));
        return;
    }
}

/* gnuplot knows one family a text, and writes a weight as part of its name; and it leaves the end of a CDATA section in a text
 * as it is, with which XML is not well-formed. (It writes no such sections.) */
static const struct {
    const char *drawn, *named;
} fonts[] = {
    {"font-family=\"DejaVu Sans:Bold\"",
     "font-family=\"DejaVu Sans, Verdana, sans-serif\" font-weight=\"bold\""},
    {"]]>", "]]&gt;"},
    {"font-family=\"DejaVu Sans\"", "font-family=\"DejaVu Sans, Verdana, sans-serif\""},
};
enum { FONTS = sizeof fonts / sizeof fonts[0] };

static bool may_begin(char c) { return c == 'f' || c == ']'; }

/* Which of them begins at a place of the text; FONTS if none. */
static int font_at(const char *at, size_t left) {
    int f = 0;
    while (f < FONTS && (left < strlen(fonts[f].drawn) ||
                         memcmp(at, fonts[f].drawn, strlen(fonts[f].drawn)) != 0))
        f++;
    return f;
}

char *sheet_name_fonts(const char *bytes, size_t *length) {
    size_t size = *length, used = 0;
    for (size_t i = 0; i < *length; i++) {
        const int f = may_begin(bytes[i]) ? font_at(bytes + i, *length - i) : FONTS;
        if (f < FONTS) size += strlen(fonts[f].named);
    }
    char *named = malloc(size > 0 ? size : 1);
    if (named == NULL) return NULL;
    for (size_t i = 0; i < *length;) {
        const int f = may_begin(bytes[i]) ? font_at(bytes + i, *length - i) : FONTS;
        if (f == FONTS) {
            named[used++] = bytes[i++];
            continue;
        }
        memcpy(named + used, fonts[f].named, strlen(fonts[f].named));
        used += strlen(fonts[f].named);
        i += strlen(fonts[f].drawn);
    }
    *length = used;
    return named;
}

char *sheet_set_size(const char *bytes, size_t *length, const sheet_facts *size) {
    /* without a size on paper the picture keeps that in pixels */
    const bool paper = size->inch > 0.0;
    char drawn[64], printed[96];
    const double mm = 0.254 * size->inch;
    snprintf(drawn, sizeof drawn, " width=\"%d\" height=\"%d\"", size->width, size->height);
    snprintf(printed, sizeof printed, " width=\"%.2fmm\" height=\"%.2fmm\"", mm * size->width,
             mm * size->height);
    char *sized = malloc(*length + sizeof printed);
    if (sized == NULL) return NULL;
    /* the first tag of the picture has it */
    const size_t from = strlen(drawn);
    size_t at = 0;
    while (paper && at + from < *length && memcmp(bytes + at, drawn, from) != 0) at++;
    if (!paper) at = *length;
    const size_t to = at + from < *length ? strlen(printed) : 0, left = to > 0 ? at + from : at;
    memcpy(sized, bytes, at);
    memcpy(sized + at, printed, to);
    memcpy(sized + at + to, bytes + left, *length - left);
    *length = at + to + (*length - left);
    return sized;
}
