// SPDX-License-Identifier: GPL-3.0-or-later
// From nothing to a valid State. Discs and spheres: draw sizes, put species at random on a lattice
// with diameters scaled down, melt it as a fluid, and let the diameters grow at a constant rate
// while the event-driven dynamics runs (Lubachevsky and Stillinger, J. Stat. Phys. 60, 561, 1990).
// Growing heats the particles; their velocities are drawn anew often enough for that not to matter.
// Soft spheres begin as hard ones, of a density that these reach easily. Bodies with an axis are
// compressed by Monte Carlo (compress.c). A crystal is left for the first stage to melt.
#include "packing/packing.h"

#include "base/memory.h"
#include "base/seconds.h"
#include "dmc/dmc.h"
#include "edbd/edbd.h"
#include "packing/compress.h"
#include "packing/crystal.h"
#include "packing/lattice.h"

#include <math.h>

static const double WINDOW = 0.01;           // in d sqrt(m/kT), as all times, for diameters near 1
static const int64_t WINDOWS_PER_DRAW = 10;  // of the velocities
static const int64_t WINDOWS_PER_LOOK = 100; // at `stop`
static const double MELT_PACKING[2] = {0.40, 0.30}; // 2D, 3D: fluids that mix fast
static const double MELT_TIME = 20;                 // in d sqrt(m/kT), and
static const double MELT_TIME_PER_EDGE = 0.5;       // sound must cross the box, if it is small:
static const double MELT_TIME_MOST = 60;            // order is lost locally
static const double GROWTH_RATE = 0.02; // of the scale of diameters, per d sqrt(m/kT); where the
static const double SLOWER = 5;         // particles jam, again, this much slower,
static const int ATTEMPTS = 3;          // so often in all: slow growth finds denser packings
static const double LATTICE_GAP = 1e-3; // between the largest neighbours at the start
static const double MARGIN = 1e-10;     // grown beyond the target, so that contacts open

// Packing fractions that growth at this rate reaches; above, everything jams or must crystallise.
static const double EQUAL_MOST[2] = {0.86, 0.60}, UNEQUAL_MOST[2] = {0.83, 0.62};

// Densities that compression of bodies from a dilute disorder reaches in reasonable time: packing
// fraction of spherocylinders and spheres, number density of platelets in 1/d^3.
static const double RODS_MOST = 0.5, PLATELETS_MOST = 12;
static const double SOFT_PACKING = 0.5; // of the hard spheres that soft ones begin as

static bool has_shape(const System *system, ShapeKind shape) {
    for (size_t s = 0; s < system->species_count; s++) {
        if (system->species[s].shape == (int64_t)shape) return true;
    }
    return false;
}

static bool sizes_spread(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        if (species->spread != SPREAD_NONE && species->spread_width > 0) return true;
    }
    return false;
}

static bool sizes_differ(const System *system) {
    for (size_t s = 1; s < system->species_count; s++) {
        if (system->species[s].diameter != system->species[0].diameter) return true;
    }
    return sizes_spread(system);
}

// The smallest upright cylinder with room for every body.
static Body largest_body(const System *system) {
    Body largest = {.shape = SHAPE_SPHEROCYLINDER};
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        largest.diameter = fmax(largest.diameter, species->diameter);
        largest.length = fmax(largest.length, species->length);
    }
    return largest;
}

static Status find_layers(Layers *layers, const System *system) {
    const Body body = largest_body(system);
    const Box box = system_box(system);
    return crystal_layers(layers, &box, (size_t)system->particles, body.diameter,
                          shape_reach(&body));
}

// Upright platelets overlap nowhere.
static Status check_crystal_of_bodies(const System *system) {
    Layers layers;
    if (!has_shape(system, SHAPE_PLATELET)) return find_layers(&layers, system);
    if (!has_shape(system, SHAPE_SPHERE)) return OK;
    return status_fail(BAD_DATA, "start = crystal: there is none of platelets with spheres");
}

