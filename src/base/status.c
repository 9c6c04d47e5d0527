/* Sentences for errors and words for the ends of runs. A sentence is the same in every locale:
 * numbers have a point. Marks behind numbers (base/quantity.h) are taken out, and kept with errors. */
#include "gough/status.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/quantity.h"

/* A text that is cut where it is full. */
typedef struct sentence {
    char *text;
    size_t size, used;
    gough_quantity last; /* the number that was printed last */
    gough_error *error;  /* receives marked numbers; NULL: nothing does */
} sentence;

static void append(sentence *s, const char *text, size_t length) {
    const size_t room = s->size - 1 - s->used;
    const size_t taken = length < room ? length : room;
    memcpy(s->text + s->used, text, taken);
    s->used += taken;
    s->text[s->used] = '\0';
}

/* Whatever the locale has put for the decimal point becomes a point. */
static void append_number(sentence *s, const char *number) {
    bool point = false;
    for (const char *c = number; *c != '\0'; c++) {
        if (strchr("+- 0123456789abcdefinptxABCDEFINPTX", *c) != NULL) {
            append(s, c, 1);
            point = false;
        } else if (!point) {
            append(s, ".", 1);
            point = true;
        }
    }
}

/* Keeps the number before a mark with the error; `behind`: bytes of the text that follows in place of a unit. */
static void keep_quantity(const sentence *s, char letter, size_t behind) {
    gough_error *error = s->error;
    if (error == NULL || error->quantities == GOUGH_ERROR_QUANTITIES) return;
    gough_quantity *kept = &error->quantity[error->quantities++];
    *kept = s->last;
    kept->length += (int)behind;
    kept->unit = letter - (letter < QUANTITY_DEGREES ? QUANTITY_PLAIN : QUANTITY_DEGREES);
    if (letter >= QUANTITY_DEGREES) kept->value *= 3.14159265358979323846 / 180;
}

/* One conversion, "%-10.3g" and the like; returns the first character after it. The format
 * attribute has had the compiler check the arguments. Known: c d i u x s e f g %, lengths l and
 * z, width and precision as digits or *. */
static const char *append_conversion(sentence *s, const char *format, va_list *arguments) {
    char spec[24] = "%", out[400] = "";
    size_t n = 1;
    const char *at = format + 1;
    for (; *at != '\0' && strchr("+-# .0123456789*", *at) != NULL; at++) {
        if (*at == '*') {
            n += (size_t)snprintf(spec + n, sizeof spec - n, "%d", va_arg(*arguments, int));
        } else {
            spec[n++] = *at;
        }
        if (n > sizeof spec - 14) return at + 1;
    }
    char length = '\0';
    for (; *at == 'l' || *at == 'z'; at++) spec[n++] = length = *at;
    spec[n] = *at;
    switch (*at) {
    case '\0':
        return at;
    case '%':
        append(s, "%", 1);
        break;
    case 'c':
        snprintf(out, sizeof out, spec, va_arg(*arguments, int));
        break;
    case 's':
        /* with a precision the text need not be terminated, which snprintf respects */
        if (strchr(spec, '.') == NULL && n == 1) {
            const char *text = va_arg(*arguments, const char *);
            const bool marked = text[0] == QUANTITY_MARK;
            if (marked) text += 2;
            if (marked) keep_quantity(s, text[-1], strlen(text));
            append(s, text, strlen(text));
        } else {
            snprintf(out, sizeof out, spec, va_arg(*arguments, const char *));
        }
        break;
    case 'e':
    case 'f':
    case 'g':
        s->last = (gough_quantity){.at = (int)s->used, .value = va_arg(*arguments, double)};
        s->last.digits = strchr(spec, '.') ? atoi(strchr(spec, '.') + 1) : 6;
        snprintf(out, sizeof out, spec, s->last.value);
        append_number(s, out);
        s->last.length = (int)s->used - s->last.at;
        return at + 1;
    default:
        if (length == 'l')
            snprintf(out, sizeof out, spec, va_arg(*arguments, long));
        else if (length == 'z')
            snprintf(out, sizeof out, spec, va_arg(*arguments, size_t));
        else
            snprintf(out, sizeof out, spec, va_arg(*arguments, int));
    }
    append(s, out, strlen(out));
    return at + 1;
}

