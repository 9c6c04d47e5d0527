/* (space-16): a plane between two legs. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/clearance.h"

#include "base/limits.h"

static double clamp(double x) { return fmin(1, fmax(0, x)); }

static bool is_same(const double a[3], const double b[3], double size) {
    return norm(subtract(vector_of(a), vector_of(b))) < leg_no_length * size;
}

bool clearance_is_joint(const space *s, int v, int w) {
    const gough_platform *p = &s->reach->machine->platform;
    return is_same(p->base[v], p->base[w], s->size) || is_same(p->top[v], p->top[w], s->size);
}

/* from the nearest point of a leg at `from` with the vector `a` to that of another; both as parts of the legs, in place */
static vector nearest(vector between, vector a, vector b, double part[2]) {
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), ac = dot(a, between),
                 bc = dot(b, between), determinant = aa * bb - ab * ab;
    part[0] = determinant > 0 ? clamp((ac * bb - bc * ab) / determinant) : 0;
    part[1] = clamp((part[0] * ab - bc) / bb);
    part[0] = clamp((part[1] * ab + ac) / aa);
    return add(subtract(between, scale(part[0], a)), scale(part[1], b));
}

/* the least of e·x over leg v, or with sign −1 the greatest, over the box */
static double least_along(const space *s, const box_view *view, vector e, int v, double sign) {
    const vector base = s->h.base[v];
    const vector top = add(base, scale(view->g.length[v], view->g.n[v]));
    double wide = 0.5 * norm(view->arm[v]) * view->bend;
    for (int k = 0; k < GOUGH_COMPONENTS; k++) wide += fabs(dot(e, box_joint_slope(view, v, k)));
    return fmin(sign * dot(e, base), sign * dot(e, top) - wide) - 2 * view->rounding;
}

/* One leg over the box: its point nearest to another, of which `part` is where at the centre, and its vector. */
typedef struct side {
    taylor_vector at, leg;
    bool inner; /* the point lies between its ends */
    double part;
} side;

static side side_of(const space *s, const box_view *view, const taylor_vector n[LEGS], int v,
                    double part) {
    const taylor_vector arm = box_turned(view, view->arm[v]), moved = box_shifted(view);
    const double base[3] = {s->h.base[v].x, s->h.base[v].y, s->h.base[v].z};
    const double home[3] = {s->home.x, s->home.y, s->home.z};
    side one = {taylor_still(base), n[v], part > 1e-9 && part < 1 - 1e-9, part};
    for (int i = 0; i < 3; i++) {
        taylor *x = &one.leg.x[i];
        *x = taylor_add(taylor_add(taylor_of(home[i]), moved.x[i]),
                        taylor_less(arm.x[i], one.at.x[i]));
        x->r += 2 * view->rounding;
        if (!one.inner && part > 0.5) one.at.x[i] = taylor_add(one.at.x[i], *x);
    }
    return one;
}

/* takes off a vector what it has along a direction, exactly in every pose */
static taylor_vector across(const taylor_vector *a, const taylor_vector *n) {
    const taylor_vector once = taylor_cross(a, n);
    return taylor_cross(n, &once);
}

/* by how much the other end of a leg may lie nearer to the other leg than its point; sign: 1 if u points from the leg to the
 * other, −1 if it comes from there */
static double overhang(const side *one, const taylor_vector *u, double sign) {
    if (one->inner) return 0;
    const taylor along = taylor_dot(u, &one->leg);
    const taylor away = taylor_scale(one->part > 0.5 ? -sign : sign, along);
    return fmax(0, taylor_most(&away));
}

/* (space-16): planes across u, at right angles to the legs of which an inner point is nearest, part the two legs */
static double apart(const space *s, const box_view *view, const taylor_vector n[LEGS], int v, int w,
                    const double part[2]) {
    const side a = side_of(s, view, n, v, part[0]), b = side_of(s, view, n, w, part[1]);
    taylor_vector between, u;
    for (int i = 0; i < 3; i++) between.x[i] = taylor_less(b.at.x[i], a.at.x[i]);
    u = between;
    if (a.inner && b.inner)
        u = taylor_cross(&n[v], &n[w]);
    else if (a.inner || b.inner)
        u = across(&between, &n[a.inner ? v : w]);
    const taylor size = taylor_root(taylor_dot(&u, &u)), share = taylor_inverse(size);
    const taylor distance = taylor_times(taylor_dot(&u, &between), share);
    if (a.inner && b.inner)
        return distance.c < 0 ? -taylor_most(&distance) : taylor_least(&distance);
    const double over = overhang(&a, &u, 1) + overhang(&b, &u, -1);
    return taylor_least(&distance) - over * taylor_magnitude(&share);
}

/* (space-20): legs as rays from their base joints, or from their top joints, which keep their distance D: they come no nearer than
 * D √(1 − (ε_v² + ε_w²)/(1 − c)), if they lean towards each other by ε and the cosine between them is at most c ≥ 0. */
static double rays_apart(const box_view *view, const taylor_vector n[LEGS], int v, int w,
                         vector way, bool of_top) {
    const double D = norm(way), u[3] = {way.x, way.y, way.z};
    const taylor_vector turned = of_top ? box_turned(view, way) : taylor_still(u);
    const taylor one = taylor_dot(&n[v], &turned), two = taylor_dot(&n[w], &turned),
                 cosine = taylor_dot(&n[v], &n[w]);
    const double lean_v = fmax(0, of_top ? -taylor_least(&one) : taylor_most(&one)) / D,
                 lean_w = fmax(0, of_top ? taylor_most(&two) : -taylor_least(&two)) / D,
                 open = 1 - fmax(0, taylor_most(&cosine));
    const double left = 1 - (lean_v * lean_v + lean_w * lean_w) / open * (1 + 16 * ROUNDED);
    return D > 0 && open > 0 && left > 0 ? D * sqrt(left) * (1 - 4 * ROUNDED) - 4 * view->rounding
                                         : 0;
}

/* how far leg w lies beyond leg v in a direction that is the same in all poses */
static double apart_along(const space *s, const box_view *view, vector e, int v, int w) {
    return least_along(s, view, e, w, 1) + least_along(s, view, e, v, -1);
}

/* From below: in any direction, legs are apart by no more than their distance; first the direction of the shortest way at the
 * centre, then as rays, then a direction that turns with the pose. From above: the two points that are nearest at the centre,
 * each of which moves by its part of what its top joint moves. */
void clearance_of(const space *s, const box_view *view, const taylor_vector n[LEGS], int v, int w,
                  double enough, double bound[2]) {
    const vector a = scale(view->g.length[v], view->g.n[v]),
                 b = scale(view->g.length[w], view->g.n[w]);
    const vector between = subtract(s->h.base[w], s->h.base[v]);
    double part[2];
    const vector way = nearest(between, a, b, part);
    const double distance = norm(way),
                 moved = view->moved[v] * part[0] + view->moved[w] * part[1] + 4 * view->rounding;
    bound[0] = 0;
    bound[1] = distance + moved;
    if (!(distance > 0)) return;
    bound[0] = fmax(0, apart_along(s, view, scale(1 / distance, way), v, w));
    if (bound[0] >= enough) return;
    bound[0] =
        fmax(bound[0], fmax(rays_apart(view, n, v, w, between, false),
                            rays_apart(view, n, v, w, subtract(view->arm[w], view->arm[v]), true)));
    if (bound[0] >= enough) return;
    const double fine = apart(s, view, n, v, w, part);
    if (fine > bound[0]) bound[0] = fine;
}
