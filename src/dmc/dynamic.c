// SPDX-License-Identifier: GPL-3.0-or-later
// Dynamic Monte Carlo: the chain with a clock. A tick is a fixed time, about a cycle, chosen from
// the plan alone; how many trials are worth it is measured as the run goes on, from before the
// stage begins ([JT]; mixtures: Garcia Daza et al.).
#include "dmc/agreement.h"
#include "dmc/clock.h"
#include "dmc/dmc.h"
#include "dmc/predict.h"

#include "base/memory.h"
#include "propagator/tracer.h"

#include <math.h>
#include <string.h>

static const double ACCEPTANCE_FLOOR = 0.05; // below it, trials say little about diffusion
static const int ADJUSTMENTS = 20;           // of the amplitudes of a mixture, in the calibration
static const int64_t ROUND = 500; // cycles between adjustments of a pulled tracer, as [GD]
static const int ROUNDS_LEAST = 4;

typedef struct Dynamic {
    double step;
    int64_t clock, matching, matched; // ClockKind, MatchedSpan, MatchedMotion
    int64_t rotation, moves;
    int64_t calibration; // cycles
} Dynamic;

static const char *const clock_names[] = {"acceptance-rescaling", "diffusion-matching", NULL};
static const char *const span_names[] = {"per-cycle", "per-attempt", NULL};
static const char *const motion_names[] = {"parallel", "perpendicular", "rotational", NULL};
static const char *const rotation_names[] = {"mixed", "tangent", NULL};
static const char *const moves_names[] = {"uniform", "gaussian", NULL};

static const Option rows[] = {
    {.name = "step",
     .type = OPTION_REAL,
     .offset = offsetof(Dynamic, step),
     .least = 1e-5,
     .most = 1,
     .unit = "d",
     .about =
         "Largest displacement of a trial along the body axis of the first species (along each "
         "axis of space for bodies without one); all other amplitudes follow from the "
         "diffusion tensors. `perrin check` says which one to take for a wanted acceptance.",
     .required = 1},
    {.name = "clock",
     .type = OPTION_CHOICE,
     .unit = "",
     .offset = offsetof(Dynamic, clock),
     .fallback = CLOCK_MATCHING,
     .about =
         "What slows a cycle down against free diffusion: the acceptance, or the measured mean "
         "squared displacement.",
     .choices = clock_names},
    {.name = "matching",
     .type = OPTION_CHOICE,
     .unit = "",
     .offset = offsetof(Dynamic, matching),
     .fallback = MATCH_PER_CYCLE,
     .about = "The displacement that diffusion-matching takes: after a whole cycle, which contains "
              "back-scattering, or per attempt.",
     .choices = span_names},
    {.name = "matched",
     .type = OPTION_CHOICE,
     .unit = "",
     .offset = offsetof(Dynamic, matched),
     .fallback = MATCH_PARALLEL,
     .about = "The motion of bodies with an axis that diffusion-matching takes.",
     .choices = motion_names},
    {.name = "rotation",
     .type = OPTION_CHOICE,
     .unit = "",
     .offset = offsetof(Dynamic, rotation),
     .fallback = ROTATION_MIXED,
     .about = "How trials rotate: towards a random point of the sphere, or by random steps in the "
              "tangent plane.",
     .choices = rotation_names},
    {.name = "moves",
     .type = OPTION_CHOICE,
     .unit = "",
     .offset = offsetof(Dynamic, moves),
     .about = "Distribution of displacements; gaussian ones have the variance of the uniform ones, "
              "and rotations in the tangent plane.",
     .choices = moves_names},
    {.name = "calibration",
     .type = OPTION_INTEGER,
     .offset = offsetof(Dynamic, calibration),
     .fallback = 1000,
     .least = 40,
     .most = 1e9,
     .unit = "cycles",
     .about = "Cycles before the stage begins: in the first half the steps of a mixture's other "
              "species are adjusted to one clock, in the second the clock is measured."},
};

typedef struct DynamicPropagator {
    Propagator base;
    State *state;
    RngKey key;
    Dynamic set;
    double tick; // in d^2/D0
    ChainClock *clock;
    bool pulled;
    size_t tracer; // species
    size_t particle;
    int64_t period, pull; // ticks of a trajectory's period, and from its start with the force
    int64_t ticks;        // done
    TracerSettling settling;
} DynamicPropagator;

