// SPDX-License-Identifier: GPL-3.0-or-later
// Any closure for any mixture of hard discs or spheres, on grids of distances and wave numbers that
// transform into each other (zeros of J0 in two dimensions, multiples in three). The unknown is
// gamma = h - c, which is smooth. What is not, is taken out before a transform and put back in
// closed form: steps of c and of its slope at contact, and the overlap of two cores in gamma. The
// fixed point is found by Anderson's mixing, followed in density.
#include "oz/inside.h"

#include "base/constants.h"
#include "base/memory.h"
#include "base/patience.h"
#include "numerics/anderson.h"
#include "numerics/small.h"

#include <gsl/gsl_sf_bessel.h>

#include <math.h>
#include <string.h>

enum { DEPTH = 12, ITERATIONS_MOST = 600, NEIGHBOURS = 6, TUNINGS_MOST = 40, BACKS_MOST = 25 };
static const double RANGE = 14;        // of distances, in the largest diameter
static const double SPACING = 0.0125;  // of distances, in the smallest
static const double CARE = 0.2;        // part of an image that a careful step takes
static const double CONVERGED = 1e-10; // change of gamma in an iteration
// Steps of packing fraction by which solutions are followed; where one fails, the next begins anew.
enum { ATTEMPTS = 3 };
static const double DENSITY_STEPS[ATTEMPTS] = {0.1, 0.05, 0.02};
static const double SLOPE_STEP = 1e-5; // of distance, for the slope of g at contact
// Rogers and Young: where the mixing parameter is looked for, and by how much densities are changed
// to see the compressibility.
static const double ALPHA_LEAST = 0.02, ALPHA_MOST = 8, COMPRESSION = 0.005;
static const double CONSISTENT = 1e-5; // of the inverse compressibility
static const double NO_WAVE = 1e-3;    // a wave number that stands for zero, times the diameter

struct Closures {
    Closure closure;
    Mixture mixture;
    size_t pairs, count; // of distances and of wave numbers
    double *r, *k, *r_weight;
    double *forth, *back; // [count][count]: with their weights, rows by the new argument
    double *steps[2];     // [pair][count]: transforms of the steps at contact
    double *lens;         // [c][pair][count]: overlap of the cores ac and cb
    double *gamma, *before, *image, *smooth, *transform; // [pair][count]
    double jump[2][MIXTURE_PAIRS_MOST];                  // of c and of its slope at contact
    double alpha;                                        // of Rogers and Young
    double solved;                                       // packing fraction of gamma; 0: none
    Anderson *mixing;
    size_t asked;        // wave numbers
    double *asked_wave;  // [asked]
    double *asked_forth; // [asked][count]
};

// ---- Grids -------------------------------------------------------------------------------------

static double zero(int dimension, size_t index) {
    return dimension == 2 ? gsl_sf_bessel_zero_J0((unsigned)index) : PI * (double)index;
}

static double wave(int dimension, double x) {
    return dimension == 2 ? j0(x) : gsl_sf_bessel_j0(x);
}

// Of int f x^(d-1) dx over the sphere of directions, at x = zero/range.
static double weight(int dimension, double at, double range) {
    if (dimension == 3) return 4 * PI * pow(at / range, 2) * PI / range;
    return 2 * PI * 2 / pow(range * j1(at), 2);
}

static double core_step(int dimension, double diameter, double k) {
    const double x = k * diameter;
    return dimension == 2 ? 2 * PI * diameter * j1(x) / k
                          : 4 * PI * diameter * diameter * gsl_sf_bessel_j1(x) / k;
}

// Of (diameter^2 - r^2)/(2 diameter) in the core, whose slope at contact is -1.
static double core_slope(int dimension, double diameter, double k) {
    const double x = k * diameter;
    return dimension == 2 ? 2 * PI * diameter * jn(2, x) / (k * k)
                          : 4 * PI * diameter * diameter * gsl_sf_bessel_j2(x) / (k * k);
}

// Area or volume common to two cores of these radii, r apart.
static double overlap(int dimension, double a, double b, double r) {
    const double less = fmin(a, b);
    if (r >= a + b) return 0;
    if (r <= fabs(a - b)) return dimension == 2 ? PI * less * less : 4 * PI / 3 * pow(less, 3);
    if (dimension == 3)
        return PI * pow(a + b - r, 2) * (r * r + 2 * r * (a + b) - 3 * pow(a - b, 2)) / (12 * r);
    const double x = (r * r + a * a - b * b) / (2 * r), y = r - x;
    return a * a * acos(x / a) - x * sqrt(fmax(0, a * a - x * x)) + b * b * acos(y / b) -
           y * sqrt(fmax(0, b * b - y * y));
}

