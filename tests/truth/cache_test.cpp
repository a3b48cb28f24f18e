// SPDX-License-Identifier: Apache-2.0
// What is in an entry: it comes back as it was, or, when anything about it is wrong, not at all.
#include "cache_sample.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <sys/stat.h>
#include <utility>
#include <vector>

namespace gnomon::truth {
namespace {

TEST_F(CacheTest, GivesBackWhatItTookBitForBit)
{
    // One pixel; a row of whole mask bytes; a size that leaves mask bits unused.
    for (const auto& [width, height] : {std::pair(1U, 1U), std::pair(16U, 1U), std::pair(61U, 35U)}) {
        Traced traced = sample(width, height);
        EXPECT_FALSE(cache_.load(kKey).has_value());
        ASSERT_TRUE(cache_.store(kKey, traced));
        const std::optional<Traced> loaded = cache_.load(kKey);
        ASSERT_TRUE(loaded.has_value());
        EXPECT_TRUE(same(*loaded, traced));
        traced.surfaces.points.values[0] = 0.0F; // no longer the -0 that was stored
        EXPECT_FALSE(same(*loaded, traced));
        EXPECT_FALSE(cache_.load({kKey.high, kKey.low + 1}).has_value());
        fs::remove(entryOf(folder_));
    }
}

TEST_F(CacheTest, AnotherStoreReplacesTheEntry)
{
    ASSERT_TRUE(cache_.store(kKey, sample(8, 8, 1)));
    ASSERT_TRUE(cache_.store(kKey, sample(9, 5, 2)));
    EXPECT_TRUE(same(cache_.load(kKey).value(), sample(9, 5, 2)));
    EXPECT_EQ(folder_.names().size(), 1U);
}

TEST_F(CacheTest, MakesItsFolderWithTheFirstStore)
{
    const fs::path deep = folder_ / "a" / "b";
    const Cache cache(deep);
    EXPECT_FALSE(cache.load(kKey).has_value());
    EXPECT_TRUE(folder_.names().empty());
    EXPECT_TRUE(cache.store(kKey, sample(4, 4)));
    EXPECT_TRUE(cache.load(kKey).has_value());
}

TEST_F(CacheTest, AnEntryUnderAnotherKeysNameIsRefused)
{
    const scene::Hash128 other{kKey.high, kKey.low + 1};
    ASSERT_TRUE(cache_.store(kKey, sample(4, 4)));
    fs::rename(entryOf(folder_), entryOf(folder_, other));
    EXPECT_FALSE(cache_.load(other).has_value());
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(CacheTest, TornFilesNeverLoad)
{
    const std::string whole = entryBytes();
    for (std::size_t length = 0; length < whole.size(); length += std::max<std::size_t>(1, whole.size() / 61)) {
        expectRefusedAndRemoved(whole.substr(0, length), "cut to " + std::to_string(length));
    }
    for (std::size_t length = 0; length < kEntryHeaderBytes; length += 7) {
        expectRefusedAndRemoved(whole.substr(0, length), "cut to " + std::to_string(length));
    }
    expectRefusedAndRemoved(whole.substr(0, whole.size() - 1), "cut by one");
    expectRefusedAndRemoved(whole + '\0', "one byte more");
    std::string zeroed = whole; // what some file systems leave after a power cut
    std::fill(zeroed.begin() + static_cast<std::ptrdiff_t>(zeroed.size() / 2), zeroed.end(), '\0');
    expectRefusedAndRemoved(zeroed, "second half of zeros");
    test::spill(entryOf(folder_), whole);
    EXPECT_TRUE(cache_.load(kKey).has_value()); // whole, it does load
}

TEST_F(CacheTest, FlippedBitsNeverLoad)
{
    const std::string whole = entryBytes();
    const std::size_t payload_step = whole.size() / 100;
    for (std::size_t at = 0; at < whole.size(); at += at < kEntryHeaderBytes ? 1 : payload_step) {
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
        expectRefusedAndRemoved(flipped, "flipped at " + std::to_string(at));
    }
}

/// An entry with another header, its checksum made to fit again: what damage cannot make, but a bad writer could.
std::string reseal(std::string bytes, const std::function<void(EntryHeader&)>& change)
{
    EntryHeader header;
    std::memcpy(&header, bytes.data(), sizeof(header));
    change(header);
    scene::Hasher hasher;
    hasher.addBytes(std::as_bytes(std::span(&header, 1)).first(offsetof(EntryHeader, checksum)));
    hasher.addBytes(std::as_bytes(std::span(bytes)).subspan(sizeof(header)));
    header.checksum = hasher.value();
    std::memcpy(bytes.data(), &header, sizeof(header));
    return bytes;
}

TEST_F(CacheTest, SizesThatDoNotFitTheFileAreRefusedBeforeMemoryIsTaken)
{
    constexpr std::uint32_t kHuge = 0xFFFFFFFFU;
    const std::string whole = entryBytes(13, 7);
    const std::vector<std::pair<const char*, std::function<void(EntryHeader&)>>> changes{
        {"huge sides",
         [](EntryHeader& h) {
             h.width = h.height = kHuge;
         }},
        {"sides whose product wraps to 0",
         [](EntryHeader& h) {
             h.width = h.height = 1U << 16U;
         }},
        {"the largest sides",
         [](EntryHeader& h) {
             h.width = h.height = kMaxCachedSide;
         }},
        {"width 0",
         [](EntryHeader& h) {
             h.width = 0;
         }},
        {"height 0",
         [](EntryHeader& h) {
             h.height = 0;
         }},
        {"huge payload",
         [](EntryHeader& h) {
             h.payload_bytes = ~0ULL;
         }},
        {"payload that wraps",
         [](EntryHeader& h) {
             h.payload_bytes = ~0ULL - kEntryHeaderBytes + 1;
         }},
        {"another kind",
         [](EntryHeader& h) {
             h.kind = 2;
         }},
        {"another version",
         [](EntryHeader& h) {
             ++h.format_version;
         }},
        {"another byte order",
         [](EntryHeader& h) {
             h.magic = 0x474E4F4D54524831ULL;
         }},
    };
    for (const auto& [what, change] : changes) {
        const std::string bytes = reseal(whole, change);
        EXPECT_FALSE(parseHeader(bytes, bytes.size(), kKey).has_value()) << what;
        expectRefusedAndRemoved(bytes, what);
    }
    // Sizes that could be true are found out by what is packed.
    for (const auto& [width, height] : {std::pair(13U, 6U), std::pair(13U, 8U), std::pair(91U, 2U)}) {
        expectRefusedAndRemoved(reseal(whole,
                                       [w = width, h = height](EntryHeader& header) {
                                           header.width = w;
                                           header.height = h;
                                       }),
                                std::to_string(width) + " x " + std::to_string(height));
    }
    test::spill(entryOf(folder_), reseal(whole, [](EntryHeader& h) { h.rays = 7; }));
    EXPECT_EQ(cache_.load(kKey).value().visibility.rays, 7U); // so the seal is right, and the sizes were looked at
}

TEST_F(CacheTest, MasksThatDoNotFitThePayloadAreRefused)
{
    // A 13 x 7 image has 91 pixels: 12 bytes of mask, of which 5 bits are spare.
    const std::string whole = entryBytes(13, 7);
    for (const std::size_t at : {std::size_t{0}, std::size_t{5}, std::size_t{11}}) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            std::string other = whole;
            char& byte = other[kEntryHeaderBytes + at];
            byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << bit));
            expectRefusedAndRemoved(reseal(other, [](EntryHeader&) {}), "mask byte " + std::to_string(at));
        }
    }
}

