#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# examples.sh PROGRAM EXAMPLE: the run file of an example passes its checks as it is, and runs to its
# end with two replicas and a quarter of every stage's time; the report has no empty place, that of a
# theory says nothing of replicas, and `perrin explain` knows all that was measured, by the sentences that
# the results have.
set -eu
perrin=$1 example=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$perrin" check "$example/run.yaml" >"$work/check"

# stage     sheared          event-driven, 3 d^2/D0 in 60000 steps of 5e-05, to a strain of 3
# stage     settle           newtonian, 200 d sqrt(m/kT) in 20000 steps of 0.01
set --
for setting in $(awk '$1 == "stage" {
    if (/to a strain of/) printf "protocol.%s.strain=%.6g\n", $2, $NF / 4
    else printf "protocol.%s.time=%.6g\n", $2, $4 / 4 }' "$work/check"); do
    set -- "$@" --set "$setting"
done
if [ $# -gt 0 ]; then set -- "$@" --set ensemble.replicas=2; fi # a theory has none

"$perrin" run "$example/run.yaml" -o "$work/run" --quiet "$@"
"$perrin" show "$work/run" >"$work/shown"
test -s "$work/shown"
test -s "$work/run/report.html"
if grep -q 'No figure' "$work/run/report.html"; then
    echo "figures are missing in the report"
    exit 1
fi
if [ -n "$(command -v gnuplot)" ] && ! grep -q '<figure>' "$work/run/report.html"; then
    echo "the report has no figure"
    exit 1
fi
if [ $# -eq 0 ] && grep -q 'replica' "$work/run/report.html"; then
    echo "the report of a theory speaks of replicas"
    exit 1
fi

# Of every number and series its meaning and unit can be asked for without the run. Stresses of a
# schematic model are in units of its modulus. The sentence of a series of a simulation is the same there,
# unless it names what the run alone knows.
"$perrin" show "$work/run" --json | awk -F'"' '
    /^  "series": / {series = 1}
    /^    "[^"]*": \{/ && $2 ~ "/" {name = $2}
    name && match($0, /"unit": "[^"]*"/) {
        unit = substr($0, RSTART + 9, RLENGTH - 10)
        about = match($0, /"about": "[^"]*"/) && series ? substr($0, RSTART + 10, RLENGTH - 11) : ""
        print name "|" unit "|" about
        name = ""
    }' >"$work/names"
test -s "$work/names"
while IFS='|' read -r name unit about; do
    if ! "$perrin" explain "$name" >"$work/said" 2>&1; then
        echo "perrin explain does not know $name"
        exit 1
    fi
    case $name in schematic/*) continue ;; esac
    if ! grep -qF -e " ${unit:-without unit}," -e " $unit or " "$work/said"; then
        echo "perrin explain says another unit of $name than its run, $unit:"
        cat "$work/said"
        exit 1
    fi
    case $name in theory/* | *_time_shift | *_change | */structure_peak | *_scattering_centred) continue ;; esac
    if ! grep -qF -e "$about" "$work/said"; then
        echo "perrin explain says something else of $name than its run: $about"
        cat "$work/said"
        exit 1
    fi
done <"$work/names"
