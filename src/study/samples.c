/* Recorded motion from a text file: its layout is found, its columns are chosen, then its rows are read one by one into the
 * motion's memory: cells as they stand, which are converted when the steps of their columns are known. */
#include "study/samples.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gough/text.h"
#include "study/record.h"
#include "study/record_guesses.h"
#include "study/record_rotation.h"
#include "study/source.h"
#include "study/value.h"

enum {
    MOST_ROWS = 2000000,
    MOST_ERRORS = 20, /* of one file: a wrong column is wrong in every row */
    NUMBERS = 1 + GOUGH_COMPONENTS,
    CELL_BYTES = 64
};

static const size_t most_bytes = (size_t)1 << 30; /* of a file */

typedef struct table {
    study_messages *messages;
    study_lines *lines;
    study_layout layout;
    study_columns columns;
    int *channel_at; /* of each column of the file: the first channel that it fills, or -1 */
    int next[STUDY_CHANNELS]; /* another channel that the same column fills */
    gough_order order, file_order;
    bool from_first_time, from_first;
    double time_step;
    size_t rows, most; /* that were read, and that there is room for */
    double *time,
        *value;   /* cells as they stand; rotations that are no angles are turned into these */
    double pitch; /* greatest |pitch| of such rotations */
    study_digits digits[STUDY_CHANNELS];
    size_t errors;
} table;

static size_t length_of(gough_piece p) { return (size_t)(p.end - p.begin); }

static void say_at(table *csv, study_place place, const char *sentence) {
    study_say(csv->messages, GOUGH_ERROR_INPUT, place, "%s", sentence);
    csv->errors++;
}

static void say(table *csv, const char *at, const char *sentence) {
    say_at(csv, study_lines_place(csv->lines, at), sentence);
}

/* ---- rows ---- */

static void say_cell(table *csv, gough_piece there, study_decimal kind) {
    const char *quote = study_quote(csv->messages->arena, there.begin, length_of(there));
    const study_place place = study_lines_place(csv->lines, there.begin);
    csv->errors++;
    if (there.begin == there.end)
        study_say(csv->messages, GOUGH_ERROR_INPUT, place, "an empty cell; a number was expected");
    else if (kind == STUDY_NOT_FINITE)
        study_say(csv->messages, GOUGH_ERROR_INPUT, place, "`%s` is not finite", quote);
    else
        study_say(csv->messages, GOUGH_ERROR_INPUT, place, "`%s` is not a number", quote);
}

/* A time that does not increase; where it is the one of the row before, the times may have too few decimals. */
static void say_time(table *csv, const char *at) {
    const double now = csv->time[csv->rows], before = csv->time[csv->rows - 1];
    const int decimals = -csv->digits[STUDY_TIME].place;
    char advice[100] = "";
    if (!(now < before) && decimals > 0 && decimals < 9)
        snprintf(advice, sizeof advice,
                 "; if the times are rounded to %d decimal%s, record more digits", decimals,
                 decimals == 1 ? "" : "s");
    study_say(csv->messages, GOUGH_ERROR_INPUT, study_lines_place(csv->lines, at),
              "the time %.*g must be greater than %.*g in the row before%s",
              fabs(now) < 1e9 ? 9 : 17, now, fabs(now) < 1e9 ? 9 : 17, before, advice);
    csv->errors++;
}

/* The numbers of a row that are read, by channel; false where one is wrong. */
static bool read_cells(table *csv, gough_piece line, double *number, const char **time_at) {
    const size_t before = csv->errors;
    const study_layout *layout = &csv->layout;
    size_t count = 0;
    gough_piece there;
    char text[CELL_BYTES];
    while (csv->errors < MOST_ERRORS && gough_csv_cell_by(&line, layout->separator, &there)) {
        if (count == layout->columns) {
            /* a separator at the end of each row makes no column */
            if (there.begin == there.end && !line.begin) break;
            study_say(csv->messages, GOUGH_ERROR_INPUT, study_lines_place(csv->lines, there.begin),
                      "this row has more cells than the %zu columns of the first row",
                      layout->columns);
            csv->errors++;
            return false;
        }
        int channel = csv->channel_at[count++];
        if (channel < 0) continue;
        double value;
        const int kind = study_layout_number(layout, there, &value, text);
        if (kind != STUDY_DECIMAL) say_cell(csv, there, (study_decimal)kind);
        for (; kind == STUDY_DECIMAL && channel >= 0; channel = csv->next[channel]) {
            study_digits_take(&csv->digits[channel], text, strlen(text));
            number[channel] = value;
            if (channel == STUDY_TIME) *time_at = there.begin;
        }
    }
    if (csv->errors == before && count < layout->columns) {
        study_say(csv->messages, GOUGH_ERROR_INPUT,
                  study_lines_place(csv->lines, csv->lines->line.end),
                  "this row ends after %zu of %zu cells", count, layout->columns);
        csv->errors++;
    }
    return csv->errors == before;
}

