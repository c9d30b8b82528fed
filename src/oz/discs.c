// SPDX-License-Identifier: GPL-3.0-or-later
// Percus-Yevick for any mixture of hard discs, by collocation. c_ab(r) vanishes beyond contact; the
// core is cut where the solution is not smooth, and on each panel c is a sum of Chebyshev
// polynomials of t with r = from + (to - from) t^2 (3 - 2 t), which turns the half-integer powers
// at the ends of panels into smooth ones. The unknowns are the coefficients, the equations h_ab(r)
// = -1 at the Chebyshev points; Newton's method.
#include "oz/inside.h"

#include "base/constants.h"
#include "base/memory.h"
#include "base/patience.h"
#include "numerics/quadrature.h"
#include "numerics/small.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PANELS_MOST = 64,
    ALONE = 20,      // Chebyshev polynomials on a panel that is the whole core: a multiple of 4
    IN_COMPANY = 12, // and on one of several
    STEPS_MOST = 60, // of Newton's method
    Q_POINTS = 5,    // of Gauss quadrature on a panel of wave numbers
    ATTEMPTS = 4,    // to follow the solution to a density, with ever shorter steps
};

// Panels of wave numbers, narrow where S(q) has its peaks: width in 1/largest diameter, end in
// 1/smallest diameter. What lies beyond the last is below 1e-8 of h.
static const struct { double width, end; } Q_PANELS[] = {{0.2, 12}, {0.4, 40}, {1.5, 900}};
enum { Q_PANEL_KINDS = 3 };
static const double Q_NEWTON = 40; // the derivatives of Newton's method leave out what is beyond

static const double CONVERGED = 1e-9;   // of h + 1; rounding leaves 1e-10
static const double NEAR_ENOUGH = 1e-4; // on the way to the density that is wanted
// Packing fractions: the steps by which solutions are followed, below and above DILUTE.
static const double DILUTE = 0.5, LONG_STEP = 0.25, SHORT_STEP = 0.08;
static const double CLOSE = 1e-9; // of breakpoints: the same

struct Discs {
    Mixture mixture;
    size_t pairs, panels;
    double from[PANELS_MOST], to[PANELS_MOST];
    size_t order;                       // polynomials per panel
    size_t basis;                       // panels x order
    size_t in_core[MIXTURE_PAIRS_MOST]; // basis functions inside the core of a pair
    size_t first[MIXTURE_PAIRS_MOST];   // its first unknown
    size_t unknowns;
    size_t waves, newton_waves; // quadrature over wave numbers, ascending
    double *q, *weight;
    double *transform;   // [waves][basis]: of the polynomials
    double *back;        // [waves][basis]: q weight J0(q r)/(2 pi) at the collocation points
    double *core;        // [waves][pair]: transform of the core, 1 inside
    double *value;       // [basis point][basis]: of the polynomials at the points
    double *lens;        // [c][pair][basis point]: overlap of the cores ac and cb at distance r
    double *lens_beyond; // likewise: what of it wave numbers beyond those of Newton's method make
    double *coefficient; // [unknowns], the solution so far
    double *earlier;     // [unknowns], the solution before it
    double *residual;    // [unknowns]
    double *excess;      // [pair][waves]: what of h - c is transformed back
    gsl_matrix *newton;  // decomposed
    gsl_permutation *order_of_rows;
    double solved; // packing fraction of the solution; 0: none
    double solved_earlier;
    size_t count;  // of wave numbers asked for
    double *asked; // [count][basis]
};

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void add_break(double *breaks, size_t *count, double r, double most) {
    if (r < CLOSE || r > most - CLOSE) return;
    for (size_t i = 0; i < *count; i++) {
        if (fabs(breaks[i] - r) < CLOSE) return;
    }
    if (*count < PANELS_MOST - 1) breaks[(*count)++] = r;
}