TEST_F(CacheTest, AHugeFileIsRefusedByItsHeader)
{
    test::spill(entryOf(folder_), entryBytes());
    std::error_code error;
    fs::resize_file(entryOf(folder_), 3ULL << 30, error); // sparse: takes no room on the disk
    if (error) {
        GTEST_SKIP() << "no sparse files here: " << error.message();
    }
    EXPECT_FALSE(cache_.load(kKey).has_value());
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(CacheTest, WhatIsNoFileIsLeftAlone)
{
    fs::create_directory(entryOf(folder_));
    EXPECT_FALSE(cache_.load(kKey).has_value());
    std::string why;
    EXPECT_FALSE(cache_.store(kKey, sample(4, 4), &why));
    EXPECT_NE(why.find("not a plain file"), std::string::npos) << why;
    fs::remove(entryOf(folder_));
    ASSERT_EQ(mkfifo(entryOf(folder_).c_str(), 0600), 0);
    EXPECT_FALSE(cache_.load(kKey).has_value());
    EXPECT_FALSE(cache_.store(kKey, sample(4, 4), &why));
    EXPECT_TRUE(fs::is_fifo(entryOf(folder_)));
}

TEST_F(CacheTest, ImagesThatDoNotFitTogetherAreRefused)
{
    std::string why;
    Traced traced = sample(4, 4);
    traced.visibility.standard_error = {4, 3, 1};
    EXPECT_FALSE(cache_.store(kKey, traced, &why));
    EXPECT_NE(why.find("not of one size"), std::string::npos) << why;
    EXPECT_FALSE(cache_.store(kKey, Traced(), &why));
    traced = sample(4, 4);
    traced.surfaces.points.values.pop_back();
    EXPECT_FALSE(cache_.store(kKey, traced));
    EXPECT_TRUE(folder_.names().empty());
}

} // namespace
} // namespace gnomon::truth
