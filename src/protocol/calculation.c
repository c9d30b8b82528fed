// SPDX-License-Identifier: GPL-3.0-or-later
// Which theory a run is of.
#include "protocol/calculation.h"

#include "base/memory.h"

struct Calculation {
    Theory *theory; // one of the two
    Itt *itt;
};

Status calculation_create(Calculation **out, const Plan *plan) {
    Calculation *c = NULL;
    *out = NULL;
    TRY(NEW(c));
    const Status status = plan->itt.given ? itt_create(&c->itt, &plan->itt)
                                          : theory_create(&c->theory, &plan->theory);
    if (status == OK)
        *out = c;
    else
        calculation_free(c);
    return status;
}

void calculation_free(Calculation *c) {
    if (!c) return;
    theory_free(c->theory);
    itt_free(c->itt);
    memory_free(c);
}

Status calculation_advance(Calculation *c, Results *results) {
    return c->itt ? itt_advance(c->itt, results) : theory_advance(c->theory, results);
}

bool calculation_finished(const Calculation *c) {
    return c->itt ? itt_finished(c->itt) : theory_finished(c->theory);
}

double calculation_progress(const Calculation *c) {
    return c->itt ? itt_progress(c->itt) : theory_progress(c->theory);
}

const char *calculation_doing(const Calculation *c) {
    return c->itt ? itt_doing(c->itt) : theory_doing(c->theory);
}

double calculation_time(const Calculation *c) {
    return c->itt ? itt_time(c->itt) : theory_time(c->theory);
}
