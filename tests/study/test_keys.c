/* Every key of the table, given wrongly in each way: none is skipped, as the cases are made from the table itself. */
#include <stdio.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

/* A study of one key alone: nested mappings down to it, `- ` for the elements of a list. */
typedef struct lone {
    char text[1000];
    char name[64];
    char path[200]; /* as messages call it */
    int line, column;
} lone;

static void nest(lone *made, const gough_key *key, const char *suffix, const char *value) {
    char path[60];
    bool item = false;
    *made = (lone){.line = 0, .column = 1};
    snprintf(path, sizeof path, "%s", key->path);
    for (char *part = path, *dot; part; part = dot) {
        dot = strchr(part, '.');
        if (dot) *dot++ = '\0';
        char *end = made->text + strlen(made->text);
        static char quantity[] = "heave"; /* of the columns of a record */
        if (strcmp(part, "KEY") == 0 && strncmp(key->path, "motion.samples.", 15) == 0)
            part = quantity;
        if (strcmp(part, "N") == 0) {
            item = true;
            strcat(made->path, ".1");
            continue;
        }
        sprintf(end, "%*s%s%s%s:%s%s\n", made->column - 1, "", item ? "- " : "", part,
                dot ? "" : suffix, dot ? "" : " ", dot ? "" : value);
        if (item) made->column += 2;
        item = false;
        made->line++;
        sprintf(made->path + strlen(made->path), "%s%s", made->path[0] ? "." : "", part);
        snprintf(made->name, sizeof made->name, "%s", part);
        if (dot) made->column += 2;
    }
}

/* Reads it and expects a message at the key's value (or at its name) with this in it. */
static void expect_at(const lone *made, bool at_name, const char *part) {
    char place[600];
    const int column = made->column + (at_name ? 0 : (int)strlen(made->name) + 2);
    snprintf(place, sizeof place, "study.yaml:%d:%d: error: %s", made->line, column, part);
    expect_said(made->text, place);
}

static bool type_is(const gough_key *key, const char *type) { return strcmp(key->type, type) == 0; }

/* A value of the key's type with number v in it, at an offset from the value's begin; NULL where it has no numbers. */
static const char *shape_with(const gough_key *key, const char *v, char *value, int *offset,
                              const char **element) {
    static const struct {
        const char *type, *before, *after, *element;
    } shapes[] = {
        {"number", "", "", ""},
        {"number or least", "", "", ""},
        {"whole number", "", "", ""},
        {"two numbers", "[", ", 1]", ".1"},
        {"two numbers or six pairs", "[", ", 1]", ".1"},
        {"number or two numbers", "[", ", 1]", ".1"},
        {"three numbers", "[1, ", ", 1]", ".2"},
        {"number, two numbers or six of these", "[", ", 1]", ".1"},
        {"number, six numbers or 6×6 matrix", "[1, 1, ", ", 1, 1, 1]", ".3"},
        {"number or three numbers", "[1, 1, ", "]", ".3"},
        {"number or six numbers", "[1, 1, ", ", 1, 1, 1]", ".3"},
        {"six points", "[[1, 1, 1], [1, ", ", 1], [1, 1, 1], [1, 1, 1], [1, 1, 1], [1, 1, 1]]",
         ".2.2"},
        {"three numbers or 3×3 matrix", "[[1, 0, 0], [0, ", ", 0], [0, 0, 1]]", ".2.2"},
        {"formula", "", "", ""},
        {"formula or six formulas", "[1, 1, 1, 1, 1, ", "]", ".6"},
        {"three formulas", "[1, ", ", 1]", ".2"},
    };
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        if (!type_is(key, shapes[i].type)) continue;
        sprintf(value, "%s%s%s", shapes[i].before, v, shapes[i].after);
        *offset = (int)strlen(shapes[i].before);
        *element = shapes[i].element;
        return value;
    }
    return NULL;
}

static bool has_numbers(const gough_key *key) {
    return strstr(key->type, "number") || strstr(key->type, "formula") ||
           strstr(key->type, "points");
}

