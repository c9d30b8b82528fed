// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded into a program (LD_PRELOAD), makes its k-th call on files under a folder fail.
//   FAULT_DIR      only files under this folder count
//   FAULT_AT       which call fails, from 1; 0 or unset: none
//   FAULT_WHAT     EIO, ENOSPC, EDQUOT, EINTR, or SHORT (half of a transfer is done)
//   FAULT_FOREVER  set: that call and all later ones
//   FAULT_COUNT    file to which the number of calls is written at the end
//   FAULT_TRACE    file to which each call is written, with the path it is made on
// mkdirat is traced and does not fail. The others: write, pwrite, fsync, fdatasync, renameat,
// rename, ftruncate, posix_fallocate, and close of files opened for writing. Not the lock: its text
// is for people, and closing it cannot lose.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static atomic_long calls;

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int fault_errno(void) {
    const char *what = getenv("FAULT_WHAT");
    if (!what || strcmp(what, "EIO") == 0) return EIO;
    if (strcmp(what, "ENOSPC") == 0) return ENOSPC;
    if (strcmp(what, "EDQUOT") == 0) return EDQUOT;
    if (strcmp(what, "EINTR") == 0) return EINTR;
    return 0; // SHORT
}

// This call counts, and it is the one to fail.
static bool strikes(void) {
    const long call = atomic_fetch_add(&calls, 1) + 1;
    const char *at = getenv("FAULT_AT");
    const long wanted = at ? atol(at) : 0;
    if (wanted == 0) return false;
    return call == wanted || (call > wanted && getenv("FAULT_FOREVER"));
}

static bool path_of(int file, char path[PATH_MAX]) {
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, path, PATH_MAX - 1);
    if (length < 0) return false;
    path[length] = '\0';
    return true;
}

static void trace(const char *call, const char *path, const char *name) {
    const char *trace = getenv("FAULT_TRACE");
    FILE *file = trace ? fopen(trace, "a") : NULL;
    if (!file) return;
    fprintf(file, "%s %s%s%s\n", call, path, name ? "/" : "", name ? name : "");
    fclose(file);
}

// A call on this file counts; of one in a folder, `name` is the file's.
static bool ours(const char *call, int file, const char *name) {
    const char *folder = getenv("FAULT_DIR");
    char path[PATH_MAX];
    if (!folder || !path_of(file, path) || strstr(path, "/perrin.lock")) return false;
    if (strncmp(path, folder, strlen(folder)) != 0) return false;
    trace(call, path, name);
    return true;
}

static bool written(int file) {
    struct stat about;
    const int flags = fcntl(file, F_GETFL);
    return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY && fstat(file, &about) == 0 &&
           S_ISREG(about.st_mode);
}

// -1 with errno, or 0 when the transfer is only to be shortened.
static int fault(void) {
    const int reason = fault_errno();
    errno = reason;
    return reason ? -1 : 0;
}

ssize_t write(int file, const void *bytes, size_t size) {
    const bool struck = ours("write", file, NULL) && strikes();
    if (struck && fault() < 0) return -1;
    return REAL(write)(file, bytes, struck ? (size + 1) / 2 : size);
}

ssize_t pwrite(int file, const void *bytes, size_t size, off_t place) {
    const bool struck = ours("write", file, NULL) && strikes();
    if (struck && fault() < 0) return -1;
    return REAL(pwrite)(file, bytes, struck ? (size + 1) / 2 : size, place);
}

int fsync(int file) {
    if (ours("sync", file, NULL) && strikes() && fault() < 0) return -1;
    return REAL(fsync)(file);
}

int fdatasync(int file) {
    if (ours("sync", file, NULL) && strikes() && fault() < 0) return -1;
    return REAL(fdatasync)(file);
}

int ftruncate(int file, off_t size) {
    if (ours("write", file, NULL) && strikes() && fault() < 0) return -1;
    return REAL(ftruncate)(file, size);
}

int posix_fallocate(int file, off_t place, off_t size) {
    if (ours("write", file, NULL) && strikes() && fault() < 0) return errno;
    return REAL(posix_fallocate)(file, place, size);
}

int renameat(int from, const char *name, int to, const char *new_name) {
    if (ours("rename", from, new_name) && strikes() && fault() < 0) return -1;
    return REAL(renameat)(from, name, to, new_name);
}

int mkdirat(int folder, const char *name, mode_t mode) {
    const int result = REAL(mkdirat)(folder, name, mode);
    if (result == 0) ours("mkdir", folder, name);
    return result;
}

int close(int file) {
    const bool struck = written(file) && ours("close", file, NULL) && strikes();
    const int result = REAL(close)(file);
    return struck && fault() < 0 ? -1 : result;
}

__attribute__((destructor)) static void tell_count(void) {
    const char *path = getenv("FAULT_COUNT");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    fprintf(file, "%ld\n", atomic_load(&calls));
    fclose(file);
}
