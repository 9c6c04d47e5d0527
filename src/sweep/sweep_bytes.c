/* The head of a sweep's file as bytes: numbers of 8 bytes, texts with their length before them. */
#define _GNU_SOURCE
#include "sweep/sweep_bytes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/sweep_identity.h"

static const uint64_t MAGIC = 0x677377656570020au; /* "gsweep", format 2, a line's end */
static const size_t LONGEST = (size_t)1
                              << 24; /* a study has 64 KiB, settings what a command line takes */

uint64_t sweep_digest(uint64_t seed, const void *bytes, size_t length) {
    const unsigned char *at = bytes;
    uint64_t sum = 0xcbf29ce484222325u ^ seed, word;
    for (; length >= 8; at += 8, length -= 8) {
        memcpy(&word, at, 8);
        sum = (sum ^ word) * 0x100000001b3u;
        sum ^= sum >> 32;
    }
    for (; length > 0; at++, length--) sum = (sum ^ *at) * 0x100000001b3u;
    return sum;
}

/* What the numbers of a sweep are, as one number of its head. */
enum { DIMENSIONLESS = 1, SIZING = 2, FORCES = 4, KINDS = 8 };

/* ---- out --------------------------------------------------------------------------------------------------------- */

static void put_number(FILE *stream, uint64_t number) { fwrite(&number, 8, 1, stream); }
static void put_real(FILE *stream, double number) { fwrite(&number, 8, 1, stream); }

static void put_text(FILE *stream, const char *text) {
    put_number(stream, strlen(text));
    fwrite(text, 1, strlen(text), stream);
}

/* The study's units in one number: whether it is dimensionless, and a byte for each base unit. */
static uint64_t units_number(const gough_units *own) {
    uint64_t number = own->dimensionless;
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) number |= (uint64_t)own->name[b] << (8 * b + 8);
    return number;
}

static bool units_of_number(uint64_t number, gough_units *own) {
    *own = gough_units_si();
    own->dimensionless = number & 1;
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) {
        const char *word =
            gough_unit_choice((gough_base_unit)b, (int)(number >> (8 * b + 8) & 255));
        if (!word) return false;
        gough_units_choose(own, (gough_base_unit)b, word);
    }
    return units_number(own) == number;
}

static void put_identity(FILE *stream, const sweep_head *head) {
    put_text(stream, head->version);
    put_text(stream, head->title);
    put_text(stream, head->study);
    put_text(stream, head->settings);
    put_number(stream, head->samples);
    put_number(stream, head->plan);
    put_number(stream, head->numerics);
    put_number(stream, (head->units.dimensionless ? DIMENSIONLESS : 0) |
                           (head->sizing ? SIZING : 0) | (head->forces ? FORCES : 0));
    put_real(stream, head->units.length);
    put_real(stream, head->units.mass);
    put_real(stream, head->units.time);
    put_real(stream, head->base_radius);
    put_real(stream, head->gravity);
    put_number(stream, units_number(&head->own));
    put_number(stream, head->runs);
    put_number(stream, head->keys);
    for (size_t k = 0; k < head->keys; k++) {
        put_text(stream, head->path[k]);
        put_text(stream, head->label[k]);
    }
}

static void *written(FILE *stream, char **bytes) {
    if (fclose(stream) == 0) return *bytes;
    free(*bytes);
    return NULL;
}

unsigned char *sweep_head_bytes(const sweep_head *head, size_t *length) {
    char *rest = NULL, *all = NULL;
    size_t rest_length = 0;
    FILE *stream = open_memstream(&rest, &rest_length);
    if (stream == NULL) return NULL;
    put_identity(stream, head);
    if (written(stream, &rest) == NULL) return NULL;
    stream = open_memstream(&all, length);
    if (stream != NULL) {
        put_number(stream, MAGIC);
        put_number(stream, head->shard);
        put_number(stream, head->shards);
        put_number(stream, head->first);
        put_number(stream, head->last);
        put_number(stream, rest_length);
        fwrite(rest, 1, rest_length, stream);
        fflush(stream);
        put_number(stream, sweep_digest(0, all, *length));
        all = written(stream, &all);
    }
    free(rest);
    return (unsigned char *)all;
}

/* ---- in ---------------------------------------------------------------------------------------------------------- */

typedef struct cursor {
    const unsigned char *at, *end;
    bool good;
} cursor;

static uint64_t get_number(cursor *c) {
    uint64_t number = 0;
    c->good = c->good && c->end - c->at >= 8;
    if (!c->good) return 0;
    memcpy(&number, c->at, 8);
    c->at += 8;
    return number;
}

