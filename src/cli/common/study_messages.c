/* Splits the messages of a study's reader: "file:line:column: error: sentence", the line of the file and a caret. */
#include "cli/common/study_messages.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/memory.h"
#include "cli/common/talk.h"
#include "gough/gough.h"

static const char mark[] = ": error: ";

/* Takes the last colon of a place and the number behind it off, and returns the number; -1 if the place has no such end. */
static int last_number(const char *place, size_t *length) {
    size_t at = *length;
    int value = 0, power = 1;
    while (at > 0 && place[at - 1] >= '0' && place[at - 1] <= '9' && *length - at < 8) {
        value += power * (place[--at] - '0');
        power *= 10;
    }
    if (at == *length || at == 0 || place[at - 1] != ':') return -1;
    *length = at - 1;
    return value;
}

json_t *json_shown(const char *text, size_t length) {
    json_t *words = json_stringn(text, length);
    const size_t size = gough_text_show(text, length, NULL, 0) + 1;
    char *shown = words ? NULL : allocate(size);
    if (shown) {
        gough_text_show(text, length, shown, size);
        words = json_string(shown);
    }
    free(shown);
    return words;
}

void json_set_place(json_t *object, const char *place, size_t length) {
    static const char setting[] = "--set ";
    const size_t skipped = sizeof setting - 1;
    if (length >= skipped && memcmp(place, setting, skipped) == 0) {
        json_object_set_new(object, "setting", json_shown(place + skipped, length - skipped));
        return;
    }
    const int column = last_number(place, &length);
    const int line = column < 0 ? -1 : last_number(place, &length);
    json_object_set_new(object, "file", json_shown(place, length));
    if (line < 0) return;
    json_object_set_new(object, "line", json_integer(line));
    json_object_set_new(object, "column", json_integer(column));
}

size_t leading_place(const char *sentence) {
    for (const char *colon = strstr(sentence, ": "); colon; colon = strstr(colon + 1, ": ")) {
        size_t length = (size_t)(colon - sentence);
        if (last_number(sentence, &length) >= 0 && last_number(sentence, &length) >= 0)
            return (size_t)(colon - sentence);
    }
    return 0;
}

/* The end of a line, and the beginning of the next. */
static const char *line_end(const char *line) { return line + strcspn(line, "\n"); }
static const char *next_line(const char *line) {
    line = line_end(line);
    return *line ? line + 1 : line;
}

static bool is_caret(const char *line) {
    const size_t blanks = strspn(line, " \t"), carets = strspn(line + blanks, "^");
    return carets > 0 && line + blanks + carets == line_end(line);
}

/* The mark within this line, or NULL. */
static const char *find_mark(const char *line) {
    const char *found = strstr(line, mark);
    return found && found < line_end(line) ? found : NULL;
}

static void say_in_json(const char *verb, const char *line, const char *found) {
    const char *sentence = found + sizeof mark - 1;
    json_t *error = json_object();
    json_set_place(error, line, (size_t)(found - line));
    json_object_set_new(error, "message",
                        json_shown(sentence, (size_t)(line_end(line) - sentence)));
    say_json("error", verb, error);
}

static void say_in_colour(const char *line, const char *found) {
    fprintf(stderr, "%.*s: \033[1;31merror:\033[0m %.*s\n", (int)(found - line), line,
            (int)(line_end(line) - found - (int)sizeof mark + 1), found + sizeof mark - 1);
}

void say_study_messages(const char *verb, char *messages) {
    const bool colour = colourful(stderr), json = talks_in_json();
    fflush(stdout);
    for (const char *line = messages; line && *line;) {
        const char *found = find_mark(line);
        if (found && json)
            say_in_json(verb, line, found);
        else if (found && colour)
            say_in_colour(line, found);
        else if (!json)
            fprintf(stderr, "%.*s\n", (int)(line_end(line) - line), line);
        line = next_line(line);
        if (!found || !is_caret(next_line(line))) continue;
        /* the line of the file and its caret, which may hold anything */
        for (int n = 0; n < 2; n++, line = next_line(line))
            if (!json) fprintf(stderr, "%.*s\n", (int)(line_end(line) - line), line);
    }
    gough_study_free_messages(messages);
}
