// SPDX-License-Identifier: GPL-3.0-or-later
// Cross-checks of a plan. The modules judge what they know (method, packing, observables); this
// file adds the place, and checks first what has a better place than they could know.
#include "config/judge.h"

#include "base/constants.h"
#include "base/nearest.h"
#include "base/number.h"
#include "config/faults.h"
#include "config/options.h"
#include "packing/packing.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static const double FRACTIONS_OFF = 1e-9; // how far their sum may be from 1

// The value at a path of keys below `node`, or the deepest there is: a place to point to.
static const Node *place(const Node *node, const char *first, const char *second) {
    const Node *inner = node && first ? tree_find(node, first) : NULL;
    if (!inner) return node;
    const Node *innermost = second ? tree_find(inner, second) : NULL;
    return innermost ? innermost : inner;
}

static const Node *nth(const Node *parent, size_t index) {
    const Node *node = parent->first;
    for (; index > 0; index--) node = node->next;
    return node;
}

static const Node *species_map(const Node *root) {
    const Node *system = tree_find(root, "system");
    const Node *theory = tree_find(root, "theory");
    return place(system ? system : theory ? theory : tree_find(root, "itt"), "species", NULL);
}

// The species that the sentence names in quotes, "... species 'NAME' ..."; NULL if none.
static const Node *species_named(const Node *root, const char *sentence) {
    static const char before[] = "species '";
    const char *begin = strstr(sentence, before);
    if (!begin) return NULL;
    begin += sizeof before - 1;
    const size_t length = strcspn(begin, "'");
    char name[NAME_SIZE] = "";
    if (length >= NAME_SIZE) return NULL;
    memcpy(name, begin, length);
    return tree_find(species_map(root), name);
}

// The key that the sentence begins with, as in "KEY = 3 is ..." or "KEY.PART = 3 is ...".
static void key_of(char key[NAME_SIZE], const char *sentence) {
    const char *equals = strstr(sentence, " = ");
    const size_t length = strcspn(sentence, ". ");
    key[0] = '\0';
    if (!equals || sentence + length > equals || length >= NAME_SIZE) return;
    memcpy(key, sentence, length);
    key[length] = '\0';
}

// A module's own sentence, at the key that it begins with if that stands in `node`, in the species
// that it names or in the system; else at that species, else at `node`.
static Status placed(const Node *root, const Node *node, Status status) {
    if (status != BAD_DATA) return status;
    char key[NAME_SIZE];
    const char *sentence = status_sentence();
    key_of(key, sentence);
    const Node *species = species_named(root, sentence);
    const bool of_species = strncmp(sentence, "species '", strlen("species '")) == 0;
    const Node *system = tree_find(root, "system"); // a run of the theory has none
    const Node *places[] = {tree_find(node, key), species ? tree_find(species, key) : NULL,
                            system ? tree_find(system, key) : NULL,
                            of_species || key[0] ? species : NULL, node};
    size_t first = 0;
    while (!places[first]) first++;
    return tree_fail(places[first], "%s", sentence);
}

// A distribution without a width, or a width without a distribution, would be equal sizes unseen.
static Status judge_spread(const Node *node, const Species *species) {
    const bool distributed = species->spread != SPREAD_NONE, wide = species->spread_width > 0;
    if (distributed == wide) return OK;
    if (wide)
        return tree_fail(place(node, "spread", "width"),
                         "width = %g without a distribution; expected spread: {distribution: "
                         "gaussian, width: %g} or uniform",
                         species->spread_width, species->spread_width);
    return tree_fail(place(node, "spread", "distribution"),
                     "distribution = %s without a width; expected spread: {distribution: %s, "
                     "width: 0.1}",
                     spread_names[species->spread], spread_names[species->spread]);
}

