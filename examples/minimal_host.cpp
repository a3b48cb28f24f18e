// SPDX-License-Identifier: Apache-2.0
// The least that a renderer needs to get soft-shadow masks from Gnomon: it owns its device, its frame loop and its
// depth prepass, and hands Gnomon a frame and a way to draw. Usage: minimal_host FOLDER. Writes the masks of a sun and
// a spot light there as PGM; exits with 1 if they are not as the scene's geometry says.
#include <gnomon/planner.h>
#include <gnomon/vulkan/caster_drawer.h>

#include <gnomon_example_spirv.h>

#include <glm/gtc/matrix_transform.hpp>
#include <vulkan/vulkan_raii.hpp>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace {

constexpr vk::Extent2D kSize{640, 400};
constexpr std::uint32_t kSlots = 2; // frames in flight
constexpr int kFrames = 6;

// ---- What every Vulkan program has.

struct Device {
    vk::raii::Context context;
    vk::ApplicationInfo app{nullptr, 0, nullptr, 0, VK_API_VERSION_1_3};
    vk::raii::Instance instance{context, vk::InstanceCreateInfo({}, &app)};
    vk::raii::PhysicalDevice gpu = std::move(vk::raii::PhysicalDevices(instance).front());
    float priority = 1.0F;
    vk::DeviceQueueCreateInfo queue_info{{}, 0, 1, &priority};
    vk::raii::Device device{gpu, vk::DeviceCreateInfo({}, queue_info).setPNext(&gnomon::vulkan::requiredFeatures())};
    vk::raii::Queue queue{device, 0, 0};
    vk::raii::CommandPool pool{device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, 0}};
    vk::raii::CommandBuffers commands{device, {*pool, vk::CommandBufferLevel::ePrimary, kSlots}};
    std::array<vk::raii::Fence, kSlots> done{vk::raii::Fence(device, {vk::FenceCreateFlagBits::eSignaled}),
                                             vk::raii::Fence(device, {vk::FenceCreateFlagBits::eSignaled})};

    gnomon::vulkan::DeviceView view() const
    {
        gnomon::vulkan::DeviceView view;
        view.instance = *instance;
        view.physical_device = *gpu;
        view.device = *device;
        view.get_instance_proc_addr = context.getDispatcher()->vkGetInstanceProcAddr;
        return view;
    }

    vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags flags) const
    {
        const vk::PhysicalDeviceMemoryProperties memory = gpu.getMemoryProperties();
        std::uint32_t type = 0;
        while ((needs.memoryTypeBits >> type & 1U) == 0 || (memory.memoryTypes[type].propertyFlags & flags) != flags) {
            ++type;
        }
        return {device, {needs.size, type}};
    }
};

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

// A barrier that waits for everything: simple, and not what a real renderer should do.
void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
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

// ---- The scene: boxes on and over a ground (object 0, a box too), a sun and a spot light.

struct Scene {
    std::array<glm::vec3, 4> centres{{{0, -0.5F, 0}, {0, 1, 0}, {-3, 0.75F, 2}, {2.5F, 3, 1}}};
    std::array<glm::vec3, 4> halves{{{20, 0.5F, 20}, {1, 1, 1}, {0.5F, 0.75F, 0.5F}, {1, 0.1F, 1}}};
    std::array<gnomon::vulkan::Rows3x4, 4> world_from_object{};
    gnomon::ObjectSet objects;
    std::array<gnomon::Light, 2> lights{};
    gnomon::Frame frame;

    Scene()
    {
        for (std::size_t i = 0; i < centres.size(); ++i) {
            const glm::vec3 c = centres[i];
            const glm::vec3 h = halves[i];
            world_from_object[i] = {{h.x, 0, 0, c.x}, {0, h.y, 0, c.y}, {0, 0, h.z, c.z}};
            objects.add({c - h, c + h});
        }
        lights[0].direction_ws = glm::normalize(glm::dvec3(0.8, -1.0, 0.3));
        lights[1].key = 1;
        lights[1].type = gnomon::LightType::spot;
        lights[1].position_ws = {4.0, 7.0, -5.0};
        lights[1].direction_ws = glm::normalize(glm::dvec3(0.0) - lights[1].position_ws);
        lights[1].outer_half_angle_rad = 0.6;
        lights[1].range_m = 30.0;
        const glm::dvec3 eye(3.0, 9.0, 11.0);
        // Far and near swapped: reversed depth. And y down, as Vulkan has it.
        glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.8, double(kSize.width) / kSize.height, 100.0, 0.1);
        clip_from_view[1][1] = -clip_from_view[1][1];
        frame.camera.eye_ws = eye;
        frame.camera.clip_from_world = clip_from_view * glm::lookAtRH(eye, glm::dvec3(0.0), glm::dvec3(0, 1, 0));
        frame.size_px = {kSize.width, kSize.height};
        frame.lights = lights;
        frame.objects = &objects;
    }
};

