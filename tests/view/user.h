// SPDX-License-Identifier: Apache-2.0
// Somebody at the window of `gnomon view`: finds widgets by what is written on them, and points, clicks, drags, types.
#pragma once

#include "desktop.h"

#include "view/view_window.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::test {

class User {
public:
    /// Opens the window as the command line would: `arguments` behind "gnomon view".
    User(Desktop& desktop, const std::vector<std::string>& arguments,
         const std::optional<app::view::ShaderBuild>& shaders = std::nullopt);

    /// Turns of the window, until it has followed what was done.
    void wait(int turns = 3);
    /// Until nothing moves and everything is drawn as `render` draws it. False: it took too long.
    bool rest();
    void click(std::string_view label);
    /// Opens the list of this label and takes one of its items.
    void pick(std::string_view label, std::string_view item);
    /// Clicks a line of text, replaces what is in it, ends with Enter.
    void type(std::string_view label, std::string_view text);
    void press(std::string_view key);
    void drag(const glm::dvec2& from, const glm::dvec2& to, int button = 1);
    /// A file, as another program drops it on the picture.
    void drop(const std::string& file);
    void wheel(const glm::dvec2& at, int clicks);
    /// Pixels of the window for a share of the picture.
    [[nodiscard]] glm::dvec2 inPicture(double x, double y) const;
    /// Of the window as it is shown, that part which shows the picture.
    [[nodiscard]] Image8 shownPicture();

    [[nodiscard]] app::view::ViewWindow& window() { return window_; }
    [[nodiscard]] app::view::Viewer& viewer() { return window_.viewer(); }

private:
    [[nodiscard]] glm::dvec2 find(std::string_view label);

    Desktop& desktop_;
    app::view::ViewWindow window_;
};

/// What the command of a viewer draws, as the program would draw it.
[[nodiscard]] Image8 drawnBy(const std::string& command);
/// The pixels of a PNG file of 8 bits.
[[nodiscard]] Image8 readPixels(const std::filesystem::path& file);
/// The settings that `gnomon view` with these arguments has.
[[nodiscard]] app::Settings settingsOf(const std::vector<std::string>& arguments);

} // namespace gnomon::test
