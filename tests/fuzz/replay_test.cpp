// SPDX-License-Identifier: Apache-2.0
// Every file of every fuzzer's corpus once, under whatever sanitizers this build has: what a fuzzer found stays found.
// And once for each allocation that reading it makes, which fails.
#include "allocation_count.h"
#include "sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <string>
#include <vector>

// The fuzzers that tests/fuzz/CMakeLists.txt lists; NAME_fuzzer.cpp defines fuzz_NAME.
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

struct CorpusFile {
    std::string name;
    std::vector<char> bytes; // exactly as large as the file, so that a read beyond its end is one beyond the memory too
};

class FuzzCorpus : public testing::TestWithParam<FuzzTarget> {
protected:
    static std::vector<CorpusFile> files()
    {
        std::vector<CorpusFile> files;
        const std::filesystem::path folder = std::filesystem::path(GNOMON_FUZZ_CORPUS) / GetParam().name;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            std::ifstream stream(entry.path(), std::ios::binary);
            files.push_back({entry.path().string(), {std::istreambuf_iterator<char>(stream), {}}});
        }
        std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
        return files;
    }
    static int read(const CorpusFile& file)
    {
        return GetParam().run(reinterpret_cast<const std::uint8_t*>(file.bytes.data()), file.bytes.size());
    }
};

TEST_P(FuzzCorpus, EndsInAResultOrAnError)
{
    const std::vector<CorpusFile> all = files();
    EXPECT_GE(all.size(), 5U) << "a corpus of next to nothing tries next to nothing";
    for (const CorpusFile& file : all) {
        SCOPED_TRACE(file.name);
        EXPECT_LE(file.bytes.size(), 16384U) << "minimise it";
        EXPECT_EQ(read(file), 0);
    }
}

TEST_P(FuzzCorpus, EndsWhereMemoryRunsOut)
{
    using gnomon::test::FailingAllocation;
    const std::vector<CorpusFile> all = files();
    std::vector<std::uint64_t> allocations; // of the files up to each
    std::uint64_t sum = 0;
    for (const CorpusFile& file : all) {
        (void)read(file); // what is made once and kept
        const FailingAllocation none(std::numeric_limits<std::uint64_t>::max());
        (void)read(file);
        allocations.push_back(sum += none.asked());
    }
    std::uint64_t without_memory = 0;
    for (const std::uint64_t point : gnomon::test::sweepPoints(GetParam().name, sum, 4000)) {
        const auto of = std::lower_bound(allocations.begin(), allocations.end(), point);
        const CorpusFile& file = all[static_cast<std::size_t>(of - allocations.begin())];
        const std::uint64_t before = of == allocations.begin() ? 0 : *(of - 1);
        SCOPED_TRACE(file.name + ", allocation " + std::to_string(point - before));
        const std::ptrdiff_t held = gnomon::test::heapHeld();
        try {
            const FailingAllocation failing(point - before);
            EXPECT_EQ(read(file), 0);
        } catch (const std::bad_alloc&) {
            ++without_memory;
        }
        EXPECT_TRUE(gnomon::test::heapHeld() == held || GetParam().name == std::string("exr")); // OpenEXR leaks
        ASSERT_TRUE(FailingAllocation::failed());
    }
    EXPECT_GT(without_memory, 0U);
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, testing::ValuesIn(kFuzzTargets),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
