// SPDX-License-Identifier: GPL-3.0-or-later
// Plateaus of scattering functions and how they are passed. Near its glass transition a function is
// F_q(t) = f_q + h_q G(t) with one G for all wave numbers, so that
//   X_q(t) = (F_q(t) - F_q(t'))/(F_q(t') - F_q(t''))     (Weysser, thesis, eq. 3.27)
//   Y_q(t) = (F_q(t) - f_q)/(F_q(t') - F_q(t''))
// do not depend on q; X needs no plateau, Y shows G with its zero on the plateau. The plateau is
// passed where the mean over wave numbers of F_q(t/sqrt(10)) - F_q(t sqrt(10)), the fall in a
// decade, has its deepest minimum between two maxima, at one time for all wave numbers; without a
// second maximum, in a glass, at the end. t' and t'' are half a decade to both sides. The window in
// which the functions factorise reaches as far as the X_q differ by no more than a tenth of 1 +
// |X|: `factorisation_spread` tells by how much they do, at all times. The errors are the
// jackknife's over replicas, with the same times for all.
#include "analysis/decay.h"
#include "analysis/derive.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double HALF_DECADE = 3.1622776601683795;
static const double DEEP_ENOUGH = 0.9;  // of the lower of the two maxima
static const double HIGH_ENOUGH = 0.05; // of the higher one, for the lower: noise is no maximum
static const double STILL_THERE = 0.1;  // of the function, 1 at t = 0: later is no plateau
static const double FLAT_ENOUGH = 0.25; // of the first maximum: the end of a glass
static const double ALIKE = 0.1;        // the most that X_q differ by, over 1 + |X|
static const double CERTAIN = 3;        // standard errors of F_q(t') - F_q(t'')
enum { LAGS_LEAST = 12, WAVES_LEAST = 2 };

typedef enum Border { FIRST, PLATEAU, LAST, BORDERS } Border;

// A function of wave number and time: of one species and direction, or one pair of species.
typedef struct Sheet {
    const Results *results;
    const ResultSeries *series;
    size_t waves, lags, first; // element
    const double *times;
    size_t plateau, before, after; // lags of f, t', t''; plateau = lags: there is none
    double window[BORDERS];        // times
    double *mean;                  // [waves][lags], of all replicas or of those without one
    double *number;                // all of Parts, one after the other
    size_t offset[8];              // of each in `number`
} Sheet;

typedef enum Part { X, Y, SPREAD, FALL, HEIGHT, WINDOW, PARTS } Part;

static size_t part_size(const Sheet *sheet, Part part) {
    const size_t all = sheet->waves * sheet->lags;
    const size_t sizes[PARTS] = {[X] = all,
                                 [Y] = all,
                                 [SPREAD] = sheet->lags,
                                 [FALL] = sheet->lags,
                                 [HEIGHT] = sheet->waves,
                                 [WINDOW] = BORDERS};
    return sizes[part];
}

static double *part_of(const Sheet *sheet, Part part) {
    return sheet->number + sheet->offset[part];
}

static const double *wave_of(const Sheet *sheet, size_t wave) {
    return sheet->mean + wave * sheet->lags;
}

static void fall_in_a_decade(Sheet *sheet) {
    double *fall = part_of(sheet, FALL);
    for (size_t k = 0; k < sheet->lags; k++) {
        double sum = 0;
        for (size_t q = 0; q < sheet->waves; q++) {
            const double *f = wave_of(sheet, q), t = sheet->times[k];
            sum += decay_value_at(sheet->times, f, sheet->lags, t / HALF_DECADE) -
                   decay_value_at(sheet->times, f, sheet->lags, t * HALF_DECADE);
        }
        fall[k] = sum / (double)sheet->waves;
    }
}

static double most_of(const double *values, size_t from, size_t to) {
    double most = -INFINITY;
    for (size_t k = from; k < to; k++) most = fmax(most, values[k]); // NaN is passed over
    return most;
}

static double mean_over_waves(const Sheet *sheet, size_t lag) {
    double sum = 0;
    for (size_t q = 0; q < sheet->waves; q++) sum += wave_of(sheet, q)[lag];
    return sum / (double)sheet->waves;
}

static bool is_still_there(const Sheet *sheet, size_t lag) {
    return mean_over_waves(sheet, lag) > STILL_THERE;
}

static size_t deepest_minimum(const Sheet *sheet) {
    const double *fall = part_of(sheet, FALL);
    double deepest = DEEP_ENOUGH;
    size_t found = sheet->lags;
    for (size_t k = 1; k + 1 < sheet->lags; k++) {
        if (!(fall[k] <= fall[k - 1] && fall[k] <= fall[k + 1]) || !is_still_there(sheet, k))
            continue;
        const double earlier = most_of(fall, 0, k), later = most_of(fall, k + 1, sheet->lags);
        const double lower = fmin(earlier, later);
        if (lower < HIGH_ENOUGH * fmax(earlier, later)) continue;
        if (!(fall[k] < deepest * lower)) continue;
        deepest = fall[k] / lower;
        found = k;
    }
    return found;
}

