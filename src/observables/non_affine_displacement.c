// SPDX-License-Identifier: GPL-3.0-or-later
// Mean squared non-affine displacements of each species under shear v_x = rate y, along every axis,
// and their product <dx dy> (Weysser, thesis, eq. 5.64):
//   dx(t) = x(t_w + t) - strain y(t_w + t) - x(t_w),  dy(t) = y(t_w + t) - y(t_w),
// the strain being that since t_w. A free particle has dx^2 = 2 D t + (2/3) D rate^2 t^3 (Taylor
// dispersion: it has come by its last y after the flow had carried it elsewhere), dy^2 = 2 D t and
// dx dy = -D rate t^2. At rest they are the mean squared displacements. They are linear in the
// coordinates: seen from the centre of mass they lack its own non-affine displacement, that of a
// free particle with D0/N.
#include "base/memory.h"
#include "observables/labels.h"
#include "observables/motion.h"
#include "observables/put.h"

typedef struct NonAffineSettings {
    LagSettings lags;
    int64_t frame;
} NonAffineSettings;

static const Option rows[] = {LAG_OPTIONS_OF(NonAffineSettings, lags, 10, 32),
                              WAITING_OPTIONS(NonAffineSettings, lags),
                              FRAME_OPTION(NonAffineSettings, frame)};

static const uint64_t NON_AFFINE_TAG = 0x4e4f4e4146463031; // "NONAFF01"

static int64_t frame_of(const Settings *settings) {
    return ((const NonAffineSettings *)settings->bytes)->frame;
}

static const LagSettings *lag_settings(const Settings *settings) {
    return &((const NonAffineSettings *)settings->bytes)->lags;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)system;
    TRY(frame_check("non_affine_displacement", frame_of(settings), DRIVE_FLOW, clock));
    return lags_check("non_affine_displacement", lag_settings(settings), clock);
}

// The axes, then x times y.
static size_t components(const Motion *self) {
    return (size_t)self->moves.dimension + 1;
}

static double sum_of_products(const double *one, const double *other, size_t begin, size_t end) {
    Lanes sum = {0};
    for (size_t i = begin; i < end; i += LANES)
        sum += *(const Lanes *)(one + i) * *(const Lanes *)(other + i);
    return lanes_sum(&sum);
}

// The lanes that no particle has moved add nothing.
static void add_row(Motion *self, double *sums) {
    const Displacements *moves = &self->moves;
    const double *x = moves->moved, *y = moves->moved + moves->lanes;
    for (size_t s = 0; s < moves->species_count; s++) {
        const size_t begin = moves->begin[s], end = moves->begin[s + 1];
        for (int a = 0; a < moves->dimension; a++) {
            const double *along = moves->moved + (size_t)a * moves->lanes;
            *sums++ += sum_of_products(along, along, begin, end);
        }
        *sums++ += sum_of_products(x, y, begin, end);
    }
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    Motion *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_non_affine_displacement, .clock = *clock};
    self->tag = NON_AFFINE_TAG;
    self->row_size = state->system.species_count * ((size_t)state->box.dimension + 1);
    self->add_row = add_row;
    self->moves.frame = frame_of(settings);
    return motion_begin(out, self, state, &lags);
}

// values[species][component][row]; the last species all of them, if there are several. NaN where
// nothing was seen.
static void fill(const Motion *self, size_t labels, double *values) {
    const size_t species_count = self->moves.species_count, each = components(self);
    const size_t row_count = lags_rows(&self->moves.history.lags);
    for (size_t s = 0; s < labels; s++) {
        const size_t first = s < species_count ? s : 0;
        const size_t last = s < species_count ? s + 1 : species_count;
        for (size_t c = 0; c < each; c++) {
            for (size_t row = 0; row < row_count; row++) {
                double sum = 0;
                for (size_t i = first; i < last; i++)
                    sum += self->sums[(row * species_count + i) * each + c];
                *values++ = sum / displacements_samples(&self->moves, row, first, last);
            }
        }
    }
}

static Status put(const Motion *self, const Labels *species, double *values, double *times,
                  Results *results, size_t replica) {
    static const char *const directions[2][4] = {{"x", "y", "xy"}, {"x", "y", "z", "xy"}};
    fill(self, species->count, values);
    ResultSeries shape = {
        .unit = "d^2",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = species->count, .labels = species->names},
                 {.name = "direction",
                  .unit = "",
                  .count = components(self),
                  .labels = directions[self->moves.dimension - 2]}}};
    shape.axes +=
        lags_axes(&self->moves.history.lags, &self->observer.clock, times, shape.axis + shape.axes);
    const bool centred = self->moves.frame == FRAME_CENTRE_OF_MASS;
    return observer_put_series(
        &self->observer, centred ? "non_affine_displacement_centred" : "non_affine_displacement",
        &shape, results, replica, values);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Motion *self = (const Motion *)observer;
    const Lags *lags = &self->moves.history.lags;
    Labels species;
    labels_of_species(&species, &state->system);
    double *values = NULL, *times = NULL;
    Status status = NEW_ARRAY(values, species.count * components(self) * lags_rows(lags));
    if (status == OK) status = NEW_ARRAY(times, lags_axis_values(lags));
    if (status == OK) status = put(self, &species, values, times, results, replica);
    if (status == OK) status = observer_put_shear_rate(observer, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const Lags lags = lags_chosen(lag_settings(settings), clock);
    return sizeof(Motion) +
           motion_memory(system, &lags, system->species_count * ((size_t)system->dimension + 1));
}

const ObservableKind observable_non_affine_displacement = {
    .name = "non_affine_displacement",
    .about = "Mean squared displacements under shear of each species, less what the flow has done, "
             "along every axis and their product.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(NonAffineSettings)},
    .check = check,
    .create = create,
    .next = motion_next,
    .see = motion_see,
    .archive = motion_archive,
    .write = write,
    .free = motion_free,
    .memory = memory,
};
