// SPDX-License-Identifier: Apache-2.0
// How many texels per pixel any warp of a single map could give where they are fewest: a search over all homographies
// of the plane across the sun, put tightly around the pixels themselves. Prints a table.
#include "app/command_line.h"
#include "app/shot.h"
#include "lab/score/score.h"
#include "truth/visibility.h"

#include <gnomon/object_set.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

constexpr double kTexels = 2048.0;
constexpr int kAngles = 36;

struct Pixel {
    glm::dvec2 at;                 // across the sun, metres
    glm::dmat2 metres_from_pixels; // there, on the surface's plane
};
struct Seen {
    std::vector<Pixel> facing; // the sun, as texel density counts them
    // The outermost of all surfaces: a map that keeps lines straight has them outermost too.
    std::vector<glm::dvec2> places;
    glm::dvec3 right_ws{1, 0, 0};
    glm::dvec3 up_ws{0, 0, -1};
    double uniform = 0.0; // texels per pixel, first percentile, of the planner's unwarped map
};

double density(const glm::dmat2& texels_from_pixels)
{
    const glm::dmat2 pixels = glm::inverse(texels_from_pixels);
    return 1.0 / std::max(glm::length(pixels[0]), glm::length(pixels[1]));
}

double firstPercentile(std::vector<double>& values)
{
    const auto rank = static_cast<std::ptrdiff_t>(values.size() / 100);
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

/// The corners of the smallest convex shape around `points` (A. M. Andrew 1979).
std::vector<glm::dvec2> outermost(std::vector<glm::dvec2> points)
{
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<glm::dvec2> corners;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = corners.size();
        for (const glm::dvec2& point : points) {
            while (corners.size() >= first + 2) {
                const glm::dvec2 last = corners.back() - corners[corners.size() - 2];
                const glm::dvec2 next = point - corners.back();
                if (last.x * next.y - last.y * next.x > 0.0) {
                    break;
                }
                corners.pop_back();
            }
            corners.push_back(point);
        }
        std::reverse(points.begin(), points.end());
    }
    return corners;
}

/// Under a sun that shines straight down, with `right_ws` and `up_ws` across it.
Seen look(const std::vector<std::string>& view)
{
    std::vector<std::string> arguments{"plan"};
    arguments.insert(arguments.end(), view.begin(), view.end());
    arguments.insert(arguments.end(), {"--sun", "0,-1,0", "--size", "160x90"});
    const app::Settings settings = app::parseCommandLine(arguments).settings;
    const app::Shot shot = app::makeShot(settings);
    const glm::uvec2 size = settings.size_px;
    const Camera camera = host::cameraOf(shot.eye, size.x, size.y, shot.state.bounds_ws);
    const truth::View rays = lab::truthView(camera, size);
    const auto surfaces = truth::Tracer(shot.scene, shot.state).see(rays, {});
    const glm::dmat4 world_from_clip = glm::inverse(camera.clip_from_world);
    Seen seen;
    for (std::uint32_t y = 0; y < size.y; ++y)
        for (std::uint32_t x = 0; x < size.x; ++x) {
            if (*surfaces->object_ids.pixel(x, y) == 0)
                continue;
            const float* p = surfaces->points.pixel(x, y);
            const float* n = surfaces->normals.pixel(x, y);
            const glm::dvec3 point(p[0], p[1], p[2]); // from the eye
            const glm::dvec3 normal(n[0], n[1], n[2]);
            const auto place = [&](double px, double py) {
                const glm::dvec4 h =
                    world_from_clip * glm::dvec4(px / size.x * 2.0 - 1.0, py / size.y * 2.0 - 1.0, 0.5, 1.0);
                const glm::dvec3 way = glm::dvec3(h) / h.w - camera.eye_ws;
                const glm::dvec3 q = camera.eye_ws + way * (glm::dot(normal, point) / glm::dot(normal, way));
                return glm::dvec2(glm::dot(q, seen.right_ws), glm::dot(q, seen.up_ws));
            };
            const glm::dvec2 at = place(x + 0.5, y + 0.5);
            seen.places.push_back(at);
            if (normal.y > lab::kFacing)
                seen.facing.push_back(
                    {at, {(place(x + 0.75, y + 0.5) - at) / 0.25, (place(x + 0.5, y + 0.75) - at) / 0.25}});
        }
    seen.places = outermost(std::move(seen.places));
    ObjectSet objects;
    host::fillObjectSet(shot.state, objects);
    const std::vector<Light> lights = app::castersOf(shot);
    Frame frame;
    frame.camera = camera;
    frame.lights = lights;
    frame.objects = &objects;
    const glm::dvec2 texel = Planner(settings.shadow).plan(frame).views.at(0).projection.texel_xy_m;
    std::vector<double> found;
    for (const Pixel& pixel : seen.facing)
        found.push_back(density(glm::dmat2(1.0 / texel.x, 0.0, 0.0, 1.0 / texel.y) * pixel.metres_from_pixels));
    seen.uniform = firstPercentile(found);
    return seen;
}

