// SPDX-License-Identifier: Apache-2.0
// Memory that runs out while the truth is traced or kept: it is the same truth, or none.
#include "memory_sweep.h"
#include "scene_geometry.h"
#include "tests/image/folder.h"
#include "tests/truth/support.h"

#include "truth/cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::truth::test {
namespace {

using gnomon::test::FailingAllocation;
using gnomon::test::sweepMemory;

constexpr glm::uvec2 kSize(40, 40); // several tiles, for several threads

/// A cube and a ball, of which one is seen only, over a ground with holes in it.
scene::Scene smallScene()
{
    scene::Scene scene;
    scene.images.push_back({"holes", 2, 2, {0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255}});
    scene.textures.push_back({.image = 0});
    scene::Material material;
    material.alpha_mode = scene::AlphaMode::mask;
    material.base_colour_texture.texture = 0;
    scene.materials.push_back(material);
    place(scene, addQuad(scene, level(0.0F, 4.0F), 0));
    const std::uint32_t cube = addCube(scene);
    place(scene, cube);
    place(scene, cube).matrix[3].x = 3.0F;
    place(scene, addBall(scene, 4)).matrix[3].y = 2.0F;
    scene.nodes.back().casts = false;
    scene::finishScene(scene);
    return scene;
}

const View kView = lookAt({6.5, 5.0, 9.5}, {0.6, 1.0, 0.0}, 0.75, kSize);
const Light kSun = sun({3.0, -4.0, 0.5}, 0.1);

using Seen = std::pair<Surfaces, Visibility>;

Seen traceAll(const scene::Scene& scene, const scene::State& state, const Options& options)
{
    const Tracer tracer(scene, state, options);
    Surfaces surfaces = tracer.see(kView, options).value();
    Visibility visibility = tracer.trace(surfaces, kView, kSun, options).value();
    return {std::move(surfaces), std::move(visibility)};
}

bool same(const Seen& a, const Seen& b)
{
    return a.first.object_ids.values == b.first.object_ids.values && a.first.points.values == b.first.points.values &&
           a.first.normals.values == b.first.normals.values && a.second.rays == b.second.rays &&
           a.second.visibility.values == b.second.visibility.values &&
           a.second.standard_error.values == b.second.standard_error.values &&
           a.second.first_blocker_m.values == b.second.first_blocker_m.values;
}

void sweepTracing(std::uint32_t threads, FailingAllocation::Of whose, std::uint64_t most)
{
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    const Options options = area(16, threads);
    const Seen expected = traceAll(scene, state, options);
    std::optional<Seen> seen;
    sweepMemory(
        // The system keeps what a thread had for the next: each trace has one that watches it.
        {"tracing by " + std::to_string(threads), most, whose, true},
        [&] { seen.emplace(traceAll(scene, state, options)); },
        [&](bool ended) {
            EXPECT_EQ(seen.has_value(), ended);
            EXPECT_TRUE(!seen || same(*seen, expected));
            seen.reset();
        });
    EXPECT_TRUE(same(traceAll(scene, state, options), expected));
}

TEST(TruthMemory, OneThreadTracesTheSameOrNothing)
{
    sweepTracing(1, FailingAllocation::Of::this_thread, 200);
}

// Instances are made of scenes of more triangles than this one has; they are asked for here.
TEST(TruthMemory, InstancesAreBuiltOrNot)
{
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    const Options options = area(16, 1);
    std::optional<SceneGeometry> geometry;
    sweepMemory(
        {"building instances"}, [&] { geometry.emplace(scene, state, 0, options); },
        [&](bool ended) {
            ASSERT_EQ(geometry.has_value(), ended);
            EXPECT_TRUE(!ended || (geometry->part(1).instanced && geometry->triangle(3, 0)));
            geometry.reset();
        });
}

TEST(TruthMemory, AnEntryIsStoredOrNotAndNothingIsThrown)
{
    const gnomon::test::Folder folder;
    const Cache cache(folder / "cache");
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    const Options options = area(16, 1);
    auto [surfaces, visibility] = traceAll(scene, state, options);
    const truth::Traced traced{std::move(surfaces), std::move(visibility)};
    const scene::Hash128 key = keyOf(scene, state, kView, kSun, options);
    const std::vector<std::string> entry{scene::toString(key) + ".truth"};
    bool stored = false;
    std::string why;
    sweepMemory(
        {"storing a truth"}, [&] { stored = cache.store(key, traced, &why); },
        [&](bool ended) {
            EXPECT_TRUE(ended);
            EXPECT_EQ(stored, why.empty());
            std::vector<std::string> names;
            for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
                for (const auto& one : std::filesystem::directory_iterator(file)) {
                    names.push_back(one.path().filename().string());
                }
            }
            EXPECT_EQ(names, stored ? entry : std::vector<std::string>{});
            why = {};
            std::filesystem::remove_all(folder / "cache");
        });
    ASSERT_TRUE(cache.store(key, traced));
    std::optional<truth::Traced> loaded;
    sweepMemory(
        {"loading a truth"}, [&] { loaded = cache.load(keyOf(scene, state, kView, kSun, options), kSize, Kind::area); },
        [&](bool) {
            EXPECT_TRUE(!loaded || loaded->visibility.visibility.values == traced.visibility.visibility.values);
            loaded.reset();
            EXPECT_TRUE(cache.load(key, kSize, Kind::area));
        });
}

TEST(TruthMemory, ThreadsTraceTheSameOrNothing)
{
    sweepTracing(3, FailingAllocation::Of::all_threads, 200);
}

} // namespace
} // namespace gnomon::truth::test
