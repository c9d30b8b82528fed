// SPDX-License-Identifier: GPL-3.0-or-later
// Signal handlers that only set flags; the run looks at them between slices.
#include "signals.h"

#include "base/status.h"

#include <signal.h>
#include <unistd.h>

// The only variables that outlive a call in this program: a handler has nowhere else to write.
static volatile sig_atomic_t stop_wanted, checkpoint_wanted;

static void ask_stop(int signal_number) {
    if (stop_wanted && signal_number == SIGINT) _exit(INTERRUPTED);
    stop_wanted = 1;
}

static void ask_checkpoint(int signal_number) {
    (void)signal_number;
    checkpoint_wanted = 1;
}

void signals_catch(void) {
    struct sigaction action = {.sa_handler = ask_stop};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGUSR1, &action, NULL);
    action.sa_handler = ask_checkpoint;
    sigaction(SIGUSR2, &action, NULL);
}

bool signals_want_stop(void) {
    return stop_wanted != 0;
}

bool signals_want_checkpoint(void) {
    const bool wanted = checkpoint_wanted != 0;
    checkpoint_wanted = 0;
    return wanted;
}
