// SPDX-License-Identifier: GPL-3.0-or-later
// F12 under shear that varies in time. Correlators are kept by their beginnings, where the time
// derivative is taken, and kernels by their ends, where the memory integral needs them; both over
// ages. As everything repeats with the period, as many beginnings as there are moments do for all.
// While ages are finer than moments, lines of other moments are interpolated by cubics.
#include "schematic/driven.h"

#include "base/constants.h"
#include "base/memory.h"
#include "schematic/ages.h"

#include <math.h>

enum { STENCIL = 4 };
static const double FIRST = 1e-8; // spacing of ages at the beginning, in 1/Gamma

struct Driven {
    DrivenSettings settings;
    size_t moments, ages; // ages: the last there is, in moments
    size_t finer, now;    // step is the time between moments over `finer`, a power of 2
    double slot, step;    // time between moments, between ages
    Ages *phi, *memory;   // [moment]: of a beginning, of an end
    Ages line;            // of an end between moments
    double *integral;     // [moment]: the stress at this end from the ages up to now
    double *stress;       // [ages + 1]
};

// Where a time between moments lies: the moments around it, and what each counts.
typedef struct Stencil {
    size_t moment[STENCIL];
    double weight[STENCIL];
    size_t count; // 1 at a moment
} Stencil;

// At the moment `from`, and `steps` steps of age later or, if they are negative, before.
static Stencil stencil_at(const Driven *d, size_t from, ptrdiff_t steps) {
    const ptrdiff_t finer = (ptrdiff_t)d->finer, moments = (ptrdiff_t)d->moments;
    const ptrdiff_t whole = steps >= 0 ? steps / finer : -((finer - 1 - steps) / finer);
    const double x = (double)(steps - whole * finer) / (double)finer;
    Stencil stencil = {.count = x == 0 ? 1 : STENCIL};
    for (size_t i = 0; i < stencil.count; i++) {
        const ptrdiff_t offset = stencil.count == 1 ? 0 : (ptrdiff_t)i - 1;
        const ptrdiff_t moment = ((ptrdiff_t)from + whole + offset) % moments;
        stencil.moment[i] = (size_t)(moment < 0 ? moment + moments : moment);
    }
    stencil.weight[0] = stencil.count == 1 ? 1 : -x * (x - 1) * (x - 2) / 6;
    stencil.weight[1] = (x + 1) * (x - 1) * (x - 2) / 2;
    stencil.weight[2] = -(x + 1) * x * (x - 2) / 2;
    stencil.weight[3] = (x + 1) * x * (x - 1) / 6;
    return stencil;
}

// The kernels that end there, up to age i - 1.
static const Ages *kernels_at(Driven *d, const Stencil *stencil, size_t i) {
    if (stencil->count == 1) return &d->memory[stencil->moment[0]];
    const double *w = stencil->weight;
    const Ages *m[STENCIL];
    for (size_t k = 0; k < STENCIL; k++) m[k] = &d->memory[stencil->moment[k]];
    for (size_t j = 1; j < i; j++) {
        d->line.at[j] =
            w[0] * m[0]->at[j] + w[1] * m[1]->at[j] + w[2] * m[2]->at[j] + w[3] * m[3]->at[j];
        d->line.mean[j] = w[0] * m[0]->mean[j] + w[1] * m[1]->mean[j] + w[2] * m[2]->mean[j] +
                          w[3] * m[3]->mean[j];
    }
    return &d->line;
}

static double strain_between(const Driven *d, double end, double age) {
    return strain_at(&d->settings.strain, end) - strain_at(&d->settings.strain, end - age);
}

// Backward differences of second order; the newest Phi is the root of a quadratic equation.
static void solve(Driven *d, size_t beginning, size_t i) {
    const F12 *model = &d->settings.model;
    Ages *phi = &d->phi[beginning];
    const double age = (double)i * d->step;
    const Stencil end = stencil_at(d, beginning, (ptrdiff_t)i);
    const Ages *memory = kernels_at(d, &end, i);
    const double decay =
        f12_strain_decay(model, strain_between(d, (double)beginning * d->slot + age, age));
    const double friction = 1 / (2 * d->step * model->rate);
    const double pull = decay * decay * (phi->at[0] - phi->mean[1]);
    const double rest =
        friction * (4 * phi->at[i - 1] - phi->at[i - 2]) - decay * ages_known(phi, memory, i);
    const double linear = 3 * friction + 1 + decay * memory->mean[1] - pull * model->v1;
    phi->at[i] = ages_root(linear, pull * model->v2, rest);
}

// The newest correlator that ends at this moment.
static double ending_at(const Driven *d, size_t end, size_t i) {
    const Stencil stencil = stencil_at(d, end, -(ptrdiff_t)i);
    double sum = 0;
    for (size_t k = 0; k < stencil.count; k++)
        sum += stencil.weight[k] * d->phi[stencil.moment[k]].at[i];
    return sum;
}

static double modulus_of(const Driven *d, double strain, double phi) {
    return f12_modulus_at(&d->settings.model, strain) * phi * phi;
}

static void settle_end(Driven *d, size_t end, size_t i) {
    const F12 *model = &d->settings.model;
    const double time = (double)end * d->slot, age = (double)i * d->step;
    const double phi = ending_at(d, end, i), strain = strain_between(d, time, age);
    d->memory[end].at[i] = f12_strain_decay(model, strain) * f12_coupling(model, phi);
    ages_average(&d->memory[end], i);
    const double before = strain_between(d, time, age - d->step);
    d->integral[end] +=
        (strain - before) / 2 *
        (modulus_of(d, strain, phi) + modulus_of(d, before, i == 1 ? 1 : ending_at(d, end, i - 1)));
}

