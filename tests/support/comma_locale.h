/* A locale whose decimal point is a comma. Include before any other header. */
#ifndef GOUGH_TESTS_COMMA_LOCALE_H
#define GOUGH_TESTS_COMMA_LOCALE_H

#define _POSIX_C_SOURCE 200809L
#include <check.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

/* made for the occasion in a folder of its own, as few systems have one installed; glibc keeps
 * what it has read */
static inline void locale_with_comma(void) {
#ifdef __GLIBC__
    char folder[] = "/tmp/gough-locale-XXXXXX", command[200];
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8", folder);
    ck_assert_msg(system(command) == 0, "localedef failed: Debian's package locales has it");
    ck_assert_int_eq(setenv("LOCPATH", folder, 1), 0);
    ck_assert_ptr_nonnull(setlocale(LC_ALL, "de_DE.UTF-8"));
    snprintf(command, sizeof command, "rm -r %s", folder);
    ck_assert_int_eq(system(command), 0);
    ck_assert_str_eq(localeconv()->decimal_point, ",");
#else
    /* musl, for one, has a point in every locale */
    setlocale(LC_ALL, "de_DE.UTF-8");
    printf("    this C library has no locales of localedef: decimal point '%s'\n",
           localeconv()->decimal_point);
#endif
}

static inline void locale_reset(void) {
    setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
}

#endif
