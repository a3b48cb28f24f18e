// SPDX-License-Identifier: Apache-2.0
// A box's hard shadow on the ground of `planes`, against geometry: where the picture and the exact answer differ, the
// exact edge is at most one map texel away. Whatever the fit, the partition and the motion; and what fades with
// distance does so as told.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "worlds/planes.h"
#include "worlds/worlds.h"

#include <gnomon/plan_views.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

namespace gnomon::host::test {
namespace {

using worlds::PlanesWorld;

// Does the box stop the segment from `p` to the light (or the whole ray towards a sun)?
bool shadowedExactly(const Light& light, const glm::dvec3& p)
{
    const bool sun = light.type == LightType::directional;
    const glm::dvec3 ray = sun ? -light.direction_ws : light.position_ws - p;
    double enter = 0.0;
    double leave = sun ? 1e9 : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = double{PlanesWorld::box_min[axis]} - p[axis];
        const double high = double{PlanesWorld::box_max[axis]} - p[axis];
        if (ray[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) {
                return false;
            }
            continue;
        }
        enter = std::max(enter, std::min(low / ray[axis], high / ray[axis]));
        leave = std::min(leave, std::max(low / ray[axis], high / ray[axis]));
    }
    return enter < leave;
}

glm::dvec2 texelOf(const View& view, const glm::dvec3& p)
{
    const glm::dvec2 place = placeOnMap(view, p).value_or(glm::dvec2(-1.0));
    return (place * 0.5 + 0.5) * glm::dvec2(view.place.tile.width, view.place.tile.height);
}

// The exact answers met within one texel of `p`, along the ground: bit 0 lit, bit 1 shadowed.
unsigned answersWithinOneTexel(const View& view, const Light& light, const glm::dvec3& p)
{
    constexpr double kStep_m = 1e-4;
    const glm::dvec2 here = texelOf(view, p);
    const glm::dvec2 along_x = (texelOf(view, p + glm::dvec3(kStep_m, 0.0, 0.0)) - here) / kStep_m;
    const glm::dvec2 along_z = (texelOf(view, p + glm::dvec3(0.0, 0.0, kStep_m)) - here) / kStep_m;
    const double det = along_x.x * along_z.y - along_x.y * along_z.x;
    unsigned met = shadowedExactly(light, p) ? 2U : 1U;
    for (int i = 0; i < 32; ++i) {
        const double angle = i * 0.19634954084936207; // a 32nd of a turn
        const glm::dvec2 d(std::cos(angle), std::sin(angle));
        const glm::dvec3 move((d.x * along_z.y - d.y * along_z.x) / det, 0.0,
                              (along_x.x * d.y - along_x.y * d.x) / det);
        for (const double radius : {0.5, 1.0}) {
            met |= shadowedExactly(light, p + move * radius) ? 2U : 1U;
        }
    }
    return met;
}

struct Tally {
    int lit = 0;
    int shadowed = 0;
    int beside_the_edge = 0; // not what geometry says, but within a texel of where it says so
    int wrong = 0;
};

/// The light's views that serve a point: two where one fades over into the next.
std::vector<const View*> viewsAt(const Plan& plan, const LightPlan& light, const glm::dvec3& p)
{
    std::vector<const View*> found;
    for (std::uint32_t i = light.first_view; i < light.first_view + light.view_count; ++i) {
        const View& view = plan.views[i];
        const glm::dvec2 texel = texelOf(view, p);
        if (view.serves.slice.holds(p) && view.serves.sector.holds(p) && std::min(texel.x, texel.y) >= 2.0 &&
            texel.x <= view.place.tile.width - 2.0 && texel.y <= view.place.tile.height - 2.0) {
            found.push_back(&view);
        }
    }
    return found;
}

// Tells how the mask of light `index` compares with geometry on the ground.
Tally tallyGround(const Picture& picture, const glm::dmat4& world_from_clip, const Plan& plan, const Light& light,
                  std::size_t index)
{
    Tally tally;
    const ImageF& mask = picture.masks[index];
    for (std::uint32_t y = 0; y < mask.height; ++y) {
        for (std::uint32_t x = 0; x < mask.width; ++x) {
            const double depth = *picture.depth.pixel(x, y);
            const glm::dvec4 h = world_from_clip * glm::dvec4((x + 0.5) / mask.width * 2.0 - 1.0,
                                                              (y + 0.5) / mask.height * 2.0 - 1.0, depth, 1.0);
            const glm::dvec3 p = glm::dvec3(h) / h.w;
            if (depth == 0.0 || std::abs(p.y - double{PlanesWorld::ground_y}) > 1e-3) {
                continue;
            }
            const std::vector<const View*> views = viewsAt(plan, plan.lights[index], p);
            if (views.empty()) {
                continue; // outside the cone: no map there
            }
            const float v = *mask.pixel(x, y);
            const unsigned said = v > 0.5F ? 1U : 2U;
            (said == 1U ? tally.lit : tally.shadowed)++;
            const bool agrees = (said == 2U) == shadowedExactly(light, p);
            if (!agrees) {
                const bool beside = std::any_of(views.begin(), views.end(), [&](const View* view) {
                    return (answersWithinOneTexel(*view, light, p) & said) != 0U;
                });
                (beside ? tally.beside_the_edge : tally.wrong)++;
            }
        }
    }
    return tally;
}

struct EdgeCase {
    const char* name;
    std::uint32_t map_size;
    Technique technique;
    std::uint32_t views; // of each light: slices that hold something
};
std::ostream& operator<<(std::ostream& out, const EdgeCase& edge)
{
    return out << edge.name;
}

/// Points instead. Both have edges of their cube in the box's shadow.
void shineAllAround(std::vector<ShadedLight>& lights)
{
    constexpr std::array<glm::dvec3, 2> kPlaces{{{-3.5, 4.5, 0.3}, {2.0, 5.0, -1.5}}};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].caster.type = LightType::point;
        lights[i].caster.position_ws = kPlaces[i];
        lights[i].caster.range_m = 0.0;
    }
}

