#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants one forbidden include at a time in a small made-up tree and expects the checker to name it; the tree without
them must pass. usage: test_check_includes.py CHECKER"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECKER = sys.argv.pop(1)

LEGAL = {
    "shaders/include/gnomon/shared/bias.h": '#include "portability.h"\n',
    "shaders/include/gnomon/shared/portability.h": "#include <glm/glm.hpp>\n",
    "shaders/include/gnomon/lib/filter.glsl": '#include "../shared/bias.h"\n',
    "core/include/gnomon/geometry.h": "#include <glm/vec3.hpp>\n#include <vector>\n",
    "core/include/gnomon/error.h": "#include <string>\n",
    "core/include/gnomon/plan.h": "#include <gnomon/geometry.h>\n",
    "core/include/gnomon/planner.h": "#include <gnomon/plan.h>\n",
    "core/include/gnomon/bias.h": "#include <gnomon/geometry.h>\n",
    "core/include/gnomon/frame.h": "#include <gnomon/geometry.h>\n",
    "core/include/gnomon/choices.h": "#include <cstdint>\n",
    "core/src/fit/uniform.cpp": '#include <gnomon/plan.h>\n#include "fit/uniform.h"\n#include <gnomon/shared/bias.h>\n',
    "core/src/fit/uniform.h": "#pragma once\n",
    "pack/include/gnomon/pack/lists.h": "#include <gnomon/plan.h>\n",
    "c/include/gnomon/gnomon.h": "#include <stddef.h>\n",
    "c/src/planner.h": "#include <gnomon/gnomon.h>\n#include <gnomon/pack/lists.h>\n#include <set>\n",
    "examples/c_host/c_host.c": "#include <gnomon/gnomon.h>\n#include <stdio.h>\n",
    "vulkan/include/gnomon/vulkan/renderer.h": "#include <gnomon/pack/lists.h>\n#include <vulkan/vulkan_core.h>\n",
    "vulkan/src/memory.h": "#include <gnomon/vulkan/renderer.h>\n",
    "vulkan/src/memory.cpp": '#include "memory.h"\n#include "gnomon_spirv.h"\n',
    "gl/include/gnomon/gl/shadow_renderer.h": "#include <gnomon/plan.h>\n",
    "web/wasm/precision.cpp": "#include <gnomon/pack/lists.h>\n",
    "gl/src/functions.h": "#include <GL/glcorearb.h>\n#include <gnomon/gl/shadow_renderer.h>\n",
    "vulkan/classics/include/gnomon/vulkan/classics.h": "#include <gnomon/vulkan/renderer.h>\n",
    "vulkan/classics/src/fins.cpp": '#include <gnomon/vulkan/classics.h>\n#include "memory.h"\n#include "gnomon_spirv.h"\n',
    "files/files.h": "#include <filesystem>\n",
    "files/src/write.cpp": '#include "files/files.h"\n#include <gnomon/error.h>\n#include <unistd.h>\n',
    "image/image.h": "#include <vector>\n",
    "image/src/png.cpp": '#include "image/image.h"\n#include "files/files.h"\n#include <png.h>\n#include <gnomon/error.h>\n',
    "scene/model.h": "#include <gnomon/geometry.h>\n",
    "scene/src/gltf/reader.h": '#include "scene/model.h"\n',
    "scene/src/gltf/reader.cpp": '#include "gltf/reader.h"\n#include <fstream>\n',
    "worlds/worlds.h": '#include "scene/model.h"\n',
    "worlds/src/planes.cpp": '#include "worlds/worlds.h"\n#include <gnomon/error.h>\n',
    "truth/tracer.h": '#include "scene/model.h"\n#include <gnomon/geometry.h>\n',
    "truth/src/rays.cpp": '#include "truth/tracer.h"\n#include <embree3/rtcore.h>\n#include <gnomon/error.h>\n',
    "host/renderer.h": '#include "scene/model.h"\n#include <gnomon/plan.h>\n#include <gnomon/vulkan/renderer.h>\n',
    "host/shaders/shade.frag": '#include "gnomon/lib/filter.glsl"\n',
    "lab/metrics.h": '#include "image/image.h"\n',
    "lab/score/score.h": '#include "lab/metrics.h"\n#include "truth/tracer.h"\n#include <gnomon/plan.h>\n',
    "lab/score/src/score.cpp": '#include "lab/score/score.h"\n#include "rays.h"\n',
    "lab/score/src/rays.h": "#include <vector>\n",
    "lab/compare.h": '#include "lab/score/score.h"\n#include "host/renderer.h"\n',
    "app/src/main.cpp": '#include "host/renderer.h"\n#include "worlds/worlds.h"\n#include <CLI/CLI.hpp>\n',
    "app/src/view/panel.cpp": '#include "host/renderer.h"\n#include <imgui.h>\n',
    "host/window/window.h": "#include <GLFW/glfw3.h>\n#include <imgui.h>\n",
    "examples/host/main.cpp": "#include <gnomon/vulkan/renderer.h>\n",
    "tests/vulkan/memory.cpp": '#include "../../vulkan/src/memory.h"\n',
}

