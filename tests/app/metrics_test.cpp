// SPDX-License-Identifier: Apache-2.0
// `gnomon metrics`: numbers that can be told beforehand, and files that are wrong.
#include "folder.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace gnomon {
namespace {

using nlohmann::json;

test::Ran metrics(const test::Folder& folder, const char* test_file, const char* truth_file)
{
    return test::gnomon({"metrics", test_file, truth_file, "--json", "-"}, {.folder = folder.path()});
}

json numbersOf(const test::Folder& folder, const char* test_file, const char* truth_file)
{
    const test::Ran ran = metrics(folder, test_file, truth_file);
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    return json::parse(ran.out, nullptr, false);
}

void expectRefused(const test::Folder& folder, const char* test_file, const char* truth_file, const char* says)
{
    const test::Ran ran = metrics(folder, test_file, truth_file);
    EXPECT_EQ(ran.status, 1);
    EXPECT_EQ(ran.out, "");
    ASSERT_EQ(ran.errorLines().size(), 1U) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
}

TEST(Metrics, OfMasksAreOfLinearVisibility)
{
    const test::Folder folder;
    writePng(folder / "dark.png", Image16(16, 12, 1, 0));
    writePng(folder / "lit.png", Image16(16, 12, 1, 65535));
    writePng(folder / "half.png", Image8(16, 12, 1, 51));
    const json found = numbersOf(folder, "dark.png", "lit.png");
    for (const char* key :
         {"version", "test", "truth", "size_px", "channels", "interpretation", "error", "pixels", "units"}) {
        EXPECT_TRUE(found.contains(key)) << key;
    }
    EXPECT_EQ(found["size_px"], json({16, 12}));
    EXPECT_EQ(found["units"]["error"], "visibility, 0 to 1");
    EXPECT_EQ(found["channels"], 1);
    EXPECT_EQ(found["interpretation"], "grey values as linear visibility");
    EXPECT_EQ(found["pixels"]["counted"], 16 * 12);
    const json& error = found["error"];
    EXPECT_EQ(error["rmse"], 1.0);
    EXPECT_EQ(error["mae"], 1.0);
    EXPECT_EQ(error["bias"], -1.0);
    EXPECT_EQ(error["p99"], 1.0);
    EXPECT_LT(error["ssim"].get<double>(), 0.01);
    EXPECT_GT(error["flip"].get<double>(), 0.5);
    // 8-bit grey is no sRGB either.
    EXPECT_NEAR(numbersOf(folder, "half.png", "dark.png")["error"]["bias"].get<double>(), 0.2, 1e-6);
}

TEST(Metrics, OfColoursAreOfAllChannelsButAlpha)
{
    const test::Folder folder;
    Image8 one(16, 16, 4, 51);
    Image8 other(16, 16, 4, 51);
    for (std::size_t i = 0; i < one.values.size(); i += 4) {
        other.values[i] = 102;     // red by 0.2
        other.values[i + 3] = 255; // alpha, which is passed over
    }
    writePng(folder / "one.png", one);
    writePng(folder / "other.png", other);
    const json found = numbersOf(folder, "other.png", "one.png");
    EXPECT_EQ(found["interpretation"], "sRGB-encoded colours");
    EXPECT_EQ(found["units"]["error"], "values as stored, ssim of their luminance, flip of the colours");
    EXPECT_NEAR(found["error"]["rmse"].get<double>(), 0.2 / std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(found["error"]["mae"].get<double>(), 0.2 / 3.0, 1e-6);
    EXPECT_NEAR(found["error"]["p99"].get<double>(), 0.2, 1e-6);
    EXPECT_EQ(found["pixels"]["counted"], 256);
    EXPECT_GT(found["error"]["flip"].get<double>(), 0.0);
}

TEST(Metrics, RefuseImagesThatCannotBeHeldAgainstEachOther)
{
    const test::Folder folder;
    writePng(folder / "grey.png", Image16(8, 8, 1));
    writePng(folder / "wide.png", Image16(9, 8, 1));
    writePng(folder / "rgb.png", Image8(8, 8, 3));
    writeExr(folder / "rgb.exr", ImageF(8, 8, 3));
    ImageF bad(8, 8, 1);
    *bad.pixel(3, 5) = std::numeric_limits<float>::quiet_NaN();
    writeExr(folder / "nan.exr", bad);
    writeExr(folder / "huge.exr", ImageF(8, 8, 3, std::numeric_limits<float>::max()));
    expectRefused(folder, "grey.png", "wide.png", "one has 8x8 pixels, the other 9x8");
    expectRefused(folder, "grey.png", "rgb.png", "one is grey");
    expectRefused(folder, "rgb.exr", "rgb.png", "take two of one kind");
    expectRefused(folder, "grey.png", "nan.exr", "pixel (3, 5) holds nan");
    const test::Ran huge = metrics(folder, "huge.exr", "rgb.exr"); // a number or one line, never "null"
    EXPECT_TRUE(huge.status == 1 || (json::accept(huge.out) && huge.out.find("null") == std::string::npos))
        << huge.out << huge.err;
}

TEST(Metrics, RefuseBrokenFiles)
{
    const test::Folder folder;
    writePng(folder / "good.png", Image16(64, 64, 1));
    const std::string bytes = test::slurp(folder / "good.png");
    test::spill(folder / "torn.png", std::string_view(bytes).substr(0, bytes.size() / 2));
    test::spill(folder / "empty.png", "");
    test::spill(folder / "text.png", "not an image");
    std::string flipped = bytes;
    flipped[40] = static_cast<char>(flipped[40] ^ 0x55);
    test::spill(folder / "flipped.png", flipped);
    for (const char* file : {"torn.png", "empty.png", "text.png", "flipped.png", "missing.png"}) {
        expectRefused(folder, file, "good.png", file);
        expectRefused(folder, "good.png", file, file);
    }
}

TEST(Metrics, SayWhenTheResultCannotBeWritten)
{
    const test::Folder folder;
    writePng(folder / "good.png", Image16(8, 8, 1));
    for (const char* target : {"--json=/dev/full", "--json=none/a.json"}) {
        const test::Ran ran = test::gnomon({"metrics", "good.png", "good.png", target}, {.folder = folder.path()});
        EXPECT_EQ(ran.status, 1) << target;
        EXPECT_EQ(ran.errorLines().size(), 1U) << ran.err;
    }
}

} // namespace
} // namespace gnomon
