#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts the cases of a test run by what they wrote, chooses what a build runs, and proves that none was left out.

usage: cases.py count RESULTS              prints "N passed, N failed, N skipped", before it the dearest, and those that did not pass
       cases.py choose [--ran-in RESULTS]  what tests/cases.cmake asks for
       cases.py prove BUILD RESULTS [SANITIZED]     is every case of every test binary in BUILD run by somebody?

RESULTS is a folder such as build/results: ctest.xml is by ctest, NAME.json by the googletest cases of ctest's test NAME.
A test of ctest that wrote no such file counts as one case, so that one which crashed is not forgotten.

`choose` prints lines: "long BINARY PATTERNS" and "without BINARY PATTERNS", as tests/stages.txt says. With --ran-in, results of
a run in Release, what drew there is left out as well, and "unused FILE" is a source of tests of which no case is left.

`prove`: each case of BUILD has run in RESULTS, or is long, and each test of ctest, or has a label. A label is an item of
tools/ci_turn.py, which `make check-all` runs as a whole. Each pattern of tests/stages.txt has a case. What is not drawn has also run in
SANITIZED, the results under sanitizers. What docs/reliability.md names is there. Exit status 1 when something failed or is missing.
"""

import argparse
import fnmatch
import functools
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

from ci_turn import ITEMS
from sources import project_root

DRAWN, RELEASE, LONG = "drawn under sanitizers", "release only", "long"
MOST_BYTES = 100_000  # bytes of a filter in the environment


def cases_in(file: Path) -> dict[str, dict]:
    """What googletest wrote of each case that ran, by "binary suite.case"."""
    binary = file.name.split(".")[0]
    return {f"{binary} {suite['name']}.{case['name']}": case
            for suite in json.loads(file.read_text(encoding="utf-8")).get("testsuites", [])
            for case in suite["testsuite"] if case.get("status") == "RUN"}


def ran_in(folder: Path) -> dict[str, dict]:
    return {name: case for file in sorted(folder.glob("*.json")) for name, case in cases_in(file).items()}


def outcome_of(case: dict) -> str:
    return "failed" if case.get("failures") else "skipped" if case.get("result") == "SKIPPED" else "passed"


def outcomes(folder: Path) -> dict[str, str]:
    """What became of each case, passed, failed or skipped, and of those tests of ctest that no case speaks for."""
    found = {}
    tests = {}
    if (folder / "ctest.xml").is_file():
        for test in xml.parse(folder / "ctest.xml").getroot().iter("testcase"):
            tests[test.get("name")] = {"run": "passed", "notrun": "skipped"}.get(test.get("status"), "failed")
    for file in sorted(folder.glob("*.json")):
        inside = {name: outcome_of(case) for name, case in cases_in(file).items()}
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


def dearest(folder: Path, number: int) -> list[str]:
    """Those that took most of the processors' time."""
    times = sorted(((float(case.get("processor_s", 0)), name) for name, case in ran_in(folder).items()), reverse=True)
    return [f"all of them {sum(seconds for seconds, _ in times):.0f} s of processor time, the dearest:",
            *(f"{seconds:7.1f} s  {name}" for seconds, name in times[:number])]


