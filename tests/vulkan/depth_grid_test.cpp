// SPDX-License-Identifier: Apache-2.0
// How far the depths that a device draws are off the planes that it draws, in steps of the grid to which it moves
// vertices: what the automatic bias takes for granted (gnomon/shared/bias.h). The figures are properties of the
// results.
#include "fixture.h"

#include <gnomon/shared/bias.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon::test {
namespace {

/// The surfaces that a view's texels show, by rays.
class ViewRays {
public:
    ViewRays(const Scene& scene, const View& view)
        : scene_(scene), view_(view), world_from_clip_(glm::inverse(view.projection.clip_from_world))
    {
    }
    [[nodiscard]] std::optional<Hit> hit(const glm::dvec2& texel) const
    {
        const glm::dvec3 from = at(texel, 0.0);
        return scene_.trace(from, at(texel, 1.0) - from);
    }
    /// The metric of the hit's plane at another place.
    [[nodiscard]] double depthOf(const Hit& hit, const glm::dvec2& hit_texel, const glm::dvec2& texel) const
    {
        const glm::dvec3 from = at(hit_texel, 0.0);
        const glm::dvec3 on_plane = from + (at(hit_texel, 1.0) - from) * hit.t;
        const glm::dvec3 here = at(texel, 0.0);
        const glm::dvec3 way = at(texel, 1.0) - here;
        const double t = glm::dot(hit.normal, on_plane - here) / glm::dot(hit.normal, way);
        return glm::dot(view_.projection.metric.metric_ws, glm::dvec4(here + way * t, 1.0));
    }

private:
    [[nodiscard]] glm::dvec3 at(const glm::dvec2& texel, double z) const
    {
        const glm::dvec2 place = (texel - glm::dvec2(view_.place.tile.x, view_.place.tile.y)) /
                                 glm::dvec2(view_.place.tile.width, view_.place.tile.height);
        const glm::dvec4 h = world_from_clip_ * glm::dvec4(2.0 * place - 1.0, z, 1.0);
        return glm::dvec3(h) / h.w;
    }
    const Scene& scene_;
    const View& view_;
    glm::dmat4 world_from_clip_;
};

/// The most that a stored depth is off, in steps; of texels all around which the same plane is seen.
double worstSteps(Bench& bench, std::uint32_t size)
{
    constexpr double kArithmetic = 4e-6;
    const View& view = bench.plan.views[0];
    const std::vector<float> stored = bench.readMap(0);
    const ViewRays rays(bench.scene, view);
    const double step = 1.0 / double(1U << gpu().limits().subPixelPrecisionBits);
    double worst = 0.0;
    for (std::uint32_t y = 2; y + 2 < size; y += 3) {
        for (std::uint32_t x = 2; x + 2 < size; x += 3) {
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const auto hit = rays.hit(centre);
            const auto same = [&](const glm::dvec2& off) {
                const auto beside = rays.hit(centre + off);
                return beside && beside->object == hit->object && glm::dot(beside->normal, hit->normal) > 0.999;
            };
            if (!hit || !same({1.0, 0.0}) || !same({-1.0, 0.0}) || !same({0.0, 1.0}) || !same({0.0, -1.0})) {
                continue;
            }
            const double exact = rays.depthOf(*hit, centre, centre);
            if (exact <= 0.0 || exact >= 1.0) {
                continue; // beyond what the view draws
            }
            const double slope = std::abs(rays.depthOf(*hit, centre, centre + glm::dvec2(step, 0.0)) - exact) +
                                 std::abs(rays.depthOf(*hit, centre, centre + glm::dvec2(0.0, step)) - exact);
            const double off = std::abs(stored[y * size + x] - exact) - kArithmetic;
            worst = std::max(worst, off / std::max(slope, 1e-9));
        }
    }
    return worst;
}

TEST(DepthGrid, isNotFartherOffThanTheBiasTakesForGranted)
{
    for (const bool sun : {true, false}) {
        double worst = 0.0;
        for (const std::uint32_t size : {90U, 160U, 320U, 720U}) {
            Bench bench({16, 16}, MapFormat::d32f);
            for (int i = 0; i < 12; ++i) {
                bench.scene.boxes.push_back(
                    {{i % 4 * 5.0 - 8.0, 0.3 + 0.1 * i, i / 4 * 6.0 - 7.0}, {0.7, 0.4, 1.1}, 0.37 * i});
            }
            bench.setLights({sun ? makeSun({0.8, -0.5, -0.35}) : makeSpot({-6.0, 9.0, 5.0}, {2.0, 0.0, -3.0}, 0.9)},
                            {{0, 0, 0, size, size}}, {size, size, 1});
            bench.prepare();
            bench.record(1);
            worst = std::max(worst, worstSteps(bench, size));
        }
        RecordProperty(sun ? "steps_of_sun" : "steps_of_spot", std::to_string(worst));
        EXPECT_LE(worst, double(shared::kSnapSteps));
    }
    RecordProperty("sub_pixel_bits", std::to_string(gpu().limits().subPixelPrecisionBits));
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
