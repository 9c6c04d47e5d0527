/* Ticks of an axis. Place and text of each come from the same two integers (a count of steps, or a digit and a power of ten) and
 * go to gnuplot together, so that a number cannot stand where another belongs. Linear axes have steps of 1, 2 or 5 times a power
 * of ten; logarithmic axes have powers of ten, digits 1, 2 and 5 where fewer than three powers fit, and linear steps where even
 * those are too few. */
#include "figure/ticks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    MOST_DECIMALS = 15,
    FEW = 3,              /* labels that an axis has at least, where the range has room for them */
    PLAIN_POWER_LOW = -3, /* numbers of these powers of ten are written out */
    PLAIN_POWER_HIGH = 5,
    MANTISSA_DECIMALS = 3, /* large numbers with longer mantissas are written out */
    MINOR_DECADES = 6      /* up to so many decades, digits 2 … 9 have short marks */
};

/* Nominal pixels of a character of a label, and the gap that two labels beside each other need. */
static const double character_width = 7.0, gap = 12.0;

static double ten_to(int power) { return pow(10.0, power); }

static int floor_log10(double value) { return (int)floor(log10(value) + 1e-9); }

double tick_step(double low, double high, int most) {
    const double least = (high - low) / (most > 1 ? most : 1), decade = ten_to(floor_log10(least));
    static const double digit[] = {1.0, 2.0, 5.0};
    for (size_t i = 0; i < sizeof digit / sizeof digit[0]; i++) {
        if (digit[i] * decade >= least * (1.0 - 1e-9)) return digit[i] * decade;
    }
    return 10.0 * decade;
}

/* The sign as typographers write it: gnuplot replaces hyphens only in formats of its own. */
static void put_sign(char *text, size_t size, const char *number) {
    snprintf(text, size, "%s%s", number[0] == '-' ? "−" : "", number + (number[0] == '-'));
}

static void put_fixed(char *text, size_t size, double value, int decimals) {
    char number[64];
    snprintf(number, sizeof number, "%.*f", decimals, value);
    put_sign(text, size, number);
}

static void put_power(char *text, size_t size, const char *mantissa, int power) {
    char exponent[16], number[16];
    snprintf(number, sizeof number, "%d", power);
    put_sign(exponent, sizeof exponent, number);
    snprintf(text, size, "%s%s10^{%s}", mantissa, mantissa[0] != '\0' ? "·" : "", exponent);
}

static tick *add(tick_list *list, double value) {
    if (list->count == MOST_TICKS) return NULL;
    tick *t = &list->tick[list->count++];
    *t = (tick){.value = value};
    return t;
}

/* ---- linear ------------------------------------------------------------------------------------------------------ */

static void list_steps(tick_list *list, double low, double high, double step) {
    list->count = 0;
    if (!(step > 0.0) || !isfinite(step)) return;
    const double first = ceil(low / step - 1e-9), last = floor(high / step + 1e-9);
    const double greatest = step * fmax(fabs(first), fabs(last));
    const int power = greatest > 0.0 ? floor_log10(greatest) : 0, unit = floor_log10(step);
    const int decimals = unit < 0 ? (unit > -MOST_DECIMALS ? -unit : MOST_DECIMALS) : 0;
    const bool raised = power < PLAIN_POWER_LOW || power >= MOST_DECIMALS ||
                        (power > PLAIN_POWER_HIGH && power - unit <= MANTISSA_DECIMALS);
    for (double k = first; k <= last && list->count < MOST_TICKS; k++) {
        tick *t = add(list, k * step);
        char mantissa[32];
        put_fixed(mantissa, sizeof mantissa, k * (step / ten_to(power)), power - unit);
        if (fabs(k) < 0.5)
            snprintf(t->text, sizeof t->text, "0");
        else if (raised)
            put_power(t->text, sizeof t->text, mantissa, power);
        else
            put_fixed(t->text, sizeof t->text, k * step, decimals);
    }
}

/* At least two numbers, without which an axis tells nothing. */
static void list_linear(tick_list *list, double low, double high, int most) {
    int finer = most;
    do list_steps(list, low, high, tick_step(low, high, finer));
    while (list->count < 2 && ++finer <= most + 6);
}

/* ---- logarithmic ------------------------------------------------------------------------------------------------- */

/* Digits 1 … 9 times powers of ten within a range; which of them have numbers is said by a stride of powers and a set of digits. */
typedef struct decades {
    double low, high;
    int first, last; /* powers */
} decades;

static decades decades_of(double low, double high) {
    decades d = {low * (1.0 - 1e-9), high * (1.0 + 1e-9), 0, 0};
    d.first = (int)floor(log10(low));
    d.last = (int)ceil(log10(high));
    return d;
}

