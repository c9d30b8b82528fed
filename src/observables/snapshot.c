// SPDX-License-Identifier: GPL-3.0-or-later
// One configuration, for a picture: where the particles of one replica were at the start or at the
// end of the stage, and how those with a body axis were turned.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/oriented.h"
#include "observables/put.h"

#include <math.h>

typedef enum Moment { MOMENT_LAST, MOMENT_FIRST } Moment;

typedef struct SnapshotSettings {
    int64_t moment, replica;
} SnapshotSettings;

static const char *const moments[] = {"last", "first", NULL};

static const Option rows[] = {
    {.name = "moment",
     .type = OPTION_CHOICE,
     .offset = offsetof(SnapshotSettings, moment),
     .fallback = MOMENT_LAST,
     .unit = "",
     .choices = moments,
     .about = "Whether the configuration at the end or at the start of the stage is kept."},
    {.name = "replica",
     .type = OPTION_INTEGER,
     .offset = offsetof(SnapshotSettings, replica),
     .fallback = 0,
     .least = 0,
     .most = 99999,
     .unit = "",
     .about = "The replica whose configuration is kept; the first is 0."},
};

// Columns of a particle's row, here and in the results; the last four where some species has an
// axis. Particles without one have length and axis 0.
enum {
    COLUMN_X,
    COLUMN_Y,
    COLUMN_Z,
    COLUMN_DIAMETER,
    COLUMN_SPECIES,
    COLUMNS_OF_BALLS,
    COLUMN_LENGTH = COLUMNS_OF_BALLS,
    COLUMN_AXIS,
    COLUMNS_OF_BODIES = COLUMN_AXIS + 3
};

typedef struct Snapshot {
    Observer observer;
    SnapshotSettings settings;
    Oriented oriented;
    size_t particles, columns;
    double *rows;       // [particles][columns]
    double director[3]; // of this configuration
} Snapshot;

static size_t columns_of(const System *system) {
    return system_is_oriented(system) ? COLUMNS_OF_BODIES : COLUMNS_OF_BALLS;
}

static void discard(Observer *observer) {
    memory_free(((Snapshot *)observer)->rows);
    memory_free(observer);
}

static Status create(Observer **out, const Settings *settings, const State *state,
                     const Clock *clock) {
    Snapshot *snapshot = NULL;
    TRY(NEW(snapshot));
    snapshot->observer = (Observer){.kind = &observable_snapshot, .clock = *clock};
    snapshot->settings = *(const SnapshotSettings *)settings->bytes;
    snapshot->oriented = oriented_of(&state->system);
    snapshot->particles = state->count;
    snapshot->columns = columns_of(&state->system);
    return observer_begin(out, &snapshot->observer,
                          NEW_ARRAY(snapshot->rows, snapshot->columns * state->count));
}

static int64_t next(const Observer *observer, int64_t after) {
    const Snapshot *snapshot = (const Snapshot *)observer;
    const int64_t wanted = snapshot->settings.moment == MOMENT_FIRST ? 0 : observer->clock.ticks;
    return after < wanted ? wanted : INT64_MAX;
}

static void see_axis(double *row, const State *state, size_t particle) {
    const Species *species = &state->system.species[state->species_of[particle]];
    if (!shape_is_oriented((ShapeKind)species->shape)) return;
    row[COLUMN_LENGTH] = species->length;
    for (int a = 0; a < 3; a++) row[COLUMN_AXIS + a] = state->orientation[a][particle];
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tick;
    (void)tally;
    Snapshot *snapshot = (Snapshot *)observer;
    double *row = snapshot->rows;
    for (size_t i = 0; i < state->count; i++, row += snapshot->columns) {
        for (int a = 0; a < 3; a++) row[COLUMN_X + a] = state->position[a][i];
        row[COLUMN_DIAMETER] = state->diameter[i];
        row[COLUMN_SPECIES] = state->species_of[i];
        if (state->oriented) see_axis(row, state, i);
    }
    if (state->oriented) oriented_director(state, &snapshot->oriented, snapshot->director);
    return OK;
}

