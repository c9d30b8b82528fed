#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the lines of a table through the program: run.sh PERRIN TABLE. A test is two lines,
#     CODE ARGUMENTS
#     what must be on standard error, to the letter ("-": nothing; "..." stands for any text)
# run in a copy of broken/, where no test may leave or change a file. A failed command may not
# write to standard output.
set -u
LC_ALL=C
export LC_ALL
absolute() { printf '%s/%s' "$(cd "$(dirname "$1")" && pwd)" "$(basename "$1")"; }
perrin=$(absolute "$1")
table=$(absolute "$2")
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/work" && cp "$here"/broken/*.yaml "$scratch/work" && cd "$scratch/work" || exit 1

# What cannot be kept as a text file.
: > empty.yaml
printf 'title: a\000b\n' > nul.yaml
printf '\177ELF\002\001\001\000' > binary.yaml
printf 'title: Gr\366\337e\n' > latin1.yaml
printf 'title: \300\200\n' > overlong.yaml
printf '\377\376t\000i\000' > utf16.yaml
head -c 2000000 /dev/zero | tr '\0' '#' > huge.yaml
printf '# time, rate\n0, 1\n\n1, fast\n' > rates-broken.csv
mkdir folder.yaml
before=$(ls -lR . | cksum)

failed=0
count=0
fail() {
    failed=$((failed + 1))
    printf 'FAILED: perrin %s\n' "$arguments"
    printf '  %s\n' "$@"
}

# Does $1 match $2, in which "..." stands for any text?
matches() {
    case $2 in
    *...*) case $1 in "${2%%...*}"*"${2#*...}") return 0 ;; *) return 1 ;; esac ;;
    *) test "$1" = "$2" ;;
    esac
}

while read -r code arguments && IFS= read -r wanted; do
    count=$((count + 1))
    eval "\"\$perrin\" $arguments" > "$scratch/out" 2> "$scratch/err" < /dev/null
    got=$?
    said=$(cat "$scratch/err")
    test "$wanted" = "-" && wanted=
    test "$got" = "$code" || fail "exit code $got, wanted $code" "$said"
    matches "$said" "$wanted" || fail "said:   $said" "wanted: $wanted"
    test "$code" = 0 || test ! -s "$scratch/out" || fail "wrote to standard output"
done < "$table"

arguments=$table
test "$count" -gt 0 || fail "the table holds no test"
test "$before" = "$(ls -lR . | cksum)" || fail "a test left or changed a file"
printf '%s: %d tests, %d failed\n' "$(basename "$table")" "$count" "$failed"
test "$failed" = 0
