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

Status chain_run(Chain *chain, int64_t trials, Tally *tally) {
    return chain->kind->run(chain, trials, tally);
}

void chain_publish(Chain *chain) {
    chain->kind->publish(chain);
}

bool chain_rescale(Chain *chain, double scale) {
    return chain->kind->rescale(chain, scale);
}

size_t chain_memory(const System *system) {
    return kind_for(system)->memory(system);
}