static const Dynamic *dynamic(const Settings *settings) {
    return (const Dynamic *)settings->bytes;
}

static DynamicPropagator *own(Propagator *propagator) {
    return (DynamicPropagator *)propagator;
}

static ChainSettings chain_settings(const Dynamic *set) {
    return (ChainSettings){.stream = STREAM_TRIALS,
                           .rotation = (RotationRule)set->rotation,
                           .gaussian = (int)set->moves};
}

// Of a species if all accept alike: D_b/D_first = step_b^2/step^2.
static double first_step(const Dynamic *set, const System *system, size_t species) {
    const Diffusion first = species_diffusion(&system->species[0]);
    const Diffusion other = species_diffusion(&system->species[species]);
    return set->step * sqrt(other.parallel / first.parallel);
}

static double predicted(const Dynamic *set, const System *system, size_t species) {
    const ChainSettings chain = chain_settings(set);
    return predict_acceptance(system, species, first_step(set, system, species), &chain);
}

// Of a cycle, in d^2/D0.
static double predicted_cycle(const Dynamic *set, const System *system) {
    const Diffusion first = species_diffusion(&system->species[0]);
    return predicted(set, system, 0) * set->step * set->step / (6 * first.parallel) *
           system_reference_diffusion(system);
}

// The step up to which a drifted tracer surely keeps the pace of the bath. Pressed against a wall
// it has gaps of kT/F on average, and drifted trials of the spread w are accepted as erfc(F w/sqrt
// 8), so that a cycle is worth at most 0.66/(D F^2), however long the trials: in what a bath's
// cycle of acceptance A is worth, F step sqrt A = 2. Tracers were seen to run away from 1.5 to 1.6
// on at a packing fraction of 0.5, from 1.6 to 2.0 (Pe = 30) or 2.3 to 3.6 (Pe = 100)
// at 0.35, above 2.9 at 0.2.
static double pressed_step(const Dynamic *set, const System *system, const Pull *pull) {
    static const double PRESSED = 1.5;
    const size_t s = tracer_species(pull, system);
    const double force = drive_pull_force(pull, system->species[s].diameter);
    const double here = force * first_step(set, system, s) * sqrt(predicted(set, system, 0));
    return here > 0 ? set->step * PRESSED / here : INFINITY;
}

// The largest of 1, 2, 5 times a power of ten not above x < 1.
static double round_below(double x) {
    double power = 1;
    while (x * power < 1) power *= 10;
    const double digit = x * power;
    return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) / power;
}

static double tick(const Settings *settings, const System *system) {
    return round_below(fmin(0.99, predicted_cycle(dynamic(settings), system)));
}

static int64_t one(const Settings *settings) {
    (void)settings;
    return 1;
}

static Status check_rotation(const Dynamic *set, const System *system, size_t species) {
    const ChainSettings chain = chain_settings(set);
    const Diffusion diffusion = species_diffusion(&system->species[species]);
    const double limit = amplitude_limit(&diffusion, &chain);
    const double step = first_step(set, system, species);
    if (step < limit) return OK;
    return status_fail(BAD_DATA,
                       "step = %g turns species '%s' by amplitudes of 1/2 and more, where rotation "
                       "has no clock; the step must be below %.4g",
                       set->step, system->species[species].name, set->step * limit / step);
}

// The prediction is that of bodies which point anywhere; in a nematic, which a crystal becomes,
// many more trials are accepted, and only the run can tell.
static bool is_predictable(const System *system) {
    return !system_is_oriented(system) || system->start != START_CRYSTAL;
}

static Status check_acceptance(const Dynamic *set, const System *system) {
    const double acceptance = predicted(set, system, 0);
    if (acceptance >= ACCEPTANCE_FLOOR || !is_predictable(system)) return OK;
    const ChainSettings chain = chain_settings(set);
    return status_fail(BAD_DATA,
                       "step = %g would be accepted in about %.2g of the trials, below %g, where "
                       "the clock has no meaning; a step of %.2g gives an acceptance of 0.3",
                       set->step, acceptance, ACCEPTANCE_FLOOR,
                       predict_step(system, 0, 0.3, &chain));
}

