// SPDX-License-Identifier: GPL-3.0-or-later
// A series as a figure: its numbers (CSV), the gnuplot script that draws them, the picture (SVG)
// and what to say about it.
#pragma once

#include "base/text.h"
#include "results/results.h"

#include <stdbool.h>

// What theory says of one end of the x axis: another series of the stage and of this shape, drawn
// over that half of it, in the colour of its curve.
typedef struct FigureLimit {
    const char *observable;
    const char *title;  // of this and the next ones, up to the next that has one
    bool right, dotted; // else left, dashed
} FigureLimit;

enum { FIGURE_LIMITS = 4 };

// How an observable is drawn. Whatever has no row in figures.def is drawn by the plain rule.
typedef struct FigureKind {
    const char *observable;
    const char *axis;  // that the series must have; NULL: any
    bool aside;        // not drawn: it is there for others that are made of it
    const char *along; // the axis along x; NULL: time, or the longest
    const char *title;
    const char *x, *y; // symbols
    bool log_x, log_y;
    double y_least;       // where a logarithmic y axis of a decade or two begins; 0: of any length
    double y_low, y_high; // what of a linear y axis is shown, where values run away; both 0: all
    const char *key;      // where gnuplot puts the legend
    const char *only;     // of the labels of an axis that has it, the one to draw
    const char *line;     // another series of the stage, of this shape: drawn as lines
    const char *formula;  // or a function of x, in gnuplot's notation
    const char *line_title;
    const char *ratio;  // symbol of value/line, in a panel below
    const char *upward; // the axis along y of a picture whose colour is the value, `y` its symbol
    const char *colour; // symbol of the value in such a picture
    bool signed_colour; // it may be negative: white is zero
    const char *level;  // a scalar of the stage, drawn as a horizontal line
    const char *level_title;
    FigureLimit limit[FIGURE_LIMITS];
    const char *rest;       // title of the levels of values at x = 0, where x is logarithmic
    double coarse;          // points with a larger error are not drawn; 0: all are
    const char *about;      // what is to be seen, a sentence for the caption
    const char *about_line; // and about the line, where there is one
} FigureKind;

const FigureKind *figure_kind(size_t row);                    // of figures.def; NULL past the last
const FigureKind *figure_kind_of(const ResultSeries *series); // NULL for the plain rule

// It has an axis of numbers to draw along, some numbers, and is not drawn behind another.
bool figure_exists(const Results *results, const ResultSeries *series);

enum { FIGURE_CURVES = 8, FIGURE_NAME = 2 * RESULT_NAME };

typedef struct Curve {
    size_t first; // element at the beginning of the x axis
    char title[3 * RESULT_NAME];
    bool negative; // drawn with its sign turned, of which its name tells
} Curve;

typedef struct Figure {
    const Results *results;
    const ResultSeries *series;
    const ResultSeries *line;                 // NULL without
    const ResultScalar *level;                // NULL without
    const ResultSeries *limit[FIGURE_LIMITS]; // as in its kind; NULL without
    const FigureKind *kind;                   // NULL for the plain rule
    char name[FIGURE_NAME];                   // of the files, without ending
    const ResultAxis *x;
    size_t stride; // elements from one point to the next along x
    bool log_x, log_y;
    const ResultAxis *y; // of a picture whose colour is the value; NULL for curves
    size_t y_stride;
    bool sums_alone;    // curves of single species are left out: there would be too many
    size_t curve_count; // drawn
    size_t left_out;    // further curves, or pictures, not drawn
    Curve curve[FIGURE_CURVES];
} Figure;

size_t figure_columns(const Figure *figure); // of the numbers of a curve
bool figure_is_theory(const Figure *figure); // not of a simulation: has neither replicas nor errors
bool figure_has_errors(const Figure *figure);
bool figure_rests(const Figure *figure);    // has values at x = 0 beside a logarithmic axis
bool figure_is_dense(const Figure *figure); // too many points for a mark on each

Figure figure_of(const Results *results, const ResultSeries *series);

void figure_title(Text *text, const Figure *figure);
void figure_caption(Text *text, const Figure *figure);
void figure_numbers(Text *csv, const Figure *figure);
void figure_script(Text *script, const Figure *figure);

// The same of a figure with y.
void figure_map_numbers(Text *csv, const Figure *figure);
void figure_map_script(Text *script, const Figure *figure);

// Writes FOLDER/NAME.csv and .gp, lets gnuplot draw NAME.svg, and adds that to `page`.
Status figure_draw(Text *page, const Figure *figure, const char *folder);
