// SPDX-License-Identifier: Apache-2.0
// Random frames, some of them planned and never recorded: whatever the planner leaves as it is or draws over in part,
// the maps hold what a drawing from scratch gives, byte for byte.
#include "cpu_map.h"
#include "fixture.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <random>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{32, 24};

struct FramesCase {
    const char* name;
    Filter filter;
    MapFormat format;
    Motion motion;
    KeepStill keep_still;
    std::uint32_t samples = 1;
};

std::ostream& operator<<(std::ostream& out, const FramesCase& c)
{
    return out << c.name;
}

/// The same plan, with nothing taken for granted and nothing kept.
Plan fromScratch(Plan plan)
{
    for (View& view : plan.views) {
        view.contents.redraw = view.contents.makes != 0;
        view.place.map = {};
        view.contents.kept_map = {};
        view.contents.kept_layer = kNoIndex;
        view.contents.redraw_kept = false;
    }
    return plan;
}

class RandomFrames : public testing::TestWithParam<FramesCase> {
protected:
    RandomFrames() : kept_(kScreen, filterOf()), whole_(kScreen, filterOf()), random_(11)
    {
        const std::vector<Light> first{makeSun({0.8, -0.9, -0.35})};
        for (Bench* const bench : {&kept_, &whole_}) {
            bench->setLights(first, {{0, 0, 0, 64, 64}}, {64, 64, 1});
            bench->drawer.setScene(bench->mesh.parts, bench->mesh.objects, bench->mesh.batches);
        }
        (void)objects_.add({{-30.0F, 0.0F, -30.0F}, {30.0F, 0.0F, 30.0F}});
        for (std::size_t i = 0; i < kept_.scene.boxes.size(); ++i) {
            (void)objects_.add(boundsOf(kept_.scene.boxes[i]), {.dynamic = i >= 3});
        }
    }
    static ShadowOptions filterOf()
    {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.filter = GetParam().filter;
        options.format = GetParam().format;
        options.moments.samples = GetParam().samples;
        return options;
    }
    static Aabb boundsOf(const Box& box)
    {
        const auto reach = static_cast<float>(glm::length(box.half)); // turned by whatever angle
        return {glm::vec3(box.centre) - reach, glm::vec3(box.centre) + reach};
    }
    bool happens(double chance) { return std::bernoulli_distribution(chance)(random_); }
    double around(double by) { return std::uniform_real_distribution<double>(-by, by)(random_); }

    void change()
    {
        if (happens(0.3)) {
            eye_ += glm::dvec3(around(2.0), around(0.5), around(2.0));
        }
        if (GetParam().motion == Motion::step_blend) { // by less than a step, so that there are two positions
            sun_ = glm::normalize(sun_ + glm::dvec3(0.002, 0.0, 0.0));
        } else if (happens(0.1)) {
            sun_ = glm::normalize(sun_ + glm::dvec3(around(0.2), 0.0, around(0.2)));
        }
        for (std::size_t i = 0; i < kept_.scene.boxes.size(); ++i) {
            if (!happens(i < 3 ? 0.03 : 0.4)) {
                continue;
            }
            Box& box = kept_.scene.boxes[i];
            box.centre += glm::dvec3(around(1.0), 0.0, around(1.0));
            box.angle += around(0.5);
            const ObjectId object = objects_.idAt(static_cast<std::uint32_t>(i + 1));
            objects_.update(object, boundsOf(box));
            objects_.touch(object);
        }
        lights_ = {makeSun(sun_)};
        for (std::uint32_t i = 0; i < 4; ++i) {
            lit_[i] = happens(0.1) ? !lit_[i] : lit_[i];
            if (lit_[i]) {
                lights_.push_back(makeSpot({-6.0 + 3.0 * i, 9.0 - i, 5.0}, {0.0, 0.0, 0.0}, 0.6));
                lights_.back().key = 1 + i;
            }
        }
    }
    void record(Bench& bench, const Plan& plan)
    {
        (void)bench.renderer.prepare(plan, kScreen);
        const auto transforms = kept_.scene.transforms();
        gpu().run([&](VkCommandBuffer commands) {
            bench.drawer.beginFrame(0, plan, bench.mesh.geometry, transforms);
            bench.renderer.recordMaps(commands, 0, plan, [&](const vulkan::MapPass& pass) { bench.drawer.draw(pass); });
        });
    }
    /// Bytes of the views' maps that are not the same.
    std::size_t differences(const Plan& plan)
    {
        const vulkan::ImageRef a = kept_.renderer.maps();
        const vulkan::ImageRef b = whole_.renderer.maps();
        const bool depth = a.format == VK_FORMAT_D16_UNORM || a.format == VK_FORMAT_D32_SFLOAT;
        const VkImageAspectFlags aspect = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
        const std::size_t bytes = texelBytes(a.format);
        std::size_t count = 0;
        for (const View& view : plan.views) {
            if (view.contents.makes == 0) {
                continue;
            }
            const Tile& tile = view.place.tile;
            const auto x = gpu().read(a, tile.layer, texelBytes(a.format), aspect);
            const auto y = gpu().read(b, tile.layer, texelBytes(b.format), aspect);
            // Two maps may share a texel, whose other half may be nobody's.
            const std::size_t half = view.place.part == TexelPart::second ? 1 : 0;
            for (std::size_t row = tile.y; row < tile.y + tile.height; ++row) {
                for (std::size_t i = tile.x * bytes; i < (tile.x + tile.width) * bytes; ++i) {
                    const bool is_own = view.place.part == TexelPart::whole || i % bytes / (bytes / 2) == half;
                    const bool same = x[row * a.extent.width * bytes + i] == y[row * b.extent.width * bytes + i];
                    count += is_own && !same ? 1 : 0;
                }
            }
        }
        return count;
    }

