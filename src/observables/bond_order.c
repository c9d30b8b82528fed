// SPDX-License-Identifier: GPL-3.0-or-later
// Bond-orientational order, which tells a crystal from a glass: in two dimensions psi_6 (Nelson &
// Halperin, Phys. Rev. B 19, 2457, 1979), in three Q_6 (Steinhardt, Nelson & Ronchetti, Phys. Rev.
// B 28, 784, 1983). Of each particle i the mean q_m(i) over the bonds to its neighbours of
// exp(6 i phi), or of the spherical harmonics Y_6m; then
//   local:  the mean over particles of sqrt(w sum_m |q_m(i)|^2),
//   global: sqrt(w sum_m |mean over particles of q_m(i)|^2),
// w = 1, or 4 pi/13. Neighbours are nearer than a multiple of the contact distance.
#include "base/constants.h"
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/near_pairs.h"
#include "observables/put.h"

#include <gsl/gsl_sf_legendre.h>
#include <math.h>
#include <string.h>

typedef struct BondSettings {
    int64_t looks;
    double neighbours;
} BondSettings;

static const Option rows[] = {
    LOOKS_OPTION(BondSettings, looks, 100),
    {.name = "neighbours",
     .type = OPTION_REAL,
     .offset = offsetof(BondSettings, neighbours),
     .fallback = 1.4,
     .least = 1.01,
     .most = 3,
     .unit = "contact distances",
     .about = "Particles nearer than this are neighbours: about the first minimum of g(r)."},
};

enum { DEGREE = 6, COMPONENTS = DEGREE + 1 }; // m = 0 ... 6; those of -m are as large
enum { LOCAL, GLOBAL, ORDERS };

typedef struct Component {
    double real, imaginary;
} Component;

typedef struct BondOrder {
    Observer observer;
    int dimension;
    size_t looks, done;
    double neighbours; // in contact distances
    NearPairs *pairs;
    size_t *bonds;    // [particles], of the configuration looked at
    Component *sum;   // [particles][COMPONENTS]
    double *legendre; // [of the degrees 0 ... 6]
    double *values;   // [ORDERS][looks]
} BondOrder;

static int64_t period_for(const Settings *settings, const Clock *clock) {
    return looks_period(clock, ((const BondSettings *)settings->bytes)->looks);
}

static double range_for(const Settings *settings, const System *system) {
    double widest = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        widest = fmax(widest, system->species[s].diameter);
    }
    return ((const BondSettings *)settings->bytes)->neighbours * widest;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)clock;
    const Box box = system_box(system);
    for (size_t s = 0; s < system->species_count; s++) {
        if (!shape_is_oriented((ShapeKind)system->species[s].shape)) continue;
        return status_fail(BAD_DATA,
                           "bond_order: species '%s' has a body axis, and no contact distance; "
                           "see nematic_order",
                           system->species[s].name);
    }
    for (int a = 0; a < box.dimension; a++) {
        if (2 * range_for(settings, system) <= box.edge[a]) continue;
        return status_fail(BAD_DATA,
                           "bond_order: neighbours = %g reaches beyond half of the box edge %g; "
                           "take more particles",
                           ((const BondSettings *)settings->bytes)->neighbours, box.edge[a]);
    }
    return OK;
}

static void discard(Observer *observer) {
    BondOrder *self = (BondOrder *)observer;
    near_pairs_free(self->pairs);
    memory_free(self->bonds);
    memory_free(self->sum);
    memory_free(self->legendre);
    memory_free(self->values);
    memory_free(self);
}

