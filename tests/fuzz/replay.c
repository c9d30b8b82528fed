// SPDX-License-Identifier: GPL-3.0-or-later
// The files that are named, one after the other, to a fuzz target: `make test` holds the targets to
// the inputs that were ever of interest, with any compiler.
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size);

enum { SIZE_MOST = 1 << 22 };

static int replay(const char *path) {
    static unsigned char buffer[SIZE_MOST];
    FILE *file = fopen(path, "rb");
    if (!file) return perror(path), 1;
    const size_t size = fread(buffer, 1, sizeof buffer, file);
    fclose(file);
    if (size == sizeof buffer) return fprintf(stderr, "%s: too long\n", path), 1;
    unsigned char *bytes = malloc(size + 1); // of its own size, so that sanitizers see its end
    if (!bytes) return perror(path), 1;
    for (size_t i = 0; i < size; i++) bytes[i] = buffer[i];
    printf("%s\n", path);
    fflush(stdout); // it is the last one told if the target aborts
    LLVMFuzzerTestOneInput(bytes, size);
    free(bytes);
    return 0;
}

int main(int count, char **paths) {
    int failed = count < 2;
    for (int i = 1; i < count; i++) failed |= replay(paths[i]);
    return failed;
}
