/* What a picture shows in words, for readers who do not see it: the panels, their units, the names of lines and the range of the
 * abscissa. An SVG has it as <title> and <desc>. */
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure/axis_ranges.h"

static void append(char *text, size_t size, const char *words) {
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s", words);
}

static void describe_panel(char *text, size_t size, const panel *p) {
    char unit[48], words[2 * SHEET_TEXT];
    const scaled_range y = p->mapped ? panel_colours(p) : panel_ordinate(p);
    const int power = y.power;
    sheet_unit_label(unit, sizeof unit, p->unit, power);
    snprintf(words, sizeof words, " %s%s, from %.4g to %.4g%s", p->heading, unit, y.range.low,
             y.range.high, p->logarithmic ? ", on a logarithmic axis" : "");
    append(text, size, words);
    const char *before = p->mapped ? "" : "; lines: ";
    for (int i = 0; i < p->count && !p->mapped; i++) {
        if (p->series[i].label[0] == '\0') continue;
        append(text, size, before);
        append(text, size, p->series[i].label);
        before = ", ";
    }
    append(text, size, p->mapped ? "; colours over a plane." : ".");
}

void sheet_describe(const sheet *s, sheet_facts *facts) {
    char words[2 * SHEET_TEXT];
    const range x = sheet_abscissa(s);
    snprintf(facts->title, sizeof facts->title, "%s", s->title[0] != '\0' ? s->title : "Figure");
    snprintf(facts->text, sizeof facts->text, "%s", s->count == 1 ? "One panel" : "Panels");
    snprintf(words, sizeof words, " over %s from %.4g to %.4g%s:", s->abscissa, x.low, x.high,
             s->logarithmic_abscissa ? " on a logarithmic axis" : "");
    append(facts->text, sizeof facts->text, words);
    for (int i = 0; i < s->count; i++)
        describe_panel(facts->text, sizeof facts->text, &s->panel[i]);
    if (s->note[0] == '\0') return;
    append(facts->text, sizeof facts->text, " Note: ");
    append(facts->text, sizeof facts->text, s->note);
    append(facts->text, sizeof facts->text, ".");
}

/* Text of a study between tags: its own marks are written as entities. */
static void write_escaped(FILE *file, const char *text, size_t characters) {
    char plain[2 * SHEET_DESCRIPTION];
    sheet_quote(plain, sizeof plain, text, characters);
    for (const char *at = plain; *at != '\0'; at++) {
        if (*at == '&')
            fputs("&amp;", file);
        else if (*at == '<')
            fputs("&lt;", file);
        else if (*at == '>')
            fputs("&gt;", file);
        else
            fputc(*at, file);
    }
}

/* gnuplot's own title and description have one place each. */
static const char *find(const char *bytes, size_t length, const char *word) {
    const size_t size = strlen(word);
    for (size_t i = 0; i + size <= length; i++)
        if (memcmp(bytes + i, word, size) == 0) return bytes + i;
    return NULL;
}

char *sheet_set_words(const char *bytes, size_t *length, const sheet_facts *facts) {
    const char *begin = find(bytes, *length, "<title>"), *end = find(bytes, *length, "</desc>");
    char *text = NULL;
    size_t size = 0;
    if (begin == NULL || end == NULL || end < begin || facts->title[0] == '\0') {
        text = malloc(*length > 0 ? *length : 1);
        if (text != NULL) memcpy(text, bytes, *length);
        return text;
    }
    FILE *file = open_memstream(&text, &size);
    if (file == NULL) return NULL;
    end += strlen("</desc>");
    fwrite(bytes, 1, (size_t)(begin - bytes), file);
    fputs("<title>", file);
    write_escaped(file, facts->title, SHEET_TEXT);
    fputs("</title>\n<desc>", file);
    write_escaped(file, facts->text, SHEET_DESCRIPTION);
    fputs("</desc>", file);
    fwrite(end, 1, *length - (size_t)(end - bytes), file);
    const bool good = ferror(file) == 0;
    if (fclose(file) != 0 || !good) {
        free(text);
        return NULL;
    }
    *length = size;
    return text;
}
