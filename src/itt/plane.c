// SPDX-License-Identifier: GPL-3.0-or-later
// The half plane of wave vectors.
#include "itt/plane.h"

#include "base/constants.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { MARGIN = 3 }; // zeros at each end of a column: cubic interpolation reads that far
enum { LINE = 256 }; // of a column at a time

static Status fill_columns(Plane *plane) {
    size_t at = 0;
    for (int i = 0; i <= plane->last; i++) {
        const double rest = pow(plane->cutoff / plane->spacing, 2) - (double)i * i;
        plane->half[i] = (int)floor(sqrt(fmax(0, rest)) + 1e-9);
        plane->start[i] = at + MARGIN + (size_t)plane->half[i];
        at = plane->start[i] + (size_t)plane->half[i] + 1 + MARGIN;
    }
    plane->size = at;
    TRY(NEW_ARRAY(plane->x, at));
    TRY(NEW_ARRAY(plane->y, at));
    TRY(NEW_ARRAY(plane->area, at));
    for (int i = 0; i <= plane->last; i++) {
        for (int j = -plane->half[i]; j <= plane->half[i]; j++) {
            const size_t k = plane_place(plane, i, j);
            plane->x[k] = i * plane->spacing;
            plane->y[k] = j * plane->spacing;
            plane->area[k] = (i == 0 ? 1 : 2) * pow(plane->spacing / (2 * PI), 2);
        }
    }
    return OK;
}

static Status fill(Plane *plane) {
    TRY(NEW_ARRAY(plane->half, (size_t)plane->last + 1));
    TRY(NEW_ARRAY(plane->start, (size_t)plane->last + 1));
    return fill_columns(plane);
}

Status plane_create(Plane **out, double cutoff, double spacing) {
    Plane *plane = NULL;
    *out = NULL;
    TRY(NEW(plane));
    plane->spacing = spacing;
    plane->cutoff = cutoff;
    plane->last = (int)floor(cutoff / spacing + 1e-9);
    const Status status = fill(plane);
    if (status == OK)
        *out = plane;
    else
        plane_free(plane);
    return status;
}

void plane_free(Plane *plane) {
    if (!plane) return;
    memory_free(plane->half);
    memory_free(plane->start);
    memory_free(plane->x);
    memory_free(plane->y);
    memory_free(plane->area);
    memory_free(plane);
}

size_t plane_place(const Plane *plane, int i, int j) {
    return (size_t)((ptrdiff_t)plane->start[i] + j);
}

// Rows of a column of `half` for which row + whole, or a neighbour that weights reach, is there.
typedef struct Rows {
    int first, last;
} Rows;

static Rows rows_reached(int half, double whole) {
    const double first = fmax(-half, -half - 2 - whole), last = fmin(half, half + 1 - whole);
    return first > last ? (Rows){1, 0} : (Rows){(int)first, (int)last};
}

// Of Lagrange's polynomial through rows -1, 0, 1, 2, at 0 <= u < 1.
static void cubic_weights(double u, double weight[4]) {
    weight[0] = -u * (u - 1) * (u - 2) / 6;
    weight[1] = (u + 1) * (u - 1) * (u - 2) / 2;
    weight[2] = -(u + 1) * u * (u - 2) / 2;
    weight[3] = (u + 1) * u * (u - 1) / 6;
}

// Of a piece of a column, read once into a line.
static void add_line(const double *from, const double w[4], size_t count, size_t size,
                     size_t length, const double *part, double *sum) {
    double line[LINE];
    for (size_t k = 0; k < length; k++) {
        const double *f = from + k;
        line[k] = w[0] * f[-1] + w[1] * f[0] + w[2] * f[1] + w[3] * f[2];
    }
    for (size_t n = 0; n < count; n++) {
        for (size_t k = 0; k < length; k++) sum[n * size + k] += part[n * size + k] * line[k];
    }
}

void plane_add_advected(const Plane *plane, double strain, const double *field, const double *part,
                        double *sum, size_t count) {
    for (int i = 0; i <= plane->last; i++) {
        const double way = -strain * i, whole = floor(way), u = way - whole;
        const Rows rows = rows_reached(plane->half[i], whole);
        if (rows.first > rows.last) continue;
        double w[4];
        cubic_weights(u, w);
        const size_t to = plane_place(plane, i, rows.first);
        const double *from = field + plane_place(plane, i, rows.first + (int)whole);
        const size_t length = (size_t)(rows.last - rows.first + 1);
        for (size_t k = 0; k < length; k += LINE)
            add_line(from + k, w, count, plane->size, length - k < LINE ? length - k : LINE,
                     part + to + k, sum + to + k);
    }
}

// At any i and j: q and -q are the same; zero beyond the cutoff.
static double value_at(const Plane *plane, const double *field, int i, int j) {
    if (i < 0) return value_at(plane, field, -i, -j);
    if (i > plane->last || abs(j) > plane->half[i]) return 0;
    return field[plane_place(plane, i, j)];
}

double plane_read(const Plane *plane, const double *field, double x, double y) {
    const double i = floor(x / plane->spacing), j = floor(y / plane->spacing);
    double along[4], across[4], sum = 0;
    cubic_weights(x / plane->spacing - i, along);
    cubic_weights(y / plane->spacing - j, across);
    for (int a = 0; a < 4; a++) {
        for (int b = 0; b < 4; b++)
            sum += along[a] * across[b] * value_at(plane, field, (int)i + a - 1, (int)j + b - 1);
    }
    return sum;
}
