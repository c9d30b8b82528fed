// SPDX-License-Identifier: GPL-3.0-or-later
// The section `schematic` of a run file: its table, what cannot be, what it costs.
#include "schematic/schematic.h"

#include <math.h>

static const char *const parts[] = {"transition", "correlator", "flow_curve", "yield_stress", NULL};

static const Option rows[] = {
    {.name = "v2",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, v2),
     .fallback = 2,
     .least = 0,
     .most = 100,
     .unit = "",
     .about = "Coupling quadratic in the correlator; above 1 the plateau comes up at once, with "
              "exponents of lambda = 1/sqrt(v2). 0: the model F1."},
    {.name = "separation",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, separation),
     .fallback = 0,
     .least = -10,
     .most = 10,
     .unit = "",
     .about = "Distance from the transition at this v2: v1 = 2 sqrt(v2) - v2 + "
              "separation/(sqrt(v2) - 1), for v2 up to 1 v1 = 1 + separation; a glass above 0."},
    {.name = "v1",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, v1),
     .fallback = -1,
     .least = -1,
     .most = 100,
     .unit = "",
     .about = "Coupling linear in the correlator; -1: as separation says."},
    {.name = "decay_rate",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, decay_rate),
     .fallback = 1,
     .least = 1e-6,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "Gamma, the rate of the decay without memory."},
    {.name = "critical_strain",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, critical_strain),
     .fallback = 0.15,
     .least = 1e-4,
     .most = 1e3,
     .unit = "",
     .about = "gamma_c, the strain at which half of the memory is lost; the yield stress 0.2763 of "
              "the thesis takes 0.15."},
    {.name = "modulus",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, modulus),
     .fallback = 100,
     .least = 1e-6,
     .most = 1e9,
     .unit = "",
     .about =
         "v_sigma, stress per strain and squared correlator: its unit is that of all stresses."},
    {.name = "softening_strain",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, softening_strain),
     .fallback = 0,
     .least = 0,
     .most = 1e3,
     .unit = "",
     .about = "Strain where the modulus passes 0 in v_sigma (1 - x^2) exp(-x^2), x = "
              "strain/softening_strain, so that the stress overshoots; 0: it never softens."},
    {.name = "shear_rate",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, shear_rate),
     .fallback = 0,
     .least = 0,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "Steady shear that begins with the correlator; 0: at rest."},
    {.name = "strain",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, last_strain),
     .fallback = 1,
     .least = 1e-3,
     .most = 1e3,
     .unit = "",
     .about = "How far the stress against strain is kept under steady shear."},
    {.name = "oscillate.amplitude",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, amplitude),
     .fallback = 0,
     .least = 0,
     .most = 1e3,
     .unit = "",
     .about = "Oscillatory shear: the largest strain; the strain is amplitude sin(frequency t)."},
    {.name = "oscillate.frequency",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, frequency),
     .fallback = 0,
     .least = 0,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "Angular frequency of oscillatory shear."},
    {.name = "shear_table.times",
     .type = OPTION_REALS,
     .offset = offsetof(SchematicPlan, table_times),
     .least = 0,
     .most = 1e12,
     .unit = "d^2/D0",
     .about = "Shear whose rate changes with time: times since it began, ascending."},
    {.name = "shear_table.rates",
     .type = OPTION_REALS,
     .offset = offsetof(SchematicPlan, table_rates),
     .least = -1e6,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "The shear rate at these times: straight lines between them, constant before the "
              "first and after the last."},
    {.name = "time",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, duration),
     .fallback = 0,
     .least = 0,
     .most = 1e12,
     .unit = "d^2/D0",
     .about = "How long the shear of the table lasts."},
    {.name = "moments",
     .type = OPTION_INTEGER,
     .offset = offsetof(SchematicPlan, moments),
     .fallback = 128,
     .least = 16,
     .most = 4096,
     .unit = "",
     .about = "Times of a cycle, or of the whole table, at which correlators begin and stresses "
              "are known."},
    {.name = "cycles",
     .type = OPTION_INTEGER,
     .offset = offsetof(SchematicPlan, periods),
     .fallback = 8,
     .least = 2,
     .most = 1000,
     .unit = "",
     .about = "Cycles of oscillatory shear since its beginning; moduli are of the last."},
    {.name = "times.first",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, first_time),
     .fallback = 1e-3,
     .least = 1e-12,
     .most = 1e12,
     .unit = "d^2/D0",
     .about = "The first time of the correlator that is kept."},
    {.name = "times.last",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, last_time),
     .fallback = 1e8,
     .least = 1e-11,
     .most = 1e18,
     .unit = "d^2/D0",
     .about = "The last time of the correlator at rest; under steady shear it ends where it has "
              "decayed."},
    {.name = "times.per_decade",
     .type = OPTION_INTEGER,
     .offset = offsetof(SchematicPlan, times_per_decade),
     .fallback = 10,
     .least = 1,
     .most = 50,
     .unit = "",
     .about = "Times kept per decade."},
    {.name = "flow_curve.first",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, first_rate),
     .fallback = 1e-8,
     .least = 1e-14,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "The smallest shear rate of the flow curve."},
    {.name = "flow_curve.last",
     .type = OPTION_REAL,
     .offset = offsetof(SchematicPlan, last_rate),
     .fallback = 1,
     .least = 1e-14,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "The largest."},
    {.name = "flow_curve.per_decade",
     .type = OPTION_INTEGER,
     .offset = offsetof(SchematicPlan, rates_per_decade),
     .fallback = 4,
     .least = 1,
     .most = 50,
     .unit = "",
     .about = "Shear rates per decade."},
    {.name = "block",
     .type = OPTION_INTEGER,
     .offset = offsetof(SchematicPlan, block),
     .fallback = 256,
     .least = 32,
     .most = 4096,
     .unit = "",
     .about = "Points of a block of the time grid, whose spacing then doubles: errors are of "
              "second order in 1/block."},
    {.name = "calculate",
     .type = OPTION_CHOICES,
     .offset = offsetof(SchematicPlan, calculate),
     .unit = "",
     .about =
         "What is calculated: the correlator comes with the stress of the shear that is given.",
     .choices = parts,
     .fallback_text = "[transition, correlator]"},
};
const OptionTable schematic_options = {rows, sizeof rows / sizeof *rows, sizeof(SchematicPlan)};