static Status check(const Settings *settings, const System *system) {
    const Dynamic *set = dynamic(settings);
    if (!(set->step > 0 && set->step <= 1))
        return status_fail(BAD_DATA, "step = %g must be above 0 and at most 1 d", set->step);
    TRY(chain_check(system));
    TRY(system_check_diffusion(system));
    for (size_t s = 0; s < system->species_count; s++) TRY(check_rotation(set, system, s));
    return check_acceptance(set, system);
}

static double seconds(const Settings *settings, const System *system) {
    const Dynamic *set = dynamic(settings);
    return tick(settings, system) / predicted_cycle(set, system) * chain_seconds_per_trial(system);
}

// The crowd in front of a strongly pulled tracer is kT/F thick, and a trial that is longer does not
// see it: the friction is then off by so much times the work of a trial over kT, of soft spheres
// at packing fractions of 0.2 to 0.5 (gallery: tracer-clocks, friction-curves).
static void describe_crowd(const Pull *pull, double work, Text *lines) {
    static const double OFF = 0.1, WORTH_SAYING = 0.05, STRONG = 20;
    const bool drifted = pull->clock == PULL_DRIFTED;
    if (pull->clock == PULL_FIRST_ORDER || pull->peclet < STRONG || OFF * work < WORTH_SAYING)
        return;
    text_add(lines,
             "at this step the friction of a dense bath may come out some %.0f %% too %s: the "
             "error of clock: %s has the other sign\n",
             100 * OFF * work, drifted ? "large" : "small", drifted ? "exact-force" : "drifted");
}

// The force is on in the calibration, of twice its cycles.
static void describe_calibration(const Dynamic *set, const System *system, const Pull *pull,
                                 Text *lines) {
    const Box box = system_box(system);
    const double edge = box.edge[pull->axis];
    const double force =
        drive_pull_force(pull, system->species[tracer_species(pull, system)].diameter);
    const double alone = 2 * (double)set->calibration * predicted_cycle(set, system) *
                         tracer_free_diffusion(pull, system, false) * force;
    const double round = (double)ROUND;
    if (alone < edge) return;
    text_add(lines,
             "in the calibration %s would go %.2g d alone, and the box is %.3g d long: it comes "
             "into its own wake if its friction is below %.2g; calibration = %.0f would not\n",
             pull->species, alone, edge, alone / edge,
             round * floor((double)set->calibration * edge / alone / round));
}

static void describe_pull(const Dynamic *set, const System *system, const Pull *pull, Text *lines) {
    const size_t s = tracer_species(pull, system);
    const double step = first_step(set, system, s);
    const double work = drive_pull_force(pull, system->species[s].diameter) * step;
    text_add(lines, "the work of a trial of %s is up to %.3g kT\n", pull->species, work);
    if (pull->clock == PULL_DRIFTED)
        text_add(lines, "%s drifts by %.3g d in a trial, %.3g of its thermal spread\n",
                 pull->species, work * step / 6, work / sqrt(12));
    const double pressed = pressed_step(set, system, pull);
    if (pull->clock == PULL_DRIFTED && set->step > pressed)
        text_add(lines,
                 "at this step %s, pressed against its neighbours, may not keep the bath's pace: "
                 "take one below about %.2g\n",
                 pull->species, pressed);
    else
        describe_crowd(pull, work, lines);
    describe_calibration(set, system, pull, lines);
}

