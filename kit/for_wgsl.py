# SPDX-License-Identifier: Apache-2.0
"""What a module loses for WGSL alone, whose translator (naga) and whose language lack it: arrays between stages, operations on
specialisation constants outside of functions, storage buffers whose members alone are said to be read-only."""

from collections.abc import Callable

import spirv
from spirv import Instruction, Module

TYPE_INT, TYPE_ARRAY, CONSTANT, SPEC_CONSTANT, SPEC_CONSTANT_COMPOSITE, SPEC_CONSTANT_OP = 21, 28, 43, 50, 51, 52
ADD, SUBTRACT, MULTIPLY, COMPOSITE_CONSTRUCT = 128, 130, 132, 80
ACCESS_CHAIN, STORE, LABEL, RETURN, FUNCTION_END = 65, 62, 248, 253, 56
NON_WRITABLE, PRIVATE = 24, 6
# Which operands of an instruction are no ids, though they are behind its type and result: from where on, or at which places.
# Every other operand in a function is an id or, for these modules, a number that no operation on constants has as its id.
LITERALS = {12: lambda words: (3,), 61: lambda words: range(3, len(words)), 62: lambda words: range(2, len(words)),
            79: lambda words: range(4, len(words)), 81: lambda words: range(3, len(words)), 82: lambda words: range(4, len(words)),
            246: lambda words: range(2, len(words)), 247: lambda words: range(1, len(words)),
            250: lambda words: range(3, len(words)), 251: lambda words: range(1, len(words)),
            54: lambda words: range(0, len(words)), 59: lambda words: range(0, len(words)),
            **{op: lambda words: (4,) for op in (87, 88, 91, 92, 95, 98)}, **{op: lambda words: (5,) for op in (89, 90, 93, 94, 96, 97)},
            99: lambda words: (3,)}


def prepare(module: Module, largest: dict[str, int]) -> None:
    plain_names(module)
    size_arrays(module, largest)
    split_arrays(module)
    mark_read_only(module)
    operations_into_functions(module)


def mark_read_only(module: Module) -> None:
    for variable in module.variables(spirv.STORAGE_BUFFER):
        block = module.pointee(variable)
        members = module.result(spirv.TYPE_STRUCT, block).words[1:]
        held = {one.words[1] for one in module.all(spirv.MEMBER_DECORATE) if one.words[0] == block and one.words[2] == NON_WRITABLE}
        if len(held) == len(members):
            module.insert_decoration([variable.words[1], NON_WRITABLE])


def operations_into_functions(module: Module) -> None:
    """Works each operation on specialisation constants out at the beginning of every function that uses it."""
    operations = {one.words[1]: one for one in module.all(SPEC_CONSTANT_OP) + module.all(SPEC_CONSTANT_COMPOSITE)}
    code: list[Instruction] = []
    body: list[Instruction] | None = None
    for one in module.code:
        if one.op == spirv.FUNCTION:
            body = []
        if body is None:
            if one.op not in (SPEC_CONSTANT_OP, SPEC_CONSTANT_COMPOSITE) and not (one.op == spirv.NAME and one.words[0] in operations):
                code.append(one)
            continue
        body.append(one)
        if one.op == FUNCTION_END:
            code += _with_operations(module, body, operations)
            body = None
    module.code = code


def _with_operations(module: Module, body: list[Instruction], operations: dict[int, Instruction]) -> list[Instruction]:
    own: dict[int, int] = {}
    worked_out: list[Instruction] = []

    def local(constant: int) -> int:
        if constant in operations and constant not in own:
            operation = operations[constant].words
            composite = operations[constant].op == SPEC_CONSTANT_COMPOSITE
            kind, _, op, *operands = [*operation[:2], COMPOSITE_CONSTRUCT, *operation[2:]] if composite else operation
            ids = len(operands) if op not in LITERALS else 0
            operands = [local(word) if i < ids else word for i, word in enumerate(operands)]
            own[constant] = module.new_id()
            worked_out.append(Instruction(op, [kind, own[constant], *operands]))
        return own.get(constant, constant)

    for one in body:
        literal = set(LITERALS[one.op](one.words)) if one.op in LITERALS else set()
        one.words = [word if i in literal else local(word) for i, word in enumerate(one.words)]
    start = next(i for i, one in enumerate(body) if one.op == LABEL) + 1
    while body[start].op == spirv.VARIABLE:
        start += 1
    return body[:start] + worked_out + body[start:]


