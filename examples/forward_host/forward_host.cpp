// SPDX-License-Identifier: Apache-2.0
// A renderer that shades forward, with its own pipelines and its own way to draw casters (door 2 of
// docs/integrating.md): Gnomon makes filterable maps of a sun and a spot light, and the host's one pass reads them
// through gnomon/visibility.glsl, without a mask or a depth prepass. A fence has holes, depth is 0 near, and the
// picture changes its size. Usage: forward_host FOLDER. Writes forward.ppm there; exits with 1 if shadows are not where
// the scene's geometry says.
#include "../small_vulkan.h"

#include <gnomon/pack/shading_buffers.h>
#include <gnomon/planner.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <forward_host_spirv.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cstdio>
#include <optional>
#include <string>

namespace {

constexpr int kFrames = 6;
constexpr vk::Format kColour = vk::Format::eR8G8B8A8Unorm;

// ---- The scene: things are boxes; the last one is a fence.

struct Thing {
    glm::vec3 centre;
    glm::vec3 half_size;
    glm::vec4 colour; // w: 1 with holes
};
constexpr std::array<Thing, 4> kThings{{{{0, -0.5F, 0}, {20, 0.5F, 20}, {0.8F, 0.8F, 0.75F, 0}},
                                        {{0, 1, 0}, {1, 1, 1}, {0.9F, 0.5F, 0.3F, 0}},
                                        {{-3, 0.75F, 2}, {0.5F, 0.75F, 0.5F}, {0.4F, 0.7F, 0.5F, 0}},
                                        {{3, 1, 2}, {2, 1, 0.03F}, {0.6F, 0.45F, 0.3F, 1}}}};

struct Scene {
    gnomon::ObjectSet objects;
    std::array<gnomon::Light, 2> lights{};
    gnomon::Frame frame;

    Scene()
    {
        for (const Thing& thing : kThings) {
            objects.add({thing.centre - thing.half_size, thing.centre + thing.half_size});
        }
        lights[0].direction_ws = glm::normalize(glm::dvec3(0.8, -1.0, 0.3));
        lights[1].key = 1;
        lights[1].type = gnomon::LightType::spot;
        lights[1].position_ws = {-5.0, 7.0, 5.0};
        lights[1].direction_ws = glm::normalize(glm::dvec3(0.0) - lights[1].position_ws);
        lights[1].outer_half_angle_rad = 0.6;
        lights[1].range_m = 30.0;
        frame.lights = lights;
        frame.objects = &objects;
    }
    void look(vk::Extent2D size)
    {
        frame.camera.eye_ws = {3.0, 9.0, 11.0};
        frame.camera.reversed_z = false; // else every light gets Outcome degenerate
        glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.8, double(size.width) / size.height, 0.1, 100.0);
        clip_from_view[1][1] = -clip_from_view[1][1]; // y down, as Vulkan has it
        frame.camera.clip_from_world =
            clip_from_view * glm::lookAtRH(frame.camera.eye_ws, glm::dvec3(0.0), glm::dvec3(0, 1, 0));
        frame.size_px = {size.width, size.height};
        ++frame.index;
    }
};

// Push constants of every shader: examples/shaders/forward.glsl.
struct Draw {
    glm::mat4 clip_from;
    glm::vec4 more;
    glm::vec4 centre;
    glm::vec4 half_size;
};

// ---- What Gnomon calls back for: the host draws its casters with its own pipelines.

class Casters {
public:
    Casters(const Device& d, const gnomon::ResolvedOptions& options, vk::PipelineLayout layout) : layout_(layout)
    {
        for (int i = 0; i < 8; ++i) { // by perspective, clamp, masked
            const gnomon::vulkan::MapPassFormats formats = gnomon::vulkan::mapFormats(options, (i & 1) == 0);
            PipelineWish wish{forward_host_spirv::forward_caster_vert, {}, layout};
            if ((i & 4) != 0) {
                wish.fragment = formats.write_frag_depth ? forward_host_spirv::forward_caster_depth_masked_frag
                                                         : forward_host_spirv::forward_caster_masked_frag;
            } else if (formats.write_frag_depth) {
                wish.fragment = forward_host_spirv::forward_caster_depth_frag;
            }
            wish.depth = vk::Format(formats.depth); // formats.colour is UNDEFINED: maps of evsm are made of depths
            wish.samples = vk::SampleCountFlagBits(formats.samples);
            wish.clamp_depth = (i & 2) != 0;
            pipelines_.push_back(makePipeline(d, wish));
        }
    }
    // Rendering has begun, viewport and scissor are set.
    void draw(const vk::raii::CommandBuffer& commands, const Cube& cube, const gnomon::vulkan::MapPass& pass) const
    {
        cube.bind(commands);
        const std::size_t of_view =
            (pass.view->projection.orthographic ? 0U : 1U) + (pass.view->projection.clamp_near ? 2U : 0U);
        for (const std::uint32_t object : pass.casters) {
            const Thing& thing = kThings[object];
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics,
                                  *pipelines_[of_view + (thing.colour.w > 0 ? 4U : 0U)]);
            const Draw push{pass.clip_from_world, pass.metric_ws, glm::vec4(thing.centre, 0),
                            glm::vec4(thing.half_size, 0)};
            commands.pushConstants<Draw>(layout_, vk::ShaderStageFlagBits::eAllGraphics, 0, push);
            commands.drawIndexed(kIndices.size(), 1, 0, 0, 0);
        }
    }

