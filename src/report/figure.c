// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses what of a series becomes curves, and writes their numbers and the script that draws them.
#include "report/figure.h"

#include "base/number.h"
#include "report/gnuplot.h"
#include "report/notation.h"
#include "report/show.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define TRANSIENTS                                                                                 \
    "At waiting strain 0 the function from the start of shear as measured; at others what "        \
    "follows "                                                                                     \
    "for it from that after the waiting strain and that at rest (integration through "             \
    "transients), "                                                                                \
    "without a parameter: one curve where the waiting strain is small."

// Becomes: {.observable = "mean_squared_displacement", ...}, ...
static const FigureKind kinds[] = {
#define FIGURE(...) {__VA_ARGS__},
#include "report/figures.def"
#undef FIGURE
};

enum { KINDS = sizeof kinds / sizeof *kinds };

const FigureKind *figure_kind(size_t row) {
    return row < KINDS ? &kinds[row] : NULL;
}

static bool has_axis(const ResultSeries *series, const char *name) {
    for (size_t a = 0; a < series->axes; a++) {
        if (strcmp(series->axis[a].name, name) == 0) return true;
    }
    return false;
}

static const FigureKind *kind_named(const char *observable, const ResultSeries *series) {
    for (size_t i = 0; i < KINDS; i++) {
        if (strcmp(kinds[i].observable, observable) != 0) continue;
        if (!kinds[i].axis || has_axis(series, kinds[i].axis)) return &kinds[i];
    }
    return NULL;
}

// What is made of scattering functions about the centre of mass is drawn like what is made of those
// that they come from.
static const struct {
    const char *centred, *from;
} CENTRED[] = {{"self_scattering_centred_", "self_scattering_"},
               {"non_affine_displacement_centred_", "non_affine_displacement_"},
               {"collective_scattering_centred_", "collective_scattering_normalised_"}};

static bool name_without_centre(char name[2 * RESULT_NAME], const ResultSeries *series) {
    for (size_t i = 0; i < sizeof CENTRED / sizeof *CENTRED; i++) {
        const size_t length = strlen(CENTRED[i].centred);
        if (strncmp(series->observable, CENTRED[i].centred, length) != 0) continue;
        snprintf(name, 2 * RESULT_NAME, "%s%s", CENTRED[i].from, series->observable + length);
        return true;
    }
    return false;
}

const FigureKind *figure_kind_of(const ResultSeries *series) {
    char name[2 * RESULT_NAME];
    return kind_named(name_without_centre(name, series) ? name : series->observable, series);
}

// Along the axis that its kind says, or time if there is one, else along the longest axis of
// numbers; NO_AXIS if there is none.
enum { NO_AXIS = RESULT_AXES };

static size_t axis_to_draw_along(const ResultSeries *series) {
    const FigureKind *kind = figure_kind_of(series);
    const char *wanted = kind && kind->along ? kind->along : "time";
    size_t longest = NO_AXIS;
    for (size_t i = 0; i < series->axes; i++) {
        const ResultAxis *axis = &series->axis[i];
        if (!axis->values || axis->count < 2) continue;
        if (strcmp(axis->name, wanted) == 0) return i;
        if (longest == NO_AXIS || axis->count > series->axis[longest].count) longest = i;
    }
    return longest;
}

static bool is(const char *name, const ResultSeries *series) {
    return name && strcmp(name, series->observable) == 0;
}

static bool stands_behind_another(const ResultSeries *series) {
    for (size_t i = 0; i < KINDS; i++) {
        if (is(kinds[i].line, series)) return true;
        for (size_t k = 0; k < FIGURE_LIMITS; k++) {
            if (is(kinds[i].limit[k].observable, series)) return true;
        }
    }
    return false;
}

static bool same_shape(const ResultSeries *a, const ResultSeries *b) {
    if (a->axes != b->axes) return false;
    for (size_t i = 0; i < a->axes; i++) {
        if (a->axis[i].count != b->axis[i].count) return false;
    }
    return true;
}

