// SPDX-License-Identifier: GPL-3.0-or-later
// Jacobi's method (Golub & Van Loan, Matrix Computations, 8.5): plane rotations, each of which
// makes one off-diagonal element zero. It needs + - * / and sqrt only.
#include "numerics/symmetric.h"

#include <math.h>
#include <stdbool.h>

enum { SWEEPS_MOST = 30 }; // convergence is quadratic: five or six do

typedef struct Rotation {
    double cosine, sine;
} Rotation;

// That which makes a[p][q] zero.
static Rotation rotation_for(double a[3][3], int p, int q) {
    const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    const double tangent = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    const double cosine = 1 / sqrt(tangent * tangent + 1);
    return (Rotation){.cosine = cosine, .sine = tangent * cosine};
}

static void rotate(const Rotation *r, double *x, double *y) {
    const double old = *x;
    *x = r->cosine * old - r->sine * *y;
    *y = r->sine * old + r->cosine * *y;
}

static void make_zero(double a[3][3], double vectors[3][3], int p, int q) {
    if (a[p][q] == 0) return;
    const Rotation rotation = rotation_for(a, p, q);
    for (int k = 0; k < 3; k++) rotate(&rotation, &a[k][p], &a[k][q]);
    for (int k = 0; k < 3; k++) rotate(&rotation, &a[p][k], &a[q][k]);
    a[p][q] = a[q][p] = 0;
    for (int k = 0; k < 3; k++) rotate(&rotation, &vectors[p][k], &vectors[q][k]);
}

static bool is_diagonal(double a[3][3]) {
    static const double NEGLIGIBLE = 1e-17; // beside the diagonal: less than its last digit
    const double size = fabs(a[0][0]) + fabs(a[1][1]) + fabs(a[2][2]);
    return fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]) <= NEGLIGIBLE * size;
}

static void swap_if_greater(double values[3], double vectors[3][3], int p, int q) {
    if (values[p] <= values[q]) return;
    const double value = values[p];
    values[p] = values[q];
    values[q] = value;
    for (int k = 0; k < 3; k++) {
        const double component = vectors[p][k];
        vectors[p][k] = vectors[q][k];
        vectors[q][k] = component;
    }
}

void symmetric_eigen(const double matrix[3][3], double values[3], double vectors[3][3]) {
    double a[3][3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            a[i][j] = matrix[i][j];
            vectors[i][j] = i == j;
        }
    }
    for (int sweep = 0; sweep < SWEEPS_MOST && !is_diagonal(a); sweep++) {
        make_zero(a, vectors, 0, 1);
        make_zero(a, vectors, 0, 2);
        make_zero(a, vectors, 1, 2);
    }
    for (int k = 0; k < 3; k++) values[k] = a[k][k];
    swap_if_greater(values, vectors, 0, 1);
    swap_if_greater(values, vectors, 1, 2);
    swap_if_greater(values, vectors, 0, 1);
}
