/* Numbers that may not be finite and sentences that may be cut, as JSON; and how objects are printed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/json.h"

/* Of all objects printed: within a format keys are added, never changed (docs/guide/json.md). */
enum { FORMAT = 1 };

json_t *json_number(double value) { return isfinite(value) ? json_real(value) : json_null(); }

json_t *json_words(const char *text) {
    /* a sentence cut to fit may end inside a character */
    size_t length = strlen(text);
    json_t *words = json_stringn(text, length);
    for (int back = 0; !words && length > 0 && back < 4; back++)
        words = json_stringn(text, --length);
    return words ? words : json_string("");
}

json_t *json_numbers(const double *value, size_t count) {
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++) json_array_append_new(array, json_number(value[i]));
    return array;
}

json_t *json_units(const gough_units *units) {
    static const char *const key[GOUGH_BASE_UNITS] = {"length", "force", "mass", "angle", "time"};
    json_t *object = json_object();
    bool si = true;
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) {
        json_object_set_new(object, key[b],
                            json_string(gough_unit_choice((gough_base_unit)b, units->name[b])));
        si = si && units->name[b] == 0;
    }
    if (!units->dimensionless && !si) return object;
    json_decref(object);
    return json_string(units->dimensionless ? "dimensionless" : "si");
}

void json_set_members(json_t *json, const void *object, const scaled_member *member, size_t count) {
    for (size_t m = 0; m < count; m++) {
        if (!member[m].key) continue;
        const double *value =
            object ? (const double *)(const void *)((const char *)object + member[m].at) : NULL;
        json_object_set_new(json, member[m].key,
                            !value                ? json_null()
                            : member[m].count > 1 ? json_numbers(value, member[m].count)
                                                  : json_number(*value));
    }
}

int json_print(json_t *object) {
    json_t *whole = json_object();
    json_object_set_new(whole, "format", json_integer(FORMAT));
    const int joined = json_object_update(whole, object);
    char *text = json_dumps(whole, JSON_INDENT(2) | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(17));
    const int failed = joined != 0 || !text || fputs(text, stdout) < 0 || putchar('\n') < 0;
    free(text);
    json_decref(whole);
    json_decref(object);
    return failed ? -1 : 0;
}
