/* What a file of recorded motion is said to be: its columns and times, what its names may mean, and the mapping that reads it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

static gough_motion_file *described(const char *path) {
    gough_motion_file *file = NULL;
    char *messages = NULL;
    const gough_status status = gough_motion_file_read(path, &file, &messages);
    ck_assert_msg(status == GOUGH_OK, "%s", messages ? messages : "");
    return file;
}

static gough_motion_file *described_text(const char *text) {
    char *path = write_file("record.txt", text, strlen(text));
    gough_motion_file *file = described(path);
    forget_file(path);
    return file;
}

static void expect_refused(const char *path, gough_status expected, const char *said) {
    gough_motion_file *file = NULL;
    char *messages = NULL;
    ck_assert_int_eq(gough_motion_file_read(path, &file, &messages), expected);
    ck_assert_ptr_null(file);
    ck_assert_msg(strstr(messages, said) != NULL, "%s", messages);
    gough_study_free_messages(messages);
}

/* records, and the end of the mapping that reads them */
static const struct {
    const char *record, *mapping;
} proposals[] = {
    {"t,heave\n0,0\n1,1\n", "', time: {column: \"t\"}, columns: {heave: {column: \"heave\"}}}"},
    {"a;b\n0;0,5\n1;1\n", "', separator: semicolon, decimal: comma, time: {step: 0.01}, "
                          "columns: {heave: {column: \"a\"}}}"},
    {"t\tmode\tb\n0\ta\t1\n1\tb\t2\n",
     ", separator: tab, time: {column: \"t\"}, columns: {heave: {column: \"b\"}}}"},
    {"0 1 2\n1 2 2\n", ", separator: blanks, time: {column: 1}, columns: {heave: {column: 2}}}"},
    {"5\n6\n", "', time: {step: 0.01}, columns: {heave: {column: 1}}}"},
    /* units: known, of another kind, unknown */
    {"t,h (mm)\n0,1\n", "{heave: {column: \"h (mm)\", unit: \"mm\"}}}"},
    {"t,h (deg)\n0,1\n", "{heave: {column: \"h (deg)\"}}}"},
    {"t,h (kg)\n0,1\n", "{heave: {column: \"h (kg)\"}}}"},
    /* names that cannot stand in quotes, or are those of two columns */
    {"a\x01\n1\n", "{heave: {column: 1}}}"},
    {"a\x7f\n1\n", "{heave: {column: 1}}}"},
    {"a\xc2\x85\n1\n", "{heave: {column: 1}}}"},
    {"a\xc2\xa0\n1\n", "{heave: {column: \"a\xc2\xa0\"}}}"},
    {"a\"\n1\n", "{heave: {column: 1}}}"},
    {"a\\\n1\n", "{heave: {column: 1}}}"},
    {"a\xef\xbb\xbf\n1\n", "{heave: {column: 1}}}"},
    {"a\xf0\x9f\x9a\x80\n1\n", "{heave: {column: 1}}}"},
    {"a\xff\n1\n", "{heave: {column: 1}}}"},
    {"b,b\n1,2\n", "{heave: {column: 1}}}"},
    {"a name of more than sixty letters is longer than names of columns are\n1\n",
     "{heave: {column: 1}}}"},
    /* what names may mean */
    {"t,pos x,pos_y,pos.z\n0,1,2,3\n", "{surge: {column: \"pos x\"}, sway: {column: \"pos_y\"}, "
                                       "heave: {column: \"pos.z\"}}}"},
    {"t,posX,pos-Y,z\n0,1,2,3\n", "{surge: {column: \"posX\"}, sway: {column: \"pos-Y\"}, heave: "
                                  "{column: \"z\"}}}"},
    {"t,posx,POSX,9X,{X,ax1,aZ,\n0,1,2,3,4,5,6,7\n", "columns: {heave: {column: \"aZ\"}}}"},
    {"t,acc_x,vel_x,gyro_x,mag_x,my pitch\n0,1,2,3,4,5\n",
     "columns: {pitch: {column: \"my pitch\"}}}"},
    {"t,mode,heave\n0,auto,1\n", "columns: {heave: {column: \"heave\"}}}"},
    {"t,heading,roll_deg\n0,1,2\n", "{roll: {column: \"roll_deg\", unit: \"deg\"}, yaw: {column: "
                                    "\"heading\"}}}"},
    /* times of an epoch */
    {"timestamp,z\n1700000000123,0\n", "{column: \"timestamp\", unit: ms, from: first}"},
    {"timestamp,z\n1700000000123456,0\n", "{column: \"timestamp\", unit: us, from: first}"},
    {"timestamp (us),z\n1700000000123456,0\n",
     "{column: \"timestamp (us)\", unit: \"us\", from: first}"},
    {"1700000000123,0\n", "time: {column: 1, unit: ms, from: first}"},
    {"t,z\n1700000000,0\n", "time: {column: \"t\", from: first}"},
    /* rotations: whole ones, and parts of one */
    {"t,qw,qx,qy,qz,roll\n0,1,0,0,0,1\n", "qz: {column: \"qz\"}}, rotation: quaternion}"},
    {"t,r11,r12,r13,r21,r22,r23,r31,r32,r33\n0,1,0,0,0,1,0,0,0,1\n",
     "r33: {column: \"r33\"}}, rotation: matrix}"},
    {"t,r11,r12,r13,r21,r22,r23,r31,r32,r33,qw,qx,qy,qz\n0,1,0,0,0,1,0,0,0,1,1,0,0,0\n",
     "qz: {column: \"qz\"}}, rotation: quaternion}"},
    {"t,qw,qx,heave\n0,1,0,0\n", "columns: {heave: {column: \"heave\"}}}"},
    {"t,r11,r12\n0,1,0\n", "columns: {heave: {column: \"r11\"}}}"},
    {"t,heave\n", "time: {step: 0.01}, columns: {}}"},
};

