// SPDX-License-Identifier: Apache-2.0
// Things that the world outside of the program may lack: a driver, room on the disk, the right to read.
#include "folder.h"
#include "wrong_usage.h"

#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gnomon {
namespace {

using test::expectOneLine;

TEST(OutsideWorld, NoVulkanDriver)
{
    const test::Folder folder;
    const test::How how{
        .folder = folder.path(),
        .environment = {{"VK_ICD_FILENAMES", "/nonexistent.json"}, {"VK_DRIVER_FILES", "/nonexistent.json"}}};
    expectOneLine(test::gnomon({"render", "planes"}, how), 1, "no Vulkan driver is installed");
    EXPECT_TRUE(folder.names().empty());
}

TEST(OutsideWorld, FileSizeLimit)
{
    const test::Folder folder;
    const test::Ran ran =
        test::gnomon({"render", "planes", "--size", "320x240"}, {.folder = folder.path(), .max_file_bytes = 512});
    expectOneLine(ran, 1, "too large");
    EXPECT_TRUE(folder.names().empty());
}

TEST(OutsideWorld, FullDisk)
{
    const test::Folder folder;
    if (mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=8k") != 0) {
        GTEST_SKIP() << "may not mount a small file system here";
    }
    const test::Ran one = test::gnomon({"render", "planes", "--size", "320x240"}, {.folder = folder.path()});
    const test::Ran many =
        test::gnomon({"render", "planes", "--size", "320x240", "--frames", "0-1"}, {.folder = folder.path()});
    const auto left = folder.names();
    umount(folder.path().c_str());
    expectOneLine(one, 1, "No space left");
    expectOneLine(many, 1, "No space left");
    EXPECT_TRUE(left.empty());
}

TEST(OutsideWorld, FullStandardOutput)
{
    const test::Folder folder;
    const test::Ran ran = test::gnomon({"list"}, {.folder = folder.path(), .out = test::Stream::full});
    expectOneLine(ran, 1, "standard output");
}

TEST(OutsideWorld, UnreadableScene)
{
    if (geteuid() == 0) {
        GTEST_SKIP() << "root may read everything";
    }
    const test::Folder folder;
    test::spill(folder / "a.gltf", "{}");
    chmod((folder / "a.gltf").c_str(), 0);
    expectOneLine(test::gnomon({"plan", "a.gltf"}, {.folder = folder.path()}), 1, "Permission denied");
}

} // namespace
} // namespace gnomon
