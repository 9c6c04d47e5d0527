/* Formulas in braces or brackets that YAML has cut at a comma: found by their parentheses and joined. */
#include "study/comma.h"

#include <string.h>

#include "gough/model.h"

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/* Parentheses open after a text, `open` being open before; −1 where one closes that was not open. */
static int open_after(const study_node *node, int open) {
    for (size_t i = 0; i < node->length && open >= 0; i++)
        open += (node->text[i] == '(') - (node->text[i] == ')');
    return open;
}

static bool is_plain(const study_node *node) {
    return node->kind == STUDY_SCALAR && node->quoting == STUDY_PLAIN && node->length > 0;
}

/* The text of an item, or of a key without a value; NULL for anything else. */
static const study_node *piece_of(const study_node *parent, const study_node *node) {
    const bool item = parent->kind == STUDY_LIST;
    if (!item && !node->empty) return NULL;
    const study_node *piece = item ? node : node->key;
    return is_plain(piece) ? piece : NULL;
}

/* Whether between two texts, one after the other in a source, there is one comma and otherwise blanks. */
static bool only_a_comma(const study_node *left, const study_node *right) {
    const study_source *source = left->place.source;
    int commas = 0;
    for (size_t at = left->end; at < right->place.offset; at++) {
        if (source->text[at] == ',')
            commas++;
        else if (!is_blank(source->text[at]))
            return false;
    }
    return commas == 1;
}

/* Whether a comma or the end of the list or mapping follows a text, and no colon. */
static bool ends_there(const study_node *piece) {
    const study_source *source = piece->place.source;
    size_t at = piece->end;
    while (is_blank(source->text[at])) at++;
    return memchr(",]}", source->text[at], 3) != NULL;
}

/* The last of the nodes that a cut text goes on in; NULL if it cannot be told without doubt. No formula has more commas than
 * operations, so the search is short however many nodes there are. */
static const study_node *last_piece(const study_node *parent, const study_node *first) {
    const study_node *left = first;
    int open = open_after(first, 0);
    if (open <= 0) return NULL;
    int commas = 0;
    for (const study_node *node = first->next; node; node = node->next) {
        const study_node *piece = piece_of(parent, node);
        if (++commas > GOUGH_FORMULA_OPERATIONS) return NULL;
        if (!piece || !only_a_comma(left, piece) || !ends_there(piece)) return NULL;
        open = open_after(piece, open);
        if (open < 0) return NULL;
        if (open == 0) return node;
        left = piece;
    }
    return NULL;
}

/* The text as it stands in the file, where line ends count as blanks. */
static void join(study_arena *arena, study_node *parent, study_node *first,
                 const study_node *last) {
    const size_t end = piece_of(parent, last)->end;
    char *text = study_arena_copy(arena, first->place.source->text + first->place.offset,
                                  end - first->place.offset);
    if (!text) return;
    for (bool all = false; !all;) {
        all = first->next == last;
        study_node_remove(parent, first->next);
    }
    for (char *at = text; *at; at++)
        if (is_blank(*at)) *at = ' ';
    first->text = text;
    first->length = strlen(text);
    first->end = end;
}

void study_join_at_commas(study_arena *arena, study_node *parent) {
    for (study_node *node = parent->first; node; node = node->next) {
        const study_node *last = is_plain(node) ? last_piece(parent, node) : NULL;
        if (last) join(arena, parent, node, last);
    }
}
