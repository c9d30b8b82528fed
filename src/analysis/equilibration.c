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

// A mean, of functions that are 1 at t = 0, that is still above 1/e at the last lag.
static bool one_has_not_relaxed(const Results *results, const ResultSeries *decay) {
    const size_t lags = decay->axis[decay->axes - 1].count;
    for (size_t row = 0; row < decay->size / lags; row++) {
        if (results_series_estimate(results, decay, (row + 1) * lags - 1).value > 1 / exp(1))
            return true;
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
        TRY(results_put_scalar(results, judged->stage, "relaxation_share", "", NULL, r,
                               replica / judged->length));
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

// Of an element of a series that stands first of its times, which are the last axis.
static double mean_over_times(const Results *results, const ResultSeries *series, size_t first) {
    double sum = 0, n = 0;
    for (size_t k = 0; k < series->axis[series->axes - 1].count; k++) {
        const double value = results_series_estimate(results, series, first + k).value;
        if (!isfinite(value)) continue;
        sum += value;
        n++;
    }
    return sum / n;
}

// A number to know, not to judge: some want a crystal.
static Status put_health(const Judged *judged, const char *what, const char *about, double value) {
    char name[RESULT_NAME];
    snprintf(name, sizeof name, "%s_of_%.30s", what, judged->stage);
    return results_put_health(judged->results, name, about, NAN, value);
}

static Status judge_order(Judged *judged) {
    const ResultSeries *order = results_find_series(judged->results, judged->stage, "bond_order");
    if (!order) return OK;
    const size_t global_row = order->size - order->axis[order->axes - 1].count; // the last
    const double global = mean_over_times(judged->results, order, global_row);
    if (!isfinite(global)) return OK;
    say_next(judged);
    text_add(&judged->sentence, "bond order of all together is %.2g of 1: %s", global,
             global > ORDER_MOST ? "it crystallises" : "no crystal");
    return put_health(judged, "bond_order",
                      "Bond-orientational order of all particles together: of order 1/sqrt(N) in a "
                      "fluid or glass, of order 1 in a crystal.",
                      global);
}

// Its mean over times and replicas, at what wave number, and how far it has risen.
static Status judge_structure(Judged *judged) {
    Results *results = judged->results;
    const ResultSeries *peak = results_find_series(results, judged->stage, "structure_peak");
    const ResultScalar *wave =
        results_find_scalar(results, judged->stage, "structure_peak_wave_number");
    if (!peak || !wave) return OK;
    const double height = mean_over_times(results, peak, 0);
    say_next(judged);
    text_add(&judged->sentence, "S(q) peaks at %.3g, q = %.3g d^-1", height,
             results_scalar_estimate(results, wave).value);
    const ResultScalar *drift = results_find_scalar(results, judged->stage, "structure_peak_drift");
    if (!drift) return OK;
    const double rise = results_scalar_estimate(results, drift).value / height;
    text_add(&judged->sentence, ", and %s by %.2g %%", rise < 0 ? "falls" : "rises",
             100 * fabs(rise));
    return put_health(judged, "structure_peak_rise",
                      "Peak of the total S(q), second half of the stage less first, over its "
                      "height: well above 0, particles order.",
                      rise);
}

static Status judge(Judged *judged) {
    char name[RESULT_NAME];
    TRY(judge_relaxation(judged));
    judge_drifts(judged);
    TRY(judge_order(judged));
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
