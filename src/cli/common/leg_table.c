/* Columns of numbers with their points aligned, one row a leg. */
#include "cli/common/leg_table.h"

#include <math.h>
#include <string.h>

enum { WIDEST = 24, MOST_COLUMNS = 16, GAP = 2, GROUP_GAP = 4 };

/* Every number keeps three significant digits, whatever stands beside it; what is smaller than this share of the largest beside
 * it is round-off, and 0. */
static const double ROUND_OFF = 1e-12;

/* How the numbers of one group are printed: decimals, or negative for an exponent; and what is round-off there. */
static int decimals_for(const table_column *first, const table_column *last, bool with_all,
                        double *nothing) {
    double largest = 0;
    for (const table_column *c = first; c <= last; c++)
        for (int i = 0; i < GOUGH_LEGS + with_all; i++)
            if (isfinite(c->value[i])) largest = fmax(largest, fabs(c->value[i]));
    *nothing = ROUND_OFF * largest;
    if (!(largest > 0)) return 0;
    const int decade = (int)floor(log10(largest));
    if (decade < -4 || decade > 8) return -first->digits;
    const int decimals = first->digits - 1 - decade;
    return decimals < 0 ? 0 : decimals;
}

static int print_number(char *text, double value, int decimals, double nothing) {
    if (!isfinite(value)) return snprintf(text, WIDEST, "-");
    /* no "-0.000" for a round-off */
    if (!(fabs(value) > nothing)) value = 0.0;
    if (decimals < 0) return snprintf(text, WIDEST, "%.*e", -decimals - 1, value);
    /* 0.00123 rather than 0.0012 beside numbers that need fewer decimals */
    if (fabs(value) > 0 && fabs(value) < 99.95 * pow(10, -decimals))
        return snprintf(text, WIDEST, "%.3g", value);
    return snprintf(text, WIDEST, "%.*f", decimals, value);
}

typedef struct column_layout {
    int gap, width, decimals;
    double nothing;
    int last; /* of the group's columns */
} column_layout;

static int display_width(const char *text) { return (int)gough_character_count(text); }

static int lay_out(const table_column *column, bool with_all, column_layout *layout) {
    int count = 0;
    while (count < MOST_COLUMNS && column[count].head) count++;
    for (int first = 0, last; first < count; first = last + 1) {
        last = first;
        while (last + 1 < count && strcmp(column[last + 1].group, column[first].group) == 0) last++;
        double nothing = 0;
        const int decimals = decimals_for(&column[first], &column[last], with_all, &nothing);
        int whole = -GAP;
        for (int c = first; c <= last; c++) {
            int width = display_width(column[c].head);
            for (int i = 0; i < GOUGH_LEGS + with_all; i++) {
                char text[WIDEST];
                const int wide = print_number(text, column[c].value[i], decimals, nothing);
                if (wide > width) width = wide;
            }
            layout[c].width = width;
            layout[c].decimals = decimals;
            layout[c].nothing = nothing;
            layout[c].gap = c == first ? GROUP_GAP : GAP;
            layout[c].last = last;
            whole += width + GAP;
        }
        const int heading = display_width(column[first].group);
        if (heading > whole) layout[first].width += heading - whole;
    }
    return count;
}

/* The groups, each centred over its columns. */
static void print_headings(FILE *stream, const table_column *column, const column_layout *layout,
                           int count) {
    int blank = 5; /* spaces owed, so that no line ends in them */
    for (int c = 0; c < count; c = layout[c].last + 1) {
        int whole = -GAP;
        for (int k = c; k <= layout[c].last; k++) whole += layout[k].width + GAP;
        const int free = whole - display_width(column[c].group);
        const int left = layout[c].last > c ? free - free / 2 : free;
        blank += GROUP_GAP + left;
        if (*column[c].group) {
            fprintf(stream, "%*s%s", blank, "", column[c].group);
            blank = 0;
        }
        blank += free - left;
    }
    fputc('\n', stream);
}

void table_print(FILE *stream, const table_column *column, bool with_all) {
    column_layout layout[MOST_COLUMNS];
    const int count = lay_out(column, with_all, layout);
    print_headings(stream, column, layout, count);
    fprintf(stream, "  leg");
    for (int c = 0; c < count; c++)
        fprintf(stream, "%*s%s", layout[c].gap + layout[c].width - display_width(column[c].head),
                "", column[c].head);
    fputc('\n', stream);
    for (int i = 0; i < GOUGH_LEGS + with_all; i++) {
        if (i < GOUGH_LEGS)
            fprintf(stream, "  %3d", i + 1);
        else
            fprintf(stream, "  all");
        for (int c = 0; c < count; c++) {
            char text[WIDEST];
            print_number(text, column[c].value[i], layout[c].decimals, layout[c].nothing);
            fprintf(stream, "%*s%*s", layout[c].gap, "", layout[c].width, text);
        }
        fputc('\n', stream);
    }
}
