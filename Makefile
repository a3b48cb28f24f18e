# SPDX-License-Identifier: Apache-2.0
# The short way in. Everything real is in CMakeLists.txt, CMakePresets.json and tools/.
#
# JOBS=N       parallel jobs (default: all processors)
# CMAKE_FLAGS  handed to the configure step, e.g. CMAKE_FLAGS=-DGNOMON_WERROR=ON
# CTEST_FLAGS  handed to ctest, e.g. CTEST_FLAGS='-R core'
# FUZZ_SECONDS how long `make fuzz` runs (default 60)
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
JOBS ?= $(shell nproc)
CTEST_JOBS ?= $(JOBS)
FUZZ_SECONDS ?= 60
PICTURE := $(CURDIR)/out/rts.png
COMPARISON := $(CURDIR)/out/compare

.PHONY: help
help:
	@echo "make demo    install what is missing, build, render the built-in rts world, compare its shadows with the truth"
	@echo "make test    install what is missing, build, run every test"
	@echo "make check   layout, headers that stand alone, include rules, forbidden words"
	@echo "make tidy    clang-tidy over all C++ sources (minutes)"
	@echo "make asan    build and run the tests with address and undefined behaviour sanitizers, in build-asan/"
	@echo "make fuzz    run the glTF reader's fuzzer for FUZZ_SECONDS (60), in build-fuzz/"
	@echo "make clean   remove build folders and out/"

.PHONY: packages
packages:
	@tools/install_packages.sh packages.txt

.PHONY: configure
configure: packages
	@cmake --preset release $(CMAKE_FLAGS)

.PHONY: demo
demo: configure
	@cmake --build build --target gnomon -j $(JOBS)
	@mkdir -p out
	@build/gnomon render rts --preset demo -o $(PICTURE)
	@echo "The picture is $(PICTURE)"
	@echo "Holding the techniques against ray-traced truth"
	@build/gnomon compare rts --camera camp --size 640x360 --samples 64 --repetitions 3 --warmup 1 \
	    --report $(COMPARISON)
	@echo "The pictures of the comparison are in $(COMPARISON); open $(COMPARISON)/index.html"

.PHONY: build
build: configure
	@cmake --build build -j $(JOBS)

.PHONY: test
test: build
	@ctest --test-dir build --output-on-failure --no-tests=error -j $(CTEST_JOBS) $(CTEST_FLAGS)

.PHONY: check
check: packages
	@tools/check_format.sh
	@tools/check_includes.py
	@tools/check_text.py
	@cmake --preset release $(CMAKE_FLAGS) >/dev/null
	@cmake --build build -j $(JOBS) --target gnomon_spirv gnomon_host_spirv >/dev/null
	@tools/check_headers.py --build build -j $(JOBS)

.PHONY: tidy
tidy: packages
	@cmake --preset release $(CMAKE_FLAGS) >/dev/null
	@cmake --build build -j $(JOBS) --target gnomon_spirv gnomon_host_spirv >/dev/null
	@tools/tidy.py --build build -j $(JOBS)

.PHONY: asan
asan: packages
	@cmake --preset asan $(CMAKE_FLAGS)
	@cmake --build build-asan -j $(JOBS)
	@source tools/sanitizers.sh && ctest --test-dir build-asan --output-on-failure --no-tests=error \
	    -j $(CTEST_JOBS) $(CTEST_FLAGS)

.PHONY: fuzz
fuzz: packages
	@tools/fuzz.sh $(FUZZ_SECONDS) $(JOBS)

.PHONY: clean
clean:
	rm -rf build build-asan build-ci build-debug build-fuzz out
