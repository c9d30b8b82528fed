// SPDX-License-Identifier: GPL-3.0-or-later
// The section `itt` of a run file: its table, what cannot be, what it costs.
#include "itt/itt.h"

#include "base/constants.h"
#include "itt/input.h"
#include "itt/transient.h"
#include "oz/oz.h"

#include <math.h>

static const Option rows[] = {
    {.name = "structure",
     .type = OPTION_CHOICE,
     .offset = offsetof(IttPlan, structure),
     .fallback = CLOSURE_PERCUS_YEVICK,
     .unit = "",
     .about = "Where the structure factor at rest comes from: a closure of the Ornstein-Zernike "
              "equation, or a closed form for one species; or a simulation, as {file: results.h5}.",
     .choices = closure_names},
    MEASUREMENTS_OPTIONS(IttPlan, input.file, input.stage, input.groups),
    {.name = "packing_fraction",
     .type = OPTION_REAL,
     .offset = offsetof(IttPlan, packing_fraction),
     .least = 0,
     .most = 0.9,
     .unit = "",
     .about = "Fraction of the area that the discs fill; 0: as separation says."},
    {.name = "separation",
     .type = OPTION_REAL,
     .offset = offsetof(IttPlan, separation),
     .least = -0.9,
     .most = 0.1,
     .unit = "",
     .about = "Packing fraction over that of the glass transition at rest, less 1; used where "
              "packing_fraction is 0. The transition is found first, up to wave_numbers.last."},
    {.name = "wave_numbers.spacing",
     .type = OPTION_REAL,
     .offset = offsetof(IttPlan, spacing),
     .fallback = 0.3,
     .least = 0.05,
     .most = 2,
     .unit = "1/d",
     .about = "Spacing of the square grid of wave vectors: 0.3 gives the stress to 0.2 %, normal "
              "stress differences to some per cent."},
    {.name = "wave_numbers.last",
     .type = OPTION_REAL,
     .offset = offsetof(IttPlan, last_wave_number),
     .fallback = 30,
     .least = 8,
     .most = 100,
     .unit = "1/d",
     .about = "The largest length of a wave vector: 30 gives stresses of equal discs 2 % too "
              "low, of mixtures more."},
    {.name = "shear_rate",
     .type = OPTION_REAL,
     .offset = offsetof(IttPlan, shear_rate),
     .least = 1e-12,
     .most = 1e3,
     .unit = "D0/d^2",
     .about = "Rate of the shear that begins at time 0, along x with its gradient along y.",
     .required = 1},
    {.name = "strain",
     .type = OPTION_REAL,
     .offset = offsetof(IttPlan, last_strain),
     .fallback = 10,
     .least = 0.01,
     .most = 1e6,
     .unit = "",
     .about = "Strain at which the calculation ends: by 10 the flow is stationary, displacements "
              "may need more."},
    {.name = "block",
     .type = OPTION_INTEGER,
     .offset = offsetof(IttPlan, block),
     .fallback = 64,
     .least = 32,
     .most = 1024,
     .unit = "",
     .about = "Points of a block of the time grid, whose spacing then doubles: errors are of "
              "second order in 1/block."},
    {.name = "tagged",
     .type = OPTION_BOOLEAN,
     .offset = offsetof(IttPlan, tagged),
     .fallback = 1,
     .unit = "",
     .about = "Also a tagged particle, its correlator and displacements: 1.5 times the cost."},
    {.name = "correlators.wave_numbers",
     .type = OPTION_REALS,
     .offset = offsetof(IttPlan, wave_numbers),
     .least = 0.5,
     .most = 100,
     .unit = "1/d",
     .about = "Wave numbers of the correlators that are kept, along x, y and the diagonals; empty: "
              "that of the peak of the structure factor."},
    {.name = "correlators.times.first",
     .type = OPTION_REAL,
     .offset = offsetof(IttPlan, first_time),
     .fallback = 1e-4,
     .least = 1e-9,
     .most = 1e9,
     .unit = "d^2/D0",
     .about = "The first time that is kept."},
    {.name = "correlators.times.per_decade",
     .type = OPTION_INTEGER,
     .offset = offsetof(IttPlan, times_per_decade),
     .fallback = 20,
     .least = 1,
     .most = 50,
     .unit = "",
     .about = "Times kept per decade."},
};
const OptionTable itt_options = {rows, sizeof rows / sizeof *rows, sizeof(IttPlan)};

