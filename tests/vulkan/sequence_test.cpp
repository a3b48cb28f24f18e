// SPDX-License-Identifier: Apache-2.0
// One renderer and one drawer live through a change of every option, of lights, screens and inputs: what a frame needs
// is made before it is recorded, and nothing is freed or changed that a frame in flight may use.
#include "changing_host.h"
#include "option_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::test {
namespace {

// Cycles of lengths that share no factor, so that all meet all.
FrameSetup setupOf(std::uint32_t step, std::uint32_t options)
{
    constexpr std::array<std::uint32_t, 11> kLights{1, 3, 0, 9, 1, 5, 2, 1, 7, 4, 8};
    constexpr std::array<VkExtent2D, 5> kScreens{{{64, 40}, {64, 40}, {96, 40}, {33, 70}, {80, 80}}};
    FrameSetup setup;
    setup.lights = kLights[step % kLights.size()];
    setup.options = options;
    setup.screen = kScreens[step % kScreens.size()];
    setup.inputs.normals = step / 7 % 2 == 0;
    setup.inputs.ids = step / 13 % 2 == 1;
    return setup;
}

// Some frames by each step's options.
class Sequence {
public:
    void step(std::span<const ShadowOptions> options, const std::string& what)
    {
        Planner planner(options);
        FrameSetup setup = setupOf(steps_++, static_cast<std::uint32_t>(options.size()));
        const auto needsIds = [](const ShadowOptions& one) {
            return filterTraits(filterOf(one))->ids;
        };
        setup.inputs.ids = setup.inputs.ids || std::ranges::any_of(options, needsIds);
        frame(planner, setup, what + ", first frame");
        frame(planner, setup, what + ", second frame");
        setup.lights = (setup.lights + 4) % 10; // the same planner, more room
        frame(planner, setup, what + ", other lights");
        host.expectNoMistakes(what);
    }

    ChangingHost host{{.mask_shape = vulkan::MaskShape{.normals = true}}};

private:
    void frame(Planner& planner, const FrameSetup& setup, const std::string& what)
    {
        Made made = host.frame(planner, setup);
        const bool announced = setup.inputs.normals == inputs_.normals && setup.inputs.ids == inputs_.ids;
        inputs_ = setup.inputs;
        if (!announced) { // the one thing that is made late: pipelines for inputs that nobody could know of
            made.pipelines = 0;
            made.heap = 0;
        }
        EXPECT_EQ(made, Made{}) << what << ", " << setup.lights << " lights";
    }

    std::uint32_t steps_ = 0;
    vulkan::MaskShape inputs_{.normals = true};
};

class OptionSequence : public testing::TestWithParam<const char*> {};

TEST_P(OptionSequence, ofEveryOptionMakesNothingWhileRecordingAndFreesNothingInUse)
{
    const ShadowOptions base = optionsFrom(GetParam());
    const ShadowOptions other = optionsFrom("filter=evsm map-size=64 keep-still=always");
    const OptionSteps steps = stepsFrom(base);
    EXPECT_GT(steps.list.size(), 2 * steps.refused) << "most values are not refused";
    EXPECT_EQ(steps.rows, optionTable().size()) << "rows of which some value can be had";
    Sequence sequence;
    for (std::size_t i = 0; i < steps.list.size() && !HasFailure(); ++i) {
        const std::vector<ShadowOptions> several{steps.list[i].options, other, base};
        sequence.step(std::span(several).first(1 + i % 3), steps.list[i].what);
    }
    EXPECT_GT(sequence.host.views_seen, 4 * steps.list.size()) << "else nothing was drawn";
}

INSTANTIATE_TEST_SUITE_P(Bases, OptionSequence, testing::ValuesIn(kBases),
                         [](const auto& base) { return nameOfBase(base.param); });
INSTANTIATE_TEST_SUITE_P(BasesOfIds, OptionSequence, testing::ValuesIn(kBasesOfIds),
                         [](const auto& base) { return nameOfBase(base.param); });

// From technique to technique, so that each comes after each.
TEST(TechniqueSequence, ofAllPairsMakesNothingWhileRecordingAndFreesNothingInUse)
{
    Sequence sequence;
    for (const char* const from : kBases) {
        for (const char* const to : kBases) {
            const std::vector<ShadowOptions> both{optionsFrom(from), optionsFrom(to)};
            sequence.step(both, std::string(from) + " with " + to);
            sequence.step(std::span(both).last(1), to);
            sequence.step(std::span(both).first(1), from);
        }
    }
    EXPECT_GT(sequence.host.views_seen, 5000U);
}

TEST(TechniqueSequence, leavesNothingBehind)
{
    const ShadowOptions first = optionsFrom(kBases.front());
    ChangingHost host({});
    const auto run = [&](const ShadowOptions& options) {
        Planner planner(options);
        for (int i = 0; i < 4; ++i) {
            (void)host.frame(planner, {.inputs = {.ids = true}});
        }
        return host.driver.counts().bytes;
    };
    const std::uint64_t bytes = run(first);
    for (const char* const base : kBases) {
        const ShadowOptions next = optionsFrom(base);
        const bool keeps_masks =
            next.technique.motion == Motion::step_alternate || next.technique.soften == Soften::converge;
        if (!keeps_masks) {
            (void)run(next);
        }
    }
    EXPECT_LE(run(first), bytes + bytes / 2) << "maps of options that are gone";
}

} // namespace
} // namespace gnomon::test