// A size that the shape has not would be left out unseen; one that it must have is not guessed. A
// plan.yaml has all keys, with their defaults.
static Status judge_sizes(const Node *node, const Species *species) {
    const double not_given = option_named(&species_options, "exponent")->fallback;
    const Node *length = tree_find(node, "length"), *exponent = tree_find(node, "exponent");
    const char *shape = shape_names[species->shape];
    if (species->length > 0 && species->shape != SHAPE_SPHEROCYLINDER)
        return tree_fail(length, "length = %g is that of a spherocylinder; a %s has none",
                         species->length, shape);
    if (!length && species->shape == SHAPE_SPHEROCYLINDER)
        return tree_fail(place(node, "shape", NULL),
                         "a spherocylinder needs its length: that of the cylinder without caps, in "
                         "d, such as length: 5");
    if (species->exponent != not_given && species->shape != SHAPE_SOFT_SPHERE)
        return tree_fail(exponent, "exponent = %g is that of a soft-sphere; a %s is hard",
                         species->exponent, shape);
    if (species->exponent != floor(species->exponent))
        return tree_fail(exponent, "exponent = %g must be a whole number", species->exponent);
    return OK;
}

static Status judge_one_species(const Node *node, const System *system, const Species *species) {
    const ShapeKind shape = (ShapeKind)species->shape;
    if (shape_dimension(shape) != (int)system->dimension)
        return tree_fail(place(node, "shape", NULL),
                         "shape = %s lives in %d dimensions, but dimension = %d",
                         shape_names[shape], shape_dimension(shape), (int)system->dimension);
    TRY(judge_sizes(node, species));
    return judge_spread(node, species);
}

static Status judge_every_species(const Node *map, const System *system) {
    Faults faults = {0};
    for (size_t s = 0; s < system->species_count; s++) {
        TRY(faults_keep(&faults, judge_one_species(nth(map, s), system, &system->species[s])));
    }
    return faults_tell(&faults);
}

// Smallest over largest diameter, as far as the widths of the spreads say.
static double size_ratio(const System *system) {
    double least = INFINITY, most = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        static const double reach[SPREADS] = {0, 3, 1.7320508075688772}; // in standard deviations
        const double width = reach[species->spread] * species->spread_width;
        least = fmin(least, species->diameter * (1 - width));
        most = fmax(most, species->diameter * (1 + width));
    }
    return fmax(least, 0) / most;
}

// No arrangement is denser. Discs: Florian, Rend. Circ. Mat. Palermo 9, 300 (1960), the density in
// the triangle of two large discs and a small one. Spheres of k sizes: each size may at best fill
// the holes of the larger ones as densely as equal spheres fill space.
static double densest_packing(const System *system) {
    const Body first = species_body(&system->species[0]);
    const double equal = shape_densest_packing(&first);
    const double q = size_ratio(system);
    if (q == 1) return equal;
    if (system->dimension == 2 && q > 0)
        return (PI * q * q + 2 * (1 - q * q) * asin(q / (1 + q))) / (2 * q * sqrt(2 * q + 1));
    for (size_t s = 0; s < system->species_count; s++) {
        if (system->species[s].spread_width > 0) return 1;
    }
    return 1 - pow(1 - equal, (double)system->species_count);
}

static const char *what_packs(const System *system) {
    if (system_is_oriented(system)) return "bodies of these sizes";
    if (system->dimension == 2)
        return size_ratio(system) == 1 ? "equal discs" : "discs of these sizes";
    return size_ratio(system) == 1 ? "equal spheres" : "spheres of these sizes";
}

static Status judge_density(const Node *root, const Node *map, const System *system) {
    const Node *fraction = tree_find(map, "packing_fraction");
    const Node *density = tree_find(map, "number_density");
    if (fraction && density)
        return tree_fail(density, "packing_fraction is given as well; one of the two is enough");
    if (!fraction && !density)
        return tree_fail(map, "system needs packing_fraction or number_density");
    const Node *given = fraction ? fraction : density;
    if (fraction && !(system_mean_volume(system) > 0))
        return tree_fail(fraction, "packing_fraction: these particles have no volume; give "
                                   "number_density, in d^-3");
    const double value = fraction ? system->packing_fraction : system->number_density;
    if (!(value > 0)) return tree_fail(given, "%s = %g must be above 0", given->key, value);
    const double packing = system_packing_fraction(system), densest = densest_packing(system);
    if (packing > densest)
        return tree_fail(given, "packing_fraction = %.6g%s exceeds %.6g, the densest packing of %s",
                         packing, fraction ? "" : ", which this number_density gives,", densest,
                         what_packs(system));
    return placed(root, given, packing_check(system));
}

