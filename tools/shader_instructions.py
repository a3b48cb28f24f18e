#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many SPIR-V instructions has each variant of the shaders that were built?

usage: shader_instructions.py [--only WORD,WORD] [--json FILE] [--against FILE] FOLDER...

Reads every .spv below the folders (build/shaders build/host) and prints a table: instructions within functions, and of
these reads of images, branches and loops. They are counted as glslc's optimiser leaves them, each once, whatever runs
how often and for whom: constants that a pipeline sets (specialisation) have not been put in, and what a driver makes of
it is not looked at. So they say which shader grew, and not what it takes.
--json writes the counts; --against compares with such a file, and has status 1 when a shader has more instructions.
"""

import argparse
import json
import struct
import sys
from pathlib import Path

MAGIC = 0x07230203
# Opcodes of the SPIR-V specification, version 1.6, section 3.49.
FUNCTION, PARAMETER, FUNCTION_END, VARIABLE, LABEL, LINE, NO_LINE = 54, 55, 56, 59, 248, 8, 317
NO_WORK = {FUNCTION, PARAMETER, FUNCTION_END, VARIABLE, LABEL, LINE, NO_LINE}
IMAGE_READS = set(range(87, 99))  # OpImageSampleImplicitLod to OpImageRead
BRANCHES = {250, 251}  # OpBranchConditional, OpSwitch
LOOPS = {246}  # OpLoopMerge
KEYS = ("instructions", "image_reads", "branches", "loops")


class NoModule(Exception):
    """What is wrong with a file, in a sentence."""


def count(module: bytes) -> dict[str, int]:
    """Counts of a module by KEYS."""
    if len(module) < 20 or len(module) % 4 != 0:
        raise NoModule("it is no whole number of words, or has no header")
    words = struct.unpack(f"<{len(module) // 4}I", module)
    if words[0] != MAGIC:
        raise NoModule("it does not begin as SPIR-V of this byte order does")
    counts = dict.fromkeys(KEYS, 0)
    within, place = False, 5
    while place < len(words):
        length, opcode = words[place] >> 16, words[place] & 0xFFFF
        if length == 0 or place + length > len(words):
            raise NoModule(f"the instruction at word {place} has {length} words")
        place += length
        within = (within or opcode == FUNCTION) and opcode != FUNCTION_END
        if not within or opcode in NO_WORK:
            continue
        counts["instructions"] += 1
        counts["image_reads"] += opcode in IMAGE_READS
        counts["branches"] += opcode in BRANCHES
        counts["loops"] += opcode in LOOPS
    return counts


def count_all(folders: list[Path], only: list[str]) -> dict[str, dict[str, int]]:
    found = {}
    for folder in folders:
        for file in sorted(folder.rglob("*.spv")):
            name = file.name.removesuffix(".spv")
            if only and not any(word in name for word in only):
                continue
            if name in found:
                raise SystemExit(f"{file}: there is another shader of that name; count their folders apart")
            try:
                found[name] = count(file.read_bytes())
            except NoModule as what:
                raise SystemExit(f"{file}: {what}") from what
    return found


def table(shaders: dict[str, dict[str, int]]) -> str:
    lines = ["| shader | instructions | image reads | branches | loops |", "|---|---|---|---|---|"]
    rows = sorted(shaders.items(), key=lambda shader: -shader[1]["instructions"])
    return "\n".join(lines + [f"| `{name}` | {' | '.join(str(counts[key]) for key in KEYS)} |" for name, counts in rows])


def grown(before: dict[str, dict[str, int]], now: dict[str, dict[str, int]]) -> list[str]:
    """A line for each shader of both that has more instructions now."""
    lines = []
    for name in sorted(before.keys() & now.keys()):
        was, is_now = before[name]["instructions"], now[name]["instructions"]
        if is_now > was:
            lines.append(f"{name} has grown from {was} to {is_now} instructions, times {is_now / was:.3f}")
    return lines


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--against", type=Path)
    parser.add_argument("folders", nargs="+", type=Path)
    options = parser.parse_args()
    shaders = count_all(options.folders, [word for word in options.only.split(",") if word])
    if not shaders:
        raise SystemExit(f"no .spv in {', '.join(map(str, options.folders))}; build first")
    if options.json:
        options.json.write_text(json.dumps(shaders, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    if not options.against:
        print(table(shaders))
        return 0
    lines = grown(json.loads(options.against.read_text(encoding="utf-8")), shaders)
    print("\n".join(lines) if lines else "no shader has more instructions")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
