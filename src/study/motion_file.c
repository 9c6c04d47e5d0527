/* What a file of recorded motion is: its columns, times, steps and ranges, and a mapping that reads it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gough/study.h"
#include "study/quantum.h"
#include "study/record_mapping.h"
#include "study/source.h"
#include "study/value.h"

enum { MOST_ROWS = 2000000, CELL_BYTES = 64 };

static const size_t most_bytes = (size_t)1 << 30;

typedef struct describer {
    study_messages *messages;
    study_lines lines;
    study_layout layout;
    study_record_keys keys;
    gough_motion_file *file;
    gough_motion_column *column;
    size_t rows;    /* room for so many */
    double **value; /* of each column; NaN where a cell is no number */
    study_digits *digits;
    double *scratch;
} describer;

/* ---- reading ---- */

static void read_row(describer *d, size_t row) {
    gough_piece line = d->lines.line, cell;
    char text[CELL_BYTES];
    size_t i = 0;
    for (; i < d->layout.columns; i++) {
        double value = NAN;
        const bool there = gough_csv_cell_by(&line, d->layout.separator, &cell);
        if (there && study_layout_number(&d->layout, cell, &value, text) == STUDY_DECIMAL)
            study_digits_take(&d->digits[i], text, strlen(text));
        else
            value = NAN;
        d->value[i][row] = value;
    }
}

static bool is_row(const describer *d) {
    const gough_piece line = d->lines.line;
    return d->layout.any && d->lines.number >= d->layout.first && line.begin < line.end &&
           !study_layout_leaves_out(&d->layout, line);
}

static void read_rows(describer *d) {
    study_lines_again(&d->lines);
    while (study_lines_next(&d->lines) && d->file->rows < d->rows)
        if (is_row(d)) read_row(d, d->file->rows++);
}

static bool take_memory(describer *d) {
    const size_t columns = d->layout.columns;
    study_arena *arena = d->messages->arena;
    d->value = study_arena_take(arena, columns * sizeof *d->value);
    d->digits = study_arena_take(arena, columns * sizeof *d->digits);
    d->column = study_arena_take(arena, columns * sizeof *d->column);
    d->scratch = malloc(2 * (d->rows + 1) * sizeof *d->scratch);
    bool full = !d->scratch;
    for (size_t i = 0; !arena->exhausted && i < columns; i++) {
        d->value[i] = malloc((d->rows + 1) * sizeof **d->value);
        full |= !d->value[i];
    }
    if (full) arena->exhausted = true;
    return !arena->exhausted;
}

/* ---- columns ---- */

/* The numbers of a column, without cells that hold no number, and what is found in them. */
static void describe_column(const describer *d, size_t i, gough_motion_column *column) {
    double *number = d->scratch + d->rows + 1;
    size_t count = 0, before = 0;
    column->least = column->greatest = column->step = column->jump = NAN;
    for (size_t row = 0; row < d->file->rows; row++) {
        const double value = d->value[i][row];
        if (isnan(value)) continue;
        if (count > 0 && row == before + 1) {
            const double jump = fabs(value - number[count - 1]);
            if (!(jump <= column->jump)) column->jump = jump, column->jump_row = row + 1;
        }
        column->least = fmin(column->least, value);
        column->greatest = fmax(column->greatest, value);
        number[count++] = value;
        before = row;
    }
    if (!(column->jump > 0)) column->jump_row = 0;
    column->numbers = count;
    if (count > 0)
        column->step = study_quantum_find(&d->digits[i], number, 1, count, d->scratch).greatest;
}

/* The times, if they increase; and the acceleration that rounding makes between equal rows, 12 e/h² of errors e = step/2. */
static void describe_times(const describer *d) {
    gough_motion_file *file = d->file;
    const size_t at = file->time;
    file->interval = NAN;
    bool good = at > 0 && file->rows > 1;
    const double *time = good ? d->value[at - 1] : NULL;
    for (size_t row = 0; good && row < file->rows; row++)
        good = isfinite(time[row]) && (row == 0 || time[row] > time[row - 1]);
    if (!good) return;
    const study_clock clock = study_clock_find(&d->digits[at - 1], time, file->rows, d->scratch);
    file->interval = clock.interval;
    file->time_step = clock.step;
    file->even = clock.even;
    for (size_t i = 0; i < file->columns; i++)
        if (i + 1 != at)
            d->column[i].acceleration = 6 * d->column[i].step / clock.interval / clock.interval;
}

