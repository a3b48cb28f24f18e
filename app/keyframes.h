// SPDX-License-Identifier: Apache-2.0
// A path from a file: camera, sun and time at given seconds, and smoothly between them.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// One to three numbers that change together, at ascending times. Between keys every number by itself follows a cubic
/// without a kink that never leaves the range of the two keys around it; before the first and after the last key it is
/// held. Two keys alone are joined by a straight line at constant speed.
class KeyTrack {
public:
    /// `at_s` is above that of the key before; finite.
    void add(double at_s, const glm::dvec3& value);
    [[nodiscard]] bool empty() const { return keys_.empty(); }
    /// Precondition: not empty, and `s` is no NaN.
    [[nodiscard]] glm::dvec3 at(double s) const;

private:
    struct Key {
        double at_s = 0.0;
        glm::dvec3 value{0.0};
    };
    [[nodiscard]] double slope(std::size_t key, int component) const;

    std::vector<Key> keys_;
};

/// The tracks of a path's file. A track without a key changes nothing.
struct Keyframes {
    KeyTrack eye_ws;
    KeyTrack target_ws;
    KeyTrack fov_deg; // x
    KeyTrack sun_ws;  // the way light travels, of any length above 0
    KeyTrack time_s;  // x
};

/// {"keys": [{"at": 0, "eye": [x, y, z], "target": [x, y, z], "fov": 45, "sun": [x, y, z], "time": 0}, ...]}: `at` is
/// in seconds since the path's first frame and ascends; each key has one or more of the others. Throws Error with one
/// line that names the place by a JSON pointer. That line calls the text `name`.
[[nodiscard]] Keyframes parseKeyframes(std::string_view text, std::string_view name);
/// Reads and parses a file of 16 MiB at most.
[[nodiscard]] Keyframes readKeyframes(const std::filesystem::path& file);

} // namespace gnomon::app
