// SPDX-License-Identifier: Apache-2.0
// Memory that runs out while a file is written: the new file is there whole, or what was there before; nothing else.
#include "memory_sweep.h"
#include "tests/image/folder.h"

#include "app/src/result_json.h"
#include "files/files.h"
#include "files/temporary.h"
#include "image/image_io.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

int openFiles()
{
    int count = 0;
    for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
        count += entry.path().empty() ? 0 : 1;
    }
    return count;
}

/// `write` writes a file of the name that it is given; where there was none and where there was one.
template <typename Write>
void sweepWriting(const std::string& name, const Write& write, bool library_leaks = false)
{
    const Folder folder;
    const fs::path fresh = folder / "a file of a name that is not short";
    const fs::path old = folder / "old";
    const std::string before = "what was there before";
    write(fresh);
    const std::string whole = slurp(fresh);
    fs::remove(fresh);
    const int open = openFiles();
    MemorySweep sweep{.name = name + ", a new file", .library_leaks = library_leaks};
    sweepMemory(
        sweep, [&] { write(fresh); },
        [&](bool ended) {
            EXPECT_EQ(fs::exists(fresh), ended);
            EXPECT_TRUE(!ended || slurp(fresh) == whole);
            fs::remove(fresh);
            EXPECT_EQ(folder.names(), std::vector<std::string>{});
            EXPECT_EQ(openFiles(), open);
        });
    spill(old, before);
    sweep.name = name + ", in the place of another";
    sweepMemory(
        sweep, [&] { write(old); },
        [&](bool ended) {
            EXPECT_TRUE(slurp(old) == (ended ? whole : before));
            EXPECT_EQ(folder.names(), std::vector<std::string>{"old"});
            EXPECT_EQ(openFiles(), open);
            spill(old, before);
        });
}

/// Large enough for several rows of each block that is written at once.
template <typename T>
ImageOf<T> picture(std::uint32_t channels)
{
    ImageOf<T> image(33, 40, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<T>(i * 2654435761U >> 8U);
    }
    return image;
}

TEST(WritingMemory, APngIsWholeOrNotThere)
{
    const Image8 colour = picture<std::uint8_t>(4);
    const Image16 mask = picture<std::uint16_t>(1);
    sweepWriting("writing an 8-bit PNG", [&](const fs::path& file) { writePng(file, colour); });
    sweepWriting("writing a 16-bit PNG", [&](const fs::path& file) { writePng(file, mask); });
}

TEST(WritingMemory, AnExrIsWholeOrNotThere)
{
    const ImageF colour = picture<float>(3);
    const ImageF grey = picture<float>(1);
    sweepWriting(
        "writing an EXR of half floats", [&](const fs::path& file) { writeExr(file, colour, true); }, true);
    sweepWriting(
        "writing an EXR of floats", [&](const fs::path& file) { writeExr(file, grey); }, true);
}

TEST(WritingMemory, JsonIsWholeOrNotThere)
{
    app::Json result;
    result["a key that is not short"] = {1, 2.5, "a value that is not short"};
    result["another key"]["within"] = true;
    sweepWriting("writing JSON", [&](const fs::path& file) { writeFile(file, app::jsonText(result)); });
}

// Remains of killed processes' earlier tries are in the way.
TEST(WritingMemory, WhatWasLeftBehindIsRemovedAllTheSame)
{
    const Folder folder;
    const auto leave = [&] {
        spill(folder / ".a.0.tmp", "left");
        spill(folder / ".a.1.tmp", "left");
    };
    leave();
    const int open = openFiles();
    sweepMemory(
        {"writing where something was left"}, [&] { writeFile(folder / "a", "whole"); },
        [&](bool ended) {
            EXPECT_EQ(fs::exists(folder / "a"), ended);
            EXPECT_EQ(openFiles(), open);
            writeFile(folder / "a", "whole");
            EXPECT_EQ(slurp(folder / "a"), "whole");
            EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
            fs::remove(folder / "a");
            leave();
        });
}

// Where there is no memory even to look into it, with the next of its name.
TEST(WritingMemory, AFolderInTheMakingGoes)
{
    const Folder folder;
    const int open = openFiles();
    sweepMemory(
        {"making a folder"},
        [&] {
            const Temporary temporary(folder / "a report", Temporary::Kind::folder);
            writeFile(temporary.path() / "index.html", "text");
        },
        [&](bool ended) {
            if (ended) {
                const Temporary next(folder / "a report", Temporary::Kind::folder);
            }
            EXPECT_EQ(folder.names(), std::vector<std::string>{});
            EXPECT_EQ(openFiles(), open);
        });
}

} // namespace
} // namespace gnomon::test
