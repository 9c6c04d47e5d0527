/* The table of a sweep: a row for each run with its number, the swept values, the state at the end, peaks, and how it ended. Made
 * from the records, a stretch of rows at a time. */
#define _POSIX_C_SOURCE 200809L
#include "sweep/sweep_table.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "table/table.h"

enum {
    STRETCH = 512 /* records */,
    STATE = 12,
    PEAKS = 7,
    ENDS = 3,
    POWERS = 2,
    SIZES = GOUGH_SIZINGS, /* if the sweep has them */
    NUMBER = 32
};

/* Columns after the state. */
static const struct {
    const char *name, *long_name;
    gough_unit unit;
} peak[PEAKS + POWERS + SIZES] = {
    {"position_deviation", "largest deviation of the position from the program", GOUGH_UNIT_LENGTH},
    {"angle_deviation", "largest angle between the platform and the program", GOUGH_UNIT_ANGLE},
    {"force", "largest leg force, pushing or pulling", GOUGH_UNIT_FORCE},
    {"speed", "largest rate of a leg's length", GOUGH_UNIT_SPEED},
    {"power", "largest power that a leg delivers", GOUGH_UNIT_POWER},
    {"energy", "net work of all legs", GOUGH_UNIT_ENERGY},
    {"drift", "largest constraint violation before projection", GOUGH_UNIT_NONE},
    /* in the table behind the end of the run */
    {"power_least", "least power of any leg, below 0 where it brakes", GOUGH_UNIT_POWER},
    {"power_greatest", "greatest power of any leg", GOUGH_UNIT_POWER},
#define GOUGH_SIZING_COLUMN(id, name, what, unit, of_legs) {name, what, GOUGH_UNIT_##unit},
#include "gough/sizing.def"
};

typedef struct table {
    const sweep_part *part;
    size_t parts, rows, keys;
    int columns;
    result_column *column;
    double *factor;
    char flags[400];
    void *records;
    double *value;       /* swept values of a record */
    double *number;      /* numbers of a row */
    double *stretch;     /* all columns of some rows, one after the other */
    size_t first, count; /* which rows */
} table;

/* ---- columns ----------------------------------------------------------------------------------------------------- */

static void add_column(table *t, const char *name, const char *unit, const char *long_name,
                       double factor) {
    t->column[t->columns] = (result_column){.name = name, .unit = unit, .long_name = long_name};
    t->factor[t->columns++] = factor;
}

/* A column in the units of the output. */
static void add_scaled(table *t, const char *name, const char *long_name, gough_unit unit,
                       const result_scale *scale) {
    add_column(t, name, gough_unit_label(&t->part[0].head->units, unit), long_name,
               (double)result_factor(scale, unit));
}

static void list_columns(table *t) {
    const sweep_head *head = t->part[0].head;
    const result_scale scale = result_scale_of(&head->units, head->base_radius, head->gravity);
    add_column(t, "run", "1", "number of the run", 1);
    t->column[0].whole = true;
    for (size_t k = 0; k < t->keys; k++)
        add_column(t, head->path[k], head->label[k], "swept value, as in the study", 1);
    for (int i = 0; i < STATE; i++) {
        const gough_column_info *info = gough_column(GOUGH_X + i);
        add_scaled(t, info->name, info->long_name, gough_unit_of_column(GOUGH_X + i), &scale);
    }
    for (int i = 0; i < PEAKS; i++)
        add_scaled(t, peak[i].name, peak[i].long_name, peak[i].unit, &scale);
    for (int c = 0; c < GOUGH_CAUSES; c++) {
        if (c) strcat(t->flags, " ");
        strcat(t->flags, gough_cause_name((gough_cause)c));
    }
    add_column(t, "end_cause", "1", "how the run ended", 1);
    t->column[t->columns - 1].whole = true;
    t->column[t->columns - 1].flags = t->flags;
    t->column[t->columns - 1].flag_count = GOUGH_CAUSES;
    add_column(t, "end_leg", "1", "leg that caused it, or 0", 1);
    t->column[t->columns - 1].whole = true;
    add_scaled(t, "end_time", "time of the end", GOUGH_UNIT_TIME, &scale);
    for (int i = PEAKS; i < PEAKS + POWERS + (head->sizing ? SIZES : 0); i++)
        add_scaled(t, peak[i].name, peak[i].long_name, peak[i].unit, &scale);
}