static void fill_transforms(Closures *c) {
    const int d = c->mixture.dimension;
    const double end = zero(d, c->count + 1), range = c->r[0], band = end / range;
    for (size_t i = 0; i < c->count; i++) {
        c->r[i] = zero(d, i + 1) / band;
        c->k[i] = zero(d, i + 1) / range;
    }
    for (size_t i = 0; i < c->count; i++) {
        const double r_weight = weight(d, zero(d, i + 1), band);
        c->r_weight[i] = r_weight;
        const double k_weight = weight(d, zero(d, i + 1), range) / pow(2 * PI, d);
        for (size_t m = 0; m < c->count; m++) {
            const double value = wave(d, c->r[i] * c->k[m]);
            c->forth[m * c->count + i] = r_weight * value;
            c->back[m * c->count + i] = k_weight * wave(d, c->r[m] * c->k[i]);
        }
        for (size_t m = 0; m < c->asked; m++)
            c->asked_forth[m * c->count + i] = r_weight * wave(d, c->r[i] * c->asked_wave[m]);
    }
}

static void fill_pairs(Closures *c) {
    const Mixture *mixture = &c->mixture;
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = a; b < mixture->species; b++) {
            const size_t pair = mixture_pair(mixture->species, a, b);
            const double contact = mixture_contact(mixture, a, b);
            for (size_t i = 0; i < c->count; i++) {
                c->steps[0][pair * c->count + i] = core_step(mixture->dimension, contact, c->k[i]);
                c->steps[1][pair * c->count + i] = core_slope(mixture->dimension, contact, c->k[i]);
                for (size_t e = 0; e < mixture->species; e++)
                    c->lens[(e * c->pairs + pair) * c->count + i] =
                        overlap(mixture->dimension, mixture_contact(mixture, a, e),
                                mixture_contact(mixture, e, b), c->r[i]);
            }
        }
    }
}

static Status allocate(Closures *c) {
    const size_t field = c->pairs * c->count;
    TRY(NEW_ARRAY(c->r, c->count));
    TRY(NEW_ARRAY(c->k, c->count));
    TRY(NEW_ARRAY(c->r_weight, c->count));
    TRY(NEW_ARRAY(c->forth, c->count * c->count));
    TRY(NEW_ARRAY(c->back, c->count * c->count));
    TRY(NEW_ARRAY(c->steps[0], field));
    TRY(NEW_ARRAY(c->steps[1], field));
    TRY(NEW_ARRAY(c->lens, c->mixture.species * field));
    TRY(NEW_ARRAY(c->gamma, field));
    TRY(NEW_ARRAY(c->before, field));
    TRY(NEW_ARRAY(c->image, field));
    TRY(NEW_ARRAY(c->smooth, field));
    TRY(NEW_ARRAY(c->transform, field));
    TRY(NEW_ARRAY(c->asked_wave, c->asked));
    TRY(NEW_ARRAY(c->asked_forth, c->asked * c->count));
    return anderson_create(&c->mixing, field, DEPTH);
}

Status closures_create(Closures **out, Closure closure, const Mixture *mixture,
                       const double *wave_number, size_t count) {
    Closures *c = NULL;
    double smallest = INFINITY, largest = 0;
    *out = NULL;
    TRY(NEW(c));
    c->closure = closure;
    c->mixture = *mixture;
    c->pairs = mixture_pairs(mixture);
    c->alpha = 1;
    c->asked = count;
    for (size_t a = 0; a < mixture->species; a++) {
        smallest = fmin(smallest, mixture->diameter[a]);
        largest = fmax(largest, mixture->diameter[a]);
    }
    c->count = (size_t)(RANGE * largest / (SPACING * smallest));
    const Status status = allocate(c);
    if (status != OK) {
        closures_free(c);
        return status;
    }
    memcpy(c->asked_wave, wave_number, count * sizeof *wave_number);
    c->r[0] = RANGE * largest; // for fill_transforms, which lays the grids
    fill_transforms(c);
    fill_pairs(c);
    *out = c;
    return OK;
}

void closures_free(Closures *c) {
    if (!c) return;
    double *const arrays[] = {c->r,         c->k,        c->forth,      c->back,        c->steps[0],
                              c->steps[1],  c->lens,     c->gamma,      c->image,       c->smooth,
                              c->transform, c->r_weight, c->asked_wave, c->asked_forth, c->before};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) memory_free(arrays[i]);
    anderson_free(c->mixing);
    memory_free(c);
}

