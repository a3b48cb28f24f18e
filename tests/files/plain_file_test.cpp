// SPDX-License-Identifier: Apache-2.0
// Files that may be opened for reading, and others that are refused without waiting for them.
#include "files/files.h"
#include "folder.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

std::string whyNotRead(const fs::path& file, std::uint64_t max_bytes = 100)
{
    try {
        (void)readWholeFile(file, max_bytes, "thing");
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(PlainFile, IsReadToItsEnd)
{
    const test::Folder folder;
    test::spill(folder / "a", std::string("x\0y", 3));
    EXPECT_EQ(readWholeFile(folder / "a", 3), std::string("x\0y", 3));
    fs::create_symlink("a", folder / "link");
    EXPECT_EQ(readWholeFile(folder / "link", 3).size(), 3U);
    test::spill(folder / "empty", "");
    EXPECT_EQ(readWholeFile(folder / "empty", 0), "");
    EXPECT_NE(whyNotRead(folder / "a", 2).find("3 bytes, more than the limit of 2"), std::string::npos);
}

/// A pipe without a writer would be waited for; each of these ends at once, or the test does not.
TEST(PlainFile, NothingElseIsOpened)
{
    const test::Folder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(whyNotRead(folder / "pipe"),
              "reading thing " + (folder / "pipe").string() + ": it is a pipe; a plain file is needed");
    EXPECT_NE(whyNotRead(folder.path()).find("it is a directory"), std::string::npos);
    EXPECT_NE(whyNotRead("/dev/zero").find("it is a device"), std::string::npos);
    EXPECT_NE(whyNotRead(folder / "none").find("No such file"), std::string::npos);
    EXPECT_NE(whyNotRead("").find("its name is empty"), std::string::npos);
    EXPECT_NE(whyNotRead(folder / std::string(300, 'a')).find("too long"), std::string::npos);

    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    (folder / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_NE(whyNotRead(folder / "socket").find("it is a socket"), std::string::npos);
    ::close(socket);
}

TEST(PlainFile, ExtensionsAreOfAnyCase)
{
    EXPECT_TRUE(hasExtension("a.PNG", ".png"));
    EXPECT_TRUE(hasExtension("folder.exr/b.Png", ".png"));
    EXPECT_FALSE(hasExtension("a.png/b", ".png"));
    EXPECT_FALSE(hasExtension("a.pngx", ".png"));
    EXPECT_FALSE(hasExtension("png", ".png"));
    EXPECT_FALSE(hasExtension(".png", ".png")); // a hidden file without one
}

} // namespace
} // namespace gnomon
