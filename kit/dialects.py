# SPDX-License-Identifier: Apache-2.0
"""A pass in each dialect, and where its inputs lie there.

`bindings` says how a dialect numbers what Vulkan has as (set, binding); docs/kit.md tells users. Push data is a uniform block
of its own everywhere but in SPIR-V.
"""

import re
import subprocess
from pathlib import Path

import for_wgsl
import spirv
from spirv import Module

TEXT = ("glsl", "essl", "hlsl", "msl", "wgsl")
DIALECTS = ("spirv", *TEXT)
ENDINGS = {"spirv": "spv", "glsl": "glsl", "essl": "essl", "hlsl": "hlsl", "msl": "metal", "wgsl": "wgsl"}
MACRO = "the macro SPIRV_CROSS_CONSTANT_ID_<id>, defined before the text"
# By dialect: the entry point, how a specialisation constant is set, and where push data lies.
HOW = {"spirv": {"entry_point": "main", "constants": "SpecId <id>", "push_data": "push constants"},
       "glsl": {"entry_point": "main", "constants": MACRO, "push_data": "uniform block, binding 9 of a vertex shader, 10 of others"},
       "essl": {"entry_point": "main", "constants": MACRO, "push_data": "uniform block, binding 9 of a vertex shader, 10 of others"},
       "hlsl": {"entry_point": "main", "constants": MACRO, "push_data": "cbuffer, register b0, space 3"},
       "msl": {"entry_point": "main0", "constants": f"function_constant(<id>); where it sizes an array {MACRO}", "push_data": "buffer 15"},
       "wgsl": {"entry_point": "main", "constants": "override @id(<id>)", "push_data": "uniform buffer, group 3, binding 0"}}
# Formats of the maps that compute passes write, where a dialect has to be told: those that every device of it can store to.
FORMATS = {"essl": ("r32f", "rgba16f", "rgba32f"), "wgsl": ("r32f", "rg32f", "rgba16f", "rgba32f")}
# Dialects whose drivers refuse an input of a fragment shader that is read at each sample, where the vertex shader's output does
# not say so too, or lies in another register: these have the vertex shaders of casters twice.
SAYS_SAMPLE = ("glsl", "essl", "hlsl", "wgsl")
STAGES = {".vert": "vertex", ".frag": "fragment", ".comp": "compute"}
LAYER_LOCATION = 30   # of gl_Layer while a module goes through a translator that knows no such output of a vertex shader
LARGEST = {"kRadius": 31} # kMostBlurRadius of filter_pass.h; WGSL has no arrays in functions that a constant sizes
LAYERED = "no vertex shader chooses a layer there; draw the views in turn with `{}`"
# Modules with this define are for software rasterisers alone (mask_numbers.glsl). The kit leaves them out.
FOR_SOFTWARE = "GNOMON_ONE_VIEW"
# Whether a software rasteriser runs it. The texts are for GPUs.
FIXED = {"kInSoftware": False}
CLEAN = ("--fold-spec-const-op-composite", "--simplify-instructions", "--eliminate-dead-branches", "--eliminate-dead-functions",
         "--eliminate-dead-code-aggressive", "--eliminate-dead-variables", "--eliminate-dead-const", "--remove-unused-interface-variables")


def run(*command: str) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {(done.stderr or done.stdout).strip()}")
    return done.stdout


def readable(source: Path, defines: list[str], includes: Path, out: Path) -> tuple[Module, dict[str, int]]:
    """The module without optimisation, so that names and functions stay, and made for GPUs; it is written to `out`. And the ids
    of the constants of FIXED that it had."""
    run("glslc", "--target-env=vulkan1.1", "-O0", "-Werror", *(f"-D{one}" for one in defines), f"-I{includes}", "-o", str(out), str(source))
    module = Module(out.read_bytes())
    fixed = {name: module.fix_constant(name, value) for name, value in FIXED.items()}
    out.write_bytes(module.data())
    # A texture that a function is handed could not be parted from its sampler.
    whole = ("--merge-return", "--inline-entry-points-exhaustive") if module.hands_samplers_on() else ()
    run("spirv-opt", "--target-env=vulkan1.1", *whole, *CLEAN, str(out), "-o", str(out))
    return Module(out.read_bytes()), {name: number for name, number in fixed.items() if number is not None}


def sampler_binding(binding: int) -> int:
    """WGSL: of a texture's sampler, in the texture's group."""
    return binding + 16


def flat(descriptor_set: int, binding: int) -> int:
    """GLSL, ESSL and MSL, which have one row of numbers. Sets 1 and 2 have one binding each."""
    assert descriptor_set == 0 or binding == 0, (descriptor_set, binding)
    return binding if descriptor_set == 0 else 12 + descriptor_set


PUSH = {"glsl": {"vertex": 9, "fragment": 10, "compute": 10}, "essl": {"vertex": 9, "fragment": 10, "compute": 10},
        "msl": 15, "hlsl": (3, 0), "wgsl": (3, 0)}


