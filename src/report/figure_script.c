// SPDX-License-Identifier: GPL-3.0-or-later
// The gnuplot script of a figure: plain enough to be edited by hand for a paper.
#include "report/figure.h"

#include "report/gnuplot.h"
#include "report/notation.h"
#include "report/palette.h"
#include "report/utf8.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const int MARKS[PALETTE_SIZE] = {7, 5, 9, 11, 13, 6, 4, 8}; // gnuplot's point types

enum { VALUE_SIZE = 128 };

#define MINUS "minus " // before the name of a curve with its sign turned

#define REFERENCE "dashtype (6,4) linewidth 1.6 linecolor rgb '#333333'"

// Columns of the numbers: x, then for each curve its value, its error and, if any, its line and its
// limits.
static size_t value_column(const Figure *figure, size_t curve) {
    return 2 + curve * figure_columns(figure);
}

static void put_label(Text *script, const char *axis, const char *symbol, const char *unit) {
    Text label = {0};
    text_put(&label, symbol);
    if (unit[0]) {
        text_put(&label, "  [");
        notation_unit(&label, unit);
        text_put(&label, "]");
    }
    text_add(script, "set %slabel ", axis);
    gnuplot_quoted(script, text_words(&label));
    text_put(script, " noenhanced\n");
    text_free(&label);
}

static void put_x_label(Text *script, const Figure *figure) {
    Text name = {0};
    if (figure->kind && figure->kind->x)
        text_put(&name, figure->kind->x);
    else
        notation_name(&name, figure->x->name);
    put_label(script, "x", text_words(&name), figure->x->unit);
    text_free(&name);
}

static void put_y_label(Text *script, const Figure *figure) {
    Text name = {0};
    if (figure->kind && figure->kind->y)
        text_put(&name, figure->kind->y);
    else
        notation_name(&name, figure->series->observable);
    put_label(script, "y", text_words(&name), figure->series->unit);
    text_free(&name);
}

static bool has_ratio(const Figure *figure) {
    return figure->line && figure->kind->ratio;
}

static bool is_sum(const Figure *figure, size_t curve) { // over species
    const char *title = figure->curve[curve].title;
    return strcmp(title, "all") == 0 || strcmp(title, "total") == 0;
}

// Black for sums, a colour of its own for every other curve.
static size_t look_of(const Figure *figure, size_t curve) {
    static const size_t BLACK = 7; // in the palette, from 1
    return is_sum(figure, curve) ? BLACK : curve + 1;
}

static void put_looks(Text *script, const Figure *figure) {
    for (size_t c = 0; c < figure->curve_count; c++) {
        const size_t look = look_of(figure, c);
        text_add(script,
                 "set linetype %zu linecolor rgb '%s' linewidth 1.6 pointtype %d pointsize 0.7\n",
                 look, PALETTE[look - 1], MARKS[look - 1]);
    }
}

static const size_t HEIGHT = 480, RATIO_HEIGHT = 720; // of one panel and of two, in pixels

static size_t panels_height(const Figure *figure) {
    return has_ratio(figure) ? RATIO_HEIGHT : HEIGHT;
}

// Many names would lie on the curves: they go below, in columns as wide as the longest.
typedef struct Legend {
    bool below;
    size_t columns, height; // in pixels
    size_t narrower;        // columns, in letters of gnuplot's, which are wider than those drawn
} Legend;

static Legend legend_of(const Figure *figure) {
    enum { KEY_MOST = 4, WIDTH = 700, LETTER = 8, SAMPLE = 70, ROW = 26 };
    size_t longest = 1, names = figure->curve_count;
    for (size_t c = 0; c < figure->curve_count; c++) {
        const size_t sign = figure->curve[c].negative ? sizeof MINUS - 1 : 0;
        const size_t letters = sign + utf8_letters(figure->curve[c].title);
        if (letters > longest) longest = letters;
    }
    for (size_t k = 0; k < FIGURE_LIMITS; k++) {
        names += figure->limit[k] && figure->kind->limit[k].title;
    }
    const size_t fit = WIDTH / (longest * LETTER + SAMPLE), columns = fit > 1 ? fit : 1;
    const size_t rows = (names + columns) / columns; // and one for what lies beside
    const bool below = names > KEY_MOST;
    return (Legend){below, columns, below ? rows * ROW : 0, longest / 4};
}

