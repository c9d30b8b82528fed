#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every point of every gallery entry, quick and full, is a run file that passes its checks, and each
# entry has all its files. Takes the program and the gallery; runs no dynamics.
set -u
perrin=$1 gallery=$2
failed=0

# points.csv: a line per point, its run file, its settings and those of its full run. Commas within
# quotes are theirs.
points() {
    awk '!/^#/ && !/^point,/ {
        split("", field)
        n = 1
        quoted = 0
        for (i = 1; i <= length($0); i++) {
            c = substr($0, i, 1)
            if (c == "\"") quoted = !quoted
            else if (c == "," && !quoted) n++
            else field[n] = field[n] c
        }
        print (field[5] == "" ? "run.yaml" : field[5]) "|" field[4] "|" field[6]
    }' "$1"
}

for entry in "$gallery"/*/; do
    set -f # settings hold lists in brackets
    for file in README.md run.yaml full.txt points.csv measures.csv expected.csv figure.gp; do
        [ -s "$entry$file" ] || { echo "$entry$file is missing"; failed=1; }
    done
    grep -q '{/Symbol' "${entry}figure.gp" &&
        { echo "${entry}figure.gp: browsers have no font Symbol; write the letter"; failed=1; }
    full=$(grep -v '^#' "${entry}full.txt" | tr '\n' ' ')
    while IFS='|' read -r file settings own; do
        # A run file of its own reads what points before it give, which is not there.
        all=
        [ "$file" = run.yaml ] || all=--all
        [ "$file" = run.yaml ] && own="$full $own"
        for more in "" "$own"; do
            set --
            for setting in $(echo "$settings" | sed 's/{results}/results/') $more; do
                set -- "$@" --set "$setting"
            done
            "$perrin" check $all "$entry$file" "$@" >/dev/null </dev/null ||
                { echo "in $entry: $*"; failed=1; }
        done
    done <<END
$(points "${entry}points.csv")
END
done
exit $failed
