/* Ten thousand wild records exceed no bound of the limiter.
 * Label: campaign: it takes half a minute.
 * Not sanitized: test_limiter.c runs the same. */
#include <stdio.h>

#include "cueing/hostile.h"
#include "support/suite.h"

START_TEST(ten_thousand_wild_records_exceed_no_bound) {
    const hostile_count count = hostile_records(10000, 2);
    printf("%d records to their end, %d ended for want of a certain pose, %d samples limited; "
           "beyond by %.2g, to the end of the stroke %.2g m\n",
           count.whole, count.ended, count.limited, count.beyond, count.nearest);
    ck_assert_double_le(count.beyond, 1e-12);
    ck_assert_int_eq(count.whole + count.ended, 10000);
}
END_TEST

int main(void) {
    return SUITE_RUN("cueing/hostile", 600, ten_thousand_wild_records_exceed_no_bound);
}
