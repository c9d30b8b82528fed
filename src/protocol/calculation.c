// SPDX-License-Identifier: GPL-3.0-or-later
// Which theory a run is of.
#include "protocol/calculation.h"

#include "base/memory.h"

struct Calculation {
    Theory *theory; // one of the three
    Schematic *schematic;
    Itt *itt;
};

Status calculation_create(Calculation **out, const Plan *plan) {
    Calculation *c = NULL;
    *out = NULL;
    TRY(NEW(c));
    Status status;
    if (plan->itt.given)
        status = itt_create(&c->itt, &plan->itt);
    else if (plan->schematic.given)
        status = schematic_create(&c->schematic, &plan->schematic);
    else
        status = theory_create(&c->theory, &plan->theory);
    if (status == OK)
        *out = c;
    else
        calculation_free(c);
    return status;
}

void calculation_free(Calculation *c) {
    if (!c) return;
    theory_free(c->theory);
    schematic_free(c->schematic);
    itt_free(c->itt);
    memory_free(c);
}

uint32_t calculation_checksum(const Calculation *c) {
    if (c->itt) return itt_checksum(c->itt);
    return c->theory ? theory_checksum(c->theory) : 0;
}

Status calculation_advance(Calculation *c, Results *results) {
    if (c->itt) return itt_advance(c->itt, results);
    if (c->schematic) return schematic_advance(c->schematic, results);
    return theory_advance(c->theory, results);
}

bool calculation_finished(const Calculation *c) {
    if (c->itt) return itt_finished(c->itt);
    if (c->schematic) return schematic_finished(c->schematic);
    return theory_finished(c->theory);
}

double calculation_progress(const Calculation *c) {
    if (c->itt) return itt_progress(c->itt);
    if (c->schematic) return schematic_progress(c->schematic);
    return theory_progress(c->theory);
}

const char *calculation_doing(const Calculation *c) {
    if (c->itt) return itt_doing(c->itt);
    if (c->schematic) return schematic_doing(c->schematic);
    return theory_doing(c->theory);
}

double calculation_time(const Calculation *c) {
    if (c->itt) return itt_time(c->itt);
    if (c->schematic) return schematic_time(c->schematic);
    return theory_time(c->theory);
}

bool calculation_can_save(const Calculation *c) {
    return c->itt && itt_can_save(c->itt);
}

void calculation_save(Calculation *c, Archive *archive) {
    ASSERT(calculation_can_save(c));
    itt_save(c->itt, archive);
}

Status calculation_load(Calculation *c, Results *results, Archive *archive) {
    if (!c->itt) return status_fail(BAD_DATA, "a theory of this kind keeps no checkpoint");
    return itt_load(c->itt, results, archive);
}