struct Shape {
    double angle_rad = 0.0; // of the way in which texels grow
    double strength = 1.0;  // greatest w of the places
    double upright = 0.5;   // where the line is that stays upright, from the least to the greatest place across
};

/// The density of the map that holds all places exactly, without any border; at least `least`.
double densityOf(const Seen& seen, const Shape& shape, double least)
{
    const glm::dvec2 along(std::cos(shape.angle_rad), std::sin(shape.angle_rad));
    const glm::dvec2 across(along.y, -along.x);
    glm::dvec2 low(1e300); // of (across, along)
    glm::dvec2 high(-1e300);
    for (const glm::dvec2& q : seen.places) {
        low = glm::min(low, glm::dvec2(glm::dot(across, q), glm::dot(along, q)));
        high = glm::max(high, glm::dvec2(glm::dot(across, q), glm::dot(along, q)));
    }
    const double n = (high.y - low.y) / std::max(shape.strength - 1.0, 1e-9);
    const double upright = low.x + (high.x - low.x) * shape.upright;
    const auto wAt = [&](const glm::dvec2& q) {
        return 1.0 + (glm::dot(along, q) - low.y) / n;
    };
    glm::dvec2 first(1e300);
    glm::dvec2 last(-1e300);
    for (const glm::dvec2& q : seen.places) {
        const glm::dvec2 p = glm::dvec2(glm::dot(across, q) - upright, glm::dot(along, q) - low.y) / wAt(q);
        first = glm::min(first, p);
        last = glm::max(last, p);
    }
    const glm::dvec2 scale = kTexels / (last - first);
    std::vector<double> found;
    std::size_t left = seen.facing.size() / 100; // that many may lie below the first percentile
    for (const Pixel& pixel : seen.facing) {
        const double w = wAt(pixel.at);
        const double b = glm::dot(across, pixel.at) - upright;
        const glm::dvec2 x = (across * w - along * (b / n)) / (w * w) * scale.x;
        const glm::dvec2 y = along / (w * w) * scale.y;
        found.push_back(density(glm::dmat2(x.x, y.x, x.y, y.y) * pixel.metres_from_pixels));
        if (found.back() <= least && left-- == 0) {
            return least;
        }
    }
    return firstPercentile(found);
}

double best(const Seen& seen)
{
    double found = 0.0;
    for (int angle = 0; angle < kAngles; ++angle)
        for (double strength = 1.0; strength < 60.0; strength *= 1.4)
            for (double upright = -1.0; upright <= 2.0; upright += 0.5)
                found = densityOf(seen, {angle * 2.0 * std::numbers::pi / kAngles, strength, upright}, found);
    return found;
}

TEST(FitBound, OfAViewThatIsNotLongNoWarpMakesThreeTimesTheTexels)
{
    const char* given = std::getenv("GNOMON_SHARED");
    const std::filesystem::path shared = given != nullptr ? given : GNOMON_SHARED_DIR;
    const std::string scene = (shared / "scenes/terrain_lowpoly/terrain.glb").string();
    if (!std::filesystem::exists(scene))
        GTEST_SKIP() << scene << " is not there";
    const auto ratio = [&](const char* name, const std::vector<std::string>& view) {
        const Seen seen = look(view);
        const double found = best(seen);
        std::printf("| %s | %.2f | %.2f | %.1f |\n", name, seen.uniform, found, found / seen.uniform);
        return found / seen.uniform;
    };
    EXPECT_LT(ratio("terrain_lowpoly", {scene, "--eye", "2,1.2,12", "--target=-1,0.5,2", "--fov", "45"}), 3.0);
    EXPECT_GT(ratio("terrain_lowpoly, low", {scene, "--eye", "6,0.5,8", "--target=-8,0.3,-7", "--fov", "45"}), 3.0);
    EXPECT_GT(ratio("rts, unit", {"rts", "--camera", "unit"}), 3.0);
}

} // namespace
} // namespace gnomon
