// SPDX-License-Identifier: Apache-2.0
#include <gnomon/vulkan/volume_drawer.h>

#include "classic_modules.h"
#include "descriptors.h"
#include "optional_parts.h"
#include "pipelines.h"
#include "usage.h"

#include <gnomon/shared/bias.h>
#include <gnomon/shared/shadow_volume.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon::vulkan {
namespace {

constexpr const char* kBeginningVolumes = "begin a frame of shadow volumes";
constexpr const char* kDrawingVolumes = "draw shadow volumes";

enum VolumeBinding : std::uint32_t { kElements, kTriangles, kPositions, kVolumeBindingCount };
constexpr std::array<VkDescriptorType, kVolumeBindingCount> kVolumeTypes{
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

/// Push constants of volume.vert.
struct VolumePush {
    glm::mat4 clip_from_eye;
    Rows3x4 rows; // eye-relative from object
    glm::vec4 place;
};
static_assert(sizeof(VolumePush) == 128);

/// How far behind a surface a light cap in it lies, in pixels of the surface's own slope. The depths of both are those
/// of points up to this far away along each axis, and the slope counts only the steeper axis.
float capSlope_px(const Device& device)
{
    return 2.0F * shared::snapOf(static_cast<float>(device.subPixelBits()));
}

/// Behind what is seen a face that turns away from the eye leads out of a volume, and one that turns to it leads in.
VkPipelineDepthStencilStateCreateInfo countingState(bool reversed_z, bool depth_bounds)
{
    VkPipelineDepthStencilStateCreateInfo state{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    state.depthTestEnable = VK_TRUE;
    state.depthCompareOp = reversed_z ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    state.depthBoundsTestEnable = depth_bounds ? VK_TRUE : VK_FALSE;
    state.stencilTestEnable = VK_TRUE;
    state.front.failOp = VK_STENCIL_OP_KEEP;
    state.front.passOp = VK_STENCIL_OP_KEEP;
    state.front.depthFailOp = VK_STENCIL_OP_DECREMENT_AND_WRAP;
    state.front.compareOp = VK_COMPARE_OP_ALWAYS;
    state.front.compareMask = 0xFF;
    state.front.writeMask = 0xFF;
    state.back = state.front;
    state.back.depthFailOp = VK_STENCIL_OP_INCREMENT_AND_WRAP;
    return state;
}

} // namespace

struct VolumeDrawer::Impl {
    struct Made {
        VkFormat colour = VK_FORMAT_UNDEFINED;
        VkFormat depth_stencil = VK_FORMAT_UNDEFINED;
        bool reversed_z = true;
        Pipeline pipeline;
    };

    Impl(const DeviceView& view, const VolumeDrawerOptions& options)
        : device(view, classicModules()), cache(options.pipeline_cache), shader(makeShader(device, spirv::volume_vert)),
          sets(device, kVolumeTypes, VK_SHADER_STAGE_VERTEX_BIT),
          layout(makePipelineLayout(device, sets.layout(), VK_SHADER_STAGE_VERTEX_BIT, sizeof(VolumePush)))
    {
        const std::uint32_t slots = checkedFrames(options.frames_in_flight);
        sets.reset(slots);
        for (std::uint32_t i = 0; i < slots; ++i) {
            slot_sets.push_back(sets.take("shadow volumes"));
        }
    }

    [[nodiscard]] Pipeline makePipeline(const VolumePass& pass);
    [[nodiscard]] VkPipeline pipelineFor(const VolumePass& pass);
    void checkBuffer(const BufferRef& buffer) const;
    [[nodiscard]] VolumePush pushOf(const VolumePass& pass, std::uint32_t object) const;

    Device device;
    VkPipelineCache cache;
    ShaderModule shader;
    DescriptorSets sets;
    PipelineLayout layout;
    std::vector<VkDescriptorSet> slot_sets;
    std::vector<Made> made; // few: of one light, of several
    std::vector<VolumeMesh> meshes;

    // This frame's.
    VkDescriptorSet set = VK_NULL_HANDLE;
    std::span<const Rows3x4> transforms;
    std::uint64_t triangles = 0;
};

Pipeline VolumeDrawer::Impl::makePipeline(const VolumePass& pass)
{
    VkPipelineShaderStageCreateInfo vertex{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    vertex.stage = VK_SHADER_STAGE_VERTEX_BIT;
    vertex.module = shader.get();
    vertex.pName = "main";
    requirePart(device, "draw shadow volumes", &FeatureUses::depth_clamp);
    const VkPipelineDepthStencilStateCreateInfo counting = countingState(pass.reversed_z, device.uses().depth_bounds);
    GraphicsState state;
    state.stages = std::span(&vertex, 1);
    state.layout = layout.get();
    state.colour_format = pass.colour;
    state.colour_mask = 0;
    state.depth_format = pass.depth_stencil;
    state.stencil_format = pass.depth_stencil;
    state.depth_stencil = &counting;
    state.depth_clamp = true;
    state.depth_bias_slope = capSlope_px(device) * (pass.reversed_z ? -1.0F : 1.0F);
    state.cache = cache;
    state.name = "shadow volumes";
    return makeGraphicsPipeline(device, state);
}

VkPipeline VolumeDrawer::Impl::pipelineFor(const VolumePass& pass)
{
    const auto found = std::ranges::find_if(made, [&](const Made& one) {
        return one.colour == pass.colour && one.depth_stencil == pass.depth_stencil &&
               one.reversed_z == pass.reversed_z;
    });
    return found != made.end()
               ? found->pipeline.get()
               : made.emplace_back(Made{pass.colour, pass.depth_stencil, pass.reversed_z, makePipeline(pass)})
                     .pipeline.get();
}

void VolumeDrawer::Impl::checkBuffer(const BufferRef& buffer) const
{
    if (buffer.buffer == VK_NULL_HANDLE || buffer.bytes == 0) {
        refuseUse(kBeginningVolumes, "a buffer of VolumeGeometry is null or empty", "fill in all three");
    }
    if (buffer.bytes > device.limits().maxStorageBufferRange) {
        refuseUse(kBeginningVolumes, "a buffer of VolumeGeometry is larger than maxStorageBufferRange",
                  "cast by volumes of fewer triangles, or choose a filter with maps");
    }
}

VolumePush VolumeDrawer::Impl::pushOf(const VolumePass& pass, std::uint32_t object) const
{
    VolumePush push{pass.clip_from_eye, transforms[object], pass.place};
    const auto move = [](glm::vec4& row, double eye) {
        row.w = static_cast<float>(double{row.w} - eye);
    };
    move(push.rows.x, pass.eye_ws.x);
    move(push.rows.y, pass.eye_ws.y);
    move(push.rows.z, pass.eye_ws.z);
    return push;
}

VolumeDrawer::VolumeDrawer(const DeviceView& device, const VolumeDrawerOptions& options)
    : impl_(std::make_unique<Impl>(device, options))
{
}

VolumeDrawer::~VolumeDrawer() = default;

void VolumeDrawer::setScene(std::span<const VolumeMesh> objects)
{
    impl_->set = VK_NULL_HANDLE; // whose transforms may be too few now
    impl_->meshes.assign(objects.begin(), objects.end());
}

void VolumeDrawer::beginFrame(std::uint32_t slot, const VolumeGeometry& geometry,
                              std::span<const Rows3x4> world_from_object)
{
    impl_->set = VK_NULL_HANDLE; // until all of it is there
    checkSlot(kBeginningVolumes, slot, static_cast<std::uint32_t>(impl_->slot_sets.size()));
    if (world_from_object.size() < impl_->meshes.size()) {
        refuseUse(kBeginningVolumes, "there are fewer transforms than objects",
                  "give one for each object of setScene()");
    }
    for (const BufferRef& buffer : {geometry.positions, geometry.elements, geometry.triangles}) {
        impl_->checkBuffer(buffer);
    }
    impl_->set = impl_->slot_sets[slot];
    impl_->transforms = world_from_object;
    impl_->triangles = 0;
    const std::array<DescriptorSets::Write, kVolumeBindingCount> writes{
        DescriptorSets::buffer(kElements, geometry.elements.buffer, geometry.elements.bytes),
        DescriptorSets::buffer(kTriangles, geometry.triangles.buffer, geometry.triangles.bytes),
        DescriptorSets::buffer(kPositions, geometry.positions.buffer, geometry.positions.bytes)};
    impl_->sets.write(impl_->set, writes);
}

std::uint32_t VolumeDrawer::draw(const VolumePass& pass)
{
    Impl& self = *impl_;
    checkCommands(kDrawingVolumes, pass.commands);
    if (self.set == VK_NULL_HANDLE) {
        refuseUse(kDrawingVolumes, "no frame has begun", "call beginFrame() first");
    }
    const Functions& vk = self.device.vk;
    vk.CmdBindPipeline(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, self.pipelineFor(pass));
    vk.CmdBindDescriptorSets(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, self.layout.get(), 0, 1, &self.set, 0,
                             nullptr);
    std::uint32_t draws = 0;
    for (const std::uint32_t object : pass.casters) {
        const VolumeMesh mesh = object < self.meshes.size() ? self.meshes[object] : VolumeMesh{};
        if (mesh.element_count == 0) {
            continue;
        }
        const VolumePush push = self.pushOf(pass, object);
        vk.CmdPushConstants(pass.commands, self.layout.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
        vk.CmdDraw(pass.commands, shared::kVolumeCorners * mesh.element_count, 1,
                   shared::kVolumeCorners * mesh.first_element, mesh.first_vertex);
        self.triangles += 2 * std::uint64_t{mesh.element_count};
        ++draws;
    }
    return draws;
}

std::uint64_t VolumeDrawer::triangles() const
{
    return impl_->triangles;
}

} // namespace gnomon::vulkan