// Where h - c of some pair is not smooth: at differences of two contact distances, and at sums of
// two less a third.
static void add_breaks(const Discs *discs, double *breaks, size_t *count, double most) {
    const Mixture *mixture = &discs->mixture;
    double contact[MIXTURE_PAIRS_MOST];
    for (size_t a = 0; a < mixture->species; a++) {
        for (size_t b = a; b < mixture->species; b++)
            contact[mixture_pair(mixture->species, a, b)] = mixture_contact(mixture, a, b);
    }
    for (size_t i = 0; i < discs->pairs; i++) {
        add_break(breaks, count, contact[i], most);
        for (size_t j = 0; j < discs->pairs; j++)
            add_break(breaks, count, contact[i] - contact[j], most);
    }
    for (size_t i = 0; i < discs->pairs; i++) {
        for (size_t j = i; j < discs->pairs; j++) {
            for (size_t k = 0; k < discs->pairs; k++)
                add_break(breaks, count, fabs(contact[i] + contact[j] - contact[k]), most);
        }
    }
}

static void cut_panels(Discs *discs) {
    double breaks[PANELS_MOST], most = 0;
    size_t count = 0;
    for (size_t a = 0; a < discs->mixture.species; a++)
        most = fmax(most, discs->mixture.diameter[a]);
    add_breaks(discs, breaks, &count, most);
    qsort(breaks, count, sizeof *breaks, ascending);
    for (size_t p = 0; p <= count; p++) {
        discs->from[p] = p > 0 ? breaks[p - 1] : 0;
        discs->to[p] = p < count ? breaks[p] : most;
    }
    discs->panels = count + 1;
    discs->order = discs->panels == 1 ? ALONE : IN_COMPANY;
    discs->basis = discs->panels * discs->order;
    for (size_t a = 0; a < discs->mixture.species; a++) {
        for (size_t b = a; b < discs->mixture.species; b++) {
            const size_t pair = mixture_pair(discs->mixture.species, a, b);
            const double contact = mixture_contact(&discs->mixture, a, b);
            size_t inside = 0;
            while (inside < discs->panels && discs->to[inside] < contact + CLOSE) inside++;
            discs->in_core[pair] = inside * discs->order;
            discs->first[pair] = discs->unknowns;
            discs->unknowns += discs->in_core[pair];
        }
    }
}

static double panel_radius(const Discs *discs, size_t panel, double t) {
    return discs->from[panel] + (discs->to[panel] - discs->from[panel]) * t * t * (3 - 2 * t);
}

static double chebyshev_point(size_t order, size_t i) {
    return cos(PI * ((double)i + 0.5) / (double)order);
}

static double point_radius(const Discs *discs, size_t point) {
    const double x = chebyshev_point(discs->order, point % discs->order);
    return panel_radius(discs, point / discs->order, (1 + x) / 2);
}

// Chebyshev polynomials T_0 .. T_{order-1} at x.
static void polynomials(size_t order, double x, double *values) {
    for (size_t n = 0; n < order; n++)
        values[n] = n == 0 ? 1 : n == 1 ? x : 2 * x * values[n - 1] - values[n - 2];
}

// The quadrature that resolves J0(q r) on a panel: its radii, and the polynomials there with
// 2 pi r dr and the weights.
typedef struct PanelRule {
    size_t points;
    double *radius;  // [points]
    double *weighed; // [points][order]
} PanelRule;

static Status rule_create(PanelRule *rule, const Discs *discs, size_t panel, size_t points) {
    const double length = discs->to[panel] - discs->from[panel];
    double *weight = NULL;
    rule->points = points;
    TRY(NEW_ARRAY(rule->radius, points));
    TRY(NEW_ARRAY(rule->weighed, points * discs->order));
    TRY(NEW_ARRAY(weight, points));
    quadrature_legendre(points, 0, 1, rule->radius, weight);
    for (size_t i = 0; i < points; i++) {
        const double t = rule->radius[i], r = panel_radius(discs, panel, t);
        double *weighed = rule->weighed + i * discs->order;
        polynomials(discs->order, 2 * t - 1, weighed);
        for (size_t n = 0; n < discs->order; n++)
            weighed[n] *= weight[i] * 2 * PI * r * length * 6 * t * (1 - t);
        rule->radius[i] = r;
    }
    memory_free(weight);
    return OK;
}

