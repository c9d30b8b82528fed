// SPDX-License-Identifier: GPL-3.0-or-later
// The run directory: lock, plan, texts and log.
#define _GNU_SOURCE // F_OFD_SETLK
#include "store/store.h"

#include "base/memory.h"
#include "store/inside.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

enum { HOLDER_SIZE = 128 };

static pthread_mutex_t hdf5 = PTHREAD_MUTEX_INITIALIZER; // the library has a state of its own

void store_take_hdf5(void) {
    pthread_mutex_lock(&hdf5);
}

void store_give_hdf5(void) {
    pthread_mutex_unlock(&hdf5);
}

// FNV-1a: tells plans apart, guards against mix-ups, not against malice.
static uint64_t plan_hash(const char *text) {
    uint64_t hash = 0xcbf29ce484222325;
    for (; *text; text++) hash = (hash ^ (unsigned char)*text) * 0x100000001b3;
    return hash;
}

// Both kinds of lock: flock() for this machine, the other for file systems that ignore flock().
static bool lock_taken(int lock) {
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    int result;
    do result = flock(lock, LOCK_EX | LOCK_NB);
    while (result != 0 && errno == EINTR);
    if (result != 0) return false;
    // A file system without this kind has done what it could with the first.
    return fcntl(lock, F_OFD_SETLK, &whole) == 0 || (errno != EAGAIN && errno != EACCES);
}

static Status tell_holder(int lock, const char *directory) {
    char holder[HOLDER_SIZE] = "";
    const ssize_t length = pread(lock, holder, sizeof holder - 1, 0);
    if (length <= 0) return status_fail(LOCKED, "'%s' is in use by another process", directory);
    holder[strcspn(holder, "\n")] = '\0';
    return status_fail(LOCKED,
                       "'%s' is in use by another run (%s); wait for it or choose another "
                       "directory with -o",
                       directory, holder);
}

static Status write_holder(int lock, const char *path) {
    char host[HOLDER_SIZE / 2] = "unknown host", holder[HOLDER_SIZE];
    if (gethostname(host, sizeof host) == 0) host[sizeof host - 1] = '\0';
    const int length = snprintf(holder, sizeof holder, "process %ld on %s\n", (long)getpid(), host);
    TRY(disk_write(lock, holder, (size_t)length, 0, path));
    if (ftruncate(lock, length) == 0) return OK;
    return status_fail_errno(IO_FAILED, "cannot write '%s'", path);
}

static Status take_lock(Store *store) {
    const Folder *folder = &store->folder;
    store->lock = openat(folder->descriptor, "perrin.lock",
                         O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (store->lock < 0) {
        return status_fail_errno(IO_FAILED, "cannot open '%s/perrin.lock'", folder->path);
    }
    char *path = disk_path(folder, "perrin.lock");
    size_t size;
    Status status = path ? disk_size(store->lock, &size, path) : NO_MEMORY;
    if (status == OK && !lock_taken(store->lock)) status = tell_holder(store->lock, folder->path);
    if (status == OK) status = write_holder(store->lock, path);
    free(path);
    return status;
}

Status store_open(Store **out, const char *directory) {
    Store *store = NULL;
    TRY(NEW(store));
    store->lock = -1;
    Status status = disk_folder_open(&store->folder, NULL, directory, true);
    if (status == OK) status = take_lock(store);
    if (status != OK) {
        store_close(store);
        return status;
    }
    *out = store;
    return OK;
}

void store_close(Store *store) {
    if (!store) return;
    if (store->lock >= 0) close(store->lock);
    disk_folder_close(&store->folder);
    memory_free(store);
}

const char *store_directory(const Store *store) {
    return store->folder.path;
}

// Something that a run left, without the plan that it came from.
static Status refuse_orphans(const Store *store) {
    static const char *const names[] = {"results.h5", "trajectory", "checkpoint"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!disk_has(&store->folder, names[i])) continue;
        return status_fail(LOCKED,
                           "'%s' holds %s of an unknown plan (no plan.yaml): nothing is "
                           "written over it; choose another directory with -o",
                           store->folder.path, names[i]);
    }
    return OK;
}

static Status tell_difference(const Store *store, const char *there, const char *here) {
    int line = 1;
    for (;; line++) {
        const size_t a = strcspn(there, "\n"), b = strcspn(here, "\n");
        if (a != b || memcmp(there, here, a) != 0) break;
        if (there[a] == '\0' || here[b] == '\0') break;
        there += a + 1;
        here += b + 1;
    }
    there += strspn(there, " ");
    here += strspn(here, " ");
    return status_fail(LOCKED,
                       "'%s' holds a run of another plan: line %d of its plan.yaml is "
                       "'%.*s', here it is '%.*s'; choose another directory with -o",
                       store->folder.path, line, (int)strcspn(there, "\n"), there,
                       (int)strcspn(here, "\n"), here);
}

Status store_take_plan(Store *store, const char *plan, bool *resumes) {
    char *there = NULL;
    TRY(store_read_text(store, "plan.yaml", &there));
    *resumes = there != NULL;
    Status status = OK;
    if (there && strcmp(there, plan) != 0) status = tell_difference(store, there, plan);
    free(there);
    TRY(status);
    store->plan = plan_hash(plan);
    if (*resumes) return OK;
    TRY(refuse_orphans(store));
    return store_write_text(store, "plan.yaml", plan);
}

Status store_write_text(Store *store, const char *name, const char *text) {
    return disk_replace(&store->folder, name, text, strlen(text));
}

Status store_read_text(const Store *store, const char *name, char **text) {
    void *bytes = NULL;
    size_t size;
    TRY(disk_load(&store->folder, name, &bytes, &size));
    *text = bytes;
    return OK;
}

Status store_rename(Store *store, const char *name, const char *other) {
    return disk_rename(&store->folder, name, other);
}

// One write() to a file opened for appending: lines of several threads do not mix.
static Status append_line(const Store *store, const char *line, size_t length) {
    const int log = openat(store->folder.descriptor, "log.txt",
                           O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (log < 0) {
        return status_fail_errno(IO_FAILED, "cannot open '%s/log.txt'", store->folder.path);
    }
    char *path = disk_path(&store->folder, "log.txt");
    Status status = path ? disk_append(log, line, length, path) : NO_MEMORY;
    const Status closed = disk_close(log, path ? path : "log.txt");
    free(path);
    return status == OK ? closed : status;
}

Status store_log(Store *store, const char *format, ...) {
    enum { LINE_SIZE = 1200 };
    char line[LINE_SIZE];
    const time_t now = time(NULL);
    struct tm date;
    size_t length = strftime(line, sizeof line, "%Y-%m-%d %H:%M:%S %z ", localtime_r(&now, &date));
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line + length, sizeof line - length - 1, format, arguments);
    va_end(arguments);
    length = strlen(line);
    line[length++] = '\n';
    return append_line(store, line, length);
}

void store_ignore_signals(void) {
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigaction(SIGXFSZ, &ignore, NULL);
    sigaction(SIGPIPE, &ignore, NULL);
}