/// Each triangle in four, so often.
void divideTriangles(scene::Scene& scene, int times)
{
    for (scene::Mesh& mesh : scene.meshes) {
        for (scene::Primitive& part : mesh.primitives) {
            for (int i = 0; i < times; ++i) {
                scene::Primitive finer = part;
                const auto middle = [&](std::uint32_t a, std::uint32_t b) {
                    const auto index = static_cast<std::uint32_t>(finer.positions.size());
                    const auto add = [&](auto& values) {
                        if (!values.empty()) {
                            const auto one = values[a];
                            const auto other = values[b];
                            values.push_back(one);
                            values.back() += (other - one) * 0.5F;
                        }
                    };
                    add(finer.positions);
                    add(finer.normals); // of flat faces, as are the next
                    add(finer.tangents);
                    add(finer.uv0);
                    add(finer.uv1);
                    add(finer.colours);
                    if (!finer.creased.empty()) {
                        finer.creased.push_back(finer.creased[a]);
                    }
                    return index;
                };
                finer.indices.clear();
                for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3) {
                    const std::uint32_t a = part.indices[t];
                    const std::uint32_t b = part.indices[t + 1];
                    const std::uint32_t c = part.indices[t + 2];
                    const std::uint32_t ab = middle(a, b);
                    const std::uint32_t bc = middle(b, c);
                    const std::uint32_t ca = middle(c, a);
                    finer.indices.insert(finer.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
                }
                part = finer;
            }
        }
    }
}

class PlanesEdge : public testing::TestWithParam<EdgeCase> {};

