#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Hands a kit to each dialect's own compilers, and holds the table of docs/kit.md to what they say.

usage: check_kit.py [--with COMPILER]... [--update] KIT BUILD

COMPILER is one of COMPILERS below; without --with all of them are asked. BUILD is where npm packages are installed. A table's
mark that is of no compiler that was asked is left as it is. --update writes the table anew. Exit status 1 where the table and
the compilers differ, 77 where nothing differs but a compiler is not on this machine.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import dialects
import frame
import gl
import npm

PAGE = Path(__file__).resolve().parent.parent / "docs/kit.md"
BEGIN, END = "<!-- made by kit/check_kit.py --update -->", "<!-- to here -->"
ROOT_SIGNATURE = "<!-- kit/check_kit.py compiles every module with it -->"
PROFILES = {"vertex": "vs_6_0", "fragment": "ps_6_0", "compute": "cs_6_0"}
WINE = ("wine64", "/usr/lib/wine/wine64")


class Absent(Exception):
    """A compiler is not on this machine, and what is missing."""


class File(NamedTuple):
    module: str
    form: str  # of dialects.forms(); else "any"
    stage: str
    path: Path


Refusals = dict[str, str]  # by module, the first line of why


def program(*names: str) -> str:
    for name in names:
        if found := shutil.which(name):
            return found
    raise Absent(f"there is no {names[0]}")


def by_lines(text: str, files: list[File]) -> Refusals:
    """Of a program that prints "FILE: MESSAGE"."""
    refused = {}
    for file in files:
        for line in text.splitlines():
            if line.startswith(f"{file.path}: "):
                refused[file.module] = line[len(str(file.path)) + 2:]
    return refused


