// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a stage was in equilibrium, from what was measured in it: how many of its longest
// relaxation times it lasted, whether its halves agree, whether it crystallised. Numbers as
// scalars, and a sentence per stage as a fact. It judges at rest only; what it cannot tell for want
// of an observable it says.
#include "analysis/analysis.h"
#include "base/memory.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double TIMES_ENOUGH = 10; // relaxation times that a stage should last
static const double ERRORS_MOST = 3;   // of a drift
static const double ORDER_MOST = 0.3;  // of all particles together: 1/sqrt(N) in a fluid or glass

typedef struct Judged {
    Results *results;
    const char *stage;
    double length; // in the stage's unit of time
    Text sentence;
    bool told; // anything
} Judged;

static void say_next(Judged *judged) {
    if (judged->told) text_put(&judged->sentence, "; ");
    judged->told = true;
}

// Element with the longest mean; size of the series if there is none.
static size_t longest(const Results *results, const ResultSeries *times) {
    size_t found = times->size;
    double most = 0;
    for (size_t e = 0; e < times->size; e++) {
        const double time = results_series_estimate(results, times, e).value;
        if (!(time > most)) continue;
        most = time;
        found = e;
    }
    return found;
}

// A mean that is still above 1/e of its first value at the last lag.
static bool one_has_not_relaxed(const Results *results, const ResultSeries *decay) {
    const size_t lags = decay->axis[decay->axes - 1].count;
    for (size_t row = 0; row < decay->size / lags; row++) {
        const double first = results_series_estimate(results, decay, row * lags).value,
                     last = results_series_estimate(results, decay, (row + 1) * lags - 1).value;
        if (last > first / exp(1)) return true;
    }
    return false;
}

static Status judge_times(Judged *judged, const ResultSeries *times) {
    Results *results = judged->results;
    const size_t element = longest(results, times);
    if (element == times->size) return OK;
    const double time = results_series_estimate(results, times, element).value;
    const double lasts = judged->length / time;
    say_next(judged);
    text_add(&judged->sentence, "it lasts %.3g times its longest relaxation time, %.4g %s%s", lasts,
             time, times->unit, lasts < TIMES_ENOUGH ? ", not the ten it should" : "");
    for (size_t r = 0; r < results->replicas; r++) {
        const double replica = times->values[r * times->size + element];
        TRY(results_put_scalar(results, judged->stage, "relaxation_share", "",
                               "Longest relaxation time over the length of the stage: below 0.1 it "
                               "has forgotten where it began.",
                               r, replica / judged->length));
    }
    return OK;
}

static Status judge_relaxation(Judged *judged) {
    static const char *const decays[] = {"self_scattering_centred", "self_scattering",
                                         "collective_scattering_centred",
                                         "collective_scattering_normalised"};
    for (size_t i = 0; i < sizeof decays / sizeof *decays; i++) {
        char name[RESULT_NAME];
        snprintf(name, sizeof name, "%s_relaxation_time", decays[i]);
        const Results *results = judged->results;
        const ResultSeries *decay = results_find_series(results, judged->stage, decays[i]);
        const ResultSeries *times = results_find_series(results, judged->stage, name);
        if (!decay || !times) continue;
        if (!one_has_not_relaxed(results, decay)) return judge_times(judged, times);
        say_next(judged);
        text_add(&judged->sentence,
                 "%s has not relaxed within its longest lag: a glass, or lags "
                 "that are too short",
                 decays[i]);
        return OK;
    }
    return OK;
}

static void judge_drifts(Judged *judged) {
    const ResultScalar *worst = NULL;
    double most = 0;
    for (size_t i = 0; i < judged->results->scalar_count; i++) {
        const ResultScalar *scalar = &judged->results->scalars[i];
        const char *end = strstr(scalar->quantity, "_drift");
        if (strcmp(scalar->stage, judged->stage) != 0 || !end || end[strlen("_drift")]) continue;
        const Estimate drift = results_scalar_estimate(judged->results, scalar);
        if (!(fabs(drift.value) / drift.error >= most)) continue;
        most = fabs(drift.value) / drift.error;
        worst = scalar;
    }
    if (!worst) return;
    say_next(judged);
    text_add(&judged->sentence, "its halves %s: %s is %.2g standard errors",
             most > ERRORS_MOST ? "differ" : "agree", worst->quantity, most);
}

// Mean over the times.
static double mean_order(const Results *results, const ResultSeries *order) {
    const size_t times = order->axis[order->axes - 1].count, global = order->size - times;
    double sum = 0, n = 0;
    for (size_t k = 0; k < times; k++) {
        const double value = results_series_estimate(results, order, global + k).value;
        if (!isfinite(value)) continue;
        sum += value;
        n++;
    }
    return sum / n;
}

static void judge_order(Judged *judged) {
    const ResultSeries *order = results_find_series(judged->results, judged->stage, "bond_order");
    if (!order) return;
    const double global = mean_order(judged->results, order); // the last of its rows
    if (!isfinite(global)) return;
    say_next(judged);
    text_add(&judged->sentence, "bond order of all together is %.2g of 1: %s", global,
             global > ORDER_MOST ? "it crystallises" : "no crystal");
}

// Of the last of the pairs, which is the total.
static Status judge_structure(Judged *judged) {
    Results *results = judged->results;
    const ResultSeries *s = results_find_series(results, judged->stage, "structure_factor");
    if (!s || s->axes < 1 || !s->axis[s->axes - 1].values) return OK;
    const ResultAxis wave = s->axis[s->axes - 1];
    const size_t total = s->size - wave.count, size = s->size;
    size_t peak = 0;
    for (size_t q = 1; q < wave.count; q++) {
        const double here = results_series_estimate(results, s, total + q).value;
        if (here > results_series_estimate(results, s, total + peak).value) peak = q;
    }
    say_next(judged);
    text_add(&judged->sentence, "S(q) peaks at %.3g, q = %.3g d^-1",
             results_series_estimate(results, s, total + peak).value, wave.values[peak]);
    for (size_t r = 0; r < results->replicas; r++) {
        TRY(results_put_scalar(results, judged->stage, "structure_peak", "",
                               "Height of the peak of the total S(q): it rises if particles order.",
                               r, s->values[r * size + total + peak]));
    }
    return OK;
}

static Status judge(Judged *judged) {
    char name[RESULT_NAME];
    TRY(judge_relaxation(judged));
    judge_drifts(judged);
    judge_order(judged);
    TRY(judge_structure(judged));
    if (!judged->told) return OK;
    TRY(text_status(&judged->sentence));
    snprintf(name, sizeof name, "equilibrium of %.40s", judged->stage);
    return results_put_fact(judged->results, name, text_words(&judged->sentence));
}

Status analysis_judge(Results *results, const Plan *plan) {
    for (size_t s = 0; s < plan->stage_count; s++) {
        const Clock clock = plan_clock(plan, s);
        if (clock.drive) continue; // not meant to be in equilibrium
        Judged judged = {.results = results,
                         .stage = plan->stages[s].name,
                         .length = (double)clock.ticks * clock.tick};
        const Status status = judge(&judged);
        text_free(&judged.sentence);
        TRY(status);
    }
    return OK;
}
