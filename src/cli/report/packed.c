/* Columns of numbers for the page. Each number is extrapolated from those before it, by the polynomial through the last `order`
 * rows; what is kept is the difference between the bits of the number and those of the extrapolation. For smooth columns most of
 * its leading bits are 0. The least significant bytes of all differences come first, then the next ones, and zlib compresses all
 * of them. The page computes the same extrapolation from the numbers that it has already, so it gets back every bit. */
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "cli/common/memory.h"
#include "cli/report/packed.h"

/* Extrapolation through more rows amplifies their rounding errors more than it gains. */
enum { GREATEST_ORDER = 8, BYTES = sizeof(uint64_t) };

/* 3 bytes to 4 characters, the last group filled up with '=' */
json_t *base64(const unsigned char *bytes, size_t count) {
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t length = (count + 2) / 3 * 4;
    char *text = allocate(length + 1);
    for (size_t i = 0, k = 0; i < count; i += 3, k += 4) {
        const size_t left = count - i;
        const unsigned group = (unsigned)bytes[i] << 16 |
                               (left > 1 ? (unsigned)bytes[i + 1] : 0) << 8 |
                               (left > 2 ? (unsigned)bytes[i + 2] : 0);
        for (int c = 0; c < 4; c++) text[k + (size_t)c] = digit[group >> (18 - 6 * c) & 63];
        if (left < 3) text[k + 3] = '=';
        if (left < 2) text[k + 2] = '=';
    }
    json_t *string = json_stringn_nocheck(text, length);
    free(text);
    return string;
}

static uint64_t bits_of(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

json_t *base64_of_numbers(const double *value, size_t count) {
    unsigned char *bytes = allocate(BYTES * count + 1);
    for (size_t i = 0; i < count; i++)
        for (unsigned b = 0; b < BYTES; b++)
            bytes[BYTES * i + b] = (unsigned char)(bits_of(value[i]) >> CHAR_BIT * b);
    json_t *string = base64(bytes, BYTES * count);
    free(bytes);
    return string;
}

/* The polynomial through the last `order` numbers, one row further: Σ (−1)^(j+1) (order over j) x_(i−j). The page adds in the same
 * order. 0 where it is not finite, and without numbers before. */
static double extrapolated(const double *value, size_t row, unsigned order) {
    const unsigned known = row < order ? (unsigned)row : order;
    double weight = -1, sum = 0;
    for (unsigned j = 1; j <= known; j++) {
        weight = -weight * (known - j + 1) / j;
        sum += weight * value[row - j];
    }
    return isfinite(sum) ? sum : 0;
}

/* The difference of the bits, whose sign is its last bit: 0, −1, 1, −2 … are 0, 1, 2, 3 … */
static uint64_t difference(const double *value, size_t row, unsigned order) {
    const uint64_t d = bits_of(value[row]) - bits_of(extrapolated(value, row, order));
    return d << 1 ^ (0 - (d >> 63));
}

static size_t bits_needed(const double *value, size_t count, unsigned order) {
    size_t bits = 0;
    for (size_t i = 0; i < count; i++)
        for (uint64_t d = difference(value, i, order); d; d >>= 1) bits++;
    return bits;
}

static unsigned best_order(const double *value, size_t count) {
    unsigned best = 0;
    size_t least = SIZE_MAX;
    for (unsigned order = 0; order <= GREATEST_ORDER; order++) {
        const size_t bits = bits_needed(value, count, order);
        if (bits < least) best = order, least = bits;
    }
    return best;
}

void pack_numbers(json_t *object, const double *value, size_t count) {
    const unsigned order = best_order(value, count);
    unsigned char *bytes = allocate(BYTES * count + 1);
    for (size_t i = 0; i < count; i++) {
        const uint64_t d = difference(value, i, order);
        for (unsigned b = 0; b < BYTES; b++)
            bytes[b * count + i] = (unsigned char)(d >> CHAR_BIT * b);
    }
    uLongf length = compressBound((uLong)(BYTES * count));
    unsigned char *packed = allocate(length);
    if (compress2(packed, &length, bytes, (uLong)(BYTES * count), Z_BEST_COMPRESSION) != Z_OK)
        out_of_memory();
    json_object_set_new(object, "rows", json_integer((json_int_t)count));
    json_object_set_new(object, "order", json_integer(order));
    json_object_set_new(object, "packed", base64(packed, length));
    free(packed);
    free(bytes);
}
