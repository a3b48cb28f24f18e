#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What builds the site finds what is wrong: a public name without documentation, a link that leads nowhere, a page that asks the
network for something.

usage: test_make_site.py ROOT
"""

import shutil
import sys
import tempfile
import unittest
from pathlib import Path, PurePosixPath

ROOT = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tools"))

import make_site  # noqa: E402
from doxygen_filter import filtered  # noqa: E402
from site_pages import Pages  # noqa: E402

HEADER = """// SPDX-License-Identifier: Apache-2.0
// What a file is for.
#pragma once
namespace gnomon {
/// A thing.
struct Thing {
    double side_m = 1.0; // metres, > 0
    int count = 0;       // of them,
                         // and more of that
    Thing(const Thing&) = delete;
    ~Thing();
    bool operator==(const Thing&) const = default;
};
} // namespace gnomon
"""


class Folder(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)

    def write(self, name: str, text: str) -> None:
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


class Filter(unittest.TestCase):
    def test_comments_behind_members_are_documentation(self):
        lines = filtered(HEADER, is_glsl=False).splitlines()
        self.assertEqual(len(lines), len(HEADER.splitlines()))
        self.assertEqual(lines[:2], ["/// @file", "/// What a file is for."])
        self.assertIn("    double side_m = 1.0; ///< metres, > 0", lines)
        self.assertIn("                         ///< and more of that", lines)
        self.assertTrue(any(line.endswith("= delete; ///< Not to be copied.") for line in lines))

    def test_nothing_but_comments_and_private_parts_changes(self):
        for file in (ROOT / "core/include/gnomon").glob("*.h"):
            text = file.read_text(encoding="utf-8")
            private = False
            for was, now in zip(text.splitlines(), filtered(text, is_glsl=False).splitlines(), strict=True):
                private = (private or was == "private:") and not was.startswith("};")
                self.assertEqual(now.split("//")[0].rstrip(), "" if private else was.split("//")[0].rstrip(), file)

    def test_comments_before_glsl_functions_are(self):
        text = "// SPDX\n// F.\n#ifndef X\n// Gives one.\nfloat one()\n{\n    // Within.\n    return 1.0;\n}\n"
        self.assertIn("/// Gives one.\nfloat one()", filtered(text, is_glsl=True))
        self.assertIn("    // Within.", filtered(text, is_glsl=True))


@unittest.skipUnless(shutil.which("doxygen"), "there is no doxygen")
class Reference(Folder):
    def make(self, header: str) -> dict[str, str]:
        for name in ("site/Doxyfile", "site/api.css", "app/pages/look.css", "tools/doxygen_filter.py"):
            self.write(name, (ROOT / name).read_text(encoding="utf-8"))
        self.write("core/include/gnomon/thing.h", header)
        for name in ("pack/include", "c/include", "vulkan/include", "vulkan/classics/include", "gl/include"):
            (self.folder / name).mkdir(parents=True)
        for name in ("visibility", "smooth_surface", "caster", "compact_mask"):
            self.write(f"shaders/include/gnomon/{name}.glsl", "// SPDX\n// F.\n")
        self.write("site/namespaces.dox", "// SPDX\n\n/// @namespace gnomon\n/// All.\n")
        return make_site.make_api(self.folder, self.folder / "out/api")

    def test_it_is_made(self):
        self.assertEqual(self.make(HEADER)["core/include/gnomon/thing.h"], "thing_8h.html")
        self.assertIn("metres, &gt; 0", (self.folder / "out/api/structgnomon_1_1Thing.html").read_text(encoding="utf-8"))

    def test_a_name_without_documentation_is_an_error(self):
        with self.assertRaisesRegex(make_site.Failed, "side_m"):
            self.make(HEADER.replace(" // metres, > 0", ""))


class Links(Folder):
    def page(self, text: str) -> str:
        for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/a.md", "docs/images/a.png", "docs/images/a.jpg", "docs/films/f.png", "docs/films/f.webm", "core/x.h", "core/y.h"):
            self.write(name, "")
        pages = Pages(self.folder, self.folder / "out", {"core/x.h": "x_8h.html"})
        made = pages.page(text, PurePosixPath("docs/a.md"), PurePosixPath("docs/a.md"))
        self.sources = {str(source) for source in pages.sources}
        return made

    def test_links_lead_to_what_the_site_has(self):
        self.assertEqual(self.page("[r](../README.md#more) ![p](images/a.png) ![j](images/a.jpg)"),
                         "[r](../README.md#more) ![p](images/a.png) ![j](images/a.jpg)")
        self.assertEqual(self.page("[x](../core/x.h)"), "[x](../api/x_8h.html)")
        self.assertEqual(self.page("[y](../core/y.h#L1) [core](../core)"), "[y](../source/core/y.h.md#L1) [core](../source/core/index.md)")
        self.assertEqual(self.sources, {"core/y.h", "core"})

    def test_what_is_not_there_stays_for_mkdocs_to_find(self):
        self.assertEqual(self.page("[z](../core/z.h)"), "[z](../core/z.h)")

    def test_code_is_left_alone(self):
        text = "```\n[x](../core/x.h)\n```"
        self.assertEqual(self.page(text), text)

    def test_a_film_is_a_video(self):
        self.assertIn('<video src="films/f.webm"', self.page("![Suns](films/f.png)"))

    def test_lists_get_the_line_that_they_need(self):
        self.assertEqual(self.page("So:\n- a\n- b"), "So:\n\n- a\n- b")


class Faults(Folder):
    def test_they_are_found(self):
        self.write("a.html", '<h1 id="top"></h1><a href="b.html#here">b</a><a href="#top">up</a><a href="https://example.org">out</a>')
        self.write("b.html", '<p id="here"></p>')
        self.assertEqual(make_site.faults_of(self.folder), [])
        self.write("b.html", '<p id="there"></p><img src="c.png"><script src="https://example.org/x.js"></script>')
        self.assertEqual(make_site.faults_of(self.folder), ["a.html: b.html#here has no such place", "b.html: c.png is not there",
                                                            "b.html: would load https://example.org/x.js"])


if __name__ == "__main__":
    unittest.main()
