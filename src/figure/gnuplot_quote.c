/* Text on a figure: what a study says reaches gnuplot only between single quotes, where it runs nothing. */
#include <stdio.h>
#include <string.h>

#include "figure/sheet.h"
#include "gough/text.h"

/* Whether a character can be drawn, and stand in XML, as it is. taken: its bytes, or those of what stands in its place. */
static bool is_drawable(const char *text, size_t length, size_t *taken) {
    char shown[GOUGH_SHOWN_CHARACTER];
    *taken = gough_character_show(text, length, shown);
    return strlen(shown) == *taken && memcmp(shown, text, *taken) == 0;
}

void sheet_quote(char *quoted, size_t size, const char *text, size_t characters) {
    static const char ellipsis[] = "…", typographic[] = "’";
    const char *end = text + strlen(text);
    size_t used = 0, count = 0;
    for (const char *at = text; at < end && used + 4 + sizeof ellipsis < size;) {
        size_t taken;
        if (count++ == characters) {
            memcpy(quoted + used, ellipsis, sizeof ellipsis - 1);
            used += sizeof ellipsis - 1;
            break;
        }
        if (*at == '\'') {
            memcpy(quoted + used, typographic, 3);
            used += 3;
            taken = 1;
        } else if (is_drawable(at, (size_t)(end - at), &taken)) {
            memcpy(quoted + used, at, taken);
            used += taken;
        } else {
            quoted[used++] = *at == '\n' || *at == '\r' || *at == '\t' ? ' ' : '?';
        }
        at += taken;
    }
    quoted[used] = '\0';
}

size_t sheet_line(const char *text, size_t characters) {
    size_t fitting = 0, count = 0, at = 0;
    for (; text[at] != '\0'; at++) {
        const bool begins = ((unsigned char)text[at] & 0xC0u) != 0x80u;
        if (begins && count++ >= characters && text[at] != ' ' && fitting > 0) return fitting;
        if (text[at] == ' ') fitting = at + 1;
        if (text[at] == ' ' && count > characters) return fitting;
    }
    return at;
}

static void append(char *label, size_t size, const char *text) {
    const size_t used = strlen(label);
    snprintf(label + used, size - used, "%s", text);
}

static const char *const superscript[10] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

/* "degree/s2" as "°/s²". */
static void append_unit(char *label, size_t size, const char *unit) {
    if (strncmp(unit, "degree", 6) == 0) {
        append(label, size, "°");
        unit += 6;
    }
    for (; *unit != '\0'; unit++) {
        const char one[2] = {*unit, '\0'};
        append(label, size, *unit >= '0' && *unit <= '9' ? superscript[*unit - '0'] : one);
    }
}

void sheet_unit_label(char *label, size_t size, const char *unit, int power) {
    static const char *const prefix[] = {"n", "µ", "m", "", "k", "M", "G"};
    const bool plain = unit[0] == '\0' || strcmp(unit, "1") == 0;
    /* of "mm", "ms" and "mrad" the first letter is a prefix */
    const bool letter = !plain && unit[1] >= 'a' && unit[1] <= 'z';
    const bool takes_prefix = !plain && strchr("mNWs", unit[0]) != NULL && !letter;
    label[0] = '\0';
    if (plain && power == 0) return;

    append(label, size, " (");
    if (power != 0 && takes_prefix && power >= -3 && power <= 3) {
        append(label, size, prefix[power + 3]);
    } else if (power != 0) {
        const int exponent = 3 * power < 0 ? -3 * power : 3 * power;
        append(label, size, power < 0 ? "10⁻" : "10");
        if (exponent >= 100) append(label, size, superscript[exponent / 100 % 10]);
        if (exponent >= 10) append(label, size, superscript[exponent / 10 % 10]);
        append(label, size, superscript[exponent % 10]);
        if (!plain) append(label, size, " ");
    }
    if (!plain) append_unit(label, size, unit);
    append(label, size, ")");
}
