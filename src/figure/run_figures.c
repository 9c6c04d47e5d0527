/* What each kind of figure shows. One table: a colour means a leg or a component. Several tables: a colour means a table, and
 * each moving component has a panel of its own. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure/axis_ranges.h"
#include "figure/difference.h"
#include "figure/palette.h"
#include "gough/text.h"

enum { COMPONENTS = 6 };
static const char *const component_name[COMPONENTS] = {"x", "y", "z", "roll", "pitch", "yaw"};
static const char *const deviation_name[COMPONENTS] = {"ex", "ey", "ez", "eroll", "epitch", "eyaw"};
static const char *const component_heading[COMPONENTS] = {"Position x", "Position y", "Height z",
                                                          "Roll",       "Pitch",      "Yaw"};

/* ---- what moves ------------------------------------------------------------------------------------------------ */

/* The greatest leg length: a lever by which angles compare with displacements. */
static double lever_of(builder *b) {
    double lever = 0.0;
    for (size_t t = 0; t < b->measured_count; t++) {
        const double *length = gough_table_column(b->measured[t], "l1");
        double least, greatest;
        if (length == NULL) continue;
        builder_extremes(b->measured[t], length, &least, &greatest);
        lever = fmax(lever, greatest);
    }
    return lever > 0.0 ? lever : 1.0;
}

/* A component that moves a joint by less than 1/200 of what the others do, or by no more than noise, is taken to rest: a panel
 * of it would mostly show how round-off grows. */
static void find_moving(builder *b, const char *const names[COMPONENTS], bool moving[COMPONENTS]) {
    const double degree = 0.017453292519943295 * lever_of(b);
    double span[COMPONENTS] = {0}, most = 0.0;
    for (size_t t = 0; t < b->table_count; t++) {
        for (int c = 0; c < COMPONENTS; c++) {
            const double *value = builder_column(b, t, names[c]);
            double least, greatest;
            if (value == NULL) return;
            builder_extremes(b->tables[t], value, &least, &greatest);
            span[c] = fmax(span[c], (greatest - least) * (c < 3 ? 1.0 : degree));
            most = fmax(most, span[c]);
        }
    }
    const double noise = builder_noise(b, component_name[0]);
    for (int c = 0; c < COMPONENTS; c++) moving[c] = span[c] > fmax(most / 200.0, noise);
}

static int count_true(const bool *flags, int count) {
    int sum = 0;
    for (int i = 0; i < count; i++) sum += flags[i];
    return sum;
}

/* ---- motion ---------------------------------------------------------------------------------------------------- */

/* The table that reaches furthest in time. */
static size_t longest_table(const builder *b) {
    size_t longest = 0;
    double last = -INFINITY;
    for (size_t t = 0; t < b->table_count; t++) {
        const double *time = gough_table_column(b->tables[t], "t");
        const size_t rows = b->tables[t]->rows;
        if (time == NULL || rows == 0 || !(time[rows - 1] > last)) continue;
        last = time[rows - 1];
        longest = t;
    }
    return longest;
}

/* The program of a component, actual − deviation, pale under the lines; none in a table of forces. */
static void add_program(builder *b, panel *p, int component, double offset, const char *label) {
    const size_t t = longest_table(b);
    if (b->figure->difference) return; /* programs have no place in a difference of motions */
    const gough_table *table = b->tables[t];
    const double *actual = gough_table_column(table, component_name[component]);
    const double *deviation = gough_table_column(table, deviation_name[component]);
    if (actual == NULL || deviation == NULL || p == NULL) return;
    double *program = builder_array(b, t);
    if (program == NULL) return;
    for (size_t r = 0; r < table->rows; r++) program[r] = actual[r] - deviation[r] - offset;
    builder_line(b, p, t, "t", program, label, -1);
}

