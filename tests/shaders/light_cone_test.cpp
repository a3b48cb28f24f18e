// SPDX-License-Identifier: Apache-2.0
// Filters that know how large the light is, on maps whose shadows are known in closed form.
#include "cpu_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

using namespace shared;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Parallel light that shines along -z from `top` metres over the origin. A texel is `texel` metres wide, and the
/// origin is in the middle of the page.
struct Stage {
    double texel = 0.02;
    double top = 8.0;
    double side = 512.0;
    double tangent = std::tan(1.0 * kDegree); // of half the light's angle
    glm::dvec3 n{0.0, 0.0, 1.0};              // of the receiver
    int filter = GNOMON_FILTER_RAYMARCH;

    [[nodiscard]] MapRows rows() const
    {
        MapRows rows;
        rows.x = {1.0 / texel, 0.0, 0.0, side / 2.0};
        rows.y = {0.0, 1.0 / texel, 0.0, side / 2.0};
        rows.w = {0.0, 0.0, 0.0, 1.0};
        rows.metric = {0.0, 0.0, -0.5 / top, 0.5};
        rows.texel_m = texel;
        rows.range_m = 2.0 * top;
        return rows;
    }
    /// Fills the map with `height` of the highest surface over a place.
    template <class Height>
    void draw(Height height) const
    {
        test::map_texels = [=, *this](int x, int y) {
            const glm::dvec2 centre = (glm::dvec2(x, y) + 0.5 - side / 2.0) * texel;
            return std::clamp(0.5 - 0.5 * height(centre) / top, 0.0, 1.0);
        };
        test::makeBlocks(static_cast<int>(side));
    }
    [[nodiscard]] std::pair<MapPoint, FilterInput> receiver(glm::dvec3 p, glm::dvec2 pixel) const
    {
        BiasRule rule{};
        rule.automatic = 1.0;
        rule.snap_texels = snapOf(8.0);
        rule.normal_error = 2e-4;
        rule.quantum = 4e-6;
        rule.exact_plane = 1.0;
        FilterInput f{};
        f.pixel = pixel;
        f.rows = rows();
        f.n = n;
        f.toward = {0.0, 0.0, 1.0};
        f.spread = tangent;
        f.tile = {0.0, 0.0, side, side};
        f.coarsest = std::log2(side);
        return {projectReceiver(f.rows, rule, p, n), f};
    }
    [[nodiscard]] double visibility(glm::dvec3 p, glm::dvec2 pixel) const
    {
        const auto [point, f] = receiver(p, pixel);
        return applyFilter(filter, point, f);
    }
};

glm::dvec2 pixelOf(int i)
{
    return glm::dvec2(i % 61, i / 61) + 0.5;
}

/// The share of a disc on one side of a line at t radii from its centre.
double beyondLine(double t)
{
    const double c = std::clamp(t, -1.0, 1.0);
    return 1.0 - (std::acos(c) - c * std::sqrt(1.0 - c * c)) / std::numbers::pi;
}

struct Errors {
    double rms = 0.0;
    double mean = 0.0;
};

/// Along a line over the penumbra of a half plane at a height, `texels` wide on the map, against the closed form. The
/// half plane ends across `across`, not along the map's texels.
Errors errorsBesideAHalfPlane(int filter, double degrees, double height, double texels, glm::dvec2 across)
{
    constexpr int kPoints = 2000;
    Stage stage;
    stage.filter = filter;
    stage.tangent = std::tan(0.5 * degrees * kDegree);
    const double reach = height * stage.tangent;
    stage.texel = 2.0 * reach / texels;
    across = glm::normalize(across);
    stage.draw([&](glm::dvec2 q) { return glm::dot(across, q) < 0.0 ? height : 0.0; });
    Errors errors;
    for (int i = 0; i < kPoints; ++i) {
        const double x = reach * (-1.2 + 2.4 * (i + 0.5) / kPoints);
        const glm::dvec2 q = across * x + glm::dvec2(-across.y, across.x) * (0.037 * i * stage.texel);
        const double error = stage.visibility({q, 0.0}, pixelOf(i)) - beyondLine(x / reach);
        errors.rms += error * error / kPoints;
        errors.mean += error / kPoints;
    }
    errors.rms = std::sqrt(errors.rms);
    return errors;
}

