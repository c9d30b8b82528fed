// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms of fields that are even or odd under q -> -q, by FFTW: along the columns first, where
// only those with q_x >= 0 are there; then along x, where the sums over q_y of the others follow by
// conjugation. Both steps are real, which costs half of a real transform of the whole plane.
#include "itt/fourier.h"

#include "base/memory.h"

#include <complex.h>
#include <fftw3.h>

#include <stdatomic.h>
#include <string.h>

struct Fourier {
    const Plane *plane;
    int length, half;     // of the box in space in units of its spacing; half: length/2 + 1
    double *columns;      // [last + 1][length]
    fftw_complex *middle; // [half: q_x][half: y]
    fftw_plan out_columns, out_rows, back_rows, back_columns;
};

// FFTW keeps what it knows of plans in one place for all threads.
static atomic_flag planning = ATOMIC_FLAG_INIT;

// The smallest even length that sums of pairs of wave vectors fit in, a product of small primes.
static int good_length(int last) {
    for (int length = 3 * last + 1;; length++) {
        int rest = length;
        for (int prime = 2; prime <= 5; prime++) {
            while (rest % prime == 0) rest /= prime;
        }
        if (rest == 1 && length % 2 == 0) return length;
    }
}

// Estimated plans, not measured ones: the same each time, so that a run can be repeated.
static void plan(Fourier *f) {
    const int n = f->length, half = f->half, columns = f->plane->last + 1;
    double *space = f->columns; // only its alignment matters to the plans along x
    while (atomic_flag_test_and_set(&planning)) {
    }
    f->out_columns = fftw_plan_many_dft_r2c(1, &n, columns, f->columns, NULL, 1, n, f->middle, NULL,
                                            1, half, FFTW_ESTIMATE);
    f->back_columns = fftw_plan_many_dft_c2r(1, &n, columns, f->middle, NULL, 1, half, f->columns,
                                             NULL, 1, n, FFTW_ESTIMATE);
    f->out_rows = fftw_plan_many_dft_c2r(1, &n, half, f->middle, NULL, half, 1, space, NULL, half,
                                         1, FFTW_ESTIMATE);
    f->back_rows = fftw_plan_many_dft_r2c(1, &n, half, space, NULL, half, 1, f->middle, NULL, half,
                                          1, FFTW_ESTIMATE);
    atomic_flag_clear(&planning);
}

static Status prepare(Fourier *f) {
    f->length = good_length(f->plane->last);
    f->half = f->length / 2 + 1;
    TRY(NEW_ARRAY(f->columns, (size_t)f->length * (size_t)f->half));
    TRY(NEW_ARRAY(f->middle, (size_t)f->half * (size_t)f->half));
    plan(f);
    if (f->out_columns && f->out_rows && f->back_rows && f->back_columns) return OK;
    return status_fail(NO_MEMORY, "no plan for transforms of length %d", f->length);
}

Status fourier_create(Fourier **out, const Plane *plane) {
    Fourier *f = NULL;
    *out = NULL;
    TRY(NEW(f));
    f->plane = plane;
    const Status status = prepare(f);
    if (status == OK)
        *out = f;
    else
        fourier_free(f);
    return status;
}

void fourier_free(Fourier *f) {
    if (!f) return;
    fftw_plan const plans[] = {f->out_columns, f->out_rows, f->back_rows, f->back_columns};
    while (atomic_flag_test_and_set(&planning)) {
    }
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        if (plans[i]) fftw_destroy_plan(plans[i]);
    }
    atomic_flag_clear(&planning);
    memory_free(f->columns);
    memory_free(f->middle);
    memory_free(f);
}

size_t fourier_size(const Fourier *f) {
    return (size_t)f->length * (size_t)f->half;
}

// Into middle: the sums over q_y of the columns that are there; zeros beyond the cutoff.
static void sum_columns(Fourier *f, const double *field) {
    const int last = f->plane->last, n = f->length;
    memset(f->columns, 0, ((size_t)last + 1) * (size_t)n * sizeof *f->columns);
    for (int i = 0; i <= last; i++) {
        const int half = f->plane->half[i];
        const double *from = field + f->plane->start[i];
        double *to = f->columns + (size_t)i * (size_t)n;
        memcpy(to, from, ((size_t)half + 1) * sizeof *to);
        memcpy(to + n - half, from - half, (size_t)half * sizeof *to);
    }
    fftw_execute_dft_r2c(f->out_columns, f->columns, f->middle);
    const size_t there = ((size_t)last + 1) * (size_t)f->half;
    memset(f->middle + there, 0, ((size_t)f->half * (size_t)f->half - there) * sizeof *f->middle);
}

void fourier_even(Fourier *f, const double *field, double *space) {
    sum_columns(f, field);
    fftw_execute_dft_c2r(f->out_rows, f->middle, space);
}

void fourier_odd(Fourier *f, const double *field, double *space) {
    sum_columns(f, field);
    const size_t there = ((size_t)f->plane->last + 1) * (size_t)f->half;
    for (size_t k = 0; k < there; k++) f->middle[k] *= -I;
    fftw_execute_dft_c2r(f->out_rows, f->middle, space);
}

void fourier_back(Fourier *f, double *space, double *field) {
    const int last = f->plane->last, n = f->length;
    const double scale = 1 / ((double)n * (double)n);
    fftw_execute_dft_r2c(f->back_rows, space, f->middle);
    fftw_execute_dft_c2r(f->back_columns, f->middle, f->columns);
    for (int i = 0; i <= last; i++) {
        const int half = f->plane->half[i];
        const double *from = f->columns + (size_t)i * (size_t)n;
        double *to = field + f->plane->start[i];
        for (int j = 0; j <= half; j++) to[j] = scale * from[j];
        for (int j = 1; j <= half; j++) to[-j] = scale * from[n - j];
    }
}
