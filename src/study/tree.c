/* The YAML of a study as a tree with places, built from the events of libfyaml.
 *
 * Events, not libfyaml's documents: those compare every key of a mapping with every other and expand aliases. Anchors, aliases,
 * tags, further documents, deep nesting and keys that are not text end the reading here. */
#include "study/tree.h"

#include <libfyaml.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "gough/text.h"

#include "study/comma.h"

enum { DEEPEST = 12 };

typedef struct builder {
    study_messages *messages;
    study_arena *arena;
    const study_source *source;
    size_t begin;     /* offset of the parsed text in the source */
    size_t last;      /* offset after the last thing met */
    study_node *root; /* of the first document */
    study_node *open; /* innermost list or mapping not yet closed */
    study_node *key;  /* name waiting for its value */
    int depth, documents;
    bool failed;
} builder;

study_node *study_node_new(study_arena *arena, study_kind kind, study_place place) {
    study_node *node = study_arena_take(arena, sizeof *node);
    if (!node) return NULL;
    node->kind = kind;
    node->place = place;
    node->end = place.offset;
    node->text = "";
    return node;
}

void study_node_append(study_node *parent, study_node *child) {
    child->parent = parent;
    child->next = NULL;
    if (parent->last)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
    child->number = ++parent->count;
}

void study_node_remove(study_node *parent, study_node *child) {
    study_node *before = NULL;
    for (study_node *node = parent->first; node != child; node = node->next) before = node;
    if (before)
        before->next = child->next;
    else
        parent->first = child->next;
    if (parent->last == child) parent->last = before;
    parent->count--;
    for (study_node *node = child->next; node; node = node->next) node->number--;
}

study_node *study_node_child(const study_node *parent, const char *name) {
    if (!parent || parent->kind != STUDY_MAPPING) return NULL;
    for (study_node *node = parent->first; node; node = node->next)
        if (strcmp(node->key->text, name) == 0) return node;
    return NULL;
}

study_node *study_node_follow(const study_node *root, const char *path, const char **rest) {
    study_node *node = NULL;
    for (*rest = path; **rest;) {
        char name[40];
        const size_t length = strcspn(*rest, ".");
        if (length >= sizeof name) break;
        memcpy(name, *rest, length);
        name[length] = '\0';
        study_node *child = study_node_child(node ? node : root, name);
        if (!child) break;
        node = child;
        *rest += length + ((*rest)[length] == '.');
    }
    return node;
}

study_node *study_node_at(const study_node *root, const char *path) {
    const char *rest;
    study_node *node = study_node_follow(root, path, &rest);
    return *rest ? NULL : node;
}

const study_node *study_node_section(const study_node *node) {
    while (node->parent->parent) node = node->parent;
    return node;
}

bool study_node_meant(const study_node *parent, const char *name) {
    for (const study_node *node = parent->first; node; node = node->next)
        if (node->meant && strcmp(node->meant, name) == 0) return true;
    return false;
}

study_node *study_node_item(const study_node *parent, size_t n) {
    study_node *node = parent->first;
    while (node && n-- > 0) node = node->next;
    return node;
}

study_place study_node_place(const study_node *node, bool name) {
    const study_node *about = name && node->key ? node->key : node;
    study_place place = about->place;
    const bool quoted = about->kind == STUDY_SCALAR && (about->quoting == STUDY_SINGLE_QUOTED ||
                                                        about->quoting == STUDY_DOUBLE_QUOTED);
    if (quoted) place.offset--;
    return place;
}

void study_node_mark(study_node *node) {
    for (; node; node = node->parent) node->wrong = true;
}

