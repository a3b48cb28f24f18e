# SPDX-License-Identifier: Apache-2.0
"""Conan 2 recipe of the library: conan create packaging/conan. It builds the tree that it lies in."""

import os

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class GnomonConan(ConanFile):
    name = "gnomon"
    version = "0.1.0"
    description = "Real-time soft shadows: shadow maps of all kinds, planned on the CPU and recorded into Vulkan command buffers"
    license = "Apache-2.0"
    topics = ("shadows", "vulkan", "rendering")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    # What the library is made of; the program and the tests are left out.
    parts = ("CMakeLists.txt", "LICENSE", "cmake/*", "core/*", "pack/*", "c/*", "vulkan/*", "shaders/*", "examples/*")

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for part in self.parts:
            copy(self, part, root, self.export_sources_folder)

    def configure(self):
        if self.options.shared:
            self.options.rm_safe("fPIC")

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        # Their headers are part of the library's own.
        self.requires("glm/1.0.1", transitive_headers=True)
        self.requires("vulkan-headers/1.3.243.0", transitive_headers=True)
        self.requires("vulkan-loader/1.3.243.0")

    def build_requirements(self):
        self.tool_requires("shaderc/2024.1")
        self.tool_requires("spirv-tools/1.3.268.0")

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("gnomon is built on Linux only")

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update(self.cmake_options())
        toolchain.generate()
        CMakeDeps(self).generate()

    @staticmethod
    def cmake_options():
        return {"GNOMON_PROGRAM": False, "GNOMON_TESTS": False, "GNOMON_INSTALL": True, "GNOMON_GL": False}

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        # The library's own files for CMake are taken: they have gnomon_shaders(), too.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append(os.path.join("lib", "cmake", "gnomon"))
        below = []
        for name in ("core", "pack", "c", "vulkan", "vulkan_classics"):
            part = self.cpp_info.components[name]
            # The shared library of vulkan has classics, too.
            part.libs = [] if self.options.shared and name == "vulkan_classics" else [f"gnomon-{name}"]
            part.set_property("pkg_config_name", f"gnomon-{name}")
            part.requires = list(below)
            if name != "c":  # which nothing of the library is made of
                below.append(name)
        if not self.options.shared:
            self.cpp_info.components["c"].system_libs = ["stdc++", "m"]
        self.cpp_info.components["core"].requires.append("glm::glm")
        self.cpp_info.components["vulkan"].requires += ["vulkan-headers::vulkan-headers", "vulkan-loader::vulkan-loader"]