@functools.cache
def patterns() -> list[tuple[str, str]]:
    """What tests/stages.txt names: the section, and "binary pattern"."""
    found, section = [], ""
    for line in (project_root() / "tests/stages.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("= "):
            section = line[2:]
        elif line and line[0] != "#":
            found.append((section, " ".join(line.split()[:2])))
    return found


def is_named(case: str, *sections: str) -> bool:
    return any(section in sections and fnmatch.fnmatchcase(case, pattern) for section, pattern in patterns())


def is_for_release_alone(name: str, case: dict) -> bool:
    return is_named(name, RELEASE, LONG) or ("drew" in case and not is_named(name, DRAWN))


def choose(options) -> int:
    sections = {section: {} for section in (DRAWN, RELEASE, LONG)}
    for section, pattern in patterns():
        binary, pattern = pattern.split()
        sections[section].setdefault(binary, []).append(pattern)
    without, used = {binary: list(some) for binary, some in sections[LONG].items()}, {}
    if options.ran_in:
        for binary, some in sections[RELEASE].items():
            without.setdefault(binary, []).extend(some)
        suites: dict[str, list] = {}
        for name, case in ran_in(options.ran_in).items():
            if "file" not in case:
                continue  # a script's, which no sanitizer sees
            left_out = is_for_release_alone(name, case)
            suites.setdefault(name.rpartition(".")[0], []).append((name, left_out))
            source = case["file"][case["file"].rindex("tests/"):]
            used[source] = used.get(source, False) or not left_out
        for suite, cases in suites.items():
            names = [name for name, left_out in cases if left_out]
            # A suite has one name, its cases may have hundreds.
            for name in [f"{suite}.*"] if len(names) == len(cases) else names:
                binary, pattern = name.split(" ")
                without.setdefault(binary, []).append(pattern)
    for kind, filters in (("long", sections[LONG]), ("without", without)):
        for binary, some in filters.items():
            line = ":".join(some)
            if len(line) > MOST_BYTES:
                sys.exit(f"{binary}: a filter of {len(line)} bytes; name whole suites in tests/stages.txt")
            print(kind, binary, line)
    for source in sorted(source for source, is_used in used.items() if not is_used):
        print("unused", source)
    return 0


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
    print("\n".join(dearest(options.results, 30)))
    for outcome in ("failed", "skipped"):
        for case in total[outcome]:
            print(f"{outcome}: {case}")
    print(", ".join(f"{len(total[outcome])} {outcome}" for outcome in total))
    return 1 if total["failed"] else 0


def tests_of(build: Path) -> dict[str, list[str]]:
    """The tests of ctest in a build folder, with their labels."""
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=True)
    return {test["name"]: [label for one in test.get("properties", []) if one["name"] == "LABELS" for label in one["value"]]
            for test in json.loads(shown.stdout)["tests"]}


def prove(options) -> int:
    binaries = sorted(file for file in options.build.glob("test_*") if file.is_file() and file.stat().st_mode & 0o111)
    every = set().union(*(cases_of(binary) for binary in binaries))
    tests = tests_of(options.build)
    ran = ran_in(options.results)
    names = every | tests.keys()
    faults = [f"{case} was not run, nor is it long" for case in sorted(every - ran.keys()) if not is_named(case, LONG)]
    begun = {test.get("name") for test in xml.parse(options.results / "ctest.xml").getroot().iter("testcase")}
    faults += [f"{test} was not run, and has no label" for test in sorted(tests.keys() - begun) if not tests[test]]
    faults += [f"{test} has the label {label}, which tools/ci_turn.py has not" for test in sorted(tests)
               for label in tests[test] if label not in ITEMS]
    if options.sanitized:
        sanitized = ran_in(options.sanitized)
        faults += [f"{name} was not run under sanitizers" for name, case in sorted(ran.items())
                   if not is_for_release_alone(name, case) and name not in sanitized]
    faults += [f"{pattern}: tests/stages.txt names what is not there" for _, pattern in patterns()
               if not fnmatch.filter(every, pattern)]
    faults += [f"{promise}: docs/reliability.md names what is not there" for promise in promises()
               if not fnmatch.filter(names, promise)]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"cases: {len(every)} in {len(binaries)} binaries, {len(every & ran.keys())} of them run")
    return 1 if faults or not every else 0


def main() -> int:
    parser = argparse.ArgumentParser()
    commands = parser.add_subparsers(required=True)
    counts = commands.add_parser("count")
    counts.add_argument("results", type=Path)
    counts.set_defaults(call=count)
    chooses = commands.add_parser("choose")
    chooses.add_argument("--ran-in", type=Path)
    chooses.set_defaults(call=choose)
    proves = commands.add_parser("prove")
    proves.add_argument("build", type=Path)
    proves.add_argument("results", type=Path)
    proves.add_argument("sanitized", type=Path, nargs="?")
    proves.set_defaults(call=prove)
    options = parser.parse_args()
    return options.call(options)


if __name__ == "__main__":
    sys.exit(main())
