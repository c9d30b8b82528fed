// SPDX-License-Identifier: GPL-3.0-or-later
// The rules that alone decide what balls may do: overlaps of discs and spheres on the lattice of
// positions against whole numbers, energies of soft spheres against long double, second virial
// coefficients by integration over the rules. Long mode: PERRIN_SHAPE_PAIRS=1e7 pairs of each.
#include "dmc/balls.h"
#include "pairs.h"
#include "suite.h"

#include "base/constants.h"
#include "rng/rng.h"
#include "shapes/shape.h"

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static const RngKey KEY = {.seed = 23};

// Two balls, of which the first is asked whether it may be elsewhere.
typedef struct Pair {
    Balls balls;
    Ball ball[2];
    double radius[2];
    float radius_single[2];
} Pair;

static void set_pair(Pair *pair, const double edge[3], double diameter, double other) {
    pair->balls = (Balls){.count = 2,
                          .ball = pair->ball,
                          .radius = pair->radius,
                          .radius_single = pair->radius_single};
    for (int a = 0; a < 3; a++) {
        pair->balls.unit[a] = edge[a] * 0x1p-32;
        pair->balls.unit_single[a] = (float)pair->balls.unit[a];
    }
    pair->radius[0] = diameter / 2, pair->radius[1] = other / 2;
    for (int i = 0; i < 2; i++) pair->radius_single[i] = (float)pair->radius[i];
}

// The second at any place of the box; the first `steps` from it, round the box if need be.
static void put(Pair *pair, Rng *rng, const int32_t steps[3], uint32_t place[3]) {
    for (int a = 0; a < 3; a++) {
        const uint32_t at = (uint32_t)rng_below(rng, UINT32_MAX);
        pair->ball[1].place[a] = ((int64_t)rng_below(rng, 5) - 2) * (1ll << 32) + at;
        place[a] = at + (uint32_t)steps[a];
    }
}

static bool overlap(Pair *pair, Rng *rng, const int32_t steps[3]) {
    uint32_t place[3];
    put(pair, rng, steps, place);
    return balls_overlap(&pair->balls, 0, place, 1);
}

static void steps_to(const Pair *pair, const double u[3], double distance, int32_t steps[3]) {
    for (int a = 0; a < 3; a++) {
        steps[a] = (int32_t)rint(distance * u[a] / pair->balls.unit[a]);
    }
}

// At distances that whole steps can have, to the last step: in an edge of 16 a step is 2^-28.
START_TEST(balls_that_just_touch_do_not_overlap_and_a_step_nearer_they_do) {
    static const int32_t touching[][3] = {{1 << 28, 0, 0},
                                          {0, -(1 << 28), 0},
                                          {0, 0, 1 << 28}, // along an edge
                                          {3 << 25, -(1 << 27), 0},
                                          {-(1 << 27), 3 << 25, 0}}; // 3, 4, 5
    static const double contact[] = {1, 1, 1, 0.625, 0.625};
    Rng rng = rng_open(KEY, STREAM_PACKING, 1, 0);
    for (size_t i = 0; i < sizeof contact / sizeof *contact; i++) {
        Pair pair;
        set_pair(&pair, (const double[]){16, 16, 16}, 0.5, 2 * contact[i] - 0.5);
        for (int a = 0; a < 3; a++) {
            int32_t nearer[3] = {touching[i][0], touching[i][1], touching[i][2]};
            ck_assert_msg(!overlap(&pair, &rng, nearer), "case %zu", i);
            if (nearer[a] == 0) continue;
            nearer[a] -= nearer[a] > 0 ? 1 : -1;
            ck_assert_msg(overlap(&pair, &rng, nearer), "case %zu, nearer along %d", i, a);
        }
    }
}
END_TEST

