// SPDX-License-Identifier: Apache-2.0
// One picture of a scenery by one technique, or with the ray tracer's masks, drawn anew as its settings change.
#pragma once

#include "host/window/canvas.h"
#include "view/scenery.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::app::view {

class Drawing {
public:
    Drawing(host::Gpu& gpu, const Scenery& scenery, const Settings& settings);

    /// From the next picture on. Throws Error, and then there is nothing to draw with until the next take().
    void take(const Settings& settings);
    /// Draws what has changed since the last time, with what the technique remembers of it. Throws Error.
    void draw();
    /// Draws as `render` does: from nothing, as often as --converge says. Throws Error.
    void drawStill();
    /// One frame more at rest: what soften converge averages.
    void drawOnce();
    /// The same shading with these masks, one for each light.
    void drawWith(const std::vector<ImageF>& masks);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const host::Canvas& canvas() const { return canvas_; }
    [[nodiscard]] const host::FrameTimes& times() const { return times_; }
    [[nodiscard]] host::FrameRenderer& renderer() { return *renderer_; }
    /// Is what it shows a frame that was drawn from nothing?
    [[nodiscard]] bool isStill() const { return still_; }
    /// What its canvas shows, as `render` writes it.
    [[nodiscard]] Image8 picture();

private:
    void make(bool shadows);
    void showFrame();

    host::Gpu& gpu_;
    const Scenery& scenery_;
    Settings settings_;
    std::unique_ptr<host::FrameRenderer> renderer_;
    host::Canvas canvas_;
    std::optional<Image8> painted_; // a debug view's picture
    host::FrameTimes times_;
    bool fresh_ = true; // nothing was drawn with renderer_
    bool still_ = false;
};

} // namespace gnomon::app::view