    Bench kept_;
    Bench whole_;
    ObjectSet objects_;
    std::vector<Light> lights_;
    glm::dvec3 eye_{9.0, 6.0, 11.0};
    glm::dvec3 sun_{0.8, -0.9, -0.35};
    bool lit_[4] = {true, false, false, false};
    std::mt19937 random_;
};

TEST_P(RandomFrames, holdWhatADrawingFromScratchGives)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = GetParam().filter;
    options.technique.motion = GetParam().motion;
    options.format = GetParam().format;
    options.moments.samples = GetParam().samples;
    options.map_size = 64;
    options.keep_still = GetParam().keep_still;
    Planner planner(options);
    std::size_t held = 0;
    std::size_t restored = 0;
    std::size_t skipped = 0;
    std::size_t paired = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        change();
        Frame frame;
        frame.index = i;
        frame.time_s = 0.1 * static_cast<double>(i);
        frame.camera = makeCamera(eye_, {0.0, 0.5, 0.0}, 4.0 / 3.0);
        frame.size_px = {kScreen.width, kScreen.height};
        frame.lights = lights_;
        frame.objects = &objects_;
        const Plan& plan = planner.plan(frame);
        if (happens(0.15)) {
            ++skipped; // planned, and never recorded
            continue;
        }
        record(kept_, plan);
        record(whole_, fromScratch(plan));
        held += kept_.renderer.reuse(0).held;
        restored += kept_.renderer.reuse(0).restored;
        paired += plan.lights[0].steps.paired ? 1 : 0;
        ASSERT_EQ(differences(plan), 0U) << "frame " << i;
    }
    EXPECT_GT(held + restored, 20U) << "else nothing was at stake";
    EXPECT_GT(skipped, 2U);
    EXPECT_EQ(paired > 20, GetParam().motion == Motion::step_blend);
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(
    Techniques, RandomFrames,
    testing::Values(
        FramesCase{"pcf_snap", Filter::pcf, MapFormat::d32f, Motion::snap, KeepStill::never},
        FramesCase{"pcf_snap_kept", Filter::pcf, MapFormat::d32f, Motion::snap, KeepStill::always},
        FramesCase{"hard_r32f_kept", Filter::hard, MapFormat::r32f, Motion::snap, KeepStill::always},
        FramesCase{"vsm_kept", Filter::vsm, MapFormat::rg32f, Motion::snap, KeepStill::always},
        FramesCase{"esm", Filter::esm, MapFormat::r32f, Motion::snap, KeepStill::never},
        FramesCase{"hard_d16_kept", Filter::hard, MapFormat::d16, Motion::snap, KeepStill::always},
        FramesCase{"pcf_steps", Filter::pcf, MapFormat::d32f, Motion::step_blend, KeepStill::automatic},
        FramesCase{"pcf_rg16_shared", Filter::pcf, MapFormat::rg16, Motion::step_blend, KeepStill::automatic},
        FramesCase{"hard_rg16f_shared", Filter::hard, MapFormat::rg16f, Motion::step_blend, KeepStill::automatic},
        FramesCase{"hard_rgba8_shared", Filter::hard, MapFormat::rgba8, Motion::step_blend, KeepStill::automatic},
        FramesCase{"vsm_4_kept", Filter::vsm, MapFormat::rg16, Motion::snap, KeepStill::always, 4},
        FramesCase{"lvsm_4_kept", Filter::lvsm, MapFormat::rgba16, Motion::snap, KeepStill::always, 4}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

} // namespace
} // namespace gnomon::test
