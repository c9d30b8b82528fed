// SPDX-License-Identifier: GPL-3.0-or-later
// Reading results.h5, whoever made it: HDF5 is not safe on files of strangers, so it looks at one
// only after our own seal has been checked, in a child with limits on memory and time, without
// plugins, and hands plain numbers back through a pipe.
#include "base/crc32c.h"
#include "store/inside.h"
#include "store/results_parse.h"
#include "store/seal.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const size_t SPARE_MEMORY = (size_t)1 << 30; // for HDF5 and the numbers of small files
static const size_t BYTES_PER_SECOND = 20000000;    // slower than any processor reads numbers
static const unsigned PATIENCE = 60;                // seconds of wall time, should the child wait

// The address sanitizer maps terabytes that nobody uses: no limit on memory can be set beside it.
#if defined(__has_feature)
#define ADDRESS_SANITIZER __has_feature(address_sanitizer)
#elif defined(__SANITIZE_ADDRESS__)
#define ADDRESS_SANITIZER 1
#else
#define ADDRESS_SANITIZER 0
#endif
static const bool SHADOWED = ADDRESS_SANITIZER;

static void limit(int resource, size_t most) {
    struct rlimit now;
    if (getrlimit(resource, &now) != 0) return;
    if (now.rlim_max != RLIM_INFINITY && most > now.rlim_max) most = now.rlim_max;
    now.rlim_cur = most;
    setrlimit(resource, &now);
}

// Address space already in use, in bytes.
static size_t memory_mapped(void) {
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    if (!file) return 0;
    if (fscanf(file, "%lu", &pages) != 1) pages = 0;
    fclose(file);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void limit_child(size_t file_size) {
    if (!SHADOWED) limit(RLIMIT_AS, memory_mapped() + SPARE_MEMORY + 8 * file_size);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, 2 + file_size / BYTES_PER_SECOND); // a file can send HDF5 round and round
    signal(SIGALRM, SIG_DFL);                            // whatever our caller does with it
    alarm(PATIENCE + (unsigned)(file_size / BYTES_PER_SECOND));
}

// The child's whole life: a Status, then the results as an archive or the sentence of a failure.
_Noreturn static void child(int pipe_end, void *bytes, size_t size) {
    limit_child(size);
    Results *results = NULL;
    int32_t status = store_parse_results(&results, bytes, size);
    Archive archive = archive_writer();
    archive_i32(&archive, &status, 1);
    if (status == OK)
        results_archive(results, &archive);
    else
        archive_bytes(&archive, (void *)status_sentence(), strlen(status_sentence()));
    if (archive_status(&archive, false) != OK) _exit(NO_MEMORY);
    _exit(disk_append(pipe_end, archive.bytes, archive.size, "pipe"));
}

// All that comes through the pipe until the other end is closed.
static Status drain(int pipe_end, char **bytes, size_t *size) {
    size_t room = 0;
    for (;;) {
        if (*size == room) {
            room = room ? 2 * room : 1 << 16;
            char *longer = realloc(*bytes, room);
            if (!longer) return status_fail(NO_MEMORY, "out of memory: %zu bytes of results", room);
            *bytes = longer;
        }
        const ssize_t got = read(pipe_end, *bytes + *size, room - *size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return status_fail_errno(IO_FAILED, "cannot read from a pipe");
        if (got == 0) return OK;
        *size += (size_t)got;
    }
}

static int wait_for(pid_t process) {
    int how = 0;
    while (waitpid(process, &how, 0) < 0 && errno == EINTR) continue;
    return how;
}

// What the child gives, in `bytes`, and OK if it ended as it should.
static Status ask_child(void *file, size_t file_size, char **bytes, size_t *size) {
    int ends[2];
    if (pipe(ends) != 0) return status_fail_errno(IO_FAILED, "cannot make a pipe");
    store_take_hdf5(); // the child must not find it half way through another thread's call
    const pid_t process = fork();
    if (process != 0) store_give_hdf5();
    if (process == 0) child(ends[1], file, file_size);
    close(ends[1]);
    Status status = OK;
    if (process < 0)
        status = status_fail_errno(NO_MEMORY, "cannot start a process");
    else
        status = drain(ends[0], bytes, size);
    close(ends[0]);
    if (process < 0) return status;
    const int how = wait_for(process);
    if (status == OK && (how != 0 || *size < sizeof(int32_t))) {
        status = status_fail(BAD_DATA, "HDF5 breaks down over it");
    }
    return status;
}

static Status unpack(Results **out, const char *bytes, size_t size) {
    int32_t status;
    memcpy(&status, bytes, sizeof status);
    bytes += sizeof status;
    size -= sizeof status;
    if (status != OK) return status_fail((Status)status, "%.*s", (int)size, bytes);
    Archive archive = archive_reader(bytes, size);
    Results *results = NULL;
    TRY(results_create(&results, 0));
    results_archive(results, &archive);
    const Status loaded = archive_status(&archive, true);
    if (loaded == OK)
        *out = results;
    else
        results_free(results);
    return loaded;
}

static Status check_whole(const unsigned char *file, size_t size, const char *path) {
    Seal seal;
    if (size < sizeof seal) {
        return status_fail(BAD_DATA, "'%s' is no results.h5 written by perrin", path);
    }
    memcpy(&seal, file + size - sizeof seal, sizeof seal);
    TRY(seal_check(&seal, SEAL_RESULTS, size, path));
    if (crc32c(0, file, size - sizeof seal) == seal.contents_crc) return OK;
    return status_fail(BAD_DATA, "'%s' is damaged or was changed after perrin wrote it", path);
}

static Status load_file(const char *path, void **bytes, size_t *size) {
    TRY(disk_load(NULL, path, bytes, size));
    if (*bytes) return OK;
    return status_fail(BAD_DATA, "there is no file '%s'", path);
}

Status store_read_results(Results **out, const char *path) {
    void *file = NULL;
    size_t file_size;
    TRY(load_file(path, &file, &file_size));
    Status status = check_whole(file, file_size, path);
    char *bytes = NULL;
    size_t size = 0;
    if (status == OK) {
        status = ask_child(file, file_size, &bytes, &size);
        if (status == OK) status = unpack(out, bytes, size);
        if (status != OK) status_fail(status, "'%s' cannot be read: %s", path, status_sentence());
    }
    free(bytes);
    free(file);
    return status;
}
