/* Stored digests: the digits of every stepper, number type and width of lanes, of maps, tuning and sweeps, on studies chosen
 * to touch everything, are those of digests.txt. A change of digits is meant, and is then a line under Numerics in
 * CHANGELOG.md:
 *
 *     DIGESTS=write SOURCE=. build/tests/test_digest_digest     writes digests.txt anew
 *
 * Digits depend on the C library's functions and on LAPACK too, whose own digests are in the file. Where a machine's differ,
 * cases that use them are not compared, the output says so, and the test counts as skipped; the others always are. glibc
 * chooses its functions by the processor; the program restarts itself with a setting that makes it take those for every
 * x86-64 processor.
 * Label: standard.
 * Not sanitized: its digests are of all widths, and each stepper has a test of its own. */
#define _POSIX_C_SOURCE 200809L
#include <float.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "digest/stability_runs.h"
#include "gough/gough.h"
#include "gough/random.h"
#include "gough/study.h"
#include "gough/sweep.h"
#include "gough/tune.h"

/* ---- runs ---- */

/* the columns by name of today: one that is added later changes no digest */
static int hash_row(void *context, const gough_row *row) {
    uint64_t *h = context;

    for (int c = GOUGH_T; c <= GOUGH_RZX; c++) {
        hash_double(h, row->value[c]);
        if (row->quad == NULL) continue;
        const double high = (double)row->quad[c];
        hash_double(h, high);
        hash_double(h, (double)(row->quad[c] - (gough_quad)high));
    }
    return 0;
}

static void hash_end(uint64_t *h, const gough_end *end) {
    const int32_t ints[2] = {(int32_t)end->cause, (int32_t)end->leg};

    hash_bytes(h, ints, sizeof ints);
    hash_double(h, end->time);
}

static void run_forces(const input *in, uint64_t *h) {
    gough_end end;
    gough_error error = {0};

    if (gough_forces(in->study->model, &in->study->simulation, hash_row, h, NULL, NULL, &end,
                     &error) == GOUGH_ERROR_INPUT) {
        stop(in->path, error.message);
    }
    hash_end(h, &end);
}

static void run_simulate(const input *in, uint64_t *h) {
    gough_end end;
    gough_error error = {0};

    if (gough_simulate(in->study->model, &in->study->simulation, hash_row, h, &end, &error) ==
        GOUGH_ERROR_INPUT) {
        stop(in->path, error.message);
    }
    hash_end(h, &end);
}

/* ---- many runs ---- */

static void hash_outcome(uint64_t *h, const gough_outcome *out) {
    const int32_t ints[2] = {(int32_t)out->cause, (int32_t)out->leg};

    hash_bytes(h, ints, sizeof ints);
    hash_double(h, out->time);
    hash_doubles(h, out->position, 3);
    hash_doubles(h, out->angles, 3);
    hash_doubles(h, out->velocity, 3);
    hash_doubles(h, out->angular_velocity, 3);
    hash_double(h, out->position_deviation);
    hash_double(h, out->angle_deviation);
    hash_double(h, out->force);
    hash_double(h, out->speed);
    hash_double(h, out->power);
    hash_double(h, out->power_least);
    hash_double(h, out->power_greatest);
    hash_double(h, out->energy);
    hash_double(h, out->drift);
    hash_double(h, out->rows);
    if (!isnan(out->sizing[GOUGH_SIZING_LENGTH_LEAST])) hash_doubles(h, out->sizing, GOUGH_SIZINGS);
}

static int hash_sweep_row(void *context, const gough_sweep_row *row) {
    uint64_t *h = context;

    hash_outcome(h, &row->outcome);
    return 0;
}

