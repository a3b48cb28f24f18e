#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How large the house is: lines by room, words of documents, and with a build the library's shader modules and those of
its classic techniques.

usage: sizes.py [BUILD]
"""

import sys
from collections import Counter
from pathlib import Path

from sources import project_files

CODE = {".cpp", ".h", ".glsl", ".vert", ".frag", ".comp", ".py", ".sh", ".cmake", ".css", ".js", ".html"}
APART = {"tests", "tools", "examples", "cmake", "packaging", "site", "docs"}  # no product


def main() -> int:
    root = Path(__file__).parent.parent
    lines: Counter = Counter()
    words = 0
    for file in project_files(root):
        room = file.parts[0]
        if file.suffix in CODE and len(file.parts) > 1:
            lines[room] += len((root / file).read_text(encoding="utf-8", errors="replace").splitlines())
        if file.suffix == ".md" and room == "docs":
            words += len((root / file).read_text(encoding="utf-8").split())
    for room in sorted(set(lines) - APART):
        print(f"{room:9} {lines[room]:7} lines")
    print(f"product   {sum(count for room, count in lines.items() if room not in APART):7} lines")
    print(f"tests     {lines['tests']:7} lines")
    print(f"tools     {lines['tools']:7} lines")
    print(f"docs      {words:7} words")
    if len(sys.argv) > 1:
        for name, folder in (("modules", "gnomon_spirv"), ("classics", "gnomon_classic_spirv")):
            modules = [*(Path(sys.argv[1]) / "shaders" / folder).glob("*.spv")]
            print(f"{name:9} {len(modules):7}, {sum(file.stat().st_size for file in modules)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
