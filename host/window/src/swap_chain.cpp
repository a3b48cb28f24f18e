// SPDX-License-Identifier: Apache-2.0
#include "swap_chain.h"

#include "canvas_image.h"
#include "wait.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>

namespace gnomon::host {
namespace {

constexpr const char* kTried = "showing pictures in the window";

/// Shown when the call says that the images are of another size than the window, but are shown all the same.
bool stillShows(VkResult result)
{
    return result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR;
}

} // namespace

SwapChain::Surface::Surface(Window& window, const Gpu& the_gpu)
    : gpu(the_gpu), handle(window.makeSurface(the_gpu.view().instance))
{
}

SwapChain::Surface::~Surface()
{
    if (!gpu.abandoned()) {
        vkDestroySurfaceKHR(gpu.view().instance, handle, nullptr);
    }
}

SwapChain::SwapChain(Window& window, Gpu& gpu, const DebugNames& names)
    : window_(window), gpu_(gpu), surface_(window, gpu), commands_(gpu, names, "window")
{
    VkBool32 can_show = VK_FALSE;
    check(
        vkGetPhysicalDeviceSurfaceSupportKHR(gpu.view().physical_device, gpu.queueFamily(), surface_.handle, &can_show),
        kTried);
    if (can_show == VK_FALSE) {
        throw Error(kTried, std::string(gpu.properties().deviceName) + " cannot draw in it", "name another GPU");
    }
    chooseFormat();
    makePass();
    free_ = makeSemaphore();
}

SwapChain::~SwapChain()
{
    settleQueue(gpu_);
    if (!gpu_.abandoned()) {
        (void)vkQueueWaitIdle(gpu_.queue()); // showing has no fence to wait for
        dropImages();
    }
}

void SwapChain::chooseFormat()
{
    std::uint32_t count = 0;
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(gpu_.view().physical_device, surface_.handle, &count, nullptr), kTried);
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(gpu_.view().physical_device, surface_.handle, &count, formats.data()),
          kTried);
    // Pictures and widgets are encoded already, so the screen must not encode them once more.
    for (const VkFormat wanted : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM}) {
        for (const VkSurfaceFormatKHR& format : formats) {
            if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
                format_ = format;
                return;
            }
        }
    }
    throw Error(kTried, "the screen takes no 8-bit colours as they are");
}

void SwapChain::makePass()
{
    VkAttachmentDescription colour{};
    colour.format = format_.format;
    colour.samples = VK_SAMPLE_COUNT_1_BIT;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD; // pictures are there
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    colour.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    colour.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colour.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    // What comes before has a barrier of its own; what comes after may read it.
    VkSubpassDependency after{};
    after.dstSubpass = VK_SUBPASS_EXTERNAL;
    after.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    after.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    after.dstStageMask = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    after.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &colour;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &after;
    VkRenderPass pass = VK_NULL_HANDLE;
    check(vkCreateRenderPass(gpu_.view().device, &info, nullptr, &pass), kTried);
    pass_ = {gpu_, pass};
}

OwnedSemaphore SwapChain::makeSemaphore() const
{
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    check(vkCreateSemaphore(gpu_.view().device, &info, nullptr, &semaphore), kTried);
    return {gpu_, semaphore};
}

SwapChain::Shown SwapChain::makeShown(VkImage image) const
{
    Shown shown;
    shown.image = image;
    VkImageViewCreateInfo view_info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view_info.image = image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = format_.format;
    view_info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(gpu_.view().device, &view_info, nullptr, &view), kTried);
    shown.view = {gpu_, view};
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = pass_.get();
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent_.width;
    info.height = extent_.height;
    info.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    check(vkCreateFramebuffer(gpu_.view().device, &info, nullptr, &framebuffer), kTried);
    shown.framebuffer = {gpu_, framebuffer};
    shown.drawn = makeSemaphore();
    return shown;
}

void SwapChain::dropImages()
{
    images_.clear();
    if (chain_ != VK_NULL_HANDLE) {
        vkDestroySwapchainKHR(gpu_.view().device, chain_, nullptr);
        chain_ = VK_NULL_HANDLE;
    }
}

