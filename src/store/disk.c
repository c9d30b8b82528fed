// SPDX-License-Identifier: GPL-3.0-or-later
// POSIX files with sentences. A new file becomes visible under its name only when its bytes are
// on the disk: temporary name, fsync, rename, fsync of the folder. After a failed fsync the file
// is given up, never synced again: the kernel may have dropped the pages that it could not write.
#include "store/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char *join(const char *folder, const char *middle, const char *name) {
    const size_t size = strlen(folder) + strlen(middle) + strlen(name) + 1;
    char *path = malloc(size);
    if (!path) {
        status_fail(NO_MEMORY, "out of memory: the path of '%s'", name);
        return NULL;
    }
    snprintf(path, size, "%s%s%s", folder, middle, name);
    return path;
}

char *disk_path(const Folder *folder, const char *name) {
    return folder ? join(folder->path, "/", name) : join(name, "", "");
}

static char *temporary(const char *name) {
    return join(name, ".new", "");
}

// Fails with the path of NAME in the folder and the reason in errno.
static Status fail_at(const Folder *folder, const char *name, const char *what) {
    return status_fail_errno(IO_FAILED, "cannot %s '%s/%s'", what, folder->path, name);
}

Status disk_sync(int file, const char *path) {
    int result;
    do result = fsync(file);
    while (result != 0 && errno == EINTR);
    if (result == 0) return OK;
    return status_fail_errno(IO_FAILED, "cannot bring '%s' to the disk", path);
}

Status disk_close(int file, const char *path) {
    // On Linux the descriptor is gone even when close() is interrupted: never close it again.
    if (close(file) == 0 || errno == EINTR) return OK;
    return status_fail_errno(IO_FAILED, "cannot close '%s'", path);
}

Status disk_write(int file, const void *bytes, size_t size, off_t offset, const char *path) {
    const char *next = bytes;
    while (size > 0) {
        const ssize_t written = pwrite(file, next, size, offset);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = ENOSPC;
        if (written <= 0) return status_fail_errno(IO_FAILED, "cannot write '%s'", path);
        next += written;
        offset += written;
        size -= (size_t)written;
    }
    return OK;
}

Status disk_append(int file, const void *bytes, size_t size, const char *path) {
    const char *next = bytes;
    while (size > 0) {
        const ssize_t written = write(file, next, size);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = ENOSPC;
        if (written <= 0) return status_fail_errno(IO_FAILED, "cannot write '%s'", path);
        next += written;
        size -= (size_t)written;
    }
    return OK;
}

Status disk_read(int file, void *bytes, size_t size, off_t offset, const char *path) {
    char *next = bytes;
    while (size > 0) {
        const ssize_t got = pread(file, next, size, offset);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return status_fail_errno(IO_FAILED, "cannot read '%s'", path);
        if (got == 0) return status_fail(BAD_DATA, "'%s' ends too early: it was cut off", path);
        next += got;
        offset += got;
        size -= (size_t)got;
    }
    return OK;
}

Status disk_size(int file, size_t *size, const char *path) {
    struct stat about;
    if (fstat(file, &about) != 0) {
        return status_fail_errno(IO_FAILED, "cannot look at '%s'", path);
    }
    if (!S_ISREG(about.st_mode)) return status_fail(BAD_DATA, "'%s' is not an ordinary file", path);
    *size = (size_t)about.st_size;
    return OK;
}

