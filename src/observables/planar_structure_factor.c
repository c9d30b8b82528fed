// SPDX-License-Identifier: GPL-3.0-or-later
// Static structure factors S_ab(q) = <rho_a*(q) rho_b(q)>/N on the plane (q_x, q_y), the plane of
// flow and gradient under shear, as a picture, and cuts through it along x, y and the diagonals
// (Weysser, thesis, ch. 5). All vectors of the reciprocal lattice of the box are taken; under shear
// the lattice tilts with the strain, and every look puts its vectors where they are by then. Since
// S(-q) = S(q), a pixel and its mirror image share what they have.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/labels.h"
#include "observables/looks.h"
#include "observables/plane_waves.h"
#include "observables/put.h"

#include <math.h>

typedef struct PlanarSettings {
    double last, spacing, cut_spacing, cut_angle;
    int64_t looks;
} PlanarSettings;

static const Option rows[] = {
    {.name = "wave_numbers.last",
     .type = OPTION_REAL,
     .offset = offsetof(PlanarSettings, last),
     .fallback = 15,
     .least = 0.01,
     .most = 1000,
     .unit = "1/d",
     .about = "Largest |q_x| and |q_y| of the picture, largest |q| of the cuts."},
    {.name = "wave_numbers.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(PlanarSettings, spacing),
     .least = 0,
     .most = 100,
     .unit = "1/d",
     .about = "Edge of a pixel of the picture; 0 is three times 2 pi over the shortest edge of the "
              "box, so that a pixel has nine wave vectors or more."},
    {.name = "cuts.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(PlanarSettings, cut_spacing),
     .fallback = 0.2,
     .least = 0.001,
     .most = 100,
     .unit = "1/d",
     .about = "Width of a bin of |q| along a cut."},
    {.name = "cuts.angle",
     .type = OPTION_REAL,
     .offset = offsetof(PlanarSettings, cut_angle),
     .fallback = 10,
     .least = 0.1,
     .most = 22.5,
     .unit = "degrees",
     .about = "A cut takes the wave vectors within this angle of its direction."},
    LOOKS_OPTION(PlanarSettings, looks, 200),
};

// Products of modes summed in bins: the pixels of the picture, or the bins of all cuts.
typedef struct Binned {
    WaveVectors vectors; // its shells are the bins, a last one for what lies outside
    double *members;     // [shells], vectors times looks
    double *products;    // [pair][shells], sums of Re rho_a* rho_b over them
} Binned;

typedef struct Planar {
    Observer observer;
    size_t pairs;
    uint64_t looks;
    PlaneWaves waves;
    Binned picture, cuts;
    WaveModes modes;
    double *now; // the modes
} Planar;

static const PlanarSettings *settings_in(const Settings *settings) {
    return (const PlanarSettings *)settings->bytes;
}

static PlaneShape shape_of(const PlanarSettings *settings, const Box *box) {
    return plane_shape(box, settings->last, settings->spacing, settings->cut_spacing,
                       settings->cut_angle);
}

static void clear_binned(Binned *binned) {
    memory_free(binned->vectors.shell);
    memory_free(binned->members);
    memory_free(binned->products);
}

static void discard(Observer *observer) {
    Planar *self = (Planar *)observer;
    wave_modes_clear(&self->modes);
    clear_binned(&self->picture);
    clear_binned(&self->cuts);
    plane_waves_clear(&self->waves);
    memory_free(self->now);
    memory_free(self);
}

static Status make_binned(Binned *binned, const PlaneWaves *waves, size_t bins, size_t pairs) {
    binned->vectors =
        (WaveVectors){.shells = bins + 1, .count = waves->count, .vector = waves->vector};
    TRY(NEW_ARRAY(binned->vectors.shell, waves->count));
    TRY(NEW_ARRAY(binned->members, bins + 1));
    return NEW_ARRAY(binned->products, pairs * (bins + 1));
}

static Status allocate(Planar *self, const PlanarSettings *settings, const State *state) {
    const PlaneShape shape = shape_of(settings, &state->box);
    TRY(plane_waves_make(&self->waves, &state->box, &shape));
    TRY(make_binned(&self->picture, &self->waves, plane_pixels(&shape), self->pairs));
    TRY(make_binned(&self->cuts, &self->waves, PLANE_CUTS * shape.cut_bins, self->pairs));
    TRY(wave_modes_make(&self->modes, &self->picture.vectors, state));
    return NEW_ARRAY(self->now, self->modes.width);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    Planar *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_planar_structure_factor, .clock = *clock};
    self->observer.period = looks_period(clock, settings_in(settings)->looks);
    self->pairs = pair_count(state->system.species_count);
    return observer_begin(out, &self->observer, allocate(self, settings_in(settings), state));
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const PlanarSettings *settings = settings_in(settings_);
    const Box box = system_box(system);
    const double least = plane_spacing_least(&box);
    if (settings->spacing > 0 && settings->spacing < least) {
        return status_fail(BAD_DATA,
                           "planar_structure_factor: wave_numbers.spacing = %g is below 2 pi/L = "
                           "%g of the shortest edge, and some pixels would never have a wave "
                           "vector; make it larger",
                           settings->spacing, least);
    }
    const PlaneShape shape = shape_of(settings, &box);
    if (settings->last < shape.spacing) {
        return status_fail(BAD_DATA,
                           "planar_structure_factor: wave_numbers.last = %g is less than a pixel "
                           "of %g; make it larger",
                           settings->last, shape.spacing);
    }
    return wave_vectors_check("planar_structure_factor", "wave_numbers.last", &box, settings->last);
}

