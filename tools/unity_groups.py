#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sorts targets' sources into groups that compile as one source each. Called by cmake/unity.cmake.

usage: unity_groups.py (--target NAME SOURCE...)...     prints one line for each source: its target, its group's name, its path

Two sources may not share a group when one declares a name in an unnamed namespace, as a static, or as a macro, that the
other declares or uses too, or a header beside it that it includes. A name that
both bring in from the same namespace, as in "using nlohmann::json;", is one. The
layout puts every declaration of a namespace at the start of a line, so the names are found without parsing C++. A group
is of one folder: another may mean something else by a name. A source that opens a namespace for all that follows has a
group for itself; so has one that defines a macro for a header, which other sources include without it, and one with a
line "// Compiled alone: WHY", for clashes that this cannot see.
"""

import argparse
import re
from pathlib import Path

MOST_LINES = 2500  # in a group: more saves little, and leaves a processor waiting for the last one
WORDS_BEFORE_NO_NAME = {"namespace", "using", "return", "public", "private", "protected", "case", "default", "extern"}
LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"')
TYPE = re.compile(r"^(?:template <[^>]*> )?(?:struct|class|union|enum(?: class)?) (\w+)")
ALIAS = re.compile(r"^using (\w+) =")
MACRO = re.compile(r"^# *define (\w+)", re.MULTILINE)
TEST = re.compile(r"^(?:TYPED_)?(?:TEST|TEST_F|TEST_P|INSTANTIATE_TEST_SUITE_P)\((\w+), *(\w+)")
ALONE = re.compile(r"^using (?:namespace|enum) |^// Compiled alone: ", re.MULTILINE)
FOR_A_HEADER = re.compile(r"^#define (?:.*\n)*#include ", re.MULTILINE)
BROUGHT = re.compile(r"^using ([\w:]*::(\w+));", re.MULTILINE)
INCLUDED = re.compile(r'^#include "([^"/]+)"', re.MULTILINE)
# The same alias may stand twice.
OTHER_NAME = re.compile(r"^namespace (\w+) =", re.MULTILINE)
# Tokens that may name a thing declared elsewhere: a type, a constant or macro, a function that is called; members not.
USED = re.compile(r"(?<![.\w>])(?:[A-Zk]\w*|[a-z]\w*(?=\())")
# The name before a parameter list, an initialiser or the end.
DECLARED = re.compile(r"([A-Za-z_]\w*)(?:\[[^\]]*\])*(?: = |[({;=]|$)")


def name_in(line: str):
    """What a line at the start of a declaration declares, None when that is nothing."""
    for pattern in (TYPE, ALIAS):
        if found := pattern.match(line):
            return found[1]
    if found := TEST.match(line):
        return found[1] + "." + found[2]
    if not re.match(r"[A-Za-z_]", line) or line.split()[0].rstrip(":") in WORDS_BEFORE_NO_NAME:
        return None
    # A template's arguments hold names too, but not this one's.
    while (less := re.sub(r"<[^<>]*>", "", line)) != line:
        line = less
    found = DECLARED.search(line)
    return found[1] if found else None


def names_of(text: str) -> set[str]:
    """Names that this source alone means, without those that it brings in from a namespace."""
    names = set(MACRO.findall(text))
    unnamed = False
    for line in text.split("\n"):
        if line == "namespace {":
            unnamed = True
        elif line.startswith("} // namespace"):
            unnamed = False
        elif unnamed or line.startswith("static "):
            names.add(name_in(line))
    return names - {None}


def used_by(text: str, folder: Path, seen: set[Path]) -> set[str]:
    """Names that a text and the headers in `folder` that it includes may use; adds those to `seen`."""
    used = set(USED.findall(LITERALS.sub('""', text)) + OTHER_NAME.findall(text))
    for name in INCLUDED.findall(text):
        header = folder / name
        if header not in seen and header.is_file():
            seen.add(header)
            used |= used_by(header.read_text(encoding="utf-8"), folder, seen)
    return used


def groups_of(sources: list[str]) -> list[list[str]]:
    """Each source goes into its folder's first group that has room and none of its names."""
    groups = []
    for source in sources:
        folder = Path(source).parent
        text = Path(source).read_text(encoding="utf-8")
        used = used_by(text, folder, set())
        text = LITERALS.sub('""', text)
        names, brought = names_of(text), {name: whole for whole, name in BROUGHT.findall(text)}
        alone = ALONE.search(text) or FOR_A_HEADER.search(text)
        lines = MOST_LINES + 1 if alone else text.count("\n")
        for group in groups:
            clash = names & (group["names"] | group["used"]) or used & group["names"]
            # A name that both bring in is one thing; one that one of them brings in, the other may not mean otherwise.
            same = {name for name, _ in group["brought"].items() & brought.items()}
            clash = clash or (brought.keys() - same) & (group["names"] | group["used"] | group["brought"].keys())
            clash = clash or (group["brought"].keys() - same) & (names | used)
            if group["folder"] == folder and group["lines"] + lines <= MOST_LINES and not clash:
                break
        else:
            group = {"folder": folder, "lines": 0, "names": set(), "used": set(), "brought": {}, "sources": []}
            groups.append(group)
        group["lines"] += lines
        group["names"] |= names
        group["used"] |= used
        group["brought"] |= brought
        group["sources"].append(source)
    return [group["sources"] for group in groups]


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--target", nargs="+", action="append", default=[], metavar=("NAME", "SOURCE"))
    for target, *sources in parser.parse_args().target:
        for number, together in enumerate(groups_of(sorted(sources)), 1):
            for path in together:
                print(target, f"part{number}", path)
