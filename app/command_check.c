// SPDX-License-Identifier: GPL-3.0-or-later
// perrin check FILE.yaml: reads a run file, says what would be run, and runs nothing.
#include "command.h"

#include "base/memory.h"
#include "base/text.h"
#include "config/config.h"
#include "propagator/tracer.h"
#include "protocol/replica.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void print_bytes(double bytes) {
    static const double MEBIBYTE = 1048576, GIBIBYTE = 1073741824;
    if (bytes < GIBIBYTE)
        printf("%.3g MiB", bytes / MEBIBYTE);
    else
        printf("%.3g GiB", bytes / GIBIBYTE);
}

static void print_system(const System *system) {
    const int dimension = (int)system->dimension;
    const Box box = system_box(system);
    printf("system    %lld particles in %d dimensions\n", (long long)system->particles, dimension);
    const double packing = system_packing_fraction(system); // 0 of platelets, without volume
    printf("          ");
    if (packing > 0) printf("packing fraction %.6g, ", packing);
    printf("number density %.6g d^-%d\n", system_number_density(system), dimension);
    printf("          box %.6g", box.edge[0]);
    for (int axis = 1; axis < dimension; axis++) printf(" x %.6g", box.edge[axis]);
    printf(" d\n");
}

static void print_species(const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    printf("species   %-16s %10s %10s %10s %10s  %s\n", "", "number", "diameter/d", "spread",
           "mass/m", "shape");
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        printf("          %-16s %10zu %10.6g %10.6g %10.6g  %s", species->name, counts[s],
               species->diameter, species->spread == SPREAD_NONE ? 0 : species->spread_width,
               species->mass, shape_names[species->shape]);
        if (species->shape == SHAPE_SPHEROCYLINDER) printf(" of length %.6g d", species->length);
        if (species->shape == SHAPE_SOFT_SPHERE) printf(" of exponent %.6g", species->exponent);
        printf("\n");
    }
}

// A line each, under what they are of; frees them.
static Status print_lines(Text *lines) {
    for (const char *line = text_words(lines); *line; line += strcspn(line, "\n") + 1) {
        printf("          %-16s %.*s\n", "", (int)strcspn(line, "\n"), line);
    }
    const Status status = text_status(lines);
    text_free(lines);
    return status;
}

// What the method says of itself.
static Status print_method(const Plan *plan, const Stage *stage) {
    const Dynamics *dynamics = &stage->dynamics;
    if (!dynamics->kind->describe) return OK;
    Text lines = {0};
    dynamics->kind->describe(&dynamics->settings, &plan->system, &stage->drive, stage_time(stage),
                             &lines);
    return print_lines(&lines);
}

static Status print_observation(const Observation *observation, const System *system,
                                const Clock *clock, const char *title) {
    printf("          %-16s %s\n", title, observation->kind->name);
    Text lines = {0};
    const Status status =
        observable_describe(observation->kind, &observation->settings, system, clock, &lines);
    if (status == OK) return print_lines(&lines);
    text_free(&lines);
    return status;
}

// Where each trajectory but the first begins, and whether there will be such a place.
static void print_next_place(const System *system, const Pull *pull) {
    static const double MANY = 100; // of such places among those tried, to be sure of one
    if (tracer_has_alike(pull, system)) return;
    printf("          %-16s each begins at a random place where the tracer touches nothing", "");
    const double chance = tracer_chance_of_room(pull, system);
    if (chance >= 0)
        printf(":\n          %-16s one in %.2g by scaled-particle theory", "", 1 / chance);
    printf("\n");
    if (chance < 0 || chance * TRACER_ATTEMPTS > MANY) return;
    printf("          %-16s of %d that are tried hardly any: it goes back to its own hole, or the\n"
           "          %-16s run ends; leave out the period, so that each replica is a trajectory\n",
           "", TRACER_ATTEMPTS, "");
}

// A trajectory ends where it has gone 3/4 of the edge; the force stays on until its time is over.
static void print_end(const System *system, const Pull *pull, double velocity, double time) {
    const Box box = system_box(system);
    const double end = TRACER_DISTANCE * box.edge[pull->axis] / velocity;
    if (end < time)
        printf(
            "          %-16s with a friction below %.2g a trajectory ends before its time, at 3/4\n"
            "          %-16s of the edge; alone after %.2g\n",
            "", time / end, "", end);
}