static Status allocate(BondOrder *self, const State *state) {
    const double half = box_shortest_edge(&state->box) / 2;
    double widest = 0;
    for (size_t i = 0; i < state->count; i++) widest = fmax(widest, state->diameter[i]);
    TRY(NEW_ARRAY(self->bonds, state->count));
    TRY(NEW_ARRAY(self->sum, state->count * COMPONENTS));
    TRY(NEW_ARRAY(self->legendre, gsl_sf_legendre_array_n(DEGREE)));
    TRY(NEW_ARRAY(self->values, ORDERS * self->looks));
    return near_pairs_create(&self->pairs, &state->box, state->count,
                             fmin(half, self->neighbours * widest));
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    BondOrder *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_bond_order, .clock = *clock};
    self->dimension = state->box.dimension;
    self->observer.period = period_for(settings, clock);
    self->looks = (size_t)looks_count(clock, self->observer.period);
    self->neighbours = ((const BondSettings *)settings->bytes)->neighbours;
    return observer_begin(out, &self->observer, allocate(self, state));
}

static Component times(Component a, Component b) {
    return (Component){a.real * b.real - a.imaginary * b.imaginary,
                       a.real * b.imaginary + a.imaginary * b.real};
}

// exp(i m phi) for m = 0 ... 6, without an angle. Along z no component but m = 0 counts.
static void turns(const double bond[3], Component turn[COMPONENTS]) {
    const double r = hypot(bond[0], bond[1]);
    const Component once = r > 0 ? (Component){bond[0] / r, bond[1] / r} : (Component){1, 0};
    turn[0] = (Component){1, 0};
    for (size_t m = 1; m < COMPONENTS; m++) turn[m] = times(turn[m - 1], once);
}

// What a bond adds, the same for both of its ends: 6 is even.
static void components_of(const BondOrder *self, const double bond[3], double distance,
                          Component value[COMPONENTS]) {
    turns(bond, value);
    if (self->dimension == 2) {
        for (size_t m = 0; m < DEGREE; m++) value[m] = (Component){0, 0};
        return;
    }
    gsl_sf_legendre_array(GSL_SF_LEGENDRE_SPHARM, DEGREE, bond[2] / distance, self->legendre);
    for (size_t m = 0; m < COMPONENTS; m++) {
        const double size = self->legendre[gsl_sf_legendre_array_index(DEGREE, m)];
        value[m].real *= size;
        value[m].imaginary *= size;
    }
}

static void add_bond(BondOrder *self, const State *state, size_t i, size_t j, double distance) {
    double bond[3] = {0};
    Component value[COMPONENTS];
    for (int a = 0; a < self->dimension; a++) {
        bond[a] = state->position[a][j] - state->position[a][i];
    }
    box_nearest_image(&state->box, bond);
    components_of(self, bond, distance, value);
    self->bonds[i]++;
    self->bonds[j]++;
    for (size_t m = 0; m < COMPONENTS; m++) {
        self->sum[i * COMPONENTS + m].real += value[m].real;
        self->sum[i * COMPONENTS + m].imaginary += value[m].imaginary;
        self->sum[j * COMPONENTS + m].real += value[m].real;
        self->sum[j * COMPONENTS + m].imaginary += value[m].imaginary;
    }
}

static void add_bonds(BondOrder *self, const State *state) {
    const NearPairs *pairs = self->pairs;
    near_pairs_sort(self->pairs, state);
    for (size_t slot = 0; slot < state->count; slot++) {
        const size_t found = near_pairs_row(self->pairs, slot), i = pairs->particle[slot];
        for (size_t k = 0; k < found; k++) {
            const size_t j = pairs->partner[k];
            const double contact = (state->diameter[i] + state->diameter[j]) / 2;
            if (pairs->distance[k] < self->neighbours * contact)
                add_bond(self, state, i, j, pairs->distance[k]);
        }
    }
}

