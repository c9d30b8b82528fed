// SPDX-License-Identifier: GPL-3.0-or-later
// Each particle has its own clock and one entry in the calendar: the earliest of its collisions and
// its next step into another cell. An entry whose partner has meanwhile collided is stale; it is
// predicted again when its turn comes. That suffices: a partner's new path predicts its own
// meetings, and without it the particle has nothing earlier to do.
#include "reference_engine.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { NOBODY = -1, CELLS_LEAST = 3 };

// Which cell along each axis, and of which periodic image of the box.
typedef struct Cell {
    int at[3], box[3];
} Cell;

typedef struct Particle {
    double position[3]; // unfolded, at its clock
    double velocity[3];
    double clock; // since the interval began
    double radius, mass;
    uint64_t turns; // changes of velocity
    Cell cell;
    int next, previous; // in its cell

    double time;            // of its next event
    int partner;            // NOBODY: it steps into another cell, along `axis`
    uint64_t partner_turns; // when this was predicted
    int axis, direction;
} Particle;

struct Reference {
    State *state;
    RngKey key;
    double interval;
    double rate; // of the shear
    size_t pulled;
    int pull_axis;
    double drift; // of the one pulled
    bool thermostatted, all_pairs;
    int dimension, count;
    Particle *particles;
    int cells[3]; // along each axis
    double cell_edge[3];
    int *first; // [cells], first particle of each cell
    int *heap;  // particles, the earliest at the root
    int *place; // [particle], where it stands in the heap
    uint32_t *ids;
    double *normals[3];
    ReferenceLog *log;
    Tally tally;
};

// ---- Cells

static size_t cell_count(const Reference *reference) {
    return (size_t)reference->cells[0] * (size_t)reference->cells[1] * (size_t)reference->cells[2];
}

static int *first_of_cell(const Reference *reference, const Cell *cell) {
    const int *cells = reference->cells, *at = cell->at;
    return reference->first +
           ((size_t)at[2] * (size_t)cells[1] + (size_t)at[1]) * (size_t)cells[0] + at[0];
}

// The next cell up or down along an axis, through the edge of the box if need be.
static void step(const Reference *reference, Cell *cell, int axis, int direction) {
    const int cells = reference->cells[axis];
    cell->at[axis] += direction;
    if (cell->at[axis] < 0) cell->at[axis] += cells, cell->box[axis]--;
    if (cell->at[axis] >= cells) cell->at[axis] -= cells, cell->box[axis]++;
}

static void enter_cell(Reference *reference, int i) {
    Particle *particle = &reference->particles[i];
    int *first = first_of_cell(reference, &particle->cell);
    particle->previous = NOBODY;
    particle->next = *first;
    if (*first != NOBODY) reference->particles[*first].previous = i;
    *first = i;
}

static void leave_cell(Reference *reference, int i) {
    const Particle *particle = &reference->particles[i];
    if (particle->next != NOBODY) {
        reference->particles[particle->next].previous = particle->previous;
    }
    if (particle->previous == NOBODY) {
        *first_of_cell(reference, &particle->cell) = particle->next;
    } else {
        reference->particles[particle->previous].next = particle->next;
    }
}

// ---- Prediction

static double position_at(const Particle *particle, int axis, double time) {
    return particle->position[axis] + particle->velocity[axis] * (time - particle->clock);
}

// How far the images one box above have moved along x at a time of the interval.
static double image_offset(const Reference *reference, double time) {
    const Box *box = &reference->state->box;
    return box->offset + reference->rate * box->edge[1] * time;
}

// r = r_i - r_j at the clock of i, j displaced by whole boxes.
static void separation(const Reference *reference, int i, int j, const int boxes[3], double r[3]) {
    const Particle *one = &reference->particles[i], *other = &reference->particles[j];
    for (int a = 0; a < reference->dimension; a++) {
        r[a] = one->position[a] - position_at(other, a, one->clock) -
               (double)boxes[a] * reference->state->box.edge[a];
    }
    r[0] -= boxes[1] * image_offset(reference, one->clock);
}

