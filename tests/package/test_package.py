#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Others build with Gnomon: with an installed one, with one in their own build, and by the recipes of packaging/.

usage: test_package.py --source DIR --build DIR --work DIR --cxx COMPILER [CASE...]
DIR of --build has Gnomon built; what is made goes to that of --work.
"""

import argparse
import ast
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

OPTIONS = argparse.Namespace()
CONSUMER = Path(__file__).parent / "consumer"
PROGRAM_FOLDERS = ("files", "image", "scene", "truth", "host", "lab", "app")


def run(*command, **more) -> subprocess.CompletedProcess:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **more)


def folder(name: str) -> Path:
    """An empty one."""
    path = OPTIONS.work / name
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    return path


def configure(source: Path, build: Path, *flags: str) -> subprocess.CompletedProcess:
    return run("cmake", "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_CXX_COMPILER={OPTIONS.cxx}",
               "-DCMAKE_BUILD_TYPE=Release", *flags)


class Case(unittest.TestCase):
    maxDiff = None

    def passes(self, done: subprocess.CompletedProcess) -> str:
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def fails(self, done: subprocess.CompletedProcess, *words: str) -> None:
        self.assertNotEqual(done.returncode, 0, done.stdout)
        said = " ".join(done.stderr.split())
        for word in words:
            self.assertIn(word, said)


class Installed(Case):
    @classmethod
    def setUpClass(cls):
        first = folder("installed")
        for component in ("library", "development"):
            done = run("cmake", "--install", OPTIONS.build, "--prefix", first, "--component", component)
            assert done.returncode == 0, done.stderr
        # Elsewhere than where it was installed, as packages are.
        cls.prefix = OPTIONS.work / "moved"
        shutil.rmtree(cls.prefix, ignore_errors=True)
        first.rename(cls.prefix)
        cls.found = f"-DCMAKE_PREFIX_PATH={cls.prefix}"

    def test_headers_have_one_folder(self):
        include = self.prefix / "include"
        self.assertEqual(os.listdir(include), ["gnomon"])
        headers = [file.relative_to(include) for file in include.rglob("*.h")]
        self.assertGreater(len(headers), 50)
        source = folder("headers") / "all.cpp"
        source.write_text("".join(f"#include <{header}>\n" for header in sorted(headers)), encoding="utf-8")
        self.passes(run(OPTIONS.cxx, "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{include}", source))
        for file in include.rglob("*.glsl"):
            for name in re.findall(r'^#include "([^"]+)"', file.read_text(encoding="utf-8"), re.MULTILINE):
                self.assertTrue((file.parent / name).is_file(), f"{file} includes {name}")

    def test_find_package(self):
        build = folder("find_package")
        self.passes(configure(CONSUMER, build, self.found))
        self.passes(run("cmake", "--build", build))
        self.assertIn("planned; refused: ", self.passes(run(build / "plan")))
        self.passes(run(build / "record"))

    def project(self, *lines: str) -> subprocess.CompletedProcess:
        source = folder("project")
        text = "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n" + "\n".join(lines) + "\n"
        (source / "CMakeLists.txt").write_text(text, encoding="utf-8")
        return configure(source, source / "build", self.found)

    def test_component_that_is_unknown_is_named(self):
        self.fails(self.project("find_package(gnomon REQUIRED COMPONENTS core volcano)"),
                   'gnomon has no component "volcano"; it has core, pack, c, vulkan, vulkan_classics, ' +
                   ("gl, shaders" if self.has_gl() else "shaders"))
        self.passes(self.project("find_package(gnomon REQUIRED OPTIONAL_COMPONENTS volcano core)",
                                 "if(gnomon_volcano_FOUND OR NOT gnomon_core_FOUND)", "message(FATAL_ERROR no)", "endif()"))

    def has_gl(self) -> bool:
        return any(self.prefix.rglob("gnomon-gl.cmake"))

    def test_another_minor_version_is_refused(self):
        for version in ("0.0", "0.2", "1.0", "0.1.9"):
            self.fails(self.project(f"find_package(gnomon {version} REQUIRED)"), f'requested version "{version}"')

    def test_core_needs_no_vulkan(self):
        without = "set(CMAKE_DISABLE_FIND_PACKAGE_Vulkan ON)"
        self.passes(self.project(without, "find_package(gnomon REQUIRED COMPONENTS pack shaders)", "if(TARGET gnomon::vulkan)",
                                 "message(FATAL_ERROR no)", "endif()"))
        self.fails(self.project(without, "find_package(gnomon REQUIRED)"), "Vulkan")

    def test_shaders_without_a_compiler(self):
        self.fails(self.project("find_package(gnomon REQUIRED COMPONENTS shaders)", "set(GNOMON_GLSLC GNOMON_GLSLC-NOTFOUND)",
                                "set(CMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH OFF)", "set(CMAKE_FIND_USE_CMAKE_SYSTEM_PATH OFF)",
                                "gnomon_shaders(s a.vert)"),
                   "compiling shaders needs glslc and spirv-val")

    def test_pkg_config(self):
        build = folder("pkg_config")
        environment = {**os.environ, "PKG_CONFIG_PATH": ":".join(map(str, self.prefix.rglob("pkgconfig")))}

        def flags(*words: str) -> list[str]:
            return shlex.split(self.passes(run("pkg-config", *words, env=environment)))

        compiler = [OPTIONS.cxx, "-std=c++20", CONSUMER / "plan.cpp", "-o", build / "plan"]
        self.passes(run(*compiler, *flags("--cflags", "--libs", "gnomon-core")))
        self.assertIn("planned", self.passes(run(build / "plan")))
        text = "#include <gnomon/vulkan/shadow_renderer.h>\nint main() { return gnomon::vulkan::requiredFeatures({}).pNext == nullptr; }\n"
        (build / "record.cpp").write_text(text, encoding="utf-8")
        self.passes(run(OPTIONS.cxx, "-std=c++20", build / "record.cpp", "-o", build / "record",
                        *flags("--cflags", "--libs", "gnomon-vulkan")))
        self.passes(run(build / "record"))
        text = "#include <gnomon/vulkan/classics.h>\nint main() { return gnomon::vulkan::makeClassics() == nullptr; }\n"
        (build / "classics.cpp").write_text(text, encoding="utf-8")
        self.passes(run(OPTIONS.cxx, "-std=c++20", build / "classics.cpp", "-o", build / "classics",
                        *flags("--cflags", "--libs", "gnomon-vulkan_classics")))
        self.passes(run(build / "classics"))
        if self.has_gl():
            text = ("#include <gnomon/gl/shadow_renderer.h>\nint main()\n{\n    try {\n        gnomon::gl::ShadowRenderer r({});\n"
                    "    } catch (const std::exception&) {\n        return 0;\n    }\n    return 1;\n}\n")
            (build / "gl.cpp").write_text(text, encoding="utf-8")
            self.passes(run(OPTIONS.cxx, "-std=c++20", build / "gl.cpp", "-o", build / "gl",
                            *flags("--cflags", "--libs", "gnomon-gl")))
            self.passes(run(build / "gl"))
        # A host in C, which a compiler of C links.
        host = next(self.prefix.rglob("examples/c_host/c_host.c"))
        self.passes(run("cc", "-std=c99", host, "-o", build / "c_host", *flags("--cflags", "--libs", "gnomon-c")))
        self.assertIn("frame 1, pass mask", self.passes(run(build / "c_host")))
        include = flags("--variable=includedir", "gnomon-shaders")[0]
        self.passes(run("glslc", "--target-env=vulkan1.3", "-DGNOMON_FILTER=GNOMON_FILTER_HARD", "-I", include,
                        CONSUMER / "visible.frag", "-o", build / "visible.spv"))
        self.assertEqual(flags("--modversion", "gnomon-core", "gnomon-pack", "gnomon-c", "gnomon-vulkan", "gnomon-vulkan_classics", "gnomon-shaders"),
                         ["0.1.0"] * 6)

    def test_examples(self):
        for name in ("minimal_host", "forward_host") + (("gl_host",) if self.has_gl() else ()):
            source, build = next(self.prefix.rglob(f"examples/{name}")), folder(name)
            self.passes(configure(source, build, self.found))
            self.passes(run("cmake", "--build", build))
            self.passes(run(build / name, build))
            self.assertTrue([*build.glob("*.p[gp]m")])
        build = folder("c_host")
        self.passes(configure(next(self.prefix.rglob("examples/c_host")), build, self.found,
                              "-DCMAKE_DISABLE_FIND_PACKAGE_Vulkan=ON"))
        self.passes(run("cmake", "--build", build))
        self.assertIn("frame 1, pass mask", self.passes(run(build / "c_host")))

    @unittest.skipUnless(shutil.which("xvfb-run") and shutil.which("xauth") and
                         run("pkg-config", "--exists", "openscenegraph").returncode == 0, "no OpenSceneGraph, or no xvfb-run")
    def test_osg(self):
        if not self.has_gl():
            self.skipTest("no OpenGL backend")
        build = folder("osg")
        self.passes(configure(next(self.prefix.rglob("examples/osg")), build, self.found))
        self.passes(run("cmake", "--build", build))
        picture = build / "picture.png"
        self.passes(run("xvfb-run", "-a", build / "gnomon_osg", "--technique", "pcf", "--size", "320x200", "--screenshot", picture))
        self.assertTrue(picture.is_file())


class InBuild(Case):
    def test_add_subdirectory(self):
        build = folder("add_subdirectory")
        self.passes(configure(CONSUMER, build, "-DHOW=add_subdirectory", f"-DGNOMON_SOURCE={OPTIONS.source}"))
        # Whoever does not link the interface for C or classic techniques does not compile them.
        self.assertNotIn("gnomon_c.dir", self.passes(run("ninja", "-C", build, "-t", "inputs", "all")))
        for target, has in (("all", False), ("classics", True)):
            inputs = self.passes(run("ninja", "-C", build, "-t", "inputs", target))
            self.assertEqual(has, "gnomon_classic_spirv" in inputs, target)
            self.assertEqual(has, "gnomon_vulkan_classics" in inputs, target)
        # All but the library itself, which takes a minute: tools/package_test.sh builds and runs it.
        self.passes(run("cmake", "--build", build, "--target", "consumer_spirv", "CMakeFiles/plan.dir/plan.cpp.o"))
        # Of what is another project's part nothing is installed.
        self.passes(run("cmake", "--install", build, "--prefix", build / "prefix"))
        self.assertFalse((build / "prefix").exists())

    def test_fetch_content(self):
        build = folder("fetch_content")
        self.passes(configure(CONSUMER, build, "-DHOW=FetchContent", f"-DGNOMON_SOURCE={OPTIONS.source}"))
        self.assertIn("gnomon_vulkan", self.passes(run("ninja", "-C", build, "-t", "targets", "all")))


def program_packages() -> set[str]:
    """What the program's folders ask CMake for."""
    text = "".join(file.read_text(encoding="utf-8") for name in PROGRAM_FOLDERS
                   for file in (OPTIONS.source / name).rglob("CMakeLists.txt"))
    return set(re.findall(r"find_package\((\w+)", text)) - {"Vulkan", "glm"}


