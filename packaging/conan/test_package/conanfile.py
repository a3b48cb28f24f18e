# SPDX-License-Identifier: Apache-2.0
"""Builds the project of tests/package/consumer against the package, and runs it."""

import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class GnomonTestConan(ConanFile):
    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeDeps", "CMakeToolchain"
    consumer = "../../../tests/package/consumer"

    def requirements(self):
        self.requires(self.tested_reference_str)

    def build_requirements(self):
        self.tool_requires("shaderc/2024.1")
        self.tool_requires("spirv-tools/1.3.268.0")

    def layout(self):
        cmake_layout(self)

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder=self.consumer)
        cmake.build()

    def test(self):
        if can_run(self):
            for program in ("plan", "record"):
                self.run(os.path.join(self.cpp.build.bindir, program), env="conanrun")
