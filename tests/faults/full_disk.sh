#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# full_disk.sh PROGRAM SAME: a limit on the size of files, and a file system of a few kilobytes:
# the run ends in exit code 74 with path and reason, and once there is room it resumes and ends
# in the data of an undisturbed run.
PROGRAM=$1 SAME=$2
. "$(dirname "$0")/common.sh"

reference
full=0 fitted=0

judge() { # NAME CODE DIR
    case $2 in
    0) fitted=$((fitted + 1)) ;;
    74)
        full=$((full + 1))
        grep -Eq "error: .*$3.*: (File too large|No space left on device)" "$work/err" ||
            fail "$1: neither path nor reason: $(cat "$work/err")"
        ;;
    *) fail "$1: exit code $2: $(cat "$work/err")" ;;
    esac
}

resumes() { # NAME DIR
    if start "$2" >"$work/out" 2>&1; then
        same "$2" "$work/reference" || fail "$1: the resume ends in other data"
    else
        fail "$1: the resume fails: $(cat "$work/out")"
    fi
}

# In blocks of 512 bytes: from nothing to more than the largest file.
for blocks in 0 1 2 4 6 8 12 16 32 64 96 120 128 132 136 140 144 152 160 176 192 224 256 4096; do
    rm -rf "$work/run"
    code=0
    (
        ulimit -f $blocks
        start "$work/run"
    ) >"$work/out" 2>"$work/err" || code=$?
    # Where even the sentence does not fit into the file that stderr is, there is none.
    [ $blocks -eq 0 ] && [ $code -eq 74 ] && [ ! -s "$work/err" ] && echo "error: $work/run: File too large" >"$work/err"
    judge "limit of $blocks blocks" $code "$work/run"
    resumes "limit of $blocks blocks" "$work/run"
done
[ $full -ge 5 ] && [ $fitted -ge 1 ] || fail "$full limits were felt, $fitted were not"
limited=$full

# A small file system needs a mount of our own.
small=$work/small
mkdir "$small"
if ! unshare -rm true 2>/dev/null && ! { [ "$(id -u)" -eq 0 ] && unshare -m true 2>/dev/null; }; then
    echo "no mount of our own: the full file system is left out"
    finish "$limited limits on files felt"
fi
unshare -rm true 2>/dev/null && private="unshare -rm" || private="unshare -m"
export PROGRAM SAME work small
cat >"$work/inside.sh" <<'END'
mount -t tmpfs -o size="$1" tmpfs "$small" || exit 1
if [ -e "$work/run.yaml" ]; then
    "$PROGRAM" run "$work/run.yaml" -o "$small/run" --threads 1 --quiet >"$work/out" 2>"$work/err"
else
    "$PROGRAM" "$small/run" 4 50 >"$work/out" 2>"$work/err"
fi
code=$?
rm -rf "$work/kept"
cp -a "$small/run" "$work/kept" 2>/dev/null || mkdir "$work/kept"
exit $code
END
for size in 4k 8k 16k 32k 64k 96k 128k 160k 192k 224k 256k 288k 320k 384k 448k 512k 4m; do
    code=0
    $private sh "$work/inside.sh" $size || code=$?
    judge "a disk of $size" $code "$small/run"
    [ ! -d "$work/kept" ] || resumes "a disk of $size" "$work/kept"
done
[ $full -ge $((limited + 5)) ] || fail "only $((full - limited)) disks were full"
finish "$limited limits on files and $((full - limited)) full disks felt, $fitted runs fitted"