// Sizes, boxes and places at random, most pairs within some lattice steps of contact.
START_TEST(balls_overlap_as_whole_numbers_say) {
    const int64_t pairs = pairs_wanted();
    Rng rng = rng_open(KEY, STREAM_PACKING, 2, 0);
    int64_t close = 0, overlapping = 0;
    for (int64_t i = 0; i < pairs; i++) {
        Pair pair;
        const double edge = 5 + 20 * rng_uniform(&rng), other = 0.3 + rng_uniform(&rng);
        set_pair(&pair, (const double[]){edge, edge, edge}, 1, other);
        double u[3];
        int32_t steps[3];
        random_direction(&rng, 2 + (int)(i & 1), u); // discs and spheres
        const double far =
            rng_below(&rng, 4) ? 1 + 4e-9 * (rng_uniform(&rng) - 0.5) : 2 * rng_uniform(&rng);
        steps_to(&pair, u, (1 + other) / 2 * far, steps);
        __extension__ unsigned __int128 square = 0; // exact
        for (int a = 0; a < 3; a++) square += (uint64_t)((int64_t)steps[a] * steps[a]);
        const long double contact =
            ((long double)pair.radius[0] + pair.radius[1]) / pair.balls.unit[0];
        const long double beyond = (long double)square / (contact * contact) - 1;
        const bool found = overlap(&pair, &rng, steps);
        overlapping += found;
        if (fabsl(beyond) < 8 * 0x1p-53L) // what squares and sums in double precision may lose
            close++;
        else
            ck_assert_msg(found == (beyond < 0), "pair %lld", (long long)i);
    }
    ck_assert_int_gt(overlapping, pairs / 3);
    ck_assert_int_lt(overlapping, 2 * pairs / 3);
    ck_assert_int_lt(close, pairs / 1000);
    printf("balls: %lld pairs, %lld overlap, %lld too close to call\n", (long long)pairs,
           (long long)overlapping, (long long)close);
}
END_TEST

// kT (d/r)^n in units, with what is done where it is more than can be told.
static long double twin_energy(const Pair *pair, const int32_t steps[3]) {
    long double square = 0;
    for (int a = 0; a < 3; a++) {
        const long double r = steps[a] * (long double)pair->balls.unit[a];
        square += r * r;
    }
    const long double contact = (long double)pair->radius[0] + pair->radius[1];
    const long double energy = ENERGY_UNITS * powl(contact / sqrtl(square), pair->balls.exponent);
    return energy < ENERGY_MOST ? energy : ENERGY_MOST; // of r = 0, too
}

// In single precision a difference of places is rounded three times, its square seven, the sum
// of them two times more; contact twice, its square five; the ratio once: 15 half-ulps in all, and
// one more in each of the multiplications that raise it to the power n/2.
static double rounding_of(int exponent) {
    return 0x1p-24 * (exponent / 2.0 * 16 + 4);
}

START_TEST(soft_energies_are_those_of_the_twin) {
    const int64_t pairs = pairs_wanted();
    Rng rng = rng_open(KEY, STREAM_PACKING, 3, 0);
    double worst = 0;
    int64_t capped = 0, nothing = 0;
    for (int64_t i = 0; i < pairs; i++) {
        Pair pair;
        const double other = 0.5 + rng_uniform(&rng);
        const int n = 4 + (int)rng_below(&rng, 197);
        set_pair(&pair, (const double[]){60, 45, 40 + 20 * rng_uniform(&rng)}, 1, other);
        pair.balls.exponent = n;
        // From 2^8 kT to 2^-18 kT, in contact, and on top of each other.
        const uint64_t kind = rng_below(&rng, 16);
        const double far = kind == 0   ? 1
                           : kind == 1 ? 1e-7 * rng_uniform(&rng)
                           : kind == 2 ? 0
                                       : exp2((26 * rng_uniform(&rng) - 8) / n);
        double u[3];
        int32_t steps[3];
        uint32_t place[3];
        random_direction(&rng, 3, u);
        steps_to(&pair, u, (1 + other) / 2 * far, steps);
        put(&pair, &rng, steps, place);
        const long double exact = twin_energy(&pair, steps);
        const int32_t found = balls_energy(&pair.balls, 0, place, 1);
        const double off = (double)fabsl(found - exact) - 0.5; // rounded to whole units
        if (off > 0) worst = fmax(worst, off / (double)exact / rounding_of(n));
        ck_assert_msg(off <= (double)exact * rounding_of(n),
                      "pair %lld: n = %d, %d in place of %Lg", (long long)i, n, found, exact);
        capped += found == (int32_t)ENERGY_MOST;
        nothing += found == 0;
    }
    ck_assert_int_gt(capped, pairs / 20);
    ck_assert_int_gt(nothing, pairs / 100);
    printf("soft spheres: %lld pairs, rounding at most %.2g of what is allowed\n", (long long)pairs,
           worst);
}
END_TEST

