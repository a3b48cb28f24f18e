// SPDX-License-Identifier: Apache-2.0
// What can be done wrong: one clear line on stderr, the right exit status, nothing left behind.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"

#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

struct Wrong {
    const char* name;
    std::vector<std::string> arguments;
    int status;
    std::string says; // part of the line
};

/// What googletest prints of a failed case, instead of its bytes.
void PrintTo(const Wrong& wrong, std::ostream* out)
{
    for (const std::string& argument : wrong.arguments) {
        *out << argument << ' ';
    }
}

class WrongUsage : public testing::TestWithParam<Wrong> {};

void expectOneLine(const test::Ran& ran, int status, const std::string& says)
{
    EXPECT_EQ(ran.status, status) << ran.err;
    EXPECT_EQ(ran.out, "");
    const auto lines = ran.errorLines();
    ASSERT_EQ(lines.size(), 1U) << ran.err;
    EXPECT_TRUE(lines[0].starts_with("gnomon: ")) << lines[0];
    EXPECT_NE(lines[0].find(says), std::string::npos) << lines[0];
}

void expectOneLineAndNothingLeft(const Wrong& wrong, bool in_process)
{
    const test::Folder folder;
    fs::create_directory(folder / "a_folder");
    test::spill(folder / "broken.gltf", "{ not json");
    test::spill(folder / "broken.json", "[1, 2");
    test::spill(folder / "wrong.json", R"({"filtre": "hard"})");
    test::spill(folder / "lights.gltf", test::kLightsAndCameras);
    const std::size_t before = folder.names().size();
    expectOneLine(test::gnomon(wrong.arguments, {.folder = folder.path(), .in_process = in_process}), wrong.status,
                  wrong.says);
    EXPECT_EQ(folder.names().size(), before);
}

TEST_P(WrongUsage, IsOneLineAndLeavesNothing)
{
    expectOneLineAndNothingLeft(GetParam(), true);
}

/// The same of the built program.
class WrongUsageOfTheProgram : public testing::TestWithParam<Wrong> {};

TEST_P(WrongUsageOfTheProgram, IsOneLineAndLeavesNothing)
{
    expectOneLineAndNothingLeft(GetParam(), false);
}

