// SPDX-License-Identifier: GPL-3.0-or-later
// Proposals of the chain of bodies: what is drawn for a trial, and what it makes of a body.
//
// Trial k takes eight words, number k mod 512 of each part of block k/512; normal numbers, where
// asked for, are those of particles 2 (k mod 512) and the next at step k/512. Only + - * / sqrt and
// rounding, so that all builds give the same bits.
#pragma once

#include "dmc/bodies.h"

#include <math.h>

enum {
    WORDS_PER_TRIAL = 8,
    TRIALS = RNG_BLOCK / WORDS_PER_TRIAL, // of a block
};

enum { WORD_BODY, WORD_PLACE, WORD_TURN = 4, WORD_AZIMUTH = 6, WORD_FRAME = 7 };

// Of the trials of one block; amplitudes are multiplied in later. Displacements: along the axis and
// across it, uniform in (-1, 1) or normal of the same variance, 1/3. Turns: w of ROTATION_MIXED, or
// Y1, Y2 of ROTATION_TANGENT.
struct Draws {
    uint32_t body[TRIALS];
    uint32_t in_new_frame[TRIALS]; // 0 or 1
    double displacement[3][TRIALS];
    double turn[3][TRIALS];
};

// Uniform in (-1, 1), never 0, symmetric.
KERNEL double bodies_uniform(uint32_t word) {
    return (double)(int32_t)(word | 1) * 0x1p-31;
}

// Cosine and sine of an angle uniform on the circle: 30 bits place it in (-pi/4, pi/4), where the
// first terms left out of the power series are below 1e-16; one exchanges the two, one is the sign.
KERNEL void bodies_direction(uint32_t word, double *cosine, double *sine) {
    const double x = (double)(int32_t)(word << 2 | 2) * (0x1p-31 * 0.78539816339744830962);
    const double y = x * x;
    double s = 1, c = 1;
    for (int k = 14; k >= 2; k -= 2) s = 1 - y * (1.0 / (k * (k + 1))) * s;
    for (int k = 16; k >= 2; k -= 2) c = 1 - y * (1.0 / (k * (k - 1))) * c;
    s *= x;
    const double sign = word >> 31 ? -1 : 1;
    const int exchanged = word >> 30 & 1;
    *cosine = sign * (exchanged ? s : c);
    *sine = sign * (exchanged ? c : s);
}

// A direction uniform on the sphere: its height is uniform (Archimedes).
KERNEL void bodies_draw_mixed(Draws *draws, const uint32_t *words, size_t k) {
    double cosine, sine;
    bodies_direction(words[WORD_AZIMUTH * TRIALS + k], &cosine, &sine);
    const double z = bodies_uniform(words[WORD_TURN * TRIALS + k]);
    const double across = sqrt(1 - z * z);
    draws->turn[0][k] = across * cosine;
    draws->turn[1][k] = across * sine;
    draws->turn[2][k] = z;
}

// Uniform in a square that is turned at random, so that the angle alone counts.
KERNEL void bodies_draw_tangent(Draws *draws, const uint32_t *words, size_t k) {
    double cosine, sine;
    bodies_direction(words[WORD_AZIMUTH * TRIALS + k], &cosine, &sine);
    const double x = bodies_uniform(words[WORD_TURN * TRIALS + k]);
    const double y = bodies_uniform(words[(WORD_TURN + 1) * TRIALS + k]);
    draws->turn[0][k] = x * cosine - y * sine;
    draws->turn[1][k] = x * sine + y * cosine;
}

KERNEL void bodies_draw_normal(Draws *draws, double *const normals[3]) {
    static const double DEVIATION = 0.57735026918962576451; // 1/sqrt(3)
    for (size_t k = 0; k < TRIALS; k++) {
        for (int a = 0; a < 3; a++) draws->displacement[a][k] = DEVIATION * normals[a][2 * k];
        for (int a = 0; a < 2; a++) draws->turn[a][k] = DEVIATION * normals[a][2 * k + 1];
    }
}

// From the words of a block, and its normal numbers if the settings are gaussian.
KERNEL void bodies_draw(Draws *draws, const ChainSettings *settings, size_t count,
                        const uint32_t words[RNG_BLOCK], double *const normals[3]) {
    for (size_t k = 0; k < TRIALS; k++) {
        draws->body[k] = (uint32_t)((uint64_t)words[WORD_BODY * TRIALS + k] * count >> 32);
        draws->in_new_frame[k] = words[WORD_FRAME * TRIALS + k] >> 31;
    }
    if (settings->gaussian) {
        bodies_draw_normal(draws, normals);
        return;
    }
    for (int a = 0; a < 3; a++) {
        for (size_t k = 0; k < TRIALS; k++) {
            draws->displacement[a][k] = bodies_uniform(words[(WORD_PLACE + a) * TRIALS + k]);
        }
    }
    if (settings->rotation == ROTATION_MIXED)
        for (size_t k = 0; k < TRIALS; k++) bodies_draw_mixed(draws, words, k);
    else
        for (size_t k = 0; k < TRIALS; k++) bodies_draw_tangent(draws, words, k);
}

