// SPDX-License-Identifier: Apache-2.0
// Truths of any numbers, and a cache in an empty folder.
#pragma once

#include "tests/image/folder.h"
#include "truth/cache.h"
#include "truth/src/cache_entry.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

namespace gnomon::truth {

namespace fs = std::filesystem;
using gnomon::test::Folder;

inline constexpr scene::Hash128 kKey{0x0123456789ABCDEFULL, 42};
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Values from 0 to `largest`.
template <typename T>
void fill(ImageOf<T>& image, std::mt19937& random, T largest)
{
    for (T& value : image.values) {
        // Half of them repeat, as in truths.
        const bool repeats = &value != image.values.data() && random() % 2 == 0;
        value = repeats ? *(&value - 1)
                        : static_cast<T>(static_cast<double>(random()) / 4294967295.0 * static_cast<double>(largest));
    }
}

/// Any numbers that truths may have, with those that a careless copy loses: infinity, minus zero, denormals.
inline Traced sample(std::uint32_t width, std::uint32_t height, unsigned seed = 1)
{
    std::mt19937 random(seed);
    Traced traced;
    traced.surfaces.object_ids = {width, height, 1};
    traced.surfaces.triangle_ids = {width, height, 1, scene::kNone};
    traced.surfaces.points = {width, height, 3};
    traced.surfaces.normals = {width, height, 3};
    traced.surfaces.smooth_normals = {width, height, 3};
    traced.visibility.visibility = {width, height, 1, 1.0F};
    traced.visibility.standard_error = {width, height, 1};
    traced.visibility.first_blocker_m = {width, height, 1, kInfinity};
    fill(traced.surfaces.object_ids, random, scene::kNone);
    fill(traced.surfaces.points, random, 3e38F);
    fill(traced.surfaces.normals, random, 1.0F);
    fill(traced.surfaces.smooth_normals, random, 1.0F);
    fill(traced.visibility.visibility, random, 1.0F);
    traced.visibility.first_blocker_m.values.back() = 0.25F;
    traced.surfaces.points.values.front() = -0.0F;
    traced.surfaces.normals.values.back() = std::numeric_limits<float>::denorm_min();
    traced.visibility.kind = Kind::hard;
    traced.visibility.rays = 0xFEDCBA9876ULL + seed;
    traced.visibility.seconds = 0.1;
    return traced;
}

/// Bit for bit.
template <typename T>
bool same(const ImageOf<T>& a, const ImageOf<T>& b)
{
    return a.width == b.width && a.height == b.height && a.channels == b.channels &&
           a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(T)) == 0;
}

inline bool same(const Traced& a, const Traced& b)
{
    return same(a.surfaces.object_ids, b.surfaces.object_ids) &&
           same(a.surfaces.triangle_ids, b.surfaces.triangle_ids) && same(a.surfaces.points, b.surfaces.points) &&
           same(a.surfaces.normals, b.surfaces.normals) && same(a.surfaces.smooth_normals, b.surfaces.smooth_normals) &&
           same(a.visibility.visibility, b.visibility.visibility) &&
           same(a.visibility.standard_error, b.visibility.standard_error) &&
           same(a.visibility.first_blocker_m, b.visibility.first_blocker_m) && a.visibility.kind == b.visibility.kind &&
           a.visibility.rays == b.visibility.rays && a.visibility.seconds == b.visibility.seconds;
}

inline fs::path entryOf(const Folder& folder, const scene::Hash128& key = kKey)
{
    return folder / (scene::toString(key) + ".truth");
}

inline std::string entryBytes(std::uint32_t width = 13, std::uint32_t height = 7)
{
    return encodeEntry(kKey, sample(width, height)).value();
}

inline std::optional<Traced> load(const Cache& cache, const glm::uvec2& size_px = {4, 4},
                                  const scene::Hash128& key = kKey)
{
    return cache.load(key, size_px, Kind::hard);
}

class CacheTest : public testing::Test {
protected:
    const Folder folder_;
    const Cache cache_{folder_.path()};

    /// Expects that a load of that size and kind refuses and removes the entry.
    void expectRefusedAndRemoved(const std::string& bytes, const std::string& what, const glm::uvec2& size_px = {13, 7},
                                 Kind kind = Kind::hard)
    {
        gnomon::test::spill(entryOf(folder_), bytes);
        EXPECT_FALSE(cache_.load(kKey, size_px, kind).has_value()) << what;
        EXPECT_TRUE(folder_.names().empty()) << what;
    }
};

} // namespace gnomon::truth
