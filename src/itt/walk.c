// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared displacements on the doubling grid of times, discretised as in relaxation.c; but
// where they grow with a power of time the friction has long been shorter than a step, and its
// first moment in the newest interval is needed for second order.
#include "itt/walk.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

// Along x, y, xy and -xy.
static const double DIRECTION[WALK_DIRECTIONS][2] = {
    {1, 0},
    {0, 1},
    {0.70710678118654752440, 0.70710678118654752440},
    {-0.70710678118654752440, 0.70710678118654752440}};

Status walk_create(Walk *s, double diffusion, size_t block) {
    *s = (Walk){.block = block, .diffusion = diffusion};
    for (int d = 0; d < WALK_DIRECTIONS; d++) {
        TRY(NEW_ARRAY(s->value[d], block + 1));
        TRY(NEW_ARRAY(s->mean[d], block + 1));
    }
    TRY(NEW_ARRAY(s->friction, block + 1));
    TRY(NEW_ARRAY(s->friction_mean, block + 1));
    return NEW_ARRAY(s->friction_moment, block + 1);
}

void walk_free(Walk *s) {
    for (int d = 0; d < WALK_DIRECTIONS; d++) {
        memory_free(s->value[d]);
        memory_free(s->mean[d]);
    }
    memory_free(s->friction);
    memory_free(s->friction_mean);
    memory_free(s->friction_moment);
    *s = (Walk){0};
}

static void advect(const double e[2], double strain, double out[2]) {
    out[0] = e[0];
    out[1] = e[1] - strain * e[0];
}

static double square(const double e[2]) {
    return e[0] * e[0] + e[1] * e[1];
}

void walk_set_friction(Walk *s, size_t i, const double friction[2][2]) {
    for (int a = 0; a < 4; a++)
        s->friction[i][a / 2][a % 2] = s->diffusion * friction[a / 2][a % 2];
}

// D_s e(t').K.e(t)/e(t')^2
static double kernel(const double e[2], Friction friction, double earlier, double later) {
    double from[2], to[2], sum = 0;
    advect(e, earlier, from);
    advect(e, later, to);
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) sum += from[i] * friction[i][j] * to[j];
    }
    return sum / square(from);
}

static void average(Walk *s, size_t i) {
    for (int d = 0; d < WALK_DIRECTIONS; d++)
        s->mean[d][i] = (s->value[d][i - 1] + s->value[d][i]) / 2;
    for (int a = 0; a < 4; a++) {
        const double before = s->friction[i - 1][a / 2][a % 2], now = s->friction[i][a / 2][a % 2];
        s->friction_mean[i][a / 2][a % 2] = (before + now) / 2;
        s->friction_moment[i][a / 2][a % 2] = (now - before) / 12;
    }
}

void walk_begin(Walk *s, size_t i, double step, double shear) {
    if (i == 0) return;
    const double time = (double)i * step;
    for (int d = 0; d < WALK_DIRECTIONS; d++) {
        double middle[2];
        advect(DIRECTION[d], shear * (double)i / 2, middle);
        s->value[d][i] = 2 * s->diffusion * time *
                         (square(middle) - kernel(DIRECTION[d], s->friction[0], 0, 0) * time / 2);
    }
    average(s, i);
}

// All of the integral that does not need the value at time i.
static double known_integral(const Walk *s, int d, size_t i, double shear) {
    const size_t half = i / 2;
    const double *e = DIRECTION[d], *value = s->value[d], *mean = s->mean[d];
    const double now = shear * (double)i;
    double sum = mean[1] * kernel(e, s->friction[i], 0, now);
    for (size_t j = 1; j <= half; j++)
        sum += ((j == half ? value[half] : mean[j + 1]) - mean[j]) *
               kernel(e, s->friction[i - j], shear * (double)j, now);
    for (size_t j = half + 1; j < i; j++)
        sum += (value[j] - value[j - 1]) *
               kernel(e, s->friction_mean[i - j + 1], shear * ((double)j - 0.5), now);
    return sum +
           (value[i - 1] - value[i - 2]) * kernel(e, s->friction_moment[1], now - 1.5 * shear, now);
}

void walk_advance(Walk *s, size_t i, double step, double shear) {
    const double now = shear * (double)i;
    for (int d = 0; d < WALK_DIRECTIONS; d++) {
        const double *e = DIRECTION[d], *value = s->value[d];
        const double newest = kernel(e, s->friction_mean[1], now - shear / 2, now) -
                              kernel(e, s->friction_moment[1], now - shear / 2, now);
        double end[2];
        advect(e, now, end);
        s->value[d][i] =
            (2 * s->diffusion * square(end) + (4 * value[i - 1] - value[i - 2]) / (2 * step) +
             newest * value[i - 1] - known_integral(s, d, i, shear)) /
            (1.5 / step + newest);
    }
    average(s, i);
}

static void halve(double *values, double *mean, size_t width, size_t block) {
    for (size_t i = 1; i <= block / 2; i++) {
        memcpy(values + i * width, values + 2 * i * width, width * sizeof *values);
        for (size_t k = 0; k < width; k++)
            mean[i * width + k] = (mean[(2 * i - 1) * width + k] + mean[2 * i * width + k]) / 2;
    }
}

static void halve_moment(double *moment, const double *mean, size_t width, size_t block) {
    for (size_t i = 1; i <= block / 2; i++) {
        const size_t a = (2 * i - 1) * width, b = 2 * i * width;
        for (size_t k = 0; k < width; k++)
            moment[i * width + k] =
                (moment[a + k] + moment[b + k] + (mean[b + k] - mean[a + k]) / 2) / 4;
    }
}

void walk_decimate(Walk *s) {
    for (int d = 0; d < WALK_DIRECTIONS; d++) halve(s->value[d], s->mean[d], 1, s->block);
    halve_moment(&s->friction_moment[0][0][0], &s->friction_mean[0][0][0], 4, s->block);
    halve(&s->friction[0][0][0], &s->friction_mean[0][0][0], 4, s->block);
}

void walk_archive(Walk *s, Archive *archive) {
    Friction *const frictions[] = {s->friction, s->friction_mean, s->friction_moment};
    for (int d = 0; d < WALK_DIRECTIONS; d++) {
        archive_f64(archive, s->value[d], s->block + 1);
        archive_f64(archive, s->mean[d], s->block + 1);
    }
    for (size_t i = 0; i < sizeof frictions / sizeof *frictions; i++)
        archive_f64(archive, &frictions[i][0][0][0], 4 * (s->block + 1));
}
