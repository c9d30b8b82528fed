// SPDX-License-Identifier: GPL-3.0-or-later
// Series of a run of the theory under shear.
#include "itt/put.h"

#include "base/memory.h"
#include "theory/series.h"

#include <math.h>

static const double PICTURE_LAST = 14; // in 1/d, of the picture of S(q) and of its cuts

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
    const size_t lines = times * TRANSIENT_DIRECTIONS;
    const size_t pairs = r->species_count * (r->species_count + 1) / 2;
    r->rows = pairs > 1 ? pairs + 1 : 1;
    r->waves = waves;
    r->times_most = times;
    r->strains_most = strains;
    TRY(NEW_ARRAY(r->time, times));
    TRY(NEW_ARRAY(r->modulus, times));
    TRY(NEW_ARRAY(r->strain, strains));
    TRY(NEW_ARRAY(r->stress, 2 * strains));
    TRY(NEW_ARRAY(r->collective, r->rows * lines * waves));
    if (!tagged) return OK;
    TRY(NEW_ARRAY(r->tagged, r->species_count * lines * waves));
    return NEW_ARRAY(r->displacement, r->species_count * lines);
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
    archive_f64(archive, r->collective, r->times * r->rows * directions * r->waves);
    if (!r->tagged) return;
    archive_f64(archive, r->tagged, r->times * r->species_count * directions * r->waves);
    archive_f64(archive, r->displacement, r->times * r->species_count * directions);
}

static void label_rows(TheoryLabels *labels, const Record *r) {
    theory_label_pairs(labels, r->species, r->rows > 1 ? r->species_count : 0);
}

// [time][line] as [line][time].
static Status put_turned(Results *results, const ResultSeries *shape, const double *kept,
                         size_t times, size_t lines) {
    double *values = NULL;
    TRY(NEW_ARRAY(values, times * lines));
    theory_turn(kept, times, lines, values);
    const Status status = results_put_series(results, shape, 0, values);
    memory_free(values);
    return status;
}

static Status put_correlators(const Record *r, Results *results, const double *kept,
                              const char *name, const char *about, const char *axis,
                              const TheoryLabels *labels) {
    ResultSeries shape = theory_series(name, "", about);
    theory_add_labels(&shape, axis, labels->count, labels->names);
    theory_add_labels(&shape, "direction", TRANSIENT_DIRECTIONS, transient_direction);
    theory_add_numbers(&shape, "wave_number", "1/d", r->waves, r->wave_number);
    theory_add_numbers(&shape, "time", "d^2/D0", r->times, r->time);
    return put_turned(results, &shape, kept, r->times,
                      labels->count * TRANSIENT_DIRECTIONS * r->waves);
}

static Status put_displacement(const Record *r, Results *results, const TheoryLabels *labels) {
    ResultSeries shape = theory_series(
        "advected_displacement", "d^2",
        "Mean squared displacement of a tagged particle along directions; along x from where the "
        "flow at its final height has carried it.");
    theory_add_labels(&shape, "species", labels->count, labels->names);
    theory_add_labels(&shape, "direction", TRANSIENT_DIRECTIONS, transient_direction);
    theory_add_numbers(&shape, "time", "d^2/D0", r->times, r->time);
    return put_turned(results, &shape, r->displacement, r->times,
                      labels->count * TRANSIENT_DIRECTIONS);
}

Status record_put(const Record *r, Results *results) {
    TheoryLabels labels;
    ResultSeries stress = theory_series(
        "stress", "kT/d^2", "Stress after the start of shear, as a function of strain.");
    theory_add_labels(&stress, "stress", 2, STRESSES);
    theory_add_numbers(&stress, "strain", "", r->strains, r->strain);
    TRY(put_turned(results, &stress, r->stress, r->strains, 2));
    ResultSeries modulus =
        theory_series("transient_modulus", "kT/d^2",
                      "G(t) under shear: the stress is the shear rate times its integral.");
    theory_add_numbers(&modulus, "time", "d^2/D0", r->times, r->time);
    TRY(results_put_series(results, &modulus, 0, r->modulus));
    label_rows(&labels, r);
    TRY(put_correlators(r, results, r->collective, "advected_scattering_normalised",
                        "Transient collective correlators along directions of q at the start of "
                        "shear, at time t at the advected q(t), each over its value at t = 0; F_ab "
                        "and F_ba, which differ, are averaged.",
                        "pair", &labels));
    if (!r->tagged) return OK;
    theory_label_species(&labels, r->species, r->species_count);
    TRY(put_correlators(r, results, r->tagged, "self_scattering",
                        "Transient correlators of a tagged particle along directions of q at the "
                        "start of shear.",
                        "species", &labels));
    return put_displacement(r, results, &labels);
}

// ---- S(q) --------------------------------------------------------------------------------------