private:
    vk::PipelineLayout layout_;
    std::vector<vk::raii::Pipeline> pipelines_;
};

// ---- What the shading pass reads of Gnomon's: a set for each frame in flight, with buffers that the host fills.

class ShadowSet {
public:
    static constexpr std::uint32_t kMostViews = 16;

    ShadowSet(const Device& d, const SetPool& pool)
        : constants_(d, sizeof(gnomon::shared::GpuConstants), vk::BufferUsageFlagBits::eUniformBuffer),
          lights_(d, 2 * sizeof(gnomon::shared::GpuLight), vk::BufferUsageFlagBits::eStorageBuffer),
          views_(d, kMostViews * sizeof(gnomon::shared::GpuView), vk::BufferUsageFlagBits::eStorageBuffer),
          set_(pool.take(d))
    {
    }
    void fill(const Device& d, const gnomon::Plan& plan, const gnomon::vulkan::ShadowRenderer& shadows,
              vk::Sampler sampler)
    {
        using namespace gnomon;
        const vulkan::ImageRef maps = shadows.maps();
        const vulkan::BufferRef layers = shadows.depthLayersBuffer();
        const pack::MapImage image{{maps.extent.width, maps.extent.height}, maps.levels};
        const pack::DrawPrecision precision{.sub_pixel_bits = d.gpu.getProperties().limits.subPixelPrecisionBits,
                                            .receivers_from_depth = false}; // forward.frag interpolates its points
        pack::fillConstants(plan, 0, plan.made_for.size_px, image, precision,
                            *static_cast<shared::GpuConstants*>(constants_.mapped));
        pack::fillLights(plan, {static_cast<shared::GpuLight*>(lights_.mapped), 2});
        pack::fillViews(plan, {&image, 1}, {static_cast<shared::GpuView*>(views_.mapped), kMostViews});
        const vk::DescriptorImageInfo map(sampler, maps.view, vk::ImageLayout(maps.layout));
        const std::array<vk::DescriptorBufferInfo, 4> buffers{{{*constants_.buffer, 0, VK_WHOLE_SIZE},
                                                               {*lights_.buffer, 0, VK_WHOLE_SIZE},
                                                               {*views_.buffer, 0, VK_WHOLE_SIZE},
                                                               {layers.buffer, 0, layers.bytes}}};
        using Type = vk::DescriptorType;
        d.device.updateDescriptorSets({{*set_, 0, 0, 1, Type::eUniformBuffer, nullptr, &buffers[0]},
                                       {*set_, 1, 0, 1, Type::eCombinedImageSampler, &map},
                                       {*set_, 2, 0, 1, Type::eStorageBuffer, nullptr, &buffers[1]},
                                       {*set_, 3, 0, 1, Type::eStorageBuffer, nullptr, &buffers[2]},
                                       {*set_, 4, 0, 1, Type::eStorageBuffer, nullptr, &buffers[3]}},
                                      {});
    }
    vk::DescriptorSet set() const { return *set_; }

private:
    Buffer constants_;
    Buffer lights_;
    Buffer views_;
    vk::raii::DescriptorSet set_;
};

// ---- The picture.

struct Picture {
    vk::Extent2D size;
    Target colour;
    Target depth;

    Picture(const Device& d, vk::Extent2D extent)
        : size(extent),
          colour(d, size, kColour, vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc,
                 vk::ImageAspectFlagBits::eColor),
          depth(d, size, vk::Format::eD32Sfloat, vk::ImageUsageFlagBits::eDepthStencilAttachment,
                vk::ImageAspectFlagBits::eDepth)
    {
    }
};

void shade(const vk::raii::CommandBuffer& commands, const Picture& picture, const Scene& scene,
           vk::PipelineLayout layout)
{
    using Layout = vk::ImageLayout;
    transition(commands, *picture.colour.image, vk::ImageAspectFlagBits::eColor, Layout::eUndefined,
               Layout::eColorAttachmentOptimal);
    transition(commands, *picture.depth.image, vk::ImageAspectFlagBits::eDepth, Layout::eUndefined,
               Layout::eDepthAttachmentOptimal);
    const auto colour = vk::RenderingAttachmentInfo(*picture.colour.view, Layout::eColorAttachmentOptimal)
                            .setLoadOp(vk::AttachmentLoadOp::eClear)
                            .setStoreOp(vk::AttachmentStoreOp::eStore);
    const auto depth = vk::RenderingAttachmentInfo(*picture.depth.view, Layout::eDepthAttachmentOptimal)
                           .setLoadOp(vk::AttachmentLoadOp::eClear)
                           .setClearValue(vk::ClearDepthStencilValue(1.0F, 0));
    commands.beginRendering(vk::RenderingInfo({}, {{0, 0}, picture.size}, 1, 0, colour).setPDepthAttachment(&depth));
    setViewport(commands, picture.size);
    const gnomon::Camera& camera = scene.frame.camera;
    const glm::mat4 clip_from_eye(camera.clip_from_world * glm::translate(glm::dmat4(1.0), camera.eye_ws));
    for (const Thing& thing : kThings) {
        const glm::vec4 centre(glm::dvec3(thing.centre) - camera.eye_ws, 0.0);
        const Draw push{clip_from_eye, thing.colour, centre, glm::vec4(thing.half_size, 0)};
        commands.pushConstants<Draw>(layout, vk::ShaderStageFlagBits::eAllGraphics, 0, push);
        commands.drawIndexed(kIndices.size(), 1, 0, 0, 0);
    }
    commands.endRendering();
    transition(commands, *picture.colour.image, vk::ImageAspectFlagBits::eColor, Layout::eColorAttachmentOptimal,
               Layout::eTransferSrcOptimal);
}

