// SPDX-License-Identifier: GPL-3.0-or-later
// Self-intermediate scattering functions F_a^s(q,t) = <exp(i q.(r(t) - r(0)))> of each species
// (Weysser, thesis, ch. 3), over its particles and many time origins. A particle's own displacement
// is unfolded, so that q need not be of the reciprocal lattice: every wave number is taken exactly,
// along the axes and the diagonals of the faces of the box. What is summed is 1 - cos, of which
// little is lost where F is near 1.
#include "base/constants.h"
#include "base/memory.h"
#include "observables/labels.h"
#include "observables/motion.h"
#include "observables/put.h"
#include "observables/tracer_frames.h"
#include "observables/versines.h"
#include "observables/wave_vectors.h"

#include <math.h>

typedef struct SelfSettings {
    OptionReals wave_numbers;
    uint64_t directions; // a bit for each of direction_names
    int64_t frame;
    LagSettings lags;
} SelfSettings;

// Along one axis, or along `first` + sign `second`.
typedef struct Direction {
    int first, second;
    double sign; // 0 along one axis
} Direction;

enum { DIRECTIONS_MOST = 9 };
static const char *const direction_names[DIRECTIONS_MOST + 1] = {"x",  "y",   "z",  "xy",  "-xy",
                                                                 "xz", "-xz", "yz", "-yz", NULL};
static const Direction direction_table[DIRECTIONS_MOST] = {{0, 0, 0},  {1, 1, 0},  {2, 2, 0},
                                                           {0, 1, 1},  {0, 1, -1}, {0, 2, 1},
                                                           {0, 2, -1}, {1, 2, 1},  {1, 2, -1}};
static const uint64_t DIRECTIONS_IN_PLANE = 0x1b; // x, y, xy, -xy
static const uint64_t DIRECTIONS_ALL = 0x1ff;

static const Option rows[] = {
    WAVE_NUMBER_OPTION(SelfSettings, wave_numbers),
    {.name = "directions",
     .type = OPTION_CHOICES,
     .offset = offsetof(SelfSettings, directions),
     .unit = "",
     .about = "Directions of the wave vector, beside their mean; empty: all that there are, x, y, "
              "xy and -xy in two dimensions.",
     .choices = direction_names},
    FRAME_OPTION(SelfSettings, frame),
    LAG_OPTIONS_OF(SelfSettings, lags, 10, 32),
    WAITING_OPTIONS(SelfSettings, lags),
};

static const uint64_t SELF_TAG = 0x53454c4653303031; // "SELFS001"

typedef struct SelfScattering {
    Motion motion; // rows are [species][direction][wave number], of 1 - cos
    OptionReals wave_numbers;
    size_t direction_count;
    Direction direction[DIRECTIONS_MOST];
    const char *label[DIRECTIONS_MOST + 1]; // of the directions, and the mean
} SelfScattering;

static const SelfSettings *settings_in(const Settings *settings) {
    return (const SelfSettings *)settings->bytes;
}

static uint64_t directions_there(int64_t dimension) {
    return dimension == 2 ? DIRECTIONS_IN_PLANE : DIRECTIONS_ALL;
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    const SelfSettings *settings = settings_in(settings_);
    TRY(wave_numbers_check("self_scattering", &settings->wave_numbers, system));
    TRY(tracer_check_stays("self_scattering", clock));
    TRY(frame_check("self_scattering", settings->frame, DRIVE_FLOW, clock));
    if (settings->directions & ~directions_there(system->dimension)) {
        return status_fail(BAD_DATA, "self_scattering: there is no direction with z in two "
                                     "dimensions; leave it out");
    }
    return lags_check("self_scattering", &settings->lags, clock);
}

static void choose_directions(SelfScattering *self, uint64_t wanted, int64_t dimension) {
    const uint64_t chosen = wanted ? wanted : directions_there(dimension);
    for (size_t k = 0; k < DIRECTIONS_MOST; k++) {
        if (!(chosen >> k & 1)) continue;
        self->label[self->direction_count] = direction_names[k];
        self->direction[self->direction_count++] = direction_table[k];
    }
    self->label[self->direction_count] = "mean";
}

static const double *project(const SelfScattering *self, const Direction *direction) {
    const size_t lanes = self->motion.moves.lanes;
    const double *first = self->motion.moves.moved + (size_t)direction->first * lanes;
    const double *second = self->motion.moves.moved + (size_t)direction->second * lanes;
    if (direction->sign == 0) return first;
    const double half = sqrt(0.5), share = direction->sign * half;
    for (size_t i = 0; i < lanes; i++)
        self->motion.scratch[i] = half * first[i] + share * second[i];
    return self->motion.scratch;
}

