/* Recorded motion from a CSV file: a header with t and any of surge, sway, heave, roll, pitch, yaw, then rows of numbers in
 * increasing time. Comma-separated, lines ending in LF or CR LF, a UTF-8 byte-order mark accepted; angles in degrees. */
#include "study/samples.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static const double PI = 3.14159265358979323846;

typedef struct table {
    study_messages *messages;
    const study_source *source;
    size_t at;           /* offset of the next line */
    int column[COLUMNS]; /* what the cells of a row are, in order */
    size_t columns;
    size_t rows;
    double *time, *value; /* angles in degrees */
    study_digits digits[COLUMNS];
    size_t errors;
} table;

typedef struct cell {
    size_t begin, end; /* without blanks around */
    bool last;
} cell;

static void say(table *csv, size_t offset, const char *sentence) {
    study_say(csv->messages, GOUGH_ERROR_INPUT, (study_place){csv->source, offset}, "%s", sentence);
    csv->errors++;
}

/* End of the line that begins there, without its CR. */
static size_t line_end(const table *csv, size_t begin) {
    const char *text = csv->source->text;
    const char *end = memchr(text + begin, '\n', csv->source->length - begin);
    const size_t at = end ? (size_t)(end - text) : csv->source->length;
    return at > begin && text[at - 1] == '\r' ? at - 1 : at;
}

static size_t next_line(const table *csv, size_t end) {
    const char *text = csv->source->text;
    if (end < csv->source->length && text[end] == '\r') end++;
    return end < csv->source->length ? end + 1 : end;
}

static bool is_blank(char c) { return c == ' ' || c == '\t'; }

