// SPDX-License-Identifier: Apache-2.0
// The parts of a Vulkan program that the example hosts share: a device, buffers, images and pipelines. An engine has
// its own.
#pragma once

#include <gnomon/vulkan/device_view.h>

#include <glm/vec3.hpp>
#include <vulkan/vulkan_raii.hpp>

#include <array>
#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

inline constexpr std::uint32_t kSlots = 2; // frames in flight
/// A GPU of which nothing has been heard for so long hangs: two minutes.
inline constexpr std::uint64_t kPatienceNs = 120'000'000'000;

/// A cube of two units a side: the one mesh of both.
inline constexpr std::array<glm::vec3, 8> kCorners{
    {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}};
inline constexpr std::array<std::uint32_t, 36> kIndices{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                                                        1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};

struct Device {
    vk::raii::Context context;
    vk::ApplicationInfo app{nullptr, 0, nullptr, 0, VK_API_VERSION_1_3};
    vk::raii::Instance instance{context, vk::InstanceCreateInfo({}, &app)};
    vk::raii::PhysicalDevice gpu = std::move(vk::raii::PhysicalDevices(instance).front());
    float priority = 1.0F;
    vk::DeviceQueueCreateInfo queue_info{{}, 0, 1, &priority};
    gnomon::vulkan::DeviceView seen = look(); // the device that Gnomon records on
    vk::raii::Device device{
        gpu, vk::DeviceCreateInfo({}, queue_info).setPNext(&gnomon::vulkan::requiredFeatures(seen.features))};
    vk::raii::Queue queue{device, 0, 0};
    vk::raii::CommandPool pool{device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, 0}};
    vk::raii::CommandBuffers commands{device, {*pool, vk::CommandBufferLevel::ePrimary, kSlots}};
    std::array<vk::raii::Fence, kSlots> done{vk::raii::Fence(device, {vk::FenceCreateFlagBits::eSignaled}),
                                             vk::raii::Fence(device, {vk::FenceCreateFlagBits::eSignaled})};

    gnomon::vulkan::DeviceView look() const
    {
        gnomon::vulkan::DeviceView view;
        view.instance = *instance;
        view.physical_device = *gpu;
        view.get_instance_proc_addr = context.getDispatcher()->vkGetInstanceProcAddr;
        view.features = supportedFeatures(view);
        return view;
    }
    Device() { seen.device = *device; }
    vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags flags) const
    {
        const vk::PhysicalDeviceMemoryProperties memory = gpu.getMemoryProperties();
        std::uint32_t type = 0;
        while ((needs.memoryTypeBits >> type & 1U) == 0 || (memory.memoryTypes[type].propertyFlags & flags) != flags) {
            ++type;
        }
        return {device, {needs.size, type}};
    }
    /// Waits until the GPU has finished the slot's last frame, and begins to record a new one.
    const vk::raii::CommandBuffer& begin(std::uint32_t slot) const
    {
        if (device.waitForFences(*done[slot], VK_TRUE, kPatienceNs) != vk::Result::eSuccess) {
            throw std::runtime_error("the GPU has not finished a frame for two minutes");
        }
        device.resetFences(*done[slot]);
        commands[slot].begin(vk::CommandBufferBeginInfo());
        return commands[slot];
    }
    void submit(std::uint32_t slot) const
    {
        commands[slot].end();
        queue.submit(vk::SubmitInfo({}, {}, *commands[slot]), *done[slot]);
    }
};

/// Mapped for as long as it lives.
struct Buffer {
    vk::raii::Buffer buffer;
    vk::raii::DeviceMemory memory;
    void* mapped;

    Buffer(const Device& d, vk::DeviceSize bytes, vk::BufferUsageFlags usage, const void* contents = nullptr)
        : buffer(d.device, vk::BufferCreateInfo({}, bytes, usage)),
          memory(d.allocate(buffer.getMemoryRequirements(),
                            vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent)),
          mapped(memory.mapMemory(0, VK_WHOLE_SIZE))
    {
        buffer.bindMemory(*memory, 0);
        if (contents != nullptr) {
            std::memcpy(mapped, contents, bytes);
        }
    }
};

