# SPDX-License-Identifier: Apache-2.0
"""Which files belong to the project: a walk over the tree that leaves out build folders, so that it works with and
without a git checkout."""

import os
from pathlib import Path

SKIPPED_FOLDERS = {".git", ".cache", "out", "__pycache__", ".vscode", ".idea", "node_modules", "dist"}


def project_root() -> Path:
    return Path(__file__).resolve().parent.parent


def project_files(root: Path):
    """Every file of the project, relative to root, in a fixed order."""
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(
            name
            for name in folders
            if name not in SKIPPED_FOLDERS and name != "build" and not name.startswith("build-")
        )
        for name in sorted(files):
            path = Path(folder, name)
            if not path.is_symlink() and name != ".git":  # a file in a worktree
                yield path.relative_to(root)
