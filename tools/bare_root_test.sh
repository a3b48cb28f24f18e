#!/usr/bin/env bash
# Proves that packages.txt is complete: makes a bare Debian 12 root with debootstrap, copies the tracked files in and runs
# make targets there. Needs root, debootstrap and a package mirror (the one that this machine's apt uses).
# usage: tools/bare_root_test.sh [--keep] [TARGET...]      default targets: demo test
# ROOT_FOLDER: where the root is made (default: a new folder under /tmp; an existing one is reused).
set -euo pipefail
cd "$(dirname "$0")/.."
keep=0
if [[ ${1:-} == --keep ]]; then
    keep=1
    shift
fi
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(demo test)
[[ $(id -u) -eq 0 ]] || { echo "bare root: debootstrap and chroot need root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "bare root: install debootstrap" >&2; exit 1; }

root=${ROOT_FOLDER:-$(mktemp -d /tmp/gnomon-bare-root.XXXXXX)}
mkdir -p "$root"
unmount() {
    mountpoint -q "$root/proc" && umount "$root/proc"
    mountpoint -q "$root/dev/shm" && umount "$root/dev/shm"
    return 0
}
finish() {
    unmount
    [[ $keep -eq 1 ]] || rm -rf --one-file-system "$root"
}
trap finish EXIT

# The mirror, from either format of apt's own lists.
mirror=$({ sed -n 's/^deb \(\[[^]]*\] \)\?\(http[^ ]*\) bookworm .*/\2/p' /etc/apt/sources.list /etc/apt/sources.list.d/*.list
           grep -h -A3 '^Types: *deb' /etc/apt/sources.list.d/*.sources | sed -n 's/^URIs: *//p'; } 2>/dev/null | head -n 1)
[[ -n $mirror ]] || { echo "bare root: found no Debian mirror in apt's lists" >&2; exit 1; }

if [[ ! -x $root/bin/bash ]]; then
    echo "bare root: debootstrap bookworm"
    debootstrap --variant=minbase --include=make,ca-certificates bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
        { tail -n 20 "$root.log" >&2; exit 1; }
    rm -f "$root.log"
fi
# How this machine reaches the mirror (proxy, certificates) holds inside too; its other lists and hooks do not.
apt-config dump | grep -iE '^Acquire::(https?|Check)[^ ]* ' >"$root/etc/apt/apt.conf.d/90outside" || true
cp /etc/resolv.conf /etc/hosts "$root/etc/" 2>/dev/null || true
cp -r /etc/ssl/certs/. "$root/etc/ssl/certs/" 2>/dev/null || true

rm -rf "$root/src"
mkdir -p "$root/src/gnomon" "$root/dev/shm"
git ls-files -z | xargs -0 cp --parents -t "$root/src/gnomon"
shared=${GNOMON_SHARED:-$PWD/../shared}
[[ -d $shared ]] && cp -r "$shared" "$root/src/shared"
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
mountpoint -q "$root/dev/shm" || mount -t tmpfs tmpfs "$root/dev/shm"

for target in "${targets[@]}"; do
    echo "bare root: make $target"
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 ${http_proxy:+http_proxy="$http_proxy"} \
        ${https_proxy:+https_proxy="$https_proxy"} \
        chroot "$root" bash -c "cd /src/gnomon && make $target" </dev/null ||
        { echo "bare root: make $target FAILED" >&2; exit 1; }
done
if [[ -f $root/src/gnomon/out/rts.png ]]; then
    mkdir -p out
    cp "$root/src/gnomon/out/rts.png" out/bare_root_rts.png
    echo "bare root: its picture is out/bare_root_rts.png"
fi
echo "bare root: ${targets[*]} passed"
