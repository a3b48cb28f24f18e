// SPDX-License-Identifier: Apache-2.0
#include "seen_cells.h"

#include "barriers.h"
#include "pipelines.h"
#include "samplers.h"

#include <gnomon/pack/page_table.h>
#include <gnomon_spirv.h>

#include <gnomon/shared/seen_cells.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace gnomon::vulkan {
namespace {

static_assert(sizeof(SeenCell) == sizeof(glm::vec4)); // as the shader writes it

enum Binding : std::uint32_t { kDepths, kMask, kNormals, kCells, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

glm::uvec2 cellsOf(VkExtent2D screen)
{
    const auto over = [](std::uint32_t pixels) {
        constexpr auto kSide = static_cast<std::uint32_t>(shared::kSeenCell);
        return (pixels + kSide - 1) / kSide;
    };
    return {over(screen.width), over(screen.height)};
}

bool hasPages(const Plan& plan, const LightPlan& light)
{
    return light.outcome.hasMap() && pack::hasPages((*plan.options)[light.options]);
}

/// Are these of the plan's lights?
bool shows(std::span<const PageRequests> requests, const Plan& plan)
{
    std::size_t next = 0;
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        if (hasPages(plan, plan.lights[i])) {
            if (next == requests.size() || requests[next++].light_key != plan.made_for.lights[i].key) {
                return false;
            }
        }
    }
    return next == requests.size();
}

/// All but the picture's size and where the light's cells are.
shared::SeenNumbers numbersOf(const Plan& plan, std::size_t index, const MaskInputs& inputs)
{
    const LightPlan& light = plan.lights[index];
    const Light& from = plan.made_for.lights[index];
    const Camera& camera = plan.made_for.camera;
    shared::SeenNumbers numbers{};
    numbers.light.y = static_cast<int>(light.mask_layer);
    numbers.light.z = static_cast<int>(light.mask_channel);
    const bool is_soft = (*plan.options)[light.options].integratesLight();
    numbers.light.w = (inputs.normal != VK_NULL_HANDLE ? shared::kSeenNormals : 0) |
                      (camera.reversed_z ? 0 : shared::kSeenFar) | (is_soft ? shared::kSeenSoft : 0);
    numbers.toward = glm::vec4(glm::vec3(-from.direction_ws), 0.0F);
    if (from.type != LightType::directional) {
        const double reach_m = extentOf(from, plan.made_for.scene_ws).reach_m;
        numbers.toward = glm::dvec4(from.position_ws - camera.eye_ws, reach_m);
    }
    numbers.eye_from_ndc = glm::inverse(clipFromWorld(camera) * glm::translate(glm::dmat4(1.0), camera.eye_ws));
    return numbers;
}

} // namespace

void SeenCells::warmUp()
{
    if (pipeline_) {
        return;
    }
    constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
    nearest_ = makeSampler(device_, VK_FILTER_NEAREST);
    sets_ = DescriptorSets(device_, kTypes, kStage);
    layout_ = makePipelineLayout(device_, sets_.layout(), kStage, sizeof(shared::SeenNumbers));
    pipeline_ = makeComputePipeline(device_, {spirv::seen_cells_comp, nullptr, layout_.get(), cache_, "seen cells"});
    sets_.reset(static_cast<std::uint32_t>(slots_.size()));
    for (Slot& slot : slots_) {
        slot.set = sets_.take("seen cells");
    }
}

void SeenCells::prepare(const Plan& plan, VkExtent2D screen)
{
    const auto lights = std::ranges::count_if(plan.lights, [&](const LightPlan& one) { return hasPages(plan, one); });
    if (lights == 0 || screen.width == 0 || screen.height == 0) {
        return;
    }
    warmUp();
    for (Slot& slot : slots_) {
        slot.requests.reserve(static_cast<std::size_t>(lights));
    }
    const glm::uvec2 cells = cellsOf(screen);
    const VkDeviceSize bytes = static_cast<VkDeviceSize>(lights) * cells.x * cells.y * sizeof(SeenCell);
    if (bytes <= bytes_) {
        return;
    }
    bytes_ = bytes;
    for (Slot& slot : slots_) {
        slot.requests.clear();
        device_.retire(std::move(slot.cells));
        slot.cells = HostBuffer(device_, bytes_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "seen cells");
    }
}

void SeenCells::bind(VkCommandBuffer commands, const Slot& slot, const MaskInputs& inputs, const Image& mask)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const bool has_normals = inputs.normal != VK_NULL_HANDLE;
    const std::array writes{DescriptorSets::image(kDepths, nearest_.get(), inputs.depth, inputs.depth_layout),
                            DescriptorSets::image(kMask, nearest_.get(), mask.view(), kRead),
                            DescriptorSets::image(kNormals, nearest_.get(), has_normals ? inputs.normal : inputs.depth,
                                                  has_normals ? kRead : inputs.depth_layout),
                            DescriptorSets::buffer(kCells, slot.cells.buffer())};
    sets_.write(slot.set, writes);
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &slot.set, 0,
                                     nullptr);
}

void SeenCells::record(VkCommandBuffer commands, std::uint32_t slot_index, const Plan& plan, const MaskInputs& inputs,
                       const Image& mask, bool kept)
{
    Slot& slot = slots_[slot_index];
    masks_ += kept ? 0 : 1;
    if (kept && slot.mask == masks_ && shows(slot.requests, plan)) {
        return;
    }
    slot.mask = masks_;
    slot.requests.clear();
    const glm::uvec2 cells = cellsOf(inputs.extent);
    const std::size_t per_light = std::size_t{cells.x} * cells.y;
    const auto* const written = static_cast<const SeenCell*>(slot.cells ? slot.cells.data() : nullptr);
    for (std::size_t i = 0; i < plan.lights.size() && written != nullptr; ++i) {
        const LightPlan& light = plan.lights[i];
        if (!hasPages(plan, light) || (slot.requests.size() + 1) * per_light * sizeof(SeenCell) > bytes_) {
            continue;
        }
        if (slot.requests.empty()) {
            bind(commands, slot, inputs, mask);
        }
        const std::size_t first = slot.requests.size() * per_light;
        shared::SeenNumbers numbers = numbersOf(plan, i, inputs);
        numbers.size = glm::ivec4(glm::uvec4(inputs.extent.width, inputs.extent.height, cells.x, cells.y));
        numbers.light.x = static_cast<int>(first);
        device_.vk.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof numbers, &numbers);
        constexpr auto kGroup = static_cast<std::uint32_t>(shared::kSeenGroup);
        device_.vk.CmdDispatch(commands, (cells.x + kGroup - 1) / kGroup, (cells.y + kGroup - 1) / kGroup, 1);
        slot.requests.push_back({plan.made_for.lights[i].key,
                                 clipFromWorld(plan.made_for.camera),
                                 {inputs.extent.width, inputs.extent.height},
                                 {written + first, per_light}});
    }
    if (!slot.requests.empty()) {
        recordBarrier(device_, commands,
                      MemoryBarrier{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                    VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    }
}

std::span<const PageRequests> SeenCells::read(std::uint32_t slot) const
{
    return slot < slots_.size() ? std::span<const PageRequests>(slots_[slot].requests)
                                : std::span<const PageRequests>();
}

} // namespace gnomon::vulkan