# (file, line to plant, what it breaks)
ILLEGAL = [
    ("shaders/include/gnomon/shared/bias.h", '#include "../lib/filter.glsl"', "shared includes a shader"),
    ("shaders/include/gnomon/lib/filter.glsl", "#include <vector>", "a shader includes C++"),
    ("core/include/gnomon/plan.h", "#include <vulkan/vulkan_core.h>", "core includes graphics"),
    ("core/include/gnomon/plan.h", '#include "../../src/fit/uniform.h"', "a public header includes a private one"),
    ("core/src/fit/uniform.cpp", "#include <GLFW/glfw3.h>", "core includes a window"),
    ("core/src/fit/uniform.cpp", "#include <fstream>", "core includes files"),
    ("core/src/fit/uniform.cpp", "#  include <filesystem>", "core includes files, indented directive"),
    ("core/src/fit/uniform.cpp", '#include "scene/model.h"', "core includes scene"),
    ("core/src/fit/uniform.cpp", "#include <gnomon/vulkan/renderer.h>", "core includes the backend"),
    ("core/src/fit/uniform.cpp", "#include <nlohmann/json.hpp>", "core includes a library besides glm"),
    ("vulkan/include/gnomon/vulkan/renderer.h", '#include "../../../src/memory.h"', "a public header, a private one"),
    ("vulkan/src/memory.cpp", '#include "scene/model.h"', "the backend includes scene"),
    ("vulkan/include/gnomon/vulkan/renderer.h", "#include <gnomon/vulkan/classics.h>", "a public header includes classics"),
    ("vulkan/src/memory.cpp", "#include <gnomon/vulkan/classics.h>", "the backend includes classics"),
    ("vulkan/classics/include/gnomon/vulkan/classics.h", '#include "memory.h"', "a public header of classics, a private one"),
    ("vulkan/classics/src/fins.cpp", '#include "scene/model.h"', "classics include scene"),
    ("gl/include/gnomon/gl/shadow_renderer.h", "#include <GL/glcorearb.h>", "a public header shows OpenGL"),
    ("gl/src/functions.h", "#include <gnomon/vulkan/renderer.h>", "one backend includes the other"),
    ("web/wasm/precision.cpp", "#include <gnomon/planner.h>", "the npm package's own C++ includes the planner"),
    ("vulkan/src/memory.cpp", "#include <gnomon/gl/shadow_renderer.h>", "and the other the one"),
    ("examples/host/main.cpp", "#include <gnomon/vulkan/classics.h>", "an example includes classics"),
    ("pack/include/gnomon/pack/lists.h", "#include <vulkan/vulkan_core.h>", "pack includes graphics"),
    ("pack/include/gnomon/pack/lists.h", "#include <gnomon/vulkan/renderer.h>", "pack includes the backend"),
    ("core/include/gnomon/plan.h", "#include <gnomon/pack/lists.h>", "core includes pack"),
    ("c/include/gnomon/gnomon.h", "#include <gnomon/plan.h>", "the header for C includes C++"),
    ("c/src/planner.h", '#include "fit/uniform.h"', "the interface for C includes a private header"),
    ("c/src/planner.h", "#include <gnomon/vulkan/renderer.h>", "the interface for C includes the backend"),
    ("pack/include/gnomon/pack/lists.h", "#include <gnomon/gnomon.h>", "pack includes the interface for C"),
    ("examples/c_host/c_host.c", '#include "../../c/src/planner.h"', "an example includes a private header"),
    ("truth/tracer.h", "#include <gnomon/pack/lists.h>", "truth includes pack"),
    ("files/files.h", '#include "image/image.h"', "files include image"),
    ("files/src/write.cpp", "#include <png.h>", "files include a format's library"),
    ("image/image.h", "#include <gnomon/plan.h>", "image includes core's plan"),
    ("scene/model.h", "#include <gnomon/plan.h>", "scene includes more of core than geometry"),
    ("scene/model.h", "#include <vulkan/vulkan_core.h>", "scene includes graphics"),
    ("scene/src/gltf/reader.cpp", '#include "worlds/worlds.h"', "scene includes worlds"),
    ("worlds/src/planes.cpp", '#include "scene/src/gltf/reader.h"', "worlds include scene's private header"),
    ("worlds/worlds.h", "#include <gnomon/plan.h>", "worlds include core's plan"),
    ("truth/tracer.h", '#include "worlds/worlds.h"', "truth includes worlds"),
    ("lab/compare.h", '#include "worlds/worlds.h"', "the lab includes worlds"),
    ("truth/tracer.h", "#include <gnomon/plan.h>", "truth includes core's plan"),
    ("truth/tracer.h", "#include <gnomon/planner.h>", "truth includes core's planner"),
    ("truth/tracer.h", "#include <gnomon/bias.h>", "truth includes core's bias"),
    ("truth/tracer.h", "#include <gnomon/frame.h>", "truth includes core's frame"),
    ("truth/tracer.h", "#include <gnomon/choices.h>", "truth includes core's choices"),
    ("truth/tracer.h", '#include <gnomon/shared/bias.h>', "truth includes shared shadow arithmetic"),
    ("truth/tracer.h", '#include "shaders/include/gnomon/shared/bias.h"', "truth includes shared shadow arithmetic by its whole path"),
    ("truth/tracer.h", '#include "shaders/include/gnomon/lib/filter.glsl"', "truth includes a filter"),
    ("truth/tracer.h", '#include "core/src/fit/uniform.h"', "truth includes core's private header"),
    ("truth/tracer.h", "#include <gnomon/vulkan/renderer.h>", "truth includes the backend"),
    ("truth/tracer.h", '#include "host/renderer.h"', "truth includes host"),
    ("truth/tracer.h", '#include "lab/metrics.h"', "truth includes what measures by it"),
    ("truth/src/rays.cpp", "#include <gnomon/plan.h>", "a source of truth includes core's plan"),
    ("truth/src/rays.cpp", '#include "shaders/include/gnomon/shared/bias.h"', "a source of truth includes shared shadow arithmetic"),
    ("truth/src/rays.cpp", '#include "host/renderer.h"', "a source of truth includes host"),
    ("host/renderer.h", '#include "../vulkan/src/memory.h"', "host includes the backend's private header"),
    ("host/renderer.h", '#include "core/src/fit/uniform.h"', "host includes core's private header"),
    ("host/renderer.h", '#include "scene/src/gltf/reader.h"', "host includes scene's private header"),
    ("host/renderer.h", '#include "app/src/main.cpp"', "host includes the program"),
    ("host/renderer.h", "#include <GLFW/glfw3.h>", "host includes a window"),
    ("host/window/window.h", '#include "scene/model.h"', "a window knows a scene"),
    ("lab/metrics.h", '#include "host/renderer.h"', "metrics include host"),
    ("lab/metrics.h", '#include "lab/compare.h"', "metrics include the rest of the lab"),
    ("lab/score/score.h", '#include "host/renderer.h"', "scores include host"),
    ("lab/score/score.h", "#include <gnomon/vulkan/renderer.h>", "scores include the backend"),
    ("lab/score/src/score.cpp", '#include "lab/compare.h"', "scores include the rest of the lab"),
    ("lab/compare.h", '#include "lab/score/src/rays.h"', "the lab includes a private header of the scores"),
    ("app/src/main.cpp", '#include "vulkan/src/memory.h"', "the program includes a private header"),
    ("app/src/main.cpp", "#include <imgui.h>", "the program's sources except the window's include widgets"),
    ("app/src/view/panel.cpp", "#include <GLFW/glfw3.h>", "panels include a window"),
    ("examples/host/main.cpp", '#include "host/renderer.h"', "an example includes our host"),
    ("core/src/fit/uniform.cpp", '#include "shared/bias.h"', "core includes a shared header without the prefix"),
    ("core/src/fit/uniform.cpp", '#include "no/such/header.h"', "a header nobody knows"),
]


def run(tree: dict[str, str]) -> subprocess.CompletedProcess:
    with tempfile.TemporaryDirectory() as root:
        for name, text in tree.items():
            file = Path(root, name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, CHECKER, root], capture_output=True, text=True, check=False)


class IncludeRules(unittest.TestCase):
    def test_legal_tree_passes(self):
        result = run(LEGAL)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_every_planted_include_is_named(self):
        for file, line, breaks in ILLEGAL:
            with self.subTest(breaks):
                result = run({**LEGAL, file: LEGAL[file] + line + "\n"})
                self.assertEqual(result.returncode, 1, f"{file}: {line} went unnoticed")
                where = f"{file}:{LEGAL[file].count(chr(10)) + 1}:"
                self.assertIn(where, result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)

    def test_empty_tree_fails(self):
        self.assertEqual(run({"README.md": "nothing\n"}).returncode, 1)


if __name__ == "__main__":
    unittest.main()
