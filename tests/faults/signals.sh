#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# signals.sh PERRIN SAME ROUNDS: SIGTERM, SIGINT and SIGUSR1 at random times end a run within a
# second by exit code 75 and a sentence that says how to resume; SIGUSR2 lets it go on. The data
# are those of an undisturbed run. The run must last a second.
PROGRAM=$1 SAME=$2 ROUNDS=$3
. "$(dirname "$0")/common.sh"

milliseconds() { awk '{ print int($1 * 1000) }' /proc/uptime; }

reference
stopped=0 slowest=0

interrupt() { # SIGNAL
    rm -rf "$work/run"
    launch "$work/run" >"$work/out" 2>&1 &
    process=$!
    await_handler $process
    pause 0.05 "$(part 0.8)"
    from=$(milliseconds)
    kill -"$1" $process 2>/dev/null
    code=0
    wait $process || code=$?
    took=$(($(milliseconds) - from))
    [ $code -eq 0 ] && return # it was done before
    stopped=$((stopped + 1))
    [ $took -gt $slowest ] && slowest=$took
    [ $code -eq 75 ] || fail "$1: exit code $code: $(cat "$work/out")"
    [ $took -le 1000 ] || fail "$1: the end took $took ms"
    grep -q "resume" "$work/out" || fail "$1: not a word on how to resume: $(cat "$work/out")"
    start "$work/run" >"$work/out" 2>&1 || fail "$1: the resume fails: $(cat "$work/out")"
    same "$work/run" "$work/reference" || fail "$1: the resume ends in other data"
}

round=1
while [ $round -le "$ROUNDS" ]; do
    for signal in TERM INT USR1; do interrupt $signal; done
    round=$((round + 1))
done
[ $stopped -ge "$ROUNDS" ] || fail "only $stopped runs were stopped: the run is too short"

rm -rf "$work/run"
launch "$work/run" >"$work/out" 2>&1 &
process=$!
await_handler $process
for i in 1 2 3; do
    pause 0.05 "$(part 0.25)"
    kill -USR2 $process 2>/dev/null
done
wait $process || fail "USR2: exit code $?: $(cat "$work/out")"
same "$work/run" "$work/reference" || fail "USR2: other data"
[ -e "$work/run/checkpoint/replica-0000.a" ] || fail "USR2: no checkpoint"
finish "$stopped runs stopped, the slowest within $slowest ms"