/* Puts the rotation of a row that is no three angles; its cells have no units, but may have scales and offsets. */
static bool put_rotation(table *csv, double *number, double *angle) {
    const unsigned by = csv->columns.rotation;
    for (int q = STUDY_QUATERNION; q < STUDY_QUANTITIES; q++)
        number[q] = study_channel_convert(&csv->columns.channel[q], number[q]);
    const bool good = by == STUDY_BY_QUATERNION
                          ? study_quaternion_angles(number + STUDY_QUATERNION, csv->order, angle)
                          : study_matrix_angles(number + STUDY_MATRIX, csv->order, angle);
    if (!good)
        say(csv, csv->lines->line.begin,
            by == STUDY_BY_QUATERNION ? "the quaternion of this row is 0, which is no rotation"
                                      : "the matrix of this row is no rotation: its columns must "
                                        "be unit vectors at right "
                                        "angles, right-handed");
    csv->pitch = fmax(csv->pitch, good ? fabs(angle[1]) : 0);
    return good;
}

/* Reads one row into its place; one with a wrong cell does not count. */
static void read_row(table *csv, gough_piece line) {
    double *value = csv->value + csv->rows * GOUGH_COMPONENTS, number[STUDY_CHANNELS] = {0};
    const char *time_at = line.begin;
    if (csv->rows == csv->most) {
        say(csv, line.begin, "the file has grown while it was read");
        csv->lines->broken = true;
        return;
    }
    if (!read_cells(csv, line, number, &time_at)) return;
    if (csv->columns.rotation != STUDY_ANGLES && !put_rotation(csv, number, value + GOUGH_ROLL))
        return;
    for (int c = 0; c < (csv->columns.rotation == STUDY_ANGLES ? GOUGH_COMPONENTS : 3); c++)
        value[c] = number[c];
    csv->time[csv->rows] =
        csv->time_step > 0 ? csv->time_step * (double)csv->rows : number[STUDY_TIME];
    if (csv->rows > 0 && !(csv->time[csv->rows] > csv->time[csv->rows - 1]))
        say_time(csv, time_at);
    else if (csv->rows == 0 && csv->time[0] > 0 && !csv->from_first_time)
        say(csv, time_at,
            "the record must begin at time 0 or before, because a run begins at 0; with `from: "
            "first` in `motion.samples.time` times count from the first row");
    csv->rows++;
}

static void read_rows(table *csv) {
    study_lines *lines = csv->lines;
    while (csv->errors < MOST_ERRORS && study_lines_next(lines)) {
        const gough_piece line = lines->line;
        if (lines->number < csv->layout.first || study_layout_leaves_out(&csv->layout, line))
            continue;
        if (line.begin == line.end) {
            const study_place place = study_lines_place(lines, line.begin);
            bool more = false;
            while (!more && study_lines_next(lines)) more = lines->line.begin < lines->line.end;
            if (!more) break;
            say_at(csv, place, "an empty line between the rows");
            if (csv->errors < MOST_ERRORS) read_row(csv, lines->line);
            continue;
        }
        read_row(csv, line);
    }
    if (csv->errors >= MOST_ERRORS)
        say_at(csv, study_lines_last_place(lines),
               "too many errors; the rest of the file was not read");
    else if (!csv->errors && !lines->broken && csv->rows < 2)
        say_at(csv, study_lines_last_place(lines), "at least two rows of numbers are needed");
}

/* ---- from cells to the study's units ---- */

/* The step of cells as that of the numbers made of them. */
static study_quantum scaled(study_quantum step, const study_channel *channel) {
    if (channel->direct) return step;
    const double factor = fabs(channel->scale * channel->times / channel->over);
    return (study_quantum){step.greatest * factor, step.mean * factor};
}

static void convert_columns(const table *csv, study_record_table *made) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const study_channel *channel = &csv->columns.channel[c];
        made->given[c] = channel->used;
        if (!channel->used) continue;
        made->step[c] = scaled(study_quantum_find(&csv->digits[c], csv->value + c, GOUGH_COMPONENTS,
                                                  csv->rows, made->work),
                               channel);
        for (size_t i = 0; i < csv->rows && !channel->direct; i++) {
            double *cell = csv->value + i * GOUGH_COMPONENTS + (size_t)c;
            *cell = study_channel_convert(channel, *cell);
        }
    }
}

