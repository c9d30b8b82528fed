#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Same bits: the run of a run file of this folder gives the same results and the same trajectories,
# byte for byte, however it is made. golden.sh BUILD WHAT [NAME], where NAME.yaml is the run file
# (binary if none is given) and WHAT is one of
#   threads       1, 2 and 5 threads
#   vectors       portable, AVX2 and AVX-512 kernels
#   resume        ended by SIGTERM again and again, and resumed
#   kills         the same by SIGKILL: goes on from the last checkpoint
#   compilers     gcc and clang, with and without optimisation (builds them in BUILD/golden-*);
#                 a build made as BUILD was gives the same libperrin.a
#   recorded      the trajectory recorded in recorded.txt
#   record        writes its line of recorded.txt anew
set -eu
build=$(cd "$1" && pwd)
what=$2
name=${3:-binary}
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
work=$build/golden/$what-$name
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() {
    echo "golden: $1" >&2
    exit 1
}

perrin=$build/perrin
golden_run() { # DIR FLAGS...
    directory=$1
    shift
    "$perrin" run "$here/$name.yaml" -o "$directory" --quiet "$@" >"$directory.out" 2>&1
}

# All that the physics has a say in: the numbers, not who made them and when.
results() { "$build/perrin" show "$1" --json | sed '/"run": {/,/^  }/d'; }

same_as_reference() { # DIR
    results "$1" >"$1.json"
    cmp reference.json "$1.json" || fail "results of '$1' are not those of the reference"
    for file in reference/trajectory/*.h5; do
        cmp "$file" "$1/trajectory/${file##*/}" || fail "trajectories of '$1' differ"
    done
    echo "$1: same bits"
}

# Version, commit, compiler and flags are those of BUILD.
same_recipe() { [ "$("$build/perrin" version)" = "$("$1/perrin" version)" ]; }

golden_run reference --threads 1 || fail "$(cat reference.out)"
results reference >reference.json
grep -q quiescent reference.json || fail "the reference has no results"

case $what in
threads)
    for threads in 2 5; do
        golden_run "threads-$threads" --threads $threads || fail "$(cat threads-$threads.out)"
        same_as_reference "threads-$threads"
    done
    ;;
vectors)
    for path in portable avx2 avx512; do
        PERRIN_CPU=$path golden_run $path --threads 2 || fail "$(cat $path.out)"
        same_as_reference $path
    done
    ;;
resume | kills)
    # Ended later at every attempt, so that a slow machine comes to an end as well. A signal that
    # comes before the program can take it just kills. In the foreground, since timeout would else
    # be killed as well and not wait until the run has let go of its lock.
    signal=TERM
    if [ "$what" = kills ]; then signal=KILL; fi
    resumed=0
    status=75
    for attempt in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
        status=0
        timeout --foreground -s $signal --preserve-status "$(echo "$attempt" | awk '{ print 0.05 * $1 }')" \
            "$perrin" run "$here/$name.yaml" -o resumed --quiet --threads 2 >resumed.out 2>&1 ||
            status=$?
        case $status in
        0) break ;;
        75 | 137) resumed=$((resumed + 1)) ;;
        143) ;;
        *) fail "exit $status: $(cat resumed.out)" ;;
        esac
    done
    if [ $status -ne 0 ]; then golden_run resumed --threads 2 || fail "$(cat resumed.out)"; fi
    [ $resumed -gt 0 ] || fail "the run was never interrupted"
    same_as_reference resumed
    echo "after $resumed interruptions"
    ;;
compilers)
    for compiler in gcc clang-14; do
        for type in Debug Release; do
            other=$build/golden-$compiler-$type
            CC=$compiler cmake -S "$source" -B "$other" -G "Unix Makefiles" -DPERRIN_TESTS=OFF \
                -DCMAKE_BUILD_TYPE=$type >"$other.log" 2>&1 || fail "$(tail -n 20 "$other.log")"
            make -s -C "$other" perrin -j"$(nproc)" >"$other.log" 2>&1 || fail "$(tail -n 20 "$other.log")"
            perrin=$other/perrin
            golden_run $compiler-$type --threads 2 || fail "$(cat $compiler-$type.out)"
            same_as_reference $compiler-$type
            if same_recipe "$other"; then
                cmp "$build/libperrin.a" "$other/libperrin.a" || fail "two builds, two libraries"
                echo "$compiler-$type: the same library, byte for byte"
            fi
        done
    done
    ;;
recorded | record)
    hash=$("$build/tests/golden/frame_hash" reference/trajectory/*.h5)
    if [ "$what" = record ]; then
        sed -i "/^$name /d" "$here/recorded.txt"
        echo "$name $hash" >>"$here/recorded.txt"
    fi
    grep -qx "$name $hash" "$here/recorded.txt" ||
        fail "the trajectory has changed: its hash is $hash; tests/golden/README.md says what to do"
    echo "the recorded trajectory"
    ;;
*) fail "what is '$what'?" ;;
esac
