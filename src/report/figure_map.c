// SPDX-License-Identifier: GPL-3.0-or-later
// A figure over two axes of numbers: a picture whose colour is the value.
#include "report/figure.h"

#include "base/number.h"
#include "report/gnuplot.h"
#include "report/notation.h"

#include <math.h>
#include <string.h>

static void put_number(Text *csv, double value, const char *before) { // NaN where there is none
    char digits[NUMBER_SIZE];
    text_put(csv, before);
    text_put(csv, isfinite(value) ? number_write(digits, value) : "NaN");
}

void figure_map_numbers(Text *csv, const Figure *figure) {
    text_add(csv, "%s,%s,value,error\n", figure->x->name, figure->y->name);
    for (size_t i = 0; i < figure->x->count; i++) {
        for (size_t k = 0; k < figure->y->count; k++) {
            const size_t element =
                figure->curve[0].first + i * figure->stride + k * figure->y_stride;
            const Estimate point =
                results_series_estimate(figure->results, figure->series, element);
            put_number(csv, figure->x->values[i], "");
            put_number(csv, figure->y->values[k], ",");
            put_number(csv, point.value, ",");
            put_number(csv, point.error, ",");
            text_put(csv, "\n");
        }
    }
}

// Light grows with the value, evenly to the eye; signed values go from blue through white to red,
// in the colours of the curves.
static const char EVEN[] = "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', "
                           "3 '#5ec962', 4 '#fde725')\nset cbrange [0:*]\n";
static const char SIGNED[] = "set palette defined (-1 '#0072B2', 0 '#ffffff', 1 '#D55E00')\n"
                             "stats data using 3 every ::1 nooutput\n"
                             "most = abs(STATS_min) > STATS_max ? abs(STATS_min) : STATS_max\n"
                             "set cbrange [-most:most]\n";

// The symbols are those of figures.def, in gnuplot's notation: q_x.
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
    text_put(script, "\n");
    text_free(&label);
}

static bool has_one_scale(const Figure *figure) {
    return strcmp(figure->x->unit, figure->y->unit) == 0;
}

// From the first to the last value.
static double length_of(const ResultAxis *axis) {
    return axis->values[axis->count - 1] - axis->values[0];
}

// Of one scale it is as high as its shape asks, and leaves no blank above and below.
static int height_of(const Figure *figure) {
    enum { FRAME = 100, HIGH = 420 };
    if (!has_one_scale(figure)) return FRAME + HIGH;
    return FRAME + (int)(HIGH * fmin(1, length_of(figure->y) / length_of(figure->x)));
}

void figure_map_script(Text *script, const Figure *figure) {
    text_add(script,
             "# Draws %s.svg from %s.csv: gnuplot %s.gp\n"
             "set encoding utf8\n"
             "set terminal svg size 640,%d enhanced font 'Helvetica,Arial,sans-serif,18' name "
             "'%s'\n"
             "set output '%s.svg'\n"
             "set datafile separator ','\n"
             "data = '%s.csv'\n"
             "set border linewidth 1.2\n"
             "set tics out scale 0.8\n"
             "unset key\n",
             figure->name, figure->name, figure->name, height_of(figure), figure->name,
             figure->name, figure->name);
    if (has_one_scale(figure)) text_put(script, "set size ratio -1\n");
    text_put(script, figure->kind->signed_colour ? SIGNED : EVEN);
    put_label(script, "x", figure->kind->x, figure->x->unit);
    put_label(script, "y", figure->kind->y, figure->y->unit);
    put_label(script, "cb", figure->kind->colour, figure->series->unit);
    const ResultAxis *x = figure->x, *y = figure->y; // to the outer edges of the pixels
    const double half_x = (x->values[1] - x->values[0]) / 2;
    const double half_y = (y->values[1] - y->values[0]) / 2;
    text_add(script, "set xrange [%.10g:%.10g]\nset yrange [%.10g:%.10g]\n", x->values[0] - half_x,
             x->values[x->count - 1] + half_x, y->values[0] - half_y,
             y->values[y->count - 1] + half_y);
    // Cells without a number must stay in the grid: were they called missing, all that follow would
    // be drawn one place too early.
    text_put(script, "plot data using 1:2:3 every ::1 with image pixels\n");
}
