/* Which column of a record is what. Names are certain if they are t, time or a component, with a unit that is known or without
 * one; the study's mapping decides before them. */
#include "study/record_columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/keys.h"
#include "study/record_mapping.h"
#include "study/value.h"

typedef struct chooser {
    study_messages *messages;
    const study_layout *layout;
    const study_record_keys *keys;
    const gough_units *units;
    study_columns *columns;
    bool wrong;
} chooser;

static gough_piece piece_of(const char *text) { return (gough_piece){text, text + strlen(text)}; }

/* ---- what names mean ---- */

int study_name_quantity(const char *text) {
    gough_piece name = piece_of(text);
    study_name_unit(&name);
    if (study_name_is(name, "t") || study_name_is(name, "time")) return STUDY_TIME;
    for (int q = 0; q < STUDY_QUANTITIES; q++)
        if (study_name_is(name, study_quantity_name(q))) return q;
    return -1;
}

/* ---- units ---- */

double study_channel_convert(const study_channel *channel, double cell) {
    return channel->scale * (cell * channel->times / channel->over) + channel->offset;
}

static const char *unit_kind(gough_unit unit) {
    return unit == GOUGH_UNIT_LENGTH          ? "length"
           : unit == GOUGH_UNIT_ANGLE         ? "angle"
           : unit == GOUGH_UNIT_TIME          ? "time"
           : unit == GOUGH_UNIT_SPEED         ? "speed"
           : unit == GOUGH_UNIT_ACCELERATION  ? "acceleration"
           : unit == GOUGH_UNIT_ANGULAR_SPEED ? "angular speed"
                                              : "angular acceleration";
}

/* Factor from a unit to that of the study; a thousandth is divided by a thousand, so that 50 mm are 0.05 m to the last digit. */
static void set_factor(study_channel *channel, const gough_units *units, gough_unit unit,
                       double size) {
    const double factor = size / gough_unit_read(units, unit, 1), inverse = 1 / factor;
    const bool whole = !(fabs(inverse - rint(inverse)) > 1e-12 * inverse);
    channel->times = whole ? 1 : factor;
    channel->over = whole ? rint(inverse) : 1;
    /* a factor such as 1000 from m to mm is whole up to rounding */
    if (!whole && !(fabs(factor - rint(factor)) > 1e-12 * factor)) channel->times = rint(factor);
}

/* Whether the word is a unit of the quantity; else what is wrong, in `why`. */
static bool choose_unit(const chooser *c, study_channel *channel, int quantity, const char *word,
                        char why[200]) {
    const gough_unit wanted = study_quantity_unit(quantity);
    gough_unit unit;
    double size;
    channel->unit = word;
    if (!*word) return true;
    if (!gough_unit_named(word, strlen(word), &unit, &size)) {
        snprintf(why, 200, "is no unit that gough knows; units of %s are %s",
                 unit_kind(wanted == GOUGH_UNIT_NONE ? GOUGH_UNIT_LENGTH : wanted),
                 wanted == GOUGH_UNIT_ANGLE  ? "deg, rad, mrad and arcsec"
                 : wanted == GOUGH_UNIT_TIME ? "s, ms, us, min and h"
                                             : "m, cm, mm, um, in and ft");
        return false;
    }
    if (wanted == GOUGH_UNIT_NONE) {
        snprintf(why, 200, "is a unit, but the columns of a rotation are numbers without one");
        return false;
    }
    if (unit != wanted) {
        snprintf(why, 200, "is a unit of %s, but %s is %s %s", unit_kind(unit),
                 study_quantity_name(quantity), wanted == GOUGH_UNIT_ANGLE ? "an" : "a",
                 unit_kind(wanted));
        return false;
    }
    if (c->units->dimensionless && unit != GOUGH_UNIT_ANGLE) {
        snprintf(why, 200, "has no size in a study without dimensions; use `scale`");
        return false;
    }
    set_factor(channel, c->units, unit, size);
    return true;
}

/* ---- by the keys ---- */

static void say_at(chooser *c, study_node *node, const char *sentence) {
    c->wrong = true;
    study_node_say(c->messages, node, study_node_place(node, false), "%s", sentence);
}

