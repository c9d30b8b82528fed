// SPDX-License-Identifier: GPL-3.0-or-later
// Fits of measured structure factors: penalised splines (Eilers & Marx, Statist. Sci. 11, 89, 1996)
// whose penalty is chosen by generalised cross-validation (Golub, Heath & Wahba, Technometrics 21,
// 215, 1979).
#include "oz/measured.h"

#include "base/constants.h"
#include "base/memory.h"
#include "numerics/quadrature.h"
#include "numerics/small.h"
#include "oz/inside.h"

#include <gsl/gsl_bspline.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_sf_bessel.h>

#include <math.h>
#include <string.h>

// Cubic splines on equal intervals: inside contact; from there on to RANGE, where value and slope
// vanish. The coefficient at either end of a piece is the value there.
enum { ORDER = 4, POINTS = 6, INTERVALS_LEAST = 4, INTERVALS_MOST = 60, STATES_MOST = 32 };
enum { SPLINES_MOST = 2 * (INTERVALS_MOST + ORDER), REGULARISATIONS = 200, DEGREE_MOST = 2 };
static const double RANGE = 2;          // beyond contact, in the largest diameter
static const double RESOLUTION = 0.7;   // intervals per half of the shortest wave length
static const double LAST_LEAST = 10;    // of the last wave number, times the largest diameter
static const double LAST_CHANGE = 0.05; // of it, from state to state
static const double OUTSIDE = 0.5;      // how far from the states, in the range that they span,
static const double OUTSIDE_ONE = 0.02; // and around a single one, in its packing fraction
enum { NEIGHBOURS = 10 };               // on either side, over which errors are averaged

typedef struct FittedState {
    double packing_fraction;
    double *coefficient[MIXTURE_PAIRS_MOST]; // [splines of the pair]
} FittedState;

struct Measured {
    Mixture mixture;
    double last; // wave number of the first state
    size_t states;
    FittedState state[STATES_MOST];
    double squares, points; // sums over all fits
};

// ---- Splines -----------------------------------------------------------------------------------

// The two pieces of a pair, and how many splines are in each.
typedef struct Pieces {
    double contact, end;
    size_t core_intervals, tail_intervals, core, splines;
} Pieces;

static size_t intervals_in(double length, double last) {
    const double wanted = floor(RESOLUTION * length * last / PI);
    return (size_t)fmin(INTERVALS_MOST, fmax(INTERVALS_LEAST, wanted));
}

static Pieces pieces_of(const Measured *measured, size_t a, size_t b) {
    const Mixture *mixture = &measured->mixture;
    Pieces pieces = {.contact = mixture_contact(mixture, a, b)};
    double largest = 0;
    for (size_t s = 0; s < mixture->species; s++) largest = fmax(largest, mixture->diameter[s]);
    pieces.end = pieces.contact + RANGE * largest;
    pieces.core_intervals = intervals_in(pieces.contact, measured->last);
    pieces.tail_intervals = intervals_in(RANGE * largest, measured->last);
    pieces.core = pieces.core_intervals + ORDER - 1;
    pieces.splines = pieces.core + pieces.tail_intervals + ORDER - 3; // without the last two
    return pieces;
}

// exp(iqr) averaged over directions, times the surface of the sphere of radius r.
static double wave(int dimension, double q, double r) {
    const double x = q * r;
    if (dimension == 2) return 2 * PI * r * gsl_sf_bessel_J0(x);
    return 4 * PI * r * r * gsl_sf_bessel_j0(x);
}

