#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does every source compile alone? Builds compile many together (cmake/unity.cmake), where one's includes serve the others.

usage: check_sources.py --build DIR [-j N] [--all | --since COMMIT]

DIR is configured without GNOMON_UNITY; nothing has to be built there. To compile all sources alone takes as long as two builds
do (--all). Otherwise those are compiled that may lack a header: a source that names a thing which only headers declare
that it does not include, and others in its folder do. Names are found without parsing C++, and too many rather than too few; the
compiler decides. What the standard library and other packages declare is not looked up by name: --since COMMIT compiles
those too that are not as they were in COMMIT. Exit status 1 when a source does not compile.
"""

import argparse
import os
import re
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from compile_commands import commands_of, flags_of
from sources import project_root
from unity_groups import LITERALS, MACRO, name_in

INCLUDE = re.compile(r'^#include [<"]([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r" *//.*")
# The things that a header may declare: a type or constant; a function that is called, and no member.
USED = re.compile(r"(?<![.\w>])(?:k?[A-Z]\w*|[a-z]\w*(?=\())")
CASE = re.compile(r"^(?:TYPED_)?TEST\w*\((\w+), *(\w+)", re.MULTILINE)
# A variable or parameter, wherever it stands: the end of a type before it.
LOCAL = re.compile(r"\b(?!(?:return|throw|else|case|new)\b)\w+[)>&*\]]* [&*]?([a-z]\w*)(?= =|[{(;:,)])")


@cache
def text_of(file: Path) -> str:
    return COMMENT.sub("", LITERALS.sub('""', file.read_text(encoding="utf-8")))


@cache
def declared_in(file: Path) -> frozenset[str]:
    text = text_of(file)
    return frozenset(filter(None, [*MACRO.findall(text), *map(name_in, text.split("\n"))]))


@cache
def includes_of(file: Path, folders: tuple[Path, ...]) -> frozenset[Path]:
    """The files in `folders` and in its own that `file` includes itself."""
    found = (next(filter(Path.is_file, (folder / name for folder in (file.parent, *folders))), None)
             for name in INCLUDE.findall(file.read_text(encoding="utf-8")))
    return frozenset(one.resolve() for one in found if one)


def seen_by(source: Path, folders: tuple[Path, ...]) -> set[Path]:
    """All that it includes, itself or through others."""
    seen, left = set(), [source]
    while left:
        more = includes_of(left.pop(), folders) - seen
        seen |= more
        left += more
    return seen


def that_may_lack(root: Path, build: Path, entries: dict[Path, dict]) -> list[Path]:
    """The sources that name what only headers declare which others in their folder include, and they do not."""
    seen = {}
    for source, entry in entries.items():
        folders = (Path(word[2:]) for word in flags_of(entry) if word.startswith("-I"))
        # Only the sources of a folder include files that are generated for it.
        own = tuple(folder for folder in folders if folder.is_relative_to(root) and not folder.is_relative_to(build))
        seen[source] = seen_by(source, own)
    around = defaultdict(set)
    for source, files in seen.items():
        around[source.parent] |= files
    found = []
    for source, files in seen.items():
        text = text_of(source)
        own = declared_in(source).union(LOCAL.findall(text), *CASE.findall(text))
        here = set().union(*map(declared_in, files))
        elsewhere = set().union(*map(declared_in, around[source.parent] - files))
        if (set(USED.findall(text)) - own - here) & elsewhere:
            found.append(source)
    return found


def changed_since(root: Path, commit: str) -> set[Path]:
    done = subprocess.run(["git", "-C", root, "diff", "--name-only", "-z", commit, "--"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"sources: git does not know what has changed since {commit}: {done.stderr.strip()}")
    return {root / name for name in done.stdout.split("\0") if name}


def complaint_about(source: Path, entry: dict) -> str:
    """The compiler's, empty when there is none. Without optimisation, which knows no more names and takes longer."""
    compiler = os.environ.get("CXX", "g++")
    done = subprocess.run([compiler, *flags_of(entry), "-O0", "-w", "-fsyntax-only", source], cwd=entry["directory"],
                          capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else f"{source} does not compile alone:\n{done.stderr}"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--all", action="store_true")
    which.add_argument("--since", metavar="COMMIT")
    parser.add_argument("root", nargs="?", type=Path, default=project_root())
    options = parser.parse_args()
    root, build = options.root.resolve(), options.build.resolve()
    entries = {Path(entry["file"]): entry for entry in commands_of(build)}
    # Generated files belong to no target that compiles sources together.
    entries = {source: entry for source, entry in sorted(entries.items()) if not source.is_relative_to(build)}
    if not entries:
        print("sources: found none", file=sys.stderr)
        return 1
    chosen = entries if options.all else that_may_lack(root, build, entries)
    if options.since:
        changed = changed_since(root, options.since)
        chosen = [source for source in entries if source in changed or source in set(chosen)]
    with ThreadPoolExecutor(options.jobs) as pool:
        found = [text for text in pool.map(lambda source: complaint_about(source, entries[source]), chosen) if text]
    for text in found:
        print(text, file=sys.stderr)
    print(f"sources: {len(chosen)} of {len(entries)} compiled alone, {len(found)} of them in vain")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
