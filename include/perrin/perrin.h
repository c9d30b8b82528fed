// SPDX-License-Identifier: GPL-3.0-or-later
/** @file
 * Perrin as a library: read a run file, run it, read numbers. Plain C, usable from C++.
 *
 * Units: lengths in the reference diameter d, energies in kT, times in d^2/D0 (see the run-file
 * reference). A function that can fail returns PERRIN_OK or a code below; perrin_error() then
 * gives the sentence. Objects made through `out` are yours: free them with their _free function.
 * Different objects may be used from different threads.
 */
#ifndef PERRIN_PERRIN_H
#define PERRIN_PERRIN_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PERRIN_OK = 0,
    PERRIN_BAD_USAGE = 2,  /**< an argument that makes no sense, or a name that is not there */
    PERRIN_BAD_DATA = 65,  /**< a run file or a stored file that cannot be used */
    PERRIN_UNHEALTHY = 70, /**< a health limit was broken; the results say which */
    PERRIN_NO_MEMORY = 71,
    PERRIN_LOCKED = 73,     /**< the directory is in use, or holds another plan */
    PERRIN_IO_FAILED = 74,  /**< disk or file system */
    PERRIN_INTERRUPTED = 75 /**< stopped on request after a checkpoint; run again to resume */
};

typedef struct perrin_plan perrin_plan;       /**< a run file, read and checked */
typedef struct perrin_run perrin_run;         /**< a run that goes on in threads of its own */
typedef struct perrin_results perrin_results; /**< numbers of a finished run */

const char *perrin_version(void); /**< "0.1.0" */
const char *perrin_error(void);   /**< sentence of this thread's last failure; of a run
                                       file with several faults, a line each */

/** Reads a run file. `settings`: NULL, or a NULL-ended list of "KEY=VALUE" that override it. */
int perrin_plan_read(perrin_plan **out, const char *path, const char *const *settings);
/** As perrin_plan_read, from a text in memory; `name` stands for the file in error sentences. */
int perrin_plan_parse(perrin_plan **out, const char *name, const char *text);
void perrin_plan_free(perrin_plan *plan);

/** Starts, or resumes, the plan in `directory`. threads = 0: as many as processors. The plan must
 * live until perrin_run_finish. */
int perrin_run_start(perrin_run **out, const perrin_plan *plan, const char *directory, int threads);
double perrin_run_progress(const perrin_run *run); /**< fraction of the work done, 0 to 1 */
/** Asks for a checkpoint and an end; returns at once. May be called from another thread. */
void perrin_run_stop(perrin_run *run);
/** Waits for the end, writes results.h5 and report.html, frees the run in any case. `out` may be
 * NULL. Results are given with PERRIN_OK and with PERRIN_UNHEALTHY. */
int perrin_run_finish(perrin_run *run, perrin_results **out);

/** Reads a file results.h5, such as "DIR/results.h5". */
int perrin_results_read(perrin_results **out, const char *path);
void perrin_results_free(perrin_results *results);

/** A number with its standard error over replicas. */
typedef struct perrin_quantity {
    const char *stage, *name, *unit, *about; /**< live as long as the results */
    double value;
    double error; /**< NaN with fewer than two replicas */
    size_t n;     /**< replicas that have a value */
} perrin_quantity;

size_t perrin_results_count(const perrin_results *results); /**< of quantities */
/** The quantity at `index`, below the count. */
int perrin_results_at(const perrin_results *results, size_t index, perrin_quantity *out);
/** The quantity of that name, as in "quiescent/long_time_diffusion". */
int perrin_results_find(const perrin_results *results, const char *name, perrin_quantity *out);

enum { PERRIN_AXES_MOST = 8 };

/** An array over axes, as in "quiescent/mean_squared_displacement". Row-major: the last axis runs
 * fastest. */
typedef struct perrin_series {
    const char *unit, *about;
    size_t axes;
    size_t count[PERRIN_AXES_MOST];
    const char *axis_name[PERRIN_AXES_MOST];
    const char *axis_unit[PERRIN_AXES_MOST];
    const double *axis_values[PERRIN_AXES_MOST];      /**< NULL for an axis of labels */
    const char *const *axis_labels[PERRIN_AXES_MOST]; /**< NULL for an axis of numbers */
    size_t size;                                      /**< product of the counts */
} perrin_series;

int perrin_results_series(const perrin_results *results, const char *name, perrin_series *out);
/** Mean and standard error over replicas of the series' elements; each array has `size` numbers,
 * or is NULL. */
int perrin_results_values(const perrin_results *results, const char *name, double *mean,
                          double *error);

#ifdef __cplusplus
}
#endif

#endif
