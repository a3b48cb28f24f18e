// SPDX-License-Identifier: Apache-2.0
// The same frames by two drivers: lavapipe, and another one that rasterises otherwise. That is SwiftShader, which comes
// with Debian's chromium, or the device that GNOMON_OTHER_GPU names as `--gpu` does. A case that the other driver
// cannot draw, or without such a driver, is skipped and says so.
#include "beyond_edges.h"
#include "folder.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

namespace gnomon::test {
namespace {

using Environment = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kSwiftShader = "/usr/lib/chromium/vk_swiftshader_icd.json";
constexpr const char* kLavapipe = "/usr/share/vulkan/icd.d";

struct DriverCase {
    std::string name;
    std::string scene;
    std::string options;          // of `gnomon render`
    std::size_t beyond_edges = 0; // pixels that may be
};

void PrintTo(const DriverCase& one, std::ostream* out)
{
    *out << one.scene << ' ' << one.options;
}

Environment only(const std::string& driver)
{
    return {{"VK_DRIVER_FILES", driver}, {"VK_ICD_FILENAMES", driver}};
}

std::string lavapipe()
{
    if (std::filesystem::is_directory(kLavapipe)) {
        for (const auto& file : std::filesystem::directory_iterator(kLavapipe)) {
            if (file.path().filename().string().starts_with("lvp_icd")) {
                return file.path().string();
            }
        }
    }
    return "";
}

struct Driver {
    std::string gpu; // --gpu
    Environment environment;
};

/// Empty environment and name: there is none.
Driver otherDriver()
{
    if (const char* const gpu = std::getenv("GNOMON_OTHER_GPU"); gpu != nullptr && *gpu != '\0') {
        return {gpu, {}};
    }
    const char* const own = std::getenv("GNOMON_OTHER_DRIVER");
    const std::string file = own != nullptr ? own : kSwiftShader;
    return std::filesystem::exists(file) ? Driver{"software", only(file)} : Driver{};
}

std::vector<std::string> wordsOf(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) {
        words.push_back(word);
    }
    return words;
}

/// The pictures that a case draws, by name.
std::map<std::string, ImageF> draw(const DriverCase& one, const Driver& driver, const std::filesystem::path& folder,
                                   Ran& ran)
{
    std::vector<std::string> words{"render", one.scene, "--preset", "plain", "--gpu", driver.gpu, "--validate"};
    const std::vector<std::string> options = wordsOf(one.options);
    words.insert(words.end(), options.begin(), options.end());
    const bool frames = one.options.find("--frames") != std::string::npos;
    words.insert(words.end(), {"-o", (folder / (frames ? "frames" : "picture.png")).string()});
    ran = gnomon(words, {.folder = folder, .environment = driver.environment});
    std::map<std::string, ImageF> pictures;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder)) {
        if (file.path().extension() == ".png") {
            pictures[file.path().filename().string()] = readImage(file.path());
        }
    }
    return pictures;
}

class Drivers : public testing::TestWithParam<DriverCase> {};

TEST_P(Drivers, DrawTheSame)
{
    const Driver other = otherDriver();
    const std::string reference = lavapipe();
    if (other.gpu.empty() || reference.empty()) {
        GTEST_SKIP() << "no second driver: " << kSwiftShader << " comes with Debian's chromium; GNOMON_OTHER_DRIVER or "
                     << "GNOMON_OTHER_GPU names another";
    }
    const DriverCase& one = GetParam();
    Ran ran;
    const Folder there;
    const auto drawn = draw(one, other, there.path(), ran);
    if (ran.status == 1 && ran.err.find(": the device ") != std::string::npos) { // lacks or cannot do something
        GTEST_SKIP() << ran.err;
    }
    ASSERT_EQ(ran.status, 0) << ran.err;
    const Folder here;
    const auto wanted = draw(one, {"software", only(reference)}, here.path(), ran);
    if (ran.status == 1 && ran.err.find("no Vulkan driver is installed") != std::string::npos) {
        GTEST_SKIP() << "lavapipe cannot be loaded: " << reference;
    }
    ASSERT_EQ(ran.status, 0) << ran.err;
    ASSERT_FALSE(wanted.empty());
    ASSERT_EQ(drawn.size(), wanted.size());
    std::size_t beyond = 0;
    for (const auto& [name, picture] : wanted) {
        ASSERT_TRUE(drawn.contains(name)) << name;
        const ImageF& mask = drawn.at(name);
        ASSERT_TRUE(mask.width == picture.width && mask.height == picture.height);
        beyond += countBeyondEdges(mask, picture);
    }
    RecordProperty("beyond_edges", std::to_string(beyond));
    EXPECT_LE(beyond, one.beyond_edges);
}

// A check must be able to fail: a speck, a hole, and an edge that is a pixel off, which is none.
TEST(BeyondEdges, CountsWhatNoEdgeExplains)
{
    ImageF half(16, 8, 1);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 8; x < half.width; ++x) {
            half.pixel(x, y)[0] = 1.0F;
        }
    }
    ImageF moved = half;
    for (std::uint32_t y = 0; y < half.height; ++y) {
        moved.pixel(8, y)[0] = 0.0F;
    }
    EXPECT_EQ(countBeyondEdges(moved, half), 0U);
    ImageF specked = half;
    specked.pixel(3, 3)[0] = 1.0F;
    specked.pixel(12, 5)[0] = 0.0F;
    EXPECT_EQ(countBeyondEdges(specked, half), 2U);
    specked.pixel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(countBeyondEdges(specked, half), 2U);
}

