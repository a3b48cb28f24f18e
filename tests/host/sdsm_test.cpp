// SPDX-License-Identifier: Apache-2.0
// The GPU's fit of cascades to the camera's depth buffer, against the same reduction over the same buffer in double
// precision; and that every pixel lies in its cascade's map together with its kernel.
#define GNOMON_REAL double
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <glm/gtc/matrix_access.hpp>
#include <gnomon/shared/cascade_fit.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>

namespace gnomon::host::test {
namespace {

struct Pixel {
    glm::dvec3 point_ws{0.0};
    double depth_m = 0.0;
};

struct SdsmCase {
    const char* name;
    Fit fit;
    std::uint32_t count = 4;
    double max_distance_m = 0.0;
    double blend = 0.1;
    std::array<double, kMaxCascades - 1> ends_m{};
};

void PrintTo(const SdsmCase& one, std::ostream* out)
{
    *out << one.name;
}

struct Rect {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec2& p)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    [[nodiscard]] bool empty() const { return low.x > high.x; }
};

glm::dvec2 placeOn(const View& view, const glm::dvec3& p)
{
    const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(p, 1.0);
    return glm::dvec2(clip) / clip.w;
}

class Sdsm : public testing::TestWithParam<SdsmCase> {
protected:
    Sdsm()
    {
        options_.width = 320;
        options_.height = 200;
        options_.shadow.technique.partition = Partition::sdsm;
        options_.shadow.technique.fit = GetParam().fit;
        options_.shadow.technique.filter = Filter::pcf;
        options_.shadow.map_size = 256;
        options_.shadow.max_distance_m = GetParam().max_distance_m;
        options_.shadow.cascades.count = GetParam().count;
        options_.shadow.cascades.blend = GetParam().blend;
        options_.shadow.cascades.ends_m = GetParam().ends_m;
        reach_ = reachTexels(options_.shadow);
        options_.shadow.border_texels = double{reach_};
        fillObjectSet(state_, objects_);
        frame_.camera = cameraOf(eye_, options_.width, options_.height, state_.bounds_ws);
        frame_.size_px = {options_.width, options_.height};
        for (const ShadedLight& light : lights_) {
            casters_.push_back(light.caster);
        }
        frame_.lights = casters_;
        frame_.objects = &objects_;
    }

    /// Surfaces that receive shadow, are not beyond its reach and whose place on the base map is so far inside that its
    /// kernel is too.
    std::vector<Pixel> pixelsOf(const Picture& picture, const View& base) const
    {
        const glm::dmat4 world_from_clip = glm::inverse(frame_.camera.clip_from_world);
        const double inside = 1.0 - 2.0 * tileMarginTexels(double{reach_}) / base.place.tile.width;
        std::vector<Pixel> pixels;
        for (std::uint32_t y = 0; y < options_.height; ++y) {
            for (std::uint32_t x = 0; x < options_.width; ++x) {
                const std::uint32_t id = *picture.object_ids.pixel(x, y);
                if (id == 0 || !state_.objects[id - 1].receives) {
                    continue;
                }
                const glm::dvec4 h = world_from_clip * glm::dvec4((x + 0.5) / options_.width * 2.0 - 1.0,
                                                                  (y + 0.5) / options_.height * 2.0 - 1.0,
                                                                  double{*picture.depth.pixel(x, y)}, 1.0);
                const glm::dvec3 p = glm::dvec3(h) / h.w;
                const glm::dvec4 clip = base.projection.clip_from_world * glm::dvec4(p, 1.0);
                const double distance = glm::length(p - frame_.camera.eye_ws);
                const double reach = options_.shadow.max_distance_m > 0.0 ? options_.shadow.max_distance_m : 1e30;
                const bool served = clip.w > 0.0 && std::max(std::abs(clip.x), std::abs(clip.y)) <= inside * clip.w;
                if (served && distance <= reach) {
                    pixels.push_back({p, glm::dot(base.serves.slice.axis, glm::dvec4(p, 1.0))});
                }
            }
        }
        return pixels;
    }

