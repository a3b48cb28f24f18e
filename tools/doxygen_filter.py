#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lets Doxygen see the comments of the public headers, which read better plain.

usage: doxygen_filter.py FILE      (the INPUT_FILTER of site/Doxyfile)

Prints the file, line by line, with
  the comment that opens it as the file's documentation,
  `code; // words` and the lines below that go on with it as documentation of that member,
  in GLSL, where /// is not used, a comment before a function, a constant or a structure as its documentation,
  one sentence at what says no more anywhere: destructors, deleted copies, comparisons of all members, nameOf(),
  private parts of classes empty: Doxygen links to structs in them, and shows none.
Nothing else but comments is changed, and no line is added.
"""

import re
import sys
from pathlib import Path

TRAILING = re.compile(r"^(?!\s*//)(?P<code>\s*\S.*?[;,{\w)])\s*//(?![/!]) (?P<words>.*)$")
WHOLE_LINE = re.compile(r"^(?P<indent>\s*)//(?![/!]) ?(?P<words>.*)$")
# Members that mean the same everywhere, and the text that is said there.
BY_ITSELF = [
    (re.compile(r"^\s*(?:virtual )?~\w+\(\)[^;{]*;"), "Frees all that it holds."),
    (re.compile(r"= delete;$"), "Not to be copied."),
    (re.compile(r"operator==\((?:const \w+&, )?const \w+&\)(?: const)? = default;$"), "Equal where all members are."),
    (re.compile(r"string_view nameOf\(\w+ value\);$"), "Its name in commands, presets and results; static text."),
]
# Comments above these are documentation, in GLSL.
GLSL_NAME = re.compile(r"^(?:GN_FN |GN_CONST |const )?\w+ \w+(?:\(|\s=)|^struct \w+|^#define GNOMON_\w+|^layout\(")


def opened(lines: list[str]) -> list[str]:
    """The comment at the top, below the licence, as the file's."""
    end = 1
    while end < len(lines) and lines[end].startswith("//"):
        end += 1
    if end == 1:
        return lines
    return ["/// @file", *("///" + line[2:] for line in lines[1:end]), *lines[end:]]


def trailing(lines: list[str]) -> list[str]:
    """Comments behind members, and their further lines, which stand below and further in than the member does."""
    out = []
    inside = False
    column = 0
    for line in lines:
        found = TRAILING.match(line)
        whole = WHOLE_LINE.match(line)
        if found:
            out.append(f"{found['code']} ///< {found['words']}")
            inside = True
            column = len(found["code"]) - len(found["code"].lstrip()) + 1
        elif inside and whole and len(whole["indent"]) >= column:
            out.append(f"{whole['indent']}///< {whole['words']}")
        else:
            inside = False
            out.append(line)
    return out


def by_itself(line: str) -> str:
    for pattern, words in BY_ITSELF:
        if pattern.search(line) and "//" not in line:
            return f"{line} ///< {words}"
    return line


def public(lines: list[str]) -> list[str]:
    """Without the private parts of classes, which end them."""
    out = []
    hidden = False
    for line in lines:
        hidden = (hidden or line == "private:") and not line.startswith("};")
        out.append("" if hidden else line)
    return out


def glsl(lines: list[str]) -> list[str]:
    """Comments directly before a name."""
    out = list(lines)
    for i, line in enumerate(lines):
        if not GLSL_NAME.match(line):
            continue
        at = i - 1
        while at >= 0 and lines[at].startswith("// "):
            out[at] = "/// " + lines[at][3:]
            at -= 1
    return out


def filtered(text: str, is_glsl: bool) -> str:
    lines = opened(text.splitlines())
    lines = trailing(glsl(lines) if is_glsl else [by_itself(line) for line in public(lines)])
    return "\n".join(lines) + "\n"


def main() -> int:
    file = Path(sys.argv[1])
    sys.stdout.write(filtered(file.read_text(encoding="utf-8"), file.suffix == ".glsl"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
