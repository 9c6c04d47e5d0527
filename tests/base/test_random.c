/* Random numbers: normal ones are the quantiles of the uniform ones at the same place. The distribution function is computed here
 * another way than in the library, which uses erfc: by its series and its continued fraction, in long double. */
#include <math.h>

#include "gough/random.h"
#include "support/suite.h"

/* Share of the normal distribution beyond z ≥ 0. */
static long double tail_beyond(long double z) {
    const long double density = expl(-0.5L * z * z) / 2.506628274631000502415765284811045253L;
    if (z < 3) {
        /* Φ(z) − ½ = φ(z) Σ z^{2k+1} / (1·3·5 … (2k+1)), all terms positive */
        long double term = z, sum = z;
        for (int k = 1; k < 200; k++) sum += term *= z * z / (2 * k + 1);
        return 0.5L - density * sum;
    }
    /* Laplace's continued fraction φ(z) / (z + 1/(z + 2/(z + …))) */
    long double fraction = z;
    for (int k = 400; k > 0; k--) fraction = z + k / fraction;
    return density / fraction;
}

/* Quantiles from tables, to all digits of a double. */
START_TEST(the_reference_agrees_with_tables) {
    static const struct {
        long double z, tail;
    } known[] = {{0, 0.5L},
                 {0.674489750196081743202227014541307L, 0.25L},
                 {1.281551565544600466965103329448743L, 0.1L},
                 {1.959963984540054235524594430520551L, 0.025L},
                 {3.090232306167813541540399830107379L, 1e-3L},
                 {4.753424308822898948193988222546150L, 1e-6L},
                 {6.361340902404056204775210009893L, 1e-10L}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const long double found = tail_beyond(known[i].z);
        /* the difference of ½ and the series loses what the tail is smaller */
        ck_assert_msg(fabsl(found - known[i].tail) <= 1e-15L * known[i].tail + 2e-19L,
                      "%Lg: %Lg for %Lg", known[i].z, found, known[i].tail);
    }
}
END_TEST

START_TEST(normal_numbers_are_quantiles_to_all_digits) {
    enum { SEEDS = 4, DRAWS = 20000 };
    double greatest = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++)
        for (uint64_t draw = 0; draw < DRAWS; draw++) {
            const double u = gough_random_uniform(seed, 7, draw);
            const double z = gough_random_normal(seed, 7, draw);
            /* the middle of the 2^53 equal intervals that u begins; exact in long double */
            const long double p = (long double)u + 0x1p-54L;
            const long double wanted = p < 0.5L ? p : 1 - p;
            ck_assert((z < 0) == (p < 0.5L));
            const long double x = fabsl((long double)z);
            const long double density = expl(-0.5L * x * x) / 2.5066282746310005024L;
            const long double miss = fabsl(tail_beyond(x) - wanted) / density;
            /* above ½ the library's p is rounded to a double */
            const long double rounded = p > 0.5L ? 0x1p-53L / density : 0;
            ck_assert_msg(miss <= 1e-15L * (1 + x) + rounded,
                          "seed %d, draw %d: %.17g is off by %Lg", (int)seed, (int)draw, z, miss);
            greatest = fmax(greatest, fabs(z));
        }
    ck_assert(greatest > 3.8); /* the tails were met */
}
END_TEST

/* Words of Philox 4×32-10 as its authors publish them (Random123, kat_vectors): counter and key are all zeros, all ones, digits
 * of π; the counter is (draw, run) and the key the seed, with the low words first. */
START_TEST(uniform_numbers_are_the_published_words) {
    static const struct {
        uint64_t draw, run, seed;
        uint32_t word[2]; /* the first two of four */
    } known[] = {{0, 0, 0, {0x6627e8d5u, 0xe169c58du}},
                 {UINT64_MAX, UINT64_MAX, UINT64_MAX, {0x408f276du, 0x41c83b0eu}},
                 {0x85a308d3243f6a88u,
                  0x0370734413198a2eu,
                  0x299f31d0a4093822u,
                  {0xd16cfe09u, 0x94fdccebu}}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const uint64_t bits = (uint64_t)known[i].word[1] << 32 | known[i].word[0];
        const double found = gough_random_uniform(known[i].seed, known[i].run, known[i].draw);
        ck_assert_msg(!(fabs(found - (double)(bits >> 11) * 0x1p-53) > 0) && isfinite(found),
                      "vector %zu: %a", i, found);
    }
}
END_TEST

/* moments of a hundred thousand draws, and the normal distribution's own function of each */
START_TEST(normal_numbers_are_normal) {
    double mean = 0, square = 0, fourth = 0;
    const int n = 100000;

    for (int i = 0; i < n; i++) {
        const double z = gough_random_normal(5, (uint64_t)i, 3),
                     u = gough_random_uniform(5, (uint64_t)i, 3);
        ck_assert(fabs(0.5 * erfc(-z * sqrt(0.5)) - u) <= 1e-14);
        mean += z / n;
        square += z * z / n;
        fourth += z * z * z * z / n;
    }
    ck_assert(fabs(mean) <= 0.01);
    ck_assert(fabs(square - 1) <= 0.02);
    ck_assert(fabs(fourth - 3) <= 0.15);
}
END_TEST

int main(void) {
    return SUITE_RUN("base/random", 60, uniform_numbers_are_the_published_words,
                     the_reference_agrees_with_tables, normal_numbers_are_quantiles_to_all_digits,
                     normal_numbers_are_normal);
}
