// SPDX-License-Identifier: GPL-3.0-or-later
// Overlaps of bodies: every degenerate case by hand, random and adversarial pairs against slow
// twins that go another way in long double, second virial coefficients by integration. Long mode:
// PERRIN_SHAPE_PAIRS=1e7 pairs instead of 2e5.
#include "pairs.h"
#include "suite.h"

#include "base/constants.h"
#include "rng/rng.h"
#include "shapes/diffusion.h"
#include "shapes/overlap.h"

#include <check.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const RngKey KEY = {.seed = 11};
static const double X[3] = {1, 0, 0}, Y[3] = {0, 1, 0}, Z[3] = {0, 0, 1}, DOWN[3] = {0, 0, -1};

static const Body ROD = {.shape = SHAPE_SPHEROCYLINDER, .diameter = 1.25, .length = 4};
static const Body SPHERE = {.shape = SHAPE_SPHERE, .diameter = 1.25};
static const Body PLATELET = {.shape = SHAPE_PLATELET, .diameter = 2};

typedef struct Case {
    const double *u, *v;
    double r[3];
    bool overlap;
} Case;

static void check_cases(const Body *a, const Body *b, const Case *cases, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const double *r = cases[i].r, back[3] = {-r[0], -r[1], -r[2]};
        ck_assert_msg(overlap_of(a, cases[i].u, b, cases[i].v, r) == cases[i].overlap, "case %zu",
                      i);
        ck_assert_msg(overlap_of(b, cases[i].v, a, cases[i].u, back) == cases[i].overlap,
                      "case %zu from the other side", i);
    }
}
#define CHECK_CASES(a, b, ...)                                                                     \
    check_cases(a, b, (const Case[]){__VA_ARGS__},                                                 \
                sizeof((const Case[]){__VA_ARGS__}) / sizeof(Case))

START_TEST(rods_that_just_touch_do_not_overlap_and_a_little_nearer_they_do) {
    CHECK_CASES(&ROD, &ROD,                                                    //
                {Z, Z, {1.25, 0, 0}, false}, {Z, Z, {1.249, 0, 0}, true},      // side by side
                {Z, Z, {0, 0, 5.25}, false}, {Z, Z, {0, 0, 5.249}, true},      // collinear
                {Z, Z, {0.75, 0, 5}, false}, {Z, Z, {0.75, 0, 4.999}, true},   // cap on cap
                {Z, X, {0, 1.25, 0}, false}, {Z, X, {0, 1.249, 0}, true},      // crosswise
                {Z, X, {0, 0, 3.25}, false}, {Z, X, {0, 0, 3.249}, true},      // end on a side
                {Z, X, {2.75, 0, 3}, false}, {Z, X, {2.75, 0, 2.999}, true},   // end on end
                {Z, X, {0.5, 0.5, 0.5}, true}, {Z, Z, {0, 0, 0}, true},        // through, same
                {Z, DOWN, {1.25, 0, 0}, false}, {Z, DOWN, {0.5, 1, 3}, true}); // antiparallel
}
END_TEST

START_TEST(a_sphere_meets_a_rod_as_a_point_does_a_segment) {
    CHECK_CASES(&ROD, &SPHERE, {Z, X, {1.25, 0, 1}, false}, {Z, X, {1.249, 0, -1}, true}, //
                {Z, Y, {0, 0, 3.25}, false}, {Z, Z, {0, 0, 3.249}, true},                 //
                {Z, Z, {0, 1, 2.75}, false}, {Z, Z, {0, 1, 2.749}, true},                 //
                {Z, Z, {0, 0, 1}, true});
}
END_TEST

START_TEST(a_rod_without_length_is_a_sphere) {
    const Body ball = {.shape = SHAPE_SPHEROCYLINDER, .diameter = 1.25};
    CHECK_CASES(&ball, &SPHERE, {Z, X, {1.25, 0, 0}, false}, {Z, Z, {0, 0.75, 0.999}, true});
    CHECK_CASES(&ball, &ball, {Z, Z, {0, 0.75, 1}, false}, {Z, X, {0, 0.75, 0.999}, true});
    CHECK_CASES(&ball, &ROD, {Z, Z, {0, 0, 3.25}, false}, {X, Z, {0, 0, 3.249}, true});
}
END_TEST

