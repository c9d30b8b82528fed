// SPDX-License-Identifier: GPL-3.0-or-later
// The per-thread sentence of the last failure.
#include "base/status.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static _Thread_local char sentence[STATUS_SENTENCE_SIZE];

__attribute__((format(printf, 1, 0))) static void keep(const char *format, va_list arguments) {
    // The arguments may point into the sentence itself, when a failure is told with more context.
    char fresh[STATUS_SENTENCE_SIZE];
    vsnprintf(fresh, sizeof fresh, format, arguments);
    memcpy(sentence, fresh, sizeof fresh);
}

Status status_fail(Status code, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    keep(format, arguments);
    va_end(arguments);
    return code;
}

Status status_fail_errno(Status code, const char *format, ...) {
    const int reason = errno;
    va_list arguments;
    va_start(arguments, format);
    keep(format, arguments);
    va_end(arguments);
    const size_t length = strlen(sentence);
    snprintf(sentence + length, sizeof sentence - length, ": %s", strerror(reason));
    return code;
}

const char *status_sentence(void) {
    return sentence;
}

_Noreturn void status_abort(const char *condition, const char *file, int line) {
    fprintf(stderr, "perrin: internal error: '%s' does not hold at %s:%d; please report this\n",
            condition, file, line);
    abort();
}
