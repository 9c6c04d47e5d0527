/* One suite of Check tests as a program: returns the exit status for main. */
#ifndef TESTS_SUPPORT_SUITE_H
#define TESTS_SUPPORT_SUITE_H

#include <check.h>
#include <stdlib.h>

static inline int suite_run(const char *name, double seconds, const TTest *const tests[],
                            size_t count) {
    Suite *suite = suite_create(name);
    TCase *test_case = tcase_create(name);
    SRunner *runner;
    int failed;

    tcase_set_timeout(test_case, seconds);
    for (size_t i = 0; i < count; i++) tcase_add_test(test_case, tests[i]);
    suite_add_tcase(suite, test_case);
    runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#define SUITE_RUN(name, seconds, ...)                                                              \
    suite_run(name, seconds, (const TTest *const[]){__VA_ARGS__},                                  \
              sizeof((const TTest *const[]){__VA_ARGS__}) / sizeof(const TTest *))

#endif
