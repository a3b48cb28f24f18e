#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A shared library shows what is public, all of it and nothing else.

usage: test_symbols.py --nm NM --cxx CXX --version V --shared LIBRARY... --static LIBRARY... --users LIBRARY...
The users are archives that call the library.
"""

import argparse
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PUBLIC = re.compile(r"(typeinfo for |typeinfo name for |vtable for )?gnomon::|gnomon[A-Z]\w*$")
OPTIONS = argparse.Namespace()


def symbols(file: str, *flags: str) -> list[tuple[str, str]]:
    """Kind and name of each."""
    lines = subprocess.run([OPTIONS.nm, *flags, "--format=posix", file], capture_output=True, text=True, check=True).stdout
    return [(words[1], words[0]) for line in lines.splitlines() if len(words := line.split()) >= 2]


def plain(names: list[str]) -> list[str]:
    text = subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True).stdout
    return text.splitlines()


def faults(library: str, version: str) -> list[str]:
    """What of the library's visible symbols is not public, or has not the version."""
    found = []
    shown = [name for kind, name in symbols(library, "-D", "--defined-only", "--with-symbol-versions") if kind != "A"]
    mangled = [name.partition("@@") for name in shown]
    for (name, _, node), text in zip(mangled, plain([name for name, _, _ in mangled])):
        if not PUBLIC.match(text) or "::Impl" in text:
            found.append(f"{text} is visible")
        if node != version:
            found.append(f"{text} has version {node or 'none'}")
    return found


class Symbols(unittest.TestCase):
    def test_what_is_visible_is_public(self):
        node = "GNOMON_" + ".".join(OPTIONS.version.split(".")[:2])
        for library in OPTIONS.shared:
            with self.subTest(library=Path(library).name):
                self.assertGreater(len(symbols(library, "-D", "--defined-only")), 10)
                self.assertEqual(faults(library, node), [])

    def test_all_that_the_program_calls_is_visible(self):
        shown = {name.partition("@")[0] for library in OPTIONS.shared for _, name in symbols(library, "-D", "--defined-only")}
        defined = {name for library in OPTIONS.static for kind, name in symbols(library, "--defined-only") if kind in "TDBR"}
        called = {name for user in OPTIONS.users for kind, name in symbols(user) if kind == "U"} & defined
        self.assertGreater(len(called), 50)
        self.assertEqual(plain(sorted(called - shown)), [])

    def test_names_have_the_major_version(self):
        for library in OPTIONS.shared:
            text = subprocess.run(["readelf", "-d", library], capture_output=True, text=True, check=True).stdout
            name = Path(library).name.split(".so")[0]
            self.assertIn(f"[{name}.so.{OPTIONS.version.split('.')[0]}]", text)

    def test_a_stray_symbol_is_noticed(self):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder, "stray.cpp")
            source.write_text("int stray() { return 1; }\nnamespace gnomon { struct Impl { int f(); }; int Impl::f() { return 1; } }\n")
            library = Path(folder, "libstray.so")
            subprocess.run([OPTIONS.cxx, "-shared", "-fPIC", source, "-o", library], check=True)
            found = faults(str(library), "GNOMON_0.1")
            self.assertIn("stray() is visible", found)
            self.assertIn("gnomon::Impl::f() is visible", found)
            self.assertIn("stray() has version none", found)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    for one in ("--nm", "--cxx", "--version"):
        parser.add_argument(one, required=True)
    for several in ("--shared", "--static", "--users"):
        parser.add_argument(several, nargs="+", required=True)
    parser.parse_args(namespace=OPTIONS)
    unittest.main(argv=sys.argv[:1])
