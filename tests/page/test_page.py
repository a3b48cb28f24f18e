#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pages of reports do in a browser what they are there for, on a desktop and on a phone.

usage: test_page.py GNOMON [RESULTS.json]

RESULTS.json gets what became of each case, in the form of googletest, for tools/cases.py. Without Chromium nothing is tested, which is
said; exit status 77.
"""

import json
import shutil
import sys
import tempfile
import time
import unittest
from pathlib import Path

from browser import Browser, find_chromium
from recorder import run_cases
from reports import HOSTILE, RUNS, Reports

GNOMON = Path(sys.argv[1]).resolve()
RESULTS = Path(sys.argv[2]) if len(sys.argv) > 2 else None
DESKTOP, PHONE = (1280, 800), (390, 844)
READY = "[...document.querySelectorAll('canvas[data-shows], .pane img')].length > 0 && document.querySelector('canvas[data-shows]') !== null"
TRANSFORMS = "[...document.querySelectorAll('.layer > *')].map(e => e.style.transform)"
SHOWN = "document.querySelector('.stage .over canvas').toDataURL()"


def box_of(selector: str) -> str:
    return f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; }})()"


def front_of(results: list[dict]) -> list[int]:
    """By the definition: nobody else is as good in both and better in one."""
    points = [(one["time_ms"]["frame"], one["error"]["rmse"]) for one in results]
    return [i for i, (t, e) in enumerate(points) if not any(a <= t and b <= e and (a, b) != (t, e) for a, b in points)]


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.reports = Reports(GNOMON, Path(cls.kept.name))
        cls.browser = Browser(find_chromium())

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.kept.cleanup()

    def tearDown(self):
        self.assertEqual(self.browser.problems, [], "what the test did threw something")

    def show(self, name: str, size: tuple[int, int] = DESKTOP, **screen) -> Browser:
        self.browser.screen(*size, phone=size == PHONE, **screen)
        self.browser.open(self.reports.page(name))
        if name not in ("bench", "scenes"):
            self.browser.wait_for(READY)
        return self.browser

    def middle(self, selector: str) -> tuple[float, float]:
        self.browser.run(f"document.querySelector({json.dumps(selector)}).scrollIntoView({{block: 'center', behavior: 'instant'}})")
        left, top, width, height = self.browser.run(box_of(selector))
        return left + width / 2, top + height / 2

    def test_nothing_is_asked_for_and_nothing_goes_wrong(self):
        for name in RUNS:
            for size in (DESKTOP, PHONE):
                browser = self.show(name, size, dark=size == PHONE)
                self.assertEqual(browser.problems, [], name)
                self.assertEqual(browser.requests, [], name)
        # The observer would have seen it.
        browser.run("console.error('planted'); fetch('https://example.org/').catch(() => 0)")
        browser.run("new Promise(done => { const i = new Image(); i.onerror = done; i.src = './beside.png'; })")
        self.assertIn("planted", browser.problems)
        self.assertTrue(any("Content Security Policy" in problem for problem in browser.problems), browser.problems)
        browser.problems.clear()

    def test_a_page_alone_shows_its_pictures(self):
        with tempfile.TemporaryDirectory() as elsewhere:
            page = Path(elsewhere) / "moved.html"
            shutil.copy(self.reports.page("compare"), page)
            self.browser.screen(*DESKTOP)
            self.browser.open(page)
            self.browser.wait_for(READY)
            self.browser.wait_for("[...document.querySelectorAll('.pane img')].filter(i => i.closest('figure').hidden === false).every(i => i.naturalWidth === 160)")
            self.assertEqual(self.browser.problems, [])

    def test_no_page_is_wider_than_its_screen(self):
        for name in RUNS:
            for size in (DESKTOP, PHONE):
                browser = self.show(name, size)
                self.assertLessEqual(browser.run("document.documentElement.scrollWidth"), size[0], (name, size))
                for frame, seen in browser.run("[...document.querySelectorAll('.table-frame')].map(f => [f.scrollWidth, f.clientWidth])"):
                    self.assertLessEqual(frame, seen, (name, size))
                self.assertEqual(browser.run("[...document.querySelectorAll('tbody tr:not([hidden]) > *')].filter(c => { const b = c.getBoundingClientRect(); "
                                             "return b.width === 0 || b.right > innerWidth || b.left < 0; }).length"), 0, (name, size))

    def test_the_first_screen_says_who_has_won(self):
        browser = self.show("compare")
        best = self.reports.result("compare")["results"][0]
        self.assertIn(f"{best['error']['rmse']:.4f}", browser.run("document.querySelector('.first-prize').textContent"))
        self.assertEqual(browser.run("document.querySelector('.first-prize .who').textContent"), browser.run("data.names[0]"))
        for selector in ("h1", ".stage", ".slide", ".first-prize"):
            _, top, _, height = browser.run(box_of(selector))
            self.assertLess(top + height, DESKTOP[1], selector)

    def test_the_slider_moves_the_border(self):
        browser = self.show("compare")
        clip = "document.querySelector('.over').style.clipPath"
        self.assertEqual(browser.run(clip), "inset(0px 50% 0px 0px)")
        browser.run("document.querySelector('.slide').focus()")
        for _ in range(10):
            browser.key("ArrowRight")
        self.assertEqual(browser.run(clip), "inset(0px 49% 0px 0px)")
        left, _, width, _ = browser.run(box_of(".stage"))
        x, y = self.middle(".divider")
        browser.drag((x, y), (left + 0.2 * width, y))
        self.assertAlmostEqual(float(browser.run("document.querySelector('.slide').value")), 20.0, delta=1.0)
        self.assertIn("20 % ", browser.run("document.querySelector('.slide').getAttribute('aria-valuetext')"))

    def test_all_pictures_zoom_and_move_together(self):
        browser = self.show("compare")
        before = browser.run(TRANSFORMS)
        self.assertEqual(len(before), 2 + 6)
        x, y = self.middle(".stage")
        browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-200)
        time.sleep(0.05)
        self.assertEqual(browser.run("view.scale"), 1, "nobody gave the wheel to the picture")
        browser.click(x, y - 60)
        x, y = self.middle(".stage")
        browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-400)
        browser.wait_for("view.scale > 1.5")
        zoomed = browser.run(TRANSFORMS)
        self.assertEqual(len(set(zoomed)), 1)
        self.assertNotEqual(zoomed[0], before[0])
        start = browser.run("view.x")
        x, y = self.middle(".grid figure:nth-child(4) .pane")
        browser.drag((x, y), (x + 30, y))
        self.assertGreater(browser.run("view.x"), start, "another picture is dragged")
        self.assertEqual(len(set(browser.run(TRANSFORMS))), 1)
        browser.key("0")
        self.assertEqual(browser.run("[view.scale, view.x, view.y]"), [1, 0, 0])
        browser.key("+")
        self.assertGreater(browser.run("view.scale"), 1)
        start = browser.run("view.x")
        browser.key("ArrowRight")
        self.assertLess(browser.run("view.x"), start)

    def test_two_fingers_zoom_on_a_phone(self):
        browser = self.show("compare", PHONE)
        x, y = self.middle(".stage")
        browser.touch([(x - 80, y), (x - 20, y)], [(x - 100, y), (x, y)], [(x - 120, y), (x + 20, y)])
        browser.wait_for("view.scale > 1.8")
        start = browser.run("view.y")
        x, y = self.middle(".grid figure:nth-child(2) .pane")
        browser.touch([(x, y)], [(x, y + 10)], [(x, y + 25)])
        browser.wait_for(f"view.y > {start}")
        self.assertEqual(len(set(browser.run(TRANSFORMS))), 1)

    def test_a_row_chooses_the_pictures(self):
        browser = self.show("compare")
        before = browser.run(SHOWN)
        browser.click(*self.middle("#techniques tbody tr:nth-child(4) td"))
        browser.wait_for(f"{SHOWN} !== {json.dumps(before)}")
        self.assertEqual(browser.run("chosen.technique"), 3)
        self.assertEqual(browser.run("document.querySelectorAll('tr[data-picked]').length"), 1)
        name = browser.run("data.names[3]")
        self.assertEqual(browser.run("document.querySelector('.tag.left').textContent"), name)
        self.assertEqual(browser.run("document.querySelector('#chosen .who').textContent"), name)
        self.assertTrue(browser.run("[...document.querySelectorAll('.pane img')].every(i => [frames[0].truth, ...Object.values(frames[0].techniques[3]), "
                                    "...frames[0].densities].includes(i.src))"))
        browser.run("document.querySelector('#techniques tbody tr:nth-child(2) th button').focus()")
        browser.key("Enter")
        browser.wait_for("chosen.technique === 1")

    def test_the_table_sorts_and_filters(self):
        browser = self.show("compare")
        results = self.reports.result("compare")["results"]
        rows = "[...document.querySelectorAll('#techniques tbody tr:not([hidden])')].map(r => Number(r.dataset.row))"
        column = browser.run("[...document.querySelectorAll('#techniques thead th')].findIndex(h => h.textContent === 'ms') + 1")
        head = f"#techniques thead th:nth-child({column})"
        browser.click(*self.middle(head + " button"))
        by_time = sorted(range(len(results)), key=lambda i: (round(results[i]["time_ms"]["frame"], 2), i))
        self.assertEqual(browser.run(rows), by_time)
        self.assertEqual(browser.run(f"document.querySelector({json.dumps(head)}).getAttribute('aria-sort')"), "ascending")
        browser.click(*self.middle(head + " button"))
        self.assertEqual(browser.run(rows), sorted(by_time, key=lambda i: -round(results[i]["time_ms"]["frame"], 2)))
        browser.run("sortBack(document.getElementById('techniques'))")

        def kept(query: str) -> list[int]:
            browser.run(f"(() => {{ const s = document.querySelector('#numbers input[type=search]'); s.value = {json.dumps(query)}; s.dispatchEvent(new Event('input')); }})()")
            return browser.run(rows)

        self.assertEqual(kept("pcf"), [i for i, one in enumerate(results) if "pcf" in one["technique"]])
        bound = round(results[2]["error"]["rmse"], 4)
        self.assertEqual(kept(f"rmse<{bound}"), [i for i, one in enumerate(results) if round(one["error"]["rmse"], 4) < bound])
        self.assertEqual(kept("pcf rmse>9"), [])
        self.assertIn("0 of 5", browser.run("document.querySelector('#numbers .count').textContent"))
        kept("")
        browser.click(*self.middle("#numbers input[type=checkbox]"))
        self.assertEqual(browser.run(rows), sorted(front_of(results)))

    def test_the_front_is_marked(self):
        browser = self.show("compare")
        results = self.reports.result("compare")["results"]
        front = sorted(front_of(results), key=lambda i: results[i]["time_ms"]["frame"])
        self.assertEqual(browser.run("charts[0].chart.data.datasets[0].data.map(p => p.index)"), front)
        self.assertEqual(browser.run("charts[0].chart.data.datasets[0].data.map(p => p.label)"), [str(i + 1) for i in range(len(front))])
        self.assertEqual(browser.run("charts[0].chart.data.datasets[1].data.length"), len(results) - len(front))
        self.assertEqual(browser.run("[...document.querySelectorAll('.front-list button')].map(b => b.textContent)"), browser.run(f"{front}.map(i => data.names[i])"))
        browser.run(f"choose({{technique: {next(i for i in range(len(results)) if i != front[0])}}})")
        self.middle(".chart canvas")
        place = browser.run("(() => { const c = charts[0].chart, b = c.canvas.getBoundingClientRect(), p = c.getDatasetMeta(0).data[0]; return [b.left + p.x, b.top + p.y]; })()")
        browser.click(*place)
        browser.wait_for(f"chosen.technique === {front[0]}")
        self.assertEqual(browser.run("paretoFront([[1, 3], [2, 3], [2, 2], [3, 2.5], [4, NaN], [9, 1]].map(([time, error], i) => ({time, error, i}))).map(p => p.i)"), [0, 2, 5])

    def test_classes_are_those_of_the_result(self):
        browser = self.show("compare")
        results = self.reports.result("compare")["results"]
        bars = browser.run("charts[1].chart.data.datasets.map(s => s.data)")
        for i, one in enumerate(results):
            self.assertAlmostEqual(sum(bar[i] for bar in bars), one["error"]["rmse"] ** 2)

    def test_a_row_can_be_had_again(self):
        for name, rows in (("compare", 2), ("hostile", 1), ("path", 1)):
            browser = self.show(name)
            for i, one in enumerate(self.reports.result(name)["results"][:rows]):
                command = browser.run(f"(choose({{technique: {i}}}), document.querySelector('#chosen code').textContent)")
                self.assertEqual(command, one["command"])
                again = json.loads(self.reports.run(command + " --json"))["results"]
                self.assertEqual([(r["technique"], r["error"]) for r in again], [(one["technique"], one["error"])], command)
        self.assertFalse((self.reports.folder / "hit").exists(), "the shell ran a name")
        result = self.reports.result("sweep")["sweep"]["results"][1]
        command = self.show("sweep").run("document.querySelector('#techniques tbody tr:nth-child(5) .copy').title")
        self.assertEqual(json.loads(self.reports.run(command + " --json"))["results"][0]["error"]["rmse"], result["rmse"][1])
        command = self.show("bench").run("document.querySelector('#techniques tbody tr:nth-child(2) .copy').title")
        self.assertEqual(json.loads(self.reports.run(command + " --json"))["results"][0]["technique"], self.reports.result("bench")["results"][1]["technique"])

    def test_a_command_is_copied(self):
        browser = self.show("compare")
        browser.call("Browser.grantPermissions", permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])
        browser.click(*self.middle("#chosen .copy"))
        browser.wait_for("document.querySelector('#chosen .copy').textContent === 'Copied'")
        self.assertEqual(browser.run("navigator.clipboard.readText()"), self.reports.result("compare")["results"][0]["command"])

    def test_a_name_is_text(self):
        browser = self.show("hostile")
        self.assertEqual(browser.run("[typeof hit, document.querySelectorAll('[onerror], img:not(.layer *)').length]"), ["undefined", 0])
        self.assertEqual(browser.run("document.querySelector('h1').textContent"), f"Shadows of {HOSTILE}")

    def test_frames_of_a_path(self):
        browser = self.show("path")
        results = self.reports.result("path")["results"]
        before = browser.run("document.querySelector('.grid img').src")
        browser.click(*self.middle("input[name=frame][value='2']"))
        browser.wait_for("chosen.frame === 2")
        self.assertNotEqual(browser.run("document.querySelector('.grid img').src"), before)
        self.assertIn("frame 6", browser.run("document.querySelector('input[name=frame][value=\"2\"]').parentElement.textContent"))
        for chart, key in ((2, "rmse"), (3, "mean_abs_change")):
            drawn = browser.run(f"charts[{chart}].chart.data.datasets.map(s => s.data.map(p => p.y))")
            self.assertEqual(drawn, [one["over_frames"][key] for one in results])
            self.assertEqual(browser.run(f"charts[{chart}].chart.data.datasets[0].data.map(p => p.x)"), [3, 4, 5, 6])

    def test_values_of_a_sweep(self):
        browser = self.show("sweep")
        sweep = self.reports.result("sweep")["sweep"]
        self.assertEqual(browser.run("charts[0].chart.data.datasets.map(s => s.data.map(p => [p.x, p.y]))"),
                         [[list(point) for point in zip(sweep["values"], line["rmse"])] for line in sweep["results"]])
        self.assertEqual(browser.run("document.querySelectorAll('#techniques tbody tr').length"), 6)
        self.assertEqual(browser.run("charts.length"), 1 + len(sweep["results"]))

    def test_several_scenes(self):
        browser = self.show("scenes")
        result = self.reports.result("scenes")
        self.assertEqual(browser.run("charts[0].chart.data.datasets.map(s => s.data)"),
                         [[one["rmse"][k] for one in result["techniques"]] for k in range(2)])
        self.assertEqual(browser.run("charts[1].chart.data.labels"), ["planes", "canopies"])
        for i, one in enumerate(result["techniques"]):
            browser.run(f"document.querySelectorAll('#techniques tbody th button')[{i}].click()")
            edges = [next(r for r in scene["result"]["results"] if r["technique"] == one["technique"])["error"]["edge"] for scene in result["scenes"]]
            self.assertEqual(browser.run("charts[1].chart.data.datasets[0].data"), edges)
        best = [min(result["techniques"], key=lambda one: one["rmse"][k])["rmse"][k] for k in range(2)]
        self.assertEqual(browser.run("[...document.querySelectorAll('#techniques td.best')].map(c => c.textContent)").__len__(), 3)
        for k, least in enumerate(best):
            self.assertIn(f"{least:.4f}", browser.run(f"[...document.querySelectorAll('#techniques tr > :nth-child({k + 2}).best')].map(c => c.textContent)"))
        links = browser.run("[...document.querySelectorAll('#scenes a')].map(a => decodeURIComponent(new URL(a.href).pathname))")
        self.assertEqual([Path(link).exists() for link in links], [True, True], links)

    def test_passes_of_a_bench(self):
        browser = self.show("bench")
        result = self.reports.result("bench")
        self.assertEqual(browser.run("charts[0].chart.data.labels[0]"), "no shadows")
        bars = browser.run("charts[0].chart.data.datasets.map(s => s.data)")
        for i, one in enumerate([result["baseline"], *result["results"]]):
            frame = max(one["time_ms"]["frame"], sum(p["ms"] for p in one["passes"]))
            self.assertAlmostEqual(sum(bar[i] for bar in bars), frame, places=6)
        self.assertEqual(browser.run("document.querySelectorAll('#techniques tbody tr').length"), len(result["results"]) + 1)
        passes = sum(len(one["passes"]) for one in [result["baseline"], *result["results"]])
        self.assertEqual(browser.run("document.querySelectorAll('#passes tbody tr').length"), passes)

    def test_it_can_be_read(self):
        """WCAG 2: 4.5 to 1 for text, in both colour schemes; every control has a name."""
        contrast = """(() => { const light = c => { const [r, g, b] = c.match(/[\\d.]+/g).map(Number).map(v => v / 255)
            .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
            const probe = document.body.appendChild(document.createElement('p')), of = n => { probe.style.color = `var(--${n})`; return light(getComputedStyle(probe).color); };
            const pairs = [['ink', 'ground'], ['ink', 'panel'], ['ink', 'sunken'], ['ink', 'accent-soft'], ['faint', 'ground'], ['faint', 'panel'], ['faint', 'accent-soft'],
                ['accent', 'panel'], ['accent', 'ground'], ['link', 'panel'], ['link', 'accent-soft'], ['link', 'ground'], ['good', 'panel'], ['good', 'accent-soft'], ['on-accent', 'accent']];
            return pairs.map(([a, b]) => { const [x, y] = [of(a), of(b)].sort((p, q) => q - p); return [a, b, (x + 0.05) / (y + 0.05)]; }); })()"""
        grounds = set()
        for dark in (False, True):
            browser = self.show("compare", dark=dark)
            grounds.add(browser.run("getComputedStyle(document.body).backgroundColor"))
            for text, ground, ratio in browser.run(contrast):
                self.assertGreaterEqual(ratio, 4.5, (dark, text, ground))
        self.assertEqual(len(grounds), 2)
        self.assertEqual(browser.run("[...document.querySelectorAll('button, input, select, .pane, canvas[role=img]')].filter(e => !(e.getAttribute('aria-label') || "
                                     "e.textContent.trim() || e.labels?.length)).map(e => e.outerHTML)"), [])
        browser.run("document.querySelector('.stage').focus()")
        browser.key("Tab")
        self.assertTrue(browser.run("document.activeElement.matches('.slide:focus-visible') && getComputedStyle(document.activeElement).outlineStyle !== 'none'"))
        self.show("compare", still=True)
        self.assertEqual(browser.run("[getComputedStyle(document.documentElement).scrollBehavior, charts[0].chart.options.animation]"), ["auto", False])


def main() -> int:
    if find_chromium() is None:
        print("SKIPPED: there is no Chromium (Debian: chromium), so no page of a report was looked at", file=sys.stderr)
        return 77
    return run_cases(Pages, RESULTS)


if __name__ == "__main__":
    sys.exit(main())
