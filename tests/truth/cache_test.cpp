// SPDX-License-Identifier: Apache-2.0
// The content of an entry: it comes back as it was, or, when anything about it is wrong, not at all.
#include "cache_sample.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <sys/stat.h>
#include <utility>
#include <vector>

namespace gnomon::truth {
namespace {

TEST_F(CacheTest, GivesBackWhatItTookBitForBit)
{
    // One pixel; a row of whole mask bytes; a size that leaves mask bits unused.
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(16, 1), glm::uvec2(61, 35)}) {
        Traced traced = sample(size.x, size.y);
        EXPECT_FALSE(load(cache_, size).has_value());
        ASSERT_TRUE(cache_.store(kKey, traced));
        const std::optional<Traced> loaded = load(cache_, size);
        ASSERT_TRUE(loaded.has_value());
        EXPECT_TRUE(same(*loaded, traced));
        traced.surfaces.points.values[0] = 0.0F; // no longer the -0 that was stored
        EXPECT_FALSE(same(*loaded, traced));
        EXPECT_FALSE(load(cache_, size, {kKey.high, kKey.low + 1}).has_value());
        fs::remove(entryOf(folder_));
    }
}

TEST_F(CacheTest, AnotherStoreReplacesTheEntry)
{
    ASSERT_TRUE(cache_.store(kKey, sample(8, 8, 1)));
    ASSERT_TRUE(cache_.store(kKey, sample(9, 5, 2)));
    EXPECT_TRUE(same(load(cache_, {9, 5}).value(), sample(9, 5, 2)));
    EXPECT_EQ(folder_.names().size(), 1U);
}

TEST_F(CacheTest, MakesItsFolderWithTheFirstStore)
{
    const fs::path deep = folder_ / "a" / "b";
    const Cache cache(deep);
    EXPECT_FALSE(load(cache).has_value());
    EXPECT_TRUE(folder_.names().empty());
    EXPECT_TRUE(cache.store(kKey, sample(4, 4)));
    EXPECT_TRUE(load(cache).has_value());
}