static double get_real(cursor *c) {
    const uint64_t bits = get_number(c);
    double number;
    memcpy(&number, &bits, 8);
    return number;
}

static char *get_text(cursor *c) {
    const uint64_t length = get_number(c);
    c->good = c->good && length <= (uint64_t)(c->end - c->at) && !memchr(c->at, 0, length);
    char *text = c->good ? strndup((const char *)c->at, length) : NULL;
    c->good = text != NULL;
    if (text) c->at += length;
    return text;
}

size_t sweep_head_length(const unsigned char *start, size_t length) {
    cursor c = {start, start + length, length >= SWEEP_START};
    if (get_number(&c) != MAGIC) return 0;
    for (int i = 0; i < 4; i++) get_number(&c);
    const uint64_t rest = get_number(&c);
    return rest < LONGEST ? SWEEP_START + (size_t)rest + 8 : 0;
}

static void get_identity(cursor *c, sweep_head *head) {
    head->version = get_text(c);
    head->title = get_text(c);
    head->study = get_text(c);
    head->settings = get_text(c);
    head->samples = get_number(c);
    head->plan = get_number(c);
    head->numerics = get_number(c);
    const uint64_t kind = get_number(c);
    c->good = c->good && kind < KINDS;
    head->units.dimensionless = kind & DIMENSIONLESS;
    head->sizing = kind & SIZING;
    head->forces = kind & FORCES;
    head->units.length = get_real(c);
    head->units.mass = get_real(c);
    head->units.time = get_real(c);
    head->base_radius = get_real(c);
    head->gravity = get_real(c);
    c->good = c->good && units_of_number(get_number(c), &head->own);
    if (!head->units.dimensionless) head->units.force = head->own.force;
    if (!head->units.dimensionless) memcpy(head->units.name, head->own.name, sizeof head->own.name);
    head->runs = get_number(c);
    const uint64_t keys = get_number(c);
    c->good = c->good && keys > 0 && keys <= 1000 && /* as the study's reader has it */
              keys <= (uint64_t)(c->end - c->at) / 16;
    if (!c->good) return;
    head->path = calloc(keys, sizeof *head->path);
    head->label = calloc(keys, sizeof *head->label);
    c->good = head->path && head->label;
    if (c->good) head->keys = keys;
    for (size_t k = 0; k < head->keys; k++) {
        head->path[k] = get_text(c);
        head->label[k] = get_text(c);
    }
}

static bool ranges_right(const sweep_head *head) {
    const uint64_t most = 100000000;
    return head->runs > 0 && head->runs <= most && head->shards > 0 && head->shards <= most &&
           head->shard > 0 && head->shard <= head->shards &&
           head->first == (head->shard - 1) * head->runs / head->shards + 1 &&
           head->last == head->shard * head->runs / head->shards;
}

static bool is_unit(double unit) { return isfinite(unit) && unit > 0; }

/* Columns that a sweep can have, each once, and units that are numbers. A file with a right checksum may still be a forged one. */
static bool columns_right(const sweep_head *head) {
    const gough_units *own = &head->own, *units = &head->units;
    if (!is_unit(head->units.length) || !is_unit(head->units.mass) || !is_unit(head->units.time) ||
        !is_unit(head->base_radius) || !(head->gravity >= 0) || !isfinite(head->gravity))
        return false;
    if (own->dimensionless && !units->dimensionless) return false;
    if (!units->dimensionless &&
        (fabs(units->length - own->length) > 0 || fabs(units->mass - own->mass) > 0 ||
         fabs(units->time - own->time) > 0))
        return false;
    for (size_t k = 0; k < head->keys; k++) {
        if (!sweep_column_known(head->path[k], head->label[k], own)) return false;
        for (size_t i = 0; i < k; i++)
            if (strcmp(head->path[i], head->path[k]) == 0) return false;
    }
    return true;
}

sweep_head *sweep_head_read(const unsigned char *bytes, size_t length) {
    uint64_t sum;
    if (sweep_head_length(bytes, length) != length) return NULL;
    memcpy(&sum, bytes + length - 8, 8);
    sweep_head *head = calloc(1, sizeof *head);
    if (head == NULL) return NULL;
    cursor c = {bytes + 8, bytes + length - 8, sum == sweep_digest(0, bytes, length - 8)};
    head->shard = get_number(&c);
    head->shards = get_number(&c);
    head->first = get_number(&c);
    head->last = get_number(&c);
    get_number(&c);
    if (c.good) get_identity(&c, head);
    if (c.good && c.at == c.end && ranges_right(head) && columns_right(head)) return head;
    sweep_head_free(head);
    return NULL;
}
