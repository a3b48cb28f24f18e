#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is what the documents say still so?

usage: check_docs.py [--write] ROOT [GNOMON]

- links and pictures in every .md file lead to a file;
- a block of README.md is what tests/docs/readme_snippet.cpp has between "README begin" and "README end", and so are one of
  docs/c.md and examples/c_host/c_host.c, and one of docs/webgpu.md and tests/web/example.mjs;
- with the program GNOMON: the table of docs/cli.md is what its declarations make (--write puts it there), and every
  option in a `gnomon` command of a document is one of them;
- what sources name as [drivers: NAME] are the lines of docs/drivers.md, and each line is named;
- docs/gpus.md is what tools/gpu_report.py makes of docs/gpus/*.json (--write puts it there);
- the source that `gnomon list` gives of a technique is the first that its page names.
Exit status 1 when something is not so.
"""

import json
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import gpu_report
from sources import project_files

LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
HABIT = re.compile(r"\[drivers: ([\w-]+)\]")
HABIT_LINE = re.compile(r"^\| `([\w-]+)` \|", re.MULTILINE)
SHADERS_AND_SOURCES = {".cpp", ".h", ".glsl", ".vert", ".frag", ".comp"}
COMMAND = re.compile(r"(?:build/)?gnomon (render|compare|metrics|plan|bench|list)\b([^`\n]*)")
# Options of the command line itself, which are no settings.
PLAIN_OPTIONS = {"set", "preset", "json", "help", "version", "o"}


def broken_links(root: Path) -> list[str]:
    found = []
    for file in project_files(root):
        if file.suffix != ".md":
            continue
        for number, line in enumerate((root / file).read_text(encoding="utf-8").splitlines(), 1):
            for target in LINK.findall(line):
                if "://" not in target and not (root / file.parent / target).exists():
                    found.append(f"{file}:{number}: {target} does not exist")
    return found


# A document, the source that is compiled, and the marks around what both have.
SNIPPETS = [("README.md", "tests/docs/readme_snippet.cpp", "README"), ("docs/c.md", "examples/c_host/c_host.c", "docs/c.md"),
            ("docs/webgpu.md", "tests/web/example.mjs", "docs/webgpu.md")]


def snippet_differences(root: Path) -> list[str]:
    found = []
    for document, source, mark in SNIPPETS:
        text = (root / source).read_text(encoding="utf-8")
        marked = re.search(rf"^[^\n]*{mark} begin[^\n]*\n(.*?)^[^\n]*{mark} end", text, re.DOTALL | re.MULTILINE)
        blocks = re.findall(r"```(?:c|cpp|js)\n(.*?)```", (root / document).read_text(encoding="utf-8"), re.DOTALL)
        if not marked:
            found.append(f'{source}: no lines between "{mark} begin" and "{mark} end"')
        elif not any(block.strip() == textwrap.dedent(marked.group(1)).strip() for block in blocks):
            found.append(f"{document}: no block is what {source} has between its marks")
    return found


def listed_by(gnomon: str) -> dict:
    return json.loads(subprocess.run([gnomon, "list", "--json"], capture_output=True, text=True, check=True).stdout)


def shown(value) -> str:
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, list):
        return ",".join(shown(item) for item in value)
    return str(value)


SCENE_TAKERS = ["render", "view", "compare", "plan", "bench"]


def option_table(settings: dict[str, dict]) -> str:
    """The options as a table, in the order of their declaration. An option of all subcommands that take a scene is for `scenes`."""
    lines = ["| option | default | what it is | for |", "|---|---|---|---|"]
    for key, setting in settings.items():
        name = f"`--{key}`" if setting.get("option", True) else f"`--set {key}=`"
        default = f"`{shown(setting['default'])}`" if setting.get("default") not in (None, "") else ""
        facts = [setting["unit"]] if "unit" in setting else []
        if "min" in setting:
            facts.append(f"{shown(setting['min'])} to {shown(setting['max'])}")
        if "values" in setting:
            facts.append("one of " + " ".join(setting["values"]))
        if "used_with" in setting:
            facts.append("with " + setting["used_with"])
        what = setting["doc"] + (f" ({'; '.join(facts)})" if facts else "")
        takers = setting["subcommands"]
        takers = takers if takers[:len(SCENE_TAKERS)] != SCENE_TAKERS else ["scenes", *takers[len(SCENE_TAKERS):]]
        lines.append(f"| {name} | {default} | {what.replace('|', chr(92) + '|')} | {', '.join(takers)} |")
    return "\n".join(lines) + "\n"


def cli_differences(root: Path, settings: dict[str, dict], write: bool) -> list[str]:
    file = root / "docs/cli.md"
    text = file.read_text(encoding="utf-8")
    match = re.search(r"<!-- options begin[^\n]*-->\n(.*?)<!-- options end -->", text, re.DOTALL)
    if not match:
        return ["docs/cli.md: no table between its marks"]
    wanted = option_table(settings)
    if match.group(1) == wanted:
        return []
    if write:
        file.write_text(text[:match.start(1)] + wanted + text[match.end(1):], encoding="utf-8")
        return []
    rows = set(match.group(1).splitlines()) ^ set(wanted.splitlines())
    return [f"docs/cli.md: the program's options differ (tools/check_docs.py --write . build/gnomon): {row}"
            for row in sorted(rows)] or ["docs/cli.md: the options' order differs"]


AUTHOR = re.compile(r"(?:\b[A-Z]\.[ -]?)+([A-Z]\w+)")  # the surname after initials


def source_differences(root: Path, choices: list[dict]) -> list[str]:
    """Where the first author of a value's source is not that of its page. `auto` is a value of three choices with one page; a value
    without a page of its own names its source in the list alone."""
    found = []
    for choice in choices:
        for value in choice["values"]:
            page = value.get("page") or ""
            if value["name"] == "auto" or not page.startswith("docs/techniques/"):
                continue
            if not (root / page).is_file():
                found.append(f"{page}: is missing, and `gnomon list {value['name']}` names it")
                continue
            _, _, section = (root / page).read_text(encoding="utf-8").partition("\n## Source")
            named = AUTHOR.search(section)
            listed = AUTHOR.search(value["source"])
            if not named or not listed or named.group(1) != listed.group(1):
                found.append(f"{page}: its first source is {named.group(1) if named else 'none'}, "
                             f"and that of `gnomon list {value['name']}` is {value['source']}")
    return found


def unknown_options(root: Path, settings: dict[str, dict]) -> list[str]:
    found = []
    for file in project_files(root):
        if file.suffix != ".md":
            continue
        for number, line in enumerate((root / file).read_text(encoding="utf-8").splitlines(), 1):
            for _, rest in COMMAND.findall(line):
                names = re.findall(r"(?:^|\s)--?([a-z-]+)", rest)
                names += re.findall(r"--set ([a-z.-]+)=", rest)
                found += [f"{file}:{number}: gnomon has no option {name}" for name in names
                          if name not in settings and name not in PLAIN_OPTIONS]
    return found


def gpu_differences(root: Path, write: bool) -> list[str]:
    page = root / "docs/gpus.md"
    files = [str(file) for file in sorted((root / "docs/gpus").glob("*.json"))]
    made = gpu_report.table(files) if files else ""
    if write and files:
        page.write_text(made, encoding="utf-8")
    if files and (not page.is_file() or page.read_text(encoding="utf-8") != made):
        return ["docs/gpus.md: is not what tools/gpu_report.py makes of docs/gpus; tools/check_docs.py --write ROOT makes it so"]
    return []


def habit_differences(root: Path) -> list[str]:
    """Habits of drivers: what sources obey, beside what the page tells."""
    page = root / "docs/drivers.md"
    told = set(HABIT_LINE.findall(page.read_text(encoding="utf-8"))) if page.is_file() else set()
    found, obeyed = [], set()
    for file in project_files(root):
        if file.suffix in SHADERS_AND_SOURCES:
            named = set(HABIT.findall((root / file).read_text(encoding="utf-8")))
            obeyed |= named
            found += [f"{file}: docs/drivers.md has no line {name}" for name in sorted(named - told)]
    return found + [f"docs/drivers.md: no source names {name}" for name in sorted(told - obeyed)]


def main() -> int:
    write = "--write" in sys.argv
    arguments = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    if not arguments:
        sys.exit(__doc__)
    root = Path(arguments[0]).resolve()
    found = broken_links(root) + snippet_differences(root) + gpu_differences(root, write)
    found += habit_differences(root)
    if len(arguments) > 1:
        listed = listed_by(arguments[1])
        settings = {setting["key"]: setting for setting in listed["settings"]}
        found += cli_differences(root, settings, write) + unknown_options(root, settings)
        found += source_differences(root, listed["choices"])
    for line in found:
        print(line, file=sys.stderr)
    print(f"docs: {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
