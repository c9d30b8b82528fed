# SPDX-License-Identifier: GPL-3.0-or-later
# How a test of the program begins: `.` this with the program as $1. It is then $perrin, and the
# working directory is an empty one that goes with the test.
set -u
LC_ALL=C
export LC_ALL
perrin=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
