// SPDX-License-Identifier: Apache-2.0
// Interfaces of passes beside the drawing of maps, with images of their own. DepthMaps (map_pass.h) has at most one of
// each.
#pragma once

#include "map_recorder.h"

namespace gnomon::vulkan {

/// Makes a second image of maps, once they are drawn: ShadowRenderer::blocks().
class MapStep {
public:
    MapStep() = default;
    virtual ~MapStep() = default;
    MapStep(const MapStep&) = delete;
    MapStep& operator=(const MapStep&) = delete;

    /// The name of its pass for the profiler; null: it is a part of the maps' pass.
    [[nodiscard]] virtual const char* passName() const { return nullptr; }
    /// Are all maps to be drawn again after setMaps()?
    [[nodiscard]] virtual bool needsDrawnMaps() const { return false; }
    /// For these maps, an image that has just been made.
    virtual void setMaps(const Image& maps) = 0;
    /// Makes the parts that belong to what the job has drawn. The maps are readable.
    virtual void record(const MapJob& job) = 0;
    /// In GENERAL once recorded.
    [[nodiscard]] virtual const Image& image() const = 0;
};

/// Draws a view's map from images that it has drawn the casters to.
class ViewPainter {
public:
    ViewPainter() = default;
    virtual ~ViewPainter() = default;
    ViewPainter(const ViewPainter&) = delete;
    ViewPainter& operator=(const ViewPainter&) = delete;

    /// Makes room for maps on a page of this size. Images that are too small are retired.
    virtual void cover(VkExtent2D page) = 0;
    /// Before rendering to the map begins: draws all casters of a view to images of its own.
    virtual void drawCasters(const MapJob& job, std::uint32_t view) = 0;
    /// Rendering to the map has begun, viewport and scissor are set: draws the map.
    virtual void drawMap(VkCommandBuffer commands) const = 0;
};

} // namespace gnomon::vulkan