static void print_pull(const System *system, const Pull *pull, const Clock *clock) {
    const Species *tracer = &system->species[tracer_species(pull, system)];
    const double force = drive_pull_force(pull, tracer->diameter);
    int64_t period, on;
    drive_pull_ticks(pull, clock->tick, clock->ticks_per_step, &period, &on);
    printf("          %-16s F = %.6g kT/d on %s along %s: Pe = F a/kT = %.6g", "  driven by", force,
           pull->species, drive_pull_axes[pull->axis], pull->peclet);
    if (!clock->flies) printf(", clock %s", drive_pull_clocks[pull->clock]);
    const double velocity = force * tracer_free_diffusion(pull, system, clock->thermostatted);
    printf("\n          %-16s alone it drifts at %.4g D0/d; ", "", velocity);
    if (period > clock->ticks)
        printf("one trajectory in each replica\n");
    else
        printf("%lld trajectories of %.4g %s in each replica, with rests of %.4g\n",
               (long long)(clock->ticks / period), (double)on * clock->tick, clock->unit,
               (double)(period - on) * clock->tick);
    print_end(system, pull, velocity,
              (double)(on < clock->ticks ? on : clock->ticks) * clock->tick);
    if (period <= clock->ticks) print_next_place(system, pull);
}

static bool observes(const Stage *stage, const char *observable) {
    for (size_t k = 0; k < stage->observation_count; k++) {
        if (strcmp(stage->observations[k].kind->name, observable) == 0) return true;
    }
    return false;
}

// A clock that is measured has an error, which a stage gives to whom it is asked for.
static void print_unseen_clock(const Stage *stage) {
    if (stage->dynamics.kind != &propagator_dynamic_monte_carlo) return;
    if (stage->observation_count == 0 || observes(stage, "acceptance")) return;
    printf("          %-16s not told: what a cycle was worth, and its error (acceptance)\n",
           "  clock");
}

static Status print_stage(const Plan *plan, size_t index) {
    const Stage *stage = &plan->stages[index];
    const Clock clock = plan_clock(plan, index);
    const double steps = (double)(clock.ticks / clock.ticks_per_step);
    printf("stage     %-16s %s, %.6g %s in %.0f steps of %.6g", stage->name,
           stage->dynamics.kind->name, stage_time(stage), clock.unit, steps,
           clock.tick * (double)clock.ticks_per_step);
    if (stage->strain > 0) printf(", to a strain of %.6g", stage->strain);
    if (stage->stress_error > 0)
        printf(", at most: until the stress is known to %.6g of it", stage->stress_error);
    printf("\n");
    if (drive_kinds(&stage->drive) & DRIVE_FLOW)
        printf("          %-16s %s\n", "  driven by",
               flow_words((char[FLOW_WORDS_SIZE]){0}, &stage->drive.flow));
    if (drive_kinds(&stage->drive) & DRIVE_PULL)
        print_pull(&plan->system, &stage->drive.pull, &clock);
    TRY(print_method(plan, stage));
    if (stage->observation_count == 0) printf("          %-16s nothing\n", "  observes");
    for (size_t k = 0; k < stage->observation_count; k++) {
        TRY(print_observation(&stage->observations[k], &plan->system, &clock,
                              k == 0 ? "  observes" : ""));
    }
    print_unseen_clock(stage);
    return OK;
}

// What shows whether the halves of a stage agree. Shares of accepted moves do so of one species.
static const char *measure_of_halves(const Plan *plan, const Stage *stage) {
    if (stage->dynamics.kind->flies) return "pressure";
    if (!shape_is_hard((ShapeKind)plan->system.species[0].shape)) return "energy";
    return plan->system.species_count == 1 ? "acceptance" : "structure_factor";
}

static bool is_round(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        const int64_t shape = system->species[s].shape;
        if (shape != SHAPE_DISC && shape != SHAPE_SPHERE) return false;
    }
    return true;
}

// What the results will not be able to say of the last stage.
static void print_equilibrium(const Plan *plan) {
    const Stage *last = &plan->stages[plan->stage_count - 1];
    if (drive_kinds(&last->drive)) return; // not meant to be in equilibrium
    const bool relaxes =
        observes(last, "self_scattering") || observes(last, "collective_scattering");
    const char *measure = measure_of_halves(plan, last);
    const bool halves = observes(last, measure) || observes(last, "energy");
    const bool order = observes(last, "bond_order") || !is_round(&plan->system);
    if (relaxes && halves && order) return;
    printf("          %-16s not told of %s:", "equilibrium", last->name);
    if (!relaxes) printf(" how often it relaxes (self_scattering)%s", halves && order ? "" : ";");
    if (!halves) printf(" whether its halves agree (%s)%s", measure, order ? "" : ";");
    if (!order) printf(" whether it crystallises (bond_order)");
    printf("\n");
}

