// SPDX-License-Identifier: Apache-2.0
// A triangle, a nameless point light held by the node Lamp, an orthographic camera and then a nameless perspective one
// held by the node Eye.
#pragma once

namespace gnomon::test {

inline constexpr const char* kLightsAndCameras = R"({
  "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 20}]}},
  "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
  "nodes": [{"mesh": 0}, {"name": "Lamp", "translation": [0, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"name": "Map", "translation": [0, 0, 4], "camera": 0}, {"name": "Eye", "translation": [0, 0, 5], "camera": 1}],
  "cameras": [{"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}},
              {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25, "zfar": 80}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
})";

} // namespace gnomon::test
