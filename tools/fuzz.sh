#!/usr/bin/env bash
# Builds the glTF reader's fuzzer and runs it from the validator corpus.
# usage: tools/fuzz.sh [SECONDS] [JOBS]; GNOMON_SHARED names the folder that holds corpus/ (default: ../shared)
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
jobs=${2:-$(nproc)}
shared=${GNOMON_SHARED:-../shared}

cmake --preset fuzz >/dev/null
cmake --build build-fuzz -j "$jobs" --target fuzz_gltf

work=build-fuzz/run
rm -rf "$work"
mkdir -p "$work/corpus" "$work/findings"
# The fuzzer writes what it finds into its first folder, so it works on a copy; names are made unique by number.
count=0
if [[ -d $shared/corpus ]]; then
    while IFS= read -r -d '' file; do
        cp "$file" "$work/corpus/$(printf '%05d' "$count")-$(basename "$file")"
        count=$((count + 1))
    done < <(find "$shared/corpus" -type f \( -name '*.gltf' -o -name '*.glb' \) -print0 | LC_ALL=C sort -z)
fi
if [[ $count -eq 0 ]]; then
    echo "fuzz: NO CORPUS under $shared/corpus: starting from nothing, which finds far less" >&2
fi
echo "fuzz: $count files to start from, $seconds s"
log=$work/log.txt
if ! build-fuzz/fuzz_gltf -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=10 -seed=1 -print_final_stats=1 \
    -artifact_prefix="$work/findings/" "$work/corpus" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    echo "fuzz: FAILED; the input is in $work/findings" >&2
    exit 1
fi
grep -E 'stat::number_of_executed_units|stat::peak_rss_mb' "$log"
