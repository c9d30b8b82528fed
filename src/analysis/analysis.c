// SPDX-License-Identifier: GPL-3.0-or-later
// Goes through the results and derives what can be.
#include "analysis/analysis.h"

#include "analysis/derive.h"
#include "analysis/equation_of_state.h"

#include <stdio.h>
#include <string.h>

Status derive_theory(Results *results, const char *stage, const System *system) {
    const EquationOfState theory = equation_of_state(system);
    char about[RESULT_TEXT];
    snprintf(about, sizeof about, "P V/(N kT) of the equation of state: %s.", theory.name);
    for (size_t replica = 0; replica < results->replicas; replica++) {
        TRY(results_put_scalar(results, stage, "compressibility_factor_theory", "", about, replica,
                               theory.compressibility_factor));
    }
    return OK;
}

static Status derive_from(Results *results, const ResultSeries *series, const System *system) {
    const char *observable = series->observable;
    if (strcmp(observable, "mean_squared_displacement") == 0) {
        return derive_diffusion(results, series);
    }
    if (strcmp(observable, "contact_distribution") == 0) {
        TRY(derive_contact(results, series));
        return derive_theory(results, series->stage, system);
    }
    if (strcmp(observable, "pressure") == 0) {
        return derive_theory(results, series->stage, system);
    }
    return OK;
}

Status analysis_derive(Results *results, const System *system) {
    for (size_t i = 0; i < results->series_count; i++) {
        TRY(derive_from(results, &results->series[i], system));
    }
    return OK;
}
