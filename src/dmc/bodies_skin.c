// SPDX-License-Identifier: GPL-3.0-or-later
// How wide the skins of the chain of bodies are: such that a trial costs least. Wide ones last
// long, but put many on each list. A guess from the amplitudes in force, the density and the shapes
// is good enough: near the best nothing depends on it much, and what comes out nothing at all.
#include "dmc/bodies.h"
#include "dmc/bodies_move.h"

#include "base/constants.h"

// Of the typical length of trials: a few go farther and are looked for in the cells.
static const double LEASH = 0.8;
static const double REST_LEAST = 0.02, REST_MOST = 1.6, WIDER = 1.15; // in d: what is tried
static const double LONGER = 1.2, SHORTER = 0.5; // trials that the same lists still suit
static const double LOWER = 0.1; // acceptance, for each body that a trial may meet beside

// Work, in looks at a vector of bodies: to look through the cells, and to put one on a list.
static const double SEARCH = 10, LISTING = 0.7;

// Root mean square, of how far the farthest point of a core gets.
static double species_trial(const Bodies *bodies, size_t species) {
    const Amplitude *amplitude = &bodies->amplitude[species];
    const Body body = species_body(&bodies->state->system.species[species]);
    const double along2 = bodies_squared(amplitude->parallel) / 3;
    if (!shape_is_oriented(body.shape)) return sqrt(3 * along2);
    const double across2 = bodies_squared(amplitude->perpendicular) / 3, a = amplitude->rotation;
    const double turn = bodies_turn_is_mixed(&bodies->settings) ? a / fmax(1 - a, 0.1) : a;
    const double rim = body.shape == SHAPE_PLATELET ? body.diameter / 2 : body.length / 2;
    return sqrt(along2 + 2 * across2) + rim * fmin(turn * sqrt(2.0 / 3), 2);
}

static double typical_trial(const Bodies *bodies) {
    double length = 0;
    for (size_t s = 0; s < bodies->state->system.species_count; s++) {
        length = fmax(length, species_trial(bodies, s));
    }
    return length;
}

// Of a convex body, averaged over the suspension.
typedef struct Measures {
    double volume, surface;
    double curvature; // mean, integrated over the surface
} Measures;

// A segment, disc or point with everything within t of it (Steiner).
static Measures swollen(const Body *body, double scale, double skin) {
    const bool flat = body->shape == SHAPE_PLATELET;
    const double radius = scale * body->diameter / 2, length = scale * body->length;
    const double t = skin / 2 + (flat ? 0 : radius);
    const double surface = flat ? 2 * PI * radius * radius : 0;
    const double curvature = flat ? PI * PI * radius : PI * length;
    return (Measures){.volume = surface * t + curvature * t * t + 4 * PI / 3 * t * t * t,
                      .surface = surface + 2 * curvature * t + 4 * PI * t * t,
                      .curvature = curvature + 4 * PI * t};
}

// How many are nearer than the skin to a body, if directions are isotropic: the excluded volume
// (Isihara; Kihara) times the density.
static double neighbours(const Bodies *bodies, double scale, double skin) {
    const System *system = &bodies->state->system;
    Measures mean = {0};
    for (size_t s = 0; s < system->species_count; s++) {
        const Body body = species_body(&system->species[s]);
        const Measures one = swollen(&body, scale, skin);
        mean.volume += system->species[s].fraction * one.volume;
        mean.surface += system->species[s].fraction * one.surface;
        mean.curvature += system->species[s].fraction * one.curvature;
    }
    return system_number_density(system) *
           (2 * mean.volume + mean.surface * mean.curvature / (2 * PI));
}

// Steps of a random walk to the edge of its rest: the square of how many fit into it.
static double cost(const Bodies *bodies, double scale, double length, double rest) {
    const double met = neighbours(bodies, scale, length) - neighbours(bodies, scale, 0);
    const double acceptance = 1 / (1 + LOWER * met);
    const double near = neighbours(bodies, scale, 2 * rest + LEASH * length);
    const double leaves = acceptance / bodies_squared(1 + rest / length);
    return near / LIST_BLOCK + leaves * (SEARCH + LISTING * near);
}

static double cost_of_cells(const Bodies *bodies, double reach) {
    const double number_density = system_number_density(&bodies->state->system);
    return SEARCH + 4 * PI / 3 * reach * reach * reach * number_density / LIST_BLOCK;
}

// 0 where looking through the cells costs less than any list that the box has room for.
static double best_rest(const Bodies *bodies, double scale, double length, double room) {
    double best = 0, least = cost_of_cells(bodies, scale / bodies->scale * bodies->longest);
    for (double rest = REST_LEAST; rest < REST_MOST; rest *= WIDER) {
        if (2 * rest + LEASH * length > room) break;
        const double work = cost(bodies, scale, length, rest);
        if (work >= least) continue;
        least = work;
        best = rest;
    }
    return best;
}

void bodies_choose_skin(Bodies *bodies, double scale) {
    BodyLists *lists = &bodies->lists;
    const double *edge = bodies->state->box.edge, grown = scale / bodies->scale;
    const double room = 0.499 * fmin(fmin(edge[0], edge[1]), edge[2]) - grown * bodies->longest;
    const double length = fmax(typical_trial(bodies), REST_LEAST / 100);
    const double rest = best_rest(bodies, scale, length, room);
    lists->scale = scale;
    lists->length = length;
    lists->swell = (float)(grown * 1.00001);
    lists->rest = (float)rest;
    lists->leash = rest > 0 ? (float)(rest + LEASH * length) : -1;
    lists->skin = rest > 0 ? 1.00001f * (lists->rest + lists->leash) : 0;
}

bool bodies_skin_suits(const Bodies *bodies) {
    const double length = fmax(typical_trial(bodies), REST_LEAST / 100);
    return length <= LONGER * bodies->lists.length && length >= SHORTER * bodies->lists.length;
}