TEST_F(CacheTest, AnEntryUnderAnotherKeysNameIsRefused)
{
    const scene::Hash128 other{kKey.high, kKey.low + 1};
    ASSERT_TRUE(cache_.store(kKey, sample(4, 4)));
    fs::rename(entryOf(folder_), entryOf(folder_, other));
    EXPECT_FALSE(load(cache_, {4, 4}, other).has_value());
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
    gnomon::test::spill(entryOf(folder_), whole);
    EXPECT_TRUE(load(cache_, {13, 7}).has_value()); // whole, it does load
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

struct Lie {
    const char* what;
    std::function<void(EntryHeader&)> tell;
};

std::vector<Lie> liesOfHeaders()
{
    const auto sides = [](std::uint32_t width, std::uint32_t height) {
        return [=](EntryHeader& header) {
            header.width = width;
            header.height = height;
        };
    };
    const auto payload = [](std::uint64_t bytes) {
        return [=](EntryHeader& header) {
            header.payload_bytes = bytes;
        };
    };
    return {
        {"huge sides", sides(0xFFFFFFFFU, 0xFFFFFFFFU)},
        {"sides whose product wraps to 0", sides(1U << 16U, 1U << 16U)},
        {"the largest sides", sides(kMaxCachedSide, kMaxCachedSide)},
        {"width 0", sides(0, 7)},
        {"height 0", sides(13, 0)},
        {"huge payload", payload(~0ULL)},
        {"payload that wraps", payload(~0ULL - kEntryHeaderBytes + 1)},
        {"another version",
         [](EntryHeader& header) {
             ++header.format_version;
         }},
        {"another byte order",
         [](EntryHeader& header) {
             header.magic = 0x474E4F4D54524831ULL;
         }},
        {"another key",
         [](EntryHeader& header) {
             ++header.key.low;
         }},
    };
}

TEST_F(CacheTest, HeadersThatDoNotFitTheFileAreRefusedBeforeMemoryIsTaken)
{
    const std::string whole = entryBytes(13, 7);
    for (const Lie& lie : liesOfHeaders()) {
        const std::string bytes = reseal(whole, lie.tell);
        EntryHeader told;
        std::memcpy(&told, bytes.data(), sizeof(told));
        const glm::uvec2 size_px(told.width, told.height); // asked for, so that only the file's size can betray it
        EXPECT_FALSE(parseHeader(bytes, bytes.size(), {kKey, size_px, Kind::hard}).has_value()) << lie.what;
        expectRefusedAndRemoved(bytes, lie.what, size_px);
    }
    gnomon::test::spill(entryOf(folder_), reseal(whole, [](EntryHeader& header) { header.rays = 7; }));
    EXPECT_EQ(load(cache_, {13, 7}).value().visibility.rays, 7U); // so the seal is right, and the sizes were looked at
}

TEST_F(CacheTest, SizesThatCouldBeTrueAreFoundOutByWhatIsPacked)
{
    const std::string whole = entryBytes(13, 7);
    for (const glm::uvec2 size_px : {glm::uvec2(13, 6), glm::uvec2(13, 8), glm::uvec2(91, 2)}) {
        const std::string bytes = reseal(whole, [&](EntryHeader& header) {
            header.width = size_px.x;
            header.height = size_px.y;
        });
        expectRefusedAndRemoved(bytes, std::to_string(size_px.x) + " x " + std::to_string(size_px.y), size_px);
    }
}

TEST_F(CacheTest, AWholeEntryOfAnotherSizeOrKindThanAskedIsRefused)
{
    const std::string whole = entryBytes(13, 7);
    for (const glm::uvec2 size_px : {glm::uvec2(7, 13), glm::uvec2(13, 8), glm::uvec2(12, 7), glm::uvec2(91, 1)}) {
        expectRefusedAndRemoved(whole, std::to_string(size_px.x) + " x " + std::to_string(size_px.y), size_px);
    }
    expectRefusedAndRemoved(whole, "another kind", {13, 7}, Kind::area);
    expectRefusedAndRemoved(reseal(whole, [](EntryHeader& header) { header.kind = 2; }), "no kind");
    gnomon::test::spill(entryOf(folder_), reseal(whole, [](EntryHeader& header) { header.kind = 1; }));
    EXPECT_EQ(cache_.load(kKey, {13, 7}, Kind::area).value().visibility.kind, Kind::area);
}

struct Mark {
    const char* what;
    std::function<float&(Traced&)> of;
};

std::vector<Mark> marks()
{
    return {
        {"point",
         [](Traced& t) -> float& {
             return t.surfaces.points.values[31];
         }},
        {"normal",
         [](Traced& t) -> float& {
             return t.surfaces.normals.values[31];
         }},
        {"smooth normal",
         [](Traced& t) -> float& {
             return t.surfaces.smooth_normals.values[31];
         }},
        {"visibility",
         [](Traced& t) -> float& {
             return t.visibility.visibility.values.back();
         }},
        {"standard error",
         [](Traced& t) -> float& {
             return t.visibility.standard_error.values.front();
         }},
        {"first blocker",
         [](Traced& t) -> float& {
             return t.visibility.first_blocker_m.values[40];
         }},
    };
}

/// A sealed entry whose marked value is `value`, whatever that is.
std::string withValue(const Mark& mark, float value)
{
    constexpr float kMarked = 0.7654321F;
    Traced traced = sample(13, 7);
    mark.of(traced) = kMarked;
    std::string bytes = encodeEntry(kKey, traced).value();
    const std::string marked(reinterpret_cast<const char*>(&kMarked), sizeof(kMarked));
    const std::size_t at = bytes.find(marked);
    EXPECT_EQ(at, bytes.rfind(marked)); // once
    std::memcpy(bytes.data() + at, &value, sizeof(value));
    return reseal(bytes, [](EntryHeader&) {});
}

TEST_F(CacheTest, ValuesThatNoTruthHasAreNeitherLoadedNorStored)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const auto expectRefused = [&](const Mark& mark, float value) {
        const std::string what = std::string(mark.what) + ' ' + std::to_string(value);
        expectRefusedAndRemoved(withValue(mark, value), what);
        Traced traced = sample(13, 7);
        mark.of(traced) = value;
        EXPECT_FALSE(cache_.store(kKey, traced)) << what;
        EXPECT_TRUE(folder_.names().empty()) << what;
    };
    for (const Mark& mark : marks()) {
        const std::string name = mark.what;
        for (const float bad : {kNan, -kNan, -kInfinity}) {
            expectRefused(mark, bad);
        }
        if (name != "first blocker") {
            expectRefused(mark, kInfinity);
        }
        if (name != "point" && name != "first blocker") {
            expectRefused(mark, 1.001F);
        }
        if (name != "point" && name != "normal" && name != "smooth normal") {
            expectRefused(mark, -1e-6F);
        }
        gnomon::test::spill(entryOf(folder_), withValue(mark, 0.25F));
        std::optional<Traced> loaded = load(cache_, {13, 7});
        ASSERT_TRUE(loaded.has_value()) << name;
        EXPECT_EQ(mark.of(*loaded), 0.25F); // so it was the value that was refused
        fs::remove(entryOf(folder_));
    }
    for (const double seconds : {double{kNan}, double{kInfinity}, -1.0}) {
        const auto tell = [=](EntryHeader& header) {
            header.seconds = seconds;
        };
        expectRefusedAndRemoved(reseal(entryBytes(), tell), std::to_string(seconds) + " s");
    }
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
    gnomon::test::spill(entryOf(folder_), entryBytes());
    std::error_code error;
    fs::resize_file(entryOf(folder_), 3ULL << 30, error); // sparse: takes no room on the disk
    if (error) {
        GTEST_SKIP() << "no sparse files here: " << error.message();
    }
    EXPECT_FALSE(load(cache_, {13, 7}).has_value());
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(CacheTest, WhatIsNoFileIsLeftAlone)
{
    fs::create_directory(entryOf(folder_));
    EXPECT_FALSE(load(cache_).has_value());
    std::string why;
    EXPECT_FALSE(cache_.store(kKey, sample(4, 4), &why));
    EXPECT_NE(why.find("not a plain file"), std::string::npos) << why;
    fs::remove(entryOf(folder_));
    ASSERT_EQ(mkfifo(entryOf(folder_).c_str(), 0600), 0);
    EXPECT_FALSE(load(cache_).has_value());
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
