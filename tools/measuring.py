# SPDX-License-Identifier: Apache-2.0
"""What the tools that measure share: running the program, scenes that may be absent, cells of Markdown tables."""

import json
import subprocess
import sys
from pathlib import Path


def run(gnomon, command, arguments):
    """The JSON of a run of the program, where what a technique leaves open is plain; a run that fails ends the tool with
    what the program said."""
    line = [gnomon, command, "--preset", "plain", *arguments, "--json", "-"]
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


def print_tables(parser, tables):
    """Adds --tables, --only, GNOMON and SHARED to the parser's own options, prints the tables that are asked for, and gives
    the exit status. `tables`: name to (views as in present(), function of options and a view that gives Markdown)."""
    parser.add_argument("--tables", default=",".join(tables))
    parser.add_argument("--only", default="")
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    options = parser.parse_args()
    asked = options.tables.split(",")
    if not set(asked) <= set(tables):
        parser.error(f"tables are {', '.join(tables)}")
    missing = False
    for name in asked:
        views, make = tables[name]
        found, absent = present(views, options.shared, options.only)
        missing = missing or absent
        for view in found:
            print(make(options, view), flush=True)
    return 1 if missing else 0