// Letters, digits and '_' of the full name: all that gnuplot allows, and safe for a file.
static void name_files(char name[FIGURE_NAME], const ResultSeries *series) {
    snprintf(name, FIGURE_NAME, "%s_%s", series->stage, series->observable);
    for (char *c = name; *c; c++) {
        if (!isalnum((unsigned char)*c)) *c = '_';
    }
}

static void put_coordinate(Text *title, const ResultAxis *axis, size_t index) {
    if (title->length > 0) text_put(title, ", ");
    if (axis->labels && (strcmp(axis->name, "species") == 0 || strcmp(axis->name, "pair") == 0)) {
        // as the reader wrote it
        text_put(title, axis->labels[index]);
        return;
    }
    if (axis->labels) {
        notation_name(title, axis->labels[index]);
        return;
    }
    if (strcmp(axis->name, "wave_number") == 0)
        text_put(title, "q"); // of many curves in a legend that has little room
    else
        notation_name(title, axis->name);
    text_add(title, axis->unit[0] ? " = %.4g " : " = %.4g", axis->values[index]);
    notation_unit(title, axis->unit);
}

static bool axis_has(const ResultAxis *axis, const char *label) {
    for (size_t i = 0; axis->labels && i < axis->count; i++) {
        if (strcmp(axis->labels[i], label) == 0) return true;
    }
    return false;
}

// Of one species its own curve is the total.
static bool is_twice_the_same(const ResultAxis *axis) {
    return strcmp(axis->name, "pair") == 0 && axis->count == 2 && axis_has(axis, "total");
}

// The only label of an axis that is drawn: the one that the kind says, the total of one species, or
// the sum over species where there would be too many curves. NULL: all are.
static const char *only_label(const Figure *figure, const ResultAxis *axis) {
    static const char *const sums[] = {"all", "total"};
    if (figure->kind && figure->kind->only && axis_has(axis, figure->kind->only))
        return figure->kind->only;
    if (is_twice_the_same(axis)) return "total";
    for (size_t i = 0; figure->sums_alone && i < sizeof sums / sizeof *sums; i++) {
        if (axis_has(axis, sums[i])) return sums[i];
    }
    return NULL;
}

// What tells this curve from the others: its place on all axes but x that have several.
static void title_curve(Curve *curve, const Figure *figure, const size_t index[RESULT_AXES]) {
    Text title = {0};
    for (size_t i = 0; i < figure->series->axes; i++) {
        const ResultAxis *axis = &figure->series->axis[i];
        if (axis == figure->x || axis == figure->y || axis->count < 2) continue;
        if (!only_label(figure, axis)) put_coordinate(&title, axis, index[i]);
    }
    snprintf(curve->title, sizeof curve->title, "%s", text_words(&title));
    text_free(&title);
}

// A curve begins at this element: first along x, and on the only label of an axis that has one.
static bool begins_curve(const Figure *figure, const size_t index[RESULT_AXES]) {
    for (size_t i = 0; i < figure->series->axes; i++) {
        const ResultAxis *axis = &figure->series->axis[i];
        if ((axis == figure->x || axis == figure->y) && index[i] != 0) return false;
        const char *only = only_label(figure, axis);
        if (only && strcmp(axis->labels[index[i]], only) != 0) return false;
    }
    return true;
}

static bool has_number(const Figure *figure, size_t element) { // of any replica
    for (size_t r = 0; r < figure->results->replicas; r++) {
        if (isfinite(figure->series->values[r * figure->series->size + element])) return true;
    }
    return false;
}

// Points along x that have a number, from this element on.
static size_t points_from(const Figure *figure, size_t first) {
    size_t points = 0;
    for (size_t i = 0; i < figure->x->count; i++)
        points += has_number(figure, first + i * figure->stride);
    return points;
}

// Whether a curve with numbers begins at this element, and where that is on the axes.
static bool curve_at(const Figure *figure, size_t element, size_t index[RESULT_AXES]) {
    show_indices(figure->series, element, index);
    return begins_curve(figure, index) && points_from(figure, element) > 0;
}

static size_t count_curves(const Figure *figure) {
    size_t count = 0, index[RESULT_AXES];
    for (size_t element = 0; element < figure->series->size; element++)
        count += curve_at(figure, element, index);
    return count;
}

