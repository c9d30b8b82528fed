#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# sweep.sh PERRIN SAME ROUNDS: a sweep ends in the same data for any number of threads and however
# often it is stopped or killed; each point is the run that its values alone would give; a point
# that fails does not take the others with it.
PROGRAM=$1 SAME=$2 ROUNDS=$3
. "$(dirname "$0")/common.sh"

{
    run_file
    echo 'sweep: {system.packing_fraction: [0.3, 0.5, 0.6], dynamics.thermostat_interval: [0.1, 0.2]}'
} >"$work/sweep.yaml"
mv "$work/sweep.yaml" "$work/run.yaml"

THREADS=1
reference
for THREADS in 2 5; do
    start "$work/threads-$THREADS" || fail "with $THREADS threads: exit code $?"
    "$SAME" "$work/reference/results.h5" "$work/threads-$THREADS/results.h5" ||
        fail "other data with $THREADS threads"
done

# One point, alone.
grep -v '^sweep' "$work/run.yaml" >"$work/alone.yaml"
"$PROGRAM" run "$work/alone.yaml" -o "$work/alone" --quiet --set system.packing_fraction=0.5 \
    --set dynamics.thermostat_interval=0.2 || fail "a point alone: exit code $?"
"$SAME" "$work/alone/results.h5" \
    "$work/reference/packing_fraction=0.5_thermostat_interval=0.2/results.h5" ||
    fail "a point of the sweep is not the run of its values"

# Stopped and killed.
THREADS=2 stopped=0 round=1
while [ $round -le "$ROUNDS" ]; do
    rm -rf "$work/run"
    for signal in TERM KILL INT; do
        launch "$work/run" >"$work/out" 2>&1 &
        process=$!
        await_handler $process
        pause 0.05 "$(part 0.4)"
        kill -$signal $process 2>/dev/null
        code=0
        wait $process || code=$?
        case $signal-$code in
            *-0) ;;
            KILL-137 | TERM-75 | INT-75) stopped=$((stopped + 1)) ;;
            *) fail "$signal: exit code $code: $(cat "$work/out")" ;;
        esac
    done
    start "$work/run" >"$work/out" 2>&1 || fail "the resume fails: $(cat "$work/out")"
    "$SAME" "$work/reference/results.h5" "$work/run/results.h5" || fail "the resume ends otherwise"
    round=$((round + 1))
done
[ $stopped -gt 0 ] || fail "nothing was stopped: the sweep is too short"

# A folder in the way of one point.
mkdir -p "$work/hindered"
echo "not a plan" >"$work/hindered/packing_fraction=0.5_thermostat_interval=0.1"
code=0
start "$work/hindered" >"$work/out" 2>&1 || code=$?
[ $code -ne 0 ] || fail "a point that cannot be run is not told"
grep -q "packing_fraction=0.5_thermostat_interval=0.1" "$work/out" ||
    fail "the point is not named: $(cat "$work/out")"

# Another sweep in the same folder.
sed -i 's/0\.3, 0\.5/0.3, 0.4/' "$work/run.yaml"
code=0
start "$work/reference" >"$work/out" 2>&1 || code=$?
[ $code -eq 73 ] || fail "another sweep in the same folder: exit code $code: $(cat "$work/out")"
finish "$stopped sweeps stopped"
