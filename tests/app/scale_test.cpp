// SPDX-License-Identifier: Apache-2.0
// A world scaled by a power of two has the same shadows, from one end of the range that gnomon/world_range.h states to
// the other, and nearly the same by any other factor and away from the origin.
#include "app/shot.h"
#include "app/visual.h"
#include "truth_run.h"

#include <gnomon/world_range.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

struct WorldChange {
    double scale = 1.0;
    glm::dvec3 offset{0.0}; // metres, after scaling
};

glm::vec3 movedBy(const glm::vec3& place, const WorldChange& change)
{
    return {glm::dvec3(place) * change.scale + change.offset};
}

Aabb movedBy(const Aabb& box, const WorldChange& change)
{
    return box.empty() ? box : Aabb{movedBy(box.min, change), movedBy(box.max, change)};
}

/// Everything in metres, as if all nodes hung under one that is scaled and moved.
void applyTo(const WorldChange& change, app::Shot& shot)
{
    const auto scale = static_cast<float>(change.scale);
    scene::State& state = shot.state;
    for (scene::Object& object : state.objects) {
        glm::mat4& m = object.world_from_object;
        const glm::vec3 place = movedBy(glm::vec3(m[3]), change);
        m = glm::mat4(m[0] * scale, m[1] * scale, m[2] * scale, glm::vec4(place, 1.0F));
        object.bounds_ws = movedBy(object.bounds_ws, change);
    }
    state.bounds_ws = movedBy(state.bounds_ws, change);
    state.static_bounds_ws = movedBy(state.static_bounds_ws, change);
    shot.eye.position_ws = shot.eye.position_ws * change.scale + change.offset;
    shot.eye.target_ws = shot.eye.target_ws * change.scale + change.offset;
    shot.eye.near_m *= change.scale;
    shot.eye.far_m *= change.scale;
    for (host::ShadedLight& light : shot.lights) {
        Light& caster = light.caster;
        caster.position_ws = caster.position_ws * change.scale + change.offset;
        caster.range_m *= change.scale;
        caster.near_m *= change.scale;
        caster.radius_m *= change.scale;
    }
}

/// And the lengths among the options.
void applyTo(const WorldChange& change, ShadowOptions& options)
{
    options.bias.constant_m *= static_cast<float>(change.scale);
    options.max_distance_m *= change.scale;
    for (double& end_m : options.cascades.ends_m) {
        end_m *= change.scale;
    }
}

struct ScaledTechnique {
    const char* name;
    Filter filter;
    Partition partition;
    Motion motion = Motion::free;
    double max_distance_m = 0.0;
};
constexpr ScaledTechnique kScaledTechniques[]{{"hard", Filter::hard, Partition::single},
                                              {"pcf in cascades", Filter::pcf, Partition::cascades, Motion::snap},
                                              {"evsm up to 20 m", Filter::evsm, Partition::single, Motion::free, 20.0},
                                              {"vsm by sdsm", Filter::vsm, Partition::sdsm}};

app::Settings settingsToScale(const std::string& world, const std::string& camera)
{
    app::Settings settings = app::defaultSettings();
    settings.subcommand = app::kRender;
    settings.scene = world;
    settings.camera = camera;
    settings.size_px = {64, 36};
    settings.truth = truth::Kind::area;
    settings.samples = 16;
    settings.no_cache = true;
    settings.shadow.map_size = 256;
    settings.light_size_m = 0.3;
    return settings;
}

/// The share of pixels that differ by more than a step of 8 bits.
double shareBeyond(const ImageF& image, const ImageF& expected)
{
    EXPECT_EQ(image.values.size(), expected.values.size());
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < image.values.size() && i < expected.values.size(); ++i) {
        beyond += std::abs(image.values[i] - expected.values[i]) <= 1.0F / 255.0F ? 0 : 1; // NaN is beyond
    }
    return static_cast<double>(beyond) / static_cast<double>(expected.values.size());
}

bool showsShadow(const ImageF& mask)
{
    return std::ranges::count_if(mask.values, [](float v) { return v < 0.25F; }) > 20 &&
           std::ranges::count_if(mask.values, [](float v) { return v > 0.75F; }) > 20;
}

struct Pictures {
    std::vector<ImageF> truths;             // of each light
    std::vector<std::vector<ImageF>> masks; // of each technique, of each light
};

/// A built-in world, and what it looks like as it is.
class ScaledWorld {
public:
    ScaledWorld(const std::string& name, const std::string& camera)
        : settings_(settingsToScale(name, camera)), gpu_(app::openGpu(settings_)), shot_(app::makeShot(settings_)),
          plain_(picturesOf(WorldChange{}))
    {
        EXPECT_TRUE(showsShadow(plain_.truths.front()));
        for (const std::vector<ImageF>& masks : plain_.masks) {
            EXPECT_TRUE(showsShadow(masks.front()));
        }
    }

