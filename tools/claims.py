#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tries what the documents that this project began with claim, and says what holds.

usage: claims.py [options] [NAME|YEAR...]

A year stands for all claims of its document; without a name all are tried. The claims are data, in tools/claim_tables. Their commands
are run by the program, each once, though several claims may share it. Figures that need no picture come from the library's own
arithmetic (tests/claims/worked_out.cpp). docs/claims.md says more.

  --list             what is recorded, without trying it
  --quick            only claims that take seconds and depend on no clock
  --json             JSON instead of text
  --markdown         the tables of docs/claims.md
  --write            puts the tables of all claims into docs/claims.md, too
  --gpu NAME         draws there, as the program's option has it
  --validate         Vulkan validation; a message makes the command fail
  --gnomon PROGRAM   default: build/gnomon; claims_worked_out is looked for beside it

Exit status 1 when a verdict is not the recorded one, a figure is no number, or a command fails; 2 is wrong usage.
"""

import argparse
import difflib
import json
import math
import re
import shlex
import subprocess
import sys
import tempfile
import textwrap
import time
from pathlib import Path
from typing import NamedTuple

from check_docs import shown
from claim_tables import FAILS, HOLDS, PARTLY, Claim, Document, of_2005, of_2006, of_2010, of_2011, of_2014
from sources import project_root

DOCUMENTS = [of_2011.DOCUMENT, of_2006.DOCUMENT, of_2014.DOCUMENT, of_2010.DOCUMENT, of_2005.DOCUMENT]
CLAIMS = [claim for document in DOCUMENTS for claim in document.claims]
PAGE = Path("docs/claims.md")
TABLES = re.compile(r"<!-- claims begin[^\n]*-->\n(.*?)<!-- claims end -->", re.DOTALL)


class Failure(Exception):
    """What could not be tried, and why."""


def words_of(command: str) -> list[str]:
    """The arguments of the program in a command, as a shell parts them."""
    return shlex.split(command)[1:]


def techniques_of(command: str) -> list[str]:
    words = words_of(command)
    return words[words.index("--techniques") + 1].split(",") if "--techniques" in words else []


def says(result: dict, word: str) -> bool:
    """Whether the technique of a result has a word of a technique's text."""
    key, equals, value = word.partition("=")
    return shown(result["settings"].get(key)) == value if equals else word in result["choices"].values()


def results_of(command: str, found: dict) -> dict[str, dict]:
    """The results by the words of --techniques. There each has its technique written out, and stands where its error puts it.
    The more words, the fewer results have them all: `hard` is what is left once `hard+bias=none` is known."""
    left, named = list(found["results"]), {}
    for name in sorted(techniques_of(command), key=lambda name: name.count("+"), reverse=True):
        fitting = [result for result in left if all(says(result, word) for word in name.split("+"))]
        if len(fitting) != 1:
            raise Failure(f"`{command}`: {len(fitting)} results could be that of {name}: the table of claims is wrong")
        named[name] = fitting[0]
        left.remove(fitting[0])
    return named


def number_at(found, pointer: str) -> float:
    """The number that a JSON pointer leads to; NaN where it is null or missing."""
    for key in pointer.split("/")[1:]:
        if isinstance(found, list):
            found = found[int(key)] if int(key) < len(found) else None
        else:
            found = found.get(key) if isinstance(found, dict) else None
    return float(found) if isinstance(found, (int, float)) else math.nan


