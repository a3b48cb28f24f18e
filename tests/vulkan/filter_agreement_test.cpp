// SPDX-License-Identifier: Apache-2.0
// Facts that must not matter: earlier draws of the same renderer, and which of both kinds of shaders blurs.
#include "moment_bench.h"
#include "moment_numbers.h"
#include "parity.h"
#include "read_error.h"

#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

/// One renderer over two scenes with the same views.
class Redrawn {
public:
    Redrawn(const Scene& scene, const Plan& plan, const ShadowOptions& filter)
        : filter_(filter), renderer_(gpu().view(), {.frames_in_flight = 1}), drawer_(gpu().view(), drawerOptions()),
          mesh_(uploadMesh(gpu(), scene)), transforms_(scene.transforms())
    {
        drawer_.setScene(mesh_.parts, mesh_.objects, mesh_.batches);
        (void)renderer_.prepare(withOptions(plan), {8, 8});
    }
    void draw(const Plan& given)
    {
        const Plan plan = withOptions(given);
        gpu().run([&](VkCommandBuffer commands) {
            drawer_.beginFrame(0, plan, mesh_.geometry, transforms_);
            renderer_.recordMaps(commands, 0, plan, [&](const vulkan::MapPass& pass) { drawer_.draw(pass); });
        });
        expectSilence(gpu());
    }
    [[nodiscard]] std::vector<CpuMap> maps(const Plan& plan) const
    {
        std::vector<CpuMap> layers;
        const vulkan::ImageRef image = renderer_.maps();
        for (std::uint32_t layer = 0; layer < image.layers; ++layer) {
            layers.push_back(readCpuMap(gpu(), image, layer, levelsOf(filter_, plan.pages[0])));
        }
        return layers;
    }

private:
    static vulkan::CasterDrawerOptions drawerOptions()
    {
        vulkan::CasterDrawerOptions options;
        options.frames_in_flight = 1;
        return options;
    }
    [[nodiscard]] Plan withOptions(Plan plan) const
    {
        plan.options = planOptions(filter_);
        return plan;
    }

    ShadowOptions filter_{.technique = kPlainTechnique};
    vulkan::ShadowRenderer renderer_;
    vulkan::CasterDrawer drawer_;
    SceneMesh mesh_;
    std::vector<vulkan::Rows3x4> transforms_;
};

/// The same views with one small box each and no ground, so that most blocks have nothing in reach of the blur.
Plan sparseOf(Plan plan)
{
    for (View& view : plan.views) {
        view.casters.first += 1;
        view.casters.count = 1;
    }
    return plan;
}

std::size_t differingTexels(const std::vector<CpuMap>& a, const std::vector<CpuMap>& b, const Plan& plan)
{
    std::size_t different = 0;
    for (std::size_t layer = 0; layer < a.size(); ++layer) {
        for (const View& view : plan.views) {
            const Tile& tile = view.place.tile;
            const auto last =
                static_cast<std::size_t>(coarsestOf(tile, static_cast<std::uint32_t>(a[layer].levels.size())));
            for (std::size_t level = 0; level <= last; ++level) {
                const std::size_t width = a[layer].width >> level;
                for (std::size_t y = tile.y >> level; y < (tile.y + tile.height) >> level; ++y) {
                    for (std::size_t x = tile.x >> level; x < (tile.x + tile.width) >> level; ++x) {
                        const std::size_t at = y * width + x;
                        different += a[layer].levels[level][at] == b[layer].levels[level][at] ? 0 : 1;
                    }
                }
            }
        }
    }
    return different;
}

struct Case {
    std::string name;
    Filter filter;
    MapFormat format;
    BlurPath path;
    bool odd; // tiles that are no multiples of a block
};
std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

class StaleScratch : public testing::TestWithParam<Case> {};

TEST_P(StaleScratch, isNeverRead)
{
    const Case& c = GetParam();
    const Scene scene = makeScene();
    const std::vector<Light> lights{makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)};
    const std::vector<Tile> tiles = c.odd ? std::vector<Tile>{{0, 0, 0, 235, 203}, {0, 259, 37, 171, 97}}
                                          : std::vector<Tile>{{0, 0, 0, 256, 256}, {0, 288, 64, 160, 96}};
    const Plan dense = makePlan(scene, lights, tiles, {512, 256, 1});
    const Plan sparse = sparseOf(dense);
    ShadowOptions filter = momentFilter(c.filter, c.format);
    filter.moments.blur = BlurKind::gaussian;
    filter.moments.sampling = MapSampling::trilinear;
    filter.moments.blur_path = c.path;
    filter.moments.layers = 4;
    for (const std::uint32_t radius : {4U, 31U}) {
        filter.moments.blur_radius_texels = radius;
        filter.moments.blur_sigma_texels = static_cast<float>(radius) / 3.1F;
        Redrawn fresh(scene, sparse, filter);
        fresh.draw(sparse);
        Redrawn used(scene, dense, filter);
        used.draw(dense);
        const std::vector<CpuMap> before = used.maps(sparse);
        used.draw(sparse);
        const std::vector<CpuMap> expected = fresh.maps(sparse);
        EXPECT_EQ(differingTexels(used.maps(sparse), expected, sparse), 0U) << "radius " << radius;
        EXPECT_GT(differingTexels(before, expected, sparse), 10000U) << "else there was nothing to be left over";
    }
}

std::vector<Case> staleCases()
{
    std::vector<Case> cases;
    for (const BlurPath path : {BlurPath::compute, BlurPath::fragment}) {
        for (const bool odd : {false, true}) {
            const std::string end = std::string("_") + std::string(nameOf(path)) + (odd ? "_odd" : "");
            cases.push_back({"vsm" + end, Filter::vsm, MapFormat::rg32f, path, odd});
            cases.push_back({"lvsm" + end, Filter::lvsm, MapFormat::rgba16, path, odd});
            cases.push_back({"evsm" + end, Filter::evsm, MapFormat::rgba32f, path, odd});
            cases.push_back({"msm" + end, Filter::msm, MapFormat::rgba16, path, odd});
        }
    }
    return cases;
}
INSTANTIATE_TEST_SUITE_P(Paths, StaleScratch, testing::ValuesIn(staleCases()),
                         [](const auto& test_case) { return test_case.param.name; });

} // namespace
} // namespace gnomon::test
