#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the npm package (docs/webgpu.md): compiles core, pack and c to WebAssembly, the TypeScript, and bundles the kit's WGSL.

usage: make_package.py KIT BUILD OUT

KIT has the kit (`make kit`), BUILD is a folder for what is made on the way, and OUT gets the package. Needs Emscripten, ninja, node and
npm; npm installs TypeScript in BUILD at the version of web/package-lock.json. Prints the weights of the files.
"""

import gzip
import os
import shutil
import subprocess
import sys
from pathlib import Path

import layouts
import shaders

WEB = Path(__file__).resolve().parent.parent
ROOT = WEB.parent
HEADERS = [ROOT / "c/include/gnomon" / name for name in ("gnomon_data.h", "gnomon_commands.h", "gnomon.h")]
INSTALL = ("npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund")


def run(*command: str, cwd: Path) -> None:
    try:
        done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise RuntimeError(f"{command[0]} is missing; install the sections web and kit of packages.txt") from error
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {(done.stdout + done.stderr).strip()[-4000:]}")


def compile_module(build: Path, jobs: str) -> Path:
    """Returns gnomon.wasm."""
    if not (build / "build.ninja").is_file():
        run("emcmake", "cmake", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None", str(WEB), cwd=build)
    run("ninja", "-j", jobs, cwd=build)
    return build / "gnomon.wasm"


def compile_scripts(package: Path) -> None:
    """`package` has sources; it gets dist/."""
    lock = package / "package-lock.json"
    if not (package / "node_modules/.bin/tsc").exists() or lock.read_bytes() != (WEB / lock.name).read_bytes():
        shutil.copyfile(WEB / lock.name, lock)
        run(*INSTALL, cwd=package)
    shutil.rmtree(package / "dist", ignore_errors=True)
    run("node_modules/.bin/tsc", "-p", ".", cwd=package)


def copy_sources(package: Path) -> None:
    shutil.rmtree(package / "src", ignore_errors=True)
    shutil.copytree(WEB / "src", package / "src")
    for name in ("package.json", "tsconfig.json", "README.md"):
        shutil.copyfile(WEB / name, package / name)
    shutil.copyfile(ROOT / "LICENSE", package / "LICENSE")


def weights(dist: Path) -> str:
    lines = []
    for file in sorted(dist.glob("*")):
        if file.suffix in (".wasm", ".gz", ".js"):
            data = file.read_bytes()
            packed = len(data) if file.suffix == ".gz" else len(gzip.compress(data, 9))
            lines.append((file.suffix, packed))
    total = {suffix: sum(packed for kind, packed in lines if kind == suffix) for suffix in (".wasm", ".gz", ".js")}
    return (f"compressed: WebAssembly {total['.wasm'] // 1000} kB, shaders {total['.gz'] // 1000} kB, JavaScript {total['.js'] // 1000} kB, "
            f"together {sum(total.values()) // 1000} kB")


def make(kit: Path, build: Path, out: Path) -> None:
    wasm, package = build / "wasm", build / "package"
    for folder in (wasm, package, out):
        folder.mkdir(parents=True, exist_ok=True)
    copy_sources(package)
    layouts.write(HEADERS, package / "src/layouts.ts", wasm / "layout_check.cpp", wasm / "exports.txt")
    module = compile_module(wasm, os.environ.get("JOBS", str(os.cpu_count() or 1)))
    compile_scripts(package)
    shutil.copyfile(module, package / "dist/gnomon.wasm")
    shaders.bundle(kit, package / "dist/shaders.json.gz")
    for old in out.glob("*.tgz"):
        old.unlink()
    run("npm", "pack", "--pack-destination", str(out.resolve()), cwd=package)
    print(f"web: {next(out.glob('*.tgz'))}; {weights(package / 'dist')}")


def main() -> int:
    if len(sys.argv) != 4:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        make(*(Path(one).resolve() for one in sys.argv[1:]))
    except (OSError, RuntimeError, ValueError) as error:
        print(f"web: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
