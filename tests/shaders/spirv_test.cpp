// SPDX-License-Identifier: Apache-2.0
// The compiled shaders in the library.
#include <gnomon_classic_spirv.h>
#include <gnomon_spirv.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace gnomon {
namespace {

TEST(Spirv, IsSmall)
{
    std::size_t bytes = 0;
    std::size_t largest = 0;
    const auto add = [&](const auto& modules) {
        for (const std::span<const std::uint32_t>* words : modules) {
            bytes += words->size_bytes();
            largest = std::max(largest, words->size_bytes());
        }
    };
    add(spirv::all_of_gnomon_spirv);
    add(spirv::all_of_gnomon_classic_spirv);
    RecordProperty("bytes", static_cast<int>(bytes));
    EXPECT_LE(std::size(spirv::all_of_gnomon_spirv) + std::size(spirv::all_of_gnomon_classic_spirv), 81U)
        << "a specialization constant may do";
    EXPECT_GT(largest, 0U);
#ifndef GNOMON_SHADERS_KEEP_LINES
    EXPECT_LE(bytes, 1'615'000U);
    EXPECT_LE(largest, 100'000U) << "a module that is slow to compile";
#endif
}

} // namespace
} // namespace gnomon
