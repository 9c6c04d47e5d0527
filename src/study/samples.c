/* Recorded motion from a CSV file: a header with t and any of surge, sway, heave, roll, pitch, yaw, then rows of numbers in
 * increasing time. Comma-separated, lines ending in LF or CR LF, a UTF-8 byte-order mark accepted; numbers in the study's
 * units. */
#include "study/samples.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/text.h"
#include "study/record.h"
#include "study/source.h"
#include "study/value.h"

enum {
    MOST_BYTES = 64 * 1024 * 1024,
    MOST_ROWS = 2000000,
    MOST_ERRORS = 20, /* of one file: a wrong column is wrong in every row */
    COLUMNS = GOUGH_COMPONENTS + 1,
    TIME = GOUGH_COMPONENTS /* the column t, after the components */
};

typedef struct table {
    study_messages *messages;
    const study_source *source;
    gough_piece rest;    /* of the text */
    int column[COLUMNS]; /* what the cells of a row are, in order */
    size_t columns;
    size_t rows;
    double *time, *value; /* in the study's units */
    study_digits digits[COLUMNS];
    size_t errors;
} table;

static size_t length_of(gough_piece p) { return (size_t)(p.end - p.begin); }

static study_place place_of(const table *csv, const char *at) {
    return (study_place){csv->source, (size_t)(at - csv->source->text)};
}

static void say(table *csv, const char *at, const char *sentence) {
    study_say(csv->messages, GOUGH_ERROR_INPUT, place_of(csv, at), "%s", sentence);
    csv->errors++;
}

static const char *column_name(int column) {
    return column == TIME ? "t" : gough_component_name(column);
}

static int column_of(const char *name) {
    for (int c = 0; c < COLUMNS; c++)
        if (strcmp(name, column_name(c)) == 0) return c;
    return -1;
}

/* Whether the text is what a table looks like that has no header, or other separators; said for the whole row. */
static bool say_no_header(table *csv, gough_piece line) {
    size_t rest;
    double value;
    gough_piece head, left = line;
    (void)gough_csv_cell(&left, &head);
    if (line.begin == line.end) {
        say(csv, line.begin, "the first row must name the columns, as in t,heave");
    } else if (study_decimal_read(head.begin, length_of(head), &value, &rest) == STUDY_DECIMAL) {
        study_say(csv->messages, GOUGH_ERROR_INPUT, place_of(csv, head.begin),
                  "the first row must name the columns, as in t,heave; found the number %s",
                  study_quote(csv->messages->arena, head.begin, length_of(head)));
        csv->errors++;
    } else if (memchr(line.begin, ';', length_of(line))) {
        say(csv, line.begin, "columns are separated by commas, not by semicolons");
    }
    return csv->errors > 0;
}

/* What the cell of the header names; -1, with what is wrong said, where it names nothing. */
static int header_cell(table *csv, gough_piece head) {
    study_arena *arena = csv->messages->arena;
    const char *place_at = head.begin;
    if (length_of(head) >= 2 && *head.begin == '"' && head.end[-1] == '"')
        head = (gough_piece){head.begin + 1, head.end - 1};
    const char *name = study_quote(arena, head.begin, length_of(head));
    const char *names[COLUMNS];
    for (int c = 0; c < COLUMNS; c++) names[c] = column_name(c);
    const int column = column_of(name);
    const char *nearest = study_nearest(name, names, COLUMNS);
    const study_place place = place_of(csv, place_at);
    for (size_t i = 0; column >= 0 && i < csv->columns; i++) {
        if (csv->column[i] != column) continue;
        say(csv, place_at, "this column appears twice");
        return -1;
    }
    if (column >= 0) return column;
    csv->errors++;
    if (head.begin == head.end)
        study_say(csv->messages, GOUGH_ERROR_INPUT, place, "a column has no name");
    else if (nearest)
        study_say(csv->messages, GOUGH_ERROR_INPUT, place,
                  "unknown column `%s`; did you mean `%s`?", name, nearest);
    else
        study_say(csv->messages, GOUGH_ERROR_INPUT, place,
                  "unknown column `%s`; the columns are t, surge, sway, heave, roll, pitch and yaw",
                  name);
    return -1;
}