TEST(Raymarch, SeesTheShareOfADiscBesideAHalfPlane)
{
    for (const double degrees : {0.53, 2.0, 8.0}) {
        for (const double texels : {8.0, 12.0, 24.0}) {
            for (const double height : {1.0, 7.0}) {
                const Errors errors =
                    errorsBesideAHalfPlane(GNOMON_FILTER_RAYMARCH, degrees, height, texels, {1.0, 0.3});
                // From twelve texels on the rays' noise is what is left; below there are fewer rays.
                EXPECT_LT(errors.rms, texels < 12.0 ? 0.03 : 0.02) << texels << " texels";
                EXPECT_LT(std::abs(errors.mean), 0.002) << texels << " texels";
            }
        }
    }
}

// The mean depth of blockers says about a half here.
/// How far from a hard edge its shadow's edge is found, rms over places along it, texels. `degrees`: by which the edge
/// leans on the map.
double errorOfAnEdgesPlace(double degrees)
{
    constexpr int kLines = 100;
    constexpr int kPoints = 60;
    constexpr double kReach = 3.0; // texels to each side
    Stage stage;
    stage.tangent = 0.25 * stage.texel; // of casters a metre up: a penumbra of half a texel
    const glm::dvec2 across(std::cos(degrees * kDegree), std::sin(degrees * kDegree));
    stage.draw([&](glm::dvec2 q) { return glm::dot(across, q) < 0.0 ? 1.0 : 0.0; });
    double squares = 0.0;
    for (int line = 0; line < kLines; ++line) {
        double lit = 0.0; // texels
        for (int i = 0; i < kPoints; ++i) {
            const double x = kReach * (2.0 * (i + 0.5) / kPoints - 1.0);
            const glm::dvec2 q = across * x + glm::dvec2(-across.y, across.x) * (0.371 * line);
            lit += stage.visibility({q * stage.texel, 0.0}, pixelOf(line * kPoints + i)) * 2.0 * kReach / kPoints;
        }
        squares += (lit - kReach) * (lit - kReach) / kLines;
    }
    return std::sqrt(squares);
}

// A texel alone says where an edge is to 0.29 texels, the rms of what is spread evenly over one. The rays of a square
// of 1.5 texels say it to 0.18 in the mean, and to 0.22 where the edge leans by 10 degrees. A line says it to 0.08.
TEST(Raymarch, FindsAnEdgesPlaceByWhatIsAlongIt)
{
    double sum = 0.0;
    const std::vector<double> leanings{10.0, 20.0, 35.0, 55.0, 70.0, 80.0};
    for (const double degrees : leanings) {
        const double error = errorOfAnEdgesPlace(degrees);
        EXPECT_LT(error, 0.13) << degrees;
        sum += error;
    }
    EXPECT_LT(sum / static_cast<double>(leanings.size()), 0.09);
}

// In penumbrae narrower than a few texels lines along edges decide, and not rays.
TEST(Raymarch, SeesNarrowPenumbraeByLinesAlongEdges)
{
    for (const double texels : {1.0, 3.0, 5.0}) {
        for (const glm::dvec2 across : {glm::dvec2(1.0, 0.0), glm::dvec2(1.0, 0.1), glm::dvec2(0.3, 1.0)}) {
            const Errors errors = errorsBesideAHalfPlane(GNOMON_FILTER_RAYMARCH, 2.0, 1.0, texels, across);
            EXPECT_LT(errors.rms, 0.06 / texels) << texels << " texels, " << across.y;
            EXPECT_LT(std::abs(errors.mean), 0.001) << texels << " texels, " << across.y;
        }
    }
}

// A pole narrower than its penumbra darkens by both of its edges, and a gap lets in what both leave.
TEST(Raymarch, SeesBothEdgesOfWhatIsNarrow)
{
    for (const bool gap : {false, true}) {
        Stage stage;
        const double reach = stage.tangent; // of what stands a metre up
        stage.texel = reach / 2.0;
        const double half = 2.0 * stage.texel;
        stage.draw([&](glm::dvec2 q) { return (std::abs(q.x) < half) != gap ? 1.0 : 0.0; });
        for (int i = 0; i < 200; ++i) {
            const double x = reach * (-1.4 + 2.8 * i / 199.0);
            const double beside = 1.0 - beyondLine((x + half) / reach) + beyondLine((x - half) / reach);
            const double seen = stage.visibility({x, 0.3 * stage.texel, 0.0}, pixelOf(i));
            EXPECT_NEAR(seen, gap ? 1.0 - beside : beside, 0.02) << x / reach;
        }
    }
}