void SwapChain::makeImages()
{
    VkSurfaceCapabilitiesKHR can{};
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu_.view().physical_device, surface_.handle, &can), kTried);
    const glm::uvec2 size = window_.size_px();
    constexpr std::uint32_t kAny = 0xFFFFFFFFU; // the screen follows the images
    extent_ = can.currentExtent.width != kAny
                  ? can.currentExtent
                  : VkExtent2D{std::clamp(size.x, can.minImageExtent.width, can.maxImageExtent.width),
                               std::clamp(size.y, can.minImageExtent.height, can.maxImageExtent.height)};
    dropImages();
    if (extent_.width == 0 || extent_.height == 0) {
        return;
    }
    constexpr VkImageUsageFlags kUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if ((can.supportedUsageFlags & kUsage) != kUsage) {
        throw Error(kTried, "images of this screen cannot be copied");
    }
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = surface_.handle;
    constexpr std::uint32_t kWished = 3; // one shown, one waiting, one drawn
    info.minImageCount =
        std::max(can.minImageCount, can.maxImageCount > 0 ? std::min(kWished, can.maxImageCount) : kWished);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = kUsage;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = (can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR; // which every screen has, and which tears nowhere
    info.clipped = VK_TRUE;
    check(vkCreateSwapchainKHR(gpu_.view().device, &info, nullptr, &chain_), kTried);
    std::uint32_t count = 0;
    check(vkGetSwapchainImagesKHR(gpu_.view().device, chain_, &count, nullptr), kTried);
    std::vector<VkImage> images(count);
    check(vkGetSwapchainImagesKHR(gpu_.view().device, chain_, &count, images.data()), kTried);
    for (VkImage image : images) {
        images_.push_back(makeShown(image));
    }
}

bool SwapChain::prepare()
{
    const glm::uvec2 size = window_.size_px();
    if (size.x == 0 || size.y == 0) {
        return false;
    }
    if (stale_ || size.x != extent_.width || size.y != extent_.height) {
        commands_.wait();
        waitForQueue(gpu_);
        check(vkQueueWaitIdle(gpu_.queue()), kTried); // showing has no fence to wait for
        makeImages();
        stale_ = false;
    }
    return !images_.empty();
}

void SwapChain::recordPictures(VkCommandBuffer commands, VkImage target, std::span<const PicturePlace> pictures) const
{
    barrier(commands, target, VK_IMAGE_ASPECT_COLOR_BIT, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}, kCopyTarget);
    const VkClearColorValue black{};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, target, kCopyTarget.layout, &black, 1, &all);
    for (const PicturePlace& place : pictures) {
        memoryBarrier(commands, kCopyTarget, kCopyTarget); // a picture may lie over another
        recordCanvas(commands, *place.canvas, place, target);
    }
    barrier(commands, target, VK_IMAGE_ASPECT_COLOR_BIT, kCopyTarget, kColourWrite);
}

void SwapChain::recordPass(VkCommandBuffer commands, const Shown& image,
                           const std::function<void(VkCommandBuffer)>& draw) const
{
    VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    begin.renderPass = pass_.get();
    begin.framebuffer = image.framebuffer.get();
    begin.renderArea.extent = extent_;
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    draw(commands);
    vkCmdEndRenderPass(commands);
}

void SwapChain::submit(const Shown& image)
{
    VkSemaphoreSubmitInfo waits{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    waits.semaphore = free_.get();
    waits.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSemaphoreSubmitInfo signals{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    signals.semaphore = image.drawn.get();
    signals.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    commands_.submit({&waits, 1}, {&signals, 1});
}

bool SwapChain::present(const Shown& image)
{
    VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    const VkSemaphore drawn = image.drawn.get();
    const auto index = static_cast<std::uint32_t>(&image - images_.data());
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &chain_;
    info.pImageIndices = &index;
    const VkResult result = vkQueuePresentKHR(gpu_.queue(), &info);
    stale_ = stale_ || result != VK_SUCCESS;
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        return false;
    }
    if (!stillShows(result)) {
        check(result, kTried);
    }
    return true;
}

bool SwapChain::show(std::span<const PicturePlace> pictures, const std::function<void(VkCommandBuffer)>& draw,
                     TexelCopies* read)
{
    commands_.wait();
    constexpr std::uint64_t kLongest_ns = 1'000'000'000; // a screen that takes nothing; the next turn tries again
    std::uint32_t index = 0;
    const VkResult free =
        vkAcquireNextImageKHR(gpu_.view().device, chain_, kLongest_ns, free_.get(), VK_NULL_HANDLE, &index);
    if (free == VK_ERROR_OUT_OF_DATE_KHR || free == VK_TIMEOUT || free == VK_NOT_READY) {
        stale_ = free == VK_ERROR_OUT_OF_DATE_KHR;
        return false;
    }
    if (!stillShows(free)) {
        check(free, kTried);
    }
    stale_ = free == VK_SUBOPTIMAL_KHR;
    const Shown& image = images_[index];
    VkCommandBuffer commands = commands_.begin();
    recordPictures(commands, image.image, pictures);
    recordPass(commands, image, draw);
    if (read != nullptr) {
        vulkan::ImageRef whole;
        whole.image = image.image;
        whole.format = format_.format;
        whole.extent = extent_;
        whole.layers = 1;
        whole.layout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        read->begin(TexelCopies::bytesOf(whole));
        texels_ = read->add(commands, whole, 0);
        TexelCopies::end(commands);
    }
    submit(image);
    return present(image);
}

} // namespace gnomon::host
