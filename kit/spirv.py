# SPDX-License-Identifier: Apache-2.0
"""A SPIR-V module as a list of instructions, and what the kit changes in it for dialects that lack something of Vulkan's.

Each change keeps the arithmetic and the names. Modules come from glslc without optimisation, so samplers are loaded where
they are used and never handed to functions.
"""

import struct
from dataclasses import dataclass

MAGIC = 0x07230203
# Opcodes, by their names in the specification.
NAME, MEMBER_NAME, ENTRY_POINT, EXECUTION_MODE, CAPABILITY = 5, 6, 15, 16, 17
TYPE_FLOAT, TYPE_VECTOR, TYPE_IMAGE, TYPE_SAMPLER, TYPE_SAMPLED_IMAGE, TYPE_STRUCT, TYPE_POINTER = 22, 23, 25, 26, 27, 30, 32
FUNCTION, VARIABLE, LOAD, DECORATE, MEMBER_DECORATE, SAMPLED_IMAGE, IMAGE = 54, 59, 61, 71, 72, 86, 100
TYPE_FUNCTION, COPY_OBJECT, CONSTANT_TRUE, CONSTANT_FALSE, SPEC_CONSTANT_TRUE, SPEC_CONSTANT_FALSE = 33, 83, 41, 42, 48, 49
SAMPLES = (*range(87, 95), 96, 97)  # reads through a sampler, gathers among them
# Decorations and storage classes.
SPEC_ID, BUILT_IN, FLAT, SAMPLE, LOCATION, BINDING, DESCRIPTOR_SET = 1, 11, 14, 17, 30, 33, 34
UNIFORM_CONSTANT, INPUT, UNIFORM, OUTPUT, PUSH_CONSTANT, STORAGE_BUFFER = 0, 1, 2, 3, 9, 12
CLIP_DISTANCE, SAMPLE_RATE, WRITE_WITHOUT_FORMAT, VIEWPORT_INDEX_LAYER = 32, 35, 56, 5254  # capabilities
LAYER = 9  # the built-in variable gl_Layer
FORMATS = {"unknown": 0, "rgba32f": 1, "rgba16f": 2, "r32f": 3, "rg32f": 6, "r32ui": 33}


@dataclass
class Instruction:
    op: int
    words: list[int]  # operands, a result's type and id among them


def text_of(words: list[int]) -> str:
    data = struct.pack(f"<{len(words)}I", *words)
    return data[:data.index(0)].decode("utf-8")


def words_of(text: str) -> list[int]:
    data = text.encode("utf-8") + b"\0"
    data += b"\0" * (-len(data) % 4)
    return list(struct.unpack(f"<{len(data) // 4}I", data))


