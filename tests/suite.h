// SPDX-License-Identifier: GPL-3.0-or-later
// How every test program ends.
#pragma once

#include <check.h>
#include <stdio.h>

// Runs all tests of a suite; returns what `main` returns.
static inline int run_suite(Suite *suite) {
    setvbuf(stdout, NULL, _IOLBF, 0); // what was found is seen even if the next thing fails
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