class Runs:
    """What the commands of one claim have found. `run` is a command's place in the claim."""

    def __init__(self, claim: Claim, runner: "Runner"):
        self.commands = claim.commands
        self.found = [runner.run(command) for command in claim.commands]
        self.worked_out = runner.worked_out

    def result(self, technique: str, run: int) -> dict:
        results = results_of(self.commands[run], self.found[run])
        if technique not in results:
            raise Failure(f"`{self.commands[run]}` has no technique {technique}: the table of claims is wrong")
        return results[technique]

    def of(self, technique: str, pointer: str, run: int = 0) -> float:
        """A number of a technique's result."""
        return number_at(self.result(technique, run), pointer)

    def ratio(self, technique: str, other: str, pointer: str, run: int = 0) -> float:
        return self.of(technique, pointer, run) / self.of(other, pointer, run)

    def number(self, pointer: str, run: int = 0) -> float:
        """A number of a command that knows no techniques."""
        return number_at(self.found[run], pointer)

    def number_over(self, pointer: str, run: int, other: int) -> float:
        return self.number(pointer, run) / self.number(pointer, other)

    def pass_ms(self, technique: str, name: str, run: int = 0) -> float:
        return next((number_at(one, "/ms") for one in self.result(technique, run)["passes"] if one["name"] == name), math.nan)

    def shadow_ms(self, technique: str, run: int = 0) -> float:
        """Of maps and the mask with its blur, which are all that a technique adds."""
        return self.of(technique, "/time_ms/maps", run) + self.of(technique, "/time_ms/mask", run)


class Runner:
    """Runs commands of the program in a folder of their own, each once."""

    def __init__(self, gnomon: Path, folder: str, drawing: list[str]):
        self.gnomon, self.folder, self.drawing = gnomon.resolve(), folder, drawing
        self.known: dict[str, object] = {}

    def run(self, command: str):
        """The JSON of a command; None of one that draws a picture."""
        if command not in self.known:
            words = words_of(command)
            draws = words[0] in ("render", "compare", "bench")
            line = [*words, *(["--json"] if "--json" not in words and words[0] != "render" else []), *(self.drawing if draws else [])]
            said = self.output([self.gnomon, *line], command)
            self.known[command] = None if words[0] == "render" else json.loads(said)
        return self.known[command]

    def worked_out(self, name: str) -> float:
        """A figure of the library's own arithmetic."""
        program = "claims_worked_out"
        if program not in self.known:
            self.known[program] = json.loads(self.output([self.gnomon.with_name(program)], program))
        if name not in self.known[program]:
            raise Failure(f'`{program}` works out no "{name}": the table of claims is wrong')
        return number_at(self.known[program], f"/{name}")

    def output(self, line: list, command: str) -> str:
        try:
            done = subprocess.run(line, cwd=self.folder, capture_output=True, text=True, check=False)
        except OSError as error:
            raise Failure(f"running {line[0]}: {error.strerror}; `ninja -C build gnomon claims_worked_out` builds what claims need, and "
                          "--gnomon says where it is") from error
        if done.returncode != 0:
            raise Failure(f"`{command}` ends with status {done.returncode}: {done.stderr.strip()}")
        return done.stdout


class Tried(NamedTuple):
    claim: Claim
    figures: list[float]  # as the claim's parts
    holds: list[bool]
    seconds: float  # less what another claim had run already

    @property
    def verdict(self) -> str:
        return HOLDS if all(self.holds) else PARTLY if any(self.holds) else FAILS


def try_claim(claim: Claim, runner: Runner) -> Tried:
    began = time.monotonic()
    runs = Runs(claim, runner)
    figures = []
    for part in claim.parts:
        try:
            figures.append(float(part.figure(runs)))
        except ZeroDivisionError:
            figures.append(math.nan)
    holds = [part.least <= figure <= part.most for part, figure in zip(claim.parts, figures, strict=True)]
    return Tried(claim, figures, holds, time.monotonic() - began)


def faults_of(tried: list[Tried]) -> list[str]:
    """What is not as it is recorded."""
    return [f"{one.claim.id} ({one.verdict} now, {one.claim.verdict} recorded)" for one in tried if one.verdict != one.claim.verdict] + [
        f"{one.claim.id} (no number: {part.what})" for one in tried
        for part, figure in zip(one.claim.parts, one.figures, strict=True) if not math.isfinite(figure)]


def figure_text(figure: float) -> str:
    """A figure as people read it: three digits that count."""
    if not math.isfinite(figure):
        return "-"
    size = abs(figure)
    if figure != 0 and not 1e-4 <= size < 1e6:
        return f"{figure:.2g}"
    before = math.floor(math.log10(size)) + 1 if size else 1
    text = f"{figure:.{min(max(3 - before, 0), 6)}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def bound_text(part) -> str:
    if part.least == -math.inf:
        return f"at most {figure_text(part.most)}"
    return f"at least {figure_text(part.least)}" if part.most == math.inf else f"{figure_text(part.least)} to {figure_text(part.most)}"