// v_i - v_j, j displaced by whole boxes.
static void relative_velocity(const Reference *reference, int i, int j, const int boxes[3],
                              double v[3]) {
    const Particle *one = &reference->particles[i], *other = &reference->particles[j];
    for (int a = 0; a < reference->dimension; a++) v[a] = one->velocity[a] - other->velocity[a];
    v[0] -= boxes[1] * reference->rate * reference->state->box.edge[1];
}

// In which box j is nearest to i, at the clock of i.
static void nearest_boxes(const Reference *reference, int i, int j, int boxes[3]) {
    const double *edge = reference->state->box.edge;
    double r[3];
    boxes[0] = boxes[1] = boxes[2] = 0;
    separation(reference, i, j, boxes, r);
    for (int a = 1; a < reference->dimension; a++) boxes[a] = (int)rint(r[a] / edge[a]);
    separation(reference, i, j, boxes, r);
    boxes[0] = (int)rint(r[0] / edge[0]);
}

// When discs or spheres at separation r meet, INFINITY if never: |r + v t| = s (Weysser, thesis,
// eq. 2.2), solved so that nothing cancels. Pairs that overlap and approach meet at once.
static double time_to_meeting(int dimension, const double r[3], const double v[3], double s) {
    double b = 0, r2 = 0, v2 = 0;
    for (int a = 0; a < dimension; a++) {
        b += r[a] * v[a];
        r2 += r[a] * r[a];
        v2 += v[a] * v[a];
    }
    const double c = r2 - s * s;
    if (b >= 0) return INFINITY;
    if (c <= 0) return 0;
    const double discriminant = b * b - v2 * c;
    return discriminant < 0 ? INFINITY : c / (-b + sqrt(discriminant));
}

static void consider_meeting(Reference *reference, int i, int j, const int boxes[3]) {
    Particle *one = &reference->particles[i];
    const Particle *other = &reference->particles[j];
    double r[3], v[3];
    separation(reference, i, j, boxes, r);
    relative_velocity(reference, i, j, boxes, v);
    const double contact = one->radius + other->radius;
    const double time = one->clock + time_to_meeting(reference->dimension, r, v, contact);
    if (time >= one->time) return;
    one->time = time;
    one->partner = j;
    one->partner_turns = other->turns;
}

static void consider_crossings(Reference *reference, int i) {
    Particle *particle = &reference->particles[i];
    for (int a = 0; a < reference->dimension; a++) {
        const double speed = particle->velocity[a];
        if (speed == 0) continue;
        const double wall = particle->cell.box[a] * reference->state->box.edge[a] +
                            (particle->cell.at[a] + (speed > 0)) * reference->cell_edge[a];
        const double distance = wall - particle->position[a];
        const double wait = distance / speed, time = particle->clock + (wait > 0 ? wait : 0);
        if (time >= particle->time) continue;
        particle->time = time;
        particle->partner = NOBODY;
        particle->axis = a;
        particle->direction = speed > 0 ? 1 : -1;
    }
}

// The k-th of the 3^dimension neighbours of a cell, or of a box, itself among them.
static void neighbour(int k, int offset[3]) {
    for (int a = 0; a < 3; a++, k /= 3) offset[a] = k % 3 - 1;
}

static void consider_cell(Reference *reference, int i, const int offset[3], int after) {
    Cell cell = reference->particles[i].cell;
    for (int a = 0; a < reference->dimension; a++) step(reference, &cell, a, offset[a]);
    for (int j = *first_of_cell(reference, &cell); j != NOBODY; j = reference->particles[j].next) {
        if (j == i || j <= after) continue;
        int boxes[3];
        for (int a = 0; a < 3; a++) boxes[a] = cell.box[a] - reference->particles[j].cell.box[a];
        consider_meeting(reference, i, j, boxes);
    }
}

// The nearest image and those around it.
static void consider_everyone(Reference *reference, int i, const int offset[3], int after) {
    for (int j = after + 1; j < reference->count; j++) {
        if (j == i) continue;
        int boxes[3];
        nearest_boxes(reference, i, j, boxes);
        for (int a = 0; a < reference->dimension; a++) boxes[a] += offset[a];
        consider_meeting(reference, i, j, boxes);
    }
}