static void write_sentence(sentence *whole, const char *format, va_list list) {
    sentence s = *whole;
    char *const text = s.text;
    va_list arguments;
    text[0] = '\0';
    va_copy(arguments, list);
    while (*format != '\0') {
        if (*format == '%') {
            format = append_conversion(&s, format, &arguments);
        } else if (*format == QUANTITY_MARK) {
            keep_quantity(&s, format[1], 0);
            format += 2;
        } else {
            append(&s, format, 1);
            format++;
        }
    }
    va_end(arguments);

    /* a sentence that was cut does not end within a UTF-8 character */
    if (s.used == s.size - 1) {
        size_t end = s.used;
        while (end > 0 && (s.text[end - 1] & 0xc0) == 0x80) end--;
        if (end > 0 && (s.text[end - 1] & 0x80) != 0) s.text[end - 1] = '\0';
    }
}

void gough_sentence(char *text, size_t size, const char *format, va_list arguments) {
    sentence s = {.text = text, .size = size};
    write_sentence(&s, format, arguments);
}

static void write_error(gough_error *error, const char *format, va_list arguments) {
    sentence s = {.text = error->message, .size = sizeof error->message, .error = error};
    error->quantities = 0;
    write_sentence(&s, format, arguments);
}

gough_status gough_fail(gough_error *error, gough_status status, const char *format, ...) {
    if (error == NULL) return status;
    va_list arguments;
    error->status = status;
    error->key = NULL;
    va_start(arguments, format);
    write_error(error, format, arguments);
    va_end(arguments);
    return status;
}

gough_status gough_fail_key(gough_error *error, gough_status status, const char *key,
                            const char *format, ...) {
    if (error == NULL) return status;
    va_list arguments;
    error->status = status;
    error->key = key;
    va_start(arguments, format);
    write_error(error, format, arguments);
    va_end(arguments);
    return status;
}

const char *gough_cause_name(gough_cause cause) {
    switch (cause) {
    case GOUGH_END_DONE:
        return "done";
    case GOUGH_END_LEG_SHORT:
        return "leg_short";
    case GOUGH_END_LEG_LONG:
        return "leg_long";
    case GOUGH_END_LEG_SPEED:
        return "leg_speed";
    case GOUGH_END_LEG_FORCE:
        return "leg_force";
    case GOUGH_END_LEG_NO_LENGTH:
        return "leg_no_length";
    case GOUGH_END_SINGULAR:
        return "singular";
    case GOUGH_END_NOT_FINITE:
        return "not_finite";
    case GOUGH_END_NO_CONVERGENCE:
        return "no_convergence";
    case GOUGH_END_STOPPED:
        return "stopped";
    case GOUGH_END_INVALID:
        return "invalid";
    case GOUGH_END_LEG_ACCELERATION:
        return "leg_acceleration";
    case GOUGH_END_BASE_SWING:
        return "base_swing";
    case GOUGH_END_TOP_SWING:
        return "top_swing";
    case GOUGH_END_PLATFORM_POSE:
        return "platform_pose";
    case GOUGH_END_PLATFORM_SPEED:
        return "platform_speed";
    case GOUGH_END_PLATFORM_ACCELERATION:
        return "platform_acceleration";
    case GOUGH_CAUSES:
        break;
    }
    return "unknown";
}

const char *gough_cause_words(gough_cause cause) {
    switch (cause) {
    case GOUGH_END_DONE:
        return "the run reaches its end";
    case GOUGH_END_LEG_SHORT:
        return "a leg becomes too short";
    case GOUGH_END_LEG_LONG:
        return "a leg becomes too long";
    case GOUGH_END_LEG_SPEED:
        return "a leg moves too fast";
    case GOUGH_END_LEG_FORCE:
        return "a leg's force exceeds its limit";
    case GOUGH_END_LEG_NO_LENGTH:
        return "the joints of a leg meet";
    case GOUGH_END_SINGULAR:
        return "the platform collapses into a singular pose";
    case GOUGH_END_NOT_FINITE:
        return "a formula or the motion is not finite";
    case GOUGH_END_NO_CONVERGENCE:
        return "the steps do not converge";
    case GOUGH_END_STOPPED:
        return "the caller stops the run";
    case GOUGH_END_INVALID:
        return "the values do not make a valid study";
    case GOUGH_END_LEG_ACCELERATION:
        return "a leg's acceleration exceeds its limit";
    case GOUGH_END_BASE_SWING:
        return "a leg turns too far at the base";
    case GOUGH_END_TOP_SWING:
        return "a leg turns too far at the top";
    case GOUGH_END_PLATFORM_POSE:
        return "the platform leaves its range";
    case GOUGH_END_PLATFORM_SPEED:
        return "the platform moves too fast";
    case GOUGH_END_PLATFORM_ACCELERATION:
        return "the platform's acceleration exceeds its limit";
    case GOUGH_CAUSES:
        break;
    }
    return "the run ends";
}
