/* Text as it may be shown on a terminal: whatever has no glyph of its own becomes an escape. */
#include "gough/text.h"

#include <stdbool.h>
#include <string.h>

/* Ranges of characters without a glyph, in rising order: controls, soft hyphen, the format characters of Unicode (class Cf: marks
 * of direction, isolates, joiners, invisible operators, tags), separators of lines and paragraphs, private markers of order. */
static const unsigned hidden[][2] = {
    {0x00, 0x1f},       {0x7f, 0x9f},       {0xad, 0xad},        {0x600, 0x605},
    {0x61c, 0x61c},     {0x6dd, 0x6dd},     {0x70f, 0x70f},      {0x890, 0x891},
    {0x8e2, 0x8e2},     {0x180e, 0x180e},   {0x200b, 0x200f},    {0x2028, 0x202e},
    {0x2060, 0x206f},   {0xfeff, 0xfeff},   {0xfff0, 0xfffb},    {0xfffe, 0xffff},
    {0x110bd, 0x110bd}, {0x110cd, 0x110cd}, {0x13430, 0x1343f},  {0x1bca0, 0x1bca3},
    {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}, {0x10ffff, 0x10ffff}};

static bool is_hidden(unsigned code) {
    for (size_t i = 0; i < sizeof hidden / sizeof hidden[0] && hidden[i][0] <= code; i++)
        if (code <= hidden[i][1]) return true;
    return false;
}

size_t gough_character_read(const char *text, size_t length, unsigned *code) {
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (length == 0) return 0;
    const unsigned lead = (unsigned char)text[0];
    const size_t size = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (size == 0 || lead > 0xf4 || size > length) return 0;
    unsigned value = size == 1 ? lead : lead & (0x7fu >> size);
    for (size_t i = 1; i < size; i++) {
        const unsigned byte = (unsigned char)text[i];
        if ((byte & 0xc0u) != 0x80u) return 0;
        value = value << 6 | (byte & 0x3fu);
    }
    const bool surrogate = value >= 0xd800 && value <= 0xdfff;
    if (value < least[size] || value > 0x10ffff || surrogate) return 0;
    if (code) *code = value;
    return size;
}

size_t gough_character_count(const char *text) {
    size_t count = 0;
    for (; *text; text++) count += ((unsigned char)*text & 0xc0u) != 0x80u;
    return count;
}

static void escape(char *shown, char letter, int digits, unsigned code) {
    *shown++ = '\\';
    *shown++ = letter;
    for (int i = digits - 1; i >= 0; i--) *shown++ = "0123456789abcdef"[code >> 4 * i & 15];
    *shown = '\0';
}

size_t gough_character_show(const char *text, size_t length, char shown[GOUGH_SHOWN_CHARACTER]) {
    unsigned code = 0;
    const size_t size = gough_character_read(text, length, &code);
    if (size == 0) {
        escape(shown, 'x', 2, (unsigned char)text[0]);
        return 1;
    }
    if (!is_hidden(code)) {
        memcpy(shown, text, size);
        shown[size] = '\0';
    } else if (size == 1) {
        escape(shown, 'x', 2, code);
    } else {
        escape(shown, code > 0xffff ? 'U' : 'u', code > 0xffff ? 8 : 4, code);
    }
    return size;
}

size_t gough_text_show(const char *text, size_t length, char *shown, size_t size) {
    size_t all = 0, used = 0;
    for (size_t at = 0; at < length;) {
        char one[GOUGH_SHOWN_CHARACTER];
        at += gough_character_show(text + at, length - at, one);
        const size_t bytes = strlen(one);
        if (used == all && used + bytes < size) {
            memcpy(shown + used, one, bytes);
            used += bytes;
        }
        all += bytes;
    }
    if (size > 0) shown[used] = '\0';
    return all;
}