static size_t end_of_a_glass(const Sheet *sheet) {
    const double *fall = part_of(sheet, FALL);
    size_t end = sheet->lags;
    while (end > 0 && !isfinite(fall[end - 1])) end--;
    if (end < 2 || !is_still_there(sheet, end - 1)) return sheet->lags;
    const bool flat = fall[end - 1] < FLAT_ENOUGH * most_of(fall, 0, end);
    return flat ? end - 1 : sheet->lags;
}

static size_t lag_near(const Sheet *sheet, double time) {
    size_t nearest = 0;
    for (size_t k = 1; k < sheet->lags; k++) {
        if (fabs(log(sheet->times[k] / time)) < fabs(log(sheet->times[nearest] / time)))
            nearest = k;
    }
    return nearest;
}

static void choose_plateau(Sheet *sheet) {
    sheet->plateau = deepest_minimum(sheet);
    if (sheet->plateau == sheet->lags) sheet->plateau = end_of_a_glass(sheet);
    if (sheet->plateau == sheet->lags) return;
    const double time = sheet->times[sheet->plateau];
    sheet->before = lag_near(sheet, time / HALF_DECADE);
    sheet->after = lag_near(sheet, time * HALF_DECADE);
}

// Of a wave number that all replicas together see falling; else NaN.
static double fall_of(const Sheet *sheet, size_t wave) {
    const double *f = wave_of(sheet, wave), fall = f[sheet->before] - f[sheet->after];
    double squares = 0;
    const size_t n = sheet->results->replicas, at = sheet->first + wave * sheet->lags;
    for (size_t r = 0; r < n; r++) {
        const double *values = sheet->series->values + r * sheet->series->size + at;
        const double off = values[sheet->before] - values[sheet->after] - fall;
        squares += off * off;
    }
    const double error = n > 1 ? sqrt(squares / (double)(n * (n - 1))) : 0;
    return fall > CERTAIN * error ? fall : (double)NAN;
}

static void factorise(Sheet *sheet) {
    for (size_t q = 0; q < sheet->waves; q++) {
        const double *f = wave_of(sheet, q);
        const bool there = sheet->plateau < sheet->lags;
        const double fall = there ? fall_of(sheet, q) : (double)NAN;
        const double height = there ? f[sheet->plateau] : (double)NAN;
        part_of(sheet, HEIGHT)[q] = height;
        for (size_t k = 0; k < sheet->lags; k++) {
            part_of(sheet, X)[q * sheet->lags + k] = (f[k] - f[sheet->before]) / fall;
            part_of(sheet, Y)[q * sheet->lags + k] = (f[k] - height) / fall;
        }
    }
}

// Mean over wave numbers, and root of the mean square about it, of X at a time.
static void moments_of(const Sheet *sheet, size_t lag, double *mean, double *spread) {
    const double *x = part_of(sheet, X) + lag;
    double sum = 0, squares = 0, n = 0;
    for (size_t q = 0; q < sheet->waves; q++) {
        if (!isfinite(x[q * sheet->lags])) continue;
        sum += x[q * sheet->lags];
        n++;
    }
    *mean = sum / n;
    for (size_t q = 0; q < sheet->waves; q++) {
        const double off = x[q * sheet->lags] - *mean;
        if (isfinite(off)) squares += off * off;
    }
    *spread = n < WAVES_LEAST ? (double)NAN : sqrt(squares / n);
}

static void spread_of_x(Sheet *sheet) {
    double mean;
    for (size_t k = 0; k < sheet->lags; k++)
        moments_of(sheet, k, &mean, &part_of(sheet, SPREAD)[k]);
}

static bool are_alike(const Sheet *sheet, size_t lag) {
    double mean, spread;
    moments_of(sheet, lag, &mean, &spread);
    return spread <= ALIKE * (1 + fabs(mean));
}

static void choose_window(Sheet *sheet) {
    for (size_t b = 0; b < BORDERS; b++) sheet->window[b] = NAN;
    if (sheet->plateau == sheet->lags) return;
    size_t first = sheet->plateau, last = sheet->plateau;
    sheet->window[PLATEAU] = sheet->times[sheet->plateau];
    if (!are_alike(sheet, sheet->plateau)) return;
    while (first > 0 && are_alike(sheet, first - 1)) first--;
    while (last + 1 < sheet->lags && are_alike(sheet, last + 1)) last++;
    sheet->window[FIRST] = sheet->times[first];
    sheet->window[LAST] = sheet->times[last];
}

static void mean_without(Sheet *sheet, int64_t without) {
    decay_mean(sheet->results, sheet->series, sheet->first, sheet->waves * sheet->lags, without,
               sheet->mean);
}

