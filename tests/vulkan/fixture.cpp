// SPDX-License-Identifier: Apache-2.0
#include "fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <utility>

namespace gnomon::test {

void expectSilence(Gpu& gpu)
{
    for (const std::string& message : gpu.takeMessages()) {
        ADD_FAILURE() << message;
    }
}

std::vector<float> readMapLayer(Gpu& gpu, const vulkan::ImageRef& maps, std::uint32_t layer)
{
    std::vector<float> texels;
    if (maps.format == VK_FORMAT_D16_UNORM) {
        const auto bytes = gpu.read(maps, layer, 2, VK_IMAGE_ASPECT_DEPTH_BIT);
        for (std::size_t i = 0; i < bytes.size(); i += 2) {
            std::uint16_t v = 0;
            std::memcpy(&v, &bytes[i], 2);
            texels.push_back(static_cast<float>(v) / 65535.0F);
        }
    } else {
        const bool colour = maps.format == VK_FORMAT_R32_SFLOAT;
        const auto bytes = gpu.read(maps, layer, 4, colour ? VK_IMAGE_ASPECT_COLOR_BIT : VK_IMAGE_ASPECT_DEPTH_BIT);
        texels.resize(bytes.size() / 4);
        std::memcpy(texels.data(), bytes.data(), bytes.size());
    }
    return texels;
}

std::vector<std::byte> readMaskChannel(Gpu& gpu, const vulkan::ImageRef& mask, const LightPlan& light)
{
    const std::uint32_t channels = mask.format == VK_FORMAT_R8_UNORM ? 1 : 4;
    const auto bytes = gpu.read(mask, light.mask_layer, channels, VK_IMAGE_ASPECT_COLOR_BIT);
    std::vector<std::byte> out;
    for (std::size_t i = light.mask_channel; i < bytes.size(); i += channels) {
        out.push_back(bytes[i]);
    }
    return out;
}

vulkan::MaskInputs uploadPicture(Gpu& gpu, const Picture& picture)
{
    vulkan::MaskInputs inputs;
    inputs.extent = picture.extent;
    inputs.depth = gpu.makeImage(VK_FORMAT_R32_SFLOAT, picture.extent, std::as_bytes(std::span(picture.depth))).view;
    inputs.normal =
        gpu.makeImage(VK_FORMAT_R16G16_SNORM, picture.extent, std::as_bytes(std::span(picture.octahedral))).view;
    return inputs;
}

namespace {

vulkan::CasterDrawerOptions drawerOptions(bool cull, bool clockwise)
{
    vulkan::CasterDrawerOptions options;
    options.frames_in_flight = 1;
    options.cull_back_faces = cull;
    options.clockwise_front = clockwise;
    return options;
}

vulkan::DeviceView viewWith(const vulkan::MemoryHooks& memory)
{
    vulkan::DeviceView view = gpu().view();
    view.memory = memory;
    return view;
}

} // namespace

Bench::Bench(VkExtent2D screen, MapFormat format, bool reversed_z, bool cull)
    : Bench(screen, ShadowOptions{.technique = kPlainTechnique, .format = format}, reversed_z, cull)
{
}

Bench::Bench(VkExtent2D screen, const ShadowOptions& options_in, bool reversed_z, bool cull,
             const vulkan::MemoryHooks& memory, bool clockwise)
    : options(options_in), renderer(viewWith(memory), {.frames_in_flight = 1, .classics = vulkan::makeClassics()}),
      drawer(gpu().view(), drawerOptions(cull, clockwise)), screen_(screen)
{
    camera = makeCamera({9.0, 6.0, 11.0}, {0.0, 0.5, 0.0}, double(screen.width) / screen.height, reversed_z);
}

void Bench::setLights(std::vector<Light> new_lights, const std::vector<Tile>& tiles, MapPages atlas)
{
    lights = std::move(new_lights);
    plan = makePlan(scene, lights, tiles, atlas, options);
    plan.made_for.camera = camera;
    picture = tracePicture(scene, camera, screen_);
    inputs = uploadPicture(gpu(), picture);
    mesh = uploadMesh(gpu(), scene);
}

void Bench::maskBoxes()
{
    constexpr std::array<std::uint32_t, 2> kTexels{0x00FFFFFFU, 0xFFFFFFFFU};
    const TestImage image = gpu().makeImage(VK_FORMAT_R8G8B8A8_UNORM, {2, 1}, std::as_bytes(std::span(kTexels)));
    mesh.batches.push_back({});
    mesh.batches[1].texture = gpu().makeTextureSet(drawer.textureSetLayout(), image.view);
    // The mesh's own coordinates run the wrong way and over a third of the texture; the transform puts them right.
    mesh.batches[1].uv_scale = {-3.0F, 1.0F};
    mesh.batches[1].uv_offset = {1.0F, 0.0F};
    mesh.parts[1].batch = 1;
    const TestBuffer uvs = gpu().makeBuffer(mesh.vertex_count * sizeof(glm::vec2), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    auto* out = static_cast<glm::vec2*>(uvs.mapped);
    for (std::uint32_t i = 0; i < mesh.vertex_count; ++i) {
        out[i] = {i >= 4 && (i & 1) != 0 ? 1.0F / 3.0F : 0.0F, 0.5F}; // by the cube's x
    }
    mesh.geometry.uvs = uvs.buffer;
}

void Bench::flipGround()
{
    auto* indices = static_cast<std::uint32_t*>(mesh.mapped_indices);
    std::swap(indices[1], indices[2]);
    std::swap(indices[4], indices[5]);
}

void Bench::prepare()
{
    drawer.setScene(mesh.parts, mesh.objects, mesh.batches);
    (void)renderer.prepare(plan, screen_);
}

void Bench::look(const glm::dvec3& eye, const glm::dvec3& target)
{
    camera = makeCamera(eye, target, double(screen_.width) / screen_.height, camera.reversed_z);
    picture = tracePicture(scene, camera, screen_);
    inputs = uploadPicture(gpu(), picture);
}

void Bench::record(int frames, vulkan::Profiler* profiler)
{
    const auto transforms = scene.transforms();
    plan.made_for.camera = camera;
    plan.made_for.lights = lights;
    for (int i = 0; i < frames; ++i) {
        gpu().run([&](VkCommandBuffer commands) {
            drawer.beginFrame(0, plan, mesh.geometry, transforms);
            if (profiler != nullptr) {
                profiler->beginFrame(commands, 0);
            }
            const auto draw = [&](const vulkan::MapPass& pass) {
                const std::uint32_t draws = drawer.draw(pass);
                if (profiler != nullptr) {
                    profiler->addDraws(draws);
                }
            };
            renderer.recordMaps(commands, 0, plan, draw, profiler);
            renderer.recordMask(commands, 0, plan, inputs, profiler);
        });
    }
}

std::vector<float> Bench::readMap(std::uint32_t layer)
{
    return readMapLayer(gpu(), renderer.maps(), layer);
}

std::vector<std::byte> Bench::readMask(std::uint32_t light)
{
    return readMaskChannel(gpu(), renderer.mask(), plan.lights[light]);
}

} // namespace gnomon::test
