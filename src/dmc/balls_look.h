// SPDX-License-Identifier: GPL-3.0-or-later
// A first look at a trial, by the coarse places of all neighbours at once: with the stated bounds
// of their error it accepts or rejects nearly all trials, as the exact rules would, and leaves the
// rest open. The first entry of a list is the particle's own anchor: only within its leash is the
// list known to be whole.
#pragma once

#include "dmc/balls_lanes.h"

#include <math.h>

// If neither, the trial is open.
typedef struct Verdict {
    bool accepted, rejected;
} Verdict;

#if defined(__AVX2__)

// As many rows as there are lanes, in two registers.
typedef struct Rows {
    Whole low, high;
} Rows;

// The same in other order: the first two words of all rows, and their last two.
typedef struct Split {
    Whole first, second;
} Split;

KERNEL Split split_place(Whole row) {
    return (Split){first_of_pairs(row, row), second_of_pairs(row, row)};
}

KERNEL Split split_rows(Rows rows) {
    return (Split){first_of_pairs(rows.low, rows.high), second_of_pairs(rows.low, rows.high)};
}

// What all trials are looked at with.
typedef struct Glass {
    const uint64_t *coarse;
    Whole plus, minus;           // scales of rows
    Split split_scale;           // the same of those that are split
    Whole maybe, surely;         // bounds of neighbours that may overlap, that do
    Whole leashed, never_anchor; // the same where the first is the anchor
    int exponent;
    const float *radius; // of particles, in d
    float steps2;        // (coarse steps per d)^2
    Real flat;           // the energy that is not exceeded, in kT
    float doubt;         // error of an energy relative to it
    float off;           // error of the sum of all, absolute, in kT
} Glass;

// exp(x) - 1 < x (1 + x)
KERNEL float energy_doubt(const Balls *balls) {
    const double off = balls->energy_off + balls->exponent * 0.5 * (double)INVERSE_OFF;
    return off < 1 ? (float)(off * (1 + off)) : INFINITY;
}

KERNEL Glass glass_of(const bool unscaled, const Balls *balls) {
    const uint64_t scale = balls_coarse_scales(balls);
    const Whole maybe = all(unscaled ? (int32_t)balls->below : balls->doubt);
    const Whole surely = all(unscaled ? (int32_t)balls->sure : -balls->doubt);
    return (Glass){
        .coarse = balls->coarse,
        .plus = all_rows(scale | 24576ull << 48),
        .minus = all_rows(scale | (65536ull - 24576) << 48),
        .split_scale = split_place(all_rows(scale)),
        .maybe = maybe,
        .surely = surely,
        .leashed = first_and((int32_t)balls->leashed, maybe),
        .never_anchor = first_and(unscaled ? 0 : INT32_MIN, surely),
        .exponent = balls->exponent,
        .radius = balls->radius_single,
        .steps2 = balls->coarse_steps2,
        .flat = all_real((float)(ENERGY_MOST / ENERGY_UNITS)),
        .doubt = energy_doubt(balls),
        .off = (float)(2 * balls->room / ENERGY_UNITS),
    };
}

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