static void describe(const Settings *settings, const System *system, const Drive *drive,
                     double time, Text *lines) {
    const Dynamic *set = dynamic(settings);
    const ChainSettings chain = chain_settings(set);
    for (size_t s = 0; s < system->species_count; s++) {
        const Diffusion diffusion = species_diffusion(&system->species[s]);
        const Amplitude amplitude =
            amplitude_matched(first_step(set, system, s), &diffusion, &chain);
        text_add(lines, "%s: D = %.4g D0, step %.4g d", system->species[s].name,
                 diffusion_mean(&diffusion, (int)system->dimension) /
                     system_reference_diffusion(system),
                 amplitude.parallel);
        if (amplitude.rotation > 0)
            text_add(lines, " along, %.4g d across its axis, rotation %.4g",
                     amplitude.perpendicular, amplitude.rotation);
        text_add(lines, ", acceptance about %.2g%s\n", predicted(set, system, s),
                 is_predictable(system) ? "" : ", more in a nematic");
    }
    const double cycle = predicted_cycle(set, system);
    text_add(lines, "a cycle lasts about %.2g d^2/D0: %.3g cycles\n", cycle, time / cycle);
    // Neighbours that a soft sphere leaves pay for those that it approaches.
    const bool hard = shape_is_hard((ShapeKind)system->species[0].shape);
    text_add(lines, "an acceptance of %s0.3, 0.5, 0.8 wants a step of about %.2g, %.2g, %.2g%s\n",
             hard ? "" : "more than ", predict_step(system, 0, 0.3, &chain),
             predict_step(system, 0, 0.5, &chain), predict_step(system, 0, 0.8, &chain),
             is_predictable(system) ? "" : ", a longer one in a nematic");
    if (drive_kinds(drive) & DRIVE_PULL) describe_pull(set, system, &drive->pull, lines);
}

static void release(Propagator *propagator) {
    if (!propagator) return;
    clock_free(own(propagator)->clock);
    memory_free(propagator);
}

static Status create(Propagator **out, const Settings *settings, State *state, RngKey key) {
    DynamicPropagator *made = NULL;
    TRY(NEW(made));
    made->base.kind = &propagator_dynamic_monte_carlo;
    made->state = state;
    made->key = key;
    made->set = *dynamic(settings);
    made->tick = tick(settings, &state->system);
    const ClockSettings clock = {.chain = chain_settings(&made->set),
                                 .kind = (ClockKind)made->set.clock,
                                 .motion = (MatchedMotion)made->set.matched,
                                 .span = (MatchedSpan)made->set.matching};
    const Status status = clock_create(&made->clock, &clock, state, key);
    if (status != OK) {
        release(&made->base);
        return status;
    }
    for (size_t s = 0; s < state->system.species_count; s++) {
        clock_set_step(made->clock, s, first_step(&made->set, &state->system, s));
    }
    *out = &made->base;
    return OK;
}

// Pulling.

// How far a trial may go under the force, by the tracer's step as it is where all accept alike.
static Status check_pull_step(const Dynamic *set, const Pull *pull, const System *system) {
    static const double FIRST_ORDER_MOST = 0.3, WORK_MOST = 5, DRIFT_MOST = 0.2; // f, f, d
    const size_t s = tracer_species(pull, system);
    const Species *tracer = &system->species[s];
    const double step = first_step(set, system, s),
                 force = drive_pull_force(pull, tracer->diameter);
    const double f = force * step, drift = f * step / 6 / tracer->diameter;
    if (pull->clock == PULL_FIRST_ORDER && f > FIRST_ORDER_MOST)
        return status_fail(BAD_DATA,
                           "pull = {clock: first-order}: at step = %g the work of a trial is up to "
                           "%.3g kT, above %g, where the first order does not hold; take a step "
                           "below %.2g, or clock: drifted",
                           set->step, f, FIRST_ORDER_MOST, set->step * FIRST_ORDER_MOST / f);
    if (pull->clock == PULL_EXACT_FORCE && f > WORK_MOST)
        return status_fail(BAD_DATA,
                           "pull = {clock: exact-force}: at step = %g the work of a trial is up to "
                           "%.3g kT, above %g, so that hardly any goes back; take a step below "
                           "%.2g, or clock: drifted",
                           set->step, f, WORK_MOST, set->step * WORK_MOST / f);
    if (pull->clock != PULL_DRIFTED || drift <= DRIFT_MOST) return OK;
    return status_fail(
        BAD_DATA,
        "pull = {peclet: %g}: at step = %g the tracer drifts by %.3g of its diameter "
        "in a trial, above %g; take a step below %.2g",
        pull->peclet, set->step, drift, DRIFT_MOST, set->step * sqrt(DRIFT_MOST / drift));
}