const std::vector<Wrong> kWrong{
    {"UnknownSubcommand", {"rendr"}, 2, "did you mean \"render\""},
    {"ViewIsNotHere", {"view"}, 2, "not in this version"},
    {"OptionBeforeSubcommand", {"--size", "10x10", "render"}, 2, "a subcommand comes first"},
    {"UnknownOption", {"render", "--fliter", "hard"}, 2, "did you mean \"--filter\""},
    {"UnknownShortOption", {"render", "-z"}, 2, "no option -z"},
    {"OptionOfAnother", {"plan", "--mask"}, 2, "--mask is not an option of plan"},
    {"SetOnlyOption", {"render", "--pcf.kernel", "3x3"}, 2, "--set pcf.kernel=VALUE"},
    {"MissingValue", {"render", "--size"}, 2, "--size"},
    {"TooManyScenes", {"render", "planes", "rts"}, 2, "one argument too many"},
    {"HelpOfOneSubcommand", {"help", "list", "render"}, 2, "one argument too many"},
    {"VersionOfNothing", {"--version", "list"}, 2, "one argument too many"},
    {"ListTakesNoScene", {"list", "rts"}, 2, "takes no argument"},

    {"UnknownFilter", {"render", "--filter", "pfc"}, 2, "did you mean \"pcf\""},
    {"SmoothiesOverMoments", {"render", "--filter", "vsm", "--soften", "smoothies"}, 2, "smoothies lie beside a map"},
    {"FinsAndSmoothies", {"render", "--filter", "smoothies", "--soften", "smoothies"}, 2, "have a softness of"},
    {"FinsInAParaboloid",
     {"render", "--filter", "smoothies", "--partition", "paraboloid"},
     2,
     "paraboloid bends straight lines"},
    {"FinsInSharedTexels", {"render", "--filter", "smoothies", "--map-format", "rg16"}, 2, "its texels for itself"},
    {"ReachOfHard", {"render", "--filter", "hard", "--set", "smoothies.reach=8"}, 2, "filter or soften smoothies"},
    {"NoValue", {"render", "planes", "--filter"}, 2, "--filter needs a value"},
    {"SunAngleWithoutASun", {"render", "spotlit", "--sun-angle", "3"}, 2, "only on a directional light"},
    {"LightSizeWithoutALamp", {"plan", "sundial", "--light-size", "1"}, 2, "only on a spot or point light"},
    {"LayersOfHeightOfALamp",
     {"compare", "spotlit", "--size", "64x36", "--techniques", "lvsm+lvsm.placement=world"},
     1,
     "layers of height are layers of depth under parallel light alone"},
    {"OverWOfASun",
     {"render", "planes", "--sun", "1,-3,-1", "--filter", "hard", "--fit", "uniform", "--set", "depth-metric=z-over-w"},
     2,
     "a sun has none"},
    {"OverWInAWarp",
     {"render", "spotlit", "--filter", "hard", "--fit", "lispsm", "--set", "depth-metric=z-over-w"},
     2,
     "needs fit uniform"},
    {"IdsByTurns", {"render", "planes", "--filter", "id", "--set", "draw-budget=4096"}, 2, "a light that waits"},
    {"MultiUnderASteppingSun",
     {"render", "--partition", "multi", "--motion", "step-jump"},
     2,
     "it needs motion free or snap"},
    {"TexelsOfMultiElsewhere",
     {"render", "--partition", "cube", "--set", "multi.texels-per-pixel=2"},
     2,
     "only with partition multi"},
    {"SdsmHeldStill", {"render", "--partition", "sdsm", "--motion", "snap"}, 2, "needs motion free"},
    {"CascadesThatDoNotAscend", {"render", "--partition", "cascades", "--set", "cascades.ends=40/10"}, 2, "ascend"},
    {"CompactMaskOfAMask", {"render", "planes", "--mask", "--set", "compact-mask=8"}, 2, "has an effect only"},
    {"CompactMaskOfFramesThatConverge",
     {"render", "planes", "--soften", "converge", "--set", "compact-mask=8"},
     2,
     "has an effect only"},
    {"TilesOfNoCompactMask", {"render", "planes", "--set", "compact-mask.side=32"}, 2, "compact-mask=4 or 8"},
    {"AveragesOfAParaboloid",
     {"render", "--partition", "paraboloid", "--filter", "vsm"},
     2,
     "needs filter hard, pcf or auto"},
    {"CascadesOfACube", {"render", "--partition", "cube", "--set", "cascades.count=2"}, 2, "has an effect only"},
    {"CascadesOfASingleMap",
     {"render", "--partition", "single", "--set", "cascades.count=2"},
     2,
     "only with partition cascades"},
    {"UnknownCascadePass", {"render", "--partition", "cascades", "--set", "cascades.pass=multiview"}, 2, "layered"},
    {"CascadePassOfASingleMap",
     {"render", "--partition", "single", "--set", "cascades.pass=layered"},
     2,
     "only with filter hard or pcf and"},
    {"CascadePassOfAverages",
     {"render", "--filter", "vsm", "--partition", "cascades", "--set", "cascades.pass=layered"},
     2,
     "made one by one"},
    {"FadeWithoutAnEnd", {"render", "--set", "fade=0.2"}, 2, "only with max-distance above 0"},
    {"BlurNotAsked", {"render", "--set", "soften.kernel=box"}, 2, "only with soften blur"},
    {"BlurPublishedWithEdges", {"render", "--soften", "blur", "--set", "soften.taps=published"}, 2, "knows no edges"},
    {"BlurOnACompactMask", {"render", "planes", "--soften", "blur", "--set", "compact-mask=8"}, 2, "soften=none"},
    {"HalfMaskOfVolumes", {"render", "planes", "--filter", "volumes", "--set", "mask-size=half"}, 2, "volumes"},
    {"HalfMaskOfFramesThatConverge",
     {"render", "planes", "--soften", "converge", "--set", "mask-size=half"},
     2,
     "take mask-size full"},
    {"HalfMaskOnACompactMask",
     {"render", "planes", "--set", "compact-mask=8", "--set", "mask-size=half"},
     2,
     "mask-size=full"},
    {"HalfMaskForward", {"render", "planes", "--shading", "forward", "--set", "mask-size=half"}, 1, "is of a mask"},
    {"RaysOfAHalfMask",
     {"render", "planes", "--filter", "raymarch", "--debug", "rays", "--set", "mask-size=half"},
     2,
     "mask-size full"},
    {"ConeWithoutASpot", {"render", "rts", "--set", "spot.cone=30"}, 2, "only on a spot light"},
    {"FormatRefused", {"render", "--map-format", "rg16f"}, 2, "rg16f cannot be had with filter raymarch"},
    {"UnknownFormat", {"render", "--map-format", "d25"}, 2, "it takes"},
    {"UnknownSetting", {"render", "--set", "pcf.kernal=3x3"}, 2, "did you mean \"pcf.kernel\""},
    {"SettingWithoutValue", {"render", "--set", "pcf.kernel"}, 2, "not KEY=VALUE"},
    {"UnknownKernel", {"render", "--set", "pcf.kernel=9x9"}, 2, "3x3"},
    {"KernelOfHard", {"render", "--filter", "hard", "--set", "pcf.kernel=5x5"}, 2, "only with filter pcf"},
    {"TapsOfAGaussian",
     {"render", "--set", "pcf.taps=8"},
     2,
     "--set pcf.taps has an effect only with pcf.kernel poisson or vogel"},
    {"TooManyTaps",
     {"render", "--set", "pcf.kernel=vogel", "--set", "pcf.taps=65"},
     2,
     "--set pcf.taps: \"65\" is not in"},
    {"BlurOfHard", {"render", "--filter", "hard", "--set", "blur=box"}, 2, "only with filter vsm, lvsm, esm, evsm or"},
    {"UnknownBlur", {"render", "--filter", "vsm", "--set", "blur=median"}, 2, "it takes auto, none, gaussian and box"},
    {"SigmaOfABox",
     {"render", "--filter", "vsm", "--set", "blur=box", "--set", "blur.sigma=2"},
     2,
     "only with a filterable map and blur gaussian"},
    {"RadiusOfNoBlur",
     {"render", "--filter", "vsm", "--set", "blur=none", "--set", "blur.radius=2"},
     2,
     "only with a filterable map and blur gaussian or box"},
    {"SigmaTooWide", {"render", "--filter", "vsm", "--set", "blur.sigma=10.1"}, 2, "0.3 to 10 texels"},
    {"RadiusTooWide", {"render", "--filter", "vsm", "--set", "blur.radius=32"}, 2, "1 to 31 texels"},
    {"RadiusZero", {"render", "--filter", "vsm", "--set", "blur.radius=0"}, 2, "1 to 31 texels"},
    {"SamplesOfAMap", {"render", "--filter", "vsm", "--set", "msaa=2"}, 2, "it takes 1 and 4"},
    {"AnisotropyOfTrilinear",
     {"render", "--filter", "vsm", "--set", "anisotropy=4"},
     2,
     "only with map-sampling aniso"},
    {"VarianceOfEsm", {"render", "--filter", "esm", "--set", "min-variance=0.1"}, 2, "only with filter vsm, lvsm or"},
    {"LayersOfVsm", {"render", "--filter", "vsm", "--set", "lvsm.layers=3"}, 2, "only with filter lvsm"},
    {"LayersTooMany", {"render", "--filter", "lvsm", "--set", "lvsm.layers=9"}, 2, "2 to 8 layers"},
    {"SplitsTooMany", {"render", "--filter", "lvsm", "--set", "lvsm.splits=.1/.2"}, 2, "need 1 of them; 2 are given"},
    {"SplitsMissing", {"render", "--filter", "lvsm", "--set", "lvsm.placement=hand"}, 2, "need 1 of them; 0 are given"},
    {"SplitsWithCommas", {"render", "--filter", "lvsm", "--set", "lvsm.splits=.1,.2"}, 2, "with / between"},
    {"SplitsBackwards",
     {"render", "--filter", "lvsm", "--set", "lvsm.layers=3", "--set", "lvsm.splits=.5/.2"},
     2,
     "meet at ascending depths between 0 and 1"},
    {"SplitsNan", {"render", "--filter", "lvsm", "--set", "lvsm.splits=nan"}, 2, "finite"},
    {"SplitsOfLloyd",
     {"render", "--filter", "lvsm", "--set", "lvsm.splits=.5", "--set", "lvsm.placement=lloyd"},
     2,
     "lvsm.splits are of layers placed by hand, not of lvsm.placement lloyd"},
    {"SplitsOfLloydInATechnique", {"bench", "--techniques", "lvsm+lvsm.placement=lloyd+lvsm.splits=.5"}, 2, "by hand"},
    {"ExponentTooLarge",
     {"render", "--filter", "esm", "--set", "esm.exponent=90"},
     2,
     "exponent 90 would overflow r32f, which holds up to 88"},
    {"WarpTooLarge",
     {"render", "--filter", "evsm", "--map-format", "rgba16f", "--set", "evsm.negative=6"},
     2,
     "negative exponent 6 would overflow rgba16f, which holds up to 5.54"},
    {"WarpThatIsNotStored",
     {"render", "--filter", "evsm", "--map-format", "rg32f", "--set", "evsm.negative=5"},
     2,
     "only with filter evsm and four channels"},
    {"LogSpaceOfVsm", {"render", "--filter", "vsm", "--set", "log-space=1"}, 2, "only with filter esm or evsm"},
    {"RemapOfUnorm",
     {"render", "--filter", "lvsm", "--set", "depth-remap=1"},
     2,
     "filter lvsm with map-format rgba16: rgba16 holds 0 to 1 only"},
    {"RemapInATechnique", {"compare", "--techniques", "lvsm+depth-remap=1"}, 2, "rgba16 holds 0 to 1 only"},
    {"FormatOfVsm", {"render", "--filter", "vsm", "--map-format", "rgba16"}, 2, "rgba16 cannot be had with filter vsm"},
    {"OptionOfNoContestant", {"bench", "--techniques", "hard,pcf", "--set", "msaa=1"}, 2, "only with filter vsm"},
    {"ReportTwice", {"compare", "--report", "a", "--report", "b"}, 2, "--report is given twice"},
    {"SweepTwice", {"compare", "--sweep", "map-size=64:128:2", "--sweep", "fov=20:40:2"}, 2, "--sweep is given twice"},
    {"JsonTwice", {"plan", "--json", "a.json", "--json", "b.json"}, 2, "--json is given twice"},
    {"JsonTwiceInTwoSpellings", {"plan", "--json", "--json=b.json"}, 2, "--json is given twice"},
    {"OutTwice", {"render", "-o", "a.png", "--out", "b.png"}, 2, "--out is given twice"},
    {"TwoScenesAroundAPreset", {"render", "rts", "--preset", "demo", "planes"}, 2, "one argument too many"},
    {"UnknownTechnique", {"bench", "--techniques", "hard,pcv"}, 2, "did you mean \"pcf\""},
    {"TechniqueTwice", {"bench", "--techniques", "hard+pcf"}, 2, "gives filter twice"},
    {"NoTechniqueSetting", {"bench", "--techniques", "hard+size=3x3"}, 2, "no part of a technique"},
    {"TechniqueListedTwice", {"bench", "--techniques", "hard,pcf,hard"}, 2, "hard is listed twice"},
    {"TechniqueListedInTwoOptions", {"bench", "--techniques", "hard", "--techniques", "hard"}, 2, "listed twice"},
    {"TechniqueInTwoSpellings", {"bench", "--techniques", "pcf,pcf+pcf.kernel=3x3"}, 2, "are the same technique"},
    {"NumberInTwoSpellings",
     {"bench", "--techniques", "vsm+lighten=0.5,vsm+lighten=0.50"},
     2,
     "are the same technique"},
    {"DefaultInAnotherSpelling", {"bench", "--techniques", "vsm,vsm+blur.sigma=1.250"}, 2, "are the same technique"},
    {"BiasInTwoSpellings",
     {"bench", "--techniques", "hard+bias=constant=0.1,hard+bias=constant=0.10"},
     2,
     "are the same technique"},
    {"FormatOfAPreset",
     {"render", "--preset", "rts-2011", "--filter", "vsm"},
     2,
     "preset rts-2011: map-format rgba16 cannot be had with filter vsm: "},
    {"FormatOfAPresetSaysWhatToDo", {"render", "--preset", "rts-2011", "--filter", "vsm"}, 2, "; add --map-format"},
    {"FormatTypedAfterAPreset",
     {"render", "--preset", "rts-2011", "--filter", "vsm", "--map-format", "rgba16"},
     2,
     "--map-format: rgba16 cannot be had with filter vsm"},
    {"RemapOfMsm",
     {"render", "--filter", "msm", "--set", "depth-remap=1"},
     2,
     "has an effect only with filter vsm, lvsm"},
    {"SizeOfNoMap",
     {"render", "--filter", "volumes", "--map-size", "512"},
     2,
     "--map-size has an effect only with every filter but volumes"},
    {"BiasOfNoMap", {"render", "--filter", "volumes", "--bias", "none"}, 2, "only with every filter but volumes"},
    {"BiasOfIds", {"render", "--filter", "id", "--bias", "none"}, 2, "--bias has an effect only with every filter but"},
    {"BiasOfIdsInATechnique",
     {"bench", "--techniques", "id+bias.slope=1"},
     2,
     "bias.slope has an effect only with every filter but volumes and id, and no id.bias"},
    {"BiasBesideTheObjectsOwn",
     {"bench", "--techniques", "depth-id+id.bias=0.1+bias.constant=0.1"},
     2,
     "bias.constant has an effect only with"},
    {"CascadesOfNoMap",
     {"render", "--filter", "volumes", "--partition", "cascades"},
     2,
     "volumes has no maps, so there are no frustums"},
    {"FormatOfNoMap", {"render", "--filter", "volumes", "--map-format", "d16"}, 2, "nothing is stored in texels"},
    {"OpenOfAMap", {"render", "--filter", "hard", "--set", "volumes.open=skip"}, 2, "only with filter volumes"},
    {"DebugOfNoMap",
     {"render", "--filter", "volumes", "--debug", "map"},
     2,
     "has an effect only with a technique that has a map"},
    {"TechniqueEmpty", {"bench", "--techniques", "hard,,pcf"}, 2, "a comma with no technique"},
    {"AllAndOthers", {"bench", "--techniques", "all,hard"}, 2, "all stands alone"},
    {"TechniqueIsALight", {"bench", "--techniques", "directional"}, 2, "no \"directional\"; a technique is"},
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
    {"MaskWithFxaa", {"render", "--mask", "--aa", "fxaa"}, 2, "not with --mask"},
    {"SpotAtItsTarget", {"render", "--spot", "1,2,3,1,2,3,40"}, 2, "direction is zero"},
    {"SpotTooWide", {"render", "--spot", "0,5,0,0,0,0,150"}, 2, "0.1 to 120"},
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
    {"FpsAlone", {"render", "--fps", "10"}, 2, "only with --frames"},
    {"UnknownLight", {"render", "planes", "--mask", "--light", "sunn"}, 2, "did you mean \"sun\""},
    {"LightWithoutMask", {"render", "--light", "sun"}, 2, "only with --mask"},
    {"BiasNonsense", {"render", "--bias", "lots"}, 2, "auto, none or"},
    {"BiasPartNotANumber", {"render", "--bias", "constant=x"}, 2, "finite number"},
    {"BiasUnknownPart", {"render", "--bias", "depth=1"}, 2, "auto, none or"},
    {"BiasPartTwice", {"render", "--bias", "constant=1,constant=2"}, 2, "gives constant twice"},
    {"UnknownTruth", {"render", "--truth", "soft"}, 2, "it takes hard and area"},
    {"TruthOfAnother", {"plan", "--truth", "hard"}, 2, "--truth is not an option of plan"},
    {"SamplesWithoutTruth", {"render", "--samples", "64"}, 2, "--samples has an effect only with --truth area"},
    {"SamplesOfHardTruth", {"render", "--truth", "hard", "--samples", "64"}, 2, "only with --truth area"},
    {"SamplesNotInSets", {"render", "--truth", "area", "--samples", "63"}, 2, "63 is not a multiple of 4"},
    {"SamplesTooFew", {"render", "--truth", "area", "--samples", "0"}, 2, "4 to 65536"},
    {"SamplesTooMany", {"compare", "--samples", "65540"}, 2, "4 to 65536"},
    {"NoCacheWithoutTruth", {"render", "--no-cache"}, 2, "--no-cache has an effect only with --truth"},
    {"SunAngleWithoutTruth",
     {"render", "--filter", "hard", "--sun-angle", "1"},
     2,
     "--sun-angle has an effect only with --truth area"},
    {"SunAngleOfHardTruth", {"render", "--truth", "hard", "--sun-angle", "1"}, 2, "only with --truth area"},
    {"SunAngleNegative", {"render", "--truth", "area", "--sun-angle", "-1"}, 2, "0 to 90"},
    {"SunAngleTooWide", {"render", "--truth", "area", "--sun-angle", "91"}, 2, "0 to 90"},
    {"SunAngleOfAPointLight",
     {"render", "lights.gltf", "--truth", "area", "--mask", "--sun-angle", "1"},
     2,
     "only on a directional light"},
    {"LightSizeWithoutTruth",
     {"render", "--filter", "hard", "--light-size=1"},
     2,
     "--light-size has an effect only with --truth area"},
    {"LightSizeNegative", {"render", "--truth", "area", "--light-size=-1"}, 2, "0 to 1"},
    {"LightSizeOfASun",
     {"render", "planes", "--sun", "1,-1,0", "--truth", "area", "--mask", "--light-size", "1"},
     2,
     "only on a spot or point light"},
    {"FilterWithTruth", {"render", "--truth", "hard", "--filter", "hard"}, 2, "--filter has no effect with --truth"},
    {"KernelWithTruth", {"render", "--truth", "hard", "--set", "pcf.kernel=2x2"}, 2, "no effect with --truth"},
    {"GpuWithTruthsMask", {"render", "--truth", "hard", "--mask", "--gpu", "x"}, 2, "only with something to draw"},
    {"AaWithTruthsMask", {"render", "--truth", "hard", "--mask", "--aa", "ssaa4"}, 2, "only with something to draw"},
    {"TruthTooLarge", {"render", "--truth", "hard", "--mask", "--size", "16385x1"}, 1, "at most 16384 on a side"},
    {"SweepOfAnother", {"bench", "--sweep", "map-size=64:128:2"}, 2, "--sweep is not an option of bench"},
    {"SweepWithoutSteps", {"compare", "--sweep", "map-size=64:128"}, 2, "KEY=FROM:TO:STEPS"},
    {"SweepOfNothing", {"compare", "--sweep", "map-size"}, 2, "KEY=FROM:TO:STEPS"},
    {"SweepOddEnd", {"compare", "--sweep", "map-size=64:128:2:lin"}, 2, "KEY=FROM:TO:STEPS"},
    {"SweepUnknown", {"compare", "--sweep", "map-sise=64:128:2"}, 2, "did you mean \"map-size\""},
    {"SweepOfAChoice", {"compare", "--sweep", "pcf.kernel=2:3:2"}, 2, "no number that errors depend on"},
    {"SweepOfTimes", {"compare", "--sweep", "repetitions=4:8:2"}, 2, "no number that errors depend on"},
    {"SweepOfAnothersNumber", {"compare", "--sweep", "repetitions=4:8:2"}, 2, "no number that errors depend on"},
    {"SweepOfHardTruthsSamples",
     {"compare", "--truth", "hard", "--sweep", "samples=4:8:2"},
     2,
     "samples has an effect only with --truth area"},
    {"SweepOfNoMultiples", {"compare", "--sweep", "samples=4:10:2"}, 2, "samples takes multiples of 4"},
    {"SweepOfTooFewMultiples", {"compare", "--sweep", "samples=4:12:4"}, 2, "samples has only 3 values from 4 to 12"},
    {"SweepOfAnotherLightsSize",
     {"compare", "planes", "--sun", "1,-1,0", "--sweep", "light-size=0:1:2"},
     2,
     "--light-size has an effect only on a spot or point light"},
    {"SweepBeyondRange", {"compare", "--sweep", "map-size=8:128:2"}, 2, "\"8\" is not in the range 16 to 16384"},
    {"SweepNan", {"compare", "--sweep", "pcf.radius=nan:2:2"}, 2, "not in the range"},
    {"SweepNotWhole", {"compare", "--sweep", "map-size=64.5:128:2"}, 2, "whole numbers"},
    {"SweepOneStep", {"compare", "--sweep", "map-size=64:128:1"}, 2, "2 to 1000"},
    {"SweepOnTheSpot", {"compare", "--sweep", "map-size=64:64:2"}, 2, "same value"},
    {"SweepTooFine", {"compare", "--sweep", "pcf.taps=4:8:6"}, 2, "pcf.taps has only 5 values"},
    {"SweepLogOfZero", {"compare", "--sweep", "bias.slope=0:2:3:log"}, 2, "above 0"},
    {"SweepAndTheOption", {"compare", "--map-size", "64", "--sweep", "map-size=64:128:2"}, 2, "give one"},
    {"MetricsOfNothing", {"metrics"}, 2, "two images, the test and the truth; 0 are given"},
    {"MetricsOfOne", {"metrics", "a.png"}, 2, "one is given"},
    {"MetricsOfThree", {"metrics", "a.png", "b.png", "c.png"}, 2, "3 are given"},
    {"MetricsWithAScenesOption", {"metrics", "a.png", "b.png", "--size", "8x8"}, 2, "not an option of metrics"},
    {"MetricsWithAPreset", {"metrics", "a.png", "b.png", "--preset", "demo"}, 2, "not an option of metrics"},
    {"ListWithASetting", {"list", "--set", "map-size=64"}, 2, "--set is not an option of list"},
    {"MetricsJsonOfAnotherName", {"metrics", "a.png", "b.png", "--json", "out.txt"}, 2, "no image, and a file"},
    {"MetricsMissing", {"metrics", "a.png", "b.png"}, 1, "a.png"},
    {"MetricsOfAFolder", {"metrics", "a_folder", "b.png"}, 1, "a_folder"},
    {"MetricsOfText", {"metrics", "broken.json", "broken.json"}, 1, "neither a PNG nor an EXR"},

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
    {"BenchJsonIsAFolder", {"bench", "planes", "--json=a_folder"}, 1, "directory"},
};

