// SPDX-License-Identifier: GPL-3.0-or-later
// The run directory: who owns it, its plan, its log and its results. Nothing reported as written
// is ever lost: files appear whole under their names (temporary name, fsync, rename, fsync of the
// directory), and a lock comes before any other open. See checkpoint.h and trajectory.h for the
// other two kinds of file.
#pragma once

#include "results/results.h"

#include <stdbool.h>

typedef struct Store Store;

// Makes the directory if there is none and locks it, touching nothing else. LOCKED with a sentence
// that names the holder if another process has it.
Status store_open(Store **out, const char *directory);
void store_close(Store *store); // gives the lock back; NULL is allowed

const char *store_directory(const Store *store);

// Says which plan the directory holds: writes plan.yaml where there is none; where there is one it
// must be this one, letter by letter, or LOCKED with a sentence that shows the first line that
// differs. Before any checkpoint or trajectory. `resumes`: there was one already.
Status store_take_plan(Store *store, const char *plan, bool *resumes);

// A text file in the directory, whole or not at all. What is read is yours to free();
// NULL if there is none.
Status store_write_text(Store *store, const char *name, const char *text);
Status store_read_text(const Store *store, const char *name, char **text);

// Gives a file of the directory another name, in place of what had it.
Status store_rename(Store *store, const char *name, const char *other);

// Appends a line, with date and time, to log.txt. Safe from any thread.
Status store_log(Store *store, const char *format, ...) __attribute__((format(printf, 2, 3)));

// results.h5: the same bytes for the same contents.
Status store_write_results(Store *store, const Results *results);

// Whether a series has this beside its axes in results.h5, so that none of them can be called so.
bool store_keeps_name(const char *name);

// Reads a results.h5 of ours, no matter who sends it: BAD_DATA with a sentence unless it is whole.
Status store_read_results(Results **out, const char *path);

// From now on a full file or a closed pipe is an error of the write, not the end of the process.
void store_ignore_signals(void);
