// SPDX-License-Identifier: Apache-2.0
// Writing is all or nothing: after a failure the folder looks as it did before.
#include "folder.h"

#include "files/files.h"
#include "image/image_io.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <csignal>
#include <random>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

std::string whyNotWritten(const fs::path& file, std::string_view bytes = "new")
{
    try {
        writeFile(file, bytes);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// No file of this process may grow past `bytes` while this lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int) = SIG_DFL;
};

TEST(SafeWrite, ReplacesWhatWasThereAndKeepsItsMode)
{
    const test::Folder folder;
    test::spill(folder / "a", "old");
    chmod((folder / "a").c_str(), 0640);
    writeFile(folder / "a", "new");
    EXPECT_EQ(test::slurp(folder / "a"), "new");
    EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0640));
    EXPECT_EQ(folder.names().size(), 1U);
}

TEST(SafeWrite, KeepsASymbolicLink)
{
    const test::Folder folder;
    test::spill(folder / "target", "old");
    fs::create_symlink("target", folder / "link");
    writeFile(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(test::slurp(folder / "target"), "new");
}

TEST(SafeWrite, RefusesADirectoryAndAMissingFolder)
{
    const test::Folder folder;
    fs::create_directory(folder / "d");
    EXPECT_NE(whyNotWritten(folder / "d").find("it is a directory"), std::string::npos);
    EXPECT_NE(whyNotWritten(folder / "no" / "a").find("there is no folder"), std::string::npos);
    test::spill(folder / "file", "");
    EXPECT_NE(whyNotWritten(folder / "file" / "a").find("is not a folder"), std::string::npos);
    EXPECT_FALSE(whyNotWritten("").empty());
    EXPECT_EQ(folder.names().size(), 2U);
}

TEST(SafeWrite, RefusesWhereRightsAreMissing)
{
    if (geteuid() == 0) {
        GTEST_SKIP() << "root may write everywhere";
    }
    const test::Folder folder;
    test::spill(folder / "a", "old");
    chmod((folder / "a").c_str(), 0444);
    EXPECT_NE(whyNotWritten(folder / "a").find("Permission denied"), std::string::npos);
    EXPECT_EQ(test::slurp(folder / "a"), "old");
}

TEST(SafeWrite, FullDeviceIsAnErrorAndStaysADevice)
{
    if (!fs::exists("/dev/full")) {
        GTEST_SKIP() << "no /dev/full here";
    }
    EXPECT_NE(whyNotWritten("/dev/full").find("No space left"), std::string::npos);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    writeFile("/dev/null", "gone");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(SafeWrite, ALimitReachedHalfWayLeavesTheOldFileAlone)
{
    const test::Folder folder;
    test::spill(folder / "a", "old");
    {
        const FileSizeLimit limit(1000);
        EXPECT_NE(whyNotWritten(folder / "a", std::string(5000, 'x')).find("too large"), std::string::npos);
        EXPECT_NE(whyNotWritten(folder / "b", std::string(5000, 'x')).find("too large"), std::string::npos);
    }
    EXPECT_EQ(test::slurp(folder / "a"), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

TEST(SafeWrite, AFullDiskLeavesNothingBehind)
{
    const test::Folder folder;
    if (mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
        GTEST_SKIP() << "may not mount a small file system here";
    }
    Image16 noise(256, 256, 1);
    std::mt19937 random(1);
    for (std::uint16_t& value : noise.values) {
        value = static_cast<std::uint16_t>(random());
    }
    std::string why;
    try {
        writePng(folder / "a.png", noise);
    } catch (const Error& error) {
        why = error.what();
    }
    const std::vector<std::string> left = folder.names();
    umount(folder.path().c_str());
    EXPECT_NE(why.find("No space left"), std::string::npos) << why;
    EXPECT_TRUE(left.empty());
}

TEST(SafeWrite, ImagesThatAreNoneAreRefused)
{
    const test::Folder folder;
    EXPECT_THROW(writePng(folder / "a.png", Image8()), Error);
    EXPECT_THROW(writePng(folder / "a.png", Image8(2, 2, 5)), Error);
    EXPECT_THROW(writeExr(folder / "a.exr", ImageF(2, 2, 2)), Error);
    EXPECT_TRUE(folder.names().empty());
}

} // namespace
} // namespace gnomon
