// SPDX-License-Identifier: GPL-3.0-or-later
// The section `theory` of a run file: its tables, what cannot be, what it costs.
#include "theory/input.h"

#include "base/nearest.h"
#include "oz/oz.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const parts[] = {"structure_factor", "glass_form_factors", "critical_point",
                                    "exponents",        "correlators",        "beta_scaling",
                                    "alpha_master",     "flow_curve",         NULL};

static const Option rows[] = {
    {.name = "dimension",
     .type = OPTION_INTEGER,
     .offset = offsetof(TheoryPlan, dimension),
     .least = 2,
     .most = 3,
     .unit = "",
     .about = "2: hard discs, 3: hard spheres.",
     .required = 1},
    {.name = "structure",
     .type = OPTION_CHOICE,
     .offset = offsetof(TheoryPlan, structure),
     .fallback = CLOSURE_PERCUS_YEVICK,
     .unit = "",
     .about = "Where the structure factors come from: a closure of the Ornstein-Zernike equation, "
              "or a closed form for one species; or a simulation, as {file: results.h5}.",
     .choices = closure_names},
    MEASUREMENTS_OPTIONS(TheoryPlan, input.file, input.stage, input.groups),
    {.name = "packing_fraction",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, packing_fraction),
     .least = 0,
     .most = 0.95,
     .unit = "",
     .about = "Fraction of the area or volume that the particles fill; 0: as separation says."},
    {.name = "separation",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, separation),
     .least = -0.9,
     .most = 0.3,
     .unit = "",
     .about = "Packing fraction over that of the glass transition, less 1; used where "
              "packing_fraction is 0. The transition is found first."},
    {.name = "wave_numbers.count",
     .type = OPTION_INTEGER,
     .offset = offsetof(TheoryPlan, wave_numbers),
     .fallback = 200,
     .least = 10,
     .most = 5000,
     .unit = "",
     .about = "How many wave numbers: about last times 16 d/pi gives six digits."},
    {.name = "wave_numbers.last",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, last_wave_number),
     .fallback = 40,
     .least = 5,
     .most = 2000,
     .unit = "1/d",
     .about = "The largest wave number: 40 gives phi_c to 1e-5, 60 to 1e-6; times of the "
              "final decay at 40 are some third too short."},
    {.name = "calculate",
     .type = OPTION_CHOICES,
     .offset = offsetof(TheoryPlan, calculate),
     .unit = "",
     .about = "What is calculated.",
     .choices = parts,
     .fallback_text = "[structure_factor, glass_form_factors, critical_point, exponents]"},
    {.name = "search.key",
     .type = OPTION_TEXT,
     .offset = offsetof(TheoryPlan, search_key),
     .unit = "",
     .about = "What the glass transition is searched along, as in a sweep: "
              "theory.packing_fraction, or with packing_fraction held, "
              "theory.species.NAME.fraction, where the other species share the rest as they do, "
              "or theory.species.NAME.diameter. Empty: the packing fraction."},
    {.name = "search.low",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, search_low),
     .fallback = 0,
     .least = 0,
     .most = 100,
     .unit = "",
     .about = "Where the search begins: packing fraction of a fluid; 0: 0.6 of discs, 0.45 of "
              "spheres. Along another key, a fluid or a glass."},
    {.name = "search.high",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, search_high),
     .fallback = 0,
     .least = 0,
     .most = 100,
     .unit = "",
     .about = "Where it ends: packing fraction of a glass; 0: 0.74 of discs, 0.57 of spheres. "
              "Along another key, the other of the two."},
    {.name = "correlators.wave_numbers",
     .type = OPTION_REALS,
     .offset = offsetof(TheoryPlan, correlator_wave_numbers),
     .least = 0.01,
     .most = 2000,
     .unit = "1/d",
     .about = "Wave numbers of the correlators that are kept, each the nearest there is; empty: "
              "that of the peak of the total structure factor."},
    {.name = "correlators.times.first",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, first_time),
     .fallback = 1e-5,
     .least = 1e-12,
     .most = 1e12,
     .unit = "d^2/D0",
     .about = "The first time of the correlators that is kept."},
    {.name = "correlators.times.last",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, last_time),
     .fallback = 1e6,
     .least = 1e-11,
     .most = 1e15,
     .unit = "d^2/D0",
     .about = "The last time of the correlators."},
    {.name = "correlators.times.per_decade",
     .type = OPTION_INTEGER,
     .offset = offsetof(TheoryPlan, times_per_decade),
     .fallback = 10,
     .least = 1,
     .most = 50,
     .unit = "",
     .about = "Times kept per decade."},
    {.name = "correlators.block",
     .type = OPTION_INTEGER,
     .offset = offsetof(TheoryPlan, block),
     .fallback = 128,
     .least = 32,
     .most = 4096,
     .unit = "",
     .about = "Points of a block of the time grid, whose spacing then doubles: errors are of "
              "second order in 1/block."},
    {.name = "beta_scaling.shear",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, beta_shear),
     .fallback = 0,
     .least = 0,
     .most = 1e6,
     .unit = "",
     .about = "c (shear rate t_sigma)^2 of the beta-scaling functions under shear; 0: at rest. The "
              "result shear_coefficient is c, of the isotropically sheared model."},
    {.name = "flow_curve.first",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, first_rate),
     .fallback = 1e-5,
     .least = 1e-12,
     .most = 1e4,
     .unit = "D0/d^2",
     .about =
         "The smallest shear rate of the flow curve, which is that of the isotropically sheared "
         "model: of the flow only the mean stretching of wave numbers is kept. One species."},
    {.name = "flow_curve.last",
     .type = OPTION_REAL,
     .offset = offsetof(TheoryPlan, last_rate),
     .fallback = 10,
     .least = 1e-12,
     .most = 1e4,
     .unit = "D0/d^2",
     .about = "The largest."},
    {.name = "flow_curve.per_decade",
     .type = OPTION_INTEGER,
     .offset = offsetof(TheoryPlan, rates_per_decade),
     .fallback = 2,
     .least = 1,
     .most = 50,
     .unit = "",
     .about = "Shear rates per decade."},
};
const OptionTable theory_options = {rows, sizeof rows / sizeof *rows, sizeof(TheoryPlan)};

