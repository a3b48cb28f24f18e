# SPDX-License-Identifier: Apache-2.0
"""What passes.json says of a module: its inputs, layouts, constants and what it hands on, from its SPIR-V."""

import struct

import spirv
from spirv import Module

# Opcodes. All types lie between the first and the last of this line: 20 bool, 21 integer, 22 float, 23 vector, 24 matrix, 30 struct.
VOID, ARRAY, RUNTIME_ARRAY, TYPE_FUNCTION = 19, 28, 29, 33
CONSTANT, SPEC_CONSTANT = 43, 50
ARRAY_STRIDE, MATRIX_STRIDE, NON_WRITABLE, NON_READABLE, OFFSET = 6, 7, 24, 25, 35
LOCAL_SIZE = 17
FORMAT_NAMES = {number: name for name, number in spirv.FORMATS.items()}


class Types:
    def __init__(self, module: Module):
        self.module = module
        self.declared = {one.words[0]: one for one in module.code if VOID <= one.op <= TYPE_FUNCTION}
        self.values = {one.words[1]: one.words[2] for one in module.all(CONSTANT)}
        self.structs: dict[str, list[dict]] = {}

    def name(self, target: int) -> str:
        """As in GLSL. A struct's layout is noted in `structs`."""
        one = self.declared[target]
        words = one.words
        match one.op:
            case 20:
                return "bool"
            case 21:
                return "int" if words[2] else "uint"
            case 22:
                return "float"
            case 23:
                return {"float": "", "int": "i", "uint": "u", "bool": "b"}[self.name(words[1])] + f"vec{words[2]}"
            case 24:
                rows = self.declared[words[1]].words[2]
                return f"mat{words[2]}" if rows == words[2] else f"mat{words[2]}x{rows}"
            case 28:
                return f"{self.name(words[1])}[{self.values.get(words[2], '')}]"
            case 29:
                return f"{self.name(words[1])}[]"
            case 30:
                name = self.module.name_of(target)
                self.structs[name] = self.members(target)
                return name
        raise ValueError(f"no type of a block: opcode {one.op}")

    def size(self, target: int, matrix_stride: int = 16) -> int:
        """Bytes; 0: the length is open."""
        one = self.declared[target]
        match one.op:
            case 20 | 21 | 22:
                return 4
            case 23:
                return 4 * one.words[2]
            case 24:
                return matrix_stride * one.words[2]
            case 28:
                return self.module.decoration(target, ARRAY_STRIDE) * self.values[one.words[2]]
            case 29:
                return 0
        end = max(member["offset"] + member["size"] for member in self.members(target))
        return -(-end // self.alignment(target)) * self.alignment(target)

    def alignment(self, target: int) -> int:
        """As std430 has it."""
        one = self.declared[target]
        match one.op:
            case 20 | 21 | 22:
                return 4
            case 23:
                return (4, 8, 16, 16)[one.words[2] - 1]
            case 24 | 28 | 29:
                return self.alignment(one.words[1])
        return max(self.alignment(member) for member in one.words[1:])

    def members(self, target: int) -> list[dict]:
        found = []
        names = {one.words[1]: spirv.text_of(one.words[2:]) for one in self.module.all(spirv.MEMBER_NAME) if one.words[0] == target}
        decorations = {tuple(one.words[1:3]): one.words[3:] for one in self.module.all(spirv.MEMBER_DECORATE) if one.words[0] == target}
        end = 0
        for i, member in enumerate(self.declared[target].words[1:]):
            # WGSL as it is written here has no offsets, and ESSL has none.
            if decorations[i, OFFSET][0] != -(-end // self.alignment(member)) * self.alignment(member):
                raise RuntimeError(f"{self.module.name_of(target)}.{names[i]} does not lie where its type would by itself; fill the hole before it")
            stride = decorations.get((i, MATRIX_STRIDE), [16])[0]
            found.append({"name": names[i], "type": self.name(member), "offset": decorations[i, OFFSET][0], "size": self.size(member, stride)})
            if self.declared[member].op in (ARRAY, RUNTIME_ARRAY):
                found[-1]["stride"] = self.module.decoration(member, ARRAY_STRIDE)
            end = decorations[i, OFFSET][0] + found[-1]["size"]
        return found


def inputs_of(module: Module, types: Types) -> list[dict]:
    """By set and binding, push data last. `id` is the variable's, for who changes the module."""
    sampled = {module.name_of(one) for one in module.sampled()}
    found = []
    for storage in (spirv.UNIFORM, spirv.STORAGE_BUFFER, spirv.UNIFORM_CONSTANT):
        for variable in module.variables(storage):
            target = variable.words[1]
            one = {"set": module.decoration(target, spirv.DESCRIPTOR_SET), "binding": module.decoration(target, spirv.BINDING)}
            if storage == spirv.UNIFORM_CONSTANT:
                one |= _image(module, types, variable, sampled)
            else:
                one |= _block(module, types, variable, "uniform" if storage == spirv.UNIFORM else "storage")
            found.append(one | {"id": target})
    found.sort(key=lambda one: (one["set"], one["binding"]))
    for variable in module.variables(spirv.PUSH_CONSTANT):
        found.append(_block(module, types, variable, "push") | {"id": variable.words[1]})
    return found


def _block(module: Module, types: Types, variable, kind: str) -> dict:
    block = module.pointee(variable)
    one = {"kind": kind, "name": module.name_of(block), "size": types.size(block), "members": types.members(block)}
    if kind == "storage":
        held = [one.words[2] for one in module.all(spirv.MEMBER_DECORATE) if one.words[0] == block]
        count = len(types.declared[block].words) - 1
        one["access"] = ("read" if held.count(NON_WRITABLE) == count else "write" if held.count(NON_READABLE) == count else "read_write")
    return one


def _image(module: Module, types: Types, variable, sampled: set[str]) -> dict:
    name = module.name_of(variable.words[1])
    pointee = module.pointee(variable)
    combined = module.result(spirv.TYPE_SAMPLED_IMAGE, pointee)
    _, of, dimension, _, arrayed, multisampled, use, form = types.declared[combined.words[1] if combined else pointee].words[:8]
    assert dimension == 1, name # all of Gnomon's images are flat
    one = {"name": name, "kind": "storage_image" if use == 2 else "texture",
           "dimension": "2d" + ("_array" if arrayed else "") + ("_multisampled" if multisampled else ""), "of": types.name(of)}
    if use == 2:
        flags = [word.words[1] for word in module.all(spirv.DECORATE) if word.words[0] == variable.words[1]]
        one |= {"format": FORMAT_NAMES[form] if form else "any",
                "access": "read" if NON_WRITABLE in flags else "write" if NON_READABLE in flags else "read_write"}
    else:
        one["sampled"] = name in sampled
    return one


def constants_of(module: Module, types: Types) -> list[dict]:
    ids = {one.words[0]: one.words[2] for one in module.all(spirv.DECORATE) if one.words[1] == spirv.SPEC_ID}
    found = []
    for one in module.code:
        if one.op in (spirv.SPEC_CONSTANT_TRUE, spirv.SPEC_CONSTANT_FALSE, SPEC_CONSTANT):
            kind = types.name(one.words[0])
            value = one.op == spirv.SPEC_CONSTANT_TRUE
            if one.op == SPEC_CONSTANT:
                value = struct.unpack({"int": "<i", "uint": "<I", "float": "<f"}[kind], struct.pack("<I", one.words[2]))[0]
            found.append({"id": ids[one.words[1]], "name": module.name_of(one.words[1]), "type": kind, "default": value})
    return sorted(found, key=lambda one: one["id"])


def handed_on(module: Module, types: Types, storage: int) -> list[dict]:
    """Inputs or outputs of a stage that have a location."""
    found = []
    for variable in module.variables(storage):
        target = variable.words[1]
        location = module.decoration(target, spirv.LOCATION)
        if location is not None:
            flags = [one.words[1] for one in module.all(spirv.DECORATE) if one.words[0] == target]
            found.append({"location": location, "name": module.name_of(target), "type": types.name(module.pointee(variable)),
                          **({"flat": True} if spirv.FLAT in flags else {}), **({"per_sample": True} if spirv.SAMPLE in flags else {})})
    return sorted(found, key=lambda one: one["location"])


def workgroup_of(module: Module) -> list[int] | None:
    return next((one.words[2:5] for one in module.all(spirv.EXECUTION_MODE) if one.words[1] == LOCAL_SIZE), None)
