#!/usr/bin/env bash
# Are all C and C++ files laid out as .clang-format says? `tools/check_format.sh --fix` lays them out.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t files < <(find app c core examples files host image lab pack scene shaders/include tests truth vulkan \
    \( -name '*.cpp' -o -name '*.h' -o -name '*.c' \) 2>/dev/null | LC_ALL=C sort)
[[ ${#files[@]} -gt 0 ]] || { echo "format: found no C++ files" >&2; exit 1; }
if [[ ${1:-} == --fix ]]; then
    clang-format -i "${files[@]}"
    exit 0
fi
if clang-format --dry-run -Werror "${files[@]}"; then
    echo "format: ${#files[@]} files are laid out"
else
    echo "format: run tools/check_format.sh --fix" >&2
    exit 1
fi
