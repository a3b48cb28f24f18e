// SPDX-License-Identifier: Apache-2.0
// The blur and the mip levels of filterable maps against plain sums on the CPU over the same map without them.
#include "moment_bench.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

using Texels = std::vector<glm::dvec4>; // of a tile, row by row

std::vector<double> weightsOf(const MomentOptions& options)
{
    const int radius = static_cast<int>(blurRadius(options));
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        const double d = i / double(options.blur_sigma_texels);
        weights.push_back(options.blur == BlurKind::box ? 1.0 : std::exp(-0.5 * d * d));
        sum += weights.back();
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

// One direction; what is outside the tile is lit.
Texels convolve(const Texels& in, const Tile& tile, const ShadowOptions& filter, const glm::dvec4& lit, bool along_x)
{
    const std::vector<double> weights = weightsOf(filter.moments);
    const int radius = static_cast<int>(weights.size() / 2);
    const int width = static_cast<int>(tile.width);
    const int height = static_cast<int>(tile.height);
    Texels out(in.size());
    std::vector<std::pair<glm::dvec4, double>> taps;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            taps.clear();
            for (int i = -radius; i <= radius; ++i) {
                const int tx = along_x ? x + i : x;
                const int ty = along_x ? y : y + i;
                const bool inside = tx >= 0 && ty >= 0 && tx < width && ty < height;
                taps.emplace_back(inside ? in[static_cast<std::size_t>(ty * width + tx)] : lit,
                                  weights[static_cast<std::size_t>(i + radius)]);
            }
            out[static_cast<std::size_t>(y * width + x)] = averageStored(filter, taps);
        }
    }
    return out;
}

Texels texelsOf(const CpuMap& map, const Tile& tile)
{
    Texels texels;
    for (std::uint32_t y = 0; y < tile.height; ++y) {
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            texels.emplace_back(map.levels[0][std::size_t{tile.y + y} * map.width + tile.x + x]);
        }
    }
    return texels;
}

// The largest difference, of a channel's largest value.
double worstDifference(const Texels& a, const Texels& b, int channels)
{
    double worst = 0.0;
    for (int c = 0; c < channels; ++c) {
        double scale = 1e-30;
        double difference = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            scale = std::max(scale, std::abs(a[i][c]));
            difference = std::max(difference, std::abs(a[i][c] - b[i][c]));
        }
        worst = std::max(worst, difference / scale);
    }
    return worst;
}

struct Case {
    const char* name;
    Filter filter;
    MapFormat format;
    void (*change)(MomentOptions&);
    double tolerance; // both passes round to the format
};
std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

class Blur : public testing::TestWithParam<Case> {};

TEST_P(Blur, isTheConvolutionOnBothPaths)
{
    const Case& c = GetParam();
    const Scene scene = makeScene();
    const Plan plan = momentPlan(scene);
    ShadowOptions filter = momentFilter(c.filter, c.format);
    c.change(filter.moments);
    ShadowOptions sharp = filter;
    sharp.moments.blur = BlurKind::none;
    const DrawnMaps before = drawMaps(scene, plan, sharp);
    for (const BlurPath path : {BlurPath::compute, BlurPath::fragment}) {
        filter.moments.blur_path = path;
        const DrawnMaps after = drawMaps(scene, plan, filter);
        EXPECT_EQ(after.cost.path, path);
        for (std::size_t layer = 0; layer < after.layers.size(); ++layer) {
            for (const View& view : plan.views) {
                const Texels source = texelsOf(before.layers[layer], view.place.tile);
                const glm::dvec4 lit = source[0]; // of the ring
                const Texels expected =
                    convolve(convolve(source, view.place.tile, filter, lit, true), view.place.tile, filter, lit, false);
                EXPECT_LE(
                    worstDifference(expected, texelsOf(after.layers[layer], view.place.tile), channelsOf(c.format)),
                    c.tolerance)
                    << nameOf(path) << ", layer " << layer << ", light " << view.light;
                EXPECT_GT(worstDifference(expected, source, channelsOf(c.format)), 0.01) << "it must do something";
            }
        }
    }
}

void gaussian(MomentOptions& o, std::uint32_t radius)
{
    o.blur = BlurKind::gaussian;
    o.blur_radius_texels = radius;
    o.blur_sigma_texels = std::min(static_cast<float>(radius) / 3.0F, 10.0F);
}