static void add_component_panel(builder *b, int c) {
    panel *p = builder_panel_of(b, component_heading[c], component_name[c], false);
    add_program(b, p, c, 0.0, "program");
    for (size_t t = 0; t < b->table_count; t++) {
        const char *label = builder_compares(b) ? builder_label(b, t) : "motion";
        builder_line(b, p, t, "t", builder_column(b, t, component_name[c]), label,
                     builder_compares(b) ? colour_of_table(t) : colour_of_axis(c % 3));
    }
    /* a line alone needs no key */
    if (p != NULL && p->count == 1) p->series[0].label[0] = '\0';
}

static void fill_motion(builder *b) {
    bool moving[COMPONENTS] = {false};
    find_moving(b, component_name, moving);
    if (count_true(moving, COMPONENTS) == 0) moving[2] = true;
    const bool both = count_true(moving, 3) > 0 && count_true(moving + 3, 3) > 0;
    if (both || count_true(moving, COMPONENTS) > 3) b->sheet->columns = 2;
    for (int pair = 0; pair < 3; pair++) {
        if (moving[pair]) add_component_panel(b, pair);
        if (moving[pair + 3]) add_component_panel(b, pair + 3);
    }
}

/* Several components of one table in a panel, lengths from their first value, over their programs. */
static void add_components(builder *b, const char *heading, int first, const bool *moving) {
    panel *p = builder_panel_of(b, heading, component_name[first], false);
    double offset[COMPONENTS] = {0};
    const char *label = "program";
    for (int c = first; c < first + 3; c++) {
        const double *value = builder_column(b, 0, component_name[c]);
        if (value == NULL || b->tables[0]->rows == 0) continue;
        if (c < 3) offset[c] = value[0];
        if (!moving[c]) continue;
        add_program(b, p, c, offset[c], label);
        label = "";
    }
    for (int c = first; c < first + 3; c++) {
        const double *value = builder_column(b, 0, component_name[c]);
        double *shifted = moving[c] ? builder_array(b, 0) : NULL;
        if (value == NULL || shifted == NULL) continue;
        for (size_t r = 0; r < b->tables[0]->rows; r++) shifted[r] = value[r] - offset[c];
        builder_line(b, p, 0, "t", shifted, component_name[c], colour_of_axis(c - first));
    }
}

/* The motion in few panels, for the overview. */
static void add_motion(builder *b) {
    bool moving[COMPONENTS] = {false};
    find_moving(b, component_name, moving);
    const int lengths = count_true(moving, 3), angles = count_true(moving + 3, 3);
    const bool apart = builder_compares(b);
    for (int c = 0; c < COMPONENTS; c++) {
        const bool alone = (c < 3 ? lengths : angles) == 1;
        if (moving[c] && (apart || alone)) add_component_panel(b, c);
    }
    if (apart) return;
    if (lengths > 1) add_components(b, "Displacement", 0, moving);
    if (angles > 1) add_components(b, "Angles", 3, moving);
    if (lengths + angles == 0) add_component_panel(b, 2);
}

/* ---- legs ------------------------------------------------------------------------------------------------------ */

static void fill_forces(builder *b) { builder_add_legs(b, "Leg force", "f"); }
static void fill_lengths(builder *b) { builder_add_legs(b, "Leg length", "l"); }
static void fill_rates(builder *b) { builder_add_legs(b, "Leg rate", "dl"); }
static void fill_power(builder *b) { builder_add_legs(b, "Leg power", "p"); }

/* ---- deviation, drift, condition ------------------------------------------------------------------------------- */

/* √(a² + b² + c²) of three columns. */
static double *magnitude(builder *b, size_t t, const char *const names[3]) {
    const double *part[3];
    for (int i = 0; i < 3; i++) part[i] = builder_column(b, t, names[i]);
    double *size = builder_array(b, t);
    if (size == NULL) return NULL;
    for (size_t r = 0; r < b->tables[t]->rows; r++)
        size[r] = hypot(hypot(part[0][r], part[1][r]), part[2][r]);
    return size;
}