static void put_key(Text *script, const Figure *figure) {
    const Legend legend = legend_of(figure);
    const char *key = figure->kind && figure->kind->key ? figure->kind->key : "above";
    if (!legend.below) {
        text_add(script, "set key %s noenhanced samplen 2 spacing 1.2\n", key);
        return;
    }
    if (has_ratio(figure)) // gnuplot's own place below would be below the upper panel
        text_add(script, "set key at screen 0.5575, screen %.4f center top horizontal",
                 (double)legend.height / (double)(RATIO_HEIGHT + legend.height));
    else
        text_put(script, "set key below height 1");
    text_add(script, " maxcols %zu width -%zu font ',14' noenhanced samplen 2 spacing 1.2\n",
             legend.columns, legend.narrower);
}

static void put_head(Text *script, const Figure *figure) {
    text_add(
        script,
        "# Draws %s.svg from %s.csv: gnuplot %s.gp\n"
        "set encoding utf8\n"
        "set terminal svg size 760,%zu enhanced font 'Helvetica,Arial,sans-serif,18' name '%s'\n"
        "set output '%s.svg'\n"
        "set datafile separator ','\n"
        "data = '%s.csv'\n"
        "set border linewidth 1.2\n"
        "set tics scale 0.8\n"
        "set style fill transparent solid 0.25 noborder\n",
        figure->name, figure->name, figure->name, panels_height(figure) + legend_of(figure).height,
        figure->name, figure->name, figure->name);
    put_looks(script, figure);
    put_key(script, figure);
}

static void put_y_scale(Text *script, const Figure *figure) {
    const FigureKind *kind = figure->kind;
    if (kind && kind->y_low < kind->y_high)
        text_add(script, "set format y '%%g'\nset yrange [%g:%g]\n", kind->y_low, kind->y_high);
    else if (!figure->log_y)
        text_put(script, "set format y '%g'\n");
    else if (kind->y_least > 0)
        text_add(
            script,
            "set logscale y\nset format y '%%g'\nset yrange [%g:*]\n"
            "set autoscale yfixmax\nset offsets 0, 0, graph 0.08, 0\n"
            "set ytics (0.5, 0.7, 1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 200, 500)\n",
            kind->y_least);
    else
        text_put(script, "set logscale y\nset format y '10^{%T}'\n");
}

// Marks at the ends stand beside the frame, not on it.
static void put_x_scale(Text *script, const Figure *figure) {
    if (figure->log_x)
        text_put(script, "set logscale x\nset format x '10^{%T}'\n");
    else if (!figure_is_dense(figure))
        text_put(script, "set autoscale xfix\nset offsets graph 0.03, graph 0.03, 0, 0\n");
}

static void put_axes(Text *script, const Figure *figure) {
    put_x_scale(script, figure);
    put_y_scale(script, figure);
    put_x_label(script, figure);
    put_y_label(script, figure);
}

// The lower edge of a band, the lower end of a bar. On a logarithmic axis a tenth of the value is
// low enough: one as large as its error would otherwise take the axis down with it.
static void put_lower(Text *script, const Figure *figure, const char *value, const char *error) {
    if (figure->log_y)
        text_add(script, "((%s) < 0.9*(%s) ? (%s) - (%s) : 0.1*(%s))", error, value, value, error,
                 value);
    else
        text_add(script, "(%s - (%s))", value, error);
}

// Marks with bars; where there are too many points for them, a line in a band. A sum among marks is
// a plain line, not to hide its parts.
static void put_curve(Text *script, const Figure *figure, size_t curve, const char *value,
                      const char *error, const char *title) {
    const bool has_errors = figure_has_errors(figure), dense = figure_is_dense(figure);
    const size_t look = look_of(figure, curve);
    if (curve > 0) text_put(script, ", \\\n");
    if (has_errors && dense) {
        text_put(script, "  data using 1:");
        put_lower(script, figure, value, error);
        text_add(script, ":(%s + (%s)) with filledcurves linetype %zu notitle, \\\n", value, error,
                 look);
    }
    const bool marks = !dense && !is_sum(figure, curve);
    text_add(script, "  data using 1:(%s)", value);
    if (has_errors && marks) {
        text_put(script, ":");
        put_lower(script, figure, value, error);
        text_add(script, ":(%s + (%s)) with yerrorlines", value, error);
    } else
        text_add(script, " with %s", marks ? "linespoints" : "lines");
    text_add(script, " linetype %zu title ", look);
    gnuplot_quoted(script, title);
}

