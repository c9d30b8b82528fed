// SPDX-License-Identifier: GPL-3.0-or-later
// Holds what a gallery entry measured against what is expected of it. An expectation is met if
//   |value - expected| <= tolerance + 3 sqrt(error^2 + uncertainty^2):
// `tolerance` is what finite size, finite interval or the reference formula may amount to, said in
// the entry; the errors are statistical. Where only a bound is known, "> 1" or "< 1", it is met if
// the value is beyond it by as much, and coarse if that cannot be told. A value whose error exceeds
// the `precision` that is asked for proves nothing, and is said to be coarse.
#include "gallery.h"

#include "measure.h"

#include "base/memory.h"
#include "base/number.h"
#include "store/store.h"

#include <math.h>
#include <string.h>

static const double STANDARD_ERRORS = 3; // beyond which a deviation counts

typedef struct Measured {
    const char *point, *curve, *measure;
    double x;
    Estimate estimate;
} Measured;

typedef struct Judgement {
    const GalleryRun *run;
    Csv *points, *measures, *expected;
    Measured *measured; // [points->rows * measures->rows], unset where a point lacks one
    size_t count;
} Judgement;

static Status open_table(FILE **out, const GalleryRun *run, const char *name) {
    char path[GALLERY_PATH];
    TRY(gallery_path(path, run->directory, name));
    *out = fopen(path, "w");
    return *out ? OK : status_fail_errno(IO_FAILED, "cannot write %s", path);
}

static Status close_table(FILE *table, const GalleryRun *run, const char *name) {
    const bool failed = ferror(table) != 0;
    if (fclose(table) == 0 && !failed) return OK;
    return status_fail_errno(IO_FAILED, "cannot write %s/%s", run->directory, name);
}

static Status keep_curve(const Judgement *judgement, const Results *results, const char *point,
                         size_t measure) {
    char name[GALLERY_PATH];
    FILE *table = NULL;
    snprintf(name, sizeof name, "%s-%s.csv", point,
             csv_cell(judgement->measures, measure, "measure"));
    TRY(open_table(&table, judgement->run, name));
    const Status status =
        measure_curve(results, csv_cell(judgement->measures, measure, "quantity"), table);
    const Status closed = close_table(table, judgement->run, name);
    return status == OK ? closed : status;
}

// A measure that names a curve, or a point, is taken there only.
static bool wants(const Csv *measures, size_t measure, const Measured *at) {
    const char *only = csv_cell(measures, measure, "curve");
    return *only == '\0' || strcmp(only, at->curve) == 0 || strcmp(only, at->point) == 0;
}

static Status measure_point(Judgement *judgement, const Results *results, size_t row) {
    const Csv *measures = judgement->measures;
    Measured at = {.point = csv_cell(judgement->points, row, "point"),
                   .curve = csv_cell(judgement->points, row, "curve")};
    TRY(csv_number(judgement->points, row, "x", 0, &at.x));
    for (size_t m = 0; m < measures->rows; m++) {
        const char *quantity = csv_cell(measures, m, "quantity");
        if (!wants(measures, m, &at)) continue;
        at.measure = csv_cell(measures, m, "measure");
        if (measure_is_curve(quantity)) {
            TRY(keep_curve(judgement, results, at.point, m));
            continue;
        }
        TRY(measure_number(results, quantity, &at.estimate));
        judgement->measured[judgement->count++] = at;
    }
    return OK;
}

static Status measure_points(Judgement *judgement) {
    TRY(NEW_ARRAY(judgement->measured, judgement->points->rows * judgement->measures->rows));
    for (size_t row = 0; row < judgement->points->rows; row++) {
        char directory[GALLERY_PATH], path[GALLERY_PATH];
        Results *results = NULL;
        TRY(gallery_path(directory, judgement->run->directory,
                         csv_cell(judgement->points, row, "point")));
        TRY(gallery_path(path, directory, "results.h5"));
        TRY(store_read_results(&results, path));
        const Status status = measure_point(judgement, results, row);
        results_free(results);
        TRY(status);
    }
    return OK;
}

static Status write_measured(const Judgement *judgement) {
    FILE *table = NULL;
    TRY(open_table(&table, judgement->run, "measured.csv"));
    fputs("point,curve,x,measure,value,error,replicas\n", table);
    for (size_t i = 0; i < judgement->count; i++) {
        const Measured *at = &judgement->measured[i];
        fprintf(table, "%s,%s,%.10g,%s,%.10g,%.10g,%zu\n", at->point, at->curve, at->x, at->measure,
                at->estimate.value, at->estimate.error, at->estimate.n);
    }
    return close_table(table, judgement->run, "measured.csv");
}

// A straight line through points, by least squares weighted by their errors.
typedef struct Line {
    double weights, x, y, xx, xy;
} Line;