// Adds the transforms of the first splines on [from, to], as many as are `kept`, to
// transform[wave number][stride].
static void transform_piece(int dimension, double from, double to, size_t intervals, size_t kept,
                            const double *q, size_t count, double *transform, size_t stride) {
    gsl_bspline_workspace *splines = gsl_bspline_alloc(ORDER, intervals + 1);
    gsl_vector *values = gsl_vector_alloc(intervals + ORDER - 1);
    const double width = (to - from) / (double)intervals;
    gsl_bspline_knots_uniform(from, to, splines);
    for (size_t i = 0; i < intervals; i++) {
        double r[POINTS], weight[POINTS];
        quadrature_legendre(POINTS, from + (double)i * width, from + (double)(i + 1) * width, r,
                            weight);
        for (size_t p = 0; p < POINTS; p++) {
            gsl_bspline_eval(r[p], values, splines);
            for (size_t m = 0; m < count; m++) {
                const double factor = weight[p] * wave(dimension, q[m], r[p]);
                // Of cubic splines, four are not zero on an interval.
                for (size_t n = i; n < i + ORDER && n < kept; n++)
                    transform[m * stride + n] += factor * gsl_vector_get(values, n);
            }
        }
    }
    gsl_vector_free(values);
    gsl_bspline_free(splines);
}

size_t measured_splines(const Measured *measured, size_t a, size_t b) {
    return pieces_of(measured, a, b).splines;
}

void measured_transforms(const Measured *measured, size_t a, size_t b, const double *q,
                         size_t count, double *transform) {
    const Pieces pieces = pieces_of(measured, a, b);
    const int dimension = measured->mixture.dimension;
    memset(transform, 0, count * pieces.splines * sizeof *transform);
    transform_piece(dimension, 0, pieces.contact, pieces.core_intervals, pieces.core, q, count,
                    transform, pieces.splines);
    transform_piece(dimension, pieces.contact, pieces.end, pieces.tail_intervals,
                    pieces.splines - pieces.core, q, count, transform + pieces.core,
                    pieces.splines);
}

// ---- One state ---------------------------------------------------------------------------------

// What is known of one state at its wave numbers.
typedef struct Sample {
    const MeasuredState *state;
    size_t species, pairs, groups, omitted;
    size_t replicas;    // that are not left out
    double *factor;     // [pair][count]: their mean
    double *difference; // [pair][count]: of c from the reference
    double *variance;   // [pair][count]: of c
    double *relative;   // [count]: variance of S_ab over S_aa S_bb + S_ab^2
} Sample;

static bool takes(const Sample *sample, size_t replica) {
    return sample->groups < 2 || replica % sample->groups != sample->omitted;
}

static const double *factor_of(const Sample *sample, size_t replica, size_t pair) {
    return sample->state->factor + (replica * sample->pairs + pair) * sample->state->count;
}

static Status sample_create(Sample *sample, const Mixture *mixture, const MeasuredState *state,
                            size_t groups, size_t omitted) {
    *sample = (Sample){.state = state,
                       .species = mixture->species,
                       .pairs = mixture_pairs(mixture),
                       .groups = state->replicas > 1 ? groups : 0,
                       .omitted = omitted};
    TRY(NEW_ARRAY(sample->factor, sample->pairs * state->count));
    TRY(NEW_ARRAY(sample->difference, sample->pairs * state->count));
    TRY(NEW_ARRAY(sample->variance, sample->pairs * state->count));
    TRY(NEW_ARRAY(sample->relative, state->count));
    for (size_t r = 0; r < state->replicas; r++) sample->replicas += takes(sample, r);
    for (size_t r = 0; r < state->replicas; r++) {
        for (size_t pair = 0; takes(sample, r) && pair < sample->pairs; pair++) {
            for (size_t m = 0; m < state->count; m++)
                sample->factor[pair * state->count + m] +=
                    factor_of(sample, r, pair)[m] / (double)sample->replicas;
        }
    }
    return OK;
}

static void sample_free(Sample *sample) {
    memory_free(sample->factor);
    memory_free(sample->difference);
    memory_free(sample->variance);
    memory_free(sample->relative);
}

