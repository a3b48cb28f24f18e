// SPDX-License-Identifier: Apache-2.0
#include <gnomon/vulkan/fin_drawer.h>

#include "classic_modules.h"
#include "descriptors.h"
#include "fin_maps.h"
#include "pipelines.h"
#include "usage.h"

#include <gnomon/plan_views.h>

#include <glm/gtc/matrix_access.hpp>
#include <gnomon/shared/shadow_volume.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon::vulkan {
namespace {

constexpr const char* kBeginningFins = "begin a frame of fins";
constexpr const char* kDrawingFins = "draw fins of smoothies";

enum FinBinding : std::uint32_t { kFinElements, kFinTriangles, kFinPositions, kFinBindingCount };
constexpr std::array<VkDescriptorType, kFinBindingCount> kFinTypes{
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
constexpr std::array kMapType{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}; // as FinPass::maps
constexpr VkShaderStageFlags kFinStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Push constants of fin_pass.glsl.
struct FinPush {
    glm::vec4 row_x;
    glm::vec4 row_y;
    glm::vec4 row_w;
    glm::vec4 row_depth;
    glm::vec4 tile;
    glm::vec4 rule;
};
static_assert(sizeof(FinPush) <= 128);

/// The push constants of a pass, without the rows.
FinPush pushOf(const FinPass& pass)
{
    const View& view = *pass.map.view;
    const Tile& tile = view.place.tile;
    FinPush push{};
    push.tile = {static_cast<float>(tile.x), static_cast<float>(tile.y), 0.5F * static_cast<float>(tile.width),
                 0.5F * static_cast<float>(tile.height)};
    const std::uint32_t reach = optionsOf(*pass.map.plan, view).asked().smoothies.reach_texels;
    push.rule = {static_cast<float>(reach), pass.quantum, static_cast<float>(tile.layer),
                 view.projection.clamp_near ? 0.0F : 1.0F};
    return push;
}

} // namespace

struct FinDrawer::Impl {
    Impl(const DeviceView& view, const FinDrawerOptions& options)
        : device(view, classicModules()), cache(options.pipeline_cache),
          sets(device, kFinTypes, VK_SHADER_STAGE_VERTEX_BIT), map_sets(device, kMapType, VK_SHADER_STAGE_FRAGMENT_BIT)
    {
        const std::uint32_t slots = checkedFrames(options.frames_in_flight);
        sets.reset(slots);
        for (std::uint32_t i = 0; i < slots; ++i) {
            slot_sets.push_back(sets.take("fins"));
        }
        const std::array layouts{sets.layout(), map_sets.layout()};
        const VkPushConstantRange push{kFinStages, 0, sizeof(FinPush)};
        VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
        info.setLayoutCount = static_cast<std::uint32_t>(layouts.size());
        info.pSetLayouts = layouts.data();
        info.pushConstantRangeCount = 1;
        info.pPushConstantRanges = &push;
        VkPipelineLayout made = VK_NULL_HANDLE;
        check(device.vk.CreatePipelineLayout(device.handle(), &info, nullptr, &made), "create a pipeline layout");
        layout = {device, made};
        pipelines = {makePipeline(false), makePipeline(true)};
    }

    [[nodiscard]] Pipeline makePipeline(bool placed);
    void checkBuffer(const BufferRef& buffer) const;
    void checkPass(const FinPass& pass) const;
    void bind(const FinPass& pass);

    Device device;
    VkPipelineCache cache;
    DescriptorSets sets;
    DescriptorSets map_sets; // their layout alone
    PipelineLayout layout;
    std::vector<VkDescriptorSet> slot_sets;
    std::array<Pipeline, 2> pipelines; // by whether the GPU places views
    std::vector<VolumeMesh> meshes;

