// SPDX-License-Identifier: GPL-3.0-or-later
// The glass transition. Near it phi = phi_c + a2 s^2 + a3 s^3 + ... with s = 1 - E, E the largest
// eigenvalue of the stability map; lambda, form factors and eigenvectors are power series in s.
// Five states with s between 0.04 and 0.009 give all of them at s = 0, which bisection never
// reaches: there form factors converge ever more slowly.
#include "mct/critical.h"

#include "base/memory.h"
#include "mct/glass.h"
#include "mct/grid.h"
#include "mct/stretch.h"

#include <gsl/gsl_linalg.h>

#include <math.h>
#include <string.h>

static const double NEAR = 0.25; // s of a glass from which the states are aimed at
static const double AIMS[] = {0.04, 0.028, 0.02, 0.013, 0.009};
enum { STATES = 5, BISECTIONS_MOST = 40, TRIES_MOST = 60, LOWERINGS = 6 };
static const double LOWERING = 0.15;   // of the interval that is searched
static const double CURVATURE = 0.3;   // of phi/phi_c in s, a guess
static const double TOLERANCE = 0.4;   // of what is aimed at: how far a state may lie from it
static const double NEARER = 0.4;      // of s: what is aimed at from far, lest it be a fluid, which
                                       // takes longest to tell near the transition
static const double SLOPE_STEP = 1e-3; // of phi/phi_c, for the derivative of sigma
static const double STRAIN = 1e-3;     // for the derivative of sigma with its square

typedef struct CriticalState {
    double packing_fraction, s, lambda;
    double *form, *right, *left;
} CriticalState;

typedef struct Search {
    Oz *oz;
    Grid *grid;
    Model *model;
    Stability stability;
    double *form;
    double form_of;               // packing fraction of the glass that it is of; 0: of none
    double low;                   // the densest fluid known
    double high, s;               // the glass seen last
    double high_before, s_before; // and the one before it; 0: none
    CriticalState states[STATES];
    size_t found;
    size_t evaluations;
} Search;

// The structure of the densest glass to begin with: some closures have no solution as dense as
// asked for, and are asked for less.
static Status solve_high(Search *search, const Structure **structure) {
    Status status = oz_solve(search->oz, search->high, structure);
    for (int tries = 0; status == UNHEALTHY && tries < LOWERINGS; tries++) {
        search->high -= LOWERING * (search->high - search->low);
        status = oz_solve(search->oz, search->high, structure);
    }
    return status;
}

static Status search_create(Search *search, const CriticalSearch *wanted) {
    const Structure *structure = NULL;
    *search = (Search){.low = wanted->low, .high = wanted->high};
    TRY(grid_create(&search->grid, wanted->mixture.dimension, wanted->count, wanted->last));
    TRY(wanted->measured ? oz_create_measured(&search->oz, wanted->measured,
                                              search->grid->wave_number, search->grid->count)
                         : oz_create(&search->oz, wanted->closure, &wanted->mixture,
                                     search->grid->wave_number, search->grid->count));
    TRY(solve_high(search, &structure));
    TRY(model_create(&search->model, search->grid, structure));
    TRY(stability_create(&search->stability, search->model));
    TRY(NEW_ARRAY(search->form, search->model->size));
    for (size_t i = 0; i < STATES; i++) {
        TRY(NEW_ARRAY(search->states[i].form, search->model->size));
        TRY(NEW_ARRAY(search->states[i].right, search->model->size));
        TRY(NEW_ARRAY(search->states[i].left, search->model->size));
    }
    return OK;
}

static void search_free(Search *search) {
    for (size_t i = 0; i < STATES; i++) {
        memory_free(search->states[i].form);
        memory_free(search->states[i].right);
        memory_free(search->states[i].left);
    }
    memory_free(search->form);
    stability_free(&search->stability);
    model_free(search->model);
    oz_free(search->oz);
    grid_free(search->grid);
}

// Form factors and, of a glass, its stability.
static Status look(Search *search, double packing_fraction, bool *glass) {
    const Structure *structure = NULL;
    TRY(oz_solve(search->oz, packing_fraction, &structure));
    model_set(search->model, structure);
    // From above: the form factors of a denser glass, or S.
    if (packing_fraction > search->form_of)
        memcpy(search->form, search->model->factor, search->model->size * sizeof(double));
    search->form_of = packing_fraction;
    TRY(glass_form_factors(search->model, search->form, glass));
    search->evaluations++;
    if (!*glass) {
        search->form_of = 0;
        search->low = fmax(search->low, packing_fraction);
        return OK;
    }
    TRY(glass_stability(search->model, search->form, &search->stability));
    search->high_before = search->high;
    search->s_before = search->s;
    search->high = packing_fraction;
    search->s = 1 - search->stability.eigenvalue;
    return OK;
}

