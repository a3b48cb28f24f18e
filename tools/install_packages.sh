#!/usr/bin/env bash
# Installs what is missing of packages.txt, and says so. Touches nothing (no apt, no network, no root) when all is there.
# usage: tools/install_packages.sh [--list] [--only SECTION | --without SECTION...] [packages.txt]
# --only: of that section alone, as "= SECTION" begins it. --without: of all others. --list: says which packages these are, and installs nothing.
# A package is there, too, where an installed one provides it.
set -euo pipefail
only=
without=
list_them=0
while [[ ${1:-} == --* ]]; do
    case $1 in
        --only) only=${2:?--only needs a section}; shift 2 ;;
        --without) without+="|${2:?--without needs a section}|"; shift 2 ;;
        --list) list_them=1; shift ;;
        *) echo "packages: there is no option $1" >&2; exit 2 ;;
    esac
done
list=${1:-$(dirname "$0")/../packages.txt}

mapfile -t wanted < <(awk -v only="$only" -v without="$without" '/^= / { section = substr($0, 3); next } { sub(/#.*/, "") }
    NF && (only == "" || section == only) && !index(without, "|" section "|") { print $1 }' "$list")
if [[ ${#wanted[@]} -eq 0 ]]; then
    echo "packages: $list has nothing in section \"$only\"; it has these: $(sed -n 's/^= //p' "$list" | paste -sd, -)" >&2
    exit 2
fi
if [[ $list_them -eq 1 ]]; then
    printf '%s\n' "${wanted[@]}"
    exit 0
fi
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "packages: this is not a Debian system, so nothing is installed. Needed are the equivalents of:" >&2
    echo "  ${wanted[*]}" >&2
    exit 0
fi

# Names of all installed packages, and of what they provide.
there=" $(dpkg-query -W -f '${db:Status-Status} ${Package} ${Provides}\n' | sed -n 's/^installed //p' | sed 's/([^)]*)//g' | tr ',\n' '  ') "
missing=()
for name in "${wanted[@]}"; do
    [[ $there == *" $name "* ]] || missing+=("$name")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

install=(apt-get install -y --no-install-recommends "${missing[@]}")
as_root=(env DEBIAN_FRONTEND=noninteractive)
if [[ $(id -u) -ne 0 ]]; then
    # Without a terminal sudo cannot ask for a password: it must work as it is or not at all.
    if ! command -v sudo >/dev/null || { [[ ! -t 0 ]] && ! sudo -n true 2>/dev/null; }; then
        echo "packages: missing ${missing[*]}, and there is no right to install them (not root, no usable sudo)." >&2
        echo "packages: have an administrator run: ${install[*]}" >&2
        exit 1
    fi
    as_root=(sudo env DEBIAN_FRONTEND=noninteractive)
fi

# The package index is fetched only when it does not know a missing package (a fresh container has none at all)
# or when it is so old that a download fails.
updated=0
update() {
    echo "packages: fetching the package index (apt-get update)"
    "${as_root[@]}" apt-get -qq update
    updated=1
}
known() {
    local name
    for name in "${missing[@]}"; do
        apt-cache show --no-all-versions "$name" >/dev/null 2>&1 || return 1
    done
}
known || update
echo "packages: installing ${missing[*]}"
"${as_root[@]}" "${install[@]}" && exit 0
if [[ $updated -eq 0 ]]; then
    update
    "${as_root[@]}" "${install[@]}" && exit 0
fi
echo "packages: could not install ${missing[*]}; see apt's message above." >&2
exit 1
