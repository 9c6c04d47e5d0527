/* Columns: which of them a run fills, and how an end is worded. */
#include <stdlib.h>

#include "support/machines.h"
#include "support/suite.h"

typedef struct {
    int rows;
    bool filled[GOUGH_COLUMNS], empty[GOUGH_COLUMNS];
} seen;

static int look(void *context, const gough_row *row) {
    seen *s = context;
    s->rows++;
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        if (isnan(row->value[c]))
            s->empty[c] = true;
        else
            s->filled[c] = true;
    }
    return 0;
}

START_TEST(a_run_fills_the_columns_that_it_is_said_to_fill) {
    gough_model *model = calloc(1, sizeof *model);
    paper_machine(&model->machine);
    set_all_axes(model);
    set_gains(model, 50, 5);
    model->control.feedforward = true;
    for (int kind = 0; kind < 16; kind++) {
        const bool simulated = kind & 1, reactions = kind & 2, joints = kind & 4, rough = kind & 8;
        gough_simulation s = gough_simulation_default();
        seen found = {.rows = 0};
        gough_summary summary;
        gough_end end;
        for (int v = 0; v < GOUGH_LEGS; v++) model->machine.platform.friction.viscous[v] = rough;
        s.summary = &summary; /* which looks at the joints where there is friction */
        s.duration = 0.2;
        s.reactions = reactions;
        s.joints = joints;
        ck_assert_int_eq(simulated ? gough_simulate(model, &s, look, &found, &end, NULL)
                                   : gough_forces(model, &s, look, &found, NULL, NULL, &end, NULL),
                         GOUGH_OK);
        ck_assert_int_eq(found.rows, 5);
        for (int c = 0; c < GOUGH_COLUMNS; c++) {
            const bool filled = gough_column_filled(c, simulated, &s);
            ck_assert_msg(found.filled[c] == filled && found.empty[c] == !filled, "kind %d: %s",
                          kind, gough_column(c)->name);
        }
    }
    free(model);
}
END_TEST

START_TEST(columns_outside_the_enumeration_are_not_there) {
    static const int outside[] = {-1, GOUGH_COLUMNS, 1000, -2147483647 - 1, 2147483647};
    gough_simulation s = gough_simulation_default();
    s.reactions = s.joints = true;
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
        ck_assert_ptr_null(gough_column(outside[i]));
        ck_assert(!gough_column_filled(outside[i], true, &s));
    }
}
END_TEST

static const char *said(gough_cause cause, unsigned legs, const char *message, bool units) {
    static const gough_end_words si = {" m", " m/s", " m/s^2", " N",
                                       " s", " deg", " deg/s", " deg/s^2"},
                                 none = {"", "", "", "", "", "", "", ""};
    static gough_end end;
    end = (gough_end){.cause = cause, .time = 1.5, .limit = 0.75, .legs = legs};
    memcpy(end.message, message, strlen(message) + 1);
    gough_end_say(&end, units ? &si : &none);
    return end.message;
}

START_TEST(ends_are_worded_with_the_units_of_the_caller) {
    ck_assert_str_eq(said(GOUGH_END_LEG_SHORT, 4, "", true),
                     "leg 3 gets shorter than its least length 0.75 m at t = 1.5 s");
    ck_assert_str_eq(said(GOUGH_END_LEG_LONG, 3, "", true),
                     "legs 1 and 2 get longer than their greatest length 0.75 m at t = 1.5 s");
    ck_assert_str_eq(said(GOUGH_END_LEG_SPEED, 7, "", true),
                     "legs 1, 2 and 3 exceed their greatest speed 0.75 m/s at t = 1.5 s");
    ck_assert_str_eq(said(GOUGH_END_LEG_FORCE, 63, "", true),
                     "all six legs exceed their greatest force 0.75 N at t = 1.5 s");
    ck_assert_str_eq(said(GOUGH_END_LEG_FORCE, 32, "", false),
                     "leg 6 exceeds its greatest force 0.75 at t = 1.5");
    /* other ends keep their words; their time has a unit, once */
    ck_assert_str_eq(said(GOUGH_END_SINGULAR, 0, "singular at t = 3, after that", true),
                     "singular at t = 1.5 s, after that");
    ck_assert_str_eq(said(GOUGH_END_SINGULAR, 0, "singular at t = 1.5 s, after that", true),
                     "singular at t = 1.5 s, after that");
    ck_assert_str_eq(said(GOUGH_END_DONE, 0, "", true), "");
    ck_assert_str_eq(said((gough_cause)99, 1, "no cause", true), "no cause");
}
END_TEST

int main(void) {
    return SUITE_RUN("run/columns", 60, a_run_fills_the_columns_that_it_is_said_to_fill,
                     columns_outside_the_enumeration_are_not_there,
                     ends_are_worded_with_the_units_of_the_caller);
}
