// SPDX-License-Identifier: Apache-2.0
// Pictures for a window: frames, as they were drawn, and images that were painted.
#pragma once

#include "host/present.h"
#include "image/image.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>

namespace gnomon::host {

/// Holds one picture.
class Canvas : public Present {
public:
    explicit Canvas(Gpu& gpu);
    ~Canvas() override;
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    /// Takes the frame's picture. Throws Error when memory runs out.
    void record(VkCommandBuffer commands, const FinishedFrame& frame) override;
    /// Takes an image of 3 channels. Throws Error, and whatever waits for the GPU throws.
    void paint(const Image8& image);
    [[nodiscard]] bool isEmpty() const;
    /// Of what it holds; 0 while it is empty.
    [[nodiscard]] glm::uvec2 size_px() const;

private:
    friend struct CanvasAccess;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// A part of a canvas, and where in the window it goes; pixels from the top left. A part that is enlarged shows its
/// pixels as squares.
struct PicturePlace {
    const Canvas* canvas = nullptr; // not empty
    glm::ivec2 from_px{0};
    glm::ivec2 from_size_px{0};
    glm::ivec2 to_px{0}; // within the window
    glm::ivec2 to_size_px{0};
};

} // namespace gnomon::host
