// SPDX-License-Identifier: GPL-3.0-or-later
// The stress of hard cores from where they touch, which knows nothing of collisions (Weysser,
// thesis, eqs. 5.51 and A.21, of which the sign and the power of d_ab are misprinted): with unit
// vectors n between the pairs,
//   sigma_ab = -(kT/V) < sum over pairs of n_a n_b delta(x) >,   x = r/d_ij - 1 from above.
// The sum is histogrammed in x, each pair over (r/d_ij)^(dim - 1) as an ideal gas would have it,
// and analysis extrapolates to contact. In the plane the same pairs are counted by the direction of
// n, for g_ab(contact, theta), from the x axis towards the y axis; n and -n are the same pair.
#include "base/constants.h"
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/near_pairs.h"
#include "observables/put.h"

#include <math.h>
#include <string.h>

typedef struct ContactSettings {
    double last, spacing;
    int64_t angles, looks;
} ContactSettings;

static const Option rows[] = {
    {.name = "contact.last",
     .type = OPTION_REAL,
     .offset = offsetof(ContactSettings, last),
     .fallback = 1.1,
     .least = 1.001,
     .most = 2,
     .unit = "",
     .about = "End of the histogram, in units of the pair's contact distance."},
    {.name = "contact.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(ContactSettings, spacing),
     .fallback = 0.002,
     .least = 1e-5,
     .most = 0.1,
     .unit = "",
     .about = "Width of its bins, in the same units."},
    {.name = "angles",
     .type = OPTION_INTEGER,
     .offset = offsetof(ContactSettings, angles),
     .fallback = 24,
     .least = 4,
     .most = 720,
     .unit = "",
     .about = "Sectors of the half turn from the x axis in which pairs are counted; discs only."},
    LOOKS_OPTION(ContactSettings, looks, 1000),
};

enum { ELEMENTS = 6, XY = 2 };
static const struct {
    const char *name;
    int row, column;
} element[ELEMENTS] = {{"xx", 0, 0}, {"yy", 1, 1}, {"xy", 0, 1},
                       {"zz", 2, 2}, {"xz", 0, 2}, {"yz", 1, 2}};

typedef struct ContactStress {
    Observer observer;
    NearPairs *pairs;
    double spacing;
    size_t elements, bins, angles, species_count;
    uint64_t looks;
    double *sums;     // [element][bin], of n_a n_b over (r/d_ij)^(dim - 1)
    uint64_t *counts; // [pair of species][angle][bin]; none in space
} ContactStress;

static const ContactSettings *settings_in(const Settings *settings) {
    return (const ContactSettings *)settings->bytes;
}

static size_t bins_for(const ContactSettings *settings) {
    const double bins = floor((settings->last - 1) / settings->spacing + 1e-9);
    return bins < 1 ? 1 : (size_t)bins;
}

static size_t angles_for(const ContactSettings *settings, int64_t dimension) {
    return dimension == 2 ? (size_t)settings->angles : 0;
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const ContactSettings *settings = settings_in(settings_);
    const Box box = system_box(system);
    const double shortest = box_shortest_edge(&box);
    double widest = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const ShapeKind shape = (ShapeKind)system->species[s].shape;
        widest = fmax(widest, system->species[s].diameter);
        if (!shape_is_oriented(shape) && shape_is_hard(shape)) continue;
        return status_fail(BAD_DATA,
                           "contact_stress: only hard discs and spheres touch at one distance, and "
                           "'%s' is a %s; leave it out",
                           system->species[s].name, shape_names[shape]);
    }
    if (settings->last * widest <= shortest / 2) return OK;
    return status_fail(BAD_DATA,
                       "contact_stress: contact.last = %g diameters of %g exceed half of the box "
                       "edge %g; take more particles",
                       settings->last, widest, shortest);
}

static void discard(Observer *observer) {
    ContactStress *self = (ContactStress *)observer;
    near_pairs_free(self->pairs);
    memory_free(self->sums);
    memory_free(self->counts);
    memory_free(self);
}

