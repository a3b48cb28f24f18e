#!/usr/bin/env bash
# Builds the fuzzers of tests/fuzz and runs them, each from its own corpus in turn, for SECONDS in all.
# usage: tools/fuzz.sh [SECONDS] [JOBS] [TARGET...]; without targets all of them. GNOMON_SHARED names the folder that holds
# further scenes in corpus/ (default: ../shared). FUZZ_MERGE=1 then keeps in tests/fuzz/corpus, at least size, what covers
# what the corpora and this run cover.
# Every target runs every time, for the same share: none waits for a turn that a slow week never brings. The seed is the
# same too, so what fails here fails again.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
jobs=${2:-$(nproc)}
shared=${GNOMON_SHARED:-../shared}

cmake --preset fuzz >/dev/null
read -r -a targets <build-fuzz/fuzz_targets.txt
[[ $# -gt 2 ]] && targets=("${@:3}")
cmake --build build-fuzz -j "$jobs" --target "${targets[@]/#/fuzz_}"

share=$((seconds / ${#targets[@]}))
[[ $share -lt 1 ]] && share=1
failed=0
for target in "${targets[@]}"; do
    work=build-fuzz/run/$target
    rm -rf "$work"
    mkdir -p "$work/corpus" "$work/findings"
    # The fuzzer writes what it finds into its first folder, so it works on a copy.
    cp tests/fuzz/corpus/"$target"/* "$work/corpus/"
    longest=2048
    if [[ $target == gltf ]]; then
        longest=16384
        if [[ -d $shared/corpus ]]; then # names are made unique by number
            count=0
            while IFS= read -r -d '' file; do
                cp "$file" "$work/corpus/$(printf '%05d' "$count")-$(basename "$file")"
                count=$((count + 1))
            done < <(find "$shared/corpus" -type f \( -name '*.gltf' -o -name '*.glb' \) -print0 | LC_ALL=C sort -z)
        fi
    fi
    log=$work/log.txt
    if ! "build-fuzz/fuzz_$target" -max_total_time="$share" -max_len="$longest" -rss_limit_mb=2048 -malloc_limit_mb=1024 \
        -timeout=10 -seed=1 -print_final_stats=1 -artifact_prefix="$work/findings/" "$work/corpus" >"$log" 2>&1; then
        tail -n 60 "$log" >&2
        echo "fuzz: $target FAILED; the input is in $work/findings" >&2
        failed=1
        continue
    fi
    echo "fuzz: $target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") runs in $share s," \
        "$(sed -n 's/^stat::peak_rss_mb: *//p' "$log") MB at most"
    if [[ ${FUZZ_MERGE:-0} == 1 ]]; then
        mkdir "$work/least"
        "build-fuzz/fuzz_$target" -merge=1 -max_len="$longest" "$work/least" tests/fuzz/corpus/"$target" "$work/corpus" \
            >"$work/merge.txt" 2>&1
        rm tests/fuzz/corpus/"$target"/*
        cp "$work/least"/* tests/fuzz/corpus/"$target"/
    fi
done
exit "$failed"
