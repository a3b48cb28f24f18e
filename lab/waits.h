// SPDX-License-Identifier: Apache-2.0
// How lights took turns to have their maps drawn, over the frames of a run (ShadowOptions::draw_budget_texels).
#pragma once

#include <gnomon/plan.h>

#include <algorithm>
#include <cstdint>

namespace gnomon::lab {

struct Waits {
    std::uint32_t longest_frames = 0; // LightPlan::waited; 0: nobody waited
    std::uint32_t most_lights = 0;    // that waited in one frame
    std::uint32_t most_maps = 0;
    std::uint64_t most_texels = 0; // drawn in one frame

    void take(const Plan& plan)
    {
        std::uint32_t lights = 0;
        std::uint32_t maps = 0;
        std::uint64_t texels = 0;
        for (const MapPages& pages : plan.pages) {
            longest_frames = std::max(longest_frames, pages.longest_wait);
            lights += pages.waiting_lights;
            maps += pages.waiting_maps;
            texels += pages.drawn_texels;
        }
        most_lights = std::max(most_lights, lights);
        most_maps = std::max(most_maps, maps);
        most_texels = std::max(most_texels, texels);
    }
};

} // namespace gnomon::lab
