// SPDX-License-Identifier: Apache-2.0
// Wrong uses of subcommands, options, files and values: one clear line on stderr, the right exit status, nothing left
// behind.
#include "wrong_usage.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using test::Wrong;

const std::vector<Wrong> kWrong{
    {"UnknownSubcommand", {"rendr"}, 2, "did you mean \"render\""},
    {"ValueAsASubcommand", {"help", "msm"}, 2, "`gnomon list msm` tells about it"},
    {"FramesOfAWindow", {"view", "--frames", "0-3"}, 2, "--frames is not an option of view"},
    {"OptionBeforeSubcommand", {"--size", "10x10", "render"}, 2, "a subcommand comes first"},
    {"UnknownOption", {"render", "--fliter", "hard"}, 2, "did you mean \"--filter\""},
    {"UnknownShortOption", {"render", "-z"}, 2, "no option -z"},
    {"OptionOfAnother", {"plan", "--mask"}, 2, "--mask is not an option of plan"},
    {"SetOnlyOption", {"render", "--pcf.kernel", "3x3"}, 2, "--set pcf.kernel=VALUE"},
    {"MissingValue", {"render", "--size"}, 2, "--size"},
    {"TooManyScenes", {"render", "planes", "rts"}, 2, "one argument too many"},
    {"HelpOfOneSubcommand", {"help", "list", "render"}, 2, "one argument too many"},
    {"VersionOfNothing", {"--version", "list"}, 2, "one argument too many"},
    {"ListOfNothing", {"list", "mms"}, 2, "nothing called \"mms\" (did you mean \"msm\"?)"},
    {"NoValue", {"render", "planes", "--filter"}, 2, "--filter needs a value"},
    {"ReportTwice", {"compare", "--report", "a", "--report", "b"}, 2, "--report is given twice"},
    {"SweepTwice", {"compare", "--sweep", "map-size=64:128:2", "--sweep", "fov=20:40:2"}, 2, "--sweep is given twice"},
    {"JsonTwice", {"plan", "--json", "a.json", "--json", "b.json"}, 2, "--json is given twice"},
    {"JsonTwiceInTwoSpellings", {"plan", "--json", "--json=b.json"}, 2, "--json is given twice"},
    {"OutTwice", {"render", "-o", "a.png", "--out", "b.png"}, 2, "--out is given twice"},
    {"TwoScenesAroundAPreset", {"render", "rts", "--preset", "demo", "planes"}, 2, "one argument too many"},
    {"UnknownPreset", {"render", "--preset", "demmo"}, 2, "did you mean \"demo\""},
    {"BrokenPreset", {"render", "--preset", "broken.json"}, 2, "not a JSON object"},
    {"PresetWithUnknownKey", {"render", "--preset", "wrong.json"}, 2, "did you mean \"filter\""},
    {"PresetIsAFolder", {"render", "--preset", "a_folder"}, 1, "directory"},
    {"UnknownLimit", {"render", "--limit", "nodes=4"}, 2, "node-depth"},
    {"LimitWithoutNumber", {"render", "--limit", "count=many"}, 2, "whole number"},
    {"SizeZero", {"render", "--size", "0x0"}, 2, "1 to 1"},
    {"SizeOneZero", {"render", "--size", "10x0"}, 2, "1 to 1"},
    {"SizeNegative", {"render", "--size", "-5x5"}, 2, "--size"},
    {"SizeOneNumber", {"render", "--size", "100"}, 2, "WxH"},
    {"SizeBeyondDevice", {"render", "planes", "--size", "100000x100000"}, 1, "at most"},
    {"MapZero", {"render", "--map-size", "0"}, 2, "16 to 16384"},
    {"MapTooLarge", {"render", "--map-size", "16385"}, 2, "16 to 16384"},
    {"MapNotWhole", {"render", "--map-size", "512.5"}, 2, "whole number"},
    {"SunZero", {"render", "--sun", "0,0,0"}, 2, "the direction is zero"},
    {"SunNan", {"render", "--sun", "nan,1,0"}, 2, "finite"},
    {"SunInfinite", {"render", "--sun", "0,-inf,0"}, 2, "finite"},
    {"SunTwoNumbers", {"render", "--sun", "1,2"}, 2, "3 numbers"},
    {"SunOverflow", {"render", "--sun", "1e999,0,0"}, 2, "finite"},
    {"SpotAtItsTarget", {"render", "--spot", "1,2,3,1,2,3,40"}, 2, "direction is zero"},
    {"SpotTooWide", {"render", "--spot", "0,5,0,0,0,0,200"}, 2, "0.1 to 180"},
    {"PointWithoutReach", {"render", "--point", "0,5,0,0"}, 2, "not above 0"},
    {"PointAndABit", {"render", "--point", "0,5,0,20,1"}, 2, "not four for each light"},
    {"SecondPointWithoutReach", {"render", "--point", "0,5,0,20,1,5,0,0"}, 2, "not above 0"},
    {"PointInOneFrustum", {"render", "--point", "0,5,0,20", "--partition", "single"}, 2, "--point"},
    {"EyeIsTarget", {"render", "--eye", "1,2,3", "--target", "1,2,3"}, 2, "same point"},
    {"EyeNan", {"render", "--eye", "nan,2,3", "--target", "1,2,3"}, 2, "finite"},
    {"EyeAlone", {"render", "--eye", "1,2,3"}, 2, "--eye needs --target"},
    {"TargetAlone", {"render", "--target", "1,2,3"}, 2, "--target needs --eye"},
    {"UpIsZero", {"render", "--eye", "1,2,3", "--target", "0,0,0", "--up", "0,0,0"}, 2, "direction is zero"},
    {"UpAlongTheView", {"render", "--eye", "0,5,0", "--target", "0,0,0"}, 2, "parallel"},
    {"CameraAndEye", {"render", "--camera", "camp", "--eye", "1,2,3", "--target", "0,0,0"}, 2, "give one"},
    {"UnknownCamera", {"plan", "rts", "--camera", "cammp"}, 2, "did you mean \"camp\""},
    {"FovZero", {"render", "--fov", "0"}, 2, "0.1 to 179"},
    {"FovHalfTurn", {"render", "--fov", "180"}, 2, "0.1 to 179"},
    {"TimeNan", {"render", "--time", "nan"}, 2, "finite"},
    {"FramesBackwards", {"render", "--frames", "5-2"}, 2, "backwards"},
    {"FramesOneNumber", {"render", "--frames", "5"}, 2, "A-B"},
    {"FpsZero", {"render", "--frames", "1-2", "--fps", "0"}, 2, "0.001"},
    {"UnknownLight", {"render", "planes", "--mask", "--light", "sunn"}, 2, "did you mean \"sun\""},
    {"BiasNonsense", {"render", "--bias", "lots"}, 2, "auto, none or"},
    {"BiasPartNotANumber", {"render", "--bias", "constant=x"}, 2, "finite number"},
    {"BiasUnknownPart", {"render", "--bias", "depth=1"}, 2, "auto, none or"},
    {"BiasPartTwice", {"render", "--bias", "constant=1,constant=2"}, 2, "gives constant twice"},
    {"UnknownTruth", {"render", "--truth", "soft"}, 2, "it takes hard and area"},
    {"TruthOfAnother", {"plan", "--truth", "hard"}, 2, "--truth is not an option of plan"},
    {"SamplesNotInSets", {"render", "--truth", "area", "--samples", "63"}, 2, "63 is not a multiple of 4"},
    {"SamplesTooFew", {"render", "--truth", "area", "--samples", "0"}, 2, "4 to 65536"},
    {"SamplesTooMany", {"compare", "--samples", "65540"}, 2, "4 to 65536"},
    {"SunAngleNegative", {"render", "--truth", "area", "--sun-angle", "-1"}, 2, "0 to 90"},
    {"SunAngleTooWide", {"render", "--truth", "area", "--sun-angle", "91"}, 2, "0 to 90"},
    {"LightSizeNegative", {"render", "--truth", "area", "--light-size=-1"}, 2, "0 to 1"},
    {"TruthTooLarge", {"render", "--truth", "hard", "--mask", "--size", "16385x1"}, 1, "at most 16384 on a side"},
    {"UnknownGpu", {"render", "planes", "--gpu", "Voodoo2"}, 1, "Voodoo2"},
    {"UnknownAnimation", {"plan", "planes", "--animation", "dance"}, 2, "no \"dance\""},
    {"SceneMissing", {"render", "missing.gltf"}, 1, "missing.gltf"},
    {"SceneIsAFolder", {"render", "a_folder"}, 1, "a_folder"},
    {"SceneBroken", {"render", "broken.gltf"}, 1, "broken.gltf"},
    {"SceneEmptyName", {"render", ""}, 1, ""},
    {"OutIsAFolder", {"render", "planes", "-o", "a_folder"}, 1, "directory"},
    {"OutInNoFolder", {"render", "planes", "-o", "none/a.png"}, 1, "no folder"},
    {"OutWithoutExtension", {"render", "planes", "-o", "picture.jpg"}, 2, ".png"},
    {"OutIsFullDevice", {"plan", "planes", "--json=/dev/full"}, 1, "No space left"},
    {"JsonFileOfAnotherName",
     {"plan", "planes", "--json", "out.txt"},
     2,
     "must end in .json or be given as --json=out"},
    {"MaskWithoutMap",
     {"render", "lights.gltf", "--mask", "--light", "Lamp", "--partition", "single"},
     1,
     "mask of light light0"},
    {"FramesToAFile", {"render", "planes", "--frames", "0-1", "-o", "broken.json"}, 1, "not a folder"},
    {"ListOfASubcommand", {"list", "render"}, 2, "see `gnomon render --help`"},
    {"ListOfTwo", {"list", "msm", "vsm"}, 2, "one argument too many"},
    {"ListJsonOfAnotherName", {"list", "--json", "out.txt"}, 2, "must end in .json"},
    {"CompletionOfNoShell", {"completion"}, 2, "bash, zsh and fish"},
    {"CompletionOfAnUnknownShell", {"completion", "bsh"}, 2, "did you mean \"bash\""},
    {"CompletionOfBoth", {"completion", "bash", "--", "ren"}, 2, "give one"},
    {"ManOfSomething", {"man", "render"}, 2, "man takes no argument"},
    {"StrictInAPreset", {"render", "--preset", "strict.json"}, 2, "strict is of this run alone"}};

class WrongUsage : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUsage, IsOneLineAndLeavesNothing)
{
    test::expectOneLineAndNothingLeft(GetParam(), true);
}

INSTANTIATE_TEST_SUITE_P(Table, WrongUsage, testing::ValuesIn(kWrong),
                         [](const auto& test) { return std::string(test.param.name); });

/// Wrong uses of the built program.
class WrongUsageOfTheProgram : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUsageOfTheProgram, IsOneLineAndLeavesNothing)
{
    test::expectOneLineAndNothingLeft(GetParam(), false);
}

std::vector<Wrong> tenOfTheTable()
{
    std::vector<Wrong> ten;
    for (std::size_t i = 0; i < 10; ++i) {
        ten.push_back(kWrong[i * kWrong.size() / 10]);
    }
    return ten;
}

INSTANTIATE_TEST_SUITE_P(Ten, WrongUsageOfTheProgram, testing::ValuesIn(tenOfTheTable()),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace gnomon