START_TEST(platelets_overlap_where_their_chords_do) {
    const double tilted[3] = {0.6, 0, 0.8};
    CHECK_CASES(&PLATELET, &PLATELET,                                            //
                {Z, Z, {0, 0, 1e-300}, false}, {Z, Z, {0.1, 0.1, 0.1}, false},   // parallel
                {Z, Z, {2, 0, 0}, false}, {Z, Z, {1.999, 0, 0}, true},           // in one plane
                {Z, Z, {0, 0, 0}, true}, {tilted, tilted, {0, 1.9, 0}, true},    //
                {Z, X, {0, 0, 0}, true}, {Z, X, {0, 0, 1}, false},               // crosswise
                {Z, X, {0.999, 0, 0}, true}, {Z, X, {1, 0, 0}, false},           // rim on middle
                {Z, X, {0, 2, 0}, false}, {Z, X, {0, 1.999, 0}, true},           // along the line
                {Z, X, {0.6, 1.8, 0}, false}, {Z, X, {0.6, 1.799, 0}, true},     // 0.8 + 1
                {Z, X, {0.6, 1.4, 0.8}, false}, {Z, X, {0.6, 1.399, 0.8}, true}, // 0.8 + 0.6
                {Z, tilted, {0, 0, 0.599}, true}, {Z, tilted, {0, 0, 0.601}, false});
}
END_TEST

START_TEST(a_sphere_meets_a_platelet_as_a_ball_does_a_disc) {
    CHECK_CASES(&PLATELET, &SPHERE, {Z, X, {0.9, 0, 0.625}, false}, {Z, X, {0.9, 0, 0.624}, true},
                {Z, X, {1.625, 0, 0}, false}, {Z, X, {0, 1.624, 0}, true},
                {Z, X, {1.375, 0, 0.5}, false}, {Z, X, {1.375, 0, 0.499}, true});
}
END_TEST

START_TEST(pairs_that_nobody_knows_are_said_to_be_so) {
    ck_assert(overlap_is_known(SHAPE_SPHERE, SHAPE_SPHEROCYLINDER));
    ck_assert(overlap_is_known(SHAPE_PLATELET, SHAPE_SPHERE));
    ck_assert(!overlap_is_known(SHAPE_PLATELET, SHAPE_SPHEROCYLINDER));
    ck_assert(!overlap_is_known(SHAPE_SPHERE, SHAPE_SOFT_SPHERE));
    ck_assert(!overlap_is_known(SHAPE_DISC, SHAPE_DISC));
}
END_TEST

// The twins.

typedef long double Real;