std::vector<DriverCase> cases()
{
    // A side of the box is edge-on to the scene's own sun, and the last bits of its normal say how much of that is over
    // its horizon.
    const std::string sun = "--sun 1,-2,0.5 ";
    const std::string tiny = "--mask --size 160x90 --map-size 256 ";
    const std::string small = tiny + sun;
    std::vector<DriverCase> all;
    const auto add = [&](const std::string& name, const std::string& scene, const std::string& options,
                         std::size_t beyond = 0) {
        all.push_back({name, scene, options, beyond});
    };
    for (const char* filter : {"hard", "pcf", "vsm", "lvsm", "esm", "evsm", "msm", "id", "depth-id", "smoothies"}) {
        add(std::string("filter_") + filter, "planes", small + "--technique " + filter + "+uniform+single");
    }
    add("filter_volumes", "planes", "--mask --size 160x90 " + sun + "--technique volumes --set volumes.open=skip");
    // A texel of the map is no larger than a few pixels: its edges, too, may be drawn otherwise. Under a lamp one such
    // texel says whether raymarch takes a line along an edge, or rays; edges are the longer, the wider the picture is.
    const std::tuple<const char*, const char*, std::size_t> sizes[] = {
        {"160x90", "256", 25}, {"320x180", "512", 50}, {"640x360", "1024", 100}};
    for (const auto& [size, map, beyond] : sizes) {
        for (const std::string filter : {"raymarch", "pcss"}) {
            const std::string name = filter + "_" + size;
            const std::string options =
                std::string("--mask --map-size ") + map + " --size " + size + " --technique " + filter + "+";
            const std::string lamp = " --point 0,4,0,30 --light-size 0.3";
            add(name + "_single", "planes", options + "uniform+single " + sun);
            add(name + "_lispsm", "planes", options + "lispsm+single " + sun);
            add(name + "_cascades", "planes", options + "cascades " + sun);
            add(name + "_cube", "planes", options + "cube" + lamp);
            add(name + "_spot", "spotlit", options + "single", filter == "raymarch" ? beyond : 25);
            add(name + "_canopies", "canopies", options + "single", 25);
        }
    }
    for (const char* fit : {"lispsm", "lispsm-simple", "tsm", "psm", "scene"}) {
        add(std::string("fit_") + fit, "planes", small + "--technique pcf+single+" + fit);
    }
    add("fit_tsm_segments", "planes", small + "--technique pcf+single+tsm --set tsm.segments=4");
    add("fit_tsm_segments_spot", "spotlit", tiny + "--technique pcf+single+tsm --set tsm.segments=3", 25);
    add("fit_psm_raymarch", "planes", small + "--technique raymarch+psm+single");
    for (const char* partition : {"cascades", "sdsm", "multi"}) {
        add(std::string("partition_") + partition, "planes", small + "--technique pcf+" + partition);
    }
    for (const char* partition : {"cube", "paraboloid", "multi"}) {
        add(std::string("lamp_") + partition, "planes", tiny + "--point 0,4,0,30 --technique pcf+" + partition);
    }
    add("partition_virtual", "planes", small + "--technique pcf+virtual --converge 4", 25);
    add("lamp_virtual", "planes", tiny + "--point 0,4,0,30 --technique pcf+virtual --converge 4", 25);
    add("cascades_layered", "planes", small + "--technique pcf+cascades --set cascades.pass=layered");
    for (const char* filter : {"vsm", "lvsm", "esm", "evsm"}) { // msm: spot_msm has the same module
        add(std::string("cascades_") + filter, "planes", small + "--technique " + filter + "+cascades");
    }
    add("spot_msm", "spotlit", tiny + "--technique msm", 25);
    for (const char* soften : {"blur", "smoothies", "converge"}) {
        add(std::string("soften_") + soften, "planes", small + "--technique hard+single --soften " + soften);
    }
    add("converge_frames", "planes", small + "--technique hard+single --soften converge --frames 0-7 --path pan");
    for (const char* motion : {"snap", "step-jump", "step-band", "step-blend", "step-alternate"}) {
        const std::string path = motion == std::string("snap") ? " --path pan" : " --fps 0.5 --path day";
        add(std::string("motion_") + motion, "planes",
            small + "--technique pcf+single+" + motion + " --frames 0-7" + path);
    }
    for (const char* format : {"d16", "d24", "r32f", "rg16", "rgba8"}) {
        add(std::string("format_") + format, "planes", small + "--technique pcf+single --map-format " + format);
    }
    add("mask_half", "planes", small + "--technique pcf+single --set mask-size=half");
    add("faces_midpoint", "planes", small + "--technique pcf+single --set caster-faces=midpoint");
    add("mips", "planes", small + "--technique vsm+single --set map-sampling=trilinear");
    add("blur_fragment", "planes", small + "--technique vsm+single --set blur.path=fragment");
    add("forward_pcf", "planes", "--size 160x90 --map-size 256 --technique pcf+single --shading forward");
    add("forward_raymarch", "planes", "--size 160x90 --map-size 256 --technique raymarch+single --shading forward");
    add("deferred", "planes", "--size 160x90 --map-size 256 --technique pcf+single");
    return all;
}

INSTANTIATE_TEST_SUITE_P(Cases, Drivers, testing::ValuesIn(cases()), [](const auto& one) {
    std::string name = one.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

} // namespace
} // namespace gnomon::test
