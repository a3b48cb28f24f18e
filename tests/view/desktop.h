// SPDX-License-Identifier: Apache-2.0
// A desktop of our own, without a screen, and a hand on it.
#pragma once

#include <glm/vec2.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace gnomon::test {

inline constexpr glm::uvec2 kScreen_px{1280, 1024};

/// Starts Xvfb and makes it this process's DISPLAY. One at a time.
class Desktop {
public:
    /// Null where Xvfb is not installed.
    [[nodiscard]] static std::unique_ptr<Desktop> open();
    ~Desktop();
    /// Of the screen, dots per inch; 96 on a common one. For windows that are opened from then on.
    void setDensity(int dpi);
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;

    // What a hand does, heard by the program as from any mouse and keyboard. Pixels of the screen.
    void point(const glm::dvec2& at);
    void press(int button); // 1 left, 2 middle, 3 right, 4 and 5 the wheel
    void release(int button);
    /// A key by its X11 name: "Return", "w".
    void key(std::string_view name, bool down);

private:
    Desktop() = default;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::test
