#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy over the project's own sources (not over generated ones).

usage: tidy.py --build DIR [-j N] [FOLDER or SOURCE...]     these limit it, e.g. core/src

Most of its time clang-tidy spends in the standard headers, so sources compiled alike are checked together, as one source
that includes them; those whose names clash there are taken out of it. Where that finds something, each source is checked
alone, and what is found then is what counts. Exit status 1 when something is.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from compile_commands import commands_of, flags_of
from sources import project_root

MOST_TOGETHER = 30
FOLDERS = ["core/src", "c/src", "vulkan/src", "vulkan/classics/src", "gl/src", "files/src", "image/src", "scene/src", "worlds/src", "host/src", "app/src"]
ALIKE = ["--quiet", "--warnings-as-errors=*"]
# The commands may be GCC's, with warnings that clang has not.
FOREIGN = "-Wno-unknown-warning-option"


def run(command: list, folder=None) -> subprocess.CompletedProcess:
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def including(sources: list[str]) -> str:
    return "".join(f'#include "{source}"\n' for source in sources)


def groups_that_compile(sources: list[str], flags: tuple[str, ...], build: Path) -> list[list[str]]:
    """`sources` in as few groups as is easily found; what compiles with no other is a group by itself."""
    groups, left = [], sources
    while left:
        group, later, clashing = left[:MOST_TOGETHER], left[MOST_TOGETHER:], []
        while len(group) > 1:
            with tempfile.NamedTemporaryFile("w", suffix=".cpp") as together:
                together.write(including(group))
                together.flush()
                result = run(["clang++", *flags, "-w", "-ferror-limit=0", "-fsyntax-only", together.name], build)
            if result.returncode == 0:
                break
            named = set(re.findall(r"^(\S+?):\d+:\d+: (?:fatal )?error", result.stderr, re.MULTILINE))
            out = [source for source in group if source in named] or group[1:]
            # The first source clashes with none before it and stays, else nothing would.
            out = out if len(out) < len(group) else group[1:]
            clashing += out
            group = [source for source in group if source not in out]
        groups.append(group)
        # They may go with what comes later, which is cheaper than alone.
        left = clashing + later
    return groups


def tidy_alone(build: Path, source: str) -> str:
    """What clang-tidy finds, empty when nothing."""
    result = run(["clang-tidy", "-p", build, *ALIKE, f"--extra-arg={FOREIGN}", source])
    return "" if result.returncode == 0 else result.stdout or result.stderr


def tidy_together(build: Path, group: list[str], flags: tuple[str, ...]) -> list[str]:
    """What clang-tidy finds in each of a group that compiles as one source."""
    if len(group) > 1:
        config = project_root() / ".clang-tidy"
        headers = re.search(r"^HeaderFilterRegex: '(.*)'", config.read_text(encoding="utf-8"), re.MULTILINE)[1]
        wanted = "|".join([headers, *(re.escape(source) + "$" for source in group)])
        with tempfile.TemporaryDirectory() as folder:
            together = Path(folder, "together.cpp")
            together.write_text(including(group), encoding="utf-8")
            found = run(["clang-tidy", *ALIKE, f"--config-file={config}", f"--header-filter={wanted}",
                         "--checks=-bugprone-suspicious-include", together, "--", *flags, FOREIGN], build)
        if found.returncode == 0:
            return []
    return [text for text in (tidy_alone(build, source) for source in group) if text]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    parser.add_argument("folders", nargs="*", default=FOLDERS)
    options = parser.parse_args()
    root, build = project_root(), options.build.resolve()
    wanted = tuple(str(root / folder) + ("" if folder.endswith(".cpp") else "/") for folder in options.folders)
    alike: dict[tuple[str, ...], set[str]] = {}
    for entry in commands_of(build):
        if entry["file"].startswith(wanted):
            alike.setdefault(flags_of(entry), set()).add(entry["file"])
    count = len(set().union(*alike.values()))
    if count == 0:
        print("tidy: found no sources", file=sys.stderr)
        return 1
    with ThreadPoolExecutor(options.jobs) as pool:
        split = pool.map(lambda flags: [(group, flags) for group in groups_that_compile(sorted(alike[flags]), flags, build)],
                         alike)
        # The largest first, so that no processor waits for it at the end.
        work = sorted((one for some in split for one in some), key=lambda one: -len(one[0]))
        found = [text for texts in pool.map(lambda one: tidy_together(build, *one), work) for text in texts]
    for text in found:
        print(text, file=sys.stderr)
    print(f"tidy: {count} files in {len(work)} groups, {len(found)} with findings")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
