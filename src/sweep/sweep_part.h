/* The append-only file of a sweep in progress, which is a finished shard's too: a head that says which sweep it is, then a record
 * for each run in order. Head and records carry checksums, so that a record torn by a crash is told from a whole one.
 *
 * Head: magic, shard, shards, first and last run, length of the rest, the rest (sweep_head_write()), checksum. Numbers are stored
 * as the machine has them; one with another order of bytes does not know the magic number. */
#ifndef GOUGH_SWEEP_SWEEP_PART_H
#define GOUGH_SWEEP_SWEEP_PART_H

#include "gough/sweep.h"

/* What identifies a sweep, and what its tables need besides the records. */
typedef struct sweep_head {
    const char *title, *study, *settings, *version; /* settings: a line "key=value" each */
    uint64_t samples;                               /* digest of recorded motion */
    uint64_t plan, numerics; /* digests of the values of the runs, of what the build computes */
    gough_units units;
    double base_radius, gravity; /* of the units of the output */
    gough_units own;             /* of the study, in which swept values are */
    bool sizing, forces;         /* as in gough_sweep_options */
    uint64_t runs, keys;
    const char **path, **label; /* of each key: its path, its unit in tables */
    uint64_t shard, shards, first, last;
} sweep_head;

/* The head of a sweep; free its memory with sweep_head_free(). NULL if out of memory. */
sweep_head *sweep_head_of(const gough_sweep *sweep, const gough_sweep_options *options,
                          const gough_units *units, size_t shard, size_t shards);
void sweep_head_free(sweep_head *head);

/* An open file of records. */
typedef struct sweep_part {
    const char *path; /* for messages; NULL: a file without a name */
    sweep_head *head;
    unsigned char *bytes; /* of the head, as in the file */
    size_t length;
    uint64_t seed; /* of the checksums of its records */
    int file;
    bool own;    /* locked, and of this sweep */
    size_t done; /* whole records */
    size_t held; /* bytes of the buffer */
    double synced;
    unsigned char buffer[1 << 16];
} sweep_part;

/* Bytes of a record of a sweep. */
size_t sweep_record_size(const sweep_head *head);

/* Opens PATH.part (NULL: a file without a name) for this head: a new one, or one with records of the same sweep, whose torn end is
 * cut off. The head is the part's from here on, also after an error.
 * Returns GOUGH_OK, GOUGH_ERROR_INPUT (it is of another sweep, or in use) or GOUGH_ERROR_FILE. */
gough_status sweep_part_open(sweep_part *part, const char *path, sweep_head *head,
                             gough_error *error);
/* Opens a finished shard for reading. */
gough_status sweep_part_read(sweep_part *part, const char *path, gough_error *error);

gough_status sweep_part_add(sweep_part *part, const gough_sweep_row *row, gough_error *error);
/* Brings all records to the disk. */
gough_status sweep_part_flush(sweep_part *part, gough_error *error);
/* Records from the n-th of the file on, at most `most`, read into memory of as many records; 0 at the end. */
size_t sweep_part_get(const sweep_part *part, size_t n, size_t most, void *records);
/* Takes a record apart; values: as many as there are keys. */
void sweep_record_take(const sweep_part *part, const void *record, double *value,
                       gough_sweep_row *row);
/* Removes it, if it is this sweep's own and has no record. */
void sweep_part_forget(const sweep_part *part);
void sweep_part_close(sweep_part *part);

/* Whether two parts are of one sweep, whichever shards they are. */
bool sweep_part_same(const sweep_part *a, const sweep_part *b);

#endif
