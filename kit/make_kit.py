#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the kit: every pass in each dialect, and passes.json, which says what they are and how they are bound (docs/kit.md).

usage: make_kit.py [--without DIALECT]... BUILD OUT

BUILD has the library's modules (targets gnomon_spirv_modules and gnomon_classic_spirv_modules). OUT is made anew. WGSL is made
by npm packages, which are installed in BUILD/kit_npm at the versions of kit/package-lock.json. Needs glslc, spirv-tools and
spirv-cross. The same sources make the same bytes.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import dialects
import frame
import reflect
from npm import ready
from spirv import INPUT, OUTPUT, Module

ROOT = Path(__file__).resolve().parent.parent
INCLUDES = ROOT / "shaders/include"
CONSTANT = re.compile(r"constant_id = [^)]*\)\s*const \w+ (\w+) = [^;]*;[ \t]*(?://[ \t]*(.*(?:\n {20,}//.*)*))?")


class Entry(NamedTuple):
    name: str
    source: Path
    defines: list[str]
    made: Path  # the library's own module


def listed(build: Path) -> list[Entry]:
    """Each entry of gnomon_shaders() that is for a GPU."""
    found = []
    for target in ("gnomon_spirv", "gnomon_classic_spirv"):
        folder = build / "shaders" / target
        for line in (folder / f"{target}.txt").read_text(encoding="utf-8").splitlines():
            name, source, defines = line.split(":")
            split = [one for one in defines.split(",") if one]
            if dialects.FOR_SOFTWARE not in split:
                found.append(Entry(name, ROOT / "shaders" / source, split, folder / f"{name}.spv"))
    return sorted(found)


def purpose(source: Path) -> str:
    """The comment that a source begins with."""
    lines = source.read_text(encoding="utf-8").splitlines()[2:]
    end = next(i for i, line in enumerate(lines) if not line.startswith("//"))
    return " ".join(line[2:].strip() for line in lines[:end])


def meanings(source: Path) -> dict[str, str]:
    """What comments say of specialisation constants, in the source and all that it may include."""
    found = {}
    for file in [*sorted(INCLUDES.rglob("*.glsl")), source]: # the source's own come last, and count
        for name, comment in CONSTANT.findall(file.read_text(encoding="utf-8")):
            if comment:
                found[name] = re.sub(r"\s*\n\s*//\s*", " ", comment).strip()
    return found


def describe(entry: Entry, module: Module, fixed: dict[str, int]) -> dict:
    name, source, defines, _ = entry
    types = reflect.Types(module)
    stage = dialects.STAGES[source.suffix]
    said = meanings(source)
    constants = [one | ({"meaning": said[one["name"]]} if one["name"] in said else {}) for one in reflect.constants_of(module, types)]
    described = {"name": name, "source": f"shaders/passes/{source.name}", "defines": defines, "purpose": purpose(source), "stage": stage,
                 "inputs": reflect.inputs_of(module, types), "constants": constants,
                 "fixed": [{"id": number, "name": said_as, "value": dialects.FIXED[said_as]} for said_as, number in fixed.items()]}
    if workgroup := reflect.workgroup_of(module):
        described["workgroup_size"] = workgroup
    else:
        described |= {"stage_inputs": reflect.handed_on(module, types, INPUT), "stage_outputs": reflect.handed_on(module, types, OUTPUT)}
    return described | {"structs": types.structs, "files": {}, "bindings": {}, "missing": dialects.missing(name, module)}


def read(entry: Entry, scratch: Path) -> dict:
    """The module without optimisation in the folder `scratch`, and what passes.json says of it."""
    base = scratch / f"{entry.name}.spv"
    module, fixed = dialects.readable(entry.source, entry.defines, INCLUDES, base)
    return describe(entry, module, fixed)


def write(entry: Entry, described: dict, given: list[dict], wanted: list[str], out: Path, scratch: Path) -> None:
    """The files of a module. `given`: what the vertex shaders hand on that it is drawn with."""
    name, inputs = entry.name, described["inputs"]
    for dialect in [one for one in wanted if one not in described["missing"]]:
        described["files"][dialect] = {}
        for form in dialects.forms(name, dialect, inputs):
            file = f"{dialect}/{name}.{form + '.' if form else ''}{dialects.ENDINGS[dialect]}"
            described["files"][dialect][form or "any"] = file
            if dialect == "spirv":
                shutil.copyfile(entry.made, out / file)
            else:
                module = Module((scratch / f"{name}.spv").read_bytes())
                (out / file).write_text(dialects.write(name, module, dialect, inputs, given, scratch, form), encoding="utf-8", newline="\n")
        if dialect != "spirv":
            described["bindings"][dialect] = dialects.bindings(dialect, described["stage"], inputs)


def translate_wgsl(out: Path, build: Path) -> None:
    """The WGSL files name modules until here."""
    files = sorted((out / "wgsl").glob("*.wgsl"))
    done = subprocess.run(["node", "to_wgsl.mjs", *(str(one.resolve()) for one in files)], cwd=ready(build, checking=False),
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"to_wgsl.mjs: {done.stderr.strip()}")


def make(build: Path, out: Path, wanted: list[str]) -> dict:
    shutil.rmtree(out, ignore_errors=True)
    for dialect in wanted:
        (out / dialect).mkdir(parents=True)
    entries = listed(build)
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count() or 1))) as pool:
        scratch = Path(folder)
        modules = list(pool.map(lambda entry: read(entry, scratch), entries))
        passes = frame.order([one.name for one in entries])
        outputs = {one["name"]: one.get("stage_outputs", []) for one in modules}
        given = {fragment: outputs[vertex] for vertex, fragment in (pair for pair in frame.programs(passes) if len(pair) == 2)}
        list(pool.map(lambda entry, module: write(entry, module, given.get(entry.name, []), wanted, out, scratch), entries, modules))
        if "wgsl" in wanted:
            translate_wgsl(out, build)
    for one in modules:
        for member in one["inputs"]:
            del member["id"]
    version = re.search(r"project\(gnomon VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    structs = {}
    for one in modules:
        for name, members in one.pop("structs").items():
            if structs.setdefault(name, members) != members:
                raise RuntimeError(f"{one['name']} lays {name} out otherwise than modules before it")
    kit = {"gnomon": version, "dialects": {one: dialects.HOW[one] for one in wanted}, "frame": passes,
           "structs": dict(sorted(structs.items())), "modules": modules}
    (out / "passes.json").write_text(json.dumps(kit, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return kit


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--without", action="append", default=[], choices=dialects.DIALECTS)
    parser.add_argument("build", type=Path)
    parser.add_argument("out", type=Path)
    options = parser.parse_args()
    try:
        kit = make(options.build, options.out, [one for one in dialects.DIALECTS if one not in options.without])
    except (OSError, RuntimeError, ValueError) as error:
        print(f"kit: {error}", file=sys.stderr)
        return 1
    files = sum(len(forms) for one in kit["modules"] for forms in one["files"].values())
    missing = sum(len(one["missing"]) for one in kit["modules"])
    print(f"kit: {len(kit['modules'])} modules, {files} files in {options.out}; {missing} that a dialect cannot have")
    return 0


if __name__ == "__main__":
    sys.exit(main())