static const uint64_t SNAPSHOT_TAG = 0x534e415053303032; // "SNAPS002"

static void archive(Observer *observer, Archive *archive) {
    Snapshot *snapshot = (Snapshot *)observer;
    archive_tag(archive, SNAPSHOT_TAG);
    archive_f64(archive, snapshot->rows, snapshot->columns * snapshot->particles);
    archive_f64(archive, snapshot->director, 3);
}

static Status put_particles(const Snapshot *snapshot, const double *ids, Results *results,
                            size_t replica) {
    static const char *const columns[COLUMNS_OF_BODIES] = {
        "x", "y", "z", "diameter", "species", "length", "axis_x", "axis_y", "axis_z"};
    const ResultSeries shape = {
        .unit = "d",
        .axes = 2,
        .axis = {{.name = "particle", .unit = "", .count = snapshot->particles, .values = ids},
                 {.name = "column", .unit = "", .count = snapshot->columns, .labels = columns}}};
    return observer_put_series(&snapshot->observer, "snapshot", &shape, results, replica,
                               snapshot->rows);
}

static const char *const directions[3] = {"x", "y", "z"};

static Status put_director(const Snapshot *snapshot, Results *results, size_t replica) {
    const ResultSeries shape = {
        .unit = "",
        .axes = 1,
        .axis = {{.name = "direction", .unit = "", .count = 3, .labels = directions}}};
    return observer_put_series(&snapshot->observer, "snapshot_director", &shape, results, replica,
                               snapshot->director);
}

static Status put_box(const Snapshot *snapshot, const Box *box, Results *results, size_t replica) {
    const ResultSeries shape = {.unit = "d",
                                .axes = 1,
                                .axis = {{.name = "direction",
                                          .unit = "",
                                          .count = (size_t)box->dimension,
                                          .labels = directions}}};
    return observer_put_series(&snapshot->observer, "snapshot_box", &shape, results, replica,
                               box->edge);
}

static Status put(const Snapshot *snapshot, const State *state, const Box *box, Results *results,
                  size_t replica) {
    double *ids = NULL;
    TRY(NEW_ARRAY(ids, snapshot->particles));
    for (size_t i = 0; i < snapshot->particles; i++) ids[i] = (double)i;
    Status status = put_particles(snapshot, ids, results, replica);
    if (status == OK) status = put_box(snapshot, box, results, replica);
    if (status == OK && state->oriented) status = put_director(snapshot, results, replica);
    memory_free(ids);
    return status;
}

// The entries of a replica whose configuration is not kept: without them the order of all entries
// would be that in which replicas end.
static Status put_nothing(const Snapshot *snapshot, const State *state, Results *results,
                          size_t replica) {
    Snapshot nothing = *snapshot;
    const Box nowhere = {.dimension = state->box.dimension, .edge = {NAN, NAN, NAN}};
    const size_t count = snapshot->particles * snapshot->columns;
    TRY(NEW_ARRAY(nothing.rows, count));
    for (size_t i = 0; i < count; i++) nothing.rows[i] = NAN;
    for (int a = 0; a < 3; a++) nothing.director[a] = NAN;
    const Status status = put(&nothing, state, &nowhere, results, replica);
    memory_free(nothing.rows);
    return status;
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const Snapshot *snapshot = (const Snapshot *)observer;
    const bool seen = snapshot->rows[COLUMN_DIAMETER] > 0; // not where the stage ended early
    if (seen && (int64_t)replica == snapshot->settings.replica)
        return put(snapshot, state, &state->box, results, replica);
    return put_nothing(snapshot, state, results, replica);
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)clock;
    return sizeof(Snapshot) + (size_t)system->particles * columns_of(system) * sizeof(double);
}

const ObservableKind observable_snapshot = {
    .name = "snapshot",
    .about =
        "The first or last configuration of one replica: positions, sizes, species, body axes.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(SnapshotSettings)},
    .create = create,
    .next = next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