static Status check_drive(const Settings *settings, const System *system, const Drive *drive) {
    const Dynamic *set = dynamic(settings);
    const Pull *pull = &drive->pull;
    TRY(tracer_check(pull, system));
    if (set->clock != CLOCK_ACCEPTANCE)
        return status_fail(
            BAD_DATA,
            "pull = {species: %s}: the tracer's time goes by acceptance, and so must "
            "the bath's; use clock: acceptance-rescaling in dynamics",
            pull->species);
    TRY(check_pull_step(set, pull, system));
    return tracer_check_box(pull, system);
}

static Status drive(Propagator *propagator, const Drive *drive, int64_t steps) {
    DynamicPropagator *made = own(propagator);
    const Pull *pull = &drive->pull;
    const System *system = &made->state->system;
    made->pulled = true;
    made->tracer = tracer_species(pull, system);
    made->particle = tracer_particle(pull, system);
    made->ticks = steps;
    drive_pull_ticks(pull, made->tick, 1, &made->period, &made->pull);
    clock_pull(made->clock,
               &(ClockPull){.species = made->tracer,
                            .axis = (int)pull->axis,
                            .force = drive_pull_force(pull, system->species[made->tracer].diameter),
                            .kind = (PullClock)pull->clock});
    return OK;
}

static bool is_tracer(const DynamicPropagator *made, size_t species) {
    return made->pulled && species == made->tracer;
}

// Where a species is slower than the first, longer steps; its acceptance falls with them, so that
// the square root, or that of the power by which a pulled tracer's time goes with its step,
// converges from one side. `share` of that is taken, less and less, so that the noise of all
// adjustments averages out.
static Status adjust(DynamicPropagator *made, size_t species, double share) {
    const System *system = &made->state->system;
    const double pace = clock_cycle_of(made->clock, 0) / clock_cycle_of(made->clock, species);
    const double power = is_tracer(made, species) ? clock_pull_power(made->clock) : 2;
    const double factor = 1 + share * (sqrt(fmin(fmax(pace, 0.25), 4)) - 1) * 2 / power;
    const double step = fmin(clock_step(made->clock, species) * factor, 1);
    const ChainSettings chain = chain_settings(&made->set);
    const Diffusion diffusion = species_diffusion(&system->species[species]);
    if (step < amplitude_limit(&diffusion, &chain))
        return clock_set_step(made->clock, species, step), OK;
    return status_fail(UNHEALTHY,
                       "species '%s' cannot keep pace with '%s' at step = %g: its rotation would "
                       "need amplitudes of 1/2 and more; take a smaller step",
                       system->species[species].name, system->species[0].name, made->set.step);
}

static Status check_running(const DynamicPropagator *made) {
    static const uint64_t ENOUGH = 1000; // trials of a species, to judge it
    const System *system = &made->state->system;
    for (size_t s = 0; s < system->species_count; s++) {
        const double acceptance = clock_acceptance(made->clock, s);
        if (clock_trials(made->clock, s) < ENOUGH || acceptance >= ACCEPTANCE_FLOOR) continue;
        return status_fail(UNHEALTHY,
                           "species '%s' accepts %.3g of its trials at step = %g, less than %g, "
                           "where the clock has no meaning; take a smaller step",
                           system->species[s].name, acceptance, made->set.step, ACCEPTANCE_FLOOR);
    }
    return OK;
}

// What a cycle is worth by each species, in blocks of so many trials together.
static Status measure_clocks(DynamicPropagator *made, int64_t trials, Agreement *agreement) {
    for (int64_t b = 0; b < AGREEMENT_BLOCKS; b++) {
        const int64_t from = trials * b / AGREEMENT_BLOCKS,
                      to = trials * (b + 1) / AGREEMENT_BLOCKS;
        TRY(clock_run(made->clock, to - from, NULL));
        for (size_t s = 0; s < made->state->system.species_count; s++) {
            agreement->cycle[b][s] = clock_cycle_of(made->clock, s);
        }
    }
    return OK;
}