// A single curve needs no name unless something else is drawn beside it.
static const char *title_of(const Figure *figure, size_t curve) {
    const bool alone = !figure->line && !figure->level && !(figure->kind && figure->kind->formula);
    const char *title = figure->curve[curve].title;
    if (title[0] || alone) return title;
    return figure_is_theory(figure) ? "theory" : "simulation";
}

// Noise, and what is so noisy that it has no error, would set the scale of the axis if all points
// were drawn.
static void name_value(char value[VALUE_SIZE], const Figure *figure, size_t curve) {
    const double coarse = figure->kind && figure_has_errors(figure) ? figure->kind->coarse : 0;
    const char *sign = figure->curve[curve].negative ? "-" : "";
    const size_t column = value_column(figure, curve);
    if (coarse > 0)
        snprintf(value, VALUE_SIZE, "valid(%zu) && column(%zu) <= %g ? %s$%zu : NaN", column + 1,
                 column + 1, coarse, sign, column);
    else
        snprintf(value, VALUE_SIZE, "%s$%zu", sign, column);
}

// A point of which the error is unknown is drawn without a bar: valid(3) asks. It would be skipped
// if the error were called $3.
static void put_curves(Text *script, const Figure *figure) {
    for (size_t c = 0; c < figure->curve_count; c++) {
        char value[VALUE_SIZE], error[64], title[sizeof figure->curve[c].title + sizeof MINUS];
        const size_t column = value_column(figure, c);
        name_value(value, figure, c);
        snprintf(error, sizeof error, "valid(%zu) ? column(%zu) : 0", column + 1, column + 1);
        snprintf(title, sizeof title, "%s%s", figure->curve[c].negative ? MINUS : "",
                 title_of(figure, c));
        put_curve(script, figure, c, value, error, title);
    }
}

static void put_ratios(Text *script, const Figure *figure) {
    for (size_t c = 0; c < figure->curve_count; c++) {
        char value[32], error[64];
        const size_t column = value_column(figure, c);
        snprintf(value, sizeof value, "$%zu/$%zu", column, column + 2);
        snprintf(error, sizeof error, "valid(%zu) ? column(%zu)/$%zu : 0", column + 1, column + 1,
                 column + 2);
        put_curve(script, figure, c, value, error, "");
    }
    text_put(script, ", \\\n  1 with lines " REFERENCE " notitle\n");
}

static void put_reference_title(Text *script, const char *title, bool first) {
    text_put(script, first ? " title " : " notitle");
    if (first) gnuplot_quoted(script, title);
}

// The ends of the x axis as it is drawn, and its middle: a logarithmic one has no place for 0.
typedef struct Span {
    size_t first; // point
    double begin, middle, end;
} Span;

static Span span_of(const Figure *figure) {
    const double *x = figure->x->values;
    const bool is_log = figure->log_x;
    Span span = {.end = x[figure->x->count - 1]};
    while (is_log && span.first + 1 < figure->x->count && x[span.first] <= 0) span.first++;
    span.begin = x[span.first];
    span.middle = is_log ? sqrt(span.begin * span.end) : (span.begin + span.end) / 2;
    return span;
}

static double value_at(const Figure *figure, const ResultSeries *series, size_t curve,
                       size_t point) {
    const size_t element = figure->curve[curve].first + point * figure->stride;
    return results_series_estimate(figure->results, series, element).value;
}

// A level over half of the x axis, in the colour of its curve.
static void put_half(Text *script, const Figure *figure, size_t curve, double value, bool right,
                     const char *dash) {
    const Span span = span_of(figure);
    if (!isfinite(value)) return;
    text_add(script,
             ", \\\n  [%.10g:%.10g] '+' using 1:(%.10g) with lines linetype %zu dashtype %s "
             "notitle",
             right ? span.middle : span.begin, right ? span.end : span.middle, value,
             look_of(figure, curve), dash);
}

