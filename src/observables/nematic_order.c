// SPDX-License-Identifier: GPL-3.0-or-later
// The nematic order parameter S and the director, from Q = <(3 u u - 1)/2> of the body axes u of
// each configuration. The largest eigenvalue of Q never vanishes: N axes that point anywhere give
// 0.803/sqrt(N). Of those without that bias there are two: -2 times the middle eigenvalue (Eppenga
// & Frenkel, Mol. Phys. 52, 1303, 1984), which vanishes in the isotropic phase but is biased in the
// nematic, and the mean of P2(u_i.u_j) over pairs of different particles, which is S^2 in both.
#include "base/memory.h"
#include "observables/begin.h"
#include "observables/looks.h"
#include "observables/oriented.h"
#include "observables/put.h"

#include <math.h>
#include <stdio.h>

typedef struct OrderSettings {
    int64_t looks, blocks;
} OrderSettings;

static const Option rows[] = {
    LOOKS_OPTION(OrderSettings, looks, 1000),
    {.name = "blocks",
     .type = OPTION_INTEGER,
     .offset = offsetof(OrderSettings, blocks),
     .fallback = 50,
     .least = 1,
     .most = 10000,
     .unit = "",
     .about = "Blocks of the stage for which the order is given, to see it settle: at most this "
              "many."},
};

enum { LARGEST, MIDDLE, ESTIMATORS };

// Of one species, or of all axes together.
typedef struct OrderSums {
    double tensor[3][3]; // of u u over looks and particles
    double pairs;        // mean P2 over pairs, over looks
} OrderSums;

typedef struct NematicOrder {
    Observer observer;
    Oriented oriented;
    size_t labels; // species, and all of them if there are several
    int64_t looks_per_block;
    size_t blocks;
    int64_t looks;
    OrderSums sums[SPECIES_MOST + 1];
    double *blockwise; // [labels][ESTIMATORS][blocks], over looks
} NematicOrder;

static int64_t rounded_up(int64_t numerator, int64_t denominator) {
    return (numerator + denominator - 1) / denominator;
}

static int64_t period_for(const OrderSettings *settings, const Clock *clock) {
    return looks_period(clock, settings->looks);
}

static int64_t looks_per_block(const OrderSettings *settings, const Clock *clock) {
    return rounded_up(looks_count(clock, period_for(settings, clock)), settings->blocks);
}

static size_t blocks_for(const OrderSettings *settings, const Clock *clock) {
    return (size_t)rounded_up(looks_count(clock, period_for(settings, clock)),
                              looks_per_block(settings, clock));
}

static size_t blockwise_size(size_t labels, size_t blocks) {
    return labels * ESTIMATORS * blocks;
}

static Status check(const Settings *settings, const System *system, const Clock *clock) {
    (void)settings;
    (void)clock;
    return oriented_check("nematic_order", system);
}

static void discard(Observer *observer) {
    memory_free(((NematicOrder *)observer)->blockwise);
    memory_free(observer);
}

static Status create(Observer **out, const Settings *settings_, const State *state,
                     const Clock *clock) {
    const OrderSettings *settings = (const OrderSettings *)settings_->bytes;
    NematicOrder *self = NULL;
    TRY(NEW(self));
    self->observer = (Observer){.kind = &observable_nematic_order, .clock = *clock};
    self->oriented = oriented_of(&state->system);
    self->labels = self->oriented.count + (self->oriented.count > 1);
    self->observer.period = period_for(settings, clock);
    self->looks_per_block = looks_per_block(settings, clock);
    self->blocks = blocks_for(settings, clock);
    return observer_begin(out, &self->observer,
                          NEW_ARRAY(self->blockwise, blockwise_size(self->labels, self->blocks)));
}

// Mean of P2(u_i.u_j) over the pairs i != j: the sum of (u_i.u_j)^2 over all i, j is the sum of the
// squares of the elements of sum u u, and i = j adds 1 each.
static double mean_over_pairs(double sum[3][3], double particles) {
    double squares = 0;
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) squares += sum[a][b] * sum[a][b];
    }
    const double all = (3 * squares - particles * particles) / 2;
    return (all - particles) / (particles * (particles - 1));
}

