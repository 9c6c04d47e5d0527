/* Rows of the workspace: one box of poses tested against limits of lengths, of lengths and singular poses, and of forces for boxes
 * of accelerations, as ratios to a warm start of the pose from leg lengths. */
#include <math.h>

#include "bench/bench.h"
#include "gough/pose.h"
#include "gough/workspace.h"

enum { MANY = 100 };

typedef struct {
    gough_model
        model[3]; /* lengths that leave the box undecided, lengths that it keeps, forces besides */
    gough_reach reach[3];
    double near[GOUGH_LEGS];
    int warm, test[3];
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
static void go_forces(void *memory) { test(&((spaces *)memory)->reach[2], GOUGH_INSIDE); }

static void prepare(bench *b, void *memory) {
    static void (*const go[3])(void *) = {go_lengths, go_singular, go_forces};
    spaces *p = memory;

    for (int v = 0; v < GOUGH_LEGS; v++)
        p->near[v] = b->ref.model.machine.home_length[v] * (1 + 4e-4 * (v - 2.5));
    for (int i = 0; i < 3; i++) {
        p->model[i] = b->ref.model;
        gough_platform *platform = &p->model[i].machine.platform;
        platform->length_min = (i ? 0.5 : 0.99) * p->model[i].machine.home_length[0];
        platform->force_max = i < 2 ? INFINITY : 1e6 * p->model[i].machine.load.mass;
        for (int k = 0; k < 3; k++) {
            p->model[i].workspace.acceleration[k] = i < 2 ? 0 : 0.1;
            p->model[i].workspace.angular_acceleration[k] = i < 2 ? 0 : 0.1;
        }
        if (gough_reach_init(&p->reach[i], sizeof p->reach[i], &p->model[i], NULL))
            bench_fail("no workspace");
    }
    p->warm = measure_add(&b->time, go_warm, p, MANY);
    for (int i = 0; i < 3; i++) p->test[i] = measure_add(&b->time, go[i], p, MANY);
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
    row(b, p, "box, forces besides", p->test[2]);
}

const bench_section section_workspace = {"workspace", sizeof(spaces), prepare, report};
