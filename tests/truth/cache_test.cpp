// SPDX-License-Identifier: Apache-2.0
// An entry is whole and right, or it is not there; and no state of the disk is a reason to fail.
#include "truth/cache.h"

#include "scene/worlds.h"
#include "tests/image/folder.h"
#include "truth/src/cache_entry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <span>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace gnomon::truth {
namespace {

namespace fs = std::filesystem;
using test::Folder;

constexpr scene::Hash128 kKey{0x0123456789ABCDEFULL, 42};
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <typename T>
void fill(ImageOf<T>& image, std::mt19937& random)
{
    for (T& value : image.values) {
        // Half of them repeat, as in truths.
        const bool repeats = &value != image.values.data() && random() % 2 == 0;
        value = repeats ? *(&value - 1) : static_cast<T>(random());
    }
}

/// Any numbers, with those that a careless copy loses: NaN, infinity, minus zero, denormals.
Traced sample(std::uint32_t width, std::uint32_t height, unsigned seed = 1)
{
    std::mt19937 random(seed);
    Traced traced;
    traced.surfaces.object_ids = {width, height, 1};
    traced.surfaces.triangle_ids = {width, height, 1, scene::kNone};
    traced.surfaces.points = {width, height, 3};
    traced.surfaces.normals = {width, height, 3};
    traced.visibility.visibility = {width, height, 1, 1.0F};
    traced.visibility.standard_error = {width, height, 1};
    traced.visibility.first_blocker_m = {width, height, 1, kInfinity};
    fill(traced.surfaces.object_ids, random);
    fill(traced.surfaces.points, random);
    fill(traced.surfaces.normals, random);
    fill(traced.visibility.visibility, random);
    traced.visibility.first_blocker_m.values.back() = std::nanf("7");
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

bool same(const Traced& a, const Traced& b)
{
    return same(a.surfaces.object_ids, b.surfaces.object_ids) &&
           same(a.surfaces.triangle_ids, b.surfaces.triangle_ids) && same(a.surfaces.points, b.surfaces.points) &&
           same(a.surfaces.normals, b.surfaces.normals) && same(a.visibility.visibility, b.visibility.visibility) &&
           same(a.visibility.standard_error, b.visibility.standard_error) &&
           same(a.visibility.first_blocker_m, b.visibility.first_blocker_m) && a.visibility.kind == b.visibility.kind &&
           a.visibility.rays == b.visibility.rays && a.visibility.seconds == b.visibility.seconds;
}

fs::path entryOf(const Folder& folder, const scene::Hash128& key = kKey)
{
    return folder / (scene::toString(key) + ".truth");
}

std::string entryBytes(std::uint32_t width = 13, std::uint32_t height = 7)
{
    return encodeEntry(kKey, sample(width, height)).value();
}

class CacheTest : public testing::Test {
protected:
    const Folder folder_;
    const Cache cache_{folder_.path()};

    void expectRefusedAndRemoved(const std::string& bytes, const std::string& what)
    {
        test::spill(entryOf(folder_), bytes);
        EXPECT_FALSE(cache_.load(kKey).has_value()) << what;
        EXPECT_TRUE(folder_.names().empty()) << what;
    }
};

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

// Failures of the disk

TEST_F(CacheTest, AFileInPlaceOfTheFolder)
{
    test::spill(folder_ / "file", "precious");
    for (const char* place : {"file", "file/below"}) {
        const Cache cache(folder_.path() / place);
        std::string why;
        EXPECT_FALSE(cache.load(kKey).has_value());
        EXPECT_FALSE(cache.store(kKey, sample(4, 4), &why));
        EXPECT_FALSE(why.empty());
    }
    EXPECT_EQ(test::slurp(folder_ / "file"), "precious");
}

TEST_F(CacheTest, AFolderWithoutRights)
{
    if (geteuid() == 0) {
        GTEST_SKIP() << "root may write everywhere";
    }
    chmod(folder_.path().c_str(), 0555);
    std::string why;
    EXPECT_FALSE(cache_.store(kKey, sample(4, 4), &why));
    EXPECT_NE(why.find("Permission denied"), std::string::npos) << why;
    EXPECT_FALSE(Cache(folder_ / "below").store(kKey, sample(4, 4), &why));
    EXPECT_NE(why.find("Permission denied"), std::string::npos) << why;
    chmod(folder_.path().c_str(), 0755);
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(CacheTest, ALimitReachedHalfWayLeavesNothingBehind)
{
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    void (*const handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::string why;
    const bool stored = cache_.store(kKey, sample(64, 64), &why);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_FALSE(stored);
    EXPECT_NE(why.find("too large"), std::string::npos) << why;
    EXPECT_TRUE(folder_.names().empty());
    EXPECT_TRUE(cache_.store(kKey, sample(64, 64), &why)) << why;
    EXPECT_TRUE(why.empty());
}

TEST_F(CacheTest, AFullDiskLeavesNothingBehind)
{
    if (mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
        GTEST_SKIP() << "may not mount a small file system here";
    }
    std::string why;
    const bool stored = cache_.store(kKey, sample(256, 256), &why);
    const std::vector<std::string> left = folder_.names();
    umount(folder_.path().c_str());
    EXPECT_FALSE(stored);
    EXPECT_NE(why.find("No space left"), std::string::npos) << why;
    EXPECT_TRUE(left.empty());
}

// What goes when room is needed

TEST_F(CacheTest, TheLeastRecentlyUsedGoFirst)
{
    const auto entry_bytes = static_cast<std::uint64_t>(encodeEntry(kKey, sample(16, 16))->size());
    const Cache cache(folder_.path(), 3 * entry_bytes + entry_bytes / 2);
    const auto now = fs::file_time_type::clock::now();
    for (std::uint64_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(cache.store({0, i}, sample(16, 16)));
        fs::last_write_time(entryOf(folder_, {0, i}), now - std::chrono::hours(100 - static_cast<int>(i)));
    }
    test::spill(folder_ / "notes.txt", std::string(100'000, 'x'));
    EXPECT_TRUE(cache.load({0, 0}).has_value()); // 1 is now the one not used for longest
    ASSERT_TRUE(cache.store({0, 3}, sample(16, 16)));
    EXPECT_TRUE(fs::exists(entryOf(folder_, {0, 0})));
    EXPECT_FALSE(fs::exists(entryOf(folder_, {0, 1})));
    EXPECT_TRUE(fs::exists(entryOf(folder_, {0, 2})));
    EXPECT_TRUE(fs::exists(entryOf(folder_, {0, 3})));
    EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
    // Room for one: it is the one just stored.
    ASSERT_TRUE(Cache(folder_.path(), entry_bytes).store({0, 4}, sample(16, 16)));
    EXPECT_EQ(folder_.names().size(), 2U);
    EXPECT_TRUE(fs::exists(entryOf(folder_, {0, 4})));
    std::string why;
    EXPECT_FALSE(Cache(folder_.path(), entry_bytes - 1).store({0, 5}, sample(16, 16), &why));
    EXPECT_NE(why.find("more than the whole cache"), std::string::npos) << why;
}

TEST_F(CacheTest, OnlyTemporariesOfKilledProcessesAreSwept)
{
    const std::string entry = scene::toString(kKey) + ".truth";
    const auto now = fs::file_time_type::clock::now();
    const std::vector<std::string> kept{"." + entry + ".12-1.tmp", ".other.12-0.tmp", "x." + entry + ".12-0.tmp"};
    for (const std::string& name : kept) {
        test::spill(folder_ / name, "half");
        fs::last_write_time(folder_ / name, now - std::chrono::hours(2));
    }
    fs::last_write_time(folder_ / kept[0], now - std::chrono::minutes(50));
    test::spill(folder_ / ("." + entry + ".12-0.tmp"), "half");
    fs::last_write_time(folder_ / ("." + entry + ".12-0.tmp"), now - std::chrono::minutes(70));
    ASSERT_TRUE(cache_.store({1, 1}, sample(4, 4)));
    std::vector<std::string> expected = kept;
    expected.push_back(scene::toString({1, 1}) + ".truth");
    std::vector<std::string> found = folder_.names();
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
}

// Side by side

/// Stores one of two truths and loads, 200 times; what is loaded must be one of the two, whole. 0 when it was.
int storeAndLoad(const fs::path& folder, const Traced& first, const Traced& second)
{
    const Cache cache(folder);
    int found = 0;
    for (int round = 0; round < 200; ++round) {
        cache.store(kKey, round % 2 == 0 ? first : second);
        const std::optional<Traced> loaded = cache.load(kKey);
        if (!loaded) {
            return 1; // nobody removes it, and replacing must not leave a gap
        }
        if (!same(*loaded, first) && !same(*loaded, second)) {
            return 2;
        }
        ++found;
    }
    return found == 200 ? 0 : 3;
}

TEST_F(CacheTest, TwoProcessesMayUseOneKey)
{
    const Traced first = sample(24, 16, 1);
    const Traced second = sample(31, 11, 2);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        _exit(storeAndLoad(folder_.path(), first, second));
    }
    EXPECT_EQ(storeAndLoad(folder_.path(), second, first), 0);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(folder_.names().size(), 1U);
}

TEST_F(CacheTest, ThreadsMayUseOneKey)
{
    const Traced first = sample(24, 16, 1);
    const Traced second = sample(31, 11, 2);
    std::array<int, 3> results{};
    std::vector<std::thread> threads;
    for (int& result : results) {
        threads.emplace_back([&] { result = storeAndLoad(folder_.path(), first, second); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(results, (std::array<int, 3>{}));
    EXPECT_EQ(folder_.names().size(), 1U);
}

// Keys

struct Asked {
    scene::Scene scene;
    scene::State state;
    View view;
    Light light;
    Options options;
    [[nodiscard]] scene::Hash128 key() const { return keyOf(scene, state, view, light, options); }
};

Asked askedSample()
{
    Asked asked;
    asked.scene = scene::makePlanes(1);
    asked.state = scene::evaluate(asked.scene, 0.0);
    asked.view.size_px = {4, 4};
    return asked;
}

TEST(CacheKey, EveryIngredientChangesIt)
{
    const Asked asked = askedSample();
    const std::vector<std::function<void(Asked&)>> changes{
        [](Asked& a) { a.scene.materials[0].alpha_cutoff += 0.1F; },
        [](Asked& a) { a.state.objects[0].casts = false; },
        [](Asked& a) { a.view.eye_ws.z = 1e-9; },
        [](Asked& a) { a.view.world_from_clip[3][3] = 1.0 + 1e-9; },
        [](Asked& a) { a.view.size_px.x = 5; },
        [](Asked& a) { a.view.size_px.y = 5; },
        [](Asked& a) { a.light.type = scene::LightType::spot; },
        [](Asked& a) { a.light.position_ws.z = 1e-9; },
        [](Asked& a) { a.light.direction_ws.z = 1e-9; },
        [](Asked& a) { a.light.angular_diameter_rad += 1e-9; },
        [](Asked& a) { a.light.radius_m = 1e-9; },
        [](Asked& a) { a.light.near_m = 1e-9; },
        [](Asked& a) { a.options.kind = Kind::hard; },
        [](Asked& a) { a.options.samples *= 2; },
        [](Asked& a) { ++a.options.seed; },
    };
    std::set<scene::Hash128> seen{asked.key()};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Asked other = asked;
        changes[i](other);
        EXPECT_TRUE(seen.insert(other.key()).second) << "change " << i;
    }
}

TEST(CacheKey, WhatDoesNotMatterDoesNotChangeIt)
{
    const Asked asked = askedSample();
    Asked other = asked;
    const std::atomic<bool> cancel{false};
    other.options.threads = 3;
    other.options.progress = [](double) {
    };
    other.options.cancel = &cancel;
    other.scene.name = other.scene.nodes[0].name = "another name";
    EXPECT_EQ(other.key(), asked.key());
    // One ray to the centre is no sample.
    Asked hard = asked;
    hard.options.kind = Kind::hard;
    Asked hard_too = hard;
    hard_too.options.samples = 64;
    hard_too.options.seed = 9;
    EXPECT_EQ(hard_too.key(), hard.key());
}

/// Sets a variable of the environment, or removes it, while it lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name)
    {
        if (const char* before = std::getenv(name)) {
            before_ = before;
        }
        set(value);
    }
    ~Variable() { set(before_ ? before_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    void set(const char* value) const
    {
        if (value == nullptr) {
            unsetenv(name_);
        } else {
            setenv(name_, value, 1);
        }
    }
    const char* name_;
    std::optional<std::string> before_;
};

TEST(CacheFolder, FollowsTheEnvironment)
{
    const Variable home("HOME", "/h");
    {
        const Variable xdg("XDG_CACHE_HOME", "/x/c");
        EXPECT_EQ(Cache::defaultFolder(), fs::path("/x/c/gnomon/truth"));
    }
    for (const char* unfit : {static_cast<const char*>(nullptr), "", "relative"}) {
        const Variable xdg("XDG_CACHE_HOME", unfit);
        EXPECT_EQ(Cache::defaultFolder(), fs::path("/h/.cache/gnomon/truth"));
        const Variable nowhere("HOME", unfit);
        EXPECT_EQ(Cache::defaultFolder(), std::nullopt);
    }
}

} // namespace
} // namespace gnomon::truth