static void rule_free(PanelRule *rule) {
    memory_free(rule->radius);
    memory_free(rule->weighed);
    *rule = (PanelRule){0};
}

// Points for wave numbers up to q: three and more for each half wave where the radius changes
// fastest with t, and enough for the polynomials. In steps, so that a rule, whose cost is the
// square of its points, serves many wave numbers.
static size_t rule_points(const Discs *discs, size_t panel, double q) {
    const double wanted = 16 + 0.55 * 1.5 * q * (discs->to[panel] - discs->from[panel]);
    const double step = wanted < 128 ? 16 : 128;
    return (size_t)(step * ceil(wanted / step));
}

// Transforms of the polynomials of one panel at ascending wave numbers.
static Status transform_panel(const Discs *discs, size_t panel, const double *q, size_t count,
                              double *transform) {
    PanelRule rule = {0};
    Status status = OK;
    for (size_t k = 0; k < count && status == OK; k++) {
        const size_t points = rule_points(discs, panel, q[k]);
        if (points != rule.points) {
            rule_free(&rule);
            status = rule_create(&rule, discs, panel, points);
        }
        double *sum = transform + k * discs->basis + panel * discs->order;
        for (size_t i = 0; i < rule.points && status == OK; i++) {
            const double bessel = j0(q[k] * rule.radius[i]);
            const double *weighed = rule.weighed + i * discs->order;
            for (size_t n = 0; n < discs->order; n++) sum[n] += bessel * weighed[n];
        }
    }
    rule_free(&rule);
    return status;
}

static Status transform_basis(const Discs *discs, const double *q, size_t count,
                              double *transform) {
    for (size_t p = 0; p < discs->panels; p++) TRY(transform_panel(discs, p, q, count, transform));
    return OK;
}

static double core_transform(double diameter, double q) {
    return 2 * PI * diameter * j1(q * diameter) / q;
}

// Area common to two circles whose centres are r apart.
static double lens_area(double a, double b, double r) {
    if (r >= a + b) return 0;
    const double less = fmin(a, b);
    if (r <= fabs(a - b)) return PI * less * less;
    const double x = (r * r + a * a - b * b) / (2 * r), y = r - x;
    return a * a * acos(x / a) - x * sqrt(fmax(0, a * a - x * x)) + b * b * acos(y / b) -
           y * sqrt(fmax(0, b * b - y * y));
}

static void lay_waves(Discs *discs, double smallest, double largest, bool fill) {
    double end = 0;
    size_t count = 0;
    for (size_t kind = 0; kind < Q_PANEL_KINDS; kind++) {
        const double start = end, stop = Q_PANELS[kind].end / smallest;
        const size_t panels = (size_t)ceil((stop - start) * largest / Q_PANELS[kind].width);
        const double width = (stop - start) / (double)panels;
        for (size_t p = 0; p < panels && fill; p++) {
            const double from = start + width * (double)p;
            quadrature_legendre(Q_POINTS, from, from + width, discs->q + count + p * Q_POINTS,
                                discs->weight + count + p * Q_POINTS);
        }
        count += panels * Q_POINTS;
        end = stop;
        if (end <= Q_NEWTON / smallest) discs->newton_waves = count;
    }
    discs->waves = count;
}

static Status discs_allocate(Discs *discs) {
    const size_t waves = discs->waves, basis = discs->basis, species = discs->mixture.species;
    TRY(NEW_ARRAY(discs->q, waves));
    TRY(NEW_ARRAY(discs->weight, waves));
    TRY(NEW_ARRAY(discs->transform, waves * basis));
    TRY(NEW_ARRAY(discs->back, waves * basis));
    TRY(NEW_ARRAY(discs->core, waves * discs->pairs));
    TRY(NEW_ARRAY(discs->value, basis * basis));
    TRY(NEW_ARRAY(discs->lens, species * discs->pairs * basis));
    TRY(NEW_ARRAY(discs->lens_beyond, species * discs->pairs * basis));
    TRY(NEW_ARRAY(discs->coefficient, discs->unknowns));
    TRY(NEW_ARRAY(discs->earlier, discs->unknowns));
    TRY(NEW_ARRAY(discs->residual, discs->unknowns));
    TRY(NEW_ARRAY(discs->excess, discs->pairs * waves));
    TRY(NEW_ARRAY(discs->asked, discs->count * basis));
    discs->newton = gsl_matrix_alloc(discs->unknowns, discs->unknowns);
    discs->order_of_rows = gsl_permutation_alloc(discs->unknowns);
    return discs->newton && discs->order_of_rows ? OK : NO_MEMORY;
}

