// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the snapshot observable. Discs: all of them, with their periodic images at the borders.
// Bodies in three dimensions: seen along z, the far ones first and paler, down to where hardly any
// is seen.
#include "report/picture.h"

#include "base/constants.h"
#include "base/memory.h"
#include "report/html.h"
#include "report/palette.h"
#include "report/picture_body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Of the snapshot; the last four where some species has a body axis.
enum { X, Y, Z, DIAMETER, SPECIES, LENGTH, AXIS, COLUMNS_OF_BALLS = LENGTH, COLUMNS = AXIS + 3 };
enum { PARTICLES_MOST = 6000 };    // of a page that is still quick to open
static const double LAYERS = 3.0;  // bodies above a point at the depth down to which is drawn
static const double WIDTH = 560.0; // of the picture, in pixels

typedef struct View {
    const Results *results;
    const ResultSeries *series;
    int dimension;
    size_t columns;
    double box[3];      // in d
    double window[2];   // the part that is drawn, from the origin, in d
    double director[3]; // 0 without axes
    double depth;       // of what is drawn, from the top, in d
    size_t particles;   // in the snapshot
} View;

bool picture_uses(const ResultSeries *series) {
    return strcmp(series->observable, "snapshot") == 0 ||
           strcmp(series->observable, "snapshot_box") == 0 ||
           strcmp(series->observable, "snapshot_director") == 0;
}

static bool is_length(double value) {
    return isfinite(value) && value > 0;
}

bool picture_exists(const Results *results, const ResultSeries *series) {
    if (strcmp(series->observable, "snapshot") != 0 || series->axes != 2) return false;
    const ResultSeries *box = results_find_series(results, series->stage, "snapshot_box");
    if (!box || (box->size != 2 && box->size != 3)) return false;
    for (size_t a = 0; a < box->size; a++) {
        if (!is_length(results_series_estimate(results, box, a).value)) return false;
    }
    return series->axis[1].count == COLUMNS_OF_BALLS || series->axis[1].count == COLUMNS;
}

static double number(const View *view, size_t particle, int column) {
    if ((size_t)column >= view->columns) return 0;
    const size_t element = particle * view->columns + (size_t)column;
    return results_series_estimate(view->results, view->series, element).value;
}

static size_t species(const View *view, size_t particle) {
    const double index = number(view, particle, SPECIES);
    return index >= 0 && index < 256 ? (size_t)index : 0;
}

static double tilt(const View *view, const double axis[3]) {
    double cosine = 0;
    for (int a = 0; a < 3; a++) cosine += axis[a] * view->director[a];
    return acos(fmin(1, fabs(cosine))) / (PI / 2);
}

static PictureBody body_of(const View *view, size_t particle) {
    PictureBody body = {.radius = number(view, particle, DIAMETER) / 2,
                        .length = number(view, particle, LENGTH),
                        .species = species(view, particle)};
    for (int a = 0; a < 3; a++) {
        body.centre[a] = number(view, particle, X + a);
        body.axis[a] = number(view, particle, AXIS + a);
    }
    body.tilt = tilt(view, body.axis);
    return body;
}

static bool is_drawable(const PictureBody *body) {
    double sum = 0;
    for (int a = 0; a < 3; a++) sum += body->centre[a] + body->axis[a];
    return isfinite(sum) && is_length(body->radius) && body->length >= 0 && isfinite(body->length);
}

// Down to where LAYERS bodies lie above a point in the mean; the box at most.
static double depth_of(const View *view) {
    double shadows = 0;
    for (size_t i = 0; i < view->particles; i++) {
        const PictureBody body = body_of(view, i);
        if (is_drawable(&body)) shadows += picture_body_shadow(&body);
    }
    return view->box[2] * fmin(1, LAYERS * view->box[0] * view->box[1] / shadows);
}