/* Expects `part` about the number v put into a value of the key's type. */
static void expect_of_number(const gough_key *key, const char *v, const char *part) {
    char value[300], sentence[400];
    const char *element;
    int offset;
    lone made;
    ck_assert_msg(shape_with(key, v, value, &offset, &element) != NULL,
                  "%s: no case for the type %s", key->path, key->type);
    nest(&made, key, "", value);
    snprintf(sentence, sizeof sentence, "`%s%s` must be %s", made.path, element, part);
    made.column += offset;
    expect_at(&made, false, sentence);
}

#define EACH_KEY(key)                                                                              \
    size_t key_count;                                                                              \
    const gough_key *const keys = gough_study_keys(&key_count);                                    \
    ck_assert(key_count > 50);                                                                     \
    for (const gough_key *key = keys; key < keys + key_count; key++)

START_TEST(rejects_wrong_type_of_every_key) {
    EACH_KEY(key) {
        const bool mapping = type_is(key, "mapping") || type_is(key, "list of mappings") ||
                             type_is(key, "mapping of paths") ||
                             type_is(key, "mapping of columns") ||
                             type_is(key, "mapping or six mappings");
        const bool other = type_is(key, "choice or mapping") || type_is(key, "file or mapping") ||
                           type_is(key, "column or mapping");
        lone made;
        char sentence[400];
        nest(&made, key, "", mapping ? "5" : other ? "[1]" : "{a: 1}");
        snprintf(sentence, sizeof sentence, "`%s` must be ", made.path);
        expect_at(&made, false, sentence);
    }
}
END_TEST

START_TEST(rejects_every_key_without_a_value) {
    EACH_KEY(key) {
        lone made;
        char sentence[400];
        if (type_is(key, "text"))
            continue; /* an empty title is one, and no unit is that of the study */
        nest(&made, key, "", "");
        snprintf(sentence, sizeof sentence, "`%s` must be ", made.path);
        expect_at(&made, true, sentence);
    }
}
END_TEST

START_TEST(rejects_text_for_every_number) {
    EACH_KEY(key) {
        if (strstr(key->type, "number") || strstr(key->type, "points")) {
            expect_of_number(key, "yes", "a number such as 1.5, found `yes`");
            expect_of_number(key, "'2'", "a number, found text; remove the quotes");
        }
    }
}
END_TEST

START_TEST(rejects_every_number_that_is_not_finite) {
    static const char *const values[] = {".nan", ".inf", "-.inf", "1e999", "-1e400", "NaN", "inf"};
    EACH_KEY(key) {
        for (size_t i = 0; has_numbers(key) && i < sizeof values / sizeof values[0]; i++)
            expect_of_number(key, values[i],
                             strstr(key->type, "number") || strstr(key->type, "points")
                                 ? "a finite number"
                                 : "finite");
    }
}
END_TEST

START_TEST(rejects_every_number_out_of_range) {
    EACH_KEY(key) {
        if (strcmp(key->range, "> 0") == 0) {
            expect_of_number(key, "0", "greater than 0, found 0");
            expect_of_number(key, "-1e-300", "greater than 0, found -1e-300");
        } else if (strcmp(key->range, ">= 0") == 0 ||
                   strcmp(key->range, ">= 0 outside a matrix") == 0) {
            expect_of_number(key, "-1", "0 or greater, found -1");
        } else if (strcmp(key->range, "> 0, <= 1") == 0) {
            expect_of_number(key, "0", "greater than 0, and at most 1, found 0");
            expect_of_number(key, "1.01", "greater than 0, and at most 1, found 1.01");
        } else if (strcmp(key->range, "> 0 to 180") == 0) {
            expect_of_number(key, "0", "greater than 0, and at most 180 degrees, found 0");
            expect_of_number(key, "180.01",
                             "greater than 0, and at most 180 degrees, found 180.01");
        } else if (strcmp(key->range, "-180 to 180") == 0) {
            expect_of_number(key, "-181", "from -180 to 180 degrees, found -181");
        } else if (strcmp(key->range, "-90 to 90") == 0) {
            expect_of_number(key, "-90.1", "from -90 to 90 degrees, found -90.1");
        } else if (strcmp(key->range, "0 to 60") == 0) {
            expect_of_number(key, "-1", "from 0 to 60 degrees, found -1");
            expect_of_number(key, "60.01", "from 0 to 60 degrees, found 60.01");
        } else if (strcmp(key->range, "1e-30 to 0.1") == 0) {
            expect_of_number(key, "0", "from 1e-30 to 0.1, found 0");
            expect_of_number(key, "1", "from 1e-30 to 0.1, found 1");
        } else if (type_is(key, "whole number")) {
            expect_of_number(key, "-1", "a whole number from ");
            expect_of_number(key, "2.5", "a whole number from ");
            expect_of_number(key, "1e16", "a whole number from ");
        } else if (strcmp(key->range, ">= 0 as a number") == 0) {
            lone made;
            nest(&made, key, "", "-9.8");
            expect_at(&made, false, "`gravity` must be 0 or greater, downwards");
        } else if (strstr(key->type, "choice")) {
            lone made;
            char sentence[400];
            nest(&made, key, "", "nonsense");
            snprintf(sentence, sizeof sentence, "`%s` must be one of %s, found `nonsense`",
                     made.path, key->range);
            expect_at(&made, false, sentence);
        } else {
            ck_assert_msg(key->range[0] == '\0', "%s: no case for the range %s", key->path,
                          key->range);
        }
    }
}
END_TEST