static Status check_bodies(const System *system) {
    TRY(chain_check(system));
    if (sizes_spread(system)) {
        return status_fail(BAD_DATA, "spread: bodies with an axis have one size in each species");
    }
    if (system->start == START_CRYSTAL) return check_crystal_of_bodies(system);
    const double phi = system_packing_fraction(system), density = system_number_density(system);
    if (phi > RODS_MOST) {
        return status_fail(BAD_DATA,
                           "packing_fraction = %.4g exceeds %.2f, up to which bodies are "
                           "compressed from disorder; use start: crystal",
                           phi, RODS_MOST);
    }
    if (!has_shape(system, SHAPE_PLATELET) || density <= PLATELETS_MOST) return OK;
    return status_fail(BAD_DATA,
                       "number_density = %.4g exceeds %g, up to which platelets are compressed "
                       "from disorder; use start: crystal",
                       density, PLATELETS_MOST);
}

static Status check_crystal_of_balls(const System *system) {
    if (has_shape(system, SHAPE_SOFT_SPHERE)) return OK;
    const Box box = system_box(system);
    const Lattice lattice = lattice_best(&box, (size_t)system->particles);
    const Body body = largest_body(system);
    if (!sizes_spread(system) && lattice.nearest > body.diameter) return OK;
    return status_fail(BAD_DATA,
                       "start = crystal: no lattice in this box has room for these particles; "
                       "another number of them or start: compressed may");
}

static Status check_swelling(const System *system) {
    if (has_shape(system, SHAPE_SOFT_SPHERE)) return OK;
    const double phi = system_packing_fraction(system);
    const int flat = system->dimension == 2;
    const bool differ = sizes_differ(system);
    const double most = differ ? UNEQUAL_MOST[!flat] : EQUAL_MOST[!flat];
    if (phi <= most) return OK;
    return status_fail(BAD_DATA,
                       "packing_fraction = %.4g exceeds %.2f, up to which swelling packs "
                       "%s %s in disorder",
                       phi, most, differ ? "unequal" : "equal", flat ? "discs" : "spheres");
}

Status packing_check(const System *system) {
    if (system_is_oriented(system)) return check_bodies(system);
    return system->start == START_CRYSTAL ? check_crystal_of_balls(system) : check_swelling(system);
}

// Relative deviation of a diameter from its mean. The Gaussian is cut at three widths.
static double draw_deviation(const Species *species, Rng *rng) {
    static const double CUT = 3;
    if (species->spread == SPREAD_UNIFORM) {
        return species->spread_width * sqrt(3.0) * (2 * rng_uniform(rng) - 1);
    }
    double x;
    do x = rng_normal(rng);
    while (!(fabs(x) <= CUT));
    return species->spread_width * x;
}

// The box is that of the mean sizes: drawn ones are scaled by one factor near 1 to fill it right.
static void draw_diameters(State *state, RngKey key) {
    bool spread = false;
    for (size_t i = 0; i < state->count; i++) {
        const Species *species = &state->system.species[state->species_of[i]];
        state->diameter[i] = species->diameter;
        if (species->spread == SPREAD_NONE) continue;
        Rng rng = rng_open(key, STREAM_DIAMETERS, 0, i);
        state->diameter[i] *= 1 + draw_deviation(species, &rng);
        spread = true;
    }
    if (!spread) return;
    const double ratio = system_packing_fraction(&state->system) / state_packing_fraction(state);
    const double factor = state->box.dimension == 2 ? sqrt(ratio) : cbrt(ratio);
    for (size_t i = 0; i < state->count; i++) state->diameter[i] *= factor;
}

// The numbers below `sites` at random, as many as there are particles; some may be left over.
static Status draw_sites(uint32_t **out, size_t particles, size_t sites, RngKey key) {
    uint32_t *site = NULL;
    TRY(NEW_ARRAY(site, sites));
    for (size_t s = 0; s < sites; s++) site[s] = (uint32_t)s;
    Rng rng = rng_open(key, STREAM_PACKING, 0, 0);
    for (size_t i = 0; i < particles; i++) {
        const size_t other = i + rng_below(&rng, sites - i);
        const uint32_t swap = site[i];
        site[i] = site[other];
        site[other] = swap;
    }
    *out = site;
    return OK;
}

