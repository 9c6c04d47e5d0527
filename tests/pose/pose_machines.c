/* Machines of all families, and Newton's method in rotation and position; see pose_machines.h. */
#include "pose/pose_machines.h"

#include <stdio.h>
#include <stdlib.h>

static void init(gough_machine *machine, const gough_platform *platform) {
    const gough_load load = {.mass = 1, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
    const double gravity[3] = {0, 0, -1};
    gough_error error = {0};
    ck_assert_msg(gough_machine_init(machine, platform, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

void family_machine(family which, dice *d, gough_machine *machine) {
    gough_platform p =
        gough_platform_symmetric(1, dice_between(d, 0.1, 0.4), 0.6, dice_between(d, 0.1, 0.4), 1.2);
    if (which == FAMILY_RINGS) {
        init(machine, &p);
        return;
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int k = 0; k < 3; k++) {
            const bool plane = which == FAMILY_PLANE_BASE || which == FAMILY_PLANE_BOTH;
            const double base = dice_between(d, -0.25, 0.25), top = dice_between(d, -0.2, 0.2);
            if (k < 2 || !plane) p.base[v][k] += base;
            if (k < 2 || which != FAMILY_PLANE_BOTH) p.top[v][k] += top;
        }
    }
    /* top joints of neighbours made one, in one, two or three places; then base joints of the other neighbours */
    const int shared = which == FAMILY_SIX_FIVE    ? 1
                       : which == FAMILY_SIX_FOUR  ? 2
                       : which >= FAMILY_SIX_THREE ? 3
                                                   : 0;
    for (int n = 0; n < shared; n++)
        memcpy(p.top[(2 * n + 2) % 6], p.top[2 * n + 1], sizeof p.top[0]);
    for (int n = 0; n < 3 && which == FAMILY_THREE_THREE; n++)
        memcpy(p.base[2 * n + 1], p.base[2 * n], sizeof p.base[0]);
    init(machine, &p);
}

void dietmaier_machine(gough_machine *machine, double length[GOUGH_LEGS],
                       double pose[DIETMAIER_POSES][9]) {
    gough_platform platform = gough_platform_default();
    char name[512], line[512];
    int legs = 0, poses = 0;
    snprintf(name, sizeof name, "%s/tests/data/dietmaier.csv", getenv("SOURCE"));
    FILE *file = fopen(name, "r");
    ck_assert_ptr_nonnull(file);
    while (fgets(line, sizeof line, file)) {
        double number[10];
        char *at = line;
        int count = 0;
        if (line[0] < '0' || line[0] > '9') continue;
        for (; count < 10 && *at && *at != '\n'; count++) {
            number[count] = strtod(at, &at);
            if (*at == ',') at++;
        }
        if (count == 8) {
            memcpy(platform.base[legs], number + 1, sizeof platform.base[0]);
            memcpy(platform.top[legs], number + 4, sizeof platform.top[0]);
            length[legs++] = number[7];
        } else if (count == 10) {
            memcpy(pose[poses++], number + 1, sizeof pose[0]);
        }
    }
    fclose(file);
    ck_assert(legs == GOUGH_LEGS && poses == DIETMAIER_POSES);
    platform.height = 1;
    init(machine, &platform);
}

gough_state random_pose(const gough_machine *machine, double shift, double turn, dice *d) {
    gough_state state = gough_state_home(machine);
    double angles[3];
    for (int k = 0; k < 3; k++) {
        angles[k] = dice_between(d, -turn, turn);
        state.position[k] += dice_between(d, -shift, shift);
    }
    gough_rotation_from_angles(angles, state.rotation);
    return state;
}

static void leg_vector(const gough_machine *machine, const gough_state *s, int v,
                       long double arm[3], long double leg[3]) {
    for (int r = 0; r < 3; r++) {
        arm[r] = 0;
        for (int k = 0; k < 3; k++)
            arm[r] += (long double)s->rotation[r][k] * (long double)machine->platform.top[v][k];
        leg[r] = (long double)s->position[r] + arm[r] - (long double)machine->platform.base[v][r];
    }
}

static long double size_of(const long double v[3]) {
    return sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void lengths_by_vectors(const gough_machine *machine, const gough_state *state,
                        double length[GOUGH_LEGS]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        long double arm[3], leg[3];
        leg_vector(machine, state, v, arm, leg);
        length[v] = (double)size_of(leg);
    }
}

/* Gauss–Jordan with the largest pivots; false if one is nothing */
static bool solve(double a[6][7]) {
    for (int c = 0; c < 6; c++) {
        int pivot = c;
        for (int r = c + 1; r < 6; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        if (!(fabs(a[pivot][c]) > 1e-13)) return false;
        for (int k = 0; k < 7; k++) {
            const double x = a[c][k];
            a[c][k] = a[pivot][k], a[pivot][k] = x;
        }
        for (int r = 0; r < 6; r++) {
            const double factor = a[r][c] / a[c][c];
            for (int k = c; k < 7 && r != c; k++) a[r][k] -= factor * a[c][k];
        }
    }
    for (int c = 0; c < 6; c++) a[c][6] /= a[c][c];
    return true;
}

/* R becomes the rotation by the vector w, times R */
static void turn_by(const double w[3], double R[3][3]) {
    const double angle = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    const double s = angle > 1e-8 ? sin(angle) / angle : 1;
    const double c = angle > 1e-8 ? (1 - cos(angle)) / (angle * angle) : 0.5;
    for (int k = 0; k < 3; k++) {
        const double v[3] = {R[0][k], R[1][k], R[2][k]};
        const double x[3] = {w[1] * v[2] - w[2] * v[1], w[2] * v[0] - w[0] * v[2],
                             w[0] * v[1] - w[1] * v[0]};
        const double y[3] = {w[1] * x[2] - w[2] * x[1], w[2] * x[0] - w[0] * x[2],
                             w[0] * x[1] - w[1] * x[0]};
        for (int r = 0; r < 3; r++) R[r][k] += s * x[r] + c * y[r];
    }
}

bool newton_by_vectors(const gough_machine *machine, const double length[GOUGH_LEGS],
                       gough_state *state) {
    for (int n = 0; n < 60; n++) {
        double a[6][7], worst = 0;
        for (int v = 0; v < 6; v++) {
            long double arm[3], leg[3];
            leg_vector(machine, state, v, arm, leg);
            const long double l = size_of(leg);
            for (int k = 0; k < 3; k++) {
                const int i = (k + 1) % 3, j = (k + 2) % 3;
                a[v][k] = (double)(leg[k] / l);
                a[v][3 + k] = (double)((arm[i] * leg[j] - arm[j] * leg[i]) / l);
            }
            a[v][6] = (double)((long double)length[v] - l);
        }
        if (!solve(a)) return false;
        for (int k = 0; k < 6; k++) worst = fmax(worst, fabs(a[k][6]));
        const double part = worst > 0.5 ? 0.5 / worst : 1; /* far away, shorter steps */
        double w[3];
        for (int k = 0; k < 3; k++) {
            state->position[k] += part * a[k][6];
            w[k] = part * a[3 + k][6];
        }
        turn_by(w, state->rotation);
        if (worst < 1e-13) return true;
        if (!(worst < 1e6)) return false;
    }
    return false;
}

double pose_difference(const gough_state *a, const gough_state *b) {
    double worst = 0;
    for (int r = 0; r < 3; r++) {
        worst = fmax(worst, fabs(a->position[r] - b->position[r]));
        for (int c = 0; c < 3; c++)
            worst = fmax(worst, fabs(a->rotation[r][c] - b->rotation[r][c]));
    }
    return worst;
}

double pose_distance(const gough_state *a, const gough_state *b) {
    double square = 0;
    for (int k = 0; k < 3; k++) square += pow(a->position[k] - b->position[k], 2);
    return sqrt(square);
}

/* |A − B|² = 8 sin²(angle/2) */
double pose_angle(const gough_state *a, const gough_state *b) {
    double square = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) square += pow(a->rotation[r][c] - b->rotation[r][c], 2);
    return 2 * asin(fmin(1, sqrt(square / 8)));
}

gough_state state_of(const gough_pose *pose) {
    gough_state state = {.velocity = {0}};
    memcpy(state.position, pose->position, sizeof state.position);
    memcpy(state.rotation, pose->rotation, sizeof state.rotation);
    return state;
}
