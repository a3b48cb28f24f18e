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

import dialects
import frame
import reflect
from npm import ready
from spirv import INPUT, OUTPUT, Module

ROOT = Path(__file__).resolve().parent.parent
INCLUDES = ROOT / "shaders/include"
CONSTANT = re.compile(r"constant_id = [^)]*\)\s*const \w+ (\w+) = [^;]*;[ \t]*(?://[ \t]*(.*(?:\n {20,}//.*)*))?")


def listed(build: Path) -> list[tuple[str, Path, list[str], Path]]:
    """(name, source, defines, the library's module) of each entry of gnomon_shaders() for a GPU."""
    found = []
    for target in ("gnomon_spirv", "gnomon_classic_spirv"):
        folder = build / "shaders" / target
        for line in (folder / f"{target}.txt").read_text(encoding="utf-8").splitlines():
            name, source, defines = line.split(":")
            split = [one for one in defines.split(",") if one]
            if dialects.FOR_SOFTWARE not in split:
                found.append((name, ROOT / "shaders" / source, split, folder / f"{name}.spv"))
    return sorted(found)


def purpose(source: Path) -> str:
    """The comment that a source begins with."""
    lines = source.read_text(encoding="utf-8").splitlines()[2:]
    end = next(i for i, line in enumerate(lines) if not line.startswith("//"))
    return " ".join(line[2:].strip() for line in lines[:end])


def meanings(source: Path) -> dict[str, str]:
    """What comments say of specialisation constants, in the source and all that it may include."""
    found = {}
    for file in [*sorted(INCLUDES.rglob("*.glsl")), source]:
        for name, comment in CONSTANT.findall(file.read_text(encoding="utf-8")):
            if comment:
                found[name] = re.sub(r"\s*\n\s*//\s*", " ", comment).strip()
    return found


def describe(name: str, source: Path, defines: list[str], module: Module) -> dict:
    types = reflect.Types(module)
    stage = dialects.STAGES[source.suffix]
    said = meanings(source)
    constants = [one | ({"meaning": said[one["name"]]} if one["name"] in said else {}) for one in reflect.constants_of(module, types)]
    described = {"name": name, "source": f"shaders/passes/{source.name}", "defines": defines, "purpose": purpose(source), "stage": stage,
                 "entry_point": "main", "inputs": reflect.inputs_of(module, types), "constants": constants}
    if workgroup := reflect.workgroup_of(module):
        described["workgroup_size"] = workgroup
    else:
        described |= {"stage_inputs": reflect.handed_on(module, types, INPUT), "stage_outputs": reflect.handed_on(module, types, OUTPUT)}
    described["structs"] = {key: types.structs[key] for key in sorted(types.structs)}
    return described


def make_module(entry: tuple, wanted: list[str], out: Path, scratch: Path) -> dict:
    name, source, defines, made = entry
    base = scratch / f"{name}.spv"
    module = dialects.readable(source, defines, INCLUDES, base)
    described = describe(name, source, defines, module)
    described |= {"files": {}, "bindings": {}, "missing": dialects.missing(name, module)}
    any_format = any(one.get("format") == "any" for one in described["inputs"])
    for dialect in [one for one in wanted if one not in described["missing"]]:
        described["files"][dialect] = {}
        for form in dialects.FORMATS.get(dialect, (None,)) if any_format else (None,):
            file = f"{dialect}/{name}.{form + '.' if form else ''}{dialects.ENDINGS[dialect]}"
            described["files"][dialect][form or "any"] = file
            if dialect == "spirv":
                shutil.copyfile(made, out / file)
            else:
                text = dialects.write(name, base.read_bytes(), dialect, described["inputs"], scratch, form)
                (out / file).write_text(text, encoding="utf-8", newline="\n")
        if dialect != "spirv":
            described["bindings"][dialect] = dialects.bindings(dialect, described["stage"], described["inputs"])
    for one in described["inputs"]:
        del one["id"]
    return described


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
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count() or 1))) as pool:
        modules = list(pool.map(lambda entry: make_module(entry, wanted, out, Path(scratch)), entries))
        if "wgsl" in wanted:
            translate_wgsl(out, build)
    version = re.search(r"project\(gnomon VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    structs = {}
    for one in modules:
        for name, members in one.pop("structs").items():
            if structs.setdefault(name, members) != members:
                raise RuntimeError(f"{one['name']} lays {name} out otherwise than modules before it")
    kit = {"gnomon": version, "dialects": wanted, "fixed": dialects.FIXED, "frame": frame.order([one["name"] for one in modules]),
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
    except (OSError, RuntimeError) as error:
        print(f"kit: {error}", file=sys.stderr)
        return 1
    files = sum(len(forms) for one in kit["modules"] for forms in one["files"].values())
    missing = sum(len(one["missing"]) for one in kit["modules"])
    print(f"kit: {len(kit['modules'])} modules, {files} files in {options.out}; {missing} that a dialect cannot have")
    return 0


if __name__ == "__main__":
    sys.exit(main())
