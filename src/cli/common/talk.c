/* Messages on standard error, text of users in messages and summaries, and the nearest known word to a misspelled one. */
#define _GNU_SOURCE
#include "cli/common/talk.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

static void say(const char *verb, bool wrong, const char *format, va_list list) {
    fflush(stdout); /* keep the order if both streams go to one place */
    fputs("gough", stderr);
    if (verb) fprintf(stderr, " %s", verb);
    if (wrong)
        fputs(colourful(stderr) ? ": \033[1;31merror:\033[0m " : ": error: ", stderr);
    else
        fputs(": ", stderr);
    print_formatted(stderr, format, list);
}

void usage_error(const struct argp_state *state, const char *format, ...) {
    char *sentence = NULL, *shown = NULL;
    va_list list;
    va_start(list, format);
    if (vasprintf(&sentence, format, list) < 0) sentence = NULL;
    va_end(list);
    if (sentence) {
        const size_t length = strlen(sentence);
        const size_t size = gough_text_show(sentence, length, NULL, 0) + 1;
        if ((shown = malloc(size))) gough_text_show(sentence, length, shown, size);
    }
    argp_error(state, "%s", shown ? shown : "out of memory");
    free(shown);
    free(sentence);
}

static bool is_strange(const char *text) {
    const size_t length = strlen(text);
    return text[0] == '-' && gough_text_show(text, length, NULL, 0) != length;
}

/* Takes every option and argument as they come, and sees where the first one is that argp does not know. */
static error_t find_unknown(int key, char *text, struct argp_state *state) {
    (void)text;
    if (key != ARGP_KEY_ERROR) return 0;
    for (int i = state->next - 1; i <= state->next && i < state->argc; i++) {
        if (!is_strange(state->argv[i])) continue;
        state->flags &= ~(unsigned)(ARGP_NO_ERRS | ARGP_NO_EXIT);
        usage_error(state, "unrecognized option '%s'", state->argv[i]);
    }
    return 0;
}

void refuse_strange_option(const struct argp *argp, int count, char **argument) {
    const struct argp finder = {.options = argp->options, .parser = find_unknown};
    bool strange = false;
    for (int i = 1; i < count; i++) strange |= is_strange(argument[i]);
    if (strange)
        argp_parse(&finder, count, argument, ARGP_NO_ERRS | ARGP_NO_EXIT | ARGP_NO_HELP, NULL,
                   NULL);
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

void complain_of(const char *verb, const gough_study *study, gough_error *error) {
    gough_error_say(error, &study->units);
    const char *sentence = error->message;
    char *place = place_of(study, sentence);
    complain(verb, "%s: %s", place ? place : study->name, sentence);
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