TEST(Raymarch, OccludersThatCoverTheLightTogetherFuse)
{
    Stage stage;
    stage.tangent = std::tan(4.0 * kDegree);
    stage.draw([](glm::dvec2 q) { return q.x < 0.0 ? 2.0 : 6.0; });
    for (int i = 0; i < 200; ++i) {
        EXPECT_LE(stage.visibility({0.004 * (i - 100), 0.1, 0.0}, pixelOf(i)), 0.02) << i;
    }
}

TEST(Raymarch, APlaneIsLitAtAnyIncidence)
{
    std::mt19937 rng(3);
    std::uniform_real_distribution<double> place(-0.5, 0.5);
    for (int degrees = 1; degrees <= 89; degrees += 4) {
        Stage stage;
        stage.top = 100.0;
        const double turn = 0.7;
        const double tangent = std::tan(degrees * kDegree);
        stage.n = glm::normalize(glm::dvec3(-tangent * std::cos(turn), -tangent * std::sin(turn), 1.0));
        const auto height = [&](glm::dvec2 q) {
            return tangent * (q.x * std::cos(turn) + q.y * std::sin(turn));
        };
        stage.draw(height);
        // The part of the light's disc below the plane's own horizon is not seen.
        const double beyond = beyondLine(1.0 / (tangent * stage.tangent));
        for (int i = 0; i < 50; ++i) {
            const glm::dvec2 q(place(rng), place(rng));
            EXPECT_GE(stage.visibility({q, height(q)}, pixelOf(i)), beyond - 0.1) << degrees << " degrees";
        }
    }
}

/// A lit sphere of radius 1 m, from its pole to near its rim.
void expectASphereIsLit(int filter)
{
    Stage stage;
    stage.filter = filter;
    const auto height = [](glm::dvec2 q) {
        return std::sqrt(std::max(1.0 - glm::dot(q, q), 0.0));
    };
    stage.draw(height);
    for (int i = 0; i < 400; ++i) {
        const double radius = 0.97 * std::sqrt((i + 0.5) / 400.0);
        const glm::dvec2 q = radius * glm::dvec2(std::cos(2.4 * i), std::sin(2.4 * i));
        stage.n = glm::dvec3(q, height(q));
        EXPECT_EQ(stage.visibility({q, height(q)}, pixelOf(i)), 1.0) << radius;
    }
}

TEST(Raymarch, ASphereIsLitToItsRim)
{
    expectASphereIsLit(GNOMON_FILTER_RAYMARCH);
}

// A wall that faces the light and the ground before it: both lit, and shadow from the wall's top begins at its foot.
TEST(Raymarch, ACreaseIsLitAndAFootIsDark)
{
    Stage stage;
    const double lean = 0.5; // the wall's foot is at x = 0, its top 0.5 m behind that, a metre up
    stage.draw([&](glm::dvec2 q) { return q.x < 0.003 ? 0.0 : q.x < 0.003 + lean ? (q.x - 0.003) / lean : 0.0; });
    for (int i = 1; i < 100; ++i) {
        const double x = 0.003 - 0.0005 * i;
        EXPECT_EQ(stage.visibility({x, 0.07, 0.0}, pixelOf(i)), 1.0) << "before the wall, " << x;
    }
    for (int i = 0; i < 50; ++i) {
        const double x = 0.003 + lean - 2.0 * stage.texel - 0.002 * i;
        EXPECT_EQ(stage.visibility({x, 0.07, 0.0}, pixelOf(i)), 0.0) << "beneath it, " << x;
    }
}

// With one caster the mean depth of blockers is exact, and so is the penumbra.
TEST(Pcss, SeesTheShareOfADiscBesideAHalfPlane)
{
    for (const double degrees : {0.53, 4.0}) {
        for (const double height : {1.0, 3.0, 7.0}) {
            EXPECT_LT(errorsBesideAHalfPlane(GNOMON_FILTER_PCSS, degrees, height, 12.0, {0.4, 1.0}).rms, 0.03)
                << degrees << " degrees, " << height << " m";
        }
    }
}

// The known fault of PCSS: occluders that cover the light together let half of it through. Rays do not.
TEST(Pcss, DoesNotFuseOccluders)
{
    Stage stage;
    stage.tangent = std::tan(4.0 * kDegree);
    stage.draw([](glm::dvec2 q) { return q.x < -0.3 ? 6.0 : q.x < 0.0 ? 2.0 : 0.0; });
    double pcss = 0.0;
    double rays = 0.0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 p(-0.25 + 0.0005 * i, 0.1, 0.0);
        stage.filter = GNOMON_FILTER_PCSS;
        pcss += stage.visibility(p, pixelOf(i)) / 200.0;
        stage.filter = GNOMON_FILTER_RAYMARCH;
        rays += stage.visibility(p, pixelOf(i)) / 200.0;
    }
    EXPECT_GT(pcss, rays + 0.02);
}

