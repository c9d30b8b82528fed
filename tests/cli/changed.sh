#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A theory whose measured structure has changed since is calculated anew and says so, and what it
# had is kept; one whose structure is the same is left as it is. changed.sh PERRIN
. "$(dirname "$0")/scratch.sh"

cat > fluid.yaml << 'END'
system: {dimension: 2, particles: 100, packing_fraction: 0.6, species: {disc: {shape: disc}}}
dynamics: {method: newtonian}
protocol:
  - {stage: fluid, time: 20, observe: [structure_factor]}
observe: {structure_factor: {wave_numbers: {last: 25, spacing: 0.3, vectors: 12}, looks: 20}}
END
cat > single.yaml << 'END'
theory:
  dimension: 2
  structure: {file: fluid}
  packing_fraction: 0.6
  wave_numbers: {count: 60, last: 20}
  calculate: [structure_factor]
  species: {disc: {diameter: 1}}
END
cat single.yaml - > sweep.yaml << 'END'
sweep: {theory.packing_fraction: [0.59, 0.6]}
END
cat > shear.yaml << 'END'
itt:
  structure: {file: fluid}
  packing_fraction: 0.6
  wave_numbers: {last: 16, spacing: 0.8}
  shear_rate: 1
END

failed=0
count=0
expect() {
    what=$1
    shift
    count=$((count + 1))
    "$@" && return
    failed=$((failed + 1))
    echo "FAILED: $what"
}

simulate() { "$perrin" run fluid.yaml --quiet --threads 1 --set ensemble.seed="$1" -o "$2" || exit 1; }
run() { "$perrin" run "$1.yaml" --quiet --threads 1 -o "$2" 2> said || { cat said; exit 1; }; }
numbers() { # of a run or of the points of a sweep, and of what lies above them
    for folder in "$1" "$1"/*=*; do
        test ! -e "$folder/results.h5" || "$perrin" show "$folder" --csv || exit 1
    done
}
same_numbers() { numbers "$1" > a && numbers "$2" > b && test -s a && cmp a b; }
# Stops a run under shear as soon as it has a checkpoint.
stop_shear() {
    "$perrin" run shear.yaml --quiet --threads 1 -o shear 2> /dev/null &
    until test -e shear/log.txt; do sleep 0.02; done
    until test -e shear/checkpoint/replica-0000.a; do
        kill -USR2 $! && sleep 0.02 || exit 1
    done
    kill -TERM $!
    wait $!
    test $? = 75 || exit 1
}
quiet() { test ! -s said; }
told() {
    printf 'the structure that is read has changed: %s calculated anew; %s\n' "$1" \
        "earlier results are kept as results-of-*.h5" | cmp - said
}

simulate 1 one
simulate 2 two
cp -r one fluid
for theory in single sweep; do run $theory $theory; done
stop_shear

# Errors of the structure come with it, where groups of replicas are left out.
expect "the page shows errors" grep -q 'leaving out parts of what was measured' single/report.html
"$perrin" show single --csv theory/structure_factor > csv || exit 1
expect "all are there" sh -c "! cut -d, -f4 csv | sed 1d | grep -q '^\$'"
"$perrin" run single.yaml --quiet --threads 1 --set theory.structure.groups=1 -o once || exit 1
"$perrin" show once --csv theory/structure_factor > csv || exit 1
expect "but not of one group" sh -c "! cut -d, -f4 csv | sed 1d | grep -q ."
expect "nor on its page" sh -c "! grep -q 'leaving out parts' once/report.html"
expect "which check says" sh -c "'$perrin' check single.yaml | grep -q 'all is done up to 9 times'"

# The same numbers in files that are not the same.
rm -r fluid && "$perrin" rerun one/results.h5 --quiet -o fluid || exit 1
expect "the files differ" sh -c '! cmp -s one/results.h5 fluid/results.h5'
points=$(cksum sweep/*=*/results.h5)
one=$(cksum single/*)
run single single
expect "a single run is left alone" test "$one" = "$(cksum single/*)"
expect "what it has is told" sh -c \
    "'$perrin' run single.yaml --threads 1 -o single 2>&1 | grep -q 'perrin show single'"
run sweep sweep
expect "points with the same structure are left alone" quiet
expect "to the byte" test "$points" = "$(cksum sweep/*=*/results.h5)"
for point in sweep/*=*; do
    expect "they are not run again" test "$(grep -c finished "$point/log.txt")" = 1
done

# Other numbers.
points=$(for point in sweep/*=*; do cksum < "$point/results.h5"; done)
one=$(cksum < single/results.h5)
rm -r fluid && cp -r two fluid
run sweep sweep
expect "of a sweep it is said how many points are done again" told '2 runs are'
expect "their earlier results are kept" \
    test "$points" = "$(for point in sweep/*=*; do cat "$point"/results-of-????????.h5 | cksum; done)"
run single single
expect "and of a single run" told '1 run is'
expect "which keeps its own" test "$one" = "$(cat single/results-of-????????.h5 | cksum)"
run shear shear
expect "a checkpoint of another structure is not gone on from" grep -q 'checkpoint is of another' shear/log.txt
for theory in single sweep shear; do
    run $theory fresh-$theory
    expect "a new $theory says nothing of changes" quiet
    expect "the numbers of $theory are those of the new structure" \
        same_numbers $theory fresh-$theory
done
for point in sweep/*=*; do
    expect "log.txt tells" grep -q 'which is kept as results-of-' "$point/log.txt"
done
run sweep sweep
expect "then it is finished" quiet

# A structure that is not there: nothing is lost and nothing is said to be done.
rm -r fluid
points=$(cksum sweep/*=*/results*.h5)
"$perrin" run sweep.yaml --quiet --threads 1 -o sweep > out 2> said
expect "without a structure the sweep fails" test $? = 65
expect "and says why" grep -q 'cannot find fluid' said
expect "and keeps its results" test "$points" = "$(cksum sweep/*=*/results*.h5)"

printf 'changed: %d tests, %d failed\n' "$count" "$failed"
test "$failed" = 0
