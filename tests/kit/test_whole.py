#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The whole kit: made twice it is the same bytes, passes.json is true, it draws, and every compiler says of it what docs/kit.md does.

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
    here = Path(__file__).resolve().parent
    checks = ([here / "test_kit.py", out / "a", sys.argv[3]], [here / "test_draws.py", out / "a", build], [KIT / "check_kit.py", out / "a", build])
    results = [subprocess.run([sys.executable, "-B", *check], check=False).returncode for check in checks]
    return next((one for one in results if one not in (0, 77)), max(results))


if __name__ == "__main__":
    sys.exit(main())
