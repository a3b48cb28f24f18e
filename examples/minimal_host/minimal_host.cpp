// SPDX-License-Identifier: Apache-2.0
// The least that a renderer needs to get soft-shadow masks from Gnomon: it owns its device, its frame loop and its
// depth prepass, and hands Gnomon a frame and a way to draw. Usage: minimal_host FOLDER. Writes the masks of a sun and
// a spot light there as PGM; exits with 1 if they are not as the scene's geometry says.
#include "../small_vulkan.h"

#include <gnomon/planner.h>
#include <gnomon/vulkan/caster_drawer.h>

#include <minimal_host_spirv.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

namespace {

constexpr vk::Extent2D kSize{640, 400};
constexpr int kFrames = 6;

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

// ---- The host's own depth prepass, one draw an object.

struct Prepass {
    Target depth;
    vk::raii::PipelineLayout layout;
    vk::raii::Pipeline pipeline;

    explicit Prepass(const Device& d)
        : depth(d, kSize, vk::Format::eD32Sfloat,
                vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled,
                vk::ImageAspectFlagBits::eDepth),
          layout(nullptr), pipeline(nullptr)
    {
        const vk::PushConstantRange range(vk::ShaderStageFlagBits::eVertex, 0, sizeof(glm::mat4));
        layout = {d.device, vk::PipelineLayoutCreateInfo().setPushConstantRanges(range)};
        PipelineWish wish{minimal_host_spirv::minimal_host_vert, {}, *layout};
        wish.compare = vk::CompareOp::eGreater;
        pipeline = makePipeline(d, wish);
    }

    void record(const vk::raii::CommandBuffer& commands, const Scene& scene, vk::Buffer vertices, vk::Buffer indices)
    {
        transition(commands, *depth.image, vk::ImageAspectFlagBits::eDepth, vk::ImageLayout::eUndefined,
                   vk::ImageLayout::eDepthAttachmentOptimal);
        const auto attachment = vk::RenderingAttachmentInfo(*depth.view, vk::ImageLayout::eDepthAttachmentOptimal)
                                    .setLoadOp(vk::AttachmentLoadOp::eClear); // to 0: far, as depth is reversed
        commands.beginRendering(
            vk::RenderingInfo({}, {{0, 0}, kSize}).setLayerCount(1).setPDepthAttachment(&attachment));
        setViewport(commands, kSize);
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
        transition(commands, *depth.image, vk::ImageAspectFlagBits::eDepth, vk::ImageLayout::eDepthAttachmentOptimal,
                   vk::ImageLayout::eShaderReadOnlyOptimal);
    }
};

// ---- The masks, read back and judged.

int visibilityAt(const Scene& scene, const std::uint8_t* mask, std::size_t light, glm::dvec3 p)
{
    const glm::dvec4 clip = scene.frame.camera.clip_from_world * glm::dvec4(p, 1.0);
    const auto x = static_cast<std::size_t>((clip.x / clip.w * 0.5 + 0.5) * kSize.width);
    const auto y = static_cast<std::size_t>((clip.y / clip.w * 0.5 + 0.5) * kSize.height);
    return mask[(y * kSize.width + x) * 4 + light]; // two lights: LightPlan::mask_layer 0, mask_channel as they come
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

// A light without a map is no error: it reaches everything, and its plan says why.
void reportUnshadowed(const gnomon::Plan& plan)
{
    for (std::size_t light = 0; light < plan.lights.size(); ++light) {
        const gnomon::Outcome& outcome = plan.lights[light].outcome;
        if (!outcome.hasMap()) {
            std::printf("light %zu casts no shadow: %s\n", light, std::string(outcome.reason).c_str());
        }
    }
}

int run(const std::string& folder)
{
    const Device d;
    Scene scene;
    scene.frame.clamps_depth = d.seen.features.depth_clamp;
    const Buffer vertices(d, sizeof kCorners, vk::BufferUsageFlagBits::eVertexBuffer, kCorners.data());
    const Buffer indices(d, sizeof kIndices, vk::BufferUsageFlagBits::eIndexBuffer, kIndices.data());
    const Buffer pixels(d, vk::DeviceSize{4} * kSize.width * kSize.height, vk::BufferUsageFlagBits::eTransferDst);
    Prepass prepass(d);

    gnomon::Planner planner; // partition, fit, filter and bias are automatic
    gnomon::vulkan::ShadowRenderer shadows(d.seen);
    gnomon::vulkan::CasterDrawer casters(d.seen);
    const gnomon::vulkan::DrawPart cube{{0, kIndices.size(), 0}, 0};
    const std::array<gnomon::vulkan::DrawObject, 4> objects{{{0, 1}, {0, 1}, {0, 1}, {0, 1}}};
    casters.setScene({&cube, 1}, objects);

    for (int i = 0; i < kFrames; ++i) {
        const auto slot = static_cast<std::uint32_t>(i) % kSlots;
        const vk::raii::CommandBuffer& commands = d.begin(slot);
        const gnomon::Plan& plan = planner.plan(scene.frame);
        reportUnshadowed(plan);
        shadows.prepare(plan, kSize);
        casters.beginFrame(slot, plan, {*vertices.buffer, 0, nullptr, 0, *indices.buffer, 0}, scene.world_from_object);
        prepass.record(commands, scene, *vertices.buffer, *indices.buffer);
        const gnomon::vulkan::MaskInputs inputs{kSize, *prepass.depth.view};
        shadows.recordBounds(*commands, slot, plan, inputs);
        shadows.recordMaps(*commands, slot, plan, casters.callback());
        shadows.recordMask(*commands, slot, plan, inputs);
        // Here a renderer would shade with shadows.mask(); this one reads the last frame's back.
        const auto mask = shadows.mask();
        transition(commands, mask.image, vk::ImageAspectFlagBits::eColor, vk::ImageLayout(mask.layout),
                   vk::ImageLayout::eTransferSrcOptimal);
        const vk::BufferImageCopy whole(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                        {kSize.width, kSize.height, 1});
        commands.copyImageToBuffer(mask.image, vk::ImageLayout::eTransferSrcOptimal, *pixels.buffer, whole);
        d.submit(slot);
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
