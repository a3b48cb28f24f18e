#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a glTF file with one sun, 32 lamps and 400 boxes on a ground: many lights that all cast, in one picture.

usage: lamps_scene.py FILE.gltf
"""

import base64
import json
import struct
import sys
from pathlib import Path

CORNERS = [(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def main() -> int:
    points = [CORNERS[corner] for side in SIDES for corner in side]
    indices = [4 * side + corner for side in range(6) for corner in (0, 1, 2, 0, 2, 3)]
    data = b"".join(struct.pack("<3f", *point) for point in points) + struct.pack(f"<{len(indices)}H", *indices)
    nodes = [{"mesh": 0, "translation": [0, -0.1, 0], "scale": [60, 0.1, 60]}]
    for i in range(400):
        height = 0.4 + 0.15 * (i * 7 % 11)
        nodes.append({"mesh": 0, "translation": [i % 20 * 5.0 - 47.5, height, i // 20 * 5.0 - 47.5],
                      "scale": [0.6, height, 0.6]})
    nodes.append({"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [-0.5, 0.2, 0.1, 0.836]})
    for i in range(32):
        nodes.append({"extensions": {"KHR_lights_punctual": {"light": 1}},
                      "translation": [i % 8 * 12.0 - 42.0, 4.0, i // 8 * 24.0 - 36.0]})
    nodes.append({"camera": 0, "translation": [0, 30, 60], "rotation": [-0.2419, 0, 0, 0.9703]})
    scene = {
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"], "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "directional", "intensity": 2.0}, {"type": "point", "intensity": 300.0, "range": 20.0}]}},
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 12 * len(points)},
                        {"buffer": 0, "byteOffset": 12 * len(points), "byteLength": 2 * len(indices)}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }
    Path(sys.argv[1]).write_text(json.dumps(scene), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
