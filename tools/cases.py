#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts the cases of a test run by what they wrote, and proves that none was left out.

usage: cases.py count RESULTS              prints "N passed, N failed, N skipped", before it the slowest, and those that did not pass
       cases.py prove BUILD RESULTS...     was every case of every test binary in BUILD run in some RESULTS?

RESULTS is a folder such as build/results: ctest.xml is by ctest, NAME.json by the googletest cases of ctest's test NAME.
A test of ctest that wrote no such file counts as one case, so that one which crashed is not forgotten. `prove` also looks for
patterns of tests/stages.txt that no case has, and for cases of its "both" that some RESULTS lack. Exit status 1 when something
failed or is missing. What docs/reliability.md names has to have run too.
"""

import argparse
import fnmatch
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

from sources import project_root


def outcomes_in(file: Path) -> dict[str, str]:
    """What became of each case that ran, "binary suite.case": passed, failed or skipped."""
    found, binary = {}, file.name.split(".")[0]
    for suite in json.loads(file.read_text(encoding="utf-8")).get("testsuites", []):
        for case in suite["testsuite"]:
            if case.get("status") == "RUN":
                found[f"{binary} {suite['name']}.{case['name']}"] = \
                    "failed" if case.get("failures") else "skipped" if case.get("result") == "SKIPPED" else "passed"
    return found


def outcomes(folder: Path) -> dict[str, str]:
    """The same of all files, and of those tests of ctest that no case speaks for."""
    found = {}
    tests = {}
    if (folder / "ctest.xml").is_file():
        for test in xml.parse(folder / "ctest.xml").getroot().iter("testcase"):
            tests[test.get("name")] = {"run": "passed", "notrun": "skipped"}.get(test.get("status"), "failed")
    for file in sorted(folder.glob("*.json")):
        inside = outcomes_in(file)
        # A process may fail after its cases, by a leak.
        if tests.get(file.stem) != "failed" or "failed" in inside.values():
            tests.pop(file.stem, None)
        found |= inside
    return found | tests


def cases_of(binary: Path) -> set[str]:
    listed = subprocess.run([binary, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    name, suite, cases = binary.name.removeprefix("test_"), "", set()
    for line in listed.splitlines():
        words = line.split("#")[0].rstrip()
        if words.startswith("  "):
            cases.add(f"{name} {suite}{words.strip()}")
        elif words.endswith("."):
            suite = words
    return cases


def slowest(folder: Path, number: int) -> list[str]:
    times = []
    for file in folder.glob("*.json"):
        for suite in json.loads(file.read_text(encoding="utf-8")).get("testsuites", []):
            times += [(float(case["time"].rstrip("s")), f"{file.name.split('.')[0]} {suite['name']}.{case['name']}")
                      for case in suite["testsuite"]]
    return [f"{seconds:7.1f} s  {case}" for seconds, case in sorted(times, reverse=True)[:number]]


def patterns(of_section: str = "") -> list[str]:
    """What tests/stages.txt names, "binary pattern", in one of its sections or in all."""
    found, section = [], ""
    for line in (project_root() / "tests/stages.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("= "):
            section = line[2:]
        elif line and line[0] != "#" and of_section in ("", section):
            found.append(" ".join(line.split()[:2]))
    return found


def promises() -> list[str]:
    """The tests that docs/reliability.md names: "binary pattern", or the name of a test of ctest."""
    found = []
    for line in (project_root() / "docs/reliability.md").read_text(encoding="utf-8").splitlines():
        if not line.startswith("| ") or line.startswith("| promise"):
            continue
        for part in line.split("|")[-2].split(";"):
            part = part.split("by hand")[0]
            binary = re.match(r"\s*(?:(\w+):)?", part)[1]
            found += [f"{binary} {name}" if binary else name for name in re.findall("`([^`]+)`", part)
                      if not name.startswith("make ")]
    return found


def count(options) -> int:
    found = outcomes(options.results)
    total = {outcome: sorted(case for case in found if found[case] == outcome)
             for outcome in ("passed", "failed", "skipped")}
    print("\n".join(["the slowest cases:", *slowest(options.results, 30)]))
    for outcome in ("failed", "skipped"):
        for case in total[outcome]:
            print(f"{outcome}: {case}")
    print(", ".join(f"{len(total[outcome])} {outcome}" for outcome in total))
    return 1 if total["failed"] else 0


def prove(options) -> int:
    binaries = sorted(file for file in options.build.glob("test_*") if file.is_file() and file.stat().st_mode & 0o111)
    every = set().union(*(cases_of(binary) for binary in binaries))
    runs = [set(outcomes(folder)) for folder in options.results]
    ran = set().union(*runs)
    faults = [f"{case} was run by no stage" for case in sorted(every - ran)]
    faults += [f"{pattern}: tests/stages.txt names what is not there" for pattern in patterns()
               if not any(fnmatch.fnmatchcase(case, pattern) for case in every)]
    faults += [f"{promise}: docs/reliability.md names what did not run" for promise in promises()
               if not any(fnmatch.fnmatchcase(case, promise) for case in ran)]
    for pattern in patterns("both"):
        faults += [f"{case} was not run by every stage" for case in sorted(fnmatch.filter(every, pattern))
                   if not all(case in run for run in runs)]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"cases: {len(every)} in {len(binaries)} binaries, {len(every & ran)} of them run")
    return 1 if faults or not every else 0


def main() -> int:
    parser = argparse.ArgumentParser()
    commands = parser.add_subparsers(required=True)
    counts = commands.add_parser("count")
    counts.add_argument("results", type=Path)
    counts.set_defaults(call=count)
    proves = commands.add_parser("prove")
    proves.add_argument("build", type=Path)
    proves.add_argument("results", type=Path, nargs="+")
    proves.set_defaults(call=prove)
    options = parser.parse_args()
    return options.call(options)


if __name__ == "__main__":
    sys.exit(main())