static void add_row(Motion *motion, double *sums) {
    const SelfScattering *self = (const SelfScattering *)motion;
    const Displacements *moves = &motion->moves;
    const size_t wave_numbers = (size_t)self->wave_numbers.count;
    for (size_t d = 0; d < self->direction_count; d++) {
        const double *projected = project(self, &self->direction[d]);
        for (size_t s = 0; s < moves->species_count; s++) {
            const size_t begin = moves->begin[s], count = moves->begin[s + 1] - begin;
            double *sum = sums + (s * self->direction_count + d) * wave_numbers;
            for (size_t q = 0; q < wave_numbers; q++) {
                const double turns = self->wave_numbers.values[q] / (2 * PI);
                sum[q] += versines_sum(projected + begin, count, turns);
            }
        }
    }
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const SelfSettings *settings = settings_in(settings_);
    const Lags lags = lags_chosen(&settings->lags, clock);
    SelfScattering *self = NULL;
    TRY(NEW(self));
    self->wave_numbers = wave_numbers_chosen(&settings->wave_numbers, &state->system);
    choose_directions(self, settings->directions, state->system.dimension);
    self->motion = (Motion){.observer = {.kind = &observable_self_scattering, .clock = *clock},
                            .tag = SELF_TAG,
                            .moves = {.frame = settings->frame},
                            .row_size = state->system.species_count * self->direction_count *
                                        (size_t)self->wave_numbers.count,
                            .add_row = add_row};
    return motion_begin(out, &self->motion, state, &lags);
}

// Of species [first, last) together; NaN where nothing was seen.
static double function_at(const SelfScattering *self, size_t row, size_t first, size_t last,
                          size_t direction, size_t q) {
    const double *sums = self->motion.sums + row * self->motion.row_size;
    const size_t wave_numbers = (size_t)self->wave_numbers.count;
    double lost = 0;
    for (size_t s = first; s < last; s++) {
        lost += sums[(s * self->direction_count + direction) * wave_numbers + q];
    }
    return 1 - lost / displacements_samples(&self->motion.moves, row, first, last);
}

// values[direction][wave number][row] of species [first, last), the last direction the mean.
static void fill_species(const SelfScattering *self, size_t first, size_t last, double *values) {
    const size_t row_count = lags_rows(&self->motion.moves.history.lags);
    const size_t wave_numbers = (size_t)self->wave_numbers.count;
    double *mean = values + self->direction_count * wave_numbers * row_count;
    for (size_t q = 0; q < wave_numbers; q++) {
        for (size_t row = 0; row < row_count; row++) {
            double sum = 0;
            for (size_t d = 0; d < self->direction_count; d++) {
                const double value = function_at(self, row, first, last, d, q);
                values[(d * wave_numbers + q) * row_count + row] = value;
                sum += value;
            }
            mean[q * row_count + row] = sum / (double)self->direction_count;
        }
    }
}

static size_t species_size(const SelfScattering *self) {
    return (self->direction_count + 1) * (size_t)self->wave_numbers.count *
           lags_rows(&self->motion.moves.history.lags);
}

static Status put(const SelfScattering *self, const Labels *species, double *values, double *times,
                  Results *results, size_t replica) {
    const size_t species_count = self->motion.moves.species_count;
    for (size_t s = 0; s < species->count; s++) {
        const bool one = s < species_count;
        fill_species(self, one ? s : 0, one ? s + 1 : species_count,
                     values + s * species_size(self));
    }
    ResultSeries shape = {
        .unit = "",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = species->count, .labels = species->names},
                 {.name = "direction",
                  .unit = "",
                  .count = self->direction_count + 1,
                  .labels = self->label},
                 {.name = "wave_number",
                  .unit = "1/d",
                  .count = (size_t)self->wave_numbers.count,
                  .values = self->wave_numbers.values}}};
    shape.axes += lags_axes(&self->motion.moves.history.lags, &self->motion.observer.clock, times,
                            shape.axis + shape.axes);
    const bool centred = self->motion.moves.frame == FRAME_CENTRE_OF_MASS;
    return observer_put_series(&self->motion.observer,
                               centred ? "self_scattering_centred" : "self_scattering", &shape,
                               results, replica, values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const SelfScattering *self = (const SelfScattering *)observer;
    Labels species;
    labels_of_species(&species, &state->system);
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, species.count * species_size(self));
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(&self->motion.moves.history.lags));
    if (status == OK) status = put(self, &species, values, times, results, replica);
    if (status == OK) status = observer_put_shear_rate(observer, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    const SelfSettings *settings = settings_in(settings_);
    const Lags lags = lags_chosen(&settings->lags, clock);
    const OptionReals wave_numbers = wave_numbers_chosen(&settings->wave_numbers, system);
    const size_t directions = system->dimension == 2 ? 4 : DIRECTIONS_MOST;
    return sizeof(SelfScattering) +
           motion_memory(system, &lags,
                         system->species_count * directions * (size_t)wave_numbers.count);
}

const ObservableKind observable_self_scattering = {
    .name = "self_scattering",
    .about = "Self-intermediate scattering functions of each species at logarithmic lags: how "
             "fast a particle leaves where it was, at each wave number.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(SelfSettings)},
    .check = check,
    .create = create,
    .next = motion_next,
    .see = motion_see,
    .archive = motion_archive,
    .write = write,
    .free = motion_free,
    .memory = memory,
};
