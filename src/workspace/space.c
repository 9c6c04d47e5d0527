/* Boxes of poses: first and second order exactly, third order bounded, (space-1) … (space-5). Theory: docs/theory/workspace.md. */
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
    const double sum = w[0] + w[1] + w[2];
    view->turn = sqrt(square) * UPWARDS;
    view->bend = (square + twist) * UPWARDS;
    view->twist = sum * sum * sum * UPWARDS;
    view->yaw_outside = outer == 2;
}

/* (space-4): −(Σ |n·∂q_k| + ½ |arm| β) ≤ l − l_c ≤ Σ |n·∂q_k| + ½ (v²/l_c + |arm| β) */
static void find_lengths(box_view *view, int v) {
    const double l = view->g.length[v], moved = view->moved[v],
                 least = l - moved - 2 * view->rounding;
    const vector n = view->g.n[v];
    double first = 0, along_way = 0;
    for (int k = 0; k < SIDES; k++) {
        const double slope = dot(n, box_joint_slope(view, v, k));
        first += fabs(slope);
        if (view->way) along_way += view->way[k] < 0 ? -slope : slope;
    }
    if (view->way) first = fabs(along_way);
    first += 0.5 * norm(view->arm[v]) * view->bend;
    view->less[v] = first * UPWARDS + 2 * view->rounding;
    view->more[v] = (first + 0.5 * moved * moved / l) * UPWARDS + 2 * view->rounding;
    view->shortest[v] = fmax(least, l - view->less[v]);
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
    view->varies = false;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) view->varies |= view->half[c] > 0;
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

static void put(taylor_vector *a, int k, vector slope) {
    a->x[0].g[k] = slope.x, a->x[1].g[k] = slope.y, a->x[2].g[k] = slope.z;
}

static void put_curve(taylor_vector *a, int j, int k, vector curve) {
    const int at = curve_at(j, k);
    a->x[0].h[at] = curve.x, a->x[1].h[at] = curve.y, a->x[2].h[at] = curve.z;
}

static taylor_vector taylor_vector_of(vector c, double r, bool varies) {
    taylor_vector a = {{taylor_of(c.x), taylor_of(c.y), taylor_of(c.z)}};
    for (int i = 0; i < 3; i++) a.x[i].r = r, a.x[i].varies = varies;
    return a;
}

/* on a line there is one variable: all half widths grow together, each with the sign of its direction */
static void fold_one(const box_view *view, taylor *a) {
    double slope = 0, curve = 0;
    for (int k = 0; k < SIDES; k++) {
        const double end = view->way[k] < 0 ? -1 : 1;
        slope += end * a->g[k], a->g[k] = 0;
        for (int j = 0; j <= k; j++) {
            curve += (view->way[j] < 0 ? -end : end) * a->h[curve_at(j, k)];
            a->h[curve_at(j, k)] = 0;
        }
    }
    a->g[0] = slope, a->h[0] = curve;
}

static void fold(const box_view *view, taylor_vector *a) {
    for (int i = 0; i < 3 && view->way && view->varies; i++) fold_one(view, &a->x[i]);
}

/* ∂_j ∂_k of a vector that turns with the top, (space-2): the outer angle turns the axis of the inner one */
static vector turned_twice(const box_view *view, int j, int k, vector Ra) {
    const int outer = view->yaw_outside ? k : j, inner = j + k - outer;
    const vector once = cross(view->axis[inner - 3], Ra);
    return scale(view->half[j] * view->half[k], cross(view->axis[outer - 3], once));
}

/* (space-2): slopes w_k ω_k × R a, curvatures, and third order at most |a| τ/6 */
taylor_vector box_turned(const box_view *view, vector Ra) {
    const double size = norm(Ra), rest = size * view->twist / 6 * UPWARDS;
    taylor_vector a = taylor_vector_of(Ra, rest + VECTOR_ROUNDED * size, view->varies);
    for (int k = 3; k < 6 && view->varies; k++) {
        put(&a, k, scale(view->half[k], cross(view->axis[k - 3], Ra)));
        for (int j = 3; j <= k; j++)
            put_curve(&a, j, k, scale(j < k ? 1 : 0.5, turned_twice(view, j, k, Ra)));
    }
    fold(view, &a);
    return a;
}