TEST(Pcss, ASphereIsLitToItsRim)
{
    expectASphereIsLit(GNOMON_FILTER_PCSS);
}

TEST(LightCone, IsLitBeyondTheFarPlaneWhereNothingCasts)
{
    Stage stage;
    for (const int filter : {GNOMON_FILTER_RAYMARCH, GNOMON_FILTER_PCSS}) {
        stage.filter = filter;
        for (const glm::dvec3 n : {glm::dvec3(0.0, 0.0, 1.0), glm::normalize(glm::dvec3(0.6, 0.3, 1.0))}) {
            stage.n = n;
            test::map_texels = [](int, int) { // nothing was drawn
                return 1.0;
            };
            test::makeBlocks(static_cast<int>(stage.side));
            for (int i = 0; i < 50; ++i) {
                const glm::dvec3 p(0.03 * i, -0.02 * i, -stage.top * (1.01 + 0.02 * i));
                EXPECT_EQ(stage.visibility(p, pixelOf(i)), 1.0) << filter << " " << i;
            }
            // Half a plane that casts, and nothing else.
            test::map_texels = [&](int x, int) {
                return x < 256 ? 0.3 : 1.0;
            };
            test::makeBlocks(static_cast<int>(stage.side));
            EXPECT_EQ(stage.visibility({3.0, 0.0, -1.2 * stage.top}, pixelOf(1)), 1.0) << filter;
            EXPECT_EQ(stage.visibility({-3.0, 0.0, -1.2 * stage.top}, pixelOf(1)), 0.0) << filter;
        }
    }
}

// Where blocks decide a pixel, rays that know nothing of them find the same; other rays, so not to the last one.
TEST(Raymarch, BlocksOnlySaveWork)
{
    std::mt19937 rng(5);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int decided = 0;
    for (int round = 0; round < 24; ++round) {
        Stage stage;
        stage.tangent = 0.02 * std::pow(8.0, uniform(rng));
        const double edge = uniform(rng) - 0.5;
        const double width = 0.3 * uniform(rng);
        const double height = 0.1 + 6.0 * uniform(rng);
        stage.draw([&](glm::dvec2 q) { return std::abs(q.x + 0.4 * q.y - edge) < width ? height : 0.0; });
        for (int i = 0; i < 100; ++i) {
            const auto [point, f] = stage.receiver({3.0 * uniform(rng) - 1.5, uniform(rng), 0.0}, pixelOf(i));
            const RayCone cone = rayCone(point, f);
            const double v = lookAround(point, f, cone, kStartsWithin, kRayEnd).visibility;
            if (v >= 0.0) {
                EXPECT_NEAR(traceRays(point, f, cone, 0.0, RayTask{64, true, 1.0}).lit, v, 0.08) << round << ", " << i;
                ++decided;
            }
        }
    }
    EXPECT_GT(decided, 1000);
}

// Towers of all heights. Passing over squares of texels at once, a ray finds what it finds texel by texel, in fewer
// steps.
TEST(Raymarch, SquaresThatArePassedOverChangeNoRay)
{
    std::mt19937 rng(11);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int blocked = 0;
    int compared = 0;
    std::int64_t steps = 0;
    std::int64_t texels = 0;
    for (int round = 0; round < 20; ++round) {
        Stage stage;
        stage.side = 256.0;
        const double fewest = 0.8 + 0.2 * uniform(rng);
        std::vector<double> heights(64 * 64);
        for (double& height : heights)
            height = uniform(rng) > fewest ? 6.0 * uniform(rng) : 0.0;
        stage.draw([&](glm::dvec2 q) {
            const glm::dvec2 cell = glm::clamp(glm::floor((q / stage.texel + 128.0) / 4.0), 0.0, 63.0);
            return heights[static_cast<std::size_t>(cell.y * 64.0 + cell.x)];
        });
        for (int i = 0; i < 300; ++i) {
            auto [point, f] = stage.receiver({4.0 * uniform(rng) - 2.0, 4.0 * uniform(rng) - 2.0, 0.0}, pixelOf(i));
            const glm::dvec2 end(256.0 * uniform(rng), 256.0 * uniform(rng));
            const RayRun run = rayRun(glm::dvec3(point.texel, 1.0), glm::dvec3(end, 1.0));
            const LightRay ray{run, point.depth, 0.1, 1.0, 1.0, true};
            const RayEnd over = followRay(point, f, ray);
            f.coarsest = 0.0;
            const RayEnd through = followRay(point, f, ray);
            if (through.steps >= kRaySteps)
                continue;
            ASSERT_EQ(over.blocked, through.blocked) << round << ", " << i;
            blocked += through.blocked ? 1 : 0;
            ++compared;
            steps += over.steps;
            texels += through.steps;
        }
    }
    EXPECT_GT(compared, 4000);
    EXPECT_GT(blocked, 1000);
    EXPECT_LT(blocked, 5 * compared / 6);
    EXPECT_LT(3 * steps, 2 * texels);
    RecordProperty("share of steps", std::to_string(static_cast<double>(steps) / static_cast<double>(texels)));
}

