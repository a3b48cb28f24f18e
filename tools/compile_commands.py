# SPDX-License-Identifier: Apache-2.0
"""How each source is compiled, as a configured build folder has it."""

import json
import shlex
from pathlib import Path


def commands_of(build: Path) -> list[dict]:
    """The entries of compile_commands.json: "file", "command", "directory". Throws OSError where there is none."""
    return json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))


def flags_of(entry: dict) -> tuple[str, ...]:
    """A command's flags, without the compiler and what names the source and what it makes."""
    words = shlex.split(entry["command"])
    first = next(at for at, word in enumerate(words) if word.startswith("-"))
    flags, skip = [], False
    for word in words[first:]:
        if skip or word in ("-c", "-MD", "-Werror", entry["file"]):
            skip = False
        elif word in ("-o", "-MF", "-MT"):
            skip = True
        else:
            flags.append(word)
    return tuple(flags)
