# SPDX-License-Identifier: GPL-3.0-or-later
# The commands a person types; the build itself is described in CMakeLists.txt.
#   make setup     install what is missing (Debian packages, tools/packages.txt)
#   make           build build/perrin
#   make demo      run the first example and print its main numbers
#   make test      all tests and checks
#   make check     style, layers, prefixes
#   make bench     speed, beside the recorded speed of this machine
#   make sanitize  unit tests under address and undefined-behaviour sanitizers
#   make fuzz      FUZZ_SECONDS=600 each of hostile run files and checkpoints
#   make install   PREFIX=/usr/local
#   make clean

PREFIX = /usr/local
FUZZ_SECONDS = 600

# Every target in turn; what runs in parallel is the building: on all processors, or as -j says.
.NOTPARALLEL:
.PHONY: build build-tests setup demo test check bench sanitize fuzz install clean help
CONFIGURE = cmake -S . -G "Unix Makefiles"
PARALLEL = $(if $(findstring jobserver,$(MAKEFLAGS)),,-j$(shell nproc))

build:
	@tools/setup.sh build
	@$(CONFIGURE) -B build >/dev/null
	@$(MAKE) -s -C build $(PARALLEL) perrin perrin-public

build-tests:
	@tools/setup.sh build test
	@$(CONFIGURE) -B build -DPERRIN_TESTS=ON >/dev/null
	@$(MAKE) -s -C build $(PARALLEL)

setup:
	@tools/setup.sh build test

demo: build
	@tools/demo.sh

test: build-tests
	@cd build && ctest --output-on-failure --no-tests=error -j$(shell nproc)

check: build-tests
	@tools/check_style.sh
	@tools/check_layers.sh
	@tools/check_prefixes.sh build

bench: build-tests
	@tools/bench.sh

sanitize:
	@tools/setup.sh build test
	@CC=clang-14 $(CONFIGURE) -B build-sanitize -DCMAKE_BUILD_TYPE=Debug \
	    -DPERRIN_SANITIZE=address,undefined >/dev/null
	@$(MAKE) -s -C build-sanitize $(PARALLEL)
	@cd build-sanitize && ctest --output-on-failure --no-tests=error -L unit -j$(shell nproc)

fuzz:
	@tools/setup.sh build test
	@CC=clang-14 $(CONFIGURE) -B build-fuzz -DCMAKE_BUILD_TYPE=Debug -DPERRIN_FUZZ=ON \
	    -DPERRIN_SANITIZE=address,undefined >/dev/null
	@$(MAKE) -s -C build-fuzz $(PARALLEL) fuzz-targets
	@tools/fuzz.sh build-fuzz $(FUZZ_SECONDS)

install: build
	@cmake --install build --prefix "$(PREFIX)"

clean:
	@rm -rf build build-sanitize build-fuzz

help:
	@sed -n 's/^#   //p' Makefile
