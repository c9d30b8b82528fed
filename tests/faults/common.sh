# SPDX-License-Identifier: GPL-3.0-or-later
# What the fault tests share. Sourced with: PROGRAM (store_run or perrin), SAME (same_results) and,
# where it is needed, SHIM. The small run is `start DIR`, its size LENGTH, PARTICLES and (store_run)
# PAUSE; `same DIR REFERENCE` compares what two runs left, bit for bit.
set -u
[ -n "${TMPDIR:-}" ] || { [ -w /dev/shm ] && TMPDIR=/dev/shm; } || TMPDIR=/tmp # memory is faster
work=$(mktemp -d "$TMPDIR/perrin-faults.XX""XXXX")
failures=0
if [ -n "${SHIM:-}" ]; then # LD_PRELOAD splits at blanks, LD_LIBRARY_PATH does not
    LD_LIBRARY_PATH=$(dirname "$SHIM")
    export LD_LIBRARY_PATH
    SHIM=$(basename "$SHIM")
fi
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM HUP

fail() { # one sentence; ten of them are enough to see what is wrong
    echo "FAIL: $*"
    failures=$((failures + 1))
    [ $failures -lt 10 ] || exit 1
}

skip() { # CTest knows 77 as skipped
    echo "skipped: $*"
    exit 77
}

finish() {
    echo "$*, $failures failures"
    [ $failures -eq 0 ]
    exit
}

is_perrin() { [ "$(basename "$PROGRAM")" = perrin ]; }

# A run of a second or two at most: LENGTH is its time in d^2/D0, or its frames.
run_file() {
    cat <<END
title: a small run for the fault tests
system:
  dimension: 2
  particles: ${PARTICLES:-36}
  packing_fraction: 0.5
  species:
    small: {shape: disc, diameter: 1.0, fraction: 0.5}
    big: {shape: disc, diameter: 1.4, fraction: 0.5}
dynamics: {method: event-driven, thermostat_interval: 0.1}
protocol:
  - {stage: quiescent, time: ${LENGTH:-0.2}, observe: [mean_squared_displacement, pressure]}
ensemble: {replicas: 2, seed: 7}
output: {trajectory: {every: ${EVERY:-0.05}}, checkpoint_every: ${CHECKPOINT_EVERY:-0.01 s}}
END
}

# `launch DIR &` makes $! the process itself; `start DIR` waits for it.
if is_perrin; then
    run_file >"$work/run.yaml"
    # Figures take long and are for others to test: this gnuplot draws nothing.
    mkdir "$work/bin"
    printf '#!/bin/sh\necho "<svg></svg>" >"${1%%.gp}.svg"\n' >"$work/bin/gnuplot"
    chmod +x "$work/bin/gnuplot"
    launch() { PATH=$work/bin exec "$PROGRAM" run "$work/run.yaml" -o "$1" --threads "${THREADS:-1}" --quiet; }
else
    launch() { exec "$PROGRAM" "$1" "${LENGTH:-4}" "${PARTICLES:-50}" "${PAUSE:-0}"; }
fi
start() { (launch "$1"); }

same() {
    "$SAME" "$1/results.h5" "$2/results.h5" || return 1
    for file in "$2"/trajectory/*.h5; do
        cmp "$file" "$1/trajectory/$(basename "$file")" || return 1
    done
}

# reference: an undisturbed run in $work/reference, and the seconds it took in $duration.
reference() {
    from=$(awk '{ print $1 }' /proc/uptime)
    start "$work/reference" >"$work/out" 2>&1 || fail "the undisturbed run: $(cat "$work/out")"
    duration=$(awk -v from="$from" '{ print $1 - from + 0.01 }' /proc/uptime)
}

# part SHARE: that share of the duration.
part() { awk -v d="$duration" -v share="$1" 'BEGIN { print d * share }'; }

# await_handler PROCESS: waits until it would catch SIGTERM; on a busy machine a program begins late.
await_handler() {
    while mask=$(sed -n '/^State:.*Z/q; s/^SigCgt:[^0-9a-f]*//p' "/proc/$1/status" 2>/dev/null) &&
        [ -n "$mask" ] && [ $((0x$mask & 0x4000)) -eq 0 ]; do
        sleep 0.01
    done
}

# pause FROM TO: sleeps a random time between, in seconds; SEED says which.
SEED=${SEED:-1}
pause() {
    SEED=$((SEED + 1))
    sleep "$(awk -v s=$SEED -v a="$1" -v b="$2" 'BEGIN { srand(s); rand(); print a + (b - a) * rand() }')"
}
