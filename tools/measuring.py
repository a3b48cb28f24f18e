# SPDX-License-Identifier: Apache-2.0
"""What the tools that measure share: running the program, scenes that may be absent, cells of Markdown tables."""

import json
import subprocess
import sys


def run(gnomon, command, arguments):
    """The JSON of a run of the program; a run that fails ends the tool with what the program said."""
    line = [gnomon, command, *arguments, "--json", "-"]
    print(" ".join(line), file=sys.stderr)
    done = subprocess.run(line, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(line)}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def present(views, shared, only=""):
    """Of (name, scene, options, ...) those whose name has one of the words of `only`, scenes as paths, and whether any is
    absent, which is said on stderr."""
    found, missing = [], False
    for name, scene, *rest in views:
        if only and not any(word.strip() in name for word in only.split(",")):
            continue
        if "/" in scene:
            file = shared / scene
            if not file.exists():
                print(f"{name}: {file} is not there", file=sys.stderr)
                missing = True
                continue
            scene = str(file)
        found.append((name, scene, *rest))
    return found, missing


def cell(value, digits=4):
    return "–" if value is None else f"{value:.{digits}f}"


def table(columns, rows):
    lines = [f"| {' | '.join(columns)} |", "|---" * len(columns) + "|"]
    return "\n".join(lines + [f"| {' | '.join(row)} |" for row in rows]) + "\n"
