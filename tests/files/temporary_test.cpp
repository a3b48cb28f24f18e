// SPDX-License-Identifier: Apache-2.0
// Names of what is being made: nobody else's while its process lives, and free again when it was killed.
#include "files/files.h"
#include "files/temporary.h"
#include "folder.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

/// Leaves what a process leaves that is killed while it makes `target`.
void killWhileMaking(const fs::path& target, Temporary::Kind kind)
{
    const pid_t child = ::fork();
    if (child == 0) {
        const Temporary temporary(target, kind);
        if (kind == Temporary::Kind::folder) {
            test::spill(temporary.path() / "half", "half");
        }
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(Temporary, IsGoneWithoutATrace)
{
    const test::Folder folder;
    {
        const Temporary file(folder / "a", Temporary::Kind::file);
        const Temporary other(folder / "a", Temporary::Kind::folder);
        test::spill(other.path() / "x", "x");
        EXPECT_EQ(folder.names().size(), 2U);
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(Temporary, WhatAKilledProcessLeftIsRemovedByTheNext)
{
    const test::Folder folder;
    for (int i = 0; i < 2; ++i) {
        killWhileMaking(folder / "a.png", Temporary::Kind::file);
        ASSERT_EQ(folder.names(), std::vector<std::string>{".a.png.0.tmp"});
    }
    // A later number, as when others were at work at the time.
    test::spill(folder / ".a.png.3.tmp", "left");
    writeFile(folder / "b.png", "other");
    EXPECT_EQ(folder.names().size(), 3U); // another file's are no business of its
    writeFile(folder / "a.png", "whole");
    EXPECT_EQ(folder.names().size(), 2U);
    EXPECT_EQ(test::slurp(folder / "a.png"), "whole");

    killWhileMaking(folder / "report", Temporary::Kind::folder);
    EXPECT_TRUE(fs::is_regular_file(folder / ".report.0.tmp/half"));
    EXPECT_TRUE(fs::is_empty(Temporary(folder / "report", Temporary::Kind::folder).path()));
    EXPECT_EQ(folder.names().size(), 2U);
}

TEST(Temporary, WhatIsInUseStays)
{
    const test::Folder folder;
    const Temporary file(folder / "a", Temporary::Kind::file);
    const Temporary work(folder / "b", Temporary::Kind::folder);
    writeFile(folder / "a", "other");
    const Temporary other(folder / "b", Temporary::Kind::folder);
    EXPECT_NE(work.path(), other.path());
    EXPECT_TRUE(fs::exists(file.path()));
    EXPECT_TRUE(fs::exists(work.path()));
}

/// Names that look like ours and are none, or may not be removed: they are in the way, no more.
TEST(Temporary, WhatCannotBeRemovedIsPassedOver)
{
    const test::Folder folder;
    fs::create_directory(folder / ".a.0.tmp");
    test::spill(folder / ".a.0.tmp" / "kept", "kept");
    ASSERT_EQ(::mkfifo((folder / ".a.1.tmp").c_str(), 0600), 0);
    fs::create_symlink("nowhere", folder / ".a.2.tmp");
    writeFile(folder / "a", "whole");
    EXPECT_EQ(test::slurp(folder / "a"), "whole");
    EXPECT_EQ(folder.names().size(), 4U);
    EXPECT_EQ(test::slurp(folder / ".a.0.tmp" / "kept"), "kept");
}

TEST(Temporary, ALongNameStillHasOne)
{
    const test::Folder folder;
    const std::string name(255, 'n');
    writeFile(folder / name, "whole");
    EXPECT_EQ(folder.names(), std::vector<std::string>{name});
    for (const std::size_t length : {256U, 300U, 5000U}) {
        EXPECT_THROW(requireWritable(folder / std::string(length, 'n')), Error);
        EXPECT_THROW(writeFile(folder / std::string(length, 'n'), "whole"), Error);
    }
    EXPECT_EQ(folder.names().size(), 1U);
}

/// The file is whole, by whichever writer was last, and nothing else is left.
TEST(Temporary, ManyWriteOneFileAtATime)
{
    constexpr int kWriters = 8;
    constexpr int kRounds = 15;
    const test::Folder folder;
    std::vector<std::thread> writers;
    writers.reserve(kWriters);
    for (int writer = 0; writer < kWriters; ++writer) {
        writers.emplace_back([&, writer] {
            const std::string bytes(std::size_t{1000} * (writer + 1), static_cast<char>('a' + writer));
            for (int round = 0; round < kRounds; ++round) {
                writeFile(folder / "a", bytes);
            }
        });
    }
    for (int look = 0; look < kRounds; ++look) {
        std::error_code error;
        if (fs::exists(folder / "a", error)) {
            const std::string found = readWholeFile(folder / "a", 100000);
            ASSERT_FALSE(found.empty());
            EXPECT_EQ(found, std::string(std::size_t{1000} * (found[0] - 'a' + 1), found[0]));
        }
    }
    for (std::thread& writer : writers) {
        writer.join();
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

// A process that clears up may take a folder that is made and not yet locked for one left behind. Its maker makes
// another.
TEST(Temporary, ManyMakeAFolderAtATime)
{
    const test::Folder folder;
    std::atomic<int> failed = 0;
    constexpr int kMakers = 4;
    std::vector<std::thread> makers;
    makers.reserve(kMakers);
    for (int i = 0; i < kMakers; ++i) {
        makers.emplace_back([&] {
            for (int round = 0; round < 500; ++round) {
                try {
                    const Temporary made(folder / "report", Temporary::Kind::folder);
                    failed += fs::is_directory(made.path()) ? 0 : 1;
                } catch (const Error&) {
                    ++failed;
                }
            }
        });
    }
    for (std::thread& maker : makers) {
        maker.join();
    }
    EXPECT_EQ(failed, 0);
    EXPECT_TRUE(folder.names().empty());
}

} // namespace
} // namespace gnomon