// ---- Closures ----------------------------------------------------------------------------------

// y = g outside the core, from gamma at distance r of a pair in contact at `contact`.
static double cavity(const Closures *c, double gamma, double r, double contact) {
    switch (c->closure) {
    case CLOSURE_HYPERNETTED_CHAIN:
        return exp(gamma);
    case CLOSURE_MODIFIED_VERLET: // Verlet, Mol. Phys. 42, 1291 (1981)
        return exp(gamma - gamma * gamma / (2 * (1 + 0.8 * fabs(gamma))));
    case CLOSURE_ROGERS_YOUNG: { // Rogers & Young, Phys. Rev. A 30, 999 (1984)
        const double mixing = -expm1(-c->alpha * r / contact);
        return 1 + expm1(mixing * gamma) / mixing;
    }
    default:
        return 1 + gamma;
    }
}

// Value and slope at x of the polynomial through the points nearest to it.
static void interpolate(const double *points, const double *values, size_t count, double x,
                        double *value, double *slope) {
    size_t first = 0;
    while (first + NEIGHBOURS < count && points[first + NEIGHBOURS / 2] < x) first++;
    *value = *slope = 0;
    for (size_t i = first; i < first + NEIGHBOURS; i++) {
        double basis = 1, derivative = 0;
        for (size_t j = first; j < first + NEIGHBOURS; j++) {
            if (j == i) continue;
            const double factor = 1 / (points[i] - points[j]);
            derivative = derivative * (x - points[j]) * factor + basis * factor;
            basis *= (x - points[j]) * factor;
        }
        *value += basis * values[i];
        *slope += derivative * values[i];
    }
}

// The steps of c and of its slope at contact are those of g.
static void fill_jumps(Closures *c, size_t pair, double contact) {
    double value, slope;
    interpolate(c->r, c->gamma + pair * c->count, c->count, contact, &value, &slope);
    const double before = cavity(c, value - slope * SLOPE_STEP, contact - SLOPE_STEP, contact);
    const double after = cavity(c, value + slope * SLOPE_STEP, contact + SLOPE_STEP, contact);
    c->jump[0][pair] = cavity(c, value, contact, contact);
    c->jump[1][pair] = (after - before) / (2 * SLOPE_STEP);
}

// c with its steps taken out: c = smooth - jump in the core + slope (contact^2 - r^2)/(2 contact).
static void fill_smooth(Closures *c, size_t pair, double contact) {
    const double *gamma = c->gamma + pair * c->count;
    double *smooth = c->smooth + pair * c->count;
    fill_jumps(c, pair, contact);
    for (size_t i = 0; i < c->count; i++) {
        const double r = c->r[i];
        smooth[i] = r < contact ? -1 - gamma[i] + c->jump[0][pair] -
                                      c->jump[1][pair] * (contact * contact - r * r) / (2 * contact)
                                : cavity(c, gamma[i], r, contact) - 1 - gamma[i];
    }
}

static double dot(const double *a, const double *b, size_t count) {
    double sum[4] = {0};
    size_t n = 0;
    for (; n + 4 <= count; n += 4) {
        for (size_t i = 0; i < 4; i++) sum[i] += a[n + i] * b[n + i];
    }
    for (; n < count; n++) sum[0] += a[n] * b[n];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

// c(k) of all pairs.
static void fill_direct(Closures *c) {
    const size_t species = c->mixture.species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++)
            fill_smooth(c, mixture_pair(species, a, b), mixture_contact(&c->mixture, a, b));
    }
    for (size_t m = 0; m < c->count; m++) {
        for (size_t pair = 0; pair < c->pairs; pair++) {
            const size_t at = pair * c->count + m;
            c->transform[at] = dot(c->forth + m * c->count, c->smooth + pair * c->count, c->count) -
                               c->jump[0][pair] * c->steps[0][at] +
                               c->jump[1][pair] * c->steps[1][at];
        }
    }
}

// sum_e rho_e Y_ae Y_eb times what the cores give.
static double cores(const Closures *c, double density, size_t a, size_t b, size_t m, bool lenses) {
    const size_t species = c->mixture.species, pair = mixture_pair(species, a, b);
    double sum = 0;
    for (size_t e = 0; e < species; e++) {
        const size_t ae = mixture_pair(species, a, e), eb = mixture_pair(species, e, b);
        const double shape = lenses
                                 ? c->lens[(e * c->pairs + pair) * c->count + m]
                                 : c->steps[0][ae * c->count + m] * c->steps[0][eb * c->count + m];
        sum += density * c->mixture.fraction[e] * c->jump[0][ae] * c->jump[0][eb] * shape;
    }
    return sum;
}

