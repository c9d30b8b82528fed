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

static const double SKIN_LEAST = 0.35, SKIN_MOST = 1.6; // in diameters
static const double SKIN_FAR = 2.5;                     // in longest steps
static const double PI = 3.14159265358979323846;
static const double WIDER = 1.00001; // rounding of distances and of single precision

static double contact_of(const Balls *balls, uint32_t i, uint32_t j) {
    return (balls->radius[i] + balls->radius[j]) * balls->reach;
}

// The skin with which a list fills what the hot loop looks at together, but for some room to spare;
// longer for long steps.
static void choose_skin(Balls *balls) {
    const Box *box = &balls->state->box;
    const double filled = balls->soft ? 27 : 14, density = (double)balls->count / box_volume(box);
    const double range = balls->dimension == 2 ? sqrt(filled / (density * PI))
                                               : cbrt(filled / (density * PI * 4 / 3));
    const double longest = sqrt(balls->settings.gaussian ? 3 : balls->dimension) * balls->longest;
    const double wanted = fmax(range - balls->largest * balls->reach, SKIN_FAR * longest);
    balls->skin = fmin(fmax(wanted, SKIN_LEAST * balls->largest), SKIN_MOST * balls->largest);
    const double leash = balls->skin / 2 / WIDER;
    balls->leash2 = leash * leash;
}

// Coarse distances in the scaled steps of balls.c are off by less than four.
static void choose_far(Balls *balls) {
    const double longest = box_longest_edge(&balls->state->box);
    const double per_edge = balls->unscaled ? 0x1p16 : COARSE_PER_EDGE;
    const double range =
        (balls->largest * balls->reach + balls->skin) / longest * COARSE_PER_EDGE + 4;
    const double leash = fmax(sqrt(balls->leash2) / longest * per_edge - 4, 0);
    balls->far = (uint32_t)fmin(range * range, 0x1p30 * 1.9);
    balls->leashed = (uint32_t)(leash * leash);
}

static Status make_cells(Balls *balls, size_t cells) {
    memory_free(balls->seat);
    memory_free(balls->seat_row);
    memory_free(balls->seated);
    balls->seat = balls->seated = NULL;
    balls->seat_row = NULL;
    balls->cells_most = 0;
    if (balls->seats == 0) balls->seats = NEIGHBOURS_AT_A_TIME;
    TRY(NEW_ARRAY(balls->seated, cells));
    TRY(NEW_ARRAY(balls->seat, cells * balls->seats));
    TRY(NEW_ARRAY(balls->seat_row, cells * balls->seats));
    balls->cells_most = cells;
    return OK;
}

