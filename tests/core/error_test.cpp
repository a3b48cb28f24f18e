// SPDX-License-Identifier: Apache-2.0
#include <gnomon/error.h>

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Error, SaysWhatWasTriedFoundAndToDoInOneLine)
{
    const Error error("cannot read a.gltf", "no such\nfile", "check the path");
    EXPECT_STREQ(error.what(), "cannot read a.gltf: no such file; check the path");
    EXPECT_EQ(error.tried(), "cannot read a.gltf");
    EXPECT_EQ(error.found(), "no such\nfile");
    EXPECT_EQ(error.todo(), "check the path");
}

TEST(Error, LeavesOutWhatThereIsNotToDo)
{
    EXPECT_STREQ(Error("cannot draw", "the device was lost").what(), "cannot draw: the device was lost");
}

} // namespace
} // namespace gnomon
