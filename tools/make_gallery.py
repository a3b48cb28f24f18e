#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the gallery: pictures, figures and films of every technique, as docs/gallery.json lists them.

usage: make_gallery.py [--only TEXT] [--size WxH] [--no-films | --films] GNOMON [DOCS]

Writes DOCS/gallery/*.jpg, DOCS/films/*.webm and *.png (moving PNG), and in DOCS/gallery.md what lies between its marks; DOCS is
docs/. --only: entries and films whose names hold TEXT, and nothing of the page. --films: films alone. Takes the program GNOMON and
Debian's ffmpeg.

Of each entry: its picture, the truth of the same view, and a picture of where it fails; by `gnomon compare` its error, and what it
takes beside the view's plain `hard` in the same run. The page has the commands, and the words that stand for each view.
Exit status 1 when a command fails, or a film cannot be made smaller than 1 MB.
"""

import argparse
import json
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from sources import project_root

SIZE = "400x225"
TEXELS = "4194304"
SAMPLES = "64"
LARGEST_FILM = 1_000_000  # bytes
BEGINS, ENDS = "<!-- what tools/make_gallery.py writes begins -->", "<!-- and ends -->"
CHOICES = {"filter": "Filters: what a texel stores and how it is tested", "partition": "Partitions: how receivers are divided among frustums",
           "fit": "Fits: how one frustum's projection is shaped", "soften": "On the screen", "motion": "Under a moving camera or sun"}


class Failed(Exception):
    pass


def run(command: list) -> str:
    ran = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        said = ran.stderr.strip().splitlines()[-1:] or [f"exit status {ran.returncode}"]
        raise Failed(f"{shlex.join(str(word) for word in command)}: {said[0]}")
    return ran.stdout


def encode(*arguments) -> None:
    run(["ffmpeg", "-nostdin", "-v", "error", "-y", *arguments])


class Gallery:
    def __init__(self, gnomon: Path, docs: Path, listed: dict, size: str):
        self.gnomon = gnomon
        self.docs = docs
        self.views = listed["views"]
        self.size = size

    def words_of(self, command: str, view: str, more: list[str]) -> list[str]:
        """The arguments after the program."""
        return [command, self.views[view]["scene"], *self.views[view]["arguments"], "--size", self.size, *more]

    def picture(self, name: str, words: list[str]) -> None:
        """docs/gallery/NAME.jpg, drawn by these words."""
        with tempfile.TemporaryDirectory() as kept:
            drawn = Path(kept) / "picture.png"
            run([self.gnomon, *words, "-o", drawn])
            (self.docs / "gallery").mkdir(parents=True, exist_ok=True)
            encode("-i", drawn, "-q:v", "2", "-map_metadata", "-1", "-bitexact", self.docs / "gallery" / f"{name}.jpg")

    def shown(self, part: dict) -> list[str]:
        return self.words_of("render", part["view"], ["--texels", TEXELS, "--technique", part["technique"], *part.get("arguments", [])])

    def truth(self, view: str) -> list[str]:
        return self.words_of("render", view, ["--truth", "area", "--samples", SAMPLES])

    def comparison(self, entry: dict) -> list[str]:
        base = self.views[entry["view"]]["base"]
        both = base if base == entry["technique"] else f"{base},{entry['technique']}"
        return self.words_of("compare", entry["view"], ["--texels", TEXELS, "--techniques", both, "--samples", SAMPLES, "--repetitions", "3", *entry.get("arguments", [])])

    def figures(self, entry: dict) -> str:
        """How far it is from the truth, and what it costs."""
        results = json.loads(run([self.gnomon, *self.comparison(entry), "--json", "-"]))["results"]
        own = result_of(results, entry["technique"])
        base = result_of(results, self.views[entry["view"]]["base"])
        ratio = stages(own) / stages(base)
        texels = own["map"]["texels"]
        maps = f"{texels / 1024 / 1024:.2g} Mi texels" if texels else "no map"
        times = f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.2g}"
        return f"rmse {own['error']['rmse']:.3f}, {times} times `hard`'s time, {maps}"

    def draw(self, entry: dict) -> str:
        """Draws an entry and returns its part of the page."""
        name = f"{entry['choice']}-{entry['name']}"
        about = next(value for choice in self.list_of_values() if choice["choice"] == entry["choice"]
                     for value in choice["values"] if value["name"] == entry["name"])
        self.picture(name, self.shown(entry))
        self.picture(f"{name}-fails", self.shown(entry["fails"]))
        page = about["page"].removeprefix("docs/")
        lines = [f"### `{entry['name']}`", "", f"{about['summary'][0].upper()}{about['summary'][1:]}. [More]({page})", "",
                 f"| ![{entry['name']}](gallery/{name}.jpg) | ![traced](gallery/truth-{entry['view']}.jpg) | ![{entry['name']} failing](gallery/{name}-fails.jpg) |",
                 "|---|---|---|", f"| {self.figures(entry)}: {of(entry)} | truth | {entry['fails']['words']} {of(entry['fails'])} |", ""]
        return "\n".join(lines)

    def views_text(self) -> str:
        """The views as a table: what stands for their names in the page's commands."""
        rows = [f"| `{name}` | `{shlex.join([view['scene'], *view['arguments']])}` | `{view['base']}` |" for name, view in self.views.items()]
        return "\n".join(["## Views", "", "| view | its words | its plain `hard` |", "|---|---|---|", *rows, ""])

    def list_of_values(self) -> list[dict]:
        if not hasattr(self, "values"):
            self.values = json.loads(run([self.gnomon, "list", "--json"]))["choices"]
        return self.values

    def film_commands(self, film: dict) -> list[list[str]]:
        return [["render", film["scene"], *film["arguments"], "--size", film["size"], "--technique", technique] for technique in film["techniques"]]

    def film(self, film: dict) -> None:
        """docs/films/NAME.webm and .png."""
        with tempfile.TemporaryDirectory() as kept:
            inputs = []
            for i, words in enumerate(self.film_commands(film)):
                frames = Path(kept) / str(i)
                run([self.gnomon, *words, "-o", frames])
                inputs += ["-framerate", film["fps"], "-pattern_type", "glob", "-i", frames / "*.png"]
            beside = "[0:v][1:v]hstack" if len(film["techniques"]) == 2 else "[0:v]null"
            folder = self.docs / "films"
            folder.mkdir(parents=True, exist_ok=True)
            encode_small(folder / f"{film['name']}.webm", [(crf,) for crf in (32, 38, 44)], lambda crf: [
                *inputs, "-filter_complex", f"{beside},format=yuv420p", "-c:v", "libvpx-vp9", "-b:v", "0", "-crf", crf, "-row-mt", "1", "-bitexact"])
            # GitHub shows no video by its name, but a moving PNG: of fewer colours, frames and pixels.
            encode_small(folder / f"{film['name']}.png", [(12, 1.0, 96), (12, 0.75, 64), (8, 0.75, 48), (6, 0.6, 32)], lambda fps, scale, colours: [
                *inputs, "-filter_complex", f"{beside},fps={fps},scale=trunc(iw*{scale}/2)*2:-2:flags=lanczos,split[a][b];"
                f"[a]palettegen=max_colors={colours}[p];[b][p]paletteuse=dither=none", "-f", "apng", "-plays", "0", "-bitexact"])

    def film_text(self, film: dict) -> str:
        """Its part of the page."""
        lines = [f"### {film['words']}", "", f"![{film['name']}](films/{film['name']}.png)", "", "```"]
        return "\n".join([*lines, *("build/gnomon " + shlex.join(words) + f" -o out/{film['name']}" for words in self.film_commands(film)), "```", ""])


def of(part: dict) -> str:
    """The view and the technique that a picture shows."""
    return f"`{part['view']}`, `{' '.join([part['technique'], *part.get('arguments', [])])}`"


def encode_small(file: Path, ways: list[tuple], arguments) -> None:
    """By the first of these ways that makes it small enough."""
    for way in ways:
        encode(*arguments(*way), file)
        if file.stat().st_size < LARGEST_FILM:
            return
    raise Failed(f"{file.name}: {file.stat().st_size} bytes; make the film shorter or smaller")


def stages(result: dict) -> float:
    """Milliseconds of all that makes the mask."""
    return sum(result["time_ms"][stage] or 0.0 for stage in ("maps", "filter", "mask"))


def result_of(results: list[dict], technique: str) -> dict:
    """The row of a technique, which is written out in full there and stands where its error puts it."""
    wanted = set(technique.split("+"))
    for one in results:
        if wanted <= set(one["technique"].split("+")) | set(one["choices"].values()):
            return one
    raise Failed(f"no row for {technique} among {', '.join(one['technique'] for one in results)}")


def page_with(text: str, made: str) -> str:
    """The page with what was made between its marks."""
    found = re.search(re.escape(BEGINS) + r".*?" + re.escape(ENDS), text, re.DOTALL)
    if not found:
        raise Failed(f"gallery.md: no {BEGINS} ... {ENDS}")
    return text[:found.start()] + f"{BEGINS}\n{made.strip()}\n{ENDS}" + text[found.end():]


def main() -> int:
    parser = argparse.ArgumentParser(description="Draws the gallery of docs/gallery.md.")
    parser.add_argument("--only", default="", metavar="TEXT", help="entries and films whose names hold TEXT, and nothing of the page")
    parser.add_argument("--size", default=SIZE, metavar="WxH", help=f"of the pictures ({SIZE})")
    films = parser.add_mutually_exclusive_group()
    films.add_argument("--no-films", action="store_true", help="pictures and page, with the films that there are")
    films.add_argument("--films", action="store_true", help="films alone")
    parser.add_argument("gnomon", type=Path, help="the program")
    parser.add_argument("docs", type=Path, nargs="?", default=project_root() / "docs", help="where it goes (docs)")
    options = parser.parse_args()
    if not shutil.which("ffmpeg"):
        parser.error("there is no ffmpeg; run tools/install_packages.sh --only site packages.txt")
    listed = json.loads((project_root() / "docs/gallery.json").read_text(encoding="utf-8"))
    gallery = Gallery(options.gnomon.resolve(), options.docs, listed, options.size)
    entries = [] if options.films else [one for one in listed["entries"] if options.only in f"{one['choice']}-{one['name']}"]
    films = [one for one in listed["films"] if options.only in one["name"]]
    try:
        for view in sorted({one["view"] for one in entries}):
            gallery.picture(f"truth-{view}", gallery.truth(view))
        parts = {}
        for entry in entries:
            print(f"{entry['choice']} {entry['name']}", file=sys.stderr)
            parts.setdefault(entry["choice"], []).append(gallery.draw(entry))
        for film in [] if options.no_films else films:
            print(f"film {film['name']}", file=sys.stderr)
            gallery.film(film)
        if not (options.only or options.films):
            made = [*(f"## {CHOICES[choice]}\n\n" + "\n".join(text) for choice, text in parts.items()),
                    gallery.views_text(), "## Films\n\n" + "\n".join(gallery.film_text(film) for film in films)]
            page = options.docs / "gallery.md"
            page.write_text(page_with(page.read_text(encoding="utf-8"), "\n".join(made)), encoding="utf-8")
    except Failed as failure:
        print(failure, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