/* The times, and how they were written. */
static void convert_times(const table *csv, study_record_table *made) {
    const study_channel *channel = &csv->columns.channel[STUDY_TIME];
    double *time = csv->time;
    if (csv->time_step > 0) {
        made->clock = (study_clock){.interval = csv->time_step, .even = true};
        return;
    }
    made->clock = study_clock_find(&csv->digits[STUDY_TIME], time, csv->rows, made->work);
    const double zero = csv->from_first_time ? time[0] : 0;
    for (size_t i = 0; i < csv->rows; i++) time[i] -= zero;
    if (channel->direct) return;
    for (size_t i = 0; i < csv->rows; i++) time[i] = study_channel_convert(channel, time[i]);
    made->clock.interval *= channel->times / channel->over;
    made->clock.step *= channel->times / channel->over;
}

/* Angles of quaternions, matrices or another order, and poses from the first row on; all in degrees while they are worked on. */
static void convert_rotations(const table *csv, const study_recording *recording,
                              study_record_table *made) {
    const double degrees = study_record_degrees(recording);
    const unsigned by = csv->columns.rotation;
    const bool angles = by == STUDY_ANGLES, reorder = angles && csv->file_order != csv->order;
    study_quantum step = {0, 0};
    for (int q = STUDY_QUATERNION; q < STUDY_QUANTITIES; q++) {
        if (angles || !csv->digits[q].any || csv->digits[q].digits >= 15) continue;
        step.greatest = fmax(step.greatest,
                             fabs(csv->columns.channel[q].scale) * pow(10, csv->digits[q].place));
        step.mean = step.greatest;
    }
    if (angles && !reorder && !csv->from_first) return;
    for (size_t i = 0; i < csv->rows && angles; i++)
        for (int a = GOUGH_ROLL; a < GOUGH_COMPONENTS; a++)
            csv->value[i * GOUGH_COMPONENTS + (size_t)a] *= degrees;
    for (int a = GOUGH_ROLL; a < GOUGH_COMPONENTS; a++) {
        if (!angles)
            made->step[a] = by == STUDY_BY_QUATERNION ? study_quaternion_step(step, csv->pitch)
                                                      : study_matrix_step(step, csv->pitch);
        made->step[a].greatest *= angles ? degrees : 1;
        made->step[a].mean *= angles ? degrees : 1;
        made->given[a] |= !angles;
    }
    if (reorder)
        study_angles_reorder(csv->rows, csv->value + GOUGH_ROLL, GOUGH_COMPONENTS, csv->file_order,
                             csv->order);
    if (csv->from_first) study_poses_from_first(csv->rows, csv->value, csv->order, made->step);
    for (int a = GOUGH_ROLL; a < GOUGH_COMPONENTS; a++) {
        for (size_t i = 0; i < csv->rows; i++)
            csv->value[i * GOUGH_COMPONENTS + (size_t)a] /= degrees;
        made->step[a].greatest /= degrees;
        made->step[a].mean /= degrees;
    }
}

/* From the study's units, but angles in degrees, to units of the run. */
static void convert(const table *csv, const gough_units *units) {
    const gough_units degrees = gough_units_si();
    for (size_t i = 0; i < csv->rows; i++) {
        double *value = csv->value + i * GOUGH_COMPONENTS;
        csv->time[i] = gough_unit_read(units, GOUGH_UNIT_TIME, csv->time[i]);
        for (int c = 0; c < GOUGH_ROLL; c++)
            value[c] = gough_unit_read(units, GOUGH_UNIT_LENGTH, value[c]);
        for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++)
            value[c] = gough_unit_read(&degrees, GOUGH_UNIT_ANGLE, value[c]);
    }
}

/* Whether all numbers are finite after conversion; an error at the file if one is not. */
static bool are_finite(table *csv) {
    for (size_t i = 0; i < csv->rows * GOUGH_COMPONENTS; i++) {
        if (isfinite(csv->value[i])) continue;
        study_say(csv->messages, GOUGH_ERROR_INPUT, csv->layout.place,
                  "row %zu: %s is not finite in the units of the study", i / GOUGH_COMPONENTS + 1,
                  gough_component_name((int)(i % GOUGH_COMPONENTS)));
        csv->errors++;
        return false;
    }
    return true;
}

static gough_status prepare(table *csv, study_recording *recording, double *work,
                            gough_error *error) {
    study_record_table made = {
        .count = csv->rows, .time = csv->time, .value = csv->value, .work = work};
    convert_columns(csv, &made);
    convert_times(csv, &made);
    convert_rotations(csv, recording, &made);
    if (!are_finite(csv)) return GOUGH_OK;
    const gough_status status = study_record_make(&made, recording, error);
    if (status != GOUGH_OK) return status;
    convert(csv, &recording->units);
    *recording->samples =
        (gough_samples){.count = csv->rows,
                        .time = csv->time,
                        .value = csv->value,
                        .curvature = work,
                        .axes = {recording->samples->axes[0], recording->samples->axes[1],
                                 recording->samples->axes[2], recording->samples->axes[3]}};
    return gough_samples_prepare(recording->samples, work + GOUGH_COMPONENTS * csv->rows, error);
}