/* All numbers of a row in the units of the output. A run that has no row of its own has no state. */
static void take_row(const table *t, const void *record) {
    gough_sweep_row row;
    sweep_record_take(&t->part[0], record, t->value, &row);
    const gough_outcome *o = &row.outcome;
    double *at = t->number;
    *at++ = (double)row.run;
    for (size_t k = 0; k < t->keys; k++) *at++ = t->value[k];
    const double *state[] = {o->position, o->angles, o->velocity, o->angular_velocity};
    const double peaks[PEAKS] = {o->position_deviation,
                                 o->angle_deviation,
                                 o->force,
                                 o->speed,
                                 o->power,
                                 o->energy,
                                 o->drift};
    const bool none = !(o->rows > 0);
    for (int i = 0; i < STATE; i++) *at++ = none ? NAN : state[i / 3][i % 3];
    for (int i = 0; i < PEAKS; i++) *at++ = none ? NAN : peaks[i];
    *at++ = o->cause;
    *at++ = o->leg;
    *at++ = o->time;
    *at++ = none ? NAN : o->power_least;
    *at++ = none ? NAN : o->power_greatest;
    for (int i = 0; i < SIZES && t->part[0].head->sizing; i++) *at++ = none ? NAN : o->sizing[i];
    for (int i = 0; i < t->columns; i++) t->number[i] *= t->factor[i];
}

static gough_status open_table(table *t, const sweep_part *part, size_t parts, gough_error *error) {
    *t = (table){.part = part, .parts = parts, .keys = part[0].head->keys};
    const size_t columns = 1 + t->keys + STATE + PEAKS + ENDS + POWERS + SIZES;
    for (size_t p = 0; p < parts; p++) t->rows += part[p].done;
    t->column = calloc(columns, sizeof *t->column);
    t->factor = calloc(columns, sizeof *t->factor);
    t->number = calloc(columns, sizeof *t->number);
    t->value = calloc(t->keys, sizeof *t->value);
    t->records = malloc(STRETCH * sweep_record_size(part[0].head));
    if (t->column && t->factor && t->number && t->value && t->records) {
        list_columns(t);
        return GOUGH_OK;
    }
    return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
}

static void close_table(table *t) {
    free(t->column);
    free(t->factor);
    free(t->number);
    free(t->value);
    free(t->records);
    free(t->stretch);
}

/* Calls for each record in order; false where one cannot be read or the call says so. */
static bool each_record(const table *t, bool (*call)(void *context, const void *record),
                        void *context) {
    const size_t size = sweep_record_size(t->part[0].head);
    for (size_t p = 0; p < t->parts; p++) {
        for (size_t n = 0; n < t->part[p].done;) {
            const size_t got = sweep_part_get(&t->part[p], n, STRETCH, t->records);
            if (got == 0) return false;
            for (size_t i = 0; i < got; i++)
                if (!call(context, (const char *)t->records + i * size)) return false;
            n += got;
        }
    }
    return true;
}

static gough_status fail_reading(const sweep_part *part, gough_error *error) {
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: its records cannot be read",
                      part->path ? part->path : "a temporary file");
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

typedef struct csv {
    const table *table;
    result_output *output;
    gough_error *error;
    gough_status status;
} csv;

static bool put(csv *c, const char *text, char separator) {
    if (c->status == GOUGH_OK)
        c->status = result_output_add(c->output, text, strlen(text), c->error);
    if (c->status == GOUGH_OK) c->status = result_output_add(c->output, &separator, 1, c->error);
    return c->status == GOUGH_OK;
}

static bool put_row(void *context, const void *record) {
    csv *c = context;
    const table *t = c->table;
    char text[NUMBER];
    take_row(t, record);
    for (int i = 0; i < t->columns; i++) {
        const double number = t->number[i];
        const char separator = i + 1 < t->columns ? ',' : '\n';
        if (t->column[i].flags)
            put(c, gough_cause_name((gough_cause)(int)number), separator);
        else {
            snprintf(text, sizeof text, isnan(number) ? "nan" : "%.17g", number);
            put(c, text, separator);
        }
    }
    return c->status == GOUGH_OK;
}

static gough_status write_csv(const table *t, const char *path, gough_error *error) {
    result_output *output = malloc(sizeof *output);
    const locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    csv c = {t, output, error, GOUGH_OK};
    if (output && plain) {
        const locale_t before = uselocale(plain);
        c.status = result_output_open(output, path, error);
        const bool open = c.status == GOUGH_OK;
        for (int i = 0; i < t->columns && open; i++)
            put(&c, t->column[i].name, i + 1 < t->columns ? ',' : '\n');
        if (open && !each_record(t, put_row, &c) && c.status == GOUGH_OK)
            c.status = fail_reading(t->part, error);
        if (c.status == GOUGH_OK)
            c.status = result_output_finish(output, error);
        else if (open)
            result_output_abandon(output);
        uselocale(before);
    } else {
        c.status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    }
    if (plain) freelocale(plain);
    free(output);
    return c.status;
}

/* ---- HDF5 -------------------------------------------------------------------------------------------------------- */

/* Takes rows first … first + count − 1 into the stretch, column by column. */
static bool read_stretch(table *t, size_t first, size_t count) {
    const size_t size = sweep_record_size(t->part[0].head);
    size_t row = 0, begin = 0; /* begin: the number of rows before part p */
    for (size_t p = 0; p < t->parts && row < count; begin += t->part[p++].done) {
        while (row < count && first + row < begin + t->part[p].done) {
            const size_t left = count - row;
            const size_t got = sweep_part_get(&t->part[p], first + row - begin,
                                              left < STRETCH ? left : STRETCH, t->records);
            if (got == 0) return false;
            for (size_t i = 0; i < got; i++, row++) {
                take_row(t, (const char *)t->records + i * size);
                for (int c = 0; c < t->columns; c++)
                    t->stretch[(size_t)c * count + row] = t->number[c];
            }
        }
    }
    return row == count;
}

