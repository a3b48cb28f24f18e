# SPDX-License-Identifier: Apache-2.0
"""The npm packages of kit/package-lock.json, and the scripts that use them, in a folder of the build."""

import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
FILES = ("package.json", "package-lock.json", "to_wgsl.mjs", "check_wgsl.mjs")


def ready(build: Path, checking: bool) -> Path:
    """Installs what is missing. `checking`: with Dawn, which is 130 MB. Throws RuntimeError where npm cannot."""
    folder = build.resolve() / "kit_npm"
    lock = (HERE / "package-lock.json").read_bytes()
    wanted = "webgpu" if checking else "naga-wasm"
    kept = folder / "package-lock.json"
    is_there = kept.is_file() and kept.read_bytes() == lock and (folder / "node_modules" / wanted).is_dir()
    folder.mkdir(parents=True, exist_ok=True)
    for name in FILES:
        shutil.copyfile(HERE / name, folder / name)
    if not is_there:
        command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", *(() if checking else ("--omit=dev",))]
        try:
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        except FileNotFoundError as error:
            raise RuntimeError("WGSL is made by npm packages, and there is no npm; install it (Debian: npm), or make the kit --without wgsl") from error
        if done.returncode != 0:
            raise RuntimeError(f"npm could not install {wanted}: {done.stderr.strip()}")
    return folder