// A cube of two units a side.
constexpr std::array<glm::vec3, 8> kCorners{
    {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}};
constexpr std::array<std::uint32_t, 36> kIndices{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                                                 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};

// ---- The host's own depth prepass, one draw an object.

struct Prepass {
    vk::raii::Image image;
    vk::raii::DeviceMemory memory;
    vk::raii::ImageView view;
    vk::raii::PipelineLayout layout;
    vk::raii::Pipeline pipeline;

    explicit Prepass(const Device& d)
        : image(
              d.device,
              vk::ImageCreateInfo({}, vk::ImageType::e2D, vk::Format::eD32Sfloat, {kSize.width, kSize.height, 1}, 1, 1)
                  .setUsage(vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled)),
          memory(d.allocate(image.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal)), view(nullptr),
          layout(nullptr), pipeline(nullptr)
    {
        image.bindMemory(*memory, 0);
        view = {d.device, vk::ImageViewCreateInfo({}, *image, vk::ImageViewType::e2D, vk::Format::eD32Sfloat, {},
                                                  {vk::ImageAspectFlagBits::eDepth, 0, 1, 0, 1})};
        const vk::PushConstantRange range(vk::ShaderStageFlagBits::eVertex, 0, sizeof(glm::mat4));
        layout = {d.device, vk::PipelineLayoutCreateInfo().setPushConstantRanges(range)};
        const auto code = gnomon::spirv::minimal_host_vert;
        const vk::raii::ShaderModule module(d.device, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eVertex, *module, "main");
        const vk::VertexInputBindingDescription binding(0, sizeof(glm::vec3));
        const vk::VertexInputAttributeDescription attribute(0, 0, vk::Format::eR32G32B32Sfloat);
        const vk::PipelineVertexInputStateCreateInfo input({}, binding, attribute);
        const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
        const vk::Viewport viewport(0, 0, kSize.width, kSize.height, 0, 1);
        const vk::Rect2D area({0, 0}, kSize);
        const vk::PipelineViewportStateCreateInfo viewports({}, viewport, area);
        const auto raster = vk::PipelineRasterizationStateCreateInfo().setLineWidth(1);
        const vk::PipelineMultisampleStateCreateInfo samples;
        const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eGreater);
        const vk::PipelineRenderingCreateInfo rendering(0, {}, vk::Format::eD32Sfloat);
        pipeline = {d.device, nullptr,
                    vk::GraphicsPipelineCreateInfo({}, stage, &input, &assembly, nullptr, &viewports, &raster, &samples,
                                                   &depth, nullptr, nullptr, *layout)
                        .setPNext(&rendering)};
    }

    void record(const vk::raii::CommandBuffer& commands, const Scene& scene, vk::Buffer vertices, vk::Buffer indices)
    {
        transition(commands, *image, vk::ImageAspectFlagBits::eDepth, vk::ImageLayout::eUndefined,
                   vk::ImageLayout::eDepthAttachmentOptimal);
        const auto depth = vk::RenderingAttachmentInfo(*view, vk::ImageLayout::eDepthAttachmentOptimal)
                               .setLoadOp(vk::AttachmentLoadOp::eClear); // to 0: far, as depth is reversed
        commands.beginRendering(vk::RenderingInfo({}, {{0, 0}, kSize}).setLayerCount(1).setPDepthAttachment(&depth));
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        commands.bindVertexBuffers(0, vertices, {0});
        commands.bindIndexBuffer(indices, 0, vk::IndexType::eUint32);
        for (std::size_t i = 0; i < scene.centres.size(); ++i) {
            const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(scene.centres[i]));
            const glm::mat4 clip_from_object(scene.frame.camera.clip_from_world *
                                             glm::scale(place, glm::dvec3(scene.halves[i])));
            commands.pushConstants<glm::mat4>(*layout, vk::ShaderStageFlagBits::eVertex, 0, clip_from_object);
            commands.drawIndexed(kIndices.size(), 1, 0, 0, 0);
        }
        commands.endRendering();
        transition(commands, *image, vk::ImageAspectFlagBits::eDepth, vk::ImageLayout::eDepthAttachmentOptimal,
                   vk::ImageLayout::eShaderReadOnlyOptimal);
    }
};

// ---- The masks, read back and judged.

int visibilityAt(const Scene& scene, const std::uint8_t* mask, std::size_t light, glm::dvec3 p)
{
    const glm::dvec4 clip = scene.frame.camera.clip_from_world * glm::dvec4(p, 1.0);
    const auto x = static_cast<std::size_t>((clip.x / clip.w * 0.5 + 0.5) * kSize.width);
    const auto y = static_cast<std::size_t>((clip.y / clip.w * 0.5 + 0.5) * kSize.height);
    return mask[(y * kSize.width + x) * 4 + light];
}

