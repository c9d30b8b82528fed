// SPDX-License-Identifier: GPL-3.0-or-later
// Drives: their keys, and how the rate of a flow goes with time. Rates enter the trajectory, so
// they are computed without the C library's functions.
#include "propagator/drive.h"

#include "base/constants.h"
#include "numerics/turn.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

const char *const drive_pull_axes[] = {"x", "y", "z", NULL};
const char *const drive_pull_clocks[PULL_CLOCKS + 1] = {"drifted", "exact-force", "first-order",
                                                        NULL};

static const Option rows[] = {
    {.name = "shear_rate",
     .type = OPTION_REAL,
     .offset = offsetof(Drive, flow.rate),
     .least = -1e6,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "Steady shear: the rate of the flow v_x = shear_rate y, which is the bare Peclet "
              "number; 0: at rest."},
    {.name = "oscillate.amplitude",
     .type = OPTION_REAL,
     .offset = offsetof(Drive, flow.oscillation.amplitude),
     .least = 0,
     .most = 1000,
     .unit = "",
     .about = "Oscillatory shear: the largest strain; the strain is amplitude sin(frequency t)."},
    {.name = "oscillate.frequency",
     .type = OPTION_REAL,
     .offset = offsetof(Drive, flow.oscillation.frequency),
     .least = 0,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "Angular frequency of oscillatory shear."},
    {.name = "shear_table.times",
     .type = OPTION_REALS,
     .offset = offsetof(Drive, flow.table.times),
     .least = 0,
     .most = 1e12,
     .unit = "d^2/D0",
     .about = "Shear whose rate changes with time: times since the stage began, ascending."},
    {.name = "shear_table.rates",
     .type = OPTION_REALS,
     .offset = offsetof(Drive, flow.table.rates),
     .least = -1e6,
     .most = 1e6,
     .unit = "D0/d^2",
     .about = "The shear rate at these times: straight lines between them, constant before the "
              "first and after the last."},
    {.name = "shear_table.file",
     .type = OPTION_TEXT,
     .offset = offsetof(Drive, flow.table.file),
     .unit = "",
     .about =
         "Both from a text file instead, seen from the run file's folder: a line with a time, a "
         "comma and a rate for each; lines that begin with # are comments. The plan keeps the "
         "numbers."},
    {.name = "pull.species",
     .type = OPTION_TEXT,
     .offset = offsetof(Drive, pull.species),
     .unit = "",
     .about = "Active microrheology: the species whose only particle, the tracer, is pulled by a "
              "constant force."},
    {.name = "pull.peclet",
     .type = OPTION_REAL,
     .offset = offsetof(Drive, pull.peclet),
     .least = 0,
     .most = 1e5,
     .unit = "",
     .about = "The force, as F a/kT with the tracer's radius a; 0: the tracer diffuses."},
    {.name = "pull.axis",
     .type = OPTION_CHOICE,
     .offset = offsetof(Drive, pull.axis),
     .unit = "",
     .about = "The direction of the force.",
     .choices = drive_pull_axes},
    {.name = "pull.clock",
     .type = OPTION_CHOICE,
     .offset = offsetof(Drive, pull.clock),
     .unit = "",
     .about = "Of Monte Carlo, trials of the tracer and what they are worth in time: drifted ones, "
              "exact however "
              "long; uniform ones with the exact mean of a free particle; the same to first order "
              "in the force, as published.",
     .choices = drive_pull_clocks},
    {.name = "pull.period",
     .type = OPTION_REAL,
     .offset = offsetof(Drive, pull.period),
     .least = 0,
     .most = 1e9,
     .unit = "d^2/D0",
     .about =
         "Time from one trajectory of the tracer to the next, which begins somewhere else: in "
         "place of a particle like it, or where there is room; 0: the stage is one trajectory."},
    {.name = "pull.rest",
     .type = OPTION_REAL,
     .offset = offsetof(Drive, pull.rest),
     .least = 0,
     .most = 1e9,
     .unit = "d^2/D0",
     .about = "The last part of each period, without the force, in which the bath forgets."},
};

const OptionTable drive_options = {rows, sizeof rows / sizeof *rows, sizeof(Drive)};