def bindings(dialect: str, stage: str, inputs: list[dict]) -> list[dict]:
    """For each of the inputs of passes.json, in its order, where it is bound in this dialect."""
    places = []
    storage = 0
    for one in inputs:
        if dialect == "wgsl":
            place = {"group": one.get("set", 3), "binding": one.get("binding", 0)}
            if one.get("sampled"):
                place["sampler_binding"] = sampler_binding(one["binding"])
        elif dialect == "hlsl":
            letter = {"uniform": "b", "push": "b", "texture": "t", "storage_image": "u"}.get(one["kind"])
            letter = letter or ("t" if one["access"] == "read" else "u")
            place = {"register": f"{letter}{one.get('binding', 0)}", "space": one.get("set", 3)}
            if one.get("sampled"):
                place["sampler"] = f"s{one['binding']}"
        elif dialect == "msl":
            number = PUSH["msl"] if one["kind"] == "push" else flat(one["set"], one["binding"])
            place = {"texture" if one["kind"] in ("texture", "storage_image") else "buffer": number}
            if one.get("sampled"):
                place["sampler"] = number
        elif one["kind"] == "storage":
            place, storage = {"buffer_binding": storage}, storage + 1
        elif one["kind"] == "push":
            place = {"uniform_binding": PUSH[dialect][stage]}
        else:
            kinds = {"uniform": "uniform_binding", "texture": "texture_unit", "storage_image": "image_unit"}
            place = {kinds[one["kind"]]: flat(one["set"], one["binding"])}
        places.append(place)
    return places


def renumber(module: Module, dialect: str, stage: str, inputs: list[dict]) -> None:
    for one, place in zip(inputs, bindings(dialect, stage, inputs), strict=True):
        if one["kind"] != "push":
            number = place.get("buffer", place.get("texture")) if dialect == "msl" else next(iter(place.values()))
            module.decorate(one["id"], spirv.BINDING, number)


def missing(name: str, module: Module) -> dict[str, str]:
    """The dialects that cannot have a module, and why."""
    if not module.writes_layer():
        return {}
    return {one: LAYERED.format(name.replace("_layered", "").replace("_placed", "")) for one in ("essl", "wgsl")}


def forms(name: str, dialect: str, inputs: list[dict]) -> tuple[str | None, ...]:
    """The files of a module differ by these: formats of what it stores to, or outputs at each sample. None: there is one file."""
    if dialect in FORMATS and any(one.get("format") == "any" for one in inputs):
        return FORMATS[dialect]
    return (None, "sample") if dialect in SAYS_SAMPLE and name.startswith("caster") and name.endswith(".vert") else (None,)


def write(name: str, module: Module, dialect: str, inputs: list[dict], given: list[dict], folder: Path, form: str | None) -> str:
    """The text of a module, which this changes. `given`: what the vertex shaders hand on that it is drawn with, by that form."""
    stage = STAGES[Path(name).suffix]
    layered = module.layer_to_location(LAYER_LOCATION) if dialect == "hlsl" else False
    if form == "sample":
        module.sample_outputs()
    elif form:
        module.set_image_format(form)
    push = PUSH[dialect]
    if isinstance(push, tuple):
        module.push_to_uniform("Push", *push)
    else:
        # Two stages of a program have blocks of their own, which must have other names.
        module.push_to_uniform(f"Push_{stage}", 0, push[stage] if isinstance(push, dict) else push)
        renumber(module, dialect, stage, inputs)
    if dialect not in ("glsl", "essl"):
        module.split_samplers(sampler_binding if dialect == "wgsl" else lambda binding: binding)
    if dialect == "hlsl" and stage == "fragment":
        module.add_inputs(given) # Direct3D counts registers, so both stages need all of them
    if dialect == "wgsl":
        for_wgsl.prepare(module, LARGEST)
    path = folder / f"{name}.{dialect}{form or ''}.spv"
    path.write_bytes(module.data())
    if dialect == "wgsl":
        return str(path) # to_wgsl.mjs translates all of them in one process
    flip = ("--flip-vert-y",) if stage == "vertex" and dialect in ("hlsl", "msl") else () # naga does so by itself
    text = run("spirv-cross", str(path), *OPTIONS[dialect], *extensions(module, dialect), *flip)
    if layered:
        text = re.sub(rf"(sample )?int (\w+) : TEXCOORD{LAYER_LOCATION};", r"uint \2 : SV_RenderTargetArrayIndex;", text)
    return text


def extensions(module: Module, dialect: str) -> tuple[str, ...]:
    """Those that the translator forgets to ask for."""
    wanted = {"glsl": {spirv.VIEWPORT_INDEX_LAYER: "GL_ARB_shader_viewport_layer_array"},
              "essl": {spirv.CLIP_DISTANCE: "GL_EXT_clip_cull_distance", spirv.SAMPLE_RATE: "GL_OES_shader_multisample_interpolation"}}
    found = {one.words[0] for one in module.all(spirv.CAPABILITY)} & wanted.get(dialect, {}).keys()
    return tuple(word for one in sorted(found) for word in ("--extension", wanted[dialect][one]))


OPTIONS = {"glsl": ("--no-es", "--version", "450", "--combined-samplers-inherit-bindings"),
           "essl": ("--es", "--version", "310", "--combined-samplers-inherit-bindings", "--fixup-clipspace"),
           "hlsl": ("--hlsl", "--shader-model", "60", "--hlsl-support-nonzero-basevertex-baseinstance",
                    "--hlsl-basevertex-baseinstance-binding", "1", "3"),
           "msl": ("--msl", "--msl-version", "20200", "--msl-decoration-binding")}