// Densities rho_a(q) are Gaussian: S_ab of n independent ones has the variance (S_aa S_bb +
// S_ab^2)/(2 n) and S^-1 likewise. What is left to find is n, which changes slowly with q: from
// what replicas differ, averaged over pairs and neighbours. Of one replica only its dependence on q
// is known, that of the number of wave vectors in a shell of equal width.
static void find_errors(Sample *sample, int dimension) {
    const size_t count = sample->state->count;
    double *raw = sample->variance; // for a while
    for (size_t m = 0; m < count; m++) {
        double sum = 0;
        for (size_t a = 0; a < sample->species; a++) {
            for (size_t b = a; b < sample->species; b++) {
                const size_t pair = mixture_pair(sample->species, a, b);
                const double aa = sample->factor[mixture_pair(sample->species, a, a) * count + m];
                const double bb = sample->factor[mixture_pair(sample->species, b, b) * count + m];
                const double ab = sample->factor[pair * count + m];
                for (size_t r = 0; r < sample->state->replicas; r++) {
                    if (takes(sample, r))
                        sum += pow(factor_of(sample, r, pair)[m] - ab, 2) / (aa * bb + ab * ab);
                }
            }
        }
        const double n = (double)sample->replicas;
        raw[m] = n > 1 ? sum / (double)sample->pairs / (n * (n - 1))
                       : pow(sample->state->wave_number[m], 1 - dimension);
    }
    for (size_t m = 0; m < count; m++) {
        const size_t low = m < NEIGHBOURS ? 0 : m - NEIGHBOURS;
        const size_t high = m + NEIGHBOURS < count ? m + NEIGHBOURS + 1 : count;
        for (size_t k = low; k < high; k++) sample->relative[m] += raw[k] / (double)(high - low);
    }
}

// rho c = 1/x - S^-1, less the reference, and its variance.
static Status find_difference(Sample *sample, const Structure *reference, size_t m) {
    const size_t species = sample->species, count = sample->state->count;
    const double density = reference->density;
    SmallMatrix factor = {{0}}, inverse;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++)
            factor[a][b] = sample->factor[mixture_pair(species, a, b) * count + m];
    }
    if (!small_is_positive(species, factor) || !small_invert(species, factor, inverse))
        return status_fail(BAD_DATA,
                           "the measured structure factor at packing fraction %g is not positive "
                           "at q = %g",
                           sample->state->packing_fraction, sample->state->wave_number[m]);
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            const size_t at = mixture_pair(species, a, b) * count + m;
            const double direct =
                ((a == b) / reference->mixture.fraction[a] - inverse[a][b]) / density;
            sample->difference[at] = direct - reference->direct[at];
            sample->variance[at] = sample->relative[m] *
                                   (inverse[a][a] * inverse[b][b] + inverse[a][b] * inverse[a][b]) /
                                   (density * density);
        }
    }
    return OK;
}

static Status prepare_sample(Sample *sample, const Mixture *mixture) {
    const MeasuredState *state = sample->state;
    Oz *oz = NULL;
    const Structure *reference = NULL;
    find_errors(sample, mixture->dimension);
    TRY(oz_create(&oz, CLOSURE_PERCUS_YEVICK, mixture, state->wave_number, state->count));
    Status status = oz_solve(oz, state->packing_fraction, &reference);
    for (size_t m = 0; m < state->count && status == OK; m++)
        status = find_difference(sample, reference, m);
    oz_free(oz);
    return status;
}

// ---- The fit -----------------------------------------------------------------------------------

// Second differences of the coefficients, inside contact and outside by themselves; beyond the last
// coefficient outside there are zeros.
static void fill_penalty(gsl_matrix *penalty, const Pieces *pieces) {
    static const double second[] = {1, -2, 1};
    gsl_matrix_set_zero(penalty);
    for (size_t row = 0; row < pieces->splines - 2; row++) {
        const bool core = row < pieces->core - 2;
        const size_t first = core ? row : row + 2;
        for (size_t k = 0; k < 3 && first + k < (core ? pieces->core : pieces->splines); k++)
            gsl_matrix_set(penalty, row, first + k, second[k]);
    }
}

