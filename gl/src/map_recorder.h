// SPDX-License-Identifier: Apache-2.0
// The renderer's interface to what draws maps: DepthMaps (depth_maps.h) only draws them; MomentMaps (moment_maps.h)
// draws depths and makes a filterable map of them.
#pragma once

#include "map_storage.h"
#include "programs.h"
#include "state.h"

#include <gnomon/pack/map_notes.h>

namespace gnomon::gl {

/// One drawing of a plan's maps.
struct MapJob {
    const Plan& plan;
    std::uint32_t options = 0;            // index into Plan::options: views of others are left alone
    std::span<const pack::ViewWork> work; // by view
    const DrawCasters& draw;

    /// The work for a view: none for one of other options.
    [[nodiscard]] pack::ViewWork of(std::uint32_t view) const;
};

class MapRecorder {
public:
    MapRecorder() = default;
    virtual ~MapRecorder() = default;
    MapRecorder(const MapRecorder&) = delete;
    MapRecorder& operator=(const MapRecorder&) = delete;

    struct Prepared {
        bool changed = false; // there are new textures
        bool lost = false;    // and what maps held could not be taken over
    };
    virtual Prepared prepare(const Plan& plan, std::uint32_t options) = 0;
    virtual void draw(const MapJob& job) = 0;
    /// Did prepare() make room for this view of its options?
    [[nodiscard]] virtual bool covers(const Plan& plan, const View& view) const = 0;
    [[nodiscard]] virtual const Image& maps() const = 0;
    [[nodiscard]] virtual const Image* blocks() const { return nullptr; } // none where the filter reads none
    [[nodiscard]] virtual GLuint depthLayers() const { return 0; }        // buffer of GpuDepthLayers; lvsm alone
};

/// A framebuffer for layers of images, one after the other.
class Target {
public:
    explicit Target(const Context& context) : context_(context), framebuffer_(makeFramebuffer(context)) {}

    /// Binds it with a layer of each; null: no such attachment.
    void bind(const Image* colour, std::uint32_t colour_layer, const Image* depth, std::uint32_t depth_layer) const;
    /// Clears colours, or depths to 1, within the scissor's rectangle.
    void clearColour(float value) const;
    void clearDepth() const;

private:
    void attach(GLenum attachment, const Image* image, std::uint32_t layer) const;

    const Context& context_;
    Framebuffer framebuffer_;
};

/// Calls the host's callback for this share of a view's casters.
void drawCasters(const Context& context, const MapJob& job, std::uint32_t view, pack::CasterShare share);

} // namespace gnomon::gl
