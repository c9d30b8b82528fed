// SPDX-License-Identifier: GPL-3.0-or-later
// Windows in a row: draw velocities, run the kernel, see whether the neighbour list still held,
// and if it did not, go back to the last moment known to be right. The random numbers are
// addressed, so what is done again is done exactly the same.
#include "edbd/engine.h"

#include "base/cpu.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

#if defined(__has_include) && __has_include(<sanitizer/asan_interface.h>)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, size) ((void)(address), (void)(size))
#endif

static const int64_t SNAPSHOT_WINDOWS = 16; // windows at most done again after a failed list
// Rebuild this many thermal flights of a window before the end of the skin: few where one window
// does not tell of the next, more where the fastest particle goes on.
static const double MARGIN_DIFFUSIVE = 2.5, MARGIN_BALLISTIC = 4.5;
static const double BOX_DIAMETERS = 2.2; // shortest edge, in largest diameters
static const double FLIGHT_MOST = 0.05;  // thermal flight in a window, in d
static const int64_t PARTICLES_MOST = 1 << 28;
// Particles, by measurement: what fewer of them need is near in the cache anyway.
static const size_t FETCHES_FROM = 32768;
static const double BUCKETS = 200; // per particle in a time of d sqrt(m/kT): few events share one

void *engine_room_take(Room *room, size_t bytes) {
    // Arrays that begin at the same place of a page would contend for the same lines of the cache.
    static const size_t APART = 5 * MEMORY_ALIGNMENT;
    const size_t taken =
        (bytes + MEMORY_ALIGNMENT - 1) / MEMORY_ALIGNMENT * MEMORY_ALIGNMENT + APART;
    char *array = room->base ? room->base + room->used : NULL;
    // To the sanitizer what lies between two arrays is as wrong as what lies behind one of its own.
    if (array) ASAN_POISON_MEMORY_REGION(array + bytes, taken - bytes);
    room->used += taken;
    return array;
}

static void take_motion(Room *room, Motion *motion, int dimension, size_t slots) {
    for (int a = 0; a < dimension; a++) {
        TAKE_ARRAY(room, motion->place[a], slots);
        TAKE_ARRAY(room, motion->velocity[a], slots);
    }
}

static void take_room(Engine *engine) {
    Room *room = &engine->room;
    const size_t slots = engine->slots;
    take_motion(room, &engine->now, engine->dimension, slots);
    take_motion(room, &engine->spare, engine->dimension, slots);
    TAKE_ARRAY(room, engine->sketch, slots * engine->row);
    TAKE_ARRAY(room, engine->id, slots);
    TAKE_ARRAY(room, engine->spare_id, slots);
    TAKE_ARRAY(room, engine->radius, slots);
    TAKE_ARRAY(room, engine->mass, slots);
    TAKE_ARRAY(room, engine->thermal, slots);
    TAKE_ARRAY(room, engine->stamp, slots);
    TAKE_ARRAY(room, engine->bucket, engine->buckets);
    TAKE_ARRAY(room, engine->occupied, engine->buckets / BITS);
    for (int a = 0; a < engine->dimension; a++) {
        TAKE_ARRAY(room, engine->normals[a], slots);
        TAKE_ARRAY(room, engine->snapshot.image[a], engine->count);
    }
    for (int a = 0; a <= engine->dimension; a++) {
        TAKE_ARRAY(room, engine->column[a], slots + BLOCK);
        TAKE_ARRAY(room, engine->lined[a], slots + 2 * BLOCK);
    }
    TAKE_ARRAY(room, engine->lined_row, slots + 2 * BLOCK);
    list_take_room(engine);
}

static Status allocate(Engine *engine) {
    const size_t count = engine->count;
    engine->slots = (count / BLOCK + 1) * BLOCK;
    engine->fetches = count >= FETCHES_FROM;
    const double collisions = BUCKETS * engine->settings.window * (double)count;
    for (engine->buckets = 64; engine->buckets < collisions;) engine->buckets *= 2;
    engine->buckets_per_time = engine->buckets / engine->settings.window;
    engine->half_per_window = 0.5 / engine->settings.window;
    take_room(engine); // to measure it
    TRY(NEW_ARRAY(engine->room.base, engine->room.used));
    engine->room.used = 0;
    take_room(engine);
    engine->event_capacity = (uint32_t)(count + 64);
    return NEW_ARRAY(engine->events, engine->event_capacity);
}

