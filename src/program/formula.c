/* Formulas in t: text to the postfix operations that program.h evaluates. An operator-precedence
 * parser with two bounded stacks: operators and parentheses that wait, and for each value on the
 * evaluation stack where its operations begin and whether it depends on t. No recursion, no
 * allocation, no locale. */
#define NUMBER_DOUBLE
#include "program/program.h"

#include <string.h>

#include "base/assert.h"
#include "gough/sizes.h"
#include "gough/text.h"
#include "program/formula_names.h"

enum {
    WAITING = 4 * GOUGH_FORMULA_DEPTH, /* operators and parentheses open at once */
    OPEN = -1                          /* a parenthesis that is no function's */
};

/* An operator, function or parenthesis whose operands are not complete. */
typedef struct waiting {
    int code;      /* formula_code, or OPEN */
    bool opening;  /* a parenthesis, of a function or its own */
    int arguments; /* of a function, so far */
    size_t at;     /* where it stands in the text */
} waiting;

typedef struct compiler {
    const char *text;
    size_t length, at;
    gough_formula *formula;
    waiting waiting[WAITING];
    int waitings;
    struct {
        int first; /* operation with which the value begins */
        bool constant;
    } value[GOUGH_FORMULA_DEPTH];
    int values;
    int nesting;
    bool complete; /* a value has just ended: an operator must follow */
    size_t offset; /* of the character that an error is about */
    gough_error *error;
} compiler;

#define FAIL(c, place, ...)                                                                        \
    ((c)->offset = (place), gough_fail((c)->error, GOUGH_ERROR_INPUT, __VA_ARGS__))

/* ---- operations out ---- */

static gough_status emit(compiler *c, int code, int constant, double value, size_t at) {
    gough_formula *f = c->formula;
    if (f->count == GOUGH_FORMULA_OPERATIONS)
        return FAIL(c, at, "the formula is too long: at most %d numbers and operations",
                    GOUGH_FORMULA_OPERATIONS);
    f->operation[f->count].code = code;
    f->operation[f->count].constant = constant;
    f->operation[f->count].value = value;
    f->count++;
    return GOUGH_OK;
}

/* An operation without operands: a new value on the stack. */
static gough_status emit_value(compiler *c, int code, double value, size_t at) {
    if (c->values == GOUGH_FORMULA_DEPTH)
        return FAIL(c, at, "the formula is nested too deeply: more than %d pending values",
                    GOUGH_FORMULA_DEPTH);
    c->value[c->values].first = c->formula->count;
    c->value[c->values].constant = code != FORMULA_TIME;
    c->values++;
    c->complete = true;
    return emit(c, code, 0, value, at);
}

/* The rise time of a ramp, where it is the same at every t, must be positive. */
static gough_status check_rise(compiler *c, size_t at) {
    const int first = c->value[c->values - 1].first;
    if (!c->value[c->values - 1].constant) return GOUGH_OK;
    gough_formula rise;
    rise.count = c->formula->count - first;
    memcpy(rise.operation, c->formula->operation + first,
           (size_t)rise.count * sizeof rise.operation[0]);
    const double duration = formula_jet(&rise, 0).v;
    if (duration > 0 && real_finite(duration)) return GOUGH_OK;
    return FAIL(c, at, "the rise time T of ramp(t, T) must be positive, not %g", duration);
}