std::vector<Wrong> tenOfTheTable()
{
    std::vector<Wrong> ten;
    for (std::size_t i = 0; i < 10; ++i) {
        ten.push_back(kWrong[i * kWrong.size() / 10]);
    }
    return ten;
}

const auto kNameOfCase = [](const auto& test) {
    return std::string(test.param.name);
};
INSTANTIATE_TEST_SUITE_P(Table, WrongUsage, testing::ValuesIn(kWrong), kNameOfCase);
INSTANTIATE_TEST_SUITE_P(Ten, WrongUsageOfTheProgram, testing::ValuesIn(tenOfTheTable()), kNameOfCase);

TEST(OutsideWorld, NoVulkanDriver)
{
    const test::Folder folder;
    const test::How how{
        .folder = folder.path(),
        .environment = {{"VK_ICD_FILENAMES", "/nonexistent.json"}, {"VK_DRIVER_FILES", "/nonexistent.json"}}};
    expectOneLine(test::gnomon({"render", "planes"}, how), 1, "no Vulkan driver is installed");
    EXPECT_TRUE(folder.names().empty());
}

TEST(OutsideWorld, FileSizeLimit)
{
    const test::Folder folder;
    const test::Ran ran =
        test::gnomon({"render", "planes", "--size", "320x240"}, {.folder = folder.path(), .max_file_bytes = 512});
    expectOneLine(ran, 1, "too large");
    EXPECT_TRUE(folder.names().empty());
}

