// SPDX-License-Identifier: Apache-2.0
// `gnomon gpus`: the devices, what each can, and what is said where there is none.
#include "folder.h"
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using nlohmann::json;

test::Ran run(const std::vector<std::string>& arguments)
{
    const test::Folder folder;
    return test::gnomon(arguments, {.folder = folder.path()});
}

TEST(Gpus, TellWhichIsTakenAndWhatEachHas)
{
    const test::Ran ran = run({"gpus", "--json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json gpus = json::parse(ran.out).at("gpus");
    ASSERT_FALSE(gpus.empty());
    EXPECT_EQ(std::ranges::count_if(gpus, [](const json& gpu) { return gpu.at("taken").get<bool>(); }), 1);
    for (const json& gpu : gpus) {
        EXPECT_FALSE(gpu.at("name").get<std::string>().empty());
        EXPECT_FALSE(gpu.at("taken").get<bool>() && !gpu.at("refusal").is_null());
        for (const json& part : gpu.at("parts")) {
            for (const char* key : {"name", "serves", "without"}) {
                EXPECT_FALSE(part.at(key).get<std::string>().empty()) << part.dump();
            }
        }
    }
}

TEST(Gpus, OfNoDriverAreOneLine)
{
    const test::Folder folder;
    const test::How none{
        .folder = folder.path(),
        .environment = {{"VK_ICD_FILENAMES", "/nonexistent.json"}, {"VK_DRIVER_FILES", "/nonexistent.json"}},
        .in_process = false};
    const test::Ran ran = test::gnomon({"gpus"}, none);
    EXPECT_EQ(ran.status, 1);
    EXPECT_EQ(ran.out, "");
    ASSERT_EQ(ran.errorLines().size(), 1U) << ran.err;
    EXPECT_NE(ran.errorLines().front().find("no Vulkan driver is installed"), std::string::npos) << ran.err;
}

TEST(Gpus, TakeNoWordsAndNoOptionsOfPictures)
{
    EXPECT_EQ(run({"gpus", "rts"}).status, 2);
    EXPECT_EQ(run({"gpus", "--json", "rts"}).status, 2);
    EXPECT_EQ(run({"gpus", "--size", "8x8"}).status, 2);
}

TEST(Calibrate, KeepsRatesThatAutoGoesByUntilATableIsNamed)
{
    const test::Folder folder;
    const test::How how{.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", (folder / "cache").string()}}};
    const test::Ran ran = test::gnomon({"calibrate", "--gpu", "software", "--json"}, how);
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json found = json::parse(ran.out);
    EXPECT_TRUE(exists(std::filesystem::path(found.at("file").get<std::string>())));
    for (const auto& [name, ns] : found.at("rates").items()) {
        EXPECT_GE(ns.get<double>(), 0.0) << name;
    }
    EXPECT_GT(found.at("rates").at("texel_ns").get<double>(), 0.0);
    EXPECT_GT(found.at("rates").at("ray_ns").get<double>(), found.at("rates").at("compare_ns").get<double>());
}

TEST(Calibrate, TakesNoWordsAndNoOptionsOfPictures)
{
    EXPECT_EQ(run({"calibrate", "rts"}).status, 2);
    EXPECT_EQ(run({"calibrate", "--size", "8x8"}).status, 2);
    EXPECT_EQ(run({"calibrate", "--gpu", "no such device"}).status, 1);
}

} // namespace
} // namespace gnomon