def ask_spirv_val(files: list[File], kit: dict, build: Path) -> Refusals:
    tool, refused = program("spirv-val"), {}
    for file in files:
        done = subprocess.run([tool, "--target-env", "vulkan1.3", str(file.path)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            refused[file.module] = (done.stderr.splitlines() or ["refused"])[0]
    return refused


def ask_glslang(files: list[File], kit: dict, build: Path) -> Refusals:
    """All files of a stage at once. It prints a file's name, and then what is wrong with it."""
    tool, refused = program("glslangValidator"), {}
    for stage in dialects.STAGES.values():
        names = {str(one.path): one.module for one in files if one.stage == stage}
        done = subprocess.run([tool, "-S", stage[:4], *names], capture_output=True, text=True, check=False)
        module = ""
        for line in done.stdout.splitlines():
            module = names.get(line, module)
            if line.startswith("ERROR"):
                refused.setdefault(module, line)
        if (done.returncode != 0) != any(one in refused for one in names.values()):
            raise RuntimeError(f"glslangValidator ended with status {done.returncode}: {done.stdout[-300:]}")
    return refused


def ask_mesa(files: list[File], kit: dict, build: Path) -> Refusals:
    """Each module, and each program that the frame makes of two."""
    dialect = files[0].path.parent.name
    try:
        driver = gl.Driver(dialect)
    except OSError as error:
        raise Absent(str(error)) from error
    refused, shaders = {}, {}
    for file in files:
        shaders[file.module, file.form], wrong = driver.compile(file.stage, file.path.read_text(encoding="utf-8"))
        if wrong:
            refused[file.module] = wrong
    # A program of OpenGL ES has a fragment shader, if it is an empty one.
    nothing = [driver.compile("fragment", "#version 310 es\nvoid main() {}")[0]] if dialect == "essl" else []
    names = {one.module for one in files} - refused.keys()
    for program_of in frame.programs(kit["frame"]):
        if names.issuperset(program_of):
            empty = nothing if len(program_of) == 1 and program_of[0].endswith(".vert") else []
            wrong = driver.link([shaders[key] for key in joined(program_of, kit, shaders)] + empty)
            if wrong:
                refused[program_of[-1]] = f"with {program_of[0]}: {wrong}"
    return refused


def joined(program_of: tuple[str, ...], kit: dict, there) -> list[tuple[str, str]]:
    """The files of a program, by module and form: the vertex shader that a fragment shader by samples needs."""
    by_sample = any(given.get("per_sample") for one in kit["modules"] if one["name"] == program_of[-1] for given in one.get("stage_inputs", []))
    return [next((name, form) for form in ("sample" if by_sample else "any", "any", "rgba16f") if (name, form) in there) for name in program_of]


def ask_dxc(files: list[File], kit: dict, build: Path) -> Refusals:
    wine, compiler = program(*WINE), program("x86_64-w64-mingw32-gcc")
    folder = npm_folder(build)
    made = folder / "dxc.exe"
    subprocess.run([compiler, "-std=c17", "-O1", "-Wall", "-Wextra", "-Werror", "-o", str(made), str(npm.HERE / "dxc.c")], check=True)
    library = folder / "node_modules/webgpu/dist/win32-x64/dxcompiler.dll"
    words = [word for file in files for word in (PROFILES[file.stage], str(file.path))]
    done = subprocess.run([wine, str(made), str(library), root_signature(), *words], capture_output=True, text=True, check=False, timeout=600,
                          env={**os.environ, "WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all"})
    if done.returncode != 0:
        raise RuntimeError(f"dxc.exe ended with status {done.returncode}: {done.stdout.strip()}")
    return by_lines(done.stdout, files) | unlinked(done.stdout, files, kit)


def root_signature() -> str:
    """The one that docs/direct3d.md has for all modules, as a macro's value."""
    text = (PAGE.parent / "direct3d.md").read_text(encoding="utf-8").partition(ROOT_SIGNATURE)[2]
    return '"' + " ".join(text.partition("```hlsl")[2].partition("```")[0].split()) + '"'


def unlinked(text: str, files: list[File], kit: dict) -> Refusals:
    """Direct3D joins stages by registers: what a pixel shader takes has to be in the same one that the vertex shader wrote."""
    signatures: dict[tuple[str, str], dict[str, set[str]]] = {(file.module, file.form): {"i": set(), "o": set()} for file in files}
    keys = {str(file.path): (file.module, file.form) for file in files}
    for path, kind, element in re.findall(r"^(.*)@([io]) (.*)$", text, re.MULTILINE):
        signatures[keys[path]][kind].add(element.rstrip())
    refused = {}
    for pair in [one for one in frame.programs(kit["frame"]) if len(one) == 2]:
        vertex, fragment = (signatures[key] for key in joined(pair, kit, signatures))
        if lost := fragment["i"] - vertex["o"]:
            refused[pair[1]] = f"{pair[0]} does not hand on {', '.join(sorted(lost))}"
    return refused


def ask_dawn(files: list[File], kit: dict, build: Path) -> Refusals:
    """Each module, and each pipeline that the frame makes of them."""
    node = program("node")
    told = {"kit": kit, "folder": str(files[0].path.parent.parent), "programs": frame.programs(kit["frame"])}
    done = subprocess.run([node, "check_wgsl.mjs"], input=json.dumps(told), cwd=npm_folder(build), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"check_wgsl.mjs: {done.stderr.strip()}")
    return dict(line.split(": ", 1) for line in done.stdout.splitlines() if not line.startswith(" "))


def npm_folder(build: Path) -> Path:
    try:
        return npm.ready(build, checking=True)
    except RuntimeError as error:
        raise Absent(str(error)) from error


class Compiler(NamedTuple):
    mark: str
    dialects: tuple[str, ...]
    ask: Callable[[list[File], dict, Path], Refusals]


COMPILERS = {"spirv-val": Compiler("V", ("spirv",), ask_spirv_val), "glslang": Compiler("G", ("glsl", "essl"), ask_glslang),
             "mesa": Compiler("M", ("glsl", "essl"), ask_mesa), "dxc": Compiler("D", ("hlsl",), ask_dxc), "dawn": Compiler("W", ("wgsl",), ask_dawn)}


def files_of(kit: dict, folder: Path, dialect: str) -> list[File]:
    return [File(one["name"], form, one["stage"], (folder / path).resolve())
            for one in kit["modules"] for form, path in one["files"].get(dialect, {}).items()]


def ask_all(kit: dict, folder: Path, build: Path, asked: list[str]) -> tuple[dict[str, dict[str, str]], set[str], list[str]]:
    """By dialect and module, the marks of who took it; the marks of who has answered; and a line for each who is not here."""
    marks = {dialect: {one.module: "" for one in files_of(kit, folder, dialect)} for dialect in kit["dialects"]}
    answered, absent = set(), []
    for name in asked:
        for dialect in COMPILERS[name].dialects:
            files = files_of(kit, folder, dialect)
            try:
                refused = COMPILERS[name].ask(files, kit, build) if files else {}
            except Absent as error:
                absent.append(f"{name} does not check {dialect}: {error}")
                continue
            answered.add(COMPILERS[name].mark)
            for module in marks.get(dialect, {}):
                marks[dialect][module] += "" if module in refused else COMPILERS[name].mark
            for module, why in sorted(refused.items()):
                print(f"kit: {name} refuses {module} as {dialect}: {why}")
    return marks, answered, absent


def called_together(names: list[str]) -> str:
    """a.comp, a_b.comp: a{,_b}.comp"""
    stems = [name.rsplit(".", 1)[0] for name in names]
    common = os.path.commonprefix(stems)
    if common not in stems and "_" in common:
        common = common[:common.rindex("_") + 1]
    return names[0] if len(names) == 1 else f"{common}{{{','.join(stem[len(common):] for stem in stems)}}}.{names[0].rsplit('.', 1)[1]}"


def table(kit: dict, cells: dict[str, list[str]]) -> str:
    heads = [{"spirv": "SPIR-V"}.get(one, one.upper()) for one in dialects.DIALECTS]
    lines = [f"| modules | {' | '.join(heads)} |", "|---" * (len(heads) + 1) + "|"]
    grouped: dict[tuple, dict[str, list[str]]] = {}
    for one in kit["modules"]:
        grouped.setdefault(tuple(cells[one["name"]]), {}).setdefault(one["source"], []).append(one["name"])
    lines += [f"| {', '.join(f'`{called_together(names)}`' for names in sources.values())} | {' | '.join(row)} |" for row, sources in grouped.items()]
    count = len(kit["modules"])
    counts = [sum(row[i] != "–" for row in cells.values()) for i in range(len(heads))]
    lines.append(f"| {count} modules | {' | '.join(map(str, counts))} |")
    reasons = {}
    for one in kit["modules"]:
        for dialect, why in one["missing"].items():
            reasons.setdefault(why, {}).setdefault(one["name"], []).append(dialect.upper())
    for why, names in reasons.items():
        dialects_of = sorted({dialect for some in names.values() for dialect in some})
        lines += ["", f"`{called_together(list(names))}` is missing as {' and '.join(dialects_of)}: {why}."]
    return "\n".join(lines)


def called_alone(pattern: str) -> list[str]:
    """The names that called_together() has made one of."""
    opened = re.fullmatch(r"(.*)\{(.*)\}(.*)", pattern)
    return [opened[1] + part + opened[3] for part in opened[2].split(",")] if opened else [pattern]


def kept_cells(text: str) -> dict[tuple[str, str], str]:
    """The cells of a table, by module and dialect."""
    found = {}
    for patterns, row in re.findall(r"^\| (`[^|]+`) \| (.*) \|$", text, re.MULTILINE):
        for name in [name for pattern in re.findall("`([^`]+)`", patterns) for name in called_alone(pattern)]:
            found |= {(name, dialect): cell for dialect, cell in zip(dialects.DIALECTS, row.split(" | "), strict=True)}
    return found


def cell_of(module: dict, dialect: str, marks: dict[str, dict[str, str]], kept: str, answered: set[str]) -> str:
    """The compilers that took the module. The table says it of compilers that have not answered, and of a dialect that this kit is without."""
    if dialect in module["missing"]:
        return "–"
    if dialect not in module["files"]:
        return kept
    said = marks[dialect][module["name"]]
    return "".join(one.mark for one in COMPILERS.values() if dialect in one.dialects and one.mark in (said if one.mark in answered else kept)) or "made"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--with", dest="asked", action="append", choices=COMPILERS)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--page", type=Path, default=PAGE)
    parser.add_argument("kit", type=Path)
    parser.add_argument("build", type=Path)
    options = parser.parse_args()
    kit = json.loads((options.kit / "passes.json").read_text(encoding="utf-8"))
    marks, answered, absent = ask_all(kit, options.kit, options.build, options.asked or list(COMPILERS))
    for line in absent:
        print(f"kit: SKIPPED: {line}")
    head, rest = options.page.read_text(encoding="utf-8").split(BEGIN + "\n")
    before, tail = rest.split("\n" + END)
    kept = kept_cells(before)
    cells = {one["name"]: [cell_of(one, dialect, marks, kept.get((one["name"], dialect), ""), answered) for dialect in dialects.DIALECTS]
             for one in kit["modules"]}
    made = table(kit, cells)
    if options.update:
        options.page.write_text(f"{head}{BEGIN}\n{made}\n{END}{tail}", encoding="utf-8")
    elif made != before:
        print(f"kit: the table of {options.page.name} is not what compilers say; kit/check_kit.py --update writes it anew", file=sys.stderr)
        return 1
    print(f"kit: {len(kit['modules'])} modules; marks of {''.join(sorted(answered))}")
    return 77 if absent else 0


if __name__ == "__main__":
    sys.exit(main())
