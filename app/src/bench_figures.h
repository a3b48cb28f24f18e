// SPDX-License-Identifier: Apache-2.0
// What of a bench's JSON another bench is held against: counts and times of its passes, and what was looked at.
#pragma once

#include "result_json.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// By the frame without shadows of the same run and group, so that runs of a slower hour can be held against each
/// other. Nothing where the clock measured none, or there was one sample.
struct RelativeTime {
    std::optional<double> median;
    std::optional<double> iqr;
};

using Counts = std::map<std::string, std::uint64_t>;

/// All that decides what a run draws, as JSON by key: "scene_hash", "eye", "lights", "path" and settings. Texts, for a
/// copied tree of JSON cannot be destroyed without memory (scene/json.h).
using Sight = std::map<std::string, std::string>;

struct PassFigures {
    std::string name;
    RelativeTime time;
    Counts counts;
};

struct TechniqueFigures {
    std::string name;
    RelativeTime frame;
    RelativeTime plan;
    Counts counts; // of the whole frame, less those that passes have
    std::vector<PassFigures> passes;
};

struct BenchFigures {
    std::string file;
    std::string device; // and its driver
    Sight sight;
    std::vector<TechniqueFigures> techniques;
};

/// Of a bench's JSON, from any source. Throws Error with one line that names the place by a JSON pointer; `file` is
/// what that line calls it.
[[nodiscard]] BenchFigures parseBenchFigures(std::string_view text, const std::string& file);
/// The same from a file of 16 MiB at most.
[[nodiscard]] BenchFigures readBenchFigures(const std::filesystem::path& file);

/// Of the JSON as a whole or of its head. Precondition: it has "settings", an object.
[[nodiscard]] Sight sightOf(const Json& bench);

} // namespace gnomon::app
