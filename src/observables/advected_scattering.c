// SPDX-License-Identifier: GPL-3.0-or-later
// Collective intermediate scattering functions under shear,
//   F_ab(q,t) = <rho_a*(q,t_w) rho_b(q(t),t_w + t)>/N,  q(t) = (q_x, q_y - strain q_x),
// with the wave vector that goes with the flow (Weysser, thesis, ch. 5): otherwise nothing that the
// flow has moved would be remembered. Along x, y and the diagonals of the plane of flow and
// gradient, within an angle; from waiting strains each by itself, or over many time origins. F_ab
// and F_ba, which under shear differ, are averaged. The first lag is 0, where F_ab is the structure
// factor S_ab(q) in that direction.
#include "base/memory.h"
#include "observables/advected_waves.h"
#include "observables/begin.h"
#include "observables/history.h"
#include "observables/labels.h"
#include "observables/put.h"
#include "observables/wave_sum.h"

#include <math.h>
#include <string.h>

typedef struct AdvectedSettings {
    OptionReals wave_numbers;
    double width, angle;
    int64_t vectors;
    LagSettings lags;
} AdvectedSettings;

static const Option rows[] = {
    WAVE_NUMBER_OPTION(AdvectedSettings, wave_numbers),
    {.name = "cell.width",
     .type = OPTION_REAL,
     .offset = offsetof(AdvectedSettings, width),
     .fallback = 0.4,
     .least = 0.001,
     .most = 100,
     .unit = "1/d",
     .about = "Wave vectors are taken within half of it from each wave number."},
    {.name = "cell.angle",
     .type = OPTION_REAL,
     .offset = offsetof(AdvectedSettings, angle),
     .fallback = 10,
     .least = 0.1,
     .most = 22.5,
     .unit = "degrees",
     .about = "And within this angle of each direction."},
    {.name = "cell.vectors",
     .type = OPTION_INTEGER,
     .offset = offsetof(AdvectedSettings, vectors),
     .fallback = 12,
     .least = 1,
     .most = 1000,
     .unit = "",
     .about = "At most so many of them, q and -q counted once."},
    LAG_OPTIONS_OF(AdvectedSettings, lags, 10, 16),
    WAITING_OPTIONS(AdvectedSettings, lags),
};

// What is kept of a time origin, all numbers, one after the other.
typedef struct Frame {
    AdvectedVector *vectors; // [cell][most]
    double *members;         // [cell]
    double *turns;           // that the box had made
    double *modes;           // [species][cell][most][real, imaginary]
} Frame;

typedef struct Advected {
    Observer observer;
    AdvectedCells cells;
    OptionReals wave_numbers;
    size_t species_count, lanes, population[SPECIES_MOST], begin[SPECIES_MOST + 1];
    double *x, *y;   // [lanes], fractions along the edges of the box
    History history; // of frames
    double *frame;   // one being made
    double *modes;   // [species][cell][most][real, imaginary], of now, for the vectors of an origin
    double *products; // [waiting time, or one][time][pair][cell], the first time being 0
    double *members;  // [waiting time, or one][time][cell]: vectors seen
} Advected;

static const AdvectedSettings *settings_in(const Settings *settings) {
    return (const AdvectedSettings *)settings->bytes;
}

static AdvectedCells cells_of(const AdvectedSettings *settings, const System *system) {
    const OptionReals q = wave_numbers_chosen(&settings->wave_numbers, system);
    AdvectedCells cells = {.wave_numbers = (size_t)q.count,
                           .cosine = cos(settings->angle * TURN_PI / 180),
                           .most = (size_t)settings->vectors};
    for (int64_t k = 0; k < q.count; k++) {
        cells.low[k] = q.values[k] - settings->width / 2;
        cells.high[k] = q.values[k] + settings->width / 2;
    }
    return cells;
}

