#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Who may include whom: the table of docs/architecture.md, checked.

usage: check_includes.py [ROOT]

Each folder has a list of the kinds of header it may include besides its own; all else is refused. Direct includes are
enough to look at, because whatever is included is held to its own rule in turn. Exit status 1 when a rule is broken.
"""

import re
import sys
from pathlib import Path

from sources import project_files, project_root

# The group of a header of the project, by its folder; the first match counts.
PROJECT_KINDS = [
    (r"^shaders/include/gnomon/shared/", "shared"),
    (r"^shaders/", "shader-lib"),
    (r"^core/include/gnomon/(error|geometry|world_range)\.h$", "core-geometry"),
    (r"^c/include/", "c-public"),
    (r"^core/include/", "core-public"),
    (r"^pack/include/", "pack-public"),
    (r"^vulkan/include/", "vulkan-public"),
    (r"^gl/include/", "gl-public"),
    (r"^vulkan/classics/include/", "classics"),
    (r"^vulkan/src/", "backend"),
    (r"^(c|core|pack|vulkan|gl)/", "private"),
    (r"^(files|scene|worlds|image|host|truth|lab)/src/", "private"),
    (r"^lab/metrics", "metrics"),
    (r"^lab/score/(?!src/)", "score"),
    (r"^lab/score/", "private"),
    (r"^host/shaders/.*\.h$", "host-shared"),
    (r"^(files|scene|worlds|image|host|truth|lab|app)/", r"\1"),
]
# The group of any other header, by its name.
FOREIGN_KINDS = [
    (r"^\w+_(spirv|glsl_texts)\.h$|\.(vert|frag|comp)\.inc$", "spirv"),
    (r"^vulkan/", "vulkan-api"),
    (r"^glm/", "glm"),
    (r"^imgui\w*\.h$", "imgui"),
    (r"^(GLFW/|SDL|X11/|xcb/|wayland)", "window"),
    (r"^osg\w*/", "osg"),
    (r"^(GL/|GLES|EGL/|d3d|Metal/|volk\.h)", "graphics"),
    (r"^png(conf)?\.h$", "png"),
    (r"^(jpeglib|jerror)\.h$", "jpeg"),
    (r"^(OpenEXR/|Imath/|Imf|Imath|Iex|half\.h)", "exr"),
    (r"^webp/", "webp"),
    (r"^draco/", "draco"),
    (r"^meshoptimizer\.h$", "meshopt"),
    (r"^nlohmann/", "json"),
    (r"^CLI/", "cli"),
    (r"^fmt/", "fmt"),
    (r"^embree\d/", "embree"),
    (r"^xxhash\.h$", "xxhash"),
    (r"^gd(font\w+)?\.h$", "gd"),
    (r"^page_texts\.h$", "text"),  # the texts of the files in app/pages, made by app/CMakeLists.txt
    (r"^(fstream|filesystem|iostream|cstdio|stdio\.h|dirent\.h|fcntl\.h|unistd\.h|sys/\w+\.h)$", "std-file"),
    (r"^(dlfcn|signal|pthread|errno|spawn|poll)\.h$", "system"),
    (r"^([a-z0-9_]+|(stdint|stddef|math|string|stdlib|assert|float|limits)\.h)$", "std"),
]

STD = {"std", "std-file", "system"}
PUBLIC = {"core-geometry", "core-public", "pack-public", "vulkan-public"}
ABOVE = STD | PUBLIC | {"classics", "glm", "vulkan-api", "files", "scene", "image", "host", "truth", "lab", "metrics", "score", "json", "fmt"}

# (folder, what it may include besides its own files, why). The longest folder that a file's path starts with rules.
# Tests may include everything, private headers too.
RULES = [
    ("shaders/include/gnomon/shared/", {"glm", "std"}, "shared headers stand alone, in GLSL and in C++"),
    ("shaders/", {"shared"}, "shaders include shaders"),
    ("core/include/", {"std", "glm", "shared"}, "a public header shows nothing private; core knows no graphics, window or file"),
    ("core/", {"std", "glm", "core-geometry", "core-public", "shared"}, "core knows no graphics, window or file"),
    ("pack/", {"std", "glm", "core-geometry", "core-public", "shared"}, "pack knows no graphics, window or file"),
    ("c/include/", {"std"}, "a header for C knows no C++"),
    ("c/", {"std", "glm", "core-geometry", "core-public", "pack-public", "c-public", "shared"},
     "the interface for C is made of public headers alone"),
    ("vulkan/include/", {"std", "glm", "core-geometry", "core-public", "pack-public", "vulkan-api"}, "a public header shows nothing private"),
    ("vulkan/", STD | PUBLIC | {"glm", "vulkan-api", "shared", "shader-lib", "spirv"}, "the backend knows core and shaders"),
    ("vulkan/classics/include/", {"std", "glm", "core-geometry", "core-public", "pack-public", "vulkan-public", "vulkan-api"},
     "a public header shows nothing private"),
    ("vulkan/classics/", STD | PUBLIC | {"classics", "backend", "glm", "vulkan-api", "shared", "shader-lib", "spirv"},
     "classic techniques are made of the backend, which does not know them"),
    ("gl/include/", {"std", "glm", "core-geometry", "core-public", "pack-public"}, "a public header shows nothing private"),
    ("gl/", STD | {"core-geometry", "core-public", "pack-public", "gl-public", "glm", "graphics", "shared", "spirv"},
     "a backend knows core and pack, and no other backend"),
    ("web/", STD | {"pack-public"}, "what the npm package adds is made of public headers"),
    ("files/", STD | {"core-geometry"}, "files know errors, nothing else"),
    ("image/", STD | {"core-geometry", "files", "png", "exr"}, "images know files and errors, nothing else"),
    ("scene/", STD | {"glm", "core-geometry", "files", "png", "jpeg", "webp", "draco", "meshopt", "json", "xxhash"},
     "a scene knows core's geometry.h, world_range.h and error.h only"),
    ("worlds/", STD | {"glm", "core-geometry", "scene"}, "worlds are made of a scene's parts"),
    ("truth/", STD | {"glm", "core-geometry", "files", "scene", "image", "embree"}, "the judge shares no shadow code with the judged"),
    ("host/shaders/", {"shared", "shader-lib"}, "the host's shaders include the library's, as an engine would"),
    ("host/", STD | PUBLIC | {"classics", "glm", "vulkan-api", "files", "scene", "image", "shared", "host-shared", "spirv"},
     "the host knows the library by its public headers, and no window"),
    ("host/window/", STD | PUBLIC | {"glm", "vulkan-api", "files", "image", "host", "private", "window", "imgui"},
     "windows are the host's, and show images"),
    ("lab/metrics", {"std", "image"}, "metrics know images only"),
    ("lab/score/", {"std", "glm", "core-geometry", "core-public", "scene", "image", "truth", "metrics"},
     "scores are had without our host, by whoever has plain images"),
    ("lab/", ABOVE | {"gd"}, "the lab knows public headers"),
    ("app/", ABOVE | {"app", "worlds", "cli", "text", "shared"}, "the program knows public headers, and widgets in app/src/view alone"),
    ("app/src/view/", ABOVE | {"app", "worlds", "imgui"}, "the window's panels are of Dear ImGui"),
    ("examples/", STD | PUBLIC | {"c-public", "gl-public", "glm", "vulkan-api", "graphics", "spirv", "shared", "shader-lib"},
     "an example is an engine: it has the library's public headers and nothing else of ours"),
    ("examples/osg/", STD | PUBLIC | {"gl-public", "glm", "graphics", "osg"}, "one by OpenSceneGraph has that, too"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([^>]+)>|"([^"]+)")')
SUFFIXES = {".c", ".cpp", ".h", ".glsl", ".vert", ".frag", ".comp", ".geom"}
PUBLIC_FOLDERS = ("core/include", "pack/include", "c/include", "vulkan/include", "vulkan/classics/include", "gl/include", "shaders/include", "")


def rule_for(path: str):
    return max((rule for rule in RULES if path.startswith(rule[0])), key=lambda rule: len(rule[0]), default=None)


def find_in_project(root: Path, file: Path, name: str, quoted: bool):
    """The project file that an include leads to, as the compiler would look for it, or None."""
    bases = list(PUBLIC_FOLDERS)
    if quoted:
        bases = [file.parent.as_posix(), file.parts[0] + "/src", *bases]
    for base in bases:
        target = (root / base / name).resolve()
        if target.is_file() and target.is_relative_to(root):
            return target.relative_to(root).as_posix()
    return None


def kind_of(name: str, kinds) -> str:
    for pattern, kind in kinds:
        match = re.search(pattern, name)
        if match:
            return match.expand(kind)
    return "unknown"


def check_file(root: Path, file: Path, rule) -> list[str]:
    folder, allowed, why = rule
    found = []
    for number, line in enumerate((root / file).read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        name = match.group(1) or match.group(2)
        target = find_in_project(root, file, name, match.group(2) is not None)
        if target and rule_for(target) is rule:
            continue
        kind = kind_of(target, PROJECT_KINDS) if target else kind_of(name, FOREIGN_KINDS)
        if kind not in allowed:
            found.append(f"{file.as_posix()}:{number}: {folder} may not include {name} ({kind}): {why}")
    return found


def main() -> int:
    root = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else project_root()
    files = 0
    found = []
    for file in project_files(root):
        rule = rule_for(file.as_posix())
        if file.suffix in SUFFIXES and rule is not None:
            files += 1
            found += check_file(root, file, rule)
    for line in found:
        print(line, file=sys.stderr)
    if files == 0:
        print("include rules: found no sources", file=sys.stderr)
        return 1
    print(f"include rules: {files} files, {len(found)} broken")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