static size_t count_size(const ContactStress *self) {
    return pair_count(self->species_count) * self->angles * self->bins;
}

static Status allocate(ContactStress *self, const State *state, double last) {
    const double half = box_shortest_edge(&state->box) / 2;
    double widest = 0;
    for (size_t i = 0; i < state->count; i++) widest = fmax(widest, state->diameter[i]);
    TRY(NEW_ARRAY(self->sums, self->elements * self->bins));
    if (self->angles > 0) TRY(NEW_ARRAY(self->counts, count_size(self)));
    return near_pairs_create(&self->pairs, &state->box, state->count, fmin(half, widest * last));
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const ContactSettings *settings = settings_in(settings_);
    ContactStress *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_contact_stress, .clock = *clock};
    self->observer.period = looks_period(clock, settings->looks);
    self->spacing = settings->spacing;
    self->elements = state->box.dimension == 2 ? 3 : ELEMENTS;
    self->bins = bins_for(settings);
    self->angles = angles_for(settings, state->box.dimension);
    self->species_count = state->system.species_count;
    return observer_begin(out, &self->observer, allocate(self, state, settings->last));
}

// Sector of the half turn that the direction is in.
static size_t sector_of(const ContactStress *self, const double n[3]) {
    const double sign = n[1] < 0 ? -1 : 1;
    const double angle = atan2(sign * n[1], sign * n[0]); // from 0 to pi
    const size_t sector = (size_t)(angle / PI * (double)self->angles);
    return sector < self->angles ? sector : 0; // pi is 0
}

static void add_pair(ContactStress *self, const State *state, size_t i, size_t j) {
    const int dimension = state->box.dimension;
    double n[3] = {0}, r2 = 0;
    for (int a = 0; a < dimension; a++) n[a] = state->position[a][i] - state->position[a][j];
    box_nearest_image(&state->box, n);
    for (int a = 0; a < dimension; a++) r2 += n[a] * n[a];
    const double r = sqrt(r2);
    const double scaled = 2 * r / (state->diameter[i] + state->diameter[j]);
    const double place = fmax(scaled - 1, 0) / self->spacing;
    if (!(place < (double)self->bins)) return;
    const size_t bin = (size_t)place;
    const double weight = 1 / (dimension == 2 ? scaled : scaled * scaled);
    for (int a = 0; a < dimension; a++) n[a] /= r;
    for (size_t e = 0; e < self->elements; e++) {
        self->sums[e * self->bins + bin] += weight * (n[element[e].row] * n[element[e].column]);
    }
    if (!self->counts) return;
    const size_t pair = pair_index(state->species_of[i], state->species_of[j], self->species_count);
    self->counts[(pair * self->angles + sector_of(self, n)) * self->bins + bin]++;
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    ContactStress *self = (ContactStress *)observer;
    NearPairs *pairs = self->pairs;
    near_pairs_sort(pairs, state);
    for (size_t slot = 0; slot < state->count; slot++) {
        const size_t found = near_pairs_row(pairs, slot);
        for (size_t k = 0; k < found; k++) {
            add_pair(self, state, pairs->particle[slot], pairs->partner[k]);
        }
    }
    self->looks++;
    return OK;
}

static const uint64_t CONTACT_TAG = 0x434f4e5453303031; // "CONTS001"

static void archive(Observer *observer, Archive *archive) {
    ContactStress *self = (ContactStress *)observer;
    archive_tag(archive, CONTACT_TAG);
    archive_u64(archive, &self->looks, 1);
    archive_f64(archive, self->sums, self->elements * self->bins);
    if (self->counts) archive_u64(archive, self->counts, count_size(self));
}