// What GSL needs for a weighted fit with a penalty.
typedef struct Fit {
    gsl_matrix *waves, *penalty, *standard, *work;
    gsl_vector *values, *weights, *standard_values, *standard_coefficients, *coefficients, *tau;
    gsl_vector *tried, *scores;
    gsl_multifit_linear_workspace *linear;
} Fit;

static Fit fit_create(size_t count, size_t splines) {
    const size_t penalties = splines - 2, rows = count - splines + penalties;
    return (Fit){.waves = gsl_matrix_alloc(count, splines),
                 .penalty = gsl_matrix_alloc(penalties, splines),
                 .standard = gsl_matrix_alloc(rows, penalties),
                 .work = gsl_matrix_alloc(count, splines),
                 .values = gsl_vector_alloc(count),
                 .weights = gsl_vector_alloc(count),
                 .standard_values = gsl_vector_alloc(rows),
                 .standard_coefficients = gsl_vector_alloc(penalties),
                 .coefficients = gsl_vector_alloc(splines),
                 .tau = gsl_vector_alloc(penalties),
                 .tried = gsl_vector_alloc(REGULARISATIONS),
                 .scores = gsl_vector_alloc(REGULARISATIONS),
                 .linear = gsl_multifit_linear_alloc(count, splines)};
}

static void fit_free(Fit *fit) {
    gsl_matrix *const matrices[] = {fit->waves, fit->penalty, fit->standard, fit->work};
    gsl_vector *const vectors[] = {
        fit->values, fit->weights, fit->standard_values, fit->standard_coefficients,
        fit->tau,    fit->tried,   fit->scores,          fit->coefficients};
    for (size_t i = 0; i < sizeof matrices / sizeof *matrices; i++) gsl_matrix_free(matrices[i]);
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) gsl_vector_free(vectors[i]);
    gsl_multifit_linear_free(fit->linear);
}

static void fit_solve(Fit *fit) {
    double penalty, score, residual, size;
    gsl_multifit_linear_L_decomp(fit->penalty, fit->tau);
    gsl_multifit_linear_wstdform2(fit->penalty, fit->tau, fit->waves, fit->weights, fit->values,
                                  fit->standard, fit->standard_values, fit->work, fit->linear);
    gsl_multifit_linear_svd(fit->standard, fit->linear);
    gsl_multifit_linear_gcv(fit->standard_values, fit->tried, fit->scores, &penalty, &score,
                            fit->linear);
    gsl_multifit_linear_solve(penalty, fit->standard, fit->standard_values,
                              fit->standard_coefficients, &residual, &size, fit->linear);
    gsl_multifit_linear_wgenform2(fit->penalty, fit->tau, fit->waves, fit->weights, fit->values,
                                  fit->standard_coefficients, fit->work, fit->coefficients,
                                  fit->linear);
}

// One pair; adds to the sum of the squares of (c - fit)/error.
static void fit_pair(const Pieces *pieces, const Sample *sample, size_t pair,
                     const double *transform, double *coefficients, double *squares) {
    const size_t count = sample->state->count, splines = pieces->splines;
    Fit fit = fit_create(count, splines);
    fill_penalty(fit.penalty, pieces);
    for (size_t m = 0; m < count; m++) {
        gsl_vector_set(fit.values, m, sample->difference[pair * count + m]);
        gsl_vector_set(fit.weights, m, 1 / sample->variance[pair * count + m]);
        for (size_t n = 0; n < splines; n++)
            gsl_matrix_set(fit.waves, m, n, transform[m * splines + n]);
    }
    fit_solve(&fit);
    for (size_t n = 0; n < splines; n++) coefficients[n] = gsl_vector_get(fit.coefficients, n);
    for (size_t m = 0; m < count; m++) {
        double left = sample->difference[pair * count + m];
        for (size_t n = 0; n < splines; n++) left -= coefficients[n] * transform[m * splines + n];
        *squares += left * left / sample->variance[pair * count + m];
    }
    fit_free(&fit);
}