// The next event of particle i from its clock on, among the particles whose ids are above `after`.
static void predict(Reference *reference, int i, int after) {
    Particle *particle = &reference->particles[i];
    particle->time = INFINITY;
    particle->partner = NOBODY;
    if (!reference->all_pairs) consider_crossings(reference, i);
    const int neighbours = reference->dimension == 2 ? 9 : 27;
    for (int k = 0; k < neighbours; k++) {
        // In two dimensions the nine of the middle layer.
        int offset[3];
        neighbour(reference->dimension == 2 ? k + 9 : k, offset);
        if (reference->all_pairs) {
            consider_everyone(reference, i, offset, after);
        } else {
            consider_cell(reference, i, offset, after);
        }
    }
}

// ---- Calendar: a binary heap of particles by the time of their next event, ties by id

static bool earlier(const Reference *reference, int i, int j) {
    const double a = reference->particles[i].time, b = reference->particles[j].time;
    return a < b || (a == b && i < j);
}

static void put(Reference *reference, int place, int i) {
    reference->heap[place] = i;
    reference->place[i] = place;
}

static void sift_up(Reference *reference, int place) {
    const int i = reference->heap[place];
    while (place > 0) {
        const int parent = (place - 1) / 2;
        if (!earlier(reference, i, reference->heap[parent])) break;
        put(reference, place, reference->heap[parent]);
        place = parent;
    }
    put(reference, place, i);
}

static void sift_down(Reference *reference, int place) {
    const int i = reference->heap[place];
    for (;;) {
        int child = 2 * place + 1;
        if (child >= reference->count) break;
        if (child + 1 < reference->count &&
            earlier(reference, reference->heap[child + 1], reference->heap[child])) {
            child++;
        }
        if (!earlier(reference, reference->heap[child], i)) break;
        put(reference, place, reference->heap[child]);
        place = child;
    }
    put(reference, place, i);
}

static void predict_and_enter(Reference *reference, int i) {
    predict(reference, i, NOBODY);
    sift_up(reference, reference->place[i]);
    sift_down(reference, reference->place[i]);
}

// ---- Events

static void move_to(const Reference *reference, Particle *particle, double time) {
    for (int a = 0; a < reference->dimension; a++) {
        particle->position[a] = position_at(particle, a, time);
    }
    particle->clock = time;
}

static void note(Reference *reference, int i, int j, double time) {
    ReferenceLog *log = reference->log;
    if (!log) return;
    if (log->count < log->capacity) {
        log->records[log->count] = (ReferenceCollision){.low = (uint32_t)(i < j ? i : j),
                                                        .high = (uint32_t)(i < j ? j : i),
                                                        .step = reference->state->step,
                                                        .time = time};
    }
    log->count++;
}

// r_i - r_j and v_i - v_j of partners that touch: of the nearest image. How deep they overlap is
// kept.
static void contact_vector(Reference *reference, int i, int j, double r[3], double v[3]) {
    const Particle *one = &reference->particles[i], *other = &reference->particles[j];
    int boxes[3];
    nearest_boxes(reference, i, j, boxes);
    separation(reference, i, j, boxes, r);
    relative_velocity(reference, i, j, boxes, v);
    double r2 = 0;
    for (int a = 0; a < reference->dimension; a++) r2 += r[a] * r[a];
    const double depth = 1 - sqrt(r2) / (one->radius + other->radius);
    if (depth > reference->tally.deepest_contact) reference->tally.deepest_contact = depth;
}