static bool within(const decades *d, int digit, int power) {
    const double value = digit * ten_to(power);
    return value >= d->low && value <= d->high;
}

static int count_labels(const decades *d, const char *digits) {
    int count = 0;
    for (int power = d->first; power <= d->last; power++)
        for (const char *at = digits; *at != '\0'; at++) count += within(d, *at - '0', power);
    return count;
}

static void name_digit(tick *t, int digit, int power, bool plain) {
    char mantissa[2] = {(char)('0' + digit), '\0'};
    if (plain)
        put_fixed(t->text, sizeof t->text, t->value, power < 0 ? -power : 0);
    else
        put_power(t->text, sizeof t->text, digit == 1 ? "" : mantissa, power);
}

static void list_digits(tick_list *list, const decades *d, const char *digits, int stride) {
    const bool lone = strcmp(digits, "1") == 0;
    const bool plain = !lone && d->first >= PLAIN_POWER_LOW && d->last <= PLAIN_POWER_HIGH;
    const bool minor = stride == 1 && d->last - d->first <= MINOR_DECADES;
    list->count = 0;
    for (int power = d->first; power <= d->last; power++)
        for (int digit = 1; digit <= 9; digit++) {
            const bool named = strchr(digits, '0' + digit) != NULL && power % stride == 0;
            if (!within(d, digit, power) || !(named || minor)) continue;
            tick *t = add(list, digit * ten_to(power));
            if (t != NULL && named) name_digit(t, digit, power, plain);
        }
}

static void list_logarithmic(tick_list *list, double low, double high, int most) {
    const decades d = decades_of(low, high);
    const int powers = count_labels(&d, "1"), digits = count_labels(&d, "125");
    if (powers >= FEW || (powers == FEW - 1 && digits > most))
        list_digits(list, &d, "1", (powers + most - 1) / most);
    else if (digits >= FEW)
        list_digits(list, &d, "125", 1);
    else
        list_linear(list, low, high, most);
}

/* ---- room -------------------------------------------------------------------------------------------------------- */

/* Characters that a label shows: those of UTF-8, less what only marks a superscript. */
static int shown_characters(const char *text) {
    int count = 0;
    for (; *text != '\0'; text++) {
        const bool mark = *text == '^' || *text == '{' || *text == '}';
        count += !mark && ((unsigned char)*text & 0xC0) != 0x80;
    }
    return count;
}

double tick_label_width(const tick_list *list) {
    int most = 0;
    for (int i = 0; i < list->count; i++) {
        const int shown = shown_characters(list->tick[i].text);
        if (shown > most) most = shown;
    }
    return character_width * most;
}

static double place_of(const axis *a, double value) {
    const double part = a->logarithmic ? log(value / a->low) / log(a->high / a->low)
                                       : (value - a->low) / (a->high - a->low);
    return part * a->length;
}

/* Whether labels beside each other keep their distance. */
static bool labels_fit(const axis *a, const tick_list *list) {
    const tick *last = NULL;
    for (int i = 0; i < list->count; i++) {
        const tick *t = &list->tick[i];
        if (t->text[0] == '\0') continue;
        const double half = last == NULL
                                ? 0.0
                                : 0.5 * character_width *
                                      (shown_characters(last->text) + shown_characters(t->text));
        if (last != NULL && place_of(a, t->value) - place_of(a, last->value) < half + gap)
            return false;
        last = t;
    }
    return true;
}

void tick_choose(const axis *a, tick_list *list) {
    int most = (int)(a->length / (a->beside ? 60.0 : 30.0));
    if (most < 2) most = 2;
    do {
        if (a->logarithmic)
            list_logarithmic(list, a->low, a->high, most);
        else
            list_linear(list, a->low, a->high, most);
    } while (a->beside && !labels_fit(a, list) && --most >= 2);
}

void axis_write(FILE *file, const axis *a) {
    tick_list list;
    tick_choose(a, &list);
    fprintf(file, "set %srange [%.15g:%.15g]\n%s logscale %s\nunset m%stics\nset format %s '%%h'\n",
            a->name, a->low, a->high, a->logarithmic ? "set" : "unset", a->name, a->name, a->name);
    fprintf(file, "set %stics (", a->name);
    for (int i = 0; i < list.count; i++) {
        const tick *t = &list.tick[i];
        fprintf(file, "%s'%s' %.17g%s", i > 0 ? ", " : "", a->bare ? "" : t->text, t->value,
                t->text[0] == '\0' ? " 1" : "");
    }
    fprintf(file, ")\n");
}
