# SPDX-License-Identifier: Apache-2.0
# The short way in. Everything real is in CMakeLists.txt, CMakePresets.json and tools/.
#
# JOBS=N       parallel jobs (default: all processors)
# CMAKE_FLAGS  handed to the configure step, e.g. CMAKE_FLAGS=-DGNOMON_WERROR=ON
# CTEST_FLAGS  handed to ctest, e.g. CTEST_FLAGS='-R core'
# SOURCES      which sources `make sources` compiles alone besides those that may lack a header: --all, or '--since COMMIT'
# TIDY_FOLDERS what `make tidy` looks at, e.g. core/src or a source (default: all sources)
# HEADERS      what `make headers` looks at (default: all)
# PREFIX       where `make install` puts it (default /usr/local); DESTDIR goes before it
# BUILT=1      make test and make asan take what is built as it is, and build nothing
# FUZZ_SECONDS how long `make fuzz` runs, all fuzzers together (default 60)
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
JOBS ?= $(shell nproc)
CTEST_JOBS ?= $(JOBS)
# Most builds here are from nothing: many sources are compiled together. CMAKE_FLAGS=-DGNOMON_UNITY=OFF turns it off.
CONFIGURE_RELEASE := cmake --preset release -DGNOMON_UNITY=ON
# $(call RUN_TESTS,BUILD): every test that is configured there, then how many cases passed.
RUN_TESTS = rm -rf $(1)/results && mkdir $(1)/results && status=0 && \
    { ctest --test-dir $(1) --output-on-failure --no-tests=error -j $(CTEST_JOBS) \
      --output-junit $(CURDIR)/$(1)/results/ctest.xml $(CTEST_FLAGS) || status=$$?; } && \
    tools/cases.py count $(1)/results && exit $$status
FUZZ_SECONDS ?= 60
PICTURE := $(CURDIR)/out/demo.png
COMPARISON := $(CURDIR)/out/compare

.PHONY: help
help:
	@echo "make demo    install what is missing, build, draw a sundial, hold shadows of a camp against the truth"
	@echo "make test    install what is missing, build, run every test"
	@echo "make check   layout, headers and sources that stand alone, include rules, forbidden words, the list of packages"
	@echo "make check-all   all of it: check, test, asan, and what takes long (more than an hour)"
	@echo "make tidy    clang-tidy over all C++ sources (minutes)"
	@echo "make asan    build and run the tests with address and undefined behaviour sanitizers, in build-asan/"
	@echo "make fuzz    run all fuzzers in turn for FUZZ_SECONDS (60) together, in build-fuzz/"
	@echo "make install      build and install library and program under PREFIX (/usr/local); LIBRARY_ONLY=1: the library alone"
	@echo "make package      the Debian packages libgnomon0, libgnomon-dev and gnomon, in build-package/"
	@echo "make package-test install them in a bare Debian root, and build and run the examples there (needs root, minutes)"
	@echo "make bare-test    make demo and make test in a bare Debian root (needs root and a mirror, an hour)"
	@echo "make site    documents, gallery and API reference as a site, in build/site/; install what it takes"
	@echo "make playground   the site's page on which techniques are tried, in build/playground/"
	@echo "make kit     every shader pass as SPIR-V, GLSL, ESSL, HLSL, MSL and WGSL, with passes.json, in out/kit/"
	@echo "make kit-check    make it twice, and hand it to the compilers of each dialect"
	@echo "make web     the npm package for WebGPU, in out/web/"
	@echo "make gallery draw the gallery and its films anew, into docs/ (minutes)"
	@echo "make films   the films alone"
	@echo "make clean   remove build folders and out/"

.PHONY: packages
packages:
	@tools/install_packages.sh --without site --without kit --without "compilers of the kit" --without examples --without web packages.txt

.PHONY: configure
configure: packages
	@$(CONFIGURE_RELEASE) $(CMAKE_FLAGS)

.PHONY: demo
demo: configure
	@cmake --build build --target gnomon -j $(JOBS)
	@mkdir -p out
	@build/gnomon render --preset demo -o $(PICTURE)
	@echo "The picture is $(PICTURE)"
	@echo "Holding the techniques against ray-traced truth"
	@build/gnomon compare rts --camera camp --size 640x360 --samples 64 --repetitions 3 --warmup 1 \
	    --report $(COMPARISON)
	@echo "The comparison is a page: open $(COMPARISON)/index.html"

.PHONY: build
build: configure
	@cmake --build build -j $(JOBS)

.PHONY: test
ifndef BUILT
test: build
asan: build-asan
endif
test:
	@$(call RUN_TESTS,build)

