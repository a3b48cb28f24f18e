// SPDX-License-Identifier: Apache-2.0
// Light bleeding: where two casters lie over each other, the averages that a map stores cannot tell the two apart from
// one that lets part of the light through. Tests how far layers of depth, warps and four moments help.
#include "stage.h"

#include "worlds/canopies.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::lab::test {
namespace {

using World = worlds::CanopiesWorld;

constexpr std::uint32_t kVsmSide = 512;
// As many bytes to a texel: two floats, or four of 16 bits.
host::RenderOptions vsm()
{
    return filterOptions(Filter::vsm, MapFormat::rg32f, kVsmSide);
}
host::RenderOptions lvsm(const std::vector<float>& splits)
{
    host::RenderOptions options = filterOptions(Filter::lvsm, MapFormat::rgba16, kVsmSide);
    options.shadow.moments.layers = static_cast<std::uint32_t>(splits.size()) + 1;
    options.shadow.moments.placement = LayerPlacement::by_hand;
    std::copy(splits.begin(), splits.end(), options.shadow.moments.splits.begin());
    return options;
}

host::RenderOptions lvsmByGaps(std::uint32_t layers)
{
    host::RenderOptions options = filterOptions(Filter::lvsm, MapFormat::rgba16, kVsmSide);
    options.shadow.moments.layers = layers;
    options.shadow.moments.placement = LayerPlacement::gaps;
    return options;
}

double bleedingOf(const Score& score)
{
    return score.classification.value().errors.bleeding;
}

/// World::depthOf() in the metric of the sun's map.
float splitAt(const View& view, float depth)
{
    const glm::dvec3 along = glm::normalize(glm::dvec3(World::sun_direction));
    return static_cast<float>(
        glm::dot(view.projection.metric.metric_ws, glm::dvec4(along * static_cast<double>(depth), 1.0)));
}

constexpr float kAboveAwning = -4.5F; // below the sail
constexpr float kBelowAwning = -1.7F; // above the ground; see PlanesAcrossTheSunPartItsRoofs

/// Without what widens a border beyond the class of edges.
host::RenderOptions unblurred(host::RenderOptions options)
{
    options.shadow.moments.blur = BlurKind::none;
    options.shadow.moments.sampling = MapSampling::bilinear;
    return options;
}

TEST(Bleeding, IsNothingWhereEachCasterHasALayerOfItsOwn)
{
    Stage stage(worlds::load("canopies", 1), "side", {240, 160});
    const View view = stage.mapView(vsm());
    const truth::Traced truth = stage.areaTruth(16);
    const double of_vsm = bleedingOf(stage.score(unblurred(vsm()), truth));
    const double of_lvsm =
        bleedingOf(stage.score(unblurred(lvsm({splitAt(view, kAboveAwning), splitAt(view, kBelowAwning)})), truth));
    std::printf("canopies, bleeding: vsm %.3e, three layers %.3e\n", of_vsm, of_lvsm);
    EXPECT_GT(of_vsm, 1e-4);
    EXPECT_EQ(of_lvsm, 0.0);
}

host::RenderOptions lvsmUniform(std::uint32_t layers)
{
    host::RenderOptions options = lvsmByGaps(layers);
    options.shadow.moments.placement = LayerPlacement::uniform;
    return options;
}

/// A camera sees walls below casters and floors below roofs that no map holds, and splits by the map leave them
/// bleeding.
TEST(Bleeding, IsNeverMoreByGapsThanWithLayersOfOneWidth)
{
    const auto expectNoMore = [](scene::Scene scene, const std::string& camera) {
        Stage stage(std::move(scene), camera, {480, 270});
        const truth::Traced truth = stage.hardTruth();
        for (const std::uint32_t layers : {2U, 8U}) {
            const double by_gaps = bleedingOf(stage.score(lvsmByGaps(layers), truth));
            const double of_uniform = bleedingOf(stage.score(lvsmUniform(layers), truth));
            std::printf("%s, %u layers: by gaps %.3e, of one width %.3e\n", camera.c_str(), layers, by_gaps,
                        of_uniform);
            EXPECT_LE(by_gaps, of_uniform) << camera << ", " << layers << " layers";
        }
    };
    expectNoMore(worlds::load("rts", 1), "unit");
    expectNoMore(worlds::load("sundial", 1), "meadow");
    expectNoMore(worlds::load("sundial", 1), "face");
    expectNoMore(worlds::load("canopies", 1), "side");
}

} // namespace
} // namespace gnomon::lab::test
