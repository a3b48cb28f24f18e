// SPDX-License-Identifier: Apache-2.0
// The cost of planning, and its growth with the number of objects. Scenes keep their density: ten times the objects
// cover ten times the ground, and the camera rises until it sees all of it.
#include <gnomon/pack/caster_rows.h>
#include <gnomon/planner.h>

#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using namespace gnomon;

constexpr double kArea_m2 = 25.0; // of ground for each object
constexpr int kFrames = 64;

double noise(std::uint64_t n)
{
    n = (n ^ (n >> 30)) * 0xBF58476D1CE4E5B9U;
    n = (n ^ (n >> 27)) * 0x94D049BB133111EBU;
    return static_cast<double>((n ^ (n >> 31)) >> 11) * 0x1.0p-53;
}

/// A terrain and small things on it, of which some walk in circles.
struct World {
    ObjectSet set;
    std::vector<ObjectId> ids;
    std::vector<glm::dvec3> homes;
    std::uint32_t moving_every = 10;
    double half_m = 0.0;
    std::array<Light, 1> lights;
    Frame frame;

    World(std::int64_t count, std::uint32_t moving_one_in) : moving_every(moving_one_in)
    {
        half_m = 0.5 * std::sqrt(kArea_m2 * static_cast<double>(count));
        const float half = static_cast<float>(half_m);
        ids.push_back(set.add({{-half, -4, -half}, {half, 9, half}}));
        for (std::uint64_t i = 1; i < static_cast<std::uint64_t>(count); ++i) {
            homes.emplace_back((2.0 * noise(3 * i) - 1.0) * half_m, 6.0 * noise(3 * i + 1),
                               (2.0 * noise(3 * i + 2) - 1.0) * half_m);
            ids.push_back(set.add(box(homes.back()), {true, true, i % moving_every == 0}));
        }
        lights[0].direction_ws = glm::normalize(glm::dvec3(0.4, -1.0, 0.25));
        lookFrom({0.0, 1.4 * half_m, 1.9 * half_m});
        frame.lights = lights;
        frame.objects = &set;
    }
    void lookFrom(const glm::dvec3& eye)
    {
        frame.camera.eye_ws = eye;
        frame.camera.clip_from_world = glm::perspectiveRH_ZO(1.0, 1.6, 10.0 * half_m, 0.1) *
                                       glm::lookAtRH(eye, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0));
    }
    static Aabb box(const glm::dvec3& centre) { return {glm::vec3(centre - 0.8), glm::vec3(centre + 0.8)}; }
    void move(int step)
    {
        const double turn = 6.283185307179586 * step / kFrames;
        for (std::uint32_t i = moving_every; i <= homes.size(); i += moving_every)
            set.update(ids[i], box(homes[i - 1] + glm::dvec3(5.0 * std::cos(turn), 0.0, 5.0 * std::sin(turn))));
    }
};

/// Updates of the moving objects and the plan: what a frame costs.
void frameOf(benchmark::State& state, std::uint32_t moving_one_in, double eye_height)
{
    World world(state.range(0), moving_one_in);
    world.lookFrom(glm::dvec3(0.0, eye_height, 1.36 * eye_height) * world.half_m);
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    int step = 0;
    for (; step < kFrames; ++step) {
        world.move(step);
        benchmark::DoNotOptimize(planner.plan(world.frame).casters.data());
    }
    std::size_t casters = 0;
    for (auto _ : state) {
        world.move(++step % kFrames);
        casters = planner.plan(world.frame).casters.size();
    }
    state.counters["casters"] = static_cast<double>(casters);
    state.SetComplexityN(state.range(0));
}

void planOneInTenMoving(benchmark::State& state)
{
    frameOf(state, 10, 1.4);
}
BENCHMARK(planOneInTenMoving)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

/// The same from so near that a good part of the world is out of sight and the frustum's sides cut through it.
void planPartOfTheWorld(benchmark::State& state)
{
    frameOf(state, 10, 0.5);
}
BENCHMARK(planPartOfTheWorld)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

/// As many objects as the `rts` world has, three of four of them moving.
void planRtsSize(benchmark::State& state)
{
    World world(state.range(0), 1);
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    int step = 0;
    for (auto _ : state) {
        const double turn = 6.283185307179586 * (++step % kFrames) / kFrames;
        const glm::dvec3 away(5.0 * std::cos(turn), 0.0, 5.0 * std::sin(turn));
        for (std::uint32_t i = 1; i <= 4400; ++i)
            world.set.update(world.ids[i], World::box(world.homes[i - 1] + away));
        benchmark::DoNotOptimize(planner.plan(world.frame).casters.data());
    }
}
BENCHMARK(planRtsSize)->Arg(6000)->Unit(benchmark::kMicrosecond);

void planNothingMoving(benchmark::State& state)
{
    World world(state.range(0), 10);
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    for (auto _ : state)
        benchmark::DoNotOptimize(planner.plan(world.frame).casters.data());
    state.SetComplexityN(state.range(0));
}
BENCHMARK(planNothingMoving)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

/// By a hair in each frame.
void planMovedByAHair(benchmark::State& state, const ShadowOptions& options)
{
    World world(state.range(0), 10);
    Planner planner(options);
    int step = 0;
    for (auto _ : state) {
        world.lookFrom({0.01 * (++step % 2), 1.4 * world.half_m, 1.9 * world.half_m});
        benchmark::DoNotOptimize(planner.plan(world.frame).casters.data());
    }
    state.SetComplexityN(state.range(0));
}

