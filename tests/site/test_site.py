#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The site in a browser, on a desktop and on a phone: it asks for nothing outside, fits, can be searched, and shows its films.

usage: test_site.py ROOT [RESULTS.json]

A copy of the project is built, with one film more. Without Chromium or what builds the site nothing is tested, which is said; exit
status 77.
"""

import functools
import http.server
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
RESULTS = Path(sys.argv[2]) if len(sys.argv) > 2 else None
sys.path.insert(0, str(ROOT / "tests/page"))

from browser import Browser, find_chromium  # noqa: E402
from recorder import run_cases  # noqa: E402

DESKTOP, PHONE = (1280, 800), (390, 844)
PAGES = ("index.html", "docs/techniques/pcf.html", "docs/gallery.html", "docs/measurements.html", "reference.html", "api/structgnomon_1_1Frame.html",
         "api/options_8h.html", "source/lab/metrics/error.h.html")
MARK = "<!-- and ends -->"


def copy_of_project(folder: Path) -> Path:
    """With a film on the gallery's page."""
    def left_out(at: str, names: list[str]) -> list[str]:
        return [name for name in names if name in (".git", "out", "__pycache__") or (Path(at) == ROOT and name.startswith("build"))]

    project = folder / "project"
    shutil.copytree(ROOT, project, ignore=left_out)
    films = project / "docs/films"
    films.mkdir(exist_ok=True)
    for name, more in (("test.webm", ["-c:v", "libvpx-vp9"]), ("test.png", ["-f", "apng"])):
        subprocess.run(["ffmpeg", "-nostdin", "-v", "error", "-f", "lavfi", "-i", "testsrc=size=64x36:rate=12:duration=1", *more, films / name], check=True)
    page = project / "docs/gallery.md"
    page.write_text(page.read_text(encoding="utf-8").replace(MARK, f"![A film](films/test.png)\n{MARK}"), encoding="utf-8")
    return project


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        folder = Path(cls.kept.name)
        cls.project = copy_of_project(folder)
        ran = subprocess.run([sys.executable, "-B", cls.project / "tools/make_site.py", folder / "site"], capture_output=True, text=True, check=False)
        if ran.returncode != 0:
            raise RuntimeError(ran.stderr)
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder / "site"))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.address = f"http://127.0.0.1:{cls.server.server_port}/"
        cls.browser = Browser(find_chromium())

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.server.shutdown()
        cls.server.server_close()
        cls.kept.cleanup()

    def show(self, page: str, size: tuple[int, int] = DESKTOP, dark: bool = False) -> Browser:
        self.browser.screen(*size, phone=size == PHONE, dark=dark)
        self.browser.visit(self.address + page)
        return self.browser

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])
        self.assertEqual([one for one in self.browser.requests if not one.startswith((self.address, "blob:" + self.address))], [], "asked for outside")

    def test_pages_fit_and_ask_for_nothing_outside(self):
        for page in PAGES:
            for size in (DESKTOP, PHONE):
                browser = self.show(page, size, dark=size == PHONE)
                self.assertEqual(browser.problems, [], page)
                self.assertEqual([one for one in browser.requests if not one.startswith(self.address)], [], page)
                self.assertLessEqual(browser.run("document.documentElement.scrollWidth"), size[0], page)
                self.assertTrue(browser.run("document.querySelector('h1, .title, #projectname').textContent.trim().length > 0"), page)

    def test_pictures_are_there(self):
        browser = self.show("docs/techniques/pcf.html")
        browser.run("document.querySelectorAll('img').forEach(one => one.scrollIntoView())")
        self.assertGreater(browser.run("document.querySelectorAll('article img').length"), 0)
        browser.wait_for("[...document.querySelectorAll('article img')].every(one => one.complete && one.naturalWidth > 0)")

    def test_films_play(self):
        browser = self.show("docs/gallery.html")
        films = list((self.project / "docs/films").glob("*.webm"))
        self.assertGreater(len(films), 0)
        self.assertEqual(browser.run("document.querySelectorAll('video').length"), len(films))
        browser.wait_for("[...document.querySelectorAll('video')].every(one => one.duration > 0.5)")
        # A browser plays by itself what it shows.
        for i in range(len(films)):
            browser.run(f"document.querySelectorAll('video')[{i}].scrollIntoView()")
            browser.wait_for(f"document.querySelectorAll('video')[{i}].currentTime > 0")

    def test_search_finds_a_technique(self):
        browser = self.show("index.html")
        browser.run("document.querySelector('.md-search__input').focus()")
        browser.wait_for("document.querySelector('.md-search-result__meta').textContent.includes('Type')")  # the index is there
        browser.call("Input.insertText", text="percentage-close")
        browser.key("r")  # it listens to keys
        browser.wait_for("document.querySelectorAll('.md-search-result__link').length > 0")
        found = browser.run("[...document.querySelectorAll('.md-search-result__link')].map(one => one.pathname)")
        self.assertIn("/docs/techniques/pcf.html", found)

    def test_reference_answers_and_leads_back(self):
        browser = self.show("reference.html")
        there = browser.run("[...document.querySelectorAll('article a')].find(one => one.pathname === '/api/planner_8h.html').href")
        browser.visit(there)
        browser.wait_for("typeof searchBox === 'object'")
        self.assertTrue(browser.run("document.body.textContent.includes('Planner')"))
        self.assertEqual(browser.run("document.querySelector('#projectname a').href"), self.address + "index.html")

    def test_colours_are_those_of_the_reports(self):
        grounds = [self.show("index.html", dark=dark).run("getComputedStyle(document.body).backgroundColor") for dark in (False, True)]
        self.assertEqual(grounds, ["rgb(246, 244, 239)", "rgb(18, 20, 26)"])


def main() -> int:
    lacking = [name for name in ("doxygen", "mkdocs", "ffmpeg") if not shutil.which(name)]
    if find_chromium() is None:
        lacking.append("chromium")
    if lacking:
        print(f"SKIPPED: there is no {', no '.join(lacking)} (packages.txt, section site), so the site was not looked at", file=sys.stderr)
        return 77
    return run_cases(Site, RESULTS)


if __name__ == "__main__":
    sys.exit(main())