// Of more than there is room for, those of the sums, and of these some from the first to the last.
static void choose_curves(Figure *figure) {
    const size_t all = count_curves(figure);
    figure->sums_alone = all > FIGURE_CURVES;
    size_t count = count_curves(figure);
    if (count == 0 || count == all) { // there are no sums
        figure->sums_alone = false;
        count = all;
    }
    const size_t most = count < FIGURE_CURVES ? count : FIGURE_CURVES;
    size_t seen = 0, index[RESULT_AXES];
    for (size_t element = 0; figure->curve_count < most; element++) {
        if (!curve_at(figure, element, index)) continue;
        const size_t drawn = figure->curve_count;
        const bool its_turn = most < 2 || seen == drawn * (count - 1) / (most - 1);
        seen++;
        if (!its_turn) continue;
        Curve *curve = &figure->curve[figure->curve_count++];
        curve->first = element;
        title_curve(curve, figure, index);
    }
    figure->left_out = all - most;
}

static bool is_below_zero(const ResultAxis *x) {
    bool below = false;
    for (size_t i = 0; i < x->count; i++) below = below || x->values[i] < 0;
    return below;
}

// Without a row of its own, an axis is logarithmic if its points spread out along it, either way.
static bool spreads_out(const ResultAxis *x) {
    static const double SPREADS = 9; // gap over gap: a point per decade makes it 10
    const double *at = x->values;
    const size_t last = x->count - 1;
    const double one = fabs(at[1] - at[0]), other = fabs(at[last] - at[last - 1]);
    return at[0] > 0 && at[last] > 0 && !is_below_zero(x) &&
           fmax(one, other) > SPREADS * fmin(one, other);
}

// Rates of flows backwards have no place on a logarithmic axis, and their stresses none either.
static void choose_scales(Figure *figure) {
    const FigureKind *kind = figure->kind;
    const bool backwards = kind && kind->log_x && is_below_zero(figure->x);
    figure->log_x = kind ? kind->log_x && !backwards : spreads_out(figure->x);
    figure->log_y = kind && kind->log_y && !backwards;
}

// What a logarithmic axis shows of a curve: where it ends below zero, its negative.
static bool ends_below_zero(const Figure *figure, size_t curve) {
    for (size_t point = figure->x->count; point-- > 0;) {
        const size_t element = figure->curve[curve].first + point * figure->stride;
        const double value =
            results_series_estimate(figure->results, figure->series, element).value;
        if (isfinite(value)) return value < 0;
    }
    return false;
}

static void choose_signs(Figure *figure) {
    const bool positive = !figure->log_y || figure->line;
    for (size_t c = 0; !positive && c < figure->curve_count; c++) {
        figure->curve[c].negative = ends_below_zero(figure, c);
    }
}

// Of several pictures one is drawn: that at the last numbers, such as the strongest force of a
// sweep, of the first labels.
static bool is_furthest(const Figure *figure, const size_t index[RESULT_AXES]) {
    for (size_t i = 0; i < figure->series->axes; i++) {
        const ResultAxis *axis = &figure->series->axis[i];
        if (axis == figure->x || axis == figure->y || only_label(figure, axis)) continue;
        if (index[i] != (axis->values ? axis->count - 1 : 0)) return false;
    }
    return true;
}

static void choose_picture(Figure *figure) {
    size_t index[RESULT_AXES];
    const size_t all = count_curves(figure);
    for (size_t element = 0; element < figure->series->size; element++) {
        if (!curve_at(figure, element, index) || !is_furthest(figure, index)) continue;
        figure->curve[0].first = element;
        title_curve(&figure->curve[0], figure, index);
    }
    figure->curve_count = all > 0;
    figure->left_out = all - figure->curve_count;
}

static size_t stride_of(const ResultSeries *series, size_t axis) {
    size_t stride = 1;
    for (size_t i = axis + 1; i < series->axes; i++) stride *= series->axis[i].count;
    return stride;
}

