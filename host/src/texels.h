// SPDX-License-Identifier: Apache-2.0
// Images copied to memory, and their texels as plain numbers.
#pragma once

#include "commands.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::host {

/// The layout of an image's texels in memory.
enum class Number : std::uint8_t { unorm8, unorm16, half, single, other };
struct TexelForm {
    std::uint32_t channels = 1;
    std::uint32_t bytes = 4; // bytes of all channels together
    Number number = Number::other;
};
[[nodiscard]] TexelForm formOf(VkFormat format);
/// Texels as plain numbers, as many as `out` holds; false for forms that are not read this way.
[[nodiscard]] bool convert(const void* texels, Number number, std::vector<float>& out);

/// Layers of images, one after the other in mapped memory.
class TexelCopies {
public:
    explicit TexelCopies(const Gpu& gpu);

    /// To be called before add(): forgets earlier copies, and makes room.
    void begin(VkDeviceSize bytes);
    [[nodiscard]] static VkDeviceSize bytesOf(const vulkan::ImageRef& image);
    /// Records the copy of one layer at its finest level, and returns its future place. `image` has been written by
    /// passes whose writes are visible as its layout says; it is left in that layout.
    [[nodiscard]] const void* add(VkCommandBuffer commands, const vulkan::ImageRef& image, std::uint32_t layer);
    /// To be called after the last add(): the host may read once the GPU is done.
    static void end(VkCommandBuffer commands);
    /// To be called once the GPU is done, before the host reads. Throws Error.
    void makeVisible() const { memory_.makeVisible(buffer_); }

private:
    Memory memory_;
    Buffer buffer_;
    VkDeviceSize used_ = 0;
};

} // namespace gnomon::host
