// SPDX-License-Identifier: GPL-3.0-or-later
// Scattering functions as seen from the centre of mass. Where all velocities are redrawn, that of
// the centre is too: it diffuses freely with D = kT Delta/(2 M), M the mass of all particles, and
// collisions do not change it, so that it is independent of how particles move about it. Functions
// of fixed axes therefore are those about the centre times exp(-q^2 D t), exactly. In a glass of N
// particles this is what decays after times of N/(q^2 D0), and it is not structural relaxation;
// here it is divided out.
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>

double centre_diffusion(const System *system) {
    size_t counts[SPECIES_MOST];
    double mass = 0;
    system_counts(system, counts);
    for (size_t s = 0; s < system->species_count; s++)
        mass += (double)counts[s] * system->species[s].mass;
    return system->species[0].mass / mass;
}

// Of all replicas, [replica][element].
static void divide(const Results *results, const ResultSeries *scattering, double diffusion,
                   double *values) {
    const ResultAxis *wave = &scattering->axis[scattering->axes - 2], *time = wave + 1;
    for (size_t i = 0; i < results->replicas * scattering->size; i++) {
        const size_t element = i % scattering->size;
        const double t = time->values[element % time->count],
                     q = wave->values[element / time->count % wave->count];
        values[i] = scattering->values[i] * exp(q * q * diffusion * t);
    }
}

// The last two axes are wave number and time, in d^2/D0.
Status derive_centred(Results *results, const ResultSeries *scattering, const char *name,
                      double diffusion) {
    double *values = NULL;
    ResultSeries shape = derive_shape(scattering, name);
    snprintf(shape.about, sizeof shape.about,
             "The function about the centre of mass, whose own diffusion is divided out: over "
             "exp(-q^2 D t), D = %.4g D0.",
             diffusion);
    TRY(NEW_ARRAY(values, results->replicas * shape.size));
    divide(results, scattering, diffusion, values);
    Status status = OK;
    for (size_t r = 0; r < results->replicas && status == OK; r++)
        status = results_put_series(results, &shape, r, values + r * shape.size);
    memory_free(values);
    return status;
}
