/* The columns of every table: name, what it is, and its dimension as exponents of length, mass,
 * time and angle, in this order. */
#include "gough/simulate.h"

/* One line a column. */
/* clang-format off */
static const gough_column_info columns[GOUGH_COLUMNS] = {
    [GOUGH_T]           = {"t", "time",                                              0, 0,  1, 0},

    [GOUGH_X]           = {"x", "x of the top frame's origin in the base frame",     1, 0,  0, 0},
    [GOUGH_Y]           = {"y", "y of the top frame's origin in the base frame",     1, 0,  0, 0},
    [GOUGH_Z]           = {"z", "z of the top frame's origin in the base frame",     1, 0,  0, 0},
    [GOUGH_ROLL_ANGLE]  = {"roll", "roll of the top",                                0, 0,  0, 1},
    [GOUGH_PITCH_ANGLE] = {"pitch", "pitch of the top",                              0, 0,  0, 1},
    [GOUGH_YAW_ANGLE]   = {"yaw", "yaw of the top",                                  0, 0,  0, 1},

    [GOUGH_VX]          = {"vx", "velocity of the top's origin along base x",        1, 0, -1, 0},
    [GOUGH_VY]          = {"vy", "velocity of the top's origin along base y",        1, 0, -1, 0},
    [GOUGH_VZ]          = {"vz", "velocity of the top's origin along base z",        1, 0, -1, 0},
    [GOUGH_WX]          = {"wx", "angular velocity of the top about base x",         0, 0, -1, 1},
    [GOUGH_WY]          = {"wy", "angular velocity of the top about base y",         0, 0, -1, 1},
    [GOUGH_WZ]          = {"wz", "angular velocity of the top about base z",         0, 0, -1, 1},

    [GOUGH_AX]          = {"ax", "acceleration of the top's origin along base x",    1, 0, -2, 0},
    [GOUGH_AY]          = {"ay", "acceleration of the top's origin along base y",    1, 0, -2, 0},
    [GOUGH_AZ]          = {"az", "acceleration of the top's origin along base z",    1, 0, -2, 0},
    [GOUGH_ALX]         = {"alx", "angular acceleration of the top about base x",    0, 0, -2, 1},
    [GOUGH_ALY]         = {"aly", "angular acceleration of the top about base y",    0, 0, -2, 1},
    [GOUGH_ALZ]         = {"alz", "angular acceleration of the top about base z",    0, 0, -2, 1},

    [GOUGH_L + 0]       = {"l1", "length of leg 1",                                  1, 0,  0, 0},
    [GOUGH_L + 1]       = {"l2", "length of leg 2",                                  1, 0,  0, 0},
    [GOUGH_L + 2]       = {"l3", "length of leg 3",                                  1, 0,  0, 0},
    [GOUGH_L + 3]       = {"l4", "length of leg 4",                                  1, 0,  0, 0},
    [GOUGH_L + 4]       = {"l5", "length of leg 5",                                  1, 0,  0, 0},
    [GOUGH_L + 5]       = {"l6", "length of leg 6",                                  1, 0,  0, 0},

    [GOUGH_DL + 0]      = {"dl1", "rate of the length of leg 1",                     1, 0, -1, 0},
    [GOUGH_DL + 1]      = {"dl2", "rate of the length of leg 2",                     1, 0, -1, 0},
    [GOUGH_DL + 2]      = {"dl3", "rate of the length of leg 3",                     1, 0, -1, 0},
    [GOUGH_DL + 3]      = {"dl4", "rate of the length of leg 4",                     1, 0, -1, 0},
    [GOUGH_DL + 4]      = {"dl5", "rate of the length of leg 5",                     1, 0, -1, 0},
    [GOUGH_DL + 5]      = {"dl6", "rate of the length of leg 6",                     1, 0, -1, 0},

    [GOUGH_F + 0]       = {"f1", "force of leg 1, push positive",                    1, 1, -2, 0},
    [GOUGH_F + 1]       = {"f2", "force of leg 2, push positive",                    1, 1, -2, 0},
    [GOUGH_F + 2]       = {"f3", "force of leg 3, push positive",                    1, 1, -2, 0},
    [GOUGH_F + 3]       = {"f4", "force of leg 4, push positive",                    1, 1, -2, 0},
    [GOUGH_F + 4]       = {"f5", "force of leg 5, push positive",                    1, 1, -2, 0},
    [GOUGH_F + 5]       = {"f6", "force of leg 6, push positive",                    1, 1, -2, 0},

    [GOUGH_P + 0]       = {"p1", "power of leg 1",                                   2, 1, -3, 0},
    [GOUGH_P + 1]       = {"p2", "power of leg 2",                                   2, 1, -3, 0},
    [GOUGH_P + 2]       = {"p3", "power of leg 3",                                   2, 1, -3, 0},
    [GOUGH_P + 3]       = {"p4", "power of leg 4",                                   2, 1, -3, 0},
    [GOUGH_P + 4]       = {"p5", "power of leg 5",                                   2, 1, -3, 0},
    [GOUGH_P + 5]       = {"p6", "power of leg 6",                                   2, 1, -3, 0},

    [GOUGH_CONDITION]   = {"condition", "condition number of the leg Jacobian",             0, 0,  0, 0},

    [GOUGH_EX]          = {"ex", "deviation from the program in x",                  1, 0,  0, 0},
    [GOUGH_EY]          = {"ey", "deviation from the program in y",                  1, 0,  0, 0},
    [GOUGH_EZ]          = {"ez", "deviation from the program in z",                  1, 0,  0, 0},
    [GOUGH_EROLL]       = {"eroll", "deviation from the program in roll",            0, 0,  0, 1},
    [GOUGH_EPITCH]      = {"epitch", "deviation from the program in pitch",          0, 0,  0, 1},
    [GOUGH_EYAW]        = {"eyaw", "deviation from the program in yaw",              0, 0,  0, 1},

    [GOUGH_DRIFT]       = {"drift", "largest violation of the constraints",          0, 0,  0, 0},

    [GOUGH_RXX]         = {"rxx", "constraint reaction of i with i",                 2, 1, -2, 0},
    [GOUGH_RYY]         = {"ryy", "constraint reaction of j with j",                 2, 1, -2, 0},
    [GOUGH_RZZ]         = {"rzz", "constraint reaction of k with k",                 2, 1, -2, 0},
    [GOUGH_RXY]         = {"rxy", "constraint reaction of i with j",                 2, 1, -2, 0},
    [GOUGH_RYZ]         = {"ryz", "constraint reaction of j with k",                 2, 1, -2, 0},
    [GOUGH_RZX]         = {"rzx", "constraint reaction of k with i",                 2, 1, -2, 0},
};
/* clang-format on */

const gough_column_info *gough_column(int column) {
    return column >= 0 && column < GOUGH_COLUMNS ? &columns[column] : NULL;
}

bool gough_column_filled(int column, bool simulated, bool reactions) {
    if (column < GOUGH_T || column >= GOUGH_COLUMNS) return false;
    if (column <= GOUGH_CONDITION) return true;
    if (column <= GOUGH_DRIFT) return simulated;
    return reactions;
}
