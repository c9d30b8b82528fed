// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors of the reciprocal lattice of the box, chosen in shells of |q|: of q and -q one, every
// vector of a shell with few of them, an even choice over all directions of one with many.
#pragma once

#include "observables/density_modes.h"
#include "observables/observables.h"

// low <= |q| < high, in 1/d.
typedef struct Shell {
    double low, high;
} Shell;

typedef struct WaveVectors {
    size_t shells, count;
    LatticeVector *vector; // [count], in the order that DensityModes wants
    uint32_t *shell;       // [count]
    double *wave_number;   // [shells], mean |q|
    double *members;       // [shells], vectors chosen
} WaveVectors;

// Shells ascend and do not overlap. `most` vectors in each; 0 takes all.
Status wave_vectors_make(WaveVectors *vectors, const Box *box, const Shell *shells, size_t count,
                         int64_t most);
void wave_vectors_clear(WaveVectors *vectors);

// How many there are at most with |q| < last in so many shells, and their bytes with the tables of
// DensityModes.
double wave_vectors_most(const Box *box, double last, size_t shells, int64_t most);
size_t wave_vectors_memory(const Box *box, double last, size_t shells, int64_t most);

double wave_number_least(const Box *box); // 2 pi/L of the longest edge

// A list of wave numbers as the run file gives it; where it is empty, that of the mean distance of
// particles, 2 pi rho^(1/dimension).
OptionReals wave_numbers_chosen(const OptionReals *given, const System *system);

// BAD_DATA with a sentence unless they ascend and fit into the box.
Status wave_numbers_check(const char *observable, const OptionReals *given, const System *system);

#define WAVE_NUMBER_OPTION(Type, member)                                                           \
    {                                                                                              \
        .name = "wave_numbers", .type = OPTION_REALS, .offset = offsetof(Type, member),            \
        .least = 0.001, .most = 1000, .unit = "1/d",                                               \
        .about = "Wave numbers, ascending, none below 2 pi over the longest edge of the box; "     \
                 "empty: one, 2 pi over the mean distance of particles rho^(-1/dimension).",       \
    }

// BAD_DATA with a sentence if the lattice within |q| < last has too many vectors to go through;
// `option` is what the run file calls `last`.
Status wave_vectors_check(const char *observable, const char *option, const Box *box, double last);

// A line for `perrin check` where shells have more vectors than are taken; `option` is what the run
// file calls `most`.
void wave_vectors_describe(const Box *box, const Shell *shells, size_t count, int64_t most,
                           const char *option, Text *lines);

// The densities rho_a(q) of every species, modes[species][real, imaginary][vector].
typedef struct WaveModes {
    DensityModes *density;
    size_t species_count, width; // of a set of modes: 2 species_count count
} WaveModes;

// Borrows the vectors.
Status wave_modes_make(WaveModes *modes, const WaveVectors *vectors, const State *state);
void wave_modes_clear(WaveModes *modes);
void wave_modes_find(const WaveModes *modes, const State *state, double *values);

// The same of particles seen from a point: each mode times exp(-i q.centre).
void wave_modes_shift(const WaveModes *modes, const Box *box, const double centre[3],
                      double *values);

// Adds Re rho_a*(q) rho_b(q) of every pair a <= b of species, rho_a of one set of modes and rho_b
// of another, the mean of both ways round, to sums[pair][shell].
void wave_modes_add_products(const WaveModes *modes, const WaveVectors *vectors, const double *one,
                             const double *other, double *sums);