static Real dot(const Real a[3], const Real b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const Real a[3], const Real b[3], Real out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static Real within(Real x, Real bound) {
    return x < -bound ? -bound : x > bound ? bound : x;
}

// Of the points s u and r + t v.
static Real separation2(const Real r[3], const Real u[3], Real s, const Real v[3], Real t) {
    Real sum = 0;
    for (int a = 0; a < 3; a++) {
        const Real x = r[a] + t * v[a] - s * u[a];
        sum += x * x;
    }
    return sum;
}

// The minimum of a convex function over a rectangle lies inside or on an edge: all five are tried.
static Real twin_distance2(const Real r[3], const Real u[3], Real half_u, const Real v[3],
                           Real half_v) {
    const Real ru = dot(r, u), rv = dot(r, v), uv = dot(u, v);
    Real w[3];
    cross(u, v, w);
    Real best = INFINITY;
    for (int sign = -1; sign <= 1; sign += 2) {
        const Real s = sign * half_u, t = sign * half_v;
        best = fminl(best, separation2(r, u, s, v, within(s * uv - rv, half_v)));
        best = fminl(best, separation2(r, u, within(t * uv + ru, half_u), v, t));
    }
    const Real sine2 = dot(w, w);
    if (sine2 < 1e-36L) return best;
    const Real s = (ru - uv * rv) / sine2, t = (uv * ru - rv) / sine2;
    if (fabsl(s) < half_u && fabsl(t) < half_v) best = fminl(best, separation2(r, u, s, v, t));
    return best;
}

// Nor is that one trusted: the nearest point of v to each of u, searched by thirds.
static Real searched_distance2(const Real r[3], const Real u[3], Real half_u, const Real v[3],
                               Real half_v) {
    const Real rv = dot(r, v), uv = dot(u, v);
    Real low = -half_u, high = half_u;
    for (int i = 0; i < 120; i++) {
        const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
        const Real at_a = separation2(r, u, a, v, within(a * uv - rv, half_v));
        const Real at_b = separation2(r, u, b, v, within(b * uv - rv, half_v));
        if (at_a < at_b)
            high = b;
        else
            low = a;
    }
    return separation2(r, u, low, v, within(low * uv - rv, half_v));
}

// Does either end of the chord that disc (r, v) cuts from the plane of disc (0, u) lie within disc
// (0, u)? The slack is how far the rounding of what is given may grow
// before the answer changes, relative.
static bool an_end_is_inside(const Real r[3], const Real u[3], Real radius_u, const Real v[3],
                             Real radius_v, Real *slack) {
    Real w[3], slope[3]; // along the line; within the plane of v, straight towards that of u
    cross(u, v, w);
    cross(v, w, slope);
    const Real sine = sqrtl(dot(w, w));
    for (int a = 0; a < 3; a++) slope[a] /= sine, w[a] /= sine;
    const Real foot = -dot(r, u) / sine;
    const Real half2 = radius_v * radius_v - foot * foot;
    *slack = fminl(*slack, fabsl(half2) / (radius_v * radius_v));
    if (half2 <= 0) return false;
    bool inside = false;
    for (int sign = -1; sign <= 1; sign += 2) {
        Real end[3];
        for (int a = 0; a < 3; a++) {
            end[a] = r[a] + foot * slope[a] + sign * sqrtl(half2) * w[a];
        }
        const Real beyond = dot(end, end) / (radius_u * radius_u) - 1;
        *slack = fminl(*slack, fabsl(beyond) * sqrtl(half2) / radius_v);
        inside |= dot(end, end) < radius_u * radius_u;
    }
    return inside;
}

// Two chords of a line overlap if an end of one is inside the other.
static bool twin_platelets(const Real r[3], const Real u[3], Real radius_u, const Real v[3],
                           Real radius_v, Real *slack) {
    const Real back[3] = {-r[0], -r[1], -r[2]};
    *slack = INFINITY;
    const bool first = an_end_is_inside(r, u, radius_u, v, radius_v, slack);
    const bool second = an_end_is_inside(back, v, radius_v, u, radius_u, slack);
    return first || second;
}

// The pairs.

typedef struct Pair {
    double r[3], u[3], v[3], length_u, length_v;
} Pair;

static void normalise(double u[3]) {
    const double length = sqrt(vector_dot(u, u));
    for (int a = 0; a < 3; a++) u[a] /= length;
}

static double random_length(Rng *rng) {
    static const double lengths[] = {0, 1e-6, 0.3, 1, 5, 20};
    return lengths[rng_below(rng, 6)];
}

// Axes at any angle down to 1e-17 and to a right angle, on axes of the box every now and then; the
// second centre near the first segment's side, its end, its line, or anywhere.
static Pair random_pair(Rng *rng) {
    Pair pair = {.length_u = random_length(rng), .length_v = random_length(rng)};
    double turn[3], aside[3];
    random_direction(rng, 3, pair.u);
    random_direction(rng, 3, turn);
    random_direction(rng, 3, aside);
    if (rng_below(rng, 8) == 0) memcpy(pair.u, Z, sizeof Z);
    const double angle = rng_below(rng, 3) == 0 ? pow(10, -17 * rng_uniform(rng)) : 3;
    for (int a = 0; a < 3; a++) pair.v[a] = pair.u[a] + angle * turn[a];
    normalise(pair.v);
    if (rng_below(rng, 4) == 0) {
        for (int a = 0; a < 3; a++) pair.v[a] = -pair.v[a];
    }
    const double reach = (pair.length_u + pair.length_v) / 2;
    const double along = rng_below(rng, 2) ? reach : reach * (2 * rng_uniform(rng) - 1);
    const double across = rng_below(rng, 4) ? 1 : 2 * rng_uniform(rng) * (1 + reach);
    for (int a = 0; a < 3; a++) pair.r[a] = along * pair.u[a] + across * aside[a];
    return pair;
}

static void widen(const double from[3], Real to[3]) {
    for (int a = 0; a < 3; a++) to[a] = from[a];
}

// A double has 53 bits of the largest length of a pair; this many of them may be lost.
static const double ROUNDING = 20 * 0x1p-53;

START_TEST(distances_of_segments_are_those_of_the_twin) {
    Rng rng = rng_open(KEY, STREAM_PACKING, 1, 0);
    const int64_t pairs = pairs_wanted();
    double worst = 0;
    for (int64_t i = 0; i < pairs; i++) {
        const Pair pair = random_pair(&rng);
        Real r[3], u[3], v[3];
        widen(pair.r, r), widen(pair.u, u), widen(pair.v, v);
        const double scale = pair.length_u + pair.length_v + 1;
        const double found = sqrt(
            spherocylinder_distance2(pair.r, pair.u, pair.length_u / 2, pair.v, pair.length_v / 2));
        const Real exact = sqrtl(twin_distance2(r, u, pair.length_u / 2, v, pair.length_v / 2));
        worst = fmax(worst, (double)fabsl(found - exact) / scale);
        ck_assert_double_le(worst, ROUNDING);
        if (i % 100 == 0) {
            const Real searched = searched_distance2(r, u, pair.length_u / 2, v, pair.length_v / 2);
            ck_assert_double_le((double)fabsl(searched - exact * exact), 1e-15 * scale * scale);
        }
    }
    printf("segments: %lld pairs, distances to %.2g of the lengths\n", (long long)pairs, worst);
}
END_TEST

START_TEST(platelets_overlap_as_those_of_the_twin) {
    Rng rng = rng_open(KEY, STREAM_PACKING, 2, 0);
    const int64_t pairs = pairs_wanted();
    int64_t close = 0, overlapping = 0;
    for (int64_t i = 0; i < pairs; i++) {
        Pair pair = random_pair(&rng);
        double w[3];
        vector_cross(pair.u, pair.v, w);
        const double sine = sqrt(vector_dot(w, w));
        if (sine < 1e-10) continue; // where the rounding of the axes themselves decides
        const double radius_u = 0.5, radius_v = rng_below(&rng, 2) ? 0.5 : 0.2;
        double aside[3]; // near enough to meet: within the slab between the planes
        random_direction(&rng, 3, aside);
        const double height = sine * (2 * rng_uniform(&rng) - 1);
        for (int a = 0; a < 3; a++) {
            pair.r[a] = aside[a] - vector_dot(aside, pair.u) * pair.u[a] + height * pair.u[a] / 2;
        }
        Real r[3], u[3], v[3], slack;
        widen(pair.r, r), widen(pair.u, u), widen(pair.v, v);
        const bool exact = twin_platelets(r, u, radius_u, v, radius_v, &slack);
        const bool found = platelet_overlap(radius_u, pair.u, radius_v, pair.v, pair.r);
        overlapping += found;
        if (slack < 1e-13 / sine)
            close++;
        else
            ck_assert_msg(found == exact, "pair %lld", (long long)i);
    }
    ck_assert_int_gt(overlapping, pairs / 10);
    ck_assert_int_lt(close, pairs / 100);
    printf("platelets: %lld pairs, %lld overlap, %lld too close to call\n", (long long)pairs,
           (long long)overlapping, (long long)close);
}
END_TEST

// A ball meets a disc if the circle that it cuts from the disc's plane does; u of length 1 but for
// the rounding. The slack is how far rounding may move the ball before the answer changes.
static bool twin_sphere_meets(const Real r[3], const Real u[3], Real disc, Real ball, Real *slack) {
    Real aside[3];
    cross(r, u, aside);
    const Real height = fabsl(dot(r, u));
    *slack = fabsl(ball - height);
    if (height >= ball) return false;
    const Real gap = sqrtl(dot(aside, aside)) - disc - sqrtl(ball * ball - height * height);
    *slack = fminl(*slack, fabsl(gap));
    return gap < 0;
}

START_TEST(spheres_meet_platelets_as_those_of_the_twin) {
    Rng rng = rng_open(KEY, STREAM_PACKING, 5, 0);
    const int64_t pairs = pairs_wanted();
    int64_t close = 0, overlapping = 0;
    for (int64_t i = 0; i < pairs; i++) {
        const Body disc = {.shape = SHAPE_PLATELET, .diameter = 1};
        const Body ball = {.shape = SHAPE_SPHERE, .diameter = rng_below(&rng, 2) ? 1 : 0.1};
        const double reach = ball.diameter / 2;
        double normal[3], aside[3], turn[3], r[3];
        random_direction(&rng, 3, normal);
        if (rng_below(&rng, 8) == 0) memcpy(normal, Z, sizeof Z);
        random_direction(&rng, 3, turn);
        vector_cross(normal, turn, aside);
        normalise(aside);
        // Touching the flat side, the rim from aside, from above, or anywhere; then a little off.
        const uint64_t kind = rng_below(&rng, 4);
        const double tilt = kind == 1 ? 0 : rng_uniform(&rng) * PI / 2;
        const double high = kind == 0 ? reach : reach * sin(tilt);
        const double out = kind == 0 ? rng_uniform(&rng) / 2 : 0.5 + reach * cos(tilt);
        const double off = kind == 3 ? 2 * rng_uniform(&rng) : 1 + 1e-12 * rng_normal(&rng);
        for (int a = 0; a < 3; a++) r[a] = off * (high * normal[a] + out * aside[a]);
        Real wide_r[3], wide_u[3], slack;
        widen(r, wide_r), widen(normal, wide_u);
        const bool exact = twin_sphere_meets(wide_r, wide_u, 0.5L, reach, &slack);
        const bool found = overlap_of(&disc, normal, &ball, X, r);
        ck_assert(overlap_of(&ball, X, &disc, normal, (double[]){-r[0], -r[1], -r[2]}) == found);
        overlapping += found;
        if (slack < 2e-15L)
            close++;
        else
            ck_assert_msg(found == exact, "pair %lld: slack %Lg", (long long)i, slack);
    }
    ck_assert_int_gt(overlapping, pairs / 4);
    ck_assert_int_lt(close, pairs / 100);
    printf("spheres and platelets: %lld pairs, %lld overlap, %lld too close to call\n",
           (long long)pairs, (long long)overlapping, (long long)close);
}
END_TEST

START_TEST(axes_may_be_turned_round) {
    Rng rng = rng_open(KEY, STREAM_PACKING, 3, 0);
    for (int i = 0; i < 20000; i++) {
        const Pair pair = random_pair(&rng);
        const double back[3] = {-pair.v[0], -pair.v[1], -pair.v[2]};
        ck_assert(platelet_overlap(1, pair.u, 1, pair.v, pair.r) ==
                  platelet_overlap(1, pair.u, 1, back, pair.r));
        const double distance2 = spherocylinder_distance2(pair.r, pair.u, 2, pair.v, 3);
        ck_assert_double_eq_tol(spherocylinder_distance2(pair.r, pair.u, 2, back, 3), distance2,
                                36 * ROUNDING);
    }
}
END_TEST

// Half the excluded volume: the share of a ball of centres, of all orientations, that overlaps.
static void check_second_virial(const Body *a, const Body *b) {
    Rng rng = rng_open(KEY, STREAM_PACKING, 4, 0);
    const double reach = (shape_reach(a) + shape_reach(b)) / 2;
    const double around = 1.1 * reach;
    const double ball = 4 * PI / 3 * around * around * around;
    const int pairs = 1000000;
    int overlapping = 0;
    for (int i = 0; i < pairs; i++) {
        double u[3], v[3], r[3];
        random_direction(&rng, 3, u);
        random_direction(&rng, 3, v);
        random_direction(&rng, 3, r);
        const double distance = around * cbrt(rng_uniform(&rng));
        for (int c = 0; c < 3; c++) r[c] *= distance;
        overlapping += overlap_of(a, u, b, v, r);
    }
    const double share = (double)overlapping / pairs;
    const double sigma = ball / 2 * sqrt(share * (1 - share) / pairs);
    ck_assert_double_eq_tol(ball / 2 * share, shape_second_virial(a, b), 4 * sigma);
}

START_TEST(second_virial_coefficients_are_half_the_excluded_volumes) {
    const Body small = {.shape = SHAPE_SPHERE, .diameter = 0.5};
    const Body short_rod = {.shape = SHAPE_SPHEROCYLINDER, .diameter = 0.7, .length = 1};
    const Body small_platelet = {.shape = SHAPE_PLATELET, .diameter = 1};
    check_second_virial(&ROD, &ROD);
    check_second_virial(&ROD, &short_rod);
    check_second_virial(&ROD, &small);
    check_second_virial(&SPHERE, &SPHERE);
    check_second_virial(&PLATELET, &PLATELET);
    check_second_virial(&PLATELET, &small_platelet);
    check_second_virial(&PLATELET, &small);
}
END_TEST

// (power + 1) times the integral of x^power ln h(x), h = (1 - x^16)^(1/16), by the midpoint rule:
// the logarithm at the end costs it 4e-7.
static double mean_log_of_radius(int power) {
    enum { POINTS = 100000 };
    double sum = 0;
    for (int i = 0; i < POINTS; i++) {
        const double x = (i + 0.5) / POINTS;
        sum += (power + 1) * pow(x, power) * log1p(-pow(x, 16)) / 16 / POINTS;
    }
    return sum;
}

// Garcia Daza et al., eqs 30-32; L = 5 in their table 1, to its four digits.
START_TEST(rods_diffuse_as_slender_bodies) {
    for (int length = 2; length <= 50; length += 3) {
        const Body rod = {.shape = SHAPE_SPHEROCYLINDER, .diameter = 2, .length = 2 * length};
        const double whole = 2 * (length + 1), slender = log(4 * whole / 2);
        const double translation = slender - mean_log_of_radius(0);
        const double rotation = slender - mean_log_of_radius(2);
        const Diffusion found = shape_diffusion(&rod);
        ck_assert_double_eq_tol(found.parallel * 2 * PI * whole, translation - 1.5, 1e-6);
        ck_assert_double_eq_tol(found.perpendicular * 4 * PI * whole, translation - 0.5, 1e-6);
        ck_assert_double_eq_tol(found.rotational * PI * pow(whole, 3), 3 * (rotation - 11.0 / 6),
                                1e-5);
    }
    const Body known = {.shape = SHAPE_SPHEROCYLINDER, .diameter = 1, .length = 5};
    const Diffusion found = shape_diffusion(&known);
    ck_assert_double_eq_tol(found.parallel, 0.04467, 5e-6);
    ck_assert_double_eq_tol(found.perpendicular, 0.03560, 5e-6);
    ck_assert_double_eq_tol(found.rotational, 0.006020, 5e-7);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("shapes");
    TCase *cases = tcase_create("overlap");
    tcase_set_timeout(cases, 600);
    tcase_add_test(cases, rods_that_just_touch_do_not_overlap_and_a_little_nearer_they_do);
    tcase_add_test(cases, a_sphere_meets_a_rod_as_a_point_does_a_segment);
    tcase_add_test(cases, a_rod_without_length_is_a_sphere);
    tcase_add_test(cases, platelets_overlap_where_their_chords_do);
    tcase_add_test(cases, a_sphere_meets_a_platelet_as_a_ball_does_a_disc);
    tcase_add_test(cases, pairs_that_nobody_knows_are_said_to_be_so);
    tcase_add_test(cases, distances_of_segments_are_those_of_the_twin);
    tcase_add_test(cases, platelets_overlap_as_those_of_the_twin);
    tcase_add_test(cases, spheres_meet_platelets_as_those_of_the_twin);
    tcase_add_test(cases, axes_may_be_turned_round);
    tcase_add_test(cases, second_virial_coefficients_are_half_the_excluded_volumes);
    tcase_add_test(cases, rods_diffuse_as_slender_bodies);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
