# SPDX-License-Identifier: Apache-2.0
"""Small reports of every kind, made by the program for the tests of their pages."""

import base64
import json
import os
import struct
import subprocess
from pathlib import Path

# Text in a browser's hands, and in a shell's.
HOSTILE = "it's <img src=x onerror=hit=1> \"q\" $(touch hit) &amp; `x`.gltf"
SMALL = ["--size", "160x90", "--light", "sun"]
QUICK = ["--repetitions", "2", "--warmup", "0", "--map-size", "128"]
RUNS = {
    "compare": ["compare", "planes", *SMALL, *QUICK, "--sun-angle", "4", "--samples", "16", "--techniques", "hard,pcf,pcss,vsm,esm"],
    "path": ["compare", "planes", *SMALL, "--truth", "hard", "--map-size", "128", "--techniques", "hard,pcf", "--path", "orbit", "--frames", "3-6"],
    "sweep": ["compare", "planes", *SMALL, "--samples", "16", "--techniques", "hard,pcf", "--sweep", "map-size=64:256:3:log"],
    "bench": ["bench", "planes", "--size", "160x90", *QUICK, "--techniques", "hard,vsm,pcf+cascades"],
    "scenes": ["compare", "planes", "canopies", *SMALL, *QUICK, "--samples", "16", "--techniques", "hard,pcf,esm"],
    # No pixel counts, so there is no error; and one technique alone, with a column more.
    "nothing": ["compare", "planes", "--size", "64x36", *QUICK, "--sun", "0,1,0", "--truth", "hard", "--techniques", "hard,pcf"],
    "alone": ["compare", "planes", "--size", "64x36", "--light", "sun", "--samples", "16", *QUICK, "--techniques", "pcf+pcf.kernel=5x5+map-size=64+bias.slope=2", "--equal-error"],
    "hostile": ["compare", HOSTILE, "--size", "64x36", *QUICK, "--sun", "0.4,-1,0.2", "--eye", "3,3,3", "--target", "0,0,0", "--truth", "hard",
                "--techniques", "hard"],
}


def write_scene(file: Path) -> None:
    """A ground, and a triangle that throws a shadow on it."""
    points = [(-4, 0, -4), (-4, 0, 4), (4, 0, 4), (-4, 0, -4), (4, 0, 4), (4, 0, -4), (-1, 1, -1), (0, 1, 1), (1, 1, -1)]
    bytes_ = b"".join(struct.pack("<3f", *point) for point in points)
    scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": [-4, 0, -4], "max": [4, 1, 4]}],
             "bufferViews": [{"buffer": 0, "byteLength": len(bytes_)}],
             "buffers": [{"byteLength": len(bytes_), "uri": "data:application/octet-stream;base64," + base64.b64encode(bytes_).decode()}]}
    file.write_text(json.dumps(scene), encoding="utf-8")


class Reports:
    def __init__(self, gnomon: Path, folder: Path):
        self.folder = folder
        self.environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache"), "PATH": f"{gnomon.parent}:{os.environ['PATH']}"}
        write_scene(folder / HOSTILE)
        for name, arguments in RUNS.items():
            self.run([str(gnomon), *arguments, "--report", name])

    def run(self, command: list[str] | str) -> str:
        """What a command says, or a line that a shell is to take. Throws RuntimeError with its errors."""
        ran = subprocess.run(command, shell=isinstance(command, str), cwd=self.folder, env=self.environment, capture_output=True, text=True,
                             check=False)
        if ran.returncode != 0:
            raise RuntimeError(f"{command}: {ran.stderr}")
        return ran.stdout

    def page(self, name: str) -> Path:
        return self.folder / name / "index.html"

    def result(self, name: str) -> dict:
        return json.loads((self.folder / name / "result.json").read_text(encoding="utf-8"))