static Status fit_all(Measured *measured, const Sample *sample) {
    const size_t species = sample->species;
    const MeasuredState *state = sample->state;
    FittedState *fitted = &measured->state[measured->states++];
    double *transform = NULL, squares = 0;
    TRY(NEW_ARRAY(transform, state->count * SPLINES_MOST));
    Status status = OK;
    for (size_t a = 0; a < species && status == OK; a++) {
        for (size_t b = a; b < species && status == OK; b++) {
            const size_t pair = mixture_pair(species, a, b);
            const Pieces pieces = pieces_of(measured, a, b);
            status = NEW_ARRAY(fitted->coefficient[pair], pieces.splines);
            if (status != OK) continue;
            measured_transforms(measured, a, b, state->wave_number, state->count, transform);
            fit_pair(&pieces, sample, pair, transform, fitted->coefficient[pair], &squares);
        }
    }
    memory_free(transform);
    fitted->packing_fraction = state->packing_fraction;
    measured->squares += sample->replicas > 1 ? squares : NAN;
    measured->points += (double)(sample->pairs * state->count);
    return status;
}

// ---- All states --------------------------------------------------------------------------------

Status measured_create(Measured **out, const Mixture *mixture) {
    TRY(mixture_check(mixture));
    TRY(NEW(*out));
    (*out)->mixture = *mixture;
    return OK;
}

void measured_free(Measured *measured) {
    for (size_t s = 0; measured && s < measured->states; s++) {
        for (size_t pair = 0; pair < MIXTURE_PAIRS_MOST; pair++)
            memory_free(measured->state[s].coefficient[pair]);
    }
    memory_free(measured);
}

static Status check_last(const Measured *measured, const MeasuredState *state) {
    const double last = state->wave_number[state->count - 1];
    double largest = 0;
    for (size_t a = 0; a < measured->mixture.species; a++)
        largest = fmax(largest, measured->mixture.diameter[a]);
    if (last * largest < LAST_LEAST)
        return status_fail(BAD_DATA,
                           "a measured structure factor ends at q = %g, before %g over the largest "
                           "diameter",
                           last, LAST_LEAST);
    if (measured->states > 0 && fabs(last / measured->last - 1) > LAST_CHANGE)
        return status_fail(BAD_DATA,
                           "measured structure factors end at q = %g and %g; all must end at the "
                           "same",
                           measured->last, last);
    return OK;
}

static Status check_state(const Measured *measured, const MeasuredState *state) {
    if (measured->states == STATES_MOST)
        return status_fail(BAD_DATA, "more than %d measured structure factors", STATES_MOST);
    for (size_t s = 0; s < measured->states; s++) {
        if (measured->state[s].packing_fraction == state->packing_fraction)
            return status_fail(BAD_DATA, "packing fraction %g was measured twice",
                               state->packing_fraction);
    }
    return check_last(measured, state);
}

static Status check_count(const Measured *measured, const MeasuredState *state) {
    const size_t species = measured->mixture.species;
    size_t needed = 0;
    for (size_t a = 0; a < species; a++) {
        const size_t splines = measured_splines(measured, a, a);
        if (2 * splines > needed) needed = 2 * splines;
    }
    if (state->count >= needed) return OK;
    return status_fail(BAD_DATA,
                       "a measured structure factor with %zu wave numbers up to %g; smoothing "
                       "needs %zu",
                       state->count, measured->last, needed);
}

