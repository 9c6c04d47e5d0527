/* Scalars of a study: numbers, words, formulas, and what is wrong with them. */
#define _POSIX_C_SOURCE 200809L /* strncasecmp */
#include "study/value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "gough/text.h"
#include "study/chosen_units.h"
#include "study/fill.h"

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static bool is_infinity_or_nan(const char *text, size_t length) {
    static const char *const words[] = {".inf", "inf", ".nan", "nan", "infinity"};
    if (length && (text[0] == '+' || text[0] == '-')) text++, length--;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strlen(words[i]) == length && strncasecmp(text, words[i], length) == 0) return true;
    return false;
}

study_decimal study_decimal_read(const char *text, size_t length, double *value, size_t *rest) {
    *value = NAN;
    *rest = gough_decimal_read(text, length, value);
    if (*rest == 0) return is_infinity_or_nan(text, length) ? STUDY_NOT_FINITE : STUDY_NO_DECIMAL;
    if (*rest < length) return STUDY_DECIMAL_AND_MORE;
    return isfinite(*value) ? STUDY_DECIMAL : STUDY_NOT_FINITE;
}

bool study_is_least(const study_node *node) {
    return node && node->kind == STUDY_SCALAR && strcmp(node->text, "least") == 0;
}

double study_number(const study_node *node) {
    double value = NAN;
    size_t rest;
    if (node) study_decimal_read(node->text, node->length, &value, &rest);
    return value;
}

const char *study_node_path(study_arena *arena, const study_node *node) {
    const bool top = !node->parent->parent;
    const char *parent = top ? "" : study_node_path(arena, node->parent);
    char number[32];
    snprintf(number, sizeof number, "%zu", node->number);
    const char *name = node->key ? study_quote(arena, node->key->text, node->key->length) : number;
    char *path = study_arena_take(arena, strlen(parent) + strlen(name) + 2);
    if (!path) return "";
    sprintf(path, "%s%s%s", parent, top ? "" : ".", name);
    return path;
}

/* What stands there, for "found …". */
static const char *found(study_arena *arena, const study_node *node) {
    if (node->kind == STUDY_LIST) return node->count ? "a list" : "an empty list";
    if (node->kind == STUDY_MAPPING) return node->count ? "a mapping" : "an empty mapping";
    if (node->length == 0) return "nothing";
    const char *quote = study_quote(arena, node->text, node->length);
    char *text = study_arena_take(arena, strlen(quote) + 3);
    if (text) sprintf(text, "`%s`", quote);
    return text ? text : "";
}

void study_say_shape(study_messages *messages, study_node *node, const char *phrase) {
    study_node_say(messages, node, study_node_place(node, node->empty), "`%s` must be %s, found %s",
                   study_node_path(messages->arena, node), phrase, found(messages->arena, node));
}

/* Why a scalar is not a plain decimal number. */
static void say_no_number(study_messages *messages, study_node *node, size_t rest) {
    const char *path = study_node_path(messages->arena, node);
    const char *text = study_quote(messages->arena, node->text, node->length);
    const char *more = node->text + rest;
    const study_place place = study_node_place(node, node->empty);
    const study_place there = study_scalar_place(node, rest);
    if (rest == 0)
        study_node_say(messages, node, place, "`%s` must be a number such as 1.5, found %s", path,
                       found(messages->arena, node));
    else if ((more[0] == 'x' || more[0] == 'X' || more[0] == 'o' || more[0] == '_'))
        study_node_say(messages, node, there,
                       "`%s` must be a decimal number such as 1000 or 1e3, found `%s`", path, text);
    else if (more[0] == ',' && is_digit(more[1]))
        study_node_say(messages, node, there,
                       "`%s` must be a number with a decimal point, found a comma in `%s`", path,
                       text);
    else if (more[strspn(more, " ")] && strchr("+-*/^(", more[strspn(more, " ")]))
        study_node_say(
            messages, node, there,
            "`%s` must be a number, found `%s`; only motion and disturbance take formulas", path,
            text);
    else
        study_node_say(messages, node, there, "`%s` has text after the number: `%s`; remove it",
                       path, study_quote(messages->arena, more, strlen(more)));
}

bool study_check_number(study_messages *messages, study_node *node, const gough_bound *bound) {
    if (node->kind != STUDY_SCALAR || node->length == 0) {
        study_say_shape(messages, node, "a number");
        return false;
    }
    const char *path = study_node_path(messages->arena, node);
    double value;
    size_t rest;
    const study_decimal kind = study_decimal_read(node->text, node->length, &value, &rest);
    if (kind == STUDY_NOT_FINITE) {
        study_node_say(messages, node, study_node_place(node, false),
                       "`%s` must be a finite number, found `%s`", path,
                       study_quote(messages->arena, node->text, node->length));
        return false;
    }
    if (kind == STUDY_NO_DECIMAL || kind == STUDY_DECIMAL_AND_MORE) {
        say_no_number(messages, node, rest);
        return false;
    }
    if (node->quoting != STUDY_PLAIN) {
        study_node_say(messages, node, study_node_place(node, false),
                       "`%s` must be a number, found text; remove the quotes", path);
        return false;
    }
    if (value > bound->least && value <= bound->greatest) return true;
    if (!bound->open && value >= bound->least && value <= bound->greatest) return true;
    study_node_say(messages, node, study_node_place(node, false), "`%s` must be %s, found %s", path,
                   bound->rule, study_quote(messages->arena, node->text, node->length));
    return false;
}

