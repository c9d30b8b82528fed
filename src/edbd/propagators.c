// SPDX-License-Identifier: GPL-3.0-or-later
// The engine as two propagators: event-driven Brownian dynamics, whose velocities are drawn anew
// every thermostat interval (Weysser, thesis, ch. 2), and Newtonian dynamics.
#include "edbd/edbd.h"

#include "base/memory.h"
#include "propagator/tracer.h"
#include "state/equation_of_state.h"

#include <math.h>

static const double WINDOW = 0.01; // longest automatic window, in d sqrt(m/kT)

typedef struct EventDriven {
    double thermostat_interval;
    int64_t substeps;
} EventDriven;

typedef struct Newtonian {
    double window;
} Newtonian;

static const Option event_driven_rows[] = {
    {.name = "thermostat_interval",
     .type = OPTION_REAL,
     .offset = offsetof(EventDriven, thermostat_interval),
     .fallback = 0.01,
     .least = 1e-6,
     .most = 10,
     .unit = "d sqrt(m/kT)",
     .about = "Time between two draws of all velocities; D0 of a particle of mass m is half of it "
              "over m, and the motion is Brownian for times well above it."},
    {.name = "substeps",
     .type = OPTION_INTEGER,
     .offset = offsetof(EventDriven, substeps),
     .fallback = 0,
     .least = 0,
     .most = 1000000,
     .unit = "",
     .about = "Windows per thermostat interval, between which can be observed; 0: as many as keep "
              "each at 0.01 d sqrt(m/kT) or below."},
};

static const Option newtonian_rows[] = {
    {.name = "window",
     .type = OPTION_REAL,
     .offset = offsetof(Newtonian, window),
     .fallback = 0.01,
     .least = 1e-6,
     .most = 0.05,
     .unit = "d sqrt(m/kT)",
     .about = "Time between two moments that can be observed; the trajectory does not depend on it "
              "but for rounding."},
};

typedef struct EnginePropagator {
    Propagator base;
    Engine *engine;
    EngineSettings settings;
    EnginePull pull;
    RngKey key;
    State *state;     // borrowed
    double step_time; // in the unit of the method
    double interval;  // between draws of the velocities, in d sqrt(m/kT)
    int64_t tick;     // of the stage in which a tracer is pulled
    int64_t period;   // ticks of its trajectories
} EnginePropagator;

static const EventDriven *event_driven(const Settings *settings) {
    return (const EventDriven *)settings->bytes;
}

static const Newtonian *newtonian(const Settings *settings) {
    return (const Newtonian *)settings->bytes;
}

static int64_t event_driven_ticks(const Settings *settings) {
    const EventDriven *set = event_driven(settings);
    if (set->substeps > 0) return set->substeps;
    // 0.03/0.01 is a little above 3: that is three windows, not four.
    return (int64_t)ceil(set->thermostat_interval / WINDOW * (1 - 1e-12));
}

static double event_driven_flight(const Settings *settings) {
    return event_driven(settings)->thermostat_interval / (double)event_driven_ticks(settings);
}

// D0 = Delta kT/(2 m) of the first species, so a tick of length w lasts w D0 in d^2/D0.
static double event_driven_tick(const Settings *settings, const System *system) {
    const double diffusion =
        event_driven(settings)->thermostat_interval / (2 * system->species[0].mass);
    return event_driven_flight(settings) * diffusion;
}

static Status event_driven_check(const Settings *settings, const System *system) {
    const double interval = event_driven(settings)->thermostat_interval;
    if (!(interval > 0 && interval <= 10)) {
        return status_fail(BAD_DATA,
                           "thermostat_interval = %g must be above 0 and at most 10 "
                           "d sqrt(m/kT)",
                           interval);
    }
    return engine_check(system, event_driven_flight(settings));
}

static int64_t newtonian_ticks(const Settings *settings) {
    (void)settings;
    return 1;
}

static double newtonian_flight(const Settings *settings) {
    return newtonian(settings)->window;
}

static double newtonian_tick(const Settings *settings, const System *system) {
    (void)system;
    return newtonian(settings)->window;
}

