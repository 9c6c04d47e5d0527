/* The lines of a record: see record_lines.h. Of a file a buffer is read that holds one line at least. */
#define _POSIX_C_SOURCE 200809L
#include "study/record_lines.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FIRST_BYTES = 1 << 16, LONGEST_LINE = 1 << 20 };

study_lines study_lines_of_text(study_messages *messages, const char *name, const char *text,
                                size_t length) {
    return (study_lines){.messages = messages,
                         .name = name,
                         .file = -1,
                         .buffer = NULL,
                         .capacity = length,
                         .rest = {text, text + length},
                         .begin = text,
                         .ended = true};
}

study_lines study_lines_of_file(study_messages *messages, const char *name, int file) {
    study_lines lines = {.messages = messages, .name = name, .file = file};
    lines.buffer = malloc(FIRST_BYTES);
    lines.capacity = FIRST_BYTES;
    lines.own = study_arena_take(messages->arena, sizeof *lines.own);
    lines.broken = !lines.buffer || !lines.own;
    if (lines.broken) messages->arena->exhausted = true;
    study_lines_again(&lines);
    return lines;
}

void study_lines_again(study_lines *lines) {
    if (lines->file < 0) {
        lines->rest.begin = lines->rest.end - lines->capacity;
    } else if (!lines->broken) {
        lines->rest = (gough_piece){lines->buffer, lines->buffer};
        lines->ended = false;
        /* a regular file: it can be read again */
        lines->broken = lseek(lines->file, 0, SEEK_SET) != 0;
    }
    lines->number = lines->taken = lines->offset = 0;
    lines->kept = NULL;
}

void study_lines_end(study_lines *lines) {
    free(lines->buffer);
    lines->buffer = NULL;
}

static void fail_long(study_lines *lines) {
    lines->broken = true;
    *lines->own =
        (study_source){lines->name, "", 0, 1, .lines = lines->number, .bytes = lines->taken};
    study_say(lines->messages, GOUGH_ERROR_INPUT, (study_place){lines->own, 0},
              "this line has more than a million bytes");
}

static void fail_read(study_lines *lines, int cause) {
    char text[128] = "";
    lines->broken = true;
    (void)strerror_r(cause, text, sizeof text);
    *lines->own = (study_source){.name = lines->name, .rank = 1};
    study_say(lines->messages, GOUGH_ERROR_FILE, (study_place){lines->own, 0},
              "cannot read `%s`: %s", lines->name, study_printable(lines->messages->arena, text));
}

/* More bytes behind those that are left; false at the end of the file. */
static bool read_more(study_lines *lines) {
    const size_t left = (size_t)(lines->rest.end - lines->rest.begin);
    memmove(lines->buffer, lines->rest.begin, left);
    if (left == lines->capacity) {
        if (left >= LONGEST_LINE) {
            fail_long(lines);
            return false;
        }
        char *larger = realloc(lines->buffer, 2 * lines->capacity);
        if (larger) {
            lines->buffer = larger;
            lines->capacity *= 2;
        } else {
            lines->messages->arena->exhausted = lines->broken = true;
            lines->rest = (gough_piece){lines->buffer, lines->buffer};
            return false;
        }
    }
    ssize_t got;
    do {
        got = read(lines->file, lines->buffer + left, lines->capacity - left);
    } while (got < 0 && errno == EINTR);
    lines->rest = (gough_piece){lines->buffer, lines->buffer + left + (got > 0 ? got : 0)};
    if (got < 0) fail_read(lines, errno);
    lines->ended = got <= 0;
    return got > 0;
}

bool study_lines_next(study_lines *lines) {
    size_t searched = 0;
    while (!lines->ended && !lines->broken) {
        const size_t left = (size_t)(lines->rest.end - lines->rest.begin);
        if (memchr(lines->rest.begin + searched, '\n', left - searched)) break;
        searched = left;
        read_more(lines);
    }
    if (lines->broken) return false;
    const char *begin = lines->rest.begin;
    if (!gough_csv_line(&lines->rest, &lines->line)) return false;
    lines->begin = begin;
    lines->closed = lines->rest.begin[-1] == '\n';
    lines->offset = lines->taken;
    lines->taken += (size_t)(lines->rest.begin - begin);
    const gough_piece line = lines->line;
    if (lines->number++ == 0 && line.end - line.begin >= 3 &&
        memcmp(line.begin, "\xEF\xBB\xBF", 3) == 0)
        lines->line.begin += 3;
    return true;
}

size_t study_lines_count(study_lines *lines) {
    size_t count = 0;
    while (study_lines_next(lines)) count++;
    return count;
}

static const study_source *keep(study_lines *lines, const char *text, size_t length, size_t number,
                                size_t offset) {
    study_arena *arena = lines->messages->arena;
    study_source *source = study_arena_take(arena, sizeof *source);
    const char *copy = study_arena_copy(arena, text, length);
    if (!source || !copy) return NULL;
    *source = (study_source){lines->name, copy, length, 1, .lines = number, .bytes = offset};
    return source;
}

static const study_source nowhere = {.name = "", .text = ""};

study_place study_lines_place(study_lines *lines, const char *at) {
    if (!lines->kept || lines->kept_number != lines->number)
        lines->kept = keep(lines, lines->begin, (size_t)(lines->line.end - lines->begin),
                           lines->number - 1, lines->offset);
    lines->kept_number = lines->number;
    if (!lines->kept) return (study_place){&nowhere, 0};
    return (study_place){lines->kept, (size_t)(at - lines->begin)};
}

study_place study_lines_last_place(study_lines *lines) {
    if (lines->number > 0 && !lines->closed) return study_lines_place(lines, lines->line.end);
    const study_source *end = keep(lines, "", 0, lines->number, lines->taken);
    return (study_place){end ? end : &nowhere, 0};
}