static View view_of(const Results *results, const ResultSeries *series) {
    const ResultSeries *box = results_find_series(results, series->stage, "snapshot_box");
    const ResultSeries *director = results_find_series(results, series->stage, "snapshot_director");
    View view = {.results = results,
                 .series = series,
                 .dimension = (int)box->size,
                 .columns = series->axis[1].count,
                 .particles = series->axis[0].count};
    for (size_t a = 0; a < box->size; a++) {
        view.box[a] = results_series_estimate(results, box, a).value;
    }
    for (size_t a = 0; a < 3 && director && director->size == 3; a++) {
        view.director[a] = results_series_estimate(results, director, a).value;
    }
    const double share = fmin(1.0, PARTICLES_MOST / fmax(1.0, (double)view.particles));
    const double zoom = view.dimension == 2 ? sqrt(share) : cbrt(share);
    for (int a = 0; a < 2; a++) view.window[a] = view.box[a] * zoom;
    if (view.dimension == 3) view.depth = depth_of(&view);
    return view;
}

static int deeper_first(const void *a, const void *b) {
    const double left = ((const PictureBody *)a)->centre[2];
    const double right = ((const PictureBody *)b)->centre[2];
    return (left > right) - (left < right);
}

static bool touches_window(const View *view, const PictureBody *body) {
    for (int a = 0; a < 2; a++) {
        const double reach = picture_body_reach(body, a);
        if (!(body->centre[a] > -reach && body->centre[a] < view->window[a] + reach)) return false;
    }
    return true;
}

// The particle and those of its images that touch the window; only counted if `bodies` is NULL.
static size_t put_images(const View *view, PictureBody body, PictureBody *bodies) {
    size_t count = 0;
    const double x = body.centre[0], y = body.centre[1];
    for (int i = -1; i <= 1; i++) {
        for (int j = -1; j <= 1; j++) {
            body.centre[0] = x + i * view->box[0];
            body.centre[1] = y + j * view->box[1];
            if (!touches_window(view, &body)) continue;
            if (bodies) bodies[count] = body;
            count++;
        }
    }
    return count;
}

static size_t collect(const View *view, PictureBody *bodies) {
    size_t count = 0;
    for (size_t i = 0; i < view->particles; i++) {
        const PictureBody body = body_of(view, i);
        if (!is_drawable(&body)) continue;
        if (view->dimension == 3 && body.centre[2] < view->box[2] - view->depth) continue;
        count += put_images(view, body, bodies ? bodies + count : NULL);
    }
    if (bodies && view->dimension == 3) qsort(bodies, count, sizeof *bodies, deeper_first);
    return count;
}

static bool is_oriented(const View *view) {
    return view->columns == COLUMNS;
}

static double bar_length(double width) { // 1, 2 or 5 times a power of ten, near a fifth
    const double power = pow(10, floor(log10(width / 5)));
    const double times = width / 5 / power;
    return power * (times < 2 ? 1 : times < 5 ? 2 : 5);
}

static void put_scale_bar(Text *page, const View *view, double scale) {
    const double length = bar_length(view->window[0]), y = view->window[1] * scale + 16;
    text_add(page,
             "<path d=\"M0.5,%.1f h%.2f m0,-4 v8 M0.5,%.1f v8\" stroke=\"#222\" fill=\"none\" "
             "stroke-width=\"1.5\"/><text x=\"%.1f\" y=\"%.1f\" font-size=\"15\">%g d</text>\n",
             y, length * scale, y - 4, length * scale + 8, y + 5, length);
}

// What the colours of bodies with an axis mean, at the right of the scale bar.
static void put_colour_bar(Text *page, const View *view, double scale) {
    enum { STEPS = 18 };
    static const double LEFT = 300, STEP = 9;
    const double y = view->window[1] * scale + 11;
    for (int i = 0; i < STEPS; i++) {
        char colour[COLOUR_SIZE];
        picture_tilt_colour(colour, (i + 0.5) / STEPS);
        text_add(page, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"10\" fill=\"%s\"/>\n",
                 LEFT + STEP * i, y, STEP + 0.5, colour);
    }
    text_add(page,
             "<text x=\"%.1f\" y=\"%.1f\" font-size=\"15\" text-anchor=\"end\">axis to "
             "director: 0°</text><text x=\"%.1f\" y=\"%.1f\" font-size=\"15\">90°</text>\n",
             LEFT - 6, y + 10, LEFT + STEP * STEPS + 6, y + 10);
}