Status measured_add(Measured *measured, const MeasuredState *state, size_t groups, size_t omitted) {
    Sample sample;
    TRY(check_state(measured, state));
    if (measured->states == 0) measured->last = state->wave_number[state->count - 1];
    TRY(check_count(measured, state));
    Status status = sample_create(&sample, &measured->mixture, state, groups, omitted);
    if (status == OK) status = prepare_sample(&sample, &measured->mixture);
    if (status == OK) status = fit_all(measured, &sample);
    sample_free(&sample);
    return status;
}

const Mixture *measured_mixture(const Measured *measured) {
    return &measured->mixture;
}

double measured_lowest(const Measured *measured) {
    double lowest = 1;
    for (size_t s = 0; s < measured->states; s++)
        lowest = fmin(lowest, measured->state[s].packing_fraction);
    return lowest;
}

double measured_highest(const Measured *measured) {
    double highest = 0;
    for (size_t s = 0; s < measured->states; s++)
        highest = fmax(highest, measured->state[s].packing_fraction);
    return highest;
}

double measured_misfit(const Measured *measured) {
    return measured->squares / measured->points;
}

static Status check_range(const Measured *measured, double packing_fraction) {
    const double low = measured_lowest(measured), high = measured_highest(measured);
    const double margin = measured->states > 1 ? OUTSIDE * (high - low) : OUTSIDE_ONE * low;
    if (packing_fraction >= low - margin && packing_fraction <= high + margin) return OK;
    if (measured->states > 1)
        return status_fail(UNHEALTHY,
                           "packing fraction %g is far from where the structure was measured, %g "
                           "to %g",
                           packing_fraction, low, high);
    return status_fail(UNHEALTHY,
                       "packing fraction %g is not %g, where alone the structure was measured",
                       packing_fraction, low);
}

// Weights of the states in the value, at this packing fraction, of the polynomial that comes
// closest to them: none, a straight line, or a parabola.
static void state_weights(const Measured *measured, double packing_fraction,
                          double weights[STATES_MOST]) {
    const size_t states = measured->states;
    const size_t powers = states - 1 < DEGREE_MOST ? states : DEGREE_MOST + 1;
    SmallMatrix normal = {{0}}, inverse;
    double mean = 0, power[STATES_MOST][DEGREE_MOST + 1], here[DEGREE_MOST + 1];
    for (size_t s = 0; s < states; s++)
        mean += measured->state[s].packing_fraction / (double)states;
    for (size_t k = 0; k < powers; k++) here[k] = pow(packing_fraction - mean, (double)k);
    for (size_t s = 0; s < states; s++) {
        for (size_t k = 0; k < powers; k++)
            power[s][k] = pow(measured->state[s].packing_fraction - mean, (double)k);
        for (size_t k = 0; k < powers; k++) {
            for (size_t l = 0; l < powers; l++) normal[k][l] += power[s][k] * power[s][l];
        }
    }
    ASSERT(small_invert(powers, normal, inverse));
    for (size_t s = 0; s < states; s++) {
        weights[s] = 0;
        for (size_t k = 0; k < powers; k++) {
            for (size_t l = 0; l < powers; l++) weights[s] += here[k] * inverse[k][l] * power[s][l];
        }
    }
}

Status measured_coefficients(const Measured *measured, double packing_fraction, size_t a, size_t b,
                             double *coefficients) {
    const Pieces pieces = pieces_of(measured, a, b);
    const size_t pair = mixture_pair(measured->mixture.species, a, b);
    double weights[STATES_MOST];
    TRY(check_range(measured, packing_fraction));
    state_weights(measured, packing_fraction, weights);
    for (size_t n = 0; n < pieces.splines; n++) {
        coefficients[n] = 0;
        for (size_t s = 0; s < measured->states; s++)
            coefficients[n] += weights[s] * measured->state[s].coefficient[pair][n];
    }
    return OK;
}

double measured_step(const Measured *measured, size_t a, size_t b, const double *coefficients) {
    const Pieces pieces = pieces_of(measured, a, b);
    return coefficients[pieces.core] - coefficients[pieces.core - 1];
}
