/* The keys of motion.samples as a struct. */
#include "study/record_keys.h"

#include <assert.h>
#include <string.h>

#include "study/value.h"

const char *study_quantity_name(int quantity) {
    static const char *const names[] = {[STUDY_QUATERNION] = "qw",
                                        "qx",
                                        "qy",
                                        "qz",
                                        [STUDY_MATRIX] = "r11",
                                        "r12",
                                        "r13",
                                        "r21",
                                        "r22",
                                        "r23",
                                        "r31",
                                        "r32",
                                        "r33",
                                        [STUDY_TIME] = "t"};
    return quantity < GOUGH_COMPONENTS ? gough_component_name(quantity) : names[quantity];
}

int study_quantity_of(const char *name) {
    for (int q = 0; q < STUDY_QUANTITIES; q++)
        if (strcmp(study_quantity_name(q), name) == 0) return q;
    return -1;
}

gough_unit study_quantity_unit(int quantity) {
    return quantity < GOUGH_ROLL         ? GOUGH_UNIT_LENGTH
           : quantity < GOUGH_COMPONENTS ? GOUGH_UNIT_ANGLE
           : quantity == STUDY_TIME      ? GOUGH_UNIT_TIME
                                         : GOUGH_UNIT_NONE;
}

study_record_keys study_record_keys_none(study_node *samples, gough_order order) {
    study_record_keys keys = {.node = samples, .order = order};
    for (int c = 0; c < STUDY_CHANNELS; c++) keys.channel[c].scale = 1;
    return keys;
}

/* Keys are read where nothing in the mapping was wrong when it was checked. */
static double number_or(const study_node *node, double usual) {
    return node ? study_number(node) : usual;
}

/* A name or number of a column. */
static void read_column(study_messages *messages, study_column_keys *own, study_node *node) {
    if (!node) return;
    if (node->length == 0) {
        study_say_shape(messages, node, "the name or number of a column");
        return;
    }
    own->column = node;
    const bool digits = strspn(node->text, "0123456789") == node->length;
    if (node->quoting != STUDY_PLAIN || !digits || node->length > 6) return;
    for (const char *c = node->text; *c; c++) own->number = 10 * own->number + (size_t)(*c - '0');
}

static void read_channel(study_messages *messages, study_column_keys *own, study_node *node) {
    own->node = node;
    if (!node) return;
    if (node->kind == STUDY_SCALAR) {
        read_column(messages, own, node);
        return;
    }
    read_column(messages, own, study_node_child(node, "column"));
    own->unit = study_node_child(node, "unit");
    own->scale = number_or(study_node_child(node, "scale"), 1);
    own->offset = number_or(study_node_child(node, "offset"), 0);
}

static bool is_true(const study_node *node) { return node && strcmp(node->text, "true") == 0; }

/* The place of the key's word among the characters; 0 if it is not given. */
static char character_of(const study_node *node, const char *words, const char *characters) {
    return node ? characters[study_choice_index(words, node->text)] : '\0';
}

/* The kind of rotation that the columns have, or the key says; columns of several kinds are an error. */
static void read_rotation(study_messages *messages, study_record_keys *keys) {
    static const char *const words[] = {"angles", "quaternion", "matrix"};
    const study_node *node = study_node_child(keys->node, "rotation");
    const study_node *first = NULL;
    if (node)
        keys->rotation = (unsigned)study_choice_index("angles, quaternion, matrix", node->text);
    for (int q = GOUGH_ROLL; q < STUDY_QUANTITIES; q++) {
        study_node *own = keys->channel[q].node;
        const unsigned kind = q < STUDY_QUATERNION ? 0 : q < STUDY_MATRIX ? 1 : 2;
        if (!own) continue;
        if (!first && !node) keys->rotation = kind;
        if (!first) first = own;
        if (kind == (unsigned)keys->rotation) continue;
        study_node_say(messages, own, study_node_place(own, true),
                       "`%s` is a column of rotations by %s, but %s are by %s; give one kind",
                       own->key->text, words[kind], node ? "those of `rotation`" : "others",
                       words[keys->rotation]);
        return;
    }
}

/* A quaternion has four columns, a matrix nine. */
static void check_whole(study_messages *messages, const study_record_keys *keys) {
    const int from = keys->rotation == STUDY_BY_QUATERNION ? STUDY_QUATERNION : STUDY_MATRIX;
    const int to = from == STUDY_QUATERNION ? STUDY_MATRIX : STUDY_QUANTITIES;
    study_node *columns = study_node_child(keys->node, "columns");
    if (keys->rotation == STUDY_ANGLES || !columns || columns->wrong) return;
    for (int q = from; q < to; q++) {
        if (keys->channel[q].node) continue;
        study_node_say(messages, columns, study_node_place(columns, true),
                       "`motion.samples.columns` lacks `%s`: a rotation by %s has the columns %s",
                       study_quantity_name(q), from == STUDY_MATRIX ? "matrix" : "quaternion",
                       from == STUDY_MATRIX ? "r11, r12, r13, r21 … r33" : "qw, qx, qy, qz");
        return;
    }
}

static void read_time(study_messages *messages, study_record_keys *keys) {
    study_node *time = study_node_child(keys->node, "time");
    study_column_keys *own = &keys->channel[STUDY_TIME];
    read_channel(messages, own, time);
    if (!time || time->kind != STUDY_MAPPING) return;
    study_node *step = study_node_child(time, "step");
    keys->from_first_time = study_node_child(time, "from") != NULL;
    keys->time_step = number_or(step, 0);
    if (step && (own->column || own->unit || keys->from_first_time))
        study_node_say(messages, step, study_node_place(step, true),
                       "`motion.samples.time` has both `step` and `%s`; `step` is for records "
                       "without a column of times",
                       own->column ? "column"
                       : own->unit ? "unit"
                                   : "from");
}

study_record_keys study_record_keys_read(study_messages *messages, study_node *samples,
                                         gough_order order) {
    study_record_keys keys = study_record_keys_none(samples, order);
    const study_node *columns = study_node_child(samples, "columns");
    const study_node *comment = study_node_child(samples, "comment");
    const study_node *own_order = study_node_child(samples, "order");
    keys.skip = (size_t)number_or(study_node_child(samples, "skip"), 0);
    keys.comment = comment ? comment->text : NULL;
    keys.separator = character_of(study_node_child(samples, "separator"),
                                  "comma, semicolon, tab, blanks", ",;\t ");
    keys.decimal = character_of(study_node_child(samples, "decimal"), "point, comma", ".,");
    keys.from_first = is_true(study_node_child(samples, "from_first"));
    if (own_order) keys.order = strcmp(own_order->text, "xyz") == 0 ? GOUGH_XYZ : GOUGH_ZYX;
    read_time(messages, &keys);
    for (study_node *own = columns ? columns->first : NULL; own; own = own->next) {
        const int quantity = study_quantity_of(own->key->text);
        assert(quantity >= 0);
        keys.columns = true;
        read_channel(messages, &keys.channel[quantity], own);
    }
    read_rotation(messages, &keys);
    check_whole(messages, &keys);
    return keys;
}
