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

double box_shortest_edge(const Box *box) {
    double shortest = box->edge[0];
    for (int a = 1; a < box->dimension; a++) shortest = fmin(shortest, box->edge[a]);
    return shortest;
}

double box_longest_edge(const Box *box) {
    double longest = box->edge[0];
    for (int a = 1; a < box->dimension; a++) longest = fmax(longest, box->edge[a]);
    return longest;
}

void box_nearest_image(const Box *box, double separation[3]) {
    const double above = rint(separation[1] / box->edge[1]);
    separation[0] -= box->offset * above;
    separation[1] -= box->edge[1] * above;
    separation[0] -= box->edge[0] * rint(separation[0] / box->edge[0]);
    if (box->dimension == 2) return;
    separation[2] -= box->edge[2] * rint(separation[2] / box->edge[2]);
}

double box_strain(const Box *box) {
    return box_displacement(box) / box->edge[1];
}

// Taking away an edge from what is between half of one and a whole one is exact.
void box_shear(Box *box, double displacement) {
    box->offset += displacement;
    if (box->offset > box->edge[0] / 2) {
        box->offset -= box->edge[0];
        box->turns++;
    } else if (box->offset < -box->edge[0] / 2) {
        box->offset += box->edge[0];
        box->turns--;
    }
}

void box_lean(Box *box, double offset, double strain) {
    box->offset = offset;
    box->turns = (int64_t)rint((strain * box->edge[1] - offset) / box->edge[0]);
}

bool box_is_rectangular(const Box *box) {
    return box->offset == 0 && box->turns == 0;
}

void box_fractions(const Box *box, const double position[3], double fraction[3]) {
    fraction[1] = position[1] / box->edge[1];
    fraction[2] = position[2] / box->edge[2];
    fraction[0] = (position[0] - box->offset * fraction[1]) / box->edge[0];
    fraction[0] -= floor(fraction[0]);
}

double box_widening(const Box *box) {
    const double lean = box->offset / box->edge[1];
    return sqrt(1 + lean * lean);
}

static const int64_t TURNS_MOST = INT32_MAX; // image counts along x go with them

void box_archive(Box *box, Archive *archive) {
    archive_f64(archive, &box->offset, 1);
    archive_i64(archive, &box->turns, 1);
    archive_require(archive,
                    fabs(box->offset) <= box->edge[0] / 2 && box->turns <= TURNS_MOST &&
                        box->turns >= -TURNS_MOST,
                    "its box cannot be sheared like this");
}