static const double *column_values(void *context, int column, size_t first, size_t count) {
    table *t = context;
    if (t->stretch == NULL || t->first != first || t->count != count) {
        free(t->stretch);
        t->stretch = calloc((size_t)t->columns * count + 1, sizeof *t->stretch);
        if (t->stretch == NULL || !read_stretch(t, first, count)) return NULL;
        t->first = first;
        t->count = count;
    }
    return t->stretch + (size_t)column * count;
}

static gough_status write_hdf5(table *t, const char *path, gough_error *error) {
    const sweep_head *head = t->part[0].head;
    const result_attribute attribute[] = {
        {"title", head->title, 0}, {"study", head->study, 0},     {"settings", head->settings, 0},
        {"software", "gough", 0},  {"version", head->version, 0}, {"verb", "sweep", 0}};
    const result_file content = {.column = t->column,
                                 .columns = t->columns,
                                 .rows = t->rows,
                                 .attribute = attribute,
                                 .attributes = sizeof attribute / sizeof attribute[0],
                                 .values = column_values,
                                 .context = t};
    return result_write_hdf5_file(&content, path, error);
}

gough_status sweep_table_write(const sweep_part *part, size_t parts, const char *path,
                               gough_error *error) {
    table t;
    const char *ending = strrchr(path, '.');
    gough_status status = open_table(&t, part, parts, error);
    if (status == GOUGH_OK)
        status = ending && strcasecmp(ending, ".h5") == 0 ? write_hdf5(&t, path, error)
                                                          : write_csv(&t, path, error);
    close_table(&t);
    return status;
}

/* ---- in a few numbers -------------------------------------------------------------------------------------------- */

typedef struct adding {
    const table *table;
    gough_sweep_summary *summary;
} adding;

static void widen(gough_sweep_range *range, double least, double greatest, size_t run) {
    if (least < range->least || (range->least_run == 0 && !isnan(least)))
        range->least = least, range->least_run = run;
    if (greatest > range->greatest || (range->greatest_run == 0 && !isnan(greatest)))
        range->greatest = greatest, range->greatest_run = run;
}

/* Whether a run has gone through its whole motion: forces along a program go on where a limit is exceeded. */
static bool is_whole(const gough_outcome *o, bool forces) {
    if (o->cause == GOUGH_END_DONE) return true;
    return forces && o->rows > 0 && o->cause != GOUGH_END_LEG_NO_LENGTH &&
           o->cause != GOUGH_END_SINGULAR && o->cause != GOUGH_END_NOT_FINITE &&
           o->cause != GOUGH_END_STOPPED && o->cause != GOUGH_END_INVALID;
}

static bool sum_record(void *context, const void *record) {
    const adding *a = context;
    gough_sweep_summary *s = a->summary;
    gough_sweep_row row;
    sweep_record_take(a->table->part, record, a->table->value, &row);
    const gough_outcome *o = &row.outcome;
    s->runs++;
    s->ended[o->cause]++;
    if (o->cause == GOUGH_END_INVALID && s->first_invalid == 0) s->first_invalid = row.run;
    if (o->cause == GOUGH_END_NOT_FINITE && s->first_not_finite == 0) s->first_not_finite = row.run;
    if (!is_whole(o, s->forces)) return true;
    widen(&s->position, o->position_deviation, o->position_deviation, row.run);
    widen(&s->angle, o->angle_deviation, o->angle_deviation, row.run);
    widen(&s->force, o->force, o->force, row.run);
    widen(&s->speed, o->speed, o->speed, row.run);
    widen(&s->power, o->power_least, o->power_greatest, row.run);
    for (int i = 0; i < GOUGH_SIZINGS; i++)
        widen(&s->sizing[i], o->sizing[i], o->sizing[i], row.run);
    return true;
}

gough_status sweep_table_sum(const sweep_part *part, size_t parts, gough_sweep_summary *summary,
                             gough_error *error) {
    table t;
    gough_status status = open_table(&t, part, parts, error);
    const gough_sweep_range nothing = {NAN, NAN, 0, 0};
    *summary = (gough_sweep_summary){.units = part[0].head->units,
                                     .position = nothing,
                                     .angle = nothing,
                                     .force = nothing,
                                     .speed = nothing,
                                     .power = nothing,
                                     .has_sizing = part[0].head->sizing,
                                     .forces = part[0].head->forces};
    for (int i = 0; i < GOUGH_SIZINGS; i++) summary->sizing[i] = nothing;
    adding a = {&t, summary};
    if (status == GOUGH_OK && !each_record(&t, sum_record, &a)) status = fail_reading(part, error);
    close_table(&t);
    return status;
}
