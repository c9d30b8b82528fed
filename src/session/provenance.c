// SPDX-License-Identifier: GPL-3.0-or-later
// Where results come from.
#include "session/provenance.h"

#include "base/cpu.h"
#include "base/number.h"
#include "base/text.h"
#include "base/version.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static Status put_integer(Results *results, const char *name, int64_t value) {
    char text[32];
    snprintf(text, sizeof text, "%lld", (long long)value);
    return results_put_fact(results, name, text);
}

static Status put_when_and_where(Results *results, double seconds) {
    char text[256];
    const time_t now = time(NULL);
    struct tm utc;
    strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    TRY(results_put_fact(results, "finished", text));
    if (gethostname(text, sizeof text) != 0) strcpy(text, "unknown");
    text[sizeof text - 1] = '\0';
    TRY(results_put_fact(results, "host", text));
    snprintf(text, sizeof text, "%.3f", seconds);
    return results_put_fact(results, "wall_seconds", text);
}

// Platelets have no volume, so that their number density says how dense they are.
static void put_density(Text *words, const System *system) {
    const double packing = system_packing_fraction(system);
    if (packing > 0)
        text_add(words, "packing fraction %.6g", packing);
    else
        text_add(words, "number density %.6g d^-%d", system_number_density(system),
                 (int)system->dimension);
}

// "1000 particles in 2 dimensions, packing fraction 0.7: 500 small of diameter 1, 500 big of ..."
static Status put_system(Results *results, const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    Text words = {0};
    text_add(&words, "%lld particles in %d dimensions, ", (long long)system->particles,
             (int)system->dimension);
    put_density(&words, system);
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        text_add(&words, "%s%zu %s of diameter %.6g", s ? ", " : ": ", counts[s], species->name,
                 species->diameter);
        if (species->length > 0) text_add(&words, " and length %.6g", species->length);
        if (species->spread != SPREAD_NONE)
            text_add(&words, " ± %.3g %%", 100 * species->spread_width);
        if (species->mass != 1) text_add(&words, " and mass %.6g", species->mass);
    }
    const Status status = results_put_fact(results, "system", text_words(&words));
    text_free(&words);
    return status;
}

// For machines, where all are hard discs or spheres of one size for each species:
// "dimension=2 packing_fraction=0.7 diameters=1,1.4 fractions=0.5,0.5".
static Status put_mixture(Results *results, const System *system) {
    size_t counts[SPECIES_MOST];
    char number[NUMBER_SIZE];
    Text words = {0};
    system_counts(system, counts);
    text_add(&words, "dimension=%d packing_fraction=%s", (int)system->dimension,
             number_write(number, system_packing_fraction(system)));
    for (int fractions = 0; fractions < 2; fractions++) {
        text_put(&words, fractions ? " fractions=" : " diameters=");
        for (size_t s = 0; s < system->species_count; s++) {
            const Species *species = &system->species[s];
            const bool hard = species->shape == SHAPE_DISC || species->shape == SHAPE_SPHERE;
            if (!hard || species->spread != SPREAD_NONE) return text_free(&words), OK;
            const double value =
                fractions ? (double)counts[s] / (double)system->particles : species->diameter;
            text_add(&words, "%s%s", s ? "," : "", number_write(number, value));
        }
    }
    const Status status = results_put_fact(results, "mixture", text_words(&words));
    text_free(&words);
    return status;
}

// "settle: newtonian, 200 d sqrt(m/kT); sheared: event-driven, 10 d^2/D0, shear_rate = 1"
static Status put_stages(Results *results, const Plan *plan) {
    Text words = {0};
    for (size_t s = 0; s < plan->stage_count; s++) {
        const Stage *stage = &plan->stages[s];
        text_add(&words, "%s%s: %s, %.6g %s", s ? "; " : "", stage->name,
                 stage->dynamics.kind->name, stage_time(stage), stage->dynamics.kind->time_unit);
        const char *drive = drive_words((char[DRIVE_WORDS_SIZE]){0}, &stage->drive);
        if (drive[0]) text_add(&words, ", %s", drive);
    }
    const Status status = results_put_fact(results, "stages", text_words(&words));
    text_free(&words);
    return status;
}

// ": 0.5 small of diameter 1, 0.5 big of diameter 1.4"
static void add_species(Text *words, const TheorySpecies *species, size_t count) {
    for (size_t a = 0; a < count; a++)
        text_add(words, "%s%.6g %s of diameter %.6g", a ? ", " : ": ", species[a].fraction,
                 species[a].name, species[a].diameter);
}

// "2 dimensions, structure: percus-yevick, 200 wave numbers up to 40: 0.5 small of diameter 1, ..."
static Status put_theory(Results *results, const TheoryPlan *theory) {
    Text words = {0};
    text_add(&words, "theory in %d dimensions, structure: %s, %lld wave numbers up to %.6g",
             (int)theory->dimension, theory_structure_name(theory), (long long)theory->wave_numbers,
             theory->last_wave_number);
    add_species(&words, theory->species, theory->species_count);
    const Status status = results_put_fact(results, "system", text_words(&words));
    text_free(&words);
    return status;
}

// "theory of discs under shear, structure: percus-yevick, wave vectors up to 30, spacing 0.3"
static Status put_itt(Results *results, const IttPlan *itt) {
    Text words = {0};
    text_add(&words,
             "theory of discs under shear, structure: %s, wave vectors up to %.6g, spacing %.6g",
             itt_structure_name(itt), itt->last_wave_number, itt->spacing);
    add_species(&words, itt->species, itt->species_count);
    const Status status = results_put_fact(results, "system", text_words(&words));
    text_free(&words);
    return status;
}

// "schematic model of one correlator: v1 = 0.83, v2 = 2, shear rate 0.1 D0/d^2"
static Status put_schematic(Results *results, const SchematicPlan *schematic) {
    Text words = {0};
    const F12 model = schematic_model(schematic);
    text_add(&words, "schematic model of one correlator: v1 = %.6g, v2 = %.6g, ", model.v1,
             model.v2);
    schematic_say_drive(&words, schematic);
    const Status status = results_put_fact(results, "system", text_words(&words));
    text_free(&words);
    return status;
}

Status provenance_put(Results *results, const Plan *plan, const char *plan_text, double seconds) {
    TRY(results_put_fact(results, "title", plan->title));
    if (plan->itt.given) {
        TRY(put_itt(results, &plan->itt));
    } else if (plan->schematic.given) {
        TRY(put_schematic(results, &plan->schematic));
    } else if (plan_is_theory(plan)) {
        TRY(put_theory(results, &plan->theory));
    } else {
        TRY(put_system(results, &plan->system));
        TRY(put_mixture(results, &plan->system));
        TRY(put_stages(results, plan));
    }
    TRY(results_put_fact(results, "version", version_number()));
    TRY(results_put_fact(results, "commit", version_commit()));
    TRY(results_put_fact(results, "compiler", version_compiler()));
    TRY(results_put_fact(results, "flags", version_flags()));
    TRY(results_put_fact(results, "vector_path", cpu_path_name(cpu_path())));
    if (!plan_is_theory(plan)) { // where nothing is random
        TRY(put_integer(results, "seed", plan->ensemble.seed));
        TRY(put_integer(results, "replicas", plan->ensemble.replicas));
    }
    TRY(results_put_fact(results, "plan", plan_text));
    return put_when_and_where(results, seconds);
}
