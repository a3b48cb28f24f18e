#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the site: documents, gallery and API reference, as files that ask no network for anything.

usage: make_site.py [--api] FOLDER

FOLDER is made anew; what the pages are made of lies beside it, in FOLDER-pages. --api: the API reference alone. Takes Debian's
doxygen, mkdocs and mkdocs-material (packages.txt, section site). The playground is a part of it where `make playground` has built it.

Exit status 1 when a public name has no documentation, a page lacks what it links to, mkdocs warns, or a page of the site
links to what is not there.
"""

import argparse
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import urllib.parse
import xml.etree.ElementTree
from pathlib import Path, PurePosixPath

import site_playground
from site_pages import SOURCES, Pages
from sources import project_root

PYTHON = "/usr/bin/python3"  # Debian's, which its mkdocs belongs to
COLOURS = Path("app/pages/look.css")


class Failed(Exception):
    pass


def make_api(root: Path, folder: Path) -> dict[str, str]:
    """Doxygen's pages; by the path of each header its page."""
    folder.mkdir(parents=True)
    tags = folder.parent / f"{folder.name}.tags"
    palette = folder.parent / "colours.css"
    palette.write_text(colours(root), encoding="utf-8")
    settings = (root / "site/Doxyfile").read_text(encoding="utf-8")
    settings += f'\nOUTPUT_DIRECTORY = "{folder}"\nGENERATE_TAGFILE = "{tags}"\nHTML_EXTRA_STYLESHEET = "{palette}" site/api.css\n'
    run = subprocess.run(["doxygen", "-"], input=settings, cwd=root, capture_output=True, text=True, check=False)
    if run.returncode != 0 or run.stderr.strip():
        raise Failed(f"doxygen: {run.stderr.strip() or run.stdout.strip()}")
    pages = {}
    for one in xml.etree.ElementTree.parse(tags).getroot().iterfind("compound[@kind='file']"):
        file = Path((one.findtext("path") or "") + (one.findtext("name") or ""))
        page = one.findtext("filename") or ""
        pages[(file.relative_to(root) if file.is_absolute() else file).as_posix()] = page if page.endswith(".html") else page + ".html"
    tags.unlink()
    palette.unlink()
    return pages


def colours(root: Path) -> str:
    """What the reports' pages have of colours and type, for other pages: the custom properties alone."""
    text = (root / COLOURS).read_text(encoding="utf-8")
    light = re.search(r"^:root \{.*?^\}", text, re.DOTALL | re.MULTILINE)
    dark = re.search(r"^@media \(prefers-color-scheme: dark\) \{\n  :root \{.*?^\}", text, re.DOTALL | re.MULTILINE)
    if not light or not dark:
        raise Failed(f"{COLOURS}: its custom properties are not where they are looked for")
    return f"{light[0]}\n{dark[0]}\n"


def make_pages(root: Path, site: Path) -> None:
    """The whole site."""
    work = site.parent / f"{site.name}-pages"
    shutil.rmtree(work, ignore_errors=True)
    api = make_api(root, work / "docs/api")
    # Its heading leads back.
    for file in (work / "docs/api").glob("*.html"):
        text = file.read_text(encoding="utf-8")
        file.write_text(re.sub(r'(<div id="projectname">)Gnomon', r'\1<a href="../index.html">Gnomon</a>', text), encoding="utf-8")
    pages = Pages(root, work / "docs", api)
    pages.write_documents({PurePosixPath("site/reference.md"): PurePosixPath("reference.md")})
    pages.write_sources()
    pages.write(PurePosixPath("stylesheets/colours.css"), colours(root))
    for name, place in {"site.css": "stylesheets/site.css", "favicon.svg": "favicon.svg"}.items():
        pages.write(PurePosixPath(place), (root / "site" / name).read_text(encoding="utf-8"))
    settings = (root / "site/mkdocs.yml").read_text(encoding="utf-8")
    if site_playground.install(root, work / "docs"):
        settings = site_playground.navigation(settings)
    else:
        print(f"The site is made WITHOUT THE PLAYGROUND: there is no {site_playground.BUILT}; build it by `make playground`", file=sys.stderr)
    (work / "mkdocs.yml").write_text(settings, encoding="utf-8")
    where = {**os.environ, "GNOMON_SITE_PAGES": str(work / "docs"), "GNOMON_SITE": str(site)}
    command = [PYTHON, "-m", "mkdocs", "build", "--strict", "--clean", "--config-file", work / "mkdocs.yml"]
    run = subprocess.run(command, cwd=root, env=where, capture_output=True, text=True, check=False)
    # It also lists what the navigation leaves out, which the pages of sources are meant to be.
    said = [line for line in run.stderr.splitlines() if not line.startswith(("INFO", "  - "))]
    if run.returncode != 0 or any(said):
        raise Failed("\n".join(["mkdocs:", *said]))
    # Readers search for texts in documents; sources would come before them.
    index = site / "search/search_index.json"
    found = json.loads(index.read_text(encoding="utf-8"))
    found["docs"] = [one for one in found["docs"] if not one["location"].startswith(f"{SOURCES}/")]
    index.write_text(json.dumps(found), encoding="utf-8")


class References(html.parser.HTMLParser):
    """What a page names: ids of its own, and addresses of others."""

    def __init__(self, text: str):
        super().__init__()
        self.ids: set[str] = set()
        self.addresses: list[str] = []
        self.loaded: list[str] = []  # the files that a browser asks for by itself
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("id", "name") and value:
                self.ids.add(value)
            elif name in ("href", "src") and value:
                self.addresses.append(value)
                if name == "src" or tag == "link":
                    self.loaded.append(value)


def faults_of(site: Path) -> list[str]:
    """Links that lead nowhere, and what would be asked of the network."""
    pages = {file: References(file.read_text(encoding="utf-8", errors="replace")) for file in sorted(site.rglob("*.html"))}
    faults = set()
    for file, page in pages.items():
        name = file.relative_to(site)
        faults |= {f"{name}: would load {address}" for address in page.loaded if address.startswith(("http:", "https:", "//"))}
        if name.name == "404.html":
            continue  # its addresses begin at the server's root
        for address in page.addresses:
            parts = urllib.parse.urlsplit(address)
            if parts.scheme or address.startswith("//"):
                continue
            target = (file.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else file
            target = target / "index.html" if target.is_dir() else target
            if not target.is_file():
                faults.add(f"{name}: {address} is not there")
            elif target == site / site_playground.PAGE:
                continue  # what follows # is its state
            elif parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].ids:
                faults.add(f"{name}: {address} has no such place")
    return sorted(faults)


def main() -> int:
    parser = argparse.ArgumentParser(description="Makes the site: documents, gallery and API reference.")
    parser.add_argument("--api", action="store_true", help="the API reference alone")
    parser.add_argument("folder", type=Path, help="where it goes; what is there is removed")
    options = parser.parse_args()
    root = project_root()
    site = options.folder.resolve()
    if site == root or site in root.parents:
        parser.error(f"{options.folder} holds the project")
    for program in ("doxygen",) if options.api else ("doxygen", "mkdocs"):
        if not shutil.which(program):
            parser.error(f"there is no {program}; run tools/install_packages.sh --only site packages.txt")
    shutil.rmtree(site, ignore_errors=True)
    try:
        if options.api:
            make_api(root, site)
        else:
            make_pages(root, site)
    except Failed as failure:
        print(failure, file=sys.stderr)
        return 1
    faults = faults_of(site)
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"site: {len(list(site.rglob('*.html')))} pages in {site}, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