static const EngineKernel *kernel_of(int dimension) {
    static const EngineKernel *const kernels[2][CPU_PATHS] = {
        {&engine_kernel_2d_portable, &engine_kernel_2d_avx2, &engine_kernel_2d_avx512},
        {&engine_kernel_3d_portable, &engine_kernel_3d_avx2, &engine_kernel_3d_avx512},
    };
    return kernels[dimension - 2][cpu_path()];
}

static void take_in(Engine *engine) {
    const State *state = engine->state;
    for (size_t i = 0; i < engine->count; i++) {
        engine->id[i] = (uint32_t)i;
        for (int a = 0; a < engine->dimension; a++) {
            engine->now.place[a][i] = state->position[a][i];
            engine->now.velocity[a][i] = state->velocity[a][i];
        }
        engine->largest = fmax(engine->largest, state->diameter[i]);
        engine->radius[i] = state->diameter[i] / 2;
        engine->mass[i] = state->mass[i];
        engine->thermal[i] = 1 / sqrt(state->mass[i]);
        engine->fastest = fmax(engine->fastest, engine->thermal[i]);
    }
}

static void choose_margin(Engine *engine) {
    const bool diffusive = engine->settings.redraw && engine->settings.windows_per_step == 1;
    const double thermal = (diffusive ? MARGIN_DIFFUSIVE : MARGIN_BALLISTIC) * engine->fastest;
    engine->margin = (thermal + engine->pull.drift) * engine->settings.window;
}

// How much single precision errs.
static void allow_for_rounding(Engine *engine) {
    // Places are rounded by up to 2^-24 of the longest edge in each direction; products of
    // separations not much above the largest diameter, by up to some 2^-24 of themselves besides.
    // Displacements of images are rounded like a place.
    double longest = 0;
    for (int a = 0; a < engine->dimension; a++) longest = fmax(longest, engine->edge[a]);
    if (engine->sheared) longest *= 2;
    engine->place_error = 4e-7 * longest;
    engine->sketch_error = (float)(1e-6 * engine->largest * (longest + 2 * engine->largest));
}

// From D0/d^2 to sqrt(kT/m)/d: the strain of a step is the same.
static double rate_of_flight(const Engine *engine, double rate) {
    const double interval = engine->settings.window * (double)engine->settings.windows_per_step;
    return rate * (engine->flow.step_time / interval);
}

// The mean over a step.
static double shear_rate_in(const Engine *engine, int64_t step) {
    const EngineFlow *flow = &engine->flow;
    if (!flow->flow) return 0;
    const double from = (double)(step - flow->begun) * flow->step_time;
    const double to = (double)(step + 1 - flow->begun) * flow->step_time;
    return rate_of_flight(engine, flow_rate(flow->flow, from, to));
}

static void set_shear_rate(Engine *engine, double rate) {
    engine->rate = rate;
    engine->image_velocity = rate * engine->edge[1];
}

static void take_box(Engine *engine) {
    engine->offset = engine->state->box.offset;
    engine->turns = (int32_t)engine->state->box.turns;
}

static Status give_out(Engine *engine) {
    State *state = engine->state;
    double sums[4] = {0}; // so that none need wait for another
    for (int a = 0; a < engine->dimension; a++) {
        const double *place = engine->now.place[a], *velocity = engine->now.velocity[a];
        for (size_t slot = 0; slot < engine->count; slot++) {
            const uint32_t id = engine->id[slot];
            state->position[a][id] = place[slot];
            state->velocity[a][id] = velocity[slot];
            sums[slot % 4] += place[slot] + velocity[slot];
        }
    }
    if (isfinite((sums[0] + sums[1]) + (sums[2] + sums[3]))) return OK;
    return status_fail(UNHEALTHY, "a position or velocity is no longer a number after step %lld",
                       (long long)state->step);
}