def figure_texts(tried: Tried) -> list[str]:
    """"acne 0.12 of that without", a part each."""
    return [" ".join(filter(None, (part.what, figure_text(figure), part.unit)))
            for part, figure in zip(tried.claim.parts, tried.figures, strict=True)]


def text_of(tried: list[Tried]) -> str:
    lines = []
    for one in tried:
        lines.append(f"{one.claim.id:<26} {one.verdict:<13} {one.seconds:>6.1f} s  {one.claim.claim}")
        for part, figure, holds in zip(one.claim.parts, figure_texts(one), one.holds, strict=True):
            lines.append(f"{'':50}{figure} ({bound_text(part)}: {'holds' if holds else 'does not'})")
        if one.verdict != one.claim.verdict:
            lines.append(f"{'':50}recorded: {one.claim.verdict}")
    count = {verdict: sum(one.verdict == verdict for one in tried) for verdict in (HOLDS, PARTLY, FAILS)}
    lines.append(f"{len(tried)} claims in {sum(one.seconds for one in tried):.0f} s: {count[HOLDS]} hold, {count[PARTLY]} partly, "
                 f"{count[FAILS]} do not")
    return "\n".join(lines) + "\n"


def recorded_json(claim: Claim) -> dict:
    return {"id": claim.id, "document": claim.id[:4], "claim": claim.claim, "commands": list(claim.commands), "quick": claim.quick,
            "recorded": claim.verdict, "why": claim.why}


def tried_json(one: Tried) -> dict:
    def finite(value: float) -> float | None:
        return value if math.isfinite(value) else None
    return {**recorded_json(one.claim), "verdict": one.verdict, "as_recorded": one.verdict == one.claim.verdict, "seconds": one.seconds,
            "parts": [{"what": part.what, "figure": finite(figure), "unit": part.unit, "least": finite(part.least),
                       "most": finite(part.most), "holds": holds}
                      for part, figure, holds in zip(one.claim.parts, one.figures, one.holds, strict=True)]}


def cells(*texts: str) -> str:
    return "| " + " | ".join(text.replace("|", "\\|") for text in texts) + " |\n"


def markdown_of(tried: list[Tried], documents: list[Document]) -> str:
    """A heading and a table of each document of which a claim was tried."""
    text = ""
    for document in documents:
        here = [one for one in tried if one.claim in document.claims]
        if not here:
            continue
        text += f"## {document.source}, {document.year}\n\n" + cells("name", "claim", "our figures", "verdict", "why") + "|---" * 5 + "|\n"
        for one in here:
            text += cells(f"`{one.claim.id}`", one.claim.claim, "; ".join(figure_texts(one)), f"**{one.verdict}**", one.claim.why)
        text += "\n"
    return text


def page_faults(page: str, claims: list[Claim]) -> list[str]:
    """Where the tables of the page are not what is recorded. Their figures take minutes and are not looked at."""
    match = TABLES.search(page)
    if not match:
        return [f"{PAGE}: no tables between its marks"]
    rows = {}
    for line in match[1].splitlines():
        if line.startswith("| `"):
            name, claim, _, *rest = (cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1])
            rows[name.strip("`")] = [claim, *rest]
    found = []
    for claim in claims:
        if rows.get(claim.id) != [text.replace("|", "\\|") for text in (claim.claim, f"**{claim.verdict}**", claim.why)]:
            found.append(f"{PAGE}: the row of {claim.id} is not what is recorded (tools/claims.py --write)")
    known = [claim.id for claim in claims]
    found += [f"{PAGE}: there is no claim {name}" for name in rows if name not in known]
    return found or ([] if list(rows) == known else [f"{PAGE}: the claims' order differs (tools/claims.py --write)"])