static Status check_wave_numbers(const IttPlan *plan) {
    const double least = 4;
    if (plan->last_wave_number / plan->spacing < 10)
        return status_fail(BAD_DATA,
                           "wave_numbers.last = %g is less than ten times the spacing = %g",
                           plan->last_wave_number, plan->spacing);
    for (int64_t i = 0; i < plan->wave_numbers.count; i++) {
        const double q = plan->wave_numbers.values[i];
        if (q + least * plan->spacing > plan->last_wave_number)
            return status_fail(BAD_DATA,
                               "correlators.wave_numbers: %g is not well below "
                               "wave_numbers.last = %g",
                               q, plan->last_wave_number);
    }
    return OK;
}

void itt_complete(IttPlan *plan) {
    theory_complete_species(plan->species, plan->species_count);
    if (plan->input.file[0]) plan->structure = CLOSURE_MEASURED;
}

Status itt_check(const IttPlan *plan) {
    TRY(theory_check_species(plan->species, plan->species_count));
    if (plan->structure == CLOSURE_MEASURED && !plan->input.file[0])
        return status_fail(BAD_DATA, "a measured structure needs a file; write structure: {file: "
                                     "results.h5}");
    if (plan->structure == CLOSURE_VERLET_WEIS)
        return status_fail(BAD_DATA, "structure = %s is for spheres; itt is for discs",
                           itt_structure_name(plan));
    if (oz_is_of_one_species((Closure)plan->structure) && plan->species_count > 1)
        return status_fail(BAD_DATA, "structure = %s is for one species, not %zu",
                           itt_structure_name(plan), plan->species_count);
    if (plan->packing_fraction != 0 && plan->separation != 0)
        return status_fail(BAD_DATA,
                           "separation = %g stands beside packing_fraction = %g; give "
                           "one of the two",
                           plan->separation, plan->packing_fraction);
    if (plan->packing_fraction == 0 && plan->separation == 0)
        return status_fail(BAD_DATA, "itt needs a packing_fraction or a separation");
    if (plan->block % 4 != 0)
        return status_fail(BAD_DATA, "block = %lld is not a multiple of 4", (long long)plan->block);
    if (plan->first_time * plan->shear_rate >= plan->last_strain)
        return status_fail(BAD_DATA, "correlators.times: first = %g is not before the strain of %g",
                           plan->first_time, plan->last_strain);
    return check_wave_numbers(plan);
}

static const TheorySpecies equal_discs = {"disc", 1, 1, 1};

const TheorySpecies *itt_species(const IttPlan *plan, size_t *count) {
    *count = plan->species_count > 0 ? plan->species_count : 1;
    return plan->species_count > 0 ? plan->species : &equal_discs;
}

Mixture itt_mixture(const IttPlan *plan) {
    size_t count;
    const TheorySpecies *species = itt_species(plan, &count);
    return theory_mixture_of(2, species, count);
}

MeasurementsInput itt_input(const IttPlan *plan) {
    return (MeasurementsInput){plan->input.file, plan->input.stage, itt_mixture(plan),
                               plan->separation != 0};
}

Status itt_check_input(const IttPlan *plan, uint32_t *checksum) {
    const MeasurementsInput input = itt_input(plan);
    *checksum = 0;
    return plan->structure == CLOSURE_MEASURED ? measurements_check(&input, checksum) : OK;
}

size_t itt_memory(const IttPlan *plan) {
    const TransientSettings settings = {
        .shear_rate = plan->shear_rate, .block = (size_t)plan->block, .tagged = plan->tagged != 0};
    const size_t species = itt_mixture(plan).species;
    return transient_memory(plan->last_wave_number, plan->spacing, species, &settings);
}

// About 2 us per column and row of the half plane, pair of species and kernel; 2.5 kernels at each
// time.
double itt_seconds(const IttPlan *plan) {
    const double columns = plan->last_wave_number / plan->spacing;
    const double begin = 1e-3 / pow(plan->last_wave_number, 2);
    const double doublings = log2(plan->last_strain / plan->shear_rate / begin);
    const double kernel = 2.7e-3 * pow(columns / 100, 2) * log(columns) / log(100);
    const double species = (double)itt_mixture(plan).species;
    const double kernels = species * species + (plan->tagged ? 0.7 * species : 0);
    return 1 + kernel * 2.5 * (double)plan->block / 2 * fmax(1, doublings) * kernels;
}

const char *itt_structure_name(const IttPlan *plan) {
    return plan->structure == CLOSURE_MEASURED ? plan->input.file : closure_names[plan->structure];
}