/* The column of that name; SIZE_MAX, and a sentence, if no column or several columns have the name. */
static size_t column_named(chooser *c, study_node *node) {
    size_t exact = SIZE_MAX, found = SIZE_MAX, matches = 0, exacts = 0;
    const study_layout *l = c->layout;
    study_arena *arena = c->messages->arena;
    for (size_t i = 0; l->named && i < l->columns; i++) {
        if (strcmp(l->name[i], node->text) == 0) exact = i, exacts++;
        if (study_name_is(piece_of(l->name[i]), node->text)) found = i, matches++;
    }
    if (exacts == 1) return exact;
    if (matches == 1) return found;
    const char *nearest =
        l->named && matches == 0 ? study_nearest(node->text, l->name, l->columns) : NULL;
    const char *list = study_mapping_columns(arena, l, NULL);
    c->wrong = true;
    if (!list) return SIZE_MAX;
    study_node_say(c->messages, node, study_node_place(node, false),
                   "the record has %s `%s`%s%s%s; its columns are %s%s",
                   matches ? "several columns" : "no column",
                   study_quote(arena, node->text, node->length), nearest ? "; did you mean `" : "",
                   nearest ? study_quote(arena, nearest, strlen(nearest)) : "", nearest ? "`?" : "",
                   list, matches ? "; give its number" : "");
    return SIZE_MAX;
}

static void choose_by_key(chooser *c, int quantity) {
    const study_column_keys *own = &c->keys->channel[quantity];
    study_channel *channel = &c->columns->channel[quantity];
    char why[200], sentence[300];
    if (!own->column) return; /* of the times; all others were checked to have one */
    const size_t column = own->number ? own->number - 1 : column_named(c, own->column);
    if (column == SIZE_MAX) return;
    if (column >= c->layout->columns) {
        snprintf(sentence, sizeof sentence, "the record has %zu column%s, numbered from 1",
                 c->layout->columns, c->layout->columns == 1 ? "" : "s");
        say_at(c, own->column, sentence);
        return;
    }
    channel->used = true;
    channel->column = column;
    channel->scale = own->scale;
    channel->offset = own->offset;
    const char *in_file = c->layout->named ? c->layout->unit[column] : "";
    const char *word = own->unit ? own->unit->text : in_file;
    gough_unit any;
    double size;
    /* what stands in brackets behind a name need not be a unit, if the study says what the column is */
    if (!own->unit && *word &&
        (!gough_unit_named(word, strlen(word), &any, &size) ||
         study_quantity_unit(quantity) == GOUGH_UNIT_NONE))
        word = "";
    if (choose_unit(c, channel, quantity, word, why)) return;
    snprintf(sentence, sizeof sentence, "`%s` %s",
             study_quote(c->messages->arena, word, strlen(word)), why);
    say_at(c, own->unit ? own->unit : own->column, sentence);
}

/* ---- by names ---- */

/* What is not certain about a column that no key names; NULL: it is certain. */
static const char *doubt(const chooser *c, size_t i, char why[260]) {
    const study_layout *l = c->layout;
    const int quantity = study_name_quantity(l->name[i]);
    const bool time_only = c->keys->columns;
    char unit[200];
    study_channel *channel = quantity < 0 ? NULL : &c->columns->channel[quantity];
    if (time_only && quantity != STUDY_TIME) return NULL;
    if (quantity < 0) {
        const char *names[STUDY_CHANNELS];
        for (int q = 0; q < STUDY_CHANNELS; q++) names[q] = study_quantity_name(q);
        const char *near = study_nearest(l->name[i], names, GOUGH_COMPONENTS);
        snprintf(why, 260, near ? "did you mean `%s`?" : "unknown", near);
        return why;
    }
    const bool rotation = quantity >= GOUGH_ROLL && quantity < STUDY_QUANTITIES;
    const unsigned kind = quantity < STUDY_QUATERNION ? 0 : quantity < STUDY_MATRIX ? 1 : 2;
    if (rotation && kind != (unsigned)c->keys->rotation) return "part of a rotation";
    if (quantity == STUDY_TIME && (c->keys->time_step > 0 || c->keys->channel[STUDY_TIME].column))
        return c->keys->time_step > 0 ? "times beside time.step" : NULL;
    if (channel->used) return "a second one of that name";
    channel->used = true;
    channel->column = i;
    if (choose_unit(c, channel, quantity, l->unit[i], unit)) return NULL;
    snprintf(why, 260, "`%s` %s", study_quote(c->messages->arena, l->unit[i], strlen(l->unit[i])),
             unit);
    return why;
}

