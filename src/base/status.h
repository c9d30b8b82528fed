// SPDX-License-Identifier: GPL-3.0-or-later
// An error is a sentence. A function that can fail returns a Status; the sentence that explains a
// failure is kept per thread until the next failure. The values are the program's exit codes.
#pragma once

typedef enum Status {
    OK = 0,
    BAD_USAGE = 2,    // command line
    BAD_DATA = 65,    // run file, stored file
    UNHEALTHY = 70,   // a health limit is broken, or a broken promise of ours
    NO_MEMORY = 71,   //
    LOCKED = 73,      // another process owns the output, or it holds another plan
    IO_FAILED = 74,   // disk or file system
    INTERRUPTED = 75, // stopped by a signal after a checkpoint; can be resumed
} Status;

// Room for a sentence, or for several, a line each.
enum { STATUS_SENTENCE_SIZE = 4096 };

// Keeps the sentence for this thread and returns `code`.
Status status_fail(Status code, const char *format, ...) __attribute__((format(printf, 2, 3)));

// As status_fail, with ": " and the text of errno appended: "cannot write PATH: No space left".
Status status_fail_errno(Status code, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// The sentence of this thread's last failure; "" before the first.
const char *status_sentence(void);

// Leaves the calling function with the Status of a call that failed.
#define TRY(call)                                                                                  \
    do {                                                                                           \
        const Status try_status = (call);                                                          \
        if (try_status != OK) return try_status;                                                   \
    } while (0)

// What must be true here, checked in every build: a wrong curve costs more than a comparison.
#define ASSERT(condition) ((condition) ? (void)0 : status_abort(#condition, __FILE__, __LINE__))
_Noreturn void status_abort(const char *condition, const char *file, int line);
