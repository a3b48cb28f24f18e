# SPDX-License-Identifier: Apache-2.0
"""Structs and functions of the C interface as TypeScript: layouts.ts has a table of where members lie in WebAssembly's memory, and an
interface with the header's comments for each struct; layout_check.cpp lets the compiler hold both to the header; exports.txt
names the functions. No struct is typed twice."""

import re
from pathlib import Path
from typing import NamedTuple

# Bytes of each type, which is also its alignment. Pointers and size_t have 32 bits in WebAssembly.
SIZES = {"uint16_t": 2, "uint32_t": 4, "uint64_t": 8, "float": 4, "double": 8, "pointer": 4}
TYPES = {"uint16_t": "u16", "uint32_t": "u32", "uint64_t": "u64", "float": "f32", "double": "f64", "pointer": "ptr", "text": "text"}


class Member(NamedTuple):
    name: str
    kind: str       # of SIZES, "text", or a struct
    counts: list[int]
    offset: int
    comment: str


class Struct(NamedTuple):
    name: str
    comment: str
    members: list[Member]
    size: int
    alignment: int


def camel(name: str) -> str:
    first, *rest = name.split("_")
    return first + "".join(one.capitalize() for one in rest)


# Those of wasm/precision.cpp.
OWN_FUNCTIONS = ("gnomonWebNormalError", "gnomonWebNormalErrorFromDepth")
# Structs and enums that would hide a name of the language, or that src/ hands on in another form.
OTHER_NAMES = {"GnomonError": "ErrorTexts", "GnomonBuffer": "BufferKind", "GnomonPlan": "PlanHead", "GnomonFrame": "FrameHead"}


def plain(name: str) -> str:
    return OTHER_NAMES.get(name, name.removeprefix("Gnomon"))


class Header:
    """The declarations of the C headers."""

    def __init__(self, texts: list[str]):
        self.structs: dict[str, Struct] = {}
        self.enums: dict[str, tuple[str, list[tuple[str, int, str]]]] = {}
        self.functions: list[str] = []
        self.numbers: list[tuple[str, str]] = []
        for text in texts:
            for comment, kind, body, name in re.findall(r"((?:^///[^\n]*\n)*)^typedef (enum|struct) \w+ \{(.*?)\} (\w+);", text,
                                                        re.MULTILINE | re.DOTALL):
                said = " ".join(line[3:].strip() for line in comment.splitlines())
                if kind == "enum":
                    rows = re.findall(r"(\w+) = (\d+),?(?: *// *([^\n]*))?", body)
                    self.enums[name] = (said, [(key, int(value), note) for key, value, note in rows])
                else:
                    self.structs[name] = self._struct(name, said, body)
            self.numbers += re.findall(r"^#define GNOMON_(\w+) (0x[0-9A-F]+|\d+)U", text, re.MULTILINE)
            self.functions += re.findall(r"^GNOMON_C_API [^(]*?(\w+)\(", text, re.MULTILINE)

    def _struct(self, name: str, comment: str, body: str) -> Struct:
        members, offset, widest = [], 0, 1
        for declared, note in re.findall(r"^\s*(\w[^;\n]*);(?: *// *([^\n]*))?", body, re.MULTILINE):
            words, member, counts = re.match(r"(.*?)(\w+)((?:\[\d+\])*)$", declared.strip()).groups()
            base, stars = words.replace("const", "").replace("*", "").strip(), words.count("*")
            kind = ("text" if base == "char" else "pointer") if stars else "uint32_t" if base in self.enums else base
            if kind not in SIZES and kind != "text" and kind not in self.structs:
                raise ValueError(f"{name}.{member} is of type {base}, which the generator does not know; teach it in tools/layouts.py")
            size, alignment = self._extent(kind)
            numbers = [int(one) for one in re.findall(r"\d+", counts)]
            offset = -(-offset // alignment) * alignment
            members.append(Member(member, kind, numbers, offset, note))
            for number in numbers:
                size *= number
            offset, widest = offset + size, max(widest, alignment)
        return Struct(name, comment, members, -(-offset // widest) * widest, widest)

    def _extent(self, kind: str) -> tuple[int, int]:
        if kind in self.structs:
            return self.structs[kind].size, self.structs[kind].alignment
        size = SIZES["pointer" if kind == "text" else kind]
        return size, size


def script_type(member: Member) -> str:
    if member.kind == "text":
        return "string"
    one = plain(member.kind) if member.kind not in SIZES else "bigint" if member.kind == "uint64_t" else "number"
    return one + "[]" * len(member.counts)


def is_shown(member: Member) -> bool:
    return member.kind != "pointer" and not member.name.startswith("reserved")


def interface(struct: Struct) -> str:
    lines = [f"/** {struct.comment} */", f"export interface {plain(struct.name)} {{"]
    for member in filter(is_shown, struct.members):
        if member.comment:
            lines.append(f"    /** {member.comment} */")
        lines.append(f"    {camel(member.name)}: {script_type(member)};")
    return "\n".join([*lines, "}"])


def table(struct: Struct) -> str:
    rows = []
    for member in struct.members:
        kind = TYPES.get(member.kind, plain(member.kind))
        if not member.name.startswith("reserved"):
            rows.append(f"        ['{camel(member.name)}', '{kind}', {member.offset}, {member.counts}],")
    return "\n".join([f"    {plain(struct.name)}: {{size: {struct.size}, members: [", *rows, "    ]},"])


def enum(name: str, comment: str, rows: list[tuple[str, int, str]]) -> str:
    words = [key.removeprefix("GNOMON_") for key, _, _ in rows]
    if len(words) > 1 and len({one.split("_")[0] for one in words}) == 1:
        words = [one.split("_", 1)[1] for one in words]
    lines = [f"/** {comment} */", f"export const {plain(name)} = {{"]
    lines += [f"    {camel(word.lower())}: {value},{f' // {note}' if note else ''}" for word, (_, value, note) in zip(words, rows)]
    return "\n".join([*lines, "} as const;"])


def write(headers: list[Path], script: Path, check: Path, exports: Path) -> None:
    header = Header([one.read_text(encoding="utf-8") for one in headers])
    structs = list(header.structs.values())
    parts = ["// SPDX-License-Identifier: Apache-2.0\n// Made by tools/layouts.py from the C headers. Lengths are metres and angles radians.",
             *(f"export const {name} = {number};" for name, number in header.numbers), *(enum(name, *rest) for name, rest in header.enums.items()), *(interface(one) for one in structs),
             "/** Members: name, type, offset in bytes, counts of arrays. */\n"
             "export type Layout = {size: number, members: [name: string, type: string, offset: number, counts: number[]][]};\n"
             "export const LAYOUTS: Record<string, Layout> = {\n" + "\n".join(table(one) for one in structs) + "\n};"]
    script.write_text("\n".join(parts) + "\n", encoding="utf-8")
    lines = [f"#include <gnomon/{one.name}>" for one in headers] + ["#include <stddef.h>"]
    for one in structs:
        lines.append(f"static_assert(sizeof({one.name}) == {one.size});")
        lines += [f"static_assert(offsetof({one.name}, {member.name}) == {member.offset});" for member in one.members]
    _keep("\n".join(lines) + "\n", check)
    _keep("\n".join([*header.functions, *OWN_FUNCTIONS, "malloc", "free"]) + "\n", exports)


def _keep(text: str, path: Path) -> None:
    """Writes a file where it differs, so that what depends on it is built then alone."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