static bool oscillates(const Flow *flow) {
    return flow->oscillation.amplitude > 0 || flow->oscillation.frequency > 0;
}

static bool has_table(const Flow *flow) {
    return flow->table.times.count > 0 || flow->table.rates.count > 0;
}

bool drive_oscillates(const Drive *drive) {
    return drive && oscillates(&drive->flow);
}

unsigned drive_kinds(const Drive *drive) {
    const Flow *flow = &drive->flow;
    const bool flows = flow->rate != 0 || oscillates(flow) || has_table(flow);
    return (flows ? DRIVE_FLOW : 0) | (drive->pull.species[0] ? DRIVE_PULL : 0);
}

enum { SHOWN_MOST = 6, REALS_WORDS_SIZE = 20 * SHOWN_MOST };

// "[0, 0.5, 1]"; of a long list its beginning and its end: "[0, 1, 2, 3, ..., 20]".
static const char *reals_words(char words[REALS_WORDS_SIZE], const OptionReals *reals) {
    const bool all = reals->count <= SHOWN_MOST;
    const int64_t begin = all ? reals->count : SHOWN_MOST - 2;
    int length = snprintf(words, REALS_WORDS_SIZE, "[");
    for (int64_t k = 0; k < begin; k++)
        length += snprintf(words + length, (size_t)(REALS_WORDS_SIZE - length), "%s%g",
                           k ? ", " : "", reals->values[k]);
    if (!all)
        length += snprintf(words + length, (size_t)(REALS_WORDS_SIZE - length), ", ..., %g",
                           reals->values[reals->count - 1]);
    snprintf(words + length, (size_t)(REALS_WORDS_SIZE - length), "]");
    return words;
}

const char *flow_words(char words[FLOW_WORDS_SIZE], const Flow *flow) {
    if (oscillates(flow))
        snprintf(words, FLOW_WORDS_SIZE, "oscillate = {amplitude: %g, frequency: %g}",
                 flow->oscillation.amplitude, flow->oscillation.frequency);
    else if (has_table(flow))
        snprintf(words, FLOW_WORDS_SIZE, "shear_table = {times: %s, rates: %s}",
                 reals_words((char[REALS_WORDS_SIZE]){0}, &flow->table.times),
                 reals_words((char[REALS_WORDS_SIZE]){0}, &flow->table.rates));
    else
        snprintf(words, FLOW_WORDS_SIZE, "shear_rate = %g", flow->rate);
    return words;
}

const char *drive_words(char words[DRIVE_WORDS_SIZE], const Drive *drive) {
    const unsigned kinds = drive_kinds(drive);
    const Pull *pull = &drive->pull;
    words[0] = '\0';
    if (kinds & DRIVE_FLOW) return flow_words(words, &drive->flow);
    if (kinds & DRIVE_PULL)
        snprintf(words, DRIVE_WORDS_SIZE, "pull = {species: %s, peclet: %g, axis: %s, clock: %s}",
                 pull->species, pull->peclet, drive_pull_axes[pull->axis],
                 drive_pull_clocks[pull->clock]);
    return words;
}

static Status check_table(const OptionReals *times, const OptionReals *rates) {
    if (times->count != rates->count)
        return status_fail(BAD_DATA, "shear_table = {...}: %d times and %d rates; give one of each",
                           (int)times->count, (int)rates->count);
    for (int64_t k = 1; k < times->count; k++) {
        if (times->values[k] > times->values[k - 1]) continue;
        return status_fail(BAD_DATA, "shear_table = {...}: times must ascend, but %g follows %g",
                           times->values[k], times->values[k - 1]);
    }
    return OK;
}

static Status check_pull(const Pull *pull) {
    if (pull->species[0] == '\0') {
        if (pull->peclet == 0) return OK;
        return status_fail(BAD_DATA,
                           "pull = {peclet: %g}: give the species of the tracer as well, as in "
                           "pull: {species: tracer, peclet: %g}",
                           pull->peclet, pull->peclet);
    }
    if (pull->rest == 0 || pull->rest < pull->period) return OK;
    return status_fail(
        BAD_DATA,
        "pull = {rest: %g}: a rest is the last part of a period; give a longer period "
        "than it",
        pull->rest);
}