// Elastic: the momenta change along r by -2 m_i m_j/(m_i + m_j) (v.r) r/r^2 (Weysser, thesis, eq.
// 2.5, with the square that its denominator lacks in print).
static void collide(Reference *reference, int i, int j, double time) {
    Particle *one = &reference->particles[i], *other = &reference->particles[j];
    move_to(reference, other, time);
    double r[3] = {0, 0, 0}, v[3], b = 0, r2 = 0;
    contact_vector(reference, i, j, r, v);
    for (int a = 0; a < reference->dimension; a++) {
        b += r[a] * v[a];
        r2 += r[a] * r[a];
    }
    const double momentum = -2 * one->mass * other->mass / (one->mass + other->mass) * b / r2;
    for (int a = 0; a < reference->dimension; a++) {
        one->velocity[a] += momentum * r[a] / one->mass;
        other->velocity[a] -= momentum * r[a] / other->mass;
        for (int c = 0; c < reference->dimension; c++) {
            reference->tally.exchange[a][c] += r[a] * momentum * r[c];
        }
    }
    one->turns++;
    other->turns++;
    reference->tally.collisions++;
    note(reference, i, j, time);
}

static void cross(Reference *reference, int i) {
    Particle *particle = &reference->particles[i];
    leave_cell(reference, i);
    step(reference, &particle->cell, particle->axis, particle->direction);
    enter_cell(reference, i);
}

static void next_event(Reference *reference) {
    const int i = reference->heap[0];
    Particle *particle = &reference->particles[i];
    const double now = particle->time;
    const int partner = particle->partner;
    move_to(reference, particle, now);
    if (partner == NOBODY) {
        cross(reference, i);
    } else if (reference->particles[partner].turns != particle->partner_turns) {
        reference->tally.stale++;
    } else {
        collide(reference, i, partner, now);
        predict_and_enter(reference, partner);
    }
    predict_and_enter(reference, i);
}

// ---- Intervals

static void draw_velocities(Reference *reference) {
    State *state = reference->state;
    rng_normals(reference->key, STREAM_VELOCITY, (uint64_t)state->step, reference->ids,
                state->count, reference->dimension, reference->normals);
    for (size_t i = 0; i < state->count; i++) {
        const double thermal_speed = 1 / sqrt(state->mass[i]);
        for (int a = 0; a < reference->dimension; a++) {
            state->velocity[a][i] = reference->normals[a][i] * thermal_speed;
        }
        state->velocity[0][i] += reference->rate * state->position[1][i];
    }
    state->velocity[reference->pull_axis][reference->pulled] += reference->drift;
}

static void take_from_state(Reference *reference) {
    const State *state = reference->state;
    for (size_t c = 0; c < cell_count(reference); c++) reference->first[c] = NOBODY;
    for (int i = 0; i < reference->count; i++) {
        Particle *particle = &reference->particles[i];
        *particle = (Particle){.radius = state->diameter[i] / 2, .mass = state->mass[i]};
        for (int a = 0; a < reference->dimension; a++) {
            particle->position[a] = state->position[a][i];
            particle->velocity[a] = state->velocity[a][i];
            const int cell = (int)(particle->position[a] / reference->cell_edge[a]);
            particle->cell.at[a] = cell < reference->cells[a] ? cell : reference->cells[a] - 1;
        }
        enter_cell(reference, i);
    }
}

// Back into [0, edge) along an axis; how many boxes it went.
static int32_t fold(const Reference *reference, Particle *particle, int axis) {
    const double edge = reference->state->box.edge[axis];
    double boxes = floor(particle->position[axis] / edge);
    double x = particle->position[axis] - boxes * edge;
    if (x >= edge) x = 0, boxes++;
    particle->position[axis] = x;
    return (int32_t)boxes;
}

// Whoever leaves upwards comes back from below where its image is, with the velocity of that.
static void give_to_state(Reference *reference) {
    State *state = reference->state;
    box_shear(&state->box, reference->rate * state->box.edge[1] * reference->interval);
    state->shear_rate = reference->rate;
    for (int i = 0; i < reference->count; i++) {
        Particle *particle = &reference->particles[i];
        const int32_t up = fold(reference, particle, 1);
        particle->position[0] -= up * state->box.offset;
        particle->velocity[0] -= up * reference->rate * state->box.edge[1];
        state->image[1][i] += up;
        state->image[0][i] += fold(reference, particle, 0) - (int32_t)(up * state->box.turns);
        if (reference->dimension == 3) state->image[2][i] += fold(reference, particle, 2);
        for (int a = 0; a < reference->dimension; a++) {
            state->position[a][i] = particle->position[a];
            state->velocity[a][i] = particle->velocity[a];
        }
    }
}