static Status newtonian_check(const Settings *settings, const System *system) {
    const double window = newtonian(settings)->window;
    if (!(window > 0)) return status_fail(BAD_DATA, "window = %g must be positive", window);
    return engine_check(system, window);
}

// Rough, from measurements on one core: a base for draw, list and flight, and a share for each
// collision, of which there are as many as the equation of state says.
static double engine_seconds(double window, const System *system) {
    const double phi = fmin(system_packing_fraction(system), 0.9), void_part = 1 - phi;
    if (system->dimension == 2) {
        const double pressure = (1 + phi * phi / 8) / (void_part * void_part); // Henderson
        return 6e-9 + 85e-9 * window * (pressure - 1);
    }
    const double pressure = // Carnahan and Starling
        (1 + phi + phi * phi - phi * phi * phi) / (void_part * void_part * void_part);
    return 11e-9 + 280e-9 * window * (pressure - 1);
}

static double event_driven_seconds(const Settings *settings, const System *system) {
    return engine_seconds(event_driven_flight(settings), system);
}

static double newtonian_seconds(const Settings *settings, const System *system) {
    return engine_seconds(newtonian(settings)->window, system);
}

// D F of the tracer, in sqrt(kT/m).
static double pulled_drift(const Pull *pull, const System *system, double interval) {
    const Species *tracer = &system->species[tracer_species(pull, system)];
    return drive_pull_force(pull, tracer->diameter) * interval / (2 * tracer->mass);
}

static void describe_pull(double interval, const System *system, const Pull *pull, Text *lines) {
    const Species *tracer = &system->species[tracer_species(pull, system)];
    const double drift = pulled_drift(pull, system, interval);
    text_add(lines, "%s drifts by %.3g d in an interval, %.3g of a thermal flight\n", tracer->name,
             drift * interval, drift * sqrt(tracer->mass));
}

// The thermostat gives every species D = kT Delta/(2 m), so that D_a/D0 = m_first/m_a.
static void event_driven_describe(const Settings *settings, const System *system,
                                  const Drive *drive, double time, Text *lines) {
    static const double MANY = 1; // collisions, with which flight in an interval is hardly free
    (void)time;
    const double interval = event_driven(settings)->thermostat_interval;
    const double collisions = equation_collision_rate(system) * interval;
    text_add(lines, "D0 = %.6g d sqrt(kT/m)", interval / (2 * system->species[0].mass));
    for (size_t s = 1; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        text_add(lines, ", of %s %.4g D0", species->name, system->species[0].mass / species->mass);
    }
    text_add(lines, "\nabout %.2g collisions per particle and interval%s\n", collisions,
             collisions > MANY ? ": long-time diffusion is biased, take a shorter one" : "");
    if (drive_kinds(drive) & DRIVE_PULL) describe_pull(interval, system, &drive->pull, lines);
}

static Status propagator_create(Propagator **out, const PropagatorKind *kind,
                                const EngineSettings *settings, double step_time, State *state,
                                RngKey key) {
    EnginePropagator *propagator = NULL;
    TRY(NEW(propagator));
    propagator->base.kind = kind;
    propagator->state = state;
    propagator->settings = *settings;
    propagator->key = key;
    propagator->period = INT64_MAX;
    propagator->step_time = step_time;
    const Status status = engine_create(&propagator->engine, settings, state, key);
    if (status != OK) {
        memory_free(propagator);
        return status;
    }
    *out = &propagator->base;
    return OK;
}

static Status event_driven_create(Propagator **out, const Settings *settings, State *state,
                                  RngKey key) {
    const EngineSettings engine = {.window = event_driven_flight(settings),
                                   .windows_per_step = event_driven_ticks(settings),
                                   .redraw = 1,
                                   .stream = STREAM_VELOCITY};
    const double step_time =
        event_driven_tick(settings, &state->system) * (double)engine.windows_per_step;
    TRY(propagator_create(out, &propagator_event_driven, &engine, step_time, state, key));
    ((EnginePropagator *)*out)->interval = event_driven(settings)->thermostat_interval;
    return OK;
}

// Of a strain in one window, with which images across y move by little.
static const double STRAIN_MOST = 0.02;