static void tabulate_pairs(Discs *discs) {
    const Mixture *mixture = &discs->mixture;
    const size_t species = mixture->species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            const size_t pair = mixture_pair(species, a, b);
            for (size_t k = 0; k < discs->waves; k++)
                discs->core[k * discs->pairs + pair] =
                    core_transform(mixture_contact(mixture, a, b), discs->q[k]);
            for (size_t c = 0; c < species; c++) {
                for (size_t i = 0; i < discs->basis; i++)
                    discs->lens[(c * discs->pairs + pair) * discs->basis + i] =
                        lens_area(mixture_contact(mixture, a, c), mixture_contact(mixture, c, b),
                                  point_radius(discs, i));
            }
        }
    }
}

static void tabulate_points(Discs *discs) {
    for (size_t i = 0; i < discs->basis; i++) {
        const size_t panel = i / discs->order;
        polynomials(discs->order, chebyshev_point(discs->order, i % discs->order),
                    discs->value + i * discs->basis + panel * discs->order);
    }
    for (size_t k = 0; k < discs->waves; k++) {
        for (size_t i = 0; i < discs->basis; i++)
            discs->back[k * discs->basis + i] = discs->weight[k] * discs->q[k] / (2 * PI) *
                                                j0(discs->q[k] * point_radius(discs, i));
    }
}

static void tabulate_beyond(Discs *discs) {
    const size_t species = discs->mixture.species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            for (size_t c = 0; c < species; c++) {
                const size_t ac = mixture_pair(species, a, c), cb = mixture_pair(species, c, b);
                const size_t at = (c * discs->pairs + mixture_pair(species, a, b)) * discs->basis;
                memcpy(discs->lens_beyond + at, discs->lens + at,
                       discs->basis * sizeof *discs->lens);
                for (size_t k = 0; k < discs->newton_waves; k++) {
                    const double *core = discs->core + k * discs->pairs;
                    for (size_t i = 0; i < discs->basis; i++)
                        discs->lens_beyond[at + i] -=
                            core[ac] * core[cb] * discs->back[k * discs->basis + i];
                }
            }
        }
    }
}

static Status discs_prepare(Discs *discs, const double *wave_number) {
    double smallest = INFINITY, largest = 0;
    for (size_t a = 0; a < discs->mixture.species; a++) {
        smallest = fmin(smallest, discs->mixture.diameter[a]);
        largest = fmax(largest, discs->mixture.diameter[a]);
    }
    cut_panels(discs);
    lay_waves(discs, smallest, largest, false);
    TRY(discs_allocate(discs));
    lay_waves(discs, smallest, largest, true);
    tabulate_pairs(discs);
    tabulate_points(discs);
    tabulate_beyond(discs);
    TRY(transform_basis(discs, discs->q, discs->waves, discs->transform));
    return transform_basis(discs, wave_number, discs->count, discs->asked);
}

Status discs_create(Discs **out, const Mixture *mixture, const double *wave_number, size_t count) {
    Discs *discs = NULL;
    TRY(NEW(discs));
    discs->mixture = *mixture;
    discs->pairs = mixture_pairs(mixture);
    discs->count = count;
    const Status status = discs_prepare(discs, wave_number);
    if (status != OK) discs_free(discs);
    *out = status == OK ? discs : NULL;
    return status;
}

