// SPDX-License-Identifier: GPL-3.0-or-later
// Pair distribution functions by direction in the plane of flow and gradient (Weysser, thesis, ch.
// 5): g_ab(r, theta), theta being the angle of the separation to x (in three dimensions the mean
// over the polar angle), and the harmonics that shear excites,
//   g(r) = g_0(r) + g_xy(r) 2xy/r^2 + g_xx-yy(r) (x^2 - y^2)/r^2 + ...,
// which in two dimensions stand before sin 2 theta and cos 2 theta. Of them g_xy over the rate is
// the linear response g_1(r) [T 5.58; its factor as in A.11]. What lies at contact is resolved by
// contact_stress.
#include "base/constants.h"
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/near_pairs.h"
#include "observables/pair_sums.h"
#include "observables/put.h"

#include <math.h>

typedef struct AngularSettings {
    double last, spacing;
    int64_t angles, looks;
} AngularSettings;

static const Option rows[] = {
    {.name = "distances.last",
     .type = OPTION_REAL,
     .offset = offsetof(AngularSettings, last),
     .least = 0,
     .most = 1e6,
     .unit = "d",
     .about = "Largest distance; 0 is 3 d, or half of the shortest edge if that "
              "is less."},
    {.name = "distances.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(AngularSettings, spacing),
     .fallback = 0.02,
     .least = 1e-4,
     .most = 1,
     .unit = "d",
     .about = "Width of a bin of distance."},
    {.name = "angles",
     .type = OPTION_INTEGER,
     .offset = offsetof(AngularSettings, angles),
     .fallback = 36,
     .least = 4,
     .most = 3600,
     .unit = "",
     .about = "Bins of the angle, from 0 to 180 degrees: a separation and its opposite are one."},
    LOOKS_OPTION(AngularSettings, looks, 400),
};

enum { HARMONICS = 3 };
static const char *const harmonic_names[HARMONICS] = {"isotropic", "xy", "xx-yy"};

typedef struct Angular {
    Observer observer;
    size_t species_count, bins, angles;
    double spacing;
    uint64_t looks;
    NearPairs *near;
    double *sums;     // [pair][harmonic][bin], over pairs of particles and looks
    uint64_t *counts; // [pair][bin][angle]
} Angular;

static const AngularSettings *settings_in(const Settings *settings) {
    return (const AngularSettings *)settings->bytes;
}

static double shortest_half(const Box *box) {
    return box_shortest_edge(box) / 2;
}

static const double USUAL_RANGE = 3; // d: beyond it little is left of what shear does to pairs

static double last_of(const AngularSettings *settings, const Box *box) {
    return settings->last > 0 ? settings->last : fmin(USUAL_RANGE, shortest_half(box));
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const double last = settings_in(settings_)->last;
    const Box box = system_box(system);
    if (last <= shortest_half(&box)) return OK;
    return status_fail(BAD_DATA,
                       "angular_pair_distribution: distances.last = %g exceeds half of the "
                       "shortest box edge, %g, beyond which a particle meets its own images; make "
                       "it shorter",
                       last, shortest_half(&box));
}

static void discard(Observer *observer) {
    Angular *self = (Angular *)observer;
    near_pairs_free(self->near);
    memory_free(self->sums);
    memory_free(self->counts);
    memory_free(self);
}

static Status allocate(Angular *self, const State *state) {
    const size_t pairs = pair_count(self->species_count);
    TRY(NEW_ARRAY(self->sums, pairs * HARMONICS * self->bins));
    TRY(NEW_ARRAY(self->counts, pairs * self->bins * self->angles));
    return near_pairs_create(&self->near, &state->box, state->count,
                             (double)self->bins * self->spacing);
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const AngularSettings *settings = settings_in(settings_);
    Angular *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_angular_pair_distribution, .clock = *clock};
    self->observer.period = looks_period(clock, settings->looks);
    self->species_count = state->system.species_count;
    self->angles = (size_t)settings->angles;
    self->spacing = settings->spacing;
    self->bins = pair_sums_bins(last_of(settings, &state->box), settings->spacing);
    return observer_begin(out, &self->observer, allocate(self, state));
}

// The angle to x or, of the opposite separation, that and half a turn: the bin of angles.
static size_t angle_of(const Angular *self, const double r[3]) {
    const double turn = atan2(r[1], r[0]) / PI; // half turns, from -1 to 1
    const double bin = (turn < 0 ? turn + 1 : turn) * (double)self->angles;
    return bin < (double)self->angles ? (size_t)bin : 0;
}

static void add_pair(Angular *self, const State *state, size_t i, size_t j, double distance) {
    double r[3] = {0, 0, 0};
    for (int a = 0; a < state->box.dimension; a++)
        r[a] = state->position[a][j] - state->position[a][i];
    box_nearest_image(&state->box, r);
    const double square = distance * distance;
    const double harmonics[HARMONICS] = {1, 2 * r[0] * r[1] / square,
                                         (r[0] * r[0] - r[1] * r[1]) / square};
    const size_t pair = pair_index(state->species_of[i], state->species_of[j], self->species_count);
    const size_t bin = (size_t)(distance / self->spacing);
    if (bin >= self->bins) return;
    for (size_t h = 0; h < HARMONICS; h++)
        self->sums[(pair * HARMONICS + h) * self->bins + bin] += harmonics[h];
    self->counts[(pair * self->bins + bin) * self->angles + angle_of(self, r)]++;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    Angular *self = (Angular *)observer;
    near_pairs_sort(self->near, state);
    for (size_t slot = 0; slot < state->count; slot++) {
        const size_t found = near_pairs_row(self->near, slot);
        for (size_t k = 0; k < found; k++) {
            add_pair(self, state, self->near->particle[slot], self->near->partner[k],
                     self->near->distance[k]);
        }
    }
    self->looks++;
    return OK;
}