/* All columns that are wrong are named. */
static bool read_header(table *csv) {
    gough_piece line = csv->rest, head;
    bool has_time = false;
    (void)gough_csv_line(&csv->rest, &line);
    const char *begin = line.begin;
    if (say_no_header(csv, line)) return false;
    while (csv->errors < MOST_ERRORS && gough_csv_cell(&line, &head)) {
        const int column = header_cell(csv, head);
        has_time |= column == TIME;
        if (column >= 0) csv->column[csv->columns++] = column;
    }
    if (csv->errors) return false;
    if (!has_time) say(csv, begin, "the column t, the time, is missing");
    if (!csv->errors && csv->columns < 2)
        say(csv, begin, "there is no motion: a column such as heave is needed besides t");
    return csv->errors == 0;
}

static void say_cell(table *csv, gough_piece there, study_decimal kind) {
    const char *quote = study_quote(csv->messages->arena, there.begin, length_of(there));
    const study_place place = place_of(csv, there.begin);
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
    const int decimals = -csv->digits[TIME].place;
    char advice[100] = "";
    if (!(now < before) && decimals > 0 && decimals < 9)
        snprintf(advice, sizeof advice,
                 "; if the times are rounded to %d decimal%s, record more digits", decimals,
                 decimals == 1 ? "" : "s");
    study_say(csv->messages, GOUGH_ERROR_INPUT, place_of(csv, at),
              "the time %.9g must be greater than %.9g in the row before%s", now, before, advice);
    csv->errors++;
}

/* Reads one row into its place; one with a wrong cell does not count. */
static void read_row(table *csv, gough_piece line) {
    double *value = csv->value + csv->rows * GOUGH_COMPONENTS;
    const size_t before = csv->errors;
    const char *time_at = line.begin;
    size_t count = 0;
    gough_piece there;
    while (csv->errors < MOST_ERRORS && gough_csv_cell(&line, &there)) {
        if (count == csv->columns) {
            study_say(csv->messages, GOUGH_ERROR_INPUT, place_of(csv, there.begin),
                      "this row has more cells than the %zu columns of the first row",
                      csv->columns);
            csv->errors++;
            return;
        }
        double number;
        size_t rest;
        const study_decimal kind =
            study_decimal_read(there.begin, length_of(there), &number, &rest);
        const int column = csv->column[count++];
        if (kind == STUDY_DECIMAL)
            study_digits_take(&csv->digits[column], there.begin, length_of(there));
        if (kind != STUDY_DECIMAL)
            say_cell(csv, there, kind);
        else if (column == TIME)
            csv->time[csv->rows] = number, time_at = there.begin;
        else
            value[column] = number;
    }
    if (csv->errors > before) return;
    if (count < csv->columns) {
        study_say(csv->messages, GOUGH_ERROR_INPUT, place_of(csv, line.end),
                  "this row ends after %zu of %zu cells", count, csv->columns);
        csv->errors++;
    } else if (csv->rows > 0 && !(csv->time[csv->rows] > csv->time[csv->rows - 1])) {
        say_time(csv, time_at);
    } else if (csv->rows == 0 && csv->time[0] > 0) {
        say(csv, time_at, "the record must begin at time 0 or before, because a run begins at 0");
    }
    csv->rows++;
}

static void read_rows(table *csv) {
    gough_piece line;
    while (csv->errors < MOST_ERRORS && gough_csv_line(&csv->rest, &line)) {
        if (line.begin == line.end && gough_csv_ended(csv->rest)) break;
        if (line.begin == line.end)
            say(csv, line.begin, "an empty line between the rows");
        else
            read_row(csv, line);
    }
    if (csv->errors >= MOST_ERRORS)
        say(csv, csv->rest.begin, "too many errors; the rest of the file was not read");
    else if (!csv->errors && csv->rows < 2)
        say(csv, csv->rest.end, "at least two rows of numbers are needed");
}