static void add_deviation_size(builder *b, const char *heading, int first, bool logarithmic) {
    panel *p = builder_panel_of(b, heading, deviation_name[first], logarithmic);
    for (size_t t = 0; t < b->table_count; t++) {
        const double *size = magnitude(b, t, deviation_name + first);
        builder_line(b, p, t, "t", size, builder_compares(b) ? builder_label(b, t) : "",
                     colour_of_table(t));
    }
}

static void add_deviation_parts(builder *b, const char *heading, int first, const bool *moving) {
    panel *p = builder_panel_of(b, heading, deviation_name[first], false);
    for (int c = first; c < first + 3; c++) {
        if (moving[c])
            builder_line(b, p, 0, "t", builder_column(b, 0, deviation_name[c]), component_name[c],
                         colour_of_axis(c - first));
    }
}

/* Components of one table; sizes where tables are compared or the ordinate is logarithmic. */
static void fill_deviation(builder *b) {
    bool moving[COMPONENTS] = {false};
    find_moving(b, deviation_name, moving);
    const bool sizes = b->figure->logarithmic || builder_compares(b);
    if (count_true(moving, 3) == 0) moving[2] = true;
    if (sizes)
        add_deviation_size(b, "Deviation of position from the program", 0, b->figure->logarithmic);
    else
        add_deviation_parts(b, "Deviation of position from the program", 0, moving);
    if (count_true(moving + 3, 3) == 0) return;
    if (sizes)
        add_deviation_size(b, "Deviation of angles from the program", 3, b->figure->logarithmic);
    else
        add_deviation_parts(b, "Deviation of angles from the program", 3, moving);
}

static void add_plain(builder *b, const char *heading, const char *name, bool logarithmic) {
    panel *p = builder_panel(b, heading, "", logarithmic);
    for (size_t t = 0; t < b->table_count; t++)
        builder_line(b, p, t, "t", builder_column(b, t, name),
                     builder_compares(b) ? builder_label(b, t) : "", colour_of_table(t));
}

static void fill_drift(builder *b) {
    add_plain(b, "Constraint drift before projection", "drift", true);
}

/* Logarithmic where it spans two decades. */
static void fill_condition(builder *b) {
    bool wide = b->figure->logarithmic;
    for (size_t t = 0; t < b->table_count; t++) {
        const double *value = builder_column(b, t, "condition");
        double least, greatest;
        if (value == NULL) return;
        builder_extremes(b->tables[t], value, &least, &greatest);
        wide = wide || (least > 0.0 && greatest > 100.0 * least);
    }
    add_plain(b, "Condition number of the leg Jacobian", "condition", wide);
}

/* ---- overview -------------------------------------------------------------------------------------------------- */

static void fill_overview(builder *b) {
    bool simulated = true;
    for (size_t t = 0; t < b->table_count; t++)
        simulated = simulated && gough_table_column(b->tables[t], "ex") != NULL;
    b->sheet->columns = 2;
    add_motion(b);
    builder_add_legs(b, "Leg length", "l");
    builder_add_legs(b, "Leg force", "f");
    if (simulated) {
        bool moving[COMPONENTS] = {false};
        find_moving(b, deviation_name, moving);
        add_deviation_size(b, "Deviation of position", 0, true);
        if (count_true(moving + 3, 3) > 0) add_deviation_size(b, "Deviation of angles", 3, true);
    } else {
        builder_add_legs(b, "Leg rate", "dl");
        builder_add_legs(b, "Leg power", "p");
    }
    if (b->sheet->count % 2 == 1) fill_condition(b);
}

/* ---- tables of any kind ---------------------------------------------------------------------------------------- */

static const char *abscissa_of(const gough_table *table) {
    return gough_table_column(table, "t") != NULL ? "t" : table->name[0];
}

/* "t" as "time (s)", any other column by its name. */
static void name_abscissa(builder *b, const char *name) {
    builder_abscissa(b, strcmp(name, "t") == 0 ? "time" : name, name);
}

static void report_unknown_column(builder *b, const char *name) {
    const gough_table *table = b->tables[0];
    const int near =
        gough_word_nearest(name, strlen(name), (const char *const *)table->name, table->columns);
    b->status = gough_fail(b->error, GOUGH_ERROR_INPUT, "no column '%.60s'%s%.60s%s", name,
                           near >= 0 ? "; did you mean " : "", near >= 0 ? table->name[near] : "",
                           near >= 0 ? "?" : "");
}

