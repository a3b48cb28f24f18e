// SPDX-License-Identifier: Apache-2.0
#include "sky_table.h"

#include "commands.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace gnomon::host {
namespace {

constexpr std::size_t kTexels = SkyUnder::across * SkyUnder::up;
constexpr VkDeviceSize kTableBytes = kTexels * sizeof(std::uint64_t); // four halves

void pack(const SkyUnder::Table& table, double scale, std::uint64_t* out)
{
    for (std::size_t i = 0; i < kTexels; ++i) {
        out[i] = glm::packHalf4x16(glm::vec4(table[i] * static_cast<float>(scale), 1.0F));
    }
}

} // namespace

SkyTable::SkyTable(SceneData& scene, Memory& memory, std::size_t slots)
    : sampler_(scene.textures.plainSampler()), staging_(slots)
{
    ImageWish wish;
    wish.name = "sky tables";
    wish.purpose = "host sky";
    wish.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    wish.extent = {SkyUnder::across, SkyUnder::up};
    wish.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    wish.layers = 2 * kSkyBodies;
    wish.array_view = true;
    image_ = memory.image(wish);
    for (Buffer& one : staging_) {
        one = memory.buffer("host sky", kTableBytes * 2 * kSkyBodies, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Place::host);
    }
}

bool SkyTable::bring(std::uint32_t slot, const FrameLight& light)
{
    fresh_ = {};
    bool any = !ever_ && light.physical;
    for (std::size_t i = 0; i < kSkyBodies; ++i) {
        const SkyBody& body = light.bodies[i];
        if (!light.physical || body.under == nullptr || body.version == versions_[i]) {
            continue;
        }
        auto* const texels = static_cast<std::uint64_t*>(staging_[slot].mapped) + 2 * i * kTexels;
        pack(body.under->molecules, 1.0 / body.under->largest, texels);
        pack(body.under->dust, 1.0 / body.under->largest, texels + kTexels);
        versions_[i] = body.version;
        fresh_[i] = any = true;
    }
    return any;
}

void SkyTable::record(VkCommandBuffer cmd, std::uint32_t slot)
{
    barrier(cmd, image_, ever_ ? kSampled : discardAfter(kSampled), kCopyTarget);
    if (!ever_) { // tables that are not there yet are read as nothing
        const VkClearColorValue nothing{};
        const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, image_.layers};
        vkCmdClearColorImage(cmd, image_.handle, kCopyTarget.layout, &nothing, 1, &all);
        barrier(cmd, image_, kCopyTarget, kCopyTarget);
    }
    ever_ = true;
    for (std::uint32_t i = 0; i < kSkyBodies; ++i) {
        if (fresh_[i]) {
            VkBufferImageCopy copy{};
            copy.bufferOffset = 2 * i * kTableBytes;
            copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 2 * i, 2};
            copy.imageExtent = {image_.extent.width, image_.extent.height, 1};
            vkCmdCopyBufferToImage(cmd, staging_[slot].handle, image_.handle, kCopyTarget.layout, 1, &copy);
        }
    }
    barrier(cmd, image_, kCopyTarget, kSampled);
}

VkDescriptorImageInfo SkyTable::descriptor() const
{
    return {sampler_, image_.view, kSampled.layout};
}

} // namespace gnomon::host