    RenderOptions options_;
    scene::Scene scene_ = smallScene();
    scene::State state_ = scene::evaluate(scene_, 0.0);
    std::vector<ShadedLight> lights_ = lightsOf(scene_, state_);
    Eye eye_ = smallEye();
    ObjectSet objects_;
    std::vector<Light> casters_;
    Frame frame_;
    float reach_ = 0.0F;
};

/// Begin of slice i of the depths that are there.
double splitOf(const std::vector<Pixel>& pixels, const CascadeOptions& cascades, std::uint32_t i)
{
    if (cascades.explicitEnds()) {
        return i == 0 ? 0.0 : cascades.ends_m[i - 1];
    }
    const auto [least, greatest] = std::minmax_element(
        pixels.begin(), pixels.end(), [](const Pixel& a, const Pixel& b) { return a.depth_m < b.depth_m; });
    const shared::SplitRange range = shared::splitRange(least->depth_m, greatest->depth_m, cascades.lambda, true);
    return shared::splitAt(range, static_cast<int>(i), static_cast<int>(cascades.count));
}

// A depth is a quotient of single precision numbers, worked out in a dozen roundings.
constexpr double kRounding = 16 * 6e-8;

void expectSlices(std::span<const View> views, const std::vector<Pixel>& pixels, const CascadeOptions& cascades)
{
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        SCOPED_TRACE("cascade " + std::to_string(i));
        const ViewSlice& slice = views[i].serves.slice;
        const double begin_m = splitOf(pixels, cascades, i);
        const double end_m = splitOf(pixels, cascades, i + 1);
        const double blend_m =
            i == 0 ? 0.0 : shared::blendWidth(cascades.blend, splitOf(pixels, cascades, i - 1), begin_m);
        const double near_m = splitOf(pixels, cascades, i > 0 ? i - 1 : 0);
        // A power of the ratio of both ends adds its own: pow() is good to 16 units in Vulkan, of the exponent's share.
        const double rounding_m = 16 * kRounding * (end_m + near_m);
        if (i == 0) {
            EXPECT_TRUE(std::isinf(slice.begin_m));
            EXPECT_EQ(slice.blend_m, 0.0);
        } else {
            EXPECT_NEAR(slice.begin_m, begin_m - blend_m, rounding_m);
            EXPECT_NEAR(slice.blend_m, blend_m, rounding_m);
        }
        if (i + 1 == views.size()) {
            EXPECT_TRUE(std::isinf(slice.end_m));
        } else {
            EXPECT_NEAR(slice.end_m, end_m, rounding_m);
        }
    }
}

/// The rectangle of those in the slice, each end of which is moved outward by `pad` of a depth (inward below 0).
Rect rectOf(const View& base, const std::vector<Pixel>& pixels, const ViewSlice& slice, double pad)
{
    Rect rect;
    for (const Pixel& pixel : pixels) {
        const double more_m = pad * pixel.depth_m;
        if (pixel.depth_m >= slice.begin_m - more_m && pixel.depth_m <= slice.end_m + more_m) {
            rect.add(placeOn(base, pixel.point_ws));
        }
    }
    return rect;
}

/// How a view lies on its base map, told from both matrices.
struct Place {
    glm::dvec2 scale;
    glm::dvec2 centre;
};

Place placeOf(const View& view, const View& base)
{
    Place place{base.projection.texel_xy_m / view.projection.texel_xy_m, glm::dvec2(0.0)};
    const glm::dvec4 w = glm::row(base.projection.clip_from_world, 3);
    int column = 0;
    for (int i = 1; i < 4; ++i) {
        column = std::abs(w[i]) > std::abs(w[column]) ? i : column;
    }
    for (int axis = 0; axis < 2; ++axis) {
        const double own = view.projection.clip_from_world[column][axis] / place.scale[axis];
        place.centre[axis] = (base.projection.clip_from_world[column][axis] - own) / w[column];
    }
    return place;
}

