// SPDX-License-Identifier: GPL-3.0-or-later
// The equation of motion tau dPhi/dt + Phi/S + int M(t - t') dPhi(t') = 0 on a doubling grid, with
// tau_ab = delta_ab/(q^2 D_a x_a): derivatives from three points, the memory integral of history.h,
// and at every time a fixed point in M. The first half block is a Taylor expansion.
#include "mct/correlators.h"

#include "base/memory.h"
#include "mct/history.h"
#include "mct/lines.h"
#include "mct/model.h"
#include "mct/stretch.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 128, ITERATIONS_MOST = 5000 };
static const double CONVERGED = 1e-10; // change of Phi/S in an iteration
static const double TAYLOR_END = 1e-3; // q^2 D t at the end of the expansion, for the largest q
static const double MASTER_END = 1e-6; // time at the end of form - amplitude t^b

struct Correlators {
    const Grid *grid;
    Model *model;
    CorrelatorSettings settings;
    bool master;
    double step;
    size_t block, now; // index of the present time in the block
    size_t evaluations;
    size_t species, stride;
    History collective;
    double *tau;             // [species][stride]: 1/(q^2 D x)
    double *inverse;         // [a][b][stride]: (3 tau/(2 h) + 1/S + M_mean)^-1
    double *jump;            // [pair][stride]: Phi(0) - Phi_mean, what multiplies the newest M
    double *rest;            // [a][b][stride]: all that is known of the right-hand side
    double *right;           // [a][b][stride]
    double *image, *residue; // [pair][stride]: of the iteration before
    Radial radial;
    History self;                     // [species][stride]
    double *self_inverse, *self_rest; // [species][stride]
    History displacement;             // [species], one line
    Stretch *stretch;                 // NULL at rest
};

static double *line(const Correlators *c, double *field, size_t index) {
    return field + index * c->stride;
}

static size_t pair_of(const Correlators *c, size_t a, size_t b) {
    return mixture_pair(c->species, a, b);
}

static Status allocate(Correlators *c) {
    const size_t full = c->species * c->species * c->stride, own = c->species * c->stride;
    TRY(history_create(&c->collective, c->block, c->model->size, c->model->size, c->stride));
    TRY(NEW_ARRAY(c->tau, own));
    TRY(NEW_ARRAY(c->inverse, full));
    TRY(NEW_ARRAY(c->jump, c->model->size));
    TRY(NEW_ARRAY(c->rest, full));
    TRY(NEW_ARRAY(c->right, full));
    TRY(NEW_ARRAY(c->image, c->model->size));
    TRY(NEW_ARRAY(c->residue, c->model->size));
    TRY(radial_create(&c->radial, c->model));
    if (!c->settings.tagged) return OK;
    const size_t few = lines_stride(c->species);
    TRY(history_create(&c->self, c->block, own, own, c->stride));
    TRY(NEW_ARRAY(c->self_inverse, own));
    TRY(NEW_ARRAY(c->self_rest, own));
    return history_create(&c->displacement, c->block, few, few, few);
}

// ---- The collective part -----------------------------------------------------------------------

// tau^-1 (1/S + M(0)) tau^-1, the curvature at t = 0; the slope is -tau^-1.
static void taylor_curvature(const Correlators *c, const double *memory, size_t m,
                             SmallMatrix curvature) {
    SmallMatrix kernel;
    model_matrix(c->model, c->model->inverse, m, curvature);
    model_matrix(c->model, memory, m, kernel);
    for (size_t a = 0; a < c->species; a++) {
        for (size_t b = 0; b < c->species; b++)
            curvature[a][b] = (curvature[a][b] + kernel[a][b]) /
                              (c->tau[a * c->stride + m] * c->tau[b * c->stride + m]);
    }
}

static void begin_collective(Correlators *c) {
    History *history = &c->collective;
    double *first = history_f(history, 0), *kernel = history_m(history, 0);
    memcpy(first, c->model->factor, c->model->size * sizeof *first);
    model_memory(c->model, first, kernel);
    for (size_t i = 1; i <= c->block / 2; i++) {
        const double t = (double)i * c->step;
        for (size_t m = 0; m < c->grid->count; m++) {
            SmallMatrix phi, curvature;
            model_matrix(c->model, first, m, phi);
            taylor_curvature(c, kernel, m, curvature);
            for (size_t a = 0; a < c->species; a++) {
                phi[a][a] -= t / c->tau[a * c->stride + m];
                for (size_t b = 0; b < c->species; b++) phi[a][b] += t * t / 2 * curvature[a][b];
            }
            model_put(c->model, history_f(history, i), m, phi);
        }
        model_memory(c->model, history_f(history, i), history_m(history, i));
        history_average(history, i);
    }
}

