// SPDX-License-Identifier: Apache-2.0
// Maps that are restored from what stands still, and drawn over where something moves, hold what maps hold that are
// drawn all at once: bit for bit.
#include "cpu_map.h"
#include "fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{64, 40};
constexpr std::uint32_t kMapSize = 128;
constexpr std::uint32_t kStillBoxes = 3; // the others move

struct Case {
    const char* name;
    Filter filter;
    MapFormat format;
    std::uint32_t samples = 1;
    bool paired = false; // two maps a texel
    bool shares = false; // and of what is kept, too
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

ShadowOptions optionsOf(const Case& c)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = c.filter;
    options.format = c.format;
    options.moments.samples = c.samples;
    return options;
}

// Texels that the box may touch, and one more on each side.
TexelRect rectOf(const View& view, const Box& box)
{
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
        const double reach = glm::length(box.half); // turned by whatever angle
        const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(box.centre + corner * reach, 1.0);
        const glm::dvec2 at =
            (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(view.place.tile.width, view.place.tile.height);
        low = glm::min(low, at - 1.0);
        high = glm::max(high, at + 1.0);
    }
    low = glm::clamp(glm::floor(low), glm::dvec2(0.0), glm::dvec2(view.place.tile.width, view.place.tile.height));
    high = glm::clamp(glm::ceil(high), low, glm::dvec2(view.place.tile.width, view.place.tile.height));
    return {static_cast<std::uint32_t>(low.x), static_cast<std::uint32_t>(low.y),
            static_cast<std::uint32_t>(high.x - low.x), static_cast<std::uint32_t>(high.y - low.y)};
}

TexelRect unionOf(const TexelRect& a, const TexelRect& b)
{
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    const std::uint32_t x = std::min(a.x, b.x);
    const std::uint32_t y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

// A sun's two positions, and a spot. The maps of the sun may share their texels.
Plan makeKeptPlan(const Scene& scene, std::span<const Light> lights, bool paired, bool shares)
{
    const std::uint32_t spot_layer = paired ? 1 : 2;
    const std::vector<Tile> tiles{{0, 0, 0, kMapSize, kMapSize}, {spot_layer, 0, 0, kMapSize, kMapSize}};
    Plan plan = makePlan(scene, lights, tiles, {kMapSize, kMapSize, spot_layer + 1});
    View later = makeView(scene, makeSun({0.5, -0.9, -0.6}), 0, {paired ? 0U : 1U, 0, 0, kMapSize, kMapSize});
    later.casters.count = plan.views[0].casters.count;
    later.serves.sun = SunPosition::later;
    plan.views[0].serves.sun = SunPosition::earlier;
    plan.views.insert(plan.views.begin() + 1, later);
    if (paired) {
        plan.views[0].place.part = TexelPart::first;
        plan.views[1].place.part = TexelPart::second;
    }
    plan.lights[0].view_count = 2;
    plan.lights[0].steps.stepping = true;
    plan.lights[0].steps.paired = true;
    plan.lights[0].steps.share = 0.5;
    plan.lights[1].first_view = 2;
    plan.pages[0].kept_layers = 3;
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        plan.views[i].casters.still = 1 + kStillBoxes;
        plan.views[i].contents.kept_layer = shares ? 1 - i / 2 : 2 - i; // any order
        plan.views[i].contents.redraw_kept = true;
    }
    return plan;
}

Plan atOnce(Plan plan)
{
    for (View& view : plan.views) {
        view.contents.kept_layer = kNoIndex;
        view.contents.redraw_kept = false;
    }
    plan.pages[0].kept_layers = 0;
    return plan;
}

