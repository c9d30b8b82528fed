// SPDX-License-Identifier: GPL-3.0-or-later
// The gallery: a folder per figure of the papers; gallery/README.md says what lies in it. Finding,
// listing, running the points of one, holding what comes out against what is expected.
#pragma once

#include "csv.h"

#include <stdbool.h>
#include <stdio.h>

enum { GALLERY_PATH = 1024, GALLERY_ENTRIES = 64, GALLERY_NAME = 64 };

typedef struct Gallery {
    char path[GALLERY_PATH];
    size_t count;
    char names[GALLERY_ENTRIES][GALLERY_NAME]; // in alphabetical order
} Gallery;

// ./gallery, or that which was installed or built with this program.
Status gallery_find(Gallery *gallery);
Status gallery_list(const Gallery *gallery, FILE *out);
Status gallery_entry(const Gallery *gallery, const char *name, char path[GALLERY_PATH]);

// "FOLDER/NAME".
Status gallery_path(char path[GALLERY_PATH], const char *folder, const char *name);

typedef struct GalleryRun {
    char entry[GALLERY_PATH];     // folder
    char directory[GALLERY_PATH]; // where a folder per point and the verdict go
    bool full;                    // the papers' statistics
    int threads;
} GalleryRun;

// Runs, or resumes, every point; those that are finished are not run again.
Status gallery_run(const GalleryRun *run);

// Writes measured.csv, POINT-MEASURE.csv of curves and verdict.csv; prints the verdicts to `out`.
// `missed` of `count` expectations.
Status gallery_judge(const GalleryRun *run, FILE *out, size_t *missed, size_t *count);

// figure.svg, by gnuplot from what gallery_judge wrote.
Status gallery_draw(const GalleryRun *run);