// Every particle on a lattice site drawn at random.
static Status place(State *state, RngKey key, const Lattice *lattice) {
    uint32_t *site = NULL;
    TRY(draw_sites(&site, state->count, lattice_sites(lattice), key));
    for (size_t i = 0; i < state->count; i++) {
        double position[3];
        lattice_site(lattice, site[i], position);
        for (int a = 0; a < state->box.dimension; a++) state->position[a][i] = position[a];
    }
    memory_free(site);
    return OK;
}

static double largest_diameter(const State *state) {
    double largest = 0;
    for (size_t i = 0; i < state->count; i++) largest = fmax(largest, state->diameter[i]);
    return largest;
}

static double starting_scale(const State *state, const Lattice *lattice) {
    const int flat = state->box.dimension == 2;
    const double ratio = MELT_PACKING[!flat] / state_packing_fraction(state);
    const double fluid = flat ? sqrt(ratio) : cbrt(ratio);
    const double room = lattice->nearest * (1 - LATTICE_GAP) / largest_diameter(state);
    return fmin(1, fmin(fluid, room));
}

static Status run(Engine *engine, int64_t windows, const atomic_int *stop, Tally *tally) {
    while (windows > 0) {
        if (stop && atomic_load(stop)) return status_fail(INTERRUPTED, "stopped while packing");
        const int64_t next = windows < WINDOWS_PER_LOOK ? windows : WINDOWS_PER_LOOK;
        TRY(engine_advance(engine, next, tally));
        windows -= next;
    }
    return OK;
}

// The diameter that times scale with, since large particles need longer to pass each other: the
// smallest, so that none flies far in a window, but not below 1, where time is no concern.
static double reference_diameter(const System *system) {
    double smallest = system->species[0].diameter;
    for (size_t s = 1; s < system->species_count; s++) {
        smallest = fmin(smallest, system->species[s].diameter);
    }
    return fmax(1, smallest);
}

static Status melt_and_grow(State *state, Engine *engine, double scale, double rate,
                            const atomic_int *stop, Tally *tally) {
    const double reference = reference_diameter(&state->system), window = WINDOW * reference;
    const double melt =
        fmin(MELT_TIME * reference + MELT_TIME_PER_EDGE * box_longest_edge(&state->box),
             MELT_TIME_MOST * reference);
    engine_grow(engine, scale, 0);
    TRY(run(engine, (int64_t)ceil(melt / window), stop, tally));
    if (scale == 1) return OK;
    const double growth = 1 + MARGIN - scale;
    const int64_t windows = (int64_t)ceil(growth / (rate * WINDOW));
    engine_grow(engine, scale, growth / ((double)windows * window));
    return run(engine, windows, stop, tally);
}

static Status swell(State *state, RngKey key, double scale, double rate, const atomic_int *stop,
                    Tally *tally) {
    const EngineSettings settings = {.window = WINDOW * reference_diameter(&state->system),
                                     .windows_per_step = WINDOWS_PER_DRAW,
                                     .redraw = 1,
                                     .stream = STREAM_SWELLING};
    Engine *engine = NULL;
    TRY(engine_create(&engine, &settings, state, key));
    const Status status = melt_and_grow(state, engine, scale, rate, stop, tally);
    engine_free(engine);
    return status;
}

// Where particles are in equilibrium does not depend on their masses. All are packed with mass 1,
// so that heavy ones melt and make room as fast as light ones.
static void forget_masses(State *state) {
    for (size_t i = 0; i < state->count; i++) state->mass[i] = 1;
}

static void restore_masses(State *state) {
    for (size_t i = 0; i < state->count; i++) {
        state->mass[i] = state->system.species[state->species_of[i]].mass;
    }
}

static void rest(State *state) {
    state->step = 0;
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++) {
            state->velocity[a][i] = 0;
            state->image[a][i] = 0;
        }
    }
}

// At rest, in the box it started in, at step 0: the propagator draws the velocities.
static Status settle(State *state) {
    rest(state);
    restore_masses(state);
    double deepest = 0;
    TRY(state_validate(state));
    TRY(state_deepest_overlap(state, 0, &deepest, NULL));
    if (deepest <= 0) return OK;
    return status_fail(UNHEALTHY, "the packing overlaps by %.3g", deepest);
}

