// SPDX-License-Identifier: Apache-2.0
// Compiled alone: it has a variable with the name of another source's function.
// Every option of the filterable maps: what it becomes, and that texts, presets and JSON bring it back.
#include "folder.h"

#include "app/command_line.h"
#include "app/preset.h"
#include "contestants.h"
#include "result_json.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon {
namespace {

app::Settings settingsOf(const std::vector<std::string>& arguments)
{
    return app::parseCommandLine(arguments).settings;
}

/// The settings of `plan planes --filter FILTER --set EACH`.
app::Settings set(const std::string& filter, const std::vector<std::string>& each)
{
    std::vector<std::string> arguments{"plan", "planes", "--filter", filter};
    for (const std::string& one : each) {
        arguments.insert(arguments.end(), {"--set", one});
    }
    return settingsOf(arguments);
}

app::Settings technique(const std::string& text)
{
    return app::parseTechnique(app::defaultSettings(), text);
}

TEST(MomentSettings, EachReachesTheLibrary)
{
    const MomentOptions shared =
        set("vsm", {"msaa=1", "blur=box", "blur.radius=7", "blur.path=fragment", "map-sampling=anisotropic",
                    "anisotropy=4", "depth-metric=z-over-w", "depth-remap=1", "min-variance=0.25",
                    "derivative-variance=1", "bleeding.linstep=0.5", "bleeding.power=2"})
            .shadow.moments;
    EXPECT_EQ(shared.samples, 1U);
    EXPECT_EQ(shared.blur, BlurKind::box);
    EXPECT_EQ(shared.blur_radius_texels, 7U);
    EXPECT_EQ(shared.blur_path, BlurPath::fragment);
    EXPECT_EQ(shared.sampling, MapSampling::anisotropic);
    EXPECT_EQ(shared.anisotropy, 4U);
    EXPECT_EQ(shared.metric, DepthMetricKind::z_over_w);
    EXPECT_TRUE(shared.remap);
    EXPECT_EQ(shared.min_variance, 0.25F);
    EXPECT_TRUE(shared.derivative_variance);
    EXPECT_EQ(shared.bleeding_linstep, 0.5F);
    EXPECT_EQ(shared.bleeding_power, 2.0F);
    EXPECT_EQ(set("vsm", {"lighten=0.75"}).shadow.lighten, 0.75F);
    EXPECT_EQ(set("hard", {"lighten=0.75", "lighten.as=add"}).shadow.lighten_as, LightenAs::add);
    EXPECT_EQ(set("msm", {"blur.sigma=2.5"}).shadow.moments.blur_sigma_texels, 2.5F);

    const MomentOptions layers =
        set("lvsm", {"lvsm.splits=0.25/0.5", "lvsm.layers=3", "lvsm.overlap=0.125"}).shadow.moments;
    EXPECT_EQ(layers.layers, 3U);
    EXPECT_EQ(layers.placement, LayerPlacement::by_hand);
    EXPECT_EQ(layers.splits, (std::array<float, 7>{0.25F, 0.5F}));
    EXPECT_EQ(layers.layer_overlap, 0.125F);
    EXPECT_EQ(set("lvsm", {"lvsm.placement=uniform"}).shadow.moments.placement, LayerPlacement::uniform);

    EXPECT_EQ(set("esm", {"esm.exponent=30"}).shadow.moments.esm_exponent, 30.0F);
    const MomentOptions evsm = set("evsm", {"log-space=1", "evsm.positive=60", "evsm.negative=7"}).shadow.moments;
    EXPECT_TRUE(evsm.log_space);
    EXPECT_EQ(evsm.evsm_positive, 60.0F);
    EXPECT_EQ(evsm.evsm_negative, 7.0F);
    const MomentOptions msm = set("msm", {"msm.solver=hausdorff", "msm.bias=0.0625", "penumbra=light"}).shadow.moments;
    EXPECT_EQ(msm.solver, MomentSolver::hausdorff);
    EXPECT_EQ(msm.penumbra, MomentPenumbra::light);
    EXPECT_EQ(msm.moment_bias, 0.0625F);
}

TEST(MomentSettings, FiltersHaveTheirOwnFormatAndRoom)
{
    const std::pair<const char*, MapFormat> formats[] = {{"vsm", MapFormat::rg32f},
                                                         {"lvsm", MapFormat::rgba16},
                                                         {"esm", MapFormat::r32f},
                                                         {"evsm", MapFormat::rgba32f},
                                                         {"msm", MapFormat::rgba16}};
    for (const auto& [name, format] : formats) {
        const app::Settings settings = technique(name);
        EXPECT_EQ(formatOf(settings.shadow), format) << name;
        EXPECT_EQ(app::describeTechnique(settings), name); // neither is worth a word
    }
    EXPECT_GE(resolvedOrThrow(technique("vsm+blur.radius=20").shadow).border_texels(), 20.0);
    EXPECT_EQ(app::describeTechnique(technique("vsm+blur.radius=20")), "vsm+blur.radius=20");
    EXPECT_EQ(app::describeTechnique(technique("vsm+map-format=rg32f")), "vsm");
    EXPECT_EQ(app::describeTechnique(technique("vsm+map-format=rg16f")), "vsm+map-format=rg16f");
}

const char* const kTexts[] = {
    "vsm+map-format=rg16f+msaa=1+blur=box+blur.radius=7+blur.path=compute+map-sampling=anisotropic+anisotropy=16",
    "vsm+depth-metric=z-over-w+depth-remap=1+min-variance=0.001+derivative-variance=1",
    "vsm+lighten=0.65+blur.sigma=3.5+bleeding.linstep=0.2+bleeding.power=1.3",
    "vsm+blur=none+map-sampling=nearest",
    "lvsm+lvsm.layers=3+lvsm.splits=0.3/0.6+lvsm.overlap=0.1",
    "lvsm+lvsm.layers=8+lvsm.placement=uniform",
    "lvsm+lvsm.layers=3+lvsm.world=-2.5/8/10/40/40/90",
    "lvsm+lvsm.layers=3+lvsm.placement=world",
    "lvsm+lvsm.world=0/100/150/200+lvsm.axis=light",
    "pcf+lighten=0.5+lighten.as=add+pcf.kernel=3x3",
    "esm+log-space=1+esm.exponent=300",
    "esm+map-format=r16f+esm.exponent=9.5",
    "evsm+evsm.positive=20+evsm.negative=8",
    "evsm+map-format=rg32f+evsm.positive=41",
    "msm+msm.solver=hausdorff+msm.bias=5e-05",
};

TEST(MomentSettings, TextsComeBack)
{
    for (const char* text : kTexts) {
        EXPECT_EQ(app::describeTechnique(technique(text)), text);
    }
    EXPECT_EQ(app::describeTechnique(technique("lvsm+lvsm.placement=hand+lvsm.splits=0.5")), "lvsm+lvsm.splits=0.5");
    EXPECT_EQ(app::describeTechnique(technique("lvsm+lvsm.splits=0.5+lvsm.placement=hand")), "lvsm+lvsm.splits=0.5");
}

TEST(MomentSettings, ResultsComeBackAsPresets)
{
    const test::Folder folder;
    for (const char* text : kTexts) {
        const app::Settings settings = technique(text);
        test::spill(folder / "a.json", app::settingsJson(settings, app::kRender).dump());
        const app::Settings again = settingsOf({"render", "--preset", (folder / "a.json").string()});
        EXPECT_EQ(app::describeTechnique(again), text);
        EXPECT_EQ(again.shadow.moments.splits, settings.shadow.moments.splits);
    }
}

TEST(MomentSettings, APlacementSaidLaterTakesSplitsBack)
{
    const test::Folder folder;
    test::spill(folder / "a.json", R"({"filter": "lvsm", "lvsm.splits": [0.25]})");
    const std::string preset = (folder / "a.json").string();
    EXPECT_EQ(settingsOf({"plan", "--preset", preset}).shadow.moments.splits[0], 0.25F);
    const app::Settings found = settingsOf({"plan", "--preset", preset, "--set", "lvsm.placement=gaps"});
    EXPECT_EQ(found.shadow.moments.placement, LayerPlacement::gaps);
    EXPECT_FALSE(found.values.contains("lvsm.splits"));
    EXPECT_EQ(app::describeTechnique(found), "lvsm");
    const app::Settings base = settingsOf({"plan", "--preset", preset});
    EXPECT_EQ(app::describeTechnique(app::parseTechnique(base, "lvsm+lvsm.splits=0.75")), "lvsm+lvsm.splits=0.75");
    test::spill(folder / "b.json", R"({"filter": "lvsm", "lvsm.placement": "lloyd", "lvsm.splits": [0.25]})");
    EXPECT_THROW((void)settingsOf({"plan", "--preset", (folder / "b.json").string()}), app::UsageError);
}

TEST(MomentSettings, ThePresetIsThePapersSetUp)
{
    const app::Settings settings = settingsOf({"render", "--preset", "rts-2011"});
    const MomentOptions& moments = settings.shadow.moments;
    EXPECT_EQ(settings.scene, "rts");
    EXPECT_EQ(settings.shadow.technique.filter, Filter::lvsm);
    EXPECT_EQ(settings.shadow.map_size, 1024U);
    EXPECT_EQ(formatOf(settings.shadow), MapFormat::rgba16);
    EXPECT_EQ(moments.layers, 2U);
    EXPECT_EQ(moments.samples, 4U);
    EXPECT_EQ(moments.blur, BlurKind::gaussian);
    EXPECT_EQ(moments.blur_sigma_texels, 1.25F);
    EXPECT_EQ(moments.sampling, MapSampling::bilinear);
    EXPECT_EQ(moments.min_variance, 0.01F);
    EXPECT_EQ(moments.bleeding_power, 1.3F);
    EXPECT_EQ(settings.shadow.lighten, 0.39F); // of linear light: 0.65 of what is displayed
    EXPECT_EQ(settings.shadow.lighten_as, LightenAs::add);
    EXPECT_EQ(moments.placement, LayerPlacement::world);
    EXPECT_EQ(moments.world_layers[0], (WorldLayer{7.0, 13.0}));
    EXPECT_EQ(moments.world_layers[1], (WorldLayer{12.0, 40.0}));
    EXPECT_TRUE(settings.bloom.on);
    EXPECT_EQ(settings.bloom.threshold, 0.3F); // so that it is seen
}

std::vector<std::string> namesOf(const std::vector<app::Settings>& techniques)
{
    std::vector<std::string> names;
    std::transform(techniques.begin(), techniques.end(), std::back_inserter(names), app::describeTechnique);
    return names;
}

TEST(Contestants, ShareTheOptionsThatAnyOfThemUses)
{
    using Names = std::vector<std::string>;
    EXPECT_EQ(namesOf(app::contestants(settingsOf({"compare", "--techniques", "hard,vsm", "--set", "blur.sigma=2"}))),
              (Names{"hard", "vsm+blur.sigma=2"}));
    EXPECT_EQ(namesOf(app::contestants(settingsOf({"bench", "--techniques", "vsm,evsm", "--map-format", "rg32f"}))),
              (Names{"vsm", "evsm+map-format=rg32f"}));
    EXPECT_EQ(app::contestants(settingsOf({"compare", "--map-format", "r32f"})).size(), 11U); // all that can be that
    EXPECT_EQ(namesOf(app::contestants(settingsOf({"compare", "--filter", "vsm", "--set", "msaa=1"}))),
              (Names{"vsm+msaa=1"}));
    EXPECT_THROW((void)settingsOf({"compare", "--techniques", "hard,pcf", "--set", "blur.sigma=2", "--strict"}),
                 app::UsageError);
}

TEST(CommandLine, ASceneMayFollowAnyOption)
{
    const test::Folder folder;
    test::spill(folder / "a.json", R"({"scene": "rts", "filter": "vsm"})");
    const std::string preset = (folder / "a.json").string();
    EXPECT_EQ(settingsOf({"compare", "--preset", preset, "spotlit"}).scene, "spotlit");
    EXPECT_EQ(settingsOf({"compare", "--preset", preset, "spotlit"}).shadow.technique.filter, Filter::vsm);
    EXPECT_EQ(settingsOf({"bench", "--techniques", "hard,pcf", "planes"}).scene, "planes");
    EXPECT_EQ(settingsOf({"plan", "--set", "map-size=64", "planes"}).scene, "planes");
    EXPECT_EQ(settingsOf({"compare", "--limit", "count=5", "planes"}).scene, "planes");
    EXPECT_EQ(settingsOf({"bench", "--techniques", "hard", "--techniques", "pcf", "planes"}).techniques.size(), 2U);
}

TEST(CommandLine, BlanksInAListMeanNothing)
{
    EXPECT_EQ(settingsOf({"bench", "--techniques", " hard,  pcf+pcf.kernel=5x5 "}).techniques,
              (std::vector<std::string>{"hard", "pcf+pcf.kernel=5x5"}));
}

} // namespace
} // namespace gnomon
