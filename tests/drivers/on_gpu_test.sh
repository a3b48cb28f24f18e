#!/usr/bin/env bash
# Runs tools/on_gpu.sh by a software rasteriser, quickly, and looks at what it wrote.
# usage: on_gpu_test.sh BUILD
set -euo pipefail
tools=$(cd "$(dirname "$0")/../../tools" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$tools/on_gpu.sh" --quick --gpu software --build "$1" "$work/here.json"
page=$("$tools/gpu_report.py" table "$work/here.json")
echo "$page"
for row in hard pcf pcss raymarch; do
    grep -q "^| \`$row.* [0-9]" <<<"$page" || { echo "on_gpu_test: there is no row of $row" >&2; exit 1; }
done
for line in 'left out' 'not reached' ' [1-9][0-9]* fail'; do
    if grep "$line" <<<"$page" >&2; then exit 1; fi
done