void discs_free(Discs *discs) {
    if (!discs) return;
    double *const arrays[] = {discs->q,     discs->weight, discs->transform, discs->back,
                              discs->core,  discs->value,  discs->lens,      discs->coefficient,
                              discs->asked, discs->excess, discs->residual,  discs->lens_beyond};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) memory_free(arrays[i]);
    if (discs->newton) gsl_matrix_free(discs->newton);
    if (discs->order_of_rows) gsl_permutation_free(discs->order_of_rows);
    memory_free(discs);
}

// Four sums side by side, which need not wait for each other; all counts here are multiples of 4.
static double dot(const double *a, const double *b, size_t count) {
    double sum[4] = {0};
    for (size_t n = 0; n < count; n += 4) {
        for (size_t i = 0; i < 4; i++) sum[i] += a[n + i] * b[n + i];
    }
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

// c_ab(q) where the polynomials have these transforms.
static double direct_at(const Discs *discs, size_t pair, const double *transform) {
    return dot(discs->coefficient + discs->first[pair], transform, discs->in_core[pair]);
}

// g at contact: minus c on the inner side, where every polynomial is 1.
static double contact_value(const Discs *discs, size_t pair) {
    const double *last = discs->coefficient + discs->first[pair] + discs->in_core[pair];
    double sum = 0;
    for (size_t n = 1; n <= discs->order; n++) sum += last[-(ptrdiff_t)n];
    return -sum;
}

typedef struct Densities {
    size_t species;
    double root[MIXTURE_SPECIES_MOST]; // square roots of the densities of the species
} Densities;

static Densities densities_of(const Mixture *mixture, double density) {
    Densities densities = {.species = mixture->species};
    for (size_t a = 0; a < mixture->species; a++)
        densities.root[a] = sqrt(density * mixture->fraction[a]);
    return densities;
}

// Scaled by the roots of the densities, C: G = (1 - C)^-1 = 1 + H at wave number k.
static bool response_at(const Discs *discs, const Densities *densities, size_t k, SmallMatrix c,
                        SmallMatrix response) {
    const size_t species = densities->species;
    SmallMatrix inverse = {{0}};
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            const size_t pair = mixture_pair(species, a, b);
            c[a][b] = c[b][a] = densities->root[a] * densities->root[b] *
                                direct_at(discs, pair, discs->transform + k * discs->basis);
            inverse[a][b] = inverse[b][a] = (a == b) - c[a][b];
        }
    }
    return small_invert(species, inverse, response);
}

// sum_c rho_c Y_ac Y_cb times what the cores give: their transforms at k.
static double cores_at(const Discs *discs, const Densities *densities, const double *contact,
                       size_t a, size_t b, size_t k) {
    const double *core = discs->core + k * discs->pairs;
    double sum = 0;
    for (size_t c = 0; c < densities->species; c++) {
        const size_t ac = mixture_pair(densities->species, a, c);
        const size_t cb = mixture_pair(densities->species, c, b);
        sum += densities->root[c] * densities->root[c] * contact[ac] * contact[cb] * core[ac] *
               core[cb];
    }
    return sum;
}

// h - c = C G C of each pair, less its slowest part at large q, which the lenses have exactly.
static Status fill_excess(Discs *discs, const Densities *densities, const double *contact) {
    const size_t species = densities->species;
    for (size_t k = 0; k < discs->waves; k++) {
        SmallMatrix c, response;
        if (!response_at(discs, densities, k, c, response))
            return status_fail(UNHEALTHY, "Percus-Yevick discs: S(q) diverges at q = %g",
                               discs->q[k]);
        for (size_t a = 0; a < species; a++) {
            for (size_t b = a; b < species; b++)
                discs->excess[mixture_pair(species, a, b) * discs->waves + k] =
                    (response[a][b] - (a == b) - c[a][b]) /
                        (densities->root[a] * densities->root[b]) -
                    cores_at(discs, densities, contact, a, b, k);
        }
    }
    return OK;
}

// Numbers of polynomials are multiples of four.
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

