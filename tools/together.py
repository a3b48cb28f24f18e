#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the program in several processes at once, on one output, one folder of frames, one report and one cache, and looks
whether every file is whole. With --kill some of them are killed on the way, and a last run clears up after them.

usage: together.py PROGRAM [--rounds N] [--processes N] [--kill]
"""

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

SMALL = ["planes", "--size", "16x16"]
COMPARE = ["compare", *SMALL, "--samples", "4", "--repetitions", "1", "--warmup", "0", "--techniques", "hard", "--map-size", "64",
           "--report", "report", "--json=out.json"]
FRAMES = ["render", *SMALL, "--truth", "hard", "--mask", "--frames", "0-3", "-o", "frames"]
PICTURE = ["render", *SMALL, "--truth", "hard", "--mask", "-o", "out.png"]


def require(holds: bool, what: str):
    if not holds:
        raise AssertionError(what)


def check_png(file: Path):
    """Every chunk is there with the checksum that it says."""
    data = file.read_bytes()
    require(data.startswith(b"\x89PNG\r\n\x1a\n"), f"{file}: no PNG")
    at, name = 8, b""
    while at < len(data):
        length, name = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        body = data[at + 4:at + 8 + length]
        require(zlib.crc32(body).to_bytes(4, "big") == data[at + 8 + length:at + 12 + length], f"{file}: torn")
        at += 12 + length
    require(name == b"IEND" and at == len(data), f"{file}: ends early")


def check(folder: Path):
    for file in sorted(folder.rglob("*")):
        require(not file.name.endswith(".tmp"), f"{file}: left behind")
        if file.suffix == ".png":
            check_png(file)
        elif file.suffix == ".json":
            json.loads(file.read_text(encoding="utf-8"))
        elif file.suffix == ".html":
            require(file.read_text(encoding="utf-8").rstrip().endswith("</html>"), f"{file}: torn")
    report = folder / "report"
    listed = json.loads((report / "result.json").read_text(encoding="utf-8"))["report_files"]
    require(sorted(listed) == sorted(file.name for file in report.iterdir()), "the report is not of one piece")
    require(len(list((folder / "frames").iterdir())) == 4, "frames are missing")


def check_cache(program: Path, folder: Path):
    """What is damaged there would be traced again, in silence."""
    ran = subprocess.run([program, *COMPARE[:-3], "--json=-"], cwd=folder, capture_output=True, check=False, timeout=300,
                         env={**os.environ, "XDG_CACHE_HOME": str(folder / "cache")})
    require(ran.returncode == 0, f"after all: status {ran.returncode}")
    require(json.loads(ran.stdout)["truth"]["from_cache"] is True, "the truth in the cache is not whole")


def start(program: Path, command: list, folder: Path) -> subprocess.Popen:
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache")}
    return subprocess.Popen([program, *command], cwd=folder, env=environment, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE)


def round_of(program: Path, folder: Path, processes: int, kill: bool):
    commands = [COMPARE, FRAMES, PICTURE]
    running = [start(program, commands[i % len(commands)], folder) for i in range(processes)]
    killed = set()
    if kill:
        for i in random.sample(range(processes), processes // 2):
            time.sleep(random.uniform(0.0, 0.4))
            running[i].send_signal(signal.SIGKILL)
            killed.add(i)
    for i, process in enumerate(running):
        _, said = process.communicate(timeout=300)
        if i not in killed:
            require(process.returncode == 0, f"status {process.returncode}: {said.decode(errors='replace')}")
    if kill:
        for command in commands:
            require(start(program, command, folder).wait(timeout=300) == 0, f"after the killed: {command}")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda name: Path(name).resolve())
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--processes", type=int, default=8)
    parser.add_argument("--kill", action="store_true")
    asked = parser.parse_args()
    begun = time.monotonic()
    faults = 0
    for number in range(asked.rounds):
        with tempfile.TemporaryDirectory() as name:
            try:
                round_of(asked.program, Path(name), asked.processes, asked.kill)
                check(Path(name))
                check_cache(asked.program, Path(name))
            except AssertionError as fault:
                faults += 1
                print(f"round {number}: {fault}", file=sys.stderr)
    print(f"{asked.rounds} rounds of {asked.processes} processes, {faults} with a fault, {time.monotonic() - begun:.0f} s")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
