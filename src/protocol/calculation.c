// SPDX-License-Identifier: GPL-3.0-or-later
// Which theory a run is of, and how often: where its structure is measured, once with all samples
// and once without each group of them.
#include "protocol/calculation.h"

#include "base/memory.h"

#include <string.h>

struct Calculation {
    const Plan *plan;
    TheoryPlan theory_plan; // of the pass that goes on
    IttPlan itt_plan;
    Theory *theory; // one of the three
    Schematic *schematic;
    Itt *itt;
    Measurements *measurements; // NULL: nothing is read
    Measured *measured;         // what of them the pass takes
    size_t groups, pass;        // of no groups there is one pass; else pass g > 0 is without g - 1
    Results **done;             // [1 + groups], of passes
};

// ---- A pass -------------------------------------------------------------------------------------

static void end_pass(Calculation *c) {
    theory_free(c->theory);
    schematic_free(c->schematic);
    itt_free(c->itt);
    measured_free(c->measured);
    c->theory = NULL;
    c->schematic = NULL;
    c->itt = NULL;
    c->measured = NULL;
}

static Status create_theory(Calculation *c) {
    if (c->plan->itt.given) return itt_create(&c->itt, &c->itt_plan, c->measured);
    if (c->plan->schematic.given) return schematic_create(&c->schematic, &c->plan->schematic);
    return theory_create(&c->theory, &c->theory_plan, c->measured);
}

// Where no wave numbers are asked for they are those of the peak, which is elsewhere without some
// of the samples: then those of all samples are.
static void settle_wave_numbers(const Results *whole, OptionReals *wanted) {
    for (size_t i = 0; i < whole->series_count && wanted->count == 0; i++) {
        const ResultSeries *series = &whole->series[i];
        const ResultAxis *last = &series->axis[series->axes - 1];
        if (series->axes < 3 || strcmp(last->name, "time") != 0) continue;
        const ResultAxis *waves = last - 1;
        if (strcmp(waves->name, "wave_number") != 0 || waves->count > OPTION_LIST_SIZE) continue;
        wanted->count = (int64_t)waves->count;
        memcpy(wanted->values, waves->values, waves->count * sizeof *waves->values);
    }
}

static Status begin_pass(Calculation *c) {
    const size_t omitted = c->pass > 0 ? c->pass - 1 : 0;
    end_pass(c);
    if (c->pass > 0) {
        settle_wave_numbers(c->done[0], &c->theory_plan.correlator_wave_numbers);
        settle_wave_numbers(c->done[0], &c->itt_plan.wave_numbers);
    }
    if (c->measurements)
        TRY(measurements_fit(&c->measured, c->measurements, c->pass > 0 ? c->groups : 0, omitted));
    if (c->groups > 0 && !c->done[c->pass]) TRY(results_create(&c->done[c->pass], 1));
    return create_theory(c);
}

static Status advance_pass(Calculation *c, Results *results) {
    if (c->itt) return itt_advance(c->itt, results);
    if (c->schematic) return schematic_advance(c->schematic, results);
    return theory_advance(c->theory, results);
}

// Not where the structure that it takes could not be fitted, or was left within.
static bool pass_begun(const Calculation *c) {
    return c->itt || c->schematic || c->theory;
}

static bool pass_finished(const Calculation *c) {
    if (!pass_begun(c)) return false;
    if (c->itt) return itt_finished(c->itt);
    if (c->schematic) return schematic_finished(c->schematic);
    return theory_finished(c->theory);
}

static double pass_progress(const Calculation *c) {
    if (!pass_begun(c)) return 0;
    if (c->itt) return itt_progress(c->itt);
    if (c->schematic) return schematic_progress(c->schematic);
    return theory_progress(c->theory);
}

// ---- All passes ---------------------------------------------------------------------------------

static Status read_structure(Calculation *c) {
    const Plan *plan = c->plan;
    const MeasurementsInput input =
        plan->itt.given ? itt_input(&plan->itt) : theory_input(&plan->theory);
    TRY(measurements_read(&c->measurements, &input));
    const size_t replicas = measurements_replicas(c->measurements), slots = plan_slots(plan);
    c->groups = slots < replicas ? slots : replicas;
    if (c->groups < 2) c->groups = 0;
    return c->groups > 0 ? NEW_ARRAY(c->done, c->groups + 1) : OK;
}