// sum[i] += sum_k factor[k step] rows[k][i], k over the wave numbers of a panel, so that `sum` is
// read and written once for all of them.
static void add_panel(double *sum, const double *factor, size_t step, const double *rows,
                      size_t stride, size_t count) {
    const double f0 = factor[0], f1 = factor[step], f2 = factor[2 * step], f3 = factor[3 * step];
    const double f4 = factor[4 * step];
    const double *r0 = rows, *r1 = r0 + stride, *r2 = r1 + stride, *r3 = r2 + stride;
    const double *r4 = r3 + stride;
    _Static_assert(Q_POINTS == 5, "the sum below has a term for each");
    _Static_assert(ALONE % 4 == 0 && IN_COMPANY % 4 == 0, "the sum below takes four at a time");
    for (size_t i = 0; i < count; i += 4)
        *(Four *)(sum + i) += (f0 * *(const Four *)(r0 + i) + f1 * *(const Four *)(r1 + i)) +
                              (f2 * *(const Four *)(r2 + i) + f3 * *(const Four *)(r3 + i)) +
                              f4 * *(const Four *)(r4 + i);
}

static void add_lenses(const Discs *discs, const Densities *densities, const double *contact,
                       size_t a, size_t b, double *residual) {
    const size_t pair = mixture_pair(densities->species, a, b);
    for (size_t c = 0; c < densities->species; c++) {
        const double strength = densities->root[c] * densities->root[c] *
                                contact[mixture_pair(densities->species, a, c)] *
                                contact[mixture_pair(densities->species, c, b)];
        const double *lens = discs->lens + (c * discs->pairs + pair) * discs->basis;
        for (size_t i = 0; i < discs->in_core[pair]; i++) residual[i] += strength * lens[i];
    }
}

// h + 1 at the points of a pair's core.
static void fill_residual(Discs *discs, const Densities *densities, const double *contact, size_t a,
                          size_t b) {
    const size_t pair = mixture_pair(densities->species, a, b), inside = discs->in_core[pair];
    const double *coefficient = discs->coefficient + discs->first[pair];
    double *residual = discs->residual + discs->first[pair];
    for (size_t i = 0; i < inside; i++) {
        residual[i] = 1 + dot(discs->value + i * discs->basis, coefficient, inside);
    }
    add_lenses(discs, densities, contact, a, b, residual);
    const double *excess = discs->excess + pair * discs->waves;
    for (size_t k = 0; k < discs->waves; k += Q_POINTS)
        add_panel(residual, excess + k, 1, discs->back + k * discs->basis, discs->basis, inside);
}

static Status fill_residuals(Discs *discs, const Densities *densities, double *largest) {
    double contact[MIXTURE_PAIRS_MOST];
    for (size_t pair = 0; pair < discs->pairs; pair++) contact[pair] = contact_value(discs, pair);
    TRY(fill_excess(discs, densities, contact));
    for (size_t a = 0; a < densities->species; a++) {
        for (size_t b = a; b < densities->species; b++)
            fill_residual(discs, densities, contact, a, b);
    }
    *largest = 0;
    for (size_t i = 0; i < discs->unknowns; i++)
        *largest = fmax(*largest, fabs(discs->residual[i]));
    return isfinite(*largest) ? OK : status_fail(UNHEALTHY, "Percus-Yevick discs: not a number");
}

// d(h - c)_ab/d c_cd at each wave number of Newton's method: G_ac G_bd + G_ad G_bc (once if c = d)
// less the identity, scaled.
static void fill_coupling(const Discs *discs, const Densities *densities,
                          const SmallMatrix *response, const size_t pair[4], double *coupling) {
    const size_t a = pair[0], b = pair[1], c = pair[2], d = pair[3];
    const double scale =
        densities->root[c] * densities->root[d] / (densities->root[a] * densities->root[b]);
    const double identity = a == c && b == d;
    for (size_t k = 0; k < discs->newton_waves; k++) {
        const double(*g)[SMALL_MOST] = response[k];
        double sum = g[a][c] * g[b][d];
        if (c != d) sum += g[a][d] * g[b][c];
        coupling[k] = scale * sum - identity;
    }
}