void picture_draw(Text *page, const Results *results, const ResultSeries *series) {
    const View view = view_of(results, series);
    const double pixels = WIDTH / view.window[0], height = view.window[1] * pixels;
    const PictureScale scale = {.pixels = pixels,
                                .height = view.window[1],
                                .flat = view.dimension == 2,
                                .oriented = is_oriented(&view),
                                .top = view.box[2],
                                .depth = view.depth};
    const size_t count = collect(&view, NULL);
    PictureBody *bodies = NULL;
    if (NEW_ARRAY(bodies, count) != OK) return;
    collect(&view, bodies);
    text_add(page,
             "<svg class=\"picture\" viewBox=\"-2 -2 %.1f %.1f\" "
             "xmlns=\"http://www.w3.org/2000/svg\" role=\"img\"><title>Configuration</title>\n"
             "<svg width=\"%.2f\" height=\"%.2f\" stroke-width=\"%.2f\">\n", // clips to the box
             WIDTH + 4, height + 30, WIDTH, height, fmin(1.0, 0.06 * pixels));
    for (size_t i = 0; i < count; i++) picture_body_draw(page, &bodies[i], &scale);
    text_add(page, "</svg>\n<rect width=\"%.2f\" height=\"%.2f\" fill=\"none\" stroke=\"#222\"/>\n",
             WIDTH, height);
    put_scale_bar(page, &view, pixels);
    if (is_oriented(&view)) put_colour_bar(page, &view, pixels);
    text_put(page, "</svg>\n");
    memory_free(bodies);
}

// The names of the species, where some series has them along an axis.
static const ResultAxis *species_names(const Results *results) {
    for (size_t i = 0; i < results->series_count; i++) {
        for (size_t a = 0; a < results->series[i].axes; a++) {
            const ResultAxis *axis = &results->series[i].axis[a];
            if (axis->labels && strcmp(axis->name, "species") == 0) return axis;
        }
    }
    return NULL;
}

static size_t species_count(const View *view) {
    size_t count = 0;
    for (size_t i = 0; i < view->particles; i++) {
        if (species(view, i) >= count) count = species(view, i) + 1;
    }
    return count;
}

static void put_legend(Text *page, const View *view) {
    const ResultAxis *names = species_names(view->results);
    const size_t count = species_count(view);
    for (size_t s = 0; s < count && count > 1; s++) {
        text_add(page, "<span class=\"chip\" style=\"background:%s\"></span>",
                 PALETTE[s % PALETTE_SIZE]);
        if (names && s < names->count)
            html_words(page, names->labels[s]);
        else
            text_add(page, "species %zu", s + 1);
        text_put(page, s + 1 < count ? ", " : ": ");
    }
}

void picture_caption(Text *page, const Results *results, const ResultSeries *series) {
    const View view = view_of(results, series);
    if (!is_oriented(&view)) put_legend(page, &view);
    text_add(page, "%zu particles of one replica in the periodic box of %.4g × %.4g",
             view.particles, view.box[0], view.box[1]);
    if (view.dimension == 3) text_add(page, " × %.4g", view.box[2]);
    text_put(page, " d, to scale.");
    if (view.dimension == 3) {
        text_add(page, " Seen along z: the uppermost %.2g d, deeper ones paler.", view.depth);
    }
    if (is_oriented(&view)) {
        text_put(page, " Colours: the angle between a body's axis and the director of this "
                       "configuration; without order the director is arbitrary.");
    }
    if (view.window[0] < view.box[0]) text_put(page, " A corner of the box is shown.");
}
