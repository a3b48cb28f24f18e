// SPDX-License-Identifier: Apache-2.0
#include "host/window/canvas.h"

#include "abandoned.h"
#include "canvas_image.h"
#include "commands.h"
#include "wait.h"

#include <algorithm>
#include <cassert>
#include <optional>

namespace gnomon::host {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM; // of FinishedFrame::picture

} // namespace

struct Canvas::Impl {
    explicit Impl(Gpu& the_gpu) : gpu(the_gpu) {}

    Gpu& gpu;
    // A picture of another size comes with memory of its own: what the window shows is shown until it is made.
    struct Held {
        explicit Held(const Gpu& gpu) : memory(gpu) {}
        Memory memory;
        Image image;
        bool written = false;
    };
    std::unique_ptr<Held> held;
    std::optional<Commands> commands;

    void makeRoom(VkExtent2D extent);
    [[nodiscard]] Access before() const;
};

void Canvas::Impl::makeRoom(VkExtent2D extent)
{
    if (held && held->image.extent.width == extent.width && held->image.extent.height == extent.height) {
        return;
    }
    auto made = std::make_unique<Held>(gpu);
    ImageWish wish;
    wish.name = "canvas";
    wish.purpose = "window";
    wish.format = kFormat;
    wish.extent = extent;
    wish.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                 VK_IMAGE_USAGE_SAMPLED_BIT; // without which an image has no view
    made->image = made->memory.image(wish);
    if (held) {
        waitForQueue(gpu);
    }
    held = std::move(made);
}

/// It is read by copies to the window, between which it is written.
Access Canvas::Impl::before() const
{
    return held->written ? discardAfter(kCopySource) : kDiscard;
}

Canvas::Canvas(Gpu& gpu) : impl_(std::make_unique<Impl>(gpu)) {}

Canvas::~Canvas()
{
    settleQueue(impl_->gpu);
    if (impl_->gpu.abandoned()) {
        keepForGood(std::move(impl_));
    }
}

void Canvas::record(VkCommandBuffer commands, const FinishedFrame& frame)
{
    assert(frame.picture.format == kFormat);
    impl_->makeRoom(frame.picture.extent);
    const Image& image = impl_->held->image;
    const Access passes{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, frame.picture.layout};
    const bool moves = frame.picture.layout != kCopySource.layout;
    if (moves) {
        barrier(commands, frame.picture.image, VK_IMAGE_ASPECT_COLOR_BIT, passes, kCopySource);
    }
    barrier(commands, image, impl_->before(), kCopyTarget);
    VkImageCopy copy{};
    copy.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.dstSubresource = copy.srcSubresource;
    copy.extent = {image.extent.width, image.extent.height, 1};
    vkCmdCopyImage(commands, frame.picture.image, kCopySource.layout, image.handle, kCopyTarget.layout, 1, &copy);
    barrier(commands, image, kCopyTarget, kCopySource);
    if (moves) {
        const Access after{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT, frame.picture.layout};
        barrier(commands, frame.picture.image, VK_IMAGE_ASPECT_COLOR_BIT, kCopySource, after);
    }
    impl_->held->written = true;
}

void Canvas::paint(const Image8& image)
{
    assert(image.channels == 3 && image.width > 0 && image.height > 0);
    impl_->makeRoom({image.width, image.height});
    Impl::Held& held = *impl_->held;
    if (!impl_->commands) {
        impl_->commands.emplace(impl_->gpu, held.memory.names(), "canvas");
    }
    Memory staging_memory(impl_->gpu);
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const Buffer staging = staging_memory.buffer("window", pixels * 4, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Place::host);
    auto* const out = static_cast<std::uint8_t*>(staging.mapped);
    for (std::size_t i = 0; i < pixels; ++i) {
        std::copy_n(image.values.data() + i * 3, 3, out + i * 4);
        out[i * 4 + 3] = 255;
    }
    VkCommandBuffer commands = impl_->commands->begin();
    barrier(commands, held.image, impl_->before(), kCopyTarget);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {image.width, image.height, 1};
    vkCmdCopyBufferToImage(commands, staging.handle, held.image.handle, kCopyTarget.layout, 1, &copy);
    barrier(commands, held.image, kCopyTarget, kCopySource);
    impl_->commands->finish();
    held.written = true;
}

bool Canvas::isEmpty() const
{
    return !impl_->held || !impl_->held->written;
}

glm::uvec2 Canvas::size_px() const
{
    return isEmpty() ? glm::uvec2(0) : glm::uvec2(impl_->held->image.extent.width, impl_->held->image.extent.height);
}

struct CanvasAccess {
    static const Image& image(const Canvas& canvas) { return canvas.impl_->held->image; }
};

void recordCanvas(VkCommandBuffer commands, const Canvas& canvas, const PicturePlace& place, VkImage target)
{
    assert(!canvas.isEmpty());
    if (place.from_size_px.x <= 0 || place.from_size_px.y <= 0 || place.to_size_px.x <= 0 || place.to_size_px.y <= 0) {
        return;
    }
    VkImageBlit blit{};
    blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.dstSubresource = blit.srcSubresource;
    const glm::ivec2 from_end = place.from_px + place.from_size_px;
    const glm::ivec2 to_end = place.to_px + place.to_size_px;
    blit.srcOffsets[0] = {place.from_px.x, place.from_px.y, 0};
    blit.srcOffsets[1] = {from_end.x, from_end.y, 1};
    blit.dstOffsets[0] = {place.to_px.x, place.to_px.y, 0};
    blit.dstOffsets[1] = {to_end.x, to_end.y, 1};
    const bool shrinks = place.to_size_px.x < place.from_size_px.x || place.to_size_px.y < place.from_size_px.y;
    vkCmdBlitImage(commands, CanvasAccess::image(canvas).handle, kCopySource.layout, target, kCopyTarget.layout, 1,
                   &blit, shrinks ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
}

} // namespace gnomon::host
