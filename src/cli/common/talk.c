/* Messages on standard error, text of users in messages and summaries, and the nearest known word to a misspelled one. */
#define _GNU_SOURCE
#include "cli/common/talk.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/study_messages.h"

static bool in_json; /* --json was given: messages are JSON too */

void talk_in_json(void) { in_json = true; }
bool talks_in_json(void) { return in_json; }

bool colourful(FILE *stream) {
    const char *refused = getenv("NO_COLOR");
    const char *terminal = getenv("TERM");
    return !(refused && *refused) && terminal && strcmp(terminal, "dumb") != 0 &&
           isatty(fileno(stream));
}

static void print_shown(FILE *stream, const char *text) {
    char part[256];
    size_t used = 0;
    for (size_t at = 0, length = strlen(text); at < length;) {
        char one[GOUGH_SHOWN_CHARACTER];
        at += gough_character_show(text + at, length - at, one);
        const size_t bytes = strlen(one);
        if (used + bytes > sizeof part) {
            fwrite(part, 1, used, stream);
            used = 0;
        }
        memcpy(part + used, one, bytes);
        used += bytes;
    }
    fwrite(part, 1, used, stream);
}

static void print_formatted(FILE *stream, const char *format, va_list list) {
    char *line = NULL;
    if (vasprintf(&line, format, list) < 0) line = NULL;
    print_shown(stream, line ? line : "out of memory");
    fputc('\n', stream);
    free(line);
}

void print_line(FILE *stream, const char *format, ...) {
    va_list list;
    va_start(list, format);
    print_formatted(stream, format, list);
    va_end(list);
}

void print_title(FILE *stream, const char *title) {
    if (title && *title) print_line(stream, "%s", title);
}

void say_json(const char *kind, const char *verb, json_t *what) {
    json_t *line = json_object();
    if (verb) json_object_set_new(what, "verb", json_string(verb));
    json_object_set_new(line, kind, what);
    char *text = json_dumps(line, JSON_COMPACT | JSON_PRESERVE_ORDER);
    fprintf(stderr, "%s\n", text ? text : "{\"error\":{\"message\":\"out of memory\"}}");
    free(text);
    json_decref(line);
}

static void say_sentence(const char *kind, const char *verb, const char *format, va_list list) {
    static const char warning[] = "warning: ";
    char *sentence = NULL;
    if (vasprintf(&sentence, format, list) < 0) sentence = NULL;
    const char *text = sentence ? sentence : "out of memory";
    if (strncmp(text, warning, sizeof warning - 1) == 0) {
        kind = "warning";
        text += sizeof warning - 1;
    }
    json_t *what = json_object();
    const size_t place = leading_place(text);
    if (place) {
        json_set_place(what, text, place);
        text += place + 2;
    }
    json_object_set_new(what, "message", json_shown(text, strlen(text)));
    say_json(kind, verb, what);
    free(sentence);
}

static void say(const char *verb, bool wrong, const char *format, va_list list) {
    fflush(stdout); /* keep the order if both streams go to one place */
    if (in_json) {
        say_sentence(wrong ? "error" : "remark", verb, format, list);
        return;
    }
    fputs("gough", stderr);
    if (verb) fprintf(stderr, " %s", verb);
    if (wrong)
        fputs(colourful(stderr) ? ": \033[1;31merror:\033[0m " : ": error: ", stderr);
    else
        fputs(": ", stderr);
    print_formatted(stderr, format, list);
}

void usage_error(const struct argp_state *state, const char *format, ...) {
    const char *verb = strncmp(state->name, "gough ", 6) == 0 ? state->name + 6 : NULL;
    va_list list;
    va_start(list, format);
    say(verb, true, format, list);
    va_end(list);
    if (!in_json) fprintf(stderr, "'%s --help' says what it takes\n", state->name);
    exit(GOUGH_ERROR_INPUT);
}

void complain(const char *verb, const char *format, ...) {
    va_list list;
    va_start(list, format);
    say(verb, true, format, list);
    va_end(list);
}

char *place_of(const gough_study *study, const char *sentence) {
    const size_t length = gough_study_place(study, sentence, NULL, 0);
    char *place = length > 0 ? malloc(length + 1) : NULL;
    if (place) gough_study_place(study, sentence, place, length + 1);
    return place;
}

static void say_at(const char *verb, const char *place, const char *key, const char *sentence) {
    if (!in_json) {
        complain(verb, "%s: %s", place, sentence);
        return;
    }
    json_t *what = json_object();
    json_set_place(what, place, strlen(place));
    if (key) json_object_set_new(what, "key", json_string(key));
    json_object_set_new(what, "message", json_shown(sentence, strlen(sentence)));
    fflush(stdout);
    say_json("error", verb, what);
}

void complain_at(const char *verb, const char *place, const char *sentence) {
    say_at(verb, place, NULL, sentence);
}

void complain_of(const char *verb, const gough_study *study, gough_error *error) {
    gough_error_say(error, &study->units);
    char *place = place_of(study, error->message);
    say_at(verb, place ? place : study->name, error->key, error->message);
    free(place);
}

void remark(const char *verb, const char *format, ...) {
    va_list list;
    va_start(list, format);
    say(verb, false, format, list);
    va_end(list);
}

const char *nearest_word(const char *word, const char *const *candidate, size_t count) {
    const int nearest = gough_word_nearest(word, strlen(word), candidate, count);
    return nearest < 0 ? NULL : candidate[nearest];
}