void box_home_directions(const space *s, const box_view *view, int v, taylor_vector *still,
                         taylor_vector *turned) {
    const double rounding = 2 * view->rounding / s->reach->machine->home_length[v];
    *still = taylor_vector_of(s->along[v], rounding, false);
    *turned = box_turned(view, out_of(&view->R, s->along[v]));
    for (int i = 0; i < 3; i++) turned->x[i].r += rounding;
}

taylor_vector box_shifted(const box_view *view) {
    taylor_vector a = taylor_vector_of(vector_of(view->centre), 0, view->varies);
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

/* (space-4): slopes n·∂q_k, curvatures ∂q_j·P ∂q_k/l + n·∂_j∂_k q, and third order at most
 * v³/(3√3 l_min²) + v |arm| β/(2 l_min) + |arm| τ/6 */
taylor box_length(const box_view *view, int v) {
    const vector n = view->g.n[v];
    const double l = view->g.length[v], least = view->shortest[v], moved = view->moved[v],
                 arm = norm(view->arm[v]);
    const double rest = 0.19245008972987526 * moved * moved * moved / (least * least) +
                        0.5 * moved * arm * view->bend / least + arm * view->twist / 6;
    taylor a = {.c = l, .r = INFINITY, .varies = view->varies};
    vector slope[SIDES];
    if (!(least > 0)) return a;
    for (int k = 0; k < SIDES && view->varies; k++) {
        slope[k] = box_joint_slope(view, v, k);
        a.g[k] = dot(n, slope[k]);
        for (int j = 0; j <= k; j++) {
            double curve = (dot(slope[j], slope[k]) - a.g[j] * a.g[k]) / l;
            if (j > 2) curve += dot(n, turned_twice(view, j, k, view->arm[v]));
            a.h[curve_at(j, k)] = j < k ? curve : 0.5 * curve;
        }
    }
    a.r = rest * UPWARDS + 2 * view->rounding * (1 + moved / l) * (1 + moved / l);
    if (view->way && view->varies) fold_one(view, &a);
    return a;
}

void box_lengths(const box_view *view, int v, double bound[2]) {
    const double l = view->g.length[v], far = l + view->moved[v] + 2 * view->rounding;
    bound[0] = fmax(0, view->shortest[v]);
    bound[1] = fmin(far, l + view->more[v]);
}

/* (space-5): slopes P ∂q_k/l, curvatures (P ∂_j∂_k q − (n·∂q_j) P∂q_k/l − (n·∂q_k) P∂q_j/l − (∂q_j·P∂q_k) n/l)/l, and third order
 * at most v³/(2 l_min³) + v |arm| β/(√3 l_min²) + |arm| τ/(6 l_min) */
taylor_vector box_direction(const box_view *view, int v) {
    const vector n = view->g.n[v];
    const double l = view->g.length[v], least = view->shortest[v], arm = norm(view->arm[v]);
    const double way = view->moved[v] / least, far = 1 + view->moved[v] / l;
    const double rest = 0.5 * way * way * way +
                        0.57735026918962577 * way * arm * view->bend / least +
                        arm * view->twist / (6 * least);
    const double rounding = 2 * view->rounding * far * far / l;
    taylor_vector a = taylor_vector_of(n, rest * UPWARDS + rounding, view->varies);
    vector across[SIDES];
    double ahead[SIDES];
    /* a leg of no length has no direction, not even at the centre */
    if (!(least > 0)) return taylor_vector_of((vector){0, 0, 0}, INFINITY, view->varies);
    for (int k = 0; k < SIDES && view->varies; k++) {
        const vector slope = scale(1 / l, box_joint_slope(view, v, k));
        ahead[k] = dot(n, slope), across[k] = along(slope, -ahead[k], n);
        put(&a, k, across[k]);
        for (int j = 0; j <= k; j++) {
            vector curve = along(scale(-ahead[j], across[k]), -ahead[k], across[j]);
            curve = along(curve, -dot(across[j], across[k]), n);
            if (j > 2) {
                const vector turned = scale(1 / l, turned_twice(view, j, k, view->arm[v]));
                curve = add(curve, along(turned, -dot(n, turned), n));
            }
            put_curve(&a, j, k, scale(j < k ? 1 : 0.5, curve));
        }
    }
    fold(view, &a);
    return a;
}
