#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# races.sh PROGRAM SAME RACES: twelve processes start on one directory at once: exactly one runs,
# the others exit with 73, and change not a byte of what is there. The run must last a second, so
# that it is not over when the last of them gets the processor.
PROGRAM=$1 SAME=$2 RACES=$3
. "$(dirname "$0")/common.sh"
STARTERS=12

contents() { # names, sizes, times and checksums of all there is
    (cd "$1" && find . -type f -exec stat -c '%n %s %y %i' {} + | sort && find . -type f | sort | xargs cksum)
}

reference

race=1
while [ $race -le "$RACES" ]; do
    rm -rf "$work/run" "$work/go" "$work"/code.*
    starter=1
    while [ $starter -le $STARTERS ]; do
        (
            code=0
            until [ -e "$work/go" ]; do sleep 0.01; done
            start "$work/run" >"$work/out.$starter" 2>&1 || code=$?
            echo $code >"$work/code.$starter"
        ) &
        starter=$((starter + 1))
    done
    touch "$work/go"
    wait
    won=$(cat "$work"/code.* | grep -c '^0$')
    lost=$(cat "$work"/code.* | grep -c '^73$')
    [ "$won" -eq 1 ] && [ "$lost" -eq $((STARTERS - 1)) ] ||
        fail "race $race: $won ran, $lost were locked out of $STARTERS"
    same "$work/run" "$work/reference" || fail "race $race: other data"
    race=$((race + 1))
done

# One holder, stopped in the middle; then eleven others at once.
rm -rf "$work/run"
launch "$work/run" >"$work/out" 2>&1 &
holder=$!
until [ -s "$work/run/perrin.lock" ] && [ -e "$work/run/trajectory" ]; do sleep 0.01; done
kill -STOP $holder
contents "$work/run" >"$work/before"
starter=2
while [ $starter -le $STARTERS ]; do
    (
        code=0
        start "$work/run" >"$work/out.$starter" 2>&1 || code=$?
        [ $code -eq 73 ] && grep -q "in use by .*process $holder on" "$work/out.$starter" ||
            echo "exit code $code: $(cat "$work/out.$starter")" >>"$work/wrong"
    ) &
    processes="${processes:-} $!"
    starter=$((starter + 1))
done
wait $processes
contents "$work/run" >"$work/after"
kill -CONT $holder
[ ! -e "$work/wrong" ] || fail "a loser: $(cat "$work/wrong")"
cmp -s "$work/before" "$work/after" || fail "the losers changed something"
wait $holder || fail "the holder failed: $(cat "$work/out")"
same "$work/run" "$work/reference" || fail "the holder's data are others"
finish "$RACES races of $STARTERS, one with the holder stopped"
