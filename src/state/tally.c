// SPDX-License-Identifier: GPL-3.0-or-later
// Saving and adding tallies.
#include "state/tally.h"

#include <math.h>

void tally_archive_moves(MoveTally *moves, Archive *archive) {
    archive_u64(archive, &moves->trials, 1);
    archive_u64(archive, &moves->accepted, 1);
    archive_f64(archive, &moves->parallel, 1);
    archive_f64(archive, &moves->perpendicular, 1);
    archive_f64(archive, &moves->rotational, 1);
    archive_f64(archive, &moves->free.parallel, 1);
    archive_f64(archive, &moves->free.perpendicular, 1);
    archive_f64(archive, &moves->free.rotational, 1);
    archive_u64(archive, &moves->unhindered, 1);
}

void tally_add_moves(MoveTally *sum, const MoveTally *more) {
    sum->trials += more->trials;
    sum->accepted += more->accepted;
    sum->parallel += more->parallel;
    sum->perpendicular += more->perpendicular;
    sum->rotational += more->rotational;
    sum->free.parallel += more->free.parallel;
    sum->free.perpendicular += more->free.perpendicular;
    sum->free.rotational += more->free.rotational;
    sum->unhindered += more->unhindered;
}

void tally_archive_settling(TracerSettling *settling, Archive *archive) {
    archive_u64(archive, &settling->rounds, 1);
    archive_require(archive, settling->rounds <= SETTLING_MOST,
                    "its tracer was adjusted too often");
    archive_f64(archive, &settling->cycles, 1);
    archive_f64(archive, settling->step, SETTLING_MOST);
    archive_f64(archive, settling->pace, SETTLING_MOST);
}

void tally_archive(Tally *tally, Archive *archive) {
    archive_u64(archive, &tally->collisions, 1);
    archive_f64(archive, &tally->exchange[0][0], 9);
    archive_u64(archive, &tally->corrected, 1);
    archive_f64(archive, &tally->deepest_contact, 1);
    archive_u64(archive, &tally->rebuilds, 1);
    archive_u64(archive, &tally->replays, 1);
    archive_u64(archive, &tally->stale, 1);
    archive_u64(archive, &tally->windows, 1);
    for (size_t s = 0; s < SPECIES_MOST; s++) tally_archive_moves(&tally->moves[s], archive);
}

void tally_add(Tally *sum, const Tally *more) {
    sum->collisions += more->collisions;
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) sum->exchange[a][b] += more->exchange[a][b];
    }
    sum->corrected += more->corrected;
    sum->deepest_contact = fmax(sum->deepest_contact, more->deepest_contact);
    sum->rebuilds += more->rebuilds;
    sum->replays += more->replays;
    sum->stale += more->stale;
    sum->windows += more->windows;
    for (size_t s = 0; s < SPECIES_MOST; s++) tally_add_moves(&sum->moves[s], &more->moves[s]);
}

uint64_t tally_trials(const Tally *tally) {
    uint64_t sum = 0;
    for (size_t s = 0; s < SPECIES_MOST; s++) sum += tally->moves[s].trials;
    return sum;
}

double tally_particle_steps(const Tally *tally, double particles) {
    return (double)tally->windows * particles + (double)tally_trials(tally);
}
