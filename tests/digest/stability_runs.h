/* What a digest is made from, and those of stability: matrices, multipliers, maps. */
#ifndef DIGEST_STABILITY_RUNS_H
#define DIGEST_STABILITY_RUNS_H

#include <stdio.h>
#include <stdlib.h>

#include "digest/hash.h"
#include "gough/analyse.h"
#include "gough/map.h"
#include "gough/study.h"

enum { LIBM = 1, LAPACK = 2, SETTINGS = 4, NAME = 64, MOST = 256 };

typedef struct {
    gough_study *study;
    gough_setting setting[SETTINGS];
    size_t settings;
    char path[4096];
    int lanes;
    bool quad, reactions;
} input;

static void stop(const char *what, const char *why) {
    printf("digest: %s: %s\n", what, why);
    exit(EXIT_FAILURE);
}

static void run_linearise(const input *in, uint64_t *h) {
    double matrix[GOUGH_LINEAR][GOUGH_LINEAR];
    gough_error error = {0};

    for (double t = 0; t < 1.5; t += 0.4) {
        if (gough_linearise(in->study->model, t, NULL, GOUGH_LINEAR, matrix[0], &error) !=
            GOUGH_OK) {
            stop(in->path, error.message);
        }
        hash_doubles(h, &matrix[0][0], GOUGH_LINEAR * GOUGH_LINEAR);
    }
}

static void hash_mode(uint64_t *h, const gough_mode *mode) {
    hash_text(h, mode->name);
    hash_doubles(h, mode->share, 4);
}

static void run_rest(const input *in, uint64_t *h) {
    gough_error error = {0};
    gough_rest rest;

    if (gough_stability_at_rest(in->study->model, NULL, &rest, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    hash_doubles(h, &rest.geometric[0][0], 36);
    hash_doubles(h, &rest.legs[0][0], 36);
    hash_doubles(h, rest.force, GOUGH_LEGS);
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        hash_doubles(h, rest.eigenvalue[i].value, 2);
        hash_mode(h, &rest.eigenvalue[i].mode);
    }
    for (int i = 0; i < 6; i++) hash_double(h, rest.threshold[i].stiffness);
}

static void run_sampled(const input *in, uint64_t *h) {
    gough_error error = {0};
    gough_sampled_rest rest;
    gough_sampled_margins margins;

    if (gough_sampled_at_rest(in->study->model, NULL, &rest, &error) != GOUGH_OK ||
        gough_sampled_margins_at_rest(in->study->model, NULL, &margins, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    for (size_t i = 0; i < rest.listed; i++) {
        hash_doubles(h, rest.multiplier[i].value, 2);
        hash_mode(h, &rest.multiplier[i].mode);
    }
    hash_double(h, rest.growth);
    hash_double(h, margins.lower.stiffness);
    hash_double(h, margins.upper.stiffness);
    hash_double(h, margins.longest_period);
    hash_double(h, margins.longest_delay);
}

static void run_floquet(const input *in, uint64_t *h) {
    gough_error error = {0};
    gough_floquet f;

    if (gough_floquet_multipliers(in->study->model, NULL, 0, &f, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    hash_double(h, f.start);
    hash_double(h, f.period);
    for (int i = 0; i < GOUGH_LINEAR; i++) hash_doubles(h, f.monodromy[i], GOUGH_LINEAR);
    for (int i = 0; i < GOUGH_LINEAR; i++) hash_doubles(h, f.multiplier[i].value, 2);
}

static void run_map(const input *in, uint64_t *h) {
    enum { POINTS = 15, ROWS = 2, INTERVALS = 32 };
    static gough_map_point point[ROWS * POINTS];
    static gough_map_row row[ROWS];
    static gough_interval interval[ROWS * INTERVALS];
    gough_map map = {point, row, interval};
    gough_map_options options = gough_map_options_default();
    gough_error error = {0};
    size_t bytes;

    options.stiffness = (gough_map_range){0.4, 2, POINTS, false};
    options.axis = GOUGH_MAP_AMPLITUDE;
    options.second = (gough_map_range){0.5, 1.5, ROWS, false};
    options.intervals = INTERVALS;
    options.lanes = in->lanes;
    options.threads = 2;
    if (gough_map_size(in->study->model, &options, &bytes, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    void *memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (memory == NULL ||
        gough_map_find(in->study->model, &options, &map, memory, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    free(memory);
    for (size_t i = 0; i < ROWS * POINTS; i++) {
        hash_double(h, point[i].growth);
        hash_double(h, point[i].rate);
        hash_text(h, point[i].mode);
    }
    for (size_t r = 0; r < ROWS; r++) {
        for (size_t i = 0; i < row[r].intervals; i++) {
            const gough_interval *tongue = &interval[r * INTERVALS + i];
            hash_double(h, tongue->from);
            hash_double(h, tongue->to);
            hash_double(h, tongue->stiffness);
            hash_double(h, tongue->growth);
        }
    }
}

#endif
