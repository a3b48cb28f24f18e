// SPDX-License-Identifier: Apache-2.0
#include "mask_history.h"

#include "barriers.h"

#include <gnomon/plan_views.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cassert>

namespace gnomon::vulkan {
namespace {

ImageBarrier barrierOf(const Image& image)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image.info().layers;
    return barrier;
}

bool isAlike(const ImageInfo& a, const ImageInfo& b)
{
    return a.format == b.format && a.layers == b.layers && a.extent.width == b.extent.width &&
           a.extent.height == b.extent.height;
}

} // namespace

MaskPlace maskPlaceOf(const LightPlan& light)
{
    return {light.mask_layer, maskChannelsOf(light)};
}

bool MaskHistory::prepare(const ImageInfo& mask)
{
    ImageInfo wanted = mask;
    wanted.format = visibilityFormat(kind_, mask.format);
    if (now().visibility && isAlike(now().visibility.info(), wanted)) {
        return false;
    }
    for (Images& images : images_) {
        device_.retire(std::move(images.visibility));
        device_.retire(std::move(images.surfaces));
        ImageInfo info = wanted;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        info.purpose = "mask of the frame before";
        images.visibility = Image(device_, info);
        info.format = kind_.surfaces;
        images.surfaces = Image(device_, info);
    }
    fresh_ = true;
    return true;
}

VkFormat MaskHistory::visibilityFormat(const Kind& kind, VkFormat mask)
{
    if (!kind.precise) {
        return mask;
    }
    return mask == VK_FORMAT_R8_UNORM ? VK_FORMAT_R16_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
}

std::array<const Image*, 2> MaskHistory::written(const Images& images) const
{
    return {&images.surfaces, kind_.makes_visibility ? &images.visibility : nullptr};
}

void MaskHistory::begin(VkCommandBuffer commands)
{
    if (fresh_) { // nobody reads what is not there, but shaders name it
        for (const Image* image : {&before().visibility, &before().surfaces}) {
            ImageBarrier barrier = barrierOf(*image);
            barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
            barrier.target_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
            barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
            recordBarrier(device_, commands, barrier);
        }
    }
    for (const Image* image : written(now())) {
        if (image != nullptr) {
            ImageBarrier barrier = barrierOf(*image);
            barrier.new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL; // every pixel is written
            barrier.source_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
            barrier.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
            barrier.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
            recordBarrier(device_, commands, barrier);
        }
    }
}

void MaskHistory::end(VkCommandBuffer commands, const Plan& plan)
{
    for (const Image* image : written(now())) {
        if (image != nullptr) {
            ImageBarrier barrier = barrierOf(*image);
            barrier.old_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
            barrier.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
            barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
            barrier.target_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
            barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
            recordBarrier(device_, commands, barrier);
        }
    }
    camera_ = plan.made_for.camera;
    turn_ = 1 - turn_;
    fresh_ = false;
}

Reprojection MaskHistory::reprojection(const Plan& plan) const
{
    const VkExtent2D extent = now().visibility.info().extent;
    const glm::dmat4 before_from_eye =
        camera_.clip_from_world * glm::translate(glm::dmat4(1.0), plan.made_for.camera.eye_ws);
    const glm::dvec4 w = glm::row(before_from_eye, 3);
    // This pixel stands for where it would look without jitter, and so does that one.
    const glm::dvec2 shift = plan.made_for.camera.jitter_px - camera_.jitter_px;
    return {(glm::row(before_from_eye, 0) + w) * (0.5 * extent.width) + w * shift.x,
            (glm::row(before_from_eye, 1) + w) * (0.5 * extent.height) + w * shift.y, w,
            glm::dvec4(plan.made_for.camera.eye_ws - camera_.eye_ws, 0.0)};
}

bool MaskHistory::stands(const Plan& plan) const
{
    const VkExtent2D extent = now().visibility.info().extent;
    return sameSight(camera_, plan.made_for.camera, {extent.width, extent.height});
}

void beginJoining(const Device& device, VkCommandBuffer commands, VkExtent2D extent,
                  std::span<const VkImageView> targets)
{
    std::array<VkRenderingAttachmentInfo, 3> colours{};
    assert(targets.size() <= colours.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        colours[i].sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        colours[i].imageView = targets[i];
        colours[i].imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        colours[i].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        colours[i].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    }
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(targets.size());
    info.pColorAttachments = colours.data();
    device.vk.CmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    device.vk.CmdSetViewport(commands, 0, 1, &viewport);
    device.vk.CmdSetScissor(commands, 0, 1, &info.renderArea);
}

} // namespace gnomon::vulkan