START_TEST(a_mapping_is_proposed_for_any_layout) {
    for (size_t i = 0; i < sizeof proposals / sizeof proposals[0]; i++) {
        gough_motion_file *file = described_text(proposals[i].record);
        ck_assert_msg(strstr(file->mapping, proposals[i].mapping) != NULL, "%s\n%s\ninstead of %s",
                      proposals[i].record, file->mapping, proposals[i].mapping);
        gough_motion_file_free(file);
    }
}
END_TEST

/* keys that are given stand in the mapping too */
START_TEST(a_proposal_keeps_the_keys_of_the_study) {
    static const char *const cases[][3] = {
        {", time: {step: 0.02}, skip: 1, comment: \"it's\"", "no\nit's\n1,1\n2,2\n",
         "skip: 1, comment: 'it''s', time: {step: 0.02}, columns: {heave: {column: 1}}}"},
        {", time: {from: first}", "timestamp,z\n-2,1\n-1,0\n",
         "time: {column: \"timestamp\", from: first}, columns: {heave: {column: \"z\"}}}"},
        {"", "timestamp,z\n", "time: {column: \"timestamp\"}, columns: {heave: {column: \"z\"}}}"},
        {"", "alpha,beta\n", "time: {step: 0.01}, columns: {heave: {column: \"alpha\"}}}"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1000], *path = write_file("it's.txt", cases[i][1], strlen(cases[i][1]));
        snprintf(text, sizeof text, "%smotion: {samples: {file: \"%s\"%s}}\n", good_study, path,
                 cases[i][0]);
        expect_said(text, cases[i][2]);
        expect_said(text, "/it''s.txt', ");
        forget_file(path);
    }
}
END_TEST

/* a path may be longer than the room for the mapping */
START_TEST(a_mapping_ends_where_its_room_does) {
    char *path = write_file("record.txt", "0,1\n1,2\n", 8), more[4000] = "";
    const size_t folder = (size_t)(strrchr(path, '/') + 1 - path);
    memcpy(more, path, folder);
    for (int i = 0; i < 1300; i++) strcat(more + folder, "./");
    strcat(more, path + folder);
    gough_motion_file *file = described(more);
    ck_assert_uint_eq(strlen(file->mapping), 2499);
    gough_motion_file_free(file);
    forget_file(path);
}
END_TEST