// What levels of this dash are, in grey.
static void put_dash_title(Text *script, const char *dash, const char *title) {
    text_add(script, ", \\\n  keyentry with lines linecolor rgb '#333333' dashtype %s title ",
             dash);
    gnuplot_quoted(script, title);
}

static void put_limits(Text *script, const Figure *figure) {
    const size_t last = figure->x->count - 1;
    for (size_t k = 0; k < FIGURE_LIMITS; k++) {
        if (!figure->limit[k]) continue;
        const FigureLimit *limit = &figure->kind->limit[k];
        const char *dash = limit->dotted ? "(2,4)" : "(9,5)";
        const size_t point = limit->right ? last : span_of(figure).first;
        for (size_t c = 0; c < figure->curve_count; c++) {
            put_half(script, figure, c, value_at(figure, figure->limit[k], c, point), limit->right,
                     dash);
        }
        if (limit->title) put_dash_title(script, dash, limit->title);
    }
}

// What stands at x = 0 is where the curves begin, and not on a logarithmic axis.
static void put_rest(Text *script, const Figure *figure) {
    static const char DASH[] = "(14,4,2,4)";
    if (!figure_rests(figure)) return;
    for (size_t c = 0; c < figure->curve_count; c++) {
        put_half(script, figure, c, value_at(figure, figure->series, c, 0), false, DASH);
    }
    put_dash_title(script, DASH, figure->kind->rest);
}

// What the curves are compared with: other numbers, a function, or a level.
static void put_references(Text *script, const Figure *figure) {
    const FigureKind *kind = figure->kind;
    for (size_t c = 0; figure->line && c < figure->curve_count; c++) {
        text_add(script, ", \\\n  data using 1:%zu with lines " REFERENCE,
                 value_column(figure, c) + 2);
        put_reference_title(script, kind->line_title, c == 0);
    }
    if (kind && kind->formula) {
        text_add(script, ", \\\n  %s with lines " REFERENCE, kind->formula);
        put_reference_title(script, kind->line_title, true);
    }
    if (figure->level) {
        const Estimate level = results_scalar_estimate(figure->results, figure->level);
        text_add(script, ", \\\n  %.10g with lines " REFERENCE, level.value);
        put_reference_title(script, kind->level_title, true);
    }
    put_limits(script, figure);
    put_rest(script, figure);
    text_put(script, "\n");
}

// Where this share of the height of the panels is in the picture, a legend being below them.
static double height_of(const Figure *figure, double share) {
    const double legend = (double)legend_of(figure).height;
    return (legend + share * (double)RATIO_HEIGHT) / (legend + (double)RATIO_HEIGHT);
}

static void put_panel(Text *script, const Figure *figure, double top, double bottom) {
    text_add(script, "set tmargin at screen %.4f\nset bmargin at screen %.4f\n",
             height_of(figure, top), height_of(figure, bottom));
}

// Two panels over one x axis.
static void put_panels(Text *script, const Figure *figure) {
    text_put(script, "set multiplot\n"
                     "set lmargin at screen 0.145\nset rmargin at screen 0.97\n");
    put_panel(script, figure, 0.965, 0.42);
    text_put(script, "unset xlabel\nset format x ''\n"
                     "plot \\\n");
    put_curves(script, figure);
    put_references(script, figure);
    put_panel(script, figure, 0.39, 0.12);
    text_put(script, "set format x '10^{%T}'\nunset logscale y\nset format y '%g'\n");
    put_x_label(script, figure);
    put_label(script, "y", figure->kind->ratio, "");
    text_put(script, "set yrange [0:*]\nset offsets 0, 0, graph 0.1, 0\n"
                     "plot \\\n");
    put_ratios(script, figure);
    text_put(script, "unset multiplot\n");
}

void figure_script(Text *script, const Figure *figure) {
    put_head(script, figure);
    put_axes(script, figure);
    if (has_ratio(figure)) {
        put_panels(script, figure);
        return;
    }
    text_put(script, "plot \\\n");
    put_curves(script, figure);
    put_references(script, figure);
}
