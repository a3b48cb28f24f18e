// SPDX-License-Identifier: Apache-2.0
// Plans of all kinds are those that were recorded. plans.txt has a hash of each, of its JSON with numbers to seven
// digits, so that processors whose sines differ in the last bit agree. GNOMON_PLANS_UPDATE=1 records anew.
// GNOMON_PLANS_WRITE=FILE writes the JSON itself, with all digits: two builds plan alike where their files are the
// same.
#include "random_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>

namespace gnomon {
namespace {

using test::Random;
using test::RandomScene;
using test::randomScene;

constexpr int kFrames = 6;
constexpr std::uint64_t kSeeds = 3;
constexpr std::uint64_t kSeedsWritten = 40;

struct Kind {
    std::string name;
    Technique technique;
    std::function<void(ShadowOptions&)> change = [](ShadowOptions&) {
    };
    std::uint32_t more_lights = 0; // this many more lamps, of the same options
    std::uint64_t first_seed = 11;
};

void addTechniques(std::vector<Kind>& kinds)
{
    for (const Fit fit : {Fit::automatic, Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm}) {
        for (const Partition partition : {Partition::single, Partition::cascades, Partition::multi}) {
            kinds.push_back({std::string(nameOf(fit)) + " " + std::string(nameOf(partition)), {partition, fit}});
        }
    }
    for (const Partition partition : {Partition::cube, Partition::paraboloid, Partition::automatic, Partition::sdsm}) {
        kinds.push_back({std::string(nameOf(partition)), {partition, Fit::automatic, Filter::pcf}});
    }
    for (const Filter filter : {Filter::hard, Filter::vsm, Filter::lvsm, Filter::esm, Filter::id, Filter::depth_id,
                                Filter::pcss, Filter::volumes, Filter::smoothies}) {
        const Partition partition = filter == Filter::volumes ? Partition::single : Partition::cascades;
        kinds.push_back({std::string(nameOf(filter)), {partition, Fit::uniform, filter}});
    }
    for (int motion = 1; motion < 6; ++motion) {
        kinds.push_back({"motion " + std::string(nameOf(static_cast<Motion>(motion))),
                         {Partition::cascades, Fit::uniform, Filter::pcf, Soften::none, static_cast<Motion>(motion)}});
    }
    kinds.push_back({"scene", {Partition::single, Fit::scene, Filter::pcf}});
    kinds.push_back({"converge", {Partition::single, Fit::uniform, Filter::pcf, Soften::converge}});
    kinds.push_back({"all auto", Technique{}});
}

/// A frame draws one map or two.
void takeTurns(ShadowOptions& options)
{
    options.map_size = 256;
    options.draw_budget_texels = 100000;
}

void addOptions(std::vector<Kind>& kinds)
{
    const Technique cascades{Partition::cascades, Fit::uniform, Filter::pcf};
    const Technique multi{Partition::multi, Fit::uniform, Filter::pcf};
    const Technique steps{Partition::single, Fit::uniform, Filter::pcf, Soften::none, Motion::step_blend};
    kinds.push_back({"map size given", cascades, [](ShadowOptions& o) {
                         o.map_size = 256;
                     }});
    kinds.push_back({"map size auto", cascades, [](ShadowOptions& o) {
                         o.map_size.reset();
                     }});
    kinds.push_back({"segments", {Partition::single, Fit::tsm}, [](ShadowOptions& o) {
                         o.tsm_segments = 4;
                     }});
    kinds.push_back({"receivers", multi, [](ShadowOptions& o) {
                         o.multi.divide = MultiDivide::receivers;
                     }});
    kinds.push_back({"most times", multi, [](ShadowOptions& o) {
                         o.multi.most_times = 4.0;
                     }});
    kinds.push_back({"multi snap", {Partition::multi, Fit::uniform, Filter::pcf, Soften::none, Motion::snap}});
    kinds.push_back({"two maps a texel", steps, [](ShadowOptions& o) {
                         o.format = MapFormat::rg16;
                     }});
    kinds.push_back({"kept", cascades, [](ShadowOptions& o) {
                         o.keep_still = KeepStill::always;
                     }});
    kinds.push_back({"distance", cascades, [](ShadowOptions& o) {
                         o.max_distance_m = 3.0;
                     }});
    kinds.push_back({"open volumes", {Partition::single, Fit::uniform, Filter::volumes}, [](ShadowOptions& o) {
                         o.volumes.open = OpenCasters::skip;
                     }});
    kinds.push_back({"world layers", {Partition::single, Fit::uniform, Filter::lvsm}, [](ShadowOptions& o) {
                         o.moments.placement = LayerPlacement::world;
                     }});
    kinds.push_back({"coloured", cascades, [](ShadowOptions& o) {
                         o.translucent = Translucent::colour;
                     }});
    for (const Technique& technique : {cascades, multi}) {
        const std::string name(nameOf(technique.partition));
        kinds.push_back({"budget " + name, technique, [](ShadowOptions& o) { o.budget_texels = 1U << 20U; }, 12});
        kinds.push_back({"turns " + name, technique, takeTurns, 12});
    }
    kinds.push_back({"turns of cascades", cascades,
                     [](ShadowOptions& o) {
                         takeTurns(o);
                         o.cascades.room = 0.5;
                     },
                     0, 17}); // whose cascades wait
}

/// A host changes its world between two frames. The last three are alike.
void change(RandomScene& scene, Random& random, int frame)
{
    if (frame == 0 || frame >= kFrames - 2) {
        return;
    }
    const glm::dvec3 step = random.direction() * (0.02 * scene.size_m);
    const glm::dvec3 eye_ws = scene.camera.eye_ws;
    const glm::dmat4 turned = glm::rotate(glm::translate(scene.camera.clip_from_world, eye_ws), 0.02, {0.0, 1.0, 0.0});
    scene.camera.clip_from_world = glm::translate(turned, -eye_ws - step);
    scene.camera.eye_ws += step;
    for (Light& light : scene.lights) {
        light.direction_ws = glm::normalize(light.direction_ws + random.direction() * 0.01);
    }
    for (std::uint32_t object = 0; object < scene.set.size(); object += 3) {
        Aabb box = scene.set.bounds(object);
        box.min += glm::vec3(step);
        box.max += glm::vec3(step);
        scene.set.update(scene.set.idAt(object), box);
    }
    if (frame == 2) { // one goes, and one comes
        scene.set.remove(scene.set.idAt(0));
        scene.set.add(test::boxAt(scene.camera.eye_ws + step * 10.0, glm::dvec3(0.1 * scene.size_m)));
    }
}

/// The plan as text, with what its JSON leaves out.
std::string textOf(const Plan& plan)
{
    std::string text = toJson(plan) + std::to_string(plan.cut) + ' ' + std::to_string(plan.made_for.lights.size());
    for (const View& view : plan.views) {
        text += ' ' + std::to_string(view.contents.ids_key) + ' ' + std::to_string(view.projection.light_reach);
    }
    for (const std::vector<Aabb>* boxes : {&plan.moved_ws, &plan.object_bounds}) {
        for (const Aabb& box : *boxes) {
            text += ' ' + std::to_string(box.min.x) + ' ' + std::to_string(box.max.z);
        }
    }
    return text + '\n';
}

std::string plansOf(const Kind& kind, std::uint64_t seed, std::vector<std::string>& plans)
{
    RandomScene scene = randomScene(seed, kind.technique);
    kind.change(scene.options);
    Random random(seed + 77);
    for (std::uint32_t i = 0; i < kind.more_lights; ++i) {
        Light light = scene.lights[i % 3];
        light.position_ws += random.direction() * scene.size_m;
        light.direction_ws = random.direction();
        scene.lights.push_back(light);
    }
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        scene.lights[i].key = i + 1;
    }
    for (std::uint32_t object = 0; object < scene.set.size(); ++object) {
        ObjectFlags flags = scene.set.flags(object);
        flags.closed = kind.name != "open volumes" || object % 2 == 0;
        scene.set.setFlags(scene.set.idAt(object), flags);
    }
    Planner planner(scene.options);
    for (int i = 0; i < kFrames; ++i) {
        change(scene, random, i);
        Frame frame = scene.frame();
        frame.index = static_cast<std::uint64_t>(i);
        frame.time_s = 1.5 * i;
        frame.cut = i == 3;
        plans.push_back(textOf(planner.plan(frame)));
    }
    return kind.name + " " + std::to_string(seed);
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991) of a text whose numbers have seven digits.
std::uint64_t hashOf(const std::string& text)
{
    std::uint64_t hash = 14695981039346656037ULL;
    const auto add = [&](std::string_view part) {
        for (const char c : part) {
            hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
        }
    };
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        double number = 0.0;
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc()) {
            add(std::string_view(at++, 1));
            continue;
        }
        number = std::abs(number) < 1e-9 ? 0.0 : number; // what is left of a difference
        std::array<char, 32> digits{};
        const auto written =
            std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::scientific, 6);
        add(std::string_view(digits.data(), written.ptr));
        at = next;
    }
    return hash;
}

