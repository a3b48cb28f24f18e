#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the playground: installs what builds it from npm, where that is not there yet, and runs build.mjs.

usage: make.py WRITE_WORLD FOLDER

As build.mjs has them. npm's packages lie in build/playground_npm, at the versions of package-lock.json.
"""

import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
NPM = HERE.parent.parent / "build/playground_npm"
INSTALL = ("npm", "ci", "--no-audit", "--no-fund", "--silent")


def install() -> None:
    lock = NPM / "package-lock.json"
    if (NPM / "node_modules/.bin/esbuild").exists() and lock.is_file() and lock.read_bytes() == (HERE / lock.name).read_bytes():
        return
    NPM.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(HERE / "package.json", NPM / "package.json")
    shutil.copyfile(HERE / lock.name, lock)
    subprocess.run(INSTALL, cwd=NPM, check=True)


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        install()
        subprocess.run(["node", HERE / "build.mjs", *sys.argv[1:]], check=True)
    except FileNotFoundError as error:
        print(f"playground: {error.filename} is missing; install the section kit of packages.txt", file=sys.stderr)
        return 1
    except subprocess.CalledProcessError as error:
        return error.returncode
    return 0


if __name__ == "__main__":
    sys.exit(main())
