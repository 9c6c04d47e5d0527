/* Reading an SVG of gnuplot's by the shape of its lines: a tick is the last stroke of a path with its text right behind it. */
#include "figure/svg.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Copies markup without its tags, hyphens for minus signs; a raised part becomes an exponent after 'e'. */
static void plain_text(const char *markup, const char *end, char *text, size_t size) {
    size_t used = 0;
    while (markup < end && used + 2 < size) {
        if (*markup == '<') {
            const char *close = strchr(markup, '>');
            const char *raised = strstr(markup, "dy=\"-");
            if (raised != NULL && raised < close) text[used++] = '^';
            markup = close + 1;
        } else {
            text[used++] = *markup++;
        }
    }
    text[used] = '\0';
}

/* A decimal number that may begin with a minus sign; *end is moved behind it. */
static double decimal(const char *text, const char **end) {
    static const char minus[] = "−";
    const bool negative = strncmp(text, minus, strlen(minus)) == 0;
    if (negative) text += strlen(minus);
    if (*text < '0' || *text > '9') return NAN;
    char *stop;
    const double value = strtod(text, &stop);
    *end = stop;
    return negative ? -value : value;
}

static double plain_number(const char *text) {
    const char *at = text;
    double value = decimal(text, &at);
    static const char dot[] = "·";
    if (strncmp(at, dot, strlen(dot)) == 0) {
        at += strlen(dot);
        if (strncmp(at, "10^", 3) != 0) return NAN;
        at += 3;
        value *= pow(10.0, decimal(at, &at));
    } else if (*at == '^') {
        value = pow(value, decimal(at + 1, &at));
    }
    return *at == '\0' ? value : NAN;
}

double svg_number(const char *markup) {
    char text[128];
    plain_text(markup, markup + strlen(markup), text, sizeof text);
    return plain_number(text);
}

static int characters(const char *text) {
    int count = 0;
    for (; *text != '\0'; text++) count += ((unsigned char)*text & 0xC0) != 0x80;
    return count;
}

/* DejaVu Sans at 11 pixels: a figure is 7 wide. */
static double left_of(const char *group, double x, const char *text) {
    const double width = 7.0 * characters(text);
    const char *end = strchr(group, '>');
    const char *anchor = strstr(group, "text-anchor=\"");
    if (anchor == NULL || anchor > end) return x;
    if (strncmp(anchor + 13, "end", 3) == 0) return x - width;
    return strncmp(anchor + 13, "middle", 6) == 0 ? x - width / 2 : x;
}

/* The last stroke of the path that ends right before a group; false if there is none, or not a short one along one axis. */
static bool stroke_before(const char *svg, const char *group, double x[2], double y[2]) {
    const char *end = group;
    while (end > svg && strchr(" \t\n", end[-1]) != NULL) end--;
    if (end - svg < 3 || strncmp(end - 3, "'/>", 3) != 0) return false;
    while (end > svg && *end != 'M' && *end != '<') end--;
    if (*end != 'M' || sscanf(end, "M%lf,%lf L%lf,%lf", &x[0], &y[0], &x[1], &y[1]) != 4)
        return false;
    const double across = fabs(x[0] - x[1]), down = fabs(y[0] - y[1]);
    return fmin(across, down) < 1e-9 && fmax(across, down) < 6;
}

void svg_read_ticks(const char *svg, svg_ticks *ticks) {
    static const char start[] = "<g transform=\"translate(";
    ticks->count = 0;
    for (const char *at = svg; (at = strstr(at, start)) != NULL; at++) {
        double x[2], y[2], text_x, text_y;
        if (!stroke_before(svg, at, x, y)) continue;
        const char *text = strstr(at, "<text>"), *end = strstr(at, "</text>");
        if (sscanf(at + strlen(start), "%lf,%lf)", &text_x, &text_y) != 2 || text == NULL ||
            end == NULL || ticks->count == SVG_TICKS)
            continue;
        svg_tick *t = &ticks->tick[ticks->count];
        *t = (svg_tick){.below = fabs(x[0] - x[1]) < 1e-9};
        plain_text(text + 6, end, t->text, sizeof t->text);
        if (t->text[0] == '\0') continue;
        t->side = t->below ? y[0] : x[0];
        t->place = t->below ? x[0] : y[0];
        t->value = plain_number(t->text);
        t->text_left = left_of(at, text_x, t->text);
        ticks->count++;
    }
}

static bool same_side(const svg_ticks *all, int a, int b) {
    const svg_tick *p = &all->tick[a], *q = &all->tick[b];
    return p->below == q->below && fabs(p->side - q->side) < 0.5;
}

/* An axis ends where its values begin anew: panels one above the other have the same left side. */
void svg_side(const svg_ticks *all, bool below, int number, svg_ticks *side) {
    side->count = 0;
    int found = -1, last = -1;
    for (int i = 0; i < all->count; i++) {
        if (all->tick[i].below != below) continue;
        const bool same = last == i - 1 && last >= 0 && same_side(all, last, i);
        if (!same) found++;
        last = i;
        if (found == number) side->tick[side->count++] = all->tick[i];
    }
}

/* Points of the longest unbroken part of a path: the sample in the key may be another part. */
static size_t read_points(const char *at, svg_line *line) {
    static svg_line part;
    line->count = part.count = 0;
    bool more = true;
    while (more) {
        at += strspn(at, " \t\n");
        int used = 0;
        const bool begins = *at == 'M';
        double x, y;
        more = part.count < SVG_POINTS &&
               sscanf(at + strspn(at, "ML"), "%lf,%lf%n", &x, &y, &used) == 2;
        if ((begins || !more) && part.count > line->count) *line = part;
        if (begins) part.count = 0;
        if (!more) break;
        part.x[part.count] = x;
        part.y[part.count++] = y;
        at += strspn(at, "ML") + (size_t)used;
    }
    return line->count;
}

bool svg_read_line(const char *svg, const char *colour, int number, svg_line *line) {
    char start[80];
    snprintf(start, sizeof start, "<path stroke='rgb(%s)'  d='", colour);
    for (const char *at = svg; (at = strstr(at, start)) != NULL; at++) {
        if (read_points(at + strlen(start), line) > 1 && number-- == 0) return true;
    }
    return false;
}

int svg_power(const char *svg, const char *heading) {
    static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char start[128];
    snprintf(start, sizeof start, ">%s (10", heading);
    const char *at = strstr(svg, start);
    if (at == NULL) return 0;
    at += strlen(start);
    const bool negative = strncmp(at, "⁻", strlen("⁻")) == 0;
    if (negative) at += strlen("⁻");
    int power = 0;
    for (int d = 0; d < 10; d++) {
        if (strncmp(at, digit[d], strlen(digit[d])) != 0) continue;
        power = 10 * power + d;
        at += strlen(digit[d]);
        d = -1;
    }
    return negative ? -power : power;
}
