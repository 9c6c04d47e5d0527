/* Text on a figure: what a study says reaches gnuplot only between single quotes, where it runs nothing. */
#include <stdio.h>
#include <string.h>

#include "sheet.h"

/* Length of the well-formed UTF-8 character at `at`, 0 if there is none (overlong forms and surrogates included). */
static size_t character_length(const unsigned char *at) {
    if (at[0] < 0x80) return at[0] >= 0x20 && at[0] != 0x7f ? 1 : 0;
    if (at[0] < 0xc2 || at[0] > 0xf4) return 0;
    const size_t length = at[0] >= 0xf0 ? 4 : at[0] >= 0xe0 ? 3 : 2;
    for (size_t i = 1; i < length; i++) {
        if ((at[i] & 0xc0) != 0x80) return 0;
    }
    if ((at[0] == 0xe0 && at[1] < 0xa0) || (at[0] == 0xed && at[1] > 0x9f) ||
        (at[0] == 0xf0 && at[1] < 0x90) || (at[0] == 0xf4 && at[1] > 0x8f))
        return 0;
    if (at[0] == 0xc2 && at[1] < 0xa0) return 0; /* C1 control characters */
    return length;
}

void sheet_quote(char *quoted, size_t size, const char *text, size_t characters) {
    const unsigned char *at = (const unsigned char *)text;
    static const char ellipsis[] = "…", typographic[] = "’";
    size_t used = 0, count = 0;
    while (*at != '\0' && used + 4 + sizeof ellipsis < size) {
        if (count++ == characters) {
            memcpy(quoted + used, ellipsis, sizeof ellipsis - 1);
            used += sizeof ellipsis - 1;
            break;
        }
        const size_t length = character_length(at);
        if (length == 0) {
            const bool blank = *at == '\n' || *at == '\r' || *at == '\t';
            quoted[used++] = blank ? ' ' : '?';
            at++;
        } else {
            const bool apostrophe = *at == '\'';
            memcpy(quoted + used, apostrophe ? (const void *)typographic : at,
                   apostrophe ? 3 : length);
            used += apostrophe ? 3 : length;
            at += length;
        }
    }
    quoted[used] = '\0';
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
    const bool takes_prefix = !plain && strchr("mNWs", unit[0]) != NULL;
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
