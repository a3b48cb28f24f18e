#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The claims of the documents: what is recorded of them is what comes out, and the tables are sound.

usage: test_claims.py TOOLS GNOMON [TEST...]
"""

import contextlib
import io
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock
from pathlib import Path

TOOLS, GNOMON = sys.argv.pop(1), Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, TOOLS)

import claims  # noqa: E402
from claim_tables import FAILS, HOLDS, PARTLY, Claim, Part  # noqa: E402

COMMANDS = list(dict.fromkeys(command for claim in claims.CLAIMS for command in claim.commands))
FIGURES = json.loads(subprocess.run([GNOMON.with_name("claims_worked_out")], capture_output=True, text=True, check=True).stdout)
SMALL = ("gnomon compare planes --preset plain --camera side --size 16x9 --truth hard --repetitions 1 --warmup 0 --map-size 16 "
         "--techniques hard,hard+bias=none")


class Looked(Exception):
    """A figure has looked at what a command found, which is not there."""


class Reading(claims.Runs):
    """Stands for what commands found: it knows which numbers there are, and all are 1."""

    def __init__(self, claim: Claim):
        self.commands = claim.commands

    @property
    def found(self):
        raise Looked

    def of(self, technique, pointer, run=0):
        assert technique in claims.techniques_of(self.commands[run]), technique
        return 1.0

    def pass_ms(self, technique, name, run=0):
        return self.of(technique, name, run)

    def number(self, pointer, run=0):
        assert claims.words_of(self.commands[run])[0] in ("metrics", "plan"), self.commands[run]
        return 1.0

    def worked_out(self, name):
        return FIGURES[name]


class Tables(unittest.TestCase):
    def test_claims_have_names_of_their_own_and_all_that_a_table_needs(self):
        ids = [claim.id for claim in claims.CLAIMS]
        self.assertEqual(len(ids), len(set(ids)))
        self.assertGreaterEqual(len(ids), 89)
        for document in claims.DOCUMENTS:
            self.assertTrue(document.source and document.claims)
            for claim in document.claims:
                with self.subTest(claim.id):
                    self.assertTrue(claim.id.startswith(document.year + "-"))
                    self.assertTrue(claim.claim and claim.why and claim.parts)
                    self.assertIn(claim.verdict, (HOLDS, PARTLY, FAILS))
                    self.assertTrue(claim.verdict != PARTLY or len(claim.parts) > 1)
                    for part in claim.parts:
                        self.assertTrue(part.what)
                        self.assertLessEqual(part.least, part.most)
                        self.assertTrue(math.isfinite(part.least) or math.isfinite(part.most))

    def test_quick_ones_depend_on_no_clock(self):
        for claim in claims.CLAIMS:
            self.assertFalse(claim.quick and any(command.startswith("gnomon bench") for command in claim.commands), claim.id)

    def test_commands_need_nothing_but_the_program(self):
        for command in COMMANDS:
            self.assertTrue(command.startswith("gnomon "), command)
            self.assertNotIn("/shared", command)

    def test_figures_read_what_their_commands_find(self):
        for claim in claims.CLAIMS:
            for part in claim.parts:
                with self.subTest(claim.id, part=part.what), contextlib.suppress(Looked):
                    self.assertIsInstance(part.figure(Reading(claim)), (float, int))

    def test_the_page_has_what_is_recorded(self):
        page = (claims.project_root() / claims.PAGE).read_text(encoding="utf-8")
        self.assertEqual(claims.page_faults(page, claims.CLAIMS), [])
        rows = [line for line in page.splitlines() if line.startswith("| `20")]
        for old, new, expected in (("| **holds** |", "| **partly** |", "the row of 2011-range is not what is recorded"),
                                   ("9999 over 99", "9999 over 98", "the row of 2011-range is not what is recorded"),
                                   ("| `2011-range` |", "| `2011-rang` |", "there is no claim 2011-rang"),
                                   (f"{rows[0]}\n{rows[1]}\n", f"{rows[1]}\n{rows[0]}\n", "the claims' order differs"),
                                   ("<!-- claims end -->", "", "no tables")):
            with self.subTest(expected):
                self.assertIn(old, page)
                self.assertIn(expected, "\n".join(claims.page_faults(page.replace(old, new, 1), claims.CLAIMS)))


def made_up(recorded: str, *figures) -> Claim:
    parts = [Part("a figure", "m", lambda _, figure=figure: figure, 0, 0.5) for figure in figures]
    return Claim("2006-made-up", recorded, "one is at most one half", parts, "It is | not.")


class Trying(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.runner = claims.Runner(GNOMON, folder.name, [])

    def tried(self, claim: Claim) -> claims.Tried:
        return claims.try_claim(claim, self.runner)

    def test_all_parts_hold_some_or_none(self):
        for verdict, *figures in ((HOLDS, 0.5, 0.0), (PARTLY, 0.6, 0.0), (PARTLY, math.nan, 0.0), (FAILS, 0.6), (FAILS, math.nan),
                                  (FAILS, -0.1)):
            self.assertEqual(self.tried(made_up(HOLDS, *figures)).verdict, verdict, figures)

    def test_what_comes_out_otherwise_is_told(self):
        self.assertEqual(claims.faults_of([self.tried(made_up(PARTLY, 0.6, 0.0))]), [])
        wrong = [self.tried(made_up(HOLDS, 0.6, 0.0))]
        self.assertEqual(claims.faults_of(wrong), ["2006-made-up (partly now, holds recorded)"])
        self.assertIn("recorded: holds", claims.text_of(wrong))
        self.assertFalse(claims.tried_json(wrong[0])["as_recorded"])

    def test_a_figure_that_is_no_number_never_holds_and_is_told(self):
        for part in (Part("none", "", lambda _: math.nan), Part("divided", "", lambda _: 1.0 / 0.0)):
            one = self.tried(made_up(FAILS, 0.6)._replace(parts=[part]))
            self.assertEqual((one.holds, claims.tried_json(one)["parts"][0]["figure"]), ([False], None))
            self.assertEqual(claims.faults_of([one]), [f"2006-made-up (no number: {part.what})"])

    def test_a_broken_row_is_told(self):
        for figure, expected in ((lambda r: r.of("pcf", "/error/rmse"), "has no technique pcf"),
                                 (lambda r: r.worked_out("no_such_figure"), 'works out no "no_such_figure"')):
            claim = made_up(HOLDS, 0.0)._replace(commands=[SMALL], parts=[Part("a figure", "", figure)])
            with self.assertRaisesRegex(claims.Failure, expected):
                self.tried(claim)
        with self.assertRaisesRegex(claims.Failure, "ends with status 2: .*no-such-filter"):
            self.tried(made_up(HOLDS, 0.0)._replace(commands=["gnomon plan planes --filter no-such-filter"]))
        with self.assertRaisesRegex(claims.Failure, "ninja -C build"):
            claims.Runner(GNOMON.with_name("no_such_program"), "/", []).run(SMALL)

    def test_each_command_is_run_once_and_its_techniques_are_told_apart(self):
        found = self.runner.run(SMALL)
        self.assertIs(self.runner.run(SMALL), found)
        runs = claims.Runs(made_up(HOLDS, 0.0)._replace(commands=[SMALL]), self.runner)
        for name, bias in (("hard", "auto"), ("hard+bias=none", "none")):
            self.assertEqual(runs.result(name, 0)["settings"]["bias"], bias)
        self.assertGreater(runs.of("hard", "/error/rmse"), 0.0)
        self.assertTrue(math.isnan(runs.of("hard", "/error/no_such_number")))
        with self.assertRaisesRegex(claims.Failure, "2 results could be"):
            claims.results_of(SMALL.replace("hard+bias=none", "hard"), found)

    def test_figures_are_readable(self):
        for figure, text in ((0.0, "0"), (101.0, "101"), (0.78431, "0.784"), (5.96e-8, "6e-08"), (2.0, "2"), (-0.00703, "-0.00703"),
                             (math.nan, "-")):
            self.assertEqual(claims.figure_text(figure), text)

    def test_a_cell_does_not_end_where_its_text_has_a_bar(self):
        documents = [claims.Document("2006", "somebody", [made_up(FAILS, 0.6)])]
        page = "<!-- claims begin -->\n" + claims.markdown_of([self.tried(documents[0].claims[0])], documents) + "<!-- claims end -->\n"
        self.assertIn("| a figure 0.6 m | **does not hold** | It is \\| not. |", page)
        self.assertEqual(claims.page_faults(page, documents[0].claims), [])

    def test_what_is_worked_out_is_what_is_known(self):
        for name, value, within in (("precision_of_tight_planes", 101.0, 1e-9), ("step_of_floats_below_1", 2.0**-24, 0.0),
                                    ("density_at_edge_of_120_degrees", 4.0, 1e-12), ("step_of_24_bits_m", 5.96e-5, 1e-7),
                                    ("step_of_24_bits_in_z_over_w_m", 0.596, 0.001), ("published_blur_sum", 1.067, 0.001),
                                    ("published_blur_centre_px", 0.41, 0.01), ("coarser_codes_in_upper_half", 2.0, 0.0)):
            self.assertAlmostEqual(FIGURES[name], value, delta=within, msg=name)


def run(*arguments: str) -> tuple[int, str, str]:
    """The tool's exit status, and what it writes to standard output and error."""
    line = [sys.executable, "-B", Path(TOOLS, "claims.py"), "--gnomon", GNOMON, *arguments]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def refusal(command: str, folder: str) -> str:
    """What the program says where a command is wrong usage; nothing of one that it takes. There is no driver to draw with, no
    picture to measure and no folder for one, so that it goes no further."""
    words = [f"none/{word}" if word.endswith(".png") else word for word in claims.words_of(command)]
    drivers = {name: "/none.json" for name in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES")}
    done = subprocess.run([GNOMON, *words], cwd=folder, env={**os.environ, **drivers}, capture_output=True, text=True, check=False)
    return "" if done.returncode in (0, 1) else done.stderr.strip() or f"status {done.returncode}"


class Program(unittest.TestCase):
    def test_takes_all_commands(self):
        with tempfile.TemporaryDirectory() as folder:
            for command in COMMANDS:
                self.assertEqual(refusal(command, folder), "", command)
            for wrong in (SMALL.replace("--camera", "--camara"), SMALL.replace("=none", "=nobody"), SMALL.replace("hard,", "harder,")):
                self.assertNotEqual(refusal(wrong, folder), "", wrong)

    def test_writes_text_json_and_markdown(self):
        status, out, err = run("2011-range", "2005-gaussian")
        self.assertEqual((status, err), (0, ""))
        self.assertIn("2 claims in 0 s: 1 hold, 0 partly, 1 do not", out)
        status, out, _ = run("--markdown", "2011-range", "2011-octree")
        self.assertEqual(status, 0)
        self.assertIn("| `2011-range` | ", out)
        self.assertIn("| `2011-octree` | ", out)
        status, out, _ = run("--json", "2011-range")
        self.assertEqual((status, json.loads(out)["claims"][0]["recorded"]), (0, HOLDS))

    def test_lists_what_is_recorded(self):
        self.assertEqual(len(run("--list")[1].splitlines()), len(claims.CLAIMS))
        self.assertRegex(run("--list", "2011-bloom")[1], re.compile("A. Marinescu.*verdict +partly", re.DOTALL))
        of_year = json.loads(run("--list", "--json", "--quick", "2014", "2011-range")[1])
        self.assertGreater(len(of_year), 2)
        for claim in of_year:
            self.assertTrue(claim["quick"] and (claim["document"] == "2014" or claim["id"] == "2011-range"), claim)

    def test_refuses_what_it_cannot_try(self):
        for arguments, expected in ((["2011-rang"], "did you mean 2011-range?"), (["--quick", "2010-blend-cost"], "leaves none"),
                                    (["--json", "--markdown", "2011-range"], "give one"), (["--write", "2011-range"], "of all claims"),
                                    (["--map-size", "64"], "unrecognized arguments")):
            status, _, err = run(*arguments)
            self.assertEqual(status, 2, err)
            self.assertIn(expected, err)

    def test_ends_with_1_where_a_verdict_is_another(self):
        wrong = claims.CLAIMS[0]._replace(verdict=FAILS)
        with mock.patch.object(claims, "CLAIMS", [wrong]), \
                mock.patch.object(sys, "argv", ["claims.py", "--gnomon", str(GNOMON)]), \
                contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as err:
            self.assertEqual(claims.main(), 1)
        self.assertIn("2011-range (holds now, does not hold recorded)", err.getvalue())


class Quick(unittest.TestCase):
    def test_gives_what_is_recorded(self):
        status, out, err = run("--quick", "--validate", "--json")
        self.assertEqual((status, err), (0, ""))
        self.assertEqual([one["id"] for one in json.loads(out)["claims"]], [claim.id for claim in claims.CLAIMS if claim.quick])


if __name__ == "__main__":
    unittest.main()