static const gough_column_info *find_info(const char *name) {
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        if (strcmp(gough_column(c)->name, name) == 0) return gough_column(c);
    }
    return NULL;
}

/* A panel of one column says in words what it is: "Height z"; a column of other hands keeps its name. */
static void spell_out(panel *p, const char *name) {
    const gough_column_info *info = find_info(name);
    const char *words = info != NULL ? info->long_name : name;
    for (int c = 0; c < COMPONENTS; c++) {
        if (strcmp(component_name[c], name) == 0) words = component_heading[c];
    }
    snprintf(p->heading, sizeof p->heading, "%s", words);
    if (info != NULL && p->heading[0] >= 'a' && p->heading[0] <= 'z')
        p->heading[0] = (char)(p->heading[0] - 'a' + 'A');
}

/* Whether two columns are of one dimension, so that one ordinate serves both: known by name, else by unit. */
static bool same_dimension(const builder *b, const char *name, const char *other) {
    const gough_column_info *p = find_info(name), *q = find_info(other);
    if (p != NULL && q != NULL)
        return p->length == q->length && p->mass == q->mass && p->time == q->time &&
               p->angle == q->angle && (p->length || p->time || p->angle);
    const char *unit = builder_unit(b, name);
    return unit[0] != '\0' && strcmp(unit, "1") != 0 && strcmp(unit, builder_unit(b, other)) == 0;
}

/* Columns of one dimension share a panel when there is one table. */
static panel *panel_for_column(builder *b, const char *name) {
    for (int p = 0; p < b->sheet->count && !builder_compares(b); p++) {
        panel *candidate = &b->sheet->panel[p];
        if (!same_dimension(b, name, candidate->series[0].label)) continue;
        const size_t used = strlen(candidate->heading);
        snprintf(candidate->heading + used, sizeof candidate->heading - used, ", %.40s", name);
        return candidate;
    }
    panel *p = builder_panel_of(b, name, name, b->figure->logarithmic);
    if (p != NULL && builder_compares(b)) spell_out(p, name);
    return p;
}

/* A line alone in its panel is named by the heading and needs no key. */
static void name_lone_lines(sheet *s) {
    for (int p = 0; p < s->count; p++) {
        panel *lone = &s->panel[p];
        if (lone->count != 1) continue;
        spell_out(lone, lone->series[0].label);
        lone->series[0].label[0] = '\0';
    }
}

/* The next name of a list with commas, without the blanks around it (a name may have some within); NULL at the end. */
static char *next_name(char **rest) {
    char *name = *rest;
    if (name == NULL) return NULL;
    char *end = name + strcspn(name, ",");
    *rest = *end != '\0' ? end + 1 : NULL;
    *end = '\0';
    name += strspn(name, " ");
    while (end > name && end[-1] == ' ') *--end = '\0';
    return name;
}

static bool has_colour(const panel *p, int colour) {
    for (int i = 0; i < p->count; i++)
        if (p->series[i].colour == colour) return true;
    return false;
}

/* A leg's or an axis' own colour, if the panel has no line of it yet; else the first that it has no line of. */
static int colour_of_column(const panel *p, const char *name) {
    static const char *const of_leg[] = {"l", "dl", "f", "p"};
    int wanted = -1;
    for (int leg = 0; leg < GOUGH_LEGS; leg++)
        for (size_t i = 0; i < sizeof of_leg / sizeof of_leg[0]; i++) {
            char column[8];
            snprintf(column, sizeof column, "%s%d", of_leg[i], leg + 1);
            if (strcmp(name, column) == 0) wanted = colour_of_leg(leg);
        }
    for (int c = 0; c < COMPONENTS; c++)
        if (strcmp(name, component_name[c]) == 0 || strcmp(name, deviation_name[c]) == 0)
            wanted = colour_of_axis(c % 3);
    if (wanted >= 0 && !has_colour(p, wanted)) return wanted;
    size_t next = 0;
    while (has_colour(p, colour_of_table(next))) next++;
    return colour_of_table(next);
}

