#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does every header compile on its own, alone and twice, with only the include folders its users have?

usage: check_headers.py [--build DIR] [-j N] [ROOT] [--only HEADER...]

DIR is a configured build folder, for the generated shader headers that private headers of vulkan and host include.
Exit status 1 when one does not compile.

Nearly all of the time goes into the standard library and glm, so sets of such includes are precompiled. A header gets a set
only if it makes every include of it by itself, before it says anything else; so it sees nothing that it would not see alone.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sources import project_files, project_root

# Folder -> include folders. A public header gets those that its users have; only private ones see src/.
PUBLIC = ["core/include", "pack/include", "shaders/include", "vulkan/include", "vulkan/classics/include", "."]
FOLDERS = [
    ("shaders/include/gnomon/shared/", ["shaders/include"]),
    ("core/include/", ["core/include", "shaders/include"]),
    ("core/src/", ["core/include", "shaders/include", "core/src"]),
    ("pack/include/", ["pack/include", "core/include", "shaders/include"]),
    ("pack/src/", ["pack/include", "core/include", "shaders/include", "pack/src"]),
    ("c/include/", ["c/include"]),
    ("c/src/", ["c/include", "pack/include", "core/include", "shaders/include", "c/src"]),
    ("vulkan/include/", ["vulkan/include", "pack/include", "core/include", "shaders/include"]),
    ("vulkan/src/", ["vulkan/include", "pack/include", "core/include", "shaders/include", "vulkan/src"]),
    ("vulkan/classics/include/", ["vulkan/classics/include", "vulkan/include", "pack/include", "core/include", "shaders/include"]),
    ("vulkan/classics/src/", ["vulkan/classics/include", "vulkan/include", "pack/include", "core/include", "shaders/include",
                              "vulkan/classics/src", "vulkan/src"]),
    ("gl/include/", ["gl/include", "pack/include", "core/include", "shaders/include"]),
    ("gl/src/", ["gl/include", "pack/include", "core/include", "shaders/include", "gl/src"]),
    ("files/", [".", "core/include", "files/src"]),
    ("image/", [".", "core/include", "image/src"]),
    ("scene/src/", [".", "core/include", "scene/src"]),
    ("scene/", [".", "core/include"]),
    ("worlds/src/", [".", "core/include", "worlds/src"]),
    ("worlds/", [".", "core/include"]),
    ("truth/", [".", "core/include", "truth/src"]),
    ("host/window/src/", [*PUBLIC, "host/src", "host/window/src"]),
    ("host/src/", [*PUBLIC, "host/src"]),
    ("host/", PUBLIC),
    ("lab/score/", ["core/include", "shaders/include", ".", "lab/score/src"]),
    ("lab/", [*PUBLIC, "lab/src"]),
    ("app/", [*PUBLIC, "app/src"]),
]
FLAGS = ["-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wno-sign-conversion", "-Werror"]
INCLUDE = re.compile(r'#include [<"]([^>"]+)[>"]')
# Text that may stand before an include without a meaning for it.
SILENT = re.compile(r"\s*(//.*|#pragma once|#(ifndef|define) GNOMON_\w+_H|#ifdef __cplusplus)?$")
COST_OF_SET = 3.5  # the cost of precompiling a set, where 1 is compiling it in a header


def folders_of(path: str):
    for prefix, folders in FOLDERS:
        if path.startswith(prefix):
            return folders
    return None


def outside_includes(root: Path, file: Path, folders: list[str], seen: set[Path]) -> set[str]:
    """What `file` includes that is not the project's, itself or through others, before it says anything else."""
    found = set()
    for line in file.read_text(encoding="utf-8").splitlines():
        if include := INCLUDE.match(line):
            places = [file.parent / include[1], *(root / folder / include[1] for folder in folders)]
            own = next((place for place in places if place.is_file()), None)
            if own is None:
                found.add(include[1])
            elif own not in seen:
                seen.add(own)
                found |= outside_includes(root, own, folders, seen)
        elif not SILENT.match(line):
            break
    return found


def sets_to_precompile(wanted: Counter) -> list[frozenset]:
    """Of what headers include (each with their number): the parts that are worth it, the best first."""
    chosen, saved = [], dict.fromkeys(wanted, 0)
    candidates = sorted({one & other for one in wanted for other in wanted}, key=sorted)

    def gain(part: frozenset) -> float:
        return sum(max(len(part) - saved[one], 0) * number for one, number in wanted.items() if part <= one) \
            - COST_OF_SET * len(part)

    while candidates and gain(best := max(candidates, key=gain)) > 0:
        chosen.append(best)
        saved.update({one: max(saved[one], len(best)) for one in wanted if best <= one})
    return chosen


def precompile(compiler: str, part: frozenset, file: Path) -> None:
    file.write_text("".join(f"#include <{name}>\n" for name in sorted(part)), encoding="utf-8")
    subprocess.run([compiler, *FLAGS, "-x", "c++-header", file, "-o", f"{file}.gch"], check=True)


def compile_alone(root: Path, compiler: str, header: str, extra: list[str], scratch: Path, precompiled) -> str:
    """The compiler's complaint, empty when there is none."""
    source = scratch / (header.replace("/", "_") + ".cpp")
    source.write_text(f'#include "{root / header}"\n#include "{root / header}"\n', encoding="utf-8")
    includes = [f"-I{root / folder}" for folder in folders_of(header)] + [f"-isystem{folder}" for folder in extra]
    before = ["-include", precompiled] if precompiled else []
    result = subprocess.run([compiler, *FLAGS, "-fsyntax-only", *before, *includes, source], capture_output=True, text=True,
                            check=False)
    return "" if result.returncode == 0 else f"{header} does not stand alone:\n{result.stderr}"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("root", nargs="?", type=Path, default=project_root())
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--build", type=Path)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    root = options.root.resolve()
    compiler = os.environ.get("CXX", "g++")

    headers = [file.as_posix() for file in project_files(root)
               if file.suffix == ".h" and folders_of(file.as_posix()) is not None
               and (not options.only or file.as_posix() in options.only)]
    # Generated headers, for private headers only: a public one that needed them could not be installed.
    generated = sorted({str(file.parent) for file in options.build.resolve().glob("*/*/gnomon_*spirv.h")}) \
        if options.build else []
    made = {header: frozenset(outside_includes(root, root / header, folders_of(header), set())) for header in headers}
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.jobs) as pool:
        scratch = Path(folder)
        parts = {part: scratch / f"part{number}.h" for number, part in enumerate(sets_to_precompile(Counter(made.values())))}
        list(pool.map(lambda part: precompile(compiler, part, parts[part]), parts))

        def complaint_of(header: str) -> str:
            largest = max((part for part in parts if part <= made[header]), key=len, default=None)
            return compile_alone(root, compiler, header, generated if "/src/" in header else [], scratch, parts.get(largest))

        complaints = list(pool.map(complaint_of, headers))
    broken = [complaint for complaint in complaints if complaint]
    for complaint in broken:
        print(complaint, file=sys.stderr)
    if not headers:
        print("headers: found none", file=sys.stderr)
        return 1
    print(f"headers: {len(headers)} stand alone" if not broken else f"headers: {len(broken)} of {len(headers)} broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
