// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of a chain. In the path of the trajectory, since it says how many trials a tick is
// worth: arithmetic and square roots only.
#include "dmc/clock.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

// One of these cycles is measured as a whole: 3 % of the work, and in calibrations every other.
static const int64_t CYCLES_PER_MARK = 32, CYCLES_PER_MARK_CALIBRATING = 2;

// What a cycle did to a species, seen as a whole and trial by trial.
typedef struct CycleSquares {
    MoveSquares whole, attempts;
} CycleSquares;

struct ChainClock {
    ClockSettings settings;
    State *state;
    RngKey key;
    Chain *chain;
    size_t species_count, counts[SPECIES_MOST];
    double step[SPECIES_MOST];
    FreeMove free[SPECIES_MOST];
    double free_cycle[SPECIES_MOST]; // of a free body, in d^2/D0
    int64_t trials;                  // since clock_restart
    bool calibrating;
    bool pulled, rests;
    ClockPull pull;
    double carried;                // fraction of a trial
    MoveTally moves[SPECIES_MOST]; // since clock_restart
    CycleSquares cycles[SPECIES_MOST];
    MoveTally moves_at_mark[SPECIES_MOST];
    double *mark[6]; // unfolded positions and axes when the measured cycle began
};

Status clock_create(ChainClock **out, const ClockSettings *settings, State *state, RngKey key) {
    ChainClock *clock = NULL;
    TRY(NEW(clock));
    *clock = (ChainClock){.settings = *settings,
                          .state = state,
                          .key = key,
                          .species_count = state->system.species_count};
    system_counts(&state->system, clock->counts);
    Status status = chain_create(&clock->chain, &settings->chain, state, key);
    for (int a = 0; a < 6 && status == OK; a++) status = NEW_ARRAY(clock->mark[a], state->count);
    if (status != OK) {
        clock_free(clock);
        return status;
    }
    *out = clock;
    return OK;
}

void clock_free(ChainClock *clock) {
    if (!clock) return;
    chain_free(clock->chain);
    for (int a = 0; a < 6; a++) memory_free(clock->mark[a]);
    memory_free(clock);
}

size_t clock_memory(const System *system) {
    return chain_memory(system) + sizeof(ChainClock) +
           6 * sizeof(double) * (size_t)system->particles;
}

double clock_pull_work(const ChainClock *clock) {
    return clock->pull.force * clock->step[clock->pull.species];
}

static double pace_at(double f) {
    return 6 * pull_drift(f) / f;
}

// Time of a free particle's trial under the force over that without one, for equal half-widths: the
// exact mean displacement over D F.
static double pull_pace(const ChainClock *clock) {
    const double f = clock_pull_work(clock);
    return clock->pull.kind == PULL_EXACT_FORCE && f > 0 ? pace_at(f) : 1;
}

double clock_pull_power(const ChainClock *clock) {
    static const double APART = 0.01; // of f, in two works between which the power is taken
    const double f = clock_pull_work(clock);
    if (clock->pull.kind != PULL_EXACT_FORCE || !(f > 0)) return 2;
    return 2 + (pace_at(f * (1 + APART)) / pace_at(f) - 1) / APART;
}

// Trials along the force are rejected more often than their time is short, so that those across it
// would diffuse too fast by 1 + f/8: they are made so much shorter.
static double across_over_along(const ChainClock *clock) {
    if (clock->pull.kind != PULL_EXACT_FORCE) return 1;
    return sqrt(pull_pace(clock) / pull_acceptance(clock_pull_work(clock)));
}

static void pull_chain(ChainClock *clock) {
    const ClockPull *pull = &clock->pull;
    if (!clock->pulled) {
        chain_pull(clock->chain, NULL);
        return;
    }
    size_t particle = 0;
    for (size_t s = 0; s < pull->species; s++) particle += clock->counts[s];
    const double along = clock->step[pull->species];
    chain_pull(clock->chain, &(ChainPull){.particle = particle,
                                          .axis = pull->axis,
                                          .force = clock->rests ? 0 : pull->force,
                                          .drifted = pull->kind == PULL_DRIFTED,
                                          .along = along,
                                          .across = along * across_over_along(clock)});
}

