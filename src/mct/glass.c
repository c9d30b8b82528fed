// SPDX-License-Identifier: GPL-3.0-or-later
// Glass form factors by the iteration that converges to the largest solution, and the linear map
// whose largest eigenvalue reaches 1 at the glass transition (Weysser, thesis, eqs 3.8-3.11).
#include "mct/glass.h"

#include "base/memory.h"
#include "base/patience.h"
#include "mct/lines.h"

#include <math.h>
#include <string.h>

static const double GONE = 1e-3;       // largest F/S below which there is no glass
static const double CONVERGED = 1e-11; // change of F/S in an iteration
static const double SETTLED = 0.02;    // of the contraction: change at which it is used to leap
enum { ITERATIONS_MOST = 400000, LEAP_EVERY = 12, POWER_MOST = 20000 };

// One iteration; the largest F/S, and the largest change of it.
static Status iterate(const Model *model, const double *memory, double *form, double *most,
                      double *change) {
    *most = *change = 0;
    for (size_t m = 0; m < model->grid->count; m++) {
        SmallMatrix s, inverse, kernel, next, before;
        model_matrix(model, model->factor, m, s);
        model_matrix(model, model->inverse, m, inverse);
        model_matrix(model, memory, m, kernel);
        model_matrix(model, form, m, before);
        for (size_t a = 0; a < model->species; a++) {
            for (size_t b = 0; b < model->species; b++) inverse[a][b] += kernel[a][b];
        }
        if (!small_invert(model->species, inverse, next))
            return status_fail(UNHEALTHY, "glass form factors: no inverse at q = %g",
                               model->grid->wave_number[m]);
        for (size_t a = 0; a < model->species; a++) {
            for (size_t b = 0; b < model->species; b++) next[a][b] = s[a][b] - next[a][b];
            *most = fmax(*most, next[a][a] / s[a][a]);
            *change = fmax(*change, fabs(next[a][a] - before[a][a]) / s[a][a]);
        }
        model_put(model, form, m, next);
    }
    return OK;
}

// Where changes shrink by the same ratio r each time, what is still to come is r/(1 - r) of the
// last. From above it is less than that, since the contraction quickens there: a leap never passes
// the solution.
typedef struct Leap {
    double *last, *change; // F before, and its last change
    double ratio;
} Leap;

static void leap(const Model *model, Leap *state, double *form, size_t iteration) {
    double along = 0, square = 0;
    for (size_t i = 0; i < model->size; i++) {
        const double change = form[i] - state->last[i];
        along += change * state->change[i];
        square += state->change[i] * state->change[i];
        state->change[i] = change;
    }
    const double ratio = square > 0 ? along / square : 0, before = state->ratio;
    const bool settled = ratio > 0 && ratio < 1 && fabs(ratio - before) < SETTLED * (1 - ratio);
    state->ratio = ratio;
    for (size_t i = 0; settled && iteration % LEAP_EVERY == 0 && i < model->size; i++)
        form[i] += state->change[i] * ratio / (1 - ratio);
    memcpy(state->last, form, model->size * sizeof *form);
}

static Status converge(Model *model, double *form, double *memory, Leap *state, bool *glass) {
    double most = 0, change = 0;
    memcpy(state->last, form, model->size * sizeof *form);
    for (size_t iteration = 1; iteration <= ITERATIONS_MOST; iteration++) {
        TRY(patience_check());
        model_memory(model, form, memory);
        TRY(iterate(model, memory, form, &most, &change));
        *glass = most >= GONE;
        if (!*glass || change < CONVERGED) return OK;
        leap(model, state, form, iteration);
    }
    return status_fail(UNHEALTHY, "glass form factors: after %d iterations F/S still changes by %g",
                       ITERATIONS_MOST, change);
}

Status glass_form_factors(Model *model, double *form, bool *glass) {
    double *memory = NULL;
    Leap state = {0};
    Status status = NEW_ARRAY(memory, model->size);
    if (status == OK) status = NEW_ARRAY(state.last, model->size);
    if (status == OK) status = NEW_ARRAY(state.change, model->size);
    if (status == OK) status = converge(model, form, memory, &state, glass);
    if (status == OK && !*glass) memset(form, 0, model->size * sizeof *form);
    memory_free(memory);
    memory_free(state.last);
    memory_free(state.change);
    return status;
}

Status stability_create(Stability *stability, const Model *model) {
    *stability = (Stability){0};
    TRY(NEW_ARRAY(stability->right, model->size));
    TRY(NEW_ARRAY(stability->left, model->size));
    return OK;
}

void stability_free(Stability *stability) {
    memory_free(stability->right);
    memory_free(stability->left);
    *stability = (Stability){0};
}

typedef struct Work {
    Radial radial;
    double *free;           // S - F
    double *next, *between; // fields
} Work;

