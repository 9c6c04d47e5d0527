/* Decimal numbers in text to doubles, correctly rounded: exactly, by one division of whole
 * numbers of up to 4096 bits, or of 128 bits where that is enough.
 *
 * The text is D·10^e with D a whole number. With N/M = D·10^e in whole numbers, the first 63 or
 * 64 bits of N/M and whether anything follows them decide the rounding. No double is decided by
 * more than 767 digits; of longer texts the rest only tells whether it is all zeros. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "gough/text.h"

enum {
    DIGITS = 770,            /* kept of D; a 1 stands for a rest that is not all zeros */
    LIMBS = 128,             /* 32 bits each: D, 10^1125 and both shifted stay below 3900 bits */
    EXPONENT_CAP = 100000000 /* where exponents stop: no text is long enough to bring them back */
};

/* A whole number; limb[0] is the least, limbs from count on are zero and not stored. */
typedef struct whole {
    uint32_t limb[LIMBS];
    int count;
} whole;

static void multiply_add(whole *w, uint32_t factor, uint32_t term) {
    uint64_t carry = term;
    for (int i = 0; i < w->count; i++) {
        carry += (uint64_t)w->limb[i] * factor;
        w->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry > 0) w->limb[w->count++] = (uint32_t)carry;
}

static void multiply_power_of_ten(whole *w, int power) {
    for (; power >= 9; power -= 9) multiply_add(w, 1000000000u, 0);
    for (; power > 0; power--) multiply_add(w, 10, 0);
}

static int bits(const whole *w) {
    int n = 32 * w->count;
    for (uint32_t top = w->limb[w->count - 1]; top < 0x80000000u; top <<= 1) n--;
    return n;
}

static void shift_left(whole *w, int by) {
    const int limbs = by / 32, rest = by % 32;
    if (w->count == 0) return;
    for (int i = w->count; i >= 0; i--) {
        const uint64_t high = i < w->count ? w->limb[i] : 0;
        const uint64_t low = i > 0 ? w->limb[i - 1] : 0;
        w->limb[i + limbs] = (uint32_t)((high << 32 | low) << rest >> 32);
    }
    for (int i = 0; i < limbs; i++) w->limb[i] = 0;
    w->count += limbs + 1;
    if (w->limb[w->count - 1] == 0) w->count--;
}

static bool less(const whole *a, const whole *b) {
    if (a->count != b->count) return a->count < b->count;
    for (int i = a->count - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i]) return a->limb[i] < b->limb[i];
    return false;
}

/* a − b for a ≥ b */
static void subtract(whole *a, const whole *b) {
    int64_t borrow = 0;
    for (int i = 0; i < a->count; i++) {
        const int64_t d = (int64_t)a->limb[i] - (i < b->count ? b->limb[i] : 0) + borrow;
        a->limb[i] = (uint32_t)d;
        borrow = d < 0 ? -1 : 0;
    }
    while (a->count > 0 && a->limb[a->count - 1] == 0) a->count--;
}

/* q·2^(−scale) to the nearest double, ties to even, q ≥ 2^62; `more` tells that a little more
 * than q is meant */
static double rounded(uint64_t q, bool more, int scale) {
    int width = 64;
    for (uint64_t top = q; top < 0x8000000000000000u; top <<= 1) width--;
    const int exponent = width - 1 - scale; /* of the leading bit */
    if (exponent > 1023) return INFINITY;
    /* 53 bits, fewer below 2^−1022 */
    const int keep = exponent < -1022 ? 53 + exponent + 1022 : 53;
    if (keep < 0) return 0;
    const int drop = width - keep;
    uint64_t kept = drop < 64 ? q >> drop : 0;
    const uint64_t half = (uint64_t)1 << (drop - 1);
    const uint64_t rest = q & (half | (half - 1));
    if (rest > half || (rest == half && (more || kept % 2 == 1))) kept++;
    return ldexp((double)kept, drop - scale);
}

