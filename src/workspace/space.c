/* Boxes of poses: first order exactly, second order bounded, (space-1) … (space-5). Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/space.h"

#include "plant/hexapod.h"

/* A vector of a leg is a sum of some thirty products, each good to a few roundings of the distances in it. */
static const double VECTOR_ROUNDED = 64 * DBL_EPSILON;
/* what sums of half widths lose at most */
static const double UPWARDS = 1 + 16 * DBL_EPSILON;

/* which of the numbers that are asked for have a limit */
static void find_parts(space *s) {
    const gough_limits *l = &s->reach->limits;
    const gough_workspace *w = &s->reach->asked;
    double moving = 0, turning = 0;
    for (int k = 0; k < 3; k++) {
        moving += w->velocity[k] + w->angular_velocity[k];
        turning += w->acceleration[k] + w->angular_acceleration[k];
    }
    s->parts = (asked_parts){false, false};
    s->speed = false;
    for (int v = 0; v < LEGS; v++) {
        s->parts.force |= l->force[v][0] > -INFINITY || l->force[v][1] < INFINITY;
        s->parts.acceleration |= l->acceleration[v] < INFINITY && moving + turning > 0;
        s->speed |= l->speed[v] < INFINITY && moving > 0;
    }
    s->only_lengths =
        !s->parts.force && !s->parts.acceleration && !s->speed && !(w->least_singular_value > 0);
    for (int v = 0; v < LEGS; v++)
        s->only_lengths &=
            !(l->base_swing[v] < REAL_PI) && !(l->top_swing[v] < REAL_PI) && !(l->diameter[v] > 0);
}

static vector vector_of_top(const triad *R, const double top[3], vector about) {
    return out_of(R, subtract(vector_of(top), about));
}

void space_begin(space *s, const gough_reach *reach) {
    const gough_platform *p = &reach->machine->platform;
    const gough_box home = {{0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}};
    box_view view;

    s->reach = reach;
    s->way = NULL;
    s->regular = s->parts_wanted = false;
    find_parts(s);
    hexapod_of_machine(&s->h, reach->machine);
    s->about = vector_of(reach->about);
    s->home = add(s->about, (vector){0, 0, p->height});
    s->size = norm(s->home) + norm(s->about);
    for (int v = 0; v < LEGS; v++) {
        const double far = norm(vector_of(p->base[v])) + norm(vector_of(p->top[v]));
        s->size = fmax(s->size, norm(s->home) + norm(s->about) + far);
    }
    box_view_of(s, &home, &view);
    for (int v = 0; v < LEGS; v++) s->along[v] = view.g.n[v];
}

/* about which the three angles turn: of R = Rz Ry Rx these are z, Rz y and R x, of the other order x, Rx y and R z */
static void find_axes(const space *s, box_view *view) {
    const double *angle = view->centre + GOUGH_ROLL;

    if (s->reach->order == GOUGH_ZYX) {
        view->axis[0] = view->R.i;
        view->axis[1] = (vector){-sin(angle[2]), cos(angle[2]), 0};
        view->axis[2] = (vector){0, 0, 1};
    } else {
        view->axis[0] = (vector){1, 0, 0};
        view->axis[1] = (vector){0, cos(angle[0]), sin(angle[0])};
        view->axis[2] = view->R.k;
    }
}

/* (space-2): along any line of the box, how fast the top turns, and how that changes. The axis of the pitch is at right angles to
 * both others, and those have the cosine ∓ sin(pitch). */
static void find_turn(const space *s, box_view *view) {
    const double *w = view->half + GOUGH_ROLL;
    const int outer = s->reach->order == GOUGH_ZYX ? 2 : 0, inner = 2 - outer;
    const double tilt = fmin(1, fabs(sin(view->centre[GOUGH_PITCH])) + w[1]);
    const double square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2] + 2 * w[0] * w[2] * tilt;
    const double twist = w[outer] * w[1] + w[inner] * sqrt(w[outer] * w[outer] + w[1] * w[1]);
    view->turn = sqrt(square) * UPWARDS;
    view->bend = (square + twist) * UPWARDS;
}

/* (space-4): l = l_c ± (Σ |n·∂q_k| + ½ (v²/l_min + |arm| β)) */
static void find_lengths(box_view *view, int v) {
    const double l = view->g.length[v], moved = view->moved[v],
                 least = l - moved - 2 * view->rounding;
    double wide = 0, slope[SIDES];
    view->shortest[v] = least;
    view->wide[v] = INFINITY;
    if (!(least > 0)) return;
    box_length_slopes(view, v, slope);
    for (int k = 0; k < SIDES; k++) wide += fabs(slope[k]);
    wide += 0.5 * (moved * moved / least + norm(view->arm[v]) * view->bend);
    view->wide[v] = wide * UPWARDS + 2 * view->rounding;
    view->shortest[v] = fmax(least, l - view->wide[v]);
}

