// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the points of a gallery entry and draws its figure.
#include "gallery.h"

#include "command.h"
#include "runner.h"

#include "base/memory.h"
#include "base/text.h"
#include "config/config.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// KEY=VALUE words between blanks and line ends; lines that begin with '#' are comments.
static Status split_settings(char *text, const char **settings, size_t *count) {
    for (char *line = text; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        if (*line == '#') memset(line, ' ', strcspn(line, "\n"));
    }
    char *rest = NULL;
    for (char *word = strtok_r(text, " \n", &rest); word; word = strtok_r(NULL, " \n", &rest)) {
        if (*count == GIVEN_MOST) {
            return status_fail(BAD_DATA, "more than %d settings for a point", GIVEN_MOST);
        }
        settings[(*count)++] = word;
    }
    return OK;
}

// {results} in a setting is the folder with the points before it: put in after words are split,
// since it may have blanks.
static Status put_folder(const GalleryRun *run, const char **settings, size_t count,
                         char with_folder[2 * GALLERY_PATH]) {
    static const char MARK[] = "{results}";
    bool taken = false;
    for (size_t i = 0; i < count; i++) {
        const char *mark = strstr(settings[i], MARK);
        if (!mark) continue;
        if (taken) return status_fail(BAD_DATA, "%s stands in two settings of a point", MARK);
        snprintf(with_folder, 2 * GALLERY_PATH, "%.*s%s%s", (int)(mark - settings[i]), settings[i],
                 run->directory, mark + strlen(MARK));
        settings[i] = with_folder;
        taken = true;
    }
    return OK;
}

static Status run_plan(const GalleryRun *run, const char *run_file, const char *point,
                       char *settings_text) {
    char file[GALLERY_PATH], directory[GALLERY_PATH], with_folder[2 * GALLERY_PATH];
    const char *settings[GIVEN_MOST];
    ConfigOverrides overrides = {.settings = settings};
    TRY(gallery_path(file, run->entry, run_file));
    TRY(gallery_path(directory, run->directory, point));
    TRY(split_settings(settings_text, settings, &overrides.count));
    TRY(put_folder(run, settings, overrides.count, with_folder));
    ConfigPoints *points = NULL;
    TRY(config_read_points(&points, file, &overrides));
    const SessionWishes wishes = {.directory = directory, .threads = run->threads};
    const Status status = runner_run(points, &wishes, true);
    config_free_points(points);
    return status;
}

// The settings of the full run come last, so that they win: those of full.txt, which are for
// run.yaml, then those of the point.
static Status run_point(const GalleryRun *run, const Csv *points, size_t row) {
    const char *other = csv_cell(points, row, "run_file");
    char path[GALLERY_PATH];
    char *full = NULL;
    TRY(gallery_path(path, run->entry, "full.txt"));
    if (run->full && other[0] == '\0') TRY(csv_read_text(path, &full));
    Text settings = {0};
    text_add(&settings, "%s\n%s\n%s\n", csv_cell(points, row, "settings"), full ? full : "",
             run->full ? csv_cell(points, row, "full") : "");
    memory_free(full);
    Status status = text_status(&settings);
    if (status == OK)
        status = run_plan(run, other[0] ? other : "run.yaml", csv_cell(points, row, "point"),
                          settings.bytes);
    text_free(&settings);
    return status;
}

// With the folders above it.
static Status make_folder(const char *path) {
    char part[GALLERY_PATH];
    for (size_t end = 1;; end++) {
        if (path[end] != '/' && path[end] != '\0') continue;
        snprintf(part, sizeof part, "%.*s", (int)end, path);
        if (mkdir(part, 0777) != 0 && errno != EEXIST) {
            return status_fail_errno(IO_FAILED, "cannot make the folder %s", part);
        }
        if (path[end] == '\0') return OK;
    }
}

Status gallery_run(const GalleryRun *run) {
    char path[GALLERY_PATH];
    Csv *points = NULL;
    TRY(make_folder(run->directory));
    TRY(gallery_path(path, run->entry, "points.csv"));
    TRY(csv_read(&points, path));
    Status status = OK;
    for (size_t row = 0; row < points->rows && status == OK; row++) {
        fprintf(stderr, "%s: point %zu of %zu\n", csv_cell(points, row, "point"), row + 1,
                points->rows);
        status = run_point(run, points, row);
    }
    csv_free(points);
    return status;
}

static Status copy_text(const char *from_folder, const char *to_folder, const char *name) {
    char from[GALLERY_PATH], to[GALLERY_PATH];
    char *text = NULL;
    TRY(gallery_path(from, from_folder, name));
    TRY(gallery_path(to, to_folder, name));
    TRY(csv_read_text(from, &text));
    FILE *file = fopen(to, "w");
    const bool written = file && fputs(text, file) >= 0;
    memory_free(text);
    if (file && fclose(file) == 0 && written) return OK;
    return status_fail_errno(IO_FAILED, "cannot write %s", to);
}

static Status run_gnuplot(const char *directory) {
    const pid_t child = fork();
    if (child == 0) {
        if (chdir(directory) == 0) execlp("gnuplot", "gnuplot", "figure.gp", (char *)NULL);
        _exit(127);
    }
    int ended = -1;
    if (child > 0 && waitpid(child, &ended, 0) == child && ended == 0) return OK;
    return status_fail(IO_FAILED, "gnuplot could not draw %s/figure.gp", directory);
}

// The script goes beside the numbers, for whoever wants to change the figure.
Status gallery_draw(const GalleryRun *run) {
    char above[GALLERY_PATH];
    TRY(gallery_path(above, run->entry, ".."));
    TRY(copy_text(above, run->directory, "style.gp"));
    TRY(copy_text(run->entry, run->directory, "figure.gp"));
    return run_gnuplot(run->directory);
}