static Status check_one_clock(const DynamicPropagator *made, const Agreement *agreement) {
    const System *system = &made->state->system;
    for (size_t s = 1; s < system->species_count; s++) {
        if (agreement_holds(agreement, s)) continue;
        return status_fail(UNHEALTHY,
                           "species '%s' is off the clock of '%s' by %.0f(%.0f) %% at step = %g; "
                           "take a smaller step or a longer calibration",
                           system->species[s].name, system->species[0].name,
                           100 * agreement_apart(agreement, s), 100 * agreement_error(agreement, s),
                           made->set.step);
    }
    return OK;
}

static void note_round(DynamicPropagator *made) {
    TracerSettling *settling = &made->settling;
    if (settling->rounds == SETTLING_MOST) return;
    settling->cycles = (double)ROUND;
    settling->step[settling->rounds] = clock_step(made->clock, made->tracer);
    settling->pace[settling->rounds++] =
        clock_cycle_of(made->clock, made->tracer) / clock_cycle_of(made->clock, 0);
}

// The tracer's step, every so many cycles, until its clock is the bath's; then it is frozen.
static Status settle_tracer(DynamicPropagator *made) {
    const int64_t trials = ROUND * (int64_t)made->state->count;
    const int rounds = (int)fmax(ROUNDS_LEAST, (double)(made->set.calibration / ROUND));
    for (int k = 0; k < rounds; k++) {
        clock_restart(made->clock);
        TRY(clock_run(made->clock, trials, NULL));
        note_round(made);
        TRY(adjust(made, made->tracer, 2.0 / (k + 2)));
    }
    return OK;
}

static Status prepare(Propagator *propagator) {
    DynamicPropagator *made = own(propagator);
    const int64_t count = (int64_t)made->state->count, half = made->set.calibration / 2 * count;
    clock_calibrate(made->clock, true);
    for (int k = 0; k < ADJUSTMENTS; k++) {
        clock_restart(made->clock);
        TRY(clock_run(made->clock, half / ADJUSTMENTS, NULL));
        for (size_t s = 1; s < made->state->system.species_count; s++) {
            if (!is_tracer(made, s)) TRY(adjust(made, s, 2.0 / (k + 2)));
        }
    }
    if (made->pulled) TRY(settle_tracer(made));
    Agreement agreement;
    clock_restart(made->clock);
    TRY(measure_clocks(made, half, &agreement));
    clock_calibrate(made->clock, false);
    clock_publish(made->clock);
    TRY(check_running(made));
    return check_one_clock(made, &agreement);
}

static Status begin_trajectory(DynamicPropagator *made) {
    State *state = made->state;
    clock_publish(made->clock);
    TRY(tracer_take_another_place(state, made->particle, made->key));
    return clock_take_in(made->clock);
}

static Status advance(Propagator *propagator, int64_t ticks, Tally *tally) {
    DynamicPropagator *made = own(propagator);
    for (int64_t t = 0; t < ticks; t++) {
        if (made->pulled) clock_pull_rests(made->clock, made->ticks % made->period >= made->pull);
        TRY(clock_advance(made->clock, made->tick, tally));
        made->ticks++;
        if (made->pulled && made->ticks % made->period == 0) TRY(begin_trajectory(made));
    }
    clock_publish(made->clock);
    tally->settling = made->pulled ? &made->settling : NULL;
    return check_running(made);
}

static void archive(Propagator *propagator, Archive *archive) {
    DynamicPropagator *made = own(propagator);
    clock_archive(made->clock, archive);
    if (made->pulled) tally_archive_settling(&made->settling, archive);
}

const PropagatorKind propagator_dynamic_monte_carlo = {
    .name = "dynamic-monte-carlo",
    .about = "Monte Carlo of single-particle moves whose cycles are worth a measured time of "
             "Brownian motion; for all shapes.",
    .time_unit = "d^2/D0",
    .time_meaning = "D0 is the free diffusion coefficient of the first species, averaged over "
                    "directions.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(Dynamic)},
    .drives = DRIVE_PULL,
    .check = check,
    .check_drive = check_drive,
    .tick = tick,
    .ticks_per_step = one,
    .seconds_per_particle_tick = seconds,
    .memory = clock_memory,
    .describe = describe,
    .create = create,
    .drive = drive,
    .prepare = prepare,
    .advance = advance,
    .archive = archive,
    .free = release,
};
