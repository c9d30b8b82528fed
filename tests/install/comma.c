// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a run file in a program whose locale writes numbers as LOCALE does.
#include <perrin/perrin.h>

#include <locale.h>
#include <stdio.h>

static int failed(void) {
    fprintf(stderr, "comma: %s\n", perrin_error());
    return 1;
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr, "usage: comma LOCALE FILE.yaml DIR\n");
        return PERRIN_BAD_USAGE;
    }
    if (!setlocale(LC_NUMERIC, argv[1])) {
        fprintf(stderr, "comma: there is no locale '%s'\n", argv[1]);
        return PERRIN_BAD_USAGE;
    }
    perrin_plan *plan = NULL;
    perrin_run *run = NULL;
    const char *wrong[] = {"dynamics.thermostat_interval=20.5", NULL};
    if (perrin_plan_read(&plan, argv[2], wrong) != PERRIN_BAD_DATA) return 1;
    puts(perrin_error());
    if (perrin_plan_read(&plan, argv[2], NULL) != PERRIN_OK) return failed();
    if (perrin_run_start(&run, plan, argv[3], 0) != PERRIN_OK) return failed();
    if (perrin_run_finish(run, NULL) != PERRIN_OK) return failed();
    perrin_plan_free(plan);
    printf("%.1f\n", 0.5); // the program's own numbers stay as it wants them
    return 0;
}
