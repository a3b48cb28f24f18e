// SPDX-License-Identifier: Apache-2.0
// Standard output and standard error that cannot be written: the built program says so where it can, and does not fall.
#include "folder.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace gnomon {
namespace {

struct Subject {
    const char* name;
    std::vector<std::string> works; // writes to standard output
    std::vector<std::string> wrong; // wrong usage, told on standard error
};

const std::vector<Subject> kSubjects{
    {"render",
     {"render", "planes", "--size", "8x8", "--truth", "hard", "--mask", "--no-cache", "-o", "a.png"},
     {"render", "--fliter", "hard"}},
    {"compare",
     {"compare", "planes", "--size", "8x8", "--map-size", "16", "--truth", "hard", "--no-cache", "--repetitions", "1",
      "--warmup", "0", "--techniques", "hard"},
     {"compare", "--sweep", "map-size"}},
    {"metrics", {"metrics", "m.png", "m.png"}, {"metrics", "m.png"}},
    {"plan", {"plan", "planes"}, {"plan", "--mask"}},
    {"bench",
     {"bench", "planes", "--size", "8x8", "--map-size", "16", "--repetitions", "1", "--warmup", "0", "--filter",
      "hard"},
     {"bench", "--size", "0x0"}},
    {"list", {"list"}, {"list", "mms"}},
    {"gpus", {"gpus"}, {"gpus", "--gpu", "x"}},
    {"help", {"render", "--help"}, {"rendr"}},
};

constexpr std::pair<const char*, test::Stream> kUnwritable[] = {
    {"closed", test::Stream::closed}, {"full", test::Stream::full}, {"broken", test::Stream::broken}};

constexpr int kClosedPipe = 128 + SIGPIPE;

class Streams : public testing::TestWithParam<std::tuple<Subject, std::pair<const char*, test::Stream>>> {
protected:
    Streams() { writePng(folder / "m.png", Image8(8, 8, 1)); }
    [[nodiscard]] test::How how() const { return {.folder = folder.path(), .in_process = false}; }

    test::Folder folder;
};

TEST_P(Streams, OutputThatCannotBeWrittenIsAFailureOfOneLineAndAClosedPipeOfNone)
{
    const auto& [subject, stream] = GetParam();
    test::How out = how();
    out.out = stream.second;
    const test::Ran ran = test::gnomon(subject.works, out);
    if (stream.second == test::Stream::broken) { // the reader has what it wanted, and nobody wants to hear of it
        EXPECT_EQ(ran.status, kClosedPipe);
        EXPECT_TRUE(ran.errorLines().empty()) << ran.err;
        return;
    }
    EXPECT_EQ(ran.status, 1);
    const auto lines = ran.errorLines();
    ASSERT_EQ(lines.size(), 1U) << ran.err;
    EXPECT_TRUE(lines[0].starts_with("gnomon: writing to standard output: ")) << lines[0];
}

TEST_P(Streams, ErrorsThatCannotBeToldChangeNothing)
{
    const auto& [subject, stream] = GetParam();
    test::How err = how();
    err.err = stream.second;
    const test::Ran works = test::gnomon(subject.works, err);
    EXPECT_EQ(works.status, 0);
    EXPECT_NE(works.out, "");
    EXPECT_EQ(test::gnomon(subject.wrong, err).status, 2);
    if (subject.wrong[0] == "plan" || subject.wrong[0] == "render") {
        EXPECT_EQ(test::gnomon({subject.wrong[0], "nofile"}, err).status, 1);
    }
    err.out = stream.second;
    EXPECT_EQ(test::gnomon(subject.works, err).status, stream.second == test::Stream::broken ? kClosedPipe : 1);
    EXPECT_EQ(test::gnomon(subject.wrong, err).status, 2);
}

INSTANTIATE_TEST_SUITE_P(All, Streams, testing::Combine(testing::ValuesIn(kSubjects), testing::ValuesIn(kUnwritable)),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param).name) + "_" + std::get<1>(test.param).first;
                         });

/// Results go to pipes by other ways than standard output's: as a file's name, in text and as a picture.
TEST(ClosedPipes, EndFilesWithoutAWord)
{
    const test::Folder folder;
    std::filesystem::create_symlink("/dev/stdout", folder / "pipe.png"); // its ending says what is written
    const test::How how{.folder = folder.path(), .out = test::Stream::broken};
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"plan", "planes", "--json=/dev/stdout"},
          std::vector<std::string>{"bench", "planes", "--size", "8x8", "--map-size", "16", "--repetitions", "1",
                                   "--warmup", "0", "--filter", "hard", "--json", "-"},
          std::vector<std::string>{"render", "planes", "--size", "8x8", "--map-size", "16", "-o", "pipe.png"}}) {
        SCOPED_TRACE(arguments[0]);
        const test::Ran ran = test::gnomon(arguments, how);
        EXPECT_EQ(ran.status, kClosedPipe);
        EXPECT_TRUE(ran.errorLines().empty()) << ran.err;
        EXPECT_EQ(folder.names(), std::vector<std::string>{"pipe.png"});
    }
}

/// A file must not become descriptor 1 or 2, where others then write into it.
TEST(ClosedStreams, AreNotTakenByFiles)
{
    const test::Folder folder;
    const test::How how{.folder = folder.path(), .out = test::Stream::closed, .err = test::Stream::closed};
    EXPECT_EQ(test::gnomon({"plan", "planes", "--json=a.json"}, how).status, 0);
    EXPECT_EQ(test::gnomon({"render", "planes", "--size", "8x8", "--map-size", "16", "-o", "a.png"}, how).status, 1);
    EXPECT_TRUE(nlohmann::json::accept(test::slurp(folder / "a.json")));
    EXPECT_EQ(readImage(folder / "a.png").width, 8U);
    EXPECT_EQ(folder.names().size(), 2U);
}

} // namespace
} // namespace gnomon