static Status check_flow(const Settings *settings, const System *system, const Flow *flow) {
    const double strain = flow_fastest(flow) * event_driven_tick(settings, system);
    const Box box = system_box(system);
    const double most = fmin(STRAIN_MOST, 0.25 * box.edge[0] / box.edge[1]);
    if (strain <= most) return OK;
    return status_fail(BAD_DATA,
                       "%s strains by %.3g in a window of %g d sqrt(m/kT), more than %.3g; take a "
                       "shorter thermostat_interval",
                       flow_words((char[FLOW_WORDS_SIZE]){0}, flow), strain,
                       event_driven_flight(settings), most);
}

static Status check_pull(const Settings *settings, const System *system, const Pull *pull) {
    static const double DRIFT_MOST = 0.1; // in an interval, in tracer diameters
    TRY(tracer_check(pull, system));
    if (pull->clock != PULL_DRIFTED)
        return status_fail(BAD_DATA,
                           "pull = {clock: %s}: trials and their clocks are of "
                           "dynamic-monte-carlo; leave it out",
                           drive_pull_clocks[pull->clock]);
    const double interval = event_driven(settings)->thermostat_interval;
    const double diameter = system->species[tracer_species(pull, system)].diameter;
    const double drift = pulled_drift(pull, system, interval) * interval / diameter;
    if (drift <= DRIFT_MOST) return tracer_check_box(pull, system);
    return status_fail(BAD_DATA,
                       "pull = {peclet: %g}: at thermostat_interval = %g the tracer drifts by %.3g "
                       "of its diameter in an interval, above %g; take one below %.2g",
                       pull->peclet, interval, drift, DRIFT_MOST,
                       interval * sqrt(DRIFT_MOST / drift));
}

static Status event_driven_check_drive(const Settings *settings, const System *system,
                                       const Drive *drive) {
    if (drive_kinds(drive) & DRIVE_PULL) return check_pull(settings, system, &drive->pull);
    return check_flow(settings, system, &drive->flow);
}

static Status pull(EnginePropagator *driven, const Pull *pull, int64_t steps) {
    const System *system = &driven->state->system;
    const int64_t ticks_per_step = driven->settings.windows_per_step;
    driven->pull = (EnginePull){.particle = tracer_particle(pull, system),
                                .axis = (int)pull->axis,
                                .drift = pulled_drift(pull, system, driven->interval),
                                .begun = driven->state->step - steps};
    drive_pull_ticks(pull, driven->step_time, 1, &driven->pull.period, &driven->pull.on);
    driven->tick = steps * ticks_per_step;
    if (driven->pull.period < INT64_MAX / ticks_per_step)
        driven->period = driven->pull.period * ticks_per_step;
    engine_pull(driven->engine, &driven->pull);
    return OK;
}

static Status event_driven_drive(Propagator *propagator, const Drive *drive, int64_t steps) {
    EnginePropagator *driven = (EnginePropagator *)propagator;
    if (drive_kinds(drive) & DRIVE_PULL) return pull(driven, &drive->pull, steps);
    const EngineFlow flow = {
        .flow = &drive->flow, .step_time = driven->step_time, .begun = driven->state->step - steps};
    return engine_shear(driven->engine, &flow);
}

static bool at_rest(const State *state) {
    for (int a = 0; a < state->box.dimension; a++) {
        for (size_t i = 0; i < state->count; i++) {
            if (state->velocity[a][i] != 0) return false;
        }
    }
    return true;
}

// No momentum, and exactly the kinetic energy dim N kT/2: what the Newtonian mode conserves.
static void set_energy(State *state) {
    double mass = 0, energy = 0;
    const int dimension = state->box.dimension;
    for (size_t i = 0; i < state->count; i++) mass += state->mass[i];
    for (int a = 0; a < dimension; a++) {
        double momentum = 0;
        for (size_t i = 0; i < state->count; i++)
            momentum += state->mass[i] * state->velocity[a][i];
        for (size_t i = 0; i < state->count; i++) {
            double *v = &state->velocity[a][i];
            if (state->count > 1) *v -= momentum / mass;
            energy += state->mass[i] * *v * *v / 2;
        }
    }
    const double factor = sqrt(dimension * (double)state->count / (2 * energy));
    for (int a = 0; a < dimension; a++) {
        for (size_t i = 0; i < state->count; i++) state->velocity[a][i] *= factor;
    }
}