static Status check(const Settings *settings_, const System *system, const Clock *clock) {
    const AdvectedSettings *settings = settings_in(settings_);
    const Box box = system_box(system);
    const AdvectedCells cells = cells_of(settings, system);
    TRY(wave_numbers_check("advected_scattering", &settings->wave_numbers, system));
    for (size_t k = 0; k < cells.wave_numbers; k++) {
        if (k > 0 && cells.low[k] < cells.high[k - 1]) {
            return status_fail(BAD_DATA,
                               "advected_scattering: the cells around two wave numbers overlap; "
                               "make cell.width = %g smaller",
                               settings->width);
        }
        if (advected_vectors_mean(&cells, &box, k) >= 1) continue;
        return status_fail(BAD_DATA,
                           "advected_scattering: a cell around the wave number %g has fewer than "
                           "one wave vector of the box on average; make cell.width or cell.angle "
                           "larger",
                           (cells.low[k] + cells.high[k]) / 2);
    }
    TRY(wave_vectors_check("advected_scattering", "a wave number", &box,
                           cells.high[cells.wave_numbers - 1]));
    return lags_check("advected_scattering", &settings->lags, clock);
}

static size_t slots(const AdvectedCells *cells) {
    return advected_cells(cells) * cells->most;
}

static size_t modes_size(const AdvectedCells *cells, size_t species) {
    return 2 * species * slots(cells);
}

static size_t frame_size(const AdvectedCells *cells, size_t species) {
    return 2 * slots(cells) + advected_cells(cells) + 1 + modes_size(cells, species);
}

static Frame frame_in(const Advected *self, double *numbers) {
    double *members = numbers + 2 * slots(&self->cells);
    double *turns = members + advected_cells(&self->cells);
    return (Frame){(AdvectedVector *)numbers, members, turns, turns + 1};
}

static size_t groups_of(const Lags *lags) {
    return lags->waits > 0 ? lags->waits : 1;
}

static size_t times_of(const Lags *lags) {
    return groups_of(lags) * (lags->count + 1);
}

static size_t row_size(const Advected *self) {
    return pair_count(self->species_count) * advected_cells(&self->cells);
}

// The particles of each species from a multiple of LANES on.
static void lay_out(Advected *self, const System *system) {
    system_counts(system, self->population);
    for (size_t s = 0; s < self->species_count; s++) {
        const size_t lanes = (self->population[s] + LANES - 1) / LANES * LANES;
        self->begin[s + 1] = self->begin[s] + lanes;
    }
    self->lanes = self->begin[self->species_count];
}

static Status allocate(Advected *self, const Lags *lags) {
    TRY(history_make(&self->history, lags, frame_size(&self->cells, self->species_count)));
    TRY(NEW_ARRAY(self->x, self->lanes));
    TRY(NEW_ARRAY(self->y, self->lanes));
    TRY(NEW_ARRAY(self->frame, self->history.width));
    TRY(NEW_ARRAY(self->modes, modes_size(&self->cells, self->species_count)));
    TRY(NEW_ARRAY(self->products, times_of(lags) * row_size(self)));
    return NEW_ARRAY(self->members, times_of(lags) * advected_cells(&self->cells));
}

static void discard(Observer *observer) {
    Advected *self = (Advected *)observer;
    history_clear(&self->history);
    memory_free(self->x);
    memory_free(self->y);
    memory_free(self->frame);
    memory_free(self->modes);
    memory_free(self->products);
    memory_free(self->members);
    memory_free(self);
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const AdvectedSettings *settings = settings_in(settings_);
    const Lags lags = lags_chosen(&settings->lags, clock);
    Advected *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_advected_scattering, .clock = *clock};
    self->cells = cells_of(settings, &state->system);
    self->wave_numbers = wave_numbers_chosen(&settings->wave_numbers, &state->system);
    self->species_count = state->system.species_count;
    lay_out(self, &state->system);
    return observer_begin(out, &self->observer, allocate(self, &lags));
}

static int64_t next(const Observer *observer, int64_t after) {
    return lags_next(&((const Advected *)observer)->history.lags, &observer->clock, after);
}