// gamma(k) = h - c from c, less its slowest part at large k, in place of c.
static Status fill_gamma(Closures *c, double density) {
    const size_t species = c->mixture.species;
    for (size_t m = 0; m < c->count; m++) {
        SmallMatrix scaled = {{0}}, inverse, response;
        for (size_t a = 0; a < species; a++) {
            for (size_t b = 0; b < species; b++) {
                const double roots =
                    density * sqrt(c->mixture.fraction[a] * c->mixture.fraction[b]);
                scaled[a][b] = roots * c->transform[mixture_pair(species, a, b) * c->count + m];
                inverse[a][b] = (a == b) - scaled[a][b];
            }
        }
        if (!small_is_positive(species, inverse) || !small_invert(species, inverse, response))
            return status_fail(UNHEALTHY, "%s: no fluid, S(q) is not positive at q = %g",
                               closure_names[c->closure], c->k[m]);
        for (size_t a = 0; a < species; a++) {
            for (size_t b = a; b < species; b++) {
                const double roots =
                    density * sqrt(c->mixture.fraction[a] * c->mixture.fraction[b]);
                c->transform[mixture_pair(species, a, b) * c->count + m] =
                    (response[a][b] - (a == b) - scaled[a][b]) / roots -
                    cores(c, density, a, b, m, false);
            }
        }
    }
    return OK;
}

// The image of gamma(r); the largest change.
static Status map(Closures *c, double density, double *change) {
    const size_t species = c->mixture.species;
    fill_direct(c);
    TRY(fill_gamma(c, density));
    *change = 0;
    for (size_t i = 0; i < c->count; i++) {
        for (size_t a = 0; a < species; a++) {
            for (size_t b = a; b < species; b++) {
                const size_t pair = mixture_pair(species, a, b), at = pair * c->count + i;
                c->image[at] =
                    dot(c->back + i * c->count, c->transform + pair * c->count, c->count) +
                    cores(c, density, a, b, i, true);
                *change = fmax(*change, fabs(c->image[at] - c->gamma[at]));
            }
        }
    }
    return OK;
}

// Where no fluid is: back to the iteration before, and a careful step from there.
static void step_back(Closures *c) {
    for (size_t i = 0; i < c->pairs * c->count; i++)
        c->gamma[i] = c->before[i] + CARE * (c->image[i] - c->before[i]);
    anderson_restart(c->mixing);
}

static Status converge(Closures *c, double packing_fraction, OzEffort *effort) {
    const double density = mixture_density(&c->mixture, packing_fraction);
    int backs = 0;
    bool any = false; // an iteration to go back to
    effort->at = packing_fraction;
    anderson_restart(c->mixing);
    for (effort->iterations = 0; effort->iterations < ITERATIONS_MOST; effort->iterations++) {
        TRY(patience_check());
        const Status status = map(c, density, &effort->residual);
        if (status == OK && effort->residual < CONVERGED) return OK;
        if (status != OK && (!any || backs == BACKS_MOST)) return status;
        if (status != OK) {
            backs++;
            step_back(c);
            continue;
        }
        any = true;
        memcpy(c->before, c->gamma, c->pairs * c->count * sizeof *c->gamma);
        anderson_mix(c->mixing, c->gamma, c->image);
    }
    return status_fail(UNHEALTHY, "%s: h - c still changes from iteration to iteration",
                       closure_names[c->closure]);
}

// In steps of density, from the last solution or from the dilute limit.
static Status walk(Closures *c, double packing_fraction, double step, OzEffort *effort) {
    if (c->solved == 0) memset(c->gamma, 0, c->pairs * c->count * sizeof *c->gamma);
    double now = c->solved;
    do {
        const double way = packing_fraction - now;
        now = fabs(way) <= step ? packing_fraction : now + (way > 0 ? step : -step);
        c->solved = 0;
        TRY(converge(c, now, effort));
        effort->reached = c->solved = now;
    } while (now != packing_fraction);
    return OK;
}

static Status follow(Closures *c, double packing_fraction, OzEffort *effort) {
    Status status = UNHEALTHY;
    for (int attempt = 0; attempt < ATTEMPTS && status == UNHEALTHY; attempt++)
        status = walk(c, packing_fraction, DENSITY_STEPS[attempt], effort);
    return status;
}

// ---- Rogers and Young --------------------------------------------------------------------------

