// SPDX-License-Identifier: Apache-2.0
// The pages of shadow maps, small, in a corner of the picture: who has which square, and what of it was drawn.
#pragma once

#include "view/viewer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::app::view {

class MapInset {
public:
    explicit MapInset(host::Gpu& gpu) : canvas_(gpu) {}

    /// Takes the maps of the last frame. Where there are none it becomes empty, and why() says so.
    void paint(Viewer& viewer);

    /// Near is dark, far is bright, each map by itself.
    [[nodiscard]] const host::Canvas& canvas() const { return canvas_; }
    [[nodiscard]] bool isEmpty() const { return squares_.empty(); }
    [[nodiscard]] const std::string& why() const { return why_; }

    /// A map's square, in shares of the canvas.
    struct Square {
        glm::dvec2 least{0.0};
        glm::dvec2 size{0.0};
        std::uint32_t light = 0;
        std::uint32_t view = 0; // of the light's
        bool is_drawn = false;  // in the last frame; else it was left as it is
    };
    [[nodiscard]] const std::vector<Square>& squares() const { return squares_; }

private:
    void take(Viewer& viewer);
    void paintPage(Viewer& viewer, std::uint32_t layer, const glm::uvec2& at, Image8& picture);

    host::Canvas canvas_;
    std::vector<Square> squares_;
    std::string why_;
};

} // namespace gnomon::app::view