static const double HOUR = 3600, DAY = 24 * 3600., YEAR = 365.25 * 24 * 3600;

static void print_seconds(double seconds) {
    if (seconds < 100)
        printf("%.2g s", seconds);
    else if (seconds < 100 * 60)
        printf("%.3g min", seconds / 60);
    else if (seconds < 100 * HOUR)
        printf("%.3g h", seconds / HOUR);
    else if (seconds < 2 * YEAR)
        printf("%.3g days", seconds / DAY);
    else
        printf("%.3g years", seconds / YEAR);
}

// A slip of the pen in a time, 1e6 for 1e-6, is seen here or not before the run is given up.
static void print_slowest(const Plan *plan, double seconds) {
    static const double LONG = 30; // days
    size_t slowest = 0;
    if (seconds < LONG * DAY) return;
    for (size_t s = 1; s < plan->stage_count; s++) {
        if (plan_stage_seconds(plan, s) > plan_stage_seconds(plan, slowest)) slowest = s;
    }
    printf(
        "          warning: more than %g days, most of it for stage '%s' of %.6g %s: is that what "
        "you want?\n",
        LONG, plan->stages[slowest].name, stage_time(&plan->stages[slowest]),
        plan_clock(plan, slowest).unit);
}

// Of which one replica has errors.
static bool has_trajectories(const Plan *plan) {
    for (size_t i = 0; i < plan->stage_count; i++) {
        const Stage *stage = &plan->stages[i];
        const double period = stage->drive.pull.period;
        if ((drive_kinds(&stage->drive) & DRIVE_PULL) && period > 0 && 2 * period <= stage->time)
            return true;
    }
    return false;
}

// The error of a standard error of n values is 1/sqrt(2 (n - 1)) of it.
static void print_ensemble(const Plan *plan) {
    const EnsemblePlan *ensemble = &plan->ensemble;
    static const long long REPLICAS_FEW = 4;
    const long long replicas = (long long)ensemble->replicas;
    printf("ensemble  %lld replicas, seed %lld\n", replicas, (long long)ensemble->seed);
    if (replicas == 1)
        printf("          one replica has no errors%s: take %lld or more\n",
               has_trajectories(plan) ? " but of how the tracer goes, over its trajectories" : "",
               REPLICAS_FEW);
    else if (replicas < REPLICAS_FEW)
        printf("          of %lld replicas errors are known to %.0f %% only: take %lld or more\n",
               replicas, 100 / sqrt(2 * (double)(replicas - 1)), REPLICAS_FEW);
}

static void print_cost(const Plan *plan) {
    const double replicas = (double)plan->ensemble.replicas;
    const double cores = fmin((double)sysconf(_SC_NPROCESSORS_ONLN), replicas);
    const double memory = (double)plan_memory(plan);
    const double seconds = plan_seconds(plan);
    printf("memory    ");
    print_bytes(memory);
    printf(" per replica, ");
    print_bytes(memory * replicas);
    printf(" for all %.0f\n", replicas);
    // A frame holds three coordinates and three image counts per particle.
    const double frame = (double)plan->system.particles * 3 * (sizeof(double) + sizeof(int32_t));
    printf("disk      ");
    print_bytes(frame * (double)plan_frames(plan) * replicas);
    printf(" of trajectories\n");
    printf("time      about ");
    print_seconds(seconds);
    printf(" per replica, ");
    print_seconds(seconds * ceil(replicas / cores));
    printf(" for all on %.0f cores, of motion alone\n", cores);
    print_slowest(plan, seconds * ceil(replicas / cores));
    printf("          packing and measuring come on top: most of it where a short stage observes "
           "much\n");
}

static void print_theory_cost(const Plan *plan) {
    const size_t slots = plan_slots(plan);
    printf("memory    ");
    print_bytes((double)plan_memory(plan));
    printf("\ntime      about ");
    print_seconds(plan_seconds(plan));
    if (slots > 1) printf(", for errors all is done up to %zu times: structure.groups", slots + 1);
    printf("\n");
}

static void print_theory_species(const TheorySpecies *species, size_t count) {
    if (count > 0) printf("species   %-16s %10s %10s %10s\n", "", "fraction", "diameter/d", "D/D0");
    for (size_t a = 0; a < count; a++)
        printf("          %-16s %10.6g %10.6g %10.6g\n", species[a].name, species[a].fraction,
               species[a].diameter, species[a].diffusion);
}

