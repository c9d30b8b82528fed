#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs each libFuzzer target of a build folder for some seconds, from the seeds in
# tests/fuzz/corpus/TARGET if there are any; keeps what it learned in the build folder. Fails, and
# libFuzzer says where the input lies, as soon as one target finds a fault.
set -eu
build=$(cd "$1" && pwd)
seconds=$2
cd "$(dirname "$0")/.."
seeds=$PWD/tests/fuzz/corpus
for target in "$build"/tests/fuzz/fuzz_*; do
    [ -f "$target" ] && [ -x "$target" ] || continue
    name=$(basename "$target")
    mkdir -p "$build/corpus/$name"
    set -- "$build/corpus/$name"
    if [ -d "$seeds/$name" ]; then set -- "$@" "$seeds/$name"; fi
    echo "== $name for $seconds s"
    (cd "$build" && "$target" -max_total_time="$seconds" -print_final_stats=1 -timeout=10 \
        -rss_limit_mb=2048 "$@" 2>"$name.log") || {
        tail -n 60 "$build/$name.log" >&2
        exit 1
    }
    grep -E 'stat::(number_of_executed_units|new_units_added)' "$build/$name.log"
done