TEST(Raymarch, TheSizeOfTheWorldDoesNotMatter)
{
    for (const double scale : {1.0 / 1024.0, 1024.0}) {
        for (int i = 0; i < 100; ++i) {
            const auto seen = [&](double k) {
                Stage stage;
                stage.texel *= k;
                stage.top *= k;
                stage.draw([&](glm::dvec2 q) { return q.x < 0.1 * k ? 3.0 * k : 0.0; });
                return stage.visibility({(0.1 + 0.001 * (i - 50)) * k, 0.03 * k, 0.0}, pixelOf(i));
            };
            EXPECT_EQ(seen(1.0), seen(scale)) << i;
        }
    }
}

/// A lamp 4 m over a floor, and a half plane between them: the same closed form, by similar triangles.
TEST(Raymarch, ALampIsSeenBesideAHalfPlane)
{
    constexpr double kLamp_m = 4.0;
    constexpr double kRadius_m = 0.2;
    constexpr double kTexels = 1024.0;
    for (const double height : {0.8, 2.0, 3.0}) {
        MapRows rows;
        const double focus = kTexels / 2.0; // 90 degrees
        rows.x = {focus, 0.0, -kTexels / 2.0, kTexels / 2.0 * kLamp_m};
        rows.y = {0.0, focus, -kTexels / 2.0, kTexels / 2.0 * kLamp_m};
        rows.w = {0.0, 0.0, -1.0, kLamp_m};
        const double near = 0.5;
        const double far = 4.1;
        rows.metric = {0.0, 0.0, -1.0 / (far - near), (kLamp_m - near) / (far - near)};
        rows.texel_m = 0.0;
        rows.range_m = far - near;
        test::map_texels = [&](int x, int) {
            const double tangent = (x + 0.5 - kTexels / 2.0) / focus;
            const double depth = tangent < 0.0 ? kLamp_m - height : kLamp_m;
            return (depth - near) / (far - near);
        };
        test::makeBlocks(static_cast<int>(kTexels));
        const double reach = kRadius_m * height / (kLamp_m - height);
        double squares = 0.0;
        constexpr int kPoints = 1500;
        for (int i = 0; i < kPoints; ++i) {
            const double x = reach * (-1.2 + 2.4 * (i + 0.5) / kPoints);
            BiasRule rule{};
            rule.automatic = 1.0;
            rule.snap_texels = snapOf(8.0);
            rule.normal_error = 2e-4;
            rule.quantum = 4e-6;
            rule.exact_plane = 1.0;
            FilterInput f{};
            const glm::dvec3 p(x, 0.2, 0.0);
            f.pixel = pixelOf(i);
            f.rows = rows;
            f.n = {0.0, 0.0, 1.0};
            f.toward = glm::dvec3(0.0, 0.0, kLamp_m) - p;
            f.spread = lightSpread(glm::vec4(0.0F, 0.0F, 0.0F, 1.0F), f.toward, kRadius_m);
            f.tile = {0.0, 0.0, kTexels, kTexels};
            f.coarsest = 10.0;
            const double error = filterRaymarch(projectReceiver(rows, rule, p, f.n), f) - beyondLine(x / reach);
            squares += error * error;
        }
        // The higher, the more texels wide is the lamp on the map, and the fewer rays there are.
        EXPECT_LT(std::sqrt(squares / kPoints), height < 1.0 ? 0.02 : height < 3.0 ? 0.04 : 0.1) << height << " m";
    }
}

} // namespace
} // namespace gnomon
