// SPDX-License-Identifier: GPL-3.0-or-later
// F12 at rest and under steady shear: the memory depends on ages alone, m(t, t', s) = h(t) mbar(t -
// t') with mbar = h (v1 Phi + v2 Phi^2), so that one doubling grid does for all times.
#include "schematic/steady.h"

#include "base/memory.h"
#include "schematic/ages.h"

#include <math.h>

static const double FIRST = 1e-8;    // spacing at the beginning, in 1/Gamma and in strain
static const double DECAYED = 1e-12; // of Phi

struct Steady {
    SteadySettings settings;
    size_t block, now;
    double step;
    Ages phi, memory;
    double integral; // int v_sigma Phi^2
};

static double strain_at(const Steady *s, size_t i) {
    return s->settings.shear_rate * (double)i * s->step;
}

// The memory of the newest Phi, the averages, and what the interval adds to the stress.
static void settle(Steady *s, size_t i) {
    const F12 *model = &s->settings.model;
    const double phi = s->phi.at[i], before = s->phi.at[i - 1], strain = strain_at(s, i);
    s->memory.at[i] = f12_strain_decay(model, strain) * f12_coupling(model, phi);
    ages_average(&s->phi, i);
    ages_average(&s->memory, i);
    s->integral += s->step / 2 *
                   (f12_modulus_at(model, strain) * phi * phi +
                    f12_modulus_at(model, strain_at(s, i - 1)) * before * before);
}

// So short a time that the free decay and the first of the memory are all.
static void begin(Steady *s) {
    const F12 *model = &s->settings.model;
    const double coupling = f12_coupling(model, 1);
    s->step = FIRST / fmax(model->rate, fabs(s->settings.shear_rate) / model->critical_strain) *
              AGES_BLOCK / (double)s->block;
    s->phi.at[0] = 1;
    s->memory.at[0] = coupling;
    for (size_t i = 1; i <= s->block / 2; i++) {
        s->phi.at[i] = ages_early(model->rate, coupling, (double)i * s->step);
        settle(s, i);
    }
}

// Backward differences of second order; the newest Phi is the root of a quadratic equation.
static void solve(Steady *s, size_t i) {
    const F12 *model = &s->settings.model;
    const double decay = f12_strain_decay(model, strain_at(s, i));
    const double friction = 1 / (2 * s->step * model->rate);
    const double pull = decay * decay * (s->phi.at[0] - s->phi.mean[1]);
    const double rest = friction * (4 * s->phi.at[i - 1] - s->phi.at[i - 2]) -
                        decay * ages_known(&s->phi, &s->memory, i);
    const double linear = 3 * friction + 1 + decay * s->memory.mean[1] - pull * model->v1;
    s->phi.at[i] = ages_root(linear, pull * model->v2, rest);
    settle(s, i);
}

Status steady_create(Steady **out, const SteadySettings *settings) {
    Steady *s = NULL;
    *out = NULL;
    TRY(NEW(s));
    s->settings = *settings;
    s->block = settings->block ? settings->block : AGES_BLOCK;
    Status status = ages_create(&s->phi, s->block);
    if (status == OK) status = ages_create(&s->memory, s->block);
    if (status != OK) {
        steady_free(s);
        return status;
    }
    begin(s);
    s->now = s->block / 2;
    *out = s;
    return OK;
}

void steady_free(Steady *s) {
    if (!s) return;
    ages_free(&s->phi);
    ages_free(&s->memory);
    memory_free(s);
}

void steady_advance(Steady *s) {
    if (s->now == s->block) {
        ages_halve(&s->phi, s->block);
        ages_halve(&s->memory, s->block);
        s->step *= 2;
        s->now = s->block / 2;
    }
    solve(s, ++s->now);
}

double steady_time(const Steady *s) {
    return (double)s->now * s->step;
}

double steady_correlator(const Steady *s) {
    return s->phi.at[s->now];
}

double steady_stress(const Steady *s) {
    return s->settings.shear_rate * s->integral;
}

double steady_viscosity(const Steady *s) {
    return s->integral;
}

bool steady_has_decayed(const Steady *s) {
    return fabs(steady_correlator(s)) < DECAYED;
}