void box_view_of(const space *s, const gough_box *box, box_view *view) {
    const gough_platform *p = &s->reach->machine->platform;
    double R[3][3], square = 0;

    view->way = s->way;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        view->centre[c] = 0.5 * box->least[c] + 0.5 * box->greatest[c];
        view->half[c] = fmax(box->greatest[c] - view->centre[c], view->centre[c] - box->least[c]);
    }
    gough_rotation_in_order(s->reach->order, view->centre + GOUGH_ROLL, R);
    view->R = (triad){
        {R[0][0], R[1][0], R[2][0]}, {R[0][1], R[1][1], R[2][1]}, {R[0][2], R[1][2], R[2][2]}};
    find_axes(s, view);

    const vector point = add(s->home, vector_of(view->centre));
    view->x = coordinates_of_top(&s->h, s->about, point, &view->R);
    legs_at(&s->h, &view->x, &view->g);

    for (int c = 0; c < 3; c++) square += view->half[c] * view->half[c];
    view->shift = sqrt(square) * UPWARDS;
    find_turn(s, view);
    view->rounding = VECTOR_ROUNDED * (s->size + norm(vector_of(view->centre)));
    for (int v = 0; v < LEGS; v++) {
        /* no point of the top moves further: |q'| ≤ |w_t| + |arm| σ */
        view->arm[v] = vector_of_top(&view->R, p->top[v], s->about);
        view->moved[v] = (view->shift + norm(view->arm[v]) * view->turn) * UPWARDS;
    }
    for (int v = 0; v < LEGS; v++) find_lengths(view, v);
}

static void put(affine_vector *a, int k, vector slope) {
    a->x[0].g[k] = slope.x, a->x[1].g[k] = slope.y, a->x[2].g[k] = slope.z;
}

static affine_vector affine_vector_of(vector c, double r) {
    affine_vector a = {{affine_of(c.x), affine_of(c.y), affine_of(c.z)}};
    for (int i = 0; i < 3; i++) a.x[i].r = r;
    return a;
}

/* on a line there is one variable: all half widths grow together, each with the sign of its direction */
static void fold(const box_view *view, affine_vector *a) {
    for (int i = 0; i < 3 && view->way; i++) {
        double sum = 0;
        for (int k = 0; k < SIDES; k++) {
            sum += view->way[k] < 0 ? -a->x[i].g[k] : a->x[i].g[k];
            a->x[i].g[k] = 0;
        }
        a->x[i].g[0] = sum;
    }
}

/* (space-2): slopes w_k ω_k × R a, and second order at most ½ |a| β */
affine_vector box_turned(const box_view *view, vector Ra) {
    const double size = norm(Ra), rest = 0.5 * size * view->bend * UPWARDS;
    affine_vector a = affine_vector_of(Ra, rest + VECTOR_ROUNDED * size);
    for (int k = 0; k < 3; k++) put(&a, 3 + k, scale(view->half[3 + k], cross(view->axis[k], Ra)));
    fold(view, &a);
    return a;
}

void box_home_directions(const space *s, const box_view *view, int v, affine_vector *still,
                         affine_vector *turned) {
    const double rounding = 2 * view->rounding / s->reach->machine->home_length[v];
    *still = affine_vector_of(s->along[v], rounding);
    *turned = box_turned(view, out_of(&view->R, s->along[v]));
    for (int i = 0; i < 3; i++) turned->x[i].r += rounding;
}

affine_vector box_shifted(const box_view *view) {
    affine_vector a = affine_vector_of(vector_of(view->centre), 0);
    for (int k = 0; k < 3; k++) a.x[k].g[k] = view->half[k];
    fold(view, &a);
    return a;
}

/* how top joint v moves with the k-th half width */
vector box_joint_slope(const box_view *view, int v, int k) {
    const double unit[3] = {k == 0, k == 1, k == 2};
    const vector way = k < 3 ? vector_of(unit) : cross(view->axis[k - 3], view->arm[v]);
    return scale(view->half[k], way);
}

void box_length_slopes(const box_view *view, int v, double slope[SIDES]) {
    double sum = 0;
    for (int k = 0; k < SIDES; k++) {
        slope[k] = dot(view->g.n[v], box_joint_slope(view, v, k));
        if (!view->way) continue;
        sum += view->way[k] < 0 ? -slope[k] : slope[k];
        slope[k] = 0;
    }
    if (view->way) slope[0] = sum;
}

affine box_length(const box_view *view, int v) {
    affine l = affine_of(view->g.length[v]);
    box_length_slopes(view, v, l.g);
    l.r = fmax(0, view->wide[v] - affine_slope(&l)) + ROUNDED * view->wide[v];
    return l;
}

void box_lengths(const box_view *view, int v, double bound[2]) {
    const double l = view->g.length[v], far = l + view->moved[v] + 2 * view->rounding;
    bound[0] = fmax(0, view->shortest[v]);
    bound[1] = fmin(far, l + view->wide[v]);
}

/* (space-5): slopes P ∂q_k/l, and second order at most v²/(√3 l_min²) + |arm| β/(2 l_min) */
affine_vector box_direction(const box_view *view, int v) {
    const vector n = view->g.n[v];
    const double l = view->g.length[v], least = view->shortest[v];
    const double way = view->moved[v] / least;
    const double rest =
        0.57735026918962577 * way * way + 0.5 * norm(view->arm[v]) * view->bend / least;
    affine_vector a =
        affine_vector_of(n, rest * UPWARDS + 2 * view->rounding * (1 + view->moved[v] / l) / l);
    if (!(least > 0)) return affine_vector_of(n, INFINITY);
    for (int k = 0; k < GOUGH_COMPONENTS; k++) {
        const vector slope = box_joint_slope(view, v, k);
        put(&a, k, scale(1 / l, along(slope, -dot(n, slope), n)));
    }
    fold(view, &a);
    return a;
}
