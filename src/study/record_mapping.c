/* The mapping for motion.samples as text. */
#define _GNU_SOURCE /* strcasestr */
#include "study/record_mapping.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "gough/text.h"

enum { MOST_TEXT = 2500, LONGEST_NAME = 60 };

/* A text that grows, and is cut where it is full. */
typedef struct writer {
    char text[MOST_TEXT];
    size_t used;
} writer;

static void put(writer *w, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void put(writer *w, const char *format, ...) {
    va_list list;
    va_start(list, format);
    const int wrote = vsnprintf(w->text + w->used, MOST_TEXT - w->used, format, list);
    va_end(list);
    const size_t room = MOST_TEXT - w->used;
    w->used = (size_t)wrote < room ? w->used + (size_t)wrote : MOST_TEXT - 1;
}

const char *study_mapping_columns(study_arena *arena, const study_layout *layout,
                                  const char *const *note) {
    writer w = {"", 0};
    for (size_t i = 0; i < layout->columns; i++) {
        const char *name = layout->named ? layout->name[i] : "";
        if (w.used > 1300) {
            put(&w, " … %zu", layout->columns);
            break;
        }
        put(&w, "%s%zu", i ? ", " : "", i + 1);
        if (*name) put(&w, " `%s`", study_quote(arena, name, strlen(name)));
        if (note && note[i]) put(&w, " (%s)", note[i]);
    }
    return study_arena_copy(arena, w.text, w.used);
}

/* Whether a name can stand in quotes and tells its column from the others. */
static bool is_plain(const study_layout *l, size_t column) {
    const char *name = l->named ? l->name[column] : "";
    unsigned code = 0;
    size_t same = 0;
    if (!*name || strlen(name) > LONGEST_NAME) return false;
    for (size_t at = 0, size; name[at]; at += size) {
        size = gough_character_read(name + at, strlen(name + at), &code);
        if (size == 0 || code < 0x20 || (code >= 0x7F && code < 0xA0) || code == '"' ||
            code == '\\' || code == 0xFEFF || code > 0xFFFD)
            return false;
    }
    for (size_t i = 0; i < l->columns; i++) same += strcmp(l->name[i], name) == 0;
    return same == 1;
}

static void put_column(writer *w, const study_layout *l, size_t column, gough_unit kind) {
    gough_unit unit;
    double size;
    const char *word = l->named ? l->unit[column] : "";
    const bool known = *word && gough_unit_named(word, strlen(word), &unit, &size) && unit == kind;
    if (is_plain(l, column))
        put(w, "{column: \"%s\"", l->name[column]);
    else
        put(w, "{column: %zu", column + 1);
    if (known) put(w, ", unit: \"%s\"", word);
}

/* ---- what columns may be ---- */

static bool has(const char *name, const char *part) { return strcasestr(name, part) != NULL; }

static bool is_last(const char *name, char letter) {
    const size_t length = strlen(name);
    const char last = length ? name[length - 1] : '\0',
               before = length > 1 ? name[length - 2] : ' ';
    const bool apart = before == ' ' || before == '_' || before == '.' || before == '-' ||
                       (before >= 'a' && before <= 'z' && last >= 'A' && last <= 'Z');
    return apart && (last == letter || last == letter - 'a' + 'A');
}

static int probably(const char *whole) {
    char name[LONGEST_NAME];
    gough_piece bare = {whole, whole + strlen(whole)};
    study_name_unit(&bare);
    snprintf(name, sizeof name, "%.*s", (int)(bare.end - bare.begin), bare.begin);
    static const struct {
        const char *part;
        int quantity;
    } parts[] = {{"surge", GOUGH_SURGE}, {"sway", GOUGH_SWAY},   {"heave", GOUGH_HEAVE},
                 {"roll", GOUGH_ROLL},   {"pitch", GOUGH_PITCH}, {"yaw", GOUGH_YAW},
                 {"heading", GOUGH_YAW}, {"time", STUDY_TIME},   {"epoch", STUDY_TIME},
                 {"second", STUDY_TIME}};
    const int certain = study_name_quantity(whole);
    if (certain >= 0) return certain;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (has(name, parts[i].part)) return parts[i].quantity;
    for (int c = 0; c < 3; c++)
        if (is_last(name, (char)('x' + c)) && !has(name, "acc") && !has(name, "vel") &&
            !has(name, "gyro") && !has(name, "mag"))
            return GOUGH_SURGE + c;
    return -1;
}

typedef struct guesses {
    size_t column[STUDY_CHANNELS]; /* from 1; 0: none */
    bool quaternion, matrix;
} guesses;

static bool has_all(const guesses *g, int from, int to) {
    for (int q = from; q < to; q++)
        if (!g->column[q]) return false;
    return true;
}

/* Names that are certain come first, then what names may mean. */
static guesses guess(const study_layout *l, const double *first) {
    guesses g = {{0}, false, false};
    for (int pass = 0; l->named && pass < 2; pass++)
        for (size_t i = 0; i < l->columns; i++) {
            const int q = pass ? probably(l->name[i]) : study_name_quantity(l->name[i]);
            if (q < 0 || g.column[q] || (first && isnan(first[i]))) continue;
            g.column[q] = i + 1;
        }
    g.quaternion = has_all(&g, STUDY_QUATERNION, STUDY_MATRIX);
    g.matrix = !g.quaternion && has_all(&g, STUDY_MATRIX, STUDY_QUANTITIES);
    for (int q = GOUGH_ROLL; q < STUDY_QUANTITIES; q++) {
        const bool fits = q < STUDY_QUATERNION ? !g.quaternion && !g.matrix
                          : q < STUDY_MATRIX   ? g.quaternion
                                               : g.matrix;
        if (!fits) g.column[q] = 0;
    }
    return g;
}

/* Without names: the first column of numbers is the time, the second heave. A name does not decide where no time was found. */
static void fill_gaps(const study_layout *l, const double *first, bool timed, guesses *g) {
    bool any = false;
    for (int q = 0; q < STUDY_QUANTITIES; q++) any |= g->column[q] > 0;
    for (size_t i = 0; i < l->columns; i++) {
        bool used = false;
        for (int q = 0; q < STUDY_CHANNELS; q++) used |= g->column[q] == i + 1;
        if (used || (first && isnan(first[i]))) continue;
        if (!timed && !g->column[STUDY_TIME] && !l->named && l->columns > 1)
            g->column[STUDY_TIME] = i + 1;
        else if (!any)
            g->column[GOUGH_HEAVE] = i + 1, any = true;
    }
}

/* ---- the mapping ---- */

static void put_time(writer *w, const study_layout *l, const study_record_keys *keys,
                     const guesses *g, const double *first) {
    const size_t column = g->column[STUDY_TIME];
    if (!column) {
        put(w, ", time: {step: %.9g}", keys->time_step > 0 ? keys->time_step : 0.01);
        return;
    }
    put(w, ", time: ");
    put_column(w, l, column - 1, GOUGH_UNIT_TIME);
    const double from = first ? first[column - 1] : 0;
    const bool unit = l->named && *l->unit[column - 1];
    if (from > 1e11 && !unit) put(w, ", unit: %s", from > 1e14 ? "us" : "ms");
    if (keys->from_first_time || from > 0) put(w, ", from: first");
    put(w, "}");
}

static const char *word_of(char separator) {
    return separator == ';' ? "semicolon" : separator == '\t' ? "tab" : "blanks";
}

static void put_quoted(writer *w, const char *text) {
    put(w, "'");
    for (const char *c = text; *c; c++) put(w, *c == '\'' ? "''" : "%c", *c);
    put(w, "'");
}

static guesses guess_all(const study_layout *layout, const study_record_keys *keys,
                         const double *first) {
    guesses g = guess(layout, first);
    if (keys->time_step > 0) g.column[STUDY_TIME] = 0;
    fill_gaps(layout, first, keys->time_step > 0, &g);
    return g;
}

void study_mapping_guess(const study_layout *layout, const study_record_keys *keys,
                         const double *first, int *quantity) {
    const guesses g = guess_all(layout, keys, first);
    for (size_t i = 0; i < layout->columns; i++) quantity[i] = -1;
    for (int q = 0; q < STUDY_CHANNELS; q++)
        if (g.column[q]) quantity[g.column[q] - 1] = q;
}

const char *study_columns_mapping(study_arena *arena, const study_layout *layout,
                                  const study_record_keys *keys, const char *file,
                                  const double *first) {
    writer w = {"", 0};
    const guesses g = guess_all(layout, keys, first);
    size_t count = 0;
    put(&w, "{file: ");
    put_quoted(&w, file);
    if (keys->skip) put(&w, ", skip: %zu", keys->skip);
    if (layout->separator != ',') put(&w, ", separator: %s", word_of(layout->separator));
    if (layout->decimal == ',') put(&w, ", decimal: comma");
    if (layout->comment) {
        put(&w, ", comment: ");
        put_quoted(&w, layout->comment);
    }
    put_time(&w, layout, keys, &g, first);
    put(&w, ", columns: {");
    for (int q = 0; q < STUDY_QUANTITIES; q++) {
        if (!g.column[q]) continue;
        put(&w, "%s%s: ", count++ ? ", " : "", study_quantity_name(q));
        put_column(&w, layout, g.column[q] - 1, study_quantity_unit(q));
        put(&w, "}");
    }
    put(&w, "}");
    if (g.quaternion || g.matrix) put(&w, ", rotation: %s", g.quaternion ? "quaternion" : "matrix");
    put(&w, "}");
    return study_arena_copy(arena, w.text, w.used);
}
