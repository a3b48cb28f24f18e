// SPDX-License-Identifier: Apache-2.0
// The figures of a bench's JSON that another bench is compared with: counts and times of its passes, and its view.
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

/// A time divided by that of the frame without shadows of the same run and group, so that runs of a slower hour
/// compare. Nothing where the clock measured none; no range where there was one sample.
struct RelativeTime {
    std::optional<double> median;
    std::optional<double> iqr;
};

using Counts = std::map<std::string, std::uint64_t>;

/// All that decides what a run draws, as JSON by key: "scene_hash", "eye", "lights", "path" and settings. They are
/// texts because a copied tree of JSON cannot be destroyed without memory (scene/json.h).
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
    Counts counts; // counts of the whole frame, less those that passes have
    std::vector<PassFigures> passes;
};

struct BenchFigures {
    std::string file;
    std::string device; // and its driver
    Sight sight;
    std::vector<TechniqueFigures> techniques;
};

/// Parses a bench's JSON from any source. Throws Error with one line that names the place by a JSON pointer and calls
/// the text `file`.
[[nodiscard]] BenchFigures parseBenchFigures(std::string_view text, const std::string& file);
/// Reads and parses a file of 16 MiB at most.
[[nodiscard]] BenchFigures readBenchFigures(const std::filesystem::path& file);

/// The sight of a bench's JSON or of its head. Precondition: it has "settings", an object.
[[nodiscard]] Sight sightOf(const Json& bench);

} // namespace gnomon::app