static Status work_create(Work *work, const Model *model) {
    *work = (Work){.free = NULL};
    TRY(radial_create(&work->radial, model));
    TRY(NEW_ARRAY(work->free, model->size));
    TRY(NEW_ARRAY(work->next, model->size));
    TRY(NEW_ARRAY(work->between, model->size));
    return OK;
}

static void work_free(Work *work) {
    radial_free(&work->radial);
    memory_free(work->free);
    memory_free(work->next);
    memory_free(work->between);
}

// (S - F) field (S - F)
static void enclose(const Model *model, const Work *work, const double *field, double *out) {
    if (model->species == 1) {
        for (size_t m = 0; m < model->grid->count; m++)
            out[m] = work->free[m] * field[m] * work->free[m];
        return;
    }
    for (size_t m = 0; m < model->grid->count; m++) {
        SmallMatrix outer, inner, left, both;
        model_matrix(model, work->free, m, outer);
        model_matrix(model, field, m, inner);
        small_multiply(model->species, outer, inner, left);
        small_multiply(model->species, left, outer, both);
        model_put(model, out, m, both);
    }
}

static void apply_right(Model *model, Work *work, const double *h) {
    model_slope(model, &work->radial, h, work->between);
    enclose(model, work, work->between, work->next);
}

static void apply_left(Model *model, Work *work, const double *g) {
    enclose(model, work, g, work->between);
    model_adjoint(model, &work->radial, work->between, work->next);
}

// Power iteration; the map has positive elements, so its largest eigenvalue is alone.
static Status power(Model *model, Work *work, void (*apply)(Model *, Work *, const double *),
                    double *vector, double *eigenvalue) {
    double change = 1;
    for (size_t iteration = 0; iteration < POWER_MOST && change >= CONVERGED; iteration++) {
        TRY(patience_check());
        apply(model, work, vector);
        const double size = sqrt(model_product(model, work->next, work->next));
        change = 0;
        for (size_t i = 0; i < model->size; i++) {
            const double next = work->next[i] / size;
            change = fmax(change, fabs(next - vector[i]));
            vector[i] = next;
        }
        *eigenvalue = size;
    }
    if (change < CONVERGED) return OK;
    return status_fail(UNHEALTHY,
                       "critical eigenvector: after %d iterations it still changes by %.3g, with "
                       "the eigenvalue at %.9g",
                       POWER_MOST, change, *eigenvalue);
}

// H (S - F)^-1 H
static void fill_square(const Model *model, const Work *work, const double *h, double *out) {
    for (size_t m = 0; m < model->grid->count; m++) {
        SmallMatrix outer, inner, inverse, left, both;
        model_matrix(model, work->free, m, outer);
        model_matrix(model, h, m, inner);
        small_invert(model->species, outer, inverse);
        small_multiply(model->species, inner, inverse, left);
        small_multiply(model->species, left, inner, both);
        model_put(model, out, m, both);
    }
}

static void normalise(const Model *model, Work *work, Stability *stability) {
    const double first = model_product(model, stability->left, stability->right);
    fill_square(model, work, stability->right, work->next);
    const double second = model_product(model, stability->left, work->next);
    // right -> u right, left -> v left with u v first = 1 and u^2 v second = 1
    const double u = first / second, v = 1 / (u * first);
    for (size_t i = 0; i < model->size; i++) {
        stability->right[i] *= u;
        stability->left[i] *= v;
    }
}

static Status find_stability(Model *model, const double *form, Work *work, Stability *stability) {
    for (size_t i = 0; i < model->size; i++) work->free[i] = model->factor[i] - form[i];
    model_transform(model, form, &work->radial);
    TRY(power(model, work, apply_right, stability->right, &stability->eigenvalue));
    TRY(power(model, work, apply_left, stability->left, &stability->eigenvalue));
    normalise(model, work, stability);
    model_memory(model, stability->right, work->between);
    enclose(model, work, work->between, work->next);
    stability->lambda = model_product(model, stability->left, work->next);
    return OK;
}

Status glass_stability(Model *model, const double *form, Stability *stability) {
    Work work;
    if (stability->eigenvalue == 0) {
        memcpy(stability->right, form, model->size * sizeof *form);
        memcpy(stability->left, form, model->size * sizeof *form);
    }
    Status status = work_create(&work, model);
    if (status == OK) status = find_stability(model, form, &work, stability);
    work_free(&work);
    return status;
}

Status glass_separation(Model *model, const double *form, const double *left, double *separation) {
    double *memory = NULL, *next = NULL, most, change;
    Status status = NEW_ARRAY(memory, model->size);
    if (status == OK) status = NEW_ARRAY(next, model->size);
    if (status == OK) {
        memcpy(next, form, model->size * sizeof *form);
        model_memory(model, form, memory);
        status = iterate(model, memory, next, &most, &change);
    }
    for (size_t i = 0; status == OK && i < model->size; i++) next[i] -= form[i];
    if (status == OK) *separation = model_product(model, left, next);
    memory_free(memory);
    memory_free(next);
    return status;
}
