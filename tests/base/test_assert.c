/* Assertions: this program has a handler of its own, which takes the place of the library's. */
#define _POSIX_C_SOURCE 200809L
#include "base/assert.h"

#include <setjmp.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

static jmp_buf back;
static const char *failed_file, *failed_condition;
static int failed_line, failures, leaves = 1;

void gough_assertion_failed(const char *file, int line, const char *condition) {
    failed_file = file;
    failed_line = line;
    failed_condition = condition;
    failures++;
    if (leaves) longjmp(back, 1);
}

START_TEST(a_failing_assertion_calls_the_programs_handler_with_its_place) {
    volatile int evaluated = 0, line = 0;
    failures = 0;
    assert_true(++evaluated == 1);
    ck_assert_int_eq(failures, 0);
    ck_assert_int_eq(evaluated, 1);
    if (setjmp(back) == 0) {
        line = __LINE__ + 1;
        assert_true(++evaluated == 1);
        ck_abort_msg("went on after a failed assertion");
    }
    ck_assert_int_eq(failures, 1);
    ck_assert_int_eq(evaluated, 2);
    ck_assert_str_eq(failed_file, "test_assert.c");
    ck_assert_int_eq(failed_line, line);
    ck_assert_str_eq(failed_condition, "++evaluated == 1");
}
END_TEST

START_TEST(a_handler_that_returns_is_followed_by_the_end_of_the_program) {
    const struct rlimit no_core = {0, 0};
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        setrlimit(RLIMIT_CORE, &no_core);
        signal(SIGABRT, SIG_DFL);
        leaves = 0;
        assert_true(failures < 0);
        _exit(0);
    }
    ck_assert(child > 0 && waitpid(child, &status, 0) == child);
    ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
}
END_TEST

/* Memory that is not aligned as the functions ask for: the library's own assertions call the handler. */
static gough_model model;

static void ask_for(int which, void *memory) {
    const gough_simulation s = gough_simulation_default();
    const gough_batch_options alone = {.lanes = 1, .threads = 1};
    const gough_batch_run run = {
        &model.machine, &model.control, &model.disturbance, &model.initial, 1, 0};
    gough_outcome outcome;
    static gough_tuning tuning;
    static gough_tuning_point point[GOUGH_TUNING_POINTS];
    gough_map map = {NULL, NULL, NULL};
    gough_map_options axes = gough_map_options_default();
    gough_tuning_options request = gough_tuning_options_default();
    axes.stiffness = (gough_map_range){1, 2, 2, false};
    axes.threads = request.threads = 1;
    request.deviation = 0.01;
    if (which == 0) gough_batch(&model.motion, &s, &run, 1, &alone, &outcome, memory, NULL);
    if (which == 1) gough_map_find(&model, &axes, &map, memory, NULL);
    if (which == 2) gough_tune(&model, &s, true, &request, point, &tuning, memory, NULL);
}

START_TEST(memory_that_is_not_aligned_is_a_bug_of_the_caller) {
    char *memory = aligned_alloc(64, 1 << 26);
    ck_assert_ptr_nonnull(memory);
    paper_machine(&model.machine);
    model.control.feedforward = true;
    set_gains(&model, 10, 1);
    set_formula(&model.motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    for (volatile int which = 0; which < 3; which++) {
        failures = 0;
        if (setjmp(back) == 0) ask_for(which, memory + 16);
        ck_assert_msg(failures == 1, "function %d", which);
        ck_assert_msg(strstr(failed_condition, "memory") != NULL, "%s", failed_condition);
    }
    free(memory);
}
END_TEST

int main(void) {
    return SUITE_RUN("base/assert", 60,
                     a_failing_assertion_calls_the_programs_handler_with_its_place,
                     a_handler_that_returns_is_followed_by_the_end_of_the_program,
                     memory_that_is_not_aligned_is_a_bug_of_the_caller);
}
