// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loop of density_modes.h, stamped once for each instruction set: for every vector the
// sum over a block of particles of exp(i q_x x) exp(i q_y y) exp(i q_z z), read from the tables.
// Eight lanes, added up in one fixed order.
#pragma once

#include "numerics/turn.h"
#include "observables/density_modes.h"

enum { LANE_ROWS = MODES_BLOCK / LANES };

// Power n of an axis; a negative one is the complex conjugate of the positive.
typedef struct Phase {
    const Lanes *cosine, *sine;
    double sign;
} Phase;

KERNEL Phase phase_of(const PowerTable *table, int32_t n) {
    const size_t row = (size_t)table->row[n < 0 ? -n : n] * MODES_BLOCK;
    return (Phase){.cosine = (const Lanes *)(table->cosine + row),
                   .sine = (const Lanes *)(table->sine + row),
                   .sign = n < 0 ? -1 : 1};
}

KERNEL void density_block_2d(const DensityModes *modes, double *real, double *imaginary) {
    for (size_t v = 0; v < modes->count; v++) {
        const Phase x = phase_of(&modes->table[0], modes->vectors[v].n[0]);
        const Phase y = phase_of(&modes->table[1], modes->vectors[v].n[1]);
        Lanes cc = {0}, ss = {0}, cs = {0}, sc = {0};
        for (int k = 0; k < LANE_ROWS; k++) {
            cc += x.cosine[k] * y.cosine[k];
            ss += x.sine[k] * y.sine[k];
            cs += x.cosine[k] * y.sine[k];
            sc += x.sine[k] * y.cosine[k];
        }
        real[v] += lanes_sum(&cc) - y.sign * lanes_sum(&ss);
        imaginary[v] += lanes_sum(&sc) + y.sign * lanes_sum(&cs);
    }
}

// exp(i q_x x) exp(i q_y y), kept while only q_z changes.
KERNEL void multiply_xy(const DensityModes *modes, const LatticeVector *vector, Lanes *cosine,
                        Lanes *sine) {
    const Phase x = phase_of(&modes->table[0], vector->n[0]);
    const Phase y = phase_of(&modes->table[1], vector->n[1]);
    for (int k = 0; k < LANE_ROWS; k++) {
        const Lanes y_sine = y.sign * y.sine[k];
        cosine[k] = x.cosine[k] * y.cosine[k] - x.sine[k] * y_sine;
        sine[k] = x.cosine[k] * y_sine + x.sine[k] * y.cosine[k];
    }
}

KERNEL void density_block_3d(const DensityModes *modes, double *real, double *imaginary) {
    Lanes xy_cosine[LANE_ROWS], xy_sine[LANE_ROWS];
    for (size_t v = 0; v < modes->count; v++) {
        const LatticeVector *vector = &modes->vectors[v];
        if (v == 0 || vector[-1].n[0] != vector->n[0] || vector[-1].n[1] != vector->n[1]) {
            multiply_xy(modes, vector, xy_cosine, xy_sine);
        }
        const Phase z = phase_of(&modes->table[2], vector->n[2]);
        Lanes cc = {0}, ss = {0}, cs = {0}, sc = {0};
        for (int k = 0; k < LANE_ROWS; k++) {
            cc += xy_cosine[k] * z.cosine[k];
            ss += xy_sine[k] * z.sine[k];
            cs += xy_cosine[k] * z.sine[k];
            sc += xy_sine[k] * z.cosine[k];
        }
        real[v] += lanes_sum(&cc) - z.sign * lanes_sum(&ss);
        imaginary[v] += lanes_sum(&sc) + z.sign * lanes_sum(&cs);
    }
}

// Eight particles, and the power that they have come to.
typedef struct Column {
    Lanes turn_c, turn_s, c, s;
} Column;

// Of an empty column all powers are zero.
KERNEL void column_begin(Column *column, const PowerTable *table, int k) {
    turn_cosine_sine((const Lanes *)table->turns + k, &column->turn_c, &column->turn_s);
    column->c = ((const Lanes *)table->present)[k];
    column->s = 0 * column->c;
}

KERNEL void column_keep(const Column *column, const PowerTable *table, size_t at) {
    ((Lanes *)table->cosine)[at] = column->c;
    ((Lanes *)table->sine)[at] = column->s;
}

KERNEL void column_turn(Column *column) {
    const Lanes turned = column->c * column->turn_c - column->s * column->turn_s;
    column->s = column->c * column->turn_s + column->s * column->turn_c;
    column->c = turned;
}

// Powers 0 to `most` of exp(2 pi i x/L) by recurrence. A power waits for the one before, so that
// four columns go side by side; by name, since compilers keep an array of them in memory.
KERNEL void fill_columns(const PowerTable *table, int k) {
    Column a, b, c, d;
    column_begin(&a, table, k);
    column_begin(&b, table, k + 1);
    column_begin(&c, table, k + 2);
    column_begin(&d, table, k + 3);
    for (int32_t n = 0; n <= table->most; n++) {
        if (table->row[n] != NO_POWER) {
            const size_t at = (size_t)table->row[n] * LANE_ROWS + (size_t)k;
            column_keep(&a, table, at);
            column_keep(&b, table, at + 1);
            column_keep(&c, table, at + 2);
            column_keep(&d, table, at + 3);
        }
        column_turn(&a);
        column_turn(&b);
        column_turn(&c);
        column_turn(&d);
    }
}

KERNEL void fill_table(const PowerTable *table) {
    for (int k = 0; k < LANE_ROWS; k += 4) fill_columns(table, k);
}

KERNEL void density_block(const DensityModes *modes, double *real, double *imaginary) {
    for (int a = 0; a < modes->dimension; a++) fill_table(&modes->table[a]);
    if (modes->dimension == 2)
        density_block_2d(modes, real, imaginary);
    else
        density_block_3d(modes, real, imaginary);
}
