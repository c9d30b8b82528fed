// SPDX-License-Identifier: GPL-3.0-or-later
// The periodic box.
#include "box/box.h"

#include <math.h>

Box box_of_volume(int dimension, double volume, const double aspect[3]) {
    double product = 1;
    for (int a = 0; a < dimension; a++) product *= aspect[a];
    const double unit = dimension == 2 ? sqrt(volume / product) : cbrt(volume / product);
    Box box = {.dimension = dimension, .edge = {1, 1, 1}};
    for (int a = 0; a < dimension; a++) box.edge[a] = unit * aspect[a];
    return box;
}

double box_volume(const Box *box) {
    return box->edge[0] * box->edge[1] * box->edge[2];
}

void box_nearest_image(const Box *box, double separation[3]) {
    for (int a = 0; a < box->dimension; a++) {
        separation[a] -= box->edge[a] * rint(separation[a] / box->edge[a]);
    }
}