static void take_places(Advected *self, const State *state) {
    size_t particle = 0;
    for (size_t s = 0; s < self->species_count; s++) {
        for (size_t i = self->begin[s]; i < self->begin[s] + self->population[s]; i++, particle++) {
            const double position[3] = {state->position[0][particle], state->position[1][particle],
                                        0};
            double fraction[3];
            box_fractions(&state->box, position, fraction);
            self->x[i] = fraction[0];
            self->y[i] = fraction[1];
        }
    }
}

// Of one species and vector, without the lanes that are left over, which lie at the origin.
static WaveSum mode_of(const Advected *self, size_t species, const AdvectedVector *vector) {
    const size_t begin = self->begin[species], count = self->begin[species + 1] - begin;
    WaveSum sum = wave_sum(self->x + begin, self->y + begin, count, vector->n[0], vector->n[1]);
    sum.real -= (double)(count - self->population[species]);
    return sum;
}

// modes[species][cell][most][2] of now, for the vectors of a frame.
static void find_modes(const Advected *self, const Frame *frame, const Box *box, double *modes) {
    const size_t cells = advected_cells(&self->cells), most = self->cells.most;
    for (size_t s = 0; s < self->species_count; s++) {
        for (size_t cell = 0; cell < cells; cell++) {
            for (size_t v = 0; v < (size_t)frame->members[cell]; v++) {
                const AdvectedVector vector =
                    advected_vector_now(&frame->vectors[cell * most + v], *frame->turns, box);
                const WaveSum sum = mode_of(self, s, &vector);
                double *mode = modes + 2 * ((s * cells + cell) * most + v);
                mode[0] = sum.real;
                mode[1] = sum.imaginary;
            }
        }
    }
}

// The sum over the vectors of a cell of Re rho_a* rho_b, rho_a of `one` and rho_b of `other`.
static double product(const Advected *self, const double *one, const double *other, size_t a,
                      size_t b, size_t cell, size_t members) {
    const size_t cells = advected_cells(&self->cells), most = self->cells.most;
    const double *first = one + 2 * (a * cells + cell) * most;
    const double *second = other + 2 * (b * cells + cell) * most;
    double sum = 0;
    for (size_t i = 0; i < 2 * members; i++) sum += first[i] * second[i];
    return sum;
}

static void add_products(Advected *self, const Frame *then, const double *now, size_t time) {
    const size_t cells = advected_cells(&self->cells);
    double *sums = self->products + time * row_size(self);
    for (size_t a = 0; a < self->species_count; a++) {
        for (size_t b = a; b < self->species_count; b++) {
            for (size_t cell = 0; cell < cells; cell++) {
                const size_t members = (size_t)then->members[cell];
                *sums++ += 0.5 * product(self, then->modes, now, a, b, cell, members) +
                           0.5 * product(self, then->modes, now, b, a, cell, members);
            }
        }
    }
    for (size_t cell = 0; cell < cells; cell++)
        self->members[time * cells + cell] += then->members[cell];
}

// A time origin: its vectors, its modes, and their products at t = 0.
static void begin(Advected *self, int64_t tick, const Box *box) {
    const Lags *lags = &self->history.lags;
    const int64_t slot = lags_slot(lags, tick);
    if (slot == LAGS_NO_ORIGIN) return;
    const Frame frame = frame_in(self, self->frame);
    memset(self->frame, 0, self->history.width * sizeof *self->frame);
    advected_waves_choose(&self->cells, box, frame.vectors, frame.members);
    *frame.turns = (double)box->turns;
    find_modes(self, &frame, box, frame.modes);
    add_products(self, &frame, frame.modes,
                 (lags->waits > 0 ? (size_t)slot : 0) * (lags->count + 1));
    history_keep(&self->history, tick, self->frame);
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    Advected *self = (Advected *)observer;
    const Lags *lags = &self->history.lags;
    take_places(self, state);
    for (size_t k = 0; k < lags->count; k++) {
        size_t row = 0;
        const double *numbers = history_begun(&self->history, tick, k, &row);
        if (!numbers) continue;
        memcpy(self->frame, numbers, self->history.width * sizeof *numbers);
        const Frame then = frame_in(self, self->frame);
        find_modes(self, &then, &state->box, self->modes);
        add_products(self, &then, self->modes, row / lags->count * (lags->count + 1) + k + 1);
    }
    begin(self, tick, &state->box);
    return OK;
}