// form - amplitude t^b, its averages exact.
static void begin_master(Correlators *c, const double *form, const double *amplitude, double b) {
    History *history = &c->collective;
    for (size_t i = 0; i <= c->block / 2; i++) {
        const double end = (double)i * c->step, start = end - c->step;
        const double mean =
            i == 0 ? 0 : (pow(end, b + 1) - pow(start, b + 1)) / ((b + 1) * c->step);
        for (size_t pair = 0; pair < c->model->pairs; pair++) {
            double *phi = line(c, history_f(history, i), pair);
            for (size_t m = 0; m < c->grid->count; m++) {
                const size_t at = pair * c->grid->count + m;
                phi[m] = form[at] - amplitude[at] * pow(end, b);
            }
        }
        model_memory(c->model, history_f(history, i), history_m(history, i));
        if (i == 0) continue;
        history_average(history, i);
        for (size_t pair = 0; pair < c->model->pairs; pair++) {
            double *phi = line(c, history->f_mean + i * history->f_size, pair);
            for (size_t m = 0; m < c->grid->count; m++) {
                const size_t at = pair * c->grid->count + m;
                phi[m] = form[at] - amplitude[at] * mean;
            }
        }
    }
}

// What stays the same through a block: the matrix of the newest Phi, and what multiplies the newest
// M: Phi(0) - Phi_mean, where Phi(0) = S also for the master curve, which has jumped from there.
static Status prepare_collective(Correlators *c) {
    const double *mean = c->collective.m_mean + c->model->size;
    for (size_t i = 0; i < c->model->size; i++)
        c->jump[i] = c->model->factor[i] - c->collective.f_mean[c->model->size + i];
    for (size_t m = 0; m < c->grid->count; m++) {
        SmallMatrix matrix, kernel, inverse;
        model_matrix(c->model, c->model->inverse, m, matrix);
        model_matrix(c->model, mean, m, kernel);
        for (size_t a = 0; a < c->species; a++) {
            for (size_t b = 0; b < c->species; b++) matrix[a][b] += kernel[a][b];
            if (!c->master) matrix[a][a] += 1.5 / c->step * c->tau[a * c->stride + m];
        }
        if (!small_invert(c->species, matrix, inverse))
            return status_fail(UNHEALTHY, "correlators: no inverse at q = %g",
                               c->grid->wave_number[m]);
        for (size_t i = 0; i < c->species * c->species; i++)
            line(c, c->inverse, i)[m] = inverse[i / c->species][i % c->species];
    }
    return OK;
}

static void subtract_history(Correlators *c, size_t a, size_t b, double *rest) {
    for (size_t e = 0; e < c->species; e++)
        history_known(&c->collective, c->now, pair_of(c, a, e), pair_of(c, e, b), rest);
    for (size_t m = 0; m < c->stride; m++) rest[m] = -rest[m];
}

static void fill_rest(Correlators *c) {
    memset(c->rest, 0, c->species * c->species * c->stride * sizeof *c->rest);
    for (size_t a = 0; a < c->species; a++) {
        for (size_t b = 0; b < c->species; b++) {
            double *rest = line(c, c->rest, a * c->species + b);
            subtract_history(c, a, b, rest);
            if (c->master) continue;
            const double *before = line(c, history_f(&c->collective, c->now - 1), pair_of(c, a, b));
            const double *earlier =
                line(c, history_f(&c->collective, c->now - 2), pair_of(c, a, b));
            const double *tau = line(c, c->tau, a);
            for (size_t m = 0; m < c->stride; m++)
                rest[m] += tau[m] / (2 * c->step) * (4 * before[m] - earlier[m]);
        }
    }
}

static void add_product(double *sum, const double *left, const double *right, size_t count) {
    for (size_t m = 0; m < count; m++) sum[m] += left[m] * right[m];
}

