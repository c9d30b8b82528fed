// SPDX-License-Identifier: GPL-3.0-or-later
// Event-driven dynamics of hard discs and spheres in windows: free flight and elastic collisions,
// exactly, between moments at which the velocities may be drawn anew (Weysser, thesis, ch. 2). With
// the redraw it is Brownian dynamics for times well above the thermostat interval, without it
// Newtonian; with growing diameters it packs (Lubachevsky and Stillinger 1990). The propagators
// made of it are propagator_event_driven and propagator_newtonian.
#pragma once

#include "propagator/propagator.h"

typedef struct Engine Engine;

typedef struct EngineSettings {
    double window;            // in d sqrt(m/kT)
    int64_t windows_per_step; // velocities are drawn at the start of each step, if at all
    int redraw;               // 1: they are
    RngStream stream;         // of the drawn velocities
} EngineSettings;

// Borrows the state: its diameters are the contact distances at scale 1.
Status engine_create(Engine **out, const EngineSettings *settings, State *state, RngKey key);
void engine_free(Engine *engine);

// Advances the state by so many windows. Splitting a run into calls changes no bit of it.
Status engine_advance(Engine *engine, int64_t windows, Tally *tally);

// Diameters are `scale` times those of the state, and grow by `rate` of those per unit of time.
void engine_grow(Engine *engine, double scale, double rate);

// The flow v_x = rate y, whose rate in each step is the mean over that step.
typedef struct EngineFlow {
    const Flow *flow; // borrowed
    double step_time; // of a step, in d^2/D0
    int64_t begun;    // the step of the state at which the flow's time began
} EngineFlow;

// From the next step on; once in the life of an engine. In a box that leans the images are where it
// has them, flow or none.
Status engine_shear(Engine *engine, const EngineFlow *flow);

// A constant force on one particle of an engine that redraws: D F, added to its velocity wherever
// that is drawn, so that alone it drifts and diffuses exactly, whatever the interval.
typedef struct EnginePull {
    size_t particle; // its id
    int axis;
    double drift;       // in sqrt(kT/m)
    int64_t begun;      // the step of the state at which the stage began
    int64_t period, on; // steps of a trajectory, and of its first part, which has the force
} EnginePull;

// From the next step on; once in the life of an engine.
void engine_pull(Engine *engine, const EnginePull *pull);

// BAD_DATA with a sentence if engines cannot do this system in windows of this length.
Status engine_check(const System *system, double window);
size_t engine_memory(const System *system); // bytes

// What happened, for tests: the collisions in the order in which they were carried out.
typedef struct CollisionRecord {
    uint32_t low, high; // ids of the partners
    int64_t step;       // of the state
    int64_t window;     // of the step
    double time;        // since the window began
} CollisionRecord;

typedef struct CollisionLog {
    CollisionRecord *records;
    size_t capacity; // further collisions are counted, not kept
    size_t count;
} CollisionLog;

void engine_record(Engine *engine, CollisionLog *log); // NULL: no more
Engine *propagator_engine(Propagator *propagator);     // of a propagator of this module
