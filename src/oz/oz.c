// SPDX-License-Identifier: GPL-3.0-or-later
// Which way leads to a structure, and what all ways have in common.
#include "oz/oz.h"

#include "base/memory.h"
#include "numerics/small.h"
#include "oz/inside.h"

#include <math.h>
#include <string.h>

const char *const closure_names[] = {
// Becomes: "percus-yevick", ...
#define CLOSURE(id, name, about) name,
#include "oz/closures.def"
    NULL};

const char *const closure_abouts[] = {
// Becomes: "Percus-Yevick; ...", ...
#define CLOSURE(id, name, about) about,
#include "oz/closures.def"
    NULL};

// Closed forms; NULL: solved in a file of its own.
static const struct {
    void (*fill)(Structure *structure);
    int dimension; // the only one it is for; 0: any
} closed_forms[CLOSURES] = {
    [CLOSURE_VERLET_WEIS] = {closed_verlet_weis, 3},
    [CLOSURE_FUNDAMENTAL] = {closed_fundamental, 2},
    [CLOSURE_BAUS_COLOT] = {closed_baus_colot, 2},
};

bool oz_is_of_one_species(Closure closure) {
    return closed_forms[closure].fill != NULL;
}

struct Oz {
    Closure closure;
    Structure structure;
    double *wave_number;
    Discs *discs;       // one of the two,
    Closures *closures; // or none: a closed form
    OzEffort effort;
};

static Status check(Closure closure, const Mixture *mixture) {
    TRY(mixture_check(mixture));
    const int dimension = closed_forms[closure].dimension;
    if (!dimension) return OK;
    if (mixture->dimension != dimension)
        return status_fail(BAD_DATA, "%s is for dimension %d, not %d", closure_names[closure],
                           dimension, mixture->dimension);
    if (mixture->species != 1)
        return status_fail(BAD_DATA, "%s is for one species, not %zu", closure_names[closure],
                           mixture->species);
    return OK;
}

static Status prepare(Oz *oz, const double *wave_number, size_t count) {
    Structure *s = &oz->structure;
    const size_t pairs = mixture_pairs(&s->mixture);
    s->count = count;
    TRY(NEW_ARRAY(oz->wave_number, count));
    TRY(NEW_ARRAY(s->direct, pairs * count));
    TRY(NEW_ARRAY(s->factor, pairs * count));
    memcpy(oz->wave_number, wave_number, count * sizeof *wave_number);
    s->wave_number = oz->wave_number;
    const bool percus_yevick = oz->closure == CLOSURE_PERCUS_YEVICK;
    if (!percus_yevick && !closed_forms[oz->closure].fill)
        return closures_create(&oz->closures, oz->closure, &s->mixture, wave_number, count);
    const bool discs = percus_yevick && s->mixture.dimension == 2;
    return discs ? discs_create(&oz->discs, &s->mixture, wave_number, count) : OK;
}

Status oz_create(Oz **out, Closure closure, const Mixture *mixture, const double *wave_number,
                 size_t count) {
    Oz *oz = NULL;
    *out = NULL;
    TRY(check(closure, mixture));
    TRY(NEW(oz));
    oz->closure = closure;
    oz->structure.mixture = *mixture;
    const Status status = prepare(oz, wave_number, count);
    if (status == OK)
        *out = oz;
    else
        oz_free(oz);
    return status;
}

void oz_free(Oz *oz) {
    if (!oz) return;
    discs_free(oz->discs);
    closures_free(oz->closures);
    memory_free(oz->wave_number);
    memory_free(oz->structure.direct);
    memory_free(oz->structure.factor);
    memory_free(oz);
}

static Status fill_direct(Oz *oz) {
    if (oz->discs) return discs_solve(oz->discs, &oz->structure, &oz->effort);
    if (oz->closures) return closures_solve(oz->closures, &oz->structure, &oz->effort);
    if (closed_forms[oz->closure].fill)
        closed_forms[oz->closure].fill(&oz->structure);
    else
        closed_spheres(&oz->structure);
    return OK;
}

// S = (1/x - rho c)^-1 at one wave number, which must be positive: a fluid that is stable.
static Status fill_factor(Structure *s, size_t i) {
    const size_t species = s->mixture.species;
    SmallMatrix inverse = {{0}}, factor;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++)
            inverse[a][b] = (a == b) / s->mixture.fraction[a] -
                            s->density * s->direct[mixture_pair(species, a, b) * s->count + i];
    }
    if (!small_is_positive(species, inverse) || !small_invert(species, inverse, factor))
        return status_fail(UNHEALTHY,
                           "at packing fraction %g the structure factor is not positive at q = %g",
                           s->packing_fraction, s->wave_number[i]);
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++)
            s->factor[mixture_pair(species, a, b) * s->count + i] = factor[a][b];
    }
    return OK;
}

Status oz_solve(Oz *oz, double packing_fraction, const Structure **out) {
    Structure *s = &oz->structure;
    if (!(packing_fraction > 0) || packing_fraction >= 1)
        return status_fail(BAD_DATA, "a packing fraction of %g is not between 0 and 1",
                           packing_fraction);
    s->packing_fraction = packing_fraction;
    s->density = mixture_density(&s->mixture, packing_fraction);
    oz->effort = (OzEffort){0};
    TRY(fill_direct(oz));
    for (size_t i = 0; i < s->count; i++) TRY(fill_factor(s, i));
    *out = s;
    return OK;
}

OzEffort oz_effort(const Oz *oz) {
    return oz->effort;
}