/* A formula in braces or brackets that its comma has cut in two. */
static bool is_cut(const study_node *node) {
    if (!node->in_flow || node->quoting != STUDY_PLAIN) return false;
    const study_source *source = node->place.source;
    size_t at = node->end;
    while (source->text[at] == ' ' || source->text[at] == '\t') at++;
    int open = 0;
    for (size_t i = 0; i < node->length; i++)
        open += (node->text[i] == '(') - (node->text[i] == ')');
    return open > 0 && source->text[at] == ',';
}

bool study_check_formula(study_messages *messages, study_node *node) {
    if (node->kind != STUDY_SCALAR || node->length == 0) {
        study_say_shape(messages, node, "a formula in t such as 0.1*sin(t)");
        return false;
    }
    const char *path = study_node_path(messages->arena, node);
    double value;
    size_t rest, offset = 0;
    if (study_decimal_read(node->text, node->length, &value, &rest) == STUDY_NOT_FINITE) {
        study_node_say(messages, node, study_node_place(node, false),
                       "`%s` must be finite, found `%s`", path,
                       study_quote(messages->arena, node->text, node->length));
        return false;
    }
    gough_formula formula;
    gough_error error = {.message = ""};
    if (is_cut(node)) {
        study_node_say(messages, node, study_scalar_place(node, node->length),
                       "YAML splits the formula `%s` at this comma: inside braces or brackets, put "
                       "it in quotes, as in \"atan2(t, 1)\"",
                       path);
        return false;
    }
    const gough_units units = study_units_of_node(node);
    if (study_formula(node, &units, GOUGH_UNIT_LENGTH, &formula, &offset, &error) == GOUGH_OK)
        return true;
    study_node_say(messages, node, study_scalar_place(node, offset), "`%s`: %s", path,
                   study_printable(messages->arena, error.message));
    return false;
}

gough_shape study_shape_of(const study_node *node, const gough_key *key) {
    const bool in_list = strncmp(key->path, "actuators.", 10) == 0 && !node->parent->key;
    if (!in_list) return key->shape;
    return key->shape == GOUGH_SHAPE_NUMBER_OR_SIX  ? GOUGH_SHAPE_NUMBER
           : key->shape == GOUGH_SHAPE_RANGE_OR_SIX ? GOUGH_SHAPE_RANGE
                                                    : key->shape;
}

int study_choice_index(const char *choices, const char *word) {
    for (int index = 0; *choices; index++) {
        const size_t length = strcspn(choices, ",");
        if (strlen(word) == length && strncmp(choices, word, length) == 0) return index;
        choices += length;
        choices += strspn(choices, ", ");
    }
    return -1;
}

bool study_check_choice(study_messages *messages, study_node *node, const char *choices) {
    if (node->kind == STUDY_SCALAR) {
        if (study_choice_index(choices, node->text) >= 0) return true;
        const char *words[16];
        char all[200];
        size_t count = 0;
        snprintf(all, sizeof all, "%s", choices);
        for (char *word = all, *end; word; word = end) {
            end = strstr(word, ", ");
            if (end) *end = '\0', end += 2;
            words[count++] = word;
        }
        const char *nearest = study_nearest(node->text, words, count);
        study_node_say(messages, node, study_node_place(node, node->empty),
                       "`%s` must be one of %s, found %s%s%s%s",
                       study_node_path(messages->arena, node), choices,
                       found(messages->arena, node), nearest ? "; did you mean `" : "",
                       nearest ? nearest : "", nearest ? "`?" : "");
        return false;
    }
    char phrase[240];
    snprintf(phrase, sizeof phrase, "one of %s", choices);
    study_say_shape(messages, node, phrase);
    return false;
}

bool study_check_text(study_messages *messages, study_node *node, gough_shape shape) {
    if (node->kind != STUDY_SCALAR || (shape == GOUGH_SHAPE_FILE && node->length == 0)) {
        study_say_shape(messages, node, study_shape_phrase(shape));
        return false;
    }
    unsigned code = 0;
    for (size_t at = 0, size; at < node->length; at += size) {
        size = gough_character_read(node->text + at, node->length - at, &code);
        const bool blank = shape == GOUGH_SHAPE_TEXT && (code == '\n' || code == '\t');
        if (blank || (code >= 0x20 && code < 0x7F) || code >= 0xA0) continue;
        study_node_say(messages, node, study_scalar_place(node, at),
                       "control character U+%04X in `%s`", code,
                       study_node_path(messages->arena, node));
        return false;
    }
    return true;
}
