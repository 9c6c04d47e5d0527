/* The same motion in any layout is read as the same numbers, and what a layout, a column or a key leaves open is said. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/sweep.h"
#include "study/helpers.h"
#include "support/suite.h"

/* Reads a study in these units, and this order of its angles, with such a record; keys: behind `file`, NULL: the bare name. */
static reading read_in(const char *order, const char *units, const char *keys, const char *path) {
    char text[8000];
    const int length = snprintf(
        text, sizeof text,
        "units: %s\nplatform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, half_angle: "
        "15}, height: 1.2}\nload: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
        "motion: {order: %s, samples: %s\"%s\"%s%s}\nsimulation: {duration: 0.5}\n",
        units, order, keys ? "{file: " : "", path, keys ? keys : "", keys ? "}" : "");
    ck_assert(length > 0 && (size_t)length < sizeof text);
    return read_bytes(text, strlen(text), NULL);
}

static reading read_as(const char *units, const char *keys, const char *path) {
    return read_in("zyx", units, keys, path);
}

static char *record_of(const char *text) { return write_file("record.txt", text, strlen(text)); }

/* heave 0, 12, -7 mm at 0, 0.25, 0.5 s, as it is or by these keys */
static const struct {
    const char *keys, *record;
} same[] = {
    {NULL, "t,heave\n0,0\n0.25,0.012\n0.5,-0.007\n"},
    {NULL, "t,heave\n0,0,\n0.25,0.012,\n0.5,-0.007,\n"},
    {NULL, "t;heave [mm]\n0;0\n0,25;12\n0,5;-7\n"},
    {NULL, "Time (ms);Heave, ( mm )\n0;0\n250;12\n500;-7\n"},
    {NULL, "T_s\tHEAVE_mm\n#c\n0\t0\n0.25\t12\n0.5\t-7\n"},
    {NULL, "t  heave (mm)\n0 0\n0.25  12 \n0.5\t-7\n"},
    {NULL, "t [s] heave [mm]\n0 0\n0.25 12\n0.5 -7\n"},
    {NULL, "\"t\" \"heave (mm)\"\n0 0\n0.25 12\n0.5 -7\n"},
    {NULL, "#\n# t heave_mm\n0 0\n0.25 12\n0.5 -7\n"},
    {NULL, "\" t\",\"heave \"\n0,0\n\"0.25\",0.012\n0.5,-0.007\n"},
    {NULL, "t,heave\ns,mm\n0,0\n0.25,12\n0.5,-7\n"},
    {NULL, "t;heave\n(s);[mm]\n0;0\n0,25;12\n0,5;-7\n"},
    {NULL, "t,heave [mm]\ns,m\n0,0\n0.25,12\n0.5,-7\n"},
    {NULL, "t,heave,roll\ns,mm,\n0,0,0\n0.25,12,0\n0.5,-7,0\n"},
    {NULL, "t,heave,roll\n-,mm,-\n0,0,0\n0.25,12,0\n0.5,-7,0\n"},
    {", decimal: comma", "t;heave [mm]\n0;0\n0,25;12\n0,5;-7\n"},
    {", decimal: comma, separator: comma", "t,heave_mm\n0,0\n\"0,25\",12\n\"0,5\",-7\n"},
    {", decimal: comma, time: 1, columns: {heave: 2}",
     "0,0\n\"0,25\",\"0,012\"\n\"0,5\",\"-0,007\"\n"},
    {", separator: semicolon", "t;heave [mm]\n0;0\n0,25;12\n0,5;-7\n"},
    {", separator: blanks, decimal: point", "t heave_mm\n0 0\n.25 12\n.5 -7\n"},
    {", comment: \"\"", "t,heave\n0,0\n0.25,0.012\n0.5,-0.007\n"},
    {", comment: \"9\", time: 1, columns: {heave: 2}", "9 9\n0 0\n9\n0.25 0.012\n0.5 -0.007\n"},
    {", comment: //, time: {step: 0.25}, columns: {heave: 1}", "// a\n0\n0.012\n//\n-0.007\n"},
    {", skip: 2", "t,heave\n5,5\nt,heave\n0,0\n0.25,0.012\n0.5,-0.007\n"},
    {", time: {column: a}, columns: {heave: {column: b, unit: mm}}",
     "no names\na,b,c\ns,mm,-\n0,0,a\n0.25,12,b\n0.5,-7,c\n"},
    {", time: {column: TIME}, columns: {heave: {column: h, scale: -1, offset: 0.5}}",
     "H,Time,h\n1,0,0.5\n2,0.25,0.488\n3,0.5,0.507\n"},
    {", columns: {heave: 2}, time: {from: first}", "t,z (kg)\n7,0\n7.25,0.012\n7.5,-0.007\n"},
    {", time: t, columns: {heave: 2}", "t,heave\n0,0\n0.25,0.012\n0.5,-0.007\n"},
    {", time: {unit: ms, column: 1}, columns: {heave: 2}", "0 0\n250 0.012\n500 -0.007\n"},
    {", time: {step: 0.25}", "heave\n0\n0.012\n-0.007\n"},
    {", time: {step: 0.25}, columns: {heave: \"2\"}", "t,2\n0,0\n0,0.012\n0,-0.007\n"},
    {", time: {step: 0.25}, columns: {heave: 1234567}", "1234567,b\n0,a\n0.012,a\n-0.007,a\n"},
    {", time: 1, columns: {heave: 2}, from_first: false", "a,b\nc,d\n0,0\n.25,.012\n.5,-.007\n"},
    {", time: 1, columns: {heave: 2}, from_first: true, order: xyz",
     "1,2,a,b,c\nu,1,w\n0,2,c\n0.25,2.012,d\n0.5,1.993,e\n"},
    {", time: 1, columns: {heave: 2}, rotation: angles, order: zyx",
     "a b c\nmm mm\n0 0\n0.25 0.012\n0.5 -0.007\n"},
};

