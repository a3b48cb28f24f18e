// SPDX-License-Identifier: Apache-2.0
// Chooses partition, fit and map size for each light where they are `auto`: the candidates' errors are predicted, and
// the best one is taken, but not at once where it is hardly better than the light's present choice.
#pragma once

#include "auto/map_size.h"
#include "frustum_planner.h"
#include "store/light_rows.h"

#include <gnomon/plan.h>

#include <array>
#include <span>
#include <vector>

namespace gnomon {

/// The choice for a light that leaves one to the planner.
struct AutoDecision {
    const PartitionTraits* partition = nullptr;
    std::array<double, kMaxCascades> strengths{}; // strengths of its slices' warps; 0: none was looked for yet
    AutoChoice told;
};

/// Remembers a light by its key for as long as it is in the frames.
class AutoChooser {
public:
    /// The lights of a frame. Those that are gone are forgotten.
    void follow(std::span<const Light> lights);

    /// Precondition: the recipe predicts(), and `camera` is measured.
    const AutoDecision& decide(const FrustumInput& input, const Sight& sight, std::size_t light,
                               FrustumPlanner& frustums);
    /// The last decision; for a light without one, the choice that it starts with.
    [[nodiscard]] const AutoDecision& decisionOf(const Recipe& recipe, std::size_t light);

private:
    /// One way to divide a light, and how its warps stand.
    struct Candidate {
        const PartitionTraits* partition = nullptr;
        std::array<double, kMaxCascades> strengths{};
        MapError error;
        BySize edges{};
        double coarsest_px = 0.0; // coarsest texel of its maps at their largest side

        /// Shares of wrong pixels by the side of its maps: geometric means.
        [[nodiscard]] BySize shares() const;
    };
    struct Memory {
        std::array<Candidate, 2> candidates;
        std::size_t count = 0;         // number of candidates; 0: nothing is remembered
        std::uint32_t frames = 0;      // frames since all candidates were predicted
        std::uint32_t compared_at = 0; // the halvings for which they were
        AutoDecision decision;
    };
    static void begin(const Recipe& recipe, LightType type, Memory& memory);
    void predict(const FrustumInput& input, const Sight& sight, std::uint32_t halvings, FrustumPlanner& frustums,
                 Candidate& candidate);
    static void size(const FrustumInput& input, const Candidate& taken, bool is_new, AutoChoice& told);

    LightRows rows_;
    std::vector<Memory> memories_; // by row
    std::vector<std::uint64_t> keys_;
    std::vector<LightType> types_; // types of the frame's lights
    std::vector<Slice> slices_;
};

} // namespace gnomon
