#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What docs/kit.md says of coordinates: a triangle that Vulkan draws to rows 0 and 1 of an image's four, at depth 0.25 and facing
front, is drawn so by OpenGL and OpenGL ES, and where WGSL is made by Dawn on SwiftShader.

usage: test_draws.py KIT [BUILD]. With BUILD, which has npm packages, WGSL too. Exit status 77 where there is no device for one.
"""

import ctypes
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "kit"))
import gl  # noqa: E402
import npm  # noqa: E402

SWIFTSHADER = "/usr/lib/chromium/vk_swiftshader_icd.json"
# Counter-clockwise in Vulkan, whose y points down.
CORNERS = (ctypes.c_float * 9)(-1, 0, 0.25, 3, 0, 0.25, -1, -4, 0.25)
SHOWN = "layout(location = 0) out highp vec4 depth;\nvoid main() { depth = vec4(gl_FragCoord.z); }\n"
HEADS = {"glsl": "#version 450\n", "essl": "#version 310 es\n"}
FRAMEBUFFER, TEXTURE_2D, RGBA8, CULL_FACE, BUFFER, TRIANGLES, CLOCKWISE, COUNTER_CLOCKWISE = (0x8D40, 0x0DE1, 0x8058, 0x0B44, 0x8892, 4, 0x0900,
                                                                                             0x0901)


def generated(generate) -> int:
    made = ctypes.c_uint()
    generate(1, ctypes.byref(made))
    return made.value


def prepare(driver: gl.Driver, dialect: str, kit: Path) -> None:
    """An image of 4 x 4 texels to draw to, a program and what it reads."""
    calls = driver.gl
    texture = generated(calls.glGenTextures)
    calls.glBindTexture(TEXTURE_2D, texture)
    calls.glTexStorage2D(TEXTURE_2D, 1, RGBA8, 4, 4)
    calls.glBindFramebuffer(FRAMEBUFFER, generated(calls.glGenFramebuffers))
    calls.glFramebufferTexture2D(FRAMEBUFFER, 0x8CE0, TEXTURE_2D, texture, 0)
    calls.glViewport(0, 0, 4, 4)
    program = calls.glCreateProgram()
    for stage, text in (("vertex", (kit / f"{dialect}/caster.vert.{dialect}").read_text(encoding="utf-8")), ("fragment", HEADS[dialect] + SHOWN)):
        shader, wrong = driver.compile(stage, text)
        assert not wrong, wrong
        calls.glAttachShader(program, shader)
    calls.glLinkProgram(program)
    calls.glUseProgram(program)
    calls.glBindVertexArray(generated(calls.glGenVertexArrays))
    calls.glBindBuffer(BUFFER, generated(calls.glGenBuffers))
    calls.glBufferData(BUFFER, ctypes.c_ssize_t(ctypes.sizeof(CORNERS)), CORNERS, 0x88E4)
    calls.glEnableVertexAttribArray(0)
    calls.glVertexAttribPointer(0, 3, 0x1406, 0, 0, None)
    for location in (1, 2, 3):  # the identity's rows
        calls.glVertexAttrib4f(location, *(ctypes.c_float(location == i) for i in (1, 2, 3)), ctypes.c_float(0))
    calls.glEnable(CULL_FACE)
    if dialect == "glsl":
        calls.glClipControl(0x8CA1, 0x935F)  # GL_LOWER_LEFT, GL_ZERO_TO_ONE


def drawn(driver: gl.Driver, front: int) -> list[int]:
    """Each row's first texel, which is 255 where nothing is drawn."""
    calls = driver.gl
    calls.glClearColor(*(ctypes.c_float(1),) * 4)
    calls.glClear(0x4000)
    calls.glFrontFace(front)
    calls.glDrawArrays(TRIANGLES, 0, 3)
    texels = (ctypes.c_ubyte * 64)()
    calls.glReadPixels(0, 0, 4, 4, 0x1908, 0x1401, texels)
    assert calls.glGetError() == 0
    return [texels[16 * row] for row in range(4)]


def faults_of_opengl(dialect: str, kit: Path) -> list[str]:
    driver = gl.Driver(dialect)
    prepare(driver, dialect, kit)
    found = []
    for front, expected in ((CLOCKWISE, [64, 64, 255, 255]), (COUNTER_CLOCKWISE, [255] * 4)):
        rows = drawn(driver, front)
        if rows != expected:
            found.append(f"{dialect} draws {rows}, not {expected}")
    return found


def main() -> int:
    kit = Path(sys.argv[1])
    found, skipped = [], []
    for dialect in ("glsl", "essl"):
        try:
            found += faults_of_opengl(dialect, kit)
        except OSError as error:
            skipped.append(str(error))
    if len(sys.argv) > 2:
        folder = npm.ready(Path(sys.argv[2]), checking=True)
        shutil.copy(HERE / "draw.mjs", folder)
        done = subprocess.run(["node", "draw.mjs", kit.resolve() / "wgsl/caster.vert.wgsl"], cwd=folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "VK_DRIVER_FILES": SWIFTSHADER, "VK_ICD_FILENAMES": SWIFTSHADER})
        if done.returncode == 77:
            skipped.append(done.stdout.strip())
        elif done.stdout.strip() != "0.25 0.25 1 1":
            found.append(f"wgsl draws {done.stdout}{done.stderr}")
    for line in found + [f"SKIPPED: {one}" for one in skipped]:
        print(line)
    return 1 if found else 77 if skipped else 0


if __name__ == "__main__":
    sys.exit(main())
