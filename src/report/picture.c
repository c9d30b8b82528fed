// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the snapshot observable. Discs: all of them, with their periodic images at the borders.
// Spheres: seen along z, the far ones first and paler, down to a few diameters below the surface.
#include "report/picture.h"

#include "base/memory.h"
#include "report/html.h"
#include "report/palette.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { X, Y, Z, DIAMETER, SPECIES, COLUMNS }; // of the snapshot
enum { PARTICLES_MOST = 6000 };               // of a page that is still quick to open
static const double DEPTH = 4.0;              // of spheres, in d: what lies below is hidden
static const double WIDTH = 560.0;            // of the picture, in pixels

typedef struct View {
    const Results *results;
    const ResultSeries *series;
    int dimension;
    double box[3];    // in d
    double window[2]; // the part that is drawn, from the origin, in d
    size_t particles; // in the snapshot
} View;

bool picture_uses(const ResultSeries *series) {
    return strcmp(series->observable, "snapshot") == 0 ||
           strcmp(series->observable, "snapshot_box") == 0;
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
    return series->axis[1].count == COLUMNS;
}

static double number(const View *view, size_t particle, int column) {
    const size_t element = particle * COLUMNS + (size_t)column;
    return results_series_estimate(view->results, view->series, element).value;
}

static size_t species(const View *view, size_t particle) {
    const double index = number(view, particle, SPECIES);
    return index >= 0 && index < 256 ? (size_t)index : 0;
}

static View view_of(const Results *results, const ResultSeries *series) {
    const ResultSeries *box = results_find_series(results, series->stage, "snapshot_box");
    View view = {.results = results, .series = series, .dimension = (int)box->size};
    for (size_t a = 0; a < box->size; a++) {
        view.box[a] = results_series_estimate(results, box, a).value;
    }
    view.particles = series->axis[0].count;
    const double share = fmin(1.0, PARTICLES_MOST / fmax(1.0, (double)view.particles));
    const double zoom = view.dimension == 2 ? sqrt(share) : cbrt(share);
    for (int a = 0; a < 2; a++) view.window[a] = view.box[a] * zoom;
    return view;
}

typedef struct Disc {
    double x, y, z, radius;
    size_t species;
} Disc;

static int deeper_first(const void *a, const void *b) {
    const double left = ((const Disc *)a)->z, right = ((const Disc *)b)->z;
    return (left > right) - (left < right);
}

static bool touches_window(const View *view, const Disc *disc) {
    return disc->x > -disc->radius && disc->x < view->window[0] + disc->radius &&
           disc->y > -disc->radius && disc->y < view->window[1] + disc->radius;
}

// The particle and those of its images that touch the window; only counted if `discs` is NULL.
static size_t put_images(const View *view, Disc disc, Disc *discs) {
    size_t count = 0;
    const double x = disc.x, y = disc.y;
    for (int i = -1; i <= 1; i++) {
        for (int j = -1; j <= 1; j++) {
            disc.x = x + i * view->box[0];
            disc.y = y + j * view->box[1];
            if (!touches_window(view, &disc)) continue;
            if (discs) discs[count] = disc;
            count++;
        }
    }
    return count;
}

static size_t collect(const View *view, Disc *discs) {
    size_t count = 0;
    for (size_t i = 0; i < view->particles; i++) {
        const Disc disc = {.x = number(view, i, X),
                           .y = number(view, i, Y),
                           .z = number(view, i, Z),
                           .radius = number(view, i, DIAMETER) / 2,
                           .species = species(view, i)};
        if (!isfinite(disc.x + disc.y + disc.z) || !is_length(disc.radius)) continue;
        if (view->dimension == 3 && disc.z < view->box[2] - DEPTH) continue;
        count += put_images(view, disc, discs ? discs + count : NULL);
    }
    if (discs && view->dimension == 3) qsort(discs, count, sizeof *discs, deeper_first);
    return count;
}

static unsigned mixed(unsigned channel, double with_white) {
    return (unsigned)(channel + (255 - channel) * with_white + 0.5);
}

static void put_colour(Text *page, const char *colour, double with_white) {
    const unsigned rgb = (unsigned)strtoul(colour + 1, NULL, 16);
    text_add(page, "#%02x%02x%02x", mixed(rgb >> 16, with_white),
             mixed(rgb >> 8 & 0xff, with_white), mixed(rgb & 0xff, with_white));
}

static void put_highlight(Text *page, const View *view, const Disc *disc, double scale) {
    static const double ASIDE = 0.3, SIZE = 0.4; // in radii, towards the light
    text_add(page,
             "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"#fff\" fill-opacity=\"0.3\" "
             "stroke=\"none\"/>\n",
             (disc->x - ASIDE * disc->radius) * scale,
             (view->window[1] - disc->y - ASIDE * disc->radius) * scale,
             SIZE * disc->radius * scale);
}

static void put_disc(Text *page, const View *view, const Disc *disc, double scale) {
    const char *colour = PALETTE[disc->species % PALETTE_SIZE];
    const double below = (view->box[2] - disc->z) / DEPTH; // 0 at the surface, 1 at the bottom
    const double pale = view->dimension == 3 ? 0.25 + 0.6 * fmin(1, fmax(0, below)) : 0.45;
    text_add(page, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"", disc->x * scale,
             (view->window[1] - disc->y) * scale, disc->radius * scale);
    put_colour(page, colour, pale);
    text_put(page, "\" stroke=\"");
    put_colour(page, colour, view->dimension == 3 ? fmax(0, pale - 0.4) : 0.0);
    text_put(page, "\"/>\n");
    if (view->dimension == 3) put_highlight(page, view, disc, scale);
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

void picture_draw(Text *page, const Results *results, const ResultSeries *series) {
    const View view = view_of(results, series);
    const double scale = WIDTH / view.window[0], height = view.window[1] * scale;
    const size_t count = collect(&view, NULL);
    Disc *discs = NULL;
    if (NEW_ARRAY(discs, count) != OK) return;
    collect(&view, discs);
    text_add(page,
             "<svg class=\"picture\" viewBox=\"-2 -2 %.1f %.1f\" "
             "xmlns=\"http://www.w3.org/2000/svg\" role=\"img\"><title>Configuration</title>\n"
             "<svg width=\"%.2f\" height=\"%.2f\" stroke-width=\"%.2f\">\n", // clips to the box
             WIDTH + 4, height + 30, WIDTH, height, fmin(1.0, 0.06 * scale));
    for (size_t i = 0; i < count; i++) put_disc(page, &view, &discs[i], scale);
    text_add(page, "</svg>\n<rect width=\"%.2f\" height=\"%.2f\" fill=\"none\" stroke=\"#222\"/>\n",
             WIDTH, height);
    put_scale_bar(page, &view, scale);
    text_put(page, "</svg>\n");
    memory_free(discs);
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
    put_legend(page, &view);
    text_add(page, "%zu particles of one replica in the periodic box of %.4g × %.4g",
             view.particles, view.box[0], view.box[1]);
    if (view.dimension == 3) text_add(page, " × %.4g", view.box[2]);
    text_put(page, " d, to scale.");
    if (view.dimension == 3) {
        text_add(page, " Seen along z: the uppermost %g d, deeper spheres paler.", DEPTH);
    }
    if (view.window[0] < view.box[0]) text_put(page, " A corner of the box is shown.");
}
