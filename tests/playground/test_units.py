#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs units.mjs. Without Node.js or npm's packages nothing is tested, which is said; exit status 77.

usage: test_units.py ROOT
"""

import shutil
import subprocess
import sys
from pathlib import Path


def main() -> int:
    root = Path(sys.argv[1]).resolve()
    tools = root / "build/playground_npm/node_modules/.bin"
    if not shutil.which("node") or not (tools / "tsc").exists():
        print("SKIPPED: build/playground_npm is not there, so the playground's parts were not tested; run `make playground`", file=sys.stderr)
        return 77
    return subprocess.run(["node", Path(__file__).with_name("units.mjs"), root], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
