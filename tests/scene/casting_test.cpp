// SPDX-License-Identifier: Apache-2.0
#include "scene/casting.h"

#include <gtest/gtest.h>

namespace gnomon::scene {
namespace {

/// A file says it and the command line says more, or the command line says it in two words.
TEST(Casting, InNoGroupHoldsWhateverGroupsAreSaidLater)
{
    Node node;
    apply({.casts = false}, node);
    EXPECT_EQ(node.groups, 0U);
    apply({.groups = 2U}, node);
    EXPECT_EQ(node.groups, 0U);
    EXPECT_FALSE(node.casts);
    apply({.casts = true}, node);
    EXPECT_EQ(node.groups, Node().groups);
    apply({.casts = false, .groups = 4U}, node);
    EXPECT_EQ(node.groups, 0U);
    apply({.casts = true, .groups = 4U}, node);
    EXPECT_EQ(node.groups, 4U);
    EXPECT_TRUE(node.casts);
}

/// A ground of a built-in world does not cast, and is in a group all the same.
TEST(Casting, GroupsOfAGroundAreItsOwn)
{
    Node ground;
    ground.casts = false;
    apply({.groups = 8U}, ground);
    EXPECT_EQ(ground.groups, 8U);
    EXPECT_FALSE(ground.casts);
}

} // namespace
} // namespace gnomon::scene
