// SPDX-License-Identifier: GPL-3.0-or-later
// Files and folders that say what went wrong: every call that can fail tells the path and the
// reason. Interrupted and short transfers are carried on. Internal to the store.
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

typedef struct Folder {
    int descriptor;
    char *path;
} Folder;

// An existing folder, or one made here (and then durable). `parent` NULL: from where we stand.
Status disk_folder_open(Folder *folder, const Folder *parent, const char *name, bool make);
void disk_folder_close(Folder *folder);
Status disk_folder_sync(const Folder *folder);

// Something of this name is there.
bool disk_has(const Folder *folder, const char *name);

Status disk_write(int file, const void *bytes, size_t size, off_t offset, const char *path);
Status disk_append(int file, const void *bytes, size_t size, const char *path);
// BAD_DATA if the file ends before.
Status disk_read(int file, void *bytes, size_t size, off_t offset, const char *path);
Status disk_sync(int file, const char *path); // its contents and size
Status disk_close(int file, const char *path);
Status disk_size(int file, size_t *size, const char *path);

// "FOLDER/NAME", yours to free(); NULL with a sentence if memory is out.
char *disk_path(const Folder *folder, const char *name);

// An existing file; -1 in `file` if there is none. `folder` NULL: `name` is any path of the user's.
Status disk_open(const Folder *folder, const char *name, int flags, int *file);

// A new file under a temporary name, to be given its own by disk_publish.
Status disk_create(const Folder *folder, const char *name, int *file);
// Gives what is called `name` another name, in place of what had it, and syncs the folder.
Status disk_rename(const Folder *folder, const char *name, const char *other);
// Syncs and closes the file, gives it its name in place of what had it, and syncs the folder.
Status disk_publish(const Folder *folder, const char *name, int file);
void disk_discard(const Folder *folder, const char *name, int file);

// A whole file, whole or not at all.
Status disk_replace(const Folder *folder, const char *name, const void *bytes, size_t size);
// All its bytes and a '\0', yours to free(); NULL if there is no such file. `folder` as above.
Status disk_load(const Folder *folder, const char *name, void **bytes, size_t *size);
