#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# failing_calls.sh PROGRAM SAME SHIM: every write, sync, rename, close and allocation of a small
# run fails, one after the other: once and from then on, with several reasons. Each failure must
# end in exit code 74 and a sentence with path and reason; interrupted and short transfers must
# not be noticed; a resume must find every checkpoint that was acknowledged, and end in the data
# of an undisturbed run.
PROGRAM=$1 SAME=$2 SHIM=$3
. "$(dirname "$0")/common.sh"

reference
FAULT_DIR=$work/count FAULT_COUNT=$work/calls LD_PRELOAD=$SHIM start "$work/count" >/dev/null 2>&1
calls=$(cat "$work/calls")
[ "$calls" -gt 20 ] || fail "only $calls calls seen: the shim does not work"
runs=0

# words_of ERRNO: what strerror says.
words_of() {
    case $1 in
    EIO) echo "Input/output error" ;;
    ENOSPC) echo "No space left on device" ;;
    EDQUOT) echo "Disk quota exceeded" ;;
    esac
}

# The last checkpoint of each replica that the run says is durable is where the resume begins.
nothing_lost() {
    is_perrin && return 0
    for replica in 0 1; do
        acknowledged=$(awk -v r=$replica '$1 == "checkpoint" && $2 == r { n = $3 } END { print n + 0 }' "$work/out")
        first=$(awk -v r=$replica '$1 == "frame" && $2 == r { print $3; exit }' "$work/resumed")
        [ "${first:-$acknowledged}" -ge "$acknowledged" ] || return 1
    done
}

resumes() { # NAME
    if ! start "$work/run" >"$work/resumed" 2>&1; then
        fail "$1: the resume fails: $(cat "$work/resumed")"
    elif ! nothing_lost; then
        fail "$1: the resume began before an acknowledged checkpoint"
    elif ! same "$work/run" "$work/reference"; then
        fail "$1: the resume ends in other data"
    fi
}

strike() { # CALL REASON FOREVER
    name="call $1 $2 ${3:-once}"
    rm -rf "$work/run"
    code=0
    (
        [ -z "$3" ] || export FAULT_FOREVER=1
        export FAULT_DIR="$work/run" FAULT_AT="$1" FAULT_WHAT="$2" LD_PRELOAD="$SHIM"
        start "$work/run"
    ) >"$work/out" 2>"$work/err" || code=$?
    runs=$((runs + 1))
    case $2 in
    EINTR | SHORT)
        [ $code -eq 0 ] || fail "$name: exit code $code: $(cat "$work/err")"
        same "$work/run" "$work/reference" || fail "$name: other data"
        ;;
    *)
        # The results being safe, a report that could not be written is said, and no failure.
        if [ $code -eq 0 ] && grep -q "no complete report" "$work/err"; then code=74; fi
        [ $code -eq 74 ] || fail "$name: exit code $code: $(cat "$work/err")"
        grep -Eq "(error|report): .*$work/run.*: $(words_of "$2")" "$work/err" ||
            fail "$name: neither path nor reason: $(cat "$work/err")"
        resumes "$name"
        ;;
    esac
}

call=1
while [ $call -le "$calls" ]; do
    strike $call EIO ""
    strike $call ENOSPC forever
    if ! is_perrin || [ $((call % 5)) -eq 0 ]; then
        strike $call EDQUOT ""
        strike $call EINTR ""
        strike $call SHORT ""
    fi
    call=$((call + 1))
done
finish "$calls calls, $runs runs with a fault"
