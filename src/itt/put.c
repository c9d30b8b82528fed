// SPDX-License-Identifier: GPL-3.0-or-later
// Series of a run of the theory under shear.
#include "itt/put.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>

#define STAGE "theory"

static const double PICTURE_LAST = 14; // in 1/d, of the picture of S(q) and of its cuts

static const char *const TOTAL[] = {"total"}, *const DISC[] = {"disc"};
static const char *const STRESSES[] = {"shear_stress", "normal_stress_difference"};

void record_vector(int direction, double length, double *x, double *y) {
    static const double way[TRANSIENT_DIRECTIONS][2] = {
        {1, 0},
        {0, 1},
        {0.70710678118654752440, 0.70710678118654752440},
        {-0.70710678118654752440, 0.70710678118654752440}};
    *x = length * way[direction][0];
    *y = length * way[direction][1];
}

Status record_create(Record *r, size_t waves, size_t times, size_t strains, bool tagged) {
    const size_t correlators = times * TRANSIENT_DIRECTIONS * waves;
    r->waves = waves;
    r->times_most = times;
    r->strains_most = strains;
    TRY(NEW_ARRAY(r->time, times));
    TRY(NEW_ARRAY(r->modulus, times));
    TRY(NEW_ARRAY(r->strain, strains));
    TRY(NEW_ARRAY(r->stress, 2 * strains));
    TRY(NEW_ARRAY(r->collective, correlators));
    if (!tagged) return OK;
    TRY(NEW_ARRAY(r->tagged, correlators));
    return NEW_ARRAY(r->displacement, times * TRANSIENT_DIRECTIONS);
}

void record_free(Record *r) {
    double *const arrays[] = {r->time,       r->strain, r->modulus,     r->stress,
                              r->collective, r->tagged, r->displacement};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) memory_free(arrays[i]);
    *r = (Record){0};
}

static void archive_count(Archive *archive, size_t *count, size_t most) {
    uint64_t stored = *count;
    archive_u64(archive, &stored, 1);
    archive_require(archive, stored <= most, "more is kept than there is room for");
    if (archive->status == OK) *count = stored;
}

void record_archive(Record *r, Archive *archive) {
    const size_t directions = TRANSIENT_DIRECTIONS;
    archive_count(archive, &r->times, r->times_most);
    archive_count(archive, &r->strains, r->strains_most);
    if (archive->status != OK) return;
    archive_f64(archive, r->time, r->times);
    archive_f64(archive, r->modulus, r->times);
    archive_f64(archive, r->strain, r->strains);
    archive_f64(archive, r->stress, 2 * r->strains);
    archive_f64(archive, r->collective, r->times * directions * r->waves);
    if (!r->tagged) return;
    archive_f64(archive, r->tagged, r->times * directions * r->waves);
    archive_f64(archive, r->displacement, r->times * directions);
}

Status record_put_number(Results *results, const char *name, const char *unit, const char *about,
                         double value) {
    return results_put_scalar(results, STAGE, name, unit, about, 0, value);
}

static ResultSeries shape_of(const char *name, const char *unit, const char *about) {
    ResultSeries shape = {.stage = STAGE};
    snprintf(shape.observable, sizeof shape.observable, "%s", name);
    snprintf(shape.unit, sizeof shape.unit, "%s", unit);
    snprintf(shape.about, sizeof shape.about, "%s", about);
    return shape;
}

static void add_labels(ResultSeries *shape, const char *name, size_t count,
                       const char *const *labels) {
    shape->axis[shape->axes++] =
        (ResultAxis){.name = name, .unit = "", .count = count, .labels = labels};
}

static void add_numbers(ResultSeries *shape, const char *name, const char *unit, size_t count,
                        const double *values) {
    shape->axis[shape->axes++] =
        (ResultAxis){.name = name, .unit = unit, .count = count, .values = values};
}

// [time][line] as [line][time].
static Status put_turned(Results *results, const ResultSeries *shape, const double *kept,
                         size_t times, size_t lines) {
    double *values = NULL;
    TRY(NEW_ARRAY(values, times * lines));
    for (size_t t = 0; t < times; t++) {
        for (size_t i = 0; i < lines; i++) values[i * times + t] = kept[t * lines + i];
    }
    const Status status = results_put_series(results, shape, 0, values);
    memory_free(values);
    return status;
}

static Status put_correlators(const Record *r, Results *results, const double *kept,
                              const char *name, const char *about, const char *axis,
                              const char *const *label) {
    ResultSeries shape = shape_of(name, "", about);
    add_labels(&shape, axis, 1, label);
    add_labels(&shape, "direction", TRANSIENT_DIRECTIONS, transient_direction);
    add_numbers(&shape, "wave_number", "1/d", r->waves, r->wave_number);
    add_numbers(&shape, "time", "d^2/D0", r->times, r->time);
    return put_turned(results, &shape, kept, r->times, TRANSIENT_DIRECTIONS * r->waves);
}

