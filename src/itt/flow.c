// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals through the transients, by the trapezoidal rule.
#include "itt/flow.h"

#include "base/memory.h"

#include <math.h>

struct Flow {
    const Plane *plane;
    const Direct *direct;
    double rate;
    double time, modulus, normal_modulus; // of the last look
    double stress, normal_difference;
    double *vertex;     // [size]: q_x q_y c'_q/q S_q^2
    double *source;     // [size]: what distorts S at the advected wave vector, and its
    double *before;     // [size]: value at the look before
    double *weight;     // [size]
    double *distortion; // [size]
};

static Status fill(Flow *flow) {
    const Plane *plane = flow->plane;
    double **const fields[] = {&flow->vertex, &flow->source, &flow->before, &flow->weight,
                               &flow->distortion};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        TRY(NEW_ARRAY(*fields[i], plane->size));
    for (size_t i = 0; i < plane->size; i++) {
        const double q = hypot(plane->x[i], plane->y[i]);
        if (!(q > 0)) continue;
        flow->vertex[i] = plane->x[i] * plane->y[i] / q * direct_slope(flow->direct, q) *
                          pow(direct_factor(flow->direct, q), 2);
    }
    return OK;
}

Status flow_create(Flow **out, const Plane *plane, const Direct *direct, double shear_rate) {
    Flow *flow = NULL;
    *out = NULL;
    TRY(NEW(flow));
    flow->plane = plane;
    flow->direct = direct;
    flow->rate = shear_rate;
    const Status status = fill(flow);
    if (status == OK)
        *out = flow;
    else
        flow_free(flow);
    return status;
}

void flow_free(Flow *flow) {
    if (!flow) return;
    memory_free(flow->vertex);
    memory_free(flow->source);
    memory_free(flow->before);
    memory_free(flow->weight);
    memory_free(flow->distortion);
    memory_free(flow);
}

// rho^2/2 int d^2q/(2 pi)^2 [q_x q_y c'_q/q] [q_x q_y(t) c'_q(t)/q(t)] (S_q Phi_q)^2, and with
// q_x^2 - q_y(t)^2 in the second vertex.
static void find_moduli(Flow *flow, double strain, const double *phi) {
    const Plane *plane = flow->plane;
    double shear = 0, normal = 0;
    for (size_t i = 0; i < plane->size; i++) {
        const double x = plane->x[i], y = plane->y[i] - strain * x, q = sqrt(x * x + y * y);
        const double f = plane->area[i] * flow->vertex[i] * phi[i] * phi[i];
        if (f == 0 || !(q > 0)) continue;
        const double late = f * direct_slope(flow->direct, q) / q;
        shear += late * x * y;
        normal += late * (x * x - y * y);
    }
    const double scale = pow(flow->direct->density, 2) / 2;
    flow->modulus = scale * shear;
    flow->normal_modulus = scale * normal;
}

// S_k(t) - S_k = rate int dt' [q_x q_y S'_q/q Phi_q(t')^2] at the q that t' advects to k.
static void distort(Flow *flow, double strain, double width, const double *source) {
    const Plane *plane = flow->plane;
    for (size_t i = 0; i < plane->size; i++) flow->weight[i] = flow->rate * width;
    plane_add_advected(plane, -strain, source, flow->weight, flow->distortion);
}

void flow_see(Flow *flow, double time, const double *phi) {
    const double modulus = flow->modulus, normal = flow->normal_modulus;
    const double width = time - flow->time;
    double *newest = flow->before;
    flow->before = flow->source;
    flow->source = newest;
    for (size_t i = 0; i < flow->plane->size; i++)
        flow->source[i] = flow->direct->density * flow->vertex[i] * phi[i] * phi[i];
    find_moduli(flow, flow->rate * time, phi);
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
    archive_f64(archive, flow->source, flow->plane->size);
    archive_f64(archive, flow->distortion, flow->plane->size);
}