/* Whether a bare name reads the file: every column is certain, and there are times and motion. */
static bool is_certain(const describer *d, const double *first) {
    study_arena arena = {NULL, false};
    study_messages said = {.arena = &arena};
    const gough_units units = gough_units_si();
    study_columns columns;
    const bool chosen =
        study_columns_choose(&said, &d->layout, &d->keys, &units, "", first, &columns);
    study_arena_free(&arena);
    d->messages->arena->exhausted |= arena.exhausted;
    return chosen && !(d->file->time && first[d->file->time - 1] > 0);
}

static void describe(describer *d, const char *path) {
    const study_layout *l = &d->layout;
    gough_motion_file *file = d->file;
    study_arena *arena = d->messages->arena;
    int *quantity = study_arena_take(arena, l->columns * sizeof *quantity);
    double *first = study_arena_take(arena, l->columns * sizeof *first);
    if (arena->exhausted) return;
    for (size_t i = 0; i < l->columns; i++) first[i] = file->rows ? d->value[i][0] : NAN;
    study_mapping_guess(l, &d->keys, first, quantity);
    for (size_t i = 0; i < l->columns; i++) {
        gough_motion_column *column = &d->column[i];
        const int q = quantity[i];
        column->name = l->named ? l->name[i] : "";
        column->unit = l->named ? l->unit[i] : "";
        column->quantity = q < 0 ? "" : study_quantity_name(q);
        column->certain = q >= 0 && l->named && study_name_quantity(l->name[i]) == q;
        column->acceleration = NAN;
        describe_column(d, i, column);
        if (q == STUDY_TIME) file->time = i + 1;
    }
    describe_times(d);
    file->column = d->column;
    file->certain = is_certain(d, first);
    file->mapping = study_columns_mapping(arena, l, &d->keys, path, first);
}

/* ---- the file ---- */

/* Everything in the arena that the description keeps. */
static void read_file(describer *d, const char *path) {
    d->keys = study_record_keys_none(NULL, GOUGH_ZYX);
    if (!study_layout_find(&d->lines, &d->keys, &d->layout)) return;
    d->file->columns = d->layout.columns;
    d->file->separator = d->layout.separator;
    d->file->decimal = d->layout.decimal;
    d->file->named = d->layout.named;
    d->file->first = d->layout.first;
    study_lines_again(&d->lines);
    d->rows = study_lines_count(&d->lines);
    if (d->lines.broken) return;
    if (d->rows > MOST_ROWS + d->layout.first + 1) {
        study_say(d->messages, GOUGH_ERROR_INPUT, d->layout.place, "more than 2 000 000 rows");
        return;
    }
    if (take_memory(d)) {
        read_rows(d);
        describe(d, path);
    }
    for (size_t i = 0; d->value && i < d->layout.columns; i++) free(d->value[i]);
    free(d->scratch);
}

typedef struct description {
    gough_motion_file file;
    study_arena arena;
} description;

gough_status gough_motion_file_read(const char *path, gough_motion_file **file, char **messages) {
    description *made = calloc(1, sizeof *made);
    study_arena own = {NULL, !made}, *arena = made ? &made->arena : &own;
    study_messages said = {.arena = arena};
    const study_source about = {.name = path};
    const int descriptor =
        made ? study_record_open(&said, (study_place){&about, 0}, path, most_bytes) : -1;
    if (descriptor >= 0) {
        describer d = {.messages = &said, .file = &made->file};
        d.lines = study_lines_of_file(&said, study_printable(arena, path), descriptor);
        if (!d.lines.broken) read_file(&d, path);
        study_lines_end(&d.lines);
        close(descriptor);
    }
    const gough_status status = study_messages_end(&said, messages);
    if (status == GOUGH_OK) {
        made->file.memory_ = made;
        *file = &made->file;
    } else if (made) {
        study_arena_free(&made->arena);
        free(made);
    }
    return status;
}

void gough_motion_file_free(gough_motion_file *file) {
    if (!file) return;
    description *made = file->memory_;
    study_arena_free(&made->arena);
    free(made);
}