/* Columns that no key names, by their names; notes[i] receives what is not certain. Whether all are certain. */
static bool choose_by_names(chooser *c, const char **notes, const char **at) {
    const study_layout *l = c->layout;
    char why[260];
    bool certain = true;
    for (size_t i = 0; l->named && i < l->columns; i++) {
        const char *what = doubt(c, i, why);
        if (!what) continue;
        if (certain) *at = l->place_of[i];
        certain = false;
        notes[i] = study_arena_copy(c->messages->arena, what, strlen(what));
    }
    return certain;
}

/* ---- both ---- */

static bool moves(const study_columns *columns) {
    for (int q = 0; q < STUDY_QUANTITIES; q++)
        if (columns->channel[q].used) return true;
    return false;
}

/* One error about all that is not certain, with what to write. */
static void say_uncertain(chooser *c, const char *file, const double *first,
                          const char *const *notes, const char *at) {
    study_arena *arena = c->messages->arena;
    const study_layout *l = c->layout;
    const bool timed = c->keys->time_step > 0 || c->columns->channel[STUDY_TIME].used;
    const char *mapping = study_columns_mapping(arena, l, c->keys, file, first);
    const char *list = study_mapping_columns(arena, l, notes);
    study_place place = l->place;
    if (at) place.offset = (size_t)(at - place.source->text);
    c->wrong = true;
    if (!mapping || !list) return;
    const char *lack = !l->named ? "no row names the columns of this record"
                       : !timed  ? "the column t, the time, is missing"
                       : moves(c->columns)
                           ? "not all columns of this record are certain"
                           : "there is no motion: a column such as heave is needed besides t";
    study_say(c->messages, GOUGH_ERROR_INPUT, place,
              "%s; its columns are %s; say which are which in `motion`, as in samples: %s", lack,
              list, mapping);
}

/* A quaternion has four columns, a matrix nine, also where names alone choose them. */
static void check_rotation(chooser *c) {
    const bool matrix = c->keys->rotation == STUDY_BY_MATRIX;
    const int from = matrix ? STUDY_MATRIX : STUDY_QUATERNION,
              to = matrix ? STUDY_QUANTITIES : STUDY_MATRIX;
    if (c->keys->rotation == STUDY_ANGLES || c->wrong) return;
    for (int q = from; q < to; q++) {
        if (c->columns->channel[q].used) continue;
        c->wrong = true;
        study_say(c->messages, GOUGH_ERROR_INPUT, c->layout->place,
                  "the record lacks the column `%s`: a rotation by %s has the columns %s",
                  study_quantity_name(q), matrix ? "matrix" : "quaternion",
                  matrix ? "r11, r12, r13, r21 … r33" : "qw, qx, qy, qz");
        return;
    }
}

static void finish(study_columns *columns) {
    for (int q = 0; q < STUDY_CHANNELS; q++) {
        study_channel *channel = &columns->channel[q];
        channel->direct = channel->times == 1 && channel->over == 1 && channel->scale == 1 &&
                          !(fabs(channel->offset) > 0);
    }
}

bool study_columns_choose(study_messages *messages, const study_layout *layout,
                          const study_record_keys *keys, const gough_units *units, const char *file,
                          const double *first, study_columns *columns) {
    chooser c = {messages, layout, keys, units, columns, false};
    const char *at = NULL;
    *columns = (study_columns){.rotation = (unsigned)keys->rotation};
    for (int q = 0; q < STUDY_CHANNELS; q++)
        columns->channel[q] = (study_channel){.unit = "", .times = 1, .over = 1, .scale = 1};
    for (int q = 0; q < STUDY_CHANNELS; q++)
        if (keys->channel[q].node) choose_by_key(&c, q);
    if (c.wrong || messages->arena->exhausted) return false;
    const bool timed = keys->time_step > 0 || columns->channel[STUDY_TIME].used;
    const char **notes = study_arena_take(messages->arena, layout->columns * sizeof *notes);
    if (!notes) return false;
    const bool certain = (keys->columns && timed) || choose_by_names(&c, notes, &at);
    const bool time = keys->time_step > 0 || columns->channel[STUDY_TIME].used;
    if (!certain || !time || !moves(columns)) say_uncertain(&c, file, first, notes, at);
    check_rotation(&c);
    finish(columns);
    return !c.wrong;
}