/// kCorners and kIndices where the GPU can read them.
struct Cube {
    Buffer vertices;
    Buffer indices;

    explicit Cube(const Device& d)
        : vertices(d, sizeof kCorners, vk::BufferUsageFlagBits::eVertexBuffer, kCorners.data()),
          indices(d, sizeof kIndices, vk::BufferUsageFlagBits::eIndexBuffer, kIndices.data())
    {
    }
    void bind(const vk::raii::CommandBuffer& commands) const
    {
        commands.bindVertexBuffers(0, *vertices.buffer, {0});
        commands.bindIndexBuffer(*indices.buffer, 0, vk::IndexType::eUint32);
    }
};

/// An image that is drawn to, and then read or copied.
struct Target {
    vk::raii::Image image;
    vk::raii::DeviceMemory memory;
    vk::raii::ImageView view;

    Target(const Device& d, vk::Extent2D size, vk::Format format, vk::ImageUsageFlags usage,
           vk::ImageAspectFlags aspect)
        : image(
              d.device,
              vk::ImageCreateInfo({}, vk::ImageType::e2D, format, {size.width, size.height, 1}, 1, 1).setUsage(usage)),
          memory(d.allocate(image.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal)), view(nullptr)
    {
        image.bindMemory(*memory, 0);
        view = {d.device,
                vk::ImageViewCreateInfo({}, *image, vk::ImageViewType::e2D, format, {}, {aspect, 0, 1, 0, 1})};
    }
};

/// A barrier that waits for everything: simple, and not what a real renderer should do.
inline void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
                       vk::ImageLayout from, vk::ImageLayout to)
{
    const auto barrier = vk::ImageMemoryBarrier2()
                             .setSrcStageMask(vk::PipelineStageFlagBits2::eAllCommands)
                             .setSrcAccessMask(vk::AccessFlagBits2::eMemoryWrite)
                             .setDstStageMask(vk::PipelineStageFlagBits2::eAllCommands)
                             .setDstAccessMask(vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite)
                             .setOldLayout(from)
                             .setNewLayout(to)
                             .setImage(image)
                             .setSubresourceRange({aspect, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barrier));
}