Status engine_create(Engine **out, const EngineSettings *settings, State *state, RngKey key) {
    Engine *engine = NULL;
    TRY(NEW(engine));
    *engine = (Engine){.settings = *settings,
                       .state = state,
                       .key = key,
                       .dimension = state->box.dimension,
                       .row = state->box.dimension == 2 ? ROW_2D : ROW_3D,
                       .count = state->count,
                       .scale = 1,
                       .kernel = kernel_of(state->box.dimension)};
    memcpy(engine->edge, state->box.edge, sizeof engine->edge);
    engine->sheared = !box_is_rectangular(&state->box);
    take_box(engine);
    Status status = allocate(engine);
    if (status == OK) {
        take_in(engine);
        choose_margin(engine);
        allow_for_rounding(engine);
        status = list_build(engine);
    }
    if (status != OK) {
        engine_free(engine);
        return status;
    }
    *out = engine;
    return OK;
}

void engine_free(Engine *engine) {
    if (!engine) return;
    memory_free(engine->room.base);
    memory_free(engine->events);
    list_free(engine);
    memory_free(engine);
}

Status engine_shear(Engine *engine, const EngineFlow *flow) {
    engine->flow = *flow;
    engine->sheared = 1;
    // Partners bring along what the flow does across a diameter.
    engine->fastest += rate_of_flight(engine, flow_fastest(flow->flow)) * engine->largest;
    choose_margin(engine);
    allow_for_rounding(engine);
    engine->list.skin = 0; // to be chosen again
    return list_build(engine);
}

void engine_pull(Engine *engine, const EnginePull *pull) {
    ASSERT(engine->settings.redraw && pull->period > 0);
    engine->pull = *pull;
    choose_margin(engine);
}

void engine_grow(Engine *engine, double scale, double rate) {
    ASSERT(!engine->sheared);
    engine->scale = scale;
    engine->growth = rate;
}

void engine_record(Engine *engine, CollisionLog *log) {
    engine->log = log;
}

// Normal numbers for the velocities of the window that is opened next, if that begins a step.
static void draw(Engine *engine, int64_t step) {
    engine->redraw = 1;
    rng_normals_single(engine->key, engine->settings.stream, (uint64_t)step, engine->id,
                       engine->count, engine->dimension, engine->normals);
}

static void copy_motion(const Engine *engine, const Motion *to, const Motion *from) {
    for (int a = 0; a < engine->dimension; a++) {
        memcpy(to->place[a], from->place[a], engine->count * sizeof(double));
        memcpy(to->velocity[a], from->velocity[a], engine->count * sizeof(double));
    }
}

static bool is_pulled_in(const Engine *engine, int64_t step) {
    const EnginePull *pull = &engine->pull;
    return pull->period > 0 && (step - pull->begun) % pull->period < pull->on;
}

// The velocities of a step have been drawn: that of the tracer has the drift besides.
static void pull_tracer(Engine *engine, int64_t step) {
    const EnginePull *pull = &engine->pull;
    if (!is_pulled_in(engine, step)) return;
    if (engine->id[engine->pulled] != pull->particle)
        for (engine->pulled = 0; engine->id[engine->pulled] != pull->particle;) engine->pulled++;
    engine->now.velocity[pull->axis][engine->pulled] += pull->drift;
    engine->kernel->sketch(engine, (uint32_t)engine->pulled);
}

static void snapshot_take(Engine *engine) {
    Snapshot *snapshot = &engine->snapshot;
    copy_motion(engine, &engine->spare, &engine->now);
    for (int a = 0; a < engine->dimension; a++) {
        memcpy(snapshot->image[a], engine->state->image[a], engine->count * sizeof(int32_t));
    }
    snapshot->box = engine->state->box;
    snapshot->left = engine->left;
    snapshot->step = engine->state->step;
    snapshot->window = engine->window;
    snapshot->scale = engine->scale;
    snapshot->tally = engine->tally;
    snapshot->recorded = engine->log ? engine->log->count : 0;
    snapshot->windows = 0;
}