/* D·10^power, D > 0 */
static double exact(whole *numerator, int power) {
    whole denominator = {.limb = {1}, .count = 1};
    if (power >= 0)
        multiply_power_of_ten(numerator, power);
    else
        multiply_power_of_ten(&denominator, -power);

    /* numerator·2^scale is 63 bits longer than the denominator, so the quotient has 63 or 64
     * bits */
    const int scale = 63 - (bits(numerator) - bits(&denominator));
    if (scale >= 0)
        shift_left(numerator, scale);
    else
        shift_left(&denominator, -scale);
    shift_left(&denominator, 63);

    /* long division by halves: the denominator goes back to its place, one bit of the quotient
     * each time */
    uint64_t quotient = 0;
    for (int i = 0; i < 64; i++) {
        quotient <<= 1;
        if (!less(numerator, &denominator)) {
            subtract(numerator, &denominator);
            quotient |= 1;
        }
        if (i < 63) shift_left(numerator, 1);
    }
    return rounded(quotient, numerator->count > 0, scale);
}

/* D·10^power for most numbers, D a word and power from −19 to 0: the same by one division of
 * 128 bits. */
static double exact_word(uint64_t D, int power) {
    __extension__ typedef unsigned __int128 double_word;
    uint64_t denominator = 1;
    int scale = 64, shift = 0;
    for (; power < 0; power++) denominator *= 10;
    for (; D < 0x8000000000000000u; D <<= 1) scale++;

    /* D is at least 2^63 now, so that the quotient has 64 bits or more */
    const double_word numerator = (double_word)D << 64;
    const double_word quotient = numerator / denominator;
    while (quotient >> shift > UINT64_MAX) shift++;
    const uint64_t kept = (uint64_t)(quotient >> shift);
    const bool more = (double_word)kept << shift < quotient || quotient * denominator < numerator;
    return rounded(kept, more, scale - shift);
}

/* The digits of the text as a whole number, and the power of ten that belongs to it. */
typedef struct digits {
    whole value;
    int count;  /* digits in value, leading zeros not counted */
    long power; /* of ten, for value */
    bool rest;  /* something other than zeros was left out of value */
} digits;

static void take_digit(digits *d, int digit, bool fraction) {
    if (d->count < DIGITS) {
        multiply_add(&d->value, 10, (uint32_t)digit);
        if (d->value.count > 0) d->count++;
        d->power -= fraction;
    } else {
        if (digit > 0) d->rest = true;
        d->power += !fraction;
    }
}

/* Digits and point; returns the bytes read, 0 if there is no digit. */
static size_t read_digits(const char *text, size_t length, digits *d) {
    size_t at = 0;
    bool point = false, any = false;
    for (; at < length; at++) {
        if (text[at] == '.' && !point) {
            point = true;
        } else if (text[at] >= '0' && text[at] <= '9') {
            any = true;
            take_digit(d, text[at] - '0', point);
        } else {
            break;
        }
    }
    return any ? at : 0;
}

/* An exponent at text, into power; returns the bytes read, 0 if the text has no exponent. */
static size_t read_exponent(const char *text, size_t length, long *power) {
    size_t at = 1;
    if (length < 2 || (text[0] != 'e' && text[0] != 'E')) return 0;
    const bool negative = text[at] == '-';
    if (text[at] == '-' || text[at] == '+') at++;
    const size_t first = at;
    long exponent = 0;
    for (; at < length && text[at] >= '0' && text[at] <= '9'; at++)
        if (exponent < EXPONENT_CAP) exponent = 10 * exponent + (text[at] - '0');
    if (at == first) return 0;
    *power += negative ? -exponent : exponent;
    return at;
}

/* The number without its sign. */
static double value_of(digits *d) {
    if (d->rest) {
        multiply_add(&d->value, 10, 1);
        d->power--;
    }
    const long places = d->count + d->power; /* the number is below 10^places */
    if (d->value.count == 0 || places < -330) return 0;
    if (places > 310) return INFINITY;
    if (d->value.count <= 2 && d->power <= 0 && d->power >= -19) {
        const uint64_t high = d->value.count == 2 ? d->value.limb[1] : 0;
        return exact_word(high << 32 | d->value.limb[0], (int)d->power);
    }
    return exact(&d->value, (int)d->power);
}

size_t gough_decimal_read(const char *text, size_t length, double *value) {
    digits d = {.value = {.count = 0}};
    const size_t sign = length > 0 && (text[0] == '+' || text[0] == '-') ? 1 : 0;
    size_t at = read_digits(text + sign, length - sign, &d);
    if (at == 0) return 0;
    at += sign;
    at += read_exponent(text + at, length - at, &d.power);
    const double magnitude = value_of(&d);
    *value = sign > 0 && text[0] == '-' ? -magnitude : magnitude;
    return at;
}
