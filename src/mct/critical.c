// SPDX-License-Identifier: GPL-3.0-or-later
// The glass transition along x, the packing fraction or another number of a mixture. Near it x =
// x_c + a2 s^2 + a3 s^3 + ... with s = 1 - E, E the largest
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
static const double CURVATURE = 0.3;   // of x/x_c in s, a guess
static const double TOLERANCE = 0.4;   // of what is aimed at: how far a state may lie from it
static const double NEARER = 0.4;      // of s: what is aimed at from far, lest it be a fluid, which
                                       // takes longest to tell near the transition
static const double SLOPE_STEP = 1e-3; // of x/x_c, for the derivative of sigma
static const double STRAIN = 1e-3;     // for the derivative of sigma with its square

// Places are values of x, with the other sign where the glass lies below the fluid: so it is always
// above.
typedef struct CriticalState {
    double place, s, lambda;
    double *form, *right, *left;
} CriticalState;

typedef struct Search {
    const CriticalSearch *wanted;
    MixtureLine line;
    double sign;   // of places
    double solved; // place of the mixture whose structure `oz` solves
    Oz *oz;
    Grid *grid;
    Model *model;
    Stability stability;
    double *form;
    double form_of;               // place of the glass that it is of; 0: of none
    double low;                   // the fluid known that is nearest to the glass
    double high, s;               // the glass seen last
    double high_before, s_before; // and the one before it; 0: none
    CriticalState states[STATES];
    size_t found;
    size_t evaluations;
} Search;

static const char *name_of(const CriticalSearch *wanted) {
    return wanted->name ? wanted->name : "packing fraction";
}

static bool is_packing(const Search *search) {
    return search->wanted->axis == MIXTURE_PACKING_FRACTION;
}

static Status create_oz(Search *search, const Mixture *mixture) {
    const CriticalSearch *wanted = search->wanted;
    const double *q = search->grid->wave_number;
    const size_t count = search->grid->count;
    oz_free(search->oz);
    search->oz = NULL;
    return wanted->measured ? oz_create_measured(&search->oz, wanted->measured, q, count)
                            : oz_create(&search->oz, wanted->closure, mixture, q, count);
}

// Along the packing fraction solutions are followed; another mixture is solved anew.
static Status solve_at(Search *search, double place, const Structure **structure) {
    Mixture mixture;
    double packing_fraction;
    mixture_on(&search->line, search->sign * place, &mixture, &packing_fraction);
    if (!is_packing(search) && place != search->solved) {
        TRY(create_oz(search, &mixture));
        search->solved = place;
    }
    return oz_solve(search->oz, packing_fraction, structure);
}

// The structure of the densest glass to begin with: some closures have no solution as dense as
// asked for, and are asked for less.
static Status solve_high(Search *search, const Structure **structure) {
    Status status = solve_at(search, search->high, structure);
    for (int tries = 0; status == UNHEALTHY && is_packing(search) && tries < LOWERINGS; tries++) {
        search->high -= LOWERING * (search->high - search->low);
        status = solve_at(search, search->high, structure);
    }
    return status;
}

