// SPDX-License-Identifier: GPL-3.0-or-later
// Who may touch whom. Each particle has an anchor, where it was when its list was made; two are in
// each other's lists if their anchors are nearer than the range of their interaction + skin. While
// every particle stays within half the skin of its anchor, no pair in range is missed. Only the
// particle that goes farther gets a new anchor and a new list, and enters or leaves those of
// others.
#include "dmc/balls.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static const double SKIN_LEAST = 0.3, SKIN_MOST = 1.6; // in diameters
static const double SKIN_STEPS = 2.5;                  // between these, in longest steps
static const double WIDER = 1.00001; // rounding of distances and of single precision

static double contact_of(const Balls *balls, uint32_t i, uint32_t j) {
    return (balls->radius[i] + balls->radius[j]) * balls->reach;
}

// Normal displacements are unbounded: the few longer than 3.7 standard deviations go without lists.
static void choose_skin(Balls *balls) {
    const double longest = balls->settings.gaussian ? 3.7 / sqrt(3) * balls->longest
                                                    : sqrt(balls->dimension) * balls->longest;
    const double wanted = SKIN_LEAST * balls->largest + SKIN_STEPS * longest;
    balls->skin = fmin(wanted, SKIN_MOST * balls->largest);
    balls->stride = fmin(longest * WIDER, balls->skin / 2);
    const double leash = balls->skin / 2 / WIDER;
    balls->leash2 = (float)(leash * leash);
}

// Coarse distances of anchors are in the scaled steps of balls.c, and off by less than four.
static void choose_far(Balls *balls) {
    double longest = 0;
    for (int a = 0; a < balls->dimension; a++) {
        longest = fmax(longest, balls->state->box.edge[a]);
    }
    const double range =
        (balls->largest * balls->reach + balls->skin) / longest * COARSE_PER_EDGE + 4;
    const double felt =
        (balls->largest * balls->reach + balls->stride) / longest * COARSE_PER_EDGE + 4;
    balls->far = (uint32_t)fmin(range * range, 0x1p30 * 1.9);
    balls->unfelt = (uint32_t)fmin(felt * felt, 0x1p30 * 1.9);
}

static Status make_cells(Balls *balls, size_t cells) {
    memory_free(balls->seat);
    memory_free(balls->seated);
    balls->seat = balls->seated = NULL;
    balls->cells_most = 0;
    if (balls->seats == 0) balls->seats = NEIGHBOURS_AT_A_TIME;
    TRY(NEW_ARRAY(balls->seated, cells));
    TRY(NEW_ARRAY(balls->seat, cells * balls->seats));
    balls->cells_most = cells;
    return OK;
}

// Twice as many seats in every cell.
static Status more_seats(Balls *balls) {
    uint32_t *seat = NULL;
    TRY(NEW_ARRAY(seat, balls->cells_most * 2 * balls->seats));
    for (size_t c = 0; c < balls->cells_most; c++) {
        memcpy(seat + c * 2 * balls->seats, balls->seat + c * balls->seats,
               balls->seats * sizeof *seat);
    }
    memory_free(balls->seat);
    balls->seat = seat;
    balls->seats *= 2;
    return OK;
}

static Status choose_cells(Balls *balls) {
    const double width = (balls->largest * balls->reach + balls->skin) * WIDER;
    double cells = 1, wider = 1;
    do {
        cells = 1;
        for (int a = 0; a < 3; a++) {
            const double edge = a < balls->dimension ? balls->state->box.edge[a] : 0;
            const double fit = floor(edge / (width * wider));
            balls->cells[a] = fit < 3 ? 1 : (int64_t)fmin(fit, 1 << 20);
            cells *= (double)balls->cells[a];
        }
        wider *= 1.25;
    } while (cells > 4 * (double)balls->count + 64);
    if ((size_t)cells > balls->cells_most) TRY(make_cells(balls, (size_t)cells));
    memset(balls->seated, 0, (size_t)cells * sizeof *balls->seated);
    return OK;
}

