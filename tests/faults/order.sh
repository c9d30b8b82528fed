#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# order.sh PROGRAM SAME SHIM: what a loss of power may take back. In the order of the calls of a
# run: no file gets its name before its bytes are synced, each new name is synced at once, and no
# checkpoint appears while frames that it counts on are not on the disk.
PROGRAM=$1 SAME=$2 SHIM=$3
. "$(dirname "$0")/common.sh"

FAULT_DIR=$work/run FAULT_TRACE=$work/trace LD_PRELOAD=$SHIM start "$work/run" >"$work/out" 2>&1 ||
    fail "the run: $(cat "$work/out")"

# The log and the report are for people: losing their last lines loses nothing.
grep -Ev '/(log\.txt|report\.html|figures)' "$work/trace" | awk '
    function folder(path) { sub(/\/[^\/]*$/, "", path); return path }
    function wrong(what) { print "call " NR ": " $0 ": " what; bad = 1 }
    { path = substr($0, length($1) + 2) }
    waiting != "" && !($1 == "sync" && path == waiting) { wrong("before the sync of " waiting); waiting = "" }
    $1 == "sync" && path == waiting { waiting = ""; folders++ }
    $1 == "write" { dirty[path] = 1 }
    $1 == "sync" { delete dirty[path]; syncs++ }
    $1 == "mkdir" { waiting = folder(path) }
    $1 == "rename" {
        names++
        if (path ".new" in dirty) wrong("its bytes are not synced")
        for (file in dirty) if (path ~ /\/checkpoint\// && file ~ /\/trajectory\//) wrong("before " file)
        waiting = folder(path)
    }
    END {
        if (waiting != "") { print "the last name is not synced"; bad = 1 }
        for (file in dirty) { print file " is not synced at the end"; bad = 1 }
        print names + 0 " names, " syncs + 0 " syncs, " folders + 0 " of them of folders"
        exit bad || names < 6
    }' >"$work/verdict" || fail "$(cat "$work/verdict")"
cat "$work/verdict"
finish "order"
