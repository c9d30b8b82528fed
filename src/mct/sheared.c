// SPDX-License-Identifier: GPL-3.0-or-later
// The isotropically sheared model: correlators whose kernel has one vertex stretched, and the
// stress that follows from them.
#include "mct/sheared.h"

#include "base/memory.h"
#include "mct/correlators.h"
#include "mct/stretch.h"

#include <math.h>

static const double NOTHING = 1e-9; // of the stress so far, in a time

struct Sheared {
    Correlators *correlators;
    Stretch *stretch;
    double shear_rate, time;
    double modulus, integral; // G at this time, and since the beginning
};

static Status begin(Sheared *s, const Grid *grid, const Structure *structure, size_t block) {
    const CorrelatorSettings settings = {
        .block = block, .diffusion = {1}, .shear_rate = s->shear_rate};
    TRY(correlators_create(&s->correlators, grid, structure, &settings));
    TRY(stretch_create(&s->stretch, grid, structure, 0, 0));
    s->modulus = stretch_modulus(s->stretch, structure->factor, 0);
    return OK;
}

Status sheared_create(Sheared **out, const Grid *grid, const Structure *structure,
                      double shear_rate, size_t block) {
    Sheared *s = NULL;
    *out = NULL;
    TRY(NEW(s));
    s->shear_rate = shear_rate;
    const Status status = begin(s, grid, structure, block);
    if (status == OK)
        *out = s;
    else
        sheared_free(s);
    return status;
}

void sheared_free(Sheared *s) {
    if (!s) return;
    correlators_free(s->correlators);
    stretch_free(s->stretch);
    memory_free(s);
}

Status sheared_advance(Sheared *s) {
    TRY(correlators_advance(s->correlators));
    const double time = correlators_time(s->correlators), before = s->modulus;
    s->modulus = stretch_modulus(s->stretch, sheared_correlator(s), s->shear_rate * time);
    s->integral += (time - s->time) * (before + s->modulus) / 2;
    s->time = time;
    return OK;
}

double sheared_time(const Sheared *s) {
    return s->time;
}

const double *sheared_correlator(const Sheared *s) {
    return correlators_collective(s->correlators);
}

double sheared_modulus(const Sheared *s) {
    return s->modulus;
}

double sheared_stress(const Sheared *s) {
    return s->shear_rate * s->integral;
}

// Until the flow, if there is one, has done its part: G passes 0 on the way.
bool sheared_has_decayed(const Sheared *s) {
    const bool passed = s->shear_rate == 0 || s->shear_rate * s->time > 1;
    return passed && fabs(s->modulus) * s->time < NOTHING * fabs(s->integral);
}