TEST_P(PlanesEdge, LiesWithinOneTexelOfWhereGeometryPutsIt)
{
    scene::Scene scene = worlds::load("planes", 1);
    const bool paraboloid = GetParam().technique.partition == Partition::paraboloid;
    if (paraboloid) {
        divideTriangles(scene, 4); // a straight edge of 2 m would be seven texels off
    }
    const scene::State state = scene::evaluate(scene, 0.0);
    std::vector<ShadedLight> lights = lightsOf(scene, state);
    const bool cube = GetParam().technique.partition == Partition::cube;
    const bool multi = GetParam().technique.partition == Partition::multi;
    if (cube || multi || paraboloid) {
        shineAllAround(lights);
    }
    RenderOptions options;
    options.width = 480;
    options.height = 360;
    options.shadow.map_size = GetParam().map_size;
    options.shadow.technique.filter = Filter::hard;
    options.shadow.technique = GetParam().technique;
    Gpu gpu({.gpu = "software", .validate = true});
    const bool plain = GetParam().technique.fit == Fit::uniform && GetParam().views == 1;
    // From above, as strategy games have it; or at a slant, so that warps and slices have something to do.
    const Eye above{.position_ws = {1.0, 14.0, 9.0}, .target_ws = {0.8, 0.0, 0.0}, .fov_y_rad = 0.7};
    const Eye aslant{.position_ws = {1.5, 4.5, 9.0}, .target_ws = {0.8, 0.0, 0.0}, .fov_y_rad = 0.7};
    const Eye eye = plain ? above : aslant;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    renderer.draw(state, eye, lights);
    const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = true});
    const Camera camera = cameraOf(eye, options.width, options.height, state.bounds_ws);
    const glm::dmat4 world_from_clip = glm::inverse(camera.clip_from_world);
    ASSERT_EQ(lights.size(), 2U);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        SCOPED_TRACE(lights[i].name);
        const LightPlan& plan = renderer.plan().lights[i];
        if (multi) { // divides as it sees fit
            ASSERT_GT(plan.view_count, 0U);
        } else { // the second lamp shines on the box's top, too
            ASSERT_EQ(plan.view_count, GetParam().views + (cube ? i : 0));
        }
        const auto views = std::span(renderer.plan().views).subspan(plan.first_view, plan.view_count);
        const bool warps = GetParam().technique.fit != Fit::uniform && GetParam().technique.motion == Motion::free;
        EXPECT_EQ(std::ranges::any_of(views, [](const View& view) { return view.fit.strength > 1.0; }), warps)
            << plan.outcome.reason;
        const Tally tally = tallyGround(picture, world_from_clip, renderer.plan(), lights[i].caster, i);
        EXPECT_GT(tally.lit, 10000);
        EXPECT_GT(tally.shadowed, 1000);
        EXPECT_EQ(tally.wrong, 0);
        RecordProperty(lights[i].name + "_beside_the_edge", tally.beside_the_edge);
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

constexpr Technique of(Fit fit, Partition partition = Partition::single, Motion motion = Motion::free)
{
    return {.partition = partition, .fit = fit, .motion = motion};
}

INSTANTIATE_TEST_SUITE_P(
    All, PlanesEdge,
    testing::Values(EdgeCase{"map_128", 128, kPlainTechnique, 1}, EdgeCase{"map_256", 256, kPlainTechnique, 1},
                    EdgeCase{"map_1024", 1024, kPlainTechnique, 1}, EdgeCase{"lispsm", 256, of(Fit::lispsm), 1},
                    EdgeCase{"tsm", 256, of(Fit::tsm), 1}, EdgeCase{"lispsm_simple", 256, of(Fit::lispsm_simple), 1},
                    EdgeCase{"psm", 256, of(Fit::psm), 1},
                    EdgeCase{"cube", 256, {Partition::cube, Fit::uniform, Filter::hard}, 4},
                    EdgeCase{"cube_pcf", 256, {Partition::cube, Fit::uniform, Filter::pcf}, 4},
                    EdgeCase{"cube_lispsm", 256, {Partition::cube, Fit::lispsm, Filter::hard}, 4},
                    EdgeCase{"paraboloid", 256, {Partition::paraboloid, Fit::uniform, Filter::hard}, 1},
                    EdgeCase{"paraboloid_pcf", 256, {Partition::paraboloid, Fit::uniform, Filter::pcf}, 1},
                    EdgeCase{"multi", 256, {Partition::multi, Fit::uniform, Filter::hard}, 0},
                    EdgeCase{"multi_pcf", 256, {Partition::multi, Fit::uniform, Filter::pcf}, 0},
                    EdgeCase{"multi_lispsm", 256, {Partition::multi, Fit::lispsm, Filter::hard}, 0},
                    EdgeCase{"cascades", 128, of(Fit::uniform, Partition::cascades), 4},
                    EdgeCase{"cascades_tsm", 128, of(Fit::tsm, Partition::cascades), 4},
                    EdgeCase{"sdsm", 128, of(Fit::uniform, Partition::sdsm), 4},
                    EdgeCase{"sdsm_lispsm", 128, of(Fit::lispsm, Partition::sdsm), 4},
                    EdgeCase{"sdsm_tsm", 128, of(Fit::tsm, Partition::sdsm), 4},
                    EdgeCase{"snap", 256, of(Fit::uniform, Partition::single, Motion::snap), 1},
                    EdgeCase{"cascades_snap", 128, of(Fit::uniform, Partition::cascades, Motion::snap), 3}),
    [](const auto& edge) { return edge.param.name; });