// Swells, and where that jams, swells again more slowly.
static Status grow(State *state, RngKey key, const Lattice *lattice, const atomic_int *stop,
                   PackingReport *report) {
    double rate = GROWTH_RATE;
    for (int attempt = 1;; attempt++, rate /= SLOWER) {
        Tally tally = {0};
        rest(state);
        TRY(place(state, key, lattice));
        const Status status = swell(state, key, report->lattice_scale, rate, stop, &tally);
        report->windows += (int64_t)tally.windows;
        if (status != UNHEALTHY) return status;
        if (attempt == ATTEMPTS) break;
    }
    return status_fail(UNHEALTHY, "swelling to packing fraction %.4g failed: %s",
                       system_packing_fraction(&state->system), status_sentence());
}

static double soft_scale(const State *state) {
    if (!has_shape(&state->system, SHAPE_SOFT_SPHERE)) return 1;
    return fmin(1, cbrt(SOFT_PACKING / state_packing_fraction(state)));
}

static void scale_diameters(State *state, double scale) {
    for (size_t i = 0; i < state->count; i++) state->diameter[i] *= scale;
}

static Status pack_balls(State *state, RngKey key, const atomic_int *stop, PackingReport *report) {
    const Lattice lattice = lattice_best(&state->box, state->count);
    if (state->system.start == START_CRYSTAL) return place(state, key, &lattice);
    const double soft = soft_scale(state);
    if (soft < 1) scale_diameters(state, soft);
    forget_masses(state);
    report->lattice_scale = starting_scale(state, &lattice);
    TRY(grow(state, key, &lattice, stop, report));
    if (soft < 1) draw_diameters(state, key);
    return OK;
}

static void place_anywhere(State *state, RngKey key) {
    for (size_t i = 0; i < state->count; i++) {
        Rng rng = rng_open(key, STREAM_PACKING, 0, i);
        for (int a = 0; a < 3; a++) state->position[a][i] = rng_uniform(&rng) * state->box.edge[a];
    }
}

// Axes lie along z from the beginning.
static Status place_upright(State *state, RngKey key) {
    if (has_shape(&state->system, SHAPE_PLATELET)) {
        place_anywhere(state, key);
        return OK;
    }
    Layers layers;
    uint32_t *site = NULL;
    TRY(find_layers(&layers, &state->system));
    TRY(draw_sites(&site, state->count, crystal_sites(&layers), key));
    for (size_t i = 0; i < state->count; i++) {
        double position[3];
        crystal_site(&layers, site[i], position);
        for (int a = 0; a < 3; a++) state->position[a][i] = position[a];
    }
    memory_free(site);
    return OK;
}

// Where the balls round all bodies have room on the lattice, axes may point anywhere.
static Status pack_bodies(State *state, RngKey key, const atomic_int *stop, PackingReport *report) {
    if (state->system.start == START_CRYSTAL) return place_upright(state, key);
    const Lattice lattice = lattice_best(&state->box, state->count);
    const Body body = largest_body(&state->system);
    TRY(place(state, key, &lattice));
    report->lattice_scale = fmin(1, lattice.nearest * (1 - LATTICE_GAP) / shape_reach(&body));
    return compress_bodies(state, key, report->lattice_scale, stop, report);
}

static Status pack(State *state, RngKey key, const atomic_int *stop, PackingReport *report) {
    draw_diameters(state, key);
    report->lattice_scale = 1;
    TRY(state->oriented ? pack_bodies(state, key, stop, report)
                        : pack_balls(state, key, stop, report));
    return settle(state);
}

Status packing_create(State **out, const System *system, RngKey key, const atomic_int *stop,
                      PackingReport *report) {
    TRY(packing_check(system));
    const double start = seconds_now();
    PackingReport unread;
    if (!report) report = &unread;
    *report = (PackingReport){0};
    State *state = NULL;
    TRY(state_create(&state, system));
    const Status status = pack(state, key, stop, report);
    if (status != OK) {
        state_free(state);
        return status;
    }
    report->seconds = seconds_now() - start;
    *out = state;
    return OK;
}
