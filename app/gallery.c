// SPDX-License-Identifier: GPL-3.0-or-later
// Finds and lists the gallery.
#include "gallery.h"

#include "base/memory.h"
#include "base/nearest.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

Status gallery_path(char path[GALLERY_PATH], const char *folder, const char *name) {
    if (snprintf(path, GALLERY_PATH, "%s/%s", folder, name) < GALLERY_PATH) return OK;
    return status_fail(BAD_USAGE, "%s/%s is too long a path", folder, name);
}

// Beside the program: ../gallery of a build folder, ../share/perrin/gallery of an installation.
static bool beside_program(char path[GALLERY_PATH], const char *relative) {
    char program[GALLERY_PATH];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0) return false;
    program[length] = '\0';
    char *slash = strrchr(program, '/');
    if (slash) *slash = '\0';
    return gallery_path(path, program, relative) == OK && is_folder(path);
}

static int by_name(const void *a, const void *b) {
    return strcmp(a, b);
}

static Status read_names(Gallery *gallery) {
    DIR *folder = opendir(gallery->path);
    if (!folder) return status_fail_errno(IO_FAILED, "cannot read %s", gallery->path);
    for (struct dirent *entry; (entry = readdir(folder)) && gallery->count < GALLERY_ENTRIES;) {
        char path[GALLERY_PATH];
        if (entry->d_name[0] == '.' || strlen(entry->d_name) >= GALLERY_NAME) continue;
        if (gallery_path(path, gallery->path, entry->d_name) != OK || !is_folder(path)) continue;
        strcpy(gallery->names[gallery->count++], entry->d_name);
    }
    closedir(folder);
    qsort(gallery->names, gallery->count, sizeof gallery->names[0], by_name);
    return OK;
}

Status gallery_find(Gallery *gallery) {
    *gallery = (Gallery){.path = "gallery"};
    const bool found = is_folder(gallery->path) || beside_program(gallery->path, "../gallery") ||
                       beside_program(gallery->path, "../share/perrin/gallery");
    if (!found) return status_fail(BAD_USAGE, "there is no folder 'gallery' here");
    return read_names(gallery);
}

Status gallery_entry(const Gallery *gallery, const char *name, char path[GALLERY_PATH]) {
    const char *names[GALLERY_ENTRIES];
    for (size_t i = 0; i < gallery->count; i++) {
        names[i] = gallery->names[i];
        if (strcmp(names[i], name) == 0) return gallery_path(path, gallery->path, name);
    }
    const size_t nearest = nearest_word(name, names, gallery->count);
    if (nearest < gallery->count) {
        return status_fail(BAD_USAGE, "the gallery has no '%s'; did you mean '%s'?", name,
                           names[nearest]);
    }
    return status_fail(BAD_USAGE, "the gallery has no '%s'; 'perrin reproduce' lists it", name);
}

// The first heading of the entry's README.
static Status print_title(const char *entry, FILE *out) {
    char path[GALLERY_PATH];
    char *text = NULL;
    TRY(gallery_path(path, entry, "README.md"));
    TRY(csv_read_text(path, &text));
    const char *title = text + strspn(text, "# ");
    fprintf(out, "%.*s\n", (int)strcspn(title, "\n"), title);
    memory_free(text);
    return OK;
}

Status gallery_list(const Gallery *gallery, FILE *out) {
    for (size_t i = 0; i < gallery->count; i++) {
        char path[GALLERY_PATH];
        TRY(gallery_path(path, gallery->path, gallery->names[i]));
        fprintf(out, "%-28s ", gallery->names[i]);
        TRY(print_title(path, out));
    }
    return OK;
}
