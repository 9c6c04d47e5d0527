/* Inverse dynamics, then forward dynamics, in 10 000 random poses, motions and loads: the acceleration comes back, and the forces
 * do the work that the kinetic energy asks for (a round trip alone proves nothing). */
#include <stdio.h>
#include <stdlib.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

static const uint64_t seed = 7;

/* a machine with joints, load and gravity all random */
static gough_status random_machine(dice *d, gough_machine *machine) {
    gough_platform platform = gough_platform_symmetric(1, 0.25, 0.6, 0.2, 1.1);
    const double turn[3] = {dice_between(d, -3, 3), dice_between(d, -1.5, 1.5),
                            dice_between(d, -3, 3)};
    const double a = dice_between(d, 0.02, 0.1), b = dice_between(d, 0.02, 0.1),
                 c = dice_between(d, 0.02, 0.1), second[3] = {b + c, c + a, a + b};
    gough_load load = {.mass = dice_between(d, 0.3, 3)};
    double gravity[3], R[3][3];

    for (int v = 0; v < 6; v++) {
        for (int k = 0; k < 3; k++) {
            platform.base[v][k] += dice_between(d, -0.15, 0.15);
            platform.top[v][k] += dice_between(d, -0.1, 0.1);
        }
    }
    gough_rotation_from_angles(turn, R);
    for (int r = 0; r < 3; r++) {
        load.center_of_mass[r] = dice_between(d, -0.2, 0.2);
        gravity[r] = dice_between(d, -1, 1);
        for (int k = 0; k < 3; k++) {
            load.inertia[r][k] = 0;
            for (int m = 0; m < 3; m++) load.inertia[r][k] += R[r][m] * second[m] * R[k][m];
        }
    }
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < r; k++) load.inertia[r][k] = load.inertia[k][r];
    }
    return gough_machine_init(machine, &platform, &load, gravity, NULL);
}

static void random_motion(dice *d, const gough_machine *machine, gough_state *state,
                          gough_acceleration *a, gough_wrench *external) {
    const double angles[3] = {dice_between(d, -0.4, 0.4), dice_between(d, -0.4, 0.4),
                              dice_between(d, -0.5, 0.5)};

    *state = gough_state_home(machine);
    gough_rotation_from_angles(angles, state->rotation);
    for (int k = 0; k < 3; k++) {
        state->position[k] += dice_between(d, -0.3, 0.3);
        state->velocity[k] = dice_between(d, -1, 1);
        state->angular_velocity[k] = dice_between(d, -1.5, 1.5);
        a->linear[k] = dice_between(d, -2, 2);
        a->angular[k] = dice_between(d, -3, 3);
        external->force[k] = dice_between(d, -1, 1);
        external->moment[k] = dice_between(d, -0.3, 0.3);
    }
}

/* dT/dt of the load from first principles: M v_C·a_C + ω·(J α + ω×Jω), all in base axes, tensor turned with the top */
static double power_of_motion(const gough_machine *machine, const gough_state *s,
                              const gough_acceleration *a, double *weight) {
    const double *w = s->angular_velocity, *al = a->angular;
    double c[3] = {0, 0, 0}, v[3], acc[3], wc[3], body_w[3] = {0, 0, 0}, body_a[3] = {0, 0, 0};
    double sum = 0;

    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < 3; k++) {
            c[r] += s->rotation[r][k] * machine->load.center_of_mass[k];
            body_w[r] += s->rotation[k][r] * w[k];
            body_a[r] += s->rotation[k][r] * al[k];
        }
    }
    for (int r = 0; r < 3; r++) {
        const int p = (r + 1) % 3, q = (r + 2) % 3;
        wc[r] = w[p] * c[q] - w[q] * c[p];
    }
    for (int r = 0; r < 3; r++) {
        const int p = (r + 1) % 3, q = (r + 2) % 3;
        v[r] = s->velocity[r] + wc[r];
        acc[r] = a->linear[r] + al[p] * c[q] - al[q] * c[p] + w[p] * wc[q] - w[q] * wc[p];
        sum += machine->load.mass * v[r] * (acc[r] - machine->gravity[r]);
        for (int k = 0; k < 3; k++) sum += body_w[r] * machine->load.inertia[r][k] * body_a[k];
    }
    *weight = v[0]; /* for the power of an external force: velocity of the centre of mass */
    weight[1] = v[1];
    weight[2] = v[2];
    return sum;
}

START_TEST(acceleration_comes_back) {
    double worst = 0, worst_power = 0;
    dice d = {seed};

    for (int i = 0, done = 0; done < 10000; i++) {
        gough_acceleration want, got;
        gough_wrench external;
        gough_machine machine;
        gough_state state;
        double force[6], rate[6], condition, scale = 1, power = 0, v[3], have = 0, size = 1;

        ck_assert_int_lt(i, 20000);
        if (random_machine(&d, &machine) != GOUGH_OK) continue;
        random_motion(&d, &machine, &state, &want, &external);
        if (gough_inverse_dynamics(&machine, &state, &want, &external, force, &condition)) continue;
        done++;
        ck_assert_int_eq(gough_forward_dynamics(&machine, &state, force, &external, &got),
                         GOUGH_OK);
        for (int k = 0; k < 3; k++) {
            scale = fmax(scale, fmax(fabs(want.linear[k]), fabs(want.angular[k])));
        }
        for (int k = 0; k < 3; k++) {
            worst = fmax(worst, fabs(got.linear[k] - want.linear[k]) / (condition * scale));
            worst = fmax(worst, fabs(got.angular[k] - want.angular[k]) / (condition * scale));
            ck_assert(isfinite(got.linear[k]) && isfinite(got.angular[k]));
        }

        /* Σ u l̇ + external power = d(kinetic energy)/dt − gravity's power */
        power = power_of_motion(&machine, &state, &want, v);
        gough_leg_kinematics(&machine, &state, NULL, NULL, rate, NULL);
        for (int n = 0; n < 6; n++) {
            have += force[n] * rate[n];
            size = fmax(size, fabs(force[n] * rate[n]));
        }
        for (int k = 0; k < 3; k++) {
            have += external.force[k] * v[k] + external.moment[k] * state.angular_velocity[k];
        }
        ck_assert(isfinite(have - power)); /* a maximum would pass over what is not a number */
        worst_power = fmax(worst_power, fabs(have - power) / (size * condition));
    }
    printf("round trip: worst error %.2e times condition; power %.2e (seed %llu)\n", worst,
           worst_power, (unsigned long long)seed);
    ck_assert_msg(worst <= 3e-14, "%g", worst);
    ck_assert_msg(worst_power <= 3e-14, "%g", worst_power);
}
END_TEST

int main(void) { return SUITE_RUN("round trip", 60, acceleration_comes_back); }
