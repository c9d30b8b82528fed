#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the first example anew in build/demo and prints its main numbers, as `perrin show` gives
# them, beside the equation of state.
set -eu
cd "$(dirname "$0")/.."
example=examples/01-binary-hard-discs
directory=build/demo
set -- "$example"/*.yaml
rm -rf "$directory"

echo "build/perrin run $1 -o $directory"
build/perrin run "$1" -o "$directory"
echo
build/perrin show "$directory" | awk '
    function trim(text) { sub(/^ +/, "", text); sub(/ +$/, "", text); return text }
    NR == 1 { # the columns of the table begin where their titles do
        value = index($0, "value"); unit = index($0, "unit"); n = index($0, " n ") + 1
        about = index($0, "about")
        next
    }
    NF == 0 || /^series / { exit } # series follow
    {
        name = trim(substr($0, 1, value - 1))
        stage = name
        sub(/\/.*/, "", stage)
        sub(/.*\//, "", name)
        if (name ~ /^long_time_diffusion/) measured = stage
        shown = trim(substr($0, value, unit - value))
        if (shown !~ /\(/) shown = sprintf("%.5g", shown) # exact, or the same in all replicas
        number[stage, name] = sprintf("%-16s %s", shown, trim(substr($0, unit, n - unit)))
        if (substr($0, about) ~ /^Upper bound/) # of a slope still falling at the last lag
            number[stage, name] = number[stage, name] "  (upper bound)"
        order[++rows] = name
    }
    function line(name, words) {
        if ((measured, name) in number) printf "%-40s %s\n", words, number[measured, name]
    }
    END {
        line("compressibility_factor", "P V/(N kT) from collisions")
        line("compressibility_factor_contact", "P V/(N kT) from contact values")
        line("compressibility_factor_theory", "P V/(N kT) of the equation of state")
        for (i = 1; i <= rows; i++) {
            if (order[i] !~ /^(short|long)_time_diffusion/ || done[order[i]]++) continue
            words = order[i]
            gsub(/_/, " ", words)
            line(order[i], words)
        }
        line("collisions_per_step", "collisions per particle and interval")
    }'
build/perrin show "$directory" --json |
    sed -n 's/^ *"ns_per_particle_tick": "\([^"]*\)".*/speed                                    \1            ns per particle and interval/p'
echo
echo "all numbers: build/perrin show $directory"
echo "figures:     $directory/report.html"
