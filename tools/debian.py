# SPDX-License-Identifier: Apache-2.0
"""The installed packages of a Debian system: which of them a file belongs to, and which come along with which."""

import os
import re
from pathlib import Path

DATABASE = Path("/var/lib/dpkg")
MERGED = re.compile(r"^/usr(?=/(bin|sbin|lib\w*)/)")  # dpkg knows some files of /usr/bin as of /bin


class Packages:
    """As dpkg's database has them. Throws OSError where there is none."""

    def __init__(self) -> None:
        self.depends: dict[str, list[str]] = {}  # each one a group of alternatives: "libgl1-mesa-dev | libgl-dev"
        self.providers: dict[str, set[str]] = {}
        self.bare: set[str] = set()
        self.owners: dict[str, set[str]] = {}
        for text in (DATABASE / "status").read_text(encoding="utf-8").split("\n\n"):
            fields = dict(re.findall(r"^([A-Z][\w-]*): *(.*)", text, re.MULTILINE))
            if not fields.get("Status", "").endswith(" installed"):
                continue
            name = fields["Package"]
            groups = ", ".join(fields[key] for key in ("Pre-Depends", "Depends") if key in fields)
            self.depends.setdefault(name, []).extend(group for group in groups.split(", ") if group)
            for given in [name, *re.sub(r" *\([^)]*\)", "", fields.get("Provides", "")).split(", ")]:
                self.providers.setdefault(given, set()).add(name)
            if fields.get("Essential") == "yes" or fields.get("Priority") == "required" or name == "apt":
                self.bare.add(name)
        for file in (DATABASE / "info").glob("*.list"):
            name = file.stem.split(":")[0]
            for line in file.read_text(encoding="utf-8").splitlines():
                self.owners.setdefault(line, set()).add(name)

    def installed(self, name: str) -> bool:
        return name in self.depends

    def closure(self, names) -> set[str]:
        """`names`, and what they and a bare system need. Of alternatives the first counts that is installed, as apt takes the
        first that there is; recommended packages are not installed and do not count."""
        found: set[str] = set()
        left = [*names, *self.bare]
        while left:
            name = left.pop()
            if name in found or name not in self.depends:
                continue
            found.add(name)
            for group in self.depends[name]:
                for one in group.split("|"):
                    if there := self.providers.get(re.split(r"[ :(]", one.strip())[0]):
                        left += there
                        break
        return found

    def owners_of(self, file) -> set[str]:
        """Empty where the file is of no package. What a link belongs to is what it leads to, if nobody has the link."""
        for path in (os.path.normpath(file), os.path.realpath(file)):
            unmerged = MERGED.sub("", path)
            if owners := self.owners.get(path, set()) | self.owners.get(unmerged, set()) | self.owners.get("/usr" + path, set()):
                return owners
        return set()
