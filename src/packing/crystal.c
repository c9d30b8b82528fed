// SPDX-License-Identifier: GPL-3.0-or-later
// Layers of upright bodies: as many as fit above each other, so that there is most room in each.
#include "packing/crystal.h"

#include <math.h>

Status crystal_layers(Layers *layers, const Box *box, size_t particles, double diameter,
                      double height) {
    const int most = (int)floor(box->edge[2] / height), count = most < 1 ? 1 : most;
    const size_t in_layer = (particles + (size_t)count - 1) / (size_t)count;
    const Box plane = {.dimension = 2, .edge = {box->edge[0], box->edge[1], 1}};
    *layers = (Layers){
        .count = count, .spacing = box->edge[2] / count, .plane = lattice_best(&plane, in_layer)};
    if (layers->spacing > height && layers->plane.nearest > diameter) return OK;
    return status_fail(
        BAD_DATA,
        "start = crystal: upright bodies %.4g d high do not fit into a box of %.4g x "
        "%.4g x %.4g d in layers; another box.aspect or number of particles may",
        height, box->edge[0], box->edge[1], box->edge[2]);
}

size_t crystal_sites(const Layers *layers) {
    return (size_t)layers->count * lattice_sites(&layers->plane);
}

void crystal_site(const Layers *layers, size_t site, double position[3]) {
    lattice_site(&layers->plane, site / (size_t)layers->count, position);
    position[2] = ((double)(site % (size_t)layers->count) + 0.5) * layers->spacing;
}