    // This frame's.
    VkDescriptorSet set = VK_NULL_HANDLE;
    std::span<const Rows3x4> transforms;
};

Pipeline FinDrawer::Impl::makePipeline(bool placed)
{
    constexpr VkVertexInputBindingDescription kPlace{0, 0, VK_VERTEX_INPUT_RATE_INSTANCE}; // the same for all
    constexpr VkVertexInputAttributeDescription kPlaceRead{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
    const ShaderModule vertex = makeShader(device, placed ? spirv::fin_placed_vert : spirv::fin_vert);
    const ShaderModule fragment = makeShader(device, spirv::fin_frag);
    const TwoStages stages = stagesOf(vertex, fragment);
    GraphicsState state;
    state.stages = stages;
    state.layout = layout.get();
    if (placed) {
        state.bindings = std::span(&kPlace, 1);
        state.attributes = std::span(&kPlaceRead, 1);
    }
    state.colour_format = kFinFormat;
    state.depth_format = kFinOrderFormat;
    state.cache = cache;
    state.name = "fins";
    return makeGraphicsPipeline(device, state);
}

void FinDrawer::Impl::checkBuffer(const BufferRef& buffer) const
{
    if (buffer.buffer == VK_NULL_HANDLE || buffer.bytes == 0) {
        refuseUse(kBeginningFins, "a buffer of VolumeGeometry is null or empty", "fill in all three");
    }
    if (buffer.bytes > device.limits().maxStorageBufferRange) {
        refuseUse(kBeginningFins, "a buffer of VolumeGeometry is larger than maxStorageBufferRange",
                  "give fins to fewer triangles, or choose soften smoothies");
    }
}

void FinDrawer::Impl::checkPass(const FinPass& pass) const
{
    checkCommands(kDrawingFins, pass.map.commands);
    if (set == VK_NULL_HANDLE) {
        refuseUse(kDrawingFins, "no frame has begun", "call beginFrame() first");
    }
    if (pass.map.plan == nullptr || pass.map.view == nullptr || pass.maps == VK_NULL_HANDLE) {
        refuseUse(kDrawingFins, "the pass has no plan, view or maps", "hand in passes of DrawFins, as they come");
    }
}

void FinDrawer::Impl::bind(const FinPass& fins)
{
    const MapPass& pass = fins.map;
    const bool placed = pass.placement != VK_NULL_HANDLE;
    const std::array both{set, fins.maps};
    device.vk.CmdBindPipeline(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[placed ? 1 : 0].get());
    device.vk.CmdBindDescriptorSets(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 0,
                                    static_cast<std::uint32_t>(both.size()), both.data(), 0, nullptr);
    if (placed) {
        device.vk.CmdBindVertexBuffers(pass.commands, 0, 1, &pass.placement, &pass.placement_offset);
    }
}

FinDrawer::FinDrawer(const DeviceView& device, const FinDrawerOptions& options)
    : impl_(std::make_unique<Impl>(device, options))
{
}

FinDrawer::~FinDrawer() = default;

void FinDrawer::setScene(std::span<const VolumeMesh> objects)
{
    impl_->set = VK_NULL_HANDLE; // whose transforms may be too few now
    impl_->meshes.assign(objects.begin(), objects.end());
}

void FinDrawer::beginFrame(std::uint32_t slot, const VolumeGeometry& geometry,
                           std::span<const Rows3x4> world_from_object)
{
    impl_->set = VK_NULL_HANDLE; // until all of it is there
    checkSlot(kBeginningFins, slot, static_cast<std::uint32_t>(impl_->slot_sets.size()));
    if (world_from_object.size() < impl_->meshes.size()) {
        refuseUse(kBeginningFins, "there are fewer transforms than objects", "give one for each object of setScene()");
    }
    for (const BufferRef& buffer : {geometry.positions, geometry.elements, geometry.triangles}) {
        impl_->checkBuffer(buffer);
    }
    impl_->set = impl_->slot_sets[slot];
    impl_->transforms = world_from_object;
    const std::array<DescriptorSets::Write, kFinBindingCount> writes{
        DescriptorSets::buffer(kFinElements, geometry.elements.buffer, geometry.elements.bytes),
        DescriptorSets::buffer(kFinTriangles, geometry.triangles.buffer, geometry.triangles.bytes),
        DescriptorSets::buffer(kFinPositions, geometry.positions.buffer, geometry.positions.bytes)};
    impl_->sets.write(impl_->set, writes);
}

std::uint32_t FinDrawer::draw(const FinPass& fins)
{
    Impl& self = *impl_;
    self.checkPass(fins);
    const MapPass& pass = fins.map;
    const View& view = *pass.view;
    FinPush push = pushOf(fins);
    const Functions& vk = self.device.vk;
    std::uint32_t draws = 0;
    for (const std::uint32_t object : pass.casters) {
        const VolumeMesh mesh = object < self.meshes.size() ? self.meshes[object] : VolumeMesh{};
        if (mesh.element_count == 0) {
            continue;
        }
        if (draws == 0) {
            self.bind(fins);
        }
        const Rows3x4& world = self.transforms[object];
        push.row_x = pack::composedRow(glm::row(view.projection.clip_from_world, 0), world);
        push.row_y = pack::composedRow(glm::row(view.projection.clip_from_world, 1), world);
        push.row_w = pack::composedRow(glm::row(view.projection.clip_from_world, 3), world);
        push.row_depth = pack::composedRow(glm::dvec4(view.projection.metric.metric_ws), world);
        vk.CmdPushConstants(pass.commands, self.layout.get(), kFinStages, 0, sizeof push, &push);
        vk.CmdDraw(pass.commands, shared::kVolumeCorners * mesh.element_count, 1,
                   shared::kVolumeCorners * mesh.first_element, mesh.first_vertex);
        ++draws;
    }
    return draws;
}

} // namespace gnomon::vulkan