static void line_add(Line *line, double x, double y, double error) {
    const double weight = 1 / (error * error);
    line->weights += weight;
    line->x += weight * x;
    line->y += weight * y;
    line->xx += weight * x * x;
    line->xy += weight * x * y;
}

static double line_determinant(const Line *line) {
    return line->weights * line->xx - line->x * line->x;
}

// Where the line meets x = 0.
static Estimate line_at_origin(const Line *line) {
    const double determinant = line_determinant(line);
    return (Estimate){.value = (line->xx * line->y - line->x * line->xy) / determinant,
                      .error = sqrt(line->xx / determinant)};
}

static Estimate line_slope(const Line *line) {
    const double determinant = line_determinant(line);
    return (Estimate){.value = (line->weights * line->xy - line->x * line->y) / determinant,
                      .error = sqrt(line->weights / determinant)};
}

// What may be asked of a curve as a whole: where a straight line through its points meets x = 0,
// and the exponent of a power law through them, a straight line in logarithms.
static const struct {
    const char *ending;
    bool logarithms;
    Estimate (*of)(const Line *line);
} of_curves[] = {{"@0", false, line_at_origin}, {"@power", true, line_slope}};
enum { OF_CURVES = sizeof of_curves / sizeof *of_curves };

static Status ask_curve(const Judgement *judgement, const char *curve, const char *measure,
                        size_t what, Measured *out) {
    Line line = {0};
    for (size_t i = 0; i < judgement->count; i++) {
        const Measured *at = &judgement->measured[i];
        if (strcmp(at->curve, curve) != 0 || strcmp(at->measure, measure) != 0) continue;
        const double y = at->estimate.value, error = at->estimate.error;
        if (isnan(y)) continue;
        if (of_curves[what].logarithms)
            line_add(&line, log(at->x), log(y), error / y);
        else
            line_add(&line, at->x, y, error);
    }
    if (!(line_determinant(&line) > 0)) {
        return status_fail(BAD_DATA,
                           "%s%s of %s: two points are needed, for a power law of positive values",
                           curve, of_curves[what].ending, measure);
    }
    *out = (Measured){
        .point = curve, .curve = curve, .measure = measure, .estimate = of_curves[what].of(&line)};
    return OK;
}

// The curve that this subject begins with, if it then says what is asked of it.
static const char *curve_asked(const Judgement *judgement, const char *subject, size_t *what) {
    for (size_t row = 0; row < judgement->points->rows; row++) {
        const char *curve = csv_cell(judgement->points, row, "curve");
        const size_t length = strlen(curve);
        if (strncmp(curve, subject, length) != 0) continue;
        for (*what = 0; *what < OF_CURVES; ++*what)
            if (strcmp(subject + length, of_curves[*what].ending) == 0) return curve;
    }
    return NULL;
}

// The value of a point; of a curve as "CURVE@0" or "CURVE@power".
static Status find_measured(const Judgement *judgement, const char *subject, const char *measure,
                            Measured *out) {
    size_t what = 0;
    const char *curve = curve_asked(judgement, subject, &what);
    if (curve) return ask_curve(judgement, curve, measure, what, out);
    for (size_t i = 0; i < judgement->count; i++) {
        *out = judgement->measured[i];
        if (strcmp(out->point, subject) == 0 && strcmp(out->measure, measure) == 0) return OK;
    }
    return status_fail(BAD_DATA, "%s: no point has the measure '%s' of '%s'",
                       judgement->expected->path, measure, subject);
}

typedef struct Expectation {
    const char *subject, *measure;
    int side; // 1 or -1: above or below what is expected; 0: there
    double expected, uncertainty, tolerance, precision;
} Expectation;

static Status read_factor(const Csv *csv, const char *text, const char *end, double *factor) {
    char number[32];
    snprintf(number, sizeof number, "%.*s", (int)(end - text), text);
    if (number_read(number, factor)) return OK;
    return status_fail(BAD_DATA, "%s: '%s' before ' * ' is not a number", csv->path, number);
}

// What is expected may be another subject of the entry, that measures the same in another way, or a
// multiple of it, "10 * SUBJECT": its error is then the uncertainty.
static Status read_expected(const Judgement *judgement, size_t row, Expectation *out) {
    const Csv *csv = judgement->expected;
    const char *expected = csv_cell(csv, row, "expected"), *times;
    double factor = 1;
    Measured other = {.point = ""};
    if (*expected == '>' || *expected == '<') {
        out->side = *expected++ == '>' ? 1 : -1;
        while (*expected == ' ') expected++;
    }
    if (number_read(expected, &out->expected))
        return csv_number(csv, row, "uncertainty", 0, &out->uncertainty);
    if ((times = strstr(expected, " * "))) {
        TRY(read_factor(csv, expected, times, &factor));
        expected = times + strlen(" * ");
    }
    TRY(find_measured(judgement, expected, out->measure, &other));
    out->expected = factor * other.estimate.value;
    out->uncertainty = isnan(other.estimate.error) ? 0 : fabs(factor) * other.estimate.error;
    return OK;
}