static void numbers_of(Sheet *sheet) {
    fall_in_a_decade(sheet);
    if (sheet->plateau > sheet->lags) choose_plateau(sheet); // of all replicas, once
    factorise(sheet);
    spread_of_x(sheet);
    memcpy(part_of(sheet, WINDOW), sheet->window, sizeof sheet->window);
}

// values[replica]: `count` pseudo-values each, of `all` and what is left without the replica.
static void derive_sheet(Sheet *sheet, double *all, size_t count, double *values, size_t stride) {
    sheet->plateau = SIZE_MAX;
    sheet->number = all;
    mean_without(sheet, DECAY_NOBODY);
    numbers_of(sheet);
    choose_window(sheet);
    memcpy(part_of(sheet, WINDOW), sheet->window, sizeof sheet->window);
    sheet->number = all + count;
    for (size_t r = 0; r < sheet->results->replicas; r++) {
        mean_without(sheet, (int64_t)r);
        if (sheet->results->replicas > 1) numbers_of(sheet);
        memcpy(values + r * stride, sheet->number, count * sizeof *values);
    }
    for (size_t i = 0; i < count; i++)
        pseudo_values(sheet->results->replicas, all[i], values + i, stride);
}

// Of one part, the axes: what it has of wave number and time behind those of the sheets.
static void shape_part(ResultSeries *shape, const ResultSeries *of, Part part) {
    static const char *const borders[BORDERS] = {"first", "plateau", "last"};
    static const char *const names[PARTS] = {
        [X] = "_factorisation_X", [Y] = "_factorisation_Y", [SPREAD] = "_factorisation_spread",
        [FALL] = "_fall",         [HEIGHT] = "_plateau",    [WINDOW] = "_factorisation_window"};
    *shape = derive_shape(of, names[part]);
    const ResultAxis time = of->axis[of->axes - 1];
    snprintf(shape->unit, sizeof shape->unit, "%s", part == WINDOW ? time.unit : "");
    if (part == X || part == Y) return;
    shape->axes--;
    if (part == HEIGHT) return;
    shape->axis[shape->axes - 1] = time;
    if (part == WINDOW)
        shape->axis[shape->axes - 1] =
            (ResultAxis){.name = "border", .unit = "", .count = BORDERS, .labels = borders};
}

static bool has_numbers(const double *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (isfinite(values[i])) return true;
    }
    return false;
}

// values[replica][sheet][number] of all parts, to the series of one of them.
static Status put_part(Results *results, const ResultSeries *of, const Sheet *sheet, Part part,
                       const double *values, size_t sheets, size_t count) {
    ResultSeries shape;
    double *some = NULL;
    const size_t size = part_size(sheet, part);
    shape_part(&shape, of, part);
    TRY(NEW_ARRAY(some, sheets * size));
    Status status = OK;
    for (size_t r = 0; r < results->replicas && status == OK; r++) {
        for (size_t s = 0; s < sheets; s++) {
            memcpy(some + s * size, values + (r * sheets + s) * count + sheet->offset[part],
                   size * sizeof *some);
        }
        if (has_numbers(some, sheets * size)) status = results_put_series(results, &shape, r, some);
    }
    memory_free(some);
    return status;
}

static Status derive_sheets(Results *results, Sheet *sheet, double *numbers, double *values,
                            size_t count) {
    const ResultSeries shape = *sheet->series; // results may move it when they grow
    const size_t size = sheet->waves * sheet->lags, sheets = shape.size / size;
    for (size_t s = 0; s < sheets; s++) {
        sheet->first = s * size;
        derive_sheet(sheet, numbers, count, values + s * count, sheets * count);
    }
    for (Part part = 0; part < PARTS; part++)
        TRY(put_part(results, &shape, sheet, part, values, sheets, count));
    return OK;
}

// The last two axes are wave number and time.
Status derive_factorisation(Results *results, const ResultSeries *series) {
    if (series->axes < 2) return OK;
    const ResultAxis *wave = &series->axis[series->axes - 2], *time = wave + 1;
    if (strcmp(wave->name, "wave_number") != 0 || strcmp(time->name, "time") != 0) return OK;
    if (wave->count < WAVES_LEAST || time->count < LAGS_LEAST) return OK;
    Sheet sheet = {.results = results,
                   .series = series,
                   .waves = wave->count,
                   .lags = time->count,
                   .times = time->values};
    size_t count = 0;
    for (Part part = 0; part < PARTS; part++) {
        sheet.offset[part] = count;
        count += part_size(&sheet, part);
    }
    double *numbers = NULL, *values = NULL;
    const size_t sheets = series->size / (sheet.waves * sheet.lags);
    Status status = NEW_ARRAY(sheet.mean, sheet.waves * sheet.lags);
    if (status == OK) status = NEW_ARRAY(numbers, 2 * count);
    if (status == OK) status = NEW_ARRAY(values, results->replicas * sheets * count);
    if (status == OK) status = derive_sheets(results, &sheet, numbers, values, count);
    memory_free(numbers);
    memory_free(values);
    memory_free(sheet.mean);
    return status;
}