// The order in memory is that of the snapshot: the list is never rebuilt without a new one.
static void snapshot_restore(Engine *engine) {
    const Snapshot *snapshot = &engine->snapshot;
    const Tally *tally = &engine->tally;
    const uint64_t rebuilds = tally->rebuilds, replays = tally->replays, stale = tally->stale;
    copy_motion(engine, &engine->now, &engine->spare);
    for (int a = 0; a < engine->dimension; a++) {
        memcpy(engine->state->image[a], snapshot->image[a], engine->count * sizeof(int32_t));
    }
    engine->state->box = snapshot->box;
    take_box(engine);
    set_shear_rate(engine, shear_rate_in(engine, snapshot->step));
    engine->left = snapshot->left;
    engine->state->step = snapshot->step;
    engine->window = snapshot->window;
    engine->scale = snapshot->scale;
    engine->tally = snapshot->tally;
    engine->tally.rebuilds = rebuilds;
    engine->tally.replays = replays + 1;
    engine->tally.stale = stale;
    if (engine->log) engine->log->count = snapshot->recorded;
}

static Status renew_list(Engine *engine) {
    TRY(list_build(engine));
    snapshot_take(engine);
    return OK;
}

static Status more_events(Engine *engine) {
    Event *events = NULL;
    const uint32_t capacity = 2 * engine->event_capacity;
    TRY(NEW_ARRAY(events, capacity));
    memory_free(engine->events);
    engine->events = events;
    engine->event_capacity = capacity;
    engine->outgrown = 0;
    return OK;
}

// Goes back, mends what failed, and lets the loop do it again with a new list. Where that fails at
// the same place, the list is rebuilt in every window until well past it.
static Status replay(Engine *engine, bool list_failed) {
    const bool made_at_snapshot = engine->list.age == engine->snapshot.windows;
    const bool fresh = made_at_snapshot && engine->list.age == 1;
    snapshot_restore(engine);
    engine->hung = 0; // with collisions missed, anything may happen
    if (engine->outgrown) TRY(more_events(engine));
    if (fresh && list_failed) {
        return status_fail(UNHEALTHY,
                           "in step %lld a particle moves farther in a window of %g than "
                           "its neighbour list reaches (%g); use a shorter window",
                           (long long)engine->state->step, engine->settings.window,
                           list_reach(engine));
    }
    engine->careful = list_failed && made_at_snapshot ? 2 * SNAPSHOT_WINDOWS : 0;
    return renew_list(engine);
}

static void next_window(Engine *engine) {
    engine->left--;
    engine->snapshot.windows++;
    engine->tally.windows++;
    engine->list.age++;
    engine->scale += engine->growth * engine->settings.window;
    engine->state->shear_rate = engine->rate;
    if (++engine->window < engine->settings.windows_per_step) return;
    engine->window = 0;
    engine->state->step++;
    set_shear_rate(engine, engine->next_rate);
}

// Before a particle leaves the reach of the list: look again which pairs are near, and when that
// has used up the list itself, make a new one.
static Status keep_list(Engine *engine) {
    const double needed = sqrt(engine->list.farthest2) + engine->margin;
    if (engine->careful > 0 && --engine->careful > 0) return renew_list(engine);
    if (needed < list_reach(engine)) return OK;
    if (!engine->list.pruned || needed + engine->margin > list_outer_reach(engine)) {
        return renew_list(engine);
    }
    list_prune(engine);
    return OK;
}

// A window, and what the next one begins with.
static void run_kernel(Engine *engine) {
    const bool ends_step = engine->window + 1 == engine->settings.windows_per_step;
    engine->redraw = 0;
    engine->next_rate = ends_step ? shear_rate_in(engine, engine->state->step + 1) : engine->rate;
    if (engine->settings.redraw && ends_step && engine->left > 1)
        draw(engine, engine->state->step + 1);
    if (engine->sheared)
        engine->kernel->run_sheared(engine);
    else if (engine->growth != 0 || engine->scale != 1)
        engine->kernel->run_growing(engine);
    else
        engine->kernel->run_window(engine);
    if (engine->redraw) pull_tracer(engine, engine->state->step + 1);
}

