/* Lines and cells of CSV: where each begins and ends. What they mean is the business of their readers. */
#include <string.h>

#include "gough/text.h"

static bool is_blank(char c, char separator) {
    return (c == ' ' || c == '\t') && (c != separator || separator == ' ');
}

bool gough_csv_line(gough_piece *rest, gough_piece *line) {
    const size_t left = (size_t)(rest->end - rest->begin);
    if (left == 0) return false;
    const char *feed = memchr(rest->begin, '\n', left);
    *line = (gough_piece){rest->begin, feed ? feed : rest->end};
    rest->begin = feed ? feed + 1 : rest->end;
    if (line->end > line->begin && line->end[-1] == '\r') line->end--;
    return true;
}

/* Skips the quoted part of a cell that begins with a quote. If the quote is never closed, the cell counts as unquoted. */
static const char *after_quotes(const char *at, const char *end) {
    for (const char *next = at + 1; next < end; next++) {
        if (*next != '"') continue;
        if (next + 1 < end && next[1] == '"')
            next++;
        else
            return next + 1;
    }
    return at;
}

/* Where a cell ends: at its separator, or with blanks between cells at the first of them. */
static const char *cell_end(const char *at, const char *end, char separator) {
    if (separator != ' ') {
        const char *found = at < end ? memchr(at, separator, (size_t)(end - at)) : NULL;
        return found ? found : end;
    }
    while (at < end && !is_blank(*at, ' ')) at++;
    return at;
}

bool gough_csv_cell_by(gough_piece *line, char separator, gough_piece *cell) {
    const char *from = line->begin, *end = line->end;
    if (!from) return false;
    while (from < end && is_blank(*from, separator)) from++;
    const char *at = from < end && *from == '"' ? after_quotes(from, end) : from;
    const char *stop = cell_end(at, end, separator), *next = stop;
    if (separator == ' ')
        while (next < end && is_blank(*next, ' ')) next++;
    *cell = (gough_piece){from, stop};
    line->begin = next == end && (separator == ' ' || stop == end) ? NULL
                  : separator == ' '                               ? next
                                                                   : stop + 1;
    while (cell->end > cell->begin && is_blank(cell->end[-1], separator)) cell->end--;
    return true;
}

bool gough_csv_cell(gough_piece *line, gough_piece *cell) {
    return gough_csv_cell_by(line, ',', cell);
}

bool gough_csv_ended(gough_piece rest) {
    while (rest.begin < rest.end && (*rest.begin == '\n' || *rest.begin == '\r')) rest.begin++;
    return rest.begin == rest.end;
}

size_t gough_csv_count(gough_piece line) {
    gough_piece cell;
    size_t count = 0;
    while (gough_csv_cell(&line, &cell)) count++;
    return count;
}
