// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals through the transients, by the trapezoidal rule.
#include "itt/flow.h"

#include "base/memory.h"
#include "itt/matrix.h"

#include <math.h>
#include <string.h>

struct Flow {
    const Plane *plane;
    const Direct *direct;
    size_t species, pairs;
    double times[MIXTURE_PAIRS_MOST]; // that a pair counts in a sum over both its species
    double rate;
    double time, modulus, normal_modulus; // of the last look
    double stress, normal_difference;
    double *factor, *vertex;   // matrices: S_q, and q_x q_y c'_q/q S_q
    double *correlator, *half; // matrices: F = Phi S, and Phi S vertex
    double *source;     // [pair][size]: F q_x q_y c'_q/q F^T, which distorts S at the advected
    double *before;     // wave vector, and its value at the look before
    double *weight;     // [size]
    double *distortion; // [pair][size]
};

static Status allocate(Flow *flow) {
    const size_t size = flow->plane->size, entries = flow->species * flow->species;
    double **const matrices[] = {&flow->factor, &flow->vertex, &flow->correlator, &flow->half};
    double **const fields[] = {&flow->source, &flow->before, &flow->distortion};
    for (size_t i = 0; i < sizeof matrices / sizeof *matrices; i++)
        TRY(NEW_ARRAY(*matrices[i], entries * size));
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        TRY(NEW_ARRAY(*fields[i], flow->pairs * size));
    return NEW_ARRAY(flow->weight, size);
}

// Vertices are c'_q times components of q over q.
static double slope_over(const Flow *flow, size_t pair, double q) {
    return q > 0 ? direct_slope(flow->direct, pair, q) / q : 0;
}

static void fill(Flow *flow) {
    const Plane *plane = flow->plane;
    const size_t size = plane->size, species = flow->species;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++)
            flow->times[mixture_pair(species, a, b)] = a == b ? 1 : 2;
    }
    for (size_t i = 0; i < size; i++) {
        const double q = hypot(plane->x[i], plane->y[i]);
        SmallMatrix factor;
        direct_factor(flow->direct, q, factor);
        for (size_t a = 0; a < species; a++) {
            for (size_t b = 0; b < species; b++) {
                matrix_entry(flow->factor, species, size, a, b)[i] = factor[a][b];
                matrix_entry(flow->half, species, size, a, b)[i] =
                    plane->x[i] * plane->y[i] * slope_over(flow, mixture_pair(species, a, b), q);
            }
        }
    }
    matrix_multiply(species, size, flow->factor, flow->half, flow->vertex);
}

Status flow_create(Flow **out, const Plane *plane, const Direct *direct, double shear_rate) {
    Flow *flow = NULL;
    *out = NULL;
    TRY(NEW(flow));
    flow->plane = plane;
    flow->direct = direct;
    flow->species = direct->mixture.species;
    flow->pairs = mixture_pairs(&direct->mixture);
    flow->rate = shear_rate;
    const Status status = allocate(flow);
    if (status != OK) {
        flow_free(flow);
        return status;
    }
    fill(flow);
    *out = flow;
    return OK;
}

void flow_free(Flow *flow) {
    if (!flow) return;
    double *const fields[] = {flow->factor, flow->vertex, flow->correlator, flow->half,
                              flow->source, flow->before, flow->weight,     flow->distortion};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) memory_free(fields[i]);
    memory_free(flow);
}

static double *pair_of(const Flow *flow, double *fields, size_t a, size_t b) {
    return fields + mixture_pair(flow->species, a, b) * flow->plane->size;
}

// F vertex F^T, a symmetric matrix.
static void find_source(Flow *flow, const double *phi) {
    const size_t size = flow->plane->size, species = flow->species;
    matrix_multiply(species, size, phi, flow->factor, flow->correlator);
    matrix_multiply(species, size, phi, flow->vertex, flow->half);
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++) {
            double *source = pair_of(flow, flow->source, a, b);
            memset(source, 0, size * sizeof *source);
            for (size_t e = 0; e < species; e++) {
                const double *left = matrix_read(flow->half, species, size, a, e);
                const double *right = matrix_read(flow->correlator, species, size, b, e);
                for (size_t i = 0; i < size; i++) source[i] += left[i] * right[i];
            }
        }
    }
}

// rho^2/2 int d^2q/(2 pi)^2 sum_ab [F q_x q_y c'_q/q F^T]_ab q_x q_y(t) c'_ab(q(t))/q(t), and with
// q_x^2 - q_y(t)^2 in the second vertex.
static void find_moduli(Flow *flow, double strain) {
    const Plane *plane = flow->plane;
    double shear = 0, normal = 0;
    for (size_t pair = 0; pair < flow->pairs; pair++) {
        const double *source = flow->source + pair * plane->size;
        const double times = flow->times[pair];
        for (size_t i = 0; i < plane->size; i++) {
            const double x = plane->x[i], y = plane->y[i] - strain * x;
            const double f = times * plane->area[i] * source[i];
            if (f == 0) continue;
            const double late = f * slope_over(flow, pair, sqrt(x * x + y * y));
            shear += late * x * y;
            normal += late * (x * x - y * y);
        }
    }
    const double scale = pow(flow->direct->density, 2) / 2;
    flow->modulus = scale * shear;
    flow->normal_modulus = scale * normal;
}

// S_k(t) - S_k = rate rho int dt' [F(t') q_x q_y c'_q/q F(t')^T] at the q that t' advects to k.
static void distort(Flow *flow, double strain, double width, const double *source) {
    const size_t size = flow->plane->size;
    for (size_t i = 0; i < size; i++) flow->weight[i] = flow->rate * flow->direct->density * width;
    for (size_t pair = 0; pair < flow->pairs; pair++)
        plane_add_advected(flow->plane, -strain, source + pair * size, flow->weight,
                           flow->distortion + pair * size, 1);
}

void flow_see(Flow *flow, double time, const double *phi) {
    const double modulus = flow->modulus, normal = flow->normal_modulus;
    const double width = time - flow->time;
    double *newest = flow->before;
    flow->before = flow->source;
    flow->source = newest;
    find_source(flow, phi);
    find_moduli(flow, flow->rate * time);
    if (time > 0) {
        flow->stress += flow->rate * width * (modulus + flow->modulus) / 2;
        flow->normal_difference += flow->rate * width * (normal + flow->normal_modulus) / 2;
        distort(flow, flow->rate * flow->time, width / 2, flow->before);
        distort(flow, flow->rate * time, width / 2, flow->source);
    }
    flow->time = time;
}

double flow_modulus(const Flow *flow) {
    return flow->modulus;
}

double flow_stress(const Flow *flow) {
    return flow->stress;
}

double flow_normal_difference(const Flow *flow) {
    return flow->normal_difference;
}

const double *flow_distortion(const Flow *flow) {
    return flow->distortion;
}

// `before` and `weight` are written anew at each look.
void flow_archive(Flow *flow, Archive *archive) {
    double *const sums[] = {&flow->time, &flow->modulus, &flow->normal_modulus, &flow->stress,
                            &flow->normal_difference};
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) archive_f64(archive, sums[i], 1);
    archive_f64(archive, flow->source, flow->pairs * flow->plane->size);
    archive_f64(archive, flow->distortion, flow->pairs * flow->plane->size);
}