static Status put_displacement(const Record *r, Results *results) {
    ResultSeries shape = shape_of(
        "advected_displacement", "d^2",
        "Mean squared displacement of a tagged particle along directions; along x from where the "
        "flow at its final height has carried it.");
    add_labels(&shape, "species", 1, DISC);
    add_labels(&shape, "direction", TRANSIENT_DIRECTIONS, transient_direction);
    add_numbers(&shape, "time", "d^2/D0", r->times, r->time);
    return put_turned(results, &shape, r->displacement, r->times, TRANSIENT_DIRECTIONS);
}

Status record_put(const Record *r, Results *results) {
    ResultSeries stress =
        shape_of("stress", "kT/d^2", "Stress after the start of shear, as a function of strain.");
    add_labels(&stress, "stress", 2, STRESSES);
    add_numbers(&stress, "strain", "", r->strains, r->strain);
    TRY(put_turned(results, &stress, r->stress, r->strains, 2));
    ResultSeries modulus =
        shape_of("transient_modulus", "kT/d^2",
                 "G(t) under shear: the stress is the shear rate times its integral.");
    add_numbers(&modulus, "time", "d^2/D0", r->times, r->time);
    TRY(results_put_series(results, &modulus, 0, r->modulus));
    TRY(put_correlators(r, results, r->collective, "advected_scattering_normalised",
                        "Transient collective correlators Phi_q(t) along directions of q at the "
                        "start of shear, at time t at the advected q(t).",
                        "pair", TOTAL));
    if (!r->tagged) return OK;
    TRY(put_correlators(r, results, r->tagged, "self_scattering",
                        "Transient correlators of a tagged particle along directions of q at the "
                        "start of shear.",
                        "species", DISC));
    return put_displacement(r, results);
}

// ---- S(q) --------------------------------------------------------------------------------------

// change, and with `rest` what it changes, on a square of the plane.
static Status put_picture(Results *results, const Plane *plane, const double *rest,
                          const double *change, const char *name, const char *about) {
    const int half = (int)(fmin(PICTURE_LAST, plane->cutoff / 1.5) / plane->spacing);
    const size_t side = 2 * (size_t)half + 1;
    ResultSeries shape = shape_of(name, "", about);
    double *values = NULL, *along = NULL;
    Status status = NEW_ARRAY(values, side * side);
    if (status == OK) status = NEW_ARRAY(along, side);
    for (size_t k = 0; status == OK && k < side * side; k++) {
        const int i = (int)(k / side) - half, j = (int)(k % side) - half;
        const size_t at = i < 0 ? plane_place(plane, -i, -j) : plane_place(plane, i, j);
        along[k % side] = j * plane->spacing;
        values[k] = (rest ? rest[at] : 0) + change[at];
    }
    add_labels(&shape, "pair", 1, TOTAL);
    add_numbers(&shape, "wave_number_x", "1/d", side, along);
    add_numbers(&shape, "wave_number_y", "1/d", side, along);
    if (status == OK) status = results_put_series(results, &shape, 0, values);
    memory_free(values);
    memory_free(along);
    return status;
}

static Status put_cuts(Results *results, const Plane *plane, const double *rest,
                       const double *change, const char *name, const char *about) {
    const size_t count = (size_t)(fmin(PICTURE_LAST, plane->cutoff / 1.5) / plane->spacing);
    ResultSeries shape = shape_of(name, "", about);
    double *values = NULL, *along = NULL;
    Status status = NEW_ARRAY(values, TRANSIENT_DIRECTIONS * count);
    if (status == OK) status = NEW_ARRAY(along, count);
    for (size_t k = 0; status == OK && k < TRANSIENT_DIRECTIONS * count; k++) {
        double x, y;
        along[k % count] = (double)(k % count + 1) * plane->spacing;
        record_vector((int)(k / count), along[k % count], &x, &y);
        values[k] = (rest ? plane_read(plane, rest, x, y) : 0) + plane_read(plane, change, x, y);
    }
    add_labels(&shape, "pair", 1, TOTAL);
    add_labels(&shape, "direction", TRANSIENT_DIRECTIONS, transient_direction);
    add_numbers(&shape, "wave_number", "1/d", count, along);
    if (status == OK) status = results_put_series(results, &shape, 0, values);
    memory_free(values);
    memory_free(along);
    return status;
}

Status record_put_structure(Results *results, const Plane *plane, const double *rest,
                            const double *change) {
    TRY(put_picture(results, plane, rest, change, "planar_structure_factor",
                    "Structure factor of the flow at the last strain, on the plane of q_x and "
                    "q_y."));
    TRY(put_picture(results, plane, NULL, change, "planar_structure_factor_change",
                    "Structure factor of the flow less that at rest."));
    TRY(put_cuts(results, plane, rest, change, "structure_factor_cuts",
                 "Structure factor of the flow along x, y and the diagonals."));
    return put_cuts(results, plane, NULL, change, "structure_factor_cuts_change",
                    "Structure factor of the flow less that at rest, along x, y and the "
                    "diagonals.");
}