// P/(kT) from the contact values, which are the steps of c.
static double virial_pressure(const Closures *c, double density) {
    const Mixture *mixture = &c->mixture;
    double sum = 0;
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = 0; b < mixture->species; b++)
            sum += mixture->fraction[a] * mixture->fraction[b] *
                   pow(mixture_contact(mixture, a, b), mixture->dimension) *
                   c->jump[0][mixture_pair(mixture->species, a, b)];
    }
    return density + density * density * sum * (mixture->dimension == 2 ? PI / 2 : 2 * PI / 3);
}

// dP/drho/(kT) = 1 - rho sum x_a x_b c_ab(q = 0).
static double inverse_compressibility(const Closures *c, double density) {
    const Mixture *mixture = &c->mixture;
    const int d = mixture->dimension;
    double sum = 0;
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = 0; b < mixture->species; b++) {
            const size_t pair = mixture_pair(mixture->species, a, b);
            const double contact = mixture_contact(mixture, a, b), k = NO_WAVE / contact;
            sum += mixture->fraction[a] * mixture->fraction[b] *
                   (dot(c->r_weight, c->smooth + pair * c->count, c->count) -
                    c->jump[0][pair] * core_step(d, contact, k) +
                    c->jump[1][pair] * core_slope(d, contact, k));
        }
    }
    return 1 - density * sum;
}

// How much stiffer the fluid is by its compressibility than by its pressure, with this mixing.
static Status mismatch(Closures *c, double packing_fraction, double alpha, double *difference,
                       OzEffort *effort) {
    const double above = packing_fraction * (1 + COMPRESSION);
    const double below = packing_fraction * (1 - COMPRESSION);
    const double high = mixture_density(&c->mixture, above);
    const double low = mixture_density(&c->mixture, below);
    c->alpha = alpha;
    TRY(follow(c, above, effort));
    const double high_pressure = virial_pressure(c, high);
    TRY(follow(c, below, effort));
    const double low_pressure = virial_pressure(c, low);
    TRY(follow(c, packing_fraction, effort));
    *difference = inverse_compressibility(c, mixture_density(&c->mixture, packing_fraction)) -
                  (high_pressure - low_pressure) / (high - low);
    return OK;
}

// The mixing for which both agree, by false position in its logarithm: between Percus-Yevick, too
// stiff by its compressibility, and the hypernetted chain, too soft.
static Status tune(Closures *c, double packing_fraction, OzEffort *effort) {
    double low = log(ALPHA_LEAST), high = log(ALPHA_MOST), at_low, at_high, here;
    TRY(mismatch(c, packing_fraction, exp(low), &at_low, effort));
    TRY(mismatch(c, packing_fraction, exp(high), &at_high, effort));
    if (at_low * at_high > 0)
        return status_fail(UNHEALTHY,
                           "rogers-young: no mixing between %g and %g makes pressure and "
                           "compressibility agree at packing fraction %g",
                           ALPHA_LEAST, ALPHA_MOST, packing_fraction);
    for (int step = 0; step < TUNINGS_MOST; step++) {
        const double next = (low * at_high - high * at_low) / (at_high - at_low);
        TRY(mismatch(c, packing_fraction, exp(next), &here, effort));
        if (fabs(here) < CONSISTENT) return OK;
        const bool replaces_low = here * at_low > 0;
        if (replaces_low) {
            low = next;
            at_low = here;
            at_high /= 2; // the Illinois rule: an end that stays counts half
        } else {
            high = next;
            at_high = here;
            at_low /= 2;
        }
    }
    return status_fail(UNHEALTHY, "rogers-young: pressure and compressibility still differ by %.3g",
                       here);
}

Status closures_solve(Closures *c, Structure *structure, OzEffort *effort) {
    const double phi = structure->packing_fraction;
    TRY(c->closure == CLOSURE_ROGERS_YOUNG ? tune(c, phi, effort) : follow(c, phi, effort));
    const Mixture *mixture = &c->mixture;
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = a; b < mixture->species; b++) {
            const size_t pair = mixture_pair(mixture->species, a, b);
            const double contact = mixture_contact(mixture, a, b);
            const double *smooth = c->smooth + pair * c->count;
            structure->contact[pair] = c->jump[0][pair];
            for (size_t m = 0; m < c->asked; m++)
                structure->direct[pair * c->asked + m] =
                    dot(c->asked_forth + m * c->count, smooth, c->count) -
                    c->jump[0][pair] * core_step(mixture->dimension, contact, c->asked_wave[m]) +
                    c->jump[1][pair] * core_slope(mixture->dimension, contact, c->asked_wave[m]);
        }
    }
    return OK;
}