static void print_theory(const TheoryPlan *theory) {
    printf("theory    %d dimensions, structure: %s\n", (int)theory->dimension,
           theory_structure_name(theory));
    printf("          %lld wave numbers up to %.6g/d\n", (long long)theory->wave_numbers,
           theory->last_wave_number);
    print_theory_species(theory->species, theory->species_count);
}

static void print_itt(const IttPlan *itt) {
    printf("theory    discs under shear, structure: %s\n", itt_structure_name(itt));
    printf("          shear rate %.6g D0/d^2 up to a strain of %.6g\n", itt->shear_rate,
           itt->last_strain);
    printf("          wave vectors up to %.6g/d, spacing %.6g/d\n", itt->last_wave_number,
           itt->spacing);
    print_theory_species(itt->species, itt->species_count);
}

static void print_schematic(const SchematicPlan *schematic) {
    const F12 model = schematic_model(schematic);
    Text drive = {0};
    printf("theory    schematic model of one correlator\n");
    printf("          v1 = %.6g, v2 = %.6g; the transition is at v1 = %.6g\n", model.v1, model.v2,
           f12_critical_v1(model.v2));
    schematic_say_drive(&drive, schematic);
    printf("          %s\n", text_words(&drive));
    text_free(&drive);
}

static Status print_calculation(const Plan *plan) {
    uint32_t checksum;
    if (plan->itt.given)
        print_itt(&plan->itt);
    else if (plan->schematic.given)
        print_schematic(&plan->schematic);
    else
        print_theory(&plan->theory);
    print_theory_cost(plan);
    return plan_check_input(plan, &checksum);
}

static Status print_plan(const Plan *plan) {
    if (plan->title[0] != '\0') printf("%s\n", plan->title);
    if (plan_is_theory(plan)) return print_calculation(plan);
    print_system(&plan->system);
    print_species(&plan->system);
    for (size_t s = 0; s < plan->stage_count; s++) TRY(print_stage(plan, s));
    print_equilibrium(plan);
    print_ensemble(plan);
    print_cost(plan);
    return OK;
}

// A line per point, and the time of all.
static Status print_sweep(const ConfigPoints *points) {
    const size_t count = config_point_count(points);
    const double processors = (double)sysconf(_SC_NPROCESSORS_ONLN);
    double sum = 0;
    printf("\nsweep     %zu points, of which the above is the first\n", count);
    for (size_t p = 0; p < count; p++) {
        Plan *plan = NULL;
        TRY(config_point_plan(&plan, points, p));
        const double seconds = plan_seconds(plan) * (double)plan->ensemble.replicas;
        char name[POINT_NAME_SIZE];
        config_point_name(points, p, name);
        printf("          %-40s about ", name);
        print_seconds(seconds);
        printf(" of CPU time\n");
        sum += seconds;
        memory_free(plan);
    }
    printf("          about ");
    print_seconds(sum / processors);
    printf(" for all on %.0f cores, of motion alone\n", processors);
    return OK;
}

static Status print_points(const ConfigPoints *points) {
    Plan *plan = NULL;
    TRY(config_point_plan(&plan, points, 0));
    Status status = print_plan(plan);
    memory_free(plan);
    if (status == OK && config_sweep_keys(points) > 0) status = print_sweep(points);
    return status;
}

static Status print_written(const ConfigPoints *points) {
    char *text = NULL;
    TRY(config_write_points(points, &text));
    fputs(text, stdout);
    memory_free(text);
    return OK;
}

static Status check(const Arguments *arguments) {
    const char *settings[GIVEN_MOST];
    ConfigOverrides overrides = {0, settings};
    for (size_t i = 0; i < arguments->given; i++) {
        if (strcmp(arguments->flag[i].flag, "set") == 0)
            settings[overrides.count++] = arguments->flag[i].value;
    }
    ConfigPoints *points = NULL;
    TRY(config_read_points(&points, arguments->operand[0], &overrides));
    const Status status =
        argument_given(arguments, "all") ? print_written(points) : print_points(points);
    config_free_points(points);
    return status;
}

static const Flag flags[] = {
    {'s', "set", "KEY=VALUE", "override a key of the run file; may be given again"},
    {0, "all", NULL, "print the run file with all defaults written out instead"},
    {0},
};

const Command command_check = {
    .name = "check",
    .operands = "FILE.yaml",
    .about = "Check a run file and say what it would do; run nothing.",
    .flags = flags,
    .least = 1,
    .most = 1,
    .run = check,
};
