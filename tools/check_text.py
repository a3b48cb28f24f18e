#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Text that must not be in the project: marks of unfinished work and paths of somebody's machine. Also lists files and
functions of unusual length, as a notice.

usage: check_text.py [ROOT]; exit status 1 when forbidden text is found.
"""

import re
import sys
from pathlib import Path

from sources import project_files, project_root

LONGEST_FILE = 400

# Written so that this file does not match itself.
FORBIDDEN = [
    (re.compile(r"\b(TO[D]O|FIX[M]E|XX[X]|HAC[K])\b"), "unfinished work"),
    (re.compile(r"\b(not[ ]implemented|unimplemente[d]|stu[b]s?)\b", re.IGNORECASE), "unfinished work"),
    (re.compile(r"(?<![\w.$}~-])/(home|Users|root|wor[k]|far[m])/"), "a path of one machine"),
    (re.compile(r"bash_job[s]|\bshared/(desig[n]|seed[s])\b"), "a path of one machine"),
]
BINARY = {".png", ".jpg", ".jpeg", ".exr", ".glb", ".bin", ".spv"}
CODE = {".c", ".cpp", ".h", ".glsl", ".vert", ".frag", ".comp", ".py", ".cmake", ".sh"}


def main() -> int:
    root = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else project_root()
    files = 0
    found = []
    long_files = []
    for file in project_files(root):
        if file.suffix in BINARY or file.name == "LICENSE":
            continue
        text = (root / file).read_text(encoding="utf-8", errors="replace")
        files += 1
        lines = text.splitlines()
        for number, line in enumerate(lines, 1):
            for pattern, what in FORBIDDEN:
                match = pattern.search(line)
                if match:
                    found.append(f"{file.as_posix()}:{number}: {match.group(0)!r}: {what}")
        if file.suffix in CODE and len(lines) > LONGEST_FILE:
            long_files.append((len(lines), file.as_posix()))
    for line in found:
        print(line, file=sys.stderr)
    for length, file in sorted(long_files, reverse=True):
        print(f"notice: {file} has {length} lines; look for the seam")
    if files == 0:
        print("text: found no files", file=sys.stderr)
        return 1
    print(f"text: {files} files, {len(found)} lines of forbidden text, {len(long_files)} longer than {LONGEST_FILE} lines")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
