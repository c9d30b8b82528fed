#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How the code reads, as far as a machine can tell: layout, first lines, length of functions,
# nothing left for later. Prints FILE:LINE: what; fails if there is anything to print.
set -eu
cd "$(dirname "$0")/.."
longest=60 # lines of a function that is no hot kernel; most are far shorter

found=$(mktemp)
trap 'rm -f "$found"' EXIT

sources() { # files of ours whose paths match one of these patterns
    for pattern; do
        find . \( -path ./build -o -path './build-*' -o -path ./out -o -path ./.git \) -prune -o \
            -type f -path "./$pattern" -print
    done | sed 's,^\./,,' | sort
}

layout() {
    sources 'src/*.[ch]' 'app/*.[ch]' 'include/*.h' 'tests/*.[ch]' 'tests/*.cpp' 'bench/*.[ch]' \
        'examples/*.[ch]' | tr '\n' '\0' | xargs -0 clang-format-14 --dry-run 2>&1 |
        sed -n 's/\(:[0-9]*\):[0-9]*: warning: .*/\1: clang-format would lay this out otherwise/p' |
        sort -u
}

# What a merge left undecided.
merges() {
    sources '*' | tr '\n' '\0' | xargs -0 grep -nE '^(<{7}|>{7}) ' | sed 's/\(:[0-9]*\):.*/\1: a merge was not decided/'
}

# The licence in one line, then what the file is for.
first_lines() {
    sources '*.[ch]' '*.cpp' '*.sh' '*.cmake' '*CMakeLists.txt' '*.def' 'Makefile' '.ci/run' |
        while read -r file; do
            awk -v file="$file" '
                NR == 1 && /^#!/ { next }
                /SPDX-License-Identifier: GPL-3.0-or-later/ { licensed = 1; next }
                /^\/\*\* @file/ { next } # for Doxygen
                { purpose = /^(\/\/|#| \*) .*[a-z]/; exit }
                END {
                    if (!licensed && file !~ /\.def$/) print file ":1: no SPDX line"
                    if (!purpose) print file ":2: no comment that says what this file is for"
                }' "$file"
        done
}

left_for_later() {
    sources '*.[ch]' '*.cpp' '*.sh' '*.def' '*.cmake' '*CMakeLists.txt' '*.md' '*.yaml' |
        tr '\n' '\0' | xargs -0 grep -nE "TO""DO|FIX""ME" | sed 's/:\([0-9]*\):.*/:\1: left for later/'
}

long_functions() {
    sources 'src/*.[ch]' 'app/*.[ch]' | tr '\n' '\0' |
        xargs -0 ctags -f - --fields=+ne --kinds-C=f --excmd=number |
        awk -F '\t' -v longest="$longest" '
            NR == FNR { if ($0 !~ /^#/) { split($0, word, " "); hot[word[1]] = 1 } next }
            {
                line = end = 0
                for (i = 4; i <= NF; i++) {
                    if ($i ~ /^line:/) line = substr($i, 6)
                    if ($i ~ /^end:/) end = substr($i, 5)
                }
                if (end - line + 1 > longest && !($2 in hot))
                    print $2 ":" line ": " $1 " is " end - line + 1 " lines long"
            }' tools/hot_kernels.txt -
}

american() {
    sources 'src/*.[ch]' 'app/*.[ch]' 'include/*.h' '*.def' '*.md' | tr '\n' '\0' |
        xargs -0 grep -niowE '[a-z_]*(neighbor|behavior|normaliz|initializ|optimiz|vectoriz|color_)[a-z_]*' |
        grep -v -e ':yaml_' -e ':PTHREAD_' | sed 's/:\([0-9]*\):\(.*\)/:\1: American spelling: \2/'
}

{ layout; merges; first_lines; left_for_later; long_functions; american; } >"$found" || true
if [ -s "$found" ]; then
    cat "$found"
    echo "style: $(wc -l <"$found") places to change" >&2
    exit 1
fi
echo "style: nothing to change"