void study_node_say(study_messages *messages, study_node *node, study_place place,
                    const char *format, ...) {
    char sentence[1000];
    va_list arguments;
    va_start(arguments, format);
    gough_sentence(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    study_say(messages, GOUGH_ERROR_INPUT, place, "%s", sentence);
    study_node_mark(node);
}

static void fail(builder *build, size_t offset, const char *sentence) {
    if (!build->failed)
        study_say(build->messages, GOUGH_ERROR_INPUT, (study_place){build->source, offset}, "%s",
                  sentence);
    build->failed = true;
}

static size_t offset_of(const builder *build, const struct fy_mark *mark) {
    const size_t offset = mark ? build->begin + mark->input_pos : build->last;
    return offset < build->source->length ? offset : build->source->length;
}

/* Refuses a node's anchor or tag. */
static void refuse_properties(builder *build, struct fy_event *event) {
    struct fy_token *anchor = fy_event_get_anchor_token(event);
    struct fy_token *tag = fy_event_get_tag_token(event);
    if (anchor) {
        fail(build, offset_of(build, fy_token_start_mark(anchor)) - 1,
             "anchors (&) are not allowed in a study");
    } else if (tag) {
        fail(build, offset_of(build, fy_token_start_mark(tag)),
             "tags (!) are not allowed in a study");
    }
}

/* Hangs a node where the parser stands: as the root, an item, a name or the value of a name. */
static void place_node(builder *build, study_node *node) {
    study_node *open = build->open;
    if (!open) {
        build->root = node;
    } else if (open->kind == STUDY_LIST) {
        study_node_append(open, node);
    } else if (build->key) {
        node->key = build->key;
        build->key = NULL;
        study_node_append(open, node);
    } else if (node->kind == STUDY_SCALAR) {
        build->key = node;
    } else {
        fail(build, node->place.offset, "a key must be a word, not a list or a mapping");
    }
}

static study_quoting quoting_of(enum fy_scalar_style style) {
    switch (style) {
    case FYSS_SINGLE_QUOTED:
        return STUDY_SINGLE_QUOTED;
    case FYSS_DOUBLE_QUOTED:
        return STUDY_DOUBLE_QUOTED;
    case FYSS_LITERAL:
    case FYSS_FOLDED:
        return STUDY_BLOCK;
    default:
        return STUDY_PLAIN;
    }
}

/* The decoded text of a scalar, piece by piece: of libfyaml 0.7, fy_token_get_text() leaks and answers NULL where escaped
 * quotes make the text longer than it reckons, and fy_token_iter_read() writes each piece over the one before. */
static bool read_text(builder *build, struct fy_token *token, study_node *node) {
    const size_t most = 2 * (node->end - node->place.offset) + 8; /* \L is 2 bytes, U+2028 is 3 */
    char *text = study_arena_take(build->arena, most + 1);
    struct fy_token_iter *reader = text ? fy_token_iter_create(token) : NULL;
    const struct fy_iter_chunk *piece = NULL;
    int error = reader ? 0 : -1;
    while (!error && (piece = fy_token_iter_chunk_next(reader, piece, &error))) {
        if (piece->len > most - node->length) { /* unreachable: the longest text fits */
            error = -1;
            break;
        }
        memcpy(text + node->length, piece->str, piece->len);
        node->length += piece->len;
    }
    fy_token_iter_destroy(reader);
    if (error) return false;
    node->text = text;
    if (strlen(text) < node->length)
        fail(build, node->place.offset, "a NUL character in this text");
    return true;
}

static void add_scalar(builder *build, struct fy_event *event) {
    struct fy_token *token = event->scalar.value;
    const struct fy_mark *start = token ? fy_token_start_mark(token) : NULL;
    const study_place place = {build->source, offset_of(build, start)};
    study_node *node = study_node_new(build->arena, STUDY_SCALAR, place);
    if (!node) return;
    node->empty = !start;
    node->in_flow = build->open && build->open->in_flow;
    if (start) {
        const size_t end = offset_of(build, fy_token_end_mark(token));
        node->end = end < place.offset ? place.offset : end;
        node->quoting = quoting_of(fy_token_scalar_style(token));
        if (!read_text(build, token, node)) {
            build->arena->exhausted = true;
            return;
        }
    }
    const bool quoted =
        node->quoting == STUDY_SINGLE_QUOTED || node->quoting == STUDY_DOUBLE_QUOTED;
    build->last = node->end + quoted;
    place_node(build, node);
}

static void open_node(builder *build, struct fy_event *event, study_kind kind) {
    const study_place place = {build->source, offset_of(build, fy_event_start_mark(event))};
    study_node *node = study_node_new(build->arena, kind, place);
    if (!node) return;
    node->in_flow = fy_event_get_node_style(event) == FYNS_FLOW;
    if (++build->depth > DEEPEST) fail(build, place.offset, "nested too deeply");
    place_node(build, node);
    node->parent = build->open;
    build->open = node;
}

static void close_node(builder *build, struct fy_event *event) {
    build->open->end = offset_of(build, fy_event_end_mark(event));
    if (build->open->in_flow) study_join_at_commas(build->arena, build->open);
    build->open = build->open->parent;
    build->depth--;
}

/* Where a document begins that no `---` announces: after the `...` that ends the one before. */
static size_t after_end_mark(const builder *build) {
    const size_t offset = offset_of(build, NULL); /* perhaps behind the line's end */
    const char *mark = strstr(build->source->text + offset - (offset > 0), "\n...");
    if (!mark) return offset; /* unreachable: only such a mark ends a document */
    return (size_t)(mark - build->source->text) + strspn(mark, ". \n\r");
}

static void take_event(builder *build, struct fy_event *event) {
    switch (event->type) {
    case FYET_DOCUMENT_START:
        if (++build->documents > 1)
            fail(build,
                 fy_event_start_mark(event) ? offset_of(build, fy_event_start_mark(event))
                                            : after_end_mark(build),
                 "a second document begins here; a study is one document");
        break;
    case FYET_ALIAS:
        fail(build, offset_of(build, fy_event_start_mark(event)) - 1,
             "aliases (*) are not allowed in a study; in a formula, write the factor first or use "
             "quotes");
        break;
    case FYET_SCALAR:
        refuse_properties(build, event);
        if (!build->failed) add_scalar(build, event);
        break;
    case FYET_MAPPING_START:
    case FYET_SEQUENCE_START:
        refuse_properties(build, event);
        if (!build->failed)
            open_node(build, event, event->type == FYET_MAPPING_START ? STUDY_MAPPING : STUDY_LIST);
        break;
    case FYET_MAPPING_END:
    case FYET_SEQUENCE_END:
        close_node(build, event);
        break;
    default:
        break;
    }
}

/* Offset of a line and column as libfyaml counts them, from 1. */
static size_t offset_of_line(const builder *build, int line, int column) {
    const study_source *source = build->source;
    size_t at = build->begin;
    for (; line > 1 && at < source->length; at++)
        if (source->text[at] == '\n' || (source->text[at] == '\r' && source->text[at + 1] != '\n'))
            line--;
    for (; column > 1; column--) {
        if (at >= source->length) break; /* unreachable: columns are within their line */
        at += gough_character_read(source->text + at, source->length - at, NULL);
    }
    return at;
}

/* What a complaint of libfyaml means to someone who wrote a study; NULL: as it stands. */
static const char *meaning(const char *complaint) {
    static const char *const known[][2] = {
        {"quoted scalar", "these quotes are not closed, or lines between them are not indented"},
        {"wrongly indented", "the lines inside braces or brackets, including the closing one, must "
                             "be indented further than their key"},
        {"tab character", "indent with spaces: YAML does not allow tabs here"},
        {"invalid multiline plain key", "a colon and a space are missing after a key"},
        {"could not find expected ':'", "a colon and a space are missing after this key"},
        {"invalid indentation",
         "the indentation of this line matches neither the keys above it nor their contents"},
        {"nested block mapping",
         "two keys on one line: put quotes around text that contains a colon"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strstr(complaint, known[i][0])) return known[i][1];
    return NULL;
}

/* What libfyaml complains of; a bracket left open is shown where it was opened. */
static void say_syntax_error(builder *build, struct fy_diag *diagnostics) {
    void *iterator = NULL;
    const struct fy_diag_error *error;
    while ((error = fy_diag_errors_iterate(diagnostics, &iterator))) {
        if (!error->msg || error->type < FYET_ERROR) continue; /* 2 unreachable: no warnings */
        const size_t at = offset_of_line(build, error->line, error->column);
        const bool at_end = at + 1 >= build->source->length;
        if (build->open && build->open->in_flow && at_end)
            fail(build, build->open->place.offset,
                 build->open->kind == STUDY_LIST ? "this bracket is not closed"
                                                 : "this brace is not closed");
        else if (meaning(error->msg))
            fail(build, at, meaning(error->msg));
        else
            study_say(build->messages, GOUGH_ERROR_INPUT, (study_place){build->source, at},
                      "this is not YAML: %s", study_printable(build->arena, error->msg));
        build->failed = true;
        return;
    }
    fail(build, build->last, "this is not YAML");
}

static void parse(builder *build, struct fy_parser *parser, struct fy_diag *diagnostics) {
    bool ended = false;
    while (!ended && !build->failed && !build->arena->exhausted) {
        struct fy_event *event = fy_parser_parse(parser);
        if (!event) break;
        take_event(build, event);
        ended = event->type == FYET_STREAM_END;
        fy_parser_event_free(parser, event);
    }
    if (!build->failed && !ended) say_syntax_error(build, diagnostics);
}

study_node *study_tree_parse(study_messages *messages, const study_source *source, size_t begin) {
    builder build = {.messages = messages,
                     .arena = messages->arena,
                     .source = source,
                     .begin = begin,
                     .last = begin};
    struct fy_diag_cfg collect;
    fy_diag_cfg_default(&collect);
    collect.fp = NULL;
    struct fy_diag *diagnostics = fy_diag_create(&collect);
    if (diagnostics) fy_diag_set_collect_errors(diagnostics, true);
    const struct fy_parse_cfg options = {.flags = FYPCF_QUIET | FYPCF_COLLECT_DIAG |
                                                  FYPCF_JSON_NONE | FYPCF_DEFAULT_VERSION_1_2,
                                         .diag = diagnostics};
    struct fy_parser *parser = diagnostics ? fy_parser_create(&options) : NULL;
    if (parser && fy_parser_set_string(parser, source->text + begin, source->length - begin) == 0)
        parse(&build, parser, diagnostics);
    else
        messages->arena->exhausted = true;
    fy_parser_destroy(parser);
    fy_diag_destroy(diagnostics);
    return build.failed || messages->arena->exhausted ? NULL : build.root;
}
