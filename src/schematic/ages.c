// SPDX-License-Identifier: GPL-3.0-or-later
// The memory integral over ages.
#include "schematic/ages.h"

#include "base/memory.h"

#include <math.h>

Status ages_create(Ages *ages, size_t count) {
    *ages = (Ages){NULL, NULL};
    TRY(NEW_ARRAY(ages->at, count + 1));
    return NEW_ARRAY(ages->mean, count + 1);
}

void ages_free(Ages *ages) {
    memory_free(ages->at);
    memory_free(ages->mean);
    *ages = (Ages){NULL, NULL};
}

void ages_average(Ages *ages, size_t i) {
    ages->mean[i] = (ages->at[i - 1] + ages->at[i]) / 2;
}

void ages_halve(Ages *ages, size_t block) {
    for (size_t i = 1; i <= block / 2; i++) {
        ages->at[i] = ages->at[2 * i];
        ages->mean[i] = (ages->mean[2 * i - 1] + ages->mean[2 * i]) / 2;
    }
}

double ages_known(const Ages *f, const Ages *m, size_t i) {
    const size_t half = i / 2;
    double sum =
        m->at[i - half] * f->at[half] - m->mean[1] * f->at[i - 1] - m->at[i - 1] * f->mean[1];
    for (size_t l = 2; l <= i - half; l++) sum += m->mean[l] * (f->at[i - l + 1] - f->at[i - l]);
    for (size_t j = 2; j <= half; j++) sum += f->mean[j] * (m->at[i - j + 1] - m->at[i - j]);
    return sum;
}

double ages_early(double rate, double coupling, double age) {
    const double x = rate * age;
    return 1 - x + x * x / 2 * (1 + coupling);
}

double ages_root(double linear, double square, double rest) {
    return 2 * rest / (linear + sqrt(fmax(0, linear * linear - 4 * square * rest)));
}