// Squares of coarse distances; of scaled ones among hard balls less those of contact.
KERNEL Whole apart(const bool unscaled, const Glass *glass, Whole place, Rows rows) {
    const Rows r = from(place, rows);
    if (unscaled) return sums_of_products(r, r);
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

// Is i among them?
KERNEL bool is_seen(const uint32_t *list, uint32_t entries, uint32_t i) {
    unsigned same = 0;
    for (uint32_t k = 0; k < entries; k += LANES) same |= ids_equal(list + k, i);
    return same != 0;
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
KERNEL void look_on(const bool unscaled, const Glass *glass, Whole place, Rows rows, unsigned *near,
                    unsigned *overlap) {
    const Whole next = apart(unscaled, glass, place, rows);
    *near |= below(!unscaled, next, glass->maybe);
    *overlap |= below(!unscaled, next, glass->surely);
}

KERNEL Verdict look_for_overlaps(const bool unscaled, const Glass *glass, __m128i to,
                                 const Seen *seen, const uint32_t *list, uint32_t entries) {
    const Whole place = all_rows_low(to);
    const Whole first = apart(unscaled, glass, place, seen->rows[0]);
    unsigned near = below(!unscaled, first, glass->leashed) ^ 1,
             overlap = below(!unscaled, first, glass->never_anchor);
    for (uint32_t k = 1; k < HARD_ENTRIES / LANES; k++) {
        look_on(unscaled, glass, place, seen->rows[k], &near, &overlap);
    }
    for (uint32_t n = HARD_ENTRIES; __builtin_expect(n < entries, 0); n += LANES) {
        look_on(unscaled, glass, place, rows_of(glass, list + n), &near, &overlap);
    }
    return (Verdict){near == 0, overlap != 0};
}

// Squares of the coarse contacts of i with those of the list from n on.
KERNEL Real contacts2(const bool one_size, const Glass *glass, uint32_t i, const uint32_t *list,
                      uint32_t n) {
    const Real own = all_real(glass->radius[i]);
    const Real contact = own + (one_size ? own : reals_of(glass->radius, list + n));
    return contact * contact * all_real(glass->steps2);
}

// Before and after, of twice as many neighbours as there are lanes.
enum { ENDS = 4 };

// (contact/r)^n, no more than flat, in kT, of squares of coarse distances.
KERNEL void energies(const Glass *glass, const Real contact2[ENDS / 2], Real of[ENDS]) {
    Real power[ENDS];
    int n = glass->exponent / 2;
    for (int k = 0; k < ENDS; k++) of[k] = inverse(of[k]) * contact2[k / 2];
    if (glass->exponent & 1) {
        for (int k = 0; k < ENDS; k++) power[k] = roots(of[k]);
        for (int k = 0; k < ENDS && n & 1; k++) power[k] *= of[k];
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

// Squares of coarse distances: rows that are split serve both ends of a move.
KERNEL Whole split_apart(const bool unscaled, const Glass *glass, Split place, Split rows) {
    Whole first = words_less(place.first, rows.first),
          second = words_less(place.second, rows.second);
    if (unscaled) return sums(products(first, first), products(second, second));
    first = words_scaled(first, glass->split_scale.first);
    second = words_scaled(second, glass->split_scale.second);
    return sums(products(first, first), products(second, second));
}

// What a soft ball feels at both ends of its move.
typedef struct Feeling {
    uint32_t i, entries;
    const uint32_t *list;
    Split here, there;
    Real before, after; // sums of energies, in lanes
    bool leashed;
} Feeling;

// Adds the entries of the list from n on, of which there are two registers.
KERNEL void feel(const bool unscaled, const bool one_size, const Glass *glass, uint32_t n,
                 const Rows rows[2], Feeling *felt) {
    Real of[ENDS], contact2[ENDS / 2];
    for (uint32_t k = 0; k < 2; k++) {
        const Split split = split_rows(rows[k]);
        const Whole end = split_apart(unscaled, glass, felt->there, split);
        contact2[k] = contacts2(one_size, glass, felt->i, felt->list, n + k * LANES);
        of[2 * k] = reals(split_apart(unscaled, glass, felt->here, split));
        of[2 * k + 1] = reals(end);
        if (n == 0 && k == 0) felt->leashed = below(false, end, glass->leashed) & 1;
    }
    energies(glass, contact2, of);
    for (uint32_t k = 0; k < 2; k++) {
        felt->before = plus_neighbours(felt->before, of[2 * k], n + k * LANES, felt->entries);
        felt->after = plus_neighbours(felt->after, of[2 * k + 1], n + k * LANES, felt->entries);
    }
}

KERNEL Verdict look_at_energies(const bool unscaled, const bool one_size, const Glass *glass,
                                uint32_t i, __m128i to, const Seen *seen, const uint32_t *list,
                                uint32_t entries, int32_t affordable) {
    Feeling felt = {.i = i,
                    .entries = entries,
                    .list = list,
                    .here = split_place(all_rows(glass->coarse[i])),
                    .there = split_place(all_rows_low(to)),
                    .before = all_real(0),
                    .after = all_real(0)};
    for (uint32_t n = 0; n < SOFT_ENTRIES; n += 2 * LANES) {
        feel(unscaled, one_size, glass, n, seen->rows + n / LANES, &felt);
    }
    for (uint32_t n = SOFT_ENTRIES; __builtin_expect(n < entries, 0); n += 2 * LANES) {
        const Rows rows[2] = {rows_of(glass, list + n), rows_of(glass, list + n + LANES)};
        feel(unscaled, one_size, glass, n, rows, &felt);
    }
    float sum[2];
    two_sums(felt.before, felt.after, sum);
    const float afforded = (float)affordable * (float)(1 / ENERGY_UNITS);
    const float rise = sum[1] - sum[0], off = (sum[0] + sum[1]) * glass->doubt + glass->off;
    return (Verdict){felt.leashed & (rise + off <= afforded), rise - off > afforded};
}

#endif