// The folder in which `name` was made: the new entry must survive a loss of power too.
static Status sync_parent(const Folder *parent, const char *name) {
    if (parent) return disk_folder_sync(parent);
    char *above = join(name, "/..", "");
    if (!above) return NO_MEMORY;
    const int descriptor = open(above, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    Status status = OK;
    if (descriptor < 0) status = status_fail_errno(IO_FAILED, "cannot open '%s'", above);
    if (status == OK) status = disk_sync(descriptor, above);
    if (descriptor >= 0) close(descriptor);
    free(above);
    return status;
}

Status disk_folder_open(Folder *folder, const Folder *parent, const char *name, bool make) {
    const int from = parent ? parent->descriptor : AT_FDCWD;
    char *path = parent ? disk_path(parent, name) : join(name, "", "");
    if (!path) return NO_MEMORY;
    Status status = OK;
    const bool made = make && mkdirat(from, name, 0777) == 0;
    if (make && !made && errno != EEXIST) {
        status = status_fail_errno(IO_FAILED, "cannot make the directory '%s'", path);
    }
    if (made) status = sync_parent(parent, name);
    int descriptor = -1;
    if (status == OK) {
        descriptor = openat(from, name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) status = status_fail_errno(IO_FAILED, "cannot open '%s'", path);
    }
    if (status != OK) {
        free(path);
        return status;
    }
    *folder = (Folder){.descriptor = descriptor, .path = path};
    return OK;
}

void disk_folder_close(Folder *folder) {
    if (!folder->path) return;
    close(folder->descriptor);
    free(folder->path);
    *folder = (Folder){.descriptor = -1};
}

Status disk_folder_sync(const Folder *folder) {
    return disk_sync(folder->descriptor, folder->path);
}

bool disk_has(const Folder *folder, const char *name) {
    struct stat about;
    return fstatat(folder->descriptor, name, &about, AT_SYMLINK_NOFOLLOW) == 0;
}

Status disk_open(const Folder *folder, const char *name, int flags, int *file) {
    // O_NONBLOCK: a FIFO laid in our way must not make us wait. In our own folders links are not
    // followed; a path that the user gives may lead through them.
    const int safe = O_CLOEXEC | O_NONBLOCK | (folder ? O_NOFOLLOW : 0);
    *file = openat(folder ? folder->descriptor : AT_FDCWD, name, flags | safe);
    if (*file >= 0 || errno == ENOENT) return OK;
    if (folder) return fail_at(folder, name, "open");
    return status_fail_errno(IO_FAILED, "cannot open '%s'", name);
}

Status disk_create(const Folder *folder, const char *name, int *file) {
    char *fresh = temporary(name);
    if (!fresh) return NO_MEMORY;
    Status status = OK;
    // What a killed run left under the temporary name; the lock says that nobody else has it.
    if (unlinkat(folder->descriptor, fresh, 0) != 0 && errno != ENOENT) {
        status = fail_at(folder, fresh, "remove");
    }
    if (status == OK) {
        *file = openat(folder->descriptor, fresh,
                       O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (*file < 0) status = fail_at(folder, fresh, "create");
    }
    free(fresh);
    return status;
}

void disk_discard(const Folder *folder, const char *name, int file) {
    char *fresh = temporary(name);
    if (fresh) unlinkat(folder->descriptor, fresh, 0);
    free(fresh);
    if (file >= 0) close(file);
}

Status disk_rename(const Folder *folder, const char *name, const char *other) {
    int result;
    do result = renameat(folder->descriptor, name, folder->descriptor, other);
    while (result != 0 && errno == EINTR);
    return result == 0 ? disk_folder_sync(folder) : fail_at(folder, other, "give its name to");
}

static Status give_name(const Folder *folder, const char *name) {
    char *fresh = temporary(name);
    if (!fresh) return NO_MEMORY;
    const Status status = disk_rename(folder, fresh, name);
    if (status != OK) unlinkat(folder->descriptor, fresh, 0); // or is gone with the new name
    free(fresh);
    return status;
}

Status disk_publish(const Folder *folder, const char *name, int file) {
    char *path = disk_path(folder, name);
    Status status = path ? disk_sync(file, path) : NO_MEMORY;
    if (status == OK) {
        status = disk_close(file, path);
        file = -1;
    }
    free(path);
    if (status == OK) return give_name(folder, name);
    disk_discard(folder, name, file);
    return status;
}

Status disk_replace(const Folder *folder, const char *name, const void *bytes, size_t size) {
    int file;
    TRY(disk_create(folder, name, &file));
    char *path = disk_path(folder, name);
    const Status status = path ? disk_write(file, bytes, size, 0, path) : NO_MEMORY;
    free(path);
    if (status == OK) return disk_publish(folder, name, file);
    disk_discard(folder, name, file);
    return status;
}

static Status load_open(int file, void **bytes, size_t *size, const char *path) {
    TRY(disk_size(file, size, path));
    char *room = malloc(*size + 1);
    if (!room) return status_fail(NO_MEMORY, "out of memory: %zu bytes of '%s'", *size, path);
    const Status status = disk_read(file, room, *size, 0, path);
    room[*size] = '\0';
    *bytes = room;
    if (status == OK) return OK;
    free(room);
    *bytes = NULL;
    return status;
}

Status disk_load(const Folder *folder, const char *name, void **bytes, size_t *size) {
    *bytes = NULL;
    *size = 0;
    int file;
    TRY(disk_open(folder, name, O_RDONLY, &file));
    if (file < 0) return OK;
    char *path = disk_path(folder, name);
    const Status status = path ? load_open(file, bytes, size, path) : NO_MEMORY;
    free(path);
    close(file);
    return status;
}
