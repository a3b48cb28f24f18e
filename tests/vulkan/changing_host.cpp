// SPDX-License-Identifier: Apache-2.0
#include "changing_host.h"

#include "allocation_count.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

Aabb boundsOf(const Box& box)
{
    const auto reach = static_cast<float>(glm::length(box.half)); // turned by whatever angle
    return {glm::vec3(box.centre) - reach, glm::vec3(box.centre) + reach};
}

vulkan::ShadowRendererOptions withClassics(vulkan::ShadowRendererOptions options, vulkan::FinDrawer& fins)
{
    vulkan::ClassicCallbacks callbacks;
    callbacks.fins = [&fins](const vulkan::FinPass& pass) {
        (void)fins.draw(pass);
    };
    callbacks.volumes = [](const vulkan::VolumePass&) {
    };
    options.classics = vulkan::makeClassics(callbacks);
    return options;
}

vulkan::CasterDrawerOptions withPieces()
{
    vulkan::CasterDrawerOptions options;
    options.vertices.piece = kPieceOfVertex;
    return options;
}

} // namespace

std::ostream& operator<<(std::ostream& out, const Made& made)
{
    return out << made.pipelines << " pipelines, " << made.memory << " times memory of the device, " << made.heap
               << " times heap";
}

ChangingHost::ChangingHost(const vulkan::ShadowRendererOptions& options)
    : own_(std::make_unique<NullDriver>()), driver(*own_), renderer(driver.view(), withClassics(options, fins)),
      drawer(driver.view(), withPieces()), fins(driver.view(), {})
{
    begin();
}

ChangingHost::ChangingHost(NullDriver& shared, const vulkan::ShadowRendererOptions& options)
    : driver(shared), renderer(driver.view(), withClassics(options, fins)), drawer(driver.view(), withPieces()),
      fins(driver.view(), {})
{
    begin();
}

void ChangingHost::begin()
{
    addObjects();
    makeScene();
    draw_ = [this](const vulkan::MapPass& pass) {
        (void)drawer.draw(pass);
    };
    for (Views& views : views_) {
        views = {driver.makeView(), driver.makeView(), driver.makeView()};
    }
}

void ChangingHost::addObjects()
{
    (void)objects_.add({{-30.0F, 0.0F, -30.0F}, {30.0F, 0.0F, 30.0F}}, {.pieces = 1});
    for (std::size_t i = 0; i < scene_.boxes.size(); ++i) {
        (void)objects_.add(boundsOf(scene_.boxes[i]), {.dynamic = i >= 3, .closed = true, .pieces = 6});
    }
}

// Opaque parts and masked ones.
void ChangingHost::makeScene()
{
    const auto texture = reinterpret_cast<VkDescriptorSet>(driver.makeBuffer()); // the null driver does not mind
    std::vector<vulkan::CasterBatch> batches(4);
    batches[1].texture = texture;
    batches[3].texture = texture;
    const vulkan::MeshRange cube{6, 36, 4};
    const std::vector<vulkan::DrawPart> parts{{{0, 6, 0}, 0}, {cube, 1}, {cube, 2}, {cube, 3}};
    std::vector<vulkan::DrawObject> objects{{0, 1}};
    objects.resize(1 + scene_.boxes.size(), {1, 3});
    drawer.setScene(parts, objects, batches);
    geometry_.positions = driver.makeBuffer();
    geometry_.uvs = driver.makeBuffer();
    geometry_.indices = driver.makeBuffer();
    geometry_.pieces = driver.makeBuffer();
    transforms_ = scene_.transforms();
    std::vector<vulkan::VolumeMesh> edges{{0, 5, 0}};
    edges.resize(objects.size(), {5, 18, 4});
    fins.setScene(edges);
    fin_geometry_ = {{geometry_.positions, 64}, {driver.makeBuffer(), 64}, {driver.makeBuffer(), 64}};
}

