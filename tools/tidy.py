#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy over the project's own sources (not over generated ones).

usage: tidy.py --build DIR [-j N] [FOLDER...]     FOLDERs limit it, e.g. core/src
"""

import argparse
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sources import project_root


def tidy(build: Path, source: str) -> tuple[int, str]:
    # The commands may be GCC's, with warnings that clang has not.
    result = subprocess.run(["clang-tidy", "-p", str(build), "--quiet", "--warnings-as-errors=*",
                             "--extra-arg=-Wno-unknown-warning-option", source],
                            capture_output=True, text=True, check=False)
    return result.returncode, result.stdout


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("folders", nargs="*", default=["core/src", "vulkan/src", "image/src", "scene/src", "host/src",
                                                       "app/src"])
    options = parser.parse_args()
    root = project_root()
    commands = json.loads((options.build / "compile_commands.json").read_text(encoding="utf-8"))
    wanted = tuple(str(root / folder) + "/" for folder in options.folders)
    sources = sorted({entry["file"] for entry in commands if entry["file"].startswith(wanted)})
    if not sources:
        print("tidy: found no sources", file=sys.stderr)
        return 1
    with ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda source: tidy(options.build, source), sources))
    broken = 0
    for code, text in results:
        if code != 0:
            broken += 1
            print(text, file=sys.stderr)
    print(f"tidy: {len(sources)} files, {broken} with findings")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
