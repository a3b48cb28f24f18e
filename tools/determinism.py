#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The same command gives the same bits: under load, on one core and on two, and in a locale with a decimal comma.

usage: determinism.py [--runs N] [--load N] [--only NAMES] [--locales C] GNOMON

Runs each of ten commands N times (30), by turns on one core and on two and in the locales C and de_DE, while --load processes
(as many as there are cores) keep the machine busy. What a command writes has to be equal in all runs, byte for byte, except the times
that JSON tells. Such a locale is made by localedef in a temporary folder; where that cannot be, it is told as skipped. Prints a
line for each command. Exit status 1 when two runs differ, 2 when a command fails.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SMALL = ["--size", "96x54", "--map-size", "256"]
LOCALE = "de_DE.UTF-8"  # 0,5
# Name to arguments; {out} is a file of the run's own. Truths are never from a cache, so that every run traces.
COMMANDS = {
    "picture": ["render", "planes", *SMALL, "--filter", "pcf", "--partition", "cascades", "--out", "{out}.png"],
    "evsm": ["render", "spotlit", *SMALL, "--filter", "evsm", "--mask", "--out", "{out}.exr"],
    "sdsm": ["render", "canopies", *SMALL, "--filter", "vsm", "--partition", "sdsm", "--mask", "--out", "{out}.exr"],
    "lvsm": ["render", "planes", *SMALL, "--filter", "lvsm", "--fit", "lispsm", "--mask", "--out", "{out}.exr"],
    "frames": ["render", "spotlit", *SMALL, "--filter", "msm", "--frames", "0-3", "--out", "{out}.png"],
    "truth": ["render", "canopies", "--size", "96x54", "--truth", "area", "--samples", "32", "--no-cache", "--mask", "--out", "{out}.exr"],
    "compare": ["compare", "planes", *SMALL, "--techniques", "hard,pcf,vsm,esm,evsm,msm", "--samples", "16", "--no-cache",
                "--warmup", "0", "--repetitions", "1", "--json", "-"],
    "plan": ["plan", "rts", "--size", "96x54", "--partition", "cascades", "--frames", "0-3", "--json", "-"],
    "list": ["list", "--json", "-"],
    "gpus": ["gpus", "--json", "-"],
    "metrics": ["metrics", "{given}.png", "{given2}.png", "--json", "-"],
}
TIMES = re.compile(r"(^|_)(ms|seconds|per_second)$|^(frame_ratio|share)$")


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(inside) for key, inside in value.items() if not TIMES.search(key)}
    return [without_times(inside) for inside in value] if isinstance(value, list) else value


def make_locale(folder: Path) -> bool:
    """Into `folder`, as LOCPATH wants it; needs no rights."""
    if shutil.which("localedef") is None:
        return False
    done = subprocess.run(["localedef", "-i", LOCALE.split(".")[0], "-f", "UTF-8", str(folder / LOCALE)], capture_output=True, check=False)
    # It warns of harmless things by its status, so what counts is whether the locale works.
    asks = "import locale; locale.setlocale(locale.LC_ALL, ''); print(locale.localeconv()['decimal_point'])"
    said = subprocess.run([sys.executable, "-c", asks], env=environment(LOCALE, folder), capture_output=True, text=True, check=False)
    return done.returncode in (0, 1) and said.stdout.strip() == ","


def environment(locale: str, folder: Path) -> dict[str, str]:
    return os.environ | {"LC_ALL": locale, "LANG": locale, "LOCPATH": str(folder)}


def result_of(gnomon: str, arguments: list[str], folder: Path, cores: set[int], env: dict[str, str]) -> str:
    """A digest of all that a run wrote."""
    folder.mkdir()
    names = {"out": str(folder / "out"), "given": str(folder.parent / "given"), "given2": str(folder.parent / "given2")}
    line = [gnomon, *(argument.format(**names) for argument in arguments)]
    done = subprocess.run(line, env=env, capture_output=True, check=False, preexec_fn=lambda: os.sched_setaffinity(0, cores))
    if done.returncode != 0:
        print(f"{' '.join(line)}: status {done.returncode}: {done.stderr.decode().strip()}", file=sys.stderr)
        raise SystemExit(2)
    digest = hashlib.sha256()
    if "--json" in arguments:
        digest.update(json.dumps(without_times(json.loads(done.stdout))).encode())
    for file in sorted(folder.rglob("*")):
        if file.is_file():
            digest.update(file.relative_to(folder).as_posix().encode() + b"\0" + file.read_bytes())
    shutil.rmtree(folder)
    return digest.hexdigest()


def ways(cores: list[int], locales: list[str]):
    """All of them by turns; the first two differ in both."""
    few, many = set(cores[:1]), set(cores)
    while True:
        for on, locale in ((few, locales[0]), (many, locales[-1]), (few, locales[-1]), (many, locales[0])):
            yield on, locale


def examine(gnomon: str, name: str, runs: int, folder: Path, cores: list[int], locales: list[str]) -> bool:
    start, found = time.monotonic(), {}
    for run, (on, locale) in zip(range(runs), ways(cores, locales)):
        digest = result_of(gnomon, COMMANDS[name], folder / f"run{run}", on, environment(locale, folder))
        found.setdefault(digest, []).append(f"{len(on)} core{'s' * (len(on) > 1)}, {locale}")
    seconds = time.monotonic() - start
    if len(found) == 1:
        print(f"{name}: {runs} runs, all equal, {seconds:.1f} s", flush=True)
        return True
    print(f"{name}: {len(found)} results of {runs} runs, {seconds:.1f} s", flush=True)
    for digest, where in found.items():
        print(f"  {digest[:12]}: {len(where)} times, first with {where[0]}", flush=True)
    return False


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=30)
    parser.add_argument("--load", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", default=",".join(COMMANDS))
    parser.add_argument("--locales", default="C," + LOCALE, help="C alone, or both")
    parser.add_argument("gnomon")
    options = parser.parse_args()
    names = options.only.split(",")
    if options.runs < 2 or not set(names) <= set(COMMANDS):
        parser.error(f"at least two runs, of {', '.join(COMMANDS)}")
    gnomon = str(Path(options.gnomon).resolve())
    cores = sorted(os.sched_getaffinity(0))[:2]
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        locales = ["C"]
        if LOCALE not in options.locales:
            pass
        elif make_locale(folder):
            locales.append(LOCALE)
        else:
            print(f"skipped: localedef makes no {LOCALE} here")
        if len(cores) < 2:
            print("skipped: there is one core only")
        if "metrics" in names:  # the part that it is asked about
            for given, kind in (("given", "hard"), ("given2", "pcf")):
                subprocess.run([gnomon, "render", "planes", *SMALL, "--filter", kind, "--out", str(folder / f"{given}.png")],
                               capture_output=True, check=True)
        load = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(options.load)]
        try:
            equal = [examine(gnomon, name, options.runs, folder, cores, locales) for name in names]
        finally:
            for process in load:
                process.kill()
                process.wait()
    return 0 if all(equal) else 1


if __name__ == "__main__":
    sys.exit(main())
