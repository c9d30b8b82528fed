// SPDX-License-Identifier: GPL-3.0-or-later
// A first look at a trial, by the coarse places of all neighbours at once: with the stated bounds
// of their error it accepts or rejects nearly all trials, as the exact rules would, and leaves the
// rest open. The first entry of a list is the particle's own anchor: only within its leash is the
// list known to be whole.
#pragma once

#include "dmc/balls_lanes.h"

// If neither, the trial is open.
typedef struct Verdict {
    bool accepted, rejected;
} Verdict;

#if defined(__AVX2__)

// What all trials are looked at with.
typedef struct Glass {
    const uint64_t *coarse;
    Whole plus, minus;           // scales of rows, unless all are alike
    Whole maybe, surely;         // bounds of neighbours that may overlap, that do
    Whole leashed, never_anchor; // the same where the first is the anchor
    int exponent;
    Real contact2, flat; // squared, in coarse steps; the energy that is not exceeded, in kT
    float doubt;         // error of an energy relative to it
    float off;           // error of the sum of all, absolute, in kT
} Glass;

KERNEL Glass glass_of(const bool alike, const Balls *balls) {
    const uint64_t scale = balls_coarse_scales(balls);
    const Whole maybe = all(alike ? (int32_t)balls->below : balls->doubt);
    const Whole surely = all(alike ? (int32_t)balls->sure : -balls->doubt);
    return (Glass){
        .coarse = balls->coarse,
        .plus = all_rows(scale | 24576ull << 48),
        .minus = all_rows(scale | (65536ull - 24576) << 48),
        .maybe = maybe,
        .surely = surely,
        .leashed = first_and((int32_t)balls->leashed, maybe),
        .never_anchor = first_and(alike ? 0 : INT32_MIN, surely),
        .exponent = balls->exponent,
        .contact2 = all_real(balls->coarse_contact2),
        .flat = all_real((float)(ENERGY_MOST / ENERGY_UNITS)),
        .doubt = balls->energy_doubt,
        .off = (float)(2 * balls->room / ENERGY_UNITS),
    };
}

// As many rows as there are lanes, in two registers.
typedef struct Rows {
    Whole low, high;
} Rows;

KERNEL Rows rows_of(const Glass *glass, const uint32_t *ids) {
    return (Rows){half_of_rows(glass->coarse, ids), half_of_rows(glass->coarse, ids + LANES / 2)};
}

KERNEL Rows from(Whole place, Rows rows) {
    return (Rows){words_less(place, rows.low), words_less(place, rows.high)};
}

KERNEL Rows scaled(Rows rows, Whole scale) {
    return (Rows){words_scaled(rows.low, scale), words_scaled(rows.high, scale)};
}

KERNEL Whole sums_of_products(Rows a, Rows b) {
    const Whole low = products(a.low, b.low), high = products(a.high, b.high);
    return sums(first_of_pairs(low, high), second_of_pairs(low, high));
}

// Squares of coarse distances; unless all are alike, of scaled ones less those of contact.
KERNEL Whole apart(const bool alike, const Glass *glass, Whole place, Rows rows) {
    const Rows r = from(place, rows);
    if (alike) return sums_of_products(r, r);
    return sums_of_products(scaled(r, glass->plus), scaled(r, glass->minus));
}

enum { HARD_ENTRIES = 16, SOFT_ENTRIES = 32 }; // that lists are meant to have at most

// The first rows of a list.
typedef struct Seen {
    Rows rows[SOFT_ENTRIES / LANES];
} Seen;

KERNEL Seen seen_in(const Glass *glass, const uint32_t *list, uint32_t entries) {
    Seen seen;
    for (uint32_t k = 0; k < entries / LANES; k++) seen.rows[k] = rows_of(glass, list + k * LANES);
    return seen;
}

// The same when i has moved.
KERNEL Seen seen_after(Seen seen, const uint32_t *list, uint32_t entries, uint32_t i,
                       uint64_t row) {
    const Whole rows = all_rows(row);
    for (uint32_t k = 0; k < entries / LANES; k++) {
        const uint32_t *ids = list + k * LANES;
        seen.rows[k].low = half_with(seen.rows[k].low, ids, i, rows);
        seen.rows[k].high = half_with(seen.rows[k].high, ids + LANES / 2, i, rows);
    }
    return seen;
}

