/* The machines of the tests of designs, and their requests. */
#include "design/jack.h"

#include <math.h>
#include <string.h>

static const double BASE = 0.9, TOP = 0.6, HALF = 10 * pi / 180, MASS = 300, GRAVITY = 9.80665;

/* joints of a leg are 60° − 2·10° apart */
double jack_across(void) {
    return sqrt(BASE * BASE + TOP * TOP - 2 * BASE * TOP * cos(pi / 3 - 2 * HALF));
}

double jack_weight(void) { return MASS * GRAVITY; }

static gough_status make_jack(void *context, const double *value, const gough_model **model,
                              gough_error *error) {
    jack *j = context;
    gough_platform p = gough_platform_symmetric(BASE, HALF, TOP, HALF, value[0]);
    const gough_load load = {.mass = MASS, .inertia = {{9, 0, 0}, {0, 9, 0}, {0, 0, 9}}};
    const double gravity[3] = {0, 0, -GRAVITY};
    j->made++;
    if (value[0] > j->refuse_above)
        return gough_fail(error, GOUGH_ERROR_INPUT, "the height %g is refused", value[0]);
    for (int v = 0; v < GOUGH_LEGS && j->longest < INFINITY; v++)
        p.legs.length[v][0] = 0.01, p.legs.length[v][1] = j->longest;
    memset(&j->model.motion, 0, sizeof j->model.motion);
    j->model.workspace = (gough_workspace){.box = {[GOUGH_HEAVE] = {-JACK_HEAVE, JACK_HEAVE}}};
    *model = &j->model;
    return gough_machine_init(&j->model.machine, &p, &load, gravity, error);
}

gough_design_request jack_request(jack *j) {
    gough_design_request r = gough_design_request_default();
    r.keys = 1;
    r.least[0] = 0.5, r.greatest[0] = 2.5, r.start[0] = 1;
    r.make = make_jack;
    r.context = j;
    r.evaluations = 300;
    j->longest = j->refuse_above = INFINITY;
    return r;
}

static gough_status make_base(void *context, const double *x, const gough_model **model,
                              gough_error *error) {
    base *b = context;
    gough_platform p = gough_platform_symmetric(x[0], x[1] * pi / 180, x[2], x[3] * pi / 180, x[4]);
    const gough_load load = {.mass = 1050,
                             .center_of_mass = {0.12, -0.04, 0.55},
                             .inertia = {{410, 0, 0}, {0, 520, 0}, {0, 0, 460}}};
    const double gravity[3] = {0, 0, -GRAVITY};
    memset(&b->model.motion, 0, sizeof b->model.motion);
    b->model.workspace = (gough_workspace){
        .box = {{-0.2, 0.2}, {-0.2, 0.2}, {-0.15, 0.15}, {-0.2, 0.2}, {-0.2, 0.2}, {-0.25, 0.25}},
        .acceleration = {3, 3, 4},
        .velocity = {0, 0, 0.5}};
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        b->model.workspace.box[c][0] *= b->part, b->model.workspace.box[c][1] *= b->part;
    for (int v = 0; v < GOUGH_LEGS; v++) p.legs.base_swing[v] = 40 * pi / 180;
    *model = &b->model;
    return gough_machine_init(&b->model.machine, &p, &load, gravity, error);
}

gough_design_request base_request(base *b) {
    const double least[] = {1.0, 5, 0.8, 5, 1.2}, greatest[] = {2.2, 30, 1.9, 30, 2.6},
                 start[] = {1.5, 8, 1.1, 8, 2.0};
    gough_design_request r = gough_design_request_default();
    r.keys = 5;
    memcpy(r.least, least, sizeof least);
    memcpy(r.greatest, greatest, sizeof greatest);
    memcpy(r.start, start, sizeof start);
    b->part = 1;
    r.telescope = 0.35;
    r.least_singular_value = 0.1;
    r.make = make_base;
    r.context = b;
    return r;
}

void jack_refuse(gough_design_request r, const char *part) {
    gough_design_result d;
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_design(&r, &d, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, part) != NULL, "'%s' lacks '%s'", error.message, part);
    ck_assert(!d.found);
}