    [[nodiscard]] Aabb bounds() const { return shot_.state.bounds_ws; }

    void expectSame(const WorldChange& change, double truth_share, double mask_share) const
    {
        SCOPED_TRACE("scaled by " + std::to_string(std::log2(change.scale)) + " octaves, moved by " +
                     std::to_string(glm::length(change.offset)) + " m");
        const Pictures found = picturesOf(change);
        for (std::size_t light = 0; light < found.truths.size(); ++light) {
            SCOPED_TRACE("light " + shot_.lights[light].name);
            EXPECT_LE(shareBeyond(found.truths[light], plain_.truths[light]), truth_share);
            for (std::size_t i = 0; i < found.masks.size(); ++i) {
                EXPECT_LE(shareBeyond(found.masks[i][light], plain_.masks[i][light]), mask_share)
                    << kScaledTechniques[i].name;
            }
        }
    }

private:
    [[nodiscard]] Pictures picturesOf(const WorldChange& change) const
    {
        app::Shot shot = shot_;
        applyTo(change, shot);
        Pictures pictures;
        app::TruthTracer tracer(shot, settings_);
        for (std::size_t light = 0; light < shot.lights.size(); ++light) {
            app::TruthRun run = tracer.trace(light);
            pictures.truths.push_back(std::move(run.traced.visibility.visibility));
            tracer.takeBack(std::move(run.traced.surfaces));
        }
        const host::SceneOnGpu scene(*gpu_, shot.scene, shot.state);
        for (const ScaledTechnique& technique : kScaledTechniques) {
            app::Settings settings = settings_;
            settings.shadow.technique.filter = technique.filter;
            settings.shadow.technique.partition = technique.partition;
            settings.shadow.technique.motion = technique.motion;
            settings.shadow.max_distance_m = technique.max_distance_m;
            applyTo(change, settings.shadow);
            host::FrameRenderer renderer(scene, app::renderOptions(settings));
            renderer.draw(shot.state, shot.eye, shot.lights);
            pictures.masks.push_back(renderer.read({.colour = false, .masks = true, .geometry = false}).masks);
        }
        return pictures;
    }

    app::Settings settings_;
    std::unique_ptr<host::Gpu> gpu_;
    app::Shot shot_;
    Pictures plain_;
};

/// The largest power of two that keeps a world within the range, and the smallest.
std::pair<double, double> endsOf(const Aabb& bounds)
{
    const glm::dvec3 edges(bounds.extent());
    const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(bounds.min)), glm::abs(glm::dvec3(bounds.max)));
    const double smallest = kSmallestScene_m / std::max({edges.x, edges.y, edges.z});
    const double largest = 0.25 * kFarthestPlace_m / std::max({reach.x, reach.y, reach.z}); // the eye is farther out
    return {std::exp2(std::ceil(std::log2(smallest))), std::exp2(std::floor(std::log2(largest)))};
}

TEST(Scale, PowersOfTwoChangeNothing)
{
    const ScaledWorld planes("planes", "top");
    const auto [smallest, largest] = endsOf(planes.bounds());
    for (const double scale : {smallest, 0x1p-20, 0x1p-7, 0x1p20, largest}) {
        planes.expectSame({scale}, 0.0, 0.0);
    }
}

TEST(Scale, PowersOfTwoChangeNothingInALargeWorld)
{
    const ScaledWorld rts("rts", "camp");
    const auto [smallest, largest] = endsOf(rts.bounds());
    for (const double scale : {smallest, 0x1p20, largest}) {
        rts.expectSame({scale}, 0.0, 0.0);
    }
}

// A map that moves in texels has sizes that are steps below a power of two, and places that are multiples of a texel
// from the world's origin. So here its texels lie otherwise, and what is on an edge of a shadow falls to the other side
// of it.
constexpr double kEdgesOfTruths = 0.001;
constexpr double kEdgesOfMasks = 0.01;

TEST(Scale, OtherFactorsMoveEdgesAlone)
{
    const ScaledWorld planes("planes", "top");
    for (const double scale : {1e-6, 0.3, 1e6}) {
        planes.expectSame({scale}, kEdgesOfTruths, kEdgesOfMasks);
    }
}

TEST(Scale, PlacesAwayFromTheOriginMoveEdgesAlone)
{
    const ScaledWorld planes("planes", "top");
    for (const double away_m : {1e3, 1e5}) {
        planes.expectSame({1.0, {away_m, 0.0, -0.5 * away_m}}, kEdgesOfTruths, kEdgesOfMasks);
    }
}

} // namespace
} // namespace gnomon
