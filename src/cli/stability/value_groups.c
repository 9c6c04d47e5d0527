/* Tables of eigenvalues and multipliers: values alike together, named by what moves. */
#include "cli/stability/value_groups.h"

#include <math.h>
#include <string.h>

#include "cli/common/paragraph.h"
#include "cli/common/scale.h"

/* real and imaginary parts of eigenvalues below this part of the largest are rounding */
static const double rounding = 1e-12;

/* Values that differ by no more than the rounding of their own size, and of the largest. */
static bool alike(const value_group *group, const mode_value *one, double own, double largest) {
    const double near = 1e-6 * own + rounding * largest;
    return fabs(group->value[0] - one->value[0]) <= near &&
           fabs(group->value[1] - one->value[1]) <= near &&
           strcmp(group->mode[0]->name, one->mode->name) == 0;
}

/* Groups of equal values; of conjugates the upper one stands for both. Eigenvalues are rounded in proportion to the largest of
 * them, multipliers each in proportion to itself. */
int group_values(const mode_value *value, size_t count, bool multipliers,
                 value_group group[GOUGH_LINEAR_MOST]) {
    double largest = 0;
    int groups = 0;
    for (size_t i = 0; i < count && !multipliers; i++)
        largest = fmax(largest, hypot(value[i].value[0], value[i].value[1]));
    for (size_t i = 0; i < count; i++) {
        const double own = hypot(value[i].value[0], value[i].value[1]);
        const double none = fmax(1e-9 * own, rounding * largest);
        int g = 0;
        if (value[i].value[1] < -none) continue;
        while (g < groups && !alike(&group[g], &value[i], own, largest)) g++;
        if (g == groups) {
            group[groups++] = (value_group){.value = {value[i].value[0], value[i].value[1]}};
            for (int k = 0; k < 2; k++)
                if (fabs(value[i].value[k]) < none) group[g].value[k] = 0;
        }
        group[g].mode[group[g].count++] = value[i].mode;
    }
    return groups;
}

/* "yaw", "sway–tilt ×2" */
static void name_group(const value_group *group, char name[GOUGH_MODE_NAME + 16]) {
    if (group->count > 1)
        snprintf(name, GOUGH_MODE_NAME + 16, "%s ×%d", group->mode[0]->name, group->count);
    else
        snprintf(name, GOUGH_MODE_NAME + 16, "%s", group->mode[0]->name);
}

/* Width of the column of names. */
int name_width(const value_group *group, int groups) {
    int widest = 4;
    for (int g = 0; g < groups; g++) {
        char name[GOUGH_MODE_NAME + 16];
        name_group(&group[g], name);
        const int width = text_columns(name);
        if (width > widest) widest = width;
    }
    return widest + 2;
}

int print_name(FILE *stream, const value_group *group, int width) {
    char name[GOUGH_MODE_NAME + 16];
    name_group(group, name);
    fprintf(stream, "    ");
    stability_pad(stream, name, width);
    return 4 + width;
}

static bool same_shape(const gough_mode *a, const gough_mode *b) {
    double apart = 0;
    for (int i = 0; i < 6; i++)
        apart =
            fmax(apart, hypot(a->shape[i][0] - b->shape[i][0], a->shape[i][1] - b->shape[i][1]));
    return apart <= 1e-9;
}

/* What moves, at the end of a line that has `used` columns, or on one of its own. */
void print_moves(FILE *stream, const stability_report *report, const value_group *group, int used) {
    char words[MODE_WORDS];
    const gough_mode *mode[GOUGH_LINEAR_MOST];
    int count = 0;
    for (int i = 0; i < group->count; i++) /* λ = 0 of what drifts is double, with one shape */
        if (!count || !same_shape(mode[count - 1], group->mode[i])) mode[count++] = group->mode[i];
    stability_mode_words(mode, count, report->arm, &report->units, words);
    if (used + 3 + text_columns(words) <= 100) {
        fprintf(stream, "   %s\n", words);
    } else {
        fputc('\n', stream);
        print_paragraph(stream, "        ", 8, "%s", words);
    }
}

/* A number, or a dash where it says nothing. */
int print_cell(FILE *stream, double value, int width) {
    if (isfinite(value))
        fprintf(stream, "%*.6g", width, value);
    else
        fprintf(stream, "%*s", width, "-");
    return width;
}

/* A heading in a cell; where it would touch the one before, the cell is wider. Returns the width. */
int print_heading(FILE *stream, const char *what, const char *unit, int width) {
    const table_heading heading = heading_of(what, unit);
    const int needed = (int)strlen(heading.text) + 1;
    if (width < needed) width = needed;
    fprintf(stream, "%*s", width, heading.text);
    return width;
}
