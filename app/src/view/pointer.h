// SPDX-License-Identifier: Apache-2.0
// The hand on the picture: orbits, pans, looks and flies, moves the sun by its handle and the divider.
#pragma once

#include "view/panels.h"

#include <glm/vec2.hpp>

namespace gnomon::app::view {

/// Where the picture is in the window, in the desktop's units.
struct PictureArea {
    glm::dvec2 least{0.0};
    glm::dvec2 size{1.0};
};

class Pointer {
public:
    /// What was done since the last turn, as changes of the viewer; draws handles over the picture. `letters`: keys
    /// that were pressed; `elapsed_s`: since then. Between Interface::begin() and end().
    void turn(Viewer& viewer, Shown& shown, const PictureArea& area, std::string_view letters, double elapsed_s);
    /// Where the sun's handle is, in the desktop's units; nothing where there is none.
    [[nodiscard]] const std::optional<glm::dvec2>& sunAt() const { return sun_at_; }

private:
    enum class Grip : std::uint8_t { none, camera, sun, divider };

    void placeSun(const Viewer& viewer, const Shown& shown, const PictureArea& area);
    [[nodiscard]] Grip gripAt(const Viewer& viewer, const Shown& shown, const PictureArea& area) const;
    void drag(Viewer& viewer, Shown& shown, const PictureArea& area);
    static void moveCamera(Viewer& viewer, const PictureArea& area);
    static void fly(Viewer& viewer, double elapsed_s);
    static void keys(Viewer& viewer, Shown& shown, std::string_view letters);
    void drawHandles(const Viewer& viewer, const Shown& shown, const PictureArea& area) const;

    Grip grip_ = Grip::none;
    std::optional<glm::dvec2> sun_at_;
    glm::dvec2 dome_at_{0.0};
};

} // namespace gnomon::app::view