// The block of equations of pair ab and unknowns of pair cd: back^T coupling transform.
static void fill_block(Discs *discs, size_t row, size_t column, const double *coupling,
                       double *weighed) {
    const size_t rows = discs->in_core[row], columns = discs->in_core[column];
    for (size_t k = 0; k < discs->newton_waves; k++) {
        for (size_t n = 0; n < columns; n++)
            weighed[k * discs->basis + n] = coupling[k] * discs->transform[k * discs->basis + n];
    }
    for (size_t i = 0; i < rows; i++) {
        double *block = gsl_matrix_ptr(discs->newton, discs->first[row] + i, discs->first[column]);
        for (size_t n = 0; n < columns; n++)
            block[n] = row == column ? discs->value[i * discs->basis + n] : 0;
    }
    for (size_t k = 0; k < discs->newton_waves; k += Q_POINTS) {
        for (size_t i = 0; i < rows; i++)
            add_panel(gsl_matrix_ptr(discs->newton, discs->first[row] + i, discs->first[column]),
                      discs->back + k * discs->basis + i, discs->basis, weighed + k * discs->basis,
                      discs->basis, columns);
    }
}

// What the lenses of pair ab add by the contact value of pair `column`, minus the sum of the
// coefficients of its last panel.
static void add_lens_slopes(Discs *discs, double strength, size_t c, size_t row, size_t column) {
    const double *lens = discs->lens_beyond + (c * discs->pairs + row) * discs->basis;
    const size_t end = discs->first[column] + discs->in_core[column];
    for (size_t i = 0; i < discs->in_core[row]; i++) {
        for (size_t n = end - discs->order; n < end; n++)
            *gsl_matrix_ptr(discs->newton, discs->first[row] + i, n) -= strength * lens[i];
    }
}

static void add_slopes(Discs *discs, const Densities *densities) {
    const size_t species = densities->species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            for (size_t c = 0; c < species; c++) {
                const size_t ac = mixture_pair(species, a, c), cb = mixture_pair(species, c, b);
                const size_t row = mixture_pair(species, a, b);
                const double density = densities->root[c] * densities->root[c];
                add_lens_slopes(discs, density * contact_value(discs, cb), c, row, ac);
                add_lens_slopes(discs, density * contact_value(discs, ac), c, row, cb);
            }
        }
    }
}

static void fill_blocks(Discs *discs, const Densities *densities, const SmallMatrix *response,
                        double *coupling, double *weighed) {
    const size_t species = densities->species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            for (size_t c = 0; c < species; c++) {
                for (size_t d = c; d < species; d++) {
                    fill_coupling(discs, densities, response, (size_t[]){a, b, c, d}, coupling);
                    fill_block(discs, mixture_pair(species, a, b), mixture_pair(species, c, d),
                               coupling, weighed);
                }
            }
        }
    }
}

static Status decompose(Discs *discs, const Densities *densities) {
    SmallMatrix *response = NULL, c;
    double *coupling = NULL, *weighed = NULL;
    Status status = NEW_ARRAY(response, discs->newton_waves);
    if (status == OK) status = NEW_ARRAY(coupling, discs->newton_waves);
    if (status == OK) status = NEW_ARRAY(weighed, discs->newton_waves * discs->basis);
    for (size_t k = 0; status == OK && k < discs->newton_waves; k++)
        response_at(discs, densities, k, c, response[k]);
    if (status == OK) {
        int sign;
        fill_blocks(discs, densities, (const SmallMatrix *)response, coupling, weighed);
        add_slopes(discs, densities);
        gsl_linalg_LU_decomp(discs->newton, discs->order_of_rows, &sign);
    }
    memory_free(response);
    memory_free(coupling);
    memory_free(weighed);
    return status;
}

static void step(Discs *discs) {
    gsl_vector_view residual = gsl_vector_view_array(discs->residual, discs->unknowns);
    gsl_linalg_LU_svx(discs->newton, discs->order_of_rows, &residual.vector);
    for (size_t i = 0; i < discs->unknowns; i++) discs->coefficient[i] -= discs->residual[i];
}