static void choose_upward(Figure *figure) {
    for (size_t i = 0; i < figure->series->axes; i++) {
        const ResultAxis *axis = &figure->series->axis[i];
        if (strcmp(axis->name, figure->kind->upward) != 0 || axis->count < 2) continue;
        figure->y = axis;
        figure->y_stride = stride_of(figure->series, i);
    }
}

// Another series of the stage, if it has the shape of the figure's; NULL without.
static const ResultSeries *beside(const Figure *figure, const char *observable) {
    if (!observable) return NULL;
    const ResultSeries *series =
        results_find_series(figure->results, figure->series->stage, observable);
    return series && same_shape(series, figure->series) ? series : NULL;
}

Figure figure_of(const Results *results, const ResultSeries *series) {
    const FigureKind *kind = figure_kind_of(series);
    const size_t along = axis_to_draw_along(series);
    ASSERT(along != NO_AXIS);
    Figure figure = {.results = results, .series = series, .kind = kind};
    figure.x = &series->axis[along];
    figure.stride = stride_of(series, along);
    if (kind && kind->upward) choose_upward(&figure);
    if (kind) figure.line = beside(&figure, kind->line);
    for (size_t k = 0; kind && k < FIGURE_LIMITS; k++) {
        figure.limit[k] = beside(&figure, kind->limit[k].observable);
    }
    if (kind && kind->level) {
        figure.level = results_find_scalar(results, series->stage, kind->level);
    }
    name_files(figure.name, series);
    choose_curves(&figure);
    choose_scales(&figure);
    choose_signs(&figure);
    if (figure.y) choose_picture(&figure);
    return figure;
}

bool figure_exists(const Results *results, const ResultSeries *series) {
    const FigureKind *kind = figure_kind_of(series);
    if (kind && kind->aside) return false;
    if (axis_to_draw_along(series) == NO_AXIS || stands_behind_another(series)) return false;
    const Figure figure = figure_of(results, series);
    for (size_t c = 0; c < figure.curve_count; c++) {
        if (figure.y || points_from(&figure, figure.curve[c].first) > 1) return true;
    }
    return false;
}

void figure_title(Text *text, const Figure *figure) {
    const char *name = figure->series->observable;
    if (figure->kind && figure->kind->title) {
        char from[2 * RESULT_NAME];
        text_put(text, figure->kind->title);
        if (name_without_centre(from, figure->series)) text_put(text, ", about the centre of mass");
        return;
    }
    const char first = (char)toupper((unsigned char)name[0]);
    text_bytes(text, &first, 1);
    notation_name(text, name + 1);
}

size_t figure_columns(const Figure *figure) {
    size_t columns = figure->line ? 3 : 2;
    for (size_t k = 0; k < FIGURE_LIMITS; k++) columns += figure->limit[k] != NULL;
    return columns;
}

// Of a theory only what comes from a measured structure has errors.
static bool knows_errors(const Figure *figure) {
    for (size_t i = 0; i < figure->series->size; i++) {
        if (results_series_estimate(figure->results, figure->series, i).n > 1) return true;
    }
    return false;
}

bool figure_has_errors(const Figure *figure) {
    if (figure_is_theory(figure)) return figure->results->replicas > 1 && knows_errors(figure);
    return figure->results->replicas > 1 || results_own_errors(figure->results, figure->series);
}

bool figure_is_theory(const Figure *figure) { // stages of theories bear their section's name
    const char *stage = figure->series->stage;
    return strcmp(stage, "theory") == 0 || strcmp(stage, "schematic") == 0;
}

bool figure_rests(const Figure *figure) {
    return figure->kind && figure->kind->rest && figure->log_x && figure->x->values[0] == 0;
}

bool figure_is_dense(const Figure *figure) {
    enum { MARKS_MOST = 60 };
    return figure->x->count > MARKS_MOST;
}

// Where the curves are on axes with one number, of which their titles say nothing.
static void put_places(Text *text, const Figure *figure) {
    Text places = {0};
    for (size_t i = 0; i < figure->series->axes; i++) {
        const ResultAxis *axis = &figure->series->axis[i];
        if (axis->values && axis->count == 1) put_coordinate(&places, axis, 0);
    }
    if (places.length > 0) text_add(text, " At %s.", text_words(&places));
    text_free(&places);
}

