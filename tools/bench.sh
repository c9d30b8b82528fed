#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the benchmarks and sets their results beside those recorded for this kind of processor in
# bench/results/, as ratios. Where nothing is recorded, or with --record, records them.
# Takes also the names of benchmarks to run (default: all of build/bench).
set -eu
cd "$(dirname "$0")/.."
record=
if [ "${1:-}" = --record ]; then
    record=yes
    shift
fi
machine=$(awk -F ': *' '/^model name/ { name = $2 } /^model\t/ { model = $2 }
    END { print name " model " model }' /proc/cpuinfo |
    tr '[:upper:]' '[:lower:]' | tr -cs 'a-z0-9' '-' | sed 's/^-//; s/-$//')
baseline=bench/results/$machine.csv

PERRIN_BENCH_CSV=$(mktemp)
export PERRIN_BENCH_CSV
trap 'rm -f "$PERRIN_BENCH_CSV"' EXIT
[ $# -gt 0 ] || set -- build/bench/bench_*
for program; do
    echo "== $(basename "$program")"
    "$program"
done

if [ -s "$baseline" ]; then
    echo
    echo "now / $baseline"
    awk -F, '
        NR == FNR { if (FNR > 1) before[$1] = $2; next }
        {
            if ($1 in before) printf "%-48s %12.4g %-40s %8.3f\n", $1, $2, $3, $2 / before[$1]
            else printf "%-48s %12.4g %-40s %8s\n", $1, $2, $3, "new"
        }' "$baseline" "$PERRIN_BENCH_CSV"
fi
if [ ! -s "$baseline" ] || [ -n "$record" ]; then
    mkdir -p bench/results
    { echo "name,value,unit" && cat "$PERRIN_BENCH_CSV"; } >"$baseline"
    echo "recorded in $baseline"
fi