TEST(OutsideWorld, FullDisk)
{
    const test::Folder folder;
    if (mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=8k") != 0) {
        GTEST_SKIP() << "may not mount a small file system here";
    }
    const test::Ran one = test::gnomon({"render", "planes", "--size", "320x240"}, {.folder = folder.path()});
    const test::Ran many =
        test::gnomon({"render", "planes", "--size", "320x240", "--frames", "0-1"}, {.folder = folder.path()});
    const auto left = folder.names();
    umount(folder.path().c_str());
    expectOneLine(one, 1, "No space left");
    expectOneLine(many, 1, "No space left");
    EXPECT_TRUE(left.empty());
}

TEST(OutsideWorld, FullStandardOutput)
{
    const test::Folder folder;
    const test::Ran ran = test::gnomon({"list"}, {.folder = folder.path(), .out = test::Stream::full});
    expectOneLine(ran, 1, "standard output");
}

TEST(OutsideWorld, UnreadableScene)
{
    if (geteuid() == 0) {
        GTEST_SKIP() << "root may read everything";
    }
    const test::Folder folder;
    test::spill(folder / "a.gltf", "{}");
    chmod((folder / "a.gltf").c_str(), 0);
    expectOneLine(test::gnomon({"plan", "a.gltf"}, {.folder = folder.path()}), 1, "Permission denied");
}

} // namespace
} // namespace gnomon
