#!/usr/bin/env bash
# Proves that others can build with Gnomon, in bare Debian 12 roots (tools/bare_root.sh):
#   packages  with the .deb files and a compiler alone: find_package, pkg-config, both examples, and the program
#   library   with the first section of packages.txt alone: the library installed, and taken in by add_subdirectory
#   lintian   what lintian says of the .deb files; errors fail
# usage: tools/package_test.sh [--keep] FOLDER_OF_DEBS [STEP...]      default: all steps
# ROOT_FOLDER: where the roots are made (default: a new folder under /tmp; existing ones are reused).
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/bare_root.sh
keep=0
if [[ ${1:-} == --keep ]]; then
    keep=1
    shift
fi
debs=${1:?usage: tools/package_test.sh [--keep] FOLDER_OF_DEBS [STEP...]}
shift
steps=("$@")
[[ ${#steps[@]} -gt 0 ]] || steps=(packages library lintian)
ls "$debs"/libgnomon0_*.deb "$debs"/libgnomon-dev_*.deb "$debs"/gnomon_*.deb >/dev/null

roots=${ROOT_FOLDER:-$(mktemp -d /tmp/gnomon-package-test.XXXXXX)}
finish() {
    bare_root_unmount
    [[ $keep -eq 1 ]] || rm -rf --one-file-system "$roots"
}
trap finish EXIT
bare_root_make "$roots/bare"

# root_of STEP: a bare root of its own, with the projects that take Gnomon in.
root_of() {
    local root=$roots/$1
    rm -rf --one-file-system "$root" && cp -a "$roots/bare" "$root" && mkdir -p "$root/src" &&
        cp -r tests/package/consumer "$root/src/consumer" && echo "$root"
}
step_packages() {
    local root
    root=$(root_of packages) || return
    mkdir "$root/debs" && cp "$debs"/*.deb "$root/debs"
    bare_root_run "$root" '
        apt-get -qq update
        export DEBIAN_FRONTEND=noninteractive
        apt-get -qq install -y --no-install-recommends /debs/*.deb g++ cmake ninja-build pkg-config glslc spirv-tools \
            mesa-vulkan-drivers >/debs/apt.log
        for package in libembree-dev libopenexr-dev nlohmann-json3-dev; do
            if dpkg-query -W -f "\${db:Status-Status}\n" $package 2>/dev/null | grep -x installed; then
                echo "$package came along" >&2
                exit 1
            fi
        done
        cmake -G Ninja -S /src/consumer -B /src/found -DCMAKE_BUILD_TYPE=Release >/dev/null
        cmake --build /src/found >/dev/null
        /src/found/plan
        /src/found/record
        cd /src
        g++ -std=c++20 consumer/plan.cpp -o plan $(pkg-config --cflags --libs gnomon-core)
        ./plan
        ldd plan | grep "libgnomon-core.so.0 => /"
        gcc -std=c99 /usr/share/doc/libgnomon-dev/examples/c_host/c_host.c -o c_host $(pkg-config --cflags --libs gnomon-c)
        ./c_host | grep "frame 1, pass mask"
        ldd c_host | grep "libgnomon-c.so.0 => /"
        glslc --target-env=vulkan1.3 -DGNOMON_FILTER=GNOMON_FILTER_HARD consumer/visible.frag -o visible.spv \
            -I $(pkg-config --variable=includedir gnomon-shaders)
        for example in minimal_host forward_host; do
            cmake -G Ninja -S /usr/share/doc/libgnomon-dev/examples/$example -B $example -DCMAKE_BUILD_TYPE=Release >/dev/null
            cmake --build $example >/dev/null
            $example/$example $example
            ls -l $example/*.p[gp]m
        done
        gnomon --version
        gnomon render rts --size 320x180 -o /src/rts.png
        ls -l /src/rts.png
        apt-get -qq purge -y gnomon libgnomon0 libgnomon-dev >/dev/null
        if find /usr -iname "*gnomon*" | grep .; then
            echo "the packages left these behind" >&2
            exit 1
        fi'
}
step_library() {
    local root
    root=$(root_of library) || return
    mkdir -p "$root/src/gnomon"
    git ls-files -z | xargs -0 cp --parents -t "$root/src/gnomon"
    bare_root_run "$root" '
        cd /src/gnomon
        make install LIBRARY_ONLY=1 PREFIX=/opt/gnomon CMAKE_FLAGS=-DGNOMON_SHADER_CACHE=/src/modules >/src/install.log 2>&1 || { tail -n 30 /src/install.log >&2; exit 1; }
        # ninja-build brings python3 along.
        wanted=$(tools/install_packages.sh --list | grep -v "^python3$" | sort)
        for package in $(comm -23 <(echo "$wanted") <(tools/install_packages.sh --list --only library | sort)); do
            if dpkg-query -W -f "\${db:Status-Status}\n" $package 2>/dev/null | grep -x installed; then
                echo "$package is installed" >&2
                exit 1
            fi
        done
        test ! -e /opt/gnomon/bin
        cmake -G Ninja -S /src/consumer -B /src/found -DCMAKE_PREFIX_PATH=/opt/gnomon >/dev/null
        cmake --build /src/found >/dev/null
        /src/found/plan
        /src/found/record
        cmake -G Ninja -S /src/consumer -B /src/within -DHOW=FetchContent -DGNOMON_SOURCE=/src/gnomon \
            -DGNOMON_SHADER_CACHE=/src/modules >/dev/null
        cmake --build /src/within >/dev/null
        /src/within/plan
        /src/within/record'
}
step_lintian() {
    local root
    root=$(root_of lintian) || return
    mkdir "$root/debs" && cp "$debs"/*.deb "$root/debs"
    bare_root_run "$root" '
        apt-get -qq update
        DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends lintian >/debs/apt.log 2>&1
        lintian --allow-root --fail-on error --tag-display-limit 0 /debs/*.deb'
}

for step in "${steps[@]}"; do
    began=$SECONDS
    "step_$step" || { echo "package test: $step FAILED" >&2; exit 1; }
    echo "package test: $step passed in $((SECONDS - began)) s"
done
