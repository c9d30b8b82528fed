// SPDX-License-Identifier: GPL-3.0-or-later
// One particle of a picture, as it is seen along z: a disc, a ball, a rod or an infinitely thin
// platelet. Inside report/ only.
#pragma once

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

enum { COLOUR_SIZE = 8 };

typedef struct PictureBody {
    double centre[3];
    double radius, length; // in d; the length of the cylinder of a rod
    double axis[3];        // 0 for what has none
    size_t species;
    double tilt; // angle between its axis and the director over a right angle, 0 to 1
} PictureBody;

// From d to pixels. Bodies `top` high are seen in full colour, those `depth` below almost white.
typedef struct PictureScale {
    double pixels; // per d
    double height; // of the picture, in d: y points up, rows of pixels down
    bool flat;     // discs in 2D
    bool oriented; // bodies with an axis are coloured by it, others grey
    double top, depth;
} PictureScale;

bool picture_body_has_axis(const PictureBody *body);
double picture_body_reach(const PictureBody *body, int axis); // from the centre, along x or y, in d
double picture_body_shadow(const PictureBody *body);          // the area that it hides, in d^2

void picture_body_draw(Text *page, const PictureBody *body, const PictureScale *scale);

// Of an axis at this tilt: from the dark end, along the director, to the bright one, across.
void picture_tilt_colour(char colour[COLOUR_SIZE], double tilt);
