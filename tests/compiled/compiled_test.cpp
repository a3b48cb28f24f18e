// SPDX-License-Identifier: Apache-2.0
// A real compiler's figures of every pipeline of the library: registers, spills, waves and instructions on two chips of
// AMD that need not be there, compared with recorded.json. After a change that is meant to move them:
// GNOMON_COMPILED_UPDATE=1 test_compiled writes it anew.
#include "library_pipelines.h"
#include "recorded_stages.h"

#include "null_driver.h"

#include <gnomon_classic_spirv.h>
#include <gnomon_spirv.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

namespace gnomon::compiled {
namespace {

constexpr const char* kChips[] = {"NAVI21", "VEGA10"};

std::string recordFile()
{
    return GNOMON_COMPILED_DIR "/recorded.json";
}

bool updating()
{
    return std::getenv("GNOMON_COMPILED_UPDATE") != nullptr;
}

ModuleNames libraryModules()
{
    ModuleNames names;
    const auto add = [&](const auto& modules, const auto& called) {
        for (std::size_t i = 0; i < std::size(modules); ++i) {
            names[modules[i]->data()] = called[i];
        }
    };
    add(spirv::all_of_gnomon_spirv, spirv::names_of_gnomon_spirv);
    add(spirv::all_of_gnomon_classic_spirv, spirv::names_of_gnomon_classic_spirv);
    return names;
}

/// Modules for software rasterisers alone, which no other device is given.
bool isForSoftware(const std::string& module)
{
    return module == "mask_numbers_one.vert" || (module.starts_with("mask_") && module.ends_with("_one.frag"));
}

struct Compiled {
    std::string driver;
    std::string absence; // why there is nothing; else empty
    CompiledStages stages;
    std::set<std::string> modules;
    std::vector<std::string> faults;
};

Compiled compileFor(const std::string& chip)
{
    Compiled compiled;
    const std::unique_ptr<AmdDevice> device = AmdDevice::open(chip, compiled.absence);
    if (!device) {
        return compiled;
    }
    const ModuleNames names = libraryModules();
    test::NullDriver driver;
    const PipelineEar ear(driver.view(), names, *device);
    makeLibraryPipelines(ear.view(), driver);
    return {device->driver(), "", ear.heard(), ear.modules(), ear.faults()};
}

/// Once for each chip.
const Compiled& compiledFor(const std::string& chip)
{
    static std::map<std::string, Compiled> all;
    const auto found = all.find(chip);
    return found != all.end() ? found->second : all.emplace(chip, compileFor(chip)).first->second;
}

class Pipelines : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override
    {
        if (!compiledFor(GetParam()).absence.empty()) {
            GTEST_SKIP() << "NOT CHECKED: " << compiledFor(GetParam()).absence;
        }
    }
};

TEST_P(Pipelines, AllCompile)
{
    for (const std::string& fault : compiledFor(GetParam()).faults) {
        ADD_FAILURE() << fault;
    }
}

TEST_P(Pipelines, AreOfEveryModule)
{
    for (const auto& [words, name] : libraryModules()) {
        EXPECT_EQ(compiledFor(GetParam()).modules.contains(name), !isForSoftware(name)) << name;
    }
}

TEST_P(Pipelines, KeepAllInRegisters)
{
    for (const auto& [name, figures] : compiledFor(GetParam()).stages) {
        EXPECT_EQ(figures.at("spilled VGPRs"), 0U) << name;
        EXPECT_EQ(figures.at("scratch bytes"), 0U) << name;
    }
}

TEST_P(Pipelines, HaveTheFiguresRecorded)
{
    const Compiled& now = compiledFor(GetParam());
    RecordedStages recorded = readRecorded(recordFile());
    if (updating()) {
        recorded.driver = now.driver;
        recorded.chips[GetParam()] = now.stages;
        std::ofstream(recordFile()) << recordedText(recorded);
        return;
    }
    if (now.driver != recorded.driver) {
        GTEST_SKIP() << "NOT CHECKED: figures are recorded of " << recorded.driver << ", and this is " << now.driver;
    }
    std::string text;
    for (const std::string& change : changes(recorded.chips[GetParam()], now.stages)) {
        text += std::string("\n  ") + GetParam() + ", " + change;
    }
    EXPECT_TRUE(text.empty())
        << "what the compiler makes of pipelines has changed:" << text
        << "\nIf it is meant, record anew: GNOMON_COMPILED_UPDATE=1 build/test_compiled, look at the "
           "difference of tests/compiled/recorded.json, and commit it with the change";
}

INSTANTIATE_TEST_SUITE_P(Chips, Pipelines, testing::ValuesIn(kChips),
                         [](const auto& test) { return std::string(test.param); });

TEST(RecordedPipelines, AreWrittenAsTheyAreRead)
{
    if (updating()) {
        GTEST_SKIP() << "they are being written";
    }
    std::ifstream in(recordFile());
    const std::string text(std::istreambuf_iterator<char>(in), {});
    const RecordedStages recorded = readRecorded(recordFile());
    EXPECT_EQ(recordedText(recorded), text);
    EXPECT_EQ(recorded.chips.size(), std::size(kChips));
}

/// A wrong number in the record is told, whichever it is and in whichever direction.
TEST(RecordedPipelines, ThatAreWrongAreFound)
{
    const CompiledStages before{{"mask.frag", {{"VGPRs", 24}, {"instructions", 223}}}, {"blur.comp", {{"VGPRs", 8}}}};
    EXPECT_TRUE(changes(before, before).empty());
    CompiledStages after = before;
    after["mask.frag"]["VGPRs"] = 32;
    EXPECT_EQ(changes(before, after), std::vector<std::string>{"mask.frag: VGPRs has grown from 24 to 32"});
    EXPECT_EQ(changes(after, before), std::vector<std::string>{"mask.frag: VGPRs has shrunk from 32 to 24"});
    after = before;
    after.erase("blur.comp");
    EXPECT_EQ(changes(before, after), std::vector<std::string>{"blur.comp is recorded and not made"});
    EXPECT_EQ(changes(after, before), std::vector<std::string>{"blur.comp is not recorded"});
}

} // namespace
} // namespace gnomon::compiled