static const Option species_rows[] = {
    {.name = "diameter",
     .type = OPTION_REAL,
     .offset = offsetof(TheorySpecies, diameter),
     .fallback = 1,
     .least = 0.01,
     .most = 100,
     .unit = "d",
     .about = "Diameter of the particles."},
    {.name = "fraction",
     .type = OPTION_REAL,
     .offset = offsetof(TheorySpecies, fraction),
     .fallback = 0,
     .least = 0,
     .most = 1,
     .unit = "",
     .about = "Fraction of the number of particles; those of all species add to 1. One species may "
              "leave it out, and is what the others leave."},
    {.name = "free_diffusion",
     .type = OPTION_REAL,
     .offset = offsetof(TheorySpecies, diffusion),
     .fallback = 1,
     .least = 1e-6,
     .most = 1e6,
     .unit = "D0",
     .about = "Free diffusion coefficient, in that of the first species."},
};
const OptionTable theory_species_options = {
    species_rows, sizeof species_rows / sizeof *species_rows, sizeof(TheorySpecies)};

static bool wants(const TheoryPlan *plan, TheoryPart part) {
    return plan->calculate >> part & 1;
}

void theory_complete_species(TheorySpecies *species, size_t count) {
    double sum = 0;
    TheorySpecies *rest = NULL;
    for (size_t a = 0; a < count; a++) {
        sum += species[a].fraction;
        if (species[a].fraction == 0) rest = &species[a];
    }
    if (rest) rest->fraction = fmax(0, 1 - sum);
}

void theory_complete(TheoryPlan *plan) {
    theory_complete_species(plan->species, plan->species_count);
    if (plan->input.file[0]) plan->structure = CLOSURE_MEASURED;
}

static bool wants_transition(const TheoryPlan *plan) {
    return wants(plan, THEORY_CRITICAL) || wants(plan, THEORY_EXPONENTS) ||
           wants(plan, THEORY_BETA) || wants(plan, THEORY_MASTER) || plan->separation != 0;
}

Status theory_check_species(const TheorySpecies *species, size_t count) {
    for (size_t a = 0; a < count; a++) {
        if (!(species[a].fraction > 0))
            return status_fail(BAD_DATA, "species '%s' has no fraction that the others leave",
                               species[a].name);
    }
    return OK;
}

static bool has_state(const TheoryPlan *plan) {
    return plan->packing_fraction != 0 || plan->separation != 0;
}

static Status check_flow_curve(const TheoryPlan *plan) {
    if (!wants(plan, THEORY_FLOW_CURVE)) return OK;
    if (plan->species_count > 1)
        return status_fail(BAD_DATA, "calculate = flow_curve is of one species, not %zu",
                           plan->species_count);
    if (!has_state(plan))
        return status_fail(BAD_DATA,
                           "calculate = flow_curve needs a packing_fraction or a separation");
    if (plan->first_rate >= plan->last_rate)
        return status_fail(BAD_DATA, "flow_curve.first = %g is not below last = %g",
                           plan->first_rate, plan->last_rate);
    return OK;
}

enum { SEARCH_KEYS_MOST = 1 + 2 * MIXTURE_SPECIES_MOST };
typedef struct SearchKeys {
    size_t count;
    char text[SEARCH_KEYS_MOST][OPTION_TEXT_SIZE];
} SearchKeys;