static const uint64_t ADVECTED_TAG = 0x4144564543543031; // "ADVECT01"

static void archive(Observer *observer, Archive *archive) {
    Advected *self = (Advected *)observer;
    const size_t times = times_of(&self->history.lags), cells = advected_cells(&self->cells);
    archive_tag(archive, ADVECTED_TAG);
    history_archive(&self->history, archive);
    archive_f64(archive, self->products, times * row_size(self));
    archive_f64(archive, self->members, times * cells);
}

// value[pair * stride] of one cell and time; the last pair the total. NaN where nothing was seen.
static void fill_pairs(const Advected *self, size_t time, size_t cell, double particles,
                       size_t stride, double *value) {
    const size_t cells = advected_cells(&self->cells);
    const double *sums = self->products + time * row_size(self) + cell;
    const double samples = self->members[time * cells + cell] * particles;
    double total = 0;
    size_t pair = 0;
    for (size_t a = 0; a < self->species_count; a++) {
        for (size_t b = a; b < self->species_count; b++, pair++) {
            const double partial = sums[pair * cells] / samples;
            value[pair * stride] = partial;
            total += a == b ? partial : 2 * partial;
        }
    }
    value[pair * stride] = total;
}

// values[pair][direction][wave number][waiting time][time].
static void fill(const Advected *self, double particles, double *values) {
    const size_t cells = advected_cells(&self->cells), times = times_of(&self->history.lags);
    for (size_t cell = 0; cell < cells; cell++) {
        for (size_t time = 0; time < times; time++)
            fill_pairs(self, time, cell, particles, cells * times, values + cell * times + time);
    }
}

// The axes of lags.h, with a time of 0 in front of the lags; `times` has room for one more.
static size_t time_axes(const Advected *self, double *times, ResultAxis *axes) {
    const Lags *lags = &self->history.lags;
    const size_t count = lags_axes(lags, &self->observer.clock, times, axes);
    double *first = times + lags->waits;
    memmove(first + 1, first, lags->count * sizeof *first);
    *first = 0;
    axes[count - 1].count++;
    return count;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Advected *self = (const Advected *)observer;
    const Lags *lags = &self->history.lags;
    Labels pairs;
    labels_of_pairs(&pairs, &state->system, "total");
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, pairs.count * advected_cells(&self->cells) * times_of(lags));
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags) + 1);
    ResultSeries shape = {
        .unit = "",
        .axes = 3,
        .axis = {{.name = "pair", .unit = "", .count = pairs.count, .labels = pairs.names},
                 {.name = "direction", .unit = "", .count = PLANE_CUTS, .labels = plane_cut_names},
                 {.name = "wave_number",
                  .unit = "1/d",
                  .count = self->cells.wave_numbers,
                  .values = self->wave_numbers.values}}};
    if (status == OK) {
        shape.axes += time_axes(self, times, shape.axis + shape.axes);
        fill(self, (double)state->count, values);
        status =
            observer_put_series(observer, "advected_scattering", &shape, results, replica, values);
    }
    if (status == OK) status = observer_put_shear_rate(observer, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings_, const System *system, const Clock *clock) {
    const AdvectedSettings *settings = settings_in(settings_);
    const Lags lags = lags_chosen(&settings->lags, clock);
    const AdvectedCells cells = cells_of(settings, system);
    const size_t species = system->species_count, frame = frame_size(&cells, species);
    const size_t places = 2 * ((size_t)system->particles + species * LANES);
    const size_t sums = times_of(&lags) * advected_cells(&cells) * (pair_count(species) + 1);
    return sizeof(Advected) + history_memory(&lags, frame) +
           (frame + modes_size(&cells, species) + places + sums) * sizeof(double);
}

const ObservableKind observable_advected_scattering = {
    .name = "advected_scattering",
    .about = "Partial collective intermediate scattering functions under shear, along directions "
             "and with wave vectors that go with the flow.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(AdvectedSettings)},
    .check = check,
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