void clock_pull(ChainClock *clock, const ClockPull *pull) {
    clock->pulled = pull != NULL;
    clock->rests = false;
    if (pull) clock->pull = *pull;
    pull_chain(clock);
}

void clock_pull_rests(ChainClock *clock, bool rests) {
    if (rests == clock->rests) return;
    clock->rests = rests;
    pull_chain(clock);
}

static bool is_pulled(const ChainClock *clock, size_t species) {
    return clock->pulled && species == clock->pull.species;
}

void clock_set_step(ChainClock *clock, size_t species, double parallel) {
    const System *system = &clock->state->system;
    const Diffusion diffusion = species_diffusion(&system->species[species]);
    const ChainSettings *chain = &clock->settings.chain;
    const Amplitude amplitude = amplitude_matched(parallel, &diffusion, chain);
    clock->step[species] = parallel;
    clock->free[species] = amplitude_free_move(&amplitude, (int)system->dimension, chain);
    clock->free_cycle[species] =
        parallel * parallel / (6 * diffusion.parallel) * system_reference_diffusion(system);
    chain_set_amplitude(clock->chain, species, &amplitude);
    if (is_pulled(clock, species)) pull_chain(clock);
}

double clock_step(const ChainClock *clock, size_t species) {
    return clock->step[species];
}

void clock_restart(ChainClock *clock) {
    clock->trials = 0;
    clock->carried = 0;
    memset(clock->moves, 0, sizeof clock->moves);
    memset(clock->cycles, 0, sizeof clock->cycles);
}

static bool is_oriented(const ChainClock *clock, size_t species) {
    return shape_is_oriented((ShapeKind)clock->state->system.species[species].shape);
}

// Whole cycles.

static void set_mark(ChainClock *clock) {
    const State *state = clock->state;
    chain_publish(clock->chain);
    memcpy(clock->moves_at_mark, clock->moves, sizeof clock->moves);
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < state->count; i++) clock->mark[a][i] = state_unfolded(state, a, i);
        if (!state->oriented) continue;
        memcpy(clock->mark[3 + a], state->orientation[a], state->count * sizeof(double));
    }
}

static void see_particle(const ChainClock *clock, size_t i, MoveSquares *whole) {
    const State *state = clock->state;
    double r[3], square = 0, along = 0, turned = 0;
    for (int a = 0; a < 3; a++) {
        r[a] = state_unfolded(state, a, i) - clock->mark[a][i];
        square += r[a] * r[a];
    }
    if (is_oriented(clock, state->species_of[i])) {
        for (int a = 0; a < 3; a++) {
            const double turn = state->orientation[a][i] - clock->mark[3 + a][i];
            along += r[a] * clock->mark[3 + a][i];
            turned += turn * turn;
        }
    } else {
        along = r[0];
    }
    whole->parallel += along * along;
    whole->perpendicular += square - along * along;
    whole->rotational += turned / 2; // 1 - u'.u, without cancellation
}

static void see_cycle(ChainClock *clock) {
    chain_publish(clock->chain);
    for (size_t i = 0; i < clock->state->count; i++) {
        see_particle(clock, i, &clock->cycles[clock->state->species_of[i]].whole);
    }
    for (size_t s = 0; s < clock->species_count; s++) {
        const MoveTally *now = &clock->moves[s], *then = &clock->moves_at_mark[s];
        MoveSquares *attempts = &clock->cycles[s].attempts;
        attempts->parallel += now->parallel - then->parallel;
        attempts->perpendicular += now->perpendicular - then->perpendicular;
        attempts->rotational += now->rotational - then->rotational;
    }
}

static bool marks_cycles(const ChainClock *clock) {
    return clock->settings.kind == CLOCK_MATCHING && clock->settings.span == MATCH_PER_CYCLE;
}

static int64_t mark_period(const ChainClock *clock) {
    const int64_t cycles = clock->calibrating ? CYCLES_PER_MARK_CALIBRATING : CYCLES_PER_MARK;
    return cycles * (int64_t)clock->state->count;
}

