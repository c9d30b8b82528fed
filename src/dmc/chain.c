// SPDX-License-Identifier: GPL-3.0-or-later
// Which kind of chain moves a system.
#include "dmc/chain.h"

static const ChainKind *kind_for(const System *system) {
    return system_is_oriented(system) ? &chain_of_bodies : &chain_of_balls;
}

Status chain_check(const System *system) {
    return kind_for(system)->check(system);
}

Status chain_create(Chain **out, const ChainSettings *settings, State *state, RngKey key) {
    return kind_for(&state->system)->create(out, settings, state, key);
}

void chain_free(Chain *chain) {
    if (chain) chain->kind->free(chain);
}

void chain_set_amplitude(Chain *chain, size_t species, const Amplitude *amplitude) {
    chain->kind->set_amplitude(chain, species, amplitude);
}

void chain_pull(Chain *chain, const ChainPull *pull) {
    chain->kind->pull(chain, pull);
}

Status chain_run(Chain *chain, int64_t trials, Tally *tally) {
    return chain->kind->run(chain, trials, tally);
}

void chain_publish(Chain *chain) {
    chain->kind->publish(chain);
}

bool chain_rescale(Chain *chain, double scale) {
    return chain->kind->rescale(chain, scale);
}

bool chain_squeeze(Chain *chain, double scale) {
    return chain->kind->squeeze(chain, scale);
}

size_t chain_memory(const System *system) {
    return kind_for(system)->memory(system);
}

double chain_seconds_per_trial(const System *system) {
    static const double seconds[SHAPES] = {[SHAPE_DISC] = 16e-9,
                                           [SHAPE_SPHERE] = 16e-9,
                                           [SHAPE_SPHEROCYLINDER] = 110e-9,
                                           [SHAPE_PLATELET] = 200e-9,
                                           [SHAPE_SOFT_SPHERE] = 50e-9};
    double sum = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        sum += system->species[s].fraction * seconds[system->species[s].shape];
    }
    return sum;
}
