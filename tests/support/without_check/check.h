/* What the tests of the core need of the library Check, for a C library that it is not built for: the same names, all tests in one
 * process. The first assertion that fails is printed with its place and ends the program with 1. */
#ifndef TESTS_WITHOUT_CHECK_H
#define TESTS_WITHOUT_CHECK_H

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct TTest {
    const char *name;
    void (*run)(int _i);
} TTest;

typedef struct TCase {
    const char *name;
    int count;
} TCase;
typedef TCase Suite;
typedef TCase SRunner;

enum { CK_NORMAL };

#define START_TEST(test)                                                                           \
    static void test##_run(int _i);                                                                \
    static const TTest test##_ttest = {#test, test##_run};                                         \
    static const TTest *const test = &test##_ttest;                                                \
    static void test##_run(__attribute__((unused)) int _i)
#define END_TEST

static inline Suite *suite_create(const char *name) {
    Suite *suite = calloc(1, sizeof *suite);
    if (suite == NULL) abort();
    suite->name = name;
    printf("%s\n", name);
    return suite;
}

static inline TCase *tcase_create(const char *name) { return suite_create(name); }
static inline void tcase_set_timeout(TCase *cases, double seconds) { (void)cases, (void)seconds; }

static inline void tcase_add_loop_test(TCase *cases, const TTest *test, int from, int to) {
    for (int i = from; i < to; i++) {
        printf("  %s %d\n", test->name, i);
        fflush(stdout);
        test->run(i);
        cases->count++;
    }
}

static inline void tcase_add_test(TCase *cases, const TTest *test) {
    tcase_add_loop_test(cases, test, 0, 1);
}

static inline void suite_add_tcase(Suite *suite, TCase *cases) {
    suite->count += cases->count;
    free(cases);
}
static inline SRunner *srunner_create(Suite *suite) { return suite; }
static inline void srunner_run_all(SRunner *runner, int mode) { (void)runner, (void)mode; }
static inline int srunner_ntests_failed(const SRunner *runner) {
    printf("%d tests passed\n", runner->count);
    return 0;
}
static inline void srunner_free(SRunner *runner) { free(runner); }

#define ck_abort_msg(...)                                                                          \
    do {                                                                                           \
        fprintf(stderr, "%s:%d: ", __FILE__, __LINE__);                                            \
        fprintf(stderr, __VA_ARGS__);                                                              \
        fputc('\n', stderr);                                                                       \
        exit(1);                                                                                   \
    } while (0)
#define ck_assert_msg(holds, ...)                                                                  \
    do {                                                                                           \
        if (!(holds)) ck_abort_msg(__VA_ARGS__);                                                   \
    } while (0)
#define ck_assert(holds) ck_assert_msg(holds, "%s does not hold", #holds)

#define CK_NUMBERS_(type, format, a, relation, b)                                                  \
    do {                                                                                           \
        const type left_ = (a), right_ = (b);                                                      \
        ck_assert_msg(left_ relation right_, "%s %s %s does not hold: %" format " and %" format,   \
                      #a, #relation, #b, left_, right_);                                           \
    } while (0)
#define ck_assert_int_eq(a, b) CK_NUMBERS_(intmax_t, PRIdMAX, a, ==, b)
#define ck_assert_int_ne(a, b) CK_NUMBERS_(intmax_t, PRIdMAX, a, !=, b)
#define ck_assert_int_lt(a, b) CK_NUMBERS_(intmax_t, PRIdMAX, a, <, b)
#define ck_assert_int_le(a, b) CK_NUMBERS_(intmax_t, PRIdMAX, a, <=, b)
#define ck_assert_int_gt(a, b) CK_NUMBERS_(intmax_t, PRIdMAX, a, >, b)
#define ck_assert_int_ge(a, b) CK_NUMBERS_(intmax_t, PRIdMAX, a, >=, b)
#define ck_assert_uint_eq(a, b) CK_NUMBERS_(uintmax_t, PRIuMAX, a, ==, b)
#define ck_assert_uint_ne(a, b) CK_NUMBERS_(uintmax_t, PRIuMAX, a, !=, b)
#define ck_assert_uint_lt(a, b) CK_NUMBERS_(uintmax_t, PRIuMAX, a, <, b)
#define ck_assert_uint_le(a, b) CK_NUMBERS_(uintmax_t, PRIuMAX, a, <=, b)
#define ck_assert_uint_gt(a, b) CK_NUMBERS_(uintmax_t, PRIuMAX, a, >, b)
#define ck_assert_uint_ge(a, b) CK_NUMBERS_(uintmax_t, PRIuMAX, a, >=, b)
#define ck_assert_double_lt(a, b) CK_NUMBERS_(double, ".17g", a, <, b)
#define ck_assert_double_le(a, b) CK_NUMBERS_(double, ".17g", a, <=, b)
#define ck_assert_double_ge(a, b) CK_NUMBERS_(double, ".17g", a, >=, b)
#define ck_assert_double_gt(a, b) CK_NUMBERS_(double, ".17g", a, >, b)
#define ck_assert_double_eq_tol(a, b, tolerance)                                                   \
    ck_assert_msg(fabs((double)(a) - (double)(b)) < (tolerance), "%s is %.17g, not %.17g", #a,     \
                  (double)(a), (double)(b))
#define ck_assert_ptr_null(a) ck_assert((a) == NULL)
#define ck_assert_ptr_nonnull(a) ck_assert((a) != NULL)
#define ck_assert_ptr_eq(a, b) ck_assert((a) == (b))
#define ck_assert_mem_eq(a, b, size) ck_assert(memcmp(a, b, size) == 0)
#define ck_assert_str_eq(a, b)                                                                     \
    do {                                                                                           \
        const char *left_ = (a), *right_ = (b);                                                    \
        ck_assert_msg(strcmp(left_, right_) == 0, "%s is '%s', not '%s'", #a, left_, right_);      \
    } while (0)
#define ck_assert_str_ne(a, b) ck_assert(strcmp(a, b) != 0)

#endif
