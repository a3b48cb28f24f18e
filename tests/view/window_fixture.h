// SPDX-License-Identifier: Apache-2.0
// A window on a desktop of its own, for tests that use it.
#pragma once

#include "user.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

namespace gnomon::test {

/// A small window, with Vulkan validation on.
inline const std::vector<std::string> kSmall{"planes",         "--camera=top", "--size=240x300",
                                             "--gpu=software", "--validate",   "--set=texels=262144"};

class ViewWindow : public ::testing::Test {
protected:
    void SetUp() override
    {
        desktop_ = Desktop::open();
        if (!desktop_) {
            GTEST_SKIP() << "Xvfb is not installed, so that no window can be opened";
        }
        folder_ = std::filesystem::temp_directory_path() / ("gnomon_view_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::unique_ptr<Desktop> desktop_;
    std::filesystem::path folder_;
};

/// What is shown is what `render` draws by the command that the window gives.
inline void expectAsRendered(User& user)
{
    ASSERT_TRUE(user.rest()) << user.viewer().message().text;
    const std::string command = user.viewer().command();
    const Image8 drawn = test::drawnBy(command);
    ASSERT_EQ(drawn.width, user.viewer().picture().width) << command;
    ASSERT_EQ(drawn.height, user.viewer().picture().height) << command;
    EXPECT_EQ(drawn.values, user.viewer().picture().values) << command;
}

} // namespace gnomon::test
