/* CSV in: a header row of names, then rows of as many numbers. Every error has its place, file:line:column, both from 1.
 * A byte-order mark, CRLF and quoted names are accepted; numbers are read the same in every locale. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "gough/text.h"
#include "table/table.h"

enum { COLUMN_CAP = 4096, NAME_CAP = 200 };

typedef struct reader {
    const char *path;
    gough_piece rest;       /* what is left of the text */
    const char *line_begin; /* of the line that was taken last */
    size_t line;            /* its number, from 1 */
    gough_error *error;
} reader;

static gough_status fail_at(const reader *r, const char *place, const char *sentence) {
    return gough_fail(r->error, GOUGH_ERROR_INPUT, "%s:%zu:%zu: %s", r->path, r->line,
                      (size_t)(place - r->line_begin) + 1, sentence);
}

/* Takes the next line; false after the last. */
static bool take_line(reader *r, gough_piece *line) {
    if (!gough_csv_line(&r->rest, line)) return false;
    r->line_begin = line->begin;
    r->line++;
    return true;
}

static bool is_word(gough_piece cell, const char *word) {
    if (cell.begin < cell.end && (*cell.begin == '-' || *cell.begin == '+')) cell.begin++;
    const size_t length = (size_t)(cell.end - cell.begin);
    return length == strlen(word) && strncasecmp(cell.begin, word, length) == 0;
}

/* Whether a cell that is not empty is a decimal number, and nothing else. */
static bool is_decimal(gough_piece cell, double *value) {
    const size_t length = (size_t)(cell.end - cell.begin);
    return gough_decimal_read(cell.begin, length, value) == length;
}

/* A decimal number, or nan or inf as tables of gough have them. */
static gough_status read_number(const reader *r, gough_piece cell, double *value) {
    if (cell.begin == cell.end)
        return fail_at(r, cell.begin, "a number is missing (write nan for a missing value)");
    if (is_word(cell, "nan")) {
        *value = NAN;
        return GOUGH_OK;
    }
    if (is_word(cell, "inf") || is_word(cell, "infinity")) {
        *value = *cell.begin == '-' ? -INFINITY : INFINITY;
        return GOUGH_OK;
    }
    if (!is_decimal(cell, value)) {
        const size_t length = (size_t)(cell.end - cell.begin);
        char shown[32], sentence[100];
        const size_t whole = gough_text_show(cell.begin, length, shown, sizeof shown);
        snprintf(sentence, sizeof sentence, "'%s%s' is not a number", shown,
                 whole < sizeof shown ? "" : "...");
        return fail_at(r, cell.begin, sentence);
    }
    if (isinf(*value))
        return fail_at(r, cell.begin, "this number is too large for double precision");
    return GOUGH_OK;
}

/* How a run ended, as a word: its number in gough_cause; -1 for any other text. */
static int read_cause(gough_piece cell) {
    for (int cause = GOUGH_END_DONE; cause < GOUGH_CAUSES; cause++)
        if (is_word(cell, gough_cause_name((gough_cause)cause))) return cause;
    return -1;
}

/* Whether a name is UTF-8 without control characters. */
static bool is_clean_text(gough_piece text) {
    unsigned code = 0;
    for (const char *at = text.begin; at < text.end;) {
        const size_t size = gough_character_read(at, (size_t)(text.end - at), &code);
        if (size == 0 || code < 0x20 || code == 0x7f) return false;
        at += size;
    }
    return true;
}

static gough_status read_name(const reader *r, gough_table *table, size_t column,
                              gough_piece cell) {
    const char *place = cell.begin;
    if (cell.end - cell.begin >= 2 && *cell.begin == '"' && cell.end[-1] == '"') {
        cell.begin++;
        cell.end--;
    }
    const size_t length = (size_t)(cell.end - cell.begin);
    double number;
    if (length == 0) return fail_at(r, place, "a column has no name");
    if (length > NAME_CAP) return fail_at(r, place, "this column's name is too long");
    if (!is_clean_text(cell))
        return fail_at(r, place, "this column's name is not printable text in UTF-8");
    if (memchr(cell.begin, ';', length) != NULL)
        return fail_at(r, place, "columns must be separated by commas, not semicolons");
    if (is_decimal(cell, &number))
        return fail_at(r, place, "the first row must name the columns (t,x,y,...), not be numbers");

    table->name[column] = strndup(cell.begin, length);
    if (table->name[column] == NULL)
        return gough_fail(r->error, GOUGH_ERROR_FILE, "%s: out of memory", r->path);
    for (size_t c = 0; c < column; c++) {
        if (strcmp(table->name[c], table->name[column]) == 0)
            return fail_at(r, place, "an earlier column has the same name");
    }
    return GOUGH_OK;
}

