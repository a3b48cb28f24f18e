# SPDX-License-Identifier: Apache-2.0
"""The playground's part in the site: its files, and links to it from the gallery."""

import json
import re
import shutil
import urllib.parse
from pathlib import Path

BUILT = Path("build/playground")
PAGE = "playground/index.html"
# Worlds that the page has, and what may stand in a technique there besides options.
WORLDS = {"sundial", "rts", "canopies"}
NAMES = {"auto", "raymarch", "pcss", "pcf", "hard", "vsm", "evsm", "msm", "esm", "lvsm", "single", "cascades", "multi", "uniform", "lispsm",
         "lispsm-simple", "tsm", "psm", "scene"}
SHOWN = re.compile(r"`([a-z]+)`, `([^` ]+)`")


def address(view: dict, technique: str) -> str | None:
    """The part of the page's address after #, which shows a view of docs/gallery.json; nothing where the page cannot."""
    words = dict(zip(view["arguments"][::2], view["arguments"][1::2], strict=True))
    if view["scene"] not in WORLDS or words.get("--light", "sun") != "sun" or set(words) - {"--light", "--eye", "--target", "--camera", "--fov", "--sun-angle", "--time"}:
        return None
    if any("=" not in word and word not in NAMES for word in technique.split("+")):
        return None
    items = {"world": view["scene"], "technique": technique, "light": words.get("--sun-angle", "0.53")}
    if "--eye" in words:
        items["camera"] = ",".join([words["--eye"], words["--target"], *([words["--fov"]] if "--fov" in words else [])])
    elif "--camera" in words:
        items["camera"] = words["--camera"]
        items |= {"fov": words["--fov"]} if "--fov" in words else {}
    return urllib.parse.urlencode(items, safe=",+=")


def with_links(text: str, views: dict) -> str:
    """The gallery's page, with a link beside each picture that the playground can show."""
    def linked(found: re.Match) -> str:
        there = address(views[found[1]], found[2]) if found[1] in views else None
        return f"{found[0]}. [Try it](../{PAGE}#{there})" if there else found[0]

    return SHOWN.sub(linked, text)


def install(root: Path, docs: Path) -> bool:
    """Copies the playground into the pages of the site and links to it; false where it has not been built."""
    if not (root / BUILT / "index.html").is_file():
        return False
    shutil.copytree(root / BUILT, docs / Path(PAGE).parent)
    gallery = docs / "docs/gallery.md"
    views = json.loads((root / "docs/gallery.json").read_text(encoding="utf-8"))["views"]
    gallery.write_text(with_links(gallery.read_text(encoding="utf-8"), views), encoding="utf-8")
    return True


def navigation(settings: str) -> str:
    """mkdocs' settings with the playground after the gallery."""
    line = "  - Gallery: docs/gallery.md\n"
    assert line in settings
    return settings.replace(line, f"{line}  - Playground: {PAGE}\n")
