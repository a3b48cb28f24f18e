// SPDX-License-Identifier: Apache-2.0
#include "planned_scene.h"

namespace gnomon::test {

namespace {

std::shared_ptr<const vulkan::Classics> classicsOf(vulkan::FinDrawer& fins)
{
    return vulkan::makeClassics({.fins = [&fins](const vulkan::FinPass& pass) {
        (void)fins.draw(pass);
    }});
}

} // namespace

Drawing::Drawing(Gpu& gpu, const SceneMesh& mesh, const pack::CompactMaskRule& compact_in,
                 std::uint32_t frames_in_flight)
    : Drawing(gpu.view(), mesh, compact_in, frames_in_flight)
{
}

Drawing::Drawing(const vulkan::DeviceView& view, const SceneMesh& mesh, const pack::CompactMaskRule& compact_in,
                 std::uint32_t frames_in_flight)
    : compact(compact_in),
      renderer(view, {.frames_in_flight = frames_in_flight, .compact = compact_in, .classics = classicsOf(fins)}),
      drawer(view, {.frames_in_flight = frames_in_flight}), fins(view, {.frames_in_flight = frames_in_flight})
{
    drawer.setScene(mesh.parts, mesh.objects, mesh.batches);
    fins.setScene(mesh.outlines);
}

std::vector<Light> sunsAndSpots(std::uint32_t count)
{
    std::vector<Light> lights;
    for (std::uint32_t i = 0; i < count; ++i) {
        lights.push_back(i % 2 == 0 ? makeSun({0.5 + 0.3 * i, -1.0, 0.2})
                                    : makeSpot({4.0 - i, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5));
        lights.back().key = i;
    }
    return lights;
}

namespace {

Aabb boundsOf(const Box& box)
{
    const auto reach = static_cast<float>(glm::length(box.half)); // turned by whatever angle
    return {glm::vec3(box.centre) - reach, glm::vec3(box.centre) + reach};
}

} // namespace

PlannedScene::PlannedScene(Gpu& gpu, VkExtent2D screen) : gpu_(gpu), mesh_(uploadMesh(gpu, scene_))
{
    (void)objects_.add({{-30.0F, 0.0F, -30.0F}, {30.0F, 0.0F, 30.0F}});
    for (const Box& box : scene_.boxes) {
        (void)objects_.add(boundsOf(box));
    }
    remakeViews(screen, true, false);
}

void PlannedScene::remakeViews(VkExtent2D screen, bool normals, bool ids)
{
    eye_ -= glm::dvec3(0.05, 0.0, 0.02);
    camera_ = makeCamera(eye_, {0.0, 0.5, 0.0}, double(screen.width) / screen.height);
    const Picture picture = tracePicture(scene_, camera_, screen);
    // As if a host made new images and destroyed the old ones: each new view may be where its forerunner was.
    const auto make = [&](TestImage& image, VkFormat format, std::span<const std::byte> texels) {
        TestImage fresh = gpu_.makeImage(format, screen, texels);
        if (image.view != VK_NULL_HANDLE) {
            gpu_.replaceImage(image, fresh);
        }
        image = fresh;
        return image.view;
    };
    inputs_ = {};
    inputs_.extent = screen;
    inputs_.depth = make(images_.depth, VK_FORMAT_R32_SFLOAT, std::as_bytes(std::span(picture.depth)));
    if (normals) {
        inputs_.normal = make(images_.normal, VK_FORMAT_R16G16_SNORM, std::as_bytes(std::span(picture.octahedral)));
    }
    if (ids) {
        std::vector<std::uint32_t> receivers = picture.object_plus_one;
        for (std::uint32_t& id : receivers) {
            id = id == 2 ? 0 : id; // one that wants no shadow
        }
        inputs_.object_id = make(images_.id, VK_FORMAT_R32_UINT, std::as_bytes(std::span(receivers)));
    }
}

void PlannedScene::moveCaster()
{
    scene_.boxes[0].centre += glm::dvec3(0.4, 0.0, 0.3);
    (void)objects_.update(objects_.idAt(1), boundsOf(scene_.boxes[0]));
}

Frame PlannedScene::frameOf(std::span<const Light> lights) const
{
    Frame frame;
    frame.camera = camera_;
    frame.size_px = {inputs_.extent.width, inputs_.extent.height};
    frame.lights = lights;
    frame.objects = &objects_;
    return frame;
}

void PlannedScene::run(Drawing& drawing, const Plan& plan, std::uint32_t slot, vulkan::Profiler* profiler)
{
    (void)drawing.renderer.prepare(plan, inputs_.extent);
    const auto transforms = scene_.transforms();
    gpu_.run([&](VkCommandBuffer commands) {
        if (profiler != nullptr) {
            profiler->beginFrame(commands, slot);
        }
        drawing.drawer.beginFrame(slot, plan, mesh_.geometry, transforms);
        drawing.fins.beginFrame(slot, mesh_.edges, transforms);
        drawing.renderer.recordBounds(commands, slot, plan, inputs_, profiler);
        drawing.renderer.recordMaps(commands, slot, plan, drawing.drawer.callback(), profiler);
        drawing.renderer.recordMask(commands, slot, plan, inputs_, profiler);
    });
}

std::vector<std::byte> PlannedScene::draw(Drawing& drawing, const Plan& plan, std::uint32_t slot,
                                          vulkan::Profiler* profiler)
{
    run(drawing, plan, slot, profiler);
    const vulkan::ImageRef mask = drawing.renderer.mask();
    const std::uint32_t layers = drawing.compact.channels > 0 ? mask.layers : plan.mask_layers;
    std::vector<std::byte> all;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const auto texels =
            gpu_.read(mask, layer, mask.format == VK_FORMAT_R8_UNORM ? 1 : 4, VK_IMAGE_ASPECT_COLOR_BIT);
        all.insert(all.end(), texels.begin(), texels.end());
    }
    return all;
}

} // namespace gnomon::test