/* row_cap: rows to make room for; 0: as many as the rest of the text can have */
static gough_status read_header(reader *r, gough_table *table, size_t row_cap) {
    gough_piece line, cell;
    if (!take_line(r, &line))
        return gough_fail(r->error, GOUGH_ERROR_INPUT,
                          "%s:1:1: the file is empty; a table begins with a row of column names",
                          r->path);
    const size_t columns = gough_csv_count(line);
    /* a row takes two bytes a number; so memory is bounded by the length of the text */
    if (row_cap == 0) row_cap = (size_t)(r->rest.end - r->rest.begin) / (2 * columns) + 1;
    if (columns > COLUMN_CAP) return fail_at(r, line.begin, "more than 4096 columns");
    if (!result_table_shape(table, columns, row_cap))
        return gough_fail(r->error, GOUGH_ERROR_FILE, "%s: out of memory", r->path);
    for (size_t c = 0; gough_csv_cell(&line, &cell); c++) {
        const gough_status status = read_name(r, table, c, cell);
        if (status != GOUGH_OK) return status;
    }
    return GOUGH_OK;
}

/* skip: NULL, or for each column whether its numbers are left alone */
static gough_status read_row(const reader *r, gough_table *table, gough_piece line,
                             const bool *skip) {
    const size_t cells = gough_csv_count(line);
    gough_piece cell;
    if (cells != table->columns) {
        char sentence[100];
        snprintf(sentence, sizeof sentence, "this row has %zu number%s, but there are %zu columns",
                 cells, cells == 1 ? "" : "s", table->columns);
        return fail_at(r, line.begin, sentence);
    }
    for (size_t c = 0; gough_csv_cell(&line, &cell); c++) {
        if (skip != NULL && skip[c]) continue;
        double *value = &table->value[c][table->rows];
        const int cause = strcmp(table->name[c], "end_cause") == 0 ? read_cause(cell) : -1;
        if (cause >= 0) {
            *value = cause;
            continue;
        }
        const gough_status status = read_number(r, cell, value);
        if (status != GOUGH_OK) return status;
    }
    return GOUGH_OK;
}

static gough_status read_rows(reader *r, gough_table *table) {
    gough_piece line;
    table->rows = 0;
    while (take_line(r, &line)) {
        if (line.begin == line.end && gough_csv_ended(r->rest)) break;
        if (line.begin == line.end) return fail_at(r, line.begin, "an empty row");
        const gough_status status = read_row(r, table, line, NULL);
        if (status != GOUGH_OK) return status;
        table->rows++;
    }
    return GOUGH_OK;
}

gough_status result_read_csv(const char *path, const char *text, size_t length, gough_table *table,
                             gough_error *error) {
    reader r = {path, {text, text + length}, text, 0, error};
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) r.rest.begin += 3;
    const gough_status status = read_header(&r, table, 0);
    return status == GOUGH_OK ? read_rows(&r, table) : status;
}

/* ---- in parts ------------------------------------------------------------------------------------------------------ */

enum { PIECE = 1 << 20, LINE_CAP = 1 << 26 }; /* bytes read at once, and of the longest line */

/* The file's bytes from some place on; whole lines are taken off its front. */
typedef struct window {
    int file;
    char *text;
    size_t begin, used, capacity;
    bool ended; /* the file has no more */
} window;