// rest + M jump for all ordered pairs.
static void fill_right(Correlators *c, double *memory) {
    memcpy(c->right, c->rest, c->species * c->species * c->stride * sizeof *c->right);
    for (size_t a = 0; a < c->species; a++) {
        for (size_t b = 0; b < c->species; b++) {
            for (size_t e = 0; e < c->species; e++)
                add_product(line(c, c->right, a * c->species + b),
                            line(c, memory, pair_of(c, a, e)), line(c, c->jump, pair_of(c, e, b)),
                            c->stride);
        }
    }
}

// The newest Phi_ab, the mean of ab and ba, which differ by the error of the discretisation.
static double next_value(const Correlators *c, size_t a, size_t b, size_t m) {
    double ab = 0, ba = 0;
    for (size_t e = 0; e < c->species; e++) {
        ab += line(c, c->inverse, a * c->species + e)[m] * line(c, c->right, e * c->species + b)[m];
        ba += line(c, c->inverse, b * c->species + e)[m] * line(c, c->right, e * c->species + a)[m];
    }
    return (ab + ba) / 2;
}

// One iteration of the newest Phi, to be found in `image` and what it changed in `residue`; the
// product of that with what the iteration before changed, and with the difference.
typedef struct Mixing {
    double along, square, change; // the largest change in units of S
} Mixing;

static void iterate_pair(Correlators *c, size_t a, size_t b, double *phi, bool first,
                         Mixing *mixing) {
    const size_t pair = pair_of(c, a, b);
    const double *factor = line(c, c->model->factor, pair_of(c, a, a));
    double *values = line(c, phi, pair), *image = line(c, c->image, pair);
    double *residue = line(c, c->residue, pair);
    for (size_t m = 0; m < c->grid->count; m++) {
        const double next = next_value(c, a, b, m), change = next - values[m];
        const double difference = first ? 0 : change - residue[m];
        mixing->along += change * difference;
        mixing->square += difference * difference;
        mixing->change = fmax(mixing->change, fabs(change) / factor[m]);
        values[m] = image[m]; // the image before, for which the newest changes places
        image[m] = next;
        residue[m] = change;
    }
}

// Anderson's mixing of two iterations: one slow direction is taken out, the critical one.
static double iterate_collective(Correlators *c, double *phi, double *memory, bool first) {
    Mixing mixing = {0};
    model_memory(c->model, phi, memory);
    c->evaluations++;
    fill_right(c, memory);
    for (size_t a = 0; a < c->species; a++) {
        for (size_t b = a; b < c->species; b++) iterate_pair(c, a, b, phi, first, &mixing);
    }
    const double part = mixing.square > 0 ? mixing.along / mixing.square : 0;
    for (size_t i = 0; i < c->model->size; i++)
        phi[i] = c->image[i] - part * (c->image[i] - phi[i]);
    return mixing.change;
}

static void extrapolate(const History *history, size_t i) {
    double *now = history_f(history, i);
    for (size_t k = 0; k < history->f_size; k++)
        now[k] = 3 * history_f(history, i - 1)[k] - 3 * history_f(history, i - 2)[k] +
                 history_f(history, i - 3)[k];
}

static Status fail_slow(const Correlators *c, double change) {
    return status_fail(UNHEALTHY,
                       "correlators: at t = %g, after %d iterations, Phi still changes by %.3g",
                       correlators_time(c), ITERATIONS_MOST, change);
}

static Status advance_collective(Correlators *c) {
    double *phi = history_f(&c->collective, c->now), *memory = history_m(&c->collective, c->now);
    double change = INFINITY;
    if (c->stretch)
        c->model->stretched =
            stretch_direct(c->stretch, c->settings.shear_rate * correlators_time(c));
    fill_rest(c);
    extrapolate(&c->collective, c->now);
    for (int i = 0; i < ITERATIONS_MOST && !(change < CONVERGED); i++)
        change = iterate_collective(c, phi, memory, i == 0);
    if (!(change < CONVERGED)) return fail_slow(c, change);
    history_average(&c->collective, c->now);
    return OK;
}

// ---- Tagged particles --------------------------------------------------------------------------

// 1/(q^2 D)
static double self_time(const Correlators *c, size_t a, size_t m) {
    return c->tau[a * c->stride + m] * c->model->mixture.fraction[a];
}

// The kernels of the correlators at time i, whose Phi is known.
static void self_kernels(Correlators *c, size_t i) {
    model_transform(c->model, history_f(&c->collective, i), &c->radial);
    model_tagged(c->model, &c->radial, history_f(&c->self, i), history_m(&c->self, i));
    model_displacement(c->model, history_f(&c->self, i), history_m(&c->displacement, i));
}

