#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the documents' pictures by the commands that the documents name.

usage: draw_doc_pictures.py [--check] [--only TEXT] [--jobs N] GNOMON FOLDER

Every command `build/gnomon render ... -o docs/images/NAME` or `build/gnomon plan ... --draw docs/images/NAME` of a .md
file, in a code block or between backticks, is run with the program GNOMON and writes FOLDER/NAME; docs/images itself may
be FOLDER. Where a document shows images/NAME.svg and names `build/gnomon compare ... --sweep ... --report out/NAME`, the
picture is what tools/plot.py draws of the report's result. --only takes the pictures whose names hold TEXT, --jobs draws N at a time (default 1).

--check then compares each with docs/images, byte for byte, and says which differ and by how much. Pictures are those of
llvmpipe: another driver, or another version of it, may round otherwise. Plots are those of Debian's matplotlib.

Exit status 1 when a command fails, when two commands draw one picture in different ways, when a picture is drawn that no
document shows, or when --check finds a difference. Pictures for which no document names a command are listed at the end.
"""

import argparse
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sources import project_files, project_root

COMMAND = re.compile(r"build/gnomon (?:render [^`\n]*-o|plan [^`\n]*--draw) docs/images/[^`\s]+")
PLOTTED = re.compile(r"build/gnomon compare [^`\n]*--sweep [^`\n]*--report out/[\w-]+$", re.MULTILINE)
SHOWN = re.compile(r"images/([\w.-]+\.(?:png|exr|svg))")
TARGET = {"render": "-o", "plan": "--draw"}  # the option that names the picture
IMAGES = Path("docs/images")


def documents(root: Path) -> list[tuple[Path, str]]:
    return [(file, (root / file).read_text(encoding="utf-8")) for file in project_files(root) if file.suffix == ".md"]


def commands_of(texts: list[tuple[Path, str]]) -> tuple[dict[str, list[str]], list[str]]:
    """The arguments after the program for each picture, -o or --draw last, and what is wrong with the commands."""
    commands: dict[str, list[str]] = {}
    faults = []
    for file, text in texts:
        for line in COMMAND.findall(text):
            try:
                words = shlex.split(line)
            except ValueError as error:
                faults.append(f"{file}: {error}: {line}")
                continue
            option = TARGET[words[1]]
            at = words.index(option)
            name = Path(words[at + 1]).name
            if words[at + 1] != (IMAGES / name).as_posix() or at + 2 != len(words):
                faults.append(f"{file}: {option} {IMAGES.as_posix()}/NAME is not its end: {line}")
                continue
            arguments = words[1:at + 1]
            if commands.setdefault(name, arguments) != arguments:
                faults.append(f"{file}: another command draws {name} already: {shlex.join(commands[name])}")
    return commands, faults


def plots_of(texts: list[tuple[Path, str]], shown: set[str]) -> dict[str, list[str]]:
    """The arguments after the program for each plot that a document shows, --report last."""
    lines = [shlex.split(line) for _, text in texts for line in PLOTTED.findall(text)]
    plots = {Path(words[-1]).name + ".svg": words[1:-1] for words in lines}
    return {name: arguments for name, arguments in plots.items() if name in shown}


def draw(gnomon: Path, root: Path, folder: Path, name: str, arguments: list[str]) -> str | None:
    """Draws one picture; what went wrong, or None."""
    with tempfile.TemporaryDirectory() as kept:
        report = Path(kept) / "report"
        target = report if arguments[-1] == "--report" else folder / name
        run = subprocess.run([gnomon, *arguments, target], cwd=root, capture_output=True, text=True, check=False)
        if run.returncode == 0 and target == report:
            run = subprocess.run([root / "tools/plot.py", report / "result.json", folder / name], capture_output=True, text=True, check=False)
        if run.returncode == 0:
            return None
    # The program's own sentence comes last, after what it says of the device.
    said = run.stderr.strip().splitlines()[-1:] or [f"exit status {run.returncode}"]
    return f"{name}: {said[0]} (gnomon {shlex.join(arguments)})"


def difference(gnomon: Path, drawn: Path, kept: Path) -> str | None:
    """How a drawn picture differs from the one that is kept, or None."""
    if not kept.is_file():
        return f"{kept.name}: not in {IMAGES.as_posix()}"
    if drawn.read_bytes() == kept.read_bytes():
        return None
    if drawn.suffix == ".svg":
        return f"{kept.name}: differs"
    run = subprocess.run([gnomon, "metrics", drawn, kept], capture_output=True, text=True, check=False)
    lines = (run.stdout if run.returncode == 0 else run.stderr).strip().splitlines()
    return f"{kept.name}: differs: {lines[-1] if lines else 'metrics said nothing'}"


def main() -> int:
    parser = argparse.ArgumentParser(description="Draws the documents' pictures by the commands that the documents name.")
    parser.add_argument("--check", action="store_true", help="say which pictures differ from docs/images")
    parser.add_argument("--only", default="", metavar="TEXT", help="pictures whose names hold TEXT")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="how many at a time (1)")
    parser.add_argument("gnomon", type=Path, help="the program")
    parser.add_argument("folder", type=Path, help="where the pictures go")
    options = parser.parse_args()
    root = project_root()
    gnomon = options.gnomon.resolve()
    folder = options.folder.resolve()
    if not gnomon.is_file():
        parser.error(f"{options.gnomon} is not a file")
    if options.jobs < 1:
        parser.error("--jobs is 1 or more")
    if options.check and folder == (root / IMAGES).resolve():
        parser.error(f"--check would compare {IMAGES.as_posix()} with itself; give another folder")

    texts = documents(root)
    commands, faults = commands_of(texts)
    shown = {name for _, text in texts for name in SHOWN.findall(re.sub(r"(?:-o|--draw) docs/images/\S+", "", text))}
    commands |= plots_of(texts, shown)
    faults += [f"{name}: drawn, but no document shows it" for name in sorted(commands.keys() - shown)]
    wanted = sorted(name for name in commands if options.only in name)
    if not wanted:
        faults.append("no document names a command for such a picture")

    folder.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda name: draw(gnomon, root, folder, name, commands[name]), wanted))
    faults += [result for result in results if result]
    if options.check:
        drawn = [name for name, result in zip(wanted, results) if result is None]
        found = (difference(gnomon, folder / name, root / IMAGES / name) for name in drawn)
        faults += [fault for fault in found if fault]

    for fault in faults:
        print(fault, file=sys.stderr)
    kept = {file.name for file in (root / IMAGES).iterdir()}
    for name in sorted(kept | shown):
        if name.endswith(".svg") and name not in commands:
            continue  # drawn by hand
        if name not in commands:
            print(f"notice: {name}: no document names the command that draws it")
        if name not in shown:
            print(f"notice: {name}: no document shows it")
    print(f"pictures: {len(wanted)} drawn, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