/* Reads on until the window has a whole line or the file ends. @return 0, or an error number: EFBIG for a line beyond LINE_CAP */
static int fill_window(window *w) {
    memmove(w->text, w->text + w->begin, w->used - w->begin);
    w->used -= w->begin;
    w->begin = 0;
    size_t searched = 0;
    while (!w->ended && memchr(w->text + searched, '\n', w->used - searched) == NULL) {
        searched = w->used;
        if (w->used == w->capacity) {
            if (w->capacity >= LINE_CAP) return EFBIG;
            char *more = realloc(w->text, 2 * w->capacity);
            if (more == NULL) return ENOMEM;
            w->text = more;
            w->capacity *= 2;
        }
        const ssize_t got = read(w->file, w->text + w->used, w->capacity - w->used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return errno;
        w->ended = got == 0;
        w->used += (size_t)got;
    }
    return 0;
}

/* The whole lines of the window, or all of it at the end of the file. */
static gough_piece whole_lines(window *w) {
    const char *begin = w->text + w->begin, *end = w->text + w->used;
    while (!w->ended && end > begin && end[-1] != '\n') end--; /* unreachable: no line's end */
    w->begin = (size_t)(end - w->text);
    return (gough_piece){begin, end};
}

static gough_status next_lines(reader *r, window *w) {
    const int number = fill_window(w);
    if (number == EFBIG)
        return gough_fail(r->error, GOUGH_ERROR_INPUT, "%s:%zu:1: this row is longer than %d MiB",
                          r->path, r->line + 1, LINE_CAP >> 20);
    if (number != 0)
        return gough_fail(r->error, GOUGH_ERROR_FILE, "%s: cannot read: %s", r->path,
                          strerror(number));
    r->rest = whole_lines(w);
    if (r->line == 0 && r->rest.end - r->rest.begin >= 3 &&
        memcmp(r->rest.begin, "\xef\xbb\xbf", 3) == 0)
        r->rest.begin += 3;
    return GOUGH_OK;
}

/* The rows of the lines at hand. blank: number of an empty line, which is right behind all rows only; 0: none so far */
static gough_status scan_lines(reader *r, gough_table *table, const bool *skip, result_scan *scan,
                               size_t *blank) {
    gough_piece line;
    while (!scan->stopped && take_line(r, &line)) {
        if (line.begin == line.end) {
            if (*blank == 0) *blank = r->line;
            continue;
        }
        if (*blank != 0)
            return gough_fail(r->error, GOUGH_ERROR_INPUT, "%s:%zu:1: an empty row", r->path,
                              *blank);
        const gough_status status = read_row(r, table, line, skip);
        if (status != GOUGH_OK) return status;
        if (++table->rows < RESULT_PART) continue;
        result_scan_part(scan, table->rows);
        table->rows = 0;
    }
    return GOUGH_OK;
}

static gough_status scan_window(reader *r, window *w, gough_table *table, result_scan *scan) {
    gough_status status = next_lines(r, w);
    if (status == GOUGH_OK) status = read_header(r, table, RESULT_PART);
    if (status != GOUGH_OK) return status;
    bool *skip = calloc(table->columns, sizeof *skip);
    table->rows = 0;
    const bool good =
        skip != NULL && result_complete_texts(table) && result_scan_begin(scan, table);
    if (!good) status = gough_fail(r->error, GOUGH_ERROR_FILE, "%s: out of memory", r->path);
    for (size_t c = 0, wanted = 0; good && c < table->columns; c++) {
        skip[c] = wanted == scan->part.columns || scan->part.value[wanted] != table->value[c];
        wanted += !skip[c];
    }
    size_t blank = 0;
    while (status == GOUGH_OK && !scan->stopped) {
        status = scan_lines(r, table, skip, scan, &blank);
        if (w->ended || status != GOUGH_OK) break;
        status = next_lines(r, w);
    }
    if (status == GOUGH_OK && table->rows > 0) result_scan_part(scan, table->rows);
    free(skip);
    return status;
}

gough_status result_scan_csv(int file, result_scan *scan, gough_table *table, gough_error *error) {
    window w = {.file = file, .text = malloc(PIECE), .capacity = PIECE};
    if (w.text == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", scan->path);
    reader r = {scan->path, {NULL, NULL}, NULL, 0, error};
    const gough_status status = scan_window(&r, &w, table, scan);
    free(w.text);
    return status;
}
