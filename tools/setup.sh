#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the packages of tools/packages.txt that are missing, of the groups given;
# does nothing, and needs no network, when all is there. Uses root or sudo; where neither is to be
# had it names what is missing and stops.
set -eu
table=$(dirname "$0")/packages.txt

missing=
while read -r group package probe; do
    case $group in '' | '#'*) continue ;; esac
    case " $* " in *" $group "*) ;; *) continue ;; esac
    sh -c "$probe" </dev/null >/dev/null 2>&1 || missing="$missing $package"
done <"$table"
[ -n "$missing" ] || exit 0

stop() {
    echo "setup: missing:$missing (Debian's names)" >&2
    echo "setup: $1" >&2
    exit 1
}

command -v apt-get >/dev/null ||
    stop "this is not Debian: please install these as your system names them, then try again"
if [ "$(id -u)" -eq 0 ]; then
    as_root=env
elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || { [ -t 0 ] && sudo -v; }; }; then
    as_root='sudo env'
else
    stop "neither root nor sudo here: someone who is root must run apt-get install$missing"
fi

echo "setup: installing$missing"
install() {
    # shellcheck disable=SC2086 # words on purpose
    $as_root DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        $missing </dev/null >"$log" 2>&1
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# A fresh machine has no package lists, or old ones that name files no longer there.
install || { $as_root apt-get update -qq </dev/null >"$log" 2>&1 && install; } || {
    cat "$log" >&2
    stop "apt-get could not install them, see above"
}