static double invariant(const BondOrder *self, const Component mean[COMPONENTS]) {
    double sum = 0;
    for (size_t m = 0; m < COMPONENTS; m++) {
        const double square = mean[m].real * mean[m].real + mean[m].imaginary * mean[m].imaginary;
        sum += self->dimension == 3 && m > 0 ? 2 * square : square; // -m and m
    }
    return self->dimension == 3 ? sqrt(4 * PI / (2 * DEGREE + 1) * sum) : sqrt(sum);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    BondOrder *self = (BondOrder *)observer;
    Component all[COMPONENTS] = {{0, 0}};
    double local = 0;
    memset(self->bonds, 0, state->count * sizeof *self->bonds);
    memset(self->sum, 0, state->count * COMPONENTS * sizeof *self->sum);
    add_bonds(self, state);
    for (size_t i = 0; i < state->count; i++) {
        Component *mean = &self->sum[i * COMPONENTS];
        const double bonds = self->bonds[i] > 0 ? (double)self->bonds[i] : 1;
        for (size_t m = 0; m < COMPONENTS; m++) {
            mean[m] = (Component){mean[m].real / bonds, mean[m].imaginary / bonds};
            all[m].real += mean[m].real / (double)state->count;
            all[m].imaginary += mean[m].imaginary / (double)state->count;
        }
        local += invariant(self, mean) / (double)state->count;
    }
    self->done = (size_t)(tick / self->observer.period);
    ASSERT(self->done >= 1 && self->done <= self->looks);
    self->values[LOCAL * self->looks + self->done - 1] = local;
    self->values[GLOBAL * self->looks + self->done - 1] = invariant(self, all);
    return OK;
}

static const uint64_t BOND_TAG = 0x424f4e4430303031; // "BOND0001"

static void archive(Observer *observer, Archive *archive) {
    BondOrder *self = (BondOrder *)observer;
    uint64_t done = self->done;
    archive_tag(archive, BOND_TAG);
    archive_u64(archive, &done, 1);
    archive_require(archive, done <= self->looks, "it has a bond order too many");
    archive_f64(archive, self->values, ORDERS * self->looks);
    if (archive_status(archive, false) == OK) self->done = (size_t)done;
}

static double mean_of(const double *values, size_t count) {
    double sum = 0;
    for (size_t k = 0; k < count; k++) sum += values[k];
    return sum / (double)count;
}

static Status put_scalars(const BondOrder *self, Results *results, size_t replica) {
    const double *global = self->values + GLOBAL * self->looks;
    TRY(observer_put_scalar(&self->observer, "bond_order_local", "", NULL, results, replica,
                            mean_of(self->values, self->done)));
    return observer_put_scalar(&self->observer, "bond_order_global", "", NULL, results, replica,
                               mean_of(global, self->done));
}

static Status put_looks(const BondOrder *self, double *times_seen, Results *results,
                        size_t replica) {
    static const char *const orders[ORDERS] = {"local", "global"};
    const Clock *clock = &self->observer.clock;
    for (size_t k = 0; k < self->looks; k++) {
        times_seen[k] = (double)(k + 1) * (double)self->observer.period * clock->tick;
    }
    const ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {
            {.name = "order", .unit = "", .count = ORDERS, .labels = orders},
            {.name = "time", .unit = clock->unit, .count = self->looks, .values = times_seen}}};
    return observer_put_series(&self->observer, "bond_order", &shape, results, replica,
                               self->values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    (void)state;
    const BondOrder *self = (const BondOrder *)observer;
    double *times_seen = NULL;
    TRY(NEW_ARRAY(times_seen, self->looks));
    Status status = put_scalars(self, results, replica);
    if (status == OK) status = put_looks(self, times_seen, results, replica);
    memory_free(times_seen);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    return sizeof(BondOrder) +
           (size_t)system->particles * (sizeof(size_t) + COMPONENTS * sizeof(Component)) +
           ORDERS * (size_t)looks_count(clock, period_for(settings, clock)) * sizeof(double) +
           near_pairs_memory(system, range_for(settings, system));
}

const ObservableKind observable_bond_order = {
    .name = "bond_order",
    .about = "Bond-orientational order, local and global: does the sample crystallise?",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(BondSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