Status drive_check(const Drive *drive) {
    const Flow *flow = &drive->flow;
    TRY(check_pull(&drive->pull));
    if (drive_kinds(drive) == (DRIVE_FLOW | DRIVE_PULL))
        return status_fail(BAD_DATA,
                           "pull = {species: %s}: the stage is sheared as well, and no method does "
                           "both; make them two stages",
                           drive->pull.species);
    if ((flow->rate != 0) + oscillates(flow) + has_table(flow) > 1)
        return status_fail(BAD_DATA, "%s: a stage has one of shear_rate, oscillate and shear_table",
                           flow_words((char[FLOW_WORDS_SIZE]){0}, flow));
    if ((flow->oscillation.amplitude > 0) != (flow->oscillation.frequency > 0))
        return status_fail(BAD_DATA, "%s: both must be above 0",
                           flow_words((char[FLOW_WORDS_SIZE]){0}, flow));
    return check_table(&flow->table.times, &flow->table.rates);
}

void drive_pull_ticks(const Pull *pull, double tick, int64_t per_step, int64_t *period,
                      int64_t *on) {
    *period = *on = INT64_MAX;
    if (!(pull->period > 0)) return;
    const double step = tick * (double)per_step;
    const double steps = rint(pull->period / step), rest = rint(pull->rest / step);
    if (steps * (double)per_step >= 0x1p62) return;
    *period = (steps < 1 ? 1 : (int64_t)steps) * per_step;
    *on = *period - (rest < steps ? (int64_t)rest : 0) * per_step;
}

double drive_pull_force(const Pull *pull, double diameter) {
    return pull->peclet / (diameter / 2);
}

// sin(angle), or its cosine.
static double sine(double angle, bool cosine) {
    const Lanes fraction = angle / (2 * PI) - (Lanes){0};
    Lanes c, s;
    turn_cosine_sine(&fraction, &c, &s);
    return cosine ? c[0] : s[0];
}

// The mean over a span of time is that of a difference of sines, without taking one.
static double oscillation_rate(const Flow *flow, double from, double to) {
    const double w = flow->oscillation.frequency, half = (to - from) / 2;
    return flow->oscillation.amplitude * sine(w * ((from + to) / 2), true) * sine(w * half, false) /
           half;
}

// Strain of a table from its first time on, or backwards to before it.
static double table_strain(const OptionReals *times, const OptionReals *rates, double time) {
    const double *t = times->values, *rate = rates->values;
    if (time <= t[0]) return rate[0] * (time - t[0]);
    double strain = 0;
    for (int64_t k = 1; k < times->count; k++) {
        const double span = t[k] - t[k - 1], slope = (rate[k] - rate[k - 1]) / span;
        const double part = time < t[k] ? time - t[k - 1] : span;
        strain += part * (rate[k - 1] + slope * part / 2);
        if (time < t[k]) return strain;
    }
    return strain + rate[times->count - 1] * (time - t[times->count - 1]);
}

double flow_rate(const Flow *flow, double from, double to) {
    if (oscillates(flow)) return oscillation_rate(flow, from, to);
    if (!has_table(flow)) return flow->rate;
    const OptionReals *times = &flow->table.times, *rates = &flow->table.rates;
    return (table_strain(times, rates, to) - table_strain(times, rates, from)) / (to - from);
}

static double magnitude(double x) {
    return x < 0 ? -x : x;
}

double flow_fastest(const Flow *flow) {
    double fastest = oscillates(flow) ? flow->oscillation.amplitude * flow->oscillation.frequency
                                      : magnitude(flow->rate);
    for (int64_t k = 0; k < flow->table.rates.count; k++) {
        const double rate = magnitude(flow->table.rates.values[k]);
        if (rate > fastest) fastest = rate;
    }
    return fastest;
}

double flow_strain(const Flow *flow, double time) {
    if (oscillates(flow))
        return flow->oscillation.amplitude * sine(flow->oscillation.frequency * time, false);
    if (!has_table(flow)) return flow->rate * time;
    const OptionReals *times = &flow->table.times, *rates = &flow->table.rates;
    return table_strain(times, rates, time) - table_strain(times, rates, 0);
}
