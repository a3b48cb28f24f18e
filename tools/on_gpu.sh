#!/usr/bin/env bash
# Tries Gnomon on the GPU of this machine and writes what came out to one JSON file, of which docs/gpus.md is made.
# Takes 8 minutes at most; what is not reached in time is left out, and the file says so. Needs a build (`make test`, or
# `cmake --build build`), a driver, and for pictures to compare with Mesa's lavapipe. A software rasteriser gets fewer cases
# and smaller pictures.
# usage: tools/on_gpu.sh [--gpu NAME] [--build FOLDER] [--seconds N] [--keep FOLDER] [--note TEXT] [--quick] FILE.json
#   --gpu      part of the device's name, or "software"; else the first real GPU (`gnomon gpus` lists them)
#   --build    where the programs are (build)
#   --seconds  how long it may take (480)
#   --keep     keeps what each step printed and wrote, in a new folder
#   --note     a sentence about the machine, for the page
#   --quick    few cases and small pictures: says that the script works, and nothing of the GPU
set -euo pipefail
gpu= build=build seconds=480 keep= note= quick=
sizes=(1280x720 3840x2160) views=(rts:camp rts:unit sundial:meadow spotlit:stage canopies:roofs ring:deck)
blurs=vsm+single,evsm+single,msm+single blurred=4096 more=() masks=*filter_*:*160x90*:*partition_*:*lamp_*:*fit_*:*motion_* cases='-*Null*:Soak.*:*Faults*'
while [[ ${1:-} == --* ]]; do
    case $1 in
        --gpu) gpu=${2:?--gpu needs a name}; shift 2 ;;
        --build) build=${2:?--build needs a folder}; shift 2 ;;
        --keep) keep=${2:?--keep needs a folder}; shift 2 ;;
        --note) note=${2:?--note needs a text}; shift 2 ;;
        --quick) quick=yes; shift ;;
        --seconds) seconds=${2:?--seconds needs a number}; shift 2 ;;
        *) echo "on_gpu: there is no option $1" >&2; exit 2 ;;
    esac
done
file=${1:?on_gpu: name the file that it is to write}
tools=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$build" && pwd)
ends=$((SECONDS + seconds)) cores=$(nproc)
shards=$((cores < 16 ? cores : 16))
if [[ -n $keep ]]; then
    mkdir "$keep"
    work=$(cd "$keep" && pwd)
else
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
fi

# run NAME SECONDS COMMAND...: its output and status, unless the time is over.
run() {
    local name=$1 most=$2 left=$((ends - SECONDS)) status=0
    shift 2
    [[ $left -gt 5 ]] || { echo 124 >"$work/$name.status"; return; }
    echo "on_gpu: $name"
    timeout --kill-after=5 $((left < most ? left : most)) "$@" >"$work/$name.log" 2>&1 || status=$?
    echo "$status" >"$work/$name.status"
}

# drawn NAME SECONDS TEST FILTER: its cases, shared among processes; where one fails, so does the step.
drawn() {
    local name=$1 index
    for ((index = 0; index < shards; ++index)); do
        GTEST_TOTAL_SHARDS=$shards GTEST_SHARD_INDEX=$index run "$name-$index" "$2" "$build/$3" --gtest_filter="$4" --gtest_output="json:$work/$name-$index.json" &
    done
    wait
    cat "$work/$name"-*.status | sort -n | tail -1 >"$work/$name.status.all"
    rm "$work/$name"-*.status
    mv "$work/$name.status.all" "$work/$name.status"
}

run device 60 "$build/gnomon" gpus --json "$work/device.json"
[[ -n $gpu ]] || gpu=$("$tools/gpu_report.py" taken "$work/device.json")
[[ -n $gpu ]] || { echo "on_gpu: no GPU can be used: $build/gnomon gpus says why" >&2; exit 1; }
if "$tools/gpu_report.py" software "$work/device.json" "$gpu"; then
    sizes=(160x90 320x180) masks=*160x90_* cases=OnGpu.*:*Parity.*hard*:CascadePass*:SteppingSun.* blurs=vsm+single blurred=512 more=(--map-size 512)
fi
if [[ -n $quick ]]; then
    sizes=(64x36) views=(rts:camp spotlit:stage) masks=*filter_hard cases=OnGpu.* blurred=256 more=(--map-size 256)
fi
export GNOMON_GPU=$gpu GNOMON_OTHER_GPU=$gpu
"$tools/lamps_scene.py" "$work/lamps.gltf"

run grid 60 "$build/test_vulkan" --gtest_filter='DepthGrid.*:CopyRate.*:ReadError.*' --gtest_output="json:$work/grid.json"
drawn masks 120 test_drivers "$masks"
drawn cases 150 test_vulkan "$cases"

# bench NAME SECONDS TECHNIQUES SCENE OPTIONS...
bench() {
    local name=$1 most=$2 techniques=$3
    shift 3
    run "$name" "$most" "$build/gnomon" bench "$@" --techniques "$techniques" --repetitions 3 --warmup 1 --gpu "$gpu" --json "$work/$name.json"
}

filters=$("$tools/gpu_report.py" filters "$work/device.json" "$gpu")
bench blur 60 "$blurs" rts --camera camp --size "${sizes[0]}" --map-size $blurred
for size in "${sizes[@]}"; do
    for view in "${views[@]}"; do
        bench "bench-$size-$view" 40 "$filters" "${view%:*}" --camera "${view#*:}" --size "$size" "${more[@]}"
    done
done
for technique in pcf auto; do
    bench "lamps-${sizes[-1]}-$technique" 40 $technique "$work/lamps.gltf" --size "${sizes[-1]}" "${more[@]}"
done

printf %s "$note" >"$work/note.txt"
"$tools/gpu_report.py" collect "$work" "$file.new"
mv "$file.new" "$file"
echo "on_gpu: $file; tools/gpu_report.py table $file shows it"