// Kernels and stresses of the newest correlators. The stress of shear that began at 0 is that of
// the ages up to the time itself.
static void settle(Driven *d, size_t i) {
    for (size_t s = 0; s < d->moments; s++) ages_average(&d->phi[s], i);
    for (size_t end = 0; end < d->moments; end++) settle_end(d, end, i);
    if (i % d->finer == 0) d->stress[i / d->finer] = d->integral[i / d->finer % d->moments];
}

static void begin(Driven *d) {
    const F12 *model = &d->settings.model;
    const double coupling = f12_coupling(model, 1);
    while (d->slot / (double)d->finer * model->rate > FIRST) d->finer *= 2;
    d->step = d->slot / (double)d->finer;
    d->line.at[0] = coupling;
    for (size_t s = 0; s < d->moments; s++) {
        d->phi[s].at[0] = 1;
        d->memory[s].at[0] = coupling;
    }
    for (size_t i = 1; i <= d->settings.block / 2; i++) {
        for (size_t s = 0; s < d->moments; s++)
            d->phi[s].at[i] = ages_early(model->rate, coupling, (double)i * d->step);
        settle(d, i);
    }
    d->now = d->settings.block / 2;
}

static Status allocate(Driven *d) {
    const size_t block = d->settings.block, count = d->ages > block ? d->ages : block;
    TRY(NEW_ARRAY(d->phi, d->moments));
    TRY(NEW_ARRAY(d->memory, d->moments));
    TRY(NEW_ARRAY(d->integral, d->moments));
    TRY(NEW_ARRAY(d->stress, count + 1));
    TRY(ages_create(&d->line, count));
    for (size_t s = 0; s < d->moments; s++) {
        TRY(ages_create(&d->phi[s], count));
        TRY(ages_create(&d->memory[s], count));
    }
    return OK;
}

Status driven_create(Driven **out, const DrivenSettings *settings) {
    Driven *d = NULL;
    *out = NULL;
    ASSERT(settings->moments >= 2 * STENCIL && settings->block % 4 == 0 && settings->periods > 0);
    TRY(NEW(d));
    d->settings = *settings;
    d->moments = settings->moments;
    d->ages = settings->moments * settings->periods;
    d->slot = strain_period(&settings->strain) / (double)settings->moments;
    d->finer = 1;
    const Status status = allocate(d);
    if (status != OK) {
        driven_free(d);
        return status;
    }
    begin(d);
    *out = d;
    return OK;
}

static void free_lines(Ages *lines, size_t count) {
    for (size_t s = 0; lines && s < count; s++) ages_free(&lines[s]);
    memory_free(lines);
}

void driven_free(Driven *d) {
    if (!d) return;
    free_lines(d->phi, d->moments);
    free_lines(d->memory, d->moments);
    ages_free(&d->line);
    memory_free(d->integral);
    memory_free(d->stress);
    memory_free(d);
}

static void widen(Driven *d) {
    const size_t block = d->settings.block;
    for (size_t s = 0; s < d->moments; s++) {
        ages_halve(&d->phi[s], block);
        ages_halve(&d->memory[s], block);
    }
    d->finer /= 2;
    d->step *= 2;
    d->now = block / 2;
}

// The grid of ages widens until it is that of the moments, and then no more: a coarser one would
// not see the period.
void driven_advance(Driven *d) {
    if (d->now == d->settings.block && d->finer > 1) widen(d);
    const size_t i = ++d->now;
    for (size_t s = 0; s < d->moments; s++) solve(d, s, i);
    settle(d, i);
}

bool driven_finished(const Driven *d) {
    return d->now >= d->ages * d->finer;
}

double driven_age(const Driven *d) {
    return (double)d->now * d->step;
}

double driven_correlator(const Driven *d, size_t moment) {
    return d->phi[moment].at[d->now];
}

size_t driven_count(const Driven *d) {
    return d->ages;
}

double driven_time(const Driven *d, size_t i) {
    return (double)(i + 1) * d->slot;
}

double driven_strain(const Driven *d, size_t i) {
    return strain_at(&d->settings.strain, driven_time(d, i));
}

double driven_stress(const Driven *d, size_t i) {
    return d->stress[i + 1];
}

// Half of the work, but for the blocks before, grows with the square of the age.
double driven_share(const Driven *d) {
    const double block = (double)d->settings.block, ages = (double)d->ages;
    const double levels = log2((double)d->finer),
                 all = log2(d->slot * d->settings.model.rate / FIRST);
    const double of_blocks = 4 * block * block * fmax(all, 1), of_ages = ages * ages / 2;
    const double done = d->finer > 1 ? 4 * block * block * fmax(all - levels, 0)
                                     : of_blocks + (double)(d->now * d->now) / 2;
    return driven_finished(d) ? 1 : fmin(done / (of_blocks + of_ages), 0.999);
}

Harmonic driven_harmonic(const Driven *d, int n) {
    Harmonic sum = {0, 0};
    for (size_t k = 0; k < d->moments; k++) {
        const size_t i = d->ages - d->moments + k;
        const double angle = n * d->settings.strain.frequency * driven_time(d, i);
        sum.storage += 2 * driven_stress(d, i) * sin(angle) / (double)d->moments;
        sum.loss += 2 * driven_stress(d, i) * cos(angle) / (double)d->moments;
    }
    return sum;
}
