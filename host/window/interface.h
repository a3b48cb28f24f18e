// SPDX-License-Identifier: Apache-2.0
// Dear ImGui on a window: takes input for widgets, and draws pictures and widgets on the screen.
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

/// There may be one at a time. `window` and `gpu` outlive it. Functions that wait for the GPU throw as FrameRenderer
/// does.
class Interface {
public:
    /// Throws Error.
    Interface(Window& window, Gpu& gpu);
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    /// Begins a turn, in which Dear ImGui makes widgets. False: the window is minimised and has no pixels, and end()
    /// must not be called.
    [[nodiscard]] bool begin();
    /// Shows the pictures, and over them the widgets. False: the window's size has just changed, nothing is shown, and
    /// the next turn will.
    bool end(std::span<const PicturePlace> pictures);
    /// As end(), and gives what is shown as RGB pixels; empty where nothing is.
    [[nodiscard]] Image8 endAndRead(std::span<const PicturePlace> pictures);
    /// The window's size, as begin() found it.
    [[nodiscard]] glm::uvec2 size_px() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::host
