// SPDX-License-Identifier: GPL-3.0-or-later
// Perrin as a library: runs a run file and prints the long-time diffusion of its last stage that
// has one. Build it by CMakeLists.txt beside it, or with
//   cc diffusion.c $(pkg-config --cflags --libs perrin) -o diffusion
#include <perrin/perrin.h>

#include <stdio.h>
#include <string.h>

static int failed(void) {
    fprintf(stderr, "diffusion: %s\n", perrin_error());
    return 1;
}

static void print_diffusion(const perrin_results *results) {
    for (size_t i = 0; i < perrin_results_count(results); i++) {
        perrin_quantity q;
        if (perrin_results_at(results, i, &q) != PERRIN_OK) continue;
        if (strncmp(q.name, "long_time_diffusion", 19) != 0) continue;
        printf("%s/%s = %.4g +- %.2g %s (%zu replicas)\n", q.stage, q.name, q.value, q.error,
               q.unit, q.n);
    }
}

int main(int argc, char **argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: diffusion FILE.yaml DIR\n");
        return PERRIN_BAD_USAGE;
    }
    perrin_plan *plan = NULL;
    perrin_run *run = NULL;
    perrin_results *results = NULL;
    if (perrin_plan_read(&plan, argv[1], NULL) != PERRIN_OK) return failed();
    if (perrin_run_start(&run, plan, argv[2], 0) != PERRIN_OK) return failed();
    if (perrin_run_finish(run, &results) != PERRIN_OK) return failed();
    print_diffusion(results);
    perrin_results_free(results);
    perrin_plan_free(plan);
    return 0;
}