START_TEST(columns_and_times_are_described) {
    gough_motion_file *file =
        described_text("t,a,b,heave\n\n0,5,x,0\n#\n0.1,5,1,3\n0.2,,2,4\n0.3,5,9,1\n");
    ck_assert_uint_eq(file->rows, 4);
    ck_assert_uint_eq(file->time, 1);
    ck_assert(fabs(file->interval - 0.1) <= 1e-15 && file->even && !file->certain);
    ck_assert(file->column[0].certain && file->column[3].certain && !file->column[1].certain);
    /* no jump over a cell that is no number, and none where nothing changes */
    ck_assert_uint_eq(file->column[1].numbers, 3);
    ck_assert(fabs(file->column[1].jump) <= 0 && file->column[1].jump_row == 0);
    ck_assert_uint_eq(file->column[2].numbers, 3);
    ck_assert(fabs(file->column[2].jump - 7) <= 0 && file->column[2].jump_row == 4);
    ck_assert(fabs(file->column[3].least) <= 0 && fabs(file->column[3].greatest - 4) <= 0);
    /* 12 e/h² of half a unit */
    ck_assert(fabs(file->column[3].acceleration - 600) <= 1e-9);
    gough_motion_file_free(file);
}
END_TEST

/* no times, one row, times that are no numbers, that do not increase; and a record that begins after 0 */
START_TEST(times_that_are_none_have_no_interval) {
    static const char *const records[] = {"heave\n0\n1\n", "t,heave\n0,1\n",
                                          "t,heave\n0,1\nx,2\n1,3\n", "t,heave\n0,1\n0,2\n",
                                          "t,heave\n"};
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        gough_motion_file *file = described_text(records[i]);
        ck_assert_msg(isnan(file->interval), "%s", records[i]);
        gough_motion_file_free(file);
    }
    static const char *const certain[] = {"t,heave\n-1,0\n1,1\n", "t,heave\n0,0\n1,1\n",
                                          "t,heave\n1,0\n2,1\n"};
    for (int i = 0; i < 3; i++) {
        gough_motion_file *file = described_text(certain[i]);
        ck_assert_msg(file->certain == (i < 2), "%s", certain[i]);
        gough_motion_file_free(file);
    }
    gough_motion_file_free(NULL);
}
END_TEST

