/* Models of MuJoCo, written as its XML and read by it. */
#include "bench/peer_mujoco_model.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "bench/bench.h"

enum { TEXT = 16384 };

typedef struct {
    char text[TEXT];
    size_t length;
} writing;

static void __attribute__((format(printf, 2, 3))) put(writing *w, const char *format, ...) {
    va_list arguments;

    va_start(arguments, format);
    w->length += (size_t)vsnprintf(w->text + w->length, TEXT - w->length, format, arguments);
    va_end(arguments);
    if (w->length >= TEXT) bench_fail("the model of MuJoCo is too long");
}

/* read from its memory, as if it were a file */
static mjModel *load(const writing *w) {
    static mjVFS files;
    char message[500] = "";
    int place;

    mj_defaultVFS(&files);
    if (mj_makeEmptyFileVFS(&files, "model.xml", (int)w->length) != 0) {
        bench_fail("MuJoCo takes no model");
    }
    place = mj_findFileVFS(&files, "model.xml");
    memcpy(files.filedata[place], w->text, w->length);
    mjModel *m = mj_loadXML("model.xml", &files, message, sizeof message);
    mj_deleteVFS(&files);
    if (m == NULL) bench_fail(message);
    return m;
}

static void put_head(writing *w, const char *flags) {
    put(w,
        "<mujoco><compiler inertiafromgeom='false' angle='radian'/>"
        "<option integrator='RK4' gravity='0 0 -1' tolerance='1e-12'>%s</option><worldbody>",
        flags);
}

static void put_top(writing *w, const hand *h) {
    put(w,
        "<body name='top' pos='0 0 %.17g'><freejoint/>"
        "<inertial pos='0 0 0' mass='%.17g' diaginertia='%.17g %.17g %.17g'/>",
        h->height, h->mass, h->J[0], h->J[1], h->J[2]);
    for (int v = 0; v < 6; v++) {
        const double *p = h->top[v];
        put(w, "<site name='t%d' pos='%.17g %.17g %.17g'/>", v, p[0], p[1], p[2]);
    }
    put(w, "</body>");
}

mjModel *mujoco_tendons(const hand *h) {
    static writing w;

    w.length = 0;
    put_head(&w, "<flag contact='disable' constraint='disable' passive='disable'/>");
    put_top(&w, h);
    for (int v = 0; v < 6; v++) {
        const double *p = h->base[v];
        put(&w, "<site name='b%d' pos='%.17g %.17g %.17g'/>", v, p[0], p[1], p[2]);
    }
    put(&w, "</worldbody><tendon>");
    for (int v = 0; v < 6; v++) {
        put(&w, "<spatial name='l%d'><site site='b%d'/><site site='t%d'/></spatial>", v, v, v);
    }
    put(&w, "</tendon><actuator>");
    for (int v = 0; v < 6; v++) put(&w, "<motor tendon='l%d'/>", v);
    put(&w, "</actuator></mujoco>");
    return load(&w);
}

double mujoco_leg_frame(const hand *h, int leg, double axes[3][3]) {
    double n[3], across[3], length = 0;

    for (int c = 0; c < 3; c++) {
        n[c] = h->top[leg][c] - h->base[leg][c] + (c == 2 ? h->height : 0);
        length += n[c] * n[c];
    }
    length = sqrt(length);
    for (int c = 0; c < 3; c++) n[c] /= length;
    const double flat = hypot(n[0], n[1]);
    across[0] = -n[1] / flat, across[1] = n[0] / flat, across[2] = 0;
    for (int c = 0; c < 3; c++) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        axes[c][0] = across[c];
        axes[c][1] = n[a] * across[b] - n[b] * across[a];
        axes[c][2] = n[c];
    }
    return length;
}

mjModel *mujoco_legs(const hand *h) {
    static writing w;
    /* a part spins about the leg's axis with its universal joint, which legs of ours do not: next to no inertia there */
    const double thin = 1e-6, light = h->mass / 1000;
    const double *one = h->heavy ? h->cylinder : (double[3]){light, 0.2, 0.01 * light};
    const double *two = h->heavy ? h->piston : one;

    w.length = 0;
    put_head(&w, "<flag contact='disable' passive='disable'/>");
    put_top(&w, h);
    for (int v = 0; v < 6; v++) {
        double a[3][3];
        const double length = mujoco_leg_frame(h, v, a);
        put(&w,
            "<body pos='%.17g %.17g %.17g' xyaxes='%.17g %.17g %.17g %.17g %.17g %.17g'>"
            "<joint type='hinge' axis='1 0 0'/><joint type='hinge' axis='0 1 0'/>"
            "<inertial pos='0 0 %.17g' mass='%.17g' diaginertia='%.17g %.17g %.17g'/>",
            h->base[v][0], h->base[v][1], h->base[v][2], a[0][0], a[1][0], a[2][0], a[0][1],
            a[1][1], a[2][1], one[1], one[0], one[2], one[2], h->heavy ? thin * one[2] : one[2]);
        put(&w,
            "<body name='r%d' pos='0 0 %.17g'><joint name='s%d' type='slide' axis='0 0 1' "
            "armature='%.17g'/>"
            "<inertial pos='0 0 %.17g' mass='%.17g' diaginertia='%.17g %.17g "
            "%.17g'/></body></body>",
            v, length, v, h->reflected, -two[1], two[0], two[2], two[2],
            h->heavy ? thin * two[2] : two[2]);
    }
    put(&w, "</worldbody><equality>");
    for (int v = 0; v < 6; v++) {
        put(&w,
            "<connect body1='r%d' body2='top' anchor='0 0 0' solref='0.004 1' "
            "solimp='0.999 0.9999 0.001'/>",
            v);
    }
    put(&w, "</equality><actuator>");
    for (int v = 0; v < 6; v++) put(&w, "<motor joint='s%d'/>", v);
    put(&w, "</actuator></mujoco>");
    return load(&w);
}

void mujoco_place(const mjModel *m, mjData *d, const hand *h, const double y[HAND_STATE]) {
    double R[3][3];

    mj_resetData(m, d);
    for (int i = 0; i < 7; i++) d->qpos[i] = y[i];
    if (m->nq == 7) return;
    hand_matrix(y + 3, R);
    for (int v = 0; v < 6; v++) {
        double a[3][3], s[3], n[3] = {0, 0, 0}, length = 0;
        const double home = mujoco_leg_frame(h, v, a);
        for (int c = 0; c < 3; c++) {
            s[c] = y[c] - h->base[v][c];
            for (int k = 0; k < 3; k++) s[c] += R[c][k] * h->top[v][k];
            length += s[c] * s[c];
        }
        length = sqrt(length);
        for (int k = 0; k < 3; k++) {
            for (int c = 0; c < 3; c++) n[k] += a[c][k] * s[c] / length;
        }
        /* turned about x, then about the new y: n = (sin b, −sin a cos b, cos a cos b) */
        d->qpos[7 + 3 * v] = atan2(-n[1], n[2]);
        d->qpos[8 + 3 * v] = asin(n[0]);
        d->qpos[9 + 3 * v] = length - home;
    }
}
