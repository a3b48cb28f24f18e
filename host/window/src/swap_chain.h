// SPDX-License-Identifier: Apache-2.0
// The images of a window, drawn by turns, and the pass that draws in them.
#pragma once

#include "texels.h"

#include "host/window/canvas.h"
#include "host/window/window.h"

#include <functional>
#include <span>
#include <vector>

namespace gnomon::host {

using OwnedSemaphore = Owned<VkSemaphore, vkDestroySemaphore>;
using OwnedRenderPass = Owned<VkRenderPass, vkDestroyRenderPass>;
using OwnedFramebuffer = Owned<VkFramebuffer, vkDestroyFramebuffer>;

class SwapChain {
public:
    SwapChain(Window& window, Gpu& gpu, const DebugNames& names);
    ~SwapChain();
    SwapChain(const SwapChain&) = delete;
    SwapChain& operator=(const SwapChain&) = delete;

    /// Has the window pixels? Makes images of its size where it has changed.
    [[nodiscard]] bool prepare();
    /// Draws the pictures on black, over them what `draw` records within pass(), and shows that. Is `read` given, that
    /// is copied by it. False: the window's size has changed, nothing is shown.
    bool show(std::span<const PicturePlace> pictures, const std::function<void(VkCommandBuffer)>& draw,
              TexelCopies* read);
    /// Waits for what was shown last.
    void wait() { commands_.wait(); }

    [[nodiscard]] VkRenderPass pass() const { return pass_.get(); }
    [[nodiscard]] std::uint32_t imageCount() const { return static_cast<std::uint32_t>(images_.size()); }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    [[nodiscard]] bool isBlueFirst() const { return format_.format == VK_FORMAT_B8G8R8A8_UNORM; }
    /// Where `read` of the last show() has put the texels, in the format's order.
    [[nodiscard]] const void* texels() const { return texels_; }

private:
    struct Surface { // goes after the images that are of it
        Surface(Window& window, const Gpu& gpu);
        ~Surface();
        Surface(const Surface&) = delete;
        Surface& operator=(const Surface&) = delete;
        const Gpu& gpu;
        VkSurfaceKHR handle = VK_NULL_HANDLE;
    };
    struct Shown {
        VkImage image = VK_NULL_HANDLE;
        OwnedImageView view;
        OwnedFramebuffer framebuffer;
        OwnedSemaphore drawn;
    };
    void chooseFormat();
    void makePass();
    void makeImages();
    void dropImages();
    void recordPictures(VkCommandBuffer commands, VkImage target, std::span<const PicturePlace> pictures) const;
    void recordPass(VkCommandBuffer commands, const Shown& image,
                    const std::function<void(VkCommandBuffer)>& draw) const;
    void submit(const Shown& image);
    [[nodiscard]] bool present(const Shown& image);
    [[nodiscard]] Shown makeShown(VkImage image) const;
    [[nodiscard]] OwnedSemaphore makeSemaphore() const;

    Window& window_;
    Gpu& gpu_;
    Surface surface_;
    VkSurfaceFormatKHR format_{};
    OwnedRenderPass pass_;
    VkSwapchainKHR chain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Shown> images_;
    OwnedSemaphore free_; // the image that is drawn next
    Commands commands_;
    const void* texels_ = nullptr;
    bool stale_ = true; // the images are not of the window's size
};

} // namespace gnomon::host
