#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Keeps the names of the library's shaders out of the way of a host's that includes shaders/include/gnomon.

usage: public_names.py [--check | --host]

Writes shaders/include/gnomon/names_begin.glsl and names_end.glsl, between which every global name of the included files
is called gnomon_NAME. --check: exit status 1 if they are not what would be written. --host: prints a fragment shader
that has a function of each such name and includes the header; it must compile.
"""

import re
import sys
from pathlib import Path

from sources import project_root

FOLDER = "shaders/include/gnomon"
HEADERS = ["visibility.glsl", "smooth_surface.glsl", "caster.glsl"]
TYPE = r"(?:void|bool|u?int|float|real[234]?|[biu]?vec[234]|[A-Z]\w+)"
DECLARATIONS = [
    re.compile(rf"^(?:GN_FN )?{TYPE} (\w+)\([^;]*$", re.M),
    re.compile(rf"^(?:GN_CONST|const) {TYPE} (\w+) =", re.M),
    re.compile(r"^struct (\w+)", re.M),
]
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
OWN = re.compile(r"^(gnomon|GNOMON|GN_)")
LICENCE = "// SPDX-License-Identifier: Apache-2.0\n"
SAID = "// Written by tools/public_names.py: names of the library's shaders, which a host may have too.\n"


def included_files(file: Path, seen: dict) -> dict:
    if file in seen or file.name.startswith("names_"):
        return seen
    seen[file] = file.read_text(encoding="utf-8")
    for name in INCLUDE.findall(seen[file]):
        included_files((file.parent / name).resolve(), seen)
    return seen


def global_names(root: Path) -> list[str]:
    files = {}
    for header in HEADERS:
        included_files((root / FOLDER / header).resolve(), files)
    found = {name for text in files.values() for pattern in DECLARATIONS for name in pattern.findall(text)}
    return sorted(name for name in found if not OWN.match(name))


def written(names: list[str]) -> dict[str, str]:
    reals = ["real", "real2", "real3", "real4"]
    begin = LICENCE + SAID + "".join(f"#define {name} gnomon_{name}\n" for name in names)
    begin += "".join(f"#define {real} {glsl}\n" for real, glsl in zip(reals, ["float", "vec2", "vec3", "vec4"]))
    end = LICENCE + SAID + "".join(f"#undef {name}\n" for name in [*names, *reals])
    return {"names_begin.glsl": begin, "names_end.glsl": end}


def host_shader(names: list[str]) -> str:
    functions = "".join(f"float {name}() {{ return 1.0; }}\n" for name in [*names, "real", "real2", "real3", "real4"])
    return ("#version 460\n#extension GL_GOOGLE_include_directive : require\n"
            "#define GNOMON_TINTS true\n"
            '#include "gnomon/caster.glsl"\n#include "gnomon/smooth_surface.glsl"\n#include "gnomon/visibility.glsl"\n' +
            functions +
            "layout(location = 0) in vec3 point;\nlayout(location = 1) in vec3 normal;\n"
            "layout(location = 0) out float seen;\n"
            "void main() { seen = gnomonLightVisibility(3u, point, normal, gl_FragCoord.xy) +\n"
            "    gnomonLightVisibility(2u, point, normal, gnomonSmoothSurface(point, normal, vec4(normal,\n"
            "        gnomonSmoothPlane(normal, point, false))), gl_FragCoord.xy) +\n"
            "    gnomonLightColour(1u, point, normal, gl_FragCoord.xy).r +\n"
            "    gnomonLightColour(1u, point, normal, vec4(normal, -1.0), vec3(0.5), gl_FragCoord.xy).r +\n"
            "    gnomonSmoothEncode(vec4(normal, 1.0), point).x +\n"
            "    gnomonCasterDepth(gnomonCasterMetric(point, vec4(normal, 1.0))); }\n")


def main() -> int:
    root = project_root()
    names = global_names(root)
    if "--host" in sys.argv[1:]:
        print(host_shader(names), end="")
        return 0
    stale = []
    for name, text in written(names).items():
        file = root / FOLDER / name
        if "--check" in sys.argv[1:]:
            if not file.is_file() or file.read_text(encoding="utf-8") != text:
                stale.append(name)
        else:
            file.write_text(text, encoding="utf-8")
    for name in stale:
        print(f"{name} is out of date: run tools/public_names.py", file=sys.stderr)
    return 1 if stale or not names else 0


if __name__ == "__main__":
    sys.exit(main())
