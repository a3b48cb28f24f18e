#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is what the documents say still so?

usage: check_docs.py ROOT [GNOMON]

- links and pictures in every .md file lead to a file;
- README's C++ block is what examples/readme_snippet.cpp has between "README begin" and "README end";
- with the program GNOMON: docs/cli.md has one row for every option it declares, with the same default, and no other;
  and every option in a `gnomon` command of a document is one of them.
Exit status 1 when something is not so.
"""

import json
import re
import subprocess
import sys
import textwrap
from pathlib import Path

from sources import project_files

LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
COMMAND = re.compile(r"(?:build/)?gnomon (render|plan|bench|list)\b([^`\n]*)")
# Options of the command line itself, which are no settings.
PLAIN_OPTIONS = {"set", "preset", "json", "help", "version", "o"}


def broken_links(root: Path) -> list[str]:
    found = []
    for file in project_files(root):
        if file.suffix != ".md":
            continue
        for number, line in enumerate((root / file).read_text(encoding="utf-8").splitlines(), 1):
            for target in LINK.findall(line):
                if "://" not in target and not (root / file.parent / target).exists():
                    found.append(f"{file}:{number}: {target} does not exist")
    return found


def snippet_differences(root: Path) -> list[str]:
    source = (root / "examples/readme_snippet.cpp").read_text(encoding="utf-8")
    marked = re.search(r"^[^\n]*README begin[^\n]*\n(.*?)^[^\n]*README end", source, re.DOTALL | re.MULTILINE)
    if not marked:
        return ['examples/readme_snippet.cpp: no lines between "README begin" and "README end"']
    code = textwrap.dedent(marked.group(1)).strip()
    blocks = re.findall(r"```cpp\n(.*?)```", (root / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    if not any(block.strip() == code for block in blocks):
        return ["README.md: no C++ block is what examples/readme_snippet.cpp has between its marks"]
    return []


def settings_of(gnomon: str) -> dict[str, dict]:
    text = subprocess.run([gnomon, "list", "--json"], capture_output=True, text=True, check=True).stdout
    settings = json.loads(text)["settings"]
    return {setting["key"]: setting for setting in settings}


def cli_differences(root: Path, settings: dict[str, dict]) -> list[str]:
    rows = {}
    for line in (root / "docs/cli.md").read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]
        match = re.match(r"^`(?:--)?([a-z.-]+)[^`]*`$", cells[0]) if len(cells) == 4 else None
        if match:
            rows[match.group(1)] = cells
    found = [f"docs/cli.md: no row for {key}" for key in settings if key not in rows]
    found += [f"docs/cli.md: {key} is no option of the program" for key in rows if key not in settings]
    for key, cells in rows.items():
        if key in settings:
            default = settings[key].get("default") or ""
            if cells[1].strip("`") != str(default):
                found.append(f"docs/cli.md: the default of {key} is {default!r}, not {cells[1]!r}")
    return found


def unknown_options(root: Path, settings: dict[str, dict]) -> list[str]:
    found = []
    for file in project_files(root):
        if file.suffix != ".md":
            continue
        for number, line in enumerate((root / file).read_text(encoding="utf-8").splitlines(), 1):
            for _, rest in COMMAND.findall(line):
                names = re.findall(r"(?:^|\s)--?([a-z-]+)", rest)
                names += re.findall(r"--set ([a-z.-]+)=", rest)
                found += [f"{file}:{number}: gnomon has no option {name}" for name in names
                          if name not in settings and name not in PLAIN_OPTIONS]
    return found


def main() -> int:
    root = Path(sys.argv[1]).resolve()
    found = broken_links(root) + snippet_differences(root)
    if len(sys.argv) > 2:
        settings = settings_of(sys.argv[2])
        found += cli_differences(root, settings) + unknown_options(root, settings)
    for line in found:
        print(line, file=sys.stderr)
    print(f"docs: {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