static int64_t cell_index(const Balls *balls, const int64_t at[3]) {
    return (at[2] * balls->cells[1] + at[1]) * balls->cells[0] + at[0];
}

static void cell_at(const Balls *balls, const uint32_t place[3], int64_t at[3]) {
    for (int a = 0; a < 3; a++) at[a] = (int64_t)((place[a] * (uint64_t)balls->cells[a]) >> 32);
}

static Status cell_enter(Balls *balls, uint32_t i) {
    Ball *ball = &balls->ball[i];
    int64_t at[3];
    memcpy(ball->anchor, ball->place, sizeof ball->anchor);
    balls->coarse_anchor[i] = balls_coarse(ball->anchor);
    cell_at(balls, ball->anchor, at);
    ball->cell = (uint32_t)cell_index(balls, at);
    ball->seat = balls->seated[ball->cell]++;
    if (ball->seat == balls->seats) TRY(more_seats(balls));
    balls->seat[ball->cell * balls->seats + ball->seat] = i;
    return OK;
}

// The last takes the seat that is free now.
static void cell_leave(Balls *balls, uint32_t i) {
    const Ball *ball = &balls->ball[i];
    uint32_t *seat = balls->seat + ball->cell * balls->seats;
    const uint32_t last = seat[--balls->seated[ball->cell]];
    seat[ball->seat] = last;
    balls->ball[last].seat = ball->seat;
}

// The cells round `place`, each once; returns how many.
static int cells_round(const Balls *balls, const uint32_t place[3], int64_t cells[27]) {
    int64_t home[3], reach[3], at[3];
    int count = 0;
    cell_at(balls, place, home);
    for (int a = 0; a < 3; a++) reach[a] = balls->cells[a] > 1;
    for (int64_t z = -reach[2]; z <= reach[2]; z++) {
        at[2] = (home[2] + z + balls->cells[2]) % balls->cells[2];
        for (int64_t y = -reach[1]; y <= reach[1]; y++) {
            at[1] = (home[1] + y + balls->cells[1]) % balls->cells[1];
            for (int64_t x = -reach[0]; x <= reach[0]; x++) {
                at[0] = (home[0] + x + balls->cells[0]) % balls->cells[0];
                cells[count++] = cell_index(balls, at);
            }
        }
    }
    return count;
}

// The rule of who is in whose list; the same from both.
static bool belong(const Balls *balls, uint32_t i, const uint32_t anchor[4], uint32_t j) {
    const double range = contact_of(balls, i, j) + balls->skin;
    return balls_distance2(balls, anchor, balls->ball[j].anchor) < range * range;
}

// Those who belong in the list of i, into `found`.
static size_t search(const Balls *balls, uint32_t i) {
    int64_t cells[27];
    const int number = cells_round(balls, balls->ball[i].anchor, cells);
    size_t near = 0, count = 0;
    for (int c = 0; c < number; c++) {
        near += balls->kernel->near(balls, i, balls->seat + (size_t)cells[c] * balls->seats,
                                    balls->seated[cells[c]], balls->found + near);
    }
    for (size_t n = 0; n < near; n++) {
        const uint32_t j = balls->found[n];
        balls->found[count] = j;
        count += j != i && belong(balls, i, balls->ball[i].anchor, j);
    }
    return count;
}

static uint32_t *list_of(const Balls *balls, uint32_t i) {
    return balls->list + i * balls->room;
}

// Fills the rest of the last block with a neighbour: seen twice, it overlaps as before.
static void fill_up(Balls *balls, uint32_t i) {
    uint32_t *list = list_of(balls, i);
    for (size_t n = balls->ball[i].neighbours; n % NEIGHBOURS_AT_A_TIME; n++) list[n] = list[0];
}