// The packing fraction, then fraction and diameter of each species.
static void list_search_keys(SearchKeys *keys, const TheoryPlan *plan) {
    keys->count = 1;
    snprintf(keys->text[0], OPTION_TEXT_SIZE, "theory.packing_fraction");
    for (size_t i = 0; i < 2 * plan->species_count; i++)
        snprintf(keys->text[keys->count++], OPTION_TEXT_SIZE, "theory.species.%s.%s",
                 plan->species[i / 2].name, i % 2 ? "diameter" : "fraction");
}

// Which of them it is; `count` if none.
static size_t search_key(const SearchKeys *keys, const TheoryPlan *plan) {
    size_t k = 0;
    if (!plan->search_key[0]) return 0;
    while (k < keys->count && strcmp(keys->text[k], plan->search_key) != 0) k++;
    return k;
}

MixtureAxis theory_search_axis(const TheoryPlan *plan, size_t *species) {
    SearchKeys keys;
    list_search_keys(&keys, plan);
    const size_t k = search_key(&keys, plan);
    *species = k > 0 ? (k - 1) / 2 : 0;
    return k == 0 ? MIXTURE_PACKING_FRACTION : k % 2 ? MIXTURE_FRACTION : MIXTURE_DIAMETER;
}

static Status check_search_key(const TheoryPlan *plan) {
    SearchKeys keys;
    const char *words[SEARCH_KEYS_MOST];
    list_search_keys(&keys, plan);
    if (search_key(&keys, plan) < keys.count) return OK;
    for (size_t k = 0; k < keys.count; k++) words[k] = keys.text[k];
    const size_t near = nearest_word(plan->search_key, words, keys.count);
    return status_fail(BAD_DATA, "search.key = '%s' is nothing to search along; %s '%s'%s",
                       plan->search_key,
                       near < keys.count ? "did you mean" : "expected one such as",
                       words[near < keys.count ? near : 1], near < keys.count ? "?" : "");
}

// Along a number of a species.
static Status check_search_along(const TheoryPlan *plan, MixtureAxis axis) {
    if (plan->structure == CLOSURE_MEASURED)
        return status_fail(BAD_DATA,
                           "search.key = %s: a measured structure is known along the "
                           "packing fraction alone",
                           plan->search_key);
    if (plan->species_count < 2)
        return status_fail(BAD_DATA, "search.key = %s: of one species nothing changes along it",
                           plan->search_key);
    if (plan->packing_fraction == 0)
        return status_fail(BAD_DATA, "search.key = %s needs the packing_fraction that is held",
                           plan->search_key);
    if (wants(plan, THEORY_MASTER))
        return status_fail(BAD_DATA,
                           "search.key = %s: alpha_master is of a transition along the packing "
                           "fraction; search along that for the mixture that freezes",
                           plan->search_key);
    if (plan->search_low == 0 || plan->search_high == 0)
        return status_fail(BAD_DATA, "search.key = %s needs search.low and search.high",
                           plan->search_key);
    if (axis == MIXTURE_FRACTION && plan->search_high >= 1)
        return status_fail(BAD_DATA,
                           "search.high = %g is no fraction of a mixture; expected less "
                           "than 1",
                           plan->search_high);
    return OK;
}

static Status check_search(const TheoryPlan *plan) {
    static const double DENSEST = 0.95;
    size_t species;
    TRY(check_search_key(plan));
    const MixtureAxis axis = theory_search_axis(plan, &species);
    if (axis != MIXTURE_PACKING_FRACTION) TRY(check_search_along(plan, axis));
    if (axis == MIXTURE_PACKING_FRACTION && fmax(plan->search_low, plan->search_high) > DENSEST)
        return status_fail(BAD_DATA, "search.%s = %g is no packing fraction; expected at most %g",
                           plan->search_low > DENSEST ? "low" : "high",
                           fmax(plan->search_low, plan->search_high), DENSEST);
    if (plan->search_low != 0 && plan->search_high != 0 && plan->search_low >= plan->search_high)
        return status_fail(BAD_DATA, "search.low = %g is not below search.high = %g",
                           plan->search_low, plan->search_high);
    return OK;
}

static Status check_structure(const TheoryPlan *plan) {
    if (plan->structure == CLOSURE_MEASURED)
        return plan->input.file[0] ? OK
                                   : status_fail(BAD_DATA, "a measured structure needs a file; "
                                                           "write structure: {file: results.h5}");
    const int dimension = oz_dimension_of((Closure)plan->structure);
    if (dimension && dimension != plan->dimension)
        return status_fail(BAD_DATA, "structure = %s is for dimension %d, not %d",
                           theory_structure_name(plan), dimension, (int)plan->dimension);
    if (oz_is_of_one_species((Closure)plan->structure) && plan->species_count > 1)
        return status_fail(BAD_DATA, "structure = %s is for one species, not %zu",
                           theory_structure_name(plan), plan->species_count);
    return OK;
}