/// Between the place for `least` and the one for `most`, up to what a place in single precision is off: a sum of four
/// products of numbers that are a few times as large, of a point that is off itself.
void expectPlace(const View& view, const View& base, double border_texels, const Rect& least, const Rect& most)
{
    constexpr double kPlaceRounding = 64 * 6e-8;
    const Place place = placeOf(view, base);
    const double widen = base.place.tile.width / (base.place.tile.width - 2.0 * border_texels);
    for (int axis = 0; axis < 2; ++axis) {
        if (most.empty()) {
            EXPECT_EQ(place.scale[axis], 1.0);
            EXPECT_EQ(place.centre[axis], 0.0);
            continue;
        }
        const double half = 1.0 / place.scale[axis];
        const double wanted_least = (least.high[axis] - least.low[axis]) * 0.5 * widen;
        const double wanted_most = (most.high[axis] - most.low[axis]) * 0.5 * widen;
        const double off = 2.0 * kPlaceRounding;
        if (wanted_most + off < 1.0 && wanted_least > shared::kFinestShare) {
            EXPECT_GE(half, wanted_least - off);
            EXPECT_LE(half, wanted_most + off);
            EXPECT_LE(place.centre[axis] - half / widen, least.low[axis] + off);
            EXPECT_GE(place.centre[axis] + half / widen, least.high[axis] - off);
        }
        EXPECT_LE(half, 1.0 + 1e-6) << "coarser than the base map";
    }
}

TEST_P(Sdsm, FitsEachCascadeToThePixelsThatAreThere)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu uploaded(gpu, scene_, state_);
    FrameRenderer renderer(uploaded, options_);
    renderer.draw(state_, eye_, lights_);
    const Picture picture = renderer.read({.colour = false, .masks = true, .geometry = true});
    const Plan base_plan = Planner(options_.shadow).plan(frame_);
    const Plan& plan = renderer.plan();
    ASSERT_EQ(plan.views.size(), base_plan.views.size());
    ASSERT_EQ(plan.lights.size(), 2U);
    for (const LightPlan& light : plan.lights) {
        SCOPED_TRACE("light " + std::to_string(&light - plan.lights.data()));
        ASSERT_EQ(light.view_count, GetParam().count);
        const std::span views = std::span(plan.views).subspan(light.first_view, light.view_count);
        const View& base = base_plan.views[light.first_view];
        const std::vector<Pixel> pixels = pixelsOf(picture, base);
        ASSERT_GT(pixels.size(), 5000U);
        expectSlices(views, pixels, options_.shadow.cascades);
        bool finer = false;
        for (const View& view : views) {
            SCOPED_TRACE("cascade " + std::to_string(view.projection.gpu_cascade));
            EXPECT_EQ(view.projection.metric.metric_ws, base.projection.metric.metric_ws);
            EXPECT_EQ(view.casters.count, base.casters.count);
            const double pad = double{shared::kDepthRounding};
            expectPlace(view, base, *options_.shadow.border_texels, rectOf(base, pixels, view.serves.slice, -pad),
                        rectOf(base, pixels, view.serves.slice, 3.0 * pad));
            finer = finer || view.projection.texel_xy_m.x * view.projection.texel_xy_m.y <
                                 0.7 * base.projection.texel_xy_m.x * base.projection.texel_xy_m.y;
            EXPECT_LE(view.projection.texel_m, base.projection.texel_m * (1.0 + 1e-6));
        }
        EXPECT_TRUE(finer || light.view_count == 1) << "no cascade's texel is smaller than that of one map";
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

// With single precision on its way from buffer to map, an edge may be off by what a texel of the finest map allowed is
// rounded to; the border has half a texel more than the kernel reaches.
TEST_P(Sdsm, HoldsEveryPixelWithItsKernelInEachCascadeThatServesIt)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu uploaded(gpu, scene_, state_);
    FrameRenderer renderer(uploaded, options_);
    renderer.draw(state_, eye_, lights_);
    const Picture picture = renderer.read({.colour = false, .geometry = true});
    const Plan base_plan = Planner(options_.shadow).plan(frame_);
    const Plan& plan = renderer.plan();
    const double margin = tileMarginTexels(double{reach_});
    for (const LightPlan& light : plan.lights) {
        std::size_t outside = 0;
        std::size_t unserved = 0;
        for (const Pixel& pixel : pixelsOf(picture, base_plan.views[light.first_view])) {
            bool served = false;
            for (std::uint32_t i = light.first_view; i < light.first_view + light.view_count; ++i) {
                const View& view = plan.views[i];
                if (!view.serves.slice.holds(pixel.point_ws)) {
                    continue;
                }
                const glm::dvec2 texel = (placeOn(view, pixel.point_ws) * 0.5 + 0.5) * double(view.place.tile.width);
                const bool inside = std::min(texel.x, texel.y) >= margin &&
                                    std::max(texel.x, texel.y) <= view.place.tile.width - margin;
                outside += inside ? 0 : 1;
                served = served || inside;
            }
            unserved += served ? 0 : 1;
        }
        EXPECT_EQ(outside, 0U);
        EXPECT_EQ(unserved, 0U);
    }
}