// Trials since the last mark.
static int64_t since_mark(const ChainClock *clock) {
    return clock->trials % mark_period(clock);
}

// Trials.

static void count(ChainClock *clock, Tally *part, Tally *tally) {
    for (size_t s = 0; s < clock->species_count; s++) {
        MoveTally *moves = &part->moves[s];
        const double trials = (double)moves->trials;
        moves->free.parallel = trials * clock->free[s].squares.parallel;
        moves->free.perpendicular = trials * clock->free[s].squares.perpendicular;
        moves->free.rotational = trials * clock->free[s].squares.rotational;
        tally_add_moves(&clock->moves[s], moves);
    }
    if (tally) tally_add(tally, part);
}

static Status run_part(ChainClock *clock, int64_t trials, Tally *tally) {
    Tally part = {0};
    TRY(chain_run(clock->chain, trials, &part));
    count(clock, &part, tally);
    clock->trials += trials;
    return OK;
}

static int64_t least(int64_t a, int64_t b) {
    return a < b ? a : b;
}

Status clock_run(ChainClock *clock, int64_t trials, Tally *tally) {
    if (!marks_cycles(clock)) return run_part(clock, trials, tally);
    const int64_t cycle = (int64_t)clock->state->count, period = mark_period(clock);
    while (trials > 0) {
        const int64_t since = since_mark(clock);
        if (since == 0) set_mark(clock);
        const int64_t part = least(trials, since < cycle ? cycle - since : period - since);
        TRY(run_part(clock, part, tally));
        if (since_mark(clock) == cycle) see_cycle(clock);
        trials -= part;
    }
    return OK;
}

void clock_calibrate(ChainClock *clock, bool calibrating) {
    clock->calibrating = calibrating;
}

void clock_publish(ChainClock *clock) {
    chain_publish(clock->chain);
}

Status clock_take_in(ChainClock *clock) {
    Chain *chain = NULL;
    TRY(chain_create(&chain, &clock->settings.chain, clock->state, clock->key));
    chain_free(clock->chain);
    clock->chain = chain;
    for (size_t s = 0; s < clock->species_count; s++) clock_set_step(clock, s, clock->step[s]);
    return OK;
}

// Time.

uint64_t clock_trials(const ChainClock *clock, size_t species) {
    return clock->moves[species].trials;
}

double clock_acceptance(const ChainClock *clock, size_t species) {
    return (double)clock->moves[species].accepted / (double)clock->moves[species].trials;
}

// The square that is matched, of a species.
static double matched(const ChainClock *clock, size_t species, const MoveSquares *squares) {
    if (!is_oriented(clock, species)) return squares->parallel + squares->perpendicular;
    switch (clock->settings.motion) {
    case MATCH_PERPENDICULAR:
        return squares->perpendicular;
    case MATCH_ROTATIONAL:
        return squares->rotational;
    default:
        return squares->parallel;
    }
}

// (1 - exp(-y))/y to the order that small rotations need.
static double mean_kept(double y) {
    return 1 - y / 2 * (1 - y / 3 * (1 - y / 4 * (1 - y / 5)));
}

// In a cycle a body makes Poisson many trials, each in the frame that the rotations before have
// left (drawn before or after its own, each with probability 1/2). Seen in the first frame, the
// displacement of a free body along its axis is therefore not quite that of one trial, and that
// across neither; the rotational loss is 1 - exp(-l) where one trial loses l. At acceptance A all
// rotations are rarer by A. To be divided out, so that all clocks of a free body agree.
static double free_whole(const ChainClock *clock, size_t species) {
    const FreeMove *free = &clock->free[species];
    const MoveSquares *one = &free->squares;
    const double acceptance = clock_acceptance(clock, species), y = acceptance * free->second;
    if (!is_oriented(clock, species)) return 1;
    if (clock->settings.motion == MATCH_ROTATIONAL) return mean_kept(acceptance * one->rotational);
    const double all = one->parallel + one->perpendicular;
    const double kept = (1 - y / 2) * mean_kept(y); // of P2(cos) between the frames
    const double along = all / 3 + (one->parallel - all / 3) * kept;
    return clock->settings.motion == MATCH_PERPENDICULAR ? (all - along) / one->perpendicular
                                                         : along / one->parallel;
}

