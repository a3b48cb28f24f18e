// SPDX-License-Identifier: Apache-2.0
// Every file of every fuzzer's corpus once, under whatever sanitizers this build has: what a fuzzer found stays found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

// What tests/fuzz/CMakeLists.txt lists; NAME_fuzzer.cpp defines fuzz_NAME.
#define X(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
GNOMON_FUZZ_TARGETS
#undef X

namespace {

struct FuzzTarget {
    const char* name;
    int (*run)(const std::uint8_t* data, std::size_t size);
};

#define X(name) {#name, fuzz_##name},
const FuzzTarget kFuzzTargets[] = {GNOMON_FUZZ_TARGETS};
#undef X

class FuzzCorpus : public testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzCorpus, EndsInAResultOrAnError)
{
    const std::filesystem::path folder = std::filesystem::path(GNOMON_FUZZ_CORPUS) / GetParam().name;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    EXPECT_GE(files.size(), 5U) << "a corpus of next to nothing tries next to nothing";
    for (const std::filesystem::path& file : files) {
        SCOPED_TRACE(file.string());
        std::ifstream stream(file, std::ios::binary);
        // Exactly as large as the file, so that a read beyond its end is one beyond the memory too.
        const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
        EXPECT_LE(bytes.size(), 16384U) << "minimise it";
        EXPECT_EQ(GetParam().run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, testing::ValuesIn(kFuzzTargets),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