static void advance_one(Reference *reference) {
    if (reference->thermostatted) draw_velocities(reference);
    take_from_state(reference);
    for (int i = 0; i < reference->count; i++) {
        predict(reference, i, i); // each pair once; whatever is stale is looked at in full
        put(reference, i, i);
    }
    for (int place = reference->count / 2; place-- > 0;) sift_down(reference, place);
    while (reference->particles[reference->heap[0]].time < reference->interval) {
        next_event(reference);
    }
    for (int i = 0; i < reference->count; i++) {
        move_to(reference, &reference->particles[i], reference->interval);
    }
    give_to_state(reference);
    reference->state->step++;
    reference->tally.windows++;
}

void reference_advance(Reference *reference, int64_t intervals, Tally *tally) {
    reference->tally = (Tally){0};
    for (int64_t k = 0; k < intervals; k++) advance_one(reference);
    tally_add(tally, &reference->tally);
}

void reference_shear(Reference *reference, double rate) {
    reference->rate = rate;
}

void reference_pull(Reference *reference, size_t particle, int axis, double drift) {
    reference->pulled = particle;
    reference->pull_axis = axis;
    reference->drift = drift;
}

void reference_record(Reference *reference, ReferenceLog *log) {
    reference->log = log;
}

// ---- Making

// Cells no narrower than the largest particle, and no more of them than there are particles.
static void choose_cells(Reference *reference) {
    const State *state = reference->state;
    double largest = 0;
    for (int i = 0; i < reference->count; i++) largest = fmax(largest, state->diameter[i]);
    const double room = box_volume(&state->box) / reference->count;
    const double width = fmax(largest, reference->dimension == 2 ? sqrt(room) : cbrt(room));
    for (int a = 0; a < 3; a++) reference->cells[a] = 1, reference->cell_edge[a] = 1;
    for (int a = 0; a < reference->dimension; a++) {
        reference->cells[a] = (int)fmin(state->box.edge[a] / width, 1 << 20);
        if (reference->cells[a] < CELLS_LEAST) reference->all_pairs = true;
    }
    for (int a = 0; a < reference->dimension; a++) {
        if (reference->all_pairs) reference->cells[a] = 1;
        reference->cell_edge[a] = state->box.edge[a] / reference->cells[a];
    }
}

static Status allocate(Reference *reference) {
    const size_t count = (size_t)reference->count;
    TRY(NEW_ARRAY(reference->particles, count));
    TRY(NEW_ARRAY(reference->first, cell_count(reference)));
    TRY(NEW_ARRAY(reference->heap, count));
    TRY(NEW_ARRAY(reference->place, count));
    TRY(NEW_ARRAY(reference->ids, count));
    for (int a = 0; a < 3; a++) TRY(NEW_ARRAY(reference->normals[a], count));
    for (size_t i = 0; i < count; i++) reference->ids[i] = (uint32_t)i;
    return OK;
}

Status reference_create(Reference **out, State *state, RngKey key, double interval,
                        bool thermostatted, bool all_pairs) {
    Reference *reference = NULL;
    TRY(NEW(reference));
    *reference = (Reference){.state = state,
                             .key = key,
                             .interval = interval,
                             .thermostatted = thermostatted,
                             .all_pairs = all_pairs,
                             .dimension = state->box.dimension,
                             .count = (int)state->count};
    choose_cells(reference);
    const Status status = allocate(reference);
    if (status != OK) {
        reference_free(reference);
        return status;
    }
    *out = reference;
    return OK;
}

void reference_free(Reference *reference) {
    if (!reference) return;
    memory_free(reference->particles);
    memory_free(reference->first);
    memory_free(reference->heap);
    memory_free(reference->place);
    memory_free(reference->ids);
    for (int a = 0; a < 3; a++) memory_free(reference->normals[a]);
    memory_free(reference);
}