static bool wants(const SchematicPlan *plan, SchematicPart part) {
    return plan->calculate >> part & 1;
}

F12 schematic_model(const SchematicPlan *plan) {
    return (F12){.v1 = plan->v1 < 0 ? f12_v1_at(plan->v2, plan->separation) : plan->v1,
                 .v2 = plan->v2,
                 .rate = plan->decay_rate,
                 .critical_strain = plan->critical_strain,
                 .modulus = plan->modulus,
                 .softening = plan->softening_strain};
}

bool schematic_oscillates(const SchematicPlan *plan) {
    return plan->amplitude > 0 || plan->frequency > 0;
}

bool schematic_has_table(const SchematicPlan *plan) {
    return plan->table_times.count > 0 || plan->table_rates.count > 0;
}

static Status check_table(const SchematicPlan *plan) {
    const OptionReals *times = &plan->table_times, *rates = &plan->table_rates;
    if (!schematic_has_table(plan)) {
        if (plan->duration > 0)
            return status_fail(BAD_DATA, "time = %g is that of a shear_table, and there is none",
                               plan->duration);
        return OK;
    }
    if (times->count != rates->count)
        return status_fail(BAD_DATA, "shear_table = {...}: %d times and %d rates; give one of each",
                           (int)times->count, (int)rates->count);
    for (int64_t k = 1; k < times->count; k++) {
        if (times->values[k] > times->values[k - 1]) continue;
        return status_fail(BAD_DATA, "shear_table = {...}: times must ascend, but %g follows %g",
                           times->values[k], times->values[k - 1]);
    }
    if (!(plan->duration > 0))
        return status_fail(BAD_DATA,
                           "shear_table = {...}: how long it lasts is missing; give a time");
    return OK;
}