static void add_look(NematicOrder *self, size_t label, size_t block, double sum[3][3],
                     double particles) {
    const Order order = oriented_order((const double(*)[3])sum, particles);
    double *blockwise = self->blockwise + label * ESTIMATORS * self->blocks + block;
    blockwise[LARGEST * self->blocks] += order.largest;
    blockwise[MIDDLE * self->blocks] += -2 * order.middle;
    OrderSums *sums = &self->sums[label];
    sums->pairs += mean_over_pairs(sum, particles);
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) sums->tensor[a][b] += sum[a][b];
    }
}

static Status see(Observer *observer, int64_t tick, const State *state, const Tally *tally) {
    (void)tally;
    NematicOrder *self = (NematicOrder *)observer;
    const Oriented *oriented = &self->oriented;
    const size_t block = (size_t)((tick / self->observer.period - 1) / self->looks_per_block);
    double all[3][3] = {{0}};
    for (size_t s = 0; s < oriented->count; s++) {
        double sum[3][3] = {{0}};
        oriented_add(sum, state, oriented->begin[s], oriented->end[s]);
        oriented_add(all, state, oriented->begin[s], oriented->end[s]);
        add_look(self, s, block, sum, (double)(oriented->end[s] - oriented->begin[s]));
    }
    if (oriented->count > 1) {
        add_look(self, oriented->count, block, all, (double)oriented_particles(oriented));
    }
    self->looks++;
    return OK;
}

static const uint64_t ORDER_TAG = 0x4f52444552303031; // "ORDER001"

static void archive(Observer *observer, Archive *archive) {
    NematicOrder *self = (NematicOrder *)observer;
    archive_tag(archive, ORDER_TAG);
    archive_i64(archive, &self->looks, 1);
    for (size_t l = 0; l < self->labels; l++) {
        archive_f64(archive, &self->sums[l].tensor[0][0], 9);
        archive_f64(archive, &self->sums[l].pairs, 1);
    }
    archive_f64(archive, self->blockwise, blockwise_size(self->labels, self->blocks));
}

// Looks in a block: fewer in the last one, none beyond what has been seen.
static int64_t looks_in(const NematicOrder *self, size_t block) {
    const int64_t begin = (int64_t)block * self->looks_per_block;
    const int64_t rest = self->looks - begin;
    return rest < 0 ? 0 : rest < self->looks_per_block ? rest : self->looks_per_block;
}

static double mean_over_looks(const NematicOrder *self, size_t label, size_t estimator) {
    double sum = 0;
    for (size_t b = 0; b < self->blocks; b++) {
        sum += self->blockwise[(label * ESTIMATORS + estimator) * self->blocks + b];
    }
    return sum / (double)self->looks;
}

static Status put_one(const NematicOrder *self, const Labels *labels, size_t label,
                      const char *quantity, Results *results, size_t replica, double value) {
    char name[RESULT_NAME];
    const bool alone = label + 1 == labels->count; // the only one, or all of them
    snprintf(name, sizeof name, "%s%s%s", quantity, alone ? "" : "_",
             alone ? "" : labels->names[label]);
    return observer_put_scalar(&self->observer, name, "", NULL, results, replica, value);
}

static Status put_scalars(const NematicOrder *self, const Labels *labels, Results *results,
                          size_t replica) {
    for (size_t l = 0; l < self->labels; l++) {
        TRY(put_one(self, labels, l, "nematic_order", results, replica,
                    mean_over_looks(self, l, LARGEST)));
        TRY(put_one(self, labels, l, "nematic_order_middle", results, replica,
                    mean_over_looks(self, l, MIDDLE)));
        TRY(put_one(self, labels, l, "squared_nematic_order", results, replica,
                    self->sums[l].pairs / (double)self->looks));
    }
    return OK;
}