static Status put_stress(const ContactStress *self, const State *state, double *values,
                         double *centres, Results *results, size_t replica) {
    const char *names[ELEMENTS];
    const double factor = -1 / (box_volume(&state->box) * (double)self->looks * self->spacing);
    size_t count = 0;
    for (size_t e = 0; e < self->elements; e++) {
        if (e == XY && drive_oscillates(self->observer.clock.drive)) continue; // has no mean
        double *row = values + count * self->bins;
        names[count++] = element[e].name;
        for (size_t k = 0; k < self->bins; k++) row[k] = factor * self->sums[e * self->bins + k];
    }
    for (size_t k = 0; k < self->bins; k++) centres[k] = 1 + ((double)k + 0.5) * self->spacing;
    ResultSeries shape = {
        .axes = 2,
        .axis = {{.name = "element", .unit = "", .count = count, .labels = names},
                 {.name = "scaled_distance", .unit = "", .count = self->bins, .values = centres}}};
    strcpy(shape.unit, state->box.dimension == 2 ? "kT/d^2" : "kT/d^3");
    return observer_put_series(&self->observer, "contact_stress", &shape, results, replica, values);
}

// Pairs i of species a and j of species b: the sum of d_ij^2.
static double squares_of(const State *state, size_t a, size_t b) {
    double number[2] = {0}, first[2] = {0}, second[2] = {0}, itself = 0;
    for (size_t i = 0; i < state->count; i++) {
        const double d = state->diameter[i];
        const size_t is[2] = {state->species_of[i] == a, state->species_of[i] == b};
        for (int s = 0; s < 2; s++) {
            number[s] += (double)is[s];
            first[s] += (double)is[s] * d;
            second[s] += (double)is[s] * d * d;
        }
        itself += a == b && is[0] ? d * d : 0;
    }
    const double all =
        (second[0] * number[1] + 2 * first[0] * first[1] + number[0] * second[1]) / 4 - itself;
    return a == b ? all / 2 : all;
}

// Counts over those of an ideal gas: values[pair][angle][bin].
static Status put_angles(const ContactStress *self, const State *state, double *values,
                         const double *centres, Results *results, size_t replica) {
    Labels labels;
    labels_of_pairs(&labels, &state->system, NULL);
    size_t at = 0;
    for (size_t a = 0; a < self->species_count; a++) {
        for (size_t b = a; b < self->species_count; b++) {
            const double pairs = squares_of(state, a, b) / box_volume(&state->box);
            for (size_t k = 0; k < self->angles * self->bins; k++, at++) {
                const double area = 2 * PI / (double)self->angles * centres[k % self->bins] *
                                    self->spacing; // n and -n
                values[at] = (double)self->counts[at] / ((double)self->looks * pairs * area);
            }
        }
    }
    double angles[720];
    for (size_t k = 0; k < self->angles; k++) {
        angles[k] = PI * ((double)k + 0.5) / (double)self->angles;
    }
    const ResultSeries shape = {
        .unit = "",
        .axes = 3,
        .axis = {{.name = "pair", .unit = "", .count = labels.count, .labels = labels.names},
                 {.name = "angle", .unit = "rad", .count = self->angles, .values = angles},
                 {.name = "scaled_distance", .unit = "", .count = self->bins, .values = centres}}};
    return observer_put_series(&self->observer, "contact_directions", &shape, results, replica,
                               values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const ContactStress *self = (const ContactStress *)observer;
    double *values = NULL, *centres = NULL;
    Status status = NEW_ARRAY(values, self->elements * self->bins + count_size(self));
    if (status == OK) status = NEW_ARRAY(centres, self->bins);
    if (status == OK) status = put_stress(self, state, values, centres, results, replica);
    if (status == OK && self->counts) {
        status = put_angles(self, state, values, centres, results, replica);
    }
    memory_free(values);
    memory_free(centres);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const ContactSettings *settings = settings_in(settings_);
    const size_t rows_of_bins =
        ELEMENTS + pair_count(system->species_count) * angles_for(settings, system->dimension);
    return sizeof(ContactStress) + rows_of_bins * bins_for(settings) * sizeof(double) +
           near_pairs_memory(system, settings->last);
}

const ObservableKind observable_contact_stress = {
    .name = "contact_stress",
    .about =
        "Stress of hard discs and spheres from the directions in which they touch: no collision "
        "enters.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(ContactSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
