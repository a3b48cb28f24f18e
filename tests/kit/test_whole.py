#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The whole kit: made twice it is the same bytes, passes.json is true, and every compiler says of it what docs/kit.md does.

usage: test_whole.py BUILD OUT LAYOUTS. Exit status 77 where a compiler, or npm, is not on this machine.
"""

import filecmp
import subprocess
import sys
from pathlib import Path

KIT = Path(__file__).resolve().parent.parent.parent / "kit"


def differences(a: Path, b: Path) -> list[str]:
    files = [{path.relative_to(folder) for path in folder.rglob("*") if path.is_file()} for folder in (a, b)]
    return [str(one) for one in sorted(files[0] ^ files[1])] + [str(one) for one in sorted(files[0] & files[1])
                                                               if not filecmp.cmp(a / one, b / one, shallow=False)]


def main() -> int:
    build, out = Path(sys.argv[1]), Path(sys.argv[2])
    for name in ("a", "b"):
        done = subprocess.run([sys.executable, "-B", KIT / "make_kit.py", build, out / name], capture_output=True, text=True, check=False)
        print(done.stdout + done.stderr, end="")
        if "there is no npm" in done.stderr or "npm could not install" in done.stderr:
            print("SKIPPED: WGSL is not made")
            return 77
        if done.returncode != 0:
            return 1
    if found := differences(out / "a", out / "b"):
        print(f"made twice, these files differ: {', '.join(found)}")
        return 1
    (out / "b/passes.json").write_text("", encoding="utf-8")
    if differences(out / "a", out / "b") != ["passes.json"]:
        print("a difference was not found")
        return 1
    if subprocess.run([sys.executable, "-B", Path(__file__).with_name("test_kit.py"), out / "a", sys.argv[3]], check=False).returncode != 0:
        return 1
    return subprocess.run([sys.executable, "-B", KIT / "check_kit.py", out / "a", build], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
