// SPDX-License-Identifier: Apache-2.0
// The people of the world `ring`: they go round the promenade both ways, or stand about.
#pragma once

#include "palette.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::worlds {

inline constexpr std::uint32_t kFolkKinds = 4;

class Folk {
public:
    Folk(Scene& scene, const RingPalette& palette, std::uint64_t seed);
    /// Adds a person who stands still; `transform` is of the feet, facing +z.
    void addStanding(Scene& scene, const Transform& transform, std::uint32_t kind) const;
    /// A pure function of the time.
    void pose(double time_s, std::vector<Node>& nodes) const;

private:
    struct Kind {
        std::uint32_t body = kNone; // meshes
        std::uint32_t leg = kNone;
        std::uint32_t arm = kNone;
        float hip_m = 0.0F;
        float shoulder_m = 0.0F;
        float hip_apart_m = 0.0F;
        float shoulder_apart_m = 0.0F;
        double stride_m = 1.3; // both steps
    };
    struct Walker {
        std::uint32_t body = 0; // node; legs and arms follow, right before left
        std::uint32_t kind = 0;
        double start_tiles = 0.0;
        double across_m = 0.0;
        float way = 1.0F; // towards +x at the lowest point, or -1
        float step = 0.0F;
    };
    std::uint32_t addBody(Scene& scene, const std::string& name, const Transform& transform, std::uint32_t kind) const;

    std::array<Kind, kFolkKinds> kinds_{};
    std::vector<Walker> walkers_;
};

} // namespace gnomon::worlds