// The fault that its page names: edges are straight from vertex to vertex, where the map has them bent.
TEST(EdgesOfAParaboloid, AreOffWhereTrianglesAreLarge)
{
    RenderOptions options;
    options.width = 480;
    options.height = 360;
    options.shadow.map_size = 256;
    options.shadow.technique = {.partition = Partition::paraboloid, .fit = Fit::uniform, .filter = Filter::hard};
    const Eye eye{.position_ws = {1.0, 14.0, 9.0}, .target_ws = {0.8, 0.0, 0.0}, .fov_y_rad = 0.7};
    std::array<int, 2> wrong{};
    for (const int times : {0, 4}) {
        scene::Scene scene = worlds::load("planes", 1);
        divideTriangles(scene, times);
        const scene::State state = scene::evaluate(scene, 0.0);
        std::vector<ShadedLight> lights = lightsOf(scene, state);
        shineAllAround(lights);
        Gpu gpu({.gpu = "software", .validate = true});
        const SceneOnGpu uploaded(gpu, scene, state);
        FrameRenderer renderer(uploaded, options);
        renderer.draw(state, eye, lights);
        const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = true});
        const Camera camera = cameraOf(eye, options.width, options.height, state.bounds_ws);
        const Tally tally =
            tallyGround(picture, glm::inverse(camera.clip_from_world), renderer.plan(), lights[1].caster, 1);
        wrong[times == 0 ? 0 : 1] = tally.wrong;
        EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
    }
    RecordProperty("wrong_pixels_of_a_box", wrong[0]);
    EXPECT_GT(wrong[0], 100);
    EXPECT_EQ(wrong[1], 0);
}

// Such a map's range of depth is that of a plane across its axis: next to nothing, beside which all rounding is large.
TEST(FlatFloor, AloneInAFaceOfALampsCubeIsLit)
{
    const scene::Scene scene = worlds::load("planes", 1);
    const scene::State state = scene::evaluate(scene, 0.0);
    std::vector<ShadedLight> lights = lightsOf(scene, state);
    lights.resize(1);
    lights[0].caster.type = LightType::point;
    lights[0].caster.position_ws = {2.4, 1.2, 1.8}; // below the box, which is in no face with the floor beneath
    lights[0].caster.radius_m = 0.1;
    RenderOptions options;
    options.width = 240;
    options.height = 180;
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu uploaded(gpu, scene, state);
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch}) {
        options.shadow.technique = {.partition = Partition::cube, .fit = Fit::uniform, .filter = filter};
        FrameRenderer renderer(uploaded, options);
        renderer.draw(state, {.position_ws = {2.4, 4.0, 4.0}, .target_ws = {2.4, 0.0, 1.8}, .fov_y_rad = 0.4}, lights);
        const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false});
        EXPECT_EQ(*std::ranges::min_element(picture.masks[0].values), 1.0F) << nameOf(filter);
    }
}

// In the middle of the box's shadow, as the eye draws back: dark, then (d - begin) / (end - begin), then lit.
TEST(Fade, IsLinearInTheDistanceFromTheEye)
{
    const scene::Scene scene = worlds::load("planes", 1);
    const scene::State state = scene::evaluate(scene, 0.0);
    std::vector<ShadedLight> lights = lightsOf(scene, state);
    lights.resize(1);
    RenderOptions options;
    options.width = 33;
    options.height = 33;
    options.shadow.map_size = 256;
    options.shadow.max_distance_m = 20.0;
    options.shadow.fade = 0.25;
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    const glm::vec3 middle = (PlanesWorld::box_min + PlanesWorld::box_max) * 0.5F;
    const glm::dvec3 target = PlanesWorld::projectAlongSun({middle.x, PlanesWorld::box_min.y, middle.z});
    for (const double distance : {8.0, 14.9, 16.0, 17.5, 19.0, 20.1, 30.0}) {
        const glm::dvec3 eye = target + glm::dvec3(0.6, 0.64, 0.48) * distance;
        renderer.draw(state, {.position_ws = glm::vec3(eye), .target_ws = glm::vec3(target), .fov_y_rad = 0.01},
                      lights);
        const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false});
        const double expected = std::clamp((distance - 15.0) / 5.0, 0.0, 1.0);
        EXPECT_NEAR(*picture.masks[0].pixel(16, 16), expected, 1.5 / 255.0) << distance << " m";
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

} // namespace
} // namespace gnomon::host::test
