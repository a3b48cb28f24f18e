#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `.ci/run` does besides what it always does: each item when the change touches what it tests, and every fifth time.

usage: ci_turn.py due           the items of this run, a line each: "NAME built WHY" if it needs build/, else "NAME alone WHY"
       ci_turn.py alone         every item that `make test` has not; `make check-all` runs them after it
       ci_turn.py labels        the labels of tests in build/ that items run, as a regular expression
       ci_turn.py run ITEM      runs one, where it is due by a change alone of the files that have changed, if it goes by files;
                                JOBS is the number of its processes
       ci_turn.py passed ITEM...   notes that a run has passed as a whole, with these items

Runs have numbers: one more than that of the last, which ~/.cache/gnomon-build/turns.json keeps together with its commit and
each item's last run. Where that is missing, the number of commits takes its place, and an item's place in the table says
in which of five runs it is due. The change is what has come since the last commit that passed; else since the branch left
origin/main; else the commits of the last two hours.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from check_includes import PROJECT_KINDS, RULES, kind_of, rule_for
from sources import project_root
from tidy import FOLDERS as TIDIED

EVERY = 5
TURN = "it is its turn"
BUILT = "ctest --test-dir build --output-on-failure --no-tests=error -j $JOBS -L "


LIBRARIES = ("core/", "pack/", "c/", "vulkan/", "gl/", "files/", "image/", "scene/", "worlds/", "truth/", "host/", "lab/", "app/")


class Item(NamedTuple):
    command: str
    parts: tuple = ()  # folders of the table of include rules: touched where they are, or what they may include
    paths: tuple = ()  # other paths that touch it, by how they begin
    needs: str = ""      # a program without which it is skipped
    built: bool = False  # a label of tests in build/
    takes_turns: bool = True  # else it may take an hour, and only `make check-all` has it
    suffix: str = ""     # it goes by files of this ending below its paths, which the command has as $FILES; none are all


# Their order parts the runs: each item with the fifth after it.
ITEMS = {
    "browser": Item(BUILT + "browser", paths=("app/pages/", "site/", "tests/page/", "tests/site/", "tools/make_site.py",
                                              "tools/site_pages.py", "tools/doxygen_filter.py", "lab/src/report"), built=True),
    "package": Item(BUILT + "package", paths=("cmake/", "CMakeLists.txt", "packaging/", "tests/package/", "examples/",
                                              "core/include/", "pack/include/", "c/", "vulkan/include/", "vulkan/classics/", "gl/include/"), built=True),
    "fuzz": Item("make -s fuzz JOBS=$JOBS FUZZ_SECONDS=60", parts=("scene/", "image/", "truth/"),
                 paths=("tests/fuzz/", "tools/fuzz.sh", "app/src/preset", "app/src/setting", "app/src/bench_figures")),
    "kit": Item("make -s kit-check BUILT=1", paths=("kit/", "tests/kit/", "shaders/"), built=True),
    "web": Item("make -s playground BUILT=1 JOBS=$JOBS && " + BUILT + "web",
                paths=("web/", "tests/web/", "tests/playground/", "kit/", "pack/src/commands/", "c/include/"), built=True),
    "osg": Item("tools/install_packages.sh --only examples packages.txt && cmake build && cmake --build build -j $JOBS && " + BUILT + "osg",
                paths=("examples/osg/", "gl/"), built=True),
    "roots": Item("make -s package-test JOBS=$JOBS", needs="debootstrap", takes_turns=False),
    "bare": Item("tools/bare_root_test.sh", needs="debootstrap", takes_turns=False),
    # In build/, which `make check-all` has by then.
    "sweeps": Item("GNOMON_SWEEP=all GNOMON_SOAK_FRAMES=100000 ctest --test-dir build --output-on-failure --no-tests=error"
                   " -j $JOBS -R '^(faults|memory|vulkan.long)'", takes_turns=False),
    "long": Item(BUILT + "long -E '^view'", paths=("tests/stages.txt",), built=True),
    "headers": Item('make -s headers JOBS=$JOBS HEADERS="$FILES"', paths=LIBRARIES, suffix=".h"),
    "tidy": Item('make -s tidy JOBS=$JOBS TIDY_FOLDERS="$FILES"', paths=tuple(f"{folder}/" for folder in TIDIED), suffix=".cpp"),
    "window": Item(BUILT + "long -R '^view'", paths=("host/window/", "app/src/view/", "tests/view/"), built=True),
}
TURNS = {name: item for name, item in ITEMS.items() if item.takes_turns}
PUBLIC_KIND = {"core": "core-public", "pack": "pack-public", "c": "c-public", "vulkan": "vulkan-public", "gl": "gl-public"}


def git(*arguments: str) -> str:
    """What git prints; nothing where it fails."""
    return subprocess.run(["git", *arguments], cwd=project_root(), capture_output=True, text=True, check=False).stdout.strip()


