# SPDX-License-Identifier: Apache-2.0
"""Compiles and links GLSL and ESSL with the machine's OpenGL driver, which needs no screen (Mesa's, on the CPU)."""

import ctypes

SURFACELESS = 0x31DD
STAGES = {"vertex": 0x8B31, "fragment": 0x8B30, "compute": 0x91B9}
COMPILED, LINKED, VERSION = 0x8B81, 0x8B82, 0x1F02
# By dialect: the library, EGL's number of the API, and the context's version and profile.
APIS = {"glsl": ("libOpenGL.so.0", 0x30A2, (0x3098, 4, 0x30FB, 5, 0x30FD, 1, 0x3038)),
        "essl": ("libGLESv2.so.2", 0x30A0, (0x3098, 3, 0x30FB, 1, 0x3038))}


class Driver:
    """A context of one dialect, current for this thread. Throws OSError where there is none."""

    def __init__(self, dialect: str):
        library, api, attributes = APIS[dialect]
        egl, self.gl = ctypes.CDLL("libEGL.so.1"), ctypes.CDLL(library)
        egl.eglGetPlatformDisplay.restype = egl.eglCreateContext.restype = ctypes.c_void_p
        display = ctypes.c_void_p(egl.eglGetPlatformDisplay(SURFACELESS, None, None))
        if not egl.eglInitialize(display, None, None) or not egl.eglBindAPI(api):
            raise OSError("there is no OpenGL driver that works without a screen")
        context = ctypes.c_void_p(egl.eglCreateContext(display, None, None, (ctypes.c_int * len(attributes))(*attributes)))
        if not context.value or not egl.eglMakeCurrent(display, None, None, context):
            raise OSError(f"the OpenGL driver makes no context for {dialect}")
        self.gl.glGetString.restype = ctypes.c_char_p
        self.name = self.gl.glGetString(VERSION).decode()

    def compile(self, stage: str, text: str) -> tuple[int, str]:
        """The shader, and the first line of what is wrong with it; empty: nothing."""
        shader = self.gl.glCreateShader(STAGES[stage])
        source = ctypes.c_char_p(text.encode("utf-8"))
        self.gl.glShaderSource(shader, 1, ctypes.byref(source), None)
        self.gl.glCompileShader(shader)
        return shader, self._wrong(self.gl.glGetShaderiv, self.gl.glGetShaderInfoLog, shader, COMPILED)

    def link(self, shaders: list[int]) -> str:
        program = self.gl.glCreateProgram()
        for shader in shaders:
            self.gl.glAttachShader(program, shader)
        self.gl.glLinkProgram(program)
        wrong = self._wrong(self.gl.glGetProgramiv, self.gl.glGetProgramInfoLog, program, LINKED)
        self.gl.glDeleteProgram(program)
        return wrong

    @staticmethod
    def _wrong(status, log, target: int, what: int) -> str:
        good = ctypes.c_int(0)
        status(target, what, ctypes.byref(good))
        text = ctypes.create_string_buffer(4096)
        log(target, len(text), None, text)
        return "" if good.value else (text.value.decode("utf-8", "replace").strip().splitlines() or ["refused"])[0]
