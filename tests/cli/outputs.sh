#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What the program says to outputs that it cannot write, must not write over or cannot read, word
# for word, and that it leaves every file of them as it was. outputs.sh PERRIN
. "$(dirname "$0")/scratch.sh"

cat > small.yaml << 'END'
system: {dimension: 2, particles: 50, packing_fraction: 0.3, species: {grain: {shape: disc}}}
dynamics: {method: event-driven}
protocol:
  - {stage: rest, time: 0.05, observe: [pressure]}
ensemble: {replicas: 2}
output: {trajectory: {every: 0.01}, checkpoint_every: 0.1 s}
END

failed=0
count=0

# Names and contents of all files; locks and logs may grow.
contents() { find . -type f ! -name log.txt ! -name perrin.lock -exec cksum {} + | sort; }

# say CODE SENTENCE ARGUMENTS...: exit code and standard error, and nothing changed.
say() {
    code=$1 sentence=$2
    shift 2
    count=$((count + 1))
    before=$(contents)
    said=$("$perrin" "$@" 2>&1 > /dev/null < /dev/null)
    got=$?
    test "$got" = "$code" && test "$said" = "$sentence" && test "$before" = "$(contents)" && return
    failed=$((failed + 1))
    printf 'FAILED: perrin %s\n' "$*"
    printf '  exit code %s, wanted %s\n  said:   %s\n  wanted: %s\n' \
        "$got" "$code" "$said" "$sentence"
    test "$before" = "$(contents)" || echo '  files changed'
}

run() { "$perrin" run small.yaml --quiet "$@" || exit 1; }

# Outputs that cannot be.
: > file
say 74 "perrin: error: cannot open 'file': Not a directory" run small.yaml -o file
say 74 "perrin: error: cannot make the directory 'no/where': No such file or directory" \
    run small.yaml -o no/where
say 74 "perrin: error: cannot make the directory '/proc/perrin': No such file or directory" \
    run small.yaml -o /proc/perrin
say 2 "perrin: error: nothing to resume in new" run small.yaml --resume -o new
if test "$(id -u)" != 0; then
    mkdir closed && chmod 500 closed
    say 74 "perrin: error: cannot make the directory 'closed/out': Permission denied" \
        run small.yaml -o closed/out
fi

# Outputs of another plan.
run -o done
other="'done' holds a run of another plan"
elsewhere="choose another directory with -o"
say 73 "perrin: error: $other: ensemble.seed: was 1, now 2; $elsewhere" \
    run small.yaml -o done --set ensemble.seed=2
say 73 "perrin: error: $other: system.particles: was 50, now 60; protocol.rest.time: was 0.05, \
now 0.1; $elsewhere" run small.yaml -o done --set system.particles=60 --set protocol.rest.time=0.1
run -o done # the same plan is welcome
mkdir orphan && cp done/results.h5 orphan
say 73 "perrin: error: 'orphan' holds results.h5 of an unknown plan (no plan.yaml): nothing is \
written over it; $elsewhere" run small.yaml -o orphan
mkdir strange && echo "dear diary" > strange/plan.yaml
say 73 "perrin: error: 'strange' holds a run of another plan: line 1 of its plan.yaml is 'dear \
diary', here it is '# A run file with every value written out; \`perrin explain KEY\` says \
more.'; $elsewhere. The keys differ: another version may have begun it, which log.txt names" \
    run small.yaml -o strange

# Results that are none.
mkdir cut text empty && head -c 3000 done/results.h5 > cut/results.h5
echo "not HDF5" > text/results.h5
: > empty/results.h5
for command in show report; do
    say 65 "perrin: error: 'cut/results.h5' is no results.h5 written by perrin, or it was cut off" \
        $command cut
    say 65 "perrin: error: 'text/results.h5' is no results.h5 written by perrin" $command text
    say 65 "perrin: error: 'empty/results.h5' is no results.h5 written by perrin" $command empty
    say 65 "perrin: error: there is no file 'nowhere/results.h5'" $command nowhere
done
say 65 "perrin: error: 'small.yaml' is no results.h5 written by perrin, or it was cut off" \
    rerun small.yaml
say 65 "perrin: error: 'done/trajectory/replica-0000.h5' is no results.h5 written by perrin, or \
it was cut off" rerun done/trajectory/replica-0000.h5
say 2 "perrin: error: no quantity 'pressur' in these results; did you mean rest/pressure?" \
    show done pressur

# A run that was stopped, and what a stranger did to it.
"$perrin" run small.yaml --quiet -o stopped --set protocol.rest.time=20000 \
    --set output.trajectory.every=1000 2> /dev/null &
for try in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    sleep 0.2
    test -e stopped/checkpoint/replica-0000.b && test -e stopped/checkpoint/replica-0001.b && break
done
kill -TERM $! && wait $!
test $? = 75 || { echo "FAILED: the run did not stop for a signal"; exit 1; }
resume() {
    say 65 "$1" run small.yaml -o "$2" --quiet --threads 1 --set protocol.rest.time=20000 \
        --set output.trajectory.every=1000
}
for command in show report; do
    say 65 "perrin: error: the run in 'stopped' has not ended, and results come at its end; if it \
was stopped, the same 'perrin run' goes on with it" $command stopped
done
cp -r stopped cut_off
for slot in cut_off/checkpoint/*; do
    head -c 100 "$slot" > part && cp part "$slot"
done
rm -f part
resume "perrin: error: 'cut_off/checkpoint/replica-0000.a' is no usable checkpoint: it was cut off" \
    cut_off
cp -r stopped swapped
cp done/trajectory/replica-0000.h5 swapped/trajectory/replica-0000.h5
resume "perrin: error: 'swapped/trajectory/replica-0000.h5' is not the trajectory of this run: it \
was changed, or another version of perrin wrote it" swapped

printf 'outputs: %d tests, %d failed\n' "$count" "$failed"
test "$failed" = 0
