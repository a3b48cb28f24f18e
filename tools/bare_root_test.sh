#!/usr/bin/env bash
# Proves that packages.txt is complete: makes a bare Debian 12 root (tools/bare_root.sh), copies the tracked files in and runs
# make targets there.
# usage: tools/bare_root_test.sh [--keep] [TARGET...]      default targets: demo test
# ROOT_FOLDER: where the root is made (default: a new folder under /tmp; an existing one is reused).
# CACHE_FROM: a compiler cache to copy in, so that what was compiled already is not compiled again; else there is none.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/bare_root.sh
keep=0
if [[ ${1:-} == --keep ]]; then
    keep=1
    shift
fi
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(demo test)

root=${ROOT_FOLDER:-$(mktemp -d /tmp/gnomon-bare-root.XXXXXX)}
finish() {
    bare_root_unmount
    [[ $keep -eq 1 ]] || rm -rf --one-file-system "$root"
}
trap finish EXIT
bare_root_make "$root"

rm -rf "$root/src"
mkdir -p "$root/src/gnomon"
git ls-files -z | xargs -0 cp --parents -t "$root/src/gnomon"
shared=${GNOMON_SHARED:-$PWD/../shared}
[[ -d $shared ]] && cp -r "$shared" "$root/src/shared"

if [[ -n ${CACHE_FROM:-} ]]; then
    echo "bare root: with what the compiler cache in $CACHE_FROM has"
    mkdir -p "$root/root/.cache/ccache"
    cp -r "$CACHE_FROM/." "$root/root/.cache/ccache/"
fi

for target in "${targets[@]}"; do
    began=$SECONDS
    echo "bare root: make $target"
    bare_root_run "$root" "cd /src/gnomon && make $target" || { echo "bare root: make $target FAILED after $((SECONDS - began)) s" >&2; exit 1; }
    echo "bare root: make $target took $((SECONDS - began)) s"
done
if [[ -f $root/src/gnomon/out/demo.png ]]; then
    mkdir -p out
    cp "$root/src/gnomon/out/demo.png" out/bare_root_demo.png
    echo "bare root: its picture is out/bare_root_demo.png"
fi
echo "bare root: ${targets[*]} passed"
