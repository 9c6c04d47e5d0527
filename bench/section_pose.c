/* Rows of the pose from leg lengths: a warm start with its certificate, the paths to all poses in lanes, all poses with their
 * certificates; as ratios to the warm start. */
#include <math.h>

#include "bench/bench.h"
#include "gough/pose.h"
#include "pose/start_system.h"
#include "pose/track_table.h"

typedef struct {
    const gough_machine *machine;
    double near[GOUGH_LEGS]; /* a change of a thousandth of the lengths from home */
    path_system to;
    path_end end[PATHS];
    gough_pose pose[GOUGH_POSES];
    double error;          /* of the warm start */
    gough_machine general; /* the same with its joints moved */
    int warm, tube, all, forty, tracks[WIDTHS];
} poses;

enum { WARM = 100 };

static void go_warm(void *memory) {
    poses *p = memory;

    for (int n = 0; n < WARM; n++) {
        gough_state state = gough_state_home(p->machine);
        gough_pose_certificate c;
        if (gough_pose_from_lengths(p->machine, p->near, 1, &state, &c, NULL))
            bench_fail("no pose near home");
        p->error = c.position_error;
    }
}

static void go_tube(void *memory) {
    static const double tube[GOUGH_LEGS] = {1e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6};
    poses *p = memory;

    for (int n = 0; n < WARM; n++) {
        gough_state state = gough_state_home(p->machine);
        if (gough_pose_tube(p->machine, p->near, tube, 1, &state, NULL, NULL))
            bench_fail("no pose near home");
    }
}

static void go_all(void *memory) {
    poses *p = memory;
    gough_poses found;

    if (gough_poses_all(p->machine, p->near, p->pose, &found, NULL) ||
        found.complete == GOUGH_COMPLETE_NO)
        bench_fail("not all poses");
}

static void go_forty(void *memory) {
    poses *p = memory;
    gough_poses found;

    if (gough_poses_all(&p->general, p->general.home_length, p->pose, &found, NULL) ||
        found.complete != GOUGH_COMPLETE_PROVED)
        bench_fail("not all forty poses");
}

static void track(poses *p, path_tracker *tracker) {
    tracker(&start_system, &p->to, start_root, PATHS, p->end);
    for (int i = 0; i < PATHS; i++)
        if (p->end[i].left > 0) bench_fail("a path does not end");
}

static void go_track_1(void *memory) { track(memory, path_track_1); }
static void go_track_2(void *memory) { track(memory, path_track_2); }
#if defined(__x86_64__)
static void go_track_4(void *memory) { track(memory, path_track_4); }
static void go_track_8(void *memory) { track(memory, path_track_8); }
#endif

static bool has_lanes(int width) {
#if defined(__x86_64__)
    if (bench_lanes(width) == 8)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    if (bench_lanes(width) == 4) return __builtin_cpu_supports("avx2");
#endif
    return bench_lanes(width) <= 2;
}

static double random_between(uint64_t *state, double low, double high) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*state >> 11) * 0x1p-53;
}

/* each coordinate of a joint moved by at most a tenth of the base radius */
static void move_joints(const gough_machine *machine, gough_machine *moved) {
    gough_platform p = machine->platform;
    uint64_t state = 2;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int k = 0; k < 3; k++) {
            p.base[v][k] += random_between(&state, -0.1, 0.1);
            p.top[v][k] += random_between(&state, -0.1, 0.1);
        }
    }
    if (gough_machine_init(moved, &p, &machine->load, machine->gravity, NULL))
        bench_fail("no machine");
}

/* another system at random, whose forty paths are regular */
static void random_system(path_system *s) {
    uint64_t state = 1;

    for (int v = 0; v < PATH_ROWS; v++) {
        for (int n = 0; n < PATH_PRODUCTS; n++) {
            for (int part = 0; part < 2; part++)
                s->c[v][n][part] = random_between(&state, -0.5, 0.5);
        }
    }
}

static void prepare(bench *b, void *memory) {
    static void (*const go[WIDTHS])(void *) = {
        go_track_1,
        go_track_2,
#if defined(__x86_64__)
        go_track_4,
        go_track_8
#endif
    };
    poses *p = memory;

    p->machine = &b->ref.model.machine;
    for (int v = 0; v < GOUGH_LEGS; v++)
        p->near[v] = p->machine->home_length[v] * (1 + 4e-4 * (v - 2.5));
    random_system(&p->to);
    p->warm = measure_add(&b->time, go_warm, p, WARM);
    p->tube = measure_add(&b->time, go_tube, p, WARM);
    for (int w = 0; w < WIDTHS; w++)
        p->tracks[w] = go[w] && has_lanes(w) ? measure_add(&b->time, go[w], p, 1) : -1;
    p->all = measure_add(&b->time, go_all, p, 1);
    move_joints(p->machine, &p->general);
    p->forty = measure_add(&b->time, go_forty, p, 1);
}

static void row(bench *b, const poses *p, const char *name, int lanes, int item) {
    const timing t = measure_of(&b->time, item), warm = measure_of(&b->time, p->warm);

    table_begin_row(&b->out, "%s", name);
    table_value(&b->out, lanes);
    table_value(&b->out, t.median * 1e6);
    table_value(&b->out, t.quietest * 1e6);
    table_value(&b->out, t.median / warm.median);
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {{"lanes", AS_PLAIN},
                                           {"us", AS_PLAIN},
                                           {"quietest", AS_PLAIN},
                                           {"of a warm start", AS_PLAIN}};
    const poses *p = memory;
    int widest = 1;

    for (int w = 0; w < WIDTHS; w++)
        if (p->tracks[w] >= 0) widest = bench_lanes(w);
    table_section(&b->out, "The pose from leg lengths", 4, columns);
    row(b, p, "warm start with certificate", 1, p->warm);
    row(b, p, "the same in a tube", 1, p->tube);
    for (int w = 0; w < WIDTHS; w++)
        if (p->tracks[w] >= 0) row(b, p, "forty paths", bench_lanes(w), p->tracks[w]);
    row(b, p, "all poses, certified", widest, p->all);
    row(b, p, "the same of joints moved", widest, p->forty);
}

const bench_section section_pose = {"pose", sizeof(poses), prepare, report};
