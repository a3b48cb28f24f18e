#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the program with little memory and with no further threads, and says in a table how each run ended.

usage: starve.py PROGRAM [--from MB] [--to MB] [--step MB]

Memory is what `ulimit -v` bounds, or `-d` in two rows; threads what `ulimit -u` does. A run may succeed, or fail with status 1
and a last line of its own. Anything else (a signal, another status, no such line) is a fault, and then the exit status is 1.
"""

import argparse
import os
import pwd
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

SMALL = ["--size", "64x64"]
COMMANDS = {
    "render": ["render", "planes", *SMALL, "-o", "a.png"],
    "compare": ["compare", "planes", *SMALL, "--repetitions", "1", "--warmup", "0", "--samples", "4", "--no-cache"],
    "plan": ["plan", "planes", *SMALL],
    "truth": ["render", "planes", *SMALL, "--truth", "area", "--mask", "--samples", "16", "--no-cache", "-o", "t.png"],
}
FAULT = "FAULT"


def run(program: Path, command: list, folder: Path, limit, user=None) -> str:
    """How the run ended: "ok", "line" (status 1 and a line) or what was wrong."""
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder), "HOME": str(folder)}

    def prepare():
        resource.setrlimit(limit[0], (limit[1], limit[1]))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if user is not None:
            os.setgid(user.pw_gid)
            os.setuid(user.pw_uid)

    try:
        ran = subprocess.run([program, *command], cwd=folder, env=environment, preexec_fn=prepare, capture_output=True,
                             timeout=120, check=False)
    except subprocess.TimeoutExpired:
        return f"{FAULT} (never ends)"
    lines = ran.stderr.decode(errors="replace").splitlines()
    if ran.returncode == 0:
        return "ok"
    # The last line is ours and no notice; what a driver says of itself comes before.
    if ran.returncode == 1 and lines and lines[-1].startswith("gnomon: ") and "no GPU found" not in lines[-1]:
        return "line"
    how = f"signal {-ran.returncode}" if ran.returncode < 0 else f"status {ran.returncode}"
    return f"{FAULT} ({how})"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda name: Path(name).resolve())
    parser.add_argument("--from", type=int, default=200, dest="first")
    parser.add_argument("--to", type=int, default=980)
    parser.add_argument("--step", type=int, default=20)
    asked = parser.parse_args()
    faults = 0
    runs = 0

    def show(what: str, outcomes: list):
        nonlocal faults, runs
        print(f"{what:>10}  " + "  ".join(f"{outcome:<18}" for outcome in outcomes), flush=True)
        faults += sum(outcome.startswith(FAULT) for outcome in outcomes)
        runs += len(outcomes)

    def rows(limits: list, user=None):
        """In a folder of their own: what one user wrote there, another may not replace."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            folder.chmod(0o777)
            for what, limit in limits:
                show(what, [run(asked.program, command, folder, limit, user) for command in COMMANDS.values()])

    print(f"{'limit':>10}  " + "  ".join(f"{command:<18}" for command in COMMANDS))
    rows([(f"{size} MB", (resource.RLIMIT_AS, size * 1024 * 1024)) for size in range(asked.first, asked.to + 1, asked.step)])
    rows([(f"-d {size} MB", (resource.RLIMIT_DATA, size * 1024 * 1024)) for size in (20, 60)])
    # The limit of threads is not held against root.
    user = pwd.getpwnam("nobody") if os.getuid() == 0 else None
    rows([(f"-u {threads}", (resource.RLIMIT_NPROC, threads)) for threads in range(1, 7)], user)
    print(f"{runs} runs, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
