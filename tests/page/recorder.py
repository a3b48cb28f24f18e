# SPDX-License-Identifier: Apache-2.0
"""Runs cases of unittest, and writes what became of each in the form of googletest, for tools/cases.py."""

import json
import time
import unittest
from pathlib import Path


class Recorder(unittest.TextTestResult):
    """What became of each case, as googletest writes it."""

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        self.cases = []

    def startTest(self, test):
        super().startTest(test)
        self.began = time.monotonic()
        self.bad = len(self.failures) + len(self.errors)

    def stopTest(self, test):
        super().stopTest(test)
        failures = [{"failure": text} for _, text in (self.failures + self.errors)[self.bad:]][:1]
        self.cases.append({"name": test.id().split(".")[-1].removeprefix("test_"), "status": "RUN", "result": "COMPLETED",
                           "time": f"{time.monotonic() - self.began:.2f}s", **({"failures": failures} if failures else {})})


def run_cases(cases: type[unittest.TestCase], results: Path | None) -> int:
    """The exit status. `results`: written where its folder is there."""
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(cases)
    outcome = unittest.TextTestRunner(resultclass=Recorder, verbosity=1).run(suite)
    if results and results.parent.is_dir() and outcome.cases:
        text = json.dumps({"testsuites": [{"name": cases.__name__, "testsuite": outcome.cases}]})
        results.write_text(text, encoding="utf-8")
    return 0 if outcome.wasSuccessful() else 1