// One of the boxes, and the suns.
void ChangingHost::move(const FrameSetup& setup)
{
    lights_.clear();
    lights_.reserve(setup.lights); // where memory runs out, nothing has moved yet
    Box moved = scene_.boxes.back();
    moved.centre.x += frames_ % 2 == 0 ? 0.3 : -0.3;
    objects_.update(objects_.idAt(static_cast<std::uint32_t>(scene_.boxes.size())), boundsOf(moved));
    scene_.boxes.back() = moved;
    for (std::uint32_t i = 0; i < setup.lights; ++i) {
        const double angle = 0.7 * i + 0.002 * frames_;
        const bool spot = i == 0 ? first_light == LightType::spot : i % 3 == 2;
        lights_.push_back(spot ? makeSpot({4.0 - i, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5)
                               : makeSun({std::cos(angle), -1.0, std::sin(angle)}));
        lights_.back().key = i;
        lights_.back().options = i % setup.options;
        lights_.back().casts_shadow = i < setup.cast;
    }
}

void ChangingHost::skipFrame(const FrameSetup& setup, Planner& planner, At until)
{
    const Frame frame = nextFrame(setup);
    if (until > At::nothing) {
        const Plan& plan = planner.plan(frame);
        if (until > At::plan) {
            (void)renderer.prepare(plan, setup.screen);
        }
    }
}

Frame ChangingHost::nextFrame(const FrameSetup& setup)
{
    move(setup);
    Frame frame;
    frame.index = ++frames_;
    frame.time_s = 0.7 * frames_;
    frame.camera = makeCamera(eye_ws - glm::dvec3(0.0, 0.0, 0.01 * (frames_ % 100)), {0.0, 0.5, 0.0}, 1.6);
    frame.size_px = {setup.screen.width, setup.screen.height};
    frame.lights = lights_;
    frame.objects = &objects_;
    frame.clamps_depth = driver.view().features.depth_clamp;
    return frame;
}

Made ChangingHost::frame(Planner& planner, const FrameSetup& setup)
{
    const Frame frame = nextFrame(setup);
    at = At::plan;
    const Plan& plan = planner.plan(frame);
    chosen = plan.lights.empty() ? Partition::automatic : plan.lights[0].choice.partition;
    const std::uint64_t pipelines = driver.counts().pipelines;
    at = At::prepare;
    (void)renderer.prepare(plan, setup.screen);
    const std::uint32_t slot = frames_ % 2;
    driver.beginSlot(slot); // as if the host waited for its fence here, as late as it may
    at = At::drawer;
    drawer.beginFrame(slot, plan, geometry_, transforms_);
    fins.beginFrame(slot, fin_geometry_, transforms_);
    prepared_now = driver.counts().pipelines - pipelines;
    at = At::record;
    const Made made = record(slot, plan, inputsOf(slot, setup));
    at = At::nothing;
    return made;
}

// Inputs with the slot's own views, which are destroyed and made again under the same handles: the last frame that used
// them has finished.
vulkan::MaskInputs ChangingHost::inputsOf(std::uint32_t slot, const FrameSetup& setup)
{
    const Views& views = views_[slot];
    for (const VkImageView view : {views.depth, views.normal, views.id}) {
        driver.remakeView(view);
    }
    vulkan::MaskInputs inputs;
    inputs.extent = setup.screen;
    inputs.depth = views.depth;
    inputs.normal = setup.inputs.normals ? views.normal : VK_NULL_HANDLE;
    inputs.object_id = setup.inputs.ids ? views.id : VK_NULL_HANDLE;
    inputs.object_pieces = true;
    return inputs;
}

Made ChangingHost::record(std::uint32_t slot, const Plan& plan, const vulkan::MaskInputs& inputs)
{
    views_seen += plan.views.size();
    const NullCounts before = driver.counts();
    const std::uint64_t heap = heapAllocations();
    renderer.recordBounds(driver.commands(), slot, plan, inputs);
    renderer.recordMaps(driver.commands(), slot, plan, draw_);
    renderer.recordMask(driver.commands(), slot, plan, inputs);
    return {driver.counts().pipelines - before.pipelines, driver.counts().allocations - before.allocations,
            heapAllocations() - heap};
}

void ChangingHost::expectNoMistakes(const std::string& what) const
{
    EXPECT_EQ(driver.counts().freed_in_use, 0U) << what;
    EXPECT_EQ(driver.counts().written_in_use, 0U) << what;
    EXPECT_EQ(driver.counts().used_after_free, 0U) << what;
}

} // namespace gnomon::test
