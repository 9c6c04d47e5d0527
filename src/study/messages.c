/* Errors of a study with their places: collected, sorted, and written with the line and a caret. */
#define _POSIX_C_SOURCE 200809L
#include "study/messages.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/text.h"

struct study_message {
    study_message *next;
    study_place place;
    const char *sentence;
    size_t order; /* of saying */
};

enum {
    MOST_MESSAGES = 100,
    WIDEST_LINE =
        120, /* characters of a source line that are shown; longer ones are cut around the caret */
    LONGEST_QUOTE = 40
};

static const char *shown_text(study_arena *arena, const char *text, size_t length, size_t most) {
    size_t used = 0, at = 0, n = 0;
    char *copy = study_arena_take(arena, (most < length ? most : length) * GOUGH_SHOWN_CHARACTER +
                                             sizeof "…");
    if (!copy) return "";
    for (; at < length && n < most; n++) {
        at += gough_character_show(text + at, length - at, copy + used);
        used += strlen(copy + used);
    }
    if (at < length) memcpy(copy + used, "…", sizeof "…");
    return copy;
}

const char *study_quote(study_arena *arena, const char *text, size_t length) {
    return shown_text(arena, text, length, LONGEST_QUOTE);
}

const char *study_printable(study_arena *arena, const char *sentence) {
    const size_t length = strlen(sentence);
    return shown_text(arena, sentence, length, length);
}

void study_say(study_messages *messages, gough_status status, study_place place, const char *format,
               ...) {
    if (messages->status != GOUGH_ERROR_INPUT) messages->status = status;
    if (messages->count >= MOST_MESSAGES) {
        messages->left_out++;
        return;
    }
    char sentence[4000]; /* all columns of a record are named at once */
    va_list arguments;
    va_start(arguments, format);
    gough_sentence(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    study_message *message = study_arena_take(messages->arena, sizeof *message);
    if (!message) return;
    message->sentence = study_printable(messages->arena, sentence);
    message->place = place;
    message->order = messages->count++;
    if (messages->last)
        messages->last->next = message;
    else
        messages->first = message;
    messages->last = message;
}

static bool line_ends_before(const study_source *source, size_t offset) {
    const char *text = source->text;
    if (text[offset - 1] == '\n') return true;
    return text[offset - 1] == '\r' && text[offset] != '\n';
}

static size_t line_begin(study_place place) {
    size_t begin = place.offset;
    while (begin > 0 && !line_ends_before(place.source, begin)) begin--;
    return begin;
}

/* Bytes of a byte-order mark at the start of a text: they take no column. */
static size_t mark_length(const study_source *source) {
    return source->length >= 3 && memcmp(source->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
}

static size_t count_characters(const char *text, size_t length) {
    size_t count = 0;
    for (size_t at = 0; at < length; count++) {
        const size_t size = gough_character_read(text + at, length - at, NULL);
        at += size ? size : 1;
    }
    return count;
}

void study_place_find(study_place place, size_t *line, size_t *column) {
    size_t begin = line_begin(place);
    *line = 1 + place.source->lines;
    for (size_t i = 1; i <= begin; i++)
        if (line_ends_before(place.source, i)) ++*line;
    const size_t mark = mark_length(place.source);
    if (begin == 0 && mark <= place.offset) begin = mark; /* unreachable: in the mark */
    *column = 1 + count_characters(place.source->text + begin, place.offset - begin);
}

/* The line of the place and a caret below, cut to a window if it is long; tabs stay, so that the caret is below its character. */
static void write_line(FILE *out, study_place place, size_t column) {
    const study_source *source = place.source;
    size_t begin = line_begin(place);
    if (begin == 0) begin = mark_length(source);
    size_t end = place.offset > begin ? place.offset : begin;
    while (end < source->length && source->text[end] != '\n' && source->text[end] != '\r') end++;
    const size_t count = count_characters(source->text + begin, end - begin);
    const size_t skip =
        count > WIDEST_LINE && column > WIDEST_LINE / 2 ? column - WIDEST_LINE / 2 : 0;
    if (skip) fputs("…", out);
    size_t at = begin, n = 0, pads = 0;
    char pad[WIDEST_LINE * GOUGH_SHOWN_CHARACTER];
    for (; at < end && n < skip + WIDEST_LINE; n++) {
        char shown[GOUGH_SHOWN_CHARACTER] = "\t";
        const bool tab = source->text[at] == '\t';
        at += tab ? 1 : gough_character_show(source->text + at, end - at, shown);
        if (n < skip) continue;
        fputs(shown, out);
        if (n + 1 >= column) continue;
        /* an escape is as wide as it is long, any other character one column */
        const size_t width = shown[0] == '\\' ? strlen(shown) : 1;
        memset(pad + pads, tab ? '\t' : ' ', width);
        pads += width;
    }
    fprintf(out, "%s\n%s%.*s^\n", at < end ? "…" : "", skip ? " " : "", (int)pads, pad);
}

/* The name of a source, for which a file may have any bytes. */
static void write_name(FILE *out, const char *name) {
    for (size_t at = 0, length = strlen(name); at < length;) {
        char shown[GOUGH_SHOWN_CHARACTER];
        at += gough_character_show(name + at, length - at, shown);
        fputs(shown, out);
    }
}

static void write_message(FILE *out, const study_message *message) {
    const study_place place = message->place;
    write_name(out, place.source->name);
    if (!place.source->text) {
        fprintf(out, ": error: %s\n", message->sentence);
        return;
    }
    size_t line, column;
    study_place_find(place, &line, &column);
    if (!place.source->setting) fprintf(out, ":%zu:%zu", line, column);
    fprintf(out, ": error: %s\n", message->sentence);
    write_line(out, place, column);
}

static int compare(const void *left, const void *right) {
    const study_message *a = *(study_message *const *)left, *b = *(study_message *const *)right;
    const int rank_a = a->place.source->rank, rank_b = b->place.source->rank;
    if (rank_a != rank_b) return rank_a < rank_b ? -1 : 1;
    const size_t at_a = a->place.source->bytes + a->place.offset,
                 at_b = b->place.source->bytes + b->place.offset;
    if (at_a != at_b) return at_a < at_b ? -1 : 1;
    return (a->order > b->order) - (a->order < b->order);
}

const char *study_messages_first(const study_messages *messages) {
    return messages->first->sentence;
}

/* All of it in the order of the files; NULL where memory is short. */
static char *write_all(const study_messages *messages) {
    char *text = NULL;
    size_t length = 0, count = 0;
    study_message *sorted[MOST_MESSAGES];
    for (study_message *message = messages->first; message; message = message->next)
        sorted[count++] = message;
    qsort(sorted, count, sizeof sorted[0], compare);
    FILE *out = open_memstream(&text, &length);
    if (!out) return NULL;
    for (size_t i = 0; i < count; i++) write_message(out, sorted[i]);
    if (messages->left_out)
        fprintf(out, "… and %zu more errors, not shown here\n", messages->left_out);
    if (messages->arena->exhausted) fputs("error: out of memory\n", out);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

gough_status study_messages_end(const study_messages *messages, char **text) {
    gough_status status = messages->count ? messages->status : GOUGH_OK;
    if (messages->arena->exhausted) status = GOUGH_ERROR_FILE;
    if (!text) return status;
    *text = NULL;
    if (status == GOUGH_OK) return GOUGH_OK;
    *text = write_all(messages);
    return *text ? status : GOUGH_ERROR_FILE;
}
