// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a figure's files, has it drawn, and takes the picture into the page.
#include "report/figure.h"

#include "report/files.h"
#include "report/gnuplot.h"

#include <stdio.h>
#include <string.h>

static Status write_part(const Figure *figure, const char *folder, const char *ending,
                         void (*part)(Text *, const Figure *)) {
    Text path = {0}, words = {0};
    text_add(&path, "%s/%s.%s", folder, figure->name, ending);
    part(&words, figure);
    Status status = text_status(&path) == OK ? text_status(&words) : text_status(&path);
    if (status == OK) status = file_replace(text_words(&path), text_words(&words));
    text_free(&words);
    text_free(&path);
    return status;
}

// Several pictures stand in one page: their ids, and what refers to them, get the figure's name.
static const char *const ID_BEFORE[] = {"id='", "id=\"", "href='#", "href=\"#", "url(#"};

static size_t id_begins(const char *svg) { // after so many characters; 0 if none does here
    for (size_t i = 0; i < sizeof ID_BEFORE / sizeof *ID_BEFORE; i++) {
        const size_t length = strlen(ID_BEFORE[i]);
        if (strncmp(svg, ID_BEFORE[i], length) == 0) return length;
    }
    return 0;
}

static void put_picture(Text *page, const char *svg, const char *name) {
    const char *begin = strstr(svg, "<svg"); // what stands before is for files, not for pages
    for (const char *c = begin ? begin : svg; *c;) {
        const size_t before = id_begins(c);
        text_bytes(page, c, before ? before : 1);
        if (before) text_add(page, "%s-", name);
        c += before ? before : 1;
    }
}

static Status take_picture(Text *page, const Figure *figure, const char *folder) {
    Text path = {0}, svg = {0};
    text_add(&path, "%s/%s.svg", folder, figure->name);
    Status status = text_status(&path);
    if (status == OK) status = file_read(&svg, text_words(&path));
    if (status == OK) put_picture(page, text_words(&svg), figure->name);
    text_free(&svg);
    text_free(&path);
    return status;
}

Status figure_draw(Text *page, const Figure *figure, const char *folder) {
    char script[FIGURE_NAME + 4];
    snprintf(script, sizeof script, "%s.gp", figure->name);
    TRY(write_part(figure, folder, "csv", figure->y ? figure_map_numbers : figure_numbers));
    TRY(write_part(figure, folder, "gp", figure->y ? figure_map_script : figure_script));
    TRY(gnuplot_run(folder, script));
    return take_picture(page, figure, folder);
}
