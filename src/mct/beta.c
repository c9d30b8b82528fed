// SPDX-License-Identifier: GPL-3.0-or-later
// The beta-scaling equation on a grid whose spacing doubles from block to block (Fuchs et al., J.
// Phys.: Condens. Matter 3, 5047, 1991). In the older half of the integral one factor is slow and
// the other is known by its averages over intervals, so that t^-a needs no fine grid at t = 0.
#include "mct/beta.h"

#include "base/memory.h"

#include <math.h>

enum { BLOCK = 1024, BLOCKS_MOST = 200 };
static const double FIRST = 1e-12; // of time, where t^-a is G to the last digits
static const double OUTSIDE = 1e3; // of -G

typedef struct Scaling {
    BetaSettings settings;
    double a, step;
    size_t block;
    double *g;    // [block + 1] at i step; g[0] is infinite and never used
    double *mean; // [block + 1]: of interval i, from (i - 1) step to i step
} Scaling;

static Status scaling_create(Scaling *scaling, const BetaSettings *settings, double a) {
    *scaling = (Scaling){.settings = *settings, .a = a, .step = FIRST};
    scaling->block = settings->block ? settings->block : BLOCK;
    TRY(NEW_ARRAY(scaling->g, scaling->block + 1));
    return NEW_ARRAY(scaling->mean, scaling->block + 1);
}

static void begin(Scaling *scaling) {
    const double h = scaling->step, a = scaling->a;
    for (size_t i = 1; i <= scaling->block / 2; i++) {
        scaling->g[i] = pow((double)i * h, -a);
        scaling->mean[i] =
            (pow((double)i * h, 1 - a) - pow((double)(i - 1) * h, 1 - a)) / ((1 - a) * h);
    }
}

// d/dt int G G at t = i step without its terms in the unknown G_i, which are 2 mean[1] G_i.
static double known_part(const Scaling *scaling, size_t i) {
    const double *g = scaling->g, *mean = scaling->mean;
    const size_t half = i / 2;
    double sum = g[i - half] * g[half] - 2 * mean[1] * g[i - 1];
    for (size_t l = 2; l <= i - half; l++) sum += mean[l] * (g[i - l + 1] - g[i - l]);
    for (size_t j = 2; j <= half; j++) sum += mean[j] * (g[i - j + 1] - g[i - j]);
    return sum;
}

// lambda G^2 - 2 mean G + (sigma - shear t^2 - known) = 0, the root that follows from before.
static void advance(Scaling *scaling, size_t i) {
    const double t = (double)i * scaling->step, lambda = scaling->settings.lambda;
    const double rest =
        scaling->settings.sigma - scaling->settings.shear * t * t - known_part(scaling, i);
    const double mean = scaling->mean[1];
    scaling->g[i] = rest / (mean + sqrt(fmax(0, mean * mean - lambda * rest)));
    scaling->mean[i] = (scaling->g[i - 1] + scaling->g[i]) / 2;
}

static void decimate(Scaling *scaling) {
    for (size_t i = 1; i <= scaling->block / 2; i++) {
        scaling->g[i] = scaling->g[2 * i];
        scaling->mean[i] = (scaling->mean[2 * i - 1] + scaling->mean[2 * i]) / 2;
    }
    scaling->step *= 2;
}

static void record(BetaFunction *beta, double time, double value) {
    beta->time[beta->count] = time;
    beta->value[beta->count] = value;
    beta->count++;
}

static void solve(Scaling *scaling, BetaFunction *beta) {
    begin(scaling);
    for (size_t i = 1; i <= scaling->block / 2; i++)
        record(beta, (double)i * scaling->step, scaling->g[i]);
    for (int block = 0; block < BLOCKS_MOST; block++) {
        for (size_t i = scaling->block / 2 + 1; i <= scaling->block; i++) {
            advance(scaling, i);
            const double time = (double)i * scaling->step;
            if (time > scaling->settings.last || scaling->g[i] < -OUTSIDE) return;
            record(beta, time, scaling->g[i]);
        }
        decimate(scaling);
    }
}

Status beta_create(BetaFunction **out, const BetaSettings *settings) {
    BetaFunction *beta = NULL;
    Scaling scaling = {.g = NULL};
    *out = NULL;
    TRY(NEW(beta));
    Status status = exponents_of(settings->lambda, &beta->exponents);
    if (status == OK) status = scaling_create(&scaling, settings, beta->exponents.a);
    const size_t most = (BLOCKS_MOST + 1) * (scaling.block / 2);
    if (status == OK) status = NEW_ARRAY(beta->time, most);
    if (status == OK) status = NEW_ARRAY(beta->value, most);
    if (status == OK) solve(&scaling, beta);
    memory_free(scaling.g);
    memory_free(scaling.mean);
    if (status != OK) beta_free(beta);
    *out = status == OK ? beta : NULL;
    return status;
}

void beta_free(BetaFunction *beta) {
    if (!beta) return;
    memory_free(beta->time);
    memory_free(beta->value);
    memory_free(beta);
}

// The next term of G after -B t^b is t^-b: far out the first alone is left.
Status beta_von_schweidler(double lambda, double *amplitude) {
    BetaFunction *beta = NULL;
    TRY(beta_create(&beta, &(BetaSettings){.lambda = lambda, .sigma = -1, .last = 1e9}));
    const size_t end = beta->count - 1;
    *amplitude = -beta->value[end] * pow(beta->time[end], -beta->exponents.b);
    beta_free(beta);
    return OK;
}