Status calculation_create(Calculation **out, const Plan *plan) {
    Calculation *c = NULL;
    *out = NULL;
    TRY(NEW(c));
    c->plan = plan;
    c->theory_plan = plan->theory;
    c->itt_plan = plan->itt;
    Status status = plan_input(plan) ? read_structure(c) : OK;
    if (status == OK) status = begin_pass(c);
    if (status == OK)
        *out = c;
    else
        calculation_free(c);
    return status;
}

void calculation_free(Calculation *c) {
    if (!c) return;
    end_pass(c);
    for (size_t pass = 0; c->done && pass <= c->groups; pass++) results_free(c->done[pass]);
    memory_free(c->done);
    measurements_free(c->measurements);
    memory_free(c);
}

uint32_t calculation_checksum(const Calculation *c) {
    return c->measurements ? measurements_checksum(c->measurements) : 0;
}

Status calculation_advance(Calculation *c, Results *results) {
    if (!pass_finished(c)) TRY(advance_pass(c, c->groups > 0 ? c->done[c->pass] : results));
    if (c->groups == 0 || !pass_finished(c)) return OK;
    if (c->pass == c->groups) return results_jackknife(results, c->done, c->groups);
    c->pass++;
    return begin_pass(c);
}

bool calculation_finished(const Calculation *c) {
    return c->pass == c->groups && pass_finished(c);
}

double calculation_progress(const Calculation *c) {
    return ((double)c->pass + pass_progress(c)) / (double)(c->groups + 1);
}

const char *calculation_doing(const Calculation *c) {
    if (!pass_begun(c)) return "structure";
    if (c->itt) return itt_doing(c->itt);
    if (c->schematic) return schematic_doing(c->schematic);
    return theory_doing(c->theory);
}

double calculation_time(const Calculation *c) {
    if (!pass_begun(c)) return 0;
    if (c->itt) return itt_time(c->itt);
    if (c->schematic) return schematic_time(c->schematic);
    return theory_time(c->theory);
}

// ---- Checkpoints --------------------------------------------------------------------------------

static bool pass_can_save(const Calculation *c) {
    return c->itt && itt_can_save(c->itt);
}

bool calculation_can_save(const Calculation *c) {
    return c->pass > 0 || pass_can_save(c);
}

// Passes that are done, and whether the one that goes on follows.
static void archive_passes(Calculation *c, Archive *archive, bool *follows) {
    uint64_t pass = c->pass, inside = *follows;
    archive_u64(archive, &pass, 1);
    archive_u64(archive, &inside, 1);
    archive_require(archive, pass <= c->groups, "it has more groups than are read");
    if (archive_status(archive, false) != OK) return;
    *follows = inside != 0;
    c->pass = pass;
    for (size_t i = 0; i < pass; i++) {
        if (archive->loading && !c->done[i] && results_create(&c->done[i], 0) != OK) {
            archive_require(archive, false, "out of memory");
            return;
        }
        results_archive(c->done[i], archive);
    }
}

void calculation_save(Calculation *c, Archive *archive) {
    bool follows = pass_can_save(c);
    ASSERT(calculation_can_save(c));
    archive_passes(c, archive, &follows);
    if (follows) itt_save(c->itt, archive);
}

Status calculation_load(Calculation *c, Results *results, Archive *archive) {
    bool follows = false;
    end_pass(c);
    for (size_t pass = 0; c->done && pass <= c->groups; pass++) {
        results_free(c->done[pass]);
        c->done[pass] = NULL;
    }
    archive_passes(c, archive, &follows);
    TRY(archive_status(archive, false));
    TRY(begin_pass(c));
    if (!follows) return OK;
    if (!c->itt) return status_fail(BAD_DATA, "a theory of this kind keeps no checkpoint");
    return itt_load(c->itt, c->groups > 0 ? c->done[c->pass] : results, archive);
}