static void run_sweep(const input *in, uint64_t *h) {
    gough_sweep_options options = gough_sweep_options_default();
    gough_sweep *sweep = NULL;
    gough_error error = {0};
    char *messages = NULL;
    size_t keys;

    if (gough_sweep_parse(in->path, in->study->text, strlen(in->study->text), in->setting,
                          in->settings, &sweep, &messages) != GOUGH_OK) {
        stop(in->path, messages);
    }
    options.lanes = in->lanes;
    options.threads = 2;
    for (size_t run = 0; run < 3; run++) {
        double value[3];
        (void)gough_sweep_keys(sweep, &keys);
        if (keys != 3) stop(in->path, "three keys are swept");
        gough_sweep_values(sweep, run, value);
        hash_doubles(h, value, keys);
    }
    if (gough_sweep_run(sweep, &options, hash_sweep_row, h, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    gough_sweep_free(sweep);
    gough_study_free_messages(messages);
}

static void run_tune(const input *in, uint64_t *h) {
    static gough_tuning_point point[GOUGH_TUNING_POINTS];
    gough_tuning_options options = gough_tuning_options_default();
    gough_tuning tuning;
    gough_error error = {0};
    size_t bytes;

    options.deviation = 1e-3;
    options.threads = 2;
    if (gough_tune_size(in->study->model, &options, &bytes, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    void *memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (memory == NULL || gough_tune(in->study->model, &in->study->simulation, true, &options,
                                     point, &tuning, memory, &error) != GOUGH_OK) {
        stop(in->path, error.message);
    }
    free(memory);
    if (!tuning.found) stop(in->path, tuning.reason);
    hash_double(h, tuning.stiffness);
    hash_double(h, tuning.damping);
    hash_double(h, tuning.deviation);
    hash_double(h, tuning.angle_deviation);
    hash_double(h, tuning.force);
    hash_double(h, tuning.speed);
}

static void run_random(const input *in, uint64_t *h) {
    (void)in;
    for (uint64_t draw = 0; draw < 500; draw++) {
        hash_double(h, gough_random_uniform(3, draw / 7, draw));
        hash_double(h, gough_random_normal(3, draw / 7, draw));
    }
}

/* ---- what stands outside of the project ---- */

static void run_libm(const input *in, uint64_t *h) {
    (void)in;
    for (int i = 1; i <= 20000; i++) {
        volatile double given = i / 2719.0; /* or the compiler computes some of them itself */
        const double x = given;
        const double y[] = {sin(x),      cos(x),  tan(x),       asin(x / 8),     acos(x / 8),
                            atan(x),     exp(-x), log(x),       pow(x, 0.125),   tanh(x),
                            erfc(x / 2), cbrt(x), atan2(x, 3.), pow(1 / x, 1.7), exp(x)};
        hash_doubles(h, y, sizeof y / sizeof *y);
    }
}

/* eigenvalues of a fixed machine, whose matrix needs neither formulas nor angles */
static void run_lapack(const input *in, uint64_t *h) { run_rest(in, h); }

/* ---- the cases ---- */

typedef struct {
    const char *name, *study;
    int needs, lanes; /* lanes: 0, one answer for every width */
    void (*run)(const input *in, uint64_t *h);
    const char *set[SETTINGS];
} digest_case;

#define FIXED(method)                                                                              \
    "simulation={duration: 2, output_step: 0.05, method: " method ", step: 0.0125}"
#define SHORT(method) "simulation={duration: 0.3, output_step: 0.1, method: " method ", step: 0.05}"
#define BAUMGARTE "simulation.constraints={baumgarte: [20, 30]}"
#define UNDRY "platform.legs.friction={viscous: 0.05}"
#define QUAD "quad"           /* not keys of a study: */
#define REACTIONS "reactions" /* split_settings() sees to them */
#define LANES(n, method)                                                                           \
    {                                                                                              \
        "lanes/" method, "heave.yaml", LIBM, n, run_sweep, {                                       \
            "simulation={duration: 2, output_step: 0.05, method: " method ", step: 0.025}",        \
                "disturbance.noise={leg_force: 0.001, interval: 0.2, seed: 3}"                     \
        }                                                                                          \
    }
#define HEAVY_LANES(n)                                                                             \
    {                                                                                              \
        "heavy/lanes", "heavy.yaml", LIBM, n, run_sweep, {                                         \
            "simulation={duration: 2, output_step: 0.05, method: rk4, step: 0.025}"                \
        }                                                                                          \
    }
#define RATTLE_KEYS                                                                                \
    "sweep.keys={platform.legs.piston.mass: {uniform: [0, 0.06]}, "                                \
    "platform.legs.friction.viscous: {uniform: [0, 0.1]}, initial.surge: {normal: [0, 0.01]}}"
#define HEAVY_RATTLE_LANES(n)                                                                      \
    {                                                                                              \
        "heavy/lanes/rattle4", "heavy.yaml", LIBM, n, run_sweep, {                                 \
            "simulation={duration: 2, output_step: 0.05, method: rattle4, step: 0.025}", UNDRY,    \
                RATTLE_KEYS                                                                        \
        }                                                                                          \
    }
/* a delay of whole steps, drives that are ideal where no stepper moves others */
#define WHOLE_DELAY "control.sampling.delay=0.05"
#define SAMPLED_LANES(n)                                                                           \
    {                                                                                              \
        "sampled/lanes", "sampled.yaml", LIBM, n, run_sweep, {                                     \
            "simulation={duration: 2, output_step: 0.05, method: rk4, step: 0.0125}", WHOLE_DELAY  \
        }                                                                                          \
    }
#define EVERY_LANE(method) LANES(1, method), LANES(2, method), LANES(4, method), LANES(8, method)
#define MAP_LANES(n)                                                                               \
    {                                                                                              \
        "map", "heave.yaml", LIBM | LAPACK, n, run_map, { NULL }                                   \
    }

static const digest_case cases[] = {
    {"libm", NULL, 0, 0, run_libm, {NULL}},
    {"lapack", "moves.yaml", 0, 0, run_lapack, {NULL}},
    {"random", NULL, LIBM, 0, run_random, {NULL}},

    {"forces/everything", "everything.yaml", LIBM, 0, run_forces, {REACTIONS}},
    {"forces/moves", "moves.yaml", LIBM, 0, run_forces, {NULL}},
    {"forces/samples", "samples.yaml", LIBM, 0, run_forces, {NULL}},
    {"forces/quad", "everything.yaml", 0, 0, run_forces, {QUAD, "simulation.duration=0.5"}},

    {"dop853/everything", "everything.yaml", LIBM, 0, run_simulate, {REACTIONS}},
    {"dop853/moves",
     "moves.yaml",
     LIBM,
     0,
     run_simulate,
     {"simulation={duration: 2, output_step: 0.04}"}},
    {"dop853/samples", "samples.yaml", LIBM, 0, run_simulate, {NULL}},
    {"dop853/heave", "heave.yaml", LIBM, 0, run_simulate, {NULL}},
    {"dop853/none", "everything.yaml", LIBM, 0, run_simulate, {"simulation.constraints=none"}},
    {"dop853/baumgarte", "everything.yaml", LIBM, 0, run_simulate, {BAUMGARTE}},
    {"dop853/fixed", "everything.yaml", LIBM, 0, run_simulate, {FIXED("dop853")}},
    {"rk4", "everything.yaml", LIBM, 0, run_simulate, {FIXED("rk4")}},
    {"rk4/moves", "moves.yaml", LIBM, 0, run_simulate, {NULL}},
    {"rk4/samples", "samples.yaml", LIBM, 0, run_simulate, {FIXED("rk4")}},
    {"rk4/baumgarte", "everything.yaml", LIBM, 0, run_simulate, {FIXED("rk4"), BAUMGARTE}},
    {"rattle2", "everything.yaml", LIBM, 0, run_simulate, {FIXED("rattle2")}},
    {"rattle4", "everything.yaml", LIBM, 0, run_simulate, {FIXED("rattle4")}},
    {"rattle6", "everything.yaml", LIBM, 0, run_simulate, {FIXED("rattle6")}},
    {"rattle8", "everything.yaml", LIBM, 0, run_simulate, {FIXED("rattle8")}},
    {"rattle4/undamped",
     "moves.yaml",
     LIBM,
     0,
     run_simulate,
     {FIXED("rattle4"), "control.damping=0"}},

    {"quad/dop853",
     "heave.yaml",
     0,
     0,
     run_simulate,
     {"simulation={duration: 0.5, output_step: 0.1, tolerance: 1e-20}", QUAD}},
    {"quad/rk4", "everything.yaml", LIBM, 0, run_simulate, {SHORT("rk4"), QUAD}},
    {"quad/rattle2", "everything.yaml", LIBM, 0, run_simulate, {SHORT("rattle2"), QUAD}},
    {"quad/rattle8", "samples.yaml", 0, 0, run_simulate, {SHORT("rattle8"), QUAD}},

    {"heavy/forces", "heavy.yaml", LIBM, 0, run_forces, {REACTIONS}},
    {"heavy/dop853", "heavy.yaml", LIBM, 0, run_simulate, {REACTIONS}},
    {"heavy/rk4", "heavy.yaml", LIBM, 0, run_simulate, {FIXED("rk4")}},
    {"heavy/rattle6", "heavy.yaml", LIBM, 0, run_simulate, {FIXED("rattle6"), UNDRY}},
    {"heavy/rattle2/undamped",
     "heavy.yaml",
     LIBM,
     0,
     run_simulate,
     {FIXED("rattle2"), UNDRY, "platform.legs.friction.viscous=0", "control.damping=0"}},
    {"heavy/quad/rattle8", "heavy.yaml", 0, 0, run_simulate, {SHORT("rattle8"), UNDRY, QUAD}},
    {"heavy/quad", "heavy.yaml", 0, 0, run_simulate, {SHORT("rk4"), QUAD}},
    {"heavy/linearise", "heavy.yaml", LIBM, 0, run_linearise, {NULL}},
    HEAVY_LANES(1),
    HEAVY_LANES(2),
    HEAVY_LANES(4),
    HEAVY_LANES(8),
    HEAVY_RATTLE_LANES(1),
    HEAVY_RATTLE_LANES(2),
    HEAVY_RATTLE_LANES(4),
    HEAVY_RATTLE_LANES(8),

    {"sampled/dop853", "sampled.yaml", LIBM, 0, run_simulate, {NULL}},
    {"sampled/rk4", "sampled.yaml", LIBM, 0, run_simulate, {FIXED("rk4")}},
    {"sampled/rattle4",
     "sampled.yaml",
     LIBM,
     0,
     run_simulate,
     {FIXED("rattle4"), "actuators={max_force: 0.215}"}},
    {"sampled/quad",
     "sampled.yaml",
     LIBM,
     0,
     run_simulate,
     {SHORT("rk4"), WHOLE_DELAY, "control.sampling.period=0.05", QUAD}},
    {"sampled/rest", "sampled.yaml", LIBM | LAPACK, 0, run_sampled, {NULL}},
    SAMPLED_LANES(1),
    SAMPLED_LANES(2),
    SAMPLED_LANES(4),
    SAMPLED_LANES(8),

    EVERY_LANE("rk4"),
    EVERY_LANE("dop853"),
    EVERY_LANE("rattle4"),
    {"sweep/adaptive", "heave.yaml", LIBM, 0, run_sweep, {"simulation.duration=2"}},

    {"linearise", "everything.yaml", LIBM, 0, run_linearise, {NULL}},
    {"rest", "heave.yaml", LAPACK, 0, run_rest, {NULL}},
    {"floquet", "heave.yaml", LIBM | LAPACK, 0, run_floquet, {NULL}},
    MAP_LANES(1),
    MAP_LANES(2),
    MAP_LANES(4),
    MAP_LANES(8),
    {"tune", "heave.yaml", LIBM | LAPACK, 0, run_tune, {NULL}},
};
enum { CASES = sizeof cases / sizeof *cases };

static void split_settings(const digest_case *c, input *in, char text[SETTINGS][256]) {
    in->settings = 0;
    for (int i = 0; i < SETTINGS && c->set[i]; i++) {
        in->quad |= strcmp(c->set[i], QUAD) == 0;
        in->reactions |= strcmp(c->set[i], REACTIONS) == 0;
        if (strchr(c->set[i], '=') == NULL) continue;
        snprintf(text[i], sizeof text[i], "%s", c->set[i]);
        char *value = strchr(text[i], '=');
        *value++ = '\0';
        in->setting[in->settings++] = (gough_setting){text[i], value};
    }
}

static uint64_t digest_of(const digest_case *c, const char *folder) {
    char text[SETTINGS][256];
    input in = {.lanes = c->lanes};
    uint64_t hash = hash_start;
    char *messages = NULL;

    split_settings(c, &in, text);
    if (c->study) {
        snprintf(in.path, sizeof in.path, "%s/%s", folder, c->study);
        if (gough_study_read(in.path, in.setting, in.settings, &in.study, &messages) != GOUGH_OK) {
            stop(c->name, messages);
        }
        gough_study_free_messages(messages);
        if (in.quad) in.study->simulation.precision = GOUGH_QUADRUPLE;
        in.study->simulation.reactions = in.reactions;
    }
    c->run(&in, &hash);
    gough_study_free(in.study);
    return hash;
}

/* ---- the file ---- */

typedef struct {
    char name[NAME];
    uint64_t hash;
} stored;

static size_t read_stored(const char *path, stored entry[MOST]) {
    FILE *file = fopen(path, "r");
    char line[256];
    size_t count = 0;

    if (file == NULL) stop(path, "cannot be read");
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#') continue;
        if (count == MOST ||
            sscanf(line, "%63s %" SCNx64, entry[count].name, &entry[count].hash) != 2) {
            stop(path, "a line that is no name and digest");
        }
        count++;
    }
    fclose(file);
    return count;
}

static const stored *find(const stored *entry, size_t count, const char *name) {
    for (size_t i = 0; i < count; i++) {
        if (strcmp(entry[i].name, name) == 0) return &entry[i];
    }
    return NULL;
}

static int write_stored(const char *path, const uint64_t hash[CASES]) {
    FILE *file = fopen(path, "w");

    if (file == NULL) stop(path, "cannot be written");
    fprintf(file,
            "# Digests of the digits of this edition, written by tests/digest/test_digest.c.\n");
    for (int i = 0; i < CASES; i++) {
        if (i > 0 && strcmp(cases[i].name, cases[i - 1].name) == 0) continue;
        fprintf(file, "%-24s %016" PRIx64 "\n", cases[i].name, hash[i]);
    }
    return fclose(file) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* whether the digest of a library that cases depend on is the stored one */
static int known(const stored *entry, size_t count, const uint64_t hash[CASES], const char *name) {
    const stored *s = find(entry, count, name);

    for (int i = 0; i < CASES; i++) {
        if (strcmp(cases[i].name, name) == 0) return s && s->hash == hash[i];
    }
    return 0;
}

/* number of cases that differ; *skipped: of those not compared */
static int compare(const stored *entry, size_t count, const uint64_t hash[CASES], int *skipped) {
    const int libm = known(entry, count, hash, "libm");
    const int lapack = libm && known(entry, count, hash, "lapack");
    int wrong = 0;

    if (!libm) printf("digest: the C library's functions are not those of digests.txt\n");
    if (libm && !lapack) printf("digest: LAPACK is not that of digests.txt\n");
    for (int i = 2; i < CASES; i++) {
        const stored *s = find(entry, count, cases[i].name);
        if (s == NULL) {
            printf("digest: %s is not in digests.txt\n", cases[i].name);
            wrong++;
        } else if (((cases[i].needs & LIBM) && !libm) || ((cases[i].needs & LAPACK) && !lapack)) {
            (*skipped)++;
        } else if (s->hash != hash[i]) {
            printf("digest: %s (lanes %d): %016" PRIx64 ", stored %016" PRIx64 "\n", cases[i].name,
                   cases[i].lanes, hash[i], s->hash);
            wrong++;
        }
    }
    return wrong;
}

/* the same functions of the C library on every processor: glibc reads this when a program starts */
static void plain_libm(char *argv[]) {
    if (getenv("GLIBC_TUNABLES")) return;
    if (setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4", 1) == 0) {
        execv("/proc/self/exe", argv);
    }
    stop("GLIBC_TUNABLES", "the program cannot restart itself with it");
}

int main(int argc, char *argv[]) {
    (void)argc;
    plain_libm(argv);
    const char *source = getenv("SOURCE"), *mode = getenv("DIGESTS");
    static stored entry[MOST];
    char folder[2048], path[2100];
    uint64_t hash[CASES];
    int skipped = 0, narrow = 0;

    snprintf(folder, sizeof folder, "%s/tests/digest", source ? source : ".");
    snprintf(path, sizeof path, "%s/digests.txt", folder);
    for (int i = 0; i < CASES; i++) {
        if (cases[i].lanes > gough_batch_lanes()) { /* wider than this processor's */
            hash[i] = hash[i - 1];
            narrow++;
        } else {
            hash[i] = digest_of(&cases[i], folder);
        }
    }
    if (mode && strcmp(mode, "write") == 0) return write_stored(path, hash);

    const size_t count = read_stored(path, entry);
    const int wrong = compare(entry, count, hash, &skipped);
    printf("digest: %d cases, %d differ, %d not compared (another C library or LAPACK), %d wider "
           "than this processor's lanes\n",
           CASES, wrong, skipped, narrow);
    if (wrong)
        printf("If the change of digits is meant, see the head of tests/digest/test_digest.c.\n");
    if (wrong) return EXIT_FAILURE;
    return skipped ? 77 : EXIT_SUCCESS;
}
