// SPDX-License-Identifier: GPL-3.0-or-later
// Which way leads to a structure, and what all ways have in common.
#include "oz/oz.h"

#include "base/constants.h"
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

int oz_dimension_of(Closure closure) {
    return closed_forms[closure].dimension;
}

struct Oz {
    Closure closure;
    Structure structure;
    double *wave_number;
    Discs *discs;                        // one of the two,
    Closures *closures;                  // or none: a closed form
    const Measured *measured;            // differences from Percus-Yevick; NULL: none
    double *splines[MIXTURE_PAIRS_MOST]; // [count][spline]: their transforms
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
    const bool percus_yevick = oz->closure == CLOSURE_PERCUS_YEVICK || oz->measured;
    if (!percus_yevick && !closed_forms[oz->closure].fill)
        return closures_create(&oz->closures, oz->closure, &s->mixture, wave_number, count);
    const bool discs = percus_yevick && s->mixture.dimension == 2;
    return discs ? discs_create(&oz->discs, &s->mixture, wave_number, count) : OK;
}

Status oz_create(Oz **out, Closure closure, const Mixture *mixture, const double *wave_number,
                 size_t count) {
    Oz *oz = NULL;
    *out = NULL;
    if (closure == CLOSURE_MEASURED)
        return status_fail(BAD_DATA, "a measured structure comes from a file");
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

static Status prepare_splines(Oz *oz) {
    const Structure *s = &oz->structure;
    for (size_t a = 0; a < s->mixture.species; a++) {
        for (size_t b = a; b < s->mixture.species; b++) {
            double **splines = &oz->splines[mixture_pair(s->mixture.species, a, b)];
            TRY(NEW_ARRAY(*splines, s->count * measured_splines(oz->measured, a, b)));
            measured_transforms(oz->measured, a, b, s->wave_number, s->count, *splines);
        }
    }
    return OK;
}

Status oz_create_measured(Oz **out, const Measured *measured, const double *wave_number,
                          size_t count) {
    Oz *oz = NULL;
    *out = NULL;
    TRY(NEW(oz));
    oz->closure = CLOSURE_MEASURED;
    oz->measured = measured;
    oz->structure.mixture = *measured_mixture(measured);
    Status status = prepare(oz, wave_number, count);
    if (status == OK) status = prepare_splines(oz);
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
    for (size_t pair = 0; pair < MIXTURE_PAIRS_MOST; pair++) memory_free(oz->splines[pair]);
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

// A failure, with what was reached on the way.
static Status add_effort(Status status, const OzEffort *effort, double wanted) {
    if (status != UNHEALTHY || effort->at == 0) return status;
    const char *const solved = effort->reached > 0 ? "was solved up to" : "was solved nowhere from";
    return status_fail(
        status,
        "%s; on the way to packing fraction %g it %s %g; at %g a residual of %.3g was "
        "left after %zu iterations",
        status_sentence(), wanted, solved, effort->reached, effort->at, effort->residual,
        effort->iterations);
}

// What was measured beyond Percus-Yevick, of one pair. As c steps at contact, so does g.
static Status add_difference(Oz *oz, size_t a, size_t b) {
    Structure *s = &oz->structure;
    const size_t pair = mixture_pair(s->mixture.species, a, b);
    const size_t splines = measured_splines(oz->measured, a, b);
    double *coefficients = NULL;
    TRY(NEW_ARRAY(coefficients, splines));
    const Status status =
        measured_coefficients(oz->measured, s->packing_fraction, a, b, coefficients);
    for (size_t m = 0; m < s->count && status == OK; m++) {
        const double *transform = oz->splines[pair] + m * splines;
        for (size_t n = 0; n < splines; n++)
            s->direct[pair * s->count + m] += coefficients[n] * transform[n];
    }
    s->contact[pair] += measured_step(oz->measured, a, b, coefficients);
    memory_free(coefficients);
    return status;
}

static Status add_differences(Oz *oz) {
    for (size_t a = 0; a < oz->structure.mixture.species; a++) {
        for (size_t b = a; b < oz->structure.mixture.species; b++) TRY(add_difference(oz, a, b));
    }
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
    TRY(add_effort(fill_direct(oz), &oz->effort, packing_fraction));
    if (oz->measured) TRY(add_differences(oz));
    for (size_t i = 0; i < s->count; i++) TRY(fill_factor(s, i));
    *out = s;
    return OK;
}

OzEffort oz_effort(const Oz *oz) {
    return oz->effort;
}

double oz_compressibility_factor(const Structure *structure) {
    const Mixture *m = &structure->mixture;
    const double volume = m->dimension == 2 ? PI / 2 : 2 * PI / 3;
    double sum = 0;
    for (size_t a = 0; a < m->species; a++) {
        for (size_t b = 0; b < m->species; b++)
            sum += m->fraction[a] * m->fraction[b] * pow(mixture_contact(m, a, b), m->dimension) *
                   structure->contact[mixture_pair(m->species, a, b)];
    }
    return 1 + structure->density * volume * sum;
}