// Adds what further neighbours tell.
KERNEL void look_on(const bool alike, const Glass *glass, Whole place, Rows rows, unsigned *near,
                    unsigned *overlap) {
    const Whole next = apart(alike, glass, place, rows);
    *near |= below(!alike, next, glass->maybe);
    *overlap |= below(!alike, next, glass->surely);
}

KERNEL Verdict look_for_overlaps(const bool alike, const Glass *glass, __m128i to, const Seen *seen,
                                 const uint32_t *list, uint32_t entries) {
    const Whole place = all_rows_low(to);
    const Whole first = apart(alike, glass, place, seen->rows[0]);
    unsigned near = below(!alike, first, glass->leashed) ^ 1,
             overlap = below(!alike, first, glass->never_anchor);
    for (uint32_t k = 1; k < HARD_ENTRIES / LANES; k++) {
        look_on(alike, glass, place, seen->rows[k], &near, &overlap);
    }
    for (uint32_t n = HARD_ENTRIES; __builtin_expect(n < entries, 0); n += LANES) {
        look_on(alike, glass, place, rows_of(glass, list + n), &near, &overlap);
    }
    return (Verdict){near == 0, overlap != 0};
}

enum { ENDS = 4 }; // before and after, of twice as many neighbours as there are lanes

// (contact/r)^n, no more than flat, in kT, of squares of coarse distances.
KERNEL void energies(const Glass *glass, Real of[ENDS]) {
    Real power[ENDS];
    int n = glass->exponent / 2;
    for (int k = 0; k < ENDS; k++) of[k] = inverse(of[k]) * glass->contact2;
    if (glass->exponent & 1) {
        for (int k = 0; k < ENDS; k++) power[k] = roots(of[k]);
    } else {
        for (; !(n & 1); n /= 2) {
            for (int k = 0; k < ENDS; k++) of[k] *= of[k];
        }
        for (int k = 0; k < ENDS; k++) power[k] = of[k];
        n--;
    }
    for (n /= 2; n > 0; n /= 2) {
        for (int k = 0; k < ENDS; k++) of[k] *= of[k];
        for (int k = 0; k < ENDS && n & 1; k++) power[k] *= of[k];
    }
    for (int k = 0; k < ENDS; k++) of[k] = least(power[k], glass->flat);
}

KERNEL Verdict look_at_energies(const Glass *glass, uint64_t from_row, __m128i to, const Seen *seen,
                                const uint32_t *list, uint32_t entries, int32_t affordable) {
    const Whole here = all_rows(from_row), there = all_rows_low(to);
    Real before = all_real(0), after = all_real(0);
    bool leashed = false;
    for (uint32_t n = 0; __builtin_expect(n < entries, n == 0); n += 2 * LANES) {
        Real of[ENDS];
        for (uint32_t k = 0; k < 2; k++) {
            const Rows rows =
                n < SOFT_ENTRIES ? seen->rows[n / LANES + k] : rows_of(glass, list + n + k * LANES);
            const Whole end = apart(true, glass, there, rows);
            of[2 * k] = reals(apart(true, glass, here, rows));
            of[2 * k + 1] = reals(end);
            if (n == 0 && k == 0) leashed = below(false, end, glass->leashed) & 1;
        }
        energies(glass, of);
        for (uint32_t k = 0; k < 2; k++) {
            before = plus_neighbours(before, of[2 * k], n + k * LANES, entries);
            after = plus_neighbours(after, of[2 * k + 1], n + k * LANES, entries);
        }
    }
    float sum[2];
    two_sums(before, after, sum);
    const float afforded = (float)affordable * (float)(1 / ENERGY_UNITS);
    const float rise = sum[1] - sum[0], off = (sum[0] + sum[1]) * glass->doubt + glass->off;
    return (Verdict){leashed & (rise + off <= afforded), rise - off > afforded};
}

#endif