static void fill_columns(builder *b) {
    char *list = strdup(b->figure->columns != NULL ? b->figure->columns : "");
    if (list == NULL) {
        builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
        return;
    }
    const char *abscissa = abscissa_of(b->tables[0]);
    name_abscissa(b, abscissa);
    char *rest = list;
    for (char *name = next_name(&rest); name != NULL; name = next_name(&rest)) {
        if (name[0] == '\0') continue;
        if (gough_table_column(b->tables[0], name) == NULL) {
            report_unknown_column(b, name);
            break;
        }
        panel *p = panel_for_column(b, name);
        for (size_t t = 0; t < b->table_count && p != NULL; t++)
            builder_line(b, p, t, abscissa, builder_column(b, t, name),
                         builder_compares(b) ? builder_label(b, t) : name,
                         builder_compares(b) ? colour_of_table(t) : colour_of_column(p, name));
    }
    free(list);
    if (!builder_compares(b)) name_lone_lines(b->sheet);
    if (b->status == GOUGH_OK && b->sheet->count == 0)
        builder_fail(b, GOUGH_ERROR_INPUT,
                     "give the columns to draw, separated by commas (for example z,f1,f2)");
    if (b->sheet->count > 4) b->sheet->columns = 2;
}

/* Deviation against the stiffness of the feedback, both logarithmic. */
static void fill_gain(builder *b) {
    const char *ordinate = "position_deviation";
    b->sheet->logarithmic_abscissa = true;
    builder_abscissa(b, "stiffness of the feedback G", "G");
    panel *p = builder_panel_of(b, "Largest deviation of position", ordinate, true);
    for (size_t t = 0; t < b->table_count; t++) {
        series *line =
            builder_line(b, p, t, "G", builder_column(b, t, ordinate),
                         builder_compares(b) ? builder_label(b, t) : "", colour_of_table(t));
        if (line == NULL) return;
        line->points = true;
        line->ended = gough_table_column(b->tables[t], "ended");
    }
}

/* ---- the kinds ------------------------------------------------------------------------------------------------- */

static const char *const kind_names[] = {
    "overview — motion, leg lengths and forces, and deviation or power, on one sheet",
    "motion — each component of the pose that moves, and its program",
    "forces — leg forces",
    "lengths — leg lengths",
    "rates — leg rates",
    "power — leg powers",
    "duty — drive force over leg rate, with the limits and the RMS of both",
    "deviation — deviation from the program; its magnitude with --log or if compared",
    "drift — violation of the constraints before projection",
    "condition — condition number of the leg Jacobian",
    "columns — the columns given by --columns",
    "gain — deviation against the stiffness G, from columns G and position_deviation",
    "tuning — results of gough tune: deviation and leg force against the stiffness",
    "sweep — a sweep: a line over one swept key, a map over two, shares of the runs over more",
    NULL};

static void (*const fillers[])(builder *b) = {
    fill_overview, fill_motion,       fill_forces,         fill_lengths,      fill_rates,
    fill_power,    builder_fill_duty, fill_deviation,      fill_drift,        fill_condition,
    fill_columns,  fill_gain,         builder_fill_tuning, builder_fill_sweep};

enum { KINDS = sizeof fillers / sizeof fillers[0] };

const char *const *gough_figure_kinds(void) { return kind_names; }

const char *sheet_default_kind(const gough_table *table) {
    if (sheet_is_sweep(table)) return "sweep";
    if (sheet_is_tuning(table)) return "tuning";
    if (gough_table_column(table, "G") != NULL &&
        gough_table_column(table, "position_deviation") != NULL)
        return "gain";
    return gough_table_column(table, "t") != NULL && gough_table_column(table, "f1") != NULL
               ? "overview"
               : "columns";
}

