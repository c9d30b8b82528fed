// SPDX-License-Identifier: GPL-3.0-or-later
// Means over replicas of a decay, its crossing of a level, its values between the lags.
#include "analysis/decay.h"

#include <math.h>

void decay_mean(const Results *results, const ResultSeries *series, size_t first, size_t count,
                int64_t without, double *mean) {
    for (size_t k = 0; k < count; k++) {
        double sum = 0, n = 0;
        for (size_t r = 0; r < results->replicas; r++) {
            if ((int64_t)r == without) continue;
            sum += series->values[r * series->size + first + k];
            n++;
        }
        mean[k] = sum / n;
    }
}

double decay_time_at(const double *times, const double *values, size_t count, double level) {
    for (size_t k = 1; k < count; k++) {
        const double above = values[k - 1], below = values[k];
        if (!(above >= level && below < level) || !(times[k - 1] > 0)) continue;
        const double share = (above - level) / (above - below);
        return times[k - 1] * pow(times[k] / times[k - 1], share);
    }
    return NAN;
}

double decay_value_at(const double *times, const double *values, size_t count, double time) {
    for (size_t k = 1; k < count; k++) {
        if (!(times[k - 1] > 0) || time < times[k - 1] || time > times[k]) continue;
        const double share = log(time / times[k - 1]) / log(times[k] / times[k - 1]);
        return values[k - 1] + share * (values[k] - values[k - 1]);
    }
    return NAN;
}