class Pair {
public:
    explicit Pair(const Case& c) : kept(kScreen, optionsOf(c)), whole(kScreen, optionsOf(c)), random_(7)
    {
        const std::vector<Light> lights{makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)};
        for (Bench* bench : {&kept, &whole}) {
            bench->setLights(lights, {{0, 0, 0, kMapSize, kMapSize}, {1, 0, 0, kMapSize, kMapSize}},
                             {kMapSize, kMapSize, 2});
        }
        kept.plan = makeKeptPlan(kept.scene, lights, c.paired, c.shares);
        kept.plan.options = planOptions(kept.options);
        whole.plan = atOnce(kept.plan);
        dirty_.resize(kept.plan.views.size());
        kept.prepare();
        whole.prepare();
    }

    /// Moves the moving boxes, and tells the plan. Views that are not redrawn are remembered as dirty.
    void move()
    {
        std::uniform_real_distribution<double> by(-1.5, 1.5);
        for (std::size_t i = 0; i < kept.plan.views.size(); ++i) {
            addDirty(i);
        }
        for (std::size_t i = kStillBoxes; i < kept.scene.boxes.size(); ++i) {
            Box& box = kept.scene.boxes[i];
            box.centre += glm::dvec3(by(random_), 0.3 * by(random_), by(random_));
            box.angle += by(random_);
        }
        whole.scene = kept.scene;
        for (std::size_t i = 0; i < kept.plan.views.size(); ++i) {
            addDirty(i);
            View& view = kept.plan.views[i];
            view.contents.redraw_kept = false;
            view.contents.dirty = dirty_[i];
        }
    }
    void record()
    {
        // The masks are left out: they would say no more than the maps, and their pipelines are dear to make.
        kept_names_.name(kept.plan);
        whole_names_.name(whole.plan);
        kept.prepare();
        whole.prepare();
        for (Bench* bench : {&kept, &whole}) {
            const auto transforms = bench->scene.transforms();
            gpu().run([&](VkCommandBuffer commands) {
                bench->drawer.beginFrame(0, bench->plan, bench->mesh.geometry, transforms);
                const auto draw = [&](const vulkan::MapPass& pass) {
                    bench->drawer.draw(pass);
                };
                bench->renderer.recordMaps(commands, 0, bench->plan, draw);
            });
        }
        for (std::size_t i = 0; i < kept.plan.views.size(); ++i) {
            if (kept.plan.views[i].contents.redraw) {
                dirty_[i] = {};
            }
        }
    }
    /// Grows the images of both.
    void grow()
    {
        for (Bench* bench : {&kept, &whole}) {
            bench->plan.pages[0].width += kMapSize;
            ++bench->plan.pages[0].layers;
            bench->prepare();
        }
        ++kept.plan.pages[0].kept_layers;
        kept.prepare();
    }
    /// Bytes of the tiles that are not the same.
    std::size_t differences()
    {
        const vulkan::ImageRef a = kept.renderer.maps();
        const vulkan::ImageRef b = whole.renderer.maps();
        EXPECT_EQ(a.layers, b.layers);
        EXPECT_EQ(a.extent.width, b.extent.width);
        const bool depth = a.format == VK_FORMAT_D16_UNORM || a.format == VK_FORMAT_D32_SFLOAT;
        const VkImageAspectFlags aspect = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
        std::size_t count = 0;
        for (const View& view : kept.plan.views) { // layers that have no map hold anything
            const std::uint32_t layer = view.place.tile.layer;
            const auto x = gpu().read(a, layer, texelBytes(a.format), aspect);
            const auto y = gpu().read(b, layer, texelBytes(b.format), aspect);
            const std::size_t row = std::size_t{a.extent.width} * texelBytes(a.format);
            const std::size_t tile_row = std::size_t{kMapSize} * texelBytes(a.format);
            for (std::size_t i = 0; i < row * kMapSize; ++i) {
                count += i % row < tile_row && x[i] != y[i] ? 1 : 0;
            }
        }
        return count;
    }

    Bench kept;
    Bench whole;

private:
    void addDirty(std::size_t index)
    {
        for (std::size_t i = kStillBoxes; i < kept.scene.boxes.size(); ++i) {
            dirty_[index] = unionOf(dirty_[index], rectOf(kept.plan.views[index], kept.scene.boxes[i]));
        }
    }
    MapNames kept_names_;
    MapNames whole_names_;
    std::vector<TexelRect> dirty_; // by view, since it was drawn last
    std::mt19937 random_;
};

class KeptMaps : public testing::TestWithParam<Case> {};