// Twice as many seats in every cell.
static Status more_seats(Balls *balls) {
    const size_t seats = balls->seats;
    uint32_t *seat = NULL;
    uint64_t *row = NULL;
    TRY(NEW_ARRAY(seat, balls->cells_most * 2 * seats));
    if (NEW_ARRAY(row, balls->cells_most * 2 * seats) != OK) {
        memory_free(seat);
        return NO_MEMORY;
    }
    for (size_t c = 0; c < balls->cells_most; c++) {
        memcpy(seat + c * 2 * seats, balls->seat + c * seats, seats * sizeof *seat);
        memcpy(row + c * 2 * seats, balls->seat_row + c * seats, seats * sizeof *row);
    }
    memory_free(balls->seat);
    memory_free(balls->seat_row);
    balls->seat = seat;
    balls->seat_row = row;
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

static uint64_t *anchor_of(const Balls *balls, uint32_t i) {
    return balls->coarse + balls->count + i;
}

static Status cell_enter(Balls *balls, uint32_t i) {
    Ball *ball = &balls->ball[i];
    int64_t at[3];
    balls_fractions(ball->place, ball->anchor);
    *anchor_of(balls, i) = balls_coarse(ball->anchor) | (uint64_t)ball->place[3] << 32;
    cell_at(balls, ball->anchor, at);
    ball->cell = (uint32_t)cell_index(balls, at);
    ball->seat = balls->seated[ball->cell]++;
    if (ball->seat == balls->seats) TRY(more_seats(balls));
    balls->seat[ball->cell * balls->seats + ball->seat] = i;
    balls->seat_row[ball->cell * balls->seats + ball->seat] = *anchor_of(balls, i);
    return OK;
}

// The last takes the seat that is free now.
static void cell_leave(Balls *balls, uint32_t i) {
    const Ball *ball = &balls->ball[i];
    uint32_t *seat = balls->seat + ball->cell * balls->seats;
    const uint32_t last = seat[--balls->seated[ball->cell]];
    seat[ball->seat] = last;
    balls->seat_row[ball->cell * balls->seats + ball->seat] = *anchor_of(balls, last);
    balls->ball[last].seat = ball->seat;
}

// The cells round that at `home` along an axis, each once; returns how many.
static int round_home(int64_t home, int64_t cells, int64_t at[3]) {
    at[0] = home;
    if (cells == 1) return 1;
    at[1] = home == 0 ? cells - 1 : home - 1;
    at[2] = home == cells - 1 ? 0 : home + 1;
    return 3;
}

// The cells round `place`, each once; returns how many.
static int cells_round(const Balls *balls, const uint32_t place[3], int64_t cells[27]) {
    int64_t home[3], at[3][3];
    int number[3], count = 0;
    cell_at(balls, place, home);
    for (int a = 0; a < 3; a++) number[a] = round_home(home[a], balls->cells[a], at[a]);
    for (int z = 0; z < number[2]; z++) {
        for (int y = 0; y < number[1]; y++) {
            const int64_t row = (at[2][z] * balls->cells[1] + at[1][y]) * balls->cells[0];
            for (int x = 0; x < number[0]; x++) cells[count++] = row + at[0][x];
        }
    }
    return count;
}

// Who is in whose list; the same from both. Balls of the same size are by the coarse distance of
// their anchors, which never leaves out who belongs: it alone judges eight at a time.
static bool belong(const Balls *balls, uint32_t i, const uint32_t anchor[3], uint32_t j) {
    const double range = contact_of(balls, i, j) + balls->skin;
    return balls_distance2(balls, anchor, balls->ball[j].anchor) < range * range;
}

// Those who belong in the list of i, into `found`.
static size_t search(const Balls *balls, uint32_t i) {
    int64_t cells[27];
    const int number = cells_round(balls, balls->ball[i].anchor, cells);
    size_t near = 0, count = 0;
    for (int c = 0; c < number; c++) {
        const size_t first = (size_t)cells[c] * balls->seats;
        near +=
            balls->kernel->near(balls, *anchor_of(balls, i), balls->seat_row + first,
                                balls->seat + first, balls->seated[cells[c]], balls->found + near);
    }
    for (size_t n = 0; n < near; n++) {
        const uint32_t j = balls->found[n];
        balls->found[count] = j;
        count += j != i && (balls->one_size || belong(balls, i, balls->ball[i].anchor, j));
    }
    return count;
}

// Of `ids` those who do not belong in the list of i if its anchor is there, into `others`.
static size_t outside(const Balls *balls, uint32_t i, const uint32_t anchor[3], const uint32_t *ids,
                      size_t count, uint32_t *others) {
    size_t number = 0;
    if (balls->one_size) {
        return balls->kernel->beyond(balls, balls_coarse(anchor), ids, count, others);
    }
    for (size_t n = 0; n < count; n++) {
        others[number] = ids[n];
        number += !belong(balls, i, anchor, ids[n]);
    }
    return number;
}

// The first entry is no neighbour.
static uint32_t *list_of(const Balls *balls, uint32_t i) {
    return balls->list + i * balls->room;
}

// Where a list has no more entries: among hard ones another particle, which does no harm if it is
// no neighbour; among soft ones the own anchor, as energies of ones far away are slow.
static uint32_t filler(const Balls *balls, uint32_t i) {
    return balls->soft ? (uint32_t)balls->count + i : i == 0 && balls->count > 1;
}

// Longer lists for all.
static Status make_room(Balls *balls, size_t wanted) {
    if (wanted <= balls->room) return OK;
    const size_t room =
        (wanted + NEIGHBOURS_PER_ROOM - 1) / NEIGHBOURS_PER_ROOM * NEIGHBOURS_PER_ROOM;
    uint32_t *list = NULL;
    TRY(NEW_ARRAY(list, balls->count * room));
    for (uint32_t i = 0; i < balls->count; i++) {
        for (size_t n = 0; n < room; n++) list[i * room + n] = filler(balls, i);
        if (balls->list) {
            memcpy(list + i * room, list_of(balls, i), balls->room * sizeof *list);
        }
    }
    memory_free(balls->list);
    balls->list = list;
    balls->room = room;
    return OK;
}

static Status enter_list(Balls *balls, uint32_t of, uint32_t i) {
    const size_t entries = balls->ball[of].entries;
    TRY(make_room(balls, entries + 1));
    list_of(balls, of)[entries] = i;
    balls->ball[of].entries++;
    return OK;
}

static void leave_list(Balls *balls, uint32_t of, uint32_t i) {
    uint32_t *list = list_of(balls, of), n = 1, last = --balls->ball[of].entries;
    while (list[n] != i) n++;
    list[n] = list[last];
    if (balls->soft) list[last] = filler(balls, of);
}

static Status take_found(Balls *balls, uint32_t i, size_t count) {
    TRY(make_room(balls, count + 1));
    uint32_t *list = list_of(balls, i);
    const uint32_t before = balls->ball[i].entries;
    list[0] = (uint32_t)balls->count + i;
    memcpy(list + 1, balls->found, count * sizeof *balls->found);
    for (size_t n = count + 1; balls->soft && n < before; n++) list[n] = filler(balls, i);
    balls->ball[i].entries = (uint32_t)count + 1;
    return OK;
}

bool balls_refresh(Balls *balls, uint32_t i) {
    const Ball *ball = &balls->ball[i];
    uint32_t before[3], place[3];
    memcpy(before, ball->anchor, sizeof before);
    balls_fractions(ball->place, place);
    const size_t left =
        outside(balls, i, place, list_of(balls, i) + 1, ball->entries - 1, balls->found);
    for (size_t n = 0; n < left; n++) leave_list(balls, balls->found[n], i);
    cell_leave(balls, i);
    if (cell_enter(balls, i) != OK) return false;
    balls->rebuilds++;
    const size_t count = search(balls, i);
    if (take_found(balls, i, count) != OK) return false;
    const size_t entered = outside(balls, i, before, balls->found, count, balls->entered);
    for (size_t n = 0; n < entered; n++) {
        if (enter_list(balls, balls->entered[n], i) != OK) return false;
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