/* what is found beyond plain names is a remark in one line */
START_TEST(what_was_found_is_told) {
    static const char *const told[][3] = {
        {"", "t;heave\n0;0,5\n1;1\n",
         "motion.samples has semicolons between its columns and decimal commas"},
        {", separator: semicolon", "t;heave\n0;0,5\n1;1\n", "motion.samples has decimal commas"},
        {", decimal: comma", "t;heave\n0;0,5\n1;1\n",
         "motion.samples has semicolons between its columns"},
        {"", "t\theave\ns\tm\n0\t0\n1\t1\n", "has tabs between its columns and a row of units"},
        {"", "t,heave\ns,m\n0,0\n1,1\n", "motion.samples has a row of units"},
        {", time: 1, columns: {heave: 2}", "0 0\n1 1\n",
         "motion.samples has blanks between its columns"},
        {"", "Time,heave (mm)\n0,0\n1,1\n",
         "motion.samples: read `Time` as the time, `heave (mm)` as heave in mm"},
        {", time: {column: 1, unit: s}, columns: {heave: 2}", "a,b (mm)\n0,0\n1,1\n",
         "motion.samples: read `b (mm)` as heave in mm"}};
    for (size_t i = 0; i < sizeof told / sizeof told[0]; i++) {
        char text[1000], *path = write_file("record.txt", told[i][1], strlen(told[i][1]));
        snprintf(text, sizeof text,
                 "units: si\nplatform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, "
                 "half_angle: 15}, height: 1.2}\nload: {mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
                 "motion: {samples: {file: '%s'%s}}\nsimulation: {duration: 0.5}\n",
                 path, told[i][0]);
        reading made = read_bytes(text, strlen(text), NULL);
        ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
        bool found = false;
        for (size_t k = 0; k < made.study->record->remarks; k++)
            found |= strstr(made.study->record->remark[k].sentence, told[i][2]) != NULL;
        ck_assert_msg(found, "%s", told[i][2]);
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

/* a remark has room for 360 bytes of columns: those that do not fit are left out */
START_TEST(long_names_leave_columns_out_of_a_remark) {
    char csv[1500] = "t", text[1000];
    static const char *const of[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    for (int c = 0; c < 6; c++)
        sprintf(csv + strlen(csv), ",%s%45s(%s)", of[c], "", c < 3 ? "mm" : "deg");
    strcat(csv, "\n0,0,0,0,0,0,0\n1,0,0,0,0,0,0\n");
    char *path = write_file("record.txt", csv, strlen(csv));
    snprintf(text, sizeof text,
             "units: si\nplatform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, "
             "half_angle: 15}, height: 1.2}\nload: {mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
             "motion: {samples: '%s'}\nsimulation: {duration: 0.5}\n",
             path);
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    ck_assert_uint_eq(made.study->record->remarks, 1);
    ck_assert_ptr_nonnull(strstr(made.study->record->remark[0].sentence, "as heave in mm"));
    ck_assert_ptr_null(strstr(made.study->record->remark[0].sentence, "as yaw"));
    reading_free(&made);
    forget_file(path);
}
END_TEST

/* in a study and alone: a line of more than a million bytes at the start and behind the first lines; too many rows; lines that
 * are not looked at for the layout; rows of more cells than names are looked for in */
START_TEST(files_that_are_too_large_are_refused) {
    enum { LONG = 1100000, LINES = 2000003 };
    char *text = malloc(LONG + 5000), study[1000], *path;
    ck_assert_ptr_nonnull(text);
    for (int late = 0; late < 2; late++) {
        size_t length = (size_t)sprintf(text, "t,heave\n");
        for (int i = 0; i < 300 * late; i++)
            length += (size_t)sprintf(text + length, "%d,%d\n", i, i);
        memset(text + length, '1', LONG);
        path = write_file("long.csv", text, length + LONG);
        snprintf(study, sizeof study, "%smotion: {samples: '%s'}\n", good_study, path);
        expect_said(study, late ? "long.csv:302:1: error: this line has more than a million bytes"
                                : "long.csv:2:1: error: this line has more than a million bytes");
        expect_refused(path, GOUGH_ERROR_INPUT, "more than a million bytes");
        forget_file(path);
    }
    free(text);
    text = malloc(8 + LINES);
    ck_assert_ptr_nonnull(text);
    memcpy(text, "t,heave\n", 8);
    memset(text + 8, '\n', LINES);
    path = write_file("rows.csv", text, 8 + LINES);
    expect_refused(path, GOUGH_ERROR_INPUT, "more than 2 000 000 rows");
    forget_file(path);
    free(text);
    expect_refused("no-such.csv", GOUGH_ERROR_FILE, "no-such.csv");
}
END_TEST

START_TEST(comments_may_be_long) {
    enum { LONG = 300000 };
    char *text = malloc(LONG + 5000), *path;
    ck_assert_ptr_nonnull(text);
    memset(text, '#', LONG);
    sprintf(text + LONG, "\nt,heave\n0,0\n1,1\n");
    path = write_file("long.csv", text, strlen(text));
    gough_motion_file *file = described(path); /* its first lines are one comment */
    ck_assert(!file->certain && file->rows == 0);
    gough_motion_file_free(file);
    forget_file(path);
    memset(text, ',', 5000);
    sprintf(text + 5000, "\n0,0\n1,1\n");
    text[0] = '#';
    path = write_file("cells.csv", text, strlen(text));
    file = described(path);
    ck_assert(!file->named && file->rows == 2 && file->columns == 2);
    gough_motion_file_free(file);
    forget_file(path);
    free(text);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/motion_file", 60, a_mapping_is_proposed_for_any_layout,
                     a_proposal_keeps_the_keys_of_the_study, a_mapping_ends_where_its_room_does,
                     columns_and_times_are_described, times_that_are_none_have_no_interval,
                     what_was_found_is_told, long_names_leave_columns_out_of_a_remark,
                     files_that_are_too_large_are_refused, comments_may_be_long);
}