static Status judge_aspect(const Node *map, const System *system) {
    if (system->aspect.count == 0 || system->aspect.count == system->dimension) return OK;
    return tree_fail(place(map, "box", "aspect"),
                     "box.aspect has %d numbers; a box in %d dimensions has %d edges",
                     (int)system->aspect.count, (int)system->dimension, (int)system->dimension);
}

// The density follows from bodies that are right.
static Status judge_system(const Node *root, const System *system) {
    const Node *map = tree_find(root, "system"), *species = tree_find(map, "species");
    Faults faults = {0};
    TRY(faults_keep(&faults, judge_aspect(map, system)));
    TRY(faults_keep(&faults, judge_every_species(species, system)));
    if (faults.count == 0)
        TRY(faults_keep(&faults, placed(root, species, system_check_counts(system))));
    if (faults.count == 0) TRY(faults_keep(&faults, judge_density(root, map, system)));
    return faults_tell(&faults);
}

static Status judge_stage_name(const Node *protocol, const Plan *plan, size_t stage) {
    for (size_t other = 0; other < stage; other++) {
        if (strcmp(plan->stages[stage].name, plan->stages[other].name) == 0)
            return tree_fail(place(nth(protocol, stage), "stage", NULL),
                             "two stages are called '%s'; results need a name for each",
                             plan->stages[stage].name);
    }
    return OK;
}

static Status judge_method(const Node *root, const Node *node, const Plan *plan,
                           const Stage *stage) {
    static const double TICKS_MOST = 1e18; // plan_clock has room for more
    static const double ROUNDING = 1e-6;
    const Node *own = tree_find(node, "dynamics");
    const PropagatorKind *kind = stage->dynamics.kind;
    TRY(placed(root, own ? own : tree_find(root, "dynamics"),
               kind->check(&stage->dynamics.settings, &plan->system)));
    if (!tree_find(node, "time") && !tree_find(node, "strain"))
        return tree_fail(node, "stage '%s' needs a time%s", stage->name,
                         stage->drive.flow.rate != 0 ? ", or a strain at which it ends" : "");
    TRY(placed(root, node, stage_check_drive(plan, (size_t)(stage - plan->stages))));
    TRY(placed(root, node, stage_check_until(plan, (size_t)(stage - plan->stages))));
    const double tick = kind->tick(&stage->dynamics.settings, &plan->system);
    const double time = stage_time(stage);
    const Node *end = place(node, stage->time > 0 ? "time" : "strain", NULL);
    if (time / tick < 1 - ROUNDING)
        return tree_fail(end, "time = %g %s is less than a single step of %g", time,
                         kind->time_unit, tick);
    if (time / tick < TICKS_MOST) return OK;
    return tree_fail(end, "time = %g %s is more than %g steps of %g", time, kind->time_unit,
                     TICKS_MOST, tick);
}

static Status judge_stage(const Node *root, const Plan *plan, size_t index) {
    const Node *protocol = tree_find(root, "protocol");
    const Node *node = nth(protocol, index);
    const Stage *stage = &plan->stages[index];
    TRY(judge_stage_name(protocol, plan, index));
    TRY(judge_method(root, node, plan, stage));
    const Clock clock = plan_clock(plan, index);
    Faults faults = {0};
    for (size_t k = 0; k < stage->observation_count; k++) {
        const Observation *observation = &stage->observations[k];
        if (!observation->kind->check) continue;
        TRY(faults_keep(&faults, placed(root, nth(tree_find(node, "observe"), k),
                                        observation->kind->check(&observation->settings,
                                                                 &plan->system, &clock))));
    }
    return faults_tell(&faults);
}

static Status judge_output(const Node *root, const Plan *plan) {
    const char *recorded = plan->output.trajectory_stage, *names[STAGES_MOST];
    if (recorded[0] == '\0') return OK;
    for (size_t s = 0; s < plan->stage_count; s++) {
        names[s] = plan->stages[s].name;
        if (strcmp(names[s], recorded) == 0) return OK;
    }
    const size_t nearest = nearest_word(recorded, names, plan->stage_count);
    const Node *trajectory = place(tree_find(root, "output"), "trajectory", "stage");
    return tree_fail(trajectory, "trajectory.stage: there is no stage '%s'; did you mean %s?",
                     recorded, names[nearest < plan->stage_count ? nearest : 0]);
}

