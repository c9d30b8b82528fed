// SPDX-License-Identifier: GPL-3.0-or-later
// The seam between physics and house: everything that advances time looks like this. Time is an
// integer count of ticks, each `tick` long; a step is a whole number of ticks, and at the end of a
// step the State, with what `archive` saves, determines the future.
#pragma once

#include "base/option.h"
#include "base/text.h"
#include "propagator/drive.h"
#include "rng/rng.h"
#include "state/state.h"
#include "state/tally.h"

enum { SETTINGS_SIZE = 3072 };

// Room for the settings struct of any kind; its OptionTable says what lies in it.
typedef struct Settings {
    _Alignas(16) unsigned char bytes[SETTINGS_SIZE];
} Settings;

typedef struct PropagatorKind PropagatorKind;

// The first member of each propagator's own struct.
typedef struct Propagator {
    const PropagatorKind *kind;
} Propagator;

struct PropagatorKind {
    const char *name;      // `dynamics.method` in the run file
    const char *about;     // one sentence
    const char *time_unit; // of stages run with it
    const char *time_meaning;
    OptionTable options;

    // BAD_DATA with a sentence if this method cannot do this system with these settings.
    Status (*check)(const Settings *settings, const System *system);
    bool flies;         // there are velocities, and collisions that the Tally counts
    bool thermostatted; // velocities are redrawn, so that positions diffuse
    bool leans;         // can go on in a box that an earlier stage has sheared
    unsigned drives;    // which it can do, of DriveKind
    // BAD_DATA with a sentence that begins with the key, if it cannot be driven like this with
    // these settings; NULL where it can be.
    Status (*check_drive)(const Settings *settings, const System *system, const Drive *drive);
    double (*tick)(const Settings *settings, const System *system); // in time_unit
    double (*flight_time)(const Settings *settings); // of a tick, in d sqrt(m/kT); if it `flies`
    int64_t (*ticks_per_step)(const Settings *settings);
    double (*seconds_per_particle_tick)(const Settings *, const System *); // rough, for `check`
    size_t (*memory)(const System *system);                                // bytes per replica
    // What follows from the settings for a stage of this time, driven like this, as lines for
    // `check`; may be NULL.
    void (*describe)(const Settings *settings, const System *system, const Drive *drive,
                     double time, Text *lines);

    // Borrows the state until free. Draws velocities where the state has none (all zero).
    Status (*create)(Propagator **out, const Settings *settings, State *state, RngKey key);
    // What drives the stage, of which so many steps are done; called after create, unless at rest.
    Status (*drive)(Propagator *propagator, const Drive *drive, int64_t steps);
    // Called once, when a stage begins and before its time does; NULL where there is nothing to do.
    // May move the particles.
    Status (*prepare)(Propagator *propagator);
    // On return the state is that of `ticks` later. advance(a), advance(b) gives the bits of
    // advance(a + b).
    Status (*advance)(Propagator *propagator, int64_t ticks, Tally *tally);
    // What the State does not hold; NULL if it holds all.
    void (*archive)(Propagator *propagator, Archive *archive);
    void (*free)(Propagator *propagator);
};

// Becomes: extern const PropagatorKind propagator_event_driven; ...
#define PROPAGATOR(id) extern const PropagatorKind propagator_##id;
#include "propagator/propagators.def"
#undef PROPAGATOR

extern const PropagatorKind *const propagator_kinds[];         // NULL-ended
const PropagatorKind *propagator_kind_named(const char *name); // NULL if none

// A method and its settings, as the run file gives them.
typedef struct Dynamics {
    const PropagatorKind *kind;
    Settings settings;
} Dynamics;