static void begin_self(Correlators *c) {
    for (size_t k = 0; k < c->species * c->grid->count; k++)
        history_f(&c->self, 0)[k / c->grid->count * c->stride + k % c->grid->count] = 1;
    self_kernels(c, 0);
    const double *kernel = history_m(&c->self, 0), *slow = history_m(&c->displacement, 0);
    for (size_t i = 1; i <= c->block / 2; i++) {
        const double t = (double)i * c->step;
        for (size_t a = 0; a < c->species; a++) {
            const double flow = 2 * c->grid->dimension * c->settings.diffusion[a];
            for (size_t m = 0; m < c->grid->count; m++) {
                const double x = t / self_time(c, a, m);
                history_f(&c->self, i)[a * c->stride + m] =
                    1 - x + x * x / 2 * (1 + kernel[a * c->stride + m]);
            }
            history_f(&c->displacement, i)[a] =
                flow * t * (1 - c->settings.diffusion[a] * slow[a] * t / 2);
        }
        self_kernels(c, i);
        history_average(&c->self, i);
        history_average(&c->displacement, i);
    }
}

static void prepare_self(Correlators *c) {
    const double *mean = c->self.m_mean + c->self.m_size;
    for (size_t a = 0; a < c->species; a++) {
        for (size_t m = 0; m < c->grid->count; m++) {
            const size_t k = a * c->stride + m;
            c->self_inverse[k] = 1 / (1.5 / c->step * self_time(c, a, m) + 1 + mean[k]);
        }
    }
}

static double iterate_self(Correlators *c) {
    double *phi = history_f(&c->self, c->now), *memory = history_m(&c->self, c->now), change = 0;
    const double *mean = c->self.f_mean + c->self.f_size;
    model_tagged(c->model, &c->radial, phi, memory);
    for (size_t a = 0; a < c->species; a++) {
        for (size_t m = 0; m < c->grid->count; m++) {
            const size_t k = a * c->stride + m;
            const double next = c->self_inverse[k] * (c->self_rest[k] + memory[k] * (1 - mean[k]));
            change = fmax(change, fabs(next - phi[k]));
            phi[k] = next;
        }
    }
    return change;
}

static void fill_self_rest(Correlators *c) {
    const double *before = history_f(&c->self, c->now - 1);
    const double *earlier = history_f(&c->self, c->now - 2);
    memset(c->self_rest, 0, c->species * c->stride * sizeof *c->self_rest);
    for (size_t a = 0; a < c->species; a++) {
        history_known(&c->self, c->now, a, a, line(c, c->self_rest, a));
        for (size_t m = 0; m < c->grid->count; m++) {
            const size_t k = a * c->stride + m;
            c->self_rest[k] =
                self_time(c, a, m) / (2 * c->step) * (4 * before[k] - earlier[k]) - c->self_rest[k];
        }
    }
}

// dr^2/D + int m dr^2' = 2 d t, differentiated; its kernel does not depend on dr^2 itself.
static void advance_displacement(Correlators *c) {
    const History *history = &c->displacement;
    _Alignas(MEMORY_ALIGNMENT) double known[SMALL_MOST] = {0};
    history_known(history, c->now, 0, 0, known);
    const double *mean = history->m_mean + history->m_size;
    const double *f_mean = history->f_mean + history->f_size;
    for (size_t a = 0; a < c->species; a++) {
        const double friction = 1 / (2 * c->step * c->settings.diffusion[a]);
        const double past =
            4 * history_f(history, c->now - 1)[a] - history_f(history, c->now - 2)[a];
        history_f(history, c->now)[a] = (2 * c->grid->dimension + friction * past - known[a] -
                                         history_m(history, c->now)[a] * f_mean[a]) /
                                        (3 * friction + mean[a]);
    }
}

static Status advance_self(Correlators *c) {
    double change = INFINITY;
    fill_self_rest(c);
    extrapolate(&c->self, c->now);
    model_transform(c->model, history_f(&c->collective, c->now), &c->radial);
    for (int i = 0; i < ITERATIONS_MOST && !(change < CONVERGED); i++) change = iterate_self(c);
    if (!(change < CONVERGED)) return fail_slow(c, change);
    model_displacement(c->model, history_f(&c->self, c->now), history_m(&c->displacement, c->now));
    advance_displacement(c);
    history_average(&c->self, c->now);
    history_average(&c->displacement, c->now);
    return OK;
}

