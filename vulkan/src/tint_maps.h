// SPDX-License-Identifier: Apache-2.0
// Maps of the light that blended casters let through, beside the maps of one of a plan's options: in the same squares,
// and only for views that have such casters. Red, green and blue are the light that all of a texel's casters let
// through together, and alpha is the depth of the nearest one. Casters behind the first blocker are not in it, so that
// a pane under a floor does not tint the floor. Blockers are drawn first, to a depth image of its own, since the map
// itself may be averaged, of several samples or not a depth image at all. Based on: T. Lokovic, E. Veach, "Deep Shadow
// Maps", SIGGRAPH 2000: a transmittance by depth, here with one step. Not taken: M. McGuire, E. Enderton, "Colored
// Stochastic Shadow Maps", I3D 2011, which keeps the order of panes and receivers, because it trades that for noise,
// which filters of a few taps leave in the picture.
#pragma once

#include "layered_target.h"
#include "map_recorder.h"

#include <functional>
#include <vector>

namespace gnomon::vulkan {

/// The formats of blockers, in the depth image that blended casters are tested against.
[[nodiscard]] MapPassFormats blockerFormats(bool orthographic);
[[nodiscard]] MapPassFormats tintFormats();

class TintMaps {
public:
    explicit TintMaps(Device& device) : device_(device) {}

    /// Finds the views with blended casters, and makes what images they need. Returns whether image() or inUse() is
    /// another than before. Throws Error where the device cannot blend in the format of tints.
    bool prepare(const Plan& plan, std::uint32_t options, const std::function<bool(std::uint32_t)>& is_blended);
    /// After the maps: draws those that do not hold what their views want. Were there any?
    bool record(const MapJob& job);
    /// Some view of the prepared plan has one.
    [[nodiscard]] bool inUse() const { return in_use_; }
    [[nodiscard]] const Image& image() const { return tints_.image(); }
    /// The place of a view of that plan: one past its layer; 0: it has none.
    [[nodiscard]] std::uint32_t placeOf(std::uint32_t view) const { return in_use_ ? places_[view] : 0; }

private:
    void makeImages(const MapPages& pages, std::uint32_t layers);
    [[nodiscard]] bool draws(const MapJob& job, std::uint32_t view) const;
    void draw(const MapJob& job, std::uint32_t view);
    void beginRendering(VkCommandBuffer commands, const Tile& tile, VkImageView colour);

    Device& device_;
    LayeredTarget tints_;
    Image depth_;                       // depth of blockers; discarded after each view
    std::vector<std::uint32_t> places_; // by view
    std::vector<ContentNumber> held_;   // by MapId::index
    bool in_use_ = false;
};

} // namespace gnomon::vulkan
