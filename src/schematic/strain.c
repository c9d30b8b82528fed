// SPDX-License-Identifier: GPL-3.0-or-later
// Strain against time.
#include "schematic/strain.h"

#include "base/constants.h"

#include <math.h>

double strain_period(const Strain *strain) {
    return strain->count > 0 ? strain->duration : 2 * PI / strain->frequency;
}

// The integral of the rates up to `time`, which is within the duration.
static double of_table(const Strain *strain, double time) {
    const double *t = strain->time, *rate = strain->rate;
    const size_t last = strain->count - 1;
    double sum = rate[0] * fmin(time, t[0]);
    for (size_t i = 0; i < last && time > t[i]; i++) {
        const double way = fmin(time, t[i + 1]) - t[i];
        const double slope = (rate[i + 1] - rate[i]) / (t[i + 1] - t[i]);
        sum += (rate[i] + slope * way / 2) * way;
    }
    return sum + rate[last] * fmax(0, time - t[last]);
}

double strain_at(const Strain *strain, double time) {
    if (strain->count == 0) return strain->amplitude * sin(strain->frequency * time);
    const double before = floor(time / strain->duration);
    return before * of_table(strain, strain->duration) +
           of_table(strain, time - before * strain->duration);
}