class Module:
    def __init__(self, data: bytes):
        words = struct.unpack(f"<{len(data) // 4}I", data[:len(data) // 4 * 4])
        if len(data) % 4 or len(words) < 5 or words[0] != MAGIC:
            raise ValueError("not little-endian SPIR-V")
        self.head = list(words[:5])
        self.code: list[Instruction] = []
        at = 5
        while at < len(words):
            count = words[at] >> 16
            if not 0 < count <= len(words) - at:
                raise ValueError(f"an instruction of {count} words at word {at}")
            self.code.append(Instruction(words[at] & 0xFFFF, list(words[at + 1:at + count])))
            at += count

    def data(self) -> bytes:
        words = list(self.head)
        for one in self.code:
            words += [(len(one.words) + 1) << 16 | one.op, *one.words]
        return struct.pack(f"<{len(words)}I", *words)

    def new_id(self) -> int:
        self.head[3] += 1
        return self.head[3] - 1

    def all(self, op: int) -> list[Instruction]:
        return [one for one in self.code if one.op == op]

    def named(self, name: str) -> list[int]:
        return [one.words[0] for one in self.all(NAME) if text_of(one.words[1:]) == name]

    def name_of(self, target: int) -> str:
        return next((text_of(one.words[1:]) for one in self.all(NAME) if one.words[0] == target), "")

    def rename(self, target: int, name: str) -> None:
        self.code = [one for one in self.code if not (one.op == NAME and one.words[0] == target)]
        self.code.insert(self._first(DECORATE, MEMBER_DECORATE, MEMBER_NAME), Instruction(NAME, [target, *words_of(name)]))

    def decoration(self, target: int, decoration: int) -> int | None:
        return next((one.words[2] for one in self.all(DECORATE) if one.words[:2] == [target, decoration]), None)

    def is_decorated(self, target: int, decoration: int) -> bool:
        return any(one.words[:2] == [target, decoration] for one in self.all(DECORATE))

    def decorate(self, target: int, decoration: int, value: int) -> None:
        """Replaces the decoration's value, or adds it."""
        for one in self.all(DECORATE):
            if one.words[:2] == [target, decoration]:
                one.words[2] = value
                return
        self.insert_decoration([target, decoration, value])

    def insert_decoration(self, words: list[int]) -> None:
        self.code.insert(self._first(DECORATE, MEMBER_DECORATE), Instruction(DECORATE, words))

    def insert_before(self, instruction: Instruction, new: list[Instruction]) -> None:
        place = next(i for i, one in enumerate(self.code) if one is instruction)
        self.code[place:place] = new

    def forget(self, target: int) -> None:
        """Takes the id's name and decorations away."""
        self.code = [one for one in self.code if not (one.op in (NAME, DECORATE) and one.words[0] == target)]

    def variables(self, storage: int) -> list[Instruction]:
        return [one for one in self.all(VARIABLE) if one.words[2] == storage]

    def pointee(self, variable: Instruction) -> int:
        return next(one.words[2] for one in self.all(TYPE_POINTER) if one.words[0] == variable.words[0])

    def result(self, op: int, target: int) -> Instruction | None:
        """The type declaration of this opcode and id."""
        return next((one for one in self.all(op) if one.words[0] == target), None)

    def _first(self, *ops: int) -> int:
        return next(i for i, one in enumerate(self.code) if one.op in ops)

    # Changes that dialects need.

    def push_to_uniform(self, name: str, descriptor_set: int, binding: int) -> bool:
        """Makes the push constants a uniform buffer whose block has this name. False: there are none."""
        found = self.variables(PUSH_CONSTANT)
        for one in self.all(TYPE_POINTER):
            if one.words[1] == PUSH_CONSTANT:
                one.words[1] = UNIFORM
        for one in found:
            one.words[2] = UNIFORM
            self.decorate(one.words[1], DESCRIPTOR_SET, descriptor_set)
            self.decorate(one.words[1], BINDING, binding)
            self.rename(self.pointee(one), name)
            self.rename(one.words[1], "push")
        return bool(found)

    def split_samplers(self, sampler_binding) -> None:
        """Makes a texture and a sampler of each combined one. sampler_binding(b): the sampler's binding for a texture's. A
        texture that is only fetched from gets no sampler."""
        split, loads = {}, {}  # by variable: its image's type and its sampler; by the id of what was loaded: the variable's id
        sampler = None
        for variable in self.variables(UNIFORM_CONSTANT):
            combined = self.result(TYPE_SAMPLED_IMAGE, self.pointee(variable))
            if combined is None:
                continue
            if sampler is None:
                sampler = self._sampler_types(combined)
            split[variable.words[1]] = self._split(variable, combined, sampler[1], sampler_binding)
        code, used = [], set()
        for one in self.code:
            if one.op == LOAD and one.words[2] in split:
                image_type, _, combined_type = split[one.words[2]]
                image = self.new_id()
                loads[one.words[1]] = (one.words[2], image, combined_type)
                code.append(Instruction(LOAD, [image_type, image, one.words[2]]))
            elif one.op == IMAGE and one.words[2] in loads:
                code.append(Instruction(COPY_OBJECT, [one.words[0], one.words[1], loads[one.words[2]][1]]))
            elif one.op in SAMPLES and one.words[2] in loads:
                variable, image, combined_type = loads[one.words[2]]
                held, joined = self.new_id(), self.new_id()
                used.add(variable)
                code += [Instruction(LOAD, [sampler[0], held, split[variable][1]]),
                         Instruction(SAMPLED_IMAGE, [combined_type, joined, image, held]),
                         Instruction(one.op, [*one.words[:2], joined, *one.words[3:]])]
            elif one.op in (103, 104, 105, 106, 107) and one.words[2] in loads:  # queries, which take images
                code.append(Instruction(one.op, [*one.words[:2], loads[one.words[2]][1], *one.words[3:]]))
            else:
                code.append(one)
        self.code = code
        self.drop([own for variable, (_, own, _) in split.items() if variable not in used])

    def _sampler_types(self, before: Instruction) -> tuple[int, int]:
        own, pointer = self.new_id(), self.new_id()
        self.insert_before(before, [Instruction(TYPE_SAMPLER, [own]), Instruction(TYPE_POINTER, [pointer, UNIFORM_CONSTANT, own])])
        return own, pointer

    def _split(self, variable: Instruction, combined: Instruction, sampler_pointer: int, sampler_binding) -> tuple[int, int, int]:
        target, image_type = variable.words[1], combined.words[1]
        pointer, own = self.new_id(), self.new_id()
        self.insert_before(variable, [Instruction(TYPE_POINTER, [pointer, UNIFORM_CONSTANT, image_type]),
                                      Instruction(VARIABLE, [sampler_pointer, own, UNIFORM_CONSTANT])])
        variable.words[0] = pointer
        self.rename(own, self.name_of(target) + "_sampler")
        self.decorate(own, DESCRIPTOR_SET, self.decoration(target, DESCRIPTOR_SET))
        self.decorate(own, BINDING, sampler_binding(self.decoration(target, BINDING)))
        return image_type, own, combined.words[0]

    def drop(self, targets: list[int]) -> None:
        """Takes variables away that nobody reads."""
        gone = set(targets)
        self.code = [one for one in self.code if not (one.op in (NAME, DECORATE) and one.words[0] in gone)
                     and not (one.op == VARIABLE and one.words[1] in gone)]

    def set_image_format(self, name: str) -> bool:
        """Gives this format to storage images that have none. False: there is no such image."""
        images = [one for one in self.all(TYPE_IMAGE) if one.words[6] == 2 and one.words[7] == FORMATS["unknown"]]
        for one in images:
            one.words[7] = FORMATS[name]
        self.code = [one for one in self.code if one.op != CAPABILITY or one.words != [WRITE_WITHOUT_FORMAT]]
        return bool(images)

    def fix_constant(self, name: str, value: bool) -> int | None:
        """Makes the specialisation constant of this name a constant, and returns its id for hosts. None: there is none."""
        targets = self.named(name)
        for one in self.code:
            if one.op in (SPEC_CONSTANT_TRUE, SPEC_CONSTANT_FALSE) and one.words[1] in targets:
                one.op = CONSTANT_TRUE if value else CONSTANT_FALSE
                number = self.decoration(one.words[1], SPEC_ID)
                self.code = [other for other in self.code if not (other.op == DECORATE and other.words[:2] == [one.words[1], SPEC_ID])]
                return number
        return None

    def sampled(self) -> set[int]:
        """The textures that are read through a sampler. Of others texels are fetched."""
        loads = {one.words[1]: one.words[2] for one in self.all(LOAD)}
        return {loads[one.words[2]] for one in self.code if one.op in SAMPLES}

    def sample_outputs(self) -> None:
        """Makes outputs values at each sample, except those that are flat."""
        flat = {one.words[0] for one in self.all(DECORATE) if one.words[1] == FLAT}
        for variable in self.variables(OUTPUT):
            if self.decoration(variable.words[1], LOCATION) is not None and variable.words[1] not in flat:
                self.insert_decoration([variable.words[1], SAMPLE])
        self.code.insert(0, Instruction(CAPABILITY, [SAMPLE_RATE]))

    def hands_samplers_on(self) -> bool:
        """Is a function handed a texture?"""
        held = {one.words[0] for one in self.all(TYPE_POINTER) if one.words[1] == UNIFORM_CONSTANT}
        return any(held & set(one.words[2:]) for one in self.all(TYPE_FUNCTION))

    def writes_layer(self) -> bool:
        return any(one.words[1:] == [BUILT_IN, LAYER] for one in self.all(DECORATE))

    def add_inputs(self, wanted: list[dict]) -> None:
        """Declares inputs of floats, as passes.json lists what a stage hands on, where there is none at that location. They
        are read at each sample if others are."""
        known = {self.decoration(one.words[1], LOCATION) for one in self.variables(INPUT)}
        by_sample = any(one.words[1] == SAMPLE for one in self.all(DECORATE))
        scalar = next(one.words[0] for one in self.all(TYPE_FLOAT))
        for one in wanted:
            if one["location"] in known:
                continue
            size = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4}[one["type"]]
            vector = next((other.words[0] for other in self.all(TYPE_VECTOR) if other.words[1:] == [scalar, size]), scalar if size == 1 else 0)
            new = [] if vector else [Instruction(TYPE_VECTOR, [self.new_id(), scalar, size])]
            vector = vector or new[0].words[0]
            pointer, variable = self.new_id(), self.new_id()
            new += [Instruction(TYPE_POINTER, [pointer, INPUT, vector]), Instruction(VARIABLE, [pointer, variable, INPUT])]
            self.insert_before(self.all(FUNCTION)[0], new)
            self.rename(variable, one["name"] + "_unused")
            self.insert_decoration([variable, LOCATION, one["location"]])
            if one.get("flat"):
                self.insert_decoration([variable, FLAT])
            elif by_sample:
                self.insert_decoration([variable, SAMPLE])
            for entry in self.all(ENTRY_POINT):
                entry.words.append(variable)

    def layer_to_location(self, location: int) -> bool:
        """Makes gl_Layer an output of this location. False: it is not written."""
        layers = [one.words[0] for one in self.all(DECORATE) if one.words[1:] == [BUILT_IN, LAYER]]
        for one in self.all(DECORATE):
            if one.words[0] in layers and one.words[1] == BUILT_IN:
                one.words[1:] = [LOCATION, location]
                self.rename(one.words[0], "target_layer")
        self.code = [one for one in self.code if one.op != CAPABILITY or one.words != [VIEWPORT_INDEX_LAYER]]
        return bool(layers)