/* ---- the file ---- */

/* The numbers of the first row, NaN for cells that hold no number. */
static double *first_numbers(table *csv, const study_lines *lines) {
    const study_layout *layout = &csv->layout;
    double *first = study_arena_take(csv->messages->arena, layout->columns * sizeof *first);
    gough_piece line = lines->line, cell;
    size_t i = 0;
    for (size_t k = 0; first && k < layout->columns; k++) first[k] = NAN;
    while (first && i < layout->columns && gough_csv_cell_by(&line, layout->separator, &cell))
        if (study_layout_number(layout, cell, &first[i++], NULL) != STUDY_DECIMAL)
            first[i - 1] = NAN;
    return first;
}

/* Which channels each column fills. */
static bool link_channels(table *csv) {
    const size_t columns = csv->layout.columns;
    csv->channel_at = study_arena_take(csv->messages->arena, columns * sizeof *csv->channel_at);
    if (!csv->channel_at) return false;
    for (size_t i = 0; i < columns; i++) csv->channel_at[i] = -1;
    for (int q = 0; q < STUDY_CHANNELS; q++) {
        const study_channel *channel = &csv->columns.channel[q];
        if (!channel->used) continue;
        csv->next[q] = csv->channel_at[channel->column];
        csv->channel_at[channel->column] = q;
    }
    return true;
}

/* Layout and columns, from the first lines; false where an error was said. */
static bool begin(table *csv, const study_recording *recording) {
    study_lines *lines = csv->lines;
    const study_record_keys *keys = &recording->keys;
    if (!study_layout_find(lines, keys, &csv->layout)) return false;
    csv->order = recording->order;
    csv->file_order = keys->order;
    csv->from_first_time = keys->from_first_time;
    csv->from_first = keys->from_first;
    csv->time_step = keys->time_step;
    study_lines_again(lines);
    bool row = false;
    while (!row && study_lines_next(lines))
        row = csv->layout.any && lines->number >= csv->layout.first &&
              lines->line.begin < lines->line.end &&
              !study_layout_leaves_out(&csv->layout, lines->line);
    const double *first = row ? first_numbers(csv, lines) : NULL;
    return study_columns_choose(csv->messages, &csv->layout, keys, &recording->units,
                                recording->file, first, &csv->columns) &&
           link_channels(csv);
}

/* One block: times, values, and what the making needs besides. */
static void read_all(table *csv, study_recording *recording, size_t most) {
    gough_error error = {.message = ""};
    double *all = malloc((most * NUMBERS + study_record_work(most)) * sizeof *all);
    if (!all) {
        csv->messages->arena->exhausted = true;
        return;
    }
    csv->time = all;
    csv->value = all + most;
    csv->most = most;
    study_lines_again(csv->lines);
    read_rows(csv);
    if (csv->errors || csv->lines->broken) {
        free(all);
        return;
    }
    const gough_status status = prepare(csv, recording, all + most * NUMBERS, &error);
    if (status != GOUGH_OK)
        say_at(csv, csv->layout.place, study_printable(csv->messages->arena, error.message));
    if (csv->errors)
        free(all);
    else
        recording->memory = all;
}

/* The text of the lines, which are ended. */
static void read_lines(study_messages *messages, study_lines *lines, study_recording *recording) {
    table csv = {.messages = messages, .lines = lines};
    recording->memory = NULL;
    *recording->record = (gough_record){.remarks = 0};
    if (!lines->broken && begin(&csv, recording)) {
        study_lines_again(lines);
        const size_t count = study_lines_count(lines);
        if (count > MOST_ROWS + csv.layout.first + 1)
            say_at(&csv, csv.layout.place, "more than 2 000 000 rows");
        else if (!lines->broken)
            study_guesses_say(recording, &csv.layout, &csv.columns);
        if (!csv.errors && !lines->broken) read_all(&csv, recording, count);
    }
    study_lines_end(lines);
    if (!recording->memory) *recording->samples = (gough_samples){.count = 0};
}

void study_samples_parse(study_messages *messages, const study_source *source,
                         study_recording *recording) {
    study_lines lines = study_lines_of_text(messages, source->name, source->text, source->length);
    read_lines(messages, &lines, recording);
}

void study_samples_read(study_messages *messages, study_place place, const char *path,
                        study_recording *recording) {
    recording->memory = NULL;
    const int file = study_record_open(messages, place, path, most_bytes);
    if (file < 0) return;
    study_lines lines = study_lines_of_file(messages, study_printable(messages->arena, path), file);
    read_lines(messages, &lines, recording);
    close(file);
}
