// SPDX-License-Identifier: GPL-3.0-or-later
// The best of the simple, centred and face-centred lattices that fit the box.
#include "packing/lattice.h"

#include <math.h>

enum { BASIS_MOST = 4 };

// Sites of the unit cell. A centred rectangle with edges 1 : sqrt(3) is the triangular lattice.
static const double SITES[BASIS_MOST][3] = {{0, 0, 0}, {0.5, 0.5, 0.5}, {0, 0, 0}, {0, 0, 0}};
static const double FACES[BASIS_MOST][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};

static const double *site_of(int basis, int site) {
    return basis == BASIS_MOST ? FACES[site] : SITES[site];
}

size_t lattice_sites(const Lattice *lattice) {
    size_t sites = (size_t)lattice->basis;
    for (int a = 0; a < 3; a++) sites *= (size_t)lattice->cells[a];
    return sites;
}

// The nearest of the other sites: along an edge, or at another place of the same cell.
static double nearest_of(const Lattice *lattice, int dimension) {
    double least2 = INFINITY;
    for (int a = 0; a < dimension; a++) least2 = fmin(least2, lattice->cell[a] * lattice->cell[a]);
    for (int s = 1; s < lattice->basis; s++) {
        double r2 = 0;
        for (int a = 0; a < dimension; a++) {
            const double r = site_of(lattice->basis, s)[a] * lattice->cell[a];
            r2 += r * r;
        }
        least2 = fmin(least2, r2);
    }
    return sqrt(least2);
}

static void try_cells(const Box *box, size_t particles, Lattice *candidate, Lattice *best) {
    if (lattice_sites(candidate) < particles) return;
    for (int a = 0; a < 3; a++) candidate->cell[a] = box->edge[a] / candidate->cells[a];
    candidate->nearest = nearest_of(candidate, box->dimension);
    if (candidate->nearest > best->nearest) *best = *candidate;
}

// For each number of cells along x, those along y and z that come near the aspect of a good cell.
static void try_basis(const Box *box, size_t particles, int basis, Lattice *best) {
    const int most = (int)sqrt((double)particles) + 2, flat = box->dimension == 2;
    const double volume = box_volume(box) * basis / (double)particles; // of a cell
    const double wide = flat ? sqrt(volume) : cbrt(volume);
    for (int x = (int)(box->edge[0] / wide / 2); x <= (int)(box->edge[0] / wide * 2) + 1; x++) {
        for (int y = (int)(box->edge[1] / wide / 2); y <= (int)(box->edge[1] / wide * 2) + 1; y++) {
            if (x < 1 || y < 1 || x > most * most || y > most * most) continue;
            const double per_layer = (double)basis * x * y;
            const int z = flat ? 1 : (int)ceil((double)particles / per_layer);
            Lattice candidate = {.cells = {x, y, z}, .basis = basis};
            try_cells(box, particles, &candidate, best);
        }
    }
}

Lattice lattice_best(const Box *box, size_t particles) {
    Lattice best = {.nearest = 0};
    for (int basis = 1; basis <= BASIS_MOST; basis *= 2) {
        if (basis == BASIS_MOST && box->dimension == 2) continue;
        try_basis(box, particles, basis, &best);
    }
    return best;
}

void lattice_site(const Lattice *lattice, size_t site, double position[3]) {
    const double *place = site_of(lattice->basis, (int)(site % (size_t)lattice->basis));
    size_t cell = site / (size_t)lattice->basis;
    for (int a = 0; a < 3; a++) {
        const double along = (double)(cell % (size_t)lattice->cells[a]) + 0.25 + place[a];
        position[a] = along * lattice->cell[a];
        cell /= (size_t)lattice->cells[a];
    }
}
