# SPDX-License-Identifier: Apache-2.0
"""The documents as pages of the site: the same Markdown at the same paths, with links that hold there.

A link to a public header leads to its page of the API reference; to any other source to a page that shows it, which is
made for that; to a folder to a list of what is in it; api://PAGE to a page of the reference. A film, which is a moving PNG in the documents, becomes a video.
"""

import os
import re
import shutil
from pathlib import Path, PurePosixPath

LINK = re.compile(r"(!?\[[^\]]*\]\()([^)\s#]+)(#[^)\s]*)?\)")
FILM = re.compile(r"!\[([^\]]*)\]\(([^)\s]*films/[\w-]+)\.png\)")
LIST = re.compile(r"^ *(?:[-*]|\d+\.) ")
FENCE = re.compile(r"^ *(```|~~~)")
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".glsl": "glsl", ".comp": "glsl", ".frag": "glsl", ".vert": "glsl", ".py": "python", ".sh": "bash",
             ".json": "json", ".cmake": "cmake"}
PICTURES = (".png", ".jpg", ".svg", ".webm")
LARGEST_SHOWN = 200_000  # bytes of a source
SOURCES = PurePosixPath("source")


def documents(root: Path) -> list[PurePosixPath]:
    """What has a page of its own."""
    top = [PurePosixPath(name) for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    return [*top, *sorted(PurePosixPath(file.relative_to(root).as_posix()) for file in (root / "docs").rglob("*.md"))]


def relative(target: PurePosixPath, page: PurePosixPath) -> str:
    return PurePosixPath(os.path.relpath(target, page.parent)).as_posix()


def text_pieces(text: str):
    """The lines, each with whether it is of a code block."""
    fence = None
    for line in text.split("\n"):
        found = FENCE.match(line)
        if fence is None and found:
            fence = found[1]
            yield line, True
        elif fence and found and found[1] == fence and line.strip() == fence:
            fence = None
            yield line, True
        else:
            yield line, fence is not None


class Pages:
    """Writes pages to `folder`. `api`: by the path of a header in the project, the file that documents it."""

    def __init__(self, root: Path, folder: Path, api: dict[str, str]):
        self.root = root
        self.folder = folder
        self.api = api
        self.pages = set(documents(root))
        self.sources: set[PurePosixPath] = set()  # those that need a page

    def link(self, target: str, page: PurePosixPath, place: PurePosixPath) -> str:
        """Where a link of the document `page`, whose own page is at `place`, leads on the site."""
        if target.startswith("api://"):
            return relative(PurePosixPath("api", target.removeprefix("api://")), place)
        if "://" in target or target.startswith(("mailto:", "/")):
            return target
        wanted = PurePosixPath(os.path.normpath(page.parent / target))
        file = self.root / wanted
        if wanted in self.pages or wanted.parts[0] == "docs" and file.is_file() and file.suffix in PICTURES:
            return relative(wanted, place)
        if wanted.as_posix() in self.api:
            return relative(PurePosixPath("api") / self.api[wanted.as_posix()], place)
        if not file.exists():
            return target  # the site is not built with it
        self.sources.add(wanted)
        return relative(self.source_page(wanted), place)

    def source_page(self, source: PurePosixPath) -> PurePosixPath:
        return SOURCES / source / "index.md" if (self.root / source).is_dir() else SOURCES / f"{source}.md"

    def page(self, text: str, page: PurePosixPath, place: PurePosixPath) -> str:
        """A document as the site has it."""
        def film(found: re.Match) -> str:
            video = self.link(found[2] + ".webm", page, place)
            return (f'<video src="{video}" controls loop muted autoplay playsinline preload="metadata" '
                    f'aria-label="{found[1]}"></video>')

        def link(found: re.Match) -> str:
            return f"{found[1]}{self.link(found[2], page, place)}{found[3] or ''})"

        out: list[str] = []
        for line, is_code in text_pieces(text):
            if not is_code:
                line = LINK.sub(link, FILM.sub(film, line))
                before = out[-1] if out else ""
                if LIST.match(line) and before.strip() and not LIST.match(before) and not before.startswith((" ", "#")):
                    out.append("")  # GitHub needs no empty line before a list, Python's Markdown does
            out.append(line)
        return "\n".join(out)

    def write(self, place: PurePosixPath, text: str) -> None:
        file = self.folder / place
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def write_documents(self, extra: dict[PurePosixPath, PurePosixPath]) -> None:
        """All documents, and those of `extra`: from where in the project to which place."""
        for page, place in {**{page: page for page in sorted(self.pages)}, **extra}.items():
            self.write(place, self.page((self.root / page).read_text(encoding="utf-8"), page, place))
        for file in sorted((self.root / "docs").rglob("*")):
            if file.suffix in PICTURES:
                place = self.folder / file.relative_to(self.root)
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, place)

    def write_sources(self) -> None:
        """What the documents linked to; folders bring what is in them."""
        done: set[PurePosixPath] = set()
        while wanted := sorted(self.sources - done):
            for source in wanted:
                done.add(source)
                self.write(self.source_page(source), self.folder_list(source) if (self.root / source).is_dir() else self.listing(source))

    def folder_list(self, folder: PurePosixPath) -> str:
        place = self.source_page(folder)
        lines = [f"# {folder}", ""]
        for file in sorted((self.root / folder).rglob("*")):
            source = PurePosixPath(file.relative_to(self.root).as_posix())
            if file.is_file() and "__pycache__" not in file.parts and self.is_text(file):
                self.sources.add(source)
                lines.append(f"- [{source.relative_to(folder)}]({relative(self.source_page(source), place)})")
        return "\n".join(lines) + "\n"

    @staticmethod
    def is_text(file: Path) -> bool:
        data = file.read_bytes()
        return len(data) <= LARGEST_SHOWN and b"\0" not in data

    def listing(self, source: PurePosixPath) -> str:
        text = (self.root / source).read_text(encoding="utf-8")
        fence = "`" * max(3, 1 + max((len(run) for run in re.findall(r"`{3,}", text)), default=2))
        language = "cmake" if source.name == "CMakeLists.txt" else LANGUAGES.get(source.suffix, "text")
        return f"# {source.name}\n\n`{source}`\n\n{fence}{language}\n{text.rstrip()}\n{fence}\n"
