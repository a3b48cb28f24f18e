// SPDX-License-Identifier: Apache-2.0
// What a bench found, as JSON and as a table.
#pragma once

#include "app/shot.h"
#include "bench_stages.h"
#include "result_json.h"
#include "texel_density.h"

#include <string>
#include <utility>
#include <vector>

namespace gnomon::app {

struct BenchedTechnique {
    Settings settings;
    std::vector<host::FrameTimes> redrawn; // every map drawn in every frame
    std::vector<host::FrameTimes> reused;  // maps that still hold are kept
    std::vector<std::pair<std::string, std::uint64_t>> memory;
    Counters counters; // of a redrawn frame
    AtlasSize atlas;
    TexelDensity density; // of the first light
};

struct BenchResult {
    std::string device;
    std::string driver;
    std::vector<host::FrameTimes> baseline; // without shadows, in turn with the redrawn frames
    std::vector<host::FrameTimes> reused_baseline;
    std::uint64_t baseline_bytes = 0;
    std::vector<BenchedTechnique> techniques;
};

[[nodiscard]] Json benchJson(const BenchResult& result, const Shot& shot, const Settings& settings);
[[nodiscard]] std::string benchTable(const BenchResult& result, const Shot& shot, const Settings& settings);

} // namespace gnomon::app