/// A pipeline for triangles with three floats a vertex. Viewport and scissor are dynamic.
struct PipelineWish {
    std::span<const std::uint32_t> vertex;
    std::span<const std::uint32_t> fragment; // empty: none
    vk::PipelineLayout layout;
    vk::Format colour = vk::Format::eUndefined;
    vk::Format depth = vk::Format::eD32Sfloat;
    vk::CompareOp compare = vk::CompareOp::eLessOrEqual;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    bool clamp_depth = false;
};
inline vk::raii::Pipeline makePipeline(const Device& d, const PipelineWish& wish)
{
    using Flags = vk::ColorComponentFlagBits;
    const vk::raii::ShaderModule vertex(d.device, {{}, wish.vertex.size_bytes(), wish.vertex.data()});
    vk::raii::ShaderModule fragment(nullptr);
    std::vector<vk::PipelineShaderStageCreateInfo> stages{{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"}};
    if (!wish.fragment.empty()) {
        fragment = {d.device, {{}, wish.fragment.size_bytes(), wish.fragment.data()}};
        stages.push_back({{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"});
    }
    const vk::VertexInputBindingDescription binding(0, 3 * sizeof(float));
    const vk::VertexInputAttributeDescription attribute(0, 0, vk::Format::eR32G32B32Sfloat);
    const vk::PipelineVertexInputStateCreateInfo input({}, binding, attribute);
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const auto viewports = vk::PipelineViewportStateCreateInfo().setViewportCount(1).setScissorCount(1);
    const auto raster =
        vk::PipelineRasterizationStateCreateInfo().setLineWidth(1).setDepthClampEnable(wish.clamp_depth);
    // Each sample has a depth of its own: MapPassFormats::write_frag_depth.
    const bool each = wish.samples != vk::SampleCountFlagBits::e1 && !wish.fragment.empty();
    const vk::PipelineMultisampleStateCreateInfo samples({}, wish.samples, each, each ? 1.0F : 0.0F);
    const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, wish.compare);
    const auto channels =
        vk::PipelineColorBlendAttachmentState().setColorWriteMask(Flags::eR | Flags::eG | Flags::eB | Flags::eA);
    const bool coloured = wish.colour != vk::Format::eUndefined;
    const auto blend = vk::PipelineColorBlendStateCreateInfo().setPAttachments(&channels).setAttachmentCount(coloured);
    const std::array states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, states);
    const auto rendering = vk::PipelineRenderingCreateInfo()
                               .setPColorAttachmentFormats(&wish.colour)
                               .setColorAttachmentCount(coloured)
                               .setDepthAttachmentFormat(wish.depth);
    return {d.device, nullptr,
            vk::GraphicsPipelineCreateInfo({}, stages, &input, &assembly, nullptr, &viewports, &raster, &samples,
                                           &depth, &blend, &dynamic, wish.layout)
                .setPNext(&rendering)};
}

/// From the upper left corner of the target to the lower right one.
inline void setViewport(const vk::raii::CommandBuffer& commands, vk::Extent2D size)
{
    commands.setViewport(0, vk::Viewport(0, 0, float(size.width), float(size.height), 0, 1));
    commands.setScissor(0, vk::Rect2D({0, 0}, size));
}

/// Linear within and between mip levels, clamped to the edge: what filterable maps are read with.
inline vk::raii::Sampler makeLinearSampler(const Device& d)
{
    constexpr auto kClamp = vk::SamplerAddressMode::eClampToEdge;
    return {d.device, vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear,
                                            vk::SamplerMipmapMode::eLinear, kClamp, kClamp)
                          .setMaxLod(VK_LOD_CLAMP_NONE)};
}

/// Four bytes a pixel, of an image in TRANSFER_SRC_OPTIMAL. Waits for the device.
inline std::vector<std::uint8_t> readBack(const Device& d, vk::Image image, vk::Extent2D size)
{
    const std::size_t bytes = std::size_t{4} * size.width * size.height;
    const Buffer pixels(d, bytes, vk::BufferUsageFlagBits::eTransferDst);
    d.device.waitIdle();
    d.begin(0).copyImageToBuffer(
        image, vk::ImageLayout::eTransferSrcOptimal, *pixels.buffer,
        vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {size.width, size.height, 1}));
    d.submit(0);
    d.device.waitIdle();
    const auto* const first = static_cast<const std::uint8_t*>(pixels.mapped);
    return {first, first + bytes};
}

/// Writes the first three of four bytes a pixel.
inline void writePpm(const std::string& path, vk::Extent2D size, const std::vector<std::uint8_t>& pixels)
{
    std::ofstream out(path, std::ios::binary);
    out << "P6\n" << size.width << ' ' << size.height << "\n255\n";
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        out.write(reinterpret_cast<const char*>(&pixels[i]), 3);
    }
}

/// Descriptor sets for fragment shaders, one for each slot: a descriptor of each type, at bindings 0, 1, ...
struct SetPool {
    vk::raii::DescriptorSetLayout layout = nullptr;
    vk::raii::DescriptorPool pool = nullptr;

    SetPool(const Device& d, std::initializer_list<vk::DescriptorType> types)
    {
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        std::vector<vk::DescriptorPoolSize> sizes;
        for (const vk::DescriptorType type : types) {
            bindings.emplace_back(std::uint32_t(bindings.size()), type, 1, vk::ShaderStageFlagBits::eFragment);
            sizes.emplace_back(type, kSlots);
        }
        layout = {d.device, {{}, bindings}};
        pool = {d.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, kSlots, sizes}};
    }
    vk::raii::DescriptorSet take(const Device& d) const
    {
        return std::move(vk::raii::DescriptorSets(d.device, {*pool, *layout}).front());
    }
};
