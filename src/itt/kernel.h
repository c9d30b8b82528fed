// SPDX-License-Identifier: GPL-3.0-or-later
// The memory kernels of mode-coupling theory under shear (Weysser, thesis, eqs 5.10-5.12 and 5.17,
// for mixtures), written for wave vectors at the earlier of their two times: m_q(t, t') =
// memory(q(t'), t - t'). With q' = q advected during t - t', p = q - k and the correlators F = Phi
// S of a later density of one species (first index) with an earlier one of another,
//   memory(q) = S(q') M(q), M_ac(q) = rho/(2 x_a x_c q^2 q'^2) int d^2k/(2 pi)^2
//     sum_{bd,eg} V'_abd V_ceg F_be(k) F_dg(p),
//   V_abd = q.k c_ab(k) delta_ad + q.p c_ad(p) delta_ab, V' that of q', k' and p'.
// The vertices are polynomials in the components of k and p, and q' is linear in q: all is a sum of
// convolutions, with q_i q_l taken out. Matrices are fields by entries, [a][c][size of the plane].
#pragma once

#include "itt/direct.h"
#include "itt/plane.h"

enum { KERNEL_PAIRS = 3 }; // of components: xx, xy, yy

typedef struct Kernel Kernel;

// `diffusion`: free, of the species, in D0.
Status kernel_create(Kernel **out, const Plane *plane, const Direct *direct,
                     const double *diffusion);
void kernel_free(Kernel *kernel);

// The strain between the two times of all kernels from now on.
void kernel_set_strain(Kernel *kernel, double strain);
// D_a x_a q'^2 (S(q')^-1)_ab, the rates at which free density fluctuations decay, and D_a q'^2,
// that of a tagged particle of a species.
const double *kernel_rate(const Kernel *kernel);
const double *kernel_tagged_rate(const Kernel *kernel, size_t species);

// The collective kernel, quadratic in phi.
void kernel_memory(Kernel *kernel, const double *phi, double *memory);
// That of a tagged particle of a species from its own correlator; the collective correlators are
// those of the last call of kernel_memory.
void kernel_tagged(Kernel *kernel, size_t species, const double *tagged, double *memory);
// rho int d^2k/(2 pi)^2 k_i k'_j (c' F c)_ss Phi^s, for displacements: sum_ij q_i(t') q_j(t)
// friction_ij is the kernel of q -> 0 but for q(t')^2. Collective correlators as of kernel_tagged.
void kernel_displacement(const Kernel *kernel, size_t species, const double *tagged,
                         double friction[2][2]);