static Status one_window(Engine *engine) {
    run_kernel(engine);
    next_window(engine);
    const bool list_failed = !(sqrt(engine->list.farthest2) <= list_reach(engine));
    if (list_failed || engine->outgrown) return replay(engine, list_failed);
    if (engine->hung) {
        return status_fail(UNHEALTHY,
                           "a particle collided more than 1000 times within one window "
                           "of %g before step %lld: the packing is jammed or overlaps",
                           engine->settings.window, (long long)engine->state->step + 1);
    }
    TRY(keep_list(engine));
    if (engine->snapshot.windows >= SNAPSHOT_WINDOWS) snapshot_take(engine);
    return OK;
}

Status engine_advance(Engine *engine, int64_t windows, Tally *tally) {
    engine->tally = *tally;
    engine->left = windows;
    if (engine->scale != engine->list.scale) TRY(list_build(engine));
    engine->redraw = 0;
    set_shear_rate(engine, shear_rate_in(engine, engine->state->step));
    engine->next_rate = engine->rate;
    if (engine->settings.redraw && engine->window == 0) draw(engine, engine->state->step);
    engine->kernel->open_window(engine);
    if (engine->redraw) pull_tracer(engine, engine->state->step);
    snapshot_take(engine);
    while (engine->left > 0) TRY(one_window(engine));
    *tally = engine->tally;
    return give_out(engine);
}

Status engine_check(const System *system, double window) {
    const Box box = system_box(system);
    double largest = 0, lightest = system->species[0].mass;
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        const double spread = species->spread == SPREAD_NONE ? 0 : 3 * species->spread_width;
        if (species->shape != SHAPE_DISC && species->shape != SHAPE_SPHERE) {
            return status_fail(BAD_DATA,
                               "method = event-driven or newtonian moves discs and spheres, and "
                               "'%s' is a %s; use dynamic-monte-carlo",
                               species->name, shape_names[species->shape]);
        }
        if (shape_dimension((ShapeKind)species->shape) != system->dimension) {
            return status_fail(BAD_DATA,
                               "species '%s': a %s lives in %d dimensions, the system has "
                               "%lld",
                               species->name, shape_names[species->shape],
                               shape_dimension((ShapeKind)species->shape),
                               (long long)system->dimension);
        }
        largest = fmax(largest, species->diameter * (1 + spread));
        lightest = fmin(lightest, species->mass);
    }
    for (int a = 0; a < box.dimension; a++) {
        if (box.edge[a] >= BOX_DIAMETERS * largest) continue;
        return status_fail(BAD_DATA,
                           "the box is %.4g d long along %c, less than %g times the "
                           "largest diameter of %g d; take more particles",
                           box.edge[a], "xyz"[a], BOX_DIAMETERS, largest);
    }
    if (system->particles > PARTICLES_MOST) {
        return status_fail(BAD_DATA, "particles = %lld is more than the event-driven method's %lld",
                           (long long)system->particles, (long long)PARTICLES_MOST);
    }
    if (window / sqrt(lightest) <= FLIGHT_MOST) return OK;
    return status_fail(BAD_DATA,
                       "particles of mass %g fly %.3g d in a window of %g, more than %g; "
                       "use windows of %.3g at most",
                       lightest, window / sqrt(lightest), window, FLIGHT_MOST,
                       FLIGHT_MOST * sqrt(lightest));
}

size_t engine_memory(const System *system) {
    // Typical of dense fluids: pairs in the half list, neighbours padded to whole blocks.
    static const double pairs[2] = {3.5, 6.5}, neighbours[2] = {8, 16};
    const int three = system->dimension == 3;
    const double axes = 6 * sizeof(double) + 4 * sizeof(uint32_t); // of each
    const double arrays = (double)system->dimension * axes + 3 * sizeof(double) +
                          ((three ? ROW_3D : ROW_2D) + 11) * sizeof(uint32_t) + sizeof(Event);
    const double lists = pairs[three] * (6 * sizeof(uint32_t) + 2 * sizeof(float)) +
                         neighbours[three] * (sizeof(uint32_t) + sizeof(float));
    const double spare = 1.125; // room that lists grow by
    return (size_t)((double)system->particles * (arrays + spare * lists)) + sizeof(Engine);
}