static Status check_correlators(const TheoryPlan *plan) {
    if (!wants(plan, THEORY_CORRELATORS) && !wants(plan, THEORY_MASTER)) return OK;
    for (int64_t i = 0; i < plan->correlator_wave_numbers.count; i++) {
        if (plan->correlator_wave_numbers.values[i] > plan->last_wave_number)
            return status_fail(BAD_DATA,
                               "correlators.wave_numbers = %g is above wave_numbers.last = %g",
                               plan->correlator_wave_numbers.values[i], plan->last_wave_number);
    }
    if (!wants(plan, THEORY_CORRELATORS)) return OK;
    if (plan->first_time >= plan->last_time)
        return status_fail(BAD_DATA, "correlators.times: first = %g is not below last = %g",
                           plan->first_time, plan->last_time);
    if (!has_state(plan))
        return status_fail(BAD_DATA,
                           "calculate = correlators needs a packing_fraction or a separation");
    return OK;
}

Status theory_check(const TheoryPlan *plan) {
    TRY(theory_check_species(plan->species, plan->species_count));
    TRY(check_structure(plan));
    if (plan->calculate == 0) return status_fail(BAD_DATA, "calculate names nothing");
    if (plan->packing_fraction != 0 && plan->separation != 0)
        return status_fail(BAD_DATA,
                           "separation = %g stands beside packing_fraction = %g; give "
                           "one of the two",
                           plan->separation, plan->packing_fraction);
    TRY(check_search(plan));
    if (!has_state(plan) && !wants_transition(plan))
        return status_fail(BAD_DATA,
                           "calculate = [...] is of a state, and needs a packing_fraction or a "
                           "separation");
    TRY(check_correlators(plan));
    TRY(check_flow_curve(plan));
    if (plan->block % 4 != 0)
        return status_fail(BAD_DATA, "correlators.block = %lld is not a multiple of 4",
                           (long long)plan->block);
    return OK;
}

Mixture theory_mixture_of(int dimension, const TheorySpecies *species, size_t count) {
    Mixture mixture = {.dimension = dimension, .species = count};
    for (size_t a = 0; a < count; a++) {
        mixture.diameter[a] = species[a].diameter;
        mixture.fraction[a] = species[a].fraction;
    }
    return mixture;
}

Mixture theory_mixture(const TheoryPlan *plan) {
    return theory_mixture_of((int)plan->dimension, plan->species, plan->species_count);
}

MeasurementsInput theory_input(const TheoryPlan *plan) {
    return (MeasurementsInput){plan->input.file, plan->input.stage, theory_mixture(plan),
                               wants_transition(plan)};
}

Status theory_check_input(const TheoryPlan *plan, uint32_t *checksum) {
    const MeasurementsInput input = theory_input(plan);
    *checksum = 0;
    return plan->structure == CLOSURE_MEASURED ? measurements_check(&input, checksum) : OK;
}

size_t theory_memory(const TheoryPlan *plan) {
    const double species = (double)plan->species_count, waves = (double)plan->wave_numbers;
    const double tables = 3 * 1.5 * waves * waves, unknowns = 100 * species * species;
    const double histories = 4 * (double)plan->block * species * (species + 3) / 2 * waves;
    return (size_t)(sizeof(double) * (tables + histories + 8000 * unknowns + unknowns * unknowns));
}

// Kernel evaluations cost about 1 ns per pair of a wave number and a radius, and pair of species.
double theory_seconds(const TheoryPlan *plan) {
    const double species = (double)plan->species_count, waves = (double)plan->wave_numbers;
    const double kernel = 1e-9 * 1.5 * waves * waves * species * (species + 1) / 2;
    double evaluations = 200;
    if (wants_transition(plan)) evaluations += 4000;
    if (wants(plan, THEORY_CORRELATORS))
        evaluations += 3.5 * (double)plan->block * log2(plan->last_time / 1e-8);
    if (wants(plan, THEORY_FLOW_CURVE))
        evaluations += 150 * (double)plan->block * (double)plan->rates_per_decade *
                       log10(plan->last_rate / plan->first_rate);
    // Along another number than the packing fraction each mixture is solved anew.
    const double solving = plan->search_key[0] ? 12 : 1;
    return 0.3 * species * solving + kernel * evaluations;
}

const char *theory_structure_name(const TheoryPlan *plan) {
    return plan->structure == CLOSURE_MEASURED ? plan->input.file : closure_names[plan->structure];
}