// Of a row: a pair, or the sum over both species of all pairs; with `rest` what `change` changes.
static void add_row(const Record *r, const Plane *plane, size_t row, const double *rest,
                    const double *change, double *sum) {
    for (size_t a = 0; a < r->species_count; a++) {
        for (size_t b = 0; b < r->species_count; b++) {
            const size_t pair = mixture_pair(r->species_count, a, b), at = pair * plane->size;
            if (row + 1 < r->rows && (row != pair || b < a)) continue;
            for (size_t k = 0; k < plane->size; k++)
                sum[k] += (rest ? rest[at + k] : 0) + change[at + k];
        }
    }
}

// [row][size], the total last.
static Status find_rows(const Record *r, const Plane *plane, const double *rest,
                        const double *change, double **rows) {
    TRY(NEW_ARRAY(*rows, r->rows * plane->size));
    for (size_t row = 0; row < r->rows; row++)
        add_row(r, plane, row, rest, change, *rows + row * plane->size);
    return OK;
}

// On a square of the plane.
static Status put_picture(const Record *r, Results *results, const Plane *plane, const double *rows,
                          const char *name, const char *about) {
    const int half = (int)(fmin(PICTURE_LAST, plane->cutoff / 1.5) / plane->spacing);
    const size_t side = 2 * (size_t)half + 1, square = side * side;
    ResultSeries shape = theory_series(name, "", about);
    TheoryLabels labels;
    double *values = NULL, *along = NULL;
    Status status = NEW_ARRAY(values, r->rows * square);
    if (status == OK) status = NEW_ARRAY(along, side);
    for (size_t k = 0; status == OK && k < r->rows * square; k++) {
        const int i = (int)(k % square / side) - half, j = (int)(k % side) - half;
        const size_t at = i < 0 ? plane_place(plane, -i, -j) : plane_place(plane, i, j);
        along[k % side] = j * plane->spacing;
        values[k] = rows[k / square * plane->size + at];
    }
    label_rows(&labels, r);
    theory_add_labels(&shape, "pair", labels.count, labels.names);
    theory_add_numbers(&shape, "wave_number_x", "1/d", side, along);
    theory_add_numbers(&shape, "wave_number_y", "1/d", side, along);
    if (status == OK) status = results_put_series(results, &shape, 0, values);
    memory_free(values);
    memory_free(along);
    return status;
}

static Status put_cuts(const Record *r, Results *results, const Plane *plane, const double *rows,
                       const char *name, const char *about) {
    const size_t count = (size_t)(fmin(PICTURE_LAST, plane->cutoff / 1.5) / plane->spacing);
    const size_t cuts = TRANSIENT_DIRECTIONS * count;
    ResultSeries shape = theory_series(name, "", about);
    TheoryLabels labels;
    double *values = NULL, *along = NULL;
    Status status = NEW_ARRAY(values, r->rows * cuts);
    if (status == OK) status = NEW_ARRAY(along, count);
    for (size_t k = 0; status == OK && k < r->rows * cuts; k++) {
        double x, y;
        along[k % count] = (double)(k % count + 1) * plane->spacing;
        record_vector((int)(k % cuts / count), along[k % count], &x, &y);
        values[k] = plane_read(plane, rows + k / cuts * plane->size, x, y);
    }
    label_rows(&labels, r);
    theory_add_labels(&shape, "pair", labels.count, labels.names);
    theory_add_labels(&shape, "direction", TRANSIENT_DIRECTIONS, transient_direction);
    theory_add_numbers(&shape, "wave_number", "1/d", count, along);
    if (status == OK) status = results_put_series(results, &shape, 0, values);
    memory_free(values);
    memory_free(along);
    return status;
}

static Status put_flowing(const Record *r, Results *results, const Plane *plane,
                          const double *rows) {
    TRY(put_picture(r, results, plane, rows, "planar_structure_factor",
                    "Structure factor of the flow at the last strain, on the plane of q_x and "
                    "q_y."));
    return put_cuts(r, results, plane, rows, "structure_factor_cuts",
                    "Structure factor of the flow along x, y and the diagonals.");
}

static Status put_change(const Record *r, Results *results, const Plane *plane,
                         const double *rows) {
    TRY(put_picture(r, results, plane, rows, "planar_structure_factor_change",
                    "Structure factor of the flow less that at rest."));
    return put_cuts(r, results, plane, rows, "structure_factor_cuts_change",
                    "Structure factor of the flow less that at rest, along x, y and the "
                    "diagonals.");
}

Status record_put_structure(const Record *r, Results *results, const Plane *plane,
                            const double *rest, const double *change) {
    double *flowing = NULL, *changed = NULL;
    Status status = find_rows(r, plane, rest, change, &flowing);
    if (status == OK) status = find_rows(r, plane, NULL, change, &changed);
    if (status == OK) status = put_flowing(r, results, plane, flowing);
    if (status == OK) status = put_change(r, results, plane, changed);
    memory_free(flowing);
    memory_free(changed);
    return status;
}
