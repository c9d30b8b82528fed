#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# damage.sh PERRIN SAME: checkpoints cut off or with a flipped bit, trajectories and results of
# strangers. One damaged slot: the run goes on from the other and the log says so. Both: exit code
# 65, a sentence with the path, and nothing is written over. PERRIN must run for half a second.
PROGRAM=$1 SAME=$2
. "$(dirname "$0")/common.sh"

reference
a=$work/run/checkpoint/replica-0000.a b=$work/run/checkpoint/replica-0000.b
trajectory=$work/run/trajectory/replica-0001.h5
cases=0

# A run killed on its way, so that there is something to resume.
if is_perrin; then
    THREADS=2
    launch "$work/stopped" >"$work/out" 2>&1 &
    process=$!
    until [ -e "$work/stopped/checkpoint/replica-0000.b" ] &&
        [ -e "$work/stopped/checkpoint/replica-0001.b" ]; do
        kill -0 $process 2>/dev/null || break
        sleep 0.01
    done
    [ -e "$work/stopped/checkpoint/replica-0001.b" ] || fail "the run is over before it can be stopped"
    kill -KILL $process 2>/dev/null
    wait $process 2>/dev/null
else
    start "$work/stopped" >/dev/null
fi

size() { stat -c %s "$1"; }

flip() { # FILE BYTE: inverts its bits
    byte=$(od -An -tu1 -j"$2" -N1 "$1" | tr -d ' ')
    printf "\\$(printf %o $((255 - byte)))" | dd of="$1" bs=1 seek="$2" conv=notrunc 2>/dev/null
}

fresh() {
    rm -rf "$work/run"
    cp -a "$work/stopped" "$work/run"
    cases=$((cases + 1))
}

goes_on() { # NAME PATH-IN-LOG
    start "$work/run" >"$work/out" 2>&1 || fail "$1: does not go on: $(cat "$work/out")"
    grep -q "warning: .*$2" "$work/run/log.txt" || fail "$1: the log says nothing of it"
    same "$work/run" "$work/reference" || fail "$1: ends in other data"
}

refuses() { # NAME PATH CODE [WORDS-IN-SENTENCE]
    cksum "$2" >"$work/before"
    code=0
    start "$work/run" >"$work/out" 2>&1 || code=$?
    [ $code -eq "$3" ] || fail "$1: exit code $code: $(cat "$work/out")"
    [ "$(grep -c error: "$work/out")" -eq 1 ] && grep -q "error: .*$(basename "${4:-$2}")" "$work/out" ||
        fail "$1: not one sentence with the path: $(cat "$work/out")"
    cksum "$2" | cmp -s - "$work/before" || fail "$1: written over"
}

for part in 0 1 2 3 4 5 6 7 8 9; do
    for slot in "$a" "$b"; do
        fresh
        truncate -s $(($(size "$slot") * part / 10)) "$slot"
        goes_on "a slot cut off at $part/10" "$(basename "$slot")"
        fresh
        flip "$slot" $(($(size "$slot") * part / 10))
        goes_on "a slot with a flipped byte at $part/10" "$(basename "$slot")"
    done
    fresh
    flip "$a" $(($(size "$a") * part / 10))
    flip "$b" $(($(size "$b") * (9 - part) / 10))
    refuses "both slots damaged" "$a" 65
done

fresh
cp "$work/run/checkpoint/replica-0001.a" "$a"
rm -f "$b"
refuses "a checkpoint of another replica" "$a" 65

for part in 0 1 5 9; do
    fresh
    truncate -s $(($(size "$trajectory") * part / 10)) "$trajectory"
    refuses "a trajectory cut off" "$trajectory" 65
done
fresh
echo "a stranger's" >"$trajectory"
refuses "a stranger's trajectory" "$trajectory" 65
fresh
flip "$trajectory" 600
refuses "a trajectory with a changed header" "$trajectory" 65

fresh
sed -i 's/particles: .*/particles: 99/' "$work/run/plan.yaml"
refuses "another plan" "$work/run/plan.yaml" 73 "another plan"

rm -rf "$work/run"
mkdir "$work/run"
cp "$work/reference/results.h5" "$work/run/"
refuses "results of an unknown plan" "$work/run/results.h5" 73
cases=$((cases + 1))
finish "$cases damaged directories"