class Configured(Case):
    def test_planner_and_pack_need_no_vulkan(self):
        build, prefix = folder("without_vulkan"), folder("without_vulkan_installed")
        without = "-DCMAKE_DISABLE_FIND_PACKAGE_Vulkan=ON"
        self.passes(configure(OPTIONS.source, build, "-DGNOMON_PROGRAM=OFF", "-DGNOMON_VULKAN=OFF", "-DGNOMON_UNITY=ON", without))
        self.assertNotIn("spirv", self.passes(run("ninja", "-C", build, "-t", "targets", "all")))
        self.passes(run("cmake", "--build", build))
        self.passes(run("cmake", "--install", build, "--prefix", prefix))
        source = folder("without_vulkan_host")
        for wish, works in (("COMPONENTS pack", True), ("OPTIONAL_COMPONENTS vulkan", True), ("COMPONENTS vulkan", False)):
            text = f"cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\nfind_package(gnomon REQUIRED {wish})\n"
            (source / "CMakeLists.txt").write_text(text, encoding="utf-8")
            done = configure(source, folder("without_vulkan_found"), f"-DCMAKE_PREFIX_PATH={prefix}", without)
            self.assertEqual(done.returncode == 0, works, f"{wish}: {done.stderr}")
        self.fails(configure(OPTIONS.source, folder("program_without_vulkan"), "-DGNOMON_VULKAN=OFF"),
                   "the program draws by Vulkan")

    def test_library_alone_needs_no_package_of_the_program(self):
        packages = program_packages()
        self.assertLessEqual({"embree", "OpenEXR", "PNG", "nlohmann_json", "CLI11", "PkgConfig"}, packages)
        without = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in sorted(packages)]
        self.passes(configure(OPTIONS.source, folder("library"), "-DGNOMON_PROGRAM=OFF", *without))
        self.fails(configure(OPTIONS.source, folder("program"), *without), "A REQUIRED package cannot be disabled")

    def test_shared_library_has_no_tests(self):
        self.passes(configure(OPTIONS.source, folder("shared"), "-DGNOMON_PROGRAM=OFF", "-DBUILD_SHARED_LIBS=ON"))
        self.fails(configure(OPTIONS.source, folder("tested"), "-DBUILD_SHARED_LIBS=ON", "-DGNOMON_TESTS=ON"),
                   "functions that a shared library hides")

    def test_sections_of_packages(self):
        tool = OPTIONS.source / "tools/install_packages.sh"
        library = self.passes(run(tool, "--list", "--only", "library")).split()
        self.assertIn("libvulkan-dev", library)
        self.assertNotIn("libembree-dev", library)
        self.assertLess(set(library), set(self.passes(run(tool, "--list")).split()))
        site = self.passes(run(tool, "--list", "--only", "site")).split()
        self.assertEqual(set(self.passes(run(tool, "--list", "--without", "site")).split()), set(self.passes(run(tool, "--list")).split()) - set(site))
        kit = self.passes(run(tool, "--list", "--only", "kit")).split()
        self.assertEqual(kit, ["nodejs", "npm"])
        self.assertEqual(set(self.passes(run(tool, "--list", "--without", "site", "--without", "kit")).split()),
                         set(self.passes(run(tool, "--list")).split()) - set(site) - set(kit))
        self.fails(run(tool, "--list", "--only", "volcano"), 'nothing in section "volcano"; it has these: library,')