static cell next_cell(const table *csv, size_t begin, size_t end, size_t *next) {
    const char *text = csv->source->text;
    const char *comma = memchr(text + begin, ',', end - begin);
    cell found = {begin, comma ? (size_t)(comma - text) : end, !comma};
    *next = found.end + 1;
    while (found.begin < found.end && is_blank(text[found.begin])) found.begin++;
    while (found.end > found.begin && is_blank(text[found.end - 1])) found.end--;
    return found;
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
static bool say_no_header(table *csv, size_t begin, size_t end) {
    const char *text = csv->source->text;
    size_t next = begin, rest;
    double value;
    const cell head = next_cell(csv, begin, end, &next);
    const size_t length = head.end - head.begin;
    if (begin == end) {
        say(csv, begin, "the first row must name the columns, as in t,heave");
    } else if (study_decimal_read(text + head.begin, length, &value, &rest) == STUDY_DECIMAL) {
        study_say(csv->messages, GOUGH_ERROR_INPUT, (study_place){csv->source, head.begin},
                  "the first row must name the columns, as in t,heave; found the number %s",
                  study_quote(csv->messages->arena, text + head.begin, length));
        csv->errors++;
    } else if (memchr(text + begin, ';', end - begin)) {
        say(csv, begin, "columns are separated by commas, not by semicolons");
    }
    return csv->errors > 0;
}

/* What the cell of the header names; -1, with what is wrong said, where it names nothing. */
static int header_cell(table *csv, cell head) {
    study_arena *arena = csv->messages->arena;
    const char *name = study_quote(arena, csv->source->text + head.begin, head.end - head.begin);
    const char *names[COLUMNS];
    for (int c = 0; c < COLUMNS; c++) names[c] = column_name(c);
    const int column = column_of(name);
    const char *nearest = study_nearest(name, names, COLUMNS);
    const study_place place = {csv->source, head.begin};
    for (size_t i = 0; column >= 0 && i < csv->columns; i++) {
        if (csv->column[i] != column) continue;
        say(csv, head.begin, "this column appears twice");
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
    const size_t begin = csv->at, end = line_end(csv, begin);
    bool has_time = false;
    csv->at = next_line(csv, end);
    if (say_no_header(csv, begin, end)) return false;
    cell head;
    size_t next = begin;
    do {
        head = next_cell(csv, next, end, &next);
        const int column = header_cell(csv, head);
        has_time |= column == TIME;
        if (column >= 0) csv->column[csv->columns++] = column;
    } while (!head.last && csv->errors < MOST_ERRORS);
    if (csv->errors) return false;
    if (!has_time) say(csv, begin, "the column t, the time, is missing");
    if (!csv->errors && csv->columns < 2)
        say(csv, begin, "there is no motion: a column such as heave is needed besides t");
    return csv->errors == 0;
}

static void say_cell(table *csv, cell there, study_decimal kind) {
    const char *text = csv->source->text + there.begin;
    const char *quote = study_quote(csv->messages->arena, text, there.end - there.begin);
    const study_place place = {csv->source, there.begin};
    csv->errors++;
    if (there.begin == there.end)
        study_say(csv->messages, GOUGH_ERROR_INPUT, place, "an empty cell; a number was expected");
    else if (kind == STUDY_NOT_FINITE)
        study_say(csv->messages, GOUGH_ERROR_INPUT, place, "`%s` is not finite", quote);
    else
        study_say(csv->messages, GOUGH_ERROR_INPUT, place, "`%s` is not a number", quote);
}

/* A time that does not increase; where it is the one of the row before, the times may have too few decimals. */
static void say_time(table *csv, size_t at) {
    const double now = csv->time[csv->rows], before = csv->time[csv->rows - 1];
    const int decimals = -csv->digits[TIME].place;
    char advice[100] = "";
    if (!(now < before) && decimals > 0 && decimals < 9)
        snprintf(advice, sizeof advice,
                 "; if the times are rounded to %d decimal%s, record more digits", decimals,
                 decimals == 1 ? "" : "s");
    study_say(csv->messages, GOUGH_ERROR_INPUT, (study_place){csv->source, at},
              "the time %.9g must be greater than %.9g in the row before%s", now, before, advice);
    csv->errors++;
}

/* Reads one row into its place; one with a wrong cell does not count. */
static void read_row(table *csv, size_t begin, size_t end) {
    double *value = csv->value + csv->rows * GOUGH_COMPONENTS;
    const size_t before = csv->errors;
    size_t time_at = begin, count = 0, next = begin;
    cell there;
    do {
        there = next_cell(csv, next, end, &next);
        if (count == csv->columns) {
            study_say(csv->messages, GOUGH_ERROR_INPUT, (study_place){csv->source, there.begin},
                      "this row has more cells than the %zu columns of the first row",
                      csv->columns);
            csv->errors++;
            return;
        }
        double number;
        size_t rest;
        const study_decimal kind = study_decimal_read(csv->source->text + there.begin,
                                                      there.end - there.begin, &number, &rest);
        const int column = csv->column[count++];
        if (kind == STUDY_DECIMAL)
            study_digits_take(&csv->digits[column], csv->source->text + there.begin,
                              there.end - there.begin);
        if (kind != STUDY_DECIMAL)
            say_cell(csv, there, kind);
        else if (column == TIME)
            csv->time[csv->rows] = number, time_at = there.begin;
        else
            value[column] = number;
    } while (!there.last && csv->errors < MOST_ERRORS);
    if (csv->errors > before) return;
    if (count < csv->columns) {
        study_say(csv->messages, GOUGH_ERROR_INPUT, (study_place){csv->source, end},
                  "this row ends after %zu of %zu cells", count, csv->columns);
        csv->errors++;
    } else if (csv->rows > 0 && !(csv->time[csv->rows] > csv->time[csv->rows - 1])) {
        say_time(csv, time_at);
    } else if (csv->rows == 0 && csv->time[0] > 0) {
        say(csv, time_at, "the record must begin at time 0 or before, because a run begins at 0");
    }
    csv->rows++;
}

/* Whether nothing but line ends follows, as editors leave them at the end of a file. */
static bool only_line_ends(const table *csv, size_t at) {
    while (at < csv->source->length &&
           (csv->source->text[at] == '\n' || csv->source->text[at] == '\r'))
        at++;
    return at == csv->source->length;
}

static void read_rows(table *csv) {
    const size_t length = csv->source->length;
    while (csv->at < length && csv->errors < MOST_ERRORS) {
        const size_t begin = csv->at, end = line_end(csv, begin);
        csv->at = next_line(csv, end);
        if (begin == end && only_line_ends(csv, csv->at)) break;
        if (begin == end)
            say(csv, begin, "an empty line between the rows");
        else
            read_row(csv, begin, end);
    }
    if (csv->errors >= MOST_ERRORS)
        say(csv, csv->at, "too many errors; the rest of the file was not read");
    else if (!csv->errors && csv->rows < 2)
        say(csv, length, "at least two rows of numbers are needed");
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

/* Smoothed as asked for, in radians, with its spline. */
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
    for (size_t i = 0; i < csv->rows; i++)
        for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++)
            csv->value[i * GOUGH_COMPONENTS + (size_t)c] *= PI / 180;
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
    if (status != GOUGH_OK) say(csv, 0, study_printable(csv->messages->arena, error.message));
    return status == GOUGH_OK;
}

void study_samples_parse(study_messages *messages, const study_source *source,
                         study_recording *recording) {
    table csv = {.messages = messages, .source = source};
    recording->memory = NULL;
    *recording->record = (gough_record){.remarks = 0};
    if (source->length >= 3 && memcmp(source->text, "\xEF\xBB\xBF", 3) == 0) csv.at = 3;
    if (!read_header(&csv)) return;
    const size_t lines = count_lines(source);
    if (lines > MOST_ROWS + 2) {
        say(&csv, 0, "more than 2 000 000 rows");
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
