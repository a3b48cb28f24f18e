// SPDX-License-Identifier: Apache-2.0
// The results of a bench, and their JSON, from which its tables and its page are made.
#pragma once

#include "app/shot.h"
#include "lab/texel_density.h"
#include "lab/timing.h"
#include "result_json.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

struct BenchedTechnique {
    Settings settings;
    lab::Timed redrawn; // every map drawn in every frame
    lab::Timed reused;  // maps that still hold are kept
    /// Masks that still hold are kept too. Nothing along a path, where something moves.
    std::optional<lab::Timed> still;
    lab::TexelDensity density; // the density of the first light, as is fit_efficiency
    double fit_efficiency = 0.0;
};

struct BenchResult {
    std::string device;
    std::string driver;
    lab::Timed baseline; // without shadows
    std::uint64_t baseline_bytes = 0;
    std::vector<BenchedTechnique> techniques;
};

/// The JSON that is known before anything is timed. It reads only `device` and `driver` of the result.
[[nodiscard]] Json benchHead(const BenchResult& result, const Shot& shot, const Settings& settings);
[[nodiscard]] Json benchJson(const BenchResult& result, const Shot& shot, const Settings& settings);

} // namespace gnomon::app
