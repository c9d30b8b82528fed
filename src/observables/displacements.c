// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements of all particles since the time origins.
#include "observables/displacements.h"

#include "base/memory.h"

#include <string.h>

static size_t whole_lanes(size_t particles) {
    return (particles + LANES - 1) / LANES * LANES;
}

Status displacements_make(Displacements *d, const State *state, const Lags *lags) {
    d->dimension = state->box.dimension;
    d->species_count = state->system.species_count;
    system_counts(&state->system, d->population);
    for (size_t s = 0; s < d->species_count; s++) {
        d->begin[s + 1] = d->begin[s] + whole_lanes(d->population[s]);
    }
    d->lanes = d->begin[d->species_count];
    const size_t coordinates = (size_t)d->dimension * d->lanes;
    TRY(history_make(&d->history, lags, coordinates + 1));
    TRY(NEW_ARRAY(d->now, coordinates + 1));
    return NEW_ARRAY(d->moved, coordinates);
}

void displacements_clear(Displacements *d) {
    history_clear(&d->history);
    memory_free(d->now);
    memory_free(d->moved);
}

size_t displacements_memory(const System *system, const Lags *lags) {
    size_t counts[SPECIES_MOST], lanes = 0;
    system_counts(system, counts);
    for (size_t s = 0; s < system->species_count; s++) lanes += whole_lanes(counts[s]);
    const size_t frame = (size_t)system->dimension * lanes + 1;
    return history_memory(lags, frame) + 2 * frame * sizeof(double);
}

void displacements_archive(Displacements *d, Archive *archive) {
    history_archive(&d->history, archive);
}

void displacements_look(Displacements *d, const State *state) {
    double centre[3];
    frame_centre(d->frame, state, centre);
    for (int a = 0; a < d->dimension; a++) {
        size_t particle = 0;
        for (size_t s = 0; s < d->species_count; s++) {
            double *now = d->now + (size_t)a * d->lanes + d->begin[s];
            frame_unfold(state, a, centre[a], particle, d->population[s], now);
            particle += d->population[s];
        }
    }
    d->now[(size_t)d->dimension * d->lanes] = box_strain(&state->box);
}

bool displacements_ended(Displacements *d, int64_t tick, size_t k, size_t *row) {
    const double *then = history_begun(&d->history, tick, k, row);
    if (!then) return false;
    const size_t coordinates = (size_t)d->dimension * d->lanes;
    for (size_t i = 0; i < coordinates; i += LANES) {
        Lanes begun;
        memcpy(&begun, then + i, sizeof begun); // frames lie where they will
        *(Lanes *)(d->moved + i) = *(const Lanes *)(d->now + i) - begun;
    }
    const double strain = d->now[coordinates] - then[coordinates], *y = d->now + d->lanes;
    for (size_t i = 0; strain != 0 && i < d->lanes; i++) d->moved[i] -= strain * y[i];
    return true;
}

void displacements_squares(const Displacements *d, double *squares) {
    const size_t rows = d->lanes / LANES;
    const Lanes *moved = (const Lanes *)d->moved;
    Lanes *sums = (Lanes *)squares;
    for (size_t k = 0; k < rows; k++) sums[k] = moved[k] * moved[k];
    for (int a = 1; a < d->dimension; a++) {
        moved += rows;
        for (size_t k = 0; k < rows; k++) sums[k] += moved[k] * moved[k];
    }
}

void displacements_keep(Displacements *d, int64_t tick) {
    history_keep(&d->history, tick, d->now);
}

double displacements_samples(const Displacements *d, size_t row, size_t first, size_t last) {
    double particles = 0;
    for (size_t s = first; s < last; s++) particles += (double)d->population[s];
    return particles * (double)d->history.seen[row];
}
