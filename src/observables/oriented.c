// SPDX-License-Identifier: GPL-3.0-or-later
// Alignment of body axes.
#include "observables/oriented.h"

#include "numerics/symmetric.h"

#include <string.h>

Oriented oriented_of(const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    Oriented oriented = {.count = 0};
    size_t begin = 0;
    for (size_t s = 0; s < system->species_count; begin += counts[s++]) {
        if (!shape_is_oriented((ShapeKind)system->species[s].shape)) continue;
        oriented.begin[oriented.count] = begin;
        oriented.end[oriented.count++] = begin + counts[s];
    }
    return oriented;
}

size_t oriented_particles(const Oriented *oriented) {
    size_t particles = 0;
    for (size_t s = 0; s < oriented->count; s++) particles += oriented->end[s] - oriented->begin[s];
    return particles;
}

void oriented_labels(Labels *labels, const System *system) {
    System only = *system;
    only.species_count = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        if (!shape_is_oriented((ShapeKind)system->species[s].shape)) continue;
        only.species[only.species_count++] = system->species[s];
    }
    labels_of_species(labels, &only);
}

Status oriented_check(const char *observable, const System *system) {
    if (system_is_oriented(system)) return OK;
    return status_fail(BAD_DATA,
                       "%s: no species has a body axis, as spherocylinders and platelets have; "
                       "leave it out",
                       observable);
}

void oriented_add(double sum[3][3], const State *state, size_t begin, size_t end) {
    const double *x = state->orientation[0], *y = state->orientation[1], *z = state->orientation[2];
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    for (size_t i = begin; i < end; i++) {
        xx += x[i] * x[i];
        xy += x[i] * y[i];
        xz += x[i] * z[i];
        yy += y[i] * y[i];
        yz += y[i] * z[i];
        zz += z[i] * z[i];
    }
    const double more[3][3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) sum[a][b] += more[a][b];
    }
}

Order oriented_order(const double sum[3][3], double particles) {
    double tensor[3][3], values[3], vectors[3][3];
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) tensor[a][b] = 1.5 * sum[a][b] / particles - (a == b ? 0.5 : 0);
    }
    symmetric_eigen(tensor, values, vectors);
    Order order = {.largest = values[2], .middle = values[1]};
    memcpy(order.director, vectors[2], sizeof order.director);
    return order;
}

void oriented_director(const State *state, const Oriented *oriented, double director[3]) {
    double sum[3][3] = {{0}};
    for (size_t s = 0; s < oriented->count; s++) {
        oriented_add(sum, state, oriented->begin[s], oriented->end[s]);
    }
    const Order order = oriented_order(sum, (double)oriented_particles(oriented));
    memcpy(director, order.director, sizeof order.director);
}
