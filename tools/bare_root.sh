# Sourced by tests that need a Debian 12 in which nothing is installed: makes one with debootstrap and runs commands there.
# Needs root, debootstrap and a package mirror (the one that this machine's apt uses).
[[ $(id -u) -eq 0 ]] || { echo "bare root: debootstrap and chroot need root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "bare root: install debootstrap" >&2; exit 1; }

bare_roots=() # those that are mounted

# bare_root_make ROOT: an existing one is taken as it is.
bare_root_make() {
    local root=$1 mirror
    mkdir -p "$root"
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
}

# bare_root_run ROOT COMMAND: bash runs it there, in an environment of its own.
bare_root_run() {
    local root=$1
    mkdir -p "$root/dev/shm"
    mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
    mountpoint -q "$root/dev/shm" || mount -t tmpfs tmpfs "$root/dev/shm"
    bare_roots+=("$root")
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 ${http_proxy:+http_proxy="$http_proxy"} \
        ${https_proxy:+https_proxy="$https_proxy"} chroot "$root" bash -euo pipefail -c "$2" </dev/null
}

bare_root_unmount() {
    local root
    for root in "${bare_roots[@]}"; do
        mountpoint -q "$root/proc" && umount "$root/proc"
        mountpoint -q "$root/dev/shm" && umount "$root/dev/shm"
    done
    return 0
}
