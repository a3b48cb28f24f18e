// SPDX-License-Identifier: Apache-2.0
// The program's notices about options that do not do what one may think.
#include "folder.h"
#include "process.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon {
namespace {

test::Ran rendered(const std::vector<std::string>& more)
{
    const test::Folder folder;
    test::How how;
    how.folder = folder.path();
    std::vector<std::string> arguments{"render", "spotlit", "--size", "32x32", "--map-size", "64", "-o", "x.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::gnomon(arguments, how);
}

TEST(Notices, TellThatALightWithoutASizeMakesNoPenumbrae)
{
    const std::string said = "no light has a size, so there are no penumbrae; --light-size gives it one";
    for (const std::vector<std::string>& asks :
         {std::vector<std::string>{"--filter", "pcss"}, {"--filter", "hard", "--soften", "smoothies"}}) {
        std::vector<std::string> without = asks;
        without.insert(without.end(), {"--light-size", "0"});
        EXPECT_NE(rendered(without).err.find(said), std::string::npos) << asks[1];
        EXPECT_EQ(rendered(asks).err.find(said), std::string::npos) << asks[1];
    }
    EXPECT_EQ(rendered({"--light-size", "0"}).err.find(said), std::string::npos) << "the default takes any light";
}

TEST(Notices, SayWhichChoiceHasAValue)
{
    const test::Ran ran = rendered({"--filter", "blur"});
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.err.find("--filter: there is no \"blur\" (--soften has it); it takes hard, "), std::string::npos)
        << ran.err;
}

TEST(Notices, CallWhatAMapOfIdsHoldsIds)
{
    const test::Ran ran = rendered({"--filter", "id", "--debug", "map", "--light", "gear"});
    EXPECT_NE(ran.err.find("light gear: its map's id is 0 where black and "), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find('.', ran.err.find("its map's id")), std::string::npos) << ran.err;
}

} // namespace
} // namespace gnomon
