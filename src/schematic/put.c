// SPDX-License-Identifier: GPL-3.0-or-later
// Results of the schematic model: stage `schematic`, one replica.
#include "schematic/put.h"

#include <stdio.h>

#define STAGE "schematic"
#define STRESS_UNIT "" // that of the modulus

static ResultSeries shape_of(const char *name, const char *unit, const char *about) {
    ResultSeries shape = {.stage = STAGE};
    snprintf(shape.observable, sizeof shape.observable, "%s", name);
    snprintf(shape.unit, sizeof shape.unit, "%s", unit);
    snprintf(shape.about, sizeof shape.about, "%s", about);
    return shape;
}

static void add_axis(ResultSeries *shape, const char *name, const char *unit, const double *values,
                     size_t count) {
    shape->axis[shape->axes++] =
        (ResultAxis){.name = name, .unit = unit, .count = count, .values = values};
}

Status put_scalar(Results *results, const char *name, const char *unit, const char *about,
                  double value) {
    return results_put_scalar(results, STAGE, name, unit, about, 0, value);
}

Status put_line(Results *results, const char *name, const char *unit, const char *about,
                const char *axis, const char *unit_of_axis, const double *x, size_t count,
                const double *values) {
    ResultSeries shape = shape_of(name, unit, about);
    add_axis(&shape, axis, unit_of_axis, x, count);
    return results_put_series(results, &shape, 0, values);
}

Status put_stress(Results *results, const char *about, const char *axis, const char *unit_of_axis,
                  const double *x, size_t count, const double *values) {
    static const char *const kinds[] = {"shear_stress"};
    ResultSeries shape = shape_of("stress", STRESS_UNIT, about);
    shape.axis[shape.axes++] =
        (ResultAxis){.name = "stress", .unit = "", .count = 1, .labels = kinds};
    add_axis(&shape, axis, unit_of_axis, x, count);
    return results_put_series(results, &shape, 0, values);
}

Status put_rows(Results *results, const char *name, const char *about, const char *row_axis,
                const double *rows, size_t row_count, const double *time, size_t count,
                const double *values) {
    ResultSeries shape = shape_of(name, "", about);
    add_axis(&shape, row_axis, "d^2/D0", rows, row_count);
    add_axis(&shape, "time", "d^2/D0", time, count);
    return results_put_series(results, &shape, 0, values);
}

Status put_harmonics(Results *results, size_t count, const double *moduli) {
    static const char *const parts[] = {"elastic", "viscous"};
    static const double orders[] = {1, 2, 3, 4, 5};
    ResultSeries shape =
        shape_of("stress_harmonics", STRESS_UNIT,
                 "Moduli G'_n (elastic) and G''_n (viscous) of the harmonics of the stress; of n = "
                 "1 the storage and the loss modulus.");
    shape.axis[shape.axes++] =
        (ResultAxis){.name = "part", .unit = "", .count = 2, .labels = parts};
    add_axis(&shape, "harmonic", "", orders, count);
    return results_put_series(results, &shape, 0, moduli);
}
