// SPDX-License-Identifier: Apache-2.0
// How many bytes a second a copy reads and writes: what passes that only move memory are held against on a GPU
// (tools/on_gpu.sh). The figure is a property of the result.
#include "fixture.h"

#include "device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

namespace gnomon::test {
namespace {

TEST(CopyRate, ofBuffersIsMeasured)
{
    constexpr VkDeviceSize kBytes = VkDeviceSize{64} << 20;
    constexpr int kCopies = 32;
    vulkan::Device device(gpu().view());
    constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const vulkan::DeviceBuffer from(device, kBytes, kUsage, "copy rate");
    const vulkan::DeviceBuffer to(device, kBytes, kUsage, "copy rate");
    const auto secondsOf = [&](int times) {
        const auto began = std::chrono::steady_clock::now();
        gpu().run([&](VkCommandBuffer commands) {
            for (int i = 0; i < times; ++i) {
                const VkBufferCopy whole{0, 0, kBytes};
                vkCmdCopyBuffer(commands, from.buffer(), to.buffer(), 1, &whole);
                VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
                barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
                barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
                vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1,
                                     &barrier, 0, nullptr, 0, nullptr);
            }
        });
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    };
    (void)secondsOf(1);
    // Less what a submission takes by itself.
    const double seconds = std::max(secondsOf(kCopies + 1) - secondsOf(1), 1e-9);
    const double rate = 2.0 * static_cast<double>(kBytes) * kCopies / seconds;
    RecordProperty("copy_bytes_per_s", std::to_string(rate));
    EXPECT_GT(rate, 1e6);
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