// ---- The last picture, judged: points on the ground that things hide from a light, and points that they do not.

bool isAsExpected(const gnomon::Camera& camera, vk::Extent2D size, const std::uint8_t* pixels)
{
    const auto brightness = [&](double x, double z) {
        const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(x, 0.0, z, 1.0);
        const auto column = static_cast<std::size_t>((clip.x / clip.w * 0.5 + 0.5) * size.width);
        const auto row = static_cast<std::size_t>((clip.y / clip.w * 0.5 + 0.5) * size.height);
        const std::uint8_t* const pixel = pixels + 4 * (row * size.width + column);
        return pixel[0] + pixel[1] + pixel[2];
    };
    const int lit = brightness(4.5, -1.5);
    int least = lit; // across the shadow of the fence's bars
    int most = 0;
    for (double x = 2.2; x < 5.4; x += 0.05) {
        least = std::min(least, brightness(x, 2.3));
        most = std::max(most, brightness(x, 2.3));
    }
    const int behind_box = brightness(1.6, 0.6); // by the sun
    const int behind_box_of_spot = brightness(2.0, -2.0);
    return lit > 300 && behind_box < lit / 2 && behind_box_of_spot < lit * 4 / 5 && behind_box_of_spot > lit / 3 &&
           most - least > lit / 5;
}

int run(const std::string& folder)
{
    const Device d;
    Scene scene;
    scene.frame.clamps_depth = d.seen.features.depth_clamp;
    const Cube cube(d);

    gnomon::ShadowOptions wish;
    wish.technique.filter = gnomon::Filter::evsm;
    wish.map_size = 512;
    const gnomon::ResolvedOptions options = gnomon::resolvedOrThrow(wish);
    gnomon::Planner planner(wish);
    gnomon::vulkan::ShadowRenderer shadows(d.seen, {.frames_in_flight = kSlots});

    using Type = vk::DescriptorType;
    const SetPool pool(d, {Type::eUniformBuffer, Type::eCombinedImageSampler, Type::eStorageBuffer,
                           Type::eStorageBuffer, Type::eStorageBuffer}); // include/gnomon/visibility.glsl
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eAllGraphics, 0, sizeof(Draw));
    const vk::raii::PipelineLayout layout(d.device, {{}, *pool.layout, range});
    const vk::raii::Sampler sampler = makeLinearSampler(d);
    std::array<ShadowSet, kSlots> sets{ShadowSet(d, pool), ShadowSet(d, pool)};
    const Casters casters(d, options, *layout);
    const vk::raii::Pipeline forward =
        makePipeline(d, {forward_host_spirv::forward_vert, forward_host_spirv::forward_frag, *layout, kColour});

    std::optional<Picture> picture;
    for (int i = 0; i < kFrames; ++i) {
        const std::uint32_t slot = std::uint32_t(i) % kSlots;
        if (i == 0 || i == kFrames / 2) { // the window has another size
            d.device.waitIdle();
            picture.emplace(d, i == 0 ? vk::Extent2D{320, 200} : vk::Extent2D{640, 400});
        }
        scene.look(picture->size);
        const vk::raii::CommandBuffer& commands = d.begin(slot);
        const gnomon::Plan& plan = planner.plan(scene.frame);
        shadows.prepare(plan, {}); // without a mask
        sets[slot].fill(d, plan, shadows, *sampler);
        shadows.recordMaps(*commands, slot, plan,
                           [&](const gnomon::vulkan::MapPass& pass) { casters.draw(commands, cube, pass); });
        cube.bind(commands); // recording maps may have bound others
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *forward);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout, 0, sets[slot].set(), {});
        shade(commands, *picture, scene, *layout);
        d.submit(slot);
    }
    d.device.waitIdle();
    const vk::Extent2D size = picture->size;
    const std::vector<std::uint8_t> pixels = readBack(d, *picture->colour.image, size);
    writePpm(folder + "/forward.ppm", size, pixels);
    return isAsExpected(scene.frame.camera, size, pixels.data()) ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc > 1 ? argv[1] : ".");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "forward_host: %s\n", error.what());
        return 1;
    }
}
