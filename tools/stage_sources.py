#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which of a test binary's sources the Release stage of .ci/run needs. Called by tests/cases.cmake.

usage: stage_sources.py BINARY SOURCE...     prints, a line each, the sources that have a case which tests/stages.txt names
                                             for BINARY, and those that have no case at all

A source is kept in doubt: the names of a suite's parameters cannot be read here. `tools/cases.py prove` would find a case that
was left out of both stages.
"""

import fnmatch
import re
import sys
from pathlib import Path

from cases import patterns

TEST = re.compile(r"^(TYPED_TEST|TEST|TEST_F|TEST_P)\(\s*(\w+),\s*(\w+)", re.MULTILINE)
INSTANCE = re.compile(r"^INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)", re.MULTILINE)


def may_have(pattern: str, text: str) -> bool:
    """May `text` have a case that `pattern` names?"""
    prefixes = [(suite, prefix + "/") for prefix, suite in INSTANCE.findall(text)]
    for kind, suite, case in TEST.findall(text):
        plain = kind in ("TEST", "TEST_F")
        for prefix in [""] if plain else [prefix for of, prefix in prefixes if of == suite] or ["*/"]:
            wanted_suite, dot, wanted_case = pattern.partition(".")
            if not dot:
                named = fnmatch.fnmatchcase(f"{prefix}{suite}.{case}", pattern) or not plain
            else:
                named = fnmatch.fnmatchcase(prefix + suite, wanted_suite) and \
                    (not plain or fnmatch.fnmatchcase(case, wanted_case))
            if named:
                return True
    return False


def main() -> int:
    binary, *sources = sys.argv[1:]
    wanted = [pattern.split()[1] for pattern in patterns() if pattern.split()[0] == binary]
    for source in sources:
        text = Path(source).read_text(encoding="utf-8")
        has_cases = TEST.search(text) is not None
        if not has_cases or any(may_have(pattern, text) for pattern in wanted):
            print(source)
    return 0


if __name__ == "__main__":
    sys.exit(main())
