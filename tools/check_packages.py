#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does packages.txt bring everything that is used? Nothing may be used only because this machine happens to have it.

usage: check_packages.py [--list FILE] [--programs DIR] [BUILD...]

Looked at are the headers that compiled sources included (ninja's log of dependencies in the folders BUILD) and the libraries
that are linked there, the programs and files that CMake found for us, the programs that scripts call, and the modules that
Python scripts import. Each has to belong to a package of a bare Debian root (tools/bare_root.sh), or to one that comes with the
sections which its user may use: SECTIONS. What is not here cannot be used either, so the check says the same on every
machine that passes the tests.

--programs DIR fills DIR with links to all programs that packages.txt brings. With PATH=DIR nothing else is found by name, so
what runs then calls no other program, however it does so. Exit status 1 when something is missing, 77 where there is no dpkg.
"""

import argparse
import ast
import os
import re
import subprocess
import sys
from pathlib import Path

from debian import Packages
from sources import project_files, project_root

LIBRARY = ("library",)
PROGRAM = (*LIBRARY, "program")
TESTS = (*PROGRAM, "to run without a GPU", "tests and benchmarks")
CHECKS = (*TESTS, "checks (.ci/run)")
SITE = (*CHECKS, "site")
KIT = (*CHECKS, "kit", "compilers of the kit")
EXAMPLES = (*TESTS, "examples")
WEB = (*KIT, "web")
# (beginning of a path, which sections its files may use); the longest counts. Objects lie in the folders of their targets.
SECTIONS = [("", CHECKS), ("cmake/", PROGRAM), ("core/", LIBRARY), ("pack/", LIBRARY), ("vulkan/", LIBRARY), ("shaders/", LIBRARY),
            ("gl/", TESTS), ("examples/", LIBRARY), ("examples/gl_host/", TESTS), ("examples/osg/", EXAMPLES),
            *((f"{name}/", PROGRAM) for name in ("files", "image", "scene", "worlds", "truth", "host", "lab", "app")),
            ("tests/", TESTS), ("tests/fuzz/", CHECKS), ("tests/site/", SITE), ("kit/", KIT), ("tests/kit/", KIT), ("web/", WEB), ("tests/web/", KIT),
            ("tools/make_", SITE), ("tools/site_pages.py", SITE)]
FOLDERS = ("/usr/bin", "/usr/sbin", "/bin", "/sbin", "/usr/games")
WORD = r"([A-Za-z][\w.+-]*)(?=[\s)\"';|&]|$)"
# A word where a shell expects a command: at the beginning, behind what joins commands, or behind one that runs another.
COMMAND = re.compile(r"(?:^|[|;&({!]|\b(?:then|do|else|elif|if|while|until) )[ \t@]*(?:\w+=\S* +)*"
                     r"(?:(?:exec|env|nice|sudo|xargs|command)(?: -\w+)* +)*" + WORD, re.MULTILINE)
CALLED_BY_C = re.compile(r"\b(?:execlp|execvp|popen|system)\(\"([^\"\n]*)")
INSTEAD = {"sudo", "chromium-browser", "google-chrome"} # each stands in for what is missing, and none is missed
CALLS = {"run", "Popen", "call", "check_call", "check_output", "which"}


def sections_of(path: str) -> tuple[str, ...]:
    return max((row for row in SECTIONS if path.startswith(row[0])), key=lambda row: len(row[0]))[1]


def listed(file: Path) -> dict[str, list[str]]:
    """The packages of each section."""
    found: dict[str, list[str]] = {}
    section = ""
    for line in file.read_text(encoding="utf-8").splitlines():
        if line.startswith("= "):
            section = line[2:]
        elif name := line.split("#")[0].strip():
            found.setdefault(section, []).append(name)
    return found


def words_of(node) -> list[str]:
    """The strings that stand in a tuple or list, or a string by itself."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    return [word for one in node.elts for word in words_of(one)] if isinstance(node, (ast.Tuple, ast.List)) else []


def called_by_python(text: str) -> set[str]:
    tree, found, names = ast.parse(text), set(), {}
    for node in ast.walk(tree):
        if isinstance(node, (ast.For, ast.comprehension)) and isinstance(node.target, ast.Name):
            names.setdefault(node.target.id, []).append(node.iter)
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            names.setdefault(node.targets[0].id, []).append(node.value)
    for node in ast.walk(tree):
        name = getattr(node.func, "attr", getattr(node.func, "id", None)) if isinstance(node, ast.Call) else None
        if name not in CALLS or not node.args:
            continue
        left, seen = [node.args[0]], set()
        while left: # names stand for what is assigned to them or what they go through
            one = left.pop()
            if isinstance(one, ast.Name) and one.id not in seen:
                seen.add(one.id)
                left += names.get(one.id, [])
            elif isinstance(one, ast.BinOp):
                left.append(one.left)
            else:
                words = words_of(one)
                found |= set(words if name == "which" or seen else words[:1])
    return {word for text in found for word in COMMAND.findall(text)}


def imported_by_python(text: str) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {one.name.split(".")[0] for one in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.add(node.module.split(".")[0])
    return found - set(sys.stdlib_module_names)


def called_by_shell(text: str) -> set[str]:
    text = re.sub(r"(?:^|\s)#.*", "", text.replace("\\\n", " "))
    text = re.sub(r"(?<=\w)'(?=\w)", "", text) # an apostrophe
    found = set(COMMAND.findall(re.sub(r"'[^']*'", "''", text))) # programs of awk, sed and other roots are in quotes
    return found - {"time"} # bash's own word; where there is such a program, too, it is not this one


def called_by(file: Path, root: Path) -> set[str]:
    text = (root / file).read_text(encoding="utf-8", errors="replace")
    if file.suffix == ".py":
        return called_by_python(text)
    if file.suffix == ".sh" or text.startswith(("#!/bin/sh", "#!/usr/bin/env bash")):
        return called_by_shell(text)
    if file.name == "Makefile":
        recipes = re.sub(r"^[^\t\n].*", "", text.replace("\\\n", " "), flags=re.MULTILINE)
        return called_by_shell(recipes.replace("$$", "$"))
    if file.suffix == ".cpp":
        return {word for line in CALLED_BY_C.findall(text) for word in COMMAND.findall(line)}
    if file.suffix == ".cmake" or file.name == "CMakeLists.txt":
        return set(re.findall(r"\b(?:COMMAND|PROGRAM) " + WORD, text))
    return set()


def used_by_scripts(root: Path):
    """(file, who uses it) for programs and modules that this machine has."""
    program = root / "app/src/program.cpp"
    own = set(re.findall(r'Subcommand\{"(\w+)"', program.read_text(encoding="utf-8"))) if program.is_file() else set()
    for file in project_files(root):
        if file.suffix in (".py", ".sh", ".cpp", ".cmake", "") or file.name in ("Makefile", "CMakeLists.txt"):
            for word in called_by(file, root) - own - INSTEAD:
                yield from ((f"{folder}/{word}", file.as_posix()) for folder in FOLDERS if os.access(f"{folder}/{word}", os.X_OK))
        if file.suffix == ".py":
            for name in imported_by_python((root / file).read_text(encoding="utf-8")):
                for place in (f"/usr/lib/python3/dist-packages/{name}/__init__.py", f"/usr/lib/python3/dist-packages/{name}.py"):
                    if os.path.exists(place):
                        yield place, file.as_posix()


def used_by_build(build: Path):
    """(file, who uses it) for headers, libraries and what CMake found for us."""
    deps = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    target = ""
    for line in deps.splitlines():
        if line.startswith("    /") and target:
            yield line.strip(), target
        elif ": #deps" in line:
            target = "" if line.endswith("(STALE)") else line.split(":")[0]
    user = ""
    for line in (build / "build.ninja").read_text(encoding="utf-8").splitlines():
        if linked := re.match(r"build \S+: CXX_[A-Z_]+_LINKER__(\w+)_\w* .*?(\S+CMakeFiles/\1\.dir)/", line):
            user = linked[2]
        elif line.startswith("  LINK_LIBRARIES ="):
            for word in line.split()[2:]:
                if word.startswith("-l"):
                    word = subprocess.run(["g++", f"-print-file-name=lib{word[2:]}.so"], capture_output=True, text=True, check=True).stdout.strip()
                if word.startswith("/"):
                    yield os.path.normpath(word), user
    for name, path in re.findall(r"^(\w+):FILEPATH=(/.*)", (build / "CMakeCache.txt").read_text(encoding="utf-8"), re.MULTILINE):
        if os.path.isfile(path) and (name.startswith("GNOMON_") or os.access(path, os.X_OK) and ".so" not in path):
            yield path, "tests/site/" if name == "GNOMON_DOXYGEN" else "tests/fuzz/"


def compiler_of(build: Path) -> str:
    return re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)|\Z", (build / "CMakeCache.txt").read_text(encoding="utf-8"), re.MULTILINE)[1] or ""


def link_programs(packages: Packages, allowed: set[str], folder: Path) -> int:
    folder.mkdir(parents=True, exist_ok=True)
    for link in folder.iterdir():
        link.unlink()
    for place in FOLDERS:
        for program in Path(place).iterdir() if Path(place).is_dir() else ():
            if packages.owners_of(program) & allowed and not os.path.lexists(folder / program.name):
                (folder / program.name).symlink_to(program)
    return len(list(folder.iterdir()))


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("builds", nargs="*", type=Path, metavar="BUILD")
    parser.add_argument("--list", type=Path)
    parser.add_argument("--root", type=Path, default=project_root())
    parser.add_argument("--programs", type=Path)
    options = parser.parse_args()
    root = options.root.resolve()
    try:
        packages = Packages()
    except OSError:
        print("packages: this is not a Debian system, so nobody knows here what belongs to which package")
        return 77
    wanted = listed(options.list or root / "packages.txt")
    bare = re.search(r"--include=(\S+)", (project_root() / "tools/bare_root.sh").read_text(encoding="utf-8"))[1].split(",")
    allowed = {sections: packages.closure([*bare, *(name for section in sections for name in wanted.get(section, []))])
               for sections in (LIBRARY, PROGRAM, TESTS, CHECKS, SITE, KIT, EXAMPLES)}
    if options.programs:
        print(f"packages: {link_programs(packages, allowed[SITE] | allowed[KIT], options.programs)} programs in {options.programs}")
    uses = list(used_by_scripts(root))
    own: set[str] = set() # the compiler's own, whose headers all sources include
    for build in options.builds:
        uses += used_by_build(build)
        own |= packages.closure(packages.owners_of(compiler_of(build)))
    found: dict[tuple[str, tuple[str, ...]], set[str]] = {}
    for file, user in set(uses):
        owners = packages.owners_of(file)
        sections = sections_of(user)
        if owners and not owners & (allowed[sections] | own):
            found.setdefault((" or ".join(sorted(owners)), sections), set()).add(f"{user} uses {file}")
    for (owner, sections), users in sorted(found.items()):
        some = sorted(users)
        print(f"packages: {owner} comes with none of the sections {', '.join(sections)} of packages.txt, though {some[0]}"
              + (f", and {len(some) - 1} uses more" if len(some) > 1 else ""), file=sys.stderr)
    if not uses:
        print("packages: found nothing that is used", file=sys.stderr)
        return 1
    print(f"packages: {len({file for file, _ in uses})} files and programs are used, {len(found)} packages are missing")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