INSTANTIATE_TEST_SUITE_P(
    Kernels, Blur,
    testing::Values(Case{"radius_1", Filter::vsm, MapFormat::rg32f, [](MomentOptions& o) { gaussian(o, 1); }, 1e-5},
                    Case{"radius_4", Filter::vsm, MapFormat::rg32f, [](MomentOptions& o) { gaussian(o, 4); }, 2e-3},
                    Case{"radius_31", Filter::vsm, MapFormat::rg32f, [](MomentOptions& o) { gaussian(o, 31); }, 2e-3},
                    Case{"box_2", Filter::vsm, MapFormat::rg32f, [](MomentOptions& o) { o.blur = BlurKind::box; },
                         2e-3},
                    Case{"lvsm_2", Filter::lvsm, MapFormat::rgba16, [](MomentOptions& o) { gaussian(o, 4); }, 2e-3},
                    Case{"lvsm_3", Filter::lvsm, MapFormat::rgba16,
                         [](MomentOptions& o) {
                             gaussian(o, 3);
                             o.layers = 3;
                         },
                         2e-3},
                    Case{"lvsm_8", Filter::lvsm, MapFormat::rgba16,
                         [](MomentOptions& o) {
                             gaussian(o, 2);
                             o.layers = 8;
                         },
                         2e-3},
                    Case{"esm_log", Filter::esm, MapFormat::r32f,
                         [](MomentOptions& o) {
                             gaussian(o, 4);
                             o.log_space = true;
                             o.esm_exponent = 300.0F;
                         },
                         1e-5}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(BlurBlocks, withoutCastersInReachAreSkippedAndLit)
{
    const Scene scene = makeScene();
    Plan plan = momentPlan(scene);
    for (View& view : plan.views) { // without the ground, which fills everything
        ++view.casters.first;
        --view.casters.count;
    }
    const CpuMap depths = drawDepths(scene, plan);
    ShadowOptions filter = momentFilter(Filter::vsm, MapFormat::rg32f);
    gaussian(filter.moments, 4);
    for (const BlurPath path : {BlurPath::compute, BlurPath::fragment}) {
        filter.moments.blur_path = path;
        const DrawnMaps drawn = drawMaps(scene, plan, filter);
        std::uint64_t along_y = 0;
        std::uint64_t all = 0; // along x
        for (const View& view : plan.views) {
            const Tile& tile = view.place.tile;
            const int columns = static_cast<int>(tile.width + 31) / 32;
            const int rows = static_cast<int>(tile.height + 31) / 32;
            const auto isReachedAlongX = [&](int bx, int by) {
                if (by < 0 || by >= rows) {
                    return false;
                }
                for (int y = std::max(by * 32, 1); y < std::min(by * 32 + 32, int(tile.height) - 1); ++y) {
                    for (int x = std::max(bx * 32 - 4, 1); x < std::min(bx * 32 + 32 + 4, int(tile.width) - 1); ++x) {
                        if (depths.depth(tile.x + std::size_t(x), tile.y + std::size_t(y)) < 1.0F) {
                            return true;
                        }
                    }
                }
                return false;
            };
            for (int by = 0; by < rows; ++by) {
                for (int bx = 0; bx < columns; ++bx) {
                    all += std::uint64_t{32} * 32;
                    if (isReachedAlongX(bx, by - 1) || isReachedAlongX(bx, by) || isReachedAlongX(bx, by + 1)) {
                        along_y += std::uint64_t{32} * 32;
                        continue;
                    }
                    for (std::uint32_t i = 0; i < 32 * 32; ++i) {
                        const std::size_t x = tile.x + std::size_t(bx) * 32 + i % 32;
                        const std::size_t y = tile.y + std::size_t(by) * 32 + i / 32;
                        const glm::vec4 texel = drawn.layers[0].levels[0][y * depths.width + x];
                        ASSERT_TRUE(texel.x == 1.0F && texel.y == 1.0F) << "exactly lit";
                    }
                }
            }
        }
        EXPECT_EQ(drawn.cost.texels, all + along_y) << nameOf(path);
        EXPECT_LT(along_y, all) << "some must have been skipped";
        // Depths once, the scratch image once each way, the map once.
        EXPECT_EQ(drawn.cost.bytes_minimum, all * 4 + 2 * along_y * 8 + all * 8);
        // A block of 32 reads 40; two at a time where a filter adds them.
        EXPECT_EQ(drawn.cost.taps, all * 40 / 32 + (path == BlurPath::compute ? along_y * 40 / 32 : along_y * 5));
        EXPECT_GE(drawn.cost.bytes_moved, drawn.cost.bytes_minimum);
    }
}

TEST(MipLevels, areAveragesOfFour)
{
    const Scene scene = makeScene();
    const Plan plan = momentPlan(scene);
    for (const bool logarithms : {false, true}) {
        ShadowOptions filter =
            momentFilter(logarithms ? Filter::esm : Filter::vsm, logarithms ? MapFormat::r32f : MapFormat::rg32f);
        filter.moments.sampling = MapSampling::trilinear;
        filter.moments.log_space = logarithms;
        const DrawnMaps drawn = drawMaps(scene, plan, filter);
        const CpuMap& map = drawn.layers[0];
        ASSERT_EQ(map.levels.size(), 8U);
        for (const View& view : plan.views) {
            const std::uint32_t coarsest = view.light == 0 ? 7 : 5; // the spot's tile is at multiples of 32
            for (std::uint32_t level = 1; level <= coarsest; ++level) {
                const std::size_t fine_width = map.width >> (level - 1);
                double worst = 0.0;
                for (std::uint32_t y = view.place.tile.y >> level;
                     y < (view.place.tile.y + view.place.tile.height) >> level; ++y) {
                    for (std::uint32_t x = view.place.tile.x >> level;
                         x < (view.place.tile.x + view.place.tile.width) >> level; ++x) {
                        std::vector<std::pair<glm::dvec4, double>> four;
                        for (std::size_t i = 0; i < 4; ++i) {
                            four.emplace_back(map.levels[level - 1][(2 * y + i / 2) * fine_width + 2 * x + i % 2],
                                              0.25);
                        }
                        const glm::dvec4 expected = averageStored(filter, four);
                        const glm::vec4 stored = map.levels[level][y * std::size_t{map.width >> level} + x];
                        for (int c = 0; c < channelsOf(formatOf(filter)); ++c) {
                            worst = std::max(worst, std::abs(double(stored[c]) - expected[c]));
                        }
                    }
                }
                EXPECT_LE(worst, 1e-6) << "level " << level << ", light " << view.light;
            }
        }
    }
}

} // namespace
} // namespace gnomon::test
