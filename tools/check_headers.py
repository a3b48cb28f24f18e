#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does every header compile on its own, alone and twice, with only the include folders its users have?

usage: check_headers.py [--build DIR] [-j N] [ROOT]

DIR is a configured build folder, for the generated shader headers that private headers of vulkan and host include. What
it has compiled counts: a private header that a source includes before all else stood alone when that source compiled,
with the same warnings and include folders. Only an object newer than every header counts. Public headers are always
compiled here, since their users have fewer include folders than our sources.
Exit status 1 when one does not compile.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sources import project_files, project_root

# Folder -> include folders. A public header gets those that its users have; only private ones see src/.
PUBLIC = ["core/include", "shaders/shared", "vulkan/include", "."]
FOLDERS = [
    ("shaders/shared/", ["shaders/shared"]),
    ("core/include/", ["core/include", "shaders/shared"]),
    ("core/src/", ["core/include", "shaders/shared", "core/src"]),
    ("vulkan/include/", ["vulkan/include", "core/include"]),
    ("vulkan/src/", ["vulkan/include", "core/include", "shaders/shared", "vulkan/src", "shaders"]),
    ("image/", [".", "core/include", "image/src"]),
    ("scene/src/", [".", "core/include", "scene/src"]),
    ("scene/", [".", "core/include"]),
    ("truth/", [".", "core/include", "truth/src"]),
    ("host/src/", [*PUBLIC, "host/src", "shaders"]),
    ("host/", PUBLIC),
    ("lab/score/", ["core/include", "shaders/shared", ".", "lab/score/src"]),
    ("lab/", [*PUBLIC, "lab/src"]),
    ("app/", [*PUBLIC, "app/src"]),
]
FLAGS = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion",
         "-Wno-sign-conversion", "-Werror", "-x", "c++"]


def folders_of(path: str):
    for prefix, folders in FOLDERS:
        if path.startswith(prefix):
            return folders
    return None


def compile_alone(root: Path, compiler: str, header: str, extra: list[str], scratch: Path) -> str:
    """The compiler's complaint, empty when there is none."""
    source = scratch / (header.replace("/", "_") + ".cpp")
    source.write_text(f'#include "{root / header}"\n#include "{root / header}"\n', encoding="utf-8")
    includes = [f"-I{root / folder}" for folder in folders_of(header)] + [f"-isystem{folder}" for folder in extra]
    result = subprocess.run([compiler, *FLAGS, *includes, str(source)], capture_output=True, text=True, check=False)
    return "" if result.returncode == 0 else f"{header} does not stand alone:\n{result.stderr}"


def first_include(path: Path):
    """What a source includes before all else, None unless it is a header of the project."""
    found = re.search(r"^#include\s+(\S+)", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found[1].strip('"') if found and found[1].startswith('"') else None


def stood_alone(root: Path, build: Path, headers: list[str]) -> set[str]:
    """The private headers that an up-to-date object of `build` shows to stand alone, once and twice."""
    newest = max((root / header).stat().st_mtime for header in headers)
    private = {header for header in headers if "/src/" in header}
    shown = set()
    database = build / "compile_commands.json"
    for entry in json.loads(database.read_text(encoding="utf-8")) if database.is_file() else []:
        source, output = Path(entry["file"]), re.search(r" -o (\S+)", entry["command"])
        built = build / output[1] if output else build
        if not source.is_relative_to(root) or not built.is_file():
            continue
        name = source.relative_to(root).as_posix()
        included = first_include(source) if folders_of(name) is not None else None
        if included is None or built.stat().st_mtime <= max(newest, source.stat().st_mtime):
            continue
        for folder in [str(Path(name).parent), *folders_of(name)]:
            header = os.path.normpath(f"{folder}/{included}")
            if (root / header).is_file():
                # Included twice it must be empty the second time.
                if header in private and re.search(r"^#.*", (root / header).read_text(encoding="utf-8"),
                                                   re.MULTILINE)[0] == "#pragma once":
                    shown.add(header)
                break
    return shown


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("root", nargs="?", type=Path, default=project_root())
    parser.add_argument("--build", type=Path)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    root = options.root.resolve()
    compiler = os.environ.get("CXX", "g++")

    headers = [file.as_posix() for file in project_files(root)
               if file.suffix == ".h" and folders_of(file.as_posix()) is not None]
    # Generated headers, for private headers only: a public one that needed them could not be installed.
    generated = sorted({str(file.parent) for file in options.build.resolve().glob("*/*/gnomon_*spirv.h")}) \
        if options.build else []
    shown = stood_alone(root, options.build.resolve(), headers) if options.build and headers else set()
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(options.jobs) as pool:
        complaints = list(pool.map(
            lambda header: compile_alone(root, compiler, header, generated if "/src/" in header else [], Path(scratch)),
            [header for header in headers if header not in shown]))
    broken = [complaint for complaint in complaints if complaint]
    for complaint in broken:
        print(complaint, file=sys.stderr)
    if not headers:
        print("headers: found none", file=sys.stderr)
        return 1
    print(f"headers: {len(headers)} stand alone, {len(shown)} of them as the build showed, {len(broken)} broken"
          if not broken else f"headers: {len(broken)} of {len(headers)} broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