// Longer lists for all.
static Status make_room(Balls *balls, size_t wanted) {
    if (wanted <= balls->room) return OK;
    const size_t room =
        (wanted + NEIGHBOURS_AT_A_TIME - 1) / NEIGHBOURS_AT_A_TIME * NEIGHBOURS_AT_A_TIME;
    uint32_t *list = NULL;
    TRY(NEW_ARRAY(list, balls->count * room));
    for (uint32_t i = 0; balls->list && i < balls->count; i++) {
        memcpy(list + i * room, list_of(balls, i), balls->room * sizeof *list);
    }
    memory_free(balls->list);
    balls->list = list;
    balls->room = room;
    return OK;
}

static Status enter_list(Balls *balls, uint32_t of, uint32_t i) {
    Ball *ball = &balls->ball[of];
    TRY(make_room(balls, ball->neighbours + 1));
    list_of(balls, of)[ball->neighbours++] = i;
    fill_up(balls, of);
    return OK;
}

static void leave_list(Balls *balls, uint32_t of, uint32_t i) {
    uint32_t *list = list_of(balls, of), n = 0;
    while (list[n] != i) n++;
    list[n] = list[--balls->ball[of].neighbours];
    fill_up(balls, of);
}

static Status take_found(Balls *balls, uint32_t i, size_t count) {
    TRY(make_room(balls, count));
    memcpy(list_of(balls, i), balls->found, count * sizeof *balls->found);
    balls->ball[i].neighbours = (uint32_t)count;
    fill_up(balls, i);
    return OK;
}

bool balls_refresh(Balls *balls, uint32_t i) {
    Ball *ball = &balls->ball[i];
    uint32_t before[4];
    memcpy(before, ball->anchor, sizeof before);
    for (uint32_t n = 0; n < ball->neighbours; n++) {
        const uint32_t j = list_of(balls, i)[n];
        if (!belong(balls, i, ball->place, j)) leave_list(balls, j, i);
    }
    cell_leave(balls, i);
    if (cell_enter(balls, i) != OK) return false;
    balls->rebuilds++;
    const size_t count = search(balls, i);
    if (take_found(balls, i, count) != OK) return false;
    for (size_t n = 0; n < count; n++) {
        const uint32_t j = balls->found[n];
        if (!belong(balls, i, before, j) && enter_list(balls, j, i) != OK) return false;
    }
    return true;
}

Status balls_list(Balls *balls) {
    choose_skin(balls);
    choose_far(balls);
    TRY(choose_cells(balls));
    for (uint32_t i = 0; i < balls->count; i++) TRY(cell_enter(balls, i));
    TRY(make_room(balls, NEIGHBOURS_AT_A_TIME));
    for (uint32_t i = 0; i < balls->count; i++) TRY(take_found(balls, i, search(balls, i)));
    balls->rebuilds += balls->count;
    balls->listed = true;
    return OK;
}

bool balls_overlap_anywhere(const Balls *balls, uint32_t i, const uint32_t place[3]) {
    int64_t cells[27];
    const int number = cells_round(balls, place, cells);
    for (int c = 0; c < number; c++) {
        const uint32_t *seat = balls->seat + (size_t)cells[c] * balls->seats;
        for (uint32_t n = 0; n < balls->seated[cells[c]]; n++) {
            if (seat[n] != i && balls_overlap(balls, i, place, seat[n])) return true;
        }
    }
    return false;
}

int64_t balls_energy_anywhere(const Balls *balls, uint32_t i, const uint32_t place[3]) {
    int64_t cells[27], sum = 0;
    const int number = cells_round(balls, place, cells);
    for (int c = 0; c < number; c++) {
        const uint32_t *seat = balls->seat + (size_t)cells[c] * balls->seats;
        for (uint32_t n = 0; n < balls->seated[cells[c]]; n++) {
            if (seat[n] != i) sum += balls_energy(balls, i, place, seat[n]);
        }
    }
    return sum;
}
