// SPDX-License-Identifier: Apache-2.0
// No state of the disk is a reason to fail; old entries make room; and many may use a cache at once.
#include "cache_sample.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace gnomon::truth {
namespace {

TEST_F(CacheTest, AFileInPlaceOfTheFolder)
{
    gnomon::test::spill(folder_ / "file", "precious");
    for (const char* place : {"file", "file/below"}) {
        const Cache cache(folder_.path() / place);
        std::string why;
        EXPECT_FALSE(load(cache).has_value());
        EXPECT_FALSE(cache.store(kKey, sample(4, 4), &why));
        EXPECT_FALSE(why.empty());
    }
    EXPECT_EQ(gnomon::test::slurp(folder_ / "file"), "precious");
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

// The entries that go when room is needed

TEST_F(CacheTest, TheLeastRecentlyUsedGoFirst)
{
    const auto entry_bytes = static_cast<std::uint64_t>(encodeEntry(kKey, sample(16, 16))->size());
    const Cache cache(folder_.path(), 3 * entry_bytes + entry_bytes / 2);
    const auto now = fs::file_time_type::clock::now();
    for (std::uint64_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(cache.store({0, i}, sample(16, 16)));
        fs::last_write_time(entryOf(folder_, {0, i}), now - std::chrono::hours(100 - static_cast<int>(i)));
    }
    gnomon::test::spill(folder_ / "notes.txt", std::string(100'000, 'x'));
    EXPECT_TRUE(load(cache, {16, 16}, {0, 0}).has_value()); // 1 is now the one not used for longest
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
        gnomon::test::spill(folder_ / name, "half");
        fs::last_write_time(folder_ / name, now - std::chrono::hours(2));
    }
    fs::last_write_time(folder_ / kept[0], now - std::chrono::minutes(50));
    gnomon::test::spill(folder_ / ("." + entry + ".12-0.tmp"), "half");
    fs::last_write_time(folder_ / ("." + entry + ".12-0.tmp"), now - std::chrono::minutes(70));
    ASSERT_TRUE(cache_.store({1, 1}, sample(4, 4)));
    std::vector<std::string> expected = kept;
    expected.push_back(scene::toString({1, 1}) + ".truth");
    std::vector<std::string> found = folder_.names();
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
}

TEST_F(CacheTest, WhoeverReadsAnEntryRemovesWhatAKilledProcessLeftOfIt)
{
    const fs::path entry = entryOf(folder_, kKey);
    ASSERT_TRUE(cache_.store(kKey, sample(4, 4)));
    const std::string left = "." + entry.filename().string() + ".0.tmp";
    gnomon::test::spill(folder_ / left, "half");
    ASSERT_TRUE(load(cache_, {4, 4}).has_value());
    EXPECT_EQ(folder_.names(), std::vector<std::string>{entry.filename().string()});
}

// Side by side

constexpr glm::uvec2 kSharedSize{24, 16};

/// Stores one of two truths and loads, 200 times; what is loaded must be one of the two, whole. 0 when it was.
int storeAndLoad(const fs::path& folder, const Traced& first, const Traced& second)
{
    const Cache cache(folder);
    int found = 0;
    for (int round = 0; round < 200; ++round) {
        cache.store(kKey, round % 2 == 0 ? first : second);
        const std::optional<Traced> loaded = load(cache, kSharedSize);
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
    const Traced first = sample(kSharedSize.x, kSharedSize.y, 1);
    const Traced second = sample(kSharedSize.x, kSharedSize.y, 2);
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
    const Traced first = sample(kSharedSize.x, kSharedSize.y, 1);
    const Traced second = sample(kSharedSize.x, kSharedSize.y, 2);
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

} // namespace
} // namespace gnomon::truth
