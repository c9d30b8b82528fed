// SPDX-License-Identifier: GPL-3.0-or-later
// The Markov chain: trial moves of particles drawn at random, translation and rotation together,
// each accepted as Metropolis has it (hard bodies: if nothing overlaps). It knows amplitudes, not
// times: what a trial is worth in time is for clock.h.
//
// Proposals are symmetric, so that the chain samples the equilibrium exactly at any amplitude: a
// body's displacement is drawn in the frame of its orientation before or after the rotation, each
// with probability 1/2, and rotations depend on the angle alone.
#pragma once

#include "dmc/pull.h"
#include "propagator/propagator.h"

// What a proposal is like.
typedef enum RotationRule {
    ROTATION_MIXED,   // u' ~ (1 - a) u + a w, w uniform on the sphere (Jabbari-Farouji, Trizac, eq.
                      // 5)
    ROTATION_TANGENT, // u' ~ u + Y1 w1 + Y2 w2, |Y| <= a, w1, w2 across u (Garcia Daza et al.)
} RotationRule;

typedef struct ChainSettings {
    RngStream stream;
    RotationRule rotation;
    int gaussian; // 1: normal displacements, of the variance that uniform ones would have;
                  // rotations are then ROTATION_TANGENT with normal Y
    double scale; // of bodies at first, as by chain_rescale; 0: as they are
} ChainSettings;

// Half-widths of the uniform distributions of one species: of the displacement along the body axis
// and along either direction across it (along each axis of space for bodies without one: these take
// `parallel`), in d; a of the rotation.
typedef struct Amplitude {
    double parallel, perpendicular, rotation;
} Amplitude;

typedef struct Chain Chain;

// A way of moving particles: balls.c for discs, spheres and soft spheres, bodies.c for anything
// with a body axis and mixtures of it with spheres.
typedef struct ChainKind {
    Status (*check)(const System *system); // BAD_DATA with a sentence if it cannot
    Status (*create)(Chain **out, const ChainSettings *settings, State *state, RngKey key);
    void (*set_amplitude)(Chain *chain, size_t species, const Amplitude *amplitude);
    void (*pull)(Chain *chain, const ChainPull *pull);
    Status (*run)(Chain *chain, int64_t trials, Tally *tally);
    void (*publish)(Chain *chain);
    bool (*rescale)(Chain *chain, double scale);
    bool (*squeeze)(Chain *chain, double scale);
    void (*free)(Chain *chain);
    size_t (*memory)(const System *system);
} ChainKind;

extern const ChainKind chain_of_balls, chain_of_bodies;

// The first member of each kind's own struct.
struct Chain {
    const ChainKind *kind;
};

// BAD_DATA with a sentence if no chain can move this system.
Status chain_check(const System *system);

// Borrows the state until free; UNHEALTHY if bodies overlap (balls: when they first run).
// Amplitudes are 0 at first.
Status chain_create(Chain **out, const ChainSettings *settings, State *state, RngKey key);
void chain_free(Chain *chain);
void chain_set_amplitude(Chain *chain, size_t species, const Amplitude *amplitude);

// From now on the trials of this particle, which has no body axis, are those of a pulled one; NULL:
// of none.
void chain_pull(Chain *chain, const ChainPull *pull);

// Makes the trials state->step, state->step + 1, ...: trial number k is a pure function of (key,
// stream, k) and the configuration. Counts go to tally->moves. run(a), run(b) gives the bits of
// run(a + b). state->step advances; the rest of the State is stale until chain_publish.
Status chain_run(Chain *chain, int64_t trials, Tally *tally);

// Brings positions, images and orientations of the State up to date, exactly: a chain created from
// the published State goes on with the same bits, and so does this one. A few nanoseconds per
// particle: the clock does it around a cycle that it measures.
void chain_publish(Chain *chain);

// Sets all sizes to `scale` times those of the State; false, with nothing changed, if something
// would overlap. Sizes of the State itself never change.
bool chain_rescale(Chain *chain, double scale);

// The same for growth, but bodies that would overlap are moved by trials of their own, which count
// as steps, until they do not (balls are not). false: the sizes are as before.
bool chain_squeeze(Chain *chain, double scale);

size_t chain_memory(const System *system);            // bytes
double chain_seconds_per_trial(const System *system); // rough, of one core
