// SPDX-License-Identifier: GPL-3.0-or-later
// What stresses under shear are made of: the overshoot of a start-up (Weysser, thesis, ch. 5.3) and
// how far from linear the response to an oscillation is (ch. 6.2). Both are functions of means over
// replicas, so each replica is given the jackknife's pseudo-value.
#include "analysis/derive.h"
#include "base/memory.h"
#include "numerics/fit.h"

#include <math.h>
#include <string.h>

// The shear stress against strain, a mean over replicas.
typedef struct StartUp {
    const double *strain;
    double *stress; // [count]
    size_t count;
} StartUp;

typedef struct Overshoot {
    double strain, peak, steady;
} Overshoot;

static const double NEAR_PEAK = 0.93; // of the highest stress: what the parabola is laid through
static const double RISES_FROM = 0.5; // of it: a stage that begins above was flowing before
enum { PEAK_LEAST = 5, ALL = -1, PARTS = 40 };

static void mean_without(const ResultSeries *series, size_t replicas, int64_t left_out,
                         StartUp *mean) {
    for (size_t k = 0; k < mean->count; k++) {
        double sum = 0, number = 0;
        for (size_t r = 0; r < replicas; r++) {
            const double value = series->values[r * series->size + k]; // the first row is sigma_xy
            if ((int64_t)r == left_out || !isfinite(value)) continue;
            sum += value;
            number++;
        }
        mean->stress[k] = sum / number;
    }
}

// Mean over a fortieth of the stage round a window, so that noise does not make the peak.
static double smooth(const StartUp *mean, size_t window) {
    const size_t reach = mean->count / (2 * PARTS);
    const size_t begin = window > reach ? window - reach : 0;
    double sum = 0, number = 0;
    for (size_t k = begin; k <= window + reach && k < mean->count; k++, number++) {
        sum += mean->stress[k];
    }
    return sum / number;
}

// Windows [begin, end) round the highest whose stress is near its, seen from either side, and no
// fewer than a parabola needs; returns the highest.
static double near_peak(const StartUp *mean, double sign, size_t *begin, size_t *end) {
    size_t top = 0;
    for (size_t k = 1; k < mean->count; k++) {
        if (sign * smooth(mean, k) > sign * smooth(mean, top)) top = k;
    }
    const double highest = sign * smooth(mean, top), least = NEAR_PEAK * highest;
    *begin = *end = top;
    while (*begin > 0 && sign * smooth(mean, *begin - 1) > least) --*begin;
    while (*end < mean->count && sign * smooth(mean, *end) > least) ++*end;
    while (*begin > 0 && *end < mean->count && *end - *begin < PEAK_LEAST) {
        if (sign * smooth(mean, *begin - 1) > sign * smooth(mean, *end))
            --*begin;
        else
            ++*end;
    }
    return highest;
}

// The windows of the peak are those of the mean over all replicas. False if the parabola through
// them has no top among them: too few windows, or too much noise, to say where it is.
static bool overshoot_of(const StartUp *mean, size_t begin, size_t end, Overshoot *overshoot) {
    const size_t half = mean->count / 2;
    overshoot->steady = 0;
    for (size_t k = half; k < mean->count; k++) overshoot->steady += mean->stress[k];
    overshoot->steady /= (double)(mean->count - half);
    const double bend = fit_parabola_top(mean->strain + begin, mean->stress + begin, end - begin,
                                         &overshoot->strain, &overshoot->peak);
    return bend * overshoot->peak < 0 && overshoot->strain >= mean->strain[begin] &&
           overshoot->strain <= mean->strain[end - 1];
}

// With all replicas, and `without[r]` with all but one; false if one of them has no top.
static bool find_overshoots(const ResultSeries *series, size_t replicas, StartUp *mean,
                            size_t begin, size_t end, Overshoot *all, Overshoot *without) {
    if (!overshoot_of(mean, begin, end, all)) return false;
    for (size_t r = 0; r < replicas; r++) {
        if (replicas > 1) mean_without(series, replicas, (int64_t)r, mean);
        if (!overshoot_of(mean, begin, end, &without[r])) return false;
    }
    return true;
}

