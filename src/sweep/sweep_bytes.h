/* The head of a sweep's file as bytes, and back from bytes that may be anything. */
#ifndef GOUGH_SWEEP_SWEEP_BYTES_H
#define GOUGH_SWEEP_SWEEP_BYTES_H

#include "sweep/sweep_part.h"

enum {
    SWEEP_IDENTITY = 40, /* magic, shard, shards, first, last */
    SWEEP_START = 48     /* and the length of the rest */
};

/* FNV-1a, 64 bits, over 8 bytes at a time and what is left one by one. */
uint64_t sweep_digest(uint64_t seed, const void *bytes, size_t length);

/* Allocated; NULL if out of memory. */
unsigned char *sweep_head_bytes(const sweep_head *head, size_t *length);

/* Length of a whole head by its first bytes; 0 if they do not begin a head. */
size_t sweep_head_length(const unsigned char *start, size_t length);

/* NULL where the bytes are damaged, or if out of memory. */
sweep_head *sweep_head_read(const unsigned char *bytes, size_t length);

#endif
