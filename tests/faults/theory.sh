#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# theory.sh PERRIN SAME ROUNDS: a theory under shear that is stopped or killed goes on within its
# point and ends in the data of one never stopped; a stop says what is kept, and what is not. A sweep
# of theories keeps the points that were done.
PROGRAM=$1 SAME=$2 ROUNDS=$3
. "$(dirname "$0")/common.sh"

cat >"$work/run.yaml" <<END
title: a small run of the theory under shear
itt:
  structure: fundamental-measure
  packing_fraction: 0.69754438
  wave_numbers: {spacing: 0.6, last: 18}
  shear_rate: 0.01
  correlators: {wave_numbers: [6.6], times: {first: 1e-4, per_decade: 20}}
END
reference
checkpoint=checkpoint/replica-0000.a

stopped=0 within=0 round=1
while [ $round -le "$ROUNDS" ]; do
    for signal in TERM INT USR1 KILL; do
        rm -rf "$work/run"
        launch "$work/run" >"$work/out" 2>&1 &
        process=$!
        await_handler $process
        pause 0.05 "$(part 0.4)"
        [ $signal = KILL ] && kill -USR2 $process 2>/dev/null # a checkpoint, and go on
        pause 0.05 "$(part 0.4)"
        kill -$signal $process 2>/dev/null
        code=0
        wait $process 2>/dev/null || code=$?
        [ $code -eq 0 ] && continue # it was done before
        stopped=$((stopped + 1))
        case $signal-$code in
            KILL-137) ;;
            TERM-75 | INT-75 | USR1-75)
                words="begins anew"
                [ -e "$work/run/$checkpoint" ] && words="stopped at a checkpoint"
                grep -q "interrupted: .*$words.*resumes in" "$work/out" ||
                    fail "$signal: '$words' is not said: $(cat "$work/out")"
                ;;
            *) fail "$signal: exit code $code: $(cat "$work/out")" ;;
        esac
        kept=0
        [ -e "$work/run/$checkpoint" ] && kept=1
        start "$work/run" >"$work/out" 2>&1 || fail "$signal: the resume fails: $(cat "$work/out")"
        "$SAME" "$work/run/results.h5" "$work/reference/results.h5" ||
            fail "$signal: the resume ends in other data"
        [ $kept -eq 0 ] && continue
        within=$((within + 1))
        grep -q "goes on at t = " "$work/run/log.txt" ||
            fail "$signal: there was a checkpoint, but the run began anew"
    done
    round=$((round + 1))
done
[ $within -ge "$ROUNDS" ] || fail "only $within of $stopped stopped runs had a checkpoint"

# At rest: nothing is kept, which is said.
cat >"$work/run.yaml" <<END
title: correlators at rest
theory:
  dimension: 2
  species: {disc: {diameter: 1.0}}
  structure: fundamental-measure
  packing_fraction: 0.69
  wave_numbers: {count: 600, last: 80}
  calculate: [correlators]
  correlators: {times: {last: 1e12}}
END
launch "$work/rest" >"$work/out" 2>&1 &
process=$!
await_handler $process
sleep 0.5
kill -TERM $process
code=0
wait $process || code=$?
[ $code -eq 75 ] || fail "at rest: exit code $code: $(cat "$work/out")"
grep -q "begins anew" "$work/out" || fail "at rest: not said that it begins anew: $(cat "$work/out")"
[ ! -e "$work/rest/$checkpoint" ] || fail "at rest: there is a checkpoint"
[ ! -e "$work/rest/results.h5" ] || fail "at rest: there are results"

# A phase diagram: the points that were done are not done again.
cat >"$work/run.yaml" <<END
title: the glass transition over composition and size ratio
theory:
  dimension: 2
  wave_numbers: {count: 153, last: 40}
  calculate: [critical_point, exponents]
  species: {small: {diameter: 0.7, fraction: 0.5}, big: {diameter: 1.0}}
sweep:
  theory.species.small.diameter: [0.6, 0.7]
  theory.species.small.fraction: [0.2, 0.5]
END
rm -rf "$work/reference" "$work/run"
reference
points_done() { # with the files that their results are in
    (cd "$work/run" && stat -c '%n %i %y' ./*/results.h5) 2>/dev/null
}
partly=0
for signal in KILL TERM; do
    seen=$(points_done | grep -c .)
    launch "$work/run" >"$work/out" 2>&1 &
    process=$!
    while kill -0 $process 2>/dev/null && [ "$(points_done | grep -c .)" -le "$seen" ]; do
        sleep 0.02
    done
    pause 0 "$(part 0.1)"
    kill -$signal $process 2>/dev/null
    code=0
    wait $process 2>/dev/null || code=$?
    case $signal-$code in
        KILL-137 | TERM-75) partly=$((partly + 1)) ;;
        *-0) ;; # it was done before
        *) fail "sweep, $signal: exit code $code: $(cat "$work/out")" ;;
    esac
done
[ $partly -gt 0 ] || fail "no sweep was stopped between its points"
points_done >"$work/before"
start "$work/run" >"$work/out" 2>&1 || fail "sweep: the resume fails: $(cat "$work/out")"
points_done >"$work/after"
[ "$(grep -c -x -F -f "$work/before" "$work/after")" -eq "$(grep -c . "$work/before")" ] ||
    fail "sweep: a point that was done was done again"
for file in "$work"/reference/results.h5 "$work"/reference/*/results.h5; do
    "$SAME" "$file" "$work/run${file#"$work/reference"}" || fail "sweep: other data in $file"
done
finish "$stopped runs stopped, $within went on within; $partly sweeps stopped between points"