START_TEST(rejects_every_list_of_another_length) {
    EACH_KEY(key) {
        lone made;
        if (!strstr(key->type, "two") && !strstr(key->type, "three") && !strstr(key->type, "six"))
            continue;
        nest(&made, key, "", "[1, 1, 1, 1]");
        expect_at(&made, false, "`");
        expect_said(made.text, ", found a list of 4");
    }
}
END_TEST

START_TEST(rejects_duplicate_of_every_key) {
    EACH_KEY(key) {
        lone made;
        char line[200], sentence[300];
        nest(&made, key, "", "5");
        snprintf(line, sizeof line, "%*s%s: 6\n", made.column - 1, "", made.name);
        strcat(made.text, line);
        snprintf(sentence, sizeof sentence, "duplicate key `%s`: it is already set in line %d",
                 made.name, made.line);
        made.line++;
        expect_at(&made, true, sentence);
    }
}
END_TEST

START_TEST(suggests_every_key_that_is_misspelled) {
    EACH_KEY(key) {
        lone made;
        char sentence[300];
        nest(&made, key, "q", "5");
        snprintf(sentence, sizeof sentence, "unknown key `%sq`; did you mean `%s`?", made.name,
                 made.name);
        expect_at(&made, true, sentence);
    }
}
END_TEST

START_TEST(names_every_required_key_that_is_missing) {
    int required = 0;
    EACH_KEY(key) {
        lone made;
        char sentence[400];
        if (strcmp(key->fallback, "required") != 0) continue;
        required++;
        nest(&made, key, "", "5");
        /* another key in its place, if it is not at the top */
        char *name = strstr(made.text, made.name);
        for (char *next = name; next; next = strstr(next + 1, made.name)) name = next;
        memset(name, 'q', strlen(made.name));
        snprintf(sentence, sizeof sentence, "`%s` is missing: %s", made.path, key->sentence);
        expect_said(made.text, sentence);
    }
    ck_assert_int_ge(required, 8);
}
END_TEST

START_TEST(table_is_complete_and_in_order) {
    EACH_KEY(key) {
        ck_assert(key->path[0] && key->type[0] && key->sentence[0]);
        ck_assert_ptr_nonnull(key->unit);
        ck_assert_ptr_nonnull(key->range);
        ck_assert_ptr_nonnull(key->fallback);
        for (const gough_key *other = keys; other < key; other++)
            ck_assert_str_ne(other->path, key->path);
        /* a key stands after its mapping */
        const char *dot = strrchr(key->path, '.');
        bool found = dot == NULL;
        for (const gough_key *other = keys; dot && other < key; other++) {
            const size_t length = strlen(other->path);
            found |=
                strncmp(key->path, other->path, length) == 0 &&
                (dot == key->path + length ||
                 (dot == key->path + length + 2 && key->path[length + 1] == 'N') ||
                 (dot == key->path + length + 4 && strncmp(key->path + length + 1, "KEY", 3) == 0));
        }
        ck_assert_msg(found, "%s stands before its mapping", key->path);
    }
}
END_TEST