static size_t count_lines(const study_source *source) {
    size_t count = 1;
    const char *at = source->text, *end = source->text + source->length;
    while ((at = memchr(at, '\n', (size_t)(end - at)))) {
        count++;
        at++;
    }
    return count;
}

/* Time, values and curvature in one piece, so that the caller frees one pointer. */
static double *lay_out(table *csv, size_t rows) {
    double *all = calloc(rows * (1 + 2 * GOUGH_COMPONENTS), sizeof *all);
    if (!all) {
        csv->messages->arena->exhausted = true;
        return NULL;
    }
    csv->time = all;
    csv->value = all + rows;
    return all;
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

/* Smoothed as asked for, in units of the run, with its spline. */
static gough_status finish(const table *csv, study_recording *recording, double *scratch,
                           gough_error *error) {
    gough_samples *samples = recording->samples;
    study_record_table made = {.count = csv->rows,
                               .time = csv->time,
                               .value = csv->value,
                               .curvature = samples->curvature,
                               .scratch = scratch,
                               .clock = csv->digits[TIME]};
    memcpy(made.digits, csv->digits, sizeof made.digits);
    const gough_status status = study_record_make(&made, recording, error);
    if (status != GOUGH_OK) return status;
    convert(csv, &recording->units);
    return gough_samples_prepare(samples, scratch, error);
}

static bool prepare(table *csv, study_recording *recording) {
    gough_error error = {.message = ""};
    const size_t size = study_record_scratch(csv->rows) + gough_samples_scratch(csv->rows);
    double *scratch = malloc(size * sizeof *scratch);
    if (!scratch) {
        csv->messages->arena->exhausted = true;
        return false;
    }
    const gough_status status = finish(csv, recording, scratch, &error);
    free(scratch);
    if (status != GOUGH_OK)
        say(csv, csv->source->text, study_printable(csv->messages->arena, error.message));
    return status == GOUGH_OK;
}

void study_samples_parse(study_messages *messages, const study_source *source,
                         study_recording *recording) {
    table csv = {.messages = messages,
                 .source = source,
                 .rest = {source->text, source->text + source->length}};
    recording->memory = NULL;
    *recording->record = (gough_record){.remarks = 0};
    if (source->length >= 3 && memcmp(source->text, "\xEF\xBB\xBF", 3) == 0) csv.rest.begin += 3;
    if (!read_header(&csv)) return;
    const size_t lines = count_lines(source);
    if (lines > MOST_ROWS + 2) {
        say(&csv, source->text, "more than 2 000 000 rows");
        return;
    }
    double *all = lay_out(&csv, lines);
    if (!all) return;
    read_rows(&csv);
    *recording->samples = (gough_samples){.count = csv.rows,
                                          .time = csv.time,
                                          .value = csv.value,
                                          .curvature = csv.value + lines * GOUGH_COMPONENTS};
    if (csv.errors == 0 && prepare(&csv, recording)) {
        recording->memory = all;
        return;
    }
    free(all);
    *recording->samples = (gough_samples){.count = 0};
}

void study_samples_read(study_messages *messages, study_place place, const char *path,
                        study_recording *recording) {
    size_t length = 0;
    char *text = study_source_read(messages, place, path, MOST_BYTES, true, &length);
    study_source *source = study_arena_take(messages->arena, sizeof *source);
    recording->memory = NULL;
    /* messages point into the text until they are written, so it lives as long as they do */
    char *kept = text && source ? study_arena_copy(messages->arena, text, length) : NULL;
    free(text);
    if (!kept) return;
    *source = (study_source){study_printable(messages->arena, path), kept, length, 1, false};
    study_samples_parse(messages, source, recording);
}