static Status check_shear(const SchematicPlan *plan) {
    if (plan->shear_rate > 0 && (schematic_oscillates(plan) || schematic_has_table(plan)))
        return status_fail(BAD_DATA, "shear_rate = %g stands beside %s; give one of the two",
                           plan->shear_rate,
                           schematic_oscillates(plan) ? "oscillate" : "shear_table");
    if (schematic_oscillates(plan) && schematic_has_table(plan))
        return status_fail(BAD_DATA,
                           "oscillate = {...} stands beside shear_table; give one of the two");
    if ((plan->amplitude > 0) != (plan->frequency > 0))
        return status_fail(BAD_DATA,
                           "oscillate = {amplitude: %g, frequency: %g}: both must be above 0",
                           plan->amplitude, plan->frequency);
    return check_table(plan);
}

Status schematic_check(const SchematicPlan *plan) {
    if (plan->calculate == 0) return status_fail(BAD_DATA, "calculate names nothing");
    if (plan->v1 < 0 && plan->v1 != -1)
        return status_fail(BAD_DATA, "v1 = %g must not be below 0; -1 means: as separation says",
                           plan->v1);
    if (plan->v1 >= 0 && plan->separation != 0)
        return status_fail(BAD_DATA, "separation = %g stands beside v1 = %g; give one of the two",
                           plan->separation, plan->v1);
    if (schematic_model(plan).v1 < 0)
        return status_fail(BAD_DATA, "separation = %g makes v1 = %g; it must not be below 0",
                           plan->separation, schematic_model(plan).v1);
    TRY(check_shear(plan));
    if (plan->first_time >= plan->last_time)
        return status_fail(BAD_DATA, "times.first = %g is not below last = %g", plan->first_time,
                           plan->last_time);
    if (wants(plan, SCHEMATIC_FLOW_CURVE) && plan->first_rate >= plan->last_rate)
        return status_fail(BAD_DATA, "flow_curve.first = %g is not below last = %g",
                           plan->first_rate, plan->last_rate);
    if (plan->block % 4 != 0)
        return status_fail(BAD_DATA, "block = %lld is not a multiple of 4", (long long)plan->block);
    return OK;
}

static bool varies(const SchematicPlan *plan) {
    return schematic_oscillates(plan) || schematic_has_table(plan);
}

static double ages(const SchematicPlan *plan) {
    return (double)plan->moments * (schematic_oscillates(plan) ? (double)plan->periods : 1);
}

size_t schematic_memory(const SchematicPlan *plan) {
    const double lines = varies(plan) ? 4 * (double)plan->moments : 4;
    const double most = fmax((double)plan->block, varies(plan) ? ages(plan) : 0);
    return (size_t)(sizeof(double) * lines * most);
}

// About 1 ns a term of the memory integral.
double schematic_seconds(const SchematicPlan *plan) {
    const double block = (double)plan->block, line = 1e-9 * 40 * block * block / 2;
    double seconds = 2 * line;
    if (wants(plan, SCHEMATIC_FLOW_CURVE))
        seconds +=
            2 * line * (double)plan->rates_per_decade * log10(plan->last_rate / plan->first_rate);
    if (wants(plan, SCHEMATIC_YIELD_STRESS)) seconds += 20 * line;
    if (wants(plan, SCHEMATIC_CORRELATOR) && varies(plan))
        seconds += (double)plan->moments * (4 * line + 1e-9 * ages(plan) * ages(plan) / 2);
    return seconds;
}

void schematic_say_drive(Text *text, const SchematicPlan *plan) {
    if (schematic_oscillates(plan))
        text_add(text, "strain %.6g sin(%.6g t), %lld cycles", plan->amplitude, plan->frequency,
                 (long long)plan->periods);
    else if (schematic_has_table(plan))
        text_add(text, "shear of a table, for %.6g d^2/D0", plan->duration);
    else if (plan->shear_rate > 0)
        text_add(text, "shear rate %.6g D0/d^2", plan->shear_rate);
    else
        text_put(text, "at rest");
}
