#!/usr/bin/env bash
# Tries Gnomon on the GPU of this machine and writes what came out to one JSON file, of which docs/gpus.md is made.
# Takes 8 minutes at most; what is not reached in time is left out, and the file says so. Needs a build (`make test`, or
# `cmake --build build`), a driver, and for pictures to compare with Mesa's lavapipe.
# usage: tools/on_gpu.sh [--gpu NAME] [--build FOLDER] [--seconds N] FILE.json
#   --gpu      part of the device's name, or "software"; else the first real GPU (`gnomon gpus` lists them)
#   --build    where the programs are (build)
#   --seconds  how long it may take (480)
set -euo pipefail
gpu= build=build seconds=480
while [[ ${1:-} == --* ]]; do
    case $1 in
        --gpu) gpu=${2:?--gpu needs a name}; shift 2 ;;
        --build) build=${2:?--build needs a folder}; shift 2 ;;
        --seconds) seconds=${2:?--seconds needs a number}; shift 2 ;;
        *) echo "on_gpu: there is no option $1" >&2; exit 2 ;;
    esac
done
file=${1:?on_gpu: name the file that it is to write}
tools=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$build" && pwd)
ends=$((SECONDS + seconds))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# run NAME SECONDS COMMAND...: its output and status, unless the time is over.
run() {
    local name=$1 most=$2 left=$((ends - SECONDS)) status=0
    shift 2
    [[ $left -gt 5 ]] || { echo 124 >"$work/$name.status"; return; }
    echo "on_gpu: $name"
    timeout --kill-after=5 $((left < most ? left : most)) "$@" >"$work/$name.log" 2>&1 || status=$?
    echo "$status" >"$work/$name.status"
}

run device 60 "$build/gnomon" gpus --json "$work/device.json"
[[ -n $gpu ]] || gpu=$("$tools/gpu_report.py" taken "$work/device.json")
pick=(--gpu "$gpu")
export GNOMON_GPU=$gpu GNOMON_OTHER_GPU=$gpu
"$tools/lamps_scene.py" "$work/lamps.gltf"

filters=hard,pcf,pcss,raymarch,vsm,lvsm,esm,evsm,msm,id,depth-id,smoothies,volumes
run grid 60 "$build/test_vulkan" --gtest_filter='DepthGrid.*:CopyRate.*' --gtest_output="json:$work/grid.json"
run masks 120 "$build/test_drivers" --gtest_filter='-*640x360*' --gtest_output="json:$work/masks.json"
for size in 1280x720 3840x2160; do
    for view in rts:camp rts:unit sundial:meadow ring:deck spotlit:stage canopies:roofs; do
        run "bench-$size-$view" 60 "$build/gnomon" bench "${view%:*}" --camera "${view#*:}" --size "$size" --techniques "$filters" \
            --repetitions 5 --warmup 2 "${pick[@]}" --json "$work/bench-$size-$view.json"
    done
done
run blur 60 "$build/gnomon" bench rts --camera camp --size 1280x720 --map-size 4096 --techniques vsm+single,evsm+single,msm+single \
    --repetitions 9 "${pick[@]}" --json "$work/blur.json"
run lamps 60 "$build/gnomon" bench "$work/lamps.gltf" --size 3840x2160 --techniques auto,pcf --repetitions 5 --warmup 2 \
    "${pick[@]}" --json "$work/lamps.json"
run cases 180 "$build/test_vulkan" --gtest_filter='-*Null*:Soak.*:*Faults*' --gtest_output="json:$work/cases.json"

"$tools/gpu_report.py" collect "$work" "$file.new"
mv "$file.new" "$file"
echo "on_gpu: $file; tools/gpu_report.py table $file shows it"