static Status read_expectation(const Judgement *judgement, size_t row, Expectation *out) {
    const Csv *csv = judgement->expected;
    *out = (Expectation){.subject = csv_cell(csv, row, "subject"),
                         .measure = csv_cell(csv, row, "measure")};
    TRY(read_expected(judgement, row, out));
    TRY(csv_number(csv, row, "tolerance", 0, &out->tolerance));
    return csv_number(csv, row, "precision", (double)INFINITY, &out->precision);
}

static const char *verdict_of(const Expectation *want, double value, double error) {
    const double far = fabs(value - want->expected);
    const double chance = STANDARD_ERRORS * hypot(error, want->uncertainty);
    if (isnan(far)) return "coarse"; // the run was too short or too noisy to tell it
    if (want->side != 0) {
        const double beyond = want->side * (value - want->expected) + want->tolerance;
        return beyond > chance ? "met" : beyond >= -chance ? "coarse" : "MISSED";
    }
    if (!(far <= want->tolerance + chance)) return "MISSED";
    return error > want->precision ? "coarse" : "met";
}

static Status judge_row(const Judgement *judgement, size_t row, FILE *table, FILE *out,
                        size_t *missed) {
    const Csv *csv = judgement->expected;
    Expectation want;
    Measured at = {.point = ""};
    TRY(read_expectation(judgement, row, &want));
    TRY(find_measured(judgement, want.subject, want.measure, &at));
    const double value = at.estimate.value;
    const double error = isnan(at.estimate.error) ? 0 : at.estimate.error; // a single replica
    const double deviation = (value - want.expected) / hypot(error, want.uncertainty);
    const char *verdict = verdict_of(&want, value, error), *kind = csv_cell(csv, row, "kind");
    *missed += strcmp(verdict, "met") != 0;
    fprintf(table, "%s,%s,%.10g,%s,%.10g,%.10g,%.10g,%.10g,%.10g,%.3g,%s,%s,\"%s\"\n", want.subject,
            at.curve, at.x, want.measure, value, error, want.expected, want.uncertainty,
            want.tolerance, deviation, verdict, kind, csv_cell(csv, row, "source"));
    fprintf(out, "%-20s %-24s %11.6g %8.2g %11.6g %8.2g %9.2g %6.1f  %-7s  %s\n", want.subject,
            want.measure, value, error, want.expected, want.uncertainty, want.tolerance, deviation,
            verdict, kind);
    return OK;
}

static Status judge_rows(const Judgement *judgement, FILE *out, size_t *missed) {
    FILE *table = NULL;
    TRY(open_table(&table, judgement->run, "verdict.csv"));
    fputs("subject,curve,x,measure,value,error,expected,uncertainty,tolerance,deviation,verdict,"
          "kind,source\n",
          table);
    fprintf(out, "%-20s %-24s %11s %8s %11s %8s %9s %6s  %-7s  %s\n", "subject", "measure", "value",
            "error", "expected", "uncert.", "tolerance", "dev/se", "verdict", "kind");
    Status status = OK;
    for (size_t row = 0; row < judgement->expected->rows && status == OK; row++) {
        status = judge_row(judgement, row, table, out, missed);
    }
    const Status closed = close_table(table, judgement->run, "verdict.csv");
    return status == OK ? closed : status;
}

static Status read_table(Csv **out, const GalleryRun *run, const char *name) {
    char path[GALLERY_PATH];
    TRY(gallery_path(path, run->entry, name));
    return csv_read(out, path);
}

static Status judge(Judgement *judgement, FILE *out, size_t *missed) {
    TRY(read_table(&judgement->points, judgement->run, "points.csv"));
    TRY(read_table(&judgement->measures, judgement->run, "measures.csv"));
    TRY(read_table(&judgement->expected, judgement->run, "expected.csv"));
    TRY(measure_points(judgement));
    TRY(write_measured(judgement));
    return judge_rows(judgement, out, missed);
}

Status gallery_judge(const GalleryRun *run, FILE *out, size_t *missed, size_t *count) {
    Judgement judgement = {.run = run};
    *missed = *count = 0;
    const Status status = judge(&judgement, out, missed);
    if (judgement.expected) *count = judgement.expected->rows;
    memory_free(judgement.measured);
    csv_free(judgement.points);
    csv_free(judgement.measures);
    csv_free(judgement.expected);
    return status;
}