static Status put_blocks(const NematicOrder *self, const Labels *labels, double *values,
                         double *times, Results *results, size_t replica) {
    static const char *const estimators[ESTIMATORS] = {"largest", "middle"};
    const Clock *clock = &self->observer.clock;
    for (size_t b = 0; b < self->blocks; b++) {
        const double first = (double)((int64_t)b * self->looks_per_block + 1);
        const double last = (double)((int64_t)b * self->looks_per_block + looks_in(self, b));
        times[b] = (first + last) / 2 * (double)self->observer.period * clock->tick;
    }
    for (size_t i = 0; i < blockwise_size(self->labels, self->blocks); i++) {
        values[i] = self->blockwise[i] / (double)looks_in(self, i % self->blocks);
    }
    const ResultSeries shape = {
        .unit = "",
        .axes = 3,
        .axis = {{.name = "species", .unit = "", .count = labels->count, .labels = labels->names},
                 {.name = "estimator", .unit = "", .count = ESTIMATORS, .labels = estimators},
                 {.name = "time", .unit = clock->unit, .count = self->blocks, .values = times}}};
    return observer_put_series(&self->observer, "nematic_order", &shape, results, replica, values);
}

// Of the tensor averaged over the stage. A director has no sign: the greatest component is made
// positive.
static void find_director(const NematicOrder *self, size_t label, double director[3]) {
    const OrderSums *sums = &self->sums[label];
    double particles = 0;
    for (int a = 0; a < 3; a++) particles += sums->tensor[a][a]; // u.u = 1
    const Order order = oriented_order(sums->tensor, particles);
    int greatest = 0;
    for (int a = 1; a < 3; a++) {
        if (fabs(order.director[a]) > fabs(order.director[greatest])) greatest = a;
    }
    const double sign = order.director[greatest] < 0 ? -1 : 1;
    for (int a = 0; a < 3; a++) director[a] = sign * order.director[a];
}

static Status put_director(const NematicOrder *self, const Labels *labels, Results *results,
                           size_t replica) {
    static const char *const directions[3] = {"x", "y", "z"};
    double directors[SPECIES_MOST + 1][3];
    for (size_t l = 0; l < self->labels; l++) find_director(self, l, directors[l]);
    const ResultSeries shape = {
        .unit = "",
        .axes = 2,
        .axis = {{.name = "species", .unit = "", .count = labels->count, .labels = labels->names},
                 {.name = "direction", .unit = "", .count = 3, .labels = directions}}};
    return observer_put_series(&self->observer, "director", &shape, results, replica,
                               &directors[0][0]);
}

static Status write(const Observer *observer, const State *state, Results *results,
                    size_t replica) {
    const NematicOrder *self = (const NematicOrder *)observer;
    Labels labels;
    oriented_labels(&labels, &state->system);
    double *values = NULL, *times = NULL;
    Status status = put_scalars(self, &labels, results, replica);
    if (status == OK) status = put_director(self, &labels, results, replica);
    if (status == OK) status = NEW_ARRAY(values, blockwise_size(self->labels, self->blocks));
    if (status == OK) status = NEW_ARRAY(times, self->blocks);
    if (status == OK) status = put_blocks(self, &labels, values, times, results, replica);
    memory_free(values);
    memory_free(times);
    return status;
}

static size_t memory(const Settings *settings, const System *system, const Clock *clock) {
    const size_t blocks = blocks_for((const OrderSettings *)settings->bytes, clock);
    return sizeof(NematicOrder) +
           blockwise_size(system->species_count + 1, blocks) * sizeof(double);
}

const ObservableKind observable_nematic_order = {
    .name = "nematic_order",
    .about = "Nematic order parameter and director of particles with a body axis, and how they "
             "settle.",
    .options = {rows, sizeof rows / sizeof *rows, sizeof(OrderSettings)},
    .check = check,
    .create = create,
    .next = looks_next,
    .see = see,
    .archive = archive,
    .write = write,
    .free = discard,
    .memory = memory,
};