static Status search_create(Search *search, const CriticalSearch *wanted) {
    const Structure *structure = NULL;
    *search =
        (Search){.wanted = wanted,
                 .line = {wanted->axis, wanted->species, wanted->mixture, wanted->packing_fraction},
                 .sign = 1,
                 .solved = NAN,
                 .low = wanted->low,
                 .high = wanted->high};
    TRY(grid_create(&search->grid, wanted->mixture.dimension, wanted->count, wanted->last));
    TRY(create_oz(search, &wanted->mixture));
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
static Status look(Search *search, double place, bool *glass) {
    const Structure *structure = NULL;
    TRY(solve_at(search, place, &structure));
    model_set(search->model, structure);
    // From above: the form factors of a denser glass, or S.
    const bool denser = is_packing(search) && place <= search->form_of;
    if (!denser) memcpy(search->form, search->model->factor, search->model->size * sizeof(double));
    search->form_of = place;
    TRY(glass_form_factors(search->model, search->form, glass));
    search->evaluations++;
    if (!*glass) {
        search->form_of = 0;
        search->low = fmax(search->low, place);
        return OK;
    }
    TRY(glass_stability(search->model, search->form, &search->stability));
    search->high_before = search->high;
    search->s_before = search->s;
    search->high = place;
    search->s = 1 - search->stability.eigenvalue;
    return OK;
}

// Of other numbers than the packing fraction, either end may be the glass.
static Status look_at_ends(Search *search) {
    const CriticalSearch *wanted = search->wanted;
    bool at_high, at_low;
    TRY(look(search, wanted->high, &at_high));
    search->low = -INFINITY; // not known to be a fluid
    TRY(look(search, wanted->low, &at_low));
    if (at_high == at_low)
        return status_fail(BAD_DATA,
                           "%s from %g to %g: at both ends there is a %s, so that no transition is "
                           "between them, or two; give another search.low and search.high",
                           name_of(wanted), wanted->low, wanted->high, at_high ? "glass" : "fluid");
    search->sign = at_high ? 1 : -1;
    search->low = at_high ? wanted->low : -wanted->high;
    search->s = 0; // of no glass before
    return look(search, at_high ? wanted->high : -wanted->low, &at_high);
}

static Status look_at_densest(Search *search) {
    bool glass;
    TRY(look(search, search->high, &glass));
    return glass ? OK
                 : status_fail(BAD_DATA, "at packing fraction %g there is no glass", search->high);
}

static Status bisect(Search *search) {
    const CriticalSearch *wanted = search->wanted;
    bool glass;
    TRY(is_packing(search) ? look_at_densest(search) : look_at_ends(search));
    for (int step = 0; step < BISECTIONS_MOST && search->s > NEAR; step++)
        TRY(look(search, (search->low + search->high) / 2, &glass));
    if (!is_packing(search) || search->low > wanted->low) return OK;
    TRY(look(search, wanted->low, &glass));
    return glass ? status_fail(BAD_DATA, "at packing fraction %g there is a glass already",
                               wanted->low)
                 : OK;
}

// place = sum_n coefficient[n] s^(n > 0 ? n + 1 : 0) through the states: no term linear in s.
static void fit_places(const Search *search, double coefficients[STATES]) {
    const size_t n = search->found;
    gsl_matrix *powers = gsl_matrix_alloc(n, n);
    gsl_vector *values = gsl_vector_alloc(n);
    gsl_permutation *order = gsl_permutation_alloc(n);
    int sign;
    for (size_t i = 0; i < n; i++) {
        gsl_vector_set(values, i, search->states[i].place);
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

// The place at which s should be this, by what is known so far; halfway to the fluid if
// that is no glass.
static double aim(const Search *search, double s) {
    double coefficients[STATES], next;
    if (search->found > 1) {
        fit_places(search, coefficients);
        next = coefficients[0];
        for (size_t k = 1; k < search->found; k++) next += coefficients[k] * pow(s, (double)k + 1);
    } else {
        const double square = search->s * search->s, before = pow(search->s_before, 2);
        const double curvature = search->s_before > 0 && before != square
                                     ? (search->high_before - search->high) / (before - square)
                                     : CURVATURE * fabs(search->high);
        next = search->high - curvature * (square - s * s);
    }
    return next > search->low ? next : (search->low + search->high) / 2;
}

static void keep(Search *search, double place) {
    CriticalState *state = &search->states[search->found++];
    const size_t bytes = search->model->size * sizeof(double);
    state->place = place;
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
            return status_fail(UNHEALTHY, "critical point: lost between %s %.8f and %.8f",
                               name_of(search->wanted), search->sign * search->low,
                               search->sign * search->high);
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
    fit_places(search, coefficients);
    point->value = search->sign * coefficients[0];
    mixture_on(&search->line, point->value, &point->mixture, &point->packing_fraction);
    point->curvature = search->sign * coefficients[1];
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

static Status separation_at(Search *search, double place, double *separation) {
    const Structure *structure = NULL;
    TRY(solve_at(search, place, &structure));
    model_set(search->model, structure);
    return glass_separation(search->model, search->states[0].form, search->states[0].left,
                            separation);
}

// c of both vertices at the mean of what it is at rest and at wave numbers that a strain stretches.
static Status strain_direct(Search *search, const Structure *structure) {
    const size_t species = search->model->species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            double *direct =
                search->model->direct + mixture_pair(species, a, b) * search->grid->stride;
            Stretch *stretch = NULL;
            TRY(stretch_create(&stretch, search->grid, structure, a, b));
            const double *stretched = stretch_direct(stretch, STRAIN);
            for (size_t m = 0; m < search->grid->count; m++)
                direct[m] = (direct[m] + stretched[m]) / 2;
            stretch_free(stretch);
        }
    }
    return OK;
}

// What a strain takes from sigma, over its square, at the transition. The left vector, symmetric in
// the species, sees of a kernel with one vertex stretched, c and c', the mean with that of c' and
// c: M at the mean of c and c' in both vertices, but for a quarter of M at their difference.
static Status find_shear(Search *search, const Structure *structure, double *shear) {
    Model *model = search->model;
    const CriticalState *critical = &search->states[0];
    double rest, strained;
    model_set(model, structure);
    TRY(glass_separation(model, critical->form, critical->left, &rest));
    TRY(strain_direct(search, structure));
    TRY(glass_separation(model, critical->form, critical->left, &strained));
    model_set(model, structure);
    *shear = (rest - strained) / (STRAIN * STRAIN);
    return OK;
}

static Status finish(Search *search, CriticalPoint *point) {
    double above, below;
    const Structure *structure = NULL;
    TRY(extrapolate(search, point));
    const double place = search->sign * point->value;
    TRY(separation_at(search, place * (1 + SLOPE_STEP), &above));
    TRY(separation_at(search, place * (1 - SLOPE_STEP), &below));
    point->slope = (above - below) / (2 * SLOPE_STEP);
    point->expected_curvature = point->value / (4 * point->slope * (1 - point->exponents.lambda));
    TRY(solve_at(search, place, &structure));
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
    if (status == OK) status = bisect(&search);
    if (status == OK) status = gather_states(&search);
    if (status == OK) status = point_create(out, &search);
    if (status == OK) status = finish(&search, *out);
    search_free(&search);
    if (status == OK) return OK;
    critical_free(*out);
    *out = NULL;
    return status;
}
