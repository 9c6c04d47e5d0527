/* Digests of numbers: FNV-1a over the bytes of doubles and quads, every NaN counted as the same. */
#ifndef TESTS_DIGEST_HASH_H
#define TESTS_DIGEST_HASH_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

static const uint64_t hash_start = 0xcbf29ce484222325u;

static inline void hash_bytes(uint64_t *h, const void *bytes, size_t count) {
    const unsigned char *b = bytes;

    for (size_t i = 0; i < count; i++) *h = (*h ^ b[i]) * 0x100000001b3u;
}

static inline void hash_double(uint64_t *h, double x) {
    const double value = isnan(x) ? (double)NAN : x;
    uint64_t bits;

    memcpy(&bits, &value, sizeof bits);
    if (isnan(x)) bits = 0x7ff8000000000000u; /* a NaN's sign and payload are the compiler's */
    hash_bytes(h, &bits, sizeof bits);
}

static inline void hash_doubles(uint64_t *h, const double *x, size_t count) {
    for (size_t i = 0; i < count; i++) hash_double(h, x[i]);
}

static inline void hash_text(uint64_t *h, const char *text) { hash_bytes(h, text, strlen(text)); }

#endif
