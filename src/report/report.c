// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the page together: numbers, figures, pictures of configurations, health, provenance.
#include "report/report.h"

#include "report/figure.h"
#include "report/files.h"
#include "report/html.h"
#include "report/page.h"
#include "report/picture.h"

#include <errno.h>
#include <stdio.h>
#include <sys/stat.h>

typedef struct Report {
    const Results *results;
    const char *figures; // folder
    Text page;
    Status status;       // of the first figure that could not be drawn
    char sentence[1024]; // and why
} Report;

static void keep_failure(Report *report, Status status) {
    if (status == OK || report->status != OK) return;
    report->status = status;
    snprintf(report->sentence, sizeof report->sentence, "%s", status_sentence());
}

static void heading(Report *report, const char *title, const char *stage) {
    text_put(&report->page, "<h3>");
    html_words(&report->page, title);
    text_put(&report->page, " <small>(stage ");
    html_words(&report->page, stage);
    text_put(&report->page, ")</small></h3>\n");
}

static void caption_of_figure(Report *report, const Figure *figure) {
    Text caption = {0};
    figure_caption(&caption, figure);
    html_words(&report->page, text_words(&caption));
    text_free(&caption);
}

static void put_figure(Report *report, const ResultSeries *series) {
    const Figure figure = figure_of(report->results, series);
    Text title = {0};
    figure_title(&title, &figure);
    text_put(&report->page, "<figure>");
    heading(report, text_words(&title), series->stage);
    text_free(&title);
    const Status status = figure_draw(&report->page, &figure, report->figures);
    keep_failure(report, status);
    if (status != OK) {
        text_put(&report->page, "<p class=\"verdict bad\">No figure: ");
        html_words(&report->page, status_sentence());
        text_put(&report->page, "</p>");
    }
    text_put(&report->page, "<figcaption>");
    caption_of_figure(report, &figure);
    text_put(&report->page, "</figcaption></figure>\n");
}

static void put_picture(Report *report, const ResultSeries *series) {
    text_put(&report->page, "<figure>");
    heading(report, "Configuration", series->stage);
    picture_draw(&report->page, report->results, series);
    text_put(&report->page, "<figcaption>");
    picture_caption(&report->page, report->results, series);
    text_put(&report->page, "</figcaption></figure>\n");
}

static void put_pictures(Report *report) {
    for (size_t i = 0; i < report->results->series_count; i++) {
        const ResultSeries *series = &report->results->series[i];
        if (picture_exists(report->results, series)) put_picture(report, series);
    }
}

static void put_figures_of(Report *report, const FigureKind *kind) {
    for (size_t i = 0; i < report->results->series_count; i++) {
        const ResultSeries *series = &report->results->series[i];
        if (figure_kind_of(series) != kind || picture_uses(series)) continue;
        if (figure_exists(report->results, series)) put_figure(report, series);
    }
}

// The kinds in the order of their table, each for all stages; then what has no kind.
static void put_figures(Report *report) {
    text_put(&report->page, "<h2>Figures</h2>\n<div class=\"figures\">\n");
    put_pictures(report);
    for (size_t row = 0; figure_kind(row); row++) put_figures_of(report, figure_kind(row));
    put_figures_of(report, NULL);
    text_put(&report->page, "</div>\n");
}

static Status make_folder(const char *path) {
    if (mkdir(path, 0777) == 0 || errno == EEXIST) return OK;
    return status_fail_errno(IO_FAILED, "cannot make %s", path);
}

static Status write_page(Report *report, const char *path) {
    page_begin(&report->page, report->results);
    page_numbers(&report->page, report->results);
    keep_failure(report, make_folder(report->figures));
    put_figures(report);
    page_health(&report->page, report->results);
    page_provenance(&report->page, report->results);
    page_end(&report->page);
    TRY(text_status(&report->page));
    TRY(file_replace(path, text_words(&report->page)));
    if (report->status == OK) return OK;
    return status_fail(report->status, "%s lacks figures: %s", path, report->sentence);
}

Status report_write(const Results *results, const char *directory) {
    Text figures = {0}, path = {0};
    text_add(&figures, "%s/figures", directory);
    text_add(&path, "%s/report.html", directory);
    Status status = text_status(&figures) == OK ? text_status(&path) : text_status(&figures);
    if (status == OK) {
        Report report = {.results = results, .figures = text_words(&figures)};
        status = write_page(&report, text_words(&path));
        text_free(&report.page);
    }
    text_free(&path);
    text_free(&figures);
    return status;
}