// Points on the ground that boxes hide from a light, and points that they do not.
bool isAsExpected(const Scene& scene, const std::uint8_t* mask)
{
    const auto behind = [&](std::size_t light, glm::dvec3 p) { // follows light through p down to the ground
        const glm::dvec3 d = light == 0 ? scene.lights[0].direction_ws : p - scene.lights[1].position_ws;
        return p - d * (p.y / d.y);
    };
    const glm::dvec3 plate(2.5, 3.0, 1.0);
    bool good = true;
    for (std::size_t light = 0; light < 2; ++light) {
        good &= visibilityAt(scene, mask, light, behind(light, plate)) == 0;
        good &= visibilityAt(scene, mask, light, behind(light, plate - glm::dvec3(1.3, 0.0, 0.5))) == 255;
        good &= visibilityAt(scene, mask, light, behind(light, {0.0, 1.0, 0.9})) == 0;
        good &= visibilityAt(scene, mask, light, {-4.5, 0.0, -2.0}) == 255;
        good &= visibilityAt(scene, mask, light, {-8.0, 0.0, -8.0}) == 255; // outside the spot's cone
    }
    return good;
}

int run(const std::string& folder)
{
    const Device d;
    Scene scene;
    const Buffer vertices(d, sizeof kCorners, vk::BufferUsageFlagBits::eVertexBuffer, kCorners.data());
    const Buffer indices(d, sizeof kIndices, vk::BufferUsageFlagBits::eIndexBuffer, kIndices.data());
    const Buffer pixels(d, vk::DeviceSize{4} * kSize.width * kSize.height, vk::BufferUsageFlagBits::eTransferDst);
    Prepass prepass(d);

    gnomon::Planner planner(gnomon::ShadowOptions{});
    gnomon::vulkan::ShadowRenderer shadows(d.view(), {}); // pcf with a 3 x 3 kernel, automatic bias
    gnomon::vulkan::CasterDrawer casters(d.view(), {shadows.mapFormats(true), shadows.mapFormats(false)});
    const gnomon::vulkan::DrawPart cube{{0, kIndices.size(), 0}, 0};
    const std::array<gnomon::vulkan::DrawObject, 4> objects{{{0, 1}, {0, 1}, {0, 1}, {0, 1}}};
    casters.setScene({&cube, 1}, objects, std::array<gnomon::vulkan::CasterBatch, 1>{});

    for (int i = 0; i < kFrames; ++i) {
        const auto slot = static_cast<std::uint32_t>(i) % kSlots;
        const vk::raii::CommandBuffer& commands = d.commands[slot];
        (void)d.device.waitForFences(*d.done[slot], VK_TRUE, UINT64_MAX);
        d.device.resetFences(*d.done[slot]);

        const gnomon::Plan& plan = planner.plan(scene.frame);
        shadows.prepare(plan, kSize);
        casters.beginFrame(slot, plan, {*vertices.buffer, 0, nullptr, 0, *indices.buffer, 0}, scene.world_from_object);
        commands.begin(vk::CommandBufferBeginInfo());
        prepass.record(commands, scene, *vertices.buffer, *indices.buffer);
        shadows.recordMaps(*commands, slot, scene.frame, plan,
                           [&](const gnomon::vulkan::MapPass& pass) { casters.draw(pass); });
        shadows.recordMask(*commands, slot, scene.frame, plan, {kSize, *prepass.view});
        // Here a renderer would shade with shadows.mask(); this one reads the last frame's back.
        const gnomon::vulkan::ImageRef mask = shadows.mask();
        transition(commands, mask.image, vk::ImageAspectFlagBits::eColor, vk::ImageLayout(mask.layout),
                   vk::ImageLayout::eTransferSrcOptimal);
        const vk::BufferImageCopy whole(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                        {kSize.width, kSize.height, 1});
        commands.copyImageToBuffer(mask.image, vk::ImageLayout::eTransferSrcOptimal, *pixels.buffer, whole);
        commands.end();
        d.queue.submit(vk::SubmitInfo({}, {}, *commands), *d.done[slot]);
    }
    d.device.waitIdle();

    const auto* mask = static_cast<const std::uint8_t*>(pixels.mapped);
    for (std::size_t light = 0; light < 2; ++light) {
        std::ofstream out(folder + (light == 0 ? "/sun.pgm" : "/spot.pgm"), std::ios::binary);
        out << "P5\n" << kSize.width << ' ' << kSize.height << "\n255\n";
        for (std::size_t i = 0; i < std::size_t{kSize.width} * kSize.height; ++i) {
            out.put(static_cast<char>(mask[i * 4 + light]));
        }
    }
    return isAsExpected(scene, mask) ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc > 1 ? argv[1] : ".");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "minimal_host: %s\n", error.what());
        return 1;
    }
}
