// SPDX-License-Identifier: Apache-2.0
#include "blur_kernel.h"
#include "blur_pass.h"
#include "draw_view.h"
#include "map_storage.h"
#include "moment_rule_of.h"

#include <gpu_structs.h>

#include <gnomon/vulkan/blur_trial.h>

#include <algorithm>
#include <array>
#include <cassert>

namespace gnomon::vulkan {
namespace {

constexpr std::uint32_t kSize = 512;
constexpr std::uint32_t kRounds = 4; // the first one warms up; of all, the shortest counts
constexpr std::uint32_t kBlocks = (kSize / shared::kBlockTexels) * (kSize / shared::kBlockTexels);

const MapStorage& storageOf(const Device& device, const FilterOptions& filter)
{
    assert(isFilterable(filter.filter) && blurRadius(filter.moments) > 0);
    const MapStorage* storage = findMapStorage(filter.format);
    assert(storage != nullptr);
    requireAveraging(device.features(storage->colour), filter.filter, filter.format, "try both ways to blur");
    return *storage;
}

QueryPool makeTimes(Device& device)
{
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 4 * kRounds;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(device.vk.CreateQueryPool(device.handle(), &info, nullptr, &pool), "create a query pool");
    return {device, pool};
}

} // namespace

struct BlurTrial::Impl {
    Impl(const DeviceView& view, const FilterOptions& filter, VkPipelineCache cache);

    void makeImages(const FilterOptions& filter, VkFormat format);
    void clear(VkCommandBuffer commands, const Image& image) const;

    Device device;
    FilterLayout layout;
    std::uint32_t image_layers;
    std::array<BlurPass, 2> ways; // compute, fragment
    MomentImages images;
    HostBuffer depth_layers;
    QueryPool times; // two a turn: round after round, the ways by turns
};

BlurTrial::Impl::Impl(const DeviceView& view, const FilterOptions& filter, VkPipelineCache cache)
    : device(view), layout(device, cache), image_layers(imageLayersPerMap(filter.filter, filter.moments)),
      ways{BlurPass(layout, filterConstants(filter), storageOf(device, filter).colour, BlurPath::compute),
           BlurPass(layout, filterConstants(filter), storageOf(device, filter).colour, BlurPath::fragment)},
      times(makeTimes(device))
{
    makeImages(filter, storageOf(device, filter).colour);
    layout.reset(2 * BlurPass::kSets);
    for (BlurPass& way : ways) {
        way.makeSets(images);
    }
}

void BlurTrial::Impl::makeImages(const FilterOptions& filter, VkFormat format)
{
    constexpr const char* kPurpose = "blur trial";
    ImageInfo info;
    info.format = format;
    info.extent = {kSize, kSize};
    info.layers = image_layers;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    info.purpose = kPurpose;
    images.maps = Image(device, info);
    images.scratch = Image(device, info);
    images.blocks = DeviceBuffer(device, 4 * VkDeviceSize{kBlocks},
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kPurpose);
    images.kernel = HostBuffer(device, sizeof(shared::BlurKernel), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, kPurpose);
    *static_cast<shared::BlurKernel*>(images.kernel.data()) = blurKernel(filter.moments);
    images.counts = HostBuffer(device, sizeof(shared::BlurCounts), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kPurpose);
    *static_cast<shared::BlurCounts*>(images.counts.data()) = {};
    depth_layers = HostBuffer(device, sizeof(shared::GpuDepthLayers), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kPurpose);
    images.depth_layers = depth_layers.buffer();
}

// To numbers that no hardware is slow with.
void BlurTrial::Impl::clear(VkCommandBuffer commands, const Image& image) const
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image_layers;
    barrier.new_layout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device, commands, barrier);
    for (std::uint32_t i = 0; i < image_layers; ++i) {
        VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        colour.imageView = image.layer(i);
        colour.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
        colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        colour.clearValue.color = {{0.5F, 0.25F, 0.5F, 0.25F}};
        VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
        info.renderArea.extent = {kSize, kSize};
        info.layerCount = 1;
        info.colorAttachmentCount = 1;
        info.pColorAttachments = &colour;
        device.vk.CmdBeginRendering(commands, &info);
        device.vk.CmdEndRendering(commands);
    }
}

BlurTrial::BlurTrial(const DeviceView& device, const FilterOptions& filter, VkPipelineCache cache)
    : impl_(std::make_unique<Impl>(device, filter, cache))
{
}

BlurTrial::~BlurTrial() = default;

void BlurTrial::record(VkCommandBuffer commands)
{
    Impl& self = *impl_;
    const Device& device = self.device;
    device.vk.ResetQueryPool(device.handle(), self.times.get(), 0, 4 * kRounds);
    device.beginLabel(commands, "blur trial");
    self.clear(commands, self.images.maps);
    self.clear(commands, self.images.scratch);
    device.vk.CmdFillBuffer(commands, self.images.blocks.buffer(), 0, VK_WHOLE_SIZE, 1); // casters everywhere
    MemoryBarrier barrier;
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                            VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    recordBarrier(device, commands, barrier);
    FilterStep step;
    step.commands = commands;
    step.tile = {0, 0, 0, kSize, kSize};
    step.image_layers = self.image_layers;
    const auto stamp = [&](std::uint32_t query) {
        device.vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, self.times.get(), query);
    };
    // A turn's first writes wait for the last reads of the turn before.
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    for (std::uint32_t turn = 0; turn < 2 * kRounds; ++turn) {
        stamp(2 * turn);
        self.ways[turn % 2].record(step, self.images);
        recordBarrier(device, commands, barrier);
        stamp(2 * turn + 1);
    }
    device.endLabel(commands);
}

double BlurTrial::milliseconds(BlurPath path) const
{
    assert(path != BlurPath::automatic);
    const Device& device = impl_->device;
    std::array<std::uint64_t, 4 * kRounds> ticks{};
    if (device.vk.GetQueryPoolResults(device.handle(), impl_->times.get(), 0, 4 * kRounds, sizeof ticks, ticks.data(),
                                      sizeof ticks[0], VK_QUERY_RESULT_64_BIT) != VK_SUCCESS) {
        return 0.0;
    }
    std::uint64_t least = UINT64_MAX;
    for (std::size_t turn = path == BlurPath::compute ? 0 : 1; turn < 2 * kRounds; turn += 2) {
        least = std::min(least, ticks[2 * turn + 1] - ticks[2 * turn]);
    }
    return static_cast<double>(least) * static_cast<double>(device.limits().timestampPeriod) * 1e-6;
}

BlurPath BlurTrial::faster() const
{
    return milliseconds(BlurPath::fragment) < milliseconds(BlurPath::compute) ? BlurPath::fragment : BlurPath::compute;
}

} // namespace gnomon::vulkan
