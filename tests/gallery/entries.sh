#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every point of every gallery entry, quick and full, is a run file that passes its checks, and each
# entry has all its files. Takes the program and the gallery; runs no dynamics.
set -u
perrin=$1 gallery=$2
failed=0
for entry in "$gallery"/*/; do
    for file in README.md run.yaml full.txt points.csv measures.csv expected.csv figure.gp; do
        [ -s "$entry$file" ] || { echo "$entry$file is missing"; failed=1; }
    done
    full=$(grep -v '^#' "$entry/full.txt" | tr '\n' ' ')
    points=$(grep -v -e '^#' -e '^point,' "$entry/points.csv" | cut -d, -f4,5 |
        sed -e 's/ /;/g' -e 's/^$/-/' -e 's/^,/-,/')
    for point in $points; do
        settings=$(echo "${point%%,*}" | sed 's/{results}/results/' | tr ';' ',')
        # A run file of its own reads what points before it give, which is not there.
        case $point in *,?*) file=${point#*,} all=--all ;; *) file=run.yaml all= ;; esac
        for more in "" "$full"; do
            [ "$file" = run.yaml ] || more=
            set --
            for setting in $(echo "$settings" | tr ',' ' ') $more; do
                [ "$setting" = - ] || set -- "$@" --set "$setting"
            done
            "$perrin" check $all "$entry/$file" "$@" >/dev/null || { echo "in $entry: $*"; failed=1; }
        done
    done
done
exit $failed