# tools/ci_turn.py has what takes long; .ci/run does some of it each time.
.PHONY: check-all
check-all: check test asan
	@for item in $$(tools/ci_turn.py alone); do echo "== $$item"; JOBS=$(JOBS) tools/ci_turn.py run $$item || failed+=" $$item"; done; \
	    [[ -z $${failed:-} ]] || { echo "failed:$$failed" >&2; exit 1; }

.PHONY: check
check: packages
	@tools/check_format.sh
	@tools/check_includes.py
	@tools/check_text.py
	@$(MAKE) -s headers sources
	@tools/check_packages.py build-tidy $(patsubst %/build.ninja,%,$(wildcard build/build.ninja))

# Nothing is built in build-tidy: it holds each source's own command, and the headers that configuring generates.
.PHONY: commands
commands: packages
	@cmake --preset release -B build-tidy $(CMAKE_FLAGS) >/dev/null

.PHONY: headers
headers: commands
	@tools/check_headers.py --build build-tidy -j $(JOBS) --only $(HEADERS)

.PHONY: sources
sources: commands
	@tools/check_sources.py --build build-tidy -j $(JOBS) $(SOURCES)

.PHONY: tidy
tidy: commands
	@tools/tidy.py --build build-tidy -j $(JOBS) $(TIDY_FOLDERS)

.PHONY: build-asan
build-asan: packages
	@cmake --preset asan $(CMAKE_FLAGS)
	@cmake --build build-asan -j $(JOBS)

.PHONY: asan
asan:
	@source tools/sanitizers.sh && $(call RUN_TESTS,build-asan)

.PHONY: fuzz
fuzz: packages
	@tools/fuzz.sh $(FUZZ_SECONDS) $(JOBS)

# The library alone has a build folder of its own, for it is configured otherwise.
PREFIX ?= /usr/local
.PHONY: install
ifdef LIBRARY_ONLY
install:
	@tools/install_packages.sh --only library packages.txt
	@cmake --preset release -B build-library -DGNOMON_PROGRAM=OFF $(CMAKE_FLAGS)
	@cmake --build build-library --target gnomon_installed -j $(JOBS)
	@cmake --install build-library --prefix $(PREFIX)
else
install: configure
	@cmake --build build --target gnomon_installed -j $(JOBS)
	@cmake --install build --prefix $(PREFIX)
endif

.PHONY: package
package: packages
	@cmake --preset package $(CMAKE_FLAGS)
	@cmake --build build-package -j $(JOBS)
	@cd build-package && cpack -B packages

.PHONY: package-test
package-test: package
	@tools/package_test.sh build-package/packages

.PHONY: bare-test
bare-test: packages
	@tools/bare_root_test.sh

# Nothing of the site asks a network for anything. To search in it, serve it: python3 -m http.server -d build/site
.PHONY: site-packages
site-packages:
	@tools/install_packages.sh --only site packages.txt

# A part of the site. npm installs in build/playground_npm what builds it.
.PHONY: playground
playground: web
	@cmake --build build --target gnomon_write_world -j $(JOBS)
	@web/playground/make.py build/write_world build/playground

.PHONY: site
site: site-packages
	@tools/make_site.py build/site

# Other graphics APIs' shaders (docs/kit.md). npm installs in build/kit_npm what makes WGSL.
.PHONY: kit-packages
kit-packages: packages
	@tools/install_packages.sh --only kit packages.txt

.PHONY: kit
kit: kit-packages
ifndef BUILT
	@$(CONFIGURE_RELEASE) $(CMAKE_FLAGS)
endif
	@cmake --build build --target gnomon_spirv_modules gnomon_classic_spirv_modules -j $(JOBS)
	@JOBS=$(JOBS) kit/make_kit.py build out/kit

.PHONY: kit-check
kit-check: kit-packages
	@tools/install_packages.sh --only "compilers of the kit" packages.txt
ifndef BUILT
	@$(MAKE) -s build
endif
	@ctest --test-dir build --output-on-failure --no-tests=error -L kit

# The npm package (docs/webgpu.md).
.PHONY: web
web: kit
	@tools/install_packages.sh --only web packages.txt
	@JOBS=$(JOBS) web/tools/make_package.py out/kit build/web out/web

.PHONY: gallery
gallery: configure site-packages
	@cmake --build build --target gnomon -j $(JOBS)
	@tools/make_gallery.py build/gnomon

.PHONY: films
films: configure site-packages
	@cmake --build build --target gnomon -j $(JOBS)
	@tools/make_gallery.py --films build/gnomon

.PHONY: clean
clean:
	rm -rf build build-asan build-ci build-debug build-fuzz build-library build-package build-tidy out