static Status bisect(Search *search, const CriticalSearch *wanted) {
    bool glass;
    TRY(look(search, search->high, &glass));
    if (!glass)
        return status_fail(BAD_DATA, "at packing fraction %g there is no glass", search->high);
    for (int step = 0; step < BISECTIONS_MOST && search->s > NEAR; step++)
        TRY(look(search, (search->low + search->high) / 2, &glass));
    if (search->low > wanted->low) return OK;
    TRY(look(search, wanted->low, &glass));
    return glass ? status_fail(BAD_DATA, "at packing fraction %g there is a glass already",
                               wanted->low)
                 : OK;
}

// phi = sum_n coefficient[n] s^(n > 0 ? n + 1 : 0) through the states: no term linear in s.
static void fit_packing(const Search *search, double coefficients[STATES]) {
    const size_t n = search->found;
    gsl_matrix *powers = gsl_matrix_alloc(n, n);
    gsl_vector *values = gsl_vector_alloc(n);
    gsl_permutation *order = gsl_permutation_alloc(n);
    int sign;
    for (size_t i = 0; i < n; i++) {
        gsl_vector_set(values, i, search->states[i].packing_fraction);
        for (size_t k = 0; k < n; k++)
            gsl_matrix_set(powers, i, k, k == 0 ? 1 : pow(search->states[i].s, (double)k + 1));
    }
    gsl_linalg_LU_decomp(powers, order, &sign);
    gsl_linalg_LU_svx(powers, order, values);
    for (size_t k = 0; k < n; k++) coefficients[k] = gsl_vector_get(values, k);
    gsl_matrix_free(powers);
    gsl_vector_free(values);
    gsl_permutation_free(order);
}

// The packing fraction at which s should be this, by what is known so far; halfway to the fluid if
// that is no glass.
static double aim(const Search *search, double s) {
    double coefficients[STATES], next;
    if (search->found > 1) {
        fit_packing(search, coefficients);
        next = coefficients[0];
        for (size_t k = 1; k < search->found; k++) next += coefficients[k] * pow(s, (double)k + 1);
    } else {
        const double square = search->s * search->s, before = pow(search->s_before, 2);
        const double curvature = search->s_before > 0 && before != square
                                     ? (search->high_before - search->high) / (before - square)
                                     : CURVATURE * search->high;
        next = search->high - curvature * (square - s * s);
    }
    return next > search->low ? next : (search->low + search->high) / 2;
}

static void keep(Search *search, double packing_fraction) {
    CriticalState *state = &search->states[search->found++];
    const size_t bytes = search->model->size * sizeof(double);
    state->packing_fraction = packing_fraction;
    state->s = search->s;
    state->lambda = search->stability.lambda;
    memcpy(state->form, search->form, bytes);
    memcpy(state->right, search->stability.right, bytes);
    memcpy(state->left, search->stability.left, bytes);
}

static Status gather_states(Search *search) {
    for (int tries = 0; search->found < STATES; tries++) {
        const double goal = AIMS[search->found];
        const double next = aim(search, fmax(goal, NEARER * search->s));
        bool glass = false;
        if (tries == TRIES_MOST)
            return status_fail(UNHEALTHY,
                               "critical point: lost between packing fractions %.8f and %.8f",
                               search->low, search->high);
        TRY(look(search, next, &glass));
        if (glass && fabs(search->s / goal - 1) < TOLERANCE) keep(search, next);
    }
    return OK;
}

// Weights of the values at the states in the value at s = 0.
static void extrapolation(const Search *search, double weights[STATES]) {
    for (size_t i = 0; i < STATES; i++) {
        weights[i] = 1;
        for (size_t j = 0; j < STATES; j++) {
            const double si = search->states[i].s, sj = search->states[j].s;
            if (j != i) weights[i] *= sj / (sj - si);
        }
    }
}