// Two directions across n that make a right-handed frame with it, without a branch at the poles
// (Frisvad 2012; Duff et al. 2017).
KERNEL void bodies_frame(const double n[3], double e[2][3]) {
    const double sign = copysign(1, n[2]);
    const double a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    e[0][0] = 1 + sign * n[0] * n[0] * a;
    e[0][1] = sign * b;
    e[0][2] = -sign * n[0];
    e[1][0] = b;
    e[1][1] = sign + n[1] * n[1] * a;
    e[1][2] = -n[1];
}

KERNEL int bodies_turn_is_mixed(const ChainSettings *settings) {
    return settings->rotation == ROTATION_MIXED && !settings->gaussian;
}

// Jabbari-Farouji and Trizac, eq. 5; Garcia Daza et al.
KERNEL void bodies_turned(int mixed, double a, const double u[3], const double turn[3],
                          double turned[3]) {
    double x[3];
    if (mixed) {
        for (int c = 0; c < 3; c++) x[c] = (1 - a) * u[c] + a * turn[c];
    } else {
        double e[2][3];
        bodies_frame(u, e);
        for (int c = 0; c < 3; c++) x[c] = u[c] + a * (turn[0] * e[0][c] + turn[1] * e[1][c]);
    }
    const double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int c = 0; c < 3; c++) turned[c] = x[c] / length;
}

// The nearest whole number, halves to even; |x| < 2^51.
KERNEL int64_t bodies_whole(double x) {
    return (int64_t)(x + 0x1.8p52 - 0x1.8p52);
}

// What a trial would make of a body.
typedef struct Proposal {
    double along[3];  // the axis and the two directions across, in d
    int64_t shift[3]; // in units of places
    double axis[3];
} Proposal;

// Forward and backward proposals have the same density: the frame is that of the orientation
// before or after the rotation, with equal chances.
KERNEL void bodies_propose_oriented(const Bodies *bodies, int mixed, const Amplitude *amplitude,
                                    const Draws *draws, size_t k, const double u[3],
                                    Proposal *proposal) {
    const double turn[3] = {draws->turn[0][k], draws->turn[1][k], draws->turn[2][k]};
    bodies_turned(mixed, amplitude->rotation, u, turn, proposal->axis);
    double n[3], e[2][3];
    for (int c = 0; c < 3; c++) n[c] = draws->in_new_frame[k] ? proposal->axis[c] : u[c];
    bodies_frame(n, e);
    const double x = proposal->along[0] = amplitude->parallel * draws->displacement[0][k];
    const double y = proposal->along[1] = amplitude->perpendicular * draws->displacement[1][k];
    const double z = proposal->along[2] = amplitude->perpendicular * draws->displacement[2][k];
    for (int c = 0; c < 3; c++) {
        const double shift = x * n[c] + (y * e[0][c] + z * e[1][c]);
        proposal->shift[c] = bodies_whole(shift * bodies->units_per_d[c]);
    }
}

KERNEL void bodies_propose_ball(const Bodies *bodies, const Amplitude *amplitude,
                                const Draws *draws, size_t k, const double u[3],
                                Proposal *proposal) {
    for (int c = 0; c < 3; c++) {
        proposal->along[c] = amplitude->parallel * draws->displacement[c][k];
        proposal->shift[c] = bodies_whole(proposal->along[c] * bodies->units_per_d[c]);
        proposal->axis[c] = u[c];
    }
}

static inline double bodies_squared(double x) {
    return x * x;
}

// 1 - u'.u without its cancellation.
KERNEL double bodies_turned_by(const double u[3], const double turned[3]) {
    double sum = 0;
    for (int c = 0; c < 3; c++) sum += bodies_squared(turned[c] - u[c]);
    return sum / 2;
}

KERNEL void bodies_count_accepted(MoveTally *moves, const Proposal *proposal, const double u[3]) {
    moves->accepted++;
    moves->parallel += bodies_squared(proposal->along[0]);
    moves->perpendicular += bodies_squared(proposal->along[1]) + bodies_squared(proposal->along[2]);
    moves->rotational += bodies_turned_by(u, proposal->axis);
}