static const uint64_t ANGULAR_TAG = 0x414e47554c523031; // "ANGULR01"

static void archive(Observer *observer, Archive *archive) {
    Angular *self = (Angular *)observer;
    const size_t pairs = pair_count(self->species_count);
    archive_tag(archive, ANGULAR_TAG);
    archive_u64(archive, &self->looks, 1);
    archive_f64(archive, self->sums, pairs * HARMONICS * self->bins);
    archive_u64(archive, self->counts, pairs * self->bins * self->angles);
}

// Pairs that an ideal gas has in a bin, in all looks: `number` of them in the box.
static double ideal(const Angular *self, const Box *box, double number, size_t bin) {
    const double low = (double)bin * self->spacing, high = (double)(bin + 1) * self->spacing;
    return (double)self->looks * number * pair_sums_shell(box->dimension, low, high) /
           box_volume(box);
}

// values[harmonic][bin] of a pair of species: each harmonic over its mean square over all
// directions.
static void fill_harmonics(const Angular *self, const Box *box, double number, const double *sums,
                           double *values) {
    const double mean_square = box->dimension == 2 ? 1.0 / 2 : 4.0 / 15;
    for (size_t h = 0; h < HARMONICS; h++) {
        const double norm = h == 0 ? 1 : mean_square;
        for (size_t k = 0; k < self->bins; k++)
            *values++ = *sums++ / ideal(self, box, number, k) / norm;
    }
}

// values[bin][angle] of a pair of species.
static void fill_angles(const Angular *self, const Box *box, double number, const uint64_t *counts,
                        double *values) {
    for (size_t k = 0; k < self->bins; k++) {
        const double pairs = ideal(self, box, number, k) / (double)self->angles;
        for (size_t t = 0; t < self->angles; t++) *values++ = (double)*counts++ / pairs;
    }
}

static void fill(const Angular *self, const State *state, double *harmonics, double *angles) {
    const size_t of_harmonics = HARMONICS * self->bins, of_angles = self->bins * self->angles;
    size_t pair = 0;
    for (size_t a = 0; a < self->species_count; a++) {
        for (size_t b = a; b < self->species_count; b++, pair++) {
            const double number = pair_sums_of(state, a, b).number;
            fill_harmonics(self, &state->box, number, self->sums + pair * of_harmonics,
                           harmonics + pair * of_harmonics);
            fill_angles(self, &state->box, number, self->counts + pair * of_angles,
                        angles + pair * of_angles);
        }
    }
}

typedef struct Axes {
    ResultAxis pair, distance, angle;
} Axes;

static Axes axes_of(const Angular *self, const Labels *labels, double *centres) {
    double *angles = centres + self->bins;
    for (size_t k = 0; k < self->bins; k++) centres[k] = ((double)k + 0.5) * self->spacing;
    for (size_t t = 0; t < self->angles; t++)
        angles[t] = ((double)t + 0.5) * 180 / (double)self->angles;
    return (Axes){{.name = "pair", .unit = "", .count = labels->count, .labels = labels->names},
                  {.name = "distance", .unit = "d", .count = self->bins, .values = centres},
                  {.name = "angle", .unit = "degrees", .count = self->angles, .values = angles}};
}

static Status put(const Angular *self, const Axes *axes, const double *harmonics,
                  const double *angles, Results *results, size_t replica) {
    const ResultSeries of_harmonics = {
        .unit = "",
        .axes = 3,
        .axis = {axes->pair,
                 {.name = "harmonic", .unit = "", .count = HARMONICS, .labels = harmonic_names},
                 axes->distance}};
    const ResultSeries of_angles = {
        .unit = "", .axes = 3, .axis = {axes->pair, axes->distance, axes->angle}};
    TRY(observer_put_series(&self->observer, "pair_harmonics", &of_harmonics, results, replica,
                            harmonics));
    return observer_put_series(&self->observer, "angular_pair_distribution", &of_angles, results,
                               replica, angles);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Angular *self = (const Angular *)observer;
    Labels pairs;
    labels_of_pairs(&pairs, &state->system, NULL);
    double *harmonics = NULL, *angles = NULL, *centres = NULL;
    Status status = NEW_ARRAY(harmonics, pairs.count * HARMONICS * self->bins);
    if (status == OK) status = NEW_ARRAY(angles, pairs.count * self->bins * self->angles);
    if (status == OK) status = NEW_ARRAY(centres, self->bins + self->angles);
    if (status == OK) {
        fill(self, state, harmonics, angles);
        const Axes axes = axes_of(self, &pairs, centres);
        status = put(self, &axes, harmonics, angles, results, replica);
    }
    memory_free(harmonics);
    memory_free(angles);
    memory_free(centres);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const AngularSettings *settings = settings_in(settings_);
    const Box box = system_box(system);
    const double last = last_of(settings, &box);
    const size_t bins = pair_sums_bins(last, settings->spacing);
    return sizeof(Angular) + near_pairs_memory(system, last) +
           pair_count(system->species_count) * bins * (HARMONICS + (size_t)settings->angles) *
               sizeof(double);
}

const ObservableKind observable_angular_pair_distribution = {
    .name = "angular_pair_distribution",
    .about =
        "Pair distribution functions by direction in the plane of flow and gradient, and their "
        "harmonics that shear excites.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(AngularSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
