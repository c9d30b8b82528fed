#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs BUILD under a prefix with a blank in its name, builds the example program against it as
# C and as C++ by pkg-config and by CMake, and runs it; the header must do on its own; the library
# must show no name but its own.
set -eu
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
example=$(cd "$here/../../examples/library" && pwd)
work=$build/install-test
rm -rf "$work"
mkdir -p "$work"
cd "$work"
prefix="$work/the prefix"

fail() {
    echo "install: $1" >&2
    exit 1
}

cmake --install "$build" --prefix "$prefix" >install.log || fail "$(cat install.log)"
"$prefix/bin/perrin" version >/dev/null

PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
export PKG_CONFIG_PATH
libs=$(pkg-config --libs perrin)
strict="-Wall -Wextra -Wpedantic -Werror"

for standard in c11 c17; do
    echo '#include <perrin/perrin.h>' >header.c
    eval "gcc -std=$standard $strict $(pkg-config --cflags perrin) -c header.c -o header.o" ||
        fail "the header is not $standard on its own"
done
for standard in c++11 c++17; do
    eval "g++ -std=$standard $strict -x c++ $(pkg-config --cflags perrin) -c header.c -o header.o" ||
        fail "the header is not $standard on its own"
done

try() { # PROGRAM: it runs and says what it should
    "./$1" "$here/run.yaml" "$1-run" >"$1.out" 2>"$1.err" || fail "$1: $(cat "$1.err")"
    grep -q '^quiescent/long_time_diffusion.* = ' "$1.out" || fail "$1 printed: $(cat "$1.out")"
}
eval "gcc -std=c11 $strict $(pkg-config --cflags perrin) '$example/diffusion.c' $libs -o as-c"
try as-c
eval "g++ -std=c++17 $strict -x c++ $(pkg-config --cflags perrin) '$example/diffusion.c' -x none \
    $libs -o as-cpp"
try as-cpp
cmake -S "$example" -B cmake-build -DCMAKE_PREFIX_PATH="$prefix" >cmake.log 2>&1 &&
    make -s -C cmake-build >>cmake.log 2>&1 || fail "$(cat cmake.log)"
cp cmake-build/diffusion by-cmake
try by-cmake
cmp as-c.out as-cpp.out && cmp as-c.out by-cmake.out || fail "three programs, three results"

# A series with as many axes as there are.
sed 's/observe: \[.*\]/observe: [self_scattering: {wave_numbers: [3, 5], waiting_times: [0, 0.1]}]/' \
    "$here/run.yaml" >series.yaml
"$prefix/bin/perrin" run series.yaml -o series-run --quiet >series.out 2>&1 || fail "$(cat series.out)"
eval "gcc -std=c11 $strict $(pkg-config --cflags perrin) '$here/series.c' $libs -o series"
./series series-run/results.h5 quiescent/self_scattering 5 || fail "a series by the library is not what it is"

# In a program that writes 0,5 for a half, ours are as ever.
printf '%s\n' 'comment_char %' 'escape_char /' LC_NUMERIC 'decimal_point ","' 'thousands_sep ""' \
    'grouping -1' 'END LC_NUMERIC' >comma.src
localedef -c -i ./comma.src ./comma >locale.log 2>&1 || true # it misses the other categories
if [ -f comma/LC_NUMERIC ]; then
    eval "gcc -std=c11 $strict $(pkg-config --cflags perrin) '$here/comma.c' $libs -o comma-program"
    numbers() { # of DIR, without times and speeds
        (cd "$1" && cat plan.yaml figures/*.gp figures/*.csv &&
            sed -n '/<h1>/,/<h2>Health/p' report.html | sed 's/finished [0-9TZ:-]*//')
    }
    ./comma-program C "$here/run.yaml" point-run >point.out || fail "a program in C's locale: $(cat point.out)"
    LOCPATH=$work ./comma-program comma "$here/run.yaml" comma-run >comma.out ||
        fail "a program with decimal commas: $(cat comma.out)"
    [ "$(tail -n 1 comma.out)" = 0,5 ] || fail "the library changed the locale of its program"
    [ "$(head -n 1 point.out)" = "$(head -n 1 comma.out)" ] || fail "a comma: $(head -n 1 comma.out)"
    numbers point-run >point.txt
    numbers comma-run >comma.txt
    cmp point.txt comma.txt || fail "decimal commas in what the library wrote"
else
    echo "install: no localedef here, decimal commas not tried"
fi

names=$(nm -g --defined-only "$prefix/lib/libperrin.a" | awk 'NF == 3 { print $3 }' | grep -v '^perrin_') || true
[ -z "$names" ] || fail "the library shows names that are not its own: $names"
echo "installed, linked as C, as C++ and by CMake, and run: $(cat as-c.out)"
