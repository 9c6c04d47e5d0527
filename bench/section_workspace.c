/* Rows of the workspace: one box of poses tested against limits of lengths, of lengths and singular poses, of the least singular
 * value, and of forces for boxes of accelerations; whole searches; all as ratios to a warm start of the pose from leg lengths. */
#include <math.h>

#include "bench/bench.h"
#include "gough/pose.h"
#include "gough/workspace.h"

enum { MANY = 100, TESTS = 4, SEARCHES = 5, MODELS = 6 };

typedef struct {
    /* lengths that leave the box undecided, lengths that it keeps, a least singular value besides, forces besides, lengths and a
     * least singular value that searches meet, forces besides */
    gough_model model[MODELS];
    gough_reach reach[MODELS];
    double near[GOUGH_LEGS];
    int warm, test[TESTS], search[SEARCHES];
} spaces;

static const gough_box box = {{-0.02, -0.02, -0.02, -0.02, -0.02, -0.02},
                              {0.02, 0.02, 0.02, 0.02, 0.02, 0.02}};

static void go_warm(void *memory) {
    const spaces *p = memory;

    for (int n = 0; n < MANY; n++) {
        gough_state state = gough_state_home(&p->model[0].machine);
        if (gough_pose_from_lengths(&p->model[0].machine, p->near, 1, &state, NULL, NULL))
            bench_fail("no pose near home");
    }
}

static void test(const gough_reach *reach, gough_verdict wanted) {
    for (int n = 0; n < MANY; n++)
        if (gough_box_test(reach, &box, NULL) != wanted) bench_fail("another verdict of a box");
}

static void go_lengths(void *memory) { test(&((spaces *)memory)->reach[0], GOUGH_UNDECIDED); }
static void go_singular(void *memory) { test(&((spaces *)memory)->reach[1], GOUGH_INSIDE); }
static void go_value(void *memory) { test(&((spaces *)memory)->reach[2], GOUGH_INSIDE); }
static void go_forces(void *memory) { test(&((spaces *)memory)->reach[3], GOUGH_INSIDE); }

static void go_travel(void *memory) {
    const spaces *p = memory;
    gough_travel travel;

    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        if (gough_workspace_travel(&p->reach[4], c, &travel, NULL)) bench_fail("no travel");
}

static void find_box(const gough_reach *reach) {
    gough_largest_box largest;

    if (gough_workspace_box(reach, &box, &largest, NULL) ||
        !(largest.scale > largest.upper * (1 - 1e-4)))
        bench_fail("no largest box");
}
static void go_box(void *memory) { find_box(&((spaces *)memory)->reach[4]); }
static void go_forced_box(void *memory) { find_box(&((spaces *)memory)->reach[5]); }

static void go_volume(void *memory) {
    const double level[3] = {0, 0, 0};
    gough_volume volume;

    if (gough_workspace_volume(&((spaces *)memory)->reach[4], level, &volume, NULL))
        bench_fail("no volume");
}

static void go_worst(void *memory) {
    gough_envelope envelope;

    if (gough_workspace_envelope(&((spaces *)memory)->reach[3], &box, &envelope, NULL))
        bench_fail("no worst values");
}

/* least and greatest length in parts of that at home, least singular value, whether forces are asked for */
static const struct {
    double least, greatest, value;
    bool forces;
} kinds[MODELS] = {{0.99, INFINITY, 0, false},  {0.5, INFINITY, 0, false},
                   {0.5, INFINITY, 0.2, false}, {0.5, INFINITY, 0, true},
                   {0.85, 1.2, 0, false},       {0.85, 1.2, 0, true}};

static void make(bench *b, spaces *p, int i) {
    p->model[i] = b->ref.model;
    gough_platform *platform = &p->model[i].machine.platform;
    const double home = p->model[i].machine.home_length[0];
    platform->length_min = kinds[i].least * home;
    platform->length_max = kinds[i].greatest * home;
    platform->force_max = kinds[i].forces ? 1e6 * p->model[i].machine.load.mass : INFINITY;
    p->model[i].workspace.least_singular_value = kinds[i].value;
    for (int k = 0; k < 3; k++) {
        p->model[i].workspace.acceleration[k] = kinds[i].forces ? 0.1 : 0;
        p->model[i].workspace.angular_acceleration[k] = kinds[i].forces ? 0.1 : 0;
    }
    if (gough_reach_init(&p->reach[i], sizeof p->reach[i], &p->model[i], NULL))
        bench_fail("no workspace");
}

static void prepare(bench *b, void *memory) {
    static void (*const tests[TESTS])(void *) = {go_lengths, go_singular, go_value, go_forces};
    static void (*const searches[SEARCHES])(void *) = {go_travel, go_box, go_forced_box, go_volume,
                                                       go_worst};
    spaces *p = memory;

    for (int v = 0; v < GOUGH_LEGS; v++)
        p->near[v] = b->ref.model.machine.home_length[v] * (1 + 4e-4 * (v - 2.5));
    for (int i = 0; i < MODELS; i++) make(b, p, i);
    p->warm = measure_add(&b->time, go_warm, p, MANY);
    for (int i = 0; i < TESTS; i++) p->test[i] = measure_add(&b->time, tests[i], p, MANY);
    for (int i = 0; i < SEARCHES; i++) p->search[i] = measure_add(&b->time, searches[i], p, 1);
}

static void row(bench *b, const spaces *p, const char *name, int item) {
    const timing t = measure_of(&b->time, item), warm = measure_of(&b->time, p->warm);

    table_begin_row(&b->out, "%s", name);
    table_value(&b->out, t.median * 1e6);
    table_value(&b->out, t.quietest * 1e6);
    table_value(&b->out, t.median / warm.median);
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {
        {"us", AS_PLAIN}, {"quietest", AS_PLAIN}, {"of a warm start", AS_PLAIN}};
    const spaces *p = memory;

    table_section(&b->out, "Boxes of poses", 3, columns);
    row(b, p, "warm start of a pose", p->warm);
    row(b, p, "box, undecided by lengths", p->test[0]);
    row(b, p, "box, no singular pose", p->test[1]);
    row(b, p, "box, least singular value", p->test[2]);
    row(b, p, "box, forces besides", p->test[3]);
    row(b, p, "travel of six axes, lengths", p->search[0]);
    row(b, p, "largest box, lengths", p->search[1]);
    row(b, p, "largest box, forces besides", p->search[2]);
    row(b, p, "volume, lengths", p->search[3]);
    row(b, p, "worst values over a box", p->search[4]);
}

const bench_section section_workspace = {"workspace", sizeof(spaces), prepare, report};
