/* Line breaking by columns of UTF-8 text. */
#include "cli/common/paragraph.h"

#include <stdarg.h>
#include <string.h>

enum { MOST_COLUMNS = 100, MOST_BYTES = 2000 };

static int columns_of(const char *text, size_t bytes) {
    int columns = 0;
    for (size_t i = 0; i < bytes; i++) columns += ((unsigned char)text[i] & 0xC0) != 0x80;
    return columns;
}

int text_columns(const char *text) { return columns_of(text, strlen(text)); }

void print_paragraph(FILE *stream, const char *label, int indent, const char *format, ...) {
    char text[MOST_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);

    const int labelled = text_columns(label);
    int column = labelled > indent ? labelled : indent;
    fprintf(stream, "%s%*s", label, column - labelled, "");
    const char *joint = "";
    for (const char *word = text; *word; joint = " ") {
        const size_t bytes = strcspn(word, " ");
        const int width = columns_of(word, bytes);
        if (*joint && column + 1 + width > MOST_COLUMNS) {
            fprintf(stream, "\n%*s", indent, "");
            column = indent;
            joint = "";
        }
        fprintf(stream, "%s%.*s", joint, (int)bytes, word);
        column += (*joint ? 1 : 0) + width;
        word += bytes + strspn(word + bytes, " ");
    }
    fputc('\n', stream);
}
