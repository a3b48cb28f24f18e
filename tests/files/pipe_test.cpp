// SPDX-License-Identifier: Apache-2.0
// Writing to a pipe: its reader is waited for, and the wait can be ended.
#include "files/files.h"
#include "folder.h"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace gnomon {
namespace {

constexpr std::size_t kMoreThanAPipeHolds = std::size_t{4} << 20U;

struct Enough {};
int looks = 0;

void enoughAtTheThird()
{
    if (++looks == 3) {
        throw Enough();
    }
}

class Pipe : public testing::Test {
protected:
    Pipe()
    {
        looks = 0;
        EXPECT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    }
    ~Pipe() override { callWhileWaiting(nullptr); }

    test::Folder folder;
    std::filesystem::path pipe = folder / "pipe";
};

/// All that writers write, until there are none.
std::string readToEnd(int descriptor)
{
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t count = 0; (count = ::read(descriptor, buffer.data(), buffer.size())) > 0;) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return text;
}

TEST_F(Pipe, ThatNobodyOpensIsWaitedForUntilTheWaitIsEnded)
{
    callWhileWaiting(enoughAtTheThird);
    EXPECT_THROW(writeFile(pipe, "x"), Enough);
    EXPECT_EQ(looks, 3);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"pipe"});
}

TEST_F(Pipe, ThatNobodyEmptiesIsWaitedForUntilTheWaitIsEnded)
{
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    callWhileWaiting(enoughAtTheThird);
    EXPECT_THROW(writeFile(pipe, std::string(kMoreThanAPipeHolds, 'x')), Enough);
    EXPECT_EQ(looks, 3);
    const std::size_t written = readToEnd(reader).size();
    EXPECT_GT(written, 0U);
    EXPECT_LT(written, kMoreThanAPipeHolds);
    char byte = 0;
    EXPECT_EQ(::read(reader, &byte, 1), 0) << "it is still open for writing";
    ::close(reader);
}

std::thread late_reader;
std::filesystem::path read_late;
std::string read_text;

void startTheReader()
{
    if (!late_reader.joinable()) {
        late_reader = std::thread([] {
            const int reader = ::open(read_late.c_str(), O_RDONLY | O_CLOEXEC);
            read_text = readToEnd(reader);
            ::close(reader);
        });
    }
}

TEST_F(Pipe, WhoseReaderComesLateGetsItAll)
{
    read_late = pipe;
    callWhileWaiting(startTheReader);
    const std::string text(kMoreThanAPipeHolds, 'x');
    writeFile(pipe, text);
    ASSERT_TRUE(late_reader.joinable());
    late_reader.join();
    EXPECT_TRUE(read_text == text);
}

/// As /dev/stdout and a shell's >(COMMAND) do.
TEST_F(Pipe, WithoutANameIsReachedThroughALink)
{
    int ends[2] = {-1, -1};
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    writeFile("/proc/self/fd/" + std::to_string(ends[1]), "whole");
    ::close(ends[1]);
    EXPECT_EQ(readToEnd(ends[0]), "whole");
    ::close(ends[0]);
}

/// Whether the reader goes before the writing begins or during it; nobody else can come to read a pipe without a name.
TEST_F(Pipe, WhoseReaderHasGoneIsClosed)
{
    auto* const before = std::signal(SIGPIPE, SIG_IGN);
    int ends[2] = {-1, -1};
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    const std::string name = "/proc/self/fd/" + std::to_string(ends[1]);
    std::thread reader([&] {
        char first = 0;
        EXPECT_EQ(::read(ends[0], &first, 1), 1);
        ::close(ends[0]);
    });
    EXPECT_THROW(writeFile(name, std::string(kMoreThanAPipeHolds, 'x')), ClosedPipe);
    reader.join();
    EXPECT_THROW(writeFile(name, "x"), ClosedPipe);
    ::close(ends[1]);
    std::signal(SIGPIPE, before);
}

} // namespace
} // namespace gnomon
