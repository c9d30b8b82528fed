#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every external name of the library begins with the name of its module or of its file, or with a
# word that src/layers.txt gives the module. Takes the build folder. Prints FILE: name; fails if
# there is one.
set -eu
build=$(cd "${1:-build}" && pwd)
cd "$(dirname "$0")/.."
objects=$build/CMakeFiles/libperrin.dir/src
[ -d "$objects" ] || { echo "prefixes: no library in $build; make build first" >&2; exit 1; }

(cd "$objects" && find . -name '*.o' | sort | xargs nm -A -g --defined-only) | awk '
    FILENAME == "src/layers.txt" {
        if (!/^names /) next
        colon = index($0, ":")
        split($0, head, /[ :]+/)
        n = split(substr($0, colon + 1), word, " ")
        for (i = 1; i <= n; i++) allowed[head[2], word[i]] = 1
        next
    }
    {
        split($1, part, "/")
        module = part[2]
        file = stem = part[3]
        sub(/\.o:.*/, "", file)
        sub(/\.c\.o:.*/, "", stem)
        sub(/_(portable|avx2|avx512)$/, "", stem)
        one = stem # sections.c has section_...
        sub(/s$/, "", one)
        name = $NF
        if (name ~ /^__(asan|odr|start|stop|sanitizer)/) next
        if (index(name "_", module "_") == 1 || index(name "_", stem "_") == 1) next
        if (index(name "_", one "_") == 1) next
        for (begin = name; begin != ""; sub(/_?[^_]*$/, "", begin)) if ((module, begin) in allowed) next
        print "src/" module "/" file ": " name
        bad = 1
    }
    END { exit bad }
' src/layers.txt - || { echo "prefixes: external names without their module in front" >&2; exit 1; }
echo "prefixes: every external name tells its module"
