// SPDX-License-Identifier: Apache-2.0
// Checks of a host's wrong inputs, before anything is recorded or made of them. Each throws Error.
#pragma once

#include <gnomon/pack/map_notes.h>
#include <gnomon/plan.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <cstdint>
#include <vector>

namespace gnomon::vulkan {

/// `tried` is the sentence's beginning: "record shadow maps".
[[noreturn]] void refuseUse(const char* tried, const char* found, const char* instead);

/// 1 .. kMostFrames. Returns it.
std::uint32_t checkedFrames(std::uint32_t frames_in_flight);
void checkSlot(const char* tried, std::uint32_t slot, std::uint32_t frames_in_flight);
void checkCommands(const char* tried, VkCommandBuffer commands);
/// Its numbers point into its own lists and pages. Linear in lights and views.
/// Are ids of pieces in a map of the plan's (IdOf::face)?
bool hasPieces(const Plan& plan);

/// How large a plan is that was prepared: what is recorded must be no larger.
class PreparedSize {
public:
    void forget() { options_.clear(); }
    void take(const Plan& plan);
    [[nodiscard]] bool holds(const Plan& plan) const;

private:
    struct OfOptions {
        MapPages pages;
        std::uint32_t tile_side = 0;
        bool wanted = false; // by a light
    };
    [[nodiscard]] static std::vector<OfOptions>& measure(const Plan& plan, std::vector<OfOptions>& out);

    std::vector<OfOptions> options_;
    std::size_t lights_ = 0;
    std::size_t views_ = 0;
    std::uint32_t mask_layers_ = 0;
    std::uint32_t mask_channels_ = 0;
    std::uint32_t cascade_lights_ = 0;
    std::uint32_t depth_layers_ = 0;
    std::size_t object_vectors_ = 0;
    mutable std::vector<OfOptions> asked_; // scratch
};

} // namespace gnomon::vulkan
