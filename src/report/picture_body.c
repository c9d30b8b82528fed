// SPDX-License-Identifier: GPL-3.0-or-later
// Draws one particle as SVG.
#include "report/picture_body.h"

#include "base/constants.h"
#include "report/palette.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// Light comes from the upper left. Sizes of a highlight and its place, in radii.
static const double LIGHT_ASIDE = 0.3, LIGHT_SIZE = 0.4;

bool picture_body_has_axis(const PictureBody *body) {
    return body->axis[0] != 0 || body->axis[1] != 0 || body->axis[2] != 0;
}

static bool is_rod(const PictureBody *body) {
    return body->length > 0;
}

static bool is_platelet(const PictureBody *body) {
    return picture_body_has_axis(body) && !is_rod(body);
}

double picture_body_reach(const PictureBody *body, int axis) {
    const double along = body->axis[axis];
    if (is_platelet(body)) return body->radius * sqrt(fmax(0, 1 - along * along));
    return body->radius + body->length / 2 * fabs(along);
}

double picture_body_shadow(const PictureBody *body) {
    const double up = body->axis[2], disc = PI * body->radius * body->radius;
    if (is_platelet(body)) return disc * fabs(up);
    return disc + 2 * body->radius * body->length * sqrt(fmax(0, 1 - up * up));
}

static unsigned between(unsigned from, unsigned to, double share) {
    return (unsigned)(from + ((double)to - from) * share + 0.5);
}

static void mix(char out[COLOUR_SIZE], const char *from, const char *to, double share) {
    const unsigned a = (unsigned)strtoul(from + 1, NULL, 16);
    const unsigned b = (unsigned)strtoul(to + 1, NULL, 16);
    snprintf(out, COLOUR_SIZE, "#%02x%02x%02x", between(a >> 16, b >> 16, share) & 0xff,
             between(a >> 8 & 0xff, b >> 8 & 0xff, share) & 0xff,
             between(a & 0xff, b & 0xff, share) & 0xff);
}

// Even steps for any colour vision, after viridis (van der Walt and Smith, 2015).
void picture_tilt_colour(char colour[COLOUR_SIZE], double tilt) {
    enum { STOPS = 5 };
    static const char *const stops[STOPS] = {"#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"};
    const double place = fmin(1, fmax(0, tilt)) * (STOPS - 1);
    const int below = place >= STOPS - 1 ? STOPS - 2 : (int)place;
    mix(colour, stops[below], stops[below + 1], place - below);
}

static void own_colour(char colour[COLOUR_SIZE], const PictureBody *body, bool oriented) {
    if (picture_body_has_axis(body))
        picture_tilt_colour(colour, body->tilt);
    else
        snprintf(colour, COLOUR_SIZE, "%s",
                 oriented ? "#888888" : PALETTE[body->species % PALETTE_SIZE]);
}

typedef struct Paint {
    char fill[COLOUR_SIZE], edge[COLOUR_SIZE];
} Paint;

static Paint paint_of(const PictureBody *body, const PictureScale *scale) {
    Paint paint;
    char colour[COLOUR_SIZE];
    own_colour(colour, body, scale->oriented);
    const double below = fmin(1, fmax(0, (scale->top - body->centre[2]) / scale->depth));
    const double pale = scale->flat       ? 0.45
                        : scale->oriented ? 0.1 + 0.7 * below
                                          : 0.25 + 0.6 * below;
    mix(paint.fill, colour, "#ffffff", pale);
    if (scale->oriented)
        mix(paint.edge, paint.fill, "#000000", 0.45);
    else
        mix(paint.edge, colour, "#ffffff", scale->flat ? 0 : fmax(0, pale - 0.4));
    return paint;
}

typedef struct Pixel {
    double x, y;
} Pixel;

static Pixel pixel(const PictureBody *body, const PictureScale *scale) {
    return (Pixel){body->centre[0] * scale->pixels,
                   (scale->height - body->centre[1]) * scale->pixels};
}

static void draw_ball(Text *page, const PictureBody *body, const PictureScale *scale) {
    const Paint paint = paint_of(body, scale);
    const Pixel at = pixel(body, scale);
    const double radius = body->radius * scale->pixels;
    text_add(page, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"%s\" stroke=\"%s\"/>\n", at.x,
             at.y, radius, paint.fill, paint.edge);
    if (scale->flat) return;
    text_add(page,
             "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"#fff\" fill-opacity=\"0.3\" "
             "stroke=\"none\"/>\n",
             at.x - LIGHT_ASIDE * radius, at.y - LIGHT_ASIDE * radius, LIGHT_SIZE * radius);
}

// A line with round ends is just what a spherocylinder looks like from afar.
static void draw_line(Text *page, Pixel middle, Pixel half, double width, const char *stroke) {
    text_add(page,
             "<path d=\"M%.2f %.2fl%.2f %.2f\" stroke-width=\"%.2f\" stroke-linecap=\"round\" "
             "stroke=\"%s\"/>\n",
             middle.x - half.x, middle.y - half.y, 2 * half.x, 2 * half.y, width, stroke);
}

static void draw_rod(Text *page, const PictureBody *body, const PictureScale *scale) {
    const Paint paint = paint_of(body, scale);
    const Pixel at = pixel(body, scale);
    const double width = 2 * body->radius * scale->pixels, edge = fmin(2, 0.15 * width);
    const double half = body->length / 2 * scale->pixels;
    const Pixel along = {half * body->axis[0], -half * body->axis[1]};
    draw_line(page, at, along, width, paint.edge);
    draw_line(page, at, along, width - edge, paint.fill);
    const double aside = LIGHT_ASIDE * width / 2;
    draw_line(page, (Pixel){at.x - aside, at.y - aside}, along, LIGHT_SIZE * width,
              "#fff\" stroke-opacity=\"0.3");
}

static void draw_platelet(Text *page, const PictureBody *body, const PictureScale *scale) {
    const Paint paint = paint_of(body, scale);
    const Pixel at = pixel(body, scale);
    const double radius = body->radius * scale->pixels;
    text_add(page,
             "<ellipse transform=\"translate(%.2f,%.2f) rotate(%.1f)\" rx=\"%.2f\" ry=\"%.2f\" "
             "fill=\"%s\" stroke=\"%s\"/>\n",
             at.x, at.y, -atan2(body->axis[1], body->axis[0]) * 180 / PI,
             radius * fabs(body->axis[2]), radius, paint.fill, paint.edge);
}

void picture_body_draw(Text *page, const PictureBody *body, const PictureScale *scale) {
    if (is_rod(body))
        draw_rod(page, body, scale);
    else if (is_platelet(body))
        draw_platelet(page, body, scale);
    else
        draw_ball(page, body, scale);
}
