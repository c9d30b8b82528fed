// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacements of bodies with an axis, along and across two directions of the time
// origin: the body axis u(0), <(dr.u(0))^2>, and the director n(0) of all axes together. What is
// across is half of the square in the plane, the mean over its two directions: every one of the
// four is 2 D t where motion is diffusive (Jabbari-Farouji & Trizac 2012, sec. IV).
#include "observables/axis_lags.h"

static const Option rows[] = {LAG_OPTIONS(LagSettingsAlone, lags)};

// Unfolded coordinates [3][axes], body axes [3][axes], director [3].
static void copy(const State *state, const Oriented *oriented, size_t axes, double *frame) {
    for (int a = 0; a < 3; a++) {
        double *coordinate = frame + (size_t)a * axes;
        double *axis = frame + (size_t)(3 + a) * axes;
        for (size_t s = 0; s < oriented->count; s++) {
            for (size_t i = oriented->begin[s]; i < oriented->end[s]; i++) {
                *coordinate++ = state_unfolded(state, a, i);
                *axis++ = state->orientation[a][i];
            }
        }
    }
    oriented_director(state, oriented, frame + 6 * axes);
}

enum { TOTAL, ALONG_AXIS, ALONG_DIRECTOR, SQUARES };

static void add(const double *then, const double *now, size_t axes, size_t begin, size_t end,
                double sums[]) {
    const double *u = then + 3 * axes, *n = then + 6 * axes;
    double more[SQUARES] = {0};
    for (size_t i = begin; i < end; i++) {
        const double x = now[i] - then[i], y = now[axes + i] - then[axes + i],
                     z = now[2 * axes + i] - then[2 * axes + i];
        const double along_axis = x * u[i] + y * u[axes + i] + z * u[2 * axes + i];
        const double along_director = x * n[0] + y * n[1] + z * n[2];
        more[TOTAL] += x * x + y * y + z * z;
        more[ALONG_AXIS] += along_axis * along_axis;
        more[ALONG_DIRECTOR] += along_director * along_director;
    }
    for (size_t k = 0; k < SQUARES; k++) sums[k] += more[k];
}

static const char *const directions[] = {"parallel", "perpendicular", "along_director",
                                         "across_director"};

static void finish(const double means[], double values[]) {
    values[0] = means[ALONG_AXIS];
    values[1] = (means[TOTAL] - means[ALONG_AXIS]) / 2;
    values[2] = means[ALONG_DIRECTOR];
    values[3] = (means[TOTAL] - means[ALONG_DIRECTOR]) / 2;
}

static const AxisCorrelation what = {
    .kind = &observable_directional_displacement,
    .tag = 0x4449524543303031, // "DIREC001"
    .per_axis = 6,
    .once = 3,
    .sums = SQUARES,
    .copy = copy,
    .add = add,
    .finish = finish,
    .rows_name = "direction",
    .row_names = directions,
    .rows = sizeof directions / sizeof *directions,
    .unit = "d^2",
};

AXIS_CORRELATION(directional_displacement,
                 "Mean squared displacements along and across the body axis and the director, of "
                 "particles with a body axis.")