static gough_status emit_operation(compiler *c, int code, size_t at) {
    assert_true(c->values >=
                (code < FORMULA_ADD ? 1 : 2)); /* the grammar has seen to its operands */
    if (code < FORMULA_ADD) {
        const bool constant = c->value[c->values - 1].constant;
        return emit(c, code, constant ? FORMULA_FIRST_CONSTANT : 0, 0, at);
    }
    if (code == FORMULA_RAMP && check_rise(c, at) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    const bool first = c->value[c->values - 2].constant, second = c->value[c->values - 1].constant;
    c->values--;
    c->value[c->values - 1].constant = first && second;
    return emit(c, code,
                (first ? FORMULA_FIRST_CONSTANT : 0) | (second ? FORMULA_SECOND_CONSTANT : 0), 0,
                at);
}

/* ---- waiting operators ---- */

static gough_status hold(compiler *c, int code, bool opening, size_t at) {
    if (c->waitings == WAITING || (opening && c->nesting == GOUGH_FORMULA_DEPTH))
        return FAIL(c, at, "the formula is nested too deeply: at most %d levels of parentheses",
                    GOUGH_FORMULA_DEPTH);
    c->waiting[c->waitings++] =
        (waiting){.code = code, .opening = opening, .arguments = 1, .at = at};
    if (opening) c->nesting++;
    c->complete = false;
    return GOUGH_OK;
}

/* How tightly an operator binds: −t^2 is −(t^2), 2^−t·3 is (2^−t)·3. */
static int binding(int code) {
    switch (code) {
    case FORMULA_ADD:
    case FORMULA_SUBTRACT:
        return 1;
    case FORMULA_MULTIPLY:
    case FORMULA_DIVIDE:
        return 2;
    case FORMULA_NEGATE:
        return 3;
    default:
        return 4; /* FORMULA_POWER */
    }
}

/* Emits what waits, up to the parenthesis now open, as long as it binds at least as tightly as
 * `least`. */
static gough_status settle(compiler *c, int least) {
    while (c->waitings > 0) {
        const waiting *w = &c->waiting[c->waitings - 1];
        if (w->opening || binding(w->code) < least) return GOUGH_OK;
        c->waitings--;
        if (emit_operation(c, w->code, w->at) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    }
    return GOUGH_OK;
}

/* ---- what the text may hold ---- */

static bool is_digit(char c) { return c >= '0' && c <= '9'; }
static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

static char peek(const compiler *c) { return c->at < c->length ? c->text[c->at] : '\0'; }

static void skip_spaces(compiler *c) {
    while (c->at < c->length && is_space(c->text[c->at])) c->at++;
}

/* The character at c->at begins nothing that a formula may hold. */
static gough_status unexpected(compiler *c) {
    const unsigned char byte = (unsigned char)c->text[c->at];
    if (byte > 0x20 && byte < 0x7f) return FAIL(c, c->at, "unexpected character '%c'", byte);
    char shown[GOUGH_SHOWN_CHARACTER];
    if (gough_character_read(c->text + c->at, c->length - c->at, NULL) < 2)
        return FAIL(c, c->at, "unexpected byte 0x%02x", byte);
    (void)gough_character_show(c->text + c->at, c->length - c->at, shown);
    return FAIL(c, c->at, "unexpected character '%s': operators are + - * / ^", shown);
}

static gough_status read_number(compiler *c) {
    double value = 0;
    const size_t at = c->at;
    const size_t bytes = gough_decimal_read(c->text + at, c->length - at, &value);
    if (bytes == 0) return FAIL(c, at, "a number needs at least one digit");
    c->at += bytes;
    if (!real_finite(value)) return FAIL(c, at, "the number is too large for a double");
    return emit_value(c, FORMULA_NUMBER, value, at);
}

static gough_status read_name(compiler *c) {
    const size_t at = c->at;
    while (is_letter(peek(c)) || is_digit(peek(c))) c->at++;
    const size_t length = c->at - at;
    const gough_word_ *word = gough_find_word_(c->text + at, length);
    if (word == NULL) {
        char hint[80];
        gough_word_hint_(c->text + at, length, hint);
        return FAIL(c, at, "unknown name '%.*s%s'%s", (int)(length < 40 ? length : 40),
                    c->text + at, length > 40 ? "…" : "", hint);
    }
    if (word->arguments == 0) return emit_value(c, word->code, 0, at);
    skip_spaces(c);
    if (peek(c) != '(')
        return FAIL(c, c->at, "%s needs its argument in parentheses: %s", word->name, word->form);
    c->at++;
    return hold(c, word->code, true, at);
}

/* Where a value must come: a number, t, pi, a function, a parenthesis, a sign. */
static gough_status read_operand(compiler *c) {
    const char next = peek(c);
    if (is_digit(next) || next == '.') return read_number(c);
    if (is_letter(next)) return read_name(c);
    switch (next) {
    case '(':
        return hold(c, OPEN, true, c->at++);
    case '-':
        return hold(c, FORMULA_NEGATE, false, c->at++);
    case '+':
        c->at++;
        return GOUGH_OK;
    case ')':
    case ',':
    case '*':
    case '/':
    case '^':
        return FAIL(c, c->at, "a value is missing before '%c'", next);
    default:
        return unexpected(c);
    }
}

/* ')': ends a parenthesis or a function's arguments. */
static gough_status close(compiler *c) {
    const size_t at = c->at++;
    if (settle(c, 0) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    if (c->waitings == 0) return FAIL(c, at, "unmatched ')': '(' is missing");
    const waiting w = c->waiting[--c->waitings];
    c->nesting--;
    if (w.code == OPEN) return GOUGH_OK;
    const gough_word_ *word = gough_word_of_(w.code);
    if (w.arguments != word->arguments) /* one of several: too many are noticed at their comma */
        return FAIL(c, w.at, "%s takes %d arguments: %s", word->name, word->arguments, word->form);
    return emit_operation(c, w.code, w.at);
}

/* ',': between the arguments of a function. */
static gough_status next_argument(compiler *c) {
    const size_t at = c->at++;
    if (settle(c, 0) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    if (c->waitings == 0 || c->waiting[c->waitings - 1].code == OPEN)
        return FAIL(c, at, "unexpected ',': numbers are written with a point, as in 0.5");
    waiting *w = &c->waiting[c->waitings - 1];
    const gough_word_ *word = gough_word_of_(w->code);
    if (w->arguments == word->arguments)
        return FAIL(c, at, "%s takes %d argument%s: %s", word->name, word->arguments,
                    word->arguments == 1 ? "" : "s", word->form);
    w->arguments++;
    c->complete = false;
    return GOUGH_OK;
}

/* After a value: an operator, a comma or the end of a parenthesis. */
static gough_status read_operator(compiler *c) {
    static const char SIGNS[] = "+-*/^";
    static const int CODES[] = {FORMULA_ADD, FORMULA_SUBTRACT, FORMULA_MULTIPLY, FORMULA_DIVIDE,
                                FORMULA_POWER};
    const char next = peek(c);
    if (next == ')') return close(c);
    if (next == ',') return next_argument(c);
    if (is_letter(next) || is_digit(next) || next == '.' || next == '(')
        return FAIL(c, c->at, "an operator is missing before '%c': write products with *", next);
    const char *sign = next == '\0' ? NULL : strchr(SIGNS, next);
    if (sign == NULL) return unexpected(c);
    const int code = CODES[sign - SIGNS];
    if (next == '*' && c->at + 1 < c->length && c->text[c->at + 1] == '*')
        return FAIL(c, c->at, "write powers with ^, not **");
    /* what binds as tightly comes first, except in a^b^c = a^(b^c) */
    if (settle(c, binding(code) + (code == FORMULA_POWER ? 1 : 0)) != GOUGH_OK)
        return GOUGH_ERROR_INPUT;
    return hold(c, code, false, c->at++);
}

static gough_status compile(compiler *c) {
    for (skip_spaces(c); c->at < c->length; skip_spaces(c)) {
        const gough_status status = c->complete ? read_operator(c) : read_operand(c);
        if (status != GOUGH_OK) return status;
    }
    if (!c->complete) {
        if (c->formula->count == 0 && c->waitings == 0)
            return FAIL(c, 0, "the formula is empty: write 0 for no motion or force");
        return FAIL(c, c->length, "a value is missing at the end of the formula");
    }
    if (settle(c, 0) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    if (c->waitings > 0)
        return FAIL(c, c->waiting[c->waitings - 1].at,
                    "')' is missing: this parenthesis is not closed");
    return GOUGH_OK;
}

gough_status gough_formula_compile(gough_formula *formula, const char *text, size_t length,
                                   size_t *offset, gough_error *error) {
    compiler c = {.text = text, .length = length, .formula = formula, .error = error};
    formula->count = 0;
    const gough_status status = compile(&c);
    if (status != GOUGH_OK) formula->count = 0;
    if (offset != NULL) *offset = c.offset;
    return status;
}

/* ---- in other units ---- */

static bool is_one(double x) { return !(x < 1) && !(x > 1); }

/* Most values that wait on the stack at once, if each t takes one more while it is made. */
static int depth_of(const gough_formula *f, bool retimed) {
    int depth = 0, deepest = 0;
    for (int i = 0; i < f->count; i++) {
        const int code = f->operation[i].code;
        if (code >= FORMULA_ADD) depth--;
        if (code >= FORMULA_NEGATE) continue;
        depth++;
        const int here = depth + (retimed && code == FORMULA_TIME ? 1 : 0);
        if (here > deepest) deepest = here;
    }
    return deepest;
}

static void put(gough_formula *f, int code, int constant, double value) {
    f->operation[f->count].code = code;
    f->operation[f->count].constant = constant;
    f->operation[f->count].value = value;
    f->count++;
}

gough_status gough_formula_scale(gough_formula *formula, double size, double rate,
                                 gough_error *error) {
    const bool sized = !is_one(size) && !gough_formula_is_zero(formula), retimed = !is_one(rate);
    bool moving = false;
    int count = formula->count + (sized ? 2 : 0);
    for (int i = 0; i < formula->count; i++) {
        const bool time = formula->operation[i].code == FORMULA_TIME;
        moving = moving || time;
        if (time && retimed) count += 2;
    }
    if (count > GOUGH_FORMULA_OPERATIONS || depth_of(formula, retimed) > GOUGH_FORMULA_DEPTH)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the formula is too long to be converted from the study's units: at most "
                          "%d numbers and operations, and %d pending values",
                          GOUGH_FORMULA_OPERATIONS, GOUGH_FORMULA_DEPTH);
    const gough_formula plain = *formula;
    formula->count = 0;
    for (int i = 0; i < plain.count; i++) {
        const bool time = retimed && plain.operation[i].code == FORMULA_TIME;
        if (time) put(formula, FORMULA_NUMBER, 0, rate);
        put(formula, plain.operation[i].code, plain.operation[i].constant,
            plain.operation[i].value);
        if (time) put(formula, FORMULA_MULTIPLY, FORMULA_FIRST_CONSTANT, 0);
    }
    if (!sized) return GOUGH_OK;
    put(formula, FORMULA_NUMBER, 0, size);
    put(formula, FORMULA_MULTIPLY, FORMULA_SECOND_CONSTANT | (moving ? 0 : FORMULA_FIRST_CONSTANT),
        0);
    return GOUGH_OK;
}

gough_status gough_formula_init(gough_formula *formula, size_t size, double value) {
    if (size != sizeof *formula) return gough_size_refuse(formula, size);
    *formula = (gough_formula){.count = 1};
    formula->operation[0].code = FORMULA_NUMBER;
    formula->operation[0].value = value;
    return GOUGH_OK;
}

bool gough_formula_is_zero(const gough_formula *formula) {
    if (formula->count == 0) return true;
    if (formula->operation[0].code != FORMULA_NUMBER) return false;
    for (int i = 1; i < formula->count; i++)
        if (formula->operation[i].code != FORMULA_NEGATE) return false;
    return jet_vanishes(formula->operation[0].value);
}