static Status put_overshoot(Results *results, const ResultSeries *series, size_t replica,
                            Overshoot all, Overshoot without) {
    const size_t n = results->replicas;
    const char *stage = series->stage;
    TRY(results_put_scalar(results, stage, "overshoot_strain", "", NULL, replica,
                           pseudo_value(n, all.strain, without.strain)));
    TRY(results_put_scalar(results, stage, "overshoot_stress", series->unit, NULL, replica,
                           pseudo_value(n, all.peak, without.peak)));
    return results_put_scalar(
        results, stage, "overshoot_height", "", NULL, replica,
        pseudo_value(n, all.peak / all.steady - 1, without.peak / without.steady - 1));
}

static Status derive_overshoot(Results *results, const ResultSeries *series, StartUp *mean) {
    size_t begin = 0, end = 0;
    mean_without(series, results->replicas, ALL, mean);
    while (mean->count > 0 && !isfinite(mean->stress[mean->count - 1]))
        mean->count--; // ended early
    if (mean->count < 4 * PEAK_LEAST) return OK;
    const double sign = smooth(mean, mean->count - 1) < 0 ? -1 : 1;
    const double highest = near_peak(mean, sign, &begin, &end);
    // Before it the stress must have been seen to rise, after it to fall.
    if (begin == 0 || sign * mean->stress[0] > RISES_FROM * highest || end >= mean->count / 2 ||
        end - begin < PEAK_LEAST)
        return OK;
    Overshoot all, *without = NULL;
    TRY(NEW_ARRAY(without, results->replicas));
    Status status = OK;
    if (find_overshoots(series, results->replicas, mean, begin, end, &all, without)) {
        for (size_t r = 0; r < results->replicas && status == OK; r++)
            status = put_overshoot(results, series, r, all, without[r]);
    }
    memory_free(without);
    return status;
}

Status derive_start_up(Results *results, const ResultSeries *series) {
    const ResultAxis *axis = &series->axis[1];
    if (strcmp(axis->name, "strain") != 0 || axis->count < 4 * PEAK_LEAST) return OK;
    StartUp mean = {.strain = axis->values, .count = axis->count};
    TRY(NEW_ARRAY(mean.stress, mean.count));
    const Status status = derive_overshoot(results, series, &mean);
    memory_free(mean.stress);
    return status;
}

// Amplitude of a harmonic over that of the first, from the moduli of all replicas but one.
static double harmonic_ratio(const ResultSeries *series, size_t replicas, int64_t left_out,
                             size_t harmonic) {
    const size_t harmonics = series->axis[1].count;
    double square[2] = {0};
    for (size_t part = 0; part < 2; part++) {
        double sum[2] = {0};
        for (size_t r = 0; r < replicas; r++) {
            if ((int64_t)r == left_out) continue;
            const double *moduli = series->values + r * series->size + part * harmonics;
            sum[0] += moduli[0];
            sum[1] += moduli[harmonic - 1];
        }
        for (int k = 0; k < 2; k++) square[k] += sum[k] * sum[k];
    }
    return sqrt(square[1] / square[0]);
}

Status derive_harmonics(Results *results, const ResultSeries *series) {
    static const struct {
        size_t harmonic;
        const char *name;
    } ratios[] = {{3, "third_harmonic"}, {5, "fifth_harmonic"}};
    const size_t n = results->replicas;
    for (size_t k = 0; k < sizeof ratios / sizeof *ratios; k++) {
        const double all = harmonic_ratio(series, n, ALL, ratios[k].harmonic);
        for (size_t r = 0; r < n; r++) {
            const double without =
                n < 2 ? all : harmonic_ratio(series, n, (int64_t)r, ratios[k].harmonic);
            TRY(results_put_scalar(results, series->stage, ratios[k].name, "", NULL, r,
                                   pseudo_value(n, all, without)));
        }
    }
    return OK;
}
