// SPDX-License-Identifier: Apache-2.0
// A window of the desktop, and what the person in front of it does. Knows nothing of pictures.
#pragma once

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace gnomon::host {

struct WindowOptions {
    std::string title = "gnomon";
    glm::uvec2 size{1280, 720}; // of its inside, in the desktop's units: pixels, or larger on a dense screen
};

/// The size of a window's inside, in the desktop's units, of which `size` are `size_px` pixels: at most what `area_px`
/// pixels have room for beside a frame of `frame` units. An area of 0 bounds nothing.
[[nodiscard]] glm::ivec2 sizeOnScreen(const glm::ivec2& size, const glm::ivec2& size_px, const glm::ivec2& frame,
                                      const glm::ivec2& area_px);

/// One at a time, on the thread that main() runs on.
class Window {
public:
    /// No larger than the screen has room. Throws Error where there is no window system, or none that Vulkan can draw
    /// in.
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// GpuOptions::surface_extensions; GLFW's, so they hold as long as the window does.
    [[nodiscard]] std::vector<const char*> instanceExtensions() const;
    /// GpuOptions::presents.
    [[nodiscard]] static bool canShow(VkInstance instance, VkPhysicalDevice device, std::uint32_t queue_family);
    /// Throws Error. The caller destroys it, before the instance and the window.
    [[nodiscard]] VkSurfaceKHR makeSurface(VkInstance instance) const;

    /// Hears what was done since the last time. Waits `seconds` for something to be done at most; 0: not at all. True:
    /// something was.
    bool listen(double seconds = 0.0);
    [[nodiscard]] bool isClosing() const;
    /// Of its inside, in pixels of the screen; 0 while it is minimised.
    [[nodiscard]] glm::uvec2 size_px() const;
    /// How much larger than on a common screen letters should be, in pixels; 1 on a common one.
    [[nodiscard]] double contentScale() const;
    void setTitle(const std::string& title);
    /// Of its inside, in the desktop's units, each above 0. It has it when the desktop has heard of it.
    void resize(glm::uvec2 size);
    /// Files dropped on it since the last call.
    [[nodiscard]] std::vector<std::string> takeDropped();
    /// Letters that were pressed since the last call, A to Z, also those that were let go of in between: a picture that
    /// takes long loses none.
    [[nodiscard]] std::string takeLetters();
    /// Is something drawn over its last picture, or has its size changed? Forgets it.
    [[nodiscard]] bool takeExposed();
    void toClipboard(const std::string& text);
    [[nodiscard]] std::string clipboard() const;

    /// For Interface, and for tests that find the window on the desktop.
    [[nodiscard]] GLFWwindow* handle() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::host