def kinds_that_touch(part: str) -> set[str]:
    """The kinds that a folder of the rules includes, itself or through others."""
    kinds, left = set(), [part]
    while left:
        for kind in rule_for(left.pop())[1] - kinds:
            kinds.add(kind)
            left += [rule[0] for rule in RULES if kind_of(rule[0] + "x.h", PROJECT_KINDS) == kind]
    return kinds


def touched_by(path: str, item: Item) -> bool:
    kind = kind_of(path, PROJECT_KINDS)
    folder = path.split("/")[0]
    if kind == "private": # is part of what the folder's headers promise
        kind = PUBLIC_KIND.get(folder, folder)
    if item.suffix and not path.endswith(item.suffix):
        return False
    return path.startswith((*item.paths, *item.parts)) or any(kind in kinds_that_touch(part) for part in item.parts)


def changed_since(commit: str) -> list[str]:
    head = git("rev-parse", "HEAD")
    since = commit if commit and git("merge-base", commit, "HEAD") == commit else git("merge-base", "origin/main", "HEAD")
    if since in ("", head) and commit != head:
        began = int(git("log", "-1", "--format=%ct") or 0) - 2 * 3600
        commits = git("log", f"--since={began}", "--format=%H").split()
        since = commits[-1] + "~1" if commits and git("rev-parse", "-q", "--verify", commits[-1] + "~1") else ""
    return git("diff", "--name-only", since, "HEAD").splitlines() if since else []


def state_file() -> Path:
    return Path.home() / ".cache/gnomon-build/turns.json"


def state() -> dict:
    try:
        kept = json.loads(state_file().read_text(encoding="utf-8"))
        return {"run": int(kept["run"]), "commit": str(kept["commit"]), "last": dict(kept["last"])}
    except (OSError, ValueError, KeyError, TypeError):
        return {"run": int(git("rev-list", "--count", "HEAD") or 0), "commit": "", "last": {}}


def due(kept: dict, changed: list[str]) -> dict[str, str]:
    """The items of the next run, and why each."""
    found, number = {}, kept["run"] + 1
    for place, (name, item) in enumerate(TURNS.items()):
        last = kept["last"].get(name)
        touching = next((path for path in changed if touched_by(path, item)), None)
        if number - last >= EVERY if last is not None else (number + place) % EVERY == 0:
            found[name] = TURN
        elif touching:
            found[name] = f"{touching} has changed"
    return found


def files_of(name: str) -> list[str] | None:
    """Those that an item is about in this run; None: all."""
    kept = state()
    changed = changed_since(kept["commit"])
    if not ITEMS[name].suffix or due(kept, changed).get(name, TURN) == TURN:
        return None
    return [path for path in changed if touched_by(path, ITEMS[name]) and (project_root() / path).is_file()]


def run(name: str) -> int:
    item = ITEMS[name]
    needed = item.needs
    if needed and subprocess.run(["sh", "-c", f"command -v {needed}"], capture_output=True, check=False).returncode != 0:
        print(f"{name}: there is no {needed}\n0 passed, 0 failed, 1 skipped")
        return 0
    files = files_of(name)
    if files == []: # those that have changed are gone
        return 0
    jobs = os.environ.get("JOBS", str(os.cpu_count()))
    return subprocess.run(["bash", "-euo", "pipefail", "-c", item.command], cwd=project_root(), check=False,
                          env={**os.environ, "JOBS": jobs, "FILES": " ".join(files or [])}).returncode


def note(passed: list[str]) -> None:
    kept = state()
    # An item that goes by files was done as a whole in its turn alone.
    passed = [name for name in passed if files_of(name) is None]
    number = kept["run"] + 1
    # An item that has never run keeps the place it has without this file.
    first = {name: number - (number + place) % EVERY for place, name in enumerate(TURNS)}
    last = {name: number if name in passed else kept["last"].get(name, first[name]) for name in TURNS}
    state_file().parent.mkdir(parents=True, exist_ok=True)
    whole = state_file().with_suffix(f".{os.getpid()}")
    whole.write_text(json.dumps({"run": number, "commit": git("rev-parse", "HEAD"), "last": last}), encoding="utf-8")
    whole.rename(state_file())


def main() -> int:
    match sys.argv[1:]:
        case ["due"]:
            kept = state()
            for name, why in due(kept, changed_since(kept["commit"])).items():
                print(name, "built" if ITEMS[name].built else "alone", why)
        case ["alone"]:
            print("\n".join(name for name, item in ITEMS.items() if not item.built))
        case ["labels"]:
            print("|".join(name for name, item in ITEMS.items() if item.built))
        case ["run", name] if name in ITEMS:
            return run(name)
        case ["passed", *names] if set(names) <= ITEMS.keys():
            note(names)
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