TEST(PlanRecord, IsAsItWas)
{
    std::vector<Kind> kinds;
    addTechniques(kinds);
    addOptions(kinds);
    const char* const whole = std::getenv("GNOMON_PLANS_WRITE"); // NOLINT(concurrency-mt-unsafe)
    std::ofstream all(whole != nullptr ? whole : "/dev/null");
    std::map<std::string, std::string> found;
    std::map<std::string, int> waiting;
    int with_maps = 0;
    for (const Kind& kind : kinds) {
        const std::uint64_t seeds = whole != nullptr ? kSeedsWritten : kSeeds;
        for (std::uint64_t seed = kind.first_seed; seed < kind.first_seed + seeds; ++seed) {
            std::vector<std::string> plans;
            const std::string name = plansOf(kind, seed, plans);
            for (const std::string& plan : plans) {
                all << name << '\n' << plan;
                with_maps += plan.find("\"tile\"") != std::string::npos ? 1 : 0;
                for (const char* frames : {"\"waited\": 1", "\"waited\": 2"}) {
                    waiting[kind.name] += plan.find(frames) != std::string::npos ? 1 : 0;
                }
                found[name] += " " + std::to_string(hashOf(plan) % 1000000007U);
            }
        }
    }
    EXPECT_GE(with_maps, 600);
    EXPECT_GT(waiting["turns cascades"], 5);
    EXPECT_GT(waiting["turns multi"], 5);
    EXPECT_GT(waiting["turns of cascades"], 2);
    if (whole != nullptr) {
        return;
    }
    const std::string file = GNOMON_SOURCE_DIR "/tests/core/plans.txt";
    if (std::getenv("GNOMON_PLANS_UPDATE") != nullptr) { // NOLINT(concurrency-mt-unsafe)
        std::ofstream out(file);
        for (const auto& [name, hashes] : found) {
            out << name << ":" << hashes << '\n';
        }
        return;
    }
    std::ifstream in(file);
    std::size_t read = 0;
    for (std::string line; std::getline(in, line); ++read) {
        const std::size_t colon = line.find(':');
        EXPECT_EQ(found[line.substr(0, colon)], line.substr(colon + 1)) << line.substr(0, colon);
    }
    EXPECT_EQ(read, found.size());
}

} // namespace
} // namespace gnomon