/// Expects that a view without its border lies between the need of its pixels and that with `most` around it.
void expectRoom(const View& view, const View& base, double border_texels, const Rect& seen, const glm::dvec2& most)
{
    constexpr double kOff = 1e-4; // pixels at the ends of slices, and what places are rounded by
    const Place place = placeOf(view, base);
    const glm::dvec2 half =
        1.0 / (place.scale * (base.place.tile.width / (base.place.tile.width - 2.0 * border_texels)));
    for (int axis = 0; axis < 2; ++axis) {
        if (place.scale[axis] > 1.0) { // else it is the base map
            EXPECT_LE(place.centre[axis] - half[axis], seen.low[axis] + kOff);
            EXPECT_GE(place.centre[axis] + half[axis], seen.high[axis] - kOff);
            EXPECT_LE(2.0 * half[axis], seen.high[axis] - seen.low[axis] + 2.0 * most[axis] + kOff);
        }
    }
}

// The base map has room for as much of itself, which would be most of a small rectangle of it.
TEST_P(Sdsm, GivesRaysRoomButNoMoreThanAQuarterOfWhatIsSeen)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu uploaded(gpu, scene_, state_);
    options_.shadow.technique.filter = Filter::raymarch;
    casters_[0].angular_diameter_rad = lights_[0].caster.angular_diameter_rad = 0.2;
    FrameRenderer renderer(uploaded, options_);
    renderer.draw(state_, eye_, lights_);
    const Picture picture = renderer.read({.colour = false, .geometry = true});
    const Plan base_plan = Planner(options_.shadow).plan(frame_);
    const LightPlan& light = renderer.plan().lights[0];
    const View& base = base_plan.views[light.first_view];
    ASSERT_GT(base.projection.light_reach, 0.0);
    const std::vector<Pixel> pixels = pixelsOf(picture, base);
    const double pad = double{shared::kDepthRounding};
    for (std::uint32_t i = light.first_view; i < light.first_view + light.view_count; ++i) {
        SCOPED_TRACE("cascade " + std::to_string(i));
        const View& view = renderer.plan().views[i];
        const Rect seen = rectOf(base, pixels, view.serves.slice, -pad);
        if (!seen.empty()) {
            const glm::dvec2 size_texels = (seen.high - seen.low) * base.fit.finest_texel;
            const glm::dvec2 most = 0.25 * std::max(size_texels.x, size_texels.y) / base.fit.finest_texel;
            expectRoom(view, base, *options_.shadow.border_texels, seen, most);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Sdsm,
                         testing::Values(SdsmCase{"uniform", Fit::uniform}, SdsmCase{"lispsm", Fit::lispsm},
                                         SdsmCase{"tsm", Fit::tsm}, SdsmCase{"one", Fit::uniform, 1, 0.0, 0.0},
                                         SdsmCase{"six_with_a_limit", Fit::uniform, 6, 12.0, 0.0},
                                         SdsmCase{"wide_blend", Fit::lispsm, 3, 0.0, 0.5},
                                         SdsmCase{"given_ends", Fit::uniform, 3, 0.0, 0.2, {8.0, 11.0}}),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
} // namespace gnomon::host::test
