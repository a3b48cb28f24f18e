#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs units.mjs, and the compiler over the playground's sources. Without Node.js or npm's packages nothing is tested, which is said; exit status 77.

usage: test_units.py ROOT
"""

import shutil
import subprocess
import sys
from pathlib import Path


def main() -> int:
    root = Path(sys.argv[1]).resolve()
    tools = root / "web/playground/node_modules/.bin"
    if not shutil.which("node") or not (tools / "tsc").exists():
        print("SKIPPED: web/playground/node_modules is not there, so the playground's parts were not tested; run `make playground`", file=sys.stderr)
        return 77
    for command in ([tools / "tsc", "-p", root / "web/playground"], ["node", Path(__file__).with_name("units.mjs"), root]):
        if subprocess.run(command, check=False).returncode != 0:
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
