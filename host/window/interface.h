// SPDX-License-Identifier: Apache-2.0
// Dear ImGui on a window: from what the person does to widgets, and from pictures and widgets to pixels on the screen.
#pragma once

#include "host/gpu.h"
#include "host/window/canvas.h"
#include "host/window/window.h"
#include "image/image.h"

#include <memory>
#include <span>

namespace gnomon::host {

/// `options` for a device that can draw in this window.
[[nodiscard]] GpuOptions forWindow(GpuOptions options, const Window& window);

/// One at a time. `window` and `gpu` outlive it. What waits for the GPU throws as FrameRenderer does.
class Interface {
public:
    /// Throws Error.
    Interface(Window& window, Gpu& gpu);
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    /// Widgets may be made from now on, by Dear ImGui. False, and then no end(): the window has no pixels, since it is
    /// minimised.
    [[nodiscard]] bool begin();
    /// Shows the pictures, and over them the widgets. False: the window's size has just changed, nothing is shown, and
    /// the next turn will.
    bool end(std::span<const PicturePlace> pictures);
    /// As end(), and gives what is shown as RGB pixels; empty where nothing is.
    [[nodiscard]] Image8 endAndRead(std::span<const PicturePlace> pictures);
    /// Of the window, as begin() found it.
    [[nodiscard]] glm::uvec2 size_px() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::host