// ---- The whole ---------------------------------------------------------------------------------

static Status prepare(Correlators *c) {
    TRY(prepare_collective(c));
    if (c->settings.tagged) prepare_self(c);
    return OK;
}

static Status next_block(Correlators *c) {
    history_decimate(&c->collective);
    if (c->settings.tagged) {
        history_decimate(&c->self);
        history_decimate(&c->displacement);
    }
    c->step *= 2;
    c->now = c->block / 2;
    return prepare(c);
}

Status correlators_advance(Correlators *c) {
    if (c->now == c->block) TRY(next_block(c));
    c->now++;
    if (c->now <= c->block / 2) return OK; // the beginning, which is there already
    TRY(advance_collective(c));
    return c->settings.tagged ? advance_self(c) : OK;
}

static Status create(Correlators **out, const Grid *grid, const Structure *structure,
                     const CorrelatorSettings *settings) {
    Correlators *c = NULL;
    TRY(NEW(c));
    *out = c;
    c->grid = grid;
    c->settings = *settings;
    c->block = settings->block ? settings->block : BLOCK;
    c->species = structure->mixture.species;
    c->stride = grid->stride;
    TRY(model_create(&c->model, grid, structure));
    return allocate(c);
}

static Status begin(Correlators *c) {
    double quickest = 0;
    for (size_t a = 0; a < c->species; a++) {
        if (!(c->settings.diffusion[a] > 0))
            return status_fail(BAD_DATA, "species %zu: the diffusion coefficient must be positive",
                               a + 1);
        quickest = fmax(quickest, c->settings.diffusion[a]);
        for (size_t m = 0; m < c->grid->count; m++)
            line(c, c->tau, a)[m] = 1 / (pow(c->grid->wave_number[m], 2) *
                                         c->settings.diffusion[a] * c->model->mixture.fraction[a]);
    }
    const double largest = c->grid->wave_number[c->grid->count - 1];
    c->step = TAYLOR_END / (quickest * largest * largest) / (double)(c->block / 2);
    begin_collective(c);
    if (c->settings.tagged) begin_self(c);
    return prepare(c);
}

Status correlators_create(Correlators **out, const Grid *grid, const Structure *structure,
                          const CorrelatorSettings *settings) {
    *out = NULL;
    if (settings->shear_rate != 0 && (structure->mixture.species > 1 || settings->tagged))
        return status_fail(BAD_DATA, "the isotropically sheared model is of one species, of which "
                                     "none is tagged");
    Status status = create(out, grid, structure, settings);
    if (status == OK) status = begin(*out);
    if (status == OK && settings->shear_rate != 0)
        status = stretch_create(&(*out)->stretch, grid, structure, 0, 0);
    if (status == OK) return OK;
    correlators_free(*out);
    *out = NULL;
    return status;
}

Status correlators_create_master(Correlators **out, const Grid *grid, const Structure *structure,
                                 const double *form, const double *amplitude, double b) {
    *out = NULL;
    Status status = create(out, grid, structure, &(CorrelatorSettings){.tagged = false});
    if (status == OK) {
        (*out)->master = true;
        (*out)->step = MASTER_END / (double)((*out)->block / 2);
        begin_master(*out, form, amplitude, b);
        status = prepare(*out);
    }
    if (status == OK) return OK;
    correlators_free(*out);
    *out = NULL;
    return status;
}

void correlators_free(Correlators *c) {
    if (!c) return;
    double *const arrays[] = {c->tau,          c->inverse,   c->jump,  c->rest,   c->right,
                              c->self_inverse, c->self_rest, c->image, c->residue};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) memory_free(arrays[i]);
    radial_free(&c->radial);
    history_free(&c->collective);
    history_free(&c->self);
    history_free(&c->displacement);
    stretch_free(c->stretch);
    model_free(c->model);
    memory_free(c);
}

double correlators_time(const Correlators *c) {
    return (double)c->now * c->step;
}

const double *correlators_collective(const Correlators *c) {
    return history_f(&c->collective, c->now);
}

const double *correlators_self(const Correlators *c) {
    return c->settings.tagged ? history_f(&c->self, c->now) : NULL;
}

const double *correlators_displacement(const Correlators *c) {
    return c->settings.tagged ? history_f(&c->displacement, c->now) : NULL;
}

size_t correlators_evaluations(const Correlators *c) {
    return c->evaluations;
}