static int find_kind(builder *b, const char *name) {
    const size_t length = strlen(name);
    for (int k = 0; k < KINDS; k++) {
        if (strcspn(kind_names[k], " ") == length && strncmp(kind_names[k], name, length) == 0)
            return k;
    }
    const int near = gough_word_nearest(name, strlen(name), kind_names, KINDS);
    const char *meant = near >= 0 ? kind_names[near] : "overview";
    b->status =
        gough_fail(b->error, GOUGH_ERROR_INPUT, "there is no kind of figure '%.60s'; %s %.*s", name,
                   near >= 0 ? "did you mean" : "the default is", (int)strcspn(meant, " "), meant);
    return -1;
}

/* Which kinds have a panel for each leg, and which a difference. */
static gough_status check_options(builder *b, const char *kind) {
    static const char *const split[] = {"forces", "lengths", "rates", "power", NULL},
                             *const whole[] = {"duty", "drift", "gain", "tuning", "sweep", NULL};
    const size_t length = strcspn(kind, " ");
    bool splits = false, differs = true;
    for (int i = 0; split[i] != NULL; i++)
        splits = splits || (strlen(split[i]) == length && strncmp(kind, split[i], length) == 0);
    for (int i = 0; whole[i] != NULL; i++)
        differs = differs && !(strlen(whole[i]) == length && strncmp(kind, whole[i], length) == 0);
    if (b->figure->split && !splits)
        b->status = gough_fail(b->error, GOUGH_ERROR_INPUT,
                               "the figure %.*s has no panel for each leg; forces, lengths, rates "
                               "and power have one",
                               (int)length, kind);
    else if (b->figure->difference && !differs)
        b->status = gough_fail(b->error, GOUGH_ERROR_INPUT,
                               "the figure %.*s does not draw a difference; overview, motion, "
                               "forces, lengths, rates, power, deviation, condition and columns do",
                               (int)length, kind);
    return b->status;
}

/* "Leg force" becomes "Difference of leg force"; names of columns keep their letters. */
static void name_differences(sheet *s) {
    for (int p = 0; p < s->count; p++) {
        char heading[SHEET_TEXT];
        snprintf(heading, sizeof heading, "%s", s->panel[p].heading);
        if (heading[0] >= 'A' && heading[0] <= 'Z') heading[0] = (char)(heading[0] - 'A' + 'a');
        snprintf(s->panel[p].heading, sizeof s->panel[p].heading, "Difference of %.140s", heading);
    }
}

gough_status sheet_fill(sheet *s, const gough_figure *figure, const gough_table *const *tables,
                        const char *const *labels, size_t table_count, const difference *d,
                        gough_error *error) {
    builder b = {.sheet = s, .figure = figure, .tables = tables, .labels = labels};
    b.table_count = table_count, b.error = error;
    b.measured = tables, b.measured_count = table_count;
    if (d != NULL) {
        b.tables = tables = (const gough_table *const *)d->table;
        b.labels = d->label, b.table_count = d->count;
    }
    const char *kind = figure->kind;
    const bool chosen = figure->columns != NULL && !sheet_is_sweep(tables[0]);
    if (kind == NULL) kind = chosen ? "columns" : sheet_default_kind(tables[0]);
    const int k = find_kind(&b, kind);
    if (k < 0 || check_options(&b, kind_names[k]) != GOUGH_OK) return b.status;

    s->columns = 1;
    s->from = figure->from;
    s->to = figure->to;
    s->common_key = builder_compares(&b);
    builder_title(&b);
    if (d != NULL && figure->title == NULL) snprintf(s->title, sizeof s->title, "%.158s", d->title);
    name_abscissa(&b, "t");
    fillers[k](&b);
    if (d != NULL) name_differences(s);
    for (int p = 0; p < s->count; p++) panel_settle_scale(&s->panel[p]);
    if (b.status == GOUGH_OK) sheet_note_covered(s);
    if (b.status == GOUGH_OK && s->count == 0)
        builder_fail(&b, GOUGH_ERROR_INPUT, "nothing to draw");
    return b.status;
}
