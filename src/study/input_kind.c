/* What a file is by its first bytes: the signatures of formats, and the first words of tables and studies. */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "gough/study.h"

enum { FIRST_BYTES = 4096 }; /* a study may begin with remarks */

/* what gough reads or writes, in the order of the words */
typedef enum { UNKNOWN, HDF5, CSV, SHARD, STUDY, PICTURE, PAGE, JSON } kind;

static const char *const words[] = {
    [UNKNOWN] = NULL,
    [HDF5] = "a table of results in HDF5, which `gough plot` draws",
    [CSV] = "a table in CSV, which `gough plot` draws",
    [SHARD] = "a shard of a sweep, which `gough merge` joins with the others",
    [STUDY] = "a study, from which `gough simulate` computes results",
    [PICTURE] = "a picture",
    [PAGE] = "a page, which a web browser shows",
    [JSON] = "JSON that gough has printed"};

/* bytes from a place on; letters may be of either case */
static const struct {
    kind is;
    size_t at;
    const char *bytes;
} signatures[] = {
    {HDF5, 0, "\x89HDF\r\n\x1a\n"},
    {SHARD, 2, "peewsg"}, /* behind the number of its format */
    {PICTURE, 0, "\x89PNG"},
    {PICTURE, 0, "%PDF-"},
    {PICTURE, 0, "<svg"},
    {PICTURE, 0, "<?xml"},
    {PAGE, 0, "<!doctype html"},
    {CSV, 0, "t,"},
    {CSV, 0, "run,"},
    {JSON, 0, "{\n  \"format\":"},
};

/* what lines of a study begin with */
static const char *const keys[] = {
    "title:", "units:", "gravity:", "platform:", "load:", "motion:", "control:", "simulation:"};

static bool begins(const char *text, size_t length, const char *word) {
    return length >= strlen(word) && strncasecmp(text, word, strlen(word)) == 0;
}

static kind kind_of(const char *bytes, size_t length) {
    for (size_t i = 0; i < sizeof signatures / sizeof signatures[0]; i++) {
        const size_t at = signatures[i].at;
        if (length > at && begins(bytes + at, length - at, signatures[i].bytes))
            return signatures[i].is;
    }
    const char *line = bytes, *end = bytes + length;
    while (line != NULL && line < end) {
        for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
            if (begins(line, (size_t)(end - line), keys[i])) return STUDY;
        line = memchr(line, '\n', (size_t)(end - line));
        if (line != NULL) line++;
    }
    return UNKNOWN;
}

const char *gough_input_kind(int file, unsigned wanted) {
    char bytes[FIRST_BYTES];
    /* fails for pipes and terminals, whose bytes must not be taken from who reads them */
    const ssize_t got = pread(file, bytes, sizeof bytes, 0);
    const kind is = got > 0 ? kind_of(bytes, (size_t)got) : UNKNOWN;
    const unsigned flag = is == HDF5    ? GOUGH_INPUT_HDF5
                          : is == CSV   ? GOUGH_INPUT_CSV
                          : is == SHARD ? GOUGH_INPUT_SHARD
                          : is == STUDY ? GOUGH_INPUT_STUDY
                                        : 0;
    return flag & wanted ? NULL : words[is];
}
