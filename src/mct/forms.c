// SPDX-License-Identifier: GPL-3.0-or-later
// Form factors of a glass, collective and of tagged particles: f/(1 - f) = m[F, f], from f = 1
// down.
#include "mct/forms.h"

#include "base/memory.h"
#include "base/patience.h"
#include "mct/glass.h"

#include <math.h>
#include <string.h>

enum { ITERATIONS_MOST = 100000 };
static const double CONVERGED = 1e-11; // change of f in an iteration

static Status iterate_self(Model *model, const Radial *radial, double *self, double *memory) {
    const size_t size = model->species * model->grid->stride;
    double change = 1;
    for (int iteration = 0; iteration < ITERATIONS_MOST && change >= CONVERGED; iteration++) {
        TRY(patience_check());
        change = 0;
        model_tagged(model, radial, self, memory);
        for (size_t k = 0; k < size; k++) {
            const double next = memory[k] / (1 + memory[k]);
            change = fmax(change, fabs(next - self[k]));
            self[k] = next;
        }
    }
    if (change < CONVERGED) return OK;
    return status_fail(
        UNHEALTHY, "tagged particle's form factors: after %d iterations they still change by %.3g",
        ITERATIONS_MOST, change);
}

static Status find_self(Model *model, const double *form, double *self, double *memory,
                        double *localisation) {
    Radial radial;
    TRY(radial_create(&radial, model));
    model_transform(model, form, &radial);
    for (size_t a = 0; a < model->species; a++) {
        for (size_t m = 0; m < model->grid->count; m++) self[a * model->grid->stride + m] = 1;
    }
    const Status status = iterate_self(model, &radial, self, memory);
    model_displacement(model, self, localisation);
    for (size_t a = 0; a < model->species; a++) localisation[a] = 1 / sqrt(localisation[a]);
    radial_free(&radial);
    return status;
}

// Lines of the model without their padding.
static void unpad(const Model *model, const double *field, size_t lines, double *out) {
    for (size_t i = 0; i < lines; i++)
        memcpy(out + i * model->grid->count, field + i * model->grid->stride,
               model->grid->count * sizeof *out);
}

static Status fill(Forms *forms, Model *model, double *form, double *self, double *memory) {
    memcpy(form, model->factor, model->size * sizeof *form);
    TRY(glass_form_factors(model, form, &forms->glass));
    TRY(find_self(model, form, self, memory, forms->localisation));
    unpad(model, form, model->pairs, forms->collective);
    unpad(model, self, model->species, forms->self);
    return OK;
}

Status forms_create(Forms **out, const Grid *grid, const Structure *structure) {
    Forms *forms = NULL;
    Model *model = NULL;
    double *form = NULL, *self = NULL, *memory = NULL;
    const size_t pairs = mixture_pairs(&structure->mixture), species = structure->mixture.species;
    *out = NULL;
    TRY(NEW(forms));
    forms->count = grid->count;
    Status status = NEW_ARRAY(forms->collective, pairs * grid->count);
    if (status == OK) status = NEW_ARRAY(forms->self, species * grid->count);
    if (status == OK) status = NEW_ARRAY(form, pairs * grid->stride);
    if (status == OK) status = NEW_ARRAY(self, species * grid->stride);
    if (status == OK) status = NEW_ARRAY(memory, species * grid->stride);
    if (status == OK) status = model_create(&model, grid, structure);
    if (status == OK) status = fill(forms, model, form, self, memory);
    memory_free(form);
    memory_free(self);
    memory_free(memory);
    model_free(model);
    if (status != OK) forms_free(forms);
    *out = status == OK ? forms : NULL;
    return status;
}

void forms_free(Forms *forms) {
    if (!forms) return;
    memory_free(forms->collective);
    memory_free(forms->self);
    memory_free(forms);
}