// Newton's method from where the last solution left; the derivatives are made anew when a step
// has not halved the residual.
static Status iterate(Discs *discs, const Densities *densities, double converged,
                      OzEffort *effort) {
    double before = INFINITY;
    bool fresh = discs->solved > 0;
    for (effort->iterations = 0; effort->iterations < STEPS_MOST; effort->iterations++) {
        TRY(patience_check());
        TRY(fill_residuals(discs, densities, &effort->residual));
        if (effort->residual < converged) return OK;
        if (effort->residual > 1e6) break;
        if (!fresh || effort->residual > 0.5 * before) TRY(decompose(discs, densities));
        fresh = true;
        before = effort->residual;
        step(discs);
    }
    return status_fail(UNHEALTHY, "Percus-Yevick discs: h + 1 does not vanish in the core");
}

// The dilute limit, where c = -1 in the core.
static void start(Discs *discs) {
    memset(discs->coefficient, 0, discs->unknowns * sizeof *discs->coefficient);
    for (size_t pair = 0; pair < discs->pairs; pair++) {
        for (size_t n = 0; n < discs->in_core[pair]; n += discs->order)
            discs->coefficient[discs->first[pair] + n] = -1;
    }
    discs->solved = discs->solved_earlier = 0;
}

// Newton's method must begin near: dense solutions are followed in short steps.
static double next_density(double from, double to, double finer) {
    const double step = (from < DILUTE ? LONG_STEP : SHORT_STEP) * finer;
    return fabs(to - from) <= step ? to : to > from ? from + step : from - step;
}

// Along the straight line through the last two solutions, where it is not far from them.
static void guess(Discs *discs, double next) {
    const double way = discs->solved - discs->solved_earlier, part = (next - discs->solved) / way;
    const bool near = discs->solved_earlier > 0 && way != 0 && fabs(part) <= 1.2;
    for (size_t i = 0; i < discs->unknowns; i++) {
        const double now = discs->coefficient[i];
        if (near) discs->coefficient[i] += part * (now - discs->earlier[i]);
        discs->earlier[i] = now;
    }
    discs->solved_earlier = discs->solved;
}

static Status follow(Discs *discs, const Structure *structure, double finer, OzEffort *effort) {
    const double target = structure->packing_fraction;
    do {
        const double next = next_density(discs->solved, target, finer);
        const Densities densities =
            densities_of(&discs->mixture, structure->density * next / target);
        guess(discs, next);
        effort->at = next;
        TRY(iterate(discs, &densities, next == target ? CONVERGED : NEAR_ENOUGH, effort));
        effort->reached = discs->solved = next;
    } while (discs->solved != target);
    return OK;
}

// Newton's method may have found another solution than the fluid's, whose S(q) is positive.
static Status check_fluid(const Discs *discs, const Structure *structure) {
    const Densities densities = densities_of(&discs->mixture, structure->density);
    for (size_t k = 0; k < discs->newton_waves; k++) {
        SmallMatrix c, response;
        if (!response_at(discs, &densities, k, c, response) ||
            !small_is_positive(densities.species, response))
            return status_fail(UNHEALTHY,
                               "Percus-Yevick discs: the solution found has a negative structure "
                               "factor at q = %g",
                               discs->q[k]);
    }
    return OK;
}

Status discs_solve(Discs *discs, Structure *structure, OzEffort *effort) {
    Status status = UNHEALTHY;
    double finer = 1;
    for (int attempt = 0; attempt < ATTEMPTS && status == UNHEALTHY; attempt++, finer /= 2) {
        if (discs->solved == 0) start(discs);
        status = follow(discs, structure, finer, effort);
        if (status == OK) status = check_fluid(discs, structure);
        if (status != OK) discs->solved = 0;
    }
    TRY(status);
    for (size_t pair = 0; pair < discs->pairs; pair++) {
        structure->contact[pair] = contact_value(discs, pair);
        for (size_t i = 0; i < discs->count; i++)
            structure->direct[pair * discs->count + i] =
                direct_at(discs, pair, discs->asked + i * discs->basis);
    }
    return OK;
}
