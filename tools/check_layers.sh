#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Holds every include of src/ and app/ against src/layers.txt, and every parameter that could change
# a State. Prints FILE:LINE: what; fails if there is anything to print.
set -eu
cd "$(dirname "$0")/.."

find src app -name '*.[ch]' | sort | xargs awk '
    function list(table, key, words,    word, n, i) {
        n = split(words, word, " ")
        for (i = 1; i <= n; i++) table[key, word[i]] = 1
    }
    function complain(what) { print FILENAME ":" FNR ": " what; bad = 1 }

    FILENAME == "src/layers.txt" {
        if (!/^[a-z]/) next
        colon = index($0, ":")
        split(substr($0, 1, colon - 1), head, " ")
        rest = substr($0, colon + 1)
        if (head[1] == "layer") { known[head[2]] = 1; list(may, head[2], rest) }
        if (head[1] == "public") list(open, head[2], rest)
        if (head[1] == "only") { owned[head[2]] = 1; list(owner, head[2], rest) }
        if (head[1] == "changes") list(changes, head[2], rest)
        next
    }

    FNR == 1 {
        split(FILENAME, part, "/")
        module = part[1] == "app" ? "app" : part[2]
        if (module != "app" && !(module in known))
            complain("src/layers.txt does not know the module " module)
    }

    /^#include "/ {
        split($0, quoted, "\"")
        if (split(quoted[2], path, "/") < 2) {
            if (module != "app") complain("\"" quoted[2] "\" should be included as MODULE/FILE")
            next
        }
        other = path[1]
        if (other == "perrin" || other == module) next
        if (!(other in known)) complain("there is no module " other)
        else if (module != "app" && !((module, other) in may) && !((module, "*") in may))
            complain("module " module " may not use " other)
        else if (path[2] != other ".h" && !((other, path[2]) in open) && !((other, "*") in open))
            complain(quoted[2] " is inside " other)
    }

    /^#include </ {
        name = $2
        gsub(/[<>]/, "", name)
        if ((name in owned) && !((name, module) in owner)) complain("module " module " may not know " name)
    }

    # Parameters and casts; a local variable is followed by ";" or "=".
    /(^|[(,]) *(struct )?State \*[a-z_]*[,)]/ && !(("State", module) in changes) {
        complain("only packing and the propagators may change a State: const State *")
    }

    END { exit bad }
' src/layers.txt || { echo "layers: includes that src/layers.txt does not allow" >&2; exit 1; }
echo "layers: as src/layers.txt says"
