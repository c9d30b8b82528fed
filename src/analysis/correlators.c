// SPDX-License-Identifier: GPL-3.0-or-later
// What is not a mean but a function of means: normalised scattering functions, the non-Gaussian
// parameter, the four-point susceptibility. The function is taken of the means over all replicas,
// f(all), and of those without each one of them, f(all but r); a replica's value is the jackknife's
// pseudo-value n f(all) - (n - 1) f(all but r) (Efron, The Jackknife, 1982), so that the mean over
// replicas is free of the bias of order 1/n that a mean of functions has, and its standard error
// is the jackknife's.
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

// Of the means of two elements; `constant` is the function's own.
typedef double (*OfMeans)(double first, double second, double constant);

// An element of a series, of every replica.
typedef struct Element {
    const ResultSeries *series;
    size_t index;
} Element;

static double value_of(const Element *element, size_t replica) {
    return element->series->values[replica * element->series->size + element->index];
}

// values[replica * stride]: NaN where a replica has no value.
static void jackknife(const Results *results, const Element *first, const Element *second,
                      OfMeans function, double constant, double *values, size_t stride) {
    double sums[2] = {0, 0}, n = 0;
    for (size_t r = 0; r < results->replicas; r++) {
        const double a = value_of(first, r), b = value_of(second, r);
        if (!isfinite(a) || !isfinite(b)) continue;
        sums[0] += a;
        sums[1] += b;
        n++;
    }
    const double of_all = function(sums[0] / n, sums[1] / n, constant);
    for (size_t r = 0; r < results->replicas; r++) {
        const double a = value_of(first, r), b = value_of(second, r);
        double *value = values + r * stride;
        *value = NAN;
        if (!isfinite(a) || !isfinite(b)) continue;
        *value = pseudo_value((size_t)n, of_all,
                              function((sums[0] - a) / (n - 1), (sums[1] - b) / (n - 1), constant));
    }
}

// Of each element of two series of one shape.
typedef struct Function {
    const char *name;
    const ResultSeries *first, *second;
    size_t times; // not 0: the second stands at the first of so many times, which are the last axis
    double (*constant_of)(const ResultSeries *series, size_t element, const System *system);
    OfMeans of;
} Function;

static void fill(const Results *results, const Function *function, const System *system,
                 double *values) {
    const ResultSeries *shape = function->first;
    for (size_t e = 0; e < shape->size; e++) {
        const Element first = {shape, e};
        const Element second = {function->second, function->times ? e - e % function->times : e};
        jackknife(results, &first, &second, function->of, function->constant_of(shape, e, system),
                  values + e, shape->size);
    }
}

static Status put(Results *results, const Function *function, const System *system) {
    ResultSeries shape = derive_shape(function->first, function->name);
    double *values = NULL;
    TRY(NEW_ARRAY(values, results->replicas * shape.size));
    fill(results, function, system, values);
    shape.unit[0] = '\0';
    Status status = OK;
    for (size_t r = 0; r < results->replicas && status == OK; r++) {
        status = results_put_series(results, &shape, r, values + r * shape.size);
    }
    memory_free(values);
    return status;
}

static double no_constant(const ResultSeries *series, size_t element, const System *system) {
    (void)series;
    (void)element;
    (void)system;
    return 0;
}

static double ratio(double first, double second, double constant) {
    (void)constant;
    return first / second;
}

static Status normalise(Results *results, const ResultSeries *ends, const char *observable,
                        const char *name) {
    const ResultSeries *scattering = results_find_series(results, ends->stage, observable);
    if (!scattering || scattering->size != ends->size) return OK;
    const Function function = {
        .name = name, .first = scattering, .second = ends, .constant_of = no_constant, .of = ratio};
    return put(results, &function, NULL);
}

Status derive_normalised_scattering(Results *results, const ResultSeries *ends) {
    return normalise(results, ends, "collective_scattering", "collective_scattering_normalised");
}

Status derive_centred_scattering(Results *results, const ResultSeries *ends) {
    return normalise(results, ends, "collective_scattering_about_centre",
                     "collective_scattering_centred");
}

// Over the structure factor of the time origins: where the flow takes q, there is another.
Status derive_normalised_advected(Results *results, const ResultSeries *scattering) {
    const Function function = {.name = "advected_scattering_normalised",
                               .first = scattering,
                               .second = scattering,
                               .times = scattering->axis[scattering->axes - 1].count,
                               .constant_of = no_constant,
                               .of = ratio};
    return put(results, &function, NULL);
}

static double dimension_of(const ResultSeries *series, size_t element, const System *system) {
    (void)series;
    (void)element;
    return (double)system->dimension;
}

static double non_gaussian(double quartic, double square, double dimension) {
    return dimension * quartic / ((dimension + 2) * square * square) - 1;
}

Status derive_non_gaussian(Results *results, const ResultSeries *quartic, const System *system) {
    const ResultSeries *squared =
        results_find_series(results, quartic->stage, "squared_displacement");
    if (!squared || squared->size != quartic->size) return OK;
    const Function function = {.name = "non_gaussian_parameter",
                               .first = quartic,
                               .second = squared,
                               .constant_of = dimension_of,
                               .of = non_gaussian};
    return put(results, &function, system);
}

// Of the species, or of all: their number.
static double particles_of(const ResultSeries *series, size_t element, const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    const size_t species = element / (series->size / series->axis[0].count);
    return (double)(species < system->species_count ? counts[species] : (size_t)system->particles);
}

static double variance(double square, double mean, double particles) {
    return particles * (square - mean * mean);
}

// Of what is seen from the box, or from the centre of mass.
Status derive_susceptibility(Results *results, const ResultSeries *square, const System *system) {
    const bool centred = strcmp(square->observable, "overlap_square_centred") == 0;
    const ResultSeries *overlap =
        results_find_series(results, square->stage, centred ? "overlap_centred" : "overlap");
    if (!overlap || overlap->size != square->size) return OK;
    const Function function = {.name = centred ? "four_point_susceptibility_centred"
                                               : "four_point_susceptibility",
                               .first = square,
                               .second = overlap,
                               .constant_of = particles_of,
                               .of = variance};
    return put(results, &function, system);
}