static void add(Binned *binned, const WaveModes *modes, const double *now) {
    for (size_t v = 0; v < binned->vectors.count; v++) {
        binned->members[binned->vectors.shell[v]]++;
    }
    wave_modes_add_products(modes, &binned->vectors, now, now, binned->products);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    Planar *self = (Planar *)observer;
    plane_waves_place(&self->waves, &state->box, self->picture.vectors.shell,
                      self->cuts.vectors.shell);
    wave_modes_find(&self->modes, state, self->now);
    add(&self->picture, &self->modes, self->now);
    add(&self->cuts, &self->modes, self->now);
    self->looks++;
    return OK;
}

static const uint64_t PLANAR_TAG = 0x504c414e41523031; // "PLANAR01"

static void archive_binned(Binned *binned, size_t pairs, Archive *archive) {
    archive_f64(archive, binned->members, binned->vectors.shells);
    archive_f64(archive, binned->products, pairs * binned->vectors.shells);
}

static void archive(Observer *observer, Archive *archive) {
    Planar *self = (Planar *)observer;
    archive_tag(archive, PLANAR_TAG);
    archive_u64(archive, &self->looks, 1);
    archive_binned(&self->picture, self->pairs, archive);
    archive_binned(&self->cuts, self->pairs, archive);
}

// S of bins `one` and `other` together: values[pair], the last the total; NaN without vectors.
static void structure_of(const Planar *self, const Binned *binned, size_t one, size_t other,
                         size_t particles, double *values) {
    const size_t species = self->modes.species_count;
    const double samples = (binned->members[one] + binned->members[other]) * (double)particles;
    double total = 0;
    size_t pair = 0;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = a; b < species; b++, pair++) {
            const double *sums = binned->products + pair * binned->vectors.shells;
            values[pair] = samples > 0 ? (sums[one] + sums[other]) / samples : NAN;
            total += a == b ? values[pair] : 2 * values[pair]; // S_ab and S_ba
        }
    }
    values[pair] = total;
}

static Status put_picture(const Planar *self, const Labels *pairs, size_t particles, double *values,
                          Results *results, size_t replica) {
    const PlaneShape *shape = &self->waves.shape;
    const size_t pixels = plane_pixels(shape);
    for (size_t pixel = 0; pixel < pixels; pixel++) {
        double of_pairs[PAIRS_MOST + 1];
        structure_of(self, &self->picture, pixel, pixels - 1 - pixel, particles, of_pairs);
        for (size_t p = 0; p < pairs->count; p++) values[p * pixels + pixel] = of_pairs[p];
    }
    double *along = values + pairs->count * pixels;
    for (size_t k = 0; k < shape->side; k++) along[k] = plane_pixel_centre(shape, k);
    const ResultSeries series = {
        .unit = "",
        .axes = 3,
        .axis = {{.name = "pair", .unit = "", .count = pairs->count, .labels = pairs->names},
                 {.name = "wave_number_x", .unit = "1/d", .count = shape->side, .values = along},
                 {.name = "wave_number_y", .unit = "1/d", .count = shape->side, .values = along}}};
    return observer_put_series(&self->observer, "planar_structure_factor", &series, results,
                               replica, values);
}

static Status put_cuts(const Planar *self, const Labels *pairs, size_t particles, double *values,
                       Results *results, size_t replica) {
    const PlaneShape *shape = &self->waves.shape;
    const size_t bins = PLANE_CUTS * shape->cut_bins;
    for (size_t bin = 0; bin < bins; bin++) {
        double of_pairs[PAIRS_MOST + 1];
        structure_of(self, &self->cuts, bin, bin, particles, of_pairs);
        for (size_t p = 0; p < pairs->count; p++) values[p * bins + bin] = of_pairs[p];
    }
    double *along = values + pairs->count * bins;
    for (size_t k = 0; k < shape->cut_bins; k++) along[k] = ((double)k + 0.5) * shape->cut_spacing;
    const ResultSeries series = {
        .unit = "",
        .axes = 3,
        .axis = {
            {.name = "pair", .unit = "", .count = pairs->count, .labels = pairs->names},
            {.name = "direction", .unit = "", .count = PLANE_CUTS, .labels = plane_cut_names},
            {.name = "wave_number", .unit = "1/d", .count = shape->cut_bins, .values = along}}};
    return observer_put_series(&self->observer, "structure_factor_cuts", &series, results, replica,
                               values);
}

// Room for the larger of the two series and its axis.
static size_t room(const PlaneShape *shape, size_t labels) {
    const size_t pixels = plane_pixels(shape), bins = PLANE_CUTS * shape->cut_bins;
    return (labels + 1) * (pixels > bins ? pixels : bins);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Planar *self = (const Planar *)observer;
    Labels pairs;
    labels_of_pairs(&pairs, &state->system, "total");
    double *values = NULL;
    TRY(NEW_ARRAY(values, room(&self->waves.shape, pairs.count)));
    Status status = put_picture(self, &pairs, state->count, values, results, replica);
    if (status == OK) status = put_cuts(self, &pairs, state->count, values, results, replica);
    memory_free(values);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    (void)clock;
    const PlanarSettings *settings = settings_in(settings_);
    const Box box = system_box(system);
    const PlaneShape shape = shape_of(settings, &box);
    const size_t bins = plane_pixels(&shape) + PLANE_CUTS * shape.cut_bins + 2;
    const size_t species = system->species_count, vectors = plane_waves_count(&box, &shape);
    return sizeof(Planar) + plane_waves_memory(&box, &shape) + 2 * vectors * sizeof(uint32_t) +
           (2 * species * vectors + bins * (pair_count(species) + 1)) * sizeof(double);
}

const ObservableKind observable_planar_structure_factor = {
    .name = "planar_structure_factor",
    .about = "Structure factors as a picture on the plane of q_x and q_y, and cuts through it: how "
             "shear distorts the structure.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(PlanarSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
