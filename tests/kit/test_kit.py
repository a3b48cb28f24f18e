#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is passes.json true? usage: test_kit.py KIT LAYOUTS, where LAYOUTS is the program kit_layouts.

It is held to five others: to the files of each dialect, to what spirv-cross reads from the library's own modules, to what
vulkan/ binds, to pack's list of a frame's passes, and to the root signature of docs/direct3d.md. Each of these is also handed a kit with a fault, and must find it.
"""

import copy
import json
import re
import subprocess
import sys
import unittest
from collections.abc import Callable
from functools import cache
from pathlib import Path

KIT, LAYOUTS = Path(sys.argv[1]), sys.argv[2]
ROOT = Path(__file__).resolve().parent.parent.parent
MOST_MISSING = 4  # modules that some dialect cannot have
# Numbers of VkDescriptorType, by kind.
DESCRIPTORS = {"uniform": {6, 8}, "storage": {7, 9}, "texture": {1, 2}, "storage_image": {3}}
# For software rasterisers alone (docs/kit.md).
SOFTWARE = re.compile(r"_one\.(vert|frag)$")


def read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def text_places(dialect: str, text: str) -> set[str]:
    """Where a text says that its inputs lie: "texture_unit 3"."""
    if dialect in ("glsl", "essl"):
        found = set()
        for number, rest in re.findall(r"layout\(binding = (\d+)[^)]*\)([^;{]*)", text):
            kind = ("buffer_binding" if " buffer " in rest else "texture_unit" if "sampler" in rest else "image_unit" if "image2D" in rest
                    else "uniform_binding")
            found.add(f"{kind} {number}")
        return found
    if dialect == "hlsl":
        rest = re.sub(r"cbuffer SPIRV_Cross_VertexInfo[^{]*", "", text) # the first vertex and instance: docs/kit.md
        return {f"{register} {space}" for register, space in re.findall(r": register\((\w+), space(\d+)\)", rest)}
    if dialect == "msl":
        text = re.sub(r"spvBufferSizeConstants \[\[[^]]*\]\]", "", text) # lengths of buffers: docs/kit.md
        return {f"{kind} {number}" for kind, number in re.findall(r"\[\[(buffer|texture|sampler)\((\d+)\)\]\]", text)}
    return {f"{group} {binding}" for group, binding in re.findall(r"@group\((\d+)\) @binding\((\d+)\)", text)}


def said_places(dialect: str, bindings: list[dict]) -> set[str]:
    found = set()
    for one in bindings:
        if dialect == "hlsl":
            found |= {f"{one[key]} {one['space']}" for key in ("register", "sampler") if key in one}
        elif dialect == "wgsl":
            found |= {f"{one['group']} {one[key]}" for key in ("binding", "sampler_binding") if key in one}
        else:
            found |= {f"{key} {value}" for key, value in one.items()}
    return found


def text_constants(dialect: str, text: str) -> set[int]:
    forms = {"wgsl": r"@id\((\d+)\)", "msl": r"(?:function_constant\(|#ifndef SPIRV_CROSS_CONSTANT_ID_)(\d+)"} # a macro where it sizes an array
    return {int(one) for one in re.findall(forms.get(dialect, r"#ifndef SPIRV_CROSS_CONSTANT_ID_(\d+)"), text)}


def faults_of_files(kit: dict, folder: Path) -> list[str]:
    found = []
    for module in kit["modules"]:
        for dialect in kit["dialects"]:
            files = module["files"].get(dialect, {})
            if bool(files) == (dialect in module["missing"]):
                found.append(f"{module['name']} as {dialect}: neither a file nor a reason, or both")
            for file in files.values():
                if not (folder / file).is_file() or (folder / file).stat().st_size == 0:
                    found.append(f"{file} is not there")
                elif dialect != "spirv":
                    text = read(folder / file)
                    if text_places(dialect, text) != said_places(dialect, module["bindings"][dialect]):
                        found.append(f"{file} binds {sorted(text_places(dialect, text) ^ said_places(dialect, module['bindings'][dialect]))} otherwise")
                    if text_constants(dialect, text) != {one["id"] for one in module["constants"]}:
                        found.append(f"{file} has other constants")
        found += [f"{module['name']}: {one['name']} has no meaning" for one in module["constants"] if not one.get("meaning")]
    listed = {file for module in kit["modules"] for files in module["files"].values() for file in files.values()}
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()} - {"passes.json"}
    found += [f"{file} is of no module" for file in sorted(there - listed)]
    if sum(bool(module["missing"]) for module in kit["modules"]) > MOST_MISSING:
        found.append("more modules are missing than before")
    return found


@cache
def reflected(file: Path) -> tuple[set, int, set]:
    """Of an optimised module: (set, binding, kind) of each input, the bytes of push data, ids of constants."""
    read_by = json.loads(subprocess.run(["spirv-cross", file, "--reflect"], capture_output=True, text=True, check=True).stdout)
    kinds = {"ubos": "uniform", "ssbos": "storage", "textures": "texture", "separate_images": "texture", "images": "storage_image"}
    inputs = {(one["set"], one["binding"], kind) for key, kind in kinds.items() for one in read_by.get(key, [])}
    pushed = 0
    for one in read_by.get("push_constants", []):
        pushed = end_of(read_by["types"], one["type"])
    return inputs, pushed, {one["id"] for one in read_by.get("specialization_constants", [])}


def end_of(types: dict, name: str) -> int:
    """Bytes of a struct without what fills it up."""
    sizes = {"float": 4, "int": 4, "uint": 4, "vec2": 8, "ivec2": 8, "uvec2": 8, "vec3": 12, "ivec3": 12, "uvec3": 12, "vec4": 16, "ivec4": 16,
             "uvec4": 16}
    last = types[name]["members"][-1]
    if "matrix_stride" in last:
        size = 4 * last["matrix_stride"]
    else:
        size = sizes.get(last["type"]) or end_of(types, last["type"])
    return last["offset"] + (last["array_stride"] * last["array"][0] if "array" in last else size)


def faults_of_modules(kit: dict, folder: Path) -> list[str]:
    found = []
    for module in kit["modules"]:
        inputs, pushed, constants = reflected(folder / module["files"]["spirv"]["any"])
        said = {(one["set"], one["binding"], one["kind"]) for one in module["inputs"] if one["kind"] != "push"}
        if said != inputs:
            found.append(f"{module['name']} has the inputs {sorted(said ^ inputs)} otherwise")
        push = next((one for one in module["inputs"] if one["kind"] == "push"), {"size": 0, "members": []})
        if (push["members"][-1]["offset"] + push["members"][-1]["size"] if push["members"] else 0) != pushed:
            found.append(f"{module['name']} has {pushed} bytes of push data, not {push['size']}")
        if lost := constants - {one["id"] for one in module["constants"] + module["fixed"]}:
            found.append(f"{module['name']} has the constants {sorted(lost)}, too")
    return found


@cache
def layouts() -> dict[str, tuple[dict, int]]:
    """By module, the descriptor types of each (set, binding) that vulkan/ binds, and the bytes that it pushes at most."""
    found: dict[str, tuple[dict, int]] = {}
    for line in subprocess.run([LAYOUTS], capture_output=True, text=True, check=True).stdout.splitlines():
        name, *words = line.split()
        bound, pushed = found.get(name, ({}, 0))
        if words[:1] == ["push"]:
            pushed = max(pushed, int(words[1]))
        elif words:
            bound.setdefault((int(words[0]), int(words[1])), set()).add(int(words[2]))
        found[name] = (bound, pushed)
    return found


def faults_of_vulkan(kit: dict, folder: Path) -> list[str]:
    found = [f"{name} is not in the kit" for name in layouts() if not SOFTWARE.search(name) and name not in {one["name"] for one in kit["modules"]}]
    for module in kit["modules"]:
        if module["name"] not in layouts():
            found.append(f"{module['name']} is in no pipeline")
            continue
        bound, pushed = layouts()[module["name"]]
        for one in module["inputs"]:
            if one["kind"] == "push":
                if one["members"][-1]["offset"] + one["members"][-1]["size"] > pushed:
                    found.append(f"{module['name']}: vulkan/ pushes {pushed} bytes")
            elif not bound.get((one["set"], one["binding"]), set()) & DESCRIPTORS[one["kind"]]:
                found.append(f"{module['name']}: vulkan/ has no {one['kind']} at {one['set']}, {one['binding']}")
    return found


def faults_of_frame(kit: dict, folder: Path) -> list[str]:
    header = read(ROOT / "pack/include/gnomon/pack/frame_passes.h")
    kinds = re.findall(r"^    (\w+),", re.search(r"enum class FramePassKind.*?\{(.*?)\}", header, re.DOTALL)[1], re.MULTILINE)
    found = [] if [one["kind"] for one in kit["frame"]] == kinds else [f"the frame's kinds are {kinds}"]
    source = read(ROOT / "pack/src/frame_passes.cpp")
    listed = list(dict.fromkeys(re.findall(r"push_back\(\{FramePassKind::(\w+)", source)))
    found += [] if listed == kinds else ["listFramePasses() has another order"]
    run = {name for one in kit["frame"] for step in one["steps"] for key in ("vertex", "spirv_vertex", "fragment", "compute") for name in step.get(key, [])}
    return found + [f"no pass runs {one['name']}" for one in kit["modules"] if one["name"] not in run]


def signature_places() -> tuple[set[str], int]:
    """The registers that the root signature of docs/direct3d.md has, each "t3 0", and the bytes of its push data."""
    text = read(ROOT / "docs/direct3d.md").partition("```hlsl")[2].partition("```")[0]
    found = set()
    for letter, first, rest in re.findall(r"\b([btus])(\d+)([^()]*)\)", text.replace("RootConstants(", "")):
        space, count = re.search(r"space = (\d+)", rest), re.search(r"numDescriptors = (\d+)", rest)
        found |= {f"{letter}{int(first) + i} {space[1] if space else 0}" for i in range(int(count[1]) if count else 1)}
    return found, 4 * max(int(one) for one in re.findall(r"num32BitConstants = (\d+)", text))


def faults_of_signature(kit: dict, folder: Path) -> list[str]:
    has, pushed = signature_places()
    found = [f"{one['name']}: the root signature has no {lost}" for one in kit["modules"]
             for lost in sorted(said_places("hlsl", one["bindings"]["hlsl"]) - has)]
    return found + [f"{module['name']} has {one['size']} bytes of push data, the root signature {pushed}" for module in kit["modules"]
                    for one in module["inputs"] if one["kind"] == "push" and one["size"] > pushed]


def module(kit: dict, name: str) -> dict:
    return next(one for one in kit["modules"] if one["name"] == name)


class Kit(unittest.TestCase):
    kit = json.loads(read(KIT / "passes.json"))

    def hold(self, check: Callable[[dict, Path], list[str]], change: Callable[[dict], None], about: str) -> None:
        """The kit is as `check` says, and after the change it is not."""
        self.assertEqual(check(self.kit, KIT), [])
        other = copy.deepcopy(self.kit)
        change(other)
        self.assertTrue(any(about in one for one in check(other, KIT)), check(other, KIT))

    def test_files_are_as_said(self):
        def rename(kit):
            module(kit, "mip.comp")["files"]["msl"]["any"] = "msl/none.metal"
        self.hold(faults_of_files, rename, "msl/none.metal is not there")

    def test_a_wrong_binding_is_found_in_each_dialect(self):
        for dialect in [one for one in self.kit["dialects"] if one != "spirv"]:
            def move(kit, dialect=dialect):
                place = module(kit, "mask_pcf.frag")["bindings"][dialect][2]
                key = next(iter(place))
                place[key] = "t13" if dialect == "hlsl" else 13
            self.hold(faults_of_files, move, f"{dialect}/mask_pcf.frag")

    def test_a_missing_reason_is_found(self):
        def forget(kit):
            module(kit, "caster_layered.vert")["missing"] = {}
        self.hold(faults_of_files, forget, "neither a file nor a reason")

    def test_a_constant_without_meaning_is_found(self):
        def forget(kit):
            module(kit, "mask_pcf.frag")["constants"][0]["meaning"] = ""
        self.hold(faults_of_files, forget, "has no meaning")

    def test_inputs_are_those_of_the_librarys_modules(self):
        def move(kit):
            module(kit, "soften.frag")["inputs"][1]["binding"] = 9
        self.hold(faults_of_modules, move, "soften.frag")

    def test_a_lost_constant_is_found(self):
        def forget(kit):
            del module(kit, "mask_pcf.frag")["constants"][0]
        self.hold(faults_of_modules, forget, "mask_pcf.frag has the constants [0], too")

    def test_push_data_is_that_of_the_librarys_modules(self):
        def shorten(kit):
            del module(kit, "caster.vert")["inputs"][0]["members"][-1]
        self.hold(faults_of_modules, shorten, "bytes of push data")

    def test_vulkan_binds_the_same(self):
        def change(kit):
            module(kit, "blur.comp")["inputs"][0]["kind"] = "uniform"
        self.hold(faults_of_vulkan, change, "vulkan/ has no uniform")

    def test_every_module_that_vulkan_draws_with_is_here(self):
        def remove(kit):
            kit["modules"].remove(module(kit, "alternate.frag"))
        self.hold(faults_of_vulkan, remove, "alternate.frag is not in the kit")

    def test_the_root_signature_has_all_registers(self):
        def move(kit):
            module(kit, "mask_pcf.frag")["bindings"]["hlsl"][2]["register"] = "t13"
        self.hold(faults_of_signature, move, "the root signature has no t13 0")
        def lengthen(kit):
            module(kit, "volume.vert")["inputs"][-1]["size"] = 132
        self.hold(faults_of_signature, lengthen, "volume.vert has 132 bytes")

    def test_the_frame_is_that_of_pack(self):
        def swap(kit):
            kit["frame"].reverse()
        self.hold(faults_of_frame, swap, "the frame's kinds")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