def listing(claims: list[Claim], in_full: bool) -> str:
    if not in_full:
        return "".join(f"{claim.id:<26} {claim.verdict:<13} {claim.claim}\n" for claim in claims)
    texts = []
    for claim in claims:
        source = next(f"{document.source}, {document.year}" for document in DOCUMENTS if claim in document.claims)
        rows = [("claim", claim.claim), ("source", source), ("verdict", claim.verdict), ("why", claim.why),
                *(("figure", f"{part.what} ... {part.unit}".rstrip() + f": {bound_text(part)}") for part in claim.parts),
                *(("command", command) for command in claim.commands),
                ("try it", f"tools/claims.py {claim.id}{' (takes seconds)' if claim.quick else ''}")]
        texts.append(f"{claim.id}\n" + "".join(textwrap.fill(text, 110, initial_indent=f"  {name:<9}", subsequent_indent=" " * 11,
                                                             break_on_hyphens=False, break_long_words=False) + "\n" for name, text in rows))
    return "\n".join(texts)


def chosen(options, parser: argparse.ArgumentParser) -> list[Claim]:
    """Those that are named, else all; with --quick the quick ones of them."""
    names = {document.year for document in DOCUMENTS} | {claim.id for claim in CLAIMS}
    for name in options.names:
        if name not in names:
            near = difflib.get_close_matches(name, names, 1)
            parser.error(f'there is no claim "{name}"{f"; did you mean {near[0]}?" if near else ""}; --list has them all')
    claims = [claim for claim in CLAIMS if not options.names or claim.id in options.names or claim.id[:4] in options.names]
    claims = [claim for claim in claims if claim.quick or not options.quick]
    if not claims:
        parser.error("--quick leaves none of these claims: none of them takes seconds only")
    return claims


def try_all(claims: list[Claim], options) -> list[Tried]:
    drawing = (["--gpu", options.gpu] if options.gpu else []) + (["--validate"] if options.validate else [])
    tried = []
    with tempfile.TemporaryDirectory(prefix="gnomon_claims.") as folder:
        runner = Runner(options.gnomon, folder, drawing)
        for number, claim in enumerate(claims, 1):
            if sys.stderr.isatty():
                print(f"{number} of {len(claims)}: {claim.id}", file=sys.stderr)
            tried.append(try_claim(claim, runner))
    return tried


def write_page(tables: str) -> None:
    file = project_root() / PAGE
    text = file.read_text(encoding="utf-8")
    match = TABLES.search(text)
    if not match:
        raise Failure(f"{PAGE}: no tables between its marks")
    file.write_text(text[:match.start(1)] + tables + text[match.end(1):], encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(prog="claims.py", usage=__doc__[__doc__.index("usage: ") + 7:], add_help=True)
    parser.add_argument("names", nargs="*")
    for flag in ("list", "quick", "json", "markdown", "write", "validate"):
        parser.add_argument(f"--{flag}", action="store_true")
    parser.add_argument("--gpu")
    parser.add_argument("--gnomon", type=Path, default=project_root() / "build/gnomon")
    options = parser.parse_args()
    if options.json + options.markdown + options.write > 1:
        parser.error("--json, --markdown and --write each say how the tables are written; give one")
    if options.write and (options.names or options.quick):
        parser.error("--write is of all claims; give no name and no --quick")
    claims = chosen(options, parser)
    if options.list:
        recorded = json.dumps([recorded_json(claim) for claim in claims], indent=2) + "\n"
        print(recorded if options.json else listing(claims, bool(options.names)), end="")
        return 0
    try:
        tried = try_all(claims, options)
        if options.write:
            write_page(markdown_of(tried, DOCUMENTS))
    except Failure as failure:
        print(f"claims: {failure}", file=sys.stderr)
        return 1
    if options.json:
        print(json.dumps({"claims": [tried_json(one) for one in tried]}, indent=2))
    else:
        print(markdown_of(tried, DOCUMENTS) if options.markdown else text_of(tried), end="")
    faults = faults_of(tried)
    if faults:
        print(f"claims: of {len(tried)} claims {len(faults)} things are not as recorded: {', '.join(faults)}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
