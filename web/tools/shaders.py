# SPDX-License-Identifier: Apache-2.0
"""The kit's WGSL as one compressed file: the modules that pack::FrameRecorder's commands and casters name, with what passes.json says of
their inputs and constants."""

import fnmatch
import gzip
import json
from pathlib import Path

# The recorder's modules (pack/src/commands) and those of caster meshes. Other modules are of techniques that it refuses.
WANTED = ("mask.vert", "mask_[!is]*.frag", "blur.comp", "blur_moments*.comp", "blur_blocks.comp", "moments*.comp", "mip.comp", "depth_blocks*.comp",
          "depth_layers_*.comp", "restore_*.frag", "soften*.frag", "caster.vert", "caster_masked.frag", "caster_depth*.frag",
          "caster_colour.frag", "caster_colour_masked.frag")
INPUT = ("kind", "binding", "dimension", "of", "sampled", "access", "size")


def bundle(kit: Path, out: Path) -> int:
    """Writes the file, whose bytes depend on the kit alone. Returns how many modules it has."""
    modules = []
    for module in json.loads((kit / "passes.json").read_text(encoding="utf-8"))["modules"]:
        if not any(fnmatch.fnmatchcase(module["name"], pattern) for pattern in WANTED):
            continue
        modules.append({"name": module["name"], "inputs": [{key: one[key] for key in INPUT if key in one} for one in module["inputs"]],
                        "constants": {str(one["id"]): one["type"] for one in module["constants"]},
                        "files": {form: (kit / file).read_text(encoding="utf-8") for form, file in module["files"]["wgsl"].items()}})
    text = json.dumps(modules, separators=(",", ":"))
    out.write_bytes(gzip.compress(text.encode(), 9, mtime=0))
    return len(modules)