START_TEST(the_same_motion_is_read_in_any_layout) {
    static const double heave[] = {0, 0.012, -0.007}, time[] = {0, 0.25, 0.5};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        char *path = record_of(same[i].record);
        reading made = read_as("si", same[i].keys, path);
        ck_assert_msg(made.status == GOUGH_OK, "%s\n%s", same[i].record,
                      made.messages ? made.messages : "");
        const gough_samples *samples = &made.study->model->motion.samples;
        ck_assert_msg(samples->count == 3, "%s", same[i].record);
        for (size_t row = 0; row < 3; row++) {
            const double *value = samples->value + row * GOUGH_COMPONENTS;
            ck_assert_msg(fabs(samples->time[row] - time[row]) <= 0, "%s", same[i].record);
            ck_assert_msg(fabs(value[GOUGH_HEAVE] - heave[row]) <= 1e-15, "%s", same[i].record);
            ck_assert(fabs(value[GOUGH_SURGE]) + fabs(value[GOUGH_ROLL]) <= 0);
        }
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

#define ROTATED "qw: 2, qx: 3, qy: 4, qz: 5"
#define TURNED "r11: 2, r12: 3, r13: 4, r21: 5, r22: 6, r23: 7, r31: 8, r32: 9, r33: 10"
static const char names[] = "t,heave\n0,0\n1,1\n", unit_rotation[] = "0,1,0,0,0\n1,1,0,0,0\n";

/* wrong: a part of what is said */
static const struct {
    const char *units, *keys, *record, *said;
} wrong[] = {
    /* units */
    {"si", NULL, "t,heave (deg)\n0,0\n", "`deg` is a unit of angle, but heave is a length"},
    {"si", NULL, "t,pitch (s)\n0,0\n", "`s` is a unit of time, but pitch is an angle"},
    {"si", NULL, "t (m),pitch\n0,0\n", "`m` is a unit of length, but t is a time"},
    {"si", NULL, "t,heave (m/s)\n0,0\n", "`m/s` is a unit of speed"},
    {"si", NULL, "t,heave (m/s2)\n0,0\n", "`m/s2` is a unit of acceleration"},
    {"si", NULL, "t,yaw (deg/s)\n0,0\n", "`deg/s` is a unit of angular speed"},
    {"si", NULL, "t,yaw (deg/s2)\n0,0\n", "`deg/s2` is a unit of angular acceleration"},
    {"si", NULL, "t,heave (ell)\n0,0\n",
     "`ell` is no unit that gough knows; units of length are m,"},
    {"si", ", columns: {yaw: {column: 2, unit: mil}}", names, "units of angle are deg, rad,"},
    {"si", ", time: {column: t, unit: day}", names, "units of time are s, ms,"},
    {"si", ", columns: {" ROTATED "}, time: {column: 1, unit: \"\"}", unit_rotation, ""},
    {"si", ", time: 1, columns: {qw: 2, qx: 3, qy: 4, qz: {column: 5, unit: m}}", unit_rotation,
     "`m` is a unit, but the columns of a rotation are numbers without one"},
    {"si", ", time: 1, columns: {qw: 2, qx: 3, qy: 4, qz: {column: 5, unit: ell}}", unit_rotation,
     "`ell` is no unit that gough knows; units of length are"},
    {"dimensionless", NULL, "t,heave (mm)\n0,0\n", "has no size in a study without dimensions"},
    {"dimensionless", NULL, "t,yaw (deg),x\n0,0,0\n", "3 `x` (unknown)"},
    /* columns */
    {"si", ", columns: {heave: lift}", names,
     "no column `lift`; its columns are 1 `t`, 2 `heave`\n"},
    {"si", ", columns: {heave: heavy}", names, "no column `heavy`; did you mean `heave`?"},
    {"si", ", time: 1, columns: {heave: lift}", "0,0\n1,1\n",
     "no column `lift`; its columns are 1, 2"},
    {"si", ", columns: {heave: a}, time: t", "t,a,a\n0,0,0\n1,1,1\n",
     "several columns `a`; its columns are 1 `t`, 2 `a`, 3 `a`; give its number"},
    {"si", ", columns: {heave: 2}, time: {step: 1}", "7\n8\n", "the record has 1 column, numbered"},
    {"si", ", columns: {heave: 3}", names, "the record has 2 columns, numbered from 1"},
    {"si", ", columns: {heave: {unit: mm}}", names, "heave.column` is missing"},
    {"si", ", columns: {heave: {column: 2, unite: mm}, surge: {scale: x}}", names, "unknown key"},
    {"si", ", columns: {heave: [2]}", names, "must be the name or number of a column or a mapping"},
    {"si", ", columns: {heave: {column: \"\"}}", names, "the name or number of a column"},
    {"si", ", columns: {heave: {column: [1]}}", names, "heave.column` must be"},
    {"si", ", columns: {heave: {}}", names, "must be the name or number of a column or a mapping"},
    {"si", ", columns: {}", names, "must be a mapping such as {heave:"},
    {"si", ", columns: 2", names, "must be a mapping such as {heave:"},
    {"si", ", columns: {heavee: 2, heave: 2, heave: 1}", names, "did you mean `heave`"},
    {"si", ", columns: {zzzzzz: 2}", names, "known here: surge"},
    {"si", ", time: {step: 1}", names, "1 `t` (times beside time.step)"},
    {"si", ", time: {step: 1}", "roll,qw\n0,0\n", "2 `qw` (part of a rotation)"},
    {"si", ", time: {step: 1}", "r11,heave\n0,0\n", "1 `r11` (part of a rotation)"},
    {"si", ", time: heave", "t,heave\n0,0\n", "at least two rows of numbers"},
    {"si", NULL, "a,b\nx,y\n", "the column t, the time, is missing"},
    {"si", NULL, "t,heave\n1,a,b\n", "the 2 columns of the first row"},
    {"si", NULL, "t,heave\n0,1,,\n1,2\n", "more cells than the 2 columns of the first row"},
    {"si", ", columns: {heave: 2}", "t,z (deg)\n0,0\n", "`deg` is a unit of angle, but heave"},
    {"si", ", time: t, columns: {" ROTATED "}", "t,w (m),x,y,z\n0,1,0,0,0\n1,1,0,0,0\n", ""},
    {"si", ", rotation: quaternion", "t,qw,zzz\n0,1,0\n", "3 `zzz` (unknown)"},
    {"si", NULL, "t,heave\ns,mm,-\n0,0\n", "`s` is not a number"},
    {"si", NULL, "t,heave\n,\n0,0\n", "an empty cell"},
    {"si", NULL, "t,heave\n\n0,0\n1,1\n", "an empty line between the rows"},
    {"si", NULL,
     "t,heave\na,1\nb,1\nc,1\nd,1\ne,1\nf,1\ng,1\nh,1\ni,1\nj,1\nk,1\nl,1\nm,1\nn,1\no,1\np,1\n"
     "q,1\nr,1\ns,1\n\n1,1\n",
     "an empty line between the rows"},
    {"si", NULL, " \n[{\"t\": 0}]\n", "is JSON; recorded motion is a table in CSV"},
    {"si", NULL, "\x89HDF\r\n\x1a\n", "recorded motion is a table in CSV with a column `t`\n"},
    /* keys */
    {"si", ", time: {step: 1, column: t}", names, "has both `step` and `column`"},
    {"si", ", time: {step: 1, unit: s}", names, "has both `step` and `unit`"},
    {"si", ", time: {step: 1, from: first}", names, "has both `step` and `from`"},
    {"si", ", time: {step: -1}", names, "motion.samples.time.step"},
    {"si", ", time: []", names, "must be the name or number of a column or a mapping"},
    {"si", ", columns: {roll: 1, qw: 2}", names,
     "`qw` is a column of rotations by quaternion, but "
     "others are by angles; give one kind"},
    {"si", ", rotation: matrix, columns: {qw: 2}", names, "but those of `rotation` are by matrix"},
    {"si", ", rotation: quaternion", names,
     "the record lacks the column `qw`: a rotation by quaternion"},
    {"si", ", rotation: sphere", names, "must be one of angles"},
    {"si", ", rotation: matrix, columns: [1]", names, "must be a mapping such as {heave:"},
    {"si", ", columns: {qw: 1, qx: 2}", names,
     "lacks `qy`: a rotation by quaternion has the columns"},
    {"si", ", columns: {r11: 1}", names, "lacks `r12`: a rotation by matrix has the columns r11,"},
    {"si", ", separator: dots, decimal: dash, from_first: perhaps, order: yxz, skip: -1", names,
     "must be one of comma, semicolon, tab, blanks"},
    {"si", ", comment: [a], time: \"\"", names, "`motion.samples.comment` must be"},
    {"si", ", cutoff: 1, smooth: rounding", names,
     "`motion.samples` has both `cutoff` and `smooth`"},
    {"si", ", smooth: {}", names, "must be"},
    {"si", "}, smooth: {heave: 1", names, "`motion.smooth` is for a bare file name"},
    {"si", ", rotation: matrix", "t,r11,r12\n0,1,0\n1,1,0\n",
     "lacks the column `r13`: a rotation by matrix has"},
    /* rows */
    {"si", ", time: 1, columns: {" ROTATED "}", "0,1,0,0,0\n1,0,0,0,0\n",
     "the quaternion of this row is 0"},
    {"si", ", time: 1, columns: {" TURNED "}", "0,1,0,0,0,1,0,0,0,1\n1,1,0,0,0,1,0,0,0,-1\n",
     "the matrix of this row is no rotation"},
    {"si", ", time: 1, columns: {" TURNED "}", "0,1,0,0,0,1,0,0,0,1\n1,1,0,0,0,2,0,0,0,1\n",
     "the matrix of this row is no rotation"},
    {"si", ", time: 1, columns: {qw: {column: 2, scale: 1e308}, qx: 3, qy: 4, qz: 5}",
     "0,100,0,0,0\n1,1,0,0,0\n", "the quaternion of this row is 0"},
    {"si", ", columns: {heave: {column: 2, scale: 1e308, unit: km}}", names,
     "row 2: heave is not finite in the units of the study"},
    {"si", NULL, "t,heave\n0,0\n2e9,0\n2e9,0\n",
     "the time 2000000000 must be greater than 2000000000"},
};

START_TEST(what_is_wrong_is_said) {
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char *path = record_of(wrong[i].record);
        reading made = read_as(wrong[i].units, wrong[i].keys, path);
        const char *said = made.messages ? made.messages : "";
        ck_assert_msg((made.status == GOUGH_OK) == !*wrong[i].said &&
                          strstr(said, wrong[i].said) != NULL,
                      "%s of\n%s\nexpected `%s`, found\n%s", wrong[i].keys ? wrong[i].keys : "",
                      wrong[i].record, wrong[i].said, said);
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

/* home is the first pose in any order of the angles: a top that keeps its rotation moves in its own axes */
START_TEST(poses_count_from_the_first_row_in_any_order) {
    static const char record[] = "0 0 0 0 0 0 90\n0.25 1 0 0 0 0 90\n0.5 0 2 0 0 0 90\n";
    for (int xyz = 0; xyz < 2; xyz++) {
        char *path = record_of(record);
        reading made =
            read_in(xyz ? "xyz" : "zyx", "si",
                    ", time: 1, columns: {surge: 2, sway: 3, heave: 4, roll: 5, pitch: 6, yaw: 7}, "
                    "from_first: true",
                    path);
        ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
        const double *value = made.study->model->motion.samples.value;
        static const double surge[] = {0, 0, 2}, sway[] = {0, -1, 0};
        for (size_t i = 0; i < 3; i++, value += GOUGH_COMPONENTS) {
            ck_assert(fabs(value[GOUGH_SURGE] - surge[i]) <= 1e-15);
            ck_assert(fabs(value[GOUGH_SWAY] - sway[i]) <= 1e-15);
            ck_assert(fabs(value[GOUGH_YAW]) <= 1e-15);
        }
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

/* and smoothing beside a bare name is checked with it */
START_TEST(a_mapping_names_its_file) {
    reading made = read_more("motion: {samples: {skip: 1}}\n", NULL);
    ck_assert_ptr_nonnull(strstr(made.messages, "`motion.samples.file` is missing"));
    reading_free(&made);
    made = read_more("motion: {samples: {}}\n", NULL);
    ck_assert_ptr_nonnull(strstr(made.messages, "the name of a file or a mapping such as"));
    reading_free(&made);
    static const char *const wrong_keys[] = {"cutoff: -1", "smooth: sphere", "smooth: {heave: -1}"};
    for (int i = 0; i < 3; i++) {
        char more[200];
        snprintf(more, sizeof more, "motion: {samples: no-such.csv, %s}\n", wrong_keys[i]);
        made = read_more(more, NULL);
        ck_assert_ptr_nonnull(strstr(made.messages, i ? "motion.smooth" : "motion.cutoff"));
        reading_free(&made);
    }
}
END_TEST

/* numbers of a column may vary, those of an unknown quantity not */
START_TEST(scales_may_vary_in_a_sweep) {
    static const char *const of[] = {"heave", "lift"};
    char *path = record_of("t,heave\n0,0\n1,1\n"), text[1000];
    for (int i = 0; i < 2; i++) {
        gough_sweep *sweep = NULL;
        char *messages = NULL;
        snprintf(text, sizeof text,
                 "%smotion: {samples: {file: '%s', columns: {heave: {column: 2, scale: 1}}}}\n"
                 "simulation: {duration: 1}\nsweep: {keys: {motion.samples.columns.%s.scale: [1, "
                 "2]}}\n",
                 good_study, path, of[i]);
        const gough_status status =
            gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &messages);
        ck_assert_msg((status == GOUGH_OK) == (i == 0), "%s", messages ? messages : "");
        if (i == 1) ck_assert_ptr_nonnull(strstr(messages, "motion.samples.columns.lift.scale"));
        gough_sweep_free(sweep);
        gough_study_free_messages(messages);
    }
    forget_file(path);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/record_layouts", 60, the_same_motion_is_read_in_any_layout,
                     what_is_wrong_is_said, poses_count_from_the_first_row_in_any_order,
                     a_mapping_names_its_file, scales_may_vary_in_a_sweep);
}
