#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# kills.sh PROGRAM SAME KILLS: kills a run with SIGKILL at random times and resumes it, until so
# many kills have struck; every chain of kills must end in the data of a run never stopped.
PROGRAM=$1 SAME=$2 KILLS=$3
. "$(dirname "$0")/common.sh"

reference
kills=0 chains=0
while [ $kills -lt "$KILLS" ]; do
    rm -rf "$work/run"
    while :; do
        launch "$work/run" >"$work/out" 2>&1 &
        process=$!
        pause 0.01 "$(part 0.5)"
        kill -KILL $process 2>/dev/null
        code=0
        wait $process 2>/dev/null || code=$?
        [ $code -eq 0 ] && break
        if [ $code -ne 137 ]; then
            fail "a resumed run: exit code $code: $(cat "$work/out")"
            break
        fi
        kills=$((kills + 1))
    done
    chains=$((chains + 1))
    same "$work/run" "$work/reference" || fail "chain $chains ends in other data"
done
finish "$kills kills in $chains chains"
