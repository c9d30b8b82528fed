// SPDX-License-Identifier: GPL-3.0-or-later
// The memory kernel of mode-coupling theory under shear (Weysser, thesis, eqs 5.10-5.12 and 5.17),
// written for wave vectors at the earlier of its two times: m_q(t, t') = memory(q(t'), t - t').
// With q' = q advected during t - t', p = q - k and a = S Phi,
//   memory(q) = S_q' rho/(2 q^2 q'^2) int d^2k/(2 pi)^2 a_k a_p [q.(k c_k + p c_p)]
//                                                          [q'.(k' c_k' + p' c_p')].
// The vertices are polynomials in the components of k and p, and q' is linear in q: all is a sum of
// convolutions, with q_i q_l taken out.
#pragma once

#include "itt/direct.h"
#include "itt/plane.h"

enum { KERNEL_PAIRS = 3 }; // of components: xx, xy, yy

typedef struct Kernel Kernel;

Status kernel_create(Kernel **out, const Plane *plane, const Direct *direct);
void kernel_free(Kernel *kernel);

// The strain between the two times of all kernels from now on.
void kernel_set_strain(Kernel *kernel, double strain);
// q'^2/S_q', the rate at which free density fluctuations decay, and q'^2, that of tagged particles.
const double *kernel_rate(const Kernel *kernel);
const double *kernel_tagged_rate(const Kernel *kernel);

// The collective kernel, quadratic in phi.
void kernel_memory(Kernel *kernel, const double *phi, double *memory);
// That of a tagged particle from its own correlator; the collective correlators are those of the
// last call of kernel_memory.
void kernel_tagged(Kernel *kernel, const double *tagged, double *memory);
// rho int d^2k/(2 pi)^2 k_i k_l g_lm c_k c_k' a_k Phi^s_k with q'_i = q_l g.., for displacements:
// sum_ij q_i(t') q_j(t) friction_ij is the kernel of q -> 0 but for q(t')^2.
void kernel_displacement(Kernel *kernel, const double *phi, const double *tagged,
                         double friction[2][2]);