TEST_P(KeptMaps, holdWhatMapsHoldThatAreDrawnAtOnce)
{
    Pair pair(GetParam());
    pair.record();
    EXPECT_EQ(pair.differences(), 0U) << "the first frame";
    for (int frame = 0; frame < 4; ++frame) {
        pair.move();
        for (Bench* bench : {&pair.kept, &pair.whole}) {
            bench->plan.views[0].contents.redraw = frame != 1; // nobody reads it then
        }
        pair.record();
        EXPECT_EQ(pair.differences(), 0U) << "frame " << frame;
    }
    // Larger images hold what the smaller ones held.
    pair.grow();
    for (Bench* bench : {&pair.kept, &pair.whole}) {
        for (View& view : bench->plan.views) {
            view.contents.redraw = false;
        }
    }
    pair.record();
    EXPECT_EQ(pair.kept.renderer.reuse(0).held, 3U);
    EXPECT_EQ(pair.differences(), 0U) << "after the maps were copied";
    pair.grow();
    pair.move();
    for (Bench* bench : {&pair.kept, &pair.whole}) {
        for (View& view : bench->plan.views) {
            view.contents.redraw = true;
            view.contents.dirty = {0, 0, kMapSize, kMapSize};
        }
    }
    pair.record();
    EXPECT_EQ(pair.kept.renderer.reuse(0).kept_drawn, 0U);
    EXPECT_EQ(pair.kept.renderer.reuse(0).restored, 3U);
    EXPECT_EQ(pair.differences(), 0U) << "after the kept maps were copied";
    expectSilence(gpu());
}

TEST_P(KeptMaps, aPlanThatForgetsWhatMovedIsSeen)
{
    Pair pair(GetParam());
    pair.record();
    pair.move();
    for (View& view : pair.kept.plan.views) {
        view.contents.dirty = {0, 0, 2, 2};
        // A filterable map is restored whole: there it is the movers themselves that must be missing.
        view.casters.count = view.casters.still;
    }
    pair.record();
    EXPECT_GT(pair.differences(), 100U);
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(
    Formats, KeptMaps,
    testing::Values(Case{"pcf_d32f", Filter::pcf, MapFormat::d32f}, Case{"hard_d16", Filter::hard, MapFormat::d16},
                    Case{"pcf_r32f", Filter::pcf, MapFormat::r32f}, Case{"pcf_rg16", Filter::pcf, MapFormat::rg16},
                    Case{"pcf_rg16_paired", Filter::pcf, MapFormat::rg16, 1, true},
                    Case{"hard_rgba8_paired", Filter::hard, MapFormat::rgba8, 1, true},
                    Case{"pcf_rgba8_shared", Filter::pcf, MapFormat::rgba8, 1, true, true},
                    Case{"pcf_rg16_shared", Filter::pcf, MapFormat::rg16, 1, true, true},
                    Case{"hard_rg16f_shared", Filter::hard, MapFormat::rg16f, 1, true, true},
                    Case{"vsm_1", Filter::vsm, MapFormat::rg32f, 1}, Case{"vsm_4", Filter::vsm, MapFormat::rg16, 4},
                    Case{"lvsm_4", Filter::lvsm, MapFormat::rgba16, 4}, Case{"esm_1", Filter::esm, MapFormat::r32f, 1},
                    Case{"esm_4", Filter::esm, MapFormat::r16f, 4}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(KeptMapsCount, whatIsReused)
{
    Pair pair({"pcf_d32f", Filter::pcf, MapFormat::d32f});
    pair.record();
    vulkan::MapReuse reuse = pair.kept.renderer.reuse(0);
    EXPECT_EQ(reuse.kept_drawn, 3U);
    EXPECT_EQ(reuse.restored, 3U);
    EXPECT_EQ(reuse.restored_texels, 3U * kMapSize * kMapSize);
    EXPECT_EQ(reuse.still_casters, 3U * (1 + kStillBoxes));
    EXPECT_EQ(reuse.moving_casters, 3U * 3U);
    EXPECT_EQ(pair.whole.renderer.reuse(0).drawn, 3U);
    EXPECT_EQ(pair.whole.renderer.reuse(0).casters_at_once, 3U * (1 + kStillBoxes + 3U));
    pair.move();
    pair.kept.plan.views[2].contents.redraw = false;
    pair.record();
    reuse = pair.kept.renderer.reuse(0);
    EXPECT_EQ(reuse.kept_drawn, 0U);
    EXPECT_EQ(reuse.restored, 2U);
    EXPECT_EQ(reuse.held, 1U);
    EXPECT_EQ(reuse.still_casters, 0U);
    EXPECT_EQ(reuse.moving_casters, 2U * 3U);
    EXPECT_LT(reuse.restored_texels, 2U * kMapSize * kMapSize);
    EXPECT_GT(reuse.restored_texels, 0U);
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