static void draw_velocities(State *state, RngKey key) {
    for (size_t i = 0; i < state->count; i++) {
        Rng rng = rng_open(key, STREAM_VELOCITY, (uint64_t)state->step, i);
        for (int a = 0; a < state->box.dimension; a++) {
            state->velocity[a][i] = rng_normal(&rng) / sqrt(state->mass[i]);
        }
    }
    set_energy(state);
}

// What an earlier stage has sheared goes on at rest, in the box that it left behind.
static void stop_flow(State *state) {
    for (size_t i = 0; i < state->count; i++)
        state->velocity[0][i] = state_peculiar_velocity(state, 0, i);
    state->shear_rate = 0;
    set_energy(state);
}

static Status newtonian_create(Propagator **out, const Settings *settings, State *state,
                               RngKey key) {
    const EngineSettings engine = {.window = newtonian(settings)->window, .windows_per_step = 1};
    if (at_rest(state)) draw_velocities(state, key);
    if (state->shear_rate != 0) stop_flow(state);
    return propagator_create(out, &propagator_newtonian, &engine, engine.window, state, key);
}

Engine *propagator_engine(Propagator *propagator) {
    return ((EnginePropagator *)propagator)->engine;
}

static Status begin_trajectory(EnginePropagator *driven) {
    TRY(tracer_take_another_place(driven->state, driven->pull.particle, driven->key));
    engine_free(driven->engine);
    driven->engine = NULL;
    TRY(engine_create(&driven->engine, &driven->settings, driven->state, driven->key));
    engine_pull(driven->engine, &driven->pull);
    return OK;
}

static Status advance(Propagator *propagator, int64_t ticks, Tally *tally) {
    EnginePropagator *driven = (EnginePropagator *)propagator;
    while (ticks > 0) {
        const int64_t left = driven->period - driven->tick % driven->period;
        const int64_t part = ticks < left ? ticks : left;
        TRY(engine_advance(driven->engine, part, tally));
        driven->tick += part;
        ticks -= part;
        if (part == left) TRY(begin_trajectory(driven));
    }
    return OK;
}

static void release(Propagator *propagator) {
    if (!propagator) return;
    engine_free(propagator_engine(propagator));
    memory_free(propagator);
}

const PropagatorKind propagator_event_driven = {
    .name = "event-driven",
    .about = "Brownian dynamics of hard discs and spheres: exact free flight and elastic "
             "collisions, all velocities drawn anew every thermostat interval.",
    .time_unit = "d^2/D0",
    .time_meaning = "D0 is the free diffusion coefficient of the first species, half the "
                    "thermostat interval over its mass.",
    .options = {event_driven_rows, sizeof event_driven_rows / sizeof *event_driven_rows,
                sizeof(EventDriven)},
    .check = event_driven_check,
    .flies = true,
    .thermostatted = true,
    .leans = true,
    .drives = DRIVE_FLOW | DRIVE_PULL,
    .check_drive = event_driven_check_drive,
    .tick = event_driven_tick,
    .flight_time = event_driven_flight,
    .ticks_per_step = event_driven_ticks,
    .seconds_per_particle_tick = event_driven_seconds,
    .memory = engine_memory,
    .describe = event_driven_describe,
    .create = event_driven_create,
    .drive = event_driven_drive,
    .advance = advance,
    .free = release,
};

const PropagatorKind propagator_newtonian = {
    .name = "newtonian",
    .about = "Newtonian dynamics of hard discs and spheres, for fast equilibration and as the "
             "limit of long thermostat intervals.",
    .time_unit = "d sqrt(m/kT)",
    .time_meaning = "The time in which a particle of the reference mass flies about a diameter.",
    .options = {newtonian_rows, sizeof newtonian_rows / sizeof *newtonian_rows, sizeof(Newtonian)},
    .check = newtonian_check,
    .flies = true,
    .leans = true,
    .tick = newtonian_tick,
    .flight_time = newtonian_flight,
    .ticks_per_step = newtonian_ticks,
    .seconds_per_particle_tick = newtonian_seconds,
    .memory = engine_memory,
    .create = newtonian_create,
    .advance = advance,
    .free = release,
};
