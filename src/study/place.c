/* From a byte of a scalar's text to the character of the file that stands for it. */
#include <string.h>

#include "gough/text.h"

#include "study/tree.h"

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/* Bytes that an escape sequence of a double-quoted scalar takes in the file. */
static size_t escape_length(const char *raw) {
    return raw[1] == 'x' ? 4 : raw[1] == 'u' ? 6 : raw[1] == 'U' ? 10 : 2;
}

/* Bytes in the file of the non-blank character there. */
static size_t raw_length(study_quoting quoting, const char *raw, size_t left) {
    if (quoting == STUDY_DOUBLE_QUOTED && raw[0] == '\\') return escape_length(raw);
    return gough_character_read(raw, left, NULL);
}

/* Folding and indentation change blanks only, and escapes stand for one character each: so the n-th character of the text that
 * is no blank is the n-th of the file's. An escaped blank is counted on neither side. */
static size_t walk(const study_node *node, const char *raw, size_t size, size_t offset) {
    size_t at = 0;
    for (size_t value = 0; value <= offset && value < node->length;) {
        if (is_blank(node->text[value])) {
            value++;
            continue;
        }
        /* the terminator of the source is no blank */
        while (is_blank(raw[at]) ||
               (node->quoting == STUDY_DOUBLE_QUOTED && raw[at] == '\\' &&
                (is_blank(raw[at + 1]) || raw[at + 1] == 'n' || raw[at + 1] == 't')))
            at += raw[at] == '\\' ? 2 : 1;
        if (at >= size) break; /* unreachable: each such character stands in the file */
        value += gough_character_read(node->text + value, node->length - value, NULL);
        if (value > offset) return at;
        at += raw_length(node->quoting, raw + at, size - at);
    }
    return at;
}

study_place study_scalar_place(const study_node *node, size_t offset) {
    study_place place = node->place;
    const size_t size = node->end - place.offset;
    const char *raw = place.source->text + place.offset;
    if (size == node->length && memcmp(raw, node->text, size) == 0)
        place.offset += offset;
    else
        place.offset += walk(node, raw, size, offset);
    return place;
}