// Where nothing flies, a mass would be without effect.
static Status judge_masses(const Node *root, const Plan *plan) {
    for (size_t s = 0; s < plan->stage_count; s++) {
        if (plan->stages[s].dynamics.kind->flies) return OK;
    }
    for (size_t s = 0; s < plan->system.species_count; s++) {
        const Node *mass = tree_find(nth(species_map(root), s), "mass");
        if (!mass || plan->system.species[s].mass == 1) continue;
        return tree_fail(mass,
                         "mass = %g has no effect: particles of Monte Carlo have no "
                         "velocities; diffusion: {parallel: ...} says how fast they are",
                         plan->system.species[s].mass);
    }
    return OK;
}

Status judge_plan(const Node *root, const Plan *plan) {
    TRY(judge_system(root, &plan->system));
    Faults faults = {0};
    TRY(faults_keep(&faults, judge_masses(root, plan)));
    for (size_t s = 0; s < plan->stage_count; s++)
        TRY(faults_keep(&faults, judge_stage(root, plan, s)));
    TRY(faults_keep(&faults, judge_output(root, plan)));
    TRY(faults_tell(&faults));
    return placed(root, root, plan_check(plan));
}

// `map` is the section whose species these are; what they lack is told by the module itself.
static Status judge_fractions(const Node *map, const TheorySpecies *species, size_t count) {
    double sum = 0;
    bool complete = count > 0;
    for (size_t a = 0; a < count; a++) {
        complete = complete && species[a].fraction > 0;
        sum += species[a].fraction;
    }
    if (!complete || fabs(sum - 1) <= FRACTIONS_OFF) return OK;
    return tree_fail(tree_find(map, "species"),
                     "the fractions of the species add to %.10g; they must add to 1", sum);
}

Status judge_theory(const Node *root, const TheoryPlan *theory) {
    const Node *map = tree_find(root, "theory");
    TRY(judge_fractions(map, theory->species, theory->species_count));
    return placed(root, map, theory_check(theory));
}

Status judge_itt(const Node *root, const IttPlan *itt) {
    const Node *map = tree_find(root, "itt");
    TRY(judge_fractions(map, itt->species, itt->species_count));
    return placed(root, map, itt_check(itt));
}

Status judge_schematic(const Node *root, const SchematicPlan *schematic) {
    return placed(root, tree_find(root, "schematic"), schematic_check(schematic));
}

Status judge_memory(const Node *root, const Plan *plan) {
    static const double GIBIBYTE = 1073741824;
    const double there = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const double needed = (double)plan_memory(plan);
    if (there <= 0 || needed <= there) return OK;
    if (plan->itt.given)
        return tree_fail(place(root, "itt", "wave_numbers"),
                         "wave numbers up to %g with spacing %g need %.3g GiB of memory; this "
                         "machine has %.3g GiB",
                         plan->itt.last_wave_number, plan->itt.spacing, needed / GIBIBYTE,
                         there / GIBIBYTE);
    if (plan->schematic.given)
        return tree_fail(place(root, "schematic", "cycles"),
                         "%lld moments of %lld cycles need %.3g GiB of memory; this machine has "
                         "%.3g GiB",
                         (long long)plan->schematic.moments, (long long)plan->schematic.periods,
                         needed / GIBIBYTE, there / GIBIBYTE);
    if (plan_is_theory(plan))
        return tree_fail(place(root, "theory", "wave_numbers"),
                         "%lld wave numbers need %.3g GiB of memory; this machine has %.3g GiB",
                         (long long)plan->theory.wave_numbers, needed / GIBIBYTE, there / GIBIBYTE);
    char particles[NUMBER_SIZE];
    return tree_fail(
        place(root, "system", "particles"),
        "particles = %s needs %.3g GiB of memory per replica; this machine has %.3g GiB",
        number_write(particles, (double)plan->system.particles), needed / GIBIBYTE,
        there / GIBIBYTE);
}
