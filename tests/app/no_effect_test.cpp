// SPDX-License-Identifier: Apache-2.0
// Options that are known and change nothing beside the others: told, and the run goes on; with --strict refused.
#include "folder.h"
#include "lights_and_cameras.h"
#include "wrong_usage.h"

#include "app/command_line.h"
#include "app/shot.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon {
namespace {

struct Idle {
    const char* name;
    std::vector<std::string> arguments;
    std::string says; // part of the line
};

void PrintTo(const Idle& idle, std::ostream* out)
{
    PrintTo(test::Wrong{idle.name, idle.arguments, 0, {}}, out);
}

const std::vector<Idle> kIdle{
    {"ReachOfHard", {"render", "--filter", "hard", "--set", "smoothies.reach=8"}, "filter or soften smoothies"},
    {"SunAngleWithoutASun", {"render", "spotlit", "--sun-angle", "3"}, "only on a directional light"},
    {"LightSizeWithoutALamp", {"plan", "sundial", "--light-size", "1"}, "only on a spot or point light"},
    {"TexelsOfMultiElsewhere",
     {"render", "--partition", "cube", "--set", "multi.texels-per-pixel=2"},
     "only with partition multi"},
    {"CompactMaskOfAMask", {"render", "planes", "--mask", "--set", "compact-mask=8"}, "has an effect only"},
    {"CompactMaskOfFramesThatConverge",
     {"render", "planes", "--soften", "converge", "--set", "compact-mask=8"},
     "has an effect only"},
    {"TilesOfNoCompactMask", {"render", "planes", "--set", "compact-mask.side=32"}, "compact-mask=4 or 8"},
    {"CascadesOfACube", {"render", "--partition", "cube", "--set", "cascades.count=2"}, "has an effect only"},
    {"CascadesOfASingleMap",
     {"render", "--partition", "single", "--set", "cascades.count=2"},
     "only with partition cascades"},
    {"CascadePassOfASingleMap",
     {"render", "--partition", "single", "--set", "cascades.pass=layered"},
     "only with filter hard, pcf, pcss, raymarch, smoothies or auto, and"},
    {"FadeWithoutAnEnd", {"render", "--set", "fade=0.2"}, "only with max-distance above 0"},
    {"BlurNotAsked", {"render", "--set", "soften.kernel=box"}, "only with soften blur"},
    {"BlurOnACompactMask", {"render", "planes", "--soften", "blur", "--set", "compact-mask=8"}, "soften=none"},
    {"HalfMaskOnACompactMask",
     {"render", "planes", "--set", "compact-mask=8", "--set", "mask-size=half"},
     "mask-size=full"},
    {"ConeWithoutASpot", {"render", "rts", "--set", "spot.cone=30"}, "only on a spot light"},
    {"KernelOfHard", {"render", "--filter", "hard", "--set", "pcf.kernel=5x5"}, "only with filter pcf"},
    {"TapsOfAGaussian",
     {"render", "--set", "pcf.taps=8"},
     "--set pcf.taps has an effect only with pcf.kernel poisson or vogel"},
    {"BlurOfHard", {"render", "--filter", "hard", "--set", "blur=box"}, "only with filter vsm, lvsm, esm, evsm or"},
    {"SigmaOfABox",
     {"render", "--filter", "vsm", "--set", "blur=box", "--set", "blur.sigma=2"},
     "only with a filterable map and blur gaussian"},
    {"RadiusOfNoBlur",
     {"render", "--filter", "vsm", "--set", "blur=none", "--set", "blur.radius=2"},
     "only with a filterable map and blur gaussian or box"},
    {"AnisotropyOfTrilinear", {"render", "--filter", "vsm", "--set", "anisotropy=4"}, "only with map-sampling aniso"},
    {"VarianceOfEsm", {"render", "--filter", "esm", "--set", "min-variance=0.1"}, "only with filter vsm, lvsm or"},
    {"LayersOfVsm", {"render", "--filter", "vsm", "--set", "lvsm.layers=3"}, "only with filter lvsm"},
    {"WarpThatIsNotStored",
     {"render", "--filter", "evsm", "--map-format", "rg32f", "--set", "evsm.negative=5"},
     "only with filter evsm and four channels"},
    {"LogSpaceOfVsm", {"render", "--filter", "vsm", "--set", "log-space=1"}, "only with filter esm or evsm"},
    {"OptionOfNoContestant", {"bench", "--techniques", "hard,pcf", "--set", "msaa=1"}, "only with filter vsm"},
    {"RemapOfMsm", {"render", "--filter", "msm", "--set", "depth-remap=1"}, "has an effect only with filter vsm, lvsm"},
    {"SizeOfNoMap",
     {"render", "--filter", "volumes", "--map-size", "512"},
     "--map-size has an effect only with every filter but volumes"},
    {"BiasOfNoMap", {"render", "--filter", "volumes", "--bias", "none"}, "only with every filter but volumes"},
    {"BiasOfIds", {"render", "--filter", "id", "--bias", "none"}, "--bias has an effect only with every filter but"},
    {"BiasOfIdsInATechnique",
     {"bench", "--techniques", "id+bias.slope=1"},
     "bias.slope has an effect only with every filter but volumes and id, and no id.bias"},
    {"BiasBesideTheObjectsOwn",
     {"bench", "--techniques", "depth-id+id.bias=0.1+bias.constant=0.1"},
     "bias.constant has an effect only with"},
    {"OpenOfAMap", {"render", "--filter", "hard", "--set", "volumes.open=skip"}, "only with filter volumes"},
    {"OcclusionOfForward", {"render", "--shading", "forward", "--set", "ambient-occlusion=on"}, "only with a picture"},
    {"OcclusionsRadiusInBench", {"bench", "--set", "ambient-occlusion.radius=1"}, "only with ambient occlusion"},
    {"ToneOfAMask", {"render", "--mask", "--set", "tone=filmic"}, "not --mask"},
    {"MaskWithFxaa", {"render", "--mask", "--aa", "fxaa"}, "not with --mask"},
    {"FpsAlone", {"render", "--fps", "10"}, "only with --frames"},
    {"LightWithoutMask", {"render", "--light", "sun"}, "only with --mask"},
    {"SamplesWithoutTruth", {"render", "--samples", "64"}, "--samples has an effect only with --truth area"},
    {"SamplesOfHardTruth", {"render", "--truth", "hard", "--samples", "64"}, "only with --truth area"},
    {"NoCacheWithoutTruth", {"render", "--no-cache"}, "--no-cache has an effect only with --truth"},
    {"SunAngleWithoutTruth",
     {"render", "--filter", "hard", "--sun-angle", "1"},
     "--sun-angle has an effect only with --truth area"},
    {"SunAngleOfHardTruth", {"render", "--truth", "hard", "--sun-angle", "1"}, "only with --truth area"},
    {"SunAngleOfAPointLight",
     {"render", "lights.gltf", "--truth", "area", "--mask", "--sun-angle", "1"},
     "only on a directional light"},
    {"LightSizeWithoutTruth",
     {"render", "--filter", "hard", "--light-size=1"},
     "--light-size has an effect only with --truth area"},
    {"LightSizeOfASun",
     {"render", "planes", "--sun", "1,-1,0", "--truth", "area", "--mask", "--light-size", "1"},
     "only on a spot or point light"},
    {"FilterWithTruth", {"render", "--truth", "hard", "--filter", "hard"}, "--filter has no effect with --truth"},
    {"KernelWithTruth", {"render", "--truth", "hard", "--set", "pcf.kernel=2x2"}, "no effect with --truth"},
    {"GpuWithTruthsMask", {"render", "--truth", "hard", "--mask", "--gpu", "x"}, "only with something to draw"},
    {"AaWithTruthsMask", {"render", "--truth", "hard", "--mask", "--aa", "ssaa4"}, "only with something to draw"},
    {"UpWithoutAnEye", {"plan", "planes", "--up", "0,0,1"}, "--up has an effect only with --eye"},
    {"KernelOfATechnique",
     {"plan", "planes", "--technique", "hard+pcf.kernel=5x5"},
     "technique \"hard+pcf.kernel=5x5\": pcf.kernel has an effect only with filter pcf"},
    {"TechniqueWithTruth",
     {"render", "--truth", "hard", "--technique", "pcf"},
     "--technique has no effect with --truth"},
    {"RepetitionsAlongAPath",
     {"compare", "planes", "--path", "pan", "--frames", "0-1", "--repetitions", "3"},
     "--repetitions has no effect with --path"},
    {"WarmupOfASweep",
     {"compare", "planes", "--sweep", "bias.slope=0:1:2", "--warmup", "1"},
     "--warmup has no effect with --sweep"},
    {"GpuOfAPlan", {"plan", "planes", "--gpu", "software"}, "--gpu has an effect only with something to draw"},
    {"QualityOfNoAuto",
     {"plan", "planes", "--technique", "pcf+single+uniform", "--quality", "best"},
     "--quality has an effect only with"}};

class NoEffect : public testing::TestWithParam<Idle> {};

TEST_P(NoEffect, IsRefusedByStrict)
{
    test::Wrong strict{GetParam().name, GetParam().arguments, 2, GetParam().says};
    strict.arguments.emplace_back("--strict");
    test::expectOneLineAndNothingLeft(strict, true);
}

/// By the command line, or else by the scene that it names.
TEST_P(NoEffect, IsToldOnceAndPassedOver)
{
    const test::Folder folder;
    test::spill(folder / "lights.gltf", test::kLightsAndCameras);
    app::Command command = app::parseCommandLine(GetParam().arguments);
    if (command.settings.scene == "lights.gltf") {
        command.settings.scene = (folder / "lights.gltf").string();
    }
    std::vector<std::string> told = command.notices;
    const auto count = [&] {
        return std::ranges::count_if(
            told, [](const std::string& line) { return line.find(GetParam().says) != std::string::npos; });
    };
    if (count() == 0) {
        told = app::makeShot(command.settings).notices;
    }
    EXPECT_EQ(count(), 1);
}

INSTANTIATE_TEST_SUITE_P(Table, NoEffect, testing::ValuesIn(kIdle),
                         [](const auto& test) { return std::string(test.param.name); });

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more)
{
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// Notices go to standard error alone, in the order of the options' table, and change no byte of the result.
TEST(NoEffects, LeaveTheResultAsItIs)
{
    const test::Folder folder;
    const test::How how{.folder = folder.path()};
    const std::vector<std::string> plan{"plan", "planes", "--filter", "hard", "--fit", "uniform", "--json"};
    const test::Ran plain = test::gnomon(plan, how);
    const test::Ran told = test::gnomon(with(plan, {"--set", "pcf.taps=8", "--fps", "5", "--up", "1,0,0"}), how);
    EXPECT_EQ(told.status, 0);
    const auto lines = told.errorLines();
    ASSERT_EQ(lines.size(), 3U) << told.err;
    EXPECT_TRUE(lines[0].starts_with("gnomon: --up ")) << told.err;
    EXPECT_TRUE(lines[1].starts_with("gnomon: --set pcf.taps ")) << told.err;
    EXPECT_TRUE(lines[2].starts_with("gnomon: --fps ")) << told.err;
    // The settings are there as they were given; the plan is the same.
    const auto views = [](const test::Ran& ran) {
        return ran.out.substr(ran.out.find("\"views\""));
    };
    EXPECT_EQ(views(plain), views(told));

    const std::vector<std::string> mask{"render", "planes", "--size",  "32x32", "--truth",
                                        "hard",   "--mask", "--light", "sun",   "--no-cache"};
    ASSERT_EQ(test::gnomon(with(mask, {"-o", "a.png"}), how).status, 0);
    const test::Ran with_angle =
        test::gnomon(with(mask, {"-o", "b.png", "--sun-angle", "5", "--filter", "vsm", "--aa", "ssaa4"}), how);
    EXPECT_EQ(with_angle.status, 0) << with_angle.err;
    EXPECT_EQ(with_angle.errorLines().size(), 3U) << with_angle.err;
    EXPECT_EQ(test::slurp(folder / "a.png"), test::slurp(folder / "b.png"));
}

/// One light is looked at, and what all lights are has been told before.
TEST(NoEffects, OfLightsAreToldOnce)
{
    const test::Folder folder;
    const test::Ran ran = test::gnomon({"render", "spotlit", "--size", "8x8", "--truth", "area", "--samples", "4",
                                        "--mask", "--no-cache", "--sun-angle", "3"},
                                       {.folder = folder.path()});
    EXPECT_EQ(ran.status, 0) << ran.err;
    const std::string line = "--sun-angle has an effect only on a directional light";
    EXPECT_NE(ran.err.find(line), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find(line), ran.err.rfind(line)) << ran.err;
}

} // namespace
} // namespace gnomon