class Recipes(Case):
    def version(self) -> str:
        return re.search(r"project\(gnomon VERSION (\S+)", (OPTIONS.source / "CMakeLists.txt").read_text(encoding="utf-8"))[1]

    def test_debian_changelog(self):
        text = (OPTIONS.source / "packaging/debian/changelog").read_text(encoding="utf-8")
        self.assertRegex(text, rf"^gnomon \({re.escape(self.version())}\) ")

    def test_vcpkg_manifest(self):
        port = OPTIONS.source / "packaging/vcpkg/ports/gnomon"
        manifest = json.loads((port / "vcpkg.json").read_text(encoding="utf-8"))
        self.assertEqual((manifest["name"], manifest["version"]), ("gnomon", self.version()))
        self.assertLessEqual(set(manifest), {"$schema", "name", "version", "description", "license", "supports", "dependencies"})
        for one in manifest["dependencies"]:
            self.assertLessEqual(set([] if isinstance(one, str) else one), {"name", "host", "features"})
            self.assertRegex(one if isinstance(one, str) else one["name"], r"^[a-z0-9-]+$")

    def test_vcpkg_port(self):
        # The port's own lines, with vcpkg's functions by what they hand to CMake.
        packages = folder("vcpkg")
        port = OPTIONS.source / "packaging/vcpkg/ports/gnomon"
        host = packages / "host"
        for tool, program in (("shaderc", "glslc"), ("spirv-tools", "spirv-val")):
            (host / "tools" / tool).mkdir(parents=True)
            (host / "tools" / tool / program).symlink_to(shutil.which(program))
        self.passes(run("cmake", f"-DCURRENT_PORT_DIR={port}", f"-DCURRENT_HOST_INSTALLED_DIR={host}", f"-DPACKAGES={packages}",
                        "-DCMAKE_CXX_COMPILER=" + OPTIONS.cxx, "-P", Path(__file__).parent / "vcpkg_functions.cmake"))
        self.assertTrue((packages / "share/gnomon/usage").is_file())
        self.assertTrue((packages / "share/gnomon/copyright").is_file())

    def test_conan_recipe(self):
        for file in ("conanfile.py", "test_package/conanfile.py"):
            text = (OPTIONS.source / "packaging/conan" / file).read_text(encoding="utf-8")
            tree = ast.parse(text)
            compile(tree, file, "exec")
        text = (OPTIONS.source / "packaging/conan/conanfile.py").read_text(encoding="utf-8")
        self.assertIn(f'version = "{self.version()}"', text)
        tree = ast.parse(text)
        options = next(ast.literal_eval(node.body[0].value) for node in ast.walk(tree)
                       if isinstance(node, ast.FunctionDef) and node.name == "cmake_options")
        parts = next(ast.literal_eval(node.value) for node in ast.walk(tree)
                     if isinstance(node, ast.Assign) and node.targets[0].id == "parts")
        # What is exported is enough to configure.
        source = folder("conan") / "source"
        for part in parts:
            name = part.removesuffix("/*")
            copy = shutil.copytree if part.endswith("/*") else shutil.copy
            source.mkdir(exist_ok=True)
            copy(OPTIONS.source / name, source / name)
        flags = [f"-D{name}={'ON' if value else 'OFF'}" for name, value in options.items()]
        self.passes(configure(source, source.parent / "build", "-DBUILD_SHARED_LIBS=ON", *flags))
        self.assertTrue((source.parent / "build/cmake_install.cmake").is_file())


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    for path in ("--source", "--build", "--work"):
        parser.add_argument(path, type=Path, required=True)
    parser.add_argument("--cxx", required=True)
    parser.add_argument("cases", nargs="*")
    parser.parse_args(namespace=OPTIONS)
    OPTIONS.work.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=[sys.argv[0], *OPTIONS.cases])
