// SPDX-License-Identifier: Apache-2.0
// The whole product of the choices' values: each combination is refused with a sentence, or draws.
#include "host/frame_renderer.h"
#include "small_scene.h"
#include "sweep.h"

#include "scene/state.h"

#include <gnomon/choices.h>
#include <gnomon/error.h>
#include <gnomon/options.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::host::test {
namespace {

template <class Enum>
std::vector<Enum> valuesOf(std::string_view choice)
{
    std::vector<Enum> values;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice == choice) {
            values.push_back(static_cast<Enum>(row.value));
        }
    }
    return values;
}

std::vector<Technique> allTechniques()
{
    std::vector<Technique> all;
    for (const auto partition : valuesOf<Partition>("partition")) {
        for (const auto fit : valuesOf<Fit>("fit")) {
            for (const auto filter : valuesOf<Filter>("filter")) {
                for (const auto soften : valuesOf<Soften>("soften")) {
                    for (const auto motion : valuesOf<Motion>("motion")) {
                        all.push_back({partition, fit, filter, soften, motion});
                    }
                }
            }
        }
    }
    return all;
}

std::array<std::string_view, 5> namesOf(const Technique& t)
{
    return {gnomon::nameOf(t.partition), gnomon::nameOf(t.fit), gnomon::nameOf(t.filter), gnomon::nameOf(t.soften),
            gnomon::nameOf(t.motion)};
}

std::string nameOf(const Technique& t)
{
    std::string name;
    for (const std::string_view part : namesOf(t)) {
        name += name.empty() ? "" : "+";
        name += part;
    }
    return name;
}

/// Those that a light of some type can have.
std::vector<Technique> acceptedTechniques()
{
    std::vector<Technique> accepted;
    for (const Technique& technique : allTechniques()) {
        if (!refusal(technique)) {
            accepted.push_back(technique);
        }
    }
    // In an order in which neighbours have little in common, so that any part of them is a sample: by a prime.
    std::vector<Technique> mixed;
    for (std::size_t i = 0; i < accepted.size(); ++i) {
        mixed.push_back(accepted[i * 7919 % accepted.size()]);
    }
    // Values that few have come first.
    std::set<std::string_view> seen;
    const auto bringsNew = [&](const Technique& technique) {
        bool is_new = false;
        for (const std::string_view name : namesOf(technique)) {
            is_new = seen.insert(name).second || is_new;
        }
        return is_new;
    };
    std::stable_partition(mixed.begin(), mixed.end(), bringsNew); // clang 14 has no subranges
    return mixed;
}

/// A sun, a spot and a lamp that shines all around.
scene::Scene sceneWithThreeLights()
{
    scene::Scene scene = smallScene();
    scene::Light lamp;
    lamp.type = scene::LightType::point;
    lamp.intensity = 20.0F;
    lamp.range_m = 12.0F;
    scene.lights.push_back(lamp);
    scene::Node node;
    node.light = static_cast<std::uint32_t>(scene.lights.size() - 1);
    node.transform.translation = {-1.0F, 2.5F, 2.0F};
    scene.nodes.push_back(node);
    scene::finishScene(scene);
    return scene;
}

TEST(Product, EachCombinationIsRefusedWithASentenceOrResolved)
{
    std::size_t refused = 0;
    for (const Technique& technique : allTechniques()) {
        const std::optional<std::string_view> reason = refusal(technique);
        const Resolution resolution = resolve({.technique = technique});
        ASSERT_EQ(reason.has_value(), !resolution) << nameOf(technique) << ": " << resolution.refusal;
        if (reason) {
            ++refused;
            EXPECT_GT(reason->size(), 20U) << nameOf(technique);
        }
    }
    EXPECT_GT(refused, 0U);
}

/// GNOMON_SWEEP=all draws every one of them; else a sample that has each value.
TEST(Product, EachCombinationThatIsNotRefusedDraws)
{
    constexpr std::uint64_t kSample = 40;
    const std::vector<Technique> accepted = acceptedTechniques();
    const scene::Scene scene = sceneWithThreeLights();
    Gpu gpu{{.gpu = "software", .validate = true}};
    RenderOptions options;
    options.width = 64;
    options.height = 64;
    options.shadow.map_size = 64;
    options.shadow.technique = kPlainTechnique;
    const SceneOnGpu uploaded(gpu, scene, scene::evaluate(scene, 0.0));
    FrameRenderer renderer(uploaded, options);
    std::set<std::string_view> drawn;
    for (const std::uint64_t point : gnomon::test::sweepPoints("techniques", accepted.size(), kSample)) {
        const Technique& technique = accepted[point - 1];
        options.shadow.technique = technique;
        renderer.setShadows(options.shadow);
        for (const double time_s : {0.0, 0.1}) {
            const scene::State state = scene::evaluate(scene, time_s);
            renderer.draw(state, smallEye(), lightsOf(scene, state));
        }
        const Picture picture = renderer.read({.masks = true});
        ASSERT_EQ(picture.masks.size(), 3U);
        for (const ImageF& mask : picture.masks) {
            EXPECT_TRUE(std::ranges::all_of(mask.values, [](float v) { return v >= 0.0F && v <= 1.0F; }))
                << nameOf(technique);
        }
        ASSERT_EQ(gpu.messages(), std::vector<std::string>{}) << nameOf(technique);
        const auto names = namesOf(technique);
        drawn.insert(names.begin(), names.end());
    }
    for (const ChoiceValue& row : choiceValues()) {
        EXPECT_TRUE(row.choice == "light" || drawn.contains(row.name)) << row.name;
    }
}

} // namespace
} // namespace gnomon::host::test
