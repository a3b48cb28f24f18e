// SPDX-License-Identifier: Apache-2.0
// A scene, a device with validation listening, and the truth of one of its lights.
#pragma once

#include "lab/compare.h"

#include "host/gpu.h"
#include "scene/model.h"
#include "scene/state.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::lab::test {

class Stage {
public:
    /// Looks from the scene's view of that name.
    Stage(scene::Scene scene, const std::string& view, glm::uvec2 size_px, std::uint32_t light = 0);
    /// Fails the test with every validation message there was.
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    [[nodiscard]] const Subject& subject() const { return subject_; }
    [[nodiscard]] const host::SceneOnGpu& uploaded() const { return uploaded_; }
    /// Lets the judged light shine along another direction; any length.
    void turnLight(const glm::dvec3& direction_ws);
    /// Traced when first asked for.
    [[nodiscard]] const truth::Traced& hardTruth();
    /// Traced anew each time.
    [[nodiscard]] truth::Traced areaTruth(std::uint32_t samples);
    /// The first view of the judged light in a map of these options.
    [[nodiscard]] View mapView(const host::RenderOptions& options);
    /// Geometry alone, without shadows.
    [[nodiscard]] host::Picture geometry();
    [[nodiscard]] Score score(const host::RenderOptions& options, bool with_perception = false);
    /// Against `truth`, of this stage.
    [[nodiscard]] Score score(const host::RenderOptions& options, const truth::Traced& truth);

private:
    scene::Scene scene_;
    scene::State state_;
    host::Gpu gpu_;
    host::SceneOnGpu uploaded_;
    Subject subject_;
    glm::uvec2 size_px_;
    std::optional<truth::Traced> hard_truth_;
};

/// The filter `hard`, with automatic bias.
[[nodiscard]] host::RenderOptions hardOptions(std::uint32_t map_size);
/// Any filter with its usual settings, and room around the map for its reads.
[[nodiscard]] host::RenderOptions filterOptions(Filter filter, MapFormat format, std::uint32_t map_size);

} // namespace gnomon::lab::test
