#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# commit.sh SCRIPT: what a build says of its source follows the source, without configuring anew.
set -eu
script=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
say() {
    cmake -DSOURCE="$folder/source" -DHEADER="$folder/commit.h" -P "$script"
    sed 's/.*PERRIN_COMMIT "\(.*\)"/\1/' "$folder/commit.h"
}
expect() {
    said=$(say)
    [ "$said" = "$1" ] || { echo "expected $1, said $said"; exit 1; }
}
git_in() {
    git -C "$folder/source" -c user.name=n -c user.email=e -c init.defaultBranch=main "$@"
}
mkdir "$folder/source"
GIT_CEILING_DIRECTORIES=$folder
export GIT_CEILING_DIRECTORIES
expect unknown
git_in init -q
echo 1 > "$folder/source/file"
git_in add file
git_in commit -q -m one
first=$(git_in rev-parse --short=12 HEAD)
expect "$first"
written=$(stat -c %Y.%i "$folder/commit.h")
expect "$first"
[ "$(stat -c %Y.%i "$folder/commit.h")" = "$written" ] || { echo "written again"; exit 1; }
echo 2 > "$folder/source/file"
expect "$first-modified"
git_in commit -q -a -m two
expect "$(git_in rev-parse --short=12 HEAD)"