// What this run says of the number behind the line, where it is not what such numbers are said to
// be: that it is a bound.
static void put_level(Text *text, const ResultScalar *level) {
    const ResultMeaning *meaning = result_meaning(level->quantity);
    if (meaning && strcmp(level->about, meaning->about) != 0) text_add(text, " %s", level->about);
}

void figure_caption(Text *text, const Figure *figure) {
    const Results *results = figure->results;
    const FigureKind *kind = figure->kind;
    const bool simulated = kind && kind->about && !figure_is_theory(figure);
    notation_unit(text, simulated ? kind->about : figure->series->about);
    put_places(text, figure);
    if ((figure->line || figure->level || figure->limit[0]) && kind->about_line)
        text_add(text, " %s", kind->about_line);
    if (figure->level) put_level(text, figure->level);
    const char *shown = figure_is_dense(figure) ? "bands" : "bars";
    if (figure_is_theory(figure)) {
        if (figure_has_errors(figure) && !figure->y)
            text_add(text, " In %s: standard error, by leaving out parts of what was measured.",
                     shown);
    } else if (figure_has_errors(figure) && figure->y) {
        text_add(text, " Mean over %zu replicas.", results->replicas);
    } else if (figure_has_errors(figure)) {
        if (results->replicas > 1)
            text_add(text, " Mean over %zu replicas; %s: standard error of the mean.",
                     results->replicas, shown);
        else
            text_add(text, " One replica; %s: standard error over its trajectories.", shown);
    } else {
        text_put(text, " One replica, hence no errors.");
    }
    if (figure->sums_alone && !figure->y) text_put(text, " Of all species together.");
    if (figure->left_out > 0 && figure->y)
        text_add(text, " This is that of %s; the others are in results.h5.",
                 figure->curve[0].title);
    if (figure->left_out > 0 && !figure->y) {
        text_add(text, " %zu further curve%s in the numbers.", figure->left_out,
                 figure->left_out == 1 ? " is" : "s are");
    }
    if (!results_side_by_side(results, figure->series))
        text_put(text, " Only of points of the sweep whose other axes are those of the first; the "
                       "reports of the others have theirs.");
}

static void put_number(Text *csv, double value) { // empty where there is none
    char digits[NUMBER_SIZE];
    text_put(csv, ",");
    if (isfinite(value)) text_put(csv, number_write(digits, value));
}

static void numbers_header(Text *csv, const Figure *figure) {
    text_put(csv, figure->x->name);
    for (size_t c = 0; c < figure->curve_count; c++) {
        const char *title = figure->curve[c].title[0] ? figure->curve[c].title : "value";
        text_add(csv, ",\"%s\",\"%s error\"", title, title);
        if (figure->line) text_add(csv, ",\"%s %s\"", title, figure->kind->line_title);
        for (size_t k = 0; k < FIGURE_LIMITS; k++) {
            if (!figure->limit[k]) continue;
            text_add(csv, ",\"%s %s\"", title, figure->kind->limit[k].observable);
        }
    }
    text_put(csv, "\n");
}

static void put_point(Text *csv, const Figure *figure, size_t element) {
    const Results *results = figure->results;
    const Estimate point = results_series_estimate(results, figure->series, element);
    put_number(csv, point.value);
    put_number(csv, point.error);
    if (figure->line)
        put_number(csv, results_series_estimate(results, figure->line, element).value);
    for (size_t k = 0; k < FIGURE_LIMITS; k++) {
        if (!figure->limit[k]) continue;
        put_number(csv, results_series_estimate(results, figure->limit[k], element).value);
    }
}

void figure_numbers(Text *csv, const Figure *figure) {
    numbers_header(csv, figure);
    for (size_t i = 0; i < figure->x->count; i++) {
        char digits[NUMBER_SIZE];
        text_put(csv, number_write(digits, figure->x->values[i]));
        for (size_t c = 0; c < figure->curve_count; c++) {
            put_point(csv, figure, figure->curve[c].first + i * figure->stride);
        }
        text_put(csv, "\n");
    }
}
