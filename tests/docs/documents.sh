#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Takes the program, a C compiler and the source folder. To bring the generated pages up to date:
#   build/perrin help --man > docs/perrin.1; build/perrin explain --manual > docs/run-file.md
set -eu
perrin=$1 compiler=$2 source=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

same() { # what the program prints, and the page that is to be it
    diff -u "$2" "$1" >&2 || { echo "$2 is not what the program prints; see $0" >&2; failed=1; }
}

"$perrin" help --man >"$scratch/perrin.1"
same "$scratch/perrin.1" "$source/docs/perrin.1"
"$perrin" explain --manual >"$scratch/run-file.md"
same "$scratch/run-file.md" "$source/docs/run-file.md"

awk '/^   ```c$/ { on = 1; next } /^   ```$/ { on = 0 } on { sub(/^   /, ""); print }' \
    "$source/ARCHITECTURE.md" >"$scratch/largest_speed.c"
[ -s "$scratch/largest_speed.c" ] || { echo "ARCHITECTURE.md has no example" >&2; failed=1; }
# Its row is not in observables.def, so it is declared here.
{
    echo '#include "observables/observables.h"'
    echo 'extern const ObservableKind observable_largest_speed;'
    cat "$scratch/largest_speed.c"
} >"$scratch/example.c"
"$compiler" -std=gnu11 -Wall -Wextra -Werror -Wno-missing-field-initializers -I"$source/src" \
    -c "$scratch/example.c" -o "$scratch/example.o" || failed=1

# Every file and folder that a page of ours links to is there.
for page in "$source"/*.md "$source"/docs/*.md "$source"/gallery/*.md "$source"/src/*/README.md; do
    grep -o '](\([^)#:]*\)' "$page" | sed 's/^](//' | grep -v -e '^$' -e '^http' | while read -r link; do
        [ -e "$(dirname "$page")/$link" ] || { echo "$page links to $link, which is not there"; }
    done
done >"$scratch/broken"
if [ -s "$scratch/broken" ]; then
    cat "$scratch/broken" >&2
    failed=1
fi
exit $failed