/* Every key of the table under every other mapping that does not have it: the hint names all keys of that name, and never tells
 * that a key belongs somewhere. */
START_TEST(hints_for_keys_in_the_wrong_place_are_true) {
    static const char *const parents[] = {"",
                                          "platform",
                                          "platform.base",
                                          "platform.top",
                                          "platform.legs",
                                          "load",
                                          "motion",
                                          "motion.samples",
                                          "motion.samples.time",
                                          "motion.moves.1",
                                          "external.1",
                                          "disturbance",
                                          "disturbance.noise",
                                          "control",
                                          "control.sampling",
                                          "actuators",
                                          "initial",
                                          "simulation",
                                          "simulation.constraints",
                                          "sweep",
                                          "sweep.keys.load.mass"};
    size_t count, tried = 0;
    const gough_key *keys = gough_study_keys(&count);
    for (size_t k = 0; k < count; k++) {
        const char *dot = strrchr(keys[k].path, '.'), *name = dot ? dot + 1 : keys[k].path;
        if (strcmp(name, "KEY") == 0 || strcmp(name, "N") == 0) continue;
        for (size_t p = 0; p < sizeof parents / sizeof parents[0]; p++) {
            const char *row = strcmp(parents[p], "motion.moves.1") == 0     ? "motion.moves.N"
                              : strcmp(parents[p], "external.1") == 0       ? "external.N"
                              : strncmp(parents[p], "sweep.keys.", 11) == 0 ? "sweep.keys.KEY"
                                                                            : parents[p];
            char path[100], setting[120], quoted[110];
            bool known = false;
            snprintf(path, sizeof path, "%s%s%s", row, *row ? "." : "", name);
            for (size_t i = 0; i < count; i++) known |= strcmp(keys[i].path, path) == 0;
            if (known) continue;
            if (strcmp(row, "sweep.keys.KEY") == 0)
                snprintf(setting, sizeof setting, "sweep.keys={load.mass: {%s: 1}}", name);
            else
                snprintf(setting, sizeof setting, "%s%s%s=1", parents[p], *row ? "." : "", name);
            reading made = read_more("motion: {moves: [{start: 1, duration: 1}]}\n"
                                     "external: [{force: [0, 0, 1]}]\n"
                                     "simulation: {constraints: {baumgarte: [1, 1]}}\n"
                                     "sweep: {keys: {load.mass: {from: 1, to: 2, steps: 2}}}\n",
                                     SETTINGS(setting));
            ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
            snprintf(quoted, sizeof quoted, "unknown key `%s`; ", name);
            const char *line = strstr(made.messages, quoted);
            ck_assert_msg(line, "%s: %s", setting, made.messages);
            ck_assert_msg(!strstr(line, "belongs"), "%s: %s", setting, made.messages);
            ck_assert_msg(strstr(line, "did you mean `") || strstr(line, "known here: "), "%s: %s",
                          setting, made.messages);
            /* all keys of that name, each by its whole path */
            const char *others = strstr(line, "eys of that name elsewhere: ");
            ck_assert_msg(others && strchr(others, '\n'), "%s: %s", setting, made.messages);
            for (size_t i = 0; i < count; i++) {
                const char *last = strrchr(keys[i].path, '.');
                snprintf(quoted, sizeof quoted, "`%s`", keys[i].path);
                const char *at = strstr(others, quoted);
                const bool named = at && at < strchr(others, '\n');
                ck_assert_msg(named == (strcmp(last ? last + 1 : keys[i].path, name) == 0),
                              "%s: %s", setting, made.messages);
            }
            reading_free(&made);
            tried++;
        }
    }
    ck_assert_uint_gt(tried, 800);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/keys", 60, rejects_wrong_type_of_every_key,
                     rejects_every_key_without_a_value, rejects_text_for_every_number,
                     rejects_every_number_that_is_not_finite, rejects_every_number_out_of_range,
                     rejects_every_list_of_another_length, rejects_duplicate_of_every_key,
                     suggests_every_key_that_is_misspelled,
                     names_every_required_key_that_is_missing, table_is_complete_and_in_order,
                     hints_for_keys_in_the_wrong_place_are_true);
}