// [GD] eq. 19 with the acceptance as it is counted, that of bath and force together; else what the
// bath accepts, times the time of a free particle's trial.
static double pulled_cycle(const ChainClock *clock) {
    const size_t species = clock->pull.species;
    const MoveTally *moves = &clock->moves[species];
    const double share = clock->pull.kind == PULL_FIRST_ORDER
                             ? (3 * clock_acceptance(clock, species) - 1) / 2
                             : (double)moves->unhindered / (double)moves->trials;
    return clock->free_cycle[species] * share * pull_pace(clock);
}

double clock_cycle_of(const ChainClock *clock, size_t species) {
    const MoveTally *moves = &clock->moves[species];
    if (moves->trials == 0) return clock->free_cycle[species];
    if (is_pulled(clock, species)) return pulled_cycle(clock);
    if (clock->settings.kind == CLOCK_ACCEPTANCE)
        return clock->free_cycle[species] * clock_acceptance(clock, species);
    const MoveSquares squares = {moves->parallel, moves->perpendicular, moves->rotational};
    double ratio = matched(clock, species, &squares) / matched(clock, species, &moves->free);
    const CycleSquares *cycles = &clock->cycles[species];
    const double attempts = matched(clock, species, &cycles->attempts);
    if (clock->settings.span == MATCH_PER_CYCLE && attempts > 0) {
        // Attempts are many; a few whole cycles are enough to say by how much they back-scatter.
        ratio *= matched(clock, species, &cycles->whole) / (attempts * free_whole(clock, species));
    }
    return clock->free_cycle[species] * ratio;
}

double clock_cycle(const ChainClock *clock) {
    double sum = 0, particles = 0;
    for (size_t s = 0; s < clock->species_count; s++) {
        if (is_pulled(clock, s)) continue; // its steps follow the others' time
        sum += (double)clock->counts[s] * clock_cycle_of(clock, s);
        particles += (double)clock->counts[s];
    }
    return sum / particles;
}

Status clock_advance(ChainClock *clock, double time, Tally *tally) {
    const double worth = (double)clock->state->count * time / clock_cycle(clock) + clock->carried;
    const double whole = floor(worth);
    clock->carried = worth - whole;
    return clock_run(clock, (int64_t)whole, tally);
}

static const uint64_t CLOCK_TAG = 0x434c4f434b303031; // "CLOCK001"

static void archive_squares(MoveSquares *squares, Archive *archive) {
    archive_f64(archive, &squares->parallel, 1);
    archive_f64(archive, &squares->perpendicular, 1);
    archive_f64(archive, &squares->rotational, 1);
}

static void archive_species(ChainClock *clock, size_t s, Archive *archive) {
    double step = clock->step[s];
    archive_f64(archive, &step, 1);
    archive_require(archive, step >= 0 && isfinite(step), "its Monte Carlo step cannot be");
    if (archive->loading && archive_status(archive, false) == OK) clock_set_step(clock, s, step);
    tally_archive_moves(&clock->moves[s], archive);
    tally_archive_moves(&clock->moves_at_mark[s], archive);
    archive_squares(&clock->cycles[s].whole, archive);
    archive_squares(&clock->cycles[s].attempts, archive);
}

void clock_archive(ChainClock *clock, Archive *archive) {
    archive_tag(archive, CLOCK_TAG);
    archive_i64(archive, &clock->trials, 1);
    archive_require(archive, clock->trials >= 0, "its count of trials cannot be");
    archive_f64(archive, &clock->carried, 1);
    for (size_t s = 0; s < clock->species_count; s++) archive_species(clock, s, archive);
    if (archive_status(archive, false) != OK || !marks_cycles(clock)) return;
    const int64_t since = since_mark(clock);
    if (since == 0 || since >= (int64_t)clock->state->count) return; // in no measured cycle
    for (int a = 0; a < (clock->state->oriented ? 6 : 3); a++) {
        archive_f64(archive, clock->mark[a], clock->state->count);
    }
}
