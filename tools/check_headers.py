#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does every header compile on its own, alone and twice, with only the include folders its users have?

usage: check_headers.py [--build DIR] [-j N] [ROOT]

DIR is a configured build folder, for the generated shader headers that private headers of vulkan and host include.
Exit status 1 when one does not compile.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sources import project_files, project_root

# Folder -> include folders. A public header gets those that its users have; only private ones see src/.
PUBLIC = ["core/include", "pack/include", "shaders/shared", "vulkan/include", "."]
FOLDERS = [
    ("shaders/shared/", ["shaders/shared"]),
    ("core/include/", ["core/include", "shaders/shared"]),
    ("core/src/", ["core/include", "shaders/shared", "core/src"]),
    ("pack/include/", ["pack/include", "core/include", "shaders/shared"]),
    ("pack/src/", ["pack/include", "core/include", "shaders/shared", "pack/src"]),
    ("vulkan/include/", ["vulkan/include", "pack/include", "core/include"]),
    ("vulkan/src/", ["vulkan/include", "pack/include", "core/include", "shaders/shared", "vulkan/src", "shaders"]),
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
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(options.jobs) as pool:
        complaints = list(pool.map(
            lambda header: compile_alone(root, compiler, header, generated if "/src/" in header else [], Path(scratch)),
            headers))
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