def size_arrays(module: Module, largest: dict[str, int]) -> None:
    """Makes arrays as long as they are with the largest value of the specialisation constants that size them."""
    known = {one.words[1]: one for one in module.code if one.op in (CONSTANT, SPEC_CONSTANT, SPEC_CONSTANT_OP)}

    def value(constant: int) -> int:
        one = known[constant]
        if one.op == CONSTANT:
            return one.words[2]
        if one.op == SPEC_CONSTANT:
            return largest[module.name_of(constant)]
        a, b = (value(operand) for operand in one.words[3:5])
        return {ADD: a + b, SUBTRACT: a - b, MULTIPLY: a * b}[one.words[2]]

    for array in module.all(TYPE_ARRAY):
        if known[array.words[2]].op != CONSTANT:
            length = module.new_id()
            module.insert_before(array, [Instruction(CONSTANT, [known[array.words[2]].words[0], length, value(array.words[2])])])
            array.words[2] = length


def split_arrays(module: Module) -> None:
    """Makes a variable of each element of arrays that stages hand on; the array itself is the module's own."""
    for storage in (spirv.INPUT, spirv.OUTPUT):
        for variable in module.variables(storage):
            array = module.result(TYPE_ARRAY, module.pointee(variable))
            if array is not None and module.decoration(variable.words[1], spirv.LOCATION) is not None:
                _split_array(module, variable, array, storage)


def _split_array(module: Module, variable: Instruction, array: Instruction, storage: int) -> None:
    target, element = variable.words[1], array.words[1]
    count = next(one.words[2] for one in module.all(CONSTANT) if one.words[1] == array.words[2])
    location = module.decoration(target, spirv.LOCATION)
    kept = [one.words[1:] for one in module.all(spirv.DECORATE) if one.words[0] == target and one.words[1] != spirv.LOCATION]
    name = module.name_of(target)
    index_type = module.all(TYPE_INT)[0].words[0]
    own_pointer, outer_pointer, array_pointer = module.new_id(), module.new_id(), module.new_id()
    new = [Instruction(spirv.TYPE_POINTER, [own_pointer, PRIVATE, element]),
           Instruction(spirv.TYPE_POINTER, [outer_pointer, storage, element]),
           Instruction(spirv.TYPE_POINTER, [array_pointer, PRIVATE, array.words[0]])]
    elements = []
    for i in range(count):
        index, one = module.new_id(), module.new_id()
        new += [Instruction(CONSTANT, [index_type, index, i]), Instruction(spirv.VARIABLE, [outer_pointer, one, storage])]
        elements.append((index, one))
    module.insert_before(variable, new)
    module.forget(target)
    module.rename(target, name)
    for i, (_, one) in enumerate(elements):
        module.rename(one, f"{name}_{i}")
        module.insert_decoration([one, spirv.LOCATION, location + i])
        for decoration in kept:
            module.insert_decoration([one, *decoration])
    variable.words[0], variable.words[2] = array_pointer, PRIVATE
    _chains_to_private(module, target)
    for entry in module.all(spirv.ENTRY_POINT):
        entry.words = [word for word in entry.words if word != target] + [one for _, one in elements]

    def copy(index: int, one: int) -> list[Instruction]:
        place, value = module.new_id(), module.new_id()
        chain = Instruction(ACCESS_CHAIN, [own_pointer, place, target, index])
        if storage == spirv.INPUT:
            return [chain, Instruction(spirv.LOAD, [element, value, one]), Instruction(STORE, [place, value])]
        return [chain, Instruction(spirv.LOAD, [element, value, place]), Instruction(STORE, [one, value])]

    _in_main(module, storage == spirv.INPUT, lambda: [step for pair in elements for step in copy(*pair)])


def _chains_to_private(module: Module, target: int) -> None:
    """Pointers into the array point into memory of the module's own."""
    pointees = {one.words[0]: one.words[2] for one in module.all(spirv.TYPE_POINTER)}
    private: dict[int, int] = {}
    for one in module.all(ACCESS_CHAIN):
        if one.words[2] == target:
            pointee = pointees[one.words[0]]
            if pointee not in private:
                private[pointee] = module.new_id()
                module.insert_before(module.all(spirv.FUNCTION)[0],
                                     [Instruction(spirv.TYPE_POINTER, [private[pointee], PRIVATE, pointee])])
            one.words[0] = private[pointee]


def _in_main(module: Module, at_start: bool, steps: Callable[[], list[Instruction]]) -> None:
    main = module.all(spirv.ENTRY_POINT)[0].words[1]
    start = next(i for i, one in enumerate(module.code) if one.op == spirv.FUNCTION and one.words[1] == main)
    end = next(i for i in range(start, len(module.code)) if module.code[i].op == FUNCTION_END)
    body = module.code[start:end]
    if at_start:
        first = next(i for i, one in enumerate(body) if one.op == LABEL) + 1
        while body[first].op == spirv.VARIABLE:
            first += 1
        body[first:first] = steps()
    else:
        body = [step for one in body for step in ([*steps(), one] if one.op == RETURN else [one])]
    module.code[start:end] = body


def plain_names(module: Module) -> None:
    """Functions are called as in the source, without the types of their parameters."""
    for one in module.all(spirv.FUNCTION):
        name = module.name_of(one.words[1])
        if "(" in name:
            module.rename(one.words[1], name.split("(")[0])