static Status point_create(CriticalPoint **out, const Search *search) {
    CriticalPoint *point = NULL;
    TRY(NEW(point));
    *out = point;
    point->count = search->grid->count;
    TRY(NEW_ARRAY(point->wave_number, point->count));
    TRY(NEW_ARRAY(point->form, point->count * search->model->pairs));
    TRY(NEW_ARRAY(point->amplitude, point->count * search->model->pairs));
    return NEW_ARRAY(point->factor, point->count * search->model->pairs);
}

void critical_free(CriticalPoint *point) {
    if (!point) return;
    memory_free(point->wave_number);
    memory_free(point->form);
    memory_free(point->amplitude);
    memory_free(point->factor);
    memory_free(point);
}

// Without the padding of lines.
static void put_field(const Search *search, const double *field, double *out) {
    const size_t count = search->grid->count, stride = search->grid->stride;
    for (size_t pair = 0; pair < search->model->pairs; pair++)
        memcpy(out + pair * count, field + pair * stride, count * sizeof *out);
}

// All at s = 0: lambda, and the fields in place of the first state's.
static Status extrapolate(Search *search, CriticalPoint *point) {
    double weights[STATES], coefficients[STATES], lambda = 0;
    CriticalState *first = &search->states[0];
    extrapolation(search, weights);
    fit_packing(search, coefficients);
    point->packing_fraction = coefficients[0];
    point->curvature = coefficients[1];
    for (size_t i = 0; i < STATES; i++) lambda += weights[i] * search->states[i].lambda;
    for (size_t m = 0; m < search->model->size; m++) {
        double form = 0, right = 0, left = 0;
        for (size_t i = 0; i < STATES; i++) {
            form += weights[i] * search->states[i].form[m];
            right += weights[i] * search->states[i].right[m];
            left += weights[i] * search->states[i].left[m];
        }
        first->form[m] = form;
        first->right[m] = right;
        first->left[m] = left;
    }
    return exponents_of(lambda, &point->exponents);
}

static Status separation_at(Search *search, double packing_fraction, double *separation) {
    const Structure *structure = NULL;
    TRY(oz_solve(search->oz, packing_fraction, &structure));
    model_set(search->model, structure);
    return glass_separation(search->model, search->states[0].form, search->states[0].left,
                            separation);
}

// What a strain takes from sigma, over its square, at the transition.
static Status find_shear(Search *search, const Structure *structure, double *shear) {
    Model *model = search->model;
    const CriticalState *critical = &search->states[0];
    Stretch *stretch = NULL;
    double rest, strained;
    *shear = NAN;
    if (model->species > 1) return OK;
    model_set(model, structure);
    TRY(glass_separation(model, critical->form, critical->left, &rest));
    TRY(stretch_create(&stretch, search->grid, structure));
    model->stretched = stretch_direct(stretch, STRAIN);
    const Status status = glass_separation(model, critical->form, critical->left, &strained);
    model->stretched = NULL;
    stretch_free(stretch);
    if (status == OK) *shear = (rest - strained) / (STRAIN * STRAIN);
    return status;
}

static Status finish(Search *search, CriticalPoint *point) {
    double above, below;
    const Structure *structure = NULL;
    TRY(extrapolate(search, point));
    TRY(separation_at(search, point->packing_fraction * (1 + SLOPE_STEP), &above));
    TRY(separation_at(search, point->packing_fraction * (1 - SLOPE_STEP), &below));
    point->slope = (above - below) / (2 * SLOPE_STEP);
    point->expected_curvature =
        point->packing_fraction / (4 * point->slope * (1 - point->exponents.lambda));
    TRY(oz_solve(search->oz, point->packing_fraction, &structure));
    TRY(find_shear(search, structure, &point->shear));
    memcpy(point->factor, structure->factor,
           search->model->pairs * point->count * sizeof *point->factor);
    memcpy(point->wave_number, search->grid->wave_number, point->count * sizeof(double));
    put_field(search, search->states[0].form, point->form);
    put_field(search, search->states[0].right, point->amplitude);
    point->evaluations = search->evaluations;
    return OK;
}

Status critical_find(CriticalPoint **out, const CriticalSearch *wanted) {
    Search search;
    *out = NULL;
    Status status = search_create(&search, wanted);
    if (status == OK) status = bisect(&search, wanted);
    if (status == OK) status = gather_states(&search);
    if (status == OK) status = point_create(out, &search);
    if (status == OK) status = finish(&search, *out);
    search_free(&search);
    if (status == OK) return OK;
    critical_free(*out);
    *out = NULL;
    return status;
}