void planCameraMoving(benchmark::State& state)
{
    planMovedByAHair(state, {.technique = kPlainTechnique});
}
BENCHMARK(planCameraMoving)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

/// The same with partition and fit left to the planner, which predicts both partitions in each frame.
void planAutoCameraMoving(benchmark::State& state)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.partition = Partition::automatic;
    options.technique.fit = Fit::automatic;
    planMovedByAHair(state, options);
}
BENCHMARK(planAutoCameraMoving)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

/// A sun's map that is drawn anew, as far as the CPU does it: a row for each of its casters.
void writeRowsOfCasters(benchmark::State& state)
{
    World world(state.range(0), 10);
    Planner planner({.technique = kPlainTechnique});
    const Plan& plan = planner.plan(world.frame);
    const pack::CasterRows rows(plan.views.front());
    const std::vector<pack::Rows3x4> transforms(world.ids.size());
    std::vector<glm::vec4> out(plan.casters.size() * pack::casterRowCount(true));
    for (auto _ : state) {
        glm::vec4* at = out.data();
        for (const std::uint32_t object : plan.casters) {
            at = rows.write(transforms[object], at);
        }
        benchmark::DoNotOptimize(out.data());
    }
    state.SetComplexityN(state.range(0));
}
BENCHMARK(writeRowsOfCasters)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

/// A frustum that sees about a tenth of the world.
void querySmallRegion(benchmark::State& state)
{
    World world(state.range(0), 10);
    const glm::dvec3 eye(0.0, 0.5 * world.half_m, 0.5 * world.half_m);
    const Frustum frustum = frustumFromClip(glm::perspectiveRH_ZO(0.5, 1.6, 0.1, 10.0 * world.half_m) *
                                            glm::lookAtRH(eye, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)));
    std::vector<std::uint32_t> found;
    for (auto _ : state) {
        found.clear();
        world.set.query(frustum.planes, ObjectSet::Want::all, found);
    }
    state.counters["found"] = static_cast<double>(found.size());
    state.SetComplexityN(state.range(0));
}
BENCHMARK(querySmallRegion)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

void updateAll(benchmark::State& state)
{
    World world(state.range(0), 1);
    int step = 0;
    for (auto _ : state)
        world.move(++step % kFrames);
    state.SetItemsProcessed(state.iterations() * (state.range(0) - 1));
    state.SetComplexityN(state.range(0));
}
BENCHMARK(updateAll)->RangeMultiplier(10)->Range(1000, 100000)->Complexity()->Unit(benchmark::kMicrosecond);

/// As many lamps as asked for over a town of 5,000 objects, of which the camera sees all.
struct Town {
    World world;
    std::vector<Light> lamps;
    Planner planner;

    Town(std::int64_t count, Partition partition, Motion motion)
        : world(5000, 10), lamps(static_cast<std::size_t>(count)), planner(optionsFor(partition, motion))
    {
        for (std::uint32_t i = 0; i < lamps.size(); ++i) {
            lamps[i].type = LightType::point;
            lamps[i].key = i;
            lamps[i].position_ws = {(2.0 * noise(7 * i) - 1.0) * world.half_m, 12.0,
                                    (2.0 * noise(7 * i + 1) - 1.0) * world.half_m};
            lamps[i].range_m = 25.0;
        }
        world.frame.lights = lamps;
    }
    static ShadowOptions optionsFor(Partition partition, Motion motion)
    {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.partition = partition;
        options.technique.motion = motion;
        return options;
    }
    void look(int step)
    {
        const double turn = 6.283185307179586 * (step % kFrames) / kFrames;
        world.lookFrom({0.3 * world.half_m * std::sin(turn), 1.4 * world.half_m, 1.9 * world.half_m});
    }
};

void planLampsNothingMoving(benchmark::State& state)
{
    Town town(state.range(0), static_cast<Partition>(state.range(1)), Motion::free);
    for (auto _ : state)
        benchmark::DoNotOptimize(town.planner.plan(town.world.frame).casters.data());
}

void planLampsCameraMoving(benchmark::State& state)
{
    Town town(state.range(0), static_cast<Partition>(state.range(1)), static_cast<Motion>(state.range(2)));
    int step = 0;
    for (auto _ : state) {
        town.look(++step);
        benchmark::DoNotOptimize(town.planner.plan(town.world.frame).casters.data());
    }
}

void planLampsAllMoving(benchmark::State& state)
{
    Town town(state.range(0), static_cast<Partition>(state.range(1)), Motion::free);
    int step = 0;
    for (auto _ : state) {
        town.look(++step);
        town.world.move(step % kFrames);
        benchmark::DoNotOptimize(town.planner.plan(town.world.frame).casters.data());
    }
}

void partitionsOfLamps(benchmark::internal::Benchmark* bench)
{
    for (const Partition partition : {Partition::cube, Partition::multi})
        for (const int lamps : {64, 256, 1000})
            bench->Args({lamps, static_cast<int>(partition), static_cast<int>(Motion::free)});
    bench->Args({64, static_cast<int>(Partition::multi), static_cast<int>(Motion::snap)});
    bench->ArgNames({"lamps", "partition", "motion"})->Unit(benchmark::kMicrosecond);
}
BENCHMARK(planLampsNothingMoving)->Apply(partitionsOfLamps);
BENCHMARK(planLampsCameraMoving)->Apply(partitionsOfLamps);
BENCHMARK(planLampsAllMoving)->Apply(partitionsOfLamps);

} // namespace

BENCHMARK_MAIN();