// The integral of 1 - exp(-U) over the places of the first, by shells; half of it is B2.
static double second_virial(Pair *pair, int dimension, bool soft) {
    enum { SHELLS = 400000 };
    Rng rng = rng_open(KEY, STREAM_PACKING, 4, 0);
    const double furthest = soft ? 1.05 * exp2(17.0 / pair->balls.exponent) : 1.5;
    double sum = 0;
    for (int k = 0; k < SHELLS; k++) {
        const double r = (k + 0.5) / SHELLS * furthest;
        double u[3];
        int32_t steps[3];
        uint32_t place[3];
        random_direction(&rng, dimension, u);
        steps_to(pair, u, r, steps);
        put(pair, &rng, steps, place);
        const double share = soft ? -expm1(-balls_energy(&pair->balls, 0, place, 1) / ENERGY_UNITS)
                                  : balls_overlap(&pair->balls, 0, place, 1);
        sum += share * (dimension == 2 ? 2 * PI * r : 4 * PI * r * r) * furthest / SHELLS;
    }
    return sum / 2;
}

static void check_second_virial(const Body *a, const Body *b) {
    const bool soft = !shape_is_hard(a->shape);
    const int dimension = shape_dimension(a->shape);
    Pair pair;
    set_pair(&pair, (const double[]){40, 50, 60}, a->diameter, b->diameter);
    pair.balls.exponent = soft ? (int)a->exponent : 0;
    const double expected = shape_second_virial(a, b),
                 found = second_virial(&pair, dimension, soft);
    // Half a shell where it ends; of soft ones what is left beyond half an energy unit.
    const double contact = (a->diameter + b->diameter) / 2;
    const double tail =
        soft ? 2 * PI / (a->exponent - 3) * pow(contact, 3) * exp2(-17 * (1 - 3 / a->exponent)) : 0;
    printf("B2 of %s, n = %g: %.7g for %.7g\n", shape_names[a->shape], a->exponent, found,
           expected);
    ck_assert_double_eq_tol(found + tail, expected, 2e-5 * expected);
}

START_TEST(second_virial_coefficients_are_those_of_the_rules) {
    static const double diameters[] = {1, 0.7};
    static const double exponents[] = {12, 15, 36, 100};
    for (int i = 0; i < 2; i++) {
        for (int flat = 0; flat < 2; flat++) {
            const Body one = {.shape = flat ? SHAPE_DISC : SHAPE_SPHERE, .diameter = 1};
            Body other = one;
            other.diameter = diameters[i];
            check_second_virial(&one, &other);
        }
        for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++) {
            const Body one = {.shape = SHAPE_SOFT_SPHERE, .diameter = 1, .exponent = exponents[k]};
            Body other = one;
            other.diameter = diameters[i];
            check_second_virial(&one, &other);
        }
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("ball_rules");
    TCase *cases = tcase_create("rules");
    tcase_set_timeout(cases, 600);
    tcase_add_test(cases, balls_that_just_touch_do_not_overlap_and_a_step_nearer_they_do);
    tcase_add_test(cases, balls_overlap_as_whole_numbers_say);
    tcase_add_test(cases, soft_energies_are_those_of_the_twin);
    tcase_add_test(cases, second_virial_coefficients_are_those_of_the_rules);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
