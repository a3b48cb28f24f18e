// SPDX-License-Identifier: Apache-2.0
// Draws every case of goldens.json with the software rasteriser, under validation, and compares with its image. After
// looking at a change at full size: GNOMON_GOLDEN_UPDATE=1 test_golden writes the images anew.
#include "compare_images.h"
#include "debug_views.h"

#include "app/command_line.h"
#include "app/shot.h"
#include "app/visual.h"
#include "host/frame_renderer.h"
#include "host/gpu.h"
#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

namespace gnomon::golden {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Case {
    std::string name;
    std::string scene;                  // "shared:" in front: a file of the shared scenes
    std::vector<std::string> arguments; // of `gnomon render`; with --frames the last one's picture counts
    std::string image;                  // in images/
    Tolerance tolerance;
    bool must_fail = false; // compares with an image that it must differ from
    int shift_x = 0;        // pixels that the result is moved by before it is compared
    int shift_y = 0;
};

/// The text of a failed case for googletest, instead of its bytes.
void PrintTo(const Case& entry, std::ostream* out)
{
    *out << entry.scene << " against " << entry.image;
}

fs::path folder()
{
    return GNOMON_GOLDEN_DIR;
}

std::vector<Case> readCases()
{
    std::ifstream in(folder() / "goldens.json");
    const json list = json::parse(in);
    std::vector<Case> cases;
    for (const json& entry : list.at("cases")) {
        Case made;
        made.name = entry.at("name");
        made.scene = entry.at("scene");
        made.arguments = entry.at("arguments");
        made.image = entry.at("image");
        const json& tolerance = list.at("tolerances").at(entry.at("tolerance").get<std::string>());
        made.tolerance = {tolerance.at("largest"), tolerance.at("small"), tolerance.at("share")};
        made.must_fail = entry.value("must_fail", false);
        made.shift_x = entry.value("shift_x", 0);
        made.shift_y = entry.value("shift_y", 0);
        cases.push_back(made);
    }
    return cases;
}

const std::vector<Case>& cases()
{
    static const std::vector<Case> all = readCases();
    return all;
}

bool updating()
{
    return std::getenv("GNOMON_GOLDEN_UPDATE") != nullptr;
}

std::string sceneFile(const std::string& scene)
{
    constexpr std::string_view kShared = "shared:";
    if (!scene.starts_with(kShared)) {
        return scene;
    }
    const char* given = std::getenv("GNOMON_SHARED");
    return (fs::path(given != nullptr ? given : GNOMON_SHARED_DIR) / scene.substr(kShared.size())).string();
}

class Golden : public testing::TestWithParam<Case> {
protected:
    static host::Gpu& gpu()
    {
        // Never destroyed before main ends: the process is the one run.
        static host::Gpu device(host::GpuOptions{"software", true});
        return device;
    }

    static std::size_t lightOf(const app::Shot& shot, const app::Settings& settings)
    {
        for (std::size_t i = 0; i < shot.lights.size(); ++i) {
            if (settings.light.empty() || shot.lights[i].name == settings.light) {
                return i;
            }
        }
        throw app::UsageError("no light " + settings.light);
    }

    static ImageF draw(const Case& wanted)
    {
        std::vector<std::string> arguments{"render", sceneFile(wanted.scene)};
        arguments.insert(arguments.end(), wanted.arguments.begin(), wanted.arguments.end());
        const app::Settings settings = app::parseCommandLine(arguments).settings;
        app::Shot shot = app::makeShot(settings);
        const host::SceneOnGpu uploaded(gpu(), shot.scene, shot.state);
        host::FrameRenderer renderer(uploaded, app::renderOptions(settings));
        for (std::uint32_t frame = 0; frame < settings.converge; ++frame) {
            renderer.draw(shot.state, shot.eye, shot.lights);
        }
        const app::FrameRange range = settings.frames.value_or(app::FrameRange{});
        for (std::uint32_t frame = range.first + 1; frame <= range.last; ++frame) {
            app::moveShot(shot, settings, frame);
            renderer.draw(shot.state, shot.eye, shot.lights);
        }
        const std::size_t light = lightOf(shot, settings);
        if (settings.debug != "none") {
            return toFloat(app::debugPicture(renderer, shot, settings, light));
        }
        const host::Picture picture = renderer.read(
            {.colour = !settings.mask, .linear = !settings.mask, .masks = settings.mask, .geometry = false});
        // The tone curve would hide what is not finite.
        EXPECT_TRUE(compare(picture.linear, picture.linear, {}).same) << "the radiance is not finite everywhere";
        return settings.mask ? picture.masks.at(light) : toFloat(picture.colour);
    }

    static void keepForPeople(const Case& wanted, const ImageF& actual, const ImageF& golden)
    {
        const fs::path out = GNOMON_GOLDEN_OUT;
        fs::create_directories(out);
        writePng(out / (wanted.name + "_actual.png"), to8Bit(actual));
        if (actual.values.size() == golden.values.size() && actual.width == golden.width) {
            writePng(out / (wanted.name + "_difference.png"), differenceImage(actual, golden));
        }
    }
};

TEST_P(Golden, LooksAsItDidWhenWeLooked)
{
    const Case& wanted = GetParam();
    const std::string scene = sceneFile(wanted.scene);
    if (scene != wanted.scene && !fs::exists(scene)) {
        GTEST_SKIP() << "NOT CHECKED: there is no " << scene;
    }
    const ImageF actual = shifted(draw(wanted), wanted.shift_x, wanted.shift_y);
    EXPECT_TRUE(gpu().messages().empty()) << gpu().messages().front();
    const fs::path file = folder() / "images" / wanted.image;
    if (updating() && !wanted.must_fail) {
        writePng(file, to8Bit(actual));
        return;
    }
    ASSERT_TRUE(fs::exists(file)) << "missing golden " << file;
    const ImageF golden = readImage(file);
    const Verdict verdict = compare(actual, golden, wanted.tolerance);
    RecordProperty("largest", std::to_string(verdict.largest));
    RecordProperty("share", std::to_string(verdict.share));
    if (wanted.must_fail) {
        EXPECT_FALSE(verdict.same) << "it was to be told apart from " << wanted.image << ", but only a share of "
                                   << verdict.share << " differs";
    } else if (!verdict.same) {
        keepForPeople(wanted, actual, golden);
        ADD_FAILURE() << wanted.name << ": " << verdict.why << "; see " << GNOMON_GOLDEN_OUT;
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, testing::ValuesIn(cases()), [](const auto& test) { return test.param.name; });

TEST(GoldenFiles, NoneIsUnexpectedAndNoneIsMissing)
{
    std::set<std::string> wanted;
    std::set<std::string> there;
    for (const Case& entry : cases()) {
        wanted.insert(entry.image);
    }
    for (const auto& entry : fs::directory_iterator(folder() / "images")) {
        there.insert(entry.path().filename().string());
    }
    EXPECT_EQ(wanted, there);
}

TEST(GoldenFiles, SomeCasesMustFail)
{
    EXPECT_GE(std::count_if(cases().begin(), cases().end(), [](const Case& entry) { return entry.must_fail; }), 3);
}

} // namespace
} // namespace gnomon::golden
