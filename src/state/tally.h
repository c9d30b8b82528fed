// SPDX-License-Identifier: GPL-3.0-or-later
// What a snapshot cannot hold: sums that the propagator keeps since the stage began. Cumulative;
// an observer takes differences.
#pragma once

#include "base/archive.h"

#include "state/system.h"

// Squares of moves.
typedef struct MoveSquares {
    double parallel;      // (displacement along the body axis)^2; of bodies without one, along x
    double perpendicular; // |displacement across it|^2, of both directions together; or along y, z
    double rotational;    // 1 - u'.u
} MoveSquares;

// Trial moves of one species, squares summed over the accepted ones, and what the sums would be on
// average had all been accepted, as those of a free body are: the clocks compare the two.
typedef struct MoveTally {
    uint64_t trials, accepted;
    double parallel, perpendicular, rotational; // see MoveSquares
    MoveSquares free;
    uint64_t unhindered; // of a pulled particle: accepted were it not for the force
} MoveTally;

enum { SETTLING_MOST = 64 };

// How the Monte Carlo step of a pulled tracer was adjusted before its stage, in rounds.
typedef struct TracerSettling {
    uint64_t rounds;            // at most SETTLING_MOST, the first
    double cycles;              // of a round
    double step[SETTLING_MOST]; // that the tracer had, in d
    double pace[SETTLING_MOST]; // what its cycle was worth over what the bath's was
} TracerSettling;

void tally_archive_settling(TracerSettling *settling, Archive *archive);

typedef struct Tally {
    uint64_t collisions;    // pair collisions (each counted once)
    double exchange[3][3];  // sum over collisions of r_a (dp)_b, r = r_i - r_j at contact, dp the
                            // momentum given to i; in d sqrt(m kT). Positive trace.
    uint64_t corrected;     // pairs found overlapping and approaching, collided at once
    double deepest_contact; // the deepest of them, as 1 - r/d_ij
    uint64_t rebuilds;      // of the neighbour list
    uint64_t replays;       // windows replayed since a particle outran the list
    uint64_t stale;         // predicted events voided by an earlier one
    uint64_t windows;       // windows done
    MoveTally moves[SPECIES_MOST];  // of Monte Carlo
    const TracerSettling *settling; // borrowed from the propagator, which saves it; NULL: none
} Tally;

// The counters `rebuilds`, `replays` and `stale` are of the machinery, not of the physics: they
// may differ after a resume and never reach a result.
void tally_archive(Tally *tally, Archive *archive);
void tally_add(Tally *sum, const Tally *more);
// Windows times particles, and trials: the work done.
double tally_particle_steps(const Tally *tally, double particles);
uint64_t tally_trials(const Tally *tally); // of all species
void tally_archive_moves(MoveTally *moves, Archive *archive);
void tally_add_moves(MoveTally *sum, const MoveTally *more);
